"""Which labeler the settings name."""

from __future__ import annotations

from cadgraph.config import LabelConfig
from cadgraph.labelers.base import Labeler
from cadgraph.labelers.embedded.labeler import EmbeddedLabeler

__all__ = ["labeler_of"]


def labeler_of(config: LabelConfig) -> Labeler | None:
    """The labeler that is set; None if labels come from outside only.

    Raises:
        LabelError: the trained model is damaged.
    """
    if config.labeler == "none":
        return None
    return EmbeddedLabeler()
