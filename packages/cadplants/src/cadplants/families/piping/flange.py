"""Flanges, blind flanges and gaskets of further makes: pairs in a line, and lids on a flanged end."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import pick
from cadplants.families.piping.shape import (
    BOLTED,
    STEEL,
    bolting,
    drilled,
    family,
    flat_flange,
    lathe,
    parts_of,
    pipe_x,
    prism,
    tail,
)
from cadplants.family import Build, Family, Model, Part
from cadplants.flange import flange, flange_length, plate_thickness
from cadplants.mesh_ops import Solid, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import box, cylinder, rod, rope, torus
from cadplants.standards import FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun
from cadplants.valve_body import bore_of

__all__ = ["FLANGINGS"]

_UP = spun("y", -np.pi / 2)

# One side of a joint: its solids with their names, from the pipe's end at 0 to its face; where the face is; how thick
# what its bolts clamp; number of bolts, radius of their circle, their thread, the angle of the first.
Side = tuple[list[tuple[Solid, str]], float, float, tuple[int, float, float, float]]
SideMaker = Callable[[int, ModelingStyle, np.random.Generator], Side]


def _drilling(dn: int) -> tuple[int, float, float, float]:
    size = FLANGES[dn]
    return size.n_bolts, size.circle / 2, size.bolt, np.pi / size.n_bolts


def _lap(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Side:
    """A lap joint: a loose flange behind the collar of a stub end (ASME B16.9)."""
    r, size, plate = PIPES[dn].radius, FLANGES[dn], plate_thickness(dn)
    n, bore, lap = style.round(size.outer / 2), bore_of(dn, style), 0.004 + 0.02 * r
    long = float(rng.uniform(1.0, 2.5)) * r + 0.04
    stub = lathe([(r, 0.0), (r, long - lap), (size.raised / 2, long - lap), (size.raised / 2, long)], n, bore)
    hub = lathe([(0.48 * size.hub, long - lap - 1.5 * plate), (0.5 * size.hub, long - lap - 0.9 * plate)], n, 1.01 * r)
    loose = merge([flat_flange(dn, style, long - lap - plate, plate, 1.01 * r), hub])
    return [(stub, "flange"), (loose, "flange")], long, lap + plate, _drilling(dn)


def _screwed(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Side:
    """A threaded flange (ASME B16.5): a short hub, round, with a band, or octagonal, on the bare pipe."""
    r, size, plate = PIPES[dn].radius, FLANGES[dn], plate_thickness(dn)
    n, bore, long = style.round(size.outer / 2), bore_of(dn, style), size.slip
    high = max(long, plate + 0.008)
    kind = int(rng.integers(3))
    if kind == 0:
        hub = prism(2.5 * r + 0.008, 8, 0.0, high - plate, bore, n)
    elif kind == 1:
        hub = lathe([(0.45 * size.hub, 0.0), (0.5 * size.hub, high - plate)], n, bore)
    else:
        mid = 0.45 * (high - plate)
        hub = lathe([(1.35 * r, 0.0), (1.35 * r, mid), (1.2 * r, mid), (1.2 * r, high - plate)], n, bore)
    return [(merge([flat_flange(dn, style, high - plate, plate, bore), hub]), "flange")], high, plate, _drilling(dn)


def _long_neck(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Side:
    """A long welding neck, as on nozzles: a thick straight barrel to the flange."""
    r, size, plate = PIPES[dn].radius, FLANGES[dn], plate_thickness(dn)
    n, bore, long = style.round(size.outer / 2), bore_of(dn, style), float(rng.uniform(0.15, 0.35))
    barrel = 0.48 * size.hub
    neck = lathe([(r, 0.0), (r, 0.01), (barrel, 0.02 + 0.3 * r), (barrel, long - plate)], n, bore)
    return [(merge([flat_flange(dn, style, long - plate, plate, bore), neck]), "flange")], long, plate, _drilling(dn)


def _high(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Side:
    """A ring joint flange of a high class (ASME B16.5, 600 to 1500): thick, with a stout hub and more, larger bolts."""
    r = PIPES[dn].radius
    thick, outer = float(rng.uniform(0.35, 0.6)) * r + 0.02, float(rng.uniform(2.2, 2.7)) * r + 0.045
    n, bore = style.round(outer), bore_of(dn, style)
    count = 4 if dn <= 50 else 8 if dn <= 150 else 12
    bolt = 0.011 + 0.09 * r
    ring_ = outer - 1.35 * bolt - 0.004
    turns = (2 * np.arange(count) + 1) * np.pi / count
    spots = ring_ * np.column_stack([np.cos(turns), np.sin(turns)])
    hub = 0.9 * r + 0.02
    long = thick + hub + 0.006
    neck = lathe([(r, 0.0), (r, 0.1 * hub), (1.5 * r + 0.004, hub)], n, bore)
    plate = drilled(circle(outer, n), hub, hub + thick, bore, spots, 0.56 * bolt, style, n)
    face = lathe([(1.75 * r + 0.01, hub + thick), (1.75 * r + 0.01, long)], n, bore)
    return [(merge([neck, plate, face]), "flange")], long, thick + 0.006, (count, ring_, bolt, np.pi / count)


def _square(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Side:
    """A square hydraulic flange with four socket bolts (ISO 6164)."""
    r, thick = PIPES[dn].radius, 0.6 * PIPES[dn].radius + 0.012
    half = 1.55 * r + 0.014
    n, bore = style.round(1.3 * r), bore_of(dn, style)
    spots = 0.72 * half * np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]], float)
    outline = rounded_rectangle(2 * half, 2 * half, pick(rng, 0.0, 0.2, 0.35) * half, 3)
    bolt = 0.16 * half + 0.003
    lead = 0.3 * r + 0.004
    neck = lathe([(1.02 * r, 0.0), (1.2 * r, lead)], n, bore)
    plate = drilled(outline, lead, lead + thick, bore, spots, 0.55 * bolt, style, n)
    return [(merge([neck, plate]), "flange")], lead + thick, thick, (4, 0.72 * 1.4142 * half, bolt, np.pi / 4)


def _oval(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Side:
    """An oval flange with two bolts, as on small pumps and meters (DIN 2560 practice)."""
    r, thick = PIPES[dn].radius, 0.35 * PIPES[dn].radius + 0.009
    bolt = 0.1 * r + 0.008
    reach, n, bore = 1.85 * r + 1.6 * bolt + 0.004, style.round(1.4 * r), bore_of(dn, style)
    ear, body = 1.35 * bolt, 1.32 * r + 0.004
    angles = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    along_, across = reach + ear, body
    outline = np.column_stack([along_ * np.cos(angles), across * np.sin(angles)])
    spots = np.array([[reach - 0.4 * ear, 0.0], [0.4 * ear - reach, 0.0]])
    lead = 0.7 * r + 0.008
    neck = lathe([(1.25 * r + 0.002, 0.0), (1.25 * r + 0.002, lead)], n, bore)
    plate = drilled(outline, lead, lead + thick, bore, spots, 0.5 * bolt, style, n)
    return [(merge([neck, plate]), "flange")], lead + thick, thick, (2, reach - 0.4 * ear, bolt, 0.0)


def _backing(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Side:
    """A plastic stub with a collar and a loose backing ring (EN ISO 15494), flat, with a bead, or ribbed."""
    r, size, plate = PIPES[dn].radius, FLANGES[dn], plate_thickness(dn)
    n, bore, collar = style.round(size.outer / 2), bore_of(dn, style), 0.2 * r + 0.006
    long = float(rng.uniform(1.2, 2.2)) * r + 0.04
    wide = min(1.45 * r + 0.003, 0.98 * size.raised / 2)
    stub = lathe([(1.12 * r, 0.0), (1.12 * r, long - 2 * collar), (wide, long - collar), (wide, long)], n, bore)
    low = long - collar - plate
    pieces = [flat_flange(dn, style, low, plate, 1.14 * r)]
    kind = int(rng.integers(3))
    if kind == 1:
        pieces.append(lathe([(0.7 * size.hub, low - 0.006), (0.7 * size.hub, low + 0.001)], n, 1.2 * r))
    if kind == 2:
        rib = box((0.012, 0.32 * (size.outer - 2.3 * r), 0.005), (low - 0.004, 0.29 * size.outer + 0.33 * r, 0))
        pieces += [moved(rib, spun("x", 2 * np.pi * k / size.n_bolts)) for k in range(size.n_bolts)]
    return [(stub, "pipe"), (merge(pieces), "flange")], long, collar + plate, _drilling(dn)


def _standard(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Side:
    """A flange as the style makes them."""
    long = flange_length(dn, style)
    parts = parts_of(flange(dn, style), at(long) @ spun("z", np.pi))
    return [(p.solid, p.name) for p in parts], long, plate_thickness(dn), _drilling(dn)


def _plate(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Side:
    """A flat plate flange (EN 1092-1 type 01)."""
    thick, bore = plate_thickness(dn), bore_of(dn, style)
    return [(flat_flange(dn, style, 0.0, thick, bore), "flange")], thick, thick, _drilling(dn)


# --- gaskets: pieces from x = 0, their names, and how thick they are ---


def _spiral(dn: int, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float]:
    """A spiral wound gasket with a centring ring (ASME B16.20): a thin ring out to the bolts, a thicker winding."""
    r, size = PIPES[dn].radius, FLANGES[dn]
    outer, n = (size.circle - size.bolt) / 2 - 0.0008, style.round(size.circle / 2)
    low, high = 1.05 * r, min(1.05 * r + 0.35 * (outer - r), 0.49 * size.raised)
    if rng.random() < 0.5:
        ring_ = lathe([(outer, 0.0009), (outer, 0.0036)], n, high)
        return [Part(merge([ring_, lathe([(high, 0.0), (high, 0.0045)], n, low)]), "gasket", "gasket")], 0.0045
    guide = Part(lathe([(outer, 0.0009), (outer, 0.0036)], n, high), "gasket", "safety", "gasket")
    return [guide, Part(lathe([(high, 0.0), (high, 0.0045)], n, low), "gasket", "gasket", "gasket")], 0.0045


def _full(dn: int, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float]:
    """A full-face gasket (ASME B16.21): as wide as the flange, with its bolt holes."""
    thick = pick(rng, 0.0016, 0.003, 0.005)
    return [Part(flat_flange(dn, style, 0.0, thick, PIPES[dn].radius), "gasket", "rubber")], thick


def _ringed(dn: int, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float]:
    """An octagonal or oval ring (ASME B16.20) that keeps two flanges apart."""
    r, n = PIPES[dn].radius, style.round(1.5 * PIPES[dn].radius)
    gap, wide, mid = 0.004, 0.008 + 0.03 * r, 1.4 * r + 0.005
    low, high = -0.35 * wide, gap + 0.35 * wide
    a, b = mid + 0.25 * wide, mid + 0.5 * wide
    shape = [(a, low), (b, low + 0.25 * wide), (b, high - 0.25 * wide), (a, high)]
    return [Part(lathe(shape, n, mid - 0.4 * wide), "gasket", "trim")], gap


def _tabbed(dn: int, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float]:
    """A cut ring with a tab to pull it out by, or a thick spacer ring."""
    r, size, n = PIPES[dn].radius, FLANGES[dn], style.round(FLANGES[dn].raised / 2)
    thick = pick(rng, 0.002, 0.003, 0.006, 0.012)
    outer = (size.circle - size.bolt) / 2 - 0.0008
    tab = box(
        (thick, 0.55 * size.outer - 0.9 * outer, 0.02 + 0.2 * r), (0.5 * thick, 0.275 * size.outer + 0.45 * outer, 0)
    )
    tab = moved(tab, spun("x", float(rng.uniform(0, 6))))
    return [Part(merge([lathe([(outer, 0.0), (outer, thick)], n, r), tab]), "gasket", "gasket")], thick


def _flat(dn: int, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float]:
    """A plain ring out to the raised face, none where the style has none."""
    if not style.gaskets:
        return [], 0.0
    r = PIPES[dn].radius
    return [
        Part(lathe([(1.4 * r + 0.002, 0.0), (1.4 * r + 0.002, 0.002)], style.round(1.4 * r), r), "gasket", "gasket")
    ], 0.002


def _pair(
    side: SideMaker,
    seal: Callable[[int, ModelingStyle, np.random.Generator], tuple[list[Part], float]] = _flat,
    taps: bool = False,
) -> Build:
    """A builder of two like flanges between two pieces of pipe."""

    def build(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
        """Two flanges of a make with a gasket and bolts between two pieces of pipe."""
        solids, long, plate, (count, radius, thread, start) = side(dn, style, rng)
        seals, gap = seal(dn, style, rng)
        lead = float(rng.uniform(0.02, 0.15))
        total = 2 * (lead + long) + gap
        parts = [Part(pipe_x(dn, 0.0, lead, style), "pipe", "pipe")]
        flip = at(total) @ np.diag([-1.0, 1.0, 1.0, 1.0])
        for pose in (at(), flip):
            parts += [Part(moved(s, pose @ at(lead)), name, name) for s, name in solids]
        parts += [Part(moved(p.solid, at(lead + long)), p.name, p.color, p.bundle) for p in seals]
        face = lead + long
        parts += bolting(count, radius, thread, face - plate, face + gap + plate, style, "", at(), start)
        parts.append(Part(pipe_x(dn, total - lead, total, style), "pipe", "pipe"))
        if taps:
            parts += _tappings(dn, style, rng, (face - 0.5 * plate, face + gap + 0.5 * plate))
        return Model(parts, round(total, 9), "welded")

    return build


def _tappings(dn: int, style: ModelingStyle, rng: np.random.Generator, places: tuple[float, float]) -> list[Part]:
    """Tappings in the rims of orifice flanges (ASME B16.36): nipples or plugs, and the orifice plate's handle."""
    rim = FLANGES[dn].outer / 2
    parts: list[Part] = []
    turn = spun("x", pick(rng, 0.0, 0.5, 1.0) * np.pi)
    for k, x in enumerate(places):
        # The two tappings stand aside of each other, or their nipples would touch.
        way = turn @ at(x) @ spun("x", -0.35 if k else 0.35) @ at(0, 0, 0.985 * rim) @ _UP
        if rng.random() < 0.35:
            parts.append(Part(moved(prism(0.022, 6, 0.0, 0.014), way), "pipe cap", "trim"))
        else:
            long = float(rng.uniform(0.05, 0.15))
            parts.append(Part(moved(lathe([(0.0107, 0.0), (0.0107, long)], 12), way), "nipple", "pipe"))
            parts.append(Part(moved(prism(0.027, 6, long, long + 0.03), way), "coupling", "trim"))
    return parts


