"""Storage tanks without pressure: roofs, open tops, silos and hoppers, plastic, boxes, drums."""

from __future__ import annotations

import numpy as np

from cadplants.families.vessels.vessel_fittings import Drum, capped, head, manway, mouth, sides
from cadplants.families.vessels.vesselbuild import outlet, tank_family
from cadplants.families.vessels.vesselfeet import foot_plate, ladder, legs, ringed_rail
from cadplants.family import Family, Model, Part, Port, placed
from cadplants.mesh_ops import Solid, merge, moved, revolve, sweep, weld
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, lofted, ring, rod, rope, torus, turned
from cadplants.transforms import at, spun

__all__ = ["STORAGE"]

_FRAME = "Structural element"


def _big(rng: np.random.Generator, style: ModelingStyle, tall: tuple[float, float] = (0.8, 2.2)) -> Drum:
    """A drum straight on its base, as wide as tank farms in small plants have."""
    r = float(np.exp(rng.uniform(np.log(0.9), np.log(2.3))))
    base = float(rng.choice([0.0, 0.0, 0.15, 0.3]))
    return Drum(r, base, base + float(rng.uniform(*tall)) * r, sides(style, r))


def _courses(drum: Drum, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A shell of one sheet or of courses that get thinner upward, with its bottom plate and maybe a plinth."""
    count = int(rng.choice([1, 2, 3, 4]))
    edges = np.linspace(drum.low, drum.high, count + 1)
    inner = 0.985 * drum.r
    rings = []
    for k in range(count):
        outer = drum.r - 0.003 * k
        rings.append(ring(inner if style.hollow else 0.0, outer, edges[k], edges[k + 1], drum.n))
    bottom = cylinder(1.02 * drum.r + 0.01, drum.low - 0.008 * (drum.low > 0), drum.low + 0.006, drum.n)
    together = bool(rng.random() < 0.5)
    parts = [Part(merge([*rings, bottom]), "shell", "tank", "tank")] if together else []
    if not together:
        parts = [Part(s, "shell", "tank", "tank") for s in (*rings, bottom)]
    if drum.low > 0.01:
        wide = 2.3 * drum.r + 0.2
        slab = box((wide, wide, drum.low - 0.008), (0, 0, (drum.low - 0.008) / 2))
        if rng.random() < 0.6:
            slab = cylinder(1.08 * drum.r + 0.05, 0.0, drum.low - 0.008, drum.n)
        parts.append(Part(slab, "foundation", "concrete", "", _FRAME))
    return parts


def _low_fittings(
    drum: Drum, style: ModelingStyle, rng: np.random.Generator, man: bool = True
) -> tuple[list[Part], list[Port]]:
    """Nozzles and a manway near the bottom of a shell (API 650 figure 5-7)."""
    parts: list[Part] = []
    ports: list[Port] = []
    for k in range(int(rng.integers(1, 4))):
        dn = int(rng.choice([50, 80, 100, 150]))
        z = drum.low + float(rng.uniform(0.25, 0.5)) if k < 2 else drum.high - 0.3
        kind = str(rng.choice(["plain", "pad"]))
        some, port = outlet(kind, dn, drum.side(0.9 * k + 2.6, z), style, drum.r, drum.dip, 0.08)
        parts += some
        ports += port
    if man and drum.r > 0.8:
        kind = str(rng.choice(["hinged", "davit"]))
        pose = drum.side(5.1, drum.low + 0.75) @ spun("z", np.pi)
        parts += placed(manway(kind, 0.28, style, rng, drum.r, drum.dip), pose)
    return parts, ports


def _access(drum: Drum, rise: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A ladder or stairs up the shell, and a railing round the roof."""
    parts: list[Part] = []
    if drum.high > 1.6:
        if rng.random() < 0.5 or drum.high < 2.0:
            gap = 0.18
            parts += placed(
                ladder(drum.r + gap, 0.0, drum.high + 1.0, style, bool(rng.integers(2)), gap + drum.dip), spun("z", 0.5)
            )
        else:
            parts += _spiral(drum)
    if rng.random() < 0.6:
        parts += ringed_rail(drum.r - 0.05, drum.high + rise, drum.n)
    return parts


def _spiral(drum: Drum) -> list[Part]:
    """Stairs that wind up the shell on brackets, with a handrail outside (API 650 table 5-18)."""
    wide, reach = 0.7, drum.r - drum.dip - 0.01
    count = int(drum.high / 0.2)
    turn = 0.24 / (drum.r + wide / 2)
    treads, posts, rail = [], [], []
    for k in range(count):
        a, z = k * turn, 0.2 * (k + 1)
        treads.append(moved(box((wide, 0.25, 0.03), (reach + wide / 2, 0, z)), spun("z", a)))
        foot = ((drum.r + wide - 0.04) * np.cos(a), (drum.r + wide - 0.04) * np.sin(a), z)
        if k % 3 == 0 or k == count - 1:
            posts.append(rod(foot, (foot[0], foot[1], z + 1.0), 0.017, 6))
        rail.append((foot[0], foot[1], z + 1.0))
    return [
        Part(merge(treads), "stair tread", "steel", "", _FRAME),
        Part(merge([*posts, rope(rail, 0.02, 6)]), "railing", "safety", "", _FRAME),
    ]


def _cone_roof(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cone-roof tank (API 650): slope 1:6 and up, top angle, vent, roof hatch, shell manway, stairs or ladder."""
    drum = _big(rng, style)
    rise = drum.r * float(rng.uniform(0.16, 0.45))
    parts = _courses(drum, style, rng)
    eave = drum.r + 0.03
    roof = capped([(eave, 0.0), (eave, 0.01), (0.06 * drum.r, rise), (0.0, rise)], style, drum.n)
    parts.append(Part(moved(roof, at(0, 0, drum.high)), "dished head", "tank", "tank"))
    angle = ring(drum.r, drum.r + 0.06, drum.high - 0.06, drum.high, drum.n)
    parts.append(Part(angle, "shell", "tank", "tank"))
    some, ports = _low_fittings(drum, style, rng)
    kind = str(rng.choice(["vent", "blind", "plain"]))
    extra, port = outlet(kind, int(rng.choice([80, 100, 150])), at(0, 0, drum.high + rise), style, 0.0, 0.03)
    parts += some + extra
    ports += port
    x = 0.62 * drum.r
    z = drum.high + rise * (1 - x / drum.r)
    tilt = at(0, x, z) @ spun("x", -float(np.arctan2(rise, drum.r)))
    parts += placed(manway(str(rng.choice(["hatch", "hinged"])), 0.26, style, rng, 0.0, 0.05), tilt)
    return Model([*parts, *_access(drum, 0.0, style, rng)], ports=tuple(ports), kind="cone roof tank")


def _dome_roof(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A dome-roof tank (API 650 annex G): a cap of one sphere with ribs, a finial with a vent."""
    drum = _big(rng, style)
    rise = drum.r * float(rng.uniform(0.2, 0.4))
    ball = (drum.r**2 + rise**2) / (2 * rise)
    angles = np.linspace(np.arcsin(min(1.0, drum.r / ball)), 0, 6)
    outline = [(ball * np.sin(a), rise - ball * (1 - np.cos(a))) for a in angles]
    outline = [(drum.r, -0.02), *((float(x), float(z)) for x, z in outline[:-1]), (0.0, rise)]
    roof = capped([(x, z + 0.02) for x, z in outline], style, drum.n)
    parts = [*_courses(drum, style, rng), Part(moved(roof, at(0, 0, drum.high)), "dished head", "tank", "tank")]
    if rng.random() < 0.7:
        path = np.array([(x + 0.01, 0.0, z + 0.02 + drum.high) for x, z in outline[1:]])
        rib = sweep(path, rounded_rectangle(0.05, 0.06, 0.0), up=(0.0, 1.0, 0.0))
        count = int(rng.choice([8, 12]))
        parts.append(Part(around(rib, count), "dished head", "tank", "tank"))
    some, ports = _low_fittings(drum, style, rng)
    top = mouth(str(rng.choice(["vent", "blind"])), 100, 0.15, style, 0.0, 0.03)
    parts += some + placed(top, at(0, 0, drum.high + rise))
    return Model([*parts, *_access(drum, 0.02, style, rng)], ports=tuple(ports), kind="dome roof tank")


def _girders(drum: Drum, count: int, rng: np.random.Generator) -> list[Part]:
    """Stiffening rings of angle or flat bar round a shell, one near the rim."""
    parts, kind = [], int(rng.integers(3))
    wide = 0.05 + 0.04 * drum.r
    for z in np.linspace(drum.high - 0.02, drum.low + 0.4 * (drum.high - drum.low), count):
        if kind == 0:
            solid = ring(drum.r - drum.dip, drum.r + wide, z - 0.012, z, drum.n)
        elif kind == 1:
            r = drum.r + wide
            outline = [
                (drum.r, z - 0.01),
                (r, z - 0.01),
                (r, z - wide),
                (r + 0.01, z - wide),
                (r + 0.01, z),
                (drum.r, z),
            ]
            solid = weld([revolve(outline, drum.n, closed=True)])
        else:
            solid = moved(torus(drum.r + 0.01, 0.025, drum.n, 8), at(0, 0, z - 0.02))
        parts.append(Part(solid, "shell", "tank", "tank"))
    return parts


def _open_top(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An open tank: a sheet shell with wind girders, nozzles, an overflow, maybe a bridge with a rail across."""
    drum = _big(rng, style, (0.6, 1.6))
    wall = ring(0.985 * drum.r, drum.r, drum.low, drum.high, drum.n)
    bottom = cylinder(1.02 * drum.r, drum.low, drum.low + 0.012, drum.n)
    parts = [Part(wall, "shell", "tank", "tank"), Part(bottom, "shell", "tank", "tank")]
    if drum.low > 0.01:
        slab = cylinder(1.1 * drum.r, 0.0, drum.low, drum.n)
        parts.append(Part(slab, "foundation", "concrete", "", _FRAME))
    parts += _girders(drum, int(rng.integers(1, 4)), rng)
    some, ports = _low_fittings(drum, style, rng, False)
    parts += some
    if rng.random() < 0.5:
        beams = [box((2 * drum.r + 0.1, 0.06, 0.14), (0, y, drum.high + 0.07)) for y in (-0.4, 0.4)]
        parts += [Part(beam, "beam", "steel", "", _FRAME) for beam in beams]
        parts.append(Part(box((2 * drum.r, 0.85, 0.03), (0, 0, drum.high + 0.155)), "grating", "steel", "", _FRAME))
    if drum.high > 1.6:
        gap = 0.2
        parts += placed(ladder(drum.r + gap, 0.0, drum.high + 0.9, style, False, gap + drum.dip), spun("z", 0.7))
    return Model(parts, ports=tuple(ports), kind="open tank")


def _floating_roof(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A floating-roof tank (API 650 annex C): a deck with a pontoon inside an open shell, legs, a rolling ladder."""
    drum = _big(rng, style, (0.7, 1.3))
    r, level = 0.985 * drum.r, drum.low + float(rng.uniform(0.5, 0.9)) * (drum.high - drum.low)
    wall = ring(r, drum.r, drum.low, drum.high, drum.n)
    bottom = cylinder(1.02 * drum.r, drum.low - 0.01 * (drum.low > 0), drum.low + 0.006, drum.n)
    deck = cylinder(0.8 * drum.r, level - 0.02, level, drum.n)
    pontoon = ring(0.79 * drum.r, 0.955 * drum.r, level - 0.15, level + 0.1, drum.n)
    seal = ring(0.95 * drum.r, r * np.cos(np.pi / drum.n) + 0.01, level, level + 0.12, drum.n)
    legs_ = [
        merge([moved(cylinder(0.04, level - 0.4, level + 0.35, 8), at(x * np.cos(a), x * np.sin(a)))])
        for x, count in ((0.87 * drum.r, 6), (0.4 * drum.r, 3))
        for a in np.arange(count) * 2 * np.pi / count
    ]
    parts = [
        Part(merge([wall, bottom]), "shell", "tank", "tank"),
        Part(merge([deck, pontoon]), "dished head", "tank", "tank"),
        Part(seal, "gasket", "rubber", "tank", "Pipe assembly"),
        Part(merge(legs_), "tank leg", "steel", "tank leg"),
    ]
    if drum.low > 0.02:
        slab = cylinder(1.15 * drum.r, 0.0, drum.low - 0.01, drum.n)
        parts.append(Part(slab, "foundation", "concrete", "", _FRAME))
    parts += _girders(drum, int(rng.integers(1, 3)), rng)
    start, end = np.array([-drum.r - 0.02, 0, drum.high]), np.array([0.2 * drum.r, 0, level + 0.03])
    aside = [np.array([0.0, y, 0.0]) for y in (-0.3, 0.3)]
    stiles = [rope(np.array([start + y, end + y]), 0.03, 6) for y in aside]
    steps = [start + s * (end - start) for s in np.linspace(0.03, 0.97, 12)]
    rungs = [rope(np.array([step + aside[0], step + aside[1]]), 0.015, 6) for step in steps]
    parts.append(Part(merge([*stiles, *rungs]), "ladder", "safety", "", _FRAME))
    some, ports = _low_fittings(drum, style, rng)
    stairs = _spiral(drum) if drum.high > 1.8 else []
    return Model([*parts, *some, *stairs], ports=tuple(ports), kind="floating roof tank")


def _silo(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A silo: a slim shell (plain, hooped or of corrugated sheet), a steep cone, columns with braces, a roof filter."""
    r = float(rng.uniform(0.6, 1.4))
    n, cone = sides(style, r), r * float(rng.uniform(1.2, 1.9))
    low = cone + float(rng.uniform(0.6, 1.2))
    drum = Drum(r, low, low + float(rng.uniform(2.0, 4.0)) * r, n)
    kind = int(rng.integers(3))
    waves = int((drum.high - low) / 0.12)
    if kind == 2:
        zs = np.linspace(low, drum.high, 2 * waves + 1)
        outline = [(r + (0.0 if k % 2 else 0.025), float(z)) for k, z in enumerate(zs)]
        shell = turned(outline, n)
    else:
        shell = drum.solid(style)
    parts = [Part(shell, "shell", "tank", "tank")]
    if kind == 1:
        hoops = [ring(0.99 * r, 1.02 * r + 0.01, z, z + 0.05, n) for z in np.linspace(low + 0.3, drum.high - 0.3, 4)]
        parts += [Part(hoop, "shell", "tank", "tank") for hoop in hoops]
    mouth_r = max(0.1, 0.15 * r)
    funnel = capped([(r, 0.0), (r, 0.02), (mouth_r, cone), (0.0, cone)], style, n)
    parts.append(Part(moved(funnel, at(0, 0, low) @ spun("x", np.pi)), "dished head", "tank", "tank"))
    rise = r * float(rng.uniform(0.15, 0.5))
    roof = capped([(1.02 * r + 0.02, 0.0), (1.02 * r + 0.02, 0.01), (0.12 * r, rise), (0.0, rise)], style, n)
    parts.append(Part(moved(roof, at(0, 0, drum.high)), "dished head", "tank", "tank"))
    gate = merge(
        [
            ring(mouth_r, 1.5 * mouth_r, low - cone - 0.02, low - cone, n),
            cylinder(mouth_r, low - cone - 0.12, low - cone, n),
        ]
    )
    parts.append(Part(gate, "nozzle", "flange", "nozzle"))
    parts += legs("beam", Drum(r, low, drum.high, n), style, rng)
    if rng.random() < 0.6:
        unit = merge(
            [
                cylinder(0.25, drum.high + 0.4 * rise, drum.high + rise + 0.6, 16),
                cylinder(0.27, drum.high + rise + 0.6, drum.high + rise + 0.65, 16),
            ]
        )
        parts.append(Part(moved(unit, at(0.35 * r)), "filter", "tank", "", "Equipment"))
    fill = [
        (r + 0.06, 0, 0.8),
        (r + 0.06, 0, drum.high + rise),
        (r - 0.15, 0, drum.high + rise + 0.15),
        (0.5 * r, 0, drum.high + 0.45 * rise),
    ]
    parts.append(Part(moved(rope(fill, 0.057, 12), spun("z", 2.0)), "pipe", "pipe", "", "Pipe assembly"))
    gap = 0.2
    parts += placed(ladder(r + gap, 0.3, drum.high + 0.9, style, True, gap + 0.05), spun("z", 4.3))
    return Model(parts, kind="silo")


def _cone_bottom(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cone-bottom tank of plastic or sheet in a steel frame: ring, legs, braces, a bottom outlet, a screw lid."""
    r = float(rng.uniform(0.35, 0.9))
    n, cone = sides(style, r), r * float(rng.uniform(0.5, 1.2))
    low = cone + float(rng.uniform(0.35, 0.7))
    drum = Drum(r, low, low + float(rng.uniform(0.8, 2.0)) * r, n)
    funnel = capped([(r, 0.0), (r, 0.02), (0.12 * r, cone), (0.0, cone)], style, n)
    top = str(rng.choice(["shallow", "flat", "torispherical"]))
    parts = [
        Part(drum.solid(style), "shell", "tank", "tank"),
        Part(moved(funnel, at(0, 0, low) @ spun("x", np.pi)), "dished head", "tank", "tank"),
        Part(moved(head(top, r, style, n), at(0, 0, drum.high)), "dished head", "tank", "tank"),
    ]
    side, count = 0.05, int(rng.choice([3, 4, 6]))
    solids = [ring(r - drum.dip, r + 0.07, low - 0.02, low + 0.03, n)]
    for k in range(count):
        turn = spun("z", 2 * np.pi * k / count)
        solids.append(moved(box((side, side, low), (r + 0.03, 0, low / 2)), turn))
        solids.append(moved(foot_plate(r + 0.03, 0, 0.12), turn))
    hoop = moved(torus(r + 0.03, 0.02, max(n, 4 * count), 8), at(0, 0, 0.3 * low))
    parts += [Part(merge(solids), "tank leg", "steel", "tank leg"), Part(hoop, "tank leg", "steel", "tank leg")]
    dn = int(rng.choice([40, 50, 80]))
    reach = min(0.9 * (low - cone) - 0.05, 0.2)
    parts += placed(
        mouth(str(rng.choice(["plain", "fitting"])), dn, reach, style, 0.0, 0.02),
        at(0, 0, low - cone) @ spun("x", np.pi),
    )
    size = min(0.25, 0.5 * r)
    apex = float(parts[2].solid.vertices[:, 2].max())
    parts += placed(manway("lid", size, style, rng, 0.0, 0.15 * r), at(0, 0, apex - 0.01))
    return Model(parts, kind="cone bottom tank")


def _plastic(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A rotationally moulded tank: a ribbed shell, rounded shoulders, a screw lid, bulkhead fittings, level marks."""
    r = float(rng.uniform(0.35, 1.2))
    tall, n = r * float(rng.uniform(1.2, 2.6)), sides(style, r)
    ribs, deep = int(rng.integers(3, 9)), float(rng.uniform(0.01, 0.04))
    pitch = 0.85 * tall / ribs
    outline = [(0.97 * r, 0.0), (r, 0.02)]
    for k in range(ribs):
        z = 0.02 + 0.05 * tall + k * pitch
        outline += [(r, z), (r + deep, z + 0.2 * pitch), (r + deep, z + 0.6 * pitch), (r, z + 0.8 * pitch)]
    top = outline[-1][1] + 0.3 * pitch
    shoulder = float(rng.uniform(0.1, 0.4)) * r
    outline += [(r, top), (0.96 * r, top + 0.4 * shoulder), (0.8 * r, top + 0.75 * shoulder), (0.4 * r, top + shoulder)]
    size = min(0.25, 0.38 * r)
    parts = [
        Part(turned(outline, n), "shell", "tank", "tank"),
        *placed(manway("lid", size, style, rng, 0.0, 0.02), at(0.0, 0.0, top + shoulder)),
    ]
    drum = Drum(r, 0.0, top, n)
    for k, z in enumerate((0.02 + 0.05 * tall, top)[: int(rng.integers(1, 3))]):
        dn = int(rng.choice([25, 40, 50]))
        kind = str(rng.choice(["fitting", "half", "plain"]))
        parts += outlet(kind, dn, drum.side(4.6 + k, max(z, 0.14) - 0.04), style, r, drum.dip + 0.01)[0]
    if rng.random() < 0.4:
        tie = around(along("x", torus(0.05, 0.012, 12, 6)), 3, 0.72 * r, 0.5)
        parts.append(Part(moved(tie, at(0, 0, top + 0.8 * shoulder)), "lifting lug", "tank", "lifting lug"))
    if rng.random() < 0.3:
        parts.append(Part(_bund(1.3 * r, 0.6 * tall, n), "tank", "tank", "tank"))
    return Model(parts, kind="plastic tank")


def _bund(r: float, tall: float, n: int) -> Solid:
    """An open tub that catches what a tank loses; its floor is as thick as a sheet [m]."""
    return weld(
        [
            revolve(
                [(0.0, -0.01), (r, -0.01), (1.03 * r, tall), (1.03 * r - 0.02, tall), (r - 0.02, 0.001), (0.0, 0.001)],
                n,
            )
        ]
    )


def _ibc(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An intermediate bulk container (1000 l, 1.2 x 1.0 x 1.16 m): a moulded bottle in a tube cage on a pallet."""
    w, d = 1.2, 1.0
    h, base = float(rng.choice([0.72, 1.0, 1.1])), 0.16
    n = max(6, min(10, style.round(0.01)))
    loops = []
    for z, share in ((0.0, 0.9), (0.05, 0.98), (0.12, 1.0), (h - 0.1, 1.0), (h - 0.03, 0.96), (h, 0.85)):
        flat = rounded_rectangle(share * (w - 0.06), share * (d - 0.06), 0.12, 3)
        loops.append(np.column_stack([flat, np.full(len(flat), base + z)]))

    parts = [Part(lofted(loops), "shell", "dial", "tank")]
    parts += placed(manway("lid", 0.115, style, rng, 0.0, 0.02), at(0, 0, base + h))
    xs, ys = np.linspace(-w / 2, w / 2, int(rng.integers(6, 10))), np.linspace(-d / 2, d / 2, int(rng.integers(5, 8)))
    bars = [rod((x, s * d / 2, base), (x, s * d / 2, base + h + 0.02), 0.009, n) for x in xs for s in (-1, 1)]
    bars += [rod((s * w / 2, y, base), (s * w / 2, y, base + h + 0.02), 0.009, n) for y in ys[1:-1] for s in (-1, 1)]
    hoop = rounded_rectangle(w, d, 0.05, 2)
    for z in np.linspace(base + 0.08, base + h + 0.02, int(rng.integers(4, 6))):
        path = np.column_stack([hoop, np.full(len(hoop), z)])
        bars.append(sweep(path, circle(0.01, n), closed=True))
    for s in (-1, 1):
        bars.append(rod((s * 0.25 * w, -d / 2, base + h + 0.025), (s * 0.25 * w, d / 2, base + h + 0.025), 0.01, n))
    parts.append(Part(merge(bars), "tank", "clamp", "tank"))
    parts += _pallet(w, d, base, rng)
    valve = merge(
        [
            along("-y", cylinder(0.03, 0.42, 0.58, 12)),
            along("-y", cylinder(0.045, 0.58, 0.61, 12)),
            box((0.02, 0.06, 0.1), (0, -0.53, 0.06)),
        ]
    )
    parts.append(Part(moved(valve, at(0, 0, base + 0.09)), "valve", "rubber", "", "Valve assembly"))
    return Model(parts, kind="intermediate bulk container")


def _pallet(w: float, d: float, base: float, rng: np.random.Generator) -> list[Part]:
    """A pallet: boards on blocks or runners of steel tube."""
    deck = [box((w, 0.13, 0.022), (0, y, base - 0.011)) for y in np.linspace(-d / 2 + 0.065, d / 2 - 0.065, 5)]
    solids = [*deck]
    if rng.random() < 0.6:
        solids += [
            box((0.12, 0.1, base - 0.044), (x, y, base / 2))
            for x in (-w / 2 + 0.06, 0, w / 2 - 0.06)
            for y in (-d / 2 + 0.065, 0, d / 2 - 0.065)
        ]
        solids += [box((0.12, d, 0.022), (x, 0, 0.011)) for x in (-w / 2 + 0.06, 0, w / 2 - 0.06)]
    else:
        solids += [box((0.06, d, base - 0.022), (x, 0, (base - 0.022) / 2)) for x in (-w / 2 + 0.06, 0, w / 2 - 0.06)]
    return [Part(merge(solids), "skid frame", "safety", "", _FRAME)]


STORAGE: tuple[Family, ...] = (
    tank_family("tank/cone roof", _cone_roof, 1.0),
    tank_family("tank/dome roof", _dome_roof),
    tank_family("tank/open top", _open_top),
    tank_family("tank/floating roof", _floating_roof),
    tank_family("tank/silo", _silo, 1.0),
    tank_family("tank/cone bottom", _cone_bottom, 1.0),
    tank_family("tank/moulded plastic", _plastic, 1.0),
    tank_family("tank/bulk container", _ibc, 1.0),
)
