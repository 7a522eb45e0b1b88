"""Joints that may be made: every end of a line with each end, side of a line and solid that it may belong to."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import compress
from types import MappingProxyType
from typing import Any, Literal, NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from cadgraph.geometry.line.centreline import Centreline
from cadgraph.model.derived import kept_with
from cadgraph.model.parts import Bools, Contacts
from cadgraph.model.records import BY_USER, CUT
from cadgraph.model.scene import Floats, Ints, blocks, ranges
from cadgraph.stages.relate.evidence import CURVES, FLAGS, add_up, add_up_one, score_of, tell
from cadgraph.stages.relate.joint import Ends, Tap, find_tap
from cadgraph.stages.relate.stated import REACH, Stated

__all__ = [
    "Ahead",
    "EndsAhead",
    "Offer",
    "Surroundings",
    "bear_witness",
    "ends_about",
    "is_hidden",
    "near_ends",
    "offer_faces",
    "offer_far_mount",
    "offer_mount",
    "offer_taps",
]

# Ends that face each other look against each other at least so (cosine), and their axes are apart by at most this share
# of the lesser radius, or this much [m] where that is more.
_OPPOSED, _OFFSET, _LEAST_OFFSET = -0.85, 0.5, 0.003
# Overlaps as deep as a weld's count as touching [m]; one end lies within the other by at most so many greater radii.
_OVERLAP, _DEEPEST = 0.004, 2.0
# Gaps are looked at up to this many times the setting: beyond it only with other evidence.
_REACH = 2.0
# Two straight pipes may meet in a corner without an elbow: their axes pass each other this near, as share of the lesser
# radius, and both ends lie within this many greater radii of that corner.
_CORNER, _CORNER_REACH, _EQUAL_SIZE = 0.4, 1.5, 0.9
# Where a solid is near both, a wider gap [m] may be its own place: no wafer valve is thinner.
_BESIDE = 0.006
# Ends are beside each other on one axis where these are apart by at most this share of the lesser radius, and one lies
# before another from this distance on [m].
_ON_AXIS, _BEFORE = 0.5, 3e-4
# A line shorter than this many of its radii is that of a flange, a gasket or the like.
_DISC = 1.6
# Gaps within this much of each other are alike [m]; so many make a habit, and none that is narrower is one.
_ALIKE, _HABIT, _LEAST_HABIT = 0.0004, 5, 0.001

_OF_GAP = ("gap", "wide")  # what is measured of a gap
_AT_ONCE = 32_768  # pairs of ends that are looked at at once: what stays in a processor's cache is looked at faster
_THINKABLE = -4.0  # log-odds below which nobody would ask why a joint was not made

Kind = Literal["face", "corner", "mount", "tap", "sleeve"]


class Measured(Mapping[str, float]):
    """The quantities of one of many joints: a row of columns, as few are ever asked for theirs.

    Args:
        columns: ``(n,)`` each quantity of all.
        row: the joint.
    """

    __slots__ = ("_columns", "_row")

    def __init__(self, columns: Mapping[str, Floats], row: int) -> None:
        self._columns, self._row = columns, row

    def __getitem__(self, name: str) -> float:
        return float(self._columns[name][self._row])

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)


class Offer(NamedTuple):
    """A joint that may be made; large scenes have a million, so it is made as cheaply as can be.

    Args:
        kind: ``face`` (end to end), ``corner`` (likewise, at an angle), ``mount`` (an end at a solid), ``tap`` (an end
            on the side of a line) or ``sleeve`` (an end along the side of a line).
        row: the end.
        other: the other end, or the part.
        gap: between the two [m], negative where one lies in the other.
        odds: the log-odds that they join.
        measured: the quantities that speak for or against it.
        flags: what else does.
        tap: the place, for taps and sleeves.
        said: by what the file joins the two, where it does.
    """

    kind: Kind
    row: int
    other: int
    gap: float
    odds: float
    measured: Mapping[str, float] = MappingProxyType({})
    flags: tuple[str, ...] = ()
    tap: Tap | None = None
    said: str = ""

    @property
    def score(self) -> float:
        """How sure it is, 0..1."""
        return score_of(self.odds)

    @property
    def of_two_ends(self) -> bool:
        """Whether the other is an end, too."""
        return self.kind in ("face", "corner")

    def part(self, ends: Ends) -> int:
        """The part that the end would join."""
        return int(ends.part[self.other]) if self.of_two_ends else self.other

    @property
    def reasons(self) -> tuple[str, ...]:
        """What speaks for and against it, in words."""
        if self.flags in ((BY_USER,), (CUT,)):
            return self.flags
        return tell(self.measured, self.flags, self.said)


@dataclass(frozen=True)
class Surroundings:
    """What lies around the lines.

    Args:
        contacts: pairs of parts that are near.
        bridge: gap up to which ends join without other evidence [m].
        blocked: pairs of parts with a solid near both.
        bolted: pairs of parts that one fastener touches both of.
        stated: what the file says of joints.
    """

    contacts: Contacts
    bridge: float
    blocked: Collection[tuple[int, int]] = ()
    bolted: Collection[tuple[int, int]] = ()
    stated: Stated = field(default_factory=Stated)


@dataclass(frozen=True)
class Ahead:
    """An end that lies on the axis of another one, beside or before it.

    Args:
        row: of the end.
        part: that carries its line.
        distance: along the axis [m].
        alike: whether it looks the same way.
    """

    row: int
    part: int
    distance: float
    alike: bool


class EndsAhead:
    """For each end those of near ends that lie on its axis, not behind it; told one end at a time.

    Args:
        ends: of all lines.
        pairs: ``(n, 2)`` rows of ends that are near each other.
    """

    def __init__(self, ends: Ends, pairs: Ints) -> None:
        both = (pairs, pairs[:, ::-1])
        found = [_on_axis(ends, *rows[some].T) for rows in both for some in blocks(max(1, len(pairs)), _AT_ONCE)]
        row, other, distance, alike = (np.concatenate(column) for column in zip(*found, strict=True))
        order = np.argsort(row, kind="stable")
        self._first = np.searchsorted(row[order], np.arange(len(ends.part) + 1))
        self._row, self._part = other[order], ends.part[other[order]]
        self._distance, self._alike = distance[order], alike[order]

    def of(self, row: int) -> list[Ahead]:
        """The ends before one."""
        cut = slice(int(self._first[row]), int(self._first[row + 1]))
        columns = self._row[cut], self._part[cut], self._distance[cut], self._alike[cut]
        return [Ahead(*one) for one in zip(*(column.tolist() for column in columns), strict=True)]

    def hide(self, pairs: Ints, gap: Floats, own: Ints) -> Bools:
        """``(n,)`` what ``is_hidden`` says of either end of each pair.

        Args:
            pairs: ``(n, 2)`` rows of ends.
            gap: ``(n,)`` between the two [m].
            own: ``(n, 2)`` their parts.
        """
        row = pairs.ravel()
        number = self._first[row + 1] - self._first[row]
        pair = np.repeat(np.arange(len(row)), number) // 2
        one = ranges(self._first[row], number)
        other = (self._part[one][:, None] != own[pair]).all(axis=1)
        within = _lies_within(gap[pair], self._distance[one], self._alike[one])
        return np.bincount(pair[other & within], minlength=len(pairs)) > 0


def _on_axis(ends: Ends, row: Ints, other: Ints) -> tuple[Ints, Ints, Floats, Bools]:
    """Of pairs of ends those whose second lies on the axis of the first, not behind it.

    Returns:
        Both rows, how far ahead the second lies [m], and whether it looks the same way.
    """
    direction = ends.direction[row]
    cosine = np.einsum("ij,ij->i", direction, ends.direction[other])
    along = np.abs(cosine) >= -_OPPOSED
    row, other, direction = row[along], other[along], direction[along]
    between = ends.point[other] - ends.point[row]
    distance = np.einsum("ij,ij->i", between, direction)
    off = np.linalg.norm(between - distance[:, None] * direction, axis=1)
    near = (off <= _ON_AXIS * np.minimum(ends.radius[row], ends.radius[other])) & (distance > -_BEFORE)
    return row[near], other[near], distance[near], cosine[along][near] > 0


def is_hidden(ahead: Sequence[Ahead], gap: float, own: Collection[int]) -> bool:
    """Whether the end of another part lies in a gap: one before this end, or before what it would join."""
    return any(one.part not in own and _lies_within(gap, one.distance, one.alike) for one in ahead)


def _lies_within(gap: Any, distance: Any, alike: Any) -> Any:
    """Whether an end at a distance on the axis lies in a gap; of numbers or of arrays."""
    return (alike & (distance > _BEFORE) & (distance <= gap + _BEFORE)) | ((alike ^ True) & (distance < gap - _BEFORE))


def offer_faces(ends: Ends, around: Surroundings, ahead: EndsAhead | None = None) -> list[Offer]:
    """The pairs of ends that may face each other; also some that more speaks against than for, which are never made but
    say why.

    Args:
        ends: of all lines.
        around: what lies around them.
        ahead: what lies on the axis of each end, found here if None.
    """
    pairs = near_ends(ends, around)
    if not len(pairs):
        return []
    ahead = EndsAhead(ends, pairs) if ahead is None else ahead
    cosine = _cosine(ends, pairs)
    found = _faces(ends, pairs[cosine <= _OPPOSED], around, ahead) + _corners(ends, pairs, cosine, around.bridge)
    return _witnessed(ends, found, around.stated) if around.stated else found


def _cosine(ends: Ends, pairs: Ints) -> Floats:
    """``(n,)`` of the angle between the ends of each pair."""
    cosine = np.empty(len(pairs))
    for some in blocks(len(pairs), _AT_ONCE):
        first, second = pairs[some].T
        cosine[some] = np.einsum("ij,ij->i", ends.direction[first], ends.direction[second])
    return cosine


def _faces(ends: Ends, pairs: Ints, around: Surroundings, ahead: EndsAhead) -> list[Offer]:
    """The offers of pairs of ends that look against each other.

    Args:
        ends: of all lines.
        pairs: ``(n, 2)`` rows.
        around: what lies around them.
        ahead: what lies on the axis of each end.
    """
    measured, gap, straight = _measure(ends, pairs)
    pairs, gap = pairs[straight], gap[straight]
    measured = {name: values[straight] for name, values in measured.items()}
    flags = _flags(ends, pairs, gap, around, ahead)
    # The width of a flange says nothing of its pipe's.
    measured["size"] = np.where(flags["disc"], np.nan, measured["size"])
    odds = add_up("face", measured, {name: holds.astype(float) for name, holds in flags.items()})
    flags["habit"] = _habitual(gap, odds > 1.0)
    odds = odds + flags["habit"] * FLAGS["habit"][0]
    thinkable = (odds > _THINKABLE) | _are_stated(ends, pairs, around.stated)
    quantities = {name: values[thinkable] for name, values in measured.items()}
    rows = zip(pairs[thinkable].tolist(), gap[thinkable].tolist(), odds[thinkable].tolist(), strict=True)
    holding = zip(*(holds[thinkable].tolist() for holds in flags.values()), strict=True)
    return [
        Offer("face", row, other, wide, sure, Measured(quantities, k), tuple(compress(flags, holds)))
        for k, (((row, other), wide, sure), holds) in enumerate(zip(rows, holding, strict=True))
    ]


def _are_stated(ends: Ends, pairs: Ints, stated: Stated) -> Bools:
    """Which pairs of ends belong to parts that the file joins."""
    if not stated:
        return np.zeros(len(pairs), np.bool_)
    parts = ends.part[pairs].tolist()
    return np.array([stated.by(a, b) is not None for a, b in parts], np.bool_)


def _witnessed(ends: Ends, offers: Sequence[Offer], stated: Stated) -> list[Offer]:
    """Offers between two ends with what the file says of them, without those that nobody would ask about."""
    heard = [bear_witness(offer, ends, int(ends.part[offer.other]), stated) for offer in offers]
    return [offer for offer in heard if offer.odds > _THINKABLE]


def bear_witness(offer: Offer, ends: Ends, other: int, stated: Stated) -> Offer:
    """An offer with what the file says of it.

    Args:
        offer: as geometry has it.
        ends: of all lines.
        other: the part that the end would join.
        stated: what the file says.
    """
    part = int(ends.part[offer.row])
    said = stated.by(part, other)
    if said is None:
        n_ends = len(ends.of_part.get(part, ())), len(ends.of_part.get(other, ()))
        denied = stated.is_complete(part, n_ends[0]) and stated.is_complete(other, n_ends[1])
        flags = (*offer.flags, "unstated") if denied else offer.flags
        return offer._replace(odds=offer.odds + FLAGS["unstated"][0], flags=flags) if denied else offer
    if "hidden" in offer.flags:
        # The file joins them through what lies between.
        return offer
    return _across(offer._replace(odds=offer.odds + FLAGS["stated"][0], flags=(*offer.flags, "stated"), said=said))


def _across(offer: Offer) -> Offer:
    """An offer in whose gap the file's word counts where it explains more of it than geometry alone does."""
    gap = offer.measured.get("gap", float("nan"))
    # "over" tells of the gap too, though it is a flag.
    terms = [float(CURVES[name](offer.measured.get(name, float("nan")))) for name in _OF_GAP]
    gain = float(CURVES["far"](gap)) - sum(terms) - FLAGS["over"][0] * ("over" in offer.flags)
    if not gap > 0 or gain <= 0:
        return offer
    left = {name: value for name, value in offer.measured.items() if name not in _OF_GAP}
    flags = tuple(name for name in offer.flags if name != "over")
    return offer._replace(odds=offer.odds + gain, measured={"far": gap, **left}, flags=flags)


