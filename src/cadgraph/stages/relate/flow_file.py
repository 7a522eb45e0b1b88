"""Flow directions that the file states, and what becomes of them beside what geometry shows."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

from cadgraph.model.facts import StatedLink
from cadgraph.model.parts import Network
from cadgraph.stages.relate.flow_spread import Evidence, Flows, idle_links, spread
from cadgraph.stages.relate.stated import Stated

__all__ = ["Weighed", "file_flow", "is_of_file", "weigh_flow"]

_PREFIX = "stated in the file: "
# Ports of IFC say source or sink by themselves; the order of elements in a branch is the nominal flow, and so are the
# references to what is at its head and tail.
_OF_PORTS, _NOMINAL = 0.9, 0.8
# Of several links along one run so many must say the same.
_MAJORITY = 2 / 3
# From here on evidence is construction or physics, which no file turns round.
_CONSTRUCTION = 0.85
# Two elements that the file joins have at most so many others between them along a run: gaskets, flanges.
_BETWEEN = 3
# Rounds in which statements that are contradicted are left out; those that are left then count for nothing.
_MOST_ROUNDS = 20

_Doubt = tuple[Evidence, Evidence]


@dataclass(frozen=True)
class Weighed:
    """What is known of the flow with what the file says.

    Args:
        flows: of each link.
        disagreeing: pairs of reasons of which one at least is the file's.
    """

    flows: Flows
    disagreeing: tuple[_Doubt, ...] = ()


def is_of_file(evidence: Evidence) -> bool:
    """Whether it is the file that says so, or another one that follows from that."""
    return evidence.reason.startswith(_PREFIX)


def file_flow(network: Network, stated: Stated) -> tuple[list[Evidence], list[_Doubt]]:
    """What the file says about the flow of each link, by most of its own links along it.

    Args:
        network: units and links.
        stated: what the file says is joined.

    Returns:
        The evidence, and pairs that contradict each other along one link.
    """
    found: list[Evidence] = []
    doubts: list[_Doubt] = []
    votes = _votes(network, stated)
    # A branch of a file may begin or end at a closed end: that is the order of its elements, and no flow.
    closed = idle_links(network).dead if votes else frozenset()
    for number, cast in sorted((number, cast) for number, cast in votes.items() if number not in closed):
        said = [one for sense in (True, False) for one in _evidence(number, sense, cast)]
        said.sort(key=lambda one: -one.confidence)
        doubts += [(said[0], said[1])] if len(said) == 2 else []
        agreeing = sum(way == said[0].forward for way, _ in cast)
        found += said[:1] if agreeing >= _MAJORITY * len(cast) else []
    return found, doubts


def _votes(network: Network, stated: Stated) -> dict[int, list[tuple[bool, StatedLink]]]:
    """For each link of the network what the file's links along it say: whether it flows forward."""
    places = _Places(network)
    votes: dict[int, list[tuple[bool, StatedLink]]] = {}
    for join in stated.usable:
        if join.link.flow != "unknown":
            ends = (join.first, join.second) if join.link.flow == "forward" else (join.second, join.first)
            for number, forward in places.senses(*ends):
                votes.setdefault(number, []).append((forward, join.link))
    return votes


def _evidence(number: int, forward: bool, cast: Sequence[tuple[bool, StatedLink]]) -> Iterator[Evidence]:
    """What those of the file's links along one link of the network say together that say one sense; nothing of none."""
    links = [link for way, link in cast if way == forward]
    if not links:
        return
    first = max(links, key=_trust)
    ends = (first.first, first.second) if first.flow == "forward" else (first.second, first.first)
    more = f", and {len(links) - 1} more" if len(links) > 1 else ""
    reason = f"{_PREFIX}{ends[0]} -> {ends[1]} ({first.where or 'a link'}{more})"
    yield Evidence(number, forward, _trust(first) * len(links) / len(cast), reason)


def _trust(link: StatedLink) -> float:
    return _OF_PORTS if link.where.startswith("Ifc") else _NOMINAL


