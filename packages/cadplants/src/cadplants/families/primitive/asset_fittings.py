"""Fittings as kits have them: elbows, tees, crosses, reducers and spools, each in one mesh with what is at its ends."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, ClassVar

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import Device, families_of
from cadplants.builder.params import Params, among, between, chance, each, given, nested, several, whole
from cadplants.builder.table import Table
from cadplants.families.piping.hygienic import Band
from cadplants.families.piping.shape import crossing
from cadplants.families.primitive.asset_ends import Collar, Ends, Ferrule, Look
from cadplants.families.primitive.shape import disc, lying
from cadplants.model.family import Family, Model
from cadplants.model.standards import PIPES, SIZES, smaller
from cadplants.solids.mesh_ops import Solid, moved
from cadplants.solids.primitives import ring
from cadplants.solids.transforms import at, spun

__all__ = ["KIT_FITTINGS"]

_QUARTERS, _ROLL = (0.0, 0.5, 1.0, 1.5), "how it is turned about the pipe / half a turn"
_LEAN = "direction of its branches from the line / half a turn"
_SOCKETS = tuple(size for size in SIZES if size <= 200)
_BACK = spun("z", np.pi)
_HYGIENIC = tuple(size for size in SIZES if size <= 150)
_LONGEST, _ASIDE = 3.0, 0.8  # m; of a spool, of one that leads away from the line


def _stretch(rng: np.random.Generator, *_: Any) -> float:
    """A length over a diameter: short ones are as usual as long ones."""
    return float(np.exp(rng.uniform(np.log(0.6), np.log(14.0))))


def _any_length(rng: np.random.Generator, *_: Any) -> float:
    """A length over a diameter, from that of a ring to a very long pipe."""
    return float(np.exp(rng.uniform(np.log(0.15), np.log(25.0))))


class _Collared(Look):
    """Pieces with collars at their ends."""

    rim: Collar = nested(Collar, "collars")


class _Kit(Device, place="inline", group="Pipe assembly", grain="fitting", weight=0.75):
    """Pieces of a kit in a row; where a fitting has no rims the spools beside it have them, or nothing has."""

    look: Look = nested(Look, "how its pieces are drawn")
    rims: str = among(("both", "fittings", "fittings", "spools"), "what has rims")
    single: bool = chance(0.15, "a fitting has a rim at its first end only", when=lambda p: p.rims != "spools")

    @property
    def own(self) -> Ends:
        """Which ends of a fitting have rims."""
        return self.rims != "spools", self.rims != "spools" and not self.single

    @property
    def beside(self) -> bool:
        """Whether the ends of spools that meet fittings have rims."""
        return self.rims != "fittings"

    def spool(self, t: Table, r: float, stretch: float, ends: Ends, most: float = _LONGEST) -> Table:
        """A spool of a length / diameter, not longer than may be [m]; the table behind it."""
        length = max(min(stretch * 2 * r, most), self.look.least(r, ends))
        t.add("pipe", self.look.straight(t.style, r, length, ends))
        return t.at(length)

    def joined(self, t: Table, r: float) -> None:
        """Puts down what holds two pieces together that meet here."""


class _Row(_Kit):
    """A fitting in a line, at times between two spools of its kit."""

    lead: float = among((0.0, 0.0, 0.7, 1.5, 3.0), "length of the spool at either end / diameter; 0: none")

    def build(self, t: Table) -> Model:
        r, start = t.pipe.radius, np.linalg.inv(t.frame)
        if self.lead:
            t = self.spool(t, r, self.lead, (False, self.beside))
            self.joined(t, r)
        t = self.fitted(t, r)
        if self.lead:
            self.joined(t, r)
            t = self.spool(t, r, self.lead, (self.beside, False))
        return t.model(round(float((start @ t.frame)[0, 3]), 9), "welded", split=True)

    def fitted(self, t: Table, r: float) -> Table:
        """Puts the fitting down on a pipe of a radius [m]; the table behind it."""
        raise NotImplementedError(type(self).__name__)


# --- bends ---


class _Bend(Params):
    """A bend of a kit."""

    turn: float = among((0.5, 0.5, 0.5, 0.25, 0.25, 1 / 3, 1 / 6), "angle / half a turn")
    radius: float = among((1.3, 1.6, 2.0, 2.5, 3.0, 3.0, 4.0, 6.0), "of the bend / of the pipe")

    def put(self, t: Table, look: Look, r: float, ends: Ends, back: bool = False) -> Table:
        """Puts it down, towards +y or back; the table behind it."""
        t = t.spun("x", np.pi) if back else t
        solid, far = look.bent(t.style, r, self.radius * r, self.turn * np.pi, ends)
        t.add("elbow", solid)
        t = t.moved(far)
        return t.spun("x", np.pi) if back else t


class Loop(_Row, name="elbow/loop of a kit", label="elbow", bundle="elbow", weight=1):
    """Four bends of a kit with spools between them, round an obstacle, each with its flanges in one mesh."""

    bend: _Bend = nested(_Bend, "its bends")
    roll: float = among(_QUARTERS, _ROLL)
    slant: float = between(0.3, 5.0, "length of the spools aside / diameter")
    wide: float = between(0.3, 8.0, "length of the spool between them / diameter")
    close: bool = chance(0.25, "bends meet without spools aside")

    def fitted(self, t: Table, r: float) -> Table:
        t = t.spun("x", self.roll * np.pi)
        between_them = (0.0 if self.close else self.slant, self.wide, 0.0 if self.close else self.slant)
        for k, back in enumerate((False, True, True, False)):
            if k:
                self.joined(t, r)
            if k and between_them[k - 1]:
                t = self.spool(t, r, between_them[k - 1], (self.beside, self.beside), _LONGEST if k == 2 else _ASIDE)
                self.joined(t, r)
            t = self.bend.put(t, self.look, r, self.own, back)
        return t.spun("x", -self.roll * np.pi)


class CollaredLoop(Loop, name="elbow/loop with collars", weight=0.6, sizes=_SOCKETS):
    """Four bends with thick sockets at their ends and pipe between them, round an obstacle."""

    look: Look = nested(_Collared, "how its pieces are drawn")
    rims: str = given("fittings", "what has rims")


class Turn(_Kit, name="elbow/turn of a kit", place="end", label="elbow", bundle="elbow", weight=0.75):
    """One to three bends of a kit with spools between them, on a pipe's end."""

    count: int = whole(1, 3, "bends")
    bends: tuple[_Bend, ...] = several(lambda rng, _: _Bend.draw(rng), lambda p: p.count, "its bends")
    rolls: tuple[float, ...] = several(
        lambda rng, _: _QUARTERS[int(rng.integers(4))], lambda p: p.count, "turn of each about the pipe / half a turn"
    )
    spools: tuple[float, ...] = each(_stretch, lambda p: p.count, "length of the spool behind each / diameter")
    close: bool = chance(0.3, "no spools but the last")
    end: str = among(("open", "open", "rim", "lid"), "what its end is")

    def build(self, t: Table) -> Model:
        r = t.pipe.radius
        for k, (bend, roll, long) in enumerate(zip(self.bends, self.rolls, self.spools, strict=True)):
            # None goes on the way of the one before it, which would lead back into the line.
            t = bend.put(t.spun("x", (max(roll, 0.5) if k else roll) * np.pi), self.look, r, self.own)
            last = k == self.count - 1
            self.joined(t, r)
            if last or not self.close:
                t = self.spool(t, r, min(long, 8.0), (self.beside, self.end != "open" if last else self.beside))
                if not last or self.end == "lid":
                    self.joined(t, r)
        if self.end == "lid":
            rim = self.look.rim
            lid = disc(rim.wide * r, 0.0, rim.plate(r), t.style)
            t.add("blind flange", lying(lid), of="flange")
        return t.model()


