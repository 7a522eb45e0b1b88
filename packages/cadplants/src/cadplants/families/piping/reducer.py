"""Reducers of further makes, down to another size and back, and pipes that are more than plain ones."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.piping.shape import (
    BOLTED,
    SMALL,
    counter,
    family,
    flat_flange,
    grooved,
    lathe,
    pipe_x,
    prism,
    tail,
)
from cadplants.family import Build, Family, Model, Part
from cadplants.flange import plate_thickness
from cadplants.mesh_ops import Solid, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle
from cadplants.primitives import box, lofted, rope
from cadplants.standards import PIPES, SIZES
from cadplants.transforms import at, spun
from cadplants.valve_body import bore_of

__all__ = ["REDUCERS"]

# From the larger size at x = 0 to the smaller one: its pieces, its length, and how far the axis has sunk.
Taper = Callable[[int, int, ModelingStyle, np.random.Generator], tuple[list[Part], float, float]]


def _own(*solids: Solid, color: str = "pipe", name: str = "reducer") -> list[Part]:
    return [Part(merge(list(solids)), name, color)]


def _bore(dn: int, other: int, style: ModelingStyle) -> float:
    return min(bore_of(dn, style), bore_of(other, style))


def _bell(dn: int, other: int, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float, float]:
    """A malleable reducing socket (EN 10242 M2): a bell with a band at each mouth."""
    a, b, n = PIPES[dn].radius, PIPES[other].radius, style.round(1.3 * PIPES[dn].radius)
    first, mid, last = 0.8 * a + 0.012, 0.5 * a + 0.006, 0.8 * b + 0.012
    band = 0.25 * a + 0.003
    shape = [(1.34 * a + 0.003, 0.0), (1.34 * a + 0.003, band), (1.18 * a, 1.2 * band), (1.18 * a, first)]
    length = first + mid + last
    end = 0.25 * b + 0.003
    shape += [
        (1.2 * b, first + mid),
        (1.2 * b, length - 1.2 * end),
        (1.36 * b + 0.002, length - end),
        (1.36 * b + 0.002, length),
    ]
    return _own(lathe(shape, n, _bore(dn, other, style))), length, 0.0


def _taper(dn: int, other: int, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float, float]:
    """A long cone of 7 to 15 degrees rolled of plate, its ends cut at the welds."""
    a, b, n = PIPES[dn].radius, PIPES[other].radius, style.round(PIPES[dn].radius)
    length = (a - b) / np.tan(np.radians(float(rng.uniform(5.0, 12.0))))
    bead = 0.02 * a + 0.002
    shape = [
        (1.02 * a, 0.0),
        (1.02 * a, bead),
        (a, bead),
        (b, length - bead),
        (1.03 * b, length - bead),
        (1.03 * b, length),
    ]
    return _own(lathe(shape, n, _bore(dn, other, style))), float(length), 0.0


def _cast(dn: int, other: int, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float, float]:
    """A cast taper with flanges (ASME B16.1, EN 545), concentric, between its counter-flanges."""
    a, b, n, bore = PIPES[dn].radius, PIPES[other].radius, style.round(PIPES[dn].radius), _bore(dn, other, style)
    first, p, q = counter(dn, style, spun("z", np.pi))[1], plate_thickness(dn), plate_thickness(other)
    length = 0.16 + 0.9 * a
    body = [
        flat_flange(dn, style, first, p, bore),
        lathe(
            [
                (1.15 * a, first + p),
                (1.15 * a, first + 0.25 * length),
                (1.15 * b, first + 0.75 * length),
                (1.15 * b, first + length - q),
            ],
            n,
            bore,
        ),
        flat_flange(other, style, first + length - q, q, bore),
    ]
    parts = _own(*body, color="valve")
    parts += counter(dn, style, at(first) @ spun("z", np.pi))[0]
    more, last = counter(other, style, at(first + length))
    return parts + more, first + length + last, 0.0


def _bushing(dn: int, other: int, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float, float]:
    """A hexagon bushing (ASME B16.14) screwed into a coupling on the larger pipe."""
    a, n = PIPES[dn].radius, style.round(1.3 * PIPES[dn].radius)
    sock, hexa = 1.0 * a + 0.014, 0.35 * a + 0.005
    bore = 0.98 * PIPES[other].radius if style.hollow else 0.0
    sleeve = Part(
        lathe([(1.28 * a + 0.002, 0.0), (1.28 * a + 0.002, sock)], n, 0.97 * a if style.hollow else 0.0),
        "coupling",
        "pipe",
    )
    shank = lathe([(0.96 * a, 0.4 * sock), (0.96 * a, sock + 0.001)], n, bore)
    head = prism(2.25 * a + 0.004, int(rng.choice([6, 6, 8])), sock, sock + hexa, bore, n)
    return [sleeve, *_own(shank, head)], sock + hexa, 0.0


def _stepped(dn: int, other: int, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float, float]:
    """A forged reducing coupling (ASME B16.11): one round or stepped piece, or a hexagon."""
    a, b, n, bore = PIPES[dn].radius, PIPES[other].radius, style.round(1.3 * PIPES[dn].radius), _bore(dn, other, style)
    length, big = 1.5 * a + 0.025, 1.28 * a + 0.002
    kind = int(rng.integers(3))
    if kind == 0:
        return _own(lathe([(big, 0.0), (big, length)], n, bore)), length, 0.0
    if kind == 1:
        small = 1.35 * b + 0.002
        return (
            _own(lathe([(big, 0.0), (big, 0.5 * length), (small, 0.55 * length), (small, length)], n, bore)),
            length,
            0.0,
        )
    return _own(prism(2.0 * big, 6, 0.0, length, bore, n)), length, 0.0


def _glued(dn: int, other: int, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float, float]:
    """A plastic reducer (EN ISO 1452-3): a socket with a lip, a cone, a smaller socket; or a short stepped bush."""
    a, b, n, bore = PIPES[dn].radius, PIPES[other].radius, style.round(1.2 * PIPES[dn].radius), _bore(dn, other, style)
    if rng.random() < 0.4:
        shape = [(1.2 * a, 0.0), (1.2 * a, 0.7 * a + 0.01), (1.25 * b, 0.7 * a + 0.01), (1.25 * b, 1.0 * a + 0.02)]
        return _own(lathe(shape, n, bore), color="handle"), 1.0 * a + 0.02, 0.0
    lip, sock, cone = 0.15 * a + 0.002, 1.1 * a + 0.01, 0.6 * a + 0.01
    shape = [(1.27 * a, 0.0), (1.27 * a, lip), (1.19 * a, lip), (1.19 * a, sock), (1.2 * b, sock + cone)]
    length = sock + cone + 1.2 * b + 0.01
    shape += [(1.2 * b, length - lip), (1.3 * b, length - lip), (1.3 * b, length)]
    return _own(lathe(shape, n, bore), color="handle"), length, 0.0


def _nipple(dn: int, other: int, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float, float]:
    """A swage nipple (MSS SP-95): two long straight ends and a short steep shoulder; welded or threaded."""
    a, b, n, bore = PIPES[dn].radius, PIPES[other].radius, style.round(PIPES[dn].radius), _bore(dn, other, style)
    length, first = 2.6 * a + 0.06, 1.1 * a + 0.02
    mid = float(rng.uniform(0.4, 0.8)) * a
    shape = [
        (a, 0.0),
        (a, first),
        (0.97 * a, first + 0.15 * mid),
        (1.04 * b, first + 0.85 * mid),
        (b, first + mid),
        (b, length),
    ]
    return _own(lathe(shape, n, bore)), length, 0.0


def _grooved(dn: int, other: int, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float, float]:
    """A grooved reducer (AWWA C606): short, with a coupling at each end."""
    a, b, n, bore = PIPES[dn].radius, PIPES[other].radius, style.round(PIPES[dn].radius), _bore(dn, other, style)
    end = 0.035 + 0.08 * a
    length = 2 * end + float(rng.uniform(0.3, 1.0)) * a
    shape = [(a, 0.0), (a, end), (b, length - end), (b, length)]
    parts = _own(lathe(shape, n, bore))
    return parts + grooved(dn, style, at()) + grooved(other, style, at(length)), length, 0.0


def _lofted(dn: int, other: int, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float, float]:
    """An eccentric cone with flat flanges, flat below or on top, between its counter-flanges."""
    a, b, n = PIPES[dn].radius, PIPES[other].radius, style.round(PIPES[dn].radius)
    first, p, q = counter(dn, style, spun("z", np.pi))[1], plate_thickness(dn), plate_thickness(other)
    length, drop = 0.16 + 1.2 * a, a - b
    ring_ = circle(1.0, n)
    loops = []
    for x, r, sunk in ((p, a, 0.0), (p + 0.15 * a, a, 0.0), (length - q - 0.15 * a, b, drop), (length - q, b, drop)):
        loops.append(np.column_stack([np.full(n, first + x), r * ring_[:, 0], r * ring_[:, 1] - sunk]))
    away = at(0, 0, -drop)
    far = moved(flat_flange(other, style, first + length - q, q, 0.0), away)
    parts = _own(flat_flange(dn, style, first, p, 0.0), lofted(loops), far)
    parts += counter(dn, style, at(first) @ spun("z", np.pi))[0]
    more, last = counter(other, style, away @ at(first + length))
    return parts + more, first + length + last, drop


def _hexagon(dn: int, other: int, style: ModelingStyle, rng: np.random.Generator) -> tuple[list[Part], float, float]:
    """A reducing hexagon nipple (EN 10242 N8) between two sockets."""
    a, b, n, bore = (
        PIPES[dn].radius,
        PIPES[other].radius,
        style.round(1.3 * PIPES[dn].radius),
        0.9 * _bore(dn, other, style),
    )
    one, hexa, two = 1.0 * a + 0.014, 0.45 * a + 0.006, 1.0 * b + 0.014
    length = one + hexa + two
    parts = _own(
        lathe([(0.97 * a, 0.3 * one), (a, one + 0.001)], n, bore),
        prism(2.3 * a + 0.005, 6, one, one + hexa, bore, n),
        lathe([(b, one + hexa - 0.001), (0.97 * b, length - 0.3 * two)], n, bore),
        name="nipple",
    )
    for r, low, high in ((a, 0.0, 0.8 * one), (b, length - 0.8 * two, length)):
        parts.append(
            Part(
                lathe([(1.28 * r + 0.002, low), (1.28 * r + 0.002, high)], n, bore if bore else 0.0), "coupling", "pipe"
            )
        )
    return parts, length, 0.0


def _there_and_back(taper: Taper, wider: bool = True) -> Build:
    """A builder of a taper to another size, pipe of that size, and the same taper back."""

    def build(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
        """Two reducers with a piece of pipe of another size between them, smaller or larger than the line."""
        k = SIZES.index(dn)
        up = wider and k + 1 < len(SIZES) and bool(k == 0 or rng.random() < 0.35)
        some = SIZES[k + 1 : k + 4] if up else SIZES[max(0, k - 3) : k]
        other = int(rng.choice(some))
        big, small = (other, dn) if up else (dn, other)
        parts, long, drop = taper(big, small, style, rng)
        between = float(rng.uniform(0.04, 0.4))
        total = 2 * long + between
        flip = np.diag([-1.0, 1.0, 1.0, 1.0])
        there, back = (at(long, 0, drop) @ flip, at(long + between, 0, drop)) if up else (at(), at(total) @ flip)
        middle = moved(pipe_x(other, long, long + between, style), at(0, 0, drop if up else -drop))
        whole = [Part(middle, "pipe", "pipe")]
        for pose in (there, back):
            whole += [Part(moved(p.solid, pose), p.name, p.color, p.bundle, p.group, p.fine) for p in parts]
        return Model([*whole[1 : 1 + len(parts)], whole[0], *whole[1 + len(parts) :]], round(total, 9), "welded")

    return build


def _at_end(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A reducer on a pipe's end, of any make, and what goes on from it."""
    other = int(rng.choice(SIZES[max(0, SIZES.index(dn) - 3) : SIZES.index(dn)]))
    makes: tuple[Taper, ...] = (_bell, _taper, _bushing, _stepped, _glued, _nipple)
    parts, long, drop = makes[int(rng.integers(len(makes)))](dn, other, style, rng)
    return Model([*parts, *tail(other, style, rng, at(long, 0, -drop), "ocfb")])


