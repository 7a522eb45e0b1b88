"""Unions, nipples and caps of further makes."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, whole
from cadplants.builder.table import Table, outline
from cadplants.families.piping.coupling import half_band
from cadplants.families.piping.shape import (
    BACK,
    SMALL,
    UP,
    Fitting,
    barrel,
    bolting,
    grooved,
    knurled,
    lathe,
    mouth,
    notched,
    prism,
    sized,
)
from cadplants.model.family import Model
from cadplants.model.standards import SIZES, sizes_between
from cadplants.solids.mesh_ops import Solid, merge, moved
from cadplants.solids.primitives import BOTH, box, cylinder, rod, rope, torus
from cadplants.solids.transforms import at, spun

__all__ = ["UNIONS"]


class _Union(Fitting, bundle="union", weight=1.0, grain="structure"):
    """A union: two ends and a nut between them."""

    def put(self, t: Table, length: float, *solids: Solid, of: str = "trim") -> Model:
        """Puts its pieces down and says how long it is [m]."""
        for solid in solids:
            t.add("union", solid, of=of)
        return t.model(round(length, 9), "welded")


class Malleable(_Union, name="union/malleable", sizes=SMALL):
    """A malleable union (EN 10242 U1): two banded or octagon ends and an octagon or hexagon nut with a collar."""

    corners: int = among((6, 8, 8), "flats of its nut")
    ends: str = among(("banded", "octagon"), "how its ends are made")
    flats: float = between(3.1, 3.5, "width of its nut across flats, less 12 mm / radius of the pipe")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.5)
        end, nut, bored = 0.9 * r + 0.014, 0.8 * r + 0.01, 0.98 * r if t.style.hollow else 0.0
        length, deep, flats = 2 * end + nut, 1.2 * end, self.flats * r + 0.012
        one = prism(2.4 * r + 0.008, 8, 0.0, deep, bored, n)
        if self.ends == "banded":
            one = mouth("banded", t.dn, t.style, 0.0, deep)
        ring = prism(flats, self.corners, end, end + 0.75 * nut, 1.1 * r, n)
        collar = lathe(outline(0.5 * flats, end + 0.75 * nut, 0.42 * flats, end + nut), n, 1.1 * r)
        first, second = moved(one, at(deep) @ BACK), moved(one, at(length - deep))
        return self.put(t, length, first, merge([ring, collar]), second)


class Forged(_Union, name="union/forged", sizes=SMALL):
    """A forged union of class 3000 (MSS SP-83): round sockets with shoulders under a heavy hexagon nut."""

    end: float = between(0.9, 1.4, "length of an end, less 12 mm / radius of the pipe")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.5)
        end, nut, sock, wide = self.end * r + 0.012, 0.9 * r + 0.012, 1.36 * r + 0.003, 1.5 * r + 0.004
        length, mid, far = 2 * end + nut, end + 0.4 * nut, end + nut
        first = lathe(outline(sock, 0.0, sock, end - 0.1 * r, wide, end, wide, mid), n, bore)
        second = lathe(outline(1.5 * r, mid, 1.5 * r, far, sock, end + 1.2 * nut, sock, length), n, bore)
        lip = lathe(outline(1.7 * r + 0.004, end - 0.25 * r, 1.9 * r + 0.004, end), n, sock)
        ring = merge([prism(3.9 * r + 0.012, 6, end, far, 1.45 * r, n), lip])
        return self.put(t, length, first, ring, second, of="pipe")


class Plastic(_Union, name="union/plastic", sizes=sizes_between(most=100)):
    """A plastic union (EN ISO 1452-3): two glued sockets and a big nut with ribs or flats for the style."""

    nut: float = between(0.8, 1.2, "length of its nut, less 15 mm / radius of the pipe")
    lip: float = among((1.0, 1.06), "radius of the socket's lip / of the socket")
    teeth: int = whole(6, 24, "ribs of its nut")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.6)
        end, nut, wide, teeth = 1.1 * r + 0.012, self.nut * r + 0.015, 1.22 * r, self.teeth
        length, mid, far, lip = 2 * end + nut, end + 0.5 * nut, end + 1.15 * nut, wide * self.lip
        first = lathe(outline(lip, 0.0, lip, 0.3 * end, wide, 0.3 * end, wide, mid), n, bore)
        second = lathe(outline(1.6 * r, mid, 1.6 * r, far, 1.25 * r, far, wide, length), n, bore)
        ring = knurled(1.8 * r + 0.006, teeth, 0.14 * r if teeth < 14 else 0.07 * r, end, end + nut, wide, n)
        return self.put(t, length, first, ring, second, of="handle")


class Dairy(_Union, name="union/dairy", sizes=sizes_between(most=100)):
    """A dairy union (DIN 11851): a welded liner, a threaded part and a round nut with four or more slots."""

    end: float = between(0.5, 1.0, "length of an end, less 10 mm / radius of the pipe")
    slots: int = among((4, 4, 5, 6), "slots of its nut")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.5)
        end, nut, wide, outer = self.end * r + 0.01, 0.45 * r + 0.014, 1.35 * r + 0.003, 1.55 * r + 0.008
        length, mid = 2 * end + 1.4 * nut, end + 0.5 * nut
        first = lathe(outline(r, 0.0, r, end - 0.3 * r, 1.2 * r, end, 1.2 * r, mid), n, bore)
        second = lathe(outline(wide, mid, wide, end + 1.25 * nut, r, end + 1.5 * nut, r, length), n, bore)
        slots = notched(outer, self.slots, 0.1 * outer, 0.22, end + 0.12 * nut, end + nut, 1.1 * r, n)
        face = lathe(outline(0.88 * outer, end, 0.95 * outer, end + 0.12 * nut), n, 1.1 * r)
        return self.put(t, length, first, merge([slots, face]), second)


class Hammer(_Union, name="union/hammer", sizes=sizes_between(most=100), weight=0.5):
    """A hammer union (API 6A practice): a wing nut with three heavy lugs on a threaded sub."""

    lugs: int = among((2, 3, 3, 4), "lugs of its nut")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.7)
        end, nut, thin, mid, wide = 1.1 * r + 0.02, 0.9 * r + 0.02, 1.2 * r, 1.45 * r, 1.9 * r + 0.005
        length, seam = 2 * end + 1.4 * nut, end + 0.6 * nut
        first = lathe(outline(thin, 0.0, thin, end, mid, end + 0.3 * nut, mid, seam), n, bore)
        far = outline(1.5 * r, seam, 1.5 * r, end + 1.25 * nut, thin, end + 1.5 * nut, thin, length)
        ring = [lathe(outline(1.6 * r, end - 0.1 * nut, wide, end + 0.1 * nut, wide, end + nut), n, 1.22 * r)]
        lug = box((0.8 * nut, 1.1 * r + 0.01, 0.75 * r + 0.008), (end + 0.5 * nut, 2.15 * r + 0.008, 0))
        ring += [moved(lug, spun("x", 2 * np.pi * k / self.lugs + 0.5)) for k in range(self.lugs)]
        return self.put(t, length, first, merge(ring), lathe(far, n, bore), of="valve")


class FlatFace(_Union, name="union/flat face", sizes=SMALL):
    """A flat-faced union (ISO 228-1): a long tail with a flat under a thin nut, a seal, a hexagon male part."""

    tail: float = between(1.0, 3.0, "length of its tail, less 15 mm / radius of the pipe")
    flats: int = among((6, 6, 8), "flats of its nut")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.4)
        tail, nut, six, a, b = self.tail * r + 0.015, 0.6 * r + 0.008, 0.5 * r + 0.006, 1.04 * r, 1.25 * r
        length, far = tail + nut + 2 * six + 0.01, tail + nut + six
        first = lathe(outline(a, 0.0, a, tail, b, tail + 0.1 * nut, b, tail + 0.3 * nut), n, bore)
        ring = prism(2.9 * r + 0.006, self.flats, tail, tail + nut, 1.1 * r, n)
        thread = barrel(1.28 * r, tail + 0.4 * nut, far, n, bore)
        flats = prism(2.7 * r + 0.006, 6, tail + nut + 0.003, far, 0.95 * r if t.style.hollow else 0.0, n)
        out = lathe(outline(1.02 * r, far, r, length), n, bore)
        model = self.put(t, length, first, ring, merge([thread, flats, out]))
        t.add("gasket", barrel(b, tail + 0.3 * nut, tail + 0.4 * nut, n, bore))
        return model


# --- nipples ---


def _threaded(low: float, high: float, radius: float, count: int, n: int, bore: float) -> Solid:
    """A piece along x with ridges as of a thread."""
    step = (high - low) / count
    shape = []
    for k in range(count):
        shape += [(0.96 * radius, low + k * step), (radius, low + (k + 0.5) * step)]
    return lathe([*shape, (0.96 * radius, high)], n, bore)


class Running(Fitting, name="nipple/running", sizes=SMALL, weight=1.0):
    """A long screw: a nipple with threads at both ends, one running on, with a lock nut and a coupling on each side."""

    bare: float = between(1.0, 5.0, "length between its threads, less 20 mm / radius of the pipe")
    flats: int = among((6, 8), "flats of its lock nut")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.3)
        sock, bare, thread, nut = 1.1 * r + 0.014, self.bare * r + 0.02, 1.4 * r + 0.012, 0.45 * r + 0.006
        length, bore, a, b = 2 * sock + 2 * thread + bare, min(bore, 0.9 * r), sock + thread, sock + thread + bare
        far, big = length - sock, 1.28 * r + 0.002
        t.add("coupling", barrel(big, 0.0, sock, n, bore), of="pipe")
        screws = [_threaded(x, y, r, 7, n, bore) for x, y in ((sock, a), (b, far))]
        t.add("nipple", screws[0], barrel(r, a, b, n, bore), screws[1])
        lock = prism(2.8 * r + 0.006, self.flats, far - nut, far, 0.99 * r, n)
        t.add("nut", lock, of="pipe", own=False, fine=False)
        t.add("coupling", barrel(big, far, length, n, bore), of="pipe")
        return t.model(round(length, 9), "welded")


class Close(Fitting, name="nipple/close", sizes=SMALL, weight=1.0):
    """A close nipple, all thread, or a shoulder nipple between two fittings: banded, hexagon or forged sockets."""

    mid: float = between(0.5, 2.5, "length between the fittings, less 10 mm / radius of the pipe")
    design: str = among(("banded", "hex", "socket"), "how the fittings are made")
    shouldered: bool = chance(0.4, "a shoulder round its middle")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style)
        end, mid, bore = 1.3 * r + 0.016, self.mid * r + 0.01, min(bore, 0.9 * r)
        length, one = 2 * end + mid, mouth(self.design, t.dn, t.style, 0.0, end)
        t.at(end).moved(BACK).add("coupling", one, of="pipe")
        screw = [_threaded(end, end + mid, r, max(4, int(mid / (0.25 * r + 0.001)) % 12), n, bore)]
        if self.shouldered:
            screw.append(barrel(1.15 * r, end + 0.35 * mid, end + 0.65 * mid, n, 0.95 * r))
        t.add("nipple", *screw)
        t.at(length - end).add("coupling", one, of="pipe")
        return t.model(round(length, 9), "welded")


class HoseBarb(Fitting, name="nipple/hose barb", sizes=SMALL, weight=1.0):
    """Two hose nipples with barbs and hexagons, and a short rubber hose between them under worm-drive clips."""

    barb: float = between(1.8, 3.0, "length of its barbs, less 20 mm / radius of the pipe")
    gap: float = between(0.05, 0.5, "between the nipples", "m")
    paired: bool = chance(0.4, "two clips on each nipple, not one")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.3)
        six, barb, bore, outer = 0.6 * r + 0.008, self.barb * r + 0.02, 0.9 * bore, 1.3 * r + 0.003
        length, start = 2 * (2 * six + barb) + self.gap, 2 * six
        ridges = []
        for k in range(4):
            a = start + barb * k / 4
            ridges += [(r, a), (1.08 * r, a + 0.2 * barb)]
        nut = prism(2.4 * r + 0.005, 6, six, start, bore, n)
        one = [barrel(r, 0.0, six, n, bore), nut, lathe([*ridges, (0.95 * r, start + barb)], n, bore)]
        low, high = start + 0.15 * barb, length - start - 0.15 * barb
        t.add("nipple", *one, of="trim")
        t.add("hose", barrel(outer, low, high, n, 0.98 * r))
        t.at(length).moved(BACK).add("nipple", *one, of="trim")
        for share in (0.4, 0.75) if self.paired else (0.4,):
            for x in (low + share * barb, high - share * barb):
                band = barrel(outer + 0.0015, x - 0.006, x + 0.006, n, outer)
                screw = rod((x, -0.02, outer + 0.007), (x, 0.012, outer + 0.007), 0.0035, 8)
                t.add("clamp", band, box((0.014, 0.024, 0.008), (x, 0, outer + 0.005)), screw)
        return t.model(round(length, 9), "welded")


# --- caps on a pipe's end ---


class _Cap(Fitting, place="end", bundle="pipe cap"):
    """A cap on a pipe's end."""


