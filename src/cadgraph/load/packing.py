"""Placed pieces of geometry to a scene, and notes about them to diagnostics."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import numpy.typing as npt

from cadgraph._io.text import natural_key, natural_order
from cadgraph.load.naming import Names
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.facts import Fact, StatedLink
from cadgraph.model.scene import Faces, Floats, Ints, MeshArrays, Placement, Scene, Source, turned_boxes

__all__ = ["Z_UP_FROM", "Notes", "Piece", "metres_z_up", "pack", "pack_placed"]

Z_UP_FROM = {
    "X": np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]], float),
    "Y": np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]], float),
    "Z": np.eye(3),
}
"""Cyclic swaps, for row vectors: what pointed along the up axis points along Z, and no handedness changes."""

_FAR = 10_000.0  # [m] beyond this a scene gets an origin of its own; ours: float32 renders still resolve 1 mm
TOO_FAR_TOLD = "left out: it reaches farther than a million kilometres; check its points and the file's units"
_UNSTATED = 1000.0  # millimetres are the smallest unit that a plant is drawn in without saying so
_ORIGIN_STEP = 100.0  # [m] origins are whole multiples, so that they are exact and stable under small edits
TOO_FAR = 1e9  # [m] ours: there float64 still resolves a micrometre; the Moon is at 4e8
_SIZES = (1e-3, 1e5)  # [m] ours: no plant is smaller than a millimetre or larger than 100 km
_RIGID = 2e-6  # shapes are shared by placements that turn as truly as this; ours: float32 frames do
_STRAIGHT = 1e-9  # how exactly the last column of a placement is 0, 0, 0, 1
_PROJECTIVE_TOLD = (
    "its placement has a perspective, which that of a thing has not: it is placed without; see where it lies"
)
_FLAT = 1e-7  # least over greatest stretch of a placement that leaves a thing with depth
_FLAT_TOLD = "its placement presses it flat (a scale of 0 along one direction): it has no depth here"
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
    farther than a million kilometres from the origin (``too-far``). One whose placement has a perspective is placed
    without it (``projective-transform``); one that a placement presses flat is kept as it lies (``flat-transform``).
    A scene smaller than a millimetre or larger than 100 km is reported (``unusual-size``).

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
    shapes: dict[tuple[int, int], int] = {}
    shape_of_mesh = [shapes.setdefault((id(piece.points), id(piece.faces)), len(shapes)) for piece in pieces]
    distinct = {shape: (piece.points, piece.faces) for shape, piece in zip(shape_of_mesh, pieces, strict=True)}
    return pack_placed(
        [distinct[shape] for shape in range(len(distinct))],
        np.array(shape_of_mesh, np.int64),
        np.array([piece.matrix for piece in pieces], np.float64).reshape(-1, 4, 4),
        [piece.path for piece in pieces],
        np.array([_NO_COLOR if piece.color is None else piece.color for piece in pieces], np.float64).reshape(-1, 3),
        source,
        world_from_source,
        notes,
        abridged,
        facts,
        links,
        [piece.anchor or "" for piece in pieces],
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
    anchors: Sequence[str] = (),
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
        anchors: ``(n_meshes,)`` the paths that carry opinions on them, "" for the mesh's own; none: their own.

    Returns:
        The scene, sorted by path.
    """
    order = np.array(natural_order(paths), np.int64)
    with np.errstate(over="ignore", invalid="ignore"):
        world = _affine(matrices, paths, notes)[order] @ world_from_source
        # Where the file states no unit these are no metres yet: what lies too far is told when they are.
        far = TOO_FAR if source.unit_stated else TOO_FAR * _UNSTATED
        placed = _Placed.of(shapes, shape_of_mesh[order], world, far)
        low, high = placed.bounds()
        kept = placed.kept([paths[i] for i in order.tolist()], low, high, notes)
    order, placed = order[kept], placed.select(kept)
    for i in placed.flat().tolist():
        notes.add("flat-transform", _FLAT_TOLD, paths[order[i]])
    if source.unit_stated:
        _note_size(low[kept], high[kept], source, notes)
    names = Names()
    unique = tuple(names.take(paths[i]) for i in order.tolist())
    given = tuple((anchors[i] if anchors else "") or path for i, path in zip(order.tolist(), unique, strict=True))
    arrays, placement = placed.arrays()
    return Scene(
        arrays,
        placement=placement,
        paths=unique,
        colors=np.clip(colors[order], 0, 1).astype(np.float32),
        source=source,
        origin=placed.origin,
        anchors=given if given != unique else (),
        diagnostics=notes.diagnostics(abridged),
        facts=tuple(facts),
        links=tuple(links),
    )


