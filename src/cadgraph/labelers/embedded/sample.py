"""Points spread evenly over surfaces: what a shape looks like, whatever its triangles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadgraph.model.scene import Floats, Scene, mesh_of_face

__all__ = ["Samples", "ray_gaps", "sample_surfaces"]

# The golden ratio's relatives: successive multiples spread evenly over the unit square (R2 sequence, Roberts 2018).
_STEP = (0.7548776662466927, 0.5698402909980532)
_OFF = 2e-4  # rays start this share of the box's diagonal off the surface: embree works in float32


@dataclass(frozen=True)
class Samples:
    """Points on meshes, the same number on each.

    Args:
        points: ``(n_meshes, n, 3)`` [m].
        normals: ``(n_meshes, n, 3)`` unit; of either sense where a mesh is not closed.
    """

    points: Floats
    normals: Floats


def sample_surfaces(scene: Scene, count: int) -> Samples:
    """Spreads points over each mesh in proportion to area, without chance.

    Args:
        scene: any.
        count: points on each mesh.

    Returns:
        The points; all at the first vertex, with a normal of zero, where a mesh has no area.
    """
    n = scene.n_meshes
    if not n or not count:
        return Samples(np.zeros((n, count, 3)), np.zeros((n, count, 3)))
    triangles = scene.triangles()
    cross = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    double = np.linalg.norm(cross, axis=1)
    double = np.where(np.isfinite(double), double, 0.0)
    owner = mesh_of_face(scene)
    total = np.bincount(owner, weights=double, minlength=n)
    # A running sum in which every mesh takes one unit keeps the resolution that one over the whole scene would lose.
    share = double / np.where(total > 0, total, 1.0)[owner]
    running = np.cumsum(share)
    before = np.concatenate([[0.0], running])[scene.face_offsets[:-1]]
    within = running - before[owner] + owner
    wanted = (np.arange(n)[:, None] + (np.arange(count) + 0.5) / count).reshape(-1)
    first, last = np.repeat(scene.face_offsets[:-1], count), np.repeat(scene.face_offsets[1:] - 1, count)
    face = np.clip(np.searchsorted(within, wanted), first, np.maximum(last, first))
    some = np.repeat(total > 0, count)
    face = np.where(some, face, 0)
    k = np.tile(np.arange(1, count + 1), n)
    u, v = (k * _STEP[0]) % 1.0, (k * _STEP[1]) % 1.0
    over = u + v > 1
    u, v = np.where(over, 1 - u, u), np.where(over, 1 - v, v)
    corners = triangles[face]
    points = corners[:, 0] + u[:, None] * (corners[:, 1] - corners[:, 0]) + v[:, None] * (corners[:, 2] - corners[:, 0])
    normals = cross[face] / np.maximum(double[face], 1e-300)[:, None]
    points[~some], normals[~some] = 0.0, 0.0
    return Samples(points.reshape(n, count, 3), normals.reshape(n, count, 3))


def ray_gaps(scene: Scene, samples: Samples, count: int) -> Floats:
    """How far it is from points on each mesh to its own surface across, on either side.

    Args:
        scene: whose meshes were sampled.
        samples: of these meshes.
        count: of each mesh's samples so many are looked at, evenly picked.

    Returns:
        ``(n_meshes, count, 2)`` the lesser and the greater way [m]; inf where a ray meets nothing.
    """
    from embreex import rtcore_scene
    from embreex.mesh_construction import TriangleMesh

    n, available = samples.points.shape[:2]
    picked = (np.arange(count) * available) // max(count, 1)
    gaps = np.full((n, count, 2), np.inf)
    triangles = scene.triangles()
    for mesh in range(n):
        corners = triangles[int(scene.face_offsets[mesh]) : int(scene.face_offsets[mesh + 1])]
        low, high = (corners.reshape(-1, 3).min(axis=0), corners.reshape(-1, 3).max(axis=0)) if len(corners) else (0, 0)
        size = float(np.linalg.norm(np.asarray(high) - low))
        if not (size > 0 and np.isfinite(size)):
            continue
        tree = rtcore_scene.EmbreeScene()
        TriangleMesh(tree, np.ascontiguousarray((corners - low) / size, np.float32))
        points, normals = (samples.points[mesh, picked] - low) / size, samples.normals[mesh, picked]
        origins = np.concatenate([points + _OFF * normals, points - _OFF * normals])
        ways = np.concatenate([normals, -normals])
        hit = tree.run(
            np.ascontiguousarray(origins, np.float32), np.ascontiguousarray(ways, np.float32), query="DISTANCE"
        )
        hit = np.where(hit < 1e30, hit + _OFF, np.inf) * size
        gaps[mesh] = np.sort(hit.reshape(2, count).T, axis=1)
    return gaps
