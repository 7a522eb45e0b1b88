"""What stands on the side of a line without an end there: gauges, and small valves with their stub in one mesh."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from cadgraph.model.parts import UnitParts, owners_of
from cadgraph.model.vocabulary import OPERATORS
from cadgraph.stages.relate.attach import Side
from cadgraph.stages.relate.joint import Ends, ahead_of, extent_about
from cadgraph.stages.relate.piping import Piping

__all__ = ["find_standing"]

_ON = 0.001  # a valve that is set on a line is this near [m]
_ASIDE = 0.5  # how far that place is off the axis of the valve's other line, as share of the way there (ours)


def find_standing(piping: Piping, units: Sequence[UnitParts]) -> dict[int, Side]:
    """The place on the side of a line of each gauge that no end leads to, the one that it touches best; and of each
    valve that one end leads to at most, and whose body touches the side of one line and nothing else.

    Args:
        piping: what joins what.
        units: in order.

    Returns:
        Places by number of the unit, ascending.
    """
    owner = owners_of(units)
    leading: dict[int, list[int]] = {}
    for mount in piping.joints.mounts:
        leading.setdefault(owner.get(mount.part, -1), []).append(mount.row)
    best: dict[int, Side] = {}
    for side in sorted(piping.joints.sides, key=lambda side: (side.tap.gap, side.part)):
        unit = owner.get(side.solid)
        if unit is None or side.part not in piping.lines:
            continue
        if _may_stand(piping, units[unit], side, leading.get(unit, [])):
            best.setdefault(unit, side)
    return dict(sorted(best.items()))


def _may_stand(piping: Piping, unit: UnitParts, side: Side, leading: Sequence[int]) -> bool:
    """Whether a unit may stand on the side of a line that a part of it touches.

    Args:
        piping: what joins what.
        unit: in question.
        side: of the line.
        leading: rows of the ends of lines at the unit.
    """
    if unit.unit_type != "valve":
        return unit.unit_type == "gauge" and not leading
    if len(leading) > 1 or side.tap.gap > _ON or piping.roles.names[side.solid] in OPERATORS:
        return False
    ends = piping.joints.ends
    heads = all(_heads_for(ends, row, side) for row in leading)
    return heads and _is_alone(piping, unit, {side.part, *ends.part[list(leading)].tolist()})


def _is_alone(piping: Piping, unit: UnitParts, known: Collection[int]) -> bool:
    """Whether a unit touches nothing that carries a line or is at one, but for some parts that are known."""
    around = {other for part in unit.parts for other in piping.given.neighbors.get(part, ())}
    return not any(other in piping.solids or other in piping.lines for other in around.difference(known, unit.parts))


def _heads_for(ends: Ends, row: int, side: Side) -> bool:
    """Whether the line that ends at a valve heads for the place that the valve stands on, and not along it."""
    ahead, (_, aside) = ahead_of(ends, row, side.tap.point), extent_about(ends, row, side.tap.point[None])
    return ahead > 0 and aside <= _ASIDE * ahead
