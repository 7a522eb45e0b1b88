"""What is welded on vessels: heads, nozzles, manways and lifting lugs, in the builds that makers offer."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.params import Params, among, between, chance
from cadplants.builder.table import Table, outline
from cadplants.families.valves.valve import bolt_circle, disc_flange
from cadplants.families.vessels.vessel import head_profile
from cadplants.model.family import Part
from cadplants.model.standards import FLANGES, PIPES
from cadplants.parts.flange import nut_room, plate_thickness
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved, revolve, weld
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import along, around, box, cylinder, dome, hexagon, ring, rod, rope, torus, turned
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = [
    "MANWAYS", "Drum", "Manway", "bent", "capped", "fall", "handle", "head", "head_height", "lug", "mouth",
    "mouth_reach", "renamed", "sides", "wrapped",
]  # fmt: skip

_JOINT = "Connection assembly"


def handle(x: float, half: float, low: float, high: float, radius: float, sides: int) -> Solid:
    """A bent handle across the plane x, its ends on a height ``low`` [m]."""
    return rope([(x, -half, low), (x, -half, high), (x, half, high), (x, half, low)], radius, sides)


def sides(style: ModelingStyle, radius: float) -> int:
    """Sides of a vessel's circle: what is large is drawn neither as coarse as a pipe nor finer than needed [m]."""
    least = 8 if radius < 0.15 else 12 if radius < 0.6 else 16
    return min(max(style.round(radius), least), 52)


def renamed(parts: Sequence[Part], name: str) -> list[Part]:
    """Parts of a vessel as parts of a piece of equipment; fasteners stay what they are."""
    return [p if p.group else Part(p.solid, name, p.color, name) for p in parts]


@dataclass(frozen=True)
class Drum:
    """A round shell about z.

    Args:
        r: its radius [m].
        low: its lower rim [m].
        high: its upper rim [m].
        n: sides of its circle.
    """

    r: float
    low: float
    high: float
    n: int

    @property
    def dip(self) -> float:
        """How far the flats of its polygon lie inside the circle [m]."""
        return float(self.r * (1 - np.cos(np.pi / self.n)))

    def side(self, angle: float, z: float) -> Floats:
        """A frame on its surface with z outward and x downward."""
        return spun("z", angle) @ at(self.r, 0, z) @ spun("y", np.pi / 2)

    def solid(self, style: ModelingStyle) -> Solid:
        """The sheet, or a full cylinder where the style models no insides."""
        return ring(self.r - max(0.003, 0.012 * self.r) if style.hollow else 0.0, self.r, self.low, self.high, self.n)


def head_outline(kind: str, r: float) -> list[tuple[float, float]]:
    """Radius and height of a head with its straight flange, rim (r, 0) to apex (DIN 28011, DIN 28013, EN 10253) [m]."""
    flange = 0.015 + 0.03 * r
    if kind == "flat":
        k = 0.07 * r
        return [(r, 0.0), (r, flange), (r - 0.3 * k, flange + 0.7 * k), (r - k, flange + k), (0.0, flange + k)]
    if kind == "conical":
        return [(r, 0.0), (r, flange), (0.95 * r, flange + 0.07 * r), (0.12 * r, 0.62 * r), (0.0, 0.62 * r)]
    if kind == "shallow":
        steps = np.linspace(0, 1, 7)
        return [(r, 0.0), *((r * (1 - s), flange + 0.2 * r * (1 - (1 - s) ** 2)) for s in steps)]
    return [(r, 0.0), *((x, z + flange) for x, z in head_profile(kind, r))]


def head_height(kind: str, r: float) -> float:
    """From rim to apex [m]."""
    return head_outline(kind, r)[-1][1]


def head(kind: str, r: float, style: ModelingStyle, n: int) -> Solid:
    """A head about z, rim at 0, apex up; a sheet where the style models hollow."""
    return capped(head_outline(kind, r), style, n)


def capped(outside: list[tuple[float, float]], style: ModelingStyle, n: int) -> Solid:
    """A round lid from the outline of its outside, rim (r, 0) to apex (0, h); a sheet where the style models hollow."""
    r = outside[0][0]
    if not style.hollow:
        return turned(outside, n)
    wall = min(max(0.003, 0.012 * r), 0.5 * outside[-1][1])
    x_share, z_share = 1 - wall / r, 1 - wall / outside[-1][1]
    inside = [(x * x_share, z * z_share) for x, z in outside[::-1]]
    return weld([revolve([*outside, *inside], n), revolve([inside[-1], outside[0]], n)])


