"""What a graph says, as the page shows it: columns and rows of plain values."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph._io.text import file_name, printable, shortened
from cadgraph.draw.colors import group_colors
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import Guess, Label
from cadgraph.model.records import (
    Cluster,
    Connected,
    Contains,
    Joint,
    Junction,
    Part,
    Point,
    SourceFact,
    System,
    Terminal,
    Unit,
)
from cadgraph.model.scene import Scene
from cadgraph.query.doubt import few_ports
from cadgraph.query.lines import Line, find_lines
from cadgraph.query.mechanisms import immovable, say_handling
from cadgraph.query.network import Network

__all__ = ["as_bytes", "content_of", "diagnostics_of", "network_of", "parts_of", "shown_meshes"]

_MOST_GUESSES = 5
_MOST_FACTS = 12
_LONGEST_FACT = 300  # characters
_NOWHERE: Point = (0.0, 0.0, 0.0)


def content_of(graph: SceneGraph, scene: Scene, version: int = 0) -> dict[str, Any]:
    """All that the page shows of a graph, but for the triangles.

    Points are relative to the scene's origin. What refers to a part, a unit, a cluster... is its row; -1 is none.

    Args:
        graph: of the scene.
        scene: as it was analysed, or read again from the file; its meshes stand in ``meshes`` in their order.
        version: of the graph, grows with every change.

    Returns:
        Values for JSON: ``version``, ``title``, ``origin``, ``groups``, ``meshes``, ``parts`` (see :func:`parts_of`),
        ``network`` (see :func:`network_of`) and ``diagnostics``.
    """
    origin = _point(scene.origin.tolist())
    owner = _part_of_mesh(graph)
    vocabulary = graph.vocabulary
    return {
        "version": version,
        "title": file_name(graph.source.path),
        "origin": list(origin),
        "groups": [
            {
                "name": name,
                "color": color,
                "unit": vocabulary.get(name, {}).get("unit"),
                "names": list(vocabulary.get(name, {}).get("names", ())),
            }
            for name, color in group_colors(graph).items()
        ],
        "meshes": {"path": list(scene.paths), "part": [owner.get(path, -1) for path in scene.paths]},
        "parts": parts_of(graph, origin=origin),
        "network": network_of(graph, origin=origin),
        "diagnostics": diagnostics_of(graph),
    }


def shown_meshes(graph: SceneGraph, scene: Scene) -> npt.NDArray[np.bool_]:
    """``(n_meshes,)`` whether a mesh is in a part; duplicates and what nobody sees are in none."""
    owner = _part_of_mesh(graph)
    return np.array([path in owner for path in scene.paths], np.bool_)


def parts_of(graph: SceneGraph, ids: Iterable[str] | None = None, origin: Point = _NOWHERE) -> dict[str, Any]:
    """Parts as columns of equal length.

    Args:
        graph: any.
        ids: of the parts, in order; all by default. Numbers in the columns always mean rows among all parts.
        origin: of the scene [m].

    Raises:
        KeyError: the graph has no such part.
    """
    every = graph.of_layer(Part)
    row = {part.id: i for i, part in enumerate(every)}
    parts = every if ids is None else [every[row[each]] for each in ids]
    groups = {name: i for i, name in enumerate(group_colors(graph))}
    shapes = {name: i for i, name in enumerate(dict.fromkeys(part.shape for part in every))}
    unit = _row_of_part(graph.of_layer(Unit))
    cluster = _cluster_of_part(graph)
    return {
        "id": [part.id for part in parts],
        **_label_columns([part.label for part in parts], groups),
        "unit": [unit.get(part.id, -1) for part in parts],
        "cluster": [cluster.get(part.id, -1) for part in parts],
        "shape": [shapes[part.shape] for part in parts],
        "ground": [part.ground for part in parts],
        "inside": [row[part.inside] if part.inside is not None else -1 for part in parts],
        **_measure_columns(parts, origin),
        "guesses": [_guesses(part.guesses, groups) for part in parts],
        "facts": [_facts(part.facts) for part in parts],
    }


def _label_columns(labels: Sequence[Label | None], groups: Mapping[str, int]) -> dict[str, list[Any]]:
    return {
        "group": [groups[label.group] if label else -1 for label in labels],
        "name": [label.name if label else None for label in labels],
        "confidence": [label.confidence if label else None for label in labels],
        "state": [label.state if label else "open" for label in labels],
        "source": [label.source if label else None for label in labels],
    }


def _measure_columns(parts: Sequence[Part], origin: Point) -> dict[str, list[Any]]:
    boxes = np.array([part.aabb for part in parts]).reshape(-1, 2, 3)
    return {
        "center": _numbers(boxes.mean(axis=1) - origin),
        "size": _numbers(boxes[:, 1] - boxes[:, 0]),
        "extents": _numbers(np.array([part.obb.extents for part in parts])),
        "n_triangles": [part.n_triangles for part in parts],
        "area": [part.area for part in parts],
        "volume": [part.volume for part in parts],
    }


def network_of(graph: SceneGraph, rows: Mapping[str, int] | None = None, origin: Point = _NOWHERE) -> dict[str, Any]:
    """Units, ends, connections, lines, systems, clusters and joints of a graph.

    Args:
        graph: any.
        rows: row of each part by its id; its place among all parts by default.
        origin: of the scene [m].
    """
    row = rows if rows is not None else {part.id: i for i, part in enumerate(graph.of_layer(Part))}
    network = Network(graph)
    lines = find_lines(network)
    systems = graph.of_layer(System)
    system = {system.id: i for i, system in enumerate(systems)}
    ends: list[Junction | Terminal] = [*graph.junctions(), *graph.terminals()]
    fixed = {one.unit: f"not movable: {one.reason}" for one in immovable(graph)}
    line_of = {arc.index: i for i, line in enumerate(lines) for arc in line.arcs}
    return {
        "units": [
            {**_unit(unit, network, row, system, origin), "handling": say_handling(unit) or fixed.get(unit.id, "")}
            for unit in graph.of_layer(Unit)
        ],
        "ends": [_end(end, network, row, system, origin) for end in ends],
        "connections": [
            _connection(edge, network, row, line_of.get(i, -1), origin) for i, edge in enumerate(network.edges)
        ],
        "lines": [_line(line, system) for line in lines],
        "systems": [
            {"id": each.id, "units": list(each.units), "length": each.length, "sizes": list(each.sizes)}
            for each in systems
        ],
        "clusters": [{"id": each.id, "kind": each.kind, "n_parts": each.n_parts} for each in graph.of_layer(Cluster)],
        "joints": [_joint(joint, row, origin) for joint in graph.joints()],
    }


def diagnostics_of(graph: SceneGraph) -> list[dict[str, Any]]:
    """The findings of a graph, each with the rows of the parts that it is about."""
    owner = _part_of_mesh(graph)
    return [
        {
            "code": finding.code,
            "message": finding.message,
            "parts": list(dict.fromkeys(owner[mesh] for mesh in finding.meshes if mesh in owner)),
        }
        for finding in graph.diagnostics
    ]


def as_bytes(value: Any) -> bytes:
    """Values as JSON in UTF-8; a lone surrogate of a name, which has no UTF-8, as its escape."""
    text = json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return text.encode("utf-8", "backslashreplace")


def _unit(
    unit: Unit, network: Network, row: Mapping[str, int], system: Mapping[str, int], origin: Point
) -> dict[str, Any]:
    few = few_ports(network, unit.id)
    low, high = unit.aabb
    return {
        "id": unit.id,
        "tag": unit.tag,
        "type": unit.unit_type,
        "kind": unit.kind,
        "kind_guesses": [list(guess) for guess in unit.kind_guesses],
        "parts": [row[part] for part in unit.parts],
        "system": system.get(network.system(unit.id) or "", -1),
        "point": _moved(unit.centroid, origin),
        "size": _moved(high, low),
        "ports": [
            {
                "name": port.name,
                "point": _moved(port.point, origin),
                "direction": list(port.direction) if port.direction is not None else None,
                "diameter": port.diameter,
            }
            for port in unit.ports
        ],
        "missing": few[1] - few[0] if few is not None else 0,
        "facts": _facts(unit.facts),
    }


def _end(
    end: Junction | Terminal, network: Network, row: Mapping[str, int], system: Mapping[str, int], origin: Point
) -> dict[str, Any]:
    return {
        "id": end.id,
        "name": network.name(end.id),
        "kind": end.kind if isinstance(end, Terminal) else "junction",
        "point": _moved(end.point, origin),
        "parts": [row[part] for part in end.parts],
        "system": system.get(network.system(end.id) or "", -1),
    }


def _connection(edge: Connected, network: Network, row: Mapping[str, int], line: int, origin: Point) -> dict[str, Any]:
    return {
        "source": edge.source,
        "target": edge.target,
        "source_name": network.name(edge.source),
        "target_name": network.name(edge.target),
        "via": [row[part] for part in edge.via],
        "path": _numbers(np.array(edge.path).reshape(-1, 3) - origin),
        "length": edge.length,
        "size": edge.size,
        "diameter": edge.diameter,
        "flow": edge.direction,
        "reason": edge.reason,
        "confidence": edge.confidence,
        "line": line,
    }


def _line(line: Line, system: Mapping[str, int]) -> dict[str, Any]:
    return {
        "tag": line.tag,
        "start": line.start,
        "end": line.end,
        "start_name": line.start_name,
        "end_name": line.end_name,
        "size": line.size,
        "length": line.length,
        "flow": line.flow,
        "connections": [arc.index for arc in line.arcs],
        "system": system.get(line.system or "", -1),
    }


def _joint(joint: Joint, row: Mapping[str, int], origin: Point) -> dict[str, Any]:
    return {
        "first": row[joint.first],
        "second": row[joint.second],
        "kind": joint.kind,
        "point": _moved(joint.point, origin),
        "gap": joint.gap,
        "score": joint.score,
        "made": joint.made,
        "reasons": list(joint.reasons),
    }


def _part_of_mesh(graph: SceneGraph) -> dict[str, int]:
    return {mesh: i for i, part in enumerate(graph.of_layer(Part)) for mesh in part.meshes}


def _row_of_part(units: Sequence[Unit]) -> dict[str, int]:
    return {part: i for i, unit in enumerate(units) for part in unit.parts}


def _cluster_of_part(graph: SceneGraph) -> dict[str, int]:
    row = {cluster.id: i for i, cluster in enumerate(graph.of_layer(Cluster))}
    return {edge.target: row[edge.source] for edge in graph.of_kind(Contains) if edge.source in row}


def _guesses(guesses: Sequence[Guess], groups: Mapping[str, int]) -> list[list[Any]]:
    """Group, name and confidence; a guess at a group that the graph doesn't know is left out."""
    known = [guess for guess in guesses if guess.group in groups]
    return [[groups[guess.group], guess.name, guess.confidence] for guess in known[:_MOST_GUESSES]]


def _facts(facts: Sequence[SourceFact]) -> list[list[str]]:
    return [[printable(fact.key), shortened(printable(fact.value), _LONGEST_FACT)] for fact in facts[:_MOST_FACTS]]


def _point(values: Sequence[float]) -> Point:
    x, y, z = values
    return x, y, z


def _moved(point: Point, origin: Point) -> list[float]:
    return [round(a - b, 6) + 0.0 for a, b in zip(point, origin, strict=True)]


def _numbers(rows: npt.NDArray[np.float64]) -> list[float]:
    """Three columns as one list, to a micrometre: what is drawn shows no less, and the page loads sooner."""
    flat: list[float] = (np.round(rows, 6) + 0.0).reshape(-1).tolist()
    return flat
