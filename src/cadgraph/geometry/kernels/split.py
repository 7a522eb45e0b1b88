"""How the faces of a mesh are shared out among the leaves of its tree: halved along the longest side, again and again.

Halves at the median overlap far less than runs along a Morton or Hilbert curve do, which are cut wherever the count
says; searches through them visit half as many nodes. To keep that cheap, a face is one whole number: the middle of its
box on a grid of 4096 steps along each axis, and its index; halving is a selection that moves these numbers about
without branches.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from cadgraph.geometry.kernels.borrow import borrow
from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.model.scene import Floats

__all__ = ["INDEX", "MAX_FACES", "halve", "record"]

Keys = npt.NDArray[np.uint64]

_BITS = 12  # of the grid, along each axis

_STEPS = (1 << _BITS) - 1

_MASK = np.uint64(_STEPS)

INDEX = np.uint64((1 << 28) - 1)
"""Mask of the index in a record."""

MAX_FACES = 1 << 28
"""Faces that a mesh can have at most."""

_X, _Y, _Z = np.uint64(52), np.uint64(40), np.uint64(28)


@compiled
def record(index: int, x: float, y: float, z: float, low: Floats, extents: Floats) -> np.uint64:
    """The record of a face whose box has its middle at ``(x, y, z)``, on a grid from ``low`` over ``extents``."""
    i = int((x - low[0]) / extents[0] * _STEPS) if extents[0] > 0.0 else 0
    j = int((y - low[1]) / extents[1] * _STEPS) if extents[1] > 0.0 else 0
    k = int((z - low[2]) / extents[2] * _STEPS) if extents[2] > 0.0 else 0
    i, j, k = min(max(i, 0), _STEPS), min(max(j, 0), _STEPS), min(max(k, 0), _STEPS)
    return np.uint64((i << 24 | j << 12 | k) << 28 | index)


@compiled
def _select(records: Keys, low: int, high: int, middle: int, shift: np.uint64) -> None:
    """Moves the records so that those before ``middle`` are not greater in a field than those from there on."""
    while high - low > 1:
        a = (records[low] >> shift) & _MASK
        b = (records[(low + high) >> 1] >> shift) & _MASK
        c = (records[high - 1] >> shift) & _MASK
        pivot = max(min(a, b), min(max(a, b), c))
        at = low
        for i in range(low, high):
            moved = records[i]
            records[i] = records[at]
            records[at] = moved
            at += ((moved >> shift) & _MASK) < pivot
        if middle < at:
            high = at
            continue
        low = at
        for i in range(low, high):
            moved = records[i]
            records[i] = records[at]
            records[at] = moved
            at += ((moved >> shift) & _MASK) <= pivot
        if middle < at:
            return
        low = at


@compiled
def _left_leaves(n_leaves: int) -> int:
    """Leaves in the left half of a tree in heap order."""
    full = 1
    while 2 * full <= n_leaves:
        full *= 2
    return full // 2 + min(n_leaves - full, full // 2)


@compiled
def halve(records: Keys, n: int, extents: Floats, leaf: int) -> None:
    """Puts the first ``n`` records in the order of the leaves of a tree in heap order.

    Args:
        records: see ``record``.
        n: how many.
        extents: ``(3,)`` what the grid covers [m].
        leaf: records in a leaf.
    """
    records = borrow(records)
    wx, wy, wz = extents[0], extents[1], extents[2]
    stack = np.empty((64, 2), np.int64)
    stack[0, 0], stack[0, 1] = 0, n
    top = 1
    while top > 0:
        top -= 1
        start, end = stack[top, 0], stack[top, 1]
        if end - start <= leaf:
            continue
        x0 = y0 = z0 = _MASK
        x1 = y1 = z1 = np.uint64(0)
        for i in range(start, end):
            at = records[i]
            x, y, z = at >> _X, (at >> _Y) & _MASK, (at >> _Z) & _MASK
            x0, x1, y0, y1, z0, z1 = min(x0, x), max(x1, x), min(y0, y), max(y1, y), min(z0, z), max(z1, z)
        dx, dy, dz = np.float64(x1 - x0) * wx, np.float64(y1 - y0) * wy, np.float64(z1 - z0) * wz
        shift = _X
        if dy > dx:
            shift = _Y
        if dz > max(dx, dy):
            shift = _Z
        middle = start + leaf * _left_leaves((end - start + leaf - 1) // leaf)
        _select(records, start, end, middle, shift)
        stack[top, 0], stack[top, 1] = start, middle
        stack[top + 1, 0], stack[top + 1, 1] = middle, end
        top += 2
