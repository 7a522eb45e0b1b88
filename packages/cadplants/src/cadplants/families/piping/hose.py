"""Hoses of further makes: between pipes, hanging, spiral, on a reel."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.draws import number
from cadplants.builder.params import among, between, given, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.piping.shape import (
    BACK,
    Fitting,
    barrel,
    knurled,
    lathe,
    parts_of,
    pipe_x,
    prism,
    sized,
)
from cadplants.model.family import Model
from cadplants.model.standards import SIZES, sizes_between
from cadplants.parts.flange import flange, flange_length
from cadplants.solids.mesh_ops import Solid, moved
from cadplants.solids.polygon import circle
from cadplants.solids.primitives import box, lofted, rod, rope, torus
from cadplants.solids.transforms import at, spun

__all__ = ["HOSES"]

_SKINS, _SKIN = ("smooth", "spiral", "corrugated"), "its outside"
_ENDS, _END = ("flange", "hexagon", "cam lever"), "what it is held by"


def _along(path: Floats, radii: Floats, n: int) -> Solid:
    """A round skin of changing radius along a way in the plane of x and z."""
    tangents = np.gradient(path, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    side = np.array([0.0, 1.0, 0.0])
    ring = circle(1.0, n)
    loops = [
        p + r * (np.outer(ring[:, 0], side) + np.outer(ring[:, 1], np.cross(t, side)))
        for p, r, t in zip(path, radii, tangents, strict=True)
    ]
    return lofted(loops)


def _skin(count: int, r: float, made: str) -> Floats:
    """Radii along a hose: smooth, ribbed by a spiral, or corrugated."""
    high = {"smooth": 0.0, "spiral": 0.05, "corrugated": 0.1}[made]
    return r * (1.0 + high * np.where(np.arange(count) % 2 == 0, 1.0, -1.0))


def _held(t: Table, design: str) -> float:
    """Puts down what a hose is held by, from x = 0: a flange on a neck, a hexagon with a sleeve, a cam lever half.

    Returns where the hose begins in it [m].
    """
    r, n, bore = sized(t.dn, t.style, 1.3)
    sleeve, wide = 1.2 * r + 0.02, 1.22 * r
    if design == "flange":
        seat = flange_length(t.dn, t.style)
        t.extend(parts_of(flange(t.dn, t.style)))
        end = outline(wide, seat, wide, seat + sleeve)
    elif design == "hexagon":
        six, big = 0.7 * r + 0.01, 1.3 * r
        seat = 1.3 * six
        t.add("union", prism(2.6 * r + 0.005, 6, 0.0, six, bore, n), barrel(1.05 * r, 0.9 * six, 1.4 * six, n, bore))
        end = outline(big, seat, big, seat + 0.3 * sleeve, wide, seat + 0.3 * sleeve, wide, seat + sleeve)
    else:
        seat = 1.1 * r + 0.02
        end = outline(1.5 * r, 0.0, 1.5 * r, seat, wide, seat + 0.2 * r, wide, seat + sleeve)
    t.add("coupling", lathe(end, n, bore), of="trim")
    if design == "cam lever":
        arm = (1.5 * seat, 0.15 * r + 0.002, 0.5 * r)
        t.add("lever", *(box(arm, (seat, s * 1.6 * r, 0)) for s in (-1, 1)))
    return seat + 0.5 * sleeve


class _Between(Fitting, weight=1.0):
    """A hose in a line between two like ends, sagging or straight."""

    sagging: float = given(0.0, "how far it sags / as far as it can")
    end: str = among(_ENDS, _END)
    span: float = between(5, 16, "length, less 0.1 m / radius of the pipe")
    skin: str = among(_SKINS, _SKIN)
    drop: float = between(0.1, 0.5, "how far it could sag / its length", when=lambda p: p.sagging)
    of: str = among(("rubber", "trim", "handle"), "kind of material")
    # A flange meets the counter-flange that the line brings along, no bare pipe.
    lead: float = among(
        (0.0, 0.06), "length of the pipe before and behind it", "m", when=lambda p: p.end != "flange", otherwise=0.0
    )

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.15)
        span, lead, count = self.span * r + 0.1, self.lead, 21 if self.skin == "smooth" else 41
        line = t.at(lead) if lead else t
        if lead:
            t.add("pipe", pipe_x(t.dn, 0.0, lead, t.style))
        low = _held(line, self.end)
        length = 2 * low + span
        s = np.linspace(0, 1, count)
        fall = -self.sagging * self.drop * span * np.sin(np.pi * s) ** 2
        path = np.column_stack([low + span * s, np.zeros(count), fall])
        line.add("hose", _along(path, _skin(count, 1.12 * r, self.skin), n), of=self.of)
        _held(line.at(length).moved(np.diag([-1.0, 1.0, 1.0, 1.0])), self.end)
        if lead:
            t.add("pipe", pipe_x(t.dn, length + lead, length + 2 * lead, t.style))
        return t.model(round(length + 2 * lead, 9), "flanged" if self.end == "flange" else "welded")


class Braided(_Between, name="hose/braided", sizes=sizes_between(most=150)):
    """A straight corrugated metal hose under braid (ISO 10380): ferrules hold it, flanges or hexagons at its ends."""

    end: str = among(("flange", "hexagon"), _END)
    skin: str = among(("smooth", "spiral"), _SKIN)
    of: str = given("trim", "kind of material")


class Flanged(_Between, name="hose/flanged"):
    """A metal or rubber hose with flanges (EN ISO 10380), straight or hanging through a little."""

    sagging: float = among((0.0, 0.3), "how far it sags / as far as it can")
    end: str = given("flange", _END)


class Slack(_Between, name="hose/slack", sizes=sizes_between(most=150)):
    """A rubber hose with cam lever or screwed ends that sags between two pipes."""

    sagging: float = given(1.0, "how far it sags / as far as it can")
    end: str = among(("hexagon", "cam lever", "cam lever"), _END)
    skin: str = among(("smooth", "smooth", "spiral"), _SKIN)


class Loading(Fitting, name="hose/loading", place="end", sizes=sizes_between(most=150), weight=1.0):
    """A loading hose on a pipe's end: it hangs down in a U and comes up again to a mouth."""

    end: str = among(("hexagon", "cam lever"), _END)
    bow: float = between(5, 9, "radius of its bends / of the pipe")
    drop: float = between(0.1, 0.5, "how far it hangs down between them", "m")
    rise: tuple[float, ...] = several(number(0.1, 0.3), 2, "steps in which it comes up", "m")
    skin: str = among(_SKINS, _SKIN)

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.15)
        low, bow = _held(t, self.end), self.bow * r
        a, u = np.linspace(0, np.pi / 2, 7)[1:], np.linspace(0, np.pi, 13)
        first = np.column_stack([low + bow * np.sin(a), 0 * a, -bow * (1 - np.cos(a))])
        x, z = first[-1][0], first[-1][2] - self.drop
        turn = np.column_stack([x + bow * (1 - np.cos(u)), 0 * u, z - bow * np.sin(u)])
        up = np.array([[x + 2 * bow, 0.0, z + k * step] for k, step in enumerate(self.rise, 1)])
        knots = np.vstack([[[low - 0.01, 0, 0]], first, turn, up])
        s = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(knots, axis=0), axis=1))])
        steps = np.linspace(0, s[-1], 45 if self.skin == "smooth" else 71)
        path = np.column_stack([np.interp(steps, s, knots[:, k]) for k in range(3)])
        t.add("hose", _along(path, _skin(len(path), 1.12 * r, self.skin), n))
        _held(t.at(*path[-1]).spun("y", np.pi / 2).at(-low), self.end)
        return t.model()


