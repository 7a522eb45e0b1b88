"""Meters, transmitters and sight glasses as most modellers draw them: a few plain solids, in pieces or one mesh."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.dials import CASE, STEM
from cadplants.builder.melting import FACETS_TEXT, Melting, sides_of
from cadplants.builder.params import Params, among, between, chance, given, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.instruments.flow import NAME, FlowMeter, measuring_tube
from cadplants.families.instruments.pieces import BEFORE, Gauge, put
from cadplants.families.instruments.sight import SIGHT_GLASS, SightGlass
from cadplants.model.family import Model
from cadplants.model.standards import SIZES, sizes_between
from cadplants.parts.flange import nut_room, plate_thickness
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import along, around, ball, box, cylinder, dome, hexagon, ring, rod, rope, turned
from cadplants.solids.transforms import at, spun

__all__ = ["PLAIN_METERS"]

_HEAD = "transmitter"
_ROUND = ("drum", "can", "double", "tilted", "pot")
_JOINTS = {"casting": "flanged", "discs": "flanged", "wafer": "wafer"}
_ENDS_TEXT = "its ends: cast or disc flanges, a wafer between the pipe's flanges, hexagons, collars, plain"


def _stub(radius: float, sides: int, start: float, end: float, cabled: bool) -> list[Solid]:
    """A cable gland about z and maybe a stub of its cable, which bends to -x."""
    long = end + 2.6 * radius
    solids = [cylinder(1.4 * radius, start, end + radius, 6), cylinder(radius, start, long, min(sides, 10))]
    if cabled:
        way = [(0, 0, end), (0, 0, end + 6 * radius), (-3 * radius, 0, end + 9 * radius)]
        solids.append(rope([*way, (-8 * radius, 0, end + 10 * radius)], 0.6 * radius, 6))
    return solids


class _Head(Params):
    """A transmitter's head on z = 0."""

    facets: int = given(0, FACETS_TEXT)
    form: str = among(
        ("drum", "drum", "can", "box", "box", "double", "wedge", "tilted", "slab", "pot", "ball"), "its form"
    )
    size: float = between(0.028, 0.075, "half its width", "m")
    long: float = between(0.6, 1.5, "half its length or height / half its width")
    deep: float = between(0.4, 1.0, "its depth / its width", when=lambda p: p.form in ("box", "wedge"), otherwise=0.3)
    lids: int = whole(0, 2, "lids", when=lambda p: p.form in _ROUND)
    display: bool = chance(0.4, "a display stands out of its front")
    glands: int = whole(0, 3, "cable glands")
    cabled: bool = chance(0.2, "stubs of cable", when=lambda p: p.glands > 0)

    def solids(self, t: Table) -> list[Solid]:
        """Its solids."""
        r = self.size
        n = sides_of(t, r, self.facets)
        found = self._round(n) if self.form in _ROUND else self._square(n)
        high = {"can": self.long * r, "pot": self.long * r, "double": 1.5 * r, "tilted": 1.1 * r}.get(self.form, r)
        g = 0.13 * r + 0.003
        axes = ("y", "-y", "y") if self.form in _ROUND else ("x", "-x", "x")
        if self.form == "slab":
            axes = ("-z", "-z", "-z")
        for k, axis in enumerate(axes[: self.glands]):
            aside = (0.0, 0.0, 3.4 * g)[k]
            nut = _stub(g, n, 0.3 * r, r, self.cabled)
            if axis == "-z":
                found += [along("-z", one, (0.55, -0.55, 0.3)[k] * r, 0, 1.3 * r) for one in nut]
            elif self.form in _ROUND:
                found += [along(axis, one, 0.4 * aside if self.form != "drum" else aside, 0, high) for one in nut]
            else:
                found += [along(axis, one, 0, 0, max(0.5 * high, 2 * g) + aside * 0.9) for one in nut]
        return found

    def _round(self, n: int) -> list[Solid]:
        r, half = self.size, self.long * self.size
        lid, wide = 0.25 * r, 1.1 * r
        ends = ((half - 0.05 * r, half + lid), (-half - lid, -half + 0.05 * r))
        body = [turned(outline(r, -half, r, half), n), *(cylinder(wide, *span, n) for span in ends[: self.lids])]
        if self.form == "pot":
            body[0] = turned(outline(0.5 * r, -half, r, -0.4 * half, r, half), n)
        elif self.form == "double":
            half = max(half, r)
            body[0] = turned(outline(r, -half, r, -0.3 * half, 0.8 * r, -0.2 * half, 0.8 * r, half, r, half), n)
            body[1:] = [cylinder(wide, *span, n) for span in ((0.7 * half, half + lid), (-half - lid, -0.7 * half))]
        if self.display:
            body.append(cylinder(0.7 * r, 0.5 * half, half + lid + 0.12 * r, n))
        if self.form in ("can", "pot"):
            below = lid if self.lids == 2 else 0.0
            return [moved(one, at(0, 0, half + below)) for one in body]
        if self.form == "tilted":
            pose = at(0, 0, 0.7 * (r + half) + 0.1 * r) @ spun("y", 0.8)
            return [cylinder(0.55 * r, 0.0, 0.9 * r, n), *(moved(one, pose) for one in body)]
        up = 1.5 * r if self.form == "double" else 1.15 * r
        return [cylinder(0.5 * r, 0.0, up, min(n, 12)), *(along("x", one, 0, 0, up) for one in body)]

    def _square(self, n: int) -> list[Solid]:
        r, tall = self.size, 2 * self.long * self.size
        deep = self.deep * r
        if self.form == "ball":
            shell = moved(ball(r, n), at(0, 0, 0.95 * r))
            return [shell, along("-y", cylinder(0.8 * r, 0.3 * r, 1.05 * r, n), 0, 0, 0.95 * r)]
        if self.form == "wedge":
            side = np.array([(-deep, 0.0), (deep, 0.0), (deep, tall), (0.0, tall), (-deep, 0.35 * tall)])
            found = [moved(along("-y", extrude(side, -r, r)), spun("z", np.pi / 2))]
            if self.display:
                found.append(box((1.2 * r, 1.2 * deep, 0.5 * tall), (0, -0.1 * deep, 0.6 * tall)))
            return found
        low = 0.5 * r if self.form == "slab" else 0.0
        found = [box((2 * r, 2 * deep, tall), (0, 0, low + tall / 2))]
        if low:
            found.append(cylinder(min(0.5 * r, 0.9 * deep), 0.0, low + 0.01, min(n, 12)))
        if self.display:
            found.append(box((1.3 * r, 0.2 * deep, 0.5 * tall), (0, -deep, low + 0.6 * tall)))
        else:
            found.append(box((2.1 * r, 0.25 * deep, 1.02 * tall), (0, -deep, low + tall / 2)))
        return found


