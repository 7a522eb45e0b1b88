"""Valves drawn so simply that lines run through them: two cones, a cylinder with a stem."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cadgraph.geometry.line.centreline import Centreline
from cadgraph.model.parts import Bools
from cadgraph.model.scene import Floats
from cadgraph.stages.relate.belief import LEAST, Beliefs
from cadgraph.stages.relate.body_shape import surface_about
from cadgraph.stages.relate.evidence import Curve, Term, tell_terms
from cadgraph.stages.relate.joint import Facing
from cadgraph.stages.relate.line import is_disc
from cadgraph.stages.relate.piping import Group, Piping, Recovered
from cadgraph.stages.relate.prune import likely_devices
from cadgraph.stages.relate.span import length_of

__all__ = ["INLINE", "THICKER", "WAIST", "pipe_radius", "recover_inline"]

WAIST = Curve((0.0, 0.55, 0.8, 0.92), (3.5, 3.5, 2.5, 0.0), "it narrows to {:.0%} in its middle")
"""The narrowest radius of a piece as share of that at its ends, in log-odds that it is a valve: two cones in a plant
model stand for one, and no fitting is narrower in its middle."""

THICKER = Curve((1.1, 1.2, 1.4), (0.0, 5.5, 6.5), "it is {:.2f} times as wide as the pipes beyond its flanges")
"""The radius of a straight piece between two flanges over that of the pipes beyond, in log-odds that it is a valve: no
pipe is wider for the length of a valve. Labels hardly help here: a cylinder looks like a pipe."""

INLINE: Mapping[str, float] = {"base": -2.0, "stem": 2.5, "operator": 3.0, "device": 3.0}
"""The log-odds that a straight piece in a line is a valve, and what adds to them: a stem that leads nowhere, pieces of
a valve that sit on it alone, or that the labeler holds it for a device, of whatever type, and hardly for piping."""

_ON_IT: Mapping[str, str] = {
    "stem": "a stem on it leads nowhere",
    "operator": "pieces of a valve sit on it and on no other line",
    "device": "the labeler takes it for a device and hardly for piping",
}
# Fittings that are as thick or as narrow as valves: no width tells which a piece is, so that the labeler's word counts.
_ALIKE = ("strainer", "expansion joint", "flange", "coupling", "union", "hose")
_BODIES = frozenset({"valve", "valve body"})
_RIVAL = 0.25  # least probability, and more than of a valve, from which on something else may be meant (ours)
_SURE = 0.6  # least probability of what is taken for a valve
_LONGEST = 14.0  # radii that a valve is long at most
_ON_AXIS, _ALIGNED = 0.35, -0.95  # as share of the radius; cosine between the outward directions
_NARROW = 0.7  # the ends of two cones that meet are narrower than their other ends by this factor
# A piece as narrow as at its narrowest for this share of its length (within this factor, in so many slices) is a
# pipe with its flanges in one mesh: cones meet at a point.
_SPOOL, _EVEN, _SLICES = 0.5, 1.08, 12
_MOST_PLATES = 5  # flanges and gaskets at an end
_TOUCH = 0.001  # what is farther from a lever than the piece that it sits on by this is not what it sits on [m]
_THIN = 0.7  # a stem is thinner than the body by this factor


@dataclass(frozen=True)
class _Piece:
    """A straight piece of a line.

    Args:
        parts: that carry it, one or two cones.
        rows: of its two outer ends.
        waist: its narrowest radius as share of that at its ends.
        thicker: its radius over that of the pipes beyond its flanges; 1 where it has none.
    """

    parts: tuple[int, ...]
    rows: tuple[int, int]
    waist: float
    thicker: float = 1.0


def recover_inline(piping: Piping, beliefs: Beliefs, likelihood: Curve) -> Piping:
    """Makes valves of pieces that narrow in the middle or carry a stem, where enough speaks for it.

    Args:
        piping: with all lines.
        beliefs: what each part may be.
        likelihood: what the logarithm of the labeler's probability adds.
    """
    valves = piping.given.vocabulary.groups_of("valve")
    if not valves:
        return piping
    likely = beliefs.of_groups(valves)
    others, devices = _rivals(piping, beliefs), likely_devices(piping, beliefs)
    anything = tuple(_ON_IT)
    taken: set[int] = set()
    groups: list[Group] = []
    recovered = dict(piping.recovered)
    for piece in _pieces(piping, beliefs):
        share = max(float(likely[list(piece.parts)].mean()), LEAST)
        said = likelihood.at_one(float(np.log(share)))
        other = float(others[list(piece.parts)].mean(axis=0).max())
        rival = None if other < max(_RIVAL, share) else likelihood.at_one(float(np.log(other))) - said
        if _sureness(_terms(piece, anything, share, said), anything, rival) < _SURE:
            continue
        on_it = _on_it(piping, beliefs, piece, devices)
        kinds = [kind for kind, parts in on_it.items() if parts]
        terms = _terms(piece, kinds, share, said)
        found = Recovered(_sureness(terms, kinds, rival), tell_terms(terms))
        if found.sure < _SURE or not taken.isdisjoint(piece.parts):
            continue
        parts = tuple(sorted({*piece.parts}.union(*on_it.values()) - taken))
        taken.update(parts)
        groups.append(Group("valve", parts))
        recovered |= dict.fromkeys(parts, found)
    return _with_valves(piping, groups, taken, recovered) if groups else piping


def _rivals(piping: Piping, beliefs: Beliefs) -> Floats:
    """``(n_parts, n)`` how likely each part is of each thing that is no valve and may be shaped like one."""
    vocabulary = piping.given.vocabulary
    types = sorted({kind for kind in vocabulary.unit_of_group.values() if kind != "valve"})
    shares = [*map(beliefs.of_name, _ALIKE), *(beliefs.of_groups(vocabulary.groups_of(kind)) for kind in types)]
    return np.stack(shares, axis=1)


def _terms(piece: _Piece, on_it: Sequence[str], share: float, said: float) -> list[Term]:
    """What speaks for and against a piece being a valve.

    Args:
        piece: the piece.
        on_it: what stands on it, keys of ``INLINE``.
        share: how likely the labeler holds it for a valve.
        said: what that adds.
    """
    terms = [("a straight piece of a line", INLINE["base"]), (f"the labeler gives it {share:.0%}", said)]
    for curve, value in ((WAIST, piece.waist), (THICKER, piece.thicker)):
        given = curve.at_one(value)
        terms += [(curve.says.format(value), given)] if given else []
    return terms + [(_ON_IT[kind], INLINE[kind]) for kind in on_it]


def _sureness(terms: Sequence[Term], on_it: Sequence[str], rival: float | None) -> float:
    """How sure it is that a piece is a valve, 0..1.

    Args:
        terms: what speaks for it.
        on_it: what stands on it.
        rival: what the labeler's word for something else of such a shape adds beyond that for a valve, in log-odds;
            None where there is none.
    """
    total = sum(odds for _, odds in terms)
    odds = float(np.exp(total))
    # Nothing else has pieces of a valve on it.
    alike = total - (INLINE["operator"] if "operator" in on_it else 0.0)
    against = 1 if rival is None else 1 + float(np.exp(alike + rival))
    return odds / (against + odds)


def _with_valves(
    piping: Piping, groups: Sequence[Group], taken: Collection[int], recovered: Mapping[int, Recovered]
) -> Piping:
    """The piping with further groups, whose parts carry no line any more."""
    others = [group for group in piping.groups if not set(group.parts).intersection(taken)]
    return replace(
        piping,
        lines={part: line for part, line in piping.lines.items() if part not in taken},
        lineless=tuple(part for part in piping.lineless if part not in taken),
        groups=(*others, *groups),
        members=piping.members.union(taken),
        recovered=recovered,
    )


def _pieces(piping: Piping, beliefs: Beliefs) -> list[_Piece]:
    """Straight pieces both of whose ends join others: pairs of cones, then single parts."""
    valves = {held for group in piping.groups if group.unit_type == "valve" for held in group.parts}
    single = [
        piece
        for part, line in sorted(piping.lines.items())
        if beliefs.open[part] and (piece := _straight(piping, part, line, valves)) is not None
    ]
    return [*_cones(piping, beliefs), *single]


def _straight(piping: Piping, part: int, line: Centreline, valves: Collection[int]) -> _Piece | None:
    """A part whose two joined ends lie on one axis, no farther apart than those of a valve; ``valves``: their parts."""
    rows = _passing_rows(piping, part, valves)
    if len(rows) != 2:
        return None
    piece = _piece(piping, (part,), (rows[0], rows[1]), 1.0)
    if piece is None:
        return None
    thicker = piece.thicker if is_disc(line) else _thicker(piping, piece)
    waist = _narrowest(line, piping, rows)
    narrows = WAIST.at_one(waist) > 0 and not _is_spool(piping, piece)
    return replace(piece, waist=waist if narrows else 1.0, thicker=thicker)


def _passing_rows(piping: Piping, part: int, valves: Collection[int]) -> list[int]:
    """The joined ends of a part; of more than two those that don't end at a valve: the neck that its yoke stands on."""
    found = piping.joints
    rows = [row for row in found.ends.of_part.get(part, ()) if row in found.made and found.made[row].kind != "sleeve"]
    if len(rows) <= 2:
        return rows
    return [row for row in rows if found.made[row].kind != "mount" or found.made[row].other not in valves]


