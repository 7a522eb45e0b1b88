"""Elbows, bends and return bends of further makes: as loops and humps in a line, or on a pipe's end."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.params import Params, among, between, chance, given, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.piping.shape import (
    BACK,
    BOLTED,
    QUARTERS,
    ROLL,
    SMALL,
    Fitting,
    Tail,
    barrel,
    below,
    bend_path,
    counter,
    grooved,
    lathe,
    mouth,
    pipe_x,
    prism,
    sized,
    tail_of,
)
from cadplants.model.family import Model, Part, placed
from cadplants.model.standards import FLANGES, PIPES, SIZES, sizes_between
from cadplants.parts.flange import nut_room, plate_thickness
from cadplants.solids.mesh_ops import Solid, merge, moved, tube
from cadplants.solids.polygon import circle
from cadplants.solids.primitives import ball, box, cylinder, lofted
from cadplants.solids.transforms import IDENTITY, at, looking, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["BENDS"]

_TURNS, _TURN = (0.5, 0.5, 0.25), "turn of its bends / half a turn"

# The pieces of a bend from the origin along +x towards +y, and its centre to end [m].
Bent = tuple[list[Part], float]


def _far(turn: float, reach: float) -> Floats:
    """The frame of a bend's far end, x outward."""
    if turn > 3.0:
        raise ValueError("a return bend has no corner")
    return at(reach) @ spun("z", turn) @ at(reach)


def _elbow(*solids: Solid, of: str = "pipe") -> list[Part]:
    return [Part(merge(solids), "elbow", of)]


class Bend(Params):
    """How a bend is made."""

    def bent(self, dn: int, style: ModelingStyle, turn: float) -> Bent:
        """One of a nominal size by an angle."""
        raise NotImplementedError(type(self).__name__)


class Mitred(Bend):
    """Cut and welded of pipe: one to four mitres, with or without beads of weld."""

    cuts: int = whole(1, 4, "mitres, at a right angle")
    radius: float = between(2.0, 3.4, "of the bend / of the pipe")
    beads: bool = chance(0.4, "beads of weld at its ends")

    def bent(self, dn: int, style: ModelingStyle, turn: float) -> Bent:
        r, n, bore = sized(dn, style)
        radius, steps = self.radius * r, min(self.cuts, max(1, round(self.cuts * turn / 1.5)))
        between = (np.arange(steps) + 0.5) * turn / steps
        far = radius / np.cos(turn / steps / 2)
        corners = np.column_stack([far * np.sin(between), radius - far * np.cos(between), np.zeros(steps)])
        end = np.array([[radius * np.sin(turn), radius * (1 - np.cos(turn)), 0.0]])
        pieces = [tube(np.vstack([[[0.0, 0.0, 0.0]], corners, end]), r, bore, n)]
        reach = radius * float(np.tan(turn / 2))
        if self.beads:
            pieces.append(barrel(1.03 * r, 0.0, 0.1 * r, n, 0.99 * r))
            pieces.append(moved(barrel(1.03 * r, -0.1 * r, 0.0, n, 0.99 * r), _far(turn, reach)))
        return _elbow(*pieces), reach


class Beaded(Bend):
    """Short or long radius for butt welding (ASME B16.9), its welds standing out as beads."""

    radius: float = among((1.0, 1.0, 1.5), "of the bend, less 0.3 of the pipe's / nominal size")
    lead: float = among((0.0, 0.3), "length of its straight ends / radius of the pipe")

    def bent(self, dn: int, style: ModelingStyle, turn: float) -> Bent:
        r, n, bore = sized(dn, style)
        radius, wide = self.radius * dn / 1000 + 0.3 * r, 0.05 * r + 0.003
        path, reach = bend_path(radius, turn, style.bend(radius + r, turn), self.lead * r)
        bead = lathe(outline(r, 0.0, 1.04 * r, 0.3 * wide, 1.04 * r, 0.7 * wide, r, wide), n, 0.985 * r)
        return _elbow(tube(path, r, bore, n), bead, moved(bead, _far(turn, reach) @ at(-wide))), reach