def _flags(ends: Ends, pairs: Ints, gap: Floats, around: Surroundings, ahead: EndsAhead) -> dict[str, Bools]:
    """What holds of each pair of ends that face each other, but for habit.

    Args:
        ends: of all lines.
        pairs: ``(n, 2)`` rows.
        gap: ``(n,)`` [m].
        around: what lies around them.
        ahead: what lies on the axis of each end.
    """
    parts = np.sort(ends.part[pairs], axis=1)

    def among(known: Collection[tuple[int, int]], possible: Bools) -> Bools:
        found = np.zeros(len(pairs), np.bool_)
        found[possible] = [(a, b) in known for a, b in parts[possible].tolist()]
        return found

    hidden = gap > 2 * _BEFORE
    hidden[hidden] = ahead.hide(pairs[hidden], gap[hidden], parts[hidden])
    return {
        "hidden": hidden,
        "disc": _is_disc(ends, pairs[:, 0]) | _is_disc(ends, pairs[:, 1]),
        "blocked": among(around.blocked, gap > min(_BESIDE, around.bridge)),
        "over": gap > around.bridge + 1e-9,
        "bolted": among(around.bolted, gap > _OVERLAP),
    }


def _measure(ends: Ends, pairs: Ints) -> tuple[dict[str, Floats], Floats, Bools]:
    """The quantities of pairs of ends that look against each other, the gap from the first to the second [m], and
    whether they face each other.
    """
    i, j = pairs.T
    between = ends.point[j] - ends.point[i]
    axis = ends.direction[i] - ends.direction[j]
    axis /= np.maximum(np.linalg.norm(axis, axis=1, keepdims=True), 1e-12)
    gap = np.einsum("ij,ij->i", between, axis)
    off = np.linalg.norm(between - gap[:, None] * axis, axis=1)
    lesser, greater = np.minimum(ends.radius[i], ends.radius[j]), np.maximum(ends.radius[i], ends.radius[j])
    shorter = np.minimum(ends.length[i], ends.length[j])
    inside = -gap > _OVERLAP
    # What is a few millimetres off a small axis is drawn so, not meant.
    share = np.where(off <= _LEAST_OFFSET, np.minimum(off / lesser, 0.3), off / lesser)
    measured = {
        "gap": np.where(inside, np.nan, np.maximum(gap, 0.0)),
        "wide": np.where(gap > 0, gap / lesser, np.nan),
        "depth": np.where(inside, (-gap - _OVERLAP) / shorter, np.nan),
        "angle": np.degrees(np.arccos(np.clip(-_cosine(ends, pairs), -1, 1))),
        "offset": share,
        "size": lesser / greater,
    }
    faces = off <= np.maximum(_OFFSET * lesser, _LEAST_OFFSET)
    return measured, gap, faces & (-gap <= _OVERLAP + np.minimum(1.03 * shorter, _DEEPEST * greater))


