"""What a shape looks like, in numbers that don't depend on its pose, and hardly on its triangles.

Two blocks for each shape: ``SIZES`` are logarithms of lengths in metres, which all shift alike when the shape is
scaled; ``FORMS`` are ratios, shares and counts that stay.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.geometry.mesh.sample import sample_surfaces
from cadgraph.labelers.embedded.edges import EDGE_FEATURES, edge_features
from cadgraph.labelers.embedded.sample import ray_gaps
from cadgraph.model.parts import Bools, Properties
from cadgraph.model.scene import Floats, Ints, Scene
from cadgraph.model.shapes import Disc, Facts

__all__ = ["FORMS", "SIZES", "Descriptors", "describe_shapes"]

_POINTS = 1024
_RAYS = 192
_BINS = 12
_CHUNK = 512  # shapes at a time: bounds the memory for their points
_FINE = 10
_HARMONICS = (1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 16)

SIZES = ("long", "middle", "short", "radius", "length", "thickness", "wall", "area", "port0", "port1", "bore0", "bore1")
"""Names of the absolute sizes, each ``log`` of metres; the area's square root; 0 sizes count as 0.1 mm."""

_BLOCKS: tuple[tuple[str, int], ...] = (
    ("box ratio", 2), ("filled", 3), ("inertia", 3), ("closed", 1), ("axis share", 3), ("along", _BINS),
    ("radial", _BINS), ("along radial", 36), ("profile outer", _BINS), ("profile inner", _BINS),
    ("normal axial", _FINE), ("normal around", 6), ("harmonics all", len(_HARMONICS)),
    ("harmonics rim", len(_HARMONICS)), ("harmonics middle", len(_HARMONICS)), ("pairs", _FINE), ("flat sides", 6),
    ("long along", _BINS), ("long width", _BINS), ("gap near", 5), ("gap far", 5), ("gap shares", 3), ("facts", 26),
    *EDGE_FEATURES,
)  # fmt: skip
FORMS = tuple(f"{name} {k}" if size > 1 else name for name, size in _BLOCKS for k in range(size))
"""Names of the numbers that do not depend on size."""

_LEAST = 1e-4  # m
_NONE = Disc(np.zeros(3), np.zeros(3), 0.0, 0.0, 0, 0.0)


@dataclass(frozen=True)
class Descriptors:
    """Numbers that describe shapes, one row each.

    Args:
        sizes: ``(n, len(SIZES))``.
        forms: ``(n, len(FORMS))``, all within about -10 to 10.
        radius: ``(n,)`` greatest distance from the main axis [m].
        length: ``(n,)`` along it [m].
    """

    sizes: Floats
    forms: Floats
    radius: Floats
    length: Floats


def describe_shapes(scene: Scene, properties: Properties, facts: Sequence[Facts]) -> Descriptors:
    """Describes each mesh of a scene.

    Args:
        scene: one mesh for each shape.
        properties: of these meshes.
        facts: of these meshes.
    """
    n = scene.n_meshes
    if not n:
        return Descriptors(np.zeros((0, len(SIZES))), np.zeros((0, len(FORMS))), np.zeros(0), np.zeros(0))
    blocks = [
        _describe(scene, properties, facts, np.arange(start, min(start + _CHUNK, n))) for start in range(0, n, _CHUNK)
    ]
    sizes, forms = np.concatenate([b[0] for b in blocks]), np.concatenate([b[1] for b in blocks])
    forms = np.clip(np.nan_to_num(np.hstack([forms, edge_features(scene)]), posinf=10, neginf=-10), -10, 10)
    return Descriptors(
        sizes, forms, np.array([f.radius for f in facts], np.float64), np.array([f.length for f in facts], np.float64)
    )


