"""Cable ways, boxes, lamps and supports of primitives."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import Device, families_of
from cadplants.builder.draws import made, yes
from cadplants.builder.params import Params, among, between, chance, given, nested, several, whole
from cadplants.builder.table import Table
from cadplants.families.primitive.shape import (
    cone,
    disc,
    lying,
    torus_piece,
)
from cadplants.model.family import Family, Model
from cadplants.model.standards import PIPES
from cadplants.solids.mesh_ops import Solid, extrude, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, ball, bar, box, cylinder, ring, rod
from cadplants.solids.transforms import at, spun

__all__ = ["PRIMITIVE_UTILITIES"]


class _Utility(Device, group="Electrical and safety", sizes=(15,), grain="fitting"):
    """An electrical or safety device of primitives."""


# --- cable ways ---


class _Stretch(Params):
    """A straight piece of a cable way, and how it goes on."""

    form: str = given("duct", "of the way")
    followed: bool = given(False, "whether another stretch follows")
    longest: float = given(6.0, "its greatest length", "m")
    length: float = between(1.0, lambda p: p.longest, "length", "m")
    gap: float = among((0.2, 0.25, 0.3), "between rungs", "m", when=lambda p: p.form == "rungs", otherwise=0.0)
    one: bool = chance(0.5, "rails and rungs are one mesh", when=lambda p: p.form == "rungs", otherwise=True)
    held: bool = chance(0.6, "a post under it")
    turned: bool = chance(0.6, "the next one goes round a corner", when=lambda p: p.followed)
    turn: float = among(
        (-0.5, 0.5),
        "to the right or left / half a turn",
        when=lambda p: p.turned and p.form in ("duct", "solid"),
        otherwise=0.0,
    )

    def solids(self, wide: float, high: float) -> list[Solid]:
        """Along x from 0, its underside on z = 0 [m]."""
        length, w = self.length, max(0.002, 0.02 * wide)
        if self.form == "solid":
            return [box((length, wide, high), (length / 2, 0, high / 2))]
        if self.form == "duct":
            hole = rounded_rectangle(wide - 2 * w, high - 2 * w, 0.0)
            return [bar((0, 0, high / 2), (length, 0, high / 2), rounded_rectangle(wide, high, 0.0), (hole,))]
        if self.form == "tray":
            walls = [box((length, w, high), (length / 2, s * (wide - w) / 2, high / 2)) for s in BOTH]
            return [box((length, wide, w), (length / 2, 0, w / 2)), *walls]
        rails = [box((length, 2 * w, high), (length / 2, s * (wide / 2 - w), high / 2)) for s in BOTH]
        places = np.arange(0.1, length, self.gap)
        return [*rails, *(box((0.03, wide - 4 * w, 0.4 * high), (x, 0, 0.3 * high)) for x in places)]


class _Way(_Utility, label="cable tray", bundle="cable tray", grain="structure"):
    """A cable way of many metres, in one or more pieces with flanged collars and a turn at times, on posts or hung."""

    wide: float = among((0.1, 0.2, 0.3, 0.4, 0.6), "width", "m")
    high: float = among((0.05, 0.1, 0.1, 0.2, 0.3), "height", "m")
    level: float = between(0.4, 3.0, "height over the floor", "m")
    count: int = whole(1, 3, "stretches")

    def put(self, t: Table, stretches: tuple[_Stretch, ...], collared: bool) -> Model:
        """Puts stretches down one after the other."""
        wide, high, level, pose = self.wide, self.high, self.level, at(0, 0, self.level)
        for one in stretches:
            here, solids = t.moved(pose), one.solids(wide, high)
            here.add_each("cable tray", solids, joined=one.one)
            if collared:
                here.add("cable tray", box((0.02, 1.25 * wide, high + 0.25 * wide), (0.01, 0, high / 2)))
            foot = (pose @ at(0.5 * one.length))[:3, 3]
            if one.held and abs(foot[2] - level) < 1e-9 and abs(pose[2, 0]) < 0.1:
                t.add("post", box((0.05, 0.05, level), (float(foot[0]), float(foot[1]), level / 2)))
            pose = pose @ at(one.length)
            if one.turn:
                t.moved(pose).add("cable tray", box((wide, wide, high), (wide / 2, 0, high / 2)))
                pose = pose @ at(wide / 2) @ spun("z", one.turn * np.pi) @ at(wide / 2)
        return t.model()


def _first(form: str) -> tuple[_Stretch, ...]:
    longest = 3.0 if form == "rungs" else 6.0
    told = {"form": form, "followed": True, "longest": longest}
    return several(made(_Stretch, lambda _: told), lambda p: p.count - 1, "stretches before the last")


def _last(form: str) -> _Stretch:
    longest = 3.0 if form == "rungs" else 6.0
    return nested(_Stretch, "last stretch", fixed=lambda _: {"form": form, "followed": False, "longest": longest})


class PlainDuct(_Way, name="cable tray/plain duct", weight=2.0):
    """A cable duct of many metres, in one or more pieces with flanged collars and a turn at times, on posts or hung."""

    collars: bool = chance(0.4, "a collar at the start of each stretch")
    first: tuple[_Stretch, ...] = _first("duct")
    last: _Stretch = _last("duct")

    def build(self, t: Table) -> Model:
        return self.put(t, (*self.first, self.last), self.collars)


class PlainSolid(PlainDuct, name="cable tray/plain solid", weight=2.0):
    """A cable duct as a solid bar, in one or more pieces with flanged collars and a turn at times, on posts or hung."""

    first: tuple[_Stretch, ...] = _first("solid")
    last: _Stretch = _last("solid")


class PlainTray(_Way, name="cable tray/plain tray"):
    """A cable tray of many metres, in one or more pieces, on posts or hung."""

    first: tuple[_Stretch, ...] = _first("tray")
    last: _Stretch = _last("tray")

    def build(self, t: Table) -> Model:
        return self.put(t, (*self.first, self.last), False)


class PlainRungs(PlainTray, name="cable tray/plain rungs"):
    """A cable ladder of many metres, in one or more pieces, on posts or hung."""

    first: tuple[_Stretch, ...] = _first("rungs")
    last: _Stretch = _last("rungs")


def _box_under(t: Table, radius: float, count: int) -> None:
    deep = 3 * radius * count + 0.08
    t.add("junction box", box((0.12, deep, 0.2), (0, 1.5 * radius * (count - 1), -0.1)), own=False)


class Conduit(_Utility, name="conduit/bent bars", label="conduit", bundle="conduit"):
    """Round bars side by side up and along, with sleeves on them at times."""

    radius: float = between(0.01, 0.025, "of a bar", "m")
    count: int = whole(1, 4, "bars")
    length: float = between(0.8, 5.0, "along", "m")
    rise: float = between(0.4, 2.5, "up", "m")
    sleeved: tuple[bool, ...] = several(yes(0.5), lambda p: p.count, "whether each has two sleeves")
    boxed: bool = chance(0.6, "a box under them")

    def build(self, t: Table) -> Model:
        r, rise, length, n = self.radius, self.rise, self.length, min(t.n(self.radius), 12)
        for k, sleeved in enumerate(self.sleeved):
            y = 3 * r * k
            solids = [torus_piece([(0.0, y, 0.0), (0.0, y, rise), (length, y, rise)], r, n)]
            if sleeved:
                solids += [lying(cylinder(1.25 * r, 0.0, 4 * r, n), s * length, y, rise) for s in (0.3, 0.7)]
            t.add("conduit", *solids, of="electrical")
        if self.boxed:
            _box_under(t, r, self.count)
        return t.model()


class Cable(_Utility, name="cable/bent bars", label="cable", bundle="cable", weight=0.5):
    """Thin and uneven bars as cables, side by side up and along."""

    radius: float = between(0.003, 0.009, "of a cable", "m")
    count: int = whole(2, 7, "cables")
    length: float = between(0.8, 5.0, "along", "m")
    rise: float = between(0.4, 2.5, "up", "m")
    loose: tuple[tuple[float, float], ...] = several(
        lambda rng, _: (float(rng.uniform(-2, 2)), float(rng.uniform(0, 1))),
        lambda p: 8 * p.count,
        "how far each of eight points of a cable is aside and up / radius",
    )
    boxed: bool = chance(0.6, "a box under them")

    def build(self, t: Table) -> Model:
        r, rise, n = self.radius, self.rise, min(t.n(self.radius), 12)
        xs = np.linspace(0.2, self.length, 8)
        for k in range(self.count):
            y = 3 * r * k
            loose = self.loose[8 * k : 8 * k + 8]
            along = [(float(x), y + a * r, rise + b * r) for x, (a, b) in zip(xs, loose, strict=True)]
            path = [(0.0, y, 0.0), (0.0, y, rise - 0.2), (0.06, y, rise - 0.05), *along]
            t.add("cable", torus_piece(path, r, n), of="electrical")
        if self.boxed:
            _box_under(t, r, self.count)
        return t.model()


class SaggingBar(_Utility, name="cable/sagging bar", label="cable", bundle="cable", weight=0.5):
    """A cable between two points that sags."""

    length: float = between(1.0, 4.0, "between the points", "m")
    sag: float = between(0.02, 0.4, "in its middle", "m")
    radius: float = between(0.004, 0.02, "of the cable", "m")

    def build(self, t: Table) -> Model:
        x = np.linspace(0, 1, 9)
        path = np.column_stack([self.length * x, np.zeros(9), 2.0 - 4 * self.sag * x * (1 - x)])
        t.add("cable", torus_piece(path, self.radius, 8), of="electrical")
        t.add("post", rod((0, 0, 0), (0, 0, 2.0), 0.03, 8))
        return t.model()


# --- boxes, lamps, bottles ---


class _Size(Params):
    """Width, depth and height of a box."""

    wide: float = between(0.1, 1.2, "width", "m")
    deep: float = between(0.004, 0.6, "depth", "m")
    high: float = between(0.08, 2.1, "height", "m")


# Ranges of width, depth and height [m]; one number where it is always the same.
_SIZES: dict[str, tuple[tuple[float, ...], ...]] = {
    "control panel": ((0.4, 1.2), (0.2, 0.6), (0.8, 2.1)),
    "junction box": ((0.1, 0.3), (0.06, 0.15), (0.1, 0.4)),
    "sign": ((0.2, 0.6), (0.004,), (0.2, 0.5)),
    "camera": ((0.1, 0.2), (0.08,), (0.08,)),
}


def _size_of(name: str) -> _Size:
    class Sized(_Size):
        """The size of a box of one kind."""

        @classmethod
        def draw(cls, source: Any, fixed: Mapping[str, Any] | None = None, **given: Any) -> Any:
            rng = source.rng
            # A size of each kind, so that all kinds draw as many numbers.
            drawn = {
                kind: [span[0] if len(span) == 1 else float(rng.uniform(span[0], span[1])) for span in spans]
                for kind, spans in _SIZES.items()
            }
            sizes = zip(("wide", "deep", "high"), drawn[name], strict=True)
            said = {key: value for key, value in sizes if key not in given}
            return super().draw(source, {**said, **(fixed or {})}, **given)

    return nested(Sized, "its box")


class _Boxed(_Utility, weight=0.6):
    """A box on the floor or on a post."""

    size: _Size = _size_of("junction box")
    standing: bool = given(False, "it stands on the floor")
    low: float = between(0.9, 2.2, "height of its underside", "m", when=lambda p: not p.standing)
    radius: float = between(0.02, 0.04, "of the post", "m", when=lambda p: p.low)
    round_: bool = chance(0.5, "the post is round", when=lambda p: p.low)

    def build(self, t: Table) -> Model:
        low, r, size = self.low, self.radius, (self.size.wide, self.size.deep, self.size.high)
        solids = [box(size, (0, 0, low + size[2] / 2))]
        if self.label == "camera":
            solids.append(lying(disc(0.03, size[0] / 2, size[0] / 2 + 0.04, t.style), 0, 0, low + 0.04))
        t.add(self.label, *solids, of="electrical")
        if low:
            post = cylinder(r, 0, low, min(t.n(r), 16)) if self.round_ else box((2 * r, 2 * r, low), (0, 0, low / 2))
            t.add("post", post)
        return t.model()


class PanelBox(_Boxed, name="control panel/box", label="control panel", bundle="control panel"):
    """A control panel as a box on the floor or on a post."""

    size: _Size = _size_of("control panel")
    standing: bool = chance(0.7, "it stands on the floor")


class JunctionBox(_Boxed, name="junction box/box", label="junction box", bundle="junction box"):
    """A junction box on a post."""


class SignBox(_Boxed, name="sign/box", label="sign", bundle="sign"):
    """A sign on a post."""

    size: _Size = _size_of("sign")


class CameraBox(_Boxed, name="camera/box", label="camera", bundle="camera"):
    """A camera on a post."""

    size: _Size = _size_of("camera")


class PoleAndBox(_Utility, name="lamp/pole and box", label="lamp", bundle="lamp", weight=0.6):
    """A pole with a box, a cone or a ball on it."""

    high: float = between(2.0, 6.0, "height of the pole", "m")
    radius: float = between(0.03, 0.08, "of the pole", "m")
    head: str = among(("box", "cone", "ball"), "what is on it")

    def build(self, t: Table) -> Model:
        high = self.high
        heads = {
            "box": box((0.5, 0.2, 0.08), (0.2, 0, high)),
            "cone": cone(0.1, 0.25, high, high + 0.15, t.style),
            "ball": moved(ball(0.15, t.n(0.15)), at(0, 0, high)),
        }
        t.add("lamp", heads[self.head], of="electrical")
        t.add("post", disc(self.radius, 0.0, high, t.style))
        return t.model()


class Extinguisher(
    _Utility, name="fire extinguisher/cylinders", label="fire extinguisher", bundle="fire extinguisher", weight=0.5
):
    """A cylinder with a small one on top and a grip: an extinguisher."""

    radius: float = between(0.06, 0.1, "radius", "m")
    high: float = between(0.35, 0.6, "height", "m")

    def build(self, t: Table) -> Model:
        r, high = self.radius, self.high
        grip = box((1.6 * r, 0.02, 0.02), (0.4 * r, 0, high + 0.6 * r))
        bottle = [disc(r, 0.0, high, t.style), disc(0.4 * r, high, high + 0.6 * r, t.style)]
        t.add("fire extinguisher", *bottle, grip, of="safety")
        return t.model()


class Hydrant(_Utility, name="hydrant/cylinders", label="hydrant", bundle="hydrant", weight=0.5):
    """A cylinder with a small one on top and two to the side: a hydrant."""

    radius: float = between(0.06, 0.12, "radius", "m")
    high: float = between(0.6, 1.1, "height", "m")

    def build(self, t: Table) -> Model:
        r, high = self.radius, self.high
        side = moved(disc(0.5 * r, -1.8 * r, 1.8 * r, t.style), at(0, 0, 0.75 * high) @ spun("x", np.pi / 2))
        upright = [disc(r, 0.0, high, t.style), disc(0.4 * r, high, high + 0.6 * r, t.style)]
        t.add("hydrant", *upright, side, disc(1.6 * r, 0.0, 0.03, t.style), of="safety")
        return t.model()


# --- what holds a line ---


class _Holder(Device, place="carrier", group="Connection assembly", grain="structure"):
    """What holds a line, of primitives."""

    height: float = given(1.1, "of the line's axis over the floor", "m")


def _foot(p: object) -> float:
    """Height of the underside of a shoe over the line's axis [m]."""
    return -PIPES[p.dn].radius - p.shoe  # type: ignore[attr-defined, no-any-return]


