"""Which meshes lie inside others: the ball in the valve, the shaft in its housing.

'Inside' means enclosed by the surface: wherever one looks from the inner mesh, the outer one is in the way. That is
asked of points spread over the inner surface, each with rays in fixed directions all around; a point from which 90 %
of the rays meet the outer mesh is enclosed. So

- a ball in the cavity of a thick shell is inside, although the cavity is no part of the shell's material; the share
  of points within the material is given as a second figure;
- a shaft in an open-ended tube is inside as far as it lies more than about 1.3 tube radii from the open ends, where
  less than 10 % of the view is open;
- a part in the corner of three walls (12.5 % open), in a channel or in a box without a lid is not inside.

Open meshes need no repair for this. The share within the material follows from the signed crossings of the same
rays, which all agree for a closed mesh; where they don't, it is undecided (NaN).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadgraph.geometry.contact.broad import near_boxes
from cadgraph.geometry.contact.pairs import plain
from cadgraph.geometry.kernels.gather import gather
from cadgraph.geometry.kernels.parallel import for_ranges
from cadgraph.geometry.kernels.tree import Forest, build_forest
from cadgraph.geometry.visibility.ray import enclosure, sample_points
from cadgraph.model.scene import Floats, Ints, Scene

__all__ = ["Inside", "find_inside"]

_COVER = 0.9  # share of the view that must be blocked (ours; the corner of three walls blocks 0.875)

_AGREEMENT = 0.8  # share of rays with the same count of signed crossings (ours; grazing rays may err)

_POINTS = 24  # points on each inner mesh

_RAYS = 40  # directions from each point


@dataclass(frozen=True)
class Inside:
    """Pairs of meshes of which the second encloses the first.

    Args:
        pairs: ``(n, 2)`` inner and outer mesh, in ascending order.
        share: ``(n,)`` share of the inner surface that is enclosed, from the least share asked for to 1.
        in_material: ``(n,)`` share of the inner surface within the volume that a closed outer mesh bounds; NaN where
            the outer mesh is open or its faces are not turned alike, so that this is undecided.
    """

    pairs: Ints
    share: Floats
    in_material: Floats


def find_inside(scene: Scene, *, min_share: float = 0.5, workers: int | None = None) -> Inside:
    """Meshes that lie wholly or mostly inside another one, whether they touch it or not.

    Args:
        scene: all meshes.
        min_share: least share of the inner surface that must be enclosed; half of it by default ('mostly').
        workers: threads; all processors by default. The output does not depend on it.

    Returns:
        Every such pair: nested meshes are in all that are around them.

    Raises:
        ValueError: ``min_share`` is not within 0 (excluded) to 1, or ``workers`` is below 1.
    """
    if not 0 < min_share <= 1:
        raise ValueError(f"min_share is {min_share}; give a share above 0, at most 1")
    trees = build_forest(scene, workers)
    meshes = plain(trees)
    points = np.empty((scene.n_meshes, _POINTS, 3))
    for_ranges(lambda first, last: sample_points(meshes, first, last, points), trees.counts, workers)
    pairs = _candidates(trees, points, min_share, workers)
    directions = _directions(_RAYS)
    found = gather(
        lambda first, last: enclosure(
            meshes, pairs, first, last, points, directions, _COVER, min_share - 1e-9, _AGREEMENT
        ),
        np.ones(len(pairs), np.int64),
        workers,
    )
    shares = np.concatenate(found) if found else np.zeros((0, 2))
    keep = shares[:, 0] >= min_share - 1e-9
    return Inside(pairs[keep], shares[keep, 0], shares[keep, 1])


def _candidates(trees: Forest, points: Floats, min_share: float, workers: int | None) -> Ints:
    """Pairs (inner, outer) with enough of the inner points in the outer box, in ascending order."""
    near = near_boxes(trees.boxes, 0.0, workers)
    pairs = np.concatenate([near, near[:, ::-1]])
    kept = [np.zeros((0, 2), np.int64)]
    batch = 1 << 16  # bounds the memory
    for start in range(0, len(pairs), batch):
        some = pairs[start : start + batch]
        at, box = points[some[:, 0]], trees.boxes[some[:, 1]]
        within = ((at >= box[:, None, 0]) & (at <= box[:, None, 1])).all(axis=2).mean(axis=1)
        kept.append(some[within >= min_share - 1e-9])
    found = np.concatenate(kept)
    return np.ascontiguousarray(found[np.lexsort((found[:, 1], found[:, 0]))])


def _directions(n: int) -> Floats:
    """Unit vectors spread evenly over the sphere (Fibonacci), turned so that none is parallel to an axis or plane."""
    k = np.arange(n) + 0.5
    z = 1 - 2 * k / n
    angle = np.pi * (1 + 5**0.5) * k + 0.7
    around = np.sqrt(1 - z * z)
    return np.column_stack([around * np.cos(angle), around * np.sin(angle), z])
