"""What a camera sees of triangles, sample by sample and in a fixed order: the same on every run, ties included.

Rays (``caster``) leave it to the order of a tree, built by several threads, which of two coincident faces they meet.
Here a mesh of choice wins such ties, the earlier one among all others, so that nothing speckles; and a plane may cut
through what is drawn.

A sample lies within a triangle where three edge functions of its direction have one sign (M. Olano and T. Greer,
Triangle Scan Conversion using 2D Homogeneous Coordinates, 1997), which needs no clipping before the eye.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.draw.render.caster import Indices, Singles
from cadgraph.draw.render.surface import Viewport
from cadgraph.geometry.kernels.parallel import compiled, readable
from cadgraph.geometry.visibility.rays import Hits
from cadgraph.model.scene import Floats, Scene, mesh_of_face

__all__ = ["Facets", "Favour", "Seen", "favour", "see", "solidity"]

Bools = npt.NDArray[np.bool_]

_NEARER, _LEAST_NEARER, _MOST_NEARER = 0.004, 2.5e-4, 2e-3  # share of the size, and limits [m], see ``favour``
_NEAR = 1e-6  # [m] triangles that reach nearer to the eye may lie anywhere in the picture


@dataclass(frozen=True)
class Facets:
    """Triangles for the kernels here.

    Args:
        vertices: ``(n, 3)`` float64 [m].
        faces: ``(m, 3)`` int64 indices.
        mesh_of_face: ``(m,)`` int32.
        n_meshes: how many meshes there are.
    """

    vertices: Floats
    faces: npt.NDArray[np.int64]
    mesh_of_face: Indices
    n_meshes: int

    @classmethod
    def of(cls, scene: Scene) -> Facets:
        """All triangles of a scene."""
        return cls(
            readable(scene.vertices, np.float64),
            readable(scene.global_faces(), np.int64),
            readable(mesh_of_face(scene), np.int32),
            scene.n_meshes,
        )


@dataclass(frozen=True)
class Favour:
    """Who wins where surfaces coincide.

    Args:
        mesh: it counts as nearer than it is; -1 for none.
        by: so much [m].
        tie: of two others the later one has to be nearer by more than this [m].
    """

    mesh: int = -1
    by: float = 0.0
    tie: float = 1.5e-4


def favour(vertices: npt.ArrayLike) -> float:
    """By how much a mesh counts as nearer than it is, so that it shows where its surface coincides with another's [m].

    Surfaces that are to coincide lie as far apart as round ones of different facets do: by some thousandths of the
    size.

    Args:
        vertices: ``(n, 3)`` of the mesh [m].
    """
    size = np.sort(np.ptp(np.asarray(vertices, np.float64).reshape(-1, 3), axis=0))[1]
    return min(max(_NEARER * float(size), _LEAST_NEARER), _MOST_NEARER)


@dataclass(frozen=True)
class Seen:
    """What the samples of a picture show.

    Args:
        port: the picture; all of its camera's.
        side: samples along each side of a pixel.
        face: ``(n,)`` int32, row by row of samples; -1 where nothing is seen, the number of all faces on the cut.
        depth: ``(n,)`` along the viewing direction [m], infinite where nothing is seen.
    """

    port: Viewport
    side: int
    face: Indices
    depth: Floats

    def hits(self, facets: Facets, towards: Singles, pixels: npt.NDArray[np.int64], normal: Floats) -> Hits:
        """What the samples of some pixels show, pixel by pixel.

        Args:
            facets: what was drawn.
            towards: ``(n, 3)`` float32 unit directions of these samples.
            pixels: ``(k,)`` row by row.
            normal: ``(3,)`` of the plane that cuts.
        """
        n = len(towards)
        found = Hits(
            np.empty(n, np.int32), np.zeros(n, np.float32), np.zeros(n, np.float32), np.empty(n, np.float32),
            np.zeros((n, 3), np.float32),
        )  # fmt: skip
        camera = self.port.camera
        _look_up(
            self.port.width, self.side, pixels, self.port.axes, camera.eye, facets.vertices, facets.faces, self.face,
            self.depth, towards, normal, *found,
        )  # fmt: skip
        return found


def see(
    port: Viewport, facets: Facets, side: int, skip: Bools, favour: Favour, cut: Floats | None = None
) -> tuple[Seen, Floats]:
    """Draws triangles.

    Args:
        port: the picture.
        facets: the triangles.
        side: samples along each side of a pixel.
        skip: ``(n_meshes,)`` what isn't drawn.
        favour: who wins ties.
        cut: ``(4,)`` a plane: what lies at ``normal . x > offset`` is taken away, and solids are closed there. None
            cuts nothing. Its normal has to point to the side of the eye.

    Returns:
        What is seen, and the normal of the cut (zero without one).
    """
    n = port.width * port.height * side * side
    face, depth = np.full(n, -1, np.int32), np.full(n, np.inf)
    plane = np.zeros(4)
    solid = np.full(facets.n_meshes, -1, np.int8)
    if cut is not None:
        eye, axes = port.camera.eye, port.axes
        plane[:3] = [(axes[i] * cut[:3]).sum() for i in range(3)]
        plane[3] = cut[3] - (cut[:3] * eye).sum()
        solid = solidity(facets, skip)
    within = np.zeros(n if cut is not None else 0, np.int16)
    _fill(
        port.axes, port.camera.eye, port.view, port.width, port.height, side, facets.vertices, facets.faces,
        facets.mesh_of_face, skip, favour.mesh, favour.by, favour.tie, plane, solid, face, depth, within,
    )  # fmt: skip
    if cut is not None:
        _close(port.view, port.width, side, plane, len(facets.faces), within, face, depth)
    return Seen(port, side, face, depth), np.zeros(3) if cut is None else cut[:3]


def solidity(facets: Facets, skip: Bools) -> npt.NDArray[np.int8]:
    """How it is found out what lies inside the meshes.

    Args:
        facets: the triangles.
        skip: ``(n_meshes,)`` what isn't looked at.

    Returns:
        ``(n_meshes,)`` 1 where every edge is run through as often either way: the winding number says how deep inside
        a place is. 2 where an even number of faces meets at every edge: only whether a place is. 0 where nobody can
        say.
    """
    kinds = np.zeros(facets.n_meshes, np.int8)
    for mesh in np.flatnonzero(~skip):
        faces = facets.faces[facets.mesh_of_face == mesh]
        if not len(faces):
            continue
        _, place = np.unique(facets.vertices[faces.reshape(-1)], axis=0, return_inverse=True)
        corners = place.reshape(-1, 3)
        start, end = corners.reshape(-1), np.roll(corners, -1, axis=1).reshape(-1)
        other = start != end
        low, high = np.minimum(start, end)[other], np.maximum(start, end)[other]
        edge = np.unique(low.astype(np.int64) * (len(place) + 1) + high, return_inverse=True)[1].reshape(-1)
        balance = np.bincount(edge, weights=np.where(start < end, 1.0, -1.0)[other])
        if not balance.any():
            kinds[mesh] = 1
        elif not (np.bincount(edge) % 2).any():
            kinds[mesh] = 2
    return kinds


@compiled
def _fill(
    axes: Any, eye: Any, view: Any, width: int, height: int, side: int, vertices: Any, faces: Any, mesh_of_face: Any,
    skip: Any, favoured: int, by: float, tie: float, plane: Any, solid: Any, face: Any, depth: Any, within: Any,
) -> None:  # fmt: skip
    """Draws the nearest triangle into each sample.

    Args:
        axes: to the right, upwards, into the picture.
        eye: position.
        view: column and row of the middle [px], size of a pixel at a depth of 1.
        width: [px].
        height: [px].
        side: samples along each side of a pixel.
        vertices: see Facets; likewise the next two.
        faces: see there.
        mesh_of_face: see there.
        skip: ``(n_meshes,)``.
        favoured: the mesh that wins ties.
        by: see Favour.
        tie: see Favour.
        plane: ``(4,)`` in the camera's axes; a null normal cuts nothing.
        solid: ``(n_meshes,)`` see :func:`solidity`.
        face: ``(n_samples,)`` the outcome.
        depth: likewise; it counts ``by`` less where the favoured mesh is seen until all is drawn.
        within: ``(n_samples,)`` winding number, or number of surfaces, beyond the plane; empty where nothing is cut.
    """
    across, down = width * side, height * side
    corner, edge, scale = np.empty((3, 3)), np.empty((3, 3)), np.empty(4)
    scale[0] = view[2] / side
    scale[1], scale[2] = 0.5 * scale[0] - view[0] * view[2], view[1] * view[2] - 0.5 * scale[0]
    for f in range(len(faces)):
        mesh = mesh_of_face[f]
        if skip[mesh] or not _turn(axes, eye, vertices, faces, f, corner):
            continue
        left, right, top, bottom = _bounds(view, side, across, down, corner)
        if not (left <= right and top <= bottom):
            continue
        volume = _edges(corner, edge)
        if volume == 0.0 or not np.isfinite(volume):
            continue
        scale[3] = by if mesh == favoured else 0.0
        _samples(f, mesh, abs(volume), 1 if volume > 0 else -1, int(left), int(right), int(top), int(bottom), across,
                 scale, edge, mesh_of_face, tie, plane, solid[mesh], face, depth, within)  # fmt: skip
    if by > 0:
        for k in range(len(face)):
            if face[k] >= 0 and mesh_of_face[face[k]] == favoured:
                depth[k] += by


@compiled
def _turn(axes: Any, eye: Any, vertices: Any, faces: Any, f: int, corner: Any) -> bool:
    """Writes the corners of a face in the camera's axes; says whether any of them lies before the eye."""
    ahead = False
    for c in range(3):
        v = faces[f, c]
        x, y, z = vertices[v, 0] - eye[0], vertices[v, 1] - eye[1], vertices[v, 2] - eye[2]
        for i in range(3):
            corner[c, i] = axes[i, 0] * x + axes[i, 1] * y + axes[i, 2] * z
        ahead |= corner[c, 2] > _NEAR
    return ahead


