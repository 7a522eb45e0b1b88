"""One question of the review queue, as the page shows it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any, Literal

__all__ = ["MOST_OPTIONS", "Option", "Question", "label_edits"]

MOST_OPTIONS = 5
"""How many answers a question offers: as many as there are keys for it."""


@dataclass(frozen=True)
class Option:
    """One answer.

    Args:
        text: on its button.
        confidence: how likely it is right, 0..1, or None.
        edits: what it does, as ``Session.apply`` takes it; the answer that all is right as it is says so of the parts.
    """

    text: str
    confidence: float | None
    edits: tuple[Mapping[str, Any], ...]


@dataclass(frozen=True)
class Question:
    """Something that is worth a look.

    Args:
        id: the same as long as it is about the same: its kind and the source path of a mesh.
        kind: ``label``: what an unsure part is; ``contradiction``: a label, or a gap, that something speaks against;
            ``ports``: a unit short of a line; ``joint``: two ends that may be joined; ``kind``: what may turn a
            valve whose kind is open.
        title: the question.
        why: it is asked, in words.
        parts: ids of what it is about, to be shown in place.
        alike: ids of the other parts that the answer settles, too.
        gain: how much an answer is worth; the queue is in its order.
        options: the likeliest first.
    """

    id: str
    kind: Literal["label", "ports", "kind", "joint", "contradiction"]
    title: str
    why: str
    parts: tuple[str, ...]
    alike: tuple[str, ...]
    gain: float
    options: tuple[Option, ...]

    def to_json(self) -> dict[str, Any]:
        """As plain values."""
        return asdict(self)


def label_edits(parts: tuple[str, ...], group: str, name: str | None) -> tuple[Mapping[str, Any], ...]:
    """What makes exactly these parts that, and no other."""
    return tuple({"kind": "label", "part": part, "group": group, "name": name, "this_only": True} for part in parts)
