"""Exact contacts: all pairs of meshes whose surfaces come within a distance.

Boxes of meshes first (``broad``), then box trees of triangles (``tree``, ``walk``), then triangles (``triangle``).
Every pair is decided wholly by one thread, by a walk that depends on its two meshes alone, so that any number of
workers gives the same output to the byte.

The distance is that of the surfaces: a mesh wholly within another one is near only if it comes near to its surface
(``inside`` finds the rest).
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.geometry.contact.broad import near_boxes
from cadgraph.geometry.contact.side import Placed
from cadgraph.geometry.contact.walk import closest
from cadgraph.geometry.kernels.gather import gather
from cadgraph.geometry.kernels.tree import Forest, build_forest
from cadgraph.geometry.kernels.triangle import TOLERANCE
from cadgraph.model.parts import Contacts
from cadgraph.model.scene import Floats, Ints, Scene

__all__ = ["contacts_among", "distances", "find_contacts", "plain", "touching"]


def find_contacts(
    scene: Scene,
    eps: float = 0.01,
    *,
    between: tuple[npt.ArrayLike, npt.ArrayLike] | None = None,
    forest: Forest | None = None,
    workers: int | None = None,
) -> Contacts:
    """All pairs of meshes whose surfaces are at most ``eps`` apart.

    A gap of ``eps`` plus ``TOLERANCE`` (1e-9 m) counts, a distance up to ``TOLERANCE`` is 0. Meshes without a valid
    face (``build_forest`` says which are) take part in no contact; faces without area count as the segments or
    points that they are.

    Args:
        scene: all meshes.
        eps: greatest distance [m]; 1 cm by default (paper, section III-B: DBSCAN's eps).
        between: two masks ``(n_meshes,)`` bool: only pairs with one mesh in each of them. All by default.
        forest: the trees of this scene, if built before.
        workers: threads; all processors by default. The output does not depend on it.

    Returns:
        The pairs with their exact distance and a closest point on each side. Where several points are equally
        close (parts that touch or overlap), which ones is fixed but has no meaning.

    Raises:
        ValueError: ``eps`` is negative or not finite, or ``workers`` is below 1.
    """
    return _contacts(scene, eps, between, forest, workers, TOLERANCE)


def contacts_among(scene: Scene, pairs: Ints, eps: float, *, workers: int | None = None) -> Contacts:
    """Of given pairs of meshes those that ``find_contacts`` finds, with the same figures to the last bit.

    So the pairs of a scene may be dealt out: what several calls find, each of a scene of the meshes of its pairs in
    their order, is together what one call finds in the whole scene.

    Args:
        scene: all meshes of the pairs; others may be among them.
        pairs: ``(n, 2)`` first < second, in ascending order, each once.
        eps: greatest distance [m].
        workers: threads; all processors by default. The output does not depend on it.

    Raises:
        ValueError: ``eps`` is negative or not finite, or ``workers`` is below 1.
    """
    _check_eps(eps)
    trees = build_forest(scene, workers)
    near, n = near_boxes(trees.boxes, eps + TOLERANCE, workers), scene.n_meshes
    near = near[np.isin(near[:, 0] * n + near[:, 1], pairs[:, 0] * n + pairs[:, 1])]
    rows, distance, points = _closest(plain(trees), near, eps + TOLERANCE, TOLERANCE, workers)
    return Contacts(near[rows], distance, points)


def touching(
    scene: Scene,
    eps: float = 0.01,
    *,
    between: tuple[npt.ArrayLike, npt.ArrayLike] | None = None,
    forest: Forest | None = None,
    workers: int | None = None,
) -> Ints:
    """The pairs of ``find_contacts`` only, ``(n_pairs, 2)``: a pair is left as soon as it is known to be near.

    Args and errors are those of ``find_contacts``.
    """
    return _contacts(scene, eps, between, forest, workers, eps + TOLERANCE).pairs


def distances(
    scene: Scene,
    pairs: npt.ArrayLike,
    limit: float = np.inf,
    *,
    forest: Forest | None = None,
    workers: int | None = None,
) -> tuple[Floats, Floats]:
    """The exact distances of given pairs of meshes.

    Args:
        scene: all meshes.
        pairs: ``(n, 2)`` indices of meshes.
        limit: no need to look further than this [m].
        forest: the trees of this scene, if built before.
        workers: threads; all processors by default. The output does not depend on it.

    Returns:
        ``(n,)`` distances [m], infinite beyond the limit (plus ``TOLERANCE``) or where a mesh has no valid face; and
        ``(n, 2, 3)`` closest points [m], NaN there.

    Raises:
        ValueError: ``limit`` is negative or NaN, an index is no mesh, or ``workers`` is below 1.
    """
    index = np.ascontiguousarray(pairs, np.int64).reshape(-1, 2)
    if not limit >= 0:
        raise ValueError(f"limit is {limit}; give a distance in metres, 0 or more")
    if len(index) and (index.min() < 0 or index.max() >= scene.n_meshes):
        raise ValueError(f"pairs refer to meshes {index.min()}..{index.max()}; the scene has {scene.n_meshes}")
    trees = forest if forest is not None else build_forest(scene, workers)
    rows, found, at = _closest(plain(trees), index, limit + TOLERANCE, TOLERANCE, workers)
    distance, points = np.full(len(index), np.inf), np.full((len(index), 2, 3), np.nan)
    distance[rows], points[rows] = found, at
    return distance, points


def plain(forest: Forest) -> Placed:
    """The meshes of a forest as the search kernels take them."""
    return Placed(
        centers=forest.centers,
        axes=forest.axes,
        upright=forest.upright,
        vertices=forest.vertices,
        vertex_offsets=forest.vertex_offsets,
        faces=forest.faces,
        face_offsets=forest.face_offsets,
        counts=forest.counts,
        nodes=forest.nodes,
        node_offsets=forest.node_offsets,
    )


def _contacts(
    scene: Scene,
    eps: float,
    between: tuple[npt.ArrayLike, npt.ArrayLike] | None,
    forest: Forest | None,
    workers: int | None,
    stop: float,
) -> Contacts:
    _check_eps(eps)
    trees = forest if forest is not None else build_forest(scene, workers)
    pairs = near_boxes(trees.boxes, eps + TOLERANCE, workers)
    if between is not None:
        first, second = (np.asarray(mask, np.bool_) for mask in between)
        a, b = pairs[:, 0], pairs[:, 1]
        pairs = pairs[(first[a] & second[b]) | (second[a] & first[b])]
    rows, distance, points = _closest(plain(trees), pairs, eps + TOLERANCE, stop, workers)
    return Contacts(pairs[rows], distance, points)


def _check_eps(eps: float) -> None:
    if not (eps >= 0 and np.isfinite(eps)):
        raise ValueError(f"eps is {eps}; give a distance in metres, 0 or more")


def _closest(
    meshes: Placed, pairs: Ints, limit: float, stop: float, workers: int | None
) -> tuple[Ints, Floats, Floats]:
    """Rows, distances and points of the pairs within the limit, in the order of the pairs."""
    counts = meshes.counts
    weights = np.minimum(counts[pairs[:, 0]], counts[pairs[:, 1]]) + 16

    def part(first: int, last: int) -> Any:
        return closest(meshes, pairs, first, last, limit, stop)

    found = gather(part, weights, workers)
    if not found:
        return np.zeros(0, np.int64), np.zeros(0), np.zeros((0, 2, 3))
    rows, distance, points = (np.concatenate(arrays) for arrays in zip(*found, strict=True))
    distance[distance <= TOLERANCE] = 0.0
    return rows, distance, points
