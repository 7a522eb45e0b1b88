"""Solids that are primitives of plant-design systems: cylinders, rings, bends, domes, cones and boxes found in a mesh.

A mesh counts as a primitive only where it is what a tessellation of it gives: all its corners lie on the primitive, in
even steps around its axis, and it encloses the volume that such a tessellation encloses.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from cadgraph.geometry.mesh.merge import weld_points
from cadgraph.model.scene import Floats
from cadplants.solids.mesh_ops import Solid, volume

__all__ = ["Kind", "Primitive", "fit", "surface"]

Kind = Literal["box", "cylinder", "dish", "pyramid", "ring", "snout", "sphere", "torus"]

_EXACT = 1e-6  # m; how far a corner may lie from the primitive
_WELD = 1e-8  # m; corners of one place
_VOLUME = 1e-6  # of the volume: float64 noise of sums over many triangles
_ROUND = 8  # fewer corners are a prism, not a cylinder; hexagon heads have six
_MOST = 20_000  # corners; what is finer than that is no tessellated primitive
_FINE = 256  # corners of a ring where a primitive's box is measured: 8e-5 of the radius


@dataclass(frozen=True, eq=False)
class Primitive:
    """A closed form in a frame of its own.

    Args:
        kind: which.
        sizes: of a ``box`` its edges; ``cylinder`` radius, height; ``ring`` inner and outer radius, height; ``torus``
            radius of its middle line and of its section, angle from +x about z; ``dish`` radius of its base, height
            (half an ellipsoid on z = 0); ``sphere`` radius; ``snout`` lower and upper radius, height, offset of its
            top in x and y; ``pyramid`` lower x and y, upper x and y, offset in x and y, height [m, rad]. All but the
            dish are centred.
        pose: ``(4, 4)`` rigid, outer from local coordinates.
    """

    kind: Kind
    sizes: tuple[float, ...]
    pose: Floats


@dataclass(frozen=True, eq=False)
class _Ring:
    """Corners in even steps on a circle, or one point."""

    center: Floats
    radius: float
    sides: int


def fit(solid: Solid) -> Primitive | None:
    """The primitive that a solid is a tessellation of; None where it is none.

    Args:
        solid: any mesh.
    """
    used = np.unique(solid.faces)
    if not 8 <= len(used) <= _MOST:
        return None
    first, _ = weld_points(solid.vertices[used], _WELD)
    points = solid.vertices[used][first]
    content = volume(solid)
    if content <= 0:
        return None
    normals = _face_normals(solid)
    if len(points) == 8:
        found = _pyramid(points, normals, content)
        if found is not None:
            return found
    for axis in _axes(points, normals):
        found = _about(points, axis, content)
        if found is not None:
            return found
    return _sphere(points, content) or _bend(solid, content)


def surface(primitive: Primitive, sides: int = _FINE) -> Floats:
    """Points on a primitive that reach as far as it does in every direction, ``(n, 3)`` in outer coordinates [m]."""
    points = _SURFACES[primitive.kind](primitive.sizes, sides)
    return points @ primitive.pose[:3, :3].T + primitive.pose[:3, 3]


def _circle(radius: float, z: float, sides: int, x: float = 0.0, y: float = 0.0) -> Floats:
    angles = np.arange(sides) * 2 * np.pi / sides
    return np.column_stack([x + radius * np.cos(angles), y + radius * np.sin(angles), np.full(sides, z)])


def _box_surface(sizes: tuple[float, ...], sides: int) -> Floats:
    x, y, z = sizes
    return _pyramid_surface((x, y, x, y, 0.0, 0.0, z), sides)


def _pyramid_surface(sizes: tuple[float, ...], _: int) -> Floats:
    lower_x, lower_y, upper_x, upper_y, dx, dy, height = sizes
    signs = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) / 2
    low = signs * (lower_x, lower_y) - np.array([dx, dy]) / 2
    high = signs * (upper_x, upper_y) + np.array([dx, dy]) / 2
    return np.column_stack([np.vstack([low, high]), np.repeat([-height / 2, height / 2], 4)])


def _snout_surface(sizes: tuple[float, ...], sides: int) -> Floats:
    low, high, height, x, y = sizes
    ends = ((low, -1), (high, 1))
    return np.vstack([_circle(r, s * height / 2, sides, s * x / 2, s * y / 2) for r, s in ends])


def _dish_surface(sizes: tuple[float, ...], sides: int) -> Floats:
    radius, height = sizes
    angles = np.linspace(0, np.pi / 2, sides // 4 + 1)
    return np.vstack([_circle(radius * np.cos(a), height * np.sin(a), sides) for a in angles])


def _sphere_surface(sizes: tuple[float, ...], sides: int) -> Floats:
    radius = sizes[0]
    angles = np.linspace(-np.pi / 2, np.pi / 2, sides // 2 + 1)
    return np.vstack([_circle(radius * np.cos(a), radius * np.sin(a), sides) for a in angles])


def _torus_surface(sizes: tuple[float, ...], sides: int) -> Floats:
    radius, section, angle = sizes
    quarters = np.arange(0, angle, np.pi / 2)
    turns = np.union1d(np.linspace(0, angle, sides + 1), quarters)
    ring = _circle(section, 0.0, sides)
    out, up = radius + ring[:, 0], ring[:, 1]
    return np.vstack([np.column_stack([out * np.cos(t), out * np.sin(t), up]) for t in turns])


_SURFACES = {
    "box": _box_surface,
    "cylinder": lambda sizes, sides: _snout_surface((sizes[0], sizes[0], sizes[1], 0.0, 0.0), sides),
    "dish": _dish_surface,
    "pyramid": _pyramid_surface,
    "ring": lambda sizes, sides: _snout_surface((sizes[1], sizes[1], sizes[2], 0.0, 0.0), sides),
    "snout": _snout_surface,
    "sphere": _sphere_surface,
    "torus": _torus_surface,
}


def _face_normals(solid: Solid) -> Floats:
    """Distinct unit normals of the faces up to their sign, those of the most area first."""
    corners = solid.vertices[solid.faces]
    doubled = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(doubled, axis=1)
    unit = doubled[areas > 0] / areas[areas > 0, None]
    lead = np.argmax(np.abs(unit) > 1e-6, axis=1)
    unit *= np.sign(unit[np.arange(len(unit)), lead])[:, None]
    first, place = weld_points(unit, 1e-6)
    order = np.argsort(-np.bincount(place, areas[areas > 0]), kind="stable")
    return np.asarray(unit[first][order], np.float64)


def _axes(points: Floats, normals: Floats) -> Iterator[Floats]:
    """Directions that an axis of revolution may have, likely ones first."""
    yield from np.eye(3)[[2, 0, 1]]
    # A cap is flat, so its normal is the axis; the sides of a long pipe may have more area.
    yield from normals[: min(len(normals), 12)]
    centered = points - points.mean(axis=0)
    yield from np.linalg.svd(centered, full_matrices=False)[2]


def _frame(z: Floats, x: Floats, origin: Floats) -> Floats:
    """A right-handed pose with this z axis, its x axis as near to ``x`` as that allows."""
    z = z / np.linalg.norm(z)
    x = x - z * (x @ z)
    x = x / np.linalg.norm(x)
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2], pose[:3, 3] = x, np.cross(z, x), z, origin
    return pose


def _any_across(axis: Floats) -> Floats:
    return np.asarray(np.eye(3)[int(np.argmin(np.abs(axis)))], np.float64)


def _pyramid(points: Floats, normals: Floats, content: float) -> Primitive | None:
    """A box, or a pyramid's stump between two parallel rectangles of parallel edges."""
    for axis in normals[:6]:
        heights = points @ axis
        low = heights < heights.mean()
        if low.sum() != 4 or np.ptp(heights[low]) > _EXACT or np.ptp(heights[~low]) > _EXACT:
            continue
        corners = points[low]
        legs = corners[1:] - corners[0]
        edge = legs[int(np.argmin(np.linalg.norm(legs, axis=1)))]
        pose = _frame(axis, edge, np.zeros(3))
        lower, upper = (_rectangle(points[side] @ pose[:3, :3]) for side in (low, ~low))
        if lower is None or upper is None:
            continue
        (a, b, at), (c, d, to) = lower, upper
        height = float(to[2] - at[2])
        pose[:3, 3] = pose[:3, :3] @ ((at + to) / 2)
        # The volume between two rectangles of parallel edges (prismatoid).
        expected = height / 6 * (2 * a * b + 2 * c * d + a * d + b * c)
        if not _close(expected, content):
            continue
        dx, dy = float(to[0] - at[0]), float(to[1] - at[1])
        if max(abs(a - c), abs(b - d), abs(dx), abs(dy)) <= _EXACT:
            return Primitive("box", (a, b, height), pose)
        return Primitive("pyramid", (a, b, c, d, dx, dy, height), pose)
    return None