def fall(r: float, reach: float) -> float:
    """How far a round surface of radius ``r`` has fallen at this distance aside; a flat one has not [m]."""
    return float(r - np.sqrt(r * r - min(reach, 0.98 * r) ** 2)) if r else 0.0


def bent(solid: Solid, r: float) -> Solid:
    """What was built flat on z = 0, laid over a cylinder of this radius along x below it; as it is for r = 0."""
    if not r:
        return solid
    vertices = solid.vertices.copy()
    y = np.clip(vertices[:, 1], -0.98 * r, 0.98 * r)
    vertices[:, 2] -= r - np.sqrt(r * r - y * y)
    return Solid(vertices, solid.faces)


def wrapped(r: float, start: float, turn: float, low: float, high: float, thick: float, style: ModelingStyle) -> Solid:
    """A sheet bent round z over an angle from ``start`` [rad], its inside on the radius ``r`` [m]."""
    a = start + np.linspace(0, turn, max(3, int(np.ceil(style.round(r) * turn / (2 * np.pi)))) + 1)
    way = np.column_stack([np.cos(a), np.sin(a)])
    return extrude(np.vstack([(r + thick) * way, r * way[::-1]]), low, high)


# --- nozzles ---


def mouth_reach(dn: int, spare: float = 0.03) -> float:
    """From a surface to the face of a nozzle whose nuts are to be reached [m]."""
    return plate_thickness(dn) + nut_room(dn) + spare


def mouth(kind: str, dn: int, reach: float, style: ModelingStyle, r: float = 0.0, dip: float = 0.0) -> list[Part]:
    """A nozzle about z on a surface of radius ``r``, its face at ``reach``; flanges after ASME B16.5 class 150.

    ``plain``, ``pad`` (reinforced), ``heavy`` (long welding neck, self-reinforced), ``blind`` (closed), ``vent`` (a
    gooseneck), ``half`` (threaded half coupling), ``ferrule`` (hygienic clamp) or ``fitting`` (with a nut).
    """
    radius, name = PIPES[dn].radius, "nozzle"
    n, thick = style.round(radius), plate_thickness(dn)
    low = -dip - fall(r, 1.3 * radius) - 0.012
    bore = PIPES[dn].bore if style.hollow else 0.0
    if kind == "half":
        return [Part(ring(0.7 * radius, 1.35 * radius, low, 0.015 + 0.8 * radius, n), name, "trim")]
    if kind == "ferrule":
        wide, top = 1.5 * radius, 0.6 * reach + 0.5 * radius
        return [Part(turned(outline(radius, low, radius, 0.6 * reach, wide, top, wide, top + 0.004), n), name, "trim")]
    if kind == "fitting":
        nut = hexagon(3.4 * radius, 0.0, 0.35 * radius + 0.008)
        collar = cylinder(2.1 * radius, low, 0.006, n)
        return [Part(merge([collar, nut, ring(bore, 1.15 * radius, low, reach, n)]), name, "rubber")]
    if kind == "vent":
        return _gooseneck(radius, bore, low, reach, style)
    parts = []
    plate = moved(disc_flange(dn, style, thick), at(0, 0, reach) @ spun("x", np.pi))
    neck = 0.485 * FLANGES[dn].hub if kind == "heavy" else radius
    tube = ring(bore, neck, low, reach - 0.5 * thick, n)
    if kind == "heavy":
        parts.append(Part(merge([tube, plate]), name, "flange"))
    else:
        parts += [Part(tube, name, "tank", name), Part(plate, name, "flange", name)]
    if kind == "pad":
        pad = bent(ring(1.0 * radius, 1.9 * radius + 0.01, -dip - 0.003, 0.008, max(16, n)), r)
        parts.append(Part(pad, name, "tank", name))
    if kind == "blind":
        lid = moved(disc_flange(dn, style, thick), at(0, 0, reach))
        parts.append(Part(lid, "blind flange", "flange", name, "Pipe assembly"))
        size = FLANGES[dn]
        bolts = bolt_circle(size.n_bolts, size.circle / 2, size.bolt, reach - thick, reach + thick)
        parts.append(Part(bolts, "bolt", "fastener", name, _JOINT, True))
    return parts


