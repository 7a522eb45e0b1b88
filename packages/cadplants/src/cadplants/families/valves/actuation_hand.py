"""Handwheels and levers of many makes, standing on z = 0 about the z axis of a stem."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.mesh_ops import Solid, extrude, loft, merge, moved, revolve, sweep, weld
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, around, ball, box, cylinder, hexagon, ring, rod, rope, torus, turned
from cadplants.transforms import at, spun

__all__ = ["LEVERS", "WHEELS", "cylinder_at", "lever_of", "slab", "span", "wheel_of"]

Rng = np.random.Generator


def slab(outline: Floats, low: float, high: float, holes: tuple[Floats, ...] = ()) -> Solid:
    """A prism over an outline whichever way round it is given [m]."""
    x, y = outline[:, 0], outline[:, 1]
    turned_round = float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) < 0
    return extrude(outline[::-1] if turned_round else outline, low, high, holes)


def span(a: float, b: float) -> tuple[float, float]:
    """Two heights, the lower first [m]."""
    return min(a, b), max(a, b)


def _hub(radius: float, tall: float, rng: Rng) -> Solid:
    """A wheel's hub: round, square or six-sided, maybe with the nut that holds it."""
    kind = int(rng.integers(4))
    solids = [
        cylinder(radius, 0.0, tall, (14, 14, 8, 6)[kind])
        if kind
        else box((1.7 * radius,) * 2 + (tall,), (0, 0, tall / 2))
    ]
    if rng.random() < 0.4:
        solids.append(hexagon(1.1 * radius, tall, tall + 0.5 * radius))
    return merge(solids)


def _rim(radius: float, thick: float, n: int, kind: int) -> Solid:
    """A rim about z = 0: round, oval flat, oval tall, square or half round."""
    if kind == 0:
        return torus(radius - thick, thick, n, 8)
    turns = np.arange(8) * np.pi / 4
    a, b = ((1.5, 0.7), (0.7, 1.4))[kind % 2]
    section = [(radius - a * thick + a * thick * float(np.cos(t)), b * thick * float(np.sin(t))) for t in turns]
    if kind == 3:
        section = [(radius - 2 * thick, -thick), (radius, -thick), (radius, thick), (radius - 2 * thick, thick)]
    return weld([revolve(section, n, closed=True)])


def _spoked(radius: float, style: ModelingStyle, rng: Rng) -> Solid:
    """A cast wheel: two to six flat, round, tapered or bowed spokes to a rim above or level with its hub."""
    n, count = max(16, style.round(radius)), int(rng.integers(2, 7))
    thick = radius * float(rng.uniform(0.035, 0.10)) + 0.001
    hub, tall = radius * float(rng.uniform(0.12, 0.24)) + 0.003, 0.01 + radius * float(rng.uniform(0.10, 0.3))
    rise = float(rng.choice([0.0, 0.0, 0.15, 0.35, -0.1])) * radius + 0.5 * tall
    shape, wide = int(rng.integers(4)), float(rng.uniform(0.5, 1.1)) * thick
    start, end = (0.6 * hub, 0.0, 0.5 * tall), (radius - thick, 0.0, rise)
    if shape == 0:
        spoke = rod(start, end, wide, 6)
    elif shape == 1:
        flat = np.array([[-1.6, -0.6], [1.6, -0.6], [1.6, 0.6], [-1.6, 0.6]]) * wide
        spoke = sweep(np.array([start, end]), flat, up=(0.0, 1.0, 0.0))
    elif shape == 2:
        bow = float(rng.uniform(0.1, 0.3)) * radius
        way = np.linspace(0, 1, 6)[:, None]
        path = np.array(start) * (1 - way) + np.array(end) * way
        path[:, 1] = bow * np.sin(np.pi * way[:, 0])
        spoke = rope(path, wide, 6)
    else:
        mid = (0.55 * radius, 0.0, 0.15 * start[2] + 0.85 * rise)
        spoke = rope([start, (1.3 * hub, 0, start[2]), mid, end], wide, 6)
    rim = moved(_rim(radius, thick, n, int(rng.integers(4))), at(0, 0, rise))
    solids = [rim, around(spoke, count), _hub(hub, tall, rng)]
    if rng.random() < 0.12:
        solids.append(cylinder_at(0.08 * radius + 0.004, rise, rise + 0.5 * radius, 0.93 * radius))
    return merge(solids)


def cylinder_at(radius: float, low: float, high: float, x: float) -> Solid:
    """A grip that stands on a rim [m]."""
    return moved(cylinder(radius, low, high, 10), at(x))