def _rectangle(corners: Floats) -> tuple[float, float, Floats] | None:
    """Size and centre of four corners that are a level rectangle along x and y."""
    low, high = corners.min(axis=0), corners.max(axis=0)
    at_corner = np.minimum(np.abs(corners - low), np.abs(corners - high))[:, :2].max() <= _EXACT
    which = {tuple(row) for row in (corners[:, :2] > (low + high)[:2] / 2).tolist()}
    if not at_corner or len(which) != 4:
        return None
    return float(high[0] - low[0]), float(high[1] - low[1]), (low + high) / 2


def _close(expected: float, content: float) -> bool:
    return abs(expected - content) <= _VOLUME * content


def _about(points: Floats, axis: Floats, content: float) -> Primitive | None:
    """A solid of revolution, or an eccentric cone, with this axis."""
    pose = _frame(axis, _any_across(axis), np.zeros(3))
    local = points @ pose[:3, :3]
    levels = _levels(local)
    if levels is None or len(levels) < 2:
        return None
    found = None
    if len(levels) == 2:
        low, high = levels
        if len(low) == len(high) == 1:
            found = _cone(low[0], high[0], content)
        elif len(low) == len(high) == 2:
            found = _tube(low, high, content)
    else:
        found = _dish(levels, content) or _full_torus(levels, content)
    if found is None:
        return None
    kind, sizes, inner = found
    return Primitive(kind, sizes, pose @ inner)


