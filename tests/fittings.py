"""Pipe fittings for tests with the mouths that they have, and the ways in which other programs cut them into triangles.

Everything lies along x; lengths are in metres.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial import Delaunay

X = np.array([1.0, 0.0, 0.0])
CAPS = ("fan", "corner", "ears")


@dataclass(frozen=True)
class Mouth:
    """Where something joins: middle, unit direction outward, outer radius."""

    point: np.ndarray
    direction: np.ndarray
    radius: float


@dataclass(frozen=True, repr=False)
class Fitting:
    """A mesh, where it has to end, and how long its axes are in all [m]."""

    mesh: tuple
    mouths: tuple
    length: float

    def __repr__(self):
        mouths = [(m.point.round(5).tolist(), m.direction.round(5).tolist(), m.radius) for m in self.mouths]
        return f"<{len(self.mesh[1])} triangles, mouths {mouths}, length {self.length}>"


def ring(center, direction, radius, sides, phase=0.0):
    """(sides, 3) points counter-clockwise about a direction."""
    u = np.cross(direction, np.eye(3)[np.argmin(np.abs(np.round(direction, 6)))])
    u = u / np.linalg.norm(u)
    angles = np.arange(sides) * 2 * np.pi / sides + phase
    return center + radius * (np.outer(np.cos(angles), u) + np.outer(np.sin(angles), np.cross(direction, u)))


def strip(first, second):
    """The skin between two rings of any numbers of corners, each triangle from the one to the other."""
    n, m, faces, i, j = len(first), len(second), [], 0, 0
    while i < n or j < m:
        if j >= m or (i < n and (i + 0.5) * m <= (j + 0.5) * n):
            faces.append((i % n, (i + 1) % n, n + j % m))
            i += 1
        else:
            faces.append((i % n, n + (j + 1) % m, n + j % m))
            j += 1
    return np.concatenate([first, second]), np.array(faces)


def disc(loop, style="fan"):
    """A ring filled about its middle, from one of its corners, or by cutting ears to and fro."""
    n = len(loop)
    if style == "fan":
        k = np.arange(n)
        return np.concatenate([loop, loop.mean(axis=0)[None]]), np.column_stack([np.full(n, n), k, (k + 1) % n])
    if style == "corner":
        return loop, np.array([(0, k, k + 1) for k in range(1, n - 1)])
    low, high, faces = 0, n - 1, []
    while high - low > 1:
        faces.append((low, low + 1, high))
        low += 1
        if high - low > 1:
            faces.append((low, high - 1, high))
            high -= 1
    return loop, np.array(faces)


def reverse(mesh):
    return mesh[0], mesh[1][:, ::-1]


def merged(*meshes):
    starts = np.cumsum([0, *(len(v) for v, _ in meshes)])
    return (
        np.concatenate([v for v, _ in meshes]),
        np.concatenate([np.asarray(f) + s for (_, f), s in zip(meshes, starts[:-1], strict=True)]),
    )


def welded(mesh, digits=9):
    """Corners in one place are one; triangles without area go."""
    _, first, of = np.unique(np.round(mesh[0], digits), axis=0, return_index=True, return_inverse=True)
    faces = of.reshape(-1)[mesh[1]]
    real = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    return mesh[0][first], faces[real]


def swept(rings, inner=None, caps="fan"):
    """A body through rings, solid with caps, or hollow with inner rings."""
    skins = [strip(a, b) for a, b in zip(rings[:-1], rings[1:], strict=True)]
    if inner is None:
        return welded(merged(*skins, reverse(disc(rings[0], caps)), disc(rings[-1], caps)))
    skins += [reverse(strip(a, b)) for a, b in zip(inner[:-1], inner[1:], strict=True)]
    return welded(merged(*skins, strip(inner[0], rings[0]), strip(rings[-1], inner[-1])))


def straight(points, radii, sides, wall=None, caps="fan", last_sides=None):
    """Rings across x at points of any offset: pipe, cone, concentric or eccentric reducer."""
    points = np.asarray(points, float)
    counts = [sides] * (len(points) - 1) + [last_sides or sides]
    if len(points) > 2:
        counts = [sides if k < len(points) / 2 else (last_sides or sides) for k in range(len(points))]

    def skin(less):
        return [ring(p, X, r * less, n) for p, r, n in zip(points, radii, counts, strict=True)]

    mesh = swept(skin(1.0), None if wall is None else skin(1.0 - wall), caps)
    mouths = (Mouth(points[0], -X, radii[0]), Mouth(points[-1], X, radii[-1]))
    return Fitting(mesh, mouths, float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum()))


def bend(radius, reach, angle, steps, sides, wall=None, caps="fan", legs=(0.0, 0.0)):
    """A piece of torus with its rings in planes through its axis, and straight legs before and after."""
    turns = np.linspace(0.0, angle, steps + 1)
    middles = np.column_stack([reach * np.sin(turns), reach * (1 - np.cos(turns)), 0 * turns])
    ways = np.column_stack([np.cos(turns), np.sin(turns), 0 * turns])
    if legs[0]:
        middles, ways = np.concatenate([[-legs[0] * X], middles]), np.concatenate([ways[:1], ways])
    if legs[1]:
        middles = np.concatenate([middles, [middles[-1] + legs[1] * ways[-1]]])
        ways = np.concatenate([ways, ways[-1:]])

    def skin(r):
        angles = np.arange(sides) * 2 * np.pi / sides
        up = np.array([0.0, 0.0, 1.0])
        return [
            p + r * (np.outer(np.cos(angles), np.cross(up, way)) + np.outer(np.sin(angles), up))
            for p, way in zip(middles, ways, strict=True)
        ]

    mesh = swept(skin(radius), None if wall is None else skin(radius * (1 - wall)), caps)
    mouths = (Mouth(middles[0], -ways[0], radius), Mouth(middles[-1], ways[-1], radius))
    return Fitting(mesh, mouths, float(np.linalg.norm(np.diff(middles, axis=0), axis=1).sum()))


@dataclass(frozen=True)
class Outlet:
    """A branch: where its axis meets that of the run, the angle to the run, its turn about it, radius and reach."""

    at: float
    radius: float
    reach: float
    angle: float = np.pi / 2
    turn: float = 0.0

    @property
    def direction(self):
        across = np.array([0.0, np.cos(self.turn), np.sin(self.turn)])
        return np.cos(self.angle) * X + np.sin(self.angle) * across

    def ring(self, radius, sides):
        """Points around its foot, in the plane through it."""
        return ring(self.at * X, self.direction, radius, sides)

    def foot(self, radius, run, sides):
        """Where its wall meets that of the run."""
        start, d = self.ring(radius, sides), self.direction
        across = d[1:] @ d[1:]
        half, rest = start[:, 1:] @ d[1:], (start[:, 1:] ** 2).sum(axis=1) - run**2
        t = (-half + np.sqrt(half**2 - across * rest)) / across
        return start + t[:, None] * d


def branched(run, length, outlets, sides, wall=None, caps="fan", rings=0):
    """A run from 0 to ``length`` with branches that open into it; ``rings`` circles between its ends."""
    shares = [1.0] if wall is None else [1.0, 1 - wall]
    walls = [_branched_skin(run, length, outlets, sides, share, rings) for share in shares]
    skins, rims = zip(*walls, strict=True)
    if wall is None:
        lids = [disc(rim, caps) for rim in rims[0]]
        lids[0] = reverse(lids[0])
        mesh = merged(skins[0], *lids)
    else:
        lids = [strip(outer, inner) for outer, inner in zip(*rims, strict=True)]
        lids[0] = reverse(lids[0])
        mesh = merged(skins[0], reverse(skins[1]), *lids)
    mouths = [Mouth(0 * X, -X, run), Mouth(length * X, X, run)]
    mouths += [Mouth(one.at * X + one.reach * one.direction, one.direction, one.radius) for one in outlets]
    return Fitting(welded(mesh), tuple(mouths), length + sum(one.reach for one in outlets))


def _branched_skin(run, length, outlets, sides, share, rings):
    """The wall of a run and its branches at a share of their radii; and the rings at its mouths."""
    radius = run * share
    feet = [one.foot(one.radius * share, radius, max(sides, 12)) for one in outlets]
    angles = np.linspace(0, 2 * np.pi, sides + 1)
    # Unrolled, and rolled up again: what lies near the seam is there twice.
    rims = []
    for foot in feet:
        flat = np.column_stack([foot[:, 0], radius * np.unwrap(np.arctan2(foot[:, 2], foot[:, 1]))])
        rims += [flat + np.array([0, k * 2 * np.pi * radius]) for k in (-2, -1, 0, 1, 2)]
    stations = np.linspace(0.0, length, rings + 2)
    grid = np.stack(np.meshgrid(stations, angles * radius, indexing="ij"), -1).reshape(-1, 2)
    inside = (grid[:, 0] > 0) & (grid[:, 0] < length)
    grid = grid[~(inside & np.any([_within(grid, _grown(rim)) for rim in rims], axis=0))]
    whole = 2 * np.pi * radius
    domain = np.concatenate([grid, *(rim[(rim[:, 1] > 1e-9) & (rim[:, 1] < whole - 1e-9)] for rim in rims)])
    domain = np.concatenate([domain, *(_crossings(rim, level) for rim in rims for level in (0.0, whole))])
    triangles = Delaunay(domain).simplices
    middles = domain[triangles].mean(axis=1)
    triangles = triangles[~np.any([_within(middles, rim) for rim in rims], axis=0)]
    around = domain[:, 1] / radius
    wall = np.column_stack([domain[:, 0], radius * np.cos(around), radius * np.sin(around)])
    ends = [
        np.column_stack([np.full(sides, x), radius * np.cos(angles[:-1]), radius * np.sin(angles[:-1])])
        for x in (0.0, length)
    ]
    tops = [one.ring(one.radius * share, max(sides, 12)) + one.reach * one.direction for one in outlets]
    tubes = [strip(foot, top) for foot, top in zip(feet, tops, strict=True)]
    return merged(_outward(wall, triangles), *tubes), [*ends, *tops]


def _outward(wall, triangles):
    corners = wall[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    out = np.einsum("ij,ij->i", normal[:, 1:], corners.mean(axis=1)[:, 1:])
    return wall, np.where((out > 0)[:, None], triangles, triangles[:, ::-1])


def _grown(rim):
    middle = rim.mean(axis=0)
    return middle + 1.08 * (rim - middle)


def _within(points, loop):
    """Which points lie in a polygon, by the crossings of a ray."""
    inside = np.zeros(len(points), bool)
    for p, q in zip(loop, np.roll(loop, -1, axis=0), strict=True):
        if p[1] == q[1]:
            continue
        between = (points[:, 1] < p[1]) != (points[:, 1] < q[1])
        inside ^= between & (points[:, 0] < p[0] + (points[:, 1] - p[1]) / (q[1] - p[1]) * (q[0] - p[0]))
    return inside


def _crossings(loop, level):
    """Where a loop crosses the seam."""
    found = []
    for p, q in zip(loop, np.roll(loop, -1, axis=0), strict=True):
        if (p[1] - level) * (q[1] - level) < 0:
            found.append((p[0] + (level - p[1]) / (q[1] - p[1]) * (q[0] - p[0]), level))
        elif p[1] == level:
            found.append((p[0], level))
    return np.array(found, float).reshape(-1, 2)


def stuck(run, length, outlets, sides, caps="fan"):
    """The same of primitives: solid cylinders that run into each other."""
    meshes = [straight([0 * X, length * X], [run, run], sides, None, caps).mesh]
    for one in outlets:
        start, stop = one.at * X, one.at * X + one.reach * one.direction
        meshes.append(swept([ring(p, one.direction, one.radius, sides) for p in (start, stop)], None, caps))
    whole = branched(run, length, outlets, 24)
    return replace(whole, mesh=merged(*meshes))


def placed(fitting, turn, shift, scale=1.0):
    """The same elsewhere."""
    vertices, faces = fitting.mesh
    mouths = tuple(Mouth(scale * turn @ m.point + shift, turn @ m.direction, scale * m.radius) for m in fitting.mouths)
    return Fitting((scale * vertices @ turn.T + shift, faces), mouths, scale * fitting.length)


# Meshers: each takes a mesh and a random generator, and gives the same shape in other triangles.


def plain(mesh, random):
    return mesh


def quartered(mesh, random):
    """Every triangle in four."""
    vertices, faces = mesh
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    corners = [(a, (a + b) / 2, (a + c) / 2), ((a + b) / 2, b, (b + c) / 2), ((a + c) / 2, (b + c) / 2, c)]
    corners.append(((a + b) / 2, (b + c) / 2, (a + c) / 2))
    soup = np.concatenate([np.stack(three, axis=1) for three in corners])
    return welded((soup.reshape(-1, 3), np.arange(3 * len(soup)).reshape(-1, 3)))


def shuffled(mesh, random):
    """Triangles and corners in another order, each triangle begun at another corner."""
    vertices, faces = mesh
    order = random.permutation(len(vertices))
    place = np.argsort(order)
    faces = place[faces][random.permutation(len(faces))]
    turns = random.integers(0, 3, len(faces))
    return vertices[order], np.take_along_axis(faces, (np.arange(3) + turns[:, None]) % 3, axis=1)


def soup(mesh, random):
    """No corner shared."""
    return mesh[0][mesh[1]].reshape(-1, 3), np.arange(3 * len(mesh[1])).reshape(-1, 3)


def inside_out(mesh, random):
    """Every triangle wound the wrong way."""
    return mesh[0], mesh[1][:, ::-1]


def unwound(mesh, random):
    """Every second triangle wound the wrong way."""
    turned = random.random(len(mesh[1])) < 0.5
    return mesh[0], np.where(turned[:, None], mesh[1][:, ::-1], mesh[1])


def rounded(mesh, random):
    """Coordinates as text files have them: six digits of the size, 0.01 mm of 1 m."""
    size = float(np.ptp(mesh[0], axis=0).max())
    step = 10.0 ** np.floor(np.log10(size) - 5)
    return np.round(mesh[0] / step) * step, mesh[1]


def flipped(mesh, random):
    """The other diagonal of flat quadrilaterals."""
    vertices, faces = mesh[0], mesh[1].copy()
    of_edge = {}
    for k, face in enumerate(faces.tolist()):
        for i in range(3):
            of_edge.setdefault((face[i], face[(i + 1) % 3]), (k, face[(i + 2) % 3]))
    done = set()
    for (a, b), (k, c) in of_edge.items():
        other, d = of_edge.get((b, a), (k, c))
        if other == k or k in done or other in done:
            continue
        normals = [np.cross(vertices[q] - vertices[p], vertices[r] - vertices[p]) for p, q, r in
                   ((a, b, c), (b, a, d), (a, d, c), (d, b, c))]  # fmt: skip
        sizes = [np.linalg.norm(n) for n in normals]
        flat = min(sizes) > 0.02 * max(sizes) and all(
            n @ normals[0] > 0.999999 * s * sizes[0] for n, s in zip(normals, sizes, strict=True)
        )
        if flat:
            faces[k], faces[other] = (a, d, c), (d, b, c)
            done |= {k, other}
    return vertices, faces


def decimated(mesh, random, share=0.05):
    """Some corners drawn into their nearest neighbour, first those that the shape needs least."""
    vertices, faces = mesh
    for _ in range(max(1, int(share * len(vertices)))):
        corners = vertices[faces]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        size = np.linalg.norm(normal, axis=1, keepdims=True)
        unit = normal / np.maximum(size, 1e-300)
        total = np.zeros_like(vertices)
        weight = np.zeros(len(vertices))
        for c in range(3):
            np.add.at(total, faces[:, c], unit)
            np.add.at(weight, faces[:, c], 1.0)
        # What has all its triangles in one plane is not needed at all.
        need = 1 - np.linalg.norm(total, axis=1) / np.maximum(weight, 1)
        need[weight == 0] = np.inf
        v = int(np.argmin(np.round(need, 9)))
        if need[v] > 0.01:
            break
        near = np.unique(faces[(faces == v).any(axis=1)])
        near = near[near != v]
        to = int(near[np.argmin(np.linalg.norm(vertices[near] - vertices[v], axis=1))])
        faces = np.where(faces == v, to, faces)
        real = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
        faces = faces[real]
    return vertices, faces


MESHERS = {f.__name__: f for f in (plain, quartered, shuffled, soup, inside_out, unwound, rounded, flipped, decimated)}
