"""From surfaces and light to colours: shading, the thin dark lines at edges, and layers put over the background."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from cadgraph.draw.render.color import Colors, from_hex, to_linear, to_srgb
from cadgraph.draw.render.light import Lamps, Light
from cadgraph.draw.render.surface import Surfaces, Viewport, in_chunks
from cadgraph.geometry.kernels.parallel import compiled

__all__ = ["Haze", "Layer", "background", "compose", "shade"]

Singles = npt.NDArray[np.float32]
Bools = npt.NDArray[np.bool_]
Bytes = npt.NDArray[np.uint8]

_SHARP = 0.8191520442889918  # cosine of 35 degrees: surfaces that meet at a greater angle show a line
_STEP = 2.5  # [px] surfaces that lie further apart are one behind the other
_OUTLINE, _SEAM, _CREASE = 1.0, 0.62, 0.42  # line strengths: against what lies behind, between meshes, within one
_CROWD = 4  # [px] each way, over whose square the edges are counted
_CALM, _CROWDED = 0.45, 0.95  # share of pixels at edges up to which lines are drawn in full, and from which faintly
_OUTSIDE = -2.0  # in place of a mesh: beyond the picture
_BOTH_SIDES = 3  # samples a side from which on a line takes one of them on each side: it is about 0.6 px wide
_HATCH_PERIOD = 10.0  # [px]
_GHOST, _GHOST_OVER = 0.5, 0.13  # share that ghosts take over the background, and over what they stand in front of
_LEVELS = 4096  # of linear light in the table of sRGB bytes
_BETTER = 0.02  # by so much the side that another pixel shows must be more similar to take its light instead
_SAME = 0.9995  # cosine of normals (2 degrees) from which on neighbouring samples share one calculation
_UNSEEN = (0.75, 0.8)  # sky and sun of a sample that none of the pixels round it tells about


class Haze(NamedTuple):
    """Fades what is far into the background.

    Args:
        near: depth from which on [m].
        far: depth where it is full [m].
        share: of the background, there.
    """

    near: float = 0.0
    far: float = 1.0
    share: float = 0.0


class Layer(NamedTuple):
    """Some meshes of a picture, shaded, before anything lies behind; arguments of compiled kernels.

    Args:
        color: ``(n_paints, n, 3)`` linear, already multiplied by ``cover``.
        cover: ``(n,)`` share of the pixel that surfaces and lines take.
        depth: ``(n,)`` of the nearest surface [m], infinite where there is none.
        floor: ``(n,)`` light on the floor behind, 1 where there is no shadow.
    """

    color: Singles
    cover: Singles
    depth: Singles
    floor: Singles


def background(height: int, top: str, bottom: str) -> Singles:
    """``(height, 3)`` linear light behind everything, row by row; blended as the eye sees it."""
    share = ((np.arange(height) + 0.5) / height)[:, None]
    return to_linear(to_srgb(from_hex(top)) * (1 - share) + to_srgb(from_hex(bottom)) * share)


def shade(
    port: Viewport, surfaces: Surfaces, seen: Light, lights: Lamps, albedo: Colors, hatched: Bools, left_out: Bools,
    samples: int, lines: float, haze: Haze, behind: Singles, threads: int,
) -> Layer:  # fmt: skip
    """Shades what the rays of a picture met, for several pictures that differ in colours only.

    Args:
        port: what is looked at.
        surfaces: what the rays met.
        seen: the light that each pixel sees.
        lights: the lamps.
        albedo: ``(n_paints, n_meshes, 3)`` linear.
        hatched: ``(n_paints, n_meshes)`` whether a mesh is striped.
        left_out: ``(n_meshes,)`` meshes that hide what is behind them without being drawn.
        samples: rays along each side of a pixel at edges.
        lines: strength of the thin dark lines, 0..1.
        haze: over what is far.
        behind: ``(height, 3)`` linear, what the haze fades into.
        threads: that share the work.
    """
    n = port.width * port.height
    layer = Layer(
        np.empty((len(albedo), n, 3), np.float32), np.empty(n, np.float32), np.empty(n, np.float32),
        np.ones(n, np.float32),
    )  # fmt: skip
    crowd = np.zeros((port.height + 1, port.width + 1), np.int32)
    edges = (surfaces.slot >= 0).reshape(port.height, port.width)
    np.cumsum(np.cumsum(edges, axis=0, dtype=np.int32), axis=1, out=crowd[1:, 1:])
    fewer = min(1.0, samples / 3 + 0.2) if samples != 2 else 1.0
    in_chunks(
        n,
        lambda first, last: _shade(
            port.view, port.width, port.height, first, last, surfaces, seen, lights, albedo, hatched, left_out,
            samples, lines * fewer, crowd, haze, behind, layer,
        ),
        threads,
    )  # fmt: skip
    return layer


def compose(port: Viewport, solid: Layer, ghost: Layer | None, behind: Singles, threads: int) -> Bytes:
    """Lays layers over the background.

    Args:
        port: what is looked at.
        solid: what is drawn in full.
        ghost: what is only hinted at.
        behind: ``(height, 3)`` linear.
        threads: that share the work.

    Returns:
        sRGB ``(n_paints, height, width, 3)``.
    """
    n = port.width * port.height
    images = np.empty((len(solid.color), n, 3), np.uint8)
    over = ghost or solid
    in_chunks(
        n,
        lambda first, last: _compose(port.width, first, last, solid, over, ghost is not None, behind, _TABLE, images),
        threads,
    )
    return images.reshape(-1, port.height, port.width, 3)


_TABLE = np.round(to_srgb(np.linspace(0, 1, _LEVELS)) * 255).astype(np.uint8)


@compiled
def _shade(
    view: Any, width: int, height: int, first: int, last: int, surfaces: Any, seen: Any, lights: Any, albedo: Any,
    hatched: Any, left_out: Any, samples: int, lines: float, crowd: Any, haze: Any, behind: Any, layer: Any,
) -> None:  # fmt: skip
    # Single arrays from here on: the compiler counts the references to each array of a tuple at every call.
    mesh_of, normal, depth, slot = surfaces.mesh, surfaces.normal, surfaces.depth, surfaces.slot
    grid_mesh, grid_normal, grid_depth = surfaces.grid_mesh, surfaces.grid_normal, surfaces.grid_depth
    sky_seen, sun_seen = seen.sky, seen.sun
    key, fill, up = lights.key, lights.fill, lights.up
    dark, near = np.zeros((samples + 2) ** 2), np.zeros(((samples + 2) ** 2, 8))
    for p in range(first, last):
        row, column = p // width, p % width
        for i in range(len(albedo)):
            for j in range(3):
                layer.color[i, p, j] = 0.0
        if seen.fade[p] > 0:
            shadow = 1.0 - (0.4 + 0.6 * sky_seen[p]) * (0.7 + 0.3 * sun_seen[p])
            layer.floor[p] = 1.0 - shadow * seen.fade[p]
        layer.depth[p], layer.cover[p] = np.inf, 0.0
        if slot[p] >= 0:
            strength = lines * _thinning(width, height, row, column, crowd) if lines > 0 else 0.0
            if strength > 0:
                _lines(view, width, height, row, column, samples, mesh_of, normal, depth, slot, grid_mesh,
                       grid_normal, grid_depth, left_out, near, dark)  # fmt: skip
            layer.depth[p], layer.cover[p] = _shade_grid(
                view, width, height, p, mesh_of, normal, slot[p], grid_mesh, grid_normal, grid_depth, sky_seen,
                sun_seen, key, fill, up, albedo, hatched, left_out, samples, strength, dark, haze, behind, layer.color,
            )  # fmt: skip
            continue
        mesh = mesh_of[p]
        if mesh >= 0 and not left_out[mesh]:
            x, y = (column + 0.5 - view[0]) * view[2], (view[1] - row - 0.5) * view[2]
            layer.depth[p], layer.cover[p] = depth[p], 1.0
            diffuse, gloss = _tone(normal, p, x, y, sky_seen[p], sun_seen[p], key, fill, up)
            _add(albedo, hatched, mesh, diffuse, gloss, column + 0.5, row + 0.5, 1.0, depth[p], haze, behind, row,
                 layer.color, p)  # fmt: skip


@compiled
def _shade_grid(
    view: Any, width: int, height: int, p: int, mesh_of: Any, normal: Any, slot: int, grid_mesh: Any,
    grid_normal: Any, grid_depth: Any, sky_seen: Any, sun_seen: Any, key: Any, fill: Any, up: Any, albedo: Any,
    hatched: Any, left_out: Any, samples: int, strength: float, dark: Any, haze: Any, behind: Any, color: Any,
) -> tuple[float, float]:  # fmt: skip
    """Shades a pixel that has a grid of samples.

    Returns:
        The depth of its nearest surface [m], and the share of the pixel that surfaces and lines take.
    """
    row, column, each = p // width, p % width, samples * samples
    nearest, cover, before = np.inf, 0.0, -1
    diffuse, gloss = 0.0, 0.0
    for s in range(each):
        k = slot * each + s
        mesh, depth = grid_mesh[k], grid_depth[k]
        line = strength * dark[(s // samples + 1) * (samples + 2) + s % samples + 1] if strength > 0 else 0.0
        if mesh < 0 or left_out[mesh]:
            cover += line
            continue
        cover += 1.0
        nearest = min(nearest, depth)
        across, down = column + (s % samples + 0.5) / samples, row + (s // samples + 0.5) / samples
        alike = before >= 0 and grid_mesh[before] == mesh
        if alike:
            turn = 0.0
            for i in range(3):
                turn += grid_normal[k, i] * grid_normal[before, i]
            alike = turn > _SAME
        if not alike:
            before = k
            sky, sun = _nearby(width, height, row, column, k, mesh_of, normal, grid_mesh, grid_normal, sky_seen,
                               sun_seen)  # fmt: skip
            x, y = (across - view[0]) * view[2], (view[1] - down) * view[2]
            diffuse, gloss = _tone(grid_normal, k, x, y, sky, sun, key, fill, up)
        _add(albedo, hatched, mesh, diffuse, gloss, across, down, (1.0 - line) / each, depth, haze, behind, row,
             color, p)  # fmt: skip
    return nearest, cover / each


@compiled
def _tone(
    normal: Any, k: int, x: float, y: float, sky: float, sun: float, key: Any, fill: Any, up: Any
) -> tuple[float, float]:
    """Diffuse and glossy light at a sample: its colour is ``albedo * diffuse + gloss``."""
    nx, ny, nz = normal[k, 0], normal[k, 1], normal[k, 2]
    long = 1.0 / np.sqrt(1.0 + x * x + y * y)
    vx, vy, vz = -x * long, -y * long, -long
    to_key = nx * key[0] + ny * key[1] + nz * key[2]
    to_fill = nx * fill[0] + ny * fill[1] + nz * fill[2]
    upwards = nx * up[0] + ny * up[1] + nz * up[2]
    facing = nx * vx + ny * vy + nz * vz
    ambient = (0.47 + 0.13 * upwards) * (0.25 + 0.75 * sky)
    diffuse = ambient + 0.5 * max(to_key, 0.0) * (0.35 + 0.65 * sun) + 0.06 * facing
    diffuse += 0.13 * max(0.7 * to_fill + 0.3, 0.0) * (0.5 + 0.5 * sky)
    hx, hy, hz = key[0] + vx, key[1] + vy, key[2] + vz
    gloss = max((nx * hx + ny * hy + nz * hz) / max(np.sqrt(hx * hx + hy * hy + hz * hz), 1e-6), 0.0)
    # The 32nd power, by squaring.
    for _ in range(5):
        gloss = gloss * gloss
    return diffuse, 0.09 * gloss * sun


@compiled
def _add(
    albedo: Any, hatched: Any, mesh: int, diffuse: float, gloss: float, across: float, down: float, share: float,
    depth: float, haze: Any, behind: Any, row: int, color: Any, p: int,
) -> None:  # fmt: skip
    """Adds a sample to its pixel, in all paints."""
    mist, stripe = 0.0, -1.0
    if haze.share > 0:
        mist = haze.share * min(1.0, max(0.0, (depth - haze.near) / max(haze.far - haze.near, 1e-9)))
    for i in range(len(albedo)):
        tone = diffuse
        if hatched[i, mesh]:
            if stripe < 0:
                phase = ((across + down) / _HATCH_PERIOD) % 1.0
                stripe = 0.3 * min(1.0, max(0.0, (abs(phase - 0.5) - 0.32) * _HATCH_PERIOD))
            tone = diffuse * (1.0 - stripe)
        for j in range(3):
            lit = albedo[i, mesh, j] * tone + gloss
            color[i, p, j] += share * (lit * (1.0 - mist) + behind[row, j] * mist)


@compiled
def _nearby(
    width: int, height: int, row: int, column: int, k: int, mesh_of: Any, normal: Any, grid_mesh: Any,
    grid_normal: Any, sky_seen: Any, sun_seen: Any,
) -> tuple[float, float]:  # fmt: skip
    """Sky and sun for a sample: from the pixel near by that shows the same mesh from the most similar side."""
    mesh = grid_mesh[k]
    nx, ny, nz = grid_normal[k, 0], grid_normal[k, 1], grid_normal[k, 2]
    best, sky, sun = -2.0, _UNSEEN[0], _UNSEEN[1]
    for around in range(9):
        # The pixel itself first: of equals the first wins.
        r = row + (0 if around < 3 else -1 if around < 6 else 1)
        c = column + (0 if around % 3 == 0 else -1 if around % 3 == 1 else 1)
        q = r * width + c
        if r < 0 or r >= height or c < 0 or c >= width or mesh_of[q] != mesh:
            continue
        match = nx * normal[q, 0] + ny * normal[q, 1] + nz * normal[q, 2]
        if match > best + _BETTER:
            best, sky, sun = match, sky_seen[q], sun_seen[q]
            if best > 1.0 - _BETTER:
                break
    return sky, sun


@compiled
def _thinning(width: int, height: int, row: int, column: int, crowd: Any) -> float:
    """Factor on the lines: fainter where they crowd, so that dense places don't turn black.

    Args:
        width: of the picture [px].
        height: of the picture [px].
        row: of the pixel.
        column: of the pixel.
        crowd: ``(height + 1, width + 1)`` how many pixels above and to the left of each corner are at edges.
    """
    top, bottom = max(0, row - _CROWD), min(height, row + _CROWD + 1)
    left, right = max(0, column - _CROWD), min(width, column + _CROWD + 1)
    edges = crowd[bottom, right] - crowd[top, right] - crowd[bottom, left] + crowd[top, left]
    count = (bottom - top) * (right - left)
    return float(1.0 - 0.8 * min(1.0, max(0.0, (edges / count - _CALM) / (_CROWDED - _CALM))))


@compiled
def _lines(
    view: Any, width: int, height: int, row: int, column: int, samples: int, mesh: Any, normal: Any, depth: Any,
    slot: Any, grid_mesh: Any, grid_normal: Any, grid_depth: Any, left_out: Any, near: Any, dark: Any,
) -> None:  # fmt: skip
    """How dark the line is at each sample of a pixel, 0..1, by its neighbours within the pixel and beyond.

    Args:
        view: of the picture.
        width: of the picture [px].
        height: of the picture [px].
        row: of the pixel.
        column: of the pixel.
        samples: along each side of a pixel.
        mesh: what the rays met, see Surfaces; likewise the six that follow.
        normal: see there.
        depth: see there.
        slot: see there.
        grid_mesh: see there.
        grid_normal: see there.
        grid_depth: see there.
        left_out: ``(n_meshes,)``.
        near: ``((samples + 2) ** 2, 8)`` room for the samples of the pixel and those that border on it.
        dark: ``((samples + 2) ** 2,)`` the outcome, for the same samples.
    """
    across, at = samples + 2, -1
    for down in range(-1, samples + 1):
        r, beyond = _wrapped(down, samples)
        for right in range(-1, samples + 1):
            c, beside = _wrapped(right, samples)
            at += 1
            dark[at] = 0.0
            to_row, to_column = row + beyond, column + beside
            if beyond and beside:
                continue
            if not (0 <= to_row < height and 0 <= to_column < width):
                near[at, 0] = _OUTSIDE
                continue
            pixel = to_row * width + to_column
            if slot[pixel] >= 0:
                x = (column + (right + 0.5) / samples - view[0]) * view[2]
                y = (view[1] - row - (down + 0.5) / samples) * view[2]
                k = (slot[pixel] * samples + r) * samples + c
                _note(near, at, grid_mesh, grid_normal, grid_depth, k, x, y, left_out)
            else:
                # A pixel without a grid has one ray.
                x, y = (to_column + 0.5 - view[0]) * view[2], (view[1] - to_row - 0.5) * view[2]
                _note(near, at, mesh, normal, depth, pixel, x, y, left_out)
    both = samples >= _BOTH_SIDES
    for r in range(samples + 1):
        for c in range(samples + 1):
            at = r * across + c
            if r > 0:
                _draw_line(near, at, at + 1, _STEP * view[2], both, dark)
            if c > 0:
                _draw_line(near, at, at + across, _STEP * view[2], both, dark)


@compiled
def _note(near: Any, at: int, mesh: Any, normal: Any, depth: Any, k: int, x: float, y: float, left_out: Any) -> None:
    """Writes down a sample: mesh, normal, position, whether it is drawn."""
    near[at, 0] = mesh[k]
    if mesh[k] < 0:
        near[at, 6], near[at, 7] = np.inf, 1.0
        return
    for i in range(3):
        near[at, 1 + i] = normal[k, i]
    z = depth[k]
    near[at, 4], near[at, 5], near[at, 6] = x * z, y * z, z
    near[at, 7] = 0.0 if left_out[mesh[k]] else 1.0


@compiled
def _wrapped(place: int, samples: int) -> tuple[int, int]:
    """The row or column of a sample within its own pixel, and how many pixels away that is."""
    if place < 0:
        return samples - 1, -1
    if place == samples:
        return 0, 1
    return place, 0


@compiled
def _draw_line(near: Any, a: int, b: int, limit: float, both: bool, dark: Any) -> None:
    """The line between two neighbouring samples; against what lies behind, on the nearer side alone or on both."""
    if near[a, 0] == _OUTSIDE or near[b, 0] == _OUTSIDE or (near[a, 0] < 0 and near[b, 0] < 0):
        return
    step, turn = _apart(near, a, b)
    before, behind = (a, b) if near[a, 6] < near[b, 6] else (b, a)
    if step > limit * near[before, 6]:
        # What is not drawn has no outline.
        strength = _OUTLINE * near[before, 7]
        dark[before] = max(dark[before], strength)
        if both:
            dark[behind] = max(dark[behind], strength)
        return
    strength = _SEAM if near[a, 0] != near[b, 0] else _CREASE if turn < _SHARP else 0.0
    strength *= near[a, 7] * near[b, 7]
    dark[a], dark[b] = max(dark[a], strength), max(dark[b], strength)


@compiled
def _apart(near: Any, a: int, b: int) -> tuple[float, float]:
    """How far two samples lie apart across their surfaces [m], and the cosine between their normals."""
    if near[a, 0] < 0 or near[b, 0] < 0:
        return np.inf, 1.0
    first, second, turn = 0.0, 0.0, 0.0
    for i in range(1, 4):
        away = near[b, 3 + i] - near[a, 3 + i]
        first += away * near[a, i]
        second += away * near[b, i]
        turn += near[a, i] * near[b, i]
    return min(abs(first), abs(second)), turn


@compiled
def _compose(
    width: int, first: int, last: int, solid: Any, ghost: Any, ghosted: bool, behind: Any, table: Any, images: Any
) -> None:
    top = len(table) - 1
    for p in range(first, last):
        row = p // width
        cover = solid.cover[p]
        left = solid.floor[p] * (1.0 - cover)
        taken = 0.0
        if ghosted:
            taken = _GHOST * (1.0 - cover) + (_GHOST_OVER * cover if ghost.depth[p] < solid.depth[p] else 0.0)
        for i in range(len(images)):
            for j in range(3):
                level = behind[row, j] * left + solid.color[i, p, j]
                if ghosted:
                    level = level * (1.0 - taken * ghost.cover[p]) + ghost.color[i, p, j] * taken
                images[i, p, j] = table[int(min(1.0, max(0.0, level)) * top + 0.5)]
