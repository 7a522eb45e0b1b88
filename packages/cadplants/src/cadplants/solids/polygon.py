"""Plane outlines, and triangles that fill them."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from cadgraph.geometry.mesh.ears import clip_ears
from cadgraph.model.scene import Floats, Ints

__all__ = ["circle", "rounded_rectangle", "section_angle", "section_channel", "section_i", "triangulate"]

_TINY = 1e-15  # m2; below this a corner counts as straight


def circle(radius: float, sides: int, center: tuple[float, float] = (0.0, 0.0), phase: float = 0.0) -> Floats:
    """``(sides, 2)`` corners of a regular polygon on a circle, counter-clockwise [m]."""
    angles = phase + np.arange(sides) * 2 * np.pi / sides
    unit: Floats = np.column_stack([np.cos(angles), np.sin(angles)])
    corners: Floats = np.asarray(center, np.float64) + radius * unit
    return corners


def rounded_rectangle(length: float, width: float, radius: float, steps: int = 6) -> Floats:
    """``(4 * (steps + 1), 2)`` corners of a rectangle about the origin with round corners [m]."""
    if radius <= 0:
        x, y = length / 2, width / 2
        return np.array([[x, -y], [x, y], [-x, y], [-x, -y]])
    points = []
    for quarter, (sx, sy) in enumerate([(1, 1), (-1, 1), (-1, -1), (1, -1)]):
        angles = quarter * np.pi / 2 + np.linspace(0, np.pi / 2, steps + 1)
        center = np.array([sx * (length / 2 - radius), sy * (width / 2 - radius)])
        points.append(center + radius * np.column_stack([np.cos(angles), np.sin(angles)]))
    return np.concatenate(points)


def section_i(height: float, width: float, web: float, flange: float) -> Floats:
    """``(12, 2)`` outline of an I or H section about its centre, web along y [m]."""
    h, b, t = height / 2, width / 2, web / 2
    inner = h - flange
    return np.array(
        [
            [-b, -h], [b, -h], [b, -inner], [t, -inner], [t, inner], [b, inner],
            [b, h], [-b, h], [-b, inner], [-t, inner], [-t, -inner], [-b, -inner],
        ]
    )  # fmt: skip


def section_channel(height: float, width: float, web: float, flange: float) -> Floats:
    """``(8, 2)`` outline of a U section, back of the web on x = 0, open to +x [m]."""
    h = height / 2
    inner = h - flange
    return np.array(
        [[0, -h], [width, -h], [width, -inner], [web, -inner], [web, inner], [width, inner], [width, h], [0, h]]
    )


def section_angle(leg: float, thickness: float) -> Floats:
    """``(6, 2)`` outline of an equal angle with its heel at the origin [m]."""
    return np.array([[0, 0], [leg, 0], [leg, thickness], [thickness, thickness], [thickness, leg], [0, leg]])


def triangulate(outline: Floats, holes: tuple[Floats, ...] = ()) -> Ints:
    """Fills an outline with holes by cutting ears off it.

    Args:
        outline: ``(n, 2)`` corners, counter-clockwise.
        holes: each ``(m, 2)`` corners, counter-clockwise too, inside the outline and apart from each other.

    Returns:
        ``(n_triangles, 3)`` int64 indices into outline and holes in one row, counter-clockwise. Every boundary edge is
        the edge of exactly one triangle.

    Raises:
        ValueError: the outlines cross, or a hole lies outside.
    """
    points = np.concatenate([outline, *holes])
    loop = list(range(len(outline)))
    starts = np.cumsum([len(outline)] + [len(hole) for hole in holes])
    order = sorted(range(len(holes)), key=lambda i: (-float(holes[i][:, 0].max()), i))
    for i in order:
        ring = list(range(int(starts[i]), int(starts[i + 1])))[::-1]
        loop = _bridge(points, loop, ring)
    triangles, n_forced = clip_ears([(float(x), float(y)) for x, y in points], loop, _TINY, skip=1)
    if n_forced:
        raise ValueError("an outline crosses itself or its holes")
    return np.array(triangles, np.int64)


def _bridge(points: Floats, loop: list[int], ring: list[int]) -> list[int]:
    """Joins a clockwise hole to the loop by a pair of edges through its rightmost corner."""
    first = max(range(len(ring)), key=lambda k: (points[ring[k], 0], points[ring[k], 1]))
    ring = ring[first:] + ring[:first]
    x, y = points[ring[0]]
    a, b = points[loop], points[np.roll(loop, -1)]
    crossing = (a[:, 1] <= y) & (b[:, 1] > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        hit = a[:, 0] + (y - a[:, 1]) * (b[:, 0] - a[:, 0]) / (b[:, 1] - a[:, 1])
    hit = np.where(crossing & (hit >= x), hit, np.inf)
    edge = int(np.argmin(hit))
    if not np.isfinite(hit[edge]):
        raise ValueError(f"a hole at ({x:g}, {y:g}) lies outside its outline")
    following = (edge + 1) % len(loop)
    pick = edge if a[edge, 0] > b[edge, 0] else following
    target = points[loop[pick]]
    corner = np.array([hit[edge], y])
    before, here, after = points[np.roll(loop, 1)], points[loop], points[np.roll(loop, -1)]
    reflex = _cross(here - before, after - here) <= 0
    tri = np.array([[x, y], corner, target] if target[1] > y else [[x, y], target, corner])
    inside = reflex & _inside(here, tri) & (np.abs(here - target).sum(axis=1) > 0) & (here[:, 0] >= x)
    if inside.any():
        offset = here - (x, y)
        slope = np.abs(offset[:, 1]) / np.maximum(offset[:, 0], 1e-12)
        rank = np.where(inside, slope, np.inf)
        best = np.flatnonzero(rank <= rank.min() * (1 + 1e-12))
        pick = int(best[np.argmin(offset[best, 0])])
    return [*loop[: pick + 1], *ring, ring[0], *loop[pick:]]


def _cross(u: Floats, v: Floats) -> Floats:
    result: Floats = u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
    return result


def _inside(points: Floats, triangle: Floats) -> npt.NDArray[np.bool_]:
    """Whether points lie in or on a counter-clockwise triangle."""
    a, b, c = triangle
    result: npt.NDArray[np.bool_] = (
        (_cross(b - a, points - a) >= -_TINY)
        & (_cross(c - b, points - b) >= -_TINY)
        & (_cross(a - c, points - c) >= -_TINY)
    )
    return result
