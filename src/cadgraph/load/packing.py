"""Placed pieces of geometry to a scene, and notes about them to diagnostics."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from cadgraph._io.text import natural_key
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.facts import Fact, StatedLink
from cadgraph.model.scene import Faces, Floats, Ints, Scene, Source

__all__ = ["Z_UP_FROM", "Notes", "Piece", "metres_z_up", "pack", "pack_placed", "unique_name"]

Z_UP_FROM = {
    "X": np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]], float),
    "Y": np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]], float),
    "Z": np.eye(3),
}
"""Cyclic swaps, for row vectors: what pointed along the up axis points along Z, and no handedness changes."""

_FAR = 10_000.0  # [m] beyond this a scene gets an origin of its own; ours: float32 renders still resolve 1 mm
_ORIGIN_STEP = 100.0  # [m] origins are whole multiples, so that they are exact and stable under small edits
_TOO_FAR = 1e9  # [m] ours: there float64 still resolves a micrometre; the Moon is at 4e8
_SIZES = (1e-3, 1e5)  # [m] ours: no plant is smaller than a millimetre or larger than 100 km
_EXAMPLES = 20  # so many paths stand for the rest in a note on meshes that were loaded


@dataclass(frozen=True)
class Piece:
    """One mesh, not yet placed.

    Args:
        path: in the source.
        points: ``(n, 3)`` in the units of the source.
        faces: ``(m, 3)`` int32 triangles, counter-clockwise seen from outside; all corners finite and in range.
        matrix: ``(4, 4)`` for row vectors: ``[x y z 1] @ matrix`` is in world coordinates of the source.
        color: ``(3,)`` linear RGB, or None.
        anchor: path that carries opinions on it; none: ``path``.
    """

    path: str
    points: npt.NDArray[np.floating]
    faces: Faces
    matrix: Floats
    color: npt.NDArray[np.floating] | None = None
    anchor: str | None = None


@dataclass
class Notes:
    """Diagnostics in the making: the same thing said of many meshes becomes one."""

    _paths: dict[tuple[str, str], list[str]] = field(default_factory=dict)

    def add(self, code: str, message: str, path: str | None = None) -> None:
        """Notes one thing, maybe about one mesh."""
        paths = self._paths.setdefault((code, message), [])
        if path is not None:
            paths.append(path)

    def count(self, code: str) -> int:
        """How many paths are noted under a code."""
        return sum(max(1, len(paths)) for (known, _), paths in self._paths.items() if known == code)

    def paths(self, code: str) -> set[str]:
        """All paths noted under a code."""
        return {path for (known, _), paths in self._paths.items() if known == code for path in paths}

    def messages(self, code: str) -> list[str]:
        """All messages under a code, in order."""
        return sorted(message for known, message in self._paths if known == code)

    def diagnostics(self, abridged: Iterable[str] = ()) -> tuple[Diagnostic, ...]:
        """All notes, sorted; of those with an ``abridged`` code only the first twenty paths."""
        short = set(abridged)
        notes = []
        for (code, message), paths in sorted(self._paths.items()):
            ordered = sorted(set(paths), key=natural_key)
            if code in short and len(ordered) > _EXAMPLES:
                message, ordered = f"{message} ({len(ordered)} in all)", ordered[:_EXAMPLES]
            notes.append(Diagnostic(code, message, tuple(ordered)))
        return tuple(notes)


def metres_z_up(meters_per_unit: float, up_axis: str) -> Floats:
    """The ``(4, 4)`` matrix for row vectors from a source's world to metres and Z up.

    Args:
        meters_per_unit: length of one of its units [m].
        up_axis: ``"X"``, ``"Y"`` or ``"Z"``.
    """
    matrix = np.eye(4)
    matrix[:3, :3] = Z_UP_FROM[up_axis] * meters_per_unit
    return matrix


def unique_name(name: str, taken: set[str]) -> str:
    """The name, or the first of ``name_1``, ``name_2``... that isn't taken; it is taken afterwards."""
    candidate, i = name, 0
    while candidate in taken:
        i += 1
        candidate = f"{name}_{i}"
    taken.add(candidate)
    return candidate