class FlatPlate(_Cap, name="pipe cap/flat plate"):
    """A flat plate welded on, wider than the pipe or flush, with a fillet, maybe ribs crosswise or a drain boss."""

    thick: float = between(0.05, 0.15, "its thickness, less 5 mm / radius of the pipe")
    wide: float = among((1.0, 1.1, 1.25), "radius of the plate / of the pipe")
    ribbed: bool = chance(0.4, "ribs crosswise on it")
    drained: bool = chance(0.5, "a drain boss on it", when=lambda p: not p.ribbed)

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style)
        thick, wide = 0.005 + self.thick * r, self.wide * r
        pieces = [barrel(wide, 0.0, thick, n)]
        if self.ribbed:
            rib = box((0.25 * r + 0.01, 1.8 * wide, 0.006 + 0.03 * r), (thick + 0.12 * r, 0, 0))
            pieces += [rib, moved(rib, spun("x", np.pi / 2))]
        if self.drained:
            top = thick + min(0.025, 0.006 + 0.4 * r)
            pieces.append(barrel(0.2 * r + 0.003, thick, top, 12))
            pieces.append(prism(0.4 * r + 0.008, 6, top, top + 0.2 * r + 0.004))
        t.add("pipe cap", *pieces)
        return t.model()


class PlugInCoupling(_Cap, name="pipe cap/plug in coupling", sizes=SMALL):
    """A threaded plug (ASME B16.11) with a square, hexagon or round head in a coupling on the pipe."""

    sock: float = between(1.3, 2.2, "length of the coupling, less 16 mm / radius of the pipe")
    banded: bool = chance(0.4, "a band round the coupling's mouth")
    head: str = among(("square", "hexagon", "round"), "head of the plug")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.3)
        sock, high, bored = self.sock * r + 0.016, 0.5 * r + 0.008, 0.97 * r if t.style.hollow else 0.0
        banded = mouth("banded", t.dn, t.style, 0.0, sock)
        sleeve = banded if self.banded else barrel(1.28 * r + 0.002, 0.0, sock, n, bored)
        t.add("coupling", sleeve, of="pipe", own=False)
        head = {
            "square": prism(1.15 * r, 4, sock + 0.1 * r, sock + 0.1 * r + high),
            "hexagon": prism(2.25 * r + 0.004, 6, sock + 0.05 * r, sock + high),
            "round": barrel(1.2 * r, sock + 0.05 * r, sock + 1.5 * high, n),
        }[self.head]
        t.add("pipe cap", lathe(outline(0.95 * r, 0.6 * sock, r, sock + 0.15 * r), n), head)
        return t.model()


