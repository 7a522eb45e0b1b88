"""Fittings of bar stock, split flanges, insulated joints, elbow unions, hygienic blanks."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, several
from cadplants.builder.table import Table, outline
from cadplants.families.piping.coupling import ferrule, hygienic_clamp
from cadplants.families.piping.shape import (
    BACK,
    QUARTERS,
    ROLL,
    SMALL,
    Fitting,
    Tail,
    barrel,
    bend_path,
    bolting,
    drilled,
    lathe,
    parts_of,
    pipe_x,
    prism,
    sized,
    tail_of,
    tails,
)
from cadplants.model.family import Model
from cadplants.model.standards import sizes_between
from cadplants.parts.flange import flange, flange_length, plate_thickness
from cadplants.solids.mesh_ops import merge, moved, tube
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import box
from cadplants.solids.transforms import at, spun

__all__ = ["SPECIALS"]


_GOES_ON = "what goes on from its branches"


class TeeBlock(Fitting, name="tee/bar stock", sizes=SMALL):
    """A brass or steel block with mouths on its sides (ISO 8434-1, ASME B16.11 bar stock)."""

    turns: ClassVar[tuple[float, ...]] = (np.pi / 2,)  # where its branches point, from +x

    half: float = between(1.25, 1.6, "half its width, less 3 mm / radius of the pipe")
    mouths: str = among(("nuts", "octagons", "shoulders"), "what its mouths have")
    ends: tuple[Tail, ...] = several(tails("open", "cap"), 1, _GOES_ON)

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.3)
        half, made = self.half * r + 0.003, self.mouths
        out = 0.35 * r + 0.003 if made == "shoulders" else 1.0 * r + 0.008
        reach, bored = half + out, 0.98 * r if t.style.hollow else 0.0
        mouth = {
            "nuts": lambda: barrel(1.08 * r, half - 0.001, reach - 0.3 * out, n, bored),
            "octagons": lambda: prism(1.9 * half, 8, half - 0.001, reach, bored, n),
            "shoulders": lambda: lathe(outline(1.2 * r, half - 0.001, 1.15 * r, reach), n, bored),
        }[made]()
        ways = [at(reach) @ spun("y", -turn) for turn in (np.pi, 0.0, *self.turns)]
        body = box((2 * half, 2 * half, 2 * half), (reach, 0, 0))
        t.add(self.label, body, *(moved(mouth, way) for way in ways), of="trim")
        if made == "nuts":
            nut = prism(2.55 * r + 0.006, 6, half + 0.25 * out, reach, bored, n)
            for way in ways:
                t.moved(way).add("nut", nut, of="trim", own=False, fine=False)
        for way, end in zip(ways[2:], self.ends, strict=True):
            end.build(t.moved(way).at(reach))
        return t.model(round(2 * reach, 9), "welded")


class CrossBlock(TeeBlock, name="cross/bar stock", sizes=SMALL):
    """A block with four mouths on its sides (ISO 8434-1, ASME B16.11 bar stock)."""

    turns: ClassVar[tuple[float, ...]] = (np.pi / 2, -np.pi / 2)

    ends: tuple[Tail, ...] = several(tails("open", "cap"), 2, _GOES_ON)


class SplitFlange(Fitting, name="flange/split", bundle="flange", sizes=sizes_between(most=100)):
    """A split flange (ISO 6162): two clamp halves behind a collar, four bolts into a square port block."""

    lead: float = between(0.05, 0.2, "length of the pipe before it", "m")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.3)
        lead, thick, collar, port, rim = self.lead, 0.55 * r + 0.012, 0.3 * r + 0.005, 0.8 * r + 0.015, 1.35 * r
        tall, wide, bolt = 1.9 * r + 0.02, 1.5 * r + 0.014, 0.14 * r + 0.006
        face = lead + thick
        total = face + port + lead
        t.add("flange", lathe(outline(r, 0.0, r, face - collar, rim, face - collar, rim, face), n, bore))
        spots = np.array([[sx * (wide - 1.4 * bolt), sy * (tall - 1.6 * bolt)] for sx in (-1, 1) for sy in (-1, 1)])
        angles = np.linspace(np.pi, 0, 11)
        arch = 1.36 * r * np.column_stack([np.cos(angles), np.sin(angles)])
        corners = np.array([[1, 0], [1, 0.75], [0.8, 1], [-0.8, 1], [-1, 0.75], [-1, 0]]) * [wide, tall]
        shape = np.vstack([corners, arch]) + np.array([0.0, 0.0005])
        half = drilled(shape, lead, face, 0.0, spots[spots[:, 1] > 0], 0.55 * bolt, t.style, n)
        for turn in (0.0, np.pi):
            t.spun("x", turn).add("flange", half)
        square = rounded_rectangle(2 * wide, 2 * tall, 0.15 * wide, 2)
        block = drilled(square, face, face + port, bore, spots, 0.5 * bolt, t.style, n)
        t.add("flange", block, of="valve", own=False)
        t.add("pipe", pipe_x(t.dn, face + port, total, t.style), own=False)
        for y, z in spots:
            t.extend(bolting(1, 0.0, bolt, lead, face + port, t.style, "", at(0, float(y), float(z))))
        return t.model(round(total, 9), "welded")


class Insulating(Fitting, name="gasket/insulating"):
    """An insulating joint: a thick gasket, sleeves' ends and pairs of washers under every nut, between two flanges."""

    gap: float = among((0.003, 0.0045, 0.006), "thickness of its gasket", "m")
    lead: float = between(0.02, 0.1, "length of the pipe before and behind it", "m")
    reach: str = among(("bolts", "raised face"), "how far out its gasket goes")

    def build(self, t: Table) -> Model:
        size, plate, lead, gap = t.flange, plate_thickness(t.dn), self.lead, self.gap
        outer = 0.5 * (size.circle - size.bolt) - 0.001 if self.reach == "bolts" else 0.49 * size.raised
        face = lead + flange_length(t.dn, t.style)
        total, one = 2 * face + gap, parts_of(flange(t.dn, t.style))
        t.add("pipe", pipe_x(t.dn, 0.0, lead, t.style))
        t.at(face).moved(BACK).extend(one)
        t.add("gasket", barrel(outer, face, face + gap, t.n(size.circle / 2), t.pipe.radius), of="handle")
        t.at(face + gap).extend(one)
        disc, thin = 1.05 * size.bolt, 0.003
        low, high = face - plate - 2 * thin, face + gap + plate + 2 * thin
        places = (low, low + thin, high - 2 * thin, high - thin)
        pair = merge([barrel(disc, a, a + thin, 12, 0.5 * size.bolt) for a in places])
        for k in range(size.n_bolts):
            t.spun("x", (2 * k + 1) * np.pi / size.n_bolts).at(0, size.circle / 2).add("washer", pair)
        t.extend(bolting(size.n_bolts, size.circle / 2, size.bolt, low, high, t.style))
        t.add("pipe", pipe_x(t.dn, total - lead, total, t.style))
        return t.model(round(total, 9), "welded")