def _head() -> _Head:
    return nested(_Head, "head", fixed=lambda p: {"facets": p.facets})


class _Post(Params):
    """What carries a head on a body."""

    facets: int = given(0, FACETS_TEXT)
    form: str = among(("round", "round", "square", "cone", "collar", "none"), "its form")
    rise: float = between(0.01, 0.14, "its height", "m", when=lambda p: p.form != "none")
    radius: float = between(0.01, 0.034, "its radius", "m", when=lambda p: p.form != "none")

    def solids(self, t: Table, start: float, top: float) -> list[Solid]:
        """Its solids about z, from inside a body that ends at a height up."""
        r, end = min(self.radius, 0.8 * top + 0.004), top + self.rise + 0.002
        n = min(sides_of(t, 0.02, self.facets), 16)
        if self.form == "none":
            return []
        if self.form == "square":
            return [box((2 * r, 2 * r, end - start), (0, 0, (start + end) / 2))]
        if self.form == "cone":
            return [turned(outline(1.7 * r, start, 1.7 * r, top, r, end), n)]
        collar = [cylinder(1.6 * r, end - 0.3 * self.rise, end, n)] if self.form == "collar" else []
        return [cylinder(r, start, end, n), *collar]


def _post() -> _Post:
    return nested(_Post, "post", fixed=lambda p: {"facets": p.facets})


def _holed(t: Table, dn: int, flat: tuple[float, float], low: float, high: float, soft: float = 0.0) -> Solid:
    """A rectangular block about z round a tube, with the tube's hole where the style has one."""
    wide, deep = flat
    plan = (
        rounded_rectangle(wide, deep, soft, 3)
        if soft
        else np.array([(-wide / 2, -deep / 2), (wide / 2, -deep / 2), (wide / 2, deep / 2), (-wide / 2, deep / 2)])
    )
    bore = bore_of(dn, t.style)
    hole = 0.5 * (bore + t.pipe.radius)
    return extrude(plan, low, high, (circle(hole, t.n(hole, 8)),) if bore else ())


def _tube(t: Table, dn: int, ends: str, length: float, radius: float, n: int) -> list[Solid]:
    """A tube along x with its ends; its first solid has both faces."""
    bore, r, size = bore_of(dn, t.style), max(radius, 1.02 * t.pipe.radius), t.flange
    if ends == "casting":
        low = plate_thickness(dn) + min(0.7 * nut_room(dn), 0.15 * length)
        return [measuring_tube(dn, t.style, length, [(r, low), (r, length - low)])]
    if ends == "discs":
        out, low = size.outer / 2, plate_thickness(dn)
        shape = outline(out, 0.0, out, low, r, low, r, length - low, out, length - low, out, length)
    elif ends == "wafer":
        out = 0.485 * (size.circle - size.bolt)
        shape = outline(out, 0.0, out, length)
    else:
        shape = outline(r, 0.0, r, length)
    found = [along("x", turned(shape, n, bore=bore))]
    cap = min(0.2 * length, 0.012 + 0.6 * r)
    wall = 0.5 * (bore + t.pipe.radius) if bore else 0.0
    spans = ((0.0, cap), (length - cap, length))
    if ends == "hexagons":
        found += [along("x", hexagon(2.5 * r, a, b, wall, max(n, 8))) for a, b in spans]
    elif ends == "collars":
        found += [along("x", ring(wall, 1.3 * r, a, b, n)) for a, b in spans]
    return found


