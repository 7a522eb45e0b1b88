"""Reducers of further makes, down to another size and back, and pipes that are more than plain ones."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import number
from cadplants.builder.params import Params, among, between, chance, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.piping.shape import (
    BACK,
    SMALL,
    UP,
    Fitting,
    Tail,
    barrel,
    below,
    counter,
    flat_flange,
    grooved,
    lathe,
    pipe_x,
    prism,
    sized,
)
from cadplants.model.family import Model, Part, placed
from cadplants.model.standards import PIPES, SIZES, sizes_between
from cadplants.parts.flange import plate_thickness
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, merge, moved
from cadplants.solids.polygon import circle
from cadplants.solids.primitives import box, lofted, rope
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["REDUCERS"]

# From the larger size at x = 0 to the smaller one: its pieces, its length, and how far the axis has sunk.
Made = tuple[list[Part], float, float]


def _own(*solids: Solid, of: str = "pipe", name: str = "reducer") -> list[Part]:
    return [Part(merge(solids), name, of)]


class Taper(Params):
    """How a reducer is made."""

    def made(self, dn: int, other: int, style: ModelingStyle) -> Made:
        """One from a nominal size down to another."""
        raise NotImplementedError(type(self).__name__)


def _sized(dn: int, other: int, style: ModelingStyle, wide: float = 1.0) -> tuple[float, float, int, float]:
    """Both pipes' radii, sides of a circle that is wider than the larger by a factor, and the smaller bore [m]."""
    a, n, bore = sized(dn, style, wide)
    return a, PIPES[other].radius, n, min(bore, bore_of(other, style))


class Bell(Taper):
    """A malleable reducing socket (EN 10242 M2): a bell with a band at each mouth."""

    kind = "malleable bell"

    def made(self, dn: int, other: int, style: ModelingStyle) -> Made:
        a, b, n, bore = _sized(dn, other, style, 1.3)
        first, band, end, wide, far = (
            0.8 * a + 0.012,
            0.25 * a + 0.003,
            0.25 * b + 0.003,
            1.34 * a + 0.003,
            1.36 * b + 0.002,
        )
        mid = first + 0.5 * a + 0.006
        length = mid + 0.8 * b + 0.012
        shape = outline(wide, 0.0, wide, band, 1.18 * a, 1.2 * band, 1.18 * a, first)
        shape += outline(1.2 * b, mid, 1.2 * b, length - 1.2 * end, far, length - end, far, length)
        return _own(lathe(shape, n, bore)), length, 0.0


class Long(Taper):
    """A long cone of 7 to 15 degrees rolled of plate, its ends cut at the welds."""

    kind = "long cone"

    slope: float = between(5.0, 12.0, "of its skin from its axis, in degrees")

    def made(self, dn: int, other: int, style: ModelingStyle) -> Made:
        a, b, n, bore = _sized(dn, other, style)
        length, bead, p, q = float((a - b) / np.tan(np.radians(self.slope))), 0.02 * a + 0.002, 1.02 * a, 1.03 * b
        shape = outline(p, 0.0, p, bead, a, bead, b, length - bead, q, length - bead, q, length)
        return _own(lathe(shape, n, bore)), length, 0.0


class Cast(Taper):
    """A cast taper with flanges (ASME B16.1, EN 545), concentric, between its counter-flanges."""

    def made(self, dn: int, other: int, style: ModelingStyle) -> Made:
        a, b, n, bore = _sized(dn, other, style)
        (parts, first), p, q = counter(dn, style, BACK), plate_thickness(dn), plate_thickness(other)
        length, p_r, q_r = 0.16 + 0.9 * a, 1.15 * a, 1.15 * b
        far = first + length
        cone = outline(p_r, first + p, p_r, first + 0.25 * length, q_r, first + 0.75 * length, q_r, far - q)
        disc, end = flat_flange(dn, style, first, p, bore), flat_flange(other, style, far - q, q, bore)
        more, last = counter(other, style, at(far))
        own = _own(disc, lathe(cone, n, bore), end, of="valve")
        return [*own, *placed(parts, at(first)), *more], far + last, 0.0


