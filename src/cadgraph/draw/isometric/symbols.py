"""The symbols of what stands in a line and at its ends, with their tags."""

from __future__ import annotations

import math
from collections.abc import Sequence

from cadgraph.draw.isometric.legs import _LENGTHS, Leg, corner, project
from cadgraph.draw.isometric.sheet import COS, SIN, Isometric, Spot, between, meet, off, short
from cadgraph.draw.svg import element
from cadgraph.model.records import Point
from cadgraph.query.piped_line import Branch, Component, LineEnd, PipedLine

__all__ = ["draw_instruments", "draw_pipes", "write_end", "write_tags"]

_BOXES = ("instrument", "other", "strainer", "hose", "expansion joint")  # drawn as a box in the line
_STEM, _BALLOON, _BALLOON_LETTERS = 10.0, 19.0, 5  # of an instrument: its line, radius, and the letters in it


def draw_pipes(sheet: Isometric, line: PipedLine, legs: Sequence[Leg], spots: Sequence[Spot]) -> None:
    """Everything that stands in a line, its branches and the arrow of its flow."""
    for i, (leg, a, b) in enumerate(zip(legs, spots, spots[1:], strict=False)):
        _symbol(sheet, leg, a, b)
        # Of what turns or branches the second half begins at its middle.
        for branch in leg.component.branches if leg.half != 1 else ():
            _branch(sheet, branch, a if leg.half else between(a, b, 0.5), leg.start)
        if i and _welded(legs[i - 1], leg):
            sheet.dot(a, 3.0, "w")
    for each in line.components:
        if each.kind == "tap":
            at = spots[min(range(len(spots)), key=lambda i: math.dist(corner(legs, i), each.start))]
            for branch in each.branches:
                _branch(sheet, branch, at, each.start)
    if line.line.flow == "forward":
        _flow(sheet, legs, spots)


def _branch(sheet: Isometric, branch: Branch, at: Spot, start: Point) -> None:
    """A short piece of a branch with what goes on there."""
    way = project(tuple(p - c for p, c in zip(branch.point, start, strict=True)), sheet.turned)
    size = math.hypot(*way) or 1.0
    tip = (at[0] + way[0] / size * 26, at[1] + way[1] / size * 26)
    sheet.line([at, tip], "p")
    if branch.line:
        sheet.text(tip, [branch.line], way)


def _symbol(sheet: Isometric, leg: Leg, a: Spot, b: Spot) -> None:
    """What a leg looks like between two places on the sheet."""
    kind, across = leg.component.kind, _across(leg, a, b)
    if kind == "valve":
        _valve(sheet, leg.component.what or "", a, b, across)
    elif kind in ("flange", "blind flange"):
        at = between(a, b, 0.5)
        sheet.line([a, b], "p")
        sheet.line([off(at, across, -9), off(at, across, 9)], "p" if kind == "blind flange" else "f")
    elif kind == "reducer":
        first, last = _widths(leg.component)
        sheet.area([off(a, across, -first), off(b, across, -last), off(b, across, last), off(a, across, first)])
    elif kind in _BOXES:
        sheet.area([off(a, across, -7), off(b, across, -7), off(b, across, 7), off(a, across, 7)])
    elif kind != "gasket":
        sheet.line([a, b], "p")


def _flow(sheet: Isometric, legs: Sequence[Leg], spots: Sequence[Spot]) -> None:
    """An arrow with the flow, on the first pipe."""
    pipes = [(a, b) for leg, a, b in zip(legs, spots, spots[1:], strict=False) if leg.component.kind == "pipe"]
    for a, b in pipes[:1]:
        way = ((b[0] - a[0]) / math.dist(a, b), (b[1] - a[1]) / math.dist(a, b))
        tip, side = between(a, b, 0.5), (-way[1], way[0])
        back = (tip[0] - way[0] * 12, tip[1] - way[1] * 12)
        sheet.area([tip, off(back, side, 5), off(back, side, -5)], "w")


