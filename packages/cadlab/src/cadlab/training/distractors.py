"""Shapes that belong to no plant, so that the network learns what it doesn't know."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from cadgraph.model.scene import Floats
from cadlab.training.oddities import ODDITIES
from cadplants.model.plant import Component, Plant
from cadplants.solids.mesh_ops import Solid, box, extrude, merge, moved, revolve, sweep, weld
from cadplants.solids.polygon import circle
from cadplants.solids.transforms import at, spun

__all__ = ["UNSEEN", "UNSEEN_FROM", "make_distractors", "visited"]

_SIZES = (0.01, 3.0)  # m
_STRANGE: tuple[str, str] = ("strange", "strange")
_FASTENERS = ("bolt", "nut", "washer", "stud", "screw", "gasket")
UNSEEN = frozenset({"_pot", "_vessel", "_mechanism"})
"""Builders of what is not learnt from (but for a few twisted pots): what does the network make of the unknown?"""
UNSEEN_FROM = 200_000
"""Seeds of distractors from here on are of these kinds."""


def make_distractors(seed: int, count: int = 60) -> Plant:
    """Furniture, toys, gears, blobs and fantasies, some in heaps; each labelled ``STRANGE``.

    Args:
        seed: of everything; from ``UNSEEN_FROM`` on only the kinds ``UNSEEN``, before it all others.
        count: about how many.
    """
    rng = np.random.default_rng([seed, 77])
    builds = [b for b in (*_BUILDS, *ODDITIES) if (b.__name__ in UNSEEN) == (seed >= UNSEEN_FROM)]
    components: list[Component] = []
    for k in range(count):
        one = _stranger(rng, builds)
        spot = at(*(rng.uniform(-1, 1, 3) * (0.3 if rng.random() < 0.5 else 12.0) + [4.0 * (k // 8), 0, 0]))
        for j in range(int(rng.choice([1, 1, 1, 2, 4]))):
            shift = at(*(rng.uniform(0.0, 0.6, 3) * j))
            components.append(replace(one, pose=shift @ spot @ one.pose))
    return Plant(tuple(components), name="strangers", seed=seed)


def visited(plant: Plant, seed: int, share: float = 0.08) -> Plant:
    """A plant with distractors that lean on its parts, so that neighbours alone don't make a thing known.

    Args:
        plant: any.
        seed: of what comes.
        share: of the components of the plant that something leans on.
    """
    rng = np.random.default_rng([seed, 78])
    builds = [b for b in (*_BUILDS, *ODDITIES) if b.__name__ not in UNSEEN]
    guests = []
    for component in plant.components:
        if component.name in _FASTENERS or rng.random() > share:
            continue
        one = _stranger(rng, builds)
        points, host, way = one.vertices, component.vertices, rng.normal(size=3)
        touch = host[np.argmax(host @ way)] - points[np.argmin(points @ way)]
        guests.append(replace(one, pose=at(*touch) @ one.pose))
    return replace(plant, components=(*plant.components, *guests))


def _stranger(rng: np.random.Generator, builds: Sequence[Callable[[np.random.Generator], Solid]]) -> Component:
    """One thing about the origin, turned some way."""
    build = builds[int(rng.integers(len(builds)))]
    solid = _fitted(build(rng), float(np.exp(rng.uniform(*np.log(_SIZES)))))
    turn = spun("z", rng.uniform(0, 6)) @ spun("x", rng.choice([0, 0, np.pi / 2, rng.uniform(0, 6)]))
    return Component(solid, *_STRANGE, (0.5, 0.5, 0.5), turn, family=f"strange/{build.__name__[1:]}")


def _fitted(solid: Solid, size: float) -> Solid:
    low, high = solid.vertices.min(axis=0), solid.vertices.max(axis=0)
    return Solid((solid.vertices - (low + high) / 2) * (size / max(float((high - low).max()), 1e-9)), solid.faces)


def _ornament(rng: np.random.Generator) -> Solid:
    """A turned profile with no straight line in it: vases, balusters, chessmen."""
    n = int(rng.integers(5, 16))
    z = np.sort(rng.uniform(0, rng.uniform(0.5, 5), n))
    r = rng.uniform(0.15, 1.0, n)
    z[0], z[-1] = z.min(), z.max()
    profile = [(0.0, float(z[0])), *zip(r.tolist(), (z + np.arange(n) * 1e-3).tolist(), strict=True)]
    profile.append((0.0, float(z[-1] + n * 1e-3)))
    return weld([revolve(profile, int(rng.integers(5, 40)))])


def _plate(rng: np.random.Generator) -> Solid:
    """A random star-like outline, thick or thin: brackets of no use, letters, leaves."""
    n = int(rng.integers(3, 14))
    angle = np.sort(rng.uniform(0, 2 * np.pi, n)) + np.linspace(0, 0.4, n)
    radius = rng.uniform(0.3, 1.0, n)
    outline = np.column_stack([np.cos(angle), np.sin(angle)]) * radius[:, None]
    thick = float(np.exp(rng.uniform(np.log(0.02), np.log(2))))
    try:
        return extrude(outline, 0.0, thick)
    except ValueError:  # all corners on one side: its last edge may cross the others
        return extrude(circle(1.0, n) * radius[:, None], 0.0, thick)


def _gear(rng: np.random.Generator) -> Solid:
    """A gear with its bore."""
    teeth = int(rng.integers(8, 40))
    step = np.arange(4 * teeth) * 2 * np.pi / (4 * teeth)
    radius = np.where(np.arange(4 * teeth) % 4 < 2, 1.0, 1 - rng.uniform(0.08, 0.3))
    outline = np.column_stack([np.cos(step), np.sin(step)]) * radius[:, None]
    return extrude(outline, 0.0, float(rng.uniform(0.1, 1.2)), (circle(float(rng.uniform(0.1, 0.5)), 16),))


def _furniture(rng: np.random.Generator) -> Solid:
    """A table, stool or shelf in one piece."""
    wide, deep, tall = rng.uniform(0.3, 1.5, 3)
    thick = float(rng.uniform(0.02, 0.08))
    solids = [moved(box((wide, deep, thick)), at(0, 0, float(tall)))]
    for x in (-1, 1):
        for y in (-1, 1):
            leg = box((thick, thick, float(tall)))
            solids.append(moved(leg, at(x * (wide - thick) / 2, y * (deep - thick) / 2, tall / 2)))
    if rng.random() < 0.5:
        solids.append(moved(box((wide, thick, float(tall) * 0.8)), at(0, deep / 2, 1.4 * tall)))
    if rng.random() < 0.4:
        solids.append(moved(box((wide, deep, thick)), at(0, 0, tall / 2)))
    return merge(solids)


def _heap(rng: np.random.Generator) -> Solid:
    """Boxes and cylinders thrown together: toys, robots, engines."""
    solids = []
    for _ in range(int(rng.integers(2, 9))):
        size = rng.uniform(0.1, 1.0, 3)
        one = box((float(size[0]), float(size[1]), float(size[2])))
        if rng.random() < 0.4:
            one = extrude(circle(float(size[0]) / 2, int(rng.integers(6, 24))), 0.0, float(size[2]))
        solids.append(moved(one, at(*rng.uniform(-0.6, 0.6, 3)) @ spun("x", rng.uniform(0, 6))))
    return merge(solids)


def _blob(rng: np.random.Generator) -> Solid:
    """A ball with waves: stones, plants, animals."""
    n = int(rng.integers(8, 28))
    angle = np.linspace(0, np.pi, n)
    ball = weld([revolve([(float(np.sin(a)), float(-np.cos(a))) for a in angle], 2 * n)])
    way = rng.normal(size=(4, 3)) * rng.uniform(0.5, 4)
    wave = 1 + rng.uniform(0.05, 0.4) * np.sin(ball.vertices @ way.T + rng.uniform(0, 6, 4)).mean(axis=1)
    return Solid(ball.vertices * wave[:, None] * rng.uniform(0.4, 1.0, 3), ball.faces)


def _coil(rng: np.random.Generator) -> Solid:
    """A spring or a wire sculpture."""
    turns, rise = rng.uniform(1, 8), rng.uniform(0.1, 3)
    t = np.linspace(0, 1, int(16 * turns))
    angle = 2 * np.pi * turns * t
    grow = 1 + rng.uniform(-0.7, 0.7) * t
    path = np.column_stack([grow * np.cos(angle), grow * np.sin(angle), rise * t])
    return sweep(path, circle(float(rng.uniform(0.02, 0.15)), int(rng.integers(4, 10))))


def _scribble(rng: np.random.Generator) -> Solid:
    """A bar along a crooked way, of a section that no mill rolls."""
    path: Floats = np.cumsum(rng.uniform(-0.2, 1.0, (int(rng.integers(4, 10)), 3)), axis=0)
    n = int(rng.integers(3, 9))
    angle = np.arange(n) * 2 * np.pi / n
    section = np.column_stack([np.cos(angle), np.sin(angle)]) * rng.uniform(0.03, 0.2, (n, 1))
    return sweep(path, section)


def _shell(rng: np.random.Generator) -> Solid:
    """A car-like body: a rounded box that tapers, without wheels."""
    solid = _blob(rng)
    power = rng.uniform(0.3, 0.8)
    points = np.sign(solid.vertices) * np.abs(solid.vertices) ** power
    points[:, 0] *= rng.uniform(1, 3)
    points[:, 2] *= np.where(points[:, 2] > 0, rng.uniform(0.3, 1.0), 1.0)
    return Solid(points, solid.faces)


_BUILDS: tuple[Callable[[np.random.Generator], Solid], ...] = (
    _ornament, _plate, _gear, _furniture, _heap, _blob, _coil, _scribble, _shell,
)  # fmt: skip