class Bushing(Taper):
    """A hexagon bushing (ASME B16.14) screwed into a coupling on the larger pipe."""

    kind = "bushing"

    flats: int = among((6, 6, 8), "flats of its head")

    def made(self, dn: int, other: int, style: ModelingStyle) -> Made:
        a, b, n, _ = _sized(dn, other, style, 1.3)
        sock, flat = 1.0 * a + 0.014, 0.35 * a + 0.005
        bore, wide = (0.98 * b, 0.97 * a) if style.hollow else (0.0, 0.0)
        sleeve = Part(barrel(1.28 * a + 0.002, 0.0, sock, n, wide), "coupling", "pipe")
        shank = barrel(0.96 * a, 0.4 * sock, sock + 0.001, n, bore)
        head = prism(2.25 * a + 0.004, self.flats, sock, sock + flat, bore, n)
        return [sleeve, *_own(shank, head)], sock + flat, 0.0


class Stepped(Taper):
    """A forged reducing coupling (ASME B16.11): one round or stepped piece, or a hexagon."""

    kind = "forged coupling"

    form: str = among(("round", "stepped", "hexagon"), "its outside")

    def made(self, dn: int, other: int, style: ModelingStyle) -> Made:
        a, b, n, bore = _sized(dn, other, style, 1.3)
        length, big, small = 1.5 * a + 0.025, 1.28 * a + 0.002, 1.35 * b + 0.002
        if self.form == "hexagon":
            return _own(prism(2.0 * big, 6, 0.0, length, bore, n)), length, 0.0
        shape = outline(big, 0.0, big, length)
        if self.form == "stepped":
            shape = outline(big, 0.0, big, 0.5 * length, small, 0.55 * length, small, length)
        return _own(lathe(shape, n, bore)), length, 0.0


class Glued(Taper):
    """A plastic reducer (EN ISO 1452-3): a socket with a lip, a cone, a smaller socket; or a short stepped bush."""

    kind = "glued"

    bush: bool = chance(0.4, "a short stepped bush")

    def made(self, dn: int, other: int, style: ModelingStyle) -> Made:
        a, b, n, bore = _sized(dn, other, style, 1.2)
        if self.bush:
            length, mid = 1.0 * a + 0.02, 0.7 * a + 0.01
            shape = outline(1.2 * a, 0.0, 1.2 * a, mid, 1.25 * b, mid, 1.25 * b, length)
        else:
            lip, sock, cone = 0.15 * a + 0.002, 1.1 * a + 0.01, 0.6 * a + 0.01
            length = sock + cone + 1.2 * b + 0.01
            far = length - lip
            shape = outline(1.27 * a, 0.0, 1.27 * a, lip, 1.19 * a, lip, 1.19 * a, sock, 1.2 * b, sock + cone)
            shape += outline(1.2 * b, far, 1.3 * b, far, 1.3 * b, length)
        return _own(lathe(shape, n, bore), of="handle"), length, 0.0


class Swage(Taper):
    """A swage nipple (MSS SP-95): two long straight ends and a short steep shoulder; welded or threaded."""

    kind = "swage nipple"

    mid: float = between(0.4, 0.8, "length of its shoulder / radius of the larger pipe")

    def made(self, dn: int, other: int, style: ModelingStyle) -> Made:
        a, b, n, bore = _sized(dn, other, style)
        length, x, mid = 2.6 * a + 0.06, 1.1 * a + 0.02, self.mid * a
        shape = outline(a, 0.0, a, x, 0.97 * a, x + 0.15 * mid, 1.04 * b, x + 0.85 * mid, b, x + mid, b, length)
        return _own(lathe(shape, n, bore)), length, 0.0


class Grooved(Taper):
    """A grooved reducer (AWWA C606): short, with a coupling at each end."""

    cone: float = between(0.3, 1.0, "length of its cone / radius of the larger pipe")

    def made(self, dn: int, other: int, style: ModelingStyle) -> Made:
        a, b, n, bore = _sized(dn, other, style)
        end = 0.035 + 0.08 * a
        length = 2 * end + self.cone * a
        parts = _own(lathe(outline(a, 0.0, a, end, b, length - end, b, length), n, bore))
        return parts + grooved(dn, style, at()) + grooved(other, style, at(length)), length, 0.0


