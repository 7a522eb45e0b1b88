"""Results of ranges worked on by several threads, put back in order."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import numpy as np

from cadgraph.geometry.kernels.parallel import for_ranges
from cadgraph.model.scene import Ints

__all__ = ["gather", "gather_chunks"]

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


def gather_chunks(work: Callable[[Ints], _T], weights: Ints, size: int, workers: int | None = None) -> list[_T]:
    """What ``work(rows)`` returns for chunks of consecutive rows, in order.

    Unlike the ranges of ``gather``, chunks are the same whatever the number of threads: for work whose sums depend on
    what else is in them.

    Args:
        work: gets the numbers of some rows.
        weights: ``(n,)`` about how much work each row is.
        size: rows of a chunk; the last one may have fewer.
        workers: threads; all processors by default.

    Raises:
        ValueError: ``workers`` is below 1.
    """
    starts = np.arange(0, len(weights), size)
    if not len(starts):
        return []

    def kernel(first: int, last: int) -> list[_T]:
        return [work(np.arange(start, min(start + size, len(weights)))) for start in starts[first:last].tolist()]

    return [result for results in gather(kernel, np.add.reduceat(weights, starts), workers) for result in results]