_Found = tuple[Kind, tuple[float, ...], Floats]


def _levels(local: Floats) -> list[list[_Ring]] | None:
    """The rings at each height, from below, the inner ones first; None where the points are no rings.

    A point in the middle of rings is a cap's and is left out.
    """
    order = np.argsort(local[:, 2], kind="stable")
    steps = np.flatnonzero(np.diff(local[order, 2]) > _EXACT) + 1
    levels = []
    for members in np.split(order, steps):
        rings = _rings(local[members])
        if rings is None:
            return None
        levels.append(rings)
    return levels


def _rings(points: Floats) -> list[_Ring] | None:
    if len(points) == 1:
        return [_Ring(points[0], 0.0, 1)]
    center = points.mean(axis=0)
    radii = np.linalg.norm(points[:, :2] - center[:2], axis=1)
    order = np.argsort(radii, kind="stable")
    rings = []
    for members in np.split(order, np.flatnonzero(np.diff(radii[order]) > 2 * _EXACT) + 1):
        if len(members) == 1 and radii[members[0]] <= _EXACT:
            continue
        ring = points[members] - center
        angles = np.sort(np.arctan2(ring[:, 1], ring[:, 0]))
        gaps = np.diff(angles, append=angles[:1] + 2 * np.pi)
        radius, n = float(radii[members].mean()), len(members)
        if n < _ROUND or (np.abs(gaps - 2 * np.pi / n) * radius).max() > 2 * _EXACT:
            return None
        rings.append(_Ring(center, radius, n))
    return rings or None


