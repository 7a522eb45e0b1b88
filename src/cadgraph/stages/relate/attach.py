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
from cadgraph.stages.relate.decide import Decision, decide_joints, settle_faces
from cadgraph.stages.relate.evidence import scores_of
from cadgraph.stages.relate.joint import Ends, Facing, Tap, gather_ends, nearest_on, same_place
from cadgraph.stages.relate.offer import (
    EndsAhead,
    Offer,
    Surroundings,
    bear_witness,
    ends_about,
    is_hidden,
    offer_faces,
    offer_far_mount,
    offer_mount,
    offer_taps,
)
from cadgraph.stages.relate.stated import REACH, Stated, mouth_gap

__all__ = [
    "Attachments", "Mount", "Side", "Tapped", "attach_lines", "facings_of", "flat_contacts", "regions_of", "singles_of",
]  # fmt: skip

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
_FACE_FLAT, _FACE_ROUND, _FACE_SHARE, _FACE_THIN = 0.9, 0.72, 0.25, 0.2
# Such an area takes in the walls of both solids as far as they are within the gap that is allowed: a thickness of so
# much of it says nothing of one running into the other.
_FACE_SEEN = 0.9
# An end within this much [m], or this share of its radius, of another one that looks the same way is its twin, where
# the two lines run beside each other by at least this much [m] or this share of the shorter: a pipe in its flange, but
# not a gasket behind it.
_TWIN, _TWIN_SHARE, _BESIDE, _BESIDE_SHARE = 0.5, 0.2, 0.002, 0.3


@dataclass(frozen=True)
class Mount:
    """An end of a line at a solid part.

    Args:
        row: row of the end.
        part: the solid part.
        gap: distance between the two [m].
        score: how sure that is, 0..1.
        at: ``(3,)`` point of the solid that a user joined it to; None where the end lies at the solid [m].
    """

    row: int
    part: int
    gap: float
    score: float = 1.0
    at: Floats | None = None


@dataclass(frozen=True)
class Tapped:
    """An end that sits on the side of a line.

    Args:
        row: row of the end.
        part: the part that carries the line.
        tap: the place.
        score: how sure that is, 0..1.
        apart: whether a user joined them across a gap, which counts as length.
    """

    row: int
    part: int
    tap: Tap
    score: float = 1.0
    apart: bool = False


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
        taps: ends that sit on the side of a line.
        mounts: ends at solids.
        sides: solids that touch the sides of lines.
        made: of each end that joins something the offer that was taken.
        refused: of each end that joins nothing the best offer there was.
    """

    ends: Ends
    facings: tuple[Facing, ...]
    doubled: tuple[tuple[int, int], ...]
    taps: tuple[Tapped, ...]
    mounts: tuple[Mount, ...]
    sides: tuple[Side, ...]
    made: Mapping[int, Offer]
    refused: Mapping[int, Offer]

    def joined(self) -> Iterator[tuple[int, int]]:
        """Rows of the ends that join something, each with a part that it joins; one in a sleeve doesn't."""
        part = self.ends.part
        for facing in self.facings:
            yield facing.first, int(part[facing.second])
            yield facing.second, int(part[facing.first])
        yield from ((row, int(part[twin])) for row, twin in self.doubled)
        yield from ((tapped.row, tapped.part) for tapped in self.taps if not tapped.tap.sleeve)
        yield from ((mount.row, mount.part) for mount in self.mounts)


def attach_lines(
    parts: Parts,
    contacts: Contacts,
    lines: Mapping[int, Centreline],
    solids: Collection[int],
    feet: Collection[int],
    bridge: float,
    bolted: Collection[tuple[int, int]] = (),
    stated: Stated | None = None,
) -> Attachments:
    """Finds for each end of a line what it joins.

    Args:
        parts: parts of the scene.
        contacts: pairs of parts that are near.
        lines: centreline of each part that carries one.
        solids: parts without a line that lines may end at: those of units, and connectors of odd shape.
        feet: solids that may sit on the side of a line: parts of gauges.
        bridge: gap up to which ends that face each other join without other evidence [m].
        bolted: pairs of parts that one fastener touches both of.
        stated: what the file says of joints, where that counts.
    """
    ends = gather_ends(lines)
    solid = set(solids)
    around = Surroundings(contacts, bridge, set(_shut(contacts, lines, solid)), bolted, stated or Stated())
    ahead = EndsAhead(ends, ends_about(ends, around))
    faces = offer_faces(ends, around, ahead)
    settled = settle_faces(faces)
    loose = {row for row in range(len(ends.part)) if row not in settled}
    mounts, sides, spare = _mounts(parts, contacts, lines, solid, set(feet), ends, loose, ahead)
    near = _neighbors(contacts, lines)
    singles = {
        row: [
            *mounts.get(row, ()),
            *offer_taps(ends, row, lines, near.get(int(ends.part[row]), ()), bridge),
        ]
        for row in sorted(loose)
    }
    if around.stated:
        singles = _with_witness(parts, lines, solid, ends, singles, ahead, around)
    decision = decide_joints(faces, singles, settled)
    doubled = _double(ends, decision.joined, near, bridge)
    mounted = {offer.other for offer in decision.joined.values() if offer.kind == "mount"}
    # On a short spool a gauge may stand near an end that then joins another.
    sides = (*sides, *(side for side in spare if side.solid not in mounted))
    return _attached(ends, decision, doubled, sides)


