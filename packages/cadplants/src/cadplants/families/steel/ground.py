"""Ground: slabs with joints, paving, gutters, gravel in kerbs, roads, uneven patches."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import pick
from cadplants.families.steel.shape import (
    chance_ as chance,
    few_sides,
    floor_family,
    num,
    piece,
    rect,
    slab_xy,
    slab_xz,
)
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle
from cadplants.primitives import box, cylinder, turned
from cadplants.transforms import at, spun

__all__ = ["GROUNDS"]


def _slabs(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Ground in fields: slabs with joints, paving stones, falls to a gutter, a ramp, holes."""
    a, b, t, kind = num(rng, 1.5, 5.0), num(rng, 1.2, 4.0), pick(rng, 0.02, 0.1, 0.2, 0.4), int(rng.integers(5))
    parts: list[Part] = []
    if kind == 0:
        m, n = int(rng.integers(1, 4)), int(rng.integers(1, 4))
        for i in range(m):
            for j in range(n):
                solid = box((a / m - 0.012, b / n - 0.012, t), ((i + 0.5) * a / m, (j + 0.5) * b / n, -t / 2))
                parts.append(piece(solid, "ground", pick(rng, "ground", "concrete")))
    elif kind == 1:
        m, n, solids = int(a / 0.4), int(b / 0.3), []
        for j in range(min(n, 8)):
            solids += [box((0.39, 0.29, 0.08), (0.4 * i + 0.2 * (j % 2), 0.3 * j, -0.04)) for i in range(min(m, 10))]
        parts.append(piece(merge(solids), "ground", "concrete"))
        parts.append(
            piece(
                box(
                    (0.4 * min(m, 10) + 0.2, 0.3 * min(n, 8), 0.15),
                    (0.2 * min(m, 10) - 0.1, 0.15 * min(n, 8) - 0.15, -0.155),
                ),
                "ground",
                "ground",
            )
        )
    elif kind == 2:
        for s in (-1, 1):
            shape = [(0, -t), (b / 2, -t), (b / 2, 0.05), (0, 0.0)]
            parts.append(piece(moved(slab_xz(shape, a), spun("z", s * np.pi / 2) @ at(0.08)), "ground", "concrete"))
        parts.append(
            piece(
                slab_xz(
                    [
                        (-0.08, -0.12),
                        (0.08, -0.12),
                        (0.08, 0.0),
                        (0.05, 0.0),
                        (0.05, -0.08),
                        (-0.05, -0.08),
                        (-0.05, 0.0),
                        (-0.08, 0.0),
                    ],
                    a,
                ),
                "foundation",
                "clamp",
            )
        )
        parts[-1] = piece(moved(parts[-1].solid, spun("z", np.pi / 2)), "foundation", "clamp")
    elif kind == 3:
        parts.append(piece(box((a, b, t), (0, 0, -t / 2)), "ground", "ground"))
        shape = [(a / 2, -t), (a / 2 + 1.2, -t), (a / 2, 0)]
        parts.append(piece(slab_xz(shape, 0.5 * b), "ground", "concrete"))
    else:
        outline = np.array([[0, 0], [a, 0], [a, 0.6 * b], [0.6 * a, 0.6 * b], [0.6 * a, b], [0, b]])
        holes = (circle(0.12, few_sides(style, 0.12, 24), (0.3 * a, 0.3 * b)), rect(0.3, 0.3, 0.4 * a, 0.75 * b))
        parts.append(piece(slab_xy(outline, -t, 0, holes if chance(rng, 0.6) else ()), "ground", "concrete"))
    if chance(rng, 0.4) and kind in (0, 3):
        size = num(rng, 0.3, 0.8)
        parts.append(piece(box((size, size, 0.2), (0.25 * a, 0.25 * b, 0.1)), "foundation", "concrete"))
    return Model(parts)


def _grounds(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Ground with an edge or relief: gravel in kerbs, a grass mound, a round pad, a road, a terrain patch."""
    a, b, kind = num(rng, 1.5, 4.0), num(rng, 1.2, 3.0), int(rng.integers(4))
    parts: list[Part] = []
    if kind == 0:
        parts.append(piece(box((a, b, 0.1), (0, 0, -0.05)), "ground", "ground"))
        kerb = pick(rng, 0.06, 0.1, 0.15)
        solids = [box((a + 2 * kerb, kerb, 0.25), (0, s * (b / 2 + kerb / 2), -0.05)) for s in (-1, 1)]
        solids += [box((kerb, b, 0.25), (s * (a / 2 + kerb / 2), 0, -0.05)) for s in (-1, 1)]
        parts += [piece(one, "foundation", "concrete") for one in solids]
    elif kind == 1:
        r = a / 2
        parts.append(
            piece(
                turned([(r, -0.1), (r, 0.0), (0.9 * r, pick(rng, 0.0, 0.1))], few_sides(style, r, 40)),
                "ground",
                "ground",
            )
        )
        if chance(rng, 0.5):
            post = cylinder(0.05, 0.0, 1.0, 12)
            parts.append(piece(post, "post", "fence"))
    elif kind == 2:
        xs = np.linspace(-b / 2, b / 2, 9)
        top = 0.03 * (1 - (2 * xs / b) ** 2)
        shape = [
            (-b / 2, -0.2),
            (b / 2, -0.2),
            *((float(x), float(z)) for x, z in zip(xs[::-1], top[::-1], strict=True)),
        ]
        parts.append(piece(slab_xz(shape, a), "ground", "ground"))
        for s in (-1, 1):
            parts.append(piece(box((0.15, a, 0.32), (s * (b / 2 + 0.075), 0, -0.04)), "foundation", "concrete"))
            parts.append(piece(box((0.8, a, 0.1), (s * (b / 2 + 0.55), 0, 0.06)), "ground", "concrete"))
    else:
        n = int(rng.integers(5, 12))
        xs, ys = np.linspace(0, a, n), np.linspace(0, b, n)
        x, y = np.meshgrid(xs, ys, indexing="ij")
        z = num(rng, 0.02, 0.12) * rng.standard_normal((n, n))
        parts.append(piece(_terrain(x, y, z - z.min(), -0.3), "ground", "ground"))
    return Model(parts)


def _terrain(x: Floats, y: Floats, z: Floats, low: float) -> Solid:
    """A block with an uneven top over a regular grid."""
    n, m = x.shape
    top = np.column_stack([x.ravel(), y.ravel(), z.ravel()])
    bottom = top * (1, 1, 0) + np.array([0, 0, low])
    i, j = (k.ravel() for k in np.meshgrid(np.arange(n - 1), np.arange(m - 1), indexing="ij"))
    a, b, c, d = i * m + j, (i + 1) * m + j, (i + 1) * m + j + 1, i * m + j + 1
    up = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    rim = [k * m for k in range(n)] + [(n - 1) * m + k for k in range(1, m)]
    rim += [k * m + m - 1 for k in range(n - 2, -1, -1)] + list(range(m - 2, 0, -1))
    p, q = np.array(rim), np.roll(rim, -1)
    s = n * m
    side = np.concatenate([np.column_stack([p + s, q + s, q]), np.column_stack([p + s, q, p])])
    faces = np.concatenate([up, up[:, ::-1] + s, side]).astype(np.int32)
    return Solid(np.concatenate([top, bottom]), faces)


GROUNDS: tuple[Family, ...] = (
    floor_family("ground/slabs", _slabs, 1.3, "fitting"),
    floor_family("ground/relief", _grounds, 1.0, "fitting"),
)
