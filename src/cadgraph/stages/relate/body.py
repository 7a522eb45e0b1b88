"""Bodies at the ends of lines: parts that no label makes a line or a sure piece of a device."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from cadgraph.geometry.components import connected_sets
from cadgraph.geometry.line.centreline import Centreline
from cadgraph.model.vocabulary import FASTENERS
from cadgraph.stages.relate.attach import Attachments, Mount, attach_lines
from cadgraph.stages.relate.belief import Beliefs
from cadgraph.stages.relate.joint import Ends
from cadgraph.stages.relate.piping import Group, Piping

__all__ = ["Arrangement", "Body", "arrangement_of", "find_bodies", "other_groups", "unclaimed_parts"]

# Two ends are aligned, or square, by the cosine between them, and on one axis within this share of the lesser radius.
_ALIGNED, _SQUARE, _ON_AXIS = 0.95, 0.35, 0.35
_LIKELY_OTHER = 0.5  # above this probability a part is of steelwork, a support or the like
_MOST = 40  # parts of a device that labels missed
_LID = 4.0  # radii that a bonnet or a cover is long at most
# A unit of so few parts, none of which the labeler finds likelier than this to be such a piece, may be another one.
_FEW, _UNSURE = 3, 0.9

Arrangement = Literal["one", "aligned", "square", "two", "many"]


@dataclass(frozen=True)
class Body:
    """Parts at the ends of lines that may be a device.

    Args:
        parts: ascending.
        mounts: ends of lines at them.
        near: parts of units that they touch, ascending.
        unit_type: what labels make of it without being sure; None where they make nothing.
    """

    parts: tuple[int, ...]
    mounts: tuple[Mount, ...]
    near: tuple[int, ...]
    unit_type: str | None = None


def find_bodies(piping: Piping, beliefs: Beliefs) -> tuple[Ends, list[Body]]:
    """Finds what stands at the ends of lines without being sure to be anything.

    Args:
        piping: with its lines and units so far.
        beliefs: what each part may be.

    Returns:
        The ends of all lines, and the bodies at them, by their first part.
    """
    weak = {part: group for group in _weak_groups(piping, beliefs) for part in group.parts}
    pool = weak.keys() | unclaimed_parts(piping, beliefs)
    ends, mounts = _loose_mounts(piping, pool)
    # What hangs on the side of a line holds it.
    pool -= {side.solid for side in piping.joints.sides} - {mount.part for mount in mounts}
    lids = _lids(piping, beliefs, mounts, ends)
    bodies = [_body(piping, parts, mounts, ends, lids, pool) for parts in _connected(piping, pool)]
    likely = [body for body in bodies if body.mounts and len(body.parts) <= _MOST]
    return ends, [replace(body, unit_type=_weak_type(piping, body, weak)) for body in likely]


def _connected(piping: Piping, pool: Collection[int]) -> list[tuple[int, ...]]:
    """The parts of a pool that hang together."""
    pairs = [(a, b) for a, b in piping.given.contacts.plain_pairs if a in pool and b in pool]
    return connected_sets(sorted(pool), pairs)


def _weak_type(piping: Piping, body: Body, weak: Mapping[int, Group]) -> str | None:
    """The type of the only unit that a body holds and that a line leads to, if there is one."""
    held = {weak[part] for part in body.parts if part in weak}
    mounted = [group for group in held if piping.mounted.keys() & set(group.parts)]
    return mounted[0].unit_type if len(mounted) == 1 else None


def other_groups(piping: Piping) -> frozenset[str]:
    """The groups of the vocabulary that are neither of lines nor of units."""
    vocabulary = piping.given.vocabulary
    return frozenset(vocabulary.groups.keys() - vocabulary.connector_groups - vocabulary.unit_of_group.keys())


def arrangement_of(ends: Ends, rows: Sequence[int]) -> Arrangement:
    """How the ends of lines meet a body: one, two on one axis, two square to each other, two otherwise, or more."""
    if len(rows) == 1:
        return "one"
    if len(rows) > 2:
        return "many"
    a, b = rows
    cosine = float(ends.direction[a] @ ends.direction[b])
    if abs(cosine) <= _SQUARE:
        return "square"
    between = ends.point[b] - ends.point[a]
    off = float(np.linalg.norm(between - (between @ ends.direction[a]) * ends.direction[a]))
    if cosine <= -_ALIGNED and off <= _ON_AXIS * float(min(ends.radius[a], ends.radius[b])):
        return "aligned"
    return "two"


def _body(
    piping: Piping,
    parts: Sequence[int],
    mounts: Sequence[Mount],
    ends: Ends,
    lids: Collection[int],
    pool: Collection[int],
) -> Body:
    """A body of some parts, with what closes it among its parts and not among the lines at it."""
    at = [mount for mount in mounts if mount.part in parts]
    closing = {int(ends.part[mount.row]) for mount in at}.intersection(lids)
    held = tuple(mount for mount in at if int(ends.part[mount.row]) not in closing)
    around = {other for part in parts for other in piping.given.neighbors.get(part, ())}
    return Body(tuple(sorted(closing.union(parts))), held, tuple(sorted(around & piping.members - set(pool))))


def unclaimed_parts(piping: Piping, beliefs: Beliefs) -> set[int]:
    """Parts of no line and no unit that nobody but the labeler has named; the ground, fasteners and what is likely
    steelwork or a support are left out.
    """
    given = piping.given
    others = frozenset(name for _, name in beliefs.classes) - FASTENERS
    fasteners = beliefs.of_groups(given.vocabulary.groups, others) >= _LIKELY_OTHER
    steelwork = beliefs.of_groups(other_groups(piping)) >= _LIKELY_OTHER
    shut = piping.members.union(piping.lines, piping.jackets)
    free = beliefs.open & ~fasteners & ~steelwork & ~given.parts.ground & (given.cluster >= 0)
    return set(np.flatnonzero(free).tolist()) - shut


def _weak_groups(piping: Piping, beliefs: Beliefs) -> Iterator[Group]:
    """Small units of which the labeler is not sure, and nobody else says anything: they may be others, or pieces."""
    vocabulary = piping.given.vocabulary
    of_type = {kind: beliefs.of_groups(vocabulary.groups_of(kind)) for kind in {g.unit_type for g in piping.groups}}
    for group in piping.groups:
        likely = of_type[group.unit_type][list(group.parts)]
        doubted = bool((likely < _UNSURE).all()) and bool(beliefs.open[list(group.parts)].all())
        if doubted and len(group.parts) <= _FEW and not piping.recovered.keys() & set(group.parts):
            yield group


def _loose_mounts(piping: Piping, pool: Collection[int]) -> tuple[Ends, list[Mount]]:
    """The parts of a pool at ends that join nothing else."""
    given, known = piping.given, piping.joints
    free = _loose_rows(known, pool)
    if not free or not pool:
        return known.ends, []
    solids = piping.members.union(piping.lineless, pool)
    found = attach_lines(
        given.parts,
        given.contacts,
        piping.lines,
        solids,
        piping.feet,
        given.config.relate.bridge,
        piping.bolted,
        given.stated,
    )
    cut = given.edits.cut
    mounts = [mount for mount in found.mounts if mount.row in free and mount.part in pool]
    return found.ends, [mount for mount in mounts if (int(found.ends.part[mount.row]), mount.part) not in cut]


def _loose_rows(known: Attachments, pool: Collection[int]) -> set[int]:
    """The ends that join nothing but parts of a pool."""

    def is_loose(row: int) -> bool:
        offer = known.made.get(row)
        return offer is None or (offer.kind == "mount" and offer.other in pool)

    return {row for row in range(len(known.ends.part)) if is_loose(row)} - {row for row, _ in known.doubled}


def _lids(piping: Piping, beliefs: Beliefs, mounts: Sequence[Mount], ends: Ends) -> set[int]:
    """Short parts with a line that lead from a body to nothing, and that no line goes on from on its other side: its
    bonnet, its cover.
    """
    found = piping.joints
    busy = Counter(int(found.ends.part[row]) for row in {*found.made, *(mount.row for mount in mounts)})
    tapped = {tapped.part for tapped in found.taps}
    rows: dict[int, list[int]] = {}
    for mount in mounts:
        rows.setdefault(mount.part, []).append(mount.row)

    def is_lid(mount: Mount) -> bool:
        part = int(ends.part[mount.row])
        leads_nowhere = bool(beliefs.open[part]) and busy[part] == 1 and part not in tapped
        return leads_nowhere and _is_short(piping.lines[part]) and not _passes(ends, mount.row, rows[mount.part])

    return {int(ends.part[mount.row]) for mount in mounts if is_lid(mount)}


def _is_short(line: Centreline) -> bool:
    """Whether a line is no longer than that of a bonnet or a cover."""
    return line.length <= _LID * float(line.branches[0].radius.max())


def _passes(ends: Ends, row: int, others: Sequence[int]) -> bool:
    """Whether another end at the same body lies in line with one."""
    return any(arrangement_of(ends, [row, other]) == "aligned" for other in others if other != row)
