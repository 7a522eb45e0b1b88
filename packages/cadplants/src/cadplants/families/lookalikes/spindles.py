"""Valves whose gland, nuts, studs and stem stand round one axis, and valves of a sleeve on the pipe."""

from __future__ import annotations

from functools import partial

import numpy as np

from cadplants.families.chance import chance, num, pick
from cadplants.families.primitive.shape import cone, disc, family, lying, part, sized, spoked
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle
from cadplants.primitives import box, cylinder, hexagon, ring, rod, turned
from cadplants.standards import FLANGES, PIPES
from cadplants.transforms import at, spun

__all__ = ["SPINDLES_ALIKE"]

_VALVE, _BODY, _HELD = "Valve assembly", "valve body", "Connection assembly"


def _packing(stem: float, z: float, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float]:
    """A packing gland round a stem about z on a height: a round or six-sided ring, a follower with two studs, a cap
    nut; and the height of its top [m].
    """
    bore = 1.04 * stem if style.hollow else 0.0
    wide, high = stem * num(rng, 1.8, 2.6), stem * num(rng, 1.0, 2.6)
    n, kind = style.round(wide), int(rng.integers(4))
    if kind == 0:
        return [part("gland", moved(ring(bore, wide, 0.0, high, n), at(0, 0, z)), color="trim", bundle=_BODY)], z + high
    if kind == 1:
        nut = moved(hexagon(2 * wide, 0.0, high, bore, n), at(0, 0, z))
        return [part("gland", nut, color="trim", bundle=_BODY)], z + high
    if kind == 2:
        lip = [ring(bore, wide, 0.0, high, n), hexagon(2.4 * wide, 0.4 * high, 0.9 * high, bore, n)]
        return [part("gland", *(moved(one, at(0, 0, z)) for one in lip), color="trim", bundle=_BODY)], z + high
    reach, bolt = 1.9 * wide, 0.35 * stem + 0.0015
    plate = extrude(circle(0.7 * wide, 12) * (4.2, 1.3), z, z + 0.5 * high, (circle(bore, 12),) if bore else ())
    collar = moved(ring(bore, 0.8 * wide, -0.4 * high, 0.0, n), at(0, 0, z))
    parts = [part("gland", plate, collar, color="trim", bundle=_BODY)]
    if style.fasteners != "none":
        for y in (-reach, reach):
            stud = moved(cylinder(bolt, z - high, z + 1.4 * high, 8), at(y))
            nut = moved(hexagon(3.2 * bolt, z + 0.5 * high, z + 0.5 * high + 1.6 * bolt), at(y))
            parts.append(Part(stud, "stud", "fastener", _BODY, _HELD, True))
            parts.append(Part(nut, "nut", "fastener", _BODY, _HELD, True))
    return parts, z + 0.5 * high


