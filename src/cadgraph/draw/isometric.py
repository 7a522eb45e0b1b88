"""Isometric drawings of lines: 30 degree axes, lengths not to scale, dimensions in millimetres, bill of components.

Directions are those of the plant: north (+y) to the upper right, east (+x) to the lower right, up upwards; or north to
the upper left and east to the upper right, where that shows more. What runs along none of the three gets the edges of a
box beside it, dashed. Every text has a place of its own: one that finds none beside what it belongs to moves out, with
a line that leads back.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise, product
from pathlib import Path

from cadgraph._io.atomic import write_atomically
from cadgraph._io.text import printable
from cadgraph.draw.svg import Svg, element, joined
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Point
from cadgraph.query.components import find_components
from cadgraph.query.piped_line import Branch, Component, LineEnd, PipedLine

__all__ = ["Box", "Isometric", "draw_isometric", "write_isometrics"]

Spot = tuple[float, float]
Box = tuple[float, float, float, float]
"""Left, top, right, bottom."""

_COS, _SIN = math.cos(math.radians(30)), 0.5
_MARGIN, _GAP = 40.0, 4.0
_LETTER, _LINE = 6.2, 13.0  # width and height of the letters of a text of size 11, generous
_BILL = 300.0  # width of the bill of components
_DIMENSION = 26.0  # a dimension line stands so far from its pipe
_LONGEST = 48  # letters of a text on the sheet
_MOST_TURNS = 400  # tries to find a place for a text
# Drawn lengths: a component always has the same, a pipe's grows with the logarithm of its length.
_LENGTHS = {"flange": 7.0, "gasket": 3.0, "blind flange": 7.0, "valve": 30.0, "reducer": 24.0, "instrument": 30.0}
_BOXES = ("instrument", "other", "strainer", "hose", "expansion joint")  # drawn as a box in the line
_WORSE = 6  # so much worse than another dimension it is to cross a pipe
_CLOSE = 12.0  # legs that come nearer than this are drawn apart
_LEG, _OTHER = 16.0, 24.0
_STEM, _BALLOON, _BALLOON_LETTERS = 10.0, 19.0, 5  # of an instrument: its line, radius, and the letters in it
_STRAIGHT = 0.98  # of a direction's length along one axis, from which on it runs along that
_STYLE = (
    "text{font:11px sans-serif;fill:#111}.p{stroke:#111;stroke-width:2.6;fill:none;stroke-linecap:round}"
    ".s{stroke:#111;stroke-width:1.4;fill:#fff}.f{stroke:#111;stroke-width:1.8;fill:none}"
    ".k{stroke:#567;stroke-width:.8;fill:none;stroke-dasharray:4 3}"
    ".d{stroke:#567;stroke-width:.8;fill:none}.w{fill:#111}"
    ".t{fill:#345}.b{font-weight:bold}"
)


@dataclass
class Isometric:
    """A drawing in the making.

    Args:
        shapes: pieces of SVG, in the order that they are drawn.
        texts: place of each text on the sheet, with its letters.
        solid: places of what no text may lie on.
        turned: whether north is to the upper left.
    """

    shapes: list[Svg] = field(default_factory=list)
    texts: list[tuple[Box, str]] = field(default_factory=list)
    solid: list[Box] = field(default_factory=list)
    turned: bool = False
    _waiting: list[tuple[Spot, Sequence[str], Spot, str]] = field(default_factory=list)

    def line(self, points: Sequence[Spot], style: str, *, solid: bool = True) -> None:
        """A line through points; short boxes along it keep texts away."""
        way = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
        self.shapes.append(element("path", d=way, class_=style))
        if solid:
            for a, b in pairwise(points):
                steps = max(1, math.ceil(math.dist(a, b) / 8))
                for i in range(steps + 1):
                    x, y = a[0] + (b[0] - a[0]) * i / steps, a[1] + (b[1] - a[1]) * i / steps
                    self.solid.append((x - 2, y - 2, x + 2, y + 2))

    def area(self, points: Sequence[Spot], style: str = "s") -> None:
        """A filled shape."""
        way = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points) + "Z"
        self.shapes.append(element("path", d=way, class_=style))
        xs, ys = zip(*points, strict=True)
        self.solid.append((min(xs), min(ys), max(xs), max(ys)))

    def dot(self, at: Spot, radius: float, style: str) -> None:
        """A circle."""
        self.shapes.append(element("circle", cx=at[0], cy=at[1], r=radius, class_=style))
        self.solid.append((at[0] - radius, at[1] - radius, at[0] + radius, at[1] + radius))

    def text(self, at: Spot, lines: Sequence[str], away: Spot, style: str = "t") -> None:
        """Some lines of text near a point, for :meth:`settle` to find room for, first in a direction."""
        self._waiting.append((at, lines, away, style))

    def settle(self) -> None:
        """Puts each text as near to its point as there is room, now that all else is drawn."""
        for at, lines, away, style in self._waiting:
            self._put(at, lines, away, style)
        self._waiting.clear()

    def _put(self, at: Spot, lines: Sequence[str], away: Spot, style: str) -> None:
        lines = [_short(line) for line in lines if line]
        wide, high = max(map(len, lines)) * _LETTER + 2 * _GAP, len(lines) * _LINE + _GAP
        box = self._room(at, wide, high, math.atan2(away[1], away[0]))
        middle = ((box[0] + box[2]) / 2, (box[1] + box[3]) / 2)
        if math.dist(middle, at) > max(wide, high) / 2 + 26:
            nearest = (min(max(at[0], box[0]), box[2]), min(max(at[1], box[1]), box[3]))
            # Not from the very point: that would cross out the symbol there.
            self.line([_between(at, nearest, min(0.5, 9 / math.dist(at, nearest))), nearest], "d", solid=False)
        for number, line in enumerate(lines):
            y = box[1] + (number + 1) * _LINE - 2
            self.shapes.append(element("text", line, x=middle[0], y=y, text_anchor="middle", class_=style))
        self.texts.append((box, " / ".join(lines)))

    def _room(self, at: Spot, wide: float, high: float, first: float) -> Box:
        box: Box = (0.0, 0.0, 0.0, 0.0)
        for turn in range(_MOST_TURNS):
            # Around the point in widening rings, at each to both sides of the wanted direction.
            ring, step = divmod(turn, 12)
            angle = first + (step + 1) // 2 * (1 if step % 2 else -1) * math.radians(30)
            reach = 8.0 + 12.0 * ring
            x = at[0] + math.cos(angle) * (reach + wide / 2)
            y = at[1] + math.sin(angle) * (reach + high / 2)
            box = (x - wide / 2, y - high / 2, x + wide / 2, y + high / 2)
            if not any(_meet(box, other) for other in self.solid) and not any(_meet(box, b) for b, _ in self.texts):
                break
        return box


def write_isometrics(graph: SceneGraph, folder: str | Path) -> tuple[tuple[Path, ...], tuple[Diagnostic, ...]]:
    """Writes a drawing of each line, ``L-0123.svg``.

    Args:
        graph: the finished graph.
        folder: where to; made if missing.

    Returns:
        The files in the order of the line list, and notes on lines that could not be drawn (``no-centreline``,
        ``no-component``) or lack joints (``missing-joint``).

    Raises:
        OutputError: a file can't be written.
    """
    files: list[Path] = []
    notes: list[Diagnostic] = []
    for line in find_components(graph):
        notes.extend(line.notes)
        if not line.components:
            if not line.notes:
                notes.append(Diagnostic("no-component", f"{line.line.tag}: nothing of it stands between what it joins"))
            continue
        path = Path(folder) / f"{line.line.tag}.svg"
        write_atomically(path, draw_isometric(line)[0])
        files.append(path)
    return tuple(files), tuple(notes)


def draw_isometric(line: PipedLine) -> tuple[str, Isometric]:
    """The drawing of one line.

    Args:
        line: with at least one component.

    Returns:
        The SVG document, and where on the sheet what stands.
    """
    legs = _legs(line.components)
    spots, turned = _untangled(legs)
    sheet = Isometric(turned=turned)
    _pipes(sheet, line, legs, spots)
    _end(sheet, line.start, spots[0], _back(spots[0], spots[1]))
    _end(sheet, line.end, spots[-1], _back(spots[-1], spots[-2]))
    _instruments(sheet, line, legs, spots)
    _tags(sheet, legs, spots)
    _dimensions(sheet, legs, spots)
    _skews(sheet, legs, spots)
    sheet.settle()
    return _document(sheet, line), sheet


@dataclass(frozen=True)
class _Leg:
    """A straight piece of a component: all of it, or one side of an elbow."""

    component: Component
    start: Point
    end: Point
    drawn: float
    half: int = 0  # 1 and 2: before and after the corner of what turns


def _legs(components: Sequence[Component]) -> list[_Leg]:
    legs = []
    for each in components:
        if math.dist(each.start, each.end) == 0 and each.centre in (None, each.start):
            continue
        if each.centre is not None and (each.angle or each.kind in ("tee", "cross")):
            legs.append(_Leg(each, each.start, each.centre, _LEG, 1))
            legs.append(_Leg(each, each.centre, each.end, _LEG, 2))
        else:
            legs.append(_Leg(each, each.start, each.end, _drawn(each)))
    return [leg for leg in legs if math.dist(leg.start, leg.end) > 0] or legs


def _drawn(component: Component) -> float:
    if component.kind == "pipe":
        return 30.0 + 45.0 * math.log1p(component.length / 0.4)
    return _LENGTHS.get(component.kind, _OTHER)


def _untangled(legs: Sequence[_Leg]) -> tuple[list[Spot], bool]:
    """Places of the legs on the sheet, and whether it is turned.

    Drawn longer along one axis or another where they would lie on each other. Half way between two axes, what lies
    would seem to stand: then the plant is seen from the other side.
    """
    factors = list(product((1.0, 1.4, 1.9), repeat=3))
    ways = [(_spots(legs, each, turned), turned) for turned in (False, True) for each in factors]

    def worth(item: tuple[int, tuple[list[Spot], bool]]) -> tuple[int, int, int]:
        number, (spots, _) = item
        return _mistaken(legs, spots), _tangles(legs, spots), number

    return min(enumerate(ways), key=worth)[1]


def _mistaken(legs: Sequence[_Leg], spots: Sequence[Spot]) -> int:
    """How many legs seem to stand, but don't."""
    count = 0
    for leg, a, b in zip(legs, spots, spots[1:], strict=False):
        rise, length = abs(leg.end[2] - leg.start[2]), math.dist(leg.start, leg.end)
        count += length > 0 and rise < 0.5 * length and abs(b[0] - a[0]) < 0.2 * math.dist(a, b)
    return count


