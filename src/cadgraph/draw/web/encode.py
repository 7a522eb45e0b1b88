"""One shape as the page takes it: vertices of 8 bytes on a grid over its box, and triangles of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.draw.render.crease import corner_normals
from cadgraph.draw.web.simplify import simplify
from cadgraph.geometry.kernels.key import mix
from cadgraph.geometry.kernels.parallel import ZERO, compiled, readable
from cadgraph.model.scene import Faces, Floats

__all__ = ["GRID", "Encoded", "decode", "encode"]

GRID = 65535
"""Steps along each side of a shape's box."""

FEW = 96
"""Triangles up to which a shape is sent in full at once."""

_LEAST = 64  # triangles that a coarse form may have in any case
_SHARE = 0.25  # of the triangles in the coarse form
_FAR = 0.1  # of a shape's diagonal: how far the coarse form may lie from it ...
_NEAR = 0.002  # ... and how far where there are few enough triangles already
_SMOOTH = 0.5  # cosine of the angle between a coarse face and the normal that it takes from the full form

Shorts = npt.NDArray[np.uint16]
Indices = npt.NDArray[np.uint32]


@dataclass(frozen=True, eq=False)
class Encoded:
    """One level of one shape.

    Args:
        low: ``(3,)`` float32, the corner of the grid [m].
        step: ``(3,)`` float32, its steps [m]; 0 along a side without extent.
        vertices: ``(n, 4)`` uint16: three steps from the corner, and two signed bytes of the normal (octahedral).
        indices: ``(m, 3)`` triangles, counter-clockwise.
    """

    low: npt.NDArray[np.float32]
    step: npt.NDArray[np.float32]
    vertices: Shorts
    indices: Indices

    @property
    def n_triangles(self) -> int:
        """How many triangles there are."""
        return len(self.indices)


def encode(vertices: Floats, faces: Faces) -> tuple[Encoded, Encoded | None] | None:
    """A shape in full and in its coarse form.

    Faces that refer to a vertex that isn't there or isn't finite, and those without area on the grid, are left out.

    Args:
        vertices: ``(n, 3)`` [m], round zero.
        faces: ``(m, 3)``.

    Returns:
        The full form and the coarse one, which is None where the full form has few triangles; None without any.
    """
    points, corners = readable(vertices, np.float64), readable(faces, np.int32)
    bounds = np.empty((2, 3))
    whole = np.empty((len(corners), 3), np.int32)
    whole = whole[: _whole_faces(points, corners, bounds, whole)]
    if not len(whole):
        return None
    low = bounds[0].astype(np.float32)
    step = ((bounds[1] - low) / GRID).astype(np.float32)
    place, spots = np.full(len(points), -1, np.int32), np.empty((len(points), 3), np.uint16)
    n_spots = _find_spots(points, whole, low.astype(np.float64), step.astype(np.float64), place, spots)
    kept = np.empty((len(whole), 3), np.int32)
    n_kept = _faces_of_spots(whole, place, kept)
    if not n_kept:
        return None
    kept, spots = kept[:n_kept], spots[:n_spots]
    places = low + spots * step.astype(np.float64)
    full = _welded(spots, kept, _packed(corner_normals(places, kept)))
    form = Encoded(low, step, *full)
    if n_kept <= FEW:
        return form, None
    diagonal = float(np.linalg.norm(bounds[1] - bounds[0]))
    most = max(_LEAST, int(_SHARE * n_kept))
    coarse = simplify(places, kept, most, _FAR * diagonal, _NEAR * diagonal)
    normals = np.empty((len(coarse), 3), np.uint16)
    _take_normals(places, kept, full[0], full[1], coarse, normals)
    return form, Encoded(low, step, *_welded(spots, coarse, normals))


