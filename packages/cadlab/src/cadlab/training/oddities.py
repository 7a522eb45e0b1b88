"""Everyday things and machine elements outside the vocabulary, for ``make_distractors``."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import circle, rounded_rectangle, section_i
from cadplants.solids.primitives import along, around, ball, box, cylinder, lofted, ring, rod, rope, torus, turned
from cadplants.solids.transforms import at, spun

__all__ = ["ODDITIES"]


def _sides(rng: np.random.Generator) -> int:
    return int(rng.choice([8, 12, 16, 24, 32]))


def _bowed(rng: np.random.Generator, sides: int, low: float = 0.0, tall: float = 1.0) -> Solid:
    """A turned vessel with a smooth belly."""
    t = np.linspace(0, 1, int(rng.integers(7, 14)))
    knots = rng.uniform(0.2, 0.6, 5)
    radius = np.interp(t, np.linspace(0, 1, 5), knots)
    radius = np.convolve(np.pad(radius, 1, "edge"), [0.25, 0.5, 0.25], "valid")
    return turned(list(zip(radius.tolist(), (low + tall * t).tolist(), strict=True)), sides)


def _arc(radius: float, start: float, end: float, steps: int = 9) -> Floats:
    angle = np.linspace(start, end, steps)
    return np.column_stack([radius * np.cos(angle), np.zeros(steps), radius * np.sin(angle)])


def _pot(rng: np.random.Generator) -> Solid:
    """A teapot, jug, mug or kettle: a belly with a handle, maybe a spout, a lid and a knob."""
    n = _sides(rng)
    solids = [_bowed(rng, n)]
    handle = _arc(float(rng.uniform(0.2, 0.4)), -np.pi / 2, np.pi / 2) * [1, 1, rng.uniform(0.8, 1.4)]
    if rng.random() < 0.8:
        solids.append(rope(handle + np.array([rng.uniform(0.2, 0.45), 0, 0.5]), float(rng.uniform(0.03, 0.07)), 8))
    if rng.random() < 0.6:
        reach = rng.uniform(0.4, 0.9)
        way = [(-0.2, 0, 0.3), (-0.5, 0, 0.45), (-0.5 - 0.4 * reach, 0, 0.8), (-0.5 - 0.7 * reach, 0, 1.0)]
        solids.append(rope(way, float(rng.uniform(0.05, 0.1)), 8))
    if rng.random() < 0.6:
        solids.append(turned([(0.35, 0.98), (0.25, 1.08), (0.06, 1.15), (0.09, 1.22), (0.0, 1.28)], n))
    return merge(solids)


def _bottle(rng: np.random.Generator) -> Solid:
    """A bottle, flask or wine glass."""
    neck, shoulder = rng.uniform(0.08, 0.16), rng.uniform(0.5, 0.75)
    if rng.random() < 0.4:
        stem = rng.uniform(0.02, 0.05)
        cup = rng.uniform(0.25, 0.5)
        return turned([(0.3, 0), (stem, 0.04), (stem, 0.5), (cup, 0.65), (cup * 0.9, 1.0)], _sides(rng))
    return turned([(0.28, 0), (0.3, 0.03), (0.3, shoulder), (neck, shoulder + 0.15), (neck, 0.95), (neck * 1.2, 1.0)],
                  _sides(rng))  # fmt: skip


def _vehicle(rng: np.random.Generator) -> Solid:
    """A car, lorry or cart in one piece, with its wheels; at times the body only."""
    long, wide, tall = rng.uniform(1.5, 4), rng.uniform(0.8, 1.4), rng.uniform(0.4, 0.9)
    r, n = float(rng.uniform(0.25, 0.45)), _sides(rng)
    cab, start = float(rng.uniform(0.3, 0.6)) * long, float(rng.uniform(-0.5, 0.1)) * long
    low, high = rounded_rectangle(cab, wide * 0.95, 0.05, 3), rounded_rectangle(cab * 0.7, wide * 0.8, 0.05, 3)
    roof = lofted([np.column_stack([loop, np.full(len(loop), z)]) for loop, z in ((low, 0.0), (high, tall * 0.8))])
    solids = [box((long, wide, tall), (0, 0, r + tall / 2)), moved(roof, at(start + cab / 2, 0, r + tall))]
    if rng.random() < 0.7:
        for x in (-0.32 * long, 0.32 * long):
            for y in (-0.5 * wide, 0.5 * wide):
                solids.append(along("y", cylinder(r, -0.1, 0.1, n), x, y, r))
    return merge(solids)


def _house(rng: np.random.Generator) -> Solid:
    """A house with a gable and a chimney, or a church, or a hut."""
    x, y, z, up = (float(v) for v in rng.uniform([0.6, 0.6, 0.4, 0.2], [1.5, 2.0, 1.2, 0.8]))
    gable = np.array([(-x / 2, 0), (x / 2, 0), (x / 2, z), (0, z + up), (-x / 2, z)])
    solids = [along("-y", extrude(gable, -y / 2, y / 2))]
    if rng.random() < 0.6:
        solids.append(box((0.15, 0.15, up + 0.3), (x / 4, y / 4, z + up / 2)))
    if rng.random() < 0.3:
        solids.append(box((0.4, 0.4, 2.2 * z), (0, -y / 2, 1.1 * z)))
    return merge(solids)


def _tree(rng: np.random.Generator) -> Solid:
    """A fir, a round tree or a bush."""
    n = int(rng.choice([5, 6, 8, 12]))
    solids = [turned([(0.1, 0), (0.07, 1.0)], n)]
    if rng.random() < 0.5:
        for k in range(int(rng.integers(1, 4))):
            solids.append(turned([(0.6 - 0.12 * k, 0.4 + 0.4 * k), (0.0, 1.1 + 0.4 * k)], n))
    else:
        for _ in range(int(rng.integers(1, 6))):
            solids.append(
                moved(ball(float(rng.uniform(0.25, 0.5)), n), at(*rng.uniform([-0.3, -0.3, 1.1], [0.3, 0.3, 1.4])))
            )
    return merge(solids)


def _figure(rng: np.random.Generator) -> Solid:
    """A person, an animal or a robot: a body, a head, limbs."""
    n = int(rng.choice([6, 8, 12]))
    body = moved(ball(0.3, n, float(rng.uniform(1.0, 1.8))), at(0, 0, 1.0))
    solids = [body, moved(ball(float(rng.uniform(0.14, 0.24)), n), at(0, 0, float(rng.uniform(1.5, 1.75))))]
    for side in (-1, 1):
        reach = rng.uniform(-0.5, 0.5, 4)
        solids.append(rod((0.2 * side, 0, 1.2), (0.65 * side, reach[0], 1.0 + reach[1]), 0.07, n))
        solids.append(rod((0.12 * side, 0, 0.8), (0.2 * side, 0.4 * reach[2], 0.0), 0.09, n))
    if rng.random() < 0.4:
        solids = [moved(one, spun("x", np.pi / 2)) for one in solids]
    return merge(solids)


def _bearing(rng: np.random.Generator) -> Solid:
    """A rolling bearing (ISO 15): two rings with balls, shields or needles between them."""
    n, inner = _sides(rng), float(rng.uniform(0.25, 0.6))
    wide, wall = float(rng.uniform(0.2, 0.6)), 0.25 * (1 - inner)
    solids = [ring(inner, inner + wall, 0, wide, n), ring(1 - wall, 1.0, 0, wide, n)]
    kind, middle, gap = rng.random(), (inner + 1) / 2, (1 - inner) / 2 - wall
    if kind < 0.5:
        solids.append(around(moved(ball(1.1 * gap, 8), at(0, 0, wide / 2)), int(rng.integers(6, 12)), middle))
    elif kind < 0.8:
        solids.append(ring(inner + wall, 1 - wall, 0.06 * wide, 0.94 * wide, n))
    else:
        solids.append(around(cylinder(gap, 0.1 * wide, 0.9 * wide, 8), int(rng.integers(8, 16)), middle))
    return merge(solids)


def _pulley(rng: np.random.Generator) -> Solid:
    """A belt pulley, rope sheave or toothed roller, some with a hub."""
    n, bore = _sides(rng), float(rng.uniform(0.1, 0.4))
    wide, deep, grooves = float(rng.uniform(0.2, 0.8)), float(rng.uniform(0.05, 0.3)), int(rng.integers(1, 5))
    outline = [(bore, 0.0), (1.0, 0.0)]
    for k in range(grooves):
        z = wide * (k + 0.5) / grooves
        outline += [(1.0, z - 0.3 * wide / grooves), (1 - deep, z), (1.0, z + 0.3 * wide / grooves)]
    outline += [(1.0, wide), (bore, wide)]
    solids = [turned(outline[1:-1], n)]
    if rng.random() < 0.5:
        solids.append(ring(bore, bore + 0.15, wide, wide * 1.6, n))
    return merge(solids)


def _heat_sink(rng: np.random.Generator) -> Solid:
    """A plate with fins, a comb, or a brush."""
    fins, deep = int(rng.integers(4, 14)), float(rng.uniform(0.3, 1.0))
    solids = [box((1, 1, 0.08), (0, 0, 0.04))]
    if rng.random() < 0.4:
        spots = np.linspace(-0.4, 0.4, min(fins, 6))
        solids += [moved(cylinder(0.03, 0.05, deep, 6), at(float(x), float(y))) for x in spots for y in spots]
    else:
        solids += [box((0.3 / fins, 1, deep), (-0.5 + (k + 0.5) / fins, 0, deep / 2)) for k in range(fins)]
    return merge(solids)


def _tool(rng: np.random.Generator) -> Solid:
    """A spanner, hammer, spoon or guitar: a shaft with a shape at its end."""
    n = _sides(rng)
    long, r = float(rng.uniform(2, 6)), float(rng.uniform(0.05, 0.2))
    solids = [along("x", turned([(r, 0), (r * rng.uniform(0.6, 1.2), long)], n))]
    kind = int(rng.integers(4))
    if kind == 0:
        solids.append(along("y", cylinder(0.3, -0.7, 0.9, n), long))
    elif kind == 1:
        solids.append(Solid(ball(0.5, n).vertices * [1.2, 0.8, 0.25] + [long, 0, 0], ball(0.5, n).faces))
    elif kind == 2:
        solids += [box((0.9, 0.25, 0.2), (long + 0.4, 0.35 * s, 0)) for s in (-1, 1)]
    else:
        solids += [moved(cylinder(radius, -0.2, 0.2, n), at(long + x)) for radius, x in ((0.8, 0.5), (1.0, 1.6))]
    return merge(solids)


def _letters(rng: np.random.Generator) -> Solid:
    """Strokes side by side, as of raised letters or a logo."""
    solids = []
    deep = float(rng.uniform(0.05, 0.4))
    for k in range(int(rng.integers(1, 6))):
        for _ in range(int(rng.integers(2, 5))):
            x, z = rng.choice([0.0, 0.25, 0.5]), rng.choice([0.0, 0.5, 1.0])
            upright = rng.random() < 0.5
            size = (0.12, deep, rng.uniform(0.5, 1.1)) if upright else (rng.uniform(0.3, 0.6), deep, 0.12)
            solids.append(moved(box(size, (x, 0, z)), at(0.9 * k)))
    return merge(solids)


def _terrain(rng: np.random.Generator) -> Solid:
    """A piece of hilly land, a crumpled sheet, or a cushion, closed below."""
    n = int(rng.integers(8, 20))
    x, y = (v.ravel() for v in np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n), indexing="ij"))
    way = rng.normal(size=(5, 2)) * 3
    z = 0.3 + rng.uniform(0.02, 0.25) * np.sin(np.column_stack([x, y]) @ way.T + rng.uniform(0, 6, 5)).mean(axis=1)
    k = np.arange(n * n).reshape(n, n)
    a, b, c, d = (v.ravel() for v in (k[:-1, :-1], k[1:, :-1], k[1:, 1:], k[:-1, 1:]))
    top = np.vstack([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    rim = np.concatenate([k[:, 0], k[-1, 1:], k[-2::-1, -1], k[0, -2:0:-1]])
    after = np.roll(rim, -1)
    m = n * n
    side = np.vstack([np.column_stack([rim + m, after + m, after]), np.column_stack([rim + m, after, rim])])
    points = np.vstack([np.column_stack([x, y, z]), np.column_stack([x, y, np.zeros(m)])])
    return Solid(points, np.vstack([top, top[:, ::-1] + m, side]).astype(np.int32))


def _vessel(rng: np.random.Generator) -> Solid:
    """A boat, an aeroplane or a rocket."""
    n = _sides(rng)
    t = np.linspace(0, 1, 9)
    hull = turned(
        list(zip((0.35 * np.sin(np.pi * (0.08 + 0.84 * t)) ** 0.7).tolist(), (4 * t).tolist(), strict=True)), n
    )
    solids = [along("x", hull)]
    span, chord = float(rng.uniform(1.2, 2.5)), float(rng.uniform(0.5, 1.0))
    kind = int(rng.integers(3))
    if kind == 0:
        solids += [box((chord, 2 * span, 0.08), (2.2, 0, 0)), box((0.4, 1.2, 0.05), (0.3, 0, 0.1))]
        solids.append(box((0.4, 0.05, 0.7), (0.3, 0, 0.4)))
    elif kind == 1:
        solids.append(along("x", around(box((0.8, 0.05, 0.6), (0.3, 0, 0.3)), int(rng.integers(3, 5)), 0.2)))
    else:
        solids += [box((1.4, 0.5, 0.6), (1.8, 0, 0.4)), rod((2.2, 0, 0.5), (2.2, 0, 2.5), 0.05, n)]
    return merge(solids)


def _instrument(rng: np.random.Generator) -> Solid:
    """A toy of discs and rings on a stick, a top, a candlestick, a lampshade, a barbell, an hourglass."""
    n = _sides(rng)
    solids = [cylinder(float(rng.uniform(0.05, 0.15)), 0, 2, n)]
    for _ in range(int(rng.integers(2, 6))):
        z, r = float(rng.uniform(0.1, 1.9)), float(rng.uniform(0.2, 0.9))
        kind = int(rng.integers(4))
        one = (
            ball(r, n) if kind == 0
            else torus(r, 0.2 * r, n) if kind == 1
            else turned([(r, -0.15), (0.2 * r, 0.3)], n) if kind == 2
            else box((r, rng.uniform(0.3, 1) * r, 0.2), (0, 0, 0))
        )  # fmt: skip
        solids.append(moved(one, at(0, 0, z)))
    return merge(solids)


def _mechanism(rng: np.random.Generator) -> Solid:
    """A linkage, crank, cam or robot arm: plates with eyes at odd angles."""
    solids, spot, turn = [], np.zeros(3), 0.0
    n = _sides(rng)
    for _ in range(int(rng.integers(2, 5))):
        long, wide = float(rng.uniform(0.6, 1.6)), float(rng.uniform(0.1, 0.3))
        turn += float(rng.uniform(-1.6, 1.6))
        link = merge([
            box((long, 2 * wide, 0.12), (long / 2, 0, 0)), cylinder(1.2 * wide, -0.08, 0.08, n),
            moved(cylinder(1.4 * wide, -0.1, 0.1, n), at(long)), moved(cylinder(0.4 * wide, -0.3, 0.3, n), at(long)),
        ])  # fmt: skip
        solids.append(moved(link, at(*spot) @ spun("z", turn)))
        spot = spot + np.array([long * np.cos(turn), long * np.sin(turn), 0.13])
    return merge(solids)


def _fantasy(rng: np.random.Generator) -> Solid:
    """Layers of random outlines on each other: housings of machines that nobody has seen."""
    solids, z = [], 0.0
    for _ in range(int(rng.integers(2, 6))):
        tall = float(rng.uniform(0.1, 0.8))
        x, y = rng.uniform(0.3, 1.2, 2)
        kind = int(rng.integers(4))
        outline = (
            circle(float(x) / 2, _sides(rng)) if kind == 0
            else rounded_rectangle(float(x), float(y), 0.2 * float(min(x, y)), 3) if kind == 1
            else section_i(float(x), float(y), 0.2 * float(y), 0.15 * float(x)) if kind == 2
            else circle(float(x) / 2, int(rng.integers(3, 9)))
        )  # fmt: skip
        solids.append(
            moved(extrude(outline, 0, tall), at(float(rng.uniform(-0.2, 0.2)), float(rng.uniform(-0.2, 0.2)), z))
        )
        z += tall
    return merge(solids)


def _bent(solid: Solid, rng: np.random.Generator) -> Solid:
    """Twisted and drawn out along z."""
    points = solid.vertices - solid.vertices.mean(axis=0)
    tall = max(float(np.ptp(points[:, 2])), 1e-6)
    angle, grow = rng.uniform(-2, 2) * points[:, 2] / tall, 1 + rng.uniform(-0.5, 0.5) * points[:, 2] / tall
    x = (points[:, 0] * np.cos(angle) - points[:, 1] * np.sin(angle)) * grow
    y = (points[:, 0] * np.sin(angle) + points[:, 1] * np.cos(angle)) * grow
    return Solid(np.column_stack([x, y, points[:, 2]]), solid.faces)


def _twisted(rng: np.random.Generator) -> Solid:
    """Another oddity, twisted: nothing that is turned on a lathe looks like it."""
    kinds = (_fantasy, _pot, _instrument, _tree)
    return _bent(kinds[int(rng.integers(len(kinds)))](rng), rng)


ODDITIES: tuple[Callable[[np.random.Generator], Solid], ...] = (
    _pot, _pot, _bottle, _vehicle, _house, _tree, _figure, _bearing, _pulley, _heat_sink, _tool, _letters, _terrain,
    _vessel, _instrument, _mechanism, _fantasy, _twisted,
)  # fmt: skip
"""Builders, each of which draws one closed solid of about a metre."""
