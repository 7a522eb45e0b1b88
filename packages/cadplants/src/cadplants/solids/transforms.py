"""Poses (4x4 matrices that map local to outer coordinates) and centrelines."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from cadgraph.model.scene import Floats

__all__ = ["IDENTITY", "arc", "at", "looking", "spun"]

IDENTITY: Floats = np.eye(4)


def at(x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Floats:
    """A shift [m]."""
    pose = np.eye(4)
    pose[:3, 3] = (x, y, z)
    return pose


def spun(axis: str, angle: float) -> Floats:
    """A turn about ``"x"``, ``"y"`` or ``"z"`` [rad]; quarter turns are exact."""
    cosine, sine = np.cos(angle), np.sin(angle)
    if abs(cosine) < 1e-15 or abs(sine) < 1e-15:
        cosine, sine = round(cosine), round(sine)
    first, second = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    pose = np.eye(4)
    pose[first, first] = pose[second, second] = cosine
    pose[first, second], pose[second, first] = -sine, sine
    return pose


def looking(origin: npt.ArrayLike, x: npt.ArrayLike, z: npt.ArrayLike = (0.0, 0.0, 1.0)) -> Floats:
    """A frame with its x axis along ``x`` and its z axis as near to ``z`` as that allows.

    Where ``x`` runs along ``z`` the z axis is taken towards -x of the world.
    """
    forward = np.asarray(x, float) / np.linalg.norm(x)
    upward = np.asarray(z, float)
    upward = upward - forward * (upward @ forward)
    if np.linalg.norm(upward) < 1e-9:
        upward = np.array([-1.0, 0.0, 0.0])
        upward = upward - forward * (upward @ forward)
    upward = upward / np.linalg.norm(upward)
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2], pose[:3, 3] = forward, np.cross(upward, forward), upward, origin
    return pose


def arc(start: npt.ArrayLike, corner: npt.ArrayLike, end: npt.ArrayLike, steps: int) -> Floats:
    """A round corner as a polyline that touches the arc from outside, so that its end legs run along the tangents.

    Args:
        start: where the arc leaves the first leg, ``(3,)``.
        corner: where the two legs would meet.
        end: where it joins the second leg, as far from the corner as ``start``.
        steps: pieces of the arc.

    Returns:
        ``(steps + 2, 3)`` points, from start to end.
    """
    p, c, q = (np.asarray(point, float) for point in (start, corner, end))
    first, second = p - c, q - c
    half = np.arccos(np.clip(first @ second / (first @ first), -1, 1)) / 2
    radius = np.linalg.norm(first) * np.tan(half)
    middle = first + second
    center = c + middle / np.linalg.norm(middle) * (radius / np.sin(half))
    turn = np.pi - 2 * half
    u = (p - center) / radius
    v = -first / np.linalg.norm(first)
    angles = (np.arange(steps) + 0.5) * turn / steps
    reach = radius / np.cos(turn / steps / 2)
    inner = center + reach * (np.outer(np.cos(angles), u) + np.outer(np.sin(angles), v))
    return np.vstack([p, inner, q])
