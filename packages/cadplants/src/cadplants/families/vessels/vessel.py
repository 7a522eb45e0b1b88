"""Tanks upright and lying: heads, nozzles, manways, legs, skirts, saddles, lugs, level gauges."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.valves.valve import bolt_circle, disc_flange
from cadplants.family import Family, Model, Part, Port
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import Solid, extrude, merge, moved, revolve, weld
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, around, ball, box, cylinder, hexagon, ring, rod, turned
from cadplants.standards import FLANGES, PIPES
from cadplants.transforms import at, looking, spun

__all__ = ["VESSELS", "head_profile", "level_gauge", "nozzle"]

_GROUP = "Tank"
HEADS = ("2:1", "torispherical", "hemispherical", "conical", "flat")


def head_profile(kind: str, r: float, steps: int = 10) -> list[tuple[float, float]]:
    """Radius and height of a head from its rim (r, 0) to its apex [m].

    Ellipsoidal 2:1 and torispherical (crown 1.0 D, knuckle 0.1 D, DIN 28011) heads, half balls, cones, flat ends.
    """
    a = np.linspace(0, np.pi / 2, steps)
    if kind == "hemispherical":
        return [(r * np.cos(t), r * np.sin(t)) for t in a[:-1]] + [(0.0, r)]
    if kind == "torispherical":
        return [(r * np.cos(t) ** 0.6, 0.39 * r * np.sin(t) ** 1.1) for t in a[:-1]] + [(0.0, 0.39 * r)]
    if kind == "conical":
        return [(r, 0.0), (0.95 * r, 0.06 * r), (0.12 * r, 0.75 * r), (0.0, 0.75 * r)]
    if kind == "flat":
        return [(r, 0.0), (r, 0.01), (0.0, 0.01)]
    return [(r * np.cos(t), 0.5 * r * np.sin(t)) for t in a[:-1]] + [(0.0, 0.5 * r)]


def _head(kind: str, r: float, style: ModelingStyle, n: int) -> Solid:
    """A head about z, its rim at 0, its apex up; a sheet where the style models hollow."""
    profile = head_profile(kind, r)
    skirt = 0.06 * r
    outside = [(r, 0.0), *((x, z + skirt) for x, z in profile)]
    if not style.hollow:
        return turned(outside, n)
    wall = max(0.003, 0.012 * r)
    share = 1 - wall / r
    inside = [(x * share, z * share + skirt if z else skirt) for x, z in profile[::-1]]
    inside[0] = (0.0, inside[0][1] if inside[0][1] < outside[-1][1] - 0.5 * wall else outside[-1][1] - wall)
    return weld(
        [revolve([*outside, *inside, (r * share, 0.0), (r, 0.0)][:-1], n), revolve([(r * share, 0.0), (r, 0.0)], n)]
    )


def _shell(r: float, height: float, style: ModelingStyle, n: int) -> Solid:
    return ring(r - max(0.003, 0.012 * r) if style.hollow else 0.0, r, 0.0, height, n)


def nozzle(dn: int, reach: float, style: ModelingStyle, name: str = "nozzle") -> list[Part]:
    """A nozzle about z from -0.03 up to its flange's face at ``reach`` [m]; a lid, bolts and a hinge on a manway."""
    n, thick = style.round(PIPES[dn].radius), plate_thickness(dn)
    tube = ring(PIPES[dn].bore if style.hollow else 0.0, PIPES[dn].radius, -0.03, reach - 0.5 * thick, n)
    plate = moved(disc_flange(dn, style, thick), at(0, 0, reach) @ spun("x", np.pi))
    parts = [Part(tube, name, "tank", name), Part(plate, name, "flange", name)]
    if name == "manway":
        lid = moved(disc_flange(dn, style, thick), at(0, 0, reach + 0.002))
        parts.append(Part(lid, name, "tank", name))
        size = FLANGES[dn]
        parts.append(
            Part(
                bolt_circle(size.n_bolts, size.circle / 2, size.bolt, reach - thick, reach + thick + 0.002),
                "bolt",
                "fastener",
                name,
                "Connection assembly",
                True,
            )
        )
        arm = [
            (0.55 * size.outer, -0.2 * size.outer, reach - 0.03),
            (0.55 * size.outer, -0.2 * size.outer, reach + 0.12),
            (0.0, 0.0, reach + 0.12),
            (0.0, 0.0, reach + thick),
        ]
        from cadplants.primitives import rope

        parts.append(Part(rope(arm, 0.012, 8), name, "tank", name))
    return parts


