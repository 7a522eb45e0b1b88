"""Questions about labels: parts that one answer settles together, and what that is worth.

Repeats of a shape are asked about together where they are as doubtful as each other, and so are other shapes that look
much alike and are held for the same. An answer holds for exactly these parts: a correction that spreads to kin would
set others that nobody looked at.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.labelers.suspicion import Suspicion
from cadgraph.model.parts import Parts
from cadgraph.model.records import Part
from cadgraph.model.scene import Floats, Ints

__all__ = ["Batch", "find_batches"]

# What goes with the most doubtful part: at least so much of its doubt; other shapes within this distance of unit
# vectors whose probabilities agree so far (1 are the same). Measured on generated plants and five real ones: 97 % of
# such pairs have the same true name.
_AS_DOUBTFUL, _NEAR, _AGREE = 0.5, 0.4, 0.85
_LEAST = 0.02  # doubt from which on other shapes are looked for
# Repeats count less than singly: what a network is wrong about throughout is seldom what there is most of.
_REPEATS = 0.5


@dataclass(frozen=True)
class Batch:
    """Parts that one answer settles.

    Args:
        groups: numbers of parts of one shape each, ascending; the first one is the most doubtful.
        gain: how much an answer is worth.
    """

    groups: tuple[tuple[int, ...], ...]
    gain: float

    @property
    def leader(self) -> int:
        """The part that is shown."""
        return self.groups[0][0]

    @property
    def others(self) -> tuple[int, ...]:
        """The other parts, ascending."""
        return tuple(sorted(part for group in self.groups for part in group if part != self.leader))


@dataclass(frozen=True)
class _Group:
    """Repeats of one shape that are as doubtful as each other.

    Args:
        parts: ascending.
        top: likeliest class.
        doubt: of the most doubtful one.
        worth: of an answer.
    """

    parts: tuple[int, ...]
    top: int
    doubt: float
    worth: float


def find_batches(
    nodes: Sequence[Part], parts: Parts, suspicion: Suspicion, stakes: Floats, skipped: Collection[int] = ()
) -> list[Batch]:
    """What is to be asked about labels, the most worth first.

    Args:
        nodes: the parts of the graph, by number.
        parts: with their geometry.
        suspicion: of their labels.
        stakes: ``(n_parts,)`` how much hangs on each part, 1 where nothing does.
        skipped: parts that nobody is to be asked about for now.
    """
    groups = _groups(nodes, parts, suspicion, stakes)
    found = []
    for members in _gather(groups, suspicion):
        leading, *others = members
        if any(part in skipped for part in leading.parts):
            continue
        kept = [leading, *(group for group in others if not any(part in skipped for part in group.parts))]
        found.append(Batch(tuple(group.parts for group in kept), sum(group.worth for group in kept)))
    return sorted(found, key=lambda batch: (-batch.gain, batch.leader))


def _groups(nodes: Sequence[Part], parts: Parts, suspicion: Suspicion, stakes: Floats) -> list[_Group]:
    """Repeats that are held for the same and as doubtful as each other, the most doubtful first."""
    wrong, top = suspicion.wrong, suspicion.values.argmax(axis=1)
    alike: dict[tuple[int, int], list[int]] = {}
    for part, node in enumerate(nodes):
        if not node.ground and not (node.label is not None and node.label.source == "human"):
            alike.setdefault((int(parts.shape[part]), int(top[part])), []).append(part)
    found = []
    for (_, likeliest), members in alike.items():
        for some in _split(members, wrong):
            doubt = wrong[some]
            worth = float((doubt * stakes[some]).mean() * len(some) ** _REPEATS)
            found.append(_Group(tuple(some), likeliest, float(doubt.max()), worth))
    return sorted(found, key=lambda group: (-group.doubt, group.parts))


def _split(members: Sequence[int], wrong: Floats) -> Iterator[list[int]]:
    """Those as doubtful as the most doubtful one, then the same of the rest."""
    left = sorted(members, key=lambda part: (-wrong[part], part))
    while left:
        limit = _AS_DOUBTFUL * wrong[left[0]]
        # In order of doubt, so that those within the limit come first.
        count = next((k for k, part in enumerate(left) if wrong[part] < limit), len(left))
        yield sorted(left[:count])
        left = left[count:]


def _gather(groups: Sequence[_Group], suspicion: Suspicion) -> Iterator[list[_Group]]:
    """Groups of different shapes that one answer settles, each with the most doubtful one first."""
    by_top: dict[int, list[_Group]] = {}
    for group in groups:
        by_top.setdefault(group.top, []).append(group)
    for same in by_top.values():
        doubtful = [group for group in same if group.doubt >= _LEAST * _AS_DOUBTFUL]
        yield from ([group] for group in same if group.doubt < _LEAST * _AS_DOUBTFUL)
        yield from _together(doubtful, suspicion)


def _together(groups: Sequence[_Group], suspicion: Suspicion) -> Iterator[list[_Group]]:
    if not groups:
        return
    heads: Ints = np.array([group.parts[0] for group in groups], np.int64)
    doubt = np.array([group.doubt for group in groups])
    points, roots = suspicion.points[heads], np.sqrt(suspicion.values[heads])
    free = np.ones(len(groups), np.bool_)
    for k, group in enumerate(groups):
        if not free[k]:
            continue
        free[k] = False
        members = [group]
        if group.doubt >= _LEAST:
            rest = np.flatnonzero(free)
            near = 2.0 - 2.0 * (points[rest] @ points[k]) <= _NEAR**2
            agree = roots[rest] @ roots[k] >= _AGREE
            chosen = rest[near & agree & (doubt[rest] >= _AS_DOUBTFUL * doubt[k])]
            free[chosen] = False
            members += [groups[j] for j in chosen.tolist()]
        yield members
