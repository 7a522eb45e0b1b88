"""Gauges and manometers on panels, walls, stands and ducts."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.dials import CASE, STEM, Dial, Indicator, Shank, StandingGauge, fine_sides, upright
from cadplants.builder.draws import made
from cadplants.builder.params import Params, among, between, chance, given, nested, several, whole
from cadplants.builder.table import Table
from cadplants.families.instruments.pieces import BEFORE, FRONT, Board, Gauge, Stand, bent, put, t_handle
from cadplants.families.valves.valve import bolt_circle, disc_flange
from cadplants.model.family import Model
from cadplants.model.plant import Turning
from cadplants.model.standards import PIPES
from cadplants.parts.flange import plate_thickness
from cadplants.solids.mesh_ops import extrude, moved, sweep
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import along, box, cylinder, hexagon, ring, rod, rope
from cadplants.solids.transforms import at, spun

__all__ = ["PANEL_BUILDS"]

_KIND, _DIFFERENTIAL = "pressure gauge", "differential pressure gauge"
_SIZE, _MIDDLE = "diameter of a case", "height of the gauges' middle"


class _Mounted(Gauge, place="floor"):
    """A gauge on something that stands on the floor."""


class OnPanel(_Mounted, name="gauge/panel"):
    """Gauges let into a panel: front flange, U-clamp with knurled nuts and connection behind (EN 837-1, 40 to 160)."""

    size: float = among((0.063, 0.1, 0.1, 0.16), _SIZE, "m")
    count: int = whole(1, 4, "gauges side by side")
    middle: float = between(1.1, 1.6, _MIDDLE, "m")
    board: Board = nested(Board, "what they are let into")
    form: int = whole(0, 2, "round, round with screws, square")
    dials: tuple[Dial, ...] = several(
        made(Dial, lambda _: {"design": "plain", "deep": 0.4}),
        lambda p: p.count,
        "cases with their dials",
        when=lambda p: p.form < 2,
    )
    squares: tuple[Indicator, ...] = several(
        made(Indicator), lambda p: p.count, "square cases", when=lambda p: p.form == 2
    )

    def build(self, t: Table) -> Model:
        size, pitch = self.size, 1.6 * self.size
        self.board.build(t, pitch * self.count + 0.15, self.middle - size, self.middle + size)
        heads: tuple[Dial | Indicator, ...] = (*self.dials, *self.squares)
        for k, head in enumerate(heads):
            place = t.at((k - (self.count - 1) / 2) * pitch, 0, self.middle).along("-y")
            if isinstance(head, Indicator):
                head.build(place, size, size, 0.05)
            else:
                head.build(place, size)
                place.add(CASE, ring(0.49 * size, 0.66 * size, 0.0, 0.004, t.n(size / 2)))
                if self.form == 1:
                    place.add("bolt", bolt_circle(3, 0.6 * size, 0.004, 0.0, 0.004))
            self._behind(place)
        return t.model(kind=_KIND)

    def _behind(self, t: Table) -> None:
        """Can, connection and clamp behind the panel."""
        size, behind = self.size, self.board.thick
        low, span = -behind - 0.35 * size, 0.44 * size
        t.add(CASE, cylinder(0.4 * size, low, 0.0, t.n(size / 2)))
        tube = bent([(0, 0, low - 0.03), (0, 0, low - 0.07), (0, -0.6 * self.middle, low - 0.07)], 0.003, t.style)
        put(t, STEM, hexagon(0.02, low - 0.02, low), cylinder(0.0065, low - 0.035, low, 10), tube)
        path = np.array([(-span, 0, -behind), (-span, 0, low - 0.004), (span, 0, low - 0.004), (span, 0, -behind)])
        section = np.array([[-0.008, -0.0015], [0.008, -0.0015], [0.008, 0.0015], [-0.008, 0.0015]])
        nuts = [moved(cylinder(0.006, low - 0.012, low - 0.0055, 10), at(s * 0.27 * size)) for s in (-1, 1)]
        t.add("bracket", sweep(path, section, up=(0, 1, 0)), *nuts, of="clamp")


class _WallGauge(Params):
    """A gauge on a wall, with its tube."""

    design: str = among(("plain", "safety", "cast"), "how its case is made")
    dial: Dial = nested(Dial, "case with its dial", fixed=lambda p: {"design": p.design})
    disc: bool = chance(0.6, "its rear flange is round, not a strap")
    foot: Shank = nested(Shank, "connection")
    clip: bool = chance(0.6, "a clip holds its tube")

    def build(self, t: Table, size: float, middle: float) -> None:
        """Puts it down in front of y = 0, its case of a diameter on a height [m]."""
        case, low = t.at(0, 0, middle).along("-y"), middle - 0.5 * size
        self.dial.build(case.at(0, 0, 0.006), size)
        if self.disc:
            case.add(CASE, cylinder(0.68 * size, 0.0, 0.005, t.n(size / 2)))
        else:
            strap = box((0.2 * size, 1.35 * size, 0.004), (0, 0, 0.002))
            case.add(CASE, strap, cylinder(0.47 * size, 0.0, 0.006, t.n(size / 2)))
        case.add("bolt", bolt_circle(3, 0.61 * size, 0.005, -0.002, 0.005))
        y = -0.25 * size
        self.foot.build(t.at(0, y, low), -0.04, 0.004, size)
        drop = [(0, y, low - 0.036), (0, y, low - 0.12), (0, -0.012, low - 0.2), (0, -0.012, 0.25)]
        put(t, STEM, bent(drop, 0.004, t.style))
        if self.clip:
            t.add("clamp", box((0.04, 0.014, 0.012), (0, -0.007, low - 0.3)))


class OnWall(_Mounted, name="gauge/wall"):
    """Gauges on a wall or board by their rear flanges, a tube to each from below (EN 837-1, form with rear flange)."""

    size: float = among((0.08, 0.1, 0.16, 0.25), _SIZE, "m")
    count: int = whole(1, 3, "gauges side by side")
    middle: float = between(1.2, 1.7, _MIDDLE, "m")
    board: Board = nested(Board, "what they are on")
    gauges: tuple[_WallGauge, ...] = several(made(_WallGauge), lambda p: p.count, "gauges")

    def build(self, t: Table) -> Model:
        size, pitch = self.size, 1.7 * self.size
        self.board.build(t, pitch * self.count + 0.2, self.middle - 0.5 * size - 0.35, self.middle + size)
        for k, gauge in enumerate(self.gauges):
            gauge.build(t.at((k - (self.count - 1) / 2) * pitch), size, self.middle)
        return t.model(kind=_KIND)


class CapillarySeal(_Mounted, name="gauge/capillary seal"):
    """A gauge on a post bracket with an armoured capillary to a diaphragm seal on a standpipe with a flange."""

    height: float = between(0.9, 1.5, "of the post", "m")
    size: float = among((0.1, 0.16), _SIZE, "m")
    pipe: int = among((50, 80), "nominal size of the standpipe", "mm")
    stand: Stand = nested(Stand, "post")
    out: float = between(0.3, 0.7, "from the post to the standpipe", "m")
    low: float = between(0.3, 0.6, "height of the standpipe", "m")
    dial: Dial = nested(Dial, "case with its dial")
    foot: Shank = nested(Shank, "connection")

    def build(self, t: Table) -> Model:
        size, pipe, out, low = self.size, PIPES[self.pipe], self.out, self.low
        thick, z, deep = plate_thickness(self.pipe), self.height - 0.15, self.dial.reach(self.size)
        y = -max(0.052, 0.04 + deep / 2)  # clear of the post behind its case
        self.stand.build(t, self.height)
        shelf = box((0.05, -0.005 - y, 0.006), (0, (y - 0.055) / 2, z - 0.003))
        plates = [shelf, box((0.08, 0.006, 0.09), (0, -0.0332, z - 0.04))]
        t.add("bracket", *plates, of="clamp")
        end = t.at(out, 0, low)
        t.at(out).add("pipe", cylinder(pipe.radius, 0.0, low - 0.06, t.n(pipe.radius)))
        end.along("-z").add("flange", disc_flange(self.pipe, t.style, 0.061))
        nipple = along("x", hexagon(0.02, 0.0, 0.05), 0.3 * pipe.outer, 0, thick + 0.006)
        put(end, STEM, disc_flange(self.pipe, t.style, thick + 0.012), nipple)
        gauge = t.at(0, y)
        self.foot.build(gauge, z - 0.02, z + 0.042, size)
        self.dial.build(upright(gauge, size, z + 0.04, deep), size)
        hang = out + 0.3 * pipe.outer + 0.05
        line = [(0, 0, z - 0.018), (0, 0, z - 0.12), (0.4 * out, -0.05, 0.45 * low), (hang + 0.12, -0.12, 0.7 * low)]
        line += [(hang + 0.1, 0, low + thick + 0.006), (hang - 0.002, 0, low + thick + 0.006)]
        # The capillary starts under the gauge, before the post, passes the standpipe and ends in its plane.
        way = [(a, b + y * (1 - a / (hang + 0.12)), c) for a, b, c in line]
        put(t, STEM, bent(way, 0.0035, t.style), of="rubber")
        return t.model(kind=_KIND)


class _Edgewise(Params):
    """A gauge with an upright or fan-shaped scale in a narrow case."""

    fan: bool = given(False, "its scale is a fan")
    deep: float = between(0.03, 0.06, "depth of its case", "m")
    swing: float = between(-0.35, 0.35, "where the needle of a fan points", "rad", when=lambda p: p.fan)
    level: float = between(-0.3, 0.3, "height of an upright scale's needle / of the case", when=lambda p: not p.fan)
    glazed: bool = chance(0.5, "has a window")

    def build(self, t: Table, tall: float) -> None:
        """Puts it down with its back on z = 0, this high [m]."""
        shape, deep, wide = self._shape(tall), self.deep, 0.5 * tall
        if self.fan:
            pivot = (0.0, -0.35 * tall, 0.8 * deep + 0.002)
            hand, turns = at(*pivot) @ spun("z", self.swing), Turning("needle", point=pivot)
            needle = moved(box((0.004, 0.7 * tall, 0.001), (0, 0.35 * tall, 0)), hand)
        else:
            turns = None
            needle = box((0.5 * wide, 0.006, 0.001), (0.1 * wide, self.level * tall, 0.8 * deep + 0.002))
        t.add(CASE, extrude(0.9 * shape, 0.0, 0.8 * deep), extrude(shape, 0.78 * deep, deep, (0.82 * shape,)))
        t.add("gauge face", extrude(0.81 * shape, 0.8 * deep, 0.8 * deep + 0.0015), front=FRONT)
        t.add("gauge needle", needle, turns=turns, front=FRONT)
        if self.glazed:
            t.add("gauge glass", extrude(0.815 * shape, 0.94 * deep, 0.96 * deep), front=FRONT)

    def _shape(self, tall: float) -> Floats:
        if not self.fan:
            return rounded_rectangle(0.5 * tall, tall, 0.06 * tall, 3)
        turns = np.linspace(np.pi / 2 + 0.5, np.pi / 2 - 0.5, 9)[::-1]
        arc = np.column_stack([0.9 * tall * np.cos(turns), 0.9 * tall * np.sin(turns) - 0.5 * tall])
        return np.vstack([[(-0.1 * tall, -0.4 * tall), (0.1 * tall, -0.4 * tall)], arc])


class Sector(_Mounted, name="gauge/sector"):
    """A profile gauge: an upright or fan-shaped scale in a narrow case, in a panel front (DIN 43700 edgewise)."""

    tall: float = among((0.144, 0.192), "height of a case", "m")
    middle: float = between(1.1, 1.6, _MIDDLE, "m")
    count: int = whole(1, 4, "gauges side by side")
    board: Board = nested(Board, "what they are on")
    fan: bool = chance(0.5, "their scales are fans")
    gauges: tuple[_Edgewise, ...] = several(made(_Edgewise, lambda p: {"fan": p.fan}), lambda p: p.count, "gauges")

    def build(self, t: Table) -> Model:
        tall, pitch = self.tall, 0.75 * self.tall
        self.board.build(t, pitch * self.count + 0.15, self.middle - tall, self.middle + tall)
        for k, gauge in enumerate(self.gauges):
            gauge.build(t.at((k - (self.count - 1) / 2) * pitch, 0, self.middle).along("-y"), tall)
        return t.model(kind=_KIND)


class Differential(_Mounted, name="gauge/differential"):
    """A differential gauge: a cell of two flanges behind the dial, a three-valve manifold, two tubes, on a stand."""

    height: float = between(1.0, 1.5, "of the stand", "m")
    size: float = among((0.1, 0.115, 0.16), _SIZE, "m")
    stand: Stand = nested(Stand, "stand")
    radius: float = between(0.045, 0.07, "of the cell", "m")
    bolts: int = among((6, 8), "of the cell")
    dial: Dial = nested(Dial, "case with its dial")

    def build(self, t: Table) -> Model:
        r, n, z, y = self.radius, t.n(0.05), self.height - 0.1, -0.2
        self.stand.build(t, self.height)
        # The manifold is below the dial's case, so that its handles turn.
        cell, low = t.at(0, y, z).along("x"), z - max(r + 0.022, 0.6 * self.size + 0.015)
        plates = [cylinder(r, a, b, n) for a, b in ((-0.032, -0.002), (0.002, 0.032))]
        cell.add(CASE, *plates, cylinder(0.8 * r, -0.003, 0.003, n))
        cell.add("bolt", bolt_circle(self.bolts, 0.85 * r, 0.008, -0.032, 0.032))
        self.dial.build(t.at(0, y - 0.9 * r, z).along("-y"), self.size)
        tees = [along(a, t_handle(0.05, 0.04), s * 0.044, y, low) for a, s in (("x", 1), ("-x", -1))]
        tees.append(along("-y", t_handle(0.05, 0.04), 0, y - 0.019, low - 0.008))
        necks = [moved(cylinder(0.008, low, z - 0.9 * r, 10), at(x, y)) for x in (-0.017, 0.017)]
        put(t, STEM, box((0.09, 0.04, 0.05), (0, y, low)), *necks, *tees)
        for x in (-0.027, 0.027):
            way = [(x, y, low - 0.018), (x, y, low - 0.128), (2 * x, y + 0.05, 0.5 * z), (2 * x, y + 0.05, 0.1)]
            put(t, STEM, bent(way, 0.005, t.style))
        arm = box((0.04, -y - 0.035, 0.006), (0, y / 2 - 0.017, z + r - 0.01))
        t.add("bracket", box((0.06, 0.006, 2 * r), (0, -0.0332, z)), arm, of="clamp")
        return t.model(kind=_DIFFERENTIAL)


class UTube(_Mounted, name="gauge/u-tube"):
    """A U-tube manometer: a bent glass tube with a scale on a board, its ends with nipples or hose (to 1.5 m)."""

    span: float = between(0.3, 1.1, "height of the tube", "m")
    low: float = between(0.5, 0.9, "of the tube over the floor", "m")
    apart: float = between(0.02, 0.04, "from the middle to a leg of the tube", "m")
    wide: float = between(0.25, 0.6, "width of what it is on", "m")
    board: Board = nested(Board, "what it is on")
    metal: str = among(("gauge", "handle", "dial"), "kind of material of its plank")

    def build(self, t: Table) -> Model:
        span, low, apart, y = self.span, self.low, self.apart, -0.018
        self.board.build(t, self.wide, low - 0.1, low + span + 0.15)
        t.add(CASE, box((4.5 * apart, 0.012, span + 0.08), (0, -0.006, low + span / 2)), of=self.metal)
        turn = np.linspace(np.pi, 2 * np.pi, 9)
        foot = [(apart * np.cos(a), y, low + apart * (1 + np.sin(a))) for a in turn]
        path = [(-apart, y, low + span), *foot, (apart, y, low + span)]
        t.add("gauge glass", rope(path, 0.0055, fine_sides(0.0055, t.style, 10)), front=BEFORE)
        ticks = [box((0.8 * apart, 0.001, 0.0015), (0, -0.0145, low + s * span)) for s in np.linspace(0.12, 0.9, 14)]
        scale = box((1.1 * apart, 0.002, 0.9 * span), (0, -0.013, low + 0.52 * span))
        t.add("gauge face", scale, *ticks, front=BEFORE)
        for x in (-apart, apart):
            put(t.at(x, y, low + span - 0.005), STEM, cylinder(0.009, 0.0, 0.03, 12), hexagon(0.022, 0.02, 0.035))
            way = [(x, y, low + span + 0.025), (x, y, low + span + 0.09), (3.5 * x, y, low + span + 0.07)]
            put(t, STEM, bent([*way, (4 * x, y, low)], 0.005, t.style), of="rubber")
        clips = [box((2.6 * apart, 0.01, 0.008), (0, y + 0.001, low + s * span)) for s in (0.25, 0.75)]
        t.add(CASE, *clips, of="clamp")
        return t.model(kind="manometer")


class InclinedTube(_Mounted, name="gauge/inclined tube"):
    """An inclined-tube manometer for draught: a moulded plate, a slanting glass, a well with a knob, two ports."""

    wide: float = between(0.22, 0.4, "width of the plate", "m")
    tall: float = between(0.1, 0.18, "height of the plate", "m")
    middle: float = between(1.1, 1.6, "height of its middle", "m")
    deep: float = between(0.012, 0.025, "thickness of the plate", "m")
    board: Board = nested(Board, "what it is on")

    def build(self, t: Table) -> Model:
        wide, tall, z, deep = self.wide, self.tall, self.middle, self.deep
        self.board.build(t, wide + 0.2, z - tall, z + tall)
        t = t.at(0, 0, z).along("-y")
        t.add(CASE, extrude(rounded_rectangle(wide, tall, 0.1 * tall, 3), 0.0, deep))
        glass = rod((-0.4 * wide, -0.25 * tall, deep + 0.003), (0.42 * wide, 0.3 * tall, deep + 0.003), 0.004, 8)
        t.add("gauge glass", glass, front=FRONT)
        scale = box((0.75 * wide, 0.1 * tall, 0.002), (0, 0, deep + 0.001))
        t.at(0.02 * wide, -0.12 * tall).add("gauge face", moved(scale, spun("z", 0.27)), front=FRONT)
        well = along("y", cylinder(0.012, -0.3 * tall, 0.1 * tall, 12), -0.42 * wide, -0.05 * tall, deep + 0.008)
        knob = along("-y", cylinder(0.016, 0.0, 0.018, 12), -0.42 * wide, -0.34 * tall, deep + 0.008)
        t.add(CASE, well, knob, of="trim")
        for x in (-0.42 * wide, 0.44 * wide):
            way = [(x, 0.35 * tall, deep - 0.001), (x, 0.35 * tall, deep + 0.03), (x, -tall, deep + 0.03)]
            put(t, STEM, bent(way, 0.004, t.style), of="rubber")
        return t.model(kind="manometer")


class Draught(_Mounted, name="gauge/draught"):
    """A low-pressure dial on a filter duct's wall: a shallow case with a wide flange, two hoses to probes (4 in)."""

    size: float = among((0.08, 0.12), _SIZE, "m")
    middle: float = between(1.0, 1.5, _MIDDLE, "m")
    wide: float = between(0.5, 0.9, "width of the duct", "m")
    deep: float = between(0.3, 0.6, "depth of the duct", "m")
    dial: Dial = nested(Dial, "case with its dial", fixed=lambda _: {"design": "plain", "deep": 0.45})

    def build(self, t: Table) -> Model:
        size, z, wide, deep = self.size, self.middle, self.wide, self.deep
        t.add("filter", box((wide, deep, z + 0.4), (0, deep / 2, (z + 0.4) / 2)), of="tank")
        case = t.at(0, 0, z).along("-y")
        self.dial.build(case, size)
        case.add(CASE, cylinder(0.6 * size, 0.0, 0.006, t.n(size / 2)))
        for s in (-1, 1):
            x, high = s * 0.3 * wide, z + s * 0.15
            put(t.at(x, 0, high).along("-y"), STEM, cylinder(0.018, 0.0, 0.004, 12), cylinder(0.006, 0.0, 0.02, 10))
            way = [(x, -0.018, high), (x, -0.06, high), (0.5 * x, -0.07, z - 0.1)]
            way += [(s * 0.55 * size, -0.06, z), (s * 0.48 * size, -0.03, z)]
            put(t, STEM, bent(way, 0.004, t.style), of="rubber")
        return t.model(kind=_DIFFERENTIAL)