class Eccentric(Taper):
    """An eccentric cone with flat flanges, flat below or on top, between its counter-flanges."""

    def made(self, dn: int, other: int, style: ModelingStyle) -> Made:
        a, b, n, _ = _sized(dn, other, style)
        (parts, first), p, q = counter(dn, style, BACK), plate_thickness(dn), plate_thickness(other)
        length, drop, ring, end = 0.16 + 1.2 * a, a - b, circle(1.0, n), 0.15 * a
        places = ((p, a, 0.0), (p + end, a, 0.0), (length - q - end, b, drop), (length - q, b, drop))
        loops = [np.column_stack([np.full(n, first + x), r * ring[:, 0], r * ring[:, 1] - low]) for x, r, low in places]
        away, far = at(0, 0, -drop), first + length
        disc = moved(flat_flange(other, style, far - q, q, 0.0), away)
        more, last = counter(other, style, away @ at(far))
        own = _own(flat_flange(dn, style, first, p, 0.0), lofted(loops), disc)
        return [*own, *placed(parts, at(first)), *more], far + last, drop


class Hexagon(Taper):
    """A reducing hexagon nipple (EN 10242 N8) between two sockets."""

    def made(self, dn: int, other: int, style: ModelingStyle) -> Made:
        a, b, n, bore = _sized(dn, other, style, 1.3)
        one, flat, two, bore = 1.0 * a + 0.014, 0.45 * a + 0.006, 1.0 * b + 0.014, 0.9 * bore
        mid = one + flat
        length = mid + two
        first = lathe(outline(0.97 * a, 0.3 * one, a, one + 0.001), n, bore)
        last = lathe(outline(b, mid - 0.001, 0.97 * b, length - 0.3 * two), n, bore)
        parts = _own(first, prism(2.3 * a + 0.005, 6, one, mid, bore, n), last, name="nipple")
        for r, low, high in ((a, 0.0, 0.8 * one), (b, length - 0.8 * two, length)):
            parts.append(Part(barrel(1.28 * r + 0.002, low, high, n, bore), "coupling", "pipe"))
        return parts, length, 0.0


def _larger(dn: int) -> Sequence[int]:
    """The next larger nominal sizes [mm]."""
    return SIZES[SIZES.index(dn) + 1 :][:3]


_MAKE = "how its reducers are made"


class _ThereAndBack(Fitting):
    """Two reducers with a piece of pipe of another size between them, smaller or larger than the line."""

    wider: bool = chance(0.35, "the pipe between them is larger than the line", when=lambda p: bool(_larger(p.dn)))
    other: int = among(lambda p: _larger(p.dn) if p.wider else below(p.dn, 3), "nominal size between them", "mm")
    taper: Taper = nested(Taper, _MAKE)
    apart: float = between(0.04, 0.4, "from one to the other", "m")

    def build(self, t: Table) -> Model:
        other, up = self.other, self.wider
        parts, long, drop = self.taper.made(max(t.dn, other), min(t.dn, other), t.style)
        far, flip = long + self.apart, np.diag([-1.0, 1.0, 1.0, 1.0])
        total = long + far
        there, back = (at(long, 0, drop) @ flip, at(far, 0, drop)) if up else (at(), at(total) @ flip)
        t.moved(there).extend(parts)
        t.at(0, 0, drop if up else -drop).add("pipe", pipe_x(other, long, far, t.style))
        t.moved(back).extend(parts)
        return t.model(round(total, 9), "welded")


class Bells(_ThereAndBack, name="reducer/malleable bell", sizes=SMALL[1:]):
    """Two malleable reducing sockets (EN 10242 M2)."""

    taper: Taper = nested(Bell, _MAKE)


class LongTapers(_ThereAndBack, name="reducer/long taper", sizes=SIZES[1:]):
    """Two long cones rolled of plate."""

    taper: Taper = nested(Long, _MAKE)


class CastTapers(_ThereAndBack, name="reducer/cast flanged", sizes=sizes_between(most=200)[1:]):
    """Two cast tapers with flanges (ASME B16.1, EN 545)."""

    taper: Taper = nested(Cast, _MAKE)


class Bushings(_ThereAndBack, name="reducer/bushing", sizes=SMALL[1:]):
    """Two hexagon bushings (ASME B16.14) down to a smaller pipe."""

    wider: bool = chance(0.35, "the pipe between them is larger than the line", when=lambda p: False)
    taper: Taper = nested(Bushing, _MAKE)


