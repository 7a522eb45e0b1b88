"""Joints as a user corrected them: those that were cut, and those that were made where geometry found none."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cadgraph.geometry.contact.pairs import find_contacts
from cadgraph.geometry.kernels.triangle import triangle_distances
from cadgraph.geometry.line.centreline import Centreline
from cadgraph.model.parts import Joint, Parts
from cadgraph.model.records import BY_USER, CUT
from cadgraph.model.scene import Floats
from cadgraph.stages.relate.attach import Attachments, Mount, Tapped, facings_of, singles_of
from cadgraph.stages.relate.edits import JointEdit, NetworkEdits, Unmet
from cadgraph.stages.relate.joint import Tap, nearest_on
from cadgraph.stages.relate.offer import Offer

__all__ = ["FARTHEST", "bridge_solids", "edit_joints", "joint_of_solids", "unmet_joints"]

FARTHEST = 2.0
"""A user may join parts across a gap of at most this much [m]: what is farther apart is more than a missing piece."""

_CERTAIN, _NEVER = 30.0, -30.0  # log-odds of what a user says
# An end that is joined already gives way only where no free one is near: it counts as this many times as far, and so
# much [m] farther.
_TAKEN, _TAKEN_MORE = 4.0, 0.02


@dataclass(frozen=True, eq=False)
class _Chance:
    """A way in which two parts may join.

    Args:
        offer: the joint.
        cost: the gap, more where an end of it is joined already [m].
        at: the point of a solid, where that is what the end joins.
    """

    offer: Offer
    cost: float
    at: Floats | None = None


def edit_joints(
    found: Attachments, edits: NetworkEdits, parts: Parts, lines: Mapping[int, Centreline], solids: Collection[int]
) -> Attachments:
    """What joins what, as a user corrected it.

    Args:
        found: as geometry has it.
        edits: of a user.
        parts: of the scene.
        lines: centreline of each part that carries one.
        solids: parts without a line that lines may end at.
    """
    if not edits.joints:
        return found
    found = _without_cut(found, edits)
    made, refused = dict(found.made), dict(found.refused)
    at: dict[int, Floats] = {}
    for edit in edits.joined:
        own = _own(found, edit, made)
        made.update(own)
        if own or _stands(found, edit):
            continue
        chance = _best(found, edit, parts, lines, solids, made)
        if chance is not None:
            _make(chance, made, refused, at)
    return _with_made(replace(found, refused=refused), made, at)


def _own(found: Attachments, edit: JointEdit, made: Mapping[int, Offer]) -> dict[int, Offer]:
    """The joint that two parts have by themselves, sure now: one that was cut and is joined again is where it was."""
    pair = {edit.first, edit.second}
    rows = (*found.ends.of_part.get(edit.first, ()), *found.ends.of_part.get(edit.second, ()))
    own = {row: made[row] for row in rows if row in made and set(_pair(found, made[row])) == pair}
    sure = {id(o): o._replace(odds=_CERTAIN, measured={}, flags=(BY_USER,), said="") for o in own.values()}
    return {row: sure[id(offer)] for row, offer in own.items()}


def _stands(found: Attachments, edit: JointEdit) -> bool:
    """Whether two parts are joined otherwise: by ends in one place, or a solid at the side of a line."""
    pairs = [(int(found.ends.part[a]), int(found.ends.part[b])) for a, b in found.doubled]
    pairs += [(side.solid, side.part) for side in found.sides]
    return {edit.first, edit.second} in map(set, pairs)


def _without_cut(found: Attachments, edits: NetworkEdits) -> Attachments:
    """What joins what without the joints that a user cut, which are refused now."""
    cut = edits.cut
    twins = _cut_twins(found, edits)
    gone = {**_cut_offers(found, found.made, edits), **twins}
    kept = replace(
        found,
        refused={**found.refused, **_cut_offers(found, found.refused, edits), **gone},
        doubled=tuple(pair for pair in found.doubled if pair[0] not in twins),
        sides=tuple(side for side in found.sides if (side.solid, side.part) not in cut),
    )
    return _with_made(kept, {row: offer for row, offer in found.made.items() if row not in gone}, {})


def _cut_offers(found: Attachments, offers: Mapping[int, Offer], edits: NetworkEdits) -> dict[int, Offer]:
    """Those offers that a user cut, as refused ones."""
    return {row: _cut(offer) for row, offer in offers.items() if _pair(found, offer) in edits.cut}


def _cut_twins(found: Attachments, edits: NetworkEdits) -> dict[int, Offer]:
    """The ends in one place with another one whose parts a user cut, as refused offers."""
    part = found.ends.part
    apart = [(a, b) for a, b in found.doubled if (int(part[a]), int(part[b])) in edits.cut]
    return {a: _cut(Offer("face", a, b, 0.0, 0.0)) for a, b in apart}


def _with_made(found: Attachments, made: Mapping[int, Offer], at: Mapping[int, Floats]) -> Attachments:
    """What joins what with other joints made; ``at`` holds the points of solids that are not at their ends."""
    singles = singles_of(made)
    return replace(
        found,
        made=made,
        refused={row: offer for row, offer in found.refused.items() if row not in made},
        facings=facings_of(made),
        taps=tuple(Tapped(row, o.other, o.tap, o.score, BY_USER in o.flags) for row, o in singles if o.tap is not None),
        mounts=tuple(Mount(row, o.other, o.gap, o.score, at.get(row)) for row, o in singles if o.kind == "mount"),
    )


def _pair(found: Attachments, offer: Offer) -> tuple[int, int]:
    return int(found.ends.part[offer.row]), offer.part(found.ends)


def _cut(offer: Offer) -> Offer:
    return offer._replace(odds=_NEVER, measured={}, flags=(CUT,), said="")


def _make(chance: _Chance, made: dict[int, Offer], refused: dict[int, Offer], at: dict[int, Floats]) -> None:
    """Makes a joint; what its ends joined before gives way."""
    offer = chance.offer
    rows = (offer.row, offer.other) if offer.kind == "face" else (offer.row,)
    for row in rows:
        former = made.pop(row, None)
        if former is not None and former.of_two_ends:
            other = former.other if former.row == row else former.row
            if made.get(other) is former:
                refused[other] = made.pop(other)
        at.pop(row, None)
    made.update(dict.fromkeys(rows, offer))
    if chance.at is not None:
        at[offer.row] = chance.at


def _best(
    found: Attachments,
    edit: JointEdit,
    parts: Parts,
    lines: Mapping[int, Centreline],
    solids: Collection[int],
    made: Mapping[int, Offer],
) -> _Chance | None:
    """The nearest way in which two parts may join; None where no end of a line of theirs is near."""
    chances: list[_Chance] = []
    for part, other in ((edit.first, edit.second), (edit.second, edit.first)):
        rows = found.ends.of_part.get(part, ())
        chances += _at_ends(found, rows, found.ends.of_part.get(other, ()) if part < other else (), made)
        if other in lines:
            chances += _at_side(found, rows, other, lines[other], made)
        elif other in solids:
            vertices, faces = parts.scene.mesh(other)
            chances += _at_solid(found, rows, other, vertices[faces], made)
    near = [chance for chance in chances if chance.offer.gap <= FARTHEST]
    return min(
        near, key=lambda chance: (chance.cost, chance.offer.kind, chance.offer.row, chance.offer.other), default=None
    )


def _at_ends(
    found: Attachments, rows: Sequence[int], others: Sequence[int], made: Mapping[int, Offer]
) -> Iterator[_Chance]:
    points = found.ends.point
    for row in rows:
        for other in others:
            gap = float(np.linalg.norm(points[row] - points[other]))
            yield _Chance(_offer("face", row, other, gap), _cost(gap, made, row, other))


def _at_side(
    found: Attachments, rows: Sequence[int], part: int, line: Centreline, made: Mapping[int, Offer]
) -> Iterator[_Chance]:
    for row in rows:
        for number, branch in enumerate(line.branches):
            s, foot, _, wall, apart = nearest_on(branch, found.ends.point[row])
            # At an end of the other line the two ends join, not an end and a side.
            if branch.closed or wall < s < branch.length - wall:
                gap = max(0.0, apart - wall)
                tap = Tap(number, s, foot, gap, wall)
                yield _Chance(_offer("tap", row, part, gap)._replace(tap=tap), _cost(gap, made, row))


def _at_solid(
    found: Attachments, rows: Sequence[int], solid: int, triangles: Floats, made: Mapping[int, Offer]
) -> Iterator[_Chance]:
    for row in rows:
        point = np.broadcast_to(found.ends.point[row], (len(triangles), 3, 3))
        distance, points = triangle_distances(np.ascontiguousarray(point), np.ascontiguousarray(triangles))
        nearest = int(distance.argmin())
        gap = float(distance[nearest])
        yield _Chance(_offer("mount", row, solid, gap), _cost(gap, made, row), np.array(points[nearest, 1]))


def _offer(kind: str, row: int, other: int, gap: float) -> Offer:
    return Offer(kind, row, other, gap, _CERTAIN, flags=(BY_USER,))  # type: ignore[arg-type]


def _cost(gap: float, made: Mapping[int, Offer], *rows: int) -> float:
    taken = any(row in made for row in rows)
    return _TAKEN * gap + _TAKEN_MORE if taken else gap


def bridge_solids(
    edits: NetworkEdits, parts: Parts, lines: Collection[int], owner: Mapping[int, int]
) -> dict[tuple[int, int], Floats]:
    """Solids that a user joined to each other, with the nearest points of both.

    Args:
        edits: of a user.
        parts: of the scene.
        lines: parts that carry one.
        owner: of each part that is a solid what it belongs to.

    Returns:
        For each pair, first < second, ``(2, 3)`` points [m].
    """
    found = {}
    for edit in edits.joined:
        a, b = sorted((edit.first, edit.second))
        known = a in owner and b in owner and a not in lines and b not in lines
        if known and owner[a] != owner[b]:
            near = find_contacts(parts.scene.select([a, b]), FARTHEST)
            if len(near.pairs):
                found[a, b] = near.points[0]
    return found


def joint_of_solids(pair: tuple[int, int], points: Floats) -> Joint:
    """The joint of two solids that a user joined, by the nearest points of both."""
    x, y, z = (float(v) for v in points.mean(axis=0))
    return Joint(*pair, "flange", (x, y, z), float(np.linalg.norm(points[1] - points[0])), 1.0, True, (BY_USER,))


def unmet_joints(
    edits: NetworkEdits, joints: Sequence[Joint], parts: Parts, usable: Collection[int], owner: Mapping[int, int]
) -> list[Unmet]:
    """The joints that a user wants made and that can't be, and why.

    Args:
        edits: of a user.
        joints: of the network.
        parts: of the scene.
        usable: parts that carry a line, or that lines may end at.
        owner: unit of each part.
    """
    made = {frozenset((joint.first, joint.second)) for joint in joints if joint.made}
    missing = [edit for edit in edits.joined if frozenset((edit.first, edit.second)) not in made]
    return [(edit.number, _why_not(edit, parts, usable, owner)) for edit in missing]


def _why_not(edit: JointEdit, parts: Parts, usable: Collection[int], owner: Mapping[int, int]) -> str:
    for part in (edit.first, edit.second):
        if part not in usable:
            return f"{parts.scene.paths[part]} carries no line and is in no unit; correct its label first"
    if owner.get(edit.first, -1) == owner.get(edit.second, -2):
        return "both are of one unit"
    return f"no ends of theirs are within {FARTHEST:g} m of each other"
