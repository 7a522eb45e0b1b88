"""Simple closed meshes for tests: each function returns vertices (n, 3) [m] and triangles (m, 3), outward."""

from __future__ import annotations

import numpy as np


def box(size=(1.0, 1.0, 1.0), center=(0.0, 0.0, 0.0)):
    corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
    faces = np.array(
        [
            [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
            [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3],
        ]
    )  # fmt: skip
    return corners * np.asarray(size) + np.asarray(center), faces


def lathe(profile, sides=24, closed=False):
    """A surface of revolution about z through the (radius, height) points of a profile.

    The profile runs so that the outside lies to its right when seen in the (radius, height) plane going up
    the outer wall. Points of radius 0 become one vertex. ``closed`` joins the last point to the first.
    """
    profile = np.asarray(profile, float)
    angles = np.arange(sides) * 2 * np.pi / sides
    rings, vertices = [], []
    for radius, height in profile:
        if radius == 0:
            rings.append(np.full(sides, len(vertices)))
            vertices.append([0.0, 0.0, height])
        else:
            rings.append(np.arange(sides) + len(vertices))
            vertices.extend(np.column_stack([radius * np.cos(angles), radius * np.sin(angles), np.full(sides, height)]))
    faces = []
    pairs = list(zip(rings[:-1], rings[1:], strict=True)) + ([(rings[-1], rings[0])] if closed else [])
    for low, high in pairs:
        for i in range(sides):
            j = (i + 1) % sides
            if low[i] != low[j]:
                faces.append([low[i], low[j], high[j]])
            if high[i] != high[j]:
                faces.append([low[i], high[j], high[i]])
    return np.array(vertices), np.array(faces)


def cylinder(radius=0.5, height=1.0, sides=24):
    half = height / 2
    return lathe([(0, -half), (radius, -half), (radius, half), (0, half)], sides)


def tube(outer=0.5, inner=0.4, height=1.0, sides=24):
    half = height / 2
    return lathe([(inner, -half), (outer, -half), (outer, half), (inner, half)], sides, closed=True)


def sphere(radius=0.5, sides=24, rings=12):
    tilt = np.linspace(-np.pi / 2, np.pi / 2, rings + 1)
    profile = [(radius * np.cos(t), radius * np.sin(t)) for t in tilt]
    profile[0], profile[-1] = (0, -radius), (0, radius)
    return lathe(profile, sides)


def moved(mesh, rotation=np.eye(3), translation=(0.0, 0.0, 0.0)):
    vertices, faces = mesh
    return vertices @ np.asarray(rotation).T + np.asarray(translation), faces
