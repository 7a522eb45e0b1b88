"""Making one label of the answers about several members of a kind."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from cadgraph.labelers.lvlm.answer import Verdict

__all__ = ["Poll", "poll"]


@dataclass(frozen=True)
class Poll:
    """What the answers agree on.

    Args:
        group: that most say, or None.
        name: that most of these say, or None.
        confidence: in the name, or in the group where no name is sure: the share of answers that agree, or for a single
            answer what the model says of itself.
        votes: ``"group: name"`` of each answer.
    """

    group: str | None
    name: str | None
    confidence: float
    votes: tuple[str, ...]


def poll(verdicts: Sequence[Verdict], asked: int | None = None) -> Poll:
    """Takes the majority, the group first.

    Args:
        verdicts: of the answers that came.
        asked: how many were asked; those without an answer agree with nobody.

    Returns:
        Ties go to the more confident, then to the alphabet.
    """
    votes = tuple(f"{v.group or '?'}: {v.name or '?'}" for v in verdicts)
    named = [v for v in verdicts if v.group is not None]
    if not named:
        return Poll(None, None, 0.0, votes)
    if len(verdicts) == 1:
        only = named[0]
        return Poll(only.group, only.name, only.confidence, votes)
    total = max(asked or 0, len(verdicts))
    group = _most([(v.group or "", v.confidence) for v in named])
    inside = [v for v in named if v.group == group]
    with_name = [v for v in inside if v.name is not None]
    group_share = len(inside) / total
    if not with_name:
        return Poll(group, None, group_share, votes)
    name = _most([(v.name or "", v.confidence) for v in with_name])
    share = sum(v.name == name for v in with_name) / total
    # Where the group is clear and the name is not, the group alone is worth more than a name that most deny.
    if share < 0.5 <= group_share:
        return Poll(group, None, group_share, votes)
    return Poll(group, name, share, votes)


def _most(votes: Sequence[tuple[str, float]]) -> str:
    counts = Counter(vote for vote, _ in votes)
    weight = {vote: sum(c for v, c in votes if v == vote) for vote in counts}
    return min(counts, key=lambda vote: (-counts[vote], -round(weight[vote], 9), vote))
