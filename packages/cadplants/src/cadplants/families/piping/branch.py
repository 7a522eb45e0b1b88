"""Tees, laterals, crosses and branch outlets of further makes, with what goes on from their mouths."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.draws import made
from cadplants.builder.params import Params, among, between, chance, given, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.piping.shape import (
    ENDS,
    ROLL,
    SMALL,
    UP,
    Fitting,
    Tail,
    barrel,
    below,
    bend_path,
    bolting,
    counter,
    grooved,
    lathe,
    mouth,
    pipe_x,
    prism,
    seated,
    sized,
    tail_of,
    tails,
)
from cadplants.model.family import Model
from cadplants.model.standards import FLANGES, PIPES, SIZES, sizes_between
from cadplants.parts.flange import nut_room, plate_thickness
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, about_x, extrude, loft, moved, tube, weld
from cadplants.solids.primitives import BOTH, ball, cylinder, hexagon, rope
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["BRANCHES"]

_LARGE = SIZES[SIZES.index(40) :]
_OTHER = "nominal size of its branches"
_GOES_ON = "what goes on from it"


def _smaller(dn: int, count: int = 3) -> Sequence[int]:
    """The same nominal size and the next smaller ones [mm]."""
    return [size for size in SIZES if size <= dn][-count:]


def _within(dn: int, share: float, count: int) -> Sequence[int]:
    """The largest nominal sizes [mm] whose pipe is narrower than a share of another's."""
    return [size for size in SIZES if PIPES[size].radius < share * PIPES[dn].radius][-count:]


def _way(x: float, turn: float) -> Floats:
    """Out of the line's axis at ``x`` towards an angle from +x in the plane of x and z."""
    return at(x) @ spun("y", -turn)


def _reach(design: str, dn: int, slant: float = 0.0) -> float:
    """From the middle of a fitting to its mouth [m]; longer where branches lean."""
    r = PIPES[dn].radius
    if design == "flanged":
        return 0.5 * FLANGES[dn].outer + plate_thickness(dn) + nut_room(dn) + 0.01 + 1.6 * slant * r
    base = {"banded": 2.0 * r + 0.014, "socket": 1.9 * r + 0.016, "glued": 2.7 * r + 0.012, "grooved": 2.4 * r + 0.04}
    return base.get(design, 2.1 * r + 0.012) + 1.4 * slant * r


_FURTHER = {"flanged": ENDS, "grooved": ("open", "cap", "lid")}


class Further(Params):
    """What is on a branch's mouth: nothing, a plug, or a joint of its kind and a pipe."""

    design: str = given("plain", "how the mouth is made")
    bare: bool = chance(0.3, "nothing on it", when=lambda p: p.design == "flanged")
    plugged: bool = chance(0.3, "a plug in it", when=lambda p: p.design in ("banded", "socket", "hex"))
    square: bool = chance(0.5, "the plug's head is square, not hexagonal", when=lambda p: p.plugged)
    piped: bool = chance(
        0.9, "a pipe on it", when=lambda p: not p.plugged and p.design not in ("flanged", "grooved"), otherwise=True
    )
    tail: Tail = nested(
        Tail,
        "that pipe",
        fixed=lambda p: {"ends": _FURTHER.get(p.design, ("open", "open", "cap", "flange"))},
        when=lambda p: p.piped and not p.plugged and not p.bare,
    )

    def build(self, t: Table, dn: int) -> None:
        """Puts it down along x, of a nominal size."""
        r = PIPES[dn].radius
        if self.plugged:
            corners, flats = (4, 1.1 * r) if self.square else (6, 2.0 * r)
            shank = lathe(outline(0.95 * r, -0.6 * r, 0.95 * r, 0.001), t.n(r))
            t.add("pipe cap", prism(flats, corners, 0.0, 0.5 * r + 0.006), shank)
            return
        if self.bare or not self.piped:
            return
        if self.design == "flanged":
            parts, length = counter(dn, t.style, at())
            t.extend(parts)
            t = t.at(length)
        elif self.design == "grooved":
            t.extend(grooved(dn, t.style, at()))
        self.tail.build(t, dn)