def _gooseneck(radius: float, bore: float, low: float, reach: float, style: ModelingStyle) -> list[Part]:
    """A vent: a stub with a return bend on it."""
    n, wide = style.round(radius), 3.0 * radius
    a = np.linspace(0, np.pi, 9)
    path = np.column_stack([wide - wide * np.cos(a), np.zeros(9), reach + wide * np.sin(a)])
    path = np.vstack([path, [(2 * wide, 0, reach - 1.5 * radius)]])
    return [
        Part(ring(bore, radius, low, reach, n), "nozzle", "tank", "nozzle"),
        Part(rope(path, radius, n), "elbow", "pipe", "nozzle", "Pipe assembly"),
    ]


# --- manways ---


class Manway(Params):
    """The closure of a manway about z (after API 650, or makers)."""

    def parts(self, style: ModelingStyle, size: float, r: float = 0.0, dip: float = 0.0) -> list[Part]:
        """The manway with its neck.

        Args:
            style: that models it.
            size: radius of its neck [m].
            r: radius of the shell it sits on [m], 0 where that is flat.
            dip: how far the shell's flats lie inside its circle [m].
        """
        t = Table(style, "Tank", "manway")
        self.build(t, size, -dip - fall(r, 1.15 * size) - 0.015, r, dip)
        return t.parts

    def build(self, t: Table, size: float, low: float, r: float, dip: float) -> None:
        """Puts it down, its neck from a height ``low``; the rest as in ``parts`` [m]."""
        raise NotImplementedError(type(self).__name__)


class _Bolted(Manway):
    """A cover bolted on a flange."""

    tall: float = between(0.10, 0.25, "height of its neck", "m")
    domed: bool = chance(0.25, "its cover is domed")
    bolts: int = among((12, 16, 20), "bolts")
    padded: bool = chance(0.5, "a reinforcing pad round its neck")

    def build(self, t: Table, size: float, low: float, r: float, dip: float) -> None:
        n, tall, wide, thick = t.n(size), self.tall, 1.25 * size + 0.02, 0.012 + 0.05 * size
        top = tall + thick
        t.add("manway", ring(0.96 * size if t.style.hollow else 0.0, size, low, tall, n))
        t.add("manway", ring(0.96 * size, wide, tall - thick, tall, n), of="flange")
        lid = [dome(wide, 0.25 * size, top, n)] if self.domed else []
        t.add("manway", *lid, cylinder(wide, tall, top, n))
        t.add("bolt", bolt_circle(self.bolts, 0.5 * (size + wide), 0.016, tall - thick, top))
        if self.padded:
            t.add("manway", bent(ring(size, 1.7 * size, -dip - 0.004, 0.008, n), r))
        t.add("manway", self.arm(t.style, wide, tall, top), of="steel")

    def arm(self, style: ModelingStyle, wide: float, tall: float, top: float) -> Solid:
        """What holds the cover of a radius between two heights when it is opened [m]."""
        raise NotImplementedError(type(self).__name__)


class Davit(_Bolted):
    """A manway with a post in a sleeve beside the flange, an arm over the cover and a hook bolt."""

    kind = "davit"

    def arm(self, style: ModelingStyle, wide: float, tall: float, top: float) -> Solid:
        x = wide + 0.03
        path = [(x, 0, tall - 0.12), (x, 0, top + 0.16), (0.85 * x, 0, top + 0.2), (0.0, 0, top + 0.2)]
        post = rope(path, 0.018, min(12, style.round(0.018)))
        sleeve = moved(cylinder(0.03, tall - 0.1, tall - 0.01, 10), at(x))
        web = box((0.06, 0.012, 0.07), (wide + 0.005, 0, tall - 0.055))
        return merge([post, sleeve, web, rod((0, 0, top), (0, 0, top + 0.2), 0.01, 8)])


