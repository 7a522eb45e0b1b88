"""Plants as binary glTF 2.0, as game engines export them: nodes that share meshes, or one mesh for each material."""

from __future__ import annotations

import json
import struct
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.model.scene import Floats
from cadplants.model.plant import RGB, Plant
from cadplants.writers.placing import Frame, place
from cadplants.writers.plant_file import FileStyle, Written

__all__ = ["write"]

_ARRAY, _ELEMENTS = 34962, 34963  # GL_ARRAY_BUFFER, GL_ELEMENT_ARRAY_BUFFER
_FLOAT, _UINT = 5126, 5125
_JSON, _BIN = 0x4E4F534A, 0x004E4942


def write(plant: Plant, style: FileStyle, stem: str) -> Written:
    """Writes a plant as GLB.

    Args:
        plant: what to write.
        style: metres and Y up by default, as glTF wants; another unit is not recorded, as exporters that ignore the
            standard do it. With ``merged`` everything of a colour is one mesh, in the order of the components.
        stem: name of the scene.
    """
    frame = Frame(style.meters_per_unit or 1.0, style.up_axis or "Y")
    file = _Glb(stem)
    paths = _merged(file, plant, frame) if style.layout == "merged" else _nodes(file, plant, frame)
    extra: dict[str, object] = {"layout": style.layout}
    return Written({".glb": file.data()}, tuple(paths), frame.meters_per_unit, frame.up_axis, {}, extra)


def _nodes(file: _Glb, plant: Plant, frame: Frame) -> list[str]:
    """One node for each component; repeats of a shape and colour share a mesh."""
    numbers = np.random.default_rng([plant.seed, 7]).permutation(max(10 * plant.n_meshes, 10))[: plant.n_meshes]
    meshes: dict[tuple[int, RGB], int] = {}
    paths = []
    for one, component, number in zip(place(plant), plant.components, numbers.tolist(), strict=True):
        key = (one.shape, component.color)
        if key not in meshes:
            name = f"SM_{len(meshes):04d}"
            meshes[key] = file.mesh(name, frame.points(one.solid), one.solid.faces, component.color)
        name = f"Geo_{number:05d}"
        file.node(name, meshes[key], frame.pose(one.pose))
        paths.append(f"/World/{name}")
    return paths


def _merged(file: _Glb, plant: Plant, frame: Frame) -> list[str]:
    """One node and one mesh for each colour, all in world coordinates."""
    members: dict[RGB, list[int]] = {}
    for index, component in enumerate(plant.components):
        members.setdefault(component.color, []).append(index)
    placed = place(plant)
    paths = [""] * plant.n_meshes
    for k, (color, some) in enumerate(members.items()):
        points, faces, shift = [], [], 0
        for rank, index in enumerate(some):
            one = placed[index]
            pose = frame.pose(one.pose)
            points.append(frame.points(one.solid) @ pose[:3, :3].T + pose[:3, 3])
            faces.append(one.solid.faces + shift)
            shift += len(one.solid.vertices)
            paths[index] = f"/World/Merged_{k:02d}/region_{rank}"
        name = f"Merged_{k:02d}"
        file.node(name, file.mesh(name, np.concatenate(points), np.concatenate(faces), color), np.eye(4))
    return paths


class _Glb:
    """A file in the making, all below one node ``World``."""

    def __init__(self, scene: str) -> None:
        self._scene = scene
        self._data = bytearray()
        self._materials: dict[RGB, int] = {}
        self._meshes: list[dict[str, Any]] = []
        self._nodes: list[dict[str, Any]] = []
        self._accessors: list[dict[str, Any]] = []
        self._views: list[dict[str, Any]] = []

    def mesh(self, name: str, points: Floats, faces: npt.NDArray[np.int32], color: RGB) -> int:
        """Adds a mesh, and says its number."""
        material = self._materials.setdefault(color, len(self._materials))
        position = np.ascontiguousarray(points, "<f4")
        low, high = position.min(axis=0), position.max(axis=0)
        bounds = {"min": [float(x) for x in low], "max": [float(x) for x in high]}
        corners = self._accessor(position, _ARRAY, _FLOAT, "VEC3", len(position), bounds)
        indices = self._accessor(np.ascontiguousarray(faces.ravel(), "<u4"), _ELEMENTS, _UINT, "SCALAR", faces.size, {})
        primitive = {"attributes": {"POSITION": corners}, "indices": indices, "material": material, "mode": 4}
        self._meshes.append({"name": name, "primitives": [primitive]})
        return len(self._meshes) - 1

    def node(self, name: str, mesh: int, pose: Floats) -> None:
        """Places a mesh."""
        matrix = {} if np.array_equal(pose, np.eye(4)) else {"matrix": [float(x) for x in pose.T.ravel()]}
        self._nodes.append({"name": name, "mesh": mesh, **matrix})

    def _accessor(
        self, values: npt.NDArray[Any], target: int, kind: int, shape: str, count: int, bounds: dict[str, Any]
    ) -> int:
        data = values.tobytes()
        self._views.append({"buffer": 0, "byteOffset": len(self._data), "byteLength": len(data), "target": target})
        self._data += data
        view = len(self._views) - 1
        self._accessors.append({"bufferView": view, "componentType": kind, "count": count, "type": shape, **bounds})
        return len(self._accessors) - 1

    def data(self) -> bytes:
        """The whole file."""
        materials = [
            {
                "name": f"M_{k:02d}",
                "pbrMetallicRoughness": {"baseColorFactor": [*map(float, color), 1.0], "metallicFactor": 0.0},
            }
            for color, k in self._materials.items()
        ]
        root = {"name": "World", "children": list(range(1, len(self._nodes) + 1))}
        content = {
            "asset": {"version": "2.0", "generator": "cadplants"},
            "scene": 0,
            "scenes": [{"name": self._scene, "nodes": [0]}],
            "nodes": [root, *self._nodes],
            "meshes": self._meshes,
            "materials": materials,
            "accessors": self._accessors,
            "bufferViews": self._views,
            "buffers": [{"byteLength": len(self._data)}],
        }
        text = json.dumps(content, separators=(",", ":")).encode("ascii")
        chunks = b""
        for kind, chunk, filler in ((_JSON, text, b" "), (_BIN, bytes(self._data), b"\0")):
            padded = chunk + filler * (-len(chunk) % 4)
            chunks += struct.pack("<II", len(padded), kind) + padded
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