def _with_witness(
    parts: Parts,
    lines: Mapping[int, Centreline],
    solids: set[int],
    ends: Ends,
    singles: Mapping[int, Sequence[Offer]],
    ahead: EndsAhead,
    around: Surroundings,
) -> dict[int, list[Offer]]:
    """The offers of each end at solids and sides of lines with what the file says of them, and those that only the file
    makes possible.
    """
    found: dict[int, list[Offer]] = {}
    for row, offers in singles.items():
        known = {offer.other for offer in offers}
        others = [part for part in around.stated.partners(int(ends.part[row])) if part not in known]
        found[row] = [bear_witness(offer, ends, offer.other, around.stated) for offer in offers]
        found[row] += _far_taps(ends, row, {part: lines[part] for part in others if part in lines}, around)
        found[row] += _far_mounts(parts, ends, row, [part for part in others if part in solids], ahead, around.stated)
    return found


def _far_taps(ends: Ends, row: int, lines: Mapping[int, Centreline], around: Surroundings) -> list[Offer]:
    """The sides of lines that the file joins an end to, farther off than geometry alone would look."""
    offers = offer_taps(ends, row, lines, [(part, REACH - around.bridge) for part in lines], around.bridge)
    return [bear_witness(offer, ends, offer.other, around.stated) for offer in offers]


def _far_mounts(
    parts: Parts, ends: Ends, row: int, solids: Sequence[int], ahead: EndsAhead, stated: Stated
) -> list[Offer]:
    """The solids before an end that the file joins it to, farther off than geometry alone would look."""
    point, direction, radius = ends.point[row], ends.direction[row], float(ends.radius[row])
    low, high = point - REACH - radius, point + REACH + radius
    boxes = parts.properties.aabb
    offers = []
    for solid in solids:
        if np.any(boxes[solid, 1] < low) or np.any(boxes[solid, 0] > high):
            continue
        vertices, faces = parts.scene.mesh(solid)
        met = mouth_gap(vertices[faces], point, direction, radius)
        part = int(ends.part[row])
        if met is not None and not is_hidden(ahead.of(row), met[0], (part,)):
            said = stated.by(part, solid) or ""
            offers.append(offer_far_mount(row, solid, *met, radius, said))
    return offers


def _attached(
    ends: Ends, decision: Decision, doubled: Sequence[tuple[int, int]], sides: tuple[Side, ...]
) -> Attachments:
    """What joins what, by kind of joint; ends that have a twin join nothing of their own."""
    twins = dict(doubled)
    made = {row: offer for row, offer in decision.joined.items() if row not in twins}
    singles = singles_of(made)
    return Attachments(
        ends=ends,
        facings=facings_of(made),
        doubled=tuple(doubled),
        taps=tuple(Tapped(row, o.other, o.tap, o.score) for row, o in singles if o.tap is not None),
        mounts=tuple(Mount(row, o.other, o.gap, o.score) for row, o in singles if o.kind == "mount"),
        sides=sides,
        made=made,
        refused={row: offer for row, offer in decision.refused.items() if row not in twins},
    )


def facings_of(made: Mapping[int, Offer]) -> tuple[Facing, ...]:
    """The joints between two ends, the surest first."""
    # Of a joint's two ends the first is enough, unless that one has another joint.
    firsts = [
        offer for row, offer in made.items()
        if offer.of_two_ends and (row == offer.row or made.get(offer.row) is not offer)
    ]  # fmt: skip
    faces = list({(offer.row, offer.other): offer for offer in firsts}.values())
    odds = np.array([offer.odds for offer in faces])
    rows = np.array([(offer.row, offer.other) for offer in faces], np.int64).reshape(-1, 2)
    order = np.lexsort((rows[:, 1], rows[:, 0], [-round(value, 6) for value in odds.tolist()]))
    return tuple(
        Facing(offer.row, offer.other, offer.gap, offer.kind == "corner", score)
        for offer, score in zip(map(faces.__getitem__, order.tolist()), scores_of(odds[order]).tolist(), strict=True)
    )


