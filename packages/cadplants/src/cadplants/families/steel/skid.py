"""Skid frames: welded, folded, caged, palletised; with lifting eyes, fork pockets, drip trays, posts and feet."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import number, of_form
from cadplants.builder.params import Params, among, between, chance, given, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.steel.shape import (
    Section,
    Structure,
    bar,
    bolts,
    few_sides,
    grid,
    lug,
    pipe,
    rect,
    ribbon,
    section,
    slab_xy,
    slab_xz,
    slab_yz,
    span_of,
)
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, CORNERS, box, cylinder, ring, turned
from cadplants.solids.transforms import at, spun

__all__ = ["SKIDS"]

_SKID = "skid frame"


def _frame(a: float, b: float, one: Section, ties: int) -> tuple[list[Solid], float]:
    """Two runners along x, ends and cross members between them, from z = 0 up; and the height of their top [m]."""
    x0, x1, y0, y1 = span_of(one)
    level, half = -y0, (x1 - x0) / 2
    outer = bar((a / 2, b / 2, level), (-a / 2, b / 2, level), one)
    # The other runner is its mirror image, so that channels turn their backs outward on both sides.
    runners = [outer, moved(outer, np.diag([1.0, -1.0, 1.0, 1.0]))]
    reach = b / 2 - half
    for x in np.linspace(-a / 2 + half, a / 2 - half, ties):
        runners.append(bar((x, -reach, level), (x, reach, level), one))
    return runners, y1 - y0


class Deck(Params):
    """What lies on a frame: nothing, a plate, a plate with openings, a grating, a chequered plate."""

    form: str = among(("bare", "plate", "openings", "grating", "plate"), "what it is")
    radii: tuple[float, ...] = several(number(0.03, 0.08), 2, "of an opening", "m", when=of_form("openings"))
    called: str = among(
        ("plate", _SKID), "what a plate is called", when=lambda p: p.form in ("plate", "openings"), otherwise=""
    )

    def build(self, t: Table, a: float, b: float) -> float:
        """Puts it down on z = 0, of two sides; the height of its top [m]."""
        if self.form == "bare":
            return 0.0
        if self.form == "grating":
            counts = int(np.clip(a / 0.1, 4, 14)), int(np.clip(b / 0.04, 5, 20))
            t.add("grating", grid(a, b, 0.03, counts, (0.006, 0.004)), of="clamp")
            return 0.03
        n = few_sides(t.style, 0.08)
        holes = tuple(circle(r, n, (s * 0.25 * a, 0.0)) for r, s in zip(self.radii, BOTH, strict=False))
        own = t.bundled("" if self.called == "plate" else _SKID)
        own.add(self.called, slab_xy(rect(a, b), 0.0, 0.008, holes))
        return 0.008


class Lugs(Params):
    """Lifting eyes on top of the corners, or trunnions of pipe at the sides, or none."""

    form: str = among(("none", "eyes", "trunnions"), "what they are")
    size: float = between(0.06, 0.11, "width of an eye", "m", when=of_form("eyes"))

    def build(self, t: Table, a: float, b: float) -> None:
        """Puts them down on a frame of two sides whose top is on z = 0 [m]."""
        n = few_sides(t.style, 0.04, 16)
        stub = [cylinder(0.04, 0, 0.1, n), ring(0.03, 0.06, 0.1, 0.112, n)]
        for sx, sy in CORNERS:
            if self.form == "eyes":
                t.at(sx * (a / 2 - 0.09), sy * b / 2).add("lifting lug", lug(t.style, self.size, 0.015), of="steel")
            elif self.form == "trunnions":
                side = t.at(sx * 0.35 * a, sy * b / 2, -0.08).along("y" if sy > 0 else "-y")
                side.add("lifting lug", *stub, of="steel")


_BARS = "panel stand", "frame", "plinths"


class Payload(Params):
    """Steel that stands on a skid: a panel stand, an upright frame, plinths, a railing bow; or nothing."""

    decked: bool = given(True, "whether it stands on a deck")
    form: str = among(
        lambda p: ("nothing", "panel stand", "frame", "plinths", "bow") if p.decked else ("nothing", "plinths"),
        "what it is",
    )
    size: float = between(0.05, 0.08, "height of its section", "m", when=of_form(*_BARS))
    shape: str = among(("SHS", "U", "L", "CHS", "strut"), "its section", when=of_form(*_BARS))
    height: float = between(0.6, 1.8, "of what stands there", "m", when=of_form("panel stand", "frame", "bow"))
    braced: bool = chance(0.5, "the frame is braced", when=of_form("frame"))

    @classmethod
    def on(cls) -> Payload:
        """The field of what may have a deck."""
        return nested(cls, "what stands on it", fixed=lambda p: {"decked": p.deck.form != "bare"})

    def build(self, t: Table, a: float, b: float) -> None:
        """Puts it down on z = 0, within two sides [m]."""
        h = self.height
        if self.form == "bow":
            path = [(s * 0.4 * a, -0.45 * b, z) for s, z in ((-1, 0), (-1, h), (1, h), (1, 0))]
            t.add("railing", pipe(path, 0.021, t.style, 0.12))
        if self.form not in _BARS:
            return
        one = section(self.shape, self.size, t.style)
        _x0, _x1, y0, y1 = span_of(one)
        if self.form == "panel stand":
            x = 0.35 * a
            t.add_each("post", [bar((x, s * 0.3 * b, 0), (x, s * 0.3 * b, h), one) for s in BOTH])
            t.add("plate", box((0.004, 0.7 * b, 0.5 * h), (x - y0 + 0.002, 0, 0.7 * h)), of="clamp")
        elif self.form == "frame":
            x, y, level = 0.44 * a, 0.42 * b, h + y1
            t.add_each("column", [bar((sx * x, sy * y, 0), (sx * x, sy * y, h), one) for sx, sy in CORNERS])
            t.add_each("beam", [bar((-x, s * y, level), (x, s * y, level), one) for s in BOTH])
            t.add_each("beam", [bar((s * x, -y, level), (s * x, y, level), one) for s in BOTH])
            thin = section("L", 0.04, t.style)
            t.add_each("brace", [bar((-x, s * y, 0), (x, s * y, h), thin) for s in BOTH if self.braced])
        else:
            t.add_each("beam", [bar((s * 0.2 * a, -0.5 * b, -y0), (s * 0.2 * a, 0.5 * b, -y0), one) for s in BOTH])


class Welded(Structure, name="skid frame/welded", weight=2.0):
    """A skid of welded I, channel or hollow sections with cross members and sledge ends (common package practice)."""

    length: float = between(1.0, 4.0, "of the skid", "m")
    width: float = between(0.6, 2.0, "of the skid", "m")
    size: float = between(0.08, 0.22, "height of the section", "m")
    shape: str = among(("H", "I", "U", "RHS", "SHS", "IPN"), "section")
    ties: int = whole(2, 5, "cross members")
    toed: bool = chance(0.35, "sledge ends on the runners")
    joined: bool = chance(0.3, "the frame is one mesh")
    deck: Deck = nested(Deck, "what lies on it")
    lugs: Lugs = nested(Lugs, "what it is lifted by")
    payload: Payload = Payload.on()
    bolted: bool = chance(0.4, "bolted down by plates at its corners")

    def build(self, t: Table) -> Model:
        a, b, one = self.length, self.width, section(self.shape, self.size, t.style)
        solids, top = _frame(a, b, one, self.ties)
        if self.toed:
            toe = slab_xz([(0, 0.0), (0.25, 0.6 * top), (0.25, top), (0, top)], 0.06)
            poses = [at(sx * a / 2, sy * b / 2) @ spun("z", 0 if sx > 0 else np.pi) for sx, sy in CORNERS]
            solids += [moved(toe, pose) for pose in poses]
        t.bundled(_SKID).add_each(_SKID, solids, joined=self.joined)
        up = t.at(0, 0, top)
        deck = self.deck.build(up, a, b)
        self.lugs.build(up, a, b)
        self.payload.build(up.at(0, 0, deck), a, b)
        if self.bolted:
            x, y = a / 2 - 0.08, b / 2 + 0.06 - span_of(one)[0]
            spots = [at(sx * x, sy * y, 0.012) for sx, sy in CORNERS]
            t.add_each("base plate", [moved(box((0.12, 0.12, 0.012), (0, 0, -0.006)), spot) for spot in spots])
            bolts(t, spots, 0.016, 0.012)
        return t.model()


class Forked(Structure, name="skid frame/fork pockets", weight=1.3):
    """A channel frame with forklift pockets (hollow sections through the runners) and a deck."""

    length: float = between(0.8, 2.4, "of the frame", "m")
    width: float = between(0.7, 1.5, "of the frame", "m")
    size: float = between(0.12, 0.2, "height of the section", "m")
    shape: str = among(("U", "RHS"), "section")
    pocket: float = among((0.15, 0.2), "width of a pocket", "m")
    deck: Deck = nested(Deck, "what lies on it")
    payload: Payload = Payload.on()

    def build(self, t: Table) -> Model:
        a, b, h, one = self.length, self.width, self.size, section(self.shape, self.size, t.style)
        solids, top = _frame(a, b, one, 2)
        pocket = rect(self.pocket, 0.6 * h), (rect(self.pocket - 0.016, 0.6 * h - 0.016),)
        reach, apart = b / 2 - span_of(one)[0] + 0.01, min(0.28 * a, 0.45)
        solids += [bar((s * apart, -reach, h / 2), (s * apart, reach, h / 2), pocket) for s in BOTH]
        t.bundled(_SKID).add_each(_SKID, solids)
        up = t.at(0, 0, top)
        self.payload.build(up.at(0, 0, self.deck.build(up, a, b)), a, b)
        return t.model()


class Cage(Structure, name="skid frame/cage", weight=1.3, grain="fitting"):
    """A frame of a box: base of tubes, corner columns, top rails, braces; or with ISO 1161 corners."""

    length: float = between(0.6, 3.0, "of the box", "m")
    width: float = between(0.5, 1.6, "of the box", "m")
    height: float = between(0.6, 2.2, "of the box", "m")
    iso: bool = chance(0.4, "with container corners")
    size: float = between(0.06, 0.12, "height of the section", "m")
    shape: str = among(lambda p: ("SHS",) if p.iso else ("SHS", "SHS", "L", "U"), "section")
    ties: int = whole(2, 4, "cross members with the ends")
    braced: bool = chance(0.5, "with braces")
    brace: str = among(("flat", "L", "CHS"), "section of the braces", when=lambda p: p.braced)
    floored: bool = chance(0.4, "a plate in it")

    def build(self, t: Table) -> Model:
        a, b, h, one, half = (
            self.length,
            self.width,
            self.height,
            section(self.shape, self.size, t.style),
            self.size / 2,
        )
        c = 0.162 if self.iso else 0.0
        xs, ys, low, end = (-a / 2, a / 2), (-b / 2, b / 2), c / 2 or half, c or 2 * half
        for x in xs:
            for y in ys:
                t.add("column", bar((x, y, end), (x, y, h - end), one))
                for z, name in ((c / 2, _SKID), (h - c / 2, "lifting lug")) if self.iso else ():
                    t.add(name, box((c, c, c), (x, y, z)), box((0.08, c + 0.004, 0.05), (x, y, z)), of="clamp")
        g, reach = c / 2, b / 2 - max(c / 2, half)
        for z, name in ((low, _SKID), (h - low, "beam")):
            t.add_each(name, [bar((xs[0] + g, y, z), (xs[1] - g, y, z), one) for y in ys])
            t.add_each(name, [bar((x, -reach, z), (x, reach, z), one) for x in xs])
        for x in np.linspace(*xs, self.ties)[1:-1]:
            t.add(_SKID, bar((x, ys[0] + half, low), (x, ys[1] - half, low), one))
        if self.braced:
            thin = section(self.brace, 0.04, t.style)
            x, z = a / 2 - half, low + half
            t.add_each("brace", [bar((-x, y, z), (x, y, h - z), thin) for y in ys])
        if self.floored:
            plate = box((a - self.size, b - self.size, 0.006), (0, 0, low + half - 0.004))
            t.add("plate", plate, of="clamp")
        return t.model()


class Tray(Structure, name="skid frame/drip tray", weight=1.2):
    """A drip tray as a base: a folded pan on feet or runners with a grating or bearers in it and a drain."""

    length: float = between(0.6, 2.4, "of the tray", "m")
    width: float = between(0.5, 1.4, "of the tray", "m")
    deep: float = between(0.06, 0.25, "depth of the tray", "m")
    low: float = between(0.05, 0.15, "height of its underside", "m")
    feet: bool = chance(0.5, "on feet, not runners")
    deck: Deck = nested(Deck, "what lies in it")

    def build(self, t: Table) -> Model:
        a, b, deep, low, thick = self.length, self.width, self.deep, self.low, 0.004
        half = [(b / 2, 0.0), (b / 2, deep), (b / 2 + 0.02, deep - 0.02)]
        lip = ribbon([*((-y, z) for y, z in half[::-1]), *half], thick, 0.01, 2)
        ends = [box((thick, b + thick, deep), (s * (a / 2 + thick / 2), 0, low + deep / 2)) for s in BOTH]
        own = t.bundled(_SKID)
        own.add(_SKID, moved(slab_yz(lip, a, 0.0), at(0, 0, low)), *ends)
        if self.feet:
            spots = [(sx * 0.42 * a, sy * 0.4 * b, low / 2 - thick / 2) for sx, sy in CORNERS]
            t.add_each("post", [box((0.06, 0.06, low), spot) for spot in spots])
        else:
            tall = low - thick / 2
            own.add_each(_SKID, [box((a, 0.06, tall), (0, s * 0.38 * b, tall / 2)) for s in BOTH])
        size = (0.05, b - thick, deep - 0.03)
        t.add_each("beam", [box(size, (x, 0, low + size[2] / 2)) for x in np.linspace(-0.35 * a, 0.35 * a, 3)])
        self.deck.build(t.at(0, 0, low + deep - 0.03), a - 0.03, b - 0.03)
        return t.model()


class Pallet(Structure, name="skid frame/pallet", weight=0.8):
    """A pallet: timber (EN 13698-1), steel with a folded deck, or plastic with nine feet."""

    size: tuple[float, float] = among(((1.2, 0.8), (1.2, 1.0), (0.8, 0.6), (1.1, 1.1)), "length and width", "m")
    material: str = among(("timber", "steel", "plastic"), "what it is of")
    board: float = among((0.1, 0.145), "width of a board", "m", when=lambda p: p.material == "timber")
    sides: int = among((4, 12), "sides of a foot", when=lambda p: p.material == "plastic")
    joined: bool = chance(0.4, "in one mesh")
    payload: Payload = nested(Payload, "what stands on it")

    def build(self, t: Table) -> Model:
        a, b = self.size
        solids, of, top = {"timber": self._timber, "steel": self._steel, "plastic": self._plastic}[self.material](a, b)
        t.bundled("" if self.joined else _SKID).add_each(_SKID, solids, of=of, joined=self.joined)
        self.payload.build(t.at(0, 0, top), 0.9 * a, 0.9 * b)
        return t.model()

    def _timber(self, a: float, b: float) -> tuple[list[Solid], str, float]:
        wide, xs = self.board, (-a / 2 + 0.0725, 0, a / 2 - 0.0725)
        three, five = (np.linspace(-b / 2 + wide / 2, b / 2 - wide / 2, n) for n in (3, 5))
        solids = [box((a, 0.1, 0.022), (0, y, 0.011)) for y in three]
        solids += [box((0.145, 0.1, 0.078), (x, y, 0.061)) for x in xs for y in three]
        solids += [box((0.145, b, 0.022), (x, 0, 0.111)) for x in xs]
        return solids + [box((a, wide, 0.022), (0, y, 0.133)) for y in five], "safety", 0.144

    def _steel(self, a: float, b: float) -> tuple[list[Solid], str, float]:
        hat = ribbon(outline(-0.09, 0.1, -0.05, 0.1, -0.05, 0.0, 0.05, 0.0, 0.05, 0.1, 0.09, 0.1), 0.003)
        solids = [moved(slab_yz(hat, a), at(0, y, 0.0015)) for y in (-b / 2 + 0.09, 0, b / 2 - 0.09)]
        return [*solids, box((a, b, 0.003), (0, 0, 0.1045))], "clamp", 0.106

    def _plastic(self, a: float, b: float) -> tuple[list[Solid], str, float]:
        foot = turned([(0.06, 0), (0.075, 0.11)], self.sides, np.pi / 4)
        feet = [moved(foot, at(x, y)) for x in (-0.42 * a, 0, 0.42 * a) for y in (-0.4 * b, 0, 0.4 * b)]
        return [*feet, slab_xy(rounded_rectangle(a, b, 0.04, 3), 0.11, 0.15)], "motor", 0.15


class Folded(Structure, name="skid frame/folded"):
    """A base of one sheet: a bent channel plate with flanges, holes and slots, on rubber feet (small units)."""

    length: float = between(0.4, 1.6, "of the base", "m")
    width: float = between(0.25, 0.7, "of the base", "m")
    high: float = between(0.05, 0.12, "height of the sheet's fold", "m")
    thick: float = between(0.003, 0.008, "thickness of the sheet", "m")
    flange: float = between(0.02, 0.05, "width of a flange", "m")
    outward: bool = chance(0.5, "its flanges are turned outward")
    foot: float = among((0.0, 0.025, 0.06), "height of a foot", "m")

    def build(self, t: Table) -> Model:
        a, b, h, thick, low = self.length, self.width, self.high, self.thick, self.foot + self.thick / 2
        flange, own = self.flange if self.outward else -self.flange, t.bundled(_SKID)
        half = [(b / 2 + flange, 0), (b / 2, 0), (b / 2, h)]
        line = ribbon([*half, *((-y, z) for y, z in half[::-1])], thick, 0.012, 2)
        own.at(0, 0, low).add(_SKID, slab_yz(line, a))
        size = (0.004, b - 2 * thick, h - thick)
        own.add_each(_SKID, [box(size, (s * (a / 2 - 0.03), 0, low + h / 2)) for s in BOTH])
        if low > 0.02:
            foot = outline(0.02, 0, 0.024, 0.3 * low, 0.016, low - thick / 2)
            puck = turned(foot, few_sides(t.style, 0.02, 14))
            for sx, sy in CORNERS:
                t.at(sx * 0.42 * a, sy * (b / 2 + flange / 2)).add("base plate", puck, of="rubber")
        z = low + h + thick / 2 + 0.015
        t.add_each("plate", [box((0.15 * a, 0.5 * b, 0.03), (x, 0, z)) for x in (-0.25 * a, 0.2 * a)])
        return t.model()


class Sledge(Structure, name="skid frame/sledge"):
    """A sledge: runners of pipe with mitred ends or of timber, cross pipes, a deck and a tow bar (field units)."""

    length: float = between(1.2, 4.0, "of a runner", "m")
    width: float = between(0.8, 1.8, "from runner to runner", "m")
    radius: float = between(0.05, 0.11, "of a runner", "m")
    timber: bool = chance(0.3, "of timber, not pipe")
    ties: int = whole(3, 5, "cross members")
    deck: Deck = nested(Deck, "what lies on it")
    payload: Payload = Payload.on()

    def build(self, t: Table) -> Model:
        a, b, r, timber, own = self.length, self.width, self.radius, self.timber, t.bundled(_SKID)
        of = "safety" if timber else "steel"
        for y in (-b / 2, b / 2):
            if timber:
                toe = [(-a / 2, 0.6 * r), (-a / 2 + 0.2, 0), (a / 2 - 0.2, 0), (a / 2, 0.6 * r), (a / 2, 2 * r)]
                own.add(_SKID, slab_xz([*toe, (-a / 2, 2 * r)], 1.6 * r, y), of=of)
            else:
                ways = ((-a / 2 - 0.25, r + 0.25), (-a / 2, r), (a / 2, r), (a / 2 + 0.25, r + 0.25))
                own.add(_SKID, pipe([(x, y, z) for x, z in ways], r, t.style, 0.15, 0.1 * r))
        tie, z, reach = section("timber" if timber else "CHS", 1.4 * r, t.style), r, b / 2 - 0.9 * r
        if timber:
            z, reach = 2.7 * r, b / 2 + 0.1
        xs = np.linspace(-0.45 * a, 0.45 * a, self.ties)
        own.add_each(_SKID, [bar((x, -reach, z), (x, reach, z), tie) for x in xs], of=of)
        if not timber:
            x, z = a / 2 + 0.2, r + 0.2
            own.add(_SKID, pipe([(x, -b / 2, z), (x, b / 2, z)], 0.7 * r, t.style))
        up = t.at(0, 0, 3.4 * r if timber else 2 * r)
        self.payload.build(up.at(0, 0, self.deck.build(up, 0.95 * a, b)), 0.9 * a, b)
        return t.model()


class MachineTable(Structure, name="frame/table", weight=1.5, grain="fitting"):
    """A small equipment frame or machine table: legs with feet, rails, a top plate, shelves, knee or cross braces."""

    length: float = between(0.35, 1.6, "from leg to leg", "m")
    width: float = between(0.3, 0.9, "from leg to leg", "m")
    height: float = between(0.3, 1.1, "of a leg", "m")
    size: float = between(0.03, 0.07, "height of the section", "m")
    shape: str = among(("SHS", "SHS", "L", "CHS", "U"), "section")
    foot: float = among((0.0, 0.05), "height of a levelling foot; 0: on plates", "m")
    low: bool = chance(0.6, "rails near the floor too")
    braced: bool = chance(0.4, "with braces")
    brace: str = among(("flat", "L", "round"), "section of the braces", when=lambda p: p.braced)
    topped: bool = chance(0.7, "a plate on top")

    def build(self, t: Table) -> Model:
        a, b, h, foot, one = self.length, self.width, self.height, self.foot, section(self.shape, self.size, t.style)
        half, n = float(np.ptp(one[0][:, 1])) / 2, few_sides(t.style, 0.03, 16)
        levelling = outline(0.03, 0, 0.03, 0.008, 0.009, 0.016, 0.009, 0.042, half, 0.042, half, 0.05)
        for sx, sy in CORNERS:
            here = t.at(sx * a / 2, sy * b / 2)
            here.add("column", bar((0, 0, foot or 0.008), (0, 0, h), one))
            if foot:
                here.add("base plate", turned(levelling, n), of="trim")
                here.add("stud", cylinder(0.007, 0.01, foot + 0.01, 8))
            else:
                here.add("base plate", box((2 * half + 0.06, 2 * half + 0.06, 0.008), (0, 0, 0.004)))
        x, y = a / 2 - 0.4 * half, b / 2 - 0.4 * half
        for z in (h - half, 0.25 * h)[: 1 + self.low]:
            t.add_each("beam", [bar((-x, s * b / 2, z), (x, s * b / 2, z), one) for s in BOTH])
            t.add_each("beam", [bar((s * a / 2, -y, z), (s * a / 2, y, z), one) for s in BOTH])
        if self.braced:
            thin, top = section(self.brace, 0.03, t.style), h - 2 * half
            t.add_each("brace", [bar((-a / 2, s * b / 2, 0.3 * h), (a / 2, s * b / 2, top), thin) for s in BOTH])
        if self.topped:
            t.add("plate", box((a + 2 * half + 0.02, b + 2 * half + 0.02, 0.01), (0, 0, h + 0.005)), of="clamp")
        return t.model()


class Grouted(Structure, name="skid frame/grouted", weight=0.8):
    """A grouted skid: channels round a concrete fill on a plinth, bolted down, with sole plates; an inertia base."""

    length: float = between(0.8, 2.4, "of the skid", "m")
    width: float = between(0.5, 1.3, "of the skid", "m")
    size: float = between(0.1, 0.2, "height of the channels", "m")
    raised: bool = chance(0.7, "on a plinth, not on springs")
    low: float = between(0.1, 0.4, "height of the plinth", "m", when=lambda p: p.raised, otherwise=0.06)

    def build(self, t: Table) -> Model:
        a, b, h, low = self.length, self.width, self.size, self.low
        solids, top = _frame(a, b, section("U", h, t.style), 2)
        t.at(0, 0, low).bundled(_SKID).add_each(_SKID, solids)
        t.add("foundation", box((a - 0.75 * h, b + 0.2 * h, 0.9 * h), (0, 0, low + 0.46 * h)))
        if self.raised:
            t.add("foundation", slab_xy(rounded_rectangle(a + 0.3, b + 0.3, 0.02, 1), 0, low))
        else:
            spring = [cylinder(0.04, 0, low, 10), cylinder(0.05, 0, 0.012, 10)]
            for sx, sy in CORNERS:
                t.at(sx * 0.4 * a, sy * b / 2).add("base plate", *spring, of="rubber")
        z = low + top - 0.08 * h + 0.01
        t.add_each("plate", [box((0.2 * a, 0.6 * b, 0.02), (s * 0.25 * a, 0, z)) for s in BOTH])
        return t.model()


SKIDS = families_of(Welded, Forked, Cage, Tray, Pallet, Folded, Sledge, Grouted, MachineTable)
