"""Strainers of further makes: Y, tee, basket, duplex, cone, foot, dirt separator, self-cleaning; along x from 0."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import Params, among, between, chance, nested, styled, whole
from cadplants.builder.table import Table, outline
from cadplants.families.piping.pot import POTS, Strainer
from cadplants.families.piping.shape import (
    BACK,
    SMALL,
    barrel,
    bolting,
    flat_flange,
    knurled,
    lathe,
    mouth,
    necks,
    pipe_x,
    prism,
    sized,
    swell_room,
)
from cadplants.model.family import Model
from cadplants.model.standards import FACE_TO_FACE, SIZES, sizes_between
from cadplants.parts.flange import plate_thickness
from cadplants.solids.mesh_ops import Solid, about_x, extrude, moved, revolve, weld
from cadplants.solids.primitives import box, cylinder, turned
from cadplants.solids.transforms import IDENTITY, at, spun

__all__ = ["STRAINERS"]

_ME = "strainer"
_DOWN = spun("y", np.pi / 2)
_HEAD = "flats of its plug's head"
_TEETH = "ribs of its rings"


class Lid(Params):
    """A bolted lid: plain with a plug, stepped with a plug, bare, or dished."""

    form: str = among(("plug", "stepped", "bare", "dished"), "how it is made")
    head: int = among((4, 6), _HEAD, when=lambda p: p.form in ("plug", "stepped"), otherwise=0)

    def build(self, t: Table, radius: float, thick: float, count: int) -> None:
        """Puts it down with its bolts, its face on 0 and looking along x [m]."""
        n, form = t.n(radius), self.form
        flat = [barrel(radius, 0.0, thick, n)]
        if form == "stepped":
            flat.append(lathe(outline(0.55 * radius, 0.9 * thick, 0.45 * radius, 1.7 * thick), n))
        if form == "dished":
            dish = outline(radius, 0.0, radius, thick, 0.7 * radius, 1.2 * thick, 0.3 * radius, 1.9 * thick)
            flat = [lathe(dish, n)]
        t.add(_ME, *flat)
        if self.head:
            high = thick if form == "plug" else 1.7 * thick
            t.add("pipe cap", prism(0.4 * radius, self.head, high, high + 0.2 * radius + 0.003), of="trim")
        t.extend(bolting(count, 0.83 * radius, 0.09 * radius + 0.004, -thick, thick, t.style, _ME))


def _mouths(t: Table, design: str, length: float, room: float) -> list[Solid]:
    """Two mouths of a design at the ends of a length, as deep as there is room [m]."""
    one = mouth(design, t.dn, t.style, 0.0, room)
    return [moved(one, at(length - room)), moved(one, at(room) @ BACK)]


class CastY(Strainer, name="strainer/Y cast", weight=1.5):
    """A cast Y strainer (EN 558 series 1): a long leaning basket housing, ribs, a bolted lid with a plug."""

    arm: float = between(1.15, 1.4, "radius of its leg, less 4 mm / radius of the pipe")
    lean: float = between(0.7, 1.0, "of its leg from the line", "rad")
    swell: float = between(1.0, 1.2, "radius of its body / of its leg")
    far: float = between(1.0, 1.25, "length of its leg / what its lid needs to clear the flange")
    ribbed: bool = chance(0.5, "a rib along its leg")
    lid: Lid = nested(Lid, "its lid")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.3)
        length, neck, low, lean = FACE_TO_FACE["globe"][t.dn], 0.485 * t.flange.hub, swell_room(t.dn), self.lean
        arm = max(neck, self.arm * r + 0.004)
        swell, x = self.swell * arm, 0.38 * length
        collar, plate = 1.3 * arm + 0.012, 0.012 + 0.07 * r
        far = self.far * ((0.5 * t.flange.outer + 0.005 + collar * np.cos(lean)) / np.sin(lean) + plate)
        body = lathe(outline(neck, low, swell, 0.35 * length, swell, 0.62 * length, neck, length - low), n)
        way = at(x) @ spun("y", lean)
        leg = [lathe(outline(arm, 0.0, 0.96 * arm, far - plate), n), barrel(collar, far - plate, far, n)]
        if self.ribbed:
            leg.append(box((0.7 * far, 0.12 * r + 0.003, 2.3 * arm), (0.62 * far, 0, 0)))
        t.add(_ME, *necks(t.dn, t.style, length), body, *(moved(solid, way) for solid in leg))
        self.lid.build(t.moved(way).at(far), collar, plate, 4 if t.dn < 80 else 8)
        return t.model(round(length, 9))


class FabricatedY(Strainer, name="strainer/Y fabricated", sizes=SIZES[2:]):
    """A Y strainer welded of pipe: a leg at 45 degrees with a flange, a blind flange and a drain."""

    behind: float = between(0.6, 1.0, "length behind its leg / 0.6 of the flange's diameter")

    def build(self, t: Table) -> Model:
        (r, n, _), size, plate = sized(t.dn, t.style), t.flange, plate_thickness(t.dn)
        far, begin, seal = 1.5 * r + 0.75 * size.outer + 0.04, 2 * r + 0.02, 0.002
        length = begin + 0.72 * far + 0.6 * size.outer * self.behind + 2 * r
        way = at(begin) @ spun("y", np.pi / 4)
        leg = [barrel(0.985 * r, 0.0, far, n), flat_flange(t.dn, t.style, far - plate, plate, 0.0)]
        t.add(_ME, pipe_x(t.dn, 0.0, length, t.style), *(moved(solid, way) for solid in leg), of="pipe")
        lid, top = t.moved(way), far + plate
        lid.add(_ME, flat_flange(t.dn, t.style, far + seal, plate, 0.0), of="pipe")
        lid.add("gasket", barrel(1.25 * r, far, far + seal, n))
        drain = barrel(0.2 * r, top, top + 0.07, 12)
        lid.add("nipple", prism(0.5 * r + 0.012, 6, top, top + 0.03), drain)
        bolts = (size.n_bolts, size.circle / 2, size.bolt, far - plate, far + seal + plate)
        lid.extend(bolting(*bolts, t.style, _ME))
        return t.model(round(length, 9), "welded")


class PlasticY(Strainer, name="strainer/Y plastic", sizes=SIZES[:8]):
    """A plastic Y strainer: union nuts at both ends, a clear cylinder leaning down under a ribbed ring."""

    teeth: int = whole(8, 16, _TEETH)
    lean: float = among((0.25, 0.3), "of its cylinder from the line / half a turn")
    tall: float = between(2.0, 3.5, "length of its cylinder / radius of the pipe")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.3)
        sock, nut, far, teeth = 1.1 * r + 0.012, 1.0 * r + 0.012, 2.2 * r + 0.02, self.teeth
        length, end = 2 * (sock + nut) + 4.0 * r + 0.02, far + self.tall * r
        way = at(0.42 * length) @ spun("y", self.lean * np.pi)
        leg = moved(lathe(outline(1.25 * r, 0.0, 1.35 * r, far), n), way)
        t.add(_ME, barrel(1.3 * r, sock, length - sock, n), leg, of="handle")
        cup = outline(1.25 * r, far, 1.2 * r, end, 0.9 * r, end + 0.4 * r, 0.3 * r, end + 0.5 * r)
        t.moved(way).add(_ME, lathe(cup, n), of="dial")
        ring = knurled(1.8 * r + 0.003, teeth, 0.14 * r, far - 0.35 * r, far + 0.6 * r, 0.0, n)
        t.moved(way).add(_ME, ring, of="rubber")
        for mouth_ in (t, t.at(length).moved(BACK)):
            mouth_.add("union", barrel(1.22 * r, 0.0, sock, n, bore), of="handle")
            mouth_.add("union", knurled(1.75 * r + 0.004, teeth, 0.12 * r, sock, sock + nut, 0.0, n), of="handle")
        return t.model(round(length, 9), "welded")


class ForgedY(Strainer, name="strainer/Y forged", sizes=SMALL):
    """A forged Y strainer (ASME B16.11 ends): a leg with a big hexagon cap and a small blow-off plug in it."""

    long: float = between(4.4, 5.6, "length, less 40 mm / radius of the pipe")
    design: str = among(("socket", "banded", "hex"), "how its mouths are made")
    lean: float = between(0.7, 0.95, "of its leg from the line", "rad")
    far: float = between(0.55, 0.7, "length of its leg, less a radius of the pipe / length of the strainer")
    head: int = among((4, 6), _HEAD)

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.3)
        length, a, b = self.long * r + 0.04, 1.2 * r, 1.35 * r
        middle = lathe(outline(a, 0.2 * length, b, 0.4 * length, b, 0.6 * length, a, 0.8 * length), n)
        way, far = at(0.34 * length) @ spun("y", self.lean), self.far * length + 1.0 * r
        leg = moved(lathe(outline(1.25 * r, 0.0, a, far), n), way)
        t.add(_ME, *_mouths(t, self.design, length, 0.32 * length), middle, leg, of="trim")
        end, t = far + 0.8 * r + 0.005, t.moved(way)
        rim = barrel(1.6 * r + 0.003, far, far + 0.2 * r, n)
        t.add(_ME, prism(2.6 * r + 0.004, 6, far, end), rim, of="trim")
        t.add("pipe cap", prism(0.8 * r + 0.003, self.head, end, far + 1.2 * r + 0.009), of="trim")
        return t.model(round(length, 9), "welded")


class Cone(Strainer, name="strainer/cone", sizes=SIZES[3:], weight=0.7):
    """A temporary cone strainer between flanges (start-up): a ring with a tab, the cone in the pipe."""

    hollow: bool = styled(True, "whether insides are modelled")
    thick: float = among((0.003, 0.005, 0.008), "thickness of its ring", "m")
    tab: float = between(0.55, 0.8, "reach of its tab / diameter of the flange")
    turn: float = among((0.5, 1.0, 1.5), "where its tab is, about the pipe / half a turn")
    long: float = between(1.0, 2.4, "length of its cone / radius of the pipe")
    pointed: bool = chance(0.6, "a pointed cone, not a blunt one", when=lambda p: p.hollow)

    def build(self, t: Table) -> Model:
        r, size, thick, wide = t.pipe.radius, t.flange, self.thick, 0.9 * t.pipe.bore
        outer, tab, long = 0.49 * (size.circle - size.bolt), self.tab * size.outer, self.long * r
        n = t.n(outer)
        inner, half = 0.97 * outer, min(0.02, 0.3 * outer)
        ear = extrude(np.array([[inner, -half], [tab, -half], [tab, half], [inner, half]]), 0.0, thick)
        ear = moved(ear, spun("x", self.turn * np.pi) @ _DOWN)
        pieces = [barrel(outer, 0.0, thick, n, wide if self.hollow else 0.0), ear]
        if self.hollow:
            tip = 0.05 * r if self.pointed else 0.45 * r
            cone = outline(wide, 0.3 * thick, wide, thick, tip + 0.002, long, tip, long, wide - 0.003, 0.3 * thick)
            pieces.append(about_x(weld([revolve(cone, n, closed=True)])))
        t.add(_ME, *pieces, of="trim")
        return t.model(round(thick, 9), "wafer")


class Foot(Strainer, name="strainer/foot", place="end", sizes=SIZES[2:], weight=1.5):
    """A suction strainer on a pipe's end: a bell with ribs, a perforated can with hoops, or a dished basket of bars."""

    wide: float = between(1.5, 2.2, "its radius, less 10 mm / radius of the pipe")
    tall: float = between(2.0, 4.5, "its length, less 30 mm / radius of the pipe")
    form: str = among(("can", "bars", "bell"), "how it is made")
    hoops: int = whole(2, 4, "hoops round a can", when=lambda p: p.form == "can")
    bars: int = whole(8, 18, "bars of a basket", when=lambda p: p.form == "bars")
    vanes: int = whole(4, 8, "vanes in a bell", when=lambda p: p.form == "bell")
    metal: str = among(("trim", "valve", "pipe"), "kind of material")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 2)
        wide, tall = self.wide * r + 0.01, self.tall * r + 0.03
        t.add(_ME, *getattr(self, f"_{self.form}")(r, n, wide, tall), of=self.metal)
        return t.model()

    def _can(self, r: float, n: int, wide: float, tall: float) -> list[Solid]:
        """A perforated can with hoops."""
        head, far = self._head(r, wide)
        end = far + tall
        places = [far + tall * (0.1 + 0.28 * k) for k in range(self.hoops)]
        hoops = [barrel(1.05 * wide, a, a + 0.008, n, 0.98 * wide) for a in places if a < end]
        return [lathe([*head, (wide, end), (0.8 * wide, end + 0.15 * wide)], n), *hoops]

    def _bars(self, r: float, n: int, wide: float, tall: float) -> list[Solid]:
        """A basket of bars round a core."""
        head, far = self._head(r, wide)
        end, bar = far + tall, (tall + 0.01, 0.05 * wide + 0.001, 0.25 * wide)
        one = box(bar, (far + 0.5 * tall, 0, 0.87 * wide))
        bars = [moved(one, spun("x", 2 * np.pi * k / self.bars)) for k in range(self.bars)]
        disc, core = barrel(wide, end, end + 0.006, n), barrel(0.7 * wide, far, end, n)
        return [lathe([*head, (wide, far + 0.006)], n), *bars, disc, core]

    def _bell(self, r: float, n: int, wide: float, tall: float) -> list[Solid]:
        """A bell with vanes over a plate."""
        a, b = 1.2 * r, wide * 1.25
        bell = outline(a, 0.0, a, 0.4 * tall, 1.45 * r, 0.7 * tall, b, tall, b, 1.05 * tall)
        vane = box((0.6 * tall, 0.006, 0.5 * wide), (0.95 * tall, 0, 0.8 * wide))
        vanes = [moved(vane, spun("x", 2 * np.pi * k / self.vanes)) for k in range(self.vanes)]
        return [lathe(bell, n), *vanes, barrel(1.2 * wide, 1.25 * tall, 1.25 * tall + 0.01, n)]

    def _head(self, r: float, wide: float) -> tuple[list[tuple[float, float]], float]:
        """The outline of a socket that widens to the basket, and how long it is [m]."""
        sock, a = 0.8 * r + 0.012, 1.25 * r + 0.002
        return outline(a, 0.0, a, sock, wide, sock + 0.5 * r), sock + 0.5 * r