def singles_of(made: Mapping[int, Offer]) -> list[tuple[int, Offer]]:
    """The joints of one end only with the rows of these, ascending: at solids, and on the sides of lines."""
    return sorted(((row, offer) for row, offer in made.items() if not offer.of_two_ends), key=lambda item: item[0])


def _double(
    ends: Ends, made: Mapping[int, Offer], near: Mapping[int, Sequence[tuple[int, float]]], bridge: float
) -> list[tuple[int, int]]:
    """Ends without an own partner that lie where another end lies which looks the same way, and that one."""
    doubled: list[tuple[int, int]] = []
    gone: set[int] = set()
    for row in range(len(ends.part)):
        if row in made and made[row].of_two_ends:
            continue
        there = [r for r in _beside(ends, row, near) if r not in gone and not _is_partner(ends, made.get(r), row)]
        twin = same_place(ends, row, there, max(_TWIN * bridge, _TWIN_SHARE * float(ends.radius[row])))
        if twin is not None and _yields(ends, made, row, twin):
            doubled.append((row, twin))
            gone.add(row)
    return doubled


def _beside(ends: Ends, row: int, near: Mapping[int, Sequence[tuple[int, float]]]) -> list[int]:
    """The ends of near parts whose lines run beside that of an end."""
    others = [r for other, _ in near.get(int(ends.part[row]), ()) for r in ends.of_part[other]]
    return [r for r in others if _run_beside(ends, row, r)]


def _is_partner(ends: Ends, offer: Offer | None, row: int) -> bool:
    """Whether a made joint is one with the other end of the part that an end belongs to, which looks the same way."""
    if offer is None or not offer.of_two_ends:
        return False
    return int(ends.part[row]) in (int(ends.part[offer.row]), int(ends.part[offer.other]))


def _run_beside(ends: Ends, row: int, other: int) -> bool:
    """Whether the lines of two ends that look the same way run beside each other behind them."""
    ahead = float((ends.point[other] - ends.point[row]) @ ends.direction[row])
    shared = min(float(ends.length[row]), float(ends.length[other]) - ahead, float(ends.length[row]) + ahead)
    shared = min(shared, float(ends.length[other]))
    shorter = float(min(ends.length[row], ends.length[other]))
    return shared >= min(_BESIDE, _BESIDE_SHARE * shorter) and shared >= _BESIDE_SHARE * min(shorter, _BESIDE)


def _yields(ends: Ends, made: Mapping[int, Offer], row: int, twin: int) -> bool:
    """Whether of two ends in one place the first gives way: to one that joins another end, or is surer; of two that
    join nothing the one that is not too long to be a flange goes, of equal ones the later.
    """
    mine, theirs = made.get(row), made.get(twin)
    if theirs is None:
        return mine is None and (ends.length[row], row) <= (ends.length[twin], twin)
    if mine is None or theirs.of_two_ends:
        return True
    return (round(mine.odds, 6), -row) < (round(theirs.odds, 6), -twin)


def _neighbors(contacts: Contacts, lines: Mapping[int, Centreline]) -> dict[int, list[tuple[int, float]]]:
    """The parts with lines that are near each part with a line, and how near."""
    found: dict[int, list[tuple[int, float]]] = {}
    for (a, b), distance in zip(contacts.plain_pairs, contacts.distance.tolist(), strict=True):
        if a in lines and b in lines:
            found.setdefault(a, []).append((b, distance))
            found.setdefault(b, []).append((a, distance))
    return found


def _shut(contacts: Contacts, lines: Mapping[int, Centreline], solids: set[int]) -> list[tuple[int, int]]:
    """Pairs of lines that are near one and the same solid: it may lie between them."""
    at_solid: dict[int, list[int]] = {}
    for _, line, solid in _meetings(contacts, lines, solids):
        at_solid.setdefault(solid, []).append(line)
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


