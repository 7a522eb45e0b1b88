"""Which meshes can be near at all: pairs of boxes within a distance.

Boxes are put into classes of like size, each class into a binary tree along a Morton curve. A box searches the trees
of its own class and of all larger ones, so that a large plate never bloats the tree of the bolts on it, and every
pair is found once: a scene of a million small boxes and a few as large as itself costs little more than a sort.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from cadgraph.geometry.kernels.gather import gather
from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.geometry.kernels.tree import LEAF, first_face
from cadgraph.model.scene import Floats, Ints

__all__ = ["BoxTrees", "box_trees", "near_boxes"]

_OCTAVES = 3  # sizes within a class differ by less than two to this power

_FEW = 40  # below this many keys insertion beats counting


def near_boxes(boxes: Floats, reach: float, workers: int | None = None) -> Ints:
    """All pairs of boxes whose distance is at most ``reach``.

    Args:
        boxes: ``(n, 2, 3)`` least and greatest corners [m]; a box with a NaN is near nothing.
        reach: [m].
        workers: threads; all processors by default.

    Returns:
        ``(n_pairs, 2)`` int64, first < second, in ascending order, each pair once.

    Raises:
        ValueError: ``workers`` is below 1.
    """
    n = len(boxes)
    trees = box_trees(boxes)
    if len(trees.members) < 2:
        return np.zeros((0, 2), np.int64)
    found = gather(
        lambda first, last: _search(
            first, last, trees.boxes, trees.members, reach, trees.class_offsets, trees.nodes, trees.node_offsets, n
        ),
        np.ones(len(trees.boxes), np.int64),
        workers,
    )
    keys = np.concatenate(found)
    keys.sort()
    pairs = np.empty((len(keys), 2), np.int64)
    np.divmod(keys, n, out=(pairs[:, 0], pairs[:, 1]))
    return pairs


class BoxTrees(NamedTuple):
    """Boxes in classes of like size, each class in a tree as those of faces are (``kernels.tree``).

    Args:
        boxes: ``(n, 2, 3)`` least and greatest corners of the finite ones, class by class [m].
        members: ``(n,)`` the number of each among those given.
        class_offsets: ``(n_classes + 1,)`` where the boxes of each class start.
        nodes: ``(n_nodes, 2, 3)`` the boxes of the nodes [m].
        node_offsets: ``(n_classes + 1,)`` the root of each class.
    """

    boxes: Floats
    members: Ints
    class_offsets: Ints
    nodes: Floats
    node_offsets: Ints


def box_trees(boxes: Floats) -> BoxTrees:
    """Trees over boxes, small ones and large ones apart.

    Args:
        boxes: ``(n, 2, 3)`` least and greatest corners [m]; one that is not finite is left out.
    """
    index = np.flatnonzero(np.isfinite(boxes).all(axis=(1, 2)))
    if not len(index):
        none = np.zeros((0, 2, 3))
        return BoxTrees(none, index, np.zeros(1, np.int64), none, np.zeros(1, np.int64))
    boxes = np.ascontiguousarray(boxes[index], np.float64)
    order, class_offsets = _sort_boxes(boxes)
    boxes, index = boxes[order], index[order]
    leaves = -(-np.diff(class_offsets) // LEAF)
    node_offsets = np.concatenate([[0], np.cumsum(np.maximum(2 * leaves - 1, 0))]).astype(np.int64)
    nodes = np.empty((int(node_offsets[-1]), 2, 3))
    _bound(boxes, class_offsets, nodes, node_offsets)
    return BoxTrees(boxes, index, class_offsets, nodes, node_offsets)


def _sort_boxes(boxes: Floats) -> tuple[Ints, Ints]:
    """An order by class of size, then along a Morton curve; and where each class starts."""
    size = (boxes[:, 1] - boxes[:, 0]).max(axis=1)
    # a point counts as a millionth of the largest, so that the number of classes stays small
    octave = np.frexp(np.maximum(size, max(float(size.max()) * 1e-6, 1e-12)))[1].astype(np.int64)
    group = (octave - octave.min()) // _OCTAVES
    order = _morton_order(boxes, group)
    return order, np.searchsorted(group[order], np.arange(int(group.max()) + 2)).astype(np.int64)


@compiled
def _radix_sort(
    keys: npt.NDArray[np.uint64], spare: npt.NDArray[np.uint64], n: int, low: int, high: int, digit: int
) -> bool:
    """Sorts the first ``n`` keys, stable, by their bits ``low`` to ``high``; True: the outcome is in ``spare``.

    The keys must be below ``2**high``, and equal in the bits under ``low`` or sorted by them.
    """
    if n <= _FEW:
        for i in range(1, n):
            key = keys[i]
            j = i - 1
            while j >= 0 and keys[j] > key:
                keys[j + 1] = keys[j]
                j -= 1
            keys[j + 1] = key
        return False
    size = 1 << digit
    mask = np.uint64(size - 1)
    counts = np.empty(size, np.int64)
    source, target, flipped = keys, spare, False
    for shift in range(low, high, digit):
        amount = np.uint64(shift)
        for k in range(size):
            counts[k] = 0
        for i in range(n):
            counts[np.int64((source[i] >> amount) & mask)] += 1
        if counts[np.int64((source[0] >> amount) & mask)] == n:
            continue
        total = 0
        for k in range(size):
            here = counts[k]
            counts[k] = total
            total += here
        for i in range(n):
            digit_at = np.int64((source[i] >> amount) & mask)
            target[counts[digit_at]] = source[i]
            counts[digit_at] += 1
        source, target, flipped = target, source, not flipped
    return flipped


@compiled
def _spread_bits(x: int) -> int:
    """The ten low bits of ``x`` with two zeros after each."""
    x = (x | (x << 16)) & 0x030000FF
    x = (x | (x << 8)) & 0x0300F00F
    x = (x | (x << 4)) & 0x030C30C3
    return (x | (x << 2)) & 0x09249249


@compiled
def _morton_order(boxes: Floats, group: Ints) -> Ints:
    n = len(boxes)
    low, high = np.empty(3), np.empty(3)
    for k in range(3):
        low[k], high[k] = np.inf, -np.inf
    for i in range(n):
        for k in range(3):
            at = boxes[i, 0, k] + boxes[i, 1, k]
            low[k], high[k] = min(low[k], at), max(high[k], at)
    extent = max(high[0] - low[0], high[1] - low[1], high[2] - low[2])
    scale = 1024.0 / extent if extent > 0.0 else 0.0
    keys, spare = np.empty(n, np.uint64), np.empty(n, np.uint64)
    for i in range(n):
        code = np.int64(0)
        for k in range(3):
            cell = min(int((boxes[i, 0, k] + boxes[i, 1, k] - low[k]) * scale), 1023)
            code |= _spread_bits(cell) << (2 - k)
        keys[i] = np.uint64(group[i] << 30 | code) << np.uint64(28) | np.uint64(i)
    if _radix_sort(keys, spare, n, 28, 64, 9):
        keys = spare
    order = np.empty(n, np.int64)
    for i in range(n):
        order[i] = np.int64(keys[i] & np.uint64((1 << 28) - 1))
    return order


@compiled
def _bound(boxes: Floats, class_offsets: Ints, nodes: Floats, node_offsets: Ints) -> None:
    """Fills the nodes of all classes."""
    for group in range(len(class_offsets) - 1):
        b0, n, base = class_offsets[group], class_offsets[group + 1] - class_offsets[group], node_offsets[group]
        n_leaves = (n + LEAF - 1) // LEAF
        for node in range(2 * n_leaves - 2, -1, -1):
            for k in range(3):
                low, high = np.inf, -np.inf
                if node >= n_leaves - 1:
                    start = first_face(node, n_leaves)
                    for b in range(b0 + start, b0 + min(start + LEAF, n)):
                        low, high = min(low, boxes[b, 0, k]), max(high, boxes[b, 1, k])
                else:
                    for child in range(base + 2 * node + 1, base + 2 * node + 3):
                        low, high = min(low, nodes[child, 0, k]), max(high, nodes[child, 1, k])
                nodes[base + node, 0, k], nodes[base + node, 1, k] = low, high


@compiled
def _gap2(first: Floats, i: int, second: Floats, j: int) -> float:
    """Squared distance of two boxes."""
    total = 0.0
    for k in range(3):
        gap = max(first[i, 0, k] - second[j, 1, k], second[j, 0, k] - first[i, 1, k], 0.0)
        total += gap * gap
    return total


@compiled
def _search(
    first: int,
    last: int,
    boxes: Floats,
    index: Ints,
    reach: float,
    class_offsets: Ints,
    nodes: Floats,
    node_offsets: Ints,
    n_meshes: int,
) -> Ints:
    """For boxes ``first`` to ``last``: the keys of all near pairs with a later one of their class or a larger one."""
    found = np.empty(4 * (last - first) + 64, np.int64)
    n_found = 0
    stack = np.empty(128, np.int64)
    reach2 = reach * reach
    group = 0
    for i in range(first, last):
        while class_offsets[group + 1] <= i:
            group += 1
        for other in range(group, len(class_offsets) - 1):
            b0, n, base = class_offsets[other], class_offsets[other + 1] - class_offsets[other], node_offsets[other]
            if n == 0:
                continue
            n_leaves = (n + LEAF - 1) // LEAF
            top = 1
            stack[0] = 0
            while top > 0:
                top -= 1
                node = stack[top]
                if _gap2(nodes, base + node, boxes, i) > reach2:
                    continue
                if node < n_leaves - 1:
                    stack[top] = 2 * node + 1
                    stack[top + 1] = 2 * node + 2
                    top += 2
                    continue
                start = first_face(node, n_leaves)
                for j in range(b0 + start, b0 + min(start + LEAF, n)):
                    if j <= i or _gap2(boxes, j, boxes, i) > reach2:
                        continue
                    if n_found == len(found):
                        grown = np.empty(2 * n_found, np.int64)
                        for k in range(n_found):
                            grown[k] = found[k]
                        found = grown
                    a, b = min(index[i], index[j]), max(index[i], index[j])
                    found[n_found] = a * n_meshes + b
                    n_found += 1
    return found[:n_found].copy()
