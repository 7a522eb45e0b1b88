"""Pipe fittings: couplings, unions, bellows, strainers, crosses, reducers, outlets, ends; along x from 0."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.draws import yes
from cadplants.builder.params import among, between, chance, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.piping.shape import (
    QUARTERS,
    ROLL,
    SMALL,
    Fitting,
    below,
    bend_path,
    counter,
    crossing,
    flat_flange,
    lathe,
    parts_of,
    sized,
)
from cadplants.families.valves.threaded import hex_end
from cadplants.families.valves.valve import bolt_circle, disc_flange, flanged_body
from cadplants.model.family import Model
from cadplants.model.standards import FACE_TO_FACE, PIPES, REDUCER_LENGTH, SIZES, TEE_CENTER_TO_END, sizes_between
from cadplants.parts.flange import nut_room, plate_thickness
from cadplants.parts.piping import cap
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, about_x, extrude, loft, merge, moved, revolve, tube, weld
from cadplants.solids.polygon import circle
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, hexagon, lofted, ring, torus, turned, waves
from cadplants.solids.transforms import at, spun

__all__ = ["FITTINGS"]


_UP_AND_DOWN = (np.pi / 2, 3 * np.pi / 2)


class _Fitting(Fitting, weight=1.0):
    """A fitting of the common makes."""


def _half_ring(inner: float, outer: float, width: float, sides: int) -> Solid:
    angles = np.linspace(0.0, np.pi, max(6, sides // 2) + 1)
    unit = np.column_stack([np.cos(angles), np.sin(angles)])
    return extrude(np.concatenate([outer * unit, inner * unit[::-1]]), 0.0, width)


class Sleeve(_Fitting, name="coupling/sleeve", bundle="coupling", weight=2):
    """A threaded or socket coupling (ASME B16.11), plain or hexagonal; or a grooved one of two halves with bolts."""

    form: str = among(("plain", "flats", "banded", "grooved"), "how it is made")
    flats: int = among((6, 8), "flats for a wrench", when=lambda p: p.form == "flats", otherwise=0)

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style)
        if self.form == "grooved":
            return self._grooved(t)
        length, big, thin = 1.5 * r + 0.025, 1.25 * r + 0.002, 1.12 * r
        if self.form == "plain":
            solid = along("x", ring(bore, big, 0, length, n))
        elif self.form == "flats":
            solid = hex_end(t.dn, 0, length, t.style, self.flats)
        else:
            a = 0.15 * length
            shape = outline(big, 0.0, big, a, thin, 1.5 * a, thin, length - 1.5 * a, big, length - a, big, length)
            solid = along("x", turned(shape, n, bore=bore))
        t.add("coupling", solid, of="pipe", own=False)
        return t.model(round(length, 6), "welded")

    def _grooved(self, t: Table) -> Model:
        """It clamps the two pipes, which meet inside it."""
        r, n, bore = sized(t.dn, t.style)
        width, outer = 0.045 + 0.1 * r, 1.18 * r + 0.008
        lug = box((0.35 * outer, 0.4 * outer, 0.8 * width), (1.1 * outer, 0.22 * outer, width / 2))
        half = merge([_half_ring(r, outer, width, n), lug, moved(lug, np.diag([-1.0, 1.0, 1.0, 1.0]))])
        shank = cylinder(0.08 * outer, -0.55 * outer, 0.55 * outer, 8)
        bolt = merge([shank, hexagon(0.22 * outer, 0.42 * outer, 0.55 * outer)])
        ways = [t.along("x").spun("z", turn) for turn in (0.0, np.pi)]
        for way in ways:
            way.add("coupling", half)
        for way in ways:
            way.at(1.1 * outer, 0, width / 2).along("y").add("bolt", bolt)
        t.along("x").add("pipe", ring(bore, r, 0, width, n), own=False)
        return t.model(round(width, 6), "welded")


class Union(_Fitting, name="union/hexagon", bundle="union", sizes=SMALL, weight=2, grain="structure"):
    """A union (ASME B16.11, EN 10242): two wrench ends and a big nut over the joint."""

    flats: int = among((6, 8), "flats of its far end")

    def build(self, t: Table) -> Model:
        r = t.pipe.radius
        length = 2.0 * r + 0.035
        mid = 0.45 * length
        t.add("union", hex_end(t.dn, 0, mid, t.style, 8), hex_end(t.dn, mid, length, t.style, self.flats))
        t.along("x").add("union", hexagon(3.1 * r + 0.008, 0.3 * length, 0.66 * length, 1.2 * r, 12))
        return t.model(round(length, 6), "welded")


class Nipple(_Fitting, name="nipple/hexagon", sizes=SMALL):
    """A hexagon nipple, or a barrel nipple between two couplings."""

    flats: bool = chance(0.5, "a hexagon round it, no couplings at its ends")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style)
        length, sock = 2.0 * r + 0.03, 1.2 * r + 0.012
        if self.flats:
            six = hexagon(2.4 * r + 0.004, 0.42 * length, 0.58 * length, 0.5 * r)
            t.along("x").add("nipple", ring(bore, 0.96 * r, 0, length, n), six, of="trim")
            return t.model(round(length, 6), "welded")
        far = sock + length
        for name, radius, low, high in (
            ("coupling", 1.25 * r + 0.002, 0.0, sock),
            ("nipple", r, sock, far),
            ("coupling", 1.25 * r + 0.002, far, far + sock),
        ):
            t.along("x").add(name, ring(bore, radius, low, high, n), of="trim")
        return t.model(round(far + sock, 6), "welded")


class FlangedBellows(_Fitting, name="expansion joint/flanged", bundle="expansion joint", weight=1.5):
    """An expansion joint (EN 14917): waves between two flanges, plain or with tie rods; or one rubber arch."""

    rubber: bool = chance(0.35, "one rubber arch, not metal waves")
    waves: int = whole(3, 8, "waves", when=lambda p: not p.rubber, otherwise=1)
    tied: bool = chance(0.4, "tie rods")
    rods: int = among((2, 3, 4), "tie rods", when=lambda p: p.tied, otherwise=0)

    def build(self, t: Table) -> Model:
        r, thick, neck = t.pipe.radius, plate_thickness(t.dn), 1.02 * t.pipe.radius
        low = thick + nut_room(t.dn)
        length = 2 * low + (0.9 if self.rubber else 0.22 * self.waves) * max(r, 0.03)
        high, top = length - low, r * (1.6 if self.rubber else 1.35) + 0.004
        skin = [(neck, low * 0.999), *waves(low, high, neck, top, self.waves)[1:-1], (neck, high * 1.001)]
        body = flanged_body(t.dn, t.style, length, skin)
        t.add("expansion joint", body, of="rubber" if self.rubber else "trim")
        if self.tied:
            # Ears stand out from the flanges' rims; the rods go through them, between nuts on their outside.
            rim, rod, ear = 0.5 * t.flange.outer, 0.004 + 0.03 * r, 0.7 * thick
            nut, out = 1.6 * rod, rim + 3 * rod
            bar = cylinder(rod, -1.5 * nut, length + 1.5 * nut, 8)
            nuts = [hexagon(3.2 * rod, a, a + nut) for a in (-nut, length)]
            ears = [box((5.5 * rod + 0.006, 6 * rod, ear), (-0.003, 0, z)) for z in (0.5 * ear, length - 0.5 * ear)]
            t.add("stud", about_x(around(merge([bar, *nuts, *ears]), self.rods, out, np.pi / 4)))
        return t.model(round(length, 6))


class WeldedBellows(_Fitting, name="expansion joint/welded"):
    """Metal bellows with plain ends for welding (EN 14917)."""

    waves: int = whole(4, 11, "waves")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style)
        length = 0.3 * self.waves * r + 0.06
        swing = waves(0.03, length - 0.03, 1.0 * r, 1.3 * r + 0.003, self.waves)
        t.add("expansion joint", lathe([(r, 0.0), *swing, (r, length)], n, bore))
        return t.model(round(length, 6), "welded")


class _Strainer(_Fitting, bundle="strainer", grain="structure"):
    """A strainer."""


class FlangedY(_Strainer, name="strainer/Y flanged", sizes=sizes_between(most=200)):
    """A Y strainer, flanged: a slanting branch downward with a bolted lid and a plug in it."""

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.3)
        length, neck = FACE_TO_FACE["globe"][t.dn], 0.485 * t.flange.hub
        low, bulge = plate_thickness(t.dn) + 0.1 * length, max(neck, 1.2 * r + 0.004)
        a, b, lean = low + 0.1 * length, length - low, 0.8
        thin, wide, thick, thread = 0.95 * bulge, 1.25 * bulge, 0.006 + 0.12 * bulge, 0.004 + 0.05 * bulge
        # The lid clears the flange beside it.
        reach = (0.5 * t.flange.outer + 0.005 + wide * np.sin(lean)) / np.cos(lean)
        skin = outline(neck, low, bulge, a, bulge, b - 0.1 * length, neck, b)
        t.add("strainer", flanged_body(t.dn, t.style, length, skin))
        t, seat, top = t.at(0.4 * length).spun("y", np.pi - lean), reach + thick, reach + 2 * thick
        t.add("strainer", turned(outline(thin, 0.0, thin, reach, wide, reach, wide, seat), n))
        t.add("strainer", cylinder(wide, seat, top, n), hexagon(0.5 * bulge, top, top + thick))
        t.add("bolt", bolt_circle(4 if t.dn < 80 else 8, 1.1 * bulge, thread, reach, top))
        return t.model(length)


class ThreadedY(_Strainer, name="strainer/Y threaded", sizes=SMALL):
    """A small Y strainer with hexagon ends and a hexagon plug."""

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.3)
        length, bulge = 4.2 * r + 0.03, 1.25 * r + 0.003
        ends = [hex_end(t.dn, a, b, t.style) for a, b in ((0, 0.22 * length), (0.78 * length, length))]
        middle = along("x", cylinder(bulge, 0.2 * length, 0.8 * length, n))
        t.add("strainer", ends[0], middle, ends[1])
        arm = cylinder(0.95 * bulge, 0.0, 2.9 * bulge, n)
        slant = t.at(0.42 * length).spun("y", np.pi - 0.8)
        slant.add("strainer", arm, hexagon(1.6 * bulge, 2.85 * bulge, 3.4 * bulge))
        return t.model(round(length, 6), "welded")


class Pot(_Strainer, name="strainer/pot"):
    """A basket strainer: an upright pot across the line, a lid on top with bolts (T type)."""

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.9)
        pot, neck = 1.9 * r + 0.02, 0.485 * t.flange.hub
        length, wide = 2 * (pot + plate_thickness(t.dn) + nut_room(t.dn) + 0.01), 1.25 * pot
        body = flanged_body(t.dn, t.style, length, outline(neck, 0.3 * length, neck, 0.7 * length))
        low, high, thick = -2.2 * pot, max(1.1 * pot, 0.5 * t.flange.outer + 0.01), 0.006 + 0.1 * pot
        shell = outline(0.3 * pot, low - 0.3 * pot, 0.85 * pot, low - 0.15 * pot, pot, low, pot, high, wide, high)
        seat, top = high + thick, high + 2 * thick
        t.add("strainer", body, moved(turned([*shell, (wide, seat)], n), at(length / 2)))
        t = t.at(length / 2)
        t.add("strainer", turned(outline(wide, seat, wide, top, 0.5 * pot, top + 0.7 * thick), n))
        t.add("bolt", bolt_circle(8 if t.dn < 150 else 16, 1.13 * pot, 0.003 + 0.05 * pot, high, top))
        return t.model(round(length, 6))


class WeldedCross(_Fitting, name="cross/butt weld", weight=1.5):
    """A butt-welding cross (ASME B16.9), its side mouths of the same or a smaller size, closed by caps or open."""

    other: int = among(lambda p: (p.dn, *below(p.dn, 2)), "nominal size of its side mouths", "mm")
    capped: tuple[bool, ...] = several(yes(0.3), 2, "whether a cap is welded on each side mouth")

    def build(self, t: Table) -> Model:
        pipe, side, reach = t.pipe, PIPES[self.other], TEE_CENTER_TO_END[t.dn]
        ends, branch = (pipe.radius, bore_of(t.dn, t.style)), (side.radius, bore_of(self.other, t.style))
        t.add("cross", crossing(ends, branch, reach, t.style.round_fitting(pipe.radius), _UP_AND_DOWN))
        for s, capped in zip(BOTH, self.capped, strict=True):
            if capped:
                t.at(reach, 0, s * reach).spun("y", -s * np.pi / 2).extend(parts_of(cap(self.other, t.style)))
        return t.model(round(2 * reach, 6), "welded")


class _Forged(_Fitting, sizes=SMALL):
    """A threaded or socket fitting with bands at its mouths (ASME B16.11)."""

    def arms(self, t: Table, through: bool) -> Model:
        """Two mouths in the line and one across it, or two where that goes through."""
        r, n, bore = sized(t.dn, t.style, 1.2)
        reach, turns = 1.6 * r + 0.015, _UP_AND_DOWN[: 1 + through]
        body = crossing((1.15 * r, bore), (1.15 * r, bore), reach, n, turns)
        band = lathe(outline(1.15 * r, 0.6 * reach, 1.3 * r, 0.65 * reach, 1.3 * r, reach), n, 1.1 * r if bore else 0.0)
        ways = [spun("y", -turn) for turn in (0.0, np.pi, *turns)]
        t.add(self.label, body, *(moved(band, at(reach) @ way) for way in ways))
        return t.model(round(2 * reach, 6), "welded")


class ForgedCross(_Forged, name="cross/forged", sizes=SMALL):
    """A threaded or socket cross: a round body with bands at its four mouths (ASME B16.11)."""

    def build(self, t: Table) -> Model:
        return self.arms(t, through=True)


class ForgedTee(_Forged, name="tee/forged", sizes=SMALL, weight=1.5):
    """A threaded or socket tee: three banded mouths."""

    def build(self, t: Table) -> Model:
        return self.arms(t, through=False)


class FlangedTee(_Fitting, name="tee/flanged"):
    """A cast tee with flanges at all three mouths, the third closed by a blind flange or open."""

    closed: bool = chance(0.4, "a blind flange on its branch")

    def build(self, t: Table) -> Model:
        plate, neck, bore = plate_thickness(t.dn), 0.485 * t.flange.hub, bore_of(t.dn, t.style)
        reach = 0.5 * t.flange.outer + plate + nut_room(t.dn) + 0.02
        body = crossing((neck, bore), (neck, bore), reach, t.n(neck), _UP_AND_DOWN[:1])
        rim = flat_flange(t.dn, t.style, reach - plate, plate, 0.99 * neck if bore else 0.0)
        ways = [at(reach) @ spun("y", -turn) for turn in (np.pi, 0.0, np.pi / 2)]
        t.add("tee", body, *(moved(rim, way) for way in ways))
        if self.closed:
            t.extend(counter(t.dn, t.style, ways[2] @ at(reach), blind=True)[0])
        return t.model(round(2 * reach, 6))


def _loft_rounds(path: Floats, radii: Sequence[float], bores: Sequence[float], sides: int) -> Solid:
    """Rounds on a path joined to a skin, hollow where there are bores [m]."""
    shape = circle(1.0, sides)

    def skin(sizes: Sequence[float]) -> list[Floats]:
        return [
            np.column_stack([np.full(sides, p[0]), p[1] + r * shape[:, 0], p[2] + r * shape[:, 1]])
            for p, r in zip(path, sizes, strict=True)
        ]

    return weld([loft([*skin(radii), *skin(bores)[::-1]], closed=True)]) if min(bores) > 0 else lofted(skin(radii))


class _Reducer(_Fitting, sizes=SIZES[2:]):
    """A reducer and, behind a piece of pipe, a second one back."""

    other: int = among(lambda p: below(p.dn, 3), "nominal size between them", "mm")


class Eccentric(_Reducer, name="reducer/eccentric", sizes=SIZES[2:]):
    """An eccentric reducer (ASME B16.9): flat on one side; the run goes on in its first size behind a second one."""

    def build(self, t: Table) -> Model:
        (a, n, wide), length = sized(t.dn, t.style), REDUCER_LENGTH[t.dn]
        b, thin = PIPES[self.other].radius, bore_of(self.other, t.style)
        shares = np.array([0.0, 0.15, 0.4, 0.6, 0.85, 1.0])
        ease = 0.5 - 0.5 * np.cos(np.pi * shares)
        xs = np.concatenate([shares * length, length + 0.06 + (1 - shares[::-1]) * length])
        eases = np.concatenate([ease, ease[::-1]])
        path = np.column_stack([xs, 0 * xs, (b - a) * eases])
        radii, bores, half = list(a + (b - a) * eases), list(wide + (thin - wide) * eases), len(ease)
        for name, cut in (
            ("reducer", slice(half)),
            ("pipe", slice(half - 1, half + 1)),
            ("reducer", slice(half, None)),
        ):
            t.add(name, _loft_rounds(path[cut], radii[cut], bores[cut], n))
        return t.model(round(2 * length + 0.06, 6), "welded")


class Conical(_Reducer, name="reducer/conical", sizes=SIZES[2:]):
    """A conical reducer to a smaller size, a nipple, and a second cone back."""

    def build(self, t: Table) -> Model:
        (a, n, wide), length = sized(t.dn, t.style), REDUCER_LENGTH[t.dn]
        b, thin = PIPES[self.other].radius, bore_of(self.other, t.style)
        x, y = 0.15 * length, 0.85 * length
        skin = outline(a, 0.0, a, x, b, y, b, length)
        inside = outline(thin, length, thin, y, wide, x, wide, 0.0)
        cone = weld([revolve([*skin, *inside], n, closed=True)]) if thin else turned(skin, n)
        t.along("x").add("reducer", cone)
        t.along("x").add("pipe", ring(thin, b, length, length + 0.08, n))
        t.at(2 * length + 0.08).along("-x").add("reducer", cone)
        return t.model(2 * length + 0.08, "welded")


class Spectacle(_Fitting, name="blind flange/spectacle", grain="structure"):
    """A spectacle blind (ASME B16.48): a ring and a disc on one plate, or a spacer with a handle."""

    open: bool = chance(0.5, "what is in the line is bored")
    double: bool = chance(0.6, "its counterpart, a disc or a ring, beside it, not a handle")

    def build(self, t: Table) -> Model:
        size, pipe = t.flange, t.pipe
        outer, thick, n = 0.49 * (size.circle - size.bolt), 0.006 + 0.06 * pipe.radius, t.n(size.circle / 2)
        away = size.circle + 0.01
        solids = [ring(pipe.bore if self.open else 0.0, outer, 0, thick, n)]
        if self.double:
            web = (max(away - 2 * outer, 0.0) + 0.02, 0.36 * outer, 0.008)
            other = ring(0.0 if self.open else pipe.bore, outer, 0, thick, n)
            solids += [box(web, (away / 2, 0, 0.006)), moved(other, at(away))]
        else:
            solids.append(box((0.10, 0.03, thick), (outer + 0.04, 0, thick / 2)))
        t.spun("x", np.pi / 2).add("blind flange", about_x(merge(solids)))
        return t.model(round(thick, 6), "wafer")


class Hanging(_Fitting, name="hose/hanging", place="end", sizes=sizes_between(most=200)):
    """A smooth hose hanging from a pipe's end: a collar, then a curve to the ground."""

    reach: float = between(6, 14, "how far it reaches, less 0.1 m / radius of the pipe")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style)
        reach, s = self.reach * r + 0.1, np.linspace(0, 1, 22)
        path = np.column_stack([0.03 + reach * s, 0.3 * reach * np.sin(2.5 * s) * s, -0.5 * reach * s**2])
        skin = tube(np.vstack([[0.0, 0.0, 0.0], path]), 1.1 * r, 0.85 * r if t.style.hollow else 0.0, n)
        t.add("hose", skin)
        collar = hexagon(2.7 * r, 0.02, 0.035 + 0.2 * r)
        t.along("x").add("coupling", ring(bore, 1.3 * r, 0.0, 0.02, n), collar, of="trim")
        return t.model()