def _tangles(legs: Sequence[_Leg], spots: Sequence[Spot]) -> int:
    """How many samples of legs lie close to one of another leg that isn't its neighbour."""
    cells: dict[tuple[int, int], list[int]] = {}
    for i, (a, b) in enumerate(pairwise(spots)):
        steps = max(1, math.ceil(math.dist(a, b) / _CLOSE))
        for k in range(steps):
            x, y = _between(a, b, (k + 0.5) / steps)
            cells.setdefault((round(x / _CLOSE), round(y / _CLOSE)), []).append(i)
    return sum(max(found) - min(found) > 2 for found in cells.values())


def _spots(legs: Sequence[_Leg], factors: Sequence[float], turned: bool) -> list[Spot]:
    """Where the legs begin on the sheet, and where the last one ends.

    Args:
        legs: in order.
        factors: by which pipes along x, y and z are drawn longer.
        turned: whether north is to the upper left.
    """
    spots = [(0.0, 0.0)]
    for leg in legs:
        vector = tuple(b - a for a, b in zip(leg.start, leg.end, strict=True))
        dx, dy = _project(vector, turned)
        length = math.dist(leg.start, leg.end) or 1.0
        main = max(range(3), key=lambda axis: abs(vector[axis]))
        drawn = leg.drawn * (factors[main] if leg.component.kind == "pipe" else 1.0)
        x, y = spots[-1]
        spots.append((x + dx / length * drawn, y + dy / length * drawn))
    return spots