@compiled
def _bounds(view: Any, side: int, across: int, down: int, corner: Any) -> tuple[float, float, float, float]:
    """First and last column, first and last row of the samples that a triangle may cover."""
    left, right, top, bottom = 0.0, across - 1.0, 0.0, down - 1.0
    if min(corner[0, 2], corner[1, 2], corner[2, 2]) <= _NEAR:
        return left, right, top, bottom
    low, high, first, last = 1e18, -1e18, 1e18, -1e18
    for c in range(3):
        x = (corner[c, 0] / corner[c, 2] / view[2] + view[0]) * side - 0.5
        y = (view[1] - corner[c, 1] / corner[c, 2] / view[2]) * side - 0.5
        low, high, first, last = min(low, x), max(high, x), min(first, y), max(last, y)
    return (
        max(left, np.ceil(low - 1e-6)), min(right, np.floor(high + 1e-6)),
        max(top, np.ceil(first - 1e-6)), min(bottom, np.floor(last + 1e-6)),
    )  # fmt: skip


@compiled
def _edges(corner: Any, edge: Any) -> float:
    """Writes the edge functions of a triangle, positive inside; says what volume it spans with the eye."""
    volume = 0.0
    for c in range(3):
        a, b = (c + 1) % 3, (c + 2) % 3
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            edge[c, i] = corner[a, j] * corner[b, k] - corner[a, k] * corner[b, j]
    for i in range(3):
        volume += corner[0, i] * edge[0, i]
    if volume < 0:
        for c in range(3):
            for i in range(3):
                edge[c, i] = -edge[c, i]
    return volume


