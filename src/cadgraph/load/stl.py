"""STL to a scene: a binary file is one mesh, each ``solid`` of a text file is one.

Neither unit nor up axis belongs to the format (3D Systems, 1989); a header of a binary file that says ``UNITS=mm`` is
believed. Normals are not used: the order of the corners says which side is outside.

Notes in ``Scene.diagnostics``:

- left out: ``broken-facet``, ``trailing-bytes``, ``empty-mesh``, and those of ``pack``;
- repaired: ``invalid-points``;
- told: ``cut-short``, ``unit-hint``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from cadgraph.errors import LoadError
from cadgraph.load.naming import Names, name_fact, path_step
from cadgraph.load.packing import Notes, Piece, metres_z_up, pack
from cadgraph.load.sandbox.signature import stl_is_binary
from cadgraph.load.text_lines import blocks_of
from cadgraph.load.triangles import MAX_TRIANGLES, clean_triangles
from cadgraph.model.facts import Fact
from cadgraph.model.scene import Floats, Scene, Source

if TYPE_CHECKING:
    from cadgraph.config import LoadConfig

__all__ = ["read"]

_HEADER = 84  # 80 bytes of text and the number of triangles
_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_UNITS = {
    "m": 1.0, "meter": 1.0, "meters": 1.0, "metre": 1.0, "metres": 1.0, "cm": 0.01, "mm": 0.001, "millimeter": 0.001,
    "millimeters": 0.001, "in": 0.0254, "inch": 0.0254, "inches": 0.0254, "ft": 0.3048, "feet": 0.3048,
}  # fmt: skip
_UNIT_WORDS = "(" + "|".join(sorted(_UNITS, key=len, reverse=True)) + ")(?![a-z])"
_STATED = re.compile(r"\bunits?\s*[=:]\s*" + _UNIT_WORDS, re.I)
_HINT = re.compile(r"units?\s*[=:]\s*" + _UNIT_WORDS + r"|units[ _-]?" + _UNIT_WORDS, re.I)
_ABRIDGED = ("broken-facet", "invalid-points")


def read(path: Path, config: LoadConfig) -> Scene:
    """Reads an STL file.

    Args:
        path: of the file.
        config: ``metadata`` says whether the names of solids are kept.

    Returns:
        The scene, in metres where the header states the unit, else in the file's own; ``source`` has no path and no
        hash yet.

    Raises:
        LoadError: it can't be read, or holds no triangle.
    """
    notes, facts = Notes(), list[Fact]()
    unit: float | None = None
    if stl_is_binary(path):
        header, corners = _binary(path, notes)
        stated = _STATED.search(header)
        unit = _UNITS[stated[1].lower()] if stated else None
        solids = [(f"/{path_step(path.stem, 'part')}", corners)]
    else:
        solids = list(_text(path, notes, facts))
    if not sum(len(corners) for _, corners in solids):
        raise LoadError(f"{path}: holds no triangle; export it with its geometry")
    if unit is None:
        _note_hint(path, [at for at, _ in solids], notes)
    pieces = []
    for at, corners in solids:
        points, faces, _ = clean_triangles(
            corners.reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3), at, notes
        )
        if len(faces):
            pieces.append(Piece(at, points, faces, np.eye(4)))
        else:
            notes.add("empty-mesh", "left out: it has no triangle that can be used", at)
    source = Source(
        meters_per_unit=unit or 1.0, up_axis="Z", format="stl", unit_stated=unit is not None, up_stated=False
    )
    kept = facts if config.metadata != "off" else []
    scene = pack(pieces, source, metres_z_up(unit or 1.0, "Z"), notes, _ABRIDGED, kept)
    if not scene.n_meshes:
        raise LoadError(f"{path}: none of its triangles can be used; export it again")
    return scene


def _binary(path: Path, notes: Notes) -> tuple[str, Floats]:
    """The text of the header and ``(n, 3, 3)`` corners."""
    try:
        with path.open("rb") as file:
            head = file.read(_HEADER)
            promised = int.from_bytes(head[80:84], "little")
            if promised > MAX_TRIANGLES:
                raise LoadError(
                    f"{path}: promises {promised:,} triangles, more than the {MAX_TRIANGLES:,} that are read"
                )
            records = np.fromfile(file, _RECORD, promised)
            more = bool(file.read(1))
    except OSError as error:
        raise LoadError(f"{path}: can't be read ({error.strerror}); check its permissions") from None
    if len(records) < promised:
        raise LoadError(
            f"{path}: cut short, {len(records):,} of {promised:,} triangles are there; copy or export it again"
        )
    if more:
        notes.add("trailing-bytes", "what follows the last triangle was left out")
    # Contiguous, without the normals between.
    return head[:80].decode("ascii", "replace"), np.ascontiguousarray(records["corners"])


def _text(path: Path, notes: Notes, facts: list[Fact]) -> Iterator[tuple[str, Floats]]:
    """Path and ``(n, 3, 3)`` corners of each solid of a text file."""
    names = [""]  # of what stands before the first solid
    vertices, loops, solids = [np.zeros((0, 3))], [np.zeros(0, np.int64)], [np.zeros(0, np.int64)]
    n_loops = n_ends = 0
    for lines in blocks_of(path):
        of_vertex, of_loop, of_solid = (lines.beginning(word) for word in ("vertex", "outer", "solid"))
        vertices.append(lines.rows(of_vertex, 3))
        loops.append(n_loops + np.searchsorted(of_loop, of_vertex))
        solids.append(len(names) - 1 + np.searchsorted(of_solid, of_vertex))
        names += [lines.text(line)[len("solid") :].strip() for line in of_solid.tolist()]
        n_loops += len(of_loop)
        n_ends += len(lines.beginning("endsolid"))
    if n_ends < len(names) - 1:
        notes.add("cut-short", "a solid does not end: the file is likely cut short; compare it with its source")
    points, loop, solid = np.concatenate(vertices), np.concatenate(loops), np.concatenate(solids)
    # What stands before the first loop belongs to no facet.
    whole = np.bincount(loop, minlength=n_loops + 1) == 3
    whole[0] = False
    sound = whole[loop]
    if not sound.all():
        notes.add("broken-facet", "facets without exactly three corners were dropped")
        points, solid = points[sound], solid[sound]
    corners, owner = points.reshape(-1, 3, 3), solid[::3]
    ends = np.searchsorted(owner, np.arange(len(names) + 1))
    taken = Names()
    for i, name in enumerate(names):
        if ends[i] == ends[i + 1]:
            if i:
                notes.add("empty-mesh", "left out: it has no triangle that can be used", f"/{path_step(name, 'solid')}")
            continue
        at = taken.take(f"/{path_step(name, path_step(path.stem, 'part'))}")
        facts += name_fact(at, name, "solid")
        yield at, corners[ends[i] : ends[i + 1]]


def _note_hint(path: Path, names: list[str], notes: Notes) -> None:
    """Notes a unit that only a name tells: people rename files, and converters keep names of what they converted."""
    for text in (path.name, *names):
        found = _HINT.search(text)
        if found:
            notes.add(
                "unit-hint",
                f"{text[:80]!r} speaks of {(found[1] or found[2]).lower()}; set load.unit if that is its unit",
            )
            return
