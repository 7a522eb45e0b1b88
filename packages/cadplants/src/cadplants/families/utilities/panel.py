"""Control panels and junction boxes: suites, wall boxes, consoles, push buttons, isolators, boxes of many makes."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import made, of_form, one_of, yes
from cadplants.builder.params import Params, among, between, chance, given, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.utilities.mounting import Utility, gland, h_column, pole, wall
from cadplants.model.family import Family, Model
from cadplants.solids.mesh_ops import Solid, about_x, extrude, merge, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import (
    BOTH,
    CORNERS,
    along,
    around,
    box,
    cylinder,
    dome,
    hexagon,
    rod,
    rope,
    torus,
    turned,
)
from cadplants.solids.transforms import at, spun

__all__ = ["PANELS"]

_CP, _JB = "control panel", "junction box"


class _Panel(Utility, bundle=_CP, grain="structure"):
    """A control panel."""


def _lights(x: float, y: float, z: float, count: int, pitch: float) -> list[Solid]:
    """Pilot lights and buttons in a row on a front that looks to -y."""
    one = merge([cylinder(0.011, -0.002, 0.016, 10), cylinder(0.015, -0.002, 0.006, 12)])
    return [along("-y", one, x + (k - (count - 1) / 2) * pitch, y, z) for k in range(count)]


def _closed(p: Any) -> bool:
    return not p.drawers


class _Cubicle(Params):
    """What is on the front of a cubicle: drawers, or a door with a swing handle."""

    drawers: bool = given(False, "it has drawers, no door")
    tiers: int = whole(4, 8, "drawers", when=lambda p: p.drawers)
    lights: int = whole(1, 4, "pilot lights on the door", when=_closed)
    plated: bool = chance(0.5, "a plate on the door", when=_closed)
    vented: bool = chance(0.5, "slots in the door", when=_closed)
    metered: bool = chance(0.4, "two meters on the door", when=_closed)

    def build(self, t: Table, w: float, low: float, h: float) -> None:
        """Puts it down before y = 0, on a cubicle this wide from a plinth up to a height [m]."""
        step = (h - low - 0.1) / max(self.tiers, 1)
        levels = [low + 0.05 + (q + 0.5) * step for q in range(self.tiers)]
        fronts = [box((0.94 * w, 0.015, 0.92 * step), (0, -0.0075, z)) for z in levels]
        bits = []
        for z in levels:
            bits += [along("-y", cylinder(0.02, 0, 0.03, 12), 0.3 * w, -0.014, z)]
            bits += [box((0.01, 0.02, 0.05), (0.3 * w, -0.05, z))]
        if not self.drawers:
            fronts = [box((0.95 * w, 0.018, h - low - 0.08), (0, -0.009, (h + low) / 2))]
            bits = [box((0.025, 0.03, 0.16), (0.4 * w, -0.031, low + 0.5 * (h - low)))]
            bits += _lights(0, -0.018, h - 0.45, self.lights, 0.07)
        if self.plated:
            bits.append(box((0.5 * w, 0.006, 0.3 * w), (0, -0.02, h - 0.7)))
        if self.vented:
            bits += [box((0.5 * w, 0.012, 0.008), (0, -0.022, low + 0.2 + 0.025 * q)) for q in range(8)]
        if self.metered:
            bits += [box((0.096, 0.02, 0.096), (s * 0.15 * w, -0.026, h - 0.25)) for s in BOTH]
        t.add(_CP, *fronts)
        t.add(_CP, *bits, of="rubber")


class Suite(_Panel, name="control panel/suite", weight=1.2):
    """A suite of cubicles on a plinth (IEC 61439): doors with swing handles, meters, vents, a roof, lifting eyes."""

    count: int = whole(2, 5, "cubicles")
    width: float = among((0.4, 0.6, 0.8), "of a cubicle", "m")
    depth: float = among((0.4, 0.6, 0.8), "of a cubicle", "m")
    height: float = among((1.8, 2.0, 2.2), "of the suite", "m")
    plinth: float = among((0.1, 0.2), "height of the plinth", "m")
    drawers: bool = chance(0.35, "all but the first cubicle have drawers")
    first: _Cubicle = nested(_Cubicle, "first cubicle")
    others: tuple[_Cubicle, ...] = several(
        made(_Cubicle, lambda p: {"drawers": p.drawers}), lambda p: p.count - 1, "other cubicles"
    )
    top: str = among(("eyes", "roof", "fan", "plain"), "what is on it")

    def build(self, t: Table) -> Model:
        count, w, d, h, low = self.count, self.width, self.depth, self.height, self.plinth
        middle = (count - 1) * w / 2
        t.add(_CP, box((count * w - 0.02, d - 0.05, low), (middle, 0.0, low / 2)), of="rubber")
        for k, cubicle in enumerate((self.first, *self.others)):
            t.add(_CP, box((w - 0.003, d, h - low), (k * w, 0, (h + low) / 2)))
            cubicle.build(t.at(k * w, -d / 2), w, low, h)
        if self.top == "roof":
            t.add(_CP, box((count * w + 0.06, d + 0.1, 0.04), (middle, 0, h + 0.02)))
        elif self.top == "eyes":
            eye = moved(torus(0.02, 0.005, 12, 6), spun("x", np.pi / 2))
            spots = [(k * w + s * (w / 2 - 0.05), q * (d / 2 - 0.05)) for k in range(count) for s, q in CORNERS]
            rings = [moved(eye, at(*spot, h + 0.024)) for spot in spots]
            t.add("lifting lug", *rings, of="fastener", fine=True)
        elif self.top == "fan":
            t.add(_CP, *(box((0.3, 0.3, 0.08), (k * w, 0, h + 0.04)) for k in range(0, count, 2)))
        return t.model()


class _Entry(Params):
    """A gland below a box, with what comes into it."""

    radius: float = among((0.008, 0.0107, 0.0134), "of the cable or conduit", "m")
    cable: bool = chance(0.5, "a cable comes in, no conduit")


class WallBox(_Panel, name="control panel/wall box", weight=1.2):
    """A wall box, maybe with a rain roof: one or two doors, hinges, main switch, lamps, glands and conduits below."""

    width: float = between(0.25, 0.9, "of the box", "m")
    tall: float = between(0.3, 1.1, "height of the box", "m")
    depth: float = between(0.15, 0.3, "of the box", "m")
    level: float = between(0.9, 1.3, "of the box over the floor", "m")
    rounding: float = among((0.0, 0.02), "radius of its corners", "m")
    double: bool = chance(0.7, "it has two doors", when=lambda p: p.width > 0.65)
    lights: int = whole(1, 4, "pilot lights")
    front: str = among(("switch", "plate", "slots"), "what else is on the door")
    roofed: bool = chance(0.35, "a rain roof")
    count: int = whole(0, 4, "glands")
    entries: tuple[_Entry, ...] = several(made(_Entry), lambda p: p.count, "glands")
    walled: bool = chance(0.5, "it is on a wall, not on two posts")

    def build(self, t: Table) -> Model:
        w, h, d, z = self.width, self.tall, self.depth, self.level
        mid = t.at(0, -0.02, z + h / 2)
        mid.spun("x", np.pi / 2).add(_CP, extrude(rounded_rectangle(w, h, self.rounding, 2), 0.0, d))
        leaf = w / (1 + self.double)
        spots = (-leaf / 2, leaf / 2) if self.double else (0.0,)
        mid.add(_CP, *(box((0.97 * leaf, 0.018, 0.97 * h), (x, -d - 0.009, 0)) for x in spots))
        t.at(0, -0.02 - d - 0.018, z).add(_CP, *self._bits(), of="rubber")
        if self.roofed:
            out, low, high = -d - 0.1, h / 2, h / 2 + 0.09
            roof = np.array(outline(0.02, high, 0, high, out, low + 0.008, out, low, 0.02, low))
            mid.add(_CP, about_x(extrude(roof, -w / 2 - 0.04, w / 2 + 0.04)))
        for k, entry in enumerate(self.entries):
            q, here = entry.radius, t.at((k - (self.count - 1) / 2) * 0.8 * w / self.count, -0.02 - d / 2)
            here.at(0, 0, z).add(_CP, gland(q), of="rubber")
            line = rod((0, 0, z - 2.2 * q), (0, 0, 0.1), q, 8)
            here.add("cable" if entry.cable else "conduit", line, of="rubber", own=False)
        for q in (0.1, 0.9):
            t.add("bracket", box((w + 0.1, 0.02, 0.04), (0, -0.01, z + q * h)), of="clamp")
        if self.walled:
            t.extend([wall(-w - 0.2, w + 0.2, z + h + 0.4)])
        for s in () if self.walled else BOTH:
            t.add("post", box((0.05, 0.05, z + h), (s * 0.45 * w, 0.025, (z + h) / 2)), of="clamp")
        return t.model()

    def _bits(self) -> list[Solid]:
        """What is on its doors, whose front is at y = 0."""
        w, h, x = self.width, self.tall, 0.004 - self.width / 2
        bits = [rod((x, 0.006, q * h - 0.03), (x, 0.006, q * h + 0.03), 0.007, 8) for q in (0.15, 0.85)]
        bits += _lights(0, 0, 0.8 * h, self.lights, 0.05)
        if self.front == "switch":
            bits += [box((0.07, 0.01, 0.07), (0.25 * w, -0.005, 0.5 * h))]
            bits += [along("-y", cylinder(0.025, 0, 0.03, 16), 0.25 * w, -0.009, 0.5 * h)]
            bits += [box((0.012, 0.02, 0.06), (0.25 * w, -0.045, 0.5 * h))]
        elif self.front == "plate":
            bits.append(box((0.45 * w, 0.008, 0.3 * h), (0, -0.004, 0.5 * h)))
        else:
            bits += [box((0.4 * w, 0.012, 0.008), (0, -0.004, 0.12 * h + 0.02 * q)) for q in range(6)]
        return bits + [along("-y", cylinder(0.012, -0.002, 0.012, 10), 0.43 * w, 0, q * h) for q in (0.3, 0.7)]


def _on_mast(p: Any) -> bool:
    return bool(p.pedestal)


def _desk(p: Any) -> bool:
    return not p.pedestal


class Console(_Panel, name="control panel/console"):
    """A console: desk with sloping top and upright back in one to three bays, or a pedestal with a screen on an arm."""

    pedestal: bool = chance(0.35, "a pedestal with a screen, no desk")
    screen: float = between(0.3, 0.6, "width of the pedestal's screen", "m", when=_on_mast)
    mast: float = between(1.0, 1.3, "height of the pedestal", "m", when=_on_mast)
    tilt: float = between(0.2, 0.7, "of the pedestal's screen", "rad", when=_on_mast)
    bays: int = whole(1, 3, "bays", when=_desk)
    width: float = among((0.6, 0.8, 1.0), "of a bay", "m", when=_desk, otherwise=0.0)
    height: float = between(0.7, 0.85, "of the desk's front edge", "m", when=_desk)
    depth: float = between(0.7, 0.95, "of the desk", "m", when=_desk)
    top: float = between(1.1, 1.5, "height of the back", "m", when=_desk)
    slope: float = between(0.1, 0.2, "rise of the desk's top", "m", when=_desk)
    back: float = between(0.15, 0.25, "depth of the back", "m", when=_desk)
    knobs: tuple[int, ...] = several(one_of(1, 2), lambda p: p.bays, "rows of knobs on a bay", when=_desk)

    def build(self, t: Table) -> Model:
        if self.pedestal:
            w, z = self.screen, self.mast
            mast = [cylinder(0.03, 0.02, z, t.n(0.04)), cylinder(0.2, 0, 0.02, t.n(0.2))]
            t.add(_CP, *mast, box((0.06, 0.08, 0.1), (0, -0.02, z + 0.03)), of="clamp")
            screen = box((0.88 * w, 0.006, 0.55 * w), (0, -0.042, 0.03 * w))
            head = t.at(0, -0.07, z + 0.06).spun("x", -self.tilt)
            head.add(_CP, box((w, 0.08, 0.7 * w)), screen, *_lights(0, -0.04, -0.29 * w, 4, 0.15 * w))
            return t.model()
        w, high, far, top, slope = self.width, self.height, self.depth / 2, self.top, self.slope
        near, edge = far - self.back, far - self.back - 0.08
        plan = outline(0.15 - far, 0, far, 0, far, top, near, top, edge, high + slope)
        plan += outline(-far, high, -far, high - 0.12, 0.15 - far, high - 0.2)
        rise = float(np.arctan2(slope, far + edge))
        one = merge([cylinder(0.012, -0.004, 0.016, 10), cylinder(0.016, -0.004, 0.005, 12)])
        knobs = merge([moved(one, at((i - 2) * 0.16 * w)) for i in range(5)])
        screen = box((0.7 * w, 0.02, 0.25), (0, near - 0.045, (high + slope + top) / 2 + 0.02))
        for k, rows in enumerate(self.knobs):
            here = t.at(k * (w + 0.001))
            here.add(_CP, about_x(extrude(np.array(plan), -w / 2, w / 2)))
            spots = [(0, (edge - far) / 2 + q, high + slope / 2 + q * np.tan(rise)) for q in (-0.1, 0.02)[:rows]]
            here.add(_CP, *(moved(knobs, at(*spot) @ spun("x", rise)) for spot in spots), screen, of="rubber")
            here.add(_CP, box((0.9 * w, 0.012, high - 0.35), (0, 0.144 - far, (high - 0.2) / 2)))
        return t.model()


_several = of_form("buttons", "pendant")
_isolates = of_form("isolator")


class LocalStation(_Panel, name="control panel/local station", weight=1.5):
    """A local station: push buttons, an emergency stop, or an isolator with its handle; on a post or a wall."""

    form: str = among(("buttons", "stop", "isolator", "pendant"), "what it is")
    level: float = between(1.0, 1.4, "of its middle over the floor", "m")
    count: int = whole(2, 4, "buttons", when=_several, otherwise=1)
    width: float = between(
        lambda p: 0.12 if _isolates(p) else 0.065, lambda p: 0.28 if _isolates(p) else 0.09, "of the box", "m"
    )
    tall: float = between(1.2, 1.8, "height of an isolator / width", when=_isolates)
    depth: float = between(0.06, 0.1, "of a box with buttons", "m", when=lambda p: not _isolates(p))
    stopped: bool = chance(0.4, "its lowest button is an emergency stop", when=_several)
    heads: tuple[float, ...] = several(
        one_of(0.01, 0.018), lambda p: p.count - p.stopped, "how far a button stands out", "m", when=_several
    )
    walled: bool = chance(0.4, "it is on a wall")
    hooded: bool = chance(0.4, "it is under a hood on a post, not on a column", when=lambda p: not p.walled)

    def build(self, t: Table) -> Model:
        w, z, isolator = self.width, self.level, _isolates(self)
        h, d = (self.tall * w, 0.7 * w) if isolator else (0.05 + 0.045 * self.count, self.depth)
        front = t.at(0, 0, z).spun("x", np.pi / 2)
        front.add(_CP, extrude(rounded_rectangle(w, h, 0.12 * w, 3), 0.0, 0.7 * d))
        lid = extrude(rounded_rectangle(1.03 * w, 1.03 * h, 0.12 * w, 3), 0.7 * d, d)
        front.add(_CP, lid, of="safety")
        stop = turned(outline(0.01, -0.001, 0.01, 0.015, 0.02, 0.018, 0.02, 0.026, 0.014, 0.032), 16)
        bits = [stop] if self.stopped or self.form == "stop" else []
        bits += [merge([cylinder(0.015, -0.001, 0.006, 14), cylinder(0.011, -0.001, out, 12)]) for out in self.heads]
        solids = [along("-y", one, 0, -d, (k - (self.count - 1) / 2) * 0.045) for k, one in enumerate(bits)]
        if isolator:
            solids = [along("-y", cylinder(0.3 * w, 0, 0.1 * w, 20), 0, 0.001 - d)]
            solids += [box((0.14 * w, 0.16 * w, 0.55 * w), (0, -d - 0.17 * w, 0))]
        t.at(0, 0, z).add(_CP, *solids, of="handle")
        here, low = t.at(0, -0.5 * d), z - h / 2
        here.at(0, 0, low).add(_CP, gland(0.008), of="rubber")
        line = rope([(0, 0, low - 0.019), (0, 0, 0.3), (0.05, 0, 0.1), (0.1, 0, 0.05)], 0.007, 8)
        here.add("cable", line, own=False)
        if self.walled:
            t.extend([wall(-0.5, 0.5, z + 0.6)])
        elif self.hooded:
            hood = box((1.4 * w, 1.6 * d, 0.004), (0, -0.6 * d, z + h / 2 + 0.03))
            t.add("bracket", hood, box((1.4 * w, 0.004, h + 0.1), (0, 0.002, z)), of="clamp")
            t.at(0, 0.029).extend(pole(z + h, 0.025, t.style, True))
        else:
            t.extend([h_column(z + 0.8)])
        return t.model()


class _Terminal(Params):
    """A terminal box whose back is at y = 0 and whose lid looks to -y; glands below or hubs around."""

    form: str = among(("flameproof", "hubs", "plastic", "pull", "dome"), "its make")
    size: float = between(0.1, 0.26, "width", "m")
    depth: float = between(0.5, 0.8, "depth / width")
    hubs: int = whole(2, 4, "hubs besides the lowest", when=of_form("hubs"))
    glands: int = whole(1, 4, "glands below", when=of_form("flameproof", "plastic"))
    beside: tuple[bool, ...] = several(
        yes(0.3), 2, "whether a gland is at a side, but for a pull box", when=of_form("flameproof", "plastic", "pull")
    )
    wired: bool = chance(0.7, "a cable or conduit comes in")

    def build(self, t: Table) -> None:
        """Puts it down about its middle."""
        s, deep, front, n = self.size, self.depth * self.size, t.spun("x", np.pi / 2), t.n(self.size / 2)
        glands = moved(gland(0.045 * s), at(0, -deep / 2, -s / 2))
        if self.form == "hubs":
            rim = outline(0.5 * s, 0, 0.5 * s, 0.8 * deep, 0.54 * s, 0.8 * deep, 0.54 * s, deep, 0.3 * s, 1.12 * deep)
            hub, middle = cylinder(0.14 * s, 0.45 * s, 0.78 * s, 12), at(0, -deep / 2)
            hubs = [moved(hub, middle @ spun("y", k * np.pi / 2)) for k in (*range(self.hubs), 2)]
            t.add(_JB, moved(turned(rim, n), spun("x", np.pi / 2)), *hubs, of="clamp")
        elif self.form == "dome":
            body = extrude(rounded_rectangle(s, s, 0.2 * s, 3), 0, 0.6 * deep)
            t.add(_JB, moved(body, spun("x", np.pi / 2)), glands, of="clamp")
            lugs = around(box((0.05 * s, 0.06 * s, 0.1 * s), (0.44 * s, 0, 0.7 * deep)), 8)
            lid = cylinder(0.44 * s, 0.6 * deep, 0.7 * deep, n)
            front.add(_JB, lid, dome(0.4 * s, 0.35 * s, 0.7 * deep, n), lugs, of="clamp")
        else:
            self._square(t, glands)

    def _square(self, t: Table, low: Solid) -> None:
        s, deep, count, front = self.size, self.depth * self.size, self.glands, spun("x", np.pi / 2)
        flameproof = self.form == "flameproof"
        r, wide = {"flameproof": 0.06, "plastic": 0.1}.get(self.form, 0.0) * s, (1.14 if flameproof else 1.02) * s
        body = [extrude(rounded_rectangle(s, s, r, 3), 0.0, 0.75 * deep)]
        spots: list[tuple[float, float]] = [*CORNERS]
        far, screw = 0.42 * s, cylinder(0.05 * s, 0.7 * deep, deep + 0.004, 10)
        if flameproof:
            body.append(extrude(rounded_rectangle(wide, wide, r, 3), 0.6 * deep, 0.74 * deep))
            spots = [(i, j) for i in (-1, -0.33, 0.33, 1) for j in BOTH] + [(i, j) for i in BOTH for j in (-0.33, 0.33)]
            far, screw = 0.53 * s, hexagon(0.06 * s, deep, deep + 0.04 * s)
        glands = [moved(low, at((k - (count - 1) / 2) * 0.8 * s / max(count, 2))) for k in range(count)]
        sides = zip(BOTH, self.beside, strict=True) if self.form != "pull" else ()
        glands += [moved(low, spun("y", side * np.pi / 2)) for side, there in sides if there]
        glands += [low] * (count % 2 == 0)
        t.add(_JB, *(moved(one, front) for one in body), *glands)
        lid = moved(extrude(rounded_rectangle(wide, wide, r, 3), 0.75 * deep, deep), front)
        t.add(_JB, lid, *(along("-y", screw, i * far, 0, j * far) for i, j in spots))


class Makes(Utility, name="junction box/makes", weight=2.0, bundle=_JB, grain="structure"):
    """Terminal boxes on a frame or wall: flameproof with a bolted lid, round with hubs, plastic with lid screws."""

    height: float = between(1.0, 1.5, "of the boxes", "m")
    count: int = whole(1, 3, "boxes")
    boxes: tuple[_Terminal, ...] = several(made(_Terminal), lambda p: p.count, "boxes")
    walled: bool = chance(0.5, "they are on a wall, not on a frame")

    def build(self, t: Table) -> Model:
        z, x = self.height, 0.0
        for one in self.boxes:
            s, y, hubs = one.size, -0.02 - one.depth * one.size / 2, one.form == "hubs"
            x += s
            here = t.at(x, 0, z)
            one.build(here.at(0, -0.02))
            feet = [box((0.03, 0.03, 0.02), (sx * 0.3 * s, -0.01, sz * 0.3 * s)) for sx, sz in CORNERS]
            here.add("bracket", *feet, of="clamp")
            if one.wired:
                line = [(x, y, z - (0.77 if hubs else 0.61) * s), (x, y, 0.4), (x, y - 0.05, 0.15)]
                wire = rope(line, 0.05 * s + 0.003, 8)
                t.add("conduit" if hubs else "cable", wire, of="rubber", own=False)
            x += s
        if self.walled:
            t.extend([wall(-0.3, x + 0.3, z + 0.6)])
            return t.model()
        for q in (0.0, x):
            t.add("post", box((0.05, 0.05, z + 0.3), (q, 0.045, (z + 0.3) / 2)))
        for q in BOTH:
            t.add("bracket", box((x + 0.2, 0.02, 0.06), (x / 2, 0.01, z + q * 0.05)), of="clamp")
        return t.model()


PANELS: tuple[Family, ...] = families_of(Suite, WallBox, Console, LocalStation, Makes)