class _Junction(Fitting):
    """A fitting with two mouths in the line and some branches, and pipes, lids or nothing on those."""

    design: str = given("plain", "how its mouths are made")
    count: int = given(1, "branches")
    lean: float = given(0.5, "direction of its branches from the line / half a turn")
    other: int = among(lambda p: _smaller(p.dn), _OTHER, "mm")
    swollen: bool = chance(0.5, "a thick ball in its middle", when=lambda p: p.design == "flanged")
    ends: tuple[Further, ...] = several(
        made(Further, lambda p: {"design": p.design}), lambda p: p.count, "what is on its branches"
    )

    def build(self, t: Table) -> Model:
        design, other, (r, n, _), flanged = self.design, self.other, sized(t.dn, t.style), self.design == "flanged"
        slant, rim = 0.0 if self.lean == 0.5 else 1.0, t.flange.outer
        x = _reach(design, t.dn)
        behind = x + slant * (1.2 * r + (0.3 * rim if flanged else 0.0))
        high = (
            _reach(design, other, slant)
            + (r - PIPES[other].radius)
            + slant * (1.1 * r + (0.35 * rim if flanged else 0.0))
        )
        turns = [turn * np.pi for turn in (self.lean, -self.lean)[: self.count]]
        ends = [(np.pi, t.dn, x), (0.0, t.dn, behind), *((turn, other, high) for turn in turns)]
        pieces = [moved(mouth(design, size, t.style, 0.0, far), _way(x, turn)) for turn, size, far in ends]
        if design not in ("grooved", "plain"):
            swell = 0.485 * t.flange.hub if flanged else 1.15 * r + 0.0015
            pieces.append(moved(ball((1.35 if self.swollen else 1.02) * swell, n), at(x)))
        t.add(self.label, *pieces, of={"glued": "handle", "flanged": "valve"}.get(design, "pipe"))
        if design == "grooved":
            t.extend(grooved(t.dn, t.style, at(0)) + grooved(t.dn, t.style, at(x + behind)))
        for turn, end in zip(turns, self.ends, strict=True):
            end.build(t.moved(_way(x, turn)).at(high), other)
        return t.model(round(x + behind, 9), "flanged" if flanged else "welded")


class BandedTee(_Junction, name="tee/malleable banded", sizes=SMALL):
    """A malleable tee with bands (EN 10242), its branch maybe of a smaller size."""

    design: str = given("banded", "how its mouths are made")


class SocketTee(_Junction, name="tee/socket block", sizes=SMALL):
    """A forged tee with sockets (ASME B16.11)."""

    design: str = given("socket", "how its mouths are made")
    other: int = among(lambda p: (p.dn,), _OTHER, "mm")


class GluedTee(_Junction, name="tee/glued plastic", sizes=sizes_between(most=200)):
    """A plastic tee with glued sockets (EN ISO 1452-3), its branch maybe of a smaller size."""

    design: str = given("glued", "how its mouths are made")


class GroovedTee(_Junction, name="tee/grooved", sizes=sizes_between(25, 200)):
    """A grooved tee with its couplings (AWWA C606)."""

    design: str = given("grooved", "how its mouths are made")
    other: int = among(lambda p: (p.dn,), _OTHER, "mm")


class CastTee(_Junction, name="tee/cast reducing", sizes=sizes_between(most=200)):
    """A cast tee with flanges, its branch maybe of a smaller size (ASME B16.1, EN 545)."""

    design: str = given("flanged", "how its mouths are made")


class Lateral(_Junction, name="tee/lateral welded"):
    """A lateral of 45 or 60 degrees, welded."""

    lean: float = among((0.25, 0.25, 1 / 3), "direction of its branch from the line / half a turn")


