"""The primitives of an RVM file as closed triangle meshes, many at a time.

Every shape is a stack of rings of equally many corners: one ring for a cone, two for a cylinder or a box, many for a
sphere or a bend. Rings are inscribed, all ends are closed, triangles face outward.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from cadgraph.model.scene import Faces, Floats, Ints

__all__ = ["Fineness", "Layout", "coarser", "cut", "lay_out", "layouts"]

BOX, CYLINDER, SPHERE, SNOUT, PYRAMID = 2, 8, 9, 7, 1
RECTANGULAR_TORUS, CIRCULAR_TORUS, ELLIPTICAL_DISH, SPHERICAL_DISH = 3, 4, 5, 6

_MOST_SIDES = 1024  # ours: a tank of 100 m has them at a gap of half a millimetre
_COARSEST = 1.6  # [rad] four sides
_NOTHING = 1e-6  # [mm] a radius or a side below it is a point
_WHOLE_TURN = 2 * np.pi - 1e-4


class Fineness(NamedTuple):
    """How finely curves are cut.

    Args:
        gap: greatest distance between a curve and its chord [mm].
        angle: greatest angle between neighbouring chords [rad].
    """

    gap: float
    angle: float


class Layout(NamedTuple):
    """What tells the triangles of a kind of primitive, whatever its sizes.

    Args:
        kind: number of the kind in the file.
        sides: corners of a ring.
        steps: rings, or steps along a bend.
        pattern: bits for what has shrunk to a point, and for a whole turn.
    """

    kind: int
    sides: int
    steps: int
    pattern: int


def coarser(fineness: Fineness) -> Fineness | None:
    """Twice the gap and the angle; None where there is nothing to gain."""
    if fineness.angle >= _COARSEST and fineness.gap > 1e4:
        return None
    return Fineness(fineness.gap * 2, min(fineness.angle * 2, _COARSEST))


def lay_out(kind: Ints, sizes: Floats, scale: Floats, fineness: Fineness) -> Ints:
    """The layout of each primitive.

    Args:
        kind: ``(n,)`` numbers of their kinds, 1 to 9.
        sizes: ``(n, 9)`` their numbers, in the file's order [mm, rad], NaN beyond the last.
        scale: ``(n,)`` greatest factor by which their placement enlarges them.
        fineness: of curves, where they are placed.

    Returns:
        ``(n, 4)`` rows of ``Layout``.
    """
    rows = np.zeros((len(kind), 4), np.int64)
    rows[:, 0] = kind
    for number in np.unique(kind).tolist():
        own = np.flatnonzero(kind == number)
        rows[own, 1:] = np.column_stack(_LAYOUTS[number](np.abs(sizes[own]), _Curves(scale[own], fineness)))
    return rows


def cut(layout: Layout, sizes: Floats) -> tuple[Floats, Faces]:
    """Triangles of primitives with one layout.

    Args:
        layout: of all of them.
        sizes: ``(k, 9)`` as for ``lay_out``.

    Returns:
        Points ``(k, n, 3)`` [mm] about the origin of each, and the triangles ``(m, 3)`` that all have in common.
    """
    points, faces = _CUTS[layout.kind](layout, sizes)
    used, renumbered = np.unique(faces, return_inverse=True)
    if len(used) < points.shape[1]:
        points, faces = points[:, used], renumbered.reshape(-1, 3).astype(np.int32)
    return points, np.ascontiguousarray(faces)


class _Curves(NamedTuple):
    scale: Floats
    fineness: Fineness

    def step(self, radius: Floats) -> Floats:
        """Greatest angle of a chord of arcs with these radii [rad]."""
        reach = np.maximum(radius * self.scale, 1e-9)
        by_gap = 2 * np.arccos(np.clip(1 - self.fineness.gap / reach, -1, 1))
        step: Floats = np.clip(np.minimum(by_gap, self.fineness.angle), 2 * np.pi / _MOST_SIDES, np.pi / 2)
        return step

    def sides(self, radius: Floats) -> Ints:
        """Corners of whole circles: a multiple of four, so that they reach as far as the circle along both axes."""
        return 4 * np.ceil(np.pi / 2 / self.step(radius) - 1e-9).astype(np.int64)

    def steps(self, radius: Floats, angle: Floats) -> Ints:
        return np.maximum(np.ceil(angle / self.step(radius) - 1e-9), 2).astype(np.int64)


Rows = tuple[Ints, Ints, Ints]


def _flat_layout(sizes: Floats, curves: _Curves) -> Rows:
    n = len(sizes)
    return np.full(n, 4), np.full(n, 2), np.zeros(n, np.int64)


def _pyramid_layout(sizes: Floats, curves: _Curves) -> Rows:
    n = len(sizes)
    return np.full(n, 4), np.full(n, 2), (sizes[:, :4] <= _NOTHING) @ np.array([1, 2, 4, 8])


def _cylinder_layout(sizes: Floats, curves: _Curves) -> Rows:
    n = len(sizes)
    return curves.sides(sizes[:, 0]), np.full(n, 2), np.zeros(n, np.int64)


def _snout_layout(sizes: Floats, curves: _Curves) -> Rows:
    n = len(sizes)
    pattern = (sizes[:, :2] <= _NOTHING) @ np.array([1, 2])
    return curves.sides(sizes[:, :2].max(axis=1)), np.full(n, 2), pattern


def _sphere_layout(sizes: Floats, curves: _Curves) -> Rows:
    sides = curves.sides(sizes[:, 0] / 2)
    return sides, sides // 2, np.zeros(len(sizes), np.int64)


def _ellipse_layout(sizes: Floats, curves: _Curves) -> Rows:
    sides = curves.sides(sizes[:, :2].max(axis=1))
    return sides, np.maximum(sides // 4, 2), np.zeros(len(sizes), np.int64)


def _bowl_layout(sizes: Floats, curves: _Curves) -> Rows:
    radius, opening = _bowl(sizes[:, 0], sizes[:, 1])
    return curves.sides(np.maximum(sizes[:, 0], 0)), curves.steps(radius, opening), np.zeros(len(sizes), np.int64)


def _bend_layout(sizes: Floats, curves: _Curves) -> Rows:
    angle = np.minimum(sizes[:, 2], 2 * np.pi)
    steps = curves.steps(sizes[:, 0] + sizes[:, 1], angle)
    whole = angle >= _WHOLE_TURN
    return curves.sides(sizes[:, 1]), np.where(whole, np.maximum(steps, 3), steps), whole.astype(np.int64)


def _ring_layout(sizes: Floats, curves: _Curves) -> Rows:
    angle = np.minimum(sizes[:, 3], 2 * np.pi)
    steps = curves.steps(sizes[:, :2].max(axis=1), angle)
    whole = angle >= _WHOLE_TURN
    pattern = whole + 2 * (sizes[:, 0] <= _NOTHING)
    return np.full(len(sizes), 4), np.where(whole, np.maximum(steps, 3), steps), pattern


def _box(layout: Layout, sizes: Floats) -> tuple[Floats, Faces]:
    x, y, z = (sizes[:, i, None] / 2 for i in range(3))
    return _grid(np.stack([_rectangle(x, y, -z), _rectangle(x, y, z)], 1)), _stack(4, 2, "fan")


def _pyramid(layout: Layout, sizes: Floats) -> tuple[Floats, Faces]:
    shift = np.concatenate([sizes[:, 4:6] / 2, sizes[:, 6:7] / 2], 1)[:, None, :]
    bottom = _rectangle(sizes[:, :1] / 2, sizes[:, 1:2] / 2) - shift
    top = _rectangle(sizes[:, 2:3] / 2, sizes[:, 3:4] / 2) + shift
    one = np.arange(8)
    for ring in range(2):
        no_x, no_y = layout.pattern >> (2 * ring) & 1, layout.pattern >> (2 * ring + 1) & 1
        if no_x:
            one[4 * ring + np.arange(4)] = one[4 * ring + np.array([0, 0, 3, 3])]
        if no_y:
            one[4 * ring + np.arange(4)] = one[4 * ring + np.array([0, 1, 1, 0])]
    return _grid(np.stack([bottom, top], 1)), _collapsed(_stack(4, 2, "fan"), one)


def _cylinder(layout: Layout, sizes: Floats) -> tuple[Floats, Faces]:
    z = sizes[:, 1] / 2
    rings = [(sizes[:, 0], -z), (sizes[:, 0], z)]
    return _turned(layout.sides, rings, -z, z), _stack(layout.sides, 2, "points")


def _snout(layout: Layout, sizes: Floats) -> tuple[Floats, Faces]:
    shift = np.concatenate([sizes[:, 3:5] / 2, sizes[:, 2:3] / 2], 1)
    circle = _circle(layout.sides)
    rings = []
    for end, sign in ((0, -1.0), (1, 1.0)):
        if layout.pattern >> end & 1:
            continue
        flat = sizes[:, end, None, None] * circle
        slope = np.tan(sizes[:, 5 + 2 * end : 7 + 2 * end])
        height = np.einsum("kni,ki->kn", flat, slope)
        rings.append(np.concatenate([flat, height[:, :, None]], 2) + sign * shift[:, None, :])
    if not rings:
        return np.repeat(np.stack([-shift, shift, shift], 1), 1, axis=0), np.array([[0, 1, 2]], np.int32)
    return _grid(np.stack(rings, 1), -shift, shift), _stack(layout.sides, len(rings), "points")


def _sphere(layout: Layout, sizes: Floats) -> tuple[Floats, Faces]:
    radius = sizes[:, 0] / 2
    tilt = np.pi * np.arange(1, layout.steps) / layout.steps - np.pi / 2
    rings = [(radius * np.cos(t), radius * np.sin(t)) for t in tilt]
    return _turned(layout.sides, rings, -radius, radius), _stack(layout.sides, len(rings), "points")


def _elliptical_dish(layout: Layout, sizes: Floats) -> tuple[Floats, Faces]:
    radius, height = sizes[:, 0], sizes[:, 1]
    tilt = np.pi / 2 * np.arange(layout.steps) / layout.steps
    rings = [(radius * np.cos(t), height * np.sin(t)) for t in tilt]
    return _turned(layout.sides, rings, 0 * height, height), _stack(layout.sides, len(rings), "points")


def _spherical_dish(layout: Layout, sizes: Floats) -> tuple[Floats, Faces]:
    height = sizes[:, 1]
    radius, opening = _bowl(np.abs(sizes[:, 0]), np.abs(height))
    up = np.sign(height)
    rings = []
    for i in range(layout.steps):
        angle = opening * (1 - i / layout.steps)
        rings.append((radius * np.sin(angle), up * (radius * np.cos(angle) - radius + np.abs(height))))
    return _turned(layout.sides, rings, 0 * height, height), _stack(layout.sides, len(rings), "points")


def _circular_torus(layout: Layout, sizes: Floats) -> tuple[Floats, Faces]:
    # Seen along the bend, a ring turns to the left: first outward, then down.
    out, down = (sizes[:, 1, None] * _circle(layout.sides)[:, i] for i in range(2))
    return _swept(sizes[:, 0, None] + out, -down, sizes[:, 2], sizes[:, 0], layout, "points")


def _rectangular_torus(layout: Layout, sizes: Floats) -> tuple[Floats, Faces]:
    inner, outer, half = sizes[:, 0], sizes[:, 1], sizes[:, 2] / 2
    out, up = np.stack([inner, outer, outer, inner], 1), np.stack([half, half, -half, -half], 1)
    points, faces = _swept(out, up, sizes[:, 3], inner, layout, "fan")
    if layout.pattern & 2:
        # The inner wall is a line on the axis, the same for all rings.
        one = np.arange(points.shape[1])
        one[0::4], one[3::4] = 0, 3
        faces = _collapsed(faces, one)
    return points, faces


def _swept(out: Floats, up: Floats, angle: Floats, middle: Floats, layout: Layout, ends: str) -> tuple[Floats, Faces]:
    """A profile ``(k, n)`` turned about z from the x axis on; ``middle``: distance of its centre from the axis."""
    whole = bool(layout.pattern & 1)
    n = layout.steps if whole else layout.steps + 1
    share = np.arange(n) / layout.steps
    turn = np.where(whole, np.sign(angle) * 2 * np.pi, angle)[:, None] * share
    along, across = np.cos(turn)[:, :, None], np.sin(turn)[:, :, None]
    height = np.broadcast_to(up[:, None, :], (len(out), n, out.shape[1]))
    rings = np.stack([along * out[:, None, :], across * out[:, None, :], height], 3)
    if whole:
        return _grid(rings), _stack(layout.sides, n, "whole")
    if ends == "fan":
        return _grid(rings), _stack(layout.sides, n, ends)
    zero = np.zeros_like(middle)
    first = np.stack([middle, zero, zero], 1)
    last = np.stack([middle * along[:, -1, 0], middle * across[:, -1, 0], zero], 1)
    return _grid(rings, first, last), _stack(layout.sides, n, ends)


def _turned(sides: int, rings: list[tuple[Floats, Floats]], low: Floats, high: Floats) -> Floats:
    """Rings of (radius, height) about z, and a point on the axis below and above them."""
    circle = _circle(sides)
    stacked = np.empty((len(low), len(rings), sides, 3))
    for i, (radius, height) in enumerate(rings):
        stacked[:, i, :, :2] = radius[:, None, None] * circle
        stacked[:, i, :, 2] = height[:, None]
    ends = np.zeros((2, len(low), 3))
    ends[:, :, 2] = low, high
    return _grid(stacked, ends[0], ends[1])


def _grid(rings: Floats, low: Floats | None = None, high: Floats | None = None) -> Floats:
    """``(k, n, 3)`` the corners of all rings ``(k, m, sides, 3)``, then the two end points."""
    corners = rings.reshape(len(rings), -1, 3)
    if low is None or high is None:
        return corners
    return np.concatenate([corners, low[:, None], high[:, None]], 1)


def _stack(sides: int, rings: int, ends: str) -> Faces:
    """Triangles of a stack of rings that turn to the left about its axis.

    Args:
        sides: corners of a ring.
        rings: how many.
        ends: ``points``: closed by a point at either end, which follow the rings; ``fan``: closed without new points;
            ``whole``: the last ring joins the first.
    """
    low = np.arange(sides)
    after = (low + 1) % sides
    faces = []
    for i in range(rings if ends == "whole" else rings - 1):
        here, above = i * sides, (i + 1) % rings * sides
        faces += [np.column_stack([here + low, here + after, above + after])]
        faces += [np.column_stack([here + low, above + after, above + low])]
    last = (rings - 1) * sides
    if ends == "points":
        point = np.full(sides, rings * sides)
        faces += [np.column_stack([point, after, low]), np.column_stack([point + 1, last + low, last + after])]
    elif ends == "fan":
        first, second = np.zeros(sides - 2, np.int64), np.arange(1, sides - 1)
        faces += [np.column_stack([first, second + 1, second]), last + np.column_stack([first, second, second + 1])]
    return np.concatenate(faces).astype(np.int32)


def _collapsed(faces: Faces, one: Ints) -> Faces:
    """The triangles that remain when some points are one."""
    moved = one[faces]
    a, b, c = moved.T
    kept: Faces = moved[(a != b) & (b != c) & (c != a)].astype(np.int32)
    return kept


def _rectangle(x: Floats, y: Floats, z: Floats | float = 0.0) -> Floats:
    """``(k, 4, 3)`` corners at -/+ x and y ``(k, 1)``, turning to the left."""
    corners = np.zeros((len(x), 4, 3))
    corners[:, :, 0] = x * np.array([-1, 1, 1, -1])
    corners[:, :, 1] = y * np.array([-1, -1, 1, 1])
    corners[:, :, 2] = z
    return corners


def _circle(sides: int) -> Floats:
    angle = np.arange(sides) * 2 * np.pi / sides
    return np.column_stack([np.cos(angle), np.sin(angle)])


def _bowl(radius: Floats, height: Floats) -> tuple[Floats, Floats]:
    """Radius of the sphere of a spherical dish, and the angle between its axis and its rim."""
    safe = np.maximum(height, _NOTHING)
    whole = (radius**2 + safe**2) / (2 * safe)
    return whole, np.arccos(np.clip(1 - safe / whole, -1, 1))


_LAYOUTS: dict[int, Callable[[Floats, _Curves], Rows]] = {
    PYRAMID: _pyramid_layout,
    BOX: _flat_layout,
    RECTANGULAR_TORUS: _ring_layout,
    CIRCULAR_TORUS: _bend_layout,
    ELLIPTICAL_DISH: _ellipse_layout,
    SPHERICAL_DISH: _bowl_layout,
    SNOUT: _snout_layout,
    CYLINDER: _cylinder_layout,
    SPHERE: _sphere_layout,
}

_CUTS: dict[int, Callable[[Layout, Floats], tuple[Floats, Faces]]] = {
    PYRAMID: _pyramid,
    BOX: _box,
    RECTANGULAR_TORUS: _rectangular_torus,
    CIRCULAR_TORUS: _circular_torus,
    ELLIPTICAL_DISH: _elliptical_dish,
    SPHERICAL_DISH: _spherical_dish,
    SNOUT: _snout,
    CYLINDER: _cylinder,
    SPHERE: _sphere,
}


def layouts(rows: Ints) -> Iterator[tuple[Layout, npt.NDArray[np.int64]]]:
    """Each different layout with the numbers of the rows that have it."""
    if not len(rows):
        return
    different, which = np.unique(rows, axis=0, return_inverse=True)
    order = np.argsort(which.reshape(-1), kind="stable")
    ends = np.cumsum(np.bincount(which.reshape(-1), minlength=len(different)))
    for row, own in zip(different.tolist(), np.split(order, ends[:-1]), strict=True):
        yield Layout(*row), own
