"""Flow directions: what shows one, what the user says, and what becomes of both."""

from __future__ import annotations

import heapq
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.parts import Link, Network, Parts
from cadgraph.stages.relate.edit_flow import yield_to
from cadgraph.stages.relate.flow_file import file_flow, is_of_file, weigh_flow
from cadgraph.stages.relate.flow_sources import SOURCES, Sight
from cadgraph.stages.relate.flow_spread import Evidence, around
from cadgraph.stages.relate.stated import Stated

__all__ = ["direct_flow", "stated_flow"]

# What the user says is sure where every way between the two runs through a link.
_STATED, _STATED_MAYBE = 1.0, 0.9


def direct_flow(
    network: Network,
    parts: Parts,
    names: Sequence[str | None],
    given: Sequence[Evidence] = (),
    stated: Stated | None = None,
    by_user: Sequence[Evidence] = (),
) -> tuple[Network, tuple[Diagnostic, ...]]:
    """Gives links the direction of their flow where something shows it.

    Args:
        network: units and links, without directions.
        parts: parts of the scene.
        names: name of each part, None where unknown.
        given: directions that the user states (``stated_flow``).
        stated: what the file says, where that counts.
        by_user: directions that the user set; everything else gives way to them.

    Returns:
        The network with directions, their reasons and confidences, and diagnostics of the contradictions.
    """
    sight = Sight(network, parts, names, around(network))
    shown = [one for source in SOURCES for one in source(sight)]
    filed, doubts = file_flow(network, stated) if stated else ([], [])
    out, overruled = yield_to(network, by_user, [*given, *shown, *filed])
    weighed = weigh_flow(network, [*by_user, *_without(given, out)], _without(shown, out), _without(filed, out))
    chosen, against = weighed.flows.chosen, weighed.flows.against
    links = tuple(_directed(link, chosen.get(number)) for number, link in enumerate(network.links))
    doubts += weighed.disagreeing
    against += overruled
    doubts += [pair for pair in against if any(map(is_of_file, pair))]
    ours = [pair for pair in against if not any(map(is_of_file, pair))]
    return replace(network, links=links), (
        *_contradictions(network, parts, ours, "flow-contradiction", "reasons disagree which way it flows"),
        *_contradictions(
            network, parts, doubts, "flow-disagrees", "what the file says of the flow is contradicted, also by itself"
        ),
    )


def _without(evidence: Sequence[Evidence], reasons: Collection[str]) -> list[Evidence]:
    return [one for one in evidence if one.reason not in reasons]


def _directed(link: Link, best: Evidence | None) -> Link:
    if best is None:
        return link
    return replace(
        link,
        direction="forward" if best.forward else "backward",
        reason=best.reason,
        direction_confidence=round(best.confidence, 3),
    )


def _contradictions(
    network: Network, parts: Parts, against: Sequence[tuple[Evidence, Evidence]], code: str, message: str
) -> tuple[Diagnostic, ...]:
    """A diagnostic of reasons that disagree; none where none do."""
    if not against:
        return ()
    lines = []
    for a, b in against:
        link = network.links[a.link]
        lines.append(f"{_name(network, link.source)} to {_name(network, link.target)}: {a.reason}, but {b.reason}")
    meshes = tuple(parts.scene.paths[part] for a, _ in against for part in network.links[a.link].via[:1])
    told = "; ".join(dict.fromkeys(lines))
    return (Diagnostic(code, f"{message}; {told}", tuple(dict.fromkeys(meshes))),)


def stated_flow(network: Network, statements: Sequence[str], former: Sequence[str] = ()) -> list[Evidence]:
    """What the user says about the flow.

    Args:
        network: units and links.
        statements: ``"P-001 -> T-001"`` each: it flows from one unit to the other.
        former: tags of the units before a user gave them others; they mean the same unless they mean another unit now.

    Raises:
        ValueError: a statement is malformed, names no unit, or nothing joins the two.
    """
    number = {tag: k for k, tag in enumerate(former)} | {unit.tag: k for k, unit in enumerate(network.units)}
    return [one for statement in statements for one in _stated(network, *_ends(statement, number))]


def _ends(statement: str, number: Mapping[str, int]) -> tuple[int, int]:
    """The two units that a statement names."""
    ends = [word.strip() for word in statement.split("->")]
    if len(ends) != 2 or not all(ends):
        raise ValueError(f"relate.flow: {statement!r} is no flow; write 'P-001 -> T-001'")
    for tag in ends:
        if tag not in number:
            raise ValueError(f"relate.flow: {statement!r}: no unit is called {tag!r}; see 'cadgraph lines'")
    return number[ends[0]], number[ends[1]]


def _stated(network: Network, start: int, goal: int) -> Iterator[Evidence]:
    """The shortest way from one unit to another, surest where no other way leads there."""
    first, last = network.units[start].tag, network.units[goal].tag
    way = _shortest(network, start, goal, frozenset())
    if way is None:
        raise ValueError(f"relate.flow: '{first} -> {last}': no line joins {first} and {last}")
    for link, forward in way:
        only = _shortest(network, start, goal, frozenset([link])) is None
        yield Evidence(link, forward, _STATED if only else _STATED_MAYBE, f"stated: {first} -> {last}")


def _name(network: Network, node: int) -> str:
    if node < len(network.units):
        return network.units[node].tag
    return f"{network.places[node - len(network.units)].kind} {node - len(network.units)}"


def _shortest(network: Network, start: int, goal: int, without: frozenset[int]) -> list[tuple[int, bool]] | None:
    """The shortest way along links, each with whether it is gone forward."""
    at = around(network)
    best: dict[int, float] = {start: 0.0}
    came: dict[int, tuple[int, int, bool]] = {}
    front = [(0.0, start)]
    while front:
        far, here = heapq.heappop(front)
        if here == goal:
            way = []
            while here != start:
                here, link, forward = came[here]
                way.append((link, forward))
            return way[::-1]
        if far > best[here]:
            continue
        for link, forward in at.get(here, ()):
            if link in without:
                continue
            there = network.links[link].target if forward else network.links[link].source
            length = far + network.links[link].length + 1e-9
            if length < best.get(there, np.inf):
                best[there] = length
                came[there] = here, link, forward
                heapq.heappush(front, (length, there))
    return None