def _is_spool(piping: Piping, piece: _Piece) -> bool:
    """Whether a piece is as narrow as at its narrowest for most of its length, as a pipe between its flanges is."""
    start, end = (piping.joints.ends.point[row] for row in piece.rows)
    surface = surface_about(piping.given.parts, piece.parts, start, end)
    slices = np.floor((surface.along + 0.5) * _SLICES)
    heights = surface.height
    outer = [heights[slices == k].max() for k in range(_SLICES) if (slices == k).any()]
    return bool(np.sum(outer <= _EVEN * np.min(outer)) >= _SPOOL * len(outer)) if outer else False


def _thicker(piping: Piping, piece: _Piece) -> float:
    """The radius of a piece over that of the wider pipe beyond its flanges; 1 where one has no flange or no pipe."""
    beyond = [_beyond_flange(piping, row) for row in piece.rows]
    widest = max((radius for radius in beyond if radius is not None), default=0.0)
    own = float(min(piping.joints.ends.radius[row] for row in piece.rows))
    return own / widest if None not in beyond and widest > 0 else 1.0


def _beyond_flange(piping: Piping, row: int) -> float | None:
    """The radius of the pipe behind the flanges and gaskets that an end faces; None where there is none of these."""
    offer = piping.joints.made.get(row)
    if offer is None or offer.kind != "face":
        return None
    there = offer.other if offer.row == row else offer.row
    line = piping.lines[int(piping.joints.ends.part[there])]
    return pipe_radius(piping, there) if is_disc(line) else None


