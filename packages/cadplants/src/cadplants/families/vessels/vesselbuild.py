"""Upright and lying vessels, each family with one build of head, nozzle, manway, saddle, skirt, leg or lug."""

from __future__ import annotations

from functools import partial

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.vessels.vessel_fittings import (
    Drum,
    fall,
    head,
    head_height,
    lug,
    manway,
    mouth,
    mouth_reach,
    sides,
)
from cadplants.families.vessels.vesselfeet import legs, saddle, skirt
from cadplants.family import Build, Family, Model, Part, Port, placed
from cadplants.mesh_ops import moved
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import cylinder, ring
from cadplants.standards import FLANGES
from cadplants.transforms import at, looking, spun

__all__ = ["VESSEL_BUILDS", "closed_vessel", "outlet", "tank_family"]

_HEADS = ("2:1", "torispherical", "torispherical")


def tank_family(name: str, build: Build, weight: float = 0.7) -> Family:
    """A family of whole tanks on the floor."""
    return Family(name, "floor", "Tank", "tank", build, (15,), weight=weight)


def outlet(
    kind: str, dn: int, pose: Floats, style: ModelingStyle, r: float = 0.0, dip: float = 0.0, spare: float = 0.04
) -> tuple[list[Part], list[Port]]:
    """A nozzle set on a surface by a frame with z outward, and its port where a line can be flanged on."""
    reach = mouth_reach(dn, spare)
    parts = placed(mouth(kind, dn, reach, style, r, dip), pose)
    if kind not in ("plain", "pad", "heavy"):
        return parts, []
    out = pose[:3, 2]
    return parts, [Port(looking(pose[:3, 3] + out * reach, out), dn)]


def _dn(rng: np.random.Generator, r: float) -> int:
    """A nominal size that suits a vessel of this radius."""
    return int(rng.choice([dn for dn in (25, 40, 50, 80, 100, 150) if FLANGES[dn].outer < 0.9 * r] or [25]))


def closed_vessel(drum: Drum, bottom: str, top: str, style: ModelingStyle) -> list[Part]:
    """A shell, maybe in courses, with two heads."""
    return [
        Part(drum.solid(style), "shell", "tank", "tank"),
        Part(moved(head(top, drum.r, style, drum.n), at(0, 0, drum.high)), "dished head", "tank", "tank"),
        Part(
            moved(head(bottom, drum.r, style, drum.n), at(0, 0, drum.low) @ spun("x", np.pi)),
            "dished head",
            "tank",
            "tank",
        ),
    ]


def _upright(
    _: int,
    style: ModelingStyle,
    rng: np.random.Generator,
    top: str = "",
    feet: str = "",
    nozzles: str = "plain",
    man: str = "",
    lift: str = "",
) -> Model:
    """An upright vessel (DIN 28022 proportions) with one special build of head, feet, nozzles, manway or lugs."""
    r = float(rng.uniform(0.45, 1.1)) if man else float(np.exp(rng.uniform(np.log(0.2), np.log(1.2))))
    if feet in ("tripod", "pads"):
        r = min(r, 0.6) * 0.7  # what stands on little weighs little
    height, n = float(rng.uniform(1.2, 4.0)) * r + 0.3, sides(style, r)
    upper = top or str(rng.choice(_HEADS))
    lower = top if top and rng.random() < 0.6 else "2:1"
    feet = feet or str(rng.choice(["angle", "pipe", "pads" if lower == "2:1" else "pipe"]))
    spare = 0.12 if feet == "pads" else float(rng.uniform(0.2, 0.6)) + 0.3 * r
    low = head_height(lower, r) + spare
    drum = Drum(r, low, low + height, n)
    parts = closed_vessel(drum, lower, upper, style)
    if feet in ("open", "flared", "chairs"):
        parts += skirt(feet, drum, style, rng)
    else:
        parts += legs(feet, drum, style, rng)
    ports: list[Port] = []
    for k in range(int(rng.integers(1, 4))):
        dn = _dn(rng, r)
        z = low + height * float(rng.uniform(0.15, 0.85))
        kind = nozzles if k == 0 or rng.random() < 0.6 else "plain"
        some, port = outlet(kind, dn, drum.side(2.1 * k + 1.2, z), style, r, drum.dip)
        parts += some
        ports += port if z > 0.6 else []
    apex = drum.high + head_height(upper, r)
    if rng.random() < 0.75 or nozzles in ("vent", "heavy"):
        some, port = outlet(nozzles, _dn(rng, 0.6 * r), at(0, 0, apex), style, 0.0, 0.03 * r)
        parts += some
        ports += port
    if man:
        size = float(rng.uniform(0.42, 0.6)) * r if man in ("oval", "swing") else float(rng.uniform(0.23, 0.3))
        size = min(size, 0.16 if man == "oval" else 0.3)
        parts += placed(
            manway(man, size, style, rng, r, drum.dip), drum.side(5.0, low + height * float(rng.uniform(0.35, 0.6)))
        )
    if lift:
        parts += _lugs(lift, drum, apex, style, rng)
    return Model(parts, ports=tuple(ports), kind="tank")


