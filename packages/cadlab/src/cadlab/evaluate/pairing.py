"""Laying a graph and a truth over each other, mesh by mesh: what all measures start from."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

from cadgraph._io.text import natural_key
from cadgraph.errors import FormatError
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Part
from cadgraph.model.truth import Truth, TruthMesh
from cadgraph.model.vocabulary import Vocabulary, default_vocabulary

__all__ = ["GROUND", "Pairing", "Structure", "pair"]

LEAST_SHARE = 0.5
"""Below this share of common meshes a truth belongs to another scene (ours: by chance paths of two exports of one
plant agree in none or in nearly all)."""

GROUND = "ground"
"""The name in the vocabulary that a part marked as ground carries where it has no label."""


@dataclass(frozen=True)
class Structure:
    """One true cluster.

    Args:
        id: as the truth calls it, else ``structure-1``...
        kind: ``"pipe system"`` where it holds a mesh of a connector group, else its commonest group.
        meshes: all its paths.
    """

    id: str
    kind: str | None
    meshes: frozenset[str]


@dataclass(frozen=True)
class Pairing:
    """A graph and a truth of the same scene.

    Args:
        graph: what was found.
        truth: what is known.
        vocabulary: of the graph.
        structures: the true clusters, in their order; none where clusters are not annotated.
    """

    graph: SceneGraph
    truth: Truth
    vocabulary: Vocabulary
    structures: tuple[Structure, ...]

    @cached_property
    def rows(self) -> dict[str, TruthMesh]:
        """The true row of each mesh."""
        return {row.mesh: row for row in self.truth.meshes}

    @cached_property
    def parts(self) -> list[Part]:
        """The parts that hold a mesh of the truth, by their paths, so that ids and file order don't matter."""
        held = [part for part in self.graph.parts() if any(mesh in self.rows for mesh in part.meshes)]
        return sorted(held, key=lambda part: natural_key(min(part.meshes, key=natural_key)))

    @cached_property
    def part_of_mesh(self) -> dict[str, str]:
        """The part that holds a mesh."""
        return {mesh: part.id for part in self.parts for mesh in part.meshes}

    @cached_property
    def head(self) -> dict[str, str]:
        """For each part the mesh whose truth is the part's: its largest labelled one, else its largest listed one."""
        result = {}
        for part in self.parts:
            listed = [mesh for mesh in part.meshes if mesh in self.rows]
            result[part.id] = next((mesh for mesh in listed if self.rows[mesh].group is not None), listed[0])
        return result

    @cached_property
    def structure_of_mesh(self) -> dict[str, str]:
        """The true structure of a mesh."""
        return {mesh: structure.id for structure in self.structures for mesh in structure.meshes}

    def structure_of_part(self, part: str) -> str | None:
        """The true structure of a part: that of its head."""
        return self.structure_of_mesh.get(self.head.get(part, ""))

    def structure_of_meshes(self, meshes: Iterable[str]) -> str | None:
        """The structure that most of these meshes are in; the first in the truth's order where two tie."""
        counts = Counter(here for mesh in meshes if (here := self.structure_of_mesh.get(mesh)) is not None)
        order = {structure.id: i for i, structure in enumerate(self.structures)}
        return min(counts, key=lambda name: (-counts[name], order[name]), default=None)

    @cached_property
    def unit_of_mesh(self) -> dict[str, str]:
        """The true unit of a mesh."""
        return {mesh: unit.id for unit in self.truth.units or () for mesh in unit.meshes}

    @cached_property
    def true_parts(self) -> dict[str, frozenset[str]]:
        """The parts of each true unit: those whose head is in it; where there are none, all that hold a mesh of it."""
        heads: dict[str, set[str]] = {unit.id: set() for unit in self.truth.units or ()}
        for part, mesh in self.head.items():
            if mesh in self.unit_of_mesh:
                heads[self.unit_of_mesh[mesh]].add(part)
        for unit in self.truth.units or ():
            if not heads[unit.id]:
                heads[unit.id] = {self.part_of_mesh[mesh] for mesh in unit.meshes if mesh in self.part_of_mesh}
        return {unit: frozenset(parts) for unit, parts in heads.items()}

    def label(self, part: str) -> tuple[str, str | None] | None:
        """The predicted group and name; the ground's own where a part is marked as ground and has no label."""
        node = self.graph.part(part)
        if node.label is not None:
            return node.label.group, node.label.name
        if node.ground:
            return next(((group, GROUND) for group, g in self.vocabulary.groups.items() if GROUND in g.names), None)
        return None

    @cached_property
    def lost(self) -> tuple[str, ...]:
        """True meshes that no part holds, apart from duplicates and hidden ones, which it is right to drop."""
        # Of two copies either may have gone, but not both.
        idle = set(self.truth.hidden)
        for pair in self.truth.duplicates:
            if any(mesh in self.part_of_mesh for mesh in pair):
                idle.update(pair)
        return tuple(
            row.mesh for row in self.truth.meshes if row.mesh not in self.part_of_mesh and row.mesh not in idle
        )


def pair(graph: SceneGraph, truth: Truth) -> Pairing:
    """Lays a graph and a truth over each other.

    Raises:
        FormatError: they are of different scenes: fewer than half of the truth's meshes are in the graph. A graph or
            truth without any mesh fits everything; a truth may cover a small piece of its scene.
        LabelError: the vocabulary in the graph is malformed.
    """
    seen = {mesh for part in graph.parts() for mesh in part.meshes}
    named = seen | {mesh for finding in graph.diagnostics for mesh in finding.meshes}
    listed = {row.mesh for row in truth.meshes}
    if seen and listed:
        common = len(listed & named)
        if common < LEAST_SHARE * len(listed):
            example = min(listed - named, key=natural_key)
            raise FormatError(
                f"the truth is of another scene: {common} of its {len(listed)} meshes are in the graph of "
                f"{graph.source.path or 'an unnamed scene'!s} ({len(seen)} meshes), {example!r} for one is not; "
                "give the truth that belongs to the graph's scene; where a format names a generated plant's meshes "
                "otherwise, 'cadgraph environment match SCENE' makes it"
            )
    vocabulary = Vocabulary.from_json(graph.vocabulary) if graph.vocabulary else default_vocabulary()
    return Pairing(graph, truth, vocabulary, _structures(truth, vocabulary))


def _structures(truth: Truth, vocabulary: Vocabulary) -> tuple[Structure, ...]:
    group_of = {row.mesh: row.group for row in truth.meshes}
    taken = {cluster.id for cluster in truth.clusters or ()}
    found = []
    for number, cluster in enumerate(truth.clusters or (), 1):
        groups = Counter(group for mesh in cluster.meshes if (group := group_of[mesh]) is not None)
        commonest = min(groups, key=lambda group: (-groups[group], group), default=None)
        kind = "pipe system" if vocabulary.connector_groups & set(groups) else commonest
        name = cluster.id or f"structure-{number}"
        while cluster.id is None and name in taken:
            name += "'"
        found.append(Structure(name, kind, frozenset(cluster.meshes)))
    return tuple(found)
