"""Conduits, cables, junction boxes and outlets in their places."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.draws import made, number, of_form, yes
from cadplants.builder.params import Params, among, between, chance, given, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.utilities.mounting import Utility, beam_over, h_column, pole, strut, wall
from cadplants.model.family import Family, Model
from cadplants.solids.mesh_ops import extrude, merge, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, box, cylinder, hexagon, ring, rod, rope, torus
from cadplants.solids.transforms import at, spun

__all__ = ["WIRING"]

_SIZES = (0.0107, 0.0134, 0.0168, 0.0213, 0.0302)  # m, radii of steel conduit (EN 61386, ANSI C80.1)


def _bent(points: list[tuple[float, float, float]], radius: float, steps: int = 4) -> Floats:
    """A polyline whose corners are rounded."""
    corners = np.array(points, float)
    path = [corners[0]]
    for before, here, after in zip(corners[:-2], corners[1:-1], corners[2:], strict=True):
        u, v = before - here, after - here
        reach = min(radius, 0.45 * float(np.linalg.norm(u)), 0.45 * float(np.linalg.norm(v)))
        a, b = here + reach * u / np.linalg.norm(u), here + reach * v / np.linalg.norm(v)
        for t in np.linspace(0, 1, steps + 1):
            path.append((1 - t) ** 2 * a + 2 * t * (1 - t) * here + t * t * b)
    return np.array([*path, corners[-1]])


def _denser(path: Floats) -> Floats:
    """A polyline with a point amid each leg and no point twice."""
    halves = np.empty((2 * len(path) - 1, 3))
    halves[::2], halves[1::2] = path, path[:-1] + (path[1:] - path[:-1]) * 0.5
    keep = np.r_[True, np.linalg.norm(np.diff(halves, axis=0), axis=1) > 1e-4]
    dense: Floats = halves[keep]
    return dense


class _Run(Params):
    """A conduit on struts."""

    many: bool = given(False, "it is one of many, of which none is thick")
    turned: bool = given(False, "it turns down at its end")
    radius: float = among(lambda p: _SIZES[:4] if p.many else _SIZES, "of the conduit", "m")
    low: float = between(0.15, 0.5, "height of its end", "m", when=lambda p: p.turned)
    jogged: bool = chance(0.3, "it leaves the row in an offset", when=lambda p: not p.turned)
    coupled: bool = chance(0.4, "a coupling in it")

    def path(self, y: float, z: float, length: float, end: float) -> Floats:
        """Its middle line at a height, to the end of a straight one [m]."""
        if self.jogged:
            spots = [(-0.1, y), (0.7 * length, y), (0.85 * length, y - 0.08), (length + 0.1, y - 0.08)]
            points = [(x, y, z) for x, y in spots]
        else:
            points = [(-0.1, y, z), (end, y, z), *([(end, y, self.low)] if self.turned else [])]
        return _bent(points, 0.2 + 4 * self.radius)


class OnStruts(Utility, name="conduit/strut", weight=1.5):
    """Parallel steel conduits clamped to strut channels on a wall or on columns, turning down in nested bends."""

    count: int = whole(2, 6, "conduits")
    length: float = between(1.4, 3.0, "of the upper conduit", "m")
    height: float = between(1.6, 2.4, "of the upper conduit", "m")
    turned: bool = chance(0.7, "the conduits turn down")
    runs: tuple[_Run, ...] = several(
        made(_Run, lambda p: {"many": p.count > 4, "turned": p.turned}), lambda p: p.count, "conduits"
    )
    walled: bool = chance(0.5, "the struts are on a wall, not on columns")

    def build(self, t: Table) -> Model:
        length, z, pitch, n = self.length, self.height, 0.085, t.n(0.02, 6, 12)
        xs = (0.2 * length, 0.6 * length)
        for k, run in enumerate(self.runs):
            r, y, high = run.radius, -0.041 - run.radius, z - k * pitch
            t.add("conduit", rope(run.path(y, high, length, length - k * pitch), r, n))
            half, reach = np.pi * np.linspace(0, 1, 8), r + 0.002
            for x in xs:
                bow = [(x, y - reach * np.sin(a), high + reach * np.cos(a)) for a in half]
                strap = rope([(x, -0.043, high + reach), *bow, (x, -0.043, high - reach)], 0.003, 5)
                t.add("clamp", strap, *(box((0.044, 0.004, 0.012), (x, -0.043, high + s * (r + 0.008))) for s in BOTH))
            if run.coupled:
                nuts = [hexagon(2.9 * r, low * r, (low + 0.7) * r) for low in (-2.2, 1.5)]
                there = t.at(0.4 * length, y, high).along("x")
                there.add("coupling", cylinder(1.25 * r, -1.6 * r, 1.6 * r, 10), *nuts, of="clamp")
        rise = (self.count - 1) * pitch / 2
        for x in xs:
            t.at(x, 0, z - rise).spun("y", np.pi / 2).add("bracket", strut(-0.08 - rise, 0.08 + rise), of="clamp")
        if self.walled:
            t.extend([wall(-0.2, length + 0.3, z + 0.4)])
        for x in () if self.walled else xs:
            t.at(x).extend([h_column(z + 0.4)])
        return t.model()


class _Tail(Params):
    """A corrugated conduit to a device on a post."""

    reach: float = between(0.5, 0.9, "from the box to the device", "m")
    height: float = between(0.4, 1.4, "of the device", "m")
    radius: float = among((0.008, 0.011, 0.015), "of the conduit", "m")
    device: float = between(0.08, 0.16, "width of the device", "m")
    ribbed: bool = chance(0.6, "ribs are modelled")

    def build(self, t: Table, sign: int, s: float, start: float) -> None:
        """Puts it down, from the side of a box this wide, whose gland is on a height [m]."""
        x, z, q, w, n = sign * self.reach, self.height, self.radius, self.device, t.n(0.02, 6, 12)
        spots = [(sign * (s / 2 + 2 * q), start), (sign * (s / 2 + 0.2), start - 0.02)]
        spots += [(x - 0.1 * sign, z - 0.35), (x, z - 0.3), (x, z - 2 * q)]
        points = _denser(_bent([(x, 0, z) for x, z in spots], 0.2, 7))
        ribs = []
        for i in range(1, len(points) - 1, 2) if self.ribbed else ():
            d = points[i + 1] - points[i - 1]
            d = 0.3 * q * d / np.linalg.norm(d)
            ribs.append(rod(points[i] - d, points[i] + d, 1.14 * q, n))
        t.add("conduit", rope(points, q, n), *ribs, of="rubber")
        first = merge([hexagon(3.2 * q, 0, 1.2 * q), cylinder(1.35 * q, q, 3 * q, 10)])
        last = merge([hexagon(3.2 * q, -1.2 * q, 0), cylinder(1.35 * q, -3 * q, -q, 10)])
        ends = [along("x" if sign > 0 else "-x", first, sign * s / 2, 0, start), moved(last, at(x, 0, z))]
        t.add("nut", *ends, of="clamp", fine=False)
        lid = cylinder(0.4 * w, 0, 0.02, 12)
        t.add("junction box", box((w, w, w), (x, 0, z + w / 2)), moved(lid, at(x, 0, z + w)))
        t.add("post", box((0.05, 0.05, z + 0.5 * w), (x, w / 2 + 0.025, (z + 0.5 * w) / 2)))


class Flexible(Utility, name="conduit/flexible", weight=1.2):
    """A rigid conduit up from the floor into a box, and corrugated conduits in loops to devices on posts."""

    radius: float = among(_SIZES[:4], "of the rigid conduit", "m")
    height: float = between(0.5, 1.2, "of the box over the floor", "m")
    box: float = between(0.1, 0.2, "width of the box", "m")
    count: int = whole(1, 2, "corrugated conduits")
    tails: tuple[_Tail, ...] = several(made(_Tail), lambda p: p.count, "corrugated conduits")

    def build(self, t: Table) -> Model:
        r, h, s = self.radius, self.height, self.box
        t.add("conduit", cylinder(r, 0.0, h - 0.02, t.n(0.02, 6, 12)))
        case = box((s, 0.6 * s, 1.3 * s), (0, 0, h + 0.65 * s))
        lid = box((0.95 * s, 0.08 * s, 1.22 * s), (0, -0.34 * s, h + 0.65 * s))
        t.add("junction box", hexagon(2.8 * r, h - 0.03, h), case, lid)
        for sign, tail in zip(BOTH, self.tails, strict=False):
            tail.build(t, sign, s, h + 0.4 * s)
        return t.model()


class _Spot(Params):
    """A box in a conduit, with an outlet below or none."""

    form: str = among(("body", "square", "round"), "what it is")
    dropped: bool = chance(0.7, "a conduit goes down to an outlet")
    low: float = between(0.9, 1.4, "height of the outlet", "m", when=lambda p: p.dropped)
    outlet: str = among(("switch", "flap socket", "round socket"), "what it is", when=lambda p: p.dropped, otherwise="")

    def build(self, t: Table, r: float, z: float) -> float:
        """Puts it down on a wall behind, in a conduit of radius ``r``; how far it reaches along that [m]."""
        y = -0.02 - r
        here = t.at(0, y, z)
        if self.form == "body":
            body = extrude(rounded_rectangle(7 * r, 2.8 * r, 1.3 * r, 3), -1.3 * r, 1.3 * r)
            lid = extrude(rounded_rectangle(6.4 * r, 2.5 * r, 1.2 * r, 3), 1.3 * r, 1.6 * r)
            here.spun("x", np.pi / 2).add("junction box", body, lid, of="clamp")
        elif self.form == "square":
            lid = box((0.102, 0.006, 0.102), (0, -0.028, 0))
            here.add("junction box", box((0.1, 0.05, 0.1)), lid, of="clamp")
        else:
            drum = [cylinder(0.045, -0.025, 0.025, t.n(0.05)), cylinder(0.048, 0.025, 0.031, t.n(0.05))]
            here.along("-y").add("junction box", *drum, of="clamp")
        return {"body": 3.4 * r, "square": 0.05}.get(self.form, 0.043)

    def drop(self, t: Table, r: float, z: float) -> None:
        """Puts the conduit down to the outlet there, and the outlet: a surface box, maybe IEC 60309."""
        y, start, top = -0.02 - r, {"body": 1.3 * r, "square": 0.049}.get(self.form, 0.043), self.low - 0.05
        t.add("conduit", rod((0, y, z - start), (0, y, self.low), r, t.n(0.02, 6, 12)))
        deep = 0.05 - y
        if self.outlet == "switch":
            front = [((0.06, 0.006, 0.08), (0.0, -0.003, 0.0)), ((0.02, 0.014, 0.035), (0.0, -0.008, 0.0))]
        else:
            front = [((0.07, 0.02, 0.07), (0.0, -0.01, -0.005)), ((0.074, 0.004, 0.08), (0.0, -0.022, -0.005))]
        extra = [moved(box(*one), at(0, -deep)) for one in front]
        if self.outlet == "round socket":
            n, knob = t.n(0.03), box((0.03, 0.015, 0.02), (0, 0.036, 0.04))
            plug = merge([cylinder(0.03, -0.02, 0.04, n), cylinder(0.036, 0.04, 0.05, n), knob])
            extra = [moved(plug, at(0, -deep, -0.01) @ spun("x", np.pi / 2 + 0.45))]
        t.at(0, 0, top).add("junction box", box((0.075, deep, 0.1), (0, -deep / 2, 0)), *extra)


class Bodies(Utility, name="conduit/bodies", weight=1.5):
    """Thin conduit (EMT) over a wall through conduit bodies (LB, T, C), square boxes and a ceiling box with a lamp."""

    radius: float = among(_SIZES[:3], "of the conduit", "m")
    length: float = between(1.6, 3.2, "of the conduit", "m")
    height: float = between(1.8, 2.6, "of the conduit", "m")
    spots: tuple[_Spot, ...] = several(made(_Spot), 2, "boxes in it")

    def build(self, t: Table) -> Model:
        r, length, z, n, last = self.radius, self.length, self.height, t.n(0.02, 6, 12), -0.1
        y = -0.02 - r
        for x, spot in zip((0.3 * length, 0.65 * length), self.spots, strict=True):
            reach = spot.build(t.at(x), r, z) - 0.003
            t.add("conduit", rod((last, y, z), (x - reach, y, z), r, n))
            last = x + reach
            if spot.dropped:
                spot.drop(t.at(x), r, z)
        t.add("conduit", rope(_bent([(last, y, z), (length, y, z), (length, y, z + 0.5)], 0.12), r, n))
        for x in (0.08 * length, 0.48 * length, 0.85 * length):
            band = along("x", ring(r, r + 0.002, -0.008, 0.008, 12), 0, y)
            foot = box((0.016, 0.003, 4 * r + 0.03), (0, -0.0015, 0))
            t.at(x, 0, z).add("clamp", band, box((0.016, 0.003 - y - r, 0.012), (0, (y + r) / 2, 0)), foot)
        t.extend([wall(-0.2, length + 0.2, z + 0.6)])
        return t.model()


class _Wire(Params):
    """A cable from pole to pole."""

    sag: float = between(0.1, 0.35, "in its middle", "m")
    radius: float = between(0.006, 0.014, "of the cable", "m")


def _poles(p: Any) -> bool:
    return bool(p.poles)


def _rail(p: Any) -> bool:
    return not p.poles


class Hanging(Utility, name="cable/hanging", weight=1.2):
    """Cables that hang: sagging from pole to pole on insulators, in loops from a rail's trolleys, or to a drop."""

    length: float = between(2.0, 4.0, "from end to end", "m")
    height: float = between(2.0, 3.5, "of poles or rail", "m")
    poles: bool = chance(0.5, "it is on poles, not on a rail")
    square: tuple[bool, ...] = several(yes(0.3), 2, "whether a pole is square", when=_poles)
    count: int = whole(2, 3, "cables between poles", when=_poles)
    wires: tuple[_Wire, ...] = several(made(_Wire), lambda p: p.count, "cables between poles", when=_poles)
    trolleys: int = whole(3, 6, "on the rail", when=_rail)
    radius: float = between(0.008, 0.016, "of the cables on a rail", "m", when=_rail)
    depths: tuple[float, ...] = several(
        number(0.5, 0.8), lambda p: p.trolleys - 1, "depth of a loop / from trolley to trolley", when=_rail
    )
    lines: int = whole(1, 2, "cables on a rail", when=_rail)

    def build(self, t: Table) -> Model:
        length, h = self.length, self.height
        if not self.poles:
            return self._on_rail(t)
        for x, square in zip((0.0, length), self.square, strict=True):
            t.at(x).extend(pole(h, 0.05, t.style, square))
            t.add("bracket", box((0.06, 0.7, 0.06), (x, 0, h + 0.03)))
        knob = [cylinder(0.015, 0, 0.07, 10), cylinder(0.03, 0.02, 0.03, 12), cylinder(0.03, 0.045, 0.055, 12)]
        s = np.linspace(0, 1, 13)
        for y, wire in zip((-0.28, 0.0, 0.28), self.wires, strict=False):
            heights = h + 0.13 + wire.radius - 4 * wire.sag * s * (1 - s)
            t.add("cable", rope(np.column_stack([s * length, np.full(13, y), heights]), wire.radius, 8))
            for x in (0.0, length):
                t.at(x, y, h + 0.06).add("bracket", *knob, of="dial")
        return t.model()

    def _on_rail(self, t: Table) -> Model:
        h, xs, path = self.height, np.linspace(0, self.length, self.trolleys), []
        t.extend(beam_over(-0.3, self.length + 0.3, h))
        for a, b, depth in zip(xs[:-1], xs[1:], self.depths, strict=True):
            deep = depth * (b - a)
            path += [(a + (b - a) * q, 0.0, -deep * np.sin(np.pi * q) ** 0.7) for q in np.linspace(0, 1, 9)[:-1]]
        for y in (-0.025, 0.025)[: self.lines]:
            t.at(0, y, h - 0.1).add("cable", rope([*path, (xs[-1], 0.0, 0.0)], self.radius, 8))
        for x in xs:
            saddle = [box((0.05, 0.09, 0.02), (0, 0, -0.09)), box((0.04, 0.05, 0.09), (0, 0, -0.045))]
            t.at(float(x), 0, h).add("pipe hanger", *saddle)
        return t.model()


