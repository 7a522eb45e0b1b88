"""Which small meshes joined which larger one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from cadlab.evaluate.pairing import Pairing
from cadlab.evaluate.scores import Score

__all__ = ["JoinVerdict", "compare_joins", "score_joins"]


@dataclass(frozen=True)
class JoinVerdict:
    """One mesh that is not the head of its part, in the truth, in the graph or in both.

    Args:
        mesh: its path.
        true_head: the largest mesh of its true part, or None where it is that itself.
        head: of its part in the graph likewise; None where no part holds it.
        structure: the true cluster.
    """

    mesh: str
    true_head: str | None
    head: str | None
    structure: str | None


def compare_joins(pairing: Pairing) -> tuple[JoinVerdict, ...]:
    """The meshes that join another one on either side."""
    true = {mesh: part[0] for part in pairing.truth.parts or () for mesh in part[1:]}
    found: dict[str, str] = {}
    for part in pairing.parts:
        listed = [mesh for mesh in part.meshes if mesh in pairing.rows]
        # Within one true part it does not matter which of its meshes the graph calls the largest.
        head = true.get(listed[0], listed[0])
        head = head if head in listed else listed[0]
        found |= {mesh: head for mesh in listed if mesh != head}
    return tuple(
        JoinVerdict(mesh, true.get(mesh), found.get(mesh), pairing.structure_of_mesh.get(mesh))
        for mesh in sorted({*true, *found})
        if mesh in pairing.part_of_mesh
    )


def score_joins(verdicts: Sequence[JoinVerdict]) -> Score:
    """Counts meshes that join another: in the truth, in the graph, and the same one in both."""
    return Score(
        sum(v.true_head is not None for v in verdicts),
        sum(v.head is not None for v in verdicts),
        sum(v.true_head is not None and v.true_head == v.head for v in verdicts),
    )