class InlineCan(Strainer, name="strainer/inline can", sizes=sizes_between(most=200)):
    """A wide inline strainer: a can of larger size between cones, a clamp ring or flanges round its middle."""

    wide: float = between(1.7, 2.4, "radius of the can, less 6 mm / of the pipe")
    cone: float = between(0.8, 2.0, "length of a cone / radius of the pipe")
    tall: float = between(2.0, 4.5, "length of the can, less 30 mm / radius of the pipe")
    bolted: bool = chance(0.6, "flanges with bolts round its middle, not a clamp ring")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 2)
        wide, cone, tall, neck, thick = (
            self.wide * r + 0.006,
            self.cone * r,
            self.tall * r + 0.03,
            0.6 * r + 0.012,
            0.006 + 0.1 * r,
        )
        length, x, begin, rim = 2 * (neck + cone) + tall, neck + cone + 0.5 * tall, neck + cone, 1.22 * wide
        skin = outline(r, 0.0, r, neck, wide, begin, wide, x - thick, rim, x - thick, rim, x)
        # A can is as thin as the pipe, so that its inside widens with it.
        inside = outline(0.9 * wide, x, 0.9 * wide, begin, bore, neck, bore, 0.0)
        half = about_x(weld([revolve([*skin, *inside], n, closed=True)])) if bore else lathe(skin, n)
        for way in (t, t.at(length).moved(BACK)):
            way.add(_ME, half, of="trim")
        if self.bolted:
            t.extend(bolting(8, 1.12 * wide, 0.005 + 0.05 * r, x - thick, x + thick, t.style, _ME, IDENTITY))
        else:
            t.add("clamp", barrel(1.3 * wide, x - 1.3 * thick, x + 1.3 * thick, n, 1.21 * wide))
            t.add("bolt", box((0.02, 0.02, 0.05), (x, 0, 1.3 * wide + 0.01)), own=False)
        a, b, end = 0.25 * r, 0.35 * r, 1.25 * wide
        drain = lathe(outline(a, 0.6 * wide, a, end, b, end, b, 1.45 * wide), 12)
        t.at(x + 0.3 * tall).moved(_DOWN).add("nipple", drain, of="trim")
        return t.model(round(length, 9), "welded")


