"""Hoses of further makes: between pipes, hanging, spiral, on a reel."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import pick
from cadplants.families.piping.shape import STEEL, family, knurled, lathe, mirrored, parts_of, pipe_x, prism
from cadplants.family import Family, Model, Part
from cadplants.flange import flange, flange_length
from cadplants.mesh_ops import Solid, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle
from cadplants.primitives import box, lofted, rod, rope, torus
from cadplants.standards import PIPES, SIZES
from cadplants.transforms import at, spun
from cadplants.valve_body import bore_of

__all__ = ["HOSES"]

_BACK = spun("z", np.pi)


def _along(path: Floats, radii: Floats, n: int) -> Solid:
    """A round skin of changing radius along a way in the plane of x and z."""
    tangents = np.gradient(path, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    side = np.array([0.0, 1.0, 0.0])
    ring_ = circle(1.0, n)
    loops = [
        p + r * (np.outer(ring_[:, 0], side) + np.outer(ring_[:, 1], np.cross(t, side)))
        for p, r, t in zip(path, radii, tangents, strict=True)
    ]
    return lofted(loops)


def _skin(count: int, r: float, kind: int) -> Floats:
    """Radii along a hose: smooth, ribbed by a spiral, or corrugated."""
    if kind == 0:
        return np.full(count, r)
    return r * (1.0 + (0.05 if kind == 1 else 0.1) * np.where(np.arange(count) % 2 == 0, 1.0, -1.0))


def _ferrule(dn: int, style: ModelingStyle, rng: np.random.Generator, design: int) -> tuple[list[Part], float]:
    """What a hose is held by from x = 0: a flange on a neck, a hexagon with a sleeve, or a cam lever half."""
    r, n = PIPES[dn].radius, style.round(1.3 * PIPES[dn].radius)
    sleeve, bore = 1.2 * r + 0.02, bore_of(dn, style)
    if design == 0:
        neck = flange_length(dn, style)
        parts = parts_of(flange(dn, style))
        parts.append(Part(lathe([(1.22 * r, neck), (1.22 * r, neck + sleeve)], n, bore), "coupling", "trim"))
        return parts, neck + 0.5 * sleeve
    if design == 1:
        hexa = 0.7 * r + 0.01
        nut = prism(2.6 * r + 0.005, 6, 0.0, hexa, bore, n)
        one = merge([nut, lathe([(1.05 * r, 0.9 * hexa), (1.05 * r, 1.4 * hexa)], n, bore)])
        ring_ = [(1.3 * r, 1.3 * hexa), (1.3 * r, 1.3 * hexa + 0.3 * sleeve), (1.22 * r, 1.3 * hexa + 0.3 * sleeve)]
        return [
            Part(one, "union", "trim"),
            Part(lathe([*ring_, (1.22 * r, 1.3 * hexa + sleeve)], n, bore), "coupling", "trim"),
        ], 1.3 * hexa + 0.5 * sleeve
    cup = 1.1 * r + 0.02
    cups = [lathe([(1.5 * r, 0.0), (1.5 * r, cup), (1.22 * r, cup + 0.2 * r), (1.22 * r, cup + sleeve)], n, bore)]
    arms = merge([box((1.5 * cup, 0.15 * r + 0.002, 0.5 * r), (cup, s * 1.6 * r, 0)) for s in (-1, 1)])
    return [
        Part(merge(cups), "coupling", "trim"),
        Part(arms, "lever", "handle", "", "Valve assembly"),
    ], cup + 0.5 * sleeve


def _between(
    dn: int,
    style: ModelingStyle,
    rng: np.random.Generator,
    styles: tuple[int, ...],
    sagging: float,
    kinds: tuple[int, ...],
) -> Model:
    """A hose in a line between two like ends, sagging or straight."""
    r, n = PIPES[dn].radius, style.round(1.15 * PIPES[dn].radius)
    ends, low = _ferrule(dn, style, rng, int(rng.choice(styles)))
    span = float(rng.uniform(5, 16)) * r + 0.1
    length = 2 * low + span
    kind = int(rng.choice(kinds))
    count = 41 if kind else 21
    t = np.linspace(0, 1, count)
    drop = sagging * float(rng.uniform(0.1, 0.5)) * span
    path = np.column_stack([low + span * t, np.zeros(count), -drop * np.sin(np.pi * t) ** 2])
    hose = Part(_along(path, _skin(count, 1.12 * r, kind), n), "hose", str(rng.choice(["rubber", "trim", "handle"])))
    # A flange meets the counter-flange that the line brings along, no bare pipe.
    lead = 0.0 if ends[0].name == "flange" else pick(rng, 0.0, 0.06)
    whole = [ends[0], *ends[1:], hose, *mirrored(ends, length)]
    if lead:
        whole = [Part(moved(p.solid, at(lead)), p.name, p.color, p.bundle, p.group, p.fine) for p in whole]
        whole.insert(0, Part(pipe_x(dn, 0.0, lead, style), "pipe", "pipe"))
        whole.append(Part(pipe_x(dn, length + lead, length + 2 * lead, style), "pipe", "pipe"))
    return Model(whole, round(length + 2 * lead, 9), "flanged" if not lead and ends[0].name == "flange" else "welded")


def _braided(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A corrugated metal hose under braid with flanges or screwed ends (ISO 10380), straight as at a pump."""
    return _between(dn, style, rng, (1,), 0.0, (0, 1, 2))


