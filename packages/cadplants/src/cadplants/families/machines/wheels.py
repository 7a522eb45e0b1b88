"""Impellers on their own and in a pump that is cut open."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import Device, families_of
from cadplants.builder.draws import of_form, one_of
from cadplants.builder.params import Params, among, between, chance, given, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.machines.drives import (
    CASING,
    PUMP,
    base,
    slab,
)
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, ring, turned
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["WHEELS"]

_FORMS = ("open", "closed", "double", "propeller", "vortex", "peripheral")


class Wheel(Params):
    """An impeller."""

    form: str = given("open", "how it is made")
    vanes: int = whole(3, 8, "vanes", when=of_form("open", "closed", "double", "vortex"))
    wide: float = between(0.18, 0.4, "width of the vanes / radius", when=of_form("open", "closed", "double", "vortex"))
    wrap: float = between(0.8, 1.9, "how far a vane goes round", "rad", when=of_form("open", "closed", "double"))
    blades: int = whole(3, 5, "blades", when=of_form("propeller"))

    def solid(self, r: float, style: ModelingStyle) -> tuple[Solid, float]:
        """The wheel about z, its hub from 0 up; and its height [m]."""
        n, wide = style.round(r), self.wide * r
        if self.form == "propeller":
            blade = moved(box((0.75 * r, 0.5 * r, 0.05 * r), (0.6 * r, 0, 0)), at(0, 0, 0.25 * r) @ spun("x", 0.5))
            keys = around(box((0.02 * r, 0.1 * r, 0.5 * r), (0.3 * r, 0, 0.25 * r)), 3)
            return merge([around(blade, self.blades), ring(0.12 * r, 0.3 * r, 0.0, 0.5 * r, n), keys]), 0.5 * r
        if self.form == "peripheral":
            teeth = around(box((0.12 * r, 0.03 * r, 0.16 * r), (0.94 * r, 0, 0.08 * r)), 28)
            disc, hub = ring(0.12 * r, 0.9 * r, 0.04 * r, 0.12 * r, n), ring(0.12 * r, 0.25 * r, 0.0, 0.16 * r, n)
            return merge([disc, teeth, hub]), 0.16 * r
        back, hub = ring(0.12 * r, r, 0.0, 0.05 * r, n), ring(0.12 * r, 0.26 * r, 0.0, wide + 0.15 * r, n)
        if self.form == "vortex":
            flat = box((0.7 * r, 0.07 * r, wide), (0.6 * r, 0, wide / 2 + 0.02 * r))
            return merge([back, around(flat, self.vanes + 2), hub]), wide + 0.15 * r
        vanes, front = self._vanes(r), ring(0.48 * r, r, wide - 0.01 * r, wide + 0.05 * r, n)
        if self.form == "closed":
            lip = ring(0.46 * r, 0.56 * r, wide, wide + 0.28 * r, n)
            return merge([back, vanes, front, lip, hub]), wide + 0.28 * r
        if self.form == "double":
            half = merge([vanes, front, ring(0.46 * r, 0.54 * r, wide, wide + 0.2 * r, n)])
            middle = [ring(0.12 * r, r, -0.03 * r, 0.03 * r, n), ring(0.12 * r, 0.24 * r, -wide, wide, n)]
            whole_ = merge([half, moved(half, spun("x", np.pi)), *middle])
            return moved(whole_, at(0, 0, wide + 0.2 * r)), 2 * wide + 0.4 * r
        return merge([back, vanes, hub]), wide + 0.15 * r

    def _vanes(self, r: float) -> Solid:
        """Curved vanes between hub and rim."""
        a = np.linspace(0, 1, 9)
        way = (0.34 + 0.65 * a) * r
        line = np.column_stack([way * np.cos(self.wrap * a), way * np.sin(self.wrap * a)])
        turn = np.array([[np.cos(0.07), np.sin(0.07)], [-np.sin(0.07), np.cos(0.07)]])
        return around(extrude(np.vstack([line, (line @ turn)[::-1]]), 0.03 * r, self.wide * r), self.vanes)


class LaidWheel(Params):
    """An impeller that lies on a table or sits on an arbor there."""

    form: str = given("open", "how the wheel is made")
    radius: float = between(0.06, 0.22, "of the wheel", "m")
    wheel: Wheel = nested(Wheel, "the wheel", fixed=lambda p: {"form": p.form})
    lying: bool = chance(0.5, "it lies")

    def build(self, t: Table, level: float) -> None:
        """Puts it down on a height [m]."""
        r = self.radius
        wheel, tall = self.wheel.solid(r, t.style)
        if self.lying:
            t.at(0, 0, level).add("impeller", wheel)
            return
        rise = level + 1.25 * r
        t.at(0, -tall / 2, rise).add("impeller", along("y", wheel))
        arbor = outline(0.118 * r, -0.9 * r - tall, 0.118 * r, 0.7 * tall, 0.08 * r, 0.72 * tall, 0.08 * r, 1.2 * tall)
        t.at(0, 0, rise).along("y").add("shaft", turned(arbor, 16))
        top = rise + 0.1 * r
        t.add("bracket", box((0.6 * r, 0.12 * r, top - level), (0, -tall - 0.7 * r, (top + level) / 2)))


class Bench(Device, name="impeller/bench", group=PUMP, label="impeller", sizes=(15,), grain="fitting", weight=1.5):
    """Impellers on arbors of a rack or lying on a table: open, closed, double, vortex, peripheral, propeller."""

    level: float = between(0.6, 1.0, "height of the table", "m")
    count: int = whole(1, 3, "wheels")
    forms: tuple[str, ...] = several(one_of(*_FORMS), lambda p: p.count, "how each wheel is made")
    first: LaidWheel = nested(LaidWheel, "first wheel", fixed=lambda p: {"form": p.forms[0]})
    second: LaidWheel = nested(
        LaidWheel, "second wheel", fixed=lambda p: {"form": p.forms[1]}, when=lambda p: p.count > 1
    )
    third: LaidWheel = nested(
        LaidWheel, "third wheel", fixed=lambda p: {"form": p.forms[2]}, when=lambda p: p.count > 2
    )

    def build(self, t: Table) -> Model:
        x, level = 0.0, self.level
        for laid in (self.first, self.second, self.third)[: self.count]:
            step = laid.radius + 0.05
            laid.build(t.at(x + step), level)
            x += 2 * step
        t.add("plate", box((x + 0.1, 0.7, 0.03), (x / 2, -0.05, level - 0.015)))
        tall = level - 0.03
        for place in (0.0, x):
            for y in (-0.33, 0.23):
                t.add("post", box((0.05, 0.05, tall), (place, y, tall / 2)))
        return t.model(kind="impeller")


class Cutaway(Device, name="pump/cutaway", group=PUMP, label="pump", bundle=CASING, sizes=(15,)):
    """A cutaway pump for teaching: half of a casing round an open impeller on its shaft, bearing bracket, stand."""

    radius: float = between(0.1, 0.2, "of the casing", "m")
    seat: float = among((0.03, 0.08, 0.7), "height of what it stands on", "m")
    form: str = among(("open", "closed", "vortex"), "how the wheel is made")
    wheel: Wheel = nested(Wheel, "the wheel", fixed=lambda p: {"form": p.form})
    bed: str = among(
        ("grid", "beams", "sheet", "rim"), "form of the base frame", when=lambda p: p.seat > 0.05, otherwise="rim"
    )

    def build(self, t: Table) -> Model:
        r, seat = self.radius, self.seat
        n, axis = t.n(r), seat + 1.9 * r
        lying = t.at(0, 0, axis)
        wheel, tall = self.wheel.solid(0.85 * r, t.style)
        half, thick = tall / 2 + 0.06 * r, 0.08 * r
        back = half + thick
        a = np.linspace(np.pi, 2 * np.pi, max(9, n // 2))
        unit = np.column_stack([np.cos(a), np.sin(a)])

        def sheet(inner: float, low: float, high: float) -> Solid:
            return moved(slab(np.vstack([1.3 * r * unit, inner * r * unit[::-1]]), low, high), at(0, 0, axis))

        foot = axis - seat - 1.1 * r
        shell = sheet(1.05, -half, half), sheet(0.3, half, back), sheet(0.5, -back, -half)
        t.add(CASING, *shell, box((0.6 * r, 1.2 * r, foot), (0, 0, seat + foot / 2)))
        shape = outline(0.32 * r, back - thick, 0.32 * r, back + 0.3 * r, 0.45 * r, back + 0.35 * r)
        bracket = turned([*shape, (0.45 * r, back + 1.6 * r), (0.2 * r, back + 1.65 * r)], n)
        stay = axis - seat - 0.35 * r
        stay_ = box((0.2 * r, 0.6 * r, stay), (back + 1.3 * r, 0, seat + stay / 2))
        t.add(CASING, along("x", bracket, 0, 0, axis), stay_)
        lying.along("-x").at(0, 0, -tall / 2).add("impeller", wheel, own=False)
        lying.along("x").add("shaft", cylinder(0.1 * r, -half, back + 2.3 * r, 14), own=False)
        high = seat > 0.5
        lifted = t.at(0, 0, seat - 0.1) if high else t
        base(lifted, self.bed, -r, back + 2.2 * r, 2.2 * r, min(seat, 0.1), [0.0, back + 1.3 * r])
        if high:
            t.add("plate", box((back + 3.4 * r, 2.3 * r, 0.04), ((back + 1.2 * r) / 2, 0, seat - 0.12)))
            for x in (-r, back + 2.1 * r):
                for y in BOTH:
                    t.add("post", box((0.05, 0.05, seat - 0.14), (x, y * r, (seat - 0.14) / 2)))
        return t.model(kind="centrifugal pump")


WHEELS = families_of(Cutaway, Bench)
