"""Brackets between machines and frames: hinges, corner angles, mounting feet, lanterns with windows."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, whole
from cadplants.builder.table import Table, outline
from cadplants.families.supports.shape import (
    Feet,
    Fitting,
    Footing,
    Section,
    add_bolt,
    few,
    foot_of,
    screwed,
    section_of,
    strap,
    upright,
)
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, extrude, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, CORNERS, around, bar, box, cylinder, ring, turned
from cadplants.solids.transforms import at, spun

__all__ = ["MOUNTS"]

_B = "bracket"
_QUARTER = spun("x", np.pi / 2)


class Hinge(Fitting, Feet, name="bracket/hinge", label=_B):
    """Hinge brackets on a post, column or wall: leaf and strap hinges with pins, a door or gate."""

    high: float = between(0.8, 1.9, "height of the gate's upper side", "m")
    wide: float = between(0.5, 1.0, "width of the gate", "m")
    pin: float = among((0.005, 0.008, 0.012), "radius of the pins", "m")
    count: int = whole(2, 3, "hinges")
    posted: bool = chance(0.7, "on a post, not on a wall")
    size: float = among((0.06, 0.08, 0.1), "width of the post", "m", when=lambda p: p.posted)
    foot: Footing = foot_of("foot of the post", when=lambda p: p.posted)
    section: Section = section_of("section of the post", flat=True, when=lambda p: p.posted)
    taken: str = among(("post", "column"), "what the post is taken for", when=lambda p: p.posted)
    tall: float = between(0.05, 0.12, "height of a hinge", "m")
    strap: float = among((0.06, 0.3), "usual length of a leaf", "m")
    factor: float = between(0.8, 1.3, "length of a leaf / the usual one")
    gate: str = among(("sheet", "frame", "bars"), "what hangs on the hinges")
    sheet: str = among(("gate", "plate"), "what a sheet is taken for", when=lambda p: p.gate == "sheet")

    def build(self, t: Table) -> Model:
        edge, high, size = 0.0, self.high, self.size
        if self.posted:
            section = self.section.outline(size, t.style)
            self.foot.build(t, size + 0.12, size)
            t.add(self.taken, extrude(section[0], self.foot.top, high + 0.15, section[1]))
            edge = float(section[0][:, 0].max())
        else:
            t.add("wall", box((0.5, 0.2, high + 0.3), (-0.25, 0, (high + 0.3) / 2)))
        for z in np.linspace(0.2, high - 0.15, self.count):
            self._hinge(t.at(edge), float(z))
        self._gate(t.at(edge + 0.005 + 3.8 * self.pin + 0.003))
        return t.model()

    def _hinge(self, t: Table, z: float) -> None:
        """A hinge with its middle at a height over the edge of the post [m]."""
        pin, thick, tall, reach = self.pin, 0.005, self.tall, self.strap * self.factor
        n, knuckle, third = few(pin, t.style), 1.9 * pin, self.tall / 3 - 0.001
        x, low = thick + knuckle, [z - tall / 2 + tall * q / 3 for q in range(4)]
        rings = [moved(ring(pin, knuckle, low[q], low[q + 1] - 0.001, max(8, n)), at(x)) for q in range(3)]
        middle = [(low[q] + low[q + 1] - 0.001) / 2 for q in range(3)]
        size, y = (knuckle + 0.002, 0.8 * knuckle, third), 0.4 * knuckle + pin * 0.3
        bridges = [box(size, (thick + knuckle * 0.3, y, middle[q])) for q in (0, 2)]
        base = box((thick, 0.05, 1.25 * tall), (thick / 2, 0, z))
        t.add(_B, base, rings[0], rings[2], *bridges)
        t.add(_B, rings[1], box((reach, thick, third), (x + 0.8 * knuckle + reach / 2, 0, middle[1])))
        pins = [cylinder(pin, low[0] - 0.004, low[3] + 0.002, n), cylinder(1.5 * pin, low[3], low[3] + 0.6 * pin, n)]
        t.at(x).add("bolt", *pins)
        for q in (0.4, 0.85):
            screwed(t, 0.006, thick, x + 0.8 * knuckle + q * reach, thick / 2, low[1] + tall / 6)

    def _gate(self, t: Table) -> None:
        """What hangs on the hinges, from x = 0."""
        wide, z0, z1, y = self.wide, 0.08, self.high, 0.0175
        tall, z = z1 - z0, (z0 + z1) / 2
        if self.gate == "sheet":
            t.add(self.sheet, box((wide, 0.03, tall), (wide / 2, y, z)), of="gate")
            return
        frame = [box((0.04, 0.03, tall), (q, y, z)) for q in (0.02, wide - 0.02)]
        frame += [box((wide - 0.08, 0.03, 0.04), (wide / 2, y, q)) for q in (z0 + 0.02, z1 - 0.02)]
        if self.gate == "bars":
            frame += [box((0.01, 0.01, tall - 0.08), (q, y, z)) for q in np.arange(0.12, wide - 0.06, 0.1)]
        t.add("gate", *frame)


class CornerAngles(Fitting, name="bracket/corner", label=_B):
    """A frame of square profiles with corner angles: cast with webs, bent plate, flat T and L plates, screwed on."""

    size: float = among((0.03, 0.04, 0.045, 0.06, 0.08), "width of a profile", "m")
    wide: float = between(0.4, 1.0, "width of the frame", "m")
    high: float = between(0.4, 1.2, "height of the frame", "m")
    footed: bool = chance(0.5, "plates under the posts")
    middle: float = between(0.25, 0.6, "height of the lower beam / of the frame")
    leg: float = between(0.9, 2.2, "length of an angle's leg / width of a profile")
    form: str = among(("cast", "bent", "triangle", "flat"), "how the angles are made")
    broad: float = between(0.6, 0.98, "width of an angle / of a profile", when=lambda p: p.form != "flat")

    def build(self, t: Table) -> Model:
        table, s, w, h, t = t, self.size, self.wide, self.high, t.at(0, 0, 0.008 if self.footed else 0.0)
        hole = (circle(0.2 * s, 8),) if t.style.holes else ()
        square = rounded_rectangle(s, s, 0.08 * s, 1)
        for x in (-w / 2, w / 2):
            t.at(x).add("post", extrude(square, 0, h, hole))
            if self.footed:
                t.add("base plate", box((2 * s, 2 * s, 0.008), (x, 0, -0.004)))
        levels = sorted({round(h - s / 2, 6), round(self.middle * h, 6)})
        for z in levels:
            t.add("beam", bar((-w / 2 + s / 2, 0, z), (w / 2 - s / 2, 0, z), square, hole))
        solids, screws = self._angle(), Table(t.style, t.group)
        self._screws(screws)
        for z in levels:
            for x in BOTH:
                under = z > 0.25 * h
                flip = np.diag([-float(x), 1.0, -1.0 if under else 1.0, 1.0])
                spot = t.at(x * (w / 2 - s / 2), 0, z + (-s / 2 if under else s / 2)).moved(flip)
                spot.add(_B, *solids, of="clamp")
                spot.extend(screws.parts)
        return table.model()

    def _angle(self) -> list[Solid]:
        """An angle in the corner between +x and +z."""
        s, leg, thick, wide = self.size, self.leg * self.size, 0.12 * self.size, self.broad * self.size
        if self.form == "flat":  # on the face of the joint
            near, far = -0.9 * s, -0.1 * s
            return [upright(outline(near, near, leg, near, leg, far, far, leg, near, leg), -s / 2 - thick, -s / 2)]
        if self.form == "triangle":
            return [upright(outline(0, 0, leg, 0, 0, leg), -wide / 2, wide / 2)]
        shape = outline(0, 0, leg, 0, leg, thick, thick, thick, thick, leg, 0, leg)
        web = outline(thick, thick, leg, thick, leg, 1.5 * thick, 1.5 * thick, leg, thick, leg)
        webs = [moved(upright(web, -0.08 * s, 0.08 * s), at(0, q * 0.42 * wide)) for q in BOTH]
        return [upright(shape, -wide / 2, wide / 2), *(webs if self.form == "cast" else ())]

    def _screws(self, t: Table) -> None:
        s, leg, thick, d = self.size, self.leg * self.size, 0.12 * self.size, 0.15 * self.size
        if self.form in ("cast", "bent"):
            add_bolt(t.at(0.6 * leg), d, thick, "socket", ("screw",))
            add_bolt(t.at(0, 0, 0.6 * leg).spun("y", np.pi / 2), d, thick, "socket", ("screw",))
        elif self.form == "flat":
            for x, z in ((0.65 * leg, -0.5 * s), (-0.5 * s, 0.65 * leg), (-0.5 * s, -0.5 * s)):
                add_bolt(t.at(x, -s / 2, z).moved(_QUARTER), d, thick, "none")


class MountingFeet(Fitting, name="bracket/mounting foot", label=_B):
    """Equipment on mounting feet: a vessel or a cabinet on angles, Z plates or rib feet."""

    size: float = between(0.2, 0.6, "width of the equipment", "m")
    high: float = between(0.3, 0.9, "height of the equipment", "m")
    clear: float = between(0.08, 0.4, "from the floor to the equipment", "m")
    thick: float = among((0.004, 0.006, 0.01), "of the feet", "m")
    wide: float = between(0.05, 0.1, "width of a foot", "m")
    out: float = between(0.04, 0.08, "how far a foot reaches out", "m")
    equipment: str = among(("cabinet", "vessel", "vessel"), "what stands on the feet")
    taken: str = among(("tank", "tank", "filter"), "what a vessel is taken for", when=lambda p: p.equipment == "vessel")
    count: int = whole(3, 4, "feet of a vessel", when=lambda p: p.equipment == "vessel")
    tall: float = between(0.1, 0.25, "height of a foot beside the equipment, over 80 mm / height of that")
    form: str = among(("angle", "ribbed", "Z"), "how the feet are made")
    slab: bool = chance(0.5, "on a slab")
    base: str = among(("foundation", "plate"), "what the slab is taken for", when=lambda p: p.slab)

    def build(self, t: Table) -> Model:
        table, size, high, clear, r = t, self.size, self.high, self.clear, self.size / 2
        t = t.at(0, 0, 0.1 if self.slab else 0.0)
        if self.equipment == "cabinet":
            t.add("control panel", box((size, size * 0.8, high), (0, 0, clear + high / 2)))
            spots = [t.at(x * r, y * 0.26 * size).spun("z", 0.0 if x > 0 else np.pi) for x, y in CORNERS]
        else:
            top = clear + high
            side = outline(0.3 * r, clear - 0.02, r, clear + 0.08, r, top, 0.4 * r, top + 0.4 * r)
            t.add(self.taken, turned(side, t.n(r)), of="tank")
            flat = r * float(np.cos(np.pi / t.n(r)))  # the feet reach the sides of a coarse vessel too
            spots = [t.spun("z", 2 * np.pi * k / self.count).at(flat) for k in range(self.count)]
        solids, far = self._foot()
        for spot in spots:
            spot.add(_B, *solids)
            for q in (0.0,) if self.form == "ribbed" else (-0.25, 0.25):
                add_bolt(spot.at(far, q * self.wide), 0.01, self.thick, "none")
        if self.slab:
            reach = 2 * (r + 2.2 * self.out) + 0.1
            t.add(self.base, box((reach, reach, 0.1), (0, 0, -0.05)), of="concrete")
        return table.model()

    def _foot(self) -> tuple[list[Solid], float]:
        """A foot from x = 0 outwards, and how far out its bolts are [m]."""
        thick, wide, out, high = self.thick, self.wide, self.out, self.clear + self.tall * self.high + 0.08
        if self.form == "Z":
            side = outline(-0.001, high, -0.001, high - 0.05, 0.7 * out, 0.35 * high, 0.7 * out, thick / 2)
            path = [(x + thick / 2, 0, z) for x, z in [*side, (1.7 * out, thick / 2)]]
            return [strap(path, wide, thick, (0.0, 1.0, 0.0))], 1.35 * out
        angle = [box((thick, wide, high), (thick / 2 - 0.001, 0, high / 2))]
        angle.append(box((out, wide, thick), (thick + out / 2 - 0.002, 0, thick / 2)))
        if self.form == "angle":  # its leg along the body, its toe on the floor
            return angle, thick + 0.6 * out
        rib = outline(thick - 0.001, thick, thick + 0.85 * out, thick, thick - 0.001, 0.7 * high)
        plate = upright(rib, -thick / 2, thick / 2)
        return [*angle, *(moved(plate, at(0, q * 0.42 * wide)) for q in BOTH)], thick + 0.55 * out


class Lantern(Fitting, name="bracket/lantern", label=_B):
    """A mount between two flanged things: a bent plate with windows, a U of plate, four spacer posts, a cast cone."""

    radius: float = between(0.04, 0.12, "of the flanges", "m")
    low: float = between(0.05, 0.2, "height of what is below", "m")
    gap: float = between(1.0, 2.2, "height of the mount / radius")
    form: str = among(("plate", "posts", "cast", "bell"), "how it is made")
    base: str = among(("foundation", "plate"), "what is below")
    ribs: int = among((2, 3, 4), "ribs of a cast one", when=lambda p: p.form == "cast", otherwise=0)
    drive: str = among(("motor", "actuator"), "what is above")

    def build(self, t: Table) -> Model:
        r, low = self.radius, self.low
        n, gap, thick, d, high = t.n(r), self.gap * r, 0.06 * r + 0.003, 0.12 * r + 0.002, low + self.gap * r
        t.add(self.base, box((3.2 * r, 3.2 * r, low), (0, 0, low / 2)), of="concrete")
        t.add("shaft", cylinder(0.3 * r, low - 0.001, low + gap, few(0.3 * r, t.style)))
        t.add(_B, *self._solids(n, low, high, thick))
        if self.form == "plate":
            angles = np.pi / 4 + np.arange(4) * np.pi / 2
            spots = [(0.78 * r * np.cos(b), 0.78 * r * np.sin(b)) for b in angles]
        else:
            spots = [(0.0, 0.85 * r), (0.0, -0.85 * r), (0.85 * r, 0.0), (-0.85 * r, 0.0)]
        for x, y in spots if self.form in ("plate", "posts") else ():
            add_bolt(t.at(0.8 * x, 0.8 * y, low), d, thick, "none")
        above = box((1.9 * r, 1.6 * r, 1.4 * r), (0, 0, high + 0.7 * r))
        if self.drive == "motor":
            above = turned(outline(1.05 * r, high, 1.05 * r, high + 1.6 * r, 0.6 * r, high + 1.9 * r), n)
        t.add(self.drive, above)
        return t.model()

    def _solids(self, n: int, low: float, high: float, thick: float) -> list[Solid]:
        r, hole, cast = self.radius, (circle(0.4 * self.radius, n),), 1.6 * thick
        if self.form == "plate":  # a U or a box of plate, open at its sides
            span, middle = 2 * r * 1.05, (low + high) / 2
            square = rounded_rectangle(span, span, 0)
            plates = [extrude(square, z, z + thick, hole) for z in (low, high - thick)]
            window = rounded_rectangle(0.6 * span, 0.5 * (high - low), 0.1 * r, 3) + np.array([0.0, middle])
            z0, z1, x, y = low + thick, high - thick, span / 2, span / 2 - thick / 2
            rim = outline(-x, z0, x, z0, x, z1, -x, z1)
            return [*plates, *(upright(rim, s * y - thick / 2, s * y + thick / 2, (window,)) for s in BOTH)]
        if self.form == "posts":
            plate = rounded_rectangle(2.1 * r, 2.1 * r, 0.2 * r, 3)
            post = cylinder(0.12 * r, low + thick, high - thick, 10)
            plates = [extrude(plate, z, z + thick, hole) for z in (low, high - thick)]
            return [*plates, *(moved(post, at(0.75 * r * x, 0.75 * r * y)) for x, y in CORNERS)]
        if self.form == "cast":  # flanges with ribs between
            discs = [extrude(circle(1.1 * r, n), z, z + cast, hole) for z in (low, high - cast)]
            rib = box((0.5 * r, 0.16 * r, high - low - 2 * cast), (0.72 * r, 0, (low + high) / 2))
            return [*discs, around(rib, self.ribs)]
        # A bell: a cone whose quarters are cut away.
        side = outline(0.55 * r, high - cast, 0.8 * r, high - cast, 1.05 * r, low + cast, 0.6 * r, low + cast)
        rings = [ring(0.4 * r, 1.1 * r, low, low + cast, n), ring(0.35 * r, 0.85 * r, high - cast, high, n)]
        return [*rings, around(upright(side, -0.2 * r, 0.2 * r), 4)]


MOUNTS = families_of(Hinge, CornerAngles, MountingFeet, Lantern)
