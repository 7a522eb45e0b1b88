"""Bodies of globe valves and of control valves like them."""

from __future__ import annotations

import numpy as np

from cadplants.builder.params import Params, among, between, chance
from cadplants.builder.table import Table
from cadplants.families.valves.actuation_hand import scaled
from cadplants.families.valves.body import ended, neck_of, oval
from cadplants.mesh_ops import Solid, merge, moved
from cadplants.primitives import along, ball, cylinder, hexagon, lofted, turned
from cadplants.transforms import at

__all__ = ["GlobeBody"]


class GlobeBody(Params):
    """A globe's body: a bowl, a barrel or a box with a waist below its collar."""

    belly: float = between(1.3, 1.6, "radius of the bowl / of the pipe")
    form: str = among(("ball", "bowl", "drum", "box"), "shape of the bowl")
    stretch: float = between(0.9, 1.2, "height of a ball / its width", when=lambda p: p.form == "ball", otherwise=1.0)
    shift: float = between(-0.25, 0.1, "height of a ball's middle / its radius", when=lambda p: p.form == "ball")
    drained: bool = chance(0.25, "a drain below")

    def solid(self, t: Table, length: float, ends: str, seat: float, throat: float) -> Solid:
        """The body along x up to the height ``seat``, its neck of the radius ``throat`` [m]."""
        r, (neck, low), b = t.pipe.radius, neck_of(t.dn), self.belly * t.pipe.radius + 0.006
        neck, low = (neck, low) if ends == "flanged" else (1.1 * r, 0.12 * length)
        wide, n = 1.15 * r + 0.003, t.n(b, 16)
        middle = [(neck, low), (wide, 0.28 * length), (wide, 0.72 * length), (neck, length - low)]
        if self.form == "ball":
            bowl = moved(ball(b, n, self.stretch), at(0, 0, self.shift * b))
        elif self.form == "bowl":
            bowl = turned(scaled(b, 0.5, -1.2, 0.9, -1.0, 1, -0.5, 1, 0.6, 0.8, 1), n)
        elif self.form == "drum":
            bowl = along("y", cylinder(1.05 * b, -0.9 * b, 0.9 * b, n))
        else:
            loops = ((0.8, -1.15), (1.0, -0.9), (1.0, 0.6), (0.75, 1.05))
            bowl = lofted([np.column_stack([oval(1.35 * b * s, b * s, n), np.full(n, z * b)]) for s, z in loops])
        solids = [bowl]
        if self.drained:
            solids += [cylinder(0.25 * b, -1.4 * b, 0.0, 10), hexagon(0.4 * b, -1.6 * b, -1.4 * b)]
        solids.append(cylinder(throat, 0.0, seat - 0.002, n))
        run = ended(t.dn, t.style, length, middle, ends)
        return merge([run, *(moved(solid, at(length / 2)) for solid in solids)])
