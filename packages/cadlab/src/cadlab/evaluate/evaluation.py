"""Everything that is measured, for each structure and in all."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace
from typing import Protocol, TypeVar

from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Connected, Related
from cadgraph.model.truth import Truth
from cadlab.evaluate.clusters import (
    ClusterScores,
    ContactScores,
    ContactVerdict,
    compare_clusters,
    compare_contacts,
    score_clusters,
    score_contacts,
)
from cadlab.evaluate.grouping import JoinVerdict, compare_joins, score_joins
from cadlab.evaluate.labels import (
    Calibration,
    LabelScores,
    Observation,
    calibrate,
    observe_meshes,
    observe_parts,
    score_labels,
)
from cadlab.evaluate.pairing import Pairing, pair
from cadlab.evaluate.relations import (
    EdgeVerdict,
    EndVerdict,
    RelationScores,
    compare_edges,
    compare_ends,
    score_relations,
)
from cadlab.evaluate.scores import Score
from cadlab.evaluate.taps import TapScores, TapVerdict, compare_taps, score_taps
from cadlab.evaluate.units import UnitMatch, UnitScores, match_units, score_units

__all__ = ["Evaluation", "StructureScores", "evaluate"]


@dataclass(frozen=True)
class StructureScores:
    """The scores of one true cluster, or of all; a section is None where the truth doesn't annotate it.

    Args:
        id: of the cluster; ``"all"`` for everything.
        kind: ``"pipe system"`` where it holds a connector part, else its commonest group; None for all.
        meshes: labels of meshes, each with the label of its part.
        parts: labels of parts; a part's truth is that of its largest labelled mesh.
        units: functional units.
        connected: what follows what along the runs, junctions contracted.
        related: Algorithm 1's relations, against the same truth.
        connected_taps: order of neighbours that tap into one mesh, by ``connected``; None without true contacts.
        related_taps: the same by ``related``.
        joins: small meshes that join a larger one.
        clusters: connected structures.
        contacts: what touches what.
        group_calibration: of the confidence of parts' groups.
        name_calibration: of the confidence of parts' names.
    """

    id: str
    kind: str | None
    meshes: LabelScores
    parts: LabelScores
    units: UnitScores | None
    connected: RelationScores | None
    related: RelationScores | None
    connected_taps: TapScores | None
    related_taps: TapScores | None
    joins: Score | None
    clusters: ClusterScores | None
    contacts: ContactScores | None
    group_calibration: Calibration
    name_calibration: Calibration


@dataclass(frozen=True)
class Evaluation:
    """How well a graph agrees with a truth.

    Args:
        scene: path of the scene, as the graph has it.
        method: that the graph was built with, or None.
        preset: of the generated plant, or empty.
        seed: of the generated plant, or None.
        n_meshes: meshes in the truth.
        n_parts: parts of the graph that hold one of them.
        n_unknown: parts of the graph that hold none; they are not evaluated.
        n_lost: meshes of the truth that no part holds, duplicates and hidden ones apart; they count as unlabelled.
        total: the scores of everything, also of what is in no cluster.
        structures: the scores of each true cluster, in the order of the truth.
    """

    scene: str
    method: str | None
    preset: str
    seed: int | None
    n_meshes: int
    n_parts: int
    n_unknown: int
    n_lost: int
    total: StructureScores
    structures: tuple[StructureScores, ...]


@dataclass(frozen=True)
class _Facts:
    """Everything seen, before it is counted."""

    meshes: tuple[Observation, ...]
    parts: tuple[Observation, ...]
    units: UnitMatch | None
    connected: tuple[EdgeVerdict, ...] | None
    related: tuple[EdgeVerdict, ...] | None
    taps: dict[str, tuple[TapVerdict, ...]] | None
    present: frozenset[str]
    joins: tuple[JoinVerdict, ...] | None
    ends: tuple[EndVerdict, ...]
    clusters: tuple[tuple[str, str], ...] | None
    contacts: tuple[ContactVerdict, ...] | None


def evaluate(graph: SceneGraph, truth: Truth) -> Evaluation:
    """Compares a graph with what is known for certain about its scene.

    Args:
        graph: the finished graph.
        truth: of the same scene.

    Returns:
        All measures, for each true cluster and in all; the same whatever the ids and the order in both.

    Raises:
        FormatError: the truth is of another scene.
        LabelError: the vocabulary in the graph is malformed.
    """
    pairing = pair(graph, truth)
    facts = _observe(pairing)
    method = graph.config.get("method")
    return Evaluation(
        scene=graph.source.path,
        method=method if isinstance(method, str) else None,
        preset=truth.preset,
        seed=truth.seed,
        n_meshes=len(truth.meshes),
        n_parts=len(pairing.parts),
        n_unknown=len(graph.parts()) - len(pairing.parts),
        n_lost=len(pairing.lost),
        total=_count(facts, None, None),
        structures=tuple(_count(facts, structure.id, structure.kind) for structure in pairing.structures),
    )


def _observe(pairing: Pairing) -> _Facts:
    truth = pairing.truth
    units = match_units(pairing) if truth.units is not None else None
    runs = units if truth.connections is not None else None
    touched = runs if truth.contacts is not None else None
    kinds = ("connected", "related")
    graph = pairing.graph
    return _Facts(
        meshes=observe_meshes(pairing),
        parts=observe_parts(pairing),
        units=units,
        connected=compare_edges(pairing, runs, "connected") if runs is not None else None,
        related=compare_edges(pairing, runs, "related") if runs is not None else None,
        taps={kind: compare_taps(pairing, touched, kind) for kind in kinds} if touched is not None else None,
        present=frozenset(
            kind
            for kind, held in (
                ("connected", graph.of_kind(Connected)),
                ("related", graph.of_kind(Related)),
                ("units", graph.units()),
            )
            if held
        ),
        joins=compare_joins(pairing) if truth.parts is not None else None,
        ends=compare_ends(pairing, runs) if runs is not None else (),
        clusters=compare_clusters(pairing) if truth.clusters is not None else None,
        contacts=compare_contacts(pairing) if truth.contacts is not None else None,
    )


def _count(facts: _Facts, only: str | None, kind: str | None) -> StructureScores:
    """The scores of one structure, or of everything if None."""
    seen = _within(facts, only) if only is not None else facts
    return StructureScores(
        id=only if only is not None else "all",
        kind=kind,
        meshes=score_labels("mesh", seen.meshes),
        parts=score_labels("part", seen.parts),
        units=_units(seen),
        connected=_relations("connected", seen, seen.connected),
        related=_relations("related", seen, seen.related),
        connected_taps=score_taps(seen.taps["connected"]) if seen.taps is not None else None,
        related_taps=score_taps(seen.taps["related"]) if seen.taps is not None else None,
        joins=score_joins(seen.joins) if seen.joins is not None else None,
        clusters=score_clusters(seen.clusters, only) if seen.clusters is not None else None,
        contacts=score_contacts(seen.contacts) if seen.contacts is not None else None,
        group_calibration=calibrate("group", seen.parts),
        name_calibration=calibrate("name", seen.parts),
    )


class _Placed(Protocol):
    @property
    def structure(self) -> str | None: ...


class _Spanning(Protocol):
    @property
    def structures(self) -> Collection[str]: ...


_In = TypeVar("_In", bound=_Placed)
_Over = TypeVar("_Over", bound=_Spanning)


def _inside(seen: Iterable[_In], structure: str) -> tuple[_In, ...]:
    return tuple(one for one in seen if one.structure == structure)


def _touching(seen: Iterable[_Over], structure: str) -> tuple[_Over, ...]:
    return tuple(one for one in seen if structure in one.structures)


def _within(facts: _Facts, structure: str) -> _Facts:
    """What was seen of one structure; clusters are compared with all others, so all of them stay."""
    units = facts.units
    return replace(
        facts,
        meshes=_inside(facts.meshes, structure),
        parts=_inside(facts.parts, structure),
        units=units
        and replace(units, true=_inside(units.true, structure), predicted=_inside(units.predicted, structure)),
        connected=facts.connected and _touching(facts.connected, structure),
        related=facts.related and _touching(facts.related, structure),
        taps=facts.taps and {kind: _touching(some, structure) for kind, some in facts.taps.items()},
        joins=facts.joins and _inside(facts.joins, structure),
        ends=_inside(facts.ends, structure),
        contacts=facts.contacts and _touching(facts.contacts, structure),
    )


def _units(facts: _Facts) -> UnitScores | None:
    if facts.units is None:
        return None
    return score_units(facts.units.true, facts.units.predicted, present="units" in facts.present)


def _relations(kind: str, facts: _Facts, edges: tuple[EdgeVerdict, ...] | None) -> RelationScores | None:
    return score_relations(kind, edges, facts.ends, present=kind in facts.present) if edges is not None else None
