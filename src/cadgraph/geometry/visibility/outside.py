"""Which meshes can be seen from outside."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.contact.broad import box_trees
from cadgraph.geometry.contact.pairs import plain
from cadgraph.geometry.kernels.parallel import for_ranges
from cadgraph.geometry.kernels.tree import Forest, build_forest
from cadgraph.geometry.visibility.occlusion import count_seen
from cadgraph.model.parts import Bools
from cadgraph.model.scene import Floats, Scene

__all__ = ["find_visible", "visible_share"]

# Rays start this far off a surface, as share of the scene's size: many files hold single precision, which has 6e-8.
_OFF = 2e-6


def find_visible(
    scene: Scene,
    n_points: int = 64,
    n_directions: int = 64,
    *,
    forest: Forest | None = None,
    workers: int | None = None,
) -> Bools:
    """Whether each mesh can be seen from anywhere outside the scene.

    A mesh is visible if from one of its sample points a ray gets out without meeting any surface, this mesh's own
    included: a point inside its own closed pipe is not seen. Both sides of a face count, since CAD faces often look
    the wrong way. The test stops for a mesh at its first free ray.

    Args:
        scene: any.
        n_points: sample points of each mesh, spread evenly over its area.
        n_directions: rays from each, spread evenly over the sphere.
        forest: the trees of this scene, if built before.
        workers: threads; all processors by default. The outcome does not depend on it.

    Returns:
        ``(n_meshes,)``; meshes without area are not visible.

    Raises:
        ValueError: ``n_points``, ``n_directions`` or ``workers`` is below 1.
    """
    return visible_share(scene, n_points, n_directions, True, forest=forest, workers=workers) > 0


def visible_share(
    scene: Scene,
    n_points: int = 64,
    n_directions: int = 64,
    first_only: bool = False,
    *,
    forest: Forest | None = None,
    workers: int | None = None,
) -> Floats:
    """Share of the sample points of each mesh that can be seen from outside.

    Args:
        scene: any.
        n_points: sample points of each mesh, spread evenly over its area.
        n_directions: rays from each, spread evenly over the sphere.
        first_only: stop for a mesh at its first visible point; the share is then only known to be above 0.
        forest: the trees of this scene, if built before.
        workers: threads; all processors by default. The outcome does not depend on it.

    Returns:
        ``(n_meshes,)`` 0..1; 0 for meshes without area.

    Raises:
        ValueError: ``n_points``, ``n_directions`` or ``workers`` is below 1.
    """
    if n_points < 1 or n_directions < 1:
        raise ValueError(f"n_points is {n_points} and n_directions {n_directions}; give at least 1 of each")
    trees = forest if forest is not None else build_forest(scene, workers)
    seen = np.zeros(scene.n_meshes, np.int64)
    known = np.isfinite(trees.boxes).all(axis=(1, 2))
    if not known.any():
        return seen / n_points
    tops, meshes = box_trees(trees.boxes), plain(trees)
    size = float((trees.boxes[known, 1].max(axis=0) - trees.boxes[known, 0].min(axis=0)).max())
    directions = _directions(n_directions)

    def look(first: int, last: int) -> None:
        count_seen(meshes, tops, first, last, n_points, directions, _OFF * size, first_only, seen)

    for_ranges(look, trees.counts, workers)
    return seen / n_points


def _directions(n: int) -> Floats:
    """Unit vectors spread evenly over the sphere (Fibonacci lattice), in bit-reversed order."""
    k = np.arange(n)
    z = 1.0 - (2.0 * k + 1.0) / n
    angle = np.pi * (1.0 + np.sqrt(5.0)) * k
    radius = np.sqrt(1.0 - z * z)
    directions = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), z])
    bits = max(1, int(n - 1).bit_length())
    order = np.argsort([int(f"{i:0{bits}b}"[::-1], 2) for i in range(n)], kind="stable")
    jumping: Floats = directions[order]
    return jumping
