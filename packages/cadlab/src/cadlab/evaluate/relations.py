"""Functional relations: which units follow each other along the runs, in which direction, and where runs end open."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from cadgraph._io.text import natural_key
from cadgraph.model.records import Connected, Junction, Related, Terminal
from cadlab.evaluate.pairing import Pairing
from cadlab.evaluate.scores import Score, share
from cadlab.evaluate.units import UnitMatch

__all__ = [
    "DirectionScores",
    "EdgeVerdict",
    "EndVerdict",
    "ReasonScores",
    "RelationScores",
    "UnitGraph",
    "compare_edges",
    "compare_ends",
    "contract",
    "predicted_graph",
    "score_relations",
    "true_graph",
]

Pair = tuple[str, str]


@dataclass(frozen=True)
class UnitGraph:
    """A functional graph with its junctions contracted: units are adjacent where a way over junctions alone joins them.

    Args:
        directions: of each adjacent pair, its first unit below its second: ``forward`` (first to second) or
            ``backward`` where every edge of some way, and of none the other way round, says so; else ``unknown``.
        open_ends: how many terminals each unit reaches over junctions alone, where it reaches any.
    """

    directions: Mapping[Pair, str]
    open_ends: Mapping[str, int]


@dataclass(frozen=True)
class EdgeVerdict:
    """One pair of adjacent units, of the truth, of the graph or of both.

    Args:
        source: tag of the true unit, or None for a predicted unit that stands for none.
        target: likewise.
        found_source: tag of the predicted unit, or None for a true unit that none stands for.
        found_target: likewise.
        in_truth: the truth has it.
        in_graph: the graph has it.
        structures: the true clusters that its ends are in.
        true_direction: of the flow, forward from source to target.
        direction: predicted likewise.
        reason: why the true direction is that, or None.
    """

    source: str | None
    target: str | None
    found_source: str | None
    found_target: str | None
    in_truth: bool
    in_graph: bool
    structures: tuple[str, ...]
    true_direction: str
    direction: str
    reason: str | None = None

    @property
    def matched(self) -> bool:
        """Both ends are units of the truth as well as of the graph."""
        return None not in (self.source, self.target, self.found_source, self.found_target)


@dataclass(frozen=True)
class EndVerdict:
    """The ends of lines next to one unit.

    Args:
        unit: tag of the true unit, else of the predicted one.
        structure: the true cluster.
        n_true: terminals that it reaches in the truth.
        n_predicted: terminals that it reaches in the graph.
        n_correct: the lesser of both, 0 where the unit is not in both; open and blind ends each for themselves where
            the truth says which they are.
    """

    unit: str
    structure: str | None
    n_true: int
    n_predicted: int
    n_correct: int


@dataclass(frozen=True)
class DirectionScores:
    """Flow directions of the edges that are in the truth and in the graph.

    Args:
        n_known: edges of which the truth knows the direction.
        n_decided: of which the graph says one, too.
        n_right: of which both agree.
        n_invented: edges with a direction in the graph that the truth doesn't know.
    """

    n_known: int
    n_decided: int
    n_right: int
    n_invented: int

    @property
    def decided(self) -> float | None:
        """The decided share of the known."""
        return share(self.n_decided, self.n_known)

    @property
    def accuracy(self) -> float | None:
        """The right share of the decided."""
        return share(self.n_right, self.n_decided)

    @property
    def wrong(self) -> float | None:
        """The wrong share of the known."""
        return share(self.n_decided - self.n_right, self.n_known)


@dataclass(frozen=True)
class ReasonScores(DirectionScores):
    """Flow directions that one reason fixes.

    Args:
        reason: as the truth says it.
    """

    reason: str = ""


@dataclass(frozen=True)
class RelationScores:
    """One kind of functional edges.

    Args:
        kind: ``"connected"`` or ``"related"``.
        edges: all pairs of adjacent units; one with a spurious unit is extra, one with a missed unit is missing.
        between_matched: only pairs of units that are in both.
        terminals: open ends, counted by the unit they are next to; None for ``related``.
        direction: None for ``related``.
        reasons: the same for each reason that fixes a direction in the truth.
        present: whether the graph has any such edge at all; where it has none it was most likely not asked for them.
        missing: edges that only the truth has.
        extra: edges that only the graph has.
    """

    kind: str
    edges: Score
    between_matched: Score
    terminals: Score | None
    direction: DirectionScores | None
    missing: tuple[EdgeVerdict, ...]
    extra: tuple[EdgeVerdict, ...]
    reasons: tuple[ReasonScores, ...] = ()
    present: bool = True


def contract(
    edges: Iterable[tuple[str, str, str]], units: Iterable[str], junctions: Iterable[str], terminals: Iterable[str]
) -> UnitGraph:
    """Contracts the junctions of a functional graph.

    Args:
        edges: source, target, direction (``forward``, ``backward``, ``unknown``).
        units: ids.
        junctions: ids; ways lead through these alone.
        terminals: ids.
    """
    ways: dict[str, list[str]] = {}
    downstream: dict[str, list[str]] = {}
    for source, target, direction in edges:
        ways.setdefault(source, []).append(target)
        ways.setdefault(target, []).append(source)
        if direction != "unknown":
            first, last = (source, target) if direction == "forward" else (target, source)
            downstream.setdefault(first, []).append(last)
    through, ends, known = set(junctions), set(terminals), set(units)
    near = {unit: _reached(unit, ways, through) for unit in sorted(known)}
    below = {unit: _reached(unit, downstream, through) & known for unit in known}
    directions = {}
    for unit, others in near.items():
        for other in others & known:
            if unit < other:
                forth, back = other in below[unit], unit in below[other]
                directions[unit, other] = "unknown" if forth == back else "forward" if forth else "backward"
    return UnitGraph(directions, {unit: n for unit, others in near.items() if (n := len(others & ends))})


def compare_edges(pairing: Pairing, match: UnitMatch, kind: str) -> tuple[EdgeVerdict, ...]:
    """Lays the true and the predicted pairs of adjacent units over each other.

    Args:
        pairing: graph and truth.
        match: which predicted unit stands for which true one.
        kind: ``"connected"`` or ``"related"``; the truth is the same for both.
    """
    true = true_graph(pairing).directions
    reasons = _reasons(pairing)
    predicted: dict[Pair, str] = {}
    tag, structure = _names(pairing, match)
    for (a, b), direction in predicted_graph(pairing, kind).directions.items():
        one, other = match.true_of.get(a, _stray(a)), match.true_of.get(b, _stray(b))
        predicted[min(one, other), max(one, other)] = direction if one < other else _REVERSE[direction]
    found = []
    for pair in {*true, *predicted}:
        (source, found_source), (target, found_target) = tag[pair[0]], tag[pair[1]]
        verdict = EdgeVerdict(
            source=source,
            target=target,
            found_source=found_source,
            found_target=found_target,
            in_truth=pair in true,
            in_graph=pair in predicted,
            structures=tuple(sorted({here for end in pair if (here := structure[end]) is not None})),
            true_direction=true.get(pair, "unknown"),
            direction=predicted.get(pair, "unknown"),
            reason=reasons.get(pair),
        )
        found.append(_upright(verdict))
    return tuple(sorted(found, key=_edge_key))


def compare_ends(pairing: Pairing, match: UnitMatch) -> tuple[EndVerdict, ...]:
    """Counts the ends of lines next to each unit on both sides."""
    true = true_graph(pairing).open_ends
    predicted = _predicted_ends(pairing, match)
    correct: Counter[str] = Counter()
    told = all(point.end for point in pairing.truth.points if point.kind == "terminal")
    for end in ("open", "blind") if told else (None,):
        here = predicted if end is None else _predicted_ends(pairing, match, end)
        for unit, n in true_graph(pairing, end).open_ends.items():
            correct[unit] += min(n, here[unit])
    tag, structure = _names(pairing, match)
    verdicts = [
        EndVerdict(
            unit=tag[unit][0] or str(tag[unit][1]),
            structure=structure[unit],
            n_true=true.get(unit, 0),
            n_predicted=predicted[unit],
            n_correct=correct[unit],
        )
        for unit in {*true, *predicted}
    ]
    return tuple(sorted(verdicts, key=lambda verdict: (natural_key(verdict.unit), verdict.n_true)))


def _predicted_ends(pairing: Pairing, match: UnitMatch, end: str | None = None) -> Counter[str]:
    """How many terminals each unit reaches in the graph, by what it stands for; only those of a kind, if given."""
    found: Counter[str] = Counter()
    for unit, n in predicted_graph(pairing, "connected", end).open_ends.items():
        found[match.true_of.get(unit, _stray(unit))] += n
    return found


def score_relations(
    kind: str, edges: Sequence[EdgeVerdict], ends: Sequence[EndVerdict], *, present: bool = True
) -> RelationScores:
    """Counts edges and open ends; for ``related`` there are neither ends nor directions.

    Args:
        kind: of edges.
        edges: to count.
        ends: to count.
        present: whether the graph has any such edge, here or elsewhere.
    """
    scores = RelationScores(
        kind=kind,
        edges=_score(edges),
        between_matched=_score([edge for edge in edges if edge.matched]),
        terminals=None,
        direction=None,
        missing=tuple(edge for edge in edges if not edge.in_graph),
        extra=tuple(edge for edge in edges if not edge.in_truth),
        reasons=(),
        present=present,
    )
    if kind != "connected":
        return scores
    both = [edge for edge in edges if edge.in_truth and edge.in_graph]
    return replace(
        scores,
        terminals=_score_ends(ends),
        direction=DirectionScores(**_directions(both)),
        reasons=_score_reasons(both),
    )


def _score_ends(ends: Sequence[EndVerdict]) -> Score:
    return Score(
        sum(end.n_true for end in ends), sum(end.n_predicted for end in ends), sum(end.n_correct for end in ends)
    )


def _score_reasons(edges: Sequence[EdgeVerdict]) -> tuple[ReasonScores, ...]:
    """Directions by what fixes them, of edges that are in truth and graph."""
    by_reason: dict[str, list[EdgeVerdict]] = {}
    for edge in edges:
        if edge.reason:
            by_reason.setdefault(edge.reason, []).append(edge)
    return tuple(ReasonScores(**_directions(some), reason=reason) for reason, some in sorted(by_reason.items()))


def _directions(edges: Sequence[EdgeVerdict]) -> dict[str, int]:
    """The counts of ``DirectionScores`` over edges that are in truth and graph."""
    known = [edge for edge in edges if edge.true_direction != "unknown"]
    decided = [edge for edge in known if edge.direction != "unknown"]
    return {
        "n_known": len(known),
        "n_decided": len(decided),
        "n_right": sum(edge.direction == edge.true_direction for edge in decided),
        "n_invented": sum(edge.true_direction == "unknown" != edge.direction for edge in edges),
    }


_REVERSE = {"forward": "backward", "backward": "forward", "unknown": "unknown"}


def _reached(start: str, ways: Mapping[str, Sequence[str]], through: set[str]) -> set[str]:
    """What can be reached over junctions alone, the start itself apart."""
    seen, front = {start}, [start]
    while front:
        for there in ways.get(front.pop(), ()):
            if there not in seen:
                seen.add(there)
                if there in through:
                    front.append(there)
    return seen - {start}


def true_graph(pairing: Pairing, end: str | None = None) -> UnitGraph:
    """The truth's functional graph; with ``open`` or ``blind`` its terminals are only those."""
    truth = pairing.truth
    return contract(
        [(c.source, c.target, c.direction) for c in truth.connections or ()],
        [unit.id for unit in truth.units or ()],
        [point.id for point in truth.points if point.kind == "junction"],
        [point.id for point in truth.points if point.kind == "terminal" and end in (None, point.end)],
    )


