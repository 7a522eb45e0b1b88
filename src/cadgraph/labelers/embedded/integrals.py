"""Sums over the points where lines pierce a shape: histograms, profiles and symmetries about its main axis."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from cadgraph.geometry.kernels.parallel import compiled, for_ranges, readable
from cadgraph.geometry.mesh.pierce import Piercings
from cadgraph.model.parts import Properties
from cadgraph.model.scene import Floats, Ints

__all__ = [
    "BINS",
    "FINE",
    "GAPS",
    "HARMONICS",
    "ROUGH",
    "WALLS",
    "Frames",
    "Sums",
    "sum_pairs",
    "sum_points",
    "wall_of",
]

BINS, FINE, ROUGH = 12, 10, 6
"""Of places along and about an axis; of cosines; and of places and radii together."""
HARMONICS = (1, 2, 3, 4, 5, 6, 8, 10, 12, 16)
"""Orders of symmetry about the axis."""
GAPS = 8
"""Classes of the way across material or hollows, each twice the one before; and one for no way at all."""
WALLS = 96
"""Fine classes of the lesser way, for its median."""
_ORDERS = readable(np.array(HARMONICS), np.int64)
_FINEST, _COARSEST = -7.0, 0.0  # log2 of ways over the diagonal of the box
_MOST = 4000  # points whose pairs are looked at
_OFF = 0.05  # of the radius: so that a point on the axis is not all that counts for the least radius
_STEEP = 0.6  # cosine between line and normal from which a way counts


@dataclass(frozen=True)
class Frames:
    """The main axis of each shape.

    Args:
        center: ``(n, 3)`` a point on it [m].
        axis: ``(n, 3)`` unit.
        low: ``(n,)`` where the shape starts along it, from ``center`` [m].
        length: ``(n,)`` [m].
        radius: ``(n,)`` greatest distance from it [m].
    """

    center: Floats
    axis: Floats
    low: Floats
    length: Floats
    radius: Floats


@dataclass(frozen=True)
class Sums:
    """Of each shape, as shares of its area where nothing else is said; one row each.

    Args:
        along: ``(n, BINS)`` by the place along the axis.
        radial: ``(n, BINS)`` by the distance from it.
        both: ``(n, ROUGH, ROUGH)`` by place and distance.
        outer: ``(n, BINS)`` about the greatest radius at each place, over the greatest of all: a power mean, which no
            single point decides.
        inner: ``(n, BINS)`` about the least radius, likewise.
        axial: ``(n, FINE)`` by the cosine between normal and axis.
        around: ``(n, ROUGH)`` by that between the normal and the way around the axis.
        harmonics: ``(n, 3, len(HARMONICS))`` strength of each symmetry: everywhere, at the rim, between rim and hub.
        rim: ``(n,)`` beyond 0.72 of the radius.
        gaps: ``(n, 2, GAPS + 1)`` by the lesser and the greater way across, over the diagonal of the box; the last
            class is no way at all.
        walls: ``(n, WALLS)`` by the lesser way, finer.
        flat: ``(n, 2, 3)`` parallel to each side of the box: exactly, and roughly.
        long: ``(n, BINS)`` by the place along the longest side of the box.
        wide: ``(n, BINS)`` about the greatest distance from the box's middle line, over half the diagonal of its end.
        moments: ``(n, 4)`` mean place along the axis and along the box; mean of place times distance, likewise.
    """

    along: Floats
    radial: Floats
    both: Floats
    outer: Floats
    inner: Floats
    axial: Floats
    around: Floats
    harmonics: Floats
    rim: Floats
    gaps: Floats
    walls: Floats
    flat: Floats
    long: Floats
    wide: Floats
    moments: Floats


def sum_points(points: Piercings, frames: Frames, properties: Properties) -> Sums:
    """Adds up the points of each shape.

    Args:
        points: where a grid of lines goes through each shape.
        frames: their main axes.
        properties: of the shapes.
    """
    n = len(frames.radius)
    sums = Sums(
        np.zeros((n, BINS)), np.zeros((n, BINS)), np.zeros((n, ROUGH, ROUGH)), np.zeros((n, BINS)),
        np.zeros((n, BINS)), np.zeros((n, FINE)), np.zeros((n, ROUGH)), np.zeros((n, 3, len(HARMONICS))),
        np.zeros(n), np.zeros((n, 2, GAPS + 1)), np.zeros((n, WALLS)), np.zeros((n, 2, 3)), np.zeros((n, BINS)),
        np.zeros((n, BINS)), np.zeros((n, 4)),
    )  # fmt: skip
    given: Any = tuple(readable(values, np.float64) for values in (
        points.points, points.normals, points.weights, points.gaps, points.slant, frames.center, frames.axis,
        frames.low, frames.length, frames.radius, properties.obb_center, properties.obb_axes, properties.obb_extents,
    ))  # fmt: skip
    offsets = readable(points.offsets, np.int64)
    add: Any = _sum

    def kernel(first: int, last: int) -> None:
        add(first, last, offsets, *given, _ORDERS, sums.along, sums.radial, sums.both, sums.outer, sums.inner,
             sums.axial, sums.around, sums.harmonics, sums.rim, sums.gaps, sums.walls, sums.flat, sums.long,
             sums.wide, sums.moments)  # fmt: skip

    for_ranges(kernel, np.diff(points.offsets) + 1)
    return sums


def wall_of(walls: Floats) -> Floats:
    """The median of the lesser way across, over the diagonal of the box; 0 where nothing is across.

    Args:
        walls: ``(n, WALLS)`` see ``Sums``.
    """
    running = np.cumsum(walls, axis=1)
    half = running[:, -1:] / 2
    place = np.minimum((running < half).sum(axis=1), WALLS - 1)
    rows = np.arange(len(walls))
    before = np.where(place > 0, running[rows, np.maximum(place - 1, 0)], 0.0)
    inside = np.clip((half[:, 0] - before) / np.maximum(walls[rows, place], 1e-12), 0, 1)
    exponent = _FINEST + (place + inside) / WALLS * (_COARSEST - _FINEST)
    middle: Floats = np.where(half[:, 0] > 1e-9, np.exp2(exponent), 0.0)
    return middle


@compiled
def _put(row: Floats, value: float, bins: int, weight: float) -> None:
    """Adds a weight to the two classes nearest to a value within 0 and 1, so that a small move is a small change."""
    place = min(max(value * bins - 0.5, 0.0), bins - 1.0)
    k = min(int(place), bins - 2)
    share = place - k
    row[k] += weight * (1 - share)
    row[k + 1] += weight * share


@compiled
def _ramp(value: float, low: float, high: float) -> float:
    """0 below ``low``, 1 above ``high``, straight between."""
    return min(max((value - low) / (high - low), 0.0), 1.0)


@compiled
def _way(gap: float, diagonal: float) -> float:
    """The place of a way across among its classes, 0 to 1."""
    place: float = (np.log2(max(gap / diagonal, 1e-6)) - _FINEST) / (_COARSEST - _FINEST)
    return place


@compiled
def _settle(
    m: int,
    zones: Floats,
    steep: float,
    real: Floats,
    imaginary: Floats,
    along: Floats,
    outer: Floats,
    inner: Floats,
    harmonics: Floats,
    gaps: Floats,
    long: Floats,
    wide: Floats,
) -> None:
    """Makes strengths, power means and shares of what was added up."""
    for z in range(3):
        # A zone of hardly any area has no symmetry to speak of.
        for o in range(harmonics.shape[2]):
            strength = np.sqrt(real[z, o] ** 2 + imaginary[z, o] ** 2) / max(zones[z], 1e-12)
            harmonics[m, z, o] = strength * min(1.0, zones[z] / 0.03)
    for k in range(BINS):
        outer[m, k] = (outer[m, k] / max(along[m, k], 1e-9)) ** 0.125
        wide[m, k] = (wide[m, k] / max(long[m, k], 1e-9)) ** 0.125
        if along[m, k] > 1e-9:
            inner[m, k] = max((inner[m, k] / along[m, k]) ** -0.125 - _OFF, 0.0)
    if steep > 0:
        for k in range(GAPS + 1):
            gaps[m, 0, k] /= steep
            gaps[m, 1, k] /= steep


@compiled
def _sum(
    first: int,
    last: int,
    offsets: Ints,
    points: Floats,
    normals: Floats,
    weights: Floats,
    ways: Floats,
    slants: Floats,
    center: Floats,
    axes: Floats,
    low: Floats,
    length: Floats,
    radius: Floats,
    middle: Floats,
    sides: Floats,
    extents: Floats,
    orders: Ints,
    along: Floats,
    radial: Floats,
    both: Floats,
    outer: Floats,
    inner: Floats,
    axial: Floats,
    around: Floats,
    harmonics: Floats,
    rim: Floats,
    gaps: Floats,
    walls: Floats,
    flat: Floats,
    long: Floats,
    wide: Floats,
    moments: Floats,
) -> None:
    n_orders = len(orders)
    real, imaginary = np.zeros((3, n_orders)), np.zeros((3, n_orders))
    for m in range(first, last):
        whole = 0.0
        for p in range(offsets[m], offsets[m + 1]):
            whole += weights[p]
        if not whole > 0:
            continue
        ax, ay, az = axes[m, 0], axes[m, 1], axes[m, 2]
        # Any direction across the axis: orders of symmetry don't depend on where the angle starts.
        if abs(ax) <= abs(ay) and abs(ax) <= abs(az):
            ux, uy, uz = 0.0, -az, ay
        elif abs(ay) <= abs(az):
            ux, uy, uz = az, 0.0, -ax
        else:
            ux, uy, uz = -ay, ax, 0.0
        size = np.sqrt(ux * ux + uy * uy + uz * uz)
        ux, uy, uz = ux / size, uy / size, uz / size
        vx, vy, vz = ay * uz - az * uy, az * ux - ax * uz, ax * uy - ay * ux
        diagonal = np.sqrt(extents[m, 0] ** 2 + extents[m, 1] ** 2 + extents[m, 2] ** 2)
        end = max(np.sqrt(extents[m, 1] ** 2 + extents[m, 2] ** 2) / 2, 1e-9)
        zones = np.zeros(3)
        for z in range(3):
            for k in range(n_orders):
                real[z, k], imaginary[z, k] = 0.0, 0.0
        steep = 0.0
        for p in range(offsets[m], offsets[m + 1]):
            w = weights[p] / whole
            dx, dy, dz = points[p, 0] - center[m, 0], points[p, 1] - center[m, 1], points[p, 2] - center[m, 2]
            height = dx * ax + dy * ay + dz * az
            x, y = dx * ux + dy * uy + dz * uz, dx * vx + dy * vy + dz * vz
            out = np.sqrt(x * x + y * y)
            t = min(max((height - low[m]) / length[m], 0.0), 1.0)
            r = out / radius[m]
            _put(along[m], t, BINS, w)
            _put(radial[m], r, BINS, w)
            tp, rp = min(max(t * ROUGH - 0.5, 0.0), ROUGH - 1.0), min(max(r * ROUGH - 0.5, 0.0), ROUGH - 1.0)
            ti, ri = min(int(tp), ROUGH - 2), min(int(rp), ROUGH - 2)
            ts, rs = tp - ti, rp - ri
            both[m, ti, ri] += w * (1 - ts) * (1 - rs)
            both[m, ti + 1, ri] += w * ts * (1 - rs)
            both[m, ti, ri + 1] += w * (1 - ts) * rs
            both[m, ti + 1, ri + 1] += w * ts * rs
            _put(outer[m], t, BINS, w * r**8)
            _put(inner[m], t, BINS, w * (r + _OFF) ** -8)
            nx, ny, nz = normals[p, 0], normals[p, 1], normals[p, 2]
            _put(axial[m], abs(nx * ax + ny * ay + nz * az), FINE, w)
            if out > 1e-9 * radius[m]:
                c, s = x / out, y / out
                nu, nv = nx * ux + ny * uy + nz * uz, nx * vx + ny * vy + nz * vz
                _put(around[m], abs(nv * c - nu * s), ROUGH, w)
                share0 = w * _ramp(r, 0.0, 0.04)
                share1 = w * _ramp(r, 0.68, 0.76)
                share2 = w * _ramp(r, 0.32, 0.40) * (1 - _ramp(r, 0.64, 0.72))
                zones[0] += share0
                zones[1] += share1
                zones[2] += share2
                # cos and sin of multiples of the angle, one after the other.
                ck, sk, order = 1.0, 0.0, 0
                for o in range(n_orders):
                    while order < orders[o]:
                        ck, sk = ck * c - sk * s, ck * s + sk * c
                        order += 1
                    real[0, o] += share0 * ck
                    imaginary[0, o] += share0 * sk
                    real[1, o] += share1 * ck
                    imaginary[1, o] += share1 * sk
                    real[2, o] += share2 * ck
                    imaginary[2, o] += share2 * sk
            if slants[p] > _STEEP:
                v = w * _ramp(slants[p], _STEEP, 0.9)
                steep += v
                if ways[p, 0] < np.inf:
                    place = _way(ways[p, 0], diagonal)
                    _put(gaps[m, 0], place * GAPS / (GAPS + 1.0), GAPS + 1, v)
                    _put(walls[m], place, WALLS, v)
                else:
                    gaps[m, 0, GAPS] += v
                if ways[p, 1] < np.inf:
                    _put(gaps[m, 1], _way(ways[p, 1], diagonal) * GAPS / (GAPS + 1.0), GAPS + 1, v)
                else:
                    gaps[m, 1, GAPS] += v
            bx, by, bz = points[p, 0] - middle[m, 0], points[p, 1] - middle[m, 1], points[p, 2] - middle[m, 2]
            for d in range(3):
                cosine = abs(nx * sides[m, d, 0] + ny * sides[m, d, 1] + nz * sides[m, d, 2])
                flat[m, 0, d] += w * _ramp(cosine, 0.9975, 0.9985)
                flat[m, 1, d] += w * _ramp(cosine, 0.86, 0.94)
            ahead = bx * sides[m, 0, 0] + by * sides[m, 0, 1] + bz * sides[m, 0, 2]
            q = min(max(ahead / max(extents[m, 0], 1e-9) + 0.5, 0.0), 1.0)
            _put(long[m], q, BINS, w)
            aside = np.sqrt(max(bx * bx + by * by + bz * bz - ahead * ahead, 0.0)) / end
            _put(wide[m], q, BINS, w * aside**8)
            moments[m, 0] += w * t
            moments[m, 1] += w * q
            moments[m, 2] += w * (t - 0.5) * r
            moments[m, 3] += w * (q - 0.5) * aside
        rim[m] = zones[1]
        _settle(m, zones, steep, real, imaginary, along, outer, inner, harmonics, gaps, long, wide)


def sum_pairs(points: Piercings, properties: Properties) -> Floats:
    """Distances between all pairs of points over the diagonal of the box, by area (D2, Osada et al. 2002).

    Args:
        points: few for each shape: of ``n`` points there are ``n ** 2 / 2`` pairs.
        properties: of the shapes.

    Returns:
        ``(n_shapes, FINE)`` shares.
    """
    found = np.zeros((len(points.offsets) - 1, FINE))
    given: Any = tuple(readable(values, np.float64) for values in (
        points.points, points.weights, np.maximum(np.linalg.norm(properties.obb_extents, axis=1), 1e-12)))  # fmt: skip
    offsets = readable(points.offsets, np.int64)
    add: Any = _pairs

    def kernel(first: int, last: int) -> None:
        add(first, last, offsets, *given, found)

    for_ranges(kernel, np.minimum(np.diff(points.offsets), _MOST) ** 2 + 1)
    return found


@compiled
def _pairs(
    first: int, last: int, offsets: Ints, points: Floats, weights: Floats, diagonal: Floats, found: Floats
) -> None:
    for m in range(first, last):
        low, high = offsets[m], offsets[m + 1]
        step = 1 + (high - low) // _MOST
        whole = 0.0
        for p in range(low, high, step):
            for q in range(low, p, step):
                x, y, z = points[p, 0] - points[q, 0], points[p, 1] - points[q, 1], points[p, 2] - points[q, 2]
                w = weights[p] * weights[q]
                _put(found[m], np.sqrt(x * x + y * y + z * z) / diagonal[m], FINE, w)
                whole += w
        if whole > 0:
            for k in range(FINE):
                found[m, k] /= whole
