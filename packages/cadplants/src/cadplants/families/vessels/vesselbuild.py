"""Upright and lying vessels, each family with one build of head, nozzle, manway, saddle, skirt, leg or lug."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.draws import made
from cadplants.builder.params import Params, among, between, chance, given, nested, several, spread, whole
from cadplants.builder.table import Table
from cadplants.families.valves.valve import bolt_circle
from cadplants.families.vessels.vessel import Tank, apart
from cadplants.families.vessels.vessel_fittings import (
    MANWAYS,
    Drum,
    Manway,
    fall,
    head,
    head_height,
    head_outline,
    lug,
    mouth,
    mouth_reach,
    sides,
)
from cadplants.families.vessels.vesselfeet import FEET, SADDLES, Feet, Saddle
from cadplants.model.family import Model, Port
from cadplants.model.standards import FLANGES
from cadplants.solids.primitives import cylinder, ring
from cadplants.solids.transforms import at, looking, spun

__all__ = ["VESSEL_BUILDS", "branch", "put_vessel"]

_HEADS = ("2:1", "torispherical", "torispherical")
_SIZES = (25, 40, 50, 80, 100, 150)
_TALL = "height of the shell, but for {} m / its radius"


def branch(
    t: Table, form: str, dn: int, pose: Floats, r: float = 0.0, dip: float = 0.0, spare: float = 0.04
) -> list[Port]:
    """Sets a nozzle on a surface, by a frame with z outward; its port where a line can be flanged on."""
    reach = mouth_reach(dn, spare)
    t.moved(pose).extend(mouth(form, dn, reach, t.style, r, dip))
    out = pose[:3, 2]
    return [Port(looking(pose[:3, 3] + out * reach, out), dn)] if form in ("plain", "pad", "heavy") else []


def put_vessel(t: Table, drum: Drum, bottom: str, top: str) -> None:
    """Puts a shell with two heads down."""
    t.add("shell", drum.solid(t.style))
    t.at(0, 0, drum.high).add("dished head", head(top, drum.r, t.style, drum.n))
    t.at(0, 0, drum.low).along("-z").add("dished head", head(bottom, drum.r, t.style, drum.n))


def _sizes(room: float) -> tuple[int, ...]:
    """Nominal sizes that suit a surface of this radius [m]."""
    return tuple(dn for dn in _SIZES if FLANGES[dn].outer < 0.9 * room) or (25,)


class _Nozzle(Params):
    """A nozzle on the side of an upright vessel."""

    room: float = given(1.0, "radius of the shell", "m")
    size: int = among(lambda p: _sizes(p.room), "nominal size", "mm")
    height: float = between(0.15, 0.85, "over the shell's lower rim / height of the shell")


class _Further(_Nozzle):
    """A second or third nozzle on the side of an upright vessel."""

    special: bool = chance(0.6, "it is built as the first one, rather than plain")


def _lower(p: Any) -> str:
    """The lower head of an upright vessel, by its fields."""
    return str(p.upper) if p.alike else "2:1"


def _clear(p: Any) -> float:
    """Height of an upright vessel's lower rim, by its fields [m]."""
    return head_height(_lower(p), p.radius) + (0.12 if p.feet == "pads" else p.clear + 0.3 * p.radius)


