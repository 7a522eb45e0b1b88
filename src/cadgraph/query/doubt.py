"""What an answer about lines can't be sure of: lines that a unit should have, and joints that were not made."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from cadgraph._io.manifest import LACKING
from cadgraph.model.ports import least_ports, port_word
from cadgraph.model.records import Joint, Part, Port, Unit
from cadgraph.query.against import Against, is_gauge_by_place, standing_against
from cadgraph.query.network import Network

__all__ = [
    "Doubt",
    "bare_nozzles",
    "few_ports",
    "likely_joints",
    "mounted_words",
    "open_sides",
    "unconnected",
    "unshown",
]

# From this score on a joint that was not made makes an answer doubtful (ours): one in ten of such joins after all,
# which is too much to open a pump on.
_LIKELY = 0.1
_NUMBERS = ("no", "one", "two", "three")
# What a nozzle goes on in until a line begins, and what closes it, by their labels.
_NOZZLE = frozenset({"nozzle", "flange", "gasket"})
_CLOSURES = frozenset({"blind flange", "pipe cap"})
_NEAR = 0.01  # [m]; so near to a nozzle a line that joins there begins, or nearer than a quarter of its bore

_BY_PLACE = "taken for a {} because one line ends at it; by its shape it may be something else that leads to the open"

_AS_DRAWN = "the plant that this drawing was written from goes on here, maybe: its own graph says how"

About = Literal["feeds", "follows"]


@dataclass(frozen=True)
class Doubt:
    """Something that would change an answer if it were so.

    Args:
        place: id of the unit, junction or terminal that it is at, or that the line there starts from; empty for the
            whole graph.
        name: its tag.
        text: what it is, in words.
        parts: ids of the two parts that are not joined; empty for a unit that has too few lines.
        gap: between these [m], or None.
        score: how sure it is that they join, or None.
    """

    place: str
    name: str
    text: str
    parts: tuple[str, ...] = ()
    gap: float | None = None
    score: float | None = None


def open_sides(network: Network, places: Collection[str], about: About = "follows") -> tuple[Doubt, ...]:
    """What may lead out of a piece of a network without having been found.

    Args:
        network: of a finished graph.
        places: ids of the nodes of the piece; the connections at them belong to it.
        about: whether the answer is about what ``feeds`` them or what ``follows``.

    Returns:
        Units that have fewer lines than their kind needs, in the order of the places; nozzles without a line, likewise;
        gauges that are taken for some only because one line ends there; joints that were not made although they are
        likely, between a part of the piece and one outside, the likeliest first; then what else stands against the
        piece: units with too few lines, and ends of other lines.
    """
    short = [doubt for place in places if (doubt := _short(network, place, about)) is not None]
    told = {doubt.place for doubt in short}
    bare = [doubt for place in places if place not in told for doubt in _bare(network, place, about)]
    home = _home_of_parts(network, places)
    unjoined = list(_unjoined(network, home, about))
    joined = {network.owner_of_part(doubt.parts[1]) for doubt in unjoined}
    found = standing_against(network, home, places)
    against = [one for one in found if one.place is None or one.place not in joined]
    guessed = [place for place in places if place not in told and is_gauge_by_place(network, place)]
    ends = [Doubt(place, network.name(place), _BY_PLACE.format(network.what(place))) for place in guessed]
    ends += [Doubt(place, network.name(place), _AS_DRAWN) for place in places if place in network.doubted]
    return (*short, *bare, *ends, *unjoined, *(_stands_against(network, home, one, about) for one in against))


def unshown(network: Network) -> tuple[Doubt, ...]:
    """The doubts that stand against every answer of a graph to which corrections were made that it doesn't show, or
    whose source has changed since.
    """
    graph = network.graph
    told = (LACKING if graph.lacks_corrections else "", graph.changed_source)
    return tuple(Doubt("", "graph", text) for text in told if text)


def few_ports(network: Network, place: str) -> tuple[int, int] | None:
    """How many ports of a unit have a line and how many its kind needs; None where that is enough, or it is no unit.

    A gauge at the end of a line that is too wide for a tap needs a second one: it stands in the line, or is no gauge.
    """
    node = network.places[place]
    if not isinstance(node, Unit):
        return None
    used, least = network.ports_in_use(place), least_ports(node.unit_type, node.kind)
    if network.ends_line(place):
        least = 2
    return (used, least) if used < least else None


def bare_nozzles(network: Network, place: str) -> list[tuple[str, ...]]:
    """The nozzles of a unit at which no line was found and that nothing closes, each as the ids of its parts.

    Args:
        network: of a finished graph.
        place: id of a node; what is no unit has none.

    Returns:
        In the order of the unit's parts; what is labelled otherwise than a nozzle is not seen.
    """
    unit = network.places[place]
    if not isinstance(unit, Unit) or port_word(unit.unit_type) != "nozzle":
        return []
    found: list[tuple[str, ...]] = []
    seen: set[str] = set()
    for part in unit.parts:
        if part in seen or _name(network.graph.part(part)) != "nozzle":
            continue
        pieces, closed = _nozzle_at(network, part)
        seen.update(pieces)
        if not closed and not any(_starts_at(port, piece) for port in unit.ports for piece in pieces.values()):
            found.append(tuple(piece for piece in unit.parts if piece in pieces))
    return found


def unconnected(network: Network) -> dict[str, tuple[str, ...]]:
    """Tags of the units at which no line was found, in the order of the file, with those of what each is mounted at."""
    return {
        node.tag: tuple(network.name(unit) for unit in network.mounted_at(place))
        for place, node in network.places.items()
        if isinstance(node, Unit) and not network.arcs(place)
    }


def mounted_words(without_line: Mapping[str, Sequence[str]]) -> list[str]:
    """Units without a line in words, with what they are mounted at: ``G-001 (at T-001)``.

    Args:
        without_line: as ``unconnected`` gives them.
    """
    return [f"{tag} (at {' or '.join(at)})" if at else tag for tag, at in without_line.items()]


def likely_joints(network: Network) -> list[Joint]:
    """The joints that were not made although they are likely, the likeliest first."""
    found = [joint for joint in network.open_joints if joint.score >= _LIKELY]
    return sorted(found, key=lambda joint: (-joint.score, joint.first, joint.second, joint.point))


def _short(network: Network, place: str, about: About) -> Doubt | None:
    few, node = few_ports(network, place), network.places[place]
    if few is None or not isinstance(node, Unit):
        return None
    used, least = few
    if network.ends_line(place):
        size = max(network.arcs(place)[0].sizes)
        unsaid = "what feeds it from behind" if about == "feeds" else "whether it goes on behind that"
        return Doubt(
            place, node.tag, f"a {network.what(place)} at the end of a line of DN {size}: {unsaid} can't be told"
        )
    noun, others = port_word(node.unit_type), "the other" if least - used == 1 else "the others"
    has = "has a line" if used == 1 else "have a line"
    unsaid = f"what feeds {others}" if about == "feeds" else f"where {others} {_lead(least - used)}"
    only = "none" if used == 0 else f"only {_NUMBERS[used]}"
    return Doubt(place, node.tag, f"{only} of its {_NUMBERS[least]} {noun}s {has}: {unsaid} can't be told")


def _bare(network: Network, place: str, about: About) -> Iterator[Doubt]:
    for nozzle in bare_nozzles(network, place):
        unsaid = "what feeds it there" if about == "feeds" else "where it leads"
        yield Doubt(place, network.name(place), f"its nozzle {nozzle[0]} has no line: {unsaid} can't be told")


def _name(part: Part) -> str | None:
    return None if part.label is None else part.label.name


def _nozzle_at(network: Network, part: str) -> tuple[dict[str, Part], bool]:
    """The pieces of a nozzle, its flange included, and whether something closes it."""
    pieces = {part: network.graph.part(part)}
    closed, waiting = False, [part]
    while waiting:
        for other in network.graph.neighbors(pieces[waiting.pop()]):
            name = _name(other)
            closed = closed or name in _CLOSURES
            if name in _NOZZLE and other.id not in pieces:
                pieces[other.id] = other
                waiting.append(other.id)
    return pieces, closed


def _starts_at(port: Port, piece: Part) -> bool:
    """Whether a line that joins at a port begins at a piece of a nozzle."""
    point, (low, high) = np.asarray(port.point), np.asarray(piece.aabb)
    reach = max(_NEAR, 0.25 * (port.diameter or 0.0))
    return bool(np.linalg.norm(np.clip(point, low, high) - point) <= reach)


def _lead(count: int) -> str:
    return "leads" if count == 1 else "lead"


def _unjoined(network: Network, home: Mapping[str, str], about: About) -> Iterator[Doubt]:
    for joint in likely_joints(network):
        if (joint.first in home) == (joint.second in home):
            continue
        inner, outer = (joint.first, joint.second) if joint.first in home else (joint.second, joint.first)
        place = home[inner]
        unsaid = "what feeds it there" if about == "feeds" else "what follows there"
        text = f"{_faces(network, joint, inner, outer)}: {unsaid} can't be told"
        yield Doubt(place, network.name(place), text, (inner, outer), joint.gap, joint.score)


def _faces(network: Network, joint: Joint, inner: str, outer: str) -> str:
    beyond = network.owner_of_part(outer)
    where = f"{network.name(beyond)} ({outer})" if beyond is not None else outer
    apart = f"{1000 * joint.gap:.1f} mm from" if joint.gap > 0 else "against"
    return f"{inner} lies {apart} {where} and is not joined to it ({joint.score:.0%} sure that it is)"


def _stands_against(network: Network, home: Mapping[str, str], found: Against, about: About) -> Doubt:
    place = home[found.inner]
    unsaid = "what feeds it there" if about == "feeds" else "what follows there"
    over = f" over {', '.join(found.over)}" if found.over else ""
    text = f"{_outside(network, found)} {found.inner}{over} and nothing is known to join them: {unsaid} can't be told"
    return Doubt(place, network.name(place), text, (found.inner, found.part))


def _may_be(part: Part) -> str:
    """What a part is likely, or perhaps where it has no label, in words."""
    if part.label is not None:
        return f"likely {part.label.name or part.label.group}"
    best = max(part.guesses, key=lambda guess: guess.confidence)
    return f"without a label, perhaps {best.name or best.group}"


def _outside(network: Network, found: Against) -> str:
    """What stands against a piece, in words."""
    if found.place is None:
        return f"{found.part} ({_may_be(network.graph.part(found.part))}), in no network, stands against"
    node = network.places[found.place]
    if not isinstance(node, Unit):
        return f"{network.what(found.place)} {network.name(found.place)} of another line lies at"
    if network.is_gauge(found.place):
        return f"{node.tag}, taken for a {network.what(found.place)} because one line ends at it, stands against"
    used, least = network.ports_in_use(found.place), least_ports(node.unit_type, node.kind)
    few = f"only {_NUMBERS[used]}" if used else "none"
    return f"{node.tag}, {few} of whose {_NUMBERS[least]} {port_word(node.unit_type)}s has a line, stands against"


def _home_of_parts(network: Network, places: Iterable[str]) -> Mapping[str, str]:
    """Of each part of a piece of a network, the node that it belongs to or that its line starts from."""
    home: dict[str, str] = {}
    for place in places:
        for arc in network.arcs(place):
            for part in arc.via:
                home.setdefault(part, place)
    for place in places:
        home.update(dict.fromkeys(network.places[place].parts, place))
    return home
