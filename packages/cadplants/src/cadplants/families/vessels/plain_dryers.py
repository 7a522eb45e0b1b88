"""Dryers of compressed air of plain shapes: refrigerated ones in a cabinet, twin towers with a desiccant."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, whole
from cadplants.builder.table import Table
from cadplants.families.machines.plain_compressors import louvres
from cadplants.families.machines.plain_parts import Faceted, PlainPort, built_ports, port_of
from cadplants.model.family import Model, Port
from cadplants.solids.mesh_ops import Solid, extrude, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, box, cylinder, dome, ring, rod, turned
from cadplants.solids.transforms import at, spun

__all__ = ["PLAIN_DRYERS"]

_NAME = "separator"


class _Dryer(Faceted, place="floor", group="Equipment", label=_NAME, bundle=_NAME, sizes=(15, 20, 25, 32, 40, 50)):
    """A dryer of compressed air of plain shapes."""

    inlet: PlainPort = port_of(lambda p: p.dn, "inlet")
    outlet: PlainPort = port_of(lambda p: p.dn, "outlet")

    def mouths(
        self, t: Table, spots: tuple[tuple[float, float, float], ...], way: tuple[int, int, int], reach: float
    ) -> tuple[list[Solid], list[Port]]:
        """Inlet and outlet at two places; solids and ports."""
        n = self.n(t, t.pipe.radius)
        return built_ports(t, (self.inlet, self.outlet), spots, way, reach, n)


class _Refrigerated(_Dryer):
    """A refrigerated dryer: a small cabinet with a louvre, a fan, two mouths on top or behind."""

    wide: float = between(0.3, 0.9, "width", "m")
    deep: float = between(0.35, 0.9, "depth", "m")
    tall: float = between(0.4, 1.2, "height", "m")
    corner: float = among((0.0, 0.0, 0.02, 0.05), "radius of its corners", "m")
    feet: float = among((0.0, 0.03, 0.08), "height of its feet", "m")
    up: bool = chance(0.5, "its mouths look up, not back")
    rise: float = between(0.06, 0.2, "length of its mouths", "m")
    slats: int = among((0, 5, 8, 12), "strips of its louvre")
    fan: bool = chance(0.5, "a round grille at its side")
    dial: bool = chance(0.5, "a gauge in its panel")
    filters: int = whole(0, 2, "bowls beside it")

    def build(self, t: Table) -> Model:
        w, d, h, low = self.wide, self.deep, self.tall, self.feet
        x = max(0.22 * w, 0.55 * t.flange.outer)
        if self.up:
            spots, way = ((-x, 0.2 * d, low + h + self.rise), (x, 0.2 * d, low + h + self.rise)), (0, 0, 1)
        else:
            spots, way = ((-x, d / 2 + self.rise, low + 0.75 * h), (x, d / 2 + self.rise, low + 0.75 * h)), (0, 1, 0)
        mouths, ports = self.mouths(t, spots, way, self.rise + 0.02)
        t.add(_NAME, extrude(rounded_rectangle(w, d, self.corner, 3), low, low + h), *mouths, of="dial")
        if low:
            t.add(
                _NAME,
                *(box((0.06, 0.06, low), (a * 0.4 * w, b * 0.4 * d, low / 2)) for a in BOTH for b in BOTH),
                of="rubber",
            )
        front = t.at(0, -d / 2, low)
        if self.slats:
            front.at(0, 0.002, 0.3 * h).add(_NAME, *louvres(0.75 * w, 0.35 * h, self.slats), of="rubber")
        front.add("control panel", box((0.5 * w, 0.02, 0.15 * h), (0, -0.006, 0.8 * h)), own=True)
        if self.dial:
            case = along("-y", cylinder(0.03, 0.01, 0.035, self.n(t, 0.03)), 0.36 * w, 0, 0.8 * h)
            front.add("gauge", case, own=True)
        if self.fan:
            r = 0.32 * min(d, h)
            grille = [ring(f * r, (f + 0.1) * r, -0.002, 0.012, self.n(t, r)) for f in (0.3, 0.6, 0.9)]
            t.at(-w / 2, 0, low + 0.45 * h).along("-x").add(_NAME, *grille, of="rubber")
        for k in range(self.filters):
            self._bowl(t, (w / 2 + 0.07, (k - 0.5) * 0.16, low + 0.75 * h), w / 2)
        return t.model(kind="compressed-air dryer", ports=ports)

    def _bowl(self, t: Table, spot: tuple[float, float, float], side: float) -> None:
        x, y, z = spot
        r, n = 0.045, self.n(t, 0.045)
        bowl = [cylinder(r, -0.22, 0, n), cylinder(1.15 * r, -0.002, 0.06, n)]
        arm = rod((side - 0.01, y, z + 0.03), (x, y, z + 0.03), 0.018, max(6, n // 2))
        t.add("filter", *(moved(one, at(x, y, z)) for one in bowl), arm, own=True)


class Refrigerated(_Refrigerated, name="separator/refrigerated dryer", weight=0.9):
    """A refrigerated dryer of plain shapes, as finely as the style has equipment."""


class RefrigeratedInPieces(_Refrigerated, name="separator/dryer cabinet in pieces", weight=0.8, grain="fitting"):
    """A refrigerated dryer of plain shapes, each a piece of its own."""


class _TwinTowers(_Dryer):
    """Two slim vessels side by side with pipework above and below, valves, silencers, a box, on a frame or feet."""

    radius: float = between(0.06, 0.3, "of a tower", "m")
    slender: float = between(3.5, 9.0, "height of a tower / its radius")
    apart: float = between(2.3, 4.0, "distance of the towers / radius")
    ends: str = among(("dish", "dish", "flat", "cone", "profile"), "their ends")
    stands: str = among(("legs", "skirt", "frame", "slab"), "what they stand on")
    low: float = between(1.0, 1.8, "from the floor to a tower's shell / radius")
    pipe: float = between(0.12, 0.3, "radius of the pipework / of a tower")
    valves: bool = chance(0.7, "blocks of valves in the lower pipework")
    silencers: bool = chance(0.6, "silencers at the lower pipework")
    box_: bool = chance(0.7, "a control box between them")
    bands: int = whole(0, 2, "bands round a tower")

    def build(self, t: Table) -> Model:
        r, n = self.radius, self.n(t, self.radius)
        low, high = self.low * r + 0.08, self.low * r + 0.08 + self.slender * r
        x, p = self.apart * r / 2, max(self.pipe * r, 0.9 * t.pipe.radius)
        below, above = low - 0.45 * r - 2 * p - 0.01, high + 0.45 * r + p + 0.03
        below = max(below, 1.3 * p + 0.02)
        lanes = [self._lane(x, z, p, end) for z, end in ((below, low), (above, high))]
        reach = 0.8 * r + 0.08
        spots = ((0.0, -reach, below), (0.0, -reach, above))
        mouths, ports = self.mouths(t, spots, (0, -1, 0), reach)
        t.add(_NAME, *lanes[0], mouths[0], of="pipe")
        t.add(_NAME, *lanes[1], mouths[1], of="pipe")
        for s in BOTH:
            t.at(s * x).add(_NAME, *self._tower(r, low, high, n), of="tank")
        self._stand(t, x, r, low)
        if self.valves:
            t.add_each("valve", [box((2.6 * p, 2.8 * p, 2.8 * p), (s * 0.55 * x, 0, below)) for s in BOTH], own=True)
        if self.silencers:
            can = cylinder(1.5 * p, 0, 5 * p, n)
            t.add(_NAME, *(along("y", can, s * 0.55 * x, 0.5 * p, below) for s in BOTH), of="trim")
        if self.box_:
            size = (min(0.35, 1.4 * x), 0.12, 0.3)
            t.add("control panel", box(size, (0, -r - 0.05, (low + high) / 2)), own=True)
            t.add(_NAME, box((2 * x, 0.02, 0.05), (0, -r + 0.0, (low + high) / 2)), of="steel")
        first, second = ports
        return t.model(kind="compressed-air dryer", ports=(first, Port(second.frame, second.dn, 1)))

    def _lane(self, x: float, z: float, p: float, end: float) -> list[Solid]:
        """Pipework across at a height, with its way to the end of each tower."""
        run = [rod((-x, 0, z), (x, 0, z), p, 10)]
        return [*run, *(rod((s * x, 0, z), (s * x, 0, end), p, 10) for s in BOTH)]

    def _tower(self, r: float, low: float, high: float, n: int) -> list[Solid]:
        bands = [cylinder(1.06 * r, z - 0.02, z + 0.02, n) for z in np.linspace(low, high, self.bands + 2)[1:-1]]
        if self.ends == "flat":
            rims = [cylinder(1.12 * r, z, z + 0.12 * r, n) for z in (low, high - 0.12 * r)]
            return [cylinder(r, low, high, n), *rims, *bands]
        if self.ends == "profile":
            sheet = rounded_rectangle(2 * r, 1.7 * r, 0.3 * r, 2)
            lids = [extrude(1.04 * sheet, z, z + 0.2 * r) for z in (low, high - 0.2 * r)]
            return [extrude(sheet, low, high), *lids]
        if self.ends == "cone":
            shape = [(0.3 * r, low - 0.45 * r), (r, low), (r, high), (0.3 * r, high + 0.45 * r)]
            return [turned(shape, n), *bands]
        cap = dome(r, 0.45 * r, -0.001, n)
        return [
            cylinder(r, low, high, n),
            moved(cap, at(0, 0, high)),
            moved(cap, at(0, 0, low) @ spun("x", np.pi)),
            *bands,
        ]

    def _stand(self, t: Table, x: float, r: float, low: float) -> None:
        tall = low + 0.3 * r
        if self.stands == "skirt":
            n = self.n(t, r)
            t.add("skirt", *(moved(ring(0.94 * r, r, 0, low + 0.01, n), at(s * x)) for s in BOTH), own=True)
        elif self.stands == "legs":
            legs = [
                box((0.04, 0.04, tall), (s * x + a * 0.7 * r, b * 0.7 * r, tall / 2))
                for s in BOTH
                for a in BOTH
                for b in BOTH
            ]
            t.add("tank leg", *legs, own=True)
        elif self.stands == "frame":
            wide, deep = 2 * x + 2.4 * r, 2.4 * r
            rails = [box((wide, 0.06, 0.08), (0, s * deep / 2, 0.04)) for s in BOTH]
            rails += [box((0.06, deep, 0.08), (s * wide / 2, 0, 0.04)) for s in BOTH]
            posts = [box((0.05, 0.05, tall), (s * x, b * 0.98 * r, tall / 2)) for s in BOTH for b in BOTH]
            t.add(
                "skid frame", *rails, *(box((2 * x + 0.06, 0.06, 0.05), (0, s * 0.98 * r, 0.025)) for s in BOTH), *posts
            )
        else:
            t.add("base plate", box((2 * x + 2.6 * r, 2.6 * r, 0.02), (0, 0, 0.01)))
            t.add(_NAME, *(box((0.3 * r, 1.2 * r, tall), (s * x, 0.1 * r, tall / 2)) for s in BOTH), of="steel")


class TwinTowers(_TwinTowers, name="separator/twin towers", weight=0.9):
    """A desiccant dryer of plain shapes, as finely as the style has equipment."""


class TowersInPieces(_TwinTowers, name="separator/twin towers in pieces", weight=0.8, grain="fitting"):
    """A desiccant dryer of plain shapes, each a piece of its own."""


PLAIN_DRYERS = families_of(Refrigerated, RefrigeratedInPieces, TwinTowers, TowersInPieces)
