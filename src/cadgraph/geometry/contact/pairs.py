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

__all__ = ["distances", "find_contacts", "find_contacts_placed", "plain", "touching"]

_RIGID = 1e-6  # greatest deviation of a rotation from an orthogonal matrix


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


def find_contacts_placed(
    prototypes: Scene,
    prototype_of_mesh: npt.ArrayLike,
    world_from_mesh: npt.ArrayLike,
    eps: float = 0.01,
    *,
    forest: Forest | None = None,
    workers: int | None = None,
) -> Contacts:
    """All pairs of placed shapes whose surfaces are at most ``eps`` apart.

    Each prototype has one tree, however often it is placed: the memory grows with the distinct triangles only.

    Args:
        prototypes: the distinct shapes, each about its own origin [m].
        prototype_of_mesh: ``(n,)`` the prototype of each placed mesh.
        world_from_mesh: ``(n, 4, 4)`` where it is placed, acting on columns: a rigid motion, mirrored or not.
        eps: greatest distance [m].
        forest: the trees of the prototypes, if built before.
        workers: threads; all processors by default. The output does not depend on it.

    Returns:
        As ``find_contacts``, indices being those of placed meshes. Turning a shape rounds its coordinates, so that
        distances may differ in the last digits from those of a scene with the same shapes written out.

    Raises:
        ValueError: a transform is not rigid, the shapes don't match, an index is no prototype, ``eps`` is negative or
            not finite, or ``workers`` is below 1.
    """
    _check_eps(eps)
    tree = np.ascontiguousarray(prototype_of_mesh, np.int64).reshape(-1)
    poses = np.asarray(world_from_mesh, np.float64).reshape(-1, 4, 4)
    if len(tree) != len(poses):
        raise ValueError(f"{len(tree)} meshes need as many transforms, got {len(poses)}")
    if len(tree) and (tree.min() < 0 or tree.max() >= prototypes.n_meshes):
        raise ValueError(f"meshes refer to prototypes {tree.min()}..{tree.max()}; there are {prototypes.n_meshes}")
    _check_rigid(poses)
    trees = forest if forest is not None else build_forest(prototypes, workers)
    meshes = _place(trees, tree, poses)
    pairs = near_boxes(_placed_boxes(trees, meshes), eps + TOLERANCE, workers)
    rows, distance, points = _closest(meshes, pairs, eps + TOLERANCE, TOLERANCE, workers)
    return Contacts(pairs[rows], distance, points)


def _check_rigid(poses: Floats) -> None:
    turns = poses[:, :3, :3]
    error = np.abs(np.einsum("nij,nkj->nik", turns, turns) - np.eye(3)).max(axis=(1, 2)) if len(poses) else np.zeros(0)
    wrong = np.flatnonzero(~((error <= _RIGID) & np.isfinite(poses).all(axis=(1, 2))))
    if len(wrong):
        raise ValueError(f"the transform of mesh {wrong[0]} is not rigid; give scaled shapes prototypes of their own")


def _place(trees: Forest, tree: Ints, poses: Floats) -> Placed:
    """Trees put in the world."""
    turns = np.ascontiguousarray(poses[:, :3, :3])
    axes = np.einsum("nij,nkj->nik", trees.axes[tree], turns)
    return plain(trees)._replace(
        tree=tree,
        moved=True,
        rotations=turns,
        centers=np.einsum("nij,nj->ni", turns, trees.centers[tree]) + poses[:, :3, 3],
        axes=np.ascontiguousarray(axes),
        upright=(axes == np.eye(3)).all(axis=(1, 2)),
    )


def _placed_boxes(trees: Forest, meshes: Placed) -> Floats:
    """Upright boxes ``(n, 2, 3)`` around the turned root boxes of placed meshes; NaN for those without faces."""
    roots = np.full((trees.n_trees, 6), np.nan)
    filled = trees.counts > 0
    roots[filled] = trees.nodes[trees.node_offsets[:-1][filled]]
    middle = meshes.centers + np.einsum("nik,ni->nk", meshes.axes, roots[meshes.tree, :3])
    half = np.einsum("nik,ni->nk", np.abs(meshes.axes), roots[meshes.tree, 3:])
    # rounding of the turn, far above what it can be
    half += 1e-12 * (np.abs(middle) + half)
    return np.stack([middle - half, middle + half], axis=1)


def plain(forest: Forest) -> Placed:
    """The meshes of a forest where they are, one for each tree."""
    return Placed(
        tree=np.arange(forest.n_trees),
        moved=False,
        rotations=np.zeros((0, 3, 3)),
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
        tree_centers=forest.centers,
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
    counts = meshes.counts[meshes.tree]
    weights = np.minimum(counts[pairs[:, 0]], counts[pairs[:, 1]]) + 16

    def part(first: int, last: int) -> Any:
        return closest(meshes, pairs, first, last, limit, stop)

    found = gather(part, weights, workers)
    if not found:
        return np.zeros(0, np.int64), np.zeros(0), np.zeros((0, 2, 3))
    rows, distance, points = (np.concatenate(arrays) for arrays in zip(*found, strict=True))
    distance[distance <= TOLERANCE] = 0.0
    return rows, distance, points
