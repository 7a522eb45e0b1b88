"""How long work tells its caller how far it is."""

from __future__ import annotations

from collections.abc import Callable

__all__ = ["Progress", "quiet"]

Progress = Callable[[str, float], None]
"""Called with the name of the stage at work and the share of it that is done, 0..1."""


def quiet(stage: str, share: float) -> None:
    """Tells nobody."""