class PlasticCap(_Cap, name="pipe cap/plastic"):
    """A plastic cap: a glued cup with a flat or domed end, or a screwed one with ribs for the style."""

    long: float = between(0.8, 1.6, "its length, less 10 mm / radius of the pipe")
    form: str = among(("flat", "domed", "screwed"), "how it is made")
    teeth: int = whole(8, 23, "ribs of a screwed one", when=lambda p: p.form == "screwed")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.2)
        long, outer = self.long * r + 0.01, 1.2 * r + 0.002
        if self.form == "screwed":
            disc = lathe(outline(0.9 * outer, long, 0.85 * outer, long + 0.08 * r + 0.002), n)
            t.add("pipe cap", knurled(1.15 * outer, self.teeth, 0.1 * r, 0.0, long, 0.0, n), disc, of="rubber")
            return t.model()
        lip, a = 1.06 * outer, np.linspace(0, 0.45 * np.pi, 5)
        shape = outline(lip, 0.0, lip, 0.15 * long, outer, 0.15 * long, outer, 0.9 * long, 0.9 * outer, long)
        if self.form == "domed":
            dome = [(float(outer * np.cos(x)), float(long + 0.5 * outer * np.sin(x))) for x in a]
            shape = [(outer, 0.0), *dome]
        t.add("pipe cap", lathe(shape, n), of="handle")
        return t.model()