# --- pipes that are more than plain ones ---


def _spigot(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Cast iron or concrete pipes with a bell at one end (EN 545), one in the other."""
    r, n = PIPES[dn].radius, style.round(1.3 * PIPES[dn].radius)
    parts, x, bore = [], 0.0, bore_of(dn, style)
    for _ in range(int(rng.integers(1, 4))):
        long, bell = float(rng.uniform(0.25, 0.8)), 0.8 * r + 0.04
        big = 1.3 * r + 0.008
        shape = [
            (r, x),
            (r, x + long),
            (big, x + long + 0.3 * r),
            (big, x + long + bell - 0.015),
            (1.08 * big, x + long + bell - 0.015),
        ]
        parts.append(Part(lathe([*shape, (1.08 * big, x + long + bell)], n, bore), "pipe", "pipe"))
        x += long + bell
    return Model(parts, round(x, 9), "welded")


def _clad(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An insulated pipe: sheet cladding in lengths with beads, bands and flat end rings round the pipe."""
    r, n = PIPES[dn].radius, style.round(1.8 * PIPES[dn].radius)
    thick, lead = float(rng.choice([0.02, 0.03, 0.05])), float(rng.uniform(0.04, 0.12))
    count, one = int(rng.integers(1, 4)), float(rng.uniform(0.25, 0.6))
    length, outer = 2 * lead + count * one, r + thick
    parts = [Part(pipe_x(dn, 0.0, length, style), "pipe", "pipe")]
    for k in range(count):
        low, high = lead + k * one, lead + (k + 1) * one
        shape = [
            (outer, low),
            (outer, high - 0.03),
            (1.0 * outer + 0.003, high - 0.025),
            (outer, high - 0.02),
            (outer, high),
        ]
        parts.append(Part(lathe(shape, n, r), "pipe", "tank"))
    if rng.random() < 0.5:
        for k in range(count):
            x = lead + (k + 0.4) * one
            parts.append(
                Part(lathe([(outer + 0.001, x), (outer + 0.001, x + 0.02)], n, outer), "clamp", "clamp", "", BOLTED)
            )
    return Model(parts, round(length, 9), "welded")


def _jacketed(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A jacketed or finned pipe: a wider one round it with coned ends and two small mouths; or discs in a row."""
    r, n = PIPES[dn].radius, style.round(1.5 * PIPES[dn].radius)
    lead, long = 0.3 * r + 0.03, float(rng.uniform(0.3, 0.9))
    length = 2 * lead + long
    parts = [Part(pipe_x(dn, 0.0, length, style), "pipe", "pipe")]
    if rng.random() < 0.45:
        high, pitch = float(rng.uniform(1.5, 2.0)) * r, float(rng.uniform(0.012, 0.03))
        fins = [
            lathe([(high, lead + k * pitch), (high, lead + k * pitch + 0.003)], n, r)
            for k in range(min(30, int(long / pitch)))
        ]
        parts.append(Part(merge(fins), "pipe", "trim"))
        return Model(parts, round(length, 9), "welded")
    wide = float(rng.uniform(1.3, 1.6)) * r + 0.004
    jacket = lathe(
        [
            (1.01 * r, lead - 0.2 * r),
            (wide, lead + 0.2 * r),
            (wide, lead + long - 0.2 * r),
            (1.01 * r, lead + long + 0.2 * r),
        ],
        n,
        r,
    )
    mouths = []
    for x, turn in ((lead + 0.2 * long, 0.0), (lead + 0.8 * long, pick(rng, 0.0, 1.0))):
        nozzle = lathe([(0.0107, 0.9 * wide), (0.0107, wide + 0.05)], 12)
        mouths.append(moved(nozzle, at(x) @ spun("x", turn * np.pi) @ spun("y", -np.pi / 2)))
    return Model(
        [*parts, Part(jacket, "pipe", "pipe"), Part(merge(mouths), "nipple", "pipe")], round(length, 9), "welded"
    )


def _spiral(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A pipe with a spiral seam, a traced one with a small tube along it in straps, or a corrugated one."""
    r, n = PIPES[dn].radius, style.round(PIPES[dn].radius)
    length, kind = float(rng.uniform(0.4, 1.2)), int(rng.integers(3))
    body = pipe_x(dn, 0.0, length, style)
    if kind == 0:
        turns = max(1, int(length / (2.5 * r)))
        a = np.linspace(0, 2 * np.pi * turns, 16 * turns + 1)
        xs = 0.02 + (length - 0.04) * a / a[-1]
        seam = rope(np.column_stack([xs, r * np.cos(a), r * np.sin(a)]), 0.002 + 0.012 * r, 6)
        return Model([Part(merge([body, seam]), "pipe", "pipe")], round(length, 9), "welded")
    if kind == 1:
        q = float(rng.choice([0.005, 0.006, 0.008]))
        tracer = moved(lathe([(q, 0.02), (q, length - 0.02)], 10), at(0, 0, -r - q))
        parts = [Part(body, "pipe", "pipe"), Part(tracer, "pipe", "trim")]
        for x in np.arange(0.1, length - 0.05, 0.25):
            strap = lathe([(r + 0.001, x), (r + 0.001, x + 0.012)], n, r)
            clip = box((0.012, 2.6 * q, 0.001), (float(x) + 0.006, 0, -r - 2 * q - 0.0005))
            parts.append(Part(merge([strap, clip]), "clamp", "clamp", "", BOLTED))
        return Model(parts, round(length, 9), "welded")
    pitch = 0.25 * r + 0.006
    count = min(40, int((length - 0.04) / pitch))
    shape = [(r, 0.0), (r, 0.02)]
    for k in range(count):
        x = 0.02 + k * (length - 0.04) / count
        step = (length - 0.04) / count
        shape += [(1.12 * r, x + 0.2 * step), (1.12 * r, x + 0.6 * step), (r, x + 0.8 * step)]
    return Model(
        [Part(lathe([*shape, (r, length)], n, bore_of(dn, style)), "pipe", "rubber")], round(length, 9), "welded"
    )


_MIDDLE = tuple(dn for dn in SIZES[1:] if dn <= 200)

REDUCERS: tuple[Family, ...] = (
    family("reducer/malleable bell", _there_and_back(_bell), SMALL[1:]),
    family("reducer/long taper", _there_and_back(_taper), SIZES[1:]),
    family("reducer/cast flanged", _there_and_back(_cast), _MIDDLE),
    family("reducer/bushing", _there_and_back(_bushing, False), SMALL[1:]),
    family("reducer/forged coupling", _there_and_back(_stepped), SMALL[1:]),
    family("reducer/glued plastic", _there_and_back(_glued), _MIDDLE),
    family("reducer/swage nipple", _there_and_back(_nipple), _MIDDLE),
    family("reducer/grooved", _there_and_back(_grooved), tuple(dn for dn in _MIDDLE if dn >= 40)),
    family("reducer/eccentric flanged", _there_and_back(_lofted), tuple(dn for dn in _MIDDLE if dn >= 40)),
    family("reducer/end", _at_end, SIZES[1:], "end", 1.5),
    family("nipple/hexagon reducing", _there_and_back(_hexagon), SMALL[1:], weight=1.0),
    family("pipe/bell and spigot", _spigot, SIZES[5:]),
    family("pipe/clad", _clad),
    family("pipe/jacketed", _jacketed),
    family("pipe/spiral", _spiral),
)