def _describe(scene: Scene, properties: Properties, facts: Sequence[Facts], rows: Ints) -> tuple[Floats, Floats]:
    some = scene.select(rows)
    samples = sample_surfaces(some, _POINTS)
    chosen = [facts[i] for i in rows.tolist()]
    extents = np.maximum(properties.obb_extents[rows], _LEAST / 10)
    diagonal = np.linalg.norm(extents, axis=1)
    axis, center = np.array([f.axis for f in chosen]), np.array([f.center for f in chosen])
    radius = np.maximum([f.radius for f in chosen], _LEAST / 10)
    low, high = np.array([f.low for f in chosen]), np.array([f.high for f in chosen])
    length = np.maximum(high - low, _LEAST / 10)
    apart = samples.points - center[:, None]
    z = np.einsum("mnk,mk->mn", apart, axis)
    across = apart - z[..., None] * axis[:, None]
    r = np.linalg.norm(across, axis=2) / radius[:, None]
    t = np.clip((z - low[:, None]) / length[:, None], 0, 1)
    # The end with more area comes first, so that a shape and its upside-down are one.
    turn = t.mean(axis=1) > 0.5
    t = np.where(turn[:, None], 1 - t, t)
    gaps = ray_gaps(some, samples, _RAYS)
    forms = np.hstack([
        _box(properties, rows, extents),
        _shares(axis, properties.obb_axes[rows]),
        _histogram(t, 0, 1, _BINS), _histogram(r, 0, 1, _BINS), _joint(t, r),
        _profiles(chosen, turn, radius),
        *_normals(samples.normals, axis, across),
        *_around(samples.points, axis, across, r),
        _pairs(samples.points, diagonal), _flat_sides(samples.normals, properties.obb_axes[rows]),
        *_long(samples.points, properties, rows, extents),
        *_gap_shares(gaps, diagonal),
        _facts(chosen),
    ])  # fmt: skip
    near = np.where(np.isfinite(gaps[..., 0]), gaps[..., 0], np.nan)
    wall = _median(near)
    area = properties.area[rows]
    volume = np.abs(properties.volume[rows])
    thickness = np.where(properties.closed[rows] & (area > 0), 2 * volume / np.maximum(area, 1e-12), wall)
    ports = np.array([_ports(f) for f in chosen]).reshape(-1, 4)
    sizes = np.column_stack([extents, radius, length, thickness, wall, np.sqrt(area), ports])
    return np.log(np.maximum(np.nan_to_num(sizes, posinf=0.0), _LEAST)), forms