class CollaredTurn(Turn, name="elbow/turn with collars", weight=0.5, sizes=_SOCKETS):
    """One to three bends with thick sockets at their ends on a pipe's end."""

    look: Look = nested(_Collared, "how its pieces are drawn")
    rims: str = given("fittings", "what has rims")
    end: str = given("open", "what its end is")


# --- branches ---


class _Branched(_Row):
    """A fitting with branches, of crossed cylinders or in one skin, with its flanges in the same mesh."""

    arms: ClassVar[int] = 1

    steps: int = among((0, 0, 1, 2), "how many nominal sizes smaller its branches are")
    lean: float = given(0.5, _LEAN)
    more: float = between(0.0, 1.5, "how much longer its arms are than they must be / radius of the pipe")
    roll: float = among(_QUARTERS, _ROLL)
    end: str = among(("open", "spool", "spool", "lid"), "what is on its branches")
    far: float = between(0.5, 6.0, "length of the spool on them / diameter", when=lambda p: p.end == "spool")

    def fitted(self, t: Table, r: float) -> Table:
        t, look, angle, rims = t.spun("x", self.roll * np.pi), self.look, self.lean * np.pi, any(self.own)
        branch = PIPES[smaller(self.dn, self.steps)].radius
        bare = 1.5 * r + 0.6 * r / float(np.tan(angle / 2))
        reach = (look.reach(r, angle) if rims else bare) + self.more * r
        before = max(look.reach(r, np.pi - angle) if rims else 0.0, 1.4 * r) + self.more * r
        if self.lean == 0.5:
            before = reach = max(before, reach)
        ways = [at(before) @ spun("z", turn) for turn in (angle, -angle)[: self.arms]]
        t.add(self.label, *self._body(t, (r, branch), (before, reach), ways))
        for way in ways:
            self._further(t.moved(way).at(reach), branch)
        return t.at(before + reach).spun("x", -self.roll * np.pi)

    def _body(
        self, t: Table, radii: tuple[float, float], reach: tuple[float, float], ways: Sequence[Floats]
    ) -> list[Solid]:
        """The run with its branches; what is before and behind the middle [m]."""
        (r, branch), look, style, (first, last) = radii, self.look, t.style, self.own
        hollow = look.bored and style.hollow
        n, length = look.n(style, r), sum(reach)
        if self.lean == 0.5 and not look.crossed and n % 4 == 0:
            bores = [(1 - look.wall) * one if hollow else 0.0 for one in radii]
            body = crossing((r, bores[0]), (branch, bores[1]), reach[0], n, [0.0, np.pi][: self.arms])
            rims = [(first, r, at()), (last, r, at(length) @ _BACK)]
            rims += [(last, branch, way @ at(reach[1]) @ _BACK) for way in ways]
            return [body, *(moved(look.lone(style, size), way) for there, size, way in rims if there)]
        run = look.straight(style, r, length, (first, last))
        start = min(0.45 * r / float(np.sin(self.lean * np.pi)), 0.5 * reach[1]) if hollow else 0.0
        arm = look.straight(style, branch, reach[1] - start, (False, last))
        return [run, *(moved(arm, way @ at(start)) for way in ways)]

    def _further(self, t: Table, r: float) -> None:
        """What is on a branch of a radius [m]."""
        if self.end != "open":
            self.joined(t, r)
        if self.end == "spool":
            self.spool(t, r, self.far, (self.beside, True), _ASIDE)
        elif self.end == "lid":
            rim = self.look.rim
            t.add("blind flange", lying(disc(rim.wide * r, 0.0, rim.plate(r), t.style)), of="flange")


