"""Which valves cut a unit off: the first question before anybody opens it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from cadgraph._io.text import tag_key
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Terminal
from cadgraph.query.doubt import Doubt, few_ports, open_sides, unshown
from cadgraph.query.duty import (
    blocked_relief,
    duty_of,
    is_doubted,
    joins_more,
    likely_kinds,
    suspect_of,
    worked_by_hand,
)
from cadgraph.query.lines import find_lines
from cadgraph.query.network import Network
from cadgraph.query.section import Reached, Rules, Section, close_off, is_fed, is_source, lets_through

__all__ = ["Closing", "Isolation", "Opening", "Passed", "find_isolation"]

PASSED_OVER = "is a check valve: passed over"


_AS_VALVE = "taken for a valve, but nobody is sure of its body: a filter or a meter may look so"
_INTO_IT = "a relief valve that lets into this section what lies behind it: it opens by itself"
_EITHER_WAY = (
    "a relief valve, and nobody knows which way: it may let into this section what lies behind it, and opens by itself"
)
_THREE_LINES = "joins more than two lines, so that it leaves one open as a rule"
_AS_RELIEF = (
    "taken for a relief valve and so for closed, yet it has a lever or wheel and no line behind it: were it a hand "
    "valve to the open, it would have to be closed, too"
)


@dataclass(frozen=True)
class Closing:
    """A valve to close.

    Args:
        place: its id.
        name: its tag.
        what: its kind, or ``valve``.
        port: nozzle of the unit that it is reached by.
        distance: along the pipes from the unit [m].
        line: tag of the line that it stands in, on the side of the unit.
        automatic: whether it is a check valve, which closes by itself.
        likely: where its kind is open, the kinds that it may be, all of which shut off, with how sure each is; else
            empty.
    """

    place: str
    name: str
    what: str
    port: str | None
    distance: float
    line: str | None
    automatic: bool = False
    likely: str = ""


@dataclass(frozen=True)
class Passed:
    """A valve on a way to the unit that is not relied on, as nobody knows whether it shuts off.

    Args:
        place: its id.
        name: its tag.
        what: its kind, or ``valve``.
        port: nozzle of the unit that it is reached by.
        distance: along the pipes from the unit [m].
        line: tag of the line that it stands in, on the side of the unit.
        why: why it isn't relied on, in words.
    """

    place: str
    name: str
    what: str
    port: str | None
    distance: float
    line: str | None
    why: str


@dataclass(frozen=True)
class Opening:
    """A way to the unit that no valve closes.

    Args:
        place: id of where it leads.
        name: tag of that.
        what: what that is.
        port: nozzle of the unit that it is reached by.
        distance: along the pipes from the unit [m].
        why: what is wrong with it, in words.
        other_ports: the unit's other nozzles from which a way leads there that no valve closes.
    """

    place: str
    name: str
    what: str
    port: str | None
    distance: float
    why: str
    other_ports: tuple[str, ...] = ()

    @property
    def ports(self) -> tuple[str, ...]:
        """All nozzles of the unit that it is reached by, the nearest first."""
        return (self.port, *self.other_ports) if self.port else ()


@dataclass(frozen=True)
class Isolation:
    """The answer.

    Args:
        target: id of what is to be isolated.
        name: its tag.
        valves: to close, the nearest first.
        openings: what can't be isolated.
        doubts: what may feed the unit without having been found: units of the section with fewer lines than their kind
            needs, and joints at it that were not made although much speaks for them.
        shut_off: ids of the units that lie in the isolated section too, the nearest first; valves that need not be
            closed are open and lie in it with what is behind them.
        shut_off_names: their tags.
        lines: tags of the lines in the section, wholly or in part.
        connections: numbers of the graph's connections in the section.
        remarks: what the reader should know, a sentence each.
        passed: valves that are not relied on, the nearest first; the section goes on behind them.
    """

    target: str
    name: str
    valves: tuple[Closing, ...]
    openings: tuple[Opening, ...]
    doubts: tuple[Doubt, ...]
    shut_off: tuple[str, ...]
    shut_off_names: tuple[str, ...]
    lines: tuple[str, ...]
    connections: tuple[int, ...]
    remarks: tuple[str, ...]
    passed: tuple[Passed, ...] = ()

    @property
    def isolated(self) -> bool | None:
        """Whether the valves isolate the unit wholly; None where nobody can tell."""
        if self.openings:
            return False
        return None if self.doubts else True


def find_isolation(
    graph: SceneGraph | Network,
    target: str,
    *,
    check_valves: bool = False,
    fewest: bool = False,
    assume_shutoff: bool = False,
) -> Isolation:
    """The valves that isolate a unit, on every one of its ports.

    By default the nearest valve on every way out, so that as little as possible is shut off with it; a valve behind
    which nothing can flow (a blind end, an instrument) need not be closed, one of which only one side is known must.
    Only valves count that are known to shut off by their kind, or whose kind is open between kinds that all do; those
    of unknown kind are passed and named apart. Check and control valves never count, relief valves are taken for
    closed and never asked to be blocked. A tank is a source: the section ends there, valve or not.

    Args:
        graph: the finished graph, or its network.
        target: tag or id.
        check_valves: whether a check valve counts that the flow leaves the unit through.
        fewest: rather the smallest set of valves (a minimum node cut between the unit and all tanks and open ends),
            the nearest of those, although it may shut off more.
        assume_shutoff: whether valves of unknown kind count too. Each that does is a doubt: it may be a check valve.

    Raises:
        Unconnected: no line was found at the unit, which is a ``ValueError``: that doesn't say that nothing feeds it.
        ValueError: nothing is called so.
    """
    network = graph if isinstance(graph, Network) else Network(graph)
    start = network.find(target)
    if not network.arcs(start):
        raise network.unconnected(start, "what isolates it")
    section = close_off(network, start, Rules(network, check_valves, assume_shutoff), fewest)
    line_of = {arc.index: line.tag for line in find_lines(network) for arc in line.arcs}
    apart = {*section.needed, start}
    inside = [p for p in section.left if network.unit_type(p) not in (None, "tank") and p not in apart]
    doubted = [place for place in _own(network, section) if place not in section.needed]
    return Isolation(
        target=section.start,
        name=network.name(section.start),
        valves=tuple(
            _closing(network, place, section.reached[place], line_of)
            for place in section.nearest
            if place in section.needed
        ),
        openings=tuple(
            opening for place in section.inside() if (opening := _opening(network, section, place)) is not None
        ),
        doubts=(*unshown(network), *_assumed(network, section), *open_sides(network, doubted, "feeds")),
        shut_off=tuple(inside),
        shut_off_names=tuple(network.name(place) for place in inside),
        lines=_lines(network, section, line_of),
        connections=_connections(network, section),
        remarks=_remarks(network, section, check_valves),
        passed=tuple(
            passed for place in section.inside() if (passed := _passed(network, section, place, line_of)) is not None
        ),
    )


def _own(network: Network, section: Section) -> list[str]:
    """The nodes of a section, the start first, without tanks beside it, whose other lines don't belong to it."""
    return [section.start, *(place for place in section.left if network.unit_type(place) != "tank")]


