"""How the faces of each mesh meet: how much of its surface turns at which angles, inward or outward."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadgraph.geometry.kernels.distinct import number_rows
from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.geometry.mesh.edges import edges_of, places_of
from cadgraph.model.parts import Properties
from cadgraph.model.scene import Floats, Ints, Scene, mesh_of_face

__all__ = ["EDGE_FEATURES", "edge_features"]

_CLASSES = np.radians([15.0, 45.0, 60.0, 75.0, 90.0, 120.0, 160.0])
"""Middles of the classes of angles: whatever is smooth, and 45, 60 and 90 degrees by themselves (nuts, boxes)."""
_FOLDED = np.radians(170.0)
_FLAT = np.radians(0.2)  # faces that meet at less than this are one plane, cut up

EDGE_FEATURES: tuple[tuple[str, int], ...] = (
    ("bend", len(_CLASSES)), ("hollow bend", 2), ("bend in all", 1),
)  # fmt: skip
"""Blocks of numbers and their sizes."""

_WELD = 1e-5  # corners closer than this share of the mesh's size are one


def edge_features(scene: Scene, properties: Properties) -> Floats:
    """Describes the edges of each mesh, corners in one place being one vertex and equal triangles one.

    An edge counts by its length times the angle by which the surface turns there: a round wall turns by as much
    whatever the number of its sides, and what only cuts up a plane doesn't turn at all.

    Args:
        scene: any.
        properties: of its meshes.

    Returns:
        ``(n_meshes, sum of the sizes in EDGE_FEATURES)``: shares of all turning by angle; shares that turn inward,
        smoothly and sharply (of meshes that are not closed the lesser of inward and outward); half of ``log(1 + x)``
        of all turning over the size of the box.
    """
    n, width = scene.n_meshes, sum(size for _, size in EDGE_FEATURES)
    rows = np.zeros((n, width))
    corner, triangles, owner = _distinct(scene)
    if not len(corner):
        return rows
    edges = edges_of(corner)
    _add_turns(
        triangles, corner, owner, edges.starts, edges.sides, properties.closed & (properties.volume < 0), _CLASSES, rows
    )
    k = len(_CLASSES)
    size = np.maximum(np.linalg.norm(properties.obb_extents, axis=1), 1e-12)
    total = rows[:, :k].sum(axis=1)
    rows[:, : k + 2] /= np.maximum(total, 1e-12)[:, None]
    unsure = ~properties.closed
    halves = np.stack([rows[:, 0], 1 - rows[:, 0]], axis=1)
    for column in (0, 1):
        mine = rows[:, k + column]
        rows[:, k + column] = np.where(unsure, np.minimum(mine, np.abs(halves[:, column] - mine)), mine)
    rows[:, k + 2] = np.log1p(total / (np.pi * size)) / 2
    return rows


def _distinct(scene: Scene) -> tuple[Ints, Floats, Ints]:
    """Places of the corners ``(n, 3)``, corners ``(n, 3, 3)`` and mesh of each triangle that has an area, once each."""
    if not len(scene.faces):
        return np.zeros((0, 3), np.int64), np.zeros((0, 3, 3)), np.zeros(0, np.int64)
    triangles, owner = scene.triangles(), mesh_of_face(scene)
    corner = _welded(triangles, owner, scene.n_meshes)
    good = (corner[:, 0] != corner[:, 1]) & (corner[:, 1] != corner[:, 2]) & (corner[:, 0] != corner[:, 2])
    corner, triangles, owner = corner[good], triangles[good], owner[good]
    if len(corner):
        once = number_rows(np.column_stack([np.sort(corner, axis=1), owner]))[0]
        corner, triangles, owner = corner[once], triangles[once], owner[once]
    return corner, triangles, owner


@compiled
def _add_turns(
    triangles: Any, corner: Any, owner: Any, starts: Any, sides: Any, inside_out: Any, classes: Any, rows: Any
) -> None:
    """Adds to the row of each mesh by how much it turns at its edges of two faces, by angle; then how much inward.

    Args:
        triangles: ``(n, 3, 3)`` corners [m].
        corner: ``(n, 3)`` the place of each.
        owner: ``(n,)`` mesh of each.
        starts: where the sides of each edge start.
        sides: of the edges.
        inside_out: ``(n_meshes,)`` whether the faces of a closed mesh look inward.
        classes: ``(n_classes,)`` middles of the classes of angles [rad].
        rows: ``(n_meshes, n_classes + 2 or more)`` what is added to.
    """
    k = len(classes)
    for e in range(len(starts) - 1):
        if starts[e + 1] - starts[e] != 2:
            continue
        one, other = sides[starts[e]], sides[starts[e] + 1]
        a, b = one // 3, other // 3
        ax, ay, az = _normal(triangles, a)
        bx, by, bz = _normal(triangles, b)
        # Faces of odd orientation: neighbours that run through their edge in the same sense look the other way.
        odd = corner[a, one % 3] == corner[b, other % 3]
        cosine = ax * bx + ay * by + az * bz
        # The cosine is blunt near 0: the sine of small angles is exact.
        x, y, z = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
        angle = np.arctan2(np.sqrt(x * x + y * y + z * z), -cosine if odd else cosine)
        if not angle > _FLAT:
            continue
        i, j, m = one % 3, (one + 1) % 3, (other + 2) % 3
        long = 0.0
        for d in range(3):
            long += (triangles[a, j, d] - triangles[a, i, d]) ** 2
        # The third corner of the other face lies above the plane of this one: a hollow.
        above = (triangles[b, m, 0] - triangles[a, 0, 0]) * ax
        above += (triangles[b, m, 1] - triangles[a, 0, 1]) * ay
        above += (triangles[b, m, 2] - triangles[a, 0, 2]) * az
        mesh = owner[a]
        # A face folded back onto its neighbour is neither; between faces of odd orientation nobody knows.
        inward = 0.5 if odd else 1.0 if (above > 0) != inside_out[mesh] and angle < _FOLDED else 0.0
        turn = np.sqrt(long) * angle
        below = 0
        while below < k - 2 and angle >= classes[below + 1]:
            below += 1
        place = (angle - classes[below]) / (classes[below + 1] - classes[below])
        place = min(1.0, max(0.0, place))
        rows[mesh, below] += turn * (1 - place)
        rows[mesh, below + 1] += turn * place
        smooth = 1 - place if below == 0 else 0.0
        rows[mesh, k] += turn * smooth * inward
        rows[mesh, k + 1] += turn * (1 - smooth) * inward


@compiled
def _normal(triangles: Any, f: int) -> tuple[float, float, float]:
    """Unit normal of a face; 0 where it has none."""
    ux, uy, uz = (triangles[f, 1, 0] - triangles[f, 0, 0], triangles[f, 1, 1] - triangles[f, 0, 1],
                  triangles[f, 1, 2] - triangles[f, 0, 2])  # fmt: skip
    vx, vy, vz = (triangles[f, 2, 0] - triangles[f, 0, 0], triangles[f, 2, 1] - triangles[f, 0, 1],
                  triangles[f, 2, 2] - triangles[f, 0, 2])  # fmt: skip
    x, y, z = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    long = max(np.sqrt(x * x + y * y + z * z), 1e-300)
    return x / long, y / long, z / long


def _welded(triangles: Floats, owner: Ints, n: int) -> Ints:
    """A number for each place of each mesh, ``(n_faces, 3)``."""
    points = triangles.reshape(-1, 3)
    starts = np.searchsorted(owner, np.arange(n))
    filled = np.flatnonzero(np.diff(starts, append=len(owner)) > 0)
    low, size = np.zeros((n, 3)), np.zeros(n)
    low[filled] = np.minimum.reduceat(points, 3 * starts[filled])
    extent = np.maximum.reduceat(points, 3 * starts[filled]) - low[filled]
    size[filled] = np.linalg.norm(np.where(np.isfinite(extent), extent, 0), axis=1)
    mesh = np.repeat(owner, 3)
    return places_of((points - low[mesh]) / np.maximum(_WELD * size, 1e-9)[mesh, None], owner)
