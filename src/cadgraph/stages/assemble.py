"""Putting the results of all stages together as one graph."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.graph import SceneGraph
from cadgraph.parts import Contacts, Label, Parts, UnitParts
from cadgraph.records import (
    Adjacent,
    Cluster,
    Contains,
    Edge,
    Finding,
    GraphDocument,
    Node,
    OrientedBox,
    Part,
    PartLabel,
    Related,
    Site,
    SourceRecord,
    Unit,
    points,
)
from cadgraph.scene import Diagnostic, Floats, Ints, Scene
from cadgraph.vocabulary import Vocabulary

__all__ = ["Results", "assemble_graph"]

PIPE_SYSTEM = "pipe system"


@dataclass(frozen=True)
class Results:
    """What the stages found.

    Args:
        scene: the source meshes.
        parts: made from them.
        contacts: pairs of adjacent parts.
        cluster: ``(n_parts,)`` -1 for the ground and for noise.
        pipe_systems: the clusters that hold a connector part.
        labels: of each part.
        units: functional units.
        related: pairs of unit indices.
        diagnostics: of all stages.
    """

    scene: Scene
    parts: Parts
    contacts: Contacts
    cluster: Ints
    pipe_systems: frozenset[int]
    labels: Sequence[Label | None]
    units: Sequence[UnitParts]
    related: Sequence[tuple[int, int]]
    diagnostics: Sequence[Diagnostic]


def assemble_graph(results: Results, vocabulary: Vocabulary, config: dict[str, object]) -> SceneGraph:
    """Makes the graph; ids are numbered in the order of parts, clusters and units.

    Args:
        results: of all stages.
        vocabulary: the tree in use.
        config: every setting in force, as plain values.
    """
    scene, parts = results.scene, results.parts
    width = max(5, len(str(parts.n_parts)))
    part_ids = [f"part-{i:0{width}d}" for i in range(parts.n_parts)]
    n_clusters = int(results.cluster.max(initial=-1)) + 1
    cluster_ids = [f"cluster-{i:0{max(3, len(str(n_clusters)))}d}" for i in range(n_clusters)]
    site = Site(id="site")
    clusters = _clusters(results, cluster_ids)
    units = _units(results, part_ids)
    edges: list[Edge] = [Contains(source=site.id, target=cluster.id) for cluster in clusters]
    edges += [
        Contains(source=cluster_ids[c] if c >= 0 else site.id, target=part_ids[i])
        for i, c in enumerate(results.cluster.tolist())
    ]
    edges += [Contains(source=unit.id, target=part) for unit in units for part in unit.parts]
    edges += _adjacency(results, part_ids)
    edges += [Related(source=units[a].id, target=units[b].id) for a, b in results.related]
    nodes: tuple[Node, ...] = (site, *clusters, *_parts(results, part_ids), *units)
    return SceneGraph(
        GraphDocument(
            source=SourceRecord(
                path=scene.source.path,
                sha256=scene.source.sha256,
                meters_per_unit=scene.source.meters_per_unit,
                up_axis=scene.source.up_axis,
                n_meshes=scene.n_meshes,
                n_triangles=scene.n_triangles,
            ),
            vocabulary=vocabulary.to_json(),
            config=config,
            nodes=nodes,
            edges=tuple(edges),
            diagnostics=tuple(_findings(results)),
        )
    )


def _parts(results: Results, ids: Sequence[str]) -> list[Part]:
    scene, parts, measured = results.scene, results.parts, results.parts.properties
    centroids = points(measured.centroid + scene.origin)
    corners = points((measured.aabb + scene.origin).reshape(-1, 3))
    centers = points(measured.obb_center + scene.origin)
    axes = points(measured.obb_axes.reshape(-1, 3))
    extents = points(measured.obb_extents)
    return [
        Part(
            id=ids[i],
            meshes=tuple(scene.paths[mesh] for mesh in parts.meshes[i]),
            label=_label(results.labels[i]),
            centroid=centroids[i],
            aabb=(corners[2 * i], corners[2 * i + 1]),
            obb=OrientedBox(
                center=centers[i], axes=(axes[3 * i], axes[3 * i + 1], axes[3 * i + 2]), extents=extents[i]
            ),
            area=_rounded(measured.area[i]),
            volume=_rounded(measured.volume[i]) if measured.closed[i] else None,
            n_triangles=int(measured.n_triangles[i]),
            shape=f"shape-{parts.shape[i]:05d}",
            ground=bool(parts.ground[i]),
        )
        for i in range(parts.n_parts)
    ]


def _clusters(results: Results, ids: Sequence[str]) -> list[Cluster]:
    by_cluster: list[list[int]] = [[] for _ in ids]
    for part, cluster in enumerate(results.cluster.tolist()):
        if cluster >= 0:
            by_cluster[cluster].append(part)
    nodes = []
    for i, members in enumerate(by_cluster):
        groups = Counter(label.group for part in members if (label := results.labels[part]) is not None)
        commonest = min(groups, key=lambda group: (-groups[group], group), default=None)
        centroid, low, high = _extent(results, members)
        nodes.append(
            Cluster(
                id=ids[i],
                kind=PIPE_SYSTEM if i in results.pipe_systems else commonest,
                n_parts=len(members),
                centroid=centroid,
                aabb=(low, high),
            )
        )
    return nodes


def _units(results: Results, part_ids: Sequence[str]) -> list[Unit]:
    nodes = []
    for unit in results.units:
        centroid, low, high = _extent(results, unit.parts)
        nodes.append(
            Unit(
                id=f"unit-{unit.tag}",
                unit_type=unit.unit_type,
                tag=unit.tag,
                parts=tuple(part_ids[part] for part in unit.parts),
                centroid=centroid,
                aabb=(low, high),
            )
        )
    return nodes


def _adjacency(results: Results, part_ids: Sequence[str]) -> list[Adjacent]:
    """Edges between parts of one cluster; each edge's point is midway between the two closest points."""
    contacts, cluster = results.contacts, results.cluster
    middles = points(contacts.points.mean(axis=1) + results.scene.origin)
    return [
        Adjacent(source=part_ids[a], target=part_ids[b], distance=_rounded(distance), point=middle)
        for (a, b), distance, middle in zip(contacts.pairs.tolist(), contacts.distance, middles, strict=True)
        if cluster[a] == cluster[b] >= 0
    ]