class _Upright(Tank, weight=0.7):
    """An upright vessel (DIN 28022 proportions) with one special build of head, feet, nozzles, manway or lugs."""

    form: str = among(("plain",), "how its nozzles are built")
    radius: float = spread(0.2, 1.2, "of the shell", "m")
    slender: float = between(1.2, 4.0, _TALL.format(0.3))
    upper: str = among(_HEADS, "upper head")
    alike: bool = chance(0.6, "its lower head is as the upper one", when=lambda p: p.upper not in _HEADS)
    feet: str = among(lambda p: ("angle", "pipe", "pads" if _lower(p) == "2:1" else "pipe"), "what it stands on")
    clear: float = between(
        0.2, 0.6, "from the floor to the lower head, but for 0.3 radii", "m", when=lambda p: p.feet != "pads"
    )
    stand: Feet = nested(lambda _, p: FEET[p.feet], "what it stands on", fixed=lambda p: {"clear": _clear(p)})
    count: int = whole(1, 3, "nozzles on the side")
    first: _Nozzle = nested(_Nozzle, "first nozzle on the side", fixed=lambda p: {"room": p.radius})
    others: tuple[_Nozzle, ...] = several(
        lambda rng, p: (_Nozzle if p.form == "plain" else _Further).draw(rng, {"room": p.radius}),
        lambda p: p.count - 1,
        "further nozzles on the side",
    )
    topped: bool = chance(0.75, "a nozzle on top", when=lambda p: p.form not in ("vent", "heavy"), otherwise=True)
    top: int = among(
        lambda p: _sizes(0.6 * p.radius),
        "nominal size of the nozzle on top",
        "mm",
        when=lambda p: p.topped,
        otherwise=0,
    )

    def build(self, t: Table) -> Model:
        r, low, lower = self.radius, _clear(self), _lower(self)
        height = self.slender * r + 0.3
        drum = Drum(r, low, low + height, sides(t.style, r))
        put_vessel(t, drum, lower, self.upper)
        t.extend(self.stand.parts(drum, t.style))
        ports: list[Port] = []
        for k, one in enumerate((self.first, *self.others)):
            form = self.form if not isinstance(one, _Further) or one.special else "plain"
            z = low + height * one.height
            port = branch(t, form, one.size, drum.side(2.1 * k + 1.2, z), r, drum.dip)
            ports += port if z > 0.6 else []
        apex = drum.high + head_height(self.upper, r)
        if self.top:
            ports += branch(t, self.form, self.top, at(0, 0, apex), 0.0, 0.03 * r)
        self.finish(t, drum, apex)
        return t.model(kind="tank", ports=ports)

    def finish(self, t: Table, drum: Drum, apex: float) -> None:
        """Puts down what a family has besides, its upper head's apex being at a height [m]."""


class _Short(_Upright):
    """A vessel on what holds little."""

    radius: float = spread(0.2, 1.2, "of the shell", "m", most=0.6, scale=0.7)


class _WithManway(_Upright):
    """An upright vessel with a manway in its shell."""

    radius: float = between(0.45, 1.1, "of the shell", "m")
    opening: float = between(0.23, 0.3, "radius of the manway's neck", "m")
    manway: Manway = nested(MANWAYS["hinged"], "manway")
    height: float = between(0.35, 0.6, "of the manway over the shell's lower rim / height of the shell")

    def finish(self, t: Table, drum: Drum, apex: float) -> None:
        pose = drum.side(4.17, drum.low + (drum.high - drum.low) * self.height)
        t.moved(pose).extend(self.manway.parts(t.style, self.opening, drum.r, drum.dip))


class HingedManway(_WithManway, name="manway/hinged"):
    """An upright vessel with a hinged manway."""


class OvalManway(_WithManway, name="manway/oval"):
    """An upright vessel with an oval inspection opening."""

    opening: float = between(0.1, 0.16, "radius of the inspection opening", "m")
    manway: Manway = nested(MANWAYS["oval"], "inspection opening")


class _WithLugs(_Upright):
    """An upright vessel with two to four lugs near its upper rim."""

    lug: str = among(("pad",), "how its lifting lugs are built")
    wide: float = between(0.07, 0.12, "width of a lug, but for 0.06 radii of the shell", "m")
    lugs: int = among((2, 2, 3, 4), "lugs")

    def finish(self, t: Table, drum: Drum, apex: float) -> None:
        size = self.wide + 0.06 * drum.r
        for k in range(self.lugs):
            pose = drum.side(2 * np.pi * k / self.lugs + 0.4, drum.high - (1.1 * size if self.lug != "ring" else size))
            t.moved(pose).extend(lug(self.lug, size, t.style, drum.r, drum.dip))


class _WithEyes(_WithLugs):
    """An upright vessel with eyebolts on top of its head."""

    lug: str = among(("eyebolt",), "how its lifting lugs are built")

    def finish(self, t: Table, drum: Drum, apex: float) -> None:
        size, x, shape = self.wide + 0.06 * drum.r, 0.45 * drum.r, np.array(head_outline(self.upper, drum.r))[::-1]
        drop = shape[0, 1] - np.interp(x, *shape.T)
        boss = cylinder(0.5 * size, apex - 0.05 * drum.r - 0.02, apex + 0.012, 12)
        for k in range(self.lugs):
            spot = t.spun("z", 2 * np.pi * k / self.lugs).at(x, 0, -drop)
            apart(spot, "lifting lug", boss, of="tank")
            spot.at(0, 0, apex + 0.01).extend(lug("eyebolt", size, t.style))