class GroovedCap(_Cap, name="pipe cap/grooved", sizes=SIZES[2:]):
    """A grooved end cap (AWWA C606): a dished disc held by a coupling of two housings."""

    plugged: bool = chance(0.5, "a square plug in it")
    ribbed: bool = chance(0.5, "ribs round the coupling's housings")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style)
        long = 0.034 + 0.08 * r
        pieces = [lathe(outline(r, 0.0, r, 0.8 * long, 0.85 * r, long, 0.3 * r, long + 0.08 * r), n)]
        if self.plugged:
            pieces.append(prism(0.5 * r + 0.008, 4, long + 0.05 * r, long + 0.3 * r + 0.008))
        t.add("pipe cap", *pieces)
        t.extend(grooved(t.dn, t.style, at(), self.ribbed))
        return t.model()


class MalleableCap(_Cap, name="pipe cap/malleable", sizes=SMALL):
    """A malleable cap (EN 10242 T1): a rounded cup with a band, ribs along it or a hexagon on its top."""

    ribbed: bool = chance(0.5, "ribs along it, not a hexagon on its top")
    ribs: int = among((2, 4), "ribs", when=lambda p: p.ribbed, otherwise=0)

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.3)
        long, far = 0.9 * r + 0.012, 1.3 * r + 0.003
        shape = outline(far, 0.0, far, 0.3 * long, 1.16 * r, 0.45 * long, 1.1 * r, long, 0.8 * r, long + 0.3 * r)
        rib = box((long, 0.22 * r, 0.25 * r), (0.55 * long, 1.18 * r, 0))
        more = [moved(rib, spun("x", k * np.pi / 2)) for k in range(self.ribs)]
        if not self.ribbed:
            more = [prism(1.2 * r, 6, long + 0.2 * r, long + 0.75 * r)]
        t.add("pipe cap", lathe([*shape, (0.3 * r, long + 0.4 * r)], n), *more)
        return t.model()