def _findings(results: Results) -> list[Finding]:
    parts, paths = results.parts, results.scene.paths
    found = list(results.diagnostics)
    noise = [i for i in range(parts.n_parts) if results.cluster[i] < 0 and not parts.ground[i]]
    unlabelled = [i for i, label in enumerate(results.labels) if label is None and not parts.ground[i]]
    for code, message, members in (
        ("noise", "parts with too few neighbours to belong to a cluster", noise),
        ("unlabelled", "parts that no labeler is sure enough about", unlabelled),
    ):
        if members:
            heads = tuple(paths[parts.meshes[i][0]] for i in members)
            found.append(Diagnostic(code, f"{len(members)} {message}", heads))
    return [Finding(code=d.code, message=d.message, meshes=d.meshes) for d in found]


def _label(label: Label | None) -> PartLabel | None:
    if label is None:
        return None
    return PartLabel(
        group=label.group,
        name=label.name,
        confidence=round(label.confidence, 6),
        source=label.source,
        evidence=dict(label.evidence),
    )


def _extent(
    results: Results, members: Sequence[int]
) -> tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]]:
    """The area-weighted centroid of some parts, and the corners of their common box, in world coordinates."""
    measured, index = results.parts.properties, np.asarray(members)
    weight: Floats = measured.area[index]
    weight = weight if weight.sum() > 0 else np.ones(len(index))
    centroid = np.average(measured.centroid[index], axis=0, weights=weight)
    corners = [centroid, measured.aabb[index, 0].min(axis=0), measured.aabb[index, 1].max(axis=0)]
    middle, low, high = points(np.array(corners) + results.scene.origin)
    return middle, low, high


def _rounded(value: float) -> float:
    """Nine significant digits: below that lies rounding noise."""
    return float(f"{float(value):.9g}")
