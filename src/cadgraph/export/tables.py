"""The graph as CSV tables: a file for each kind of node and edge, and for joints and meshes."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

from cadgraph._io.atomic import write_atomically
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Adjacent, Box, Cluster, Part, Site, Unit
from cadgraph.query.summary import connection_between

__all__ = ["Row", "table_bytes", "table_cell", "write_tables"]

# A spreadsheet runs a cell that starts so as a formula, in a file from anybody (OWASP, "CSV Injection").
_FORMULA = re.compile(r"\s*[=+\-@\uff1d\uff0b\uff0d\uff20]")
_CONTROL = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f\ud800-\udfff]")
_PLACE = ("x_m", "y_m", "z_m", "size_x_m", "size_y_m", "size_z_m")

Row = Sequence[Any]


def write_tables(graph: SceneGraph, folder: str | Path) -> list[Path]:
    """Writes a CSV file for each kind of node and edge of a graph.

    They are ``parts.csv``, ``units.csv``, ``connections.csv``, ``junctions.csv``, ``ends.csv``, ``systems.csv``,
    ``joints.csv``, ``clusters.csv``, ``contacts.csv``, ``meshes.csv``, ``facts.csv`` for what the source file says of
    them, and ``related.csv`` for the relations of the paper's Algorithm 1. ``between`` in the connections says whether
    one joins two units, a junction, or leads to an end.

    UTF-8 with a byte order mark, by which Excel knows it. Units are in the column names. Text that a spreadsheet would
    run as a formula gets an apostrophe in front.

    Args:
        graph: what to write.
        folder: where to; made if missing.

    Returns:
        The files.

    Raises:
        OutputError: a file can't be written.
    """
    tables = {
        "parts": _parts(graph),
        "units": _units(graph),
        "connections": _connections(graph),
        "junctions": _junctions(graph),
        "ends": _ends(graph),
        "systems": _systems(graph),
        "related": _related(graph),
        "joints": _joints(graph),
        "clusters": _clusters(graph),
        "contacts": _contacts(graph),
        "meshes": _meshes(graph),
        "facts": _facts(graph),
    }
    return [_write(Path(folder) / f"{name}.csv", rows) for name, rows in tables.items()]


def _parts(graph: SceneGraph) -> Iterator[Row]:
    yield (
        "part", "group", "name", "confidence", "label_state", "label_source", "unit", "cluster", *_PLACE, "area_m2",
        "volume_m3", "n_meshes", "n_triangles", "shape", "ground", "largest_mesh", "inside",
    )  # fmt: skip
    for part in graph.of_layer(Part):
        label, unit, cluster = part.label, graph.unit_of(part), graph.cluster_of(part)
        state = label.state if label is not None else "open"
        says = (label.group, label.name, label.confidence) if label else (None, None, None)
        yield (
            part.id, *says, state, label.source if label else None, unit.tag if unit else None,
            cluster.id if cluster else None, *part.centroid, *_extents(part.aabb), part.area, part.volume,
            len(part.meshes), part.n_triangles, part.shape, "yes" if part.ground else "no", part.meshes[0],
            part.inside,
        )  # fmt: skip


def _units(graph: SceneGraph) -> Iterator[Row]:
    yield (
        "tag", "type", "kind", "kind_guesses", "n_parts", "n_ports", "system", "cluster", *_PLACE,
        "connected_to", "related_to", "parts",
    )  # fmt: skip
    system_of = {node: system.id for system in graph.systems() for node in system.units}
    for unit in graph.of_layer(Unit):
        cluster = graph.cluster_of(unit.parts[0]) if unit.parts else None
        yield (
            unit.tag, unit.unit_type, unit.kind, "; ".join(f"{kind} {sure:g}" for kind, sure in unit.kind_guesses),
            len(unit.parts), len(unit.ports), system_of.get(unit.id),
            cluster.id if cluster else None, *unit.centroid, *_extents(unit.aabb),
            " ".join(other.tag for other in graph.neighbors(unit)),
            " ".join(other.tag for other in graph.related(unit)), " ".join(unit.parts),
        )  # fmt: skip


def _connections(graph: SceneGraph) -> Iterator[Row]:
    yield (
        "from", "from_port", "to", "to_port", "between", "direction", "reason", "length_m", "diameter_m", "dn",
        "confidence", "via_parts",
    )  # fmt: skip
    for edge in graph.connections():
        yield (
            _name(graph, edge.source), edge.source_port, _name(graph, edge.target), edge.target_port,
            connection_between(graph, edge), edge.direction, edge.reason, edge.length, edge.diameter,
            "/".join(map(str, edge.sizes)) or edge.size, edge.confidence, " ".join(edge.via),
        )  # fmt: skip


def _junctions(graph: SceneGraph) -> Iterator[Row]:
    yield "junction", "x_m", "y_m", "z_m", "parts"
    for junction in graph.junctions():
        yield junction.id, *junction.point, " ".join(junction.parts)


def _ends(graph: SceneGraph) -> Iterator[Row]:
    yield "end", "kind", "x_m", "y_m", "z_m", "parts"
    for end in graph.terminals():
        yield end.id, end.kind, *end.point, " ".join(end.parts)


def _systems(graph: SceneGraph) -> Iterator[Row]:
    yield "system", "n_units", "n_junctions", "n_ends", "length_m", "dn", "units"
    for system in graph.systems():
        yield (
            system.id, len(system.units), len(system.junctions), len(system.terminals), system.length,
            "/".join(map(str, system.sizes)), " ".join(_name(graph, unit) for unit in system.units),
        )  # fmt: skip


def _related(graph: SceneGraph) -> Iterator[Row]:
    yield "unit", "other_unit"
    for edge in graph.related():
        yield _name(graph, edge.source), _name(graph, edge.target)


def _joints(graph: SceneGraph) -> Iterator[Row]:
    yield "part", "other_part", "kind", "made", "score", "gap_m", "x_m", "y_m", "z_m", "reasons"
    for joint in graph.joints():
        made = "yes" if joint.made else "no"
        yield (
            joint.first, joint.second, joint.kind, made, joint.score, joint.gap, *joint.point, "; ".join(joint.reasons)
        )  # fmt: skip


def _clusters(graph: SceneGraph) -> Iterator[Row]:
    yield "cluster", "kind", "n_parts", "n_units", *_PLACE
    units: dict[str, set[str]] = {}
    for unit in graph.of_layer(Unit):
        for part in unit.parts:
            cluster = graph.cluster_of(part)
            if cluster:
                units.setdefault(cluster.id, set()).add(unit.id)
    for cluster in graph.of_layer(Cluster):
        n_units = len(units.get(cluster.id, ()))
        yield cluster.id, cluster.kind, cluster.n_parts, n_units, *cluster.centroid, *_extents(cluster.aabb)


def _contacts(graph: SceneGraph) -> Iterator[Row]:
    yield "part", "other_part", "distance_m", "x_m", "y_m", "z_m"
    for edge in graph.of_kind(Adjacent):
        yield edge.source, edge.target, edge.distance, *edge.point


def _meshes(graph: SceneGraph) -> Iterator[Row]:
    yield "mesh", "part"
    for part in graph.of_layer(Part):
        for mesh in part.meshes:
            yield mesh, part.id


def _facts(graph: SceneGraph) -> Iterator[Row]:
    yield "node", "key", "value", "where", "path"
    for node in graph.nodes.values():
        if isinstance(node, Part | Unit | Site):
            for fact in node.facts:
                yield node.id, fact.key, fact.value, fact.where, fact.path


def _name(graph: SceneGraph, node: str) -> str:
    found = graph.nodes[node]
    return found.tag if isinstance(found, Unit) else found.id


def _extents(aabb: Box) -> tuple[float, ...]:
    return tuple(high - low for low, high in zip(*aabb, strict=True))


def table_bytes(rows: Iterable[Row]) -> bytes:
    """Rows as CSV for spreadsheets: UTF-8 with a byte order mark, no cell that would be run as a formula."""
    text = io.StringIO(newline="")
    csv.writer(text).writerows([table_cell(value) for value in row] for row in rows)
    return text.getvalue().encode("utf-8-sig")


def _write(path: Path, rows: Iterable[Row]) -> Path:
    write_atomically(path, table_bytes(rows))
    return path


def table_cell(value: Any) -> Any:
    """A value as it stands in a table: text without control characters, and none that would be run as a formula."""
    if not isinstance(value, str):
        return value
    cleaned = _CONTROL.sub("", value)
    return f"'{cleaned}" if _FORMULA.match(cleaned) else cleaned