def _wire(radius: float, style: ModelingStyle, rng: Rng) -> Solid:
    """A wheel of bent wire: a thin rim, pairs of thin spokes, a pressed hub plate."""
    thick, count = 0.002 + 0.025 * radius, int(rng.integers(2, 5))
    hub, tall = 0.22 * radius, 0.012 + 0.06 * radius
    rise = float(rng.uniform(0.0, 0.3)) * radius
    pair = [
        rod((0, s * 0.6 * hub, 0.5 * tall), (0.93 * radius, s * 0.12 * radius, 0.5 * tall + rise), 0.8 * thick, 6)
        for s in (-1, 1)
    ]
    rim = moved(torus(radius - thick, thick, max(16, style.round(radius)), 8), at(0, 0, 0.5 * tall + rise))
    return merge([rim, around(merge(pair), count), cylinder(hub, 0, tall, 16)])


def _disc(radius: float, style: ModelingStyle, rng: Rng) -> Solid:
    """A solid disc with round, slotted or no holes and a thick edge."""
    n, count = max(16, style.round(radius)), int(rng.integers(3, 9))
    thick = 0.004 + 0.05 * radius
    kind = int(rng.integers(3))
    turns = np.arange(count) * 2 * np.pi / count + 0.1
    holes: tuple[Floats, ...] = ()
    if kind == 0:
        size = min(0.2, 0.9 / count) * radius
        holes = tuple(circle(size, 12, (0.62 * radius * np.cos(t), 0.62 * radius * np.sin(t))) for t in turns)
    elif kind == 1:
        half = 2.2 / count
        for t in turns:
            sweep_ = np.linspace(t - half, t + half, 5)
            arc_ = [(0.8 * radius * np.cos(a), 0.8 * radius * np.sin(a)) for a in sweep_]
            arc_ += [(0.42 * radius * np.cos(a), 0.42 * radius * np.sin(a)) for a in sweep_[::-1]]
            holes += (np.array(arc_),)
    plate = extrude(circle(0.93 * radius, n), 0.3 * thick, 0.9 * thick, holes)
    edge = moved(_rim(radius, 0.07 * radius, n, int(rng.integers(4))), at(0, 0, 0.6 * thick))
    return merge([plate, edge, _hub(0.22 * radius + 0.002, 1.8 * thick + 0.15 * radius, rng)])


def _dished(radius: float, style: ModelingStyle, rng: Rng) -> Solid:
    """A pressed sheet wheel: a cone or bowl with a rolled edge."""
    n, t = max(16, style.round(radius)), 0.0015 + 0.015 * radius
    deep, roll = float(rng.uniform(0.15, 0.45)) * radius, float(rng.uniform(0.05, 0.10)) * radius
    line = [
        (0.0, 0.0),
        (0.25 * radius, 0.0),
        (0.55 * radius, float(rng.uniform(0.2, 0.9)) * deep),
        (radius - roll, deep),
    ]
    under = [(0.002 * radius, -t), *[(r + 0.3 * t, z - t) for r, z in line[1:]]]
    bowl = turned([*under, *line[:0:-1]], n)
    return merge(
        [
            bowl,
            moved(torus(radius - roll, roll, n, 8), at(0, 0, deep)),
            cylinder(0.14 * radius, -t, 0.1 * radius + t, 12),
        ]
    )


def _lobed(radius: float, style: ModelingStyle, rng: Rng) -> Solid:
    """A knob with a wavy, fluted or knurled edge, flat, domed or conical."""
    count = int(rng.integers(3, 13))
    wave = float(rng.uniform(0.04, 0.16)) if count > 4 else float(rng.uniform(0.12, 0.2))
    turns = np.linspace(0, 2 * np.pi, 6 * count, endpoint=False)
    reach = 1 - wave + wave * np.cos(count * turns) * (1 if rng.random() < 0.6 else np.abs(np.cos(count * turns)))
    tall = float(rng.uniform(0.35, 1.1)) * radius
    levels = [(0.45, 0.0), (0.7, 0.25), (1.0, 0.4), (1.0, 0.85), (0.8, 1.0)]
    if rng.random() < 0.4:
        levels = [(1.0, 0.0), (0.97, 0.8), (0.85, 1.0)]
    loops = [
        np.column_stack(
            [s * radius * reach * np.cos(turns), s * radius * reach * np.sin(turns), np.full(len(turns), h * tall)]
        )
        for s, h in levels
    ]
    return weld([loft([np.zeros((1, 3)), *loops, np.array([[0.0, 0.0, tall]])])])


