"""Drawing the network of lines between units: every piece of line between two joints is a span."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType

import numpy as np

from cadgraph.geometry.components import first_of_component
from cadgraph.geometry.line.centreline import Branch, Centreline
from cadgraph.model.parts import Opening, UnitParts, owners_of
from cadgraph.model.scene import Floats
from cadgraph.stages.relate.attach import Attachments, Side
from cadgraph.stages.relate.line import is_disc
from cadgraph.stages.relate.span import Net, Span, length_of

__all__ = ["FLANGED_SCORE", "SIDE_SCORE", "TWIN_SCORE", "Drawing", "Meeting", "draw_network"]

TWIN_SCORE, FLANGED_SCORE, SIDE_SCORE = 0.99, 0.97, 0.85
"""How sure a joint is that no offer tells (ours): ends in one place, flanged solids, gauges or valves on something."""
_TOUCHING = 0.001  # ends this near touch [m]
_SAME_PLACE = 1e-6  # positions on a branch closer than this are one [m]


@dataclass(frozen=True)
class Meeting:
    """Two solids that are joined to each other.

    Args:
        point: ``(3,)`` where [m].
        gap: between them [m].
        score: how sure that is, 0..1.
        why: what speaks for it.
    """

    point: Floats
    gap: float
    score: float
    why: str


@dataclass(frozen=True)
class Drawing:
    """The network as drawn.

    Args:
        net: spans between nodes; the first nodes are the units, by number.
        openings: of each unit.
        ends: rows of the free ends that lie at a node.
        taps: nodes where something sits on the side of a line.
        solids: nodes that are a connector without a line, and which part.
        bridged: parts on both sides of each bridged gap, and the gap [m].
        met: pairs of solids that are joined without a line between, and how.
        standing: places of units on the sides of lines, by number of the unit.
        by_user: pairs of solids that a user joined, and the two ends of the gap between them [m].
    """

    net: Net
    openings: tuple[tuple[Opening, ...], ...]
    ends: Mapping[int, tuple[int, ...]]
    taps: frozenset[int]
    solids: Mapping[int, int]
    bridged: tuple[tuple[int, int, float], ...]
    met: Mapping[tuple[int, int], Meeting] = field(default_factory=dict)
    standing: Mapping[int, Side] = field(default_factory=dict)
    by_user: Mapping[tuple[int, int], Floats] = field(default_factory=dict)


@dataclass
class _Draft:
    """The network while it is drawn: nodes may still turn out to be one."""

    lines: Mapping[int, Centreline]
    found: Attachments
    owner: Mapping[int, int]
    n_nodes: int
    joints: list[tuple[int, int, float]] = field(default_factory=list)
    spans: list[Span] = field(default_factory=list)
    openings: list[list[Opening]] = field(default_factory=list)
    node_of_end: dict[int, int] = field(default_factory=dict)
    node_of_solid: dict[int, int] = field(default_factory=dict)
    places: dict[tuple[int, int], list[tuple[float, int, Floats]]] = field(default_factory=dict)
    taps: list[int] = field(default_factory=list)
    bridged: list[tuple[int, int, float]] = field(default_factory=list)

    def new(self) -> int:
        self.n_nodes += 1
        return self.n_nodes - 1

    def join(self, a: int, b: int, confidence: float) -> None:
        """Says that two nodes are one, and how sure that is."""
        self.joints.append((a, b, confidence))

    def open(self, unit: int, point: Floats, outward: Floats | None, diameter: float | None) -> int:
        """Adds an opening to a unit and returns its number there."""
        x, y, z = (float(v) for v in point)
        direction = None if outward is None else (float(outward[0]), float(outward[1]), float(outward[2]))
        self.openings[unit].append(Opening((x, y, z), direction, diameter))
        return len(self.openings[unit]) - 1


def draw_network(
    lines: Mapping[int, Centreline],
    solids: Sequence[int],
    units: Sequence[UnitParts],
    found: Attachments,
    met: Mapping[tuple[int, int], Meeting],
    standing: Mapping[int, Side],
    sure: Callable[[int], float],
    bridged: Mapping[tuple[int, int], Floats] = MappingProxyType({}),
) -> Drawing:
    """Draws the spans between units, joints, junctions and taps.

    Args:
        lines: of the connector parts, without those that are in units.
        solids: connector parts without a line.
        units: with their parts.
        found: what joins what.
        met: pairs of solids that are joined without a line between, and how.
        standing: places of units on the sides of lines, by number of the unit.
        sure: how sure it is that a part is a connector.
        bridged: pairs of solids that a user joined across a gap, and the two ends of it, ``(2, 3)`` [m].
    """
    owner = owners_of(units)
    draft = _Draft(lines, found, owner, len(units), openings=[[] for _ in units])
    draft.node_of_solid = {part: draft.new() for part in solids if part not in owner}
    for row, part in enumerate(found.ends.part.tolist()):
        if part in lines:
            draft.node_of_end[row] = draft.new()
    _join_ends(draft)
    _place_taps(draft)
    _place_standing(draft, standing)
    for part in sorted(lines):
        _draw_line(draft, part, sure(part))
    _draw_mounts(draft)
    _draw_solids(draft, {pair: (how.point[None], how.score) for pair, how in met.items()})
    _draw_solids(draft, {pair: (way, 1.0) for pair, way in bridged.items()})
    return replace(_finish(draft), met=met, standing=standing, by_user=bridged)


def _join_ends(draft: _Draft) -> None:
    nodes, ends = draft.node_of_end, draft.found.ends
    for facing in draft.found.facings:
        if facing.first in nodes and facing.second in nodes:
            gapped = facing.gap > _TOUCHING
            draft.join(nodes[facing.first], nodes[facing.second], facing.score)
            if gapped:
                draft.bridged.append((int(ends.part[facing.first]), int(ends.part[facing.second]), facing.gap))
    for row, twin in draft.found.doubled:
        if row in nodes and twin in nodes:
            draft.join(nodes[row], nodes[twin], TWIN_SCORE)


def _place_taps(draft: _Draft) -> None:
    """The nodes on each branch between its ends."""
    for tapped in draft.found.taps:
        if tapped.row in draft.node_of_end and tapped.part in draft.lines:
            here, tap, tip = draft.new(), tapped.tap, draft.node_of_end[tapped.row]
            if tapped.apart:
                way = np.stack([draft.found.ends.point[tapped.row], tap.point])
                draft.spans.append(Span(tip, here, (), way, max(0.0, tap.gap), (), tapped.score))
            else:
                draft.join(here, tip, tapped.score)
            draft.places.setdefault((tapped.part, tap.branch), []).append((tap.s, here, tap.point))
            draft.taps.append(here)


def _place_standing(draft: _Draft, standing: Mapping[int, Side]) -> None:
    """A gauge or a valve that no end leads to hangs on the side of a line."""
    for unit, side in standing.items():
        here = draft.new()
        draft.places.setdefault((side.part, side.tap.branch), []).append((side.tap.s, here, side.tap.point))
        draft.taps.append(here)
        port = draft.open(unit, side.tap.point, None, None)
        draft.spans.append(Span(here, unit, (), side.tap.point[None], 0.0, (), SIDE_SCORE, -1, port))


def _draw_line(draft: _Draft, part: int, sure: float) -> None:
    """Spans along each branch, from end or junction to end or junction, cut where something sits on it."""
    line = draft.lines[part]
    tips: dict[tuple[int, bool], int] = {}
    for row in draft.found.ends.of_part.get(part, ()):
        number, tip = line.branch_of_end[int(draft.found.ends.index[row])], draft.found.ends.point[row]
        points = line.branches[number].points
        at_start = length_of(points[0] - tip) <= length_of(points[-1] - tip)
        tips[number, at_start] = draft.node_of_end[row]
    for junction in line.junctions:
        node = draft.new()
        for number in set(junction.branches):
            points = line.branches[number].points
            for at_start, point in ((True, points[0]), (False, points[-1])):
                if length_of(point - junction.point) < 1e-6:
                    tips[number, at_start] = node
    short = is_disc(line)
    for number, branch in enumerate(line.branches):
        start = tips.get((number, True))
        start = draft.new() if start is None else start
        stop = start if branch.closed else tips.get((number, False))
        stop = draft.new() if stop is None else stop
        _draw_branch(draft, part, number, branch, (start, stop), short, sure)


def _draw_branch(
    draft: _Draft, part: int, number: int, branch: Branch, tips: tuple[int, int], short: bool, sure: float
) -> None:
    length = branch.length
    stops = [(0.0, tips[0], branch.points[0])]
    for s, node, point in sorted(draft.places.get((part, number), ()), key=lambda place: place[:2]):
        if s <= _SAME_PLACE:
            draft.join(tips[0], node, 1.0)
        elif s >= length - _SAME_PLACE:
            draft.join(tips[1], node, 1.0)
        else:
            stops.append((s, node, point))
    stops.append((length, tips[1], branch.points[-1]))
    if len(stops) == 2 and len(branch.points) == 2:
        pieces = () if short else _pieces(branch, np.array([0.0, length]), 0.0, length)
        draft.spans.append(Span(*tips, (part,), branch.points, length, pieces, sure))
        return
    walked = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(branch.points, axis=0), axis=1))])
    for (low, a, p), (high, b, q) in zip(stops[:-1], stops[1:], strict=True):
        between = branch.points[(walked > low + _SAME_PLACE) & (walked < high - _SAME_PLACE)]
        pieces = () if short else _pieces(branch, walked, low, high)
        points = np.concatenate([p[None], between, q[None]])
        draft.spans.append(Span(a, b, (part,), points, high - low, pieces, sure))


def _pieces(branch: Branch, walked: Floats, low: float, high: float) -> tuple[tuple[float, float, float], ...]:
    """Length, outer diameter and bore of each stretch of one size."""
    found: list[tuple[float, float, float]] = []
    for k in range(len(walked) - 1):
        length = min(high, float(walked[k + 1])) - max(low, float(walked[k]))
        outer = float(branch.radius[k] + branch.radius[k + 1])
        # A stretch that tapers has no size of its own.
        if length <= 0 or abs(float(branch.radius[k] - branch.radius[k + 1])) > 0.05 * outer:
            continue
        bore = float(branch.bore[k] + branch.bore[k + 1])
        if found and abs(found[-1][1] - outer) <= 0.02 * outer:
            found[-1] = (found[-1][0] + length, found[-1][1], found[-1][2])
        else:
            found.append((length, outer, bore))
    return tuple(found)


def _draw_mounts(draft: _Draft) -> None:
    """Spans without length between an end and the unit or solid that it is at."""
    ends = draft.found.ends
    for mount in draft.found.mounts:
        here = draft.node_of_end.get(mount.row)
        if here is None:
            continue
        point, diameter = ends.point[mount.row], 2 * float(ends.radius[mount.row])
        sure = mount.score
        if mount.part in draft.owner:
            unit = draft.owner[mount.part]
            way = point[None] if mount.at is None else np.stack([point, mount.at])
            port = draft.open(unit, way[-1], -ends.direction[mount.row], diameter)
            length = float(np.linalg.norm(way[-1] - point))
            draft.spans.append(Span(here, unit, (), way, length, (), sure, -1, port))
        elif mount.part in draft.node_of_solid:
            node = draft.node_of_solid[mount.part]
            draft.spans.append(Span(here, node, (mount.part,), point[None], 0.0, (), sure))


def _draw_solids(draft: _Draft, joined: Mapping[tuple[int, int], tuple[Floats, float]]) -> None:
    """Spans between solids that are joined to each other, by the way between them: one point, or two."""
    for (a, b), (way, sure) in sorted(joined.items(), key=lambda item: item[0]):
        first = draft.owner.get(a, draft.node_of_solid.get(a))
        second = draft.owner.get(b, draft.node_of_solid.get(b))
        if first is None or second is None or first == second:
            continue
        ports = [
            draft.open(node, point, None, None) if part in draft.owner else -1
            for part, node, point in ((a, first, way[0]), (b, second, way[-1]))
        ]
        length = float(np.linalg.norm(way[-1] - way[0]))
        draft.spans.append(Span(first, second, (), way, length, (), sure, ports[0], ports[1]))


def _finish(draft: _Draft) -> Drawing:
    """The network with every joint as one node."""
    node_of = first_of_component(draft.n_nodes, [(a, b) for a, b, _ in draft.joints]).tolist()
    ends: dict[int, list[int]] = {}
    for row, node in sorted(draft.node_of_end.items()):
        ends.setdefault(node_of[node], []).append(row)
    return Drawing(
        net=_net_of(draft, node_of),
        openings=tuple(tuple(found) for found in draft.openings),
        ends={node: tuple(rows) for node, rows in ends.items()},
        taps=frozenset(node_of[node] for node in draft.taps),
        solids={node_of[node]: part for part, node in draft.node_of_solid.items()},
        bridged=tuple(draft.bridged),
    )


def _net_of(draft: _Draft, node_of: Sequence[int]) -> Net:
    """The spans between joints, each no surer than what joins them."""
    sure_of = [1.0] * draft.n_nodes
    for a, _, confidence in draft.joints:
        sure_of[node_of[a]] = min(sure_of[node_of[a]], confidence)
    net = Net()
    for span in draft.spans:
        a, b = node_of[span.a], node_of[span.b]
        sure = min(span.confidence, sure_of[a], sure_of[b])
        if a != b or span.length > 0.05:
            net.add(span._replace(a=a, b=b, confidence=sure))
    return net
