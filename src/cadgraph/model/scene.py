"""A loaded scene: all meshes as one set of flat arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from cadgraph._io.text import natural_key
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.facts import Fact, StatedLink

__all__ = ["Diagnostic", "Fact", "Floats", "Ints", "Scene", "Source", "StatedLink", "mesh_of_face", "mesh_of_vertex"]

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
    """

    path: str = ""
    sha256: str = ""
    meters_per_unit: float = 1.0
    up_axis: str = "Z"
    format: str = ""
    unit_stated: bool = True
    up_stated: bool = True
    metadata: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True, eq=False, repr=False)
class Scene:
    """All meshes of a source, in metres, Z up, right-handed, in world coordinates relative to ``origin``.

    A mesh is one placed occurrence of geometry. Faces are triangles, counter-clockwise seen from outside.

    Args:
        vertices: ``(n_vertices, 3)`` float64 [m], relative to ``origin``.
        faces: ``(n_faces, 3)`` int32, indices local to the mesh.
        vertex_offsets: ``(n_meshes + 1,)`` int64; mesh ``i`` owns the vertices from ``vertex_offsets[i]`` up to
            ``vertex_offsets[i + 1]``.
        face_offsets: ``(n_meshes + 1,)`` int64, likewise for faces.
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
    """

    vertices: Floats
    faces: Faces
    vertex_offsets: Ints
    face_offsets: Ints
    paths: tuple[str, ...]
    colors: npt.NDArray[np.float32]
    source: Source = field(default_factory=Source)
    origin: Floats = field(default_factory=lambda: np.zeros(3))
    anchors: tuple[str, ...] = ()
    diagnostics: tuple[Diagnostic, ...] = ()
    facts: tuple[Fact, ...] = ()
    links: tuple[StatedLink, ...] = ()

    def __post_init__(self) -> None:
        n = len(self.paths)
        if len(self.vertex_offsets) != n + 1 or len(self.face_offsets) != n + 1 or len(self.colors) != n:
            raise ValueError(
                f"a scene of {n} paths needs {n + 1} offsets and {n} colors, got {len(self.vertex_offsets)} vertex "
                f"offsets, {len(self.face_offsets)} face offsets and {len(self.colors)} colors"
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
        vertices = [np.asarray(v, np.float64).reshape(-1, 3) for v, _ in meshes]
        faces = [np.asarray(f, np.int32).reshape(-1, 3) for _, f in meshes]
        n = len(meshes)
        return cls(
            vertices=np.concatenate(vertices) if n else np.zeros((0, 3)),
            faces=np.concatenate(faces) if n else np.zeros((0, 3), np.int32),
            vertex_offsets=np.concatenate([[0], np.cumsum([len(v) for v in vertices])]).astype(np.int64),
            face_offsets=np.concatenate([[0], np.cumsum([len(f) for f in faces])]).astype(np.int64),
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
        return len(self.faces)

    def mesh(self, index: int) -> tuple[Floats, Faces]:
        """The vertices ``(n, 3)`` [m] and faces ``(m, 3)`` of one mesh, as views."""
        v0, v1 = self.vertex_offsets[index : index + 2]
        f0, f1 = self.face_offsets[index : index + 2]
        return self.vertices[v0:v1], self.faces[f0:f1]

    def global_faces(self) -> Ints:
        """``(n_faces, 3)`` int64 indices into ``vertices``."""
        first_vertex = np.repeat(self.vertex_offsets[:-1], np.diff(self.face_offsets))
        return self.faces.astype(np.int64) + first_vertex[:, None]

    def triangles(self) -> Floats:
        """``(n_faces, 3, 3)`` float64 corner positions [m]."""
        return self.vertices[self.global_faces()]

    def select(self, indices: npt.ArrayLike) -> Scene:
        """The scene of these meshes only, in the order given."""
        order = np.asarray(indices, np.int64).reshape(-1)
        n_vertices, n_faces = np.diff(self.vertex_offsets)[order], np.diff(self.face_offsets)[order]
        return Scene(
            vertices=self.vertices[_ranges(self.vertex_offsets[order], n_vertices)],
            faces=self.faces[_ranges(self.face_offsets[order], n_faces)],
            vertex_offsets=np.concatenate([[0], np.cumsum(n_vertices)]).astype(np.int64),
            face_offsets=np.concatenate([[0], np.cumsum(n_faces)]).astype(np.int64),
            paths=tuple(self.paths[i] for i in order),
            colors=self.colors[order],
            source=self.source,
            origin=self.origin,
            anchors=tuple(self.anchors[i] for i in order) if self.anchors else (),
            diagnostics=self.diagnostics,
            facts=self.facts,
            links=self.links,
        )

    def in_path_order(self) -> Scene:
        """The same scene with its meshes in the natural order of their paths (``pipe_2`` before ``pipe_10``)."""
        order = sorted(range(self.n_meshes), key=lambda i: natural_key(self.paths[i]))
        return self if order == list(range(self.n_meshes)) else self.select(order)

    def merge(self, part_of_mesh: npt.ArrayLike, head_of_part: npt.ArrayLike) -> Scene:
        """Joins the meshes of each part into one mesh.

        Args:
            part_of_mesh: ``(n_meshes,)`` part of each mesh, ``0..n_parts - 1``, each part with at least one mesh.
            head_of_part: ``(n_parts,)`` the mesh that gives a part its path and colour.

        Returns:
            A scene of ``n_parts`` meshes; within a part its meshes follow in their order here.
        """
        parts = np.asarray(part_of_mesh, np.int64)
        heads = np.asarray(head_of_part, np.int64)
        by_part = self.select(np.argsort(parts, kind="stable"))
        sorted_parts = np.sort(parts, kind="stable")
        first = np.searchsorted(sorted_parts, np.arange(len(heads) + 1))
        v_offsets, f_offsets = by_part.vertex_offsets[first], by_part.face_offsets[first]
        shift = (by_part.vertex_offsets[:-1] - v_offsets[sorted_parts]).astype(np.int32)
        return Scene(
            vertices=by_part.vertices,
            faces=by_part.faces + np.repeat(shift, np.diff(by_part.face_offsets))[:, None],
            vertex_offsets=v_offsets,
            face_offsets=f_offsets,
            paths=tuple(self.paths[i] for i in heads),
            colors=self.colors[heads],
            source=self.source,
            origin=self.origin,
            anchors=tuple(self.anchors[i] for i in heads) if self.anchors else (),
            diagnostics=self.diagnostics,
            facts=self.facts,
            links=self.links,
        )


def mesh_of_vertex(scene: Scene) -> Ints:
    """``(n_vertices,)`` the mesh that owns each vertex."""
    return np.repeat(np.arange(scene.n_meshes), np.diff(scene.vertex_offsets))


def mesh_of_face(scene: Scene) -> Ints:
    """``(n_faces,)`` the mesh that owns each face."""
    return np.repeat(np.arange(scene.n_meshes), np.diff(scene.face_offsets))


def _ranges(starts: Ints, lengths: Ints) -> Ints:
    """Concatenated ``arange(start, start + length)`` of each pair."""
    ends = np.cumsum(lengths)
    ranges: Ints = np.arange(int(lengths.sum())) + np.repeat(starts - (ends - lengths), lengths)
    return ranges
