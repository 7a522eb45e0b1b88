"""STEP and IGES to a scene, through OpenCASCADE (``cascadio``).

Paths are the names along the assembly tree (``/Skid/Valve_1/Body``): every occurrence of a part is a mesh, and so is
every solid of a part that holds several (``/Skid/Valve/body_1``, ``body_2``).

Notes in ``Scene.diagnostics``: ``damaged-source``, ``several-bodies``, ``empty-mesh``, ``degenerate-mesh``,
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
from cadgraph.load.bodies import split_bodies
from cadgraph.load.budget import Budget
from cadgraph.load.gltf import node_matrix
from cadgraph.load.gltf_file import BROKEN, Gltf, parse_glb
from cadgraph.load.gltf_mesh import GltfMesh, read_mesh
from cadgraph.load.gltf_nodes import root_nodes
from cadgraph.load.naming import Names, path_step
from cadgraph.load.packing import Notes, Piece, pack
from cadgraph.load.step_census import occurrences
from cadgraph.load.step_damage import Counts, damage_of, hear, named_in
from cadgraph.load.triangles import main_color
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
    points: npt.NDArray[np.floating]
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
    budget = Budget(path, config, len(data))
    if form == "step":
        budget.check_meshes(occurrences(data))
    # The library works in millimetres whatever the file's unit, and so does its tolerance.
    # A primitive for each face, so that faces can be counted; ``read_mesh`` joins them again.
    with hear() as complaints:
        glb = cascadio.load(
            data,
            file_type=form,
            tol_linear=config.max_gap * 1000,
            tol_angular=config.max_angle,
            tol_relative=False,
            merge_primitives=False,
        )
    if not glb:
        first = f": {complaints.lines[0]}" if complaints.lines else ""
        raise LoadError(f"{path}: not readable as {form.upper()} (damaged or cut short{first}); export it again")
    notes = Notes()
    bodies: dict[int, list[_Body]] = {}
    pieces: list[Piece] = []
    try:
        gltf = parse_glb(glb)
        for at, matrix, number in _occurrences(gltf):
            if number not in bodies:
                bodies[number] = _bodies(read_mesh(gltf, number, at, notes))
            pieces.extend(_pieces(at, matrix, bodies[number], notes))
        came = Counts(len(root_nodes(gltf)), sum(map(len, bodies.values())), _count_faces(gltf))
    except BROKEN as error:
        raise LoadError(f"{path}: the CAD library returned no usable triangles ({error})") from error
    # Of IGES the library (cascadio 0.1) leaves the lengths in millimetres.
    to_metres = np.diag([0.001, 0.001, 0.001, 1]) if form == "iges" else np.eye(4)
    unit = _iges_unit(data) if form == "iges" else _step_unit(data)
    damage = damage_of(form.upper(), named_in(data) if form == "step" else None, came, complaints)
    if damage is not None:
        notes.add(damage.code, damage.message)
    scene = pack(pieces, Source(meters_per_unit=unit, up_axis="Z", format=form), to_metres, notes, _ABRIDGED)
    if not scene.n_meshes:
        raise LoadError(f"{path}: opens, but holds no solid and no surface; export it with its geometry")
    return scene


def _count_faces(gltf: Gltf) -> int:
    """How many faces came back: one primitive each; what is placed several times counts once, as in the file."""
    return sum(len(mesh.get("primitives", ())) for mesh in gltf.tree.get("meshes", ()))


def _occurrences(gltf: Gltf) -> Iterator[tuple[str, Floats, int]]:
    """Path, matrix to the world and number of the mesh of every node that has one, parents first."""
    stack: list[tuple[int, str, Floats, int]] = []

    def enter(numbers: list[int], path: str, matrix: Floats, depth: int) -> None:
        taken = Names()
        named = [(number, f"{path}/{taken.take(_name(gltf, number))}") for number in numbers]
        stack.extend(
            (number, at, node_matrix(gltf.item("nodes", number)) @ matrix, depth) for number, at in reversed(named)
        )

    enter(root_nodes(gltf), "", np.eye(4), 0)
    while stack:
        number, path, matrix, depth = stack.pop()
        node = gltf.item("nodes", number)
        if node.get("mesh") is not None:
            yield path, matrix, node["mesh"]
        if depth < _MAX_DEPTH:
            enter(list(node.get("children", ())), path, matrix, depth + 1)


def _name(gltf: Gltf, number: int) -> str:
    # "=>[0:1:1:2]" is how OpenCASCADE calls an occurrence without a name of its own: the part's name says more.
    node = gltf.item("nodes", number)
    name = node.get("name", "")
    if (not name or name.startswith("=>[")) and node.get("mesh") is not None:
        name = gltf.item("meshes", node["mesh"]).get("name", "")
    return path_step("" if name.startswith("=>[") else name, "part")


def _bodies(mesh: GltfMesh) -> list[_Body]:
    bodies = []
    for triangles in split_bodies(mesh.points, mesh.faces) if len(mesh.faces) else []:
        own, corners = np.unique(mesh.faces[triangles], return_inverse=True)
        color = main_color(mesh.points, mesh.faces[triangles], mesh.palette, mesh.color_of_face[triangles])
        bodies.append(_Body(mesh.points[own], corners.reshape(-1, 3).astype(np.int32), color))
    return bodies


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