class ForgedCouplings(_ThereAndBack, name="reducer/forged coupling", sizes=SMALL[1:]):
    """Two forged reducing couplings (ASME B16.11)."""

    taper: Taper = nested(Stepped, _MAKE)


class GluedReducers(_ThereAndBack, name="reducer/glued plastic", sizes=sizes_between(most=200)[1:]):
    """Two glued plastic reducers (EN ISO 1452-3)."""

    taper: Taper = nested(Glued, _MAKE)


class Swages(_ThereAndBack, name="reducer/swage nipple", sizes=sizes_between(most=200)[1:]):
    """Two swage nipples (MSS SP-95)."""

    taper: Taper = nested(Swage, _MAKE)


class GroovedReducers(_ThereAndBack, name="reducer/grooved", sizes=sizes_between(40, 200)):
    """Two grooved reducers (AWWA C606)."""

    taper: Taper = nested(Grooved, _MAKE)


class EccentricReducers(_ThereAndBack, name="reducer/eccentric flanged", sizes=sizes_between(40, 200)):
    """Two eccentric cones with flat flanges."""

    taper: Taper = nested(Eccentric, _MAKE)


class HexagonNipples(_ThereAndBack, name="nipple/hexagon reducing", sizes=SMALL[1:], weight=1.0):
    """Two reducing hexagon nipples (EN 10242 N8) in their sockets."""

    taper: Taper = nested(Hexagon, _MAKE)


_MAKES: tuple[type[Taper], ...] = (Bell, Long, Bushing, Stepped, Glued, Swage)


class End(Fitting, name="reducer/end", place="end", sizes=SIZES[1:], weight=1.5):
    """A reducer on a pipe's end, of any make, and what goes on from it."""

    other: int = among(lambda p: below(p.dn, 3), "nominal size of its far end", "mm")
    taper: Taper = nested(lambda source, _: _MAKES[int(source.rng.integers(len(_MAKES)))], "how it is made")
    tail: Tail = nested(Tail, "what goes on from it")

    def build(self, t: Table) -> Model:
        parts, long, drop = self.taper.made(t.dn, self.other, t.style)
        t.extend(parts)
        self.tail.build(t.at(long, 0, -drop), self.other)
        return t.model()


# --- pipes that are more than plain ones ---


class BellAndSpigot(Fitting, name="pipe/bell and spigot", sizes=SIZES[5:]):
    """Cast iron or concrete pipes with a bell at one end (EN 545), one in the other."""

    count: int = whole(1, 3, "pipes")
    longs: tuple[float, ...] = several(number(0.25, 0.8), lambda p: p.count, "length of each without its bell", "m")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.3)
        x, bell, big = 0.0, 0.8 * r + 0.04, 1.3 * r + 0.008
        rim = 1.08 * big
        for long in self.longs:
            end = long + bell
            shape = outline(r, x, r, x + long, big, x + long + 0.3 * r, big, x + end - 0.015, rim, x + end - 0.015)
            t.add("pipe", lathe([*shape, (rim, x + end)], n, bore))
            x += end
        return t.model(round(x, 9), "welded")


class Clad(Fitting, name="pipe/clad"):
    """An insulated pipe: sheet cladding in lengths with beads, bands and flat end rings round the pipe."""

    thick: float = among((0.02, 0.03, 0.05), "thickness of the cladding", "m")
    lead: float = between(0.04, 0.12, "length of the pipe before and behind it", "m")
    count: int = whole(1, 3, "lengths of sheet")
    one: float = between(0.25, 0.6, "length of a sheet", "m")
    banded: bool = chance(0.5, "bands round it")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.8)
        lead, one, outer = self.lead, self.one, r + self.thick
        length, bead = 2 * lead + self.count * one, outer + 0.003
        t.add("pipe", pipe_x(t.dn, 0.0, length, t.style))
        lows = [lead + k * one for k in range(self.count)]
        for k, low in enumerate(lows):
            high = lead + (k + 1) * one
            shape = outline(outer, low, outer, high - 0.03, bead, high - 0.025, outer, high - 0.02, outer, high)
            t.add("pipe", lathe(shape, n, r), of="tank")
        for k in range(self.count if self.banded else 0):
            x = lead + (k + 0.4) * one
            t.add("clamp", barrel(outer + 0.001, x, x + 0.02, n, outer))
        return t.model(round(length, 9), "welded")


