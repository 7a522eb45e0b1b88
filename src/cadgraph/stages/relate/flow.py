"""Flow directions: what shows one, and how far along the network that holds."""

from __future__ import annotations

import heapq
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.parts import Network, Opening, Parts, UnitParts
from cadgraph.model.scene import Floats

__all__ = ["direct_flow", "stated_flow"]

# A pump's suction is the nozzle along its shaft, its discharge the one across (centrifugal pumps after ISO 2858): so
# parallel at least and at most (cosines) ...
_AXIAL, _RADIAL = 0.9, 0.35
# ... and suction nozzles are wider, by this factor at least where that is to tell them apart.
_WIDER = 1.12
# How sure each reason is (ours).
_BY_NOZZLES, _BY_AXES, _BY_WIDTH, _BY_HEIGHT, _STATED, _STATED_MAYBE = 0.95, 0.85, 0.7, 0.6, 1.0, 0.9
# A tank's nozzle is low below this share of its height.
_LOW = 0.35
# What follows from another connection is a little less sure.
_STEP = 0.995
# Two reasons that disagree leave it open unless one is so much surer.
_OUTWEIGHS = 0.2
# Parts that a tank stands on are not where its contents are.
_SUPPORTS = frozenset({"tank leg", "skirt", "saddle", "lifting lug"})


@dataclass(frozen=True)
class _Evidence:
    """Link, whether forward, how sure and why."""

    link: int
    forward: bool
    confidence: float
    reason: str


def direct_flow(
    network: Network, parts: Parts, names: Sequence[str | None], stated: Sequence[_Evidence] = ()
) -> tuple[Network, tuple[Diagnostic, ...]]:
    """Gives links the direction of their flow where something shows it.

    Args:
        network: units and links, without directions.
        parts: parts of the scene.
        names: name of each part, None where unknown.
        stated: directions that the user states (``stated_flow``).

    Returns:
        The network with directions, their reasons and confidences, and a diagnostic of the contradictions.
    """
    evidence = [*stated, *_pumps(network, parts), *_tanks(network, parts, names)]
    chosen, against = _spread(network, evidence)
    links = []
    for number, link in enumerate(network.links):
        best = chosen.get(number)
        if best is None:
            links.append(link)
            continue
        links.append(
            replace(
                link,
                direction="forward" if best.forward else "backward",
                reason=best.reason,
                direction_confidence=round(best.confidence, 3),
            )
        )
    diagnostics = []
    if against:
        paths = parts.scene.paths
        lines = [
            f"{_name(network, network.links[a.link].source)} to {_name(network, network.links[a.link].target)}: "
            f"{a.reason}, but {b.reason}"
            for a, b in against
        ]
        meshes = tuple(paths[part] for a, _ in against for part in network.links[a.link].via[:1])
        diagnostics.append(
            Diagnostic("flow-contradiction", "reasons disagree which way it flows; " + "; ".join(lines), meshes)
        )
    return replace(network, links=tuple(links)), tuple(diagnostics)


def stated_flow(network: Network, statements: Sequence[str]) -> list[_Evidence]:
    """What the user says about the flow.

    Args:
        network: units and links.
        statements: ``"P-001 -> T-001"`` each: it flows from one unit to the other.

    Raises:
        ValueError: a statement is malformed, names no unit, or nothing joins the two.
    """
    number = {unit.tag: k for k, unit in enumerate(network.units)}
    evidence = []
    for statement in statements:
        ends = [word.strip() for word in statement.split("->")]
        if len(ends) != 2 or not all(ends):
            raise ValueError(f"relate.flow: {statement!r} is no flow; write 'P-001 -> T-001'")
        for tag in ends:
            if tag not in number:
                raise ValueError(f"relate.flow: {statement!r}: no unit is called {tag!r}; see 'cadgraph lines'")
        way = _shortest(network, number[ends[0]], number[ends[1]], frozenset())
        if way is None:
            raise ValueError(f"relate.flow: {statement!r}: no line joins {ends[0]} and {ends[1]}")
        for link, forward in way:
            only = _shortest(network, number[ends[0]], number[ends[1]], frozenset([link])) is None
            sure = _STATED if only else _STATED_MAYBE
            evidence.append(_Evidence(link, forward, sure, f"stated: {ends[0]} -> {ends[1]}"))
    return evidence


