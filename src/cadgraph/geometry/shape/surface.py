"""The faces of each mesh, joined into flat patches and open rims."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.geometry.mesh.edges import edges_of, places_of
from cadgraph.model.parts import Bools, Properties
from cadgraph.model.scene import Floats, Ints, Scene, mesh_of_face

__all__ = ["LEVELS", "Level", "Surface", "equal_values", "find_surfaces"]

_WELD = 1e-6  # corners closer than this are one [m]
_THIN = 1e-9
_PLANE = 0.9998  # of a flat face the mean normal is as long; of one that bends by 2 degrees it is shorter
_MOST_AT_EDGE = 8
_STRAIGHT = 2e-5  # creases that turn by less than a third of a degree are one


@dataclass(frozen=True)
class Level:
    """How exact round faces must be.

    Args:
        parallel: faces whose normals have at least this cosine share a plane.
        rim: corners at this share of the greatest radius lie on the rim.
        bulge: no corner leaves the plane by more than this share of the radius.
        gap: greatest angle between neighbouring rim corners [rad].
    """

    parallel: float
    rim: float
    bulge: float
    gap: float


# A 128-sided pipe turns by 2.8 degrees a side, a 20-sided one by 18; six sides are 60 degrees apart. Parts without a
# round face get the second chance: scans and rough remeshing move corners by a millimetre; six sides could be a square
# there.
LEVELS = (
    Level(np.cos(np.radians(1.0)), 0.97, 0.02, np.radians(75.0)),
    Level(np.cos(np.radians(12.0)), 0.93, 0.08, np.radians(50.0)),
)
"""The strictest first."""


@dataclass(frozen=True)
class Surface:
    """The faces of one mesh.

    Args:
        triangles: ``(n, 3, 3)`` corners [m].
        normals: ``(n, 3)`` unit, outward where the mesh is closed.
        areas: ``(n,)`` [m2].
        middles: ``(n, 3)`` the middle of the flat face that each is of [m]: the same however that is cut up.
        patches: ``(len(LEVELS), n)`` the flat patch of each face.
        corners: ``(n, 3)`` whether each corner of a face is one of the shape: not where a plane or a straight edge is
            merely cut up.
        rims: its open rims, each as edges ``(m, 2, 3)`` [m].
        rim_corners: of each of these ``(m, 2)`` whether its ends are corners of the shape.
    """

    triangles: Floats
    normals: Floats
    areas: Floats
    middles: Floats
    patches: Ints
    corners: Bools
    rims: list[Floats]
    rim_corners: list[Bools]


def find_surfaces(scene: Scene, properties: Properties) -> list[Surface]:
    """The surface of each mesh of a scene.

    Args:
        scene: any; faces that are not finite are left out.
        properties: of its meshes.
    """
    triangles, owner = scene.triangles() + 0.0, mesh_of_face(scene)
    finite = np.isfinite(triangles).all(axis=(1, 2))
    triangles, owner = triangles[finite], owner[finite]
    cross = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    double = np.linalg.norm(cross, axis=1)
    normals = cross / np.maximum(double, _THIN**2)[:, None]
    patches, corners, rims = _flat_patches(triangles, normals, owner)
    middles = _middles(triangles, normals, double / 2, patches[0])
    offsets = np.searchsorted(owner, np.arange(scene.n_meshes + 1)).tolist()
    surfaces = []
    for mesh in range(scene.n_meshes):
        faces = slice(offsets[mesh], offsets[mesh + 1])
        inward = -1.0 if properties.closed[mesh] and properties.volume[mesh] < 0 else 1.0
        loops = rims.get(mesh, [])
        surfaces.append(
            Surface(
                triangles[faces], normals[faces] * inward, double[faces] / 2, middles[faces], patches[:, faces],
                corners[faces], [lines for lines, _ in loops], [ends for _, ends in loops],
            )
        )  # fmt: skip
    return surfaces


def _middles(triangles: Floats, normals: Floats, areas: Floats, patch: Ints) -> Floats:
    """The middles of the patches that faces are of; of a patch that bends, a face's own."""
    own = triangles.mean(axis=1)
    whole = np.maximum(np.bincount(patch, weights=areas), _THIN**2)[:, None]
    middle = np.stack([np.bincount(patch, weights=areas * own[:, d]) for d in range(3)], axis=1)
    normal = np.stack([np.bincount(patch, weights=areas * normals[:, d]) for d in range(3)], axis=1)
    # Faces that turn little by little are joined, too: their triangles speak for themselves.
    flat = np.linalg.norm(normal / whole, axis=1) > _PLANE
    return np.where(flat[patch][:, None], (middle / whole)[patch], own)


_Rims = dict[int, list[tuple[Floats, Bools]]]


