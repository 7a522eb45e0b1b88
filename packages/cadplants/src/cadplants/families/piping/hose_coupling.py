"""Ends for hoses: claw couplings with a blank cap, sockets of compressed air; and threaded adaptors of plastic."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, whole
from cadplants.builder.table import Table, outline
from cadplants.families.piping.shape import SMALL, Fitting, barrel, knurled, lathe, pipe_x, prism, sized
from cadplants.model.family import Model
from cadplants.model.standards import sizes_between
from cadplants.solids.mesh_ops import Solid, moved
from cadplants.solids.primitives import box, rope, torus
from cadplants.solids.transforms import at, spun

__all__ = ["HOSE_COUPLINGS"]

_ROLL = "how it is turned about the pipe"


def _claws(radius: float, low: float, size: tuple[float, float, float], count: int) -> list[Solid]:
    """Lugs round a ring along x: how far they reach along, out and round [m]."""
    along, out, wide = size
    one = box((along, out, wide), (low + 0.5 * along, radius + 0.3 * out, 0))
    return [moved(one, spun("x", 2 * np.pi * k / count)) for k in range(count)]


class ClawEnd(Fitting, name="coupling/claw end", place="end", sizes=sizes_between(25, 150), weight=1.2):
    """A claw coupling at a line's end (DIN 14307 Storz): a ring with lugs on a spigot, at times with its blank cap."""

    spigot: float = between(0.4, 2.0, "length of its spigot, less 10 mm / radius of the pipe")
    base: str = among(("hexagon", "ring", "none"), "what it is screwed on by")
    ring: float = between(0.3, 0.9, "length of its ring, less 6 mm / radius of the pipe")
    wide: float = between(1.3, 1.7, "radius of its ring / of the pipe")
    lugs: int = among((2, 2, 2, 3), "lugs")
    broad: float = between(0.5, 1.1, "breadth of a lug / radius of the pipe")
    claws: int = among((0, 2, 2), "claws that reach over the face")
    cap: str = among(("none", "none", "flat", "domed", "handled"), "its blank cap")
    held: str = among(("none", "chain", "cord"), "what holds the cap to the pipe", when=lambda p: p.cap != "none")
    roll: float = between(0, 3, _ROLL, "rad")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.4)
        low, long, outer = self.spigot * r + 0.01, self.ring * r + 0.006, self.wide * r
        face, reach, t = low + long, 0.25 * r + 0.006, t.spun("x", self.roll)
        half = [lathe(outline(1.12 * r, 0.0, 1.08 * r, low, outer, low + 0.1 * long, outer, face), n, bore)]
        half += _claws(outer, low + 0.15 * long, (0.7 * long, reach, self.broad * r), self.lugs)
        if self.base == "hexagon":
            half.append(prism(2.5 * r + 0.006, 6, 0.1 * low, 0.5 * low, 1.05 * r, n))
        elif self.base == "ring":
            half.append(barrel(1.35 * r, 0.1 * low, 0.35 * low, n, 1.05 * r))
        if self.claws and self.cap == "none":
            claws = _claws(0.85 * outer, face - 0.1 * long, (0.4 * long, 0.12 * r + 0.003, 0.4 * r), self.claws)
            half += [moved(one, spun("x", 0.5 * np.pi)) for one in claws]
        t.add("coupling", *half, of="trim")
        if self.cap != "none":
            self._cap(t, face, outer, long, reach)
        return t.model()

    def _cap(self, t: Table, face: float, outer: float, long: float, reach: float) -> None:
        """Puts its cap down on a face, and what holds that to the pipe [m]."""
        r, n, _ = sized(t.dn, t.style, 1.4)
        top = face + 0.6 * long
        shape = outline(outer, face, outer, top - 0.1 * long, 0.9 * outer, top)
        if self.cap == "domed":
            shape += outline(0.6 * outer, top + 0.15 * r, 0.25 * outer, top + 0.2 * r)
        solids = [lathe(shape, n), *_claws(outer, face + 0.05 * long, (0.4 * long, reach, self.broad * r), self.lugs)]
        if self.cap == "handled":
            solids.append(box((0.4 * r, 1.4 * outer, 0.15 * r + 0.003), (top + 0.15 * r, 0, 0)))
        if self.held != "none":
            k = np.linspace(0, 1, 9)
            xs, hang = 0.2 * face + (top - 0.3 * long - 0.2 * face) * k, -1.1 * r - (outer - 1.1 * r) * k
            path = np.column_stack([xs, 0 * k, hang - (0.5 * r + 0.5 * face) * np.sin(np.pi * k)])
            held = [rope(path, 0.0025, 6)]
            if self.held == "chain":
                turns = zip((0.0, 1.6) * 4, path[1:], strict=True)
                held += [moved(torus(0.005, 0.0015, 8, 5), at(*map(float, one)) @ spun("x", s)) for s, one in turns]
            # It hangs, however the cap is turned.
            solids += [moved(one, spun("x", -self.roll)) for one in held]
        t.add("pipe cap", *solids, of="trim")


