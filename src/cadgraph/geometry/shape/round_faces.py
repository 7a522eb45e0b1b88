"""Round flat faces and the round rims of openings, and which of them are where something may join."""

from __future__ import annotations

from itertools import islice

import numpy as np

from cadgraph.geometry.shape.surface import Level, Surface, equal_values
from cadgraph.model.parts import Bools
from cadgraph.model.scene import Floats, Ints
from cadgraph.model.shapes import PARALLEL, Disc

__all__ = ["angles_about", "count_corners", "find_discs", "find_ports", "same_line"]

_MIN_AREA = 1e-4  # smaller patches are no end faces (share of the part's area): those of a 12 m pipe DN50 have 2e-4
_MAX_PATCHES = 64  # only so many patches of a part are looked at, those of most faces first: round ones have many


def find_discs(surface: Surface, patches: Ints, middle: Floats, level: Level) -> list[Disc]:
    """The round flat faces and round rims of a mesh, widest first.

    Args:
        surface: of the mesh.
        patches: ``(n,)`` the flat patch of each face at this level.
        middle: ``(3,)`` of the mesh; rims face away from it [m].
        level: how exact they must be.
    """
    whole = float(surface.areas.sum())
    found = []
    groups = sorted(equal_values(patches, 3), key=len, reverse=True)
    large = (faces for faces in groups if surface.areas[faces].sum() >= _MIN_AREA * whole)
    for faces in islice(large, _MAX_PATCHES):
        areas = surface.areas[faces]
        center = (areas[:, None] * surface.triangles[faces].mean(axis=1)).sum(axis=0) / areas.sum()
        largest = surface.normals[faces[np.argmax(areas)]]
        senses = np.sign(surface.normals[faces] @ largest)
        normal = (areas * senses) @ surface.normals[faces]
        found.append(
            _disc(
                surface.triangles[faces].reshape(-1, 3), surface.corners[faces].reshape(-1), center,
                normal / np.linalg.norm(normal), float(areas.sum()), level,
            )
        )  # fmt: skip
    for lines, meant in islice(zip(surface.rims, surface.rim_corners, strict=True), _MAX_PATCHES):
        size = np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1)
        center = (size[:, None] * lines.mean(axis=1)).sum(axis=0) / size.sum()
        normal = np.linalg.svd(lines.reshape(-1, 3) - center, full_matrices=False)[2][2]
        normal = normal * (1.0 if normal @ (center - middle) >= 0 else -1.0)
        found.append(_disc(lines.reshape(-1, 3), meant.reshape(-1), center, normal, 0.0, level))
    return sorted((disc for disc in found if disc is not None), key=lambda disc: -disc.outer)


def _disc(points: Floats, meant: Bools, center: Floats, normal: Floats, area: float, level: Level) -> Disc | None:
    """A disc if the outermost of the points that are corners of the shape lie evenly on a circle about the centre."""
    points = points[meant]
    if len(points) < 5:
        return None
    apart = points - center
    height = apart @ normal
    radii = np.linalg.norm(apart - height[:, None] * normal, axis=1)
    outer = float(radii.max())
    if outer < 1e-3 or np.abs(height).max() > level.bulge * outer + 1e-5:
        return None
    rim = radii >= level.rim * outer
    sides, full = count_corners(apart[rim], normal, level.gap) if rim.sum() >= 5 else (0, 0.0)
    if not sides:
        return None
    solid = area >= 0.97 * full * outer**2
    inner = 0.0 if solid else float(radii.min()) if area else outer
    return Disc(center, normal, outer, inner, sides, area)


def count_corners(points: Floats, axis: Floats, gap: float) -> tuple[int, float]:
    """How many corners go around an axis through the origin, and the area of that polygon at radius 1.

    Args:
        points: ``(n, 3)`` [m].
        axis: ``(3,)`` unit.
        gap: greatest angle between neighbouring corners [rad]; where one is wider, both results are 0.
    """
    angles = angles_about(axis, points)
    steps = np.diff(np.append(angles, angles[0] + 2 * np.pi))
    steps = steps[steps > 0.01]  # corners of several faces, and of both ends
    if not len(steps) or steps.max() > gap:
        return 0, 0.0
    return len(steps), float(np.sin(steps).sum() / 2)


def angles_about(axis: Floats, points: Floats) -> Floats:
    """The angles of points ``(n, 3)`` around an axis through the origin, ascending [rad]."""
    x, y, z = axis.tolist()
    # Any direction across the axis will do, taken from the least component so that it is far from the axis.
    u = np.array([(0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0)][int(np.argmin(np.abs(axis)))])
    u = u / np.linalg.norm(u)
    w = np.array([y * u[2] - z * u[1], z * u[0] - x * u[2], x * u[1] - y * u[0]])
    angles: Floats = np.sort(np.arctan2(points @ w, points @ u))
    return angles


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
    return sorted(lines, key=lambda line: -sum(np.pi * disc.outer**2 for disc in line))


def same_line(point: Floats, axis: Floats, other_point: Floats, other_axis: Floats, offset: float) -> bool:
    """Whether two lines run within ``offset`` [m] of each other and nearly parallel."""
    if abs(axis @ other_axis) < PARALLEL:
        return False
    apart = other_point - point
    return bool(np.linalg.norm(apart - axis * (apart @ axis)) <= offset)
