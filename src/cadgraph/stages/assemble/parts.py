"""The records of parts and clusters."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

import numpy as np

from cadgraph.model.derived import kept_with, once_for_each, store_of
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.labels import Guess, Label
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.records import Adjacent, Cluster, Contains, OrientedBox, Part, Point, SourceFact, points
from cadgraph.model.scene import Ints, Scene
from cadgraph.stages.assemble.results import Results, extent_of, fact_records, rounded

__all__ = [
    "SITE",
    "adjacency",
    "cluster_records",
    "findings",
    "held_parts",
    "ids_of_clusters",
    "ids_of_parts",
    "part_records",
]

_PIPE_SYSTEM = "pipe system"
SITE = "site"
"""Id of the node that everything hangs on."""
_AT_ONCE = 4096  # parts whose numbers are rounded together


@kept_with
def ids_of_parts(parts: Parts) -> tuple[str, ...]:
    """Of each part its id."""
    width = max(5, len(str(parts.n_parts)))
    return tuple(f"part-{i:0{width}d}" for i in range(parts.n_parts))


def ids_of_clusters(cluster: Ints) -> list[str]:
    """Of each cluster its id."""
    n_clusters = int(cluster.max(initial=-1)) + 1
    return [f"cluster-{i:0{max(3, len(str(n_clusters)))}d}" for i in range(n_clusters)]


def part_records(results: Results) -> list[Part]:
    """The record of each part: that of the graph before where its label and its guesses are the same."""
    kept = store_of(results.parts, "records", results.scene, results.places)
    said = [(label, _possible(results, part)) for part, label in enumerate(results.labels)]
    ids = ids_of_parts(results.parts)
    new = [part for part in range(len(said)) if part not in kept or kept[part][0] != said[part]]
    round_guesses, round_label = _RoundGuesses(), once_for_each(_rounded)
    for start in range(0, len(new), _AT_ONCE):
        some = new[start : start + _AT_ONCE]
        for part, shape in zip(some, _points_of(results, some), strict=True):
            label, guesses = said[part]
            known = None if label is None else round_label(label)
            kept[part] = said[part], _part_of(results, part, ids, shape, known, round_guesses[tuple(guesses)])
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
        label=label,
        guesses=guesses,
        centroid=centroid,
        aabb=(low, high),
        obb=OrientedBox(center=center, axes=(first, second, third), extents=extents),
        area=rounded(measured.area[part]),
        volume=rounded(measured.volume[part]) if measured.closed[part] else None,
        n_triangles=int(measured.n_triangles[part]),
        shape=f"shape-{parts.shape[part]:05d}",
        ground=bool(parts.ground[part]),
        inside=ids[parts.inside[part]] if part in parts.inside else None,
        facts=_facts_of_part(results, part),
    )


def _facts_of_part(results: Results, part: int) -> tuple[SourceFact, ...]:
    if results.places is None:
        return ()
    own = {results.scene.paths[mesh] for mesh in results.parts.meshes[part]}
    return fact_records(results.places.of_part(part), own)


def cluster_records(results: Results, ids: Sequence[str]) -> list[Cluster]:
    """The clusters, named by their pipes or else by the commonest group of their parts."""
    by_cluster: list[list[int]] = [[] for _ in ids]
    for part, cluster in enumerate(results.cluster.tolist()):
        if cluster >= 0:
            by_cluster[cluster].append(part)
    nodes = []
    for i, members in enumerate(by_cluster):
        groups = Counter(label.group for part in members if (label := results.labels[part]) is not None)
        commonest = min(groups, key=lambda group: (-groups[group], group), default=None)
        centroid, low, high = extent_of(results, members)
        nodes.append(
            Cluster(
                id=ids[i],
                kind=_PIPE_SYSTEM if i in results.pipe_systems else commonest,
                n_parts=len(members),
                centroid=centroid,
                aabb=(low, high),
            )
        )
    return nodes


@kept_with
def held_parts(parts: Parts, cluster: Ints) -> list[Contains]:
    """What holds each part: its cluster, or the site."""
    ids, cluster_ids = ids_of_parts(parts), ids_of_clusters(cluster)
    holders = [cluster_ids[number] if number >= 0 else SITE for number in cluster.tolist()]
    return [Contains(source=holder, target=part) for holder, part in zip(holders, ids, strict=True)]


@kept_with
def adjacency(contacts: Contacts, cluster: Ints, parts: Parts, scene: Scene) -> list[Adjacent]:
    """Edges between parts of one cluster; each edge's point is midway between the two closest points."""
    part_ids = ids_of_parts(parts)
    middles = points(contacts.points.mean(axis=1) + scene.origin)
    return [
        Adjacent(source=part_ids[a], target=part_ids[b], distance=rounded(distance), point=middle)
        for (a, b), distance, middle in zip(contacts.pairs.tolist(), contacts.distance, middles, strict=True)
        if cluster[a] == cluster[b] >= 0
    ]


def findings(results: Results) -> list[Diagnostic]:
    """What all stages had to say, and how many parts have no cluster, no label or none that is sure."""
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


def _rounded(label: Label) -> Label:
    """A label as the graph holds it: without what else the part may be, which stands beside it."""
    return label.model_copy(update={"confidence": round(label.confidence, 6), "guesses": ()})


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
