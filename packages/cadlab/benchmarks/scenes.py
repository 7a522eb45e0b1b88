"""Generated scenes for the contact benchmarks: a plant of mixed kind, its tiling, and hostile ones."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from cadgraph.model.scene import Floats, Ints, MeshArrays, Scene

Mesh = tuple[Floats, Ints]


def lathe(profile: list[tuple[float, float]], sides: int, closed: bool = False) -> Mesh:
    """A surface of revolution about z through (radius, height) points; open ends unless closed."""
    rings = np.array(profile)
    angles = np.arange(sides) * 2 * np.pi / sides
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    vertices = np.concatenate([np.column_stack([r * circle, np.full(sides, h)]) for r, h in rings])
    return vertices, _quads(len(rings), sides, closed)


def _quads(n_rings: int, sides: int, closed: bool) -> Ints:
    i, j = np.meshgrid(np.arange(n_rings if closed else n_rings - 1), np.arange(sides), indexing="ij")
    a, b = i * sides + j, i * sides + (j + 1) % sides
    c, d = (i + 1) % n_rings * sides + j, (i + 1) % n_rings * sides + (j + 1) % sides
    return np.stack([a, b, d, a, d, c], -1).reshape(-1, 3)


def tube(outer: float, inner: float, length: float, sides: int, rings: int = 1) -> Mesh:
    """A tube along z from 0, its walls cut into rings."""
    heights = np.linspace(0, length, rings + 1)
    return lathe([*((outer, h) for h in heights), *((inner, h) for h in heights[::-1])], sides, closed=True)


def sphere(radius: float, sides: int, rings: int) -> Mesh:
    """A sphere with a tiny hole at each pole."""
    tilt = np.linspace(-np.pi / 2 + 1e-4, np.pi / 2 - 1e-4, rings + 1)
    return lathe([(radius * np.cos(t), radius * np.sin(t)) for t in tilt], sides)


def bolt(sides: int = 16) -> Mesh:
    """A bolt M8 x 30 with a ridged shank and a hexagonal head, 30 * sides + 36 triangles."""
    shank = [(0.004 + 0.0003 * (k % 2), -0.03 + 0.002 * k) for k in range(15)]
    return join(
        lathe([(1e-6, -0.03), *shank], sides),
        lathe([(0.004, 0.0), (0.0075, 0.0), (0.0075, 0.006), (1e-6, 0.006)], 6),
    )


def elbow(bend: float, radius: float, segments: int, sides: int) -> Mesh:
    """A quarter bend of a pipe, open at both ends, from +z towards +x."""
    along = np.linspace(0, np.pi / 2, segments + 1)
    around = np.arange(sides) * 2 * np.pi / sides
    reach = bend + radius * np.cos(around)
    vertices = np.stack(
        [
            bend - np.outer(np.cos(along), reach),
            np.tile(radius * np.sin(around), (segments + 1, 1)),
            np.outer(np.sin(along), reach),
        ],
        -1,
    )
    return vertices.reshape(-1, 3), _quads(segments + 1, sides, False)


def box(x: float, y: float, z: float) -> Mesh:
    """A box about the origin."""
    corners = np.array([[i, j, k] for i in (-0.5, 0.5) for j in (-0.5, 0.5) for k in (-0.5, 0.5)])
    faces = [
        [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
        [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3],
    ]  # fmt: skip
    return corners * [x, y, z], np.array(faces)


def plate(length: float, width: float, columns: int, rows: int) -> Mesh:
    """A flat grid in z = 0 from the origin."""
    x, y = np.meshgrid(np.linspace(0, length, columns + 1), np.linspace(0, width, rows + 1), indexing="ij")
    vertices = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
    i, j = np.meshgrid(np.arange(columns), np.arange(rows), indexing="ij")
    a = i * (rows + 1) + j
    b, c, d = a + rows + 1, a + 1, a + rows + 2
    return vertices, np.stack([a, b, d, a, d, c], -1).reshape(-1, 3)


def join(*meshes: Mesh) -> Mesh:
    """Several meshes as one."""
    starts = np.cumsum([0, *(len(v) for v, _ in meshes)])
    return (
        np.concatenate([v for v, _ in meshes]),
        np.concatenate([f + start for (_, f), start in zip(meshes, starts[:-1], strict=True)]),
    )


def moved(mesh: Mesh, rotation: Floats | None = None, shift: Floats | tuple[float, float, float] = (0, 0, 0)) -> Mesh:
    """A mesh turned, then moved."""
    vertices = mesh[0] if rotation is None else mesh[0] @ rotation.T
    return vertices + np.asarray(shift, np.float64), mesh[1]


def station() -> list[Mesh]:
    """Sixteen meshes along z: pipe with jacket, flange, gasket, flange, eight bolts, valve body, elbow, grating."""
    flange = tube(0.08, 0.05, 0.02, 48, 1)
    parts = [
        tube(0.05, 0.045, 2.0, 64, 2),
        moved(tube(0.0665, 0.0615, 1.0, 64, 2), shift=(0, 0, 0.5)),
        moved(flange, shift=(0, 0, 2.0)),
        moved(tube(0.065, 0.05, 0.003, 48), shift=(0, 0, 2.02)),
        moved(flange, shift=(0, 0, 2.023)),
    ]
    for k in range(8):
        angle = (k + 0.5) * np.pi / 4
        parts.append(moved(bolt(20), shift=(0.072 * np.cos(angle), 0.072 * np.sin(angle), 2.0431)))
    parts.append(moved(sphere(0.07, 48, 36), shift=(0, 0, 2.11)))
    parts.append(moved(elbow(0.15, 0.05, 24, 48), shift=(0, 0, 2.18)))
    parts.append(
        moved(join(*(moved(box(1.0, 0.005, 0.03), shift=(0, 0.03 * i, 0)) for i in range(40))), shift=(0.6, -0.6, 1.0))
    )
    return parts


def plant(scale: float = 1.0, tiles: int = 1, seed: int = 0) -> Scene:
    """About 8,500 meshes and 7 million triangles for each tile at scale 1.

    Stations stand on a plate in any turn about the vertical, every third lies or leans; 16 m tubes cross them.
    """
    random = np.random.default_rng(seed)
    n = max(1, round(510 * scale))
    columns = max(1, round(np.sqrt(n)))
    meshes: list[Mesh] = []
    width = 3.2 * (n // columns + 1)
    parts = station()
    for tile in range(tiles):
        y0 = tile * (width + 2.0)
        for k in range(n):
            turn = Rotation.from_euler("z", random.uniform(0, 2 * np.pi))
            if k % 3 == 2:
                turn = turn * Rotation.from_euler("x", random.choice([np.pi / 2, random.uniform(0, 1.5)]))
            at = np.array([3.2 * (k % columns), y0 + 3.2 * (k // columns), 0.005 if k % 3 != 2 else 1.5])
            matrix = turn.as_matrix()
            meshes += [moved(part, matrix, at) for part in parts]
        n_tubes = max(1, round(340 * scale))
        for _ in range(n_tubes):
            at = np.array([random.uniform(0, 3.2 * columns), y0 + random.uniform(0, width), 1.5])
            turn = Rotation.from_euler("zyx", [random.uniform(0, 2 * np.pi), random.uniform(1.2, 1.9), 0])
            meshes.append(moved(moved(tube(0.04, 0.035, 16.0, 32), shift=(0, 0, -8)), turn.as_matrix(), at))
        cells = max(4, round(70 * np.sqrt(scale)))
        meshes.append(moved(plate(3.2 * columns + 4, width + 2, cells, cells), shift=(-2, y0 - 2, 0)))
    return Scene.from_meshes(meshes)


def small_parts(n: int, seed: int = 0) -> Scene:
    """Cylinders of 96 triangles about 12 mm apart, built without a list of meshes."""
    random = np.random.default_rng(seed)
    profile = [(0.02, -0.05), (0.02, -0.02), (0.02, 0.02), (0.02, 0.05)]
    vertices, faces = lathe(profile, 16)
    side = int(np.ceil(n ** (1 / 3)))
    cell = np.arange(n)
    at = np.column_stack([cell % side, cell // side % side, cell // side**2]) * [0.052, 0.052, 0.112]
    at = at + random.uniform(-0.002, 0.002, (n, 3))
    return Scene(
        MeshArrays(
            vertices=(vertices[None] + at[:, None]).reshape(-1, 3),
            faces=np.tile(faces.astype(np.int32), (n, 1)),
            vertex_offsets=np.arange(n + 1) * len(vertices),
            face_offsets=np.arange(n + 1) * len(faces),
        ),
        paths=tuple(f"/{i}" for i in range(n)),
        colors=np.full((n, 3), np.nan, np.float32),
    )


def diagonal_tubes(n: int, seed: int = 0) -> Scene:
    """Tubes of 16 m in all directions, each of long slivers."""
    random = np.random.default_rng(seed)
    turns = Rotation.random(n, random_state=seed).as_matrix()
    part = moved(tube(0.05, 0.045, 16.0, 64), shift=(0, 0, -8))
    return Scene.from_meshes([moved(part, turns[i], random.uniform(-20, 20, 3)) for i in range(n)])


def trusses(n: int, seed: int = 0) -> Scene:
    """Meshes of twenty 16 m bars in all directions each, which have no axes of their own, and small boxes."""
    random = np.random.default_rng(seed)
    meshes = []
    for k in range(n):
        turns = Rotation.random(20, random_state=seed + k).as_matrix()
        bars = [moved(tube(0.05, 0.045, 16.0, 24), turn, (0, 0, 0)) for turn in turns]
        meshes.append(moved(join(*bars), shift=random.uniform(-20, 20, 3)))
    boxes = Rotation.random(40 * n, random_state=seed).as_matrix()
    meshes += [moved(sphere(0.2, 24, 20), turn, random.uniform(-20, 20, 3)) for turn in boxes]
    return Scene.from_meshes(meshes)


def bolts_on_plate(n: int, triangles: int = 100_000, seed: int = 0) -> Scene:
    """Bolts on their heads over one finely cut plate, at gaps of 0 to 15 mm."""
    random = np.random.default_rng(seed)
    cells = round(np.sqrt(triangles / 2))
    turn = Rotation.from_euler("x", np.pi).as_matrix()
    meshes = [plate(20.0, 20.0, cells, cells)]
    for _ in range(n):
        at = np.array([*random.uniform(0.1, 19.9, 2), 0.006 + random.uniform(0, 0.015)])
        meshes.append(moved(bolt(), turn, at))
    return Scene.from_meshes(meshes)


def concentric_spheres(n: int, rings: int = 220, seed: int = 0) -> Scene:
    """Pairs of spheres of about ``4 * rings**2`` triangles, 10.1 mm apart, one turned inside the other."""
    random = np.random.default_rng(seed)
    turns = Rotation.random(n, random_state=seed).as_matrix()
    meshes = []
    for i in range(n):
        at = (5.0 * i, 0.0, 0.0)
        meshes.append(moved(sphere(1.0, 2 * rings, rings), None, at))
        meshes.append(moved(sphere(1.0101 + random.uniform(0, 1e-5) + 1.3e-4, 2 * rings, rings), turns[i], at))
    return Scene.from_meshes(meshes)


def bin_of_bolts(n: int, seed: int = 0) -> Scene:
    """Bolts in random poses, about as dense as they lie in a bin."""
    random = np.random.default_rng(seed)
    side = (n * 4.5e-6) ** (1 / 3)
    turns = Rotation.random(n, random_state=seed).as_matrix()
    return Scene.from_meshes([moved(bolt(), turn, random.uniform(0, side, 3)) for turn in turns])


def far_away(scene: Scene) -> Scene:
    """The same scene at 2.4e7 m, its coordinates rounded as float64 rounds them there."""
    return scene.with_vertices(scene.vertices + np.array([2.4e7, -1.7e7, 300.0]))
