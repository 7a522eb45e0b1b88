"""Expansion joints of further makes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import Params, among, between, chance, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.piping.shape import (
    BACK,
    Fitting,
    barrel,
    bolting,
    drilled,
    flat_flange,
    lathe,
    pipe_x,
    prism,
    sized,
)
from cadplants.model.family import Model
from cadplants.model.standards import SIZES
from cadplants.parts.flange import plate_thickness
from cadplants.solids.mesh_ops import Solid, merge, moved
from cadplants.solids.polygon import circle
from cadplants.solids.primitives import BOTH, box, torus, waves
from cadplants.solids.transforms import at, spun

__all__ = ["FLEXIBLES"]

_ME = "expansion joint"
_FLIP = np.diag([-1.0, 1.0, 1.0, 1.0])
_END, _LONG = "length of an end, less {} / radius of the pipe", "length of {}, less {} / radius of the pipe"


class _Joint(Fitting, bundle=_ME):
    """An expansion joint."""

    def pipe(self, t: Table, low: float, high: float) -> None:
        """A piece of pipe between two places [m]."""
        t.add("pipe", pipe_x(t.dn, low, high, t.style), own=False)


def _ways(t: Table, length: float) -> tuple[Table, Table]:
    """The frame at the near end and, mirrored, at the far end of something this long [m]."""
    return t, t.at(length).moved(_FLIP)


class RubberSphere(_Joint, name="expansion joint/rubber sphere", weight=1.0, grain="structure"):
    """A rubber sphere, single or double, between loose flanges (EN 15016 practice), with or without control rods."""

    spheres: int = among((1, 1, 2), "spheres")
    ringed: bool = chance(0.7, "a ring between two spheres", when=lambda p: p.spheres == 2)
    tied: bool = chance(0.45, "control rods")
    rods: int = among((2, 3, 4), "control rods", when=lambda p: p.tied, otherwise=0)

    def build(self, t: Table) -> Model:
        (r, n, bore), plate = sized(t.dn, t.style, 1.5), plate_thickness(t.dn)
        depth, long = 0.35 * r + 0.012, (0.9 * r + 0.06) * (1.0 if self.spheres == 1 else 1.7)
        length, low, neck, bead = 2 * (plate + 0.012) + long, plate + 0.008, 1.08 * r, 1.35 * r + 0.004
        a, one = np.linspace(0, np.pi, 7), long / self.spheres
        shape = outline(bead, 0.0, bead, 0.004, neck, 0.0045, neck, low)
        for k in range(self.spheres):
            start = low + long * k / self.spheres
            shape += [
                (neck + depth * float(np.sin(s)), start + 0.004 + (one - 0.008) * float(1 - np.cos(s)) / 2) for s in a
            ]
        shape += outline(neck, length - low, neck, length - 0.0045, bead, length - 0.004, bead, length)
        ring = moved(torus(1.12 * r + 0.004, 0.06 * r + 0.004, n, 8), at(0.5 * length) @ spun("y", np.pi / 2))
        t.add(_ME, lathe(shape, n, bore), *([ring] if self.ringed else []), of="rubber")
        loose = flat_flange(t.dn, t.style, 0.0045, plate - 0.0045, 1.081 * r)
        for end in _ways(t, length):
            end.add("flange", loose)
        if self.tied:
            self._ties(t, 0.5 * plate, 0.7 * plate, length)
        return t.model(round(length, 9))

    def _ties(self, t: Table, x: float, thick: float, length: float) -> None:
        """Ears for control rods at both ends, beyond the flanges' rims, and the rods with their nuts."""
        rim, count = t.flange.outer / 2, self.rods
        bolt = 0.005 + 0.05 * rim
        reach, far = rim + 1.6 * bolt, rim + 3.1 * bolt
        ear = box((thick, far - 0.93 * rim, 3 * bolt), (x, 0.5 * (far + 0.93 * rim), 0))
        ears = merge([moved(ear, spun("x", 2 * np.pi * k / count)) for k in range(count)])
        for end in _ways(t, length):
            end.add(_ME, ears, of="steel")
        low, high = x - 0.5 * thick, length - x + 0.5 * thick
        t.extend(bolting(count, reach, bolt, low, high, t.style, _ME, at(), 0.0))


class Bellows(Params):
    """Metal bellows with collars at both ends."""

    depth: float = between(0.15, 0.35, "of a wave, less 4 mm / radius of the pipe")

    def solid(self, t: Table, low: float, high: float) -> Solid:
        """They from one place to another along x [m]."""
        r, n, _ = sized(t.dn, t.style, 1.3)
        depth, inner, cuff = self.depth * r + 0.004, 1.02 * r, 0.06 * (high - low)
        count = max(2, min(10, int((high - low) / (0.25 * r + 0.008))))
        swing = waves(low + cuff, high - cuff, inner, inner + depth, count)
        return lathe([(inner, low), *swing, (inner, high)], n)


