"""Small valves at their places: hose taps, panels, manifolds, radiators, hydrant valves; and operators of their own."""

from __future__ import annotations

import numpy as np

from cadplants.families.valves.drive import drive, stem, wheel
from cadplants.families.valves.parts import SMALL, bend, body, bonnet, chain, fronted, other, piece, square
from cadplants.families.valves.valve import valve_family
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import Solid, merge, moved, tube
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import along, around, ball, box, cylinder, hexagon, ring, rope, turned
from cadplants.standards import PIPES
from cadplants.transforms import at, spun

__all__ = ["STATIONS"]

_FRAME, _PIPE, _FIX = "Structural element", "Pipe assembly", "Connection assembly"


def _foot(x: float, y: float, high: float, half: float, rng: np.random.Generator) -> list[Part]:
    """A post on a base plate from the floor up to a height [m]."""
    if rng.random() < 0.5:
        pole = box((2 * half, 2 * half, high - 0.01), (x, y, (high + 0.01) / 2))
    else:
        pole = moved(cylinder(half, 0.01, high, 12), at(x, y))
    return [
        other(_FRAME, "post", "steel", pole),
        other(_FRAME, "base plate", "steel", box((5 * half, 5 * half, 0.01), (x, y, 0.005))),
    ]


def _riser(dn: int, high: float, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float]:
    """A wall with a rosette, or a pipe clamped to a post; also where a tap upon it begins along y [m]."""
    r, inner = PIPES[dn].radius, PIPES[dn].bore if style.hollow else 0.0
    n = style.round(r)
    if rng.random() < 0.4:
        wall = box((0.8, 0.12, high + 0.5), (0, -0.06, (high + 0.5) / 2))
        plate = turned([(2.2 * r, 0.0), (2.0 * r, 0.006), (1.2 * r, 0.01)], n)
        rosette = other(_PIPE, "flange", "trim", along("y", plate, 0, 0, high))
        return [other(_FRAME, "wall", "concrete", wall), rosette], 0.0095
    path = bend([(0, 0, 0.0), (0, 0, high), (0, 2.2 * r, high)], 1.8 * r, 6)
    parts = [other(_PIPE, "pipe", "pipe", tube(path, r, inner, n))]
    parts += _foot(0.0, -r - 0.021, high - 0.1, 0.02, rng)
    band = ring(r, r + 0.003, -0.012, 0.012, n)
    strap = box((2 * r + 0.03, 0.003, 0.024), (0, -r - 0.0005, 0))
    for z in (0.35 * high, 0.75 * high):
        parts.append(other(_FIX, "clamp", "clamp", moved(merge([band, strap]), at(0, 0, z))))
    return parts, 2.2 * r - 0.001


