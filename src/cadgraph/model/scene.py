"""A loaded scene: meshes, each with its path, placed in one world."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph._io.text import natural_order
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.facts import Fact, StatedLink

__all__ = [
    "Diagnostic",
    "Fact",
    "Floats",
    "Ints",
    "MeshArrays",
    "Placement",
    "Scene",
    "Source",
    "StatedLink",
    "blocks",
    "mesh_of_face",
    "mesh_of_vertex",
    "ranges",
    "turned_boxes",
]

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]

Faces = npt.NDArray[np.int32]


@dataclass(frozen=True)
class Source:
    """Where a scene came from, as recorded in the graph.

    Args:
        path: as the user gave it.
        sha256: of the file's bytes (of the root file, where one file refers to others).
        meters_per_unit: length of one authored unit [m].
        up_axis: ``"X"``, ``"Y"`` or ``"Z"``, as authored.
        format: short name of the loader that read it (``"usd"``, ``"step"``).
        unit_stated: whether the file itself names its unit; where not, it is found by what the parts measure.
        up_stated: likewise of the up axis.
        metadata: what else the file says of itself as a whole (project, author's program, georeference), by name.
        referred: the other files that its geometry comes from: path from the folder of the file, SHA-256.
        read_with: the settings that it was read with, as far as they decide what is read, as JSON; empty where no
            file was read.
    """

    path: str = ""
    sha256: str = ""
    meters_per_unit: float = 1.0
    up_axis: str = "Z"
    format: str = ""
    unit_stated: bool = True
    up_stated: bool = True
    metadata: tuple[tuple[str, str], ...] = ()
    referred: tuple[tuple[str, str], ...] = ()
    read_with: str = ""


@dataclass(frozen=True, eq=False)
class MeshArrays:
    """Meshes as flat arrays, each once.

    Args:
        vertices: ``(n_vertices, 3)`` float64 [m].
        faces: ``(n_faces, 3)`` int32 triangles, counter-clockwise seen from outside; indices local to the mesh.
        vertex_offsets: ``(n + 1,)`` int64; mesh ``i`` owns the vertices from ``vertex_offsets[i]`` up to
            ``vertex_offsets[i + 1]``.
        face_offsets: ``(n + 1,)`` int64, likewise for faces.
    """

    vertices: Floats
    faces: Faces
    vertex_offsets: Ints
    face_offsets: Ints

    @classmethod
    def of(cls, meshes: Sequence[tuple[npt.ArrayLike, npt.ArrayLike]]) -> MeshArrays:
        """Pairs of vertices ``(n, 3)`` and triangles ``(m, 3)`` as arrays; copies."""
        vertices = [np.asarray(v, np.float64).reshape(-1, 3) for v, _ in meshes]
        faces = [np.asarray(f, np.int32).reshape(-1, 3) for _, f in meshes]
        return cls(
            np.concatenate(vertices) if meshes else np.zeros((0, 3)),
            np.concatenate(faces) if meshes else np.zeros((0, 3), np.int32),
            _offsets([len(v) for v in vertices]),
            _offsets([len(f) for f in faces]),
        )

    @property
    def n(self) -> int:
        """How many meshes there are."""
        return len(self.vertex_offsets) - 1

    def mesh(self, index: int) -> tuple[Floats, Faces]:
        """The vertices ``(n, 3)`` [m] and faces ``(m, 3)`` of one mesh, as views."""
        v0, v1 = self.vertex_offsets[index : index + 2]
        f0, f1 = self.face_offsets[index : index + 2]
        return self.vertices[v0:v1], self.faces[f0:f1]

    def select(self, order: Ints) -> MeshArrays:
        """Some of the meshes, in the order given."""
        n_vertices, n_faces = np.diff(self.vertex_offsets)[order], np.diff(self.face_offsets)[order]
        return MeshArrays(
            self.vertices[ranges(self.vertex_offsets[order], n_vertices)],
            self.faces[ranges(self.face_offsets[order], n_faces)],
            _offsets(n_vertices),
            _offsets(n_faces),
        )


@dataclass(frozen=True, eq=False)
class Placement:
    """Where each mesh of a scene lies, where meshes share shapes: ``vertices of the shape @ turn + shift``.

    Args:
        shape: ``(n_meshes,)`` int64 row of the shape.
        turn: ``(n_meshes, 3, 3)`` rotation for row vectors; no scale, no mirror.
        shift: ``(n_meshes, 3)`` [m].
    """

    shape: Ints
    turn: Floats
    shift: Floats

    def select(self, order: Ints) -> Placement:
        """Of some of the meshes, in the order given."""
        return Placement(self.shape[order], self.turn[order], self.shift[order])


@dataclass(frozen=True, eq=False, repr=False)
class Scene:
    """All meshes of a source, in metres, Z up, right-handed, in world coordinates relative to ``origin``.

    A mesh is one placed occurrence of geometry. Meshes that repeat may share a shape: then only the shapes are held,
    and where they lie; ``mesh`` places one on demand, ``vertices`` and ``faces`` all of them at once.

    Args:
        shapes: the geometry: of the meshes themselves, or of the shapes that ``placement`` speaks of.
        paths: ``(n_meshes,)`` unique source paths.
        colors: ``(n_meshes, 3)`` float32 linear RGB in 0..1, NaN where the source gives none.
        source: where it came from.
        origin: ``(3,)`` float64 [m]; add it to get world coordinates. Zero unless the source lies so far out
            (national grids: 2.4e7 m) that float64 would lose the millimetres.
        anchors: ``(n_meshes,)`` the path in the source that can carry an opinion on this mesh: the path itself, or
            the root of the instance that it belongs to. Empty: the paths themselves.
        diagnostics: what the loader skipped, repaired or guessed.
        facts: what the source says of its parts, sorted as its reader found it.
        links: what it says is joined to what.
        placement: where each mesh lies; None where ``shapes`` are the meshes, in place.
    """

    shapes: MeshArrays
    paths: tuple[str, ...]
    colors: npt.NDArray[np.float32]
    source: Source = field(default_factory=Source)
    origin: Floats = field(default_factory=lambda: np.zeros(3))
    anchors: tuple[str, ...] = ()
    diagnostics: tuple[Diagnostic, ...] = ()
    facts: tuple[Fact, ...] = ()
    links: tuple[StatedLink, ...] = ()
    placement: Placement | None = None

    def __post_init__(self) -> None:
        n = len(self.paths)
        held = self.shapes.n if self.placement is None else len(self.placement.shape)
        if held != n or len(self.shapes.face_offsets) != self.shapes.n + 1 or len(self.colors) != n:
            raise ValueError(
                f"a scene of {n} paths needs {n} meshes and {n} colors, got {len(self.shapes.vertex_offsets) - 1} "
                f"ranges of vertices, {len(self.shapes.face_offsets) - 1} of faces, {held} meshes and "
                f"{len(self.colors)} colors"
            )
        if len(set(self.paths)) != n:
            raise ValueError("the paths of a scene must be unique")
        if self.anchors and len(self.anchors) != n:
            raise ValueError(f"a scene of {n} paths needs {n} anchors, got {len(self.anchors)}")

    def __repr__(self) -> str:
        counts = ((self.n_meshes, "mesh", "es"), (self.n_triangles, "triangle", "s"))
        words = [f"{n:,} {noun}{'' if n == 1 else plural}" for n, noun, plural in counts]
        words += [f"{len(self.diagnostics):,} diagnostics"] if self.diagnostics else []
        return f"<Scene of {self.source.path!r}: {', '.join(words)}>"

    @classmethod
    def from_meshes(
        cls,
        meshes: Sequence[tuple[npt.ArrayLike, npt.ArrayLike]],
        paths: Sequence[str] | None = None,
        colors: npt.ArrayLike | None = None,
        source: Source | None = None,
    ) -> Scene:
        """Packs separate meshes into one scene.

        Args:
            meshes: pairs of vertices ``(n, 3)`` [m] and triangles ``(m, 3)``.
            paths: unique names; ``/mesh_0``, ``/mesh_1``... by default.
            colors: ``(n_meshes, 3)`` linear RGB; none by default.
            source: where they came from.

        Returns:
            The scene, holding copies.
        """
        n = len(meshes)
        return cls(
            MeshArrays.of(meshes),
            paths=tuple(paths) if paths is not None else tuple(f"/mesh_{i}" for i in range(n)),
            colors=np.full((n, 3), np.nan, np.float32)
            if colors is None
            else np.array(colors, np.float32).reshape(n, 3),
            source=source or Source(),
        )

    @property
    def n_meshes(self) -> int:
        """How many meshes there are."""
        return len(self.paths)

    @property
    def n_triangles(self) -> int:
        """How many triangles there are in all."""
        return int(self.face_offsets[-1])

    @cached_property
    def vertex_offsets(self) -> Ints:
        """``(n_meshes + 1,)`` int64; mesh ``i`` owns the vertices from its offset up to the next."""
        counts = self.shapes.vertex_offsets
        return counts if self.placement is None else _offsets(np.diff(counts)[self.placement.shape])

    @cached_property
    def face_offsets(self) -> Ints:
        """``(n_meshes + 1,)`` int64, likewise for faces."""
        counts = self.shapes.face_offsets
        return counts if self.placement is None else _offsets(np.diff(counts)[self.placement.shape])

    @cached_property
    def vertices(self) -> Floats:
        """``(n_vertices, 3)`` float64 [m] of all meshes, relative to ``origin``; made on first use where shapes are
        shared, and as large as all meshes together.
        """
        return self.placed_vertices()

    @cached_property
    def faces(self) -> Faces:
        """``(n_faces, 3)`` int32 triangles of all meshes; indices are local to the mesh."""
        return self.placed_faces()

    def placed_vertices(self) -> Floats:
        """``vertices``, which the scene doesn't keep where they have to be made for this."""
        if self.placement is None:
            return self.shapes.vertices
        if "vertices" in self.__dict__:
            return self.vertices
        ends = self.vertex_offsets.tolist()
        vertices = np.empty((ends[-1], 3))
        starts = self.shapes.vertex_offsets.tolist()
        rows = zip(self.placement.shape.tolist(), self.placement.turn, self.placement.shift, strict=True)
        for i, (shape, turn, shift) in enumerate(rows):
            slot = vertices[ends[i] : ends[i + 1]]
            np.matmul(self.shapes.vertices[starts[shape] : starts[shape + 1]], turn, out=slot)
            slot += shift
        return vertices

    def placed_faces(self) -> Faces:
        """``faces``, likewise."""
        if self.placement is None:
            return self.shapes.faces
        if "faces" in self.__dict__:
            return self.faces
        ends, starts = self.face_offsets.tolist(), self.shapes.face_offsets.tolist()
        faces = np.empty((ends[-1], 3), self.shapes.faces.dtype)
        # Mesh by mesh, in the time that an index of each face alone would take.
        for i, shape in enumerate(self.placement.shape.tolist()):
            faces[ends[i] : ends[i + 1]] = self.shapes.faces[starts[shape] : starts[shape + 1]]
        return faces

    def mesh(self, index: int) -> tuple[Floats, Faces]:
        """The vertices ``(n, 3)`` [m] and faces ``(m, 3)`` of one mesh, placed."""
        if self.placement is None:
            return self.shapes.mesh(index)
        if "vertices" in self.__dict__:
            v0, v1 = self.vertex_offsets[index : index + 2]
            return self.vertices[v0:v1], self.shapes.mesh(int(self.placement.shape[index]))[1]
        vertices, faces = self.shapes.mesh(int(self.placement.shape[index]))
        return vertices @ self.placement.turn[index] + self.placement.shift[index], faces

    def global_faces(self) -> Ints:
        """``(n_faces, 3)`` int64 indices into ``vertices``."""
        first_vertex = np.repeat(self.vertex_offsets[:-1], np.diff(self.face_offsets))
        return self.faces.astype(np.int64) + first_vertex[:, None]

    def short_global_faces(self) -> Faces:
        """Likewise as int32, in half the memory, for scenes of less than two thousand million vertices.

        Where shapes are shared, ``faces`` is not made for it.
        """
        faces = self.placed_faces()
        if self.placement is None or "faces" in self.__dict__:
            faces = faces.copy()
        faces += np.repeat(self.vertex_offsets[:-1].astype(np.int32), np.diff(self.face_offsets))[:, None]
        return faces

    def triangles(self) -> Floats:
        """``(n_faces, 3, 3)`` float64 corner positions [m]."""
        return self.vertices[self.global_faces()]

    def with_vertices(self, vertices: Floats) -> Scene:
        """The same meshes with their vertices elsewhere, each a shape of its own.

        Args:
            vertices: ``(n_vertices, 3)`` [m], in the order of ``vertices``.
        """
        arrays = MeshArrays(vertices, self.faces, self.vertex_offsets, self.face_offsets)
        return replace(self, shapes=arrays, placement=None)

    def select(self, indices: npt.ArrayLike) -> Scene:
        """The scene of these meshes only, in the order given."""
        order = np.asarray(indices, np.int64).reshape(-1)
        rest = self._rest(order.tolist())
        if self.placement is None:
            return Scene(self.shapes.select(order), **rest)
        used, shape = np.unique(self.placement.shape[order], return_inverse=True)
        placement = Placement(
            shape.reshape(-1).astype(np.int64), self.placement.turn[order], self.placement.shift[order]
        )
        shapes = self.shapes if len(used) == self.shapes.n else self.shapes.select(used)
        return Scene(shapes, placement=placement, **rest)

    def _rest(self, order: Sequence[int]) -> dict[str, Any]:
        """All but the geometry, of some meshes in the order given."""
        return {
            "paths": tuple(self.paths[i] for i in order),
            "colors": self.colors[np.asarray(order, np.int64)],
            "source": self.source,
            "origin": self.origin,
            "anchors": tuple(self.anchors[i] for i in order) if self.anchors else (),
            "diagnostics": self.diagnostics,
            "facts": self.facts,
            "links": self.links,
        }

    def in_path_order(self) -> Scene:
        """The same scene with its meshes in the natural order of their paths (``pipe_2`` before ``pipe_10``)."""
        order = natural_order(self.paths)
        return self if order == list(range(self.n_meshes)) else self.select(order)

    def merge(self, part_of_mesh: npt.ArrayLike, head_of_part: npt.ArrayLike) -> Scene:
        """Joins the meshes of each part into one mesh.

        Args:
            part_of_mesh: ``(n_meshes,)`` part of each mesh, ``0..n_parts - 1``, each part with at least one mesh.
            head_of_part: ``(n_parts,)`` the mesh that gives a part its path and colour.

        Returns:
            A scene of ``n_parts`` meshes; within a part its meshes follow in their order here. A part of one mesh
            keeps the shape of that. This very scene where each mesh is a part and they stay in their order.
        """
        parts = np.asarray(part_of_mesh, np.int64)
        heads = np.asarray(head_of_part, np.int64)
        if len(heads) == self.n_meshes and (heads == np.arange(self.n_meshes)).all() and (parts == heads).all():
            return self
        count = np.bincount(parts, minlength=len(heads))
        rest = self._rest(heads.tolist())
        if self.placement is None or (count > 1).all():
            return Scene(self._joined(parts, len(heads)), **rest)
        single = np.flatnonzero(count == 1)
        rank = np.cumsum(count > 1) - 1
        several = count[parts] > 1
        joined = self.select(np.flatnonzero(several))._joined(rank[parts[several]], int((count > 1).sum()))
        shape = self.shapes.n + rank
        turn, shift = np.tile(np.eye(3), (len(heads), 1, 1)), np.zeros((len(heads), 3))
        alone = self.placement.select(heads[single])
        shape[single], turn[single], shift[single] = alone.shape, alone.turn, alone.shift
        shapes = MeshArrays(
            np.concatenate([self.shapes.vertices, joined.vertices]),
            np.concatenate([self.shapes.faces, joined.faces]),
            np.concatenate([self.shapes.vertex_offsets, self.shapes.vertex_offsets[-1] + joined.vertex_offsets[1:]]),
            np.concatenate([self.shapes.face_offsets, self.shapes.face_offsets[-1] + joined.face_offsets[1:]]),
        )
        return Scene(shapes, placement=Placement(shape.astype(np.int64), turn, shift), **rest)

    def _joined(self, parts: Ints, n_parts: int) -> MeshArrays:
        """The meshes of each part as one."""
        order = np.argsort(parts, kind="stable")
        by_part = MeshArrays(self.vertices, self.faces, self.vertex_offsets, self.face_offsets).select(order)
        sorted_parts = parts[order]
        first = np.searchsorted(sorted_parts, np.arange(n_parts + 1))
        v_offsets, f_offsets = by_part.vertex_offsets[first], by_part.face_offsets[first]
        shift = (by_part.vertex_offsets[:-1] - v_offsets[sorted_parts]).astype(np.int32)
        faces = by_part.faces + np.repeat(shift, np.diff(by_part.face_offsets))[:, None]
        return MeshArrays(by_part.vertices, faces, v_offsets, f_offsets)


def turned_boxes(low: Floats, high: Floats, turn: Floats, shift: Floats) -> tuple[Floats, Floats]:
    """Boxes around boxes that are turned and moved.

    Args:
        low: ``(n, 3)`` their least corners.
        high: ``(n, 3)`` their greatest corners.
        turn: ``(n, 3, 3)`` for row vectors; may scale and mirror, too.
        shift: ``(n, 3)``.

    Returns:
        The least and the greatest corners ``(n, 3)``: no less than what is in the boxes reaches.
    """
    center = np.einsum("ij,ijk->ik", 0.5 * (low + high), turn) + shift
    reach = np.einsum("ij,ijk->ik", 0.5 * (high - low), np.abs(turn))
    return center - reach, center + reach


def mesh_of_vertex(scene: Scene) -> Ints:
    """``(n_vertices,)`` the mesh that owns each vertex."""
    return np.repeat(np.arange(scene.n_meshes), np.diff(scene.vertex_offsets))


def mesh_of_face(scene: Scene) -> Ints:
    """``(n_faces,)`` the mesh that owns each face."""
    return np.repeat(np.arange(scene.n_meshes), np.diff(scene.face_offsets))


def _offsets(counts: npt.ArrayLike) -> Ints:
    """``(n + 1,)`` where each of ``n`` ranges of these lengths begins, and the last ends."""
    return np.concatenate([[0], np.cumsum(np.asarray(counts, np.int64))]).astype(np.int64)


def blocks(n: int, size: int) -> Iterator[slice]:
    """``range(n)`` in slices of some length, the last maybe shorter: what is done with one stays in little memory."""
    return (slice(first, min(first + size, n)) for first in range(0, n, size))


def ranges(starts: Ints, lengths: Ints) -> Ints:
    """Concatenated ``arange(start, start + length)`` of each pair."""
    ends = np.cumsum(lengths)
    found: Ints = np.arange(int(lengths.sum())) + np.repeat(starts - (ends - lengths), lengths)
    return found