class Jacketed(Fitting, name="pipe/jacketed"):
    """A jacketed or finned pipe: a wider one round it with coned ends and two small mouths; or discs in a row."""

    long: float = between(0.3, 0.9, "length of the jacket or of the row of discs", "m")
    finned: bool = chance(0.45, "discs in a row, not a jacket")
    high: float = between(1.5, 2.0, "radius of a disc / of the pipe", when=lambda p: p.finned)
    pitch: float = between(0.012, 0.03, "from disc to disc", "m", when=lambda p: p.finned)
    wide: float = between(1.3, 1.6, "radius of the jacket, less 4 mm / of the pipe", when=lambda p: not p.finned)
    turn: float = among(
        (0.0, 1.0),
        "from one mouth to the other, about the pipe / half a turn",
        when=lambda p: not p.finned,
        otherwise=0.0,
    )

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.5)
        lead, long, inner = 0.3 * r + 0.03, self.long, 1.01 * r
        length = 2 * lead + long
        t.add("pipe", pipe_x(t.dn, 0.0, length, t.style))
        if self.finned:
            xs = [lead + k * self.pitch for k in range(min(30, int(long / self.pitch)))]
            t.add("pipe", *(barrel(self.high * r, x, x + 0.003, n, r) for x in xs), of="trim")
        else:
            wide, far, cone = self.wide * r + 0.004, lead + long, 0.2 * r
            jacket = outline(inner, lead - cone, wide, lead + cone, wide, far - cone, inner, far + cone)
            t.add("pipe", lathe(jacket, n, r))
            mouth = moved(barrel(0.0107, 0.9 * wide, wide + 0.05, 12), UP)
            near, other = at(lead + 0.2 * long), at(lead + 0.8 * long) @ spun("x", self.turn * np.pi)
            t.add("nipple", moved(mouth, near), moved(mouth, other))
        return t.model(round(length, 9), "welded")


class Spiral(Fitting, name="pipe/spiral"):
    """A pipe with a spiral seam, a traced one with a small tube along it in straps, or a corrugated one."""

    length: float = between(0.4, 1.2, "length", "m")
    form: str = among(("seam", "traced", "corrugated"), "which of these it is")
    tracer: float = among(
        (0.005, 0.006, 0.008), "radius of the small tube", "m", when=lambda p: p.form == "traced", otherwise=0.0
    )

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style)
        length, body = self.length, pipe_x(t.dn, 0.0, self.length, t.style)
        if self.form == "seam":
            turns = max(1, int(length / (2.5 * r)))
            a = np.linspace(0, 2 * np.pi * turns, 16 * turns + 1)
            way = np.column_stack([0.02 + (length - 0.04) * a / a[-1], r * np.cos(a), r * np.sin(a)])
            t.add("pipe", body, rope(way, 0.002 + 0.012 * r, 6))
        elif self.form == "traced":
            q = self.tracer
            t.add("pipe", body)
            t.at(0, 0, -r - q).add("pipe", barrel(q, 0.02, length - 0.02, 10), of="trim")
            for x in np.arange(0.1, length - 0.05, 0.25):
                clip = box((0.012, 2.6 * q, 0.001), (float(x) + 0.006, 0, -r - 2 * q - 0.0005))
                t.add("clamp", barrel(r + 0.001, x, x + 0.012, n, r), clip)
        else:
            count = min(40, int((length - 0.04) / (0.25 * r + 0.006)))
            step, shape = (length - 0.04) / count, outline(r, 0.0, r, 0.02)
            for k in range(count):
                x = 0.02 + k * (length - 0.04) / count
                shape += outline(1.12 * r, x + 0.2 * step, 1.12 * r, x + 0.6 * step, r, x + 0.8 * step)
            t.add("pipe", lathe([*shape, (r, length)], n, bore), of="rubber")
        return t.model(round(length, 9), "welded")


REDUCERS = families_of(
    Bells, LongTapers, CastTapers, Bushings, ForgedCouplings, GluedReducers, Swages, GroovedReducers,
    EccentricReducers, End, HexagonNipples, BellAndSpigot, Clad, Jacketed, Spiral,
)  # fmt: skip
