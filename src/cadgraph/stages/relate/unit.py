"""Units that hold together: connected parts of one functional group, mended where one part in between carries a wrong
label.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cadgraph.geometry.components import connected_sets
from cadgraph.model.parts import Parts
from cadgraph.model.scene import Floats
from cadgraph.model.vocabulary import FASTENERS, OPERATORS
from cadgraph.stages.relate.body_shape import box_around
from cadgraph.stages.relate.enclosed import holds_disc
from cadgraph.stages.relate.line import is_disc
from cadgraph.stages.relate.piping import Group, Piping, RelateInput
from cadgraph.stages.relate.role import Roles

__all__ = ["ON_VESSELS", "connected_groups", "is_loose", "mend_units", "take_in_enclosed"]

_FASTENERS = FASTENERS | {"gasket"}

ON_VESSELS = frozenset({"nozzle", "manway", "saddle", "skirt", "tank leg", "lifting lug"})
"""Names of what stands on a vessel: it is none by itself, and machines have it, too."""

# What drives a pump drives other machines.
_OF_VESSELS = ON_VESSELS | {"dished head"}
_WITHIN, _NEXT_TO = 0.9, 0.02  # share of a box's width within another's outline; how far apart they are at most [m]
_DRIVES = frozenset({"motor", "motor fan cover", "terminal box", "shaft", "coupling guard", "pump base"})
_DIALS = frozenset({"gauge face", "gauge needle"})
_OBLONG = 1.2  # length as share of the width
_DRIVEN = frozenset({"compressor", "blower", "burner", "separator"})


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


def is_loose(group: Group, names: Sequence[str | None], reached: Collection[int], parts: Parts) -> bool:
    """Whether a group is but a handwheel, lever or the like that sits on no valve, a leg or lug on no vessel, or a dial
    without a case that is not round: the nameplate of a pump.

    Args:
        group: connected parts.
        names: of each part, or the likeliest where only the group is known.
        reached: parts at which lines end.
        parts: of the scene.
    """
    if any(part in reached for part in group.parts):
        return False
    if group.unit_type == "tank":
        return all(names[part] in ON_VESSELS - {"nozzle"} for part in group.parts)
    if group.unit_type == "gauge":
        return all(names[part] in _DIALS and _is_oblong(parts, part) for part in group.parts)
    return group.unit_type == "valve" and _is_operator(group.parts, names)


def _is_oblong(parts: Parts, part: int) -> bool:
    """Whether a part is longer than wide."""
    long, wide, _ = parts.properties.obb_extents[part].tolist()
    return bool(long > _OBLONG * wide)


def _is_operator(parts: Collection[int], names: Sequence[str | None]) -> bool:
    """Whether parts are but what moves a valve: a handwheel, a lever, a stem."""
    return all(names[part] in OPERATORS for part in parts)


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
    _join_covers(work, piping)
    for _ in range(3):
        changed = _join_odd(work, piping)
        changed |= _join_pieces(work, piping)
        changed |= _join_fittings(work, piping)
        if not changed:
            break
    return sorted(
        (Group(work.types[k], tuple(sorted(parts))) for k, parts in work.parts.items()), key=lambda group: group.parts
    )


def _join_covers(work: _Work, piping: Piping) -> None:
    """Gives heads, nozzles and the like without a vessel to the one that they lie on, or in, untouched: the lid of a
    coarse tank, a nozzle that ends within the corners of its shell.
    """
    boxes = {k: box_around(piping.given.parts, work.parts[k]) for k, kind in work.types.items() if kind == "tank"}
    covers = [k for k in boxes if {piping.roles.names[part] for part in work.parts[k]} <= _OF_VESSELS]
    tanks = boxes.keys() - set(covers)
    for k in covers:
        homes = [home for home in tanks if _lies_on(boxes[k], boxes[home])]
        if len(homes) == 1:
            work.merge(homes[0], [k], None)


def _lies_on(box: tuple[Floats, Floats], other: tuple[Floats, Floats]) -> bool:
    """Whether a box lies within the outline of another one from some side, and in it or next to it."""
    shared = np.minimum(box[1], other[1]) - np.maximum(box[0], other[0])
    within = shared >= _WITHIN * (box[1] - box[0])
    return bool(within.sum() >= 2 and shared.min() >= -_NEXT_TO)


def _stands(parts: Collection[int], mounted: Mapping[int, Collection[int]], without: int = -1) -> bool:
    """Whether a line other than that of one part ends at some parts."""
    return any(line != without for part in parts for line in mounted.get(part, ()))


def _join_pieces(work: _Work, piping: Piping) -> bool:
    """Takes in the pieces in between, each after what the one before it changed."""
    near = piping.given.neighbors
    around = {part for parts in work.parts.values() for member in parts for part in near.get(member, ())}
    changed = False
    labels = piping.given.labels
    # What has no label is likelier a piece of theirs than what would have a wrong one.
    for piece in sorted(around - piping.apart, key=lambda part: (labels[part] is not None, part)):
        takers = _takers(work, piece, piping) if piece not in work.of_part else []
        if takers:
            work.merge(takers[0], takers[1:], piece)
            changed = True
    return changed


def _takers(work: _Work, piece: int, piping: Piping) -> list[int]:
    """The groups that a piece in between makes one, the one that stays first; none where it belongs to none.

    Such a piece is a fastener all of whose neighbours are one unit, or a disc all of whose are one gauge, the body
    around the disc of a valve, or it joins groups of which one at most is on a line.
    """
    touched = _touched(work, piping.given.neighbors[piece])
    if _is_dial(work, piece, piping):
        return touched
    for unit_type in sorted({work.types[k] for k in touched}):
        same = _of_types(work, touched, (unit_type,))
        standing = [k for k in same if _stands(work.parts[k], piping.mounted, piece)]
        others = sorted(set(same).difference(standing))
        between = len(same) > 1 >= len(standing) and _may_join(unit_type, piece, piping)
        if (between or _is_piece_of(work, piece, same, piping)) and _may_hold(work, piece, others, piping):
            return standing + others
    return []


def _is_piece_of(work: _Work, piece: int, groups: Sequence[int], piping: Piping) -> bool:
    """Whether a piece is clamped to the groups of a type that it touches and to nothing else, or is their body."""
    return _is_clamped(work, piece, piping) or _is_body_of(work, piece, groups, piping)


def _may_join(unit_type: str, piece: int, piping: Piping) -> bool:
    """Whether a piece may make one of two units of a type.

    Two cylinders in a bracket are two tanks, where somebody else than the labeler says that it is one.
    """
    label = piping.given.labels[piece]
    open_to_all = label is None or label.source == "geometry" or piping.roles.doubtful
    return open_to_all or unit_type != "tank"


def _is_body_of(work: _Work, piece: int, groups: Sequence[int], piping: Piping) -> bool:
    """Whether a piece without a line is the body around the disc of the only valve that it touches."""
    alone = len(groups) == 1 and work.types[groups[0]] == "valve" and piece not in piping.lines
    return alone and holds_disc(piping.given, piping.roles, piece)


def _touched(work: _Work, near: Sequence[int]) -> list[int]:
    """The groups of some parts, ascending."""
    return sorted({work.of_part[other] for other in near if other in work.of_part})


def _may_hold(work: _Work, piece: int, groups: Sequence[int], piping: Piping) -> bool:
    """Whether a piece may be one of groups that are on no line: a nipple between two valves is none of theirs, but what
    holds a mere operator is.
    """
    return piece not in piping.lines or all(_is_operator(work.parts[k], piping.roles.names) for k in groups)


def _is_dial(work: _Work, piece: int, piping: Piping) -> bool:
    """Whether a piece is a disc that the labeler took for a flange or the like, and touches but one gauge."""
    label = piping.given.labels[piece]
    if piece not in piping.lines or not is_disc(piping.lines[piece]) or label is None or label.source != "geometry":
        return False
    touched = _touched(work, piping.given.neighbors[piece])
    return _is_held_by_one(work, piece, piping) and work.types[touched[0]] == "gauge"


def _is_clamped(work: _Work, piece: int, piping: Piping) -> bool:
    """Whether a piece is a fastener all of whose neighbours are one group."""
    return piping.roles.names[piece] in _FASTENERS and _is_held_by_one(work, piece, piping)


def _is_held_by_one(work: _Work, piece: int, piping: Piping) -> bool:
    """Whether all neighbours of a piece are one group."""
    holders = {work.of_part.get(other, -1) for other in piping.given.neighbors[piece]}
    return len(holders) == 1 and -1 not in holders


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


def _join_fittings(work: _Work, piping: Piping) -> bool:
    """Gives nozzles and legs without a vessel, and motors without a pump, to the machine that they alone are on."""
    changed = False
    for k in sorted(work.parts):
        takers = _machines_at(work, k, piping) if k in work.parts else []
        if len(takers) == 1:
            work.merge(takers[0], [k], None)
            changed = True
    return changed


def _machines_at(work: _Work, k: int, piping: Piping) -> list[int]:
    """The machines at a group that is but what machines of several kinds have; none where it is more than that."""
    names = piping.roles.names
    own = {names[part] for part in work.parts[k]}
    if work.types[k] == "tank" and own <= ON_VESSELS:
        return _of_types(work, _near(work, k, piping), ("equipment", "pump"))
    if work.types[k] != "pump" or not own <= _DRIVES:
        return []
    driven = _of_types(work, _near(work, k, piping), ("equipment",))
    return [other for other in driven if not _DRIVEN.isdisjoint(names[part] for part in work.parts[other])]


def _near(work: _Work, k: int, piping: Piping) -> list[int]:
    """The other groups that a group touches, ascending."""
    near = [other for part in work.parts[k] for other in piping.given.neighbors.get(part, ())]
    return [other for other in _touched(work, near) if other != k]


def _of_types(work: _Work, groups: Sequence[int], types: Collection[str]) -> list[int]:
    """Those groups that are of some types."""
    return [k for k in groups if work.types[k] in types]


def _takers_of_odd(work: _Work, k: int, piece: int, piping: Piping) -> list[int]:
    """The groups that a single part is next to, if they are of one type and one of all these at most is on a line."""
    touched = _near(work, k, piping)
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
