"""Pieces that ball and globe valves share: stem necks, balls with their seats, sanitary clamps, globe bodies."""

from __future__ import annotations

import numpy as np

from cadplants.builder.params import Params, among, between, chance
from cadplants.builder.table import Table
from cadplants.families.valves.actuation_base import put_stem
from cadplants.families.valves.actuation_hand import scaled, slab
from cadplants.families.valves.ball import ferrule, part_ring
from cadplants.families.valves.body import bolts_on, ended, neck_of, oval, plate_outline, valve_ball
from cadplants.mesh_ops import Solid, about_x, merge, moved
from cadplants.primitives import along, ball, box, cylinder, hexagon, lofted, ring, rod, turned
from cadplants.transforms import at

__all__ = ["BallInside", "Clamps", "GlobeBody", "StemTop"]


class StemTop(Params):
    """A stem neck with a mounting pad (ISO 5211) round, square or none, its gland and its stem."""

    pad: str = among(("round", "square", "octagon", "none"), "its mounting pad")
    is_round: bool = chance(0.5, "its gland is round, not a nut")

    def build(self, t: Table, low: float, high: float, radius: float) -> None:
        """Puts it down between two heights, for a pipe of a radius [m]."""
        boss, foot = 0.4 * radius + 0.007, high - 0.004 - 0.06 * radius
        n, solids = t.n(boss, 12), [cylinder(boss, low, high, t.n(boss, 12))]
        if self.pad != "none":
            edge = plate_outline(self.pad, 2.0 * boss, 2.0 * boss, n)
            solids.append(slab(edge, foot, high))
            t.extend([bolts_on(edge, 4, foot, high + 0.001, 0.004 + 0.03 * radius)])
        t.add("valve body", *solids)
        put_stem(t, high - 0.003, high + 0.5 * boss + 0.004, 0.5 * boss)
        gland = cylinder(0.8 * boss, high, high + 0.25 * boss, n)
        t.add("gland", gland if self.is_round else hexagon(1.5 * boss, high, high + 0.3 * boss))


class BallInside(Params):
    """A valve's ball and its two seats."""

    size: float = between(1.4, 1.6, "radius of the ball / of its bore")
    turn: float = among((0.0, 0.0, np.pi / 4, np.pi / 2), "of the ball from open", "rad")

    def build(self, t: Table, trunnions: float = 0.0) -> None:
        """Puts it down about the origin, its bore along x, maybe on stubs of this reach [m]."""
        bore = 0.9 * t.pipe.bore
        big = bore * self.size
        t.add("valve ball", valve_ball(big, bore, t.style, self.turn, trunnions))
        seat, far = (
            ring(1.03 * bore, 1.25 * bore, 0.0, 0.16 * bore, t.n(bore, 16)),
            np.sqrt(big**2 - (1.14 * bore) ** 2),
        )
        for x in (far, -far - 0.16 * bore):
            t.at(x).along("x").add("gasket", seat, of="rubber", own=True)


class Clamps(Params):
    """Clamps of two hinged halves with wing nuts (ISO 2852) round the ferrules before and behind a sanitary valve."""

    first: float = between(0, 6, "how far the clamp of the inlet is turned", "rad")
    second: float = between(0, 6, "how far the clamp of the outlet is turned", "rad")

    def build(self, t: Table, stub: float, length: float) -> None:
        """Puts them down with the pipe's ferrules, for a valve whose own faces lie ``stub`` inward [m]."""
        for low, high, face in ((0.0, stub - 0.001, False), (length - stub + 0.001, length, True)):
            t.add("coupling", ferrule(t.dn, low, high, t.style, face), of="pipe", own=False)
        rim = 1.25 * t.pipe.radius + 0.008
        half = [(1.01 * rim, 0.004), (0.86 * rim, 0.009), (1.12 * rim, 0.009)]
        hoop = part_ring([*((a, -z) for a, z in half), *half[::-1]], t.n(rim, 16))
        bolt = [
            rod((1.22 * rim, -0.3 * rim, 0), (1.22 * rim, 0.35 * rim + 0.02, 0), 0.004, 8),
            box((0.012, 0.014, 0.016), (1.18 * rim, -0.2 * rim, 0)),
            box((0.02, 0.014, 0.016), (1.18 * rim, 0.2 * rim, 0)),
            box((0.006, 0.012, 0.034), (1.22 * rim, 0.35 * rim + 0.016, 0)),
            box((0.014, 0.02, 0.016), (-1.15 * rim, 0, 0)),
        ]
        clamp = about_x(merge([hoop, *bolt]))
        for x, turn in ((stub, self.first), (length - stub, self.second)):
            t.at(x).spun("x", turn).add("clamp", clamp)


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
