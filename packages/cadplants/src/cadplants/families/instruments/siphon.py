"""Siphons under gauges and switches (DIN 16282 forms and others), each in one construction, on an outlet."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.instruments.kit import (
    CASE,
    STEM,
    bent,
    fine_sides,
    housing,
    indicator,
    piece,
    shank,
    standing,
    t_handle,
    upright,
)
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import Solid, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import along, around, box, cylinder, hexagon, rope, turned
from cadplants.transforms import at, spun

__all__ = ["SIPHON_BUILDS"]

_NAME = "siphon"
_TUBES = (0.0053, 0.0068, 0.0086, 0.0107)  # m, radii of steam siphon pipes, 1/4 to 1/2 in


def _arc(center: tuple[float, float], radius: float, first: float, last: float, drift: float = 0.0) -> Floats:
    """Points round an axis along y from one angle to another, moving on along it by ``drift`` [m, rad]."""
    count = max(5, int(np.ceil(abs(last - first) / (np.pi / 8))) + 1)
    t = np.linspace(first, last, count)
    x, z = center[0] + radius * np.cos(t), center[1] + radius * np.sin(t)
    return np.column_stack([x, drift * np.linspace(0, 1, count), z])


def _joined(*pieces: Floats | list[tuple[float, float, float]]) -> Floats:
    path = np.vstack([np.asarray(p, float) for p in pieces])
    keep = np.concatenate([[True], np.linalg.norm(np.diff(path, axis=0), axis=1) > 1e-5])
    return np.asarray(path[keep])


def _fittings(
    low: float, high: float, r: float, x: float, y: float, style: ModelingStyle, rng: np.random.Generator
) -> list[Solid]:
    """What is at the two ends of a siphon: hexagons, sleeves or nothing at the foot; a nut at the top [m]."""
    n = fine_sides(r, style)
    kind, solids = int(rng.integers(4)), []
    if kind == 0:
        solids.append(hexagon(3.2 * r, low, low + 0.016))
    elif kind == 1:
        solids.append(cylinder(1.4 * r, low, low + 0.022, n))
    elif kind == 2:  # a shut-off valve at the foot
        solids.append(box((3.4 * r, 3.4 * r, 0.03), (0, 0, low + 0.016)))
        solids.append(along("-y", t_handle(0.05, 0.045), 0, -1.6 * r, low + 0.016))
    top = hexagon(2 * r + 0.013, high - 0.022, high)
    solids.append(moved(merge([top, cylinder(1.25 * r, high - 0.034, high - 0.02, n)]), at(x, y)))
    return solids


def _topped(
    path: Floats,
    r: float,
    style: ModelingStyle,
    rng: np.random.Generator,
    more: list[Solid] | None = None,
    kind: str = "",
) -> Model:
    """A siphon along a path that ends upwards, with a gauge, transmitter or switch on its end."""
    x, y, z = (float(v) for v in path[-1])
    solids = [rope(path, r, fine_sides(r, style, 12)), *_fittings(0.002, z, r, x, y, style, rng), *(more or [])]
    parts = [piece(solids, _NAME, str(rng.choice(["trim", "pipe", "gauge"])))]
    draw = rng.random()
    if draw < 0.72:
        parts += placed(standing(z, style, rng), at(x, y))
        return Model(parts, kind=kind or "pressure gauge")
    neck = cylinder(0.011, z - 0.002, z + 0.05, 12)
    if draw < 0.86:
        head = merge([neck, hexagon(0.027, z + 0.004, z + 0.018), moved(housing(style, rng), at(0, 0, z + 0.046))])
        parts.append(piece(moved(head, at(x, y)), "transmitter", "valve"))
        return Model(parts, kind="pressure transmitter")
    case = upright(indicator(0.08, 0.1, 0.06, style, rng), 0.1, z + 0.048)
    parts += placed([piece(neck, STEM, "trim"), *case], at(x, y))
    return Model(parts, kind="pressure switch")


def _radius(rng: np.random.Generator) -> float:
    return float(rng.choice(_TUBES))


def _pigtail(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A pigtail: the pipe goes up, makes a ring or two about a level axis and goes on upwards (DIN 16282 form C)."""
    r, turns = _radius(rng), int(rng.choice([1, 1, 2]))
    reach = float(rng.uniform(3.6, 6.5)) * r
    low = reach + r + float(rng.uniform(0.015, 0.05))
    loop = _arc((reach, low), reach, np.pi, np.pi - 2 * np.pi * turns, 2.3 * r * turns)
    end = [(0.0, 2.3 * r * turns, low + reach + float(rng.uniform(0.04, 0.12)))]
    return _topped(_joined([(0, 0, 0)], loop, end), r, style, rng)


