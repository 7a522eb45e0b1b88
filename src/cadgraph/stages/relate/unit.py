"""Units that hold together: connected parts of one functional group, cut where two devices meet, mended where one part
in between carries a wrong label.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cadgraph.geometry.components import connected_sets
from cadgraph.model.parts import Parts
from cadgraph.model.vocabulary import FASTENERS
from cadgraph.stages.relate.attach import Attachments, flat_contacts
from cadgraph.stages.relate.flanged import bodies_between
from cadgraph.stages.relate.piping import Group, Piping, RelateInput
from cadgraph.stages.relate.role import Roles

__all__ = ["connected_groups", "is_loose_operator", "mend_units", "split_groups", "take_in_enclosed"]

# A body stands out from the line's axis this many times farther on one side than on the other where it carries its own
# operator: one mesh for a whole valve.
_LOPSIDED = 1.5
# What no name calls a piece of a device is a whole one from so many pipe diameters on: the caps of a three-piece valve
# are shorter.
_WHOLE = 1.2
_FASTENERS = FASTENERS | {"gasket"}
_OPERATORS = frozenset(
    {"valve stem", "handwheel", "lever", "yoke", "gland", "gearbox", "actuator", "position indicator"}
)
_SPLIT = frozenset({"valve", "pump", "gauge"})


def connected_groups(given: RelateInput, roles: Roles, skip: Collection[int] = ()) -> list[Group]:
    """Connected parts of one functional group, as in the paper (section III-B, step 6).

    Args:
        given: what everything is found from.
        roles: what each part does.
        skip: parts that are left out.
    """
    unit_of_group = given.vocabulary.unit_of_group
    types = [unit_of_group.get(group) if group is not None else None for group in roles.groups]
    members = [part for part, unit in enumerate(types) if unit is not None and part not in skip]
    pairs = _pairs_of_one_type(given, types)
    return [Group(str(types[parts[0]]), parts) for parts in connected_sets(members, pairs)]


def _pairs_of_one_type(given: RelateInput, types: Sequence[str | None]) -> list[tuple[int, int]]:
    """The contacts within one structure between parts of one type of unit."""
    cluster = given.cluster
    return [
        (a, b)
        for a, b in given.contacts.plain_pairs
        if types[a] is not None and types[a] == types[b] and cluster[a] == cluster[b] >= 0
    ]


def is_loose_operator(group: Group, names: Sequence[str | None], reached: Collection[int]) -> bool:
    """Whether a group is but a handwheel, lever or the like that sits on no valve.

    Args:
        group: connected parts.
        names: of each part, or the likeliest where only the group is known.
        reached: parts at which lines end.
    """
    on_line = any(part in reached for part in group.parts)
    return group.unit_type == "valve" and _is_operator(group.parts, names) and not on_line


def _is_operator(parts: Collection[int], names: Sequence[str | None]) -> bool:
    """Whether parts are but what moves a valve: a handwheel, a lever, a stem."""
    return all(names[part] in _OPERATORS for part in parts)


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


def mend_units(piping: Piping) -> tuple[Piping, list[Group]]:
    """Takes pieces into groups where they only fit there, and joins the groups that such a piece joins.

    Returns:
        The piping, in which what was taken in carries no line, and the groups.
    """
    given = piping.given
    groups = take_in_enclosed(_mended(piping), given.parts.inside, _types_of(piping), given.neighbors, piping.lines)
    taken_in = {part for group in groups for part in group.parts} - piping.members
    if all(_is_mere_fastener(piping, part) for part in taken_in):
        return piping, groups
    members = piping.members | taken_in
    return replace(
        piping,
        lines={part: line for part, line in piping.lines.items() if part not in members},
        lineless=tuple(part for part in piping.lineless if part not in members),
        members=members,
    ), groups


def _types_of(piping: Piping) -> list[str | None]:
    """The unit type of each part, None for parts without a group, ``""`` for groups that form no unit."""
    unit_types = piping.given.vocabulary.unit_of_group
    return [None if group is None else unit_types.get(group, "") for group in piping.roles.groups]


def _is_mere_fastener(piping: Piping, part: int) -> bool:
    """Whether a part is a fastener by name, and neither line nor connector."""
    return piping.roles.names[part] in _FASTENERS and part not in piping.lines and part not in piping.lineless


def _mended(piping: Piping) -> list[Group]:
    groups = piping.groups
    work = _Work(
        {k: group.unit_type for k, group in enumerate(groups)},
        {k: set(group.parts) for k, group in enumerate(groups)},
        {part: k for k, group in enumerate(groups) for part in group.parts},
    )
    for _ in range(3):
        changed = _join_odd(work, piping)
        changed |= _join_pieces(work, piping)
        if not changed:
            break
    return sorted(
        (Group(work.types[k], tuple(sorted(parts))) for k, parts in work.parts.items()), key=lambda group: group.parts
    )


def _stands(parts: Collection[int], mounted: Mapping[int, Collection[int]], without: int = -1) -> bool:
    """Whether a line other than that of one part ends at some parts."""
    return any(line != without for part in parts for line in mounted.get(part, ()))


def _join_pieces(work: _Work, piping: Piping) -> bool:
    """Takes in the pieces in between, each after what the one before it changed."""
    near = piping.given.neighbors
    around = {part for parts in work.parts.values() for member in parts for part in near.get(member, ())}
    changed = False
    for piece in sorted(around - piping.apart):
        takers = _takers(work, piece, piping) if piece not in work.of_part else []
        if takers:
            work.merge(takers[0], takers[1:], piece)
            changed = True
    return changed


def _takers(work: _Work, piece: int, piping: Piping) -> list[int]:
    """The groups that a piece in between makes one, the one that stays first; none where it belongs to none.

    Such a piece is a fastener all of whose neighbours are one unit, or it joins groups of which one at most is on a
    line.
    """
    touched = _touched(work, piping.given.neighbors[piece])
    clamped = _is_clamped(work, piece, piping)
    for unit_type in sorted({work.types[k] for k in touched}):
        same = [k for k in touched if work.types[k] == unit_type]
        standing = [k for k in same if _stands(work.parts[k], piping.mounted, piece)]
        others = sorted(set(same).difference(standing))
        joins = clamped or len(same) > 1 >= len(standing)
        if joins and _may_hold(work, piece, others, piping):
            return standing + others
    return []


def _touched(work: _Work, near: Sequence[int]) -> list[int]:
    """The groups of some parts, ascending."""
    return sorted({work.of_part[other] for other in near if other in work.of_part})


def _may_hold(work: _Work, piece: int, groups: Sequence[int], piping: Piping) -> bool:
    """Whether a piece may be one of groups that are on no line: a nipple between two valves is none of theirs, but what
    holds a mere operator is.
    """
    return piece not in piping.lines or all(_is_operator(work.parts[k], piping.roles.names) for k in groups)


def _is_clamped(work: _Work, piece: int, piping: Piping) -> bool:
    """Whether a piece is a fastener all of whose neighbours are one group."""
    holders = {work.of_part.get(other, -1) for other in piping.given.neighbors[piece]}
    return piping.roles.names[piece] in _FASTENERS and len(holders) == 1 and -1 not in holders


def _join_odd(work: _Work, piping: Piping) -> bool:
    """A single part of another type whose label nothing supports, next to pieces of one type only."""
    changed = False
    for k in sorted(work.parts):
        if k not in work.parts or len(work.parts[k]) != 1:
            continue
        (piece,) = work.parts[k]
        takers = _takers_of_odd(work, k, piece, piping) if piece in piping.unsupported else []
        if takers:
            work.merge(takers[0], [*takers[1:], k], None)
            changed = True
    return changed


def _takers_of_odd(work: _Work, k: int, piece: int, piping: Piping) -> list[int]:
    """The groups that a single part is next to, if they are of one type and one of all these at most is on a line."""
    touched = [other for other in _touched(work, piping.given.neighbors.get(piece, ())) if other != k]
    standing = [other for other in touched if _stands(work.parts[other], piping.mounted)]
    alike = len({work.types[other] for other in touched}) == 1
    return touched if alike and len(standing) + (piece in piping.mounted) <= 1 else []


def take_in_enclosed(
    groups: Sequence[Group],
    inside: Mapping[int, int],
    types: Sequence[str | None],
    near: Mapping[int, Sequence[int]],
    lines: Collection[int],
) -> list[Group]:
    """Gives what lies within a unit's parts, and touches nothing else, to that unit: the ball to its valve.

    Args:
        groups: connected parts.
        inside: the innermost part around each part that lies inside another one.
        types: the unit type of each part, None for parts without a group; ``""`` for groups that form no unit.
        near: parts near each part.
        lines: parts with a line, which stay apart.
    """
    home = _homes(groups, inside, types, near, lines)
    if not home:
        return list(groups)
    members = [[part for part in group.parts if part not in home] for group in groups]
    for part, target in home.items():
        members[target].append(part)
    kept = [Group(group.unit_type, tuple(sorted(own))) for group, own in zip(groups, members, strict=True) if own]
    return sorted(kept, key=lambda group: group.parts)


def _homes(
    groups: Sequence[Group],
    inside: Mapping[int, int],
    types: Sequence[str | None],
    near: Mapping[int, Sequence[int]],
    lines: Collection[int],
) -> dict[int, int]:
    """The group that each part goes to that lies within one, fits it, and touches nothing outside of it."""
    owner = {part: k for k, group in enumerate(groups) for part in group.parts}
    within = _units_around(inside, owner)

    def fits(part: int, k: int) -> bool:
        return owner.get(part) != k and part not in lines and types[part] in (None, groups[k].unit_type)

    home = {part: k for part, k in within.items() if fits(part, k)}
    known = {**within, **owner}
    while loose := [part for part in home if _reaches_out(part, near.get(part, ()), home, known)]:
        for part in loose:
            del home[part]
    return home


def _reaches_out(part: int, near: Sequence[int], home: Mapping[int, int], known: Mapping[int, int]) -> bool:
    """Whether a part touches anything outside the group that it would go to."""
    return any(home.get(other, known.get(other)) != home[part] for other in near)


def _units_around(inside: Mapping[int, int], owner: Mapping[int, int]) -> dict[int, int]:
    """For each part that lies within a group the one that it lies in."""
    around = {part: _unit_around(part, inside, owner) for part in inside}
    return {part: k for part, k in around.items() if k is not None}


def _unit_around(part: int, inside: Mapping[int, int], owner: Mapping[int, int]) -> int | None:
    """The group of the innermost part around a part that is of one."""
    while part in inside:
        part = inside[part]
        if part in owner:
            return owner[part]
    return None


def split_groups(piping: Piping, groups: Sequence[Group]) -> list[Group]:
    """Cuts groups that hold several devices: each body with an operator of its own, or with two open ends.

    Args:
        piping: what joins what.
        groups: connected parts.
    """
    mounts: dict[int, list[int]] = {}
    for mount in piping.joints.mounts:
        mounts.setdefault(mount.part, []).append(mount.row)
    outcome = []
    for group in groups:
        bodies = [part for part in group.parts if part in mounts]
        cores = _cores(piping, group, bodies, mounts) if group.unit_type in _SPLIT and bodies else []
        outcome += _divide(piping, group, cores) if len(cores) > 1 else [group]
    return sorted(outcome, key=lambda group: group.parts)


def _cores(piping: Piping, group: Group, bodies: Sequence[int], mounts: Mapping[int, Sequence[int]]) -> list[int]:
    """The bodies that are devices of their own.

    Args:
        piping: what joins what.
        group: connected parts.
        bodies: parts of the group at which lines end.
        mounts: rows of the ends of lines at each part.
    """
    given, found = piping.given, piping.joints
    pairs = _pairs_within(group.parts, given.neighbors)
    beside = _pairs_beyond(group.parts, given.neighbors, piping.members)
    if len({part for pair in beside for part in pair}.intersection(group.parts).union(bodies)) < 2:
        return []
    others = {part for pair in beside for part in pair}.difference(group.parts)
    flat = flat_contacts(given.parts, given.contacts, [*pairs, *beside], given.config.cluster.eps)
    own = {body: mounts[body] for body in bodies}
    rows = {**own, **{body: [row] for body, row in bodies_between(found.ends, own, flat, others).items()}}
    flanged = [pair for pair in flat if others.union(rows).issuperset(pair)]
    holders = _holders(given.parts, pairs, rows, found)

    def is_core(body: int) -> bool:
        at = mounts.get(body, ())
        n_open = len(at) + sum(body in pair for pair in flanged)
        alone = body in holders or len(at) >= 2 or _is_whole(piping, body, rows[body][0])
        return n_open >= 2 and (alone or _stands_out(given.parts, body, rows[body], found))

    cores = [body for body in sorted(rows) if is_core(body)]
    return cores if cores or group.unit_type != "gauge" else _feet(group, bodies, holders)


def _is_whole(piping: Piping, body: int, row: int) -> bool:
    """Whether a body is not called a piece of a device, and is longer along its line than a piece of one is."""
    group = piping.roles.groups[body]
    if group is None or piping.roles.names[body] not in (None, piping.given.vocabulary.groups[group].names[0]):
        return False
    ends = piping.joints.ends
    vertices, _ = piping.given.parts.scene.mesh(body)
    along = float(np.ptp(vertices @ ends.direction[row])) if len(vertices) else 0.0
    return along >= _WHOLE * 2 * float(ends.radius[row])


def _feet(group: Group, bodies: Sequence[int], holders: Collection[int]) -> list[int]:
    """The feet of gauges: each has one, so that two feet are two gauges."""
    return [body for body in bodies if body in holders or len(group.parts) == len(bodies)]


def _pairs_within(parts: Sequence[int], near: Mapping[int, Sequence[int]]) -> list[tuple[int, int]]:
    """The pairs of some parts that are near each other, first < second."""
    inside = set(parts)
    return [(a, b) for a in parts for b in near.get(a, ()) if a < b and b in inside]


def _pairs_beyond(
    parts: Sequence[int], near: Mapping[int, Sequence[int]], members: Collection[int]
) -> list[tuple[int, int]]:
    """The pairs of one of some parts and one of another unit that are near each other, first < second."""
    inside = set(parts)
    return [(min(a, b), max(a, b)) for a in parts for b in near.get(a, ()) if b in members and b not in inside]


def _holders(
    parts: Parts, pairs: Sequence[tuple[int, int]], mounts: Mapping[int, Sequence[int]], found: Attachments
) -> set[int]:
    """Bodies with an operator of their own: a part on that body alone that stands out from it.

    A lever that rests on one half of a body and turns the stem in the other half is neither's own.
    """
    return {
        body
        for part, body in _only_bodies_under(pairs, mounts)
        if _reach(parts, part, mounts[body], found) > _reach(parts, body, mounts[body], found)
    }


def _only_bodies_under(pairs: Sequence[tuple[int, int]], bodies: Collection[int]) -> list[tuple[int, int]]:
    """The parts that touch one body and no part that touches but others, each with that body."""
    on = _bodies_under(pairs, bodies)
    shared = {part for a, b in pairs if a in on and b in on and on[a].isdisjoint(on[b]) for part in (a, b)}
    return [(part, next(iter(own))) for part, own in on.items() if len(own) == 1 and part not in shared]


def _bodies_under(pairs: Sequence[tuple[int, int]], bodies: Collection[int]) -> dict[int, set[int]]:
    """The bodies that each other part touches, of those that touch any."""
    on: dict[int, set[int]] = {}
    for a, b in pairs:
        for part, body in ((a, b), (b, a)):
            if part not in bodies and body in bodies:
                on.setdefault(part, set()).add(body)
    return on


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


def _divide(piping: Piping, group: Group, cores: Sequence[int]) -> list[Group]:
    """Gives each part to the core that is the fewest contacts away; of two the one that is nearer."""
    centers = piping.given.parts.properties.obb_center
    inside = set(group.parts)
    steps = {core: _steps(core, inside, piping.given.neighbors, set(cores) - {core}) for core in cores}
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
