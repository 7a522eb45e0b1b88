"""What one thing is."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Annotated, Any

from cadgraph.agents.answer import Answer, cell, page_of
from cadgraph.agents.looking import NO_PLACES, counted, kind_of, overview, said_place, where
from cadgraph.agents.measuring import box_of, point_of
from cadgraph.agents.plant import Plant
from cadgraph.model.records import Cluster, Junction, Part, Place, ReachedFrom, System, Terminal, Unit
from cadgraph.query.explain import explain
from cadgraph.query.explain_unit import PortInUse, UnitExplanation, explain_unit
from cadgraph.query.lines import Line
from cadgraph.query.mechanisms import say_mechanism, say_not_movable
from cadgraph.query.text import line_values
from cadgraph.query.told_facts import fact_rows
from cadgraph.query.told_joint import say_joint

__all__ = ["describe"]

_TEXT = 400  # characters of a text that is more than a name
_IN_ROW = 4  # names


def describe(
    plant: Plant,
    id: Annotated[str, "unit, part, end, system, structure, level or line"],
    page: int = 1,
) -> Answer:
    """What one thing is: its kind, place, ports, parts, and what that rests on.

    Args:
        plant: that holds it.
        id: tag, id or mesh; the tag of a line (``L-0123``).
        page: counted from 1.

    Raises:
        AskError: nothing is called so.
    """
    line = plant.line(id)
    if line is not None:
        return _answer(_line_rows(line), {"line": line_values(line)}, page)
    node = plant.find(id)
    if isinstance(node, Unit | Junction | Terminal):
        return _describe_node(plant, node, page)
    if isinstance(node, Part):
        return _describe_part(plant, node, page)
    if isinstance(node, System):
        return _describe_system(plant, node, page)
    if isinstance(node, Cluster):
        return _describe_cluster(plant, node, page)
    if isinstance(node, Place):
        return _describe_level(plant, node, page)
    return overview(plant)


def _answer(rows: Iterable[tuple[str, str]], values: Mapping[str, Any], page: int) -> Answer:
    lines = [f"{cell(name)}\t{cell(text, _TEXT)}" for name, text in rows if text]
    return Answer(page_of(lines[:1], lines[1:], [], page), values)


def _where(
    plant: Plant, node: Unit | Part | Cluster | Junction | Terminal
) -> tuple[list[tuple[str, str]], dict[str, Any]]:
    """Where something is, as rows and as values."""
    point, (low, high) = point_of(node), box_of(node)
    size = [b - a for a, b in zip(low, high, strict=True)]
    place = where(plant, point)
    rows = [("at", f"{said_place(point)} m, {place}")]
    if any(size):
        rows.append(("box", f"{' x '.join(f'{x:.2f}' for x in size)} m, from {said_place(low)} to {said_place(high)}"))
    return rows, {"at_m": list(point), "box_m": [list(low), list(high)], "region": place}


def _describe_node(plant: Plant, node: Unit | Junction | Terminal, page: int) -> Answer:
    told = explain_unit(plant.network, node.id)
    kind = f" ({cell(told.unit_type)})" if told.unit_type not in (None, told.what) else ""
    rows = [(told.name, f"{told.what}{kind}, id {node.id}")]
    guesses = node.kind_guesses if isinstance(node, Unit) else ()
    if isinstance(node, Unit) and node.kind is None:
        likely = ", ".join(f"{kind} {sure:.0%}" for kind, sure in guesses)
        rows.append(("kind", f"unknown{f'; perhaps {likely}' if likely else ''}"))
    if plant.network.is_valve(node.id) and plant.network.stands_aside(node.id):
        rows.append(("stands", "on the side of its line: what flows there passes it by"))
    here, values = _where(plant, node)
    lines = [line.tag for line in plant.lines if node.id in (line.start, line.end, *line.through)]
    rows += [*here, ("system", told.system or "none"), ("lines", ", ".join(lines))]
    rows += [(f"port {port.port}" if port.port else "port", _port(port)) for port in told.ports]
    rows += _lacking(told)
    rows += _pieces("parts", [f"{part.part} {part.label or 'unlabelled'}" for part in told.parts])
    if isinstance(node, Unit):
        rows.append(("reach", _reach(plant, node)))
        rows.append(("by hand", say_mechanism(node) or say_not_movable(plant.graph, node)))
        rows += [("labels", _evidence(plant, node)), *fact_rows(node.facts)]
    return _answer(rows, values | _node_values(node, told, lines), page)


def _lacking(told: UnitExplanation) -> Iterator[tuple[str, str]]:
    """What a unit lacks, what it is mounted at without a line, and what might be joined to it."""
    if told.mounted_at:
        yield "mounted at", f"{' or '.join(told.mounted_at)}; no line was found here"
    if told.missing:
        yield "MISSING", f"{told.missing} more lines would make a whole {told.what}: they were not found"
    for joint in told.open_joints:
        yield "not joined", say_joint(joint)


def _node_values(node: Unit | Junction | Terminal, told: UnitExplanation, lines: Sequence[str]) -> dict[str, Any]:
    """What is known of a node of the network, as values."""
    return {
        "id": node.id,
        "tag": told.name,
        "type": told.unit_type or node.layer,
        "kind": node.kind if isinstance(node, Unit | Terminal) else None,
        "kind_guesses": [list(guess) for guess in node.kind_guesses] if isinstance(node, Unit) else [],
        "system": told.system,
        "lines": list(lines),
        "ports": [
            {"port": p.port, "to": list(p.to), "lengths_m": list(p.lengths), "dn": list(p.sizes)} for p in told.ports
        ],
        "access": node.access.model_dump() if isinstance(node, Unit) and node.access is not None else None,
        "affordances": list(node.affordances) if isinstance(node, Unit) else [],
        "mechanism": node.mechanism.model_dump() if isinstance(node, Unit) and node.mechanism is not None else None,
        "mounted_at": list(told.mounted_at),
        "missing_lines": told.missing,
        "open_joints": [say_joint(joint) for joint in told.open_joints],
        "parts": [part.part for part in told.parts],
    }


def _port(port: PortInUse) -> str:
    told = []
    for name, length, size in zip(port.to, port.lengths, port.sizes, strict=True):
        facts = [f"DN {size}"] * (size is not None) + [f"{length:.2f} m" if length is not None else "length unknown"]
        told.append(f"to {name} ({', '.join(facts)})")
    return "; ".join(told) or "no line was found here"


def _reach(plant: Plant, unit: Unit) -> str:
    """From where people reach a unit, and how high it is above that."""
    access = unit.access
    if access is None:
        return NO_PLACES
    level = plant.graph.nodes.get(access.place or "")
    name = cell(level.name) if isinstance(level, Place) else "the level below"
    return f"{access.reach}: {access.height:.2f} m above {name}"


def _evidence(plant: Plant, unit: Unit) -> str:
    """Who says what its parts are, and of which that is least sure."""
    labelled = [part for name in unit.parts if (part := plant.graph.part(name)).label is not None]
    sources = counted(part.label.source for part in labelled if part.label)
    unsure = min(labelled, key=lambda part: part.label.confidence if part.label else 0.0, default=None)
    told = [f"{n} by {source}" for source, n in sources]
    if unsure is not None and unsure.label is not None:
        told.append(f"least sure {unsure.id} {unsure.label.name or unsure.label.group} {unsure.label.confidence:.0%}")
    return ", ".join(told)


def _describe_part(plant: Plant, part: Part, page: int) -> Answer:
    told = explain(plant.graph, part.id)
    owner = plant.network.owner_of_part(part.id)
    here, values = _where(plant, part)
    rows = [(part.id, told.label or "unlabelled")]
    if told.confidence is not None:
        rows.append(("label", f"{told.confidence:.0%} sure, by {told.source}"))
    rows += [("why", told.why), ("guesses", ", ".join(f"{name} {sure:.0%}" for name, sure in told.guesses)), *here]
    rows += [("of", plant.called(owner) if owner else "no unit"), ("structure", told.cluster or "none")]
    rows += _pieces("touches", [f"{near.part} {near.label or 'unlabelled'}" for near in told.neighbors])
    rows += [("joined" if joint.made else "not joined", say_joint(joint)) for joint in told.joints]
    rows += [*(("mesh", mesh) for mesh in part.meshes), *fact_rows(part.facts)]
    values |= {
        "id": part.id,
        "label": told.label,
        "confidence": told.confidence,
        "source": told.source,
        "of": plant.called(owner) if owner else None,
        "structure": told.cluster,
        "touches": [near.part for near in told.neighbors],
        "meshes": list(part.meshes),
    }
    return _answer(rows, values, page)


def _describe_system(plant: Plant, system: System, page: int) -> Answer:
    lines = [line.tag for line in plant.lines if line.system == system.id]
    units = [plant.called(name) for name in system.units]
    ends = [plant.called(name) for name in system.terminals]
    length = "unknown" if system.length is None else f"{system.length:.2f} m"
    rows = [
        (system.id, f"{len(units)} units, {len(system.junctions)} junctions, {len(ends)} ends, pipes {length}"),
        ("DN", ", ".join(map(str, system.sizes))),
        *_pieces("units", units),
        *_pieces("ends", [f"{name} ({plant.network.what(name)})" for name in system.terminals]),
        *_pieces("lines", lines),
    ]
    values = {"id": system.id, "units": units, "ends": ends, "lines": lines, "length_m": system.length}
    return _answer(rows, values | {"sizes": list(system.sizes)}, page)


def _describe_cluster(plant: Plant, cluster: Cluster, page: int) -> Answer:
    here, values = _where(plant, cluster)
    parts = plant.graph.parts(cluster=cluster.id)
    units = [plant.called(unit.id) for unit in plant.graph.units() if plant.graph.cluster_of(unit) == cluster]
    labels = counted(kind_of(part) for part in parts)
    rows = [
        (cluster.id, f"structure of {len(parts)} parts: {cell(cluster.kind) or 'unlabelled'}"),
        *here,
        *_pieces("labels", [f"{label} {n}" for label, n in labels]),
        *_pieces("units", units),
    ]
    values |= {"id": cluster.id, "kind": cluster.kind, "units": units, "parts": [part.id for part in parts]}
    return _answer(rows, values, page)


def _describe_level(plant: Plant, place: Place, page: int) -> Answer:
    """A level, or a way up to one."""
    ways = [edge.target for edge in plant.graph.of_kind(ReachedFrom) if edge.source == place.id]
    units = [
        (plant.called(unit.id), unit.access.reach)
        for unit in plant.graph.units()
        if unit.access is not None and unit.access.place == place.id
    ]
    low = f"from {place.low:.2f} m to " if place.low is not None else ""
    rows = [
        (place.id, f"{place.name} ({place.kind})"),
        ("height", f"{low}{place.height:.2f} m"),
        ("area", f"{place.area:.1f} m2" if place.area else ""),
        *_pieces("reached from", ways),
        *_pieces("units", [f"{name} ({reach})" if reach == "out of reach" else name for name, reach in units]),
    ]
    values = {"id": place.id, "name": place.name, "kind": place.kind, "height_m": place.height, "low_m": place.low}
    return _answer(rows, values | {"reached_from": ways, "units": [name for name, _ in units]}, page)


def _line_rows(line: Line) -> list[tuple[str, str]]:
    flow = {"forward": "flows so", "backward": "flows the other way", "none": "leads to a blind end"}
    length = "unknown" if line.length is None else f"{'' if line.whole else '>= '}{line.length:.2f} m"
    reasons = f" ({'; '.join(line.reasons)})" if line.reasons else ""
    return [
        (line.tag, f"line from {line.start_name} to {line.end_name}"),
        ("length", length),
        ("DN", line.size or "unknown"),
        ("flow", f"{flow.get(line.flow, f'direction {line.flow}')}{reasons}"),
        ("system", line.system or "none"),
        *_pieces("through", list(line.through_words)),
    ]


def _pieces(word: str, names: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Names in rows, so many in each."""
    names = [cell(name) for name in names]
    for start in range(0, len(names), _IN_ROW):
        yield (word if start == 0 else ""), ", ".join(names[start : start + _IN_ROW])