class Bowl(Strainer, name="strainer/bowl", sizes=SMALL):
    """A water strainer with a clear bowl: a head with two mouths, a hanging bowl under a ribbed ring, a drain."""

    tall: float = between(3.0, 6.0, "height of its bowl, less 60 mm / radius of the pipe")
    design: str = among(("hex", "banded"), "how its mouths are made")
    teeth: int = whole(12, 24, _TEETH)

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 2)
        bowl, length, low = 2.0 * r + 0.02, 5.2 * r + 0.06, -2.1 * r - 0.01
        x, end = 0.5 * length, low - (self.tall * r + 0.06)
        head = moved(cylinder(1.05 * bowl, -1.3 * r, 1.6 * r, n), at(x))
        t.add(_ME, *_mouths(t, self.design, length, 0.35 * length), head, of="trim")
        t = t.at(x)
        ring = knurled(1.25 * bowl, self.teeth, 0.08 * bowl, 0.0, 0.8 * r + 0.01, 0.0, n)
        t.at(0, 0, -1.3 * r).moved(_DOWN).add(_ME, ring, of="rubber")
        t.add(_ME, turned(outline(0.3 * bowl, end, 0.85 * bowl, end + 0.1 * bowl, bowl, low), n), of="dial")
        cock = [cylinder(0.3 * r + 0.003, end - 0.025, end, 10), box((0.03, 0.006, 0.01), (0.015, 0, end - 0.018))]
        t.add("valve body", *cock, of="trim", own=True)
        return t.model(round(length, 9), "welded")


STRAINERS = (*POTS, *families_of(CastY, FabricatedY, PlasticY, ForgedY, Cone, Foot, InlineCan, Bowl))