def _room(t: Table, dn: int, ends: str) -> float:
    """Length that a device's ends take up [m]."""
    flanged = _JOINTS.get(ends) == "flanged"
    return 2 * (plate_thickness(dn) + 0.7 * nut_room(dn)) + 0.02 if flanged else 0.03 + 0.8 * t.pipe.radius


class HeadOnTube(Melting, FlowMeter, name="flow meter/plain head on tube", sizes=SIZES, weight=1.5):
    """A magnetic, vortex, turbine or Coriolis meter: a tube, drum, barrel or block, a post, a head with its glands."""

    melted: bool = chance(0.6, "all of it is one mesh")
    ends: str = among(("casting", "casting", "discs", "discs", "wafer", "hexagons", "collars", "plain"), _ENDS_TEXT)
    form: str = among(
        ("tube", "drum", "drum", "barrel", "block", "coils", "octagon", "hump"),
        "its body",
        when=lambda p: p.ends != "wafer",
        otherwise="tube",
    )
    long: float = between(1.2, 5.5, "its length without its ends / radius of the pipe")
    more: float = between(0.03, 0.14, "further length", "m")
    wide: float = between(1.2, 2.1, "radius of its body / of the pipe", when=lambda p: p.form != "tube")
    part: float = between(0.45, 0.98, "length of its body / length without its ends", when=lambda p: p.form != "tube")
    off: float = among((0.5, 0.5, 0.5, 0.4, 0.6), "where its post stands / length")
    post: _Post = _post()
    head: _Head = _head()
    turn: float = among((0.0, np.pi / 2, np.pi, -np.pi / 2), "which way its head looks", "rad")
    lean: float = among((0.0, 0.0, 0.0, np.pi / 2, -np.pi / 2), "of post and head from upright", "rad")

    def build(self, t: Table) -> Model:
        r, room = t.pipe.radius, _room(t, self.dn, self.ends)
        length = round(room + self.long * r + self.more, 6)
        if self.ends == "wafer":
            length = round(0.6 * self.more + 0.03 + 0.12 * self.long * r, 6)
        n = self.n(t, 1.5 * r)
        body = _tube(t, self.dn, self.ends, length, r, n)
        top = 0.485 * (t.flange.circle - t.flange.bolt) if self.ends == "wafer" else r
        if self.form != "tube":
            half, top = 0.5 * self.part * (length - room), self.wide * r + 0.004
            body += self._middle(t, length / 2 - half, length / 2 + half, top, n)
        top *= 0.97
        start = max(0.8 * top, 0.9 * r) if bore_of(self.dn, t.style) else 0.5 * r
        off = 0.5 if self.ends == "wafer" else 0.5 + (self.off - 0.5) * (length - room) / length
        lean = 0.0 if self.ends == "wafer" else self.lean
        clear = max(0.0, t.flange.outer / 2 - top) if self.ends == "wafer" else 0.0
        if self.post.form == "none":
            post = [cylinder(0.6 * self.head.size, start, top + clear + 0.002, 12)]
            high = top + clear
        else:
            post, high = self.post.solids(t, start, top + clear), top + clear + self.post.rise
        head = [moved(one, at(0, 0, high) @ spun("z", self.turn)) for one in self.head.solids(t)]
        pose = at(off * length) @ spun("x", lean)
        post, head = [moved(one, pose) for one in post], [moved(one, pose) for one in head]
        if self.melted:
            t.add(NAME, *body, *post, *head)
        else:
            t.add(NAME, *body, *post)
            put(t, _HEAD, *head, of="gauge")
        return t.model(length, _JOINTS.get(self.ends, "welded"), NAME)

    def _middle(self, t: Table, low: float, high: float, wide: float, n: int) -> list[Solid]:
        r, long, bore = t.pipe.radius, high - low, bore_of(self.dn, t.style)
        hole = 0.5 * (bore + r) if bore else 0.0
        if self.form in ("block", "hump"):
            found = [along("x", _holed(t, self.dn, (2 * wide, 2 * wide), low, high, 0.3 * wide))]
            if self.form == "hump":
                found = [along("x", turned(outline(1.1 * r, low, 1.1 * r, high), n, bore=hole))]
                found.append(box((0.8 * long, 1.3 * r, wide - 0.7 * r), ((low + high) / 2, 0, (wide + 0.7 * r) / 2)))
            return found
        shape = outline(wide, low, wide, high)
        if self.form == "barrel":
            shape = outline(1.1 * r, low, wide, low + 0.25 * long, wide, high - 0.25 * long, 1.1 * r, high)
        elif self.form == "coils":
            a, b = low + 0.18 * long, high - 0.18 * long
            shape = outline(wide, low, wide, a, 0.85 * wide, a, 0.85 * wide, b, wide, b, wide, high)
        return [along("x", turned(shape, 8 if self.form == "octagon" else n, bore=hole))]


