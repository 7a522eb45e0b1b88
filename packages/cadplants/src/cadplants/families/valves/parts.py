"""What check, relief, reducing and small valves share: branches, bolted covers, threaded ends, springs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.table import Table
from cadplants.families.valves.drive import BODY
from cadplants.families.valves.threaded import hex_end
from cadplants.families.valves.valve import bolt_circle, disc_flange
from cadplants.model.family import Part
from cadplants.model.standards import FLANGES, PIPES, sizes_between
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import along, around, box, cylinder, hexagon, rope, torus, turned
from cadplants.solids.transforms import at
from cadplants.styles.modeling_style import ModelingStyle

__all__ = [
    "BIG", "MID", "SMALL", "bend", "branch", "cage", "chain", "cover", "hub_radius", "screwed", "spring", "square",
    "thread_nut", "threaded_run",
]  # fmt: skip

SMALL = sizes_between(most=50)
MID = sizes_between(most=200)
BIG = sizes_between(40)

_BACK = {"x": "-x", "-x": "x", "y": "-y", "-y": "y", "z": "-z", "-z": "z"}


def branch(dn: int, style: ModelingStyle, reach: float, way: str, center: Sequence[float] = (0.0, 0.0, 0.0)) -> Solid:
    """A flange on a neck out of a centre, its face this far along an axis (``"-y"``) [m]."""
    stub = moved(disc_flange(dn, style, reach), at(0, 0, -reach))
    return along(_BACK[way], stub, *center)


def square(half: float, low: float, high: float, bore: float = 0.0, style: ModelingStyle | None = None) -> Solid:
    """A plate with round corners about z, with a hole where ``bore`` is its radius [m]."""
    holes = (circle(bore, style.round(bore) if style else 12),) if bore else ()
    return extrude(rounded_rectangle(2 * half, 2 * half, 0.3 * half, 3), low, high, holes)


def cover(
    radius: float, seat: float, plate: float, count: int, style: ModelingStyle, corners: bool = False, hood: float = 0.0
) -> list[Part]:
    """A body's collar up to ``seat``, a round or square cover on it, maybe domed by ``hood``, and its bolts [m]."""
    n, thread = style.round(radius), max(0.005, min(0.016, 0.14 * radius))
    if corners:
        low, lid = square(radius, seat - plate, seat), square(radius, seat, seat + plate)
        spread, count = 1.05 * radius, 4
    else:
        low, lid = cylinder(radius, seat - plate, seat, n), cylinder(radius, seat, seat + plate, n)
        spread = radius - 1.1 * thread
    top = [lid]
    if hood:
        low_hood, rise = seat + 0.6 * plate, hood + 0.4 * plate
        shares = np.linspace(0, np.pi / 2, 4)[:-1]
        shell = [(0.72 * radius * np.cos(a), low_hood + rise * np.sin(a)) for a in shares]
        top.append(turned([*shell, (0.1 * radius, seat + plate + hood)], n))
    bolts = bolt_circle(count, spread, thread, seat - plate, seat + plate)
    return [
        Part(low, BODY, "valve", BODY),
        Part(merge(top), "valve bonnet", "valve", BODY),
        Part(bolts, "bolt", "fastener", BODY, "Connection assembly", True),
    ]


def screwed(
    dn: int,
    style: ModelingStyle,
    length: float,
    core: Sequence[tuple[float, float]],
    corners: int = 6,
    end: float = 0.0,
) -> Solid:
    """A threaded body along x: two wrench ends and a turned core, its outline as radius and place [m]."""
    end = end or 0.24 * length
    middle = along("x", turned(core, style.round(max(r for r, _ in core))))
    return merge([hex_end(dn, 0.0, end, style, corners), middle, hex_end(dn, length - end, length, style, corners)])


def threaded_run(t: Table, length: float, *core: tuple[float, float], end: float = 0.24) -> Solid:
    """The same for a valve on a table; the core's places, and the length of an end, as shares of the length."""
    return screwed(t.dn, t.style, length, [(radius, share * length) for radius, share in core], end=end * length)


def spring(radius: float, wire: float, low: float, high: float, turns: int, style: ModelingStyle) -> Solid:
    """A coil about z, its ends pressed into what it stands between [m]."""
    steps = turns * max(6, min(12, style.round(radius))) + 1
    angles = np.linspace(0, 2 * np.pi * turns, steps)
    heights = np.linspace(low + 0.5 * wire, high - 0.5 * wire, steps)
    return rope(np.column_stack([radius * np.cos(angles), radius * np.sin(angles), heights]), wire, 6)


def cage(radius: float, low: float, high: float, bars: int, hoops: int, style: ModelingStyle) -> Solid:
    """A basket of bars and hoops about z with a closed end at the top [m]."""
    wide = max(0.002, 0.05 * radius)
    sides = max(12, style.round(radius))
    solids = [around(box((wide, wide, high - low), (0, 0, (low + high) / 2)), bars, radius - wide / 2)]
    for z in np.linspace(low + wide, high - wide, hoops):
        solids.append(moved(torus(radius - wide / 2, 0.7 * wide, sides, 5), at(0, 0, float(z))))
    solids.append(cylinder(radius, high - wide, high + wide, sides))
    return merge(solids)


def bend(points: Sequence[Sequence[float]], corner: float, steps: int = 4) -> Floats:
    """A path whose corners are rounded with this much of their legs [m]."""
    path = [np.asarray(points[0], float)]
    for a, b, c in zip(points[:-2], points[1:-1], points[2:], strict=True):
        p, q, r = (np.asarray(v, float) for v in (a, b, c))
        back, on = (p - q) / np.linalg.norm(p - q), (r - q) / np.linalg.norm(r - q)
        for t in np.linspace(0, 1, steps + 1):
            path.append(q + corner * ((1 - t) ** 2 * back + t**2 * on))
    path.append(np.asarray(points[-1], float))
    apart = [path[0]] + [q for p, q in zip(path[:-1], path[1:], strict=True) if np.abs(q - p).max() > 1e-6]
    return np.array(apart)


def chain(start: Sequence[float] | Floats, end: Sequence[float] | Floats, sag: float, wire: float) -> Solid:
    """A small chain hanging between two points, as links in turn [m]."""
    a, b = np.asarray(start, float), np.asarray(end, float)
    path = [a + (b - a) * t - np.array([0, 0, 4 * sag * t * (1 - t)]) for t in np.linspace(0, 1, 7)]
    return rope(path, wire, 6)


def thread_nut(flats: float, low: float, high: float, style: ModelingStyle, ribs: int = 0) -> Solid:
    """A union nut about z: a hexagon, or round with ribs as on plastic fittings [m]."""
    if not ribs:
        return hexagon(flats, low, high)
    n = max(12, style.round(flats / 2))
    rib = box((0.06 * flats, 0.08 * flats, 0.9 * (high - low)), (0, 0, (low + high) / 2))
    return merge([cylinder(flats / 2, low, high, n), around(rib, ribs, flats / 2)])


def hub_radius(dn: int) -> float:
    """Radius of a flange's neck [m]."""
    return max(0.485 * FLANGES[dn].hub, PIPES[dn].radius)
