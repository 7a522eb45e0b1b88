"""A plant whose source is not at hand, drawn as the boxes round its parts, which the graph knows."""

from __future__ import annotations

import numpy as np

from cadgraph.model.graph import SceneGraph
from cadgraph.model.scene import Scene, Source

__all__ = ["boxes_of"]

_FAR = 1e4  # m from the zero point, beyond which places are told from a nearer point
_CORNERS = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
_SIDES = np.array(
    [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
)  # fmt: skip
_FACES = np.concatenate([_SIDES[:, (0, 1, 2)], _SIDES[:, (0, 2, 3)]])


def boxes_of(graph: SceneGraph) -> Scene:
    """A scene in which each part is its oriented box, under the path of its largest mesh.

    Args:
        graph: finished.
    """
    boxes = [part.obb for part in graph.parts()]
    centers = np.array([box.center for box in boxes], np.float64).reshape(-1, 3)
    middle = np.round(centers.mean(axis=0)) if len(boxes) else np.zeros(3)
    origin = middle if np.linalg.norm(middle) > _FAR else np.zeros(3)
    meshes = []
    for box, center in zip(boxes, centers, strict=True):
        vertices = _CORNERS * np.array(box.extents) @ np.array(box.axes) + (center - origin)
        meshes.append((vertices, _FACES))
    source = Source(path=graph.source.path)
    scene = Scene.from_meshes(meshes, [part.meshes[0] for part in graph.parts()], source=source)
    return Scene(scene.shapes, scene.paths, scene.colors, source, origin=origin)