def _valve(sheet: Isometric, what: str, a: Spot, b: Spot, across: Spot) -> None:
    """Two triangles with the mark of its kind, as ISO 10628-2 has it for globe, ball and butterfly valves."""
    middle = between(a, b, 0.5)
    sheet.area([off(a, across, -8), off(a, across, 8), middle], "w" if "check" in what else "s")
    sheet.area([off(b, across, -8), off(b, across, 8), middle])
    if "globe" in what:
        sheet.dot(middle, 4.0, "w")
    elif "ball" in what or "plug" in what:
        sheet.dot(middle, 4.5, "s")
    elif "butterfly" in what:
        sheet.line([off(between(a, b, 0.25), across, -8), off(between(a, b, 0.75), across, 8)], "f")
        sheet.dot(middle, 3.0, "w")


def _welded(before: Leg, after: Leg) -> bool:
    """Whether a weld stands between two legs: where nothing is bolted, and not in the midst of a component."""
    if before.component is after.component or before.component.parts == after.component.parts:
        return False
    kinds = {before.component.kind, after.component.kind}
    if "gasket" in kinds or "valve" in kinds or "instrument" in kinds:
        return False
    return not kinds <= {"flange", "blind flange"}


def write_tags(sheet: Isometric, legs: Sequence[Leg], spots: Sequence[Spot]) -> None:
    """The tags of components, and the size of pipes where it changes."""
    size: object = None
    for leg, a, b in zip(legs, spots, spots[1:], strict=False):
        across = _across(leg, a, b)
        away = (-across[0], -across[1])
        if leg.component.tag is not None and leg.half < 2:
            sheet.text(between(a, b, 0.5), [leg.component.tag, leg.component.what or ""], away, "b")
        elif leg.component.kind == "pipe" and leg.component.sizes[0] not in (None, size):
            size = leg.component.sizes[0]
            sheet.text(between(a, b, 0.5), [f"DN {size}"], away)


def draw_instruments(sheet: Isometric, line: PipedLine, legs: Sequence[Leg], spots: Sequence[Spot]) -> None:
    """The balloons of instruments."""
    for tag, kind, point in line.instruments:
        nearest = min(range(len(spots)), key=lambda i: math.dist(corner(legs, i), point))
        at, way = spots[nearest], _free(sheet, spots[nearest])
        middle = off(at, way, _STEM + _BALLOON)
        sheet.line([at, off(at, way, _STEM)], "f")
        if "valve" in (kind or ""):
            far = off(at, way, _STEM + _LENGTHS["valve"])
            _valve(sheet, kind or "", off(at, way, _STEM), far, (-way[1], way[0]))
            sheet.text(far, [tag, kind or ""], way, "b")
            continue
        sheet.dot(middle, _BALLOON, "s")
        if len(tag) <= _BALLOON_LETTERS:
            sheet.shapes.append(
                element("text", short(tag), x=middle[0], y=middle[1] + 4, text_anchor="middle", class_="b")
            )
        else:
            sheet.text(middle, [tag], way, "b")


def _free(sheet: Isometric, at: Spot) -> Spot:
    """Which way along the axes the balloon of an instrument covers least, upwards first."""
    ways = ((0.0, -1.0), (COS, -SIN), (-COS, -SIN), (COS, SIN), (-COS, SIN), (0.0, 1.0))

    def covered(number: int) -> int:
        x, y = off(at, ways[number], _STEM + _BALLOON)
        balloon = (x - _BALLOON, y - _BALLOON, x + _BALLOON, y + _BALLOON)
        return sum(meet(balloon, box) for box in sheet.solid)

    return ways[min(range(len(ways)), key=lambda number: (covered(number), number))]


def write_end(sheet: Isometric, end: LineEnd, at: Spot, away: Spot) -> None:
    """What a line goes on to, and where that is."""
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


def _across(leg: Leg, a: Spot, b: Spot) -> Spot:
    """A direction along another axis than that of a leg: up beside what lies, east beside what stands."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    upright = abs(dx) < 0.2 * (abs(dx) + abs(dy))
    return (COS, SIN) if upright else (0.0, 1.0)


def _widths(reducer: Component) -> tuple[float, float]:
    first, last = (size or 0 for size in reducer.sizes)
    return (9.0, 5.0) if first >= last else (5.0, 9.0)