def _project(vector: Sequence[float], turned: bool) -> Spot:
    x, y, z = vector
    if turned:
        x, y = -y, x
    return (x + y) * _COS, (x - y) * _SIN - z


def _pipes(sheet: Isometric, line: PipedLine, legs: Sequence[_Leg], spots: Sequence[Spot]) -> None:
    for i, (leg, a, b) in enumerate(zip(legs, spots, spots[1:], strict=False)):
        _symbol(sheet, leg, a, b)
        # Of what turns or branches the second half begins at its middle.
        for branch in leg.component.branches if leg.half != 1 else ():
            _branch(sheet, branch, a if leg.half else _between(a, b, 0.5), leg.start)
        if i and _welded(legs[i - 1], leg):
            sheet.dot(a, 3.0, "w")
    for each in line.components:
        if each.kind == "tap":
            at = spots[min(range(len(spots)), key=lambda i: math.dist(_corner(legs, i), each.start))]
            for branch in each.branches:
                _branch(sheet, branch, at, each.start)
    if line.line.flow == "forward":
        _flow(sheet, legs, spots)


def _branch(sheet: Isometric, branch: Branch, at: Spot, start: Point) -> None:
    """A short piece of a branch with what goes on there."""
    way = _project(tuple(p - c for p, c in zip(branch.point, start, strict=True)), sheet.turned)
    size = math.hypot(*way) or 1.0
    tip = (at[0] + way[0] / size * 26, at[1] + way[1] / size * 26)
    sheet.line([at, tip], "p")
    if branch.line:
        sheet.text(tip, [branch.line], way)


