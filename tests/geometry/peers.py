"""Distances of meshes by two other libraries and by brute force, to check ours against."""

from __future__ import annotations

import numpy as np
import pytest

from geometry import oracle


def brute_force(first, second):
    """The distance of two meshes by the oracle over all pairs of faces."""
    p, q = first[0][first[1]], second[0][second[1]]
    return oracle.distances(np.repeat(p, len(q), axis=0), np.tile(q, (len(p), 1, 1))).min()


def coal_distance(meshes):
    """A function of two mesh indices, by coal's box hierarchy."""
    coal = pytest.importorskip("coal")
    models = []
    for vertices, faces in meshes:
        model = coal.BVHModelOBBRSS()
        model.beginModel(len(faces), len(vertices))
        model.addVertices(np.asarray(vertices, float))
        model.addTriangles(np.asarray(faces, np.int64))
        model.endModel()
        models.append(model)
    still = coal.Transform3s.Identity()

    def distance(i, j):
        result = coal.DistanceResult()
        found = coal.distance(models[i], still, models[j], still, coal.DistanceRequest(), result)
        return max(found, 0.0)

    return distance


def fcl_distance(meshes):
    """A function of two mesh indices, by fcl's box hierarchy."""
    fcl = pytest.importorskip("fcl")
    bodies = []
    for vertices, faces in meshes:
        model = fcl.BVHModel()
        model.beginModel(len(vertices), len(faces))
        model.addSubModel(np.asarray(vertices, float), np.asarray(faces, np.int64))
        model.endModel()
        bodies.append(fcl.CollisionObject(model, fcl.Transform()))

    def distance(i, j):
        return max(fcl.distance(bodies[i], bodies[j], fcl.DistanceRequest(), fcl.DistanceResult()), 0.0)

    return distance
