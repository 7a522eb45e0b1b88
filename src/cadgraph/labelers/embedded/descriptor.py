"""What a shape looks like, in numbers that don't depend on its pose, nor on its triangles.

Two blocks for each shape: ``SIZES`` are logarithms of lengths in metres, which all shift alike when the shape is
scaled; ``FORMS`` are ratios, shares and counts that stay.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from cadgraph.geometry.kernels.gather import gather_chunks
from cadgraph.geometry.mesh.pierce import Piercings, pierce
from cadgraph.labelers.embedded.edges import EDGE_FEATURES, edge_features
from cadgraph.labelers.embedded.integrals import (
    BINS,
    FINE,
    GAPS,
    HARMONICS,
    ROUGH,
    Frames,
    sum_pairs,
    sum_points,
    wall_of,
)
from cadgraph.model.parts import Bools, Properties
from cadgraph.model.scene import Floats, Ints, Scene
from cadgraph.model.shapes import Disc, Facts

__all__ = ["FORMS", "SIZES", "Descriptors", "describe_shapes", "even_sides"]

_LINES, _FEW_LINES = 24, 8  # across each side of the box: for integrals, and for distances of all pairs
_CHUNK = 32  # shapes at a time: bounds the memory for their points

SIZES = ("long", "middle", "short", "radius", "length", "thickness", "wall", "area", "port0", "port1", "bore0", "bore1")
"""Names of the absolute sizes, each ``log`` of metres; the area's square root; 0 sizes count as 0.1 mm."""

_BLOCKS: tuple[tuple[str, int], ...] = (
    ("box ratio", 2), ("filled", 3), ("inertia", 3), ("closed", 1), ("axis share", 3), ("along", BINS),
    ("radial", BINS), ("along radial", ROUGH * ROUGH), ("profile outer", BINS), ("profile inner", BINS),
    ("normal axial", FINE), ("normal around", ROUGH), ("harmonics all", len(HARMONICS)),
    ("harmonics rim", len(HARMONICS)), ("harmonics middle", len(HARMONICS)), ("pairs", FINE), ("flat sides", 6),
    ("long along", BINS), ("long width", BINS), ("gap near", GAPS + 1), ("gap far", GAPS + 1), ("rim", 1),
    ("facts", 20), *EDGE_FEATURES,
)  # fmt: skip
FORMS = tuple(f"{name} {k}" if size > 1 else name for name, size in _BLOCKS for k in range(size))
"""Names of the numbers that do not depend on size."""

_LEAST = 1e-4  # m
_AS_WIDE = 0.98  # ports of this share of another's radius are as wide
_MOST_PORTS = 24  # that are compared with each other
_EVEN = 2e-3  # moments this close to even don't say which end is which
_NONE = Disc(np.zeros(3), np.zeros(3), 0.0, 0.0, 0, 0.0)


@dataclass(frozen=True)
class Descriptors:
    """Numbers that describe shapes, one row each.

    Args:
        sizes: ``(n, len(SIZES))``.
        forms: ``(n, len(FORMS))``, all within about -10 to 10.
        points: where few lines pierce each shape, each with the area it stands for.
    """

    sizes: Floats
    forms: Floats
    points: Piercings


def describe_shapes(scene: Scene, properties: Properties, facts: Sequence[Facts]) -> Descriptors:
    """Describes each mesh of a scene.

    Args:
        scene: one mesh for each shape.
        properties: of these meshes.
        facts: of these meshes.
    """
    n = scene.n_meshes
    few = pierce(scene, properties, _FEW_LINES)
    if not n:
        return Descriptors(np.zeros((0, len(SIZES))), np.zeros((0, len(FORMS))), few)
    frames, pairs = _frames(facts), sum_pairs(few, properties)

    def describe(rows: Ints) -> tuple[Floats, Floats]:
        some = [facts[i] for i in rows.tolist()]
        about = Frames(*(values[rows] for values in frames))
        return _describe(scene.select(rows), properties.select(rows), about, pairs[rows], some)

    blocks = gather_chunks(describe, np.diff(scene.face_offsets), _CHUNK)
    sizes, forms = np.concatenate([b[0] for b in blocks]), np.concatenate([b[1] for b in blocks])
    return Descriptors(sizes, np.clip(np.nan_to_num(forms, posinf=10, neginf=-10), -10, 10), few)


