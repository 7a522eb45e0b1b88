"""Round flat faces and the round rims of openings, and which of them are where something may join."""

from __future__ import annotations

from itertools import islice
from typing import Any

import numpy as np

from cadgraph.geometry.kernels.frame import Vector, across
from cadgraph.geometry.kernels.parallel import compiled, readable
from cadgraph.geometry.shape.surface import Level, Surface, equal_values
from cadgraph.model.parts import Bools
from cadgraph.model.scene import Floats, Ints
from cadgraph.model.shapes import PARALLEL, Disc

__all__ = ["angles_about", "count_corners", "find_discs", "find_ports", "same_line"]

_MIN_AREA = 1e-4  # smaller patches are no end faces (share of the part's area): those of a 12 m pipe DN50 have 2e-4
_LEAST_CORNERS = 5  # of a rim
_LEAST_RADIUS, _FLAT = 1e-3, 1e-5  # m
_DIGITS = 9  # of a radius in m, and an area in m2, that are no rounding
_SAME_CORNER = 0.01  # rad; corners of several faces, and of both ends
_MAX_PATCHES = 64  # only so many patches of a part are looked at, those of most faces first: round ones have many


def find_discs(surface: Surface, patches: Ints, middle: Floats, level: Level) -> list[Disc]:
    """The round flat faces and round rims of a mesh, widest first.

    Args:
        surface: of the mesh.
        patches: ``(n,)`` the flat patch of each face at this level.
        middle: ``(3,)`` of the mesh; rims face away from it [m].
        level: how exact they must be.
    """
    least = _MIN_AREA * float(surface.areas.sum())
    found: list[Disc | None] = []
    for faces in sorted(equal_values(patches, 3), key=len, reverse=True):
        center, normal = np.empty(3), np.empty(3)
        area = _flat_face(surface.triangles, surface.normals, surface.areas, faces, center, normal)
        if area >= least:
            found.append(_disc(surface.triangles, surface.corners, faces, center, normal, area, level))
            if len(found) == _MAX_PATCHES:
                break
    for lines, meant in islice(zip(surface.rims, surface.rim_corners, strict=True), _MAX_PATCHES):
        size = np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1)
        center = (size[:, None] * lines.mean(axis=1)).sum(axis=0) / size.sum()
        normal = np.linalg.svd(lines.reshape(-1, 3) - center, full_matrices=False)[2][2]
        normal = normal * (1.0 if normal @ (center - middle) >= 0 else -1.0)
        found.append(_disc(lines, meant, np.arange(len(lines)), center, normal, 0.0, level))
    # Of discs as wide as each other the one of more faces stays first: rounding must not choose.
    return sorted((disc for disc in found if disc is not None), key=lambda disc: -round(disc.outer, _DIGITS))


def _disc(
    lines: Floats, meant: Bools, rows: Ints, center: Floats, normal: Floats, area: float, level: Level
) -> Disc | None:
    """A disc if the outermost of the points that are corners of the shape lie evenly on a circle about the centre."""
    angles = np.empty(len(rows) * lines.shape[1])
    outer, least, count = _find_rim(lines, meant, rows, center, normal, level.rim, level.bulge, angles)
    if count < _LEAST_CORNERS:
        return None
    sides, full = count_corners(np.sort(angles[:count]), level.gap)
    if not sides:
        return None
    solid = area >= 0.97 * full * outer**2
    return Disc(center, normal, outer, 0.0 if solid else least if area else outer, sides, area)


def angles_about(axis: Floats, points: Floats) -> Floats:
    """The angles of points ``(n, 3)`` around an axis through the origin, ascending [rad]."""
    angles = np.empty(len(points))
    _angles(readable(points, np.float64), readable(axis, np.float64), angles)
    return np.sort(angles)


@compiled
def count_corners(angles: Any, gap: float) -> tuple[int, float]:
    """How many corners go around an axis, and the area of that polygon at radius 1.

    Args:
        angles: ``(n,)`` of points, ascending [rad].
        gap: greatest angle between neighbouring corners [rad]; where one is wider, both results are 0.
    """
    count, area = 0, 0.0
    for i in range(len(angles)):
        step = (angles[i + 1] if i + 1 < len(angles) else angles[0] + 2 * np.pi) - angles[i]
        if step > gap:
            return 0, 0.0
        if step > _SAME_CORNER:
            count += 1
            area += np.sin(step) / 2
    return count, area


