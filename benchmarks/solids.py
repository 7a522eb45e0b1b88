"""A generated scene of many parts in random poses, about 8,500 meshes and 7 million triangles at scale 1."""

from __future__ import annotations

import os
import platform

import numpy as np
from scipy.spatial.transform import Rotation

from cadgraph.scene import Floats, Ints, Scene

Mesh = tuple[Floats, Ints]


def lathe(profile: Floats, sides: int, closed: bool = False) -> Mesh:
    """A surface of revolution about z through the (radius, height) rows of a profile; open ends unless closed."""
    angles = np.arange(sides) * 2 * np.pi / sides
    ring = np.column_stack([np.cos(angles), np.sin(angles)])
    vertices = np.concatenate([np.column_stack([r * ring, np.full(sides, h)]) for r, h in profile])
    n = len(profile)
    i, j = np.meshgrid(np.arange(n if closed else n - 1), np.arange(sides), indexing="ij")
    a, b = i * sides + j, i * sides + (j + 1) % sides
    c, d = (i + 1) % n * sides + j, (i + 1) % n * sides + (j + 1) % sides
    quads = np.stack([a, b, d, a, d, c], -1).reshape(-1, 3)
    return vertices, quads.astype(np.int64)


def elbow(bend: float, radius: float, angle: float, segments: int, sides: int) -> Mesh:
    """An open quarter-like bend of a pipe."""
    along = np.linspace(0, angle, segments + 1)
    around = np.arange(sides) * 2 * np.pi / sides
    reach = bend + radius * np.cos(around)
    vertices = np.stack(
        [
            np.outer(np.cos(along), reach),
            np.outer(np.sin(along), reach),
            np.tile(radius * np.sin(around), (segments + 1, 1)),
        ],
        -1,
    ).reshape(-1, 3)
    return vertices, lathe(np.zeros((segments + 1, 2)), sides)[1]


def join(*meshes: Mesh) -> Mesh:
    """Several meshes as one."""
    starts = np.cumsum([0, *(len(v) for v, _ in meshes)])
    return (
        np.concatenate([v for v, _ in meshes]),
        np.concatenate([f + start for (_, f), start in zip(meshes, starts[:-1], strict=True)]),
    )


def box(x: float, y: float, z: float) -> Mesh:
    """A box about the origin."""
    corners = np.array([[i, j, k] for i in (-0.5, 0.5) for j in (-0.5, 0.5) for k in (-0.5, 0.5)])
    faces = [
        [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
        [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3],
    ]  # fmt: skip
    return corners * [x, y, z], np.array(faces)


def kinds() -> list[tuple[Mesh, int]]:
    """Distinct parts and how many of each there are at scale 1."""
    ring = [(0.03, 0.0), (0.06, 0.0), (0.06, 0.01), (0.03, 0.01)]
    bolt = join(
        lathe(np.array([(0.0, -0.03), (0.004, -0.03), (0.004, 0.0)]), 32),
        lathe(np.array([(0.004, 0.0), (0.008, 0.0), (0.008, 0.006), (0.0, 0.006)]), 6),
        lathe(np.column_stack([0.004 + 0.0003 * (np.arange(12) % 2), np.linspace(-0.028, -0.005, 12)]), 16),
    )
    grating = join(*(tuple_shift(box(1.0, 0.005, 0.03), (0, 0.03 * i, 0)) for i in range(40)))
    return [
        (bolt, 4500),
        (lathe(np.array(ring), 48, closed=True), 800),
        (lathe(np.array([(0.05, 0.0), (0.055, 0.0), (0.055, 2.0), (0.05, 2.0)]), 64, closed=True), 900),
        (elbow(0.15, 0.055, np.pi / 2, 24, 48), 900),
        (elbow(0.1, 0.03, np.pi, 40, 24), 500),
        (grating, 500),
        (lathe(np.column_stack([0.2 * np.sin(t := np.linspace(0.01, 3.13, 80)), -0.2 * np.cos(t)]), 80), 200),
        (box(6.0, 0.2, 0.2), 160),
    ]


def tuple_shift(mesh: Mesh, shift: tuple[float, float, float]) -> Mesh:
    """A mesh moved."""
    return mesh[0] + np.array(shift), mesh[1]


def build(scale: float = 1.0, seed: int = 0, posed: bool = True) -> Scene:
    """The scene: every part in a random pose (or only moved), in an order that mixes the kinds."""
    random = np.random.default_rng(seed)
    meshes = [mesh for mesh, count in kinds() for _ in range(max(1, round(count * scale)))]
    order = random.permutation(len(meshes))
    turns = Rotation.random(len(meshes), random_state=seed).as_matrix()
    shifts = random.uniform(-20, 20, (len(meshes), 3))
    return Scene.from_meshes(
        [((meshes[i][0] @ turns[i].T if posed else meshes[i][0]) + shifts[i], meshes[i][1]) for i in order]
    )


def machine() -> str:
    """One line that describes the machine without naming it."""
    return f"{platform.machine()}, {os.cpu_count()} processors, {platform.system()}, Python {platform.python_version()}"
