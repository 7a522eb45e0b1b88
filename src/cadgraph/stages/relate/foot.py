"""What a device stands on its line by: stems and siphons of gauges, nozzles of tanks, that look like pipe."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from cadgraph.stages.relate.belief import Beliefs
from cadgraph.stages.relate.piping import Group, Piping, Recovered

__all__ = ["BESIDE", "take_feet"]

BESIDE = 3.0
"""By how much a gauge or a tank at its end makes it likelier that a piece without a label is one of its own."""

_WITH_FEET = frozenset({"gauge", "tank"})
_WHY = "it stands at a {} and looks as much like a piece of it as like pipe"
_MOST = 3  # pieces between a gauge and its line
_LONGEST = {"gauge": 0.4, "tank": 0.6}  # m


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
        taken = {part: number for part, number, _ in found}
        shares = {
            part: Recovered(share, (_WHY.format(piping.groups[number].unit_type),)) for part, number, share in found
        }
        groups = [
            Group(group.unit_type, tuple(sorted({*group.parts, *(p for p, k in taken.items() if k == number)})))
            for number, group in enumerate(piping.groups)
        ]
        feet = {part for part, number in taken.items() if piping.groups[number].unit_type == "gauge"}
        piping = replace(
            piping,
            lines={part: line for part, line in piping.lines.items() if part not in taken},
            groups=tuple(groups),
            members=piping.members | taken.keys(),
            feet=piping.feet | feet,
            recovered={**piping.recovered, **{part: shares[part] for part in taken}},
        )
    return piping


def _feet(piping: Piping, beliefs: Beliefs) -> Iterator[tuple[int, int, float]]:
    """Parts with a line that end at a gauge or tank and look as much like a piece of it, the number of its group, and
    how sure that is.
    """
    owner = {
        part: number
        for number, group in enumerate(piping.groups)
        if group.unit_type in _WITH_FEET
        for part in group.parts
    }
    connectors = piping.given.vocabulary.connector_groups
    lines = beliefs.of_groups(connectors)
    units = piping.given.vocabulary.unit_of_group
    own = {unit: beliefs.of_groups([name for name, u in units.items() if u == unit]) for unit in _WITH_FEET}
    for mount in piping.joints.mounts:
        part, number = int(piping.joints.ends.part[mount.row]), owner.get(mount.part)
        label = piping.given.labels[part]
        called = label is not None and label.group in connectors
        if number is None or called or not beliefs.open[part]:
            continue
        unit_type = piping.groups[number].unit_type
        likely, against = BESIDE * float(own[unit_type][part]), float(lines[part])
        if piping.lines[part].length <= _LONGEST[unit_type] and likely > 0 and likely >= against:
            yield part, number, likely / (likely + against)
