"""The tables of the report, as plain texts for the template."""

from __future__ import annotations

import json
import math
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from cadgraph.config import Config, describe
from cadgraph.draw.colors import UNLABELLED
from cadgraph.draw.report.chart import Bar
from cadgraph.draw.report.pictures import cluster_colors, kind_words, largest_first
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Node, Part, Unit
from cadgraph.query.lines import find_lines
from cadgraph.query.summary import connection_between

__all__ = [
    "Cell",
    "Column",
    "Findings",
    "Table",
    "cluster_table",
    "connection_table",
    "findings",
    "label_bars",
    "label_table",
    "line_table",
    "related_table",
    "setting_table",
    "unit_table",
]

_MOST_ROWS = 400
_MOST_MESSAGES = 6
_MOST_MESHES = 60


@dataclass(frozen=True)
class Cell:
    """One cell.

    Args:
        text: what is shown; the template escapes it.
        key: what it is sorted by; the text by default.
        color: a swatch before the text.
        code: whether the text is a path or an id.
        hatched: whether the swatch is striped.
    """

    text: str
    key: str = ""
    color: str = ""
    code: bool = False
    hatched: bool = False


@dataclass(frozen=True)
class Column:
    """One column: its title, and whether it holds numbers."""

    title: str
    numeric: bool = False


@dataclass(frozen=True)
class Table:
    """One table.

    Args:
        name: short, for links.
        columns: from left to right.
        rows: from top to bottom.
        more: how many rows were left out.
    """

    name: str
    columns: tuple[Column, ...]
    rows: tuple[tuple[Cell, ...], ...]
    more: int = 0


@dataclass(frozen=True)
class Findings:
    """All diagnostics of one code.

    Args:
        code: the stable word.
        count: of meshes concerned, or of messages where they name none.
        messages: the first few different ones.
        more_messages: how many were left out.
        meshes: the first few source paths.
        more_meshes: how many were left out.
    """

    code: str
    count: int
    messages: tuple[str, ...]
    more_messages: int
    meshes: tuple[str, ...]
    more_meshes: int


def unit_table(graph: SceneGraph, colors: Mapping[str, str]) -> Table:
    """All functional units.

    Args:
        graph: the finished graph.
        colors: by unit type.
    """
    with_kind = any(unit.kind for unit in graph.units())
    columns = [Column("Tag"), Column("Type"), Column("Kind"), Column("Parts", True)]
    columns += [Column(f"{axis} [m]", True) for axis in "xyz"]
    columns += [Column("Confidence", True), Column("Cluster"), Column("Largest mesh")]
    rows = []
    for unit in graph.units():
        parts = [part for name in unit.parts if isinstance(part := graph.nodes[name], Part)]
        known = [part.label.confidence for part in parts if part.label is not None]
        cluster = graph.cluster_of(parts[0]) if parts else None
        largest = max(parts, key=lambda part: part.area, default=None)
        rows.append(
            (
                Cell(unit.tag, color=colors.get(unit.unit_type, "")),
                Cell(unit.unit_type),
                Cell(unit.kind or ""),
                _number(len(unit.parts)),
                *(_length(c) for c in unit.centroid),
                _share(float(np.mean(known))) if known else Cell("", "-1"),
                Cell(cluster.id if cluster else ""),
                Cell(largest.meshes[0] if largest else "", code=True),
            )
        )
    return _table("units", columns, rows, drop=() if with_kind else ("Kind",))


def connection_table(graph: SceneGraph) -> Table:
    """All connections along the pipes: between two units, at a junction, or to an end."""
    flows = {"forward": "→", "backward": "←", "unknown": "unknown"}
    between = {"units": "units", "junction": "a junction", "end": "an end"}
    columns = [
        Column("From"), Column("To"), Column("Joins"), Column("Along the pipe [m]", True), Column("Bore [mm]", True),
        Column("Parts between", True), Column("Flow"), Column("Reason"), Column("Confidence", True),
    ]  # fmt: skip
    rows = [
        (
            Cell(_title(graph.nodes[edge.source])), Cell(_title(graph.nodes[edge.target])),
            Cell(between[connection_between(graph, edge)]),
            _blank() if edge.length is None else _length(edge.length),
            _blank() if edge.diameter is None else Cell(f"{edge.diameter * 1000:.0f}", str(edge.diameter)),
            _number(len(edge.via)), Cell(flows[edge.direction]), Cell(edge.reason or ""),
            _blank() if edge.confidence is None else _share(edge.confidence),
        )
        for edge in graph.connections()
    ]  # fmt: skip
    return _table("connections", columns, rows)