class KitTee(_Branched, name="tee/piece of a kit", label="tee", bundle="tee", weight=1.5):
    """A tee with flanges at its ends in one mesh, in a line, at times with spools of its kit."""


class CollaredTee(KitTee, name="tee/with collars", weight=1, sizes=_SOCKETS):
    """A tee with thick sockets at its ends in one mesh."""

    look: Look = nested(_Collared, "how its pieces are drawn")
    rims: str = given("fittings", "what has rims")
    end: str = among(("open", "spool", "spool"), "what is on its branches")


class KitLateral(_Branched, name="tee/lateral of a kit", label="tee", bundle="tee", weight=0.75):
    """A tee with a slanted branch and flanges at its ends in one mesh."""

    lean: float = among((0.25, 0.25, 1 / 3), _LEAN)


class KitCross(_Branched, name="cross/piece of a kit", label="cross", bundle="cross", weight=0.6):
    """A cross with flanges at its ends in one mesh."""

    arms = 2


class CollaredCross(KitCross, name="cross/with collars", sizes=_SOCKETS, weight=0.4):
    """A cross with thick sockets at its ends in one mesh."""

    look: Look = nested(_Collared, "how its pieces are drawn")
    rims: str = given("fittings", "what has rims")
    end: str = among(("open", "spool", "spool"), "what is on its branches")


