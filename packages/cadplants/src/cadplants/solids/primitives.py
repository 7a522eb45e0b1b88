"""Plain closed forms that devices are put together from: turned, drilled, bent and bolted."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.solids.mesh_ops import Solid, extrude, loft, merge, moved, revolve, tube, weld
from cadplants.solids.polygon import circle
from cadplants.solids.transforms import at, looking, spun

__all__ = [
    "AXES",
    "BOTH",
    "CORNERS",
    "along",
    "around",
    "ball",
    "bar",
    "box",
    "cylinder",
    "dome",
    "hexagon",
    "lofted",
    "ring",
    "rod",
    "rope",
    "torus",
    "turned",
    "waves",
]

BOTH = (-1, 1)
"""Signs of the two sides of what is the same on both."""
CORNERS = tuple((x, y) for x in BOTH for y in BOTH)
"""Signs of the four corners of what is the same at all of them."""

AXES: dict[str, Floats] = {
    "z": np.eye(4),
    "-z": spun("x", np.pi),
    "x": spun("y", np.pi / 2),
    "-x": spun("y", -np.pi / 2),
    "y": spun("x", -np.pi / 2),
    "-y": spun("x", np.pi / 2),
}
"""The poses that lay what was built about z along an axis, by its name."""

_CORNERS = np.array([[x, y, z] for z in (-0.5, 0.5) for x, y in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))])
_QUADS = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
_SIDES = np.array([t for a, b, c, d in _QUADS for t in ((a, b, c), (a, c, d))], np.int32)


def along(axis: str, solid: Solid, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Solid:
    """What was built about z laid along an axis (``"x"``, ``"-y"``...), then shifted [m]."""
    return moved(solid, at(x, y, z) @ AXES[axis])


def turned(profile: Sequence[tuple[float, float]], sides: int, phase: float = 0.0, bore: float = 0.0) -> Solid:
    """A solid of revolution about z; its outline ``(radius, height)`` goes up its outside [m].

    Args:
        profile: the outline.
        sides: corners of a ring.
        phase: angle of the first corner [rad].
        bore: radius of a round hole right through, 0 for none [m].
    """
    points = list(profile)
    if bore > 0:
        inside = [(bore, points[-1][1]), (bore, points[0][1])]
        return weld([revolve([*points, *inside], sides, closed=True, phase=phase)])
    if points[0][0] > 0:
        points.insert(0, (0.0, points[0][1]))
    if points[-1][0] > 0:
        points.append((0.0, points[-1][1]))
    return weld([revolve(points, sides, phase=phase)])


def cylinder(radius: float, low: float, high: float, sides: int) -> Solid:
    """A cylinder about z between two heights [m]."""
    return turned([(radius, low), (radius, high)], sides)


def box(size: Sequence[float], center: Sequence[float] = (0.0, 0.0, 0.0)) -> Solid:
    """A box with its edges along the axes [m]."""
    return Solid(_CORNERS * np.asarray(size, float) + np.asarray(center, float), _SIDES)


def ring(inner: float, outer: float, low: float, high: float, sides: int) -> Solid:
    """A ring or tube about z; a plain cylinder where ``inner`` is 0 [m]."""
    if inner <= 0:
        return cylinder(outer, low, high, sides)
    return weld([revolve([(inner, low), (outer, low), (outer, high), (inner, high)], sides, closed=True)])


def hexagon(flats: float, low: float, high: float, bore: float = 0.0, sides: int = 12) -> Solid:
    """A hexagonal prism about z, this wide across its flats [m], with a round hole where ``bore`` is a radius."""
    if not bore:
        return cylinder(flats / np.sqrt(3), low, high, 6)
    return extrude(circle(flats / np.sqrt(3), 6), low, high, (circle(bore, sides),))


def ball(radius: float, sides: int, stretch: float = 1.0) -> Solid:
    """A ball about the origin, its height ``stretch`` times its width [m]."""
    angles = np.linspace(-np.pi / 2, np.pi / 2, max(4, sides // 2) + 1)
    profile = [(radius * np.cos(a), stretch * radius * np.sin(a)) for a in angles]
    profile[0], profile[-1] = (0.0, -stretch * radius), (0.0, stretch * radius)
    return weld([revolve(profile, sides)])


def dome(radius: float, height: float, low: float, sides: int) -> Solid:
    """Half an ellipsoid on the height ``low``, closed below [m]."""
    angles = np.linspace(0, np.pi / 2, max(3, sides // 4) + 1)
    profile = [(radius * np.cos(a), low + height * np.sin(a)) for a in angles]
    profile[-1] = (0.0, low + height)
    return turned(profile, sides)


def torus(radius: float, thick: float, sides: int, turns: int = 10) -> Solid:
    """A round ring about z in the plane z = 0: ``radius`` of its middle line, ``thick`` of its section [m]."""
    angles = np.arange(turns) * 2 * np.pi / turns
    profile = np.column_stack([radius + thick * np.cos(angles), thick * np.sin(angles)])
    return weld([revolve(profile, sides, closed=True)])


def rod(start: Sequence[float], end: Sequence[float], radius: float, sides: int) -> Solid:
    """A round bar between two points [m]."""
    return tube(np.array([start, end], float), radius, 0.0, sides)


def rope(path: Floats | Sequence[Sequence[float]], radius: float, sides: int) -> Solid:
    """A bent round bar along ``(n, 3)`` points [m]."""
    return tube(np.asarray(path, float), radius, 0.0, sides)


def around(solid: Solid, count: int, radius: float = 0.0, start: float = 0.0) -> Solid:
    """Copies of a solid round z as one mesh, each shifted out along its own x by ``radius`` [m] first."""
    turns = start + np.arange(count) * 2 * np.pi / count
    return merge([moved(solid, spun("z", float(turn)) @ at(radius)) for turn in turns])


def waves(low: float, high: float, inner: float, outer: float, count: int) -> list[tuple[float, float]]:
    """The outline ``(radius, height)`` of a bellows: ``count`` round waves between two radii [m]."""
    steps = np.linspace(0, 2 * np.pi * count, 6 * count + 1)
    middle, swing = (inner + outer) / 2, (outer - inner) / 2
    return [(middle - swing * np.cos(s), low + (high - low) * s / steps[-1]) for s in steps]


def lofted(loops: Sequence[Floats]) -> Solid:
    """A solid through outlines of as many corners each, closed by flat ends."""
    ends = [loop.mean(axis=0, keepdims=True) for loop in (loops[0], loops[-1])]
    return weld([loft([ends[0], *loops, ends[1]])])


def bar(
    start: Floats | Sequence[float], end: Floats | Sequence[float], outline: Floats, holes: tuple[Floats, ...] = ()
) -> Solid:
    """A section along a line, its y axis as upright as can be [m]."""
    a, b = np.asarray(start, float), np.asarray(end, float)
    look = looking(a, b - a)
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2], pose[:3, 3] = look[:3, 1], look[:3, 2], look[:3, 0], a
    return moved(extrude(outline, 0.0, float(np.linalg.norm(b - a)), holes), pose)
