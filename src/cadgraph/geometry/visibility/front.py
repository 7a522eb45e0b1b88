"""Which way something with a dial or a screen looks: what each of its sides shows, seen from far away."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from cadgraph.geometry.visibility.rays import ray_tree
from cadgraph.model.parts import Bools
from cadgraph.model.scene import Faces, Floats, Ints

__all__ = ["FEATURES", "Side", "sides_of"]

_RINGS = (0.0, 0.2, 0.4, 0.55, 0.7, 0.82, 0.9, 0.97, 1.04)  # of the head's radius, where rays are sent
_SPOKES = 12
_INNER, _RIM = 0.75, (0.8, 1.1)  # of the radius: where the dial is, and where its rim
_FLAT = 0.15  # a piece is a plate where its least extent is at most this share of the middle one
_PARALLEL = 0.98
_THIN, _LEAF, _ASIDE = 0.12, (0.5, 2.1), 0.6  # of the radius: how thick, long and far aside what lies on a dial is
_MOST_FACES = 60_000  # of one unit; beyond it only the largest are looked at
FEATURES = (
    *("read", "plate", "recess", "pocket", "flat", "stem", "broad", "level", "down", "fine", "leaves", "ahead"),
    *("most read", "most plate", "most pocket"),
)
"""What is told of a side.

How much of what is seen is to be read (a dial, a needle, a glass), or a plate; how deep its middle lies below its rim,
with all that is in it and with the case alone; how much of it is flat; how far off the rest of it lies behind; how
broad it is against the whole head; whether it looks level, or down; how many depths are seen; where the leaves within
the case lie, from its back to its front, and how many more are in its front half; and then some of these against the
most of any side.
"""


@dataclass(frozen=True, eq=False)
class Side:
    """One side of something.

    Args:
        center: ``(3,)`` the middle of its head [m].
        direction: ``(3,)`` unit vector out of it.
        depth: from the middle of the head to this side [m].
        radius: of the head, seen from there [m].
        features: ``(len(FEATURES),)`` what is seen from there.
    """

    center: Floats
    direction: Floats
    depth: float
    radius: float
    features: Floats


@dataclass(frozen=True, eq=False)
class _Shell:
    """A piece of surface that hangs together."""

    faces: Ints
    center: Floats
    axes: Floats
    extents: Floats
    area: float
    head: bool


def sides_of(vertices: Floats, faces: Faces, kinds: Ints) -> list[Side]:
    """The sides that something may look to, each with what it shows.

    Args:
        vertices: ``(n, 3)`` [m].
        faces: ``(m, 3)`` triangles, of all its parts.
        kinds: ``(m,)`` what each is of: 2 of what is read (a dial, a needle, a glass), 1 of its case or of something
            that may be its case, 0 of what carries it.

    Returns:
        Both ends of some axes, opposite ones side by side; none where there is nothing to see.
    """
    corners = vertices[faces]
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    double = np.linalg.norm(cross, axis=1)
    good = np.isfinite(double) & (double > 0)
    if good.sum() > _MOST_FACES:
        good &= double >= np.partition(double[good], -_MOST_FACES)[-_MOST_FACES]
    if not good.any():
        return []
    corners, double, kinds, faces = corners[good], double[good], kinds[good], faces[good]
    normals = cross[good] / double[:, None]
    shells = _shells(vertices, faces, corners, 0.5 * double, kinds)
    case = _case(shells)
    low, high = case.center - 0.55 * _reach(case), case.center + 0.55 * _reach(case)
    members = [s for s in shells if s is case or bool(((s.center >= low) & (s.center <= high)).all())]
    head = np.concatenate([s.faces for s in members])
    plates = [s for s in members if s is not case and _is_plate(s)]
    plate_of = np.zeros(len(faces), np.bool_)
    for shell in plates:
        plate_of[shell.faces] = True
    axes = _axes(case, plates, normals[head], double[head], kinds[head])
    view = _View(corners, normals, kinds, plate_of, double, case, members)
    return view.sides(np.array([turn * axis for axis in axes for turn in (1.0, -1.0)]))


def _reach(case: _Shell) -> Floats:
    """Full sides of the upright box around the oriented one."""
    found: Floats = np.abs(case.axes.T) @ case.extents
    return found


def _shells(vertices: Floats, faces: Faces, corners: Floats, area: Floats, kinds: Ints) -> list[_Shell]:
    """Pieces that share corners, of one kind each."""
    # Corners at one place are one corner, to a hundredth of a millimetre.
    place = np.round(corners.reshape(-1, 3) / 1e-5).astype(np.int64)
    place -= place.min(axis=0)
    spans = place.max(axis=0) + 1
    _, welded = np.unique((place[:, 0] * spans[1] + place[:, 1]) * spans[2] + place[:, 2], return_inverse=True)
    rows = welded.reshape(-1, 3)
    n = int(rows.max()) + 1
    pairs = np.concatenate([rows[:, :2], rows[:, 1:]])
    of_corner = connected_components(coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(n, n)))[1]
    shell, label = np.unique(of_corner[rows[:, 0]] * 3 + kinds, return_inverse=True)
    order = np.argsort(label, kind="stable")
    bounds = np.searchsorted(label[order], np.arange(len(shell) + 1))
    points, owner = corners[order].reshape(-1, 3), np.repeat(label[order], 3)
    weight = np.repeat(area[order], 3)
    total = np.add.reduceat(weight, 3 * bounds[:-1])
    mean = np.add.reduceat(points * weight[:, None], 3 * bounds[:-1]) / total[:, None]
    off = points - mean[owner]
    products = (off[:, :, None] * off[:, None, :]) * weight[:, None, None]
    spread = np.add.reduceat(products, 3 * bounds[:-1]) / total[:, None, None]
    axes = np.linalg.eigh(spread)[1].transpose(0, 2, 1)
    along = np.einsum("nij,nj->ni", axes[owner], off)
    low, high = np.minimum.reduceat(along, 3 * bounds[:-1]), np.maximum.reduceat(along, 3 * bounds[:-1])
    center = mean + np.einsum("nij,ni->nj", axes, 0.5 * (low + high))
    found = []
    for k in range(len(shell)):
        rank = np.argsort(low[k] - high[k], kind="stable")
        own = order[bounds[k] : bounds[k + 1]]
        head = bool(kinds[own[0]] > 0)
        found.append(_Shell(own, center[k], axes[k, rank], (high - low)[k, rank], float(total[k] / 3), head))
    return found


def _case(shells: Sequence[_Shell]) -> _Shell:
    """The piece that is the case: broad two ways, and its box well filled, which tubes and coils don't do."""

    def size(shell: _Shell) -> float:
        long, wide, thin = shell.extents
        around = 2 * (long * wide + wide * thin + long * thin)
        filled = min(1.0, shell.area / around) if around > 0 else 0.0
        return float(wide * wide * max(thin, 0.1 * wide) * filled * filled)

    heads = [s for s in shells if s.head] or list(shells)
    return max(heads, key=size)


