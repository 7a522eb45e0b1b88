"""Further heat exchangers and cooling towers."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.valves.valve import bolt_circle
from cadplants.families.vessels.vessel_fittings import head, renamed, sides
from cadplants.families.vessels.vesselbuild import outlet
from cadplants.families.vessels.vesselfeet import saddle
from cadplants.family import Build, Family, Model, Part, Port, placed
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import along, around, box, cylinder, hexagon, lofted, ring, rod, rope, turned
from cadplants.standards import FLANGES, PIPES
from cadplants.transforms import at, spun

__all__ = ["EXCHANGERS", "equipment_family", "equipment_mouth", "feet_of", "frame_of"]

_NAME, _FRAME, _JOINT = "heat exchanger", "Structural element", "Connection assembly"


def equipment_family(name: str, build: Build, weight: float = 0.8) -> Family:
    """A family of equipment on the floor."""
    return Family(name, "floor", "Equipment", name.split("/")[0], build, (15,), weight=weight)


def equipment_mouth(
    name: str, dn: int, pose: Floats, style: ModelingStyle, r: float = 0.0, dip: float = 0.0
) -> tuple[list[Part], list[Port]]:
    """A flanged mouth that belongs to a piece of equipment of this name, and its port."""
    parts, ports = outlet("plain", dn, pose, style, r, dip)
    return renamed(parts, name), ports


def feet_of(parts: list[Part], name: str) -> list[Part]:
    """Saddles, skirts or legs under a piece of equipment of this name: they stay parts of tanks."""
    return [p if p.group else Part(p.solid, p.name, p.color, name, "Tank") for p in parts]


def frame_of(w: float, d: float, h: float, side: float, low: float = 0.0, rails: bool = True) -> Solid:
    """Four posts of square tube with rails round their tops and feet."""
    posts = [
        box((side, side, h), (sx * (w - side) / 2, sy * (d - side) / 2, low + h / 2))
        for sx in (-1, 1)
        for sy in (-1, 1)
    ]
    if rails:
        for z in (low + h - side / 2, low + 0.12 * h):
            posts += [box((w, side, side), (0, s * (d - side) / 2, z)) for s in (-1, 1)]
            posts += [box((side, d, side), (s * (w - side) / 2, 0, z)) for s in (-1, 1)]
    return merge(posts)


def _girth(r: float, thick: float, x: float, n: int) -> tuple[list[Solid], Solid]:
    """A pair of girth flanges about x with their bolts."""
    wide = 1.14 * r + 0.03
    pair = [along("x", cylinder(wide, -thick, 0.0, n), x), along("x", cylinder(wide, 0.003, thick, n), x)]
    bolts = bolt_circle(int(np.clip(40 * r, 8, 28)), 0.5 * (r + wide) + 0.004, 0.014, -thick, thick)
    return pair, along("x", bolts, x)


def _kettle(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A kettle reboiler (TEMA K): a wide shell with a sloping cone down to the bundle's flange, a channel, saddles."""
    r = float(rng.uniform(0.3, 0.7))
    small, n = r * float(rng.uniform(0.5, 0.7)), sides(style, r)
    length, cone = r * float(rng.uniform(2.5, 4.0)), 0.9 * (r - 0.5 * r) + 0.1
    axis = r + float(rng.uniform(0.3, 0.5))
    low = axis - r + small  # the bundle's axis: both shells lie flush below
    a = np.arange(n) * 2 * np.pi / n
    ringed = np.column_stack([np.zeros(n), np.cos(a), np.sin(a)])
    loops = [
        small * ringed + (-length / 2 - cone, 0, low),
        r * ringed + (-length / 2, 0, axis),
        r * ringed + (length / 2, 0, axis),
    ]
    shell = lofted(loops)
    cap = moved(head("2:1", r, style, n), at(length / 2, 0, axis) @ spun("y", np.pi / 2))
    thick, x = 0.02 + 0.05 * small, -length / 2 - cone - 0.04
    neck = along("x", cylinder(small, x - 0.005, x + 0.045, n), 0, 0, low)
    pair, bolts = _girth(small, thick, x, n)
    deep = 0.9 * small + 0.1
    channel = along("-x", cylinder(small, -x, -x + deep, n), 0, 0, low)
    cover = along("-x", cylinder(1.14 * small + 0.03, -x + deep, -x + deep + thick, n), 0, 0, low)
    parts = [
        Part(shell, _NAME, "tank", _NAME),
        Part(cap, _NAME, "tank", _NAME),
        Part(merge([neck, *(moved(p, at(0, 0, low)) for p in pair)]), _NAME, "flange", _NAME),
        Part(merge([channel, cover]), _NAME, "tank", _NAME),
        Part(moved(bolts, at(0, 0, low)), "bolt", "fastener", _NAME, _JOINT, True),
    ]
    ports: list[Port] = []
    drum_dip = r * (1 - np.cos(np.pi / n))
    spots = [(x_, axis + r, 0.0, r) for x_ in (-0.25 * length, 0.2 * length)]
    spots += [(x - 0.5 * deep, low + small, 0.0, small), (x - 0.5 * deep, low - small, np.pi, small)]
    for px, pz, turn, curve in spots:
        dn = int(rng.choice([40, 50, 80])) if curve == r else 40
        some, port = equipment_mouth(_NAME, dn, at(px, 0, pz) @ spun("x", turn), style, curve, drum_dip)
        parts += some
        ports += port if turn == 0.0 else []
    for px in (-0.3 * length, 0.3 * length):
        parts += feet_of(placed(saddle("ribbed", r, axis, style, rng), at(px)), _NAME)
    return Model(parts, ports=tuple(ports), kind="kettle reboiler")