class Pulled(Bend):
    """Pulled cold or hot over three to five diameters, with straight ends of its own (ASME B16.49)."""

    radius: float = between(2.5, 5.0, "of the bend / diameter of the pipe")
    lead: float = between(1.0, 3.0, "length of its straight ends / radius of the pipe")

    def bent(self, dn: int, style: ModelingStyle, turn: float) -> Bent:
        r, n, bore = sized(dn, style)
        radius = self.radius * 2 * r
        path, reach = bend_path(radius, turn, style.bend(radius + r, turn), self.lead * r)
        return _elbow(tube(path, r, bore, n)), reach


class Banded(Bend):
    """Malleable iron, threaded, with a band round each mouth (EN 10242 A1)."""

    design: str = given("banded", "how its mouths are made")
    radius: float = between(1.15, 1.9, "of the bend / of its body")
    heel: bool = chance(0.6, "a thick heel", when=lambda p: p.design == "socket")
    web: bool = chance(0.3, "a web in its corner", when=lambda p: p.design == "glued")
    ribbed: bool = chance(0.5, "ribs on its couplings", when=lambda p: p.design == "grooved")

    def bent(self, dn: int, style: ModelingStyle, turn: float) -> Bent:
        (r, n, bore), design, loose = sized(dn, style, 1.15), self.design, self.design == "grooved"
        body = {"grooved": 1.0, "glued": 1.15}.get(design, 1.14) * r + (0.0 if loose else 0.0015)
        radius = self.radius * body * (1.5 if loose else 1.0)
        deep = {"glued": 1.5 * r + 0.01, "grooved": 0.03, "socket": 0.8 * r + 0.014}.get(design, 0.7 * r + 0.011)
        path, inner = bend_path(radius, turn, style.bend(radius + body, turn), 0.6 * deep)
        start, reach = 0.4 * deep, inner + 0.4 * deep
        end, far = mouth(design, dn, style, 0.0, deep), _far(turn, reach)
        pieces = [moved(tube(path, body, bore, n), at(start)), moved(end, at(deep) @ BACK), moved(end, far @ at(-deep))]
        if self.heel:
            pieces.append(moved(ball(1.3 * body, n), at(reach - 0.2 * body, 0.2 * body)))
        if self.web:
            pieces.append(box((1.2 * reach, 0.25 * reach, 0.12 * r), (0.75 * reach, 0.5 * reach, 0)))
        parts = _elbow(*pieces, of="handle" if design == "glued" else "pipe")
        if loose:
            parts += grooved(dn, style, IDENTITY, self.ribbed) + grooved(dn, style, far, self.ribbed)
        return parts, reach


class Socket(Banded):
    """Forged steel for socket welding with a thick heel (ASME B16.11)."""

    design: str = given("socket", "how its mouths are made")


class Glued(Banded):
    """Plastic with long glued sockets (EN ISO 1452-3)."""

    design: str = given("glued", "how its mouths are made")


class Grooved(Banded):
    """A grooved elbow between its two couplings (AWWA C606)."""

    design: str = given("grooved", "how its mouths are made")


class Cast(Bend):
    """A cast elbow with flanges (ASME B16.5 class 150), sometimes on a foot, between its counter-flanges."""

    radius: float = between(1.1, 2.0, "of the bend, but for the room of its flanges / of its body")
    foot: bool = chance(0.4, "a foot under a right angle")

    def bent(self, dn: int, style: ModelingStyle, turn: float) -> Bent:
        (_, n, bore), rim, body = sized(dn, style), FLANGES[dn].outer, 0.485 * FLANGES[dn].hub
        room = plate_thickness(dn) + 0.3 * body
        # In the inner corner there is room for the nuts behind both flanges.
        radius = self.radius * body + max(0.0, 0.5 * rim + plate_thickness(dn) + nut_room(dn) - room - body)
        path, inner = bend_path(radius, turn, style.bend(radius + body, turn), 0.5 * room)
        first, more = counter(dn, style, BACK)
        reach = inner + 0.5 * room
        face, far = mouth("flanged", dn, style, 0.0, room), _far(turn, reach)
        pieces = [
            moved(tube(path, body, bore, n), at(0.5 * room)),
            moved(face, at(room) @ BACK),
            moved(face, far @ at(-room)),
        ]
        if self.foot and turn > 1.0:
            pieces.append(box((0.3 * body, 0.55 * rim, 1.2 * body), (reach, -0.275 * rim, 0)))
            pieces.append(box((0.9 * rim, 0.02 + 0.05 * body, 0.9 * rim), (reach, -0.55 * rim, 0)))
        parts = [*_elbow(*pieces, of="valve"), *first, *counter(dn, style, far)[0]]
        return placed(parts, at(more)), reach + more


