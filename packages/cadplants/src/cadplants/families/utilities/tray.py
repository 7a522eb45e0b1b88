"""Cable trays with bends, tees, drops and covers, hung, on arms or on stands."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.draws import made, of_form
from cadplants.builder.params import Params, among, between, chance, given, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.utilities.mounting import Utility, beam_over, h_column, hanger, wall
from cadplants.model.family import Family, Model
from cadplants.solids.mesh_ops import Solid, extrude, lattice, merge, moved
from cadplants.solids.primitives import BOTH, box, rod, rope
from cadplants.solids.transforms import at, spun

__all__ = ["TRAYS", "perforated"]

_KINDS = ("solid", "perforated", "ladder", "wire")
_FORM = "how it is made"
_TRAY = "cable tray"
_SHEET = of_form("solid", "perforated")


class _Trays(Utility, weight=1.2):
    """Cable trays (IEC 61537)."""


def _slotted(low: float, high: float, count: int, wide: float) -> Floats:
    """Where cells of this width and the slots between them begin, and where the last ends [m]."""
    starts = np.linspace(low, high, count + 1)[:-1]
    return np.sort(np.concatenate([starts, starts + wide, [high]]))


def perforated(length: float, w: float, cells: tuple[int, int], long: float) -> Solid:
    """A perforated sheet along x from 0 on z = 0, with cells along and across, each this long [m]."""
    xs, ys = _slotted(0, length, cells[0], long), _slotted(-w / 2, w / 2, cells[1], 0.6 * w / cells[1])
    filled = np.zeros((len(xs) - 1, len(ys) - 1), bool)
    filled[::2], filled[:, ::2], filled[-1], filled[:, -1] = True, True, True, True
    return lattice(xs, ys, filled, 0.0, 0.0015)


def _straight(form: str, length: float, w: float, side: float) -> Solid:
    """A straight piece along x from 0, its underside on z = 0."""
    half, mid = w / 2, length / 2
    if form == "wire":
        spots = outline(-half, side, -half, side / 2, half, side / 2, half, side)
        spots += [(float(y), 0.0025) for y in np.linspace(-half, half, 4)]
        bow = outline(-half, side, -half, 0.0025, half, 0.0025, half, side)
        wires = [rod((0, *spot), (length, *spot), 0.0025, 5) for spot in spots]
        return merge([*wires, *(rope([(x, *spot) for spot in bow], 0.0025, 5) for x in np.arange(0.05, length, 0.1))])
    thick = 0.012 if form == "ladder" else 0.0015
    walls = [box((length, thick, side), (mid, s * half, side / 2)) for s in BOTH]
    if form == "ladder":
        levels = (0.0015, side - 0.0015)
        lips = [box((length, 0.03, 0.003), (mid, s * (half - 0.012), z)) for s in BOTH for z in levels]
        rungs = [box((0.035, w, 0.014), (x, 0, 0.022)) for x in np.arange(0.12, length, 0.25)]
        return merge([*walls, *lips, *rungs])
    lips = [box((length, 0.012, 0.002), (mid, s * (half - 0.006), side - 0.001)) for s in BOTH]
    if form == "solid":
        return merge([box((length, w, 0.0015), (mid, 0, 0.00075)), *walls, *lips])
    nx, ny = int(np.clip(length / 0.12, 3, 16)), int(np.clip(w / 0.07, 2, 5))
    return merge([perforated(length, w, (nx, ny), 0.06 * length / nx / 0.12), *walls, *lips])


def _sector(low: float, high: float, steps: int) -> Floats:
    """A quarter ring about the origin, from -y on."""
    a = np.linspace(0, np.pi / 2, steps)
    unit = np.column_stack([np.sin(a), -np.cos(a)])
    return np.vstack([high * unit, low * unit[::-1]])


def _bend(form: str, w: float, side: float, radius: float, steps: int) -> Solid:
    """A level quarter bend to the left from the origin along x; its inner side has this radius."""
    low, high, thick = radius, radius + w, 0.0015 if form != "ladder" else 0.01
    if form == "wire":
        spots = [(r, 0.0025) for r in np.linspace(low, high, 4)]
        spots = [*spots[:1], (low, side), *spots[1:], (high, side)]
        walls = [rope(np.column_stack([_sector(0, r, steps)[:steps], np.full(steps, z)]), 0.0025, 5) for r, z in spots]
        bow = outline(low, side, low, 0.0025, high, 0.0025, high, side)
        turns = np.linspace(0.05, np.pi / 2 - 0.05, 5)
        bars = [rope([(r * np.sin(a), -r * np.cos(a), z) for r, z in bow], 0.0025, 5) for a in turns]
        solids = [*walls, *bars]
    else:
        sides = [extrude(_sector(r - thick / 2, r + thick / 2, steps), 0.0, side) for r in (low, high)]
        rung = box((0.035, w, 0.014), (0, -(low + high) / 2, 0.022))
        rungs = [moved(rung, spun("z", float(a))) for a in np.linspace(0.15, np.pi / 2 - 0.15, 4)]
        floor = extrude(_sector(low, high, steps), 0.0, 0.0015)
        solids = [*sides, *rungs] if form == "ladder" else [floor, *sides]
    return moved(merge(solids), at(0, radius + w / 2))


def _tee(w: float, side: float, room: float) -> Solid:
    """A level tee of sheet along x from 0 to ``w + 2 room``, its branch to -y."""
    long, half, thick = w + 2 * room, w / 2, 0.0015
    left = outline(0, -half, room * 0.4, -half, room, -half - room * 0.6, room, -half - room)
    plan = np.array([*left, *((long - x, y) for x, y in left[::-1]), (long, half), (0, half)])
    walls = [box((long, thick, side), (long / 2, half - thick / 2, side / 2))]
    for k in (0, 1, 2, 4, 5, 6):
        p, q = plan[k], plan[k + 1]
        length, turn = float(np.hypot(*(q - p))), float(np.arctan2(*(q - p)[::-1]))
        one = box((length + 0.002, thick, side), (length / 2, thick / 2, side / 2))
        walls.append(moved(one, at(p[0], p[1]) @ spun("z", turn)))
    return merge([extrude(plan, 0.0, thick), *walls])


class _Cables(Params):
    """Cables side by side in the middle of a tray."""

    width: float = given(0.3, "of the tray", "m")
    count: int = whole(0, 5, "cables")
    radii: tuple[float, ...] = several(
        lambda rng, p: float(rng.uniform(0.005, min(0.018, 0.06 * p.width + 0.004))),
        lambda p: p.count,
        "radius of a cable",
        "m",
    )

    def build(self, t: Table, path: Sequence[Sequence[float]]) -> None:
        """Puts them down along a path, level legs only [m]."""
        points, w = np.array(path, float), self.width
        legs = np.diff(points, axis=0)
        across = np.array([np.cross(leg / np.linalg.norm(leg), (0, 0, 1.0)) for leg in legs])
        miter = (across[:-1] + across[1:]) / (1 + (across[:-1] * across[1:]).sum(axis=1, keepdims=True))
        normal = np.vstack([across[:1], miter, across[-1:]])
        for k, r in enumerate(self.radii):
            y = (k + 0.5) / self.count * 0.8 * w - 0.4 * w
            t.add("cable", rope(points + y * normal + (0, 0, r), r, 8))


class TurningTray(_Trays, name="cable tray/turning"):
    """A level run with a quarter bend, maybe a tee (IEC 61537), on trapezes under beams, couplers at the joints."""

    form: str = among(_KINDS, _FORM)
    width: float = among((0.1, 0.15, 0.2, 0.3, 0.4, 0.6), "of the tray", "m")
    side: float = among((0.035, 0.05, 0.06, 0.085, 0.11), "height of its sides", "m")
    before: float = between(1.0, 2.5, "length before the bend", "m")
    after: float = between(0.8, 2.0, "length after the bend", "m")
    level: float = between(1.8, 2.8, "of the tray over the floor", "m")
    bend: float = among((0.1, 0.3), "inner radius of the bend", "m")
    tee: bool = chance(0.6, "it begins with a tee", when=_SHEET)
    cables: _Cables = nested(_Cables, "cables", fixed=lambda p: {"width": p.width})

    def build(self, t: Table) -> Model:
        form, w, side, a, b, z = self.form, self.width, self.side, self.before, self.after, self.level
        corner, room, start = self.bend + w / 2, 0.15, -a
        up = t.at(0, 0, z)
        up.at(-a).add(_TRAY, _straight(form, a, w, side), of="clamp")
        up.add(_TRAY, _bend(form, w, side, self.bend, max(4, t.n(0.3) // 4 + 1)), of="clamp")
        up.at(corner, corner).spun("z", np.pi / 2).add(_TRAY, _straight(form, b, w, side), of="clamp")
        if self.tee:
            start -= w + 2 * room
            up.at(start).add(_TRAY, _tee(w, side, room), of="clamp")
            branch = up.at(-a - room - w / 2, -w / 2 - room).spun("z", -np.pi / 2)
            branch.add(_TRAY, _straight(form, 0.6, w, side), of="clamp")
        bow = [(corner * np.sin(turn), corner * (1 - np.cos(turn)), 0.0) for turn in np.linspace(0, np.pi / 2, 6)]
        floor = {"ladder": 0.024, "wire": 0.005}.get(form, 0.0015)
        path = [(start - 0.1, 0, 0), (-0.05, 0, 0), *bow, (corner, corner + b + 0.1, 0)]
        self.cables.build(up.at(0, 0, floor), path)
        if form != "wire":
            y = w / 2 + (0.0075 if form == "ladder" else 0.0022)
            up.add("plate", *(box((0.12, 0.003, 0.7 * side), (0, s * y, side / 2)) for s in BOTH), of="clamp")
        for x in (start + 0.25, -0.2):
            self._trapeze(up.at(x))
        t.extend(beam_over(start - 0.35, self.bend + w + 0.35, z + 0.8))
        end = t.at(corner, corner + 0.7 * b)
        end.add("bracket", box((w + 0.2, 0.05, 0.04), (0, 0, z - 0.02)))
        end.add("post", box((0.06, 0.06, z - 0.04), (0, 0, (z - 0.04) / 2)))
        return t.model()

    def _trapeze(self, t: Table) -> None:
        """A strut under the tray on two threaded rods from the beam 0.8 m above; the rods meet in a plate there."""
        w = self.width
        t.add("bracket", box((0.041, w + 0.16, 0.03), (0, 0, -0.015)), of="clamp")
        for s in BOTH:
            t.add("stud", hanger(0, s * (w / 2 + 0.05), -0.05, 0.79), fine=False)
        t.add("bracket", box((0.05, w + 0.2, 0.012), (0, 0, 0.794)), of="clamp")


class _Tier(Params):
    """A tray of several, with its cables."""

    width: float = given(0.3, "of the tray", "m")
    form: str = among(_KINDS, _FORM)
    side: float = among((0.05, 0.06, 0.1), "height of its sides", "m")
    cables: _Cables = nested(_Cables, "cables", fixed=lambda p: {"width": p.width})
    covered: bool = chance(0.25, "a cover", when=_SHEET)

    def build(self, t: Table, length: float) -> None:
        """Puts it down along x from 0 [m]."""
        w, floor = self.width, {"ladder": 0.03, "wire": 0.005}.get(self.form, 0.0015)
        t.add(_TRAY, _straight(self.form, length, w, self.side), of="clamp")
        self.cables.build(t, [(x, 0, floor) for x in (-0.1, length / 2, length + 0.1)])
        if self.covered:
            t.add(_TRAY, box((0.9 * length, w + 0.006, 0.002), (length / 2, 0, self.side + 0.001)), of="clamp")


class Tiers(_Trays, name="cable tray/tiers"):
    """Trays one over the other on cantilever arms from a wall, columns or stands, each with its cables."""

    length: float = between(1.6, 3.5, "of the trays", "m")
    count: int = whole(2, 4, "trays")
    width: float = among((0.15, 0.2, 0.3, 0.45), "of a tray", "m")
    pitch: float = between(0.25, 0.4, "from tray to tray", "m")
    low: float = between(0.5, 1.4, "of the lowest tray over the floor", "m")
    back: str = among(("wall", "column", "stand"), "what the arms are fixed to")
    tiers: tuple[_Tier, ...] = several(made(_Tier, lambda p: {"width": p.width}), lambda p: p.count, "trays")

    def build(self, t: Table) -> Model:
        length, w, top = self.length, self.width, self.low + (self.count - 1) * self.pitch + 0.4
        xs = (0.2 * length, 0.8 * length)
        arm = extrude(np.array(outline(0, -0.06, 0, 0, -w - 0.1, 0, -w - 0.1, -0.02)), -0.015, 0.015)
        for k, tier in enumerate(self.tiers):
            here = t.at(0, 0, self.low + k * self.pitch)
            tier.build(here.at(0, -w / 2 - 0.06), length)
            for x in xs:
                here.at(x).spun("z", np.pi / 2).spun("x", np.pi / 2).add("bracket", arm)
        if self.back == "wall":
            t.extend([wall(-0.2, length + 0.2, top)])
        for x in () if self.back == "wall" else xs:
            if self.back == "column":
                t.at(x).extend([h_column(top)])
            else:
                t.add("post", box((0.06, 0.06, top), (x, 0.03, top / 2)), of="clamp")
                t.add("base plate", box((0.2, w + 0.3, 0.01), (x, -0.1, 0.005)), of="clamp")
        return t.model()


class Trunking(_Trays, name="cable tray/trunking"):
    """Covered trunking: a square sheet duct along a wall with a drop into a wall box, covers, straps."""

    size: float = among((0.05, 0.075, 0.1, 0.15), "width of the duct", "m")
    level: float = between(1.6, 2.4, "of the duct over the floor", "m")
    length: float = between(1.5, 3.0, "of the duct", "m")
    drop: float = between(0.3, 0.7, "where the drop is / length")
    low: float = between(0.4, 0.8, "height of the drop's end", "m")
    box: float = between(0.2, 0.4, "width of the wall box", "m")
    ended: bool = chance(0.6, "its end goes up")

    def build(self, t: Table) -> Model:
        s, z, length, h, b = self.size, self.level, self.length, self.low, self.box
        x, y, deep, tall = self.drop * length, -s / 2, max(0.12, 1.2 * s), z - s / 2 - h
        lid = box((length - 0.01, 0.004, 0.9 * s), (length / 2, -s - 0.002, z))
        t.add(_TRAY, box((length, s, s), (length / 2, y, z)), lid, of="clamp")
        lid = box((0.9 * s, 0.004, tall - 0.01), (0, -s - 0.002, 0))
        t.at(x, 0, h + tall / 2).add(_TRAY, box((s, s, tall), (0, y, 0)), lid, of="clamp")
        if self.ended:
            t.add(_TRAY, box((s, s, s + 0.5), (length + s / 2, y, z + 0.25)), of="clamp")
        straps = [box((0.02, s + 0.008, s + 0.008), (q * length, y - 0.002, z)) for q in (0.15, 0.85)]
        t.add("clamp", *straps, box((s + 0.008, s + 0.008, 0.02), (x, y - 0.002, (z + h) / 2)))
        lid = box((0.96 * b, 0.01, 1.16 * b), (0, -deep - 0.005, 0))
        t.at(x, 0, h - 0.6 * b).add("junction box", box((b, deep, 1.2 * b), (0, -deep / 2, 0)), lid)
        t.extend([wall(-0.2, length + 0.3, z + 0.8)])
        return t.model()


class Riser(_Trays, name="cable tray/riser"):
    """A level tray that turns up a wall in an inside bend, cables tied to the upright leg."""

    form: str = among(_KINDS[:3], _FORM)
    width: float = among((0.1, 0.2, 0.3), "of the tray", "m")
    side: float = among((0.05, 0.06, 0.1), "height of its sides", "m")
    tall: float = between(1.4, 2.6, "length on the wall", "m")
    out: float = between(0.7, 1.5, "length of the level tray", "m")
    top: float = between(0.1, 0.4, "from the tray's upper end to the cables' ends + 20 mm", "m")
    count: int = whole(1, 4, "cables")
    level: float = between(0.3, 1.2, "of the level tray over the floor", "m")

    def build(self, t: Table) -> Model:
        form, w, side, tall, low, gap, r = self.form, self.width, self.side, self.tall, self.top, 0.041, 0.25
        z = low + tall + r
        # Built with its bend on top, then turned upside down.
        here, mid = t.at(0, 0, z + self.level).spun("y", np.pi), np.array([-gap - r, low + tall])
        up = here.at(0, -gap, low).spun("z", -np.pi / 2).spun("y", -np.pi / 2)
        up.add(_TRAY, _straight(form, tall, w, side), of="clamp")
        a = np.linspace(0, np.pi / 2, 6)
        unit, turn = np.column_stack([np.cos(a), np.sin(a)]), spun("z", np.pi / 2) @ spun("x", np.pi / 2)
        sheets = [
            moved(extrude(mid + np.vstack([r * unit, (r - q) * unit[::-1]]), 0, thick), at(x) @ turn)
            for x, q, thick in ((-w / 2, 0.002, w), (-w / 2, side, 0.0015), (w / 2 - 0.0015, side, 0.0015))
        ]
        here.add(_TRAY, *sheets, of="clamp")
        level = here.at(0, -gap - r, z).spun("z", -np.pi / 2).spun("x", np.pi)
        level.add(_TRAY, _straight(form, self.out, w, side), of="clamp")
        q, d = 0.01, 0.029 if form == "ladder" else 0.0015
        bow = mid + (r - d - q) * unit
        path = [(-gap - d - q, 0.02), *map(tuple, bow), (-gap - r - self.out - 0.1, z - d - q)]
        for k in range(self.count):
            x = (k + 0.5) / self.count * 0.8 * w - 0.4 * w
            here.add("cable", rope([(x, *spot) for spot in path], q, 8))
        for f in (0.15, 0.55, 0.9):
            here.add("bracket", box((w + 0.1, 0.041, 0.041), (0, -0.0205, low + f * tall)), of="clamp")
        end = t.at(0, -gap - r - 0.8 * self.out)
        end.add("bracket", box((w + 0.1, 0.05, 0.03), (0, 0, self.level - 0.015)))
        end.add("post", box((0.05, 0.05, self.level - 0.03), (0, 0, (self.level - 0.03) / 2)))
        t.extend([wall(-0.5 * w - 0.3, 0.5 * w + 0.3, z + self.level + 0.2)])
        return t.model()


TRAYS: tuple[Family, ...] = families_of(TurningTray, Tiers, Trunking, Riser)
