"""Flow meters that labels take for valves: bodies in a line that carry a transmitter and nothing that moves."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

import numpy as np

from cadgraph.model.scene import Floats
from cadgraph.stages.relate.belief import Beliefs
from cadgraph.stages.relate.evidence import score_of, tell_terms
from cadgraph.stages.relate.piping import Group, Piping, Recovered

__all__ = ["CARRIES", "take_meters"]

CARRIES = 3.0
"""By how much a transmitter on a body without operator, stem or bonnet makes it likelier that it measures than that it
shuts, in log-odds: what a valve carries moves it."""

_METER, _TRANSMITTER = "flow meter", "transmitter"
_SURE = 0.6  # least probability of what is taken for a meter
_ENDS = 2  # of lines at a meter
_LEAST = 1e-3  # no probability counts for less


def take_meters(piping: Piping, beliefs: Beliefs) -> Piping:
    """Makes flow meters of lone valve bodies that the labeler nearly took for one and that a transmitter sits on.

    Args:
        piping: with its units.
        beliefs: what each part may be.
    """
    for body in [group for group in piping.groups if _may_be_meter(piping, beliefs, group)]:
        (part,) = body.parts
        near = piping.given.neighbors.get(part, ())
        heads = [group for group in piping.groups if _is_head(piping, group) and not set(near).isdisjoint(group.parts)]
        found = _judged(piping, beliefs, part)
        if heads and found.sure >= _SURE:
            piping = _with_meter(piping, body, heads, found)
    return piping


def _may_be_meter(piping: Piping, beliefs: Beliefs, group: Group) -> bool:
    """Whether a unit is a single part in a line that only the labeler calls a valve."""
    part = group.parts[0]
    alone = group.unit_type == "valve" and len(group.parts) == 1 and bool(beliefs.open[part])
    return alone and len(piping.mounted.get(part, ())) >= _ENDS


def _is_head(piping: Piping, group: Group) -> bool:
    """Whether a unit is a transmitter that no line leads to."""
    named = any(piping.roles.names[part] == _TRANSMITTER for part in group.parts)
    return group.unit_type == "gauge" and named and piping.mounted.keys().isdisjoint(group.parts)


def _judged(piping: Piping, beliefs: Beliefs, part: int) -> Recovered:
    """How sure it is that a valve's body under a transmitter is a meter, and why."""
    unit_of_group = piping.given.vocabulary.unit_of_group
    valves = beliefs.of_groups({name for name, unit in unit_of_group.items() if unit == "valve"})
    shut, measures = (max(float(said[part]), _LEAST) for said in (valves, _of_name(beliefs, _METER)))
    terms = [
        ("a transmitter sits on it, and nothing that moves", CARRIES),
        (f"the labeler gives a flow meter {measures:.0%}, a valve {shut:.0%}", float(np.log(measures / shut))),
    ]
    return Recovered(score_of(sum(odds for _, odds in terms)), tell_terms(terms))


def _of_name(beliefs: Beliefs, name: str) -> Floats:
    """``(n_parts,)`` how likely each part is called so, in whatever group."""
    columns = [k for k, (_, one) in enumerate(beliefs.classes) if one == name]
    total: Floats = beliefs.values[:, columns].sum(axis=1)
    return total


def _with_meter(piping: Piping, body: Group, heads: Collection[Group], found: Recovered) -> Piping:
    """The piping in which a body and what sits on it are one gauge."""
    parts = sorted({*body.parts, *(part for head in heads for part in head.parts)})
    groups = [group for group in piping.groups if group is not body and group not in heads]
    return replace(
        piping,
        groups=(*groups, Group("gauge", tuple(parts))),
        feet=piping.feet.union(body.parts),
        recovered={**piping.recovered, **dict.fromkeys(body.parts, found)},
    )
