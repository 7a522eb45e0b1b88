"""What was found, in a few lines."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.graph import SceneGraph
from cadgraph.model.mechanisms import NOT_MOVABLE
from cadgraph.model.records import Connected, Junction, Terminal
from cadgraph.query.doubt import unconnected
from cadgraph.query.network import Network

__all__ = ["Summary", "connection_between", "connection_words", "end_words", "share_words", "summarize"]

# What a note says whose paths were cut short.
_IN_ALL = re.compile(r"\(([\d,]+) in all\)$")
_OF_UNITS = frozenset({NOT_MOVABLE})  # findings about a unit each, whose meshes they name
_GRAVE = frozenset({
    "broken-chunk", "broken-element", "broken-mesh", "broken-node", "broken-object", "broken-primitive", "cut-short",
    "damaged-entity", "trailing-bytes", "unbalanced-tree", "unreadable",
    "damaged-source", "invalid-units", "invalid-up-axis", "missing-layer", "missing-payload", "missing-reference",
    "mixed-units", "mixed-up-axis", "outside-asset", "unit-doubt", "missing-up-axis",
    "flat-transform", "projective-transform", "unusual-size", "vocabulary-unknown-to-model",
    "attributes-unread", "attributes-damaged", "attributes-of-another", "invalid-face-counts", "too-far",
})  # fmt: skip
"""Codes of findings that are said aloud: something is missing, or with the wrong scale or vocabulary hardly any label
can be right.
"""


@dataclass(frozen=True)
class Summary:
    """Counts of what a graph holds.

    Args:
        source: the scene's file, as given.
        n_meshes: source meshes.
        n_triangles: in them.
        n_parts: after grouping.
        n_clusters: connected structures.
        n_with_pipes: those that hold a connector part.
        n_labelled: parts with a label.
        groups: number of parts by group, the commonest first.
        units: tags by unit type.
        n_adjacent: pairs of parts that touch.
        n_connected: connections along the pipes.
        between: how many of them join two ``units``, how many a ``junction``, and how many lead to an ``end``.
        n_junctions: where three or more lines meet.
        ends: number of ends of lines by kind (``open``, ``blind``, ``unknown``).
        n_systems: connected networks of pipes.
        without_line: tags of the units at which no line was found, with those of the units that each is mounted at.
        n_related: pairs of units that Algorithm 1 of the paper relates.
        diagnostics: number of findings' meshes (or findings, where they name none) by code.
        ground: which mesh was taken for the ground and why; where none was, why the likeliest was not.
        warnings: what may spoil the whole result, in words.
    """

    source: str
    n_meshes: int
    n_triangles: int
    n_parts: int
    n_clusters: int
    n_with_pipes: int
    n_labelled: int
    groups: dict[str, int]
    units: dict[str, tuple[str, ...]]
    n_adjacent: int
    n_connected: int
    between: dict[str, int]
    n_junctions: int
    ends: dict[str, int]
    n_systems: int
    without_line: dict[str, tuple[str, ...]]
    n_related: int
    diagnostics: dict[str, int]
    ground: tuple[str, ...]
    warnings: tuple[str, ...]


def connection_between(graph: SceneGraph, edge: Connected) -> Literal["units", "junction", "end"]:
    """What a connection joins: two units, or at least one junction; or it leads to an end, whatever the other side."""
    nodes = graph.nodes[edge.source], graph.nodes[edge.target]
    if any(isinstance(node, Terminal) for node in nodes):
        return "end"
    return "junction" if any(isinstance(node, Junction) for node in nodes) else "units"


def summarize(graph: SceneGraph) -> Summary:
    """Counts what a graph holds."""
    groups: Counter[str] = Counter()
    for (group, _), n in graph.label_counts.items():
        groups[group] += n
    units: dict[str, list[str]] = {}
    for unit in graph.units():
        units.setdefault(unit.unit_type, []).append(unit.tag)
    findings: Counter[str] = Counter()
    for finding in graph.diagnostics:
        whole = _IN_ALL.search(finding.message)
        n_meshes = 1 if finding.code in _OF_UNITS else len(finding.meshes)
        findings[finding.code] += int(whole[1].replace(",", "")) if whole else max(1, n_meshes)
    return Summary(
        source=graph.source.path,
        n_meshes=graph.source.n_meshes,
        n_triangles=graph.source.n_triangles,
        n_parts=graph.count("part"),
        n_clusters=len(graph.clusters()),
        n_with_pipes=len(graph.clusters("pipe system")),
        n_labelled=groups.total(),
        groups=dict(sorted(groups.items(), key=lambda item: (-item[1], item[0]))),
        units={unit_type: tuple(tags) for unit_type, tags in units.items()},
        n_adjacent=graph.count("adjacent"),
        n_connected=len(graph.connections()),
        between=dict(Counter(connection_between(graph, edge) for edge in graph.connections())),
        n_junctions=len(graph.junctions()),
        ends=dict(sorted(Counter(end.kind for end in graph.terminals()).items())),
        n_systems=len(graph.systems()),
        without_line=unconnected(Network(graph)) if graph.connections() else {},
        n_related=len(graph.related()),
        diagnostics=dict(sorted(findings.items())),
        ground=_ground(graph.diagnostics),
        warnings=tuple(finding.message for finding in graph.diagnostics if finding.code in _GRAVE),
    )


def _ground(findings: Sequence[Diagnostic]) -> tuple[str, ...]:
    found = [one for one in findings if one.code in ("ground", "ground-corrected", "no-ground")]
    if any(one.code == "no-ground" for one in found):
        found += [one for one in findings if one.code == "not-ground"][:1]
    return tuple(
        f"{one.meshes[0]}{f' and {len(one.meshes) - 1} more' if len(one.meshes) > 1 else ''}: {one.message}"
        if one.meshes
        else one.message
        for one in found
    )


def connection_words(summary: Summary) -> str:
    """How many connections there are and what they join: "33: 20 between units, 11 at junctions, 2 to ends"."""
    manners = (("units", "between units"), ("junction", "at junctions"), ("end", "to ends"))
    told = [f"{summary.between[key]:,} {words}" for key, words in manners if summary.between.get(key)]
    return f"{summary.n_connected:,}{': ' if told else ''}{', '.join(told)}"


def end_words(summary: Summary) -> str:
    """How many ends of lines there are of which kind: "3: 2 open, 1 blind"."""
    told = [f"{summary.ends[kind]:,} {kind}" for kind in ("open", "blind", "unknown") if summary.ends.get(kind)]
    return f"{sum(summary.ends.values()):,}{': ' if told else ''}{', '.join(told)}"


def share_words(count: int, total: int) -> str:
    """A share in percent; it reads 100 only where nothing is missing, and 0 only where nothing is there."""
    percent = 100 * count / total if total else 0.0
    if 0 < count < total:
        percent = min(max(percent, 0.1), 99.9)
    return f"{percent:.1f} %" if 0 < percent < 1 or 99 < percent < 100 else f"{percent:.0f} %"