def _anchor(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An anchor or puddle flange: a plain disc round the pipe in or at a wall or block of concrete, with gussets."""
    r, n = PIPES[dn].radius, style.round(1.6 * PIPES[dn].radius)
    thick, outer = 0.006 + 0.08 * r, float(rng.uniform(1.5, 2.0)) * r + 0.03
    deep = float(rng.uniform(0.15, 0.35))
    lead = float(rng.uniform(0.08, 0.3))
    length = 2 * lead + deep
    disc = [lathe([(outer, lead - thick), (outer, lead)], n, r)]
    if rng.random() < 0.6:
        rib = box((min(0.8 * r, 0.8 * (lead - thick)), 0.8 * (outer - r), 0.006), (0, 0, 0))
        size = min(0.8 * r, 0.8 * (lead - thick))
        rib = moved(rib, at(lead - thick - 0.5 * size, r + 0.39 * (outer - r)))
        disc += [moved(rib, spun("x", k * np.pi / 2)) for k in range(4)]
    half = outer + float(rng.uniform(0.05, 0.3))
    spots = np.zeros((0, 2))
    wall = drilled(rounded_rectangle(2 * half, 2 * half, 0.0), lead, lead + deep, r, spots, 0.0, style, n)
    block = "foundation" if half < 0.3 else "wall"
    parts = [Part(pipe_x(dn, 0.0, length, style), "pipe", "pipe"), Part(merge(disc), "flange", "flange")]
    return Model([*parts, Part(wall, block, "concrete", "", STEEL)], round(length, 9), "welded")


# --- lids on a flanged end: face at 0, towards +x ---


def _lid(dn: int, style: ModelingStyle) -> Solid:
    return flat_flange(dn, style, 0.0, plate_thickness(dn), 0.0)


def _handled(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A blind flange with one or two bent handles, or a hand hole cover's bar."""
    size, plate = FLANGES[dn], plate_thickness(dn)
    reach, tall = 0.2 * size.circle, 0.04 + 0.06 * size.outer
    pieces = []
    for y in (-0.5 * reach, 0.5 * reach) if rng.random() < 0.5 else (0.0,):
        path = [
            [plate - 0.001, y, -reach],
            [plate + tall, y, -reach],
            [plate + tall, y, reach],
            [plate - 0.001, y, reach],
        ]
        pieces.append(rope(path, 0.005 + 0.01 * size.outer, 8))
    return Model(
        [
            Part(_lid(dn, style), "blind flange", "flange", "blind flange"),
            Part(merge(pieces), "blind flange", "handle", "blind flange"),
        ]
    )


def _davit(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A blind flange on a davit: a bent arm in a sleeve at the fixed flange, a screw eye on the lid."""
    size, plate = FLANGES[dn], plate_thickness(dn)
    rim, bar = size.outer / 2, 0.008 + 0.03 * size.outer
    sleeve = cylinder(1.6 * bar, -0.3 * rim, 0.3 * rim, 12)
    x, y = -0.5 * plate, rim + 1.4 * bar
    top = rim + 0.08 + float(rng.uniform(0.0, 0.3)) * rim
    out = 1.4 * plate + 0.02
    path = [[x, y, -0.4 * rim], [x, y, 0.85 * top], [0.5 * (x + out), 0.5 * y, top], [out, 0.0, top]]
    arm = rope(path, bar, 10)
    eye = merge(
        [
            rod((out, 0, 0.4 * rim), (out, 0, top + 1.5 * bar), 0.4 * bar, 8),
            prism(0.12 * rim + 0.012, 6, plate, out + 0.005),
        ]
    )
    lug = box((out - plate + 0.012, 0.1 * rim + 0.01, 0.2 * rim), (0.5 * (out + plate), 0, 0.35 * rim))
    return Model(
        [
            Part(merge([_lid(dn, style), lug]), "blind flange", "flange", "blind flange"),
            Part(moved(sleeve, at(x, y)), "bracket", "steel", "", BOLTED),
            Part(arm, "bracket", "steel", "", BOLTED),
            Part(eye, "bolt", "fastener", "", BOLTED, True),
        ]
    )


def _hinged(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A blind flange on a hinge: two ears at the fixed flange, a strap over the lid and a pin."""
    size, plate = FLANGES[dn], plate_thickness(dn)
    rim = size.outer / 2
    wide, thick = 0.35 * rim, 0.006 + 0.02 * rim
    y = rim + 0.015 + 0.06 * rim
    strap = box((thick, y + 0.5 * rim, wide), (plate + 0.5 * thick, 0.5 * y - 0.25 * rim, 0))
    ears = [
        box((2.6 * plate + 0.02, 0.03 + 0.12 * rim, thick), (-0.1 * plate, y, s * (0.5 * wide + 0.6 * thick)))
        for s in (-1, 1)
    ]
    legs = box((0.9 * plate, y - rim + 0.001, wide + 2.2 * thick), (-0.55 * plate - 0.002, 0.5 * (rim + y), 0))
    pin = moved(cylinder(0.006 + 0.02 * rim, -0.75 * wide, 0.75 * wide, 10), at(0.8 * plate + 0.004, y))
    return Model(
        [
            Part(merge([_lid(dn, style), strap]), "blind flange", "flange", "blind flange"),
            Part(merge([*ears, legs]), "bracket", "steel", "", BOLTED),
            Part(pin, "bolt", "fastener", "", BOLTED),
        ]
    )


def _tapped(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A blind flange with one to three tappings: bosses or half couplings with nipples, plugs or small lines."""
    size, plate = FLANGES[dn], plate_thickness(dn)
    some = [s for s in SIZES if PIPES[s].outer < 0.3 * size.circle] or [15]
    count = int(rng.integers(1, 4)) if dn >= 100 else 1
    parts = [Part(_lid(dn, style), "blind flange", "flange")]
    for k in range(count):
        small = int(rng.choice(some[: 3 if count > 1 else 6]))
        q = PIPES[small].radius
        place = at(plate) @ spun("x", 2 * np.pi * k / count) @ at(0, 0.0 if count == 1 else 0.22 * size.circle)
        boss = 1.1 * q + 0.012
        parts.append(
            Part(moved(lathe([(1.3 * q + 0.002, 0.0), (1.3 * q + 0.002, boss)], 16), place), "branch outlet", "pipe")
        )
        if rng.random() < 0.4:
            parts.append(
                Part(moved(prism(1.9 * q + 0.002, 6, boss, boss + 0.5 * q + 0.006), place), "pipe cap", "trim")
            )
        else:
            parts += tail(small, style, rng, place @ at(boss), "oc" if count > 1 else "ocf")
    return Model(parts)


def _ribbed(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cast blind flange with ribs, a dished middle, or a boss with jack screws."""
    size, plate = FLANGES[dn], plate_thickness(dn)
    rim, n = 0.4 * size.circle, style.round(size.outer / 2)
    pieces = [_lid(dn, style)]
    kind = int(rng.integers(3))
    if kind == 0:
        count = int(rng.choice([2, 3, 4]))
        rib = box((0.12 * rim + 0.01, 1.7 * rim, 0.006 + 0.04 * rim), (plate + 0.06 * rim, 0, 0))
        pieces += [moved(rib, spun("x", np.pi * k / count)) for k in range(count)]
    elif kind == 1:
        a = np.linspace(0.1, 0.5 * np.pi - 0.15, 5)
        pieces.append(
            lathe([(float(0.8 * rim * np.cos(t)), float(plate + 0.4 * rim * np.sin(t)) - 0.05 * rim) for t in a], n)
        )
    else:
        pieces.append(lathe([(0.6 * rim, plate), (0.55 * rim, 1.5 * plate)], n))
        for s in (-1, 1):
            pieces.append(moved(prism(0.1 * rim + 0.008, 6, 1.4 * plate, 2.0 * plate), at(0, s * 0.35 * rim)))
    if rng.random() < 0.4:
        ring_ = moved(
            torus(0.14 * rim + 0.012, 0.03 * rim + 0.003, 14, 8), at(1.9 * plate + 0.14 * rim, 0) @ spun("x", np.pi / 2)
        )
        pieces += [ring_, lathe([(0.08 * rim, plate), (0.08 * rim, 1.9 * plate + 0.02)], 10)]
    return Model([Part(merge(pieces), "blind flange", "flange", "blind flange")])


def _paddle(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A paddle blank or spacer (ASME B16.48) between two flanges: a disc with a long bar, drilled or with a ring."""
    size, pipe = FLANGES[dn], PIPES[dn]
    outer, thick, n = 0.49 * (size.circle - size.bolt), 0.005 + 0.1 * pipe.radius, style.round(size.circle / 2)
    spacer = bool(rng.random() < 0.4)
    reach, wide = size.outer / 2 + float(rng.uniform(0.03, 0.12)), 0.02 + 0.25 * pipe.radius
    solid = [lathe([(outer, 0.0), (outer, thick)], n, pipe.bore if spacer else 0.0)]
    kind = int(rng.integers(3))
    solid.append(box((thick, reach - 0.93 * outer, wide), (0.5 * thick, 0.5 * (reach + 0.93 * outer), 0)))
    if kind == 1:
        solid.append(moved(lathe([(0.9 * wide, 0.0), (0.9 * wide, thick)], 16, 0.4 * wide), at(0, reach + 0.7 * wide)))
    if kind == 2:
        solid.append(box((thick, 0.04, 1.8 * wide), (0.5 * thick, reach, 0)))
    turn: Floats = spun("x", pick(rng, 0.5, 0.25, 0.0) * np.pi)
    return Model([Part(moved(merge(solid), turn), "blind flange", "flange")], round(thick, 9), "wafer")


_MIDDLE = tuple(dn for dn in SIZES if dn <= 100)

FLANGINGS: tuple[Family, ...] = (
    family("flange/lap joint", _pair(_lap)),
    family("flange/threaded", _pair(_screwed), _MIDDLE),
    family("flange/long neck", _pair(_long_neck)),
    family("flange/orifice", _pair(_standard, _flat, True), SIZES[4:]),
    family("flange/high pressure", _pair(_high, _ringed)),
    family("flange/square", _pair(_square), _MIDDLE),
    family("flange/oval", _pair(_oval), _MIDDLE),
    family("flange/backing ring", _pair(_backing)),
    family("flange/anchor", _anchor),
    family("gasket/spiral wound", _pair(_standard, _spiral)),
    family("gasket/full face", _pair(_plate, _full)),
    family("gasket/ring joint", _pair(_long_neck, _ringed)),
    family("gasket/tabbed", _pair(_standard, _tabbed)),
    family("blind flange/paddle", _paddle, weight=0.4),
    family("blind flange/handle", _handled, SIZES[4:], "head", 1.0),
    family("blind flange/davit", _davit, SIZES[7:], "head", 1.0),
    family("blind flange/hinged", _hinged, SIZES[5:], "head", 1.0),
    family("blind flange/tapped", _tapped, SIZES[2:], "head", 1.0),
    family("blind flange/ribbed", _ribbed, SIZES[2:], "head", 1.0),
)