@compiled
def _flat_face(triangles: Any, normals: Any, areas: Any, faces: Any, center: Any, normal: Any) -> float:
    """Centre and mean normal of the triangles of a flat face, either way round; returns its area."""
    largest = faces[0]
    for f in faces:
        if areas[f] > areas[largest]:
            largest = f
    area = 0.0
    for i in range(3):
        center[i] = normal[i] = 0.0
    for f in faces:
        along = 0.0
        for i in range(3):
            along += normals[f, i] * normals[largest, i]
        sense = areas[f] if along > 0 else -areas[f] if along < 0 else 0.0
        area += areas[f]
        for i in range(3):
            center[i] += areas[f] * (triangles[f, 0, i] + triangles[f, 1, i] + triangles[f, 2, i]) / 3
            normal[i] += sense * normals[f, i]
    length = np.sqrt(normal[0] ** 2 + normal[1] ** 2 + normal[2] ** 2)
    for i in range(3):
        center[i] /= area
        normal[i] /= length
    return area


@compiled
def _find_rim(
    lines: Any, meant: Any, rows: Any, center: Any, normal: Any, rim: float, bulge: float, angles: Any
) -> tuple[float, float, int]:
    """The corners farthest from the middle of a flat face.

    Args:
        lines: ``(n, k, 3)`` points of triangles or edges [m].
        meant: ``(n, k)`` whether each is a corner of the shape.
        rows: ``(m,)`` those that count.
        center: ``(3,)`` of the face [m].
        normal: ``(3,)`` of the face, unit.
        rim: corners at this share of the greatest distance are counted.
        bulge: no corner may leave the plane by more than this share of the greatest distance.
        angles: ``(m * k,)`` filled with those of the corners that are counted, as many as there are [rad].

    Returns:
        Greatest and least distance of the corners [m], and how many are counted: none where they lie in no plane.
    """
    outer, least, high, count = 0.0, np.inf, 0.0, 0
    for f in rows:
        for k in range(lines.shape[1]):
            if meant[f, k]:
                _, height, radius = _from_axis(lines, f, k, center, normal)
                outer, least, high = max(outer, radius), min(least, radius), max(high, abs(height))
                count += 1
    if count < _LEAST_CORNERS or outer < _LEAST_RADIUS or high > bulge * outer + _FLAT:
        return outer, least, 0
    u, w = across(normal[0], normal[1], normal[2])
    count = 0
    for f in rows:
        for k in range(lines.shape[1]):
            if meant[f, k]:
                apart, _, radius = _from_axis(lines, f, k, center, normal)
                if radius >= rim * outer:
                    angles[count] = _angle(apart, u, w)
                    count += 1
    return outer, least, count


@compiled
def _from_axis(lines: Any, f: int, k: int, center: Any, axis: Any) -> tuple[Vector, float, float]:
    """Where a point lies from one on an axis, how far along the axis, and how far from it [m]."""
    a, b, c = lines[f, k, 0] - center[0], lines[f, k, 1] - center[1], lines[f, k, 2] - center[2]
    height = a * axis[0] + b * axis[1] + c * axis[2]
    p, q, r = a - height * axis[0], b - height * axis[1], c - height * axis[2]
    return (a, b, c), height, np.sqrt(p * p + q * q + r * r)


@compiled
def _angle(point: Vector, u: Vector, w: Vector) -> float:
    a, b, c = point
    angle: float = np.arctan2(a * w[0] + b * w[1] + c * w[2], a * u[0] + b * u[1] + c * u[2])
    return angle


@compiled
def _angles(points: Any, axis: Any, angles: Any) -> None:
    u, w = across(axis[0], axis[1], axis[2])
    for i in range(len(points)):
        angles[i] = _angle((points[i, 0], points[i, 1], points[i, 2]), u, w)


def find_ports(discs: list[Disc]) -> tuple[list[Disc], list[list[Disc]]]:
    """The outermost disc along each axis and sense; and the discs by axis, the axis with most area first."""
    lines = _by_axis(discs)
    ports = []
    for line in lines:
        for sense in (1.0, -1.0):
            normal = line[0].normal * sense
            facing = [disc for disc in line if disc.normal @ normal > 0]
            if facing:
                end = max(float(disc.center @ normal) for disc in facing)
                ports.append(max((d for d in facing if d.center @ normal > end - 1e-4), key=lambda d: d.outer))
    return ports, lines


def _by_axis(discs: list[Disc]) -> list[list[Disc]]:
    lines: list[list[Disc]] = []
    for disc in discs:
        for line in lines:
            offset = 0.1 * max(disc.outer, line[0].outer) + 1e-4
            if same_line(line[0].center, line[0].normal, disc.center, disc.normal, offset):
                line.append(disc)
                break
        else:
            lines.append([disc])
    return sorted(lines, key=lambda line: -round(sum(np.pi * disc.outer**2 for disc in line), _DIGITS))


def same_line(point: Floats, axis: Floats, other_point: Floats, other_axis: Floats, offset: float) -> bool:
    """Whether two lines run within ``offset`` [m] of each other and nearly parallel."""
    if abs(axis @ other_axis) < PARALLEL:
        return False
    apart = other_point - point
    return bool(np.linalg.norm(apart - axis * (apart @ axis)) <= offset)