def _symbol(sheet: Isometric, leg: _Leg, a: Spot, b: Spot) -> None:
    """What a leg looks like between two places on the sheet."""
    kind, across = leg.component.kind, _across(leg, a, b)
    if kind == "valve":
        _valve(sheet, leg.component.what or "", a, b, across)
    elif kind in ("flange", "blind flange"):
        at = _between(a, b, 0.5)
        sheet.line([a, b], "p")
        sheet.line([_off(at, across, -9), _off(at, across, 9)], "p" if kind == "blind flange" else "f")
    elif kind == "reducer":
        first, last = _widths(leg.component)
        sheet.area([_off(a, across, -first), _off(b, across, -last), _off(b, across, last), _off(a, across, first)])
    elif kind in _BOXES:
        sheet.area([_off(a, across, -7), _off(b, across, -7), _off(b, across, 7), _off(a, across, 7)])
    elif kind != "gasket":
        sheet.line([a, b], "p")


def _flow(sheet: Isometric, legs: Sequence[_Leg], spots: Sequence[Spot]) -> None:
    """An arrow with the flow, on the first pipe."""
    pipes = [(a, b) for leg, a, b in zip(legs, spots, spots[1:], strict=False) if leg.component.kind == "pipe"]
    for a, b in pipes[:1]:
        way = ((b[0] - a[0]) / math.dist(a, b), (b[1] - a[1]) / math.dist(a, b))
        tip, side = _between(a, b, 0.5), (-way[1], way[0])
        back = (tip[0] - way[0] * 12, tip[1] - way[1] * 12)
        sheet.area([tip, _off(back, side, 5), _off(back, side, -5)], "w")


def _valve(sheet: Isometric, what: str, a: Spot, b: Spot, across: Spot) -> None:
    """Two triangles with the mark of its kind, as ISO 10628-2 has it for globe, ball and butterfly valves."""
    middle = _between(a, b, 0.5)
    sheet.area([_off(a, across, -8), _off(a, across, 8), middle], "w" if "check" in what else "s")
    sheet.area([_off(b, across, -8), _off(b, across, 8), middle])
    if "globe" in what:
        sheet.dot(middle, 4.0, "w")
    elif "ball" in what or "plug" in what:
        sheet.dot(middle, 4.5, "s")
    elif "butterfly" in what:
        sheet.line([_off(_between(a, b, 0.25), across, -8), _off(_between(a, b, 0.75), across, 8)], "f")
        sheet.dot(middle, 3.0, "w")


def _welded(before: _Leg, after: _Leg) -> bool:
    """Whether a weld stands between two legs: where nothing is bolted, and not in the midst of a component."""
    if before.component is after.component or before.component.parts == after.component.parts:
        return False
    kinds = {before.component.kind, after.component.kind}
    if "gasket" in kinds or "valve" in kinds or "instrument" in kinds:
        return False
    return not kinds <= {"flange", "blind flange"}


