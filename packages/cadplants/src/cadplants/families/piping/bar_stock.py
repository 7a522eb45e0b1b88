"""Fittings of bar stock, split flanges, insulated joints, elbow unions, hygienic blanks."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.piping.coupling import half_band
from cadplants.families.piping.shape import (
    BOLTED,
    SMALL,
    bend_path,
    bolting,
    drilled,
    family,
    lathe,
    parts_of,
    pipe_x,
    prism,
    tail,
)
from cadplants.family import Build, Family, Model, Part
from cadplants.flange import flange, flange_length, plate_thickness
from cadplants.mesh_ops import Solid, merge, moved, tube
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import rounded_rectangle
from cadplants.primitives import box, cylinder
from cadplants.standards import FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun
from cadplants.valve_body import bore_of

__all__ = ["SPECIALS"]


def _block(name: str, turns: Sequence[float]) -> Build:
    """A builder of tees and crosses cut of square bar, with tube nuts, hexagons or shoulders at their mouths."""

    def build(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
        """A brass or steel block with mouths on its sides (ISO 8434-1, ASME B16.11 bar stock)."""
        r, n = PIPES[dn].radius, style.round(1.3 * PIPES[dn].radius)
        half, kind = float(rng.uniform(1.25, 1.6)) * r + 0.003, int(rng.integers(3))
        out = (1.0 * r + 0.008) if kind < 2 else 0.35 * r + 0.003
        reach = half + out
        bored = 0.98 * r if style.hollow else 0.0
        body = [box((2 * half, 2 * half, 2 * half), (reach, 0, 0))]
        nuts: list[Part] = []
        rest: list[Part] = []
        for turn in (np.pi, 0.0, *turns):
            way = at(reach) @ spun("y", -turn)
            if kind == 0:
                body.append(moved(lathe([(1.08 * r, half - 0.001), (1.08 * r, reach - 0.3 * out)], n, bored), way))
                nut = prism(2.55 * r + 0.006, 6, half + 0.25 * out, reach, bored, n)
                nuts.append(Part(moved(nut, way), "nut", "trim", "", BOLTED))
            elif kind == 1:
                body.append(moved(prism(1.9 * half, 8, half - 0.001, reach, bored, n), way))
            else:
                body.append(moved(lathe([(1.2 * r, half - 0.001), (1.15 * r, reach)], n, bored), way))
            if turn in turns:
                rest += tail(dn, style, rng, way @ at(reach), "oc")
        return Model([Part(merge(body), name, "trim"), *nuts, *rest], round(2 * reach, 9), "welded")

    return build


def _split(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A split flange (ISO 6162): two clamp halves behind a collar, four bolts into a square port block."""
    r, n = PIPES[dn].radius, style.round(1.3 * PIPES[dn].radius)
    lead, thick, bore = float(rng.uniform(0.05, 0.2)), 0.55 * r + 0.012, bore_of(dn, style)
    collar, port = 0.3 * r + 0.005, 0.8 * r + 0.015
    tall, wide, bolt = 1.9 * r + 0.02, 1.5 * r + 0.014, 0.14 * r + 0.006
    face = lead + thick
    head = lathe([(r, 0.0), (r, face - collar), (1.35 * r, face - collar), (1.35 * r, face)], n, bore)
    spots = np.array([[sx * (wide - 1.4 * bolt), sy * (tall - 1.6 * bolt)] for sx in (-1, 1) for sy in (-1, 1)])
    angles = np.linspace(np.pi, 0, 11)
    arch = 1.36 * r * np.column_stack([np.cos(angles), np.sin(angles)])
    rim = np.array(
        [[wide, 0.0], [wide, 0.75 * tall], [0.8 * wide, tall], [-0.8 * wide, tall], [-wide, 0.75 * tall], [-wide, 0.0]]
    )
    outline = np.vstack([rim, arch]) + np.array([0.0, 0.0005])
    half = drilled(outline, lead, face, 0.0, spots[spots[:, 1] > 0], 0.55 * bolt, style, n)
    block = drilled(
        rounded_rectangle(2 * wide, 2 * tall, 0.15 * wide, 2), face, face + port, bore, spots, 0.5 * bolt, style, n
    )
    total = face + port + lead
    parts = [Part(head, "flange", "flange", "flange")]
    parts += [Part(moved(half, spun("x", t)), "flange", "flange", "flange") for t in (0.0, np.pi)]
    parts += [Part(block, "flange", "valve"), Part(pipe_x(dn, face + port, total, style), "pipe", "pipe")]
    for y, z in spots:
        parts += bolting(1, 0.0, bolt, lead, face + port, style, "", at(0, float(y), float(z)))
    return Model(parts, round(total, 9), "welded")


