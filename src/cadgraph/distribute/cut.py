"""Cutting a site into tiles: which meshes, which pairs of meshes and which shapes each of them answers for.

Whatever is found is owned by exactly one tile. A mesh belongs to the tile of its box's centre; a pair of meshes to that
of the smaller box, so that a ground plate as large as the site is looked at by each tile for what stands there. What
else a tile needs to decide its pairs is its margin. So tiles never find anything twice, and together all of it.
"""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.contact.broad import near_boxes
from cadgraph.model.scene import Floats, Ints

__all__ = ["LARGEST_TILE", "cut_rows", "cut_tiles", "default_tiles", "own_pairs"]

LARGEST_TILE = 20_000
"""Meshes of a tile where nobody says how many tiles there are to be: a tenth of a minute of work, some 100 MB."""

# Boxes here are those of all used vertices, in the search those of all faces that are whole: they may differ by
# rounding where meshes are placed. What is looked at in vain costs little; what is left out would be wrong.
_SLACK = 1e-6


def default_tiles(n_meshes: int, workers: int) -> int:
    """How many tiles a site is cut into where nobody says.

    Args:
        n_meshes: of the site.
        workers: that share the work; each should get several tiles, as these are not alike.
    """
    if n_meshes < 2:
        return 1
    return min(n_meshes, max(-(-n_meshes // LARGEST_TILE), 4 * workers if workers > 1 else 1))


def cut_tiles(boxes: Floats, n_tiles: int) -> Ints:
    """Cuts a site at medians, each piece across its longest side, into tiles of about equally many meshes.

    Args:
        boxes: ``(n_meshes, 2, 3)`` least and greatest corners [m]; one with a NaN lies in the first tile.
        n_tiles: at least 1.

    Returns:
        ``(n_meshes,)`` the tile of each mesh, 0 to ``n_tiles - 1``; tiles may be empty where meshes are few.
    """
    centers = np.nan_to_num(0.5 * (boxes[:, 0] + boxes[:, 1]), nan=-np.inf)
    tile = np.zeros(len(boxes), np.int64)
    waiting = [(np.arange(len(boxes)), 0, max(1, n_tiles))]
    while waiting:
        rows, first, count = waiting.pop()
        tile[rows] = first
        if count == 1 or len(rows) < 2:
            continue
        at = centers[rows]
        finite = at[np.isfinite(at).all(axis=1)]
        axis = int(np.argmax(np.ptp(finite, axis=0))) if len(finite) else 0
        left = count // 2
        order = rows[np.lexsort((rows, at[:, axis]))]
        middle = len(order) * left // count
        waiting += [(order[:middle], first, left), (order[middle:], first + left, count - left)]
    return tile


def own_pairs(boxes: Floats, tile: Ints, reach: float) -> list[Ints]:
    """Deals out all pairs of boxes that may be within a distance.

    Args:
        boxes: ``(n_meshes, 2, 3)`` least and greatest corners [m]; one with a NaN is near nothing.
        tile: ``(n_meshes,)`` the tile of each mesh, from 0 on, cut in whatever way.
        reach: the distance [m].

    Returns:
        For each tile ``(n_pairs, 2)`` first < second, in ascending order; every pair is in one of them. The meshes of
        these pairs are the tile with its margin.
    """
    known = boxes[np.isfinite(boxes).all(axis=(1, 2))]
    size = float(np.abs(known).max()) if len(known) else 0.0
    pairs = near_boxes(boxes, reach + _SLACK * max(1.0, size))
    extent = np.nan_to_num((boxes[:, 1] - boxes[:, 0]).max(axis=1)) if len(boxes) else np.zeros(0)
    smaller = np.where(extent[pairs[:, 1]] < extent[pairs[:, 0]], pairs[:, 1], pairs[:, 0])
    owner = tile[smaller]
    return [pairs[owner == number] for number in range(int(tile.max()) + 1 if len(tile) else 0)]


def cut_rows(weights: Ints, count: int, grain: int = 1) -> list[tuple[int, int]]:
    """Cuts rows into ranges of about equal weight.

    Args:
        weights: ``(n,)`` about how much work each row is.
        count: of ranges, at most.
        grain: every range begins at a multiple of it.

    Returns:
        First row and end of each range, in order; together all rows.
    """
    n = len(weights)
    if not n:
        return []
    load = np.concatenate([[0], np.cumsum(np.asarray(weights, np.float64) + 1.0)])
    inner = np.searchsorted(load, load[-1] * np.arange(1, max(1, count)) / max(1, count))
    bounds = np.unique(np.concatenate([[0], inner // grain * grain, [n]])).tolist()
    return list(zip(bounds[:-1], bounds[1:], strict=True))
