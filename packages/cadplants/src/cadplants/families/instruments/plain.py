"""Instruments as asset packs have them: few sides, plain solids, in a few pieces or melted into one mesh."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.dials import CASE, STEM
from cadplants.builder.melting import FACETS, FACETS_TEXT, Melting, sides_of
from cadplants.builder.params import Params, among, between, chance, given, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.instruments.flow import NAME, FlowMeter
from cadplants.families.instruments.pieces import BEFORE, FRONT, Gauge
from cadplants.families.instruments.sight import SIGHT_GLASS, SightGlass
from cadplants.families.valves.parts import bend
from cadplants.model.family import Model
from cadplants.model.standards import sizes_between
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, merge, moved
from cadplants.solids.primitives import along, around, box, cylinder, hexagon, ring, rod, rope, turned
from cadplants.solids.transforms import at, spun

__all__ = ["PLAIN_INSTRUMENTS"]

_HEAD = "transmitter"


class _Stem(Params):
    """A stem about z: a thread, a hexagon or square, a rod."""

    facets: int = given(0, FACETS_TEXT)
    radius: float = between(0.004, 0.011, "of the rod", "m")
    tall: float = between(0.015, 0.09, "height", "m")
    form: str = among(("hexagon", "hexagon", "square", "collar", "plain"), "what is on the rod")
    flats: float = between(1.5, 2.4, "width of that / of the rod")
    place_at: float = between(0.15, 0.6, "where that is / height")

    def solids(self, t: Table) -> list[Solid]:
        """Its solids from 0 to its height."""
        r, tall = self.radius, self.tall
        n, low, wide = min(sides_of(t, r, self.facets), 12), self.place_at * tall, self.flats * r
        solids = [cylinder(r, 0.0, tall + 0.001, n)]
        if self.form == "hexagon":
            solids.append(hexagon(2 * wide, low, low + 0.3 * tall + 0.003))
        elif self.form == "square":
            solids.append(box((1.8 * wide, 1.8 * wide, 0.3 * tall), (0, 0, low + 0.2 * tall)))
        elif self.form == "collar":
            solids.append(cylinder(wide, low, low + 0.15 * tall + 0.002, n))
        return solids


class _PlainGauge(Melting, Gauge):
    """An instrument that may be one mesh."""

    melted: bool = chance(0.4, "all of it is one mesh")


def _stem() -> _Stem:
    return nested(_Stem, "stem", fixed=lambda p: {"facets": p.facets})


class BoxOnStem(_PlainGauge, name="transmitter/plain box on stem", label=_HEAD, bundle=_HEAD, weight=1.5):
    """A pressure switch or a small transmitter: a stem, maybe a cell, a box with a lid, a gland or a plug aside."""

    stem: _Stem = _stem()
    wide: float = between(0.03, 0.11, "width of the box", "m")
    deep: float = between(0.5, 1.1, "depth / width")
    tall: float = between(0.6, 1.8, "height / width")
    cell: float = among((0.0, 0.0, 0.6, 0.9), "width of a cell below the box / of the box; 0: none")
    lid: str = among(("none", "front", "top", "window"), "its lid")
    gland: str = among(("side", "side", "below", "top", "none"), "where its cable leaves")
    cabled: bool = chance(0.35, "a stub of cable", when=lambda p: p.gland != "none")
    aside: float = among((0.0, 0.0, 0.5), "of the box from the stem's axis / half its width")
    turn: float = between(0, 6, "which way it looks", "rad")

    def build(self, t: Table) -> Model:
        wide, deep, tall = self.wide, self.deep * self.wide, self.tall * self.wide
        low, n, stem = self.stem.tall, self.n(t, 0.2 * self.wide), self.stem.solids(t)
        if self.cell:
            high = 0.35 * wide
            stem.append(cylinder(0.5 * self.cell * min(wide, deep), low - 0.001, low + high, n))
            low += high
        x = 0.5 * self.aside * wide
        case = [box((wide, deep, tall), (x, 0, low + tall / 2 - 0.0005)), *self._lid(wide, deep, tall, x, low)]
        if self.gland != "none":
            case.append(self._gland(wide, deep, tall, x, low, n))
        t = t.spun("z", self.turn)
        if self.melted:
            t.add(_HEAD, *stem, *case, of="gauge")
        else:
            t.bundled(STEM).add(STEM, *stem)
            t.add(_HEAD, *case, of="gauge")
        return t.model(kind="pressure switch")

    def _lid(self, wide: float, deep: float, tall: float, x: float, low: float) -> list[Solid]:
        mid = low + tall / 2
        if self.lid == "front":
            return [box((1.06 * wide, 0.12 * deep, 1.04 * tall), (x, -0.5 * deep, mid))]
        if self.lid == "top":
            return [box((1.06 * wide, 1.06 * deep, 0.12 * tall), (x, 0, low + tall))]
        if self.lid == "window":
            return [box((0.6 * wide, 0.06 * deep, 0.35 * tall), (x, -0.5 * deep, mid + 0.1 * tall))]
        return []

    def _gland(self, wide: float, deep: float, tall: float, x: float, low: float, n: int) -> Solid:
        r = 0.11 * min(wide, deep, tall) + 0.002
        nut = [cylinder(1.4 * r, -0.2 * r, 1.2 * r, 6), cylinder(1.0 * r, 0.0, 2.6 * r, min(n, 10))]
        if self.cabled:
            nut.append(rope([(0, 0, 2 * r), (0, 0, 6 * r), (0, -2 * r, 10 * r), (0, -6 * r, 13 * r)], 0.6 * r, 6))
        axis, place = {
            "side": ("x", (x + wide / 2, 0.0, low + 0.4 * tall)),
            "below": ("-z", (x + 0.36 * wide, 0.0, low)),
            "top": ("z", (x, 0.15 * deep, low + tall)),
        }[self.gland]
        return along(axis, merge(nut), *place)


class HeadOnStem(_PlainGauge, name="transmitter/plain head on stem", label=_HEAD, bundle=_HEAD, weight=1.5):
    """A transmitter in few sides: a stem, a neck, a drum, can, pot or ball with a lid, a gland aside."""

    stem: _Stem = _stem()
    form: str = among(("drum", "drum", "can", "pot", "tilted"), "its head")
    size: float = between(0.018, 0.055, "radius of the head", "m")
    long: float = between(0.8, 2.2, "length of the head / radius")
    lids: int = whole(0, 2, "lids")
    neck: float = between(0.3, 0.7, "radius of the neck / of the head")
    gland: bool = chance(0.7, "a gland aside")
    cabled: bool = chance(0.3, "a stub of cable", when=lambda p: p.gland)
    turn: float = between(0, 6, "which way it looks", "rad")

    def build(self, t: Table) -> Model:
        r, low = self.size, self.stem.tall
        n, half, lid = self.n(t, r), 0.5 * self.long * r, 0.22 * r
        body = [cylinder(r, -half, half, n)]
        ends = ((half - 0.2 * lid, half + lid), (-half - lid, -half + 0.2 * lid))
        body += [cylinder(1.12 * r, *span, n) for span in ends[: self.lids]]
        up = {"drum": r, "can": half, "pot": half, "tilted": 0.8 * r + 0.3 * half}[self.form] + 0.3 * r
        if self.form == "pot":
            body[0] = turned(outline(0.55 * r, -half, r, -0.5 * half, r, half), n)
        tilt = {"drum": np.pi / 2, "tilted": 0.7}.get(self.form, 0.0)
        pose = at(0, 0, low + up + (lid if self.lids == 2 and self.form != "drum" else 0.0)) @ spun("y", tilt)
        head = [moved(one, pose) for one in body]
        head.append(cylinder(self.neck * r, low - 0.001, low + up, min(n, 12)))
        if self.gland:
            g, z = 0.16 * r + 0.002, low + up
            nut = [cylinder(1.4 * g, 0.9 * r, r + 1.5 * g, 6), cylinder(g, 0.9 * r, r + 3 * g, min(n, 8))]
            if self.cabled:
                nut.append(rope([(0, 0, r + 2 * g), (0, 0, r + 7 * g), (0, -5 * g, r + 12 * g)], 0.6 * g, 6))
            head += [along("y", one, 0, 0, z) for one in nut]
        t = t.spun("z", self.turn)
        if self.melted:
            t.add(_HEAD, *self.stem.solids(t), *head, of="gauge")
        else:
            t.bundled(STEM).add(STEM, *self.stem.solids(t))
            t.add(_HEAD, *head, of="gauge")
        return t.model(kind="pressure transmitter")


class _PlainDial(Params):
    """A round case about z in few sides: a plain disc, one with a rim, a dished back; a face, a needle, a glass."""

    facets: int = given(0, FACETS_TEXT)
    size: float = among((0.03, 0.04, 0.05, 0.063, 0.08, 0.1, 0.1, 0.16), "diameter", "m")
    deep: float = between(0.18, 0.6, "depth / diameter")
    form: str = among(("disc", "rim", "rim", "dished", "bezel"), "its case")
    pointed: bool = chance(0.6, "a needle")
    reading: float = between(0, 2 * np.pi, "where that points", "rad", when=lambda p: p.pointed)
    glazed: bool = chance(0.3, "a glass", when=lambda p: p.form != "disc")

    def pieces(self, t: Table) -> list[tuple[str, list[Solid]]]:
        """Its pieces, its back on z = 0 and its front towards +z."""
        r, d = self.size / 2, self.deep * self.size
        n, wall, floor = sides_of(t, self.size / 2, self.facets), 0.9 * self.size / 2, d
        shape = outline(r, 0.0, r, d)
        if self.form != "disc":
            floor = 0.75 * d
            back = {"rim": outline(r, 0.0), "dished": outline(0.7 * r, 0.0, r, 0.35 * d)}
            side = back.get(self.form, outline(0.94 * r, 0.0, 0.94 * r, 0.7 * d, 1.05 * r, 0.7 * d))
            shape = [*side, (1.05 * r if self.form == "bezel" else r, d), (wall, d), (wall, floor)]
        thin = 0.02 * r + 0.0004
        found = [(CASE, [turned(shape, n)]), ("gauge face", [cylinder(0.97 * wall, floor - 0.0002, floor + thin, n)])]
        if self.pointed:
            bar = box((0.95 * wall, 0.06 * r + 0.0004, thin), (0.3 * wall, 0, floor + 1.5 * thin))
            hub = cylinder(0.08 * r, floor + 0.5 * thin, floor + 2.5 * thin, 8)
            found.append(("gauge needle", [moved(bar, spun("z", self.reading)), hub]))
        if self.glazed:
            low = max(0.9 * d, floor + 3 * thin)
            found.append(("gauge glass", [cylinder(wall, low, low + thin, n)]))
        return found


def _put_dial(t: Table, dial: _PlainDial, stem: list[Solid], way: Floats, melted: bool) -> None:
    """Puts a dial down where a ``(4, 4)`` pose has its back, and its stem; melted into one mesh if asked for."""
    pieces, front = dial.pieces(t), tuple(float(v) for v in way[:3, 2])
    if melted:
        solids = [moved(one, way) for _, some in pieces for one in some]
        t.add("gauge", *solids, *stem, front=(front[0], front[1], front[2]))
        return
    t.bundled(STEM).add(STEM, *stem)
    for name, some in pieces:
        t.moved(way).add(name, *some, front=None if name == CASE else FRONT)


def _dial() -> _PlainDial:
    return nested(_PlainDial, "dial", fixed=lambda p: {"facets": p.facets})


class PlainDial(_PlainGauge, name="gauge/plain dial", weight=2):
    """A manometer in few sides: a dial upright on a stem, maybe on a U or a ring of bent pipe."""

    stem: _Stem = _stem()
    dial: _PlainDial = _dial()
    siphon: str = among(("none", "none", "none", "ring", "u"), "what it stands on")
    pipe: float = between(0.004, 0.009, "radius of that pipe", "m", when=lambda p: p.siphon != "none")
    bow: float = between(3.0, 5.5, "radius of its bends / of the pipe", when=lambda p: p.siphon != "none")
    turn: float = between(0, 6, "which way its dial looks", "rad")

    def build(self, t: Table) -> Model:
        t, stem = t.spun("z", self.turn), self.stem.solids(t)
        if self.siphon != "none":
            path = self._path()
            siphon = rope(path - path[-1], self.pipe, min(self.n(t, self.pipe), 10))
            t = t.at(*(float(v) for v in path[-1]))
            if self.melted:
                stem.append(siphon)
            else:
                t.bundled("siphon").add("siphon", siphon)
        top, d = self.stem.tall + 0.48 * self.dial.size, self.dial.deep * self.dial.size
        way = at(0, 0.4 * d, top) @ spun("x", np.pi / 2)
        _put_dial(t, self.dial, stem, way, self.melted)
        return t.model(kind="pressure gauge")

    def _path(self) -> Floats:
        """The middle line of a siphon from the origin up [m]."""
        bow, low = self.bow * self.pipe, 2.0 * self.bow * self.pipe
        if self.siphon == "ring":
            turns = np.linspace(np.pi, -np.pi, 15)
            loop = np.column_stack(
                [bow + bow * np.cos(turns), np.linspace(0, 2.4 * self.pipe, 15), low + bow * np.sin(turns)]
            )
            return np.vstack([[(0.0, 0.0, 0.0)], loop, [(0.0, 2.4 * self.pipe, low + 1.6 * bow)]])
        corners = [(0, 0, 0), (0, 0, 2 * low), (2 * bow, 0, 2 * low), (2 * bow, 0, 0.6 * low), (4 * bow, 0, 0.6 * low)]
        return bend([*corners, (4 * bow, 0, 2.2 * low)], 0.9 * bow, 4)


class PlainThermometer(_PlainGauge, name="thermometer/plain dial", weight=1.5):
    """A bimetal thermometer in few sides: its dial across the stem, upright or tilted on it, maybe over a well."""

    stem: _Stem = _stem()
    dial: _PlainDial = _dial()
    tilt: float = among((0.0, 0.0, np.pi / 4, np.pi / 2), "of the dial from across the stem", "rad")
    boss: float = among((0.0, 0.0, 1.6, 2.2), "radius of a boss at its foot / of the stem; 0: none")
    turn: float = between(0, 6, "which way its dial looks", "rad")

    def build(self, t: Table) -> Model:
        t, tall, stem = t.spun("z", self.turn), self.stem.tall, self.stem.solids(t)
        r, d = self.dial.size / 2, self.dial.deep * self.dial.size
        if self.boss:
            wide = self.boss * self.stem.radius
            stem.append(turned(outline(wide, 0.0, 0.8 * wide, 0.3 * tall), self.n(t, wide)))
        if self.tilt > 1.5:
            way = at(0, 0.4 * d, tall + 0.97 * r) @ spun("x", np.pi / 2)
        else:
            lift = 0.02 * r
            if self.tilt:
                knee = 0.25 * r + 0.6 * self.stem.radius
                stem.append(rod((0, 0, tall - 0.001), (0, -0.7 * knee, tall + 0.7 * knee), self.stem.radius, 8))
                stem.append(moved(cylinder(1.3 * self.stem.radius, -0.6 * knee, 0.4 * knee, 8), at(0, 0, tall)))
                way = at(0, -0.66 * knee, tall + 0.66 * knee) @ spun("x", self.tilt)
            else:
                way = at(0, 0, tall - lift)
        _put_dial(t, self.dial, stem, way, self.melted)
        return t.model(kind="thermometer")


class GlassBetweenBlocks(FlowMeter, name="flow meter/glass between blocks", sizes=sizes_between(15, 65), weight=1.5):
    """A rotameter: a straight or conical glass between two end blocks, a float, maybe tie rods, a scale, a shield."""

    facets: int = among(FACETS, FACETS_TEXT)
    corners: int = among((6, 6, 4, 8, 0), "sides of its end blocks; 0: round")
    long: float = between(6.0, 16.0, "(length - 60 mm) / radius of the pipe")
    block: float = between(0.1, 0.24, "length of a block / length")
    wide: float = between(1.3, 2.1, "radius of a block / of the pipe")
    glass: float = between(0.75, 1.15, "radius of the glass at its inlet / of the pipe")
    flare: float = between(1.0, 1.35, "radius at its outlet / there")
    nuts: bool = chance(0.5, "union nuts next to the glass")
    level: float = between(0.3, 0.7, "where the float is / length")
    rods: int = among((0, 0, 2, 3, 4), "tie rods")
    scale: bool = chance(0.4, "a scale plate behind it")
    solid: bool = chance(0.35, "no float is seen: the glass is solid")

    def build(self, t: Table) -> Model:
        r, line = t.pipe.radius, t.along("x")
        length = round(0.06 + self.long * r, 6)
        block, wide, bore = self.block * length, self.wide * r, bore_of(self.dn, t.style)
        n, glass = sides_of(t, wide, self.facets), self.glass * r
        phase = np.pi / 4 if self.corners == 4 else 0.0
        ends = [
            turned(outline(wide, z, wide, z + block), self.corners or n, phase, bore) for z in (0.0, length - block)
        ]
        low, high = 0.94 * block, length - 0.94 * block
        nut = 0.3 * block
        more: list[list[Solid]] = [[], []]
        if self.nuts:
            out = max(1.25 * self.flare * glass, 1.1 * r)
            more = [[ring(0.5 * glass, out, z, z + 1.2 * nut, n)] for z in (block - 0.2 * nut, length - block - nut)]
        for end, nuts in zip(ends, more, strict=True):
            line.add(NAME, end, *nuts, of="trim")
        self._tube(line, glass, low, high, n)
        if self.rods:
            far = wide * (0.86 if self.corners != 4 else 0.8)
            line.add(NAME, around(cylinder(0.05 * r + 0.0015, low, high, 6), self.rods, far, np.pi / 4), of="trim")
        if self.scale:
            back = 0.9 * wide
            plate = box((0.9 * wide, 0.06 * r + 0.001, high - low), (0, 0, (low + high) / 2))
            line.add("gauge face", moved(plate, at(0, back)), front=BEFORE)
        return t.model(length, "welded", NAME, split=True)

    def _tube(self, t: Table, glass: float, low: float, high: float, n: int) -> None:
        wall = 0.0 if self.solid else 0.8 * glass
        t.add("gauge glass", turned(outline(glass, low, self.flare * glass, high), n, bore=wall))
        if not self.solid:
            z = low + self.level * (high - low)
            bob = outline(0.12 * glass, z - 0.9 * glass, 0.7 * glass, z, 0.7 * glass, z + 0.25 * glass)
            t.add("gauge needle", turned(bob, min(n, 12)), rod((0, 0, low), (0, 0, high), 0.06 * glass, 6), of="trim")


class TubeBetweenEnds(
    Melting, SightGlass, name="sight glass/tube between ends", sizes=sizes_between(15, 100), weight=1.5
):
    """A sight glass in a line: a tube of glass between ferrules, discs or blocks, with bars or without."""

    melted: bool = chance(0.3, "all of it is one mesh")
    form: str = among(("ferrules", "ferrules", "discs", "hexagons", "blocks"), "its ends")
    long: float = between(1.6, 5.0, "(length - 50 mm) / radius of the pipe")
    glass: float = between(0.95, 1.35, "radius of the glass / of the pipe")
    rim: float = between(1.4, 2.1, "radius of its ends / of the pipe")
    thick: float = between(0.06, 0.16, "thickness of a disc / length")
    bars: int = among((0, 0, 2, 3, 4, 6), "bars between its ends")

    def build(self, t: Table) -> Model:
        r, line, bore = t.pipe.radius, t.along("x"), bore_of(self.dn, t.style)
        length = round(0.05 + self.long * r, 6)
        rim, thick, glass = max(self.rim, self.glass + 0.15) * r, self.thick * length, self.glass * r
        n, end = self.n(t, rim), 0.26 * length
        neck = max(1.06 * r, 0.8 * glass)
        shapes = {
            "ferrules": outline(rim, 0, rim, 0.5 * thick, neck, thick, neck, end - thick, rim, end - thick, rim, end),
            "discs": outline(1.05 * r, 0, 1.05 * r, end - thick, rim, end - thick, rim, end),
            "hexagons": outline(rim, 0, rim, end),
            "blocks": outline(rim, 0, rim, 0.5 * end, 0.8 * rim, 0.5 * end, 0.8 * rim, end),
        }
        sides = 6 if self.form == "hexagons" else n
        cap = along("x", turned(shapes[self.form], sides, bore=bore))
        caps = [cap, moved(cap, at(length) @ spun("z", np.pi))]
        tube = ring(0.85 * glass if bore else 0.0, glass, end - 0.3 * thick, length - end + 0.3 * thick, n)
        bar = cylinder(0.05 * r + 0.0015, end - 0.5 * thick, length - end + 0.5 * thick, 6)
        bars = [around(bar, self.bars, 0.9 * rim if self.form != "blocks" else 0.72 * rim)] if self.bars else []
        if self.melted:
            t.add(SIGHT_GLASS, *caps, along("x", tube), *(along("x", one) for one in bars))
            return t.model(length, "welded", SIGHT_GLASS)
        t.add(SIGHT_GLASS, caps[0])
        t.add(SIGHT_GLASS, caps[1])
        line.add("gauge glass", tube)
        line.add(SIGHT_GLASS, *bars)
        return t.model(length, "welded", SIGHT_GLASS, split=True)


PLAIN_INSTRUMENTS = families_of(BoxOnStem, HeadOnStem, PlainDial, PlainThermometer, GlassBetweenBlocks, TubeBetweenEnds)
