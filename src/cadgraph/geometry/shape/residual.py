"""How far a surface lies from a simple solid: root mean square over its area, from the corners of its faces.

Corners lie on the true surface however coarse the tessellation; middles of faces do not. A face counts with the one
surface of the solid that it fits best, so that caps, walls and bores may all be there or not.
"""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.model.scene import Floats

__all__ = ["box_residual", "extrusion_residual", "fit_sphere", "fit_torus", "turned_residual"]

# A face may count with a surface only if its normal is within 45 degrees of that surface's (cosine).
_LOOKS_LIKE = 0.7
# Mean share by which normals may miss those of a sphere or torus: eight sides around miss by 0.04.
_MAX_MISS = 0.1


@compiled
def box_residual(
    corners: Floats, normals: Floats, areas: Floats, center: Floats, axes: Floats, extents: Floats
) -> float:
    """From the six sides of a box [m]."""
    total = squares = 0.0
    offset, sums = np.empty(3), np.empty(6)
    for f in range(len(areas)):
        for r in range(3):
            along = normals[f, 0] * axes[r, 0] + normals[f, 1] * axes[r, 1] + normals[f, 2] * axes[r, 2]
            sums[2 * r] = sums[2 * r + 1] = 0.0 if abs(along) > _LOOKS_LIKE else 3.0 * extents[0] ** 2
        for v in range(0, 9, 3):
            for r in range(3):
                offset[r] = 0.0
                for c in range(3):
                    offset[r] += (corners[f, v + c] - center[c]) * axes[r, c]
            for r in range(3):
                sums[2 * r] += (offset[r] - 0.5 * extents[r]) ** 2
                sums[2 * r + 1] += (offset[r] + 0.5 * extents[r]) ** 2
        total += areas[f]
        squares += areas[f] * sums.min() / 3.0
    return float(np.sqrt(squares / total))


@compiled
def turned_residual(
    corners: Floats, normals: Floats, areas: Floats, axis: Floats, low: float, high: float,
    outer: tuple[float, float], inner: tuple[float, float],
) -> float:  # fmt: skip
    """From the walls and ends of a cylinder or cone about an axis through the origin [m].

    Args:
        corners: ``(m, 9)`` [m].
        normals: ``(m, 3)``.
        areas: ``(m,)`` [m2].
        axis: ``(3,)``.
        low: height of the lower end [m].
        high: height of the upper end [m].
        outer: radius of the outer wall at the lower and the upper end [m].
        inner: of the inner wall, negative if there is none.
    """
    total = squares = 0.0
    sums = np.empty(4)
    height = high - low
    rise, inner_rise = outer[1] - outer[0], inner[1] - inner[0]
    lean = np.sqrt(1.0 + (rise / height) ** 2) if height > 0.0 else 1.0
    # Of the normals along the axis: those of walls, and of ends.
    wall_along = abs(rise / height) / lean if height > 0.0 else 0.0
    never = 3.0 * (max(outer) ** 2 + height**2)
    for f in range(len(areas)):
        along = abs(normals[f, 0] * axis[0] + normals[f, 1] * axis[1] + normals[f, 2] * axis[2])
        is_wall = np.sqrt(max(1.0 - along * along, 0.0)) / lean + along * wall_along > _LOOKS_LIKE
        sums[0] = 0.0 if is_wall else never
        sums[1] = sums[2] = 0.0 if along > _LOOKS_LIKE else never
        sums[3] = 0.0 if is_wall and inner[0] >= 0.0 else never
        for v in range(0, 9, 3):
            x, y, z = corners[f, v], corners[f, v + 1], corners[f, v + 2]
            h = x * axis[0] + y * axis[1] + z * axis[2]
            radius = np.sqrt(max(x * x + y * y + z * z - h * h, 0.0))
            share = (h - low) / height if height > 0.0 else 0.0
            sums[0] += ((radius - outer[0] - share * rise) / lean) ** 2
            sums[1] += (h - low) ** 2
            sums[2] += (h - high) ** 2
            sums[3] += ((radius - inner[0] - share * inner_rise) / lean) ** 2
        total += areas[f]
        squares += areas[f] * min(sums[0], sums[1], sums[2], sums[3]) / 3.0
    return float(np.sqrt(squares / total))


@compiled
def fit_sphere(corners: Floats, normals: Floats, areas: Floats, sphere: Floats) -> float:
    """Fits a sphere, writes its centre and radius, and returns how far the surface lies from it [m]."""
    matrix, right = np.zeros((4, 4)), np.zeros(4)
    row = np.empty(4)
    for f in range(len(areas)):
        for v in range(0, 9, 3):
            row[0], row[1], row[2], row[3] = corners[f, v], corners[f, v + 1], corners[f, v + 2], 1.0
            square = row[0] ** 2 + row[1] ** 2 + row[2] ** 2
            for i in range(4):
                right[i] += areas[f] * row[i] * square
                for j in range(4):
                    matrix[i, j] += areas[f] * row[i] * row[j]
    if not _solve(matrix, right):
        return np.inf
    for c in range(3):
        sphere[c] = 0.5 * right[c]
    radius2 = right[3] + sphere[0] ** 2 + sphere[1] ** 2 + sphere[2] ** 2
    sphere[3] = np.sqrt(max(radius2, 0.0))
    total = squares = missed = 0.0
    for f in range(len(areas)):
        x = y = z = 0.0
        for v in range(0, 9, 3):
            dx, dy, dz = corners[f, v] - sphere[0], corners[f, v + 1] - sphere[1], corners[f, v + 2] - sphere[2]
            squares += areas[f] * (np.sqrt(dx * dx + dy * dy + dz * dz) - sphere[3]) ** 2 / 3.0
            x, y, z = x + dx, y + dy, z + dz
        length = np.sqrt(x * x + y * y + z * z)
        radial = abs(x * normals[f, 0] + y * normals[f, 1] + z * normals[f, 2])
        missed += areas[f] * (1.0 - (radial / length if length > 0.0 else 0.0))
        total += areas[f]
    # The rims of any cylinder lie on a sphere; its walls look another way.
    return float(np.sqrt(squares / total)) if missed <= _MAX_MISS * total else np.inf