class Elbow(_Fitting, name="elbow/end", place="end", weight=4):
    """An elbow on a pipe's end: 45, 90 or 180 degrees, short or long or 3D radius, or mitred; then a piece of pipe."""

    radius: float = among((1.0, 1.0, 1.5, 3.0), "of the bend / diameter of the pipe")
    turn: float = among((0.25, 0.5, 0.5, 1.0), "of the bend / half a turn")
    roll: float = among(QUARTERS, ROLL)
    mitred: bool = chance(0.3, "cut and welded of pipe")
    cuts: int = whole(2, 4, "mitres", when=lambda p: p.mitred)
    tail: float = between(1, 5, "length of the pipe behind it / its diameter")

    def build(self, t: Table) -> Model:
        (r, n, bore), turn = sized(t.dn, t.style), self.turn * np.pi
        radius, steps = self.radius * t.pipe.outer, self.cuts if self.mitred else max(4, round(n * turn / 6))
        angles = np.linspace(0, turn, steps + 1)
        if self.mitred:
            mids, far = (angles[:-1] + angles[1:]) / 2, radius / np.cos(turn / steps / 2)
            corners = np.column_stack([far * np.sin(mids), radius - far * np.cos(mids)])
            path = np.vstack([[0, 0], corners, [radius * np.sin(turn), radius * (1 - np.cos(turn))]])
        else:
            path = np.column_stack([radius * np.sin(angles), radius * (1 - np.cos(angles))])
        points = np.column_stack([path, np.zeros(len(path))])
        end = points[-1] + np.array([np.cos(turn), np.sin(turn), 0.0]) * self.tail * t.pipe.outer
        t = t.spun("x", self.roll * np.pi)
        t.add("elbow", tube(points, r, bore, n))
        t.add("pipe", tube(np.vstack([points[-1], end]), r, bore, n))
        return t.model()


