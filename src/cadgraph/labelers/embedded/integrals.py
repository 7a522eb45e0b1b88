"""Sums over the points where lines pierce a shape: histograms, profiles and symmetries about its main axis."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from cadgraph.geometry.kernels.frame import across
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


class Frames(NamedTuple):
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


class Sums(NamedTuple):
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
    seen = _points(points)
    about = Frames(*(readable(values, np.float64) for values in frames))
    boxes = _Boxes(*(readable(values, np.float64) for values in (
        properties.obb_center, properties.obb_axes, properties.obb_extents)))  # fmt: skip

    def kernel(first: int, last: int) -> None:
        _sum(first, last, seen, about, boxes, _ORDERS, sums)

    for_ranges(kernel, np.diff(points.offsets) + 1)
    return sums


class _Points(NamedTuple):
    """``Piercings`` as kernels take them."""

    offsets: Ints
    points: Floats
    normals: Floats
    weights: Floats
    gaps: Floats
    slant: Floats


class _Boxes(NamedTuple):
    """Oriented boxes as kernels take them."""

    center: Floats
    axes: Floats
    extents: Floats


def _points(points: Piercings) -> _Points:
    given = (points.points, points.normals, points.weights, points.gaps, points.slant)
    return _Points(readable(points.offsets, np.int64), *(readable(values, np.float64) for values in given))


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
def _settle(m: int, zones: Floats, steep: float, real: Floats, imaginary: Floats, sums: Sums) -> None:
    """Makes strengths, power means and shares of what was added up."""
    for z in range(3):
        # A zone of hardly any area has no symmetry to speak of.
        for o in range(sums.harmonics.shape[2]):
            strength = np.sqrt(real[z, o] ** 2 + imaginary[z, o] ** 2) / max(zones[z], 1e-12)
            sums.harmonics[m, z, o] = strength * min(1.0, zones[z] / 0.03)
    for k in range(BINS):
        sums.outer[m, k] = (sums.outer[m, k] / max(sums.along[m, k], 1e-9)) ** 0.125
        sums.wide[m, k] = (sums.wide[m, k] / max(sums.long[m, k], 1e-9)) ** 0.125
        if sums.along[m, k] > 1e-9:
            sums.inner[m, k] = max((sums.inner[m, k] / sums.along[m, k]) ** -0.125 - _OFF, 0.0)
    if steep > 0:
        for k in range(GAPS + 1):
            sums.gaps[m, 0, k] /= steep
            sums.gaps[m, 1, k] /= steep


@compiled
def _sum(first: int, last: int, seen: _Points, frames: Frames, boxes: _Boxes, orders: Ints, sums: Sums) -> None:
    n_orders = len(orders)
    real, imaginary = np.zeros((3, n_orders)), np.zeros((3, n_orders))
    for m in range(first, last):
        whole = 0.0
        for p in range(seen.offsets[m], seen.offsets[m + 1]):
            whole += seen.weights[p]
        if not whole > 0:
            continue
        ax, ay, az = frames.axis[m, 0], frames.axis[m, 1], frames.axis[m, 2]
        # Any direction across the axis: orders of symmetry don't depend on where the angle starts.
        (ux, uy, uz), (vx, vy, vz) = across(ax, ay, az)
        diagonal = np.sqrt(boxes.extents[m, 0] ** 2 + boxes.extents[m, 1] ** 2 + boxes.extents[m, 2] ** 2)
        end = max(np.sqrt(boxes.extents[m, 1] ** 2 + boxes.extents[m, 2] ** 2) / 2, 1e-9)
        zones = np.zeros(3)
        for z in range(3):
            for k in range(n_orders):
                real[z, k], imaginary[z, k] = 0.0, 0.0
        steep = 0.0
        for p in range(seen.offsets[m], seen.offsets[m + 1]):
            w = seen.weights[p] / whole
            px, py, pz = seen.points[p, 0], seen.points[p, 1], seen.points[p, 2]
            dx, dy, dz = px - frames.center[m, 0], py - frames.center[m, 1], pz - frames.center[m, 2]
            height = dx * ax + dy * ay + dz * az
            x, y = dx * ux + dy * uy + dz * uz, dx * vx + dy * vy + dz * vz
            out = np.sqrt(x * x + y * y)
            t = min(max((height - frames.low[m]) / frames.length[m], 0.0), 1.0)
            r = out / frames.radius[m]
            _put(sums.along[m], t, BINS, w)
            _put(sums.radial[m], r, BINS, w)
            tp, rp = min(max(t * ROUGH - 0.5, 0.0), ROUGH - 1.0), min(max(r * ROUGH - 0.5, 0.0), ROUGH - 1.0)
            ti, ri = min(int(tp), ROUGH - 2), min(int(rp), ROUGH - 2)
            ts, rs = tp - ti, rp - ri
            sums.both[m, ti, ri] += w * (1 - ts) * (1 - rs)
            sums.both[m, ti + 1, ri] += w * ts * (1 - rs)
            sums.both[m, ti, ri + 1] += w * (1 - ts) * rs
            sums.both[m, ti + 1, ri + 1] += w * ts * rs
            _put(sums.outer[m], t, BINS, w * r**8)
            _put(sums.inner[m], t, BINS, w * (r + _OFF) ** -8)
            nx, ny, nz = seen.normals[p, 0], seen.normals[p, 1], seen.normals[p, 2]
            _put(sums.axial[m], abs(nx * ax + ny * ay + nz * az), FINE, w)
            if out > 1e-9 * frames.radius[m]:
                c, s = x / out, y / out
                nu, nv = nx * ux + ny * uy + nz * uz, nx * vx + ny * vy + nz * vz
                _put(sums.around[m], abs(nv * c - nu * s), ROUGH, w)
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
            if seen.slant[p] > _STEEP:
                v = w * _ramp(seen.slant[p], _STEEP, 0.9)
                steep += v
                if seen.gaps[p, 0] < np.inf:
                    place = _way(seen.gaps[p, 0], diagonal)
                    _put(sums.gaps[m, 0], place * GAPS / (GAPS + 1.0), GAPS + 1, v)
                    _put(sums.walls[m], place, WALLS, v)
                else:
                    sums.gaps[m, 0, GAPS] += v
                if seen.gaps[p, 1] < np.inf:
                    _put(sums.gaps[m, 1], _way(seen.gaps[p, 1], diagonal) * GAPS / (GAPS + 1.0), GAPS + 1, v)
                else:
                    sums.gaps[m, 1, GAPS] += v
            bx, by, bz = px - boxes.center[m, 0], py - boxes.center[m, 1], pz - boxes.center[m, 2]
            for d in range(3):
                cosine = abs(nx * boxes.axes[m, d, 0] + ny * boxes.axes[m, d, 1] + nz * boxes.axes[m, d, 2])
                sums.flat[m, 0, d] += w * _ramp(cosine, 0.9975, 0.9985)
                sums.flat[m, 1, d] += w * _ramp(cosine, 0.86, 0.94)
            ahead = bx * boxes.axes[m, 0, 0] + by * boxes.axes[m, 0, 1] + bz * boxes.axes[m, 0, 2]
            q = min(max(ahead / max(boxes.extents[m, 0], 1e-9) + 0.5, 0.0), 1.0)
            _put(sums.long[m], q, BINS, w)
            aside = np.sqrt(max(bx * bx + by * by + bz * bz - ahead * ahead, 0.0)) / end
            _put(sums.wide[m], q, BINS, w * aside**8)
            sums.moments[m, 0] += w * t
            sums.moments[m, 1] += w * q
            sums.moments[m, 2] += w * (t - 0.5) * r
            sums.moments[m, 3] += w * (q - 0.5) * aside
        sums.rim[m] = zones[1]
        _settle(m, zones, steep, real, imaginary, sums)


def sum_pairs(points: Piercings, properties: Properties) -> Floats:
    """Distances between all pairs of points over the diagonal of the box, by area (D2, Osada et al. 2002).

    Args:
        points: few for each shape: of ``n`` points there are ``n ** 2 / 2`` pairs.
        properties: of the shapes.

    Returns:
        ``(n_shapes, FINE)`` shares.
    """
    found = np.zeros((len(points.offsets) - 1, FINE))
    seen = _points(points)
    diagonal = readable(np.maximum(np.linalg.norm(properties.obb_extents, axis=1), 1e-12), np.float64)

    def kernel(first: int, last: int) -> None:
        _pairs(first, last, seen, diagonal, found)

    for_ranges(kernel, np.minimum(np.diff(points.offsets), _MOST) ** 2 + 1)
    return found


@compiled
def _pairs(first: int, last: int, seen: _Points, diagonal: Floats, found: Floats) -> None:
    points, weights = seen.points, seen.weights
    for m in range(first, last):
        low, high = seen.offsets[m], seen.offsets[m + 1]
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
