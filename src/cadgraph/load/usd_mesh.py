"""USD meshes to triangles: many at once, so that thousands of small ones cost as little as one large one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from cadgraph.load.polygons import triangulate
from cadgraph.scene import Floats, Ints

__all__ = ["CutMesh", "RawMesh", "cut_meshes"]

_BATCH_CORNERS = 4_000_000  # polygon corners cut at once: bounds the memory for temporary arrays to about 1 GB

_NO_INTS: Ints = np.zeros(0, np.int64)


@dataclass(frozen=True)
class RawMesh:
    """A mesh as a file has it, unchecked.

    Args:
        points: ``(n, 3)``.
        counts: corners of each polygon.
        indices: the point of each corner.
        left_handed: polygons run clockwise seen from outside.
        holes: polygons that are holes.
        subdivided: stands for a smooth surface (the polygons are its control cage).
        subsets: name and polygons of each material subset.
    """

    points: npt.NDArray[np.floating]
    counts: Ints
    indices: Ints
    left_handed: bool = False
    holes: Ints = field(default_factory=lambda: _NO_INTS)
    subdivided: bool = False
    subsets: tuple[tuple[str, Ints], ...] = ()


@dataclass(frozen=True)
class CutMesh:
    """A mesh as triangles.

    Args:
        points: ``(n, 3)`` float64, as in the file.
        corners: ``(m, 3)`` point indices, counter-clockwise seen from outside, in range, their points finite.
        polygon: ``(m,)`` the polygon that each triangle comes from.
        faults: code and message of each thing that was repaired.
    """

    points: Floats
    corners: Ints
    polygon: Ints
    faults: tuple[tuple[str, str], ...]


def cut_meshes(meshes: Sequence[RawMesh]) -> list[CutMesh]:
    """Cuts meshes into triangles and drops the polygons that can't be used."""
    cut: list[CutMesh] = []
    for batch in _batches(meshes):
        cut.extend(_cut_batch(batch))
    return cut


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
    faults: list[dict[str, str]] = [{} for _ in meshes]
    counts = [_fitting_counts(mesh, fault) for mesh, fault in zip(meshes, faults, strict=True)]
    n_polygons = np.array([len(c) for c in counts], np.int64)
    n_points = np.array([len(mesh.points) for mesh in meshes], np.int64)
    first_polygon, first_point = _starts(n_polygons), _starts(n_points)
    all_counts = np.concatenate([*counts, _NO_INTS])
    all_points = np.concatenate([np.zeros((0, 3)), *(mesh.points for mesh in meshes)])
    corners = [mesh.indices[: int(c.sum())] for mesh, c in zip(meshes, counts, strict=True)]
    local = np.concatenate([*corners, _NO_INTS])
    indices = local + np.repeat(first_point, [len(c) for c in corners])
    usable = np.ones(len(all_counts), bool)
    for wrong, code, what in _wrong_polygons(all_counts, all_points, corners, indices, n_points):
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
    result = []
    for i, mesh in enumerate(meshes):
        own = slice(last[i], last[i + 1])
        triangles = cut.corners[own] - first_point[i]
        result.append(
            CutMesh(
                points=all_points[first_point[i] : first_point[i] + n_points[i]],
                corners=triangles[:, ::-1] if mesh.left_handed else triangles,
                polygon=cut.polygon[own] - first_polygon[i],
                faults=tuple(sorted(faults[i].items())),
            )
        )
    return result


def _wrong_polygons(
    counts: Ints, points: Floats, corners: Sequence[Ints], indices: Ints, n_points: Ints
) -> Iterator[tuple[npt.NDArray[np.bool_], str, str]]:
    """Masks over all polygons of a batch, with the code and message of what is wrong with those in it.

    ``indices`` that are out of range are set to 0 on the way.
    """
    short = counts < 3
    if short.any():
        yield short, "invalid-face-counts", "faces with fewer than three corners were dropped"
    outside = [bool(len(c)) and (c.min() < 0 or c.max() >= n) for c, n in zip(corners, n_points, strict=True)]
    beyond = np.zeros(len(indices), bool)
    if any(outside):
        limits = np.repeat(n_points, [len(c) for c in corners])
        local = np.concatenate(corners)
        beyond = (local < 0) | (local >= limits)
        indices[beyond] = 0
        yield _touched(beyond, counts), "invalid-indices", "faces that use points which don't exist were dropped"
    finite = np.asarray(np.isfinite(points).all(axis=1))
    if not finite.all() and len(indices):
        spoiled = ~beyond
        spoiled[spoiled] = ~finite[indices[spoiled]]
        yield _touched(spoiled, counts), "invalid-points", "faces that use NaN or infinite points were dropped"


def _fitting_counts(mesh: RawMesh, faults: dict[str, str]) -> Ints:
    """The counts of the leading polygons that the indices suffice for."""
    counts = mesh.counts
    negative = np.flatnonzero(counts < 0)
    if len(negative):
        counts = counts[: negative[0]]
    ends = np.cumsum(counts)
    fitting = counts[: np.searchsorted(ends, len(mesh.indices), side="right")]
    if len(fitting) < len(mesh.counts) or fitting.sum() < len(mesh.indices):
        faults["invalid-face-counts"] = (
            "face counts and indices don't agree; faces past the last whole one were dropped"
        )
    return fitting


def _touched(bad_corner: npt.NDArray[np.bool_], counts: Ints) -> npt.NDArray[np.bool_]:
    touched = np.zeros(len(counts), bool)
    touched[np.repeat(np.arange(len(counts)), counts)[bad_corner]] = True
    return touched


def _starts(lengths: Ints) -> Ints:
    starts: Ints = np.cumsum(lengths) - lengths
    return starts
