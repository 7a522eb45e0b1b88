"""How thick a shape is: the way from points on its surface to the surface across."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.mesh.sample import Samples
from cadgraph.model.scene import Floats, Scene

__all__ = ["ray_gaps"]

_OFF = 2e-4  # rays start this share of the box's diagonal off the surface: embree works in float32


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
