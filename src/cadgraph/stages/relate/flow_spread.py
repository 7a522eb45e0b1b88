"""How far a direction of flow holds: through what has one way in and one way out, and round loops."""

from __future__ import annotations

import heapq
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import cast

import networkx as nx

from cadgraph.model.parts import Network

__all__ = ["Evidence", "Flows", "Idle", "around", "idle_links", "spread"]

# What follows from another connection is a little less sure.
_STEP = 0.995
# Two reasons that disagree leave it open unless one is so much surer.
_OUTWEIGHS = 0.2
# A branch to an open end that is at most this wide against the run is a drain, a vent or a sampling point: its area, a
# sixth, can't take the flow of the run, whatever it does.
_SPUR = 0.4
# Simple ways through one loop that are looked at; a loop with more is left open.
_MOST_STEPS = 100_000

# Nodes are numbers; where flow begins and ends there is one for each link at a unit, in a loop one inside each link.
_Node = tuple[int, int]


@dataclass(frozen=True)
class Evidence:
    """Something that shows which way it flows through a link.

    Args:
        link: number of the link.
        forward: whether it flows from the link's source to its target.
        confidence: 0..1.
        reason: in words.
    """

    link: int
    forward: bool
    confidence: float
    reason: str


@dataclass
class Flows:
    """What is known of the flow.

    Args:
        chosen: for each link its evidence, or what follows from that of others.
        against: pairs of reasons that disagree.
    """

    chosen: dict[int, Evidence] = field(default_factory=dict)
    against: list[tuple[Evidence, Evidence]] = field(default_factory=list)


@dataclass(frozen=True)
class Idle:
    """Links through which nothing flows that matters to the others.

    Args:
        dead: lead to closed ends and gauges alone.
        spurs: narrow branches that lead to open ends.
    """

    dead: frozenset[int]
    spurs: frozenset[int]


@dataclass(frozen=True)
class _Ways:
    """A network as flow sees it.

    Args:
        network: of units, places and links.
        at: the links at each node, and whether they leave it forward.
        idle: what takes no part.
    """

    network: Network
    at: Mapping[int, Sequence[tuple[int, bool]]]
    idle: Idle

    def live(self, node: int) -> list[tuple[int, bool]]:
        """The links at a node that take part; on a spur those of the spur."""
        some = [(link, forward) for link, forward in self.at[node] if link not in self.idle.dead]
        return [(link, forward) for link, forward in some if link not in self.idle.spurs] or some

    def told(self, flows: Flows, node: int) -> tuple[list[tuple[Evidence, bool]], list[tuple[int, bool]]]:
        """What is known of the live links at a node, and which of them are open still."""
        live = self.live(node)
        known = [(flows.chosen[link], forward) for link, forward in live if link in flows.chosen]
        return known, [(link, forward) for link, forward in live if link not in flows.chosen]

    def taking_part(self) -> list[int]:
        """The links that are neither dead nor spurs."""
        count = range(len(self.network.links))
        return [number for number in count if number not in self.idle.dead and number not in self.idle.spurs]

    def is_border(self, node: int) -> bool:
        """Whether what flows in at one link need not flow out at another."""
        if node >= len(self.network.units):
            return self.network.places[node - len(self.network.units)].kind != "junction"
        return self.network.units[node].unit_type in ("tank", "equipment") or len(self.at[node]) < 2

    def splits(self, node: int) -> bool:
        """Whether ways end and begin at a node: what it takes in at one side it gives off at the other by itself."""
        pump = node < len(self.network.units) and self.network.units[node].unit_type == "pump"
        return pump or self.is_border(node)


def around(network: Network) -> dict[int, list[tuple[int, bool]]]:
    """The links at each node, and whether they leave it forward."""
    found: dict[int, list[tuple[int, bool]]] = {}
    for number, link in enumerate(network.links):
        found.setdefault(link.source, []).append((number, True))
        found.setdefault(link.target, []).append((number, False))
    return found