class Hinged(_Bolted):
    """A manway with two leaves and a pin at the edge, a handle across."""

    kind = "hinged"

    def arm(self, style: ModelingStyle, wide: float, tall: float, top: float) -> Solid:
        leaves = [box((0.12, 0.015, top - tall + 0.06), (wide + 0.02, y, (top + tall) / 2)) for y in (-0.06, 0.06)]
        pin = along("y", cylinder(0.012, -0.1, 0.1, 8), wide + 0.06, 0, (top + tall) / 2)
        return merge([*leaves, pin, handle(-0.7 * wide, 0.08, top - 0.005, top + 0.06, 0.009, 8)])


class Swing(Manway):
    """A quick-opening manway: a dished lid under swing bolts with wing nuts in slotted ears."""

    kind = "swing"

    tall: float = between(0.06, 0.16, "height of its neck", "m")
    bolts: int = among((4, 6, 8), "swing bolts")

    def build(self, t: Table, size: float, low: float, r: float, dip: float) -> None:
        n, z, rim = t.n(size), self.tall, 1.08 * size
        neck = turned(outline(size, low, size, z - 0.02, rim, z - 0.02, rim, z), n)
        lid = outline(1.1 * size, z, 1.1 * size, z + 0.015, 0.9 * size, z + 0.02, 0.5 * size, z + 0.2 * size)
        ear = [box((0.05, 0.012, 0.03), (0.02, y, z - 0.035)) for y in (-0.014, 0.014)]
        slot = [box((0.045, 0.012, 0.018), (0.02, y, z + 0.009)) for y in (-0.014, 0.014)]
        bolt = [rod((0.03, 0, z - 0.05), (0.03, 0, z + 0.07), 0.007, 8), box((0.014, 0.09, 0.014), (0.03, 0, z + 0.03))]
        ears, slots, bolts = (around(merge(some), self.bolts, 1.06 * size, 0.4) for some in (ear, slot, bolt))
        hinge = box((0.08, 0.05, 0.05), (1.1 * size + 0.03, 0, z))
        t.add("manway", neck, ears)
        t.add("manway", turned([*lid, (0.0, z + 0.25 * size)], n), slots, hinge, of="trim")
        t.add("bolt", bolts)


class Hatch(Manway):
    """A square hatch: a coaming with an overlapping lid, two hinges and a handle or a hasp."""

    kind = "hatch"

    deep: float = between(1.4, 2.2, "its other side / half its width")
    tall: float = between(0.05, 0.15, "height of its coaming", "m")

    def build(self, t: Table, size: float, low: float, r: float, dip: float) -> None:
        w, d, tall = 2 * size, self.deep * size, self.tall
        frame = extrude(rounded_rectangle(w, d, 0.02, 1), low, tall, (rounded_rectangle(w - 0.02, d - 0.02, 0.01, 1),))
        wide, deep = w + 0.05, d + 0.05
        hems = [box((wide, 0.004, 0.04), (0, s * (deep / 2 - 0.002), tall - 0.016)) for s in (-1, 1)]
        hems += [box((0.004, deep, 0.04), (s * (wide / 2 - 0.002), 0, tall - 0.016)) for s in (-1, 1)]
        hinges = [box((0.05, 0.06, 0.012), (w / 2 + 0.03, s * 0.3 * d, tall + 0.008)) for s in (-1, 1)]
        t.add("manway", frame)
        t.add("manway", box((wide, deep, 0.006), (0, 0, tall + 0.003)), *hems)
        t.add("manway", *hinges, handle(-0.35 * w, 0.07, tall + 0.004, tall + 0.05, 0.007, 8), of="steel")


class Oval(Manway):
    """An oval inspection opening (handhole) with its inside cover pulled up by two bridges."""

    kind = "oval"

    def build(self, t: Table, size: float, low: float, r: float, dip: float) -> None:
        n, squeeze = t.n(size), np.diag([1.0, 0.72, 1.0, 1.0])
        bridge = [box((0.03, 1.5 * size, 0.025), (0, 0, 0.068))]
        bridge += [box((0.03, 0.03, 0.03), (0, s * 0.72 * size, 0.045)) for s in (-1, 1)]
        stud = merge([cylinder(0.008, 0.018, 0.11, 8), hexagon(0.026, 0.08, 0.095)])
        pair = [at(x) for x in (-0.35 * size, 0.35 * size)]
        t.moved(squeeze).add("manway", ring(0.85 * size, size, low, 0.04, n))
        t.moved(squeeze).add("manway", cylinder(0.84 * size, 0.0, 0.022, n))
        t.add("manway", *(moved(merge(bridge), pose) for pose in pair), of="steel")
        t.add("stud", *(moved(stud, pose) for pose in pair))