def _flanged(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A metal or rubber hose with flanges (EN ISO 10380), straight or hanging through a little."""
    return _between(dn, style, rng, (0,), pick(rng, 0.0, 0.3), (0, 1, 2))


def _slack(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A rubber hose with cam lever or screwed ends that sags between two pipes."""
    return _between(dn, style, rng, (1, 2, 2), 1.0, (0, 0, 1))


def _loading(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A loading hose on a pipe's end: it hangs down in a U and comes up again to a mouth, or lies out on the ground."""
    r, n = PIPES[dn].radius, style.round(1.15 * PIPES[dn].radius)
    ends, low = _ferrule(dn, style, rng, int(rng.choice([1, 2])))
    bow, drop = float(rng.uniform(5, 9)) * r, float(rng.uniform(0.1, 0.5))
    a = np.linspace(0, np.pi / 2, 7)[1:]
    first = np.column_stack([low + bow * np.sin(a), 0 * a, -bow * (1 - np.cos(a))])
    u = np.linspace(0, np.pi, 13)
    x, z = first[-1][0], first[-1][2] - drop
    turn = np.column_stack([x + bow * (1 - np.cos(u)), 0 * u, z - bow * np.sin(u)])
    up = np.array([[x + 2 * bow, 0.0, z + k * float(rng.uniform(0.1, 0.3))] for k in (1, 2)])
    knots = np.vstack([[[low - 0.01, 0, 0]], first, turn, up])
    s = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(knots, axis=0), axis=1))])
    kind = int(rng.integers(3))
    steps = np.linspace(0, s[-1], 71 if kind else 45)
    path = np.column_stack([np.interp(steps, s, knots[:, k]) for k in range(3)])
    hose = Part(_along(path, _skin(len(path), 1.12 * r, kind), n), "hose", "rubber")
    far = at(*path[-1]) @ spun("y", np.pi / 2) @ at(-low)
    more = [Part(moved(p.solid, far), p.name, p.color, p.bundle, p.group, p.fine) for p in ends]
    return Model([*ends, hose, *more])


