"""USD meshes to triangles: many at once, so that thousands of small ones cost as little as one large one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.load.polygons import Indices, triangulate
from cadgraph.model.scene import Ints

__all__ = ["CutMesh", "RawMesh", "cut_meshes"]

_BATCH_CORNERS = 500_000  # polygon corners and points cut at once: temporary arrays stay in the processor's cache

_NO_INTS: Ints = np.zeros(0, np.int64)


@dataclass(frozen=True)
class RawMesh:
    """A mesh as a file has it, unchecked.

    Args:
        points: ``(n, 3)``.
        counts: corners of each polygon, like all these integers of 32 or 64 bits.
        indices: the point of each corner.
        left_handed: polygons run clockwise seen from outside.
        holes: polygons that are holes.
        subdivided: stands for a smooth surface (the polygons are its control cage).
        subsets: name and polygons of each material subset.
    """

    points: npt.NDArray[np.floating]
    counts: Indices
    indices: Indices
    left_handed: bool = False
    holes: Indices = field(default_factory=lambda: _NO_INTS)
    subdivided: bool = False
    subsets: tuple[tuple[str, Indices], ...] = ()


@dataclass(frozen=True)
class CutMesh:
    """A mesh as triangles.

    Args:
        points: ``(n, 3)``, as in the file.
        corners: ``(m, 3)`` point indices, counter-clockwise seen from outside, in range, their points finite.
        polygon: ``(m,)`` the polygon that each triangle comes from.
        faults: code and message of each thing that was repaired.
        dense: every point is surely used.
    """

    points: npt.NDArray[np.floating]
    corners: Indices
    polygon: Indices
    faults: tuple[tuple[str, str], ...] = ()
    dense: bool = False


def cut_meshes(meshes: Sequence[RawMesh]) -> list[CutMesh]:
    """Cuts meshes into triangles and drops the polygons that can't be used."""
    cut: list[CutMesh] = []
    for batch in _batches(meshes):
        plain = _plain_triangles(batch)
        others = iter(_cut_batch([mesh for i, mesh in enumerate(batch) if i not in plain]))
        cut.extend(plain[i] if i in plain else next(others) for i in range(len(batch)))
    return cut


def _plain_triangles(meshes: Sequence[RawMesh]) -> dict[int, CutMesh]:
    """Those meshes, by number, that are sound triangles as they stand: most of what CAD converters write."""
    which = [
        i
        for i, mesh in enumerate(meshes)
        if 0 < len(mesh.indices) == 3 * len(mesh.counts) and len(mesh.points) and not len(mesh.holes)
    ]
    if not which:
        return {}
    n_points = np.array([len(meshes[i].points) for i in which], np.int64)
    n_faces = np.array([len(meshes[i].counts) for i in which], np.int64)
    first_point, first_face = _starts(n_points), _starts(n_faces)
    corners = np.concatenate([meshes[i].indices for i in which])
    a, b, c = corners.reshape(-1, 3).T
    other = (np.concatenate([meshes[i].counts for i in which]) != 3) | (a == b) | (b == c) | (c == a)
    with np.errstate(over="ignore", invalid="ignore"):
        # A sum is finite only where every term is.
        sums = np.add.reduceat(np.concatenate([meshes[i].points for i in which]).reshape(-1), 3 * first_point)
    sound = ~np.logical_or.reduceat(other, first_face) & np.isfinite(sums)
    sound &= np.minimum.reduceat(corners, 3 * first_face) >= 0
    sound &= np.maximum.reduceat(corners, 3 * first_face) < n_points
    indices = corners + np.repeat(first_point.astype(corners.dtype), 3 * n_faces)
    used = np.zeros(int(n_points.sum()), bool)
    used[indices if sound.all() else indices[np.repeat(sound, 3 * n_faces)]] = True
    dense = np.logical_and.reduceat(used, first_point)
    polygon = np.arange(int(n_faces.max()))
    plain = {}
    for k in np.flatnonzero(sound):
        mesh = meshes[which[k]]
        triangles = mesh.indices.reshape(-1, 3)
        turned = triangles[:, ::-1] if mesh.left_handed else triangles
        plain[which[k]] = CutMesh(mesh.points, turned, polygon[: len(triangles)], dense=bool(dense[k]))
    return plain


def _batches(meshes: Sequence[RawMesh]) -> Iterator[Sequence[RawMesh]]:
    first, corners = 0, 0
    for i, mesh in enumerate(meshes):
        corners += len(mesh.indices) + len(mesh.points)
        if corners > _BATCH_CORNERS:
            yield meshes[first : i + 1]
            first, corners = i + 1, 0
    if first < len(meshes):
        yield meshes[first:]


