"""What instruments are put together from, besides dials and heads: tubes, handles, and stands, boards and vessels."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadplants.builder.device import Device
from cadplants.builder.dials import (
    CASE,
    fine_sides,
)  # fmt: skip
from cadplants.builder.params import Params, among, between, chance
from cadplants.builder.table import Table, outline
from cadplants.families.valves.valve import bolt_circle, disc_flange
from cadplants.model.standards import FLANGES, PIPES
from cadplants.parts.flange import plate_thickness
from cadplants.solids.mesh_ops import Solid, extrude, merge
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import box, cylinder, dome, hexagon, ring, rod, rope, turned
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["BEFORE", "FRONT", "Board", "Gauge", "Stand", "Vessel", "bent", "put", "t_handle"]

FRONT = (0.0, 0.0, 1.0)
"""Out of a dial about z."""
BEFORE = (0.0, -1.0, 0.0)
"""Out of what is read from before a device that stands upright."""


def t_handle(reach: float, wide: float, radius: float = 0.004) -> Solid:
    """A needle valve's bonnet, spindle and cross bar about z from 0 to ``reach`` [m]."""
    body = [hexagon(5 * radius, 0.0, 0.35 * reach), cylinder(radius, 0.3 * reach, reach, 8)]
    return merge([*body, rod((-wide / 2, 0, reach), (wide / 2, 0, reach), 0.8 * radius, 8)])


def bent(points: Sequence[Sequence[float]], radius: float, style: ModelingStyle) -> Solid:
    """A small tube through corners that are cut twice, so that its bends look round [m]."""
    path = [np.asarray(p, float) for p in points]
    for _ in range(2):
        cut = [path[0]]
        for a, b, c in zip(path[:-2], path[1:-1], path[2:], strict=True):
            # Cut no more than 3 diameters: long legs stay straight.
            for p in (a, c):
                step = p - b
                long = float(np.linalg.norm(step))
                cut.append(b + step / long * min(0.3 * long, 5 * radius))
        path = [*cut, path[-1]]
    return rope(np.array(path), radius, fine_sides(radius, style, 10))


class Gauge(Device, place="tap", group="Gauge assembly", label="gauge", bundle=CASE, sizes=(15,)):
    """A gauge."""


def put(t: Table, name: str, *solids: Solid, of: str = "") -> None:
    """Puts solids down as one part of the bundle that its name says."""
    t.bundled(name).add(name, *solids, of=of)


class Stand(Params):
    """A pipe stand about z (two inches) on a base plate."""

    side: float = between(0.15, 0.3, "width of its base plate", "m")
    disc: bool = chance(0.3, "its base plate is round")

    def build(self, t: Table, height: float) -> None:
        """Puts it down, this high [m]."""
        side, r = self.side, 0.0302
        t.add("post", turned(outline(r, 0.01, r, height - 0.004, 0.8 * r, height), t.n(r)))
        plate = cylinder(side / 2, 0.0, 0.01, t.n(side / 2)) if self.disc else box((side, side, 0.01), (0, 0, 0.005))
        t.add("base plate", plate)


class Board(Params):
    """Something to mount on, its front in y = 0 looking to -y: a wall, or a panel on posts."""

    walled: bool = chance(0.4, "a wall, not a panel on posts")
    wall: float = between(0.08, 0.2, "thickness of the wall", "m", when=lambda p: p.walled)
    over: float = between(0.1, 0.6, "what the wall is higher than it need be", "m", when=lambda p: p.walled)
    sheet: float = among((0.003, 0.006, 0.012), "of the panel", "m", when=lambda p: not p.walled, otherwise=0.0)
    post: float = among((0.04, 0.05, 0.06), "width of a post", "m", when=lambda p: not p.walled, otherwise=0.0)

    @property
    def thick(self) -> float:
        """From its front to its back [m]."""
        return self.wall if self.walled else self.sheet

    def build(self, t: Table, wide: float, low: float, high: float) -> None:
        """Puts it down, this wide and from one height to another [m]."""
        thick, w = self.thick, self.post
        if self.walled:
            tall = high + self.over
            t.add("wall", box((wide + 0.4, thick, tall), (0, thick / 2, tall / 2)))
            return
        t.add("plate", box((wide, thick, high - low), (0, thick / 2, (low + high) / 2)), of="electrical")
        for x in (0.0,) if wide < 0.25 else (-wide / 2 + w, wide / 2 - w):
            t.at(x, thick + w / 2).add("post", extrude(rounded_rectangle(w, w, 0.1 * w, 2), 0.01, high))
            t.add("base plate", box((2.5 * w, 2.5 * w, 0.01), (x, thick + w / 2, 0.005)))


class Vessel(Params):
    """A small upright vessel beside the origin with two nozzles towards +x whose faces are in x = 0."""

    radius: float = between(0.15, 0.35, "of the vessel", "m")
    reach: float = between(0.09, 0.15, "of its nozzles", "m")
    domed: bool = chance(0.6, "its lid is domed, not flat")

    def build(self, t: Table, low: float, high: float, dn: int, joints: bool = True) -> None:
        """Puts it down.

        Args:
            t: with the frame.
            low: height of the lower nozzle [m].
            high: of the upper one.
            dn: of the nozzles.
            joints: whether the nozzles end in flanges, with gaskets and bolts; else in bosses.
        """
        r, reach = self.radius, self.reach
        n, bottom, top, shell = t.n(r), low - 0.06 - 0.1 * r, high + 0.08, t.at(-r - reach)
        shell.add("shell", cylinder(r, bottom, top, n))
        lid = dome(r, 0.45 * r, 0.0, n) if self.domed else cylinder(1.06 * r, 0.0, 0.015, n)
        shell.at(0, 0, top).add("dished head", lid, of="tank")
        shell.at(0, 0, bottom).along("-z").add("dished head", dome(r, 0.4 * r, 0.0, n))
        leg = box((0.04, 0.04, bottom + 0.05), (0.98 * r + 0.01, 0, (bottom + 0.05) / 2))
        for k in range(3):
            shell.spun("z", np.pi / 3 + k * 2 * np.pi / 3).add("tank leg", leg)
        boss = cylinder(1.35 * PIPES[dn].radius, 0.0, reach + 0.02, t.n(0.02))
        for z in (low, high):
            t.at(0, 0, z).along("-x").add("nozzle", disc_flange(dn, t.style, reach + 0.02) if joints else boss)
        for z in (low, high) if joints else ():
            self._joint(t.at(0, 0, z).along("x"), dn)

    def _joint(self, t: Table, dn: int, pad: float = 0.002) -> None:
        """Gasket and bolts of a joint about z, a flange on either side."""
        size, plate, n = FLANGES[dn], plate_thickness(dn), t.n(FLANGES[dn].raised / 2)
        t.add("gasket", ring(PIPES[dn].radius, size.raised / 2, 0.0, pad, n))
        bolts = bolt_circle(size.n_bolts, size.circle / 2, size.bolt, -plate, plate + pad)
        t.bundled("").add("bolt", bolts)