def spread(network: Network, evidence: Sequence[Evidence]) -> Flows:
    """Carries directions on as far as they hold, the surest first.

    What flows into a junction, a valve or a pump flows out of it. Within a loop a link has a direction where all simple
    ways from where flow enters the loop to where it leaves it run through the link in one sense: with any resistances,
    flow is a sum of such ways.

    Args:
        network: units and links.
        evidence: of some links.
    """
    ways = _Ways(network, around(network), idle_links(network))
    flows = Flows()
    ordered = sorted(enumerate(evidence), key=lambda item: (-item[1].confidence, item[0]))
    for _, level in groupby(ordered, key=lambda item: item[1].confidence):
        found: list[Evidence] = [one for _, one in level]
        while found:
            _follow(ways, flows, found)
            found = _around_loops(ways, flows)
    _settle(ways, flows)
    return flows


def _follow(ways: _Ways, flows: Flows, found: Iterable[Evidence]) -> None:
    """Takes evidence in, and what follows from it at nodes that have one link left open."""
    waiting = [(-one.confidence, k, one) for k, one in enumerate(found)]
    heapq.heapify(waiting)
    count = len(waiting)
    while waiting:
        _, _, one = heapq.heappop(waiting)
        held = flows.chosen.get(one.link)
        if held is not None:
            if held.forward != one.forward:
                flows.against.append((held, one))
            continue
        flows.chosen[one.link] = one
        link = ways.network.links[one.link]
        for node in (link.source, link.target):
            following = _last_open(ways, flows, node)
            if following is not None:
                heapq.heappush(waiting, (-following.confidence, count, following))
                count += 1


def _last_open(ways: _Ways, flows: Flows, node: int) -> Evidence | None:
    """Where all but one of the live links at a node flow in, the last one flows out; and the other way round."""
    if ways.is_border(node):
        return None
    known, left = ways.told(flows, node)
    senses = {one.forward == forward for one, forward in known}
    if len(left) != 1 or len(senses) != 1:
        return None
    (leaving,) = senses
    surest = min((one for one, _ in known), key=lambda one: (one.confidence, one.link))
    link, forward = left[0]
    return Evidence(link, forward != leaving, surest.confidence * _STEP, surest.reason)


def _settle(ways: _Ways, flows: Flows) -> None:
    """Takes back what reasons disagree about, unless one is much surer."""
    flows.against += list(_collisions(ways, flows))
    refuted: set[str] = set()
    for held, other in flows.against:
        refuted.add(other.reason)
        if held.confidence - other.confidence < _OUTWEIGHS:
            refuted.add(held.reason)
    # Whatever else follows from a reason that was refuted is no surer than it.
    for number, one in list(flows.chosen.items()):
        if one.reason in refuted:
            del flows.chosen[number]


def _collisions(ways: _Ways, flows: Flows) -> Iterator[tuple[Evidence, Evidence]]:
    """The reasons that let everything flow into a node, or out of it, the surest first."""
    for node in sorted(ways.at):
        ones = [] if ways.is_border(node) else _all_one_way(ways, flows, node)
        other = next((one for one in ones[1:] if one.reason != ones[0].reason), None)
        if other is not None:
            yield ones[0], other


def _all_one_way(ways: _Ways, flows: Flows, node: int) -> list[Evidence]:
    """What is known of the links at a node where all of them flow in, or all out, the surest first."""
    known, left = ways.told(flows, node)
    if left or len({one.forward == forward for one, forward in known}) != 1:
        return []
    return sorted((one for one, _ in known), key=lambda one: (-one.confidence, one.link))


# --- what takes no part ---


def idle_links(network: Network) -> Idle:
    """Links that lead to closed ends and gauges alone, and narrow branches that lead to open ends.

    Args:
        network: units and links.
    """
    at = around(network)
    dead: set[int] = set()
    spurs: set[int] = set()

    def alive(node: int) -> list[tuple[int, bool]]:
        return [(link, forward) for link, forward in at[node] if link not in dead and link not in spurs]

    front = sorted(node for node, links in at.items() if len(links) == 1)
    while front:
        node = front.pop()
        left = alive(node)
        if len(left) != 1:
            continue
        branch = [left[0][0]] if _is_closed(network, at, node) else _spur(network, at, node)
        (dead if _is_closed(network, at, node) else spurs).update(branch)
        foot = _foot(network, node, branch)
        if branch and len(alive(foot)) == 1:
            front.append(foot)
    return Idle(frozenset(dead), frozenset(spurs - dead))


