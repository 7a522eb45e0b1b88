"""Gearboxes on a stem: worm and bevel, with wheels, chainwheels, cranks and squares."""

from __future__ import annotations

import numpy as np

from cadplants.builder.params import Params, among, between, chance, nested, weighted, whole
from cadplants.builder.table import Table, outline
from cadplants.families.valves.actuation_base import INDICATORS, put_indicator, put_stem
from cadplants.families.valves.actuation_hand import Handwheel, cylinder_at, scaled, slab
from cadplants.model.plant import Turning
from cadplants.solids.mesh_ops import Solid, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import along, around, box, cylinder, hexagon, ring, rod, rope, turned
from cadplants.solids.transforms import spun

__all__ = ["Bevel", "Worm"]


class _Input(Params):
    """What turns a gear's input shaft, which leaves along +z: a wheel, a chainwheel and chain, a square, a crank."""

    make: str = weighted("what it is", wheel=0.6, chainwheel=0.2, square=0.1, crank=0.1)
    wheel: Handwheel = nested(Handwheel, "handwheel", when=lambda p: p.make == "wheel")
    spokes: int = whole(3, 5, "of the chainwheel", when=lambda p: p.make == "chainwheel")
    drop: float = between(0.5, 1.2, "length of the hanging chain", "m", when=lambda p: p.make == "chainwheel")

    def build(self, t: Table, size: float, reach: float) -> None:
        """Puts it down, of a radius, on a shaft of a length [m]."""
        # A chain hangs clear of the body.
        reach += size if self.make == "chainwheel" else 0.0
        put_stem(t, -0.01, reach + 0.02, 0.08 * size + 0.003)
        if self.make == "wheel":
            self.wheel.build(t, size, reach, "gear operator")
        elif self.make == "chainwheel":
            t.add("handwheel", *self._chainwheel(t, size, reach), turns=Turning("gear operator"))
        elif self.make == "square":
            t.bundled("gearbox").add("valve stem", box((0.22 * size, 0.22 * size, 0.05), (0, 0, reach + 0.02)))
        else:
            arm = box((size, 0.12 * size, 0.06 * size), (0.45 * size, 0, 0.05 * size))
            grip = cylinder_at(0.07 * size, 0.02 * size, 0.6 * size, 0.88 * size)
            eye = cylinder(0.14 * size, 0.0, 0.16 * size, 12)
            t.at(0, 0, reach).add("lever", arm, eye, grip, turns=Turning("gear operator"))

    def _chainwheel(self, t: Table, size: float, reach: float) -> list[Solid]:
        """The chainwheel: its chain hangs down where the wheel stands upright."""
        z, drop, down = reach + 0.015, self.drop, t.frame[:3, :3].T @ (0.0, 0.0, -1.0)
        groove = ring(0.86 * size, 0.96 * size, reach, reach + 0.03, t.n(size, 16))
        teeth = around(box((0.12 * size, 0.012, 0.05), (0, 0, z)), 10, size)
        web = around(rod((0, 0, z), (0.9 * size, 0, z), 0.05 * size, 6), self.spokes)
        way = [(x, s * y * size, z) for s in (-1, 1) for x, y in outline(0, 1, -drop, 1, -drop - 0.08, 0.5)[::-s]]
        hanging = moved(rope(way, 0.004, 6), spun("z", float(np.arctan2(-down[1], -down[0]))))
        wheel = [groove, teeth, web, cylinder(0.15 * size, reach, reach + 0.04, 12)]
        return [*wheel, hanging] if abs(down[2]) < 0.5 else wheel


