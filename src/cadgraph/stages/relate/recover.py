"""Devices that labels missed: bodies at the ends of lines, told by how the lines meet there and by what is likely."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cadgraph.geometry.components import connected_sets
from cadgraph.stages.relate.attach import Attachments, Mount, attach_lines
from cadgraph.stages.relate.belief import Beliefs, beliefs_of
from cadgraph.stages.relate.evidence import Curve
from cadgraph.stages.relate.inline import recover_inline
from cadgraph.stages.relate.joint import Ends
from cadgraph.stages.relate.line import is_disc
from cadgraph.stages.relate.piping import FASTENERS, Group, Piping

__all__ = ["ARRANGEMENT", "FITTING", "LABELLED", "SIZE", "recover_units"]

FITTING = "fitting"
"""What only passes a line on, beside the types of units and ``nothing``."""
_NOTHING, _STEELWORK = "nothing", "steelwork"

# How the ends of lines meet a body, in log-odds for each type.
ARRANGEMENT: Mapping[str, Mapping[str, float]] = {
    "one": {"valve": -1.5, "gauge": 1.0, "pump": -3.0, "tank": 1.0, "equipment": 0.0, FITTING: -9.0},
    "aligned": {"valve": 2.0, "gauge": -0.5, "pump": -1.5, "tank": -3.0, "equipment": -1.0, FITTING: 0.0},
    "square": {"valve": -0.5, "gauge": -3.0, "pump": 2.5, "tank": -0.5, "equipment": 0.0, FITTING: -1.0},
    "two": {"valve": -2.0, "gauge": -3.0, "pump": 0.0, "tank": 1.0, "equipment": 1.0, FITTING: -1.0},
    "many": {"valve": -1.0, "gauge": -4.0, "pump": -2.0, "tank": 2.0, "equipment": 1.5, FITTING: -1.0},
}
"""The ends of lines at a body: one, two on one axis, two square to each other, two otherwise, three or more."""

SIZE: Mapping[str, Curve] = {
    "valve": Curve((0.5, 1.5, 6.0, 12.0, 25.0), (-2.0, 0.5, 0.5, -2.0, -5.0), "{:.1f} pipes long"),
    "gauge": Curve((1.0, 6.0, 12.0, 25.0), (0.0, 0.5, -1.0, -4.0), "{:.1f} pipes long"),
    "pump": Curve((2.0, 4.0, 8.0), (-3.0, 0.0, 1.0), "{:.1f} pipes long"),
    "tank": Curve((2.0, 5.0, 12.0), (-5.0, -1.0, 1.5), "{:.1f} pipes long"),
    "equipment": Curve((2.0, 5.0, 12.0), (-3.0, 0.0, 0.5), "{:.1f} pipes long"),
    FITTING: Curve((0.5, 2.0, 4.0, 8.0), (0.0, 0.5, -0.5, -3.0), "{:.1f} pipes long"),
}
"""The longest side of a body as diameters of the widest line at it, in log-odds for each type."""

LABELLED = Curve((-7.0, -2.3, 0.0), (-3.3, 0.0, 1.6), "labelled so by {:.1f} (logarithm)")
"""The logarithm of the labeler's mean probability of a type: it is often wrong about shapes that it hasn't learnt."""

# What touches parts of a unit that no line leads to is likely its body, and what touches another one a piece of it.
_BODY, _PIECE = 2.5, 1.5
_SURE = 0.6  # least probability of what is taken for a device
_LEAST = 1e-3  # no probability counts for less
# Two ends are aligned, or square, by the cosine between them, and on one axis within this share of the lesser radius.
_ALIGNED, _SQUARE, _ON_AXIS = 0.95, 0.35, 0.35
_LIKELY_OTHER = 0.5  # above this probability a part is of steelwork, a support or the like
_MOSTLY_NAMED = 0.5  # below this share of parts that only the labeler has named what has no name is no device
_STANDING = 0.5  # log-odds that what has the ends of lines at it carries them
_MOST = 40  # parts of a device that labels missed
_WIDEST_GAUGE = 0.4  # m
# Names of connectors that two ends on one axis of a body contradict: each would have a line of its own there.
_LEAST_PIPE = 0.3  # a line that the labeler finds less likely than this leads to two things at least, a disc sooner
_LEADS = 2
_LID = 4.0  # radii that a bonnet or a cover is long at most
_FEW = 3  # parts of a group that may be a piece of something else
_LIKELY = 0.7  # from this probability on something is taken for a line, or a piece of a unit, without more
_BENT = frozenset({"cross", "tee", "elbow", "pipe cap", "blind flange"})


@dataclass(frozen=True)
class _Body:
    """Parts at the ends of lines that may be a device.

    Args:
        parts: ascending.
        mounts: ends of lines at them.
        near: parts of units that they touch.
    """

    parts: tuple[int, ...]
    mounts: tuple[Mount, ...]
    near: tuple[int, ...]


def recover_units(piping: Piping) -> Piping:
    """Makes devices of bodies at the ends of lines that the labeler didn't know, where enough speaks for it.

    Only parts of which nobody but the labeler says what they are can change.

    Returns:
        The piping with further groups, and with bodies that only pass a line on among its lineless connectors.
    """
    given = piping.given
    beliefs = beliefs_of(given.labels, given.probabilities, given.vocabulary)
    piping = _without_stubs(_without_rings(piping, beliefs), beliefs)
    if not _is_named(beliefs):
        piping = recover_inline(piping, beliefs, LABELLED)
    ends, mounts = _loose_mounts(piping, _candidates(piping, beliefs))
    for body in _bodies(piping, beliefs, mounts, ends):
        piping = _taken(piping, body, *_type_of(piping, beliefs, body, ends))
    return piping


def _is_named(beliefs: Beliefs) -> bool:
    """Whether people have named most of the parts."""
    return int(beliefs.open.sum()) < _MOSTLY_NAMED * len(beliefs.open)


def _without_rings(piping: Piping, beliefs: Beliefs) -> Piping:
    """Takes away lines that only lead into each other: pieces of a volute, a coil, a handle."""
    found = piping.joints
    pairs = [(int(found.ends.part[f.first]), int(found.ends.part[f.second])) for f in found.facings]
    joined = {row for facing in found.facings for row in (facing.first, facing.second)}
    tapped = {tapped.part for tapped in found.taps if not tapped.tap.sleeve}
    rings = {
        part
        for ring in connected_sets(sorted(piping.lines), pairs)
        if all(beliefs.open[part] and part not in tapped for part in ring)
        and all(row in joined for part in ring for row in found.ends.of_part.get(part, ()))
        and any(found.ends.of_part.get(part) for part in ring)
        for part in ring
    }
    if not rings:
        return piping
    return replace(piping, lines={part: line for part, line in piping.lines.items() if part not in rings})


def _without_stubs(piping: Piping, beliefs: Beliefs) -> Piping:
    """Takes away lines that the labeler holds for something else and that don't run between two likely things."""
    likely, doubtful = _likely_solids(piping, beliefs), _doubtful_lines(piping, beliefs)
    while doubtful:
        joined = _joined_parts(piping.joints)
        leads = Counter(part for part, other in joined if other in likely or other in piping.lines)
        stubs = {part for part in doubtful if leads[part] < _LEADS}
        if not stubs:
            break
        piping = replace(piping, lines={part: line for part, line in piping.lines.items() if part not in stubs})
        doubtful -= stubs
    return piping


