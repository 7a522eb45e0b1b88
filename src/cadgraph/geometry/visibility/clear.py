"""Straight lines between points: which of them meet no surface."""

from __future__ import annotations

import numpy as np

from cadgraph.model.parts import Bools
from cadgraph.model.scene import Faces, Floats, Ints, Scene

__all__ = ["clear_between"]

_BUNDLE = 16  # lines whose common box is compared with the triangles
_END = 1e-3  # m; what is met this close to the end of a line doesn't count


def clear_between(scene: Scene, meshes: Ints, starts: Floats, ends: Floats) -> Bools:
    """Which lines meet no surface.

    Args:
        scene: all meshes.
        meshes: the numbers of those that count.
        starts: ``(n, 3)`` where the lines begin [m].
        ends: ``(n, 3)`` where they end.

    Returns:
        ``(n,)``.
    """
    from embreex import rtcore_scene
    from embreex.mesh_construction import TriangleMesh

    if not len(starts) or not len(meshes):
        return np.ones(len(starts), np.bool_)
    some = scene.select(meshes)
    counts = np.diff(some.vertex_offsets)
    owner = np.repeat(np.arange(len(meshes)), np.diff(some.face_offsets))
    good = ((some.faces >= 0) & (some.faces < counts[owner, None])).all(axis=1)
    corners = (some.faces[good] + some.vertex_offsets[:-1][owner[good], None]).astype(np.int32)
    corners = corners[_beside(some.vertices, corners, starts, ends)]
    if not len(corners):
        return np.ones(len(starts), np.bool_)
    middle = starts.mean(axis=0)
    points = np.nan_to_num(some.vertices - middle, nan=0.0, posinf=0.0, neginf=0.0).astype(np.float32)
    world = rtcore_scene.EmbreeScene()
    TriangleMesh(world, points, corners)
    way = ends - starts
    length = np.linalg.norm(way, axis=1)
    aims = way / np.maximum(length, 1e-12)[:, None]
    found = world.run(
        np.ascontiguousarray(starts - middle, np.float32), np.ascontiguousarray(aims, np.float32),
        query="INTERSECT", output=1,
    )  # fmt: skip
    hit, away = np.asarray(found["primID"], np.int64), np.asarray(found["tfar"], np.float64)
    clear: Bools = (hit < 0) | (away >= length - _END)
    return clear


def _beside(vertices: Floats, corners: Faces, starts: Floats, ends: Floats) -> Bools:
    """Which triangles come into the box around some bundle of lines: the others need no tree."""
    low = np.minimum(np.minimum(vertices[corners[:, 0]], vertices[corners[:, 1]]), vertices[corners[:, 2]])
    high = np.maximum(np.maximum(vertices[corners[:, 0]], vertices[corners[:, 1]]), vertices[corners[:, 2]])
    found = np.zeros(len(corners), np.bool_)
    for first in range(0, len(starts), _BUNDLE):
        points = np.concatenate([starts[first : first + _BUNDLE], ends[first : first + _BUNDLE]])
        least, most = points.min(axis=0), points.max(axis=0)
        inside = (low[:, 0] <= most[0]) & (high[:, 0] >= least[0])
        for k in (1, 2):
            inside &= (low[:, k] <= most[k]) & (high[:, k] >= least[k])
        found |= inside
    return found
