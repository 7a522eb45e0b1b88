"""How the surface of a device lies about the line that runs through it."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.geometry.mesh.cut import cut_short
from cadgraph.model.derived import store_of
from cadgraph.model.parts import Opening, Parts
from cadgraph.model.scene import Floats

__all__ = ["Surface", "box_around", "lean", "lean_of", "line_through", "surface_about", "triangles_of"]

# A neck leans at least and at most as far (slopes of 20 and 65 degrees), and is upright up to a slope of 10 degrees.
_LEANS, _LIES, _UPRIGHT = 0.36, 2.14, 0.18
# What leans stands beside the middle of the body by at least this share of its length, on the side that it leans to.
_BESIDE = 0.03
# A neck is round: its surface looks as much along the body as across it, within this share.
_ROUND = 0.45
# What rises over the ends of a body by this factor stands out of it; it is a neck where it rises to the second.
_OVER, _RISES = 1.02, 1.1
# What lies within this angle of the way a neck points belongs to it (cosine).
_ASIDE = 0.6


@dataclass(frozen=True)
class Surface:
    """Pieces of a surface about an axis, one row each.

    Args:
        along: ``(n,)`` along the axis, from -0.5 at its start to 0.5 at its end, beyond for what lies beyond.
        out: ``(n, 2)`` away from the axis, in a frame across it [m].
        normal: ``(n, 3)`` unit normals, along the axis and in the frame across it, of either sign.
        area: ``(n,)`` [m2].
        length: of the axis [m].
        across: ``(2, 3)`` unit vectors of the frame.
    """

    along: Floats
    out: Floats
    normal: Floats
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
    corners = np.concatenate([triangles_of(parts, part) for part in sorted(some)]) - (start + end) / 2
    middles, vectors = cut_short(corners, length / 12)
    twice = np.linalg.norm(vectors, axis=1)
    normal = vectors / np.maximum(twice, 1e-300)[:, None] @ np.vstack([axis, across]).T
    return Surface(middles @ axis / length, middles @ across.T, normal, twice / 2, length, across)


def box_around(parts: Parts, some: Collection[int]) -> tuple[Floats, Floats]:
    """The lowest and the highest corner of the box around some parts, ``(3,)`` each [m]."""
    boxes = parts.properties.aabb[list(some)]
    return boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)


def triangles_of(parts: Parts, part: int) -> Floats:
    """``(n, 3, 3)`` corners of the triangles of a part that are whole and finite [m]."""
    vertices, faces = parts.scene.mesh(part)
    inside = faces[(faces >= 0).all(axis=1) & (faces < len(vertices)).all(axis=1)]
    corners = vertices[inside]
    kept: Floats = corners[np.isfinite(corners).all(axis=(1, 2))]
    return kept


def lean_of(parts: Parts, some: Collection[int], line: tuple[Floats, Floats]) -> float | None:
    """How far the neck of some parts leans along the line through them; see ``lean``."""
    known = store_of(parts, "leaning necks")
    key = tuple(sorted(some)), *(tuple(point.tolist()) for point in line)
    if key not in known:
        known[key] = lean(surface_about(parts, some, *line))
    found: float | None = known[key]
    return found


def lean(surface: Surface) -> float | None:
    """How far the round neck that stands out of a body leans towards the end of its axis.

    Args:
        surface: about the line through the body.

    Returns:
        The slope of the neck's own axis [m/m]; 0 for an upright neck; None where nothing stands out, or what does is no
        round neck.
    """
    height = surface.height
    pull = (surface.area * height) @ surface.out
    norm = float(np.linalg.norm(pull))
    if norm <= 0.0:
        return None
    up = pull / norm
    rise = surface.out @ up
    # The ends are round, so that the side without a neck tells how high they are.
    ends = (np.abs(surface.along) > 0.4) & (np.abs(surface.along) <= 0.55) & (rise <= 0.0)
    rim = float(height[ends].max(initial=0.0))
    neck = (height > _OVER * rim) & (rise > _ASIDE * height)
    if rim <= 0.0 or float(rise[neck].max(initial=0.0)) < _RISES * rim:
        return None
    side = np.array([-up[1], up[0]])
    normal = np.column_stack([surface.normal[neck, 0], surface.normal[neck, 1:] @ up, surface.normal[neck, 1:] @ side])
    slope = _slope((surface.area[neck, None] * normal).T @ normal)
    # A neck that leans from the middle of its body ends up on that side.
    aside = float(surface.area[neck] @ surface.along[neck]) / float(surface.area[neck].sum())
    return slope if not slope or aside * np.sign(slope) >= _BESIDE else None


def _slope(looks: Floats) -> float | None:
    """The slope of the axis of a round body.

    Args:
        looks: ``(3, 3)`` how much of its surface looks where: along the line, up, across; for a body of revolution the
            same in all directions across its axis.
    """
    moments, ways = np.linalg.eigh(looks[:2, :2])
    across = float(looks[2, 2])
    k = int(np.abs(moments - across).argmax())
    if across <= 0.0 or abs(float(moments[1 - k]) - across) > _ROUND * across:
        return None
    along, up = (float(x) for x in ways[:, k])
    if abs(along) <= _UPRIGHT * abs(up):
        return 0.0
    slope = along / up if up else np.inf
    return slope if _LEANS <= abs(slope) <= _LIES else None