def _insulated(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An insulating joint: a thick gasket, sleeves' ends and pairs of washers under every nut, between two flanges."""
    size, plate, neck = FLANGES[dn], plate_thickness(dn), flange_length(dn, style)
    gap, lead = pick(rng, 0.003, 0.0045, 0.006), float(rng.uniform(0.02, 0.1))
    outer, n = pick(rng, 0.5 * (size.circle - size.bolt) - 0.001, 0.49 * size.raised), style.round(size.circle / 2)
    face, total = lead + neck, 2 * (lead + neck) + gap
    parts = [Part(pipe_x(dn, 0.0, lead, style), "pipe", "pipe")]
    parts += parts_of(flange(dn, style), at(face) @ spun("z", np.pi))
    parts.append(Part(lathe([(outer, face), (outer, face + gap)], n, PIPES[dn].radius), "gasket", "handle"))
    parts += parts_of(flange(dn, style), at(face + gap))
    low, high = face - plate, face + gap + plate
    disc, thin = 1.05 * size.bolt, 0.003
    for k in range(size.n_bolts):
        way = spun("x", (2 * k + 1) * np.pi / size.n_bolts) @ at(0, size.circle / 2)
        pair = [
            lathe([(disc, a), (disc, a + thin)], 12, 0.5 * size.bolt)
            for a in (low - 2 * thin, low - thin, high, high + thin)
        ]
        parts.append(Part(moved(merge(pair), way), "washer", "fastener", "", BOLTED, True))
    parts += bolting(size.n_bolts, size.circle / 2, size.bolt, low - 2 * thin, high + 2 * thin, style)
    parts.append(Part(pipe_x(dn, total - lead, total, style), "pipe", "pipe"))
    return Model(parts, round(total, 9), "welded")


def _elbow_union(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A union elbow on a pipe's end (EN 10242 UA1): a banded or hexagon mouth, a bend, a big nut, a tail."""
    r, n = PIPES[dn].radius, style.round(1.3 * PIPES[dn].radius)
    turn, body, deep = pick(rng, 0.5, 0.5, 0.25) * np.pi, 1.15 * r + 0.0015, 0.8 * r + 0.011
    path, reach = bend_path(float(rng.uniform(1.25, 1.7)) * body, turn, style.bend(2.5 * body, turn), 0.5 * deep)
    start = 0.5 * deep
    end = prism(2.4 * r + 0.006, int(rng.choice([6, 8])), 0.0, deep, 0.98 * r if style.hollow else 0.0, n)
    far = at(start + reach) @ spun("z", turn) @ at(reach)
    nut, out = 0.8 * r + 0.01, 0.5 * r + 0.008
    seat = lathe([(1.3 * r, -0.3 * nut), (1.3 * r, 0.35 * nut)], n)
    elbow_ = merge([end, moved(tube(path, body, 0.0, n), at(start)), moved(seat, far)])
    ring_ = prism(3.2 * r + 0.01, int(rng.choice([6, 8])), 0.0, nut, 1.1 * r, n)
    piece = lathe(
        [(1.25 * r, 0.35 * nut), (1.25 * r, nut), (1.08 * r, nut + 0.1 * r), (1.08 * r, nut + out)],
        n,
        bore_of(dn, style),
    )
    parts = [
        Part(elbow_, "elbow", "trim"),
        Part(moved(ring_, far), "union", "trim"),
        Part(moved(piece, far), "union", "trim"),
    ]
    parts += tail(dn, style, rng, far @ at(nut + out), "ooc")
    roll = spun("x", pick(rng, 0.0, 0.5, 1.0, 1.5) * np.pi)
    return Model([Part(moved(p.solid, roll), p.name, p.color, p.bundle, p.group, p.fine) for p in parts])


def _clamped_blank(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A hygienic blank (ISO 2852): a ferrule on the pipe, a seal, a disc, a clamp of two halves with a wing nut."""
    r, n = PIPES[dn].radius, style.round(1.4 * PIPES[dn].radius)
    long, rim = float(rng.uniform(0.5, 1.0)) * r + 0.012, 1.18 * r + 0.009
    ferrule = lathe([(r, 0.0), (r, long - 0.006), (rim, long - 0.003), (rim, long)], n, bore_of(dn, style))
    seal = lathe([(rim, long), (rim, long + 0.002)], n, 0.9 * r)
    blank = lathe([(rim, long + 0.002), (rim, long + 0.005), (1.05 * r, long + 0.008)], n)
    wide, outer = 0.016 + 0.06 * r, rim + 0.005 + 0.04 * r
    mid = long + 0.001
    half = half_band(rim, outer, mid - 0.5 * wide, mid + 0.5 * wide, n)
    lug = box((wide, 0.35 * r + 0.008, 0.012), (mid, outer + 0.12 * r, 0.008))
    halves: list[Solid] = [
        merge([half, lug]),
        merge([moved(half, spun("x", np.pi)), moved(lug, np.diag([1.0, 1.0, -1.0, 1.0]))]),
    ]
    wing = merge(
        [cylinder(0.003, -0.022, 0.03, 8), cylinder(0.008, 0.014, 0.026, 10), box((0.045, 0.005, 0.016), (0, 0, 0.03))]
    )
    parts = [Part(ferrule, "coupling", "trim"), Part(seal, "gasket", "gasket"), Part(blank, "pipe cap", "trim")]
    parts += [Part(s, "clamp", "clamp", "clamp", BOLTED) for s in halves]
    parts.append(Part(moved(wing, at(mid, outer + 0.15 * r)), "nut", "fastener", "clamp", BOLTED, True))
    roll = spun("x", float(rng.uniform(0, 6)))
    return Model([Part(moved(p.solid, roll), p.name, p.color, p.bundle, p.group, p.fine) for p in parts])


_UP = np.pi / 2

SPECIALS: tuple[Family, ...] = (
    family("tee/bar stock", _block("tee", (_UP,)), SMALL),
    family("cross/bar stock", _block("cross", (_UP, -_UP)), SMALL),
    family("flange/split", _split, tuple(dn for dn in SIZES if dn <= 100)),
    family("gasket/insulating", _insulated),
    family("union/elbow", _elbow_union, SMALL, "end", 1.0),
    family("pipe cap/hygienic", _clamped_blank, tuple(dn for dn in SIZES if dn <= 100), "end"),
)
