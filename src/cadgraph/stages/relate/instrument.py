"""Instruments that labels miss or take for valves: what stands alone on a vessel or on the side of a line."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace

from cadgraph.geometry.components import connected_sets
from cadgraph.stages.relate.belief import Beliefs
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
_LEAST = 1e-3  # no probability counts for less


def take_instruments(piping: Piping, beliefs: Beliefs, free: Collection[int]) -> Piping:
    """Makes instruments of lone valves on vessels, and of what nobody names on vessels and on the sides of lines, where
    the labeler thinks of one and this place of one rather than of a valve.

    Args:
        piping: with its units.
        beliefs: what each part may be.
        free: parts of no line and no unit that nobody but the labeler has named, and that no line ends at.
    """
    # All is looked at before anything changes: what stands alone follows from the groups.
    found = [*_among_valves(piping, beliefs), *_among_free(piping, beliefs, free)]
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


def _among_valves(piping: Piping, beliefs: Beliefs) -> Iterator[tuple[tuple[int, ...], Recovered]]:
    """The valves that are rather instruments: that one is a device, and which of the two, is all that is asked."""
    for group in piping.groups:
        parts = group.parts
        alone = group.unit_type == "valve" and bool(beliefs.open[list(parts)].all())
        if not alone or not piping.recovered.keys().isdisjoint(parts) or _place_of(piping, parts) != "vessel":
            continue
        measures, shuts = _likely(piping, beliefs, parts)
        odds = ALONE["vessel"] + math.log(measures / shuts)
        if odds > 0:
            yield parts, _judged("vessel", odds, measures, shuts)


def _among_free(piping: Piping, beliefs: Beliefs, free: Collection[int]) -> Iterator[tuple[tuple[int, ...], Recovered]]:
    """The instruments among parts that labels make nothing of, which may be neither of the two as well."""
    pairs = [(a, b) for a, b in piping.given.contacts.plain_pairs if a in free and b in free]
    for parts in connected_sets(sorted(free), pairs):
        place = _place_of(piping, parts) if len(parts) <= _MOST else None
        if place is None:
            continue
        measures, shuts = _likely(piping, beliefs, parts)
        # What is neither stands alone no less often than an instrument.
        odds = math.log(measures / (shuts * math.exp(-ALONE[place]) + max(1 - measures - shuts, _LEAST)))
        if score_of(odds) >= _SURE:
            yield parts, _judged(place, odds, measures, shuts)


def _place_of(piping: Piping, parts: Sequence[int]) -> str | None:
    """What some parts stand alone on: ``"vessel"`` or ``"line"``; None where a line ends at them or they touch more."""
    near = piping.touched(parts)
    if not near or not piping.mounted.keys().isdisjoint(parts):
        return None
    if any(near <= set(group.parts) and group.unit_type in _VESSELS for group in piping.groups):
        return "vessel"
    return "line" if len(near) == 1 and near <= piping.lines.keys() else None


def _likely(piping: Piping, beliefs: Beliefs, parts: Sequence[int]) -> tuple[float, float]:
    """How likely some parts are of an instrument, and of a valve."""
    groups_of, rows = piping.given.vocabulary.groups_of, list(parts)
    said = (float(beliefs.of_groups(groups_of(kind))[rows].mean()) for kind in ("gauge", "valve"))
    measures, shuts = (max(one, _LEAST) for one in said)
    return measures, shuts


def _judged(place: str, odds: float, measures: float, shuts: float) -> Recovered:
    """How sure it is that something is an instrument, and why."""
    terms = [
        (f"it stands alone on a {place}", ALONE[place]),
        (f"the labeler gives an instrument {measures:.0%}, a valve {shuts:.0%}", math.log(measures / shuts)),
    ]
    return Recovered(score_of(odds), tell_terms(terms))
