"""What closing valves cuts off from what feeds it."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from cadgraph._io.text import tag_key
from cadgraph.model.graph import SceneGraph
from cadgraph.model.pipework import Follow
from cadgraph.model.records import Terminal, Unit
from cadgraph.query.doubt import Doubt, open_sides, unshown
from cadgraph.query.duty import Duty, blocked_relief, duty_of, joins_more, likely_kinds
from cadgraph.query.network import Arc, Network

if TYPE_CHECKING:
    import networkx

__all__ = ["ALL_RUN", "Consequence", "WhatIf", "what_if", "would_run_dry"]

ALL_RUN = "all other valves are open and all pumps run"
"""What every answer supposes."""

# Why a valve may not be shut, by what it can be relied on for; of an open kind only where not all that it may be shuts.
_NOT_SHUT: Mapping[Duty, str] = {
    "check": "is a check valve: nobody shuts it by hand",
    "relief": "is a relief valve: it must not be blocked",
    "control": "is a control valve: it moves by itself and may leak",
    "other": "is of a kind that isn't known to shut off",
    "unknown": "is of unknown kind: it may be a check valve, which nobody shuts",
}
_TURNS = "the ways left to it go against the flow as it was, which may turn in a loop or header"
_ROUND = "a pump may still drive it round a loop that nothing feeds"
_BACK = "a tank that it fed may run back to it, and out at an open end"
_FILLED = "filled through them before; whether the ways left to it fill it, nobody knows"


@dataclass(frozen=True)
class Consequence:
    """A unit or an end of a pipe that closing concerns.

    Args:
        place: its id.
        name: its tag.
        what: its kind, or its type.
        why: what makes it unknown, or what it depends on; ``""`` where nothing does.
    """

    place: str
    name: str
    what: str
    why: str = ""

    @property
    def condition(self) -> str:
        """``why`` as the end of a sentence."""
        return f", {self.why}" if self.why else ""


def would_run_dry(pump: Consequence) -> str:
    """What happens to a pump that is cut off while it runs."""
    return f"{pump.name} would run dry{pump.condition}"


@dataclass(frozen=True)
class WhatIf:
    """The answer. It is about flow: what is cut off may still be under pressure.

    Args:
        closed: tags of the valves that are taken for shut.
        sources: tags of what feeds the network, by tag.
        cut_off: units and ends with no way left from any source but against a known flow, by tag; ``why`` names the
            closed valves that it depends on, as nobody knows whether these can be shut. What is left against the flow
            along loops and headers, where it may turn, is unknown, and so is an open end with what stands before it
            that a tank may run back to.
        unknown: units and ends behind the valves that may be cut off or not, and tanks that may be refilled or not.
        still_fed: units and ends behind the valves to which a way of known direction leads from a source all the same.
        not_refilled: tanks that count as sources and that nothing else flows to any more; ``why`` likewise.
        dead_headed: pumps that have no way left to a tank or an end but through a relief valve, also such as would run
            dry; ``why`` likewise, and it names the relief valves that they may open.
        run_dry: pumps among what is cut off; ``why`` likewise.
        doubts: where a way that was not found may feed what is cut off.
        assumptions: what the answer supposes, a sentence each.
        remarks: on the closed valves, and on pumps that are cut off.
    """

    closed: tuple[str, ...]
    sources: tuple[str, ...]
    cut_off: tuple[Consequence, ...]
    unknown: tuple[Consequence, ...]
    still_fed: tuple[Consequence, ...]
    not_refilled: tuple[Consequence, ...]
    dead_headed: tuple[Consequence, ...]
    run_dry: tuple[Consequence, ...]
    doubts: tuple[Doubt, ...]
    assumptions: tuple[str, ...]
    remarks: tuple[str, ...]

    @property
    def known(self) -> bool:
        """Whether nothing is open in the answer, as far as the graph goes."""
        told = (*self.cut_off, *self.not_refilled, *self.dead_headed)
        return not (self.unknown or self.doubts or any(one.why for one in told))


def what_if(
    graph: SceneGraph | Network, close: Sequence[str] | str, sources: Sequence[str] | str | None = None
) -> WhatIf:
    """What loses what feeds it when valves are closed, all others being open.

    Something is fed where a way leads to it from a source that nowhere goes against a known flow. Sources are tanks and
    the ends of pipes that aren't known to be outlets; in a network with neither its pumps, which else only pass on.

    Args:
        graph: the finished graph, or its network.
        close: tags or ids of the valves.
        sources: tags or ids of what feeds the network instead.

    Raises:
        Unconnected: no line was found at one of them, which is a ``ValueError``: that is no answer.
        ValueError: nothing is called so, what is to be closed is no valve, or both are the same.
    """
    network = graph if isinstance(graph, Network) else Network(graph)
    closed = _closed(network, [close] if isinstance(close, str) else close)
    given = None if sources is None else _given(network, [sources] if isinstance(sources, str) else sources, closed)
    return _Closing(network, closed, given).answer()


def _closed(network: Network, close: Sequence[str]) -> tuple[str, ...]:
    if not close:
        raise ValueError("name at least one valve to close")
    places = dict.fromkeys(network.find(name) for name in close)
    for place in places:
        if not network.is_valve(place):
            raise ValueError(f"{network.name(place)} is no valve but a {network.what(place)}; name valves to close")
        if not network.arcs(place):
            raise network.unconnected(place, "what closing it cuts off")
    return tuple(sorted(places, key=lambda place: tag_key(network.name(place))))


def _given(network: Network, sources: Sequence[str], closed: Collection[str]) -> tuple[str, ...]:
    places = dict.fromkeys(network.find(name) for name in sources)
    if not places:
        raise ValueError("name at least one source, or leave the sources out")
    for place in places:
        if place in closed:
            raise ValueError(f"{network.name(place)} is closed and can't be a source as well")
        if not network.arcs(place):
            raise network.unconnected(place, "what it feeds")
        node = network.places[place]
        blind = isinstance(node, Terminal) and node.kind == "blind"
        if what := "a blind end" if blind else "a gauge" if network.is_gauge(place) else "":
            raise ValueError(
                f"{network.name(place)} is {what}, which feeds nothing; name a tank, an open end or a unit"
            )
    return tuple(places)


class _Closing:
    """What is reached before and after.

    Args:
        network: of the graph.
        closed: ids of the valves.
        given: ids of the sources, or None.
    """

    def __init__(self, network: Network, closed: tuple[str, ...], given: tuple[str, ...] | None) -> None:
        self.network = network
        self.closed = closed
        # One on the side of a run closes what lies behind it, not the run.
        self.barriers = tuple(place for place in closed if not network.stands_aside(place))
        self.given = given
        self.sure_sources, self.likely_sources = (given, ()) if given is not None else self._sources()
        self.sources = (*self.sure_sources, *self.likely_sources)
        self.unsure = {place: why for place in closed if (why := self._why_unsure(place)) is not None}

    def answer(self) -> WhatIf:
        before = self._reach(self.sources, ())
        after = self._reach(self.sources, self.barriers)
        shut_for_sure = [place for place in self.barriers if place not in self.unsure]
        after_for_sure = self._reach(self.sources, shut_for_sure)
        loosely_fed = self._reach(self.sure_sources, self.barriers)
        surely_fed = self._reach(self.sure_sources, self.barriers, self._surely_follows)
        behind = self._behind() - set(self.closed)
        cut = before - after - set(self.closed)
        turned = self._where_flow_turns(cut, after)
        driven = (cut - turned) & self._driven_round(cut)
        backed = self._where_tanks_run_back(cut - turned - driven)
        cut -= turned | driven | backed
        doubted = [self.network.name(place) for place in self.unsure if place in self.barriers]
        depends = f"only if {' and '.join(doubted)} really shuts"
        cut_off = tuple(self._told(p, depends if p in after_for_sure else "") for p in self._by_tag(cut))
        run_dry = tuple(one for one in cut_off if self.network.unit_type(one.place) == "pump")
        open_ones = (behind - cut) - surely_fed - set(self.sure_sources) - turned - driven - backed
        # Through a valve on the way to a blind end nothing is filled.
        filled = self._behind(lambda arc: self._follows(arc) and not self.network.is_dead(arc))
        not_refilled, perhaps_filled = self._not_refilled(filled, self.barriers)
        surely_not_refilled, _ = self._not_refilled(filled, shut_for_sure)
        surely_dead_headed = self._dead_headed(shut_for_sure)
        return WhatIf(
            closed=tuple(map(self.network.name, self.closed)),
            sources=tuple(map(self.network.name, self._by_tag(self.sources))),
            cut_off=cut_off,
            unknown=(
                *(self._told(p, self._why_open(p in before, p in loosely_fed)) for p in self._by_tag(open_ones)),
                *(self._told(p, _TURNS) for p in self._by_tag(turned)),
                *(self._told(p, _ROUND) for p in self._by_tag(driven)),
                *(self._told(p, _BACK) for p in self._by_tag(backed)),
                *(self._told(p, _FILLED) for p in self._by_tag(perhaps_filled)),
            ),
            still_fed=tuple(self._told(p) for p in self._by_tag((behind & surely_fed) - set(self.sources))),
            not_refilled=tuple(
                self._told(p, "" if p in surely_not_refilled else depends) for p in self._by_tag(not_refilled)
            ),
            dead_headed=tuple(
                self._told(p, self._why_dead_headed(p, "" if p in surely_dead_headed else depends))
                for p in self._by_tag(self._dead_headed(self.barriers))
            ),
            run_dry=run_dry,
            doubts=self._doubts(cut),
            assumptions=self._assumptions(),
            remarks=(*self._remarks(before), *map(would_run_dry, run_dry)),
        )

    # What feeds

    def _sources(self) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """What feeds the pieces of the network that hold a closed valve: what surely does, and what may do so."""
        sure: list[str] = []
        likely: list[str] = []
        done: set[str] = set()
        for place in self.closed:
            if place in done:
                continue
            piece = self._reach((place,), (), lambda arc: True)
            done |= piece
            ordered = [p for p in self.network.places if p in piece]
            ends = [p for p in ordered if self._may_feed(p)]
            feeding = [p for p in ends if any(arc.flow == "along" for arc in self.network.arcs(p))]
            tanks = [p for p in ordered if self.network.unit_type(p) == "tank"]
            sure += [*tanks, *feeding]
            likely += [p for p in ends if p not in feeding]
            if not tanks and not ends:
                sure += [p for p in ordered if self.network.unit_type(p) == "pump"]
        return tuple(sure), tuple(likely)

    def _may_feed(self, place: str) -> bool:
        """Whether a node is an end of pipe that isn't blind and not known to be an outlet."""
        node = self.network.places[place]
        if not isinstance(node, Terminal) or node.kind == "blind":
            return False
        return any(arc.flow != "against" for arc in self.network.arcs(place))

    # Walking

    def _reach(self, starts: Iterable[str], blocked: Collection[str], follows: Follow | None = None) -> set[str]:
        """All that is reached from some nodes, these included, but not through those that are blocked."""
        walks = follows or self._follows
        seen = {place for place in starts if place not in blocked}
        waiting = list(seen)
        while waiting:
            for arc in self.network.arcs(waiting.pop()):
                if arc.end not in seen and arc.end not in blocked and walks(arc):
                    seen.add(arc.end)
                    waiting.append(arc.end)
        return seen

    def _behind(self, follows: Follow | None = None) -> set[str]:
        """All that may have been fed through the closed valves; what lies behind a source it feeds itself."""
        feeding, walks = set(self.sure_sources), follows or self._follows
        return self._reach(self.barriers, (), lambda arc: arc.start not in feeding and walks(arc))

    def _follows(self, arc: Arc) -> bool:
        return arc.flow != "against" or self.network.is_tap(arc)

    def _may_follow(self, arc: Arc) -> bool:
        """Whether something may flow along a connection, be it that the flow turns there."""
        if self._follows(arc):
            return True
        return arc.index in self._meshed and not (self._one_way(arc.start) or self._one_way(arc.end))

    def _where_flow_turns(self, cut: Collection[str], fed: Collection[str]) -> set[str]:
        """Of what is cut off, what may be fed against the flow as it was, and not only filled as a blind end is."""
        reached = self._reach(self.sources, self.barriers, self._may_follow).intersection(cut)
        found: set[str] = set()
        while reached:
            piece = self._reach((next(iter(reached)),), (), lambda arc: arc.end in reached)  # noqa: B023
            reached -= piece
            ways = [arc for place in piece for arc in self.network.arcs(place) if arc.end in fed]
            if len(ways) > 1 or any(self._lets_out(p) or self.network.unit_type(p) == "pump" for p in piece):
                found |= piece
        return found

    def _where_tanks_run_back(self, cut: Collection[str]) -> set[str]:
        """Of what is cut off, the pieces with an open end to which a tank may run back, against the flow as it was; not
        through a pump or a check valve.
        """
        tanks = [place for place in self.network.places if self.network.unit_type(place) == "tank"]
        reached = self._reach(tanks, self.barriers, self._may_run_back).intersection(cut)
        found: set[str] = set()
        while reached:
            piece = self._reach((next(iter(reached)),), (), lambda arc: arc.end in reached)  # noqa: B023
            reached -= piece
            found |= piece if any(self._lets_out(place) for place in piece) else set()
        return found

    def _may_run_back(self, arc: Arc) -> bool:
        return self._follows(arc) or not (self._one_way(arc.start) or self._one_way(arc.end))

    def _lets_out(self, place: str) -> bool:
        node = self.network.places[place]
        open_end = isinstance(node, Terminal) and node.kind != "blind"
        return open_end or self.network.unit_type(place) == "tank"

    def _one_way(self, place: str) -> bool:
        return self.network.unit_type(place) == "pump" or duty_of(self.network, place) == "check"

    @cached_property
    def _meshed(self) -> frozenset[int]:
        """The connections in loops, where which way it flows depends on what else is open; tanks divide loops."""
        import networkx

        joined: networkx.MultiGraph[str] = networkx.MultiGraph()
        numbers: dict[frozenset[str], list[int]] = {}
        for place in self.network.places:
            for arc in self.network.arcs(place):
                if arc.forward:
                    ends = [f"{end} {arc.index}" if self.network.unit_type(end) == "tank" else end
                            for end in (arc.start, arc.end)]  # fmt: skip
                    joined.add_edge(*ends)
                    numbers.setdefault(frozenset(ends), []).append(arc.index)
        bridges = {index for ends in networkx.bridges(joined) for index in numbers[frozenset(ends)]}
        return frozenset(index for found in numbers.values() for index in found).difference(bridges)

    def _driven_round(self, cut: Collection[str]) -> set[str]:
        """What lies in a loop with a pump, all along known flow, that no closed valve divides."""
        found: set[str] = set()
        for pump in (place for place in cut if self.network.unit_type(place) == "pump"):
            behind = self._reach((pump,), self.barriers, lambda arc: self._follows(arc.back))
            for arc in self.network.arcs(pump):
                if arc.flow == "along" and arc.end not in self.barriers:
                    ahead = self._reach((arc.end,), self.barriers)
                    found |= ahead & behind if pump in ahead else set()
        return found

    def _surely_follows(self, arc: Arc) -> bool:
        # Through a relief valve nothing flows as a rule, so that nothing counts as fed through one; past it, it does.
        if duty_of(self.network, arc.start) == "relief" and not self.network.stands_aside(arc.start):
            return False
        return arc.flow == "along" or self.network.is_tap(arc) or self.network.is_dead(arc)

    def _by_tag(self, places: Iterable[str]) -> list[str]:
        """Units and ends in the order of tags; junctions and blind ends are nothing to tell."""
        nodes = {place: self.network.places[place] for place in set(places)}
        told = [p for p, n in nodes.items() if isinstance(n, Unit) or (isinstance(n, Terminal) and n.kind != "blind")]
        return sorted(told, key=lambda place: (tag_key(self.network.name(place)), place))

    # What is told

    def _told(self, place: str, why: str = "") -> Consequence:
        return Consequence(place, self.network.name(place), self.network.what(place), why)

    def _why_unsure(self, place: str) -> str | None:
        """Why nobody can be sure that a valve can be shut."""
        if joins_more(self.network, place):
            return "joins more than two lines: such a valve leaves one open as a rule"
        why = _NOT_SHUT.get(duty_of(self.network, place) or "other")
        likely = likely_kinds(self.network, place)
        return f"{why} (likeliest: {likely})" if why and likely else why

    def _why_open(self, fed_before: bool, loosely_fed: bool) -> str:
        if not fed_before:
            return "no source was found to feed it even with all valves open"
        if loosely_fed:
            return "the ways left to it lead over pipes of unknown direction, or through a relief valve"
        return "the ways left to it come from ends of which nobody knows whether they feed"

    def _not_refilled(self, filled: Collection[str], barriers: Collection[str]) -> tuple[list[str], list[str]]:
        """Of the tanks among what was filled through closed valves, those that nothing fills with some valves shut, and
        those that something may.
        """
        nothing: list[str] = []
        perhaps: list[str] = []
        for place in self.sources:
            if place not in filled or not isinstance(self.network.places[place], Unit):
                continue
            others = [other for other in self.sources if other != place]
            if place not in self._reach(others, ()):
                continue
            if place not in self._reach(others, barriers):
                nothing.append(place)
            elif place not in self._reach({*self.sure_sources} - {place}, barriers, self._surely_follows):
                perhaps.append(place)
        return nothing, perhaps

    def _dead_headed(self, barriers: Collection[str]) -> list[str]:
        pumps = [p for p in self.network.places if self.network.unit_type(p) == "pump"]
        return [p for p in pumps if self._delivers(p, ()) and not self._delivers(p, barriers)]

    def _delivers(self, pump: str, blocked: Collection[str]) -> bool:
        """Whether a pump has a way to a tank or an end, or round to itself; none through a relief valve counts."""
        barred = {*blocked, *self._reliefs_in_line}
        return any(map(self._lets_out, self._reach((pump,), barred))) or self._goes_round(pump, barred)

    def _goes_round(self, pump: str, barred: Collection[str]) -> bool:
        """Whether what leaves a pump comes back to it by another of its connections."""
        arcs = self.network.main_arcs(pump)
        return any(
            other.index != arc.index and other.end in found
            for arc in arcs
            if self._follows(arc) and (found := self._reach((arc.end,), {*barred, pump}))
            for other in arcs
            if self._follows(other.back)
        )

    @cached_property
    def _reliefs(self) -> tuple[str, ...]:
        return tuple(p for p in self.network.places if duty_of(self.network, p) == "relief")

    @cached_property
    def _reliefs_in_line(self) -> tuple[str, ...]:
        """The relief valves that something would have to flow through; one on the side of a run is passed by."""
        return tuple(p for p in self._reliefs if not self.network.stands_aside(p))

    def _why_dead_headed(self, pump: str, why: str) -> str:
        near = self._reach((pump,), self.barriers)
        reliefs = [self.network.name(place) for place in self._by_tag(self._reliefs) if place in near]
        opens = f"until {' or '.join(reliefs)} relieves it, if it is set to" if reliefs else ""
        return ", ".join(filter(None, (why, opens)))

    def _doubts(self, cut: Collection[str]) -> tuple[Doubt, ...]:
        pieces = [place for place in self.network.places if place in cut]
        found = [
            *unshown(self.network),
            *open_sides(self.network, self.closed),
            *open_sides(self.network, pieces, "feeds"),
        ]
        # A joint between a closed valve and what it cuts off changes nothing.
        inner = {*self.closed, *cut}
        return tuple(
            doubt
            for doubt in dict.fromkeys(found)
            if not doubt.parts or any(self.network.owner_of_part(part) not in inner for part in doubt.parts)
        )

    def _assumptions(self) -> tuple[str, ...]:
        told = [ALL_RUN]
        if self.given is not None:
            told.append("only the sources that were given feed")
        elif not self.sources:
            told.append(
                "nothing that could feed was found here, neither a tank nor an end nor a pump; name the sources"
            )
        elif all(self.network.unit_type(place) == "pump" for place in self.sources):
            told.append("as no tank and no end that could feed was found, pumps count as sources")
        else:
            told.append("tanks and ends not known to be outlets feed; pumps only pass on")
        told.append("this is about flow: what is cut off may still be under pressure; isolate says what isolates it")
        return tuple(told)

    def _remarks(self, before: Collection[str]) -> tuple[str, ...]:
        name = self.network.name
        told = [f"{name(place)} {why}" for place, why in self.unsure.items()]
        told += [
            f"{self.network.name(place)} is of open kind, but likely shuts off ({likely_kinds(self.network, place)})"
            for place in self.closed
            if duty_of(self.network, place) == "likely"
        ]
        told += [
            f"{self.network.name(place)} stands on the side of a run, which it does not close: only what lies behind it"
            for place in self.closed
            if place not in self.barriers
        ]
        told += [
            f"{name(place)} blocks the relief valve {name(relief)}, which then protects nothing"
            for place in self.closed
            for relief in blocked_relief(self.network, place)
        ]
        unfed = [self.network.name(place) for place in self.closed if place not in before]
        told += [
            f"no source was found to feed {name} in the first place: what it cuts off isn't known" for name in unfed
        ]
        return tuple(told)
