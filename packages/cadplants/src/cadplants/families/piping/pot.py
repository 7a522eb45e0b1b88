"""Strainers with an upright pot: tee, basket, duplex, dirt separator, self-cleaning; along x from 0."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance
from cadplants.builder.table import Table, outline
from cadplants.families.piping.shape import (
    BACK,
    UP,
    Fitting,
    barrel,
    bolting,
    lathe,
    mouth,
    necks,
    prism,
    sized,
    swell_room,
)
from cadplants.model.family import Model
from cadplants.model.standards import SIZES, sizes_between
from cadplants.parts.flange import plate_thickness
from cadplants.solids.mesh_ops import merge, moved
from cadplants.solids.primitives import BOTH, around, box, cylinder, dome, hexagon, rod, torus, turned
from cadplants.solids.transforms import at, spun

__all__ = ["POTS", "Strainer"]

_ME = "strainer"
_POT, _LOW = "radius of its pot, less {} / radius of the pipe", "depth of its pot / radius of the pot"


class Strainer(Fitting, bundle=_ME, weight=1.0, grain="structure"):
    """A strainer in a line."""


class Tee(Strainer, name="strainer/tee", sizes=SIZES[3:]):
    """A T strainer: a welded or cast tee with flanges in the line, a lid with handles on its upright mouth."""

    wide: float = between(1.0, 1.5, "radius of its pot / radius of the flanges' necks")
    low: float = between(1.0, 1.6, _LOW)

    def build(self, t: Table) -> Model:
        (_, n, _), rim, plate = sized(t.dn, t.style), 0.5 * t.flange.outer, plate_thickness(t.dn)
        wide, room = self.wide * 0.485 * t.flange.hub, swell_room(t.dn)
        length, high = max(2 * rim, 2.6 * wide) + 2 * room, max(rim, wide) + room + 0.02
        collar, low, under = max(rim, 1.35 * wide + 0.015), -self.low * wide, high - plate
        x, bottom = 0.5 * length, low - 0.3 * wide
        pot = outline(0.5 * wide, bottom, wide, low, wide, under, collar, under, collar, high)
        t.add(_ME, *necks(t.dn, t.style, length), moved(turned(pot, n), at(x)))
        lid, way = t.at(x, 0, high).moved(UP), at(x, 0, high) @ UP
        lid.add("gasket", barrel(0.75 * collar, 0.0, 0.002, n))
        lid.add(_ME, barrel(collar, 0.002, 0.002 + plate, n))
        count, thread = 8 if t.dn > 80 else 6, 0.06 * collar + 0.006
        t.extend(bolting(count, 0.86 * collar, thread, -plate, plate + 0.002, t.style, _ME, way))
        a = np.linspace(0, np.pi, 7)
        for s in BOTH:
            y = np.full(7, s * 0.3 * collar)
            path = np.column_stack([x + 0.05 * np.cos(a), y, high + plate + 0.045 * np.sin(a)])
            t.add(_ME, *(rod(p, q, 0.006, 8) for p, q in zip(path[:-1], path[1:], strict=True)), of="handle")
        drain = t.at(x, 0, low - 0.25 * wide).spun("y", np.pi / 2)
        drain.add(_ME, barrel(0.014, 0.0, 0.05, 12))
        drain.add("pipe cap", prism(0.03, 6, 0.05, 0.065), of="trim")
        return t.model(round(length, 9))


class Basket(Strainer, name="strainer/basket on legs", sizes=sizes_between(most=200)[3:]):
    """A basket strainer on three legs: a tall pot, a lid under swing bolts or a yoke with a hand screw."""

    pot: float = between(1.8, 2.6, _POT.format("30 mm"))
    low: float = between(2.2, 3.6, _LOW)
    domed: bool = chance(0.5, "a dome on its lid")
    swung: bool = chance(0.55, "swing bolts, not a yoke with a hand screw")
    bolts: int = among((4, 6), "swing bolts", when=lambda p: p.swung, otherwise=0)

    def build(self, t: Table) -> Model:
        r, pot = t.pipe.radius, self.pot * t.pipe.radius + 0.03
        n, length, wide = t.n(pot), 2 * pot + 2 * swell_room(t.dn) + 0.04, 1.22 * pot
        x, high = 0.5 * length, max(1.4 * r, 0.5 * t.flange.outer) + 0.04
        low, thick = -self.low * pot, 0.012 + 0.06 * pot
        t, under, over = t.at(x), high - thick, high + thick
        shell = outline(0.3 * pot, low - 0.3 * pot, 0.8 * pot, low - 0.18 * pot, pot, low, pot, under, wide, under)
        out = mouth("flanged", t.dn, t.style, 0.4 * pot, 0.5 * length)
        t.add(_ME, turned([*shell, (wide, high)], n), out, moved(out, BACK), of="tank")
        lid = [cylinder(wide, high, over, n)]
        if self.domed:
            lid.append(dome(0.85 * pot, 0.3 * pot, high + 0.9 * thick, n))
        t.add(_ME, *lid, of="tank")
        if self.swung:
            a, b = high - 2 * thick, high + 1.8 * thick
            eye = moved(
                torus(0.09 * pot + 0.008, 0.025 * pot + 0.003, 12, 6), at(0, 0, b + 0.1 * pot) @ spun("x", np.pi / 2)
            )
            t.add("bolt", around(merge([cylinder(0.03 * pot + 0.004, a, b, 8), eye]), self.bolts, 1.16 * pot, 0.4))
        else:
            self._yoke(t, pot, over + 0.55 * pot, high - 2 * thick, over)
        leg = merge(
            [
                box((0.05, 0.008, 0.9 * pot + 0.1), (0, 0, low - 0.45 * pot)),
                box((0.09, 0.09, 0.01), (0, 0, low - 0.9 * pot - 0.055)),
            ]
        )
        for k in range(3):
            t.spun("z", 0.5 + 2 * np.pi * k / 3).at(pot).add("tank leg", leg, own=True)
        return t.model(round(length, 9))

    def _yoke(self, t: Table, pot: float, top: float, low: float, lid: float) -> None:
        """A yoke over the lid, its beam on a height, its posts from another, and the hand screw in it [m]."""
        beam = box((0.22 * pot, 2.7 * pot, 0.18 * pot), (0, 0, top))
        post = (0.2 * pot, 0.1 * pot, top - low)
        posts = [box(post, (0, s * 1.3 * pot, 0.5 * (top + low))) for s in BOTH]
        screw = cylinder(0.07 * pot, lid, top + 0.45 * pot, 10)
        bar = rod((-0.6 * pot, 0, top + 0.4 * pot), (0.6 * pot, 0, top + 0.4 * pot), 0.04 * pot, 8)
        t.add(_ME, beam, *posts, screw, bar, of="handle")


class Duplex(Strainer, name="strainer/duplex", sizes=sizes_between(most=200)[2:]):
    """A duplex strainer: two pots beside the line, a change-over valve with a lever, lids with T screws."""

    pot: float = between(1.6, 2.1, _POT.format("25 mm"))
    turn: float = among((0.5, -0.5, 0.25), "of its lever / half a turn")

    def build(self, t: Table) -> Model:
        r, pot = t.pipe.radius, self.pot * t.pipe.radius + 0.025
        n, length = t.n(pot), max(3.0 * pot, 2.6 * r + 0.06) + 2 * swell_room(t.dn)
        x, gap, wide = 0.5 * length, 1.35 * pot + 1.1 * r, 1.2 * pot
        high, low = 1.2 * r + 0.35 * pot + 0.02, -2.4 * pot
        top, under = high + 0.2 * pot, high - 0.15 * pot
        valve = moved(cylinder(1.6 * r + 0.01, -1.5 * r, top, n), at(x))
        cross = moved(barrel(1.1 * r, -gap, gap, n), at(x) @ spun("z", np.pi / 2))
        t.add(_ME, *necks(t.dn, t.style, length), valve, cross)
        shell = outline(0.5 * pot, low - 0.2 * pot, pot, low, pot, under, wide, under, wide, high)
        lid = [turned(outline(wide, high, wide, high + 0.14 * pot, 0.4 * pot, high + 0.3 * pot), n)]
        lid.append(cylinder(0.1 * pot, top, high + 0.8 * pot, 8))
        lid.append(rod((-0.6 * pot, 0, high + 0.75 * pot), (0.6 * pot, 0, high + 0.75 * pot), 0.06 * pot, 8))
        t = t.at(x)
        for s in BOTH:
            side = t.at(0, s * gap)
            side.add(_ME, turned(shell, n))
            side.add(_ME, *lid)
            side.add("pipe cap", hexagon(0.5 * pot, low - 0.38 * pot, low - 0.2 * pot), of="trim")
        end = top + 0.5 * r + 0.03
        t.add(_ME, cylinder(0.25 * r + 0.004, top, end, 10), of="trim")
        bar = box((0.18 + 3 * r, 0.03 + 0.2 * r, 0.012), (0.09 + 1.5 * r, 0, top + 0.4 * r + 0.02))
        hub = cylinder(0.5 * r + 0.008, top + 0.3 * r + 0.01, end, 12)
        t.spun("z", self.turn * np.pi).add("lever", hub, bar)
        return t.model(round(length, 9))


class DirtSeparator(Strainer, name="strainer/dirt separator", sizes=sizes_between(most=200)[3:]):
    """A dirt separator: an upright vessel with dished ends across the line, a drain cock, a vent or plug."""

    pot: float = between(1.7, 2.3, _POT.format("20 mm"))
    room: float = between(0.02, 0.1, "how far its mouths stand out more than they must", "m")
    tall: float = between(1.0, 2.2, "height over the axis, less 0.4 of the flange's diameter / radius of the pot")
    deep: float = between(1.5, 3.5, _LOW)
    split: bool = chance(0.5, "a bolted collar round its lower part")
    vented: bool = chance(0.5, "a vent on it, not a plug")

    def build(self, t: Table) -> Model:
        pot = self.pot * t.pipe.radius + 0.02
        n, length = t.n(pot), 2 * pot + 2 * swell_room(t.dn) + self.room
        x, tall, deep = 0.5 * length, self.tall * pot + 0.4 * t.flange.outer, self.deep * pot
        a, seam = np.linspace(0, np.pi / 2, 6), -deep * 0.6
        shell = [(max(0.05, np.sin(s)) * pot, -deep - 0.5 * pot * np.cos(s)) for s in a]
        shell += [(max(0.05, np.cos(s)) * pot, tall + 0.5 * pot * np.sin(s)) for s in a]
        body = [*necks(t.dn, t.style, length), moved(turned(shell, n), at(x))]
        if self.split:
            body.append(moved(cylinder(1.25 * pot, seam, seam + 0.03, n), at(x)))
        t.add(_ME, *body, of="tank")
        if self.split:
            way = at(x, 0, seam + 0.015) @ UP
            t.extend(bolting(12, 1.17 * pot, 0.012, -0.015, 0.015, t.style, _ME, way))
        low, high, t = -deep - 0.48 * pot, tall + 0.48 * pot, t.at(x)
        drain = [cylinder(0.012, low - 0.05, low, 10), hexagon(0.03, low - 0.075, low - 0.045)]
        t.add("valve body", *drain, of="trim", own=True)
        t.add("lever", box((0.09, 0.018, 0.004), (0.04, 0.02, low - 0.06)), own=True)
        vent = cylinder(0.02, high + 0.02, high + 0.07, 12)
        plug = hexagon(0.035, high + 0.012, high + 0.03)
        t.add("nipple", vent if self.vented else plug, cylinder(0.01, high, high + 0.022, 10), of="trim")
        return t.model(round(length, 9))


class SelfCleaning(Strainer, name="strainer/self-cleaning", sizes=sizes_between(most=200)[5:]):
    """A self-cleaning strainer: a housing with a bolted head, a gear motor on it and a flush outlet below."""

    pot: float = between(1.9, 2.6, _POT.format("40 mm"))
    low: float = between(1.6, 2.6, _LOW)
    motor: float = between(2.0, 3.2, "length of its motor / half the width of the gearbox")
    legs: int = among((0, 3, 4), "legs")

    def build(self, t: Table) -> Model:
        r, pot = t.pipe.radius, self.pot * t.pipe.radius + 0.04
        n, length, wide, cone = t.n(pot), 2 * pot + 2 * swell_room(t.dn) + 0.05, 1.2 * pot, 0.7 * pot
        x, plate, thin, low = 0.5 * length, 0.018 + 0.05 * pot, 0.25 * pot, -self.low * pot
        high = max(1.3 * r, 0.5 * t.flange.outer) + 0.05
        under, foot = high - plate, low - cone
        shell = outline(thin, foot - 0.08, thin, foot, pot, low, pot, under, wide, under, wide, high)
        t.add(_ME, *necks(t.dn, t.style, length), moved(turned(shell, n), at(x)), of="tank")
        t = t.at(x)
        lid, way = outline(wide, 0.0, wide, plate, 0.4 * pot, 1.4 * plate), at(0, 0, high) @ UP
        t.moved(way).add(_ME, lathe(lid, n), of="tank")
        count = 12 if t.dn > 80 else 8
        t.extend(bolting(count, 1.1 * pot, 0.012 + 0.02 * pot, -plate, plate, t.style, _ME, way))
        q, base = 0.35 * pot + 0.02, high + 1.4 * plate
        case = box((2.0 * q, 1.8 * q, 1.2 * q), (0, 0, base + 1.1 * q))
        t.add("gearbox", cylinder(0.7 * q, base, base + 0.5 * q, 14), case, of="motor")
        tall, on = self.motor * q, base + 1.7 * q
        motor = [cylinder(0.85 * q, on, on + tall, 20), cylinder(0.9 * q, on + tall, base + 2.1 * q + tall, 20)]
        t.add("motor", *motor, around(box((0.12 * q, 0.05 * q, 0.8 * tall), (0, 0, on + 0.45 * tall)), 16, 0.87 * q))
        t.add("terminal box", box((0.8 * q, 0.6 * q, 0.8 * q), (1.1 * q, 0, on + 0.5 * tall)))
        leg = box((0.05, 0.05, cone + 0.3), (0, 0, low - 0.5 * cone - 0.1))
        for k in range(self.legs):
            t.spun("z", 0.6 + 2 * np.pi * k / self.legs).at(0.97 * pot).add("tank leg", leg)
        return t.model(round(length, 9))


POTS = families_of(Tee, Basket, Duplex, DirtSeparator, SelfCleaning)
