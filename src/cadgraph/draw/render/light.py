"""Light: what each point sees of the sky and of the lamp, and the colour that comes of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from cadgraph.draw.render.caster import Caster
from cadgraph.draw.render.vector import dot, normalized
from cadgraph.model.scene import Floats

__all__ = ["SOFTNESS", "Lamps", "lamps", "shade", "sky_seen", "smooth", "sun_seen"]

Singles = npt.NDArray[np.float32]
Numbers = npt.NDArray[np.int64]

PATTERN = 4
"""Neighbouring pixels send different rays, repeating every so many pixels; smoothing over such a block then averages
all of them. The result is the same on every run, without noise."""

SOFTNESS = 0.05
"""Radius of the key lamp over its distance: penumbrae as on a hazy day."""

_SUN_RAYS = 2
_ORDER = np.array([[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]])  # ordered dither: neighbours differ


@dataclass(frozen=True)
class Lamps:
    """Directions towards the lamps, ``(3,)`` unit vectors: ``key`` casts the shadows, ``fill`` lightens them."""

    key: Singles
    fill: Singles


def lamps(right: Floats, up: Floats, forward: Floats) -> Lamps:
    """Lamps that go with the camera: the key from above on the left, never below the horizon, the fill opposite."""
    key = -0.55 * right + 0.75 * up - 0.62 * forward
    key[2] = max(key[2], 0.55)
    fill = 0.85 * right + 0.1 * up - 0.6 * forward
    return Lamps(_unit(key), _unit(fill))


def sky_seen(
    caster: Caster,
    points: Singles,
    normals: Singles,
    columns: Numbers,
    rows: Numbers,
    reach: float,
    rays: int,
) -> Singles:
    """``(n,)`` share of the hemisphere, weighted by the cosine, that nothing near hides (ambient occlusion).

    Args:
        caster: what may hide.
        points: ``(n, 3)`` just above the surface, about the caster's centre.
        normals: ``(n, 3)`` unit.
        columns: ``(n,)`` of the pixels, which choose the rays.
        rows: ``(n,)`` likewise.
        reach: how far away something may be and still hide [m]; the nearer, the more it counts.
        rays: for each point.
    """
    if not len(points):
        return np.zeros(0, np.float32)
    directions, lengths = _hemisphere(rays)
    cell = _ORDER[rows % PATTERN, columns % PATTERN]
    tangent, bitangent = _tangents(normals)
    seen = np.zeros(len(points), np.float32)
    for ray in range(rays):
        d = directions[cell, ray]
        towards = d[:, 0, None] * tangent + d[:, 1, None] * bitangent + d[:, 2, None] * normals
        seen += ~caster.blocked(points, towards, lengths[cell, ray] * np.float32(reach))
    return seen / np.float32(rays)


def sun_seen(caster: Caster, points: Singles, key: Singles, columns: Numbers, rows: Numbers, reach: float) -> Singles:
    """``(n,)`` share of the key lamp that is seen, by rays to points of it that differ from pixel to pixel."""
    if not len(points):
        return np.zeros(0, np.float32)
    tangent, bitangent = _tangents(key[None])
    cells = PATTERN * PATTERN
    disc = _disc(cells * _SUN_RAYS) * SOFTNESS
    targets = key + disc[:, :1] * tangent + disc[:, 1:] * bitangent
    targets = (targets / np.linalg.norm(targets, axis=1, keepdims=True)).astype(np.float32)
    cell = _ORDER[rows % PATTERN, columns % PATTERN]
    lengths = np.full(len(points), reach, np.float32)
    seen = np.zeros(len(points), np.float32)
    for ray in range(_SUN_RAYS):
        seen += ~caster.blocked(points, targets[cell + ray * cells], lengths)
    return seen / np.float32(_SUN_RAYS)


def smooth(values: Singles, points: Singles, normals: Singles, known: npt.NDArray[np.bool_], size: Singles) -> Singles:
    """Averages over a block of pixels, but not across edges.

    Args:
        values: ``(n, height, width)``.
        points: ``(3, height, width)``.
        normals: ``(3, height, width)`` unit.
        known: ``(height, width)`` where there is a value.
        size: ``(height, width)`` of a pixel there [m].

    Returns:
        ``(n, height, width)``; zero where nothing is known.
    """
    height, width = known.shape
    total = np.zeros_like(values)
    weight = np.zeros((height, width), np.float32)
    limit = 3 * size
    for down in range(-(PATTERN // 2), PATTERN - PATTERN // 2):
        for across in range(-(PATTERN // 2), PATTERN - PATTERN // 2):
            here = slice(max(0, -down), height - max(0, down)), slice(max(0, -across), width - max(0, across))
            there = slice(max(0, down), height + min(0, down)), slice(max(0, across), width + min(0, across))
            nx, ny, nz = (axis[here] for axis in normals)
            mx, my, mz = (axis[there] for axis in normals)
            px, py, pz = (axis[there] - axis[here] for axis in points)
            counts = nx * mx + ny * my + nz * mz > 0.85
            counts &= np.abs(px * nx + py * ny + pz * nz) < limit[here]
            counts &= known[here] & known[there]
            for summed, value in zip(total, values, strict=True):
                summed[here] += value[there] * counts
            weight[here] += counts
    np.maximum(weight, 1, out=weight)
    for summed in total:
        summed /= weight
    return total


def shade(normals: Singles, views: Singles, sky: Singles, sun: Singles, lights: Lamps) -> tuple[Singles, Singles]:
    """How surfaces are lit: the colour seen is ``albedo * diffuse + gloss``.

    Args:
        normals: ``(n, 3)`` unit, on the viewer's side.
        views: ``(n, 3)`` unit, from the surface to the eye.
        sky: ``(n,)`` share of the sky that is seen.
        sun: ``(n,)`` share of the key lamp that is seen.
        lights: the lamps.

    Returns:
        ``diffuse`` and ``gloss``, both ``(n,)`` linear.
    """
    key = np.maximum(normals @ lights.key, 0) * (0.35 + 0.65 * sun)
    fill = np.maximum(normals @ lights.fill * 0.7 + 0.3, 0)
    ambient = (0.47 + 0.13 * normals[:, 2]) * (0.25 + 0.75 * sky)
    diffuse = ambient + 0.5 * key + 0.13 * fill * (0.5 + 0.5 * sky) + 0.06 * dot(normals, views)
    halfway, _ = normalized(lights.key + views)
    # The 32nd power, by squaring.
    gloss = np.maximum(dot(normals, halfway), 0)
    for _ in range(5):
        gloss = gloss * gloss
    return diffuse.astype(np.float32), (0.09 * gloss * sun).astype(np.float32)


def _hemisphere(rays: int) -> tuple[Singles, Singles]:
    """Directions ``(16, rays, 3)`` about +Z by cosine, and lengths ``(16, rays)`` in 0..1, well spread in each cell."""
    cells = PATTERN * PATTERN
    total = cells * rays
    index = np.arange(total)
    ring = (index + 0.5) / total
    turn = np.array([_radical_inverse(i, 2) for i in range(total)])
    radius = np.sqrt(ring)
    directions = np.stack(
        [radius * np.cos(2 * np.pi * turn), radius * np.sin(2 * np.pi * turn), np.sqrt(1 - ring)], axis=1
    )
    lengths = 0.08 + 0.92 * np.array([_radical_inverse(i, 3) for i in range(total)]) ** 2
    # Ray k of cell c is number k * cells + c: each cell has one ray in each band of tilt.
    return (
        directions.reshape(rays, cells, 3).transpose(1, 0, 2).astype(np.float32),
        lengths.reshape(rays, cells).T.astype(np.float32),
    )


def _disc(count: int) -> Floats:
    index = np.arange(count)
    radius, turn = np.sqrt((index + 0.5) / count), index * np.pi * (3 - np.sqrt(5))
    return np.stack([radius * np.cos(turn), radius * np.sin(turn)], axis=1)


def _radical_inverse(index: int, base: int) -> float:
    """Van der Corput: the digits of a number mirrored at the decimal point."""
    value, scale = 0.0, 1.0
    while index:
        scale /= base
        value += scale * (index % base)
        index //= base
    return value


def _tangents(normals: Singles) -> tuple[Singles, Singles]:
    """Two unit vectors square to each normal (T. Duff et al., Building an Orthonormal Basis, Revisited, 2017)."""
    x, y, z = normals[:, 0], normals[:, 1], normals[:, 2]
    sign = np.where(z >= 0, np.float32(1), np.float32(-1))
    a = -1 / (sign + z)
    b = x * y * a
    return (
        np.stack([1 + sign * x * x * a, sign * b, -sign * x], axis=1),
        np.stack([b, sign + y * y * a, -y], axis=1),
    )


def _unit(vector: Floats) -> Singles:
    return (vector / np.linalg.norm(vector)).astype(np.float32)