def _star(radius: float, style: ModelingStyle, rng: Rng) -> Solid:
    """A star grip: three to six short arms that end in balls or rounds; a cross handle where there are four."""
    count, knob = int(rng.integers(3, 7)), radius * float(rng.uniform(0.12, 0.2))
    slim = knob * float(rng.uniform(0.5, 0.9))
    arm = [rod((0, 0, knob), (radius - knob, 0, knob), slim, 8)]
    arm.append(moved(ball(knob, 10), at(radius - knob, 0, knob)))
    return merge(
        [
            around(merge(arm), count),
            turned([(0.3 * radius, 0), (0.32 * radius, 1.6 * knob), (0.15 * radius, 2.2 * knob)], 14),
        ]
    )


def _cross(radius: float, style: ModelingStyle, rng: Rng) -> Solid:
    """A cross handle, as of taps and capstans: four long tapered or square arms, maybe within a ring."""
    slim = 0.07 * radius + 0.002
    if rng.random() < 0.5:
        arm = along(
            "x",
            turned([(0.7 * slim, 0.0), (slim, 0.8 * radius), (1.3 * slim, 0.92 * radius), (0.6 * slim, radius)], 8),
            0,
            0,
            1.6 * slim,
        )
    else:
        arm = box((radius, 1.8 * slim, 1.8 * slim), (radius / 2, 0, 1.6 * slim))
    solids = [around(arm, 4), _hub(0.22 * radius, 3.2 * slim, rng)]
    if rng.random() < 0.25:
        solids.append(moved(torus(0.75 * radius, 0.7 * slim, max(16, style.round(radius)), 6), at(0, 0, 1.6 * slim)))
    return merge(solids)


def _tubular(radius: float, style: ModelingStyle, rng: Rng) -> Solid:
    """A wheel of bent pipe on two to four flat bars, the rim well above the hub."""
    thick, count = 0.004 + 0.05 * radius, int(rng.integers(2, 5))
    deep = float(rng.uniform(0.2, 0.5)) * radius
    flat = np.array([[-1.5, -0.35], [1.5, -0.35], [1.5, 0.35], [-1.5, 0.35]]) * thick
    path = np.array(
        [(0.05 * radius, 0, 0.08 * radius), (0.45 * radius, 0, 0.08 * radius), (0.97 * radius - thick, 0, deep)]
    )
    bar = sweep(path, flat, up=(0.0, 1.0, 0.0))
    rim = moved(torus(radius - thick, thick, max(16, style.round(radius)), 8), at(0, 0, deep))
    return merge([rim, around(bar, count), cylinder(0.16 * radius + 0.003, 0.0, 0.16 * radius + 0.01, 12)])


WHEELS: dict[str, Callable[[float, ModelingStyle, Rng], Solid]] = {
    "spoked": _spoked, "wire": _wire, "disc": _disc, "dished": _dished, "lobed": _lobed, "star": _star,
    "cross": _cross, "tubular": _tubular,
}  # fmt: skip
_CAST = ("spoked", "spoked", "spoked", "disc", "dished", "tubular", "wire")


def wheel_of(radius: float, style: ModelingStyle, rng: Rng, kinds: tuple[str, ...] = _CAST) -> Solid:
    """A handwheel of one of some makes about z, its hub standing on z = 0 [m]."""
    return moved(WHEELS[str(rng.choice(kinds))](radius, style, rng), spun("z", float(rng.uniform(0, 6))))


# --- levers, pointing along +x ---


def _strip(path: Floats, half: float, thick: float) -> Solid:
    section = np.array([[half, -thick / 2], [half, thick / 2], [-half, thick / 2], [-half, -thick / 2]])
    return sweep(path, section, up=(0.0, 1.0, 0.0))


def _sleeve(length: float, rise: float, half: float, thick: float, share: float) -> Solid:
    """The plastic grip over a flat lever's outer part."""
    outline = moved(
        slab(rounded_rectangle(share * length, 2.3 * half, 0.9 * half, 3), -1.6 * thick, 1.6 * thick),
        at(length * (1 - share / 2), 0, rise),
    )
    return outline


