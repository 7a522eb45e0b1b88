"""Finding room for labels in a picture."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from cadgraph.model.scene import Floats

__all__ = ["place_boxes"]

_RINGS = (1.0, 1.7, 2.6, 3.8, 5.4, 7.5, 10.0)  # distances tried, in heights of a label
_DIRECTIONS = 20
_POINT_COST, _SEGMENT_COST, _LEADER_COST = 2.5, 1.2, 3.0  # in heights of a label, for each that is covered or crossed


def place_boxes(
    anchors: npt.ArrayLike,
    sizes: npt.ArrayLike,
    area: tuple[float, float, float, float],
    *,
    taken: npt.ArrayLike = (),
    points: npt.ArrayLike = (),
    segments: npt.ArrayLike = (),
    gap: float = 3.0,
) -> Floats:
    """Places a box near each anchor, so that boxes don't overlap and hide little.

    The boxes are placed one after the other, each where it costs least: near its anchor, off the points and segments,
    its leader line off the others' boxes and leaders.

    Args:
        anchors: ``(n, 2)`` what each label speaks of [px].
        sizes: ``(n, 2)`` width and height of each box [px].
        area: left, top, right and bottom that boxes must stay within [px].
        taken: ``(k, 4)`` boxes that are already there: left, top, right, bottom.
        points: ``(p, 2)`` points better not covered.
        segments: ``(s, 4)`` lines better not covered: x and y of both ends.
        gap: least distance between boxes [px].

    Returns:
        ``(n, 4)`` left, top, right, bottom; NaN for a box that finds no room.
    """
    a = np.asarray(anchors, np.float64).reshape(-1, 2)
    size = np.asarray(sizes, np.float64).reshape(-1, 2)
    boxes = list(np.asarray(taken, np.float64).reshape(-1, 4))
    leaders: list[Floats] = []
    spots = np.concatenate([a, np.asarray(points, np.float64).reshape(-1, 2)])
    lines = np.asarray(segments, np.float64).reshape(-1, 4)
    result = np.full((len(a), 4), np.nan)
    for i, anchor in enumerate(a):
        if not np.isfinite(anchor).all():
            continue
        tried = _candidates(anchor, size[i])
        free = (tried[:, 0] >= area[0]) & (tried[:, 1] >= area[1])
        free &= (tried[:, 2] <= area[2]) & (tried[:, 3] <= area[3])
        for other in boxes:
            free &= ~_overlap(tried, other, gap)
        tried = tried[free]
        if not len(tried):
            continue
        cost = _costs(tried, anchor, size[i, 1], spots, lines, boxes, leaders)
        best = int(np.argmin(np.round(cost, 6)))
        result[i] = tried[best]
        boxes.append(tried[best])
        leaders.append(np.concatenate([anchor, _nearest_on_box(tried[best : best + 1], anchor)[0]]))
    return result


def _candidates(anchor: Floats, size: Floats) -> Floats:
    turn = np.arange(_DIRECTIONS) * 2 * math.pi / _DIRECTIONS
    # Up and to the right first: of equals the first wins.
    way = np.stack([np.cos(turn - math.pi / 4), np.sin(turn - math.pi / 4)], axis=1)
    centers = np.concatenate([anchor + way * (size / 2 + ring * size[1]) for ring in _RINGS])
    return np.concatenate([centers - size / 2, centers + size / 2], axis=1)


def _costs(
    tried: Floats, anchor: Floats, unit: float, spots: Floats, lines: Floats, boxes: list[Floats], leaders: list[Floats]
) -> Floats:
    near = _nearest_on_box(tried, anchor)
    cost: Floats = np.linalg.norm(near - anchor, axis=1) / unit
    for spot in spots:
        cost += _POINT_COST * _overlap(tried, np.concatenate([spot, spot]), 0.4 * unit)
    for line in lines:
        for share in np.linspace(0, 1, 9):
            at = line[:2] * (1 - share) + line[2:] * share
            cost += _SEGMENT_COST / 4 * _overlap(tried, np.concatenate([at, at]), 0.2 * unit)
    own = np.concatenate([np.broadcast_to(anchor, near.shape), near], axis=1)
    for other in leaders:
        cost += _LEADER_COST * _cross(own, other)
    for box in boxes:
        diagonals = (box, box[[0, 3, 2, 1]])
        cost += _LEADER_COST * np.maximum(_cross(own, diagonals[0]), _cross(own, diagonals[1]))
    return cost


def _nearest_on_box(boxes: Floats, point: Floats) -> Floats:
    nearest: Floats = np.clip(point, boxes[:, :2], boxes[:, 2:])
    return nearest


def _overlap(boxes: Floats, other: Floats, gap: float) -> npt.NDArray[np.bool_]:
    apart = (boxes[:, 0] >= other[2] + gap) | (boxes[:, 2] <= other[0] - gap)
    apart |= (boxes[:, 1] >= other[3] + gap) | (boxes[:, 3] <= other[1] - gap)
    overlap: npt.NDArray[np.bool_] = ~apart
    return overlap


def _cross(segments: Floats, other: Floats) -> npt.NDArray[np.bool_]:
    """Whether each segment ``(n, 4)`` properly crosses another ``(4,)``."""
    p, q = segments[:, :2], segments[:, 2:]
    r, s = other[:2], other[2:]
    side_p, side_q = _side(r, s, p), _side(r, s, q)
    side_r, side_s = _side(p, q, r), _side(p, q, s)
    crossing: npt.NDArray[np.bool_] = (side_p * side_q < 0) & (side_r * side_s < 0)
    return crossing


def _side(a: Floats, b: Floats, c: Floats) -> Floats:
    one, two = b - a, c - a
    side: Floats = one[..., 0] * two[..., 1] - one[..., 1] * two[..., 0]
    return side
