"""Clamps beside lines: hose clamps, tube couplers, cable cleats, girder clamps."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import made, one_of
from cadplants.builder.params import Params, among, between, chance, given, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.supports.shape import (
    Fitting,
    add_bolt,
    arc_yz,
    few,
    slab_yz,
    strap,
    upright,
)
from cadplants.model.family import Model
from cadplants.model.standards import SIZES
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved, tube
from cadplants.solids.polygon import circle, rounded_rectangle, section_channel, section_i
from cadplants.solids.primitives import BOTH, CORNERS, along, bar, box, cylinder, hexagon, ring
from cadplants.solids.transforms import at, spun

__all__ = ["COUPLES"]


class _HoseClamp(Params):
    """A clamp round a hose along x."""

    form: str = given("ears", "how it is closed")
    turn: float = between(0, 6, "where its screw is", "rad")
    twin: bool = chance(0.6, "two ears", when=lambda p: p.form == "ears")

    def build(self, t: Table, out: float, thick: float, wide: float, n: int) -> None:
        """Puts it down: its band, what closes it on top, its screw.

        Args:
            t: with the frame.
            out: radius of the hose [m].
            thick: of the band [m].
            wide: width of the band [m].
            n: sides of the band.
        """
        t, form = t.spun("x", self.turn), self.form
        band, b, top = along("x", ring(out, out + thick, -wide / 2, wide / 2, n)), 0.35 * wide + 0.002, out + thick
        if form == "worm drive":  # a housing with a screw across
            axis = top + 1.2 * b
            house = box((1.15 * wide, 3.2 * b, 1.5 * b), (0, 0, top + 0.7 * b))
            t.add("clamp", band, house, along("y", cylinder(0.75 * b, -1.6 * b, 1.6 * b, 10), 0, 0, axis))
            screw = [cylinder(0.5 * b, 1.5 * b, 3.4 * b, 8), hexagon(1.5 * b, 2.0 * b, 3.4 * b)]
            t.at(0, 0, axis).along("y").add("screw", *screw)
        elif form == "trunnions":  # and a bolt
            axis, lug = top + 0.6 * b, cylinder(0.8 * b, -0.6 * wide, 0.6 * wide, 10)
            t.add("clamp", band, *(along("x", lug, 0, q * 2.2 * b, axis) for q in BOTH))
            bolt = [cylinder(0.35 * b, -3.5 * b, 4 * b, 8), hexagon(1.3 * b, 3.0 * b, 3.7 * b)]
            t.at(0, 0, axis).along("y").add("bolt", *bolt)
        elif form == "ears":  # pinched
            side = outline(-b, 0, b, 0, 0.3 * b, 1.6 * b, -0.3 * b, 1.6 * b)
            ear = moved(slab_yz(side, -wide / 2, wide / 2), at(0, 0, out + 0.5 * thick))
            t.add("clamp", band, ear, *([moved(ear, spun("x", np.pi))] if self.twin else []))
        else:  # a doubled wire with a screw block
            top += thick
            wires = [along("x", ring(out, top, q - thick, q + thick, n)) for q in (-0.35 * wide, 0.35 * wide)]
            t.add("clamp", *wires, box((wide, 2 * b, 2 * b), (0, 0, top + 0.8 * b)))
            screw = [cylinder(0.4 * b, -1.5 * b, 3 * b, 8), cylinder(0.8 * b, 3 * b, 3.6 * b, 8)]
            t.at(0, 0, top + b).along("y").add("screw", *screw)


class Hose(Fitting, name="clamp/hose", place="end", label="clamp", bundle="clamp", sizes=SIZES[:9], grain="structure"):
    """A hose pushed on the end of a pipe and held by clamps: worm drive (DIN 3017), trunnions, ears, wire."""

    reach: float = between(4, 12, "length of the hose - 50 mm / radius of the line")
    swing: float = between(0, 0.35, "how far it hangs down / its length")
    form: str = among(("worm drive", "trunnions", "ears", "wire"), "how the clamps are closed")
    one: bool = chance(0.6, "one clamp")
    clamps: tuple[_HoseClamp, ...] = several(
        made(_HoseClamp, lambda p: {"form": p.form}), lambda p: 1 if p.one else 2, "clamps"
    )

    def build(self, t: Table) -> Model:
        r = t.pipe.radius
        n, out, over, reach = t.n(r), r + (0.003 + 0.08 * r), 1.2 * r + 0.03, self.reach * r + 0.05
        s = np.linspace(0, 1, 9)[1:]
        sag = -self.swing * reach * (1 - np.cos(np.pi * s / 2)) * s
        path = np.vstack([[(-over, 0.0, 0.0), (0.0, 0.0, 0.0)], np.column_stack([reach * s, np.zeros(8), sag])])
        t.add("hose", tube(path, out, r if t.style.hollow else 0.0, n))
        for x, clamp in zip((-0.5,) if self.one else (-0.7, -0.25), self.clamps, strict=True):
            clamp.build(t.at(x * over), out, 0.0008 + 0.008 * r, 0.009 + 0.06 * r, n)
        return t.model()


class Coupler(Fitting, name="clamp/coupler", label="clamp", bundle="clamp"):
    """A frame of tubes (48.3 mm) in right-angle, swivel and parallel couplers (EN 74)."""

    radius: float = among((0.02415, 0.02415, 0.0169, 0.0213), "of the tubes", "m")
    high: float = between(0.9, 1.8, "height of the posts", "m")
    span: float = between(0.7, 1.5, "from post to post", "m")
    lean: float = among((0.0, 0.0, 0.5, -0.7), "of a slanting tube, at most", "rad")
    second: float = between(0.3, 0.6, "height of a second level tube / of the posts", when=lambda p: not p.lean)
    taken: tuple[str, ...] = several(
        one_of("beam", "railing"), 2, "what the level tubes are taken for, lower first", when=lambda p: not p.lean
    )

    def build(self, t: Table) -> Model:
        r, n, high, span, thick = self.radius, t.n(self.radius), self.high, self.span, 0.006
        wall = 0.0032 if t.style.hollow else r
        for x in (0.0, span):
            t.at(x).add("post", ring(r - wall, r, 0.006, high, n))
            t.add("base plate", box((5 * r, 5 * r, 0.006), (x, 0, 0.003)))
        slope = float(np.sign(self.lean)) * min(abs(self.lean), float(np.arctan(0.6 * high / span)))
        levels = [0.85 * high] if slope else sorted({0.9 * high, round(self.second * high, 3)})
        y, hinge_x, grade = 2 * (r + thick), -r - thick - 0.006, np.tan(slope)
        one, screw, rise = self._clamp(n), self._screw(), grade * span
        pin, bore = cylinder(0.005, -0.8 * r, 0.8 * r, 8), (circle(r - wall, n),) if t.style.hollow else ()
        for z, name in zip(levels, self.taken or ("brace",), strict=False):
            low = z - max(rise, 0.0)
            ends = (-0.15, y, low - 0.15 * grade), (span + 0.15, y, low + rise + 0.15 * grade)
            t.add(name, bar(*ends, circle(r, n), bore), of="steel")
            for x in (0.0, span):
                height = low + rise * x / span
                standing, lying = t.at(x, 0, height), t.at(x, y, height).spun("y", np.pi / 2 - slope)
                standing.add("clamp", one)
                lying.add("clamp", one)
                standing.at(hinge_x).add("bolt", pin)
                standing.add("bolt", screw)
                lying.add("bolt", screw)
        return t.model()

    def _clamp(self, n: int) -> Solid:
        """A clamp about z: two halves with flanges where the bolt sits, and a hinge."""
        r, thick, wide = self.radius, 0.006, 1.6 * self.radius
        arcs = [arc_yz(r + thick / 2, a + 0.06, a + np.pi - 0.06, max(6, n // 2)) for a in (0.0, np.pi)]
        halves = [moved(strap(arc, wide, thick), spun("y", np.pi / 2)) for arc in arcs]
        ears = [box((0.022, 0.006, 0.8 * wide), (r + thick + 0.008, q * 0.006, 0)) for q in BOTH]
        third = wide / 3
        hinge = [ring(0.005, 0.01, q * third - third / 2, q * third + third / 2 - 0.001, 8) for q in (-1, 0, 1)]
        return merge([*halves, *ears, moved(merge(hinge), at(-r - thick - 0.006))])

    def _screw(self) -> Solid:
        solids = (cylinder(0.006, -0.03, 0.026, 8), hexagon(0.022, 0.01, 0.02), cylinder(0.012, -0.014, -0.009, 10))
        return along("y", merge(solids), self.radius + 0.016)


_CLEATS = ("trefoil", "blocks", "strap")


class _Rung(Params):
    """A strut across cables with the cleats on it."""

    pieces: int = given(1, "pieces of the cleats on it")
    taken: str = among(("beam", "beam", "plate"), "what it is taken for")
    materials: tuple[str, ...] = several(
        one_of("clamp", "clamp", "rubber"), lambda p: p.pieces, "materials of the cleats"
    )


class Cleat(Fitting, name="clamp/cleat", label="clamp", bundle="clamp"):
    """Cables in cleats (IEC 61914) on a ladder or struts: trefoil of sheet, blocks, straps."""

    radius: float = between(0.012, 0.032, "of a cable", "m")
    long: float = between(1.0, 2.2, "length of the cables", "m")
    pitch: float = between(0.3, 0.5, "from strut to strut", "m")
    high: float = between(0.3, 1.2, "height of the struts", "m")
    form: str = among(_CLEATS, "how the cleats are made")
    cables: int = whole(1, 3, "cables side by side", when=lambda p: p.form != "trefoil", otherwise=1)
    rungs: tuple[_Rung, ...] = several(
        made(_Rung, lambda p: {"pieces": p.cables * (2 if p.form == "blocks" else 1)}),
        lambda p: len(Cleat.places(p)),
        "struts",
    )

    @staticmethod
    def places(p: Any) -> np.ndarray:
        """Where the struts are along the cables [m]."""
        return np.arange(-p.long / 2 + 0.12, p.long / 2 - 0.08, p.pitch)

    def build(self, t: Table) -> Model:
        q, length, top = self.radius, self.long, self.high
        trefoil, n, step = self.form == "trefoil", few(q, t.style, 20), 2 * q + 0.03
        rows, high = [k * step for k in range(self.cables)], q + np.sqrt(3) * q
        for row in rows:
            for y, z in ((-q, q), (q, q), (0.0, high)) if trefoil else ((0.0, q + 0.004),):
                t.at(0, row + y, top + z).along("x").add("cable", cylinder(q, -length / 2, length / 2, n))
        middle, half = float(np.mean(rows)), (rows[-1] - rows[0]) / 2 + 3 * q + 0.06
        solids, spots, grip = self._cleat(0.03 + 0.5 * q)
        section = section_channel(0.041, 0.041, 0.0025, 0.0025) @ np.array([[0.0, -1.0], [1.0, 0.0]])
        for x, rung in zip(self.places(self), self.rungs, strict=True):
            spot, materials = t.at(float(x), 0, top), iter(rung.materials)
            t.add(rung.taken, bar((x, middle - half, top), (x, middle + half, top), section), of="clamp")
            for row in rows:
                for solid in solids:
                    spot.at(0, row).add("clamp", solid, of=next(materials))
                for y in spots:
                    add_bolt(spot.at(0, row + y), 0.006, grip, "none")
        for s in BOTH:
            t.add("beam", box((length, 0.004, 0.06), (0, middle + s * (half + 0.002), top - 0.02)), of="clamp")
            for x in (-0.35 * length, 0.35 * length):
                t.add("post", box((0.05, 0.05, top - 0.05), (x, middle + s * (half - 0.02), (top - 0.05) / 2)))
        return t.model()

    def _cleat(self, wide: float) -> tuple[list[Solid], tuple[float, float], float]:
        """A cleat over cables that lie on z = 0, where its bolts go and what they clamp [m]."""
        q, thick = self.radius, 0.003
        if self.form == "trefoil":
            ear, knee, rim = 2 * q + 0.02, np.pi / 6, q + thick / 2
            right = arc_yz(rim, -0.25, knee, 4, q, q)
            crown = arc_yz(rim, knee, np.pi - knee, 6, 0.0, q + np.sqrt(3) * q)
            foot = np.array([[0, 2 * q + ear, thick / 2], [0, 2 * q + thick / 2 + 0.002, thick / 2]])
            mirror = np.array([1, -1, 1])
            path = np.vstack([foot, right[1:], crown, (right * mirror)[:0:-1], (foot * mirror)[::-1]])
            return [strap(path, wide, thick)], (-2 * q - 0.6 * ear, 2 * q + 0.6 * ear), thick
        if self.form == "blocks":
            a, reach, seam = np.linspace(0, np.pi, 9), q + 0.014, 0.0005
            hollow = np.column_stack([q * np.cos(a), q * np.sin(a)])[::-1][1:-1]
            crest = outline(reach, 0.6 * q, 0.5 * reach, q + 0.006, -0.5 * reach, q + 0.006, -reach, 0.6 * q)
            upper = [(-reach, seam), *hollow, (reach, seam), *crest]
            lower = [(-reach, -seam), *(hollow * (1, -1)), (reach, -seam), (reach, -q - 0.004), (-reach, -q - 0.004)]
            halves = [moved(slab_yz(half, -wide / 2, wide / 2), at(0, 0, q + 0.004)) for half in (upper, lower)]
            return halves, (-reach + 0.006, reach - 0.006), 1.6 * q + 0.004
        ends = np.array([[0, q + 0.02, thick / 2], [0, q + thick / 2, thick / 2]])
        bow = arc_yz(q + thick / 2, 0, np.pi, 8, 0.0, q + 0.004)
        return [strap(np.vstack([ends, bow, (ends * (1, -1, 1))[::-1]]), wide, thick)], (-q - 0.012, q + 0.012), thick


class Girder(Fitting, name="clamp/girder", label="clamp", bundle="clamp"):
    """Two beams that cross, held by clamp jaws and bolts with a plate between them, nothing drilled or welded."""

    high: float = among((0.12, 0.16, 0.2), "height of a beam", "m")
    wide: float = among((0.1, 0.14), "width of a beam", "m")
    size: float = among((0.012, 0.016), "diameter of the bolts", "m")
    long: float = between(0.8, 1.6, "length of the beams", "m")
    low: float = between(0.5, 1.2, "height of the lower beam's underside", "m")
    plate: float = among((0.0, 0.01, 0.015), "thickness of a plate between the beams", "m")
    form: str = among(("cast", "bent", "round"), "how the jaws are made")
    posts: tuple[str, ...] = several(one_of("post", "column", "foundation"), 2, "what the posts are taken for")

    def build(self, t: Table) -> Model:
        h, b, f, d, length, z = self.high, self.wide, 0.01, self.size, self.long, self.low
        section, half, plate = section_i(h, b, 0.006, f), length / 2, self.plate
        top = z + h + plate
        t.add("beam", bar((-half, 0, z + h / 2), (half, 0, z + h / 2), section))
        t.add("beam", bar((0, -half, top + h / 2), (0, half, top + h / 2), section))
        q = b / 2 + 0.7 * d
        if plate:
            t.add("plate", box((2 * q + 3 * d, 2 * q + 3 * d, plate), (0, 0, z + h + plate / 2)))
        jaw, low, high = self._jaw(f), z + h - f, top + f
        lift = {"cast": 0.8, "bent": 0.5, "round": 0.7}[self.form] * d
        for x, y in CORNERS:
            corner = t.at(x * q, y * q)
            # Its nose on the flange, its tail on the plate or the other flange.
            corner.at(0, 0, high).spun("z", np.pi if x > 0 else 0.0).add("clamp", jaw)
            lower = corner.at(0, 0, low).spun("z", -np.pi / 2 if y > 0 else np.pi / 2)
            lower.moved(np.diag([1.0, 1.0, -1.0, 1.0])).add("clamp", jaw)
            add_bolt(corner.at(0, 0, low - lift), d, 2 * f + plate + 2 * lift)
        for s, name in zip(BOTH, self.posts, strict=True):
            t.add(name, box((0.1, b, z), (s * (half - 0.08), 0, z / 2)), of="steel")
        return t.model()

    def _jaw(self, f: float) -> Solid:
        """A jaw on a flange of this thickness, its nose towards +x."""
        d, tail = self.size, 1.4 * self.size
        if self.form == "cast":
            back = outline(-tail, -f, -0.6 * tail, -f, -0.6 * tail, 0, 1.6 * d, 0, 1.6 * d, 0.5 * d, 0.3 * d, d)
            return upright([*back, (-tail, 0.8 * d)], -1.1 * d, 1.1 * d)
        if self.form == "bent":
            heel = box((0.5 * d, 2.4 * d, f), (-tail + 0.25 * d, 0, -f / 2))
            return merge([box((3.0 * d, 2.4 * d, 0.5 * d), (0.1 * d, 0, 0.25 * d)), heel])
        return moved(extrude(rounded_rectangle(3.2 * d, 2.2 * d, 0.9 * d, 3), 0, 0.7 * d), at(0.1 * d))


COUPLES = families_of(Hose, Coupler, Cleat, Girder)
