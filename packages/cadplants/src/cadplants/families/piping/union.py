"""Unions, nipples and caps of further makes."""

from __future__ import annotations

import numpy as np

from cadplants.families.chance import pick
from cadplants.families.piping.coupling import half_band
from cadplants.families.piping.shape import (
    BOLTED,
    SMALL,
    bolting,
    family,
    grooved,
    knurled,
    lathe,
    mouth,
    notched,
    prism,
)
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.primitives import box, cylinder, rod, rope, torus
from cadplants.standards import PIPES, SIZES
from cadplants.transforms import at, spun
from cadplants.valve_body import bore_of

__all__ = ["UNIONS"]

_BACK = spun("z", np.pi)


def _union(*solids: Solid, color: str = "trim") -> list[Part]:
    return [Part(solid, "union", color, "union") for solid in solids]


def _malleable(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A malleable union (EN 10242 U1): two banded or octagon ends and an octagon or hexagon nut with a collar."""
    r, n = PIPES[dn].radius, style.round(1.5 * PIPES[dn].radius)
    end, nut = 0.9 * r + 0.014, 0.8 * r + 0.01
    length, corners = 2 * end + nut, int(rng.choice([6, 8, 8]))
    design = str(rng.choice(["banded", "octagon"]))
    bored = 0.98 * r if style.hollow else 0.0
    one = (
        mouth("banded", dn, style, 0.0, 1.2 * end)
        if design == "banded"
        else prism(2.4 * r + 0.008, 8, 0.0, 1.2 * end, bored, n)
    )
    first = moved(one, at(1.2 * end) @ _BACK)
    second = moved(one, at(length - 1.2 * end))
    flats = float(rng.uniform(3.1, 3.5)) * r + 0.012
    ring = prism(flats, corners, end, end + 0.75 * nut, 1.1 * r, n)
    collar = lathe([(0.5 * flats, end + 0.75 * nut), (0.42 * flats, end + nut)], n, 1.1 * r)
    return Model(_union(first, merge([ring, collar]), second), round(length, 9), "welded")


def _forged(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A forged union of class 3000 (MSS SP-83): round sockets with shoulders under a heavy hexagon nut."""
    r, n = PIPES[dn].radius, style.round(1.5 * PIPES[dn].radius)
    end, nut = float(rng.uniform(0.9, 1.4)) * r + 0.012, 0.9 * r + 0.012
    length, bore = 2 * end + nut, bore_of(dn, style)
    sock = 1.36 * r + 0.003
    first = lathe(
        [(sock, 0.0), (sock, end - 0.1 * r), (1.5 * r + 0.004, end), (1.5 * r + 0.004, end + 0.4 * nut)], n, bore
    )
    second = lathe([(1.5 * r, end + 0.4 * nut), (1.5 * r, end + nut), (sock, end + 1.2 * nut), (sock, length)], n, bore)
    ring = prism(3.9 * r + 0.012, 6, end, end + nut, 1.45 * r, n)
    lip = lathe([(1.7 * r + 0.004, end - 0.25 * r), (1.9 * r + 0.004, end)], n, sock)
    return Model(_union(first, merge([ring, lip]), second, color="pipe"), round(length, 9), "welded")


def _plastic(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A plastic union (EN ISO 1452-3): two glued sockets and a big nut with ribs or flats for the style."""
    r, n = PIPES[dn].radius, style.round(1.6 * PIPES[dn].radius)
    end, nut = 1.1 * r + 0.012, float(rng.uniform(0.8, 1.2)) * r + 0.015
    length, bore = 2 * end + nut, bore_of(dn, style)
    lip = pick(rng, 1.0, 1.06)
    first = lathe(
        [(1.22 * r * lip, 0.0), (1.22 * r * lip, 0.3 * end), (1.22 * r, 0.3 * end), (1.22 * r, end + 0.5 * nut)],
        n,
        bore,
    )
    second = lathe(
        [(1.6 * r, end + 0.5 * nut), (1.6 * r, end + 1.15 * nut), (1.25 * r, end + 1.15 * nut), (1.22 * r, length)],
        n,
        bore,
    )
    teeth = int(rng.integers(6, 25))
    ring = knurled(1.8 * r + 0.006, teeth, 0.14 * r if teeth < 14 else 0.07 * r, end, end + nut, 1.22 * r, n)
    return Model(_union(first, ring, second, color="handle"), round(length, 9), "welded")


def _dairy(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A dairy union (DIN 11851): a welded liner, a threaded part and a round nut with four or more slots."""
    r, n = PIPES[dn].radius, style.round(1.5 * PIPES[dn].radius)
    end, nut = float(rng.uniform(0.5, 1.0)) * r + 0.01, 0.45 * r + 0.014
    length, bore = 2 * end + nut, bore_of(dn, style)
    first = lathe([(r, 0.0), (r, end - 0.3 * r), (1.2 * r, end), (1.2 * r, end + 0.5 * nut)], n, bore)
    second = lathe(
        [
            (1.35 * r + 0.003, end + 0.5 * nut),
            (1.35 * r + 0.003, end + 1.25 * nut),
            (r, end + 1.5 * nut),
            (r, length + 0.4 * nut),
        ],
        n,
        bore,
    )
    count = int(rng.choice([4, 4, 5, 6]))
    outer = 1.55 * r + 0.008
    slots = notched(outer, count, 0.1 * outer, 0.22, end + 0.12 * nut, end + nut, 1.1 * r, n)
    face = lathe([(0.88 * outer, end), (0.95 * outer, end + 0.12 * nut)], n, 1.1 * r)
    return Model(_union(first, merge([slots, face]), second), round(length + 0.4 * nut, 9), "welded")


def _hammer(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A hammer union (API 6A practice): a wing nut with three heavy lugs on a threaded sub."""
    r, n = PIPES[dn].radius, style.round(1.7 * PIPES[dn].radius)
    end, nut = 1.1 * r + 0.02, 0.9 * r + 0.02
    length, bore = 2 * end + 1.4 * nut, bore_of(dn, style)
    first = lathe([(1.2 * r, 0.0), (1.2 * r, end), (1.45 * r, end + 0.3 * nut), (1.45 * r, end + 0.6 * nut)], n, bore)
    second = lathe(
        [(1.5 * r, end + 0.6 * nut), (1.5 * r, end + 1.25 * nut), (1.2 * r, end + 1.5 * nut), (1.2 * r, length)],
        n,
        bore,
    )
    ring = [
        lathe(
            [(1.6 * r, end - 0.1 * nut), (1.9 * r + 0.005, end + 0.1 * nut), (1.9 * r + 0.005, end + nut)], n, 1.22 * r
        )
    ]
    count = int(rng.choice([2, 3, 3, 4]))
    for k in range(count):
        lug = box((0.8 * nut, 1.1 * r + 0.01, 0.75 * r + 0.008), (end + 0.5 * nut, 2.15 * r + 0.008, 0))
        ring.append(moved(lug, spun("x", 2 * np.pi * k / count + 0.5)))
    return Model(_union(first, merge(ring), second, color="valve"), round(length, 9), "welded")


def _meter(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A flat-faced union (ISO 228-1): a long tail with a flat under a thin nut, a seal, a hexagon male part."""
    r, n = PIPES[dn].radius, style.round(1.4 * PIPES[dn].radius)
    tail, nut, hexa = float(rng.uniform(1.0, 3.0)) * r + 0.015, 0.6 * r + 0.008, 0.5 * r + 0.006
    length, bore = tail + nut + 2 * hexa + 0.01, bore_of(dn, style)
    first = lathe(
        [(1.04 * r, 0.0), (1.04 * r, tail), (1.25 * r, tail + 0.1 * nut), (1.25 * r, tail + 0.3 * nut)], n, bore
    )
    ring = prism(2.9 * r + 0.006, int(rng.choice([6, 6, 8])), tail, tail + nut, 1.1 * r, n)
    seal = lathe([(1.25 * r, tail + 0.3 * nut), (1.25 * r, tail + 0.4 * nut)], n, bore)
    thread = lathe([(1.28 * r, tail + 0.4 * nut), (1.28 * r, tail + nut + hexa)], n, bore)
    flats = prism(2.7 * r + 0.006, 6, tail + nut + 0.003, tail + nut + hexa, 0.95 * r if style.hollow else 0.0, n)
    out = lathe([(1.02 * r, tail + nut + hexa), (r, length)], n, bore)
    parts = _union(first, ring, merge([thread, flats, out]))
    parts.append(Part(seal, "gasket", "gasket", "union"))
    return Model(parts, round(length, 9), "welded")


# --- nipples ---


def _threaded(low: float, high: float, radius: float, count: int, n: int, bore: float) -> Solid:
    """A piece along x with ridges as of a thread."""
    step = (high - low) / count
    shape = []
    for k in range(count):
        shape += [(0.96 * radius, low + k * step), (radius, low + (k + 0.5) * step)]
    return lathe([*shape, (0.96 * radius, high)], n, bore)


def _running(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A long screw: a nipple with threads at both ends, one running on, with a lock nut and a coupling on each side."""
    r, n, bore = PIPES[dn].radius, style.round(1.3 * PIPES[dn].radius), bore_of(dn, style)
    sock, bare = 1.1 * r + 0.014, float(rng.uniform(1.0, 5.0)) * r + 0.02
    thread, nut = 1.4 * r + 0.012, 0.45 * r + 0.006
    length = 2 * sock + 2 * thread + bare
    bore = min(bore, 0.9 * r)
    body = merge(
        [
            _threaded(sock, sock + thread, r, 7, n, bore),
            lathe([(r, sock + thread), (r, sock + thread + bare)], n, bore),
            _threaded(sock + thread + bare, length - sock, r, 7, n, bore),
        ]
    )
    big = 1.28 * r + 0.002
    sleeves = [Part(lathe([(big, a), (big, a + sock)], n, bore), "coupling", "pipe") for a in (0.0, length - sock)]
    lock = prism(2.8 * r + 0.006, int(rng.choice([6, 8])), length - sock - nut, length - sock, 0.99 * r, n)
    return Model(
        [sleeves[0], Part(body, "nipple", "pipe"), Part(lock, "nut", "pipe", "", BOLTED), sleeves[1]],
        round(length, 9),
        "welded",
    )


def _close(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A close nipple, all thread, or a shoulder nipple between two fittings: banded, hexagon or forged sockets."""
    r, n, bore = PIPES[dn].radius, style.round(PIPES[dn].radius), min(bore_of(dn, style), 0.9 * PIPES[dn].radius)
    end, mid = 1.3 * r + 0.016, float(rng.uniform(0.5, 2.5)) * r + 0.01
    length = 2 * end + mid
    design = str(rng.choice(["banded", "hex", "socket"]))
    one = mouth(design, dn, style, 0.0, end)
    screw = _threaded(end, end + mid, r, max(4, int(mid / (0.25 * r + 0.001)) % 12), n, bore)
    if rng.random() < 0.4:
        screw = merge([screw, lathe([(1.15 * r, end + 0.35 * mid), (1.15 * r, end + 0.65 * mid)], n, 0.95 * r)])
    parts = [Part(moved(one, at(end) @ _BACK), "coupling", "pipe"), Part(screw, "nipple", "pipe")]
    return Model([*parts, Part(moved(one, at(length - end)), "coupling", "pipe")], round(length, 9), "welded")


def _barbed(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Two hose nipples with barbs and hexagons, and a short rubber hose between them under worm-drive clips."""
    r, n = PIPES[dn].radius, style.round(1.3 * PIPES[dn].radius)
    hexa, barb = 0.6 * r + 0.008, float(rng.uniform(1.8, 3.0)) * r + 0.02
    gap = float(rng.uniform(0.05, 0.5))
    length = 2 * (2 * hexa + barb) + gap
    ridges = []
    for k in range(4):
        a = 2 * hexa + barb * k / 4
        ridges += [(r, a), (1.08 * r, a + 0.2 * barb)]
    bore = 0.9 * bore_of(dn, style)
    thread = lathe([(1.0 * r, 0.0), (1.0 * r, hexa)], n, bore)
    nut = prism(2.4 * r + 0.005, 6, hexa, 2 * hexa, bore, n)
    one = merge([thread, nut, lathe([*ridges, (0.95 * r, 2 * hexa + barb)], n, bore)])
    low, high, outer = 2 * hexa + 0.15 * barb, length - 2 * hexa - 0.15 * barb, 1.3 * r + 0.003
    hose = lathe([(outer, low), (outer, high)], n, 0.98 * r)
    parts = [
        Part(one, "nipple", "trim"),
        Part(hose, "hose", "rubber"),
        Part(moved(one, at(length) @ _BACK), "nipple", "trim"),
    ]
    clips = [low + 0.4 * barb, high - 0.4 * barb]
    if rng.random() < 0.4:
        clips += [low + 0.75 * barb, high - 0.75 * barb]
    for x in clips:
        band = lathe([(outer + 0.0015, x - 0.006), (outer + 0.0015, x + 0.006)], n, outer)
        screw = merge(
            [
                box((0.014, 0.024, 0.008), (x, 0, outer + 0.005)),
                rod((x, -0.02, outer + 0.007), (x, 0.012, outer + 0.007), 0.0035, 8),
            ]
        )
        parts.append(Part(merge([band, screw]), "clamp", "clamp", "", BOLTED))
    return Model(parts, round(length, 9), "welded")


# --- caps on a pipe's end ---


def _cap(*solids: Solid, color: str = "pipe") -> list[Part]:
    return [Part(solid, "pipe cap", color, "pipe cap") for solid in solids]


def _flat_plate(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A flat plate welded on, wider than the pipe or flush, with a fillet, maybe ribs crosswise or a drain boss."""
    r, n = PIPES[dn].radius, style.round(PIPES[dn].radius)
    thick, wide = 0.005 + float(rng.uniform(0.05, 0.15)) * r, pick(rng, 1.0, 1.1, 1.25) * r
    pieces = [lathe([(wide, 0.0), (wide, thick)], n)]
    if rng.random() < 0.4:
        for turn in (0.0, 0.5):
            pieces.append(
                moved(
                    box((0.25 * r + 0.01, 1.8 * wide, 0.006 + 0.03 * r), (thick + 0.12 * r, 0, 0)),
                    spun("x", turn * np.pi),
                )
            )
    elif rng.random() < 0.5:
        pieces.append(lathe([(0.2 * r + 0.004, thick), (0.2 * r + 0.004, thick + 0.025)], 12))
        pieces.append(prism(0.35 * r + 0.008, 6, thick + 0.025, thick + 0.035))
    return Model(_cap(merge(pieces)))


def _head_plug(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A threaded plug (ASME B16.11) with a square, hexagon or round head in a coupling on the pipe."""
    r, n = PIPES[dn].radius, style.round(1.3 * PIPES[dn].radius)
    sock = float(rng.uniform(1.3, 2.2)) * r + 0.016
    sleeve = lathe([(1.28 * r + 0.002, 0.0), (1.28 * r + 0.002, sock)], n, 0.97 * r if style.hollow else 0.0)
    if rng.random() < 0.4:
        sleeve = mouth("banded", dn, style, 0.0, sock)
    kind, high = int(rng.integers(3)), 0.5 * r + 0.008
    shank = lathe([(0.95 * r, 0.6 * sock), (r, sock + 0.15 * r)], n)
    if kind == 0:
        head = prism(1.15 * r, 4, sock + 0.1 * r, sock + 0.1 * r + high)
    elif kind == 1:
        head = prism(2.25 * r + 0.004, 6, sock + 0.05 * r, sock + high)
    else:
        head = lathe([(1.2 * r, sock + 0.05 * r), (1.2 * r, sock + 1.5 * high)], n)
    return Model([Part(sleeve, "coupling", "pipe"), *_cap(merge([shank, head]))])


def _plastic_cap(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A plastic cap: a glued cup with a flat or domed end, or a screwed one with ribs for the style."""
    r, n = PIPES[dn].radius, style.round(1.2 * PIPES[dn].radius)
    long, outer = float(rng.uniform(0.8, 1.6)) * r + 0.01, 1.2 * r + 0.002
    kind = int(rng.integers(3))
    if kind == 0:
        shape = [
            (1.06 * outer, 0.0),
            (1.06 * outer, 0.15 * long),
            (outer, 0.15 * long),
            (outer, 0.9 * long),
            (0.9 * outer, long),
        ]
        return Model(_cap(lathe(shape, n), color="handle"))
    if kind == 1:
        a = np.linspace(0, 0.45 * np.pi, 5)
        shape = [(outer, 0.0), *((float(outer * np.cos(t)), float(long + 0.5 * outer * np.sin(t))) for t in a)]
        return Model(_cap(lathe(shape, n), color="handle"))
    nut = knurled(1.15 * outer, int(rng.integers(8, 24)), 0.1 * r, 0.0, long, 0.0, n)
    disc = lathe([(0.9 * outer, long), (0.85 * outer, long + 0.08 * r + 0.002)], n)
    return Model(_cap(merge([nut, disc]), color="rubber"))


def _grooved_cap(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A grooved end cap (AWWA C606): a dished disc held by a coupling of two housings."""
    r, n = PIPES[dn].radius, style.round(PIPES[dn].radius)
    long = 0.034 + 0.08 * r
    shape = [(r, 0.0), (r, 0.8 * long), (0.85 * r, long), (0.3 * r, long + 0.08 * r)]
    pieces = [lathe(shape, n)]
    if rng.random() < 0.5:
        pieces.append(prism(0.5 * r + 0.008, 4, long + 0.05 * r, long + 0.3 * r + 0.008))
    return Model([*_cap(merge(pieces)), *grooved(dn, style, at(), bool(rng.random() < 0.5))])


def _malleable_cap(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A malleable cap (EN 10242 T1): a rounded cup with a band, ribs along it or a hexagon on its top."""
    r, n = PIPES[dn].radius, style.round(1.3 * PIPES[dn].radius)
    long, far = 0.9 * r + 0.012, 1.3 * r + 0.003
    shape = [
        (far, 0.0),
        (far, 0.3 * long),
        (1.16 * r, 0.45 * long),
        (1.1 * r, long),
        (0.8 * r, long + 0.3 * r),
        (0.3 * r, long + 0.4 * r),
    ]
    pieces = [lathe(shape, n)]
    if rng.random() < 0.5:
        for k in range(int(rng.choice([2, 4]))):
            pieces.append(moved(box((long, 0.22 * r, 0.25 * r), (0.55 * long, 1.18 * r, 0)), spun("x", k * np.pi / 2)))
    else:
        pieces.append(prism(1.2 * r, 6, long + 0.2 * r, long + 0.75 * r))
    return Model(_cap(merge(pieces)))


def _closure(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A quick-opening closure: a hub with a hinged door, held by a clamp of two halves or by swing bolts."""
    r, n = PIPES[dn].radius, style.round(1.3 * PIPES[dn].radius)
    hub, deep = 1.3 * r + 0.01, 0.5 * r + 0.03
    parts = [
        Part(
            lathe([(1.02 * r, 0.0), (hub, 0.5 * deep), (hub, deep)], n, 0.9 * r if style.hollow else 0.0),
            "flange",
            "flange",
        )
    ]
    thick = 0.02 + 0.15 * r
    door = [
        lathe([(hub, deep), (hub, deep + thick), (0.7 * hub, deep + 1.5 * thick), (0.25 * hub, deep + 1.8 * thick)], n)
    ]
    arm = 1.12 * hub + 0.02
    door.append(box((0.02, arm, 0.5 * hub), (deep + 1.35 * thick, -0.55 * arm, 0)))
    door.append(moved(cylinder(0.016 + 0.03 * r, -0.4 * hub, 0.4 * hub, 10), at(deep + 0.8 * thick, -arm - 0.02)))
    door.append(box((deep + 0.8 * thick, 0.02, 0.6 * hub), (0.5 * deep + 0.4 * thick, -arm + 0.0, 0)))
    door.append(box((0.02, 0.2 * hub + 0.03, 0.6 * hub), (0.6 * deep, -hub - 0.05 * hub, 0)))
    parts += _cap(merge(door), color="tank")
    if rng.random() < 0.5:
        low, high = 0.6 * deep, deep + 0.8 * thick
        half = half_band(hub, 1.12 * hub + 0.008, low, high, n, 0.92 * np.pi)
        parts += [Part(moved(half, spun("x", t)), "clamp", "clamp", "clamp", BOLTED) for t in (0.0, np.pi)]
        grip = at(deep, 1.1 * hub) @ spun("y", -np.pi / 2)
        parts += bolting(1, 0.0, 0.012 + 0.03 * r, -0.3 * hub, 0.3 * hub, style, "clamp", grip)
    else:
        parts += bolting(
            int(rng.choice([4, 6, 8])), hub + 0.01, 0.01 + 0.05 * r, 0.4 * deep, deep + thick, style, "pipe cap"
        )
    return Model(parts)


def _test_plug(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An expanding plug: a rubber ring between two plates in the pipe's mouth, drawn together by a nut."""
    r, n = PIPES[dn].radius, style.round(PIPES[dn].radius)
    thick = 0.006 + 0.06 * r
    rubber = lathe([(1.02 * r, 0.0), (1.1 * r, 0.6 * thick), (1.02 * r, 1.2 * thick)], n)
    plate = lathe([(0.95 * r, 1.2 * thick), (0.95 * r, 2 * thick)], n)
    screw = lathe([(0.1 * r + 0.003, 2 * thick), (0.1 * r + 0.003, 2 * thick + 0.5 * r + 0.02)], 10)
    nut = [prism(0.35 * r + 0.008, 6, 2 * thick, 2 * thick + 0.15 * r + 0.005)]
    if rng.random() < 0.6:
        reach = 0.8 * r + 0.015
        nut.append(box((0.25 * r + 0.01, 2 * reach, 0.006), (2 * thick + 0.3 * r + 0.006, 0, 0)))
    return Model(
        [
            *_cap(rubber, color="rubber"),
            *_cap(merge([plate, screw]), color="trim"),
            Part(merge(nut), "nut", "trim", "pipe cap", BOLTED),
        ]
    )


def _dust_cap(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A cam lever dust cap on an adapter (EN 14420-7), with its two levers and a chain or wire to the pipe."""
    r, n = PIPES[dn].radius, style.round(1.4 * PIPES[dn].radius)
    long, cup, outer = 1.2 * r + 0.02, 1.0 * r + 0.015, 1.45 * r + 0.005
    adapter = lathe([(1.25 * r, 0.0), (1.25 * r, 0.5 * long), (1.12 * r, 0.55 * long), (1.12 * r, long)], n)
    lid = [lathe([(outer, long), (outer, long + cup), (0.8 * outer, long + 1.2 * cup)], n)]
    parts = [Part(adapter, "coupling", "trim")]
    levers = []
    for s in (-1, 1):
        lid.append(box((0.4 * cup, 0.3 * r, 0.6 * r), (long + 0.4 * cup, s * outer, 0)))
        levers.append(box((1.4 * cup, 0.12 * r + 0.003, 0.45 * r), (long + 0.8 * cup, s * (outer + 0.2 * r), 0)))
        levers.append(
            moved(
                torus(0.25 * r + 0.005, 0.003, 12, 6),
                at(long + 1.5 * cup + 0.25 * r, s * (outer + 0.2 * r)) @ spun("x", np.pi / 2),
            )
        )
    t = np.linspace(0, 1, 9)
    sag = [
        (float(0.2 * long + (long + 0.6 * cup) * k), 0.0, float(-1.2 * r - 0.2 * r * k - 0.5 * r * np.sin(np.pi * k)))
        for k in t
    ]
    lid.append(rope(np.array(sag), 0.002, 6))
    parts += [*_cap(merge(lid), color="trim"), Part(merge(levers), "lever", "handle", "pipe cap", "Valve assembly")]
    return Model(parts)


_MIDDLE = tuple(dn for dn in SIZES if dn <= 100)

UNIONS: tuple[Family, ...] = (
    family("union/malleable", _malleable, SMALL, weight=1.0, grain="structure"),
    family("union/forged", _forged, SMALL, weight=1.0, grain="structure"),
    family("union/plastic", _plastic, _MIDDLE, weight=1.0, grain="structure"),
    family("union/dairy", _dairy, _MIDDLE, weight=1.0, grain="structure"),
    family("union/hammer", _hammer, _MIDDLE, grain="structure"),
    family("union/flat face", _meter, SMALL, weight=1.0, grain="structure"),
    family("nipple/running", _running, SMALL, weight=1.0),
    family("nipple/close", _close, SMALL, weight=1.0),
    family("nipple/hose barb", _barbed, SMALL, weight=1.0),
    family("pipe cap/flat plate", _flat_plate, SIZES, "end"),
    family("pipe cap/plug in coupling", _head_plug, SMALL, "end"),
    family("pipe cap/plastic", _plastic_cap, SIZES, "end"),
    family("pipe cap/grooved", _grooved_cap, SIZES[2:], "end"),
    family("pipe cap/malleable", _malleable_cap, SMALL, "end"),
    family("pipe cap/quick closure", _closure, SIZES[5:], "end", 0.7),
    family("pipe cap/expanding plug", _test_plug, SIZES[2:], "end"),
    family("pipe cap/cam lever", _dust_cap, _MIDDLE, "end"),
)
