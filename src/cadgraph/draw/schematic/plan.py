"""What a schematic shows: the anchors that lines end at, and the rows of symbols that stand in lines."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import networkx

from cadgraph._io.text import tag_key
from cadgraph.draw.schematic.order import order_anchors
from cadgraph.draw.schematic.symbol import Symbol, symbol_of, text_width
from cadgraph.model.records import Junction, System
from cadgraph.query.lines import Line, find_lines
from cadgraph.query.network import Network

__all__ = ["Anchor", "Cell", "Edge", "Row", "Sketch", "plan_systems"]

_CELL_GAP = 14.0  # px between neighbours in a row
_REDUCER = 20.0  # px along the line
_STEM = 20.0  # px from a line to the next symbol of a tap
_TEXT = 8.0  # px, size of tags
_BELOW = 16.0  # px for the line's label below it


@dataclass(frozen=True)
class Cell:
    """One place in a row: a symbol in the line, a tap with what hangs at it, or a reducer.

    Args:
        symbol: in the line; None for a tap.
        hanging: symbols above the line, the nearest first.
        sizes: of a reducer, nominal sizes to its left and right; else None.
        place: id of what stands here.
        begins: number of the connection that begins here, in the order in which they are drawn; 0 where none does.
    """

    symbol: Symbol | None
    hanging: tuple[Symbol, ...] = ()
    sizes: tuple[int, int] | None = None
    place: str = ""
    begins: int = 0

    @cached_property
    def width(self) -> float:
        """Room along the line [px]."""
        if self.sizes:
            return _REDUCER
        shown = [s for s in (self.symbol, *self.hanging) if s is not None]
        return max(max(s.width, s.label_width) for s in shown) + _CELL_GAP

    @cached_property
    def top(self) -> float:
        """Room above the line [px]."""
        height = sum(_STEM + s.height for s in self.hanging)
        above = self.symbol.top + _TEXT + 4 if self.symbol else 0.0
        return max(height + 2, above)


@dataclass(frozen=True)
class Anchor:
    """A node that lines end at.

    Args:
        place: its id.
        symbol: how it is drawn.
    """

    place: str
    symbol: Symbol


@dataclass(frozen=True)
class Row:
    """A line, or a tap at an anchor: symbols side by side.

    Args:
        cells: in the order in which they are drawn from left to right.
        label: text below the line; empty for taps.
        line: the line; None for a tap.
        reverse: whether the line's start is at the right.
    """

    cells: tuple[Cell, ...]
    label: str
    line: Line | None
    reverse: bool

    @cached_property
    def connections(self) -> tuple[int, ...]:
        """The connections of the line, by their index in the network, from left to right."""
        found = tuple(arc.index for arc in self.line.arcs) if self.line else ()
        return found[::-1] if self.reverse else found

    @cached_property
    def width(self) -> float:
        """Room that it takes along the line [px]."""
        return max(sum(cell.width for cell in self.cells), text_width(self.label, 7.0) + 6, 12.0)

    @cached_property
    def top(self) -> float:
        """Room above the line [px]."""
        return max((cell.top for cell in self.cells), default=4.0)

    @cached_property
    def bottom(self) -> float:
        """Room below the line [px]."""
        symbols = [cell.symbol.bottom for cell in self.cells if cell.symbol is not None]
        return max([_BELOW if self.label else 4.0, *((s + 12 if self.label else s) for s in symbols)])


@dataclass(frozen=True)
class Edge:
    """A piece of line between an anchor and a row; both by their index.

    Args:
        anchor: index of the anchor.
        row: index of the row.
        into: whether it is drawn from the anchor, at the left, to the row.
        port: of the anchor.
        flow: of the line where it is known, seen from the anchor: ``"out"``, ``"in"`` or ``""``.
        solid: whether the connection is sure; else it is dashed.
    """

    anchor: int
    row: int
    into: bool
    port: str
    flow: str
    solid: bool


@dataclass(frozen=True)
class Sketch:
    """One connected network to draw.

    Args:
        title: what it is called.
        anchors: the nodes that lines end at.
        rows: lines and taps.
        edges: what joins them.
    """

    title: str
    anchors: tuple[Anchor, ...]
    rows: tuple[Row, ...]
    edges: tuple[Edge, ...]


# Below this a connection is drawn dashed: our own choice, where most connections have 0.9 and more.
_SURE = 0.7


def plan_systems(network: Network, only: str | None = None) -> list[Sketch]:
    """A sketch of every connected network, the largest first.

    Args:
        network: of the finished graph.
        only: id of the one system to plan; all where None.

    Raises:
        ValueError: no system has that id.
    """
    systems = network.graph.of_layer(System)
    if only is not None and only not in {system.id for system in systems}:
        known = ", ".join(system.id for system in systems) or "none"
        raise ValueError(f"no system is called {only!r}; there are: {known}")
    lines = find_lines(network)
    joined: networkx.Graph[str] = networkx.Graph()
    for edge in network.edges:
        joined.add_edge(edge.source, edge.target)
    groups = [sorted(group, key=lambda p: tag_key(network.name(p))) for group in networkx.connected_components(joined)]
    if only is not None:
        groups = [group for group in groups if any(network.system(place) == only for place in group)]
    groups.sort(key=lambda group: (-len(group), tag_key(network.name(group[0]))))
    return [_sketch(network, group, lines) for group in groups]


def _sketch(network: Network, group: Sequence[str], lines: Sequence[Line]) -> Sketch:
    members = set(group)
    own = [line for line in lines if line.start in members]
    places = dict.fromkeys(end for line in own for end in (line.start, line.end))
    # A pipe from a vessel to nothing but instruments has no line, only taps.
    for place in group:
        inside = any(place == arc.end for line in own for arc in line.arcs[:-1])
        if network.tap_chains(place) and not inside and not network.is_gauge(place) and not network.is_valve(place):
            places.setdefault(place)
    anchors = sorted(places, key=lambda place: tag_key(network.name(place)))
    index = {place: i for i, place in enumerate(anchors)}
    order = order_anchors(network, anchors, own)
    rows: list[Row] = []
    edges: list[Edge] = []
    for line in own:
        _add_line(network, line, index, order, rows, edges)
    for place in anchors:
        for chain in network.tap_chains(place):
            cells = tuple(Cell(symbol_of(network, one), place=one) for one in chain)
            edges.append(Edge(index[place], len(rows), True, "", "", True))
            rows.append(Row(cells, "", None, False))
    drawn = tuple(Anchor(place, symbol_of(network, place)) for place in anchors)
    return Sketch(_title(network, group), drawn, tuple(rows), tuple(edges))


def _add_line(
    network: Network,
    line: Line,
    index: dict[str, int],
    order: dict[str, int],
    rows: list[Row],
    edges: list[Edge],
) -> None:
    reverse = order[line.start] > order[line.end]
    cells = _cells(network, line, reverse)
    label = f"{line.tag}  DN {line.size}" if line.size else line.tag
    row = len(rows)
    rows.append(Row(tuple(cells), label, line, reverse))
    sure = [arc.edge.confidence is None or arc.edge.confidence >= _SURE for arc in line.arcs]
    flows = {"forward": ("out", "in"), "backward": ("in", "out")}.get(line.flow, ("", ""))
    edges.append(Edge(index[line.start], row, not reverse, line.start_port or "", flows[0], sure[0]))
    edges.append(Edge(index[line.end], row, reverse, line.end_port or "", flows[1], sure[-1]))


def _cells(network: Network, line: Line, reverse: bool) -> list[Cell]:
    forward = {"forward": 1, "backward": -1}.get(line.flow, 0) * (-1 if reverse else 1)
    cells: list[Cell] = []
    arcs = [arc.back for arc in reversed(line.arcs)] if reverse else list(line.arcs)
    for number, arc in enumerate(arcs):
        if number:
            first, *more = _standing(network, arc.start, forward) or (None,)
            cells += [replace(first, begins=number), *more] if first is not None else []
        before = arcs[number - 1].sizes[-1:] if number else ()
        sizes = [*before, *arc.sizes]
        for pair in pairwise(sizes):
            if pair[0] != pair[1]:
                cells.append(Cell(None, (), pair))
    return cells


def _standing(network: Network, place: str, flow: int) -> list[Cell]:
    """The cells of one node in a line."""
    if isinstance(network.places[place], Junction):
        return [
            Cell(None, tuple(symbol_of(network, one, upright=True) for one in chain), None, place)
            for chain in network.tap_chains(place)
        ]
    if network.is_gauge(place) or network.stands_aside(place):
        return [Cell(None, (symbol_of(network, place, upright=True),), None, place)]
    return [Cell(symbol_of(network, place, flow=flow), (), None, place)]


def _title(network: Network, group: Sequence[str]) -> str:
    named = next((network.system(place) for place in group if network.system(place)), None)
    system = next((s for s in network.graph.of_layer(System) if s.id == named), None)
    if system is None:
        return named or "network"
    told = [system.id]
    if system.length is not None:
        told.append(f"{system.length:.1f} m")
    if system.sizes:
        low, high = min(system.sizes), max(system.sizes)
        told.append(f"DN {low}" if low == high else f"DN {low} to {high}")
    return " · ".join(told)
