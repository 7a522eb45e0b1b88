"""A surface seen along an axis: how far it is one of revolution, its profile and bore, rim and spokes."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from cadgraph.geometry.kernels.parallel import compiled, readable
from cadgraph.geometry.shape.round_faces import angles_about, count_corners
from cadgraph.geometry.shape.surface import Level, Surface
from cadgraph.model.scene import Floats

__all__ = ["N_SLICES", "AlongAxis", "find_profile", "find_wheel", "look_along"]

N_SLICES = 24  # of a profile: the plate of a flange (a third of its length or more) still gets several
_TURNED = 0.36  # greatest tangential share of a normal on a surface of revolution; 6 sides: sin(60 degrees) / 3 = 0.29
_THIN = 1e-9
_RIM = 0.72  # of the radius, from which on area is near the rim
_ARMS = (0.36, 0.68)  # of the radius, between hub and rim
_BETWEEN_ARMS = np.radians(25.0)


class AlongAxis(NamedTuple):
    """A surface seen along an axis.

    Args:
        axis: ``(3,)`` unit.
        along: ``(n, 3)`` coordinates of the corners of the faces along the axis [m].
        across: ``(n, 3, 3)`` where these lie from the axis [m].
        radii: ``(n, 3)`` how far [m].
        radius: greatest of these [m].
        turned: share of the area that turns about the axis.
        sides: corners around, at the greatest radius.
    """

    axis: Floats
    along: Floats
    across: Floats
    radii: Floats
    radius: float
    turned: float
    sides: int


def look_along(surface: Surface, center: Floats, axis: Floats, level: Level) -> AlongAxis:
    """What turns about an axis.

    Args:
        surface: of a mesh.
        center: ``(3,)`` a point on the axis [m].
        axis: ``(3,)`` unit.
        level: how exact a round wall must be.
    """
    n = len(surface.triangles)
    along, across, radii = np.zeros((n, 3)), np.zeros((n, 3, 3)), np.zeros((n, 3))
    if not n:
        return AlongAxis(axis, along, across, radii, 0.0, 0.0, 0)
    middle, way = readable(center, np.float64), readable(axis, np.float64)
    radius = _project(surface.triangles, middle, way, along, across, radii)
    turned = _turned_share(surface.middles, surface.normals, surface.areas, middle, way)
    rim = (radii >= level.rim * radius) & surface.corners
    sides = count_corners(angles_about(axis, across[rim]), level.gap)[0] if rim.any() else 0
    return AlongAxis(axis, along, across, radii, radius, turned, sides)


def find_profile(surface: Surface, seen: AlongAxis, low: float, high: float) -> tuple[Floats, Floats, float]:
    """Greatest and least radius where the edges of the faces cross slices across an axis, and the bore.

    Args:
        surface: of a mesh.
        seen: along the axis.
        low: least coordinate along the axis [m].
        high: greatest coordinate [m].

    Returns:
        The greatest radii and the least ones, ``(N_SLICES,)`` each [m]; and the radius of the opening along the whole
        axis [m]: 0 where in any slice the wall nearest to the axis faces away from it.
    """
    outer, inner = np.zeros(N_SLICES), np.full(N_SLICES, np.inf)
    bore = _find_profile(seen.along, seen.across, seen.radii, surface.normals, low, high, outer, inner)
    return outer, inner, bore


def find_wheel(surface: Surface, seen: AlongAxis) -> tuple[float, int]:
    """Share of the area near the rim, and number of arms between rim and hub.

    Args:
        surface: of a mesh.
        seen: along its axis.
    """
    if seen.radius < _THIN:
        return 0.0, 0
    middles, share = np.empty((len(seen.across), 3)), np.empty(len(seen.across))
    rim = _rim_share(seen.across, surface.areas, seen.radius, middles, share)
    between = (share > _ARMS[0]) & (share < _ARMS[1])
    if not between.any():
        return rim, 0
    angles = angles_about(seen.axis, middles[between])
    gaps = np.diff(np.append(angles, angles[0] + 2 * np.pi)) > _BETWEEN_ARMS
    return rim, int(gaps.sum())


@compiled
def _project(triangles: Any, center: Any, axis: Any, along: Any, across: Any, radii: Any) -> float:
    """Writes how far along an axis each corner lies, and which way and how far from it; returns the greatest radius."""
    radius = 0.0
    for f in range(len(triangles)):
        for k in range(3):
            height, square = 0.0, 0.0
            for i in range(3):
                height += (triangles[f, k, i] - center[i]) * axis[i]
            for i in range(3):
                across[f, k, i] = triangles[f, k, i] - center[i] - height * axis[i]
                square += across[f, k, i] ** 2
            along[f, k], radii[f, k] = height, np.sqrt(square)
            radius = max(radius, radii[f, k])
    return radius


@compiled
def _turned_share(middles: Any, normals: Any, areas: Any, center: Any, axis: Any) -> float:
    """Share of the area whose normals don't point around the axis."""
    whole, turned = 0.0, 0.0
    for f in range(len(areas)):
        x, y, z = middles[f, 0] - center[0], middles[f, 1] - center[1], middles[f, 2] - center[2]
        height = x * axis[0] + y * axis[1] + z * axis[2]
        x, y, z = x - height * axis[0], y - height * axis[1], z - height * axis[2]
        around = normals[f, 0] * (axis[1] * z - axis[2] * y) + normals[f, 1] * (axis[2] * x - axis[0] * z)
        around += normals[f, 2] * (axis[0] * y - axis[1] * x)
        whole += areas[f]
        if abs(around) < _TURNED * max(np.sqrt(x * x + y * y + z * z), _THIN):
            turned += areas[f]
    return turned / max(whole, _THIN**2)


