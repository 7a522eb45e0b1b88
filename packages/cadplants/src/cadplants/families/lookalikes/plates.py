"""Round and square plates: under posts, on necks, as lids and between pipes."""

from __future__ import annotations

from functools import partial

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import chance, num, pick
from cadplants.families.primitive.shape import FRAME, disc, family, lying, part, vessel
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import box, cylinder, hexagon, ring
from cadplants.standards import FLANGES, PIPES
from cadplants.transforms import at, spun

__all__ = ["PLATES_ALIKE"]

_PIPE, _HELD = "Pipe assembly", "Connection assembly"
_LEAST_DRILLED = 12  # sides; the holes of a coarser plate would cut its rim


def _ring_of_holes(size: float, inner: float, round_: bool) -> tuple[float, float]:
    """How far out the holes of a plate sit, and their radius [m]."""
    if not round_:
        return 1.05 * size, 0.08 * size
    least = max(inner, 0.6 * size)
    return (size + least) / 2, min(0.08 * size, 0.22 * (size - least))


def _plate(
    size: float, thick: float, round_: bool, count: int, style: ModelingStyle, inner: float = 0.0, bored: bool = False
) -> Solid:
    """A plate about z from 0 up, with holes in a ring and one in its middle where the style drills [m].

    Args:
        size: its radius, or half its side [m].
        thick: how thick it is [m].
        round_: whether it is round.
        count: of holes; a square plate has four.
        style: that models it.
        inner: radius of the pipe at its back; the holes lie outside that [m].
        bored: whether it has a hole of that radius where the style models bores.
    """
    n = style.round(size)
    outline = circle(size, n) if round_ else rounded_rectangle(2 * size, 2 * size, 0.0)
    holes: list[Floats] = [circle(inner, n)] if bored and style.hollow else []
    if style.holes and n >= _LEAST_DRILLED:
        number = count if round_ else 4
        far, radius = _ring_of_holes(size, inner, round_)
        turns = (np.arange(number) + 0.5) * 2 * np.pi / number
        holes += [circle(radius, 8, (far * float(np.cos(turn)), far * float(np.sin(turn)))) for turn in turns]
    return extrude(outline, 0.0, thick, tuple(holes))


def _bolted(
    size: float, count: int, low: float, high: float, round_: bool, style: ModelingStyle, inner: float = 0.0
) -> list[Part]:
    """Bolts in a ring through a plate about z [m]."""
    if style.fasteners in ("none", "flange"):
        return []
    number = count if round_ else 4
    far, radius = _ring_of_holes(size, inner, round_)
    d, bolts = 0.85 * radius, []
    for k in range(number):
        pose = spun("z", (k + 0.5) * 2 * np.pi / number) @ at(far)
        bolts.append(moved(merge([cylinder(d, low, high, 8), hexagon(3.4 * d, high - 1.6 * d, high)]), pose))
    return [Part(one, "bolt", "fastener", "", _HELD, True) for one in bolts]


