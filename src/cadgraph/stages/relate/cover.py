"""Whether what a pipe's end lies against closes it: a plate that it is welded to, a wall that it ends at."""

from __future__ import annotations

from collections.abc import Collection
from typing import Literal

import numpy as np

from cadgraph.geometry.mesh.axis_hits import hits, in_frame
from cadgraph.model.parts import Parts
from cadgraph.model.scene import Floats
from cadgraph.stages.relate.body_shape import triangles_of
from cadgraph.stages.relate.joint import Ends

__all__ = ["Cover", "cover_of"]

Cover = Literal["blind", "unknown"]
"""``blind``: a plate closes the end; ``unknown``: something covers it, and the pipe may go on behind."""

# A cover lies before the whole mouth: its middle, and rings at these shares of its radius, with as many places each.
_RINGS, _PLACES = (0.45, 0.85), 8
# It is against the mouth within this share of the radius, or this much [m].
_NEAR, _LEAST_NEAR = 0.1, 0.002
# A plate is no thicker than this [m] (chequer and base plates; walls and slabs are), and goes on beside the mouth: it
# is wider than this many radii both ways, which the flanges and bodies of devices are not.
_THIN, _WIDE = 0.03, 5.0
# A plate that stands upright and is wider than this many radii both ways is cladding, or the side of a cabinet or a
# container: nobody welds such a one onto a pipe to close it. What lies is a floor, that posts stand on.
_PANEL, _UPRIGHT = 30.0, 0.7
# Another pipe within this much behind a plate [m] goes through it.
_BEHIND = 0.15


def cover_of(parts: Parts, others: Collection[int], ends: Ends, row: int) -> Cover | None:
    """What closes an end.

    Args:
        parts: of the scene.
        others: the parts that the end's own part touches and that are neither lines nor of units.
        ends: of all lines.
        row: of the end.

    Returns:
        None where nothing lies before the whole mouth.
    """
    point, way, radius = ends.point[row], ends.direction[row], float(ends.radius[row])
    near = max(_NEAR * radius, _LEAST_NEAR)
    for part in sorted(others):
        low, high = parts.properties.aabb[part]
        if (point < low - radius).any() or (point > high + radius).any():
            continue
        corners = in_frame(triangles_of(parts, part), point, way)
        thick = _thickness(corners, radius, near)
        if thick is None:
            continue
        width = float(np.ptp(corners[..., :2].reshape(-1, 2), axis=0).min(initial=np.inf))
        closes = thick <= _THIN and width >= _WIDE * radius and not _is_panel(way, width / radius)
        return "blind" if closes and not _goes_on(ends, row, thick + _BEHIND) else "unknown"
    return None


def _is_panel(way: Floats, width: float) -> bool:
    """Whether a plate that a pipe heads for is a wall rather than its end; its width in radii of the pipe."""
    return width >= _PANEL and abs(float(way[2])) < _UPRIGHT


def _thickness(corners: Floats, radius: float, near: float) -> float | None:
    """How thick a surface is before a mouth at the origin [m]; 0 for a sheet, None where it leaves part of it open.

    Args:
        corners: ``(n, 3, 3)`` triangles, in a frame with the third axis out of the mouth [m].
        radius: of the mouth [m].
        near: how far from the mouth the surface may be [m].
    """
    angles = np.linspace(0.0, 2 * np.pi, _PLACES, endpoint=False) + 0.1
    rings = [share * radius * np.column_stack([np.cos(angles), np.sin(angles)]) for share in _RINGS]
    thickest = 0.0
    for place in np.concatenate([np.zeros((1, 2)), *rings]):
        heights = hits(corners, place)
        first = heights[np.abs(heights) <= near]
        if not len(first):
            return None
        thickest = max(thickest, _run_of(heights, float(first.min())))
    return thickest


def _run_of(heights: Floats, first: float) -> float:
    """From where a surface is entered to where it is left next; 0 where it is not left."""
    beyond = heights[heights > first + 1e-5]
    return float(beyond.min() - first) if len(beyond) else 0.0


def _goes_on(ends: Ends, row: int, reach: float) -> bool:
    """Whether another end faces this one within a distance, so that the pipe goes on behind what lies between."""
    apart = ends.point - ends.point[row]
    ahead = apart @ ends.direction[row]
    aside = np.linalg.norm(apart - ahead[:, None] * ends.direction[row], axis=1)
    facing = ends.direction @ ends.direction[row] < -0.9
    return bool((facing & (ahead > 0.0) & (ahead <= reach) & (aside <= ends.radius[row])).any())