class Worm(Params):
    """A worm gearbox: a round, pear-shaped or square case with a stop boss, its shaft to the side."""

    kind = "worm gear"

    half: float = between(0.85, 1.2, "half its width / what the pipe asks for")
    tall: float = between(0.7, 1.1, "height of its case / half its width")
    case: str = among(("round", "pear-shaped", "square"), "form of its case")
    size: float = between(0.8, 1.1, "radius of what turns it / what the pipe asks for")
    reach: float = between(0.9, 1.6, "length of its input shaft / half its width")
    input: _Input = nested(_Input, "what turns it")
    indicated: bool = chance(0.75, "shows the position")
    indicator: str = among(INDICATORS, "what shows the position", when=lambda p: p.indicated)
    turn: float = among((0.0, np.pi), "which way it looks: its shaft lies across the run", "rad")

    def build(self, t: Table, radius: float) -> None:
        """Puts it down, for a pipe of a radius [m]."""
        half = self.half * (0.04 + 0.34 * radius)
        n, tall, t = t.n(half, 16), self.tall * half, t.spun("z", self.turn)
        if self.case == "round":
            case = [turned(outline(half, 0, half, 0.6 * tall, 0.85 * half, 0.8 * tall, 0.5 * half, tall), n)]
        elif self.case == "pear-shaped":
            turns = np.linspace(0.6 * np.pi, 1.75 * np.pi, 12)
            pear = np.vstack([np.column_stack([np.cos(turns), np.sin(turns)]), [(1.1, -0.7), (1.1, 0.6)]])
            case = [slab(half * pear, 0.0, 0.85 * tall), cylinder(0.6 * half, 0.85 * tall, tall, n)]
        else:
            case = [slab(rounded_rectangle(2.1 * half, 2.0 * half, 0.3 * half, 3), 0.0, 0.8 * tall)]
            case.append(turned(outline(0.8 * half, 0.8 * tall, 0.7 * half, tall), n))
        x, z, gear = 0.75 * half, 0.45 * tall, t.bundled("gearbox")
        tunnel = along("y", turned(scaled(half, 0.28, -1.1, 0.36, -0.8, 0.36, 0.8, 0.22, 1), 12), x, 0, z)
        gear.add("gearbox", *case, tunnel)
        gear.add("bolt", around(hexagon(0.012 + 0.05 * half, 0.6 * tall, tall), 4, 0.9 * half, 0.8))
        side = t.at(x, -1.05 * half, z).spun("x", np.pi / 2).spun("z", np.pi / 2)
        self.input.build(side, self.size * (0.05 + 0.8 * radius), self.reach * half)
        if self.indicated:
            put_indicator(t.at(0, 0, tall), 0.4 * half, self.indicator, "gearbox")


class Bevel(Params):
    """A bevel gearbox: a bell on the stem with a cone to the side, a stem cover pipe above."""

    kind = "bevel gear"

    covered: bool = chance(0.6, "a pipe covers the rising stem")
    cover: float = between(1, 4, "length of that pipe / half the case's width", when=lambda p: p.covered)
    input: _Input = nested(_Input, "what turns it")
    turn: float = among((0.0, np.pi), "which way it looks: its shaft lies across the run", "rad")

    def build(self, t: Table, radius: float) -> None:
        """Puts it down, for a pipe of a radius [m]."""
        half = 0.045 + 0.4 * radius
        n, t = t.n(half, 16), t.spun("z", self.turn)
        bell = scaled(half, 1.1, 0, 1.1, 0.15, 0.8, 0.3, 0.95, 0.9, 0.9, 1.3, 0.4, 1.5)
        cone = turned(scaled(half, 0.75, 0.3, 0.5, 1.2, 0.55, 1.3, 0.55, 1.5), n)
        t.bundled("gearbox").add("gearbox", turned(bell, n), along("-y", cone, 0, 0, 0.75 * half))
        if self.covered:
            cover = turned(scaled(half, 0.22, 1.45, 0.22, 1.5 + self.cover, 0.1, 5.8), 12)
            t.bundled("gearbox").add("gearbox", cover, of="trim")
        side = t.at(0, -1.5 * half, 0.75 * half).spun("x", np.pi / 2).spun("z", np.pi / 2)
        self.input.build(side, 0.06 + 0.9 * radius, 0.35 * half)