class Compression(Bend):
    """A tube fitting: a square forged corner with a hexagon nut on each leg (ISO 8434-1)."""

    long: float = between(1.8, 2.4, "length of a leg, less 6 mm / radius of the pipe")

    def bent(self, dn: int, style: ModelingStyle, turn: float) -> Bent:
        r, n, _ = sized(dn, style)
        half, nut, long = 1.25 * r + 0.002, 1.1 * r + 0.008, self.long * r + 0.006
        reach, bored = long + nut, 0.99 * r if style.hollow else 0.0
        block = prism(2 * half, 4, -half * float(np.tan(turn / 2)), 0.55 * long)
        leg = merge([barrel(1.1 * r, 0.0, long, n), block])
        near, far = at(reach) @ BACK, _far(turn, reach) @ at(-reach)
        ends = [prism(2.55 * r + 0.006, 6, 0.15 * nut, nut, bored, n), barrel(1.15 * r, 0.0, nut, n, bored)]
        parts = _elbow(moved(leg, near), moved(leg, far), of="trim")
        cap = moved(merge(ends), at(long))
        return [*parts, *(Part(moved(cap, way), "nut", "trim", "", BOLTED) for way in (near, far))], reach


class _Loop(Fitting):
    """An expansion loop or a hump over an obstacle: four bends of 90 or 45 degrees, maybe in two planes."""

    bend: Bend = nested(Bend, "how its bends are made")
    turn: float = among(_TURNS, _TURN)
    lead: float = among((0.0, 0.05, 0.15), "length of the pipe before and behind it", "m")
    slant: float = between(0.02, 0.5, "length of the pipes aside", "m")
    wide: float = between(0.02, 0.6, "length of the pipe between them", "m")

    def build(self, t: Table) -> Model:
        turn = self.turn * np.pi
        reach = self.bend.bent(t.dn, t.style, turn)[1]
        lead, slant = reach + self.lead, 2 * reach + self.slant
        dx, dz = slant * np.cos(turn), slant * np.sin(turn)
        xs = np.cumsum([0.0, lead, dx, 2 * reach + self.wide, dx, lead])
        points = np.column_stack([xs, np.zeros(6), [0, 0, dz, dz, 0, 0]])
        points[np.abs(points) < 1e-12] = 0.0
        self._routed(t, points)
        return t.model(round(float(xs[-1]), 9), "welded")

    def _routed(self, t: Table, points: Floats) -> None:
        """Bends in the corners of a way and pipe between them."""
        begin, after = points[0], points[0]
        for k in range(1, len(points)):
            leg = points[k] - points[k - 1]
            before = leg / np.linalg.norm(leg)
            stop, reach = points[k], 0.0
            if k < len(points) - 1:
                after = (points[k + 1] - points[k]) / np.linalg.norm(points[k + 1] - points[k])
                pieces, reach = self.bend.bent(t.dn, t.style, float(np.arccos(np.clip(before @ after, -1, 1))))
                stop = points[k] - reach * before
                t.moved(looking(stop, before, np.cross(before, after))).extend(
                    [p for p in pieces if p.solid.faces.size]
                )
            length = float(np.linalg.norm(stop - begin))
            if length > 0.002:
                t.moved(looking(begin, before)).add("pipe", pipe_x(t.dn, 0.0, length, t.style))
            if reach:
                begin = points[k] + reach * after


class MitredLoop(_Loop, name="elbow/mitred", sizes=sizes_between(most=250)):
    """A loop of bends cut and welded of pipe."""

    bend: Bend = nested(Mitred, "how its bends are made")


class BeadedLoop(_Loop, name="elbow/beaded", sizes=sizes_between(most=250)):
    """A loop of elbows for butt welding (ASME B16.9)."""

    bend: Bend = nested(Beaded, "how its bends are made")


class PulledLoop(_Loop, name="elbow/pulled", sizes=sizes_between(most=80)):
    """A loop of pulled bends (ASME B16.49)."""

    bend: Bend = nested(Pulled, "how its bends are made")


class GroovedLoop(_Loop, name="elbow/grooved", sizes=sizes_between(25, 200)):
    """A loop of grooved elbows (AWWA C606)."""

    bend: Bend = nested(Grooved, "how its bends are made")