class CastLateral(Lateral, name="tee/lateral cast", sizes=sizes_between(most=200)):
    """A lateral of 45 or 60 degrees, cast with flanges (ASME B16.1, EN 545)."""

    design: str = given("flanged", "how its mouths are made")


class PlasticLateral(Lateral, name="tee/lateral plastic", sizes=sizes_between(most=200)):
    """A lateral of 45 or 60 degrees, glued of plastic."""

    design: str = given("glued", "how its mouths are made")


class BandedCross(_Junction, name="cross/malleable banded", sizes=SMALL):
    """A malleable cross with bands (EN 10242)."""

    design: str = given("banded", "how its mouths are made")
    count: int = given(2, "branches")
    other: int = among(lambda p: _smaller(p.dn, 2), _OTHER, "mm")


class CastCross(BandedCross, name="cross/cast flanged", sizes=sizes_between(most=200)):
    """A cast cross with flanges (ASME B16.1, EN 545)."""

    design: str = given("flanged", "how its mouths are made")


class GluedCross(BandedCross, name="cross/glued plastic", sizes=sizes_between(most=200)):
    """A plastic cross with glued sockets (EN ISO 1452-3)."""

    design: str = given("glued", "how its mouths are made")


class GroovedCross(BandedCross, name="cross/grooved", sizes=sizes_between(25, 200)):
    """A grooved cross with its couplings (AWWA C606)."""

    design: str = given("grooved", "how its mouths are made")


class DoubleLateral(BandedCross, name="cross/double lateral", sizes=SIZES):
    """A double lateral of 45 degrees, welded."""

    design: str = given("plain", "how its mouths are made")
    lean: float = given(0.25, "direction of its branches from the line / half a turn")


class Sweep(Fitting, name="tee/sweep"):
    """A sweep tee: its branch leaves the line in a curve (EN 10242 E1 or fabricated)."""

    other: int = among(lambda p: _smaller(p.dn), "nominal size of its branch", "mm")
    radius: float = between(1.6, 3.0, "of its branch, less half the line's / diameter of the branch")
    banded: bool = chance(0.4, "bands at its mouths")
    tail: Tail = nested(Tail, _GOES_ON)

    def build(self, t: Table) -> Model:
        (r, n, _), small = sized(t.dn, t.style), PIPES[self.other].radius
        radius, begin, band = self.radius * 2 * small + 0.5 * r, 0.6 * r + 0.01, 0.35 * r + 0.004
        path, reach = bend_path(radius, np.pi / 2, t.style.bend(radius + small))
        length, branch = reach + 2.0 * r + 0.02, tube(path, 0.985 * small, bore_of(self.other, t.style), n)
        pieces = [pipe_x(t.dn, 0.0, length, t.style), moved(branch, at(begin) @ spun("x", np.pi / 2))]
        if self.banded:
            pieces += [barrel(1.25 * r, low, low + band, n, 0.99 * r) for low in (0.0, length - band)]
        t.add("tee", *pieces)
        self.tail.build(t.at(begin + reach, 0, reach).moved(UP), self.other)
        return t.model(round(length, 9), "welded")


class PulledCollar(Fitting, name="tee/pulled collar", sizes=_LARGE):
    """A collar pulled out of the pipe itself, the branch welded on it; one to three in a row as in a header."""

    other: int = among(lambda p: _within(p.dn, 0.72, 4), _OTHER, "mm")
    count: int = whole(1, 3, "branches")
    apart: float = between(0.04, 0.25, "from branch to branch, less two of its diameters", "m")
    ends: tuple[Tail, ...] = several(tails(*ENDS), lambda p: p.count, "what goes on from its branches")

    def build(self, t: Table) -> Model:
        (r, n, _), small, bore = sized(t.dn, t.style), PIPES[self.other].radius, bore_of(self.other, t.style)
        pitch, top = 4.0 * small + self.apart, r + 0.35 * small + 0.006
        rise = outline(1.3 * small, 0.0, 1.12 * small, r + 0.08 * small, small, 0.5 * (r + top), small, top)
        xs = [pitch * (k + 0.5) for k in range(self.count)]
        collars = [moved(seated(rise, r, n, bore, 0.001), at(x)) for x in xs]
        t.add("tee", pipe_x(t.dn, 0.0, pitch * self.count, t.style), *collars)
        for x, end in zip(xs, self.ends, strict=True):
            end.build(t.at(x, 0, top).moved(UP), self.other)
        return t.model(round(pitch * self.count, 9), "welded")