def _lugs(kind: str, drum: Drum, apex: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """Two to four lugs near the upper rim; eyebolts on top of the head."""
    size = float(rng.uniform(0.07, 0.12)) + 0.06 * drum.r
    count = int(rng.choice([2, 2, 3, 4]))
    if kind == "eyebolt":
        boss = Part(
            cylinder(0.5 * size, apex - 0.05 * drum.r - 0.02, apex + 0.012, 12), "lifting lug", "tank", "lifting lug"
        )
        x = 0.3 * drum.r
        drop = 0.04 * drum.r
        eyes = []
        for s in (-1, 1):
            pose = at(s * x, 0, 0)
            eyes += placed([boss], pose @ at(0, 0, -drop))
            eyes += placed(lug("eyebolt", size, style), pose @ at(0, 0, apex + 0.01 - drop))
        return eyes
    parts = []
    for k in range(count):
        pose = drum.side(2 * np.pi * k / count + 0.4, drum.high - (1.1 * size if kind != "ring" else size))
        parts += placed(lug(kind, size, style, drum.r, drum.dip), pose)
    return parts


def _lying(
    _: int,
    style: ModelingStyle,
    rng: np.random.Generator,
    rest: str = "ribbed",
    top: str = "",
    man: str = "",
    lift: str = "",
) -> Model:
    """A lying vessel on two or three saddles of one build, with nozzles and maybe a manway on top."""
    r = float(np.exp(rng.uniform(np.log(0.4 if man else 0.2), np.log(1.15))))
    if rest in ("sheet", "block"):
        r = min(r, 0.8) * 0.7
    length, n = min(float(rng.uniform(2.2, 6.0)) * r, 4.5), sides(style, r)
    axis = r + float(rng.uniform(0.15, 0.3)) + 0.25 * r * float(rng.random())
    if rest in ("frame", "concrete"):
        axis += 0.5
    drum = Drum(r, 0.0, length, n)
    kind = top or str(rng.choice([*_HEADS, "hemispherical", "flat"]))
    lay = at(-length / 2, 0, axis) @ spun("y", np.pi / 2)
    parts = placed(closed_vessel(drum, kind, kind, style), lay)
    count = 3 if length > 4.8 * r and rng.random() < 0.3 else 2
    one = saddle(rest, r, axis, style, rng)
    for x in np.linspace(-0.3, 0.3, count) * length:
        parts += placed(one, at(x))
    spots = list(np.linspace(0.15, 0.85, int(rng.integers(2, 5))) * length)
    ports: list[Port] = []
    if man:
        pose = lay @ drum.side(np.pi, float(spots.pop(1)))
        size = min(0.5 * r, float(rng.uniform(0.22, 0.3)))
        size = min(size, 0.16) if man == "oval" else size
        parts += placed(manway(man, size, style, rng, r, drum.dip), pose)
    for z in spots:
        kind_of = str(rng.choice(["plain", "pad"]))
        some, port = outlet(kind_of, _dn(rng, 0.8 * r), lay @ drum.side(np.pi, float(z)), style, r, drum.dip)
        parts += some
        ports += port
    if rng.random() < 0.5:
        apex = head_height(kind, r)
        pose = lay @ at(0, 0, length + apex)
        some, port = outlet("plain", _dn(rng, 0.6 * r), pose, style, 0.0, 0.02 * r)
        parts += some
        ports += port
    if lift:
        for z in (0.12 * length, 0.88 * length):
            turn = lay @ drum.side(np.pi + 0.35 * (1 if z < length / 2 else -1), z)
            parts += placed(lug(lift, 0.08 + 0.06 * r, style, r, drum.dip), turn)
    return Model(parts, ports=tuple(ports), kind="tank")


def _bolted_head(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A vessel whose upper head comes off: girth flanges (EN 1092-1 style) with bolts all round, on legs."""
    from cadplants.families.valves.valve import bolt_circle

    r = float(rng.uniform(0.2, 0.6))
    height, n = float(rng.uniform(1.0, 2.6)) * r + 0.2, sides(style, r)
    low = head_height("2:1", r) + 0.35
    drum = Drum(r, low, low + height, n)
    thick, wide = 0.015 + 0.04 * r, 1.12 * r + 0.035
    kind = str(rng.choice(["flat plate", "torispherical", "hemispherical"]))
    parts = [
        Part(drum.solid(style), "shell", "tank", "tank"),
        Part(moved(head("2:1", r, style, n), at(0, 0, low) @ spun("x", np.pi)), "dished head", "tank", "tank"),
        Part(ring(r, wide, drum.high - thick, drum.high, n), "shell", "flange", "tank"),
        *legs(str(rng.choice(["pipe", "angle"])), drum, style, rng),
    ]
    top = drum.high + thick
    lid = cylinder(wide, drum.high, top, n) if kind == "flat plate" else ring(0.97 * r, wide, drum.high, top, n)
    apex = top
    parts.append(Part(lid, "dished head", "flange", "tank"))
    if kind != "flat plate":
        parts.append(Part(moved(head(kind, r, style, n), at(0, 0, top - 0.004)), "dished head", "tank", "tank"))
        apex += head_height(kind, r) - 0.004
    count = int(np.clip(2 * np.pi * r / 0.09, 12, 36))
    bolts = bolt_circle(count, 0.5 * (r + wide) + 0.004, 0.016, drum.high - thick, top)
    parts.append(Part(bolts, "bolt", "fastener", "tank", "Connection assembly", True))
    ports: list[Port] = []
    for pose, curve in ((at(0, 0, apex), 0.0), (drum.side(1.0, low + 0.5 * height), r)):
        some, port = outlet("plain", _dn(rng, 0.7 * r), pose, style, curve, drum.dip + 0.02 * r)
        parts += some
        ports += port
    if kind != "flat plate" and rng.random() < 0.5:
        eye = lug("eyebolt", 0.08, style)
        x = 0.55 * r
        parts += placed(eye, at(0, x, apex - (0.1 * r if kind == "torispherical" else fall(r, x)) - 0.01))
    return Model(parts, ports=tuple(ports), kind="tank")


def _bottom_nozzles(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A hygienic vessel: clamp ferrules all over, a conical bottom, pipe legs with ball feet, a swing-bolt manway."""
    r = float(rng.uniform(0.3, 0.8))
    height, n = float(rng.uniform(1.0, 2.5)) * r + 0.2, sides(style, r)
    lower = str(rng.choice(["conical", "conical", "torispherical"]))
    low = head_height(lower, r) + float(rng.uniform(0.35, 0.6))
    drum = Drum(r, low, low + height, n)
    parts = [*closed_vessel(drum, lower, "torispherical", style), *legs("pipe", drum, style, rng)]
    apex = drum.high + head_height("torispherical", r)
    dn = int(rng.choice([25, 40, 50]))
    for k in range(int(rng.integers(3, 7))):
        pose = drum.side(1.1 * k, low + height * float(rng.uniform(0.1, 0.9)))
        parts += placed(mouth("ferrule", int(rng.choice([20, 25, 40])), 0.08, style, r, drum.dip), pose)
    parts += placed(mouth("ferrule", dn, 0.12, style), at(0, 0, low - head_height(lower, r) + 0.01) @ spun("x", np.pi))
    size = min(0.22, 0.45 * r)
    parts += placed(manway("swing", size, style, rng, 0.0, 0.12 * r), at(0.0, 0.0, apex - 0.005))
    for k in range(3):
        a, x = 2.1 * k + 0.6, 0.72 * r
        z = drum.high + 0.6 * head_height("torispherical", r)
        parts += placed(mouth("ferrule", 25, 0.1, style, 0.0, 0.12 * r), at(x * np.cos(a), x * np.sin(a), z))
    if rng.random() < 0.6:
        parts.append(
            Part(ring(0.99 * r, 1.06 * r, low + 0.15 * height, low + 0.8 * height, n), "shell", "trim", "tank")
        )
    return Model(parts, kind="process vessel")


VESSEL_BUILDS: tuple[Family, ...] = (
    *(
        tank_family(f"dished head/{name}", partial(_upright, top=kind))
        for name, kind in (
            ("hemispherical", "hemispherical"),
            ("conical", "conical"),
            ("knuckled flat", "flat"),
            ("shallow", "shallow"),
        )
    ),
    tank_family("dished head/bolted on", _bolted_head),
    *(
        tank_family(f"nozzle/{name}", partial(_upright, nozzles=kind))
        for name, kind in (
            ("reinforcing pad", "pad"),
            ("long welding neck", "heavy"),
            ("blinded", "blind"),
            ("gooseneck", "vent"),
            ("half coupling", "half"),
            ("tank fitting", "fitting"),
        )
    ),
    tank_family("nozzle/clamp ferrule", _bottom_nozzles),
    tank_family("manway/hinged", partial(_upright, man="hinged")),
    tank_family("manway/davit", partial(_lying, man="davit")),
    tank_family("manway/swing bolts", partial(_lying, man="swing")),
    tank_family("manway/oval", partial(_upright, man="oval")),
    *(
        tank_family(f"saddle/{kind}", partial(_lying, rest=kind), 0.8)
        for kind in ("ribbed", "block", "sheet", "concrete", "frame")
    ),
    tank_family("skirt/doorways", partial(_upright, feet="open"), 0.9),
    tank_family("skirt/flared", partial(_upright, feet="flared"), 0.9),
    tank_family("skirt/bolt chairs", partial(_upright, feet="chairs"), 0.9),
    tank_family("tank leg/braced beams", partial(_upright, feet="beam")),
    tank_family("tank leg/bracket on frame", partial(_upright, feet="bracket")),
    tank_family("tank leg/bent flat", partial(_upright, feet="tripod")),
    tank_family("tank leg/short pads", partial(_upright, feet="pads")),
    tank_family("lifting lug/plate", partial(_lying, lift="plate")),
    tank_family("lifting lug/on pad", partial(_upright, lift="pad", feet="chairs")),
    tank_family("lifting lug/trunnion", partial(_upright, lift="trunnion", feet="open")),
    tank_family("lifting lug/eyebolt", partial(_upright, lift="eyebolt")),
    tank_family("lifting lug/bent bar", partial(_upright, lift="ring")),
    tank_family("lifting lug/cheeks and pin", partial(_lying, lift="cheeks")),
)