def pack(
    pieces: Sequence[Piece],
    source: Source,
    world_from_source: Floats,
    notes: Notes,
    abridged: Iterable[str] = (),
    facts: Iterable[Fact] = (),
    links: Iterable[StatedLink] = (),
) -> Scene:
    """Places all pieces, in metres and Z up, and joins them into one scene.

    Mirrored pieces get their triangles turned, so that these still face outward. A piece without area is left out
    (``degenerate-mesh``), and so is one with a placement that isn't finite (``invalid-transform``) or that reaches
    farther than a million kilometres from the origin (``too-far``). A scene smaller than a millimetre or larger than
    100 km is reported (``unusual-size``).

    Args:
        pieces: in any order.
        source: for the scene.
        world_from_source: ``(4, 4)`` for row vectors, from the source's world to metres and Z up.
        notes: gets what was left out.
        abridged: codes of notes whose paths are cut short.
        facts: what the source says of its parts.
        links: what it says is joined to what.

    Returns:
        The scene, sorted by path.
    """
    ordered = sorted(pieces, key=lambda piece: natural_key(piece.path))
    with np.errstate(over="ignore", invalid="ignore"):
        matrices = np.array([piece.matrix for piece in ordered]).reshape(-1, 4, 4) @ world_from_source
        origin = _origin(ordered, matrices)
        kept, vertices = _placed(ordered, matrices, origin, notes)
        mirrored = np.linalg.det(matrices[kept, :3, :3]) < 0
    ordered = [ordered[i] for i in kept]
    _note_size(vertices, source, notes)
    faces = [p.faces[:, ::-1] if turned else p.faces for p, turned in zip(ordered, mirrored.tolist(), strict=True)]
    taken: set[str] = set()
    paths = tuple(unique_name(piece.path, taken) for piece in ordered)
    anchors = tuple(piece.anchor or path for piece, path in zip(ordered, paths, strict=True))
    colors = [_NO_COLOR if piece.color is None else piece.color for piece in ordered]
    return Scene(
        vertices=vertices,
        faces=np.concatenate(faces, dtype=np.int32) if faces else np.zeros((0, 3), np.int32),
        vertex_offsets=np.cumsum([0, *(len(piece.points) for piece in ordered)], dtype=np.int64),
        face_offsets=np.cumsum([0, *map(len, faces)], dtype=np.int64),
        paths=paths,
        colors=np.clip(np.array(colors, np.float64).reshape(-1, 3), 0, 1).astype(np.float32),
        source=source,
        origin=origin,
        anchors=anchors if anchors != paths else (),
        diagnostics=notes.diagnostics(abridged),
        facts=tuple(facts),
        links=tuple(links),
    )


_NO_COLOR = np.full(3, np.nan)


def pack_placed(
    shapes: Sequence[tuple[npt.NDArray[np.floating], Faces]],
    shape_of_mesh: Ints,
    matrices: Floats,
    paths: Sequence[str],
    colors: npt.NDArray[np.floating],
    source: Source,
    world_from_source: Floats,
    notes: Notes,
    abridged: Iterable[str] = (),
    facts: Iterable[Fact] = (),
    links: Iterable[StatedLink] = (),
) -> Scene:
    """Like ``pack``, of shapes that are placed many times each.

    Args:
        shapes: points ``(n, 3)`` and triangles ``(m, 3)`` int32 of each distinct shape, as those of a ``Piece``.
        shape_of_mesh: ``(n_meshes,)``.
        matrices: ``(n_meshes, 4, 4)`` for row vectors, from the shape to the source's world.
        paths: ``(n_meshes,)``.
        colors: ``(n_meshes, 3)`` linear RGB, NaN where there is none.
        source: for the scene.
        world_from_source: ``(4, 4)`` for row vectors, from the source's world to metres and Z up.
        notes: gets what was left out.
        abridged: codes of notes whose paths are cut short.
        facts: what the source says of its parts.
        links: what it says is joined to what.

    Returns:
        The scene, sorted by path.
    """
    pieces = [
        Piece(path, shapes[shape][0], shapes[shape][1], matrix, None if np.isnan(color).any() else color)
        for path, shape, matrix, color in zip(paths, shape_of_mesh.tolist(), matrices, colors, strict=True)
    ]
    return pack(pieces, source, world_from_source, notes, abridged, facts, links)


