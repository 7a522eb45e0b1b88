"""The binary layout of RVM files: big-endian chunks of 32-bit words.

After the layout that rvmparser (github.com/cdyk/rvmparser) reads, checked against files of PDMS 11.5 and E3D 2.1 and
3.1: every chunk is its tag, one letter in each of four words, the offset of the next chunk, 1, and its payload.
"""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.solids.mesh_ops import Solid
from cadplants.solids.tessellate import facets
from cadplants.writers.exact_shapes import Primitive, surface

__all__ = ["RvmFile", "facet_group", "primitive"]

_MM = 1000.0
_KINDS = {"pyramid": 1, "box": 2, "ring": 3, "torus": 4, "dish": 5, "snout": 7, "cylinder": 8, "sphere": 9}
_FACETS = 11

Body = tuple[int, Floats, bytes]
"""Kind, local box ``(2, 3)`` [mm], and parameters as they stand in the file."""


class RvmFile:
    """An RVM file in the making; every ``open`` has its ``close``.

    Args:
        header: program, note, date and user.
        project: its name and that of its database.
    """

    def __init__(self, header: tuple[str, str, str, str], project: tuple[str, str]) -> None:
        self._data = bytearray()
        self._chunk("HEAD", _words(2) + b"".join(_string(text) for text in (*header, "Unicode UTF-8")))
        self._chunk("MODL", _words(1) + _string(project[0]) + _string(project[1]))

    def open(self, name: str, position: Floats, material: int) -> None:
        """Begins a node; what follows up to its ``close`` is in it; its position [m]."""
        self._chunk("CNTB", _words(2) + _string(name) + _floats(position * _MM) + _words(material))

    def close(self) -> None:
        """Ends the node that was begun last."""
        self._chunk("CNTE", _words(1))

    def body(self, body: Body, pose: Floats) -> None:
        """A primitive in the node that is open, placed by a rigid pose [m]."""
        kind, box, parameters = body
        # Rows are the local axes, so that row vectors in mm become metres of the world.
        matrix = np.concatenate([(pose[:3, :3].T / _MM).ravel(), pose[:3, 3]])
        self._chunk("PRIM", _words(1, kind) + _floats(matrix) + _floats(box) + parameters)

    def color(self, material: int, rgb: tuple[int, int, int]) -> None:
        """What colour a material number has, 0..255."""
        self._chunk("COLR", _words(1, material) + bytes(rgb) + b"\0")

    def finish(self) -> bytes:
        """The whole file."""
        self._chunk("END:", _words(1))
        return bytes(self._data)

    def _chunk(self, tag: str, payload: bytes) -> None:
        end = len(self._data) + 24 + len(payload)
        self._data += _words(*tag.encode("ascii"), end, 1) + payload


def _words(*values: int) -> bytes:
    return np.array(values, ">u4").tobytes()


def _floats(values: Floats) -> bytes:
    return np.asarray(values, np.float64).ravel().astype(">f4").tobytes()


def _string(text: str) -> bytes:
    data = text.encode("utf-8")
    count = -(-len(data) // 4)
    return _words(count) + data.ljust(4 * count, b"\0")


def primitive(shape: Primitive) -> Body:
    """A closed form as a body whose matrix is the shape's pose."""
    sizes = _parameters(shape)
    local = Primitive(shape.kind, shape.sizes, np.eye(4))
    points = surface(local) * _MM
    return _KINDS[shape.kind], np.array([points.min(axis=0), points.max(axis=0)]), _floats(np.array(sizes))


def _parameters(shape: Primitive) -> tuple[float, ...]:
    """Lengths in millimetres, angles as they are, in the order of the file."""
    sizes = [size * _MM for size in shape.sizes]
    if shape.kind == "ring":
        return (*sizes, 2 * np.pi)
    if shape.kind == "torus":
        return (*sizes[:2], shape.sizes[2])
    if shape.kind == "snout":
        return (*sizes, 0.0, 0.0, 0.0, 0.0)
    if shape.kind == "sphere":
        return (2 * sizes[0],)
    return tuple(sizes)


def facet_group(solid: Solid) -> Body:
    """A mesh as polygons, each with one contour; what is flat is one polygon where a single way goes round it."""
    points = solid.vertices * _MM
    counts, corners = facets(solid)
    starts = np.concatenate([[0], np.cumsum(counts)[:-1]]).astype(np.int64)
    polygon = np.repeat(np.arange(len(counts)), counts)
    following = np.arange(1, len(corners) + 1)
    following[starts + counts - 1] = starts
    at = points[corners]
    off = at - at[starts][polygon]
    normals = np.add.reduceat(np.cross(off, off[following]), starts, axis=0)  # Newell
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)
    # Of each polygon two words, then six of each corner.
    words = np.zeros(1 + 2 * len(counts) + 6 * len(corners), ">u4")
    words[0] = len(counts)
    heads = 1 + 2 * np.arange(len(counts)) + 6 * starts
    words[heads], words[heads + 1] = 1, counts
    bodies = 3 + 2 * polygon + 6 * np.arange(len(corners))
    rows = np.hstack([at, normals[polygon]]).astype(">f4").view(">u4")
    words[bodies[:, None] + np.arange(6)] = rows
    return _FACETS, np.array([at.min(axis=0), at.max(axis=0)]), words.tobytes()