def decode(form: Encoded) -> tuple[Floats, Floats]:
    """The positions [m] and unit normals of a shape's vertices, as the page reads them; both ``(n, 3)``."""
    positions = form.low.astype(np.float64) + form.vertices[:, :3] * form.step.astype(np.float64)
    a, b = (form.vertices[:, 3:].copy().view(np.int8).astype(np.float64) / 127).T
    normals = np.stack([a, b, 1 - np.abs(a) - np.abs(b)], axis=1)
    fold = np.maximum(-normals[:, 2:], 0)
    normals[:, :2] -= np.where(normals[:, :2] >= 0, fold, -fold)
    units: Floats = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    return positions, units


@compiled
def _whole_faces(vertices: Any, faces: Any, bounds: Any, whole: Any) -> int:
    """The faces whose vertices are there and finite; how many they are. Their box goes to ``bounds``."""
    for i in range(3):
        bounds[0, i], bounds[1, i] = np.inf, -np.inf
    found: int = ZERO
    for f in range(len(faces)):
        sound = True
        for c in range(3):
            v = faces[f, c]
            sound = sound and 0 <= v < len(vertices)
            for i in range(3):
                sound = sound and abs(vertices[v, i]) < np.inf
        if not sound:
            continue
        for c in range(3):
            v = faces[f, c]
            whole[found, c] = v
            for i in range(3):
                bounds[0, i], bounds[1, i] = min(bounds[0, i], vertices[v, i]), max(bounds[1, i], vertices[v, i])
        found += 1
    return found


@compiled
def _slot(table: Any, key: Any, keys: Any) -> Any:
    """Where in a hash table of numbers the one with a key stands, or belongs; ``keys`` says the key of each number."""
    at = np.int64(mix(key) & np.uint64(len(table) - 1))
    while table[at] >= 0 and keys[table[at]] != key:
        at = (at + 1) & (len(table) - 1)
    return at


@compiled
def _table(entries: int) -> Any:
    """An empty hash table, a power of two and at least twice as large as what goes into it."""
    size = 16
    while size < 2 * entries:
        size *= 2
    return np.full(size, -1, np.int32)


@compiled
def _find_spots(vertices: Any, faces: Any, low: Any, step: Any, place: Any, spots: Any) -> int:
    """The distinct grid points of the vertices that faces use, in the order of the faces; how many they are."""
    table, keys = _table(len(vertices)), np.empty(len(vertices), np.uint64)
    found: int = ZERO
    for f in range(len(faces)):
        for c in range(3):
            v = faces[f, c]
            if place[v] >= 0:
                continue
            key = np.uint64(0)
            for i in range(3):
                steps = 0.0
                if step[i] > 0.0:
                    steps = min(max(np.rint((vertices[v, i] - low[i]) / step[i]), 0.0), 65535.0)
                spots[found, i] = np.uint16(steps)
                key = (key << np.uint64(16)) | np.uint64(steps)
            slot = _slot(table, key, keys)
            if table[slot] < 0:
                table[slot] = found
                keys[found] = key
                found += 1
            place[v] = table[slot]
    return found


@compiled
def _faces_of_spots(faces: Any, place: Any, kept: Any) -> int:
    """The faces of three different grid points; how many they are."""
    found: int = ZERO
    for f in range(len(faces)):
        x, y, z = place[faces[f, 0]], place[faces[f, 1]], place[faces[f, 2]]
        if x != y and y != z and z != x:
            kept[found, 0], kept[found, 1], kept[found, 2] = x, y, z
            found += 1
    return found


def _packed(normals: npt.NDArray[np.float32]) -> Shorts:
    """``(m, 3)`` the normals of corners ``(m, 3, 3)`` as two signed bytes each (octahedral, Meyer et al. 2010)."""
    packed = np.empty(normals.shape[:2], np.uint16)
    _pack_normals(normals, packed)
    return packed


@compiled
def _pack_normals(normals: Any, packed: Any) -> None:
    for f in range(len(normals)):
        for c in range(3):
            packed[f, c] = _octahedral(normals[f, c, 0], normals[f, c, 1], normals[f, c, 2])