def _sheet(length: float, style: ModelingStyle, rng: Rng) -> Solid:
    """A flat lever of sheet, bent up once or twice, with or without a plastic sleeve."""
    half, thick = 0.05 * length + 0.004, 0.002 + 0.012 * length
    rise = float(rng.uniform(-0.02, 0.28)) * length
    knee = float(rng.uniform(0.15, 0.4)) * length
    path = np.array(
        [
            (-1.4 * half, 0, thick),
            (knee, 0, thick),
            (knee + abs(rise) + 0.02 * length, 0, thick + rise),
            (length, 0, thick + rise),
        ]
    )
    solids = [_strip(path, half, thick), cylinder(1.1 * half, 0.0, 1.2 * thick, 12)]
    solids.append(hexagon(1.2 * half, 1.5 * thick, 1.5 * thick + 0.4 * half))
    if rng.random() < 0.6:
        solids.append(_sleeve(length, thick + rise, half, thick, float(rng.uniform(0.4, 0.6))))
    return merge(solids)


def _cast(length: float, style: ModelingStyle, rng: Rng) -> Solid:
    """A cast lever: an eye on the stem, a web that narrows, a round end."""
    eye, neck, end = 0.11 * length, 0.04 * length, float(rng.uniform(0.04, 0.07)) * length
    turns = np.linspace(-np.pi / 2, np.pi / 2, 6)
    tip = [(length - end + end * float(np.cos(t)), end * float(np.sin(t))) for t in turns]
    outline = np.array([(0.7 * eye, -neck), *tip, (0.7 * eye, neck)])
    thick = 0.035 * length + 0.002
    web = extrude(outline, 0.4 * thick, 1.3 * thick)
    rib = box((0.75 * length, 0.5 * neck, 2.0 * thick), (0.5 * length, 0, thick))
    return merge([web, rib, cylinder(eye, 0.0, 2.4 * thick, 16), box((eye, eye, 0.8 * thick), (0, 0, 2.6 * thick))])


def _bar(length: float, style: ModelingStyle, rng: Rng) -> Solid:
    """A round bar through a socket on the stem: sloping, cranked or straight, with a ball, a grip or a bare end."""
    slim, socket = 0.022 * length + 0.003, 0.06 * length + 0.005
    tilt = float(rng.choice([0.0, 0.25, 0.6]))
    tip = np.array([length * np.cos(tilt), 0.0, socket + length * np.sin(tilt)])
    path = (
        [(-1.3 * socket, 0, socket), (0.3 * length, 0, socket), tuple(tip)]
        if rng.random() < 0.5
        else [(-socket, 0, socket - 0.9 * np.tan(tilt) * socket), tuple(tip)]
    )
    solids = [rope(path, slim, 8), cylinder(socket, 0.0, 2 * socket, 12)]
    end = rng.random()
    if end < 0.4:
        solids.append(moved(ball(2.2 * slim, 10), at(*tip)))
    elif end < 0.8:
        way = (tip - np.array(path[-2])) / np.linalg.norm(tip - np.array(path[-2]))
        solids.append(rod(tuple(tip - 0.35 * length * way), tuple(tip + 0.02 * length * way), 1.6 * slim, 10))
    return merge(solids)


def _loop(length: float, style: ModelingStyle, rng: Rng) -> Solid:
    """An oval ring of bent wire, flat or rising: the stem sits in one end or in its middle."""
    slim, wide = 0.015 * length + 0.002, float(rng.uniform(0.14, 0.3)) * length
    turns = np.arange(16) * np.pi / 8
    middle = float(rng.choice([0.0, 0.42])) * length
    path = np.column_stack([middle + 0.55 * length * np.cos(turns), wide * np.sin(turns), np.full(16, 2 * slim)])
    wire = sweep(path, circle(slim, 6), closed=True)
    plate = box((0.16 * length, 2 * wide, 1.4 * slim), (0, 0, 2 * slim))
    return merge([wire, plate, cylinder(0.06 * length + 0.002, 0.0, 3.5 * slim, 12)])


def _wing(length: float, style: ModelingStyle, rng: Rng) -> Solid:
    """A butterfly handle: two wings up from the hub, plain or pierced."""
    reach, wide = 0.4 * length, 0.14 * length
    droop = float(rng.uniform(0.5, 1.1))
    upper = [(reach, wide * 2.0), (0.85 * reach, wide * 2.3), (0.4 * reach, wide * 1.5), (0.0, wide * 1.2)]
    lower = [(0.0, 0.0), (0.4 * reach, 0.1 * wide), (0.9 * reach, droop * wide)]
    outline = np.array([*lower, *upper, *[(-x, z) for x, z in upper[-2::-1]], *[(-x, z) for x, z in lower[:0:-1]]])
    holes = tuple(circle(0.3 * wide, 8, (s * 0.68 * reach, 1.25 * wide)) for s in (-1, 1)) if rng.random() < 0.4 else ()
    thick = 0.02 * length + 0.0015
    blade = moved(slab(outline, -thick, thick, holes), spun("x", np.pi / 2))
    return merge([blade, cylinder(0.6 * wide, 0.0, 1.3 * wide, 12)])


