"""Devices that labels missed: bodies at the ends of lines, told by how the lines meet there and by what is likely."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cadgraph.stages.relate.attach import flat_contacts
from cadgraph.stages.relate.belief import LEAST, Beliefs, beliefs_of
from cadgraph.stages.relate.body import (
    Arrangement,
    Body,
    arrangement_of,
    find_bodies,
    other_groups,
    unclaimed_parts,
)
from cadgraph.stages.relate.body_shape import box_around
from cadgraph.stages.relate.evidence import Curve, Term, tell_terms
from cadgraph.stages.relate.flanged import heads_for
from cadgraph.stages.relate.foot import take_feet
from cadgraph.stages.relate.inline import pipe_radius, recover_inline
from cadgraph.stages.relate.instrument import take_instruments
from cadgraph.stages.relate.joint import Ends, extent_about
from cadgraph.stages.relate.meter import take_meters
from cadgraph.stages.relate.piping import Group, Piping, Recovered
from cadgraph.stages.relate.prune import prune_lines

__all__ = ["ARRANGEMENT", "FITTING", "LABELLED", "SIZE", "SLIM", "recover_units"]

FITTING = "fitting"
"""What only passes a line on, beside the types of units and ``nothing``."""
_NOTHING, _STEELWORK = "nothing", "steelwork"

# How the ends of lines meet a body, in log-odds for each type.
ARRANGEMENT: Mapping[str, Mapping[str, float]] = {
    "one": {"valve": -1.0, "gauge": 1.5, "pump": -3.0, "tank": 1.0, "equipment": 0.0, FITTING: -9.0},
    "aligned": {"valve": 2.0, "gauge": 1.0, "pump": -1.5, "tank": -3.0, "equipment": -1.0, FITTING: 0.0},
    "square": {"valve": -0.5, "gauge": -3.0, "pump": 2.5, "tank": -0.5, "equipment": 0.0, FITTING: -1.0},
    "two": {"valve": -2.0, "gauge": -3.0, "pump": 0.0, "tank": 1.0, "equipment": 1.0, FITTING: -1.0},
    "many": {"valve": -1.0, "gauge": -4.0, "pump": -2.0, "tank": 2.0, "equipment": 1.5, FITTING: -1.0},
}
"""The ends of lines at a body: one, two on one axis, two square to each other, two otherwise, three or more."""

SIZE: Mapping[str, Curve] = {
    "valve": Curve((0.5, 1.5, 6.0, 12.0, 25.0), (-2.0, 0.5, 0.5, -2.0, -5.0), "it is {:.1f} pipe diameters long"),
    "gauge": Curve((1.0, 6.0, 12.0, 25.0), (0.0, 0.5, -1.0, -4.0), "it is {:.1f} pipe diameters long"),
    "pump": Curve((2.0, 4.0, 8.0), (-3.0, 0.0, 1.0), "it is {:.1f} pipe diameters long"),
    "tank": Curve((2.0, 5.0, 12.0), (-5.0, -1.0, 1.5), "it is {:.1f} pipe diameters long"),
    "equipment": Curve((2.0, 5.0, 12.0), (-3.0, 0.0, 0.5), "it is {:.1f} pipe diameters long"),
    FITTING: Curve((0.5, 2.0, 4.0, 8.0), (0.0, 0.5, -0.5, -3.0), "it is {:.1f} pipe diameters long"),
}
"""The longest side of a body as diameters of the widest line at it, in log-odds for each type."""

SLIM = Curve((1.1, 1.25), (3.0, 0.0), "it is {:.2f} times as wide as its pipe")
"""How far a body on one axis with both ends reaches from it, as share of the pipe's radius: what is no wider is a piece
of pipe. It adds to a fitting, and is taken from everything else."""

LID = 12.0
"""What it adds to a fitting that all there is at the end of a line is a disc as wide as that end: a lid on a flange."""

LABELLED = Curve((-7.0, -2.3, 0.0), (-3.3, 0.0, 2.3), "labelled so by {:.1f} (logarithm)")
"""The logarithm of the labeler's mean probability of a type: it is often wrong about shapes that it hasn't learnt."""

_ENDS: Mapping[str, str] = {
    "one": "one line ends at it",
    "aligned": "two lines end at it on one axis",
    "square": "two lines end at it square to each other",
    "two": "two lines end at it",
    "many": "several lines end at it",
}

# What touches parts of a unit that no line leads to is likely its body, what touches a motor without a pump still
# likelier, and what touches another one a piece of it.
_BODY, _DRIVEN, _PIECE = 2.5, 4.0, 1.5
_MOTOR = frozenset({"motor", "motor fan cover", "coupling guard"})
# Least probability of what is taken for a device, and of a device that the labeler finds likely to be another one, at
# least so likely.
_SURE, _OTHER, _LIKELY = 0.6, 0.8, 0.5
_SOME_DEVICE = 0.9  # least probability that an unnamed body is a device, whichever
_ROOT = 0.3  # how likely a body that a gauge is screwed into must be a device of its own
_FAR = 8.0  # a unit that is so many times likelier itself than a piece of a body stays apart from it
_APART = 2.0  # what is so many times likelier something else is no piece of the unit that it is flanged to
_MOSTLY_NAMED = 0.5  # below this share of parts that only the labeler has named what has no name is no device
_STANDING = 0.5  # log-odds that what has the ends of lines at it carries them
_WIDEST_GAUGE = 0.4  # m
_FLAT, _AS_WIDE = 0.6, 0.85  # a lid's thickness as share of its radius, and its radius as share of the end's
# Names of connectors that two ends on one axis of a body contradict: each would have a line of its own there.
_BENT = frozenset({"cross", "tee", "elbow", "pipe cap", "blind flange"})


def recover_units(piping: Piping) -> Piping:
    """Makes devices of bodies at the ends of lines that the labeler didn't know, where enough speaks for it.

    Only parts of which nobody but the labeler says what they are can change.

    Returns:
        The piping with further groups, and with bodies that only pass a line on among its lineless connectors.
    """
    given = piping.given
    beliefs = beliefs_of(given.labels, given.probabilities, given.vocabulary)
    piping = prune_lines(piping, beliefs)
    if not _is_named(beliefs):
        piping = recover_inline(piping, beliefs, LABELLED)
    ends, bodies = find_bodies(piping, beliefs)
    mounted = frozenset(piping.mounted)
    # Rows of ends hold for the piping that they were found in: all is looked at before anything changes.
    sights = [_look_at(piping, beliefs, body, ends, mounted) for body in bodies]
    sights = [_with_others_apart(piping, beliefs, sight, ends) for sight in sights]
    for sight in sights:
        piping = _taken(piping, sight.body, *_type_of(piping, beliefs, sight))
    piping = take_feet(take_meters(piping, beliefs), beliefs)
    if _is_named(beliefs):
        return piping
    ended = {mount.part for body in bodies for mount in body.mounts}
    return take_instruments(piping, beliefs, unclaimed_parts(piping, beliefs) - ended)


def _is_named(beliefs: Beliefs) -> bool:
    """Whether people have named most of the parts."""
    return int(beliefs.open.sum()) < _MOSTLY_NAMED * len(beliefs.open)


@dataclass(frozen=True)
class _Sight:
    """What is to be seen of a body.

    Args:
        body: its parts and the ends at them.
        arrangement: of these ends.
        length: its longest side [m].
        pipes: the same as diameters of the widest line at it.
        slim: its reach from the axis as share of the pipe's radius; None where no pipe tells.
        closes: whether it is a disc on a single end, and as wide.
        apart: type of the unit that it is flanged to beyond the only end, where it is far likelier something else than
            a piece of that; else None.
        mounted: parts at which lines end.
    """

    body: Body
    arrangement: Arrangement
    length: float
    pipes: float
    slim: float | None
    closes: bool
    apart: str | None
    mounted: Collection[int]


def _look_at(piping: Piping, beliefs: Beliefs, body: Body, ends: Ends, mounted: Collection[int]) -> _Sight:
    rows = [mount.row for mount in body.mounts]
    length = _longest(piping, body.parts)
    behind, rather = _behind(piping, beliefs, body, ends, rows[0]) if len(rows) == 1 else (None, 0.0)
    return _Sight(
        body=body,
        arrangement="aligned" if rather > 1.0 else arrangement_of(ends, rows),
        length=length,
        pipes=length / (2 * float(ends.radius[rows].max())),
        slim=_slimness(piping, body, ends, rows),
        closes=_is_lid(piping, body, ends, rows),
        apart=behind if rather >= _APART else None,
        mounted=mounted,
    )


def _with_others_apart(piping: Piping, beliefs: Beliefs, sight: _Sight, ends: Ends) -> _Sight:
    """A body without those units in it that are far likelier themselves than pieces of it: the gauge on a boiler."""
    body = sight.body
    kind, _ = _type_of(piping, beliefs, sight)
    groups = (piping.owner.get(part) for part in body.parts)
    held = {group for group in groups if group is not None and group.unit_type != kind}
    apart = {group for group in held if _is_far_likelier(piping, beliefs, group, _groups_of(piping, kind))}
    less = _without(piping, body, apart)
    return _look_at(piping, beliefs, less, ends, sight.mounted) if apart and less.parts and less.mounts else sight


def _without(piping: Piping, body: Body, units: Collection[Group]) -> Body:
    """A body without some units in it, which it touches then."""
    gone, types = {part for group in units for part in group.parts}, {group.unit_type for group in units}
    rest = tuple(sorted(set(body.parts) - gone))
    near = gone.intersection(other for part in rest for other in piping.given.neighbors.get(part, ()))
    mounts = tuple(mount for mount in body.mounts if mount.part not in gone)
    return Body(rest, mounts, tuple(sorted(near.union(body.near))), None if body.unit_type in types else body.unit_type)


def _is_far_likelier(piping: Piping, beliefs: Beliefs, group: Group, other: Collection[str]) -> bool:
    """Whether a unit is likely, and many times likelier than that it is of some other groups; not if there are none."""
    if not other:
        return False
    parts = list(group.parts)
    said = float(beliefs.of_groups(_groups_of(piping, group.unit_type))[parts].mean())
    return said >= _LIKELY and said >= _FAR * float(beliefs.of_groups(other)[parts].mean())


def _behind(piping: Piping, beliefs: Beliefs, body: Body, ends: Ends, row: int) -> tuple[str | None, float]:
    """The type of the unit that a body is flanged to on the axis of the line that ends at it, and how much likelier
    than another piece of that unit the body is something else: a valve at a pump, of which nobody is sure.
    """
    flanged = set(_flanged_to(piping, body, ends, row))
    # A gauge is screwed into its root valve, which is no flange.
    met = flanged or {group.unit_type for group in _touched(piping, body, "gauge")}
    if len(met) != 1:
        return None, 0.0
    (behind,) = met
    said = {
        kind: float(beliefs.of_groups(_groups_of(piping, kind))[list(body.parts)].mean())
        for kind in sorted(set(piping.given.vocabulary.unit_of_group.values()))
    }
    likeliest = max((share for kind, share in said.items() if kind != behind), default=0.0)
    if not flanged and likeliest < _ROOT:
        return None, 0.0
    return behind, likeliest / max(said[behind], LEAST)


def _flanged_to(piping: Piping, body: Body, ends: Ends, row: int) -> Iterator[str]:
    """The types of the units that a body is flanged to on the axis of an end, on its other side."""
    given = piping.given
    owner = {part: piping.owner[part].unit_type for part in body.near if part in piping.owner}
    pairs = [(min(a, b), max(a, b)) for a in body.parts for b in owner]
    for (a, b), (middle, normal) in flat_contacts(given.parts, given.contacts, pairs, given.config.cluster.eps).items():
        if heads_for(ends, row, middle, normal):
            yield owner.get(a) or owner[b]


def _type_of(piping: Piping, beliefs: Beliefs, sight: _Sight) -> tuple[str, Recovered]:
    """What a body is: a type of unit, a fitting, or nothing that enough speaks for; how sure that is, and why."""
    terms = _terms(piping, beliefs, sight)
    weights = {name: float(np.exp(sum(odds for _, odds in said))) for name, said in terms.items()}
    best = max(weights, key=lambda name: (weights[name], name))
    share = weights[best] / sum(weights.values())
    found = Recovered(share, tell_terms(terms[best]))
    body = sight.body
    unsure = share < _least(piping, beliefs, body) and not _is_some_device(sight, weights, best)
    if unsure or best in (_NOTHING, _STEELWORK, body.unit_type):
        return _NOTHING, found
    if _is_named(beliefs) and not _touched(piping, body, best):
        # Where people have named nearly everything, what they left without a name is no device of theirs; a line that
        # ends on both sides of it passes through all the same.
        return (FITTING if sight.arrangement == "aligned" else _NOTHING), found
    return best, found


def _is_some_device(sight: _Sight, weights: Mapping[str, float], best: str) -> bool:
    """Whether it is as good as sure that a body that nobody has named is a device, whichever: a tank or a boiler. What
    may be no valve is none, for valves are what people rely on to close a line.
    """
    others = sum(weights.get(name, 0.0) for name in (_NOTHING, _STEELWORK, FITTING))
    known = sight.body.unit_type is not None or best == "valve"
    return not known and others <= (1 - _SOME_DEVICE) * sum(weights.values())


def _least(piping: Piping, beliefs: Beliefs, body: Body) -> float:
    """How sure it must be what a body is, by how likely what labels make of it is."""
    if body.unit_type is None:
        return _SURE
    # Its own parts say so, not what only hangs together with them.
    said = float(beliefs.of_groups(_groups_of(piping, body.unit_type))[list(body.parts)].max())
    return _OTHER if said >= _LIKELY else _SURE


def _terms(piping: Piping, beliefs: Beliefs, sight: _Sight) -> dict[str, list[Term]]:
    """What speaks for and against everything that a body may be, in words and log-odds."""

    def labelled(groups: Collection[str]) -> Term:
        said = float(beliefs.of_groups(groups, _BENT)[list(sight.body.parts)].mean())
        return f"the labeler gives it {said:.0%}", LABELLED.at_one(float(np.log(max(said, LEAST))))

    terms: dict[str, list[Term]] = {}
    if sight.body.unit_type is None:
        # Else that it is a device is not in doubt, only which.
        terms[_NOTHING] = [("nothing speaks for it", 0.0)]
        terms[_STEELWORK] = [("it may carry them", _STANDING), labelled(other_groups(piping))]
    for kind, effect in ARRANGEMENT[sight.arrangement].items():
        groups = _groups_of(piping, kind)
        if groups and (kind != "gauge" or _may_be_gauge(beliefs, sight)):
            terms[kind] = [
                (_ENDS[sight.arrangement], effect),
                (SIZE[kind].says.format(sight.pipes), SIZE[kind].at_one(sight.pipes)),
                labelled(groups),
                *_further(piping, sight, kind),
            ]
    return terms


def _may_be_gauge(beliefs: Beliefs, sight: _Sight) -> bool:
    """Whether a body is as small as gauges are; a meter in a line may be longer, where people have not named most."""
    return sight.length <= _WIDEST_GAUGE or (sight.arrangement == "aligned" and not _is_named(beliefs))


def _further(piping: Piping, sight: _Sight, kind: str) -> Iterator[Term]:
    """What speaks for and against a type where it applies: slim bodies, lids, units that a body touches."""
    if sight.slim is not None:
        odds = float(SLIM(sight.slim))
        yield SLIM.says.format(sight.slim), odds if kind == FITTING else -odds
    if sight.closes and kind == FITTING:
        yield "it closes the end", LID
    touched = {part for group in _owners(piping, sight, kind) for part in group.parts}
    if touched:
        yield f"it touches a {kind}", _by_touch(piping, sight, touched)


def _by_touch(piping: Piping, sight: _Sight, touched: Collection[int]) -> float:
    """What it adds to a type that a body touches parts of such a unit."""
    if any(part in sight.mounted for part in touched):
        return _PIECE
    return _BODY if _MOTOR.isdisjoint(piping.roles.names[part] for part in touched) else _DRIVEN


def _owners(piping: Piping, sight: _Sight, unit_type: str) -> list[Group]:
    """The groups of a type that a body touches and may be a piece of; a gauge with a stem of its own is screwed into
    what more than one line ends at.
    """
    if unit_type == sight.apart:
        return []
    touched = _touched(piping, sight.body, unit_type)
    if unit_type != "gauge" or sight.arrangement == "one":
        return touched
    names = piping.roles.names
    return [group for group in touched if all(names[part] != "gauge stem" for part in group.parts)]


def _is_lid(piping: Piping, body: Body, ends: Ends, rows: Sequence[int]) -> bool:
    """Whether a body is a flat disc on the end of a line, and as wide."""
    if len(rows) != 1 or len(body.parts) != 1:
        return False
    along, reach = _extent(piping, body, ends, rows[0])
    lesser, greater = sorted((reach, float(ends.radius[rows[0]])))
    return along <= _FLAT * reach and lesser >= _AS_WIDE * greater


def _extent(piping: Piping, body: Body, ends: Ends, row: int) -> tuple[float, float]:
    """How long a body is along the axis of an end, and how far it reaches from it [m]."""
    points = np.concatenate([piping.given.parts.scene.mesh(part)[0] for part in body.parts])
    return extent_about(ends, row, points)


def _slimness(piping: Piping, body: Body, ends: Ends, rows: Sequence[int]) -> float | None:
    """How far a body between two ends on one axis reaches from it, as share of their pipe's radius; None where it
    isn't, or no pipe is found.
    """
    pipes = [radius for row in rows if (radius := pipe_radius(piping, row)) is not None]
    if arrangement_of(ends, rows) != "aligned" or not pipes:
        return None
    _, reach = _extent(piping, body, ends, rows[0])
    return reach / max(pipes)


def _touched(piping: Piping, body: Body, unit_type: str) -> list[Group]:
    """The groups of a type that a body touches."""
    return [
        group for group in piping.groups if group.unit_type == unit_type and not set(body.near).isdisjoint(group.parts)
    ]


def _groups_of(piping: Piping, unit_type: str) -> list[str]:
    """The groups of the vocabulary that a type stands for."""
    vocabulary = piping.given.vocabulary
    if unit_type == FITTING:
        return sorted(vocabulary.connector_groups)
    return vocabulary.groups_of(unit_type)


def _longest(piping: Piping, parts: Sequence[int]) -> float:
    """The longest side of the box around some parts [m]."""
    low, high = box_around(piping.given.parts, parts)
    return float((high - low).max())


def _taken(piping: Piping, body: Body, kind: str, found: Recovered) -> Piping:
    """The piping with a body as what it is."""
    if kind == _NOTHING:
        return piping
    return _with_fitting(piping, body, found) if kind == FITTING else _with_unit(piping, body, kind, found)


def _with_fitting(piping: Piping, body: Body, found: Recovered) -> Piping:
    """The piping in which a body only passes a line on; what it was part of before is no unit any longer."""
    inside, seeds = set(body.parts), {mount.part for mount in body.mounts}
    gone = {part for group in piping.groups if not inside.isdisjoint(group.parts) for part in group.parts}
    return replace(
        piping,
        lineless=tuple(sorted(seeds.union(piping.lineless))),
        groups=tuple(group for group in piping.groups if inside.isdisjoint(group.parts)),
        members=piping.members - gone,
        feet=piping.feet - gone,
        recovered={**piping.recovered, **dict.fromkeys(seeds, found)},
    )


def _with_unit(piping: Piping, body: Body, unit_type: str, found: Recovered) -> Piping:
    """The piping in which a body is a unit, with the groups of that type that it touches."""
    inside = set(body.parts)
    joined = _touched(piping, body, unit_type)
    parts = inside.union(*(group.parts for group in joined))
    groups = [group for group in piping.groups if group not in joined and inside.isdisjoint(group.parts)]
    return replace(
        piping,
        lines={part: line for part, line in piping.lines.items() if part not in inside},
        lineless=tuple(part for part in piping.lineless if part not in inside),
        groups=(*groups, Group(unit_type, tuple(sorted(parts)))),
        members=piping.members | inside,
        feet=piping.feet | inside if unit_type == "gauge" else piping.feet,
        recovered={**piping.recovered, **dict.fromkeys(body.parts, found)},
    )
