"""The records of units, and of what joins them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Literal

import numpy as np

from cadgraph.facts.places import NodeFacts
from cadgraph.model.mechanisms import records_of
from cadgraph.model.parts import Link, Network, UnitParts
from cadgraph.model.records import Connected, Joint, Junction, Point, Port, Stated, System, Terminal, Unit, points
from cadgraph.model.scene import Floats
from cadgraph.model.stated import resolve_links
from cadgraph.stages.assemble.places import access_of
from cadgraph.stages.assemble.results import Results, extent_of, fact_records, in_world, rounded

__all__ = ["connected", "joint_records", "place_nodes", "stated_links", "systems_of", "unit_records"]

_ENDINGS: dict[str, Literal["open", "blind"]] = {"open": "open", "blind": "blind"}


def unit_records(results: Results, part_ids: Sequence[str], above: Sequence[Sequence[NodeFacts]]) -> list[Unit]:
    """Units with their openings, how people get at them, what moves, and what the source says of them.

    Args:
        results: of all stages.
        part_ids: of each part.
        above: of each unit, the nodes of the source over its parts that say something.
    """
    nodes = []
    bores = _bores(results.network)
    for number, unit in enumerate(results.network.units):
        centroid, low, high = extent_of(results, unit.parts)
        nodes.append(
            Unit(
                id=f"unit-{unit.tag}",
                unit_type=unit.unit_type,
                tag=unit.tag,
                kind=unit.kind,
                kind_guesses=unit.kind_guesses,
                parts=tuple(part_ids[part] for part in unit.parts),
                ports=_ports(unit, bores.get(number, {}), results.scene.origin),
                centroid=centroid,
                aabb=(low, high),
                access=access_of(results, number),
                **records_of(results.motions, number, results.scene),
                facts=fact_records([fact for node in above[number] for fact in node.facts] if above else ()),
            )
        )
    return nodes


def _bores(network: Network) -> Mapping[int, Mapping[int, float]]:
    """The bore of the line at each opening of a unit that one line of one size leaves from, by unit, then opening."""
    lines: dict[tuple[int, int], list[Link]] = {}
    for link in network.links:
        for node, port in ((link.source, link.source_port), (link.target, link.target_port)):
            if port >= 0:
                lines.setdefault((node, port), []).append(link)
    found: dict[int, dict[int, float]] = {}
    for (unit, opening), (link, *more) in lines.items():
        if not more and link.diameter is not None and len(link.sizes) <= 1:
            found.setdefault(unit, {})[opening] = link.diameter
    return found


def _ports(unit: UnitParts, bores: Mapping[int, float], origin: Floats) -> tuple[Port, ...]:
    """The openings, named N1, N2... in their order, with the bores that are known."""
    diameters = [bores.get(number, opening.diameter) for number, opening in enumerate(unit.openings)]
    return tuple(
        Port(
            name=f"N{number}",
            point=in_world(opening.point, origin),
            direction=None if opening.direction is None else points(opening.direction)[0],
            diameter=None if diameter is None else rounded(diameter),
        )
        for number, (opening, diameter) in enumerate(zip(unit.openings, diameters, strict=True), 1)
    )


def place_nodes(results: Results, part_ids: Sequence[str]) -> list[Junction | Terminal]:
    """Junctions and terminals, each kind numbered in its order."""
    nodes: list[Junction | Terminal] = []
    counts: Counter[str] = Counter()
    for place in results.network.places:
        where, parts = in_world(place.point, results.scene.origin), tuple(part_ids[part] for part in place.parts)
        layer = "junction" if place.kind == "junction" else "terminal"
        name = f"{layer}-{counts[layer]:03d}"
        counts[layer] += 1
        if layer == "junction":
            nodes.append(Junction(id=name, point=where, parts=parts))
        else:
            nodes.append(Terminal(id=name, kind=_ENDINGS.get(place.kind, "unknown"), point=where, parts=parts))
    return nodes


def connected(link: Link, results: Results, ends: Sequence[str], part_ids: Sequence[str]) -> Connected:
    """What joins two nodes of the network, which have the ids ``ends``."""
    path = points(np.asarray(link.path, np.float64).reshape(-1, 3) + results.scene.origin)
    return Connected(
        source=ends[link.source],
        target=ends[link.target],
        via=tuple(part_ids[part] for part in link.via),
        length=rounded(link.length),
        diameter=None if link.diameter is None else rounded(link.diameter),
        size=link.size,
        sizes=link.sizes,
        source_port=_port_name(link.source_port),
        target_port=_port_name(link.target_port),
        path=path,
        direction=link.direction,
        reason=link.reason,
        direction_confidence=link.direction_confidence,
        confidence=round(link.confidence, 6),
    )


def systems_of(results: Results, ends: Sequence[str]) -> list[System]:
    """The connected networks; one's length and sizes are those of its connections."""
    network, n_units = results.network, len(results.network.units)
    system_of = {node: k for k, members in enumerate(network.systems) for node in members}
    lengths = [0.0] * len(network.systems)
    sizes: list[set[int]] = [set() for _ in network.systems]
    for link in network.links:
        lengths[system_of[link.source]] += link.length
        sizes[system_of[link.source]].update((*link.sizes, *(() if link.size is None else (link.size,))))
    return [
        System(
            id=f"system-{k:03d}",
            units=tuple(ends[node] for node in members if node < n_units),
            junctions=tuple(ends[node] for node in members if _is(network, node, junction=True)),
            terminals=tuple(ends[node] for node in members if _is(network, node, junction=False)),
            length=rounded(lengths[k]),
            sizes=tuple(sorted(sizes[k])),
        )
        for k, members in enumerate(network.systems)
    ]


def joint_records(results: Results, part_ids: Sequence[str]) -> list[Joint]:
    """What the connections are made of and what they might have been, by the parts that join and the place."""
    places = points(_table([joint.point for joint in results.network.joints]) + results.scene.origin)
    found = [
        Joint(
            first=part_ids[joint.first],
            second=part_ids[joint.second],
            kind=joint.kind,
            point=place,
            gap=rounded(joint.gap),
            score=round(joint.score, 6),
            made=joint.made,
            reasons=joint.reasons,
        )
        for joint, place in zip(results.network.joints, places, strict=True)
    ]
    return sorted(found, key=lambda joint: (joint.first, joint.second, joint.point, joint.kind, not joint.made))


def stated_links(results: Results, part_ids: Sequence[str]) -> list[Stated]:
    """What the source says is joined, in its own order."""
    scene = results.scene
    return [
        Stated(
            first=tuple(part_ids[part] for part in join.first),
            second=tuple(part_ids[part] for part in join.second),
            first_path=join.link.first,
            second_path=join.link.second,
            flow=join.link.flow,
            where=join.link.where,
        )
        for join in resolve_links(scene.links, scene.paths, results.parts.part_of_mesh)
    ]


def _is(network: Network, node: int, junction: bool) -> bool:
    """Whether a node is a junction, or a terminal."""
    place = node - len(network.units)
    return place >= 0 and (network.places[place].kind == "junction") == junction


def _port_name(number: int) -> str | None:
    return f"N{number + 1}" if number >= 0 else None


def _table(rows: Sequence[Point]) -> Floats:
    return np.array(rows, np.float64).reshape(-1, 3)
