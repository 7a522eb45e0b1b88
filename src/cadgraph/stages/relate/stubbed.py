"""Pipes that are set on the side of a line, without a tee or an outlet, and that the labeler took for something else.

A piece of tube that only stands on a pipe has nothing about it that tells a labeler a branch from a post. Geometry
does: it is hollow, its axis meets that of the line, and nothing lies before its other end, as a floor or a plate lies
under a post. Where it is not hollow, or stands where a post would, that stays open: a joint that was not made.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from cadgraph.geometry.line.centreline import Centreline
from cadgraph.model.parts import Joint
from cadgraph.model.probabilities import Probabilities
from cadgraph.model.vocabulary import FASTENERS
from cadgraph.stages.relate.belief import beliefs_of
from cadgraph.stages.relate.cover import cover_of
from cadgraph.stages.relate.joint import Ends, Tap, find_tap, gather_ends
from cadgraph.stages.relate.line import is_steady
from cadgraph.stages.relate.piping import RelateInput
from cadgraph.stages.relate.role import Roles

__all__ = ["Stubbed", "find_stubbed", "likely_stubbed"]

_REACH = 0.01  # greatest gap between the end of a branch and the wall that it is set on [m]
_HOLLOW = 0.3  # least bore of a tube as share of its radius
_DOWN, _LEVEL = 0.94, 0.05  # a post: how upright it is, and within what height of the lowest part it ends [m]
# How sure it is that they join (ours): of a hollow tube that may be a post, and of a solid one.
_TUBE, _SOLID = 0.3, 0.2
# What is no plain tube must be as likely as this to be piping (the labeler's probability).
_LIKELY = 0.4
_VESSELS, _PUMPS = frozenset({"tank", "equipment"}), frozenset({"pump"})


@dataclass(frozen=True)
class Stubbed:
    """What stands on the sides of lines.

    Args:
        lines: of the parts that are branches.
        open: of those that may be, the joint that was not made.
    """

    lines: Mapping[int, Centreline]
    open: tuple[Joint, ...] = ()


def likely_stubbed(given: RelateInput, roles: Roles, piping: Collection[int]) -> list[int]:
    """The parts that only the labeler has named, if anybody, as neither piping nor a device, and that touch some.

    Args:
        given: what everything is found from.
        roles: what each part does.
        piping: parts that carry lines or may.
    """
    functional = given.vocabulary.connector_groups | given.vocabulary.unit_of_group.keys()
    carrying = _parts_of(given, roles, _VESSELS | _PUMPS).union(piping)
    return [
        part
        for part, group in enumerate(roles.groups)
        if group not in functional
        and given.labels[part] is given.opinions[part]
        and not given.parts.ground[part]
        and roles.names[part] not in FASTENERS
        and not carrying.isdisjoint(given.neighbors.get(part, ()))
    ]


def find_stubbed(
    given: RelateInput,
    roles: Roles,
    candidates: Sequence[int],
    traced: Mapping[int, Centreline],
    lines: Mapping[int, Centreline],
) -> Stubbed:
    """The branches that are set on the side of a line.

    Args:
        given: what everything is found from.
        roles: what each part does.
        candidates: parts that may be some.
        traced: line of each part that has one.
        lines: of the parts that carry one already.
    """
    tubes, uneven = _by_shape(candidates, traced, lines)
    loose = [*tubes, *_likely_piping(given, uneven)]
    if not loose:
        return Stubbed({})
    vessels, pumps = _parts_of(given, roles, _VESSELS), _parts_of(given, roles, _PUMPS)
    sight = _Sight(given, gather_ends({part: traced[part] for part in loose}), lines, vessels, pumps)
    found = {part: traced[part] for part in tubes if sight.is_branch(part)}
    return Stubbed(found, tuple(joint for part in loose if part not in found for joint in sight.open_joints(part)))


def _by_shape(
    candidates: Sequence[int], traced: Mapping[int, Centreline], lines: Collection[int]
) -> tuple[list[int], list[int]]:
    """The candidates with a line of one radius that is not one of the network already, and such with one of several."""
    steady = {part: is_steady(traced[part]) for part in candidates if part in traced and part not in lines}
    return [part for part in steady if steady[part]], [part for part in steady if not steady[part]]


def _likely_piping(given: RelateInput, some: Sequence[int]) -> list[int]:
    """Those parts that the labeler finds likely to be piping, without being sure: of several radii, a conical socket on
    the side of a line, with a branch that nobody is sure of either.
    """
    known = given.probabilities
    own = Probabilities(known.classes, known.values[list(some)]) if known is not None else None
    beliefs = beliefs_of([given.labels[part] for part in some], own, given.vocabulary)
    likely = beliefs.of_groups(given.vocabulary.connector_groups).tolist()
    return [part for part, share in zip(some, likely, strict=True) if share >= _LIKELY]


@dataclass(frozen=True, eq=False)
class _Sight:
    """What is looked at.

    Args:
        given: what everything is found from.
        ends: of the tubes that may be branches.
        lines: of the parts that carry one already.
        vessels: parts of tanks and of other equipment.
        pumps: parts of pumps.
    """

    given: RelateInput
    ends: Ends
    lines: Mapping[int, Centreline]
    vessels: frozenset[int]
    pumps: frozenset[int]

    def is_branch(self, part: int) -> bool:
        """Whether a hollow tube is set on the side of a line, and nothing stops it at its other end."""
        taps = self._taps(part)
        if not taps or not self._are_hollow(taps):
            return False
        far = self._others(part, taps)
        return not any(map(self._stands, far)) and not any(map(self._is_post, far))

    def open_joints(self, part: int) -> Iterator[Joint]:
        """The joints that were not made with what may be a branch."""
        taps = self._taps(part)
        yield from self._open_taps(part, taps) if taps else self._open_mounts(part)

    def _open_taps(self, part: int, taps: Mapping[int, tuple[int, Tap]]) -> Iterator[Joint]:
        if any(map(self._stands, self._others(part, taps))):
            return
        for row, (other, tap) in taps.items():
            yield _open(row, other, tap.gap, self.ends, self._are_hollow(taps))

    def _open_mounts(self, part: int) -> Iterator[Joint]:
        mounts = self._mounts(part)
        far = self._others(part, mounts)
        # Lugs, legs and rails are welded to vessels much as pipes are: none of them is taken for one.
        if not mounts or not far or any(map(self._stands, far)) or any(map(self._is_post, far)):
            return
        if not self.pumps.isdisjoint(mounts.values()) and any(map(self._faces_pump, far)):
            return  # the guard of a coupling
        for row, vessel in mounts.items():
            wall = "pump" if vessel in self.pumps else "vessel"
            yield _open(row, vessel, None, self.ends, self._are_hollow(mounts), wall)

    def _taps(self, part: int) -> dict[int, tuple[int, Tap]]:
        """The ends of a part that are set on the side of a line, each with that line's part and where on it."""
        found: dict[int, tuple[int, Tap]] = {}
        for row in self.ends.of_part.get(part, ()):
            on = [
                (other, tap)
                for other in self._near(row)
                if other in self.lines
                and (tap := find_tap(self.ends, row, self.lines[other], _REACH)) is not None
                and not tap.sleeve
            ]
            if on:
                found[row] = min(on, key=lambda one: (one[1].gap, one[0]))
        return found

    def _mounts(self, part: int) -> dict[int, int]:
        """The ends of a part at the wall of a vessel, or inside as a dip tube's, each with that part of the vessel; at
        the casing of a pump those of a hollow tube, as shafts and feet are at it as well.
        """
        found: dict[int, int] = {}
        for row in self.ends.of_part.get(part, ()):
            into = self.vessels | self.pumps if self._are_hollow([row]) else self.vessels
            vessels = [other for other in self._near(row) if other in into]
            walls = [other for other in vessels if self._reaches_in(row, other) or self._is_covered(row, [other])]
            if walls:
                found[row] = walls[0]
        return found

    def _near(self, row: int) -> Sequence[int]:
        """The parts near the one of an end."""
        return self.given.neighbors.get(int(self.ends.part[row]), ())

    def _others(self, part: int, rows: Collection[int]) -> list[int]:
        return [row for row in self.ends.of_part.get(part, ()) if row not in rows]

    def _are_hollow(self, rows: Iterable[int]) -> bool:
        at = [*rows]
        return bool((self.ends.bore[at] >= _HOLLOW * self.ends.radius[at]).all())

    def _is_covered(self, row: int, others: Collection[int]) -> bool:
        return cover_of(self.given.parts, others, self.ends, row) is not None

    def _reaches_in(self, row: int, vessel: int) -> bool:
        """Whether an end lies in the box around a vessel and another one of the same part outside of it."""
        low, high = self.given.parts.properties.aabb[vessel]
        points = self.ends.point[list(self.ends.of_part[int(self.ends.part[row])])]
        outside = ((points < low - _REACH) | (points > high + _REACH)).any()
        return bool((self.ends.point[row] > low).all() and (self.ends.point[row] < high).all() and outside)

    def _stands(self, row: int) -> bool:
        """Whether an end stands on something, or something closes it."""
        near = [other for other in self._near(row) if other not in self.lines and self._is_at(row, other)]
        return any(self.given.parts.ground[other] for other in near) or self._is_covered(row, near)

    def _is_at(self, row: int, other: int) -> bool:
        low, high = self.given.parts.properties.aabb[other]
        reach = float(self.ends.radius[row]) + _REACH
        return bool((self.ends.point[row] >= low - reach).all() and (self.ends.point[row] <= high + reach).all())

    def _faces_pump(self, row: int) -> bool:
        """Whether an end looks at a part of a pump, from no farther than it is wide."""
        ahead = self.ends.point[row] + 2 * self.ends.radius[row] * self.ends.direction[row]
        low, high = np.minimum(ahead, self.ends.point[row]), np.maximum(ahead, self.ends.point[row])
        boxes = self.given.parts.properties.aabb[sorted(self.pumps - {int(self.ends.part[row])})]
        return bool(((boxes[:, 0] <= high) & (boxes[:, 1] >= low)).all(axis=1).any())

    def _is_post(self, row: int) -> bool:
        """Whether an end looks down from as low as anything of its structure lies."""
        if self.ends.direction[row, 2] > -_DOWN:
            return False
        part, cluster = int(self.ends.part[row]), self.given.cluster
        same = np.flatnonzero((cluster == cluster[part]) & ~self.given.parts.ground)
        lowest = float(self.given.parts.properties.aabb[same[same != part], 0, 2].min(initial=np.inf))
        return bool(self.ends.point[row, 2] <= lowest + _LEVEL)


def _parts_of(given: RelateInput, roles: Roles, types: Collection[str]) -> frozenset[int]:
    """The parts of groups of which units of some types are made."""
    unit_of = given.vocabulary.unit_of_group
    return frozenset(part for part, group in enumerate(roles.groups) if group and unit_of.get(group) in types)


def _open(row: int, other: int, gap: float | None, ends: Ends, hollow: bool, wall: str = "vessel") -> Joint:
    x, y, z = (float(value) for value in ends.point[row])
    where = f"it stands on the wall of the {wall}" if gap is None else "it is set on the side of the line"
    why = (where, "it is a hollow tube" if hollow else "it is round, and not seen to be hollow")
    kind: Literal["tap", "mount"] = "mount" if gap is None else "tap"
    return Joint(
        int(ends.part[row]), other, kind, (x, y, z), gap or 0.0, _TUBE if hollow else _SOLID, made=False, reasons=why
    )