class Spiral(Fitting, name="hose/spiral", place="end", sizes=SIZES[:5], weight=1.0):
    """A spiral hose on a pipe's end, as for air: turns about the axis of the pipe, screwed ends."""

    wide: float = between(3.5, 7, "radius of its turns / of the pipe")
    turns: int = whole(4, 9, "turns")
    pitch: float = between(2.2, 3.2, "from turn to turn / radius of the pipe")

    def build(self, t: Table) -> Model:
        r = t.pipe.radius
        low, wide, pitch = _held(t, "hexagon"), self.wide * r, self.pitch * r
        a = np.linspace(0, 2 * np.pi * self.turns, 14 * self.turns)
        grow = np.minimum(1.0, np.minimum(a, a[-1] - a) / np.pi)
        xs = low + r * 2 + pitch * a / (2 * np.pi)
        path = np.column_stack([xs, wide * grow * np.sin(a), wide * grow * np.cos(a)])
        path = np.vstack([[low - 0.01, 0, 0], path, path[-1] + [2 * r + 0.02, 0, 0]])
        t.add("hose", rope(path, 1.0 * r, t.n(r, 8, 12)), of="handle")
        _held(t.at(float(path[-1][0]) + low - 0.01).moved(BACK), "hexagon")
        return t.model()


