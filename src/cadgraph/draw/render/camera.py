"""Cameras, and how they are placed so that what matters fills the picture."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from cadgraph.model.scene import Floats

__all__ = ["Camera", "direction_from_angles", "frame"]

FIELD_OF_VIEW = math.radians(26.0)
"""Vertical opening of the cameras: about an 80 mm lens, which keeps parallel pipes nearly parallel."""

_LEAST_SIZE = 1e-6
_MOST_STEPS = 30


@dataclass(frozen=True)
class Camera:
    """Where a picture is taken from. Pixel (0, 0) is at the upper left, its centre at (0.5, 0.5).

    Args:
        eye: ``(3,)`` position [m], relative to the scene's origin.
        right: ``(3,)`` unit vector to the right in the picture.
        up: ``(3,)`` unit vector upwards in the picture.
        forward: ``(3,)`` unit vector into the picture.
        width: of the picture [px].
        height: of the picture [px].
        half_height: tangent of half the vertical field of view.
    """

    eye: Floats
    right: Floats
    up: Floats
    forward: Floats
    width: int
    height: int
    half_height: float

    @property
    def pixel_size(self) -> float:
        """Size of a pixel at a depth of 1 m [m]."""
        return 2 * self.half_height / self.height

    def rays(self, columns: npt.ArrayLike, rows: npt.ArrayLike) -> tuple[Floats, Floats]:
        """The rays through points of the picture.

        Args:
            columns: ``(n,)`` from the left [px].
            rows: ``(n,)`` from the top [px].

        Returns:
            Origins and unit directions, both ``(n, 3)``.
        """
        x = (np.asarray(columns, np.float64) - self.width / 2) * self.pixel_size
        y = (self.height / 2 - np.asarray(rows, np.float64)) * self.pixel_size
        sideways = x[:, None] * self.right + y[:, None] * self.up
        directions = sideways + self.forward
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
        return np.broadcast_to(self.eye, sideways.shape), directions

    def project(self, points: npt.ArrayLike) -> tuple[Floats, Floats]:
        """Where points appear in the picture.

        Args:
            points: ``(n, 3)`` [m], relative to the scene's origin.

        Returns:
            ``(n, 2)`` column and row [px], and ``(n,)`` depth along the viewing direction [m]; NaN for points that
            lie behind the camera.
        """
        relative = np.asarray(points, np.float64).reshape(-1, 3) - self.eye
        depth = relative @ self.forward
        scale = np.where(depth > 0, depth, np.nan) * self.pixel_size
        column = self.width / 2 + (relative @ self.right) / scale
        row = self.height / 2 - (relative @ self.up) / scale
        return np.stack([column, row], axis=1), depth


def direction_from_angles(azimuth: float, elevation: float) -> Floats:
    """The unit vector from what is looked at towards the camera.

    Args:
        azimuth: of the camera about Z [rad]; 0 is on the side of +X, -pi/2 in front (-Y).
        elevation: of the camera above the horizon [rad].
    """
    level = math.cos(elevation)
    return np.array([math.cos(azimuth) * level, math.sin(azimuth) * level, math.sin(elevation)])


def frame(
    points: npt.ArrayLike,
    direction: npt.ArrayLike,
    size: tuple[int, int],
    *,
    margin: float = 0.06,
    field_of_view: float = FIELD_OF_VIEW,
) -> Camera:
    """Places a camera so that points just fit into the picture: by their projections, not by a sphere round them.

    Args:
        points: ``(n, 3)`` what has to be seen [m], usually the vertices.
        direction: ``(3,)`` from the points towards the camera, any length.
        size: width and height of the picture [px].
        margin: what stays free at each side, as share of the picture.
        field_of_view: vertical opening [rad].

    Raises:
        ValueError: there are no points, a point is not finite, or the direction is null.
    """
    p = np.asarray(points, np.float64).reshape(-1, 3)
    if not len(p):
        raise ValueError("nothing to frame: there are no points; give at least one mesh with vertices")
    low, high = p.min(axis=0), p.max(axis=0)
    if not np.isfinite([low, high]).all():
        raise ValueError("can't frame points with coordinates that are not finite; leave such meshes out")
    right, up, forward = _axes(np.asarray(direction, np.float64))
    center = (low + high) / 2
    width, height = size
    x, y, z = ((p - center) @ axis for axis in (right, up, forward))
    least = max(float(np.linalg.norm(high - low)) * 1e-3, _LEAST_SIZE)
    use = 1 - 2 * margin
    tangent = math.tan(field_of_view / 2)
    across, along = tangent * width / height * use, tangent * use
    # Each side of the view is a plane that all points must be within; the eye is where these planes meet.
    to_right, to_left = (x - across * z).max(), (-x - across * z).max()
    to_top, to_bottom = (y - along * z).max(), (-y - along * z).max()
    back = min(-(to_right + to_left) / (2 * across), -(to_top + to_bottom) / (2 * along), z.min() - least)
    depth = z - back
    eye = center + right * _middle(x, depth) + up * _middle(y, depth) + forward * back
    return Camera(eye, right, up, forward, width, height, tangent)


def _middle(sideways: Floats, depth: Floats) -> float:
    """Where the eye has to be for points to reach as far to one side of the picture as to the other.

    The opening at which both sides just touch is the root of a convex, falling, piecewise linear function, which
    Newton's method reaches exactly from below.
    """
    opening, place = 0.0, 0.0
    for _ in range(_MOST_STEPS):
        first, second = int(np.argmax(sideways - opening * depth)), int(np.argmax(-sideways - opening * depth))
        place = float(sideways[first] - opening * depth[first])
        excess = place - float(sideways[second] + opening * depth[second])
        if excess <= 1e-9 * abs(place):
            break
        opening += excess / float(depth[first] + depth[second])
    return place


def _axes(direction: Floats) -> tuple[Floats, Floats, Floats]:
    length = float(np.linalg.norm(direction))
    if not length > 0:
        raise ValueError(f"{direction.tolist()} is not a direction to look from; give a vector that is not null")
    forward = -direction / length
    # Seen from straight above or below, the top of the picture is +Y.
    hint = np.array([0.0, 1.0, 0.0]) if abs(forward[2]) > 0.999 else np.array([0.0, 0.0, 1.0])
    right = np.cross(forward, hint)
    right /= np.linalg.norm(right)
    return right, np.cross(right, forward), forward
