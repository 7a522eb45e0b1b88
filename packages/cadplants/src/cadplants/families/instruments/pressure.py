"""Pressure transmitters, switches and probes, and sight glasses."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.dials import STEM, Gland, Housing
from cadplants.builder.draws import one_of
from cadplants.builder.params import Params, among, between, chance, given, nested, several
from cadplants.builder.table import Table, outline
from cadplants.families.instruments.pieces import BEFORE, FRONT, Gauge, Stand, bent, put, t_handle
from cadplants.families.instruments.sight import SIGHT_GLASS, SightGlass
from cadplants.families.valves.threaded import hex_end
from cadplants.families.valves.valve import bolt_circle, disc_flange, flanged_body
from cadplants.model.family import Model
from cadplants.model.plant import Turning
from cadplants.model.standards import sizes_between
from cadplants.parts.flange import plate_thickness
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import along, around, box, cylinder, dome, hexagon, ring, rod, rope, turned
from cadplants.solids.transforms import at, spun

__all__ = ["COPLANAR", "NAME", "PRESSURE_BUILDS", "DifferentialHead"]

NAME, _KIND = "transmitter", "pressure transmitter"
COPLANAR = "one flange below the differential cell, not one on either side"
_TURN, _HEAD, _CELL = "which way its electronics look", "electronics", "cell with its electronics"


class _Transmitter(Gauge, label=NAME, bundle=NAME):
    """A transmitter on an outlet."""


class SingleChamber(_Transmitter, name="transmitter/single chamber"):
    """A single-compartment transmitter: hexagon, slim or fat cell, maybe cooling fins, a pot or drum with one cover."""

    radius: float = between(0.013, 0.028, "of the cell", "m")
    tall: float = between(0.03, 0.08, "height of the cell", "m")
    finned: bool = chance(0.3, "cooling fins")
    shape: str = among(("single", "pot", "slant", "rectangle"), "how its electronics are made")
    housing: Housing = nested(Housing, _HEAD, fixed=lambda p: {"shape": p.shape})
    turn: float = between(0, 6, _TURN, "rad")

    def build(self, t: Table) -> Model:
        r, tall, n = self.radius, self.tall, t.n(self.radius)
        cell = [cylinder(0.0095, 0.0, 0.02, 12), hexagon(max(0.027, 1.7 * r), 0.018, 0.036)]
        cell.append(cylinder(r, 0.034, 0.036 + tall, n))
        if self.finned:
            cell += [cylinder(1.3 * r, 0.04 + k * tall / 5, 0.04 + (k + 0.4) * tall / 5, n) for k in range(5)]
        t.add(NAME, *cell, of="trim")
        t.at(0, 0, 0.034 + tall).spun("z", self.turn).add(NAME, self.housing.solid(t.style))
        return t.model(kind=_KIND)


class Pencil(_Transmitter, name="transmitter/pencil"):
    """A pencil transmitter: a slim steel tube between a hexagon and a plug or a moulded cable."""

    radius: float = between(0.008, 0.013, "of the tube", "m")
    tall: float = between(0.06, 0.16, "height of the tube", "m")

    def build(self, t: Table) -> Model:
        r, tall, n, z = self.radius, self.tall, 14, 0.025 + self.tall
        body = [cylinder(0.0066, 0, 0.014, n), hexagon(2.2 * r + 0.003, 0.012, 0.026), cylinder(r, 0.025, z, n)]
        t.add(NAME, *body, cylinder(1.04 * r, 0.3 * tall + 0.025, 0.34 * tall + 0.025, n), of="trim")
        plug = turned(outline(0.7 * r, z - 0.001, 0.85 * r, z + 0.01, 0.85 * r, z + 0.03, 0.4 * r, z + 0.045), n)
        way = [(0, 0, z + 0.04), (0, 0, z + 0.09), (0.03, 0.01, z + 0.14), (0.1, 0.02, z + 0.05), (0.11, 0.02, z - 0.1)]
        t.add(NAME, plug, bent(way, 0.0028, t.style), of="rubber")
        return t.model(kind=_KIND)


class TurningDisplay(_Transmitter, name="transmitter/turning display"):
    """A compact switch with a turning display: hexagon, can, a slanting face with keys, a round plug behind."""

    radius: float = between(0.015, 0.021, "of the can", "m")
    low: float = between(0.03, 0.05, "height of the hexagon", "m")
    tall: float = between(0.05, 0.08, "height of the can", "m")
    turn: float = between(0, 6, "which way its display looks", "rad")

    def build(self, t: Table) -> Model:
        r, low, top, n = self.radius, self.low, self.low + self.tall, t.n(self.radius)
        t = t.spun("z", self.turn)
        body = [cylinder(0.0066, 0, 0.02, 12), hexagon(0.027, 0.016, low), cylinder(r, low - 0.001, top, n)]
        t.add(NAME, *body, of="trim")
        wedge = extrude(np.array(outline(-r, 0.0, r, 0.0, r, 0.02, -0.2 * r, 0.03, -r, 0.012)), -0.9 * r, 0.9 * r)
        # The outline lies in (y, z) and runs along x.
        t.at(0, 0, top - 0.001).add(NAME, Solid(wedge.vertices[:, [2, 0, 1]], wedge.faces), of="rubber")
        # It lies on the slope, whose upper edge is 0.2 r before the axis and 0.03 m high.
        lean = float(np.arctan2(0.018, 0.8 * r))
        slope = t.at(0, -0.6 * r, top + 0.02).spun("x", lean)
        slope.add("gauge face", box((1.3 * r, 0.6 * r, 0.003), (0, 0, 0.001)), front=FRONT)
        plug = [cylinder(0.006, 0.0, 0.02, 10), cylinder(0.0075, 0.01, 0.04, 10)]
        t.at(0, 0.95 * r, low + 0.7 * self.tall).along("y").add(NAME, *plug, of="trim")
        return t.model(kind=_KIND)


class HygienicTransmitter(_Transmitter, name="transmitter/hygienic"):
    """A hygienic transmitter: a ferrule, a two-piece clamp with a wing nut (ISO 2852), a polished can with a lid."""

    radius: float = among((0.0253, 0.032), "of the ferrule", "m")
    low: float = between(0.015, 0.03, "height of the clamp", "m")
    tall: float = between(0.05, 0.1, "height of the can", "m")
    wide: float = between(0.022, 0.042, "radius of the can", "m")
    neck: float = between(0.02, 0.05, "height of the neck under the can", "m")
    gland: Gland = nested(Gland, "cable gland")

    def build(self, t: Table) -> Model:
        r, low, wide, tall = self.radius, self.low, self.wide, self.tall
        n, m, z = t.n(r), t.n(wide), low + 0.015 + self.neck
        end = z + tall
        foot = turned(outline(0.5 * r, low - 0.01, r, low, r, low + 0.003), n)
        t.add(NAME, cylinder(0.4 * r, 0.0, low + 0.002, n), foot, of="pipe")
        band = [
            ring(0.88 * r, 1.22 * r, low - 0.005, low + 0.011, n),
            box((0.024, 0.03, 0.014), (1.3 * r, 0, low + 0.003)),
        ]
        wing = along("y", cylinder(0.004, -0.03, 0.035, 8), 1.35 * r, 0, low + 0.003)
        t.add("clamp", *band, wing, box((0.03, 0.008, 0.01), (1.35 * r, 0.034, low + 0.003)), own=True)
        lid = turned(outline(r, low + 0.0031, r, low + 0.006, 0.5 * r, low + 0.016), n)
        can = turned(outline(0.6 * wide, z, wide, z + 0.01, wide, end), m)
        top = [cylinder(1.08 * wide, end - 0.001, end + 0.02, m), dome(1.02 * wide, 0.25 * wide, end + 0.02, m)]
        cable = along("y", self.gland.solid(t.style, 0.016), 0, 0.97 * wide, z + 0.6 * tall)
        t.add(NAME, lid, cylinder(0.009, low + 0.01, z + 0.001, 12), can, *top, cable, of="trim")
        return t.model(kind=_KIND)


class SwitchBox(_Transmitter, name="transmitter/switch box"):
    """A pressure switch: a bellows or diaphragm housing under a rectangular box with a scale window and a knob."""

    radius: float = between(0.018, 0.035, "of the cell", "m")
    tall: float = between(0.02, 0.05, "height of the cell", "m")
    wide: float = between(0.045, 0.09, "width of the box", "m")
    deep: float = between(0.045, 0.07, "depth of the box", "m")
    high: float = between(0.08, 0.14, "height of the box", "m")
    right: bool = chance(0.5, "its cable gland is on the right")
    gland: Gland = nested(Gland, "cable gland")
    mark: float = between(0.35, 0.75, "height of the pointer / of the box")
    metal: str = among(("electrical", "valve", "rubber"), "kind of material of the box")
    turn: float = between(0, 6, "which way its window looks", "rad")

    def build(self, t: Table) -> Model:
        r, low, wide, deep, high = self.radius, 0.03 + self.tall, self.wide, self.deep, self.high
        t = t.spun("z", self.turn)
        cell = turned(outline(0.6 * r, 0.03, r, 0.036, r, low), t.n(r))
        put(t, STEM, cylinder(0.0068, 0.0, 0.032, 12), hexagon(0.022, 0.012, 0.026), cell)
        case = [box((wide, deep, high), (0, 0, low + high / 2 - 0.001))]
        case.append(box((1.03 * wide, 0.006, 0.96 * high), (0, -deep / 2, low + high / 2)))
        case.append(cylinder(0.012, low + high - 0.002, low + high + 0.014, 12))
        axis, s = ("x", 1) if self.right else ("-x", -1)
        t.add(NAME, *case, along(axis, self.gland.solid(t.style), 0.5 * s * wide, 0, low + 0.25 * high), of=self.metal)
        scale = box((0.4 * wide, 0.003, 0.55 * high), (0, -deep / 2 - 0.0042, low + 0.55 * high))
        t.add("gauge face", scale, front=BEFORE)
        place = (0.05 * wide, -deep / 2 - 0.0065, low + self.mark * high)
        t.add("gauge needle", box((0.2 * wide, 0.002, 0.004), place), front=BEFORE)
        return t.model(kind="pressure switch")


class DifferentialHead(Params):
    """A differential cell on z = 0 over a manifold, its process side below, with its electronics."""

    coplanar: bool = given(False, COPLANAR)
    shape: str = among(("double", "single"), "how its electronics are made")
    housing: Housing = nested(Housing, _HEAD, fixed=lambda p: {"shape": p.shape})

    def build(self, t: Table) -> None:
        """Puts it down."""
        t, top = t.bundled(NAME), 0.083 if self.coplanar else 0.098
        self._cell(t)
        t.at(0, 0, top).add(NAME, self.housing.solid(t.style))

    def _cell(self, t: Table) -> None:
        if self.coplanar:
            foot = turned(outline(0.043, 0.03, 0.043, 0.06, 0.025, 0.085), t.n(0.04))
            t.add(NAME, box((0.09, 0.075, 0.03), (0, 0, 0.015)), foot, of="trim")
            bolt = merge([cylinder(0.005, -0.02, 0.034, 8), hexagon(0.017, 0.03, 0.04)])
            t.add("bolt", *(moved(bolt, at(x, y)) for x in (-0.035, 0.035) for y in (-0.028, 0.028)))
            return
        flats = [box((0.022, 0.095, 0.08), (s * 0.027, 0, 0.04)) for s in (-1, 1)]
        body = along("x", cylinder(0.042, -0.017, 0.017, t.n(0.042)), 0, 0, 0.042)
        t.add(NAME, *flats, body, cylinder(0.025, 0.06, 0.1, 14), of="trim")
        rods = around(cylinder(0.005, -0.048, 0.048, 8), 4, 0.045, np.pi / 4)
        t.at(0, 0, 0.04).along("x").add("bolt", rods)


class PipeStand(_Transmitter, name="transmitter/pipe stand", place="floor"):
    """A differential transmitter on a manifold on a two-inch stand: bracket, U-bolt, needle valves, two tubes down."""

    height: float = between(1.1, 1.5, "of the stand", "m")
    stand: Stand = nested(Stand, "stand")
    tall: float = among((0.03, 0.06), "height of the manifold", "m")
    valves: int = among((2, 3, 5), "of the manifold")
    coplanar: bool = chance(0.6, COPLANAR)
    head: DifferentialHead = nested(
        DifferentialHead, _CELL, fixed=lambda p: {"coplanar": p.coplanar, "housing.both": False}
    )

    def build(self, t: Table) -> Model:
        z, y, wide, tall = self.height - 0.3, -0.16, 0.1, self.tall
        self.stand.build(t, self.height)
        block, half = [box((wide, 0.07, tall), (0, y, z - tall / 2))], z - tall / 2
        for x in np.linspace(-0.04, 0.04, self.valves)[1:-1]:
            block.append(along("-y", t_handle(0.06, 0.05), float(x), y - 0.035, half))
        block[1:1] = [along("-x", t_handle(0.06, 0.05), -0.5 * wide, y, half)]
        put(t, STEM, *block, along("x", t_handle(0.06, 0.05), 0.5 * wide, y, half))
        self.head.build(t.at(0, y, z).spun("z", np.pi))  # its gland away from the stand
        for x in (-0.027, 0.027):
            nut = moved(hexagon(0.018, -0.02, 0.001), at(x, y, z - tall))
            way = [(x, y, z - tall - 0.01), (x, y, z - tall - 0.12), (x, y - 0.12, 0.4 * z), (1.5 * x, y - 0.12, 0.08)]
            put(t, STEM, nut, bent(way, 0.005, t.style))
        arm = [box((0.08, 0.006, 0.11), (0, -0.0335, z - 0.02)), box((0.08, 0.075, 0.006), (0, y, z - tall - 0.0031))]
        arm[1:1] = [box((0.08, -y - 0.073, 0.006), (0, (y + 0.001) / 2, z - tall - 0.003))]
        t.add("bracket", *arm, of="clamp")
        a = np.linspace(0, np.pi, 9)
        bow = np.column_stack([0.034 * np.cos(a), 0.034 * np.sin(a), np.full(9, z)])
        t.add("u-bolt", rope(np.vstack([[0.034, -0.05, z], bow, [-0.034, -0.05, z]]), 0.0035, 8), of="clamp")
        return t.model(kind="differential pressure transmitter")


class FlangeSeal(_Transmitter, name="transmitter/flange seal", place="head", sizes=(40, 50, 80, 100)):
    """A remote-seal transmitter on its flange: a seal, an upright or bent link, the cell and its electronics."""

    out: float = between(0.05, 0.14, "length of the link", "m")
    coplanar: bool = chance(0.5, COPLANAR)
    shape: str = among(("double", "single", "pot"), "how its electronics are made")
    head: DifferentialHead = nested(DifferentialHead, _CELL, fixed=lambda p: {"coplanar": p.coplanar, "shape": p.shape})
    looped: bool = chance(0.4, "a second capillary comes off sideways in a loop")

    def build(self, t: Table) -> Model:
        t, thick = t.along("x"), plate_thickness(self.dn)
        link = [cylinder(0.024, thick, thick + 0.02, 16), cylinder(0.012, thick, thick + self.out + 0.01, 12)]
        t.add(NAME, disc_flange(self.dn, t.style, thick + 0.001), *link, of="trim")
        self.head.build(t.at(0, 0, thick + self.out))
        if self.looped:
            z = thick + self.out + 0.03
            way = [(0.034, 0, z), (0.14, 0, z), (0.2, 0.1, z - 0.03), (0.1, 0.22, z), (0.05, 0.3, z - 0.06)]
            t.add(NAME, bent(way, 0.004, t.style), of="rubber")
        return t.model(kind=_KIND)


class Probe(_Transmitter, name="transmitter/probe"):
    """A retractable analyser probe (pH, conductivity): a ball valve, a guide with rods, a shaft and head."""

    radius: float = between(0.012, 0.018, "of the shaft", "m")
    long: float = between(0.2, 0.4, "length of the shaft", "m")
    rods: int = among((2, 3), "of the guide")
    potted: bool = chance(0.5, "a pot on it, not a cable")
    housing: Housing = nested(Housing, "pot", fixed=lambda _: {"shape": "pot"}, when=lambda p: p.potted)

    def build(self, t: Table) -> Model:
        r, n, long, z = self.radius, 14, self.long, 0.12 + self.long
        nuts = [hexagon(3.4 * r, low, low + 0.02) for low in (0.015, 0.08)]
        t.add("valve body", cylinder(1.3 * r, 0.0, 0.11, n), *nuts, box((3 * r, 3 * r, 0.04), (0, 0, 0.057)), own=True)
        lever = cylinder(0.006, 1.4 * r, 2.6 * r, 8), box((0.12, 0.02, 0.006), (0.05, 0, 2.5 * r))
        t.at(0, 0, 0.057).along("y").add("lever", *lever, own=True, turns=Turning("lever"))
        shaft = [cylinder(r, 0.1, z, n), cylinder(2.2 * r, 0.11, 0.125, n)]
        shaft.append(cylinder(2.2 * r, 0.1 + 0.6 * long, 0.112 + 0.6 * long, n))
        guide = around(cylinder(0.004, 0.12, 0.105 + 0.6 * long, 8), self.rods, 1.8 * r)
        t.add(NAME, *shaft, guide, of="trim")
        if self.potted:
            t.at(0, 0, z - 0.005).add(NAME, self.housing.solid(t.style), of="rubber")
        else:
            way = [(0, 0, z + 0.045), (0, 0, z + 0.1), (0.1, 0, z + 0.08), (0.12, 0, z - 0.15)]
            t.add(NAME, cylinder(0.7 * r, z - 0.001, z + 0.05, n), bent(way, 0.004, t.style), of="rubber")
        return t.model(kind="analyser")


# --- sight glasses ---


class BoltedWindows(SightGlass, name="sight glass/bolted windows", sizes=sizes_between(most=150)):
    """A sight glass with two bolted covers, square or round, maybe the pointer of a flap inside (DIN 3237)."""

    square: bool = chance(0.5, "its covers are square")
    bolts: tuple[int, ...] = several(one_of(4, 6, 8), 2, "of each round cover", when=lambda p: not p.square)
    pointed: bool = chance(0.5, "the spindle of a flap with its pointer before the window")
    turn: float = between(0, 6, "where it points", "rad", when=lambda p: p.pointed)

    def build(self, t: Table) -> Model:
        radius, neck = t.pipe.radius, 0.485 * t.flange.hub
        long, reach, pane = 0.14 + 4 * radius, 1.15 * neck + 0.012, 0.9 * radius + 0.012
        length, half, n, thick = round(long, 6), 1.65 * pane, t.n(pane), 0.01 + 0.06 * pane
        middle = outline(neck, 0.32 * long, 1.15 * neck, 0.4 * long, 1.15 * neck, 0.6 * long, neck, 0.68 * long)
        x, low, high = length / 2, reach - 0.001, reach + thick
        if self.square:
            square = rounded_rectangle(2 * half, 2 * half, 0.25 * half, 3)
            cover, far = extrude(square, low, high, (circle(pane, n),)), 1.15 * half
        else:
            cover, far = ring(pane, half, low, high, n), 0.82 * half
        core = along("y", cylinder(1.2 * pane, -reach, reach, n), x)
        covers = [along(axis, cover, x) for axis in ("y", "-y")]
        t.add(SIGHT_GLASS, flanged_body(self.dn, t.style, long, middle), core, *covers, of="valve")
        glass = cylinder(0.99 * pane, reach + 0.0005, reach + 0.6 * thick, n)
        t.add("gauge glass", *(along(axis, glass, x) for axis in ("-y", "y")), front=BEFORE)
        bolts = [bolt_circle(k, far, 0.006 + 0.1 * pane, reach - 0.002, high) for k in self.bolts or (4, 4)]
        t.add("bolt", *(along(axis, some, x) for axis, some in zip(("y", "-y"), bolts, strict=True)))
        if self.pointed:
            pin = cylinder(0.004, reach + 0.6 * thick, high + 0.02, 8)
            arrow = box((1.2 * pane, 0.008, 0.003), (0.3 * pane, 0, high + 0.012))
            hand = t.at(x).along("-y").spun("z", self.turn)
            hand.add("gauge needle", pin, arrow, of="handle", turns=Turning("needle"), front=FRONT)
        return t.model(length, kind=SIGHT_GLASS)


_SMALL = sizes_between(most=50)


class Threaded(SightGlass, name="sight glass/threaded", sizes=_SMALL):
    """A screwed bronze flow sight: two hexagon ends, a bowl with one or two screwed window rings."""

    single: bool = chance(0.5, "one window, not two")
    octagonal: bool = chance(0.5, "its window rings have eight sides")
    painted: bool = chance(0.2, "painted, not bare bronze")

    def build(self, t: Table) -> Model:
        radius = t.pipe.radius
        length, r, deep = round(0.07 + 4.4 * radius, 6), 0.016 + 1.1 * radius, 1.1 * radius + 0.012
        n, x, axes = t.n(r), length / 2, ("-y",) if self.single else ("-y", "y")
        body = [hex_end(self.dn, a * length, b * length, t.style) for a, b in ((0, 0.2), (0.8, 1))]
        body.append(along("y", turned(outline(0.8 * r, -deep, r, -0.8 * deep, r, deep), n), x))
        body.append(along("x", cylinder(1.05 * radius, 0.15 * length, 0.85 * length, n)))
        nut = outline(1.15 * r, deep - 0.006, 1.15 * r, deep + 0.008, 1.0 * r, deep + 0.012)
        body += [along(axis, turned(nut, 8 if self.octagonal else n), x) for axis in axes]
        t.add(SIGHT_GLASS, *body, of="handle" if self.painted else "trim")
        panes = [along(axis, dome(0.8 * r, 0.25 * r, deep + 0.012, n), x) for axis in axes]
        t.add("gauge glass", *panes, front=BEFORE)
        return t.model(length, "welded", SIGHT_GLASS)


class FullView(SightGlass, name="sight glass/full view", sizes=_SMALL):
    """A full-view sight glass with screwed ends: a glass tube between two caps, tie rods outside, maybe a spinner."""

    long: float = between(5, 8, "its length over 0.1 m / radius of the pipe")
    wide: float = between(2.6, 3.2, "width of its caps over 30 mm / radius of the pipe")
    square: bool = chance(0.6, "its caps are square")
    spinner: bool = chance(0.4, "a spinner in it")

    def build(self, t: Table) -> Model:
        radius = t.pipe.radius
        length, r, side = round(0.1 + self.long * radius, 6), 1.5 * radius + 0.008, self.wide * radius + 0.03
        n, low, thick, line = t.n(r), 0.17 * length, 0.012, t.along("x")
        caps = [hex_end(self.dn, a, b, t.style) for a, b in ((0, low), (length - low, length))]
        square = rounded_rectangle(side, side, 0.2 * side, 3)
        plan = square if self.square else circle(0.6 * side, n)
        plate = extrude(plan, low - thick, low, (circle(bore_of(self.dn, t.style), n),) if t.style.hollow else ())
        caps += [along("x", plate), along("x", plate, length - 2 * low + thick)]
        t.add(SIGHT_GLASS, *caps)
        line.add("gauge glass", ring(0.85 * r, r, low, length - low, n))
        far = max(0.36 * side * np.sqrt(2), r + 0.006)
        rod_ = cylinder(0.004, low - thick - 0.008, length - low + thick + 0.008, 8)
        line.add("stud", around(rod_, 4, far, np.pi / 4))
        if self.spinner:
            vanes = around(box((0.5 * r, 0.003, 0.02), (0.3 * r, 0, 0)), 4)
            shaft = cylinder(0.1 * r, low - length / 2, length / 2 - low, 8)
            line.at(0, 0, length / 2).add("gauge needle", vanes, shaft, of="handle")
        return t.model(length, "welded", SIGHT_GLASS)


class SightPort(SightGlass, name="sight glass/port", place="head", sizes=(50, 80, 100, 150, 200)):
    """A round sight port on a vessel's nozzle (DIN 28120): a pane under a bolted ring, maybe a lamp."""

    bolts: int = among((4, 6, 8), "of its ring")
    lit: bool = chance(0.5, "a lamp over it")

    def build(self, t: Table) -> Model:
        t, wide, thick, n = t.along("x"), t.flange.raised, plate_thickness(self.dn), t.n(t.flange.raised / 2)
        pane, inner = 0.42 * wide, 0.36 * wide
        cover = ring(inner, 0.55 * wide, thick, thick + 0.012, n)
        lip = ring(0.9 * pane, 1.05 * pane, thick + 0.01, thick + 0.018, n)
        t.add(SIGHT_GLASS, disc_flange(self.dn, t.style, thick + 0.002), cover, lip)
        t.add("gauge glass", cylinder(0.99 * inner, thick + 0.002, thick + 0.009, n), front=FRONT)
        t.add("bolt", bolt_circle(self.bolts, 0.5 * wide, 0.006, thick + 0.001, thick + 0.012))
        if self.lit:
            post = rod((0.48 * wide, 0, thick + 0.011), (0.48 * wide, 0, thick + 0.08), 0.005, 8)
            torch = turned(outline(0.5 * inner, -0.02, 0.5 * inner, 0.07, 0.35 * inner, 0.09), 14)
            lean = at(0.4 * wide, 0, thick + 0.08) @ spun("y", 0.5)  # it shines on the pane's middle
            t.add("lamp", post, moved(torch, lean), of="electrical", own=True)
        return t.model(kind=SIGHT_GLASS)


