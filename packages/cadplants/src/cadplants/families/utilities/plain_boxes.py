"""Name plates, control panels and junction boxes as asset packs have them: plain solids, in pieces or in one mesh."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import of_form
from cadplants.builder.melting import Melting
from cadplants.builder.params import among, between, chance, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.utilities.mounting import Back, Utility
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, about_x, extrude, merge, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, CORNERS, along, box, cylinder, dome, hexagon, rod, rope, turned
from cadplants.solids.transforms import at, spun

__all__ = ["PLAIN_BOXES"]

_CP, _JB, _S = "control panel", "junction box", "sign"
_BUILDING = ("wall", "column", "base plate", "bolt")


class _MeltedUtility(Melting, Utility):
    """Equipment of few solids that may be one mesh."""

    melted: bool = chance(0.6, "all of it is one mesh")

    def melt(self, t: Table, label: str) -> None:
        """Makes one mesh of what was put down but for what belongs to the building, if asked for."""
        if self.melted:
            solids = [part.solid for part in t.parts if part.name not in _BUILDING]
            rest = [part for part in t.parts if part.name in _BUILDING]
            t.parts[:] = rest
            t.add(label, *solids)


def _on_stem(p: Any) -> bool:
    return bool(p.mount in ("stake", "post", "legs", "flag"))


class Nameplate(_MeltedUtility, name="sign/nameplate", weight=1.5, bundle=_S, grain="structure"):
    """A name plate or label: a thin plate on two screws, on a bracket, a stake, a post or legs, a flag, a wedge."""

    mount: str = among(("wall", "wall", "bracket", "stake", "stake", "post", "legs", "flag", "desk"), "what it is on")
    shape: str = among(("rectangle", "rectangle", "rectangle", "rounded", "round", "octagon", "tag"), "its outline")
    width: float = between(0.05, 0.5, "of the plate", "m")
    aspect: float = among((0.25, 0.4, 0.55, 0.7, 1.0, 1.4), "height / width")
    thick: float = among((0.001, 0.002, 0.004, 0.008, 0.02), "of the plate", "m")
    level: float = between(0.25, 1.9, "of its middle over the floor", "m")
    tilt: float = among((0.0, 0.0, 0.4, 0.8), "of the plate", "rad", when=_on_stem)
    bar: float = between(0.005, 0.03, "half the width of what carries it", "m")
    round_bar: bool = chance(0.5, "what carries it is round", when=_on_stem)
    foot: str = among(("none", "plate", "plate", "cone", "block"), "what is below it", when=_on_stem)
    screws: int = among((0, 2, 2, 4), "screws in it")
    framed: str = among(("none", "none", "panel", "rim"), "what else is on its front")
    back: Back = nested(Back, "what it is fixed to", when=lambda p: p.mount in ("wall", "bracket"))

    def build(self, t: Table) -> Model:
        w, d = self.width, self.bar
        h = w if self.shape in ("round", "octagon") else self.aspect * w
        z = max(self.level, 0.5 * h + 0.05)
        if self.mount in ("wall", "bracket"):
            out = 0.0 if self.mount == "wall" else 0.02 + 2 * d
            self._plate(t.at(0, -out, z), w, h)
            if out:
                arms = [box((2 * d, out + 0.002, 0.004), (0, -out / 2, z + s * 0.3 * h)) for s in BOTH]
                t.add("bracket", *arms, box((2 * d, 0.004, 0.8 * h + 0.01), (0, -0.002, z)), own=False)
            self.back.build(t, z + h / 2 + 0.3, 0.6 * w + 0.3)
        elif self.mount == "desk":
            self._wedge(t, w, max(h, 0.03))
        else:
            self._carrier(t, w, h, z, d)
        self.melt(t, _S)
        return t.model()

    def _plate(self, t: Table, w: float, h: float) -> None:
        """Puts the plate down about the origin, its back at y = 0, its front towards -y."""
        shapes = {
            "rectangle": outline(-w / 2, -h / 2, w / 2, -h / 2, w / 2, h / 2, -w / 2, h / 2),
            "tag": outline(-w / 2, -h / 2, 0.35 * w, -h / 2, w / 2, 0, 0.35 * w, h / 2, -w / 2, h / 2),
        }
        small = min(w, h)
        if self.shape == "round":
            sheet = circle(w / 2, self.n(t, w / 2))
        elif self.shape == "octagon":
            sheet = circle(w / 2, 8, phase=np.pi / 8)
        elif self.shape == "rounded":
            sheet = rounded_rectangle(w, h, 0.2 * small, 3)
        else:
            sheet = np.array(shapes[self.shape])
        front, thick = t.spun("x", np.pi / 2), self.thick
        solids = [extrude(sheet, -0.001, thick)]
        if self.framed == "panel":
            solids.append(extrude(0.8 * sheet, 0.5 * thick, thick + 0.001))
        elif self.framed == "rim":
            solids.append(extrude(sheet, 0.5 * thick, thick + 0.003, (0.88 * sheet,)))
        front.add(_S, *solids)
        r = 0.035 * small + 0.001
        spots = {
            0: [],
            2: [(s * 0.38 * w, 0.0) for s in BOTH],
            4: [(x * 0.33 * w, y * 0.33 * h) for x, y in CORNERS],
        }[self.screws]
        front.add(_S, *(moved(cylinder(r, 0, thick + 0.6 * r, 8), at(*spot)) for spot in spots), of="fastener")

    def _bar(self, x: float, low: float, high: float, d: float, n: int) -> Solid:
        if self.round_bar:
            return rod((x, 0, low), (x, 0, high), d, n)
        return box((2 * d, 2 * d, high - low), (x, 0, (high + low) / 2))

    def _carrier(self, t: Table, w: float, h: float, z: float, d: float) -> None:
        n, d = self.n(t, d), min(d, 0.3 * w)
        turned_plate = t.at(0, 0.0 if self.tilt else -0.99 * d, z).spun("x", -self.tilt)
        xs, top = [0.0], z + (0.0 if self.tilt else 0.4 * h)
        if self.mount == "legs":
            xs = [-0.4 * w, 0.4 * w]
        if self.mount == "flag":
            xs, top = [-0.5 * w - d], z + 0.6 * h
            self._plate(t.at(0, 0, z), w, h)
            t.add(_S, *(box((2 * d, 0.006, 0.12 * h), (-0.5 * w, 0, z + s * 0.2 * h)) for s in BOTH))
        else:
            self._plate(turned_plate, w, h)
            if self.tilt:
                size = (1.6 * d + 2 * abs(xs[0]), 0.004, 0.5 * h + 2 * d)
                turned_plate.add("bracket", box(size, (0, 0.002, 0)), own=False)
        t.add("post", *(self._bar(x, 0.0, top, d, n) for x in xs))
        for x in xs:
            wide = 4 * d + 0.08
            if self.foot == "plate":
                t.at(x).add("post", box((wide, wide, 0.008), (0, 0, 0.004)))
            elif self.foot == "block":
                t.at(x).add("foundation", box((wide, wide, 0.12), (0, 0, 0.06)))
            elif self.foot == "cone":
                t.at(x).add("post", turned(outline(wide, 0, wide, 0.02, 1.5 * d, 0.07), max(8, n)))

    def _wedge(self, t: Table, w: float, h: float) -> None:
        """A label as a wedge that stands by itself on a block."""
        side = outline(0.0, 0.0, 0.5 * h, 0.0, 0.3 * h, h, 0.2 * h, h)
        z = self.level * 0.5
        t.at(0, -0.25 * h, z - 0.001).add(_S, about_x(extrude(np.array(side), -w / 2, w / 2)))
        t.add("post", box((0.6 * w, 0.45 * h, z), (0, 0, z / 2)))


class PlainPanel(_MeltedUtility, name="control panel/plain", weight=1.5, bundle=_CP, grain="structure"):
    """A cabinet, desk, operator station on an arm or pedestal, push-button box on a post, each of few solids."""

    form: str = among(
        ("cabinet", "cabinet", "wall box", "wall box", "desk", "pulpit", "pedestal", "buttons", "buttons", "kiosk"),
        "what it is",
    )
    wide: float = between(0.0, 1.0, "its width, from the least to the most of its kind")
    tall: float = between(0.0, 1.0, "its height, from the least to the most of its kind")
    deep: float = between(0.0, 1.0, "its depth, from the least to the most of its kind")
    rounding: float = among((0.0, 0.0, 0.0, 0.02, 0.05), "radius of its corners / width")
    doors: int = whole(0, 3, "doors", when=of_form("cabinet", "wall box", "kiosk"))
    proud: float = among(
        (0.004, 0.015, 0.03), "how far a door stands out", "m", when=of_form("cabinet", "wall box", "kiosk")
    )
    plinth: float = among((0.0, 0.05, 0.1, 0.2), "height of the plinth", "m", when=of_form("cabinet", "desk", "kiosk"))
    roof: str = among(
        ("none", "none", "flat", "slope", "fan"), "what is on it", when=of_form("cabinet", "wall box", "kiosk")
    )
    screen: bool = chance(0.5, "a screen")
    lines: int = whole(0, 3, "lines of buttons")
    columns: int = whole(1, 5, "buttons in a row")
    knob: float = between(0.008, 0.025, "radius of a button", "m")
    handle: str = among(("none", "bar", "bar", "knob", "switch"), "what else is on its front")
    slope: float = between(0.15, 0.9, "of what is operated", "rad", when=of_form("desk", "pulpit", "pedestal"))
    level: float = between(0.6, 1.4, "of its lower edge over the floor", "m", when=of_form("wall box", "buttons"))
    leg: float = between(
        0.02, 0.07, "half the width of its post", "m", when=of_form("pulpit", "pedestal", "buttons", "wall box")
    )
    stand: str = among(
        ("wall", "wall", "post", "legs", "nothing"), "what carries it", when=of_form("wall box", "buttons")
    )
    base: str = among(
        ("plate", "disc", "none"), "below the post", when=of_form("pulpit", "pedestal", "buttons", "wall box")
    )

    def build(self, t: Table) -> Model:
        w, h, d = self._measures()
        if self.form in ("desk", "pulpit"):
            self._desk(t, w, h, d)
        elif self.form == "pedestal":
            self._pedestal(t, w, h, d)
        elif self.form in ("cabinet", "kiosk"):
            low = self.plinth
            if low:
                t.add(_CP, box((0.96 * w, 0.92 * d, low + 0.002), (0, d / 2, low / 2 + 0.001)), of="rubber")
            self._case(t.at(0, d, low), w, h - low, d)
        else:
            self._hung(t, w, h, d)
        self.melt(t, _CP)
        return t.model()

    def _measures(self) -> tuple[float, float, float]:
        """Its width, height and depth [m]."""
        spans = {
            "cabinet": ((0.4, 2.4), (1.2, 2.3), (0.25, 0.9)),
            "kiosk": ((0.4, 0.8), (0.9, 1.7), (0.25, 0.7)),
            "wall box": ((0.2, 1.0), (0.25, 1.2), (0.12, 0.4)),
            "desk": ((0.6, 2.4), (0.9, 1.5), (0.5, 1.0)),
            "pulpit": ((0.3, 0.9), (0.9, 1.25), (0.25, 0.5)),
            "pedestal": ((0.2, 0.7), (0.95, 1.5), (0.05, 0.25)),
            "buttons": ((0.06, 0.25), (0.1, 0.4), (0.05, 0.14)),
        }[self.form]
        (a, b), (c, e), (f, g) = spans
        return a + self.wide * (b - a), c + self.tall * (e - c), f + self.deep * (g - f)

    def _case(self, t: Table, w: float, h: float, d: float) -> None:
        """Puts a box down on z = 0, its back at y = 0, with doors and what is on its front."""
        case = extrude(rounded_rectangle(w, h, self.rounding * w, 2), 0, d) if self.rounding else None
        body = moved(case, at(0, 0, h / 2) @ spun("x", np.pi / 2)) if case else box((w, d, h), (0, -d / 2, h / 2))
        t.add(_CP, body)
        front = 0.0
        if self.doors:
            leaf, front = w / self.doors, self.proud
            xs = [(k - (self.doors - 1) / 2) * leaf for k in range(self.doors)]
            size = (0.96 * leaf, front + 0.004, 0.95 * h)
            t.add(_CP, *(box(size, (x, -d - front / 2 + 0.002, h / 2)) for x in xs))
        self._front(t.at(0, -d - front, h / 2), w, h)
        if self.roof == "flat":
            t.add(_CP, box((1.08 * w, 1.15 * d, 0.03), (0, -0.55 * d, h + 0.014)))
        elif self.roof == "fan":
            t.add(_CP, box((0.5 * w, 0.5 * d, 0.08), (0, -0.5 * d, h + 0.039)), of="rubber")
        elif self.roof == "slope":
            side = outline(0, h - 0.002, 0, h + 0.25 * d, -1.2 * d, h + 0.02, -1.2 * d, h - 0.002)
            t.add(_CP, about_x(extrude(np.array(side), -0.54 * w, 0.54 * w)))

    def _front(self, t: Table, w: float, h: float) -> None:
        """Puts screen, buttons and a handle down before y = 0, about the middle of a front."""
        if self.screen:
            size = (min(0.6 * w, 0.6), 0.012, min(0.3 * h, 0.4))
            t.add(_CP, box(size, (0, -0.004, 0.26 * h)), of="dial")
        if self.lines:
            t.add(_CP, *(along("-y", one, x, 0, z - 0.12 * h) for one, x, z in self._buttons(w, 0.5 * h)), of="rubber")
        q = 0.06 * min(h, w) + 0.02
        if self.handle == "bar":
            t.add(_CP, box((0.4 * q, 0.03, 2 * q), (0.42 * w - 0.2 * q, -0.014, 0)), of="rubber")
        elif self.handle == "knob":
            t.add(_CP, along("-y", cylinder(0.5 * q, -0.002, 0.03, 10), 0.4 * w, 0, 0), of="rubber")
        elif self.handle == "switch":
            plate = box((1.6 * q, 0.012, 1.6 * q), (0.25 * w, -0.004, 0.06 * h))
            grip = box((0.35 * q, 0.04, 1.3 * q), (0.25 * w, -0.025, 0.06 * h))
            t.add(_CP, plate, grip, of="handle")

    def _buttons(self, w: float, h: float) -> list[tuple[Solid, float, float]]:
        """Buttons about z, and where they are on a front this wide and high."""
        r = min(self.knob, 0.32 * 0.8 * w / self.columns, 0.3 * h / self.lines)
        one = merge([cylinder(1.2 * r, -0.003, 0.25 * r, 10), cylinder(r, 0, 0.9 * r, 10)])
        across, up = min(0.8 * w / self.columns, 5 * r), min(0.8 * h / self.lines, 4 * r)
        return [
            (one, (i - (self.columns - 1) / 2) * across, (j - (self.lines - 1) / 2) * up)
            for i in range(self.columns)
            for j in range(self.lines)
        ]

    def _post(self, t: Table, high: float, n: int) -> None:
        r = self.leg
        shaft = cylinder(r, 0, high, n) if self.base == "disc" else box((2 * r, 2 * r, high), (0, 0, high / 2))
        foot = {
            "plate": [box((5 * r + 0.08, 5 * r + 0.08, 0.012), (0, 0, 0.006))],
            "disc": [cylinder(3 * r + 0.06, 0, 0.02, n)],
        }.get(self.base, [])
        t.add("post", shaft, *foot)

    def _desk(self, t: Table, w: float, h: float, d: float) -> None:
        """A desk on the floor or a pulpit on a post, its operator at -y."""
        rise = min(float(np.tan(self.slope)) * 0.7 * d, 0.4 * h)
        low = self.plinth if self.form == "desk" else 0.5 * h
        edge = max(h - rise, low + 0.08)
        side = outline(-0.45 * d, low, 0.5 * d, low, 0.5 * d, h, 0.25 * d, h, -0.5 * d, edge, -0.5 * d, edge - 0.06)
        if self.form == "pulpit":
            side = outline(-0.2 * d, low, 0.25 * d, low, 0.5 * d, h, -0.5 * d, edge, -0.5 * d, edge - 0.05)
            self._post(t, low + 0.02, self.n(t, self.leg))
        elif low:
            t.add(_CP, box((0.94 * w, 0.8 * d, low + 0.002), (0, 0.04 * d, low / 2 + 0.001)), of="rubber")
        t.add(_CP, about_x(extrude(np.array(side), -w / 2, w / 2)))
        back = 0.25 * d if self.form == "desk" else 0.5 * d
        rise_angle = float(np.arctan2(h - edge, back + 0.5 * d))
        middle = t.at(0, (back - 0.5 * d) / 2, (h + edge) / 2).spun("x", rise_angle - np.pi / 2)
        self._front(middle.at(0, 0, 0), w, 0.7 * d)

    def _pedestal(self, t: Table, w: float, h: float, d: float) -> None:
        """A head of an operator's station, tilted on a post."""
        high = 0.75 * w if self.screen else 0.9 * w
        self._post(t, h, self.n(t, self.leg))
        head = t.at(0, -min(0.5 * d, self.leg), h).spun("x", -0.7 * self.slope)
        self._case(head.at(0, 0.5 * d, -0.3 * high), w, high, d)

    def _hung(self, t: Table, w: float, h: float, d: float) -> None:
        """A box on a wall, a post or legs."""
        z = self.level
        self._case(t.at(0, 0, z), w, h, d)
        if self.stand == "wall":
            t.add("wall", box((1.2 * w + 0.4, 0.1, z + h + 0.4), (0, 0.049, (z + h + 0.4) / 2)))
        elif self.stand == "post":
            self._post(t.at(0, self.leg - 0.002), z + 0.8 * h, self.n(t, self.leg))
        elif self.stand == "legs":
            q = min(self.leg, 0.2 * w)
            bars = [box((q, q, z + 0.9 * h), (s * 0.4 * w, q / 2 - 0.002, (z + 0.9 * h) / 2)) for s in BOTH]
            t.add("post", *bars, box((0.8 * w, q, q), (0, q / 2 - 0.002, 0.3 * z)))
        else:
            lugs = [
                box((0.05 + 0.1 * w, 0.006, 0.04), (s * 0.5 * w, -0.003, z + q * h)) for s in BOTH for q in (0.2, 0.8)
            ]
            t.add("bracket", *lugs, own=False)