def _mounts(
    parts: Parts,
    contacts: Contacts,
    lines: Mapping[int, Centreline],
    solids: set[int],
    feet: set[int],
    ends: Ends,
    loose: set[int],
    ahead: EndsAhead,
) -> tuple[dict[int, list[Offer]], tuple[Side, ...], tuple[Side, ...]]:
    """The solids that each loose end may be at; solids at the sides of lines; and the sides of lines that feet touch
    near an end, where they are if that end joins something else.
    """
    tight: list[int] = []
    wide: list[int] = []
    sides = []

    def may_join(line: int, solid: int) -> bool:
        return solid in feet or any(
            end in loose and _is_near(parts, ends, end, solid) for end in ends.of_part.get(line, ())
        )

    for row, line, solid in _meetings(contacts, lines, solids):
        gap = float(contacts.distance[row])
        if may_join(line, solid):
            (tight if gap <= _TIGHT else wide).append(row)
        else:
            sides.append(_side(lines[line], line, solid, contacts.points[row].mean(axis=0), gap))
    touches = [
        *_touches(parts, contacts, lines, tight, 2 * _TIGHT),
        *_touches(parts, contacts, lines, wide, float(contacts.distance.max(initial=0.0)) + _TIGHT),
    ]
    offers = [_offers_at(touch, ends, ahead) for touch in touches]
    beside, spare = _sides_of(touches, offers, lines, feet)
    return _by_end(offers, loose), (*sides, *beside), tuple(spare)


def _by_end(offers: Sequence[Sequence[Offer]], loose: Collection[int]) -> dict[int, list[Offer]]:
    """The offers of each loose end."""
    found: dict[int, list[Offer]] = {}
    for offer in (offer for some in offers for offer in some if offer.row in loose):
        found.setdefault(offer.row, []).append(offer)
    return found


def _sides_of(
    touches: Sequence[_Touch],
    offers: Sequence[Sequence[Offer]],
    lines: Mapping[int, Centreline],
    feet: Collection[int],
) -> tuple[list[Side], list[Side]]:
    """The sides of lines that solids touch without an end there, and those that feet touch near an end."""
    beside = [_side_of(touch, lines) for touch, some in zip(touches, offers, strict=True) if not some]
    near = [touch for touch, some in zip(touches, offers, strict=True) if some and touch.solid in feet]
    return beside, [_side_of(touch, lines) for touch in near]


def _offers_at(touch: _Touch, ends: Ends, ahead: EndsAhead) -> list[Offer]:
    """The offers of a line's ends at a solid that it touches; none where it does so without an end there."""
    rows = ends.of_part.get(touch.part, ())
    return [offer for end in rows if (offer := _offer(ends, end, touch, ahead)) is not None]


def _side_of(touch: _Touch, lines: Mapping[int, Centreline]) -> Side:
    return _side(lines[touch.part], touch.part, touch.solid, touch.place, touch.gap)


def _meetings(contacts: Contacts, lines: Collection[int], solids: Collection[int]) -> Iterator[tuple[int, int, int]]:
    """The contacts of a part with a line and a solid: row, the former and the latter."""
    for row, (a, b) in enumerate(contacts.plain_pairs):
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
    return Side(solid, part, Tap(number, near[0], near[1], gap, near[3]))


def _offer(ends: Ends, row: int, touch: _Touch, ahead: EndsAhead) -> Offer | None:
    """An end at a solid where the middle of their contact is; None where that is not at the end."""
    direction, radius = ends.direction[row], float(ends.radius[row])
    offset = touch.place - ends.point[row]
    along = float(offset @ direction)
    off = float(np.linalg.norm(offset - along * direction))
    depth = min(max(_DEPTH * radius, _LEAST_DEPTH), 0.5 * float(ends.length[row]))
    if not -depth - 0.001 <= along <= touch.gap + 0.5 * radius + 0.005 or off > _OFF * radius + touch.gap:
        return None
    facing = None if touch.normal is None else float(touch.normal @ direction)
    if facing is not None and along < 0:
        # Where one runs into the other, which side of the contact is whose can't be told.
        facing = abs(facing)
    if facing is not None and facing < _AGREES:
        return None
    hidden = touch.gap > _TIGHT and is_hidden(ahead.of(row), touch.gap, (touch.part,))
    return offer_mount(row, touch.solid, touch.gap, along, off, facing, radius, hidden)


def flat_contacts(
    parts: Parts, contacts: Contacts, pairs: Iterable[tuple[int, int]], eps: float, deep: float = _FACE_THIN
) -> dict[tuple[int, int], tuple[Floats, Floats]]:
    """Pairs of parts that are flanged to each other: they meet in a flat round area.

    Args:
        parts: of the scene.
        contacts: pairs of parts that are near.
        pairs: of these, first < second, those that are looked at.
        eps: greatest gap [m].
        deep: how far one may run into the other, as share of the width of the area.

    Returns:
        For each such pair the middle of the area [m] and its normal, from the first to the second.
    """
    rows = sorted(contacts.row_of[pair] for pair in set(pairs) if pair in contacts.row_of)
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
            and thin <= max(deep * wide + 0.002, _FACE_SEEN * eps)
            and wide >= _FACE_SHARE * size
        ):
            found[a, b] = regions.centroid[k], regions.normal[k]
    return found
