"""Sections, plates, footings and fasteners that steelwork is put together from."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from cadgraph.model.scene import Floats
from cadplants.builder.device import Device
from cadplants.builder.draws import made, of_form, one_of
from cadplants.builder.params import Params, among, between, chance, several
from cadplants.builder.table import Table
from cadplants.solids.mesh_ops import Solid, extrude, lattice, merge, moved, tube
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, CORNERS, along, box, cylinder, hexagon, rope
from cadplants.solids.transforms import at, looking, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = [
    "ROLLED",
    "RUNWAYS",
    "Base",
    "Props",
    "Section",
    "Structure",
    "bar",
    "bases",
    "bolts",
    "few_sides",
    "filleted",
    "flat",
    "grid",
    "lug",
    "mirrored",
    "pipe",
    "raking",
    "rect",
    "ribbon",
    "section",
    "slab_xy",
    "slab_xz",
    "slab_yz",
    "span_of",
    "strings",
    "trolley",
]

GROUP = "Structural element"
Rng = np.random.Generator
Count = Callable[[Any], int]
T = TypeVar("T")
Section = tuple[Floats, tuple[Floats, ...]]
RUNWAYS = ("H", "I", "IPN")
"""Sections on whose lower flanges a trolley runs."""
ROLLED = ("H", "I", "IPN", "U", "RHS", "SHS", "CHS")


class Structure(Device, place="floor", group=GROUP, sizes=(15,), grain="structure"):
    """A structure on the floor; its label is the first word of its name, its grain ``fitting`` if never one mesh."""

    def __init_subclass__(cls, **said: Any) -> None:
        super().__init_subclass__(**{"label": said.get("name", "").split("/")[0], **said})


def few_sides(style: ModelingStyle, radius: float, most: int = 20) -> int:
    """Sides of a round thing of which there are many [m]."""
    return int(min(style.round(radius), most))


def filleted(
    points: npt.ArrayLike, radius: float, steps: int = 3, closed: bool = True, hollows: bool = False
) -> Floats:
    """A polygon or polyline (plane or in space) with its corners rounded [m], as far as its legs allow.

    Only the reentrant corners of a counter-clockwise polygon are where ``hollows`` is set.
    """
    p = np.asarray(points, float)
    if radius <= 0 or steps < 1:
        return p
    count = len(p)
    rows: list[Floats] = []
    for k in range(count):
        if not closed and k in (0, count - 1):
            rows.append(p[k : k + 1])
            continue
        u, v = p[k - 1] - p[k], p[(k + 1) % count] - p[k]
        if hollows and u[0] * v[1] - u[1] * v[0] < 0:
            rows.append(p[k : k + 1])
            continue
        long_u, long_v = float(np.linalg.norm(u)), float(np.linalg.norm(v))
        u, v = u / long_u, v / long_v
        half = np.arccos(np.clip(u @ v, -1, 1)) / 2
        if half > 0.5 * np.pi - 0.02:
            rows.append(p[k : k + 1])
            continue
        reach = min(radius / np.tan(half), 0.45 * long_u, 0.45 * long_v)
        r = reach * np.tan(half)
        middle = (u + v) / np.linalg.norm(u + v)
        center = p[k] + middle * r / np.sin(half)
        first, second = p[k] + u * reach - center, p[k] + v * reach - center
        turn = np.pi - 2 * half
        share = np.linspace(0, 1, steps + 1)[:, None]
        rows.append(center + (np.sin((1 - share) * turn) * first + np.sin(share * turn) * second) / np.sin(turn))
    return np.concatenate(rows)


def ribbon(points: npt.ArrayLike, thick: float, radius: float = 0.0, steps: int = 3) -> Floats:
    """The outline of sheet bent along a plane polyline (its middle line), counter-clockwise [m]."""
    p = filleted(points, radius, steps, closed=False)
    legs = np.diff(p, axis=0)
    legs = legs / np.linalg.norm(legs, axis=1, keepdims=True)
    side = np.column_stack([-legs[:, 1], legs[:, 0]])
    before, after = np.vstack([side[:1], side]), np.vstack([side, side[-1:]])
    miter = (before + after) / (1 + (before * after).sum(axis=1, keepdims=True))
    return np.vstack([p - miter * thick / 2, (p + miter * thick / 2)[::-1]])


def mirrored(half: Sequence[tuple[float, float]]) -> Floats:
    """A closed outline from its right half, which goes from the bottom up."""
    right = np.array(half, float)
    return np.vstack([right, right[::-1] * (-1, 1)])


def _open_section(kind: str, h: float, root: float, steps: int) -> Floats:
    """Open sections about the middle of their height: EN 10365, EN 10279, EN 10056, EN 10162, DIN 536."""
    if kind in ("H", "I", "IPN"):
        wide, web, deep = {"H": (0.5, 0.028, 0.08), "I": (0.25, 0.018, 0.05), "IPN": (0.21, 0.02, 0.03)}[kind]
        b, t, f, y = wide * h, web * h, deep * h, h / 2
        inner = y - f - (0.14 * (b - t) if kind == "IPN" else 0.0)
        half = [(b, -y), (b, -y + f), (t, -inner), (t, inner), (b, y - f), (b, y)]
        outline = mirrored(half)
        return filleted(outline, 0.5 * root, steps, hollows=True)
    if kind == "U":
        b, t, f = 0.42 * h, 0.05 * h, 0.07 * h
        slope = 0.08 * b if steps else 0.0
        y = h / 2
        points = [(0, -y), (b, -y), (b, -y + f), (t, -y + f + slope), (t, y - f - slope), (b, y - f), (b, y), (0, y)]
        centred: Floats = np.array(points) - np.array([0.16 * h, 0.0])
        return centred
    if kind in ("C", "Z", "strut", "hat"):
        b, lip, y, e = 0.38 * h, 0.14 * h, h / 2, 0.25 * h
        line = {
            "C": [(b, -y + lip), (b, -y), (0, -y), (0, y), (b, y), (b, y - lip)],
            "Z": [(-b, -y + lip), (-b, -y), (0, -y), (0, y), (b, y), (b, y - lip)],
            "strut": [(e, y - lip), (e, y), (y, y), (y, -y), (-y, -y), (-y, y), (-e, y), (-e, y - lip)],
            "hat": [(-1.7 * b, -y), (-b, -y), (-0.7 * b, y), (0.7 * b, y), (b, -y), (1.7 * b, -y)],
        }[kind]
        return ribbon(line, max(0.0015, 0.025 * h), 0.04 * h, steps)
    if kind in ("L", "LL"):
        a, b, t = h, h if kind == "L" else 0.6 * h, 0.1 * h
        heel = filleted([(0, 0), (b, 0), (b, t), (t, t), (t, a), (0, a)], 0.8 * t, min(steps, 2), hollows=True)
        angle: Floats = heel - np.array([0.28 * b, 0.5 * a])
        return angle
    if kind == "T":
        b, t, y = 0.45 * h, 0.045 * h, h / 2
        return mirrored([(t, -y), (t, y - 0.1 * h), (b, y - 0.1 * h), (b, y)])
    y = h / 2  # a flat-bottomed crane or railway rail
    foot = [(0.45 * h, -y), (0.45 * h, -y + 0.07 * h), (0.08 * h, -y + 0.2 * h), (0.06 * h, 0.12 * h)]
    return mirrored([*foot, (0.24 * h, 0.2 * h), (0.25 * h, 0.45 * h), (0.2 * h, y)])


def section(kind: str, h: float, style: ModelingStyle) -> Section:
    """A section of this height [m] about the middle of its height: its outline and holes.

    Args:
        kind: H, I, IPN, U, C (lipped), Z, strut, hat, L, LL, T, rail; RHS, SHS, CHS (hollow where the style models
            that); flat, round, square, timber.
        h: height [m].
        style: how round and hollow it is.
    """
    steps = 0 if style.sides[1] <= 12 else 2 if style.sides[1] <= 24 else 3
    if kind in ("RHS", "SHS"):
        b, t = (0.5 * h, 0.06 * h) if kind == "RHS" else (h, 0.06 * h)
        outer = rounded_rectangle(b, h, 0.09 * h if steps else 0.0, max(steps, 1))
        hole = rounded_rectangle(b - 2 * t, h - 2 * t, 0.04 * h if steps else 0.0, max(steps, 1))
        return outer, (hole,) if style.hollow else ()
    if kind in ("CHS", "round"):
        n = few_sides(style, h / 2, 28)
        hollow = style.hollow and kind == "CHS"
        return circle(h / 2, n), (circle(0.44 * h, n),) if hollow else ()
    if kind in ("flat", "square", "timber"):
        b = {"flat": max(0.1 * h, 0.004), "square": h, "timber": 0.6 * h}[kind]
        return rounded_rectangle(b, h, 0.02 * h if kind == "timber" and steps else 0.0, 1), ()
    return _open_section(kind, h, 0.1 * h, steps), ()


def span_of(one: Section) -> tuple[float, float, float, float]:
    """Least and greatest x, then y of a section [m]."""
    (x0, y0), (x1, y1) = one[0].min(axis=0), one[0].max(axis=0)
    return float(x0), float(x1), float(y0), float(y1)


def bar(start: npt.ArrayLike, end: npt.ArrayLike, one: Section, up: npt.ArrayLike = (0.0, 0.0, 1.0)) -> Solid:
    """A section along a line, its y axis as near to ``up`` as can be."""
    a, b = np.asarray(start, float), np.asarray(end, float)
    frame = looking(a, b - a, up)
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2], pose[:3, 3] = frame[:3, 1], frame[:3, 2], frame[:3, 0], a
    return moved(extrude(one[0], 0.0, float(np.linalg.norm(b - a)), one[1]), pose)


def raking(start: npt.ArrayLike, end: npt.ArrayLike, one: Section) -> Solid:
    """A section along a slope, cut level at its start and upright at its end."""
    a, b = np.asarray(start, float), np.asarray(end, float)
    solid, way = bar(a, b, one), b - a
    v = solid.vertices.copy()
    low = (v - a) @ way < 0.5 * (way @ way)
    v[low] -= np.outer((v[low, 2] - a[2]) / way[2], way)
    v[~low] -= np.outer((v[~low, 0] - b[0]) / way[0], way)
    return Solid(v, solid.faces)


def flat(start: npt.ArrayLike, end: npt.ArrayLike, wide: float, thick: float, up: npt.ArrayLike = (0, 0, 1)) -> Solid:
    """A flat bar along a line, its width towards ``up`` [m]."""
    return bar(start, end, (rounded_rectangle(thick, wide, 0.0), ()), up)


def pipe(points: npt.ArrayLike, radius: float, style: ModelingStyle, bend: float = 0.0, wall: float = 0.0) -> Solid:
    """A round tube or bar along a polyline with bends of a radius; hollow where the style models that [m]."""
    path = filleted(points, bend, 4 if style.sides[1] > 16 else 3, closed=False)
    n = few_sides(style, radius, 16)
    if wall and style.hollow:
        return tube(path, radius, radius - wall, n)
    return rope(path, radius, n)


def slab_xy(outline: npt.ArrayLike, low: float, high: float, holes: tuple[Floats, ...] = ()) -> Solid:
    """A level plate between two heights [m]."""
    return extrude(np.asarray(outline, float), low, high, holes)


def slab_xz(outline: npt.ArrayLike, thick: float, y: float = 0.0, holes: tuple[Floats, ...] = ()) -> Solid:
    """An upright plate over an outline in x and z, its middle at ``y`` [m]."""
    one = extrude(np.asarray(outline, float), -thick / 2, thick / 2, holes)
    return moved(one, at(0, y) @ spun("x", np.pi / 2))


def slab_yz(outline: npt.ArrayLike, thick: float, x: float = 0.0, holes: tuple[Floats, ...] = ()) -> Solid:
    """An upright plate over an outline in y and z, its middle at ``x`` [m]."""
    one = extrude(np.asarray(outline, float), -thick / 2, thick / 2, holes)
    return Solid(one.vertices[:, [2, 0, 1]] + (x, 0, 0), one.faces)


def strings(t: Table, one: Section, ys: Iterable[float], run: float, height: float, lift: float) -> None:
    """Puts down the strings of a flight along x, whose axes are a ``lift`` over the line of its treads' edges, cut at
    floor and landing [m].
    """
    start = -lift * run / height
    t.at(0, 0, lift).add_each("beam", [raking((start, y, -lift), (run, y, height), one) for y in ys])


def bolts(t: Table, poses: Sequence[Floats], d: float, grip: float = 0.02, through: bool = False) -> None:
    """Bolts at faces that look along z of their poses: hex nut on a stud out of concrete, or right through [m]."""
    n = 6 if t.style.sides[1] <= 16 else 10
    shank = cylinder(0.5 * d, -grip - (0.9 * d if through else 1.5 * d), 1.4 * d, n)
    kinds = [(shank, "bolt" if through else "stud"), (hexagon(1.5 * d, 0.15 * d, 0.95 * d), "nut")]
    kinds.append((cylinder(d, 0.0, 0.15 * d, n), "washer"))
    kinds += [(hexagon(1.5 * d, -grip - 0.7 * d, -grip), "nut")] if through else []
    if t.style.fasteners == "pieces":
        for pose in poses:
            for one, name in kinds:
                t.add(name, moved(one, pose), own=False)
        return
    whole_ = merge([one for one, _ in kinds])
    t.add_each("bolt", [moved(whole_, pose) for pose in poses], joined=t.style.fasteners == "set", own=False)


class Base(Params):
    """A base plate with its anchors (four, two or none), square, round or clipped."""

    thick: float = among((0.008, 0.012, 0.02), "thickness of the plate", "m")
    form: str = among(
        ("round", "clipped", "square", "two anchors"), "round, clipped or square, with four anchors, or square with two"
    )
    straight: bool = chance(0.5, "its corners are cut, not rounded", when=of_form("clipped"))
    anchored: bool = chance(0.7, "with anchors")

    def build(self, t: Table, a: float, b: float) -> float:
        """Puts a plate of two sides down on z = 0; the height of its top [m]."""
        d, big = float(np.clip(0.1 * min(a, b), 0.008, 0.02)), max(a, b)
        if self.form == "round":
            edge = circle(0.55 * big, few_sides(t.style, 0.55 * big, 32))
            spots = [
                (0.37 * big * float(np.cos(w)), 0.37 * big * float(np.sin(w))) for w in np.arange(4) * 1.5708 + 0.7854
            ]
        else:
            edge = rounded_rectangle(a, b, 1.2 * d if self.form == "clipped" else 0.0, 1 if self.straight else 3)
            spots = [(sx * (a / 2 - 1.4 * d), sy * (b / 2 - 1.4 * d)) for sx, sy in CORNERS]
            spots = spots[::3] if self.form == "two anchors" else spots
        holes = tuple(circle(0.58 * d, 8, spot) for spot in spots) if t.style.holes else ()
        t.bundled("").add("base plate", slab_xy(edge, 0.0, self.thick, holes))
        if self.anchored:
            bolts(t, [at(*spot, self.thick) for spot in spots], d, self.thick)
        return self.thick


def bases(count: int | Count, when: Callable[[Any], bool] | None = None) -> tuple[Base, ...]:
    """Base plates of this many columns."""
    return several(made(Base), count, "base plates", when=when)


class Props(Params):
    """What something long along x from 0 lies on: battens, trestles, columns, pedestals."""

    form: str = among(("battens", "trestles", "columns", "pedestals"), "what it lies on")
    batten: float = among((0.08, 0.1, 0.14), "side of a batten", "m", when=of_form("battens"))
    rise: float = between(
        lambda p: 0.3 if p.form == "pedestals" else 0.5,
        lambda p: 1.0 if p.form == "pedestals" else 2.6,
        "height of its top",
        "m",
        when=lambda p: p.form != "battens",
    )
    leg: str = among(("L", "SHS", "CHS"), "section of a trestle's legs", when=of_form("trestles"))
    heads: tuple[str, ...] = several(
        one_of("SHS", "U", "H"), 2, "sections of the trestles' heads", when=of_form("trestles")
    )
    shaft: str = among(ROLLED, "section of the columns", when=of_form("columns"))
    feet: tuple[Base, ...] = bases(2, when=of_form("columns"))

    @property
    def top(self) -> float:
        """Height of what lies on it [m]."""
        return self.batten or self.rise

    def build(self, t: Table, length: float, wide: float) -> None:
        """Puts it down for something of a length and width [m]."""
        h, style, battens = self.top, t.style, self.form == "battens"
        size = float(np.clip(0.8 * wide, 0.08, 0.2))
        leg, shaft = (
            section(one, long, style) if one else None for one, long in ((self.leg, 0.06), (self.shaft, size))
        )
        for k, share in enumerate((0.12, 0.88) if battens else (0.04, 0.96)):
            x = share * length
            if battens:
                t.add("beam", box((h, wide + 0.3, h), (x, 0, h / 2)), of="safety")
            elif self.form == "pedestals":
                t.add("foundation", box((0.3, max(0.25, wide + 0.1), h), (x, 0, h / 2)))
            elif leg:
                y = wide / 2 + 0.15
                t.add("beam", bar((x, -y, h - 0.04), (x, y, h - 0.04), section(self.heads[k], 0.08, style)))
                for s, sx in CORNERS:
                    t.add("post", bar((x + sx * 0.2, s * (y - 0.05), 0), (x, s * (y - 0.05), h - 0.08), leg))
            elif shaft:
                low = self.feet[k].build(t.at(x), size + 0.12, size + 0.12)
                t.add("column", bar((x, 0, low), (x, 0, h - 0.01), shaft))
                t.add("plate", box((size + 0.04, max(size, wide) + 0.04, 0.01), (x, 0, h - 0.005)))


def grid(w: float, d: float, thick: float, counts: tuple[int, int], bars: tuple[float, float]) -> Solid:
    """A lattice of bars about the origin on z = 0, with so many meshes each way [m]."""
    lows = [np.linspace(0, span - bar_, n + 1) for span, n, bar_ in zip((w, d), counts, bars, strict=True)]
    xs, ys = (
        np.sort(np.concatenate([low, low + bar_])) - span / 2
        for low, span, bar_ in zip(lows, (w, d), bars, strict=True)
    )
    filled = np.zeros((len(xs) - 1, len(ys) - 1), bool)
    filled[::2], filled[:, ::2] = True, True
    return lattice(xs, ys, filled, 0.0, thick)


def lug(style: ModelingStyle, size: float, thick: float) -> Solid:
    """A lifting eye: a plate in x and z with a round head and a hole, its foot on z = 0 [m]."""
    n = max(8, few_sides(style, size / 2, 16))
    a = np.linspace(-0.2, np.pi + 0.2, n // 2 + 2)
    head = np.column_stack([0.5 * size * np.cos(a), 0.65 * size + 0.5 * size * np.sin(a)])
    outline = np.vstack([[[-0.7 * size, 0.0], [0.7 * size, 0.0]], head])
    return slab_xz(outline, thick, 0.0, (circle(0.24 * size, n, (0.0, 0.68 * size)),))


def trolley(t: Table, size: float, kind: str) -> None:
    """A hand-pushed trolley on the lower flange of a beam along x about the origin: cheeks, wheels and a hook's bar.

    Args:
        t: with its frame in the middle of the beam's section.
        size: height of the section [m].
        kind: of the section, one of ``RUNWAYS``.
    """
    wide, deep, r = {"H": (0.5, 0.08), "I": (0.25, 0.05), "IPN": (0.21, 0.055)}[kind] + (0.16 * size,)
    b, z, n = wide * size, (deep - 0.5) * size + r, few_sides(t.style, r, 16)
    for s in BOTH:
        cheek = slab_xz(rounded_rectangle(5 * r, 5 * r, r, 2) + np.array([0, z - 1.5 * r]), 0.06 * size, s * (b + r))
        t.add("plate", cheek, of="handle")
        for x in (-1.4 * r, 1.4 * r):
            axle = along("y", cylinder(0.35 * r, 0.3 * b, b + 1.3 * r, 8), x, 0, z)
            rim = along("y", cylinder(r, 0.35 * b, b, n), x, 0, z)
            t.spun("z", 0.0 if s > 0 else np.pi).add("caster", rim, axle, of="trim")
    low = z - 3.2 * r
    t.add("bolt", along("y", cylinder(0.35 * r, -b - 1.5 * r, b + 1.5 * r, 8), 0, 0, low), fine=False, own=False)
    t.at(0, 0, low + 1.1 * r).spun("x", np.pi).add("lifting lug", lug(t.style, 1.6 * r, 0.5 * r), of="steel")


def rect(a: float, b: float, x: float = 0.0, y: float = 0.0) -> Floats:
    """A rectangle about a point [m]."""
    outline: Floats = rounded_rectangle(a, b, 0.0) + np.array([x, y])
    return outline