def _is_closed(network: Network, at: Mapping[int, Sequence[tuple[int, bool]]], node: int) -> bool:
    """Whether a node with one live link gives nothing off and takes nothing in."""
    if node < len(network.units):
        kind = network.units[node].unit_type
        return kind == "gauge" or (kind == "valve" and len(at[node]) > 1)
    return network.places[node - len(network.units)].kind in ("blind", "junction")


def _spur(network: Network, at: Mapping[int, Sequence[tuple[int, bool]]], node: int) -> list[int]:
    """The links of the branch by which a free end, or a valve there, hangs on a much wider run; none where it isn't."""
    branch: list[int] = []
    ahead = list(at[node]) if _is_free(network, node) else []
    while len(ahead) == 1:
        number, forward = ahead[0]
        branch.append(number)
        node = _there(network, number, forward)
        ahead = [link for link in at[node] if link[0] not in branch] if _passes(network, node) else []
    return branch if ahead and _is_narrow(network, branch[-1], [number for number, _ in ahead]) else []


def _there(network: Network, number: int, forward: bool) -> int:
    return network.links[number].target if forward else network.links[number].source


def _is_free(network: Network, node: int) -> bool:
    """Whether a node is no unit, or a valve, behind which nothing follows."""
    return node >= len(network.units) or network.units[node].unit_type == "valve"


def _passes(network: Network, node: int) -> bool:
    """Whether a line may go on at a node, or branch there."""
    return node >= len(network.units) or network.units[node].unit_type in ("valve", "gauge")


def _is_narrow(network: Network, branch: int, run: Sequence[int]) -> bool:
    """Whether a link is narrow against the widest of some others."""
    own = network.links[branch].diameter
    widths = [width for number in run if (width := network.links[number].diameter) is not None]
    return own is not None and bool(widths) and own <= _SPUR * max(widths)


def _foot(network: Network, tip: int, branch: Sequence[int]) -> int:
    """Where a branch that begins at a node ends."""
    node = tip
    for number in branch:
        link = network.links[number]
        node = link.target if link.source == node else link.source
    return node


# --- loops ---


def _around_loops(ways: _Ways, flows: Flows) -> list[Evidence]:
    """What ways through loops say of links that are open still."""
    found: list[Evidence] = []
    for members in _loops(ways) if flows.chosen else ():
        left = [number for number in members if number not in flows.chosen]
        known = _reasons(ways, flows, members) if left else []
        if known:
            found += _through(ways, flows, frozenset(members), left, known)
    return sorted(found, key=lambda one: one.link)


def _loops(ways: _Ways) -> Iterator[list[int]]:
    """The links of each part of the network that hangs together even without any one of its nodes."""
    graph: nx.Graph[_Node] = nx.Graph()
    for number in ways.taking_part():
        near, middle, far = _corners(ways, number)
        graph.add_edge(near, middle)
        graph.add_edge(middle, far)
    blocks = cast("Iterator[set[_Node]]", nx.biconnected_components(graph))
    for nodes in blocks:
        # A link that is no part of a loop is two blocks, each of one half.
        members = sorted(-1 - node for node, _ in nodes if node < 0 and _lies_in(ways, -1 - node, nodes))
        if members:
            yield members


def _corners(ways: _Ways, number: int) -> tuple[_Node, _Node, _Node]:
    """A link as two edges with a node of its own between them."""
    link = ways.network.links[number]
    near = (link.source, number) if ways.splits(link.source) else (link.source, -1)
    far = (link.target, number) if ways.splits(link.target) else (link.target, -1)
    return near, (-1 - number, 0), far


