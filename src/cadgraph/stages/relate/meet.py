"""Solids that are joined to each other without a line between: flanged, or a gauge or valve screwed into a device."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import numpy as np

from cadgraph.model.parts import UnitParts, owners_of
from cadgraph.model.vocabulary import OPERATORS
from cadgraph.stages.relate.attach import flat_contacts, regions_of
from cadgraph.stages.relate.network import FLANGED_SCORE, SIDE_SCORE, Meeting
from cadgraph.stages.relate.piping import Piping

__all__ = ["meet_directly"]

_DEEP = 0.6  # of their width units run into each other where they are drawn without care for it (share)
_SCREWED = 0.002  # a gauge is screwed into what is this near [m]; threads are drawn with play
_AT = frozenset({"valve", "pump", "equipment"})  # what gauges are screwed into; at a tank they may lean on more


def meet_directly(
    piping: Piping, units: Sequence[UnitParts], standing: Collection[int]
) -> dict[tuple[int, int], Meeting]:
    """The pairs of solids that are joined without a line between.

    Args:
        piping: what joins what.
        units: in order.
        standing: numbers of the units that stand on the side of a line.
    """
    given = piping.given
    pairs = _between(piping, units)
    flat = flat_contacts(given.parts, given.contacts, pairs, given.config.cluster.eps, _DEEP)
    found = {
        pair: Meeting(middle, 0.0, FLANGED_SCORE, "they meet in a flat round area")
        for pair, (middle, _) in flat.items()
    }
    free = _free_units(piping, units, pairs, {part for pair in found for part in pair}, standing)
    found |= _screwed(piping, units, pairs, free)
    return {pair: meeting for pair, meeting in found.items() if pair not in given.edits.cut}


def _between(piping: Piping, units: Sequence[UnitParts]) -> list[tuple[int, int]]:
    """Pairs of solids in contact that are not of one unit. What moves a valve joins nothing that it leans on."""
    names = piping.roles.names
    moved = {part for unit in units for part in _operators(unit.parts, names)}
    owner = {part: -1 - part for part in piping.lineless} | owners_of(units)
    owner = {part: own for part, own in owner.items() if part not in moved}
    return [(a, b) for a, b in piping.given.contacts.plain_pairs if a in owner and b in owner and owner[a] != owner[b]]


def _operators(parts: Sequence[int], names: Sequence[str | None]) -> list[int]:
    """Those parts of a valve that move it; none where it has no others."""
    found = [part for part in parts if names[part] in OPERATORS]
    return found if len(found) < len(parts) else []


def _screwed(
    piping: Piping, units: Sequence[UnitParts], pairs: Collection[tuple[int, int]], free: Collection[int]
) -> dict[tuple[int, int], Meeting]:
    """For each unit of free parts the device that it touches, of several the nearest."""
    owner = owners_of(units)
    best: dict[int, int] = {}
    for row in _rows_at_devices(piping, units, pairs, free):
        a, b = piping.given.contacts.plain_pairs[row]
        best.setdefault(owner[a if a in free else b], row)
    return _meetings(piping, sorted(best.values()))


def _rows_at_devices(
    piping: Piping, units: Sequence[UnitParts], pairs: Collection[tuple[int, int]], free: Collection[int]
) -> list[int]:
    """The contacts of parts of free units with devices that these may be screwed into, the nearest first."""
    contacts = piping.given.contacts
    places = _places(piping, units, free)
    wanted = {pair for pair in pairs if any(_is_on(pair, *place) for place in places)}
    gaps = contacts.distance
    rows = [row for row in map(contacts.row_of.__getitem__, wanted) if gaps[row] <= _SCREWED]
    return sorted(rows, key=lambda row: (float(gaps[row]), row))


def _places(
    piping: Piping, units: Sequence[UnitParts], free: Collection[int]
) -> tuple[tuple[Collection[int], Collection[int]], ...]:
    """Parts of free units, and those of devices that they may be screwed into: of tanks where they touch no more."""
    bodies = {part for unit in units if unit.unit_type in _AT for part in unit.parts}
    tanks = {part for unit in units if unit.unit_type == "tank" for part in unit.parts}
    return (free, bodies), (_hanging(piping, units, free), tanks)


def _hanging(piping: Piping, units: Sequence[UnitParts], free: Collection[int]) -> set[int]:
    """The parts of those free gauges that touch one other unit and nothing else: they can't but hang on it."""
    owner = owners_of(units)

    def hangs(parts: tuple[int, ...]) -> bool:
        # What touches the gauge alone holds nothing: a flap, a plate.
        near = {part for part in piping.touched(parts) if not piping.touched((part,)) <= set(parts)}
        return len({owner.get(part, -1 - part) for part in near}) == 1

    gauges = (unit.parts for unit in units if unit.unit_type == "gauge" and any(part in free for part in unit.parts))
    return {part for parts in gauges if hangs(parts) for part in parts}


def _free_units(
    piping: Piping,
    units: Sequence[UnitParts],
    pairs: Collection[tuple[int, int]],
    flanged: Collection[int],
    standing: Collection[int],
) -> set[int]:
    """The parts of the gauges and valves that neither a line nor a flange holds; valves touch just one device."""
    owner = owners_of(units)
    held = {owner.get(part) for part in (*flanged, *piping.mounted)}
    around = _around(pairs, owner)
    free = set(range(len(units))) - held - set(standing)
    return {part for k in free if _is_end(piping, units[k], around.get(k, ())) for part in units[k].parts}


def _around(pairs: Collection[tuple[int, int]], owner: Mapping[int, int]) -> dict[int, set[int]]:
    """The units, or solids that are none, that each unit touches."""
    found: dict[int, set[int]] = {}
    for a, b in pairs:
        for part, other in ((a, b), (b, a)):
            found.setdefault(owner.get(part, -1), set()).add(owner.get(other, -1 - other))
    return found


def _is_end(piping: Piping, unit: UnitParts, around: Collection[int]) -> bool:
    """Whether a unit may be screwed into a device: a gauge, or a valve that touches one device and no line."""
    if unit.unit_type != "valve":
        return unit.unit_type == "gauge"
    return len(around) == 1 and not any(piping.lines_near(part) for part in unit.parts)


def _is_on(pair: tuple[int, int], free: Collection[int], bodies: Collection[int]) -> bool:
    """Whether two parts are one of some free units and one of what they may sit on."""
    a, b = pair
    return (a in free and b in bodies) or (b in free and a in bodies)


def _meetings(piping: Piping, rows: Sequence[int]) -> dict[tuple[int, int], Meeting]:
    """What some contacts of free units come to, each where its middle is."""
    if not rows:
        return {}
    given = piping.given
    regions = regions_of(given.parts, given.contacts, np.array(rows, np.int64), given.config.cluster.eps)
    gaps, why = given.contacts.distance, "no line ends at it, and it touches this"
    return {
        given.contacts.plain_pairs[row]: Meeting(regions.centroid[k], float(gaps[row]), SIDE_SCORE, why)
        for k, row in enumerate(rows)
    }
