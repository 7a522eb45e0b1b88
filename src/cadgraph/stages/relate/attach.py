"""What joins what: every end of a line finds the end, the side of a line, or the solid that it belongs to."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields

import numpy as np

from cadgraph.geometry.contact.region import Regions, contact_regions
from cadgraph.geometry.line.centreline import Centreline
from cadgraph.model.derived import store_of
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.scene import Floats, Ints
from cadgraph.stages.relate.joint import (
    Ends,
    Facing,
    Tap,
    face_ends,
    find_tap,
    gather_ends,
    nearest_on,
    same_place,
)

__all__ = ["Attachments", "Mount", "Side", "attach_lines", "flat_contacts", "regions_of"]

# The middle of a contact lies before an end, or behind it by at most this many radii or this much [m]: a nozzle that
# runs into a shell.
_DEPTH, _LEAST_DEPTH = 3.0, 0.06
# ... and off its axis by at most this many radii: a saddle on a slanted shell.
_OFF = 1.3
# A contact's normal that is this sure of itself must agree with the direction of the end (cosine).
_FLAT, _AGREES = 0.6, 0.2
# Surfaces nearer than this touch [m]: where they do, only what is that near tells where.
_TIGHT = 0.001
# Two solids are flanged to each other where they meet in a flat round area: normals this parallel, extents this alike,
# and at least this large against the lesser solid.
_FACE_FLAT, _FACE_ROUND, _FACE_SHARE = 0.9, 0.72, 0.25


@dataclass(frozen=True)
class Mount:
    """An end of a line at a solid part.

    Args:
        row: row of the end.
        part: the solid part.
        gap: distance between the two [m].
    """

    row: int
    part: int
    gap: float


@dataclass(frozen=True)
class Side:
    """A solid part that touches the side of a line.

    Args:
        solid: the solid part.
        part: the part that carries the line.
        tap: place on the line.
    """

    solid: int
    part: int
    tap: Tap


@dataclass(frozen=True)
class Attachments:
    """What joins what.

    Args:
        ends: the free ends of all lines.
        facings: ends that face each other.
        doubled: pairs of ends in one place that look the same way: a slip-on flange and its pipe.
        taps: rows of ends that sit on the side of a line, the part that carries it, and the place.
        mounts: ends at solids.
        sides: solids that touch the sides of lines.
    """

    ends: Ends
    facings: tuple[Facing, ...]
    doubled: tuple[tuple[int, int], ...]
    taps: tuple[tuple[int, int, Tap], ...]
    mounts: tuple[Mount, ...]
    sides: tuple[Side, ...]


def attach_lines(
    parts: Parts,
    contacts: Contacts,
    lines: Mapping[int, Centreline],
    solids: Collection[int],
    feet: Collection[int],
    bridge: float,
) -> Attachments:
    """Finds for each end of a line what it joins.

    Args:
        parts: parts of the scene.
        contacts: pairs of parts that are near.
        lines: centreline of each part that carries one.
        solids: parts without a line that lines may end at: those of units, and connectors of odd shape.
        feet: solids that may sit on the side of a line: parts of gauges.
        bridge: greatest gap between ends that face each other [m].
    """
    ends = gather_ends(lines)
    solid = set(solids)
    facings = face_ends(ends, contacts, bridge, _shut(contacts, lines, solid))
    partner = {facing.first: facing.second for facing in facings} | {f.second: f.first for f in facings}
    neighbors = _neighbors(contacts, lines)
    taps = []
    loose = [row for row in range(len(ends.part)) if row not in partner]
    doubled = _double(ends, loose, partner, neighbors, bridge)
    loose = sorted(set(loose) - {row for row, _ in doubled})
    mounts, sides = _mount(parts, contacts, lines, solid, set(feet), ends, set(loose))
    held = {mount.row: mount.gap for mount in mounts}
    for row in loose:
        options = [
            (tap.gap, other, tap)
            for other, gap in neighbors.get(int(ends.part[row]), ())
            if (tap := find_tap(ends, row, lines[other], gap + bridge)) is not None
        ]
        if options and row not in held:
            _, other, tap = min(options, key=lambda option: (option[2].sleeve, round(option[0], 6), option[1]))
            taps.append((row, other, tap))
    return Attachments(ends, tuple(facings), tuple(doubled), tuple(taps), mounts, sides)


def _double(
    ends: Ends,
    loose: Sequence[int],
    partner: Mapping[int, int],
    neighbors: Mapping[int, Sequence[tuple[int, float]]],
    bridge: float,
) -> list[tuple[int, int]]:
    """Loose ends that lie where another end lies which looks the same way, and that one."""
    doubled: list[tuple[int, int]] = []
    gone: set[int] = set()
    for row in loose:
        part = int(ends.part[row])
        there = [
            r
            for other, _ in neighbors.get(part, ())
            for r in ends.of_part[other]
            # The end that the other side of this part faces looks the same way too.
            if r not in gone and (r not in partner or int(ends.part[partner[r]]) != part)
        ]
        twin = same_place(ends, row, there, max(0.5 * bridge, 0.2 * float(ends.radius[row])))
        # Of two loose ends the one that is not too long to be a flange goes; of equal ones the later.
        if twin is not None and (twin in partner or (ends.length[row], row) <= (ends.length[twin], twin)):
            doubled.append((row, twin))
            gone.add(row)
    return doubled


def _neighbors(contacts: Contacts, lines: Mapping[int, Centreline]) -> dict[int, list[tuple[int, float]]]:
    """The parts with lines that are near each part with a line, and how near."""
    found: dict[int, list[tuple[int, float]]] = {}
    for (a, b), distance in zip(contacts.pairs.tolist(), contacts.distance.tolist(), strict=True):
        if a in lines and b in lines:
            found.setdefault(a, []).append((b, distance))
            found.setdefault(b, []).append((a, distance))
    return found


def _shut(contacts: Contacts, lines: Mapping[int, Centreline], solids: set[int]) -> list[tuple[int, int]]:
    """Pairs of lines that are near one and the same solid: it may lie between them."""
    at_solid: dict[int, list[int]] = {}
    for a, b in contacts.pairs.tolist():
        if a in lines and b in solids:
            at_solid.setdefault(b, []).append(a)
        elif b in lines and a in solids:
            at_solid.setdefault(a, []).append(b)
    return [(p, q) for near in at_solid.values() if len(near) < 32 for p in near for q in near if p < q]


def regions_of(parts: Parts, contacts: Contacts, rows: Ints, eps: float) -> Regions:
    """The extents of some contacts only; each is measured once for the same contacts."""
    known = store_of(contacts, "regions", eps)
    new = np.array([row for row in rows.tolist() if row not in known], np.int64)
    if len(new):
        pairs = contacts.pairs[new]
        used = np.unique(pairs)
        chosen = Contacts(np.searchsorted(used, pairs), contacts.distance[new], contacts.points[new])
        found = contact_regions(parts.scene.select(used), chosen, eps)
        columns = [getattr(found, field.name) for field in fields(Regions)]
        known.update(zip(new.tolist(), zip(*columns, strict=True), strict=True))
    return Regions(*(np.array(column) for column in zip(*(known[row] for row in rows.tolist()), strict=True)))


@dataclass(frozen=True)
class _Touch:
    """Where a line's part and a solid touch.

    Args:
        part: the part that carries the line.
        solid: the part that it touches.
        place: ``(3,)`` middle of the contact [m].
        normal: ``(3,)`` from the line to the solid; None where it is not sure.
        gap: between the two [m].
    """

    part: int
    solid: int
    place: Floats
    normal: Floats | None
    gap: float


def _mount(
    parts: Parts,
    contacts: Contacts,
    lines: Mapping[int, Centreline],
    solids: set[int],
    feet: set[int],
    ends: Ends,
    loose: set[int],
) -> tuple[tuple[Mount, ...], tuple[Side, ...]]:
    """Ends at solids: each at the nearest; and solids at the sides of lines."""
    tight: list[int] = []
    wide: list[int] = []
    sides = []
    for row, line, solid in _meetings(contacts, lines, solids):
        gap = float(contacts.distance[row])
        if solid in feet or any(
            end in loose and _is_near(parts, ends, end, solid) for end in ends.of_part.get(line, ())
        ):
            (tight if gap <= _TIGHT else wide).append(row)
        else:
            sides.append(_side(lines[line], line, solid, contacts.points[row].mean(axis=0), gap))
    best: dict[int, tuple[float, float, int]] = {}
    for touch in (
        *_touches(parts, contacts, lines, tight, 2 * _TIGHT),
        *_touches(parts, contacts, lines, wide, float(contacts.distance.max(initial=0.0)) + _TIGHT),
    ):
        misses = [
            (end, miss) for end in ends.of_part.get(touch.part, ()) if (miss := _miss(ends, end, touch)) is not None
        ]
        if not misses:
            sides.append(_side(lines[touch.part], touch.part, touch.solid, touch.place, touch.gap))
        for end, miss in misses:
            offer = (miss, touch.gap, touch.solid)
            best[end] = min(best.get(end, offer), offer)
    mounts = tuple(Mount(end, solid, gap) for end, (_, gap, solid) in sorted(best.items()) if end in loose)
    return mounts, tuple(sides)


def _meetings(contacts: Contacts, lines: Collection[int], solids: Collection[int]) -> Iterator[tuple[int, int, int]]:
    """The contacts of a part with a line and a solid: row, the former and the latter."""
    for row, (a, b) in enumerate(contacts.pairs.tolist()):
        if a in lines and b in solids:
            yield row, a, b
        elif b in lines and a in solids:
            yield row, b, a


def _touches(
    parts: Parts, contacts: Contacts, lines: Collection[int], rows: Sequence[int], eps: float
) -> Iterator[_Touch]:
    """The extents of some contacts between lines and solids, of what is nearer than ``eps`` [m]."""
    if not rows:
        return
    outward = parts.properties.closed & (parts.properties.volume > 0)
    regions = regions_of(parts, contacts, np.array(rows, np.int64), eps)
    for k, row in enumerate(rows):
        a, b = contacts.pairs[row].tolist()
        line, solid, sense = (a, b, 1.0) if a in lines else (b, a, -1.0)
        # Normals of faces that look inward are wrong.
        known = regions.flatness[k] > _FLAT and outward[a] and outward[b]
        normal = sense * regions.normal[k] if known else None
        yield _Touch(line, solid, regions.centroid[k], normal, float(contacts.distance[row]))


def _is_near(parts: Parts, ends: Ends, row: int, solid: int) -> bool:
    """Whether an end lies in a solid's box, or about its own radius from it."""
    reach = _OFF * float(ends.radius[row]) + _LEAST_DEPTH / 2
    low, high = parts.properties.aabb[solid]
    point = ends.point[row]
    return bool(np.all(point >= low - reach) and np.all(point <= high + reach))


