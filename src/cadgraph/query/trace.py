"""Following the pipes: what lies downstream or upstream of a unit, and the way from one to another."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Literal, cast

from cadgraph._io.text import tag_key
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Terminal
from cadgraph.query.lines import find_lines
from cadgraph.query.network import Arc, Flow, Network

if TYPE_CHECKING:
    import networkx

__all__ = ["Direction", "Halt", "Return", "Step", "Trace", "find_way", "trace"]

Direction = Literal["downstream", "upstream"]


@dataclass(frozen=True)
class Step:
    """One node on the way.

    Args:
        place: its id.
        name: its tag.
        what: its kind or type.
        distance: along the pipes from the start [m].
        at_least: whether a part of the distance is unknown, so that it is a lower bound.
        after: the tag of the node before it; None for the start.
        line: tag of the line that leads to it; None for the start and on the way to an instrument.
        flow: whether the way that was walked to it goes along the flow.
        reason: why the flow goes so, where that is known.
        tap: whether it is an instrument (or its root valve) beside the way.
        ends: whether the way ends here.
    """

    place: str
    name: str
    what: str
    distance: float
    at_least: bool
    after: str | None
    line: str | None
    flow: Flow
    reason: str | None
    tap: bool
    ends: bool


@dataclass(frozen=True)
class Halt:
    """A connection that was not followed, because nobody knows which way it flows.

    Args:
        after: tag of the node where the way halts.
        towards: tag of the node that would be next.
        line: tag of the line that leads there.
        distance: of the halt from the start [m].
    """

    after: str
    towards: str
    line: str | None
    distance: float


@dataclass(frozen=True)
class Return:
    """A connection that leads to where the way has been already.

    Args:
        after: tag of the node that it leaves.
        to: tag of the node that it comes back to.
        loop: whether that node lies on the way to ``after``, so that the flow goes round; else two branches meet.
    """

    after: str
    to: str
    loop: bool


@dataclass(frozen=True)
class Trace:
    """What was found.

    Args:
        start: id of where it begins.
        direction: which way; None where it was not asked for.
        steps: in order of distance, the start first; for a way from one node to another in order along it. Empty
            where there is no such way.
        halts: where the direction is unknown.
        returns: loops, and branches that meet again.
    """

    start: str
    direction: Direction | None
    steps: tuple[Step, ...]
    halts: tuple[Halt, ...] = ()
    returns: tuple[Return, ...] = ()


def trace(
    graph: SceneGraph | Network, start: str, direction: Direction = "downstream", *, through_unknown: bool = False
) -> Trace:
    """Follows the flow, or goes against it, from a node to all that it reaches.

    Where the direction of a connection is unknown the way halts and says so; with ``through_unknown`` it goes on,
    whichever way that is. Instruments on taps are named at their place.

    Args:
        graph: the finished graph, or its network.
        start: tag or id.
        direction: which way.
        through_unknown: whether to follow connections of unknown direction.

    Raises:
        ValueError: nothing is called so.
    """
    network = graph if isinstance(graph, Network) else Network(graph)
    first = network.find(start)
    follows = _follower(network, direction, through_unknown)
    walkable = _walkable(network, follows)
    distances, ways = _shortest(walkable, first)
    arcs_to = {p: [walkable.edges[a, b]["arc"] for a, b in pairwise(way)] for p, way in ways.items()}
    walked = {arcs[-1].index for arcs in arcs_to.values() if arcs}
    line_of = _line_of(network)
    order = sorted(distances, key=lambda p: (distances[p], len(ways[p]), tag_key(network.name(p))))
    steps: list[Step] = []
    halts: list[Halt] = []
    returns: list[Return] = []
    for place in order:
        arcs, name = arcs_to[place], network.name(place)
        met = [
            Halt(name, network.name(arc.end), line_of.get(arc.index), distances[place])
            for arc in network.arcs(place)
            if not follows(arc) and _is_doubtful(network, arc, arcs)
        ]
        # By its number, for a connection from a node to itself leaves it twice.
        back = {arc.index: arc for arc in network.arcs(place) if follows(arc) and arc.index not in walked}
        walked.update(back)
        returns += [Return(name, network.name(arc.end), arc.end in ways[place]) for arc in back.values()]
        halts += met
        ends = not met and not _goes_on(network, place, arcs, follows)
        steps.append(_step(network, place, arcs, distances[place], line_of, ends))
    return Trace(first, direction, tuple(steps), tuple(halts), tuple(returns))


def _follower(network: Network, direction: Direction, through_unknown: bool) -> Callable[[Arc], bool]:
    """Whether a connection is walked: with the flow, or against it; those of instruments either way."""
    wanted = {"along" if direction == "downstream" else "against", *(("unknown",) if through_unknown else ())}
    return lambda arc: network.is_tap(arc) or arc.flow in wanted


def _is_doubtful(network: Network, arc: Arc, arcs: Sequence[Arc]) -> bool:
    """Whether a connection off the way could carry flow, but nobody knows which way."""
    return arc.flow == "unknown" and not network.is_dead(arc) and arc.index not in {one.index for one in arcs}


def _goes_on(network: Network, place: str, arcs: Sequence[Arc], follows: Callable[[Arc], bool]) -> bool:
    """Whether the way goes on from a node, not back where it came from."""
    return any(follows(arc) and (not arcs or arc.index != arcs[-1].index) for arc in network.main_arcs(place))


def find_way(graph: SceneGraph | Network, start: str, end: str, direction: Direction | None = None) -> Trace:
    """The shortest way along the pipes from one node to another.

    Args:
        graph: the finished graph, or its network.
        start: tag or id.
        end: tag or id.
        direction: go only with the flow (``downstream``) or only against it; None goes both ways.

    Returns:
        The way; without steps where there is none.

    Raises:
        ValueError: nothing is called so.
    """
    import networkx

    network = graph if isinstance(graph, Network) else Network(graph)
    first, last = network.find(start), network.find(end)
    wanted = {"downstream": "along", "upstream": "against"}.get(direction or "")
    walkable = _walkable(network, lambda arc: wanted is None or arc.flow == wanted or network.is_tap(arc))
    try:
        way: list[str] = networkx.dijkstra_path(walkable, first, last, weight="weight")
    except networkx.NetworkXNoPath:
        return Trace(first, direction, ())
    line_of = _line_of(network)
    steps, gone = [_step(network, first, [], 0.0, line_of, first == last)], 0.0
    arcs: list[Arc] = []
    for a, b in pairwise(way):
        arcs.append(walkable.edges[a, b]["arc"])
        gone += arcs[-1].length or 0.0
        steps.append(_step(network, b, arcs, gone, line_of, b == last))
    return Trace(first, direction, tuple(steps))


def _walkable(network: Network, follows: Callable[[Arc], bool]) -> networkx.DiGraph[str]:
    """What may be walked, with the shortest of parallel connections; an unknown length counts as none."""
    import networkx

    walkable: networkx.DiGraph[str] = networkx.DiGraph()
    walkable.add_nodes_from(network.places)
    for place in network.places:
        for arc in network.arcs(place):
            if not follows(arc):
                continue
            weight = arc.length or 0.0
            if not walkable.has_edge(arc.start, arc.end) or walkable.edges[arc.start, arc.end]["weight"] > weight:
                walkable.add_edge(arc.start, arc.end, weight=weight, arc=arc)
    return walkable


def _shortest(walkable: networkx.DiGraph[str], start: str) -> tuple[dict[str, float], dict[str, list[str]]]:
    """Distance [m] of and way to everything that can be reached."""
    import networkx

    found = networkx.single_source_dijkstra(walkable, start, weight="weight")
    return cast("tuple[dict[str, float], dict[str, list[str]]]", found)


def _step(network: Network, place: str, arcs: list[Arc], distance: float, line_of: dict[int, str], ends: bool) -> Step:
    last = arcs[-1] if arcs else None
    return Step(
        place=place,
        name=network.name(place),
        what=network.what(place),
        distance=distance,
        at_least=any(arc.length is None for arc in arcs),
        after=network.name(last.start) if last else None,
        line=line_of.get(last.index) if last else None,
        flow=last.flow if last else "unknown",
        reason=last.edge.reason if last else None,
        tap=last is not None and network.is_tap(last),
        ends=ends or isinstance(network.places[place], Terminal),
    )


def _line_of(network: Network) -> dict[int, str]:
    return {arc.index: line.tag for line in find_lines(network) for arc in line.arcs}
