"""Units that hold together: connected parts of one functional group, cut where two devices meet, mended where one part
in between carries a wrong label.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cadgraph.geometry.components import connected_sets
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.scene import Ints
from cadgraph.stages.relate.attach import Attachments, flat_contacts
from cadgraph.stages.relate.role import Roles

__all__ = ["FASTENERS", "Group", "connected_groups", "is_loose_operator", "mend_groups", "split_groups"]

# A body stands out from the line's axis this many times farther on one side than on the other where it carries its own
# operator: one mesh for a whole valve.
_LOPSIDED = 1.5
FASTENERS = frozenset({"bolt", "nut", "washer", "stud", "screw", "gasket"})
_OPERATORS = frozenset(
    {"valve stem", "handwheel", "lever", "yoke", "gland", "gearbox", "actuator", "position indicator"}
)
_SPLIT = frozenset({"valve", "pump", "gauge"})


@dataclass(frozen=True)
class Group:
    """Parts that work as one.

    Args:
        unit_type: as the vocabulary calls it.
        parts: ascending.
    """

    unit_type: str
    parts: tuple[int, ...]


def connected_groups(
    roles: Roles, contacts: Contacts, cluster: Ints, unit_of_group: Mapping[str, str], skip: Collection[int] = ()
) -> list[Group]:
    """Connected parts of one functional group, as in the paper (section III-B, step 6).

    Args:
        roles: of each part.
        contacts: pairs of parts that are near.
        cluster: ``(n_parts,)``; -1 takes no part.
        unit_of_group: the unit type of each group that forms units.
        skip: parts that are left out.
    """
    types = [unit_of_group.get(group) if group is not None else None for group in roles.groups]
    members = [part for part, unit in enumerate(types) if unit is not None and part not in skip]
    pairs = [
        (a, b)
        for a, b in contacts.pairs.tolist()
        if types[a] is not None and types[a] == types[b] and cluster[a] == cluster[b] >= 0
    ]
    return [Group(str(types[parts[0]]), parts) for parts in connected_sets(members, pairs)]


def is_loose_operator(group: Group, names: Sequence[str | None], reached: Collection[int]) -> bool:
    """Whether a group is but a handwheel, lever or the like that sits on no valve.

    Args:
        group: connected parts.
        names: of each part, or the likeliest where only the group is known.
        reached: parts at which lines end.
    """
    return (
        group.unit_type == "valve"
        and all(names[part] in _OPERATORS for part in group.parts)
        and not any(part in reached for part in group.parts)
    )


@dataclass
class _Work:
    """Groups while they are mended."""

    types: dict[int, str]
    parts: dict[int, set[int]]
    of_part: dict[int, int]

    def merge(self, keep: int, others: Collection[int], piece: int | None) -> None:
        for other in others:
            if other != keep:
                for part in self.parts.pop(other):
                    self.parts[keep].add(part)
                    self.of_part[part] = keep
                self.types.pop(other)
        if piece is not None:
            self.parts[keep].add(piece)
            self.of_part[piece] = keep


def mend_groups(
    groups: Sequence[Group],
    names: Sequence[str | None],
    near: Mapping[int, Sequence[int]],
    mounted: Mapping[int, Collection[int]],
    apart: Collection[int],
    unsure: Collection[int],
    lines: Collection[int],
) -> list[Group]:
    """Takes in pieces that only fit there, and joins what such a piece joins.

    Args:
        groups: connected parts.
        names: of each part.
        near: parts near each part.
        mounted: parts at which ends of lines sit, and whose lines these are.
        apart: parts that belong to no unit: the ground, and pipe, however it is called.
        unsure: parts whose label nothing supports, where labels are doubtful.
        lines: parts with a line.
    """
    work = _Work(
        {k: group.unit_type for k, group in enumerate(groups)},
        {k: set(group.parts) for k, group in enumerate(groups)},
        {part: k for k, group in enumerate(groups) for part in group.parts},
    )
    for _ in range(3):
        changed = _join_odd(work, near, mounted, unsure)
        changed |= _join_pieces(work, names, near, mounted, apart, lines)
        if not changed:
            break
    return sorted(
        (Group(work.types[k], tuple(sorted(parts))) for k, parts in work.parts.items()), key=lambda group: group.parts
    )


def _stands(parts: Collection[int], mounted: Mapping[int, Collection[int]], without: int = -1) -> bool:
    """Whether a line other than that of one part ends at some parts."""
    return any(line != without for part in parts for line in mounted.get(part, ()))


def _join_pieces(
    work: _Work,
    names: Sequence[str | None],
    near: Mapping[int, Sequence[int]],
    mounted: Mapping[int, Collection[int]],
    apart: Collection[int],
    lines: Collection[int],
) -> bool:
    """A piece in between: a fastener all of whose neighbours are one unit, or what joins pieces of which one at most
    is on a line.
    """
    around = sorted({part for parts in work.parts.values() for member in parts for part in near.get(member, ())})
    changed = False
    for piece in around:
        if piece in work.of_part or piece in apart:
            continue
        touched = sorted({work.of_part[other] for other in near[piece] if other in work.of_part})
        own = names[piece] in FASTENERS and all(other in work.of_part for other in near[piece])
        for unit in sorted({work.types[k] for k in touched}):
            same = [k for k in touched if work.types[k] == unit]
            standing = [k for k in same if _stands(work.parts[k], mounted, piece)]
            # A nipple between two valves is no piece of theirs; what holds a mere operator is.
            if piece in lines and not all(
                k in standing or all(names[part] in _OPERATORS for part in work.parts[k]) for k in same
            ):
                continue
            if (own and len(touched) == 1) or (len(same) > 1 and len(standing) <= 1):
                work.merge(standing[0] if standing else same[0], same, piece)
                changed = True
                break
    return changed


def _join_odd(
    work: _Work, near: Mapping[int, Sequence[int]], mounted: Mapping[int, Collection[int]], unsure: Collection[int]
) -> bool:
    """A single part of another type whose label nothing supports, next to pieces of one type only."""
    changed = False
    for k in sorted(work.parts):
        if k not in work.parts or len(work.parts[k]) != 1:
            continue
        (piece,) = work.parts[k]
        if piece not in unsure:
            continue
        touched = sorted({work.of_part[other] for other in near.get(piece, ()) if other in work.of_part} - {k})
        types = {work.types[other] for other in touched}
        standing = [other for other in touched if _stands(work.parts[other], mounted)]
        if len(types) == 1 and len(standing) + (piece in mounted) <= 1:
            keep = touched[0]
            work.merge(keep, [*touched[1:], k], None)
            changed = True
    return changed


def split_groups(
    parts: Parts,
    groups: Sequence[Group],
    contacts: Contacts,
    found: Attachments,
    near: Mapping[int, Sequence[int]],
    names: Sequence[str | None],
    eps: float,
) -> list[Group]:
    """Cuts groups that hold several devices: each body with an operator of its own, or with two open ends.

    Args:
        parts: of the scene.
        groups: connected parts.
        contacts: pairs of parts that are near.
        found: what joins what.
        near: parts near each part.
        names: of each part.
        eps: contact distance [m].
    """
    mounts: dict[int, list[int]] = {}
    for mount in found.mounts:
        mounts.setdefault(mount.part, []).append(mount.row)
    outcome = []
    for group in groups:
        bodies = [part for part in group.parts if part in mounts]
        if group.unit_type not in _SPLIT or len(bodies) < 2:
            outcome.append(group)
            continue
        inside = set(group.parts)
        pairs = [(a, b) for a in group.parts for b in near.get(a, ()) if a < b and b in inside]
        flanged = flat_contacts(parts, contacts, [(a, b) for a, b in pairs if a in bodies and b in bodies], eps)
        cores = _cores(parts, group, bodies, mounts, pairs, set(flanged), found)
        outcome += _divide(parts, group, cores, near) if len(cores) > 1 else [group]
    return sorted(outcome, key=lambda group: group.parts)


def _cores(
    parts: Parts,
    group: Group,
    bodies: Sequence[int],
    mounts: Mapping[int, Sequence[int]],
    pairs: Sequence[tuple[int, int]],
    flanged: Collection[tuple[int, int]],
    found: Attachments,
) -> list[int]:
    """The bodies that are devices of their own."""
    rest = {part for part in group.parts if part not in mounts}
    touched: dict[int, set[int]] = {}
    for a, b in pairs:
        for part, body in ((a, b), (b, a)):
            if part in rest and body in mounts:
                touched.setdefault(part, set()).add(body)
    # What is on one body alone and stands out from it is its operator.
    holders = {
        body
        for part, found_on in touched.items()
        if len(found_on) == 1
        for body in found_on
        if _reach(parts, part, mounts[body], found) > _reach(parts, body, mounts[body], found)
    }
    cores = []
    for body in bodies:
        n_open = len(mounts[body]) + sum(body in pair for pair in flanged)
        own = body in holders or _stands_out(parts, body, mounts[body], found)
        if n_open >= 2 and (own or len(mounts[body]) >= 2):
            cores.append(body)
    if group.unit_type == "gauge":
        # A gauge has one foot; two feet are two gauges.
        return cores or [body for body in bodies if body in holders or len(group.parts) == len(bodies)]
    return cores


def _reach(parts: Parts, part: int, rows: Sequence[int], found: Attachments) -> float:
    """The greatest distance of a part from the axis of the line at an end [m]."""
    vertices, _ = parts.scene.mesh(part)
    offset = vertices - found.ends.point[rows[0]]
    axis = found.ends.direction[rows[0]]
    return float(np.linalg.norm(offset - (offset @ axis)[:, None] * axis, axis=1).max(initial=0.0))


def _stands_out(parts: Parts, body: int, rows: Sequence[int], found: Attachments) -> bool:
    """Whether a body reaches much farther to one side of its line than to the other."""
    point, axis = found.ends.point[rows[0]], found.ends.direction[rows[0]]
    vertices, _ = parts.scene.mesh(body)
    offset = vertices - point
    across = offset - (offset @ axis)[:, None] * axis
    reach = np.linalg.norm(across, axis=1)
    if not len(reach) or not reach.max() > 0:
        return False
    far = across[int(np.argmax(reach))] / reach.max()
    return bool(reach.max() > _LOPSIDED * max(float(-(across @ far).min()), float(found.ends.radius[rows[0]])))


def _divide(parts: Parts, group: Group, cores: Sequence[int], near: Mapping[int, Sequence[int]]) -> list[Group]:
    """Gives each part to the core that is the fewest contacts away; of two the one that is nearer."""
    centers = parts.properties.obb_center
    inside = set(group.parts)
    steps = {core: _steps(core, inside, near, set(cores) - {core}) for core in cores}
    members: dict[int, list[int]] = {core: [] for core in cores}
    for part in group.parts:
        ranked = sorted(
            (steps[core].get(part, len(inside)), float(np.linalg.norm(centers[part] - centers[core])), core)
            for core in cores
        )
        members[ranked[0][2]].append(part)
    return [replace(group, parts=tuple(sorted(found))) for found in members.values()]


def _steps(
    core: int, inside: Collection[int], near: Mapping[int, Sequence[int]], shut: Collection[int]
) -> dict[int, int]:
    """Contacts from a core to each part, not through other cores."""
    steps, front = {core: 0}, [core]
    while front:
        following = []
        for here in front:
            for there in near.get(here, ()):
                if there in inside and there not in steps and there not in shut:
                    steps[there] = steps[here] + 1
                    following.append(there)
        front = following
    return steps