def _on_side(parts: list[Part], r: float, z: float, angle: float) -> list[Part]:
    """What was built about z set on the side of an upright shell."""
    pose = spun("z", angle) @ at(r, 0, z) @ spun("y", np.pi / 2)
    return [Part(moved(p.solid, pose), p.name, p.color, p.bundle, p.group, p.fine) for p in parts]


def level_gauge(
    r: float, low: float, high: float, angle: float, style: ModelingStyle, rng: np.random.Generator
) -> list[Part]:
    """A sight-glass column between two cocks, or a magnetic level indicator with its flap rail, on an upright shell."""
    group, out = "Gauge assembly", r + float(rng.uniform(0.1, 0.2))
    column = 0.012 if (glass := bool(rng.random() < 0.5)) else 0.03
    arms, caps = [], []
    for z in (low, high):
        arms.append(rod((r - 0.01, 0, z), (out, 0, z), 0.011, 10))
        caps.append(
            along("x", merge([hexagon(0.045, -0.02, 0.02), ring(0.011, 0.03, -0.05, -0.04, 12)]), (r + out) / 2, 0, z)
        )
        caps.append(rod(((r + out) / 2, -0.03, z), ((r + out) / 2, -0.09, z), 0.005, 8))
    tube = cylinder(column, low - 0.06, high + 0.06, style.round(column))
    parts = [
        Part(merge(arms), "gauge stem", "trim", "level gauge", group),
        Part(merge(caps), "gauge stem", "trim", "level gauge", group),
    ]
    if glass:
        parts.append(Part(moved(tube, at(out)), "sight glass", "dial", "level gauge", group))
        guards = [
            rod((out + dx, dy, low - 0.04), (out + dx, dy, high + 0.04), 0.004, 6)
            for dx, dy in ((0.022, 0.022), (0.022, -0.022), (-0.022, 0.0))
        ]
        parts.append(Part(merge(guards), "level gauge", "trim", "level gauge", group))
    else:
        rail = box((0.012, 0.035, high - low), (out + column + 0.006, 0, (low + high) / 2))
        flaps = merge(
            [
                box((0.004, 0.025, 0.008), (out + column + 0.0135, 0, z))
                for z in np.linspace(low + 0.02, high - 0.02, 16)
            ]
        )
        ends = [moved(cylinder(0.05, z, z + 0.015, style.round(0.05)), at(out)) for z in (low - 0.06, high + 0.045)]
        parts += [
            Part(merge([moved(tube, at(out)), *ends]), "level gauge", "trim", "level gauge", group),
            Part(rail, "level gauge", "electrical", "level gauge", group),
            Part(flaps, "gauge face", "handle", "level gauge", group, True),
        ]
    return [Part(moved(p.solid, spun("z", angle)), p.name, p.color, p.bundle, p.group, p.fine) for p in parts]