def _bibb(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A hose tap (EN 200) with a bent spout on a riser clamped to a post or led through a wall; wheel, lever or T."""
    dn = int(rng.choice([15, 20, 25]))
    r = PIPES[dn].radius
    n, high = style.round(r), float(rng.uniform(0.5, 1.1))
    parts, start = _riser(dn, high, style, rng)
    y = start + 2.6 * r
    shank = along(
        "y", merge([cylinder(0.95 * r, start, y, n), hexagon(2.6 * r, start + 0.2 * r, start + 1.4 * r)]), 0, 0, high
    )
    chest = moved(
        turned([(0.9 * r, -1.2 * r), (1.35 * r, -0.6 * r), (1.35 * r, 0.9 * r), (1.0 * r, 1.5 * r)], n), at(0, y, high)
    )
    far = y + float(rng.uniform(2.5, 4.5)) * r
    spout = rope(bend([(0, y, high), (0, far, high), (0, far, high - 4 * r)], 2.2 * r, 6), 0.85 * r, n)
    tip = [ring(0.6 * r, 1.15 * r, high - 5.2 * r, high - 3.9 * r, n)]
    if rng.random() < 0.6:
        tip.append(
            turned(
                [
                    (0.7 * r, high - 7.5 * r),
                    (0.9 * r, high - 6.6 * r),
                    (0.75 * r, high - 6.5 * r),
                    (0.9 * r, high - 5.8 * r),
                    (0.8 * r, high - 5.1 * r),
                ],
                n,
            )
        )
    parts.append(body(shank, chest, spout, *(moved(t, at(0, far)) for t in tip)))
    top = high + 1.5 * r
    if rng.random() < 0.6:
        parts.append(
            moved_one(
                bonnet(hexagon(2.2 * r, top - 0.001, top + 1.0 * r), cylinder(0.8 * r, top, top + 1.8 * r, n)), at(0, y)
            )
        )
        parts.append(moved_one(piece("gland", hexagon(1.3 * r, top + 1.7 * r, top + 2.4 * r)), at(0, y)))
        parts += placed(
            [
                stem(top + 2.3 * r, top + 4.2 * r, 0.3 * r, style),
                wheel(0.012 + float(rng.uniform(1.2, 2.0)) * r, 0, top + 3.4 * r, style, rng),
            ],
            at(0, y),
        )
    else:
        parts.append(moved_one(piece("valve stem", cylinder(0.5 * r, top - 0.002, top + 0.6 * r, 10)), at(0, y)))
        parts += placed(drive(0.0, top + 0.5 * r, r, style, rng, ("lever", "wing", "bar")), at(0, y))
    return Model(fronted(parts), kind="ball valve")


def moved_one(part: Part, pose: np.ndarray) -> Part:
    """One part moved by a pose."""
    return placed([part], pose)[0]


def _needles(x: float, z: float, r: float, style: ModelingStyle, rng: np.random.Generator, knob: int) -> list[Part]:
    """A valve's headwork along z on a block: bonnet, gland, stem, T bar, knob or wheel."""
    parts = [
        bonnet(hexagon(2.2 * r, -0.001, 1.6 * r), cylinder(0.8 * r, 1.5 * r, 3.2 * r, 12)),
        piece("gland", hexagon(1.5 * r, 3.1 * r, 4.0 * r)),
        piece("valve stem", cylinder(0.35 * r, 3.9 * r, 6.6 * r, 8)),
    ]
    if knob == 0:
        parts += drive(0.0, 6.0 * r, r, style, rng, ("bar",))
    elif knob == 1:
        grip = turned([(1.2 * r, 5.4 * r), (1.6 * r, 5.8 * r), (1.6 * r, 7.2 * r), (1.2 * r, 7.5 * r)], 10)
        parts.append(piece("handwheel", grip, color="handle", bundle=""))
    else:
        parts.append(wheel(0.012 + 1.5 * r, 0, 5.8 * r, style, rng))
    return placed(parts, at(x, 0, z))


def _pipe_post(
    wide: float, tall: float, deep: float, high: float, style: ModelingStyle, rng: np.random.Generator
) -> list[Part]:
    """A pipe post behind a block, with a bracket between them held by u-bolts."""
    pipe = float(rng.choice([0.0302, 0.024]))
    parts = [other(_FRAME, "post", "steel", moved(cylinder(pipe, 0.01, high + 0.2, style.round(pipe)), at(0, 0.12)))]
    parts.append(other(_FRAME, "base plate", "steel", box((0.2, 0.2, 0.01), (0, 0.12, 0.005))))
    back = 0.12 - pipe
    gap = back - deep / 2
    bracket = [
        box((min(wide, 0.09), 0.005, tall + 0.04), (0, back - 0.0025, high)),
        box((0.05, gap, 0.006), (0, deep / 2 + gap / 2, high + tall / 2 - 0.004)),
        box((0.05, gap, 0.006), (0, deep / 2 + gap / 2, high - tall / 2 + 0.004)),
    ]
    parts.append(other(_FIX, "bracket", "steel", merge(bracket)))
    bow = bend(
        [
            (0.0, back - 0.012, 0),
            (pipe + 0.006, back - 0.012, 0),
            (pipe + 0.006, 0.12 + pipe + 0.006, 0),
            (-pipe - 0.006, 0.12 + pipe + 0.006, 0),
            (-pipe - 0.006, back - 0.012, 0),
        ][1:],
        pipe,
        4,
    )
    for z in (high + tall / 2 + 0.008, high - tall / 2 - 0.008):
        parts.append(other(_FIX, "u-bolt", "fastener", moved(rope(bow, 0.004, 6), at(0, 0, z))))
    return parts


def _manifold(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An instrument manifold (IEC 61518 spacing) of two, three or five valves on a pipe post, with impulse tubes."""
    count, r = int(rng.choice([2, 3, 5])), float(rng.uniform(0.008, 0.011))
    high, knob = float(rng.uniform(0.9, 1.5)), int(rng.integers(3))
    wide, tall, deep = 0.054 + 0.03 * count, float(rng.uniform(0.05, 0.09)), 0.032
    block = [box((wide, deep, tall), (0, 0, high))]
    if rng.random() < 0.5:
        block += [along("y", square(0.024, deep / 2 - 0.001, deep / 2 + 0.012), x, 0, high) for x in (-0.027, 0.027)]
    parts = [body(*block)]
    if count == 2:
        spots = [(-0.25 * wide, 0.0), (0.25 * wide, 0.0)]
    elif count == 3:
        spots = [(-0.33 * wide, 0.0), (0.0, 0.0), (0.33 * wide, 0.0)]
    else:
        spots = [
            (-0.36 * wide, 0.2 * tall),
            (0.0, 0.2 * tall),
            (0.36 * wide, 0.2 * tall),
            (-0.18 * wide, -0.28 * tall),
            (0.18 * wide, -0.28 * tall),
        ]
    slope = bool(count < 5 and rng.random() < 0.5)
    for x, z in spots:
        outward = spun("x", np.pi / 2)
        if slope and abs(x) > 0.01:
            pose = at(np.sign(x) * wide / 2, 0, high + z) @ spun("y", float(np.sign(x)) * np.pi / 2)
        else:
            pose = at(x, -deep / 2, high + z) @ outward
        parts += placed(_needles(0.0, 0.0, r, style, rng, 1 if count == 5 else knob), pose)
    parts += _pipe_post(wide, tall, deep, high, style, rng)
    for x in (-0.027, 0.027):
        fit = along(
            "-z",
            merge([hexagon(0.019, -0.001, 0.018), hexagon(0.016, 0.02, 0.034), cylinder(0.008, 0.0, 0.03, 10)]),
            x,
            0,
            high - tall / 2,
        )
        foot = float(rng.uniform(0.1, 0.5))
        path = bend([(x, 0, high - tall / 2 - 0.03), (x, 0, foot), (x, -0.5, foot)], 0.04)
        parts += [body(fit), other(_PIPE, "pipe", "pipe", tube(path, 0.006, 0.0045 if style.hollow else 0.0, 8))]
    return Model(fronted(parts), kind="needle valve")


def _panel(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Needle valves in a panel: a sheet between posts, nuts and knobs before it, bodies and tubes behind."""
    count, high = int(rng.integers(1, 4)), float(rng.uniform(1.0, 1.4))
    wide, tall = 0.16 * count + 0.1, float(rng.uniform(0.25, 0.5))
    sheet = box((wide, 0.004, tall), (0, 0, high))
    parts = [other(_FRAME, "plate", "steel", sheet)]
    for s in (-1, 1):
        parts += _foot(s * (wide / 2 - 0.02), 0.022, high + tall / 2, 0.02, rng)
    r, knob = float(rng.uniform(0.008, 0.012)), int(rng.integers(3))
    k = int(rng.integers(count))
    x = 0.16 * (k - (count - 1) / 2)
    core = box((2.6 * r, 0.04, 2.6 * r), (x, 0.022, high))
    core = merge([core, along("-y", cylinder(0.9 * r, -0.01, 0.0085, 12), x, 0, high)])  # through the sheet
    ends = [
        along(way, merge([hexagon(1.8 * r, 0.0, 3.0 * r), cylinder(0.8 * r, 0, 4 * r, 10)]), x, 0.024, high)
        for way in ("z", "-z")
    ]
    front = placed(_needles(0.0, 0.0, r, style, rng, knob), at(x, -0.0085, high) @ spun("x", np.pi / 2))
    nut = along("-y", hexagon(3.0 * r, 0.0018, 0.009), x, 0, high)
    parts += [body(core, *ends), piece("gland", nut), *front]
    for way in (1, -1):
        path = bend(
            [
                (x, 0.024, high + way * 3.8 * r),
                (x, 0.024, high + way * (tall / 2 + 0.03)),
                (x, 0.3, high + way * (tall / 2 + 0.03)),
            ],
            0.02,
        )
        parts.append(other(_PIPE, "pipe", "pipe", tube(path, 0.6 * r, 0.45 * r if style.hollow else 0.0, 8)))
    label = box((0.08, 0.001, 0.025), (x, -0.0025, high + 0.07))
    parts.append(other("Electrical and safety", "sign", "dial", label))
    return Model(fronted(parts), kind="needle valve")


def _radiator(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A thermostatic valve (EN 215) at a radiator on feet: angle body, union, ribbed head, pipe to the floor."""
    wide, tall, deep = float(rng.uniform(0.5, 1.4)), float(rng.uniform(0.35, 0.75)), float(rng.uniform(0.05, 0.11))
    low = float(rng.uniform(0.1, 0.18))
    panels = [box((wide, 0.012, tall), (0, s * (deep / 2 - 0.006), low + tall / 2)) for s in (-1, 1)]
    count = int(wide / 0.06)
    fins = [
        box((0.035, deep - 0.02, tall - 0.06), (x, 0, low + tall / 2))
        for x in np.linspace(-wide / 2 + 0.03, wide / 2 - 0.03, count)
    ]
    lid = box((wide, deep, 0.01), (0, 0, low + tall + 0.004))
    parts = [other("Equipment", "radiator", "tank", merge([*panels, *fins, lid]))]
    feet = merge([box((0.04, deep, low + 0.01), (s * 0.35 * wide, 0, (low + 0.01) / 2)) for s in (-1, 1)])
    parts.append(other(_FIX, "bracket", "steel", feet))
    upper = bool(rng.integers(2))
    z, r, x = (low + tall - 0.05 if upper else low + 0.05), 0.0107, wide / 2
    n = style.round(1.5 * r)
    nut = along("x", merge([hexagon(0.030, 0.012, 0.030), cylinder(0.011, -0.02, 0.03, n)]), x, 0, z)
    parts.append(other(_PIPE, "union", "trim", nut, own=True))
    cx = x + 0.05
    solids = [
        along("x", cylinder(0.012, 0.029, 0.05, n), x, 0, z),
        moved(ball(0.0155, 12), at(cx, 0, z)),
        along("-z", merge([cylinder(0.012, 0.0, 0.034, n), hexagon(0.027, 0.022, 0.040)]), cx, 0, z),
    ]
    parts.append(body(*solids))
    pose = at(cx, 0, z) @ (spun("y", np.pi / 2) if rng.random() < 0.6 else np.eye(4))
    if rng.random() < 0.25:
        pose = at(cx, 0, z) @ spun("x", np.pi / 2)
    tip, long = 0.016 + 0.008 * float(rng.random()), float(rng.uniform(0.045, 0.075))
    head = [
        turned(
            [
                (0.016, 0.026),
                (0.021, 0.034),
                (tip, 0.034 + 0.6 * long),
                (0.8 * tip, 0.034 + long),
                (0.3 * tip, 0.036 + long),
            ],
            n,
        )
    ]
    ribs = int(rng.choice([0, 8, 14]))
    if ribs:
        head.append(around(box((0.004, 0.003, 0.6 * long), (0, 0, 0.036 + 0.4 * long)), ribs, 0.9 * tip + 0.002))
    collar = merge([cylinder(0.011, 0.008, 0.02, n), hexagon(0.030, 0.0165, 0.027)])
    parts += [
        piece("gland", moved(collar, pose)),
        piece("actuator", moved(merge(head), pose), color="dial", bundle="actuator"),
    ]
    drop = tube(np.array([[cx, 0, z - 0.038], [cx, 0, 0.0]]), 0.009, 0.0075 if style.hollow else 0.0, n)
    parts.append(other(_PIPE, "pipe", "pipe", drop))
    other_end = -wide / 2
    back = bend(
        [(other_end + 0.025, 0, low + 0.05), (other_end - 0.05, 0, low + 0.05), (other_end - 0.05, 0, 0.0)], 0.015
    )
    parts.append(other(_PIPE, "pipe", "pipe", tube(back, 0.009, 0.0075 if style.hollow else 0.0, n)))
    return Model(fronted(parts), kind="thermostatic valve")


def _hose_valve(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A fire hose valve (BS 5041 or NFPA practice) on a standpipe: square or oblique, wheel, cap on a chain."""
    dn, high = int(rng.choice([50, 65])), float(rng.uniform(0.8, 1.2))
    r, main = PIPES[dn].radius, PIPES[int(rng.choice([80, 100]))].radius
    n, m = style.round(1.4 * r), style.round(main)
    inner = main - 0.006 if style.hollow else 0.0
    parts = [other(_PIPE, "pipe", "pipe", ring(inner, main, 0.0, high + float(rng.uniform(0.4, 1.2)), m))]
    wide = 1.35 * r
    stub = along("-y", ring(0.8 * r if style.hollow else 0.0, r, 0.97 * main, main + 0.1, n), 0, 0, high)
    parts.append(other(_PIPE, "nipple", "pipe", stub))
    y = -main - 0.09 - 1.8 * wide
    inlet = along(
        "y", merge([cylinder(1.1 * r, 0.0, 1.8 * wide, n), hexagon(2.7 * r, 1.0 * wide, 1.8 * wide)]), 0, y, high
    )
    chest = moved(
        turned(
            [(0.9 * wide, -1.0 * wide), (1.1 * wide, -0.3 * wide), (1.1 * wide, 0.7 * wide), (0.8 * wide, 1.2 * wide)],
            n,
        ),
        at(0, y, high),
    )
    tilt = spun("x", float(rng.choice([0.0, 0.75])))
    mouth = at(0, y, high) @ tilt
    out = along(
        "-z",
        turned(
            [
                (1.0 * r, 0.0),
                (1.0 * r, 2.2 * wide),
                (1.2 * r, 2.2 * wide),
                (1.2 * r, 2.6 * wide),
                (1.0 * r, 2.7 * wide),
            ],
            n,
        ),
    )
    parts.append(body(inlet, chest, moved(out, mouth)))
    cap = [
        ring(0.0, 1.3 * r, 2.55 * wide, 3.1 * wide, n),
        around(box((0.25 * r, 0.3 * r, 0.4 * wide), (0, 0, 2.8 * wide)), int(rng.choice([2, 3])), 1.35 * r),
    ]
    parts.append(other(_PIPE, "pipe cap", "trim", moved(along("-z", merge(cap)), mouth), own=True))
    ends = [
        moved(Solid(np.array([p]), np.zeros((0, 3), np.int32)), mouth).vertices[0]
        for p in ([1.28 * r, 0, -2.8 * wide], [1.08 * wide, 0, 0.1 * wide])
    ]
    if rng.random() < 0.6:
        parts.append(other(_PIPE, "pipe cap", "trim", chain(ends[0], ends[1], 0.03, 0.0018), own=True))
    top = 1.2 * wide
    head = [
        bonnet(hexagon(1.8 * wide, top - 0.002, top + 0.5 * wide), cylinder(0.5 * wide, top, top + 1.2 * wide, n)),
        piece("gland", hexagon(0.8 * wide, top + 1.15 * wide, top + 1.5 * wide)),
    ]
    head += [
        stem(top + 1.45 * wide, top + 2.6 * wide, 0.16 * wide, style),
        wheel(float(rng.uniform(1.5, 2.2)) * wide, 0, top + 2.1 * wide, style, rng),
    ]
    parts += placed(head, at(0, y, high))
    return Model(fronted(parts), kind="globe valve")


STATIONS: tuple[Family, ...] = (
    valve_family("hose tap/bent spout", _bibb, SMALL, "floor"),
    valve_family("needle valve/manifold", _manifold, SMALL, "floor"),
    valve_family("needle valve/panel", _panel, SMALL, "floor", 0.7),
    valve_family("thermostatic valve/radiator", _radiator, SMALL, "floor"),
    valve_family("hose valve/standpipe", _hose_valve, SMALL, "floor"),
)