def _doubtful_lines(piping: Piping, beliefs: Beliefs) -> set[int]:
    """Lines that the labeler finds unlikely; discs sooner, for the line of one is soon found, but not those at the end
    of a run, which touch nothing but what they close.
    """
    connectors = beliefs.of_groups(piping.given.vocabulary.connector_groups)

    def least(part: int) -> float:
        amid = is_disc(piping.lines[part]) and len(piping.given.neighbors.get(part, ())) > 1
        return _LIKELY if amid else _LEAST_PIPE

    return {part for part in piping.lines if beliefs.open[part] and connectors[part] < least(part)}


def _likely_solids(piping: Piping, beliefs: Beliefs) -> set[int]:
    """Connectors without a line, and parts of units one of whose parts others call so or the labeler finds likely."""
    units = beliefs.of_groups(piping.given.vocabulary.unit_of_group.keys())
    likely = set(piping.lineless)
    for group in piping.groups:
        if any(not beliefs.open[part] or units[part] >= _LIKELY for part in group.parts):
            likely.update(group.parts)
    return likely


def _joined_parts(found: Attachments) -> Iterator[tuple[int, int]]:
    """For each joint of a line the part that carries it and the other one; a part in a sleeve leads nowhere."""
    for row, offer in found.made.items():
        part = int(found.ends.part[row])
        if offer.kind in ("face", "corner"):
            yield part, int(found.ends.part[offer.other if offer.row == row else offer.row])
        elif offer.kind != "sleeve":
            yield part, offer.other
            if offer.kind == "tap":
                yield offer.other, part


