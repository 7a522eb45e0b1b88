"""Clamp saddles: two shells round a pipe drawn together by bolts, with a boss for a branch."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance
from cadplants.builder.table import Table
from cadplants.families.piping.coupling import half_band
from cadplants.families.piping.shape import UP, Fitting, Tail, bolting, pipe_x, sized, tail_of
from cadplants.model.family import Model
from cadplants.model.standards import PIPES, SIZES, sizes_between
from cadplants.solids.mesh_ops import Solid, moved
from cadplants.solids.primitives import BOTH, box, cylinder, hexagon, turned
from cadplants.solids.transforms import at, spun

__all__ = ["CLAMP_SADDLES"]


class ClampSaddle(Fitting, name="branch outlet/clamp saddle", sizes=sizes_between(25), weight=1.5):
    """A clamp saddle on a pipe: two half shells with ears, two or four bolts or a hinge and a bolt, and a boss."""

    other: int = among(
        lambda p: [size for size in SIZES if PIPES[size].radius < 0.62 * PIPES[p.dn].radius][-4:] or [15],
        "nominal size of its branch",
        "mm",
    )
    long: float = between(2.4, 4.5, "its length along the pipe / radius of the branch")
    thick: float = between(0.06, 0.22, "(thickness of its shells - 3 mm) / radius of the pipe")
    ear: float = between(0.15, 0.4, "(how far its ears stand out - 10 mm) / radius of the pipe")
    plate: float = between(0.08, 0.22, "(thickness of an ear - 4 mm) / radius of the pipe")
    paired: bool = chance(0.5, "four bolts, not two")
    hinged: bool = chance(0.2, "a hinge on one side")
    strap: float = among((1.0, 1.0, 0.6, 0.35), "length of the lower shell / of the upper")
    boss: str = among(("round", "round", "hexagon", "stepped", "coned", "ribbed"), "form of its boss")
    rise: float = between(0.9, 2.4, "height of the boss over the shell / radius of the branch")
    broad: float = between(1.25, 1.8, "radius of the boss / of the branch")
    one: bool = chance(0.35, "both shells and the heads of the bolts are one mesh")
    bare: float = between(0.05, 0.3, "length of the line that it leaves bare", "m")
    roll: float = among((0.0, 0.0, 0.5, -0.5), "how it is turned about the pipe / half a turn")
    tail: Tail = tail_of("open", "open", "cap", "flange")

    def build(self, t: Table) -> Model:
        (r, n, _), q = sized(t.dn, t.style), PIPES[self.other].radius
        outer, width = r + self.thick * r + 0.003, self.long * q
        length, top = width + self.bare, outer + self.rise * q
        t.add("pipe", pipe_x(t.dn, 0.0, length, t.style), own=False)
        place = t.at(0.5 * length).spun("x", self.roll * np.pi)
        lower = max(self.strap * width, 0.03 if self.paired else 0.02)
        lower = min(lower, width)
        upper = [half_band(r, outer, -0.5 * width, 0.5 * width, n), *self._boss(q, r, outer, top, place.n(q, 6))]
        below = [moved(half_band(r, outer, -0.5 * lower, 0.5 * lower, n), spun("x", np.pi))]
        spots, out = self._ears(upper, below, (r, outer), lower)
        if self.one:
            size = 0.35 * (out - outer)
            plate = self.plate * r + 0.004
            for x, y in spots:
                for low in (plate, -plate - 1.2 * size):
                    upper.append(moved(hexagon(1.7 * size, low, low + 1.2 * size), at(x, y)))
                upper.append(moved(cylinder(0.5 * size, -1.1 * plate, 1.1 * plate, 6), at(x, y)))
            place.add("branch outlet", *upper, *below, of="valve")
        else:
            place.add("branch outlet", *upper, of="valve")
            place.add("branch outlet", *below, of="valve")
            plate, thread = self.plate * r + 0.004, 0.25 * (out - outer)
            for x, y in spots:
                place.extend(bolting(1, 0.0, thread, -plate, plate, t.style, "", at(x, y) @ UP))
        self.tail.build(place.at(0, 0, top).moved(UP), self.other)
        return t.model(round(length, 9), "welded")

    def _ears(
        self, upper: list[Solid], below: list[Solid], radii: tuple[float, float], lower: float
    ) -> tuple[list[tuple[float, float]], float]:
        """Puts ears on both shells, or a hinge on one side; where the bolts go, and how far the ears reach [m]."""
        (r, outer), plate = radii, self.plate * radii[0] + 0.004
        out = outer + self.ear * r + 0.01
        wide, middle = out - r, 0.5 * (out + r)
        sides = (1,) if self.hinged else BOTH
        for side in sides:
            for solids, way in ((upper, 1), (below, -1)):
                solids.append(box((lower, wide, 0.98 * plate), (0, side * middle, way * 0.51 * plate)))
        if self.hinged:
            pin = cylinder(0.6 * plate, -0.55 * lower, 0.55 * lower, 10)
            upper.append(moved(pin, at(0, -outer - 0.3 * plate) @ spun("y", 0.5 * np.pi)))
        xs = (-0.32 * lower, 0.32 * lower) if self.paired else (0.0,)
        return [(x, side * 0.5 * (out + outer)) for side in sides for x in xs], out

    def _boss(self, q: float, r: float, outer: float, top: float, n: int) -> list[Solid]:
        """The boss about z, from within the shell to its mouth [m]."""
        wide, low = self.broad * q, float(np.sqrt(max(r * r - (self.broad * q) ** 2, 0.09 * r * r))) + 0.002
        low = max(low, r * 0.9)
        if self.boss == "hexagon":
            return [cylinder(0.95 * wide, low, top, n), hexagon(2.1 * wide, top - 0.7 * q, top)]
        if self.boss == "stepped":
            return [turned([(wide, low), (wide, top - 0.6 * q), (1.2 * wide, top - 0.6 * q), (1.2 * wide, top)], n)]
        if self.boss == "coned":
            return [turned([(1.25 * wide, outer - 0.3 * (outer - low)), (wide, top)], n)]
        body = cylinder(wide, low, top, n)
        if self.boss == "ribbed":
            rib = box((2 * wide + 1.2 * q, 0.25 * q, top - outer), (0, 0, 0.5 * (outer + top) - 0.1 * q))
            return [body, rib, moved(rib, spun("z", 0.5 * np.pi))]
        return [body]


CLAMP_SADDLES = families_of(ClampSaddle)