class Shoe(_Holder, name="bracket/plain shoe", label="bracket", bundle="bracket", weight=3):
    """A plate, a T or a box under a line, on a beam, a post or a block that stands on the ground."""

    length: float = between(0.08, 0.25, "along the line", "m")
    shoe: float = between(0.05, 0.1, "height of the shoe", "m")
    boxed: bool = chance(0.3, "a box, not a T")
    size: float = between(0.06, 0.14, "width of what it is on", "m", when=lambda p: _foot(p) > -p.height + 0.05)
    under: str = among(
        ("post", "column", "beam", "foundation"),
        "what it is on",
        when=lambda p: _foot(p) > -p.height + 0.05,
        otherwise="",
    )
    across: float = between(0.4, 1.2, "length of the beam", "m", when=lambda p: p.under == "beam")

    def build(self, t: Table) -> Model:
        r, length, shoe, size = t.pipe.radius, self.length, self.shoe, self.size
        foot, under = -r - shoe, self.under
        if self.boxed:
            solids = [box((length, 1.2 * r + 0.02, shoe + 0.15 * r), (0, 0, -r - shoe / 2 + 0.075 * r))]
        else:
            web = box((length, 0.008, shoe + 0.1 * r), (0, 0, -r - shoe / 2 + 0.05 * r))
            solids = [web, box((length, 1.2 * r + 0.04, 0.008), (0, 0, foot + 0.004))]
        t.add("bracket", *solids, of="clamp")
        if under == "beam":
            t.add("beam", box((size, self.across, size), (0, 0, foot - size / 2)))
            foot, under = foot - size, "post"
        if under and foot > -self.height + 0.02:
            t.add(under, extrude(rounded_rectangle(size, size, 0.0), -self.height, foot), of="steel")
        return t.model()