def _lines(network: Network, section: Section, line_of: Mapping[int, str]) -> tuple[str, ...]:
    """The tags of the lines of a section; the pipes at a tank beside it don't belong to it."""
    tags = {line_of[index] for index in _connections(network, section) if index in line_of}
    return tuple(sorted(tags, key=tag_key))


def _connections(network: Network, section: Section) -> tuple[int, ...]:
    return tuple(sorted({arc.index for place in _own(network, section) for arc in network.arcs(place)}))


def _closing(network: Network, place: str, reached: Reached, line_of: Mapping[int, str]) -> Closing:
    duty = duty_of(network, place)
    return Closing(
        place=place,
        name=network.name(place),
        what=network.what(place),
        port=reached.port,
        distance=reached.distance,
        line=line_of.get(reached.arc.index),
        automatic=duty == "check",
        likely=likely_kinds(network, place) if duty == "likely" else "",
    )


def _passed(network: Network, section: Section, place: str, line_of: Mapping[int, str]) -> Passed | None:
    """A valve of the section that might have ended it, if that is one."""
    reached = section.reached[place]
    duty = duty_of(network, place)
    if place in section.needed or duty not in ("unknown", "other") or network.is_tap(reached.arc):
        return None
    return Passed(
        place=place,
        name=network.name(place),
        what=network.what(place),
        port=reached.port,
        distance=reached.distance,
        line=line_of.get(reached.arc.index),
        why=_unknown(network, place) if duty == "unknown" else _unlike(network, place),
    )


def _unlike(network: Network, place: str) -> str:
    """Why a valve of a known kind isn't relied on."""
    return _THREE_LINES if joins_more(network, place) else "not known to shut off"


def _unknown(network: Network, place: str) -> str:
    """Why a valve of unknown kind isn't relied on."""
    suspect = suspect_of(network, place)
    if suspect is not None:
        pump, other = network.name(suspect.pump), network.name(suspect.valve)
        if suspect.outermost:
            return f"kind not known; right behind {pump}, with {other} behind it: likely a check valve"
        return (
            f"kind not known; nothing to turn was found at it, as it was at {other} between it and {pump}: "
            "likely a check valve"
        )
    likely = likely_kinds(network, place)
    return f"kind not known, may be {likely}" if likely else "kind not known"