def _is_plate(shell: _Shell) -> bool:
    return bool(shell.extents[2] <= _FLAT * shell.extents[1])


def _axes(case: _Shell, plates: Sequence[_Shell], normals: Floats, double: Floats, kinds: Ints) -> list[Floats]:
    """What it may look along: across its plates, along the axes of its case, across its largest flat faces."""
    found: list[Floats] = []

    def add(axis: Floats) -> None:
        if all(abs(float(axis @ other)) < _PARALLEL for other in found):
            found.append(axis / np.linalg.norm(axis))

    for plate in sorted(plates, key=lambda s: -s.area)[:2]:
        add(plate.axes[2])
    weight = double * (1.0 + kinds)
    for _ in range(2):
        if not weight.any():
            break
        seed = normals[int(np.argmax(weight))]
        near = np.abs(normals @ seed) >= _PARALLEL
        add(seed)
        weight = np.where(near, 0.0, weight)
    for axis in case.axes:
        add(axis)
    return found


class _View:
    """Something as rays meet it."""

    def __init__(
        self, corners: Floats, normals: Floats, kinds: Ints, plates: Bools, double: Floats,
        case: _Shell, members: Sequence[_Shell],
    ) -> None:  # fmt: skip
        self.normals, self.kinds, self.plates, self.case, self.members = normals, kinds, plates, case, members
        self.center = case.center
        self.points = corners[np.concatenate([s.faces for s in members])].reshape(-1, 3) - self.center
        self.case_points = corners[case.faces].reshape(-1, 3) - self.center
        sizes = sorted(np.ptp(self.points, axis=0).tolist())
        self.broadest = max(1e-12, sizes[1] * sizes[2])
        self.whole = _Target(corners - self.center)
        self.bare = _Target(corners[case.faces] - self.center)
        self.behind = np.average(corners.mean(axis=1), axis=0, weights=double) - self.center

    def sides(self, directions: Floats) -> list[Side]:
        """What is seen looking against each direction; ``(n, 3)``, opposite ones side by side."""
        turns = 2 * np.pi * np.arange(_SPOKES) / _SPOKES
        rings = np.repeat(_RINGS, _SPOKES)
        seen, starts = [], []
        for direction in directions:
            u = np.cross(direction, (0.0, 0.0, 1.0) if abs(direction[2]) < 0.9 else (1.0, 0.0, 0.0))
            u /= np.linalg.norm(u)
            v = np.cross(direction, u)
            spans = [float(np.ptp(self.points @ axis)) for axis in (u, v)]
            depth, radius = float((self.points @ direction).max()), max(0.5 * min(spans), 1e-6)
            spokes = np.cos(turns)[:, None] * u + np.sin(turns)[:, None] * v
            plane = (np.array(_RINGS)[:, None, None] * radius * spokes[None]).reshape(-1, 3)
            starts.append(plane + (depth + radius) * direction)
            seen.append((direction, depth, radius, spans))
        aims = np.repeat(-directions, len(rings), axis=0)
        origins = np.concatenate(starts)
        n = len(rings)
        whole, bare = self.whole.hits(origins, aims), self.bare.hits(origins, aims)[0]
        rows = []
        for k, (direction, depth, radius, spans) in enumerate(seen):
            own = slice(k * n, k * n + n)
            heights = depth + radius - whole[0][own], depth + radius - bare[own]
            rows.append(self._features(rings, heights, whole[1][own], direction, radius, spans))
        table = np.array(rows)
        most = np.maximum(table[:, [FEATURES.index(name) for name in ("read", "plate", "pocket")]], 0.0)
        table = np.hstack([table, most / np.maximum(most.max(axis=0), 1e-3)])
        return [
            Side(self.center, direction, depth, radius, features)
            for (direction, depth, radius, _), features in zip(seen, table, strict=True)
        ]

    def _features(
        self, rings: Floats, heights: tuple[Floats, Floats], hits: Ints, direction: Floats, radius: float,
        spans: Sequence[float],
    ) -> list[float]:  # fmt: skip
        inner = rings <= _INNER
        seen = inner & (hits >= 0)
        count = int(inner.sum())
        facing = np.abs(self.normals[hits[seen]] @ direction) >= _PARALLEL
        depths = np.unique(np.round(heights[0][seen] / radius, 3))
        leaves, ahead = self._leaves(direction, radius)
        return [
            float((self.kinds[hits[seen]] == 2).sum()) / count,
            float(self.plates[hits[seen]].sum()) / count,
            _sunk(rings, heights[0], radius),
            _sunk(rings, heights[1], radius),
            float(facing.sum()) / count,
            float(np.clip(-self.behind @ direction / radius, -2.0, 2.0)),
            float(np.clip(spans[0] * spans[1] / self.broadest, 0.0, 1.0)),
            1.0 - abs(float(direction[2])),
            max(0.0, -float(direction[2])),
            min(1.0, len(depths) / 20.0),
            leaves,
            ahead,
        ]

    def _leaves(self, direction: Floats, radius: float) -> tuple[float, float]:
        """Where thin pieces across a direction lie in the case, from -1 (back) to 1 (front), and how many are ahead."""
        along = self.case_points @ direction
        low, high = float(along.min()), float(along.max())
        half = max(0.5 * (high - low), 1e-6)
        places = []
        for shell in self.members:
            if shell is self.case or not _LEAF[0] * radius <= shell.extents[0] <= _LEAF[1] * radius:
                continue
            off = shell.center - self.center
            place = float(off @ direction)
            thick = float(np.abs(shell.axes @ direction) @ shell.extents)
            aside = float(np.linalg.norm(off - place * direction))
            if thick <= _THIN * radius and aside <= _ASIDE * radius:
                places.append((place - 0.5 * (low + high)) / half)
        if not places:
            return 0.0, 0.0
        return float(np.clip(np.mean(places), -1.0, 1.0)), float(np.clip(np.sign(places).sum() / 3.0, -1.0, 1.0))


def _sunk(rings: Floats, heights: Floats, radius: float) -> float:
    """How far the middle lies below the rim, in radii; heights are minus infinity where nothing is met."""
    inner, rim = (
        (rings <= _INNER) & np.isfinite(heights),
        (rings >= _RIM[0]) & (rings <= _RIM[1]) & np.isfinite(heights),
    )
    if not inner.any() or not rim.any():
        return 0.0
    return float(np.clip((np.quantile(heights[rim], 0.75) - np.median(heights[inner])) / radius, -1.0, 1.0))


class _Target:
    """Triangles that rays are sent to."""

    def __init__(self, corners: Floats) -> None:
        points = corners.reshape(-1, 3)
        self._tree = ray_tree(points, np.arange(len(points), dtype=np.int32).reshape(-1, 3))

    def hits(self, origins: Floats, aims: Floats) -> tuple[Floats, Ints]:
        """How far each ray goes [m], infinity where it meets nothing; and the triangle that it meets, or -1."""
        found = self._tree.first(origins, aims)
        hit = found.face.astype(np.int64)
        return np.where(hit >= 0, found.distance.astype(np.float64), np.inf), hit
