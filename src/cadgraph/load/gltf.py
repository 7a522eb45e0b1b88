"""glTF 2.0 (``.glb``, ``.gltf``) to a scene.

A mesh is a node that shows one; its path is the names of the nodes above it. glTF is in metres with Y up by its
standard [3.4]; numbers in brackets are sections of the Khronos glTF 2.0 specification.

Our own reader, because the general ones rename nodes, join or split what belongs to one node, and lose the instances
of ``EXT_mesh_gpu_instancing`` without a word.

Notes in ``Scene.diagnostics``:

- left out: ``no-surface``, ``broken-mesh``, ``broken-node``, ``empty-mesh``, ``hidden``, ``outside-scene``,
  ``repeated-node``, ``too-deep``, and those of ``pack``;
- repaired: ``invalid-indices``, ``invalid-points``;
- guessed: ``skinned-mesh``, ``morphed-mesh``, ``coarse-points``, ``unknown-extension``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from cadgraph.errors import LoadError
from cadgraph.load.budget import Budget
from cadgraph.load.gltf_file import BROKEN, MESHOPT, MESHOPT_REMEDY, Gltf, open_gltf
from cadgraph.load.gltf_mesh import GltfMesh, promised_triangles, read_mesh, values_of
from cadgraph.load.gltf_nodes import walk_nodes
from cadgraph.load.naming import clipped, name_fact, path_step
from cadgraph.load.packing import Notes, Piece, metres_z_up, pack
from cadgraph.load.triangles import main_color
from cadgraph.model.facts import Fact, FactKey
from cadgraph.model.scene import Floats, Scene, Source

if TYPE_CHECKING:
    from cadgraph.config import LoadConfig

__all__ = ["node_matrix", "read"]

_COARSE = 0.001  # [m] a grid coarser than this moves flanges apart that touch; ours
_INSTANCING = "EXT_mesh_gpu_instancing"
_READ = {_INSTANCING, "KHR_draco_mesh_compression", "KHR_mesh_quantization", "KHR_node_visibility"}
_NO_GEOMETRY = (
    *("KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_", "MSFT_packing_", "EXT_materials_"),
    *("KHR_lights_", "EXT_lights_", "KHR_xmp", "KHR_animation_", "KHR_audio", "KHR_physics_", "KHR_interactivity"),
    *("KHR_techniques_webgl", "EXT_mesh_features", "EXT_structural_metadata", "CESIUM_primitive_outline"),
    *("ADOBE_materials_", "FB_material", "MPEG_texture"),
)
"""How the names of extensions begin that change neither triangles nor places."""

_ABRIDGED = (
    *("no-surface", "hidden", "outside-scene", "skinned-mesh", "morphed-mesh", "coarse-points", "invalid-indices"),
    "invalid-points",
)

_FACT_OF: dict[str, FactKey] = {
    "class": "class", "ifcclass": "class", "ifctype": "class", "ifcentity": "class",
    "predefinedtype": "predefined",
    "type": "type", "typename": "type", "componenttype": "type", "parttype": "type", "objecttype": "type",
    "elementtype": "type", "entitytype": "type", "category": "type", "family": "type",
    "name": "name", "displayname": "name", "label": "name", "title": "name",
    "tag": "tag", "tagno": "tag", "tagnumber": "tag", "itemtag": "tag", "equipmenttag": "tag", "kks": "tag",
    "spec": "spec", "specification": "spec", "pipespec": "spec", "catalogue": "spec", "catalog": "spec", "skey": "spec",
    "system": "system", "systemname": "system", "line": "system", "lineno": "system", "linenumber": "system",
    "dn": "size", "nominaldiameter": "size", "nominalbore": "size", "nominalsize": "size", "bore": "size",
    "description": "description", "desc": "description",
    "layer": "layer",
}  # fmt: skip
"""Keys of ``extras``, in lower case and letters and digits only, by what they tell of a part."""


def read(path: Path, config: LoadConfig) -> Scene:
    """Reads a glTF file.

    Args:
        path: of the file; buffers beside it are read too, from its own folder only.
        config: ``invisible`` also loads nodes that are hidden; ``metadata`` says whether extras are kept.

    Returns:
        The scene; ``source`` has no path and no hash yet.

    Raises:
        LoadError: it can't be read, needs an extension that isn't known, or holds no triangle.
        MissingExtra: it is compressed with Draco, and ``DracoPy`` isn't installed.
    """
    gltf = open_gltf(path)
    notes = Notes()
    _check_extensions(gltf, path, notes)
    gltf.load_buffers()
    budget = Budget(path, config, gltf.size)
    reading = _Reading(gltf, budget, config.invisible, config.metadata != "off", notes)
    reading.walk()
    source = Source(meters_per_unit=1.0, up_axis="Y", format="gltf", metadata=_metadata(gltf))
    scene = pack(reading.pieces, source, metres_z_up(1.0, "Y"), notes, _ABRIDGED, reading.facts)
    if not scene.n_meshes:
        raise LoadError(f"{path}: opens, but holds no triangle{_reasons(scene)}; export it with its geometry")
    return scene


def _reasons(scene: Scene) -> str:
    codes = sorted({note.code for note in scene.diagnostics})
    return f" that can be used ({', '.join(codes)})" if codes else ""


def _check_extensions(gltf: Gltf, path: Path, notes: Notes) -> None:
    required, used = (
        {name for name in gltf.rows(key) if isinstance(name, str)} for key in ("extensionsRequired", "extensionsUsed")
    )
    if required & MESHOPT:
        raise LoadError(f"{path}: {MESHOPT_REMEDY}")
    unknown = sorted(name for name in required - _READ if not name.startswith(_NO_GEOMETRY))
    if unknown:
        raise LoadError(
            f"{path}: needs {', '.join(unknown)[:200]}, which is not read; export it without, "
            "or convert it with gltf-transform"
        )
    # Where meshopt isn't required, the plain buffers are there too.
    for name in sorted(used - required - _READ - MESHOPT):
        if not name.startswith(_NO_GEOMETRY):
            notes.add("unknown-extension", f"{name[:80]} is not read; what it holds or changes is missing")


def _metadata(gltf: Gltf) -> tuple[tuple[str, str], ...]:
    asset = gltf.tree.get("asset")
    known = asset if isinstance(asset, dict) else {}
    return tuple((key, clipped(known[key])) for key in ("copyright", "generator") if isinstance(known.get(key), str))


def node_matrix(node: Mapping[str, Any]) -> Floats:
    """The ``(4, 4)`` matrix for row vectors from a node to its parent [3.5.3].

    Raises:
        TypeError, ValueError: what it says isn't one.
    """
    if "matrix" in node:
        # glTF stores the columns of a matrix for column vectors: the rows of the one for row vectors.
        whole: Floats = np.array(node["matrix"], np.float64).reshape(4, 4)
        return whole
    parts = _matrices(
        np.array([node.get("translation", (0, 0, 0))], np.float64),
        np.array([node.get("rotation", (0, 0, 0, 1))], np.float64),
        np.array([node.get("scale", (1, 1, 1))], np.float64),
    )
    one: Floats = parts[0]
    return one


def _matrices(shifts: Floats, turns: Floats, scales: Floats) -> Floats:
    """``(n, 4, 4)`` for row vectors.

    Args:
        shifts: ``(n, 3)``.
        turns: ``(n, 4)`` quaternions x, y, z, w.
        scales: ``(n, 3)``.
    """
    if shifts.shape[1:] != (3,) or turns.shape[1:] != (4,) or scales.shape[1:] != (3,):
        raise ValueError("a placement doesn't have three shifts, four parts of a quaternion and three scales")
    matrices = np.tile(np.eye(4), (len(shifts), 1, 1))
    x, y, z, w = turns.T
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)],
        [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)],
        [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)],
    ]
    matrices[:, :3, :3] = np.array(rows).transpose(2, 0, 1) * scales[:, :, None]
    matrices[:, 3, :3] = shifts
    return matrices


@dataclass
class _Reading:
    """The walk down the tree."""

    gltf: Gltf
    budget: Budget
    invisible: bool
    metadata: bool
    notes: Notes
    pieces: list[Piece] = field(default_factory=list)
    facts: list[Fact] = field(default_factory=list)
    _meshes: dict[int, tuple[GltfMesh, Floats | None]] = field(default_factory=dict)
    _triangles: int = 0
    _coarsest: float = 0.0
    _coarse: list[str] = field(default_factory=list)

    def walk(self) -> None:
        """Takes up the meshes of all nodes of the scene, parents first."""
        seen: set[int] = set()
        for number, path, matrix in walk_nodes(self.gltf, np.eye(4), self._enter, self.notes, seen):
            node = self.gltf.item("nodes", number)
            if node.get("mesh") is not None:
                try:
                    self._place(node, path, matrix)
                except BROKEN as error:
                    self.notes.add("broken-node", f"left out: it can't be read ({error!s:.120})", path)
            if self.metadata:
                self.facts += name_fact(path, node.get("name"), "node.name")
                self.facts += _extras(path, node.get("extras"))
        if self._coarse:
            message = (
                f"its points lie on a grid (quantized); the coarsest in this file is {self._coarsest * 1000:.3g} mm"
            )
            for path in self._coarse:
                self.notes.add("coarse-points", message + "; write it without quantization", path)
        for number, node in enumerate(self.gltf.rows("nodes")):
            if number not in seen and isinstance(node, dict) and node.get("mesh") is not None:
                name = path_step(node.get("name"), f"node_{number}")
                self.notes.add("outside-scene", "left out: the file's scene doesn't hold it", f"/{name}")

    def _enter(self, node: Mapping[str, Any], path: str, above: Floats) -> Floats | None:
        """The matrix to the world of a node, or None if it doesn't count."""
        try:
            shown = node.get("extensions", {}).get("KHR_node_visibility", {}).get("visible", True)
            own = node_matrix(node)
        except BROKEN as error:
            self.notes.add("broken-node", f"left out with all below: it can't be read ({error!s:.120})", path)
            return None
        if not shown and not self.invisible:
            message = "left out with all below: hidden in the file; set load.invisible = true to load it"
            self.notes.add("hidden", message, path)
            return None
        with np.errstate(over="ignore", invalid="ignore"):
            matrix: Floats = own @ above
        return matrix

    def _place(self, node: Mapping[str, Any], path: str, matrix: Floats) -> None:
        number = node["mesh"]
        if number not in self._meshes:
            self.budget.take_triangles(promised_triangles(self.gltf, number))
            mesh = read_mesh(self.gltf, number, path, self.notes)
            self._meshes[number] = mesh, main_color(mesh.points, mesh.faces, mesh.palette, mesh.color_of_face)
        mesh, color = self._meshes[number]
        if not len(mesh.faces):
            self.notes.add("empty-mesh", "left out: it has no triangle", path)
            return
        if node.get("skin") is not None:
            self.notes.add("skinned-mesh", "taken as it is stored and its node is placed, without its joints", path)
        instancing = node.get("extensions", {}).get(_INSTANCING)
        # Each instance takes a matrix of 128 bytes before it takes a piece.
        self.budget.check_meshes(len(self.pieces) + (1 if instancing is None else _promised(self.gltf, instancing)))
        placed = _instances(self.gltf, instancing) @ matrix if instancing is not None else matrix[None]
        self._triangles += len(placed) * len(mesh.faces)
        self.budget.check_placed(self._triangles)
        for i, where in enumerate(placed, start=1):
            own = path if instancing is None else f"{path}/instance_{i}"
            # The same array for every instance: what is shared can be told from it.
            self.pieces.append(Piece(own, mesh.points, mesh.faces, where, color))
            if self.metadata:
                self.facts += [Fact(own, "layer", clipped(name), "material") for name in mesh.materials]
        self._note_grid(mesh.grid, placed, path)

    def _note_grid(self, grid: float, placed: Floats, path: str) -> None:
        step = grid * float(np.linalg.norm(placed[:, :3, :3], axis=2).max()) if grid and len(placed) else 0.0
        if step > _COARSE:
            self._coarse.append(path)
            self._coarsest = max(self._coarsest, step)