def _candidates(piping: Piping, beliefs: Beliefs) -> frozenset[int]:
    """Parts of no line and no unit that nobody but the labeler has named, fasteners and the ground left out."""
    given = piping.given
    fasteners = beliefs.of_groups(given.vocabulary.groups, _all_names(beliefs) - FASTENERS)
    shut = piping.members.union(piping.lines, piping.jackets)
    return frozenset(
        part
        for part in range(given.parts.n_parts)
        if beliefs.open[part]
        and part not in shut
        and not given.parts.ground[part]
        and fasteners[part] < _LIKELY_OTHER
        and given.cluster[part] >= 0
    )


def _all_names(beliefs: Beliefs) -> frozenset[str | None]:
    return frozenset(name for _, name in beliefs.classes)


def _loose_mounts(piping: Piping, candidates: Collection[int]) -> tuple[Ends, list[Mount]]:
    """The candidates at ends that join nothing else."""
    given, known = piping.given, piping.joints
    free = {
        row
        for row in range(len(known.ends.part))
        if row not in known.made or (known.made[row].kind == "mount" and known.made[row].other in candidates)
    } - {row for row, _ in known.doubled}
    if not free or not candidates:
        return known.ends, []
    solids = piping.members.union(piping.lineless, candidates)
    found = attach_lines(
        given.parts, given.contacts, piping.lines, solids, piping.feet, given.config.relate.bridge, piping.bolted
    )
    return found.ends, [mount for mount in found.mounts if mount.row in free and mount.part in candidates]


def _weak_members(piping: Piping, beliefs: Beliefs) -> frozenset[int]:
    """Parts of small groups that no line leads to and of which the labeler is not sure: pieces of others, maybe."""
    weak: set[int] = set()
    for group in piping.groups:
        likely = beliefs.of_groups(_groups_of(piping, group.unit_type))[list(group.parts)]
        doubted = bool((likely < _LIKELY).all()) and bool(beliefs.open[list(group.parts)].all())
        if doubted and len(group.parts) <= _FEW and not piping.mounted.keys() & set(group.parts):
            weak.update(group.parts)
    return frozenset(weak)


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
    lids = set()
    for mount in mounts:
        part = int(ends.part[mount.row])
        line = piping.lines[part]
        short = line.length <= _LID * float(line.branches[0].radius.max())
        passes = any(_arrangement(ends, [mount.row, row]) == "aligned" for row in rows[mount.part] if row != mount.row)
        if short and not passes and beliefs.open[part] and busy[part] == 1 and part not in tapped:
            lids.add(part)
    return lids


def _bodies(piping: Piping, beliefs: Beliefs, mounts: Sequence[Mount], ends: Ends) -> list[_Body]:
    """The parts at ends, with what else there is of each body."""
    given = piping.given
    others = beliefs.of_groups(_other_groups(piping))
    seeds = {mount.part for mount in mounts}
    pool = {part for part in _candidates(piping, beliefs) if others[part] < _LIKELY_OTHER}
    pool |= _weak_members(piping, beliefs)
    beside = {side.solid for side in piping.joints.sides}
    # What hangs on the side of a line holds it.
    pool -= {part for part in pool if part not in seeds and part in beside}
    pairs = [(a, b) for a, b in given.contacts.pairs.tolist() if a in pool and b in pool]
    lids = _lids(piping, beliefs, mounts, ends)
    bodies = []
    for parts in connected_sets(sorted(pool), pairs):
        at = [mount for mount in mounts if mount.part in parts]
        closing = {int(ends.part[mount.row]) for mount in at} & lids
        held = tuple(mount for mount in at if int(ends.part[mount.row]) not in closing)
        parts = tuple(sorted(closing.union(parts)))
        if not held or len(parts) > _MOST:
            continue
        near = {o for part in parts for o in given.neighbors.get(part, ()) if o in piping.members - pool}
        bodies.append(_Body(tuple(parts), held, tuple(sorted(near))))
    return bodies


