"""What vessels stand on and are climbed by: saddles, skirts, legs, ladders, small platforms."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.params import Params, among, between, chance, given, whole
from cadplants.builder.table import Table, outline
from cadplants.families.vessels.vessel import apart
from cadplants.families.vessels.vessel_fittings import Drum, wrapped
from cadplants.model.family import Part
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved, revolve, sweep, weld
from cadplants.solids.polygon import rounded_rectangle, section_angle, section_channel, section_i
from cadplants.solids.primitives import BOTH, around, box, cylinder, hexagon, ring, rod, torus
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["FEET", "SADDLES", "Feet", "Saddle", "bar", "foot_plate", "ladder", "ringed_rail"]


def bar(
    start: Sequence[float], end: Sequence[float], section: Floats, up: tuple[float, float, float] = (0.0, 0.0, 1.0)
) -> Solid:
    """A rolled section between two points; ``up`` is where its own x axis looks [m]."""
    return sweep(np.array([start, end], float), section, up=up)


def foot_plate(x: float, y: float, side: float, thick: float = 0.012) -> Solid:
    """A square plate on the floor [m]."""
    return box((side, side, thick), (x, y, thick / 2))


def _anchors(t: Table, points: Sequence[tuple[float, float]], thread: float, grip: float) -> None:
    """Anchor bolts with their nuts, standing out of the floor."""
    one = [cylinder(thread / 2, 0.0, grip + 2.2 * thread, 8), hexagon(1.6 * thread, grip, grip + 0.8 * thread)]
    t.add("bolt", *(moved(merge(one), at(*p)) for p in points), own=False)


# --- saddles, for a vessel along x with its axis at a height ---


class Saddle(Params):
    """A saddle across x = 0 (DIN 28080, or built as small makers do)."""

    def parts(self, r: float, axis: float, style: ModelingStyle) -> list[Part]:
        """The saddle of a vessel of radius ``r`` whose axis is at ``axis`` over the floor [m]."""
        t = Table(style, "Tank", "saddle")
        self.build(t, r, axis)
        return t.parts

    def build(self, t: Table, r: float, axis: float) -> None:
        """Puts it down, as in ``parts``."""
        raise NotImplementedError(type(self).__name__)


class Ribbed(Saddle):
    """A saddle of wear plate, web, ribs and base."""

    kind = "ribbed"

    half: float = between(0.85, 1.1, "half the angle that the wear plate embraces", "rad")
    ribs: int = whole(2, 4, "ribs")

    def build(self, t: Table, r: float, axis: float) -> None:
        wide, thick, half = 0.10 + 0.1 * r, 0.008 + 0.006 * r, self.half
        wear = wrapped(r - 0.002, -np.pi / 2 - half, 2 * half, -0.6 * wide, 0.6 * wide, thick, t.style)
        web, ribs = _cradle(r, axis, 0.9 * r, thick, t.style, 0.9 * half, 0.5 * thick), []
        for y in np.linspace(-0.8, 0.8, self.ribs) * r:
            top = axis - np.sqrt(r * r - y * y) - 0.3 * thick
            ribs.append(box((wide, thick, top), (0, y, top / 2)))
        t.add("saddle", web, *ribs)
        t.add("saddle", _across(wear, axis))
        t.add("saddle", box((1.3 * wide, 2.0 * r, 0.015), (0, 0, 0.0075)))
        _anchors(t, [(0.0, s * 0.9 * r) for s in BOTH], 0.02, 0.015)


class Pier(Saddle):
    """A concrete pier, maybe with a strap over the vessel."""

    kind = "concrete"

    wide: float = between(0.2, 0.4, "width", "m")
    strapped: bool = chance(0.5, "a strap holds the vessel")

    def build(self, t: Table, r: float, axis: float) -> None:
        t.add("saddle", _cradle(r, axis, 1.15 * r + 0.04, self.wide, t.style, 1.1), of="concrete")
        if self.strapped:
            strap = wrapped(r, -0.45, np.pi + 0.9, -0.03, 0.03, 0.006, t.style)
            t.add("clamp", _across(strap, axis), of="steel")


class Block(Saddle):
    """A block of timber or plastic."""

    kind = "block"

    wide: float = between(0.08, 0.2, "width", "m")
    reach: float = between(0.65, 0.95, "half its length / radius of the vessel")

    def build(self, t: Table, r: float, axis: float) -> None:
        t.add("saddle", _cradle(r, axis, self.reach * r, self.wide, t.style, 0.75), of="rubber")


class Sheet(Saddle):
    """A saddle folded from one sheet: a box without ribs, its sides flared to the feet, with bent-out flanges."""

    kind = "sheet"

    seat: float = between(0.6, 0.9, "half the angle that it embraces", "rad")
    flare: float = between(1.0, 1.35, "its width at the feet / at the vessel")

    def build(self, t: Table, r: float, axis: float) -> None:
        wide, thick, half = 0.08 + 0.12 * r, 0.004, self.seat
        seat = wrapped(r - 0.001, -np.pi / 2 - half, 2 * half, -wide / 2, wide / 2, thick, t.style)
        y, z = r * np.sin(half), axis - r * np.cos(half)
        foot, walls = self.flare * y, []
        section = np.array(outline(0.5, -0.5, 0.5, 0.5, -0.5, 0.5, -0.5, -0.5)) * (wide, thick)
        for s in BOTH:
            path = np.array([(0, s * y, z), (0, s * foot, thick / 2), (0, s * (foot + 0.06), thick / 2)], float)
            walls.append(sweep(path, section, up=(1.0, 0.0, 0.0)))
        t.add("saddle", _across(seat, axis), *walls, own=False)
        _anchors(t, [(0.0, s * (foot + 0.035)) for s in BOTH], 0.012, thick)


class Framed(Saddle):
    """Two legs of angle, tube or rolled section with a cross bar and a cradle of flat bar."""

    kind = "frame"

    seat: float = between(0.7, 1.0, "half the angle that the cradle embraces", "rad")
    section: str = among(("angle", "tube", "beam"), "section of its legs")
    lean: float = among((0.0, 0.0, 0.3), "how far its legs spread / radius of the vessel")
    level: float = between(0.25, 0.6, "height of the cross bar / of the vessel's underside")

    def build(self, t: Table, r: float, axis: float) -> None:
        side, half = 0.05 + 0.05 * r, self.seat
        wide, lean = 1.4 * side, self.lean * r
        strip = wrapped(r - 0.001, -np.pi / 2 - half, 2 * half, -wide / 2, wide / 2, 0.01, t.style)
        y, top = r * np.sin(0.8 * half), axis - r * np.cos(0.8 * half)
        sections = {
            "angle": section_angle(side, 0.1 * side) - 0.4 * side,
            "tube": rounded_rectangle(side, side, 0.0),
            "beam": section_i(side, side, 0.07 * side, 0.1 * side),
        }
        up, section = (1.0, 0.0, 0.0), sections[self.section]
        legs = [bar((0, s * (y + lean), 0.01), (0, s * y, top), section, up) for s in BOTH]
        level = self.level * (axis - r)
        reach = y + lean * (1 - level / top)
        cross = bar((0, -reach, level), (0, reach, level), rounded_rectangle(0.7 * side, 0.7 * side, 0.0))
        t.add("saddle", _across(strip, axis), *legs, cross, own=False)
        for s in BOTH:
            t.add("base plate", foot_plate(0, s * (y + lean), 2.0 * side))


SADDLES: Mapping[str, type[Saddle]] = {one.kind: one for one in (Ribbed, Block, Sheet, Pier, Framed)}
"""Saddles by their build."""


def _across(solid: Solid, axis: float) -> Solid:
    """What was built about z laid about the vessel's axis along x, its -y then downward."""
    return moved(solid, at(0, 0, axis) @ spun("z", np.pi / 2) @ spun("x", np.pi / 2))