class BullHead(Fitting, name="tee/bull head", place="end", sizes=sizes_between(most=200), weight=1.0):
    """A tee on a pipe's end: the line runs into its branch and leaves to both sides."""

    design: str = among(("plain", "banded", "socket", "flanged", "glued", "grooved"), "how its mouths are made")
    ends: tuple[Further, ...] = several(made(Further, lambda p: {"design": p.design}), 2, "what is on its far mouths")
    roll: float = among((0.0, 0.5), ROLL)

    def build(self, t: Table) -> Model:
        (r, n, _), design = sized(t.dn, t.style), self.design
        far, t = _reach(design, t.dn), t.spun("x", self.roll * np.pi)
        parts, begin = counter(t.dn, t.style, spun("z", np.pi)) if design == "flanged" else ([], 0.0)
        x = begin + far
        ways = [at(x) @ spun("z", turn) for turn in (np.pi, 0.5 * np.pi, -0.5 * np.pi)]
        one, swell = mouth(design, t.dn, t.style, 0.0, far), 1.0 * r if design in ("plain", "grooved") else 1.2 * r
        t.add("tee", *(moved(one, way) for way in ways), moved(ball(swell, n), at(x)))
        t.at(begin).extend(parts)
        for way, end in zip(ways[1:], self.ends, strict=True):
            end.build(t.moved(way).at(far), t.dn)
        if design == "grooved":
            t.extend(grooved(t.dn, t.style, at(0)))
        return t.model()


class Breeches(Fitting, name="tee/breeches", place="end", sizes=_LARGE):
    """A wye on a pipe's end: two legs of a smaller size that part at an angle, straight or bent back to parallel."""

    other: int = among(lambda p: below(p.dn, 2), "nominal size of its legs", "mm")
    turn: float = between(0.35, 0.8, "of a leg from the line", "rad")
    back: bool = chance(0.5, "the legs bend back to parallel")
    ends: tuple[Tail, ...] = several(tails(*ENDS), 2, "what goes on from its legs")
    roll: float = among((0.0, 0.5), ROLL)

    def build(self, t: Table) -> Model:
        (r, n, _), small, turn, t = (
            sized(t.dn, t.style),
            PIPES[self.other].radius,
            self.turn,
            t.spun("x", self.roll * np.pi),
        )
        begin, length = 1.2 * r, 2.2 * small / np.sin(turn) + 0.05
        pieces, fars = [lathe(outline(r, 0.0, r, begin, 0.8 * r, begin + 0.5 * r), n)], []
        # Where the legs go on side by side, so do the flanges on them.
        far = (0.5 * FLANGES[self.other].outer + 0.005) / np.sin(turn) - 2.2 * small * np.tan(turn / 2)
        path, reach = bend_path(2.2 * small, turn, t.style.bend(3 * small, turn), max(0.4 * length, far))
        for s in BOTH:
            way = at(0.7 * begin) @ spun("z", s * turn)
            if self.back:
                pieces.append(moved(tube(path, small, 0.0, n), way @ np.diag([1.0, -s, 1.0, 1.0])))
                fars.append(way @ at(reach) @ spun("z", -s * turn) @ at(reach))
            else:
                pieces.append(moved(barrel(small, 0.0, length, n), way))
                fars.append(way @ at(length))
        t.add("tee", *pieces)
        for far, end in zip(fars, self.ends, strict=True):
            end.build(t.moved(far), self.other)
        return t.model()


