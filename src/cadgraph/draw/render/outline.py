"""Edges in a picture: where more rays are needed, and where a thin dark line helps the eye."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from cadgraph.draw.render.vector import dot
from cadgraph.model.scene import Ints

__all__ = ["is_edge", "line_strength"]

Singles = npt.NDArray[np.float32]
Indices = npt.NDArray[np.int32]
Bools = npt.NDArray[np.bool_]
_Surface = tuple[Indices, Singles, Singles]

_SHARP = math.cos(math.radians(35.0))  # surfaces that turn more than this between two samples meet at an edge
_OUTLINE, _SEAM, _CREASE = 1.0, 0.62, 0.42  # line strengths: against what lies behind, between meshes, within one
_CROWD = 9  # [px] over whose square the lines are counted
_CALM, _CROWDED = 0.45, 0.95  # share of pixels at edges up to which lines are drawn in full, and from which faintly


def is_edge(mesh: Indices, normal: Singles, point: Singles, pixel: Singles) -> Bools:
    """``(height, width)`` whether a pixel differs from one of its four neighbours.

    Args:
        mesh: ``(height, width)``, -1 for none.
        normal: ``(height, width, 3)`` unit.
        point: ``(height, width, 3)``.
        pixel: ``(height, width)`` size of a pixel there [m].
    """
    edge = np.zeros(mesh.shape, bool)
    for a, b in (
        ((slice(None), slice(None, -1)), (slice(None), slice(1, None))),
        ((slice(None, -1), slice(None)), (slice(1, None), slice(None))),
    ):
        turned = dot(normal[a], normal[b]) < 0.9
        away = point[b] - point[a]
        step = np.minimum(np.abs(dot(away, normal[a])), np.abs(dot(away, normal[b]))) > 2 * np.maximum(
            pixel[a], pixel[b]
        )
        both = (mesh[a] >= 0) & (mesh[b] >= 0)
        differs = (mesh[a] != mesh[b]) | (both & (turned | step))
        edge[a] |= differs
        edge[b] |= differs
    return edge


def line_strength(
    mesh: Indices,
    normal: Singles,
    point: Singles,
    base: _Surface,
    order: Ints,
    slot: Ints,
    shape: tuple[int, int],
    size: Singles,
    n: int,
) -> Singles:
    """How dark the line is at each sample of the pixels at edges.

    Args:
        mesh: ``(n_pixels * n * n,)`` of each sample, pixel by pixel.
        normal: ``(n_pixels * n * n, 3)``.
        point: ``(n_pixels * n * n, 3)``.
        base: the same three for the one ray of every pixel of the band.
        order: ``(n_pixels,)`` index in the band of each pixel that has samples.
        slot: ``(height * width,)`` place of a pixel in ``order``, -1 without samples.
        shape: height and width of the band.
        size: ``(n_pixels,)`` of a pixel at its nearest sample [m].
        n: samples along each side of a pixel.

    Returns:
        ``(n_pixels, n, n)`` in 0..1.
    """
    count = len(order)
    grid: _Surface = (
        mesh.reshape(count, n, n),
        normal.reshape(count, n, n, 3),
        point.reshape(count, n, n, 3),
    )
    size = size[:, None, None]
    strength = np.zeros((count, n, n), np.float32)
    if n > 1:
        for a, b in (
            ((slice(None), slice(None), slice(None, -1)), (slice(None), slice(None), slice(1, None))),
            ((slice(None), slice(None, -1)), (slice(None), slice(1, None))),
        ):
            line = _line(_cut(grid, a), _cut(grid, b), size)
            strength[a] = np.maximum(strength[a], line)
            strength[b] = np.maximum(strength[b], line)
    height, width = shape
    row, column = np.divmod(order, width)
    for down, across in ((0, 1), (0, -1), (1, 0), (-1, 0)):
        inside = (row + down >= 0) & (row + down < height) & (column + across >= 0) & (column + across < width)
        at = np.flatnonzero(inside)
        mine, theirs = _facing_sides(down, across)
        neighbor = order[at] + down * width + across
        other = _neighbor_side(grid, base, neighbor, slot, theirs, n)
        line = _line(_cut(_cut(grid, (at,)), mine), other, size[at][:, 0])
        place = (at, *mine[1:])
        strength[place] = np.maximum(strength[place], line)
    fewer = min(1.0, n / 3 + 0.2)
    return strength * (fewer * _thinning(slot, shape)[order])[:, None, None]


def _line(a: _Surface, b: _Surface, size: Singles) -> Singles:
    """Line strength between neighbouring samples."""
    hit_a, hit_b = a[0] >= 0, b[0] >= 0
    both = hit_a & hit_b
    away = b[2] - a[2]
    across_a = np.abs(dot(away, a[1]))
    across_b = np.abs(dot(away, b[1]))
    step = np.minimum(across_a, across_b) > 2.5 * size
    turned = dot(a[1], b[1]) < _SHARP
    seam = np.where(a[0] != b[0], np.float32(_SEAM), np.where(turned, np.float32(_CREASE), np.float32(0)))
    strength = np.where(step, np.float32(_OUTLINE), seam)
    line: Singles = np.where(both, strength, np.where(hit_a != hit_b, np.float32(_OUTLINE), np.float32(0)))
    return line


def _cut(surface: _Surface, where: tuple[slice | Ints | int, ...]) -> _Surface:
    return surface[0][where], surface[1][where], surface[2][where]


def _facing_sides(down: int, across: int) -> tuple[tuple[slice | int, ...], tuple[slice | int, ...]]:
    """Index of the samples of a pixel next to a neighbour, and of that neighbour's samples next to the pixel."""
    whole = slice(None)
    if across:
        return (whole, whole, -1 if across > 0 else 0), (whole, whole, 0 if across > 0 else -1)
    return (whole, -1 if down > 0 else 0, whole), (whole, 0 if down > 0 else -1, whole)


def _neighbor_side(
    grid: _Surface, base: _Surface, neighbor: Ints, slot: Ints, side: tuple[slice | int, ...], n: int
) -> _Surface:
    """The samples of neighbours that face a pixel; of neighbours without samples their one ray, repeated."""
    has = slot[neighbor] >= 0
    place = slot[neighbor[has]]
    mesh, normal, point = (np.repeat(one_ray[neighbor][:, None], n, axis=1) for one_ray in base)
    mesh[has], normal[has], point[has] = grid[0][place][side], grid[1][place][side], grid[2][place][side]
    return (
        mesh.astype(np.int32, copy=False),
        normal.astype(np.float32, copy=False),
        point.astype(np.float32, copy=False),
    )


def _thinning(slot: Ints, shape: tuple[int, int]) -> Singles:
    """``(height * width,)`` factor on the lines: fainter where they crowd, so that dense places don't turn black."""
    at_edge = (slot >= 0).reshape(shape).astype(np.float32)
    share = _box_mean(_box_mean(at_edge, 0), 1)
    factor = 1 - 0.8 * np.clip((share - _CALM) / (_CROWDED - _CALM), 0, 1)
    factors: Singles = factor.reshape(-1).astype(np.float32)
    return factors


def _box_mean(values: Singles, axis: int) -> Singles:
    half = _CROWD // 2
    pad = [(0, 0), (0, 0)]
    pad[axis] = (half + 1, half)
    total = np.cumsum(np.pad(values, pad, mode="edge"), axis=axis, dtype=np.float64)
    size = values.shape[axis]
    upper = np.take(total, np.arange(size) + _CROWD, axis=axis)
    lower = np.take(total, np.arange(size), axis=axis)
    return ((upper - lower) / _CROWD).astype(np.float32)