class Refrigerant(SightGlass, name="sight glass/refrigerant", sizes=sizes_between(most=40)):
    """A refrigerant sight glass: a brass block on copper stubs, a bull's eye on top, maybe its cap on a strap."""

    capped: bool = chance(0.5, "a cap on a strap")

    def build(self, t: Table) -> Model:
        radius = t.pipe.radius
        length, r, top = round(0.09 + 3 * radius, 6), 0.012 + 0.75 * radius, 1.15 * radius + 0.012
        n, middle = t.n(r), t.at(length / 2)
        stub = along("x", ring(bore_of(self.dn, t.style), 1.12 * radius, 0.0, length, t.n(radius)), -length / 2)
        middle.add(SIGHT_GLASS, stub, cylinder(r, -1.1 * radius, top, n), hexagon(2.1 * r, top - 0.012, top))
        middle.add("gauge glass", dome(0.8 * r, 0.3 * r, top, n), front=FRONT)
        if self.capped:
            strap = rod((0, 0.9 * r, top - 0.004), (0, 2.7 * r, top + 0.012), 0.002, 6)
            cap = moved(cylinder(0.9 * r, 0.0, 0.008, n), at(0, 2.7 * r, top + 0.01) @ spun("x", 0.7))
            middle.add(SIGHT_GLASS, strap, cap, of="rubber")
        return t.model(length, "welded", SIGHT_GLASS)


PRESSURE_BUILDS = families_of(
    SingleChamber, Pencil, TurningDisplay, HygienicTransmitter, SwitchBox, PipeStand, FlangeSeal, Probe,
    BoltedWindows, Threaded, FullView, SightPort, Refrigerant,
)  # fmt: skip
