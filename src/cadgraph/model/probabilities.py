"""How likely each name is for each part."""

from __future__ import annotations

from dataclasses import dataclass

from cadgraph.model.scene import Floats

__all__ = ["Probabilities"]


@dataclass(frozen=True, eq=False)
class Probabilities:
    """How likely each name is for each part.

    Args:
        classes: group and name of each column.
        values: ``(n_parts, n_classes)``; what is missing to 1 in a row belongs to no name of the vocabulary.
    """

    classes: tuple[tuple[str, str], ...]
    values: Floats