class _TopNozzle(Params):
    """A nozzle on a lying vessel."""

    room: float = given(1.0, "radius of what it must suit", "m")
    form: str = among(("plain", "pad"), "how it is built")
    size: int = among(lambda p: _sizes(p.room), "nominal size", "mm")


def _length(p: Any) -> float:
    """Length of a lying vessel's shell, by its fields [m]."""
    return float(min(p.slender * p.radius, 4.5))


class _Lying(Tank, weight=0.7):
    """A lying vessel on two or three saddles of one build, with nozzles and maybe a manway on top."""

    rest: str = among(("ribbed",), "how its saddles are built")
    closure: str = among(("none",), "what closes its manway")
    lug: str = among(("none",), "how its lifting lugs are built")
    radius: float = spread(0.2, 1.15, "of the shell", "m")
    slender: float = between(2.2, 6.0, "length of the shell, at most 4.5 m / its radius")
    clear: float = between(0.15, 0.3, "from the floor to the shell where it lies low", "m")
    lift: float = between(0, 0.25, "how much higher it lies / radius of the shell")
    ends: str = among((*_HEADS, "hemispherical", "flat"), "heads at its ends")
    third: bool = chance(0.3, "a third saddle", when=lambda p: _length(p) > 4.8 * p.radius)
    saddle: Saddle = nested(lambda _, p: SADDLES[p.rest], "each saddle")
    count: int = whole(2, 4, "nozzles and manways on top")
    opening: float = between(
        0.22,
        lambda p: min(max(0.22, 0.5 * p.radius), 0.3),
        "radius of the manway's neck",
        "m",
        when=lambda p: p.closure != "none",
    )
    manway: Manway = nested(lambda _, p: MANWAYS[p.closure], "manway", when=lambda p: p.closure != "none")
    nozzles: tuple[_TopNozzle, ...] = several(
        made(_TopNozzle, lambda p: {"room": 0.8 * p.radius}),
        lambda p: p.count - (p.closure != "none"),
        "nozzles on top",
    )
    ended: bool = chance(0.5, "a nozzle at one end")
    end: int = among(
        lambda p: _sizes(0.6 * p.radius), "nominal size of that nozzle", "mm", when=lambda p: p.ended, otherwise=0
    )

    def build(self, t: Table) -> Model:
        r, length = self.radius, _length(self)
        axis = r + self.clear + self.lift * r + (0.5 if self.rest in ("frame", "concrete") else 0.0)
        drum = Drum(r, 0.0, length, sides(t.style, r))
        lay = at(-length / 2, 0, axis) @ spun("y", np.pi / 2)
        put_vessel(t.moved(lay), drum, self.ends, self.ends)
        saddle = self.saddle.parts(r, axis, t.style)
        for x in np.linspace(-0.3, 0.3, 3 if self.third else 2) * length:
            t.at(x).extend(saddle)
        spots = [lay @ drum.side(np.pi, z) for z in np.linspace(0.15, 0.85, self.count) * length]
        if self.closure != "none":
            t.moved(spots.pop(1)).extend(self.manway.parts(t.style, self.opening, r, drum.dip))
        ports: list[Port] = []
        for pose, one in zip(spots, self.nozzles, strict=True):
            ports += branch(t, one.form, one.size, pose, r, drum.dip)
        if self.ended:
            pose = lay @ at(0, 0, length + head_height(self.ends, r))
            ports += branch(t, "plain", self.end, pose, 0.0, 0.02 * r)
        if self.lug != "none":
            for z, turn in ((0.05 * length, 0.6), (0.95 * length, -0.6)):
                pose = lay @ drum.side(np.pi + turn, z)
                t.moved(pose).extend(lug(self.lug, 0.08 + 0.06 * r, t.style, r, drum.dip))
        return t.model(kind="tank", ports=ports)


class _LyingLow(_Lying, weight=0.8):
    """A lying vessel on what holds little."""

    radius: float = spread(0.2, 1.15, "of the shell", "m", most=0.8, scale=0.7)