def _yoke(low: float, high: float, reach: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """Two columns and a bridge about z: round like studs, or flat [m]."""
    t = 0.16 * reach + 0.002
    if chance(rng, 0.5):
        columns = [moved(cylinder(0.7 * t, low, high, min(style.round(t), 16)), at(s * reach)) for s in (-1, 1)]
    else:
        columns = [box((t, 1.8 * t, high - low), (s * reach, 0, (low + high) / 2)) for s in (-1, 1)]
    bridge = moved(cylinder(reach * 0.5, 0.0, 1.6 * t, style.round(reach)), at(0, 0, high - 1.6 * t))
    bar = box((2 * reach, 1.6 * t, t), (0, 0, high - t))
    if chance(rng, 0.4):
        return [part("yoke", one, color="valve", bundle=_BODY) for one in (*columns, merge([bridge, bar]))]
    return [part("yoke", *columns, bridge, bar, color="valve", bundle=_BODY)]


def _wheel(radius: float, z: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A handwheel at a height, in one mesh or its ring, hub and spokes apart [m]."""
    thick = 0.09 * radius
    solids = spoked(radius, thick, int(rng.integers(3, 7)), style)
    solids.append(disc(0.2 * radius, -thick, 1.4 * thick, style))
    lifted = [moved(one, at(0, 0, z)) for one in solids]
    if chance(rng, 0.6):
        return [part("handwheel", *lifted, color="handle", bundle="handwheel")]
    return [part("handwheel", one, color="handle", bundle="handwheel") for one in lifted]


def _rising(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A flanged valve whose stem rises through a gland and a yoke, with studs round its bonnet at times."""
    r, rim = PIPES[dn].radius, FLANGES[dn].outer / 2
    length, thick = round(2 * rim * num(rng, 0.9, 1.3) + 0.04, 6), FLANGES[dn].thickness
    middle, stem = at(length / 2), 0.16 * r + 0.003
    body = [
        lying(disc(1.15 * r, 0.0, length, style)),
        lying(disc(rim, 0, thick, style)),
        lying(disc(rim, length - thick, length, style)),
    ]
    body.append(moved(turned([(1.2 * r, -1.3 * r), (1.4 * r, 0.0), (1.0 * r, 1.6 * r)], style.round(1.4 * r)), middle))
    top = 1.6 * r + thick
    body.append(moved(disc(1.5 * r, 1.6 * r, top, style), middle))
    parts = [part(_BODY, *body, bundle=_BODY)]
    lid = merge(
        [disc(1.5 * r, top, top + thick, style), cone(r, 2.6 * stem, top + thick, top + thick + 0.6 * r, style)]
    )
    upper = [part("valve bonnet", lid, bundle=_BODY)]
    glands, z = _packing(stem, top + thick + 0.6 * r, style, rng)
    bridge = z + 0.9 * r + 0.03
    upper += [*glands, *_yoke(top + thick, bridge, 1.1 * r, style, rng)]
    tip = bridge + r * num(rng, 0.3, 2.2)
    upper.append(part("valve stem", disc(stem, top, tip, style), color="trim", bundle=_BODY))
    upper += _wheel(1.3 * r + 0.04, bridge + 0.02, style, rng)
    if chance(rng, 0.5):
        nut = hexagon(
            4.6 * stem, bridge + 0.03 + 0.1 * r, bridge + 0.04 + 0.1 * r + stem, 1.02 * stem if style.hollow else 0.0
        )
        upper.append(Part(nut, "nut", "fastener", _BODY, _HELD, True))
    if style.fasteners != "none":
        for k in range(pick(rng, 4, 6, 8)):
            pose = spun("z", 0.4 + k * np.pi / 4) @ at(1.28 * r)
            bolt = 0.08 * r + 0.002
            stud = merge([cylinder(bolt, 1.6 * r - 0.4 * thick, top + 1.6 * thick, 8)])
            upper.append(Part(moved(stud, pose), "stud", "fastener", _BODY, _HELD, True))
    return Model([*parts, *placed(upper, middle)], length, kind="gate valve")


def _screwed(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A small screwed valve with a six-sided or round packing gland round a thin stem, and a wheel or a bar."""
    r = PIPES[dn].radius
    length, stem = round(r * num(rng, 4.0, 6.0) + 0.01, 6), 0.2 * r + 0.002
    sides = pick(rng, 6, 8)
    ends = [lying(cylinder(1.3 * r, 0.0, 0.3 * length, sides)), lying(cylinder(1.3 * r, 0.7 * length, length, sides))]
    hub = moved(turned([(r, -1.1 * r), (1.3 * r, 0.0), (0.9 * r, 1.5 * r)], style.round(1.3 * r)), at(length / 2))
    core = lying(disc(1.05 * r, 0.0, length, style))
    upper, z = _packing(stem, 1.5 * r, style, rng)
    tip = z + r * num(rng, 0.8, 2.0)
    upper.append(part("valve stem", disc(stem, r, tip, style), color="trim", bundle=_BODY))
    if chance(rng, 0.6):
        upper += _wheel(1.2 * r + 0.015, tip - 0.1 * r, style, rng)
    else:
        bar = box((4.0 * r + 0.04, 0.9 * r, 0.2 * r), (1.4 * r, 0, tip - 0.1 * r))
        upper.append(part("lever", bar, color="handle", bundle="lever"))
        nut = moved(hexagon(3.4 * stem, tip, tip + stem), at())
        upper.append(Part(nut, "nut", "fastener", _BODY, _HELD, True))
    return Model(
        [part(_BODY, *ends, hub, core, bundle=_BODY), *placed(upper, at(length / 2))], length, "welded", "globe valve"
    )


def _sleeve(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A sleeve on the pipe with a rod and a wheel whose ring, hub and spokes are apart, beside or over the line."""
    r = PIPES[dn].radius
    length, wide = round(r * num(rng, 2.0, 4.0) + 0.02, 6), r * num(rng, 1.1, 1.6)
    body = [lying(disc(wide, 0.0, length, style))]
    if chance(rng, 0.5):
        body += [lying(disc(1.25 * wide, low, low + 0.1 * length, style)) for low in (0.0, 0.9 * length)]
    rise = wide + num(rng, 0.04, 0.15)
    parts = [part(_BODY, *body, bundle=_BODY)]
    upper = [part("valve stem", disc(0.2 * r + 0.004, 0.8 * wide, rise, style), color="trim", bundle=_BODY)]
    radius, thick, count = wide + num(rng, 0.05, 0.12), num(rng, 0.006, 0.014), int(rng.integers(3, 7))
    wheel: list[Solid] = spoked(radius, thick, count, style)
    if chance(rng, 0.4):
        # A thick bar for each spoke, square, and a drum for the hub.
        wheel[1:] = [
            moved(box((radius, thick, thick), (radius / 2, 0, 0)), spun("z", 2 * np.pi * k / count))
            for k in range(count)
        ]
    wheel.append(disc(0.18 * radius, -2 * thick, 2 * thick, style))
    upper += [part("handwheel", moved(one, at(0, 0, rise)), color="handle", bundle="handwheel") for one in wheel]
    turn = at(length / 2) @ spun("x", pick(rng, 0.0, 0.5, -0.5) * np.pi)
    return Model([*parts, *placed(upper, turn)], length, "welded", "valve")


def _quarter(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A sleeve or a block with a bar: no flanges of its own, the bar along or across the line."""
    r = PIPES[dn].radius
    length = round(r * num(rng, 2.4, 4.0) + 0.02, 6)
    middle = box((0.6 * length, 2.5 * r, 2.5 * r), (length / 2, 0, 0))
    body = [
        lying(disc(1.2 * r, 0.0, length, style)),
        middle if chance(rng, 0.5) else lying(disc(1.5 * r, 0.2 * length, 0.8 * length, style)),
    ]
    top = 1.6 * r + 0.02
    stem = moved(disc(0.25 * r + 0.003, r, top, style), at(length / 2))
    reach, turn = 3 * r + num(rng, 0.04, 0.12), pick(rng, 0.0, 0.5, 1.0) * np.pi
    tilt = pick(rng, 0.0, 0.3)
    bar = moved(
        box((reach, 0.7 * r, 0.006), (0.45 * reach, 0, 0)), at(length / 2, 0, top) @ spun("z", turn) @ spun("y", -tilt)
    )
    parts = [part(_BODY, *body, bundle=_BODY), part("valve stem", stem, color="trim", bundle=_BODY)]
    if chance(rng, 0.4):
        turned_bar = at(length / 2, 0, top) @ spun("z", turn) @ spun("y", -tilt)
        knob = moved(rod((0, 0, -0.03), (0, 0, 0.03), 0.012, 8), turned_bar @ at(0.9 * reach))
        return Model([*parts, part("lever", bar, knob, color="handle", bundle="lever")], length, "welded", "ball valve")
    return Model([*parts, part("lever", bar, color="handle", bundle="lever")], length, "welded", "ball valve")


_SMALL = sized(15, 50)

SPINDLES_ALIKE: tuple[Family, ...] = (
    family("gate valve/gland in yoke", "inline", _VALVE, _rising, "valve", sized(25, 400), 2.0),
    family("globe valve/packing nut", "inline", _VALVE, _screwed, "valve", _SMALL, 2.0),
    family("valve/sleeve with spoked wheel", "inline", _VALVE, _sleeve, "valve", weight=1.5),
    family("ball valve/sleeve with bar", "inline", _VALVE, partial(_quarter), "valve", _SMALL, 1.0),
)