def _frames(facts: Sequence[Facts]) -> Frames:
    length = np.array([f.high - f.low for f in facts])
    radius = np.array([f.radius for f in facts])
    return Frames(
        np.array([f.center for f in facts]),
        np.array([f.axis for f in facts]),
        np.array([f.low for f in facts]),
        np.maximum(length, _LEAST / 10),
        np.maximum(radius, _LEAST / 10),
    )


def _describe(
    scene: Scene, properties: Properties, frames: Frames, pairs: Floats, facts: list[Facts]
) -> tuple[Floats, Floats]:
    sums = sum_points(pierce(scene, properties, _LINES), frames, properties)
    extents = np.maximum(properties.obb_extents, _LEAST / 10)
    diagonal = np.linalg.norm(properties.obb_extents, axis=1)
    n = len(facts)
    # The end with more area comes first, so that a shape and its upside-down are one.
    turn = _heavy_last(sums.moments[:, 0], sums.moments[:, 2])
    turned_box = _heavy_last(sums.moments[:, 1], sums.moments[:, 3])
    forms = np.hstack([
        _box(properties, extents),
        _shares(frames.axis, properties.obb_axes, extents),
        _ordered(sums.along, turn) * BINS, sums.radial * BINS,
        np.minimum(_ordered(sums.both, turn).reshape(n, -1) * ROUGH * ROUGH, 10),
        _ordered(sums.outer, turn), _ordered(sums.inner, turn),
        sums.axial * FINE, sums.around * ROUGH, sums.harmonics.reshape(n, -1),
        pairs * FINE, _sorted(sums.flat[:, 0]), _sorted(sums.flat[:, 1]),
        _ordered(sums.long, turned_box) * BINS, _ordered(sums.wide, turned_box),
        sums.gaps[:, 0] * GAPS, sums.gaps[:, 1] * GAPS, sums.rim[:, None],
        _facts(facts), edge_features(scene, properties),
    ])  # fmt: skip
    wall = wall_of(sums.walls) * diagonal
    area, volume = properties.area, np.abs(properties.volume)
    thickness = np.where(properties.closed & (area > 0), 2 * volume / np.maximum(area, 1e-12), wall)
    ports = np.array([_ports(f) for f in facts]).reshape(-1, 4)
    sizes = np.column_stack([extents, frames.radius, frames.length, thickness, wall, np.sqrt(area), ports])
    return np.log(np.maximum(np.nan_to_num(sizes, posinf=0.0), _LEAST)), forms


def _heavy_last(mean: Floats, skew: Floats) -> Bools:
    """Whether more area lies towards the far end; where that is even, whether what is wide does."""
    even = np.abs(mean - 0.5) <= _EVEN
    last: Bools = np.where(even, skew > _EVEN, mean > 0.5)
    return last


def _ordered(rows: Floats, turn: Bools) -> Floats:
    """The rows, those to be turned from the other end."""
    shape = (-1,) + (1,) * (rows.ndim - 1)
    ordered: Floats = np.where(turn.reshape(shape), rows[:, ::-1], rows)
    return ordered


def _sorted(rows: Floats) -> Floats:
    descending: Floats = np.sort(rows, axis=1)[:, ::-1]
    return descending


def _ports(f: Facts) -> tuple[float, float, float, float]:
    """Outer and inner radii of the two widest ports [m]."""
    wide = sorted(f.ports, key=lambda p: -p.outer)[:2]
    outer = [p.outer for p in wide] + [0.0] * (2 - len(wide))
    inner = sorted([p.inner if p.inner < p.outer else 0.0 for p in wide] + [0.0] * (2 - len(wide)), reverse=True)
    return outer[0], outer[1], inner[0], inner[1]


def even_sides(values: Floats, extents: Floats) -> Floats:
    """Of sides of a box that are equally long, which are in no order, each gets the mean.

    Args:
        values: ``(n, 3)`` of each side.
        extents: ``(n, 3)`` their lengths, descending.
    """
    even = values.copy()
    for a, b in ((0, 1), (1, 2)):
        same = extents[:, b] > (1 - _EVEN) * extents[:, a]
        even[:, [a, b]] = np.where(same[:, None], even[:, [a, b]].mean(axis=1, keepdims=True), even[:, [a, b]])
    return even