def _cradle(
    r: float, axis: float, reach: float, wide: float, style: ModelingStyle, half: float, lift: float = -0.002
) -> Solid:
    """A plate or block across x with a round seat for the vessel, from the floor up."""
    half = min(half, float(np.arcsin(min(0.99, reach / r))) if reach < r else half)
    a = np.linspace(-np.pi / 2 - half, -np.pi / 2 + half, max(5, style.round(r) // 3))
    seat = (r + lift) * np.column_stack([np.cos(a), np.sin(a)])
    edge = max(reach, float(seat[:, 0].max()) + 0.001)
    corners = np.array([(edge, seat[-1, 1]), (edge, -axis), (-edge, -axis), (-edge, seat[0, 1])])
    return _across(extrude(np.vstack([seat, corners])[::-1], -wide / 2, wide / 2), axis)


# --- skirts and legs, under an upright drum ---


class Feet(Params):
    """What an upright drum stands on."""

    clear: float = given(0.3, "of the drum's lower rim over the floor", "m")

    def parts(self, drum: Drum, style: ModelingStyle) -> list[Part]:
        """What a drum stands on."""
        t = Table(style, "Tank", "tank leg")
        self.build(t, drum)
        return t.parts

    def build(self, t: Table, drum: Drum) -> None:
        """Puts it down, as in ``parts``."""
        raise NotImplementedError(type(self).__name__)


class FlaredSkirt(Feet):
    """A conical skirt (DIN 28082)."""

    kind = "flared"

    foot: float = between(1.2, 1.5, "radius of its foot / of the drum")

    def build(self, t: Table, drum: Drum) -> None:
        r, low, foot = drum.r, drum.low, self.foot * drum.r
        wall, thick, high = max(0.006, 0.012 * r), 0.012 + 0.01 * r, drum.low + 0.02 + 0.04 * r
        edge = outline(foot - wall, thick, foot, thick, r + wall, low, r + wall, high, r, high, r, low)
        apart(t, "skirt", weld([revolve(edge, drum.n, closed=True)]))
        apart(t, "skirt", ring(0.88 * foot, 1.15 * foot, 0.0, thick, drum.n))


class OpenSkirt(Feet):
    """A cylindrical skirt with doorways, and pipe sleeves or vents near its top (DIN 28082)."""

    kind = "open"

    count: int = whole(1, 3, "doorways")
    door: float = between(0.5, 0.9, "angle that a doorway takes", "rad")

    def build(self, t: Table, drum: Drum) -> None:
        r, low, n, inner = drum.r, drum.low, drum.n, drum.r - drum.dip - 0.001
        thick, outer = 0.012 + 0.01 * r, max(0.006, 0.012 * r) + r
        sill, head = thick + 0.12 * low, thick + 0.6 * low
        shells = [ring(inner, outer, thick, sill, n), ring(inner, outer, head, low + 0.02 + 0.04 * r, n)]
        frames, turn = [], 2 * np.pi / self.count - self.door
        for k in range(self.count):
            start = 2 * np.pi * k / self.count + self.door / 2
            shells.append(wrapped(inner, start, turn, sill, head, outer - inner, t.style))
            jamb = box((0.05, 0.012, head - sill), (r, 0, (head + sill) / 2))
            frames += [moved(jamb, spun("z", a)) for a in (start, start + turn)]
        vent, high = ring(0.03, 0.042, -0.06, 0.03, 12), 0.5 * (head + low)
        vents = [moved(vent, drum.side(a, high)) for a in np.arange(4) * np.pi / 2 + 0.3]
        apart(t, "skirt", *shells)
        apart(t, "skirt", *frames, *vents)
        apart(t, "skirt", ring(0.85 * r, 1.16 * r + 0.03, 0.0, thick, n))


class ChairedSkirt(Feet):
    """A cylindrical skirt with bolt chairs (DIN 28082)."""

    kind = "chairs"

    count: int = among((8, 12, 16), "bolt chairs")
    tall: float = between(0.1, 0.2, "height of a chair", "m")
    ringed: bool = chance(0.5, "one ring over all chairs")

    def build(self, t: Table, drum: Drum) -> None:
        r, n, tall = drum.r, drum.n, self.tall
        wall, thick, reach = max(0.006, 0.012 * r), 0.012 + 0.01 * r, 0.13 * r + 0.03
        apart(t, "skirt", ring(r - drum.dip - 0.001, r + wall, thick, drum.low + 0.02 + 0.04 * r, n))
        apart(t, "skirt", ring(0.85 * r, 1.16 * r + 0.03, 0.0, thick, n))
        webs = [box((reach, 0.012, tall), (reach / 2 - 0.01, y, thick + tall / 2)) for y in (-0.04, 0.04)]
        apart(t, "skirt", around(merge(webs), self.count, r))
        top, lid = thick + tall, box((reach, 0.13, thick), (reach / 2, 0, thick + tall + thick / 2))
        apart(t, "skirt", ring(r, r + reach, top, top + thick, n) if self.ringed else around(lid, self.count, r))
        a, out = 2 * np.pi * np.arange(self.count) / self.count, r + 0.6 * reach
        _anchors(t, [(float(out * np.cos(one)), float(out * np.sin(one))) for one in a], 0.024, top + thick)


class _Legs(Feet):
    """Legs all round a drum (DIN 28081)."""

    count: int = among((3, 4), "legs")

    def build(self, t: Table, drum: Drum) -> None:
        side, out = 0.045 + 0.06 * drum.r, drum.r - drum.dip
        leg, foot = self.leg(drum, side, out, t.style), self.foot(side)
        for k in range(self.count):
            under = t.spun("z", 2 * np.pi * k / self.count + 0.5)
            under.add("tank leg", leg)
            if foot is not None:
                under.at(out + 0.6 * side).add("base plate", foot)

    def leg(self, drum: Drum, side: float, out: float, style: ModelingStyle) -> Solid:
        """A leg beside +x of a side, the drum's flats being ``out`` of the axis [m]."""
        raise NotImplementedError(type(self).__name__)

    def foot(self, side: float) -> Solid | None:
        """The plate below a leg, about z."""
        return foot_plate(0, 0, 2.0 * side)

    def high(self, drum: Drum) -> float:
        """How far legs reach up beside the drum [m]."""
        return drum.low + 0.1 + 0.25 * drum.r


class AngleLegs(_Legs):
    """Legs of angle on pads."""

    kind = "angle"

    def leg(self, drum: Drum, side: float, out: float, style: ModelingStyle) -> Solid:
        high, low = self.high(drum), drum.low
        leg = extrude(section_angle(side, 0.12 * side), 0.01, high)
        pad = box((0.02, 1.6 * side, 1.3 * (high - low)), (out + 0.008, 0, low + 0.65 * (high - low)))
        return merge([moved(leg, at(out + 0.79 * side) @ spun("z", 0.75 * np.pi)), pad])


class PipeLegs(_Legs):
    """Legs of pipe on round feet."""

    kind = "pipe"

    count: int = among((3, 4, 4, 6), "legs")

    def leg(self, drum: Drum, side: float, out: float, style: ModelingStyle) -> Solid:
        x = out + 0.45 * side
        return rod((x, 0, 0.01), (x, 0, self.high(drum)), 0.5 * side, style.round(side))

    def foot(self, side: float) -> Solid | None:
        return cylinder(0.9 * side, 0, 0.012, 16)


class BeamLegs(_Legs):
    """Legs of rolled section, braced where they are long."""

    kind = "beam"

    count: int = among((3, 4, 4, 6), "legs")
    crossed: bool = chance(0.6, "the braces cross", when=lambda p: p.clear > 0.35)

    def build(self, t: Table, drum: Drum) -> None:
        super().build(t, drum)
        low, side = drum.low, 0.045 + 0.06 * drum.r
        if low <= 0.35:
            return
        section, reach = rounded_rectangle(0.5 * side, 0.15 * side, 0.0), drum.r - drum.dip + 0.6 * side
        turns = 2 * np.pi * np.arange(self.count) / self.count + 0.5
        feet = [(reach * np.cos(a), reach * np.sin(a)) for a in turns]
        for p, q in zip(feet, [*feet[1:], feet[0]], strict=True):
            for start, end in ((p, q), (q, p))[: 2 if self.crossed else 1]:
                t.add("brace", bar((*start, 0.15 * low), (*end, 0.85 * low), section))

    def leg(self, drum: Drum, side: float, out: float, style: ModelingStyle) -> Solid:
        section = section_i(1.2 * side, 1.1 * side, 0.08 * side, 0.1 * side)
        return moved(extrude(section, 0.01, self.high(drum)), at(out + 0.54 * side))


class Pads(_Legs):
    """Stubs under the head with levelling pads."""

    kind = "pads"

    def leg(self, drum: Drum, side: float, out: float, style: ModelingStyle) -> Solid:
        stub = cylinder(0.45 * side, 0.03, drum.low + 0.02, style.round(side))
        pad = [cylinder(0.2 * side, 0.01, 0.04, 10), cylinder(0.8 * side, 0, 0.015, 16)]
        return moved(merge([stub, *pad]), at(0.68 * drum.r))

    def foot(self, side: float) -> Solid | None:
        return None


class Tripod(_Legs):
    """Legs of bent flat bar."""

    kind = "tripod"

    def leg(self, drum: Drum, side: float, out: float, style: ModelingStyle) -> Solid:
        x, foot = out + 0.004, 1.15 * drum.r
        path = np.array([(x, 0, self.high(drum)), (x, 0, drum.low), (foot, 0, 0.006), (foot + 0.08, 0, 0.006)])
        return sweep(path, rounded_rectangle(1.2 * side, 0.01, 0.0), up=(0.0, 1.0, 0.0))

    def foot(self, side: float) -> Solid | None:
        return None


class Brackets(Feet):
    """Brackets on the shell (DIN 28083) that rest on a frame of four columns and beams."""

    kind = "bracket"

    height: float = between(0.35, 0.6, "of the brackets over the shell's lower rim / height of the shell")

    def build(self, t: Table, drum: Drum) -> None:
        r, z = drum.r, drum.low + self.height * (drum.high - drum.low)
        side, reach = 0.06 + 0.05 * r, 0.1 + 0.12 * r
        depth, lift = 1.6 * reach, z + 0.006
        gusset = np.array([[0, 0], [reach, 0], [reach, 0.2 * depth], [0, depth]])
        webs = [moved(extrude(gusset, y, y + 0.008), spun("x", np.pi / 2)) for y in (-0.35 * reach, 0.35 * reach)]
        back = box((0.012 + drum.dip, 1.2 * reach, 1.2 * depth), (0.004 - drum.dip / 2, 0, 0.5 * depth))
        one = merge([*webs, back, box((reach, reach, 0.012), (0.5 * reach, 0, 0.0))])
        for k in range(4):
            t.spun("z", k * np.pi / 2).at(r, 0, lift).add("tank leg", one)
        w, tall = r + 0.6 * reach, 1.3 * side
        post = extrude(section_i(side, side, 0.08 * side, 0.1 * side), 0.012, z - tall)
        for sx in BOTH:
            for sy in BOTH:
                t.at(sx * w, sy * w).add("column", post)
                t.at(sx * w, sy * w).add("base plate", foot_plate(0, 0, 2 * side))
        section = section_channel(tall, 0.6 * side, 0.1 * side, 0.12 * side) - [0.3 * side, 0]
        (start, end), level = (-w - side / 2, w + side / 2), z - tall / 2
        beam = bar((w, start, level), (w, end, level), section, (-1.0, 0.0, 0.0))
        for k in range(4):
            t.spun("z", k * np.pi / 2).add("beam", beam)


FEET: Mapping[str, type[Feet]] = {
    one.kind: one
    for one in (OpenSkirt, FlaredSkirt, ChairedSkirt, AngleLegs, PipeLegs, BeamLegs, Pads, Tripod, Brackets)
}
"""Skirts and legs by their build."""


# --- access ---


def ladder(x: float, low: float, high: float, style: ModelingStyle, caged: bool, spacers: float) -> Solid:
    """A ladder beside a shell (ISO 14122-4) at ``x`` from the axis, its spacers reaching back this far [m]."""
    n, wide = max(6, min(10, style.round(0.02))), 0.4
    solids = [rod((x, s * wide / 2, low), (x, s * wide / 2, high), 0.02, n) for s in BOTH]
    solids += [rod((x, -wide / 2, z), (x, wide / 2, z), 0.011, 6) for z in np.arange(low + 0.25, high - 0.05, 0.28)]
    for z in np.linspace(low + 0.4, high - 1.1, max(2, int((high - low) / 1.5))):
        solids += [box((spacers, 0.05, 0.01), (x - spacers / 2, s * wide / 2, z)) for s in BOTH]
    if caged and high - low > 2.8:
        a = np.linspace(-np.pi / 2, np.pi / 2, 9)
        hoop = np.column_stack([x + 0.1 + 0.6 * np.cos(a), 0.36 * np.sin(a), np.zeros(9)])
        hoop = np.vstack([[(x, -wide / 2, 0)], hoop, [(x, wide / 2, 0)]])
        for z in np.arange(low + 2.2, high, 0.8):
            solids.append(sweep(hoop + np.array([0, 0, z]), rounded_rectangle(0.05, 0.006, 0.0), up=(0.0, 0.0, 1.0)))
        for k in (2, 5, 8):
            solids.append(box((0.006, 0.04, high - low - 2.2), (hoop[k, 0], hoop[k, 1], (high + low + 2.2) / 2)))
    return merge(solids)


def ringed_rail(r: float, low: float, n: int) -> Solid:
    """A railing round the edge of a roof: two tubes on posts."""
    rails = [moved(torus(r, 0.02, n, 6), at(0, 0, low + z)) for z in (0.55, 1.1)]
    count = max(6, int(2 * np.pi * r / 1.5))
    posts = around(rod((0, 0, low - 0.03), (0, 0, low + 1.1), 0.02, 8), count, r * np.cos(np.pi / n))
    return merge([*rails, posts])
