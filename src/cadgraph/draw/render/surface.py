"""What the rays of a picture meet: one ray for each pixel, and a grid of rays where neighbouring pixels differ.

Coordinates are those of the camera, so that nothing is lost far from the origin: x to the right, y upwards, z into the
picture, from the eye. A point of the picture is given by its place ``(x, y)`` on the plane at a depth of 1. All arrays
are flat, pixel by pixel and row by row.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from cadgraph.draw.render.camera import Camera
from cadgraph.draw.render.crease import Normals
from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.geometry.visibility.rays import Hits

__all__ = ["Surfaces", "Viewport", "covered", "in_chunks", "meet"]

Singles = npt.NDArray[np.float32]
Indices = npt.NDArray[np.int32]

_CHUNK = 32_768  # rays or pixels that a thread works on at a time
_ROUNDS = 3  # of following edges into pixels whose own ray missed them
_TURNED = 0.9  # neighbours whose normals differ more (26 degrees) get a grid of rays
_STEP = 2.0  # [px] neighbours that lie further apart across their surface get one, too


class Surfaces(NamedTuple):
    """What the rays met; arguments of compiled kernels.

    Args:
        mesh: ``(n,)`` int32 of the ray through the middle of each pixel, -1 where it met nothing.
        normal: ``(n, 3)`` float32 unit, on the viewer's side.
        flat: ``(n, 3)`` as ``normal``, of the triangle itself; empty unless it is wanted.
        depth: ``(n,)`` float32 along the viewing direction [m], infinite where nothing was met.
        slot: ``(n,)`` int32 place of the pixel's grid among all grids, -1 where it has none.
        grid_mesh: ``(n_grids * samples ** 2,)`` as ``mesh``, row by row within each pixel.
        grid_normal: likewise.
        grid_depth: likewise.
    """

    mesh: Indices
    normal: Singles
    flat: Singles
    depth: Singles
    slot: Indices
    grid_mesh: Indices
    grid_normal: Singles
    grid_depth: Singles


@dataclass(frozen=True)
class Viewport:
    """The rows and columns of a camera's picture that are worked on.

    Args:
        camera: the camera.
        top: first row.
        left: first column.
        height: number of rows.
        width: number of columns.
    """

    camera: Camera
    top: int
    left: int
    height: int
    width: int

    @classmethod
    def whole(cls, camera: Camera) -> Viewport:
        """All of the picture."""
        return cls(camera, 0, 0, camera.height, camera.width)

    @property
    def axes(self) -> npt.NDArray[np.float64]:
        """``(3, 3)`` unit vectors to the right, upwards and into the picture, as rows."""
        return np.stack([self.camera.right, self.camera.up, self.camera.forward])

    @property
    def view(self) -> npt.NDArray[np.float64]:
        """``(3,)`` column and row of the middle of the picture [px], and the size of a pixel at a depth of 1."""
        middle = self.camera.width / 2 - self.left, self.camera.height / 2 - self.top
        return np.array([*middle, self.camera.pixel_size])


def in_chunks(count: int, act: Callable[[int, int], object], threads: int, chunk: int = _CHUNK) -> None:
    """Calls ``act(first, last)`` on ranges that cover ``range(count)``, the same whatever the number of threads."""
    bounds = [(first, min(first + chunk, count)) for first in range(0, count, chunk)]
    if threads == 1 or len(bounds) < 2:
        for first, last in bounds:
            act(first, last)
        return
    with ThreadPoolExecutor(threads) as pool:
        list(pool.map(lambda bound: act(*bound), bounds))


def meet(
    port: Viewport, cast: Callable[[Singles, npt.NDArray[np.int64], int], Hits], mesh_of_face: Indices,
    normals: Callable[[Indices], Normals], samples: int, lit: bool, threads: int,
) -> Surfaces:  # fmt: skip
    """Finds what the rays of a picture meet.

    Args:
        port: what is looked at.
        cast: what rays from the eye in given unit directions ``(n, 3)`` meet; handed besides the pixels ``(k,)`` that
            they go through, and how many along each side of one.
        mesh_of_face: ``(n_faces,)`` mesh of each of the scene's faces.
        normals: gives the corner normals, worked out at least for the meshes that it is handed.
        samples: rays along each side of a pixel where neighbours differ.
        lit: whether the normals of the triangles themselves are wanted, to cast rays to the light from.
        threads: that share the work.
    """
    axes, view, width, height = port.axes, port.view, port.width, port.height
    n = width * height

    def shoot(pixels: npt.NDArray[np.int64], side: int, flat: Singles) -> tuple[Indices, Singles, Singles]:
        each = side * side
        mesh, depth = np.empty(len(pixels) * each, np.int32), np.empty(len(pixels) * each, np.float32)
        normal = np.empty((len(pixels) * each, 3), np.float32)

        def some(first: int, last: int) -> None:
            towards = np.empty(((last - first) * each, 3), np.float32)
            _aim(axes, view, pixels[first:last], width, side, towards)
            hits = cast(towards, pixels[first:last], side)
            known = normals(mesh_of_face[hits.face[hits.face >= 0]])
            cut = slice(first * each, last * each)
            _resolve(axes, towards, *hits, mesh_of_face, *known, mesh[cut], normal[cut], depth[cut], flat[cut])

        in_chunks(len(pixels), some, threads, _CHUNK // each)
        return mesh, normal, depth

    flat = np.empty((n if lit else 0, 3), np.float32)
    mesh, normal, depth = shoot(np.arange(n), 1, flat)
    edge, slot = np.zeros(n, np.uint8), np.full(n, -1, np.int32)
    in_chunks(n, lambda first, last: _find_edges(view, width, first, last, mesh, normal, depth, edge), threads)
    pixels = np.flatnonzero(edge)
    none = np.zeros(0, np.int32), np.zeros((0, 3), np.float32), np.zeros(0, np.float32)
    grids: list[tuple[Indices, Singles, Singles]] = []
    known = 0
    for _ in range(_ROUNDS):
        if not len(pixels):
            break
        slot[pixels] = known + np.arange(len(pixels), dtype=np.int32)
        known += len(pixels)
        grids.append(shoot(pixels, samples, none[1]))
        edge[:] = 0
        _follow_edges(width, height, samples, pixels, grids[-1][0], mesh, slot, edge)
        pixels = np.flatnonzero(edge)
    joined = (np.concatenate(arrays) for arrays in zip(*grids or [none], strict=True))
    return Surfaces(mesh, normal, flat, depth, slot, *joined)


def covered(port: Viewport, surfaces: Surfaces, samples: int, target: int) -> npt.NDArray[np.uint8]:
    """``(height, width)`` how many of the ``samples ** 2`` parts of each pixel show a mesh (any at all if negative)."""
    count = np.empty(port.height * port.width, np.uint8)
    _cover(surfaces, samples * samples, target, count)
    return count.reshape(port.height, port.width)


@compiled
def _aim(axes: Any, view: Any, pixels: Any, width: int, side: int, towards: Any) -> None:
    """Unit directions through a grid of ``side`` by ``side`` points of each pixel (``row * width + column``)."""
    k = 0
    for pixel in pixels:
        row, column = pixel // width, pixel % width
        for s in range(side * side):
            x = (column + (s % side + 0.5) / side - view[0]) * view[2]
            y = (view[1] - row - (s // side + 0.5) / side) * view[2]
            long = 1.0 / np.sqrt(1.0 + x * x + y * y)
            for i in range(3):
                towards[k, i] = (axes[2, i] + x * axes[0, i] + y * axes[1, i]) * long
            k += 1


@compiled
def _resolve(
    axes: Any, towards: Any, face: Any, u: Any, v: Any, distance: Any, across: Any, mesh_of_face: Any, corners: Any,
    shift: Any, turn: Any, mesh: Any, normal: Any, depth: Any, flat: Any,
) -> None:  # fmt: skip
    """Writes what rays met: mesh, smooth normal in the camera's axes, depth, and the triangle's normal if asked for."""
    for k in range(len(face)):
        f = face[k]
        if f < 0:
            mesh[k], depth[k] = -1, np.inf
            for i in range(3):
                normal[k, i] = 0.0
            continue
        a, b = u[k], v[k]
        w = 1.0 - a - b
        m = mesh_of_face[f]
        at = f + shift[m]
        x = corners[at, 0, 0] * w + corners[at, 1, 0] * a + corners[at, 2, 0] * b
        y = corners[at, 0, 1] * w + corners[at, 1, 1] * a + corners[at, 2, 1] * b
        z = corners[at, 0, 2] * w + corners[at, 1, 2] * a + corners[at, 2, 2] * b
        if len(turn):
            x, y, z = (
                x * turn[m, 0, 0] + y * turn[m, 1, 0] + z * turn[m, 2, 0],
                x * turn[m, 0, 1] + y * turn[m, 1, 1] + z * turn[m, 2, 1],
                x * turn[m, 0, 2] + y * turn[m, 1, 2] + z * turn[m, 2, 2],
            )
        long = np.sqrt(x * x + y * y + z * z)
        p, q, r = across[k, 0], across[k, 1], across[k, 2]
        scale = 1.0 / max(np.sqrt(p * p + q * q + r * r), 1e-30)
        if p * towards[k, 0] + q * towards[k, 1] + r * towards[k, 2] > 0:
            scale = -scale
        p, q, r = p * scale, q * scale, r * scale
        if not long > 1e-6:
            x, y, z, long = p, q, r, 1.0
        # On the side of the triangle that is seen: the smooth normal itself may point away near an outline.
        scale = (1.0 if p * x + q * y + r * z >= 0 else -1.0) / long
        mesh[k] = m
        ahead = 0.0
        for i in range(3):
            normal[k, i] = (x * axes[i, 0] + y * axes[i, 1] + z * axes[i, 2]) * scale
            ahead += towards[k, i] * axes[2, i]
        depth[k] = distance[k] * ahead
        if len(flat):
            for i in range(3):
                flat[k, i] = p * axes[i, 0] + q * axes[i, 1] + r * axes[i, 2]


@compiled
def _differ(
    pixel: float, mesh: Any, normal: Any, depth: Any, a: int, ax: float, ay: float, b: int, bx: float, by: float
) -> bool:
    """Whether two pixels show different surfaces, or one at a sharp turn."""
    if mesh[a] != mesh[b]:
        return True
    if mesh[a] < 0:
        return False
    if normal[a, 0] * normal[b, 0] + normal[a, 1] * normal[b, 1] + normal[a, 2] * normal[b, 2] < _TURNED:
        return True
    x, y, z = bx * depth[b] - ax * depth[a], by * depth[b] - ay * depth[a], depth[b] - depth[a]
    first = abs(x * normal[a, 0] + y * normal[a, 1] + z * normal[a, 2])
    second = abs(x * normal[b, 0] + y * normal[b, 1] + z * normal[b, 2])
    return bool(min(first, second) > _STEP * pixel * max(depth[a], depth[b]))


@compiled
def _find_edges(view: Any, width: int, first: int, last: int, mesh: Any, normal: Any, depth: Any, edge: Any) -> None:
    """Marks the pixels that differ from one of their four neighbours.

    Ranges may be worked on at the same time: where one marks a pixel of the next, both only ever write 1.
    """
    row, column = first // width, first % width
    pixel = view[2]
    for a in range(first, last):
        x, y = (column + 0.5 - view[0]) * pixel, (view[1] - row - 0.5) * pixel
        if column + 1 < width and _differ(pixel, mesh, normal, depth, a, x, y, a + 1, x + pixel, y):
            edge[a], edge[a + 1] = 1, 1
        if a + width < len(mesh) and _differ(pixel, mesh, normal, depth, a, x, y, a + width, x, y - pixel):
            edge[a], edge[a + width] = 1, 1
        column += 1
        if column == width:
            row, column = row + 1, 0


@compiled
def _follow_edges(
    width: int, height: int, side: int, pixels: Any, grid_mesh: Any, mesh: Any, slot: Any, edge: Any
) -> None:
    """Marks pixels without a grid that show another mesh than the grid beside them: thin things go on there.

    Args:
        width: of the picture [px].
        height: of the picture [px].
        side: rays along each side of a grid.
        pixels: ``(k,)`` with the newest grids.
        grid_mesh: ``(k * side * side,)`` what these grids show.
        mesh: ``(n,)`` what each pixel's own ray met.
        slot: ``(n,)`` of every pixel, -1 without a grid.
        edge: ``(n,)`` set to 1.
    """
    for k in range(len(pixels)):
        row, column = pixels[k] // width, pixels[k] % width
        first, last = k * side * side, (k + 1) * side * side - side
        for i in range(side):
            if column > 0:
                _mark(grid_mesh[first + i * side], pixels[k] - 1, mesh, slot, edge)
            if column + 1 < width:
                _mark(grid_mesh[first + i * side + side - 1], pixels[k] + 1, mesh, slot, edge)
            if row > 0:
                _mark(grid_mesh[first + i], pixels[k] - width, mesh, slot, edge)
            if row + 1 < height:
                _mark(grid_mesh[last + i], pixels[k] + width, mesh, slot, edge)


@compiled
def _mark(found: int, pixel: int, mesh: Any, slot: Any, edge: Any) -> None:
    if slot[pixel] < 0 and mesh[pixel] != found:
        edge[pixel] = 1


@compiled
def _cover(surfaces: Any, each: int, target: int, count: Any) -> None:
    for pixel in range(len(count)):
        slot = surfaces.slot[pixel]
        if slot < 0:
            found = surfaces.mesh[pixel]
            count[pixel] = each if (found == target if target >= 0 else found >= 0) else 0
            continue
        number = 0
        for k in range(slot * each, (slot + 1) * each):
            found = surfaces.grid_mesh[k]
            number += found == target if target >= 0 else found >= 0
        count[pixel] = number
