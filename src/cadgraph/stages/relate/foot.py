"""What a device stands on its line by: stems and siphons of gauges, nozzles of tanks, that look like pipe."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from cadgraph.stages.relate.belief import Beliefs
from cadgraph.stages.relate.piping import Group, Piping, Recovered

__all__ = ["BESIDE", "take_feet"]

BESIDE = 3.0
"""By how much a gauge or a tank at its end makes it likelier that a piece without a label is one of its own."""

_WHY = "it stands at a {} and looks as much like a piece of it as like pipe"
_MOST = 3  # pieces between a gauge and its line
_LONGEST = {"gauge": 0.4, "tank": 0.6}  # of a stem, and of a nozzle [m]


def take_feet(piping: Piping, beliefs: Beliefs) -> Piping:
    """Gives gauges and tanks the pieces at them that no label calls a connector and that look as much like theirs.

    Args:
        piping: with its units.
        beliefs: what each part may be.
    """
    for _ in range(_MOST):
        found = list(_feet(piping, beliefs))
        if not found:
            break
        piping = _with_feet(piping, found)
    return piping


def _with_feet(piping: Piping, found: Sequence[tuple[int, int, float]]) -> Piping:
    """The piping in which some parts are of groups, by their number."""
    taken = {part: number for part, number, _ in found}
    types = [group.unit_type for group in piping.groups]
    groups = [set(group.parts) for group in piping.groups]
    for part, number in taken.items():
        groups[number].add(part)
    shares = {part: Recovered(share, (_WHY.format(types[number]),)) for part, number, share in found}
    return replace(
        piping,
        lines={part: line for part, line in piping.lines.items() if part not in taken},
        groups=tuple(Group(kind, tuple(sorted(parts))) for kind, parts in zip(types, groups, strict=True)),
        members=piping.members | taken.keys(),
        feet=piping.feet | {part for part, number in taken.items() if types[number] == "gauge"},
        recovered={**piping.recovered, **shares},
    )


def _feet(piping: Piping, beliefs: Beliefs) -> Iterator[tuple[int, int, float]]:
    """Parts with a line that end at a gauge or tank and look as much like a piece of it, the number of its group, and
    how sure that is.
    """
    vocabulary = piping.given.vocabulary
    owner = {part: number for number, group in enumerate(piping.groups) for part in group.parts}
    lines = beliefs.of_groups(vocabulary.connector_groups)
    units = vocabulary.unit_of_group
    own = {kind: beliefs.of_groups([name for name, unit in units.items() if unit == kind]) for kind in _LONGEST}
    for mount in piping.joints.mounts:
        part, number = int(piping.joints.ends.part[mount.row]), owner.get(mount.part)
        kind = piping.groups[number].unit_type if number is not None else ""
        if number is None or kind not in _LONGEST or not _may_be_foot(piping, beliefs, part, kind):
            continue
        likely, against = BESIDE * float(own[kind][part]), float(lines[part])
        if likely > 0 and likely >= against:
            yield part, number, likely / (likely + against)


def _may_be_foot(piping: Piping, beliefs: Beliefs, part: int, kind: str) -> bool:
    """Whether a part is short enough, and neither a user nor any label calls it a connector."""
    label = piping.given.labels[part]
    called = label is not None and label.group in piping.given.vocabulary.connector_groups
    return bool(beliefs.open[part]) and not called and piping.lines[part].length <= _LONGEST[kind]