# --- straight pieces ---


class Taper(_Row, name="reducer/pieces of a kit", label="reducer", bundle="reducer", sizes=SIZES[2:], weight=1):
    """A reducer, a narrow spool and a reducer back, each with its flanges in one mesh."""

    steps: int = whole(1, 3, "how many nominal sizes smaller the spool is")
    stretch: float = between(0.8, 4.0, "(length of a reducer - that of its rims) / radius of the pipe")
    flat: bool = chance(0.25, "one side is flat")
    far: float = between(0.5, 8.0, "length of the narrow spool / diameter")

    def fitted(self, t: Table, r: float) -> Table:
        look, small = self.look, PIPES[smaller(self.dn, self.steps)].radius
        first, last = self.own
        length = self.stretch * r + look.least(r, (first, last))
        drop = r - small if self.flat else 0.0
        solid = look.tapered(t.style, (r, small), length, drop, (first, last))
        t.add("reducer", solid)
        t = t.at(length, 0, -drop)
        self.joined(t, small)
        t = self.spool(t, small, self.far, (self.beside, self.beside))
        self.joined(t, small)
        t.at(length).moved(_BACK).add("reducer", solid)
        return t.at(length, 0, drop)


class CollaredTaper(Taper, name="reducer/with collars", sizes=_SOCKETS[2:]):
    """A reducer with thick sockets at its ends, a narrow pipe and a reducer back."""

    look: Look = nested(_Collared, "how its pieces are drawn")
    rims: str = given("fittings", "what has rims")


class Spools(_Kit, name="pipe/spools of a kit", label="pipe", bundle="pipe", weight=1.5):
    """One to four straight pieces of pipe, short and long, with flanges at both ends or one in one mesh."""

    rims: str = given("both", "what has rims")
    count: int = whole(1, 4, "pieces")
    lengths: tuple[float, ...] = each(_stretch, lambda p: p.count, "length of each / diameter")
    ends: str = among(("both", "both", "first", "last", "outer"), "which ends of a piece have flanges")

    def build(self, t: Table) -> Model:
        begin = t
        for k, long in enumerate(self.lengths):
            if k:
                self.joined(t, t.pipe.radius)
            outer = self.ends == "outer"
            first = self.ends in ("both", "first") or (outer and k == 0)
            last = self.ends in ("both", "last") or (outer and k == self.count - 1)
            t = self.spool(t, t.pipe.radius, long, (first, last))
        return t.model(round(float(t.frame[0, 3] - begin.frame[0, 3]), 9), "welded", split=True)


class Sockets(_Kit, name="coupling/pair of collars", label="coupling", bundle="coupling", sizes=_SOCKETS, weight=0.6):
    """A short piece with a thick collar at each end, or one collar all over, in one mesh."""

    look: Look = nested(_Collared, "how it is drawn")
    rims: str = given("fittings", "what has rims")
    gap: float = among((0.0, 0.0, 0.15, 0.4), "length between its collars / radius of the pipe")

    def build(self, t: Table) -> Model:
        r = t.pipe.radius
        length = self.look.least(r, self.own) + self.gap * r
        t.add("coupling", self.look.straight(t.style, r, length, self.own), of="pipe")
        return t.model(round(length, 9), "welded")