def _reasons(pairing: Pairing) -> dict[Pair, str]:
    """Why the direction of a true pair is what it is, where one reason holds along some whole way."""
    truth = pairing.truth
    found: dict[Pair, str] = {}
    for reason in sorted({c.reason for c in truth.connections or () if c.reason}):
        edges = [
            (c.source, c.target, c.direction if c.reason == reason else "unknown") for c in truth.connections or ()
        ]
        graph = contract(
            edges,
            [unit.id for unit in truth.units or ()],
            [point.id for point in truth.points if point.kind == "junction"],
            (),
        )
        found |= {pair: reason for pair, way in graph.directions.items() if way != "unknown" and pair not in found}
    return found


def predicted_graph(pairing: Pairing, kind: str, end: str | None = None) -> UnitGraph:
    """The graph's own functional graph, of the units that hold a mesh of the truth; ``end`` as for the truth's."""
    graph = pairing.graph
    units = {unit.id for unit in graph.units() if any(part in pairing.head for part in unit.parts)}
    if kind == "related":
        edges = [(edge.source, edge.target, "unknown") for edge in graph.of_kind(Related)]
    else:
        edges = [(edge.source, edge.target, edge.direction) for edge in graph.of_kind(Connected)]
    junctions = [node.id for node in graph.of_layer(Junction)]
    ends = [node.id for node in graph.of_layer(Terminal) if end in (None, node.kind)]
    return contract(edges, units, junctions, ends)


