"""STEP and IGES to a scene, through OpenCASCADE (``cascadio``).

Paths are the names along the assembly tree (``/Skid/Valve_1/Body``): every occurrence of a part is a mesh, and so is
every solid of a part that holds several (``/Skid/Valve/body_1``, ``body_2``).

Notes in ``Scene.diagnostics``: ``several-bodies``, ``empty-mesh``, ``degenerate-mesh``,
``invalid-transform``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import cascadio
import numpy as np
import numpy.typing as npt

from cadgraph.errors import LoadError
from cadgraph.geometry.mesh.merge import weld_points
from cadgraph.load.bodies import split_bodies
from cadgraph.load.glb import GlbMesh, GlbNode, read_glb
from cadgraph.load.packing import Notes, Piece, pack, unique_name
from cadgraph.model.scene import Faces, Floats, Scene, Source

if TYPE_CHECKING:
    from cadgraph.config import LoadConfig

__all__ = ["read"]

_MAX_DEPTH = 200  # of an assembly tree; ours, far beyond any real one
_ABRIDGED = ("several-bodies",)
_STEP_UNITS = {b".KILO.": 1000.0, b"$": 1.0, b".DECI.": 0.1, b".CENTI.": 0.01, b".MILLI.": 0.001, b".MICRO.": 1e-6}
_IGES_UNITS = {
    b"IN": 0.0254, b"INCH": 0.0254, b"MM": 0.001, b"FT": 0.3048, b"M": 1.0, b"KM": 1000.0, b"CM": 0.01, b"MIL": 2.54e-5,
    b"UM": 1e-6,
}  # fmt: skip


@dataclass(frozen=True)
class _Body:
    points: npt.NDArray[np.float32]
    faces: Faces
    color: Floats | None


def read(path: Path, config: LoadConfig) -> Scene:
    """Reads a STEP or IGES file.

    Args:
        path: of the file.
        config: ``max_gap`` and ``max_angle`` say how fine curved surfaces are cut.

    Returns:
        The scene; ``source`` has no path and no hash yet.

    Raises:
        LoadError: it can't be read, or holds no solid and no surface.
    """
    data = path.read_bytes()
    form = "iges" if path.suffix.lower() in (".igs", ".iges") else "step"
    # The library works in millimetres whatever the file's unit, and so does its tolerance.
    glb = cascadio.load(
        data, file_type=form, tol_linear=config.max_gap * 1000, tol_angular=config.max_angle, tol_relative=False
    )
    if not glb:
        raise LoadError(f"{path}: not readable as {form.upper()} (damaged or cut short); export it again")
    try:
        nodes, roots, meshes = read_glb(glb)
    except (ValueError, KeyError, IndexError, TypeError) as error:
        raise LoadError(f"{path}: the CAD library returned no usable triangles ({error})") from error
    notes = Notes()
    bodies: dict[int, list[_Body]] = {}
    pieces: list[Piece] = []
    for at, matrix, node in _occurrences(nodes, roots, meshes):
        number = node.mesh
        if number is None:
            continue
        if number not in bodies:
            bodies[number] = _bodies(meshes[number])
        pieces.extend(_pieces(at, matrix, bodies[number], notes))
    # Of IGES the library (cascadio 0.1) leaves the lengths in millimetres.
    to_metres = np.diag([0.001, 0.001, 0.001, 1]) if form == "iges" else np.eye(4)
    unit = _iges_unit(data) if form == "iges" else _step_unit(data)
    scene = pack(pieces, Source(meters_per_unit=unit, up_axis="Z", format=form), to_metres, notes, _ABRIDGED)
    if not scene.n_meshes:
        raise LoadError(f"{path}: opens, but holds no solid and no surface; export it with its geometry")
    return scene


def _occurrences(
    nodes: list[GlbNode], roots: list[int], meshes: list[GlbMesh]
) -> Iterator[tuple[str, Floats, GlbNode]]:
    """Every node with its path and its matrix to the world, parents first."""
    stack: list[tuple[int, str, Floats, int]] = []

    def enter(numbers: list[int], path: str, matrix: Floats, depth: int) -> None:
        taken: set[str] = set()
        named = [(number, f"{path}/{unique_name(_name(nodes[number], meshes), taken)}") for number in numbers]
        stack.extend((number, at, nodes[number].matrix @ matrix, depth) for number, at in reversed(named))

    enter(roots, "", np.eye(4), 0)
    while stack:
        number, path, matrix, depth = stack.pop()
        yield path, matrix, nodes[number]
        if depth < _MAX_DEPTH:
            enter(list(nodes[number].children), path, matrix, depth + 1)


def _name(node: GlbNode, meshes: list[GlbMesh]) -> str:
    # "=>[0:1:1:2]" is how OpenCASCADE calls an occurrence without a name of its own: the part's name says more.
    name = "" if node.name.startswith("=>[") else node.name
    if not name and node.mesh is not None:
        name = meshes[node.mesh].name
    return re.sub(r"[^\w.-]+", "_", name).strip("_.") or "part"


def _bodies(mesh: GlbMesh) -> list[_Body]:
    # Converters repeat the points along the edges between the faces of a solid, bit by bit the same.
    first, place = weld_points(mesh.points)
    points, faces = mesh.points[first] + np.float32(0), place.astype(np.int32)[mesh.faces]  # -0 becomes 0
    a, b, c = faces.T
    finite = np.asarray(np.isfinite(points).all(axis=1))
    whole = (a != b) & (b != c) & (c != a) & finite[faces].all(axis=1)
    faces, colors = faces[whole], mesh.colors[whole]
    bodies = []
    for triangles in split_bodies(points, faces) if len(faces) else []:
        own, corners = np.unique(faces[triangles], return_inverse=True)
        color = _main_color(points, faces[triangles], colors[triangles])
        bodies.append(_Body(points[own], corners.reshape(-1, 3).astype(np.int32), color))
    return bodies


def _main_color(points: npt.NDArray[np.float32], faces: Faces, colors: Floats) -> Floats | None:
    """The colour with the largest area."""
    known = ~np.isnan(colors).any(axis=1)
    if not known.any():
        return None
    p = points.astype(np.float64)
    a, b, c = (p[faces[known, i]] for i in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    different, which = np.unique(colors[known], axis=0, return_inverse=True)
    main: Floats = different[np.argmax(np.bincount(which.reshape(-1), areas))]
    return main


def _pieces(path: str, matrix: Floats, bodies: list[_Body], notes: Notes) -> Iterator[Piece]:
    if not bodies:
        notes.add("empty-mesh", "left out: it has no triangle", path)
    if len(bodies) > 1:
        notes.add("several-bodies", "the part holds several solids; each is a mesh of its own", path)
    for i, body in enumerate(bodies, start=1):
        own = path if len(bodies) == 1 else f"{path}/body_{i}"
        yield Piece(own, body.points, body.faces, matrix, body.color)


def _step_unit(data: bytes) -> float:
    """Length of one authored unit [m], as far as the text tells; STEP's usual millimetre otherwise (ISO 10303-41)."""
    if re.search(rb"CONVERSION_BASED_UNIT\s*\(\s*'INCH'", data, re.IGNORECASE):
        return 0.0254
    found = re.search(rb"SI_UNIT\s*\(\s*([^,]*?)\s*,\s*\.METRE\.\s*\)", data)
    return _STEP_UNITS.get(found[1], 0.001) if found else 0.001


def _iges_unit(data: bytes) -> float:
    """Length of one authored unit [m], from the global section (IGES 5.3, 2.2.4.3.15); a millimetre if unclear."""
    lines = [line[:72] for line in data.splitlines() if line[72:73] == b"G"]
    found = re.search(rb",\s*\d{1,2}\s*,\s*\d+H\s*(IN|INCH|MM|FT|M|KM|CM|MIL|UM)\s*,", b"".join(lines), re.IGNORECASE)
    return _IGES_UNITS.get(found[1].upper(), 0.001) if found else 0.001