class Hinged(_Joint, name="expansion joint/hinged", sizes=SIZES[4:]):
    """Bellows between pipe ends with a hinge: pairs of arms on rings and pins (EJMA)."""

    end: float = between(0.8, 1.5, _END.format("50 mm"))
    long: float = between(1.0, 1.8, _LONG.format("the bellows", "30 mm"))
    bellows: Bellows = nested(Bellows, "bellows")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.5)
        end, long = self.end * r + 0.05, self.long * r + 0.03
        length, mid, outer = 2 * end + long, end + 0.5 * long, 1.5 * r + 0.02
        self.pipe(t, 0.0, end)
        t.add(_ME, self.bellows.solid(t, end, end + long))
        thick, wide, seat = 0.008 + 0.06 * r, 0.5 * r + 0.02, 0.75 * end
        plate, tip = barrel(outer, seat - thick, seat, n, 0.99 * r), mid + 0.5 * wide
        arms = []
        for s in BOTH:
            arms.append(box((tip - seat, thick, wide), (0.5 * (tip + seat), s * (outer + 0.5 * thick), 0)))
            stub = (2 * thick, outer - 0.9 * r, wide)
            arms.append(box(stub, (seat - 0.5 * thick, s * 0.5 * (outer + 1.1 * r), 0)))
        t.add(_ME, plate, *arms, of="steel")
        self.other(t, length, outer, thick, wide, [plate, *arms])
        a, b = 0.2 * wide, 0.3 * wide
        pin = lathe(outline(a, -2.2 * thick, a, 1.5 * thick, b, 1.5 * thick, b, 2.1 * thick), 10)
        for turn in self.pins():
            way = t.at(mid).spun("x", turn * np.pi).at(0, outer).spun("z", np.pi / 2)
            way.add("bolt", pin, fine=False, own=True)
        self.pipe(t, length - end, length)
        return t.model(round(length, 9), "welded")

    def other(self, t: Table, length: float, outer: float, thick: float, wide: float, one: Sequence[Solid]) -> None:
        """The other side: its arms lie within those of the one side [m]."""
        within = np.diag([1.0, (outer - thick) / outer, 1.0, 1.0])
        t.at(length).moved(BACK).add(_ME, one[0], *(moved(arm, within) for arm in one[1:]), of="steel")

    def pins(self) -> Sequence[float]:
        """Where its pins are, about the pipe / half a turn."""
        return (0.0, 1.0)


class Gimbal(Hinged, name="expansion joint/gimbal", sizes=SIZES[4:]):
    """Bellows between pipe ends with a gimbal: two pairs of arms on a ring between them, turned crosswise (EJMA)."""

    def other(self, t: Table, length: float, outer: float, thick: float, wide: float, one: Sequence[Solid]) -> None:
        """The gimbal ring, and the other side across the one side [m]."""
        mid, reach, half = 0.5 * length, outer - 0.001, 0.45 * wide
        t.add(_ME, barrel(reach, mid - half, mid + half, t.n(1.5 * t.pipe.radius), reach - 1.2 * thick), of="steel")
        t.at(length).moved(BACK).spun("x", np.pi / 2).add(_ME, *one, of="steel")

    def pins(self) -> Sequence[float]:
        """Where its pins are, about the pipe / half a turn."""
        return (0.0, 0.5, 1.0, 1.5)


