"""Meshes of glTF 2.0: primitives to triangles, with the colours and names of their materials.

Numbers in brackets are sections of the Khronos glTF 2.0 specification.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.errors import MissingExtra
from cadgraph.load.gltf_file import BROKEN, Gltf
from cadgraph.load.packing import Notes
from cadgraph.load.triangles import MAX_TRIANGLES, clean_triangles
from cadgraph.model.scene import Faces, Floats, Ints

__all__ = ["GltfMesh", "promised_triangles", "read_mesh", "values_of"]

_TRIANGLES, _STRIP, _FAN = 4, 5, 6  # modes [3.7.2.1]
_MODE_NAMES = ("points", "lines", "line loops", "line strips")
_DRACO = "KHR_draco_mesh_compression"
_GLOSSY = "KHR_materials_pbrSpecularGlossiness"
_LARGEST = {np.dtype("i1"): 127, np.dtype("u1"): 255, np.dtype("<i2"): 32767, np.dtype("<u2"): 65535}


@dataclass(frozen=True)
class GltfMesh:
    """All triangles of one mesh, those of its primitives together.

    Args:
        points: ``(n, 3)``, each place once.
        faces: ``(m, 3)`` of three different points.
        palette: ``(k, 3)`` linear RGB of its primitives, NaN for none.
        color_of_face: ``(m,)``.
        materials: names of its materials, each once.
        grid: step of the grid that its points lie on, in its own units; 0 where they are floating point.
    """

    points: npt.NDArray[np.floating]
    faces: Faces
    palette: Floats
    color_of_face: Ints
    materials: tuple[str, ...] = ()
    grid: float = 0.0


@dataclass(frozen=True)
class _Primitive:
    points: npt.NDArray[np.floating]
    corners: npt.NDArray[np.integer]
    color: Floats
    grid: float
    source: int  # the number of its points' accessor; a negative one of its own where they come from elsewhere


def promised_triangles(gltf: Gltf, number: int) -> int:
    """How many triangles a mesh says that it has, as far as it can be read; nothing of them is read.

    Args:
        gltf: the file.
        number: of the mesh in it.

    Raises:
        IndexError, KeyError, TypeError: there is no such mesh.
    """
    primitives = gltf.item("meshes", number).get("primitives", [])
    n = 0
    for row in primitives if isinstance(primitives, list) else []:
        with suppress(*BROKEN):
            points = row["attributes"]["POSITION"]
            corners = int(gltf.item("accessors", row.get("indices", points))["count"])
            n += corners // 3 if row.get("mode", _TRIANGLES) == _TRIANGLES else corners
    return n


def read_mesh(gltf: Gltf, number: int, path: str, notes: Notes) -> GltfMesh:
    """Reads one mesh.

    Args:
        gltf: the file.
        number: of the mesh in it.
        path: of a node that shows it, for the notes.
        notes: get ``broken-mesh`` (a primitive that can't be read is left out), ``no-surface`` (points and lines),
            ``morphed-mesh`` and those of :func:`clean_triangles`.

    Raises:
        MissingExtra: it is compressed with Draco and there is no library to read it.
        IndexError, KeyError, TypeError: there is no such mesh.
    """
    mesh = gltf.item("meshes", number)
    primitives = mesh.get("primitives", [])
    found: list[_Primitive] = []
    materials: dict[str, None] = {}
    total = 0
    for row in primitives if isinstance(primitives, list) else []:
        try:
            primitive = _primitive(gltf, row, path, notes)
        except BROKEN as error:
            notes.add("broken-mesh", f"what can't be read of it was left out ({error!s:.120})", path)
            continue
        if primitive is not None:
            found.append(primitive)
            total += len(primitive.corners)
            if total > MAX_TRIANGLES:
                break  # told when they are joined
            name = _material(gltf, row).get("name")
            if isinstance(name, str) and name.strip():
                materials[name] = None
    return _joined(found, tuple(materials), path, notes)


def _joined(found: list[_Primitive], materials: tuple[str, ...], path: str, notes: Notes) -> GltfMesh:
    if not found:
        return GltfMesh(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32), np.zeros((0, 3)), np.zeros(0, int))
    colors = np.repeat(np.arange(len(found)), [len(primitive.corners) for primitive in found])
    # Primitives often share their points: those are taken once.
    distinct = {primitive.source: primitive.points for primitive in found}
    starts = np.cumsum([0, *(len(points) for points in distinct.values())]).tolist()
    shift = dict(zip(distinct, starts[:-1], strict=True))
    if starts[-1] > 3 * MAX_TRIANGLES or len(colors) > MAX_TRIANGLES:
        notes.add("broken-mesh", f"left out: it would have more than {MAX_TRIANGLES:,} triangles", path)
        return _joined([], (), path, notes)
    corners = np.concatenate(
        [
            # Beyond its own points a corner must not reach those of the next primitive.
            np.where(
                (own := primitive.corners.astype(np.int64)) < len(primitive.points), own + shift[primitive.source], -1
            )
            for primitive in found
        ]
    )
    points, faces, kept = clean_triangles(np.concatenate([*distinct.values()]), corners, path, notes)
    palette = np.array([primitive.color for primitive in found])
    return GltfMesh(points, faces, palette, colors[kept], materials, max(primitive.grid for primitive in found))


def _primitive(gltf: Gltf, row: Mapping[str, Any], path: str, notes: Notes) -> _Primitive | None:
    mode = row.get("mode", _TRIANGLES)
    if mode in range(_TRIANGLES):
        notes.add("no-surface", f"its {_MODE_NAMES[mode]} were left out: they have no surface", path)
        return None
    if mode not in (_TRIANGLES, _STRIP, _FAN):
        raise ValueError(f"mode {mode!r:.20} is unknown")
    if row.get("targets"):
        notes.add("morphed-mesh", "taken in the shape that it has without its morph targets", path)
    attributes, extensions = row["attributes"], row.get("extensions", {})
    color = _color(gltf, row)
    if _DRACO in extensions:
        points, corners = _draco(gltf, extensions[_DRACO])
        return _Primitive(points, corners, color, 0.0, -1 - id(points))
    stored = gltf.accessor(attributes["POSITION"])
    if stored.shape[1] != 3:
        raise ValueError("its points don't have three coordinates")
    normalized = bool(gltf.item("accessors", attributes["POSITION"]).get("normalized"))
    grid = 0.0 if stored.dtype.kind == "f" else 1 / _LARGEST[stored.dtype] if normalized else 1.0
    if "indices" in row:
        indices = gltf.accessor(row["indices"])
        if indices.shape[1] != 1 or indices.dtype.kind != "u":
            raise ValueError("its indices are no unsigned whole numbers")
        indices = indices[:, 0]
    else:
        indices = np.arange(len(stored), dtype=np.uint32)
    if "COLOR_0" in attributes:
        color = color * _mean_color(gltf, attributes["COLOR_0"])
    points = stored if not grid else _floating(stored, normalized)
    return _Primitive(points, _triangles(indices, mode), color, grid, attributes["POSITION"])


def _triangles(indices: npt.NDArray[np.integer], mode: int) -> npt.NDArray[np.integer]:
    """``(m, 3)`` corners, wound as the mode says [3.7.2.1]."""
    if mode == _TRIANGLES:
        return indices[: len(indices) // 3 * 3].reshape(-1, 3)
    n = max(0, len(indices) - 2)
    if mode == _FAN:
        return np.stack([indices[1 : n + 1], indices[2 : n + 2], np.repeat(indices[:1], n)], axis=1)
    first = np.arange(n)
    odd = first % 2
    return np.stack([indices[first], indices[first + 1 + odd], indices[first + 2 - odd]], axis=1)


def values_of(gltf: Gltf, number: Any) -> npt.NDArray[np.floating]:
    """The values of an accessor as floating-point numbers, normalized where it says so [3.6.2.2].

    Raises:
        IndexError, KeyError, TypeError, ValueError: they aren't there.
    """
    return _floating(gltf.accessor(number), bool(gltf.item("accessors", number).get("normalized")))


def _floating(stored: npt.NDArray[Any], normalized: bool) -> npt.NDArray[np.floating]:
    if stored.dtype.kind == "f":
        return stored
    if not normalized:
        return stored.astype(np.float32 if stored.itemsize < 4 else np.float64)
    # In float64: 1/32767 of a plant of a kilometre is 3 cm, and float32 would add its own error to that.
    values: npt.NDArray[np.floating] = np.maximum(stored / _LARGEST[stored.dtype], -1.0)
    return values


def _draco(gltf: Gltf, extension: Mapping[str, Any]) -> tuple[npt.NDArray[np.floating], npt.NDArray[np.integer]]:
    try:
        import DracoPy
    except ImportError:
        raise MissingExtra("reading glTF files compressed with Draco", "draco") from None
    data = bytes(gltf.view(extension["bufferView"]))
    try:
        mesh = DracoPy.decode(data)
        points, faces = np.asarray(mesh.points, np.float64), np.asarray(mesh.faces, np.int64)
    except (*BROKEN, DracoPy.FileTypeException, RuntimeError, MemoryError) as error:
        raise ValueError(f"Draco: {error or type(error).__name__}") from None
    return points.reshape(-1, 3), faces.reshape(-1, 3)


def _material(gltf: Gltf, row: Mapping[str, Any]) -> Mapping[str, Any]:
    number = row.get("material")
    try:
        return {} if number is None else gltf.item("materials", number)
    except BROKEN:
        return {}


def _color(gltf: Gltf, row: Mapping[str, Any]) -> Floats:
    """The base colour of a primitive; NaN where it has none, or only a picture."""
    unknown = np.full(3, np.nan)
    if row.get("material") is None:
        return np.ones(3) if "COLOR_0" in row["attributes"] else unknown
    material = _material(gltf, row)
    extensions = material.get("extensions", {})
    if isinstance(extensions, dict) and _GLOSSY in extensions:
        shading, factor, picture = extensions[_GLOSSY], "diffuseFactor", "diffuseTexture"
    else:
        shading, factor, picture = material.get("pbrMetallicRoughness", {}), "baseColorFactor", "baseColorTexture"
    try:
        if picture in shading and factor not in shading:
            return unknown
        # White is what is not written [3.9.2].
        color = np.array(shading.get(factor, (1, 1, 1))[:3], np.float64)
    except BROKEN:
        return unknown
    return color if color.shape == (3,) and np.isfinite(color).all() else unknown


def _mean_color(gltf: Gltf, number: Any) -> Floats:
    try:
        values = values_of(gltf, number)
    except BROKEN:
        return np.ones(3)
    if not len(values) or values.shape[1] < 3:
        return np.ones(3)
    mean: Floats = values[:, :3].mean(axis=0, dtype=np.float64)
    return mean if np.isfinite(mean).all() else np.ones(3)
