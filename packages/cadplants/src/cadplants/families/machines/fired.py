"""Burners with what they stand on."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import Device, families_of
from cadplants.builder.params import Params, among, between, chance, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.machines.drives import (
    Driven,
    Motor,
    corners,
    driven,
)
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import extrude, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, hexagon, rod, rope, turned
from cadplants.solids.transforms import at, spun

__all__ = ["FIRED"]

_NAME = "burner"


class Monobloc(Driven, name="burner/monobloc", group="Equipment", label=_NAME, bundle=_NAME, sizes=(15,), weight=1.5):
    """A monobloc gas burner (EN 676) on a boiler front: oval fan housing with hinge, air inlet, motor, train, panel."""

    radius: float = between(0.09, 0.25, "half the width of the housing, nearly", "m")
    height: float = between(0.6, 1.1, "of the burner's underside", "m")
    corner: float = between(0.3, 0.85, "radius of the housing's corners / its size")
    reach: float = between(1.5, 2.0, "how far the hood comes out / size")
    left: bool = chance(0.5, "the motor is on its left side")
    frame: str = among(("cast", "smooth", "square"), "how the motor's frame is made")
    motor: Motor = driven(Motor, "motor")

    def build(self, t: Table) -> Model:
        r, side = self.radius, -1 if self.left else 1
        z, n, x = self.height + 1.5 * r, t.n(r), 0.8 * r
        level, m = t.at(0, 0, z), 0.5 * r
        plate = along("x", extrude(rounded_rectangle(1.9 * r, 1.9 * r, 0.3 * r, 3), -0.02, 0.02))
        sheet = rounded_rectangle(2.3 * r, 1.8 * r, self.corner * r, 4)
        house = along("x", extrude(sheet, 0.25 * r, 1.3 * r), 0, 0, -0.15 * r)
        pegs = [along("x", cylinder(0.06 * r, 0.0, 0.4 * r, 8), 0, s * 0.75 * r, 0.75 * r) for s in BOTH]
        level.add(_NAME, plate, along("x", cylinder(0.62 * r, -0.1, 0.3 * r, n)), house, *pegs)
        hood = extrude(0.85 * sheet, 1.3 * r, self.reach * r)
        level.at(0, 0, -0.15 * r).along("x").add(_NAME, hood, of="rubber")
        slats = [box((0.84 * r, 1.14 * r, 0.03 * r), (x, 0, q * r)) for q in (-1.85, -1.7, -1.55)]
        level.add(_NAME, box((0.8 * r, 1.1 * r, 0.8 * r), (x, 0, -1.5 * r)), *slats)
        pose = at(x, side * 0.89 * r, -0.15 * r) @ spun("x", -side * np.pi / 2) @ spun("z", -side * np.pi / 2)
        self.motor.build(level.moved(pose), m, 2.3 * m)
        self._train(level.at(x, 0, -0.2 * r), -side, 0.02 + 0.06 * r)
        panel = box((0.9 * r, 0.12 * r, 0.7 * r), (x, -side * 0.96 * r, 0.55 * r))
        level.add("control panel", panel, own=True)
        t.add("wall", box((0.12, 5 * r + 0.2, z + 3 * r), (-0.06 - 0.02, 0, (z + 3 * r) / 2)))
        eye = rope([(0.0, 0, 0), (0.0, 0, 0.05)], 0.02, 8)
        level.at(0.02, 0.7 * r, -0.7 * r).along("x").add(_NAME, eye, of="dial")
        return t.model(kind="monobloc burner")

    def _train(self, t: Table, side: int, thick: float) -> None:
        """The gas train to a side: a pipe with two valves under their coils."""
        near, far, w = side * 0.85 * self.radius, side * (2.4 * self.radius + 0.5), 3.2 * thick
        t.add("pipe", rod((0, near, 0), (0, far, 0), thick, 12), own=True)
        ys = [(near + far) / 2 + q * w for q in (-0.9, 0.9)]
        coils = [box((0.7 * w, 0.7 * w, 0.9 * w), (0, y, 0.95 * w)) for y in ys]
        t.add("valve", *(box((w, 1.3 * w, w), (0, y, 0)) for y in ys), *coils, own=True)


class InDuct(Params):
    """Runners with mixing wings across a flanged rectangular duct."""

    kind = "duct burner"
    width: float = between(0.6, 1.2, "of the duct", "m")
    height: float = between(0.5, 1.0, "of the duct", "m")
    low: float = between(0.5, 1.0, "height of the duct's underside", "m")

    def build(self, t: Table) -> None:
        """Puts it down."""
        w, h, z, thick, long = self.width, self.height, self.low, 0.004, 0.5
        mid, rows = z + h / 2, (0.25, 0.5, 0.75)
        sheets = [box((long, thick, h), (0, s * w / 2, mid)) for s in BOTH]
        sheets += [box((long, w + thick, thick), (0, 0, mid + s * h / 2)) for s in BOTH]
        for x in (-long / 2, long / 2):
            sheets += [box((0.03, 0.05, h + 0.1), (x, s * (w / 2 + 0.02), mid)) for s in BOTH]
            sheets += [box((0.03, w + 0.09, 0.05), (x, 0, mid + s * (h / 2 + 0.02))) for s in BOTH]
        t.add(_NAME, *sheets, of="clamp")
        runners = [box((0.08, w - 0.006, 0.06), (0, 0, z + q * h)) for q in rows]
        wing = box((0.18, w - 0.02, 0.003))
        poses = [at(0.1, 0, z + q * h + s * 0.07) @ spun("y", -0.5 * s) for q in rows for s in BOTH]
        t.add(_NAME, *runners, *(moved(wing, pose) for pose in poses), of="trim")
        y = -w / 2 - 0.12
        feeds = [rod((0, y, z + q * h), (0, -w / 2 + 0.01, z + q * h), 0.018, 10) for q in rows]
        t.add("pipe", rod((0, y, z + 0.1 * h), (0, y, z + 0.95 * h), 0.03, 12), *feeds, own=True)
        pilot = [cylinder(0.03, 0, 0.15, 12), cylinder(0.045, 0.15, 0.24, 12)]
        t.at(0.12, -w / 2, z + 0.6 * h).along("-y").add(_NAME, *pilot)
        t.add("bracket", *(box((0.05, 0.05, z), (x, y, z / 2)) for x, y in corners(0.4 * long, w / 2 + 0.02)))


class Row(Params):
    """Slotted tubes with their injectors on one gas bar."""

    kind = "atmospheric burner"
    count: int = whole(4, 11, "tubes")
    long: float = between(0.3, 0.8, "length of the tubes", "m")
    height: float = between(0.25, 0.7, "of the tubes", "m")

    def build(self, t: Table) -> None:
        """Puts it down."""
        long, z, pitch = self.long, self.height, 0.07
        far, ys = (self.count - 1) * pitch, [k * pitch for k in range(self.count)]
        tube = extrude(rounded_rectangle(0.05, 0.03, 0.014, 3), 0.05, long)
        injector = turned(outline(0.022, -0.03, 0.012, 0.01, 0.018, 0.08), 12)
        t.add(_NAME, *(along("x", one, 0, y, z) for y in ys for one in (tube, injector)), of="trim")
        nuts = [along("x", hexagon(0.016, -0.06, -0.02), 0, y, z) for y in ys]
        t.add("pipe", rod((-0.06, -0.08, z), (-0.06, far + 0.08, z), 0.014, 10), *nuts, own=True)
        t.add("valve", box((0.08, 0.1, 0.09), (-0.06, -0.12, z)), own=True)
        xs, post = (0.08, long - 0.03), (0.03, 0.03, z - 0.05)
        frame = [box((0.03, far + 0.14, 0.03), (x, far / 2, z - 0.04)) for x in xs]
        t.add("bracket", *frame, *(box(post, (x, y, post[2] / 2)) for x in xs for y in (-0.05, far + 0.05)))


class NozzleMix(Params):
    """A nozzle mixing burner on a furnace wall with pilot and scanner."""

    kind = "nozzle burner"
    radius: float = between(0.05, 0.12, "of the body", "m")
    height: float = between(0.7, 1.3, "of its axis", "m")

    def build(self, t: Table) -> None:
        """Puts it down."""
        r, z, n = self.radius, self.height, t.n(self.radius)
        level = t.at(0, 0, z)
        shape = outline(1.6 * r, 0, 1.6 * r, 0.02, r, 0.02, r, 2.2 * r, 1.4 * r, 2.25 * r, 1.4 * r, 2.6 * r)
        body = turned([*shape, *outline(0.5 * r, 2.7 * r, 0.5 * r, 3.4 * r)], n)
        air = [cylinder(0.55 * r, 0.9 * r, 3 * r, n), cylinder(0.85 * r, 2.9 * r, 3.0 * r + 0.02, n)]
        level.add(_NAME, along("x", body), *(along("y", one, 1.2 * r) for one in air))
        pilot = [cylinder(0.18 * r, 0, 3.6 * r, 12), cylinder(0.28 * r, 2.4 * r, 3.2 * r, 12)]
        level.at(0.02, 0, 1.2 * r).spun("y", 1.1).add(_NAME, *pilot, hexagon(0.5 * r, 1.8 * r, 2.1 * r), of="trim")
        eye = [cylinder(0.14 * r, 0, 2.6 * r, 10), cylinder(0.3 * r, 2.6 * r, 3.6 * r, 12)]
        level.at(0.02, 0.6 * r, -1.1 * r).spun("y", 1.9).add(_NAME, *eye, of="rubber")
        level.along("x").add("bolt", around(hexagon(0.018, 0.02, 0.032), 8, 1.4 * r))
        gas = [(3.35 * r, 0, 0), (4.4 * r, 0, 0), (4.6 * r, 0, -0.2 * r), (4.6 * r, 0, -3 * r)]
        level.add("hose", rope(gas, 0.35 * r, 10), of="trim")
        t.add("wall", box((0.15, 8 * r + 0.2, z + 5 * r), (-0.075, 0, (z + 5 * r) / 2)))


_FORMS: tuple[type[InDuct] | type[Row] | type[NozzleMix], ...] = (InDuct, Row, NozzleMix)


class WithoutFan(
    Device, name="burner/without fan", group="Equipment", label=_NAME, bundle=_NAME, sizes=(15,), weight=1.5
):
    """Burners without a fan of their own: a duct burner in a rectangular duct, a row of them, or pilots."""

    form: int = whole(0, 2, "in a duct, a row of tubes, with a mixing nozzle")
    burner: InDuct | Row | NozzleMix = nested(lambda _, p: _FORMS[p.form], "the burner")

    def build(self, t: Table) -> Model:
        self.burner.build(t)
        return t.model(kind=self.burner.kind)


FIRED = families_of(Monobloc, WithoutFan)
