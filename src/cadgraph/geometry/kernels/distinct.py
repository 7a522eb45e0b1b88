"""Rows of whole numbers that are equal, found by a table in place of a sort."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.geometry.kernels.key import mix
from cadgraph.geometry.kernels.parallel import compiled, readable
from cadgraph.model.scene import Ints

__all__ = ["in_groups", "number_rows"]

_SEED = np.uint64(0x9E3779B97F4A7C15)
_FREE = -1


def number_rows(rows: npt.NDArray[np.integer]) -> tuple[Ints, Ints]:
    """Finds equal rows, as ``merge_rows`` does: several times faster, for whom compiled kernels are at hand.

    Args:
        rows: ``(n, k)`` whole numbers.

    Returns:
        ``(n_different,)`` the first row of each kind, ascending; and ``(n,)`` the kind of each row.
    """
    n = len(rows)
    first, kind = np.empty(n, np.int64), np.empty(n, np.int64)
    table = np.full(1 << max(4, (2 * n).bit_length()), _FREE, np.int64)
    count = _number_rows(readable(rows, np.int64), table, first, kind)
    return first[:count], kind


def in_groups(kind: Ints, n_kinds: int) -> tuple[Ints, Ints]:
    """Puts what is of one kind side by side.

    Args:
        kind: ``(n,)`` from 0 on.
        n_kinds: how many there are.

    Returns:
        ``(n_kinds + 1,)`` where each kind starts among ``(n,)`` the rows of all kinds, which ascend within each.
    """
    starts = np.zeros(n_kinds + 1, np.int64)
    np.cumsum(np.bincount(kind, minlength=n_kinds), out=starts[1:])
    rows = np.empty(len(kind), np.int64)
    _put_in_groups(readable(kind, np.int64), starts[:-1].copy(), rows)
    return starts, rows


@compiled
def _number_rows(rows: Any, table: Any, first: Any, kind: Any) -> int:
    width, last, count = rows.shape[1], np.uint64(len(table) - 1), 0
    for i in range(len(rows)):
        key = _SEED
        for c in range(width):
            key = mix(key ^ np.uint64(rows[i, c]))
        slot = np.int64(key & last)
        while table[slot] >= 0:
            other, c = first[table[slot]], 0
            while c < width and rows[other, c] == rows[i, c]:
                c += 1
            if c == width:
                break
            slot = np.int64((np.uint64(slot) + np.uint64(1)) & last)
        if table[slot] < 0:
            table[slot], first[count] = count, i
            count += 1
        kind[i] = table[slot]
    return count


@compiled
def _put_in_groups(kind: Any, places: Any, rows: Any) -> None:
    for i in range(len(kind)):
        rows[places[kind[i]]] = i
        places[kind[i]] += 1
