"""Results of ranges worked on by several threads, put back in order."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from cadgraph.geometry.kernels.parallel import for_ranges
from cadgraph.model.scene import Ints

__all__ = ["gather"]

_T = TypeVar("_T")


def gather(kernel: Callable[[int, int], _T], weights: Ints, workers: int | None = None) -> list[_T]:
    """What ``kernel(first, last)`` returns for consecutive ranges that cover ``range(len(weights))``, in order.

    Args:
        kernel: works on ``first <= i < last``.
        weights: ``(n,)`` about how much work each row is.
        workers: threads; all processors by default.

    Raises:
        ValueError: ``workers`` is below 1.
    """
    results: dict[int, _T] = {}

    def keep(first: int, last: int) -> None:
        results[first] = kernel(first, last)

    for_ranges(keep, weights, workers)
    return [results[first] for first in sorted(results)]
