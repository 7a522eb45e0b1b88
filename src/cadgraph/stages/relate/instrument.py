"""Instruments that labels miss or take for valves: what stands alone on a vessel or on the side of a line."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from cadgraph.geometry.components import connected_sets
from cadgraph.model.scene import Floats
from cadgraph.stages.relate.belief import LEAST, Beliefs
from cadgraph.stages.relate.evidence import score_of, tell_terms
from cadgraph.stages.relate.piping import Group, Piping, Recovered

__all__ = ["ALONE", "take_instruments"]

ALONE = {"vessel": 1.25, "line": 2.3}
"""By how much it makes an instrument likelier than a valve that something stands on a vessel, or on the side of a line,
with no line at it and nothing else beyond, in log-odds: of 700 instruments and 1,292 valves in 60 plants by 14 people
149 and 75 stand so on a vessel, 93 and 17 on a line."""

_VESSELS = frozenset({"tank", "equipment"})
_SURE = 0.6  # least probability of an instrument where labels make nothing of it
_MOST = 3  # parts of an instrument that labels missed


def take_instruments(piping: Piping, beliefs: Beliefs, free: Collection[int]) -> Piping:
    """Makes instruments of lone valves on vessels, and of what nobody names on vessels and on the sides of lines, where
    the labeler thinks of one and this place of one rather than of a valve.

    Args:
        piping: with its units.
        beliefs: what each part may be.
        free: parts of no line and no unit that nobody but the labeler has named, and that no line ends at.
    """
    # All is looked at before anything changes: what stands alone follows from the groups.
    sight = _Sight(piping, beliefs)
    found = [*sight.among_valves(), *sight.among_free(free)]
    if not found:
        return piping
    taken = {part for parts, _ in found for part in parts}
    return replace(
        piping,
        groups=(
            *(group for group in piping.groups if taken.isdisjoint(group.parts)),
            *(Group("gauge", parts) for parts, _ in found),
        ),
        members=piping.members | taken,
        feet=piping.feet | taken,
        recovered={**piping.recovered, **{part: judged for parts, judged in found for part in parts}},
    )


@dataclass(frozen=True)
class _Sight:
    """What is to be seen of parts that may stand alone.

    Args:
        piping: with its units.
        beliefs: what each part may be.
    """

    piping: Piping
    beliefs: Beliefs

    @cached_property
    def _likely(self) -> Floats:
        """``(2, n_parts)`` how likely each part is of an instrument, and of a valve."""
        groups_of = self.piping.given.vocabulary.groups_of
        return np.array([self.beliefs.of_groups(groups_of(kind)) for kind in ("gauge", "valve")])

    def among_valves(self) -> Iterator[tuple[tuple[int, ...], Recovered]]:
        """The valves that are rather instruments: that one is a device, and which of the two, is all that is asked."""
        known = self.piping.recovered.keys()
        for group in self.piping.groups:
            parts = group.parts
            if group.unit_type != "valve" or not self.beliefs.open[list(parts)].all() or not known.isdisjoint(parts):
                continue
            measures, shuts = self._mean(parts)
            odds = ALONE["vessel"] + math.log(measures / shuts)
            if odds > 0 and self._place_of(parts) == "vessel":
                yield parts, _judged("vessel", odds, measures, shuts)

    def among_free(self, free: Collection[int]) -> Iterator[tuple[tuple[int, ...], Recovered]]:
        """The instruments among parts that labels make nothing of, which may be neither of the two as well."""
        pairs = [(a, b) for a, b in self.piping.given.contacts.plain_pairs if a in free and b in free]
        for parts in connected_sets(sorted(free), pairs):
            place = self._place_of(parts) if len(parts) <= _MOST else None
            if place is None:
                continue
            measures, shuts = self._mean(parts)
            # What is neither stands alone no less often than an instrument.
            odds = math.log(measures / (shuts * math.exp(-ALONE[place]) + max(1 - measures - shuts, LEAST)))
            if score_of(odds) >= _SURE:
                yield parts, _judged(place, odds, measures, shuts)

    def _mean(self, parts: Sequence[int]) -> tuple[float, float]:
        measures, shuts = np.maximum(self._likely[:, list(parts)].mean(axis=1), LEAST).tolist()
        return measures, shuts

    def _place_of(self, parts: Sequence[int]) -> str | None:
        """What some parts stand alone on: ``"vessel"``, ``"line"``, or None: a line ends at them or they touch more."""
        near = self.piping.touched(parts)
        if not near or not self.piping.mounted.keys().isdisjoint(parts):
            return None
        owners = {self.piping.owner.get(part) for part in near}
        owner = owners.pop() if len(owners) == 1 else None
        if owner is not None and owner.unit_type in _VESSELS:
            return "vessel"
        return "line" if len(near) == 1 and near <= self.piping.lines.keys() else None


def _judged(place: str, odds: float, measures: float, shuts: float) -> Recovered:
    """How sure it is that something is an instrument, and why."""
    terms = [
        (f"it stands alone on a {place}", ALONE[place]),
        (f"the labeler gives an instrument {measures:.0%}, a valve {shuts:.0%}", math.log(measures / shuts)),
    ]
    return Recovered(score_of(odds), tell_terms(terms))
