"""Following the pipes: what lies downstream or upstream of a unit, and the way from one to another."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from cadgraph._io.text import tag_key
from cadgraph.model.graph import SceneGraph
from cadgraph.model.pipework import Direction, Follow, check_direction
from cadgraph.model.records import Terminal
from cadgraph.query.doubt import Doubt, open_sides, unshown
from cadgraph.query.lines import find_lines
from cadgraph.query.network import Arc, Flow, Network

__all__ = ["Direction", "Halt", "Return", "Step", "Trace", "find_way", "trace"]


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
        aside: whether it is a valve on the side of the run, which what flows passes by.
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
    aside: bool = False


@dataclass(frozen=True)
class Halt:
    """A connection that was not followed, because nobody knows which way it flows.

    Args:
        after: tag of the node where the way halts.
        towards: tag of the node that would be next.
        line: tag of the line that leads there.
        distance: of the halt from the start [m].
        place: id of the node where the way halts.
        connection: number of the graph's connection that was not followed.
    """

    after: str
    towards: str
    line: str | None
    distance: float
    place: str
    connection: int


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
        doubts: where more may follow than was found: units with fewer lines than their kind needs, and joints on the
            way that were not made although much speaks for them. Empty where the answer is whole.
        connections: numbers of the graph's connections that were followed.
    """

    start: str
    direction: Direction | None
    steps: tuple[Step, ...]
    halts: tuple[Halt, ...] = ()
    returns: tuple[Return, ...] = ()
    doubts: tuple[Doubt, ...] = ()
    connections: tuple[int, ...] = ()


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
        Unconnected: no line was found at the node, which is a ``ValueError``: that is no answer.
        ValueError: nothing is called so, or no such direction.
    """
    network = graph if isinstance(graph, Network) else Network(graph)
    check_direction(direction)
    first = network.find(start)
    if not network.arcs(first):
        raise network.unconnected(first, f"what lies {direction} of it")
    follows = network.follower(direction, through_unknown)
    distances, arcs_to = network.shortest(first, follows)
    line_of = _line_of(network)
    order = sorted(distances, key=lambda p: (distances[p], len(arcs_to[p]), tag_key(network.name(p))))
    steps: list[Step] = []
    halts: list[Halt] = []
    for place in order:
        arcs = arcs_to[place]
        met = [
            Halt(
                after=network.name(place),
                towards=network.name(arc.end),
                line=line_of.get(arc.index),
                distance=distances[place],
                place=place,
                connection=arc.index,
            )
            for arc in network.arcs(place)
            if not follows(arc) and _is_doubtful(network, arc, arcs)
        ]
        halts += met
        ends = not met and not _goes_on(network, place, arcs, follows)
        steps.append(_step(network, place, arcs, distances[place], line_of, ends))
    returns = tuple(_returns(network, order, arcs_to, follows))
    followed = sorted({arc.index for place in order for arc in network.arcs(place) if follows(arc)})
    doubts = (*unshown(network), *open_sides(network, order))
    return Trace(first, direction, tuple(steps), tuple(halts), returns, doubts, tuple(followed))


def _returns(
    network: Network, order: Sequence[str], arcs_to: dict[str, tuple[Arc, ...]], follows: Follow
) -> Iterator[Return]:
    """Loops, and branches that meet again, in order of distance."""
    walked = {arcs[-1].index for arcs in arcs_to.values() if arcs}
    for place in order:
        # By its number, for a connection from a node to itself leaves it twice.
        back = {arc.index: arc for arc in network.arcs(place) if follows(arc) and arc.index not in walked}
        walked.update(back)
        behind = {order[0], *(arc.end for arc in arcs_to[place])}
        for arc in back.values():
            yield Return(network.name(place), network.name(arc.end), arc.end in behind)


def _is_doubtful(network: Network, arc: Arc, arcs: Sequence[Arc]) -> bool:
    """Whether a connection off the way could carry flow, but nobody knows which way."""
    return arc.flow == "unknown" and not network.is_dead(arc) and arc.index not in {one.index for one in arcs}


def _goes_on(network: Network, place: str, arcs: Sequence[Arc], follows: Follow) -> bool:
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
        The way; without steps where none is known, with what makes that doubtful. Where there would be one were it
        known to flow so through some connections, these are its halts.

    Raises:
        Unconnected: no line was found at one of the two, which is a ``ValueError``: that is no answer.
        ValueError: nothing is called so, or no such direction.
    """
    network = graph if isinstance(graph, Network) else Network(graph)
    check_direction(direction)
    first, last = network.find(start), network.find(end)
    for place in (first, last):
        if not network.arcs(place) and first != last:
            raise network.unconnected(place, f"how {network.name(first)} and {network.name(last)} are connected")
    distances, arcs_to = network.shortest(first, network.follower(direction))
    if last not in arcs_to:
        others, _ = network.shortest(last, network.follower(None))
        halts = _unknown_on_the_way(network, first, last, direction) if direction else ()
        doubts = (*unshown(network), *open_sides(network, [*distances, *others]))
        return Trace(first, direction, (), halts=halts, doubts=doubts)
    line_of = _line_of(network)
    arcs = arcs_to[last]
    steps = [_step(network, first, (), 0.0, line_of, first == last)]
    for number, arc in enumerate(arcs, 1):
        gone = steps[-1].distance + (arc.length or 0.0)
        steps.append(_step(network, arc.end, arcs[:number], gone, line_of, arc.end == last))
    passed = tuple(arc.index for arc in arcs)
    return Trace(first, direction, tuple(steps), doubts=unshown(network), connections=passed)


def _unknown_on_the_way(network: Network, first: str, last: str, direction: Direction) -> tuple[Halt, ...]:
    """The connections of unknown direction on the shortest way that goes against no known flow; none without one."""
    distances, arcs_to = network.shortest(first, network.follower(direction, True))
    line_of = _line_of(network)
    return tuple(
        Halt(
            after=network.name(arc.start),
            towards=network.name(arc.end),
            line=line_of.get(arc.index),
            distance=distances[arc.start],
            place=arc.start,
            connection=arc.index,
        )
        for arc in arcs_to.get(last, ())
        if arc.flow == "unknown"
    )


def _step(
    network: Network, place: str, arcs: Sequence[Arc], distance: float, line_of: dict[int, str], ends: bool
) -> Step:
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
        aside=network.is_valve(place) and network.stands_aside(place),
    )


def _line_of(network: Network) -> dict[int, str]:
    return {arc.index: line.tag for line in find_lines(network) for arc in line.arcs}
