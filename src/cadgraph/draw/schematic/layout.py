"""Where everything of a sketch goes: a layered layout with orthogonal lines, by the library graphlay."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import graphlay
import numpy as np

from cadgraph.draw.schematic.plan import Anchor, Edge, Row, Sketch
from cadgraph.draw.schematic.symbol import Symbol, text_width

__all__ = ["Placed", "lay_out", "pack"]

_PORT_PITCH = 26.0  # px between nozzles on one side of a tank
_POINT = 0.1  # px, a junction: the lines meet in one point
_SAME = 2.0  # px; ports of boxes in line can be that far off each other
_JOG = 40.0  # px; a row is moved by no more for the sake of a straight line
_CLEAR = 7.0  # px between what stands on different levels
_LEAST = 56.0  # px, height of the smallest tank
_GROWING = ("tank", "equipment", "exchanger", "strainer")
_OPTIONS: dict[str, Any] = {
    "spacing": {"layer_gap": 34.0, "node_gap": 22.0, "dummy_gap": 22.0, "port_gap": 22.0, "stub": 16.0},
    "routing": {
        "style": "orthogonal",
        "bundle_parallel": False,
        "port_sides": "facing_preferred",
        "merge_edges": "none",
        "centre_ports": "all",
    },
    "coords": {"placement": "network_simplex", "branch_style": "straight_main"},
    "cycles": {"strategy": "follow_flow"},
}

Way = tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class Placed:
    """A sketch with places.

    Args:
        sketch: what was laid out; the symbols of its anchors as they are drawn.
        anchors: centre of each anchor [px].
        rows: centre of each row [px].
        ways: polyline of each edge from the anchor to the row [px].
        box: left, top, right, bottom of all [px].
    """

    sketch: Sketch
    anchors: Way
    rows: Way
    ways: tuple[Way, ...]
    box: tuple[float, float, float, float]


def lay_out(sketch: Sketch) -> Placed:
    """Places a sketch: flow from left to right, lines orthogonal, rows straight; the same sketch always alike."""
    sketch = _with_tanks_grown(sketch)
    nodes = [*map(_node, sketch.anchors), *map(_node, sketch.rows)]
    edges = []
    for edge in sketch.edges:
        ends = (edge.anchor, len(sketch.anchors) + edge.row)
        source, target = ends if edge.into else ends[::-1]
        ports = _ports(sketch, edge)
        edges.append({"source": source, "target": target, "weight": _weight(sketch.rows[edge.row]), **ports})
    found = graphlay.layout({"nodes": nodes, "edges": edges}, options=_OPTIONS)
    centres = tuple((node["center"]["x"], node["center"]["y"]) for node in found.nodes)
    ways = []
    for edge, route in zip(sketch.edges, found.edges, strict=True):
        way = _upright([(point["x"], point["y"]) for point in route["points"]])
        ways.append(way if edge.into else way[::-1])
    placed = Placed(sketch, centres[: len(sketch.anchors)], centres[len(sketch.anchors) :], tuple(ways), (0, 0, 0, 0))
    placed = _compacted(_straightened(placed))
    return replace(placed, box=_box(placed))


def _upright(points: list[tuple[float, float]]) -> Way:
    """A way whose vertical pieces are just that; the library leans some of them by a fraction of a pixel."""
    way = list(points)
    for i in range(1, len(way) - 2):
        (ax, ay), (bx, by) = way[i], way[i + 1]
        if abs(bx - ax) <= _SAME < abs(by - ay):
            way[i + 1] = (ax, by)
    return tuple(way)


def pack(boxes: Sequence[tuple[float, float]], gap: float) -> tuple[list[tuple[float, float]], float, float]:
    """Places rectangles in shelves, in their order.

    Args:
        boxes: width and height of each.
        gap: between them.

    Returns:
        The upper left corner of each, and the width and height of all.
    """
    if not boxes:
        return [], 0.0, 0.0
    area = sum((w + gap) * (h + gap) for w, h in boxes)
    wide = max(max(w for w, _ in boxes), (1.6 * area) ** 0.5)
    x = y = tall = right = 0.0
    corners = []
    for w, h in boxes:
        if x and x + w > wide:
            x, y, tall = 0.0, y + tall + gap, 0.0
        corners.append((x, y))
        right, tall, x = max(right, x + w), max(tall, h), x + w + gap
    return corners, right, y + tall


def _with_tanks_grown(sketch: Sketch) -> Sketch:
    """Tanks (and what else has room for nozzles) as high as their busier side needs."""
    sides: dict[tuple[int, bool], int] = {}
    for edge in sketch.edges:
        sides[edge.anchor, edge.into] = sides.get((edge.anchor, edge.into), 0) + 1
    anchors = []
    for i, anchor in enumerate(sketch.anchors):
        symbol = anchor.symbol
        if symbol.form in _GROWING:
            most = max(sides.get((i, True), 0), sides.get((i, False), 0))
            half = max(symbol.top, (most + 1) * _PORT_PITCH / 2)
            symbol = replace(symbol, top=half, bottom=half)
        anchors.append(Anchor(anchor.place, symbol))
    return replace(sketch, anchors=tuple(anchors))


def _extents(item: Anchor | Row) -> tuple[float, float, float]:
    """Room that an anchor or a row takes: its width, and above and below the line [px]."""
    if isinstance(item, Row):
        return item.width, item.top, item.bottom
    symbol = item.symbol
    if symbol.form == "junction":
        return _POINT, _POINT / 2, _POINT / 2
    if symbol.form in ("open", "end", "blind"):
        high = symbol.bottom + 11
        return max(symbol.width, text_width(symbol.label, 6.5)), high, high
    return max(symbol.width, symbol.label_width), symbol.top + (13 if symbol.label_width else 0), symbol.bottom


def _node(item: Anchor | Row) -> dict[str, Any]:
    # As high below the line as above it, since the library keeps the middles of boxes in line; compacted later.
    width, above, below = _extents(item)
    return {"size": {"width": width, "height": 2 * max(above, below)}, "shape": "box"}


def _ports(sketch: Sketch, edge: Edge) -> dict[str, Any]:
    """Rows are entered and left at their ends; pumps have their suction at the left. Tanks are entered anywhere."""
    here, there = ("source_port", "target_port") if edge.into else ("target_port", "source_port")
    sides = ("right", "left") if edge.into else ("left", "right")
    ports: dict[str, Any] = {there: _middle(sides[1])}
    if sketch.anchors[edge.anchor].symbol.form in ("pump", "valve", "instrument", "open", "end", "blind", *_IN_LINE):
        ports[here] = _middle(sides[0])
    if sketch.anchors[edge.anchor].symbol.form == "pump" and edge.flow:
        ports[here] = _middle("right" if edge.flow == "out" else "left")
    return ports


def _middle(side: str) -> dict[str, Any]:
    # Without the offset a line is led to wherever on the side it comes straight from.
    return {"offset": {"side": side, "t": 0.0}}


_IN_LINE = ("ball", "gate", "globe", "plug", "butterfly", "check", "control", "relief")


def _straightened(placed: Placed) -> Placed:
    """Ends of lines, pumps and the like moved to the level of the lines that lead there, where nothing else stands."""
    of_anchor: dict[int, list[int]] = {}
    for i, edge in enumerate(placed.sketch.edges):
        of_anchor.setdefault(edge.anchor, []).append(i)
    for anchor, edges in of_anchor.items():
        form = placed.sketch.anchors[anchor].symbol.form
        if len(edges) <= 2 and form not in (*_GROWING, "junction"):
            placed = _moved_to_line(placed, anchor, edges)
    for row in range(len(placed.sketch.rows)):
        placed = _moved_to_anchor(placed, row, [i for i, edge in enumerate(placed.sketch.edges) if edge.row == row])
    return placed


def _moved_to_line(placed: Placed, anchor: int, edges: Sequence[int]) -> Placed:
    """An anchor at the level of its rows, if that is one level and free all along the new straight ways."""
    (x, y), level = placed.anchors[anchor], placed.ways[edges[0]][-1][1]
    ways = [placed.ways[i] for i in edges]
    turning = any(abs(way[0][1] - way[1][1]) > _SAME or abs(way[0][0] - way[-1][0]) < 1 for way in ways)
    if abs(y - level) <= _SAME or turning or any(abs(way[-1][1] - level) > _SAME for way in ways):
        return placed
    width, above, below = _extents(placed.sketch.anchors[anchor])
    half = max(above, below)
    reach = [x - width / 2, x + width / 2, *(way[-1][0] for way in ways)]
    left, right = min(reach) + 0.1, max(reach) - 0.1
    box = (left, right, level, half, half)
    if any(_collide(box, block) for block in _blocks(placed, anchor, edges)):
        return placed
    anchors, straight = list(placed.anchors), list(placed.ways)
    anchors[anchor] = (x, level)
    for i, way in zip(edges, ways, strict=True):
        straight[i] = ((way[0][0], level), (way[-1][0], level))
    return replace(placed, anchors=tuple(anchors), ways=tuple(straight))


def _moved_to_anchor(placed: Placed, row: int, edges: Sequence[int]) -> Placed:
    """A row at the level of the pump or valve beside it, where it has a bend at its other end anyway and is free."""
    (x, y), shape = placed.rows[row], placed.sketch.rows[row]
    for i, other in (edges, edges[::-1]) if len(edges) == 2 else ():
        level, way = placed.anchors[placed.sketch.edges[i].anchor][1], placed.ways[other]
        form = placed.sketch.anchors[placed.sketch.edges[i].anchor].symbol.form
        straight = form not in (*_GROWING, "junction") and len(placed.ways[i]) == 4 and 0 < abs(level - y) <= _JOG
        if not straight or len(way) < 3 or abs(way[-2][0] - way[-3][0]) > _SAME:
            continue
        reach = [x - shape.width / 2, x + shape.width / 2, placed.ways[i][0][0], way[-2][0]]
        half = max(shape.top, shape.bottom)
        box = (min(reach) + 0.1, max(reach) - 0.1, level, half, half)
        if any(_collide(box, block) for block in _blocks(placed, no_edges=edges, no_row=row)):
            continue
        rows, ways = list(placed.rows), list(placed.ways)
        rows[row] = (x, level)
        ways[i] = ((ways[i][0][0], level), (ways[i][-1][0], level))
        ways[other] = (*way[:-2], (way[-2][0], level), (way[-1][0], level))
        return replace(placed, rows=tuple(rows), ways=tuple(ways))
    return placed


def _collide(a: tuple[float, ...], b: tuple[float, ...]) -> bool:
    """Whether two blocks (left, right, level, room above, room below) overlap."""
    return b[0] < a[1] and b[1] > a[0] and b[2] - b[3] < a[2] + a[4] and b[2] + b[4] > a[2] - a[3]


def _compacted(placed: Placed) -> Placed:
    """The levels of a drawing moved together as far as what stands on them allows.

    Whatever lay on one level stays on one, and no two levels change their order, so that no line gets a new bend or
    crossing.
    """
    blocks = _blocks(placed)
    levels = _levels([block[2] for block in blocks])
    at = np.array([levels[block[2]] for block in blocks])
    x0, x1, up, down = (np.array([block[i] for block in blocks]) for i in (0, 1, 3, 4))
    new = np.zeros(len(blocks))
    height: list[float] = []
    for level in range(int(at.max(initial=-1)) + 1):
        low = height[-1] if height else 0.0
        for i in np.nonzero(at == level)[0]:
            above = (at < level) & (x0 < x1[i] + _CLEAR) & (x1 > x0[i] - _CLEAR)
            low = max(low, float((new[above] + down[above]).max(initial=-np.inf) + up[i] + _CLEAR))
        height.append(low)
        new[at == level] = low
    move = {y: height[level] for y, level in levels.items()}
    anchors, sketch = _moved_anchors(placed, move)
    return Placed(
        sketch,
        anchors,
        tuple((x, move[y]) for x, y in placed.rows),
        tuple(tuple((x, move[y]) for x, y in way) for way in placed.ways),
        placed.box,
    )


def _moved_anchors(placed: Placed, move: dict[float, float]) -> tuple[Way, Sketch]:
    """Anchors at their new levels; tanks as high as their nozzles need now."""
    centres, anchors = [], []
    for (x, y), anchor in zip(placed.anchors, placed.sketch.anchors, strict=True):
        symbol = anchor.symbol
        if symbol.form in _GROWING:
            top, bottom = move[y - symbol.top], move[y + symbol.bottom]
            half = (bottom - top) / 2
            symbol = replace(symbol, top=half, bottom=half)
            centres.append((x, top + half))
        else:
            centres.append((x, move[y]))
        anchors.append(Anchor(anchor.place, symbol))
    return tuple(centres), replace(placed.sketch, anchors=tuple(anchors))


def _blocks(
    placed: Placed, no_anchor: int = -1, no_edges: Sequence[int] = (), no_row: int = -1
) -> list[tuple[float, float, float, float, float]]:
    """All that takes room on a level: left, right, the level, room above it and below it [px].

    Args:
        placed: the drawing.
        no_anchor: one to leave out, by index.
        no_edges: to leave out, by index.
        no_row: one to leave out, by index.
    """
    blocks = []
    for i, ((x, y), row) in enumerate(zip(placed.rows, placed.sketch.rows, strict=True)):
        if i != no_row:
            blocks.append((x - row.width / 2, x + row.width / 2, y, row.top, row.bottom))
    for i, ((x, y), anchor) in enumerate(zip(placed.anchors, placed.sketch.anchors, strict=True)):
        width, above, below = _extents(anchor)
        if i == no_anchor:
            continue
        if anchor.symbol.form in _GROWING:
            # Its edges are levels of their own, so that it shrinks with what is beside it, down to what holds its tag.
            least = _LEAST / 2
            blocks.append((x - width / 2, x + width / 2, y - anchor.symbol.top, 4.0, least))
            blocks.append((x - width / 2, x + width / 2, y + anchor.symbol.bottom, least, 4.0))
        else:
            blocks.append((x - width / 2, x + width / 2, y, above, below))
    for i, (way, edge) in enumerate(zip(placed.ways, placed.sketch.edges, strict=True)):
        if i in no_edges:
            continue
        if placed.sketch.anchors[edge.anchor].symbol.form in _GROWING:
            # Nozzles keep apart, and clear of the edges.
            blocks.append((way[0][0] - 12, way[0][0] + 12, way[0][1], 6.0, 6.0))
        for (ax, ay), (bx, _) in pairwise(way):
            blocks.append((min(ax, bx), max(ax, bx), ay, 0.0, 0.0))
        blocks.append((way[-1][0], way[-1][0], way[-1][1], 0.0, 0.0))
    return blocks


def _levels(values: Sequence[float]) -> dict[float, int]:
    """The number of the level of each height; heights closer than a line is wide are one level."""
    levels: dict[float, int] = {}
    last, number = -math.inf, -1
    for value in sorted(set(values)):
        if value - last > _SAME:
            number += 1
        last = value
        levels[value] = number
    return levels


def _weight(row: Row) -> float:
    """Wide lines are kept straight before narrow ones."""
    return 1.0 + max(row.line.sizes, default=0) / 50 if row.line else 0.5


def _box(placed: Placed) -> tuple[float, float, float, float]:
    boxes = [(x, y, x, y) for way in placed.ways for x, y in way]
    for (x, y), anchor in zip(placed.anchors, placed.sketch.anchors, strict=True):
        boxes.append(_around(x, y, anchor.symbol))
    for (x, y), row in zip(placed.rows, placed.sketch.rows, strict=True):
        boxes.append((x - row.width / 2, y - row.top, x + row.width / 2, y + row.bottom))
    return (min(b[0] for b in boxes), min(b[1] for b in boxes), max(b[2] for b in boxes), max(b[3] for b in boxes))


def _around(x: float, y: float, symbol: Symbol) -> tuple[float, float, float, float]:
    half = max(symbol.width, text_width(symbol.label, 8.0)) / 2
    return x - half, y - symbol.top - 12, x + half, y + symbol.bottom + 12