class QuickClosure(_Cap, name="pipe cap/quick closure", sizes=SIZES[5:], weight=0.7):
    """A quick-opening closure: a hub with a hinged door, held by a clamp of two halves or by swing bolts."""

    clamped: bool = chance(0.5, "a clamp holds it, not swing bolts")
    bolts: int = among((4, 6, 8), "swing bolts", when=lambda p: not p.clamped, otherwise=0)

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.3)
        hub, deep, thick, bored = 1.3 * r + 0.01, 0.5 * r + 0.03, 0.02 + 0.15 * r, 0.9 * r if t.style.hollow else 0.0
        arm, far, plate = 1.12 * hub + 0.02, deep + thick, 0.006 + 0.05 * r
        t.add("flange", lathe(outline(1.02 * r, 0.0, hub, 0.5 * deep, hub, deep), n, bored), own=False)
        door = outline(hub, deep, hub, far, 0.7 * hub, deep + 1.5 * thick, 0.25 * hub, deep + 1.8 * thick)
        t.add(
            "pipe cap",
            lathe(door, n),
            box((plate, arm, 0.5 * hub), (deep + 1.35 * thick, -0.55 * arm, 0)),
            moved(cylinder(0.008 + 0.05 * r, -0.4 * hub, 0.4 * hub, 10), at(deep + 1.1 * thick, -arm)),
            box((0.55 * deep + 1.1 * thick, plate, 0.5 * hub), (0.725 * deep + 0.55 * thick, -arm, 0)),
            box((plate, 0.2 * hub + 0.03, 0.5 * hub), (0.6 * deep, -hub - 0.05 * hub, 0)),
            of="tank",
        )
        if self.clamped:
            half = half_band(hub, 1.12 * hub + 0.008, 0.6 * deep, deep + 0.8 * thick, n, 0.92 * np.pi)
            for turn in (0.0, np.pi):
                t.bundled("clamp").spun("x", turn).add("clamp", half, own=True)
            grip = at(deep, 1.1 * hub) @ UP
            t.extend(bolting(1, 0.0, 0.012 + 0.03 * r, -0.3 * hub, 0.3 * hub, t.style, "clamp", grip))
        else:
            # Each swings in a lug of the hub and lies in one of the door.
            thread = 0.006 + 0.05 * r
            out, lug = hub + 1.2 * thread, (2.4 * thread, 2 * thread)
            for name, low, high in (("flange", 0.6 * deep, 0.98 * deep), ("pipe cap", deep, far)):
                one = box((high - low, *lug), ((low + high) / 2, hub + 0.9 * thread, 0))
                turns = [(2 * k + 1) * np.pi / self.bolts for k in range(self.bolts)]
                t.add(name, *(moved(one, spun("x", turn)) for turn in turns), of="tank", own=name == "pipe cap")
            t.extend(bolting(self.bolts, out, thread, 0.6 * deep, far, t.style, "pipe cap"))
        return t.model()