def _dimensions(sheet: Isometric, legs: Sequence[_Leg], spots: Sequence[Spot]) -> None:
    """The length of each straight, from corner to corner, beside it."""
    n_pipes = len(sheet.solid)
    for start, stop in _straights(legs):
        a, b = spots[start], spots[stop]
        length = math.dist(legs[start].start, legs[stop - 1].end) * 1000
        if math.dist(a, b) > 20:
            across, reach = _side(sheet, a, b, n_pipes)
            first, last = _off(a, across, reach), _off(b, across, reach)
            sheet.line([_off(a, across, 6), _off(a, across, reach + 5)], "d")
            sheet.line([_off(b, across, 6), _off(b, across, reach + 5)], "d")
            sheet.line([first, last], "d")
            sheet.text(_between(first, last, 0.5), [f"{length:.0f}"], across)


def _side(sheet: Isometric, a: Spot, b: Spot, n_pipes: int) -> tuple[Spot, float]:
    """Which way from a pipe, along one of the axes, and how far, a dimension line and its ends cross least.

    Args:
        sheet: with pipes and symbols, and with the dimensions before this one.
        a: where the pipe begins.
        b: where it ends.
        n_pipes: how many of what is solid on the sheet is no dimension: to cross one of these is worse.
    """
    along = ((b[0] - a[0]) / math.dist(a, b), (b[1] - a[1]) / math.dist(a, b))
    axes = ((0.0, 1.0), (_COS, _SIN), (_COS, -_SIN))
    # First up or down beside what lies, east or west beside what stands.
    ways = [(x * sign, y * sign) for x, y in axes if abs(x * along[1] - y * along[0]) > 0.4 for sign in (1.0, -1.0)]
    found = []
    for reach in (_DIMENSION, 1.8 * _DIMENSION, 2.6 * _DIMENSION):
        for number, way in enumerate(ways):
            points = [*_along(_off(a, way, reach), _off(b, way, reach))]
            points += [point for end in (a, b) for point in _along(_off(end, way, 11), _off(end, way, reach + 5))]
            boxes = [(x - 3, y - 3, x + 3, y + 3) for x, y in points]
            crossed = sum(
                _WORSE * any(_meet(box, other) for other in sheet.solid[:n_pipes])
                + any(_meet(box, other) for other in sheet.solid[n_pipes:])
                for box in boxes
            )
            found.append((crossed, reach, number, way))
    _, reach, _, way = min(found)
    return way, reach


def _along(a: Spot, b: Spot) -> list[Spot]:
    """Points between two, six apart."""
    steps = max(2, math.ceil(math.dist(a, b) / 6))
    return [_between(a, b, k / steps) for k in range(steps + 1)]


def _skews(sheet: Isometric, legs: Sequence[_Leg], spots: Sequence[Spot]) -> None:
    """Beside each straight that runs along none of the axes, the way along them from its start to its end."""
    for first, last in _straights(legs):
        a, b = spots[first], spots[last]
        vector = [y - x for x, y in zip(legs[first].start, legs[last - 1].end, strict=True)]
        length = math.hypot(*vector)
        if math.dist(a, b) <= 20 or max(map(abs, vector)) > _STRAIGHT * length:
            continue
        dx, dy = _project(vector, sheet.turned)
        share = math.dist(a, b) / (math.hypot(dx, dy) or 1.0)
        way = [a]
        for axis in sorted(range(3), key=lambda axis: -abs(vector[axis])):
            own = [0.0, 0.0, 0.0]
            own[axis] = vector[axis] * share
            if abs(vector[axis]) > 0.05 * length:
                way.append(_off(way[-1], _project(own, sheet.turned), 1.0))
        sheet.line(way, "k")


def _straights(legs: Sequence[_Leg]) -> Iterator[tuple[int, int]]:
    """The first leg of each straight and the one after its last."""
    start = 0
    for i in range(1, len(legs) + 1):
        if i == len(legs) or _turns(legs[start], legs[i]):
            yield start, i
            start = i


def _turns(one: _Leg, other: _Leg) -> bool:
    a = tuple(y - x for x, y in zip(one.start, one.end, strict=True))
    b = tuple(y - x for x, y in zip(other.start, other.end, strict=True))
    lengths = math.hypot(*a) * math.hypot(*b)
    return lengths > 0 and sum(x * y for x, y in zip(a, b, strict=True)) / lengths < 0.98


