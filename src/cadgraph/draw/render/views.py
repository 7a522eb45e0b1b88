"""Directions from which a scene, or a part of it, shows well."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from cadgraph.draw.render.camera import Camera, direction_from_angles, frame
from cadgraph.draw.render.caster import Caster
from cadgraph.draw.render.picture import Renderer
from cadgraph.draw.render.target import Target, View, choose_views
from cadgraph.model.scene import Floats

__all__ = ["Target", "View", "choose_views", "three_quarter_view"]

ELEVATION = math.radians(27.0)
"""High enough to see on top of pipes and decks, low enough to see between them."""

_TURNS = np.radians([-35, 35, -55, 55, 145, 215, 125, 235])  # from the normal of the longer side: never square on
_LENGTHWISE = 0.75  # looking more along the longer side than at it foreshortens it: the score counts so much less
_FRONT_BONUS = 1.06  # a view from -Y wins unless another shows clearly more
_REPEAT_MALUS = 0.1  # a side that was shown already is shown again only if the others show nothing
_TRIAL_POINTS = 12_000
_TRIAL_HEIGHT = 96  # [px] of the trial pictures


def three_quarter_view(
    renderer: Renderer,
    meshes: npt.ArrayLike | None = None,
    *,
    alone: bool = False,
    aspect: float = 1.6,
    elevation: float = ELEVATION,
    unlike: npt.ArrayLike | None = None,
) -> Floats:
    """The direction, obliquely from above, that shows most.

    Among eight azimuths beside the sides of the smallest rectangle round the ground plan, the one from which the
    meshes fill most of the picture; many meshes seen a little count more than one seen well.

    Args:
        renderer: of the scene.
        meshes: what has to be seen; all by default.
        alone: whether the others are out of the way; else they may stand in front.
        aspect: width over height of the picture.
        elevation: of the camera [rad].
        unlike: ``(3,)`` a direction from which there is a picture already; another side is chosen.

    Returns:
        ``(3,)`` unit vector towards the camera.
    """
    points = renderer.points(meshes)
    # Trial pictures need no exact frame.
    points = points[:: max(1, len(points) // _TRIAL_POINTS)]
    wanted = np.zeros(renderer.scene.n_meshes, bool)
    wanted[slice(None) if meshes is None else np.asarray(meshes, np.int64)] = True
    caster = renderer.caster(meshes if alone else None)
    size = (round(_TRIAL_HEIGHT * aspect), _TRIAL_HEIGHT)
    start = _long_side_normal(points)
    best, chosen = -1.0, direction_from_angles(-math.pi / 3, elevation)
    for turn in _TURNS:
        direction = direction_from_angles(start + turn, elevation)
        score = _shown(caster, frame(points, direction, size, margin=0.0), renderer.mesh_of_face, wanted)
        if abs(math.cos(turn)) < math.sqrt(0.5):
            score *= _LENGTHWISE
        if direction[1] < 0:
            score *= _FRONT_BONUS
        if unlike is not None and np.dot(direction[:2], np.asarray(unlike, np.float64)[:2]) > 0:
            score *= _REPEAT_MALUS
        if score > best * (1 + 1e-6):
            best, chosen = score, direction
    return chosen


def _shown(caster: Caster, camera: Camera, mesh_of_face: npt.NDArray[np.int32], wanted: npt.NDArray[np.bool_]) -> float:
    """Sum over the wanted meshes of the root of the share of the picture that each fills."""
    rows, columns = np.divmod(np.arange(camera.width * camera.height), camera.width)
    origins, directions = camera.rays(columns + 0.5, rows + 0.5)
    face = caster.first(caster.local(origins), directions.astype(np.float32)).face
    seen = np.bincount(mesh_of_face[face[face >= 0]], minlength=len(wanted))
    return float(np.sqrt(seen[wanted]).sum())


def _long_side_normal(points: Floats) -> float:
    """Azimuth [rad] of the normal of the longer side of the smallest rectangle round the ground plan; in front (-Y)."""
    flat = points[:, :2] - points[:, :2].mean(axis=0)
    angles = np.radians(np.arange(90))
    best, chosen = math.inf, -math.pi / 2
    for angle in angles:
        along = flat @ np.array([math.cos(angle), math.sin(angle)])
        across = flat @ np.array([-math.sin(angle), math.cos(angle)])
        length, depth = np.ptp(along), np.ptp(across)
        if length * depth < best * (1 - 1e-6):
            best = length * depth
            chosen = angle - math.pi / 2 if length >= depth else angle
    # Of the two opposite normals, the one that looks to the front.
    return chosen - math.pi if math.sin(chosen) > 1e-9 else chosen