class UprightCylinder(_Holder, name="bracket/upright cylinder", label="bracket", bundle="bracket", weight=1.5):
    """An upright cylinder under a line, with or without a plate at its foot."""

    radius: float = between(0.4, 0.8, "radius / of the line")
    plated: bool = chance(0.6, "a plate at its foot")

    def build(self, t: Table) -> Model:
        r = t.pipe.radius
        t.add("bracket", disc(max(0.012, r * self.radius), -self.height, -0.9 * r, t.style), of="clamp")
        if self.plated:
            t.add("base plate", box((2 * r + 0.06, 2 * r + 0.06, 0.012), (0, 0, -self.height + 0.006)))
        return t.model()


def _outer(dn: int) -> float:
    """Outer radius of a ring round a line [m]."""
    inner = PIPES[dn].radius
    return inner + max(0.004, 0.12 * inner)


class _Ring(_Holder):
    """A ring round a line."""

    half: float = between(0.015, 0.05, "half the width of the ring", "m")

    def ring(self, t: Table) -> Solid:
        """The ring."""
        outer = _outer(self.dn)
        return lying(ring(t.pipe.radius, outer, -self.half, self.half, t.n(outer)))


class RingOnPost(_Ring, name="clamp/ring on post", label="clamp", bundle="clamp", weight=2):
    """A ring round a line on a post."""

    size: float = between(0.02, 0.06, "radius of the post", "m", when=lambda p: p.height > _outer(p.dn) + 0.1)

    def build(self, t: Table) -> Model:
        t.add("clamp", self.ring(t))
        if self.size:
            t.add("post", disc(self.size, -self.height, -0.98 * _outer(self.dn), t.style))
        return t.model()


