"""A graph's connections beside those that its source states: which agree, and which only one of both has.

Both are contracted in the same way: what follows along pipes without another device in between is joined; gauges, and
valves that a run only passes at a tap of theirs, stand aside. Everything is taken from the graph, whose ``stated``
keeps what the source says.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from bisect import bisect_left
from collections import deque
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, NamedTuple

from cadgraph._io.text import natural_key, tag_key
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Part, Stated, Unit
from cadgraph.query.network import Network
from cadgraph.query.regions import Region, find_regions

__all__ = ["Claim", "SourceComparison", "Uncompared", "Verdict", "WayOfFlow", "compare_source", "standing_aside"]

Verdict = Literal["agree", "differ", "ours", "theirs", "open"]
"""On whose flow both agree or differ, of which only one side says one, or neither."""
_Sense = Literal["along", "against", "unknown"]


@dataclass(frozen=True)
class Claim:
    """Two units that are joined without another device in between, as we have it, or the source, or both.

    Args:
        first: tag.
        second: tag.
        ids: of the two units.
        via: ids of the parts on our way from the first to the second; empty where only the source joins them.
        paths: of the source's own elements on its way, the two units included; empty where only we join them.
        gaps: pairs of paths that follow each other there, and that no joint of ours joins.
        lost: those of the paths that are not in the graph.
    """

    first: str
    second: str
    ids: tuple[str, str]
    via: tuple[str, ...] = ()
    paths: tuple[str, ...] = ()
    gaps: tuple[tuple[str, str], ...] = ()
    lost: tuple[str, ...] = ()


@dataclass(frozen=True)
class WayOfFlow:
    """Which way it flows between two units that both join.

    Args:
        first: tag.
        second: tag.
        ours: ``forward`` (from the first to the second), ``backward``, ``unknown``; ``both`` where it flows out of both
            or into both.
        theirs: likewise of the source.
    """

    first: str
    second: str
    ours: str
    theirs: str


@dataclass(frozen=True)
class Uncompared:
    """Something that the source joins, and that stands for no place in the graph.

    Args:
        path: in the source.
        why: it can't be compared, in words.
    """

    path: str
    why: str


@dataclass(frozen=True)
class SourceComparison:
    """What the graph and its source have in common, and what not.

    Args:
        links: how many the source states.
        within: how many of them are within one device.
        used: whether the graph was made with them as evidence, so that agreement says less.
        agreeing: pairs of units that both join; twice where two pipes join them.
        only_ours: pairs that only the graph joins.
        only_theirs: pairs that only the source joins.
        flows: which way it flows between the pairs that both join once.
        unclear: pairs that several pipes join, so that their directions are not compared.
        silent: tags of the units of which the source states nothing.
        uncompared: what the source joins and the graph has no place for.
    """

    links: int
    within: int
    used: bool
    agreeing: tuple[Claim, ...] = ()
    only_ours: tuple[Claim, ...] = ()
    only_theirs: tuple[Claim, ...] = ()
    flows: tuple[WayOfFlow, ...] = ()
    unclear: tuple[tuple[str, str], ...] = ()
    silent: tuple[str, ...] = ()
    uncompared: tuple[Uncompared, ...] = ()

    @property
    def agrees(self) -> bool:
        """Whether nothing differs, as far as both can be compared."""
        return not self.only_ours and not self.only_theirs and not self.directions("differ")

    @property
    def complete(self) -> bool:
        """Whether all that the source joins has a place in the graph, so that nothing of it was left uncompared."""
        return not self.uncompared

    @property
    def verdict(self) -> str:
        """The outcome in one line."""
        if not self.agrees:
            return "the graph and its source differ"
        if self.complete:
            return "the graph and its source agree"
        n = len(self.uncompared)
        lack, joins = (
            ("1 element of the source has", "it joins") if n == 1 else (f"{n} elements of the source have", "they join")
        )
        return f"what could be compared agrees; {lack} no place in the graph, and what {joins} is missing there"

    def directions(self, verdict: Verdict) -> tuple[WayOfFlow, ...]:
        """The pairs on whose flow both agree or differ, of which only one side says one, or neither."""
        return tuple(way for way in self.flows if _verdict(way) == verdict)


def _verdict(way: WayOfFlow) -> Verdict:
    known = way.ours != "unknown", way.theirs != "unknown"
    if all(known):
        return "agree" if way.ours == way.theirs else "differ"
    return "ours" if known[0] else "theirs" if known[1] else "open"


def compare_source(graph: SceneGraph) -> SourceComparison:
    """Compares the connections of a graph with those that its source states.

    Args:
        graph: with ``stated`` links; without any nothing is compared.
    """
    links = graph.document.stated
    used = _was_used(graph)
    if not links:
        return SourceComparison(0, 0, used)
    network = Network(graph)
    ours, theirs = _Ours(network), _Theirs(network, links)
    pairs = sorted({*ours.joined, *theirs.joined}, key=lambda pair: tuple(tag_key(network.name(name)) for name in pair))
    found: dict[str, list[Claim]] = {"both": [], "ours": [], "theirs": []}
    flows: list[WayOfFlow] = []
    unclear: list[tuple[str, str]] = []
    for pair in pairs:
        mine, said = ours.joined.get(pair, []), theirs.joined.get(pair, [])
        tags = network.name(pair[0]), network.name(pair[1])
        both = min(len(mine), len(said))
        for kind, via, paths in _matched(ours.ways(pair), theirs.ways(pair), theirs):
            found[kind].append(_claim(pair, tags, via, paths, theirs))
        if both and ours.aside.isdisjoint(pair):
            if len(mine) == len(said) == 1:
                flows.append(WayOfFlow(*tags, ours.flow(pair, mine[0]), theirs.flow(pair, said[0])))
            else:
                unclear.append(tags)
    return SourceComparison(
        links=len(links),
        within=theirs.within,
        used=used,
        agreeing=tuple(found["both"]),
        only_ours=tuple(found["ours"]),
        only_theirs=tuple(found["theirs"]),
        flows=tuple(flows),
        unclear=tuple(unclear),
        silent=theirs.silent(),
        uncompared=theirs.uncompared,
    )


def standing_aside(network: Network) -> frozenset[str]:
    """Ids of gauges, and of the units that stand in a run by one port alone, at which they are tapped into it."""

    def is_tapped(name: str) -> bool:
        arcs = network.arcs(name)
        ports = {arc.start_port for arc in arcs}
        return len(arcs) > 1 and len(ports) == 1 and None not in ports and network.is_valve(name)

    return frozenset(name for name in network.places if network.is_gauge(name) or is_tapped(name))


def _was_used(graph: SceneGraph) -> bool:
    relate = graph.config.get("relate")
    return isinstance(relate, Mapping) and relate.get("use_metadata") is True


def _matched(
    mine: list[list[_Step]], said: list[list[_Step]], source: _Theirs
) -> Iterator[tuple[str, list[_Step], list[_Step]]]:
    """Ways of both sides that are one, those with the most parts in common first; then those of one side only."""
    mine, said = list(mine), list(said)
    while mine and said:
        shared = {(i, k): len(source.shared(a, b)) for i, a in enumerate(mine) for k, b in enumerate(said)}
        i, k = min(shared, key=lambda pair: (-shared[pair], pair))
        yield "both", mine.pop(i), said.pop(k)
    yield from (("ours", way, []) for way in mine)
    yield from (("theirs", [], way) for way in said)


class _Step(NamedTuple):
    """A step from one place to another, with what is passed and whether that is with the flow."""

    there: str
    passed: tuple[str, ...]
    sense: _Sense


class _Side(ABC):
    """What one of both joins: regions without a dividing unit in between, and the steps in them."""

    def __init__(self, network: Network) -> None:
        self.network = network
        self.aside = standing_aside(network)
        self._trees: dict[tuple[str, int], Mapping[str, tuple[str, _Step]]] = {}

    @property
    @abstractmethod
    def regions(self) -> Sequence[Region]:
        """Pieces of pipe between dividing units."""

    @abstractmethod
    def steps(self, place: str) -> Iterable[_Step]:
        """The steps away from a place."""

    @cached_property
    def joined(self) -> Mapping[tuple[str, str], list[Region]]:
        """For each pair of units that are joined the regions that do it; what stands aside only with what divides."""
        found: dict[tuple[str, str], list[Region]] = {}
        for region in self.regions:
            ends = sorted(region.ends, key=self._order)
            aside = sorted(region.inside & self.aside, key=self._order)
            pairs = [(a, b) for i, a in enumerate(ends) for b in ends[i + 1 :]]
            pairs += [(min(a, b, key=self._order), max(a, b, key=self._order)) for a in aside for b in ends]
            for pair in pairs:
                found.setdefault(pair, []).append(region)
        return found

    def _order(self, name: str) -> tuple[object, ...]:
        return (tag_key(self.network.name(name)),)

    def ways(self, pair: tuple[str, str]) -> list[list[_Step]]:
        """A way through each region that joins a pair."""
        found: list[list[_Step]] = []
        for region in self.joined.get(pair, ()):
            direct = {way[0].passed for way in found if len(way) == 1}
            found.append(self.way(pair, region, direct))
        return found

    def way(self, pair: tuple[str, str], region: Region, without: Collection[tuple[str, ...]] = ()) -> list[_Step]:
        """The fewest steps from the first unit of a pair to the second within a region.

        Args:
            pair: ids of the units.
            region: that joins them.
            without: what single steps between the two pass that belong to other regions.
        """
        start, goal = pair
        if not region.inside:
            return [step for step in self.steps(start) if step.there == goal and step.passed not in without][:1]
        came = self._tree(start, region)
        way: list[_Step] = []
        while goal != start and goal in came:
            goal, step = came[goal]
            way.append(step)
        return way[::-1]

    def _tree(self, start: str, region: Region) -> Mapping[str, tuple[str, _Step]]:
        """For all that can be reached from a unit within a region the step before, and where that begins."""
        known = self._trees.get((start, id(region)))
        if known is not None:
            return known
        came: dict[str, tuple[str, _Step]] = {}
        waiting = deque([start])
        while waiting:
            here = waiting.popleft()
            for step in self.steps(here):
                # A single step between two dividing units is a region of its own.
                own = step.there in region.inside or (step.there in region.ends and here in region.inside)
                if own and step.there != start and step.there not in came:
                    came[step.there] = here, step
                    if step.there in region.inside:
                        waiting.append(step.there)
        self._trees[start, id(region)] = came
        return came

    def flow(self, pair: tuple[str, str], region: Region) -> str:
        """Which way it flows from the first of a pair to the second, by what flows out of them and in.

        What leaves the one enters the other where a region has no third end; elsewhere both must be known.
        """
        first, second = (region.flows.get(name) for name in pair)
        if first is not None and second is not None:
            return "both" if first == second else "forward" if first == "out" else "backward"
        if len(region.ends) > 2:
            return "unknown"
        if first is not None or second is not None:
            return "forward" if first == "out" or second == "in" else "backward"
        senses = {step.sense for step in self.way(pair, region)} - {"unknown"}
        return "unknown" if len(senses) != 1 else "forward" if senses == {"along"} else "backward"


class _Ours(_Side):
    """The connections of the graph."""

    @cached_property
    def regions(self) -> Sequence[Region]:
        """Pieces of pipe between dividing units."""
        network = self.network
        units = {name for name, node in network.places.items() if isinstance(node, Unit)}
        dividing = units - self.aside
        return find_regions(network, dividing)

    def steps(self, place: str) -> Iterable[_Step]:
        """The connections of a place."""
        return (_Step(arc.end, arc.via, arc.flow) for arc in self.network.arcs(place))


class _Theirs(_Side):
    """The links of the source: devices are our units, all else is pipe."""

    def __init__(self, network: Network, links: Sequence[Stated]) -> None:
        super().__init__(network)
        self._links = links
        self._parts = {
            path: parts
            for link in links
            for path, parts in ((link.first_path, link.first), (link.second_path, link.second))
        }
        self._unit_of = {part: unit.id for unit in self._units for part in unit.parts}
        self._above: dict[str, set[str]] = {}
        self._why, self._place = self._placed()
        self._at, self.within = self._stepped()
        if self._place_branches():
            self._at, self.within = self._stepped()

    @cached_property
    def _units(self) -> tuple[Unit, ...]:
        return tuple(node for node in self.network.places.values() if isinstance(node, Unit))

    # Places

    def _placed(self) -> tuple[dict[str, str], dict[str, str | None]]:
        """Why paths can't be compared, and the place that each path is: a unit, a place of its own, or none.

        What isn't in the graph is a place that pipes lead through; what is several places is none.
        """
        why: dict[str, str] = {}
        place_of: dict[str, str | None] = {}
        taken: dict[str, str] = {}
        # A node and a mesh below it are one place; a node above several of them is none.
        for path, parts in sorted(self._parts.items(), key=lambda item: (len(item[1]), natural_key(item[0]))):
            units = sorted({self._unit_of[part] for part in parts if part in self._unit_of})
            others = {taken[part] for part in parts if part in taken}
            place: str | None = units[0] if units else min(others, default=f"path {path}")
            if not parts:
                why[path], place = self._missing(path)
            elif len(units) > 1:
                why[path], place = f"it is several units: {self._named(units)}", None
            elif not units and len(others) > 1:
                why[path], place = "it is a node above several elements that the source joins", None
                self._above[path] = others
            elif not units and self._on_lines.isdisjoint(parts):
                why[path] = "no line of the graph leads through it"
            place_of[path] = place
            for part in parts if place is not None and not units else ():
                taken.setdefault(part, place or "")
        return why, place_of

    def _place_branches(self) -> bool:
        """Gives a node above several elements the place of one of them where a device divides none of them off.

        A branch that another one refers to is one piece of pipe then, whichever end is meant. Returns whether there is
        such a node.
        """
        found = False
        for path, others in self._above.items():
            first = min(others)
            if others <= self._inside(first):
                self._place[path] = first
                del self._why[path]
                found = True
        return found

    def _missing(self, path: str) -> tuple[str, str | None]:
        node = path.rstrip("/") + "/"
        at = bisect_left(self._meshes, node)
        above = at < len(self._meshes) and self._meshes[at].startswith(node)
        return ("it is a node above too many meshes", None) if above else ("it is not in the graph", f"path {path}")

    @cached_property
    def _meshes(self) -> list[str]:
        return sorted(mesh for part in self.network.graph.of_layer(Part) for mesh in part.meshes)

    @cached_property
    def _on_lines(self) -> frozenset[str]:
        """The parts along the graph's connections."""
        named = [part for edge in self.network.edges for part in edge.via]
        return frozenset(named).union(*(node.parts for node in self.network.places.values()))

    def _named(self, units: Sequence[str]) -> str:
        tags = [self.network.name(unit) for unit in units]
        return ", ".join(tags[:4]) + (f" and {len(tags) - 4} more" if len(tags) > 4 else "")

    @property
    def uncompared(self) -> tuple[Uncompared, ...]:
        """What has no place in the graph, in the natural order of its paths."""
        return tuple(
            Uncompared(path, why) for path, why in sorted(self._why.items(), key=lambda it: natural_key(it[0]))
        )

    def silent(self) -> tuple[str, ...]:
        """Tags of the units of which the source says nothing."""
        named = set(self._place.values())
        return tuple(sorted((unit.tag for unit in self._units if unit.id not in named), key=tag_key))

    # Steps and regions

    def _stepped(self) -> tuple[dict[str, list[_Step]], int]:
        at: dict[str, list[_Step]] = {}
        within = 0
        for link in self._links:
            first, second = self._place[link.first_path], self._place[link.second_path]
            if first is None or second is None:
                continue
            if first == second:
                within += 1
                continue
            paths = (link.first_path, link.second_path)
            onward: _Sense = "unknown"
            back: _Sense = "unknown"
            if link.flow != "unknown":
                onward, back = ("along", "against") if link.flow == "forward" else ("against", "along")
            at.setdefault(first, []).append(_Step(second, paths, onward))
            at.setdefault(second, []).append(_Step(first, paths[::-1], back))
        return at, within

    def steps(self, place: str) -> Iterable[_Step]:
        """The links of a place."""
        return self._at.get(place, ())

    def _divides(self, place: str) -> bool:
        return place in self.network.places and place not in self.aside

    @cached_property
    def regions(self) -> Sequence[Region]:
        """Pieces of pipe between dividing units."""
        found: list[Region] = []
        seen: set[str] = set()
        for place in self._at:
            if self._divides(place):
                # Two devices flange to flange.
                direct = [step for step in self._at[place] if self._divides(step.there) and place < step.there]
                for there in sorted({step.there for step in direct}):
                    found.append(self._region({place, there}, set()))
            elif place not in seen:
                inside = self._inside(place)
                seen |= inside
                ends = {step.there for here in inside for step in self._at[here] if self._divides(step.there)}
                found.append(self._region(ends, inside))
        return found

    def _inside(self, start: str) -> set[str]:
        """All that hangs together with a place that doesn't divide."""
        inside, waiting = {start}, [start]
        while waiting:
            for step in self.steps(waiting.pop()):
                if step.there not in inside and not self._divides(step.there):
                    inside.add(step.there)
                    waiting.append(step.there)
        return inside

    def _region(self, ends: set[str], inside: set[str]) -> Region:
        flows: dict[str, Literal["in", "out"]] = {}
        for end in sorted(ends):
            into = [step for step in self._at[end] if step.there in (inside or ends)]
            senses = {step.sense for step in into} - {"unknown"}
            if len(senses) == 1:
                flows[end] = "out" if senses == {"along"} else "in"
        return Region(frozenset(ends), frozenset(inside), flows)

    # Joints

    def shared(self, ours: Sequence[_Step], said: Sequence[_Step]) -> set[str]:
        """The parts that a way of the graph and one of the source have in common."""
        via = {part for step in ours for part in step.passed}
        return via.intersection(part for step in said for path in step.passed for part in self._parts[path])

    def is_lost(self, path: str) -> bool:
        """Whether a path is not in the graph."""
        return not self._parts[path]

    def is_joined(self, first: str, second: str) -> bool:
        """Whether a joint of the graph joins two paths, or both a third part, such as a gasket."""
        here, there = self._whole(first), self._whole(second)
        if not here.isdisjoint(there):
            return True
        near = {other for part in here for other in self._joined_to.get(part, ())}
        return not near.isdisjoint(there) or any(not near.isdisjoint(self._joined_to.get(part, ())) for part in there)

    def _whole(self, path: str) -> set[str]:
        place = self._place[path]
        node = self.network.places.get(place or "")
        return {*self._parts[path], *(node.parts if node is not None else ())}

    @cached_property
    def _joined_to(self) -> Mapping[str, set[str]]:
        found: dict[str, set[str]] = {}
        for joint in self.network.graph.joints(made=True):
            found.setdefault(joint.first, set()).add(joint.second)
            found.setdefault(joint.second, set()).add(joint.first)
        return found


def _claim(
    pair: tuple[str, str], tags: tuple[str, str], ours: Sequence[_Step], said: Sequence[_Step], source: _Theirs
) -> Claim:
    steps = [(step.passed[0], step.passed[1]) for step in said]
    paths = tuple(dict.fromkeys(path for step in steps for path in step))
    return Claim(
        *tags,
        pair,
        via=tuple(dict.fromkeys(part for step in ours for part in step.passed)),
        paths=paths,
        gaps=tuple(step for step in steps if not ours and not source.is_joined(*step)),
        lost=tuple(path for path in paths if source.is_lost(path)),
    )