def _lies_in(ways: _Ways, number: int, block: Collection[_Node]) -> bool:
    near, _, far = _corners(ways, number)
    return near in block and far in block


def _reasons(ways: _Ways, flows: Flows, members: Collection[int]) -> list[Evidence]:
    """What is known in the network that a loop is part of; without any of it nothing follows."""
    start = next(iter(members))
    seen, front = {start}, [start]
    while front:
        link = ways.network.links[front.pop()]
        for node in (link.source, link.target):
            more = {number for number, _ in ways.at[node]} - seen
            seen |= more
            front += more
    return [flows.chosen[number] for number in ways.taking_part() if number in seen and number in flows.chosen]


def _through(
    ways: _Ways, flows: Flows, members: frozenset[int], left: Sequence[int], known: Sequence[Evidence]
) -> list[Evidence]:
    """The directions that all ways through one loop have in common."""
    steps = _steps(ways, flows, members)
    enters = _reached(ways, flows, members, backward=False)
    leaves = _reached(ways, flows, members, backward=True)
    senses: dict[int, set[bool]] = {number: set() for number in left}
    budget = _MOST_STEPS
    for start in sorted(enters.intersection(steps)):
        budget = _walk(steps, start, leaves, senses, budget)
        if budget <= 0:
            return []
    # Everything that is known may have closed a way; the least of it says how sure the outcome is.
    least = min(known, key=lambda one: (one.confidence, one.link))
    return [
        Evidence(number, next(iter(found)), least.confidence * _STEP, least.reason)
        for number, found in senses.items()
        if len(found) == 1
    ]


def _steps(ways: _Ways, flows: Flows, members: Iterable[int]) -> dict[_Node, list[tuple[int, bool, _Node]]]:
    """From each node the links that can be gone along, and where they lead."""
    steps: dict[_Node, list[tuple[int, bool, _Node]]] = {}
    for number in sorted(members):
        near, _, far = _corners(ways, number)
        one = flows.chosen.get(number)
        for forward, start, end in ((True, near, far), (False, far, near)):
            steps.setdefault(start, [])
            if one is None or one.forward == forward:
                steps[start].append((number, forward, end))
    return steps


def _reached(ways: _Ways, flows: Flows, without: Collection[int], backward: bool) -> set[_Node]:
    """Nodes that flow from outside some links can come to, or can go outside from."""
    every = ways.taking_part()
    follow: dict[_Node, list[_Node]] = {}
    for start, steps in _steps(ways, flows, [number for number in every if number not in without]).items():
        for _, _, end in steps:
            first, last = (end, start) if backward else (start, end)
            follow.setdefault(first, []).append(last)
    return _closure({node for number in every for node in _corners(ways, number)[::2] if node[1] >= 0}, follow)


def _closure(start: Collection[_Node], follow: Mapping[_Node, Sequence[_Node]]) -> set[_Node]:
    """What can be reached from some nodes, themselves included."""
    seen = set(start)
    front = sorted(start)
    while front:
        new = [node for node in follow.get(front.pop(), ()) if node not in seen]
        seen.update(new)
        front += new
    return seen


def _walk(
    steps: Mapping[_Node, Sequence[tuple[int, bool, _Node]]],
    start: _Node,
    goals: Collection[_Node],
    senses: dict[int, set[bool]],
    budget: int,
) -> int:
    """Notes the sense of each link on every simple way from a node to any goal; returns what is left of the budget."""
    way: list[tuple[int, bool]] = []
    seen = {start}
    stack = [iter(steps[start])]
    where = [start]
    while stack and budget > 0:
        budget -= 1
        following = next(stack[-1], None)
        if following is None:
            stack.pop()
            seen.discard(where.pop())
            if way:
                way.pop()
            continue
        link, forward, end = following
        if end in seen:
            continue
        way.append((link, forward))
        if end in goals:
            for number, sense in way:
                if number in senses:
                    senses[number].add(sense)
        seen.add(end)
        where.append(end)
        stack.append(iter(steps.get(end, ())))
    return budget
