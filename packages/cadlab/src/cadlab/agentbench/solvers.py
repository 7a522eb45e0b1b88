"""Answers that follow from the facts of a plant alone; nothing of the product's own questions is used here.

Every solver takes the facts and names of units and returns a plain value: a number, metres, a list of names, or None
where the facts don't settle it. A set is a list in alphabetical order.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Callable, Collection, Iterable, Sequence
from itertools import combinations

from cadgraph.model.records import Point
from cadlab.agentbench.facts import Fact, Facts, Link
from cadlab.agentbench.people import NO_LEVEL

__all__ = [
    "Section",
    "above",
    "at_height",
    "best_tour",
    "count",
    "cut_off",
    "downstream",
    "facing",
    "fed_by",
    "halts",
    "height",
    "is_clear",
    "is_fed_throughout",
    "isolate",
    "leaks",
    "length",
    "level",
    "nearest",
    "operator_height",
    "order",
    "section",
    "system",
    "tour",
    "tour_length",
    "way",
]

_MOST_VISITS = 10  # the exact tour takes 2^n steps


# Places


def count(facts: Facts, type: str, kind: str = "") -> int:
    """How many units of a type there are, or of one kind of it."""
    return sum(unit.type == type and (not kind or unit.kind == kind) for unit in facts.units)


def height(facts: Facts, a: str, b: str) -> float | None:
    """How much higher the middle of b is than that of a [m]; below 0 where it is lower."""
    here, there = _middle(facts, a), _middle(facts, b)
    return there[2] - here[2] if here and there else None


def nearest(facts: Facts, unit: str, type: str) -> list[str] | None:
    """The unit of a type whose middle is nearest to that of another, as a set of one."""
    here = _middle(facts, unit)
    others = [other for other in facts.units if other.type == type and other.name != unit and other.middle is not None]
    if here is None or not others:
        return None
    return [min(others, key=lambda other: (math.dist(here, other.middle or here), other.name)).name]


def above(facts: Facts, unit: str, among: Sequence[str]) -> list[str] | None:
    """Those of some units whose middle is higher than that of another."""
    middle, others = _middle(facts, unit), {name: _middle(facts, name) for name in among}
    if middle is None or None in others.values():
        return None
    return sorted(name for name, point in others.items() if point is not None and point[2] > middle[2])


def at_height(facts: Facts, names: Iterable[str], highest: bool = True) -> float | None:
    """The height of the middle of the highest or lowest of some units [m]."""
    found = [_middle(facts, name) for name in names]
    heights = [point[2] for point in found if point is not None]
    if not heights or len(heights) < len(found):
        return None
    return max(heights) if highest else min(heights)


def operator_height(facts: Facts, unit: str) -> float | None:
    """How high over the ground the middle of a valve's handwheel or lever is [m]."""
    return facts.reach_of(unit).height


def level(facts: Facts, unit: str) -> float | None:
    """How high over the ground the level is that one must climb to, to work at a valve [m]; None where none serves."""
    found = facts.reach_of(unit).level
    return None if found == NO_LEVEL else found


def facing(facts: Facts, unit: str) -> list[str] | None:
    """The point of the compass that a gauge's face looks towards, as a set of one."""
    found = facts.reach_of(unit).facing
    return None if found is None else [found]


def tour(facts: Facts, stops: Sequence[str]) -> list[str] | None:
    """The shortest round in plan over some units and back to the first."""
    points = [(name, _middle(facts, name)) for name in stops]
    known = [(name, point) for name, point in points if point is not None]
    return best_tour(known) if len(known) == len(points) else None


def best_tour(stops: Sequence[tuple[str, Sequence[float]]]) -> list[str] | None:
    """The shortest round in plan over some places and back to the first (Held and Karp 1962).

    Args:
        stops: name and place [m] of each; at most ten.

    Returns:
        The names in order, the first only at the beginning; None for less than two or more than ten.
    """
    if not 1 < len(stops) <= _MOST_VISITS:
        return None
    plan = [place[:2] for _, place in stops]
    others = range(1, len(plan))
    best: dict[tuple[int, int], tuple[float, tuple[int, ...]]] = {
        (1 << k, k): (math.dist(plan[0], plan[k]), (k,)) for k in others
    }
    for size in range(2, len(plan)):
        for chosen in combinations(others, size):
            bits = sum(1 << k for k in chosen)
            for last in chosen:
                before = (best[bits ^ 1 << last, k] for k in chosen if k != last)
                best[bits, last] = min(
                    (gone + math.dist(plan[way[-1]], plan[last]), (*way, last)) for gone, way in before
                )
    ends = (best[sum(1 << k for k in others), k] for k in others)
    _, found = min((gone + math.dist(plan[way[-1]], plan[0]), way) for gone, way in ends)
    return [stops[0][0], *(stops[k][0] for k in found)]


