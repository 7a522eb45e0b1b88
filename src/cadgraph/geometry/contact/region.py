"""The extent of contacts: where two meshes face each other within the contact distance.

For every two triangles that are near, each is projected onto the plane of the other along that plane's normal; the
part of the projection that lies on the other and within ``eps`` of it is a polygon, exact to rounding. Polygons tilted
to each other count by their projected area, so that side walls that merely start at a contact weigh nothing. What
meets in sides or points only has no such polygon; there the parts of sides within ``eps`` over a face count by their
length, and failing these the closest points.

Only faces turned towards each other count, as long as there are any: the far side of a thin sheet does not.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from cadgraph.geometry.contact.clip import MOMENTS, SIDES, contact_measures
from cadgraph.geometry.contact.pairs import plain
from cadgraph.geometry.kernels.gather import gather
from cadgraph.geometry.kernels.tree import Forest, build_forest
from cadgraph.geometry.kernels.triangle import TOLERANCE
from cadgraph.model.parts import Contacts
from cadgraph.model.scene import Floats, Scene

__all__ = ["Regions", "contact_regions"]

_LASTING = 0.6
# Least share of the facing area that is left at a quarter of the gap for a contact to have an area: a line keeps
# 1/2, a point or an edge 1/4, faces keep all of it.

_LEAST_SPAN = 1e-3  # least range of gaps over which that is judged, as share of eps

_THIN = 1e-3  # faces that face each other on less than this share of eps squared are left to the sides

_ROUND = 1e-6  # normals that cancel out to less than this share have no mean


@dataclass(frozen=True)
class Regions:
    """Where and how far each pair of meshes is in contact, one row for each pair.

    Args:
        centroid: ``(n, 3)`` of the facing parts of both surfaces, midway between them [m].
        normal: ``(n, 3)`` unit mean normal of these, from the first mesh to the second. Where the parts face all
            ways (a sleeve on a pipe) the mean vanishes: then the direction from the first mesh's centre to the
            second's, or +z for concentric ones.
        flatness: ``(n,)`` length of that mean before it was made unit, 0..1: 1 for flat contacts, 0 for sleeves.
        area: ``(n,)`` facing area [m2]; 0 where the surfaces touch only in lines or points.
        extents: ``(n, 3)`` along the region's own principal axes, descending [m]: the side lengths of the box that has
            the same second moments when filled evenly. Exact for straight lines and rectangles; 1.22 times the
            diameter for a ring.
        axes: ``(n, 3, 3)`` these axes as rows, right-handed.
    """

    centroid: Floats
    normal: Floats
    flatness: Floats
    area: Floats
    extents: Floats
    axes: Floats

    @property
    def length(self) -> Floats:
        """``(n,)`` the greatest extent [m]."""
        return self.extents[:, 0]


def contact_regions(
    scene: Scene,
    contacts: Contacts,
    eps: float = 0.01,
    *,
    forest: Forest | None = None,
    workers: int | None = None,
) -> Regions:
    """The extent of contacts.

    Args:
        scene: all meshes.
        contacts: pairs of meshes within ``eps``.
        eps: as used to find them [m].
        forest: the trees of this scene, if built before.
        workers: threads; all processors by default. The output does not depend on it.

    Returns:
        One row for each contact. The area is that of surfaces that stay in contact as the gap closes: if less than
        60 % of the facing area within ``eps`` is left within a quarter of it (counted from the closest points), the
        surfaces curve or tilt away from a line or point, and the area is 0. A line contact keeps half (the width
        goes with the root of the gap), a point or an edge a quarter.

    Raises:
        ValueError: ``eps`` is negative or not finite, or ``workers`` is below 1.
    """
    if not (eps >= 0 and np.isfinite(eps)):
        raise ValueError(f"eps is {eps}; give a distance in metres, 0 or more")
    trees = forest if forest is not None else build_forest(scene, workers)
    meshes = plain(trees)
    pairs = np.ascontiguousarray(contacts.pairs, np.int64)
    distance = np.ascontiguousarray(contacts.distance, np.float64)
    points = np.ascontiguousarray(contacts.points, np.float64)
    slack = max(_LEAST_SPAN * eps, 1e-6)

    def part(first: int, last: int) -> Any:
        return contact_measures(meshes, pairs, distance, points, first, last, eps + TOLERANCE, slack)

    weights = np.minimum(trees.counts[pairs[:, 0]], trees.counts[pairs[:, 1]]) + 16
    found = gather(part, weights, workers)
    measures = np.concatenate(found) if found else np.zeros((0, 3, MOMENTS))
    return _regions(measures, points, trees.centers[pairs[:, 1]] - trees.centers[pairs[:, 0]], eps)


def _regions(measures: Floats, points: Floats, apart: Floats, eps: float) -> Regions:
    """Chooses for each pair the first measure that is worth something, and derives the rest from it."""
    n = len(measures)
    rows = np.arange(n)
    worth = measures[:, :, 0] > np.array([_THIN * eps * eps, _THIN * eps * eps, 0.0])
    kind = np.argmax(worth, axis=1)
    of_points = np.logical_not(np.logical_or.reduce(worth, axis=1))
    chosen = measures[rows, kind]
    weight = np.where(of_points, 1.0, chosen[:, 0])
    mean = np.where(of_points[:, None], 0.5 * (points[:, 1] - points[:, 0]), chosen[:, 1:4] / weight[:, None])
    second = chosen[:, [4, 5, 6, 5, 7, 8, 6, 8, 9]].reshape(n, 3, 3) / weight[:, None, None]
    second = np.where(of_points[:, None, None], 0.0, second - mean[:, :, None] * mean[:, None, :])
    spread, vectors = np.linalg.eigh(second)
    axes = np.swapaxes(vectors, 1, 2)[:, ::-1].copy()
    axes[np.linalg.det(axes) < 0] *= -1.0

    between = points[:, 1] - points[:, 0]
    sums = np.where(of_points[:, None], between, chosen[:, 10:13])
    size = np.where(of_points, np.linalg.norm(between, axis=1), weight)
    flatness = np.linalg.norm(sums, axis=1) / np.where(size > 0, size, 1.0)
    normal = _first_direction(np.where(flatness[:, None] > _ROUND, sums, 0.0), apart)
    lasting = (kind != SIDES) & ~of_points & (chosen[:, 13] >= _LASTING * chosen[:, 0])
    return Regions(
        centroid=mean + points[:, 0],
        normal=normal,
        flatness=np.minimum(flatness, 1.0),
        # each of the two surfaces was measured
        area=np.where(lasting, 0.5 * chosen[:, 13], 0.0),
        extents=np.sqrt(12.0 * np.maximum(spread[:, ::-1], 0.0)),
        axes=axes,
    )


def _first_direction(*choices: Floats) -> Floats:
    """The first of several vectors that has a length, made unit; +z if none has."""
    found = np.tile([0.0, 0.0, 1.0], (len(choices[0]), 1))
    for vectors in reversed(choices):
        length = np.linalg.norm(vectors, axis=1)
        there = length > 1e-12
        found[there] = vectors[there] / length[there, None]
    return found