class _LyingWithManway(_Lying):
    """A lying vessel with a manway on top."""

    radius: float = spread(0.4, 1.15, "of the shell", "m")


class BoltedHead(Tank, name="dished head/bolted on", weight=0.7):
    """A vessel whose upper head comes off: girth flanges (EN 1092-1 style) with bolts all round, on legs."""

    radius: float = between(0.2, 0.6, "of the shell", "m")
    slender: float = between(1.0, 2.6, _TALL.format(0.2))
    cover: str = among(("flat plate", "torispherical", "hemispherical"), "upper head")
    feet: str = among(("pipe", "angle"), "legs")
    stand: Feet = nested(
        lambda _, p: FEET[p.feet], "what it stands on", fixed=lambda p: {"clear": head_height("2:1", p.radius) + 0.35}
    )
    top: int = among(lambda p: _sizes(0.7 * p.radius), "nominal size of the nozzle on top", "mm")
    side: int = among(lambda p: _sizes(0.7 * p.radius), "nominal size of the nozzle on the side", "mm")
    eye: bool = chance(0.5, "an eyebolt on the head", when=lambda p: p.cover != "flat plate")

    def build(self, t: Table) -> Model:
        r, low, flat = self.radius, head_height("2:1", self.radius) + 0.35, self.cover == "flat plate"
        height, n = self.slender * r + 0.2, sides(t.style, r)
        drum = Drum(r, low, low + height, n)
        thick, wide = 0.015 + 0.04 * r, 1.12 * r + 0.035
        top = drum.high + thick
        t.add("shell", drum.solid(t.style))
        t.at(0, 0, low).along("-z").add("dished head", head("2:1", r, t.style, n))
        t.add("shell", ring(r, wide, drum.high - thick, drum.high, n), of="flange")
        t.extend(self.stand.parts(drum, t.style))
        t.add("dished head", ring(0.0 if flat else 0.97 * r, wide, drum.high, top, n), of="flange")
        apex = top if flat else top + head_height(self.cover, r) - 0.004
        if not flat:
            t.at(0, 0, top - 0.004).add("dished head", head(self.cover, r, t.style, n))
        count = int(np.clip(2 * np.pi * r / 0.09, 12, 36))
        t.add("bolt", bolt_circle(count, 0.5 * (r + wide) + 0.004, 0.016, drum.high - thick, top))
        dip = drum.dip + 0.02 * r
        ports = branch(t, "plain", self.top, at(0, 0, apex), 0.0, dip)
        ports += branch(t, "plain", self.side, drum.side(1.0, low + 0.5 * height), r, dip)
        if self.eye:
            x = 0.55 * r
            drop = 0.1 * r if self.cover == "torispherical" else fall(r, x)
            t.at(0, x, apex - drop - 0.01).extend(lug("eyebolt", 0.08, t.style))
        return t.model(kind="tank", ports=ports)


class _Ferrule(Params):
    """A clamp ferrule on the side of a hygienic vessel."""

    height: float = between(0.1, 0.9, "over the shell's lower rim / height of the shell")
    size: int = among((20, 25, 40), "nominal size", "mm")