class BandedLoop(_Loop, name="elbow/malleable banded", sizes=SMALL):
    """A loop of malleable elbows (EN 10242 A1)."""

    bend: Bend = nested(Banded, "how its bends are made")


class GluedLoop(_Loop, name="elbow/glued plastic", sizes=sizes_between(most=200)):
    """A loop of glued plastic elbows (EN ISO 1452-3)."""

    bend: Bend = nested(Glued, "how its bends are made")


class _Turned(Fitting, place="end"):
    """One or two bends on a pipe's end, then whatever goes on from there."""

    bend: Bend = nested(Bend, "how its bends are made")
    roll: float = among(QUARTERS, ROLL)
    count: int = whole(1, 2, "bends")
    turn: float = among(_TURNS, "turn of the first bend / half a turn")
    again: float = among(_TURNS, "turn of the second bend / half a turn", when=lambda p: p.count > 1, otherwise=0.0)
    apart: float = between(0.03, 0.3, "length of the pipe between them", "m", when=lambda p: p.count > 1)
    twist: float = among(
        QUARTERS, "turn of the second about the pipe / half a turn", when=lambda p: p.count > 1, otherwise=0.0
    )
    tail: Tail = tail_of("open", "open", "cap", "flange")

    def build(self, t: Table) -> Model:
        t = t.spun("x", self.roll * np.pi)
        for k, turn in enumerate((self.turn, self.again)[: self.count]):
            if k:
                t.add("pipe", pipe_x(t.dn, 0.0, self.apart, t.style))
                t = t.at(self.apart).spun("x", self.twist * np.pi)
            parts, reach = self.bend.bent(t.dn, t.style, turn * np.pi)
            t.extend(parts)
            t = t.moved(_far(turn * np.pi, reach))
        self.tail.build(t)
        return t.model()


class CastTurn(_Turned, name="elbow/cast flanged", sizes=sizes_between(most=150)):
    """Cast elbows with flanges on a pipe's end (ASME B16.5)."""

    bend: Bend = nested(Cast, "how its bends are made")


class SocketTurn(_Turned, name="elbow/socket weld", sizes=SMALL):
    """Forged elbows for socket welding on a pipe's end (ASME B16.11)."""

    bend: Bend = nested(Socket, "how its bends are made")


class CompressionTurn(_Turned, name="elbow/compression", sizes=SMALL[:4]):
    """Elbows for tubes on a pipe's end (ISO 8434-1)."""

    bend: Bend = nested(Compression, "how its bends are made")


class MitredTurn(_Turned, name="elbow/mitred turn"):
    """Bends cut and welded of pipe on a pipe's end."""

    bend: Bend = nested(Mitred, "how its bends are made")


class BandedTurn(_Turned, name="elbow/malleable turn", sizes=SMALL):
    """Malleable elbows on a pipe's end (EN 10242 A1)."""

    bend: Bend = nested(Banded, "how its bends are made")


class Street(Fitting, name="elbow/street", place="end", sizes=SMALL):
    """A street elbow (EN 10242 A4): a banded mouth on the pipe, the other end a bare thread into a coupling."""

    turn: float = among((0.5, 0.25), "of the bend / half a turn")
    radius: float = between(1.2, 1.7, "of the bend / of its body")
    roll: float = among(QUARTERS, ROLL)
    tail: Tail = tail_of("open", "cap")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style)
        turn, body, deep = self.turn * np.pi, 1.14 * r + 0.0015, 0.7 * r + 0.011
        radius, thread = self.radius * body, 0.8 * r + 0.01
        path, reach = bend_path(radius, turn, t.style.bend(radius + r, turn), 0.6 * deep)
        far = at(0.4 * deep) @ _far(turn, reach)
        end = moved(mouth("banded", t.dn, t.style, 0.0, deep), at(deep) @ BACK)
        screw = moved(lathe(outline(r, -0.2 * r, 0.97 * r, thread), n, bore), far)
        t = t.spun("x", self.roll * np.pi)
        t.add("elbow", moved(tube(path, body, bore, n), at(0.4 * deep)), end, screw)
        t, sleeve = t.moved(far), thread + 0.6 * r + 0.01
        bored = 0.96 * r if t.style.hollow else 0.0
        t.add("coupling", barrel(1.25 * r + 0.002, 0.4 * thread, sleeve, n, bored), of="pipe")
        self.tail.build(t.at(sleeve))
        return t.model()