def _cut_batch(meshes: Sequence[RawMesh]) -> list[CutMesh]:
    if not meshes:
        return []
    faults: list[dict[str, str]] = [{} for _ in meshes]
    counts = _fitting_counts(meshes, faults)
    n_polygons = np.array([len(c) for c in counts], np.int64)
    n_points = np.array([len(mesh.points) for mesh in meshes], np.int64)
    first_polygon, first_point = _starts(n_polygons), _starts(n_points)
    all_counts = np.concatenate(counts)
    all_points = np.concatenate([mesh.points for mesh in meshes])
    n_corners = _over_each(np.add, all_counts.astype(np.int64), n_polygons, 0)
    corners = np.concatenate([mesh.indices[:n] for mesh, n in zip(meshes, n_corners.tolist(), strict=True)])
    indices = corners + np.repeat(first_point.astype(corners.dtype), n_corners)
    usable = np.ones(len(all_counts), bool)
    for wrong, code, what in _wrong_polygons(all_counts, all_points, corners, n_corners, indices, n_points):
        usable &= ~wrong
        for i in np.unique(np.searchsorted(first_polygon, np.flatnonzero(wrong), side="right") - 1):
            faults[i][code] = what
    for i, mesh in enumerate(meshes):
        holes = mesh.holes[(mesh.holes >= 0) & (mesh.holes < n_polygons[i])]
        usable[holes + first_polygon[i]] = False

    kept = np.flatnonzero(usable)
    cut = triangulate(all_points, all_counts[kept], _starts(all_counts)[kept], indices, kept)
    for i in np.unique(np.searchsorted(first_polygon, cut.twisted, side="right") - 1):
        faults[i]["twisted-faces"] = "some faces cross themselves; their triangles are a guess"
    last = np.searchsorted(cut.polygon, np.append(first_polygon, len(all_counts)))
    n_triangles = np.diff(last)
    used = np.zeros(len(all_points), bool)
    used[cut.corners] = True
    dense = _over_each(np.logical_and, used, n_points, True)
    # Of 32 bits where the file has them so: these arrays are the largest of all.
    corner_of_mesh = cut.corners - np.repeat(first_point.astype(corners.dtype), n_triangles)[:, None]
    polygon_of_mesh = (cut.polygon - np.repeat(first_polygon, n_triangles)).astype(corners.dtype)
    result = []
    for i, mesh in enumerate(meshes):
        own = slice(last[i], last[i + 1])
        triangles = corner_of_mesh[own]
        result.append(
            CutMesh(
                points=mesh.points,
                corners=triangles[:, ::-1] if mesh.left_handed else triangles,
                polygon=polygon_of_mesh[own],
                faults=tuple(sorted(faults[i].items())),
                dense=bool(dense[i]),
            )
        )
    return result


def _wrong_polygons(
    counts: Indices, points: npt.NDArray[np.floating], corners: Indices, n_corners: Ints, indices: Ints, n_points: Ints
) -> Iterator[tuple[npt.NDArray[np.bool_], str, str]]:
    """Masks over all polygons of a batch, with the code and message of what is wrong with those in it.

    ``indices`` that are out of range are set to 0 on the way.
    """
    short = counts < 3
    if short.any():
        yield short, "invalid-face-counts", "faces with fewer than three corners were dropped"
    low = _over_each(np.minimum, corners, n_corners, 0)
    high = _over_each(np.maximum, corners, n_corners, -1)
    beyond = np.zeros(len(indices), bool)
    if (low < 0).any() or (high >= n_points).any():
        beyond = (corners < 0) | (corners >= np.repeat(n_points, n_corners))
        indices[beyond] = 0
        yield _touched(beyond, counts), "invalid-indices", "faces that use points which don't exist were dropped"
    finite = np.asarray(np.isfinite(points).all(axis=1))
    if not finite.all() and len(indices):
        spoiled = ~beyond
        spoiled[spoiled] = ~finite[indices[spoiled]]
        yield _touched(spoiled, counts), "invalid-points", "faces that use NaN or infinite points were dropped"


def _fitting_counts(meshes: Sequence[RawMesh], faults: Sequence[dict[str, str]]) -> list[Indices]:
    """For each mesh the counts of the leading polygons that its indices suffice for."""
    fitting = [mesh.counts for mesh in meshes]
    n_counts = np.array([len(counts) for counts in fitting], np.int64)
    n_indices = np.array([len(mesh.indices) for mesh in meshes], np.int64)
    counts = np.concatenate(fitting).astype(np.int64)
    agree = _over_each(np.add, counts, n_counts, 0) == n_indices
    agree &= _over_each(np.minimum, counts, n_counts, 0) >= 0
    for i in np.flatnonzero(~agree).tolist():
        negative = np.flatnonzero(fitting[i] < 0)
        leading = fitting[i][: negative[0]] if len(negative) else fitting[i]
        fitting[i] = leading[: np.searchsorted(np.cumsum(leading), n_indices[i], side="right")]
        faults[i]["invalid-face-counts"] = (
            "face counts and indices don't agree; faces past the last whole one were dropped"
        )
    return fitting


def _over_each(ufunc: np.ufunc, values: npt.NDArray[Any], lengths: Ints, empty: int) -> npt.NDArray[Any]:
    """A ufunc over each of the consecutive runs of these lengths; ``empty`` for a run without values."""
    found = np.full(len(lengths), empty, values.dtype)
    some = lengths > 0
    if some.any():
        found[some] = ufunc.reduceat(values, _starts(lengths)[some])
    return found


def _touched(bad_corner: npt.NDArray[np.bool_], counts: Indices) -> npt.NDArray[np.bool_]:
    touched = np.zeros(len(counts), bool)
    touched[np.repeat(np.arange(len(counts)), counts)[bad_corner]] = True
    return touched


def _starts(lengths: Indices) -> Ints:
    starts: Ints = np.cumsum(lengths) - lengths
    return starts