@compiled
def _octahedral(x: float, y: float, z: float) -> Any:
    long = abs(x) + abs(y) + abs(z)
    a, b = (x / long, y / long) if long > 0.0 else (0.0, 0.0)
    if z < 0.0:
        a, b = (1.0 - abs(b)) * (1.0 if x >= 0.0 else -1.0), (1.0 - abs(a)) * (1.0 if y >= 0.0 else -1.0)
    low, high = np.int64(np.rint(127.0 * a)) & 255, np.int64(np.rint(127.0 * b)) & 255
    return np.uint16(low | (high << 8))


def _welded(spots: Shorts, faces: Faces, normals: Shorts) -> tuple[Shorts, Indices]:
    """Vertices of like place and normal as one, in the order in which the triangles first use them."""
    vertices = np.empty((3 * len(faces), 4), np.uint16)
    indices = np.empty((len(faces), 3), np.uint32)
    count = _weld(spots, faces, normals, vertices, indices)
    return vertices[:count].copy(), indices


@compiled
def _weld(spots: Any, faces: Any, normals: Any, vertices: Any, indices: Any) -> int:
    table, keys = _table(3 * len(faces)), np.empty(3 * len(faces), np.uint64)
    found: int = ZERO
    for f in range(len(faces)):
        for c in range(3):
            spot = faces[f, c]
            key = (np.uint64(spot) << np.uint64(16)) | np.uint64(normals[f, c])
            slot = _slot(table, key, keys)
            if table[slot] < 0:
                table[slot] = found
                keys[found] = key
                for i in range(3):
                    vertices[found, i] = spots[spot, i]
                vertices[found, 3] = normals[f, c]
                found += 1
            indices[f, c] = table[slot]
    return found


@compiled
def _take_normals(places: Any, full: Any, vertices: Any, indices: Any, coarse: Any, normals: Any) -> None:
    """For each corner of a coarse form the normal of the full one there that is nearest to the coarse face's.

    So what is round looks round although it has fewer sides, and an edge stays an edge.
    """
    start, around = np.zeros(len(places) + 1, np.int32), np.empty(3 * len(full), np.int32)
    for f in range(len(full)):
        for c in range(3):
            start[full[f, c] + 1] += 1
    for v in range(len(places)):
        start[v + 1] += start[v]
    filled = start.copy()
    for f in range(len(full)):
        for c in range(3):
            v = full[f, c]
            around[filled[v]] = indices[f, c]
            filled[v] += 1
    for f in range(len(coarse)):
        a, b, d = coarse[f, 0], coarse[f, 1], coarse[f, 2]
        ux, uy, uz = places[b, 0] - places[a, 0], places[b, 1] - places[a, 1], places[b, 2] - places[a, 2]
        vx, vy, vz = places[d, 0] - places[a, 0], places[d, 1] - places[a, 1], places[d, 2] - places[a, 2]
        x, y, z = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
        long = np.sqrt(x * x + y * y + z * z)
        scale = 1.0 / long if long > 0.0 else 0.0
        x, y, z = x * scale, y * scale, z * scale
        for c in range(3):
            v = coarse[f, c]
            best, chosen = _SMOOTH, np.int64(-1)
            for k in range(start[v], start[v + 1]):
                like = _along(vertices[around[k], 3], x, y, z)
                if like > best:
                    best, chosen = like, np.int64(around[k])
            normals[f, c] = vertices[chosen, 3] if chosen >= 0 else _octahedral(x, y, z)


@compiled
def _along(packed: Any, x: float, y: float, z: float) -> float:
    """The cosine between a packed normal and a direction."""
    low, high = np.int64(packed) & 255, np.int64(packed) >> 8
    a = (low - 256 if low > 127 else low) / 127.0
    b = (high - 256 if high > 127 else high) / 127.0
    c = 1.0 - abs(a) - abs(b)
    fold = max(-c, 0.0)
    a, b = a - (fold if a >= 0.0 else -fold), b - (fold if b >= 0.0 else -fold)
    long: float = np.sqrt(a * a + b * b + c * c)
    return (a * x + b * y + c * z) / long
