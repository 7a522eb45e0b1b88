"""Fasteners of unusual kinds in use: anchors, T-bolts, eyes and shackles, nuts, screws, washers, swing bolts, studs."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import made
from cadplants.builder.params import Params, among, between, chance, each, given, several, styled, whole
from cadplants.builder.table import Table, outline
from cadplants.families.supports.shape import Fitting, eye, few, shuffled, upright
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import circle, rounded_rectangle, section_channel, section_i
from cadplants.solids.primitives import around, bar, box, cylinder, dome, hexagon, ring, rope, turned
from cadplants.solids.transforms import arc, at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["FASTENERS", "add_piece", "head_solid", "nut_solid"]

_D = (0.008, 0.01, 0.012, 0.016, 0.02, 0.024, 0.03)  # m, ISO 261 coarse threads


def add_piece(t: Table, name: str, *solids: Solid) -> None:
    """A fastener that is there whatever a style does with small ones."""
    t.add(name, *solids, fine=False)


def _shank(d: float, low: float, high: float, style: ModelingStyle, ridged: bool) -> Solid:
    """A plain shank, or one with ridges for a thread on its lower part."""
    n = few(d / 2, style)
    if not ridged or high - low < 1.2 * d:
        return cylinder(d / 2, low, high, n)
    pitch, end = 0.16 * d, low + 0.7 * (high - low)
    count = int(np.clip((end - low) / pitch, 3, 18))
    step = (end - low) / count
    profile = [p for k in range(count) for p in ((0.43 * d, low + k * step), (0.5 * d, low + (k + 0.5) * step))]
    return turned([*profile, (0.43 * d, end), (0.5 * d, end), (0.5 * d, high)], n)


def _wings(d: float, low: float, span: float, high: float) -> Solid:
    """Two thin ears of a wing nut or screw, standing in the plane y = 0 [m]."""
    half = [[0.45 * d, low], [0.6 * span, low + 0.25 * (high - low)], [span, low + 0.7 * (high - low)]]
    half += [[0.95 * span, high], [0.7 * span, high], [0.45 * d, low + 0.55 * (high - low)]]
    return merge([upright([[s * x, z] for x, z in half], -0.11 * d, 0.11 * d) for s in (-1, 1)])


def nut_solid(kind: str, d: float, style: ModelingStyle) -> Solid:
    """A nut on z = 0 with its thread about z [m]; proportions of ISO 4032, DIN 1587, 315, 557, 935, 6334, 466."""
    n, bore = few(d / 2, style), d / 2
    if kind == "square":
        return extrude(rounded_rectangle(1.6 * d, 1.6 * d, 0), 0, 0.75 * d, (circle(bore, n),))
    if kind == "cap":
        return merge([hexagon(1.6 * d, 0, 0.7 * d), dome(0.72 * d, 0.8 * d, 0.68 * d, max(8, n))])
    if kind == "wing":
        return merge([turned([(0.8 * d, 0), (0.62 * d, 0.9 * d)], max(8, n)), _wings(d, 0.05 * d, 2.0 * d, 2.0 * d)])
    if kind == "castle":
        tooth = box((0.3 * d, 0.5 * d, 0.4 * d), (0.62 * d, 0, 1.0 * d))
        return merge([hexagon(1.6 * d, 0, 0.8 * d, bore, n), around(tooth, 6)])
    if kind == "lock":
        return merge([hexagon(1.6 * d, 0, 0.8 * d, bore, n), ring(0.5 * d, 0.72 * d, 0.8 * d, 1.1 * d, max(8, n))])
    if kind == "jam":
        return merge([hexagon(1.6 * d, 0, 0.5 * d, bore, n), hexagon(1.6 * d, 0.52 * d, 1.02 * d, bore, n)])
    if kind == "flange":
        skirt = turned([(1.15 * d, 0), (1.1 * d, 0.12 * d), (0.75 * d, 0.3 * d)], max(8, n))
        return merge([skirt, hexagon(1.5 * d, 0.2 * d, 0.95 * d)])
    if kind == "coupling":
        return hexagon(1.5 * d, 0, 3.0 * d, bore, n)
    if kind == "knurled":
        return merge([extrude(circle(1.3 * d, 20), 0.45 * d, 1.1 * d), cylinder(0.75 * d, 0, 0.5 * d, max(8, n))])
    if kind == "eye":
        loop = moved(eye(1.1 * d, 0.35 * d, style), at(0, 0, 1.9 * d))
        return merge([turned([(1.0 * d, 0), (0.9 * d, 0.5 * d), (0.6 * d, 0.9 * d)], max(8, n)), loop])
    if kind == "star":
        lobes = around(cylinder(0.55 * d, 0.5 * d, 1.4 * d, 8), 5, 1.1 * d)
        return merge([cylinder(1.2 * d, 0.45 * d, 1.45 * d, max(10, n)), lobes, cylinder(0.7 * d, 0, 0.5 * d, 8)])
    return hexagon(1.6 * d, 0, 0.85 * d, bore, n)


_NUTS = ("hex", "square", "cap", "wing", "castle", "lock", "jam", "flange", "coupling", "knurled", "eye", "star")


def head_solid(kind: str, d: float, style: ModelingStyle) -> Solid:
    """A head on z = 0 over its shank [m] (ISO 4014, 4762, 7380, 10642, EN 1665, DIN 603, 261, 464, 444)."""
    n = max(8, few(d / 2, style))
    if kind == "square":
        return box((1.5 * d, 1.5 * d, 0.7 * d), (0, 0, 0.35 * d))
    if kind == "carriage":
        return merge([dome(1.15 * d, 0.55 * d, 0, n), box((d, d, 0.5 * d), (0, 0, -0.25 * d))])
    if kind == "socket":
        return merge(
            [cylinder(0.75 * d, 0, 0.5 * d, n), extrude(circle(0.75 * d, n), 0.5 * d, d, (circle(0.45 * d, 6),))]
        )
    if kind == "button":
        return turned([(0.9 * d, 0), (0.85 * d, 0.2 * d), (0.6 * d, 0.45 * d), (0.3 * d, 0.52 * d)], n)
    if kind == "flat":
        return turned([(0.5 * d, -0.5 * d), (1.0 * d, 0.0), (1.0 * d, 0.03 * d)], n)
    if kind == "pan":
        slot = 0.14 * d
        caps = [turned([(0.9 * d, 0), (0.9 * d, 0.35 * d), (0.7 * d, 0.5 * d)], n)]
        return merge(
            [*caps, box((1.2 * d, slot, 0.04 * d), (0, 0, 0.51 * d)), box((slot, 1.2 * d, 0.04 * d), (0, 0, 0.512 * d))]
        )
    if kind == "flange":
        return merge(
            [turned([(1.15 * d, 0), (1.1 * d, 0.12 * d), (0.75 * d, 0.3 * d)], n), hexagon(1.5 * d, 0.2 * d, 0.9 * d)]
        )
    if kind == "washer hex":
        return merge([cylinder(1.0 * d, 0, 0.12 * d, n), hexagon(1.4 * d, 0.1 * d, 0.75 * d)])
    if kind == "wing":
        return merge([turned([(0.8 * d, 0), (0.62 * d, 0.9 * d)], n), _wings(d, 0.05 * d, 2.0 * d, 2.0 * d)])
    if kind == "thumb":
        return merge([cylinder(0.75 * d, 0, 0.5 * d, n), extrude(circle(1.25 * d, 20), 0.45 * d, 0.95 * d)])
    if kind == "tee":
        return box((3.0 * d, 1.1 * d, 0.7 * d), (0, 0, 0.35 * d))
    if kind == "eye":
        return merge([cylinder(0.9 * d, 0, 0.25 * d, n), moved(eye(1.0 * d, 0.35 * d, style), at(0, 0, 1.45 * d))])
    if kind == "ring":
        hole = circle(0.5 * d, n, (0, 1.0 * d))
        plate = upright(circle(1.0 * d, 2 * n, (0, 1.0 * d)), -0.45 * d, 0.45 * d, (hole,))
        return plate
    return hexagon(1.6 * d, 0, 0.65 * d)


_BOLTS = ("hex", "square", "carriage", "flange", "tee", "eye", "ring")
_SCREWS = ("socket", "button", "flat", "pan", "washer hex", "wing", "thumb")
_ABOUT_SIZE = "diameter of the threads"


class _Threaded(Params):
    """A piece with a thread, which has ridges where the style models fasteners piece by piece."""

    pieces: bool = given(False, "fasteners are modelled piece by piece")


def _ridged() -> bool:
    """A field: whether a thread has ridges."""
    return chance(0.5, "the thread has ridges", when=lambda p: p.pieces)


def _pieces(p: Any) -> dict[str, Any]:
    return {"pieces": p.fasteners == "pieces"}


class _Fasteners(Fitting, weight=0.8):
    """Fasteners that hold something."""

    fasteners: str = styled("bolt", "how fine fasteners are")


class _NutOn(_Threaded):
    """A nut on a stud."""

    turn: float = between(0, 6, "which way the nut is turned", "rad")
    washer: bool = chance(0.6, "a washer under it")
    wide: float = between(1.0, 1.6, "radius of the washer / diameter of the stud", when=lambda p: p.washer)
    over: float = between(1.2, 3.5, "height of the stud over the plate / diameter, less in closed nuts")
    ridged: bool = _ridged()


class Nuts(_Fasteners, name="nut/kinds", label="nut"):
    """Studs through a plate, a flat bar or a cover with all kinds of nuts on them, with washers or without."""

    size: float = among(_D, _ABOUT_SIZE, "m")
    kinds: tuple[str, ...] = shuffled(_NUTS, "nuts; the first are there")
    count: int = whole(4, 8, "nuts that are there")
    thick: float = between(0.5, 1.5, "of the plate / diameter")
    ranks: int = whole(1, 2, "rows of nuts")
    raised: bool = chance(0.5, "the plate is on feet")
    nuts: tuple[_NutOn, ...] = several(made(_NutOn, _pieces), lambda p: p.count, "nuts")

    def build(self, t: Table) -> Model:
        d, rows = self.size, self.ranks
        pitch, thick, up = 4.6 * d, self.thick * d, 1.5 * d if self.raised else 0.0
        columns = (self.count + rows - 1) // rows
        for k, (kind, nut) in enumerate(zip(self.kinds, self.nuts, strict=False)):
            spot = t.at((k % columns) * pitch, (k // columns) * pitch, thick + up).spun("z", nut.turn)
            flat = 0.16 * d if nut.washer else 0.0
            add_piece(spot.at(0, 0, flat), "nut", nut_solid(kind, d, t.style))
            if flat:
                add_piece(spot, "washer", ring(0.54 * d, d * nut.wide, 0, flat, max(8, few(d, t.style))))
            over = d * nut.over * {"coupling": 0.8, "cap": 0.25, "eye": 0.2}.get(kind, 1.0)
            add_piece(spot, "stud", _shank(d, -thick - (0.9 * up), flat + over, t.style, nut.ridged))
        wide, deep, x, y = columns * pitch, rows * pitch, (columns - 1) * pitch / 2, (rows - 1) * pitch / 2
        t.add("plate", box((wide, deep, thick), (x, y, up + thick / 2)))
        if up:
            t.add("plate", *(box((d, deep, up), (x + s * 0.45 * wide, y, up / 2)) for s in (-1, 1)))
        return t.model()


class _Screw(_Threaded):
    """A screw or bolt in two plates."""

    bolt: bool = given(False, "a bolt, not a screw")
    lying: bool = chance(0.25, "lies by")
    out: float = among((0.0, 0.0, 1.2), "how far it stands out / diameter", when=lambda p: not p.lying, otherwise=0.0)
    grip: float = between(2.2, 4.0, "length of its shank / diameter")
    ridged: bool = _ridged()
    turn: float = between(0, 6, "which way its head is turned", "rad", when=lambda p: not p.lying)
    nutted: bool = chance(0.4, "a nut below", when=lambda p: p.bolt and not p.lying and not p.out)
    nut: str = among(("hex", "square", "lock", "flange"), "the nut", when=lambda p: p.nutted)


def _screw_of(rng: np.random.Generator, p: Any, so_far: tuple[_Screw, ...]) -> _Screw:
    return _Screw.draw(rng, {**_pieces(p), "bolt": p.kinds[len(so_far)] in _BOLTS})


class Screws(_Fasteners, name="screw/kinds", label="screw"):
    """Screws and bolts with all kinds of heads in two plates that they join, some half screwed in, some lying by."""

    size: float = among(_D, _ABOUT_SIZE, "m")
    kinds: tuple[str, ...] = shuffled((*_SCREWS, *_BOLTS), "heads; the first are there")
    count: int = whole(5, 9, "heads that are there")
    thick: float = between(0.4, 1.2, "of a plate / diameter")
    screws: tuple[_Screw, ...] = each(_screw_of, lambda p: p.count, "screws and bolts")

    def build(self, t: Table) -> Model:
        d, low, n = self.size, 4.2 * self.size, self.count
        pitch, thick = 4.0 * d, self.thick * d
        for k, (kind, screw) in enumerate(zip(self.kinds, self.screws, strict=False)):
            name, shank = "bolt" if screw.bolt else "screw", _shank(d, -screw.grip * d, 0.0, t.style, screw.ridged)
            solid = merge([head_solid(kind, d, t.style), shank])
            if screw.lying:  # on the floor before the plates
                reach = max(1.5 * d, float(-solid.vertices[:, 0].min()))
                lying = moved(solid, at(k * pitch, -4.2 * d, reach) @ spun("x", 0.5 * np.pi))
                add_piece(t.at(0, 0, -float(lying.vertices[:, 2].min())), name, lying)
                continue
            add_piece(t.at(k * pitch, 0, low + 2 * thick + screw.out * d).spun("z", screw.turn), name, solid)
            if screw.nut:
                add_piece(t.at(k * pitch, 0, low).spun("x", np.pi), "nut", nut_solid(screw.nut, d, t.style))
        for z in (low, low + thick):
            t.add("plate", box((n * pitch, 3.4 * d, thick), ((n - 1) * pitch / 2, 0, z + thick / 2)))
        xs = (-0.5 * pitch + d, (n - 0.5) * pitch - d)
        t.add("plate", *(box((2 * d, 3.0 * d, low), (x, 0, low / 2)) for x in xs))
        return t.model()


_WASHERS = ("flat", "wide", "square", "taper", "spring", "tooth", "cup", "pack")


def _washer(kind: str, d: float, n: int) -> tuple[list[Solid], float]:
    """A washer on z = 0, of several pieces where it is a pack, and how high it is [m]."""
    w, hole = 0.2 * d, circle(0.54 * d, n)
    if kind in ("flat", "wide"):
        return [ring(0.54 * d, d if kind == "flat" else 1.5 * d, 0, w, n)], w
    if kind == "square":
        return [extrude(rounded_rectangle(2.6 * d, 2.6 * d, 0), 0, 0.3 * d, (hole,))], 0.3 * d
    if kind == "taper":
        plate = extrude(rounded_rectangle(2.2 * d, 2.2 * d, 0), 0, 0.32 * d, (hole,))
        lean = plate.vertices.copy()
        lean[:, 2] *= 1 - 0.2 * lean[:, 0] / d
        return [Solid(lean, plate.faces)], 0.32 * d
    if kind == "spring":
        turn, rise = np.linspace(0.1, 2 * np.pi - 0.1, 16), np.linspace(0.15 * d, 0.3 * d, 16)
        return [rope(np.column_stack([0.72 * d * np.cos(turn), 0.72 * d * np.sin(turn), rise]), 0.15 * d, 6)], 0.42 * d
    if kind == "tooth":
        tooth = box((0.35 * d, 0.2 * d, w), (1.05 * d, 0, w / 2))
        return [merge([ring(0.54 * d, 0.95 * d, 0, w, n), around(tooth, 10)])], w
    if kind == "cup":
        return [turned(outline(1.5 * d, 0, 1.4 * d, 0.15 * d, 0.8 * d, 0.45 * d), n)], 0.45 * d
    return [ring(0.54 * d, d * (1 + 0.25 * (k % 2)), k * w, (k + 1) * w, n) for k in range(4)], 4 * w


class _Washered(_Threaded):
    """A bolt over a washer."""

    head: str = among(("hex", "hex", "square", "flange", "socket"), "its head")
    ridged: bool = _ridged()
    nut: str = among(("hex", "square", "lock", "jam"), "its nut")


class Washers(_Fasteners, name="washer/kinds", label="washer"):
    """Bolts in the flange of a beam or channel over washers: flat, square, tapered, spring, toothed, cup, stacks."""

    size: float = among(_D[:5], _ABOUT_SIZE, "m")
    high: float = between(7, 12, "height of the beam / diameter")
    kinds: tuple[str, ...] = shuffled(_WASHERS, "washers; the first are there")
    count: int = whole(4, 7, "washers that are there")
    bolts: tuple[_Washered, ...] = several(made(_Washered, _pieces), lambda p: p.count, "bolts")
    channel: bool = chance(0.6, "in a channel, not in an I beam")

    def build(self, t: Table) -> Model:
        d, h = self.size, self.high * self.size
        n, thick, w, pitch, web = max(10, few(d, t.style)), 0.8 * d, 0.2 * d, 4.2 * d, 0.6 * d
        for k, (kind, bolt) in enumerate(zip(self.kinds, self.bolts, strict=False)):
            spot = t.at(k * pitch, -1.6 * d, h)
            washers, high = _washer(kind, d, n)
            for washer in washers:
                add_piece(spot, "washer", washer)
            shank = _shank(d, -thick - 2.2 * d, high, t.style, bolt.ridged)
            head = moved(head_solid(bolt.head, d, t.style), at(0, 0, high))
            add_piece(spot, "screw" if bolt.head == "socket" else "bolt", shank, head)
            add_piece(spot.at(0, 0, -thick - w).spun("x", np.pi), "nut", nut_solid(bolt.nut, d, t.style))
            add_piece(spot, "washer", ring(0.54 * d, d, -thick - w, -thick, n))
        ends = (-3 * d, 0, h / 2), (self.count * pitch, 0, h / 2)
        if self.channel:
            beam = bar(*ends, section_channel(h, 4.2 * d, web, thick))
            t.at(0, -float(beam.vertices[:, 1].min()) - 3.9 * d).add("beam", beam)
        else:
            t.add("beam", bar(*ends, section_i(h, 7 * d, web, thick)))
        return t.model()


class _Anchor(_Threaded):
    """An anchor."""

    form: str = among(("L", "J", "plate", "sleeve", "head"), "what holds it in the concrete")
    ridged: bool = chance(0.5, "the thread has ridges", when=lambda p: p.form == "sleeve" and p.pieces)
    square: bool = chance(0.4, "its washer is square")
    nut: str = among(("hex", "hex", "square", "jam", "cap"), "its nut")
    turn: float = among((0.5, 1.0, 1.5), "which way it is turned / half a turn")

    def build(self, t: Table, d: float, deep: float, out: float) -> None:
        """Puts it down about z, ``deep`` below the face of the concrete and ``out`` above it [m]."""
        n, bend, top, style = few(d / 2, t.style), 2 * d, deep + out, t.style
        if self.form in ("L", "J"):
            tail = [[2.5 * d + bend, 0, 0]]
            if self.form == "J":
                tail = [[2 * bend, 0, 0], [2.7 * bend, 0, 0.4 * bend], [2.9 * bend, 0, 1.8 * bend]]
            path = np.vstack([[[0, 0, top]], arc((0, 0, bend), (0, 0, 0), (bend, 0, 0), 4), tail])
            add_piece(t, "bolt", rope(path, d / 2, n))
        elif self.form == "plate":
            add_piece(t, "bolt", cylinder(d / 2, 0, top, n))
            t.add("plate", box((4 * d, 4 * d, 0.5 * d), (0, 0, 0.25 * d)))
            add_piece(t.at(0, 0, 0.5 * d), "nut", nut_solid("hex", d, style))
        elif self.form == "sleeve":
            add_piece(t, "stud", _shank(d, 0.3 * deep, top, style, self.ridged))
            add_piece(t, "washer", ring(0.5 * d, 0.75 * d, 0.45 * deep, deep + 0.01 * d, n))
        else:
            add_piece(t, "bolt", hexagon(1.6 * d, 0, 0.65 * d), cylinder(d / 2, 0.6 * d, top, n))
        washer = ring(0.54 * d, 1.1 * d, deep, deep + 0.4 * d, n)
        if self.square:
            washer = box((2.6 * d, 2.6 * d, 0.4 * d), (0, 0, deep + 0.2 * d))
        add_piece(t, "washer", washer)
        add_piece(t.at(0, 0, deep + 0.4 * d), "nut", nut_solid(self.nut, d, style))


class Anchors(_Fasteners, name="bolt/anchor", label="bolt"):
    """Anchors in concrete: J, L, plate and U anchors, sleeve and chemical ones, with their nuts; some not yet cast."""

    size: float = among(_D[1:], _ABOUT_SIZE, "m")
    count: int = whole(3, 5, "anchors")
    deep: float = between(10, 16, "length of an anchor in the concrete / diameter")
    out: float = between(4, 7, "length of an anchor outside / diameter")
    cast: bool = chance(0.55, "cast in, not in a template")
    anchors: tuple[_Anchor, ...] = several(made(_Anchor, _pieces), lambda p: p.count, "anchors")

    def build(self, t: Table) -> Model:
        d, deep, loose = self.size, self.deep * self.size, replace(t, parts=[])
        pitch, top = 9 * d, deep + 3 * d
        for k, anchor in enumerate(self.anchors):
            spot = loose.at(k * pitch, 0, 3 * d if self.cast else 0.0).spun("z", anchor.turn * np.pi)
            anchor.build(spot, d, deep, self.out * d)
        length = (self.count - 1) * pitch
        if self.cast:
            loose.add("foundation", box((length + 14 * d, 14 * d, top), (length / 2, 0, top / 2)))
        else:  # a setting template keeps them upright before they are cast in
            tall = deep - 0.5 * d
            loose.add("plate", box((length + 6 * d, 4 * d, 0.5 * d), (length / 2, 0, deep - 0.25 * d)))
            loose.add("plate", *(box((d, 4 * d, tall), (x, 0, tall / 2)) for x in (-2.4 * d, length + 2.4 * d)))
        # A bar bent at the foot lies on the floor with its skin, not with its axis.
        lowest = min(float(p.solid.vertices[:, 2].min()) for p in loose.parts)
        t.at(0, 0, max(0.0, -lowest)).extend(loose.parts)
        return t.model()


FASTENERS = families_of(Nuts, Screws, Washers, Anchors)