def _other_groups(piping: Piping) -> frozenset[str]:
    """The groups that are neither of lines nor of units."""
    vocabulary = piping.given.vocabulary
    return frozenset(vocabulary.groups.keys() - vocabulary.connector_groups - vocabulary.unit_of_group.keys())


def _type_of(piping: Piping, beliefs: Beliefs, body: _Body, ends: Ends) -> tuple[str, float]:
    """What a body is: a type of unit, a fitting, or nothing that enough speaks for; and how sure that is."""
    weights = {name: float(np.exp(value)) for name, value in _odds(piping, beliefs, body, ends).items()}
    best = max(weights, key=lambda name: (weights[name], name))
    share = weights[best] / sum(weights.values())
    if share < _SURE or best in (_NOTHING, _STEELWORK):
        return _NOTHING, share
    if _is_named(beliefs) and not _touched(piping, body, best):
        # Where people have named nearly everything, what they left without a name is no device of theirs; a line that
        # ends on both sides of it passes through all the same.
        passes = _arrangement(ends, [mount.row for mount in body.mounts]) == "aligned"
        return (FITTING if passes else _NOTHING), share
    return best, share


def _odds(piping: Piping, beliefs: Beliefs, body: _Body, ends: Ends) -> dict[str, float]:
    """The log-odds of everything that a body may be."""
    rows = [mount.row for mount in body.mounts]
    longest = _longest(piping, body.parts)
    length = longest / (2 * float(ends.radius[rows].max()))

    def labelled(groups: Collection[str]) -> float:
        said = float(beliefs.of_groups(groups, _BENT)[list(body.parts)].mean())
        return float(LABELLED(np.log(max(said, _LEAST))))

    odds = {_NOTHING: 0.0, _STEELWORK: _STANDING + labelled(_other_groups(piping))}
    for unit_type, effect in ARRANGEMENT[_arrangement(ends, rows)].items():
        groups = _groups_of(piping, unit_type)
        if groups and (unit_type != "gauge" or longest <= _WIDEST_GAUGE):
            odds[unit_type] = effect + float(SIZE[unit_type](length)) + labelled(groups)
            odds[unit_type] += _support(piping, _touched(piping, body, unit_type))
    return odds


def _support(piping: Piping, touched: Sequence[Group]) -> float:
    """What it adds that a body touches units of a type."""
    if not touched:
        return 0.0
    return _PIECE if any(piping.mounted.keys() & set(group.parts) for group in touched) else _BODY


def _touched(piping: Piping, body: _Body, unit_type: str) -> list[Group]:
    """The groups of a type that a body touches."""
    return [
        group for group in piping.groups if group.unit_type == unit_type and not set(body.near).isdisjoint(group.parts)
    ]


def _groups_of(piping: Piping, unit_type: str) -> list[str]:
    """The groups of the vocabulary that a type stands for."""
    vocabulary = piping.given.vocabulary
    if unit_type == FITTING:
        return sorted(vocabulary.connector_groups)
    return sorted(group for group, unit in vocabulary.unit_of_group.items() if unit == unit_type)


def _longest(piping: Piping, parts: Sequence[int]) -> float:
    """The longest side of the box around some parts [m]."""
    boxes = piping.given.parts.properties.aabb[list(parts)]
    return float((boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0)).max())


def _arrangement(ends: Ends, rows: Sequence[int]) -> str:
    """How the ends of lines meet a body."""
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


def _taken(piping: Piping, body: _Body, kind: str, sure: float) -> Piping:
    """The piping with a body as what it is."""
    inside = set(body.parts)
    seeds = {mount.part for mount in body.mounts}
    if kind == _NOTHING:
        return piping
    if kind == FITTING:
        return replace(
            piping,
            lineless=tuple(sorted(seeds.union(piping.lineless))),
            recovered={**piping.recovered, **dict.fromkeys(seeds, sure)},
        )
    joined = _touched(piping, body, kind)
    parts = inside.union(*(group.parts for group in joined))
    groups = [group for group in piping.groups if group not in joined and inside.isdisjoint(group.parts)]
    return replace(
        piping,
        lines={part: line for part, line in piping.lines.items() if part not in inside},
        lineless=tuple(part for part in piping.lineless if part not in inside),
        groups=(*groups, Group(kind, tuple(sorted(parts)))),
        members=piping.members | inside,
        feet=piping.feet | inside if kind == "gauge" else piping.feet,
        recovered={**piping.recovered, **dict.fromkeys(body.parts, sure)},
    )