class TiedUniversal(_Joint, name="expansion joint/tied universal", sizes=SIZES[4:]):
    """A tied universal expansion joint: two bellows with a pipe between them, end plates and long tie rods (EJMA)."""

    one: float = between(0.8, 1.3, _LONG.format("one bellows", "30 mm"))
    mid: float = between(1.5, 4.0, _LONG.format("the pipe between them", "50 mm"))
    bellows: Bellows = nested(Bellows, "bellows")
    rods: int = among((2, 3, 4, 4), "tie rods")
    plated: bool = chance(0.5, "round plates hold the rods, not lugs")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.5)
        end, one, mid = 0.8 * r + 0.05, self.one * r + 0.03, self.mid * r + 0.05
        length, thick, outer = 2 * (end + one) + mid, 0.01 + 0.07 * r, 1.75 * r + 0.03
        for a, b in ((0, end), (end + one, end + one + mid), (length - end, length)):
            self.pipe(t, a, b)
        x, bolt, inner = 0.7 * end, 0.01 + 0.05 * r, 0.95 * r
        far = outer + 1.5 * bolt
        if self.plated:
            plate = barrel(far, x - thick, x, n, 0.99 * r)
        else:
            lug = box((1.5 * thick, far - inner, 3.5 * bolt), (x - 0.5 * thick, 0.5 * (far + inner), 0))
            web = box((2.5 * thick, outer - inner, 0.5 * thick), (x - 0.2 * thick, 0.5 * (outer + inner), 0))
            lugs = merge([lug, web])
            plate = merge([moved(lugs, spun("x", 2 * np.pi * k / self.rods)) for k in range(self.rods)])
        bellows = self.bellows.solid(t, end, end + one)
        for side in _ways(t, length):
            side.add(_ME, bellows)
            side.add(_ME, plate, of="steel")
        low, high = x - 1.25 * thick, length - x + 1.25 * thick
        t.extend(bolting(self.rods, outer, bolt, low, high, t.style, _ME, at(), 0.0))
        return t.model(round(length, 9), "welded")


class Lens(_Joint, name="expansion joint/lens", sizes=SIZES[3:]):
    """A lens compensator: one to three high, sharp waves welded of dished discs."""

    count: int = whole(1, 3, "waves")
    high: float = between(0.5, 0.9, "height of a wave, less 15 mm / radius of the pipe")
    long: float = between(0.6, 1.0, _LONG.format("a wave", "10 mm"))

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.8)
        high, long, end = self.high * r + 0.015, self.long * r + 0.01, 0.3 * r + 0.02
        shape = outline(r, 0.0, r, end)
        wave = ((0.15, 0.2), (0.95, 0.42), (1.0, 0.5), (0.95, 0.58), (0.15, 0.8), (0.0, 1.0))
        for k in range(self.count):
            shape += [(r + up * high, end + k * 1.15 * long + share * long) for up, share in wave]
        length = end + self.count * 1.15 * long - 0.15 * long + end
        t.add(_ME, lathe([*shape, (r, length)], n, bore), of="pipe")
        return t.model(round(length, 9), "welded")


class Slip(_Joint, name="expansion joint/slip", sizes=SIZES[2:]):
    """A slip joint: a pipe sliding in a wider body through a stuffing box whose gland is drawn in by bolts."""

    slide: float = between(1.5, 3.5, _LONG.format("the pipe before it", "60 mm"))
    body: float = between(2.0, 4.0, _LONG.format("its body", "0.1 m"))
    footed: bool = chance(0.5, "a foot under its body")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.6)
        slide, body, wide, flat, thick = (
            self.slide * r + 0.06,
            self.body * r + 0.1,
            1.25 * r + 0.008,
            1.75 * r + 0.03,
            0.012 + 0.06 * r,
        )
        length, seat = slide + body, slide + thick
        shape = outline(flat, slide, flat, seat, wide, seat, wide, length - 0.6 * r - 0.02, r, length - 0.1 * r - 0.01)
        low, high, thin = slide - 2 * thick, slide - thick, 1.15 * r
        self.pipe(t, 0.0, slide + 0.2 * body)
        t.add(_ME, lathe([*shape, (r, length)], n, bore), of="valve")
        t.add(_ME, lathe(outline(flat, low, flat, high, thin, high, thin, slide), n, r), of="valve")
        count, circle_ = (4 if t.dn < 100 else 8), 0.5 * (flat + wide) + 0.004
        t.extend(bolting(count, circle_, 0.1 * r + 0.006, low, seat, t.style, _ME))
        if self.footed:
            x = slide + 0.6 * body
            foot = box((0.25 * body, 1.6 * wide, 0.5 * wide), (x, 0, -1.2 * wide))
            t.add("bracket", foot, box((0.4 * body, 2.2 * wide, 0.012), (x, 0, -1.45 * wide)))
        return t.model(round(length, 9), "welded")


