"""Solids: closed triangle meshes made by revolving, extruding, sweeping and branching.

A *shell* is a piece of a solid's surface, maybe open; ``weld`` joins shells that share their rims into a solid.
Everything is in metres; solids of revolution are built about z and turned by ``about_x`` where they lie along a run.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from cadgraph.geometry.mesh.merge import weld_points
from cadgraph.model.scene import Floats
from cadplants.solids.polygon import triangulate

__all__ = [
    "Branch",
    "Shell",
    "Solid",
    "about_x",
    "box",
    "branched",
    "extrude",
    "lattice",
    "loft",
    "merge",
    "moved",
    "planar",
    "reverse",
    "revolve",
    "shared",
    "stack",
    "sweep",
    "tube",
    "volume",
    "weld",
]

shared = lru_cache(maxsize=1024)
"""For functions that make shapes: repeats are one ``Solid``. Each keeps its last thousand, more than a plant asks for,
so that whoever makes many plants does not keep the shapes of all."""

_WELD = 1e-9  # m; corners of shells closer than this are one


@dataclass(frozen=True, eq=False)
class Solid:
    """A triangle mesh; two placed meshes of one shape share one ``Solid``.

    Args:
        vertices: ``(n, 3)`` float64 [m].
        faces: ``(m, 3)`` int32, counter-clockwise seen from outside.
    """

    vertices: Floats
    faces: npt.NDArray[np.int32]


Shell = Solid


def _shell(vertices: npt.ArrayLike, faces: npt.ArrayLike) -> Shell:
    return Solid(np.asarray(vertices, np.float64).reshape(-1, 3), np.asarray(faces, np.int32).reshape(-1, 3))


def weld(shells: Sequence[Shell]) -> Solid:
    """Joins shells at coincident corners and drops triangles that collapse."""
    joined = merge(shells)
    first, place = weld_points(joined.vertices, _WELD)
    faces = place[joined.faces]
    keep = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    return _shell(joined.vertices[first], faces[keep])


def merge(shells: Sequence[Shell]) -> Solid:
    """Puts shells side by side into one mesh, joining nothing."""
    shifts = np.cumsum([0] + [len(shell.vertices) for shell in shells[:-1]])
    return _shell(
        np.concatenate([shell.vertices for shell in shells]),
        np.concatenate([shell.faces + shift for shell, shift in zip(shells, shifts, strict=True)]),
    )


def moved(solid: Solid, pose: Floats) -> Solid:
    """The solid placed by a 4x4 matrix; a mirroring one keeps faces outward."""
    vertices = solid.vertices @ pose[:3, :3].T + pose[:3, 3]
    faces = solid.faces if np.linalg.det(pose[:3, :3]) > 0 else solid.faces[:, ::-1]
    return _shell(vertices, faces)


def about_x(solid: Solid) -> Solid:
    """Turns what was built about z to lie along x; what pointed to y then points to z."""
    return _shell(solid.vertices[:, [2, 0, 1]], solid.faces)


def reverse(shell: Shell) -> Shell:
    """The shell with its other side outward."""
    return _shell(shell.vertices, shell.faces[:, ::-1])


def volume(solid: Solid) -> float:
    """The enclosed volume [m3] of a closed mesh; positive when its faces look outward."""
    a, b, c = np.moveaxis((solid.vertices - solid.vertices.mean(axis=0))[solid.faces], 1, 0)
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def loft(loops: Sequence[Floats], closed: bool = False) -> Shell:
    """A skin through loops of as many corners each, counter-clockwise seen against the way they follow each other.

    Args:
        loops: each ``(k, 3)``, or ``(1, 3)`` for a pole.
        closed: whether the last loop is joined to the first.
    """
    count = max(len(loop) for loop in loops)
    starts = np.cumsum([0] + [len(loop) for loop in loops])
    k = np.arange(count)
    following = (k + 1) % count
    pairs = [(i, i + 1) for i in range(len(loops) - 1)] + ([(len(loops) - 1, 0)] if closed else [])
    faces = []
    for low, high in pairs:
        if len(loops[low]) > 1:
            top = starts[high] + (following if len(loops[high]) > 1 else np.zeros_like(k))
            faces.append(np.column_stack([starts[low] + k, starts[low] + following, top]))
        if len(loops[high]) > 1:
            bottom = starts[low] + (k if len(loops[low]) > 1 else np.zeros_like(k))
            faces.append(np.column_stack([bottom, starts[high] + following, starts[high] + k]))
    return _shell(np.concatenate(loops), np.concatenate(faces))


def revolve(profile: npt.ArrayLike, sides: int, closed: bool = False, phase: float = 0.0) -> Shell:
    """A surface of revolution about z.

    Args:
        profile: ``(n, 2)`` radius and height of its points; outside lies to the right of the way they go. A radius
            of 0 makes a pole.
        sides: corners of a ring.
        closed: whether the last point is joined to the first (rings, tubes).
        phase: angle of the first corner [rad].
    """
    angles = phase + np.arange(sides) * 2 * np.pi / sides
    unit = np.column_stack([np.cos(angles), np.sin(angles)])
    loops = []
    for radius, height in np.asarray(profile, float):
        if radius == 0:
            loops.append(np.array([[0.0, 0.0, height]]))
        else:
            loops.append(np.column_stack([radius * unit, np.full(sides, height)]))
    return loft(loops, closed)


def planar(outline: Floats, holes: tuple[Floats, ...] = (), height: float = 0.0, up: bool = True) -> Shell:
    """A flat face at a height over z = 0, looking up or down, with holes."""
    flat = np.concatenate([outline, *holes])
    faces = triangulate(outline, holes)
    return _shell(np.column_stack([flat, np.full(len(flat), height)]), faces if up else faces[:, ::-1])


def extrude(outline: Floats, low: float, high: float, holes: tuple[Floats, ...] = ()) -> Solid:
    """A prism between two heights over a counter-clockwise outline, with holes right through."""
    shells = [planar(outline, holes, high), planar(outline, holes, low, up=False)]
    for ring, outside in ((outline, True), *((hole, False) for hole in holes)):
        wall = loft([np.column_stack([ring, np.full(len(ring), z)]) for z in (low, high)])
        shells.append(wall if outside else reverse(wall))
    return weld(shells)


def box(size: npt.ArrayLike, center: npt.ArrayLike = (0.0, 0.0, 0.0)) -> Solid:
    """A box with its edges along the axes."""
    x, y, z = np.asarray(size, float) / 2
    solid = extrude(np.array([[x, -y], [x, y], [-x, y], [-x, -y]]), -z, z)
    return _shell(solid.vertices + np.asarray(center, float), solid.faces)


def lattice(xs: Floats, ys: Floats, filled: npt.NDArray[np.bool_], low: float, high: float) -> Solid:
    """A flat solid over the filled cells of a grid, as gratings are.

    Args:
        xs: ``(n + 1,)`` ascending grid lines [m].
        ys: ``(m + 1,)`` likewise.
        filled: ``(n, m)`` which cells are solid; cells that meet in a corner only would not make a clean solid.
        low: underside [m].
        high: top [m].
    """
    n, m = filled.shape
    plane = (n + 1) * (m + 1)

    def corner(i: npt.NDArray[np.int64], j: npt.NDArray[np.int64], top: int) -> npt.NDArray[np.int64]:
        index: npt.NDArray[np.int64] = i * (m + 1) + j + top * plane
        return index

    def quads(a: npt.ArrayLike, b: npt.ArrayLike, c: npt.ArrayLike, d: npt.ArrayLike) -> list[npt.NDArray[np.int64]]:
        return [np.column_stack([a, b, c]), np.column_stack([a, c, d])]

    i, j = np.nonzero(filled)
    faces = quads(corner(i, j, 1), corner(i + 1, j, 1), corner(i + 1, j + 1, 1), corner(i, j + 1, 1))
    faces += quads(corner(i, j, 0), corner(i, j + 1, 0), corner(i + 1, j + 1, 0), corner(i + 1, j, 0))
    wide = np.pad(filled, 1)
    for (di, dj), (pi, pj), (qi, qj) in (
        ((-1, 0), (0, 1), (0, 0)),
        ((1, 0), (1, 0), (1, 1)),
        ((0, -1), (0, 0), (1, 0)),
        ((0, 1), (1, 1), (0, 1)),
    ):
        i, j = np.nonzero(filled & ~wide[1 + di : n + 1 + di, 1 + dj : m + 1 + dj])
        a, b = (i + pi, j + pj), (i + qi, j + qj)
        faces += quads(corner(*a, 0), corner(*b, 0), corner(*b, 1), corner(*a, 1))
    x, y = np.meshgrid(xs, ys, indexing="ij")
    flat = np.column_stack([x.ravel(), y.ravel()])
    points = np.vstack([np.column_stack([flat, np.full(plane, z)]) for z in (low, high)])
    used, compact = np.unique(np.concatenate(faces), return_inverse=True)
    return _shell(points[used], compact.reshape(-1, 3))


def stack(levels: Sequence[tuple[float, float, Floats]]) -> Solid:
    """Prisms on one axis on top of each other, as one clean solid without inner faces.

    Args:
        levels: low, high and the counter-clockwise outline ``(k, 2)`` about the axis of each, from below; where two
            follow each other one outline lies inside the other.
    """
    shells = [planar(levels[0][2], (), levels[0][0], up=False), planar(levels[-1][2], (), levels[-1][1])]
    for low, high, outline in levels:
        shells.append(loft([np.column_stack([outline, np.full(len(outline), z)]) for z in (low, high)]))
    for (_, height, below), (_, _, above) in zip(levels[:-1], levels[1:], strict=True):
        wide = np.abs(below).max() > np.abs(above).max()
        shells.append(planar(below, (above,), height) if wide else planar(above, (below,), height, up=False))
    return weld(shells)


def sweep(
    path: Floats, section: Floats, closed: bool = False, caps: bool = True, up: npt.ArrayLike | None = None
) -> Solid:
    """A section carried along a path without twist.

    Args:
        path: ``(n, 3)`` points; a closed one does not repeat its first.
        section: ``(k, 2)`` counter-clockwise outline, its x axis towards ``up``... as carried by the path.
        closed: whether the path is a loop (it must lie in a plane).
        caps: whether the ends of an open path are filled.
        up: first direction of the section's x axis; any across the path by default.
    """
    loops = _carried(path, section, closed, up)
    shells = [loft(loops, closed)]
    if caps and not closed:
        fill = triangulate(section)
        shells += [_shell(loops[0], fill[:, ::-1]), _shell(loops[-1], fill)]
    return weld(shells)


def tube(path: Floats, outer: float, inner: float, sides: int) -> Solid:
    """A round pipe along a path, hollow unless ``inner`` is 0 [m]."""
    angles = np.arange(sides) * 2 * np.pi / sides
    unit = np.column_stack([np.cos(angles), np.sin(angles)])
    outside = _carried(path, outer * unit, False, None)
    if inner <= 0:
        poles = [path[:1], path[-1:]]
        return weld([loft([poles[0], *outside, poles[1]])])
    inside = _carried(path, inner * unit, False, None)
    return weld([loft([*outside, *inside[::-1]], closed=True)])


def _carried(path: Floats, section: Floats, closed: bool, up: npt.ArrayLike | None) -> list[Floats]:
    """The section at each point of the path, in the plane that halves the angle of its two legs."""
    path = np.asarray(path, float)
    legs = np.diff(path, axis=0, append=path[:1] if closed else path[-1:])
    if not closed:
        legs = legs[:-1]
    legs = legs / np.linalg.norm(legs, axis=1, keepdims=True)
    before = np.vstack([legs[-1:] if closed else legs[:1], legs if not closed else legs[:-1]])
    after = legs if closed else np.vstack([legs, legs[-1:]])
    tangents = before + after
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    side = _across(before[0]) if up is None else np.asarray(up, float)
    loops = []
    for point, back, tangent in zip(path, before, tangents, strict=True):
        side = side - back * (side @ back)
        side /= np.linalg.norm(side)
        other = np.cross(back, side)
        corners = section[:, :1] * side + section[:, 1:] * other
        # Sliding along the leg before onto the mitre plane keeps straight legs exact prisms.
        loops.append(point + corners - np.outer(corners @ tangent / (back @ tangent), back))
        side = _turned(side, back, tangent)
    return loops


def _turned(side: Floats, back: Floats, tangent: Floats) -> Floats:
    """The side vector after the path has turned from ``back`` to its mirror image about ``tangent``."""
    forward = 2 * (back @ tangent) * tangent - back
    axis = np.cross(back, forward)
    sine, cosine = np.linalg.norm(axis), float(back @ forward)
    if sine < 1e-12:
        return side
    axis = axis / sine
    turned: Floats = side * cosine + np.cross(axis, side) * sine + axis * (axis @ side) * (1 - cosine)
    return turned


def _across(direction: Floats) -> Floats:
    """A unit vector across a direction: level where there is one."""
    side = np.cross([0.0, 0.0, 1.0], direction)
    if np.linalg.norm(side) < 1e-6:
        side = np.array([1.0, 0.0, 0.0])
    unit: Floats = side / np.linalg.norm(side)
    return unit


@dataclass(frozen=True)
class Branch:
    """A round branch out of a surface of revolution.

    Args:
        height: where its axis leaves the main one [m].
        angle: around the main axis [rad]; a multiple of the main ring's step.
        radius: of the branch where it leaves [m]; less than the main radius there.
        profile: radius and distance from the main axis of what follows [m]; a last radius of 0 closes it.
    """

    height: float
    angle: float
    radius: float
    profile: tuple[tuple[float, float], ...]


def branched(
    profile: npt.ArrayLike, sides: int, branches: Sequence[Branch], rings: int = 2, long: bool = False
) -> tuple[Shell, list[Floats]]:
    """A surface of revolution with branches that grow out of it without inner faces.

    Args:
        profile: ``(n, 2)`` radius and height, heights ascending where a branch leaves.
        sides: corners of a ring, a multiple of 4.
        branches: apart from each other.
        rings: loops between the cut in the main grid and the branch.
        long: whether each side of the main surface, which must be a cylinder, goes from end to end in long triangles.

    Returns:
        The shell, and each branch's last loop ``(k, 3)``.
    """
    points = np.asarray(profile, float)
    for branch in branches:
        reach = branch.radius * 1.12
        for height in np.linspace(branch.height - reach, branch.height + reach, 5):
            points = _with_height(points, height)
    step = 2 * np.pi / sides
    cut = np.zeros((len(points) - 1, sides), bool)
    shells, ends = [], []
    for branch in branches:
        reach = branch.radius * 1.12
        rows = np.flatnonzero(np.abs(points[:, 1] - branch.height) <= reach + 1e-9)
        low, high = int(rows[0]), int(rows[-1])
        middle = round(branch.angle / step)
        spread = np.arcsin(min(1.0, branch.radius / points[low : high + 1, 0].min()))
        half = int(np.ceil(spread / step + 0.25))
        columns = np.arange(middle - half, middle + half + 1)
        cut[low:high, columns[:-1] % sides] = True
        shell, end = _branch_shell(points, branch, low, high, columns, step, rings)
        shells.append(shell)
        ends.append(end)
    angles = np.arange(sides) * step
    grid = np.stack(
        [points[:, :1] * np.cos(angles), points[:, :1] * np.sin(angles), np.repeat(points[:, 1:], sides, axis=1)],
        axis=2,
    )
    if long:
        faces = _long_columns(cut)
    else:
        row, column = np.nonzero(~cut)
        a, b = row * sides + column, row * sides + (column + 1) % sides
        faces = np.concatenate([np.column_stack([a, b, b + sides]), np.column_stack([a, b + sides, a + sides])])
    used, faces = np.unique(faces, return_inverse=True)
    return weld([_shell(grid.reshape(-1, 3)[used], faces), *shells]), ends


def _long_columns(cut: npt.NDArray[np.bool_]) -> npt.NDArray[np.int64]:
    """The cells of a grid that are not cut out, a column's as few triangles; corners only where a cut needs them."""
    sides = cut.shape[1]
    faces = []
    for column in range(sides):
        whole = np.flatnonzero(~cut[:, column])
        for some in np.split(whole, np.flatnonzero(np.diff(whole) > 1) + 1):
            low, high = int(some[0]), int(some[-1]) + 1
            edges = []
            for corner, beside in ((column, column - 1), ((column + 1) % sides, (column + 1) % sides)):
                inner = [r for r in range(low + 1, high) if cut[r - 1, beside] or cut[r, beside]]
                edges.append([r * sides + corner for r in (low, *inner, high)])
            left, right = edges
            faces += [(left[k], right[0], left[k + 1]) for k in range(len(left) - 1)]
            faces += [(left[-1], right[k], right[k + 1]) for k in range(len(right) - 1)]
    return np.array(faces, np.int64)


