"""What a network lacks, said out loud: units without lines, ends before something, pieces that hang together."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

import numpy as np

from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.parts import Network, Parts, UnitParts, owners_of
from cadgraph.model.ports import least_ports, port_word
from cadgraph.model.records import CUT
from cadgraph.model.scene import Floats
from cadgraph.stages.relate.piping import Piping

__all__ = ["find_shortfalls"]

# An end is before what lies within this much of its face [m], off its axis by at most so many radii.
_BEFORE, _OFF = 0.010, 1.1
_WORDS = ("no", "one", "two", "three")
_REMEDY = "correct a label there, or widen relate.bridge if this gap is meant"


def find_shortfalls(piping: Piping, network: Network) -> tuple[Diagnostic, ...]:
    """What should be joined by what its units are, or by where its ends lie, and isn't.

    Args:
        piping: what joins what.
        network: that was made of it.

    Returns:
        Units with fewer lines than their kind needs, free ends that lie before something, units that touch without
        being joined though one of them lacks a line, structures whose lines fall into several networks, and connectors
        that no line could be traced through.
    """
    # A device that stands in a file of its own lacks nothing.
    short = _short_units(network) - _hung_on(piping, network) if piping.lines else frozenset[int]()
    return (
        *_few_lines(piping, network, short),
        *_ends_before(piping),
        *_units_touching(piping, network, short),
        *_in_pieces(piping, network),
        *_untraced(piping),
    )


def _paths(parts: Parts, numbers: Collection[int]) -> tuple[str, ...]:
    return tuple(parts.scene.paths[part] for part in numbers)


def _short_units(network: Network) -> frozenset[int]:
    """Units with fewer lines than their kind needs."""
    return frozenset(number for number, unit in enumerate(network.units) if len(unit.openings) < _least(unit))


def _least(unit: UnitParts) -> int:
    """The fewest lines that a unit needs, whichever of the kinds it is that it may be."""
    kinds = [unit.kind, *(kind for kind, _ in unit.kind_guesses)]
    return min(least_ports(unit.unit_type, kind) for kind in kinds)


def _hung_on(piping: Piping, network: Network) -> frozenset[int]:
    """Gauges that touch another unit: these sit on it, without any line."""
    owner = owners_of(network.units)
    pairs = [(owner.get(a), owner.get(b)) for a, b in piping.given.contacts.plain_pairs]
    return frozenset(
        unit
        for pair in pairs
        for unit, other in (pair, pair[::-1])
        if unit is not None and other is not None and other != unit and network.units[unit].unit_type == "gauge"
    )


def _few_lines(piping: Piping, network: Network, short: Collection[int]) -> Iterator[Diagnostic]:
    best = _best_refused(piping)
    for number in sorted(short):
        unit = network.units[number]
        used, least = len(unit.openings), _least(unit)
        needs = f"{_WORDS[least]} {port_word(unit.unit_type)}{'s' * (least > 1)}"
        near = [best[part] for part in unit.parts if part in best]
        nearest = min(near, default=None)
        told = f"; the nearest end stops {1000 * nearest[0]:.1f} mm from it" if nearest is not None else ""
        what = unit.kind or unit.unit_type
        message = (
            f"{unit.tag} ({what}) has {_WORDS[min(used, 3)]} line{'s' * (used != 1)} and needs {needs}{told}: {_REMEDY}"
        )
        meshes = _paths(piping.given.parts, unit.parts[:1] + ((nearest[1],) if nearest is not None else ()))
        yield Diagnostic("unit-short-of-lines", message, meshes)


def _best_refused(piping: Piping) -> dict[int, tuple[float, int]]:
    """For each solid the least gap of a joint with an end that was not made, and the part that ends there."""
    found = piping.joints
    best: dict[int, tuple[float, int]] = {}
    for row, offer in found.refused.items():
        if offer.kind == "mount" and offer.flags != (CUT,):
            here = (max(0.0, offer.gap), int(found.ends.part[row]))
            best[offer.other] = min(best.get(offer.other, here), here)
    return best


def _ends_before(piping: Piping) -> Iterator[Diagnostic]:
    """Free ends with something before their face."""
    found, scene = piping.joints, piping.given.parts.scene
    for row, (gap, other) in sorted(_before(piping).items()):
        part = int(found.ends.part[row])
        role = _role(piping, other)
        message = (
            f"{scene.paths[part]} ends {1000 * gap:.1f} mm before {scene.paths[other]} ({role}) and joins nothing: "
            f"{_REMEDY}"
        )
        yield Diagnostic("end-before-part", message, (scene.paths[part], scene.paths[other]))


def _role(piping: Piping, part: int) -> str:
    name = piping.roles.names[part] or piping.roles.groups[part]
    return name or "without a label"


def _before(piping: Piping) -> dict[int, tuple[float, int]]:
    """For each free end that something lies before the gap [m] and that part."""
    contacts = piping.given.contacts
    free = _free_ends(piping)
    with_own = {tuple(sorted(pair)) for pair in (*_joined_pairs(piping), *piping.given.edits.cut)}
    best: dict[int, tuple[float, int]] = {}
    for (a, b), points, gap in zip(contacts.plain_pairs, contacts.points, contacts.distance.tolist(), strict=True):
        if gap > _BEFORE or (a, b) in with_own:
            continue
        for part, other in ((a, b), (b, a)):
            if part in free and not _is_aside(piping, other):
                for row in _rows_facing(piping, free[part], points.mean(axis=0)):
                    best[row] = min(best.get(row, (gap, other)), (gap, other))
    return best


def _free_ends(piping: Piping) -> dict[int, list[int]]:
    """The ends of each part that join nothing."""
    found = piping.joints
    taken = found.made.keys() | {row for pair in found.doubled for row in pair}
    return {part: [row for row in rows if row not in taken] for part, rows in found.ends.of_part.items()}


def _rows_facing(piping: Piping, rows: Sequence[int], place: Floats) -> Iterator[int]:
    """Those ends that have a place before their face."""
    ends = piping.joints.ends
    for row in rows:
        offset = place - ends.point[row]
        along = float(offset @ ends.direction[row])
        off = float(np.linalg.norm(offset - along * ends.direction[row]))
        if abs(along) <= _BEFORE and off <= _OFF * float(ends.radius[row]):
            yield row


def _is_aside(piping: Piping, part: int) -> bool:
    """Whether a part is nothing that a line could join: steelwork, supports, fasteners, the ground."""
    vocabulary = piping.given.vocabulary
    group = piping.roles.groups[part]
    functional = group is None or group in vocabulary.connector_groups or group in vocabulary.unit_of_group
    return not functional or part in piping.jackets or bool(piping.given.parts.ground[part])


def _joined_pairs(piping: Piping) -> Iterator[tuple[int, int]]:
    """Pairs of parts that join in one way or another."""
    found = piping.joints
    for row, offer in found.made.items():
        yield int(found.ends.part[row]), offer.part(found.ends)
    for row, twin in found.doubled:
        yield int(found.ends.part[row]), int(found.ends.part[twin])
    for side in found.sides:
        yield side.solid, side.part


def _units_touching(piping: Piping, network: Network, short: Collection[int]) -> Iterator[Diagnostic]:
    """Units that touch and are not joined though one of them lacks a line."""
    owner = owners_of(network.units)
    # A pair that is joined, or told already, is not told.
    shut = {(link.source, link.target) for link in network.links}
    contacts, scene = piping.given.contacts, piping.given.parts.scene
    for (a, b), gap in zip(contacts.plain_pairs, contacts.distance.tolist(), strict=True):
        first, second = sorted((owner.get(a, -1), owner.get(b, -1)))
        told = (first, second) in shut or (a, b) in piping.given.edits.cut
        if first < 0 or first == second or told or not {first, second}.intersection(short):
            continue
        shut.add((first, second))
        tags = f"{network.units[first].tag} and {network.units[second].tag}"
        message = f"{tags} are {1000 * gap:.1f} mm apart and not joined though one of them lacks a line: {_REMEDY}"
        yield Diagnostic("units-touch-unjoined", message, (scene.paths[a], scene.paths[b]))


def _in_pieces(piping: Piping, network: Network) -> Iterator[Diagnostic]:
    """Structures whose lines fall into several networks with units."""
    for structure, pieces in sorted(_pieces_of_structures(piping, network).items()):
        if len(pieces) < 2:
            continue
        told = "; ".join(", ".join(network.units[node].tag for node in units[:4]) for units in pieces[:4])
        more = "; ..." if len(pieces) > 4 else ""
        message = (
            f"structure {structure} holds {len(pieces)} networks that nothing joins ({told}{more}): see the free ends, "
            "or 'cadgraph explain OUT A B' for what is missing between two units"
        )
        heads = [network.units[units[0]].parts[0] for units in pieces]
        yield Diagnostic("network-in-pieces", message, _paths(piping.given.parts, heads))


def _pieces_of_structures(piping: Piping, network: Network) -> dict[int, list[tuple[int, ...]]]:
    """For each structure the units of each network in it."""
    cluster = piping.given.cluster
    found: dict[int, list[tuple[int, ...]]] = {}
    for members in network.systems:
        units = tuple(node for node in members if node < len(network.units))
        structures = {int(cluster[part]) for node in units for part in network.units[node].parts} - {-1}
        for structure in structures:
            found.setdefault(structure, []).append(units)
    return found


def _untraced(piping: Piping) -> Iterator[Diagnostic]:
    """Connectors that no line could be traced through, and at which no line ends."""
    lost = [part for part in piping.lineless if part not in piping.mounted and part not in piping.recovered]
    if lost:
        message = (
            f"{len(lost)} connectors have a shape that no line could be traced through, and no line ends at them: "
            "runs stop there; correct their label if they are none"
        )
        yield Diagnostic("line-untraced", message, _paths(piping.given.parts, lost))