class _Places:
    """Where along the links of a network each part lies: before the first part, at one of them, behind the last."""

    def __init__(self, network: Network) -> None:
        self._at: dict[int, dict[int, set[int]]] = {}
        nodes: list[Sequence[int]] = [unit.parts for unit in network.units]
        nodes += [place.parts for place in network.places]
        self._inner: set[tuple[int, int]] = set()
        for number, link in enumerate(network.links):
            for place, part in enumerate(link.via):
                self._put(part, number, place)
                self._inner.add((part, number))
            if link.source != link.target:
                self._put_node(nodes[link.source], number, -1)
                self._put_node(nodes[link.target], number, len(link.via))

    def _put(self, part: int, number: int, place: int) -> None:
        self._at.setdefault(part, {}).setdefault(number, set()).add(place)

    def _put_node(self, parts: Sequence[int], number: int, place: int) -> None:
        for part in parts:
            if (part, number) not in self._inner:
                self._put(part, number, place)

    def senses(self, first: Collection[int], second: Collection[int]) -> Iterator[tuple[int, bool]]:
        """The links on which both of two places lie near each other, and whether the first lies before the second."""
        here, there = self._of(first), self._of(second)
        shared = [number for number in here if number in there]
        found = [(number, _sense(here[number], there[number])) for number in shared]
        senses = [(number, sense) for number, sense in found if sense is not None]
        # Of two pipes between the same two nobody can say which one is meant.
        if len(senses) == 1:
            yield senses[0]

    def _of(self, parts: Collection[int]) -> Mapping[int, set[int]]:
        found: dict[int, set[int]] = {}
        for part in parts:
            for number, places in self._at.get(part, {}).items():
                found.setdefault(number, set()).update(places)
        return found


def _sense(first: set[int], second: set[int]) -> bool | None:
    """Whether some places along a link come before some others; None where they mix or are far apart."""
    if max(first) < min(second):
        return True if min(second) - max(first) <= _BETWEEN + 1 else None
    if max(second) < min(first):
        return False if min(first) - max(second) <= _BETWEEN + 1 else None
    return None


def weigh_flow(
    network: Network, given: Sequence[Evidence], shown: Sequence[Evidence], filed: Sequence[Evidence]
) -> Weighed:
    """Carries directions on, with what the file says: below what the user says and construction shows, above guesses.

    Args:
        network: units and links.
        given: what the user says.
        shown: what geometry shows.
        filed: what the file says.
    """
    if not filed:
        return Weighed(spread(network, [*given, *shown]))
    firm = [*given, *(one for one in shown if one.confidence >= _CONSTRUCTION)]
    agreeing, first = _without_doubted(network, firm, filed)
    overruled = _overruled(shown, spread(network, [*firm, *agreeing]))
    dropped = {id(one) for _, one in overruled}
    held = [*given, *(one for one in shown if id(one) not in dropped)]
    agreeing, second = _without_doubted(network, held, agreeing)
    return Weighed(spread(network, [*held, *agreeing]), (*first, *overruled, *second))


def _overruled(shown: Sequence[Evidence], known: Flows) -> list[_Doubt]:
    """The guesses of geometry that contradict what follows from the file."""
    guesses = [one for one in shown if one.confidence < _CONSTRUCTION and one.link in known.chosen]
    pairs = [(known.chosen[one.link], one) for one in guesses]
    return [(held, one) for held, one in pairs if is_of_file(held) and held.forward != one.forward]


def _without_doubted(
    network: Network, others: Sequence[Evidence], filed: Sequence[Evidence]
) -> tuple[list[Evidence], list[_Doubt]]:
    """What the file says without what contradicts the others, or itself; and the contradictions."""
    left = list(filed)
    doubts: list[_Doubt] = []
    for _ in range(_MOST_ROUNDS):
        against = [pair for pair in spread(network, [*others, *left]).against if any(map(is_of_file, pair))]
        if not against:
            return left, doubts
        doubts += against
        reasons = {one.reason for pair in against for one in pair}
        left = [one for one in left if one.reason not in reasons]
    return [], doubts
