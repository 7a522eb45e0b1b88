"""How one shape comes to different triangles: rows, fans, missing caps, loose and broken triangles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from cadgraph.model.scene import Floats
from cadplants.model.plant import Assembly, Component
from cadplants.solids.mesh_ops import Solid
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["broken", "doubled", "fanned", "in_rows", "quartered", "retold", "shuffled", "uncapped"]

_MOST_TRIANGLES = 20_000  # of one mesh in rows; beyond it the rows stay wider
_PIPES = ("pipe", "elbow", "hose", "conduit", "cable")


def retold(assembly: Assembly, style: ModelingStyle, seed: int) -> Assembly:
    """The assembly with the triangles that this hand's program makes of its shapes.

    Args:
        assembly: as built.
        style: ``capped``, ``fans``, ``rows``, ``soup`` and ``cracks`` are used.
        seed: which meshes are broken.
    """
    if style.capped and not style.fans and not style.rows and not style.soup and not style.cracks:
        return assembly
    rng = np.random.default_rng([seed, 10])
    made: dict[tuple[int, bool], Solid] = {}
    components = []
    for component in assembly.components:
        bare = not style.capped and component.name in _PIPES
        key = (id(component.solid), bare)
        if key not in made:
            made[key] = _told(component.solid, style, bare)
        components.append(_spoilt(component, made[key], style, rng))
    return replace(assembly, components=tuple(components))


def _told(solid: Solid, style: ModelingStyle, bare: bool) -> Solid:
    if bare:
        solid = uncapped(solid)
    elif style.fans:
        solid = fanned(solid)
    return in_rows(solid, style.rows) if style.rows else solid


def _spoilt(component: Component, solid: Solid, style: ModelingStyle, rng: np.random.Generator) -> Component:
    flaws = component.flaws
    soup, crack = rng.random(2)
    if crack < style.cracks:
        solid, flaws = broken(solid, rng), (*flaws, "cracked")
    if soup < style.soup:
        corners = solid.vertices[solid.faces.reshape(-1)]
        solid = Solid(corners, np.arange(len(corners), dtype=np.int32).reshape(-1, 3))
        flaws = (*flaws, "soup")
    return replace(component, solid=solid, flaws=flaws)


def _poles(solid: Solid) -> npt.NDArray[np.int64]:
    """Corners in the middle of a flat face: all their triangles lie in one plane, round them."""
    a, b, c = np.moveaxis(solid.vertices[solid.faces], 1, 0)
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = normals / np.where(lengths > 0, lengths, 1)
    n = len(solid.vertices)
    valence = np.bincount(solid.faces.reshape(-1), minlength=n)
    total = np.zeros((n, 3))
    for k in range(3):
        np.add.at(total, solid.faces[:, k], normals)
    flat = np.linalg.norm(total, axis=1) > valence * (1 - 1e-9)
    return np.flatnonzero(flat & (valence >= 5))


def _rings(solid: Solid) -> list[tuple[npt.NDArray[np.bool_], list[int]]]:
    """For each pole with a closed round of corners about it: its triangles and those corners in order."""
    rings = []
    for pole in _poles(solid):
        mine = (solid.faces == pole).any(axis=1)
        following = {}
        for face in solid.faces[mine]:
            k = int(np.flatnonzero(face == pole)[0])
            following[int(face[(k + 1) % 3])] = int(face[(k + 2) % 3])
        first = min(following)
        ring = [first]
        while following.get(ring[-1], first) != first and len(ring) <= len(following):
            ring.append(following[ring[-1]])
        if len(ring) == len(following) == int(mine.sum()) and following.get(ring[-1]) == first:
            rings.append((mine, ring))
    return rings


def fanned(solid: Solid) -> Solid:
    """Round caps fanned from a corner of their rim instead of from their middle."""
    keep = np.ones(len(solid.faces), bool)
    extra = []
    for mine, ring in _rings(solid):
        if not _convex(solid.vertices[ring]):
            continue
        keep &= ~mine
        extra += [(ring[0], ring[k], ring[k + 1]) for k in range(1, len(ring) - 1)]
    if not extra:
        return solid
    return _compact(solid.vertices, np.concatenate([solid.faces[keep], np.array(extra, np.int32)]))


def _convex(corners: Floats) -> bool:
    edges = np.roll(corners, -1, axis=0) - corners
    turns = np.cross(edges, np.roll(edges, -1, axis=0))
    way = turns.sum(axis=0)
    return bool((turns @ way > 0).all())


def uncapped(solid: Solid) -> Solid:
    """Without the flat round faces that close it."""
    keep = np.ones(len(solid.faces), bool)
    for mine, _ in _rings(solid):
        keep &= ~mine
    return _compact(solid.vertices, solid.faces[keep]) if keep.any() and not keep.all() else solid


def _compact(vertices: Floats, faces: npt.NDArray[np.int32]) -> Solid:
    used, inverse = np.unique(faces, return_inverse=True)
    return Solid(vertices[used], inverse.reshape(-1, 3).astype(np.int32))


def in_rows(solid: Solid, step: float) -> Solid:
    """The same surface with no edge much longer than ``step`` [m]; closed solids stay closed."""
    vertices, faces = solid.vertices, solid.faces.astype(np.int64)
    for _ in range(6):
        if len(faces) > _MOST_TRIANGLES // 3:
            break
        edges = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2)
        edges.sort(axis=2)
        keys, which = np.unique(edges[..., 0].ravel() * len(vertices) + edges[..., 1].ravel(), return_inverse=True)
        pairs = np.column_stack(np.divmod(keys, len(vertices)))
        long = np.linalg.norm(vertices[pairs[:, 0]] - vertices[pairs[:, 1]], axis=1) > 1.5 * step
        if not long.any():
            break
        middle = np.where(long, len(vertices) + np.cumsum(long) - 1, -1)
        vertices = np.concatenate([vertices, vertices[pairs[long]].mean(axis=1)])
        faces = _split(faces, middle[which.reshape(-1)].reshape(-1, 3))
    return Solid(vertices, faces.astype(np.int32))


def _split(faces: npt.NDArray[np.int64], middle: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    """Triangles cut at the middles of their edges; -1 where an edge stays whole."""
    marked = middle >= 0
    count = marked.sum(axis=1)
    out = [faces[count == 0]]
    # Turned so that the first edge is marked, and of two marked ones the second too.
    first = np.where(count == 2, (np.argmin(marked, axis=1) + 1) % 3, np.argmax(marked, axis=1))
    turn = (first[:, None] + np.arange(3)) % 3
    f, m = np.take_along_axis(faces, turn, 1), np.take_along_axis(middle, turn, 1)
    a, b, c, p, q, r = (*f.T, *m.T)
    one, two, three = count == 1, count == 2, count == 3

    def add(mask: npt.NDArray[np.bool_], *corners: npt.NDArray[np.int64]) -> None:
        out.append(np.column_stack([corner[mask] for corner in corners]))

    add(one, a, p, c)
    add(one, p, b, c)
    add(two, p, b, q)
    add(two, a, p, q)
    add(two, a, q, c)
    add(three, a, p, r)
    add(three, p, b, q)
    add(three, r, q, c)
    add(three, p, q, r)
    return np.concatenate(out)


def broken(solid: Solid, rng: np.random.Generator) -> Solid:
    """Without some of its triangles, with some twice and some turned over."""
    n = len(solid.faces)
    keep = rng.random(n) > rng.uniform(0, 0.04)
    if keep.sum() < 4:
        return solid
    faces = solid.faces[keep]
    twice = faces[rng.random(len(faces)) < 0.02]
    flip = rng.random(len(faces)) < rng.choice([0.0, 0.02])
    faces = np.where(flip[:, None], faces[:, ::-1], faces)
    return _compact(solid.vertices, np.concatenate([faces, twice]).astype(np.int32))


def quartered(components: Sequence[Component]) -> list[Component]:
    """The components with each triangle cut into four at the middles of its edges; repeats still share their shape."""
    made: dict[int, Solid] = {}
    for component in components:
        solid = component.solid
        if id(solid) not in made:
            made[id(solid)] = _in_four(solid)
    return [replace(component, solid=made[id(component.solid)]) for component in components]


def _in_four(solid: Solid) -> Solid:
    faces = solid.faces.astype(np.int64)
    edges = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=2), axis=2)
    pairs, which = np.unique(edges.reshape(-1, 2), axis=0, return_inverse=True)
    vertices = np.concatenate([solid.vertices, solid.vertices[pairs].mean(axis=1)])
    middle = len(solid.vertices) + which.reshape(-1, 3)
    return Solid(vertices, _split(faces, middle).astype(np.int32))


def shuffled(components: Sequence[Component], rng: np.random.Generator) -> list[Component]:
    """The components with their corners and triangles in another order; repeats still share their shape."""
    made: dict[int, Solid] = {}
    for component in components:
        solid = component.solid
        if id(solid) not in made:
            order = rng.permutation(len(solid.vertices))
            place = np.empty_like(order)
            place[order] = np.arange(len(order))
            faces = place[solid.faces[rng.permutation(len(solid.faces))]]
            turn = (rng.integers(3, size=len(faces))[:, None] + np.arange(3)) % 3
            made[id(solid)] = Solid(solid.vertices[order], np.take_along_axis(faces, turn, 1).astype(np.int32))
    return [replace(component, solid=made[id(component.solid)]) for component in components]


def doubled(components: Sequence[Component], share: float, rng: np.random.Generator) -> list[Component]:
    """The components, some of which have all their triangles twice, on corners of their own every other time.

    Args:
        components: in order.
        share: of them.
        rng: of which.
    """
    changed = list(components)
    for k, i in enumerate(np.sort(rng.permutation(len(changed))[: round(share * len(changed))])):
        one = changed[i]
        vertices, faces = one.solid.vertices, one.solid.faces
        again = faces + np.int32(len(vertices) * (k % 2))
        solid = Solid(np.concatenate([vertices] * (1 + k % 2)), np.concatenate([faces, again]))
        changed[i] = replace(one, solid=solid, flaws=(*one.flaws, "doubled"))
    return changed