@compiled
def _samples(
    f: int, mesh: int, volume: float, turn: int, left: int, right: int, top: int, bottom: int, across: int, scale: Any,
    edge: Any, mesh_of_face: Any, tie: float, plane: Any, solid: int, face: Any, depth: Any, within: Any,
) -> None:  # fmt: skip
    """Draws one triangle.

    Args:
        f: the face.
        mesh: whose it is.
        volume: that it spans with the eye, positive.
        turn: 1 or -1, which side of it is seen.
        left: first column.
        right: last column.
        top: first row.
        bottom: last row.
        across: samples in a row.
        scale: ``(4,)`` distance between samples at a depth of 1, place of the first, and by how much the mesh counts
            as nearer.
        edge: ``(3, 3)`` edge functions.
        mesh_of_face: see ``_fill``.
        tie: see there.
        plane: see there.
        solid: of the mesh, see there.
        face: see there.
        depth: see there.
        within: see there.
    """
    ax, ay, az = edge[0, 0], edge[0, 1], edge[0, 2]
    bx, by, bz = edge[1, 0], edge[1, 1], edge[1, 2]
    cx, cy, cz = edge[2, 0], edge[2, 1], edge[2, 2]
    step, start, nearer, cutting = scale[0], scale[1], scale[3], len(within) > 0
    for row in range(top, bottom + 1):
        y = scale[2] - row * step
        # Where along the row each edge function is not negative, and one sample more for what rounding takes away.
        low, high = _span(ax, ay * y + az, float(left), float(right), step, start)
        low, high = _span(bx, by * y + bz, low, high, step, start)
        low, high = _span(cx, cy * y + cz, low, high, step, start)
        if not low <= high:
            continue
        for column in range(int(low), int(high) + 1):
            x = column * step + start
            first, second, third = ax * x + ay * y + az, bx * x + by * y + bz, cx * x + cy * y + cz
            total = first + second + third
            if first < 0 or second < 0 or third < 0 or not total > 0:
                continue
            z = volume / total
            k = row * across + column
            if cutting:
                if (plane[0] * x + plane[1] * y + plane[2]) * z > plane[3]:
                    continue
                within[k] = _counted(within[k], solid, turn)
            z -= nearer
            before = face[k]
            least = tie if before >= 0 and mesh_of_face[before] != mesh else 0.0
            if 0.0 < z < depth[k] - least:
                face[k], depth[k] = f, z