def _stray(unit: str) -> str:
    """A key for a predicted unit that stands for no true one; no true id can be the same."""
    return f"\0{unit}"


def _names(
    pairing: Pairing, match: UnitMatch
) -> tuple[dict[str, tuple[str | None, str | None]], dict[str, str | None]]:
    """True and predicted tag, and the structure, of every unit on either side."""
    tag: dict[str, tuple[str | None, str | None]] = {unit.id: (unit.tag, unit.match) for unit in match.true}
    structure = {unit.id: unit.structure for unit in match.true}
    of_predicted = {unit.tag: unit.structure for unit in match.predicted}
    for unit in pairing.graph.units():
        if unit.id not in match.true_of:
            tag[_stray(unit.id)] = (None, unit.tag)
            structure[_stray(unit.id)] = of_predicted.get(unit.tag)
    return tag, structure


def _upright(edge: EdgeVerdict) -> EdgeVerdict:
    """The edge with its ends in the natural order of their tags."""
    first, last = (edge.source, edge.found_source), (edge.target, edge.found_target)
    if _end_key(*first) <= _end_key(*last):
        return edge
    return EdgeVerdict(
        *(last[0], first[0], last[1], first[1]),
        edge.in_truth,
        edge.in_graph,
        edge.structures,
        _REVERSE[edge.true_direction],
        _REVERSE[edge.direction],
        edge.reason,
    )


def _end_key(true: str | None, found: str | None) -> tuple[bool, tuple[tuple[str | int, ...], str]]:
    return true is None, natural_key(true if true is not None else str(found))


def _edge_key(edge: EdgeVerdict) -> tuple[object, ...]:
    return _end_key(edge.source, edge.found_source), _end_key(edge.target, edge.found_target)


def _score(edges: Sequence[EdgeVerdict]) -> Score:
    return Score(
        sum(edge.in_truth for edge in edges),
        sum(edge.in_graph for edge in edges),
        sum(edge.in_truth and edge.in_graph for edge in edges),
    )
