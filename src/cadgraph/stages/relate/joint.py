"""Joints: which ends of lines face each other, which sit on the side of another line, and which lie in one place."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from cadgraph.geometry.line.centreline import Branch, Centreline
from cadgraph.model.derived import store_of
from cadgraph.model.scene import Floats, Ints, ranges

__all__ = ["Ends", "Facing", "Tap", "extent_about", "find_tap", "gather_ends", "nearest_on", "same_place"]

# Two ends in one place look the same way (cosine), and their axes are apart by at most this share of the lesser radius,
# or this much [m] where that is more.
_ALIKE, _OFFSET, _LEAST_OFFSET = 0.85, 0.35, 0.003
# A branch meets the wall at this angle at least (cosine) and runs into the axis within this share of the radius.
_SLANT, _ECCENTRIC = 0.86, 0.85
_SEATED = 5e-4  # what lies along a line lies this far from its ends [m]


@dataclass(frozen=True, eq=False)
class Ends:
    """The free ends of all lines, one row each.

    Args:
        part: ``(n,)`` the part that carries the line.
        index: ``(n,)`` number of the end among that line's.
        point: ``(n, 3)`` position [m].
        direction: ``(n, 3)`` unit vectors outward.
        radius: ``(n,)`` outer radius [m].
        bore: ``(n,)`` radius of the hole [m], NaN where none is seen.
        length: ``(n,)`` length of the branch that ends there [m].
        of_part: rows of each part.
    """

    part: Ints
    index: Ints
    point: Floats
    direction: Floats
    radius: Floats
    bore: Floats
    length: Floats
    of_part: Mapping[int, tuple[int, ...]]


class Facing(NamedTuple):
    """Two ends that face each other.

    Args:
        first: row of one end.
        second: row of the other.
        gap: distance from the first to the second along their axis [m]; negative where one lies in the other.
        corner: whether they meet at an angle.
        score: how sure that is, 0..1.
    """

    first: int
    second: int
    gap: float
    corner: bool = False
    score: float = 1.0


@dataclass(frozen=True)
class Tap:
    """Where an end sits on another line.

    Args:
        branch: number of that line's branch.
        s: position along the branch [m].
        point: ``(3,)`` the point there, on the axis [m].
        gap: distance from the end to the wall [m]; negative where it lies within.
        wall: radius of the branch there [m].
        sleeve: whether it lies along the line rather than across: a coupling over a pipe, a pipe in a socket.
    """

    branch: int
    s: float
    point: Floats
    gap: float
    wall: float
    sleeve: bool = False


def gather_ends(lines: Mapping[int, Centreline]) -> Ends:
    """The free ends of lines, by part."""
    parts = sorted(lines)
    counts = np.array([lines[part].n_ends for part in parts], np.int64)
    table = np.concatenate([np.zeros((0, 9)), *(lines[part].table_of_ends for part in parts)])
    last = np.cumsum(counts)
    rows = zip(parts, (last - counts).tolist(), last.tolist(), strict=True)
    return Ends(
        part=np.repeat(np.array(parts, np.int64), counts),
        index=ranges(np.zeros_like(counts), counts),
        point=table[:, :3].copy(),
        direction=table[:, 3:6].copy(),
        radius=table[:, 6].copy(),
        bore=table[:, 7].copy(),
        length=table[:, 8].copy(),
        of_part={part: tuple(range(start, stop)) for part, start, stop in rows if start < stop},
    )


def ahead_of(ends: Ends, row: int, point: Floats) -> float:
    """How far ahead of an end a point lies [m]."""
    return float((point - ends.point[row]) @ ends.direction[row])


def extent_about(ends: Ends, row: int, points: Floats) -> tuple[float, float]:
    """How long some points are along the axis of an end, and how far they reach from it [m].

    Args:
        ends: of all lines.
        row: the end.
        points: ``(n, 3)`` [m].
    """
    offset = points - ends.point[row]
    along = offset @ ends.direction[row]
    across = np.linalg.norm(offset - along[:, None] * ends.direction[row], axis=1)
    return float(np.ptp(along)) if len(along) else 0.0, float(across.max(initial=0.0))


def same_place(ends: Ends, row: int, others: Sequence[int], reach: float) -> int | None:
    """The nearest of other ends that lies where this one does and looks the same way; None if there is none."""
    best: tuple[float, int] | None = None
    for other in others:
        between = ends.point[other] - ends.point[row]
        along = float(between @ ends.direction[row])
        offset = float(np.linalg.norm(between - along * ends.direction[row]))
        lesser = float(min(ends.radius[row], ends.radius[other]))
        if (
            float(ends.direction[row] @ ends.direction[other]) > _ALIKE
            and offset <= max(_OFFSET * lesser, _LEAST_OFFSET)
            and abs(along) <= reach
            and (best is None or abs(along) < best[0])
        ):
            best = abs(along), other
    return None if best is None else best[1]


def nearest_on(branch: Branch, point: Floats) -> tuple[float, Floats, Floats, float, float]:
    """Where a branch is nearest to a point.

    Returns:
        Position along it [m], the point there, the unit direction of the branch there, its radius there [m], and the
        distance to the point [m].
    """
    known = store_of(branch, "nearest")
    key = tuple(point.tolist())
    if key not in known:
        known[key] = _nearest_on(branch, point)
    found: tuple[float, Floats, Floats, float, float] = known[key]
    return found


def _nearest_on(branch: Branch, point: Floats) -> tuple[float, Floats, Floats, float, float]:
    steps = np.diff(branch.points, axis=0)
    lengths = np.linalg.norm(steps, axis=1)
    offset = point - branch.points[:-1]
    u = np.clip((offset * steps).sum(axis=1) / np.maximum(lengths**2, 1e-300), 0.0, 1.0)
    feet = branch.points[:-1] + u[:, None] * steps
    gaps = np.linalg.norm(feet - point, axis=1)
    k = int(np.argmin(gaps))
    s = float(lengths[:k].sum() + u[k] * lengths[k])
    radius = float(branch.radius[k] + u[k] * (branch.radius[k + 1] - branch.radius[k]))
    return s, feet[k], steps[k] / max(float(lengths[k]), 1e-300), radius, float(gaps[k])


def find_tap(ends: Ends, row: int, line: Centreline, reach: float) -> Tap | None:
    """Where an end runs into the side of a line, or lies along it.

    Args:
        ends: of all lines.
        row: the end.
        line: of another part.
        reach: greatest gap to the wall [m].

    Returns:
        The place with the least gap, or None.
    """
    best: Tap | None = None
    for number, branch in enumerate(line.branches):
        tap = _tap_on(ends, row, number, branch, reach)
        if tap is not None and (best is None or tap.gap < best.gap):
            best = tap
    return best


def _tap_on(ends: Ends, row: int, number: int, branch: Branch, reach: float) -> Tap | None:
    """Where an end runs into the side of one branch, or lies along it."""
    point, direction, radius = ends.point[row], ends.direction[row], float(ends.radius[row])
    s, foot, tangent, wall, apart = nearest_on(branch, point)
    if abs(float(tangent @ direction)) >= _SLANT:
        on_axis = apart <= max(_OFFSET * min(radius, wall), _LEAST_OFFSET)
        seated = _SEATED < s < branch.length - _SEATED
        return Tap(number, s, foot, 0.0, wall, sleeve=True) if on_axis and seated else None
    # Ahead of the end its axis passes the branch's; how far off tells a branch from a pipe that only touches.
    ahead = foot - point
    inward = float(ahead @ direction)
    miss = float(np.linalg.norm(ahead - inward * direction))
    gap = apart - wall
    meets = radius <= 1.25 * wall and inward > -0.5 * wall and miss <= _ECCENTRIC * wall
    return Tap(number, s, foot, gap, wall) if meets and -1.05 * wall <= gap <= reach else None