def _is_disc(ends: Ends, rows: Ints) -> Bools:
    return ends.length[rows] < _DISC * ends.radius[rows]


def _habitual(gap: Floats, likely: Bools) -> Bools:
    """Which gaps recur among the likely joints: what a plant repeats, it means."""
    known = np.sort(gap[likely & (gap > _LEAST_HABIT)])
    count = np.searchsorted(known, gap + _ALIKE) - np.searchsorted(known, gap - _ALIKE)
    return np.asarray((gap > _LEAST_HABIT) & (count >= _HABIT))


@kept_with
def near_ends(ends: Ends, around: Surroundings) -> Ints:
    """Pairs of ends of parts that are near each other, or that are near each other themselves."""
    if not len(ends.part):
        return np.zeros((0, 2), np.int64)
    tree = cKDTree(ends.point)
    near = tree.query_pairs(_REACH * around.bridge, output_type="ndarray")
    apart = near[ends.part[near[:, 0]] != ends.part[near[:, 1]]]
    return _distinct([_ends_of_pairs(ends, around.contacts.pairs), apart, _near_stated(ends, tree, around.stated)])


def _ends_of_pairs(ends: Ends, pairs: Ints) -> Ints:
    """Each end of one part with each of the other's, for pairs of parts."""
    # Rows of ends are in the order of their parts.
    first, last = np.searchsorted(ends.part, pairs), np.searchsorted(ends.part, pairs, side="right")
    count = last - first
    n_pairs = count.prod(axis=1)
    which = np.repeat(np.arange(len(pairs)), n_pairs)
    p, q = np.divmod(ranges(np.zeros_like(n_pairs), n_pairs), count[which, 1])
    return np.stack([first[which, 0] + p, first[which, 1] + q], axis=1)


