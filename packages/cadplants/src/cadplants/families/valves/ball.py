"""Ball valves of further makes: trunnion, top entry, welded, segment, wafer, sanitary, true union, cut open."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import number
from cadplants.builder.params import Params, among, between, chance, nested, several, styled
from cadplants.builder.table import Table, outline
from cadplants.families.valves.actuation import operator
from cadplants.families.valves.actuation_base import put_stem
from cadplants.families.valves.actuation_hand import slab, span
from cadplants.families.valves.body import (
    Packing,
    bolts_on,
    ended,
    lid_joint,
    neck_of,
    packings,
    part_turned,
    plate_outline,
    room,
    valve_ball,
)
from cadplants.families.valves.valve import Valve
from cadplants.model.family import Model
from cadplants.model.standards import FACE_TO_FACE, PIPES, sizes_between
from cadplants.solids.mesh_ops import Solid, about_x, merge, moved, revolve, weld
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, hexagon, ring, rod, turned
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = [
    "BALLS", "BallInside", "ClampedEnds", "StemTop", "ferrule", "part_ring",
]  # fmt: skip

_TURNS = (0.0, 0.0, np.pi / 4, np.pi / 2)
_ABOUT_TURN = "of its ball, from open"


class BallInside(Params):
    """A ball and its two seats."""

    size: float = between(1.4, 1.6, "radius of the ball / of its bore")
    turn: float = among(_TURNS, _ABOUT_TURN, "rad")

    def build(self, t: Table, dn: int, trunnions: float = 0.0) -> None:
        """Puts it down for a nominal size; ``trunnions``: how far its stubs reach [m]."""
        bore, style = 0.9 * PIPES[dn].bore, t.style
        big = bore * self.size
        t.add("valve ball", valve_ball(big, bore, style, self.turn, trunnions))
        seat = along("x", ring(1.03 * bore, 1.25 * bore, 0.0, 0.16 * bore, max(16, style.round(bore))))
        far = float(np.sqrt(big**2 - (1.14 * bore) ** 2))
        for x in (far, -far - 0.16 * bore):
            t.add("gasket", moved(seat, at(x)), of="rubber", own=True)


class StemTop(Params):
    """A stem neck with a mounting pad (ISO 5211) round, square or none, its gland and its stem."""

    pad: str = among(("round", "square", "octagon", "none"), "its mounting pad")
    smooth: bool = chance(0.5, "its gland is round, not hexagonal")

    def build(self, t: Table, low: float, high: float, radius: float) -> None:
        """Puts it down between two heights, for a pipe of a radius [m]."""
        boss = 0.4 * radius + 0.007
        n, solids = t.n(boss, 12), []
        if self.pad != "none":
            edge, under = plate_outline(self.pad, 2.0 * boss, 2.0 * boss, n), high - 0.004 - 0.06 * radius
            solids.append(slab(edge, under, high))
            t.extend([bolts_on(edge, 4, under, high + 0.001, 0.004 + 0.03 * radius)])
        t.add("valve body", cylinder(boss, low, high, n), *solids)
        put_stem(t, high - 0.003, high + 0.5 * boss + 0.004, 0.5 * boss)
        nut = hexagon(1.5 * boss, high, high + 0.3 * boss)
        t.add("gland", cylinder(0.8 * boss, high, high + 0.25 * boss, n) if self.smooth else nut)


class _Ball(Valve):
    """A ball valve."""

    hollow: bool = styled(True, "whether insides are modelled")

    def put_top(self, t: Table, low: float, high: float, radius: float, trunnions: float = 0.0) -> None:
        """Puts down the top of its stem, and its ball where there is one [m]."""
        self.top.build(t, low, high, radius)  # type: ignore[attr-defined]
        if self.hollow:
            self.ball.build(t, self.dn, trunnions)  # type: ignore[attr-defined]


def _inside() -> Any:
    return nested(BallInside, "ball inside", when=lambda p: p.hollow)


_HEAVY = ("worm", "worm", "scotch", "rack", "electrohydraulic", "multi-turn", "lever", "bevel")


class Trunnion(_Ball, name="ball valve/trunnion", sizes=sizes_between(50)):
    """A trunnion ball valve in three bolted pieces: barrel, two end adapters, trunnion cap, drain, vent (API 6D)."""

    long: float = between(1.05, 1.25, "length / of other ball valves")
    lip: float = between(1.12, 1.28, "radius of its bolted flanges / of the barrel")
    swollen: bool = chance(0.4, "its barrel swells between the flanges")
    footed: bool = chance(0.4, "two feet below it")
    top: StemTop = nested(StemTop, "top of its stem")
    ball: BallInside = _inside()
    covered: bool = chance(0.5, "a cover round its stem's neck")
    operator: Any = operator(*_HEAVY)

    def build(self, t: Table) -> Model:
        radius, size = self.radius, t.flange
        length = FACE_TO_FACE["ball"][self.dn] * self.long
        neck, back = neck_of(self.dn)
        x, big = length / 2, max(1.75 * radius + 0.012, 0.5 * size.circle * 0.9)
        n = t.n(big, 16, 48)
        half, lip, split = min(1.3 * radius, x - back - 0.035), self.lip * big, 0.012 + 0.08 * radius
        start, slope = x - half - split, 0.3 * (x - half - back)
        middle = outline(neck, back, neck, back + slope, 0.9 * big, start, 0.9 * big, length - start)
        middle += outline(neck, length - back - slope, neck, length - back)
        a, b = x - half, x + half
        barrel = outline(lip, a, lip, a + split, big, a + split, big, b - split, lip, b - split, lip, b)
        if self.swollen:
            barrel = outline(lip, a, 1.03 * lip, x, lip, b)
        rims = [cylinder(lip, *span(x + s * half, x + s * (half + split)), n) for s in BOTH]
        cap = [cylinder(0.55 * big, -1.15 * big, -0.8 * big, n), cylinder(0.7 * big, -1.25 * big, -1.13 * big, n)]
        drain = hexagon(0.024, 0.9 * big, 1.1 * big)
        below = merge([*cap, *(along("y", drain, 0, 0, s * 0.4 * big) for s in BOTH)])
        solids = [ended(self.dn, t.style, length, middle, "flanged"), moved(below, at(x)), *map(about_x, rims)]
        if self.footed:
            foot = (0.4 * half, 1.5 * big, 0.5 * big)
            solids += [box(foot, (x + s * 0.6 * half, 0, -1.15 * big)) for s in BOTH]
        t.add("valve body", *solids)
        t.add("valve body", about_x(turned(barrel, n)))
        far, nut = 1.6 * split, 0.02 + 0.05 * radius
        bolt = [cylinder(0.09 * split + 0.004, a - far, b + far, 8)]
        bolt += [hexagon(nut, *span(x + s * (half + split), x + s * (half + far))) for s in BOTH]
        t.add("bolt", about_x(around(merge(bolt), max(6, min(10, 2 * int(np.pi * lip / 0.05))), 0.9 * lip)))
        high, t = max(1.35 * big, 0.5 * size.outer) + 0.03, t.at(x)
        self.put_top(t, 0.8 * big, high, 1.4 * radius, 1.5 * radius)
        if self.covered:
            hood, rim = 0.6 * big, 0.75 * big
            side = outline(hood, 0.9 * big, hood, high - 0.02, rim, high - 0.02, rim, high - 0.001)
            t.add("valve bonnet", turned(side, n))
        self.operator.build(t.at(0, 0, high + 0.004 + 0.28 * radius))
        return t.model(round(length, 6), kind="ball valve")


class TopEntry(_Ball, name="ball valve/top entry"):
    """A top-entry ball valve: a one-piece cast body, the ball goes in from above under a large bolted bonnet."""

    ends: str = among(("flanged", "flanged", "butt"), "its ends, butts welded in")
    wide: float = between(1.1, 1.3, "radius of its bonnet / of the body")
    plate: str = among(("round", "round", "octagon", "square"), "outline of its bonnet")
    top: StemTop = nested(StemTop, "top of its stem")
    ball: BallInside = _inside()
    operator: Any = operator(*_HEAVY)

    def build(self, t: Table) -> Model:
        radius, flanged = self.radius, self.ends == "flanged"
        length = FACE_TO_FACE["ball"][self.dn] * (1.1 if flanged else 1.0)
        x, big = length / 2, 1.6 * radius + 0.012
        n = t.n(big, 16)
        neck, back = neck_of(self.dn) if flanged else (1.1 * radius, 0.1 * length)
        reach = 0.5 * length - back - 0.05 * length
        shares = np.linspace(-1, 1, 9)
        middle = [(neck + (big - neck) * float(np.sqrt(1 - s * s)), x + float(s) * reach) for s in shares]
        seat, plate = max(1.2 * big, 0.9 * room(self.dn) if flanged else 0.0), 0.012 + 0.12 * radius
        half = self.wide * big
        collar, lid, bolts = lid_joint(self.plate, half, half, seat, plate, t.style)
        tower = moved(merge([turned(outline(0.9 * big, 0, 0.95 * big, seat - 0.003), n), collar]), at(x))
        t.add("valve body", ended(self.dn, t.style, length, middle, self.ends), tower)
        high, t = seat + 2.6 * plate, t.at(x)
        hood = outline(0.85 * half, seat + plate - 0.002, 0.6 * half, seat + 1.6 * plate, 0.45 * half, high)
        t.add("valve bonnet", lid, turned(hood, n))
        t.extend([bolts])
        self.put_top(t, high - 0.01, high + 0.02 + 0.2 * radius, radius)
        self.operator.build(t.at(0, 0, high + 0.024 + 0.4 * radius))
        return t.model(round(length, 6), "flanged" if flanged else "welded", "ball valve")


class FullyWelded(_Ball, name="ball valve/fully welded"):
    """A fully welded pipeline ball valve: a sphere or drum with weld seams, extended stem, vent pipes (EN 14141)."""

    big: float = between(1.55, 1.9, "radius of its body / of the pipe")
    sphere: bool = chance(0.5, "its body is a sphere, not a drum")
    extended: bool = chance(0.6, "its stem is extended")
    reach: float = between(0.25, 0.9, "of the extended stem from the body", "m", when=lambda p: p.extended)
    ball: BallInside = _inside()
    operator: Any = operator("lever", "worm", "bevel", "multi-turn", "scotch", "worm")

    def build(self, t: Table) -> Model:
        radius = self.radius
        x, big = 0.05 + 2.6 * radius, self.big * radius + 0.006
        length, n = 2 * x, t.n(big, 16)
        if self.sphere:
            middle = [(big * float(np.sqrt(1 - s * s)), x + big * float(s)) for s in np.linspace(-0.86, 0.86, 11)]
            if middle[0][0] > 1.05 * radius:
                far, end = 1.35 * big * 0.86, 1.02 * radius
                middle = [(end, x - far), *middle, (end, x + far)]
        else:
            half, end = 1.2 * radius, 1.05 * radius
            middle = outline(end, x - half - 0.6 * radius, big, x - half, big, x + half, end, x + half + 0.6 * radius)
        places = [x + s * 0.5 * radius for s in BOTH]
        seams = [about_x(ring(0.9 * big, big + 0.003, z - 0.004, z + 0.004, n)) for z in places]
        t.add("valve body", ended(self.dn, t.style, length, middle, "butt"), *seams)
        reach = big + (self.reach if self.extended else 0.05 + 0.5 * radius)
        boss, t = 0.5 * radius + 0.008, t.at(x)
        rim, low = 1.9 * boss, reach - 0.012
        tube = outline(1.3 * boss, 0.85 * big, boss, big + 0.02, boss, low, rim, low, rim, reach)
        t.add("valve bonnet", turned(tube, n))
        if reach > big + 0.2:
            vents, low = [], reach - 0.09
            for side in (s * (boss + 0.02) for s in BOTH):
                vents.append(rod((side, 0, 0.8 * big), (side, 0, low), 0.007, 8))
                vents.append(
                    moved(merge([hexagon(0.024, 0.0, 0.04), cylinder(0.009, 0.0, 0.055, 8)]), at(side, 0, low))
                )
            t.add("valve body", *vents, box((2 * boss + 0.04, 0.012, 0.005), (0, 0, 0.5 * (big + reach))))
        put_stem(t, reach - 0.002, reach + 0.02, 0.4 * boss)
        if self.hollow:
            self.ball.build(t, self.dn)
        self.operator.build(t.at(0, 0, reach + 0.012))
        return t.model(round(length, 6), "welded", "ball valve")


class Segment(_Ball, name="ball valve/segment", sizes=sizes_between(25)):
    """A V-segment control ball valve: a short body, flangeless or flanged, shaft off the middle, an actuator."""

    flanged: bool = chance(0.4, "it has flanges where there is room for them")
    pad: str = among(("square", "round", "oval"), "its mounting pad")
    gland: Packing = nested(packings("oval follower", "round follower"), "gland")
    turn: float = among(_TURNS, _ABOUT_TURN, "rad", when=lambda p: p.hollow, otherwise=0.0)
    operator: Any = operator("rack", "scotch", "motor box", "electrohydraulic", "worm")

    def build(self, t: Table) -> Model:
        radius, size, bore = self.radius, t.flange, t.pipe.bore
        length, outer = 0.08 + 1.7 * radius, 0.49 * (size.circle - size.bolt)
        x, n = 0.5 * length, t.n(outer, 16)
        neck, back = neck_of(self.dn)
        flanged = self.flanged and length > 2.6 * back + 0.03
        if flanged:
            middle = outline(neck, back, 1.15 * neck, x, neck, length - back)
            body = ended(self.dn, t.style, length, middle, "flanged")
        else:
            waist = max(0.85 * outer, 1.25 * radius)
            side = [(bore, 0), (outer, 0), (outer, 0.14), (waist, 0.2), (waist, 0.8), (outer, 0.86), (outer, 1)]
            body = about_x(part_ring([*((r, z * length) for r, z in side), (bore, length)], n))
        boss, high = 0.3 * radius + 0.012, max(0.5 * size.outer, outer) + 0.035
        post = [turned(outline(1.2 * boss, 0.8 * radius, boss, outer, boss, high - 0.012), 16)]
        post.append(cylinder(0.9 * boss, -outer - 0.02, -0.8 * radius, 16))
        post.append(slab(plate_outline(self.pad, 1.9 * boss, 2.2 * boss, 16), high - 0.013, high))
        t.add("valve body", body, moved(merge(post), at(x)))
        t = t.at(x)
        screws = around(hexagon(0.012, -outer - 0.038, -outer - 0.03), 4, 0.9 * boss)
        t.add("valve bonnet", cylinder(1.2 * boss, -outer - 0.032, -outer - 0.02, 16), screws)
        self.gland.build(t.at(0, 0, high), 0.35 * boss)
        put_stem(t.at(0, 0, high), -0.1 * radius, 0.05, 0.35 * boss)
        if self.hollow:
            big, a = 1.12 * bore, np.linspace(-0.75, 0.75, 9)
            arc = np.column_stack([np.cos(a), np.sin(a)]) * big
            cup = part_turned(np.vstack([arc, 0.85 * arc[::-1]]), -0.8, 0.8, 8)
            pins = [cylinder(0.3 * boss, *span(s * 0.55 * big, s * 1.05 * big), 10) for s in BOTH]
            t.add("valve ball", moved(cup, spun("z", self.turn)), *pins)
        self.operator.build(t.at(0, 0, high + 0.02))
        return t.model(round(length, 6), "flanged" if flanged else "wafer", "control valve")


class WaferBall(_Ball, name="ball valve/wafer", sizes=sizes_between(most=150)):
    """A compact wafer ball valve between two flanges: a round or lugged disc barely longer than its ball (DIN 3357)."""

    long: float = between(2.4, 2.8, "length / radius of the pipe")
    form: str = among(("round", "stepped", "lugged"), "form of its body")
    top: StemTop = nested(StemTop, "top of its stem")
    ball: BallInside = _inside()
    operator: Any = operator("lever", "lever", "rack", "motor box")

    def build(self, t: Table) -> Model:
        radius, size, bore = self.radius, t.flange, 0.95 * t.pipe.bore
        length, outer = max(0.042, self.long * radius + 0.012), 0.49 * (size.circle - size.bolt)
        n, step = t.n(outer, 16), 0.75 * outer
        side = outline(bore, 0, outer, 0, outer, length, bore, length)
        if self.form == "stepped":
            side = outline(bore, 0, step, 0, step, 0.12, outer, 0.2, outer, 0.8, step, 0.88, step, 1, bore, 1)
            side = [(r, z * length) for r, z in side]
        shell = [part_ring(side, n)]
        if self.form == "lugged":
            lug = ring(0.5 * size.bolt, 0.95 * size.bolt, 0.0, length, 10)
            shell.append(around(lug, size.n_bolts, size.circle / 2, np.pi / size.n_bolts))
        t.add("valve body", *map(about_x, shell))
        low, rim, start = 1.02 * bore, 0.6 * outer + 0.4 * bore, length - 0.004
        insert = part_ring(outline(low, 0, rim, 0, rim, 0.004, low, 0.004), n)
        t.add("valve body", moved(about_x(insert), at(start)), of="trim")
        high, t = 0.5 * size.outer + 0.012, t.at(length / 2)
        self.put_top(t, 0.95 * bore, high, 0.8 * radius)
        self.operator.build(t.at(0, 0, high + 0.004 + 0.16 * radius))
        return t.model(round(length, 6), "wafer", "ball valve")


class SplitBody(_Ball, name="ball valve/split body", weight=1.5):
    """A split-body floating ball valve: a long and a short half bolted off the middle, any joint (ISO 17292)."""

    middle: float = between(0.42, 0.48, "where its stem is / length")
    form: str = among(("round", "square", "octagon", "oval"), "outline of the joint's flanges")
    bolts: int = among((4, 6, 8), "bolts of the joint")
    high: float = between(0.8, 1.05, "height of its stem's neck / radius of the flanges")
    top: StemTop = nested(StemTop, "top of its stem")
    ball: BallInside = _inside()
    operator: Any = operator("lever", "lever", "lever", "worm", "rack", "motor box", "scotch")

    def build(self, t: Table) -> Model:
        radius, length = self.radius, FACE_TO_FACE["ball"][self.dn]
        neck, back = neck_of(self.dn)
        x, big, thick = length * self.middle, 1.5 * radius + 0.008, 0.008 + 0.07 * radius
        joint = min(x + 0.75 * radius + 0.006, length - back - 2.2 * thick)
        low, end = max(x - 0.9 * radius, back + 0.002), max(joint + thick + 0.002, length - back - 0.004)
        middle = outline(neck, back, big, low, big, joint, 0.95 * big, joint + thick, neck, end)
        wide, tall = 1.25 * big + 0.008, (1.25 if self.form != "oval" else 1.5) * big + 0.008
        edge = plate_outline(self.form, wide, tall, t.n(big, 16))
        near, far = (along("x", slab(edge, z, z + thick)) for z in (joint - thick, joint))
        t.add("valve body", ended(self.dn, t.style, length, middle, "flanged"), near)
        t.add("valve body", far)
        t.along("x").extend([bolts_on(edge, self.bolts, joint - thick, joint + thick, 0.006 + 0.05 * radius)])
        high, t = max(big + 0.01, 0.5 * t.flange.outer * self.high) + 0.012, t.at(x)
        self.put_top(t, 0.8 * big, high, radius)
        self.operator.build(t.at(0, 0, high + 0.004 + 0.2 * radius))
        return t.model(length, kind="ball valve")


# --- pieces that other valves have, too ---


def part_ring(profile: list[tuple[float, float]], n: int) -> Solid:
    """A closed outline ``(radius, height)`` turned about z [m]."""
    return weld([revolve(profile, n, closed=True)])


def ferrule(dn: int, low: float, high: float, style: ModelingStyle, face: bool) -> Solid:
    """A sanitary ferrule along x, its conical rim at ``low`` (``face``) or at ``high`` (ISO 2852)."""
    pipe = PIPES[dn]
    n, rim = style.round(pipe.radius), 1.25 * pipe.radius + 0.008
    inner = pipe.bore if style.hollow else 0.0
    edge = (
        [(pipe.radius, low + 0.0065), (rim, low + 0.003), (rim, low)]
        if face
        else [(rim, high), (rim, high - 0.003), (pipe.radius, high - 0.0065)]
    )
    edge = [(pipe.radius, high), *edge] if face else [*edge, (pipe.radius, low)]
    edge = edge[::-1]
    if inner:
        return about_x(part_ring([(inner, edge[0][1]), *edge, (inner, edge[-1][1])], n))
    return about_x(turned(edge, n))


class ClampedEnds(Params):
    """The pipe's ferrules before and behind a sanitary valve, with their clamps."""

    turns: tuple[float, ...] = several(number(0, 6), 2, "how far a clamp is turned, at the inlet first", "rad")

    def build(self, t: Table, dn: int, stub: float, length: float) -> None:
        """Puts them down for a nominal size; the valve's own faces lie ``stub`` inward [m]."""
        t.add("coupling", ferrule(dn, 0.0, stub - 0.001, t.style, False), of="pipe")
        t.add("coupling", ferrule(dn, length - stub + 0.001, length, t.style, True), of="pipe")
        for x, turn in zip((stub, length - stub), self.turns, strict=True):
            t.at(x).spun("x", turn).add("clamp", _clamp(dn, t.style))


def _clamp(dn: int, style: ModelingStyle) -> Solid:
    """A clamp of two hinged halves round a pair of ferrules, with its wing nut (ISO 2852)."""
    rim = 1.25 * PIPES[dn].radius + 0.008
    side = outline(0.995, -0.004, 0.86, -0.009, 1.12, -0.009, 1.12, 0.009, 0.86, 0.009, 0.995, 0.004)
    hoop = part_ring([(r * rim, x) for r, x in side], max(16, style.round(rim)))
    bolt = [
        rod((1.22 * rim, -0.3 * rim, 0), (1.22 * rim, 0.35 * rim + 0.02, 0), 0.004, 8),
        box((0.012, 0.014, 0.016), (1.18 * rim, -0.2 * rim, 0)),
        box((0.02, 0.014, 0.016), (1.18 * rim, 0.2 * rim, 0)),
        box((0.006, 0.012, 0.034), (1.22 * rim, 0.35 * rim + 0.016, 0)),
        box((0.014, 0.02, 0.016), (-1.15 * rim, 0, 0)),
    ]
    return about_x(merge([hoop, *bolt]))


# --- the same as finished parts ---


BALLS = families_of(Trunnion, TopEntry, FullyWelded, Segment, WaferBall, SplitBody)