@compiled
def _find_profile(
    along: Any, across: Any, radii: Any, normals: Any, low: float, high: float, outer: Any, inner: Any
) -> float:
    """Fills the radii of slices, 0 and infinite before; returns the bore. A slice that nothing crosses has radius 0."""
    n = len(outer)
    step = (high - low) / n
    outwards = np.zeros(n, np.uint8)
    for f in range(len(along)):
        # Away from the axis or towards it: the outside of a rod, or the wall of a hole.
        away = 0.0
        for i in range(3):
            away += normals[f, i] * (across[f, 0, i] + across[f, 1, i] + across[f, 2, i])
        for k in range(3):
            z0, z1 = along[f, k], along[f, (k + 1) % 3]
            r0, r1 = radii[f, k], radii[f, (k + 1) % 3]
            if not step > 0 or z0 == z1:
                continue
            first = max(0, int((min(z0, z1) - low) / step - 0.5))
            last = min(n - 1, int((max(z0, z1) - low) / step + 0.5))
            for s in range(first, last + 1):
                level = low + (s + 0.5) * (high - low) / n
                if (z0 - level) * (z1 - level) < 0:
                    radius = r0 + (level - z0) / (z1 - z0) * (r1 - r0)
                    outer[s] = max(outer[s], radius)
                    if radius < inner[s]:
                        inner[s], outwards[s] = radius, away >= 0
    bore = np.inf
    for s in range(n):
        bore = min(bore, 0.0 if outwards[s] or inner[s] == np.inf else inner[s])
        inner[s] = 0.0 if inner[s] == np.inf else inner[s]
    return bore


@compiled
def _rim_share(across: Any, areas: Any, radius: float, middles: Any, share: Any) -> float:
    """Share of the area near the rim; writes where the middle of each face lies from the axis, and its share of it."""
    whole, rim = 0.0, 0.0
    for f in range(len(areas)):
        square = 0.0
        for i in range(3):
            middles[f, i] = (across[f, 0, i] + across[f, 1, i] + across[f, 2, i]) / 3
            square += middles[f, i] ** 2
        share[f] = np.sqrt(square) / radius
        whole += areas[f]
        if share[f] > _RIM:
            rim += areas[f]
    return rim / max(whole, _THIN**2)