class OnPost(_Mounted, name="gauge/post"):
    """A gauge with its tube on a bracket that a short post carries: a tubed compound on a skid's edge."""

    height: float = between(0.6, 1.3, "of the post", "m")
    size: float = among((0.063, 0.1), _SIZE, "m")
    gauge: StandingGauge = nested(StandingGauge, "gauge", fixed=lambda p: {"size": p.size})

    def build(self, t: Table) -> Model:
        height, w, y, z = self.height, 0.04, -0.07, self.height - 0.06
        t.add("post", box((w, w, height - 0.008), (0, 0, 0.008 + (height - 0.008) / 2)))
        t.add("base plate", box((0.12, 0.12, 0.008), (0, 0, 0.004)))
        lip = box((0.05, 0.005, 0.06), (0, -w / 2 - 0.0025, height - 0.09))
        t.add("bracket", box((0.05, 0.078, 0.006), (0, -w / 2 - 0.039, z)), lip, of="clamp")
        put(t.at(0, y, z), STEM, extrude(circle(0.011, 12), -0.0031, 0.0031), hexagon(0.027, 0.003, 0.017))
        self.gauge.build(t.at(0, y), height - 0.045)
        way = [(0, y, height - 0.062), (0, y, height - 0.12), (0, y - 0.02, 0.4 * height), (0.3, y - 0.02, 0.12)]
        put(t, STEM, bent(way, 0.004, t.style))
        return t.model(kind=_KIND)


PANEL_BUILDS = families_of(OnPanel, OnWall, CapillarySeal, Sector, Differential, UTube, InclinedTube, Draught, OnPost)
