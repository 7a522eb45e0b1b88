"""Tubes for tests, in several ways that CAD systems make them."""

from __future__ import annotations

import numpy as np
from scipy.spatial import Delaunay


def pipe(path, radius, sides=16, bore=None, caps=False):
    """A tube along a polyline: rings in the planes that halve its corners.

    Args:
        path: (n, 3) points.
        radius: of the circle through the corners, one or one for each point.
        sides: of the ring.
        bore: radius of an inner wall, closed to the outer one by rings; none if missing.
        caps: close a solid one by discs.
    """
    path = np.asarray(path, float)
    outer = _rings(path, np.broadcast_to(radius, len(path)), sides)
    n = len(path)
    if bore is None:
        vertices = outer.reshape(-1, 3)
        faces = _walls(n, sides, False)
        if caps:
            vertices = np.concatenate([vertices, path[[0, -1]]])
            ring = np.arange(sides)
            after = (ring + 1) % sides
            low = np.column_stack([np.full(sides, n * sides), after, ring])
            high = np.column_stack([np.full(sides, n * sides + 1), ring + (n - 1) * sides, after + (n - 1) * sides])
            faces = np.concatenate([faces, low, high])
        return vertices, faces
    inner = _rings(path, np.broadcast_to(bore, len(path)), sides)
    return np.concatenate([outer, inner[::-1]]).reshape(-1, 3), _walls(2 * n, sides, True)


def _rings(path, radius, sides):
    steps = np.diff(path, axis=0)
    steps /= np.linalg.norm(steps, axis=1, keepdims=True)
    tangents = np.concatenate([steps[:1], steps[:-1] + steps[1:], steps[-1:]])
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    side = np.cross(steps[0], np.eye(3)[np.argmin(np.abs(steps[0]))])
    side /= np.linalg.norm(side)
    angles = np.arange(sides) * 2 * np.pi / sides
    ring = path[0] + radius[0] * (np.outer(np.cos(angles), side) + np.outer(np.sin(angles), np.cross(steps[0], side)))
    rings = [ring]
    for k in range(1, len(path)):
        # Along the step, onto the next plane; then to the next radius.
        step, normal = steps[k - 1], tangents[k]
        ring = ring + np.outer(((path[k] - ring) @ normal) / (step @ normal), step)
        ring = path[k] + (ring - path[k]) * (radius[k] / radius[k - 1])
        rings.append(ring)
    return np.array(rings)


def _walls(n_rings, sides, closed):
    i, j = np.meshgrid(np.arange(n_rings if closed else n_rings - 1), np.arange(sides), indexing="ij")
    a, b = i * sides + j, i * sides + (j + 1) % sides
    c, d = (i + 1) % n_rings * sides + j, (i + 1) % n_rings * sides + (j + 1) % sides
    return np.stack([a, b, d, a, d, c], -1).reshape(-1, 3)


def arc(radius, angle, n):
    """Points of a bend in the xy plane that starts at the origin along x."""
    t = np.linspace(0, angle, n + 1)
    return np.column_stack([radius * np.sin(t), radius * (1 - np.cos(t)), 0 * t])


def elbow(bend, radius, angle, segments, sides=16, bore=None):
    """A bend about z with its rings in planes through z, as CAD cuts a torus; a whole turn is closed."""
    t = np.linspace(0, angle, segments + 1)

    def wall(r):
        around = np.arange(sides) * 2 * np.pi / sides
        reach = bend + r * np.cos(around)
        height = np.tile(-r * np.sin(around), (segments + 1, 1))
        return np.stack([np.outer(np.cos(t), reach), np.outer(np.sin(t), reach), height], -1)

    if bore is None:
        return wall(radius).reshape(-1, 3), _walls(segments + 1, sides, False)
    rings = np.concatenate([wall(radius), wall(bore)[::-1]])
    return rings.reshape(-1, 3), _walls(2 * (segments + 1), sides, True)


def follow(*pieces):
    """Chains paths, each turned and moved to continue the one before."""
    path = np.asarray(pieces[0], float)
    for piece in pieces[1:]:
        piece = np.asarray(piece, float)
        heading = path[-1] - path[-2]
        start = piece[1] - piece[0]
        turn = _turn(start / np.linalg.norm(start), heading / np.linalg.norm(heading))
        path = np.concatenate([path, path[-1] + (piece[1:] - piece[0]) @ turn.T])
    return path