def _distinct(pairs: Sequence[Ints]) -> Ints:
    """Pairs of rows, the lesser first, each once and in their order."""
    both = np.concatenate(pairs)
    if not len(both):
        return both
    n_rows = int(both.max()) + 1
    first, second = both.T
    keys = np.sort(np.minimum(first, second) * n_rows + np.maximum(first, second))
    # numpy's own way to single values out takes fifty times as long as sorting them.
    keys = keys[np.concatenate([[True], keys[1:] != keys[:-1]])]
    return np.stack(np.divmod(keys, n_rows), axis=1)


def _near_stated(ends: Ends, tree: cKDTree, stated: Stated) -> Ints:
    """Pairs of ends that a link of the file reaches."""
    pairs = tree.query_pairs(REACH, output_type="ndarray") if stated else np.zeros((0, 2), np.int64)
    return pairs[_are_stated(ends, pairs, stated)]


def ends_about(ends: Ends, around: Surroundings) -> Ints:
    """Pairs of near ends; where the file joins ends farther apart, also those with all that may lie between them."""
    near = near_ends(ends, around)
    if not around.stated or not len(near):
        return near
    joined = np.zeros(len(ends.part), np.bool_)
    joined[near[_are_stated(ends, near, around.stated)]] = True
    wider = cKDTree(ends.point).query_pairs(REACH, output_type="ndarray")
    apart = ends.part[wider[:, 0]] != ends.part[wider[:, 1]]
    return _distinct([near, wider[apart & joined[wider].any(axis=1)]])