def _based(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A round or square post on a plate like a flange, drilled or plain, with or without anchors and ribs."""
    r, high = num(rng, 0.02, 0.08), num(rng, 0.3, 3.0)
    round_, count, thick = chance(rng, 0.5), pick(rng, 4, 4, 6, 8), num(rng, 0.008, 0.025)
    size = r * num(rng, 1.7, 2.6)
    plate = _plate(size, thick, round_, count, style)
    bore = 0.88 * r if style.hollow else 0.0
    post = moved(ring(bore, r, 0.0, high, style.round(r)), at(0, 0, thick))
    parts = [part("base plate", plate, color="steel"), part("post", post, color="steel")]
    if chance(rng, 0.4):
        top = moved(_plate(size, thick, round_, count, style), at(0, 0, thick + high))
        parts.append(part("plate", top, color="steel"))
    parts += _bolted(size, count, -0.05, thick + 0.02, round_, style)
    return Model(parts)


def _lidded(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An upright piece of pipe with a flange or a blind flange on top and one below: like a post on its plates."""
    dn = pick(rng, 40, 50, 80, 100, 150)
    size, r, high = FLANGES[dn], PIPES[dn].radius, num(rng, 0.3, 2.0)
    bore = PIPES[dn].bore if style.hollow else 0.0
    rim, thick = size.outer / 2, size.thickness
    low = _plate(rim, thick, True, size.n_bolts, style, PIPES[dn].bore, True)
    tube = moved(ring(bore, r, 0.0, high, style.round(r)), at(0, 0, thick))
    parts = [part("pipe", tube, color="pipe"), part("flange", low, color="flange")]
    parts.append(part("flange", moved(low, at(0, 0, thick + high)), color="flange"))
    top = 2 * thick + high
    gap = pick(rng, 0.0, 0.002, 0.004)
    if chance(rng, 0.7):
        lid = moved(_plate(rim, thick, True, size.n_bolts, style, PIPES[dn].bore), at(0, 0, top + gap))
        parts.append(part("blind flange", lid, color="flange"))
        parts += _bolted(rim, size.n_bolts, top - 1.8 * thick, top + gap + 1.8 * thick, True, style, PIPES[dn].bore)
    return Model(parts)


def _manway(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A vessel or a wide pipe's end with a manway: a wide short neck, its flange and its lid, bolted or not."""
    radius, rise = num(rng, 0.2, 0.32), num(rng, 0.1, 0.3)
    thick, rim = num(rng, 0.015, 0.03), radius * num(rng, 1.2, 1.35)
    wide = radius * num(rng, 1.6, 3.0)
    body = moved(vessel(wide, -wide, wide, 0.5 * wide, style), at(0, 0, 1.6 * wide))
    neck = ring(0.94 * radius if style.hollow else 0.0, radius, -0.3 * wide, rise, style.round(radius))
    plate = moved(_plate(rim, thick, True, 12, style, 0.94 * radius, True), at(0, 0, rise - thick))
    gap = pick(rng, 0.0, 0.002, 0.004)
    lid = moved(_plate(rim, thick, True, 12, style, 0.94 * radius), at(0, 0, rise + gap))
    more = []
    if chance(rng, 0.5):
        more += [box((0.2, 0.015, 0.05), (0, 0, rise + gap + thick + 0.02))]
    if chance(rng, 0.4):
        more += [
            moved(cylinder(0.015, rise - 0.2, rise + 0.25, 8), at(1.15 * rim)),
            box((1.2 * rim, 0.02, 0.02), (0.6 * rim, 0, rise + 0.24)),
        ]
    side = chance(rng, 0.6)
    pose = at(wide * 0.98, 0, 1.6 * wide) @ spun("y", np.pi / 2) if side else at(0, 0, 3.05 * wide)
    pieces = [[neck, plate], [lid, *more]] if chance(rng, 0.6) else [[neck, plate, lid, *more]]
    parts = [part("shell", body, color="tank", bundle="shell")]
    parts += [part("manway", *(moved(one, pose) for one in some), color="tank", bundle="manway") for some in pieces]
    bolts = _bolted(rim, 12, rise - 2 * thick, rise + gap + 2 * thick, True, style, 0.94 * radius)
    parts += [Part(moved(b.solid, pose), b.name, b.color, b.bundle, b.group, b.fine) for b in bolts]
    legs = [box((0.1, 0.1, 1.2 * wide), (x * wide, y * wide, 0.6 * wide)) for x in (-0.55, 0.55) for y in (-0.55, 0.55)]
    return Model([*parts, *(part("tank leg", one, color="steel", bundle="tank leg") for one in legs)], kind="tank")


def _disc_end(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A plate welded to the end of a pipe: a flange with a bore, or a lid, or a base plate of a dummy leg."""
    size, n = FLANGES[dn], FLANGES[dn].n_bolts
    bore = PIPES[dn].bore
    flange = lying(_plate(size.outer / 2, size.thickness, True, n, style, bore, True))
    parts = [part("flange", flange, color="flange", bundle="flange")]
    gap = pick(rng, 0.0, 0.002, 0.004)
    if chance(rng, 0.5):
        lid = lying(_plate(size.outer / 2, size.thickness, True, n, style, bore), size.thickness + gap)
        parts.append(part("blind flange", lid, color="flange", bundle="blind flange"))
    return Model(parts)


def _shoe_plate(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A dummy leg: a piece of pipe welded under a line, on a round or square plate."""
    r = PIPES[dn].radius
    leg, thick, round_ = r * num(rng, 0.5, 0.9), num(rng, 0.008, 0.02), chance(rng, 0.4)
    size = leg * num(rng, 1.6, 2.4)
    tube = disc(leg, -height + thick, -0.8 * r, style)
    plate = moved(_plate(size, thick, round_, 4, style), at(0, 0, -height))
    parts = [part("bracket", tube, color="pipe"), part("base plate", plate, color="steel", group=FRAME)]
    bolts = _bolted(size, 4, -0.04, thick + 0.02, round_, style)
    parts += [Part(moved(b.solid, at(0, 0, -height)), b.name, b.color, b.bundle, "", b.fine) for b in bolts]
    return Model(parts)


PLATES_ALIKE: tuple[Family, ...] = (
    family("post/plate like a flange", "floor", FRAME, _based, "post", (15,), 1.5, "fitting"),
    family("pipe/upright between flanges", "floor", _PIPE, _lidded, "pipe", (15,), 1.0, "fitting"),
    family("manway/neck and lid", "floor", "Tank", _manway, "tank", (15,), 1.2),
    family("flange/plate on end", "end", _PIPE, partial(_disc_end), "flange", weight=1.5, grain="fitting"),
    family("bracket/pipe on plate", "carrier", _HELD, _shoe_plate, weight=1.0, grain="fitting"),
)
