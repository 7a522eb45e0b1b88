"""What a device stands on its line or the next device by: stems of gauges, nozzles of tanks, that look like pipe."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace

from cadgraph.stages.relate.belief import Beliefs
from cadgraph.stages.relate.piping import Group, Piping, Recovered

__all__ = ["BESIDE", "take_feet"]

BESIDE = 3.0
"""By how much a gauge or a tank at its end makes it likelier that a piece without a label is one of its own."""

_WHY = "it stands at a {} and looks as much like a piece of it as like pipe"
_UNITS = 2  # that a piece stands between
_MOST = 3  # pieces between a gauge and its line
_LONGEST = {"gauge": 0.4, "tank": 0.6}  # of a stem, and of a nozzle [m]
_LIKELY = 0.5  # what is so likely of a gauge may be longer: both cocks of a level gauge in one mesh


def take_feet(piping: Piping, beliefs: Beliefs) -> Piping:
    """Gives gauges and tanks the pieces at them that no label calls a connector and that look as much like theirs.

    Args:
        piping: with its units.
        beliefs: what each part may be.
    """
    for _ in range(_MOST):
        # Between two tanks a piece is of one of them.
        found = {part: (part, number, share) for part, number, share in _feet(piping, beliefs)}
        if not found:
            break
        piping = _with_feet(piping, found.values())
    return piping


def _with_feet(piping: Piping, found: Collection[tuple[int, int, float]]) -> Piping:
    """The piping in which some parts are of groups, by their number."""
    types = [group.unit_type for group in piping.groups]
    groups = [set(group.parts) for group in piping.groups]
    feet, recovered = set(piping.feet), dict(piping.recovered)
    for part, number, share in found:
        groups[number].add(part)
        recovered[part] = Recovered(share, (_WHY.format(types[number]),))
        if types[number] == "gauge":
            feet.add(part)
    taken = {part for part, _, _ in found}
    return replace(
        piping,
        lines={part: line for part, line in piping.lines.items() if part not in taken},
        groups=tuple(Group(kind, tuple(sorted(parts))) for kind, parts in zip(types, groups, strict=True)),
        members=piping.members | taken,
        feet=frozenset(feet),
        recovered=recovered,
    )


def _feet(piping: Piping, beliefs: Beliefs) -> Iterator[tuple[int, int, float]]:
    """Parts at a gauge or tank that look as much like a piece of it as like pipe, its number, and how sure that is."""
    vocabulary = piping.given.vocabulary
    lines = beliefs.of_groups(vocabulary.connector_groups)
    own = {kind: beliefs.of_groups(vocabulary.groups_of(kind)) for kind in {*vocabulary.unit_of_group.values()}}
    for part, number in (*_at_units(piping), *_between_units(piping)):
        kind = piping.groups[number].unit_type
        longest = math.inf if kind == "gauge" and own[kind][part] >= _LIKELY else _LONGEST.get(kind, 0.0)
        if not _may_be_foot(piping, beliefs, part) or _length(piping, part) > longest:
            continue
        share = _share_of(kind, {one: float(values[part]) for one, values in own.items()}, float(lines[part]))
        if share:
            yield part, number, share


def _at_units(piping: Piping) -> Iterator[tuple[int, int]]:
    """The parts whose lines end at units, each with the number of the group."""
    owner = {part: number for number, group in enumerate(piping.groups) for part in group.parts}
    for mount in piping.joints.mounts:
        if mount.part in owner:
            yield int(piping.joints.ends.part[mount.row]), owner[mount.part]


def _between_units(piping: Piping) -> Iterator[tuple[int, int]]:
    """The parts without a label or a line that touch two units and no line, each with the numbers of their groups."""
    owner = {part: number for number, group in enumerate(piping.groups) for part in group.parts}
    used = owner.keys() | piping.lines.keys()
    for part in (part for part, label in enumerate(piping.given.labels) if label is None and part not in used):
        near = set(piping.given.neighbors.get(part, ()))
        units = sorted({owner[other] for other in near & owner.keys()})
        if len(units) == _UNITS and near.isdisjoint(piping.lines):
            yield part, units[0]
            yield part, units[1]


def _share_of(kind: str, said: Mapping[str, float], against: float) -> float:
    """How sure it is that a piece is of a gauge or tank at its end; 0 where it is likelier pipe, or a device of another
    type: a valve at a gauge is its root valve.

    Args:
        kind: type of the unit.
        said: how likely the piece is of each type.
        against: how likely it is pipe.
    """
    likely = BESIDE * said[kind]
    foot = likely > 0 and likely >= against and said[kind] >= max(said.values())
    return likely / (likely + against) if foot else 0.0


def _may_be_foot(piping: Piping, beliefs: Beliefs, part: int) -> bool:
    """Whether neither a user nor any label calls a part a connector."""
    label = piping.given.labels[part]
    called = label is not None and label.group in piping.given.vocabulary.connector_groups
    return bool(beliefs.open[part]) and not called


def _length(piping: Piping, part: int) -> float:
    """How long a part is along its line, or the longest side of its box [m]."""
    line = piping.lines.get(part)
    return line.length if line is not None else float(piping.given.parts.properties.obb_extents[part].max())