def related_table(graph: SceneGraph) -> Table:
    """The pairs of units that Algorithm 1 of the paper relates, with the distance between their middles."""
    rows = []
    for edge in graph.related():
        ends = [graph.nodes[edge.source], graph.nodes[edge.target]]
        middles = [end.centroid for end in ends if isinstance(end, Unit)]
        apart = _length(math.dist(*middles)) if len(middles) == 2 else _blank()
        rows.append((Cell(_title(ends[0])), Cell(_title(ends[1])), apart))
    return _table("related", [Column("Unit"), Column("Other unit"), Column("Apart [m]", True)], rows)


def line_table(graph: SceneGraph) -> Table:
    """The line list, as ``cadgraph lines`` prints it."""
    flows = {"forward": "→", "backward": "←", "none": "none", "unknown": "unknown", "contradictory": "contradictory"}
    rows = [
        (
            Cell(line.tag),
            Cell(line.start_name),
            Cell(flows[line.flow]),
            Cell(line.end_name),
            Cell(" ".join(line.through_words)),
            _blank() if line.length is None else _length(line.length),
            Cell(line.size, str(line.sizes[0]) if line.sizes else "-1"),
        )
        for line in find_lines(graph)
    ]
    columns = [
        Column("Line"), Column("From"), Column("Flow"), Column("To"), Column("Through"), Column("Length [m]", True),
        Column("DN", True),
    ]  # fmt: skip
    return _table("lines", columns, rows)


def cluster_table(graph: SceneGraph) -> Table:
    """All clusters, the largest first, with the colours of the picture by cluster."""
    colors = cluster_colors(graph)
    meshes: Counter[str] = Counter()
    for part in graph.parts():
        cluster = graph.cluster_of(part)
        if cluster is not None:
            meshes[cluster.id] += len(part.meshes)
    units: Counter[str] = Counter()
    for unit in graph.units():
        cluster = graph.cluster_of(unit.parts[0]) if unit.parts else None
        if cluster is not None:
            units[cluster.id] += 1
    columns = [
        Column("Cluster"), Column("Kind"), Column("Parts", True), Column("Meshes", True), Column("Units", True),
        Column("Size [m]", True), Column("Centre [m]"),
    ]  # fmt: skip
    rows = []
    for cluster in largest_first(graph.clusters()):
        extent = np.subtract(cluster.aabb[1], cluster.aabb[0])
        rows.append(
            (
                Cell(cluster.id, color=colors[cluster.id]),
                Cell(kind_words(cluster)),
                _number(cluster.n_parts),
                _number(meshes[cluster.id]),
                _number(units[cluster.id]),
                Cell(" × ".join(f"{c:.2f}" for c in extent), str(float(np.linalg.norm(extent)))),
                Cell(", ".join(f"{c:.2f}" for c in cluster.centroid)),
            )
        )
    return _table("clusters", columns, rows)


def label_table(graph: SceneGraph, colors: Mapping[str, str]) -> Table:
    """How often each label was given, how sure it was, how many of them are likely only, and by whom.

    Args:
        graph: the finished graph.
        colors: by group.
    """
    by_label: dict[tuple[str, str], list[Part]] = defaultdict(list)
    for part in graph.parts():
        if part.label is not None:
            by_label[part.label.group, part.label.name or ""].append(part)
    total = len(graph.parts())
    order = sorted(by_label, key=lambda label: (list(colors).index(label[0]), -len(by_label[label]), label[1]))
    rows = []
    for group, name in order:
        labels = [part.label for part in by_label[group, name] if part.label is not None]
        sources = Counter(label.source for label in labels)
        rows.append(
            (
                Cell(group, color=colors[group]),
                Cell(name or "(group only)"),
                _number(len(labels)),
                _share(len(labels) / total),
                _number(sum(len(part.meshes) for part in by_label[group, name])),
                _share(float(np.mean([label.confidence for label in labels]))),
                _number(sum(label.likely for label in labels)),
                Cell(", ".join(f"{source} {count}" for source, count in sorted(sources.items()))),
            )
        )
    without = [part for part in graph.parts() if part.label is None]
    if without:
        counts = (_number(len(without)), _share(len(without) / total), _number(sum(len(p.meshes) for p in without)))
        rows.append(
            (
                Cell("unlabelled", color=UNLABELLED, hatched=True),
                Cell(""),
                *counts,
                Cell("", "-1"),
                _number(0),
                Cell(""),
            )
        )
    columns = [
        Column("Group"), Column("Name"), Column("Parts", True), Column("Share", True), Column("Meshes", True),
        Column("Confidence", True), Column("Likely, not sure", True), Column("Source"),
    ]  # fmt: skip
    return _table("labels", columns, rows)


