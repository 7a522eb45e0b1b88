"""A scene with its wheels, levers and needles turned."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from cadgraph.geometry.mesh.pieces import pieces_of
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Mechanism
from cadgraph.model.scene import Floats, Ints, Scene
from cadgraph.query.mechanisms import joint_names

__all__ = ["Mover", "Posing"]


@dataclass(frozen=True)
class Mover:
    """What turns at a unit.

    Args:
        unit: its id.
        mechanism: about what it turns.
        meshes: ``(n,)`` rows of the scene that it is made of.
        vertices: ``(m,)`` rows of the scene's vertices that turn with it.
    """

    unit: str
    mechanism: Mechanism
    meshes: Ints
    vertices: Ints

    def turned(self, points: Floats, angle: float, origin: Floats) -> Floats:
        """Points ``(n, 3)`` turned with it.

        Args:
            points: relative to the scene's origin [m].
            angle: anticlockwise, seen against the axis [deg].
            origin: of the scene [m].
        """
        axis = np.asarray(self.mechanism.axis)
        pivot = np.asarray(self.mechanism.pivot) - origin
        arms, turn = points - pivot, math.radians(angle)
        along = np.outer(arms @ axis, axis)
        turned: Floats = pivot + along + math.cos(turn) * (arms - along) + math.sin(turn) * np.cross(axis, arms)
        return turned


class Posing:
    """Turns what can turn in a scene.

    Args:
        scene: as drawn.
        graph: of this scene, with its mechanisms.
    """

    def __init__(self, scene: Scene, graph: SceneGraph) -> None:
        self.scene = scene
        names = joint_names(graph)
        row = {path: number for number, path in enumerate(scene.paths)}
        self.movers: dict[str, Mover] = {}
        for unit in graph.units():
            found = unit.mechanism
            meshes = [row[path] for path in found.meshes if path in row] if found is not None else []
            if found is not None and meshes:
                self.movers[names[unit.id]] = Mover(unit.id, found, np.array(meshes), _moving(scene, found, meshes))
        self.joint_of = {mover.unit: joint for joint, mover in self.movers.items()}

    def turned(self, angles: Mapping[str, float]) -> Scene:
        """The scene with these joints turned [deg]; the others stay as drawn."""
        vertices = self.scene.vertices.copy()
        for joint, angle in angles.items():
            mover = self.movers.get(joint)
            if mover is not None and angle:
                vertices[mover.vertices] = mover.turned(vertices[mover.vertices], angle, self.scene.origin)
        return self.scene.with_vertices(vertices)


def _moving(scene: Scene, mechanism: Mechanism, meshes: list[int]) -> Ints:
    """The vertices that turn: all of the meshes, or those of some pieces of the one mesh."""
    ranges = [np.arange(*scene.vertex_offsets[mesh : mesh + 2]) for mesh in meshes]
    if not mechanism.pieces:
        return np.concatenate(ranges)
    vertices, faces = scene.mesh(meshes[0])
    piece = pieces_of(vertices, faces)
    moving = np.zeros(len(vertices), bool)
    moving[faces[np.isin(piece, mechanism.pieces)]] = True
    return ranges[0][moving]
