"""Groups of parts cut where two devices meet: each body with an operator of its own, or with two open ends."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from cadgraph.geometry.components import connected_sets
from cadgraph.model.parts import Parts
from cadgraph.model.vocabulary import OPERATORS
from cadgraph.stages.relate.attach import Attachments, flat_contacts
from cadgraph.stages.relate.body import arrangement_of
from cadgraph.stages.relate.flanged import bodies_between
from cadgraph.stages.relate.joint import Ends, extent_about
from cadgraph.stages.relate.piping import Group, Piping

__all__ = ["split_groups"]

# A body stands out from the line's axis this many times farther on one side than on the other where it carries its own
# operator: one mesh for a whole valve.
_LOPSIDED = 1.5
# What no name calls a piece of a device is a whole one from so many pipe diameters on: the caps of a three-piece valve
# are shorter.
_WHOLE = 1.2
_BODY = "valve body"
_STRAIGHT = 0.99  # cosine between the directions of the two ends of a straight piece
_BONNET = "valve bonnet"
_ITS_OWN = frozenset({"handwheel", "lever", "actuator", "gearbox", _BONNET})  # what turns or covers one valve
_CASES = frozenset({"gauge", "gauge case", "gauge face"})
_SPLIT = frozenset({"valve", "pump", "gauge"})


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
        outcome += _split(piping, group, {part: mounts[part] for part in group.parts if part in mounts})
    return sorted(outcome, key=lambda group: group.parts)


def _split(piping: Piping, group: Group, own: Mapping[int, Sequence[int]]) -> list[Group]:
    """The devices of a group, by its parts at which lines end: itself unless it may hold several, and does."""
    beyond = _beyond(piping, group)
    gauges = _by_stems(piping, group, beyond) if group.unit_type == "gauge" else []
    if gauges:
        return gauges
    named = _named(piping, group, own)
    if group.unit_type not in _SPLIT or not own or len(own.keys() | {a for a, _ in beyond} | named) < 2:
        return [group]
    cores = sorted(named.union(_cores(piping, group, own, beyond)))
    found = _by_cores(piping, group, own, cores)
    return [piece for some in found for piece in _cut_at_nipples(piping, some, own)]


def _by_cores(piping: Piping, group: Group, own: Mapping[int, Sequence[int]], cores: Sequence[int]) -> Sequence[Group]:
    """A group by the bodies in it that are devices of their own, one of which may have halves of another beside it."""
    if len(cores) > 1:
        return _divide(piping, group, cores)
    halves = _halves_beside(piping, cores[0], own) if cores else ()
    if not halves:
        return [group]
    alone, *rest = _divide(piping, group, [*cores, *halves])
    return [alone, replace(group, parts=tuple(sorted(part for half in rest for part in half.parts)))]


@dataclass(frozen=True)
class _Bodies:
    """The parts of a group that stand in a line.

    Args:
        own: rows of the ends of lines at each part that has any.
        rows: of each body an end on its axis or more, its own where it has any.
        flanged: how many bodies and parts of other units each is flanged to.
        holders: bodies that alone carry an operator.
    """

    own: Mapping[int, Sequence[int]]
    rows: Mapping[int, Sequence[int]]
    flanged: Mapping[int, int]
    holders: Collection[int]

    def count_open(self, body: int) -> int:
        """How many lines and others a body leads to."""
        return len(self.own.get(body, ())) + self.flanged.get(body, 0)


def _cores(
    piping: Piping, group: Group, own: Mapping[int, Sequence[int]], beyond: Sequence[tuple[int, int]]
) -> list[int]:
    """The bodies that are devices of their own.

    Args:
        piping: what joins what.
        group: connected parts.
        own: rows of the ends of lines at each of these parts.
        beyond: its parts and those of other units that are near each other.
    """
    bodies = _bodies_of(piping, group, own, beyond)
    cores = [body for body in sorted(bodies.rows) if _is_core(piping, bodies, body)]
    return cores if cores or group.unit_type != "gauge" else _feet(group, own, bodies.holders)


def _bodies_of(
    piping: Piping, group: Group, own: Mapping[int, Sequence[int]], beyond: Sequence[tuple[int, int]]
) -> _Bodies:
    """What stands in a line: where one ends, and what is flanged to it between."""
    given, found = piping.given, piping.joints
    pairs = _pairs_within(group.parts, given.neighbors)
    others = {b for _, b in beyond}
    near = [*pairs, *((min(pair), max(pair)) for pair in beyond)]
    flat = flat_contacts(given.parts, given.contacts, near, given.config.cluster.eps)
    rows = {**{part: [row] for part, row in bodies_between(found.ends, own, flat, others).items()}, **own}
    flanged = Counter(part for pair in flat if others.union(rows).issuperset(pair) for part in pair)
    return _Bodies(own, rows, flanged, _holders(given.parts, pairs, rows, found))


def _is_core(piping: Piping, bodies: _Bodies, body: int) -> bool:
    """Whether a body leads to two others at least, and is a device of its own."""
    if bodies.count_open(body) < 2:
        return False
    passes = len(bodies.own.get(body, ())) >= 2
    return passes or body in bodies.holders or _is_complete(piping, body, bodies.rows[body])


def _is_complete(piping: Piping, body: int, rows: Sequence[int]) -> bool:
    """Whether a body by itself is a whole device in one mesh."""
    return _is_whole(piping, body, rows[0]) or _stands_out(piping.given.parts, body, rows, piping.joints)


def _is_whole(piping: Piping, body: int, row: int) -> bool:
    """Whether a body is longer along its line than a piece of a device is; where it is called a valve's body, longer
    than wide, too, as the cap of a body in halves never is.
    """
    group = piping.roles.groups[body]
    if group is None:
        return False
    ends = piping.joints.ends
    along, reach = extent_about(ends, row, piping.given.parts.scene.mesh(body)[0])
    name = piping.roles.names[body]
    may_be = name in (None, piping.given.vocabulary.groups[group].names[0]) or (name == _BODY and along >= 2 * reach)
    return may_be and along >= _WHOLE * 2 * float(ends.radius[row])


def _named(piping: Piping, group: Group, own: Mapping[int, Sequence[int]]) -> set[int]:
    """The parts that are devices of their own by their names, where there are several such."""
    found = (_surely_whole(piping, group, own), _turned(piping, group, own))
    return {part for some in found if len(some) > 1 for part in some}


def _surely_whole(piping: Piping, group: Group, own: Mapping[int, Sequence[int]]) -> set[int]:
    """The parts of a valve or pump that others, or the labeler for sure, call by the name of the whole: each is one.

    None where others are called its pieces, but for what moves a valve; a whole at which no line ends is screwed into
    another one, and between two it is a piece.
    """
    whole, near = {"valve", "pump"}.intersection([group.unit_type]), set(group.parts)
    found = {part for part in group.parts if _is_called(piping, part, whole)}
    rest = {piping.roles.names[part] for part in near - found}
    if not rest <= OPERATORS - {"valve stem"}:
        return set()
    return {part for part in found if part in own or len(near.intersection(piping.given.neighbors.get(part, ()))) == 1}


def _is_called(piping: Piping, part: int, names: Collection[str]) -> bool:
    """Whether others call a part by one of some names, or the labeler does for sure."""
    label = piping.given.labels[part]
    return label is not None and label.name in names and not label.likely


def _turned(piping: Piping, group: Group, own: Mapping[int, Sequence[int]]) -> set[int]:
    """The parts called a valve's body that are the nearest to what turns or covers a valve, by contacts, and what lines
    end at and is called a valve beside such: each is one.

    What hangs together is of one of them: a gearbox with its wheel, a bonnet with its stem.
    """
    # Where labels are wrong at random a bolt may be called so.
    whole = set() if piping.roles.doubtful else {part for part in own if _is_called(piping, part, {"valve"})}
    bodies = [part for part in group.parts if part in whole or piping.roles.names[part] == _BODY]
    found = _bodies_turned(piping, group, bodies) if len(bodies) > 1 else set()
    # Between the caps of a three-piece valve no line ends at what is turned, whatever they are called.
    turned = found - whole
    return found | whole if turned and turned <= own.keys() else found


def _bodies_turned(piping: Piping, group: Group, bodies: Sequence[int]) -> set[int]:
    """Those of some bodies of a group that are the nearest to what turns or covers a valve."""
    names, near = piping.roles.names, piping.given.neighbors
    steps = _steps_from(bodies, group, near)
    moving = [part for part in group.parts if names[part] in OPERATORS or names[part] == _BONNET]
    found: set[int] = set()
    for some in connected_sets(moving, _pairs_within(moving, near)):
        if not _ITS_OWN.isdisjoint([names[part] for part in some]):
            found.update(_nearest(some, steps, len(group.parts)))
    return found


def _steps_from(cores: Sequence[int], group: Group, near: Mapping[int, Sequence[int]]) -> dict[int, dict[int, int]]:
    """Contacts from each of some cores of a group to each part, not through the other cores."""
    inside = set(group.parts)
    return {core: _steps(core, inside, near, set(cores) - {core}) for core in cores}


def _nearest(some: Sequence[int], steps: Mapping[int, Mapping[int, int]], most: int) -> list[int]:
    """The one of several bodies that is the fewest contacts away from some parts; none where two are as near."""
    away = {body: min(far.get(part, most) for part in some) for body, far in steps.items()}
    least = min(away.values())
    nearest = [body for body, contacts in away.items() if contacts == least]
    return nearest if len(nearest) == 1 else []


def _halves_beside(piping: Piping, core: int, own: Mapping[int, Sequence[int]]) -> tuple[int, ...]:
    """The two halves of a device that lines pass through beside the only core of a group, which has a line of its own:
    its lever reaches to the needle valve that stands next to it.
    """
    ends, at = piping.joints.ends, own.get(core, ())
    rows = [(part, row) for part, held in sorted(own.items()) for row in held if part != core]
    for (part, row), (other, far) in combinations(rows, 2) if at else ():
        passed = part != other and arrangement_of(ends, [row, far]) == "aligned"
        if passed and not any(_on_axis(ends, row, mine) for mine in at):
            return part, other
    return ()


def _on_axis(ends: Ends, row: int, other: int) -> bool:
    """Whether an end lies on the axis of another one."""
    return extent_about(ends, row, ends.point[[other]])[1] <= float(ends.radius[row])


def _by_stems(piping: Piping, group: Group, beyond: Sequence[tuple[int, int]]) -> list[Group]:
    """The gauges of a group that stand so close that their cases touch: each has a case, and a stem that is screwed in.

    Empty where the group is one gauge.
    """
    names = piping.roles.names
    stems = sorted({part for part, _ in beyond if names[part] == "gauge stem"})
    pieces = _divide(piping, group, stems) if len(stems) > 1 else []
    return pieces if all(any(names[part] in _CASES for part in piece.parts) for piece in pieces) else []


def _feet(group: Group, bodies: Collection[int], holders: Collection[int]) -> list[int]:
    """The feet of gauges: each has one, so that two feet are two gauges."""
    return [body for body in bodies if body in holders or len(group.parts) == len(bodies)]


def _cut_at_nipples(piping: Piping, group: Group, own: Mapping[int, Sequence[int]]) -> list[Group]:
    """A group cut where a straight piece of line ends at one body of it on the one side and at another on the other.

    Its devices touch beside that piece: a lever reaches to the next one. Each side must be a device without it: lead to
    another line, or be whole by itself.
    """
    for rows in _straight_between(piping.joints, group, own) if group.unit_type in _SPLIT else ():
        sides = _divide(piping, group, [part for part in group.parts if not rows.isdisjoint(own.get(part, ()))])
        if all(_is_device(piping, side, own, rows) for side in sides):
            return [piece for side in sides for piece in _cut_at_nipples(piping, side, own)]
    return [group]


def _is_device(piping: Piping, group: Group, own: Mapping[int, Sequence[int]], besides: frozenset[int]) -> bool:
    """Whether parts lead to other lines than those of some ends, or hold a body at one of these that is whole."""
    rows = {row: part for part in group.parts for row in own.get(part, ())}
    return not besides.issuperset(rows) or any(_is_complete(piping, part, own[part]) for part in rows.values())


def _straight_between(found: Attachments, group: Group, own: Mapping[int, Sequence[int]]) -> list[frozenset[int]]:
    """The two ends of each straight piece of line between two bodies of a group."""
    ends = found.ends
    at = {row: part for part in group.parts for row in own.get(part, ())}
    pairs = [
        (row, other)
        for row in at
        for other in ends.of_part[int(ends.part[row])]
        if row < other and other in at and at[other] != at[row]
    ]
    return [frozenset(pair) for pair in pairs if np.dot(*ends.direction[list(pair)]) <= -_STRAIGHT]


def _pairs_within(parts: Sequence[int], near: Mapping[int, Sequence[int]]) -> list[tuple[int, int]]:
    """The pairs of some parts that are near each other, first < second."""
    inside = set(parts)
    return [(a, b) for a in parts for b in near.get(a, ()) if a < b and b in inside]


def _beyond(piping: Piping, group: Group) -> list[tuple[int, int]]:
    """The parts of a group and those of other units, or fittings without a line, that are near each other, its own
    first.
    """
    near, inside = piping.given.neighbors, set(group.parts)
    return [(a, b) for a in group.parts for b in near.get(a, ()) if b in piping.solids and b not in inside]


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
    return extent_about(found.ends, rows[0], parts.scene.mesh(part)[0])[1]


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
    """Gives each part to the core that is the fewest contacts away, of two the one that is nearer; a group for each
    core, in their order.
    """
    centers = piping.given.parts.properties.obb_center
    steps = _steps_from(cores, group, piping.given.neighbors)
    members: dict[int, list[int]] = {core: [] for core in cores}
    for part in group.parts:
        ranked = sorted(
            (steps[core].get(part, len(group.parts)), float(np.linalg.norm(centers[part] - centers[core])), core)
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
