"""Which kinds are worth a question: those whose answer is likely to mend most."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from cadgraph.labelers.lvlm.question_groups import QuestionGroup
from cadgraph.model.labels import Label
from cadgraph.model.parts import Parts
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["OVERCONFIDENT", "choose", "in_stages"]

OVERCONFIDENT: frozenset[str] = frozenset({
    "elbow", "pipe", "plate", "foundation", "reducer", "boiler", "tee", "u-bolt", "railing", "screw", "shell", "washer",
})  # fmt: skip
"""Names that the embedded labeler gives to parts of foreign plants more confidently than it should (docs/labeler.md:
most frequent errors, sheet of mistakes): they are asked about up to a confidence of ``_BAR``."""

_BAR = 0.95
_HANGS = 0.5  # what one neighbour adds to the worth of a part of a line or a device, whose label the network needs
_MOST_HANGS = 4.0
_BIG = 0.6  # of all parts: as large ones are asked about before the smaller ones


def choose(
    kinds: Sequence[QuestionGroup],
    base: Sequence[Label | None],
    parts: Parts,
    near: Mapping[int, tuple[int, ...]],
    vocabulary: Vocabulary,
    below: float | None,
) -> list[QuestionGroup]:
    """The kinds to ask about, those first where an answer is worth most.

    An answer is worth the chance that the label is wrong, for each part that shares the question, times what hangs on
    that part in the network: parts of lines and devices count more, the more they touch. What has no name is always
    asked about.

    Args:
        kinds: all.
        base: the labels so far.
        parts: of the scene.
        near: what each part touches.
        vocabulary: says which groups are of devices and lines.
        below: asks where the confidence is below; None: everything.
    """
    wanted = [(_gain(kind, base, parts, near, vocabulary, below), kind) for kind in kinds]
    wanted = [(gain, kind) for gain, kind in wanted if gain > 0]
    return [kind for _, kind in sorted(wanted, key=lambda row: (-round(row[0], 9), row[1].parts[0]))]


def _gain(
    kind: QuestionGroup,
    base: Sequence[Label | None],
    parts: Parts,
    near: Mapping[int, tuple[int, ...]],
    vocabulary: Vocabulary,
    below: float | None,
) -> float:
    gain = 0.0
    for part in kind.parts:
        label = base[part]
        if below is not None:
            # The ground is found by its place, not by labels.
            if parts.ground[part]:
                continue
            if label is not None and label.name is not None and label.confidence >= _bar(label, below):
                continue
        wrong = 1.0 if label is None else max(1 - label.confidence, 0.5 if label.name is None else 0.01)
        gain += wrong * _weight(label, near.get(part, ()), vocabulary)
    return gain


def _bar(label: Label, below: float) -> float:
    return max(below, _BAR) if label.source == "geometry" and label.name in OVERCONFIDENT and below > 0 else below


def _weight(label: Label | None, touched: tuple[int, ...], vocabulary: Vocabulary) -> float:
    """How much more than itself hangs on a part."""
    content = None if label is None else vocabulary.groups.get(label.group)
    if content is not None and not content.unit and not content.connector:
        return 1.0
    return 1 + min(_HANGS * len(touched), _MOST_HANGS)


def in_stages(kinds: Sequence[QuestionGroup], parts: Parts) -> tuple[list[QuestionGroup], list[QuestionGroup]]:
    """Large parts, which speak for themselves; then small ones, which are told by what they are at."""
    size = np.linalg.norm(parts.properties.obb_extents, axis=1)
    others = size[~parts.ground]
    limit = float(np.quantile(others, _BIG)) if len(others) else 0.0
    large = [kind for kind in kinds if size[kind.parts[0]] >= limit]
    return large, [kind for kind in kinds if size[kind.parts[0]] < limit]