def _polygon(sides: int) -> float:
    """The area of a regular polygon in a circle of radius 1."""
    return sides / 2 * float(np.sin(2 * np.pi / sides))


def _revolved(profile: list[tuple[float, float]], sides: int) -> float:
    """The volume under a profile of radius and height turned in this many steps."""
    parts = [(a * a + a * b + b * b) / 3 * (y - x) for (a, x), (b, y) in zip(profile[:-1], profile[1:], strict=True)]
    return _polygon(sides) * sum(parts)


def _shifted(center: Floats) -> Floats:
    pose = np.eye(4)
    pose[:3, 3] = center
    return pose


def _cone(low: _Ring, high: _Ring, content: float) -> _Found | None:
    if min(low.sides, high.sides) > 1 and low.sides != high.sides:
        return None
    sides = max(low.sides, high.sides)
    height = float(high.center[2] - low.center[2])
    if sides < _ROUND or not _close(_revolved([(low.radius, 0.0), (high.radius, height)], sides), content):
        return None
    x, y = (high.center - low.center)[:2].tolist()
    middle = _shifted((low.center + high.center) / 2)
    if max(abs(low.radius - high.radius), abs(x), abs(y)) <= _EXACT:
        return "cylinder", (low.radius, height), middle
    return "snout", (low.radius, high.radius, height, x, y), middle


def _coaxial(rings: list[_Ring]) -> bool:
    centers = np.array([ring.center[:2] for ring in rings])
    return bool(np.ptp(centers, axis=0).max() <= _EXACT)


def _tube(low: list[_Ring], high: list[_Ring], content: float) -> _Found | None:
    """A ring of rectangular section."""
    even = all(a.sides == b.sides and abs(a.radius - b.radius) <= _EXACT for a, b in zip(low, high, strict=True))
    if not even or not _coaxial([*low, *high]):
        return None
    inner, outer = low
    height = float(high[0].center[2] - low[0].center[2])
    expected = height * (_polygon(outer.sides) * outer.radius**2 - _polygon(inner.sides) * inner.radius**2)
    if not _close(expected, content):
        return None
    return "ring", (inner.radius, outer.radius, height), _shifted((low[0].center + high[0].center) / 2)


def _off_ellipsoid(profile: list[tuple[float, float]]) -> float:
    """How far radii over heights, from the rim to the apex, are from those of an ellipsoid [m]."""
    radius, height = profile[0][0], profile[-1][1]
    return float(max(abs(r - radius * np.sqrt(max(0.0, 1 - (h / height) ** 2))) for r, h in profile))


def _dish(levels: list[list[_Ring]], content: float) -> _Found | None:
    """Half an ellipsoid on its base, which may lie above or below."""
    rings = [level[0] for level in levels]
    if len(rings) < 3 or {len(level) for level in levels} != {1} or not _coaxial(rings):
        return None
    turned = rings[0].sides == 1
    rings = rings[::-1] if turned else rings
    base, top = rings[0], rings[-1]
    if top.sides != 1 or any(ring.sides != base.sides for ring in rings[:-1]):
        return None
    heights = [abs(float(ring.center[2] - base.center[2])) for ring in rings]
    height = heights[-1]
    profile = [(ring.radius, h) for ring, h in zip(rings, heights, strict=True)]
    if _off_ellipsoid(profile) > _EXACT or not _close(_revolved(profile, base.sides), content):
        return None
    pose = _shifted(base.center)
    if turned:
        pose[1, 1] = pose[2, 2] = -1.0
    return "dish", (base.radius, height), pose