class PlainRotameter(Melting, FlowMeter, name="flow meter/plain rotameter", sizes=sizes_between(15, 100), weight=1.5):
    """A variable-area meter: a metal tube with a dial box, a clear tube with unions, a block, a glass in a cage."""

    melted: bool = chance(0.6, "all of it is one mesh")
    form: str = among(("dial", "dial", "clear", "block", "cage"), "how it is made")
    ends: str = among(
        ("casting", "discs", "discs", "hexagons", "collars"),
        _ENDS_TEXT,
        when=lambda p: p.form == "dial",
        otherwise="discs",
    )
    long: float = between(3.0, 10.0, "its length without its ends / radius of the pipe")
    more: float = between(0.05, 0.14, "further length", "m")
    wide: float = between(1.05, 1.7, "radius of its tube, or half the width of its block / radius of the pipe")
    case: str = among(("square", "round", "wedge", "tall", "drum"), "its dial box", when=lambda p: p.form == "dial")
    size: float = between(0.04, 0.09, "half the width of the dial box", "m", when=lambda p: p.form == "dial")
    deep: float = between(0.5, 1.6, "depth of that / half its width", when=lambda p: p.form == "dial")
    neck: float = between(0.0, 0.07, "from the tube to the box", "m", when=lambda p: p.form == "dial")
    gland: bool = chance(0.4, "a gland below the box", when=lambda p: p.form == "dial")
    thick: float = between(0.8, 1.6, "depth of its block / width", when=lambda p: p.form == "block")
    knob: bool = chance(0.5, "a needle valve's knob", when=lambda p: p.form in ("block", "clear"))
    flare: float = between(1.0, 1.35, "outlet / inlet of its glass", when=lambda p: p.form in ("clear", "cage"))
    nut: float = between(1.4, 2.0, "radius of its union nuts / of the pipe", when=lambda p: p.form == "clear")
    ribs: int = among((0, 6, 8, 12), "grips of a union nut; 0: round", when=lambda p: p.form == "clear")
    flanged: bool = chance(0.6, "its cage has the pipe's flanges", when=lambda p: p.form == "cage")
    rods: int = among((2, 3, 4, 4), "of its cage", when=lambda p: p.form == "cage", otherwise=4)
    plates: bool = chance(0.3, "its cage is of two plates, not rods", when=lambda p: p.form == "cage")

    def build(self, t: Table) -> Model:
        if self.form == "dial":
            return self._dial(t)
        if self.form == "clear":
            return self._clear(t)
        return self._block(t) if self.form == "block" else self._cage(t)

    def _put(
        self, t: Table, body: list[Solid], pieces: list[tuple[str, list[Solid]]], joint: str, long: float
    ) -> Model:
        if self.melted:
            t.add(NAME, *body, *(one for _, some in pieces for one in some))
        else:
            t.add(NAME, *body)
            for name, some in pieces:
                front = BEFORE if name in ("gauge face", "gauge glass") else None
                t.add(name, *some, of="trim" if name == NAME else "", front=front)
        return t.model(long, joint, NAME)

    def _dial(self, t: Table) -> Model:
        r, s = t.pipe.radius, self.size
        length = round(_room(t, self.dn, self.ends) + max(self.long * r, 2.3 * s) + self.more, 6)
        tube, x, deep = self.wide * r, length / 2, self.deep * s
        n, body = self.n(t, tube), _tube(t, self.dn, self.ends, length, tube, self.n(t, tube))
        near = max(tube, 1.02 * r) + self.neck
        hold = along("-y", cylinder(0.45 * s, 0.7 * tube, near + 0.5 * deep, n), x)
        low = near - 0.1 * min(tube, s)
        if self.case in ("round", "drum"):
            shape = outline(s, low, s, near + deep)
            if self.case == "drum":
                shape = outline(0.6 * s, low, s, near + 0.3 * deep, s, near + deep)
            case = [along("-y", turned(shape, n), x)]
        elif self.case == "wedge":
            side = np.array([(0.0, -s), (0.6 * deep + near - low, -s), (deep + near - low, s), (0.0, s)])
            case = [moved(along("-y", extrude(side, -s, s)), at(x, -low) @ spun("z", -np.pi / 2))]
        else:
            tall = 3.0 * s if self.case == "tall" else 2 * s
            tall = min(tall, 0.95 * length)
            size = (tall, deep + near - low, 2 * s) if self.case == "tall" else (2 * s, deep + near - low, tall)
            case = [box(size, (x, -(low + near + deep) / 2, 0))]
        if self.gland:
            case += [along("-z", one, x, -near - 0.5 * deep, 0) for one in _stub(0.009, 8, 0.5 * s, s, False)]
        face = near + deep
        if self.case == "wedge":
            window = box((1.4 * s, 0.3 * deep, 0.8 * s), (x, -near - 0.68 * deep, 0))
        elif self.case in ("round", "drum"):
            window = along("-y", cylinder(0.85 * s, face - 0.002, face + 0.004, n), x)
        else:
            window = box((1.4 * s, 0.008, 1.4 * s), (x, -face, 0))
        pieces = [(NAME, [hold]), (CASE, case), ("gauge face", [window])]
        return self._put(t, body, pieces, _JOINTS.get(self.ends, "welded"), length)

    def _clear(self, t: Table) -> Model:
        r = t.pipe.radius
        length = round(self.more + 0.05 + self.long * r, 6)
        bore, n, end = bore_of(self.dn, t.style), self.n(t, r), min(0.16 * length, 0.03 + 1.2 * r)
        glass = self.wide * 0.85 * r
        nut, wall = max(self.nut * r, 1.1 * self.flare * glass), 0.5 * (bore + r) if bore else 0.0
        sides = self.ribs or n
        ends = [turned(outline(1.15 * r, a, 1.15 * r, b), n, bore=bore) for a, b in ((0, end), (length - end, length))]
        spans = ((0.5 * end, 1.3 * end), (length - 1.3 * end, length - 0.5 * end))
        nuts = [turned(outline(nut, a, nut, b), sides, bore=wall) for a, b in spans]
        inner = 0.85 * min(glass, r) if bore else 0.0
        tube = turned(outline(glass, 0.9 * end, self.flare * glass, length - 0.9 * end), n, bore=inner)
        body, far = [along("x", one) for one in (*ends, *nuts)], length / 2
        if self.knob:
            k = 0.6 * r + 0.006
            shape = [cylinder(0.4 * k, 0.9 * nut, nut + 1.5 * k, 8), cylinder(k, nut + k, nut + 2 * k, min(n, 12))]
            body += [along("-y", one, 0.9 * end) for one in shape]
        pieces = [("gauge glass", [along("x", tube)])]
        if bore:
            z, g = far, 0.84 * inner
            bob = turned(outline(0.2 * g, z - g, g, z, g, z + 0.3 * g), min(n, 12))
            pin = rod((0.5 * end, 0, 0), (length - 0.5 * end, 0, 0), 0.1 * g, 6)
            pieces.append(("gauge needle", [along("x", bob), pin]))
        return self._put(t, body, pieces, "welded", length)

    def _block(self, t: Table) -> Model:
        r = t.pipe.radius
        length = round(self.more + 0.04 + self.long * r, 6)
        wide, end, n = 2 * self.wide * r + 0.008, 0.1 * length, self.n(t, r)
        deep = max(self.thick * wide, 2.3 * r)
        body = _tube(t, self.dn, "hexagons", length, r, n)
        body.append(along("x", _holed(t, self.dn, (wide, deep), end, length - end)))
        y, z = -deep / 2, wide / 2
        window = box((0.6 * length, 0.01, 0.4 * wide), (0.5 * length, y, 0))
        flat = box((0.7 * length, 0.006, 0.8 * wide), (0.5 * length, y, 0))
        pieces = [(NAME, [flat]), ("gauge glass", [window])]
        if self.knob:
            k = 0.3 * z + 0.004
            shape = [cylinder(0.5 * k, -0.3 * k, 1.5 * k, 8), cylinder(k, k, 2.4 * k, min(n, 12))]
            pieces.append((NAME, [along("-y", one, 1.6 * end, y) for one in shape]))
        return self._put(t, body, pieces, "welded", length)

    def _cage(self, t: Table) -> Model:
        r, size = t.pipe.radius, t.flange
        bore, n, low = bore_of(self.dn, t.style), self.n(t, 1.5 * r), plate_thickness(self.dn)
        out = size.outer / 2 if self.flanged else 1.7 * self.wide * r
        lead = low + 0.7 * nut_room(self.dn) if self.flanged else 0.02 + 0.4 * r
        length = round(2 * lead + self.more + self.long * r, 6)
        glass, plate = 0.8 * self.wide * r, 0.008 + 0.15 * r
        head = max(1.5 * self.flare * glass, 1.5 * r)
        foot = low if self.flanged else 0.4 * lead
        shape = outline(out, 0, out, foot, 1.1 * r, foot, 1.1 * r, lead, head, lead, head, lead + plate)
        cap = along("x", turned(shape, n, bore=bore))
        body = [cap, moved(cap, at(length) @ spun("z", np.pi))]
        a, b = lead + 0.6 * plate, length - lead - 0.6 * plate
        inner = 0.85 * min(glass, r) if bore else 0.0
        tube = along("x", turned(outline(glass, a, self.flare * glass, b), n, bore=inner))
        if self.plates:
            slab = box((b - a + plate, 0.003 + 0.05 * r, 1.2 * head), ((a + b) / 2, 0, 0))
            bars = [moved(slab, at(0, s * 0.88 * head * 0.8)) for s in (-1, 1)]
        else:
            bars = [along("x", around(cylinder(0.08 * r + 0.002, a, b, 6), self.rods, 0.88 * head, np.pi / 4))]
        return self._put(
            t, body, [("gauge glass", [tube]), (NAME, bars)], "flanged" if self.flanged else "welded", length
        )