def _corners(ends: Ends, pairs: Ints, cosine: Floats, bridge: float) -> list[Offer]:
    """The offers of pairs of ends of one size that meet at an angle: mitred or simply run into each other."""
    # What is sooner told goes first: few are left then.
    oblique = (cosine > _OPPOSED) & (cosine < 0.5)
    (i, j), cosine = pairs[oblique].T, cosine[oblique]
    greater, lesser = np.maximum(ends.radius[i], ends.radius[j]), np.minimum(ends.radius[i], ends.radius[j])
    equal = (lesser >= _EQUAL_SIZE * greater) & (np.minimum(ends.length[i], ends.length[j]) > 2 * greater)
    i, j, cosine, greater, lesser = (values[equal] for values in (i, j, cosine, greater, lesser))
    between = ends.point[j] - ends.point[i]
    di, dj = ends.direction[i], ends.direction[j]
    det = np.maximum(1 - cosine**2, 1e-9)
    # Where the two axes are nearest to each other, counted from both ends.
    s = (np.einsum("ij,ij->i", between, di) - cosine * np.einsum("ij,ij->i", between, dj)) / det
    t = (cosine * np.einsum("ij,ij->i", between, di) - np.einsum("ij,ij->i", between, dj)) / det
    offset = np.linalg.norm(between + t[:, None] * dj - s[:, None] * di, axis=1)
    reach = _CORNER_REACH * greater + bridge
    meet = (offset <= _CORNER * lesser) & (np.abs(s) <= reach) & (np.abs(t) <= reach)
    rows = zip(i[meet].tolist(), j[meet].tolist(), (lesser / greater)[meet].tolist(), strict=True)
    return [_corner(row, other, size) for row, other, size in rows]


