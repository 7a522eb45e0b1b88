"""Labels that sizes and neighbours rule out: gaskets and flanges, which models confuse (paper, section V-B)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from cadgraph.model.labels import FormerLabel, Label
from cadgraph.model.parts import Parts
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["repair"]

MAX_GASKET = 0.0065
"""Thickness [m]: flat gaskets have 1.5 to 3 mm (ASME B16.21), spiral wound ones 4.5 to 6.4 mm (ASME B16.20)."""

MIN_FLANGE = 0.009
"""Thickness [m]: the thinnest plate flanges have 12 mm (EN 1092-1, DN10 PN6); 9 mm leaves room for small ones."""

_FLAT = 0.12  # thickness over the lesser diameter, up to which a part could be a gasket at all
_SURE = 0.9  # confidence in what the thickness says


def repair(
    labels: Sequence[Label | None], parts: Parts, near: Mapping[int, tuple[int, ...]], vocabulary: Vocabulary
) -> list[Label | None]:
    """Corrects what can't be.

    A gasket thicker than any gasket is a flange, if it touches a pipe, a flange, a gasket or a bolt. A flange as thin
    as a gasket is one, if it lies between two parts.

    Args:
        labels: of each part.
        parts: with their boxes.
        near: what each part touches.
        vocabulary: that must hold both names.

    Returns:
        The labels, those changed with source ``context`` and what they were before as evidence.
    """
    result = list(labels)
    gasket, flange = _place("gasket", vocabulary), _place("flange", vocabulary)
    if gasket is None or flange is None:
        return result
    extents = parts.properties.obb_extents
    for i, label in enumerate(labels):
        if label is None or label.name not in ("gasket", "flange") or label.source != "lvlm":
            continue
        thin, wide = float(extents[i, 2]), float(extents[i, 1])
        if label.name == "gasket" and (thin >= MIN_FLANGE or (thin > MAX_GASKET and thin > _FLAT * wide)):
            why = f"{thin * 1000:.1f} mm is thicker than any gasket"
            result[i] = _changed(label, flange, why)
        elif label.name == "flange" and thin <= MAX_GASKET and thin <= _FLAT * wide and len(near.get(i, ())) >= 2:
            why = f"{thin * 1000:.1f} mm is as thin as a gasket, between {len(near[i])} parts"
            result[i] = _changed(label, gasket, why)
    return result


def _place(name: str, vocabulary: Vocabulary) -> tuple[str, str] | None:
    return next(((group, name) for group, content in vocabulary.groups.items() if name in content.names), None)


def _changed(label: Label, to: tuple[str, str], why: str) -> Label:
    evidence = label.evidence.model_copy(update={"before": FormerLabel.of(label), "why": why})
    confidence = float(np.clip(max(label.confidence, _SURE), 0, 1))
    said = {"group": to[0], "name": to[1], "confidence": confidence, "source": "context", "evidence": evidence}
    return label.model_copy(update=said)