def tour_length(places: Sequence[Sequence[float]]) -> float:
    """The length in plan of a round over places in order, back to the first [m]."""
    return sum(math.dist(places[k - 1][:2], places[k][:2]) for k in range(len(places)))


# Along the pipes


def way(facts: Facts, a: str, b: str, without: str = "") -> tuple[float, list[str]] | None:
    """The shortest way along the pipes: its length [m] and the nodes in order; None where no length is known.

    Args:
        facts: of the plant.
        a: name of the unit that it starts at.
        b: name of the unit that it leads to.
        without: id of a node that it must not lead over.
    """
    start, goal = facts.id_of(a), facts.id_of(b)
    queue: list[tuple[float, int, str, tuple[str, ...]]] = [(0.0, 0, start, (start,))]
    seen: set[str] = set()
    pushed = 0
    while queue:
        gone, _, node, walked = heapq.heappop(queue)
        if node == goal:
            return gone, list(walked)
        if node in seen:
            continue
        seen.add(node)
        for link in facts.links[node]:
            if link.length is not None and link.end != without:
                pushed += 1
                heapq.heappush(queue, (gone + link.length, pushed, link.end, (*walked, link.end)))
    return None


def length(facts: Facts, a: str, b: str) -> float | None:
    """The length of the shortest way along the pipes [m]."""
    found = way(facts, a, b)
    return found[0] if found else None


def order(facts: Facts, a: str, b: str) -> list[str] | None:
    """What stands on the shortest way from a to b, in order, both included and gauges left out."""
    found = way(facts, a, b)
    units = [facts.nodes[node] for node in found[1]] if found else []
    return [unit.name for unit in units if unit.is_unit and unit.type != "gauge"] or None


def is_clear(facts: Facts, a: str, b: str) -> bool:
    """Whether there is a shortest way, and every other one past its valves and equipment is longer by a margin."""
    found = way(facts, a, b)
    if found is None:
        return False
    between = [node for node in found[1][1:-1] if facts.nodes[node].is_unit and facts.nodes[node].type != "gauge"]
    others = [way(facts, a, b, without=node) for node in between]
    return all(other is None or other[0] > 1.02 * found[0] + 0.1 for other in others)


def system(facts: Facts, unit: str, type: str) -> int:
    """How many units of a type hang together with a unit by pipes, itself included where it is of that type."""
    reached = _reach(facts, [facts.id_of(unit)], lambda node, link: True)
    return sum(facts.nodes[node].type == type for node in reached)


def downstream(facts: Facts, unit: str, type: str) -> list[str]:
    """The units of a type that the flow reaches from a unit, as far as its direction is known."""
    reached = _reach(facts, [facts.id_of(unit)], lambda node, link: link.flow == "along" or link.number in facts.taps)
    return _names(facts, reached - {facts.id_of(unit)}, lambda node: node.type == type)


def fed_by(facts: Facts, unit: str) -> list[str]:
    """The equipment (no valves, no gauges) that the flow to a unit comes from, as far as its direction is known."""
    reached = _reach(facts, [facts.id_of(unit)], lambda node, link: link.flow == "against")
    return _names(facts, reached - {facts.id_of(unit)}, lambda node: node.is_equipment)


def halts(facts: Facts, unit: str, against: bool = False) -> bool:
    """Whether a way with (or against) the flow comes to a connection of unknown direction that may carry flow."""
    wanted = "against" if against else "along"
    reached = _reach(facts, [facts.id_of(unit)], lambda node, link: link.flow == wanted)
    return any(
        link.flow == "unknown" and link.number not in facts.dead for node in reached for link in facts.links[node]
    )


# Isolation


class Section:
    """What the nearest valves cut off around a unit.

    Args:
        facts: of the plant.
        unit: name of what is to be isolated.
    """

    def __init__(self, facts: Facts, unit: str) -> None:
        self.facts = facts
        self.start = facts.id_of(unit)
        walls: set[str] = set()
        inside = {self.start}
        waiting = [self.start]
        while waiting:
            node = waiting.pop()
            # A tank is where something comes from, whatever lies behind it.
            if node != self.start and facts.nodes[node].type == "tank":
                continue
            for link in facts.links[node]:
                if link.end in inside or link.end in walls:
                    continue
                met = facts.nodes[link.end]
                if link.end != self.start and not met.aside and (met.shuts or met.is_relief):
                    walls.add(link.end)
                else:
                    inside.add(link.end)
                    waiting.append(link.end)
        self.walls = frozenset(walls)
        self.inside = frozenset(inside)

    @property
    def valves(self) -> list[str]:
        """Names of the valves to close: those behind which something may come from."""
        needed = [node for node in self.walls if self.facts.nodes[node].shuts and self._is_fed(node)]
        # What a valve on the side of a run leads to was not found, so that it may feed.
        needed += [
            node for node in self.inside - {self.start} if self.facts.nodes[node].aside and self.facts.nodes[node].shuts
        ]
        return _names(self.facts, needed, lambda node: True)

    @property
    def is_closed(self) -> bool:
        """Whether nothing can come in but through those valves, as far as is known."""
        nodes = [self.facts.nodes[node] for node in self.inside]
        if any(node.type in ("open", "end") or (node.type == "tank" and node.id != self.start) for node in nodes):
            return False
        if any(node.short for node in nodes):
            return False
        return not any((first in self.inside) != (second in self.inside) for first, second in self.facts.loose)

    def _is_fed(self, wall: str) -> bool:
        if self.facts.nodes[wall].short:
            return True
        seen = {wall}
        waiting = [wall]
        while waiting:
            for link in self.facts.links[waiting.pop()]:
                if link.end in seen or link.end in self.inside or link.end in self.walls:
                    continue
                seen.add(link.end)
                node = self.facts.nodes[link.end]
                if node.type in ("open", "end") or node.is_equipment or node.short:
                    return True
                waiting.append(link.end)
        return False