class ScrewLid(Manway):
    """A screwed plastic lid with grips round its edge, on a short neck."""

    kind = "lid"

    grips: int = among((8, 12, 16), "grips")

    def build(self, t: Table, size: float, low: float, r: float, dip: float) -> None:
        n = t.n(size)
        lid = outline(size, 0.012, size, 0.06, 0.9 * size, 0.075, 0.3 * size, 0.085, 0.0, 0.085)
        t.add("manway", cylinder(0.94 * size, low, 0.03, n))
        grips = around(box((0.02, 0.03, 0.05), (0, 0, 0.037)), self.grips, size)
        t.add("manway", turned(lid, n), grips, of="rubber")


MANWAYS: Mapping[str, type[Manway]] = {one.kind: one for one in (Hinged, Davit, Swing, Hatch, Oval, ScrewLid)}
"""Manways by what closes them."""


# --- lifting lugs ---


def lug(kind: str, size: float, style: ModelingStyle, r: float = 0.0, dip: float = 0.0) -> list[Part]:
    """A lifting lug about z, its pull along -x (upward on an upright shell); ``size`` is its width [m].

    ``plate``, ``pad`` (on a doubler), ``trunnion``, ``eyebolt`` (DIN 580), ``ring`` (a bent bar) or ``cheeks`` (two
    plates with a pin).
    """
    name, s, low = "lifting lug", size, -dip - 0.01
    if kind == "trunnion":
        n = style.round(0.4 * s)
        pad = bent(ring(0.0, 0.95 * s, -dip - 0.004, 0.01, max(16, n)), r)
        pipe = cylinder(0.4 * s, low - fall(r, 0.4 * s), 1.1 * s, n)
        return [Part(merge([pad, pipe, cylinder(0.6 * s, 1.1 * s, 1.1 * s + 0.015, n)]), name, "tank")]
    if kind == "eyebolt":
        eye = moved(torus(0.36 * s, 0.1 * s, 16, 8), at(0, 0, 0.55 * s) @ spun("x", np.pi / 2))
        foot = [cylinder(0.28 * s, low, 0.12 * s, 12), cylinder(0.14 * s, 0.1 * s, 0.2 * s, 10)]
        return [Part(merge([*foot, eye]), name, "trim")]
    if kind == "ring":
        a = np.linspace(0, np.pi, 9)
        arch = np.column_stack([np.zeros(9), 0.5 * s * np.cos(a), 0.5 * s + 0.5 * s * np.sin(a)])
        feet = low - fall(r, 0.55 * s)
        path = np.vstack([[(0, 0.5 * s, feet)], arch, [(0, -0.5 * s, feet)]])
        return [Part(rope(path, 0.1 * s, 10), name, "steel")]
    # The eye stands off the surface; the plate lies in the plane of the axis.
    edge = s * np.array(outline(-0.5, 0, 0.9, 0, 0.9, 0.12, 0.25, 0.95, -0.3, 1.1, -0.62, 0.9, -0.62, 0.6))
    edge[:2, 1] = low
    hole = circle(0.2 * s, 12, (-0.2 * s, 0.72 * s))
    half = 0.05 * s + 0.004
    plate = moved(extrude(edge, -half, half, (hole,)), spun("x", np.pi / 2))
    if kind == "cheeks":
        pin = along("y", cylinder(0.2 * s, -0.3 * s, 0.3 * s, 12), -0.2 * s, 0, 0.72 * s)
        pair = [moved(plate, at(0, y)) for y in (-0.2 * s, 0.2 * s)]
        return [Part(merge(pair), name, "tank", name), Part(pin, name, "trim", name)]
    if kind == "pad":
        sheet = bent(box((1.7 * s, 0.9 * s, 0.02 + dip), (0.15 * s, 0, -0.01 - dip / 2 + 0.008)), r)
        rings = [ring(0.2 * s, 0.32 * s, y, y + 0.01, 16) for y in (half, -half - 0.01)]
        cheek = along("y", merge(rings), -0.2 * s, 0, 0.72 * s)
        return [Part(merge([plate, sheet, cheek]), name, "tank")]
    return [Part(plate, name, "tank")]
