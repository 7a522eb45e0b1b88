"""What tests of generated geometry share."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components


def is_closed(solid):
    """Every directed edge once, and its reverse once."""
    faces = solid.faces.astype(np.int64)
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    n = len(solid.vertices)
    forward, backward = edges[:, 0] * n + edges[:, 1], edges[:, 1] * n + edges[:, 0]
    return len(np.unique(forward)) == len(forward) and np.array_equal(np.sort(forward), np.sort(backward))


def shell_volumes(solid):
    """The signed volume of each connected shell."""
    faces = solid.faces.astype(np.int64)
    n = len(solid.vertices)
    links = coo_matrix((np.ones(len(faces) * 2), (faces[:, [0, 1]].ravel(), faces[:, [1, 2]].ravel())), shape=(n, n))
    _, shell = connected_components(links, directed=False)
    a, b, c = np.moveaxis((solid.vertices - solid.vertices.mean(axis=0))[faces], 1, 0)
    parts = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6
    return np.bincount(np.unique(shell[faces[:, 0]], return_inverse=True)[1], parts)


def shells(solid):
    """The corners of each connected shell, ``(n, 3)``."""
    faces = solid.faces.astype(np.int64)
    n = len(solid.vertices)
    links = coo_matrix((np.ones(len(faces) * 2), (faces[:, [0, 1]].ravel(), faces[:, [1, 2]].ravel())), shape=(n, n))
    shell = connected_components(links, directed=False)[1]
    return [np.asarray(solid.vertices)[shell == one] for one in np.unique(shell[faces[:, 0]])]


def least_edge(solid):
    """The shortest edge [m]."""
    tri = solid.vertices[solid.faces]
    return float(np.linalg.norm(tri - np.roll(tri, 1, axis=1), axis=2).min())


def touching(plant, margin=1e-6):
    """All pairs of components whose surfaces come within the margin, by an independent library."""
    import fcl

    bodies = []
    for component in plant.components:
        model = fcl.BVHModel()
        model.beginModel(len(component.vertices), len(component.faces))
        model.addSubModel(np.ascontiguousarray(component.vertices), np.ascontiguousarray(component.faces))
        model.endModel()
        bodies.append(fcl.CollisionObject(model, fcl.Transform()))
    low = np.array([c.vertices.min(axis=0) for c in plant.components]) - margin
    high = np.array([c.vertices.max(axis=0) for c in plant.components]) + margin
    pairs = {}
    for i in range(len(bodies)):
        near = np.flatnonzero((low[i] <= high).all(axis=1) & (high[i] >= low).all(axis=1))
        for j in near[near > i]:
            if fcl.collide(bodies[i], bodies[j], fcl.CollisionRequest(), fcl.CollisionResult()):
                pairs[(i, int(j))] = 0.0
                continue
            gap = fcl.distance(bodies[i], bodies[j], fcl.DistanceRequest(), fcl.DistanceResult())
            if gap <= margin:
                pairs[(i, int(j))] = gap
    return pairs