def _name(network: Network, node: int) -> str:
    if node < len(network.units):
        return network.units[node].tag
    return f"{network.places[node - len(network.units)].kind} {node - len(network.units)}"


def _around(network: Network) -> dict[int, list[tuple[int, bool]]]:
    """The links at each node, and whether they leave it forward."""
    found: dict[int, list[tuple[int, bool]]] = {}
    for number, link in enumerate(network.links):
        found.setdefault(link.source, []).append((number, True))
        found.setdefault(link.target, []).append((number, False))
    return found


def _shortest(network: Network, start: int, goal: int, without: frozenset[int]) -> list[tuple[int, bool]] | None:
    """The shortest way along links, each with whether it is gone forward."""
    around = _around(network)
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
        for link, forward in around.get(here, ()):
            if link in without:
                continue
            there = network.links[link].target if forward else network.links[link].source
            length = far + network.links[link].length + 1e-9
            if length < best.get(there, np.inf):
                best[there] = length
                came[there] = here, link, forward
                heapq.heappush(front, (length, there))
    return None


def _at_port(network: Network, unit: int, port: int) -> list[tuple[int, bool]]:
    """The links at a unit's port, and whether they leave it forward."""
    found = []
    for number, link in enumerate(network.links):
        if link.source == unit and link.source_port == port:
            found.append((number, True))
        if link.target == unit and link.target_port == port:
            found.append((number, False))
    return found


def _pumps(network: Network, parts: Parts) -> list[_Evidence]:
    evidence = []
    for number, unit in enumerate(network.units):
        if unit.unit_type != "pump" or len(unit.openings) < 2:
            continue
        found = _suction(unit, _shaft(unit, parts))
        if found is None:
            continue
        suction, discharge, sure, why = found
        for port, outward in ((suction, False), (discharge, True)):
            place = "discharge" if outward else "suction"
            evidence += [
                _Evidence(link, leaves == outward, sure, f"{place} of {unit.tag} ({why})")
                for link, leaves in _at_port(network, number, port)
            ]
    return evidence


def _shaft(unit: UnitParts, parts: Parts) -> Floats:
    """The long axis of a unit's surface: that of pump and motor."""
    index = np.asarray(unit.parts)
    area, centroid = parts.properties.area[index], parts.properties.centroid[index]
    total = float(area.sum())
    middle = (area[:, None] * centroid).sum(axis=0) / total if total > 0 else centroid.mean(axis=0)
    offset = centroid - middle
    apart = (offset**2).sum(axis=1)[:, None, None] * np.eye(3) - offset[:, :, None] * offset[:, None, :]
    inertia = (parts.properties.inertia[index] + area[:, None, None] * apart).sum(axis=0)
    axis: Floats = np.linalg.eigh(inertia)[1][:, 0]
    return axis


def _suction(unit: UnitParts, shaft: Floats) -> tuple[int, int, float, str] | None:
    """The openings of suction and discharge, how sure that is, and why."""
    wide = sorted(range(len(unit.openings)), key=lambda k: (-(unit.openings[k].diameter or 0.0), k))[:2]
    first, second = sorted(wide)
    a, b = unit.openings[first], unit.openings[second]
    ratio = (a.diameter or 0.0) / b.diameter if b.diameter else 1.0
    along = [abs(float(np.dot(o.direction, shaft))) if o.direction is not None else 0.5 for o in (a, b)]
    axial = [k for k, share in enumerate(along) if share >= _AXIAL]
    radial = [k for k, share in enumerate(along) if share <= _RADIAL]
    wider = 0 if ratio >= _WIDER else 1 if ratio <= 1 / _WIDER else None
    ports = (first, second)
    if len(axial) == 1 and len(radial) == 1:
        eye = axial[0]
        if wider is not None and wider != eye:
            return None
        sure, why = (_BY_AXES, "along the shaft") if wider is None else (_BY_NOZZLES, "along the shaft, the wider one")
        return ports[eye], ports[1 - eye], sure, why
    if wider is not None and not axial:
        return ports[wider], ports[1 - wider], _BY_WIDTH, "the wider nozzle"
    return None


