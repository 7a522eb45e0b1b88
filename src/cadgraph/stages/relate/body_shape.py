"""How the surface of a device lies about the line that runs through it."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.model.parts import Opening, Parts, UnitParts
from cadgraph.model.scene import Floats

__all__ = ["Surface", "lean", "line_through", "surface_about"]

# A neck leans where its middle moves by at least this share of its height (21 degrees), in about equal steps: no step
# is more than this many times another. What moves in one step is a lever on an upright neck.
_LEANS, _STEADY = 0.38, 3.0
_THIRDS = 3
# A neck rises over the ends of its body by this factor at least; else there is none to look at.
_RISES = 1.15
# What lies within this angle of the way a neck points belongs to it (cosine).
_ASIDE = 0.6


@dataclass(frozen=True)
class Surface:
    """Pieces of a surface about an axis, one row each.

    Args:
        along: ``(n,)`` along the axis, from -0.5 at its start to 0.5 at its end, beyond for what lies beyond.
        out: ``(n, 2)`` away from the axis, in a frame across it [m].
        area: ``(n,)`` [m2].
        length: of the axis [m].
        across: ``(2, 3)`` unit vectors of the frame.
    """

    along: Floats
    out: Floats
    area: Floats
    length: float
    across: Floats

    @property
    def height(self) -> Floats:
        """``(n,)`` distance from the axis [m]."""
        found: Floats = np.linalg.norm(self.out, axis=1)
        return found


def line_through(openings: Sequence[Opening]) -> tuple[Floats, Floats] | None:
    """Start and end of the line through two openings that lie in one line; None for any others."""
    if len(openings) != 2:
        return None
    first, last = (np.asarray(opening.point, np.float64) for opening in openings)
    length = float(np.linalg.norm(last - first))
    if length <= 1e-6:
        return None
    axis = (last - first) / length
    for opening, outward in zip(openings, (-axis, axis), strict=True):
        if opening.direction is not None and float(np.dot(opening.direction, outward)) < 0.9:
            return None
    return first, last


def surface_about(parts: Parts, some: Collection[int], start: Floats, end: Floats) -> Surface:
    """The surface of some parts about an axis, as middles of triangles no larger than a twelfth of the axis.

    Args:
        parts: of the scene.
        some: numbers of parts.
        start: ``(3,)`` of the axis [m].
        end: ``(3,)`` [m].
    """
    length = float(np.linalg.norm(end - start))
    axis = (end - start) / length
    helper = np.array([0.0, 0.0, 1.0]) if abs(axis[2]) < 0.9 else np.array([1.0, 0.0, 0.0])
    first = np.cross(axis, helper)
    first /= np.linalg.norm(first)
    across = np.array([first, np.cross(axis, first)])
    corners = np.concatenate([_triangles(parts, part) for part in sorted(some)]) - (start + end) / 2
    middles, area = _split(corners, length / 12)
    return Surface(middles @ axis / length, middles @ across.T, area, length, across)


def _triangles(parts: Parts, part: int) -> Floats:
    vertices, faces = parts.scene.mesh(part)
    inside = faces[(faces >= 0).all(axis=1) & (faces < len(vertices)).all(axis=1)]
    corners = vertices[inside]
    kept: Floats = corners[np.isfinite(corners).all(axis=(1, 2))]
    return kept


def _split(corners: Floats, longest: float) -> tuple[Floats, Floats]:
    """Middles and areas of triangles, long ones cut at the middle of their longest edge until they are short."""
    middles, areas = [], []
    for _ in range(12):
        edges = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2)
        long = edges.max(axis=1) > longest if len(corners) < 200_000 else np.zeros(len(corners), bool)
        done = corners[~long]
        middles.append(done.mean(axis=1))
        areas.append(0.5 * np.linalg.norm(np.cross(done[:, 1] - done[:, 0], done[:, 2] - done[:, 0]), axis=1))
        if not long.any():
            break
        left, which = corners[long], edges[long].argmax(axis=1)
        rows = np.arange(len(left))
        a, b, c = (left[rows, (which + k) % 3] for k in range(3))
        half = (a + b) / 2
        corners = np.concatenate([np.stack([a, half, c], axis=1), np.stack([half, b, c], axis=1)])
    return np.concatenate(middles), np.concatenate(areas)


def lean(surface: Surface) -> float | None:
    """How far what stands out of a body leans towards the end of its axis: the slope of its middle [m/m].

    Returns:
        0 for an upright neck; None where nothing stands out, or what does is no straight neck.
    """
    height = surface.height
    ends = np.abs(surface.along) > 0.4
    rim = float(height[ends & (np.abs(surface.along) <= 0.55)].max(initial=0.0))
    top = float(height.max(initial=0.0))
    if rim <= 0.0 or top < _RISES * rim:
        return None
    outer = height > rim
    way = (surface.area[outer, None] * surface.out[outer]).sum(axis=0)
    norm = float(np.linalg.norm(way))
    if norm <= 0.0:
        return None
    rise = surface.out @ (way / norm)
    neck = (rise > 0.55 * rim) & (rise > _ASIDE * height)
    low, high = 0.55 * rim, float(rise[neck].max(initial=0.0))
    borders = np.linspace(low, high, _THIRDS + 1)
    steps = []
    for a, b in zip(borders[:-1], borders[1:], strict=True):
        row = neck & (rise >= a) & (rise <= b)
        weight = float(surface.area[row].sum())
        if weight <= 0.0:
            return None
        steps.append(float((surface.area[row] * surface.along[row]).sum()) / weight * surface.length)
    return _slope(steps, (high - low) / _THIRDS)


def _slope(steps: Sequence[float], apart: float) -> float | None:
    """The slope of a middle that moves in equal steps; 0 where it stays."""
    moves = np.diff(steps) / apart
    if np.abs(moves).max() < _LEANS / 2:
        return 0.0
    least, most = float(np.abs(moves).min()), float(np.abs(moves).max())
    if np.any(moves * moves[0] <= 0) or most > _STEADY * least or float(np.abs(moves.mean())) < _LEANS:
        return None
    return float(moves.mean())