def label_bars(graph: SceneGraph, colors: Mapping[str, str]) -> list[Bar]:
    """The label distribution: a bar for each group in use, in the order of the vocabulary, the unlabelled last."""
    names: dict[str, Counter[str]] = defaultdict(Counter)
    for part in graph.parts():
        if part.label is not None:
            names[part.label.group][part.label.name or "(group only)"] += 1
    bars = [
        Bar(group, color, tuple(sorted(names[group].items(), key=lambda item: (-item[1], item[0]))))
        for group, color in colors.items()
        if group in names
    ]
    without = sum(part.label is None for part in graph.parts())
    if without:
        bars.append(Bar("unlabelled", UNLABELLED, (("no label", without),), hatched=True))
    return bars


def findings(graph: SceneGraph) -> list[Findings]:
    """The diagnostics by code, in the order in which the codes first appear."""
    messages: dict[str, list[str]] = defaultdict(list)
    meshes: dict[str, list[str]] = defaultdict(list)
    for finding in graph.diagnostics:
        messages[finding.code].append(finding.message)
        meshes[finding.code] += finding.meshes
    result = []
    for code, told in messages.items():
        different = list(dict.fromkeys(told))
        paths = list(dict.fromkeys(meshes[code]))
        result.append(
            Findings(
                code, len(paths) or len(told), tuple(different[:_MOST_MESSAGES]),
                max(0, len(different) - _MOST_MESSAGES), tuple(paths[:_MOST_MESHES]), max(0, len(paths) - _MOST_MESHES),
            )
        )  # fmt: skip
    return result


def setting_table(graph: SceneGraph) -> Table:
    """Every setting in force, with its meaning and source."""
    meanings = {name: (meaning, source) for name, _, meaning, source in describe(Config())}
    rows = []
    for name, value in _flattened(graph.config, ""):
        meaning, source = meanings.get(name, ("", ""))
        text = value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)
        rows.append((Cell(name, code=True), Cell(text, code=True), Cell(meaning), Cell(source)))
    columns = [Column("Setting"), Column("Value"), Column("Meaning"), Column("Source")]
    return _table("settings", columns, rows)


def _flattened(tree: Mapping[str, Any], prefix: str) -> Iterator[tuple[str, Any]]:
    for name, value in tree.items():
        if isinstance(value, Mapping):
            yield from _flattened(value, f"{prefix}{name}.")
        else:
            yield prefix + str(name), value


def _table(name: str, columns: list[Column], rows: Sequence[tuple[Cell, ...]], drop: tuple[str, ...] = ()) -> Table:
    kept = [i for i, column in enumerate(columns) if column.title not in drop]
    shown = tuple(tuple(row[i] for i in kept) for row in rows[:_MOST_ROWS])
    return Table(name, tuple(columns[i] for i in kept), shown, max(0, len(rows) - _MOST_ROWS))


def _title(node: Node) -> str:
    return node.tag if isinstance(node, Unit) else node.id


def _number(count: int) -> Cell:
    return Cell(f"{count:,}", str(count))


def _length(metres: float) -> Cell:
    # Adding zero turns a rounded -0.000 into 0.000.
    return Cell(f"{round(metres, 3) + 0.0:,.3f}", repr(metres))


def _share(value: float) -> Cell:
    return Cell(f"{100 * value:.0f} %" if value >= 0.1 or value == 0 else f"{100 * value:.1f} %", repr(value))


def _blank() -> Cell:
    return Cell("", "-1")
