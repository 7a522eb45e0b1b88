"""A look at one mesh alone that tells what its outside doesn't: cut open, on its end, or square on its broad side."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from cadgraph.draw.render.camera import Camera, frame
from cadgraph.draw.render.pair import PairRenderer
from cadgraph.draw.render.target import Target, end_box, steady
from cadgraph.model.scene import Floats

__all__ = ["Detail", "find_detail"]

_MARGIN = 0.1
_TRIAL = 96  # [px] of the pictures by which it is judged whether a cut tells anything
_SOLID = 0.82  # share of the closed face in what a cut shows from which on there is nothing inside
_MISSED = 0.02  # and up to which the cut goes between the pieces of what it should show
_ROUND = 0.08  # extents that differ less are those of something round, whose axes lie anywhere
_FLAT, _SHEET = 0.35, 0.08  # thickness over width of what is flat, and of what has no inside at all
_OFF = 0.0137  # share of the extent by which a cut lies beside the middle, where faces may lie
_UPWARDS, _SIDEWAYS = 0.34, 0.22  # how far a view is turned out of the normal of what it looks at
_LONG, _END_WIDTHS = 5.0, 2.2  # lengths over width from which on the end is shown close up, and so many widths of it


@dataclass(frozen=True)
class Detail:
    """A look at a mesh alone.

    Args:
        camera: where from.
        depth: of what it is to show, along the viewing direction [m].
        kind: cut open, on the end of its longest axis, or square on its broad side.
        cut: ``(4,)`` the plane: what lies at ``normal . x > offset`` is taken away; None where nothing is cut.
        closed: whether the cut shows material; thin sheets have none.
    """

    camera: Camera
    depth: float
    kind: Literal["cut", "end", "side"]
    cut: Floats | None = None
    closed: bool = False


def find_detail(renderer: PairRenderer, target: Target, like: Floats, size: tuple[int, int]) -> Detail:
    """Chooses the look that tells most.

    A cut, where something is hollow; else the end of what is long, or the broad side of what is flat.

    Args:
        renderer: of the scene.
        target: the mesh.
        like: ``(3,)`` direction towards a camera that shows the mesh well; the new one is on its side.
        size: width and height of the picture [px].
    """
    thick, wide = float(target.extents[2]), max(float(target.extents[1]), 1e-9)
    if target.extents[0] >= _LONG * wide:
        sign = 1 if target.axes[0] @ like >= 0 else -1
        direction = _oblique(sign * target.axes[0], like)
        return Detail(*_framed(end_box(target, sign, _END_WIDTHS), direction, size), "end")
    if thick >= _SHEET * wide:
        normal = _across(target, like)
        along = target.vertices @ normal
        low, high = float(along.min()), float(along.max())
        cut = np.round([*normal, (low + high) / 2 + _OFF * (high - low)], 6)
        kept = target.vertices - np.maximum(along - cut[3], 0.0)[:, None] * normal
        trial, _ = _framed(kept, normal, (_TRIAL, _TRIAL))
        share, closed = renderer.share_of_cut(target.mesh, trial, cut)
        if not closed or _MISSED < share < _SOLID:
            return Detail(*_framed(kept, _oblique(normal, like), size), "cut", cut, closed)
    flat = thick < _FLAT * wide
    # Of what is round like a thick disc the ends are its two faces.
    axis = target.axes[2 if flat or wide > (1 - _ROUND) * target.extents[0] else 0]
    axis = axis if axis @ like >= 0 else -axis
    framed = _framed(target.vertices, _oblique(axis, like, 0.6 if flat else 1.3), size)
    return Detail(*framed, "side" if flat else "end")


def _framed(points: Floats, direction: Floats, size: tuple[int, int]) -> tuple[Camera, float]:
    camera = steady(frame(points, np.round(direction, 9), size, margin=_MARGIN))
    return camera, float(((points.min(axis=0) + points.max(axis=0)) / 2 - camera.eye) @ camera.forward)


def _across(target: Target, like: Floats) -> Floats:
    """Unit normal of a plane through the mesh that shows most of its inside: along its longest or its round axis."""
    a, b, c = (max(float(e), 1e-9) for e in target.extents)
    axes = target.axes
    if c > (1 - _ROUND) * a:
        level = np.array([1.0, 0, 0]) if abs(like[0]) > abs(like[1]) else np.array([0, 1.0, 0])
        normal = level
    elif c > (1 - _ROUND) * b:
        normal = _perpendicular(like, axes[0], axes[1])
    elif b > (1 - _ROUND) * a:
        normal = _perpendicular(like, axes[2], axes[1])
    else:
        normal = axes[2]
    return normal if normal @ like >= 0 else -normal


def _perpendicular(direction: Floats, axis: Floats, otherwise: Floats) -> Floats:
    rest = direction - (direction @ axis) * axis
    length = float(np.linalg.norm(rest))
    unit: Floats = rest / max(length, 1e-9)
    return unit if length > 0.05 else otherwise


def _oblique(normal: Floats, like: Floats, share: float = 1.0) -> Floats:
    """A direction near a normal, turned upwards and sideways so that depth shows."""
    up = np.array([0.0, 0.0, 1.0]) - normal[2] * normal
    if np.linalg.norm(up) < 0.3:
        up = like - (like @ normal) * normal
    if np.linalg.norm(up) < 1e-6:
        up = np.array([1.0, 0.0, 0.0]) - normal[0] * normal
    up = up / max(float(np.linalg.norm(up)), 1e-9)
    side = np.cross(up, normal)
    side = side if side @ like >= 0 else -side
    turned = normal + share * (_UPWARDS * up + _SIDEWAYS * side)
    unit: Floats = turned / float(np.linalg.norm(turned))
    return unit
