"""Small pumps of plain shapes: circulators in a line, dosing pumps, air-operated diaphragm pumps."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, whole
from cadplants.builder.table import Table, outline
from cadplants.families.machines.drives import CASING, dead_room
from cadplants.families.machines.plain_parts import PlainPort, PlainPump, Threaded, port_of
from cadplants.model.family import Model
from cadplants.model.standards import sizes_between
from cadplants.parts.flange import plate_thickness
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, extrude, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, hexagon, ring, rod, turned
from cadplants.solids.transforms import at

__all__ = ["PLAIN_SMALL"]


class Circulator(PlainPump, name="pump/plain circulator", place="inline", sizes=sizes_between(15, 80), weight=2):
    """A wet-rotor circulator of plain shapes: unions, flanges or bare ends, a drum, a can with a head of some form."""

    ends: str = among(
        lambda p: ("union", "union", "bare", "flange") if p.dn <= 32 else ("flange", "flange", "bare"), "its ends"
    )
    long: float = between(0.9, 1.7, "length / a common one")
    wide: float = between(1.4, 2.4, "(radius of the drum - 15 mm) / of the pipe")
    thick: float = between(0.35, 0.7, "half the thickness of the drum / its radius")
    drum: str = among(("drum", "bevelled", "ball"), "form of the drum")
    can: float = between(0.65, 1.1, "radius of the can / of the drum")
    deep: float = between(0.7, 2.2, "length of the can / radius of the drum")
    head: str = among(("none", "cap", "disc", "box", "square", "side box"), "what is on the can")
    turn: float = among((0.0, 0.0, np.pi / 2, np.pi), "where the can looks: aside, up, to the other side", "rad")
    twin: bool = chance(0.12, "two of them side by side")

    def build(self, t: Table) -> Model:
        p = t.pipe.radius
        r = p * self.wide + 0.015
        least = 2 * (dead_room(self.dn) + 0.02) if self.ends == "flange" else 0.05
        length = round(max(self.long * (0.1 + 2.6 * p), least + 1.4 * r, 2.3 * r), 6)
        n, half = self.n(t, r), self.thick * r
        xs = (0.5 * length,) if not self.twin else (0.5 * length - 0.62 * r, 0.5 * length + 0.62 * r)
        small = r if not self.twin else 0.58 * r
        t.add(CASING, *self._run(t, length, p, n), *(along("y", self._drum(small, half, n), x) for x in xs))
        for x in xs:
            self._motor(t.at(x).spun("x", self.turn).along("y").bundled("motor"), small, half, n)
        return t.model(length, "flanged" if self.ends == "flange" else "welded", "circulator")

    def _run(self, t: Table, length: float, p: float, n: int) -> list[Solid]:
        bore = bore_of(self.dn, t.style)
        run = [along("x", ring(bore, 1.15 * p, 0.0, length, n))]
        if self.ends == "flange":
            thick, rim = plate_thickness(self.dn), t.flange.outer / 2
            run += [along("x", ring(bore, rim, x, x + thick, n)) for x in (0.0, length - thick)]
        elif self.ends == "union":
            deep = 0.4 * p + 0.012
            run += [along("x", hexagon(3.3 * p, x, x + deep, bore, n)) for x in (0.012, length - 0.012 - deep)]
        return run

    def _drum(self, r: float, half: float, n: int) -> Solid:
        if self.drum == "drum":
            return cylinder(r, -half, half, n)
        if self.drum == "bevelled":
            return turned(outline(0.7 * r, -half, r, -0.4 * half, r, half), n)
        a = np.linspace(-1.1, 1.1, 7)
        return turned([(r * float(np.cos(k)), half * float(np.sin(k)) / 0.89) for k in a], n)

    def _motor(self, t: Table, r: float, half: float, n: int) -> None:
        """The can along z, and its head."""
        m, low = self.can * r, 0.9 * half
        high = half + self.deep * r
        t.add("motor", cylinder(m, low, high, n), of="handle")
        tops = {
            "cap": [cylinder(0.8 * m, high - 0.002, high + 0.25 * m, n)],
            "disc": [cylinder(1.25 * m, high - 0.002, high + 0.4 * m, n)],
            "box": [box((2.3 * m, 1.7 * m, 0.7 * m), (0, 0, high + 0.34 * m))],
            "square": [extrude(rounded_rectangle(2.1 * m, 2.1 * m, 0.3 * m, 2), high - 0.002, high + 0.5 * m)],
            "side box": [box((1.3 * m, 0.8 * m, 0.6 * (high - low)), (0, -1.2 * m, (low + high) / 2 + 0.1 * m))],
        }
        if self.head == "cap":
            t.add("motor", *tops["cap"], of="rubber")
        elif self.head != "none":
            t.add("terminal box", *tops[self.head], of="rubber", own=True)


class Doser(PlainPump, name="pump/plain dosing", sizes=(15,), weight=1.5):
    """A small dosing pump of plain shapes: a case with a face, a head in front or aside, valves, on a foot or shelf."""

    wide: float = between(0.08, 0.22, "width of the case", "m")
    tall: float = between(0.8, 1.7, "height of the case / its width")
    long: float = between(0.8, 1.8, "length of the case / its width")
    case: str = among(("box", "sloped", "drum", "rounded"), "form of the case")
    head: str = among(("round", "round", "square", "stepped"), "form of the head")
    size: float = between(0.28, 0.48, "radius of the head / width of the case")
    deep: float = between(0.25, 0.7, "depth of the head / width of the case")
    valve: float = between(0.18, 0.4, "radius of a valve / of the head")
    screws: int = among((0, 4, 6), "screws in the head")
    tubed: bool = chance(0.5, "tubes at the valves")
    stands: str = among(("floor", "plate", "shelf", "post"), "what it stands on")
    high: float = between(0.3, 1.1, "height of shelf or post", "m", when=lambda p: p.stands in ("shelf", "post"))
    knob: bool = chance(0.5, "a knob behind")
    paneled: bool = chance(0.6, "a panel on the case")

    def build(self, t: Table) -> Model:
        w = self.wide
        h, long = self.tall * w, self.long * w
        low = {"floor": 0.0, "plate": 0.02}.get(self.stands, self.high)
        up = t.at(0, 0, low)
        motor = up.bundled("motor")
        motor.add("motor", self._case(w, h, long, self.n(t, 0.5 * w)), of="pump")
        if self.paneled:
            motor.add("motor", box((0.5 * long, 0.01, 0.3 * h), (0, -0.5 * w, 0.7 * h)), of="rubber")
        if self.knob:
            knob = cylinder(0.2 * w, -0.02, 0.12 * w, 12)
            motor.at(-0.5 * long, 0, 0.45 * h).along("-x").add("motor", knob, of="rubber")
        self._head(up.at(0.5 * long, 0, 0.45 * h), w)
        if self.stands == "plate":
            t.add("pump base", box((1.2 * long, 1.2 * w, 0.02), (0, 0, 0.01)), own=False)
        elif self.stands == "shelf":
            t.add("bracket", box((1.3 * long, 1.3 * w, 0.006), (0, 0, low - 0.003)), own=False)
            t.add("bracket", box((0.006, 1.3 * w, 0.2), (-0.65 * long, 0, low - 0.1)), own=False)
        elif self.stands == "post":
            t.add("post", box((0.06, 0.06, low), (0, 0, low / 2)), box((0.25, 0.25, 0.01), (0, 0, 0.005)))
        return t.model(kind="dosing pump")

    def _case(self, w: float, h: float, long: float, n: int) -> Solid:
        if self.case == "box":
            return box((long, w, h), (0, 0, h / 2))
        if self.case == "rounded":
            return extrude(rounded_rectangle(long, w, 0.2 * w, 2), 0, h)
        if self.case == "drum":
            r = 0.5 * min(w, h)
            return along("x", cylinder(r, -long / 2, long / 2, n), 0, 0, r)
        side = np.array(outline(-long / 2, 0, long / 2, 0, long / 2, 0.75 * h, 0.1 * long, h, -long / 2, h))
        return along("-y", extrude(side, -w / 2, w / 2))

    def _head(self, t: Table, w: float) -> None:
        """The head before the origin along x, its valves below and above."""
        r, deep = self.size * w, self.deep * w
        n = self.n(t, r)
        body = {
            "round": [cylinder(r, -0.01, deep, n)],
            "square": [extrude(rounded_rectangle(1.8 * r, 1.8 * r, 0.1 * r, 1), -0.01, deep)],
            "stepped": [cylinder(r, -0.01, 0.5 * deep, n), cylinder(0.7 * r, 0.4 * deep, deep, n)],
        }[self.head]
        v, x = self.valve * r, 0.6 * deep
        low = 0.55 * r if self.head == "stepped" else 0.8 * r
        valves = [cylinder(v, *ends, max(6, n // 2)) for ends in ((low, 1.6 * r), (-1.5 * r, -low))]
        valves += [hexagon(2.4 * v, *ends) for ends in ((1.2 * r, 1.5 * r), (-1.4 * r, -1.1 * r))]
        screws = [around(hexagon(0.16 * r, deep - 0.005, deep + 0.08 * r), self.screws, 0.8 * r)] if self.screws else []
        if self.head == "stepped":
            screws = []
        solids = [along("x", one) for one in (*body, *screws)]
        t.add(CASING, *solids, *(moved(one, at(x)) for one in valves), of="trim")
        if self.tubed:
            for s in BOTH:
                t.add("hose", rod((x, 0, s * 1.45 * r), (x, 0, s * 2.1 * r), 0.5 * v, 6), own=True)


class AirPump(PlainPump, name="pump/plain diaphragm", sizes=(15, 20, 25, 40, 50), weight=1.2):
    """An air-operated double-diaphragm pump of plain shapes: two discs, a block, two manifolds, feet."""

    wide: float = between(2.2, 4.2, "(radius of a chamber - 30 mm) / of the pipe")
    apart: float = between(0.25, 0.7, "half the distance of the chambers / radius")
    deep: float = between(0.2, 0.6, "depth of a chamber / radius")
    coned: bool = chance(0.5, "the chambers taper")
    rim: float = among((0.0, 1.05, 1.12), "radius of a band round each / radius; 0: none")
    ways: int = among((-1, 1), "side to which the mouths look")
    suction: PlainPort = port_of(lambda p: p.dn, "suction", kind=Threaded)
    discharge: PlainPort = port_of(lambda p: p.dn, "discharge", kind=Threaded)
    square: bool = chance(0.4, "its manifolds are square")
    lift: float = between(0.02, 0.15, "height of the lower manifold", "m")
    feet: int = whole(0, 2, "its feet: none, two plates, four rods")

    def build(self, t: Table) -> Model:
        p = t.pipe.radius
        r = self.wide * p + 0.03
        n, gap, deep = self.n(t, r), self.apart * r, self.deep * r
        axis = self.lift + r + 2.6 * p
        level, far = t.at(0, 0, axis), r + 1.2 * p
        reach = gap + 0.5 * deep
        solids, ports = [], []
        for s, mouth in zip(BOTH, (self.suction, self.discharge), strict=True):
            face = self.ways * (1.6 * p + 0.04)
            size = (2 * reach + 2.2 * p, 2.2 * p, 2.2 * p)
            bar = box(size, (0, 0, axis + s * far)) if self.square else None
            solids.append(bar or along("x", cylinder(1.15 * p, -reach - p, reach + p, n), 0, 0, axis + s * far))
            solids += [_upright(x * reach, axis + s * 0.5 * r, axis + s * far, 1.1 * p, n) for x in BOTH]
            solid, port = mouth.build(t, (0, face, axis + s * far), (0, self.ways, 0), abs(face), n)
            solids.append(solid)
            ports.append(port)
        t.add(CASING, *solids, of="trim")
        chamber = outline(r, gap, r, gap + 0.4 * deep, (0.5 if self.coned else 1.0) * r, gap + deep)
        rim = [cylinder(self.rim * r, gap - 0.02 * r, gap + 0.1 * r, n)] if self.rim else []
        for way in ("x", "-x"):
            level.add(CASING, *(along(way, one) for one in (turned(chamber, n), *rim)))
        level.add(CASING, box((2 * gap + 0.01, 0.9 * r, 1.1 * r)), of="steel")
        self._feet(t, r, reach, axis)
        return t.model(ports=ports, kind="diaphragm pump")

    def _feet(self, t: Table, r: float, reach: float, axis: float) -> None:
        tall = axis - 0.6 * r
        if self.feet == 1:
            t.add("pump base", *(box((0.1 * r, 1.2 * r, tall), (s * reach, 0, tall / 2)) for s in BOTH), own=False)
        elif self.feet == 2:
            spots = [(x * reach, y * 0.5 * r) for x in BOTH for y in BOTH]
            t.add("pump base", *(rod((x, y, 0), (x, y, tall), 0.06 * r, 8) for x, y in spots), own=False)


def _upright(x: float, z0: float, z1: float, r: float, n: int) -> Solid:
    return rod((x, 0, z0), (x, 0, z1), r, n)


PLAIN_SMALL = families_of(Circulator, Doser, AirPump)
