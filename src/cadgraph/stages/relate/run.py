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
from cadgraph.stages.relate.size import nominal_size, sizes_along
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
        sure: whether a part is a connector by its label.
    """
    spans = _kept(net, len(units), sure)
    nodes = sorted({node for span in spans for node in (span.a, span.b) if node >= len(units)}, key=_by_place(spans))
    number = {node: len(units) + k for k, node in enumerate(nodes)}
    number.update({k: k for k in range(len(units))})
    places = tuple(_place(node, spans, drawing, lines, found, ending) for node in nodes)
    openings = [list(found) for found in drawing.openings]
    used = _used_ports(spans, len(units))
    renumbered: list[dict[int, int]] = []
    final = []
    for unit, opened in enumerate(openings):
        kept = sorted(used.get(unit, ()), key=lambda port: _port_key(opened[port]))
        renumbered.append({port: k for k, port in enumerate(kept)})
        final.append(tuple(_sized(opened[port]) for port in kept))
    outcome = tuple(replace(unit, openings=ports) for unit, ports in zip(units, final, strict=True))
    links = []
    for span in spans:
        one = span
        if number[span.a] > number[span.b]:
            one = span.reversed()
        links.append(_link(one, number, outcome, renumbered))
    links.sort(key=lambda link: (link.source, link.target, link.length, link.via, link.path))
    return Network(outcome, places, tuple(links), _systems(links))


def _kept(net: Net, n_units: int, sure: Callable[[int], bool]) -> list[Span]:
    """The spans of networks that hold a unit, or a run of pipe whose label says so."""
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
    of_group: dict[int, list[Span]] = {}
    for _, span in sorted(net.spans.items()):
        of_group.setdefault(group[span.a], []).append(span)
    kept = []
    for _, members in sorted(of_group.items()):
        held = any(node < n_units for span in members for node in (span.a, span.b))
        long = sum(span.length for span in members) >= _LEAST_RUN and any(span.pieces for span in members)
        if held or (long and any(sure(part) for span in members for part in span.via)):
            kept += members
    return kept


def _by_place(spans: Sequence[Span]) -> Callable[[int], tuple[float, ...]]:
    where: dict[int, Floats] = {}
    for span in spans:
        where.setdefault(span.a, span.points[0])
        where.setdefault(span.b, span.points[-1])
    return lambda node: (*(round(float(x), 4) for x in where[node]), node)


def _place(
    node: int,
    spans: Sequence[Span],
    drawing: Drawing,
    lines: Mapping[int, Centreline],
    found: Attachments,
    ending: Callable[[int], str | None],
) -> Place:
    meeting = [(span.points[0], span.via[:1]) for span in spans if span.a == node]
    meeting += [(span.points[-1], span.via[-1:]) for span in spans if span.b == node]
    parts = tuple(sorted({part for _, via in meeting for part in via}))
    x, y, z = (float(v) for v in np.mean([point for point, _ in meeting], axis=0))
    kind = "junction"
    if len(meeting) == 1:
        (span,) = (span for span in spans if node in (span.a, span.b))
        kind = _ending(span if span.b == node else span.reversed(), node, drawing, lines, found, ending)
    return Place(kind, (x, y, z), parts)


def _ending(
    span: Span,
    node: int,
    drawing: Drawing,
    lines: Mapping[int, Centreline],
    found: Attachments,
    ending: Callable[[int], str | None],
) -> str:
    """Whether a run ends open or closed, by the label of what stands there, else by its shape."""
    if not span.via:
        return "unknown"
    last = span.via[-1]
    said = ending(last)
    if said is not None:
        return said
    rows = [row for row in drawing.ends.get(node, ()) if int(found.ends.part[row]) == last]
    if last not in lines or not rows:
        return "unknown"
    if np.isfinite(found.ends.bore[rows[0]]):
        return "open"
    # Two discs at the end, the last one without a hole: a flange and its lid.
    before = span.via[-2] if len(span.via) > 1 else None
    radius = max(float(branch.radius.max()) for branch in lines[last].branches)
    if before is not None and before in lines and lines[last].length < radius:
        other = lines[before].branches
        wide = max(float(branch.radius.max()) for branch in other)
        if lines[before].length < 1.6 * wide and radius >= 0.9 * wide:
            return "blind"
    return "open"


def _used_ports(spans: Sequence[Span], n_units: int) -> dict[int, set[int]]:
    used: dict[int, set[int]] = {}
    for span in spans:
        for node, port in ((span.a, span.port_a), (span.b, span.port_b)):
            if node < n_units and port >= 0:
                used.setdefault(node, set()).add(port)
    return used


def _port_key(opening: Opening) -> tuple[float, ...]:
    return tuple(round(x, 3) for x in opening.point) + opening.point


def _sized(opening: Opening) -> Opening:
    """The opening with the nominal bore where its line has one; its face may be that of a flange."""
    return opening


def _link(
    span: Span, number: Mapping[int, int], units: Sequence[UnitParts], renumbered: Sequence[Mapping[int, int]]
) -> Link:
    source, target = number[span.a], number[span.b]
    ports = [
        renumbered[node].get(port, -1) if node < len(units) else -1
        for node, port in ((source, span.port_a), (target, span.port_b))
    ]
    points, length = span.points, span.length
    for at_end, (node, port) in enumerate(zip((source, target), ports, strict=True)):
        half = _half(units[node], port) if node < len(units) else None
        if half is not None:
            tip = points[-1] if at_end else points[0]
            length += float(np.linalg.norm(half - tip))
            points = np.concatenate([points, half[None]] if at_end else [half[None], points])
    sizes = sizes_along([piece[:2] for piece in span.pieces])
    size, bore = _main_size(span)
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


def _half(unit: UnitParts, port: int) -> Floats | None:
    """The middle of a unit that the line passes through, half way between its two openings."""
    if unit.unit_type not in _PASSED or len(unit.openings) != 2 or port < 0:
        return None
    return np.asarray(np.mean([opening.point for opening in unit.openings], axis=0), np.float64)


def _main_size(span: Span) -> tuple[int | None, float | None]:
    """The nominal size of most of a run, and its bore, else its outer diameter."""
    lengths: dict[int | None, float] = {}
    for length, outer, _ in span.pieces:
        size = nominal_size(outer)
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