def _feet(r: float, low: float, kind: str, style: ModelingStyle, rng: np.random.Generator, n: int) -> list[Part]:
    """Legs of pipe, angle or square tube with base plates, or a skirt; ``low`` is the shell's rim [m]."""
    if kind == "skirt":
        wall = max(0.004, 0.012 * r)
        tube = ring(r - wall, r, 0.0, low + 0.02, n)
        base = ring(0.85 * r, 1.12 * r, 0.0, 0.02, n)
        chairs = around(box((0.10, 0.02, 0.12), (0.03, 0, 0.08)), 8, r)
        return [Part(merge([tube, chairs]), "skirt", "tank", "skirt"), Part(base, "skirt", "tank", "skirt")]
    count, side = int(rng.choice([3, 4])), 0.05 + 0.05 * r
    shape = int(rng.integers(3))
    if shape == 0:
        leg = ring(0.4 * side if style.hollow else 0.0, 0.5 * side, 0.0, low + 0.25 * r, style.round(side))
    elif shape == 1:
        leg = extrude(
            np.array([[0, 0], [side, 0], [side, 0.1 * side], [0.1 * side, 0.1 * side], [0.1 * side, side], [0, side]])
            - 0.3 * side,
            0.0,
            low + 0.25 * r,
        )
    else:
        leg = extrude(rounded_rectangle(side, side, 0.1 * side, 2), 0.0, low + 0.25 * r)
    pad = box((1.8 * side, 1.8 * side, 0.012), (0, 0, 0.006))
    parts = []
    for k in range(count):
        pose = spun("z", 2 * np.pi * k / count + 0.5) @ at(r + 0.45 * side)
        parts.append(Part(moved(leg, pose), "tank leg", "steel", "tank leg"))
        parts.append(Part(moved(pad, pose), "base plate", "steel", "", "Structural element"))
    return parts


def _upright(
    style: ModelingStyle, rng: np.random.Generator, heads: tuple[str, str], feet: str, r: float, height: float
) -> Model:
    n = style.round(r) if style.round(r) < 24 else max(32, style.round(r))
    bottom = head_profile(heads[0], r)[-1][1] + 0.06 * r
    low = 0.0 if heads[0] == "flat" and feet == "none" else bottom + float(rng.uniform(0.15, 0.5))
    base = 0.02 + 0.06 * r if feet == "none" else low
    parts = [
        Part(moved(_shell(r, height, style, n), at(0, 0, base)), "shell", "tank", "tank"),
        Part(moved(_head(heads[1], r, style, n), at(0, 0, base + height)), "dished head", "tank", "tank"),
        Part(moved(_head(heads[0], r, style, n), at(0, 0, base) @ spun("x", np.pi)), "dished head", "tank", "tank"),
    ]
    if feet != "none":
        parts += _feet(r, base, feet, style, rng, n)
    ports = []
    for k in range(int(rng.integers(1, 4))):
        dn = int(rng.choice([25, 40, 50, 80, 100]))
        if FLANGES[dn].outer > 0.8 * r:
            dn = 25
        angle, z, reach = (
            2.2 * k + float(rng.uniform(0, 0.5)),
            base + height * float(rng.uniform(0.15, 0.85)),
            0.08 + PIPES[dn].radius,
        )
        parts += _on_side(nozzle(dn, reach, style), r, z, angle)
        way = np.array([np.cos(angle), np.sin(angle), 0.0])
        if z > 0.6:
            ports.append(Port(looking(way * (r + reach) + (0, 0, z), way), dn))
    top = base + height + head_profile(heads[1], r)[-1][1] + 0.06 * r
    if rng.random() < 0.7:
        dn = 50 if r < 0.6 else 80
        parts += [
            Part(moved(p.solid, at(0, 0, top)), p.name, p.color, p.bundle, p.group, p.fine)
            for p in nozzle(dn, 0.1, style)
        ]
        ports.append(Port(looking((0, 0, top + 0.1), (0, 0, 1)), dn))
    if r > 0.5 and rng.random() < 0.6:
        parts += _on_side(nozzle(300, 0.18, style, "manway"), r, base + 0.5 * height, 5.2)
    if rng.random() < 0.5:
        ear = extrude(
            np.array([[-0.05, 0], [0.05, 0], [0.05, 0.06], [0.02, 0.1], [-0.02, 0.1], [-0.05, 0.06]]),
            -0.006,
            0.006,
            (circle(0.018, 10, (0, 0.065)),),
        )
        for angle in (1.0, 1.0 + np.pi):
            pose = spun("z", angle) @ at(0.98 * r, 0, base + height) @ spun("z", np.pi / 2) @ spun("x", np.pi / 2)
            parts.append(Part(moved(ear, pose), "lifting lug", "tank", "tank"))
    if height > 0.6 and rng.random() < 0.5:
        parts += level_gauge(r, base + 0.2 * height, base + 0.75 * height, 4.2, style, rng)
    return Model(parts, ports=tuple(ports[:3]), kind="tank")