def _u_tube(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A U-tube exchanger on a wall frame or on feet: a slim shell, a square or round channel box, a dished far end."""
    r = float(rng.uniform(0.06, 0.16))
    n, length = sides(style, r), float(rng.uniform(7, 14)) * r
    axis, thick = float(rng.uniform(0.5, 1.0)), 0.02
    body = along("x", cylinder(r, -length / 2, length / 2, n), 0, 0, axis)
    cap = moved(head("torispherical", r, style, n), at(length / 2, 0, axis) @ spun("y", np.pi / 2))
    pair, bolts = _girth(r, thick, -length / 2, n)
    deep = 2.2 * r + 0.05
    square = bool(rng.random() < 0.5)
    x = -length / 2 - deep / 2
    chest = (
        box((deep, 2.2 * r, 2.4 * r), (x, 0, axis))
        if square
        else along("x", cylinder(r, x - deep / 2, x + deep / 2, n), 0, 0, axis)
    )
    lid = (
        box((0.02, 2.6 * r, 2.8 * r), (x - deep / 2 - 0.01, 0, axis))
        if square
        else along("x", cylinder(1.25 * r, x - deep / 2 - 0.02, x - deep / 2, n), 0, 0, axis)
    )
    parts = [
        Part(merge([body, cap]), _NAME, "tank", _NAME),
        Part(merge([moved(p, at(0, 0, axis)) for p in pair]), _NAME, "flange", _NAME),
        Part(merge([chest, lid]), _NAME, "valve", _NAME),
        Part(moved(bolts, at(0, 0, axis)), "bolt", "fastener", _NAME, _JOINT, True),
    ]
    dn = 25 if r < 0.1 else 40
    ports: list[Port] = []
    reach = 1.2 * r if square else r
    for px, s, out in ((x, 1, reach), (x, -1, reach), (-0.32 * length, 1, r), (0.38 * length, 1, r)):
        pose = at(px, 0, axis + s * out) @ spun("x", 0.0 if s > 0 else np.pi)
        some, port = equipment_mouth(_NAME, dn, pose, style, 0.0 if out != r else r, 0.01)
        parts += some
        ports += port if s > 0 else []
    for px in (-0.25 * length, 0.3 * length):
        post = merge(
            [
                box((0.06, 1.4 * r, axis - 0.9 * r), (px, 0, (axis - 0.9 * r) / 2)),
                box((0.14, 2.2 * r, 0.01), (px, 0, 0.005)),
            ]
        )
        strap = along("x", ring(r, 1.05 * r + 0.003, px - 0.02, px + 0.02, n), 0, 0, axis)
        parts.append(Part(post, "post", "steel", "", _FRAME))
        parts.append(Part(strap, "clamp", "steel", "", _JOINT))
    return Model(parts, ports=tuple(ports), kind="U-tube heat exchanger")


def _hairpin(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A double-pipe exchanger: jacketed pipes above each other, return bends of the inner pipe, jumpers, a frame."""
    outer, inner = ((80, 50), (65, 40), (50, 25), (100, 65))[int(rng.integers(4))]
    ro, ri = PIPES[outer].radius, PIPES[inner].radius
    rows, length = int(rng.choice([2, 2, 4, 6])), float(rng.uniform(1.4, 3.2))
    pitch, n, base = max(4.4 * ri, 2.6 * ro), style.round(ro), float(rng.uniform(0.3, 0.6))
    zs = base + pitch * np.arange(rows)
    jackets = []
    for z in zs:
        jackets.append(along("x", cylinder(ro, -length / 2, length / 2, n), 0, 0, float(z)))
        ends = [along("x", turned([(ri, -length / 2 - 0.5 * ro), (ro, -length / 2)], n), 0, 0, float(z))]
        ends.append(along("x", turned([(ro, length / 2), (ri, length / 2 + 0.5 * ro)], n), 0, 0, float(z)))
        jackets += ends
    bends = []
    a = np.linspace(-np.pi / 2, np.pi / 2, 9)
    for k in range(rows - 1):
        s, middle = (1, -1)[k % 2], (zs[k] + zs[k + 1]) / 2
        path = np.column_stack([length / 2 + ro + pitch / 2 * np.cos(a), np.zeros(9), middle + pitch / 2 * np.sin(a)])
        path = np.vstack([[(length / 2, 0, zs[k])], path, [(length / 2, 0, zs[k + 1])]])
        path[:, 0] *= s
        bends.append(rope(path, ri, n))
    parts = [Part(merge(jackets), _NAME, "tank", _NAME), Part(merge(bends), _NAME, "pipe", _NAME)]
    jumps = [
        along("z", cylinder(0.6 * ri, zs[k], zs[k + 1], n), (-1) ** k * -0.42 * length, 0) for k in range(rows - 1)
    ]
    parts.append(Part(merge(jumps), _NAME, "pipe", _NAME))
    ports: list[Port] = []
    for z, way in ((zs[0], -1), (zs[-1], -1 if rows % 2 == 0 else 1)):
        pose = at(way * (length / 2 + 0.4 * ro), 0, z) @ spun("y", way * np.pi / 2)
        some, port = equipment_mouth(_NAME, inner, pose, style)
        parts += some
        ports += port
    top = at(0.42 * length * (1 if rows % 2 == 0 else -1), 0, zs[-1] + ro)
    some, port = equipment_mouth(_NAME, inner, top, style, ro, 0.0)
    parts += some
    for x in (-0.3 * length, 0.3 * length):
        high = zs[-1] + ro + 0.05
        posts = [box((0.05, 0.05, high), (x, s * (ro + 0.035), high / 2)) for s in (-1, 1)]
        bars = [box((0.05, 2 * ro + 0.12, 0.03), (x, 0, z - ro - 0.0145)) for z in zs]
        parts.append(Part(merge([*posts, *bars]), "column", "steel", "", _FRAME))
    return Model(parts, ports=(*ports, *port), kind="double-pipe heat exchanger")


def _spiral(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A spiral exchanger: a short wide drum between two covers with hook bolts all round, on two trunnion stands."""
    r = float(rng.uniform(0.3, 0.65))
    n, deep = sides(style, r), r * float(rng.uniform(0.7, 1.5))
    axis, thick = r + float(rng.uniform(0.3, 0.5)), 0.03
    body = along("x", cylinder(r, -deep / 2, deep / 2, n), 0, 0, axis)
    rims = [
        along("x", ring(r - 0.01, 1.08 * r, s * (deep / 2 - 0.02) - 0.02, s * (deep / 2 - 0.02) + 0.02, n), 0, 0, axis)
        for s in (-1, 1)
    ]
    covers = [
        along(
            "x" if s > 0 else "-x",
            turned([(1.07 * r, deep / 2), (1.07 * r, deep / 2 + thick), (0.2 * r, deep / 2 + thick)], n),
            0,
            0,
            axis,
        )
        for s in (-1, 1)
    ]
    ribs = []
    if rng.random() < 0.6:
        ribs = [
            box((0.06, 0.015, 1.9 * r), (s * (deep / 2 + thick + 0.02), y, axis))
            for s in (-1, 1)
            for y in (-0.35 * r, 0.35 * r)
        ]
    hook = merge([rod((0, 0, -0.06), (0, 0, thick + 0.05), 0.008, 6), moved(hexagon(0.03, thick, thick + 0.02), at())])
    hooks = []
    for s in (-1, 1):
        one = around(hook, int(np.clip(26 * r, 8, 16)), 1.05 * r)
        hooks.append(along("x" if s > 0 else "-x", moved(one, at(0, 0, deep / 2)), 0, 0, axis))
    parts = [
        Part(merge([body, *rims]), _NAME, "tank", _NAME),
        Part(merge([*covers, *ribs]), _NAME, "tank", _NAME),
        Part(merge(hooks), "bolt", "fastener", _NAME, _JOINT, True),
    ]
    ports: list[Port] = []
    dn = 80 if r > 0.45 else 50
    gap = deep / 2 + thick
    for pose, curve in (
        (at(0, 0.5 * r, axis + 0.866 * r) @ spun("x", -np.pi / 6), r),
        (at(0, -0.5 * r, axis + 0.866 * r) @ spun("x", np.pi / 6), r),
        (at(gap, 0, axis) @ spun("y", np.pi / 2), 0.0),
        (at(-gap, 0, axis) @ spun("y", -np.pi / 2), 0.0),
    ):
        some, port = equipment_mouth(_NAME, dn, pose, style, curve, 0.01)
        parts += some
        ports += port
    for s in (-1, 1):
        stand = np.array([(-0.25 * r, 0), (0.25 * r, 0), (0.1 * r, axis), (-0.1 * r, axis)])
        plate = moved(extrude(stand, -0.01, 0.01), at(0, s * (1.1 * r + 0.012)) @ spun("x", np.pi / 2))
        pin = along("y" if s > 0 else "-y", cylinder(0.06 * r + 0.01, r - 0.02, 1.1 * r + 0.03, 12), 0, 0, axis)
        parts.append(
            Part(
                merge([plate, pin, box((0.6 * r, 0.14, 0.012), (0, s * (1.1 * r + 0.012), 0.006))]),
                "bracket",
                "steel",
                "",
                _JOINT,
            )
        )
    return Model(parts, ports=tuple(ports), kind="spiral heat exchanger")


def _long_plate(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A gasketed plate exchanger with a half-empty carrying bar: thin plates with cut corners, all mouths in front."""
    wide, tall = float(rng.uniform(0.3, 0.7)), float(rng.uniform(1.0, 2.0))
    rail, thick = float(rng.uniform(1.2, 2.6)), 0.04
    stack = rail * float(rng.uniform(0.25, 0.6))
    low = 0.12
    outline = np.array(
        [(-0.5, 0.05), (-0.4, 0.0), (0.4, 0.0), (0.5, 0.05), (0.5, 0.95), (0.4, 1.0), (-0.4, 1.0), (-0.5, 0.95)]
    )
    frame = np.eye(4)
    frame[:3, 0], frame[:3, 1], frame[:3, 2] = (0, 1, 0), (0, 0, 1), (1, 0, 0)
    plate = moved(extrude(outline * (wide, tall), 0.0, 1.0), frame)

    def sheet(x: float, deep: float, scale: float) -> Solid:
        pose = np.diag([deep, scale, scale, 1.0])
        return moved(plate, at(x, 0, low + (1 - scale) * tall / 2) @ pose)

    count = int(np.clip(stack / 0.016, 10, 60))
    step = stack / count
    sheets = [sheet(thick + k * step, step, 0.93 if k % 2 else 0.95) for k in range(count)]
    fixed, follow = sheet(0.0, thick, 1.08), sheet(thick + stack, thick, 1.05)
    high = low + tall
    bars = [
        box((rail + thick, 0.06, 0.1), ((rail + thick) / 2, 0, high + 0.1)),
        box((rail + thick, 0.05, 0.05), ((rail + thick) / 2, 0, low - 0.05)),
    ]
    post = merge(
        [
            box((0.05, 0.3 * wide, high + 0.15), (rail + thick, 0, (high + 0.15) / 2)),
            box((0.2, 0.5 * wide, 0.012), (rail + thick, 0, 0.006)),
        ]
    )
    feet = box((0.12, 1.1 * wide, 0.09), (thick / 2, 0, 0.045))
    nut, end = thick + stack + thick, thick + stack + 0.35
    spots = [(s * 0.57 * wide, low + f * tall) for s in (-1, 1) for f in (0.12, 0.37, 0.63, 0.88)]
    rods = [rod((-0.03, y, z), (end, y, z), 0.014, 8) for y, z in spots]
    ties = merge([*rods, *(along("x", hexagon(0.045, nut - 0.005, nut + 0.03), 0, y, z) for y, z in spots)])
    ears = [
        box((thick, 0.12 * wide, 0.06), (x, s * 0.57 * wide, low + f * tall))
        for s in (-1, 1)
        for f in (0.12, 0.37, 0.63, 0.88)
        for x in (thick / 2, thick + stack + thick / 2)
    ]
    parts = [
        Part(merge([fixed, feet, *ears[::2]]), _NAME, "valve", _NAME),
        Part(merge([follow, *ears[1::2]]), _NAME, "valve", _NAME),
        Part(merge([*bars, post]), _NAME, "steel", _NAME),
        Part(ties, "stud", "fastener", _NAME, _JOINT, True),
    ]
    parts += [Part(s, _NAME, "trim", _NAME) for s in ([merge(sheets)] if rng.random() < 0.6 else sheets)]
    ports: list[Port] = []
    dn = int(rng.choice([dn for dn in (40, 50, 65, 80, 100) if FLANGES[dn].outer < 0.5 * wide] or [25]))
    for s in (-1, 1):
        for f in (0.12, 0.88):
            some, port = equipment_mouth(
                _NAME, dn, at(0, s * 0.27 * wide, low + f * tall) @ spun("y", -np.pi / 2), style
            )
            parts += some
            ports += port
    return Model(parts, ports=tuple(ports), kind="plate heat exchanger")


def _fin_fan(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A dry cooler of A or V shape (EN 1048): two sloped finned bundles, fans between their tops, headers, a frame."""
    w, d, h = float(rng.uniform(1.6, 3.2)), float(rng.uniform(0.9, 1.4)), float(rng.uniform(0.9, 1.5))
    low, thick, vee = float(rng.uniform(0.3, 1.2)), 0.12, bool(rng.random() < 0.5)
    parts: list[Part] = []
    lean = float(np.arctan2(0.38 * d, h)) * (1 if vee else -1)
    for s in (-1, 1):
        pose = at(0, s * 0.27 * d, low + h / 2) @ spun("x", -s * lean)
        count = 40
        fins = merge([box((0.5 * w / count, thick, h), (x, 0, 0)) for x in np.linspace(-0.48 * w, 0.48 * w, count)])
        tubes = merge([rod((-0.5 * w, 0, z), (0.5 * w, 0, z), 0.012, 6) for z in np.linspace(-0.45, 0.45, 6) * h])
        parts.append(Part(moved(merge([fins, tubes]), pose), _NAME, "trim", _NAME))
        for e in (-1, 1):
            header = rod((e * (0.5 * w + 0.02), 0, -0.48 * h), (e * (0.5 * w + 0.02), 0, 0.48 * h), 0.04, 12)
            parts.append(Part(moved(header, pose), _NAME, "pipe", _NAME))
    top = low + h / 2 + 0.5 * h * np.cos(lean) + 0.5 * thick * abs(np.sin(lean)) + 0.055
    deck = box((w + 0.12, 1.1 * d, 0.06), (0, 0, top - 0.03))
    fans = int(rng.choice([1, 2, 3]))
    r = 0.4 * min(w / fans, d)
    n = style.round(r)
    shrouds, guards = [], []
    for x in (np.arange(fans) - (fans - 1) / 2) * w / fans:
        shrouds.append(moved(ring(r, 1.05 * r, top, top + 0.14, n), at(x)))
        hub = cylinder(0.25 * r, top + 0.02, top + 0.1, 16)
        blades = around(moved(box((0.75 * r, 0.25 * r, 0.008), (0.58 * r, 0, 0)), spun("x", 0.5)), 5)
        guards.append(
            moved(
                merge(
                    [
                        hub,
                        moved(blades, at(0, 0, top + 0.07)),
                        *(ring(f * r, f * r + 0.008, top + 0.135, top + 0.143, n) for f in (0.4, 0.7)),
                        box((2.02 * r, 0.012, 0.008), (0, 0, top + 0.139)),
                        box((0.012, 2.02 * r, 0.008), (0, 0, top + 0.139)),
                    ]
                ),
                at(x),
            )
        )
    parts.append(Part(merge([deck, *shrouds]), _NAME, "clamp", _NAME))
    parts.append(Part(merge(guards), "blower", "clamp", _NAME))
    posts = [
        box((0.07, 0.07, top - 0.06), (sx * (w / 2 + 0.06), sy * 0.5 * d, (top - 0.06) / 2))
        for sx in (-1, 1)
        for sy in (-1, 1)
    ]
    parts += [Part(post, "column", "steel", "", _FRAME) for post in posts]
    if low > 0.5:
        parts += [
            Part(
                rod((s * (w / 2 + 0.06), -0.5 * d, 0.1), (s * (w / 2 + 0.06), 0.5 * d, low), 0.015, 6),
                "brace",
                "steel",
                "",
                _FRAME,
            )
            for s in (-1, 1)
        ]
    dn = int(rng.choice([40, 50, 65]))
    ports: list[Port] = []
    for s in (-1, 1):
        pose = (
            at(-0.5 * w - 0.04, 0, 0)
            @ at(0, s * (0.27 + (0.15 if vee else -0.15)) * d, low + 0.85 * h)
            @ spun("y", -np.pi / 2)
        )
        some, port = equipment_mouth(_NAME, dn, pose, style)
        parts += some
        ports += port
    return Model(parts, ports=tuple(ports), kind="dry cooler")


EXCHANGERS: tuple[Family, ...] = (
    equipment_family("heat exchanger/kettle", _kettle),
    equipment_family("heat exchanger/u-tube", _u_tube),
    equipment_family("heat exchanger/double-pipe", _hairpin),
    equipment_family("heat exchanger/spiral", _spiral),
    equipment_family("heat exchanger/plate on long bar", _long_plate),
    equipment_family("heat exchanger/dry cooler", _fin_fan),
)