def _tanks(network: Network, parts: Parts, names: Sequence[str | None]) -> list[_Evidence]:
    """What is low at a tank drains it."""
    evidence = []
    for number, unit in enumerate(network.units):
        if unit.unit_type != "tank":
            continue
        body = np.array([part for part in unit.parts if names[part] not in _SUPPORTS] or unit.parts)
        low = float(parts.properties.aabb[body, 0, 2].min())
        high = float(parts.properties.aabb[body, 1, 2].max())
        for port, opening in enumerate(unit.openings):
            if not _is_low(opening, low, high):
                continue
            evidence += [
                _Evidence(link, leaves, _BY_HEIGHT, f"low outlet of {unit.tag}")
                for link, leaves in _at_port(network, number, port)
            ]
    return evidence


def _is_low(opening: Opening, low: float, high: float) -> bool:
    upward = opening.direction is not None and opening.direction[2] > 0.5
    return not upward and opening.point[2] <= low + _LOW * (high - low)


def _dead(network: Network, around: Mapping[int, Sequence[tuple[int, bool]]]) -> set[int]:
    """Links that lead to nothing but closed ends and gauges: nothing flows there."""
    n_units = len(network.units)
    dead: set[int] = set()
    front = [
        node
        for node, links in around.items()
        if len(links) == 1
        and (
            network.units[node].unit_type == "gauge"
            if node < n_units
            else network.places[node - n_units].kind == "blind"
        )
    ]
    while front:
        node = front.pop()
        alive = [(link, forward) for link, forward in around[node] if link not in dead]
        if len(alive) != 1:
            continue
        link, forward = alive[0]
        dead.add(link)
        there = network.links[link].target if forward else network.links[link].source
        ends = there < n_units and network.units[there].unit_type not in ("valve", "gauge")
        if not ends and sum(other not in dead for other, _ in around[there]) == 1:
            front.append(there)
    return dead


def _spread(
    network: Network, evidence: Sequence[_Evidence]
) -> tuple[dict[int, _Evidence], list[tuple[_Evidence, _Evidence]]]:
    """Carries directions on through what has one way in and one way out, the surest first."""
    around = _around(network)
    dead = _dead(network, around)
    chosen: dict[int, _Evidence] = {}
    against: dict[int, tuple[_Evidence, _Evidence]] = {}
    waiting = [(-one.confidence, k, one) for k, one in enumerate(evidence)]
    heapq.heapify(waiting)
    count = len(waiting)
    while waiting:
        _, _, one = heapq.heappop(waiting)
        held = chosen.get(one.link)
        if held is not None:
            if held.forward != one.forward:
                against.setdefault(one.link, (held, one))
            continue
        chosen[one.link] = one
        link = network.links[one.link]
        for node in (link.source, link.target):
            following = _follows(network, node, around, dead, chosen)
            if following is not None:
                heapq.heappush(waiting, (-following.confidence, count, following))
                count += 1
    for number, (held, other) in against.items():
        if held.confidence - other.confidence < _OUTWEIGHS:
            chosen.pop(number)
    return chosen, [pair for _, pair in sorted(against.items())]


def _follows(
    network: Network,
    node: int,
    around: Mapping[int, Sequence[tuple[int, bool]]],
    dead: set[int],
    chosen: Mapping[int, _Evidence],
) -> _Evidence | None:
    """Where all but one of the live links at a node flow in, the last one flows out; and the other way round."""
    if node < len(network.units) and network.units[node].unit_type in ("tank", "equipment"):
        return None
    live = [(link, forward) for link, forward in around[node] if link not in dead or link in chosen]
    open_ = [(link, forward) for link, forward in live if link not in chosen]
    if len(open_) != 1 or len(live) < 2:
        return None
    senses = {chosen[link].forward == forward for link, forward in live if link in chosen}
    if len(senses) != 1:
        return None
    (leaving,) = senses
    surest = min((chosen[link] for link, _ in live if link in chosen), key=lambda one: (one.confidence, one.link))
    link, forward = open_[0]
    return _Evidence(link, forward != leaving, surest.confidence * _STEP, surest.reason)
