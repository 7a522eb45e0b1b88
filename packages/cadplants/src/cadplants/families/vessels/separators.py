"""Further separators: knock-out drums, plate packs, air and dirt separators, oil boxes, centrifuges, hydrocyclones."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import made
from cadplants.builder.params import among, between, chance, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.valves.valve import bolt_circle, flanged_body
from cadplants.families.vessels.exchangers import Equipment, equipment_mouth, feet_of, frame_of
from cadplants.families.vessels.vessel_fittings import (
    MANWAYS,
    Drum,
    Manway,
    handle,
    head,
    head_height,
    mouth,
    renamed,
    sides,
)
from cadplants.families.vessels.vesselfeet import FEET, SADDLES, Feet, Saddle
from cadplants.model.family import Model, Port
from cadplants.model.standards import FLANGES, sizes_between
from cadplants.parts.flange import nut_room, plate_thickness
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import (
    BOTH,
    along,
    around,
    box,
    cylinder,
    dome,
    hexagon,
    lofted,
    ring,
    rod,
    rope,
    turned,
)
from cadplants.solids.transforms import at, spun

__all__ = ["SEPARATORS"]

_NAME = "separator"


def _sizes(some: tuple[int, ...], most: float) -> list[int]:
    """Those nominal sizes whose flanges are not as large as this [m]."""
    return [dn for dn in some if FLANGES[dn].outer < most] or [25]


class _Separator(Equipment, label=_NAME, bundle=_NAME, weight=1.0):
    """A separator on the floor."""


class KnockOut(_Separator, name="separator/knock-out drum"):
    """A vertical knock-out drum: a girth flange at its demister, a side inlet, gas out on top, liquid out below."""

    radius: float = between(0.18, 0.55, "of the shell", "m")
    slender: float = between(2.6, 5.0, "height of the shell / its radius")
    seam: float = between(0.65, 0.85, "height of the girth flange over the shell's lower rim / of the shell")
    feet: str = among(("chairs", "open", "angle", "beam"), "what it stands on")
    stand: Feet = nested(
        lambda _, p: FEET[p.feet],
        "what it stands on",
        fixed=lambda p: {"clear": head_height("2:1", p.radius) + 0.35 + 0.3 * p.radius},
    )
    size: int = among(lambda p: _sizes((40, 50, 80, 100, 150), 0.9 * p.radius), "nominal size of its mouths", "mm")
    handhole: Manway = nested(MANWAYS["oval"], "handhole", when=lambda p: p.radius > 0.3)

    def build(self, t: Table) -> Model:
        r, n, deep = self.radius, sides(t.style, self.radius), head_height("2:1", self.radius)
        low, height = deep + 0.35 + 0.3 * r, r * self.slender
        drum, cap = Drum(r, low, low + height, n), head("2:1", r, t.style, n)
        heads = moved(cap, at(0, 0, drum.high)), moved(cap, at(0, 0, low) @ spun("x", np.pi))
        t.add(_NAME, drum.solid(t.style), *heads, of="tank")
        girth, thick, wide = t.at(0, 0, low + height * self.seam), 0.02 + 0.03 * r, 1.14 * r + 0.03
        rims = ring(0.98 * r, wide, -thick, 0, n), ring(0.98 * r, wide, 0.003, thick, n)
        girth.add(_NAME, *rims, of="flange")
        count = int(np.clip(45 * r, 12, 28))
        girth.add("bolt", bolt_circle(count, 0.5 * (r + wide) + 0.003, 0.014, -thick, thick))
        t.extend(feet_of(self.stand.parts(drum, t.style), _NAME))
        ports: list[Port] = []
        spots = [(drum.side(0.4, low + 0.45 * height), r), (at(0, 0, drum.high + deep), 0.0)]
        for pose, curve in (*spots, (drum.side(2.4, low + 0.12 * height), r)):
            ports += equipment_mouth(t, self.size, pose, curve, drum.dip + 0.02 * r)
        if r > 0.3:
            hole = renamed(self.handhole.parts(t.style, 0.12, r, drum.dip), _NAME)
            t.moved(drum.side(4.6, low + 0.3 * height)).extend(hole)
        return t.model(kind="knock-out drum", ports=ports)


class ThreePhase(_Separator, name="separator/three-phase"):
    """A lying separator: dished ends, an inlet at one end, a gas dome, a water boot below, two saddles."""

    radius: float = between(0.25, 0.7, "of the shell", "m")
    slender: float = between(3.4, 5.5, "length of the shell / its radius")
    deep: float = between(0.7, 1.1, "depth of the boot / radius of the shell")
    domed: bool = chance(0.6, "a gas dome")
    saddles: tuple[Saddle, ...] = several(made(SADDLES["ribbed"]), 2, "saddles")
    size: int = among(lambda p: _sizes((40, 50, 80, 100), 0.8 * p.radius), "nominal size of its mouths", "mm")

    def build(self, t: Table) -> Model:
        r, n, length, deep = (
            self.radius,
            sides(t.style, self.radius),
            self.radius * self.slender,
            self.radius * self.deep,
        )
        boot, axis, cap, apex = 0.4 * r, r + deep + 0.25, head("2:1", r, t.style, n), head_height("2:1", r)
        middle, k = t.at(0, 0, axis), sides(t.style, 0.4 * r)
        heads = moved(cap, at(0, 0, length)), moved(cap, spun("x", np.pi))
        middle.at(-length / 2).along("x").add(_NAME, cylinder(r, 0.0, length, n), *heads, of="tank")
        pot = outline(0.3 * boot, -r - deep, boot, 0.4 * boot - r - deep, boot, -0.8 * r)
        middle.at(0.2 * length).add(_NAME, turned(pot, k), of="tank")
        crown = outline(0.45 * r, 0.8 * r, 0.45 * r, 1.4 * r, 0.3 * r, 1.55 * r)
        if self.domed:
            middle.at(0.25 * length).add(_NAME, turned(crown, k), of="tank")
        for x, saddle in zip((-0.3 * length, 0.38 * length), self.saddles, strict=True):
            t.at(x).extend(feet_of(saddle.parts(r, axis, t.style), _NAME))
        dip = r * (1 - np.cos(np.pi / n)) + 0.03 * r
        top = axis + (1.55 * r if self.domed else r)
        spots = at(-length / 2 - apex, 0, axis) @ spun("y", -np.pi / 2), at(0.25 * length, 0, top)
        ports: list[Port] = []
        for pose in (*spots, at(-0.3 * length, 0, axis + r)):
            ports += equipment_mouth(t, self.size, pose, 0.0, dip)
        drain = renamed(mouth("plain", 25, 0.13, t.style, 0.0, 0.02), _NAME)
        middle.at(0.2 * length, 0, -r - deep).along("-z").extend(drain)
        return t.model(kind="three-phase separator", ports=ports)


class Lamella(_Separator, name="separator/lamella"):
    """A lamella separator: a box over a hopper, an inclined pack of plates between its walls, weirs, braced legs."""

    width: float = between(1.2, 2.2, "of the box", "m")
    depth: float = between(0.7, 1.2, "of the box", "m")
    height: float = between(0.8, 1.4, "of the box", "m")
    low: float = between(0.35, 0.6, "from the floor to the hopper", "m")
    cone: float = between(0.4, 0.8, "height of the hopper", "m")
    tilt: float = between(0.5, 0.65, "of the plates from upright", "rad")
    step: float = between(0.05, 0.09, "from plate to plate", "m")
    size: int = among((65, 80, 100), "nominal size of its mouths", "mm")

    def build(self, t: Table) -> Model:
        w, d, h, low, sheet = self.width, self.depth, self.height, self.low, 0.008
        z = low + self.cone
        up, deep, middle = t.at(0, 0, z), d - 2 * sheet, h / 2
        walls = [box((w, sheet, h), (0, s * (d - sheet) / 2, middle)) for s in BOTH]
        walls += [box((sheet, deep, h), (s * (w - sheet) / 2, 0, middle)) for s in BOTH]
        walls += [box((w + 0.1, 0.05, 0.05), (0, s * (d / 2 + 0.025), h - 0.025)) for s in BOTH]
        walls += [box((0.05, d, 0.05), (s * (w / 2 + 0.025), 0, h - 0.025)) for s in BOTH]
        up.add(_NAME, *walls, of="tank")
        square = np.array(outline(-0.5, -0.5, 0.5, -0.5, 0.5, 0.5, -0.5, 0.5))
        steps = (((0.2, 0.2), -self.cone), ((w, d), 0.0), ((w, d), 0.01))
        hopper = lofted([np.column_stack([square * size, np.full(4, level)]) for size, level in steps])
        up.add(_NAME, hopper, of="tank")
        plate = moved(box((0.006, deep, 0.75 * h)), spun("y", self.tilt))
        xs = np.arange(-0.2 * w, 0.24 * w, self.step)
        up.add(_NAME, *(moved(plate, at(x, 0, 0.45 * h)) for x in xs), of="dial")
        up.add(_NAME, box((sheet, deep, 0.6 * h), (0.38 * w, 0, 0.6 * h)), of="trim")
        t.add("column", frame_of(w + 0.1, d + 0.1, z + 0.3 * h, 0.08, rails=False))
        up.add("beam", *(box((w + 0.1, 0.06, 0.1), (0, s * (d / 2 + 0.03), 0.05)) for s in BOTH))
        ports: list[Port] = []
        for s, level in ((-1, 0.35), (1, 0.75)):
            ports += equipment_mouth(t, self.size, at(s * w / 2, 0, z + level * h) @ spun("y", s * np.pi / 2))
        sludge = renamed(mouth("plain", 80, min(0.25, 0.8 * low), t.style, 0.0, 0.01), _NAME)
        t.at(0, 0, low).along("-z").extend(sludge)
        return t.model(kind="lamella separator", ports=ports)


class OilBox(_Separator, name="separator/oil box"):
    """An oil-water box: a rectangular tank with chambers, lids with handles, a skimmer pipe, two mouths."""

    width: float = between(0.8, 2.0, "of the box", "m")
    depth: float = between(0.5, 1.0, "of the box", "m")
    height: float = between(0.5, 1.0, "of the box", "m")
    corner: float = between(0.005, 0.05, "radius of the box's corners", "m")
    chambers: int = whole(2, 4, "chambers")
    size: int = among((50, 80, 100), "nominal size of its mouths", "mm", when=lambda p: p.height > 0.6, otherwise=40)
    vented: bool = chance(0.5, "a vent pipe")

    def build(self, t: Table) -> Model:
        w, d, h, base, count = self.width, self.depth, self.height, 0.1, self.chambers
        top, pitch = base + h, w / count
        ribs = [box((0.03, d + 0.06, 0.8 * h), (k * pitch - w / 2, 0, base + 0.45 * h)) for k in range(1, count)]
        t.add(_NAME, extrude(rounded_rectangle(w, d, self.corner, 2), base, top), *ribs, of="tank")
        lid = box((0.96 * pitch, d + 0.04, 0.025), (0, 0, 0.0125)), handle(0, 0.06, 0.02, 0.06, 0.006, 6)
        for k in range(count):
            t.at((k + 0.5) * pitch - w / 2, 0, top).add(_NAME, *lid, of="dial")
        t.add("skid frame", *(box((w, 0.08, base), (0, s * 0.38 * d, base / 2)) for s in BOTH))
        ports: list[Port] = []
        for s, f in ((-1, 0.78), (1, 0.7)):
            ports += equipment_mouth(t, self.size, at(s * w / 2, 0, base + f * h) @ spun("y", s * np.pi / 2))
        x, y, z = 0.3 * w, -d / 2 - 0.1, base + 0.8 * h
        t.add("pipe", rope([(x, -d / 2 + 0.01, z), (x, y, z), (x, y, base)], 0.025, 12))
        if self.vented:
            t.add("pipe", rope([(-x, 0.2 * d, top), (-x, 0.2 * d, top + 0.4)], 0.025, 12))
        return t.model(kind="oil separator", ports=ports)


class DiscStack(_Separator, name="separator/disc stack"):
    """A disc-stack centrifuge: a bowl hood with clamps over a cast frame, a motor on its side, feed on top."""

    radius: float = between(0.2, 0.4, "of the frame", "m")
    clamps: int = among((3, 4, 6), "clamps round the hood")
    feet: int = among((3, 4), "feet")

    def build(self, t: Table) -> Model:
        r, n, low, k = self.radius, sides(t.style, self.radius), 0.08, 0.42 * self.radius
        mid, wide = low + 1.9 * r, 1.2 * r
        frame = outline(1.05 * r, low, 1.1 * r, low + 0.1, 0.95 * r, low + 0.5 * r, r, mid - 0.3 * r)
        frame += outline(wide, mid - 0.25 * r, wide, mid)
        hood = outline(1.1, 0.3, 0.7, 0.75, 0.3, 0.9, 0.3, 1.25, 0.18, 1.3)
        hood = [(wide, mid), (wide, mid + 0.04), *((x * r, mid + z * r) for x, z in hood)]
        t.add(_NAME, turned(frame, n), of="valve")
        t.add(_NAME, turned(hood, n), of="trim")
        claw = merge([box((0.06, 0.05, 0.1)), rod((0.02, 0, -0.05), (0.02, 0, 0.12), 0.01, 8)])
        t.at(0, 0, mid).add("clamp", around(claw, self.clamps, 1.22 * r, 0.5), of="steel", own=True)
        drive = t.at(0, 0, low + 0.95 * r).along("x")
        drive.add(_NAME, cylinder(1.25 * k, 0.85 * r, 1.12 * r, n), of="valve")
        fins = around(box((0.03 * r, 0.02 * r, 0.95 * r), (0, 0, 1.65 * r)), 16, k)
        drive.add("motor", cylinder(k, 1.1 * r, 2.2 * r, n), fins, own=True)
        cover = outline(1.08 * k, 2.15 * r, 1.08 * k, 2.5 * r, 0.8 * k, 2.55 * r)
        drive.add("motor fan cover", turned(cover, n), own=True)
        foot = merge([cylinder(0.05, 0, 0.03, 14), cylinder(0.02, 0.02, low + 0.06, 10)])
        t.add("tank leg", around(foot, self.feet, 0.9 * r, 0.8), of="rubber", own=True)
        x, bend = -0.8 * r, mid + 1.3 * r + 0.12
        feed = rope([(0, 0, bend - 0.15), (0, 0, bend), (x, 0, bend), (x, 0, bend + 0.18)], 0.024, 12)
        t.add(_NAME, feed, of="trim")
        for a in (2.2, -2.2):
            out = [(f * r * np.cos(a), f * r * np.sin(a), mid + 1.1 * r) for f in (0.2, 1.3)]
            t.add(_NAME, rope(out, 0.02, 10), of="trim")
        t.add(_NAME, box((0.35 * r, 0.5 * r, 0.45 * r), (-1.1 * r, 0.0, mid - 0.5 * r)), of="trim")
        return t.model(kind="centrifuge")


class Decanter(_Separator, name="separator/decanter", weight=0.8):
    """A decanter centrifuge: a long casing with a split flange over a base, bearings, belt guard, a motor alongside."""

    radius: float = between(0.16, 0.3, "of the casing", "m")
    length: float = between(1.4, 2.4, "of the casing", "m")

    def build(self, t: Table) -> Model:
        r, length, half, n, z = (
            self.radius,
            self.length,
            self.length / 2,
            sides(t.style, self.radius),
            0.35 + self.radius,
        )
        axis, side = t.at(0, 0, z), half + 0.25
        lower = box((length, 2 * r, r), (0, 0, -r / 2))
        axis.add(_NAME, lower, box((length + 0.04, 2 * r + 0.12, 0.03)), of="valve")
        axis.along("x").add(_NAME, cylinder(r, -half, half, n), of="trim")
        bearings = [box((0.16, 1.1 * r, 1.3 * r), (s * (half + 0.1), 0, -0.1 * r)) for s in BOTH]
        axis.add(_NAME, *bearings, of="valve")
        chute = (0.22, 0.9 * r, z - r - 0.02)
        t.add(_NAME, *(box(chute, (x, 0, (z - r) / 2 + 0.01)) for x in (-0.76 * half, 0.76 * half)), of="trim")
        guard, belt = (0.14, 0.6 * r, 2.2 * r), (0.14, 2.2 * r, 0.5 * r)
        guards = box(guard, (side, 0, -0.3 * r)), box(belt, (side, 0.9 * r, -0.6 * r))
        axis.add("coupling guard", *guards, own=True)
        motor = cylinder(0.55 * r, -half - 0.19, 0.3 - half, n)
        axis.at(0, 1.75 * r, -0.6 * r).along("-x").add("motor", motor, own=True)
        base = [box((length + 0.9, 0.14, 0.2), (0.1, s * 0.8 * r, 0.15)) for s in BOTH]
        base += [box((0.14, 1.6 * r, 0.2), (x, 0, 0.15)) for x in (-half, 0.0, half)]
        props = [(0.12, 1.5 * r, z - 0.75 * r)] * 2 + [(0.45, 0.9 * r, z - 1.15 * r)]
        spots = ((-half - 0.1, 0), (half + 0.1, 0), (half - 0.05, 1.5 * r))
        for (w, d, high), (x, y) in zip(props, spots, strict=True):
            base.append(box((w, d, high - 0.24), (x, y, (high + 0.24) / 2)))
        t.add("skid frame", *base)
        xs = (-half - 0.2, half + 0.3)
        pads = [box((0.16, 0.16, 0.05), (x, s * 0.8 * r, 0.025)) for x in xs for s in BOTH]
        t.add("base plate", *pads, of="rubber")
        axis.add(_NAME, rod((-half - 0.5, 0, 0), (-half - 0.1, 0, 0), 0.03, 12), of="pipe")
        return t.model(kind="decanter centrifuge")


class Hydrocyclones(_Separator, name="separator/hydrocyclones", weight=0.9):
    """Hydrocyclones or multicyclones: slim cones in a row over a trough, on a frame."""

    count: int = whole(2, 6, "cyclones")
    radius: float = between(0.05, 0.12, "of a cyclone", "m")
    slender: float = between(6, 10, "height of a cyclone / its radius")
    low: float = between(0.4, 0.7, "from the floor to the cyclones", "m")

    def build(self, t: Table) -> Model:
        r, n, low, tall = self.radius, sides(t.style, self.radius), self.low, self.radius * self.slender
        k, seam, over, inlet = max(8, min(12, n)), 0.75 * tall, tall + 0.16, 0.9 * tall
        cone = turned(outline(0.25 * r, 0, 0.3 * r, 0.06, r, seam, r, tall), n)
        caps = cylinder(1.3 * r, seam - 0.012, seam + 0.012, n), cylinder(1.25 * r, tall, tall + 0.03, n)
        pipes = rope([(0, 0, tall + 0.02), (0, 0, over), (0, 1.6 * r, over)], 0.4 * r, k)
        side = rope([(0.7 * r, 0, inlet), (0.7 * r, 3.0 * r, inlet)], 0.35 * r, k)
        pitch = 3.2 * r
        for x in (np.arange(self.count) - (self.count - 1) / 2) * pitch:
            t.at(x, 0, low).add(_NAME, cone, *caps, of="rubber")
            t.at(x, 0, low).add(_NAME, pipes, side, of="pipe")
        span, deep, up = (self.count - 1) * pitch + 4 * r, 8 * r, t.at(0, 0, low)
        for y, z in ((3.5 * r, inlet), (2.0 * r, over)):
            up.at(0, y, z).along("x").add(_NAME, cylinder(0.8 * r, -span / 2, span / 2, n), of="pipe")
        trough = [box((span, 0.006, 0.2), (0, s * 2 * r, -0.07)) for s in BOTH]
        trough.append(box((span, 4 * r, 0.006), (0, 0, -0.17)))
        up.add(_NAME, *trough, *(box((0.006, 4 * r, 0.2), (s * span / 2, 0, -0.07)) for s in BOTH), of="clamp")
        frame, shelf = frame_of(span + 0.12, deep, low + 0.8 * tall, 0.06, rails=False), low + 0.72 * tall
        bars = [box((span, 0.05, 0.05), (0, s * 1.1 * r, shelf)) for s in BOTH]
        levels = (shelf, low - 0.198)
        bars += [box((0.06, deep, 0.05), (s * (span / 2 + 0.03), 0, z)) for s in BOTH for z in levels]
        t.add("skid frame", frame, *bars, box((span, 4 * r, 0.05), (0, 0, low - 0.198)))
        return t.model(kind="hydrocyclone")


class _InLine(Equipment, place="inline", label=_NAME, bundle=_NAME):
    """A separator in a line."""

    def line(self, t: Table, r: float, spare: float, share: float) -> tuple[float, Solid]:
        """Its length, for a body of a half length and some room, and its flanged ends, with a neck between [m]."""
        length = round(2 * (r + plate_thickness(self.dn) + nut_room(self.dn) + spare), 6)
        neck = 0.485 * FLANGES[self.dn].hub
        body = flanged_body(self.dn, t.style, length, [(neck, share * length), (neck, (1 - share) * length)])
        return length, body


class AirPot(_InLine, name="separator/air pot", sizes=sizes_between(32, 200)):
    """An air and dirt separator in a line: a pot offset up or down from it with a vent valve, a drain cock, a split."""

    wall: float = between(0.02, 0.05, "radius of the pot, but for 1.8 of the pipe's", "m")
    up: float = between(1.0, 3.0, "height of the pot over the line's axis / its radius")
    down: float = between(0.9, 3.5, "depth of the pot under the line's axis / its radius")
    split: bool = chance(0.5, "a flanged joint in the pot")

    def build(self, t: Table) -> Model:
        r = 1.8 * t.pipe.radius + self.wall
        n, up, down, wide = t.n(r), self.up * r, self.down * r, 1.25 * r + 0.01
        length, body = self.line(t, r, 0.02, 0.25)
        pot = outline(0.5 * r, -down - 0.35 * r, 0.85 * r, -down - 0.2 * r, r, -down)
        pot += outline(r, up, 0.85 * r, up + 0.2 * r, 0.3 * r, up + 0.35 * r)
        middle, seam = at(length / 2), -0.5 * down - 0.3 * r
        rims = [cylinder(wide, seam - 0.016, seam, n), cylinder(wide, seam + 0.002, seam + 0.018, n)]
        t.add(_NAME, body, *(moved(one, middle) for one in (turned(pot, n), *(rims if self.split else ()))), of="tank")
        t = t.moved(middle)
        top, low = up + 0.35 * r, -down - 0.35 * r
        vent = [hexagon(0.034, top - 0.01, top + 0.02), cylinder(0.026, top + 0.015, top + 0.09, 14)]
        vent.append(dome(0.026, 0.015, top + 0.089, 14))
        t.add("valve", *vent, rod((0.02, 0, top + 0.07), (0.045, 0, top + 0.075), 0.006, 8))
        cock = [cylinder(0.012, low - 0.07, low + 0.01, 10), hexagon(0.028, low - 0.05, low - 0.02)]
        t.add("valve", *cock, box((0.012, 0.07, 0.006), (0.018, -0.02, low - 0.035)))
        if self.split:
            t.add("bolt", bolt_circle(8, 1.13 * r + 0.005, 0.012, seam - 0.016, seam + 0.018))
        return t.model(length, kind="air separator")


class SteamBaffle(_InLine, name="separator/steam baffle", sizes=sizes_between(25, 150)):
    """A steam or gas separator in a line: a barrel of one size more under it, with a flanged lid and drip leg."""

    deep: float = between(1.6, 3.2, "depth of the drip leg / radius of the barrel")

    def build(self, t: Table) -> Model:
        r, neck = 1.5 * t.pipe.radius + 0.02, 0.485 * t.flange.hub
        n, leg, deep, lid = t.n(r), 0.7 * r, self.deep * r, 1.25 * r
        length, body = self.line(t, 1.6 * r, 0.02, 0.2)
        middle, end = at(length / 2), -deep - 0.25 * leg
        barrel = along("x", turned(outline(neck, -1.6 * r, r, -1.1 * r, r, 1.1 * r, neck, 1.6 * r), n))
        pot = turned(outline(0.4 * leg, end, leg, -deep, leg, -0.5 * r), n)
        t.add(_NAME, body, moved(barrel, middle), moved(pot, middle), of="valve")
        t = t.moved(middle)
        t.add(_NAME, cylinder(0.75 * r, 0.3 * r, lid, n), cylinder(0.95 * r, lid, lid + 0.03, n), of="valve")
        t.add("bolt", bolt_circle(6, 0.85 * r, 0.01, lid, lid + 0.03))
        t.add(_NAME, cylinder(0.0134, end - 0.08, -deep - 0.2 * leg, 10), of="trim")
        return t.model(length, kind="steam separator")


SEPARATORS = families_of(KnockOut, ThreePhase, Lamella, OilBox, DiscStack, Decanter, Hydrocyclones, AirPot, SteamBaffle)