def _full_torus(levels: list[list[_Ring]], content: float) -> _Found | None:
    rings = [ring for level in levels for ring in level]
    if any(ring.sides != rings[0].sides or ring.sides < _ROUND for ring in rings) or not _coaxial(rings):
        return None
    radii = np.array([ring.radius for ring in rings])
    heights = np.array([ring.center[2] for ring in rings])
    middle = (heights.max() + heights.min()) / 2
    radius, section = (radii.max() + radii.min()) / 2, (radii.max() - radii.min()) / 2
    if (np.abs(np.hypot(radii - radius, heights - middle) - section)).max() > _EXACT or len(rings) < _ROUND:
        return None
    order = np.argsort(np.arctan2(heights - middle, radii - radius), kind="stable")
    profile = [(float(radii[k]), float(heights[k])) for k in (*order, order[0])]
    if section >= radius or not _close(_revolved(profile, rings[0].sides), content):
        return None
    center = np.array([*rings[0].center[:2], middle])
    return "torus", (float(radius), float(section), 2 * float(np.pi)), _shifted(center)


def _sphere(points: Floats, content: float) -> Primitive | None:
    """A ball with its poles along one of the axes."""
    low, high = points.min(axis=0), points.max(axis=0)
    center, radius = (low + high) / 2, float((high - low).max() / 2)
    if np.abs(np.linalg.norm(points - center, axis=1) - radius).max() > _EXACT:
        return None
    for axis in np.eye(3):
        pose = _frame(axis, _any_across(axis), center)
        levels = _levels((points - center) @ pose[:3, :3])
        if levels is None or any(len(level) != 1 for level in levels):
            continue
        profile = [(level[0].radius, float(level[0].center[2])) for level in levels]
        if _close(_revolved(profile, levels[len(levels) // 2][0].sides), content):
            return Primitive("sphere", (radius,), pose)
    return None


def _bend(solid: Solid, content: float) -> Primitive | None:
    """A round bar along an arc, as ``mesh_ops.tube`` along ``transforms.arc`` makes it.

    It has loops between two poles, and each leg is a tangent to the arc.
    """
    points = solid.vertices
    reach = np.linalg.norm(points - points[0], axis=1)
    section = float(reach[1])
    apart = np.flatnonzero(np.abs(reach[1:] - section) > _EXACT)
    sides = int(apart[0]) if len(apart) else 0
    if sides < _ROUND or (len(points) - 2) % sides:
        return None
    loops = points[1:-1].reshape(-1, sides, 3)
    centers = loops.mean(axis=1)
    ends = max(np.linalg.norm(centers[0] - points[0]), np.linalg.norm(centers[-1] - points[-1]))
    if len(loops) < 3 or ends > _EXACT:
        return None
    legs = np.diff(centers, axis=0)
    lengths = np.linalg.norm(legs, axis=1, keepdims=True)
    if lengths.min() <= _EXACT:
        return None
    legs /= lengths
    for k, leg in enumerate(legs):
        for loop in loops[k : k + 2]:
            off = loop - centers[k]
            if np.abs(np.linalg.norm(off - np.outer(off @ leg, leg), axis=1) - section).max() > _EXACT:
                return None
    turn = float(np.arccos(np.clip(legs[0] @ legs[-1], -1, 1)))
    inward = legs[-1] - legs[0] * (legs[-1] @ legs[0])
    if turn < 1e-3 or np.linalg.norm(inward) < 1e-6:
        return None
    inward /= np.linalg.norm(inward)
    radius = float(np.linalg.norm(centers[-1] - centers[0]) / (2 * np.sin(turn / 2)))
    step = turn / (len(loops) - 2)
    angles = (np.arange(len(loops) - 2) + 0.5) * step
    middle = centers[0] + radius * inward
    on = radius / np.cos(step / 2) * (np.outer(np.sin(angles), legs[0]) - np.outer(np.cos(angles), inward))
    if section >= radius or np.linalg.norm(centers[1:-1] - middle - on, axis=1).max() > _EXACT:
        return None
    length = 2 * radius * np.tan(step / 2) * (len(loops) - 2)
    if not _close(_polygon(sides) * section**2 * length, content):
        return None
    return Primitive("torus", (radius, section, turn), _frame(np.cross(-inward, legs[0]), -inward, middle))
