"""What the rules know of a part's shape: round end faces, the axis it turns about, its profile, tubes and wheels."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import islice

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from cadgraph.model.parts import Parts
from cadgraph.model.scene import Floats, Ints, mesh_of_face

__all__ = ["Disc", "Facts", "angles_about", "find_facts", "same_line"]

N_SLICES = 24  # of a profile: the plate of a flange (a third of its length or more) still gets several
_WELD = 1e-6  # corners closer than this are one [m]
_MIN_AREA = 1e-4  # smaller patches are no end faces (share of the part's area): those of a 12 m pipe DN50 have 2e-4
# How exact round faces must be: faces this parallel share a plane (a 128-sided pipe turns by 2.8 degrees a side, a
# 20-sided one by 18), corners at this share of the greatest radius lie on the rim, none bulges by more than this
# share, and rim corners are at most so far apart (6 sides: 60 degrees). Parts without a round face get the second
# chance: scans and rough remeshing move corners by a millimetre; six sides could be a square there.
_LEVELS = (
    (np.cos(np.radians(1.0)), 0.97, 0.02, np.radians(75.0)),
    (np.cos(np.radians(12.0)), 0.93, 0.08, np.radians(50.0)),
)
_MAX_PATCHES = 64  # only so many patches of a part are looked at, those of most faces first: round ones have many
_TURNED = 0.36  # greatest tangential share of a normal on a surface of revolution; 6 sides: sin(60 degrees) / 3 = 0.29
_SKEW = np.cos(np.radians(4.0))  # axes this parallel can be one line
_TUBE_ERROR = 0.12  # a tube's volume, area and end faces agree this well; mitred bends are a few per cent off
_THIN = 1e-9


@dataclass(frozen=True)
class Disc:
    """A round flat face, or the round rim of an opening.

    Args:
        center: ``(3,)`` [m].
        normal: ``(3,)`` unit, out of the part.
        outer: radius of its rim [m].
        inner: radius of its hole; ``outer`` for a mere rim, 0 for a full face [m].
        sides: corners of the rim.
        area: [m2].
    """

    center: Floats
    normal: Floats
    outer: float
    inner: float
    sides: int
    area: float


@dataclass(frozen=True)
class Facts:
    """The shape of one part.

    Args:
        discs: its round flat faces.
        ports: of these the outermost along each axis and sense.
        center: ``(3,)`` a point on its main axis [m].
        axis: ``(3,)`` unit.
        low: least coordinate along the axis from ``center`` [m].
        high: greatest coordinate [m].
        radius: greatest distance from the axis [m].
        turned: share of the area that a surface of revolution about the axis could have.
        sides: corners around the axis at the greatest radius; 0 where they leave a wide gap.
        outer: ``(N_SLICES,)`` greatest radius of each slice along the axis [m].
        inner: ``(N_SLICES,)`` least [m].
        tube: length of the centreline if it is a tube or bar of one round section between two ports, else 0 [m].
        rim: share of the area that lies beyond 0.72 of the radius.
        spokes: number of arms between hub and rim; 0 where that zone is filled, or empty.
        section: ``(3,)`` extents of the oriented box, descending [m].
        fill: enclosed volume over that of the box; 0 where open.
    """

    discs: tuple[Disc, ...]
    ports: tuple[Disc, ...]
    center: Floats
    axis: Floats
    low: float
    high: float
    radius: float
    turned: float
    sides: int
    outer: Floats
    inner: Floats
    tube: float
    rim: float
    spokes: int
    section: Floats
    fill: float

    @property
    def length(self) -> float:
        """Along the axis [m]."""
        return self.high - self.low

    @property
    def round(self) -> bool:
        """Whether it is a body of revolution, but for bolt holes and the like."""
        return self.turned > 0.85 and self.sides >= 5

    @property
    def bent(self) -> bool:
        """Whether it is a tube that turns."""
        if not self.tube:
            return False
        first, second = self.ports
        return bool(first.normal @ second.normal > -_SKEW) or self.tube > 1.1 * _distance(first, second)


def same_line(point: Floats, axis: Floats, other_point: Floats, other_axis: Floats, offset: float) -> bool:
    """Whether two lines run within ``offset`` [m] of each other and nearly parallel."""
    if abs(axis @ other_axis) < _SKEW:
        return False
    apart = other_point - point
    return bool(np.linalg.norm(apart - axis * (apart @ axis)) <= offset)


def angles_about(axis: Floats, points: Floats) -> Floats:
    """The angles of points ``(n, 3)`` around an axis through the origin, ascending [rad]."""
    x, y, z = axis.tolist()
    # Any direction across the axis will do, taken from the least component so that it is far from the axis.
    u = np.array([(0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0)][int(np.argmin(np.abs(axis)))])
    u = u / np.linalg.norm(u)
    w = np.array([y * u[2] - z * u[1], z * u[0] - x * u[2], x * u[1] - y * u[0]])
    angles: Floats = np.sort(np.arctan2(points @ w, points @ u))
    return angles


def find_facts(parts: Parts) -> list[Facts]:
    """Measures the shape of every part, each in its own frame."""
    scene, properties = parts.scene, parts.properties
    triangles = scene.triangles() + 0.0
    cross = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    double = np.linalg.norm(cross, axis=1)
    normals = cross / np.maximum(double, _THIN**2)[:, None]
    owner = mesh_of_face(scene)
    patches, rims = _flat_patches(triangles, normals, owner)
    facts = []
    for part in range(parts.n_parts):
        faces = slice(int(scene.face_offsets[part]), int(scene.face_offsets[part + 1]))
        inward = -1.0 if properties.closed[part] and properties.volume[part] < 0 else 1.0
        shape = _Shape(
            triangles[faces], normals[faces] * inward, double[faces] / 2, patches[:, faces], rims.get(part, [])
        )
        volume = abs(float(properties.volume[part])) if properties.closed[part] else 0.0
        facts.append(_measure(shape, properties.obb_center[part], properties.obb_axes[part],
                              properties.obb_extents[part], volume))  # fmt: skip
    return facts


@dataclass(frozen=True)
class _Shape:
    """The faces of one part: corners, normals, areas, the flat patch of each by level; and its open rims as edges."""

    triangles: Floats
    normals: Floats
    areas: Floats
    patches: Ints
    rims: list[Floats]


def _flat_patches(triangles: Floats, normals: Floats, owner: Ints) -> tuple[Ints, dict[int, list[Floats]]]:
    """Joins faces that share an edge and a plane, and edges without a partner into rims.

    Returns:
        The patch ``(n_levels, n_faces)`` of each face; and for each part its rims, each ``(n, 2, 3)`` edges.
    """
    n = len(triangles)
    if n == 0:
        return np.zeros((len(_LEVELS), 0), np.int64), {}
    grid = np.round(triangles.reshape(-1, 3) / _WELD).astype(np.int64).view(np.uint64)
    key = np.repeat(owner, 3).astype(np.uint64)
    for column in grid.T:  # a number for each place; two places share one with a chance of 1e-8 in a million
        key = (key ^ column) * np.uint64(0x9E3779B97F4A7C15)
        key ^= key >> np.uint64(29)
    corner = np.unique(key, return_inverse=True)[1].reshape(n, 3).astype(np.int64)
    ends = np.sort(corner[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    edge = ends[:, 0] * (corner.max() + 1) + ends[:, 1]
    order = np.argsort(edge, kind="stable")
    same = edge[order][1:] == edge[order][:-1]
    a, b = order[:-1][same] // 3, order[1:][same] // 3
    cosine = np.abs(np.einsum("ij,ij->i", normals[a], normals[b]))
    patches = np.empty((len(_LEVELS), n), np.int64)
    for level, (least, _, _, _) in enumerate(_LEVELS):
        flat = cosine > least
        links = coo_array((np.ones(int(flat.sum()), np.int8), (a[flat], b[flat])), shape=(n, n))
        patches[level] = connected_components(links, directed=False)[1]
    alone = np.ones(len(order), np.bool_)
    alone[1:] &= ~same
    alone[:-1] &= ~same
    free = order[alone & (ends[order, 0] != ends[order, 1])]
    rims: dict[int, list[Floats]] = {}
    if len(free):
        points, inverse = np.unique(ends[free], return_inverse=True)
        inverse = inverse.reshape(-1, 2)
        loops = coo_array((np.ones(len(free), np.int8), (inverse[:, 0], inverse[:, 1])), shape=(len(points),) * 2)
        loop = connected_components(loops, directed=False)[1].astype(np.int64)[inverse[:, 0]]
        tail, head = free // 3, free % 3
        for edges in _by_value(loop, 5):
            f, k = tail[edges], head[edges]
            lines = np.stack([triangles[f, k], triangles[f, (k + 1) % 3]], axis=1)
            rims.setdefault(int(owner[f[0]]), []).append(lines)
    return patches, rims


def _by_value(values: Ints, least: int) -> list[Ints]:
    """The positions of each distinct value that occurs at least so often, ascending."""
    order = np.argsort(values, kind="stable")
    starts = np.concatenate([[0], np.nonzero(np.diff(values[order]))[0] + 1, [len(values)]])
    return [order[i:j] for i, j in zip(starts[:-1].tolist(), starts[1:].tolist(), strict=True) if j - i >= least]


def _find_discs(shape: _Shape, middle: Floats, level: int) -> list[Disc]:
    """The round flat faces and round rims of a part, widest first."""
    whole = float(shape.areas.sum())
    found = []
    groups = sorted(_by_value(shape.patches[level], 3), key=len, reverse=True)
    large = (faces for faces in groups if shape.areas[faces].sum() >= _MIN_AREA * whole)
    for faces in islice(large, _MAX_PATCHES):
        areas = shape.areas[faces]
        center = (areas[:, None] * shape.triangles[faces].mean(axis=1)).sum(axis=0) / areas.sum()
        largest = shape.normals[faces[np.argmax(areas)]]
        senses = np.sign(shape.normals[faces] @ largest)
        normal = (areas * senses) @ shape.normals[faces]
        disc = _disc(
            shape.triangles[faces].reshape(-1, 3), center, normal / np.linalg.norm(normal), float(areas.sum()), level
        )
        if disc is not None:
            found.append(disc)
    for lines in shape.rims[:_MAX_PATCHES]:
        size = np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1)
        center = (size[:, None] * lines.mean(axis=1)).sum(axis=0) / size.sum()
        normal = np.linalg.svd(lines.reshape(-1, 3) - center, full_matrices=False)[2][2]
        normal = normal * (1.0 if normal @ (center - middle) >= 0 else -1.0)
        disc = _disc(lines.reshape(-1, 3), center, normal, 0.0, level)
        if disc is not None:
            found.append(disc)
    return sorted(found, key=lambda disc: -disc.outer)


def _disc(points: Floats, center: Floats, normal: Floats, area: float, level: int) -> Disc | None:
    """A disc if the outermost points lie evenly on a circle about the centre."""
    _, least, bulge, _ = _LEVELS[level]
    apart = points - center
    height = apart @ normal
    radii = np.linalg.norm(apart - height[:, None] * normal, axis=1)
    outer = float(radii.max())
    if outer < 1e-3 or np.abs(height).max() > bulge * outer + 1e-5:
        return None
    rim = radii >= least * outer
    sides, full = _corners(apart[rim], normal, level) if rim.sum() >= 5 else (0, 0.0)
    if not sides:
        return None
    solid = area >= 0.97 * full * outer**2
    inner = 0.0 if solid else float(radii.min()) if area else outer
    return Disc(center, normal, outer, inner, sides, area)


def _corners(points: Floats, normal: Floats, level: int) -> tuple[int, float]:
    """How many corners go around, 0 where a gap is too wide; and the area of that polygon at radius 1."""
    angles = angles_about(normal, points)
    steps = np.diff(np.append(angles, angles[0] + 2 * np.pi))
    steps = steps[steps > 0.01]  # corners of several faces, and of both ends
    if not len(steps) or steps.max() > _LEVELS[level][3]:
        return 0, 0.0
    return len(steps), float(np.sin(steps).sum() / 2)


def _distance(first: Disc, second: Disc) -> float:
    return float(np.linalg.norm(first.center - second.center))


def _find_ports(discs: list[Disc]) -> tuple[list[Disc], list[list[Disc]]]:
    """Outermost discs along each axis and sense; and the discs by axis, the axis with most area first."""
    lines: list[list[Disc]] = []
    for disc in discs:
        for line in lines:
            offset = 0.1 * max(disc.outer, line[0].outer) + 1e-4
            if same_line(line[0].center, line[0].normal, disc.center, disc.normal, offset):
                line.append(disc)
                break
        else:
            lines.append([disc])
    lines.sort(key=lambda line: -sum(np.pi * disc.outer**2 for disc in line))
    ports = []
    for line in lines:
        for sense in (1.0, -1.0):
            normal = line[0].normal * sense
            facing = [disc for disc in line if disc.normal @ normal > 0]
            if facing:
                end = max(float(disc.center @ normal) for disc in facing)
                ports.append(max((d for d in facing if d.center @ normal > end - 1e-4), key=lambda d: d.outer))
    return ports, lines


def _measure(shape: _Shape, middle: Floats, box_axes: Floats, extents: Floats, volume: float) -> Facts:
    discs = _find_discs(shape, middle, 0)
    level = 0 if discs else 1
    discs = discs or _find_discs(shape, middle, 1)
    ports, lines = _find_ports(discs)
    tries = [(line[0].center, line[0].normal) for line in lines[:3]] or [(middle, axis) for axis in box_axes]
    measured = [_about(shape, center, axis, level) for center, axis in tries]
    best = int(np.argmax([turned + (sides >= 5) - 0.02 * k for k, (turned, sides, _, _) in enumerate(measured)]))
    center, axis = tries[best]
    turned, sides, radius, along = measured[best]
    low, high = (float(along.min()), float(along.max())) if along.size else (0.0, 0.0)
    outer, inner = _profile(shape, center, axis, low, high)
    rim, spokes = _wheel(shape, center, axis, radius)
    box = float(np.prod(extents))
    return Facts(
        discs=tuple(discs), ports=tuple(ports), center=center, axis=axis, low=low, high=high, radius=radius,
        turned=turned, sides=sides, outer=outer, inner=inner,
        tube=_tube_length(ports, float(shape.areas.sum()), volume, extents), rim=rim, spokes=spokes,
        section=extents, fill=volume / box if box > 0 else 0.0,
    )  # fmt: skip


def _about(shape: _Shape, center: Floats, axis: Floats, level: int) -> tuple[float, int, float, Floats]:
    """Share of turned area, corners around, greatest radius, and coordinates along the axis ``(n, 3)``."""
    if not len(shape.triangles):
        return 0.0, 0, 0.0, np.zeros(0)
    apart = shape.triangles - center
    along = apart @ axis
    across = apart - along[..., None] * axis
    radii = np.linalg.norm(across, axis=2)
    spoke = across.mean(axis=1)
    around = np.cross(axis, spoke / np.maximum(np.linalg.norm(spoke, axis=1), _THIN)[:, None])
    turned = np.abs(np.einsum("ij,ij->i", shape.normals, around)) < _TURNED
    radius = float(radii.max())
    sides = _corners(across[radii >= _LEVELS[level][1] * radius], axis, level)[0]
    return float(shape.areas[turned].sum() / max(shape.areas.sum(), _THIN**2)), sides, radius, along


def _profile(shape: _Shape, center: Floats, axis: Floats, low: float, high: float) -> tuple[Floats, Floats]:
    """Greatest and least radius where the edges of the faces cross slices across the axis."""
    level = low + (np.arange(N_SLICES) + 0.5) * (high - low) / N_SLICES
    outer, inner = np.zeros(N_SLICES), np.zeros(N_SLICES)
    apart = shape.triangles - center
    z = apart @ axis
    radii = np.linalg.norm(apart - z[..., None] * axis, axis=2)
    z0, z1 = z.reshape(-1), np.roll(z, -1, axis=1).reshape(-1)
    r0, r1 = radii.reshape(-1), np.roll(radii, -1, axis=1).reshape(-1)
    for k in range(N_SLICES):
        hit = (z0 - level[k]) * (z1 - level[k]) < 0
        if hit.any():
            share = (level[k] - z0[hit]) / (z1[hit] - z0[hit])
            r = r0[hit] + share * (r1[hit] - r0[hit])
            outer[k], inner[k] = r.max(), r.min()
    return outer, inner


def _tube_length(ports: list[Disc], area: float, volume: float, extents: Floats) -> float:
    """Length of the centreline if area, volume and two equal ports fit one round section, else 0.

    Pappus: side area = perimeter x length and volume = section x length hold for bends as for straight pieces.
    """
    if len(ports) != 2:
        return 0.0
    first, second = ports
    if abs(first.outer - second.outer) > 0.1 * first.outer:
        return 0.0
    n, outer, inner = first.sides, first.outer, 0.0 if first.inner >= first.outer else first.inner
    perimeter = 2 * n * np.sin(np.pi / n) * (outer + inner)
    length = float((area - first.area - second.area) / perimeter)
    if length < 0.98 * _distance(first, second) - 1e-6:
        return 0.0
    if volume:
        section = n / 2 * np.sin(2 * np.pi / n) * (outer**2 - inner**2)
        fits = abs(volume - section * length) < _TUBE_ERROR * section * length
    else:  # an open mesh encloses nothing, but a plane bend is as thick as its section
        fits = float(extents[2]) < 2.2 * outer
    if same_line(first.center, first.normal, second.center, second.normal, 0.1 * outer):
        # Ports that face away from each other on one line: straight, or an expansion loop, which is far wider.
        apart = _distance(first, second)
        fits = fits and (length < 1.05 * apart or (apart > 6 * outer and float(extents[1]) > 6 * outer))
    return length if fits else 0.0


def _wheel(shape: _Shape, center: Floats, axis: Floats, radius: float) -> tuple[float, int]:
    """Share of the area near the rim, and number of arms in between."""
    if radius < _THIN:
        return 0.0, 0
    middle = shape.triangles.mean(axis=1)
    apart = middle - center
    across = apart - (apart @ axis)[:, None] * axis
    share = np.linalg.norm(across, axis=1) / radius
    rim = float(shape.areas[share > 0.72].sum() / max(shape.areas.sum(), _THIN**2))
    between = (share > 0.36) & (share < 0.68)
    if not between.any():
        return rim, 0
    angles = angles_about(axis, across[between])
    gaps = np.diff(np.append(angles, angles[0] + 2 * np.pi)) > np.radians(25.0)
    return rim, int(gaps.sum())