class Pieces(
    Device,
    name="pipe/plain pieces",
    place="inline",
    group="Pipe assembly",
    label="pipe",
    bundle="pipe",
    grain="fitting",
    weight=1.25,
):
    """One to three plain pieces of pipe end to end, from much shorter than wide to very long, of few sides."""

    sides: int = among((0, 6, 6, 8, 8, 10, 12), "sides; 0: as the style has them")
    bored: bool = chance(0.5, "bores, where the style models any")
    wall: float = between(0.04, 0.2, "thickness of the wall / radius", when=lambda p: p.bored)
    count: int = whole(1, 3, "pieces")
    lengths: tuple[float, ...] = each(
        lambda rng, *_: float(np.exp(rng.uniform(np.log(0.15), np.log(25.0)))),
        lambda p: p.count,
        "length of each / diameter",
    )

    def build(self, t: Table) -> Model:
        r, x = t.pipe.radius, 0.0
        for stretch in self.lengths:
            high = x + min(stretch * 2 * r, _LONGEST)
            bore = (1 - self.wall) * r if self.bored and t.style.hollow else 0.0
            t.add("pipe", lying(ring(bore, r, x, high, self.sides or t.n(r))))
            x = high
        return t.model(round(x, 9), "welded", split=True)


class Stub(_Kit, name="pipe/stub of a kit", place="end", label="pipe", bundle="pipe", weight=0.6):
    """A piece of pipe on a pipe's end with a flange, a lid or a blank in the same mesh at its end, or just open."""

    rims: str = given("both", "what has rims")
    long: float = between(0.4, 10.0, "length / diameter")
    first: bool = chance(0.4, "a flange at its beginning")
    last: bool = chance(0.6, "a flange at its end")
    lid: bool = chance(0.3, "a blind flange on that", when=lambda p: p.last)

    def build(self, t: Table) -> Model:
        r, rim = t.pipe.radius, self.look.rim
        t = self.spool(t, r, self.long, (self.first, self.last))
        if self.lid:
            t.add("blind flange", lying(disc(rim.wide * r, 0.0, rim.plate(r), t.style)), of="flange")
        return t.model()


# --- with clamps ---


class _Ferruled(Look):
    """Hygienic pieces with a thin rim at their ends."""

    rim: Ferrule = nested(Ferrule, "ferrules")


class _Clamped(_Kit, sizes=_HYGIENIC):
    """Pieces with ferrules that clamps hold together."""

    look: Look = nested(_Ferruled, "how its pieces are drawn")
    rims: str = given("both", "what has rims")
    single: bool = given(False, "a fitting has a rim at its first end only")
    band: Band = nested(Band, "its clamps")
    clamped: bool = chance(0.9, "clamps hold its pieces")

    def joined(self, t: Table, r: float) -> None:
        """Puts down a clamp."""
        if self.clamped:
            rim = self.look.rim
            self.band.build(t, 0.0, rim.wide * r, 2 * rim.plate(r), r, self.look.sides)


class ClampedTurn(_Clamped, Turn, name="elbow/clamped turn", weight=0.35):
    """One to three hygienic bends with ferrules in one mesh and clamps between them, on a pipe's end."""


class ClampedTee(_Clamped, KitTee, name="tee/clamped", weight=0.6):
    """A hygienic tee with ferrules in one mesh, and clamps."""

    lead: float = among((0.7, 1.5, 3.0), "length of the spool at either end / diameter")


class ClampedTaper(_Clamped, Taper, name="reducer/clamped", sizes=_HYGIENIC[2:], weight=0.4):
    """A hygienic reducer with ferrules, a narrow spool and a reducer back, with clamps."""


class ClampedSpools(_Clamped, Spools, name="pipe/clamped spools", weight=0.6):
    """One to four hygienic pieces of tube with ferrules in one mesh, and clamps where they meet."""

    ends: str = given("both", "which ends of a piece have flanges")


KIT_FITTINGS: tuple[Family, ...] = families_of(
    Loop, CollaredLoop, Turn, CollaredTurn, KitTee, CollaredTee, KitLateral, KitCross, CollaredCross, Taper,
    CollaredTaper, Spools, Sockets, Pieces, Stub, ClampedTurn, ClampedTee, ClampedTaper, ClampedSpools,
)  # fmt: skip
