"""Why a part has its label: all that the graph holds about it, in one place."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import Evidence, GivenEvidence
from cadgraph.model.records import Adjacent, Junction, Part, SourceFact, Terminal, Unit
from cadgraph.model.vocabulary import spell_label
from cadgraph.query.explain_connection import ConnectionExplanation, explain_connection
from cadgraph.query.explain_unit import UnitExplanation, explain_unit
from cadgraph.query.network import Network
from cadgraph.query.told_facts import fact_rows, fact_values
from cadgraph.query.told_joint import ToldJoint, say_joint, tell_joint

__all__ = ["Explanation", "Neighbor", "explain", "explain_any"]

_MOST_TOLD = 12  # of neighbours and repeats, in words


@dataclass(frozen=True)
class Neighbor:
    """A part that touches the explained one.

    Args:
        part: id.
        mesh: source path of its largest mesh.
        label: ``group/name``, or None.
        distance: between the surfaces [m].
    """

    part: str
    mesh: str
    label: str | None
    distance: float


@dataclass(frozen=True)
class Explanation:
    """Why a part has its label, or none.

    Args:
        part: id.
        meshes: its source paths, the largest first.
        size: extents of its oriented box, descending [m].
        label: ``group/name``, or None where nobody is sure enough.
        confidence: of the label, or None.
        source: who says so, or None.
        why: in words.
        evidence: as the graph holds it.
        guesses: what it might be, ``group/name`` and probability, the likeliest first.
        likely: whether the label is likely, but not sure.
        neighbors: that touch it, the nearest first.
        repeats: other parts of its shape: how many have each label ("" for none).
        unit: tag of its functional unit, or None.
        cluster: id of its structure, or None.
        inside: id of the part that encloses it on all sides, or None.
        joints: where lines join at it, made or not, the surest first.
        facts: what the source file says of it.
    """

    part: str
    meshes: tuple[str, ...]
    size: tuple[float, float, float]
    label: str | None
    confidence: float | None
    source: str | None
    why: str
    evidence: Evidence = field(default_factory=Evidence)
    guesses: tuple[tuple[str, float], ...] = ()
    likely: bool = False
    neighbors: tuple[Neighbor, ...] = ()
    repeats: Mapping[str, int] = field(default_factory=dict)
    unit: str | None = None
    cluster: str | None = None
    inside: str | None = None
    joints: tuple[ToldJoint, ...] = ()
    facts: tuple[SourceFact, ...] = ()

    def to_json(self) -> dict[str, Any]:
        """As plain values."""
        return {**asdict(self), "evidence": self.evidence.to_json(), "facts": fact_values(self.facts)}

    def lines(self) -> list[tuple[str, str]]:
        """The explanation as pairs of a heading and a text."""
        sure = "likely " if self.likely else ""
        rows = [
            ("part", f"{self.part}, {' x '.join(_length(x) for x in self.size)}"),
            ("mesh", self.meshes[0] + (f" and {len(self.meshes) - 1} more" if len(self.meshes) > 1 else "")),
            ("label", f"{sure}{self.label} ({self.confidence:.0%}, {self.source})" if self.label else "none"),
            ("why", self.why),
        ]
        before = self.evidence.before
        if before is not None:
            said = [_percent(before.confidence), *([before.source] if before.source else [])]
            rows.append(("before", f"{spell_label(before.group, before.name)} ({', '.join(said)})"))
        if self.guesses:
            rows.append(("guesses", ", ".join(f"{name} {p:.0%}" for name, p in self.guesses)))
        rows.append(("touches", _some([f"{n.label or 'unlabelled'} ({n.part})" for n in self.neighbors]) or "nothing"))
        if self.inside:
            rows.append(("lies", f"inside {self.inside}"))
        alike = ", ".join(f"{count} {label or 'unlabelled'}" for label, count in self.repeats.items())
        rows.append(("same shape", alike or "no other part"))
        rows.append(("unit", self.unit or "none"))
        rows.append(("structure", self.cluster or "none"))
        rows += [("joined" if joint.made else "not joined", say_joint(joint)) for joint in self.joints[:_MOST_TOLD]]
        return rows + fact_rows(self.facts)


def explain(graph: SceneGraph, which: str) -> Explanation:
    """Gathers why a part has its label.

    Args:
        graph: finished.
        which: id of the part, or source path of one of its meshes.

    Raises:
        UnknownNode: the graph has no such part.
    """
    part = graph.part(which)
    far = {
        edge.target if edge.source == part.id else edge.source: edge.distance
        for edge in graph.of_kind(Adjacent)
        if part.id in (edge.source, edge.target)
    }
    near = sorted(graph.neighbors(part), key=lambda other: (far[other.id], other.id))
    repeats = Counter(_name(p) or "" for p in graph.parts() if p.shape == part.shape and p.id != part.id)
    unit, cluster, label = graph.unit_of(part), graph.cluster_of(part), part.label
    return Explanation(
        part=part.id,
        meshes=part.meshes,
        size=part.obb.extents,
        label=_name(part),
        confidence=None if label is None else label.confidence,
        likely=label is not None and label.likely,
        source=None if label is None else label.source,
        why=_why(part),
        evidence=Evidence() if label is None else label.evidence,
        guesses=tuple((spell_label(g.group, g.name), g.confidence) for g in part.guesses),
        neighbors=tuple(Neighbor(o.id, o.meshes[0], _name(o), far[o.id]) for o in near),
        repeats=dict(sorted(repeats.items(), key=lambda row: (-row[1], row[0]))),
        unit=None if unit is None else unit.tag,
        cluster=None if cluster is None else cluster.id,
        inside=part.inside,
        joints=_joints(graph, part),
        facts=part.facts,
    )


def _joints(graph: SceneGraph, part: Part) -> tuple[ToldJoint, ...]:
    found = sorted(graph.joints(part), key=lambda joint: (not joint.made, -joint.score, joint.first, joint.second))
    network = Network(graph)
    return tuple(tell_joint(network, joint, (part.id,)) for joint in found)


def explain_any(
    graph: SceneGraph, which: str, other: str | None = None
) -> Explanation | UnitExplanation | ConnectionExplanation:
    """Explains whatever is called so: a part's label, a unit's lines, or what connects two units.

    Args:
        graph: finished.
        which: id of a part, source path of a mesh, tag of a unit, id of a junction or of an end.
        other: of what else, where the connection of the two is asked for; a part then stands for its unit.

    Raises:
        UnknownNode: the graph has nothing of that name.
        ValueError: both are the same.
    """
    if other is not None:
        return explain_connection(graph, which, other)
    node = graph.find(which, Part, Unit, Junction, Terminal)
    return explain(graph, node.id) if isinstance(node, Part) else explain_unit(graph, node.id)


def _why(part: Part) -> str:
    if part.label is None:
        if part.ground:
            return "it is the ground, which gets no label"
        return "nobody is sure enough" if part.guesses else "nobody has an idea"
    evidence = part.label.evidence
    if evidence.why is not None:
        return evidence.why
    if isinstance(evidence, GivenEvidence) and evidence.mesh is not None:
        return f"given from outside for {evidence.mesh}"
    return "the graph does not say"


def _name(part: Part) -> str | None:
    return None if part.label is None else spell_label(part.label.group, part.label.name)


def _percent(confidence: float | None) -> str:
    return "no confidence" if confidence is None else f"{confidence:.0%}"


def _length(x: float) -> str:
    return f"{x:.2f} m" if x >= 2 else f"{1000 * x:.0f} mm" if x >= 0.01 else f"{1000 * x:.1f} mm"


def _some(names: Sequence[str]) -> str:
    more = len(names) - _MOST_TOLD
    return ", ".join(names[:_MOST_TOLD]) + (f" and {more} more" if more > 0 else "")