class PlainTransmitter(
    Melting, Gauge, name="transmitter/plain level or pressure", label=_HEAD, bundle=_HEAD, weight=1.5
):
    """A level or pressure transmitter: a radar, a cone, a rod's head, a cell, a sensor, a seal, a switch."""

    melted: bool = chance(0.6, "all of it is one mesh")
    form: str = among(
        ("radar", "radar", "cone", "rod", "cell", "cell", "sensor", "switch", "seal"), "what stands below its head"
    )
    scale: float = between(0.7, 1.5, "its size / usual")
    stub: float = between(0.01, 0.08, "height of the stub it stands on", "m")
    joint: str = among(("hexagon", "disc", "disc", "clamp", "square"), "what it is screwed or bolted in by")
    disc: float = between(0.035, 0.1, "radius of that flange, clamp or seal", "m")
    rise: float = between(0.02, 0.2, "height of its neck", "m")
    fins: int = among((0, 0, 3, 5), "cooling fins on its neck")
    bolts: int = among((0, 4, 4, 8), "bolts of its flange or cell")
    long: float = between(0.8, 2.6, "height of its body / its width")
    topped: str = among(
        ("flat", "dome", "step", "cone"), "its top", when=lambda p: p.form in ("cone", "sensor", "switch")
    )
    plug: str = among(("up", "up", "elbow", "cable", "none"), "its connector", when=lambda p: p.form == "sensor")
    head: _Head = _head()
    turn: float = between(0, 6, "which way it looks", "rad")

    def build(self, t: Table) -> Model:
        t, s = t.spun("z", self.turn), self.scale
        stem, low = self._joint(t)
        maker = {"cone": self._cone, "sensor": self._sensor, "switch": self._switch, "cell": self._cell}
        if self.form in maker:
            body, top = maker[self.form](t, low)
        else:
            body, top = self._neck(t, low, 0.012 * s if self.form != "radar" else 0.02 * s)
        if self.form in ("radar", "rod", "cell", "seal"):
            body += [moved(one, at(0, 0, top - 0.0015)) for one in self.head.solids(t)]
        if self.melted:
            t.add(_HEAD, *stem, *body, of="gauge")
        else:
            t.bundled(STEM).add(STEM, *stem)
            t.add(_HEAD, *body, of="gauge")
        level = self.form in ("radar", "cone", "rod")
        return t.model(kind="level transmitter" if level else "pressure transmitter")

    def _joint(self, t: Table) -> tuple[list[Solid], float]:
        s, r = self.scale, self.disc
        pipe = 0.011 * s if self.form in ("rod", "sensor", "cell", "switch") else 0.45 * r
        if self.form not in ("radar", "cone", "seal"):
            r = min(r, 0.05)
        n, low = self.n(t, r), self.stub
        stem, thick = [cylinder(pipe, 0.0, low + 0.003, min(n, 20))], 0.012 * s
        joint = "disc" if self.form == "seal" else self.joint
        if joint == "hexagon":
            return [
                *stem,
                hexagon(3.4 * pipe if pipe < 0.02 else 2.5 * pipe, low, low + 1.5 * thick),
            ], low + 1.5 * thick
        if joint == "square":
            return [*stem, box((1.6 * r, 1.6 * r, thick), (0, 0, low + thick / 2))], low + thick
        if joint == "clamp":
            shape = outline(0.7 * r, low, r, low + 0.6 * thick, r, low + thick, 0.7 * r, low + 1.6 * thick)
            return [*stem, turned(shape, n)], low + 1.6 * thick
        high = low + (2.0 if self.form != "seal" else 2.6) * thick
        stem += [cylinder(r, low, low + 0.95 * thick, n), cylinder(0.98 * r, low + 0.9 * thick, high, n)]
        if self.bolts:
            stem.append(around(cylinder(0.08 * r + 0.001, low - 0.005, high + 0.006, 6), self.bolts, 0.8 * r))
        return stem, high

    def _neck(self, t: Table, low: float, r: float) -> tuple[list[Solid], float]:
        top, n = low + self.rise, self.n(t, r)
        body = [cylinder(r, low - 0.002, top, n)]
        if self.form == "radar":
            body = [turned(outline(1.9 * r, low - 0.002, r, low + 0.5 * self.rise, r, top), n)]
        step = self.rise / (self.fins + 1)
        body += [
            cylinder(1.8 * r, low + (k + 0.6) * step, low + (k + 0.95) * step, n)
            for k in range(self.fins)
            if step > 0.004
        ]
        return body, top

    def _cone(self, t: Table, low: float) -> tuple[list[Solid], float]:
        r = 0.042 * self.scale
        n, tall = self.n(t, r), self.long * 1.3 * r
        top = low + tall
        shape = outline(0.6 * r, low - 0.002, 0.6 * r, low + 0.25 * tall, r, low + 0.7 * tall, r, top)
        if self.topped == "step":
            shape = outline(0.6 * r, low - 0.002, 0.6 * r, low + 0.4 * tall, r, low + 0.4 * tall, r, top)
        elif self.topped == "cone":
            shape = outline(r, low - 0.002, r, low + 0.3 * tall, 0.6 * r, low + 0.7 * tall, 0.6 * r, top)
        body = [turned(shape, n)]
        if self.topped == "dome":
            body.append(dome(r, 0.5 * r, top - 0.001, n))
        g = 0.009 * self.scale
        return [
            *body,
            *(along("x", one, 0, 0, top - 1.6 * g) for one in _stub(g, n, 0.5 * r, r, self.plug == "cable")),
        ], top

    def _sensor(self, t: Table, low: float) -> tuple[list[Solid], float]:
        r = 0.014 * self.scale
        n, top = self.n(t, r), low + 2 * self.long * r
        body = [cylinder(r, low - 0.002, top, n)]
        if self.topped == "step":
            body.append(cylinder(1.25 * r, low + 0.5 * (top - low), top, n))
        elif self.topped == "cone":
            body.append(turned(outline(r, top - 0.001, 0.6 * r, top + 0.6 * r), n))
            top += 0.58 * r
        if self.plug == "up":
            body += [cylinder(0.6 * r, top - 0.002, top + 1.6 * r, n), cylinder(0.72 * r, top + 0.3 * r, top + r, 6)]
        elif self.plug == "elbow":
            body += [box((1.9 * r, 1.9 * r, 1.8 * r), (0, 0, top + 0.89 * r))]
            body += [along("x", one, 0, 0, top + 0.9 * r) for one in _stub(0.4 * r, n, 0.5 * r, 0.95 * r, False)]
        elif self.plug == "cable":
            body += [moved(one, at(0, 0, top)) for one in _stub(0.4 * r, n, -0.002, 0.0, True)]
        return body, top

    def _switch(self, t: Table, low: float) -> tuple[list[Solid], float]:
        w = 0.06 * self.scale
        tall, deep = 0.7 * self.long * w + 0.02, 0.75 * w
        body = [cylinder(0.3 * w, low - 0.002, low + 0.3 * w, self.n(t, 0.3 * w))]
        low += 0.28 * w
        top = low + tall
        body.append(extrude(rounded_rectangle(w, deep, 0.15 * w, 3), low, top))
        if self.topped == "dome":
            body.append(along("y", cylinder(w / 2, -deep / 2, deep / 2, self.n(t, w / 2)), 0, 0, top))
        elif self.topped == "step":
            body.append(box((0.6 * w, 0.6 * deep, 0.4 * w), (0, 0, top + 0.15 * w)))
        elif self.topped == "cone":
            side = np.array([(-w / 2, -0.001), (w / 2, -0.001), (w / 4, 0.3 * w), (-w / 4, 0.3 * w)])
            body.append(along("-y", extrude(side, -deep / 2, deep / 2), 0, 0, top))
        else:
            body.append(box((1.08 * w, 1.08 * deep, 0.12 * w), (0, 0, top)))
        return [
            *body,
            *(along("x", one, 0, 0, low + 0.35 * tall) for one in _stub(0.008, 8, 0.3 * w, w / 2, False)),
        ], top

    def _cell(self, t: Table, low: float) -> tuple[list[Solid], float]:
        s, n = self.scale, self.n(t, 0.03)
        w, block = 0.09 * s, 0.035 * s
        body = [box((1.1 * w, 0.6 * w, block), (0, 0, low + block / 2 - 0.002))]
        low += block - 0.003
        tall = 0.95 * w
        mid = low + tall / 2
        body.append(along("y", cylinder(0.48 * w, -0.25 * w, 0.25 * w, n), 0, 0, mid))
        wings = [
            extrude(rounded_rectangle(w, tall, 0.15 * w, 2), a, b)
            for a, b in ((-0.45 * w, -0.2 * w), (0.2 * w, 0.45 * w))
        ]
        body += [along("y", one, 0, 0, mid) for one in wings]
        if self.bolts:
            bolt = along("y", cylinder(0.05 * w + 0.001, -0.56 * w, 0.56 * w, 6))
            body += [moved(bolt, at(x * 0.4 * w, 0, mid + z * 0.37 * tall)) for x in (-1, 1) for z in (-1, 1)]
        top = low + tall + 0.4 * self.rise
        return [*body, cylinder(0.22 * w, mid, top, n)], top