class ForgedElbow(_Fitting, name="elbow/forged", place="end", sizes=SMALL, weight=2):
    """A threaded or socket elbow with banded mouths on a pipe's end (ASME B16.11), and a plug or a nipple in it."""

    roll: float = among(QUARTERS, ROLL)
    plugged: bool = chance(0.3, "a plug in it, not a nipple")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.2)
        reach, a, b = 1.6 * r + 0.015, 1.3 * r, 1.15 * r
        path, _ = bend_path(1.1 * b, np.pi / 2, t.style.bend(2 * b), reach - 1.1 * b)
        band = lathe(outline(b, 0.55 * reach, a, 0.6 * reach, a, reach), n, 1.1 * r if bore else 0.0)
        t = t.spun("x", self.roll * np.pi)
        ways = [at(reach) @ spun("z", turn) for turn in (np.pi, np.pi / 2)]
        t.add("elbow", tube(path, b, bore, n), *(moved(band, way) for way in ways))
        t = t.at(reach).along("y")
        if self.plugged:
            head = hexagon(2.0 * r, reach, reach + 0.5 * r + 0.006)
            t.add("pipe cap", cylinder(0.95 * r, 0.7 * reach, reach, n), head)
        else:
            t.add("nipple", ring(bore, r, reach, reach + 0.1 + 2 * r, n))
        return t.model()


