"""Ball valves of further makes: trunnion, top entry, welded, segment, wafer, sanitary, true union, cut open."""

from __future__ import annotations

import numpy as np

from cadplants.families.valves.actuation import quarter_turn
from cadplants.families.valves.actuation_base import bolted, shaft
from cadplants.families.valves.actuation_hand import slab, span
from cadplants.families.valves.body import (
    bolts_on,
    ended,
    lid_joint,
    metal,
    neck_of,
    packing,
    part_turned,
    plate_outline,
    room,
    trim,
    valve_ball,
)  # fmt: skip
from cadplants.families.valves.drive import BODY
from cadplants.families.valves.valve import valve_family
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import Solid, about_x, merge, moved, revolve, weld
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import along, around, box, cylinder, hexagon, ring, rod, turned
from cadplants.standards import FACE_TO_FACE, FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["BALLS", "ball_inside", "clamped_ends", "ferrule", "part_ring", "some_turn", "stem_top"]

Rng = np.random.Generator


def some_turn(rng: Rng) -> float:
    """How far a ball or disc is turned from open [rad]."""
    return float(rng.choice([0.0, 0.0, 0.25, 0.5])) * np.pi


def ball_inside(dn: int, x: float, style: ModelingStyle, rng: Rng, trunnions: float = 0.0) -> list[Part]:
    """The ball and its two seats, where a style shows the inside at all."""
    if not style.hollow:
        return []
    bore = 0.9 * PIPES[dn].bore
    big = bore * float(rng.uniform(1.4, 1.6))
    seat = along("x", ring(1.03 * bore, 1.25 * bore, 0.0, 0.16 * bore, max(16, style.round(bore))))
    far = np.sqrt(big**2 - (1.14 * bore) ** 2)
    seats = [moved(seat, at(x + far)), moved(seat, at(x - far - 0.16 * bore))]
    parts = [trim(moved(valve_ball(big, bore, style, some_turn(rng), trunnions), at(x)), "valve ball")]
    return [*parts, *(Part(one, "gasket", "rubber", BODY, "Pipe assembly") for one in seats)]


def stem_top(
    x: float, low: float, high: float, radius: float, style: ModelingStyle, rng: Rng, pad: str = ""
) -> list[Part]:
    """A stem neck with a mounting pad (ISO 5211) round, square or none, its gland and its stem up to ``high`` [m]."""
    boss = 0.4 * radius + 0.007
    n, kind = max(12, style.round(boss)), pad or str(rng.choice(["round", "square", "octagon", "none"]))
    neck = cylinder(boss, low, high, n)
    solids = [neck]
    parts = []
    if kind != "none":
        outline = plate_outline(kind, 2.0 * boss, 2.0 * boss, n)
        solids.append(slab(outline, high - 0.004 - 0.06 * radius, high))
        parts.append(bolts_on(outline, 4, high - 0.004 - 0.06 * radius, high + 0.001, 0.004 + 0.03 * radius))
    slim = 0.5 * boss
    parts += [metal(merge(solids)), shaft(high - 0.003, high + 0.5 * boss + 0.004, slim, style)]
    parts.append(
        trim(
            cylinder(0.8 * boss, high, high + 0.25 * boss, n)
            if rng.random() < 0.5
            else hexagon(1.5 * boss, high, high + 0.3 * boss),
            "gland",
        )
    )
    return placed(parts, at(x))


_HEAVY = ("worm", "worm", "scotch", "rack", "electrohydraulic", "multi-turn", "lever", "bevel")


