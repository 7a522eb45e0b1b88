"""How long a build still takes, from the stages that are over and what share of a build they usually are."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection

__all__ = ["Remaining", "told"]

_SHARES = {
    "read": 13, "measure": 3, "contacts": 1, "group": 1, "cluster": 1, "label": 8, "relate": 13, "places": 2,
    "mechanisms": 1, "assemble": 4, "write graph": 4, "write labels": 6, "draw report": 43,
}  # fmt: skip
"""Of the time of a build of 10,000 meshes (``packages/cadlab/benchmarks/size.py``), in the order in which they come."""

_LEAST = 0.05  # share of a build that must be over, or nothing is said


class Remaining:
    """Follows the stages of a build.

    Args:
        without: stages that don't come in this one (``"draw report"``).
        clock: tells the time [s].
    """

    def __init__(self, without: Collection[str] = (), clock: Callable[[], float] = time.monotonic) -> None:
        shares = {stage: share for stage, share in _SHARES.items() if stage not in without}
        self._share = {stage: share / sum(shares.values()) for stage, share in shares.items()}
        self._clock = clock
        self._begun = clock()
        self._stage, self._since, self._done, self._within = "", self._begun, 0.0, 0.0

    def __call__(self, stage: str, share: float) -> None:
        """Moves on to a stage, or within it: the share of it that is done, 0..1."""
        if stage not in self._share:
            return
        if stage != self._stage:
            stages = list(self._share)
            self._done = sum(self._share[one] for one in stages[: stages.index(stage)])
            self._stage, self._since = stage, self._clock()
        self._within = min(max(share, 0.0), 1.0)

    @property
    def share(self) -> float:
        """The share of the build that is over, 0..1, as far as it is known."""
        return self._done + self._within * self._share.get(self._stage, 0.0)

    @property
    def seconds(self) -> float | None:
        """How long it still takes; None before enough is over to tell, or in a run of other stages.

        Within a stage that doesn't say how far it is, this counts down to what is left after the stage.
        """
        now, share = self._clock(), self.share
        if self._done < _LEAST:
            return None
        # By the stages that are over: one that takes long shows in the estimate when it is.
        pace = (self._since - self._begun) / self._done
        if self._within:
            return max((now - self._begun) * (1 - share) / share, 0.0)
        own, after = self._share[self._stage], 1 - self._done - self._share[self._stage]
        return pace * after + max(pace * own - (now - self._since), 0.0)


def told(seconds: float | None) -> str:
    """Time left in words, coarser the longer it is; empty where it isn't known."""
    if seconds is None:
        return ""
    if seconds < 60:
        return f"about {max(5, 5 * round(seconds / 5))} s left" if seconds > 2 else "nearly done"
    return f"about {round(seconds / 60)} min left"
