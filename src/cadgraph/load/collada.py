"""COLLADA (``.dae``) to a scene, through ``pycollada``: each node that shows a geometry is a mesh.

Its library is asked directly, as ``trimesh``, which builds on it, loses the names of nodes, makes a mesh of every
material and applies neither unit nor up axis. Where a file doesn't state them, a metre and Y are what the standard
says (COLLADA 1.4.1, ``unit`` and ``up_axis``).

Notes in ``Scene.diagnostics``:

- left out: ``broken-element``, ``no-surface``, ``empty-mesh``, ``too-deep``, and those of ``pack``;
- repaired: ``invalid-indices``, ``invalid-points``, ``invalid-face-counts``, ``self-intersecting-faces``;
- guessed: ``missing-units``, ``invalid-units``, ``missing-up-axis``, ``skinned-mesh``.
"""

from __future__ import annotations

import struct
import warnings
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import collada
import numpy as np

from cadgraph.errors import LoadError
from cadgraph.load.budget import Budget
from cadgraph.load.naming import Names, clipped, name_fact, path_step
from cadgraph.load.packing import Notes, Piece, metres_z_up, pack
from cadgraph.load.polygons import triangulate
from cadgraph.load.triangles import clean_triangles, main_color
from cadgraph.model.facts import Fact
from cadgraph.model.scene import Faces, Floats, Ints, Scene, Source, ranges

if TYPE_CHECKING:
    from cadgraph.config import LoadConfig

__all__ = ["read"]

_MAX_DEPTH = 200  # of the tree of nodes; ours, far beyond any real one
_MOST_CORNERS = 10_000  # of one face; ours: cutting ears takes the square of it
_UP = {"X_UP": "X", "Y_UP": "Y", "Z_UP": "Z"}
_ABRIDGED = ("invalid-points", "invalid-indices", "no-surface", "skinned-mesh")
_DAMAGE = (
    *(ArithmeticError, AssertionError, AttributeError, LookupError, MemoryError, OSError, RuntimeError, TypeError),
    *(SyntaxError, ValueError, struct.error, collada.common.DaeError),
)


@dataclass(frozen=True)
class _Shape:
    points: Floats
    faces: Faces
    symbol_of_face: Ints
    symbols: tuple[str | None, ...]


def read(path: Path, config: LoadConfig) -> Scene:
    """Reads a COLLADA file.

    Args:
        path: of the file; pictures that it names are not opened.
        config: ``metadata`` says whether names of nodes and materials are kept.

    Returns:
        The scene; ``source`` has no path and no hash yet.

    Raises:
        LoadError: it can't be read, or holds no triangle.
    """
    notes = Notes()
    document = _opened(path)
    unit, up = _units(document, notes)
    reading = _Reading(Budget(path, config, path.stat().st_size), notes)
    try:
        reading.walk(document.scene.nodes if document.scene is not None else [])
    except _DAMAGE as error:
        raise LoadError(f"{path}: not readable as COLLADA ({_reason(error)}); copy or export it again") from None
    for fault in document.errors:
        notes.add("broken-element", f"something that can't be read was left out ({_reason(fault)})")
    source = Source(meters_per_unit=unit, up_axis=up, format="collada")
    kept = reading.facts if config.metadata != "off" else []
    scene = pack(reading.pieces, source, metres_z_up(unit, up), notes, _ABRIDGED, kept)
    if not scene.n_meshes:
        told = "; ".join(notes.messages("broken-element")[:1])
        raise LoadError(f"{path}: opens, but holds no triangle{f' ({told})' if told else ''}; export it again")
    return scene


def _opened(path: Path) -> Any:
    try:
        with path.open("rb") as file, warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return collada.Collada(file, ignore=[collada.common.DaeError])
    except _DAMAGE as error:
        raise LoadError(f"{path}: not readable as COLLADA ({_reason(error)}); copy or export it again") from None


def _reason(error: BaseException) -> str:
    return " ".join(str(error).split())[:120] or type(error).__name__


def _units(document: Any, notes: Notes) -> tuple[float, str]:
    """Length of a unit [m] and up axis."""
    asset = document.assetInfo
    unit = asset.unitmeter
    if unit is None:
        notes.add("missing-units", "the file doesn't state its unit; taken as metres, as the standard says")
        unit = 1.0
    elif not (np.isfinite(unit) and unit > 0):
        notes.add("invalid-units", f"the file states a unit of {unit} m; taken as metres")
        unit = 1.0
    root = document.xmlnode.getroot()
    if root.find(f"{document.tag('asset')}/{document.tag('up_axis')}") is None:
        notes.add("missing-up-axis", "the file doesn't state its up axis; taken as Y, as the standard says")
    return float(unit), _UP.get(str(asset.upaxis), "Y")