# --- branch outlets: a piece of the line and what is welded or clamped on it ---


class Olet(Params):
    """A forged outlet (MSS SP-97) or half coupling (ASME B16.11) with what goes on from it."""

    design: str = given("weld", "how it is made")
    long: float = between(
        3.0, 6.0, "length over the line, less 50 mm / radius of its pipe", when=lambda p: p.design == "nipple"
    )
    turn: float = among((0.0, 0.0, 0.0, 0.5), "where it is about the line / half a turn")
    plugged: bool = chance(0.5, "a plug in it", when=lambda p: p.design in ("thread", "half"))
    tail: Tail = nested(Tail, _GOES_ON, when=lambda p: not p.plugged)

    def build(self, t: Table, small: int) -> None:
        """Puts it down about z over the line's axis, of a nominal size."""
        q = PIPES[small].radius
        solid, top = self._solid(small, t.pipe.radius, t.style)
        t = t.spun("x", self.turn * np.pi)
        t.add("branch outlet", solid)
        t = t.at(0, 0, top).moved(UP)
        if self.plugged:
            t.add("pipe cap", prism(1.9 * q, 6, 0.0, 0.5 * q + 0.005), barrel(0.85 * q, -0.002, 0.001, 12))
        else:
            self.tail.build(t, small)

    def _solid(self, small: int, r: float, style: ModelingStyle) -> tuple[Solid, float]:
        """It over the line's axis, and where its mouth is [m]."""
        q, n, _ = sized(small, style, 1.5)
        rise = {
            "weld": 0.9 * q + 0.012,
            "socket": 1.3 * q + 0.014,
            "thread": 1.2 * q + 0.016,
            "nipple": self.long * q + 0.05,
            "half": 1.0 * q + 0.018,
        }
        top = r + rise[self.design]
        mid = 0.5 * (r + top)
        wide, thin = 1.3 * q, 1.3 * q + 0.001
        shape = {
            "weld": outline(1.75 * q, 0.002, 1.7 * q, r + 0.15 * q, 1.12 * q, top - 0.25 * q, q, top),
            "socket": outline(1.55 * q, 0.004, 1.45 * q, r + 0.4 * q, 1.45 * q, top),
            "thread": outline(wide, 0.002, wide, mid, 1.55 * q, mid + 0.1 * q, 1.55 * q, top),
            "nipple": outline(1.6 * q, 0.003, 1.5 * q, r + 0.5 * q, 1.05 * q, r + 1.3 * q, q, top),
            "half": outline(thin, 0.0, thin, top),
        }[self.design]
        bore, share = 0.9 * q if style.hollow else 0.0, min(1.0, 0.95 * r / shape[0][0])
        shape = [(max(p * share, 1.03 * q if bore else p * share), z) for p, z in shape]
        return seated(shape, r, n, min(bore, 0.85 * shape[-1][0]), 0.0008), top


class Weldolet(Fitting, name="branch outlet/weldolet", sizes=_LARGE, weight=1.0):
    """A piece of the line with one to three forged outlets for welding (MSS SP-97) on it."""

    design: str = given("weld", "how its outlets are made")
    other: int = among(lambda p: _within(p.dn, 0.6, 4), "nominal size of its outlets", "mm")
    count: int = whole(1, 3, "outlets")
    apart: float = between(0.04, 0.3, "from outlet to outlet, less two diameters of their pipe", "m")
    outlets: tuple[Olet, ...] = several(made(Olet, lambda p: {"design": p.design}), lambda p: p.count, "its outlets")

    def build(self, t: Table) -> Model:
        pitch = 4 * PIPES[self.other].radius + self.apart
        length = pitch * self.count + 0.04
        t.add("pipe", pipe_x(t.dn, 0.0, length, t.style))
        for k, outlet in enumerate(self.outlets):
            outlet.build(t.at(0.02 + pitch * (k + 0.5)), self.other)
        return t.model(round(length, 9), "welded")