def _coiled(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A spiral hose on a pipe's end, as for air: turns about the axis of the pipe, screwed ends."""
    r, n = PIPES[dn].radius, max(8, min(12, style.round(PIPES[dn].radius)))
    wide, turns, pitch = float(rng.uniform(3.5, 7)) * r, int(rng.integers(4, 10)), float(rng.uniform(2.2, 3.2)) * r
    ends, low = _ferrule(dn, style, rng, 1)
    steps = 14 * turns
    a = np.linspace(0, 2 * np.pi * turns, steps)
    grow = np.minimum(1.0, np.minimum(a, a[-1] - a) / np.pi)
    path = np.column_stack([low + r * 2 + pitch * a / (2 * np.pi), wide * grow * np.sin(a), wide * grow * np.cos(a)])
    path = np.vstack([[low - 0.01, 0, 0], path, path[-1] + [2 * r + 0.02, 0, 0]])
    far = at(float(path[-1][0]) + low - 0.01) @ _BACK
    more = [Part(moved(p.solid, far), p.name, p.color, p.bundle, p.group, p.fine) for p in ends]
    return Model([*ends, Part(rope(path, 1.0 * r, n), "hose", "handle"), *more])


def _reel(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A hose reel on a frame: a drum with two discs, wound hose, a crank, the free end hanging down to a nozzle."""
    r, drum, wide = float(rng.uniform(0.01, 0.02)), float(rng.uniform(0.1, 0.18)), float(rng.uniform(0.2, 0.4))
    disc, n = drum + float(rng.uniform(0.1, 0.18)), style.round(0.3)
    z = disc + 0.08
    lay = spun("z", np.pi / 2)
    place = at(0, 0, z) @ lay
    layers = int(rng.integers(1, 4))
    wraps = []
    count = max(3, int(wide / (2.2 * r)))
    for layer in range(layers):
        for k in range(count):
            x = -0.5 * wide + (k + 0.5) * wide / count
            wraps.append(
                moved(torus(drum + r * (1 + 1.9 * layer), r, max(12, min(n, 20)), 6), at(x) @ spun("y", np.pi / 2))
            )
    sides = [lathe([(disc, s * 0.5 * wide - 0.003), (disc, s * 0.5 * wide + 0.003)], n) for s in (-1, 1)]
    core = lathe([(drum, -0.5 * wide), (drum, 0.5 * wide)], n)
    out = drum + r * (1 + 1.9 * (layers - 1))
    tail_ = np.array([[out, 0, z], [out + 0.01, 0, 0.6 * z], [out + 0.05, 0.05, 0.25 * z]])
    legs = []
    for s in (-1, 1):
        y = s * (0.5 * wide + 0.03)
        legs += [rod((-0.7 * disc, y, 0.0), (0, y, z), 0.014, 8), rod((0.7 * disc, y, 0.0), (0, y, z), 0.014, 8)]
    axle = moved(lathe([(0.018, -0.5 * wide - 0.05), (0.018, 0.5 * wide + 0.05)], 10), place)
    crank = merge(
        [
            rod((0, 0.5 * wide + 0.05, z), (0.15, 0.5 * wide + 0.05, z), 0.008, 8),
            rod((0.15, 0.5 * wide + 0.045, z), (0.15, 0.5 * wide + 0.16, z), 0.011, 8),
        ]
    )
    parts = [
        Part(moved(merge(wraps), place), "hose", "rubber", "hose"),
        Part(rope(tail_, r, 8), "hose", "rubber", "hose"),
        Part(moved(merge([core, *sides]), place), "plate", "handle", "", STEEL),
        Part(merge([*legs, axle, crank]), "skid frame", "steel", "", STEEL),
    ]
    nozzle = moved(
        knurled(1.6 * r, 8, 0.3 * r, -0.02, 0.06, 0.0, 12), at(out + 0.05, 0.05, 0.25 * z) @ spun("y", np.pi / 2)
    )
    return Model([*parts, Part(nozzle, "coupling", "trim")])


_MIDDLE = tuple(dn for dn in SIZES if dn <= 150)

HOSES: tuple[Family, ...] = (
    family("hose/braided", _braided, _MIDDLE, weight=1.0),
    family("hose/flanged", _flanged, weight=1.0),
    family("hose/slack", _slack, _MIDDLE, weight=1.0),
    family("hose/loading", _loading, _MIDDLE, "end", 1.0),
    family("hose/spiral", _coiled, SIZES[:5], "end", 1.0),
    family("hose/reel", _reel, (25,), "floor", 1.0),
)
