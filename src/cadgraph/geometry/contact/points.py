"""Surfaces as points, and the distances between them, as the paper does it (section III-B, steps 1 and 4).

Vertices move to the centre of the voxel that they lie in, duplicates are dropped, and the straight lines between
the corners of each face get a point every centimetre. The distance of two meshes is that of their closest points.
The paper fills a full distance matrix; trees over the points that can matter give the same answer.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree
from scipy.spatial.distance import cdist

from cadgraph._io.progress import Progress, quiet
from cadgraph.geometry.contact.broad import near_boxes
from cadgraph.model.parts import Contacts
from cadgraph.model.scene import Floats, Ints, Scene, mesh_of_vertex, ranges

__all__ = ["SurfacePoints", "find_point_contacts", "sample_surface"]

TOLERANCE = 1e-9
"""Two points exactly ``eps`` apart count as near; this absorbs rounding [m]."""

_BORDER = 1e-6
# Whole millimetres are common in CAD and lie on voxel borders, where rounding noise would pick the voxel: a vertex
# this close below a border [m] belongs to the voxel above it.

_BRUTE_FORCE = 4096  # below this many point pairs a tree costs more than all distances


@dataclass(frozen=True)
class SurfacePoints:
    """The points of all meshes.

    Args:
        points: ``(n_points, 3)`` [m].
        offsets: ``(n_meshes + 1,)``; mesh ``i`` owns ``points[offsets[i]:offsets[i + 1]]``.
    """

    points: Floats
    offsets: Ints

    def of(self, mesh: int) -> Floats:
        """The points ``(n, 3)`` of one mesh [m]."""
        return self.points[self.offsets[mesh] : self.offsets[mesh + 1]]


def sample_surface(scene: Scene, voxel: float, spacing: float) -> SurfacePoints:
    """Turns surfaces into points.

    Args:
        scene: all meshes.
        voxel: edge of a voxel [m]; the grid is anchored at the scene's origin, a whole number of metres.
        spacing: distance of the points along the sides of a face [m], counted from its corner of lesser
            coordinates, so that the two faces at a side give the same points.

    Returns:
        For each mesh its snapped vertices, each once, then the points along the sides of its faces.
    """
    owner = mesh_of_vertex(scene)
    cells = np.floor((scene.vertices + _BORDER) / voxel).astype(np.int64)
    keyed = np.column_stack([owner, cells])
    unique, cell_of_vertex = np.unique(keyed, axis=0, return_inverse=True)
    corners: Floats = (unique[:, 1:] + 0.5) * voxel

    sides = cell_of_vertex.reshape(-1)[scene.global_faces()][:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    # np.unique sorted the cells, so the lesser index is the corner of lesser coordinates.
    sides = np.sort(sides, axis=1)
    sides = np.unique(sides[sides[:, 0] != sides[:, 1]], axis=0)
    along, side = _fill(corners[sides[:, 0]], corners[sides[:, 1]], spacing)

    mesh = np.concatenate([unique[:, 0], unique[sides[side, 0], 0]])
    order = np.argsort(mesh, kind="stable")
    return SurfacePoints(
        points=np.concatenate([corners, along])[order],
        offsets=np.searchsorted(mesh[order], np.arange(scene.n_meshes + 1)).astype(np.int64),
    )


def find_point_contacts(surface: SurfacePoints, limit: float, progress: Progress = quiet) -> Contacts:
    """All pairs of meshes whose closest points are at most ``limit`` apart.

    Args:
        surface: the points of all meshes.
        limit: greatest distance [m].
        progress: called with the name of a stage and the share of it that is done.

    Returns:
        The pairs with the distance of their closest points and these points.
    """
    filled = np.flatnonzero(np.diff(surface.offsets))
    low = np.minimum.reduceat(surface.points, surface.offsets[filled]) if len(filled) else np.zeros((0, 3))
    high = np.maximum.reduceat(surface.points, surface.offsets[filled]) if len(filled) else np.zeros((0, 3))
    candidates = near_boxes(np.stack([low, high], axis=1), limit + 2 * TOLERANCE)
    found: list[tuple[int, int, float, Floats]] = []
    for done, (a, b) in enumerate(candidates):
        if done % 1024 == 0:
            progress("contacts", done / len(candidates))
        reach = limit + 2 * TOLERANCE
        near_a = _within(surface.of(filled[a]), low[b] - reach, high[b] + reach)
        near_b = _within(surface.of(filled[b]), low[a] - reach, high[a] + reach) if len(near_a) else near_a
        if not len(near_b):
            continue
        distance, points = _closest(near_a, near_b, reach)
        if distance <= limit + TOLERANCE:
            found.append((int(filled[a]), int(filled[b]), 0.0 if distance <= TOLERANCE else distance, points))
    return Contacts(
        pairs=np.array([(a, b) for a, b, _, _ in found], np.int64).reshape(-1, 2),
        distance=np.array([d for _, _, d, _ in found], np.float64),
        points=np.array([p for _, _, _, p in found], np.float64).reshape(-1, 2, 3),
    )


def _fill(starts: Floats, ends: Floats, spacing: float) -> tuple[Floats, Ints]:
    """Points every ``spacing`` strictly between starts and ends, and the index of the line each lies on."""
    lengths = np.linalg.norm(ends - starts, axis=1)
    counts = np.maximum(np.ceil(lengths / spacing - TOLERANCE).astype(np.int64) - 1, 0)
    line = np.repeat(np.arange(len(starts)), counts)
    step = ranges(np.ones_like(counts), counts)
    share = (step * spacing / lengths[line])[:, None] if len(line) else np.zeros((0, 1))
    return starts[line] + share * (ends[line] - starts[line]), line


def _within(points: Floats, low: Floats, high: Floats) -> Floats:
    inside = np.all((points >= low) & (points <= high), axis=1)
    return points if inside.all() else points[inside]


def _closest(points_a: Floats, points_b: Floats, reach: float) -> tuple[float, Floats]:
    """The least distance of two point sets, if within reach (else infinite), and the two points."""
    if len(points_a) * len(points_b) <= _BRUTE_FORCE:
        matrix = cdist(points_a, points_b)
        i, j = divmod(int(matrix.argmin()), len(points_b))
        return float(matrix[i, j]), np.stack([points_a[i], points_b[j]])
    few, many = (points_a, points_b) if len(points_a) <= len(points_b) else (points_b, points_a)
    tree = cKDTree(many, balanced_tree=False, compact_nodes=False)
    found = tree.query(few, distance_upper_bound=reach)
    distances, nearest = np.asarray(found[0], np.float64), np.asarray(found[1], np.int64)
    i = int(distances.argmin())
    if not np.isfinite(distances[i]):
        return np.inf, np.zeros((2, 3))
    pair = (few[i], many[nearest[i]])
    return float(distances[i]), np.stack(pair if few is points_a else pair[::-1])