def _wound(p: Any) -> bool:
    return bool(p.form == "drum")


def _coil(p: Any) -> bool:
    return not _wound(p)


class Coiled(Utility, name="cable/coiled", weight=1.2):
    """Cable that waits: a coil on a wall hook or on the floor, or wound on a wooden or steel drum."""

    form: str = among(("floor", "hook", "drum"), "how it waits")
    radius: float = between(0.006, 0.016, "of the cable", "m")
    big: float = between(
        lambda p: 0.3 if _wound(p) else 0.15, lambda p: 0.6 if _wound(p) else 0.35, "radius of coil or drum", "m"
    )
    wide: float = between(0.3, 0.6, "of the drum", "m", when=_wound)
    count: int = whole(4, 8, "turns of the coil", when=_coil)
    shifts: tuple[float, ...] = several(
        number(-0.5, 0.5), lambda p: p.count, "how much wider a turn is / radius of the cable", when=_coil
    )
    tilts: tuple[float, ...] = several(
        number(-0.02, 0.02), lambda p: p.count - 1, "of a turn", "rad", when=of_form("floor")
    )
    height: float = between(1.2, 1.8, "of the hook", "m", when=of_form("hook"))

    def build(self, t: Table) -> Model:
        r, big = self.radius, self.big
        if self.form == "drum":
            return self._drum(t)
        n, count = t.n(big, 12, 28), self.count
        rings = [torus(big + shift * r, r, n, 6) for shift in self.shifts]
        if self.form == "floor":
            poses = [at(0, 0, r + 1.6 * r * k) @ spun("x", tilt) for k, tilt in enumerate((0.0, *self.tilts))]
            t.add("cable", *map(moved, rings, poses))
            t.add("cable", rope([(big, 0, r), (big + 0.02, 0.3, r), (big + 0.3, 0.5, r), (big + 0.8, 0.45, r)], r, 8))
            for a in (2.0, 4.4):
                there = t.at(big * np.cos(a), big * np.sin(a), 0.9 * r * count + 0.003).spun("z", a).along("-y")
                there.add("clamp", torus(0.9 * r * count, 0.003, 10, 4), of="dial")
            return t.model()
        z, deep = self.height, 0.06 + 1.7 * r * count
        drops = [z - big - shift * r for shift in self.shifts]
        poses = [at(0, -0.03 - 1.7 * r * k, low) @ spun("x", np.pi / 2) for k, low in enumerate(drops)]
        t.add("cable", *map(moved, rings, poses))
        hook = rope([(0, 0, z - r - 0.008), (0, -deep, z - r - 0.008), (0, -deep - 0.01, z + 0.03)], 0.01, 8)
        t.add("bracket", hook, box((0.08, 0.008, 0.12), (0, -0.004, z)))
        t.extend([wall(-0.6, 0.6, z + 0.5)])
        return t.model()

    def _drum(self, t: Table) -> Model:
        big, wide, n, core = self.big, self.wide, t.n(self.big), 0.45 * self.big
        cheek = [cylinder(big, z, z + 0.03, n) for z in (-wide / 2 - 0.03, wide / 2)]
        board = box((0.06, 1.6 * big, 0.012))
        cheek += [moved(board, at(0, 0, s * (wide / 2 + 0.036)) @ spun("z", q)) for s in BOTH for q in (0, np.pi / 2)]
        hub = [cylinder(core, -wide / 2, wide / 2, n), cylinder(0.05, -wide / 2 - 0.035, wide / 2 + 0.035, 12)]
        turns = int(np.clip(wide / (2.2 * self.radius), 4, 14))
        q = wide / turns / 2
        rings = [
            moved(torus(core + q + k % 2 * 0.3 * q, 1.18 * q, min(n, 24), 6), at(0, 0, -wide / 2 + (2 * k + 1) * q))
            for k in range(turns)
        ]
        lying, out = t.at(0, 0, big).spun("x", np.pi / 2), core + q
        lying.add("cable", *rings)
        tail = [(out * np.cos(a), 0.0, big + out * np.sin(a)) for a in (0.6, 0.2, -0.1)]
        tail += [(out + 0.05, -0.1, 0.35 * big), (big + 0.3, -0.3, q), (big + 0.9, -0.35, q)]
        t.add("cable", rope(tail, 0.9 * q, 8))
        lying.add("cable", *cheek, *hub, of="steel")
        return t.model()