def _affine(matrices: Floats, paths: Sequence[str], notes: Notes) -> Floats:
    """The matrices without what makes a perspective of them, which no placement of a thing has."""
    column = np.array([0.0, 0.0, 0.0, 1.0])
    # What isn't finite is told when it is placed.
    bent = np.flatnonzero(
        (np.abs(matrices[:, :, 3] - column) > _STRAIGHT).any(axis=1) & np.isfinite(matrices).all(axis=(1, 2))
    )
    if not len(bent):
        return matrices
    straight = matrices.copy()
    for i in bent.tolist():
        notes.add("projective-transform", _PROJECTIVE_TOLD, paths[i])
        # A matrix times a number is the same placement.
        straight[i] /= straight[i, 3, 3] or 1.0
        straight[i, :, 3] = column
    return straight


@dataclass(frozen=True, eq=False)
class _Placed:
    """Shapes and where they lie in a world of metres.

    Args:
        shapes: points and triangles of each, in units of the source.
        shape: ``(n,)`` of each mesh.
        turn: ``(n, 3, 3)`` of each mesh, for row vectors; with scale, maybe mirrored or not finite.
        shift: ``(n, 3)`` [m], relative to the origin.
        origin: ``(3,)`` [m].
        far: how far out something may reach [m].
    """

    shapes: Sequence[tuple[npt.NDArray[np.floating], Faces]]
    shape: Ints
    turn: Floats
    shift: Floats
    origin: Floats
    far: float

    @classmethod
    def of(
        cls, shapes: Sequence[tuple[npt.NDArray[np.floating], Faces]], shape: Ints, matrices: Floats, far: float
    ) -> _Placed:
        turn, shift = np.ascontiguousarray(matrices[:, :3, :3]), matrices[:, 3, :3]
        # A corner of each shape tells where it is.
        corners = np.array([points[faces[0, 0]] for points, faces in shapes], np.float64).reshape(-1, 3)
        origin = _origin(np.einsum("ij,ijk->ik", corners[shape], turn) + shift, far)
        return cls(shapes, shape, turn, shift - origin, origin, far)

    def select(self, kept: Ints) -> _Placed:
        return replace(self, shape=self.shape[kept], turn=self.turn[kept], shift=self.shift[kept])

    def points(self, mesh: int) -> Floats:
        """The vertices of one mesh ``(n, 3)`` [m]."""
        placed: Floats = self.shapes[self.shape[mesh]][0].astype(np.float64, copy=False) @ self.turn[mesh]
        placed += self.shift[mesh]
        return placed

    def bounds(self) -> tuple[Floats, Floats]:
        """Bounds ``(n, 3)`` [m] of the boxes of the shapes, each as it lies: no less than those of the meshes."""
        low = np.array([points.min(axis=0) for points, _ in self.shapes], np.float64).reshape(-1, 3)
        high = np.array([points.max(axis=0) for points, _ in self.shapes], np.float64).reshape(-1, 3)
        return turned_boxes(low[self.shape], high[self.shape], self.turn, self.shift)

    def kept(self, paths: Sequence[str], low: Floats, high: Floats, notes: Notes) -> Ints:
        """The meshes that can be placed, by their bounds; the others are noted."""
        finite = np.asarray(np.isfinite(self.turn).all(axis=(1, 2)) & np.isfinite(self.shift).all(axis=1))
        # Written so that NaN fails it too.
        limit = self.far - float(np.abs(self.origin).max())
        sure = np.asarray((high <= limit).all(axis=1) & (low >= -limit).all(axis=1))
        solid = self._have_area()
        kept = []
        for i, path in enumerate(paths):
            if sure[i] and finite[i] and solid[i]:
                kept.append(i)
                continue
            placed = self.points(i)
            if not (finite[i] and np.isfinite(placed.sum())):
                notes.add("invalid-transform", "left out: its placement is not finite", path)
            elif not (placed.max() <= limit and placed.min() >= -limit):
                notes.add("too-far", TOO_FAR_TOLD, path)
            elif not _have_area(placed, self.shapes[self.shape[i]][1]).any():
                notes.add("degenerate-mesh", "left out: all its faces have zero area", path)
            else:
                kept.append(i)
        return np.array(kept, np.int64)

    def flat(self) -> Ints:
        """The meshes that their placement leaves without the depth that they have."""
        size = np.linalg.norm(self.turn, axis=(1, 2))
        # A thin rod has a small volume, too; what tells is the least stretch against the greatest.
        likely = np.flatnonzero(np.abs(np.linalg.det(self.turn)) <= _FLAT * size**3)
        directions, sizes, _ = np.linalg.svd(self.turn[likely])
        likely, lost = likely[sizes[:, 2] <= _FLAT * sizes[:, 0]], directions[sizes[:, 2] <= _FLAT * sizes[:, 0], :, 2]
        deep = [
            np.ptp(points @ along) > _FLAT * np.ptp(points, axis=0).max()
            for points, along in ((self.shapes[self.shape[i]][0], lost[k]) for k, i in enumerate(likely.tolist()))
        ]
        pressed: Ints = likely[np.array(deep, bool)]
        return pressed

    def _have_area(self) -> npt.NDArray[np.bool_]:
        """Whether the first triangle of each mesh has area: nearly always that settles it for all of them."""
        corners = np.array([points[faces[0]] for points, faces in self.shapes], np.float64).reshape(-1, 3, 3)
        placed = np.einsum("nij,njk->nik", corners[self.shape], self.turn) + self.shift[:, None]
        return _have_area(placed.reshape(-1, 3), np.arange(3 * len(placed)).reshape(-1, 3))

    def arrays(self) -> tuple[MeshArrays, Placement | None]:
        """The meshes as a scene holds them: shapes in metres that are turned and moved, or each mesh in its place
        where none repeats.
        """
        volume = np.linalg.det(self.turn)
        scale, mirrored = np.cbrt(np.abs(volume)), volume < 0
        with np.errstate(divide="ignore", invalid="ignore"):
            turn = self.turn / scale[:, None, None]
        gram = np.einsum("nij,nkj->nik", turn, turn)
        rigid = np.asarray((np.abs(gram - np.eye(3)) <= _RIGID).all(axis=(1, 2)))
        # One shape for each that is scaled or mirrored otherwise; what is skewed is a shape of its own.
        own = np.where(rigid, -1, np.arange(len(self.shape)))
        keys = list(
            zip(
                self.shape.tolist(), np.round(np.log(np.maximum(scale, 1e-300)) / _RIGID).tolist(), mirrored.tolist(),
                own.tolist(), strict=True,
            )
        )  # fmt: skip
        rows: dict[tuple[int, float, bool, int], int] = {}
        of_mesh = np.array([rows.setdefault(key, len(rows)) for key in keys], np.int64)
        first = np.unique(of_mesh, return_index=True)[1]
        if len(rows) == len(of_mesh):
            points, placement = [self.points(i) for i in range(len(of_mesh))], None
        else:
            mirror = np.where(mirrored[:, None, None], np.diag([-1.0, 1.0, 1.0]), np.eye(3))
            size = scale[first[of_mesh], None, None]
            shared = np.where(rigid[:, None, None], mirror @ (self.turn / np.where(size > 0, size, 1.0)), np.eye(3))
            sized = np.where(rigid[:, None, None], mirror * size, self.turn)
            points = [self.shapes[self.shape[i]][0].astype(np.float64, copy=False) @ sized[i] for i in first.tolist()]
            placement = Placement(of_mesh, shared, self.shift)
        faces = [self.shapes[self.shape[i]][1] for i in first.tolist()]
        faces = [
            each[:, ::-1] if turned else each for each, turned in zip(faces, mirrored[first].tolist(), strict=True)
        ]
        return MeshArrays.of(list(zip(points, faces, strict=True))), placement