def _with_height(points: Floats, height: float) -> Floats:
    """The profile with a point at this height, on the line between its neighbours."""
    if np.abs(points[:, 1] - height).min() < 1e-6:
        return points
    at = int(np.flatnonzero((points[:-1, 1] < height) & (points[1:, 1] > height))[0])
    share = (height - points[at, 1]) / (points[at + 1, 1] - points[at, 1])
    radius = points[at, 0] + share * (points[at + 1, 0] - points[at, 0])
    return np.insert(points, at + 1, [radius, height], axis=0)


def _branch_shell(
    points: Floats, branch: Branch, low: int, high: int, columns: npt.NDArray[np.int64], step: float, rings: int
) -> tuple[Shell, Floats]:
    rows = np.arange(low, high + 1)
    rim = (
        [(low, c) for c in columns[:-1]]
        + [(r, columns[-1]) for r in rows[:-1]]
        + [(high, c) for c in columns[:0:-1]]
        + [(r, columns[0]) for r in rows[:0:-1]]
    )
    heights = points[[r for r, _ in rim], 1]
    turns = np.array([c for _, c in rim]) * step
    across, along = turns - branch.angle, heights - branch.height
    alpha = np.arctan2(along / np.abs(along).max(), across / np.abs(across).max())
    out = np.array([np.cos(branch.angle), np.sin(branch.angle), 0.0])
    side = np.array([-out[1], out[0], 0.0])

    def radius_at(height: Floats) -> Floats:
        span = points[low : high + 1]
        return np.asarray(np.interp(height, span[:, 1], span[:, 0]), np.float64)

    foot_heights = branch.height + branch.radius * np.sin(alpha)
    foot_turns = branch.angle + np.arcsin(np.clip(branch.radius * np.cos(alpha) / radius_at(foot_heights), -1, 1))
    loops = []
    for share in np.linspace(0, 1, rings + 1):
        z = heights + share * (foot_heights - heights)
        turn = turns + share * (foot_turns - turns)
        reach = radius_at(z)
        loops.append(np.column_stack([reach * np.cos(turn), reach * np.sin(turn), z]))
    for radius, distance in branch.profile:
        center = out * distance + np.array([0.0, 0.0, branch.height])
        if radius == 0:
            loops.append(center[None])
        else:
            ring = np.outer(np.cos(alpha), side) + np.outer(np.sin(alpha), [0.0, 0.0, 1.0])
            loops.append(center + radius * ring)
    return loft(loops), loops[-1]
