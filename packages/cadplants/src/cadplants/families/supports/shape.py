"""Shapes that supports share: bars, straps, bows, bolts, feet, and what stands below or hangs above a line."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import Device
from cadplants.builder.draws import own_stream
from cadplants.builder.params import (
    Field,
    Params,
    Source,
    When,
    among,
    between,
    chance,
    given,
    nested,
    styled,
    whole,
)
from cadplants.builder.table import Table
from cadplants.model.standards import PIPES
from cadplants.solids.mesh_ops import Solid, about_x, extrude, merge, moved, sweep
from cadplants.solids.polygon import circle, rounded_rectangle, section_angle, section_channel, section_i
from cadplants.solids.primitives import BOTH, CORNERS, bar, box, cylinder, dome, hexagon, ring, rope, torus
from cadplants.solids.transforms import spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = [
    "Below", "Carrier", "Feet", "Fitting", "Footing", "Overhead", "Section", "Standing",
    "add_bolt", "add_nuts", "add_wall", "arc_yz", "bow", "eye", "few", "foot_of", "hung",
    "piece_of", "piecemeal", "radius", "screwed", "section_of", "shuffled", "slab_yz", "standing", "strap", "upright",
]  # fmt: skip

_GROUP = "Connection assembly"
T = TypeVar("T")
P = TypeVar("P", bound=Params)
Point = Sequence[float]
_DOWN, _QUARTER = spun("x", np.pi), spun("x", np.pi / 2)


# --- shapes ---


def few(radius: float, style: ModelingStyle, most: int = 12) -> int:
    """Sides of a thin round bar."""
    return int(np.clip(style.round(radius), 6, most))


def slab_yz(outline: Floats | Sequence[Point], low: float, high: float, holes: tuple[Floats, ...] = ()) -> Solid:
    """A plate across the line: its outline in (y, z), thick along x [m]."""
    return about_x(extrude(_wound(outline), low, high, holes))


def upright(outline: Floats | Sequence[Point], low: float, high: float, holes: tuple[Floats, ...] = ()) -> Solid:
    """A plate along the line: its outline in (x, z), thick along y from ``low`` to ``high`` [m]."""
    return moved(extrude(_wound(outline), -high, -low, holes), _QUARTER)


def _wound(outline: Floats | Sequence[Point]) -> Floats:
    """The outline counter-clockwise."""
    points = np.asarray(outline, float)
    x, y = points.T
    return points if float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) > 0 else points[::-1]


def strap(path: Floats | Sequence[Point], wide: float, thick: float, up: Point = (1.0, 0.0, 0.0)) -> Solid:
    """A flat bar bent along a path, its width along ``up`` [m]."""
    w, t = wide / 2, thick / 2
    return sweep(np.asarray(path, float), np.array([[w, -t], [w, t], [-w, t], [-w, -t]]), up=up)


def arc_yz(radius: float, first: float, last: float, steps: int, y: float = 0.0, z: float = 0.0) -> Floats:
    """``(steps + 1, 3)`` points of an arc across the line; angles from +y towards +z [rad]."""
    a = np.linspace(first, last, steps + 1)
    return np.column_stack([np.zeros(steps + 1), y + radius * np.cos(a), z + radius * np.sin(a)])


def bow(leg: float, foot: float, thick: float, style: ModelingStyle) -> Solid:
    """A U of round bar over a line: half a circle of this radius and legs down to ``foot`` [m]."""
    steps = max(6, few(leg, style, 24) // 2)
    path = [[0, leg, foot], *arc_yz(leg, 0, np.pi, steps), [0, -leg, foot]]
    return rope(path, thick, few(thick, style))


def eye(radius: float, thick: float, style: ModelingStyle) -> Solid:
    """A ring of round bar standing across y, about the origin [m]."""
    return moved(torus(radius, thick, few(radius, style, 20), few(thick, style, 8)), _QUARTER)


# --- fasteners ---


def add_nuts(t: Table, spots: Sequence[Point], d: float, washer: bool = True, twice: bool = False) -> None:
    """Nuts that press down from each spot: washer, nut (ISO 4032 proportions), maybe a lock nut behind it [m]."""
    n = few(d, t.style)
    flat = 0.16 * d if washer else 0.0
    high = flat + 0.85 * d
    for spot in spots:
        under = t.at(*spot).moved(_DOWN)
        if washer:
            under.add("washer", ring(0.55 * d, 1.05 * d, 0, flat, n))
        under.add("nut", hexagon(1.6 * d, flat, high, d / 2, n))
        if twice:
            under.add("nut", hexagon(1.6 * d, high, high + 0.5 * d, d / 2, n))


def _head(kind: str, d: float, grip: float, n: int) -> Solid:
    """The head of a bolt of diameter ``d`` over what it clamps [m]; the end of a stud."""
    if kind == "hex":
        return hexagon(1.55 * d, grip + 0.16 * d, grip + 0.16 * d + 0.65 * d)
    if kind == "none":
        return hexagon(1.55 * d, grip, grip + 0.65 * d)
    if kind == "socket":
        return cylinder(0.75 * d, grip, grip + d, n)
    if kind == "carriage":
        return dome(1.1 * d, 0.55 * d, grip, n)
    if kind == "flange":
        return merge([hexagon(1.5 * d, grip, grip + 0.8 * d), cylinder(1.1 * d, grip, grip + 0.2 * d, n)])
    return cylinder(d / 2, grip, grip + 1.35 * d, n)


def add_bolt(t: Table, d: float, grip: float, head: str = "hex", own: Sequence[str] = ()) -> None:
    """A bolt along z that clamps what lies between 0 and ``grip``; its head on top, its nut below [m].

    Args:
        t: with the frame; its style has one mesh, or bolt, nut, washers where it models every piece.
        d: diameter.
        grip: clamped thickness.
        head: ``hex`` (ISO 4014), ``stud``, ``socket`` (ISO 4762), ``carriage`` (ISO 8677), ``flange`` (EN 1665) or
            ``none`` (no nut either: a hex head only, screwed in).
        own: names of the pieces that are there; all if empty.
    """
    n, flat = few(d, t.style), 0.16 * d
    shank = cylinder(d / 2, -1.35 * d if head != "none" else -0.2 * d, grip + 0.1 * d, n)
    top = _head(head, d, grip, n)
    name = {"stud": "stud", "socket": "screw"}.get(head, "bolt")
    solids = [(name, merge([shank, top]))]
    if head != "none":
        solids.append(("nut", hexagon(1.55 * d, -flat - 0.85 * d, -flat, d / 2, n)))
        solids.append(("washer", ring(0.55 * d, d, -flat, 0, n)))
    if head in ("hex", "stud"):
        solids.append(("washer", ring(0.55 * d, d, grip, grip + flat, n)))
    if head == "stud":
        solids.append(("nut", hexagon(1.55 * d, grip + flat, grip + flat + 0.85 * d, d / 2, n)))
    if t.style.fasteners != "pieces":
        solids = [("bolt" if name == "stud" else name, merge([s for _, s in solids]))]
    for label, solid in solids:
        if not own or label in own:
            t.add(label, solid)


def screwed(t: Table, d: float, grip: float, x: float, y: float, z: float, head: str = "none") -> None:
    """A bolt whose head shows towards -y, through a plate in front of ``y`` [m]."""
    add_bolt(t.at(x, y, z).moved(_QUARTER), d, grip, head)


def add_wall(t: Table, wide: float, thick: float, y: float, low: float, high: float) -> None:
    """A wall whose face stands at ``y`` beside the line, between two heights [m]."""
    t.add("wall", box((wide, thick, high - low), (0, y + thick / 2, (high + low) / 2)))


# --- parameters ---


def radius(p: Any) -> float:
    """Radius of the line that a device with such a nominal size holds [m]."""
    return PIPES[p.dn].radius


def shuffled(items: Sequence[str], about: str) -> tuple[str, ...]:
    """Some words in some order."""

    def accept(value: Any, _: Any) -> tuple[str, ...]:
        words = tuple(value.split(",")) if isinstance(value, str) else tuple(value)
        if sorted(words) != sorted(items):
            raise ValueError(f"give {', '.join(items)} in some order")
        return words

    limits = f"{', '.join(items)} in some order"
    draw = lambda source, _: tuple(map(str, source.rng.permutation(list(items))))  # noqa: E731
    return dataclasses.field(metadata={"spec": Field(about, "", limits, draw, accept)})  # type: ignore[no-any-return]


def piece_of(kind: type[P], about: str, *said: str, when: When | None = None) -> P:
    """A field: a piece that is told some of the fields before, by their names."""
    return nested(kind, about, fixed=lambda p: {name: getattr(p, name) for name in said}, when=when)


class Feet(Params):
    """Of what has feet on the floor: what the style says of those."""

    holes: bool = styled(True, "whether plates are drilled")
    structure: str | None = styled(None, "how fine structures are")


class Carrier(Device, place="carrier", group=_GROUP, grain="structure"):
    """What holds a line."""

    height: float = given(1.1, "of the line's axis over the floor", "m")


class Standing(Carrier, Feet):
    """What holds a line and has feet, or may have."""


class Fitting(Device, place="floor", group=_GROUP, sizes=(15,), grain="fitting"):
    """Fittings that stand on the floor with what they hold together."""


_FLAT = ("wide flange", "beam", "channel", "tube")


class Section(Params):
    """The section of a bar (EN 10365, EN 10056, EN 10210 proportions)."""

    flat: bool = given(False, "level above and below")
    form: str = among(lambda p: _FLAT if p.flat else (*_FLAT, "angle", "round", "strut"), "what section it is")
    corner: float = among((0.0, 2.0), "radius of the corners / wall of the tube", when=lambda p: p.form == "tube")

    def outline(self, size: float, style: ModelingStyle) -> tuple[Floats, tuple[Floats, ...]]:
        """Its outline and holes, its top and bottom at +-size/2 [m]."""
        wall, form = 0.05 * size + 0.001, self.form
        if form == "wide flange":
            return section_i(size, size, 0.05 * size, 0.08 * size), ()
        if form == "beam":
            return section_i(size, 0.55 * size, 0.04 * size, 0.06 * size), ()
        if form == "channel":
            return section_channel(size, 0.5 * size, 0.07 * size, 0.09 * size) - (0.25 * size, 0), ()
        if form == "tube":
            inner = (rounded_rectangle(size - 2 * wall, size - 2 * wall, wall, 2),) if style.hollow else ()
            return rounded_rectangle(size, size, self.corner * wall, 3), inner
        if form == "angle":
            return np.array([1.0, -1.0]) * section_angle(size, 0.1 * size)[::-1] - (0.3 * size, -size / 2), ()
        if form == "round":
            # A corner on top, so that what lies on a coarse tube touches it.
            n = style.round(size / 2)
            bore = (circle(size / 2 - wall, n, phase=np.pi / 2),) if style.hollow else ()
            return circle(size / 2, n, phase=np.pi / 2), bore
        half = [(0.5, -0.5), (0.5, 0.5), (0.5 - 0.18, 0.5), (0.5 - 0.18, 0.32), (0.5 - 0.06, 0.32), (0.44, -0.44)]
        strut = [(-0.5, -0.5), *half, *((-x, y) for x, y in half[:0:-1])]
        return size * np.array(strut), ()


def section_of(about: str, flat: bool = False, when: When | None = None) -> Section:
    """A field: the section of a bar."""
    return nested(Section, about, fixed=lambda _: {"flat": flat}, when=when)


def piecemeal(p: Any) -> bool:
    """Whether the style makes more than one mesh of a support: then feet keep bolts and ribs of their own."""
    return bool(p.structure != "one")


class Footing(Feet):
    """A base plate for a shaft: square, round, slotted, stiffened, on grout."""

    thick: float = among((0.006, 0.01, 0.015, 0.02), "of the plate", "m")
    raised: bool = chance(0.3, "on a plinth of concrete")
    plinth: float = between(0.02, 0.08, "height of the plinth", "m", when=lambda p: p.raised)
    hole: float = among((0.006, 0.008, 0.01), "radius of a hole", "m")
    round: bool = chance(0.25, "the plate is round")
    corner: float = among((0.0, 0.01), "radius of the plate's corners", "m", when=lambda p: not p.round)
    slotted: bool = chance(0.3, "long holes", when=lambda p: p.holes and not p.round)
    bolted: bool = chance(0.6, "bolts in the holes", when=piecemeal)
    ribbed: bool = chance(0.3, "ribs from the plate to the shaft, where there is room", when=piecemeal)

    @property
    def top(self) -> float:
        """Height of its top [m]."""
        return self.plinth + self.thick

    def build(self, t: Table, side: float, shaft: float) -> None:
        """Puts it on z = 0.

        Args:
            t: with the frame.
            side: width of the plate [m].
            shaft: width of the shaft [m].
        """
        t, low, top, hole = replace(t, group="", bundle=""), self.plinth, self.top, self.hole
        if self.raised:
            t.add("foundation", box((side + 0.06, side + 0.06, low), (0, 0, low / 2)))
        if self.round:
            outline = circle(side / 2 * 1.1, t.n(side / 2, 12))
        else:
            outline = rounded_rectangle(side, side, self.corner, 3)
        reach = (0.72 if self.round else 1.0) * (side / 2 - 0.02)
        spots = [(x * reach, y * reach) for x, y in CORNERS]
        holes: tuple[Floats, ...] = ()
        if self.holes:
            slot = rounded_rectangle(2 * hole, 3.4 * hole, 0.99 * hole, 3)
            holes = tuple(slot + s if self.slotted else circle(hole, 8, s) for s in spots)
        t.add("base plate", extrude(outline, low, top, holes))
        if self.bolted:
            screw = merge([cylinder(0.9 * hole, 0.0, top + 3.2 * hole, 8), hexagon(3.0 * hole, top, top + 1.6 * hole)])
            for spot in spots:
                t.at(*spot).add("bolt", screw)
        if self.ribbed and side - shaft > 0.05:
            leg = (side - shaft) / 2 - 0.003
            rib = upright([[0, 0], [leg, 0], [leg, 0.01], [0.01, 1.3 * leg], [0, 1.3 * leg]], -0.004, 0.004)
            for k in range(4):
                t.spun("z", k * np.pi / 2).at(shaft / 2, 0, top).add("gusset plate", rib)


def _feet(p: Any) -> dict[str, Any]:
    return {"holes": p.holes, "structure": p.structure}


def foot_of(about: str = "foot", when: When | None = None) -> Footing:
    """A field: the foot of something."""
    return piece_of(Footing, about, "holes", "structure", when=when)


class _Leg(Feet):
    """A post or column with its foot."""

    margin: float = between(0.06, 0.14, "width of the foot - of the shaft", "m")
    foot: Footing = foot_of()
    flat: bool = chance(0.7, "of a section that is level above")
    section: Section = nested(Section, "section of the shaft", fixed=lambda p: {"flat": p.flat})

    def build(self, t: Table, low: float, high: float, size: float) -> None:
        """Puts it down about z, between two heights, for a shaft of this width [m]."""
        outline, holes = self.section.outline(size, t.style)
        t.add("column" if len(outline) == 12 else "post", extrude(outline, low + self.foot.top, high, holes))
        self.foot.build(t.at(0, 0, low), size + self.margin, size)


def _apart_in_pairs(source: Source, p: Any) -> Source | np.random.Generator:
    """The legs of a portal are drawn once for both."""
    return own_stream(source, p) if p.form == "portal" else source


def _block(p: Any) -> bool:
    return bool(p.form == "block")


def _on(*forms: str) -> When:
    return lambda p: p.form in forms


_BEAM = ("portal", "tee", "column", "wall")


class Below(Feet):
    """What a support stands on: a concrete block, a post with a plate, a portal, a T, an arm off column or wall."""

    free: float = given(1.0, "height of the support over the floor", "m")
    form: str = among(("block", "post", *_BEAM), "what it is", when=lambda p: p.free >= 0.3, otherwise="block")
    size: float = among((0.05, 0.06, 0.08, 0.1, 0.12), "height of a section", "m", when=lambda p: not _block(p))
    wide: float = between(0.1, 0.3, "width of the block - of the support", "m", when=_block)
    deep: float = between(0.15, 0.4, "depth of the block", "m", when=_block)
    head: float = among((0.006, 0.01, 0.012), "thickness of the post's head plate", "m", when=_on("post"))
    over: float = between(0.12, 0.5, "how far its beam reaches past the support", "m", when=_on(*_BEAM))
    section: Section = section_of("section of its beam", when=_on(*_BEAM))
    leg: _Leg = nested(
        _Leg, "its post, or each", fixed=_feet, stream=_apart_in_pairs, when=_on("post", "portal", "tee")
    )
    rise: float = between(0.1, 0.8, "of the column over the support", "m", when=_on("column"))
    thick: float = between(0.12, 0.25, "of the wall", "m", when=_on("wall"))
    long: float = between(0.5, 1.2, "of the wall", "m", when=_on("wall"))

    def build(self, t: Table, top: float, half: float) -> None:
        """Puts it down.

        Args:
            t: with the frame.
            top: height of the level face on it [m].
            half: half the support's width across the line [m].
        """
        size, low = self.size, top - self.free
        if _block(self):
            block = extrude(rounded_rectangle(self.deep, 2 * half + self.wide, 0.01, 1), low, top)
            t.add("foundation", block)
            return
        if self.form == "post":
            t.add("plate", box((max(0.1, size + 0.04), 2 * half + 0.06, self.head), (0, 0, top - self.head / 2)))
            self.leg.build(t, low, top - self.head, size)
            return
        span, z, y = half + self.over, top - size / 2, half + self.over + 0.06
        outline, holes = self.section.outline(size, t.style)
        ends = {"column": (-half - 0.05, y - 0.06), "wall": (-half - 0.05, y)}.get(self.form, (-span, span))
        t.add("beam", bar((0, ends[0], z), (0, ends[1], z), outline, holes))
        # A leg is cut out for a round beam and welded round it.
        under = top - (0.85 if self.section.form == "round" else 1.0) * size
        if self.form == "portal":
            for s in BOTH:
                self.leg.build(t.at(0, s * (span - size / 2)), low, under, size)
        elif self.form == "tee":
            self.leg.build(t, low, under, size)
        elif self.form == "column":
            t.at(0, y).add("column", extrude(section_i(0.12, 0.12, 0.006, 0.009), low, top + self.rise))
        else:
            t.add("plate", box((size + 0.1, 0.01, size + 0.1), (0, y + 0.005, z)))
            place = (0, y + self.thick / 2 + 0.01, (low + top + 0.5) / 2)
            t.add("wall", box((self.long, self.thick, self.free + 0.5), place))


def standing(depth: Callable[[Any], float], when: When | None = None) -> Below:
    """A field: what a carrier stands on, whose underside is this far below the line's axis [m]."""
    return nested(Below, "what it stands on", fixed=lambda p: {"free": p.height - depth(p), **_feet(p)}, when=when)


