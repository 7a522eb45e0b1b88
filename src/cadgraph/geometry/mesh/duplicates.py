"""Meshes that lie in the place of another one, and what else is odd about a scene's geometry."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from cadgraph.geometry.components import first_of_component
from cadgraph.geometry.kernels.parallel import n_threads
from cadgraph.geometry.shape.alignment import fits_in_place, weld
from cadgraph.geometry.shape.repeats import position_tolerance
from cadgraph.geometry.shape.similarity import corners_of, deviation, sample_surface
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.parts import Bools, Properties
from cadgraph.model.scene import Floats, Ints, Scene

__all__ = ["Duplicates", "find_duplicates", "findings"]

# Near duplicates: corners of the boxes may be this share of the size apart, ...
_BOX_APART = 0.05
# ... areas may differ by this share, ...
_AREA_APART = 0.1
# ... and surfaces may deviate by this share of the middle extent (root mean square). Ours: 12 against 48 sides
# deviate by 0.008, and two plates on each other by their thickness.
_SURFACE_APART = 0.015
_N_SAMPLES = 96


@dataclass(frozen=True)
class Duplicates:
    """Meshes that repeat another one in the same place.

    Args:
        of: ``(n_meshes,)`` the first mesh with exactly the same geometry in the same place, whatever its order of
            vertices and faces; the mesh itself if there is none before it.
        near: ``(n_pairs, 2)`` pairs that lie in the same place but are made of other triangles, first < second.
    """

    of: Ints
    near: Ints

    @property
    def exact(self) -> Bools:
        """``(n_meshes,)`` whether a mesh is an exact duplicate of an earlier one."""
        repeated: Bools = self.of != np.arange(len(self.of))
        return repeated


def find_duplicates(scene: Scene, properties: Properties) -> Duplicates:
    """Finds exact and near duplicates.

    Exact duplicates share every position within the tolerance of equal shapes; near ones the box, the area and,
    sampled both ways, the surface.

    Args:
        scene: any.
        properties: of its meshes.

    Returns:
        The duplicates; meshes without area have none.
    """
    n = scene.n_meshes
    tolerance = position_tolerance(properties)
    boxes = properties.aabb.reshape(n, 6)
    usable = np.flatnonzero((properties.area > 0) & np.isfinite(boxes).all(axis=1))
    size = properties.obb_extents[:, 0]
    pairs = _near_pairs(boxes[usable], _BOX_APART * size[usable])
    pairs = np.sort(usable[pairs], axis=1) if len(pairs) else np.zeros((0, 2), np.int64)
    pairs = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]
    area = properties.area
    alike = np.abs(area[pairs[:, 0]] - area[pairs[:, 1]]) <= _AREA_APART * area[pairs].max(axis=1, initial=0.0)
    exact, near = [], []
    same_of = np.arange(n)
    for a, b in pairs[alike]:
        if same_of[b] != b:
            continue
        if _is_exact(scene, properties, tolerance, int(a), int(b)):
            exact.append((a, b))
            same_of[b] = same_of[a]
        elif same_of[a] == a and _is_near(scene, properties, int(a), int(b)):
            near.append((a, b))
    return Duplicates(first_of_component(n, exact), np.array(near, np.int64).reshape(-1, 2))


def _near_pairs(points: Floats, reach: Floats) -> Ints:
    """Pairs of points within the lesser of their reaches of each other in every coordinate."""
    if len(points) < 2:
        return np.zeros((0, 2), np.int64)
    tree = cKDTree(points)
    # Few have anybody near: who does is counted by threads, and only theirs become lists.
    number = tree.query_ball_point(points, reach, p=np.inf, return_length=True, workers=n_threads())
    crowded = np.flatnonzero(number > 1)
    found: list[tuple[int, int]] = []
    around = tree.query_ball_point(points[crowded], reach[crowded], p=np.inf)
    for i, neighbours in zip(crowded.tolist(), around, strict=True):
        found += [(min(i, j), max(i, j)) for j in neighbours if j != i]
    pairs = np.unique(np.array(found, np.int64).reshape(-1, 2), axis=0)
    gap = np.abs(points[pairs[:, 0]] - points[pairs[:, 1]]).max(axis=1, initial=0.0)
    near: Ints = pairs[gap <= np.minimum(reach[pairs[:, 0]], reach[pairs[:, 1]])]
    return near


def _is_exact(scene: Scene, properties: Properties, tolerance: Floats, a: int, b: int) -> bool:
    if properties.n_triangles[a] != properties.n_triangles[b]:
        return False
    limit = float(max(tolerance[a], tolerance[b]))
    welded = []
    for mesh in (a, b):
        vertices, faces = scene.mesh(mesh)
        spots, normals, reach = np.empty_like(vertices), np.empty_like(vertices), np.empty((len(vertices), 2))
        n = weld(vertices, faces, properties.centroid[a], limit, spots, normals, reach)
        welded.append((spots[:n], normals[:n]))
    return bool(fits_in_place(*welded[0], *welded[1], limit))


def _is_near(scene: Scene, properties: Properties, a: int, b: int) -> bool:
    first, second = corners_of(scene, a), corners_of(scene, b)
    limit = _SURFACE_APART * float(min(properties.obb_extents[a, 1], properties.obb_extents[b, 1]))
    # Thin plates on each other are two plates.
    thin = float(min(properties.obb_extents[a, 2], properties.obb_extents[b, 2]))
    limit = min(limit, 0.25 * thin) if thin > 0 else limit
    if deviation(sample_surface(first, _N_SAMPLES), second) > limit:
        return False
    return deviation(sample_surface(second, _N_SAMPLES), first) <= limit


def findings(
    scene: Scene,
    properties: Properties,
    duplicates: Duplicates | None = None,
    visible: Bools | None = None,
) -> tuple[Diagnostic, ...]:
    """What a person should know about the meshes; nothing is changed or dropped here.

    Codes: ``empty-mesh``, ``nonfinite-vertices``, ``degenerate-faces``, ``open-mesh`` (a count, since most CAD has
    many), ``inside-out-mesh``, ``duplicate-mesh``, ``near-duplicate-mesh``, ``hidden-mesh``.

    Args:
        scene: any.
        properties: of its meshes.
        duplicates: if looked for.
        visible: ``(n_meshes,)`` if looked for.

    Returns:
        One diagnostic for each kind, with its meshes in order of index; duplicates one for each mesh or pair.
    """
    found: list[Diagnostic] = []

    def note(code: str, which: Bools, message: str) -> None:
        meshes = tuple(scene.paths[i] for i in np.flatnonzero(which))
        if meshes:
            plural = "mesh" if len(meshes) == 1 else "meshes"
            found.append(Diagnostic(code, f"{len(meshes)} {plural} {message}", meshes))

    bare = (properties.area <= 0) & (properties.n_nonfinite == 0)
    note("empty-mesh", bare, "without any surface")
    bad = int(properties.n_nonfinite.sum())
    note(
        "nonfinite-vertices",
        properties.n_nonfinite > 0,
        f"with {bad} NaN or infinite vertices, whose faces are left out",
    )
    flat = properties.n_degenerate * (properties.area > 0)
    note("degenerate-faces", flat > 0, f"with {int(flat.sum())} triangles that have no area or a missing corner")
    note("inside-out-mesh", properties.closed & (properties.volume < 0), "closed but with faces that look inward")
    n_open = int(np.count_nonzero(~properties.closed & (properties.area > 0)))
    if n_open:
        found.append(
            Diagnostic("open-mesh", f"{n_open} of {scene.n_meshes} meshes are not closed, so have no true volume")
        )
    if duplicates is not None:
        for i in np.flatnonzero(duplicates.exact):
            other = scene.paths[duplicates.of[i]]
            found.append(
                Diagnostic("duplicate-mesh", f"{scene.paths[i]} repeats {other} in place", (scene.paths[i], other))
            )
        for a, b in duplicates.near:
            meshes = (scene.paths[a], scene.paths[b])
            found.append(Diagnostic("near-duplicate-mesh", f"{meshes[1]} lies in the place of {meshes[0]}", meshes))
    if visible is not None:
        note("hidden-mesh", ~visible & (properties.area > 0), "can't be seen from anywhere outside")
    return tuple(found)
