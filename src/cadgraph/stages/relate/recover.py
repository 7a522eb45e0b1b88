"""Devices that labels missed: bodies at the ends of lines, told by how the lines meet there and by what is likely."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np

from cadgraph.stages.relate.belief import Beliefs, beliefs_of
from cadgraph.stages.relate.body import Body, arrangement_of, find_bodies, other_groups
from cadgraph.stages.relate.evidence import Curve
from cadgraph.stages.relate.inline import recover_inline
from cadgraph.stages.relate.joint import Ends
from cadgraph.stages.relate.piping import Group, Piping
from cadgraph.stages.relate.prune import prune_lines

__all__ = ["ARRANGEMENT", "FITTING", "LABELLED", "SIZE", "recover_units"]

FITTING = "fitting"
"""What only passes a line on, beside the types of units and ``nothing``."""
_NOTHING, _STEELWORK = "nothing", "steelwork"

# How the ends of lines meet a body, in log-odds for each type.
ARRANGEMENT: Mapping[str, Mapping[str, float]] = {
    "one": {"valve": -2.0, "gauge": 1.5, "pump": -3.0, "tank": 1.0, "equipment": 0.0, FITTING: -9.0},
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
_MOSTLY_NAMED = 0.5  # below this share of parts that only the labeler has named what has no name is no device
_STANDING = 0.5  # log-odds that what has the ends of lines at it carries them
_WIDEST_GAUGE = 0.4  # m
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
    for body in bodies:
        piping = _taken(piping, body, *_type_of(piping, beliefs, body, ends))
    return piping


def _is_named(beliefs: Beliefs) -> bool:
    """Whether people have named most of the parts."""
    return int(beliefs.open.sum()) < _MOSTLY_NAMED * len(beliefs.open)


def _type_of(piping: Piping, beliefs: Beliefs, body: Body, ends: Ends) -> tuple[str, float]:
    """What a body is: a type of unit, a fitting, or nothing that enough speaks for; and how sure that is."""
    weights = {name: float(np.exp(value)) for name, value in _odds(piping, beliefs, body, ends).items()}
    best = max(weights, key=lambda name: (weights[name], name))
    share = weights[best] / sum(weights.values())
    if share < _SURE or best in (_NOTHING, _STEELWORK, body.unit_type):
        return _NOTHING, share
    if _is_named(beliefs) and not _touched(piping, body, best):
        # Where people have named nearly everything, what they left without a name is no device of theirs; a line that
        # ends on both sides of it passes through all the same.
        passes = arrangement_of(ends, [mount.row for mount in body.mounts]) == "aligned"
        return (FITTING if passes else _NOTHING), share
    return best, share


def _odds(piping: Piping, beliefs: Beliefs, body: Body, ends: Ends) -> dict[str, float]:
    """The log-odds of everything that a body may be."""
    rows = [mount.row for mount in body.mounts]
    longest = _longest(piping, body.parts)
    length = longest / (2 * float(ends.radius[rows].max()))

    def labelled(groups: Collection[str]) -> float:
        said = float(beliefs.of_groups(groups, _BENT)[list(body.parts)].mean())
        return float(LABELLED(np.log(max(said, _LEAST))))

    odds = {_NOTHING: 0.0, _STEELWORK: _STANDING + labelled(other_groups(piping))}
    if body.unit_type is not None:
        # That it is a device is not in doubt, only which.
        odds = {}
    for unit_type, effect in ARRANGEMENT[arrangement_of(ends, rows)].items():
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
    return sorted(group for group, unit in vocabulary.unit_of_group.items() if unit == unit_type)


def _longest(piping: Piping, parts: Sequence[int]) -> float:
    """The longest side of the box around some parts [m]."""
    boxes = piping.given.parts.properties.aabb[list(parts)]
    return float((boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0)).max())


def _taken(piping: Piping, body: Body, kind: str, sure: float) -> Piping:
    """The piping with a body as what it is."""
    if kind == _NOTHING:
        return piping
    return _with_fitting(piping, body, sure) if kind == FITTING else _with_unit(piping, body, kind, sure)


def _with_fitting(piping: Piping, body: Body, sure: float) -> Piping:
    """The piping in which a body only passes a line on."""
    seeds = {mount.part for mount in body.mounts}
    return replace(
        piping,
        lineless=tuple(sorted(seeds.union(piping.lineless))),
        recovered={**piping.recovered, **dict.fromkeys(seeds, sure)},
    )


def _with_unit(piping: Piping, body: Body, unit_type: str, sure: float) -> Piping:
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
        recovered={**piping.recovered, **dict.fromkeys(body.parts, sure)},
    )
