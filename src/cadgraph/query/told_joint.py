"""A joint as it is told: which parts, of what, how far apart, how sure, and why."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from cadgraph.model.records import Joint, Part
from cadgraph.query.network import Network

__all__ = ["ToldJoint", "name_part", "say_joint", "tell_joint"]

_MANNERS = {
    "face": "end to end",
    "corner": "end to end at an angle",
    "tap": "an end on the side of a line",
    "mount": "an end at a body",
    "side": "a body on the side of a line",
    "flange": "body to body",
}


@dataclass(frozen=True)
class ToldJoint:
    """A joint seen from one of its parts.

    Args:
        near: id of the part that it is seen from.
        near_what: label of that, or None.
        near_of: tag of the unit, else id of the junction or end that it belongs to, or None.
        far: id of the other part.
        far_what: label of that, or None.
        far_of: what that belongs to, or None.
        meshes: source path of the largest mesh of each of the two.
        kind: ``face``, ``corner``, ``tap``, ``mount``, ``side`` or ``flange``.
        point: where it is [m].
        gap: between the two [m]; negative where one lies in the other.
        score: how sure it is that they join, 0..1.
        made: whether the network joins them.
        reasons: what speaks for and against it.
    """

    near: str
    near_what: str | None
    near_of: str | None
    far: str
    far_what: str | None
    far_of: str | None
    meshes: tuple[str, str]
    kind: str
    point: tuple[float, float, float]
    gap: float
    score: float
    made: bool
    reasons: tuple[str, ...]


def tell_joint(network: Network, joint: Joint, near: Collection[str]) -> ToldJoint:
    """A joint as seen from one side.

    Args:
        network: of the graph that it is from.
        joint: to be told.
        near: ids of parts; the joint is seen from the one that is among them.
    """
    first = joint.first in near or joint.second not in near
    ends = (joint.first, joint.second) if first else (joint.second, joint.first)
    parts = [network.graph.part(end) for end in ends]
    owners = [network.owner_of_part(end) for end in ends]
    of = [None if owner is None else network.name(owner) for owner in owners]
    what = [name_part(part) for part in parts]
    return ToldJoint(
        near=ends[0],
        near_what=what[0],
        near_of=of[0],
        far=ends[1],
        far_what=what[1],
        far_of=of[1],
        meshes=(parts[0].meshes[0], parts[1].meshes[0]),
        kind=joint.kind,
        point=joint.point,
        gap=joint.gap,
        score=joint.score,
        made=joint.made,
        reasons=joint.reasons,
    )


def name_part(part: Part) -> str | None:
    """The name label of a part, else its group; None where it has none."""
    return None if part.label is None else part.label.name or part.label.group


def say_joint(joint: ToldJoint) -> str:
    """A joint on one line."""
    near, far = _say(joint.near, joint.near_what, joint.near_of), _say(joint.far, joint.far_what, joint.far_of)
    gap = f"gap {1000 * joint.gap:.1f} mm" if joint.gap >= 0 else f"{-1000 * joint.gap:.1f} mm into each other"
    why = f": {'; '.join(joint.reasons)}" if joint.reasons else ""
    return f"{near} - {far}, {_MANNERS.get(joint.kind, joint.kind)}, {gap}, {joint.score:.0%}{why}"


def _say(part: str, what: str | None, of: str | None) -> str:
    return f"{part} ({what or 'unlabelled'}{f' of {of}' if of else ''})"
