"""Ear clipping: a plane outline to triangles without new corners (Meisters 1975, two ears theorem)."""

from __future__ import annotations

from collections.abc import Sequence

__all__ = ["clip_ears", "double_area"]

Corner = tuple[float, float]
Triangle = tuple[int, int, int]


def clip_ears(
    corners: Sequence[Corner], outline: Sequence[int], noise: float, *, skip: int = 0
) -> tuple[list[Triangle], int]:
    """Cuts convex corners that hold no other corner.

    Args:
        corners: places in the plane [m].
        outline: which of them follow each other, counter-clockwise, at least 3; a hole that a bridge joins to the
            outline has corners twice in one place.
        noise: twice the area below which a corner counts as straight, or on an edge [m2].
        skip: how many corners are passed over after each cut: 1 goes round, so that triangles stay even.

    Returns:
        The triangles, counter-clockwise, two fewer than corners; and how many corners were cut
        although they are no ears, the flattest ones, as nothing else was left: 0 unless the outline crosses itself or
        has corners without area.
    """
    left = list(outline)
    turns = [_turn_at(corners, left, i) for i in range(len(left))]
    triangles: list[Triangle] = []
    start = n_forced = 0
    while len(left) > 3:
        ear = _next_ear(corners, left, turns, start, noise)
        if ear is None:
            ear, n_forced = min(range(len(left)), key=lambda i: abs(turns[i])), n_forced + 1
        triangles.append((left[ear - 1], left[ear], left[(ear + 1) % len(left)]))
        del left[ear], turns[ear]
        for beside in (ear - 1, ear % len(left)):
            turns[beside] = _turn_at(corners, left, beside)
        start = (ear + skip) % len(left)
    triangles.append((left[0], left[1], left[2]))
    return triangles, n_forced


def double_area(a: Corner, b: Corner, c: Corner) -> float:
    """Twice the area of a triangle, negative where it is clockwise."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _turn_at(corners: Sequence[Corner], left: Sequence[int], i: int) -> float:
    return double_area(corners[left[i - 1]], corners[left[i]], corners[left[(i + 1) % len(left)]])


def _next_ear(
    corners: Sequence[Corner], left: Sequence[int], turns: Sequence[float], start: int, noise: float
) -> int | None:
    """The first place from ``start`` on whose corner can be cut off, or None."""
    n = len(left)
    # Only corners that don't turn left can lie in an ear.
    inner = [corners[left[i]] for i in range(n) if turns[i] <= noise]
    for step in range(n):
        i = (start + step) % n
        if turns[i] > noise:
            ear = corners[left[i - 1]], corners[left[i]], corners[left[(i + 1) % n]]
            if not _holds_any(ear, inner, noise):
                return i
    return None


def _holds_any(ear: tuple[Corner, Corner, Corner], points: Sequence[Corner], noise: float) -> bool:
    """Whether any place lies in or on a counter-clockwise triangle, and not where a corner of it is."""
    (ax, ay), (bx, by), (cx, cy) = a, b, c = ear
    left, right, low, high = min(ax, bx, cx), max(ax, bx, cx), min(ay, by, cy), max(ay, by, cy)
    for point in points:
        x, y = point
        if x < left or x > right or y < low or y > high or point in ear:
            continue
        if min(double_area(a, b, point), double_area(b, c, point), double_area(c, a, point)) >= -noise:
            return True
    return False