class PlainWindows(Melting, SightGlass, name="sight glass/plain windows", sizes=sizes_between(15, 150), weight=1.5):
    """A sight glass: a cross with round window flanges, long oval windows, a glass tube between flanges, a flapper."""

    melted: bool = chance(0.6, "all of it is one mesh")
    form: str = among(("cross", "cross", "flapper", "oval", "tube", "bowl"), "how it is made")
    ends: str = among(("casting", "discs", "discs", "hexagons", "collars", "plain"), _ENDS_TEXT)
    long: float = between(1.2, 4.5, "length beyond ends and windows / radius of the pipe")
    pane: float = between(0.75, 1.3, "radius or half the width of a window / of the pipe")
    rim: float = between(1.25, 1.8, "radius of a window's flange / of the window")
    reach: float = between(1.15, 1.8, "from the axis to the window's flange / radius of the body")
    thick: float = between(0.12, 0.35, "thickness of that flange / radius of the window")
    wide: float = between(1.03, 1.4, "radius of its body / of the pipe")
    sides: str = among(
        ("both", "both", "both", "one"), "on which sides it has windows", when=lambda p: p.form != "tube"
    )
    squared: bool = chance(0.25, "its window's flanges are square", when=lambda p: p.form in ("cross", "flapper"))
    sunk: bool = chance(0.5, "its panes lie deep in their flanges")
    bolts: int = among((0, 0, 4, 6, 8), "bolts of a window's flange")
    stretch: float = between(1.6, 3.5, "length / width of a window", when=lambda p: p.form == "oval", otherwise=1.0)
    bars: int = among((0, 3, 4, 4, 6), "bars along its glass", when=lambda p: p.form == "tube")

    def build(self, t: Table) -> Model:
        return self._tube(t) if self.form == "tube" else self._windows(t)

    def _windows(self, t: Table) -> Model:
        r = t.pipe.radius
        pane, body_r = self.pane * r + 0.006, self.wide * r
        rim, n = self.rim * pane, self.n(t, pane)
        span = 2 * (rim + (self.stretch - 1) * pane)
        length = round(_room(t, self.dn, self.ends) + span + 0.35 * self.long * r, 6)
        x, far = length / 2, self.reach * body_r + 0.004
        thick = self.thick * pane + 0.003
        body = _tube(t, self.dn, self.ends, length, body_r, n)
        axes = ("-y",) if self.sides == "one" else ("-y", "y")
        back = 0.0
        if self.form == "bowl":
            body.append(moved(ball(1.15 * max(rim, body_r), max(n, 8)), at(x)))
            far = max(far, 0.95 * rim)
        flange, glass, neck = self._cover(rim, pane, far, thick, back, n)
        panes = [along(axis, glass, x) for axis in axes]
        for axis in axes:
            body += [along(axis, one, x) for one in (neck, flange)]
            if self.bolts:
                body.append(along(axis, self._bolts(rim, pane, far, thick), x))
        if self.form == "flapper":
            k = 0.12 * pane + 0.003
            pin = [cylinder(k, back, body_r + 3 * k, 8), cylinder(2 * k, back, body_r + 1.5 * k, 6)]
            body += [moved(one, at(x - 0.3 * pane)) for one in pin]
            panes += [
                along(axis, box((1.3 * pane, 0.25 * pane, 0.3 * thick), (0.2 * pane, 0, far + 1.05 * thick)), x)
                for axis in axes
            ]
        return self._put(t, body, panes, length)

    def _cover(
        self, rim: float, pane: float, far: float, thick: float, back: float, n: int
    ) -> tuple[Solid, Solid, Solid]:
        low, high, wall = far, far + thick, 0.5 * (rim + pane)
        sill = (low + 0.45 * thick, low + 0.6 * thick) if self.sunk else (high - 0.3 * thick, high + 0.1 * thick)
        if self.form == "oval":
            flat = 2 * (self.stretch - 1) * pane
            plan, core, hole = (rounded_rectangle(2 * r + flat, 2 * r, 0.98 * r, 6) for r in (rim, wall, pane))
            flange = extrude(plan, low, high, (hole,) if self.sunk else ())
            return flange, extrude(0.96 * hole, *sill), extrude(core, back, low + 0.5 * thick)
        glass, neck = cylinder(0.97 * pane, *sill, n), cylinder(wall, back, low + 0.5 * thick, n)
        if self.squared:
            square = rounded_rectangle(2 * rim, 2 * rim, 0.2 * rim, 3)
            return extrude(square, low, high, (circle(pane, n),) if self.sunk else ()), glass, neck
        return ring(pane if self.sunk else 0.0, rim, low, high, n), glass, neck

    def _bolts(self, rim: float, pane: float, far: float, thick: float) -> Solid:
        r = 0.28 * (rim - pane) + 0.001
        bolt = cylinder(r, far - 0.3 * thick, far + thick + r, 6)
        middle = 0.5 * (rim + pane)
        if self.form != "oval":
            return around(bolt, self.bolts, middle, np.pi / 4)
        half = (self.stretch - 1) * pane
        places = [(x * half, y * middle) for x in (-1, 0, 1) for y in (-1, 1)]
        return merge([moved(bolt, at(px, py)) for px, py in places])

    def _tube(self, t: Table) -> Model:
        r, size = t.pipe.radius, t.flange
        flanged, n, bore = _JOINTS.get(self.ends) == "flanged", self.n(t, r), bore_of(self.dn, t.style)
        glass, plate = self.wide * 1.1 * r, 0.006 + 0.3 * self.thick * r
        lead = plate_thickness(self.dn) if flanged else 0.02 + 0.5 * r
        out, head = (size.outer / 2 if flanged else 1.1 * r), self.rim * glass
        inner = flanged and self.ends == "casting"
        gap = 0.7 * nut_room(self.dn) if inner else 0.0
        length = round(2 * (lead + gap + plate) + 0.03 + self.long * r, 6)
        shape = outline(out, 0, out, lead)
        if inner:
            shape += outline(1.1 * r, lead, 1.1 * r, lead + gap)
        if not flanged or inner:
            shape += outline(head, lead + gap, head, lead + gap + plate)
        cap = along("x", turned(shape, n, bore=bore))
        low = shape[-1][1] - 0.4 * plate
        body = [cap, moved(cap, at(length) @ spun("z", np.pi))]
        if self.bars:
            bar = cylinder(0.06 * r + 0.002, low, length - low, 6)
            body.append(along("x", around(bar, self.bars, 0.5 * (head + glass), np.pi / 4)))
        pipe = ring(0.85 * glass if bore else 0.0, glass, low, length - low, n)
        return self._put(t, body, [along("x", pipe)], length)

    def _put(self, t: Table, body: list[Solid], panes: list[Solid], length: float) -> Model:
        if self.melted:
            t.add(SIGHT_GLASS, *body, *panes)
        else:
            t.add(SIGHT_GLASS, *body)
            t.add("gauge glass", *panes, front=BEFORE)
        return t.model(length, _JOINTS.get(self.ends, "welded"), SIGHT_GLASS)


PLAIN_METERS = families_of(HeadOnTube, PlainRotameter, PlainTransmitter, PlainWindows)
