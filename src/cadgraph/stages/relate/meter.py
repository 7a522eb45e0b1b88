"""Flow meters that labels take for valves: bodies in a line that carry a transmitter and nothing that moves."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial

from cadgraph.stages.relate.belief import LEAST, Beliefs
from cadgraph.stages.relate.evidence import score_of, tell_terms
from cadgraph.stages.relate.piping import Group, Piping, Recovered

__all__ = ["CARRIES", "take_meters"]

CARRIES = 3.0
"""By how much a transmitter on a body without operator, stem or bonnet makes it likelier that it measures than that it
shuts, in log-odds: what a valve carries moves it."""

_METER, _TRANSMITTER = "flow meter", "transmitter"
_SURE = 0.6  # least probability of what is taken for a meter
_ENDS = 2  # of lines at a meter


def take_meters(piping: Piping, beliefs: Beliefs) -> Piping:
    """Makes flow meters of lone valve bodies that the labeler nearly took for one and that a transmitter sits on.

    Args:
        piping: with its units.
        beliefs: what each part may be.
    """
    # All is looked at before anything changes: what joins what follows from the groups.
    found = list(_find_meters(piping, beliefs))
    if not found:
        return piping
    gone = {group for held, _ in found for group in held}
    meters = [Group("gauge", tuple(sorted(part for group in held for part in group.parts))) for held, _ in found]
    bodies = {held[0].parts[0]: judged for held, judged in found}
    return replace(
        piping,
        groups=(*(group for group in piping.groups if group not in gone), *meters),
        feet=piping.feet.union(bodies),
        recovered={**piping.recovered, **bodies},
    )


def _find_meters(piping: Piping, beliefs: Beliefs) -> Iterator[tuple[list[Group], Recovered]]:
    """The groups that are one meter, its body first, and how sure that is; of two bodies the first takes what sits on
    both.
    """
    heads = {part: group for group in piping.groups if _is_head(piping, group) for part in group.parts}
    if not heads:
        return
    shut = beliefs.of_groups(piping.given.vocabulary.groups_of("valve"))
    measures, taken = beliefs.of_name(_METER), set[Group]()
    for body in filter(partial(_may_be_meter, piping, beliefs), piping.groups):
        (part,) = body.parts
        near = {heads[other] for other in heads.keys() & piping.given.neighbors.get(part, ())}.difference(taken)
        judged = _judged(float(shut[part]), float(measures[part]))
        if near and judged.sure >= _SURE:
            taken |= near
            yield [body, *near], judged


def _may_be_meter(piping: Piping, beliefs: Beliefs, group: Group) -> bool:
    """Whether a unit is a single part in a line that only the labeler calls a valve."""
    part = group.parts[0]
    alone = group.unit_type == "valve" and len(group.parts) == 1 and bool(beliefs.open[part])
    return alone and len(piping.mounted.get(part, ())) >= _ENDS


def _is_head(piping: Piping, group: Group) -> bool:
    """Whether a unit is a transmitter that no line leads to."""
    named = any(piping.roles.names[part] == _TRANSMITTER for part in group.parts)
    return group.unit_type == "gauge" and named and piping.mounted.keys().isdisjoint(group.parts)


def _judged(shut: float, measures: float) -> Recovered:
    """How sure it is that a valve's body under a transmitter is a meter, by how likely it is either, and why."""
    shut, measures = max(shut, LEAST), max(measures, LEAST)
    terms = [
        ("a transmitter sits on it, and nothing that moves", CARRIES),
        (f"the labeler gives a flow meter {measures:.0%}, a valve {shut:.0%}", math.log(measures / shut)),
    ]
    return Recovered(score_of(sum(odds for _, odds in terms)), tell_terms(terms))
