"""Putting the results of all stages together as one graph."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from cadgraph._io.garbage import collector_paused
from cadgraph.facts.places import NodeFacts, Places
from cadgraph.model.derived import kept_with, store_of
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.facts import Fact
from cadgraph.model.graph import SceneGraph
from cadgraph.model.grid import to_runs
from cadgraph.model.labels import Guess, Label
from cadgraph.model.mechanisms import UnitMotion, records_of
from cadgraph.model.parts import Contacts, Link, Network, Parts, UnitParts
from cadgraph.model.places import FoundPlace, FoundPlaces, UnitAccess
from cadgraph.model.records import (
    Access,
    Adjacent,
    Cluster,
    Connected,
    Contains,
    Edge,
    FreeFloor,
    GraphDocument,
    Joint,
    Junction,
    Node,
    OrientedBox,
    Part,
    Place,
    Point,
    Port,
    ReachedFrom,
    Related,
    Site,
    SourceFact,
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
_SITE = "site"
_LONGEST_FACT = 1000  # characters of a value that are kept; a file may hold anything
_AT_ONCE = 4096  # parts whose numbers are rounded together
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
        places: where what the file says of its parts stands; None where it says nothing.
        reached: levels, ways up, how people get at the units; None where not looked for.
        motions: what moves or is read at each unit; likewise.
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
    places: Places | None = None
    reached: FoundPlaces | None = None
    motions: Sequence[UnitMotion] = ()


def assemble_graph(results: Results, vocabulary: Vocabulary, config: dict[str, object]) -> SceneGraph:
    """Makes the graph; ids are numbered in the order of parts, clusters and units.

    Args:
        results: of all stages.
        vocabulary: the tree in use.
        config: every setting in force, as plain values.
    """
    with collector_paused():
        return _assembled(results, vocabulary, config)


def _assembled(results: Results, vocabulary: Vocabulary, config: dict[str, object]) -> SceneGraph:
    scene, parts, part_ids = results.scene, results.parts, _part_ids(results.parts)
    above = results.places.of_units([unit.parts for unit in results.network.units]) if results.places else ()
    site = Site(id=_SITE, facts=_facts(results.places.left_over(above) if results.places else ()))
    clusters = _clusters(results, _cluster_ids(results.cluster))
    units = _units(results, part_ids, above)
    edges: list[Edge] = [Contains(source=site.id, target=cluster.id) for cluster in clusters]
    edges += _held_parts(parts, results.cluster)
    edges += [Contains(source=unit.id, target=part) for unit in units for part in unit.parts]
    edges += _adjacency(results.contacts, results.cluster, parts, scene)
    edges += [Related(source=units[a].id, target=units[b].id) for a, b in results.related]
    places = _places(results, part_ids)
    ends = [node.id for node in (*units, *places)]
    edges += [_connected(link, results, ends, part_ids) for link in results.network.links]
    systems = _systems(results, ends)
    edges += [Contains(source=s.id, target=node) for s in systems for node in (*s.units, *s.junctions, *s.terminals)]
    levels = _levels(results, part_ids)
    edges += _reached(results, levels, units)
    nodes: tuple[Node, ...] = (site, *clusters, *_parts(results), *units, *places, *systems, *levels)
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


@kept_with
def _part_ids(parts: Parts) -> tuple[str, ...]:
    width = max(5, len(str(parts.n_parts)))
    return tuple(f"part-{i:0{width}d}" for i in range(parts.n_parts))


def _cluster_ids(cluster: Ints) -> list[str]:
    n_clusters = int(cluster.max(initial=-1)) + 1
    return [f"cluster-{i:0{max(3, len(str(n_clusters)))}d}" for i in range(n_clusters)]


def _parts(results: Results) -> list[Part]:
    """The record of each part: that of the graph before where its label and its guesses are the same."""
    kept = store_of(results.parts, "records", results.scene, results.places)
    said = [(label, _possible(results, part)) for part, label in enumerate(results.labels)]
    ids = _part_ids(results.parts)
    new = [part for part in range(len(said)) if part not in kept or kept[part][0] != said[part]]
    round_guesses = _RoundGuesses()
    for start in range(0, len(new), _AT_ONCE):
        some = new[start : start + _AT_ONCE]
        for part, shape in zip(some, _points_of(results, some), strict=True):
            label, guesses = said[part]
            kept[part] = said[part], _part_of(results, part, ids, shape, label, round_guesses[tuple(guesses)])
    return [kept[part][1] for part in range(results.parts.n_parts)]


def _points_of(results: Results, parts: Sequence[int]) -> Iterator[tuple[Point, ...]]:
    """Of each part its centroid, the centre of its box, two corners, the three axes and the extents of its box."""
    measured, rows = results.parts.properties, np.asarray(parts, np.int64)
    middles = np.stack([measured.centroid[rows], measured.obb_center[rows]], axis=1)
    placed = np.concatenate([middles, measured.aabb[rows]], axis=1) + results.scene.origin
    box = np.concatenate([measured.obb_axes[rows], measured.obb_extents[rows][:, None]], axis=1)
    found = iter(points(np.concatenate([placed, box], axis=1)))
    return zip(*[found] * 8, strict=True)


def _part_of(
    results: Results,
    part: int,
    ids: Sequence[str],
    shape: Sequence[Point],
    label: Label | None,
    guesses: tuple[Guess, ...],
) -> Part:
    measured, parts = results.parts.properties, results.parts
    centroid, center, low, high, first, second, third, extents = shape
    return Part(
        id=ids[part],
        meshes=tuple(results.scene.paths[mesh] for mesh in parts.meshes[part]),
        label=_label(label),
        guesses=guesses,
        centroid=centroid,
        aabb=(low, high),
        obb=OrientedBox(center=center, axes=(first, second, third), extents=extents),
        area=_rounded(measured.area[part]),
        volume=_rounded(measured.volume[part]) if measured.closed[part] else None,
        n_triangles=int(measured.n_triangles[part]),
        shape=f"shape-{parts.shape[part]:05d}",
        ground=bool(parts.ground[part]),
        inside=ids[parts.inside[part]] if part in parts.inside else None,
        facts=_facts_of_part(results, part),
    )


def _facts_of_part(results: Results, part: int) -> tuple[SourceFact, ...]:
    if results.places is None:
        return ()
    return _facts(results.places.of_part(part), {results.scene.paths[mesh] for mesh in results.parts.meshes[part]})


def _facts(facts: Sequence[Fact], own: Collection[str] = ()) -> tuple[SourceFact, ...]:
    """Facts as records, each once; ``own`` are the paths that need not be told."""
    rows = ((f.key, f.value[:_LONGEST_FACT], f.where, None if f.path in own else f.path) for f in facts)
    return tuple(SourceFact(key=k, value=v, where=w, path=p) for k, v, w, p in dict.fromkeys(rows))


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


def _units(results: Results, part_ids: Sequence[str], above: Sequence[Sequence[NodeFacts]]) -> list[Unit]:
    nodes = []
    bores = _bores(results.network)
    for number, unit in enumerate(results.network.units):
        centroid, low, high = _extent(results, unit.parts)
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
                access=_access(results, number),
                **records_of(results.motions, number, results.scene),
                facts=_facts([fact for node in above[number] for fact in node.facts] if above else ()),
            )
        )
    return nodes


def _access(results: Results, number: int) -> Access | None:
    if results.reached is None:
        return None
    found: UnitAccess = results.reached.access[number]
    origin = results.scene.origin
    return Access(
        place=None if found.place is None else _place_id(found.place),
        stand=None if found.stand is None else _point(found.stand, origin),
        height=_rounded(found.height),
        reach=found.reach,
        facing=None if found.facing is None else points(found.facing)[0],
        facing_confidence=None if found.facing_confidence is None else round(found.facing_confidence, 6),
        viewpoint=None if found.viewpoint is None else _point(found.viewpoint, origin),
    )


def _place_id(number: int) -> str:
    return f"place-{number + 1:03d}"


def _levels(results: Results, part_ids: Sequence[str]) -> list[Place]:
    """Levels and ways up."""
    found = results.reached.places if results.reached is not None else ()
    return [_place(number, place, results.scene.origin, part_ids) for number, place in enumerate(found)]


def _place(number: int, place: FoundPlace, origin: Floats, part_ids: Sequence[str]) -> Place:
    lift = float(origin[2])
    floor = None
    if place.grid is not None and place.free is not None:
        (x, y), grid = place.grid.origin, place.grid
        corner = round(x + float(origin[0]), 9), round(y + float(origin[1]), 9)
        floor = FreeFloor(origin=corner, step=grid.step, size=grid.size, runs=to_runs(place.free))
    return Place(
        id=_place_id(number),
        kind=place.kind,
        name=place.name,
        height=_rounded(place.height + lift),
        low=None if place.low is None else _rounded(place.low + lift),
        area=_rounded(place.area),
        aabb=(_point(place.box[0], origin), _point(place.box[1], origin)),
        parts=tuple(part_ids[part] for part in place.parts),
        floor=floor,
        landings=tuple(_point(landing, origin) for landing in place.landings),
    )


def _reached(results: Results, levels: Sequence[Place], units: Sequence[Unit]) -> list[Edge]:
    """What is reached from each level, and from where one gets to the levels and the ways up."""
    found = results.reached.places if results.reached is not None else ()
    edges: list[Edge] = [
        Contains(source=unit.access.place, target=unit.id)
        for unit in units
        if unit.access is not None and unit.access.place is not None and unit.access.reach != "out of reach"
    ]
    edges += [
        ReachedFrom(source=levels[number].id, target=levels[other].id)
        for number, place in enumerate(found)
        for other in place.reached_from
    ]
    return edges


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
            point=_point(opening.point, origin),
            direction=None if opening.direction is None else points(opening.direction)[0],
            diameter=None if diameter is None else _rounded(diameter),
        )
        for number, (opening, diameter) in enumerate(zip(unit.openings, diameters, strict=True), 1)
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
    places = points(_table([joint.point for joint in results.network.joints]) + results.scene.origin)
    found = [
        Joint(
            first=part_ids[joint.first],
            second=part_ids[joint.second],
            kind=joint.kind,
            point=place,
            gap=_rounded(joint.gap),
            score=round(joint.score, 6),
            made=joint.made,
            reasons=joint.reasons,
        )
        for joint, place in zip(results.network.joints, places, strict=True)
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


@kept_with
def _held_parts(parts: Parts, cluster: Ints) -> list[Contains]:
    """What holds each part: its cluster, or the site."""
    ids, cluster_ids = _part_ids(parts), _cluster_ids(cluster)
    holders = [cluster_ids[number] if number >= 0 else _SITE for number in cluster.tolist()]
    return [Contains(source=holder, target=part) for holder, part in zip(holders, ids, strict=True)]


@kept_with
def _adjacency(contacts: Contacts, cluster: Ints, parts: Parts, scene: Scene) -> list[Adjacent]:
    """Edges between parts of one cluster; each edge's point is midway between the two closest points."""
    part_ids = _part_ids(parts)
    middles = points(contacts.points.mean(axis=1) + scene.origin)
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


class _RoundGuesses(dict[tuple[Guess, ...], tuple[Guess, ...]]):
    """What parts may be, rounded; parts alike, which are many, share it."""

    def __missing__(self, guesses: tuple[Guess, ...]) -> tuple[Guess, ...]:
        self[guesses] = found = tuple(
            g if g.confidence == (rounded := round(g.confidence, 6)) else g.model_copy(update={"confidence": rounded})
            for g in guesses
        )
        return found


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


def _table(rows: Sequence[Point]) -> Floats:
    return np.array(rows, np.float64).reshape(-1, 3)


def _rounded(value: float) -> float:
    """Nine significant digits: below that lies rounding noise."""
    return float(f"{float(value):.9g}")