@compiled
def _counted(within: int, solid: int, turn: int) -> int:
    """Winding number, twice, or whether the number of surfaces is odd, with one surface more."""
    if solid == 1:
        return within + 2 * turn
    return within ^ 1 if solid == 2 else 0


@compiled
def _span(slope: float, rest: float, low: float, high: float, step: float, start: float) -> tuple[float, float]:
    """First and last column, of those given, between which ``slope * x + rest`` isn't negative."""
    if slope > 0:
        low = max(low, np.floor((-rest / slope - start) / step))
    elif slope < 0:
        high = min(high, np.ceil((-rest / slope - start) / step))
    elif rest < 0:
        high = low - 1.0
    return low, high


@compiled
def _close(
    view: Any, width: int, side: int, plane: Any, cap: int, within: Any, face: Any, depth: Any
) -> None:  # fmt: skip
    """Lets samples that lie within a solid where the plane cuts it show the cut."""
    across = width * side
    for k in range(len(face)):
        if within[k] == 0:
            continue
        x = (k % across + 0.5) * view[2] / side - view[0] * view[2]
        y = view[1] * view[2] - (k // across + 0.5) * view[2] / side
        ahead = plane[0] * x + plane[1] * y + plane[2]
        if ahead == 0.0:
            continue
        z = plane[3] / ahead
        if 0.0 < z < depth[k]:
            face[k], depth[k] = cap, z


@compiled
def _look_up(
    width: int, side: int, pixels: Any, axes: Any, eye: Any, vertices: Any, faces: Any, seen: Any, depth: Any,
    towards: Any, across: Any, face: Any, u: Any, v: Any, distance: Any, normal: Any,
) -> None:  # fmt: skip
    """Writes what samples show as rays would have met it.

    Args:
        width: of the picture [px].
        side: samples along each side of a pixel.
        pixels: ``(k,)``.
        axes: of the camera.
        eye: of the camera.
        vertices: see Facets.
        faces: see Facets.
        seen: ``(n_samples,)`` faces.
        depth: ``(n_samples,)``.
        towards: ``(n, 3)`` directions of the samples.
        across: ``(3,)`` normal of the cut.
        face: the outcome, see Hits; likewise the rest.
        u: see there.
        v: see there.
        distance: see there.
        normal: see there.
    """
    k = 0
    e, d, p = np.empty((2, 3)), np.empty(3), np.empty(3)
    for pixel in pixels:
        row, column = pixel // width, pixel % width
        for s in range(side * side):
            at = (row * side + s // side) * width * side + column * side + s % side
            f = seen[at]
            face[k] = f
            ahead = 0.0
            for i in range(3):
                d[i] = towards[k, i]
                ahead += d[i] * axes[2, i]
            distance[k] = depth[at] / ahead
            if f == len(faces):
                for i in range(3):
                    normal[k, i] = across[i]
            elif f >= 0:
                for i in range(3):
                    start = vertices[faces[f, 0], i]
                    e[0, i], e[1, i] = vertices[faces[f, 1], i] - start, vertices[faces[f, 2], i] - start
                    p[i] = eye[i] - start
                nx = e[0, 1] * e[1, 2] - e[0, 2] * e[1, 1]
                ny = e[0, 2] * e[1, 0] - e[0, 0] * e[1, 2]
                nz = e[0, 0] * e[1, 1] - e[0, 1] * e[1, 0]
                normal[k, 0], normal[k, 1], normal[k, 2] = nx, ny, nz
                # Weights of the corners where the sample's ray goes through (T. Moeller and B. Trumbore, 1997).
                volume = -(d[0] * nx + d[1] * ny + d[2] * nz)
                if volume != 0.0:
                    qx, qy, qz = p[1] * d[2] - p[2] * d[1], p[2] * d[0] - p[0] * d[2], p[0] * d[1] - p[1] * d[0]
                    second = (e[1, 0] * qx + e[1, 1] * qy + e[1, 2] * qz) / volume
                    third = -(e[0, 0] * qx + e[0, 1] * qy + e[0, 2] * qz) / volume
                    second = min(1.0, max(0.0, second))
                    third = min(1.0 - second, max(0.0, third))
                    u[k], v[k] = second, third
            k += 1
