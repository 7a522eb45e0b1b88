"""Which labeler the settings name."""

from __future__ import annotations

from cadgraph.config import LabelConfig
from cadgraph.errors import LabelError
from cadgraph.labelers.base import Labeler
from cadgraph.labelers.embedded.labeler import EmbeddedLabeler

__all__ = ["labeler_of"]


def labeler_of(config: LabelConfig) -> Labeler | None:
    """The labeler that is set; None if labels come from outside only.

    Raises:
        LabelError: the trained model is damaged, or the settings speak of a labeler that only a program can give.
    """
    if config.labeler == "own":
        raise LabelError(
            "label.labeler is 'own': these labels came from a labeler of somebody's program; give it again "
            "(labeler=...), or set label.labeler to embedded or none"
        )
    if config.labeler == "none":
        return None
    return EmbeddedLabeler()