def _dished(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    r = float(rng.uniform(0.25, 1.0))
    kinds = ("2:1", "torispherical", "hemispherical")
    heads = (str(rng.choice([*kinds, "conical"])), str(rng.choice([*kinds, "flat"])))
    return _upright(style, rng, heads, str(rng.choice(["legs", "legs", "skirt"])), r, float(rng.uniform(1.0, 3.5)) * r)


def _flat(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A flat-bottom tank (API 650 in small) with a conical or flat or dished roof, straight on the ground."""
    r = float(rng.uniform(0.4, 1.4))
    return _upright(
        style,
        rng,
        ("flat", str(rng.choice(["flat", "conical", "torispherical"]))),
        "none",
        r,
        float(rng.uniform(1.0, 2.6)) * r,
    )


def _column(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A slim column or an expansion vessel."""
    r = float(rng.uniform(0.12, 0.4))
    return _upright(style, rng, ("2:1", "2:1"), str(rng.choice(["skirt", "legs"])), r, float(rng.uniform(4, 9)) * r)


def _lying(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A horizontal vessel on two saddles, with nozzles on top and at the ends, maybe a manway."""
    r = float(rng.uniform(0.25, 0.8))
    length, n = float(rng.uniform(2.5, 5.0)) * r, style.round(r)
    axis = r + float(rng.uniform(0.2, 0.5))
    kind = str(rng.choice(["2:1", "torispherical", "hemispherical", "flat"]))
    lay = at(-length / 2, 0, axis) @ spun("y", np.pi / 2)
    parts = [Part(moved(_shell(r, length, style, n), lay), "shell", "tank", "tank")]
    for s in (1, -1):
        end = at(s * length / 2, 0, axis) @ spun("y", s * np.pi / 2)
        parts.append(Part(moved(_head(kind, r, style, n), end), "dished head", "tank", "tank"))
    a = np.linspace(np.pi + 0.5, 2 * np.pi - 0.5, 9)
    cradle = np.vstack(
        [
            np.column_stack([1.01 * r * np.cos(a), 1.01 * r * np.sin(a)]),
            [(0.8 * r, -axis + 0.015), (-0.8 * r, -axis + 0.015)],
        ]
    )
    web = extrude(cradle[::-1] if _area(cradle) < 0 else cradle, -0.01, 0.01)
    ribs = [
        box((0.14, 0.012, 0.75 * (axis - 0.8 * r)), (0, y * r, 0.4 * (axis - 0.8 * r) + 0.01)) for y in (-0.7, 0.0, 0.7)
    ]
    foot = box((0.18, 1.7 * r, 0.015), (0, 0, 0.0075))
    for x in (-0.3 * length, 0.3 * length):
        up = at(x, 0, axis) @ spun("z", np.pi / 2) @ spun("x", np.pi / 2)
        parts.append(
            Part(
                merge([moved(web, up), *(moved(rib, at(x)) for rib in ribs), moved(foot, at(x))]),
                "saddle",
                "steel",
                "saddle",
            )
        )
    ports = []
    for k, x in enumerate(np.linspace(-0.35, 0.35, int(rng.integers(2, 4))) * length):
        dn = int(rng.choice([25, 40, 50, 80]))
        name = "manway" if k == 1 and r > 0.4 and rng.random() < 0.6 else "nozzle"
        dn = 300 if name == "manway" else dn
        reach = 0.12
        parts += [
            Part(moved(p.solid, at(x, 0, axis + r)), p.name, p.color, p.bundle, p.group, p.fine)
            for p in nozzle(dn, reach, style, name)
        ]
        if name == "nozzle":
            ports.append(Port(looking((x, 0, axis + r + reach), (0, 0, 1)), dn))
    return Model(parts, ports=tuple(ports), kind="tank")


def _area(outline: Floats) -> float:
    x, y = outline.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def _box_tank(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A rectangular tank or an IBC: a box with a cap, stiffeners or a cage, on a pallet."""
    w, d, h = (float(rng.uniform(*span)) for span in ((0.6, 1.6), (0.6, 1.1), (0.6, 1.3)))
    base = 0.14
    body = moved(extrude(rounded_rectangle(w, d, 0.06, 4), base, base + h), at())
    lid = moved(cylinder(0.09, base + h, base + h + 0.04, style.round(0.09)), at(0.1 * w, 0))
    parts = [Part(body, "shell", "tank", "tank"), Part(lid, "manway", "rubber", "tank")]
    if rng.random() < 0.5:
        posts = [
            rod((x, y, base), (x, y, base + h + 0.02), 0.009, 8)
            for x in np.linspace(-w / 2 - 0.01, w / 2 + 0.01, 6)
            for y in (-d / 2 - 0.01, d / 2 + 0.01)
        ]
        hoops = [
            moved(
                extrude(
                    rounded_rectangle(w + 0.04, d + 0.04, 0.06, 3),
                    0,
                    0.018,
                    (rounded_rectangle(w + 0.006, d + 0.006, 0.045, 3),),
                ),
                at(0, 0, base + h * s),
            )
            for s in (0.1, 0.35, 0.6, 0.85)
        ]
        parts.append(Part(merge([*posts, *hoops]), "tank", "clamp"))
    else:
        ribs = [box((w + 0.08, d + 0.08, 0.05), (0, 0, base + h * s)) for s in (0.25, 0.55, 0.85)]
        parts.append(Part(merge(ribs), "shell", "tank", "tank"))
    skids = [box((w, 0.1, base), (0, y, base / 2)) for y in (-0.4 * d, 0, 0.4 * d)]
    parts.append(Part(merge(skids), "tank leg", "steel"))
    spout = nozzle(50, 0.1, style)
    pose = at(0, -d / 2, base + 0.12) @ spun("x", np.pi / 2)
    parts += [Part(moved(p.solid, pose), p.name, p.color, p.bundle, p.group, p.fine) for p in spout]
    return Model(parts, kind="tank")


def _sphere(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A spherical vessel or an expansion tank on legs."""
    r = float(rng.uniform(0.2, 0.6))
    n, axis = style.round(r), r + float(rng.uniform(0.2, 0.4))
    parts = [Part(moved(ball(r, n, float(rng.choice([1.0, 0.8, 1.3]))), at(0, 0, axis)), "shell", "tank", "tank")]
    if rng.random() < 0.5:
        parts.append(Part(ring(0.99 * r, 1.03 * r, axis - 0.02, axis + 0.02, n), "shell", "tank", "tank"))
    for k in range(3):
        a = 2 * np.pi * k / 3
        parts.append(
            Part(
                rod(
                    (1.0 * r * np.cos(a), 1.0 * r * np.sin(a), 0.0),
                    (0.75 * r * np.cos(a), 0.75 * r * np.sin(a), axis - 0.3 * r),
                    0.02,
                    10,
                ),
                "tank leg",
                "steel",
                "tank leg",
            )
        )
    parts.append(Part(rod((0, 0, axis - 1.3 * r), (0, 0, axis), 0.017, 10), "nozzle", "tank", "nozzle"))
    return Model(parts, kind="expansion vessel")


def _family(name: str, build: object, weight: float = 1.0) -> Family:
    return Family(name, "floor", _GROUP, "tank", build, (15,), weight=weight)  # type: ignore[arg-type]


VESSELS: tuple[Family, ...] = (
    _family("tank/upright dished", _dished, 2.5),
    _family("tank/flat bottom", _flat),
    _family("tank/column", _column),
    _family("tank/horizontal", _lying, 2),
    _family("tank/rectangular", _box_tank),
    _family("tank/sphere", _sphere, 0.7),
)
