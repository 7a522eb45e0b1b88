"""Small and light ball valves: sanitary, plastic, multi-port, blocks, cut open."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import Params, among, between, chance, nested, styled
from cadplants.builder.table import Table, outline
from cadplants.families.valves.actuation import operator
from cadplants.families.valves.actuation_base import put_stem
from cadplants.families.valves.actuation_hand import Handlever, Handwheel, levers, slab, span
from cadplants.families.valves.ball import BallInside, ClampedEnds, StemTop, ferrule
from cadplants.families.valves.base import (
    HOLLOW,
)
from cadplants.families.valves.body import Packing, neck_of, part_turned, valve_ball
from cadplants.families.valves.threaded import hex_end
from cadplants.families.valves.valve import Valve
from cadplants.model.family import Model
from cadplants.model.standards import FACE_TO_FACE, sizes_between
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, about_x, merge, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, ball, box, cylinder, hexagon, ring
from cadplants.solids.transforms import at, spun

__all__ = ["UNIONS"]


class _Ball(Valve):
    """A ball valve that is welded or screwed into its line."""

    hollow: bool = styled(True, HOLLOW)

    def done(self, t: Table, length: float, kind: str = "ball valve") -> Model:
        """What was put down, as a valve in a line."""
        return t.model(round(length, 6), "welded", kind)


class Sanitary(_Ball, name="ball valve/sanitary clamp", sizes=sizes_between(15, 100)):
    """A sanitary three-piece ball valve with clamp ends, ferrules of the pipe and their clamps; a lever or actuator."""

    square: bool = chance(0.5, "its middle is held between square plates, not round ones")
    clamps: ClampedEnds = nested(ClampedEnds, "clamps at both ends")
    top: StemTop = nested(StemTop, "neck of the stem")
    ball: BallInside = nested(BallInside, "ball and seats", when=lambda p: p.hollow)
    operator: Any = operator("lever", "lever", "vertical", "rack", "motor box")

    def build(self, t: Table) -> Model:
        r, stub, big, half = t.pipe.radius, 0.03, 1.55 * t.pipe.radius + 0.008, 0.9 * t.pipe.radius + 0.008
        x = (3.6 * r + 0.06) / 2 + stub
        n, up = t.n(big, 16), t.at(x)
        hole = (circle(0.95 * r, n),) if self.hollow else ()
        plate = rounded_rectangle(2 * big, 2 * big, 0.4 * big, 4) if self.square else circle(1.15 * big, n)
        solids = [ferrule(t.dn, stub, x - half, t.style, True), ferrule(t.dn, x + half, 2 * x - stub, t.style, False)]
        for s in BOTH:
            solids.append(along("x", slab(plate, *span(x + s * (half - 0.012), x + s * (half + 0.002)), hole)))
        solids.append(along("x", slab(circle(1.3 * r + 0.006, n), x - half + 0.01, x + half - 0.01, hole)))
        t.add("valve body", *solids, of="clamp")
        bolt = [cylinder(0.004, -half - 0.006, half + 0.006, 8), hexagon(0.012, half + 0.002, half + 0.008)]
        bolts = around(merge(bolt), 4, (1.18 if len(plate) < 24 else 1.0) * big, np.pi / 4)
        up.add("bolt", about_x(bolts))
        self.clamps.build(t, t.dn, stub, 2 * x)
        self.top.build(up, 1.1 * r, 1.3 * big + 0.01, r)
        if self.ball:
            self.ball.build(up, t.dn)
        self.operator.build(up.at(0, 0, 1.3 * big + 0.014 + 0.2 * r))
        return self.done(t, 2 * x)


class _UnionNut(Params):
    """A plastic union nut with fluted or ribbed sides."""

    ribs: int = among((8, 12, 16), "round the nut")

    def solid(self, radius: float, low: float, high: float, inner: float) -> Solid:
        """The nut about z, between two heights [m]."""
        turns = np.arange(4 * self.ribs) * 2 * np.pi / (4 * self.ribs)
        reach = radius * (1 + 0.05 * np.sign(np.cos(self.ribs * turns + 0.3)))
        return slab(np.column_stack([reach * np.cos(turns), reach * np.sin(turns)]), low, high, (circle(inner, 24),))


class TrueUnion(_Ball, name="ball valve/true union", sizes=sizes_between(15, 100)):
    """A plastic true-union ball valve: socket ends, two union nuts, a tee or wing handle, maybe feet (EN ISO 16135)."""

    nut: float = between(0.8, 1.1, "length of a union nut / radius of the pipe")
    first: _UnionNut = nested(_UnionNut, "union nut of the inlet")
    second: _UnionNut = nested(_UnionNut, "union nut of the outlet")
    footed: bool = chance(0.4, "a foot under it")
    ball: BallInside = nested(BallInside, "ball and seats", when=lambda p: p.hollow)
    by_hand: bool = chance(0.75, "a handle rather than an actuator")
    handle: Handlever = nested(levers("tee", "tee", "wing", "notched"), "lever", when=lambda p: p.by_hand)
    operator: Any = operator("rack", "motor box", when=lambda p: not p.by_hand)

    def build(self, t: Table) -> Model:
        r, x, big = t.pipe.radius, 2.3 * t.pipe.radius + 0.035, 1.55 * t.pipe.radius + 0.010
        n, inner, nut, up = t.n(big, 16), r if self.hollow else 0.0, self.nut * r + 0.012, t.at(x)
        tower, high, half = 0.55 * r + 0.007, big + 0.35 * r + 0.008, 0.95 * r + 0.006
        neck = slab(rounded_rectangle(2.2 * tower, 2 * tower, 0.5 * tower, 3), 0.85 * big, high)
        foot = [box((1.4 * r, 1.2 * big, 0.3 * big), (0, 0, -1.05 * big))] if self.footed else []
        up.add("valve body", along("x", ring(0.9 * inner, big, -half, half, n)), neck, *foot)
        for s, one in zip(BOTH, (self.first, self.second), strict=True):
            start = s * (0.95 * r + 0.004)
            up.along("x").add("valve body", ring(inner, 1.28 * r + 0.002, *span(s * x, start), n))
            solid = one.solid(1.22 * big, *span(start, start + s * nut), 1.3 * r + 0.002)
            up.along("x").add("union", solid, of="valve", own=True)
        if self.ball:
            self.ball.build(up, t.dn)
        up = up.at(0, 0, high)
        put_stem(up, -0.01, 0.012, 0.6 * tower)
        if self.by_hand:
            self.handle.build(up, 0.05 + 2.2 * r, 0.003)
        else:
            self.operator.build(up.at(0, 0, 0.006))
        return self.done(t, 2 * x)


class MultiPort(_Ball, name="ball valve/multi-port", sizes=sizes_between(15, 50)):
    """A three- or four-way threaded ball valve (L or T bore): a cube or barrel with hexagon ends, lever above."""

    one_side: bool = chance(0.5, "a third way to one side")
    both_sides: bool = chance(0.4, "a third and a fourth way", when=lambda p: not p.one_side)
    cube: bool = chance(0.5, "its middle is a cube, not a ball")
    collared: bool = chance(0.4, "collars at its ends")
    top: StemTop = nested(StemTop, "neck of the stem")
    operator: Any = operator("lever", "lever", "rack", "motor box")

    def build(self, t: Table) -> Model:
        r, length, big = t.pipe.radius, 0.04 + 4.0 * t.pipe.radius, 1.4 * t.pipe.radius + 0.008
        x, n, end, high = length / 2, t.n(big, 16), 0.24 * length, 1.25 * big + 0.008
        side = moved(hex_end(t.dn, 0.0, 1.05 * end + 0.3 * big, t.style), at(-x))
        turns = (1.5,) if self.one_side else (1.5, 0.5) if self.both_sides else (0.5,)
        solids = [
            hex_end(t.dn, 0.0, end + 0.2 * big, t.style),
            hex_end(t.dn, length - end - 0.2 * big, length, t.style),
        ]
        solids += [moved(side, at(x) @ spun("z", f * np.pi)) for f in turns]
        cube = slab(rounded_rectangle(2 * big, 2 * big, 0.25 * big, 3), -big, big)
        solids.append(moved(cube if self.cube else ball(1.2 * big, n), at(x)))
        if self.collared:
            collar = circle(1.15 * big, 8, phase=np.pi / 8)
            solids += [along("x", slab(collar, *span(x + s * big, x + s * (big + 0.006)))) for s in BOTH]
        t.add("valve body", *solids)
        self.top.build(t.at(x), 0.9 * big, high, r)
        self.operator.build(t.at(x, 0, high + 0.004 + 0.2 * r))
        return self.done(t, length, "three-way valve")


class CutOpen(Valve, name="ball valve/cut open", sizes=sizes_between(15, 150)):
    """A ball valve cut open for show: part of the body away, polished ball, seats, stem and lever in sight."""

    lip: float = between(1.0, 1.2, "radius of the joint / of the body")
    gap: float = between(0.4, 0.7, "share of half a turn that is cut away")
    turn: float = among((0.0, 0.0, np.pi / 4, np.pi / 2), "of the ball from open", "rad")
    levered: bool = chance(0.8, "a lever rather than a wheel")
    lever: Handlever = nested(Handlever, "lever", when=lambda p: p.levered)
    wheel: Handwheel = nested(Handwheel, "handwheel", when=lambda p: not p.levered)

    def build(self, t: Table) -> Model:
        r, bore, rim, length = t.pipe.radius, t.pipe.bore, t.flange.outer / 2, FACE_TO_FACE["ball"][t.dn]
        x, big, (neck, back) = length / 2, 1.75 * r + 0.01, neck_of(t.dn)
        n, lip, far = max(8, t.n(big) * 3 // 4), self.lip * big, length - back
        outer = outline(rim, 0.0, rim, back, neck, back, big, 0.3 * length, lip, 0.32 * length, lip, 0.4 * length)
        outer += outline(big, 0.42 * length, big, 0.7 * length, neck, far, rim, far, rim, length)
        reach, hollow = min(1.3 * bore, 0.3 * length), min(1.5 * bore, 0.93 * big)
        inner = outline(
            bore, length, bore, x + reach, hollow, x + 0.8 * reach, hollow, x - 0.8 * reach, bore, x - reach
        )
        open_ = 0.5 * self.gap * np.pi
        shape = np.array([*outer, *inner, (bore, 0.0)])
        t.add("valve body", about_x(part_turned(shape, 0.85 * np.pi + open_, 2.85 * np.pi - open_, n)))
        up, size, boss = t.at(x), 1.42 * bore * 0.98, 0.35 * r + 0.008
        high, inside = max(1.3 * big, rim) + 0.01, float(np.sqrt(size**2 - (1.1 * bore) ** 2))
        up.add("valve body", ring(0.5 * boss, boss, 0.93 * big, high, 16))
        put_stem(up, 0.95 * size, high + 1.2 * boss + 0.012, 0.45 * boss)
        Packing(form="nut", turn=0.0).build(up.at(0, 0, high - 0.001), 0.45 * boss)
        up.add("valve ball", valve_ball(size, bore, t.style, self.turn))
        for low in (inside, -inside - 0.15 * bore):
            seat = ring(1.02 * bore, 1.2 * bore, low, low + 0.15 * bore, max(16, n))
            up.along("x").add("gasket", seat, of="rubber", own=True)
        up = up.at(0, 0, high + 1.2 * boss)
        if self.levered:
            self.lever.build(up, 0.1 + 2.2 * r)
        else:
            self.wheel.build(up, 0.05 + r)
        return t.model(length, kind="ball valve")


class Block(_Ball, name="ball valve/block", sizes=sizes_between(15, 50)):
    """A high-pressure block ball valve of hydraulics: a square steel block, screwed-in hexagon ends, a bent lever."""

    lever: Handlever = nested(levers("bar", "sheet", "tee", "sheet"), "lever")
    ball: BallInside = nested(BallInside, "ball and seats", when=lambda p: p.hollow)

    def build(self, t: Table) -> Model:
        r, block, end = t.pipe.radius, 2.4 * t.pipe.radius + 0.02, 1.1 * t.pipe.radius + 0.012
        length, bore, half, flats = block + 2 * end, bore_of(t.dn, t.style), 1.35 * r + 0.006, 2.5 * r
        up, stub = t.at(length / 2), along("x", ring(bore, 1.15 * r, 0.0, end, 16))
        solids = [along("x", slab(rounded_rectangle(2 * half, 2 * half, 0.08 * half, 2), end, end + block)), stub]
        solids.append(along("x", hexagon(flats, 0.5 * end, end, bore, 16)))
        solids.append(moved(stub, at(length - end)))
        solids.append(along("x", hexagon(flats, 0.0, 0.5 * end, bore, 16), length - end))
        hole = ring(0.004, 0.007, -half - 0.001, half + 0.001, 10)
        t.add("valve body", *solids, along("y", hole, length / 2 - 0.3 * block, 0, -0.7 * half))
        up.add("gland", hexagon(1.0 * half, half - 0.001, half + 0.006))
        put_stem(up, half - 0.01, half + 0.02, 0.3 * half)
        self.lever.build(up, 0.09 + 2.4 * r, half + 0.007)
        up.add("valve body", moved(cylinder(0.004, half, half + 0.012, 8), at(0.7 * half, 0.5 * half)))
        if self.ball:
            self.ball.build(up, t.dn)
        return self.done(t, length)


UNIONS = families_of(Sanitary, TrueUnion, MultiPort, CutOpen, Block)
