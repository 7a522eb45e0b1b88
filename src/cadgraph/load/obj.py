"""Wavefront OBJ to a scene: each object (``o``) and each group (``g``) of it that has faces is a mesh.

Materials don't split: exporters change them within a part. Only a file without any object and group is split by them.
Neither unit nor up axis is stated in such a file. Format: Wavefront, Advanced Visualizer manual, appendix B1.

Notes in ``Scene.diagnostics``:

- left out: ``no-surface`` (points and lines), ``unsupported-geometry`` (free-form curves and surfaces), and those of
  ``pack``;
- repaired: ``invalid-points``, ``invalid-indices``, ``invalid-face-counts``, ``self-intersecting-faces``;
- guessed: ``split-by-material``, ``material-library``;
- told: ``cut-short``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from cadgraph.errors import LoadError
from cadgraph.load.beside import file_beside
from cadgraph.load.naming import Names, clipped, name_fact, path_step
from cadgraph.load.packing import Notes, Piece, pack
from cadgraph.load.polygons import triangulate
from cadgraph.load.text_lines import Lines, blocks_of
from cadgraph.load.triangles import clean_triangles, main_color
from cadgraph.model.facts import Fact
from cadgraph.model.scene import Floats, Ints, Scene, Source

if TYPE_CHECKING:
    from cadgraph.config import LoadConfig

__all__ = ["read"]

_MOST_CORNERS = 10_000  # of one face; ours: cutting ears takes the square of it
_MOST_LIBRARIES = 100  # ours
_LIBRARY_BYTES = 1 << 24  # ours; a material takes about 200
_LONGEST_END = 4096  # bytes that a last line without its end is looked for in
_FREE_FORM = {"curv", "curv2", "surf", "vp", "cstype"}
_ABRIDGED = ("invalid-points", "invalid-indices", "invalid-face-counts", "self-intersecting-faces")


@dataclass
class _Block:
    """Faces between two statements that name an object, a group or a material.

    Args:
        name: of object and group.
        material: its number, 0 where none is set.
        low: the lowest number of a point that its faces use.
        known: how many points there were at its last face.
    """

    name: tuple[str, str]
    material: int
    low: int = 0
    known: int = 0


@dataclass
class _Text:
    """What a file says, in its order.

    Args:
        points: ``(n, 3)`` of each block of lines.
        counts: corners of the faces of each block of lines.
        corners: point numbers.
        owner: for each face the number of its block.
        blocks: all blocks.
        materials: names, the first for none.
        libraries: names of the files with materials.
    """

    points: list[Floats] = field(default_factory=list)
    counts: list[Ints] = field(default_factory=list)
    corners: list[Ints] = field(default_factory=list)
    owner: list[Ints] = field(default_factory=list)
    blocks: list[_Block] = field(default_factory=lambda: [_Block(("", ""), 0)])
    materials: dict[str, int] = field(default_factory=lambda: {"": 0})
    libraries: dict[str, None] = field(default_factory=dict)
    n_points: int = 0


def read(path: Path, config: LoadConfig) -> Scene:
    """Reads an OBJ file.

    Args:
        path: of the file; material libraries beside it are read too, from its own folder only.
        config: ``metadata`` says whether the names of materials are kept.

    Returns:
        The scene in the file's own unit and axes; ``source`` has no path and no hash yet.

    Raises:
        LoadError: it can't be read, or holds no face.
    """
    notes, text = Notes(), _Text()
    for lines in blocks_of(path):
        _take(lines, text, notes)
    points = np.concatenate([*text.points, np.zeros((0, 3))])
    counts, corners, owner = (
        np.concatenate([*found, np.zeros(0, np.int64)]) for found in (text.counts, text.corners, text.owner)
    )
    if not len(counts):
        kind = "a point cloud; model its surfaces first" if len(points) else "no face; export it with its geometry"
        raise LoadError(f"{path}: holds {kind}")
    if _ends_early(path):
        notes.add(
            "cut-short", "the file ends within a line: it is likely cut short; compare its size with that of its source"
        )
    facts: list[Fact] = []
    triangles, owner = _triangles(points, counts, corners, owner, notes)
    pieces = list(_pieces(path, points, triangles, owner, text, facts, notes))
    source = Source(meters_per_unit=1.0, up_axis="Z", format="obj", unit_stated=False, up_stated=False)
    kept = facts if config.metadata != "off" else []
    scene = pack(pieces, source, np.eye(4), notes, _ABRIDGED, kept)
    if not scene.n_meshes:
        why = "; ".join(note.message for note in scene.diagnostics)
        raise LoadError(f"{path}: none of its {len(counts):,} faces can be used ({why}); export it again")
    return scene


def _ends_early(path: Path) -> bool:
    """Whether the last line has no end, and is a face or a point that lacks a part."""
    with path.open("rb") as file:
        size = file.seek(0, 2)
        file.seek(max(0, size - _LONGEST_END))
        line = file.read().splitlines(keepends=True)[-1:]
    words = line[0].split() if line and not line[0].endswith((b"\n", b"\r")) else []
    return len(words) < 4 and words[:1] in ([b"f"], [b"v"])


def _take(lines: Lines, text: _Text, notes: Notes) -> None:
    """Adds a block of lines."""
    vertices, faces = lines.beginning("v"), lines.beginning("f")
    text.points.append(lines.rows(vertices, 3))
    statements, opened = [], []
    for line in lines.filled(besides=("v", "f", "vn", "vt", "s", "#")).tolist():
        if _obey(lines.text(line), text, notes):
            statements.append(line)
            opened.append(len(text.blocks) - 1)
    before = opened[0] - 1 if opened else len(text.blocks) - 1
    owner = np.array([before, *opened], np.int64)[np.searchsorted(np.array(statements, np.int64), faces)]
    counts, corners = lines.integers(faces)
    # Numbers count from 1, and negative ones back from the last point so far.
    known = text.n_points + np.searchsorted(vertices, faces)
    beyond = 2**62
    corners = np.where(corners > 0, corners - 1, np.where(corners < 0, np.repeat(known, counts) + corners, beyond))
    text.counts.append(counts)
    text.corners.append(corners)
    text.owner.append(owner)
    _extend(text.blocks, owner, known, counts, corners)
    text.n_points += len(vertices)


def _extend(blocks: list[_Block], owner: Ints, known: Ints, counts: Ints, corners: Ints) -> None:
    """Notes which points the faces of each block use and know; faces come in the order of their blocks."""
    full = counts > 0
    if not full.any():
        return
    owner, known = owner[full], known[full]
    low = np.minimum.reduceat(corners, (np.cumsum(counts) - counts)[full])
    first = np.flatnonzero(np.diff(owner, prepend=-1))
    last = np.append(first[1:], len(owner)) - 1
    for number, least, most in zip(
        owner[first].tolist(), np.minimum.reduceat(low, first).tolist(), known[last].tolist(), strict=True
    ):
        block = blocks[number]
        block.low = min(block.low, least) if block.known else least
        block.known = most


def _obey(line: str, text: _Text, notes: Notes) -> bool:
    """Follows a statement; True where a new block begins with it."""
    word, _, rest = line.partition(" ") if "\t" not in line else line.replace("\t", " ").partition(" ")
    word, rest = word.lower(), rest.strip()
    now = text.blocks[-1]
    if word == "o":
        text.blocks.append(_Block((rest, ""), now.material))
    elif word == "g":
        text.blocks.append(_Block((now.name[0], rest), now.material))
    elif word == "usemtl":
        text.blocks.append(_Block(now.name, text.materials.setdefault(rest, len(text.materials))))
    elif word == "mtllib" and len(text.libraries) < _MOST_LIBRARIES:
        text.libraries[rest] = None
    elif word in ("l", "p"):
        notes.add("no-surface", "points and lines were left out: they have no surface")
    elif word in _FREE_FORM:
        notes.add("unsupported-geometry", "free-form curves and surfaces were left out; export triangles")
    return word in ("o", "g", "usemtl")


def _triangles(
    points: Floats, counts: Ints, corners: Ints, owner: Ints, notes: Notes
) -> tuple[npt.NDArray[np.integer], Ints]:
    """``(n, 3)`` corners and ``(n,)`` block of each triangle, from faces of any number of corners."""
    usable = (counts >= 3) & (counts <= _MOST_CORNERS)
    if not usable.all():
        notes.add("invalid-face-counts", f"faces with fewer than 3 or over {_MOST_CORNERS:,} corners were dropped")
    of_corner = np.repeat(np.arange(len(counts)), counts)
    wrong = (corners < 0) | (corners >= len(points))
    if wrong.any():
        notes.add("invalid-indices", "faces that use points which don't exist were dropped")
        usable[of_corner[wrong]] = False
    spoiled = np.flatnonzero(~np.isfinite(points).all(axis=1)) if len(points) else np.zeros(0, np.int64)
    if len(spoiled):
        notes.add("invalid-points", "points without three finite coordinates, and faces that use them, were dropped")
        usable[of_corner[np.isin(corners, spoiled)]] = False
    if not usable.all():
        corners, counts, owner = corners[np.repeat(usable, counts)], counts[usable], owner[usable]
    with np.errstate(over="ignore", invalid="ignore"):
        cut = triangulate(points, counts, np.cumsum(counts) - counts, corners, np.arange(len(counts)))
    if len(cut.twisted):
        notes.add(
            "self-intersecting-faces", f"faces that cross themselves were cut as well as can be ({len(cut.twisted)})"
        )
    return cut.corners, owner[cut.polygon]


def _meshes(path: Path, text: _Text, used: Ints, notes: Notes) -> list[tuple[str, str]]:
    """For each block path and name of its mesh.

    Blocks of one name are one mesh, unless one uses only points that came after the other was complete: then they are
    two of one name.
    """
    by_material = len(used) > 0 and all(text.blocks[number].name == ("", "") for number in used.tolist())
    names = list(text.materials)
    if by_material and len({text.blocks[number].material for number in used.tolist()}) > 1:
        notes.add("split-by-material", "the file names neither objects nor groups: each material is a mesh")
    else:
        by_material = False
    taken = Names()
    latest: dict[tuple[str, ...], tuple[str, int]] = {}
    found = [("", "")] * len(text.blocks)
    for number in used.tolist():
        block = text.blocks[number]
        key = (names[block.material],) if by_material else block.name
        at, known = latest.get(key, ("", -1))
        if known < 0 or (block.low >= known and not by_material):
            steps = [path_step(name, "") for name in key]
            own = "/".join(dict.fromkeys(step for step in steps if step)) or path_step(path.stem, "part")
            at = taken.take(f"/{own}")
        latest[key] = at, max(known, block.known)
        found[number] = at, next((name for name in reversed(key) if name), "")
    return found


def _pieces(
    path: Path,
    points: Floats,
    triangles: npt.NDArray[np.integer],
    owner: Ints,
    text: _Text,
    facts: list[Fact],
    notes: Notes,
) -> Iterator[Piece]:
    """The meshes, in the order of their first faces; what their names and materials tell goes to ``facts``."""
    meshes = _meshes(path, text, np.flatnonzero(np.bincount(owner)), notes)
    names = dict.fromkeys(at for at, _ in meshes if at)
    numbers = {at: i for i, at in enumerate(names)}
    mesh_of_block = np.array([numbers.get(at, -1) for at, _ in meshes], np.int64)
    material_of_block = np.array([block.material for block in text.blocks], np.int64)
    palette = _palette(path, text, notes)
    title = {at: name for at, name in meshes if at}
    mesh = mesh_of_block[owner]
    order = np.argsort(mesh, kind="stable")
    ends = np.searchsorted(mesh[order], np.arange(len(numbers) + 1))
    material_names = list(text.materials)
    for i, at in enumerate(names):
        own = order[ends[i] : ends[i + 1]]
        kept_points, faces, kept = clean_triangles(points, triangles[own], at, notes)
        if not len(faces):
            notes.add("degenerate-mesh", "left out: all its faces have zero area", at)
            continue
        materials = material_of_block[owner[own[kept]]]
        facts += name_fact(at, title[at], "o or g")
        facts += [
            Fact(at, "layer", clipped(material_names[number]), "usemtl")
            for number in np.unique(materials).tolist()
            if material_names[number]
        ]
        yield Piece(at, kept_points, faces, np.eye(4), main_color(kept_points, faces, palette, materials))


def _palette(path: Path, text: _Text, notes: Notes) -> Floats:
    """``(n_materials, 3)`` colours from the libraries, NaN where there is none."""
    palette = np.full((len(text.materials), 3), np.nan)
    for library in text.libraries:
        for found in _libraries(path, library, notes):
            name = ""
            for line in found.read_bytes()[:_LIBRARY_BYTES].decode("utf-8", "replace").splitlines():
                word, *rest = line.split(maxsplit=1)[:2] or [""]
                if word == "newmtl":
                    name = rest[0].strip() if rest else ""
                elif word == "Kd" and rest and name in text.materials:
                    _set_color(palette[text.materials[name]], rest[0])
    return palette


def _set_color(color: Floats, text: str) -> None:
    try:
        values = np.array([float(word) for word in text.split()[:3]])
    except ValueError:
        return
    if values.shape == (3,) and np.isfinite(values).all():
        color[:] = values


def _libraries(path: Path, name: str, notes: Notes) -> list[Path]:
    """The files of one statement: one, whose name may hold blanks, or several."""
    reason = ""
    for names in ([name], name.split()):
        try:
            return [file_beside(path, one) for one in names]
        except LoadError as error:
            reason = reason or str(error).removeprefix(f"{path}: ")
    notes.add("material-library", f"colours are missing: the file {reason}")
    return []
