"""Couplings of further makes: grooved, clamp band, sleeve with bolts, cam lever, claw, quick, adaptor, hygienic."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, whole
from cadplants.builder.table import Table, outline
from cadplants.families.piping.shape import (
    BACK,
    ROLL,
    SMALL,
    Fitting,
    barrel,
    bolting,
    counter,
    flat_flange,
    grooved,
    knurled,
    lathe,
    pipe_x,
    prism,
    sized,
)
from cadplants.model.family import Model
from cadplants.model.standards import SIZES, sizes_between
from cadplants.parts.flange import plate_thickness
from cadplants.solids.mesh_ops import Solid, about_x, extrude, merge, moved
from cadplants.solids.polygon import circle
from cadplants.solids.primitives import BOTH, box, cylinder, rod, torus
from cadplants.solids.transforms import IDENTITY, at, spun

__all__ = ["COUPLINGS", "ferrule", "half_band", "hygienic_clamp"]

_ME = "coupling"


def half_band(inner: float, outer: float, low: float, high: float, sides: int, turn: float = np.pi) -> Solid:
    """The upper half of a ring about x, or another share of it [m]."""
    rest = 0.5 * (np.pi - turn)
    angles = np.linspace(rest + 0.015, np.pi - rest - 0.015, max(6, sides // 2) + 1)
    unit = np.column_stack([np.cos(angles), np.sin(angles)])
    return about_x(extrude(np.concatenate([outer * unit, inner * unit[::-1]]), low, high))


class _Coupling(Fitting, bundle=_ME):
    """A coupling; its ends are on 0 and on its length."""

    def pipes(self, t: Table, length: float, gap: float = 0.01) -> None:
        """Two pieces of pipe that nearly meet in the middle of it."""
        half = 0.5 * length - 0.5 * gap
        for a, b in ((0.0, half), (length - half, length)):
            t.add("pipe", pipe_x(t.dn, a, b, t.style), own=False)


class Grooved(_Coupling, name="coupling/grooved", sizes=SIZES[2:], weight=1.0):
    """A grooved coupling of two housings and two bolts over the ends of two pipes (AWWA C606)."""

    long: float = between(0.5, 2.5, "length, less 0.1 m / diameter of the pipe")
    roll: float = among((0.0, 0.25, 0.5), ROLL)
    ribbed: bool = chance(0.5, "ribs round its housings")

    def build(self, t: Table) -> Model:
        length = 0.1 + self.long * t.pipe.outer
        self.pipes(t, length, 0.004)
        t.extend(grooved(t.dn, t.style, at(0.5 * length) @ spun("x", self.roll * np.pi), self.ribbed))
        return t.model(round(length, 9), "welded")


class ClampBand(_Coupling, name="coupling/clamp band", sizes=SIZES[3:]):
    """A clamp-band coupling of stainless sheet with folded edges, closed by two screws in two bars (Straub type)."""

    wide: float = between(0.7, 1.1, "width, less 45 mm / radius of the pipe")
    bare: float = between(0.06, 0.3, "length of the pipe that it leaves bare", "m")
    roll: float = among((0.0, 0.5, 1.0), ROLL)
    paired: bool = chance(0.8, "two screws, not one")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.2)
        width, thick, outer = self.wide * r + 0.045, 0.002 + 0.02 * r, r + 0.006 + 0.06 * r
        length, bead = width + self.bare, 0.12 * width
        mid, low, high = 0.5 * length, 0.5 * (length - width), 0.5 * (length + width)
        self.pipes(t, length)
        shape = outline(0.93 * outer, low, outer, low + bead, outer, high - bead, 0.93 * outer, high)
        t.add(_ME, lathe(shape, n, r * 1.0005), of="trim")
        wrap = [barrel(outer + thick, low + bead, high - bead, n, outer - 0.0003)]
        bar, lift = 0.1 * r + 0.005, outer + thick + 0.05 * r + 0.004
        side = bar * 1.3 + 0.003
        wrap += [rod((low + bead, s * side, lift), (high - bead, s * side, lift), bar, 10) for s in BOTH]
        t = t.spun("x", self.roll * np.pi)
        t.add(_ME, *wrap, of="trim")
        for share in (-0.25, 0.25) if self.paired else (0.0,):
            way = at(mid + share * width, 0, lift) @ spun("z", np.pi / 2)
            t.extend(bolting(1, 0.0, 0.5 * bar + 0.003, -side - bar, side + bar, t.style, _ME, way))
        return t.model(round(length, 9), "welded")


def _lobed(radius: float, ears: int, reach: float, wide: float, bore: float, low: float, high: float, n: int) -> Solid:
    """A follower ring with an ear for each bolt, along x."""
    angles = np.linspace(0, 2 * np.pi, max(n, 12 * ears), endpoint=False)
    phase = np.abs((angles * ears / (2 * np.pi) + 0.5) % 1.0 - 0.5) * 2 * np.pi / ears
    r = np.where(phase < wide, reach, radius + (reach - radius) * np.exp(-((np.maximum(phase - wide, 0) * 8) ** 2)))
    return about_x(extrude(np.column_stack([r * np.cos(angles), r * np.sin(angles)]), low, high, (circle(bore, n),)))


class SleeveBolts(_Coupling, name="coupling/sleeve with bolts", sizes=SIZES[4:]):
    """A bolted sleeve coupling (AWWA C219): a middle ring, two follower rings, long bolts from one to the other."""

    wide: float = between(1.2, 2.2, "width, less 70 mm / radius of the pipe")
    bare: float = between(0.08, 0.3, "length of the pipe that it leaves bare", "m")
    count: int = among(lambda p: (2, 3, 4) if p.dn <= 80 else (4, 6, 8), "bolts")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.3)
        width, thick, bolt = self.wide * r + 0.07, 0.01 + 0.06 * r, 0.008 + 0.04 * r
        length, sleeve = width + self.bare, 1.08 * r + 0.008
        low, high, wide = 0.5 * (length - width), 0.5 * (length + width), 1.12 * sleeve
        shape = outline(wide, low + thick, sleeve, low + 2 * thick, sleeve, high - 2 * thick, wide, high - thick)
        self.pipes(t, length)
        t.add(_ME, lathe(shape, n, r), of="valve")
        out = 1.15 * sleeve + 1.1 * bolt
        for a in (low, high - thick):
            ear = out + 1.1 * bolt, 1.2 * bolt / out
            t.add(_ME, _lobed(1.15 * sleeve, self.count, *ear, r, a, a + thick, n), of="valve")
        t.extend(bolting(self.count, out, bolt, low, high, t.style, _ME, IDENTITY, 0.0))
        return t.model(round(length, 9), "welded")


class CamLever(_Coupling, name="coupling/cam lever", sizes=sizes_between(most=100), grain="structure"):
    """A cam and groove coupling (EN 14420-7): an adapter in a coupler with two cam levers and finger rings."""

    gripped: bool = among((False, True), "flats for a wrench on its coupler")
    flats: int = among((6, 8), "such flats", when=lambda p: p.gripped, otherwise=0)
    lift: float = among((0.0, 0.0, 0.9), "how far its levers are lifted", "rad")
    roll: float = among((0.0, 0.5), ROLL)

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.4)
        end, cup, male = 0.9 * r + 0.012, 1.1 * r + 0.02, 0.7 * r + 0.012
        length, outer, x, t = 2 * end + cup + male, 1.45 * r + 0.006, end + 0.65 * cup, t.spun("x", self.roll * np.pi)
        grip = lathe(outline(1.2 * r, 0.0, 1.25 * r, end), n, bore)
        if self.gripped:
            grip = prism(2.7 * r + 0.004, self.flats, 0.0, end, bore, n)
        coupler = lathe(outline(1.2 * r, 0.9 * end, outer, end, outer, end + cup), n, bore)
        ear = (0.3 * cup, 0.35 * r + 0.006, 0.004 + 0.05 * r)
        ears = [box(ear, (x, s * (outer + 0.12 * r), z * 0.3 * r)) for s in BOTH for z in BOTH]
        t.add(_ME, merge([grip, coupler]), *ears, of="trim")
        a = outline(1.15 * r, end + cup - 0.2 * r, 1.15 * r, length - end, 1.3 * r, length - end, 1.3 * r, length)
        t.add(_ME, lathe(a, n, bore), of="trim")
        long = 0.9 * cup + end
        finger = torus(0.25 * r + 0.006, 0.002 + 0.02 * r, 12, 6)
        lever = [
            cylinder(0.22 * r + 0.003, -0.25 * r, 0.25 * r, 10),
            box((long, 0.12 * r + 0.003, 0.45 * r), (-0.5 * long, 0.1 * r, 0)),
            moved(finger, at(-long - 0.2 * r, 0.1 * r) @ spun("x", np.pi / 2)),
        ]
        for s in BOTH:
            flip = np.diag([1.0, float(s), 1.0, 1.0])
            t.at(x, s * (outer + 0.2 * r)).moved(flip).spun("z", -self.lift).add("lever", *lever, own=True)
        return t.model(round(length, 9), "welded")


class Claw(_Coupling, name="coupling/claw", sizes=sizes_between(most=100), grain="structure"):
    """A claw coupling (DIN 14301 Storz, or with two claws): two alike halves, each with lugs round its ring."""

    tail: float = between(0.9, 1.8, "length of its tails, less 20 mm / radius of the pipe")
    lugs: int = among((2, 2, 3, 4), "lugs of a half")
    ribbed: bool = chance(0.5, "ribs round its tails")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.5)
        tail, ring, outer = self.tail * r + 0.02, 0.45 * r + 0.014, 1.5 * r + 0.01
        length = 2 * (tail + ring)
        half = [lathe(outline(1.15 * r, 0.0, 1.1 * r, tail, outer, tail, outer, tail + ring), n, bore)]
        lug = box((1.3 * ring, 0.3 * r + 0.01, 0.8 * r), (tail + 0.75 * ring, outer, 0))
        half += [moved(lug, spun("x", 2 * np.pi * k / self.lugs)) for k in range(self.lugs)]
        if self.ribbed:
            half += [barrel(1.2 * r, tail * k, tail * k + 0.08 * tail, n, 1.08 * r) for k in (0.2, 0.45, 0.7)]
        t.add(_ME, *half, of="trim")
        t.at(length).moved(BACK).spun("x", np.pi / self.lugs).add(_ME, *half, of="trim")
        return t.model(round(length, 9), "welded")


class Quick(_Coupling, name="coupling/quick", sizes=SMALL, grain="structure"):
    """A quick coupling (ISO 7241): a plug in a socket with a sliding knurled sleeve, hexagons at both ends."""

    body: float = between(2.2, 3.2, "length of its body, less 20 mm / radius of the pipe")
    sleeve: float = between(0.3, 0.5, "length of its sleeve / of its body")
    knurled: bool = chance(0.5, "a knurled sleeve, not a grooved one")
    teeth: int = whole(12, 23, "teeth of the knurling", when=lambda p: p.knurled)

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.5)
        end, body = 0.8 * r + 0.01, self.body * r + 0.02
        length, split = 2 * end + body + 0.6 * r, end + 0.72 * body
        neck = lathe(outline(1.3 * r, 0.9 * end, 1.45 * r, end, 1.45 * r, split), n, bore)
        t.add(_ME, prism(2.5 * r + 0.005, 6, 0.0, end, bore, n), neck, of="trim")
        long = self.sleeve * body
        low, high, wide, thin = split - long, split + 0.1 * r, 1.75 * r, 1.6 * r
        if self.knurled:
            sleeve = knurled(wide + 0.002, self.teeth, 0.08 * r, low, high, 1.4 * r, n)
        else:
            shape = outline(wide, low, wide, low + 0.2 * long, thin, low + 0.3 * long, thin, high - 0.3 * long)
            sleeve = lathe([*shape, (wide, high - 0.2 * long), (wide, high)], n, 1.4 * r)
        t.add(_ME, sleeve, of="trim")
        a, b = split + 0.5 * r, length - end
        plug = lathe(outline(1.1 * r, split - 0.2 * r, 1.1 * r, a, 1.35 * r, a, 1.35 * r, b), n, bore)
        t.add(_ME, plug, prism(2.5 * r + 0.005, 6, b, length, bore, n), of="trim")
        return t.model(round(length, 9), "welded")


class FlangeAdaptor(_Coupling, name="coupling/flange adaptor", sizes=SIZES[5:]):
    """A flange adaptor (AWWA C219): a flanged sleeve over a plain pipe, pressed by a follower ring with bolts."""

    lead: float = between(0.05, 0.2, "length of the pipe before it", "m")
    body: float = between(0.7, 1.2, "length of its body, less 50 mm / radius of the pipe")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.3)
        lead, plate, thick = self.lead, plate_thickness(t.dn), 0.01 + 0.05 * r
        face, sleeve = lead + thick + self.body * r + 0.05, 1.08 * r + 0.008
        count, bolt = (4 if t.dn <= 100 else 6), 0.008 + 0.03 * r
        wide = 1.15 * sleeve
        out = wide + 1.1 * bolt
        t.add("pipe", pipe_x(t.dn, 0.0, face - 0.02, t.style), own=False)
        body = lathe(outline(wide, lead + thick + 0.004, sleeve, lead + 2 * thick, sleeve, face - plate), n, r)
        t.add(_ME, body, flat_flange(t.dn, t.style, face - plate, plate, r), of="valve")
        ring = _lobed(wide, count, out + 1.1 * bolt, 1.2 * bolt / out, r, lead, lead + thick, n)
        t.add(_ME, ring, of="valve")
        high = min(face - plate, lead + 3 * thick)
        t.extend(bolting(count, out, bolt, lead, high, t.style, _ME, IDENTITY, 0.0))
        parts, more = counter(t.dn, t.style, at(face))
        t.extend(parts)
        return t.model(round(face + more, 9), "welded")


def ferrule(t: Table, long: float) -> tuple[Solid, float, float]:
    """A ferrule of a hygienic joint (ISO 2852) on a pipe, its length and its radius [m].

    Args:
        t: with the pipe's nominal size.
        long: its length, less 12 mm / radius of the pipe.
    """
    r, n, bore = sized(t.dn, t.style, 1.4)
    end, rim = long * r + 0.012, 1.18 * r + 0.009
    return lathe(outline(r, 0.0, r, end - 0.006, rim, end - 0.003, rim, end), n, bore), end, rim


def hygienic_clamp(t: Table, face: float, rim: float, hinged: bool = True) -> None:
    """A clamp of two halves round ferrules of a radius that meet behind a face, and the wing nut that draws it [m]."""
    r, n, _ = sized(t.dn, t.style, 1.4)
    mid, wide, outer = face + 0.001, 0.016 + 0.06 * r, rim + 0.005 + 0.04 * r
    half = half_band(rim, outer, mid - 0.5 * wide, mid + 0.5 * wide, n)
    lug = box((wide, 0.35 * r + 0.008, 0.012), (mid, outer + 0.12 * r, 0.008))
    lower = [moved(half, spun("x", np.pi)), moved(lug, np.diag([1.0, 1.0, -1.0, 1.0]))]
    if hinged:
        lower.append(moved(cylinder(0.005, -0.5 * wide, 0.5 * wide, 8), at(mid, -outer - 0.003) @ spun("y", np.pi / 2)))
    t = t.bundled("clamp")
    for solids in ([half, lug], lower):
        t.add("clamp", *solids, own=True)
    wing = [
        cylinder(0.003, -0.022, 0.03, 8),
        cylinder(0.008, 0.014, 0.026, 10),
        box((min(0.045, 0.016 + 0.7 * r), 0.005, 0.012), (0, 0, 0.03)),
    ]
    t.at(mid, outer + 0.15 * r).add("nut", *wing)


class HygienicClamp(_Coupling, name="coupling/hygienic clamp", sizes=sizes_between(most=100), grain="structure"):
    """A hygienic clamp joint (ISO 2852): two ferrules, a seal, a hinged clamp of two halves with a wing nut."""

    long: float = between(0.6, 1.2, "length of a ferrule, less 12 mm / radius of the pipe")
    roll: float = between(0, 6, "where its wing nut is, about the pipe", "rad")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.4)
        one, long, rim = ferrule(t, self.long)
        length, t = 2 * long + 0.002, t.spun("x", self.roll)
        t.add(_ME, one, of="trim")
        t.at(length).moved(BACK).add(_ME, one, of="trim")
        t.add("gasket", barrel(rim, long, long + 0.002, n, r))
        hygienic_clamp(t, long, rim)
        return t.model(round(length, 9), "welded")


class PlasticCompression(
    _Coupling, name="coupling/plastic compression", sizes=sizes_between(most=100), grain="structure"
):
    """A plastic compression fitting (ISO 17885): a barrel between two conical nuts with coarse ribs."""

    nut: float = between(1.5, 2.2, "length of a nut, less 15 mm / radius of the pipe")
    teeth: int = whole(8, 14, "ribs of a nut")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.6)
        nut, middle = self.nut * r + 0.015, 0.8 * r + 0.01
        length, a, b = 2 * nut + middle, 1.45 * r, 1.5 * r
        cone = outline(1.25 * r, 0.0, b + 0.003, 0.55 * nut, 1.6 * r + 0.003, nut)
        ribs = knurled(1.85 * r + 0.004, self.teeth, 0.22 * r, 0.5 * nut, nut, 1.3 * r, n)
        one = [lathe(cone, n, r if t.style.hollow else 0.0), ribs]
        far = nut + middle
        body = outline(a, 0.8 * nut, a, nut, b, nut, b, far, a, far, a, length - 0.8 * nut)
        t.add(_ME, lathe(body, n), of="rubber")
        t.add(_ME, *one)
        t.at(length).moved(BACK).add(_ME, *one)
        return t.model(round(length, 9), "welded")


class TubeFitting(_Coupling, name="coupling/tube fitting", sizes=SMALL, grain="structure"):
    """A tube fitting (ISO 8434-1): a hexagon body and a hexagon nut with a chamfer on each side."""

    turn: float = between(0, 1, "of the first nut about the pipe", "rad")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.4)
        nut, flats, gap = 1.1 * r + 0.008, 0.5 * r + 0.004, 0.4 * r + 0.003
        length, bored = 2 * (nut + gap) + flats, 0.99 * r if t.style.hollow else 0.0
        thread = barrel(1.1 * r, 0.5 * nut, length - 0.5 * nut, n)
        t.add(_ME, thread, prism(2.5 * r + 0.005, 6, nut + gap, nut + gap + flats), of="trim")
        cone = lathe(outline(1.12 * r, 0.0, 1.3 * r, 0.25 * nut), n, bored)
        one = [cone, prism(2.6 * r + 0.006, 6, 0.25 * nut, nut, bored, n)]
        for way in (t.spun("x", self.turn), t.at(length).moved(BACK)):
            way.add("nut", *one, of="trim", own=True, fine=False)
        return t.model(round(length, 9), "welded")


class RepairClamp(_Coupling, name="coupling/repair clamp", sizes=SIZES[4:]):
    """A repair clamp: a stainless shell round the pipe, drawn together along a bar by a row of bolts."""

    count: int = whole(2, 5, "bolts")
    bare: float = between(0.1, 0.4, "length of the pipe that it leaves bare", "m")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.1)
        count, width = self.count, 0.055 * self.count + 0.02
        length, thick = width + self.bare, 0.004 + 0.02 * r
        low, top = 0.5 * (length - width), r + thick
        t.add("pipe", pipe_x(t.dn, 0.0, length, t.style), own=False)
        t.add(_ME, barrel(top, low, low + width, n, r), of="trim")
        xs = [low + width * (k + 0.5) / count for k in range(count)]
        bars = [box((width, 0.014, 0.03), (0.5 * length, s * 0.016, top + 0.012)) for s in BOTH]
        webs = [box((0.02, 0.02, 0.016), (x, s * 0.03, top + 0.004)) for x in xs for s in BOTH]
        t.add(_ME, *bars, *webs, of="trim")
        for x in xs:
            way = at(x, 0, top + 0.017) @ spun("z", np.pi / 2)
            t.extend(bolting(1, 0.0, 0.01, -0.023, 0.023, t.style, _ME, way))
        return t.model(round(length, 9), "welded")


class PlasticSleeve(_Coupling, name="coupling/plastic sleeve", sizes=SIZES[:12]):
    """A plastic sleeve: glued with a lip at each end, or an electrofusion one with two terminals (ISO 4427-3)."""

    long: float = between(2.2, 3.6, "length, less 20 mm / radius of the pipe")
    glued: bool = chance(0.5, "glued, not welded by electrofusion")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.2)
        length, outer = self.long * r + 0.02, 1.2 * r + 0.002
        if self.glued:
            lip, wide = 0.1 * length, 1.08 * outer
            shape = outline(wide, 0.0, wide, lip, outer, lip, outer, length - lip, wide, length - lip, wide, length)
            t.add(_ME, lathe(shape, n, bore))
        else:
            thin, wide = 0.95 * outer, 1.1 * outer
            body = lathe(outline(thin, 0.0, wide, 0.15 * length, wide, 0.85 * length, thin, length), n, bore)
            pin = cylinder(0.006 + 0.03 * r, outer, 1.12 * outer + 0.014, 10)
            t.add(_ME, body, *(moved(pin, at(f * length)) for f in (0.22, 0.78)), of="rubber")
        return t.model(round(length, 9), "welded")


COUPLINGS = families_of(
    Grooved, ClampBand, SleeveBolts, CamLever, Claw, Quick, FlangeAdaptor, HygienicClamp, PlasticCompression,
    TubeFitting, RepairClamp, PlasticSleeve,
)  # fmt: skip
