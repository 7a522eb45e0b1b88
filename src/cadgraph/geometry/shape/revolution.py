"""Parts seen along their axis: which axis that is, what repeats around it, and the profile along it."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.geometry.line.section import cut, plane_axes
from cadgraph.model.parts import Bools
from cadgraph.model.scene import Floats, Ints

__all__ = ["MAX_ORDER", "N_SLICES", "classify_faces", "count_sides", "profile", "skew", "symmetry"]

N_SLICES = 32
MAX_ORDER = 16
# About so many sample points on a surface, in so many cells of radius and height.
_N_SAMPLES = 4096
_N_RADII, _N_HEIGHTS = 8, 4
# Cells with less than this share of the area say nothing about symmetry.
_LEAST_CELL = 0.02
# A harmonic of the angular distribution of a cell above this share is real. Ours, from flanges, handwheels and
# irregular meshes: eight bolt holes give 0.25 and more, irregular triangles of a full disc below 0.08.
_HARMONIC = 0.15
# Normals of walls whose azimuths are this close [rad] belong to one side of a polygon.
_SAME_SIDE = 0.02
# Slanted faces are those of a cone where this share of them has one slope: bands of a sphere have less each.
_ONE_SLOPE = 0.3
# Normals of a coarse sphere meet its middle within this share of its radius.
_LOOSE = 0.1


@compiled
def skew(middles: Floats, normals: Floats, areas: Floats, axis: Floats) -> float:
    """How far normals miss an axis through the origin: mean share that points around it, 0 for a turned part."""
    total = missed = 0.0
    for f in range(len(areas)):
        p, n = middles[f], normals[f]
        x, y, z = axis[1] * p[2] - axis[2] * p[1], axis[2] * p[0] - axis[0] * p[2], axis[0] * p[1] - axis[1] * p[0]
        length = np.sqrt(x * x + y * y + z * z)
        total += areas[f]
        if length > 0.0:
            missed += areas[f] * abs(x * n[0] + y * n[1] + z * n[2]) / length
    return missed / total if total > 0.0 else 1.0


@compiled
def symmetry(corners: Floats, areas: Floats, axis: Floats, low: float, high: float, reach: float) -> int:
    """Order of the rotational symmetry about an axis through the origin.

    The surface is sampled evenly; in each cell of radius and height the angles of the samples are analysed. What is
    not a multiple of the order has no harmonics.

    Returns:
        0 where nothing tells one direction from another, 1 without symmetry, else 2..MAX_ORDER.
    """
    u, w = np.empty(3), np.empty(3)
    plane_axes(axis, u, w)
    cells = np.zeros((_N_RADII * _N_HEIGHTS, MAX_ORDER + 1, 2))
    weights = np.zeros(_N_RADII * _N_HEIGHTS)
    total = areas.sum()
    for f in range(len(areas)):
        t = corners[f]
        splits = min(64, max(1, int(np.ceil(np.sqrt(areas[f] * _N_SAMPLES / total)))))
        weight = areas[f] / (splits * splits)
        for i in range(splits):
            for j in range(2 * (splits - i) - 1):
                # The middles of the small triangles of an even subdivision, upright and hanging ones in turn.
                s = (i + (1.0 if j % 2 == 0 else 2.0) / 3.0) / splits
                v = (j // 2 + (1.0 if j % 2 == 0 else 2.0) / 3.0) / splits
                x = y = z = 0.0
                for c in range(3):
                    p = t[c] + s * (t[3 + c] - t[c]) + v * (t[6 + c] - t[c])
                    x += p * u[c]
                    y += p * w[c]
                    z += p * axis[c]
                radius = np.hypot(x, y)
                if not radius > 1e-6 * reach:
                    continue
                # The rim's polygon must not fall into two cells.
                a = min(_N_RADII - 1, int(_N_RADII * radius / (1.02 * reach)))
                b = 0
                if high - low > 1e-6 * reach:
                    b = min(_N_HEIGHTS - 1, max(0, int(_N_HEIGHTS * (z - low) / (high - low))))
                cell = a * _N_HEIGHTS + b
                weights[cell] += weight
                cx, cy = x / radius, y / radius
                px, py = 1.0, 0.0
                for k in range(1, MAX_ORDER + 1):
                    px, py = px * cx - py * cy, px * cy + py * cx
                    cells[cell, k, 0] += weight * px
                    cells[cell, k, 1] += weight * py
    order = 0
    for k in range(1, MAX_ORDER + 1):
        strongest = 0.0
        for cell in range(len(weights)):
            if weights[cell] > _LEAST_CELL * total:
                strongest = max(strongest, np.hypot(cells[cell, k, 0], cells[cell, k, 1]) / weights[cell])
        if strongest > _HARMONIC:
            a, b = k, order
            while b:
                a, b = b, a % b
            order = a
    return order


@compiled
def profile(
    corners: Floats, normals: Floats, axis: Floats, low: float, high: float, segments: Floats, owners: Ints,
    outer: Floats, inner: Floats,
) -> None:  # fmt: skip
    """Outer radius and bore at evenly spaced heights along an axis through the origin.

    Args:
        corners: ``(m, 9)`` [m].
        normals: ``(m, 3)`` outward.
        axis: ``(3,)``.
        low: least height [m].
        high: greatest height [m].
        segments: ``(m, 4)`` working space.
        owners: ``(m,)`` working space.
        outer: ``(N_SLICES,)`` output: farthest point from the axis [m], 0 where there is nothing.
        inner: ``(N_SLICES,)`` output: distance of the axis from the nearest wall if that looks towards the axis, the
            bore [m]; 0 where the axis is inside the material or there is nothing.
    """
    u, w, center = np.empty(3), np.empty(3), np.empty(3)
    plane_axes(axis, u, w)
    for k in range(N_SLICES):
        z = low + (high - low) * (k + 0.5) / N_SLICES
        for c in range(3):
            center[c] = z * axis[c]
        n = cut(corners, center, axis, u, w, np.inf, segments, owners)
        outer[k] = inner[k] = 0.0
        nearest = np.inf
        for s in range(n):
            x0, y0, x1, y1 = segments[s]
            outer[k] = max(outer[k], np.hypot(x0, y0), np.hypot(x1, y1))
            dx, dy = x1 - x0, y1 - y0
            length2 = dx * dx + dy * dy
            t = min(1.0, max(0.0, -(x0 * dx + y0 * dy) / length2)) if length2 > 0.0 else 0.0
            distance = np.hypot(x0 + t * dx, y0 + t * dy)
            if distance < nearest:
                nearest = distance
                normal = normals[owners[s]]
                facing = 0.0
                for c in range(3):
                    facing += normal[c] * ((x0 + x1) * u[c] + (y0 + y1) * w[c])
                inner[k] = max(np.hypot(x0, y0), np.hypot(x1, y1)) if facing < 0.0 else 0.0


@compiled
def count_sides(corners: Floats, normals: Floats, axis: Floats, radius: float, sense: float) -> int:
    """How many flat sides the wall at a radius has: distinct azimuths of its normals, outward or inward.

    A wall's vertices lie at the radius; those of any other face do not.
    """
    u, w = np.empty(3), np.empty(3)
    plane_axes(axis, u, w)
    azimuths = np.empty(len(corners))
    n = 0
    for f in range(len(corners)):
        t, normal = corners[f], normals[f]
        along = normal[0] * axis[0] + normal[1] * axis[1] + normal[2] * axis[2]
        if abs(along) > 0.5:
            continue
        on_wall = True
        sx = sy = 0.0
        for v in range(0, 9, 3):
            x = t[v] * u[0] + t[v + 1] * u[1] + t[v + 2] * u[2]
            y = t[v] * w[0] + t[v + 1] * w[1] + t[v + 2] * w[2]
            sx += x
            sy += y
            on_wall = on_wall and abs(np.hypot(x, y) - radius) <= 0.01 * radius
        a = normal[0] * u[0] + normal[1] * u[1] + normal[2] * u[2]
        b = normal[0] * w[0] + normal[1] * w[1] + normal[2] * w[2]
        if on_wall and sense * (a * sx + b * sy) > 0.0:
            azimuths[n] = np.arctan2(b, a)
            n += 1
    if n == 0:
        return 0
    ordered = np.sort(azimuths[:n])
    sides = 1 if ordered[0] + 2 * np.pi - ordered[n - 1] > _SAME_SIDE else 0
    for k in range(1, n):
        sides += ordered[k] - ordered[k - 1] > _SAME_SIDE
    return max(1, sides)


@compiled
def classify_faces(
    corners: Floats, normals: Floats, areas: Floats, axis: Floats, round_about: bool, shares: Floats
) -> None:
    """Share of the area by kind of surface about an axis: planar, cylindrical, conical, toroidal, spherical, other.

    Across the axis, a face is planar. Along it, it belongs to a cylinder if the part is round about the axis. Slanted
    faces are spherical where their normals meet the axis in one point at one distance, conical where many have one
    slope, else toroidal. Without roundness, a face is planar where many lie in one plane, else other.
    """
    n_faces = len(areas)
    total = areas.sum()
    shares[:] = 0.0
    slope, meets, reach = np.empty(n_faces), np.empty(n_faces), np.empty(n_faces)
    slanted = np.zeros(n_faces, np.bool_)
    slanted_area = 0.0
    for f in range(n_faces):
        n, t = normals[f], corners[f]
        along = n[0] * axis[0] + n[1] * axis[1] + n[2] * axis[2]
        if not round_about:
            continue
        if abs(along) > 0.995:
            shares[0] += areas[f]
        elif abs(along) < 0.03:
            shares[1] += areas[f]
        else:
            z = radius = 0.0
            for v in range(0, 9, 3):
                h = t[v] * axis[0] + t[v + 1] * axis[1] + t[v + 2] * axis[2]
                z += h / 3.0
                away = t[v] ** 2 + t[v + 1] ** 2 + t[v + 2] ** 2 - h * h
                radius += np.sqrt(max(away, 0.0)) / 3.0
            across = np.sqrt(1.0 - along * along)
            facing = 0.0
            for c in range(3):
                facing += (n[c] - along * axis[c]) * (t[c] + t[3 + c] + t[6 + c])
            tangent = along / across * (1.0 if facing >= 0.0 else -1.0)
            slope[f] = np.arctan(tangent)
            meets[f] = z - radius * tangent
            reach[f] = radius * np.sqrt(1.0 + tangent * tangent)
            slanted[f] = True
            slanted_area += areas[f]
    if not round_about:
        _share_planes(corners, normals, areas, shares)
    elif slanted_area > 0.0:
        _share_slanted(slope, meets, reach, slanted, areas, slanted_area, shares)
    for k in range(6):
        shares[k] /= total


@compiled
def _share_slanted(
    slope: Floats, meets: Floats, reach: Floats, slanted: Bools, areas: Floats, slanted_area: float, shares: Floats
) -> None:
    index = np.flatnonzero(slanted)
    order = index[np.argsort(meets[index])]
    half, at = 0.0, order[0]
    for f in order:
        half += areas[f]
        at = f
        if 2.0 * half >= slanted_area:
            break
    center, radius = meets[at], reach[at]
    spherical = 0.0
    for f in index:
        if abs(meets[f] - center) < _LOOSE * radius and abs(reach[f] - radius) < _LOOSE * radius:
            spherical += areas[f]
    is_sphere = spherical > 0.5 * slanted_area
    slopes = np.zeros(92)
    for f in index:
        slopes[int((slope[f] + 0.5 * np.pi) / np.pi * 90.0)] += areas[f]
    for f in index:
        if slopes[int((slope[f] + 0.5 * np.pi) / np.pi * 90.0)] > _ONE_SLOPE * slanted_area:
            shares[2] += areas[f]
        elif is_sphere and abs(meets[f] - center) < _LOOSE * radius and abs(reach[f] - radius) < _LOOSE * radius:
            shares[4] += areas[f]
        else:
            shares[3] += areas[f]


@compiled
def _share_planes(corners: Floats, normals: Floats, areas: Floats, shares: Floats) -> None:
    """Planar where the faces of one plane hold at least 2 % of the area: finer ones may be facets of a curve."""
    total = areas.sum()
    planes = np.zeros((64, 5))
    n_planes = 0
    for f in range(len(areas)):
        n, t = normals[f], corners[f]
        offset = n[0] * t[0] + n[1] * t[1] + n[2] * t[2]
        found = -1
        for k in range(n_planes):
            cosine = n[0] * planes[k, 0] + n[1] * planes[k, 1] + n[2] * planes[k, 2]
            if abs(cosine) > 0.9999 and abs(offset - np.sign(cosine) * planes[k, 3]) < 1e-3 * np.sqrt(total):
                found = k
                break
        if found < 0 and n_planes < len(planes):
            found = n_planes
            n_planes += 1
        elif found < 0:
            found = int(np.argmin(planes[:, 4]))
            if planes[found, 4] >= areas[f]:
                continue
            planes[found, 4] = 0.0
        if planes[found, 4] == 0.0:
            planes[found, 0], planes[found, 1], planes[found, 2], planes[found, 3] = n[0], n[1], n[2], offset
        planes[found, 4] += areas[f]
    for k in range(n_planes):
        if planes[k, 4] > 0.02 * total:
            shares[0] += planes[k, 4]
    shares[5] = total - shares[0]