def _tags(sheet: Isometric, legs: Sequence[_Leg], spots: Sequence[Spot]) -> None:
    size: object = None
    for leg, a, b in zip(legs, spots, spots[1:], strict=False):
        across = _across(leg, a, b)
        away = (-across[0], -across[1])
        if leg.component.tag is not None and leg.half < 2:
            sheet.text(_between(a, b, 0.5), [leg.component.tag, leg.component.what or ""], away, "b")
        elif leg.component.kind == "pipe" and leg.component.sizes[0] not in (None, size):
            size = leg.component.sizes[0]
            sheet.text(_between(a, b, 0.5), [f"DN {size}"], away)


def _instruments(sheet: Isometric, line: PipedLine, legs: Sequence[_Leg], spots: Sequence[Spot]) -> None:
    for tag, kind, point in line.instruments:
        nearest = min(range(len(spots)), key=lambda i: math.dist(_corner(legs, i), point))
        at, way = spots[nearest], _free(sheet, spots[nearest])
        middle = _off(at, way, _STEM + _BALLOON)
        sheet.line([at, _off(at, way, _STEM)], "f")
        if "valve" in (kind or ""):
            far = _off(at, way, _STEM + _LENGTHS["valve"])
            _valve(sheet, kind or "", _off(at, way, _STEM), far, (-way[1], way[0]))
            sheet.text(far, [tag, kind or ""], way, "b")
            continue
        sheet.dot(middle, _BALLOON, "s")
        if len(tag) <= _BALLOON_LETTERS:
            sheet.shapes.append(
                element("text", _short(tag), x=middle[0], y=middle[1] + 4, text_anchor="middle", class_="b")
            )
        else:
            sheet.text(middle, [tag], way, "b")


def _free(sheet: Isometric, at: Spot) -> Spot:
    """Which way along the axes the balloon of an instrument covers least, upwards first."""
    ways = ((0.0, -1.0), (_COS, -_SIN), (-_COS, -_SIN), (_COS, _SIN), (-_COS, _SIN), (0.0, 1.0))

    def covered(number: int) -> int:
        x, y = _off(at, ways[number], _STEM + _BALLOON)
        balloon = (x - _BALLOON, y - _BALLOON, x + _BALLOON, y + _BALLOON)
        return sum(_meet(balloon, box) for box in sheet.solid)

    return ways[min(range(len(ways)), key=lambda number: (covered(number), number))]


def _corner(legs: Sequence[_Leg], i: int) -> Point:
    return legs[i].start if i < len(legs) else legs[-1].end


def _end(sheet: Isometric, end: LineEnd, at: Spot, away: Spot) -> None:
    name = "/".join(filter(None, (end.name, end.port)))
    said = {
        "equipment": f"TO {name}",
        "pipeline": f"CONT. ON {name}",
        "open": "OPEN END",
        "closed": "CLOSED END",
        "unknown": name or "END",
    }[end.kind]
    x, y, z = (round(c * 1000) for c in end.point)
    sheet.text(at, [said, f"E {x}  N {y}  EL {z}"], away, "b")


def _document(sheet: Isometric, line: PipedLine) -> str:
    boxes = [*sheet.solid, *(box for box, _ in sheet.texts)]
    left, top = min(box[0] for box in boxes), min(box[1] for box in boxes)
    right, bottom = max(box[2] for box in boxes), max(box[3] for box in boxes)
    bill = list(_bill(line))
    wide = max(right - left, 320.0) + 3 * _MARGIN + _BILL
    high = max(bottom - top + 2 * _MARGIN + 90, 60 + _LINE * (len(bill) + 12))
    shift = f"translate({_MARGIN - left:.1f} {_MARGIN + 50 - top:.1f})"
    edge = wide - _MARGIN - _BILL
    content = joined(
        (
            element("style", Svg(_STYLE)),
            element("rect", width=wide, height=high, fill="#fff"),
            element("rect", x=10, y=10, width=wide - 20, height=high - 20, class_="d"),
            _north(sheet.turned),
            element("g", *sheet.shapes, transform=shift),
            *_table(bill, edge, 40.0),
            *_title(line, edge, high),
        )
    )
    document = element(
        "svg",
        content,
        xmlns="http://www.w3.org/2000/svg",
        viewBox=f"0 0 {wide:.0f} {high:.0f}",
        width=wide,
        height=high,
    )
    return f"{document}\n"