class PlainJunctionBox(_MeltedUtility, name="junction box/plain", weight=1.5, bundle=_JB, grain="structure"):
    """A terminal box of few solids: square, round or domed, with glands, on a plate, wall, post or legs."""

    shape: str = among(("box", "box", "box", "rounded", "round", "octagon", "domed", "cross"), "form of the box")
    width: float = between(0.06, 0.4, "of the box", "m")
    aspect: float = between(0.6, 1.7, "height / width")
    deep: float = between(0.3, 0.9, "depth / width")
    lid: str = among(("none", "none", "plate", "step", "round", "door"), "its lid")
    screws: bool = chance(0.4, "screws in the lid")
    glands: int = whole(0, 5, "glands below")
    beside: int = among((0, 0, 1, 2), "glands aside")
    above: int = among((0, 0, 0, 1), "glands above")
    gland: float = between(0.006, 0.02, "radius of a gland", "m")
    gland_form: str = among(("pipe", "nut", "nut", "stepped"), "form of a gland")
    wired: bool = chance(0.4, "cables come in from below", when=lambda p: p.glands > 0)
    mount: str = among(("wall", "plate", "post", "post", "stake", "legs", "floor"), "what it is on")
    level: float = between(0.3, 1.5, "of its middle over the floor", "m", when=lambda p: p.mount != "floor")
    bar: float = between(0.015, 0.05, "half the width of what carries it", "m")
    round_bar: bool = chance(0.5, "that is round")
    lugs: bool = chance(0.3, "lugs at its back")
    back: Back = nested(Back, "what it is fixed to", when=lambda p: p.mount in ("wall", "plate"))

    def build(self, t: Table) -> Model:
        w, d = self.width, self.deep * self.width
        square = self.shape in ("round", "octagon", "domed", "cross")
        h = w if square else self.aspect * w
        z = max(self.level, 0.5 * h + 0.1) if self.mount != "floor" else 0.5 * h + 0.05 + 3.5 * self.gland
        out = 0.01 if self.mount == "plate" else 0.0
        mid = t.at(0, -out, z)
        n = self.n(t, w / 2)
        mid.spun("x", np.pi / 2).add(_JB, *self._solids(w, h, d, n))
        mid.add(_JB, *self._entries(w, h, d, z, n), of="rubber")
        if self.lugs:
            size = (0.12 * w, 0.006, 0.12 * w)
            mid.add(_JB, *(box(size, (x * 0.54 * w, -0.003, y * 0.35 * h)) for x, y in CORNERS), of="clamp")
        if square and self.lugs:
            mid.add(_JB, box((1.15 * w, 0.005, 0.85 * h), (0, -0.0025, 0)), of="clamp")
        self._mount(t, w, h, z, d, n)
        self.melt(t, _JB)
        return t.model()

    def _solids(self, w: float, h: float, d: float, n: int) -> list[Solid]:
        """The box and its lid about z, its back at 0, its front up."""
        seat = 0.8 * d if self.lid in ("plate", "step") else d
        square = rounded_rectangle(w, h, 0.15 * min(w, h), 3)
        body = {
            "box": lambda: [box((w, h, seat), (0, 0, seat / 2))],
            "rounded": lambda: [extrude(square, 0, seat)],
            "round": lambda: [cylinder(w / 2, 0, seat, max(8, n))],
            "octagon": lambda: [extrude(circle(w / 2, 8, phase=np.pi / 8), 0, seat)],
            "domed": lambda: [
                cylinder(w / 2, 0, 0.7 * seat, max(8, n)),
                dome(0.45 * w, 0.4 * seat, 0.69 * seat, max(8, n)),
            ],
            "cross": lambda: [
                cylinder(0.4 * w, 0, seat, max(8, n)),
                *(along(way, cylinder(0.15 * w, 0.0, 0.5 * w, 8), 0, 0, 0.45 * seat) for way in ("x", "-x")),
            ],
        }[self.shape]()
        if self.shape == "domed":
            return body
        round_one = self.shape in ("round", "octagon", "cross")
        wide = 0.8 * w if self.shape == "cross" else w
        high = wide if round_one else h
        if self.lid in ("plate", "step"):
            f = 1.06 if self.lid == "plate" else 0.88
            lid = cylinder(f * wide / 2, seat - 0.001, d, max(8, n))
            body.append(lid if round_one else box((f * w, f * h, d - seat + 0.001), (0, 0, (d + seat) / 2)))
        elif self.lid == "round":
            body.append(cylinder(0.4 * min(wide, high), d - 0.001, 1.12 * d, max(8, n)))
        elif self.lid == "door" and not round_one:
            body.append(box((0.9 * w, 0.9 * h, 0.01), (0, 0, d + 0.003)))
        if self.screws:
            r, f = 0.03 * wide + 0.001, 0.28 if round_one else 0.38
            top = 1.12 * d if self.lid == "round" else d + (0.008 if self.lid == "door" else 0.0)
            low = d - 0.1 * d
            body += [moved(cylinder(r, low, top + 0.7 * r, 6), at(x * f * wide, y * f * high)) for x, y in CORNERS]
        return body

    def _entries(self, w: float, h: float, d: float, z: float, n: int) -> list[Solid]:
        """Glands on its sides, cables below, about its middle with its back at y = 0."""
        r = min(self.gland, 0.3 * d, 0.35 * 0.8 * w / max(self.glands, 1))
        inner, long = 0.3 * min(w, h), 3.5 * r
        sides = max(6, min(n, 12))
        stub = [cylinder(0.8 * r, inner, 0.5 * h + long, sides)]
        if self.gland_form != "pipe":
            stub.append(hexagon(2.4 * r, 0.49 * h, 0.5 * h + 1.2 * r))
        if self.gland_form == "stepped":
            stub.append(cylinder(1.3 * r, 0.5 * h + 1.1 * r, 0.5 * h + 2.4 * r, sides))
        one = merge(stub)
        shift = at(0, 0, 0.5 * (w - h))
        found, y = [], -0.5 * d
        bottom = [0.0] if self.shape in ("round", "octagon", "domed", "cross") else []
        xs = bottom or [(k - (self.glands - 1) / 2) * 0.8 * w / max(self.glands, 1) for k in range(self.glands)]
        for x in xs if self.glands else ():
            found.append(moved(one, at(x, y) @ spun("x", np.pi)))
            if self.wired and z - 0.5 * h - long > 0.06:
                low = -0.5 * h - 0.9 * long
                end = max(-z + 0.02, low - 0.6)
                bow = min(0.1, 0.4 * (low - end))
                found.append(rope([(x, y, low), (x, y, end + bow), (x, y - 0.4 * bow, end)], 0.6 * r, 8))
        ways = ("x", "-x")[: self.beside]
        found += [along(way, moved(one, shift), 0, y, 0) for way in ways]
        found += [moved(one, at(0, y))] * self.above
        return found

    def _mount(self, t: Table, w: float, h: float, z: float, d: float, n: int) -> None:
        q = min(self.bar, 0.4 * w)
        if self.mount in ("wall", "plate"):
            if self.mount == "plate":
                t.add("plate", box((1.3 * w, 0.012, 1.3 * h), (0, -0.005, z)), own=False)
            self.back.build(t, z + h / 2 + 0.3, w + 0.3)
        elif self.mount == "floor":
            y = -0.5 * d
            t.add(_JB, box((1.1 * w, 1.1 * d, z - 0.5 * h + 0.005), (0, y, (z - 0.5 * h + 0.005) / 2)), of="clamp")
        elif self.mount == "stake":
            top = z - 0.35 * h
            shaft = (
                rod((0, 0, 0), (0, 0, top), q, max(6, n))
                if self.round_bar
                else box((2 * q, 2 * q, top), (0, 0, top / 2))
            )
            t.at(0, -0.35 * d).add("post", shaft, box((0.2, 0.2, 0.01), (0, 0, 0.005)))
        elif self.mount == "post":
            top = z + 0.6 * h
            shaft = (
                rod((0, q, 0), (0, q, top), q, max(6, n))
                if self.round_bar
                else box((2 * q, 2 * q, top), (0, q, top / 2))
            )
            t.add("post", shaft, box((4 * q + 0.06, 4 * q + 0.06, 0.01), (0, q, 0.005)))
            t.add("bracket", box((0.8 * w, 0.012, 0.5 * h), (0, 0.002, z)), own=False)
        else:
            top, b = z + 0.3 * h, min(q, 0.1 * w + 0.01)
            bars = [box((b, b, top), (s * 0.42 * w, b / 2 - 0.002, top / 2)) for s in BOTH]
            t.add("post", *bars, box((w, b, b), (0, b / 2 - 0.002, z)))


PLAIN_BOXES = families_of(Nameplate, PlainPanel, PlainJunctionBox)
