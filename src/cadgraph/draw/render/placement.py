"""Finding room for labels in a picture."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.model.scene import Floats

__all__ = ["place_boxes"]

_RINGS = (1.0, 1.7, 2.6, 3.8, 5.4, 7.5, 10.0)  # distances tried, in heights of a label
_DIRECTIONS = 20
_POINT_COST, _SEGMENT_COST, _LEADER_COST = 2.5, 1.2, 3.0  # in heights of a label, for each that is covered or crossed
_POINT_ROOM, _SEGMENT_ROOM = 0.4, 0.2  # heights of a label that stay free round them


def place_boxes(
    anchors: npt.ArrayLike,
    sizes: npt.ArrayLike,
    area: tuple[float, float, float, float],
    *,
    taken: npt.ArrayLike = (),
    points: npt.ArrayLike = (),
    segments: npt.ArrayLike = (),
    gap: float = 3.0,
    most: float = math.inf,
) -> Floats:
    """Places a box near each anchor, so that boxes don't overlap and hide little.

    The boxes are placed one after the other, each where it costs least: near its anchor, off the points and segments,
    its leader line off the others' boxes and leaders.

    Args:
        anchors: ``(n, 2)`` what each label speaks of [px]; the most important first.
        sizes: ``(n, 2)`` width and height of each box [px].
        area: left, top, right and bottom that boxes must stay within [px].
        taken: ``(k, 4)`` boxes that are already there: left, top, right, bottom.
        points: ``(p, 2)`` points better not covered.
        segments: ``(s, 4)`` lines better not covered: x and y of both ends.
        gap: least distance between boxes [px].
        most: greatest cost of a box, in its height; what would cost more is left out.

    Returns:
        ``(n, 4)`` left, top, right, bottom; NaN for a box that finds no room.
    """
    a = np.asarray(anchors, np.float64).reshape(-1, 2)
    there = np.asarray(taken, np.float64).reshape(-1, 4)
    boxes = np.full((len(there) + len(a), 4), np.nan)
    boxes[: len(there)] = there
    spots = np.concatenate([a, np.asarray(points, np.float64).reshape(-1, 2)])
    lines = np.asarray(segments, np.float64).reshape(-1, 4)
    turn = np.arange(_DIRECTIONS) * 2 * math.pi / _DIRECTIONS
    # Up and to the right first: of equals the first wins.
    ways = np.stack([np.cos(turn - math.pi / 4), np.sin(turn - math.pi / 4)], axis=1)
    _place(
        a, np.asarray(sizes, np.float64).reshape(-1, 2), np.array(area, np.float64), len(there), spots, lines,
        float(gap), float(most), ways, np.array(_RINGS), boxes,
    )  # fmt: skip
    return boxes[len(there) :]


@compiled
def _place(
    anchors: Any, sizes: Any, area: Any, n_taken: int, spots: Any, lines: Any, gap: float, most: float, ways: Any,
    rings: Any, boxes: Any,
) -> None:  # fmt: skip
    leaders = np.full((len(anchors), 4), np.nan)
    box = np.empty(4)
    for n in range(len(anchors)):
        least, x, y = most, anchors[n, 0], anchors[n, 1]
        if not (np.isfinite(x) and np.isfinite(y)):
            continue
        wide, high, placed = sizes[n, 0], sizes[n, 1], n_taken + n
        for place in range(len(rings) * len(ways)):
            ring, way = rings[place // len(ways)], place % len(ways)
            box[0] = x + ways[way, 0] * (wide / 2 + ring * high) - wide / 2
            box[1] = y + ways[way, 1] * (high / 2 + ring * high) - high / 2
            box[2], box[3] = box[0] + wide, box[1] + high
            if not _is_free(box, area, boxes, placed, gap):
                continue
            cost = _cost(box, x, y, n, n_taken, spots, lines, boxes, leaders, least)
            if cost < least - 1e-6:
                least = cost
                for i in range(4):
                    boxes[placed, i] = box[i]
                leaders[n, 0], leaders[n, 1] = x, y
                leaders[n, 2], leaders[n, 3] = min(max(x, box[0]), box[2]), min(max(y, box[1]), box[3])


@compiled
def _is_free(box: Any, area: Any, boxes: Any, placed: int, gap: float) -> bool:
    """Whether a box lies within the area and off those that are placed."""
    if box[0] < area[0] or box[1] < area[1] or box[2] > area[2] or box[3] > area[3]:
        return False
    free = True
    for k in range(placed):
        free &= not _overlap(box, boxes[k, 0], boxes[k, 1], boxes[k, 2], boxes[k, 3], gap)
    return free


@compiled
def _cost(
    box: Any, x: float, y: float, n: int, n_taken: int, spots: Any, lines: Any, boxes: Any, leaders: Any, least: float
) -> float:
    """What a box costs, in its height; anything above ``least`` once that is exceeded."""
    high = box[3] - box[1]
    to_x, to_y = min(max(x, box[0]), box[2]), min(max(y, box[1]), box[3])
    cost = np.sqrt((to_x - x) * (to_x - x) + (to_y - y) * (to_y - y)) / high
    for k in range(len(leaders)):
        if k < n:
            cost += _LEADER_COST * _cross(x, y, to_x, to_y, leaders[k, 0], leaders[k, 1], leaders[k, 2], leaders[k, 3])
    for k in range(n_taken + n):
        left, top, right, bottom = boxes[k, 0], boxes[k, 1], boxes[k, 2], boxes[k, 3]
        if _cross(x, y, to_x, to_y, left, top, right, bottom) or _cross(x, y, to_x, to_y, left, bottom, right, top):
            cost += _LEADER_COST
    for k in range(len(spots)):
        if cost > least:
            break
        cost += _POINT_COST * _overlap(box, spots[k, 0], spots[k, 1], spots[k, 0], spots[k, 1], _POINT_ROOM * high)
    for k in range(len(lines)):
        if cost > least:
            break
        for step in range(9):
            at_x = lines[k, 0] + (lines[k, 2] - lines[k, 0]) * step / 8
            at_y = lines[k, 1] + (lines[k, 3] - lines[k, 1]) * step / 8
            cost += _SEGMENT_COST / 4 * _overlap(box, at_x, at_y, at_x, at_y, _SEGMENT_ROOM * high)
    return float(cost)


@compiled
def _overlap(box: Any, left: float, top: float, right: float, bottom: float, gap: float) -> bool:
    return bool(box[0] < right + gap and box[2] > left - gap and box[1] < bottom + gap and box[3] > top - gap)


@compiled
def _cross(px: float, py: float, qx: float, qy: float, rx: float, ry: float, sx: float, sy: float) -> bool:
    """Whether two segments properly cross."""
    side_p, side_q = _side(rx, ry, sx, sy, px, py), _side(rx, ry, sx, sy, qx, qy)
    side_r, side_s = _side(px, py, qx, qy, rx, ry), _side(px, py, qx, qy, sx, sy)
    return bool(side_p * side_q < 0 and side_r * side_s < 0)


@compiled
def _side(ax: float, ay: float, bx: float, by: float, cx: float, cy: float) -> float:
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