class RingOnRod(_Ring, name="pipe hanger/ring on rod", label="pipe hanger", bundle="pipe hanger"):
    """A ring round a line under a thin rod from above."""

    top: float = between(0.4, 1.2, "height of the rod's end over the axis", "m")
    size: float = between(0.05, 0.12, "width of the beam", "m")
    across: float = between(0.3, 1.0, "length of the beam", "m")

    def build(self, t: Table) -> Model:
        outer, top, size = _outer(self.dn), self.top, self.size
        t.add("pipe hanger", self.ring(t), cylinder(max(0.004, 0.08 * outer), 0.98 * outer, top, 8))
        t.add("beam", box((size, self.across, size), (0, 0, top + size / 2)))
        return t.model()


class Bow(_Holder, name="u-bolt/bent bar", label="u-bolt", bundle="u-bolt", weight=2):
    """A bent bar over a line on a flat or square beam, without nuts, on one or two posts."""

    drop: float = between(0.03, 0.06, "how far its ends reach below the line", "m")
    size: float = between(0.04, 0.1, "width of the beam", "m")
    two: bool = chance(0.5, "two posts, not one", when=lambda p: p.height > PIPES[p.dn].radius + p.size + 0.05)

    def build(self, t: Table) -> Model:
        r, size, height = t.pipe.radius, self.size, self.height
        d = max(0.004, 0.07 * r)
        leg, low = r + d, -r - self.drop
        turns = np.linspace(0, np.pi, 9)
        over = np.column_stack([np.zeros(9), leg * np.cos(turns), leg * np.sin(turns)])
        path: Floats = np.vstack([[(0.0, leg, low)], over, [(0.0, -leg, low)]])
        t.add("u-bolt", torus_piece(path, d, 8))
        t.add("beam", box((size, 2 * leg + 0.15, size), (0, 0, -r - size / 2)))
        if height > r + size + 0.05:
            for y in (-leg, leg) if self.two else (0.0,):
                t.add("post", box((size, size, height - r - size), (0, y, (-height - r - size) / 2)))
        return t.model()


PRIMITIVE_UTILITIES: tuple[Family, ...] = families_of(
    PlainDuct,
    PlainSolid,
    PlainTray,
    PlainRungs,
    Conduit,
    Cable,
    SaggingBar,
    PanelBox,
    JunctionBox,
    SignBox,
    CameraBox,
    PoleAndBox,
    Extinguisher,
    Hydrant,
    Shoe,
    UprightCylinder,
    RingOnPost,
    RingOnRod,
    Bow,
)
