"""A surface seen along an axis: how far it is one of revolution, its profile and bore, rim and spokes."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.shape.round_faces import angles_about, count_corners
from cadgraph.geometry.shape.surface import Level, Surface
from cadgraph.model.scene import Floats

__all__ = ["N_SLICES", "find_profile", "find_wheel", "look_along"]

N_SLICES = 24  # of a profile: the plate of a flange (a third of its length or more) still gets several
_TURNED = 0.36  # greatest tangential share of a normal on a surface of revolution; 6 sides: sin(60 degrees) / 3 = 0.29
_THIN = 1e-9
_PLANE = 0.9998  # of a flat face the mean normal is as long; of one that bends by 2 degrees it is shorter


def look_along(surface: Surface, center: Floats, axis: Floats, level: Level) -> tuple[float, int, float, Floats]:
    """What turns about an axis.

    Args:
        surface: of a mesh.
        center: ``(3,)`` a point on the axis [m].
        axis: ``(3,)`` unit.
        level: how exact a round wall must be.

    Returns:
        The share of the area that turns, the corners around, the greatest radius [m], and the coordinates of all
        corners along the axis ``(n, 3)`` [m].
    """
    if not len(surface.triangles):
        return 0.0, 0, 0.0, np.zeros(0)
    apart = surface.triangles - center
    along = apart @ axis
    across = apart - along[..., None] * axis
    radii = np.linalg.norm(across, axis=2)
    spoke = _middles(surface) - center
    spoke = spoke - (spoke @ axis)[:, None] * axis
    around = np.cross(axis, spoke / np.maximum(np.linalg.norm(spoke, axis=1), _THIN)[:, None])
    turned = np.abs(np.einsum("ij,ij->i", surface.normals, around)) < _TURNED
    radius = float(radii.max())
    rim = (radii >= level.rim * radius) & surface.corners
    sides = count_corners(across[rim], axis, level.gap)[0] if rim.any() else 0
    return float(surface.areas[turned].sum() / max(surface.areas.sum(), _THIN**2)), sides, radius, along


def _middles(surface: Surface) -> Floats:
    """The middle of the flat face that each triangle is of ``(n, 3)`` [m]: the same however that is cut up."""
    patch = np.unique(surface.patches[0], return_inverse=True)[1].reshape(-1)
    n = int(patch.max()) + 1
    own = surface.triangles.mean(axis=1)
    area = np.bincount(patch, weights=surface.areas, minlength=n)
    whole = np.maximum(area, _THIN**2)[:, None]
    middle = np.stack([np.bincount(patch, weights=surface.areas * own[:, d], minlength=n) for d in range(3)], axis=1)
    normal = np.stack(
        [np.bincount(patch, weights=surface.areas * surface.normals[:, d], minlength=n) for d in range(3)], axis=1
    )
    # Faces that turn little by little are joined, too: their triangles speak for themselves.
    flat = np.linalg.norm(normal / whole, axis=1) > _PLANE
    return np.where(flat[patch][:, None], (middle / whole)[patch], own)


def find_profile(
    surface: Surface, center: Floats, axis: Floats, low: float, high: float
) -> tuple[Floats, Floats, float]:
    """Greatest and least radius where the edges of the faces cross slices across an axis, and the bore.

    Args:
        surface: of a mesh.
        center: ``(3,)`` a point on the axis [m].
        axis: ``(3,)`` unit.
        low: least coordinate along the axis from ``center`` [m].
        high: greatest coordinate [m].

    Returns:
        The greatest radii and the least ones, ``(N_SLICES,)`` each [m]; and the radius of the opening along the whole
        axis [m]: 0 where in any slice the wall nearest to the axis faces away from it.
    """
    level = low + (np.arange(N_SLICES) + 0.5) * (high - low) / N_SLICES
    outer, inner = np.zeros(N_SLICES), np.zeros(N_SLICES)
    apart = surface.triangles - center
    z = apart @ axis
    across = apart - z[..., None] * axis
    radii = np.linalg.norm(across, axis=2)
    # Away from the axis or towards it: the outside of a rod, or the wall of a hole.
    faces_away = np.einsum("ij,ij->i", surface.normals, across.mean(axis=1)) >= 0
    z0, z1 = z.reshape(-1), np.roll(z, -1, axis=1).reshape(-1)
    r0, r1 = radii.reshape(-1), np.roll(radii, -1, axis=1).reshape(-1)
    bored = len(radii) > 0
    for k in range(N_SLICES):
        hit = (z0 - level[k]) * (z1 - level[k]) < 0
        if hit.any():
            share = (level[k] - z0[hit]) / (z1[hit] - z0[hit])
            r = r0[hit] + share * (r1[hit] - r0[hit])
            outer[k], inner[k] = r.max(), r.min()
            bored = bored and not faces_away[np.flatnonzero(hit)[np.argmin(r)] // 3]
        else:
            bored = False
    return outer, inner, float(inner.min()) if bored else 0.0


def find_wheel(surface: Surface, center: Floats, axis: Floats, radius: float) -> tuple[float, int]:
    """Share of the area near the rim, and number of arms between rim and hub.

    Args:
        surface: of a mesh.
        center: ``(3,)`` a point on the axis [m].
        axis: ``(3,)`` unit.
        radius: greatest distance of the surface from the axis [m].
    """
    if radius < _THIN:
        return 0.0, 0
    middle = surface.triangles.mean(axis=1)
    apart = middle - center
    across = apart - (apart @ axis)[:, None] * axis
    share = np.linalg.norm(across, axis=1) / radius
    rim = float(surface.areas[share > 0.72].sum() / max(surface.areas.sum(), _THIN**2))
    between = (share > 0.36) & (share < 0.68)
    if not between.any():
        return rim, 0
    angles = angles_about(axis, across[between])
    gaps = np.diff(np.append(angles, angles[0] + 2 * np.pi)) > np.radians(25.0)
    return rim, int(gaps.sum())