class ThreadedCap(_Fitting, name="pipe cap/threaded", place="end", sizes=SMALL):
    """A threaded cap: a round or hexagonal cup over a pipe's end."""

    flats: bool = chance(0.5, "hexagonal, not round")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.2)
        length, wide = 1.0 * r + 0.014, 1.25 * r + 0.002
        cup = turned(outline(wide, 0.0, wide, 0.8 * length, 0.9 * r, length), n)
        t.along("x").add("pipe cap", hexagon(2.5 * r + 0.004, 0, length) if self.flats else cup)
        return t.model()


class Outlet(_Fitting, name="branch outlet/olet", place="tap"):
    """A branch outlet with a pipe: a forged olet's cone, a nipple, and a cap, a flange or nothing on it."""

    size: int = among((15, 20, 25), "nominal size of the outlet", "mm")
    tall: float = between(0.05, 0.2, "length of the pipe on it", "m")
    end: str = among(("cap", "flange", "open"), "what is on that pipe")

    def build(self, t: Table) -> Model:
        (r, n, bore), plate = sized(self.size, t.style), plate_thickness(self.size) + 0.002
        rise = 1.0 * r + 0.012
        top = rise + self.tall
        t.add("branch outlet", turned(outline(1.5 * r, -0.004, 1.5 * r, 0.25 * rise, 1.05 * r, rise), n))
        t.add("nipple", ring(bore, r, rise, top, n))
        if self.end == "cap":
            t.add("pipe cap", hexagon(2.6 * r, top, top + r + 0.01))
        elif self.end == "flange":
            t.at(0, 0, top + plate).spun("x", np.pi).add("flange", disc_flange(self.size, t.style, plate, bore))
        return t.model()


