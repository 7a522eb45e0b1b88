"""Putting the results of all stages together as one graph."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import Guess, Label
from cadgraph.model.parts import Contacts, Link, Network, Parts, UnitParts
from cadgraph.model.records import (
    Adjacent,
    Cluster,
    Connected,
    Contains,
    Edge,
    GraphDocument,
    Joint,
    Junction,
    Node,
    OrientedBox,
    Part,
    Point,
    Port,
    Related,
    Site,
    SourceRecord,
    Stated,
    System,
    Terminal,
    Unit,
    points,
)
from cadgraph.model.scene import Floats, Ints, Scene
from cadgraph.model.stated import resolve_links
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["Results", "assemble_graph"]

PIPE_SYSTEM = "pipe system"
_ENDINGS: dict[str, Literal["open", "blind"]] = {"open": "open", "blind": "blind"}


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
        guesses: of each part that has no label because nobody is sure enough.
        network: functional units, and what follows what along the lines between them.
        related: pairs of unit indices.
        diagnostics: of all stages.
    """

    scene: Scene
    parts: Parts
    contacts: Contacts
    cluster: Ints
    pipe_systems: frozenset[int]
    labels: Sequence[Label | None]
    guesses: Sequence[Sequence[Guess]]
    network: Network
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
    places = _places(results, part_ids)
    ends = [node.id for node in (*units, *places)]
    edges += [_connected(link, results, ends, part_ids) for link in results.network.links]
    systems = _systems(results, ends)
    edges += [Contains(source=s.id, target=node) for s in systems for node in (*s.units, *s.junctions, *s.terminals)]
    nodes: tuple[Node, ...] = (site, *clusters, *_parts(results, part_ids), *units, *places, *systems)
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
            joints=tuple(_joints(results, part_ids)),
            stated=tuple(_stated(results, part_ids)),
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
            guesses=_guesses(_possible(results, i)),
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
            inside=ids[parts.inside[i]] if i in parts.inside else None,
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
    for unit in results.network.units:
        centroid, low, high = _extent(results, unit.parts)
        nodes.append(
            Unit(
                id=f"unit-{unit.tag}",
                unit_type=unit.unit_type,
                tag=unit.tag,
                kind=unit.kind,
                kind_guesses=unit.kind_guesses,
                parts=tuple(part_ids[part] for part in unit.parts),
                ports=_ports(unit, results.scene.origin),
                centroid=centroid,
                aabb=(low, high),
            )
        )
    return nodes


def _ports(unit: UnitParts, origin: Floats) -> tuple[Port, ...]:
    """The openings, named N1, N2... in their order."""
    return tuple(
        Port(
            name=f"N{number}",
            point=_point(opening.point, origin),
            direction=None if opening.direction is None else points(opening.direction)[0],
            diameter=None if opening.diameter is None else _rounded(opening.diameter),
        )
        for number, opening in enumerate(unit.openings, 1)
    )


def _places(results: Results, part_ids: Sequence[str]) -> list[Junction | Terminal]:
    """Junctions and terminals, each kind numbered in its order."""
    nodes: list[Junction | Terminal] = []
    counts: Counter[str] = Counter()
    for place in results.network.places:
        where, parts = _point(place.point, results.scene.origin), tuple(part_ids[part] for part in place.parts)
        layer = "junction" if place.kind == "junction" else "terminal"
        name = f"{layer}-{counts[layer]:03d}"
        counts[layer] += 1
        if layer == "junction":
            nodes.append(Junction(id=name, point=where, parts=parts))
        else:
            nodes.append(Terminal(id=name, kind=_ENDINGS.get(place.kind, "unknown"), point=where, parts=parts))
    return nodes


def _connected(link: Link, results: Results, ends: Sequence[str], part_ids: Sequence[str]) -> Connected:
    path = points(np.asarray(link.path, np.float64).reshape(-1, 3) + results.scene.origin)
    return Connected(
        source=ends[link.source],
        target=ends[link.target],
        via=tuple(part_ids[part] for part in link.via),
        length=_rounded(link.length),
        diameter=None if link.diameter is None else _rounded(link.diameter),
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


def _systems(results: Results, ends: Sequence[str]) -> list[System]:
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
            length=_rounded(lengths[k]),
            sizes=tuple(sorted(sizes[k])),
        )
        for k, members in enumerate(network.systems)
    ]


def _joints(results: Results, part_ids: Sequence[str]) -> list[Joint]:
    """What the connections are made of and what they might have been, by the parts that join and the place."""
    origin = results.scene.origin
    found = [
        Joint(
            first=part_ids[joint.first],
            second=part_ids[joint.second],
            kind=joint.kind,
            point=_point(joint.point, origin),
            gap=_rounded(joint.gap),
            score=round(joint.score, 6),
            made=joint.made,
            reasons=joint.reasons,
        )
        for joint in results.network.joints
    ]
    return sorted(found, key=lambda joint: (joint.first, joint.second, joint.point, joint.kind, not joint.made))


def _stated(results: Results, part_ids: Sequence[str]) -> list[Stated]:
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


def _point(point: Point, origin: Floats) -> Point:
    return points(np.asarray(point) + origin)[0]


def _adjacency(results: Results, part_ids: Sequence[str]) -> list[Adjacent]:
    """Edges between parts of one cluster; each edge's point is midway between the two closest points."""
    contacts, cluster = results.contacts, results.cluster
    middles = points(contacts.points.mean(axis=1) + results.scene.origin)
    return [
        Adjacent(source=part_ids[a], target=part_ids[b], distance=_rounded(distance), point=middle)
        for (a, b), distance, middle in zip(contacts.pairs.tolist(), contacts.distance, middles, strict=True)
        if cluster[a] == cluster[b] >= 0
    ]


def _findings(results: Results) -> list[Diagnostic]:
    parts, paths = results.parts, results.scene.paths
    found = list(results.diagnostics)
    noise = [i for i in range(parts.n_parts) if results.cluster[i] < 0 and not parts.ground[i]]
    unlabelled = [i for i, label in enumerate(results.labels) if label is None and not parts.ground[i]]
    likely = [i for i, label in enumerate(results.labels) if label is not None and label.likely]
    for code, message, members in (
        ("noise", "parts with too few neighbours to belong to a cluster", noise),
        ("unlabelled", "parts that no labeler has a likely name for", unlabelled),
        ("likely", "parts with a likely label that is not sure", likely),
    ):
        if members:
            heads = tuple(paths[parts.meshes[i][0]] for i in members)
            found.append(Diagnostic(code, f"{len(members)} {message}", heads))
    return found


def _guesses(guesses: Sequence[Guess]) -> tuple[Guess, ...]:
    return tuple(g.model_copy(update={"confidence": round(g.confidence, 6)}) for g in guesses)


def _possible(results: Results, part: int) -> Sequence[Guess]:
    """What a part may be; nothing where its label alone is possible."""
    label = results.labels[part]
    if label is None:
        return results.guesses[part]
    return label.guesses if len(label.guesses) > 1 else ()


def _label(label: Label | None) -> Label | None:
    if label is None:
        return None
    return label.model_copy(update={"confidence": round(label.confidence, 6), "guesses": ()})


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