class Overhead(Feet):
    """What a hanger hangs from: a beam along or across, alone or on legs or on a column."""

    height: float = given(1.1, "of the line's axis over the floor", "m")
    half: float = given(0.0, "half the hanger's width across the line", "m")
    size: float = among((0.08, 0.1, 0.14, 0.18), "height of the beam", "m")
    section: Section = section_of("section of the beam", flat=True)
    over: float = between(0.2, 0.6, "how far the beam reaches past the hanger", "m")
    along: bool = chance(0.3, "along the line, which leaves no place for legs", when=lambda p: p.half < 0.04)
    held: int = whole(0, 2, "hangs free, on two legs, on a column", when=lambda p: p.height < 3.0 and not p.along)
    leg: _Leg = nested(_Leg, "each of its legs", fixed=_feet, stream=own_stream, when=lambda p: p.held == 1)

    def build(self, t: Table, low: float) -> None:
        """Puts it down, its underside at ``low`` [m]."""
        size, span, floor = self.size, self.half + self.over, -self.height
        x, y = (span, 0.0) if self.along else (0.0, span)
        outline, holes = self.section.outline(size, t.style)
        t.add("beam", bar((-x, -y, low + size / 2), (x, y, low + size / 2), outline, holes))
        if self.held == 1:
            for s in BOTH:
                self.leg.build(t.at(0, s * (span - size / 2)), floor, low, size)
        elif self.held == 2:
            column = extrude(section_i(0.14, 0.14, 0.007, 0.01), floor, low + size + 0.02)
            t.at(0, span + 0.07).add("column", column)


def hung(half: float | Callable[[Any], float] = 0.0, when: When | None = None) -> Overhead:
    """A field: what a hanger hangs from that is half this wide across the line [m]."""
    wide = half if callable(half) else lambda _: half
    return nested(
        Overhead,
        "what it hangs from",
        fixed=lambda p: {"height": p.height, "half": wide(p), **_feet(p)},
        when=when,
    )