def _north(turned: bool) -> Svg:
    """An arrow to the north, +y."""
    x, y, side = (64.0, 62.0, -1.0) if turned else (34.0, 62.0, 1.0)
    tip = (x + side * 30 * _COS, y - 30 * _SIN)
    head = [tip, (tip[0] - side * 10, tip[1] + 1), (tip[0] - side * 5, tip[1] + 8)]
    arrow = element("path", d=f"M{x:.1f} {y:.1f}L{tip[0]:.1f} {tip[1]:.1f}", class_="p")
    filled = "M" + "L".join(f"{a:.1f} {b:.1f}" for a, b in head) + "Z"
    letter = element("text", "N", x=tip[0] + (6 if side > 0 else -14), y=tip[1], class_="b")
    return joined((arrow, element("path", d=filled, class_="w"), letter))


def _bill(line: PipedLine) -> Iterator[tuple[str, str, str]]:
    """What, nominal size and how much of it."""
    counted: Counter[tuple[str, str]] = Counter()
    pipes: dict[str, float] = {}
    for each in line.components:
        sizes = list(dict.fromkeys(str(size) for size in each.sizes if size is not None))
        size = "x".join(sizes) or "?"
        if each.kind in ("pipe", "bend"):
            pipes[size] = pipes.get(size, 0.0) + each.length
        else:
            counted[_named(each), size] += 1
    for outlet in line.outlets:
        size = next((str(size) for size in outlet.sizes if size is not None), "?")
        counted[f"{_named(outlet)} on the pipe", size] += 1
    for _, kind, _ in line.instruments:
        counted[kind or "instrument", ""] += 1
    for size, length in sorted(pipes.items()):
        yield "pipe, bends included", size, f"{length:.2f} m"
    for (what, size), number in sorted(counted.items()):
        yield what, size, str(number)


def _named(component: Component) -> str:
    """What the bill calls a component; one that does another's work by that, and by its label."""
    if component.kind in ("tee", "cross", "tap") and component.what not in (None, component.kind):
        return f"{component.kind} ({component.what})"
    return component.what or component.kind


def _table(rows: Iterable[tuple[str, str, str]], left: float, top: float) -> Iterator[Svg]:
    for number, (what, size, amount) in enumerate([("COMPONENT", "DN", "QUANTITY"), *rows]):
        y, style = top + number * _LINE, "b" if number == 0 else None
        yield element("text", _short(what), x=left, y=y, class_=style)
        yield element("text", size, x=left + 190, y=y, class_=style)
        yield element("text", amount, x=left + _BILL, y=y, text_anchor="end", class_=style)


def _title(line: PipedLine, left: float, high: float) -> Iterator[Svg]:
    length = f"{line.line.length:.3f} m" if line.line.length is not None else "unknown"
    rows = [
        (f"LINE {line.line.tag}", "b"),
        (f"from {line.line.start_name} to {line.line.end_name}", None),
        (f"DN {line.line.size or 'unknown'}, length {length}", None),
        ("not to scale, dimensions in mm", None),
    ]
    top = high - 24 - len(rows) * _LINE
    yield element("path", d=f"M{left:.1f} {top - 10:.1f}h{_BILL:.1f}", class_="d")
    for number, (words, style) in enumerate(rows):
        yield element("text", _short(words), x=left, y=top + (number + 0.7) * _LINE, class_=style)


# Small geometry on the sheet


def _across(leg: _Leg, a: Spot, b: Spot) -> Spot:
    """A direction along another axis than that of a leg: up beside what lies, east beside what stands."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    upright = abs(dx) < 0.2 * (abs(dx) + abs(dy))
    return (_COS, _SIN) if upright else (0.0, 1.0)


def _off(at: Spot, way: Spot, distance: float) -> Spot:
    return at[0] + way[0] * distance, at[1] + way[1] * distance


def _between(a: Spot, b: Spot, share: float) -> Spot:
    return a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share


def _back(at: Spot, inward: Spot) -> Spot:
    return at[0] - inward[0], at[1] - inward[1]


def _widths(reducer: Component) -> tuple[float, float]:
    first, last = (size or 0 for size in reducer.sizes)
    return (9.0, 5.0) if first >= last else (5.0, 9.0)


def _meet(one: Box, other: Box) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


def _short(text: str) -> str:
    clean = printable(text)
    return clean if len(clean) <= _LONGEST else clean[: _LONGEST - 1] + "\u2026"