def _promised(gltf: Gltf, extension: Mapping[str, Any]) -> int:
    """How many instances a node says that it has."""
    numbers = extension["attributes"].values()
    return max((int(gltf.item("accessors", number)["count"]) for number in numbers), default=0)


def _instances(gltf: Gltf, extension: Mapping[str, Any]) -> Floats:
    """``(n, 4, 4)`` placements below the node (``EXT_mesh_gpu_instancing``)."""
    attributes = extension["attributes"]
    found = {
        key: values_of(gltf, attributes[key]).astype(np.float64)
        for key in ("TRANSLATION", "ROTATION", "SCALE")
        if key in attributes
    }
    n = min((len(values) for values in found.values()), default=0)
    if not n or any(len(values) != n for values in found.values()):
        raise ValueError("its instances have no placement, or lists of different lengths")
    return _matrices(
        found.get("TRANSLATION", np.zeros((n, 3))),
        found.get("ROTATION", np.tile([0.0, 0, 0, 1], (n, 1))),
        found.get("SCALE", np.ones((n, 3))),
    )


def _extras(path: str, extras: Any) -> Iterator[Fact]:
    """What the extras of a node tell, as far as a key says what it is."""
    for key, value in extras.items() if isinstance(extras, dict) else ():
        told = _FACT_OF.get("".join(letter for letter in key.lower() if letter.isalnum()))
        if told and isinstance(value, str | int | float) and not isinstance(value, bool) and str(value).strip():
            yield Fact(path, told, clipped(str(value)), f"extras.{clipped(key)}")