class UnionElbow(Fitting, name="union/elbow", place="end", sizes=SMALL, weight=1.0):
    """A union elbow on a pipe's end (EN 10242 UA1): a banded or hexagon mouth, a bend, a big nut, a tail."""

    turn: float = among((0.5, 0.5, 0.25), "of the bend / half a turn")
    radius: float = between(1.25, 1.7, "of the bend / of its body")
    flats: int = among((6, 8), "flats of its mouth")
    corners: int = among((6, 8), "flats of its nut")
    tail: Tail = tail_of("open", "open", "cap")
    roll: float = among(QUARTERS, ROLL)

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.3)
        turn, body, deep = self.turn * np.pi, 1.15 * r + 0.0015, 0.8 * r + 0.011
        path, reach = bend_path(self.radius * body, turn, t.style.bend(2.5 * body, turn), 0.5 * deep)
        start, nut, out = 0.5 * deep, 0.8 * r + 0.01, 0.5 * r + 0.008
        end = prism(2.4 * r + 0.006, self.flats, 0.0, deep, 0.98 * r if t.style.hollow else 0.0, n)
        far = at(start + reach) @ spun("z", turn) @ at(reach)
        seat = moved(barrel(1.3 * r, -0.3 * nut, 0.35 * nut, n), far)
        t = t.spun("x", self.roll * np.pi)
        t.add("elbow", end, moved(tube(path, body, 0.0, n), at(start)), seat, of="trim")
        t = t.moved(far)
        t.add("union", prism(3.2 * r + 0.01, self.corners, 0.0, nut, 1.1 * r, n))
        piece = outline(1.25 * r, 0.35 * nut, 1.25 * r, nut, 1.08 * r, nut + 0.1 * r, 1.08 * r, nut + out)
        t.add("union", lathe(piece, n, bore))
        self.tail.build(t.at(nut + out))
        return t.model()


class HygienicBlank(Fitting, name="pipe cap/hygienic", place="end", sizes=sizes_between(most=100)):
    """A hygienic blank (ISO 2852): a ferrule on the pipe, a seal, a disc, a clamp of two halves with a wing nut."""

    long: float = between(0.5, 1.0, "length of its ferrule, less 12 mm / radius of the pipe")
    roll: float = between(0, 6, "where its wing nut is, about the pipe", "rad")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.4)
        (one, long, rim), t = ferrule(t, self.long), t.spun("x", self.roll)
        t.add("coupling", one, of="trim")
        t.add("gasket", barrel(rim, long, long + 0.002, n, 0.9 * r))
        blank = outline(rim, long + 0.002, rim, long + 0.005, 1.05 * r, long + 0.008)
        t.add("pipe cap", lathe(blank, n), of="trim")
        hygienic_clamp(t, long, rim, hinged=False)
        return t.model()


SPECIALS = families_of(TeeBlock, CrossBlock, SplitFlange, Insulating, UnionElbow, HygienicBlank)
