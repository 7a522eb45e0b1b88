"""Light: what the surface of each pixel, and the floor behind, sees of the sky and of the key lamp."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from cadgraph.draw.render.camera import Camera
from cadgraph.draw.render.caster import Caster
from cadgraph.draw.render.surface import Surfaces, Viewport, in_chunks
from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.model.scene import Floats

__all__ = ["Lamps", "Light", "lamps", "light", "open_air"]

Singles = npt.NDArray[np.float32]

_PATTERN = 4
"""Neighbouring pixels send different rays, repeating every so many pixels; smoothing over such a block then averages
all of them. The result is the same on every run, without noise."""

_SOFTNESS = 0.05
"""Radius of the key lamp over its distance: penumbrae as on a hazy day."""

_REACH = 0.16  # how far ambient occlusion reaches, as share of the diagonal of what is drawn
_SUN_RAYS = 2
_FLOOR_SPREAD = 0.5  # how far the floor reaches beyond what stands on it, as share of the diagonal
_SKY, _SUN = np.uint8(0), np.uint8(1)
_ORDER = np.array([[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]])  # ordered dither: neighbours differ
_ALIKE = 0.85  # cosine: surfaces of one mesh that turn less than this are smoothed over together
_FLAT = 3.0  # [px] and that lie no further apart


class Lamps(NamedTuple):
    """Directions towards the lamps in the camera's axes, ``(3,)`` unit vectors; ``up`` is the world's z axis there.

    Args:
        key: of the lamp that casts the shadows.
        fill: of the one that lightens them.
        up: straight upwards.
    """

    key: Floats
    fill: Floats
    up: Floats


class Light(NamedTuple):
    """What each pixel sees of the light; arguments of compiled kernels.

    Args:
        sky: ``(n,)`` share of the hemisphere, weighted by the cosine, that nothing near hides (ambient occlusion).
        sun: ``(n,)`` share of the key lamp that is seen.
        fade: ``(n,)`` how strongly shadows show on the floor behind, 0 where there is none.
    """

    sky: Singles
    sun: Singles
    fade: Singles


def lamps(camera: Camera) -> Lamps:
    """Lamps that go with the camera: the key from above on the left, never below the horizon, the fill opposite."""
    axes = np.stack([camera.right, camera.up, camera.forward])
    key = np.array([-0.55, 0.75, -0.62]) @ axes
    key[2] = max(key[2], 0.55)
    fill = np.array([0.85, 0.1, -0.6])
    return Lamps(axes @ (key / np.linalg.norm(key)), fill / np.linalg.norm(fill), axes[:, 2].copy())


def open_air(n: int) -> Light:
    """The light of ``n`` pixels without any shadow."""
    return Light(np.ones(n, np.float32), np.ones(n, np.float32), np.zeros(n, np.float32))


def light(
    port: Viewport, surfaces: Surfaces, caster: Caster, lights: Lamps, sky_rays: int, floor: bool, threads: int
) -> Light:
    """Casts rays from the surface of each pixel to the sky and to the key lamp.

    Args:
        port: what is looked at.
        surfaces: what the pixels show.
        caster: what may hide the light.
        lights: the lamps.
        sky_rays: rays of each pixel to the sky.
        floor: whether a floor below everything takes shadows.
        threads: that share the work.
    """
    n = port.width * port.height
    found = open_air(n)
    axes, view = port.axes, port.view
    diagonal = caster.diagonal
    eye = caster.local(port.camera.eye[None])[0]
    half = (caster.high - caster.low) / 2
    # Floor: its height from the eye, what stands on it (about the caster's centre), how far it goes on, and from which
    # fade on nothing hides the sky any more.
    ground = np.array([-half[2] - eye[2], half[0], half[1], _FLOOR_SPREAD * diagonal, 1 - _REACH / _FLOOR_SPREAD])
    sizes = np.array([_REACH, 2e-5, 2e-4, 2.0]) * diagonal  # reach, least lift for the sky, lift for the lamp, far away
    hemisphere, lengths = _hemisphere(sky_rays)
    lamp = _lamp(lights.key @ axes)

    def cast(first: int, last: int) -> None:
        room = (last - first) * (sky_rays + _SUN_RAYS)
        starts, towards = np.empty((room, 3), np.float32), np.empty((room, 3), np.float32)
        reach, owner, kind = np.empty(room, np.float32), np.empty(room, np.int64), np.empty(room, np.uint8)
        used = _send(
            axes, view, port.width, first, last, surfaces, eye, ground, sizes, lights.key, hemisphere, lengths, lamp,
            _ORDER, floor, found, starts, towards, reach, owner, kind,
        )  # fmt: skip
        blocked = caster.blocked(starts[:used], towards[:used], reach[:used])
        _gather(blocked, owner, kind, float(sky_rays), found)

    in_chunks(n, cast, threads)
    smooth = Light(np.ones(n, np.float32), np.ones(n, np.float32), found.fade)
    in_chunks(
        n, lambda first, last: _smooth(view, port.width, port.height, first, last, surfaces, found, smooth), threads
    )
    return smooth


@compiled
def _send(
    axes: Any, view: Any, width: int, first: int, last: int, surfaces: Any, eye: Any, ground: Any, sizes: Any,
    key: Any, hemisphere: Any, lengths: Any, lamp: Any, order: Any, floor: bool, found: Any, starts: Any,
    towards: Any, reach: Any, owner: Any, kind: Any,
) -> int:  # fmt: skip
    """Prepares the rays of some pixels, and what is known without any; says how many rays there are."""
    k = 0
    basis, point = np.empty((3, 3)), np.empty(3)
    for pixel in range(first, last):
        row, column = pixel // width, pixel % width
        x, y = (column + 0.5 - view[0]) * view[2], (view[1] - row - 0.5) * view[2]
        depth, fade, lift = surfaces.depth[pixel], 1.0, sizes[1] + 0.05 * view[2] * surfaces.depth[pixel]
        if surfaces.mesh[pixel] < 0:
            depth, fade = _on_floor(axes, eye, ground, x, y) if floor else (0.0, 0.0)
            if fade <= 0:
                continue
            found.fade[pixel] = fade
            lift = sizes[1]
        for i in range(3):
            point[i] = eye[i] + depth * (axes[2, i] + x * axes[0, i] + y * axes[1, i])
        facing, smooth = _upright(axes, surfaces.mesh, surfaces.flat, surfaces.normal, pixel, key, basis)
        cell = order[row % _PATTERN, column % _PATTERN]
        # Nothing hides the sky from floor that is further away than ambient occlusion reaches.
        if fade > ground[4]:
            found.sky[pixel] = 0.0
            for ray in range(hemisphere.shape[1]):
                for i in range(3):
                    starts[k, i] = point[i] + lift * basis[2, i]
                    towards[k, i] = (hemisphere[cell, ray, 0] * basis[0, i] + hemisphere[cell, ray, 1] * basis[1, i]
                                     + hemisphere[cell, ray, 2] * basis[2, i])  # fmt: skip
                reach[k], owner[k], kind[k] = lengths[cell, ray] * sizes[0], pixel, _SKY
                k += 1
        # A flat face that turns from (a part of) the lamp while the curve it stands for is lit is not in shadow: its
        # outline would show.
        found.sun[pixel] = 1.0 if smooth > 0 and facing <= _SOFTNESS else 0.0
        for ray in range(_SUN_RAYS if facing > _SOFTNESS else 0):
            for i in range(3):
                starts[k, i] = point[i] + sizes[2] * basis[2, i]
                towards[k, i] = lamp[cell + ray * _PATTERN * _PATTERN, i]
            reach[k], owner[k], kind[k] = sizes[3], pixel, _SUN
            k += 1
    return k


@compiled
def _upright(axes: Any, mesh: Any, triangle: Any, normal: Any, pixel: int, key: Any, basis: Any) -> tuple[float, float]:
    """A basis, in the world's axes, on the surface or floor at a pixel; says how much it faces the lamp.

    Returns:
        The cosine of the angle between the lamp and the triangle, and between the lamp and the smooth surface.
    """
    facing, smooth = 0.0, 0.0
    for i in range(3):
        basis[2, i] = 0.0
    for i in range(3):
        flat, rounded = axes[i, 2], axes[i, 2]
        if mesh[pixel] >= 0:
            flat, rounded = triangle[pixel, i], normal[pixel, i]
        facing += flat * key[i]
        smooth += rounded * key[i]
        for j in range(3):
            basis[2, j] += flat * axes[i, j]
    _tangents(basis)
    return facing, smooth


@compiled
def _on_floor(axes: Any, eye: Any, ground: Any, x: float, y: float) -> tuple[float, float]:
    """The depth at which a ray meets the floor, and how strongly shadows show there.

    The strength is 1 below what stands on the floor, and falls to 0 where the floor ends or none is met.
    """
    down = axes[2, 2] + x * axes[0, 2] + y * axes[1, 2]
    depth = ground[0] / down
    if down > -1e-3 or depth <= 0:
        return 0.0, 0.0
    beyond = 0.0
    for i in range(2):
        place = eye[i] + depth * (axes[2, i] + x * axes[0, i] + y * axes[1, i])
        out = max(abs(place) - ground[1 + i], 0.0)
        beyond += out * out
    return depth, 1.0 - np.sqrt(beyond) / ground[3]


@compiled
def _tangents(basis: Any) -> None:
    """Two unit vectors square to the third (T. Duff et al., Building an Orthonormal Basis, Revisited, 2017)."""
    x, y, z = basis[2, 0], basis[2, 1], basis[2, 2]
    sign = 1.0 if z >= 0 else -1.0
    a = -1.0 / (sign + z)
    b = x * y * a
    basis[0, 0], basis[0, 1], basis[0, 2] = 1.0 + sign * x * x * a, sign * b, -sign * x
    basis[1, 0], basis[1, 1], basis[1, 2] = b, sign + y * y * a, -y


@compiled
def _gather(blocked: Any, owner: Any, kind: Any, sky_rays: float, found: Any) -> None:
    for k in range(len(blocked)):
        if not blocked[k]:
            if kind[k] == _SKY:
                found.sky[owner[k]] += 1.0 / sky_rays
            else:
                found.sun[owner[k]] += 1.0 / _SUN_RAYS


@compiled
def _smooth(view: Any, width: int, height: int, first: int, last: int, surfaces: Any, found: Any, smooth: Any) -> None:
    """Averages over a block of pixels, but not across edges."""
    mesh_of, normal, depth = surfaces.mesh, surfaces.normal, surfaces.depth
    sky_seen, sun_seen, fade = found.sky, found.sun, found.fade
    half = _PATTERN // 2
    for p in range(first, last):
        mesh = mesh_of[p]
        if mesh < 0 and fade[p] <= 0:
            continue
        row, column = p // width, p % width
        px, py = (column + 0.5 - view[0]) * view[2], (view[1] - row - 0.5) * view[2]
        pz = depth[p]
        nx, ny, nz = normal[p, 0], normal[p, 1], normal[p, 2]
        across = px * nx + py * ny + nz
        limit = _FLAT * view[2]
        sky, sun, count = 0.0, 0.0, 0
        for r in range(max(0, row - half), min(height, row + half)):
            for c in range(max(0, column - half), min(width, column + half)):
                q = r * width + c
                if mesh_of[q] != mesh:
                    continue
                if mesh < 0:
                    if fade[q] <= 0:
                        continue
                else:
                    turn = nx * normal[q, 0] + ny * normal[q, 1] + nz * normal[q, 2]
                    # Distance from the tangent plane, in units of the depth.
                    qx, qy = px + (c - column) * view[2], py - (r - row) * view[2]
                    away = (qx * nx + qy * ny + nz) * (depth[q] / pz) - across
                    if turn < _ALIKE or abs(away) > limit:
                        continue
                sky += sky_seen[q]
                sun += sun_seen[q]
                count += 1
        smooth.sky[p] = sky / count
        smooth.sun[p] = sun / count


def _hemisphere(rays: int) -> tuple[Singles, Singles]:
    """Directions ``(16, rays, 3)`` about +Z by cosine, and lengths ``(16, rays)`` in 0..1, well spread in each cell."""
    cells = _PATTERN * _PATTERN
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
        np.ascontiguousarray(directions.reshape(rays, cells, 3).transpose(1, 0, 2), np.float32),
        np.ascontiguousarray(lengths.reshape(rays, cells).T, np.float32),
    )


def _lamp(key: Floats) -> Singles:
    """Unit directions ``(n, 3)`` towards points of the key lamp, in the world's axes."""
    basis = np.zeros((3, 3))
    basis[2] = key
    _tangents(basis)
    index = np.arange(_PATTERN * _PATTERN * _SUN_RAYS)
    radius, turn = np.sqrt((index + 0.5) / len(index)) * _SOFTNESS, index * np.pi * (3 - np.sqrt(5))
    targets = key + (radius * np.cos(turn))[:, None] * basis[0] + (radius * np.sin(turn))[:, None] * basis[1]
    towards: Singles = (targets / np.linalg.norm(targets, axis=1, keepdims=True)).astype(np.float32)
    return towards


def _radical_inverse(index: int, base: int) -> float:
    """Van der Corput: the digits of a number mirrored at the decimal point."""
    value, scale = 0.0, 1.0
    while index:
        scale /= base
        value += scale * (index % base)
        index //= base
    return value