def _tee(length: float, style: ModelingStyle, rng: Rng) -> Solid:
    """A tee key: a socket and a cross bar, round, flat or moulded with fingers' hollows."""
    tall, slim = float(rng.uniform(0.12, 0.6)) * length, 0.035 * length + 0.002
    kind = int(rng.integers(3))
    if kind == 0:
        top = along("x", turned([(slim, -0.5 * length), (0.8 * slim, 0.0), (slim, 0.5 * length)], 8), 0, 0, tall)
    elif kind == 1:
        top = box((length, 1.2 * slim, 2.4 * slim), (0, 0, tall))
    else:
        xs = np.linspace(-0.5, 0.5, 13)
        wide = 2.4 * slim * (1 + 0.25 * np.cos(6 * np.pi * xs))
        outline = np.vstack([np.column_stack([xs * length, -wide]), np.column_stack([xs[::-1] * length, wide[::-1]])])
        top = moved(slab(outline, -1.3 * slim, 1.3 * slim), at(0, 0, tall))
    return merge([top, cylinder(1.5 * slim, 0.0, tall, 12), cylinder(2.2 * slim, 0.0, 0.3 * tall, 12)])


def _notched(length: float, style: ModelingStyle, rng: Rng) -> Solid:
    """A ten-position lever of wafer butterfly valves: a grip with a spring trigger below it."""
    half, thick = 0.045 * length + 0.005, 0.02 * length + 0.003
    rise = 0.1 * length
    path = np.array([(-half, 0, thick), (0.25 * length, 0, thick), (0.4 * length, 0, rise), (length, 0, rise)])
    trigger = _strip(
        np.array([(0.22 * length, 0, -0.2 * thick), (0.45 * length, 0, 0.3 * rise), (0.85 * length, 0, 0.25 * rise)]),
        0.6 * half,
        0.7 * thick,
    )
    pivot = along("y", cylinder(0.6 * thick, -1.3 * half, 1.3 * half, 8), 0.4 * length, 0, 0.6 * rise)
    sides = [box((0.2 * length, 0.15 * half, 0.9 * rise), (0.4 * length, s * 0.9 * half, 0.55 * rise)) for s in (-1, 1)]
    return merge([_strip(path, half, thick), trigger, pivot, *sides, cylinder(1.3 * half, -0.2 * thick, 2 * thick, 14)])


def _spanner(length: float, style: ModelingStyle, rng: Rng) -> Solid:
    """A box wrench on the stem's square: a ring, a long I-shaped shank, a round or hollow end."""
    eye, thick = 0.09 * length + 0.004, 0.02 * length + 0.003
    shank = box((0.85 * length, 0.07 * length, thick), (0.5 * length, 0, thick))
    ribs = [
        box((0.85 * length, 0.014 * length, 1.6 * thick), (0.5 * length, s * 0.03 * length, thick)) for s in (-1, 1)
    ]
    end = moved(ring(0.02 * length, 0.05 * length, 0.5 * thick, 1.5 * thick, 14), at(0.95 * length))
    return merge(
        [
            shank,
            *ribs,
            end,
            ring(0.5 * eye, eye, 0.0, 2 * thick, 16),
            box((1.1 * eye, 1.1 * eye, 2.4 * thick), (0, 0, 1.2 * thick)),
        ]
    )


LEVERS: dict[str, Callable[[float, ModelingStyle, Rng], Solid]] = {
    "sheet": _sheet, "cast": _cast, "bar": _bar, "loop": _loop, "wing": _wing, "tee": _tee, "notched": _notched,
    "spanner": _spanner,
}  # fmt: skip
_LONG = ("sheet", "sheet", "cast", "bar", "loop", "spanner")


def lever_of(length: float, style: ModelingStyle, rng: Rng, kinds: tuple[str, ...] = _LONG) -> Solid:
    """A lever of one of some makes on z = 0, along, across or against the run [m]."""
    solid = LEVERS[str(rng.choice(kinds))](length, style, rng)
    return moved(solid, spun("z", float(rng.choice([0.0, 0.0, 0.5, 1.0, -0.5])) * np.pi))