def _turn(a, b):
    v, c = np.cross(a, b), a @ b
    if c < -1 + 1e-12:
        return np.diag([-1.0, -1.0, 1.0])
    k = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return np.eye(3) + k + k @ k / (1 + c)


def helix(radius, pitch, turns, steps=36):
    t = np.linspace(0, turns * 2 * np.pi, round(turns * steps) + 1)
    return np.column_stack([radius * np.cos(t), radius * np.sin(t), pitch * t / (2 * np.pi)])


def scattered(radius, length, sides=16, n=200, seed=0):
    """A straight tube along x with vertices anywhere on its wall and triangles as they come."""
    random = np.random.default_rng(seed)
    edge = np.arange(sides + 1) / sides
    inside = np.column_stack([random.uniform(0.02, 0.98, n), random.uniform(0, 1, n)])
    around = inside[:, 1] * 2 * np.pi
    domain = np.concatenate([
        np.column_stack([np.zeros(sides + 1), edge]), np.column_stack([np.ones(sides + 1), edge]), inside
    ])  # fmt: skip
    triangles = Delaunay(domain * [length, 2 * np.pi * radius]).simplices
    around = domain[:, 1] * 2 * np.pi
    vertices = np.column_stack([domain[:, 0] * length, radius * np.cos(around), radius * np.sin(around)])
    return vertices, triangles


def tee(run_radius, branch_radius, half=1.0, height=1.0, sides=32, both=False):
    """A run along x with a branch along z (and -z) that opens into it, one wall without caps."""
    around = np.arange(sides) * 2 * np.pi / sides
    x, y = branch_radius * np.cos(around), branch_radius * np.sin(around)
    z = np.sqrt(np.maximum(run_radius**2 - y**2, 0))
    foot = np.column_stack([x, y, z])
    head = np.column_stack([x, y, np.full(sides, height)])
    ring = np.arange(sides)
    after = (ring + 1) % sides
    tube = np.concatenate(
        [np.column_stack([ring, after, after + sides]), np.column_stack([ring, after + sides, ring + sides])]
    )
    # The run is unrolled: position along it, angle from -z.
    angle = np.linspace(0, 2 * np.pi, sides + 1)
    grid = np.stack(np.meshgrid(np.linspace(-half, half, 9), angle, indexing="ij"), -1).reshape(-1, 2)
    holes = [np.pi, 0.0] if both else [np.pi]
    rims = []
    for middle in holes:
        rim = np.column_stack([x, middle + np.arcsin(np.clip(y / run_radius, -1, 1))])
        rims.append(rim)
        if middle == 0.0:
            rims.append(rim + np.array([0, 2 * np.pi]))

    def inside_hole(points, share):
        wide, deep = points[:, 0], run_radius * np.sin(points[:, 1])
        at = wide**2 + deep**2 < (share * branch_radius) ** 2
        return at & ((np.cos(points[:, 1]) < 0) | both)

    rim = np.concatenate(rims)
    rim = rim[(rim[:, 1] >= 0) & (rim[:, 1] <= 2 * np.pi)]
    domain = np.concatenate([grid[~inside_hole(grid, 1.1)], rim])
    triangles = Delaunay(domain * [1.0, run_radius]).simplices
    triangles = triangles[~inside_hole(domain[triangles].mean(axis=1), 1.0)]
    run = np.column_stack([domain[:, 0], run_radius * np.sin(domain[:, 1]), -run_radius * np.cos(domain[:, 1])])
    meshes = [(run, triangles), (np.concatenate([foot, head]), tube)]
    if both:
        meshes.append((np.concatenate([foot, head]) * [1, 1, -1], tube[:, ::-1]))
    starts = np.cumsum([0, *(len(v) for v, _ in meshes)])
    return (
        np.concatenate([v for v, _ in meshes]),
        np.concatenate([f + s for (_, f), s in zip(meshes, starts[:-1], strict=True)]),
    )


def soup(mesh):
    vertices, faces = mesh
    return vertices[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3)