def pipe_radius(piping: Piping, row: int) -> float | None:
    """The radius of the pipe that an end is of, or that stands behind the flanges and gaskets that it is of [m]; None
    where no pipe is found behind them.
    """
    found, ends = piping.joints, piping.joints.ends
    for _ in range(_MOST_PLATES):
        part = int(ends.part[row])
        if not is_disc(piping.lines[part]):
            return float(ends.radius[row])
        opposite = [other for other in ends.of_part[part] if other != row]
        offer = found.made.get(opposite[0]) if len(opposite) == 1 else None
        if offer is None or offer.kind != "face":
            return None
        row = offer.other if offer.row == opposite[0] else offer.row
    return None


def _cones(piping: Piping, beliefs: Beliefs) -> list[_Piece]:
    """Pairs of parts whose narrow ends meet."""
    pairs = [_cone_pair(piping, facing) for facing in piping.joints.facings]
    return [piece for piece in pairs if piece is not None and all(beliefs.open[part] for part in piece.parts)]


def _cone_pair(piping: Piping, facing: Facing) -> _Piece | None:
    """Two parts whose ends meet, if these are their narrow ones and their others are joined."""
    found, ends = piping.joints, piping.joints.ends
    inner = (facing.first, facing.second)
    parts = (int(ends.part[facing.first]), int(ends.part[facing.second]))
    others = [[row for row in ends.of_part[part] if row not in inner] for part in parts]
    if any(len(rows) != 1 or rows[0] not in found.made for rows in others):
        return None
    outer = (others[0][0], others[1][0])
    narrow = max(float(ends.radius[row]) for row in inner)
    waist = narrow / min(float(ends.radius[row]) for row in outer)
    return _piece(piping, parts, outer, waist) if waist <= _NARROW else None


def _piece(piping: Piping, parts: tuple[int, ...], rows: tuple[int, int], waist: float) -> _Piece | None:
    ends = piping.joints.ends
    a, b = rows
    if float(ends.direction[a] @ ends.direction[b]) > _ALIGNED:
        return None
    between = ends.point[b] - ends.point[a]
    radius = float(max(ends.radius[a], ends.radius[b]))
    aside = between - (between @ ends.direction[a]) * ends.direction[a]
    near = length_of(aside) <= _ON_AXIS * radius and length_of(between) <= _LONGEST * radius
    return _Piece(parts, rows, waist) if near else None