def _box(properties: Properties, extents: Floats) -> Floats:
    """Ratios of the box, how much of it is filled, and the moments."""
    ratio = np.log(extents[:, :2] / extents[:, 1:])
    area, volume = properties.area, properties.volume
    box = extents.prod(axis=1)
    box_area = 2 * (extents[:, 0] * extents[:, 1] + extents[:, 0] * extents[:, 2] + extents[:, 1] * extents[:, 2])
    closed = properties.closed.astype(np.float64)
    filled = np.column_stack([
        np.clip(np.abs(volume) / box, 0, 1.5) * closed,
        np.clip(area / box_area, 0, 6),
        np.clip(2 * np.abs(volume) / np.maximum(area * extents[:, 2], 1e-15), 0, 1.5) * closed,
    ])  # fmt: skip
    spread = np.linalg.eigvalsh(properties.inertia)
    moments = spread / np.maximum(spread[:, 2:], 1e-30)
    moments[:, 2] = np.log(np.maximum(spread[:, 2] / np.maximum(area * extents[:, 0] ** 2, 1e-30), 1e-3))
    return np.hstack([ratio, filled, moments, closed[:, None]])


def _shares(axis: Floats, box: Floats, extents: Floats) -> Floats:
    """How much the main axis agrees with the long, middle and short side of the box."""
    squares: Floats = np.einsum("mk,mjk->mj", axis, box) ** 2
    return even_sides(squares, extents)


def _widest_pair(wide: list[Disc]) -> tuple[Disc | None, Disc | None]:
    """The two widest ports; of several that are as wide, those that look away from each other most, and farthest apart.

    Args:
        wide: the widest first.
    """
    if len(wide) < 2:
        return None, None
    first = [p for p in wide if p.outer > _AS_WIDE * wide[0].outer]
    pairs = list(combinations(first[:_MOST_PORTS], 2)) if len(first) > 1 else []
    if not pairs:
        pairs = [(first[0], p) for p in wide[1 : 1 + _MOST_PORTS] if p.outer > _AS_WIDE * wide[1].outer]
    return min(
        pairs,
        key=lambda pair: (
            round(float(pair[0].normal @ pair[1].normal), 2),
            -float(np.linalg.norm(pair[0].center - pair[1].center)),
        ),
    )


def _facts(facts: Sequence[Facts]) -> Floats:
    rows = []
    for f in facts:
        wide = sorted(f.ports, key=lambda p: -p.outer)
        widest = wide[0].outer if wide else 0.0
        first, second = _widest_pair(wide)
        between = float(first.normal @ second.normal) if first and second else 0.0
        apart = float(np.linalg.norm(first.center - second.center)) if first and second else 0.0
        width = 2 * widest or 1.0
        bores = sorted(
            ((p.inner / p.outer) if p.outer > 0 else 0.0 for p in (first or _NONE, second or _NONE)), reverse=True
        )
        rows.append([
            min(len(f.discs), 20) / 5, min(len(f.ports), 10) / 3, float(f.tube > 0), float(f.bent),
            np.log1p(f.tube / width), float(f.round),
            # Corners of a nut or a bar are few and meant; those of a circle are as many as somebody liked.
            float(f.sides == 4), float(f.sides in (5, 6)), float(f.sides in (7, 8)), float(f.sides > 8),
            widest / max(f.radius, 1e-9), (wide[1].outer / widest) if len(wide) > 1 else 0.0,
            (wide[2].outer / widest) if len(wide) > 2 else 0.0, between, np.log1p(apart / width), *bores,
            sum(1 for p in f.ports if p.outer > 0.7 * widest) / 3,
            float(sum(abs(p.normal @ f.axis) > 0.95 for p in f.ports)) / 3,
            np.log(max(f.length, 1e-5) / max(f.radius, 1e-5)),
        ])  # fmt: skip
    return np.array(rows, np.float64).reshape(len(facts), 20)
