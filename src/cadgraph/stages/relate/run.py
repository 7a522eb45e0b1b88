"""Runs between units, junctions and terminals as links, with their lengths, sizes and ports."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from cadgraph.geometry.components import connected_sets
from cadgraph.geometry.line.centreline import Centreline
from cadgraph.model.parts import Link, Network, Opening, Place, UnitParts
from cadgraph.model.scene import Floats
from cadgraph.stages.relate.attach import Attachments
from cadgraph.stages.relate.network import Drawing
from cadgraph.stages.relate.size import nominal_size, sizes_along, table_of
from cadgraph.stages.relate.span import Net, Span

__all__ = ["make_network"]

# A run without units is told from this length on [m]: what is shorter are pieces that belong to nothing.
_LEAST_RUN = 0.05
# Units that lines pass through, so that a connection is measured from their middle; of the others from the nozzle.
_PASSED = frozenset({"valve", "gauge"})
# What closes a run is wider than its pipe by this factor, or a disc without a hole.
_WIDER = 1.25


def make_network(
    net: Net,
    drawing: Drawing,
    units: Sequence[UnitParts],
    lines: Mapping[int, Centreline],
    found: Attachments,
    ending: Callable[[int], str | None],
    cover: Callable[[int], str | None],
    sure: Callable[[int], bool],
) -> Network:
    """Makes links and places of the simplified net.

    Args:
        net: each node is a unit, or has one or at least three spans.
        drawing: what it was made from.
        units: in order.
        lines: of the connector parts.
        found: what joins what.
        ending: what a part's label says of a run that ends there: ``blind``, ``open`` or None.
        cover: what the body that a free end (by its row) lies against makes of it: ``blind``, ``unknown`` or None.
        sure: whether a part is a connector by its label.
    """
    spans = _kept(net, len(units), sure)
    nodes = _places_of(spans, len(units))
    number = {**{k: k for k in range(len(units))}, **{node: len(units) + k for k, node in enumerate(nodes)}}
    leaving, arriving = _by_ends(spans)
    places = tuple(
        _place(node, leaving.get(node, ()), arriving.get(node, ()), drawing, lines, found, ending, cover)
        for node in nodes
    )
    opened, renumbered = _used_openings(spans, units, drawing)
    directed = [span if number[span.a] <= number[span.b] else span.reversed() for span in spans]
    table = table_of(piece[:2] for span in directed for piece in span.pieces)
    links = [_link(span, number, opened, renumbered, table) for span in directed]
    links.sort(key=lambda link: (link.source, link.target, link.length, link.via, link.path))
    return Network(opened, places, tuple(links), _systems(links))


def _places_of(spans: Sequence[Span], n_units: int) -> list[int]:
    """The nodes that are no units, by place."""
    return sorted({node for span in spans for node in (span.a, span.b) if node >= n_units}, key=_by_place(spans))


def _used_openings(
    spans: Sequence[Span], units: Sequence[UnitParts], drawing: Drawing
) -> tuple[tuple[UnitParts, ...], list[dict[int, int]]]:
    """The units with those of their openings that a span uses, by place, and the new number of each."""
    used = _used_ports(spans, len(units))
    renumbered: list[dict[int, int]] = []
    outcome = []
    for number, (unit, opened) in enumerate(zip(units, drawing.openings, strict=True)):
        kept = sorted(used.get(number, ()), key=[_port_key(opening) for opening in opened].__getitem__)
        renumbered.append({port: k for k, port in enumerate(kept)})
        outcome.append(replace(unit, openings=tuple(opened[port] for port in kept)))
    return tuple(outcome), renumbered


def _kept(net: Net, n_units: int, sure: Callable[[int], bool]) -> list[Span]:
    """The spans of networks that hold a unit, or a run of pipe whose label says so."""
    group = _network_of(net)
    of_group: dict[int, list[Span]] = {}
    for _, span in sorted(net.spans.items()):
        of_group.setdefault(group[span.a], []).append(span)
    counted = [members for _, members in sorted(of_group.items()) if _counts(members, n_units, sure)]
    return [span for members in counted for span in members]


def _network_of(net: Net) -> dict[int, int]:
    """The least node of the network that each node belongs to."""
    group: dict[int, int] = {}
    for start in sorted(net.at):
        if start in group:
            continue
        group[start], front = start, [start]
        while front:
            for _, span in net.leaving(front.pop()):
                if span.b not in group:
                    group[span.b] = start
                    front.append(span.b)
    return group


def _counts(spans: Sequence[Span], n_units: int, sure: Callable[[int], bool]) -> bool:
    """Whether the spans of a network are told: they hold a unit, or are a run of pipe by its label."""
    if any(min(span.a, span.b) < n_units for span in spans):
        return True
    long = sum(span.length for span in spans) >= _LEAST_RUN and any(span.pieces for span in spans)
    return long and any(sure(part) for span in spans for part in span.via)


def _by_place(spans: Sequence[Span]) -> Callable[[int], tuple[float, ...]]:
    where: dict[int, Floats] = {}
    for span in spans:
        where.setdefault(span.a, span.points[0])
        where.setdefault(span.b, span.points[-1])
    return lambda node: (*(round(float(x), 4) for x in where[node]), node)


def _by_ends(spans: Sequence[Span]) -> tuple[dict[int, list[Span]], dict[int, list[Span]]]:
    """The spans that begin at each node, and those that end at it."""
    leaving: dict[int, list[Span]] = {}
    arriving: dict[int, list[Span]] = {}
    for span in spans:
        leaving.setdefault(span.a, []).append(span)
        arriving.setdefault(span.b, []).append(span)
    return leaving, arriving


def _place(
    node: int,
    leaving: Sequence[Span],
    arriving: Sequence[Span],
    drawing: Drawing,
    lines: Mapping[int, Centreline],
    found: Attachments,
    ending: Callable[[int], str | None],
    cover: Callable[[int], str | None],
) -> Place:
    meeting = [(span.points[0], span.via[:1]) for span in leaving]
    meeting += [(span.points[-1], span.via[-1:]) for span in arriving]
    parts = tuple(sorted({part for _, via in meeting for part in via}))
    x, y, z = (float(v) for v in np.mean([point for point, _ in meeting], axis=0))
    kind = "junction"
    if len(meeting) == 1:
        span = arriving[0] if arriving else leaving[0].reversed()
        kind = _ending(span, node, drawing, lines, found, ending, cover)
    return Place(kind, (x, y, z), parts)


def _ending(
    span: Span,
    node: int,
    drawing: Drawing,
    lines: Mapping[int, Centreline],
    found: Attachments,
    ending: Callable[[int], str | None],
    cover: Callable[[int], str | None],
) -> str:
    """Whether a run ends open or closed, by the label of what stands there, by its shape, or by what it ends at."""
    if not span.via:
        return "unknown"
    last = span.via[-1]
    said = ending(last)
    if said is not None:
        return said
    rows = [row for row in drawing.ends.get(node, ()) if int(found.ends.part[row]) == last]
    if last not in lines or not rows:
        return "unknown"
    lid = not np.isfinite(found.ends.bore[rows[0]]) and _is_lid(lines, span.via, last)
    return "blind" if lid else cover(rows[0]) or "open"


def _is_lid(lines: Mapping[int, Centreline], via: Sequence[int], last: int) -> bool:
    """Whether two discs end a run, of which the last one, without a hole, covers the other: a flange and its lid."""
    before = via[-2] if len(via) > 1 else None
    if before is None or before not in lines:
        return False
    radius, wide = _widest(lines[last]), _widest(lines[before])
    short = lines[last].length < radius and lines[before].length < 1.6 * wide
    return short and radius >= 0.9 * wide


def _widest(line: Centreline) -> float:
    return max(float(branch.radius.max()) for branch in line.branches)


def _used_ports(spans: Sequence[Span], n_units: int) -> dict[int, set[int]]:
    used: dict[int, set[int]] = {}
    for span in spans:
        for node, port in ((span.a, span.port_a), (span.b, span.port_b)):
            if node < n_units and port >= 0:
                used.setdefault(node, set()).add(port)
    return used


def _port_key(opening: Opening) -> tuple[float, ...]:
    return tuple(round(x, 3) for x in opening.point) + opening.point


def _link(
    span: Span,
    number: Mapping[int, int],
    units: Sequence[UnitParts],
    renumbered: Sequence[Mapping[int, int]],
    table: str,
) -> Link:
    source, target = number[span.a], number[span.b]
    ports = [
        renumbered[node].get(port, -1) if node < len(units) else -1
        for node, port in ((source, span.port_a), (target, span.port_b))
    ]
    points, length = _to_middles(span, (source, target), ports, units)
    sizes = sizes_along([piece[:2] for piece in span.pieces], table)
    size, bore = _main_size(span, table)
    diameter = size / 1000 if size is not None else bore
    path = _distinct(points)
    return Link(
        source=source,
        target=target,
        via=span.via,
        path=tuple((float(x), float(y), float(z)) for x, y, z in path),
        length=length,
        sizes=sizes,
        size=size,
        diameter=diameter,
        source_port=ports[0],
        target_port=ports[1],
        confidence=span.confidence,
    )


def _to_middles(
    span: Span, nodes: tuple[int, int], ports: Sequence[int], units: Sequence[UnitParts]
) -> tuple[Floats, float]:
    """The points and the length of a span, from and to the middles of the units that lines pass through."""
    points, length = span.points, span.length
    for at_end, (node, port) in enumerate(zip(nodes, ports, strict=True)):
        half = _half(units[node], port) if node < len(units) else None
        if half is not None:
            tip = points[-1] if at_end else points[0]
            length += float(np.linalg.norm(half - tip))
            points = np.concatenate([points, half[None]] if at_end else [half[None], points])
    return points, length


def _half(unit: UnitParts, port: int) -> Floats | None:
    """The middle of a unit that the line passes through, half way between its two openings."""
    if unit.unit_type not in _PASSED or len(unit.openings) != 2 or port < 0:
        return None
    return np.asarray(np.mean([opening.point for opening in unit.openings], axis=0), np.float64)


def _main_size(span: Span, table: str) -> tuple[int | None, float | None]:
    """The nominal size of most of a run, and its bore, else its outer diameter."""
    lengths: dict[int | None, float] = {}
    for length, outer, _ in span.pieces:
        size = nominal_size(outer, table)
        lengths[size] = lengths.get(size, 0.0) + length
    if not lengths:
        return None, None
    size = max(lengths, key=lambda s: (lengths[s], s is not None, s or 0))
    _, outer, bore = max(span.pieces, key=lambda piece: piece[0])
    return size, bore if np.isfinite(bore) else outer


def _distinct(points: Floats) -> Floats:
    if len(points) < 2:
        return points
    apart = np.linalg.norm(np.diff(points, axis=0), axis=1) > 1e-6
    kept: Floats = points[np.concatenate([[True], apart])]
    return kept


def _systems(links: Sequence[Link]) -> tuple[tuple[int, ...], ...]:
    pairs = [(link.source, link.target) for link in links]
    return tuple(connected_sets(sorted({node for pair in pairs for node in pair}), pairs))