class Fabric(_Joint, name="expansion joint/fabric", sizes=SIZES[6:]):
    """A fabric expansion joint: a wide belt of cloth clamped by flat bars with many bolts on two frames."""

    wide: float = between(0.9, 1.6, "width of its belt, less 0.1 m / radius of the pipe")
    sag: float = among((-0.04, 0.05, 0.1), "how far its belt stands out / radius of the pipe")
    bolts: int = whole(6, 12, "bolts of a bar")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.5)
        end, wide, out, bar, sag = 0.4 * r + 0.03, self.wide * r + 0.1, 1.3 * r + 0.03, 0.03 + 0.05 * r, self.sag * r
        length, frame = 2 * end + wide, 0.97 * out
        belt = outline(out, end + 0.001, out + sag, end + 0.3 * wide, out + 1.2 * sag, length / 2)
        belt += outline(out + sag, length - end - 0.3 * wide, out, length - end - 0.001)
        skin = lathe(outline(r, 0.0, r, end, frame, end, frame, end + bar), n, bore)
        skin = merge([skin, barrel(1.12 * out, end - 0.008, end, n, 0.99 * r)])
        band = barrel(1.03 * out, end + 0.002, end + bar, n, 0.999 * out)
        ways = [
            spun("x", 2 * np.pi * k / self.bolts) @ at(0, 1.028 * out) @ spun("z", np.pi / 2) for k in range(self.bolts)
        ]
        heads = merge([moved(prism(0.014, 6, 0.0, 0.01), at(end + 0.5 * bar) @ way) for way in ways])
        for k, side in enumerate(_ways(t, length)):
            side.add("flange", skin, own=False)
            if not k:
                t.add(_ME, lathe(belt, n, 0.9 * out), of="rubber")
            side.add("clamp", band)
            side.add("bolt", heads, own=False)
        return t.model(round(length, 9), "welded")


class Dismantling(_Joint, name="expansion joint/dismantling", sizes=SIZES[5:], grain="structure"):
    """A dismantling joint (AWWA C219): a flanged body and a flanged spigot in it, a ring between, long tie rods."""

    long: float = between(0.16, 0.24, "length, less 0.6 of the pipe's radius", "m")
    mid: float = between(0.45, 0.6, "where its ring is / length")
    step: int = among((1, 2), "bolt holes from rod to rod")

    def build(self, t: Table) -> Model:
        (r, n, bore), size, plate = sized(t.dn, t.style, 1.4), t.flange, plate_thickness(t.dn)
        length, wide, bolt = self.long + 0.6 * r, 1.2 * r + 0.006, size.bolt
        mid, far = self.mid * length, length - plate
        body = lathe(outline(wide, plate, wide, mid - 0.01, 1.35 * r + 0.008, mid), n, r)
        t.add(_ME, flat_flange(t.dn, t.style, 0.0, plate, bore), body, of="valve")
        turns = (2 * np.arange(size.n_bolts) + 1) * np.pi / size.n_bolts
        spots = size.circle / 2 * np.column_stack([np.cos(turns), np.sin(turns)])
        rim = circle(size.outer / 2, t.n(size.outer / 2))
        t.add(_ME, drilled(rim, mid, mid + plate, r, spots, size.hole / 2, t.style, n), of="valve")
        spigot = barrel(r, 0.3 * mid, far, n, bore)
        t.add(_ME, flat_flange(t.dn, t.style, far, plate, bore), spigot, of="valve")
        places = (plate, mid - 0.8 * bolt, mid + plate, far - 0.8 * bolt)
        nuts = [prism(1.6 * bolt, 6, x, x + 0.8 * bolt) for x in places]
        one = merge([barrel(bolt / 2, plate, far, 8), *nuts])
        studs = [moved(one, spun("x", float(turn)) @ at(0, size.circle / 2)) for turn in turns[:: self.step]]
        t.add_each("stud", studs, joined=t.style.fasteners in ("set", "flange"))
        return t.model(round(length, 9))


class GuideTube(_Joint, name="expansion joint/guide tube", sizes=SIZES[2:]):
    """An axial expansion joint in a guide tube: a long can round the bellows, rings at its ends, a drain boss."""

    end: float = between(0.8, 2.0, _END.format("40 mm"))
    can: float = between(2.5, 5.0, _LONG.format("its can", "0.1 m"))
    drained: bool = chance(0.6, "a drain boss under its can")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.6)
        end, can, wide = self.end * r + 0.04, self.can * r + 0.1, 1.4 * r + 0.012
        length = 2 * end + can
        self.pipe(t, 0.0, length)
        caps = [barrel(1.06 * wide, a, a + 0.01, n, r) for a in (end - 0.004, end + can - 0.006)]
        t.add(_ME, barrel(wide, end, end + can, n, r), *caps, of="pipe")
        if self.drained:
            boss = [barrel(0.012, 0.9 * wide, wide + 0.02, 12), prism(0.026, 6, wide + 0.02, wide + 0.034)]
            t.at(end + 0.2 * can).spun("y", np.pi / 2).add(_ME, *boss, of="pipe")
        return t.model(round(length, 9), "welded")


FLEXIBLES = families_of(RubberSphere, Hinged, Gimbal, TiedUniversal, Lens, Slip, Fabric, Dismantling, GuideTube)
