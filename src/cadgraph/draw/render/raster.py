"""Kernels of the quick pictures: from what rays met to shaded, anti-aliased pixels, without shadow rays.

A picture is worked out on a grid of twice its size. Each pixel gets one ray; where neighbours differ, one for each of
its four quarters. Arrays of the grid are ``(2 * height, 2 * width)``: the mesh met (-1: none), its unit normal on the
viewer's side, and the distance along the ray [m]. Positions are relative to the eye, so that nothing is lost far from
the origin.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.geometry.kernels.parallel import compiled

__all__ = [
    "aim",
    "aim_quarters",
    "cover",
    "crowding",
    "find_edges",
    "follow_edges",
    "outline",
    "prefer",
    "resolve",
    "shade_pixels",
]

Singles = npt.NDArray[np.float32]
Indices = npt.NDArray[np.int32]
Bytes = npt.NDArray[np.uint8]

_TURNED = 0.9  # neighbours whose normals differ more (26 degrees) get rays of their own
_SHARP = 0.8191520442889918  # cosine of 35 degrees: surfaces that meet at a greater angle show a line
_OUTLINE, _SEAM, _CREASE = 1.0, 0.62, 0.42  # as in outline.py
_CALM, _CROWDED = 0.4, 0.95  # share of pixels at edges up to which lines are drawn in full, and from which faintly


@compiled
def aim(axes: Any, pixel: float, width: int, height: int, window: Any, towards: Any) -> None:
    """Unit directions through the middles of the pixels of a window ``(top, bottom, left, right)``, row by row."""
    k = 0
    for row in range(window[0], window[1]):
        y = (height * 0.5 - row - 0.5) * pixel
        for column in range(window[2], window[3]):
            x = (column + 0.5 - width * 0.5) * pixel
            long = 1.0 / np.sqrt(1.0 + x * x + y * y)
            for i in range(3):
                towards[k, i] = (axes[2, i] + x * axes[0, i] + y * axes[1, i]) * long
            k += 1


@compiled
def aim_quarters(axes: Any, pixel: float, width: int, height: int, pixels: Any, towards: Any) -> None:
    """Unit directions through the quarters of some pixels (``row * width + column``), four each."""
    for n in range(len(pixels)):
        row, column = pixels[n] // width, pixels[n] % width
        for q in range(4):
            y = (height * 0.5 - row - 0.25 - 0.5 * (q // 2)) * pixel
            x = (column + 0.25 + 0.5 * (q % 2) - width * 0.5) * pixel
            long = 1.0 / np.sqrt(1.0 + x * x + y * y)
            for i in range(3):
                towards[4 * n + q, i] = (axes[2, i] + x * axes[0, i] + y * axes[1, i]) * long


@compiled
def resolve(
    towards: Any, primitive: Any, u: Any, v: Any, flat: Any, distance: Any, mesh_of_primitive: Any,
    face_of_primitive: Any, corners: Any, pixels: Any, window: Any, width: int, mesh: Any, normal: Any, depth: Any,
) -> None:  # fmt: skip
    """Writes what rays met into the grid: a whole pixel for each ray, or a quarter where ``pixels`` are given."""
    across = window[3] - window[2]
    for k in range(len(primitive)):
        if len(pixels):
            pixel = pixels[k // 4]
            top, left = 2 * (pixel // width) + (k % 4) // 2, 2 * (pixel % width) + k % 2
            side = 1
        else:
            top, left, side = 2 * (window[0] + k // across), 2 * (window[2] + k % across), 2
        found, x, y, z = -1, 0.0, 0.0, 0.0
        far = np.inf
        if primitive[k] >= 0:
            found = mesh_of_primitive[primitive[k]]
            face = face_of_primitive[primitive[k]]
            far = distance[k]
            w = 1.0 - u[k] - v[k]
            x = corners[face, 0, 0] * w + corners[face, 1, 0] * u[k] + corners[face, 2, 0] * v[k]
            y = corners[face, 0, 1] * w + corners[face, 1, 1] * u[k] + corners[face, 2, 1] * v[k]
            z = corners[face, 0, 2] * w + corners[face, 1, 2] * u[k] + corners[face, 2, 2] * v[k]
            long = np.sqrt(x * x + y * y + z * z)
            if not long > 1e-6:
                x, y, z = flat[k, 0], flat[k, 1], flat[k, 2]
                long = np.sqrt(x * x + y * y + z * z)
            side_seen = x * towards[k, 0] + y * towards[k, 1] + z * towards[k, 2]
            scale = (1.0 if side_seen <= 0 else -1.0) / max(long, 1e-30)
            x, y, z = x * scale, y * scale, z * scale
        for row in range(top, top + side):
            for column in range(left, left + side):
                mesh[row, column] = found
                normal[row, column, 0] = x
                normal[row, column, 1] = y
                normal[row, column, 2] = z
                depth[row, column] = far


@compiled
def _differ(mesh: Any, normal: Any, depth: Any, a: int, b: int, c: int, d: int, rays: Any, limit: float) -> bool:
    """Whether two places of the grid show different surfaces; ``rays`` are their unit directions."""
    if mesh[a, b] != mesh[c, d]:
        return True
    if mesh[a, b] < 0:
        return False
    turn = 0.0
    for i in range(3):
        turn += normal[a, b, i] * normal[c, d, i]
    if turn < _TURNED:
        return True
    first, second = 0.0, 0.0
    for i in range(3):
        away = rays[1, i] * depth[c, d] - rays[0, i] * depth[a, b]
        first += away * normal[a, b, i]
        second += away * normal[c, d, i]
    return bool(min(abs(first), abs(second)) > limit * max(depth[a, b], depth[c, d]))


@compiled
def _ray(axes: Any, x: float, y: float, out: Any, k: int) -> None:
    long = 1.0 / np.sqrt(1.0 + x * x + y * y)
    for i in range(3):
        out[k, i] = (axes[2, i] + x * axes[0, i] + y * axes[1, i]) * long


@compiled
def find_edges(
    axes: Any, pixel: float, width: int, height: int, window: Any, mesh: Any, normal: Any, depth: Any, edge: Any
) -> None:
    """Marks the pixels of a window that differ from one of their four neighbours."""
    rays = np.empty((2, 3))
    for row in range(window[0], window[1]):
        for column in range(window[2], window[3]):
            edge[row, column] = 0
    for row in range(window[0], window[1]):
        y = (height * 0.5 - row - 0.5) * pixel
        for column in range(window[2], window[3]):
            x = (column + 0.5 - width * 0.5) * pixel
            _ray(axes, x, y, rays, 0)
            if column + 1 < window[3]:
                _ray(axes, x + pixel, y, rays, 1)
                if _differ(mesh, normal, depth, 2 * row, 2 * column, 2 * row, 2 * column + 2, rays, 2 * pixel):
                    edge[row, column] = 1
                    edge[row, column + 1] = 1
            if row + 1 < window[1]:
                _ray(axes, x, y - pixel, rays, 1)
                if _differ(mesh, normal, depth, 2 * row, 2 * column, 2 * row + 2, 2 * column, rays, 2 * pixel):
                    edge[row, column] = 1
                    edge[row + 1, column] = 1


@compiled
def follow_edges(window: Any, mesh: Any, edge: Any) -> int:
    """Marks (with 2) whole pixels that border on a quarter of another mesh; says how many: thin things go on there."""
    count = 0
    for row in range(window[0], window[1]):
        for column in range(window[2], window[3]):
            if edge[row, column]:
                continue
            own = mesh[2 * row, 2 * column]
            other = False
            if row > window[0] and edge[row - 1, column] == 1:
                other |= mesh[2 * row - 1, 2 * column] != own or mesh[2 * row - 1, 2 * column + 1] != own
            if row + 1 < window[1] and edge[row + 1, column] == 1:
                other |= mesh[2 * row + 2, 2 * column] != own or mesh[2 * row + 2, 2 * column + 1] != own
            if column > window[2] and edge[row, column - 1] == 1:
                other |= mesh[2 * row, 2 * column - 1] != own or mesh[2 * row + 1, 2 * column - 1] != own
            if column + 1 < window[3] and edge[row, column + 1] == 1:
                other |= mesh[2 * row, 2 * column + 2] != own or mesh[2 * row + 1, 2 * column + 2] != own
            if other:
                edge[row, column] = 2
                count += 1
    return count


@compiled
def crowding(window: Any, edge: Any, share: Any) -> None:
    """How much of the 9 x 9 pixels round each pixel lies at edges, as the strength left for lines there."""
    for row in range(window[0], window[1]):
        total, least = 0, window[2]
        for column in range(window[2], window[3]):
            if column == window[2]:
                total = 0
                for c in range(window[2], min(window[3], column + 5)):
                    total += edge[row, c] > 0
                least = window[2]
            else:
                if column + 4 < window[3]:
                    total += edge[row, column + 4] > 0
                if column - 5 >= least:
                    total -= edge[row, column - 5] > 0
            share[row, column] = total
    for column in range(window[2], window[3]):
        for row in range(window[0], window[1]):
            if edge[row, column] == 0:
                continue
            mean, n = 0.0, 0
            for r in range(max(window[0], row - 4), min(window[1], row + 5)):
                mean += share[r, column]
                n += 1
            crowd = min(1.0, max(0.0, (mean / (9.0 * n) - _CALM) / (_CROWDED - _CALM)))
            edge[row, column] = 3 + int(100 * (1.0 - 0.8 * crowd))


@compiled
def _line(
    mesh: Any, normal: Any, depth: Any, row: int, column: int, other_row: int, other_column: int, rays: Any, size: float
) -> float:
    """How dark the line is at a place of the grid towards a neighbour; the nearer surface carries it."""
    here, there = mesh[row, column], mesh[other_row, other_column]
    if here < 0:
        return 0.0
    if there < 0:
        return _OUTLINE
    first, second, turn = 0.0, 0.0, 0.0
    for i in range(3):
        away = rays[1, i] * depth[other_row, other_column] - rays[0, i] * depth[row, column]
        first += away * normal[row, column, i]
        second += away * normal[other_row, other_column, i]
        turn += normal[row, column, i] * normal[other_row, other_column, i]
    if min(abs(first), abs(second)) > 2.5 * size * depth[row, column]:
        return _OUTLINE if depth[row, column] < depth[other_row, other_column] else 0.0
    if here != there:
        return _SEAM
    return _CREASE if turn < _SHARP else 0.0


@compiled
def _tone(normal: Any, row: int, column: int, rays: Any, key: Any, fill: Any) -> tuple[float, float]:
    """Diffuse and glossy light at a place of the grid, as light.shade gives under an open sky."""
    facing, to_key, to_fill, half, long = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(3):
        n = normal[row, column, i]
        facing -= n * rays[0, i]
        to_key += n * key[i]
        to_fill += n * fill[i]
        h = key[i] - rays[0, i]
        half += n * h
        long += h * h
    ambient = 0.40 + 0.13 * normal[row, column, 2]
    diffuse = ambient + 0.52 * max(to_key, 0.0) + 0.13 * max(0.7 * to_fill + 0.3, 0.0) + 0.12 * facing
    gloss = max(half / np.sqrt(max(long, 1e-12)), 0.0)
    for _ in range(5):
        gloss = gloss * gloss
    return diffuse, 0.08 * gloss


@compiled
def shade_pixels(
    axes: Any, pixel: float, width: int, height: int, window: Any, mesh: Any, normal: Any, depth: Any, edge: Any,
    albedo: Any, key: Any, fill: Any, lines: float, near: float, far: float, haze: float, background: Any, table: Any,
    image: Any,
) -> None:  # fmt: skip
    """Shades the pixels of a window; beyond ``near`` [m] surfaces fade into the background, at ``far`` by ``haze``."""
    rays = np.empty((2, 3))
    color = np.empty(3)
    top = len(table) - 1
    for row in range(window[0], window[1]):
        for column in range(window[2], window[3]):
            kind = edge[row, column]
            parts = 4 if kind else 1
            for i in range(3):
                color[i] = 0.0
            for q in range(parts):
                r, c = 2 * row + q // 2, 2 * column + q % 2
                found = mesh[r, c]
                if found < 0:
                    for i in range(3):
                        color[i] += background[row, i]
                    continue
                if parts == 1:
                    x, y = (column + 0.5 - width * 0.5) * pixel, (height * 0.5 - row - 0.5) * pixel
                else:
                    x = (0.5 * c + 0.25 - width * 0.5) * pixel
                    y = (height * 0.5 - 0.5 * r - 0.25) * pixel
                _ray(axes, x, y, rays, 0)
                diffuse, gloss = _tone(normal, r, c, rays, key, fill)
                dark = 0.0
                if parts == 4 and lines > 0.0:
                    if c + 1 < 2 * window[3]:
                        _ray(axes, x + 0.5 * pixel, y, rays, 1)
                        dark = max(dark, _line(mesh, normal, depth, r, c, r, c + 1, rays, pixel))
                    if c > 2 * window[2]:
                        _ray(axes, x - 0.5 * pixel, y, rays, 1)
                        dark = max(dark, _line(mesh, normal, depth, r, c, r, c - 1, rays, pixel))
                    if r + 1 < 2 * window[1]:
                        _ray(axes, x, y - 0.5 * pixel, rays, 1)
                        dark = max(dark, _line(mesh, normal, depth, r, c, r + 1, c, rays, pixel))
                    if r > 2 * window[0]:
                        _ray(axes, x, y + 0.5 * pixel, rays, 1)
                        dark = max(dark, _line(mesh, normal, depth, r, c, r - 1, c, rays, pixel))
                    dark *= lines * (kind - 3) * 0.01
                mist = haze * min(1.0, max(0.0, (depth[r, c] - near) / max(far - near, 1e-9)))
                for i in range(3):
                    lit = (albedo[found, i] * diffuse + gloss) * (1.0 - dark)
                    color[i] += lit * (1.0 - mist) + background[row, i] * mist
            for i in range(3):
                level = min(1.0, max(0.0, color[i] / parts))
                image[row, column, i] = table[int(level * top + 0.5)]


@compiled
def prefer(
    window: Any, slack: float, mesh: Any, normal: Any, depth: Any, own_mesh: Any, own_normal: Any, own_depth: Any
) -> None:
    """Lets the target win where it lies within ``slack`` (share of the distance) of what a cutaway came to instead.

    Behind a mesh that is cut away rays start a little further on, and miss a surface that lies right on it.
    """
    for row in range(2 * window[0], 2 * window[1]):
        for column in range(2 * window[2], 2 * window[3]):
            own = own_depth[row, column]
            if own_mesh[row, column] >= 0 and own < depth[row, column] * (1.0 + slack):
                mesh[row, column] = own_mesh[row, column]
                depth[row, column] = own
                for i in range(3):
                    normal[row, column, i] = own_normal[row, column, i]


@compiled
def cover(mesh: Any, target: int, window: Any, share: Any) -> None:
    """Counts the quarters of each pixel of a window that show a mesh (any at all if ``target`` is negative)."""
    for row in range(window[0], window[1]):
        for column in range(window[2], window[3]):
            count = 0
            for q in range(4):
                found = mesh[2 * row + q // 2, 2 * column + q % 2]
                count += found == target if target >= 0 else found >= 0
            share[row, column] = count


@compiled
def outline(seen: Any, whole: Any, window: Any, radius: float, color: Any, image: Any) -> None:
    """Draws a line round what is seen of the target, dotted where it goes on behind others.

    Args:
        seen: ``(height, width)`` quarters of each pixel that show the target.
        whole: ``(height, width)`` quarters that would show it if it were alone.
        window: pixels that may hold the target, within a margin of ``radius`` and one.
        radius: width of the line [px].
        color: ``(3,)`` sRGB bytes.
        image: ``(height, width, 3)`` that is drawn on.
    """
    reach = int(radius) + 1
    for row in range(window[0], window[1]):
        for column in range(window[2], window[3]):
            own = seen[row, column]
            if own == 4:
                continue
            # Thin where something stands before the target, in full along its own outline.
            before = whole[row, column] == 4
            share = (1.0 - 0.25 * own) * (0.5 if before else 1.0)
            if own == 0:
                near = 1e9
                for r in range(max(window[0], row - reach), min(window[1], row + reach + 1)):
                    for c in range(max(window[2], column - reach), min(window[3], column + reach + 1)):
                        if seen[r, c] > 0:
                            near = min(near, float((r - row) * (r - row) + (c - column) * (c - column)))
                share = min(1.0, max(0.0, (0.6 if before else radius + 0.5) - np.sqrt(near)))
            if share == 0.0 and whole[row, column] > 0 and (row + column) % 6 < 3:
                rim = False
                for r in range(max(window[0], row - 1), min(window[1], row + 2)):
                    for c in range(max(window[2], column - 1), min(window[3], column + 2)):
                        rim |= whole[r, c] < 4
                share = 0.85 if rim else 0.0
            for i in range(3):
                image[row, column, i] = int(image[row, column, i] * (1.0 - share) + color[i] * share + 0.5)
