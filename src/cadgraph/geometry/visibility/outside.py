"""Which meshes can be seen from outside."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadgraph.geometry.kernels.parallel import compiled, for_ranges
from cadgraph.geometry.mesh.sample import spread_points
from cadgraph.model.parts import Bools, Properties
from cadgraph.model.scene import Faces, Floats, Ints, Scene, mesh_of_face

__all__ = ["find_visible", "visible_share"]

# Rays start this far off a surface, as share of the scene's size: embree works in float32, which has 6e-8.
_OFF = 1e-6
_BATCH = 1 << 18  # sample points in hand at once: about 100 MB, however many meshes there are


def find_visible(
    scene: Scene,
    properties: Properties,
    n_points: int = 64,
    n_directions: int = 64,
    rows: tuple[int, int] | None = None,
) -> Bools:
    """Whether each mesh can be seen from anywhere outside the scene.

    A mesh is visible if from one of its sample points a ray gets out without meeting any surface, this mesh's own
    included: a point inside its own closed pipe is not seen. Both sides of a face count, since CAD faces often look
    the wrong way. The test stops for a mesh at its first free ray.

    Args:
        scene: any.
        properties: of its meshes.
        n_points: sample points of each mesh, spread evenly over its area.
        n_directions: rays from each, spread evenly over the sphere.
        rows: look at the meshes from the first up to the second only, amid all others; None: at all of them.

    Returns:
        ``(n_meshes,)``; meshes without area are not visible, nor are those that were not looked at.
    """
    return visible_share(scene, properties, n_points, n_directions, first_only=True, rows=rows) > 0


def visible_share(
    scene: Scene,
    properties: Properties,
    n_points: int = 64,
    n_directions: int = 64,
    first_only: bool = False,
    rows: tuple[int, int] | None = None,
) -> Floats:
    """Share of the sample points of each mesh that can be seen from outside.

    Args:
        scene: any.
        properties: of its meshes.
        n_points: sample points of each mesh, spread evenly over its area.
        n_directions: rays from each, spread evenly over the sphere.
        first_only: stop for a mesh at its first visible point; the share is then only known to be above 0.
        rows: look at the meshes from the first up to the second only, amid all others; None: at all of them.

    Returns:
        ``(n_meshes,)`` 0..1; 0 for meshes without area, and for those that were not looked at.
    """
    from embreex import rtcore_scene
    from embreex.mesh_construction import TriangleMesh

    if n_points < 1 or n_directions < 1:
        raise ValueError(f"n_points is {n_points} and n_directions {n_directions}; give at least 1 of each")
    n = scene.n_meshes
    area = np.zeros(scene.n_triangles)
    vertices = np.ascontiguousarray(scene.vertices, np.float64)

    def measure_faces(first: int, last: int) -> None:
        _face_areas(vertices, scene.faces, scene.vertex_offsets, scene.face_offsets, first, last, area)

    for_ranges(measure_faces, np.diff(scene.face_offsets))
    faces = np.flatnonzero(area > 0)
    if not len(faces):
        return np.zeros(n)
    owner = mesh_of_face(scene)[faces]
    corners = scene.faces[faces] + scene.vertex_offsets[:-1][owner, None]
    # Centred, so that float32 is spent on the scene itself.
    low, high = np.nanmin(properties.aabb[:, 0], axis=0), np.nanmax(properties.aabb[:, 1], axis=0)
    middle, size = 0.5 * (low + high), float((high - low).max())
    # Vertices that aren't finite belong to no face here; embree must not see them all the same.
    local = np.nan_to_num(vertices - middle, nan=0.0, posinf=0.0, neginf=0.0)
    world = rtcore_scene.EmbreeScene()
    TriangleMesh(world, local.astype(np.float32), corners.astype(np.int32))
    share = np.zeros(n)
    step = max(1, _BATCH // n_points)
    start, stop = (0, n) if rows is None else rows
    # Batches begin at the same meshes whichever are looked at: where points lie depends on what is in a batch.
    for first in range(start - start % step, stop, step):
        last = min(first + step, n)
        own = slice(*np.searchsorted(owner, (first, last)))
        offsets = np.searchsorted(owner[own], np.arange(first, last + 1))
        samples = spread_points(local[corners[own]], offsets, n_points)
        with_area = np.flatnonzero(np.diff(offsets))
        with_area = with_area[(with_area >= start - first) & (with_area < stop - first)]
        points, normals = (rows[with_area].reshape(-1, 3) for rows in (samples.points, samples.normals))
        mesh = np.repeat(with_area, n_points)
        seen = _seen(world, points, normals, mesh, 2 * _OFF * size, n_directions, first_only)
        share[first:last] = np.bincount(mesh[seen], minlength=last - first) / n_points
    return share


def _seen(
    world: Any, points: Floats, normals: Floats, mesh: Ints, off: float, n_directions: int, first_only: bool
) -> Bools:
    """Which points have a ray that gets out; with ``first_only`` at least one of each mesh that has any."""
    seen = np.zeros(len(points), np.bool_)
    # Directions in an order that jumps around, so that most points are settled by the first few.
    for direction in _directions(n_directions):
        waiting = ~seen
        if first_only and len(mesh):
            done = np.zeros(int(mesh[-1]) + 1, np.bool_)
            done[mesh[seen]] = True
            waiting &= ~done[mesh]
        index = np.flatnonzero(waiting)
        if not len(index):
            break
        side = np.sign(normals[index] @ direction)[:, None] * normals[index]
        origins = points[index] + off * side
        aims = np.broadcast_to(direction.astype(np.float32), origins.shape)
        hits = world.run(np.ascontiguousarray(origins, np.float32), np.ascontiguousarray(aims), query="OCCLUDED")
        seen[index] = hits < 0
    return seen


@compiled
def _face_areas(
    vertices: Floats, faces: Faces, v_offsets: Ints, f_offsets: Ints, first: int, last: int, area: Floats
) -> None:
    """Area of each face; 0 where a corner isn't there or isn't finite."""
    for i in range(first, last):
        n = v_offsets[i + 1] - v_offsets[i]
        points = vertices[v_offsets[i] : v_offsets[i + 1]]
        for f in range(f_offsets[i], f_offsets[i + 1]):
            a, b, c = faces[f, 0], faces[f, 1], faces[f, 2]
            if min(a, b, c) < 0 or max(a, b, c) >= n:
                continue
            ux, uy, uz = points[b, 0] - points[a, 0], points[b, 1] - points[a, 1], points[b, 2] - points[a, 2]
            wx, wy, wz = points[c, 0] - points[a, 0], points[c, 1] - points[a, 1], points[c, 2] - points[a, 2]
            x, y, z = uy * wz - uz * wy, uz * wx - ux * wz, ux * wy - uy * wx
            double = np.sqrt(x * x + y * y + z * z)
            area[f] = 0.5 * double if np.isfinite(double) else 0.0


def _directions(n: int) -> Floats:
    """Unit vectors spread evenly over the sphere (Fibonacci lattice), in bit-reversed order."""
    k = np.arange(n)
    z = 1.0 - (2.0 * k + 1.0) / n
    angle = np.pi * (1.0 + np.sqrt(5.0)) * k
    radius = np.sqrt(1.0 - z * z)
    directions = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), z])
    bits = max(1, int(n - 1).bit_length())
    order = np.argsort([int(f"{i:0{bits}b}"[::-1], 2) for i in range(n)], kind="stable")
    jumping: Floats = directions[order]
    return jumping