class Reducing(Fitting, name="elbow/reducing", place="end", sizes=SIZES[2:]):
    """A reducing elbow (ASME B16.9): round a long radius from one size to a smaller one."""

    other: int = among(lambda p: below(p.dn, 3), "nominal size of its far end", "mm")
    radius: float = between(2.0, 3.2, "of the bend / of the larger pipe")
    roll: float = among(QUARTERS, ROLL)
    tail: Tail = nested(Tail, "what goes on from it")

    def build(self, t: Table) -> Model:
        (a, n, _), b = sized(t.dn, t.style), PIPES[self.other].radius
        radius, steps = self.radius * a, max(4, t.style.bend(3 * a))
        loops, ring = [], circle(1.0, n)
        for share in np.linspace(0, 1, steps + 1):
            turn, r = share * np.pi / 2, a + share * (b - a)
            section = np.column_stack([np.zeros(n), r * ring[:, 0], r * ring[:, 1], np.ones(n)])
            pose = at(radius * np.sin(turn), radius * (1 - np.cos(turn))) @ spun("z", turn)
            loops.append((section @ pose.T)[:, :3])
        t = t.spun("x", self.roll * np.pi)
        t.add("elbow", lofted(loops))
        self.tail.build(t.at(radius, radius).spun("z", np.pi / 2), self.other)
        return t.model()


class Return(Fitting, name="elbow/return bend", place="end", sizes=sizes_between(most=150), weight=1.0):
    """A coil of pipes side by side joined by return bends of 180 degrees (ASME B16.9), held by flat bars."""

    radius: float = between(1.5, 3.2, "of a bend / of the pipe")
    lead: float = among((0.0, 1.0), "length of a bend's straight ends / radius of the pipe")
    length: float = between(0.3, 1.0, "of a pipe, less 6 of its radii", "m")
    passes: int = whole(1, 4, "bends")
    barred: bool = chance(0.6, "flat bars hold it")
    roll: float = among(QUARTERS, ROLL)

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style)
        radius, length = self.radius * r, self.length + 6 * r
        path, _ = bend_path(radius, np.pi, t.style.bend(radius + r), self.lead * r)
        bend, pipe = tube(path, r, bore, n), pipe_x(t.dn, 0.0, length, t.style)
        t = t.spun("x", self.roll * np.pi)
        way = t
        for k in range(self.passes):
            side = 1.0 if k % 2 == 0 else -1.0
            way.moved(np.diag([1.0, side, 1.0, 1.0])).add("elbow", bend)
            way = way.at(0, side * 2 * radius).spun("z", np.pi)
            way.add("pipe", pipe)
            way = way.at(length)
        wide = 2 * radius * self.passes
        if self.barred:
            for x in (-0.25 * length, -0.75 * length):
                t.add("bracket", box((0.04, wide + 2 * r, 0.006), (x, 0.5 * wide + radius, -r - 0.003)))
        return t.model()


class Duckfoot(Fitting, name="elbow/duckfoot", place="end", sizes=SIZES[SIZES.index(50) :]):
    """A base elbow on a pipe's end: it turns up from a welded leg, a trunnion, with a foot plate."""

    bend: Beaded = nested(Beaded, "its bend")
    leg: float = between(2.5, 6.0, "length of its leg, less 0.1 m / radius of the pipe")
    tail: Tail = tail_of("open", "flange", "lid")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style)
        parts, reach = self.bend.bent(t.dn, t.style, np.pi / 2)
        low, x, up = -self.leg * r - 0.1, reach - 0.35 * r, t.spun("x", np.pi / 2)
        up.extend(parts)
        t.at(x).add("pipe", cylinder(0.7 * r, low, 0.0, n))
        t.add("base plate", box((3.2 * r, 3.2 * r, 0.012), (x, 0, low - 0.006)))
        self.tail.build(up.moved(_far(np.pi / 2, reach)))
        return t.model()


BENDS = families_of(
    MitredLoop, BeadedLoop, PulledLoop, CastTurn, GroovedLoop, BandedLoop, SocketTurn, GluedLoop, CompressionTurn,
    MitredTurn, BandedTurn, Street, Reducing, Return, Duckfoot,
)  # fmt: skip