class Reel(Fitting, name="hose/reel", place="floor", sizes=(25,), weight=1.0):
    """A hose reel on a frame: a drum with two discs, wound hose, a crank, the free end hanging down to a nozzle."""

    radius: float = between(0.01, 0.02, "of the hose", "m")
    drum: float = between(0.1, 0.18, "radius of its drum", "m")
    wide: float = between(0.2, 0.4, "width of its drum", "m")
    rim: float = between(0.1, 0.18, "how far its discs stand out from the drum", "m")
    layers: int = whole(1, 3, "layers of hose on it")

    def build(self, t: Table) -> Model:
        r, drum, half, disc, n = self.radius, self.drum, 0.5 * self.wide, self.drum + self.rim, t.n(0.3)
        z, count, out = disc + 0.08, max(3, int(self.wide / (2.2 * r))), drum + r * (1 + 1.9 * (self.layers - 1))
        on = t.at(0, 0, z).spun("z", np.pi / 2)
        wraps = []
        for layer in range(self.layers):
            ring = moved(torus(drum + r * (1 + 1.9 * layer), r, max(12, min(n, 20)), 6), spun("y", np.pi / 2))
            wraps += [moved(ring, at(-half + (k + 0.5) * self.wide / count)) for k in range(count)]
        t = t.bundled("hose")
        on.bundled("hose").add("hose", *wraps)
        t.add("hose", rope([(out, 0, z), (out + 0.01, 0, 0.6 * z), (out + 0.05, 0.05, 0.25 * z)], r, 8))
        sides = [barrel(disc, s * half - 0.003, s * half + 0.003, n) for s in (-1, 1)]
        on.add("plate", barrel(drum, -half, half, n), *sides, of="handle")
        legs = [
            rod((x * disc, s * (half + 0.03), 0.0), (0, s * (half + 0.03), z), 0.014, 8)
            for s in (-1, 1)
            for x in (-0.7, 0.7)
        ]
        axle = moved(barrel(0.018, -half - 0.05, half + 0.05, 10), at(0, 0, z) @ spun("z", np.pi / 2))
        crank = rod((0, half + 0.05, z), (0.15, half + 0.05, z), 0.008, 8)
        t.add("skid frame", *legs, axle, crank, rod((0.15, half + 0.045, z), (0.15, half + 0.16, z), 0.011, 8))
        nozzle = knurled(1.6 * r, 8, 0.3 * r, -0.02, 0.06, 0.0, 12)
        t.at(out + 0.05, 0.05, 0.25 * z).spun("y", np.pi / 2).add("coupling", nozzle, of="trim", own=False)
        return t.model()


HOSES = families_of(Braided, Flanged, Slack, Loading, Spiral, Reel)