def _u(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A U siphon: up, over, down and up again in one plane (DIN 16282 form A or B)."""
    r = _radius(rng)
    first, second = float(rng.uniform(3, 5)) * r, float(rng.uniform(3, 7)) * r
    high = float(rng.uniform(0.08, 0.2))
    low = float(rng.uniform(-0.02, 0.3)) * high + second + r
    top = high + float(rng.uniform(-0.02, 0.12))
    over = _arc((first, high), first, np.pi, 0.0)
    under = _arc((2 * first + second, low), second, np.pi, 2 * np.pi)
    end = [(2 * (first + second), 0.0, max(top, low + 0.07))]
    return _topped(_joined([(0, 0, 0)], over, under, end), r, style, rng)


def _trumpet(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A trumpet: the pipe leaves sideways, makes one and a quarter rings and ends upwards (DIN 16282 form D)."""
    r = _radius(rng)
    reach, bend = float(rng.uniform(3.6, 6)) * r, 3.2 * r
    low, out = float(rng.uniform(0.03, 0.07)), float(rng.uniform(0.5, 2.0)) * reach
    turn = _arc((bend, low), bend, np.pi, np.pi / 2)
    middle = (bend + out + reach * 0.2, low + bend + reach)
    loop = _arc(middle, reach, -np.pi / 2, 2 * np.pi, 2.6 * r)
    end = [(middle[0] + reach, 2.6 * r, middle[1] + float(rng.uniform(0.06, 0.12)))]
    return _topped(_joined([(0, 0, 0)], turn, loop, end), r, style, rng)


def _coil(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A straight siphon with a cooling coil of several turns about its own upright axis."""
    r, turns = float(rng.choice(_TUBES[:3])), int(rng.integers(3, 7))
    reach, pitch = float(rng.uniform(3.0, 5.5)) * r, float(rng.uniform(2.1, 3.0)) * r
    low = float(rng.uniform(0.03, 0.07))
    t = np.linspace(0, 2 * np.pi * turns, 12 * turns + 1)
    helix = np.column_stack([reach * np.cos(t), reach * np.sin(t), low + 0.012 + pitch * t / (2 * np.pi)])
    high = float(helix[-1, 2])
    start = [
        (0, 0, 0),
        (0, 0, low - 2 * r),
        (0.25 * reach, -0.3 * reach, low),
        (0.8 * reach, -0.55 * reach, low + 0.006),
    ]
    end = [
        (0.8 * reach, 0.55 * reach, high + 0.006),
        (0.25 * reach, 0.3 * reach, high + 0.012),
        (0, 0, high + 0.02 + r),
    ]
    top = [(0.0, 0.0, high + 0.02 + r + float(rng.uniform(0.04, 0.09)))]
    return _topped(_joined(start, helix, end, top), r, style, rng)


def _finned(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cooling element: a straight pipe with round or square fins, or a finned sleeve, under a gauge."""
    r, count = _radius(rng), int(rng.integers(5, 14))
    low, pitch = float(rng.uniform(0.025, 0.05)), float(rng.uniform(0.005, 0.009))
    wide = float(rng.uniform(1.8, 3.2)) * r
    high = low + count * pitch
    if rng.random() < 0.3:
        fins = [box((2 * wide, 2 * wide, 0.4 * pitch), (0, 0, low + (k + 0.5) * pitch)) for k in range(count)]
    else:
        profile: list[tuple[float, float]] = []
        for k in range(count):
            z = low + k * pitch
            profile += [(1.3 * r, z), (wide, z), (wide, z + 0.45 * pitch), (1.3 * r, z + 0.45 * pitch)]
        fins = [turned(profile, min(24, style.round(wide)))]
    path = np.array([(0, 0, 0), (0, 0, high + float(rng.uniform(0.03, 0.07)))])
    return _topped(path, r, style, rng, fins)


def _bent(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A bent pipe: two elbows that set a gauge off to the side, or a swan neck with a small drop."""
    r, out = _radius(rng), float(rng.uniform(0.06, 0.2))
    low, rise = float(rng.uniform(0.05, 0.1)), float(rng.uniform(0.05, 0.14))
    bend = 3.0 * r
    if rng.random() < 0.6:
        first = _arc((bend, low), bend, np.pi, np.pi / 2)
        second = _arc((out, low + 2 * bend), bend, -np.pi / 2, 0.0)
        path = _joined([(0, 0, 0)], first, second, [(out + bend, 0, low + 2 * bend + rise)])
        more = []
        if rng.random() < 0.4:  # screwed elbows in place of bends
            more = [
                moved(hexagon(3.4 * r, z - 0.01, z + 0.004), at(x)) for x, z in ((0, low), (out + bend, low + 2 * bend))
            ]
        return _topped(path, r, style, rng, more)
    points = [(0, 0, 0), (0, 0, low + rise), (out, 0, low + rise), (out, 0, low), (1.6 * out, 0, low)]
    points.append((1.6 * out, 0, low + rise + 0.05))
    solid = bent(points, r, style)
    straight = np.array([(1.6 * out, 0, low + rise), (1.6 * out, 0, low + rise + 0.05)])
    return _topped(straight, r, style, rng, [solid])


def _capsule(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A compact siphon: a closed chamber with an inner pipe, a can, a ball or two welded cups between two nipples."""
    r, wide = _radius(rng), float(rng.uniform(0.018, 0.034))
    low, tall = float(rng.uniform(0.025, 0.045)), float(rng.uniform(0.05, 0.12))
    n, kind = style.round(wide), int(rng.integers(3))
    if kind == 0:
        can = turned([(r, low), (wide, low + 0.3 * wide), (wide, low + tall), (r, low + tall + 0.3 * wide)], n)
    elif kind == 1:
        turns = np.linspace(-1.2, 1.2, 9)
        can = turned([(wide * np.cos(a), low + tall / 2 + tall * 0.55 * np.sin(a)) for a in turns], n)
    else:
        half = low + tall / 2
        can = merge([cylinder(wide, low, low + tall, n), cylinder(1.15 * wide, half - 0.004, half + 0.004, n)])
        can = merge([can, around(hexagon(0.01, half - 0.008, half + 0.008), 6, 1.02 * wide)])
    path = np.array([(0, 0, 0), (0, 0, low + tall + 0.3 * wide + float(rng.uniform(0.035, 0.06)))])
    return _topped(path, r, style, rng, [can])


def _side(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A pigtail that lies on its side behind an elbow: its ring is level, the gauge rises from its far end."""
    r = float(rng.choice(_TUBES[:3]))
    reach, low = float(rng.uniform(4, 6)) * r, float(rng.uniform(0.05, 0.09))
    bend = 3 * r
    first = _arc((bend, low), bend, np.pi, np.pi / 2)
    t = np.linspace(-np.pi / 2, 1.5 * np.pi, 17)
    far, z = bend + float(rng.uniform(0.02, 0.06)), low + bend
    ring_ = np.column_stack(
        [far + reach * np.cos(t), reach + reach * np.sin(t), z + 2.3 * r * (t - t[0]) / (2 * np.pi)]
    )
    last = _arc((far + 0.03 + reach, z + 2.3 * r + bend), bend, -np.pi / 2, 0.0)
    end = [(far + 0.03 + reach + bend, 0.0, z + 2.3 * r + bend + float(rng.uniform(0.05, 0.1)))]
    return _topped(_joined([(0, 0, 0)], first, ring_, last, end), r, style, rng)


def _double(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A U siphon with a tee on top that carries a gauge and a test cock or a switch beside it."""
    r = _radius(rng)
    reach, high = float(rng.uniform(3.5, 5)) * r, float(rng.uniform(0.1, 0.16))
    low = reach + 2 * r
    path = _joined(
        [(0, 0, 0)],
        _arc((reach, high), reach, np.pi, 0.0),
        _arc((3 * reach, low), reach, np.pi, 2 * np.pi),
        [(4 * reach, 0, high + 0.04)],
    )
    z, x, arm = high + 0.04, 4 * reach, float(rng.uniform(0.08, 0.13))
    n = fine_sides(0.012, style)
    tee = merge(
        [cylinder(0.014, z - 0.01, z + 0.05, n), along("x", cylinder(0.011, -0.03, arm + 0.013, n), 0, 0, z + 0.02)]
    )
    solids = [rope(path, r, fine_sides(r, style, 12)), moved(tee, at(x))]
    parts = [piece(solids, _NAME, "trim"), *placed(standing(z + 0.05, style, rng), at(x))]
    side: list[Part]
    if rng.random() < 0.5:
        cock = merge(
            [hexagon(0.024, 0.0, 0.03), along("-y", t_handle(0.045, 0.04), 0, -0.01, 0.02), hexagon(0.02, 0.03, 0.05)]
        )
        side = [piece(cock, STEM, "trim")]
    else:
        side = [shank(-0.002, 0.05, style, rng), *upright(indicator(0.06, 0.09, 0.05, style, rng), 0.09, 0.048)]
        side = [p if p.name != CASE else piece(p.solid, CASE, "valve") for p in side]
    return Model([*parts, *placed(side, at(x + arm, 0, z + 0.028) @ spun("z", 0.0))], kind="pressure gauge")


def _family(name: str, build: object, weight: float = 1.5) -> Family:
    return Family(name, "tap", "Gauge assembly", "gauge", build, (15,), weight=weight)  # type: ignore[arg-type]


SIPHON_BUILDS: tuple[Family, ...] = (
    _family("siphon/pigtail", _pigtail),
    _family("siphon/u", _u),
    _family("siphon/trumpet", _trumpet),
    _family("siphon/coil", _coil),
    _family("siphon/finned", _finned),
    _family("siphon/bent", _bent),
    _family("siphon/capsule", _capsule),
    _family("siphon/level ring", _side),
    _family("siphon/tee", _double),
)