def _note_size(low: Floats, high: Floats, source: Source, notes: Notes) -> None:
    if len(low):
        told = odd_size(float((high.max(axis=0) - low.min(axis=0)).max()), source)
        if told:
            notes.add("unusual-size", told)


def odd_size(size: float, source: Source) -> str:
    """What is said of a scene that no plant is as large, or as small, as; empty of others.

    Args:
        size: across [m].
        source: with its unit.
    """
    if _SIZES[0] <= size <= _SIZES[1]:
        return ""
    unit = f"check its units (one is taken as {source.meters_per_unit:g} m)"
    return f"the scene is {size:.3g} m across, which no plant is; {unit}"


def _have_area(points: Floats, faces: Faces | Ints) -> npt.NDArray[np.bool_]:
    """Whether each face has any area at all."""
    a, b, c = points[faces[:, 0]], points[faces[:, 1]], points[faces[:, 2]]
    (ux, uy, uz), (vx, vy, vz) = (b - a).T, (c - a).T
    area: npt.NDArray[np.bool_] = (uy * vz != uz * vy) | (uz * vx != ux * vz) | (ux * vy != uy * vx)
    return area


def _origin(first: Floats, far: float) -> Floats:
    """A whole multiple of 100 m amid the pieces where these lie far out, else zero.

    Args:
        first: ``(n, 3)`` a corner of each piece [m].
        far: what lies farther out doesn't count [m].
    """
    first = first[(np.abs(first) <= far).all(axis=1)]
    if not len(first):
        return np.zeros(3)
    # The median: one stray mesh must not drag the origin away from all others.
    middle = np.median(first, axis=0)
    if np.linalg.norm(middle) <= _FAR:
        return np.zeros(3)
    # + 0.0: minus zero becomes zero.
    origin: Floats = np.round(middle / _ORIGIN_STEP) * _ORIGIN_STEP + 0.0
    return origin
