"""The joints of a network as the graph keeps them: those that were made, and the best ones that were not."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from cadgraph.model.parts import Joint, UnitParts
from cadgraph.model.records import CUT
from cadgraph.model.scene import Floats
from cadgraph.stages.relate.attach import Attachments
from cadgraph.stages.relate.network import SIDE_SCORE, TWIN_SCORE, Drawing
from cadgraph.stages.relate.offer import Offer
from cadgraph.stages.relate.piping import Piping

__all__ = ["record_joints"]

_LEAST = 0.005  # what is less sure than this was no joint to think of
_SLEEVE = "lies along the other one, as in a sleeve"


def record_joints(piping: Piping, units: Sequence[UnitParts], drawing: Drawing) -> tuple[Joint, ...]:
    """The joints that connections are made of, and for each end that joins nothing the likeliest one.

    Args:
        piping: what joins what.
        units: in order.
        drawing: of the network.
    """
    found = piping.joints
    joints = [*_made(found), *_twins(found), *_refused(found)]
    taken = {*piping.lines, *piping.lineless, *(part for unit in units for part in unit.parts)}
    joints += [joint for joint in piping.open if joint.first not in taken]
    for side in drawing.standing.values():
        why = ("no line ends at it, and it touches this one",)
        joints.append(Joint(side.solid, side.part, "side", _point(side.tap.point), side.tap.gap, SIDE_SCORE, True, why))
    for (a, b), how in drawing.met.items():
        joints.append(Joint(a, b, "flange", _point(how.point), how.gap, how.score, True, (how.why,)))
    return tuple(sorted(joints, key=lambda joint: (joint.first, joint.second, joint.point, joint.kind)))


def _made(found: Attachments) -> Iterator[Joint]:
    """One joint for each offer that was taken; one between two ends is there once."""
    for row, offer in sorted(found.made.items()):
        if not offer.of_two_ends or row == offer.row:
            yield _joint(found, offer, True)


def _refused(found: Attachments) -> Iterator[Joint]:
    """The best joints of ends that stayed free, each once."""
    offers = {(o.row, o.other, o.kind): o for o in found.refused.values() if o.kind != "sleeve"}
    for _, offer in sorted(offers.items()):
        if offer.score >= _LEAST or offer.flags == (CUT,):
            yield _joint(found, offer, False)


def _joint(found: Attachments, offer: Offer, made: bool) -> Joint:
    ends = found.ends
    part = int(ends.part[offer.row])
    point = _point(ends.point[offer.row])
    if offer.kind == "face" or offer.kind == "corner":
        other = int(ends.part[offer.other])
        return Joint(part, other, offer.kind, point, offer.gap, offer.score, made, offer.reasons)
    if offer.kind == "mount":
        return Joint(part, offer.other, "mount", point, offer.gap, offer.score, made, offer.reasons)
    reasons = (_SLEEVE, *offer.reasons) if offer.kind == "sleeve" else offer.reasons
    return Joint(part, offer.other, "tap", point, offer.gap, offer.score, made, reasons)


def _twins(found: Attachments) -> Iterator[Joint]:
    """Ends in one place that look the same way: a pipe in its slip-on flange."""
    ends = found.ends
    for row, twin in found.doubled:
        gap = float((ends.point[twin] - ends.point[row]) @ ends.direction[row])
        why = ("both end in one place and look the same way",)
        yield Joint(
            int(ends.part[row]), int(ends.part[twin]), "face", _point(ends.point[row]), gap, TWIN_SCORE, True, why
        )


def _point(point: Floats) -> tuple[float, float, float]:
    x, y, z = (float(v) for v in point)
    return x, y, z