def _side(line: Centreline, part: int, solid: int, place: Floats, gap: float) -> Side:
    number, near = min(
        enumerate(nearest_on(branch, place) for branch in line.branches), key=lambda option: option[1][4]
    )
    return Side(solid, part, Tap(number, near[0], near[1], gap))


def _miss(ends: Ends, row: int, touch: _Touch) -> float | None:
    """How far the middle of a contact is from an end [m]; None where it is not at that end."""
    direction, radius = ends.direction[row], float(ends.radius[row])
    offset = touch.place - ends.point[row]
    along = float(offset @ direction)
    off = float(np.linalg.norm(offset - along * direction))
    depth = min(max(_DEPTH * radius, _LEAST_DEPTH), 0.5 * float(ends.length[row]))
    if not -depth - 0.001 <= along <= touch.gap + 0.5 * radius + 0.005 or off > _OFF * radius + touch.gap:
        return None
    if touch.normal is not None and float(touch.normal @ direction) < _AGREES:
        return None
    return abs(along) + 0.5 * off


def flat_contacts(
    parts: Parts, contacts: Contacts, pairs: Iterable[tuple[int, int]], eps: float
) -> dict[tuple[int, int], tuple[Floats, Floats]]:
    """Pairs of parts that are flanged to each other: they meet in a flat round area.

    Returns:
        For each such pair the middle of the area [m] and its normal, from the first to the second.
    """
    wanted = set(pairs)
    rows = [k for k, (a, b) in enumerate(contacts.pairs.tolist()) if (a, b) in wanted]
    if not rows:
        return {}
    index = np.array(rows, np.int64)
    regions = regions_of(parts, contacts, index, eps)
    found = {}
    for k, row in enumerate(rows):
        a, b = contacts.pairs[row].tolist()
        wide, high, thin = regions.extents[k]
        size = min(float(parts.properties.obb_extents[part, 1]) for part in (a, b))
        if (
            regions.flatness[k] >= _FACE_FLAT
            and high >= _FACE_ROUND * wide
            and thin <= 0.2 * wide + 0.002
            and wide >= _FACE_SHARE * size
        ):
            found[a, b] = regions.centroid[k], regions.normal[k]
    return found
