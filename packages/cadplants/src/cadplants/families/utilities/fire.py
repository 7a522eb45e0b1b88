"""Fire extinguishers on walls, stands and carts, in cabinets."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, whole
from cadplants.builder.table import Table, outline
from cadplants.families.utilities.mounting import Utility, h_column, wall
from cadplants.model.family import Family, Model
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, hexagon, ring, rod, rope, torus, turned
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["FIRE"]

_E = "fire extinguisher"


class _Extinguisher(Utility, bundle=_E, grain="structure"):
    """A fire extinguisher."""


def _bottle(r: float, h: float, style: ModelingStyle) -> Solid:
    """A pressure bottle about z from 0: round foot, shoulder, neck up to ``h + 0.9 r``."""
    shoulder = [(r * np.cos(a), h + 0.75 * r * np.sin(a)) for a in (0.4, 0.8, 1.2)]
    neck = outline(0.3 * r, h + 0.75 * r, 0.3 * r, h + 0.9 * r)
    return turned([*outline(0.85 * r, 0.0, r, 0.12 * r, r, h), *shoulder, *neck], style.round(r))


def _at(*places: str) -> Any:
    return lambda p: p.kept in places


class Kept(_Extinguisher, name="fire extinguisher/kept", weight=1.5):
    """Hand extinguishers (EN 3): on a wall bracket, on a stand with a sign, in a cabinet, on the floor."""

    form: str = among(("horn", "cartridge", "gauge"), "what it has: a horn (CO2), a cartridge at its side or a gauge")
    kept: str = among(("wall", "stand", "cabinet", "floor"), "where it is kept")
    radius: float = between(0.055, 0.09, "of the bottle", "m")
    tall: float = between(3.8, 6.5, "height of the bottle to its shoulder / radius")
    count: int = whole(1, 2, "extinguishers on the floor", when=_at("floor"))
    level: float = between(
        lambda p: 0.4 if p.kept == "wall" else 0.5, 0.9, "height over the floor", "m", when=_at("wall", "cabinet")
    )
    walled: bool = chance(0.6, "its bracket is on a wall, not on a column", when=_at("wall"))
    glazed: bool = chance(0.5, "its cabinet has a pane", when=_at("cabinet"))

    def build(self, t: Table) -> Model:
        r, z = self.radius, self.level
        h = self.tall * r
        full = h + 2.0 * r
        for k in range(self.count):
            self._unit(t.at(4.5 * r * k))
        if self.kept == "wall":
            here = t.at(0, 0, z)
            self._unit(here.at(0, -r - 0.02))
            strap = moved(ring(r, r + 0.003, 0, 0.02, t.n(r)), at(0, -r - 0.02, 0.6 * h))
            here.add("clamp", strap, box((0.06, 0.022, 0.2), (0, -0.011, 0.6 * h)))
            shelf = box((1.2 * r, 2 * r, 0.006), (0, -r - 0.015, -0.003))
            here.add("bracket", shelf, box((1.2 * r, 0.006, 0.1), (0, -0.003, -0.03)), of="clamp")
            here.add("sign", box((0.2, 0.003, 0.2), (0, -0.0015, full + 0.35)), own=False)
            high = z + full + 0.7
            t.extend([wall(-0.5, 0.5, high) if self.walled else h_column(high, 0.24)])
        elif self.kept == "stand":
            self._unit(t.at(0, 0, 0.012))
            t.add("post", box((0.05, 0.02, full + 0.7), (0, r + 0.035, (full + 0.7) / 2 + 0.01)), of="clamp")
            foot = [cylinder(0.18, 0, 0.012, t.n(0.18)), box((0.08, r + 0.06, 0.012), (0, (r + 0.06) / 2, 0.006))]
            t.add("base plate", *foot, of="clamp")
            t.add("bracket", box((0.04, 0.03, 0.02), (0, r + 0.012, 0.7 * h)), of="clamp")
            front = t.at(0, r + 0.025, full + 0.55).spun("x", np.pi / 2)
            front.add("sign", extrude(rounded_rectangle(0.3, 0.3, 0.02, 2), 0, 0.003), own=False)
        elif self.kept == "cabinet":
            self._cabinet(t.at(0, 0, z), full + 0.1)
            t.extend([wall(-0.6, 0.6, z + full + 0.5)])
        return t.model()

    def _cabinet(self, t: Table, tall: float) -> None:
        """The extinguisher in its cabinet of this height [m]."""
        r, mid = self.radius, tall / 2
        horn = self.form == "horn"
        w, d = max(0.3, (5.0 if horn else 4.2) * r), 2 * r + 0.1
        self._unit(t.at(0.7 * r if horn else 0.0, -d / 2, 0.01))
        case = [box((0.01, d, tall), (q * (w / 2 - 0.005), -d / 2, mid)) for q in BOTH]
        case += [box((w, d, 0.01), (0, -d / 2, q)) for q in (0.005, tall - 0.005)]
        case += [box((w, 0.01, tall), (0, -0.005, mid))]
        case += [box((0.04, 0.02, tall), (q * (w / 2 - 0.02), -d - 0.01, mid)) for q in BOTH]
        case += [box((w, 0.02, 0.04), (0, -d - 0.01, q)) for q in (0.02, tall - 0.02)]
        t.add(_E, *case, box((0.02, 0.03, 0.1), (0.42 * w, -d - 0.035, mid)))
        if self.glazed:
            t.add(_E, box((w - 0.07, 0.006, tall - 0.07), (0, -d - 0.006, mid)), of="dial")

    def _unit(self, t: Table) -> None:
        """One extinguisher about z from 0."""
        r, style = self.radius, t.style
        h = self.tall * r
        top = h + 0.88 * r
        t.add(_E, _bottle(r, h, style))
        up = t.at(0, 0, top)
        up.add(
            _E,
            cylinder(0.3 * r, 0, 0.3 * r, 12),
            hexagon(0.6 * r, 0.1 * r, 0.4 * r),
            cylinder(0.22 * r, 0.3 * r, 0.85 * r, 10),
            box((1.6 * r, 0.28 * r, 0.08 * r), (0.5 * r, 0, 0.55 * r)),
            moved(box((1.6 * r, 0.25 * r, 0.08 * r)), at(0.65 * r, 0, 0.85 * r) @ spun("y", -0.2)),
            of="trim",
        )
        if self.form == "horn":
            arm = rope([(-0.2 * r, 0, 0.3 * r), (-r, 0, 0.35 * r), (-1.5 * r, 0, -0.4 * r)], 0.12 * r, 8)
            bell = outline(0.75 * r, -3.2 * r, 0.3 * r, -0.6 * r, 0.3 * r, 0.0, 0.15 * r, 0.02 * r)
            lean = at(-1.75 * r) @ spun("y", 0.12) @ at(0, 0, -0.3 * r)
            up.add(_E, arm, moved(turned(bell, t.n(r)), lean), of="rubber")
            return
        if self.form == "cartridge":
            side = moved(_bottle(0.3 * r, 0.45 * h, style), at(1.28 * r, 0, 0.3 * h))
            bands = [box((0.5 * r, 0.3 * r, 0.06 * r), (1.05 * r, 0, q * h)) for q in (0.35, 0.65)]
            t.add(_E, side, *bands, of="trim")
        else:
            up.at(0, 0, 0.3 * r).along("-y").add(_E, cylinder(0.25 * r, 0.2 * r, 0.4 * r, 12), of="gauge")
        hose = outline(-0.2 * r, top + 0.3 * r, -1.1 * r, top + 0.2 * r, -1.4 * r, 0.75 * h, -1.25 * r, 0.3 * h)
        tip = rod((-1.25 * r, 0, 0.32 * h), (-1.22 * r, 0, 0.12 * h), 0.2 * r, 8)
        clip = box((0.6 * r, 0.3 * r, 0.08 * r), (-1.1 * r, 0, 0.28 * h))
        t.add(_E, rope([(x, 0, z) for x, z in hose], 0.13 * r, 8), tip, clip, of="rubber")


class Wheeled(_Extinguisher, name="fire extinguisher/wheeled"):
    """A wheeled extinguisher (EN 1866): one big bottle or two slim ones on a cart, a coiled hose."""

    radius: float = between(0.11, 0.17, "of a single bottle; of two it is 0.75 of that", "m")
    two: bool = chance(0.35, "it has two bottles")
    tall: float = between(4.0, 6.0, "height of a bottle to its shoulder / radius")
    wheel: float = between(0.12, 0.2, "radius of the wheels", "m")
    coils: int = whole(2, 4, "turns of the hose")

    def build(self, t: Table) -> Model:
        r, low, wheel = self.radius * (0.75 if self.two else 1.0), 0.06, self.wheel
        h = self.tall * r
        spots, top = ((-1.15 * r, 1.15 * r) if self.two else (0.0,)), low + h + 0.88 * r
        t.add(_E, *(moved(_bottle(r, h, t.style), at(0, y, low)) for y in spots))
        ring_ = moved(torus(0.35 * r, 0.05 * r, 14, 6), at(0, 0, 0.45 * r))
        spoke = box((0.7 * r, 0.08 * r, 0.06 * r), (0, 0, 0.45 * r))
        valve = merge([cylinder(0.25 * r, 0, 0.46 * r, 10), hexagon(0.5 * r, 0.1 * r, 0.3 * r), ring_, spoke])
        t.add(_E, *(moved(valve, at(0, y, top)) for y in spots), of="trim")
        wide, x, hung = (2.3 if self.two else 1.3) * r + 0.06, -r - 0.06, low + 0.62 * h
        self._cart(t, r, wide, x, (low, h, top, hung))
        spokes = around(box((0.62 * wheel, 0.02, 0.012), (0.48 * wheel, 0, 0)), 5)
        one = merge([ring(0.75 * wheel, wheel, -0.02, 0.02, 20), cylinder(0.2 * wheel, -0.025, 0.025, 12), spokes])
        t.add("caster", *(along("y", one, x, q * (wide + 0.03), wheel) for q in BOTH))
        turn = moved(torus(0.75 * r + 0.03, 0.014, 20, 6), spun("y", np.pi / 2))
        coils = [moved(turn, at(r + 0.014 + 0.026 * k, 0, hung)) for k in range(self.coils)]
        lead = [(0.2 * r, spots[-1], top + 0.2 * r), (r, 0, top), (r + 0.02, 0.5 * r, hung + 0.6 * r)]
        t.add("hose", *coils, rope(lead, 0.014, 8))
        return t.model()

    def _cart(self, t: Table, r: float, wide: float, x: float, heights: tuple[float, float, float, float]) -> None:
        """The cart, its axle at ``x``; heights of tray, bottle, valve and hose [m]."""
        low, h, top, hung = heights
        y, back, high = 0.8 * wide, x - 0.15, top + 0.12
        bend = outline(0.0, low - 0.02, x, low - 0.02, x, 0.9 * top, back, high)
        rails = [rope([(a, q * y, b) for a, b in bend], 0.014, 8) for q in BOTH]
        bars = [box((0.07, 1.7 * wide, 0.03), (x + 0.03, 0, low + q * h)) for q in (0.25, 0.75)]
        foot = (0.04, 0.04, low - 0.015)
        t.add(
            _E,
            rod((x, -wide - 0.06, self.wheel), (x, wide + 0.06, self.wheel), 0.012, 8),
            *rails,
            rod((back, -y, high), (back, y, high), 0.014, 8),
            *bars,
            box((2 * r, 1.6 * wide, 0.02), (0, 0, low - 0.01)),
            *(box(foot, (0.7 * r, q * 0.6 * wide, foot[2] / 2)) for q in BOTH),
            rod((0.8 * r, 0, hung + 0.76 * r), (r + 0.1, 0, hung + 0.76 * r), 0.016, 8),
            *([rod((r, -1.15 * r, hung + 0.76 * r), (r, 1.15 * r, hung + 0.76 * r), 0.012, 8)] if self.two else []),
            of="rubber",
        )


FIRE: tuple[Family, ...] = families_of(Kept, Wheeled)
