"""What the review queue looks at: a graph with the doubt in its labels and what hangs on each part."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from cadgraph.labelers.suspicion import Suspicion, suspect_labels
from cadgraph.model.edits import Cut, Join
from cadgraph.model.graph import SceneGraph
from cadgraph.model.probabilities import Probabilities
from cadgraph.model.records import Connected, Part, Unit
from cadgraph.model.scene import Floats
from cadgraph.model.vocabulary import Vocabulary
from cadgraph.pipeline import CONTRADICTIONS
from cadgraph.query.network import Network
from cadgraph.session.session import Session

__all__ = ["ReviewState"]

# What hangs on a part: of a valve, which isolates; of any other unit, or in a line; or whether there is a unit or line.
_VALVE, _FUNCTIONAL, _DECIDES = 1.5, 1.25, 1.5
_OPEN_KIND = 2.0  # of a part that may be what turns a valve whose kind is open
# What turns a valve tells its kind.
_OPERATORS = ("handwheel", "lever", "actuator", "gearbox")
_LEAST_OPERATOR = 0.05  # probability of them all from which on a part may be one
_CODES = CONTRADICTIONS | {"file-disagrees"}


@dataclass(frozen=True, eq=False)
class ReviewState:
    """A graph as the queue sees it.

    Args:
        graph: as it is now.
        nodes: its parts, by number.
        number: of the part that holds a mesh, by source path.
        suspicion: of the labels.
        contradicted: parts at which something does not add up.
        stakes: ``(n_parts,)`` how much hangs on each part, 1 where nothing does.
        unit_of: the unit that a part belongs to.
        deciding_kind: parts that may be what turns a valve whose kind is open.
        vocabulary: the tree that the labels are from.
        settled_pairs: source paths of two meshes of which a user has said whether they join.
    """

    graph: SceneGraph
    nodes: tuple[Part, ...]
    number: Mapping[str, int]
    suspicion: Suspicion
    contradicted: frozenset[int]
    stakes: Floats
    unit_of: Mapping[int, Unit]
    deciding_kind: frozenset[int]
    vocabulary: Vocabulary
    settled_pairs: tuple[tuple[str, str], ...] = ()

    @classmethod
    def of(cls, session: Session) -> ReviewState:
        """The state of a session as it is now."""
        graph, analysis = session.graph, session.analysis
        nodes = tuple(graph.parts())
        number = {mesh: k for k, node in enumerate(nodes) for mesh in node.meshes}
        told = (mesh for one in graph.diagnostics if one.code in _CODES for mesh in one.meshes)
        contradicted = frozenset(number[mesh] for mesh in told if mesh in number)
        labels = [node.label for node in nodes]
        suspicion = suspect_labels(
            labels, analysis.parts, analysis.contacts, session.vocabulary, _opinions(session), contradicted
        )
        rank = {node.id: k for k, node in enumerate(nodes)}
        unit_of = {rank[part]: unit for unit in graph.units() for part in unit.parts}
        deciding = _deciding_kind(unit_of, suspicion)
        stakes = _decisive(nodes, suspicion, session.vocabulary)
        in_line = {rank[part] for edge in graph.of_kind(Connected) for part in edge.via if part in rank}
        _raise(stakes, in_line | unit_of.keys(), _FUNCTIONAL)
        _raise(stakes, {part for part, unit in unit_of.items() if unit.unit_type == "valve"}, _VALVE)
        _raise(stakes, deciding, _OPEN_KIND)
        pairs = tuple((e.first.mesh, e.second.mesh) for e in session.corrections if isinstance(e, Join | Cut))
        return cls(graph, nodes, number, suspicion, contradicted, stakes, unit_of, deciding, session.vocabulary, pairs)

    @cached_property
    def network(self) -> Network:
        """The functional network."""
        return Network(self.graph)

    @cached_property
    def rank(self) -> Mapping[str, int]:
        """The number of each part by its id."""
        return {node.id: k for k, node in enumerate(self.nodes)}

    def unit_at(self, mesh: str) -> Unit | None:
        """The unit that the part of a mesh belongs to."""
        return self.unit_of.get(self.number.get(mesh, -1))

    @cached_property
    def _by_shape(self) -> Mapping[str, Counter[tuple[str, str | None] | None]]:
        counts: dict[str, Counter[tuple[str, str | None] | None]] = {}
        for node in self.nodes:
            counts.setdefault(node.shape, Counter())[node.label.said if node.label is not None else None] += 1
        return counts

    def repeats_of(self, part: int) -> list[tuple[tuple[str, str | None] | None, int]]:
        """How many parts of the shape of one have each label, the commonest first."""
        counts = self._by_shape[self.nodes[part].shape]
        return sorted(counts.items(), key=lambda item: (-item[1], item[0] is None, str(item[0])))


def _opinions(session: Session) -> Probabilities | None:
    """The embedded network's probabilities where the session has them; what others answered is no second opinion."""
    said = session.labeling
    own = all(answer is None or answer.source == "geometry" for answer in said.answers)
    return said.probabilities if own else None


def _raise(stakes: Floats, parts: Collection[int], least: float) -> None:
    """Lets at least so much hang on some parts."""
    rows = sorted(parts)
    stakes[rows] = np.maximum(stakes[rows], least)


def _decisive(nodes: tuple[Part, ...], suspicion: Suspicion, vocabulary: Vocabulary) -> Floats:
    """``(n_parts,)`` how much hangs on whether each part is what it is taken for, or what it likelier is."""
    functional = vocabulary.connector_groups | vocabulary.unit_of_group.keys()
    stakes = np.ones(len(nodes))
    if not suspicion.classes:
        return stakes
    best = suspicion.values.argmax(axis=1).tolist()
    for part, node in enumerate(nodes):
        likeliest = suspicion.classes[best[part]][0]
        now = node.label.group if node.label is not None else None
        if likeliest != now and (likeliest in functional or now in functional):
            stakes[part] = _DECIDES
    return stakes


def _deciding_kind(unit_of: Mapping[int, Unit], suspicion: Suspicion) -> frozenset[int]:
    """Parts of valves of open kind that may be what turns them, or may not."""
    columns = [k for k, (_, name) in enumerate(suspicion.classes) if name in _OPERATORS]
    return frozenset(
        part
        for part, unit in unit_of.items()
        if unit.unit_type == "valve"
        and unit.kind is None
        and unit.kind_guesses
        and len(unit.parts) > 1
        and suspicion.values[part, columns].sum() >= _LEAST_OPERATOR
        and suspicion.wrong[part] >= _LEAST_OPERATOR
    )
