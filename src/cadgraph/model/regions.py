"""Where in a plant something stands, in words: a ninth of its plan."""

from __future__ import annotations

from collections.abc import Sequence

__all__ = ["region_of"]

_NORTH = ("south", "", "north")  # north is +y
_EAST = ("west", "", "east")


def region_of(low: Sequence[float], high: Sequence[float], point: Sequence[float]) -> str:
    """The ninth of a plan that a point is in: ``north east``, ``south``, ``middle``; north is +y, east is +x.

    Args:
        low: corner of the plan where x and y are least [m].
        high: the corner where they are greatest.
        point: ``(x, y, ...)``; one outside counts to the ninth that is nearest.
    """
    thirds = []
    for k in (0, 1):
        span = high[k] - low[k]
        share = (point[k] - low[k]) / span if span > 0 else 0.5
        thirds.append(min(2, max(0, int(3 * share))))
    return " ".join(word for word in (_NORTH[thirds[1]], _EAST[thirds[0]]) if word) or "middle"