class Sockolet(Weldolet, name="branch outlet/sockolet", weight=0.5):
    """A piece of the line with one to three forged outlets with sockets (MSS SP-97) on it."""

    design: str = given("socket", "how its outlets are made")


class Threadolet(Sockolet, name="branch outlet/threadolet"):
    """A piece of the line with one to three forged outlets with threads (MSS SP-97) on it."""

    design: str = given("thread", "how its outlets are made")


class Nipolet(Sockolet, name="branch outlet/nipolet"):
    """A piece of the line with one to three forged nipples (MSS SP-97) on it."""

    design: str = given("nipple", "how its outlets are made")


class HalfCoupling(Sockolet, name="branch outlet/half coupling"):
    """A piece of the line with one to three half couplings (ASME B16.11) on it."""

    design: str = given("half", "how its outlets are made")


class _Outlet(Fitting, sizes=_LARGE):
    """A piece of the line with one outlet."""

    other: int = among(lambda p: _within(p.dn, 0.62, 3), "nominal size of its outlet", "mm")


class Latrolet(_Outlet, name="branch outlet/latrolet"):
    """A slanting outlet of 45 degrees (MSS SP-97): a thick sleeve grown into the line, its nipple leaning."""

    other: int = among(lambda p: _within(p.dn, 0.5, 3), "nominal size of its outlet", "mm")
    tail: Tail = nested(Tail, _GOES_ON)

    def build(self, t: Table) -> Model:
        r, (q, n, _) = t.pipe.radius, sized(self.other, t.style, 1.5)
        length, bore = 4.5 * r + 0.1, 0.9 * q if t.style.hollow else 0.0
        # It begins inside the wall of the line, where the whole of its slanting end is buried.
        low, top, thick = 1.05 * r, 1.414 * r + 2.4 * q + 0.015, 1.4 * q
        sleeve = lathe(outline(thick, low, thick, top - 0.3 * q, 1.15 * q, top), n, bore)
        t.add("pipe", pipe_x(t.dn, 0.0, length, t.style))
        way = t.moved(_way(0.35 * length, 0.25 * np.pi))
        way.add("branch outlet", sleeve, moved(ball(1.45 * q, n), at(1.414 * r + 0.1 * q)))
        self.tail.build(way.at(top), self.other)
        return t.model(round(length, 9), "welded")


class Pad(_Outlet, name="branch outlet/pad", weight=1.0):
    """A branch set on the line with a reinforcing pad (ASME B31.3, 304.3.3): a curved collar with a tell-tale hole."""

    wide: float = between(1.5, 2.0, "radius of the pad / of its pipe")
    bare: float = between(0.1, 0.4, "length of the line that it leaves bare", "m")
    tail: Tail = nested(Tail, _GOES_ON)

    def build(self, t: Table) -> Model:
        r, (q, n, bore) = t.pipe.radius, sized(self.other, t.style)
        thick, wide, top, fit = 0.004 + 0.05 * r, min(self.wide * q, 0.96 * r), r + 1.2 * q + 0.02, 1.005 * q
        length, angles = 2 * wide + self.bare, np.arange(max(16, n)) * 2 * np.pi / max(16, n)
        unit, loops = np.column_stack([np.cos(angles), np.sin(angles)]), []
        for radius, over in ((wide, 0.0), (wide, thick), (fit, thick), (fit, 0.0)):
            flat = radius * unit
            loops.append(np.column_stack([flat, np.sqrt(np.maximum(r**2 - flat[:, 1] ** 2, 0)) + over - 0.0005]))
        bead = seated(outline(1.12 * q, thick, 1.0 * q + 0.001, r + thick + 0.25 * q), r, n)
        t.add("pipe", pipe_x(t.dn, 0.0, length, t.style))
        place = t.at(0.5 * length)
        place.add("branch outlet", weld([loft(loops, closed=True)]), bead)
        place.add("pipe", seated(outline(q, 0.0, q, top), r, n, bore))
        self.tail.build(place.at(0, 0, top).moved(UP), self.other)
        return t.model(round(length, 9), "welded")


