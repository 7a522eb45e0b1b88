"""Binary glTF 2.0 as far as CAD converters write it: the node tree, triangles and base colours.

Our own reader, because the general ones rename nodes and join or split what belongs to one node.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.model.scene import Faces, Floats

__all__ = ["GlbMesh", "GlbNode", "read_glb"]

_JSON, _BIN = 0x4E4F534A, 0x004E4942  # chunk types, glTF 2.0 section 4.4.3
_TRIANGLES = 4
_COMPONENT = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
_WIDTH = {"SCALAR": 1, "VEC3": 3}


@dataclass(frozen=True)
class GlbMesh:
    """All triangles of one mesh.

    Args:
        name: as in the file, maybe empty.
        points: ``(n, 3)`` float32.
        faces: ``(m, 3)`` int32.
        colors: ``(m, 3)`` linear RGB of each triangle, NaN where it has no material.
    """

    name: str
    points: npt.NDArray[np.float32]
    faces: Faces
    colors: Floats


@dataclass(frozen=True)
class GlbNode:
    """One node of the tree.

    Args:
        name: as in the file, maybe empty.
        matrix: ``(4, 4)`` for row vectors, to the parent.
        mesh: its number, or None.
        children: numbers of nodes.
    """

    name: str
    matrix: Floats
    mesh: int | None
    children: tuple[int, ...]


def read_glb(data: bytes) -> tuple[list[GlbNode], list[int], list[GlbMesh]]:
    """Reads a binary glTF file with one buffer of its own.

    Returns:
        All nodes, the numbers of the root nodes, all meshes.

    Raises:
        ValueError, KeyError, IndexError: it isn't one, or uses what CAD converters don't.
    """
    tree, buffer = _chunks(data)
    nodes = [_node(node) for node in tree.get("nodes", [])]
    scenes = tree.get("scenes", [])
    roots = list(scenes[tree.get("scene", 0)].get("nodes", [])) if scenes else []
    return nodes, roots, [_mesh(tree, buffer, mesh) for mesh in tree.get("meshes", [])]


def _chunks(data: bytes) -> tuple[dict[str, Any], bytes]:
    if len(data) < 20 or data[:4] != b"glTF":
        raise ValueError("no binary glTF")
    at, found = 12, {}
    while at + 8 <= len(data):
        length, kind = struct.unpack_from("<II", data, at)
        found[kind] = data[at + 8 : at + 8 + length]
        at += 8 + length
    return json.loads(found[_JSON]), found.get(_BIN, b"")


def _node(node: Mapping[str, Any]) -> GlbNode:
    if "matrix" in node:
        # glTF stores the columns of a matrix for column vectors: the rows of the one for row vectors.
        matrix = np.array(node["matrix"], np.float64).reshape(4, 4)
    else:
        matrix = np.eye(4)
        x, y, z, w = node.get("rotation", (0, 0, 0, 1))
        matrix[:3, :3] = [
            [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)],
            [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)],
            [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)],
        ]
        matrix[:3, :3] *= np.array(node.get("scale", (1, 1, 1)), np.float64)[:, None]
        matrix[3, :3] = node.get("translation", (0, 0, 0))
    return GlbNode(node.get("name", ""), matrix, node.get("mesh"), tuple(node.get("children", ())))


def _mesh(tree: Mapping[str, Any], buffer: bytes, mesh: Mapping[str, Any]) -> GlbMesh:
    points, faces, colors = [np.zeros((0, 3), np.float32)], [np.zeros((0, 3), np.int32)], [np.zeros((0, 3))]
    n = 0
    for primitive in mesh.get("primitives", []):
        if primitive.get("mode", _TRIANGLES) != _TRIANGLES:
            continue
        own = _accessor(tree, buffer, primitive["attributes"]["POSITION"])
        corners = (
            _accessor(tree, buffer, primitive["indices"]).reshape(-1) if "indices" in primitive else np.arange(len(own))
        )
        triangles = corners[: len(corners) // 3 * 3].reshape(-1, 3).astype(np.int32)
        points.append(own)
        faces.append(triangles + n)
        colors.append(np.tile(_color(tree, primitive.get("material")), (len(triangles), 1)))
        n += len(own)
    return GlbMesh(mesh.get("name", ""), np.concatenate(points), np.concatenate(faces), np.concatenate(colors))


def _color(tree: Mapping[str, Any], material: int | None) -> Floats:
    if material is None:
        return np.full(3, np.nan)
    rough = tree["materials"][material].get("pbrMetallicRoughness", {})
    return np.array(rough.get("baseColorFactor", (np.nan, np.nan, np.nan))[:3], np.float64)


def _accessor(tree: Mapping[str, Any], buffer: bytes, number: int) -> npt.NDArray[Any]:
    accessor = tree["accessors"][number]
    view = tree["bufferViews"][accessor["bufferView"]]
    dtype = np.dtype(_COMPONENT[accessor["componentType"]])
    width = _WIDTH[accessor["type"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    stride = view.get("byteStride", width * dtype.itemsize)
    return np.ndarray((accessor["count"], width), dtype, buffer, start, (stride, dtype.itemsize)).copy()