class ExpandingPlug(_Cap, name="pipe cap/expanding plug", sizes=SIZES[2:]):
    """An expanding plug: a rubber ring between two plates in the pipe's mouth, drawn together by a nut."""

    winged: bool = chance(0.6, "wings on its nut")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style)
        thick = 0.006 + 0.06 * r
        low, reach = 2 * thick, 0.8 * r + 0.015
        ring = outline(1.02 * r, 0.0, 1.1 * r, 0.6 * thick, 1.02 * r, 1.2 * thick)
        t.add("pipe cap", lathe(ring, n), of="rubber")
        screw = barrel(0.1 * r + 0.003, low, low + 0.5 * r + 0.02, 10)
        t.add("pipe cap", barrel(0.95 * r, 1.2 * thick, low, n), screw, of="trim")
        nut = [prism(0.35 * r + 0.008, 6, low, low + 0.15 * r + 0.005)]
        if self.winged:
            nut.append(box((0.25 * r + 0.01, 2 * reach, 0.006), (low + 0.3 * r + 0.006, 0, 0)))
        t.add("nut", *nut, of="trim", fine=False, own=True)
        return t.model()


class DustCap(_Cap, name="pipe cap/cam lever", sizes=sizes_between(most=100)):
    """A cam lever dust cap on an adapter (EN 14420-7), with its two levers and a chain or wire to the pipe."""

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.4)
        long, cup, outer, wide = 1.2 * r + 0.02, 1.0 * r + 0.015, 1.45 * r + 0.005, 1.25 * r
        adapter = outline(wide, 0.0, wide, 0.5 * long, 1.12 * r, 0.55 * long, 1.12 * r, long)
        t.add("coupling", lathe(adapter, n), of="trim", own=False)
        lid = [lathe(outline(outer, long, outer, long + cup, 0.8 * outer, long + 1.2 * cup), n)]
        lid += [box((0.4 * cup, 0.3 * r, 0.6 * r), (long + 0.4 * cup, s * outer, 0)) for s in BOTH]
        k = np.linspace(0, 1, 9)
        hang = -1.2 * r - 0.2 * r * k - 0.5 * r * np.sin(np.pi * k)
        lid.append(rope(np.column_stack([0.2 * long + (long + 0.6 * cup) * k, 0 * k, hang]), 0.002, 6))
        t.add("pipe cap", *lid, of="trim")
        levers = []
        for y in (-outer - 0.2 * r, outer + 0.2 * r):
            finger = at(long + 1.5 * cup + 0.25 * r, y) @ spun("x", np.pi / 2)
            levers.append(box((1.4 * cup, 0.12 * r + 0.003, 0.45 * r), (long + 0.8 * cup, y, 0)))
            levers.append(moved(torus(0.25 * r + 0.005, 0.003, 12, 6), finger))
        t.add("lever", *levers, own=True)
        return t.model()


UNIONS = families_of(
    Malleable, Forged, Plastic, Dairy, Hammer, FlatFace, Running, Close, HoseBarb, FlatPlate, PlugInCoupling,
    PlasticCap, GroovedCap, MalleableCap, QuickClosure, ExpandingPlug, DustCap,
)  # fmt: skip