@compiled
def fit_torus(corners: Floats, normals: Floats, areas: Floats, axis: Floats, torus: Floats) -> float:
    """Fits a torus about an axis through the origin.

    Writes height, major and minor radius, and returns how far the surface lies from it [m]: a circle through the
    corners in the plane of radius and height.
    """
    matrix, right = np.zeros((4, 4)), np.zeros(4)
    row = np.empty(4)
    row[3] = 0.0
    for f in range(len(areas)):
        for v in range(0, 9, 3):
            x, y, z = corners[f, v], corners[f, v + 1], corners[f, v + 2]
            h = x * axis[0] + y * axis[1] + z * axis[2]
            square = x * x + y * y + z * z
            row[0], row[1], row[2] = np.sqrt(max(square - h * h, 0.0)), h, 1.0
            for i in range(3):
                right[i] += areas[f] * row[i] * square
                for j in range(3):
                    matrix[i, j] += areas[f] * row[i] * row[j]
    matrix[3, 3] = 1.0
    if not _solve(matrix, right):
        return np.inf
    major, height = 0.5 * right[0], 0.5 * right[1]
    minor = np.sqrt(max(right[2] + major**2 + height**2, 0.0))
    torus[0], torus[1], torus[2] = height, major, minor
    total = squares = missed = 0.0
    for f in range(len(areas)):
        mean_radius = mean_height = 0.0
        for v in range(0, 9, 3):
            x, y, z = corners[f, v], corners[f, v + 1], corners[f, v + 2]
            h = x * axis[0] + y * axis[1] + z * axis[2]
            radius = np.sqrt(max(x * x + y * y + z * z - h * h, 0.0))
            squares += areas[f] * (np.hypot(radius - major, h - height) - minor) ** 2 / 3.0
            mean_radius += (radius - major) / 3.0
            mean_height += (h - height) / 3.0
        along = normals[f, 0] * axis[0] + normals[f, 1] * axis[1] + normals[f, 2] * axis[2]
        across = np.sqrt(max(1.0 - along * along, 0.0))
        length = np.hypot(mean_radius, mean_height)
        agrees = abs(mean_radius) * across + abs(mean_height * along)
        missed += areas[f] * (1.0 - (agrees / length if length > 0.0 else 0.0))
        total += areas[f]
    # A spindle is a sphere or nothing; the corners of any rectangle lie on a circle.
    good = major > minor and missed <= _MAX_MISS * total
    return float(np.sqrt(squares / total)) if good else np.inf


@compiled
def _solve(matrix: Floats, right: Floats) -> bool:
    """Gaussian elimination with pivoting, in place; False where the matrix is singular."""
    n = len(right)
    scale = np.abs(matrix).max()
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(matrix[i, k]) > abs(matrix[pivot, k]):
                pivot = i
        if not abs(matrix[pivot, k]) > 1e-13 * scale:
            return False
        for j in range(n):
            matrix[k, j], matrix[pivot, j] = matrix[pivot, j], matrix[k, j]
        right[k], right[pivot] = right[pivot], right[k]
        for i in range(k + 1, n):
            factor = matrix[i, k] / matrix[k, k]
            for j in range(k, n):
                matrix[i, j] -= factor * matrix[k, j]
            right[i] -= factor * right[k]
    for k in range(n - 1, -1, -1):
        for j in range(k + 1, n):
            right[k] -= matrix[k, j] * right[j]
        right[k] /= matrix[k, k]
    return True


@compiled
def extrusion_residual(corners: Floats, normals: Floats, areas: Floats, axis: Floats, low: float, high: float) -> float:
    """How far a surface is from one constant section along an axis through the origin [m].

    Walls must run along the axis from end to end, so that a face counts with the height over which it leans, and a
    face across the axis with its distance from the nearer end. A wall's corners lie at the ends; those that do not
    count with their distance too, unless the face belongs to a wall that was merely cut into pieces.
    """
    total = squares = 0.0
    for f in range(len(areas)):
        along = abs(normals[f, 0] * axis[0] + normals[f, 1] * axis[1] + normals[f, 2] * axis[2])
        total += areas[f]
        least, most = np.inf, -np.inf
        for v in range(0, 9, 3):
            h = corners[f, v] * axis[0] + corners[f, v + 1] * axis[1] + corners[f, v + 2] * axis[2]
            least, most = min(least, h), max(most, h)
        if along > 0.7:
            middle = 0.5 * (least + most)
            off = min(abs(middle - low), abs(middle - high))
            squares += areas[f] * (off**2 + (most - least) ** 2)
        else:
            # How far such a face would drift sideways over the whole length.
            squares += areas[f] * (along * (high - low)) ** 2
    return float(np.sqrt(squares / total))