def _corner(row: int, other: int, size: float) -> Offer:
    odds = float(add_up("corner", {"size": np.array([size])})[0]) + float(CURVES["gap"](0.0))
    return Offer("corner", row, other, 0.0, odds, {"size": size})


def offer_far_mount(row: int, solid: int, gap: float, off: float, radius: float, said: str) -> Offer:
    """An end before a solid that it doesn't come near, but that the file joins it to.

    Args:
        row: the end.
        solid: the part.
        gap: from the end to the solid along the pipe's wall [m].
        off: of what the wall meets from the axis [m].
        radius: of the end [m].
        said: by what the file joins them.
    """
    measured = {"far": gap, "off": off / radius}
    odds = add_up_one("mount", measured)
    return Offer("mount", row, solid, gap, odds + FLAGS["stated"][0], measured, ("stated",), said=said)


def offer_mount(
    row: int, solid: int, gap: float, along: float, off: float, facing: float | None, radius: float, hidden: bool
) -> Offer:
    """An end at a solid.

    Args:
        row: the end.
        solid: the part.
        gap: distance between the surfaces [m].
        along: of the middle of the contact from the end, outward along the axis [m].
        off: of that middle from the axis [m].
        facing: cosine between the direction of the end and the normal of the contact; None where it is not sure.
        radius: of the end [m].
        hidden: whether the end of another part lies between.
    """
    measured = {
        "gap": gap,
        "wide": gap / radius,
        "off": max(0.0, off - gap) / radius,
        "behind": abs(along) / max(radius, 0.02),
        "facing": float("nan") if facing is None else facing,
    }
    flags = ("hidden",) if hidden else ()
    odds = add_up_one("mount", measured)
    return Offer("mount", row, solid, gap, odds + sum(FLAGS[name][0] for name in flags), measured, flags)


def offer_taps(
    ends: Ends, row: int, lines: Mapping[int, Centreline], near: Sequence[tuple[int, float]], bridge: float
) -> list[Offer]:
    """The sides of lines that an end may sit on."""
    found = []
    for part, gap in near:
        tap = find_tap(ends, row, lines[part], gap + bridge)
        if tap is not None:
            found.append(_tap_offer(ends, row, part, tap, lines[part]))
    return found


def _tap_offer(ends: Ends, row: int, part: int, tap: Tap, line: Centreline) -> Offer:
    branch = line.branches[tap.branch]
    offset = tap.point - ends.point[row]
    direction = ends.direction[row]
    miss = float(np.linalg.norm(offset - float(offset @ direction) * direction))
    wall = max(tap.wall, 1e-6)
    to_end = float("inf") if branch.closed else min(tap.s, branch.length - tap.s)
    measured = {"miss": miss / wall, "gap": max(0.0, tap.gap), "wide": max(0.0, tap.gap) / float(ends.radius[row])}
    if not tap.sleeve:
        measured["near end"] = min(to_end / wall, 9.0)
    kind: Kind = "sleeve" if tap.sleeve else "tap"
    odds = add_up_one(kind, measured)
    return Offer(kind, row, part, tap.gap, odds, measured, (), tap)