def _half_shell(inner: float, outer: float, width: float, sides: int) -> Solid:
    angles = np.linspace(0.02, np.pi - 0.02, max(8, sides // 2) + 1)
    unit = np.column_stack([np.cos(angles), np.sin(angles)])
    return about_x(extrude(np.concatenate([outer * unit, inner * unit[::-1]]), -width / 2, width / 2))


class Saddle(_Outlet, name="branch outlet/saddle", bundle="branch outlet", weight=1.0):
    """A tapping saddle: a boss on a half shell, held by a second shell with bolts (plastic) or by U-bolts (cast)."""

    bare: float = between(0.1, 0.3, "length of the line that it leaves bare", "m")
    flats: bool = chance(0.5, "a hexagon at its mouth, not a ring")
    metal: str = among(("rubber", "handle", "valve", "trim"), "kind of material")
    bolted: bool = chance(0.5, "a second shell with bolts holds it, not U-bolts")
    tail: Tail = tail_of("open", "cap", "flange")

    def build(self, t: Table) -> Model:
        (r, n, _), q = sized(t.dn, t.style), PIPES[self.other].radius
        outer, width = r + 0.006 + 0.08 * r, 3.2 * q + 0.03
        length, top = width + self.bare, outer + 1.1 * q + 0.008
        t.add("pipe", pipe_x(t.dn, 0.0, length, t.style), own=False)
        place = t.at(0.5 * length)
        boss, shell = cylinder(1.45 * q, 0.8 * outer, top, t.n(1.5 * q)), _half_shell(r, outer, width, n)
        ring = hexagon(3.1 * q, top - 0.4 * q, top) if self.flats else cylinder(1.6 * q, top - 0.4 * q, top, n)
        low, high, out = (0.0005, 0.011, outer + 0.012) if self.bolted else (0.0, 0.012, outer + 0.01)
        ear = extrude(_rect(width, 0.03), low, high)
        ears = [moved(ear, at(0, s * out)) for s in BOTH]
        place.add("branch outlet", shell, boss, ring, *ears, of=self.metal)
        if self.bolted:
            place.spun("x", np.pi).add("branch outlet", shell, *ears, of=self.metal)
            for s in BOTH:
                for x in (-0.35 * width, 0.35 * width):
                    way = at(x, s * (outer + 0.016)) @ UP
                    place.extend(bolting(1, 0.0, 0.008, -0.011, 0.011, t.style, "branch outlet", way))
        else:
            a, leg = np.linspace(np.pi, 2 * np.pi, 13), r + 0.006
            bow = np.column_stack([np.zeros(13), leg * np.cos(a), leg * np.sin(a)])
            bolt = rope(np.vstack([[0, -leg, 0.034], bow, [0, leg, 0.034]]), 0.006, 8)
            nuts = [moved(hexagon(0.019, 0.012, 0.022), at(0, s * leg)) for s in BOTH]
            for x in (-0.36 * width, 0.36 * width):
                place.at(x).add("u-bolt", bolt, of="fastener")
                place.at(x).add("nut", *nuts, own=False)
        self.tail.build(place.at(0, 0, top).moved(UP), self.other)
        return t.model(round(length, 9), "welded")


def _rect(x: float, y: float) -> Floats:
    return np.array([[x / 2, -y / 2], [x / 2, y / 2], [-x / 2, y / 2], [-x / 2, -y / 2]])


BRANCHES = families_of(
    BandedTee, SocketTee, GluedTee, GroovedTee, CastTee, Lateral, CastLateral, PlasticLateral, Sweep, PulledCollar,
    BullHead, Breeches, BandedCross, CastCross, GluedCross, GroovedCross, DoubleLateral, Weldolet, Sockolet, Threadolet,
    Nipolet, HalfCoupling, Latrolet, Pad, Saddle,
)  # fmt: skip
