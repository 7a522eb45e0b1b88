"""Fasteners of all kinds and sizes, each by itself: real files hold them so, and no plant shows so many."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.model.plant import Component, Plant
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved, revolve, sweep, weld
from cadplants.solids.polygon import circle
from cadplants.solids.transforms import at, spun

__all__ = ["make_fasteners"]

# Nominal diameters [mm] of ISO metric threads (ISO 262, first choice).
_THREADS = (2, 2.5, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 30, 36, 42, 48)
_APART = 4.0  # m

Profile = list[tuple[float, float]]


def make_fasteners(seed: int, count: int = 90) -> Plant:
    """Loose bolts, screws, studs, nuts and washers.

    Args:
        seed: of everything.
        count: how many.
    """
    rng = np.random.default_rng([seed, 79])
    components = []
    for k in range(count):
        name, build = _BUILDS[int(rng.integers(len(_BUILDS)))]
        d = float(rng.choice(_THREADS)) / 1000 * float(rng.uniform(0.97, 1.03))
        solid = build(d, int(rng.choice([8, 12, 16, 20, 24, 32, 48])), rng)
        pose = at(_APART * (k % 10), _APART * (k // 10), 0) @ spun("x", float(rng.uniform(0, 6)))
        components.append(
            Component(
                solid, "Connection assembly", name, (0.5, 0.5, 0.5), pose, family=f"fastener/{build.__name__[1:]}"
            )
        )
    return Plant(tuple(components), name="fasteners", seed=seed)


def _shank(d: float, low: float, high: float, sides: int, rng: np.random.Generator) -> Solid:
    """A shank about z: plain, with a thinner thread, or with its thread as rings; its tip chamfered."""
    tip = min(0.1 * d, 0.2 * (high - low))
    kind = rng.random()
    profile: Profile = [(0.0, low), (d / 2 - tip, low), (d / 2, low + tip)]
    if kind < 0.3:  # the thread as rings
        n = int(np.clip((high - low) / (0.15 * d), 3, 40))
        for k in range(n):
            z = low + tip + (high - low - 2 * tip) * (k + 0.5) / n
            profile += [(0.43 * d, z - 0.01 * d), (0.5 * d, z + 0.04 * d)]
    elif kind < 0.5:
        end = low + float(rng.uniform(0.3, 0.9)) * (high - low)
        profile = [(0.0, low), (0.42 * d, low), (0.42 * d, end), (0.5 * d, end + 0.02 * d)]
    profile += [(d / 2, high), (0.0, high)]
    return weld([revolve(profile, sides)])


def _length(d: float, rng: np.random.Generator) -> float:
    return d * float(np.exp(rng.uniform(np.log(1.0), np.log(10.0))))


def _hex_bolt(d: float, sides: int, rng: np.random.Generator) -> Solid:
    """ISO 4014/4017: width across flats about 1.5 to 1.8 d, head 0.65 d; some with a nut or a flange."""
    flat, head, length = float(rng.uniform(1.5, 1.85)), float(rng.uniform(0.6, 0.72)), _length(d, rng)
    hexagon = (flat * d / 2 / np.cos(np.pi / 6)) * circle(1.0, 6)
    solids = [extrude(hexagon, 0, head * d), _shank(d, -length, 0.02 * d, sides, rng)]
    if rng.random() < 0.3:
        wide, cut = 0.57 * flat * d, flat * d / 2
        rounded: Profile = [(0.0, 0.0), (cut, 0.0), (wide, 0.1 * d), (wide, 0.9 * head * d), (cut, head * d)]
        solids[0] = weld([revolve([*rounded, (0.0, head * d)], 6)])
    if rng.random() < 0.2:
        collar: Profile = [(0.0, -0.05 * d), (1.05 * d, -0.05 * d), (1.05 * d, 0.08 * d), (0.0, 0.08 * d)]
        solids.append(weld([revolve(collar, sides)]))
    if rng.random() < 0.25 and length > 2 * d:
        solids.append(extrude(hexagon, -length + 0.3 * d, -length + 1.1 * d, (circle(0.5 * d, sides),)))
    return merge(solids)


def _socket_screw(d: float, sides: int, rng: np.random.Generator) -> Solid:
    """ISO 4762: head 1.5 d wide and d high, socket 0.8 d over flats."""
    wide, tall = float(rng.uniform(1.45, 1.9)) * d, float(rng.uniform(0.9, 1.05)) * d
    return merge([_socketed([(wide / 2, 0.0), (wide / 2, tall)], tall, 0.42 * d, 0.5 * d, sides),
                  _shank(d, -_length(d, rng), 0.0, sides, rng)])  # fmt: skip


def _button_screw(d: float, sides: int, rng: np.random.Generator) -> Solid:
    """ISO 7380: a low round head with a socket; or a cross or slot that nobody models."""
    wide, tall = float(rng.uniform(1.75, 2.0)) * d, float(rng.uniform(0.5, 0.6)) * d
    bow = [(wide / 2 * float(np.cos(a)) ** 0.6, tall * float(np.sin(a))) for a in np.linspace(0.1, 1.1, 5)]
    return merge([_socketed([(wide / 2, 0.0), *bow], bow[-1][1], 0.33 * d, 0.3 * d, sides),
                  _shank(d, -_length(d, rng), 0.0, sides, rng)])  # fmt: skip


def _countersunk_screw(d: float, sides: int, rng: np.random.Generator) -> Solid:
    """ISO 10642: a cone of 90 degrees, 2 d wide, with a socket."""
    wide = float(rng.uniform(1.8, 2.1)) * d
    tall = (wide - d) / 2
    length = max(_length(d, rng), 1.2 * tall)
    return merge([_socketed([(d / 2, -tall), (wide / 2, 0.0)], 0.0, 0.36 * d, 0.4 * d, sides),
                  _shank(d, -length, -tall, sides, rng)])  # fmt: skip


def _set_screw(d: float, sides: int, rng: np.random.Generator) -> Solid:
    """DIN 913: no head, a socket, a flat, coned or cupped point."""
    long = d * float(rng.uniform(0.9, 3.0))
    point = float(rng.uniform(0.25, 0.5)) * d
    return _socketed([(0.0, -long), (point, -long), (d / 2, -long + 0.12 * d), (d / 2, 0.0)], 0.0, 0.28 * d,
                     min(0.5 * d, 0.5 * long), sides)  # fmt: skip


def _socketed(side: Profile, top: float, socket: float, deep: float, sides: int) -> Solid:
    """A head with a six-sided hole from the top; the hole is turned, with as many sides."""
    profile = list(side)
    if profile[0][0] > 0:
        profile.insert(0, (0.0, profile[0][1]))
    profile += [(socket, top), (socket, top - deep), (0.0, top - deep)]
    return weld([revolve(profile, 6 * max(1, round(sides / 6)))])


def _stud(d: float, sides: int, rng: np.random.Generator) -> Solid:
    """A threaded rod, with or without its nuts (ASME B18.31.2)."""
    long = d * float(rng.uniform(3, 14))
    solids = [_shank(d, 0.0, long, sides, rng)]
    if rng.random() < 0.3:
        hexagon = (1.6 * d / 2 / np.cos(np.pi / 6)) * circle(1.0, 6)
        for z in (0.3 * d, long - 1.3 * d):
            solids.append(extrude(hexagon, z, z + d, (circle(0.5 * d, sides),)))
    return merge(solids)


def _nut(d: float, sides: int, rng: np.random.Generator) -> Solid:
    """ISO 4032: 1.5 to 1.8 d over flats, 0.4 to 1 d high; chamfered or not, thread bored or nearly."""
    flat, tall = float(rng.uniform(1.5, 1.9)) * d, float(rng.uniform(0.4, 1.0)) * d
    bore = float(rng.uniform(0.42, 0.52)) * d
    corner = flat / 2 / float(np.cos(np.pi / 6))
    if rng.random() < 0.5:
        return extrude(corner * circle(1.0, 6), 0.0, tall, (circle(bore, sides),))
    cut = 0.93 * corner
    low: Profile = [(bore, 0.0), (cut, 0.0), (corner, 0.12 * tall)]
    high: Profile = [(corner, 0.88 * tall), (cut, tall), (bore, tall)]
    return weld([revolve([*low, *high], 6, closed=True)])


def _round_nut(d: float, sides: int, rng: np.random.Generator) -> Solid:
    """A nut with a collar, a nylon ring or a dome on it (ISO 7040, ISO 4161, DIN 1587)."""
    corner, tall = 1.65 * d / 2 / float(np.cos(np.pi / 6)), 0.8 * d
    solids = [extrude(corner * circle(1.0, 6), 0.0, tall, (circle(0.48 * d, sides),))]
    kind = rng.random()
    if kind < 0.4:
        ring: Profile = [(0.48 * d, tall), (0.72 * d, tall), (0.66 * d, 1.15 * tall), (0.5 * d, 1.15 * tall)]
        solids.append(weld([revolve(ring, sides, closed=True)]))
    elif kind < 0.7:
        solids.append(
            weld(
                [
                    revolve(
                        [(0.5 * d, -0.15 * d), (1.1 * d, -0.15 * d), (1.1 * d, 0.0), (0.5 * d, 0.0)], sides, closed=True
                    )
                ]
            )
        )
    else:
        dome = [(0.75 * d * float(np.cos(a)), tall + 0.75 * d * float(np.sin(a))) for a in np.linspace(0, 1.57, 6)]
        solids.append(weld([revolve([(0.0, tall), *dome[:-1], (0.0, tall + 0.75 * d)], sides)]))
    return merge(solids)


def _washer(d: float, sides: int, rng: np.random.Generator) -> Solid:
    """ISO 7089/7091/7093, DIN 7349: twice to three times d wide, 0.1 to 0.4 d thick."""
    wide, thick = float(rng.uniform(1.75, 3.1)) * d, float(rng.uniform(0.07, 0.4)) * d
    ring: Profile = [(0.53 * d, 0.0), (wide / 2, 0.0), (wide / 2, thick), (0.53 * d, thick)]
    return weld([revolve(ring, sides, closed=True)])


def _spring_washer(d: float, sides: int, rng: np.random.Generator) -> Solid:
    """DIN 127: one turn of a square wire, its ends apart."""
    thick = float(rng.uniform(0.15, 0.3)) * d
    angle = np.linspace(0.06, 2 * np.pi - 0.06, sides)
    rise = float(rng.uniform(0.3, 1.0)) * thick
    path: Floats = np.column_stack([0.75 * d * np.cos(angle), 0.75 * d * np.sin(angle), rise * angle / (2 * np.pi)])
    half = thick / 2
    return sweep(path, np.array([[half, -half], [half, half], [-half, half], [-half, -half]]), up=(0.0, 0.0, 1.0))


def _tab_washer(d: float, sides: int, rng: np.random.Generator) -> Solid:
    """DIN 93/463: a thin washer with one or two tabs."""
    wide, thick = float(rng.uniform(1.8, 2.6)) * d, float(rng.uniform(0.03, 0.08)) * d + 0.0003
    tab, reach = 0.35 * wide, float(rng.uniform(0.8, 1.3)) * wide
    angle = np.linspace(0.5, 2 * np.pi - 0.5, max(sides, 16))
    outline = [(wide / 2 * float(np.cos(a)), wide / 2 * float(np.sin(a))) for a in angle]
    outline += [(reach * 0.9, -tab / 2), (reach, -tab / 4), (reach, tab / 4), (reach * 0.9, tab / 2)]
    solid = extrude(np.array(outline), 0.0, thick, (circle(0.53 * d, sides),))
    if rng.random() < 0.5:
        solid = merge(
            [
                solid,
                moved(
                    extrude(
                        np.array([[0, -tab / 2], [0.5 * wide, -tab / 2], [0.5 * wide, tab / 2], [0, tab / 2]]),
                        0.0,
                        thick,
                    ),
                    at(0, 0.4 * wide, 0) @ spun("z", np.pi / 2),
                ),
            ]
        )
    return solid


_BUILDS: tuple[tuple[str, Callable[[float, int, np.random.Generator], Solid]], ...] = (
    ("bolt", _hex_bolt), ("bolt", _hex_bolt), ("screw", _socket_screw), ("screw", _button_screw),
    ("screw", _countersunk_screw), ("screw", _set_screw), ("stud", _stud), ("nut", _nut), ("nut", _nut),
    ("nut", _round_nut), ("washer", _washer), ("washer", _washer), ("washer", _spring_washer), ("washer", _tab_washer),
)  # fmt: skip
