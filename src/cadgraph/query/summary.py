"""What was found, in a few lines."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Adjacent, Connected, Related

__all__ = ["Summary", "summarize"]

_GRAVE = frozenset({"invalid-units", "invalid-up-axis", "unusual-size", "vocabulary-unknown-to-model"})
"""Codes of findings that are said aloud: with the wrong scale or vocabulary hardly any label can be right."""


@dataclass(frozen=True)
class Summary:
    """Counts of what a graph holds.

    Args:
        source: the scene's file, as given.
        n_meshes: source meshes.
        n_triangles: in them.
        n_parts: after grouping.
        n_clusters: connected structures.
        n_pipe_systems: those that hold a connector part.
        n_labelled: parts with a label.
        groups: number of parts by group, the commonest first.
        units: tags by unit type.
        n_adjacent: pairs of parts that touch.
        n_related: pairs of units that Algorithm 1 relates.
        n_connected: connections along pipes.
        diagnostics: number of findings' meshes (or findings, where they name none) by code.
        warnings: what may spoil the whole result, in words.
    """

    source: str
    n_meshes: int
    n_triangles: int
    n_parts: int
    n_clusters: int
    n_pipe_systems: int
    n_labelled: int
    groups: dict[str, int]
    units: dict[str, tuple[str, ...]]
    n_adjacent: int
    n_related: int
    n_connected: int
    diagnostics: dict[str, int]
    warnings: tuple[str, ...]


def summarize(graph: SceneGraph) -> Summary:
    """Counts what a graph holds."""
    parts = graph.parts()
    groups = Counter(part.label.group for part in parts if part.label is not None)
    units: dict[str, list[str]] = {}
    for unit in graph.units():
        units.setdefault(unit.unit_type, []).append(unit.tag)
    findings: Counter[str] = Counter()
    for finding in graph.diagnostics:
        findings[finding.code] += max(1, len(finding.meshes))
    return Summary(
        source=graph.source.path,
        n_meshes=graph.source.n_meshes,
        n_triangles=graph.source.n_triangles,
        n_parts=len(parts),
        n_clusters=len(graph.clusters()),
        n_pipe_systems=len(graph.clusters("pipe system")),
        n_labelled=sum(part.label is not None for part in parts),
        groups=dict(sorted(groups.items(), key=lambda item: (-item[1], item[0]))),
        units={unit_type: tuple(tags) for unit_type, tags in units.items()},
        n_adjacent=len(graph.of_kind(Adjacent)),
        n_related=len(graph.of_kind(Related)),
        n_connected=len(graph.of_kind(Connected)),
        diagnostics=dict(sorted(findings.items())),
        warnings=tuple(finding.message for finding in graph.diagnostics if finding.code in _GRAVE),
    )