def _trunnion(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A trunnion ball valve in three bolted pieces: barrel, two end adapters, trunnion cap, drain, vent (API 6D)."""
    radius, size = PIPES[dn].radius, FLANGES[dn]
    length = FACE_TO_FACE["ball"][dn] * float(rng.uniform(1.05, 1.25))
    neck, back = neck_of(dn)
    x, big = length / 2, max(1.75 * radius + 0.012, 0.5 * size.circle * 0.9)
    n = max(16, min(48, style.round(big)))
    half = min(1.3 * radius, x - back - 0.035)
    lip, split = float(rng.uniform(1.12, 1.28)) * big, 0.012 + 0.08 * radius
    middle = [
        (neck, back),
        (neck, back + 0.3 * (x - half - back)),
        (0.9 * big, x - half - split),
        (0.9 * big, length - x + half + split),
        (neck, length - back - 0.3 * (x - half - back)),
        (neck, length - back),
    ]
    barrel = turned(
        [
            (lip, x - half),
            (lip, x - half + split),
            (big, x - half + split),
            (big, x + half - split),
            (lip, x + half - split),
            (lip, x + half),
        ],
        n,
    )
    if rng.random() < 0.4:
        barrel = turned([(lip, x - half), (1.03 * lip, x), (lip, x + half)], n)
    rims = [cylinder(lip, *span(x + s * half, x + s * (half + split)), n) for s in (-1, 1)]
    count = max(6, min(10, 2 * int(np.pi * lip / 0.05)))
    one = merge(
        [
            cylinder(0.09 * split + 0.004, x - half - 1.6 * split, x + half + 1.6 * split, 8),
            *(
                hexagon(0.02 + 0.05 * radius, *span(x + s * (half + split), x + s * (half + 1.6 * split)))
                for s in (-1, 1)
            ),
        ]
    )
    bolts = bolted(about_x(around(one, count, 0.9 * lip)))
    cap = merge([cylinder(0.55 * big, -1.15 * big, -0.8 * big, n), cylinder(0.7 * big, -1.25 * big, -1.13 * big, n)])
    drains = merge([along("y", hexagon(0.024, 0.9 * big, 1.1 * big), 0, 0, s * 0.4 * big) for s in (-1, 1)])
    solids = [ended(dn, style, length, middle, "flanged"), moved(merge([cap, drains]), at(x)), about_x(merge(rims))]
    if rng.random() < 0.4:
        solids += [box((0.4 * half, 1.5 * big, 0.5 * big), (x + s * 0.6 * half, 0, -1.15 * big)) for s in (-1, 1)]
    high = max(1.35 * big, 0.5 * size.outer) + 0.03
    parts = [
        metal(merge(solids)),
        metal(about_x(barrel)),
        bolts,
        *stem_top(x, 0.8 * big, high, 1.4 * radius, style, rng),
    ]
    parts += ball_inside(dn, x, style, rng, 1.5 * radius)
    if rng.random() < 0.5:
        cover = turned(
            [(0.6 * big, 0.9 * big), (0.6 * big, high - 0.02), (0.75 * big, high - 0.02), (0.75 * big, high - 0.001)], n
        )
        parts.append(trim(cover, "valve bonnet", x, "valve"))
    parts += quarter_turn(x, high + 0.004 + 0.28 * radius, radius, style, rng, _HEAVY)
    return Model(parts, round(length, 6), kind="ball valve")


def _top_entry(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A top-entry ball valve: a one-piece cast body, the ball goes in from above under a large bolted bonnet."""
    radius, ends = PIPES[dn].radius, str(rng.choice(["flanged", "flanged", "butt"]))
    length = FACE_TO_FACE["ball"][dn] * (1.1 if ends == "flanged" else 1.0)
    x, big = length / 2, 1.6 * radius + 0.012
    n = max(16, style.round(big))
    neck, back = neck_of(dn) if ends == "flanged" else (1.1 * radius, 0.1 * length)
    shares = np.linspace(-1, 1, 9)
    reach = 0.5 * length - back - 0.05 * length
    middle = [(neck + (big - neck) * float(np.sqrt(1 - s * s)), x + float(s) * reach) for s in shares]
    seat, plate = max(1.2 * big, 0.9 * room(dn) if ends == "flanged" else 0.0), 0.012 + 0.12 * radius
    half = float(rng.uniform(1.1, 1.3)) * big
    collar, lid, bolts = lid_joint(
        str(rng.choice(["round", "round", "octagon", "square"])), half, half, seat, plate, style, rng
    )
    tower = turned([(0.9 * big, 0.0), (0.95 * big, seat - 0.003)], n)
    dome_ = turned(
        [(0.85 * half, seat + plate - 0.002), (0.6 * half, seat + 1.6 * plate), (0.45 * half, seat + 2.6 * plate)], n
    )
    high = seat + 2.6 * plate
    parts = [
        metal(merge([ended(dn, style, length, middle, ends), moved(merge([tower, collar]), at(x))])),
        trim(merge([lid, dome_]), "valve bonnet", x, "valve"),
        *placed([bolts], at(x)),
        *stem_top(x, high - 0.01, high + 0.02 + 0.2 * radius, radius, style, rng),
        *ball_inside(dn, x, style, rng),
        *quarter_turn(x, high + 0.024 + 0.4 * radius, radius, style, rng, _HEAVY),
    ]
    return Model(parts, round(length, 6), "flanged" if ends == "flanged" else "welded", "ball valve")


def _welded(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A fully welded pipeline ball valve: a sphere or drum with weld seams, extended stem, vent pipes (EN 14141)."""
    radius = PIPES[dn].radius
    x = 0.05 + 2.6 * radius
    length, big = 2 * x, float(rng.uniform(1.55, 1.9)) * radius + 0.006
    n = max(16, style.round(big))
    if rng.random() < 0.5:
        shares = np.linspace(-0.86, 0.86, 11)
        middle = [(big * float(np.sqrt(1 - s * s)), x + big * float(s)) for s in shares]
        if middle[0][0] > 1.05 * radius:
            middle = [(1.02 * radius, x - 1.35 * big * 0.86), *middle, (1.02 * radius, x + 1.35 * big * 0.86)]
    else:
        half = 1.2 * radius
        middle = [
            (1.05 * radius, x - half - 0.6 * radius),
            (big, x - half),
            (big, x + half),
            (1.05 * radius, x + half + 0.6 * radius),
        ]
    seams = [
        ring(0.9 * big, big + 0.003, x + s * 0.5 * radius - 0.004, x + s * 0.5 * radius + 0.004, n) for s in (-1, 1)
    ]
    reach = big + (float(rng.uniform(0.25, 0.9)) if rng.random() < 0.6 else 0.04 + 0.3 * radius)
    boss = 0.5 * radius + 0.008
    tube_ = turned(
        [
            (1.3 * boss, 0.85 * big),
            (boss, big + 0.02),
            (boss, reach - 0.012),
            (1.9 * boss, reach - 0.012),
            (1.9 * boss, reach),
        ],
        n,
    )
    parts = [
        metal(merge([ended(dn, style, length, middle, "butt"), about_x(merge(seams))])),
        trim(tube_, "valve bonnet", x, "valve"),
    ]
    if reach > big + 0.2:
        vents = []
        for s in (-1, 1):
            path_low, side = 0.8 * big, s * (boss + 0.02)
            vents.append(rod((side, 0, path_low), (side, 0, reach - 0.09), 0.007, 8))
            vents.append(
                moved(merge([hexagon(0.024, 0.0, 0.04), cylinder(0.009, 0.0, 0.055, 8)]), at(side, 0, reach - 0.09))
            )
        vents.append(box((2 * boss + 0.04, 0.012, 0.005), (0, 0, 0.5 * (big + reach))))
        parts.append(metal(merge(vents), x))
    parts += [*placed([shaft(reach - 0.002, reach + 0.02, 0.4 * boss, style)], at(x)), *ball_inside(dn, x, style, rng)]
    kinds = ("lever", "worm", "bevel", "multi-turn", "scotch", "worm")
    parts += quarter_turn(x, reach + 0.012, radius, style, rng, kinds)
    return Model(parts, round(length, 6), "welded", "ball valve")


def _segment(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A V-segment control ball valve: a short body, flangeless or flanged, shaft off the middle, an actuator."""
    radius, size = PIPES[dn].radius, FLANGES[dn]
    length = 0.095 + 0.75 * radius
    flanged = rng.random() < 0.4
    x, outer = 0.45 * length, 0.49 * (size.circle - size.bolt)
    n = max(16, style.round(outer))
    neck, back = neck_of(dn)
    if flanged and length > 2.6 * back + 0.03:
        body = ended(dn, style, length, [(neck, back), (1.15 * neck, x), (neck, length - back)], "flanged")
    else:
        flanged = False
        waist = max(0.85 * outer, 1.25 * radius)
        profile = [
            (PIPES[dn].bore, 0.0),
            (outer, 0.0),
            (outer, 0.14 * length),
            (waist, 0.2 * length),
            (waist, 0.8 * length),
            (outer, 0.86 * length),
            (outer, length),
            (PIPES[dn].bore, length),
        ]
        body = about_x(part_ring(profile, n))
    boss, high = 0.3 * radius + 0.012, max(0.5 * size.outer, outer) + 0.035
    post = [
        turned([(1.2 * boss, 0.8 * radius), (boss, outer), (boss, high - 0.012)], 16),
        cylinder(0.9 * boss, -outer - 0.02, -0.8 * radius, 16),
    ]
    pad = slab(
        plate_outline(str(rng.choice(["square", "round", "oval"])), 1.9 * boss, 2.2 * boss, 16), high - 0.013, high
    )
    parts = [metal(merge([body, moved(merge([*post, pad]), at(x))]))]
    cover = merge(
        [
            cylinder(1.2 * boss, -outer - 0.032, -outer - 0.02, 16),
            around(hexagon(0.012, -outer - 0.038, -outer - 0.03), 4, 0.9 * boss),
        ]
    )
    parts.append(trim(cover, "valve bonnet", x, "valve"))
    gland, _ = packing(0.35 * boss, style, rng, int(rng.choice([0, 2])))
    parts += placed([*gland, shaft(-0.1 * radius, 0.05, 0.35 * boss, style)], at(x, 0, high))
    if style.hollow:
        big = 1.12 * PIPES[dn].bore
        arc_ = np.linspace(-0.75, 0.75, 9)
        shell = [(big * np.cos(t), big * np.sin(t)) for t in arc_] + [
            (0.85 * big * np.cos(t), 0.85 * big * np.sin(t)) for t in arc_[::-1]
        ]
        cup = part_turned(np.array(shell), -0.8, 0.8, 8)
        pins = merge([cylinder(0.3 * boss, *span(s * 0.55 * big, s * 1.05 * big), 10) for s in (-1, 1)])
        parts.append(trim(moved(merge([moved(cup, spun("z", some_turn(rng))), pins]), at(x)), "valve ball"))
    parts += quarter_turn(
        x, high + 0.02, radius, style, rng, ("rack", "scotch", "motor box", "electrohydraulic", "worm")
    )
    return Model(parts, round(length, 6), "flanged" if flanged else "wafer", "control valve")


def part_ring(profile: list[tuple[float, float]], n: int) -> Solid:
    """A closed outline ``(radius, height)`` turned about z [m]."""
    return weld([revolve(profile, n, closed=True)])


def _wafer(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A compact wafer ball valve between two flanges: a round or lugged disc barely longer than its ball (DIN 3357)."""
    radius, size = PIPES[dn].radius, FLANGES[dn]
    length = max(0.042, float(rng.uniform(1.5, 1.9)) * radius + 0.012)
    x, outer = length / 2, 0.49 * (size.circle - size.bolt)
    bore, n = 0.95 * PIPES[dn].bore, max(16, style.round(outer))
    kind = int(rng.integers(3))
    if kind == 0:
        shell = part_ring([(bore, 0.0), (outer, 0.0), (outer, length), (bore, length)], n)
    elif kind == 1:
        shell = part_ring(
            [
                (bore, 0.0),
                (0.75 * outer, 0.0),
                (0.75 * outer, 0.12 * length),
                (outer, 0.2 * length),
                (outer, 0.8 * length),
                (0.75 * outer, 0.88 * length),
                (0.75 * outer, length),
                (bore, length),
            ],
            n,
        )
    else:
        tapped = around(
            ring(0.5 * size.bolt, 0.95 * size.bolt, 0.0, length, 10),
            size.n_bolts,
            size.circle / 2,
            np.pi / size.n_bolts,
        )
        shell = merge([part_ring([(bore, 0.0), (outer, 0.0), (outer, length), (bore, length)], n), tapped])
    insert = part_ring(
        [(1.02 * bore, -0.0), (0.6 * outer + 0.4 * bore, 0.0), (0.6 * outer + 0.4 * bore, 0.004), (1.02 * bore, 0.004)],
        n,
    )
    parts = [metal(about_x(shell)), metal(moved(about_x(insert), at(length - 0.004)), 0.0, "trim")]
    high = 0.5 * size.outer + 0.012
    parts += [*stem_top(x, 0.95 * bore, high, 0.8 * radius, style, rng), *ball_inside(dn, x, style, rng)]
    parts += quarter_turn(x, high + 0.004 + 0.16 * radius, radius, style, rng, ("lever", "lever", "rack", "motor box"))
    return Model(parts, round(length, 6), "wafer", "ball valve")


def ferrule(dn: int, low: float, high: float, style: ModelingStyle, face: bool) -> Solid:
    """A sanitary ferrule along x, its conical rim at ``low`` (``face``) or at ``high`` (ISO 2852)."""
    pipe = PIPES[dn]
    n, rim = style.round(pipe.radius), 1.25 * pipe.radius + 0.008
    inner = pipe.bore if style.hollow else 0.0
    outline = (
        [(pipe.radius, low + 0.0065), (rim, low + 0.003), (rim, low)]
        if face
        else [(rim, high), (rim, high - 0.003), (pipe.radius, high - 0.0065)]
    )
    outline = [(pipe.radius, high), *outline] if face else [*outline, (pipe.radius, low)]
    outline = outline[::-1]
    if inner:
        return about_x(part_ring([(inner, outline[0][1]), *outline, (inner, outline[-1][1])], n))
    return about_x(turned(outline, n))


def _clamp_ring(dn: int, x: float, style: ModelingStyle, rng: Rng) -> Part:
    """A clamp of two hinged halves round a pair of ferrules at ``x``, with its wing nut (ISO 2852)."""
    rim = 1.25 * PIPES[dn].radius + 0.008
    n = max(16, style.round(rim))
    hoop = part_ring(
        [
            (1.01 * rim, -0.004),
            (0.86 * rim, -0.009),
            (1.12 * rim, -0.009),
            (1.12 * rim, 0.009),
            (0.86 * rim, 0.009),
            (1.01 * rim, 0.004),
        ],
        n,
    )
    bolt = merge(
        [
            rod((1.22 * rim, -0.3 * rim, 0), (1.22 * rim, 0.35 * rim + 0.02, 0), 0.004, 8),
            box((0.012, 0.014, 0.016), (1.18 * rim, -0.2 * rim, 0)),
            box((0.02, 0.014, 0.016), (1.18 * rim, 0.2 * rim, 0)),
            box((0.006, 0.012, 0.034), (1.22 * rim, 0.35 * rim + 0.016, 0)),
            box((0.014, 0.02, 0.016), (-1.15 * rim, 0, 0)),
        ]
    )
    turn = spun("x", float(rng.uniform(0, 6)))
    return Part(moved(about_x(merge([hoop, bolt])), at(x) @ turn), "clamp", "clamp", "", "Connection assembly")


def clamped_ends(dn: int, stub: float, length: float, style: ModelingStyle, rng: Rng) -> list[Part]:
    """The pipe's ferrules before and behind a sanitary valve whose own faces lie ``stub`` inward, with their clamps."""
    low, high = ferrule(dn, 0.0, stub - 0.001, style, False), ferrule(dn, length - stub + 0.001, length, style, True)
    return [
        *(Part(one, "coupling", "pipe", "", "Pipe assembly") for one in (low, high)),
        *(_clamp_ring(dn, z, style, rng) for z in (stub, length - stub)),
    ]


def _split(dn: int, style: ModelingStyle, rng: Rng) -> Model:
    """A split-body floating ball valve: a long and a short half bolted off the middle, any joint (ISO 17292)."""
    radius, size = PIPES[dn].radius, FLANGES[dn]
    length = FACE_TO_FACE["ball"][dn]
    neck, back = neck_of(dn)
    x, big = length * float(rng.uniform(0.42, 0.48)), 1.5 * radius + 0.008
    joint = x + 0.75 * radius + 0.006
    thick = 0.008 + 0.07 * radius
    joint = min(joint, length - back - 2.2 * thick)
    middle = [
        (neck, back),
        (big, x - 0.9 * radius if x - 0.9 * radius > back + 0.002 else back + 0.002),
        (big, joint),
        (0.95 * big, joint + thick),
        (neck, max(joint + thick + 0.002, length - back - 0.004)),
    ]
    kind = str(rng.choice(["round", "square", "octagon", "oval"]))
    outline = plate_outline(
        kind, 1.25 * big + 0.008, (1.25 if kind != "oval" else 1.5) * big + 0.008, max(16, style.round(big))
    )
    flanges = [along("x", slab(outline, z, z + thick)) for z in (joint - thick, joint)]
    bolts = bolts_on(outline, int(rng.choice([4, 6, 8])), joint - thick, joint + thick, 0.006 + 0.05 * radius)
    bolts = bolted(moved(bolts.solid, spun("y", np.pi / 2)))
    high = max(big + 0.01, 0.5 * size.outer * float(rng.uniform(0.8, 1.05))) + 0.012
    whole = ended(dn, style, length, middle, "flanged")
    parts = [
        metal(merge([whole, flanges[0]])),
        metal(flanges[1]),
        bolts,
        *stem_top(x, 0.8 * big, high, radius, style, rng),
        *ball_inside(dn, x, style, rng),
    ]
    parts += quarter_turn(
        x,
        high + 0.004 + 0.2 * radius,
        radius,
        style,
        rng,
        ("lever", "lever", "lever", "worm", "rack", "motor box", "scotch"),
    )
    return Model(parts, length, kind="ball valve")


_BIG = tuple(dn for dn in SIZES if dn >= 50)
_MID = tuple(dn for dn in SIZES if dn <= 150)
_ALL = SIZES


BALLS: tuple[Family, ...] = (
    valve_family("ball valve/trunnion", _trunnion, _BIG),
    valve_family("ball valve/top entry", _top_entry, _ALL),
    valve_family("ball valve/fully welded", _welded, _ALL),
    valve_family("ball valve/segment", _segment, tuple(dn for dn in SIZES if dn >= 25)),
    valve_family("ball valve/wafer", _wafer, _MID),
    valve_family("ball valve/split body", _split, _ALL, weight=1.5),
)