@dataclass
class _Reading:
    """The walk down the tree."""

    budget: Budget
    notes: Notes
    pieces: list[Piece] = field(default_factory=list)
    facts: list[Fact] = field(default_factory=list)
    _shapes: dict[int, _Shape] = field(default_factory=dict)
    _triangles: int = 0

    def walk(self, roots: list[Any]) -> None:
        """Takes up the geometries of all nodes, parents first."""
        stack: list[tuple[Any, str, Floats, int]] = []
        n = 0

        def enter(children: list[Any], path: str, matrix: Floats, depth: int) -> None:
            taken = Names()
            entered = [
                (child, f"{path}/{taken.take(path_step(_name(child), 'node'))}", matrix, depth)
                for child in children
                if isinstance(child, collada.scene.Node)
            ]
            stack.extend(reversed(entered))

        enter(roots, "", np.eye(4), 0)
        while stack:
            node, path, above, depth = stack.pop()
            n += 1
            self.budget.check_meshes(n)
            self.budget.check_placed(self._triangles)
            with np.errstate(over="ignore", invalid="ignore"):
                matrix = np.asarray(node.matrix, np.float64).T @ above
            self.facts += name_fact(path, _name(node), "node name")
            self._place([child for child in node.children if not isinstance(child, collada.scene.Node)], path, matrix)
            below = [child for child in node.children if isinstance(child, collada.scene.Node)]
            if depth < _MAX_DEPTH:
                enter(below, path, matrix, depth + 1)
            elif below:
                self.notes.add("too-deep", f"what lies deeper than {_MAX_DEPTH} nodes below it was left out", path)

    def _place(self, shown: list[Any], path: str, matrix: Floats) -> None:
        """All geometries of one node; the first, as most have one, under its own path."""
        taken, is_first = Names(), True
        for child in shown:
            if isinstance(child, collada.scene.ControllerNode):
                self.notes.add("skinned-mesh", "taken as it is stored and its node is placed, without its joints", path)
                geometry = getattr(child.controller, "geometry", None)
            else:
                geometry = getattr(child, "geometry", None)
            if geometry is None:
                continue
            if id(geometry) not in self._shapes:
                self._shapes[id(geometry)] = _shape(geometry, path, self.notes)
            shape = self._shapes[id(geometry)]
            if not len(shape.faces):
                self.notes.add("empty-mesh", "left out: it has no triangle", path)
                continue
            self._triangles += len(shape.faces)
            step = path_step(geometry.name or geometry.id, "part")
            own = path if is_first else taken.take(f"{path}/{step}")
            is_first = False
            materials = {entry.symbol: entry.target for entry in child.materials}
            used = [materials.get(symbol) for symbol in shape.symbols]
            palette = np.array([_diffuse(material) for material in used])
            color = main_color(shape.points, shape.faces, palette, shape.symbol_of_face)
            # The same array for every instance: what is shared can be told from it.
            self.pieces.append(Piece(own, shape.points, shape.faces, matrix, color))
            names = dict.fromkeys(str(material.name or material.id) for material in used if material is not None)
            self.facts += [Fact(own, "layer", clipped(name), "material") for name in names]


def _name(node: Any) -> str | None:
    """The name of a node; that of the node it stands for, where it is an instance of one."""
    node = getattr(node, "node", node)
    name = node.name or node.id
    return name if isinstance(name, str) else None


def _diffuse(material: Any) -> Floats:
    """The diffuse colour of a material; NaN where it has none, or a picture."""
    color = getattr(getattr(material, "effect", None), "diffuse", None)
    unknown = np.full(3, np.nan)
    if not isinstance(color, tuple | list) or len(color) < 3:
        return unknown
    try:
        found = np.array([float(value) for value in color[:3]])
    except (TypeError, ValueError):
        return unknown
    return found if np.isfinite(found).all() else unknown


def _shape(geometry: Any, path: str, notes: Notes) -> _Shape:
    """All triangles of a geometry."""
    points, corners, owner = [np.zeros((0, 3))], [np.zeros((0, 3), np.int64)], [np.zeros(0, np.int64)]
    symbols: list[str | None] = []
    n = 0
    for primitive in geometry.primitives:
        found = _cut(primitive, path, notes)
        if found is None:
            continue
        own, triangles = found
        points.append(own)
        corners.append(np.where((triangles >= 0) & (triangles < len(own)), triangles + n, -1))
        owner.append(np.full(len(triangles), len(symbols)))
        symbols.append(primitive.material)
        n += len(own)
    kept_points, faces, kept = clean_triangles(np.concatenate(points), np.concatenate(corners), path, notes)
    return _Shape(np.asarray(kept_points, np.float64), faces, np.concatenate(owner)[kept], tuple(symbols))


def _cut(primitive: Any, path: str, notes: Notes) -> tuple[Floats, Ints] | None:
    """Points and triangles of one primitive, or None where it has no surface."""
    if primitive.vertex is None or primitive.vertex_index is None:
        return None
    points, corners = np.asarray(primitive.vertex, np.float64), np.asarray(primitive.vertex_index, np.int64)
    if isinstance(primitive, collada.triangleset.TriangleSet):
        return points, corners.reshape(-1, 3)
    if not isinstance(primitive, collada.polylist.Polylist):
        notes.add("no-surface", "its lines were left out: they have no surface", path)
        return None
    corners, counts = corners.reshape(-1), np.asarray(primitive.vcounts, np.int64).reshape(-1)
    starts = np.cumsum(counts) - counts
    usable = (counts >= 3) & (counts <= _MOST_CORNERS) & (starts + counts <= len(corners)) & (starts >= 0)
    if not usable.all():
        message = f"faces without 3 to {_MOST_CORNERS:,} corners were dropped"
        notes.add("invalid-face-counts", message, path)
    chosen = ranges(starts[usable], counts[usable])
    counts, corners = counts[usable], corners[chosen]
    sound = (corners >= 0) & (corners < len(points))
    sound[sound] = np.isfinite(points[corners[sound]]).all(axis=1)
    if not sound.all():
        notes.add("invalid-points", "faces that use missing, NaN or infinite points were dropped", path)
        bad = np.zeros(len(counts), bool)
        bad[np.repeat(np.arange(len(counts)), counts)[~sound]] = True
        corners, counts = corners[np.repeat(~bad, counts)], counts[~bad]
    cut = triangulate(points, counts, np.cumsum(counts) - counts, corners, np.arange(len(counts)))
    if len(cut.twisted):
        notes.add("self-intersecting-faces", "faces that cross themselves were cut as well as can be", path)
    return points, np.asarray(cut.corners, np.int64)