def _placed(pieces: Sequence[Piece], matrices: Floats, origin: Floats, notes: Notes) -> tuple[list[int], Floats]:
    """The numbers of the pieces that can be placed, and the vertices of these in world coordinates."""
    ends = np.cumsum([0, *(len(piece.points) for piece in pieces)])
    vertices = np.empty((int(ends[-1]), 3))
    slots = [vertices[first:end] for first, end in zip(ends[:-1].tolist(), ends[1:].tolist(), strict=True)]
    turns, shifts = matrices[:, :3, :3], matrices[:, 3, :3] - origin
    for piece, turn, shift, slot in zip(pieces, turns, shifts, slots, strict=True):
        np.matmul(piece.points.astype(np.float64, copy=False), turn, out=slot)
        slot += shift
    finite = np.asarray(np.isfinite(matrices).all(axis=(1, 2)))
    near = np.ones(len(pieces), bool)
    # Written so that NaN fails it too.
    limit = _TOO_FAR - float(np.abs(origin).max())
    if len(vertices) and not (vertices.max() <= limit and vertices.min() >= -limit):
        finite &= np.array([np.isfinite(slot.sum()) for slot in slots], bool)
        near = np.array([slot.max() <= limit and slot.min() >= -limit for slot in slots], bool)
    # The first face nearly always settles it, without a look at all the others.
    corners = ends[:-1, None] + np.array([piece.faces[0] for piece in pieces], np.int64).reshape(-1, 3)
    solid = _have_area(vertices, corners)
    kept, where = [], []
    for i, (piece, slot) in enumerate(zip(pieces, slots, strict=True)):
        if not finite[i]:
            notes.add("invalid-transform", "left out: its placement is not finite", piece.path)
        elif not near[i]:
            message = "left out: it reaches farther than a million kilometres; check its points and the file's units"
            notes.add("too-far", message, piece.path)
        elif not (solid[i] or _have_area(slot, piece.faces).any()):
            notes.add("degenerate-mesh", "left out: all its faces have zero area", piece.path)
        else:
            kept.append(i)
            where.append(slot)
    if len(kept) < len(pieces):
        vertices = np.concatenate(where) if where else np.zeros((0, 3))
    return kept, vertices


def _note_size(vertices: Floats, source: Source, notes: Notes) -> None:
    if not len(vertices):
        return
    size = float((vertices.max(axis=0) - vertices.min(axis=0)).max())
    if not _SIZES[0] <= size <= _SIZES[1]:
        unit = f"check its units (one is taken as {source.meters_per_unit:g} m)"
        notes.add("unusual-size", f"the scene is {size:.3g} m across, which no plant is; {unit}")


def _have_area(points: Floats, faces: Faces | Ints) -> npt.NDArray[np.bool_]:
    """Whether each face has any area at all."""
    a, b, c = points[faces[:, 0]], points[faces[:, 1]], points[faces[:, 2]]
    (ux, uy, uz), (vx, vy, vz) = (b - a).T, (c - a).T
    area: npt.NDArray[np.bool_] = (uy * vz != uz * vy) | (uz * vx != ux * vz) | (ux * vy != uy * vx)
    return area


def _origin(pieces: Sequence[Piece], matrices: Floats) -> Floats:
    """A whole multiple of 100 m amid the pieces where these lie far out, else zero."""
    if not pieces:
        return np.zeros(3)
    corners = np.array([piece.points[piece.faces[0, 0]] for piece in pieces], np.float64)
    first = np.einsum("ij,ijk->ik", corners, matrices[:, :3, :3]) + matrices[:, 3, :3]
    first = first[(np.abs(first) <= _TOO_FAR).all(axis=1)]
    if not len(first):
        return np.zeros(3)
    # The median: one stray mesh must not drag the origin away from all others.
    middle = np.median(first, axis=0)
    if np.linalg.norm(middle) <= _FAR:
        return np.zeros(3)
    # + 0.0: minus zero becomes zero.
    origin: Floats = np.round(middle / _ORIGIN_STEP) * _ORIGIN_STEP + 0.0
    return origin
