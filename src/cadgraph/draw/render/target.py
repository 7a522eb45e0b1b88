"""Where to look at one mesh from, among all the others: the directions in which it is really visible.

For each of 64 directions rays go from where the camera would be to points spread evenly over the mesh's area; a point
counts as seen where its ray meets no other mesh before this one. Three directions at least 50 degrees apart are taken.
Where too little is seen, what stands in the way is cut away.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from cadgraph.draw.render.camera import FIELD_OF_VIEW, Camera, frame
from cadgraph.draw.render.caster import Caster
from cadgraph.draw.render.raster import favour
from cadgraph.model.scene import Floats, Ints, Scene, mesh_of_face, mesh_of_vertex

__all__ = ["APART", "Target", "View", "choose_views", "end_box", "steady"]

Bools = npt.NDArray[np.bool_]

APART = math.radians(50.0)
"""Least angle between two of the views."""

_N_DIRECTIONS, _N_POINTS = 64, 128  # design study: 0.987 correlation with the exact visible share
_LEAST_SHARE = 0.18  # of the points that must be seen; below, nobody can say what it is, and a cutaway shows more
_FILL = 0.75  # of the picture, that the mesh takes in a close view
_WIDE = (8.0, 1.5, 0.8)  # a wide view frames 8 extents, for small parts, or 1.5 extents and 0.8 m, for larger ones
_GOOD_ENOUGH = 2.7  # of three directions, the share of a section that is seen: no other section is tried
_DENSER = 8  # times as many points on slender meshes, so that a section still has some
_SLENDER, _SECTION = 10.0, 7.0  # longer than this many widths, close views show a section of so many widths
_END = 5.0  # widths of the end of a slender mesh that close views show
_END_SEEN = 1.2  # of three directions, the share of an end that has to be seen; below, a section is sought
_END_TURN = (0.25, 0.85)  # cosine between the view and the axis of a slender mesh: the end's face and its sides show
_END_BONUS = 1.6
_ROUND = 0.08  # extents that differ less are those of something round
_SAME_TURN, _REPEATED = 0.3, 0.7  # cosines to the axis of what is round that differ less show the same: worth less
_HAIR = 6e-5  # [m]
_EDGE_ON = 0.5  # of the greatest area that it could show: if no view shows more, one is a cutaway that does
_NEARER = 0.75  # of the supposed distance: nearer than that, a camera may see what the rays did not
_FRAME_POINTS = 3000
_MOST_LAYERS = 10  # of meshes one behind the other that a cutaway may take away
_BLOCKING = 0.03  # share of the rays; what hides less stays in a cutaway
_FIRST_CHOICES = 6
_GOLDEN = math.pi * (3 - math.sqrt(5))


@dataclass(frozen=True)
class View:
    """One look at a mesh.

    Args:
        camera: where from.
        visible: share of the mesh's surface points that are in sight, 0..1, once ``hidden`` is away.
        hidden: meshes that are cut away for this view, ascending.
        wide: whether it steps back to show the surroundings.
        section: whether it shows only a section of a long mesh.
        span: width of the picture at the mesh [m].
        end: whether this section is an end of it.
    """

    camera: Camera
    visible: float
    hidden: tuple[int, ...] = ()
    wide: bool = False
    section: bool = False
    span: float = 0.0
    end: bool = False

    @property
    def depth(self) -> float:
        """Of what it is to show, along the viewing direction [m]."""
        return self.span / (self.camera.pixel_size * self.camera.width)

    @property
    def direction(self) -> Floats:
        """``(3,)`` unit vector from the mesh towards the camera."""
        return -self.camera.forward


@dataclass(frozen=True)
class Target:
    """A mesh and what the views of it need.

    Args:
        mesh: its index.
        points: ``(n, 3)`` spread evenly over its area [m].
        normals: ``(n, 3)`` unit.
        vertices: ``(m, 3)`` enough of its vertices to frame it by [m].
        axes: ``(3, 3)`` principal axes as rows, the longest extent first.
        extents: ``(3,)`` along them [m].
    """

    mesh: int
    points: Floats
    normals: Floats
    vertices: Floats
    axes: Floats
    extents: Floats

    @classmethod
    def of(cls, scene: Scene, mesh: int, n_points: int = _N_POINTS) -> Target:
        """Samples a mesh; the same every time.

        Raises:
            ValueError: none of its triangles has an area.
        """
        vertices, faces = scene.mesh(mesh)
        corners = vertices[faces]
        double = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        area = np.sqrt((double * double).sum(axis=1))
        area = np.where(np.isfinite(area), area, 0.0)
        total = np.cumsum(area)
        if not len(total) or not total[-1] > 0:
            raise ValueError(f"{scene.paths[mesh]} can't be looked at: none of its triangles has an area")
        face = np.searchsorted(total, (np.arange(n_points) + 0.5) / n_points * total[-1], side="right")
        face = np.minimum(face, len(total) - 1)
        k = np.arange(n_points)
        # Within a face, the plastic number spreads points (Roberts 2018, R2 sequence); folded into the triangle.
        u, v = (0.5 + k * 0.7548776662466927) % 1.0, (0.5 + k * 0.5698402909980532) % 1.0
        fold = u + v > 1
        u, v = np.where(fold, 1 - u, u)[:, None], np.where(fold, 1 - v, v)[:, None]
        t = corners[face]
        points = t[:, 0] + u * (t[:, 1] - t[:, 0]) + v * (t[:, 2] - t[:, 0])
        used = vertices[np.unique(faces[area > 0])]
        axes, extents = _principal(corners[area > 0], area[area > 0], used)
        if n_points < _DENSER * _N_POINTS and _is_slender(extents):
            return cls.of(scene, mesh, _DENSER * n_points)
        return cls(mesh, points, double[face] / area[face, None], _outer(used), axes, extents)

    def only(self, kept: Ints | slice) -> Target:
        """The same mesh with some of the points."""
        return replace(self, points=self.points[kept], normals=self.normals[kept])


def choose_views(scene: Scene, target: Target, size: tuple[int, int] = (512, 512)) -> tuple[View, View, View]:
    """Three views of a mesh: two close ones and a wide one, pairwise at least 50 degrees apart.

    Args:
        scene: all meshes that may stand in the way.
        target: the mesh.
        size: width and height of the pictures [px].

    Returns:
        The views, the wide one last.
    """
    directions = _DIRECTIONS
    whole = target.vertices
    sight = far = _Sight(_Obstacles(scene, target), target)
    near, section = whole, _is_slender(target.extents)
    outward: Floats | None = None
    if section:
        far = _Sight(sight.obstacles, target.only(slice(None, None, _DENSER)))
        sight, near, outward = _focus(sight, directions)
    share = sight.seen(near, directions, _FILL).mean(axis=1)
    ahead = np.abs(directions @ sight.target.normals.T).sum(axis=1)
    worth = (0.35 + 0.65 * ahead / ahead.max()) * _NATURAL
    if outward is not None:
        turned = directions @ outward
        worth = worth * np.where((turned > _END_TURN[0]) & (turned < _END_TURN[1]), _END_BONUS, 1.0)
    open_air = ~sight.covered(near, directions, _FILL)
    score = np.where(share >= _LEAST_SHARE, share * worth * np.where(open_air, 1.0, 0.8), 0.0)
    axis = None if section else _round_axis(target)
    along = None if axis is None else np.round(directions @ axis, 9)
    chosen = _spread(score, along=along)
    hidden: dict[int, tuple[int, ...]] = {}
    if len(chosen) == 3 and not section and ahead[chosen].max() < _EDGE_ON * ahead.max():
        # A gasket between its flanges shows its rim from everywhere; one look at its face is worth a cutaway.
        chosen = chosen[:2]
    if len(chosen) < 3:
        blockers = sight.blockers(sight.eyes(near, directions, _FILL))
        fewer = worth**2 / (1 + 0.2 * np.array([len(b) for b in blockers]))
        for direction in _spread(fewer, chosen, along)[len(chosen) :]:
            chosen.append(direction)
            hidden[direction] = blockers[direction]
    order = _wide_last(far, chosen, directions, share, hidden)
    views = []
    for place, direction in enumerate(order):
        wide = place == 2
        shown = whole if wide or not section else near
        fill = _wide_fill(target) if wide else _FILL
        rays = far if wide else sight
        camera = _framed(rays, shown, directions[direction], size, fill)
        out: tuple[int, ...] = ()
        visible = float(rays.seen_from(camera.eye[None]).mean())
        if direction in hidden or visible < _LEAST_SHARE:
            # Anew from where the camera really is: from further away more stands in the way.
            out = rays.blockers(camera.eye[None])[0]
            visible = float(rays.seen_from(camera.eye[None], out).mean())
        depth = float(((shown.min(axis=0) + shown.max(axis=0)) / 2 - camera.eye) @ camera.forward)
        part = section and not wide
        span = camera.pixel_size * depth * size[0]
        views.append(View(camera, visible, out, wide, part, span, part and outward is not None))
    return views[0], views[1], views[2]


class _Obstacles:
    """What may stand before a target, and the target itself, to cast rays at.

    Only what a ray meets within a distance is asked, and how far away, which doesn't depend on how the tree was built.
    Which of two meshes is met first does where their surfaces coincide: so each is moved by a hair of its own.
    """

    def __init__(self, scene: Scene, target: Target) -> None:
        self._target = target.mesh
        vertices = scene.mesh(target.mesh)[0]
        self.slack = favour(vertices[np.isfinite(vertices).all(axis=1)])
        index = np.arange(1, scene.n_meshes + 1)[:, None]
        hair = (index * np.array([0.8191725134, 0.6710436067, 0.5497004779]) % 1.0 - 0.5) * _HAIR
        self._scene = scene.with_vertices(scene.vertices + hair[mesh_of_vertex(scene)])
        self.own = Caster(scene, [target.mesh])
        self.mesh_of_face = mesh_of_face(scene).astype(np.int32)
        faces = scene.global_faces()
        sound = np.isfinite(scene.vertices[faces]).all(axis=(1, 2))
        there = np.bincount(self.mesh_of_face[sound], minlength=scene.n_meshes) > 0
        there[target.mesh] = False
        self._others = np.flatnonzero(there)
        self.others = self._caster(self._others)

    def without(self, hidden: tuple[int, ...]) -> Caster | None:
        """What casts rays at the others once some are away; None where none is left."""
        return self._caster(self._others[~np.isin(self._others, hidden)]) if hidden else self.others

    def _caster(self, meshes: Ints) -> Caster | None:
        return Caster(self._scene, meshes) if len(meshes) else None


class _Sight:
    """Rays from would-be cameras to the points of a target."""

    def __init__(self, obstacles: _Obstacles, target: Target) -> None:
        self.obstacles, self.target = obstacles, target

    def eyes(self, shown: Floats, directions: Floats, fill: float) -> Floats:
        """``(n, 3)`` where cameras would stand that show some points in so large a share of the picture."""
        middle = (shown.min(axis=0) + shown.max(axis=0)) / 2
        radius = float(np.sqrt(((shown - middle) ** 2).sum(axis=1).max()))
        away: Floats = middle + directions * (radius / (fill * math.tan(FIELD_OF_VIEW / 2)))
        return away

    def seen(self, shown: Floats, directions: Floats, fill: float) -> Bools:
        """``(n_directions, n_points)`` which points are in sight."""
        return self.seen_from(self.eyes(shown, directions, fill))

    def seen_from(self, eyes: Floats, hidden: tuple[int, ...] = ()) -> Bools:
        """``(n_eyes, n_points)`` on which rays no other mesh stands before the target, once some are away."""
        others = self.obstacles.without(hidden)
        start, towards, reach = self._rays(eyes)
        if others is None:
            return np.ones((len(eyes), len(self.target.points)), bool)
        seen: Bools = ~others.blocked(others.local(start), towards, reach)
        return seen.reshape(len(eyes), -1)

    def covered(self, shown: Floats, directions: Floats, fill: float) -> Bools:
        """``(n_directions,)`` whether something lies behind the camera: it stands under or within another mesh."""
        others = self.obstacles.others
        if others is None:
            return np.zeros(len(directions), bool)
        eyes = others.local(self.eyes(shown, directions, fill))
        return others.blocked(eyes, directions.astype(np.float32), np.full(len(eyes), 2 * others.diagonal, np.float32))

    def blockers(self, eyes: Floats) -> list[tuple[int, ...]]:
        """For each eye the meshes that stand before the target for more than a few rays, ascending."""
        others = self.obstacles.others
        counts: list[dict[int, int]] = [{} for _ in eyes]
        if others is None:
            return [() for _ in eyes]
        world, towards, reach = self._rays(eyes)
        start, n = others.local(world), len(self.target.points)
        active = np.arange(len(towards))
        reached = np.zeros(len(towards), np.float32)
        step = np.float32(max(2e-6 * others.diagonal, 1e-5))
        for _ in range(_MOST_LAYERS):
            found = others.first(start[active] + towards[active] * reached[active, None], towards[active])
            reached[active] += found.distance + step
            going = (found.face >= 0) & (reached[active] < reach[active])
            active = active[going]
            if not len(active):
                break
            mesh = self.obstacles.mesh_of_face[found.face[going]]
            pairs, times = np.unique(np.stack([active // n, mesh]), axis=1, return_counts=True)
            for (direction, other), count in zip(pairs.T.tolist(), times.tolist(), strict=True):
                counts[direction][other] = counts[direction].get(other, 0) + count
        return [tuple(sorted(m for m, count in each.items() if count > _BLOCKING * n)) for each in counts]

    def _rays(self, eyes: Floats) -> tuple[Floats, npt.NDArray[np.float32], npt.NDArray[np.float32]]:
        """Starts, directions, and how far each ray is free if the target is seen on it [m]."""
        towards = self.target.points[None] - eyes[:, None]
        length = np.sqrt((towards * towards).sum(axis=2))
        towards /= np.maximum(length, 1e-12)[..., None]
        start = np.repeat(eyes, len(self.target.points), axis=0)
        rays = towards.reshape(-1, 3).astype(np.float32)
        own = self.obstacles.own
        met = own.first(own.local(start), rays)
        reach = np.where(met.face >= 0, np.minimum(met.distance, length.reshape(-1)), length.reshape(-1))
        return start, rays, np.maximum(reach - self.obstacles.slack, 0.0).astype(np.float32)


def _framed(sight: _Sight, shown: Floats, direction: Floats, size: tuple[int, int], fill: float) -> Camera:
    """A camera as far away as the rays supposed, whatever side of a long mesh it looks at: with a longer lens."""
    margin = (1 - fill) / 2
    camera = frame(shown, direction, size, margin=margin)
    middle = (shown.min(axis=0) + shown.max(axis=0)) / 2
    supposed = float(np.linalg.norm(sight.eyes(shown, direction[None], fill)[0] - middle))
    found = float(np.linalg.norm(camera.eye - middle))
    if found < _NEARER * supposed:
        view = 2 * math.atan(math.tan(FIELD_OF_VIEW / 2) * found / supposed)
        camera = frame(shown, direction, size, margin=margin, field_of_view=view)
    return steady(camera)


def steady(camera: Camera) -> Camera:
    """The camera without the last digits, which may differ from one library of linear algebra to another."""
    eye, axes = np.round(camera.eye, 6), [np.round(a, 9) for a in (camera.right, camera.up, camera.forward)]
    return replace(
        camera, eye=eye, right=axes[0], up=axes[1], forward=axes[2], half_height=round(camera.half_height, 9)
    )


def _is_slender(extents: Floats) -> bool:
    """Whether a mesh of these extents is so long that a picture of all of it shows little more than a line."""
    return bool(extents[0] >= _SLENDER * max(float(extents[1]), 1e-6))


def end_box(target: Target, sign: int, widths: float) -> Floats:
    """``(8, 3)`` corners of a box round an end of a mesh, the one that lies towards ``sign`` along its longest axis."""
    axis, wide = target.axes[0], max(float(target.extents[1]), 1e-6)
    along = target.vertices @ axis
    tip = float(along.max()) if sign > 0 else float(along.min())
    last = target.vertices[np.abs(along - tip) <= 0.5 * wide]
    middle = [float(last.min(axis=0) @ a + last.max(axis=0) @ a) / 2 for a in target.axes[1:]]
    corners = [
        (tip - sign * inner) * axis + (middle[0] + s * wide / 2) * target.axes[1]
        + (middle[1] + t * max(float(target.extents[2]), 1e-6) / 2) * target.axes[2]
        for inner in (0.0, widths * wide) for s in (-1, 1) for t in (-1, 1)
    ]  # fmt: skip
    return np.array(corners)


def _focus(sight: _Sight, directions: Floats) -> tuple[_Sight, Floats, Floats | None]:
    """An end of a slender mesh that can be seen well, or else a section.

    Returns:
        Rays to its points only, the corners of its box, and the direction that the end faces (None for a section).
    """
    target = sight.target
    wide = max(float(target.extents[1]), 1e-6)
    axis = target.axes[0]
    along = target.points @ axis
    low, high = float(along.min()), float(along.max())

    def judged(near: Ints, box: Floats, facing: Bools) -> tuple[float, _Sight]:
        near = near[:: -(-len(near) // _N_POINTS)]
        local = _Sight(sight.obstacles, target.only(near))
        seen = local.seen(box, directions[facing], _FILL).mean(axis=1)
        return round(float(np.sort(seen)[-3:].sum()), 6), local

    best, chosen, shown = -1.0, sight, target.vertices
    outward: Floats | None = None
    for sign, tip in ((-1, low), (1, high)):
        near = np.flatnonzero(np.abs(along - tip) <= _END * wide)
        turned = directions @ (sign * axis)
        if len(near):
            box = end_box(target, sign, _END)
            score, local = judged(near, box, (turned > _END_TURN[0]) & (turned < _END_TURN[1]))
            if score > best + 0.05:
                best, chosen, shown, outward = score, local, box, sign * axis
    if best > _END_SEEN:
        return chosen, shown, outward
    half = _SECTION * wide / 2
    for share in (0.5, 0.3, 0.7, 0.12, 0.88):
        nearest = target.points[int(np.argmin(np.abs(along - (low + share * (high - low)))))]
        near = np.flatnonzero(np.abs(along - nearest @ axis) <= half)
        if not len(near):
            continue
        ends = nearest + half * np.array([[-1.0], [1.0]]) * axis
        box = np.concatenate([ends + s * wide / 2 * a for a in target.axes[1:] for s in (-1, 1)])
        every_fourth = np.arange(len(directions)) % 4 == 0
        score, local = judged(near, box, every_fourth)
        if score > best + 0.05:
            best, chosen, shown, outward = score, local, box, None
        if best > _GOOD_ENOUGH:
            break
    return chosen, shown, outward


def _wide_fill(target: Target) -> float:
    extent = max(float(np.linalg.norm(target.extents)) / math.sqrt(2), float(target.extents[0]), 1e-6)
    times, share, room = _WIDE
    return extent / max(extent / _FILL, min(times * extent, share * extent + room))


def _wide_last(
    sight: _Sight, chosen: list[int], directions: Floats, share: Floats, hidden: dict[int, tuple[int, ...]]
) -> list[int]:
    """The chosen directions, last the one from which most is seen from further away."""
    index = np.array(chosen)
    wide = sight.seen(sight.target.vertices, directions[index], _wide_fill(sight.target)).mean(axis=1)
    best = int(np.argmax(np.round(wide, 6) - 2.0 * np.array([d in hidden for d in chosen])))
    order = [d for i, d in enumerate(chosen) if i != best]
    return [*sorted(order, key=lambda d: (d in hidden, -round(float(share[d]), 6), d)), chosen[best]]


def _spread(score: Floats, given: list[int] | None = None, along: Floats | None = None) -> list[int]:
    """Up to three directions of a positive score, pairwise far enough apart, of the greatest sum; ``given`` first.

    Args:
        score: ``(n_directions,)``.
        given: directions that are taken in any case.
        along: ``(n_directions,)`` cosines to the axis of what is round: two of about the same show the same.
    """
    rounded = np.round(score, 9)
    order = [int(i) for i in np.argsort(-rounded, kind="stable") if rounded[i] > 0]
    fixed = list(given or [])
    best: list[int] = fixed
    greatest = -1.0
    for first in order[:_FIRST_CHOICES] if not fixed else [-1]:
        picked = [*fixed] if first < 0 else [first]
        total = len(picked) * 10 + float(rounded[picked].sum())
        while len(picked) < 3:
            gain = np.where((_CLOSE[:, picked] == 0).all(axis=1), rounded, 0.0)
            if along is not None:
                same = (np.abs(along[:, None] - along[picked]) < _SAME_TURN).any(axis=1)
                gain = np.round(gain * np.where(same, _REPEATED, 1.0), 9)
            other = int(np.argmax(gain))
            if not gain[other] > 0:
                break
            picked.append(other)
            total += 10 + float(gain[other])
        if total > greatest + 1e-9:
            best, greatest = picked, total
    return best


def _round_axis(target: Target) -> Floats | None:
    """``(3,)`` the axis of a mesh two of whose extents are equal, as those of a flange or a pipe are."""
    a, b, c = (float(e) for e in target.extents)
    flat, long = b > (1 - _ROUND) * a, c > (1 - _ROUND) * b
    if flat == long:
        return None
    axis: Floats = target.axes[2 if flat else 0]
    return axis


def _principal(corners: Floats, area: Floats, vertices: Floats) -> tuple[Floats, Floats]:
    """Principal axes of the surface, and the extents of the vertices along them, descending.

    Args:
        corners: ``(n, 3, 3)`` of the triangles [m].
        area: ``(n,)`` theirs, not 0.
        vertices: ``(m, 3)`` [m].
    """
    share = area / area.sum()
    about = corners - (share[:, None] * corners.mean(axis=1)).sum(axis=0)
    whole = about.sum(axis=1)
    # Second moments of a triangle: of its corners and of their sum, each with a twelfth of the area.
    moments = np.array([
        [
            (share * ((about[:, :, i] * about[:, :, j]).sum(axis=1) + whole[:, i] * whole[:, j])).sum() / 12
            for j in range(3)
        ]
        for i in range(3)
    ])  # fmt: skip
    axes = np.linalg.eigh(np.round(moments / moments.trace(), 12))[1].T
    along = vertices @ axes.T
    extents = along.max(axis=0) - along.min(axis=0)
    order = np.argsort(-np.round(extents, 6), kind="stable")
    return axes[order], extents[order]


def _outer(vertices: Floats) -> Floats:
    """At most a few thousand of the vertices, among them the outermost in many directions."""
    if len(vertices) <= _FRAME_POINTS:
        return vertices
    far = np.argmax(vertices @ _DIRECTIONS.T, axis=0)
    keep = np.unique(np.concatenate([far, np.arange(0, len(vertices), len(vertices) // _FRAME_POINTS + 1)]))
    kept: Floats = vertices[keep]
    return kept


def _lattice(n: int) -> Floats:
    """Unit vectors spread evenly over the sphere (Fibonacci lattice)."""
    k = np.arange(n)
    z = 1 - (2 * k + 1) / n
    level = np.sqrt(1 - z * z)
    directions: Floats = np.column_stack([level * np.cos(_GOLDEN * k), level * np.sin(_GOLDEN * k), z])
    return directions


_DIRECTIONS = _lattice(_N_DIRECTIONS)
_COSINES = _DIRECTIONS @ _DIRECTIONS.T
_CLOSE = np.greater(_COSINES, math.cos(APART)).astype(np.int8)
# People know things from obliquely above; straight down, and from below, they look strange.
_NATURAL = np.interp(np.degrees(np.arcsin(_DIRECTIONS[:, 2])), [-90, -25, 0, 12, 50, 90], [0.55, 0.65, 0.9, 1, 1, 0.7])
