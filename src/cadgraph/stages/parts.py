"""From meshes to parts: the items that later stages speak of."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cadgraph.geometry.mesh.properties import measure
from cadgraph.geometry.shape.repeats import find_shapes
from cadgraph.model.parts import Bools, Parts, Properties
from cadgraph.model.scene import Ints, Scene

__all__ = ["make_parts", "regrounded"]


def make_parts(scene: Scene, properties: Properties, head_of_mesh: Ints, ground: Bools) -> Parts:
    """Merges meshes into parts and measures them.

    Args:
        scene: the source meshes.
        properties: of each mesh.
        head_of_mesh: ``(n_meshes,)`` the mesh that heads each mesh's part.
        ground: ``(n_meshes,)`` bool.

    Returns:
        The parts in the order of their heads.
    """
    heads, part_of_mesh = np.unique(head_of_mesh, return_inverse=True)
    part_of_mesh = part_of_mesh.reshape(-1).astype(np.int64)
    merged = scene.merge(part_of_mesh, heads)
    measured = properties if merged is scene else measure(merged)
    # The head is the largest by the volume that grouping went by; the rest follow by their boxes.
    joined = heads[part_of_mesh] != np.arange(scene.n_meshes)
    rest = np.lexsort((np.arange(scene.n_meshes), -properties.obb_volume, joined))
    meshes: list[list[int]] = [[] for _ in heads]
    for mesh in rest.tolist():
        meshes[part_of_mesh[mesh]].append(mesh)
    return Parts(
        scene=merged,
        meshes=tuple(tuple(m) for m in meshes),
        part_of_mesh=part_of_mesh,
        properties=measured,
        shape=find_shapes(merged, measured).shape,
        ground=ground[heads],
    )


def regrounded(parts: Parts, head_of_mesh: Ints, ground: Bools) -> Parts | None:
    """Parts of the same meshes of which others are the ground, so that nothing is measured again.

    Args:
        parts: as they were.
        head_of_mesh: ``(n_meshes,)`` the mesh that heads each mesh's part.
        ground: ``(n_meshes,)`` bool.

    Returns:
        The parts, of which it is not known which lies inside which; None where other meshes belong together now.
    """
    heads = np.array([meshes[0] for meshes in parts.meshes], np.int64)
    if not np.array_equal(heads[parts.part_of_mesh], head_of_mesh):
        return None
    return replace(parts, ground=ground[heads], inside={})