class Cleated(Utility, name="cable/cleated"):
    """Cables in cleats up a column or along a wall: in trefoil, in a row, or strapped in a bundle, into a gland box."""

    height: float = between(1.6, 2.8, "of the cables' ends", "m")
    radius: float = between(0.009, 0.022, "of a cable", "m")
    form: str = among(("trefoil", "row", "bundle"), "how they lie")
    low: float = between(0.4, 0.7, "height of the box", "m")
    cleats: int = whole(2, 4, "cleats")
    walled: bool = chance(0.5, "behind it is a wall, not a column")

    def build(self, t: Table) -> Model:
        h, r, low, gap = self.height, self.radius, self.low, 0.02
        spots = {
            "trefoil": outline(-r, -r, r, -r, 0.0, -r - 1.732 * r),
            "row": [((k - 1.5) * 3.0 * r, -r) for k in range(4)],
            "bundle": outline(-r, -r, r, -r, 0.0, -2.732 * r, -2 * r, -2.732 * r, 2 * r, -2.732 * r),
        }[self.form]
        wide, deep = max(abs(x) for x, _ in spots) + r, r - min(y for _, y in spots)
        for x, y in spots:
            t.add("cable", rope([(x, y - gap, h), (x, y - gap, low + 0.02)], r, t.n(r, 8, 12)))
        for z in np.linspace(low + 0.3, h - 0.15, self.cleats):
            cleat = [box((2 * wide + 0.05, gap, 0.04), (0, -gap / 2, z))]
            cleat += [box((0.02, deep, 0.04), (s * (wide + 0.012), -gap - deep / 2, z)) for s in BOTH]
            t.add("clamp", *cleat, box((2 * wide + 0.05, 0.006, 0.04), (0, -gap - deep - 0.003, z)), of="rubber")
        w, d = 2 * wide + 0.12, deep + 2 * gap + 0.04
        case = [box((w, d, 0.3), (0, -d / 2, low - 0.15)), box((0.94 * w, 0.01, 0.28), (0, -d - 0.005, low - 0.15))]
        gland = merge([hexagon(2.6 * r, 0.0, 0.8 * r), cylinder(1.2 * r, 0.7 * r, 1.6 * r, 10)])
        t.add("junction box", *case, *(moved(gland, at(x, y - gap, low)) for x, y in spots))
        t.extend([wall(-0.5, 0.5, h + 0.2) if self.walled else h_column(h + 0.2, 0.2)])
        return t.model()


WIRING: tuple[Family, ...] = families_of(OnStruts, Flexible, Bodies, Hanging, Coiled, Cleated)