def _median(values: Floats) -> Floats:
    """Of each row, 0 where all are NaN."""
    filled = np.where(np.isnan(values), np.inf, values)
    count = np.isfinite(filled).sum(axis=1)
    middle = np.sort(filled, axis=1)[np.arange(len(filled)), np.maximum(count - 1, 0) // 2]
    return np.where(count > 0, middle, 0.0)


def _ports(f: Facts) -> tuple[float, float, float, float]:
    """Outer and inner radii of the two widest ports [m]."""
    wide = sorted(f.ports, key=lambda p: -p.outer)[:2]
    outer = [p.outer for p in wide] + [0.0] * (2 - len(wide))
    inner = [p.inner if p.inner < p.outer else 0.0 for p in wide] + [0.0] * (2 - len(wide))
    return outer[0], outer[1], inner[0], inner[1]


def _box(properties: Properties, rows: Ints, extents: Floats) -> Floats:
    """Ratios of the box, how much of it is filled, and the moments."""
    ratio = np.log(extents[:, :2] / extents[:, 1:])
    area, volume = properties.area[rows], properties.volume[rows]
    box = extents.prod(axis=1)
    box_area = 2 * (extents[:, 0] * extents[:, 1] + extents[:, 0] * extents[:, 2] + extents[:, 1] * extents[:, 2])
    closed = properties.closed[rows].astype(np.float64)
    filled = np.column_stack([
        np.clip(np.abs(volume) / box, 0, 1.5) * closed,
        np.clip(area / box_area, 0, 6),
        np.clip(2 * np.abs(volume) / np.maximum(area * extents[:, 2], 1e-15), 0, 1.5) * closed,
    ])  # fmt: skip
    spread = np.linalg.eigvalsh(properties.inertia[rows])
    moments = spread / np.maximum(spread[:, 2:], 1e-30)
    moments[:, 2] = np.log(np.maximum(spread[:, 2] / np.maximum(area * extents[:, 0] ** 2, 1e-30), 1e-3))
    return np.hstack([ratio, filled, moments, closed[:, None]])


def _shares(axis: Floats, box: Floats) -> Floats:
    """How much the main axis agrees with the long, middle and short side of the box."""
    squares: Floats = np.einsum("mk,mjk->mj", axis, box) ** 2
    return squares


def _histogram(values: Floats, low: float, high: float, bins: int) -> Floats:
    """The share of each row's values in each bin, times the number of bins."""
    m, n = values.shape
    place = np.clip(((values - low) / (high - low) * bins).astype(np.int64), 0, bins - 1)
    counts = np.bincount((np.arange(m)[:, None] * bins + place).reshape(-1), minlength=m * bins)
    shares: Floats = counts.reshape(m, bins) * (bins / n)
    return shares


def _joint(t: Floats, r: Floats) -> Floats:
    m, n = t.shape
    place = np.clip((t * 6).astype(np.int64), 0, 5) * 6 + np.clip((r * 6).astype(np.int64), 0, 5)
    counts = np.bincount((np.arange(m)[:, None] * 36 + place).reshape(-1), minlength=m * 36)
    shares: Floats = np.minimum(counts.reshape(m, 36) * (36 / n), 10)
    return shares


def _profiles(facts: Sequence[Facts], turn: Bools, radius: Floats) -> Floats:
    """Outer and inner radius along the axis, over the greatest."""
    outer = np.array([f.outer for f in facts]).reshape(len(facts), _BINS, -1)
    inner = np.array([f.inner for f in facts]).reshape(len(facts), _BINS, -1)
    both = np.stack([outer.max(axis=2), inner.min(axis=2)], axis=1) / radius[:, None, None]
    both = np.where(turn[:, None, None], both[..., ::-1], both)
    rows: Floats = both.reshape(len(facts), 2 * _BINS)
    return rows


def _normals(normals: Floats, axis: Floats, across: Floats) -> tuple[Floats, Floats]:
    """How normals lie: along the axis, and around it."""
    axial = np.abs(np.einsum("mnk,mk->mn", normals, axis))
    way = across / np.maximum(np.linalg.norm(across, axis=2, keepdims=True), 1e-12)
    around = np.abs(np.einsum("mnk,mnk->mn", normals, np.cross(axis[:, None], way)))
    return _histogram(axial, 0, 1, _FINE), _histogram(around, 0, 1, 6)


def _around(points: Floats, axis: Floats, across: Floats, r: Floats) -> tuple[Floats, Floats, Floats]:
    """Strength of each symmetry order about the axis: everywhere, at the rim, and between rim and hub."""
    least = np.argmin(np.abs(axis), axis=1)
    u = np.cross(axis, np.eye(3)[least])
    u /= np.linalg.norm(u, axis=1, keepdims=True)
    angle = np.arctan2(np.einsum("mnk,mk->mn", across, np.cross(axis, u)), np.einsum("mnk,mk->mn", across, u))
    found = []
    for zone in (r > 0.02, r > 0.72, (r > 0.36) & (r <= 0.68)):
        count = np.maximum(zone.sum(axis=1), 1)
        rows = [
            np.abs((np.exp(1j * k * angle) * zone).sum(axis=1)) / count * np.minimum(1, count / 32) for k in _HARMONICS
        ]
        found.append(np.column_stack(rows))
    return found[0], found[1], found[2]


def _pairs(points: Floats, diagonal: Floats) -> Floats:
    """Distances between pairs of points over the diagonal of the box (D2, Osada et al. 2002)."""
    n = points.shape[1]
    other = (np.arange(n) * 389 + 197) % n
    far = np.linalg.norm(points - points[:, other], axis=2) / diagonal[:, None]
    return _histogram(far, 0, 1, _FINE)


def _flat_sides(normals: Floats, box: Floats) -> Floats:
    """Share of the surface that is parallel to each side of the box, descending; exactly, and roughly."""
    along = np.abs(np.einsum("mnk,mjk->mnj", normals, box))
    exact, rough = (along > 0.998).mean(axis=1), (along > 0.9).mean(axis=1)
    return np.hstack([np.sort(exact, axis=1)[:, ::-1], np.sort(rough, axis=1)[:, ::-1]])


def _long(points: Floats, properties: Properties, rows: Ints, extents: Floats) -> tuple[Floats, Floats]:
    """Area and width along the longest side of the box, the heavier end first."""
    axis = properties.obb_axes[rows, 0]
    apart = points - properties.obb_center[rows][:, None]
    t = np.clip(np.einsum("mnk,mk->mn", apart, axis) / extents[:, :1] + 0.5, 0, 1)
    t = np.where((t.mean(axis=1) > 0.5)[:, None], 1 - t, t)
    wide = np.linalg.norm(apart - np.einsum("mnk,mk->mn", apart, axis)[..., None] * axis[:, None], axis=2)
    wide = wide / np.maximum(np.linalg.norm(extents[:, 1:], axis=1) / 2, 1e-9)[:, None]
    m = len(t)
    place = np.arange(m)[:, None] * _BINS + np.clip((t * _BINS).astype(np.int64), 0, _BINS - 1)
    width = np.zeros(m * _BINS)
    np.maximum.at(width, place.reshape(-1), wide.reshape(-1))
    return _histogram(t, 0, 1, _BINS), width.reshape(m, _BINS)


def _gap_shares(gaps: Floats, diagonal: Floats) -> tuple[Floats, Floats, Floats]:
    """Quantiles of the ways across material or hollows on either side, and what share meets nothing."""
    finite = np.isfinite(gaps)
    over = np.where(finite, np.minimum(gaps / diagonal[:, None, None], 1.0), 1.2)
    ordered = np.sort(over, axis=1)
    n = gaps.shape[1]
    picks = np.array([0.1, 0.3, 0.5, 0.7, 0.9]) * (n - 1)
    quantiles = ordered[:, picks.astype(np.int64)]
    both = finite[..., 0] & finite[..., 1]
    none = ~finite[..., 0] & ~finite[..., 1]
    thin = finite[..., 0] & (over[..., 0] < 0.02)
    shares = np.column_stack([both.mean(axis=1), none.mean(axis=1), thin.mean(axis=1)])
    return quantiles[..., 0], quantiles[..., 1], shares


def _facts(facts: Sequence[Facts]) -> Floats:
    rows = []
    for f in facts:
        wide = sorted(f.ports, key=lambda p: -p.outer)
        widest = wide[0].outer if wide else 0.0
        first, second = (wide[0], wide[1]) if len(wide) > 1 else (None, None)
        between = float(first.normal @ second.normal) if first and second else 0.0
        apart = float(np.linalg.norm(first.center - second.center)) if first and second else 0.0
        width = 2 * widest or 1.0
        rows.append([
            min(len(f.discs), 20) / 5, min(len(f.ports), 10) / 3, float(f.tube > 0), float(f.bent),
            np.log1p(f.tube / width), float(f.round), f.turned, min(f.sides, 32) / 16,
            float(f.sides == 4), float(f.sides == 6), float(f.sides == 8), f.rim, min(f.spokes, 9) / 3,
            float(3 <= f.spokes <= 6), float(f.spokes == 0),
            widest / max(f.radius, 1e-9), (wide[1].outer / widest) if len(wide) > 1 else 0.0,
            (wide[2].outer / widest) if len(wide) > 2 else 0.0, between, np.log1p(apart / width),
            *((p.inner / p.outer) if p.outer > 0 else 0.0 for p in (*wide[:2], *[_NONE] * (2 - len(wide[:2])))),
            sum(1 for p in f.ports if p.outer > 0.7 * widest) / 3,
            float(sum(abs(p.normal @ f.axis) > 0.95 for p in f.ports)) / 3,
            np.log(max(f.length, 1e-5) / max(f.radius, 1e-5)), f.fill,
        ])  # fmt: skip
    return np.array(rows, np.float64).reshape(len(facts), 26)