def _assumed(network: Network, section: Section) -> list[Doubt]:
    """The valves to close of which nobody knows whether they shut off, and the relief valves that may be none."""
    needed = [place for place in section.nearest if place in section.needed]
    unknown = [place for place in needed if duty_of(network, place) == "unknown"]
    reliefs = [place for place in section.nearest if _is_closed_relief(network, section, place)]
    doubted = [
        Doubt(place, network.name(place), why)
        for place in reliefs
        if (why := _why_doubted(network, section, place)) is not None
    ]
    return [
        *(Doubt(p, network.name(p), f"{_unknown(network, p)}; taken for a shut-off valve as asked") for p in unknown),
        *(Doubt(p, network.name(p), _AS_VALVE) for p in needed if p not in unknown and is_doubted(network, p)),
        *doubted,
    ]


def _why_doubted(network: Network, section: Section, relief: str) -> str | None:
    """Why a relief valve that a section ends at may let something into it; None where it doesn't."""
    if worked_by_hand(network, relief) or relief in network.doubted:
        return _AS_RELIEF
    if relief not in section.walls or not is_fed(network, section.start, relief, section.region, section.walls):
        return None
    way = lets_through(network, section.reached[relief].arc)
    return None if way == "along" else _INTO_IT if way == "against" else _EITHER_WAY


def _is_closed_relief(network: Network, section: Section, place: str) -> bool:
    """Whether a section ends at a relief valve, which is taken for closed."""
    ends = place in section.walls or network.stands_aside(place)
    return ends and duty_of(network, place) == "relief"


def _opening(network: Network, section: Section, place: str) -> Opening | None:
    node = network.places[place]
    valves = (step for step in section.way(place) if network.is_valve(step) and not network.stands_aside(step))
    passed = ", ".join(network.name(step) for step in valves)
    known = f" that is known to shut off (the nearest way there: {passed})" if passed else ""
    before = f"no valve before it{known}"
    if network.unit_type(place) == "tank":
        why = f"no valve between{known}; empty it, or isolate it as well"
    elif isinstance(node, Terminal) and node.kind == "open":
        why = f"open end with {before}"
    elif isinstance(node, Terminal) and node.kind == "unknown":
        why = f"end of the modelled pipe with {before}; what follows is not known"
    else:
        return None
    reached = section.reached[place]
    others = tuple(port for port in section.ports_to.get(place, ()) if port != reached.port)
    return Opening(place, network.name(place), network.what(place), reached.port, reached.distance, why, others)


def _remarks(network: Network, section: Section, check_valves: bool) -> tuple[str, ...]:
    places = sorted((section.region | section.walls) - {section.start}, key=lambda place: tag_key(network.name(place)))
    told = [
        f"{network.name(place)} {remark}"
        for place in places
        if (remark := _remark(network, section, place, check_valves)) is not None
    ]
    told += [
        f"{network.name(place)} blocks the relief valve {network.name(relief)}, which then protects nothing"
        for place in sorted(section.needed, key=lambda place: tag_key(network.name(place)))
        for relief in blocked_relief(network, place)
    ]
    pumps = sorted((network.name(p) for p in section.left if network.unit_type(p) == "pump"), key=tag_key)
    if pumps:
        told.append(f"{', '.join(pumps)} shut in with it: stop what runs before a valve is closed")
    if not section.needed and not any(is_source(network, place) for place in section.left):
        told.append(
            "nothing was found that fills or empties this section: what it holds, and under what pressure, nobody knows"
        )
    likely = sorted((network.name(p) for p in section.needed if duty_of(network, p) == "likely"), key=tag_key)
    if likely:
        told.append(f"{', '.join(likely)}: kind only likely; all that it may be shuts off")
    return tuple(told)


def _remark(network: Network, section: Section, place: str, check_valves: bool) -> str | None:
    """What should be known about a node of the section or at its end, if anything."""
    duty, arc = duty_of(network, place), section.reached[place].arc
    if _is_closed_relief(network, section, place):
        return "is a relief valve: taken for closed, not to be blocked"
    if place in section.walls or place in section.needed:
        if few_ports(network, place) is not None:
            return "has a line on one side only: what lies behind it is not known"
        needless = place not in section.needed and not network.is_tap(arc)
        return "need not be closed: nothing was found behind it that could flow" if needless else None
    if duty == "check" and not check_valves:
        return PASSED_OVER
    if duty == "check" and not (network.stands_aside(place) or lets_through(network, arc)):
        return "is a check valve, but which way it lets through is not known"
    if duty == "control":
        return f"is a {network.what(place)}: not counted as isolating"
    return None
