"""Where facts stand: at a mesh, at a node above the meshes of one part, or above those of several."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from cadgraph.model.facts import Fact

__all__ = ["NodeFacts", "Places"]

_MOST_STEPS = 64  # of a path, from its end; no tree of a real file is as deep
_NAMING_STEPS = 2  # steps above a mesh whose names may name it
_NEARLY_ALL = 0.9  # share of a node's meshes, from which on it stands for the unit that they belong to


@dataclass(frozen=True)
class NodeFacts:
    """What is said of a node above several parts that stands for a unit.

    Args:
        path: of the node.
        facts: of it.
        covers: share of the unit's meshes that are below it.
        n_meshes: that are below it.
    """

    path: str
    facts: tuple[Fact, ...]
    covers: float
    n_meshes: int


class Places:
    """The facts of a scene by where they stand.

    Args:
        paths: source path of each mesh.
        part_of_mesh: part of each mesh.
        heads: the largest mesh of each part, which its name and its facts are taken from.
        facts: of the scene.
    """

    def __init__(
        self, paths: Sequence[str], part_of_mesh: Sequence[int], heads: Sequence[int], facts: Sequence[Fact]
    ) -> None:
        self._paths, self._part_of_mesh, self._heads = paths, part_of_mesh, heads
        self._mesh_at = {path: mesh for mesh, path in enumerate(paths)}
        self._facts_at: dict[str, list[Fact]] = {}
        for fact in facts:
            self._facts_at.setdefault(fact.path, []).append(fact)

    @cached_property
    def _owner(self) -> Mapping[str, int]:
        """The part that all meshes below a node belong to; -1 where there are several."""
        owner: dict[str, int] = {}
        for path, part in zip(self._paths, self._part_of_mesh, strict=True):
            for node in _upwards(path):
                if owner.setdefault(node, part) != part:
                    owner[node] = -1
        return owner

    def of_part(self, part: int) -> list[Fact]:
        """All facts of a part's meshes, and of nodes above that hold nothing else, in the order of the scene."""
        return self._of_parts.get(part, [])

    @cached_property
    def _of_parts(self) -> Mapping[int, list[Fact]]:
        found: dict[int, list[Fact]] = {}
        for path, facts in self._facts_at.items():
            part = self._part_at(path)
            if part >= 0:
                found.setdefault(part, []).extend(facts)
        return found

    def _part_at(self, path: str) -> int:
        mesh = self._mesh_at.get(path)
        return self._owner.get(path, -1) if mesh is None else self._part_of_mesh[mesh]

    def nodes_of_part(self, part: int) -> Iterator[tuple[str, list[Fact], str | None]]:
        """The nodes that speak for a part: its largest mesh, then the nodes above that hold nothing else.

        Args:
            part: which.

        Yields:
            Path, facts, and the name that the path's last step gives, None for nodes too far above.
        """
        for steps, path in enumerate(_upwards(self._paths[self._heads[part]])):
            if steps and self._owner.get(path) != part:
                return
            name = path.rsplit("/", 1)[-1] if steps <= _NAMING_STEPS else None
            yield path, self._facts_at.get(path, []), name

    def of_units(self, units: Sequence[Sequence[int]]) -> tuple[tuple[NodeFacts, ...], ...]:
        """What is said of the nodes above several parts that stand for units.

        A node stands for a unit if nine tenths of the meshes below it belong to that. Where no such node holds most of
        a unit, the lowest one does that holds most of it, and little else.

        Args:
            units: parts of each unit.

        Returns:
            Of each unit its nodes, those with the fewest meshes first.
        """
        unit_of = {part: number for number, parts in enumerate(units) for part in parts}
        size = Counter(unit_of[part] for part in self._part_of_mesh if part in unit_of)
        found: list[list[NodeFacts]] = [[] for _ in units]
        mixed: list[list[NodeFacts]] = [[] for _ in units]
        for path, parts in self._above_several.items():
            number, n = max(Counter(unit_of.get(part, -1) for part in parts).items(), key=lambda one: (one[1], -one[0]))
            if number < 0 or 2 * n <= len(parts):
                continue
            node = NodeFacts(path, tuple(self._facts_at[path]), n / size[number], len(parts))
            (found if n >= _NEARLY_ALL * len(parts) else mixed)[number].append(node)
        for number, nodes in enumerate(mixed):
            whole = [node for node in nodes if node.covers > 0.5]
            if whole and not any(node.covers > 0.5 for node in found[number]):
                found[number].append(min(whole, key=_size))
        return tuple(tuple(sorted(nodes, key=_size)) for nodes in found)

    @cached_property
    def _above_several(self) -> Mapping[str, list[int]]:
        """The part of each mesh below the nodes with facts that hold several parts."""
        below: dict[str, list[int]] = {
            path: [] for path in self._facts_at if path not in self._mesh_at and self._owner.get(path) == -1
        }
        if below:
            for path, part in zip(self._paths, self._part_of_mesh, strict=True):
                for node in _upwards(path):
                    if node in below:
                        below[node].append(part)
        return below

    def left_over(self, units: Sequence[Sequence[NodeFacts]]) -> list[Fact]:
        """The facts that belong to no part and to none of these units, in the order of the scene.

        Args:
            units: what ``of_units`` returned.
        """
        told = {node.path for nodes in units for node in nodes}
        return [
            fact
            for path, facts in self._facts_at.items()
            if path not in told and self._part_at(path) < 0
            for fact in facts
        ]


def _size(node: NodeFacts) -> tuple[int, int, str]:
    # Of nodes that hold the same the lower one comes first.
    return node.n_meshes, -len(node.path), node.path


def _upwards(path: str) -> Iterator[str]:
    """A path and the nodes above it."""
    for _ in range(_MOST_STEPS):
        yield path
        path = path.rpartition("/")[0]
        if not path:
            return
