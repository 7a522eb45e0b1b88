"""Making a scene fit for the stages that follow."""

from __future__ import annotations

import dataclasses

import numpy as np

from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.parts import Bools
from cadgraph.model.scene import Faces, Ints, MeshArrays, Scene, mesh_of_face, mesh_of_vertex

__all__ = ["prepare_scene"]


def prepare_scene(scene: Scene) -> tuple[Scene, tuple[Diagnostic, ...]]:
    """Puts meshes in the order of their paths and takes out what has no place in space.

    Args:
        scene: a loader's scene, or a caller's own arrays.

    Returns:
        A scene of finite vertices in which every mesh has at least one, and what was taken out.

    Raises:
        ValueError: a face refers to a vertex that its mesh doesn't have.
    """
    scene = scene.in_path_order()
    if _is_sound(scene):
        return scene, ()
    bad = _has_strange_corners(scene.faces, scene.vertex_offsets, scene.face_offsets)
    if bad.any():
        path = scene.paths[int(mesh_of_face(scene)[bad][0])]
        raise ValueError(f"{path}: a face refers to a vertex that the mesh doesn't have")
    diagnostics: list[Diagnostic] = []
    finite = np.asarray(np.isfinite(scene.vertices).all(axis=1))
    if not finite.all():
        broken = np.unique(mesh_of_vertex(scene)[~finite])
        message = "vertices that are not finite, and the faces that use them, were left out"
        diagnostics.append(Diagnostic("nonfinite-vertices", message, tuple(scene.paths[i] for i in broken)))
        scene = _keep_vertices(scene, finite)
    empty = np.diff(scene.vertex_offsets) == 0
    if empty.any():
        paths = tuple(scene.paths[i] for i in np.flatnonzero(empty))
        diagnostics.append(Diagnostic("empty-mesh", "meshes without a finite vertex were left out", paths))
        scene = scene.select(np.flatnonzero(~empty))
    return scene, tuple(diagnostics)


def _is_sound(scene: Scene) -> bool:
    """Whether nothing has to be taken out, by the shapes, without placing each mesh that has one."""
    shapes, placement = scene.shapes, scene.placement
    return bool(
        (np.diff(scene.vertex_offsets) > 0).all()
        and np.isfinite(shapes.vertices).all()
        and (placement is None or (np.isfinite(placement.turn).all() and np.isfinite(placement.shift).all()))
        and not _has_strange_corners(shapes.faces, shapes.vertex_offsets, shapes.face_offsets).any()
    )


def _has_strange_corners(faces: Faces, vertex_offsets: Ints, face_offsets: Ints) -> Bools:
    """``(n_faces,)`` whether a face refers to a vertex that its mesh doesn't have."""
    n_vertices = np.repeat(np.diff(vertex_offsets), np.diff(face_offsets))
    return np.asarray(((faces < 0) | (faces >= n_vertices[:, None])).any(axis=1))


def _keep_vertices(scene: Scene, keep: Bools) -> Scene:
    """The scene without some vertices and the faces that use them."""
    kept = np.concatenate([[0], np.cumsum(keep)])
    corners = scene.global_faces()
    whole = keep[corners].all(axis=1)
    offsets = kept[scene.vertex_offsets]
    first = offsets[mesh_of_face(scene)][whole]
    arrays = MeshArrays(
        vertices=scene.vertices[keep],
        faces=(kept[corners[whole]] - first[:, None]).astype(np.int32),
        vertex_offsets=offsets,
        face_offsets=np.concatenate([[0], np.cumsum(whole)])[scene.face_offsets],
    )
    return dataclasses.replace(scene, shapes=arrays, placement=None)