def section(facts: Facts, unit: str) -> Section:
    """What the nearest valves cut off around a unit."""
    return Section(facts, unit)


def isolate(facts: Facts, unit: str) -> list[str] | None:
    """The nearest valves that isolate a unit on every side; None where valves alone don't, or it can't be told."""
    found = Section(facts, unit)
    # What no line leads to was not found to be isolated: nothing is known of it.
    return found.valves if found.is_closed and facts.links[found.start] else None


def leaks(facts: Facts, unit: str, closed: Collection[str]) -> list[str]:
    """What still may come to a unit although valves are closed: tanks, ends and equipment, and what of the valves
    is none that may be closed for that.

    Args:
        facts: of the truth.
        unit: name of what is to be isolated.
        closed: names of the valves.
    """
    start = facts.id_of(unit)
    shut = {node.id for node in facts.units if node.name in closed and node.shuts}
    found = [name for name in closed if name not in {facts.nodes[node].name for node in shut}]
    stops = shut | {node.id for node in facts.nodes.values() if node.is_relief}
    reached = _reach(
        facts, [start], lambda node, link: link.end not in stops and (node == start or facts.nodes[node].type != "tank")
    )
    for node in reached - {start}:
        if facts.nodes[node].type in ("open", "end", "tank"):
            found.append(facts.nodes[node].name)
    return sorted(found)


# Closing valves


def cut_off(facts: Facts, valves: Sequence[str]) -> list[str]:
    """The gauges and equipment that no source feeds any more once valves are closed.

    Something is fed where a way leads to it from a source that nowhere goes against a known flow. Sources are tanks and
    the ends of pipes that are not known to be outlets; where there is neither, pumps.
    """
    closed = {facts.id_of(name) for name in valves}
    sources: set[str] = set()
    for valve in sorted(closed):
        sources |= _sources(facts, _reach(facts, [valve], lambda node, link: True))
    before = _reach(facts, sources, lambda node, link: _passes(facts, link))
    barriers = {valve for valve in closed if not facts.nodes[valve].aside}
    after = _reach(facts, sources, lambda node, link: link.end not in barriers and _passes(facts, link))
    return _names(facts, before - after - closed, lambda node: node.is_equipment or node.type == "gauge")


def is_fed_throughout(facts: Facts, valve: str) -> bool:
    """Whether sources feed all units that hang together with a valve, so that what closing cuts off is definite."""
    piece = _reach(facts, [facts.id_of(valve)], lambda node, link: True)
    sources = _sources(facts, piece)
    reached = _reach(facts, sources, lambda node, link: _passes(facts, link))
    return all(node in reached for node in piece if facts.nodes[node].is_unit)


def _sources(facts: Facts, piece: Collection[str]) -> set[str]:
    found = {node for node in piece if facts.nodes[node].type == "tank" or _may_feed(facts, node)}
    return found or {node for node in piece if facts.nodes[node].type == "pump"}


def _passes(facts: Facts, link: Link) -> bool:
    return link.flow != "against" or link.number in facts.taps


def _may_feed(facts: Facts, node: str) -> bool:
    return facts.nodes[node].type in ("open", "end") and any(link.flow != "against" for link in facts.links[node])


def _reach(facts: Facts, starts: Iterable[str], walks: Callable[[str, Link], bool]) -> set[str]:
    seen = set(starts)
    waiting = list(seen)
    while waiting:
        node = waiting.pop()
        for link in facts.links[node]:
            if link.end not in seen and walks(node, link):
                seen.add(link.end)
                waiting.append(link.end)
    return seen


def _names(facts: Facts, nodes: Iterable[str], wanted: Callable[[Fact], bool]) -> list[str]:
    return sorted(facts.nodes[node].name for node in nodes if wanted(facts.nodes[node]))


def _middle(facts: Facts, name: str) -> Point | None:
    return facts.nodes[facts.id_of(name)].middle
