"""Lamps and beacons on walls, posts, masts and beams."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import made, of_form, one_of
from cadplants.builder.params import Params, among, between, chance, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.utilities.mounting import Back, Utility, beam_over, h_column, hanger, pole, wall
from cadplants.model.family import Family, Model
from cadplants.solids.mesh_ops import Solid, about_x, extrude, merge, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, dome, hexagon, rod, rope, torus, turned
from cadplants.solids.transforms import at, spun

__all__ = ["LIGHTS"]

_L = "lamp"


class _Lamp(Utility, bundle=_L, grain="structure"):
    """A lamp."""


def _cage(far: float, low: float, high: float, tip: tuple[float, float], thick: float = 0.004) -> list[Solid]:
    """Four bent wires about z that go up at a radius ``far`` and in to a tip's radius and height [m]."""
    turns = [np.array([np.cos(a), np.sin(a)]) for a in np.arange(4) * np.pi / 2]
    return [rope([(*(far * u), low), (*(far * u), high), (*(tip[0] * u), tip[1])], thick, 5) for u in turns]


def _hung(p: Any) -> bool:
    return bool(p.hung)


class Linear(_Lamp, name="lamp/linear"):
    """Linear luminaires (waterproof, 0.6 to 1.5 m) end to end under a beam on rods, or slanting on a post's bracket."""

    length: float = among((0.6, 1.2, 1.5), "of a luminaire", "m")
    width: float = between(0.08, 0.18, "of a luminaire", "m")
    thick: float = between(0.05, 0.1, "height of a luminaire", "m")
    clips: int = whole(2, 5, "clips over the cover")
    glands: int = whole(0, 2, "cable glands at its ends")
    height: float = between(2.2, 3.2, "of the luminaires", "m")
    hung: bool = chance(0.6, "it is under a beam, not on a post")
    count: int = whole(1, 2, "luminaires under the beam", when=_hung)
    drop: float = among((0.0, 0.3, 0.6), "length of the rods", "m", when=_hung, otherwise=0.0)
    tilt: float = between(0.0, 0.6, "on the post", "rad", when=lambda p: not p.hung)

    def build(self, t: Table) -> Model:
        long, w, z, thick, drop = self.length, self.width, self.height, self.thick, self.drop
        top, pitch = 0.5 * thick, long + 0.1
        if self.hung:
            for k in range(self.count):
                here = t.at(k * pitch, 0, z)
                self._luminaire(here)
                for q in (-0.35, 0.35):
                    if drop:
                        rod_ = hanger(q * long, 0, top - 0.004, top + drop)
                        here.add("stud", rod_, fine=False)
                    else:
                        here.add("bracket", box((0.04, 0.6 * w, 0.02), (q * long, 0, top + 0.01)), of="clamp")
            t.extend(beam_over(-long, self.count * pitch - 0.2, z + top + (drop or 0.02)))
            return t.model()
        pose = at(0, -0.3, z) @ spun("x", -self.tilt)
        self._luminaire(t.moved(pose))
        seat = (pose @ np.array([0.0, 0.0, top, 1.0]))[:3]
        arm = rope([(0, 0, z - 0.3), (0, -0.1, z + 0.1), (0, seat[1], seat[2] + 0.012)], 0.016, 8)
        foot = moved(box((0.1, 0.06, 0.012)), pose @ at(0, 0, top + 0.005))
        t.add("bracket", arm, foot, of="clamp")
        t.extend(pole(z, 0.025, t.style))
        return t.model()

    def _luminaire(self, t: Table) -> None:
        long, w, thick = self.length, self.width, self.thick
        case = rounded_rectangle(w, 0.5 * thick, 0.2 * thick, 2) + np.array((0.0, 0.25 * thick))
        clips = [box((0.02, 1.04 * w, 0.012), (q * long, 0, 0.0)) for q in np.linspace(-0.44, 0.44, self.clips)]
        end = hexagon(0.03, -0.002, 0.02)
        ends = [along(axis, end, s * long / 2, 0, 0.25 * thick) for axis, s in (("-x", -1), ("x", 1))[: self.glands]]
        t.add(_L, about_x(extrude(case, -long / 2, long / 2)), *clips, *ends, of="electrical")
        a = np.linspace(np.pi, 2 * np.pi, max(3, t.n(0.05) // 4) + 2)
        arc = np.column_stack([0.46 * w * np.cos(a), 0.5 * thick * np.sin(a)])
        t.add(_L, about_x(extrude(arc, -0.98 * long / 2, 0.98 * long / 2)))


class _Flood(Params):
    """A floodlight with fins and a yoke."""

    width: float = between(0.2, 0.4, "of the case", "m")
    height: float = between(0.16, 0.35, "of the case", "m")
    depth: float = between(0.05, 0.14, "of the case", "m")
    tilt: float = between(0.2, 0.9, "down", "rad")
    upright: bool = chance(0.5, "its fins are upright")

    def build(self, t: Table) -> None:
        """Puts it down before y = 0."""
        w, h, d = self.width, self.height, self.depth
        y, side = -0.12 - d - h / 2, w / 2 + 0.012
        head = t.at(0, y).spun("x", self.tilt)
        fins = [box((0.9 * w, 0.05, 0.005), (0, d / 2 + 0.02, q * h)) for q in np.linspace(-0.42, 0.42, 7)]
        if self.upright:
            fins = [box((0.005, 0.05, 0.9 * h), (q * w, d / 2 + 0.02, 0)) for q in np.linspace(-0.42, 0.42, 9)]
        yoke = [box((0.008, 0.04, 0.04), (s * side, 0, 0)) for s in BOTH]
        rim = box((1.05 * w, 0.02, 1.05 * h), (0, -d / 2, 0))
        pivot = along("x", cylinder(0.012, -side, side, 8))
        head.add(_L, box((w, d, h)), rim, pivot, *fins, *yoke, of="rubber")
        head.add(_L, box((0.92 * w, 0.008, 0.92 * h), (0, -d / 2 - 0.013, 0)))
        bow = [(-side, y, 0), (-side, -0.014, 0), (side, -0.014, 0), (side, y, 0)]
        t.add(_L, rope(bow, 0.008, 6), box((0.1, 0.016, 0.05), (0, -0.008, 0)), of="clamp")


class Floodlight(_Lamp, name="lamp/floodlight"):
    """Floodlights with fins and a yoke, one to four on a mast's crossbar, or one on a wall."""

    count: int = among((1, 2, 2, 3, 4), "floodlights")
    height: float = between(
        lambda p: 2.5 if p.count > 1 else 1.8, lambda p: 5.0 if p.count > 1 else 3.0, "of the floodlights", "m"
    )
    floods: tuple[_Flood, ...] = several(made(_Flood), lambda p: p.count, "floodlights")
    back: Back | None = nested(Back, "what a single one is fixed to", when=lambda p: p.count == 1)

    def build(self, t: Table) -> Model:
        z, pitch = self.height, 0.5
        for k, flood in enumerate(self.floods):
            flood.build(t.at((k - (self.count - 1) / 2) * pitch, 0, z))
        if self.back is not None:
            self.back.build(t, z + 0.4, 0.4)
        else:
            t.add("bracket", box((self.count * pitch, 0.06, 0.06), (0, 0.03, z)))
            t.at(0, 0.11).extend(pole(z + 0.2, 0.05, t.style))
        return t.model()


_of_well = of_form("well glass")


class Bulkhead(_Lamp, name="lamp/bulkhead"):
    """A bulkhead light on a wall: oval or round with a cage or a hood, or a well glass on a bracket; conduit to it."""

    form: str = among(("oval", "round", "well glass", "hood"), "what it is")
    height: float = between(1.8, 2.4, "of the lamp", "m")
    size: float = between(0.07, 0.13, "radius of the lamp, about", "m")
    shaded: bool = chance(0.5, "a shade over a well glass", when=_of_well)
    back: Back | None = nested(Back, "what a well glass is fixed to", when=_of_well)
    walled: bool = chance(0.6, "another is on a wall, not on a column", when=lambda p: not _of_well(p))

    def build(self, t: Table) -> Model:
        z, s, n = self.height, self.size, t.n(self.size)
        if self.back is not None:
            self._well_glass(t.at(0, 0, z))
            self.back.build(t, z + 0.8)
            return t.model()
        scale = np.diag([1.0, 1.0, 1.6 if self.form == "oval" else 1.0, 1.0])
        front = t.at(0, 0, z).moved(scale @ spun("x", np.pi / 2))
        front.add(_L, cylinder(s, 0, 0.04, n), cylinder(1.06 * s, 0.035, 0.05, n), of="electrical")
        front.add(_L, dome(0.9 * s, 0.8 * s, 0.05, n))
        if self.form == "hood":
            a = np.linspace(0, np.pi, 9)
            arch = s * np.column_stack([np.cos(a), np.sin(a)])
            front.add(_L, extrude(np.vstack([1.1 * arch, 1.06 * arch[::-1]]), 0.0, 0.08 + 0.8 * s), of="electrical")
        else:
            hoop = moved(torus(0.97 * s, 0.004, 20, 5), at(0, 0, 0.05 + 0.4 * s))
            front.add(_L, *_cage(0.97 * s, 0.045, 0.05 + 0.5 * s, (0.0, 0.07 + 0.9 * s)), hoop, of="clamp")
        t.add("conduit", rod((0, -0.02, z + 0.8 * s), (0, -0.02, z + 0.7), 0.0107, 8), own=False)
        t.extend([wall(-0.5, 0.5, z + 0.8) if self.walled else h_column(z + 0.8, 0.24)])
        return t.model()

    def _well_glass(self, t: Table) -> None:
        s, n, y = self.size, t.n(self.size), -0.25
        here = t.at(0, y)
        cap = outline(0.25 * s, -0.06, 0.8 * s, -0.05, 0.75 * s, 0.0, 0.35 * s, 0.04)
        here.add(_L, turned(cap, n), of="electrical")
        glass = outline(0.3 * s, -0.05 - 2.0 * s, 0.6 * s, -0.05 - 1.8 * s, 0.65 * s, -0.05)
        here.add(_L, turned(glass, n))
        hoop = moved(torus(0.72 * s, 0.004, 16, 5), at(0, 0, -0.05 - s))
        here.add(_L, *_cage(0.72 * s, -0.04, -0.05 - 1.8 * s, (0.1 * s, -0.06 - 2.1 * s)), hoop, of="clamp")
        arm = rope([(0, 0.0, 0.1), (0, y + 0.08, 0.14), (0, y, 0.12), (0, y, 0.02)], 0.014, 8)
        t.add(_L, arm, box((0.1, 0.01, 0.1), (0, -0.005, 0.1)), of="clamp")
        if self.shaded:
            here.add(_L, turned(outline(2.2 * s, -0.05, 2.25 * s, -0.045, 0.6 * s, 0.045), n), of="electrical")


class HighBay(_Lamp, name="lamp/high bay"):
    """High bay lights: a bell reflector or a finned LED disc with its gear, hung from a beam."""

    count: int = whole(1, 3, "lamps")
    height: float = between(3.0, 4.5, "of the beam", "m")
    form: str = among(("bell", "disc"), "of a lamp")
    radius: float = between(0.15, 0.28, "of a lamp", "m")
    drop: float = between(0.2, 0.8, "from the beam to a lamp", "m")
    fins: tuple[int, ...] = several(one_of(16, 24), lambda p: p.count, "fins of a disc", when=of_form("disc"))

    def build(self, t: Table) -> Model:
        r, high, n = self.radius, self.height, t.n(self.radius)
        top = (1.05 if self.form == "bell" else 0.8) * r
        for k in range(self.count):
            here = t.at(1.2 * k, 0, high - self.drop - top)
            if self.form == "bell":
                gear = [(x * r, z * r) for x, z in outline(0.3, 0, 0.42, 0.1, 0.42, 0.9, 0.2, 1.05)]
                here.add(_L, turned(gear, n), of="electrical")
                bell = [(0.3 * r + 0.7 * r * q**0.7, -1.1 * r * q) for q in np.linspace(0.15, 1.0, 6)][::-1]
                here.add(_L, turned([*bell, (0.3 * r, 0.02)], n), of="clamp")
                here.add(_L, cylinder(0.96 * r, -1.13 * r, -1.1 * r, n))
            else:
                body = outline(0.95, 0.0, 1, 0.05, 1, 0.2, 0.5, 0.25)
                driver = outline(0.42, 0.24, 0.45, 0.3, 0.45, 0.75, 0.3, 0.8)
                lathed = [turned([(x * r, z * r) for x, z in one], n) for one in (body, driver)]
                fins = around(box((0.5 * r, 0.015 * r + 0.002, 0.3 * r), (0.7 * r, 0, 0.3 * r)), self.fins[k])
                here.add(_L, lathed[0], fins, lathed[1], of="electrical")
                here.add(_L, cylinder(0.9 * r, -0.03 * r, 0.001, n))
            up, rise = here.at(0, 0, top), self.drop
            up.at(0, 0, 0.022).spun("x", np.pi / 2).add(_L, torus(0.025, 0.006, 12, 6), of="clamp")
            up.add("pipe hanger", rod((0, 0, 0.04), (0, 0, rise + 0.001), 0.007, 8))
            cable = rope([(0.15 * r, 0, -0.02), (0.1, 0, 0.1), (0.12, 0, rise + 0.002)], 0.006, 6)
            up.add("cable", cable, own=False)
        t.extend(beam_over(-0.6, 1.2 * self.count - 0.6, high))
        return t.model()


_of_beacon = of_form("beacon")


class Signal(_Lamp, name="lamp/signal"):
    """Signal lamps: a beacon with a horn on a wall, a stack of coloured lamps on a stem, a traffic or exit light."""

    form: str = among(("beacon", "stack", "exit"), "what it is")
    scale: float = between(0.8, 1.4, "how large it is / usual")
    height: float = between(1.6, 2.4, "of a lamp on a wall", "m")
    count: int = whole(2, 5, "lamps in a stack", when=of_form("stack"))
    headed: bool = chance(0.6, "two heads on an exit light", when=of_form("exit"))
    horn: bool = chance(0.6, "a horn below a beacon", when=_of_beacon)
    back: Back | None = nested(Back, "what a beacon is fixed to", when=_of_beacon)

    def build(self, t: Table) -> Model:
        if self.back is not None:
            self._beacon(t.at(0, 0, self.height))
            self.back.build(t, self.height + 0.6)
        elif self.form == "stack":
            self._stack(t)
        else:
            self._exit_light(t.at(0, 0, self.height))
            t.extend([wall(-0.6, 0.6, self.height + 0.6)])
        return t.model()

    def _stack(self, t: Table) -> None:
        """Coloured lamps in a stack on a cabinet."""
        r, n, here = 0.03 * self.scale, t.n(0.05), t.at(0.15, 0.05, 1.65)
        levels = [0.03 + 1.75 * r * k for k in range(self.count + 1)]
        caps = [cylinder(1.04 * r, z + 1.6 * r, z + 1.75 * r, n) for z in levels[:-1]]
        top = dome(r, 0.4 * r, levels[-1], n)
        here.add(_L, cylinder(1.1 * r, 0, 0.03, n), *caps, top, cylinder(0.4 * r, -0.25, 0.0, 10), of="rubber")
        for z, color in zip(levels[:-1], ("handle", "safety", "gate", "dial", "motor"), strict=False):
            here.add(_L, cylinder(r, z, z + 1.6 * r, n), of=color)
        case = [box((0.5, 0.3, 0.7), (0, 0, 1.05)), box((0.47, 0.02, 0.66), (0, -0.16, 1.05))]
        foot = [box((0.1, 0.1, 0.7), (0, 0, 0.35)), box((0.35, 0.3, 0.02), (0, 0, 0.01))]
        t.add("control panel", *case, *foot, own=False)

    def _exit_light(self, t: Table) -> None:
        """An exit or emergency light on a wall, maybe with two heads."""
        w, h, n = 0.3 * self.scale, 0.15 * self.scale, t.n(0.05)
        far, solids = w / 2 - 0.03, [box((w, 0.05, h), (0, -0.025, 0))]
        if self.headed:
            head = turned(outline(0.03, 0.0, 0.05, 0.05, 0.05, 0.06), n)
            solids += [along("-y", head, q * far, -0.04, h / 2 + 0.05) for q in BOTH]
            solids += [rod((q * far, -0.03, h / 2 - 0.01), (q * far, -0.045, h / 2 + 0.03), 0.01, 8) for q in BOTH]
        t.add(_L, *solids, of="electrical")
        t.add(_L, box((0.95 * w, 0.006, 0.9 * h), (0, -0.053, 0)), of="gate")

    def _beacon(self, t: Table) -> None:
        """A caged beacon on a bracket, maybe with a horn below."""
        r, n = 0.06 * self.scale, t.n(0.05)
        here = t.at(0, -1.2 * r)
        shelf, plate = box((2.6 * r, 2.4 * r, 0.03)), box((2.2 * r, 0.02, 1.6 * r), (0, 1.2 * r - 0.01, -0.6 * r))
        here.add(_L, shelf, plate, cylinder(1.1 * r, 0.01, 0.04, n), of="electrical")
        glass = turned(outline(r, 0.035, r, 0.035 + 1.6 * r, 0.8 * r, 0.035 + 2.0 * r), n)
        here.add(_L, glass, of="handle")
        here.add(_L, *_cage(1.06 * r, 0.03, 0.04 + 1.9 * r, (0.0, 0.05 + 2.2 * r), 0.003), of="clamp")
        if self.horn:
            bell = turned([(x * r, z * r) for x, z in outline(0.5, 0, 0.55, 0.8, 1.3, 1.9, 1.3, 2.0)], n)
            horn = along("-y", merge([bell, cylinder(0.8 * r, -0.01, 0.4 * r, n)]), 0, -0.01)
            t.at(0, 0, -2.6 * r).add(_L, horn, box((2.2 * r, 0.02, 1.8 * r), (0, -0.01, 0)), of="handle")


LIGHTS: tuple[Family, ...] = families_of(Linear, Floodlight, Bulkhead, HighBay, Signal)