class Blind(_Fitting, name="blind flange/disc", place="head", bundle="blind flange", grain="structure"):
    """A blind flange: plain disc or drilled, sometimes with a lifting eye, on a flanged end."""

    drilled: bool = chance(0.5, "has bolt holes, as far as the style drills any")
    thick: float = between(0.8, 1.4, "thickness of a plain one / of a drilled one", when=lambda p: not p.drilled)
    eyed: bool = chance(0.3, "a lifting eye on it")

    def build(self, t: Table) -> Model:
        radius, plate = t.flange.outer / 2, plate_thickness(t.dn)
        disc = (
            cylinder(radius, 0.0, self.thick * plate, t.n(radius))
            if not self.drilled
            else disc_flange(t.dn, t.style, plate)
        )
        t.add("blind flange", about_x(disc))
        if self.eyed:
            eye, face = 0.012 + 0.1 * t.pipe.radius, plate if self.drilled else self.thick * plate
            bow = moved(torus(eye, 0.22 * eye, 14), spun("x", np.pi / 2))
            t.at(face + eye).add("lifting lug", bow, of="fastener", own=True, fine=True)
        return t.model()


FITTINGS = families_of(
    Sleeve, Union, Nipple, FlangedBellows, WeldedBellows, FlangedY, ThreadedY, Pot, WeldedCross, ForgedCross, ForgedTee,
    FlangedTee, Eccentric, Conical, Spectacle, Hanging, Elbow, ForgedElbow, ThreadedCap, Outlet, Blind,
)  # fmt: skip