def _flat_patches(triangles: Floats, normals: Floats, owner: Ints) -> tuple[Ints, Bools, _Rims]:
    """Joins faces that share an edge and a plane, and edges without a partner into rims.

    Returns:
        The patch ``(n_levels, n_faces)`` of each face; which of its corners ``(n_faces, 3)`` are corners of the shape;
        and for each mesh its rims, each ``(n, 2, 3)`` edges and which of their ends are corners.
    """
    n = len(triangles)
    if n == 0:
        return np.zeros((len(LEVELS), 0), np.int64), np.zeros((0, 3), np.bool_), {}
    corner = places_of(triangles.reshape(-1, 3) / _WELD, owner)
    edges = edges_of(corner)
    first, second = _meeting(np.repeat(np.arange(len(edges.sizes)), edges.sizes))
    first, second = edges.sides[first], edges.sides[second]
    a, b = first // 3, second // 3
    cosine = np.abs(np.einsum("ij,ij->i", normals[a], normals[b]))
    patches = np.empty((len(LEVELS), n), np.int64)
    for row, level in enumerate(LEVELS):
        flat = cosine > level.parallel
        links = coo_array((np.ones(int(flat.sum()), np.int8), (a[flat], b[flat])), shape=(n, n))
        patches[row] = connected_components(links, directed=False)[1]
    free = edges.sides[edges.starts[:-1][edges.sizes == 1]]
    free = free[corner[free // 3, free % 3] != corner[free // 3, (free + 1) % 3]]
    sharp = cosine <= LEVELS[0].parallel
    corners = np.empty((n, 3), np.bool_)
    places = np.zeros((int(corner.max()) + 1, 7))
    _find_corners(triangles, corner, np.concatenate([first[sharp], free]), places, corners)
    return patches, corners, _find_rims(triangles, owner, corner, free, corners)


def _meeting(edge: Ints) -> tuple[Ints, Ints]:
    """Which rows have an edge in common: each with each, so that the order of the faces at an edge doesn't matter.

    Args:
        edge: ``(n,)`` numbers of edges, ascending.

    Returns:
        Two rows of each pair. Of edges of more than ``_MOST_AT_EDGE`` faces only nearer rows are paired.
    """
    pairs = []
    for apart in range(1, _MOST_AT_EDGE):
        rows = np.flatnonzero(edge[apart:] == edge[:-apart])
        if not len(rows):
            break
        pairs.append((rows, rows + apart))
    if not pairs:
        return np.zeros(0, np.int64), np.zeros(0, np.int64)
    return np.concatenate([p for p, _ in pairs]), np.concatenate([q for _, q in pairs])


@compiled
def _find_corners(triangles: Any, corner: Any, creases: Any, places: Any, corners: Any) -> None:
    """Finds which corners of faces are ends of creases in more than one direction.

    Args:
        triangles: ``(n, 3, 3)`` [m].
        corner: ``(n, 3)`` the place of each.
        creases: edges, numbered by face and corner, where the surface turns or ends.
        places: ``(n_places, 7)`` zeros: how many creases end at each place, and the products of their directions.
        corners: ``(n, 3)`` the outcome.
    """
    for c in range(len(creases)):
        f, k = creases[c] // 3, creases[c] % 3
        m = (k + 1) % 3
        x, y = triangles[f, m, 0] - triangles[f, k, 0], triangles[f, m, 1] - triangles[f, k, 1]
        z = triangles[f, m, 2] - triangles[f, k, 2]
        square = max(x * x + y * y + z * z, _THIN**4)
        for end in range(2):
            place = corner[f, k] if end == 0 else corner[f, m]
            places[place, 0] += 1.0
            places[place, 1] += x * x / square
            places[place, 2] += y * y / square
            places[place, 3] += z * z / square
            places[place, 4] += x * y / square
            places[place, 5] += x * z / square
            places[place, 6] += y * z / square
    for f in range(len(corner)):
        for k in range(3):
            place = corner[f, k]
            count, squares = places[place, 0], 0.0
            for i in range(1, 7):
                squares += places[place, i] ** 2 * (1.0 if i < 4 else 2.0)
            # All squared cosines between the creases that meet add up to count squared where they run along one line.
            corners[f, k] = count > 0 and (count == 1 or squares < (1 - _STRAIGHT) * count * count)


def _find_rims(triangles: Floats, owner: Ints, corner: Ints, free: Ints, corners: Bools) -> _Rims:
    """For each mesh its loops of at least five edges without a partner, each ``(m, 2, 3)``, and their corners."""
    rims: _Rims = {}
    if not len(free):
        return rims
    tail, head = free // 3, free % 3
    ends = np.stack([corner[tail, head], corner[tail, (head + 1) % 3]], axis=1)
    points, inverse = np.unique(ends, return_inverse=True)
    inverse = inverse.reshape(-1, 2)
    loops = coo_array((np.ones(len(free), np.int8), (inverse[:, 0], inverse[:, 1])), shape=(len(points),) * 2)
    loop = connected_components(loops, directed=False)[1].astype(np.int64)[inverse[:, 0]]
    for edges in equal_values(loop, 5):
        f, k = tail[edges], head[edges]
        lines = np.stack([triangles[f, k], triangles[f, (k + 1) % 3]], axis=1)
        meant = np.stack([corners[f, k], corners[f, (k + 1) % 3]], axis=1)
        rims.setdefault(int(owner[f[0]]), []).append((lines, meant))
    return rims


def equal_values(values: Ints, least: int) -> list[Ints]:
    """The positions of each distinct value that occurs at least so often, ascending."""
    order = np.argsort(values, kind="stable")
    starts = np.concatenate([[0], np.nonzero(np.diff(values[order]))[0] + 1, [len(values)]])
    return [order[i:j] for i, j in zip(starts[:-1].tolist(), starts[1:].tolist(), strict=True) if j - i >= least]
