"""How alike two surfaces are, whatever their triangles: distances between sample points and surfaces."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from cadgraph.geometry.kernels.parallel import compiled, for_ranges
from cadgraph.geometry.mesh.properties import measure
from cadgraph.geometry.mesh.sample import spread_points
from cadgraph.geometry.shape.repeats import Shapes, find_shapes
from cadgraph.model.parts import Bools, Properties
from cadgraph.model.scene import Floats, Ints, Scene, mesh_of_vertex

__all__ = ["NearShapes", "corners_of", "deviation", "find_alike", "find_near_shapes", "sample_surface"]

# Scale-free invariants of candidates may differ by this much (logarithms): 8 against 64 sides differ by 0.03.
_LOOSE = 0.08
# A root mean square deviation of this share of the middle extent is similarity 0. Ours: 8 against 24 sides keep 0.88;
# a flange with a bore larger by a fifth 0.62.
_UNLIKE = 0.05
_N_COARSE, _N_FINE = 24, 192
# Extents of boxes laid on each other may differ by this share of the longest.
_BOX_SLACK = 0.08
# Of references that might look like a mesh only so many are compared with it, those of nearest moments.
_MOST_COMPARED = 12
# Logarithm of the ratio of sizes up to which two meshes are of one size: another tessellation takes off up to 2 %.
_SAME_SIZE = 0.03


@dataclass(frozen=True)
class NearShapes:
    """Distinct shapes that look alike: tessellated otherwise, scaled or mirrored.

    Alikeness has no end (each of many may be a little unlike the next), so every shape is named with the earliest one
    that it looks like, if that is not named with another itself.

    Args:
        pairs: ``(n, 2)`` shape ids: the earlier one, and one that looks like it; each shape is second at most once.
            Ascending.
        similarity: ``(n,)`` 0..1: 1 less the root mean square deviation over 0.05 of the middle extent.
        scale: ``(n,)`` size of the second over that of the first, by area.
        mirrored: ``(n,)`` whether only the mirror image of the second looks like the first.
    """

    pairs: Ints
    similarity: Floats
    scale: Floats
    mirrored: Bools


def find_near_shapes(
    scene: Scene,
    properties: Properties,
    shapes: Shapes,
    min_similarity: float = 0.75,
    scaled: bool = True,
    workers: int | None = None,
) -> NearShapes:
    """Finds distinct shapes that look alike.

    The first meshes of the shapes are scaled to equal area. Those that then have the same shape are found as such; the
    rest are laid on each other in all the ways in which their oriented boxes agree, and the best one counts.

    Args:
        scene: any.
        properties: of its meshes.
        shapes: of its meshes.
        min_similarity: pairs below are left out.
        scaled: whether parts of different size may be alike.
        workers: threads; all processors by default. The outcome does not depend on it.

    Returns:
        The pairs.
    """
    heads = shapes.first
    usable = np.flatnonzero((properties.area[heads] > 0) & np.isfinite(properties.centroid[heads]).all(axis=1))
    like = np.full(len(heads), -1, np.int64)
    similarity, mirrored = np.ones(len(heads)), np.zeros(len(heads), np.bool_)
    if scaled and len(usable) > 1:
        small = _unit_scene(scene, properties, heads[usable])
        equal = find_shapes(small, measure(small, workers), workers)
        same = equal.first[equal.shape]
        image = equal.mirror_of[equal.shape]
        same = np.where(image >= 0, equal.first[image], same)
        repeats = same != np.arange(len(usable))
        like[usable[repeats]] = usable[same[repeats]]
        mirrored[usable[repeats]] = image[repeats] >= 0
        usable = usable[~repeats]
    else:
        image = shapes.mirror_of[usable]
        like[usable[image >= 0]], mirrored[usable[image >= 0]] = image[image >= 0], True
        usable = usable[image < 0]
    if len(usable) > 1:
        _pair_up(scene, properties, heads, usable, scaled, min_similarity, workers, like, similarity, mirrored)
    seconds = np.flatnonzero(like >= 0)
    pairs = np.column_stack([like[seconds], seconds])
    order = np.lexsort((pairs[:, 1], pairs[:, 0]))
    pairs, seconds = pairs[order], seconds[order]
    size = np.sqrt(properties.area[heads])
    return NearShapes(pairs, similarity[seconds], size[pairs[:, 1]] / size[pairs[:, 0]], mirrored[seconds])


def find_alike(
    scene: Scene,
    properties: Properties,
    references: Ints,
    others: Ints,
    rigid: Bools,
    min_similarity: float = 0.75,
    workers: int | None = None,
) -> NearShapes:
    """Finds what each of some meshes looks like among references, whatever its triangles, size or handedness.

    Args:
        scene: any.
        properties: of its meshes.
        references: ``(n,)`` distinct meshes.
        others: ``(m,)`` meshes to be compared with them.
        rigid: ``(n_meshes,)`` meshes that look like others of their own size only.
        min_similarity: pairs below are left out.
        workers: threads; all processors by default. The outcome does not depend on it.

    Returns:
        Pairs of a reference and another mesh, as mesh indices; other than in ``find_near_shapes`` a mesh may look
        like several references. Ascending by the other mesh.
    """
    usable = (properties.area > 0) & np.isfinite(properties.centroid).all(axis=1)
    first, second = references[usable[references]], others[usable[others]]
    same = _candidates(properties, first, second, scaled=False)
    free = _candidates(properties, first[~rigid[first]], second[~rigid[second]], scaled=True)
    size = np.sqrt(properties.area)
    same = same[np.abs(np.log(size[same[:, 1]] / size[same[:, 0]])) <= _SAME_SIZE]
    pairs = np.unique(np.vstack([same, free])[:, ::-1], axis=0)[:, ::-1]
    # Extents are descending: if they don't agree so, they don't in any turn.
    extents = properties.obb_extents / np.where(size > 0, size, 1.0)[:, None]
    one, other = extents[pairs[:, 0]], extents[pairs[:, 1]]
    pairs = pairs[np.all(np.abs(one - other) <= _BOX_SLACK * np.maximum(one, other)[:, :1], axis=1)]
    alike, flipped = np.zeros(len(pairs)), np.zeros(len(pairs), np.bool_)

    def compare(low: int, high: int) -> None:
        for at in range(low, high):
            alike[at], flipped[at] = _compare(scene, properties, int(pairs[at, 0]), int(pairs[at, 1]))

    for_ranges(compare, np.diff(scene.face_offsets)[pairs[:, 1]], workers)
    kept = alike >= min_similarity
    pairs = pairs[kept]
    return NearShapes(pairs, alike[kept], size[pairs[:, 1]] / size[pairs[:, 0]], flipped[kept])


def _candidates(properties: Properties, first: Ints, second: Ints, scaled: bool) -> Ints:
    """``(n, 2)`` pairs of like moments, for each of the second at most a few of the first."""
    if not len(first) or not len(second):
        return np.zeros((0, 2), np.int64)
    tree = cKDTree(_looks(properties, first, scaled))
    most = np.arange(1, min(_MOST_COMPARED, len(first)) + 1)
    found = tree.query(_looks(properties, second, scaled), k=most, p=np.inf)
    far, near = np.asarray(found[0]), np.asarray(found[1])
    row, column = np.nonzero(far <= _LOOSE)
    return np.column_stack([first[near[row, column]], second[row]])


def _unit_scene(scene: Scene, properties: Properties, meshes: Ints) -> Scene:
    """These meshes alone, about the origin and of unit area."""
    part = scene.select(meshes)
    owner = mesh_of_vertex(part)
    size = np.sqrt(properties.area[meshes])
    vertices = (part.vertices - properties.centroid[meshes][owner]) / size[owner, None]
    return part.with_vertices(vertices)


def _pair_up(
    scene: Scene,
    properties: Properties,
    heads: Ints,
    usable: Ints,
    scaled: bool,
    min_similarity: float,
    workers: int | None,
    like: Ints,
    similarity: Floats,
    mirrored: Bools,
) -> None:
    """Goes through shapes in order and names each later one that looks like it and is not named yet."""
    looks = _looks(properties, heads[usable], scaled)
    tree = cKDTree(looks)
    weights = np.diff(scene.face_offsets)[heads]
    for k, a in enumerate(usable):
        if like[a] >= 0:
            continue
        near = usable[[j for j in sorted(tree.query_ball_point(looks[k], _LOOSE, p=np.inf)) if j > k]]
        others = near[like[near] < 0].astype(np.int64)
        alike, flipped = np.zeros(len(others)), np.zeros(len(others), np.bool_)

        def compare(low: int, high: int) -> None:
            for at in range(low, high):
                alike[at], flipped[at] = _compare(scene, properties, int(heads[a]), int(heads[others[at]]))  # noqa: B023

        for_ranges(compare, weights[others], workers)
        named = alike >= min_similarity
        like[others[named]] = a
        similarity[others[named]], mirrored[others[named]] = alike[named], flipped[named]


def _looks(properties: Properties, meshes: Ints, scaled: bool) -> Floats:
    """Logarithms of lengths that no motion changes, over the root of the area; with that root too unless scaled."""
    area = properties.area[meshes]
    moments = np.linalg.eigvalsh(properties.inertia[meshes])
    looks = np.log(np.maximum(moments, 1e-12 * area[:, None] ** 2) / area[:, None] ** 2) / 2
    return looks if scaled else np.column_stack([looks, np.log(area) / 2])


def _compare(scene: Scene, properties: Properties, a: int, b: int) -> tuple[float, bool]:
    """Similarity of two meshes, and whether the second had to be mirrored."""
    first, second = _normal_form(scene, properties, a), _normal_form(scene, properties, b)
    extents_a = properties.obb_extents[a] / np.sqrt(properties.area[a])
    extents_b = properties.obb_extents[b] / np.sqrt(properties.area[b])
    slack = _BOX_SLACK * max(extents_a[0], extents_b[0])
    size = max(extents_a[1], extents_b[1])
    coarse, fine = sample_surface(second, _N_COARSE), sample_surface(second, _N_FINE)
    back = sample_surface(first, _N_FINE)
    best = {1: (np.inf, np.eye(3)), -1: (np.inf, np.eye(3))}
    for turn in _box_turns():
        if np.any(np.abs(np.abs(turn) @ extents_b - extents_a) > slack):
            continue
        sense = 1 if np.linalg.det(turn) > 0 else -1
        off = deviation(coarse @ turn.T, first)
        if off < best[sense][0]:
            best[sense] = (off, turn)
    results = []
    for sense, (off, turn) in best.items():
        if np.isfinite(off):
            there, here = deviation(fine @ turn.T, first), deviation(back @ turn, second)
            results.append((max(0.0, 1.0 - np.sqrt((there**2 + here**2) / 2) / (_UNLIKE * size)), sense < 0))
    if not results:
        return 0.0, False
    # A mirror image must be better by more than rounding to be called one.
    proper = max((s for s, flip in results if not flip), default=0.0)
    mirror = max((s for s, flip in results if flip), default=0.0)
    return (float(mirror), True) if mirror > proper + 0.01 else (float(proper), False)


def _normal_form(scene: Scene, properties: Properties, mesh: int) -> Floats:
    """``(m, 9)`` triangles in the frame of the oriented box, scaled to unit area."""
    corners = corners_of(scene, mesh).reshape(-1, 3) - properties.obb_center[mesh]
    scaled = corners @ properties.obb_axes[mesh].T / np.sqrt(properties.area[mesh])
    return np.ascontiguousarray(scaled.reshape(-1, 9))


def _box_turns() -> list[Floats]:
    """The 48 ways to lay a box on a box."""
    return [
        np.eye(3)[list(order)] * np.array(signs)[:, None]
        for order in itertools.permutations(range(3))
        for signs in itertools.product((1.0, -1.0), repeat=3)
    ]


def corners_of(scene: Scene, mesh: int) -> Floats:
    """``(m, 9)`` triangles of a mesh [m], without those that have a missing or non-finite corner."""
    vertices, faces = scene.mesh(mesh)
    corners = vertices[faces[np.all((faces >= 0) & (faces < len(vertices)), axis=1)]].reshape(-1, 9)
    return np.ascontiguousarray(corners[np.isfinite(corners).all(axis=1)])


def sample_surface(corners: Floats, n: int) -> Floats:
    """``(n, 3)`` points spread evenly over the area of triangles ``(m, 9)``; the same every time [m]."""
    points: Floats = spread_points(corners.reshape(-1, 3, 3), np.array([0, len(corners)]), n).points[0]
    return points


def deviation(points: Floats, corners: Floats) -> float:
    """Root mean square distance of points ``(n, 3)`` from a surface of triangles ``(m, 9)`` [m]."""
    squares = np.empty(len(points))
    _squared_distances(np.ascontiguousarray(points), corners, squares)
    return float(np.sqrt(squares.mean()))


@compiled
def _squared_distances(points: Floats, corners: Floats, squares: Floats) -> None:
    """Least squared distance of each point from any triangle, by the regions of Ericson 2005, section 5.1.5."""
    squares[:] = np.inf
    for f in range(len(corners)):
        ax, ay, az = corners[f, 0], corners[f, 1], corners[f, 2]
        bx, by, bz = corners[f, 3] - ax, corners[f, 4] - ay, corners[f, 5] - az
        cx, cy, cz = corners[f, 6] - ax, corners[f, 7] - ay, corners[f, 8] - az
        bb, cc, bc = bx * bx + by * by + bz * bz, cx * cx + cy * cy + cz * cz, bx * cx + by * cy + bz * cz
        det = bb * cc - bc * bc
        for k in range(len(points)):
            px, py, pz = points[k, 0] - ax, points[k, 1] - ay, points[k, 2] - az
            pb, pc = px * bx + py * by + pz * bz, px * cx + py * cy + pz * cz
            s, t = (cc * pb - bc * pc) / det, (bb * pc - bc * pb) / det
            if not (det > 0.0 and s >= 0.0 and t >= 0.0 and s + t <= 1.0):
                best, s, t = np.inf, 0.0, 0.0
                # Outside: the nearest point lies on one of the three sides.
                for side in range(3):
                    if side == 0:
                        u = min(1.0, max(0.0, pb / bb)) if bb > 0.0 else 0.0
                        i, j = u, 0.0
                    elif side == 1:
                        u = min(1.0, max(0.0, pc / cc)) if cc > 0.0 else 0.0
                        i, j = 0.0, u
                    else:
                        ee = bb + cc - 2.0 * bc
                        u = min(1.0, max(0.0, (pc - pb + bb - bc) / ee)) if ee > 0.0 else 0.0
                        i, j = 1.0 - u, u
                    x, y, z = px - i * bx - j * cx, py - i * by - j * cy, pz - i * bz - j * cz
                    d = x * x + y * y + z * z
                    if d < best:
                        best, s, t = d, i, j
            x, y, z = px - s * bx - t * cx, py - s * by - t * cy, pz - s * bz - t * cz
            squares[k] = min(squares[k], x * x + y * y + z * z)