def _narrowest(line: Centreline, piping: Piping, rows: Sequence[int]) -> float:
    """The least radius on the axis between two ends of a part, as share of the lesser of theirs."""
    ends = piping.joints.ends
    axis = ends.direction[rows[0]]
    one = line.branches[0] if len(line.branches) == 1 else None
    points = one.points if one else np.concatenate([branch.points for branch in line.branches])
    radii = one.radius if one else np.concatenate([branch.radius for branch in line.branches])
    offset = points - ends.point[rows[0]]
    lesser = float(min(ends.radius[row] for row in rows))
    # Where a branch leads off the points of the run are those on its axis, and a branch's first point lies there, too:
    # it is thinner than the run, but not the run.
    run = np.concatenate([np.full(len(branch.points), _along(branch.points, axis)) for branch in line.branches])
    on_axis = (np.linalg.norm(offset - (offset @ axis)[:, None] * axis, axis=1) <= _ON_AXIS * lesser) & run
    return float(radii[on_axis].min()) / lesser if on_axis.any() else 1.0


def _along(points: Floats, axis: Floats) -> bool:
    """Whether a branch runs along an axis."""
    chord = points[-1] - points[0]
    return bool(abs(float(chord @ axis)) >= -_ALIGNED * float(np.linalg.norm(chord)))


def _on_it(piping: Piping, beliefs: Beliefs, piece: _Piece, devices: Bools) -> dict[str, set[int]]:
    """The parts of and on a piece that speak for a valve, by keys of ``INLINE``; ``devices``: what is likely one."""
    return {
        "stem": _stems(piping, beliefs, piece),
        "operator": _operators(piping, piece),
        "device": set(piece.parts) if devices[list(piece.parts)].all() else set(),
    }


def _stems(piping: Piping, beliefs: Beliefs, piece: _Piece) -> set[int]:
    """Parts that stand on a piece and lead nowhere; the piece itself where one is of its own mesh."""
    ends = piping.joints.ends
    thin = _THIN * float(min(ends.radius[row] for row in piece.rows))
    around = {other for own in piece.parts for other in piping.given.neighbors.get(own, ())} - set(piece.parts)
    stems = {part for part in around if beliefs.open[part] and _is_stem(piping, piece, part, thin)}
    return stems | {part for part in piece.parts if _has_stem(piping, piece, part, thin)}


def _operators(piping: Piping, piece: _Piece) -> set[int]:
    """Parts of valves that no line leads to and that sit on a piece and on no other line: a lever, a bonnet; not of a
    valve that has a body of its own, as a cock on a flange has.
    """
    on_it = {other for own in piece.parts for other in piping.given.neighbors.get(own, ())}
    near = [group for group in piping.groups if group.unit_type == "valve" and not on_it.isdisjoint(group.parts)]
    return {part for group in near if _is_piece_of(piping, group, piece) for part in group.parts}


def _is_piece_of(piping: Piping, group: Group, piece: _Piece) -> bool:
    """Whether a group has no body of its own and rests on a piece alone."""
    names = piping.roles.names
    return _BODIES.isdisjoint(names[part] for part in group.parts) and _rests_on(piping, group, piece)


def _rests_on(piping: Piping, group: Group, piece: _Piece) -> bool:
    """Whether no other line leads to a group at a piece, and it touches no other; a lever may pass over one."""
    gaps: dict[int, float] = {}
    for part in group.parts:
        for line in piping.lines_near(part):
            gap = piping.given.gaps[min(part, line), max(part, line)]
            gaps[line] = min(gap, gaps.get(line, gap))
    own = min((gap for line, gap in gaps.items() if line in piece.parts), default=0.0)
    touched = {line for line, gap in gaps.items() if gap <= own + _TOUCH}
    led = {line for part in group.parts for line in piping.mounted.get(part, ())}
    return touched | led <= set(piece.parts)


def _is_stem(piping: Piping, piece: _Piece, part: int, thin: float) -> bool:
    """Whether a part with a line is thin at all its ends, and joins nothing but the side of a piece."""
    found, ends = piping.joints, piping.joints.ends
    rows = ends.of_part.get(part, ())
    leads = [found.made[row] for row in rows if row in found.made]
    on_piece = all(offer.kind == "tap" and offer.other in piece.parts for offer in leads)
    return bool(rows) and on_piece and all(float(ends.radius[row]) <= thin for row in rows)


def _has_stem(piping: Piping, piece: _Piece, part: int, thin: float) -> bool:
    """Whether a part of a piece has a thin end beside those of the line, which joins nothing."""
    found, ends = piping.joints, piping.joints.ends
    beside = [row for row in ends.of_part[part] if row not in piece.rows and row not in found.made]
    return any(float(ends.radius[row]) <= thin for row in beside)