class Hygienic(Tank, name="nozzle/clamp ferrule", weight=0.7):
    """A hygienic vessel: clamp ferrules all over, a conical bottom, pipe legs, a swing-bolt manway."""

    radius: float = between(0.3, 0.8, "of the shell", "m")
    slender: float = between(1.0, 2.5, _TALL.format(0.2))
    lower: str = among(("conical", "conical", "torispherical"), "lower head")
    clear: float = between(0.35, 0.6, "from the floor to the lower head", "m")
    legs: Feet = nested(FEET["pipe"], "legs")
    drain: int = among((25, 40, 50), "nominal size of the ferrule below", "mm")
    count: int = whole(3, 6, "ferrules on the side")
    ferrules: tuple[_Ferrule, ...] = several(made(_Ferrule), lambda p: p.count, "ferrules")
    manway: Manway = nested(MANWAYS["swing"], "manway on top")
    sleeved: bool = chance(0.6, "a sleeve round the shell")

    def build(self, t: Table) -> Model:
        r, high = self.radius, head_height("torispherical", self.radius)
        height, bottom = self.slender * r + 0.2, head_height(self.lower, r)
        low = bottom + self.clear
        drum = Drum(r, low, low + height, sides(t.style, r))
        put_vessel(t, drum, self.lower, "torispherical")
        t.extend(self.legs.parts(drum, t.style))
        for k, one in enumerate(self.ferrules):
            pose = drum.side(1.1 * k, low + height * one.height)
            t.moved(pose).extend(mouth("ferrule", one.size, 0.08, t.style, r, drum.dip))
        t.at(0, 0, low - bottom + 0.01).along("-z").extend(mouth("ferrule", self.drain, 0.12, t.style))
        size, top = min(0.22, 0.45 * r), mouth("ferrule", 25, 0.1, t.style, 0.0, 0.12 * r)
        t.at(0, 0, drum.high + high - 0.005).extend(self.manway.parts(t.style, size, 0.0, 0.12 * r))
        for a in 2.1 * np.arange(3) + 0.6:
            t.at(0.72 * r * np.cos(a), 0.72 * r * np.sin(a), drum.high + 0.6 * high).extend(top)
        if self.sleeved:
            sleeve = ring(0.99 * r, 1.06 * r, low + 0.15 * height, low + 0.8 * height, drum.n)
            t.add("shell", sleeve, of="trim")
        return t.model(kind="process vessel")


def _of(base: type[Tank], name: str, weight: float = 0.0, **fixed: str) -> type[Tank]:
    """A family of vessels that differs from others in what some fields can only be.

    Args:
        base: of the family.
        name: of the family.
        weight: how often it is drawn, as the base if 0.
        fixed: the values of the fields, by their names.
    """
    body: dict[str, Any] = {key: among((value,), base.fields()[key].about) for key, value in fixed.items()}
    body |= {"__annotations__": dict.fromkeys(fixed, "str"), "__doc__": base.__doc__, "__module__": __name__}
    made: type[Tank] = type(name, (base,), body, name=name, weight=weight or base.weight)
    return made


VESSEL_BUILDS = families_of(
    _of(_Upright, "dished head/hemispherical", upper="hemispherical"),
    _of(_Upright, "dished head/conical", upper="conical"),
    _of(_Upright, "dished head/knuckled flat", upper="flat"),
    _of(_Upright, "dished head/shallow", upper="shallow"),
    BoltedHead,
    _of(_Upright, "nozzle/reinforcing pad", form="pad"),
    _of(_Upright, "nozzle/long welding neck", form="heavy"),
    _of(_Upright, "nozzle/blinded", form="blind"),
    _of(_Upright, "nozzle/gooseneck", form="vent"),
    _of(_Upright, "nozzle/half coupling", form="half"),
    _of(_Upright, "nozzle/tank fitting", form="fitting"),
    Hygienic,
    HingedManway,
    _of(_LyingWithManway, "manway/davit", closure="davit"),
    _of(_LyingWithManway, "manway/swing bolts", closure="swing"),
    OvalManway,
    _of(_Lying, "saddle/ribbed", 0.8, rest="ribbed"),
    _of(_LyingLow, "saddle/block", rest="block"),
    _of(_LyingLow, "saddle/sheet", rest="sheet"),
    _of(_Lying, "saddle/concrete", 0.8, rest="concrete"),
    _of(_Lying, "saddle/frame", 0.8, rest="frame"),
    _of(_Upright, "skirt/doorways", 0.9, feet="open"),
    _of(_Upright, "skirt/flared", 0.9, feet="flared"),
    _of(_Upright, "skirt/bolt chairs", 0.9, feet="chairs"),
    _of(_Upright, "tank leg/braced beams", feet="beam"),
    _of(_Upright, "tank leg/bracket on frame", feet="bracket"),
    _of(_Short, "tank leg/bent flat", feet="tripod"),
    _of(_Short, "tank leg/short pads", feet="pads"),
    _of(_Lying, "lifting lug/plate", lug="plate"),
    _of(_WithLugs, "lifting lug/on pad", lug="pad", feet="chairs"),
    _of(_WithLugs, "lifting lug/trunnion", lug="trunnion", feet="open"),
    _of(_WithEyes, "lifting lug/eyebolt", lug="eyebolt"),
    _of(_WithLugs, "lifting lug/bent bar", lug="ring"),
    _of(_Lying, "lifting lug/cheeks and pin", lug="cheeks"),
)