class AirSocket(Fitting, name="coupling/air socket", place="end", sizes=SMALL[:4], weight=1.5):
    """A socket for compressed air at a line's end (ISO 6150): a hexagon, a body, a sliding sleeve, at times a plug."""

    six: float = between(0.5, 1.1, "length of its hexagon, less 4 mm / radius of the pipe")
    flats: float = between(2.2, 3.0, "across its flats / radius of the pipe")
    body: float = between(0.8, 2.4, "length of its body, less 6 mm / radius of the pipe")
    slim: float = between(0.9, 1.25, "radius of its body / of the pipe")
    sleeve: float = between(0.9, 2.0, "length of its sleeve, less 6 mm / radius of the pipe")
    wide: float = between(1.2, 1.7, "radius of its sleeve / of the pipe")
    make: str = among(("plain", "ribbed", "knurled", "waisted"), "how its sleeve is made")
    teeth: int = whole(10, 24, "teeth of the knurling", when=lambda p: p.make == "knurled")
    plug: str = among(("none", "none", "plug", "hose"), "what is in it")
    hose: float = between(0.05, 0.4, "length of the hose on the plug", "m", when=lambda p: p.plug == "hose")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.5)
        six, body, sleeve = self.six * r + 0.004, self.body * r + 0.006, self.sleeve * r + 0.006
        slim, bore, low = self.slim * r, min(bore, 0.8 * r), 0.3 * six
        neck = barrel(0.95 * r, 0.0, low, n, bore)
        far = low + six + body
        trunk = lathe(outline(1.05 * slim, low + six, slim, low + six + 0.2 * body, slim, far + 0.5 * sleeve), n, bore)
        t.add(
            "coupling",
            neck,
            prism(self.flats * r, 6, low, low + six, bore, n),
            trunk,
            self._sleeve(n, r, far, sleeve),
            of="trim",
        )
        if self.plug != "none":
            self._plugged(t, far + sleeve)
        return t.model()

    def _sleeve(self, n: int, r: float, low: float, long: float) -> Solid:
        """The sleeve from a place on [m]."""
        wide, high, bore = self.wide * r, low + long, 0.85 * r
        if self.make == "knurled":
            return knurled(wide, self.teeth, 0.12 * r, low, high, bore, n)
        if self.make == "ribbed":
            shape = [(wide, low)]
            for k in (0.2, 0.45, 0.7):
                shape += outline(
                    wide, low + k * long, 0.9 * wide, low + (k + 0.03) * long, 0.9 * wide, low + (k + 0.1) * long
                )
                shape.append((wide, low + (k + 0.13) * long))
            return lathe([*shape, (wide, high)], n, bore)
        if self.make == "waisted":
            thin = 0.85 * wide
            return lathe(outline(wide, low, thin, low + 0.3 * long, thin, high - 0.3 * long, wide, high), n, bore)
        return lathe(
            outline(0.92 * wide, low, wide, low + 0.1 * long, wide, high - 0.1 * long, 0.92 * wide, high), n, bore
        )

    def _plugged(self, t: Table, face: float) -> None:
        """Puts a plug down in its mouth, at times with a hose [m]."""
        r, n, _ = sized(t.dn, t.style, 1.5)
        a, b, c = face, face + 0.5 * r, face + 1.2 * r + 0.004
        t.add("nipple", lathe(outline(0.8 * r, a - 0.5 * r, 0.8 * r, b), n), prism(2.1 * r, 6, b, c), of="trim")
        if self.plug == "hose":
            t.add("hose", barrel(1.0 * r, c, c + self.hose, n))
        else:
            t.add(
                "nipple",
                lathe(outline(0.7 * r, c, 0.8 * r, c + 0.4 * r, 0.7 * r, c + 0.5 * r, 0.8 * r, c + r), n),
                of="trim",
            )


class PlasticAdaptor(Fitting, name="nipple/plastic adaptor", sizes=sizes_between(most=100), weight=1.0):
    """A threaded adaptor of plastic: a socket, a hexagon or octagon and a thread, on a pipe and in a coupling."""

    socket: float = between(0.7, 1.8, "length of its socket, less 6 mm / radius of the pipe")
    wide: float = between(1.15, 1.4, "radius of its socket / of the pipe")
    flats: int = among((6, 6, 8), "sides of its middle")
    broad: float = between(2.6, 3.2, "across its flats / radius of the pipe")
    six: float = between(0.35, 0.9, "length of its middle, less 3 mm / radius of the pipe")
    thread: float = between(0.7, 1.5, "length of its thread, less 6 mm / radius of the pipe")
    waved: bool = chance(0.4, "the thread is drawn as ridges")
    coupled: bool = chance(0.5, "its thread is in a coupling")

    def build(self, t: Table) -> Model:
        r, n, bore = sized(t.dn, t.style, 1.3)
        a = self.socket * r + 0.006
        b = a + self.six * r + 0.003
        length, bore = b + self.thread * r + 0.006, min(bore, 0.85 * r)
        collar = lathe(outline(self.wide * r, 0.0, 0.97 * self.wide * r, a), n, bore)
        ridges = outline(r, b, r, length)
        if self.waved:
            steps = np.linspace(b, length, 13)
            ridges = [((1.0, 0.95)[k % 2] * r, float(x)) for k, x in enumerate(steps)]
        t.add("nipple", collar, prism(self.broad * r, self.flats, a, b, bore, n), lathe(ridges, n, bore))
        if self.coupled:
            big, begin = 1.3 * r + 0.001, b + 0.15 * (length - b)
            t.add(
                "coupling", barrel(big, begin, 2 * length - begin, n, 0.999 * r if t.style.hollow else 0.0), of="pipe"
            )
            t.add("pipe", pipe_x(t.dn, length, 2 * length, t.style))
            length = 2 * length
        return t.model(round(length, 9), "welded", split=True)


HOSE_COUPLINGS = families_of(ClawEnd, AirSocket, PlasticAdaptor)
