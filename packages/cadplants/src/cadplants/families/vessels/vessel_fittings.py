"""What is welded on vessels: heads, nozzles, manways and lifting lugs, in the builds that makers offer."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.valves.valve import bolt_circle, disc_flange
from cadplants.families.vessels.vessel import head_profile
from cadplants.family import Part
from cadplants.flange import nut_room, plate_thickness
from cadplants.mesh_ops import Solid, extrude, merge, moved, revolve, weld
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, around, box, cylinder, dome, hexagon, ring, rod, rope, torus, turned
from cadplants.standards import FLANGES, PIPES
from cadplants.transforms import at, spun

__all__ = [
    "Drum",
    "bent",
    "capped",
    "fall",
    "head",
    "head_height",
    "lug",
    "manway",
    "mouth",
    "mouth_reach",
    "renamed",
    "sides",
    "wrapped",
]

_JOINT = "Connection assembly"


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
        outline = [(radius, low), (radius, 0.6 * reach), (1.5 * radius, 0.6 * reach + 0.5 * radius)]
        body = turned([*outline, (1.5 * radius, 0.6 * reach + 0.5 * radius + 0.004)], n)
        return [Part(body, name, "trim")]
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


def manway(
    kind: str, size: float, style: ModelingStyle, rng: np.random.Generator, r: float = 0.0, dip: float = 0.0
) -> list[Part]:
    """A manway about z (after API 650, or makers): ``hinged``, ``davit``, ``swing``, ``hatch``, ``oval``, ``lid``.

    Args:
        kind: its closure; ``swing`` has swing bolts round a dished lid, ``lid`` is a screwed or clamped plastic lid.
        size: radius of its neck [m].
        style: that models it.
        rng: of its proportions.
        r: radius of the shell it sits on [m], 0 where that is flat.
        dip: how far the shell's flats lie inside its circle [m].
    """
    low = -dip - fall(r, 1.15 * size) - 0.015
    if kind == "hatch":
        return _hatch(size, low, rng)
    if kind == "oval":
        return _oval(size, low, style)
    if kind == "lid":
        return _screw_lid(size, low, style, rng)
    if kind == "swing":
        return _swing(size, low, style, rng)
    n, name = style.round(size), "manway"
    tall, thick, wide = float(rng.uniform(0.10, 0.25)), 0.012 + 0.05 * size, 1.25 * size + 0.02
    neck = ring(0.96 * size if style.hollow else 0.0, size, low, tall, n)
    rim = ring(0.96 * size, wide, tall - thick, tall, n)
    top = tall + thick
    lid = dome(wide, 0.25 * size, top, n) if rng.random() < 0.25 else cylinder(wide, tall, top, n)
    if lid.vertices[:, 2].min() > tall:
        lid = merge([lid, cylinder(wide, tall, top, n)])
    count = int(rng.choice([12, 16, 20]))
    bolts = bolt_circle(count, 0.5 * (size + wide), 0.016, tall - thick, top)
    parts = [Part(neck, name, "tank", name), Part(rim, name, "flange", name), Part(lid, name, "tank", name)]
    parts.append(Part(bolts, "bolt", "fastener", name, _JOINT, True))
    if rng.random() < 0.5:
        parts.append(Part(bent(ring(size, 1.7 * size, -dip - 0.004, 0.008, n), r), name, "tank", name))
    arm = _davit(wide, tall, top, style) if kind == "davit" else _hinge(wide, tall, top)
    return [*parts, Part(arm, name, "steel", name)]


def _davit(wide: float, tall: float, top: float, style: ModelingStyle) -> Solid:
    """A post in a sleeve beside the flange with an arm over the lid and a hook bolt."""
    x = wide + 0.03
    path = [(x, 0, tall - 0.12), (x, 0, top + 0.16), (0.85 * x, 0, top + 0.2), (0.0, 0, top + 0.2)]
    sleeve = moved(cylinder(0.03, tall - 0.1, tall - 0.01, 10), at(x))
    web = box((0.06, 0.012, 0.07), (wide + 0.005, 0, tall - 0.055))
    return merge(
        [rope(path, 0.018, min(12, style.round(0.018))), sleeve, web, rod((0, 0, top), (0, 0, top + 0.2), 0.01, 8)]
    )


def _hinge(wide: float, tall: float, top: float) -> Solid:
    """Two leaves and a pin at the edge, a handle across."""
    leaves = [box((0.12, 0.015, top - tall + 0.06), (wide + 0.02, y, (top + tall) / 2)) for y in (-0.06, 0.06)]
    pin = along("y", cylinder(0.012, -0.1, 0.1, 8), wide + 0.06, 0, (top + tall) / 2)
    grip = [(-0.7 * wide, -0.08, top - 0.005), (-0.7 * wide, -0.08, top + 0.06)]
    grip += [(-0.7 * wide, 0.08, top + 0.06), (-0.7 * wide, 0.08, top - 0.005)]
    return merge([*leaves, pin, rope(grip, 0.009, 8)])


def _swing(size: float, low: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A quick-opening manway: a dished lid under swing bolts with wing nuts in slotted ears."""
    n, tall, name = style.round(size), float(rng.uniform(0.06, 0.16)), "manway"
    neck = turned([(size, low), (size, tall - 0.02), (1.08 * size, tall - 0.02), (1.08 * size, tall)], n)
    lid = turned(
        [
            (1.1 * size, tall),
            (1.1 * size, tall + 0.015),
            (0.9 * size, tall + 0.02),
            (0.5 * size, tall + 0.2 * size),
            (0.0, tall + 0.25 * size),
        ],
        n,
    )
    ear = merge([box((0.05, 0.012, 0.03), (0.02, y, tall - 0.035)) for y in (-0.014, 0.014)])
    slot = merge([box((0.045, 0.012, 0.018), (0.02, y, tall + 0.009)) for y in (-0.014, 0.014)])
    count = int(rng.choice([4, 6, 8]))
    bolt = merge(
        [
            rod((0.03, 0, tall - 0.05), (0.03, 0, tall + 0.07), 0.007, 8),
            box((0.014, 0.09, 0.014), (0.03, 0, tall + 0.03)),
        ]
    )
    hinge = box((0.08, 0.05, 0.05), (1.1 * size + 0.03, 0, tall))
    return [
        Part(merge([neck, around(ear, count, 1.06 * size, 0.4)]), name, "tank", name),
        Part(merge([lid, around(slot, count, 1.06 * size, 0.4), hinge]), name, "trim", name),
        Part(around(bolt, count, 1.06 * size, 0.4), "bolt", "fastener", name, _JOINT, True),
    ]


def _hatch(size: float, low: float, rng: np.random.Generator) -> list[Part]:
    """A square hatch: a coaming with an overlapping lid, two hinges and a handle or a hasp."""
    w, d, tall, name = 2 * size, float(rng.uniform(1.4, 2.2)) * size, float(rng.uniform(0.05, 0.15)), "manway"
    frame = extrude(rounded_rectangle(w, d, 0.02, 1), low, tall, (rounded_rectangle(w - 0.02, d - 0.02, 0.01, 1),))
    lid = merge([box((w + 0.05, d + 0.05, 0.006), (0, 0, tall + 0.003)), *_hems(w + 0.05, d + 0.05, tall)])
    hinges = [box((0.05, 0.06, 0.012), (w / 2 + 0.03, s * 0.3 * d, tall + 0.008)) for s in (-1, 1)]
    x = -0.35 * w
    grip = [(x, -0.07, tall + 0.004), (x, -0.07, tall + 0.05), (x, 0.07, tall + 0.05), (x, 0.07, tall + 0.004)]
    return [
        Part(frame, name, "tank", name),
        Part(lid, name, "tank", name),
        Part(merge([*hinges, rope(grip, 0.007, 8)]), name, "steel", name),
    ]


def _hems(w: float, d: float, tall: float) -> list[Solid]:
    """The folded edges of a sheet lid."""
    along_x = [box((w, 0.004, 0.04), (0, s * (d / 2 - 0.002), tall - 0.016)) for s in (-1, 1)]
    return along_x + [box((0.004, d, 0.04), (s * (w / 2 - 0.002), 0, tall - 0.016)) for s in (-1, 1)]


def _oval(size: float, low: float, style: ModelingStyle) -> list[Part]:
    """An oval inspection opening (handhole) with its inside cover pulled up by one or two bridges."""
    n, name = style.round(size), "manway"
    squeeze = np.diag([1.0, 0.72, 1.0, 1.0])
    rim = moved(ring(0.85 * size, size, low, 0.04, n), squeeze)
    cover = moved(cylinder(0.84 * size, 0.0, 0.022, n), squeeze)
    bridges, studs = [], []
    for x in (-0.35 * size, 0.35 * size):
        bridges.append(
            merge(
                [
                    box((0.03, 1.5 * size, 0.025), (x, 0, 0.068)),
                    *(box((0.03, 0.03, 0.03), (x, s * 0.72 * size, 0.045)) for s in (-1, 1)),
                ]
            )
        )
        studs.append(moved(merge([cylinder(0.008, 0.018, 0.11, 8), hexagon(0.026, 0.08, 0.095)]), at(x)))
    return [
        Part(rim, name, "tank", name),
        Part(cover, name, "tank", name),
        Part(merge(bridges), name, "steel", name),
        Part(merge(studs), "stud", "fastener", name, _JOINT, True),
    ]


def _screw_lid(size: float, low: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """A screwed plastic lid with grips round its edge, on a short neck."""
    n, name = style.round(size), "manway"
    neck = cylinder(0.94 * size, low, 0.03, n)
    lid = turned([(size, 0.012), (size, 0.06), (0.9 * size, 0.075), (0.3 * size, 0.085), (0.0, 0.085)], n)
    grips = around(box((0.02, 0.03, 0.05), (0, 0, 0.037)), int(rng.choice([8, 12, 16])), size)
    return [Part(neck, name, "tank", name), Part(merge([lid, grips]), name, "rubber", name)]


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
        return [
            Part(
                merge([cylinder(0.28 * s, low, 0.12 * s, 12), cylinder(0.14 * s, 0.1 * s, 0.2 * s, 10), eye]),
                name,
                "trim",
            )
        ]
    if kind == "ring":
        a = np.linspace(0, np.pi, 9)
        arch = np.column_stack([np.zeros(9), 0.5 * s * np.cos(a), 0.5 * s + 0.5 * s * np.sin(a)])
        feet = low - fall(r, 0.55 * s)
        path = np.vstack([[(0, 0.5 * s, feet)], arch, [(0, -0.5 * s, feet)]])
        return [Part(rope(path, 0.1 * s, 10), name, "steel")]
    # The eye stands off the surface; the plate lies in the plane of the axis.
    outline = np.array([[-0.5, 0.0], [0.9, 0.0], [0.9, 0.12], [0.25, 0.95], [-0.3, 1.1], [-0.62, 0.9], [-0.62, 0.6]])
    outline = outline * s
    outline[:2, 1] = low
    hole = circle(0.2 * s, 12, (-0.2 * s, 0.72 * s))
    half = 0.05 * s + 0.004
    plate = moved(extrude(outline, -half, half, (hole,)), spun("x", np.pi / 2))
    if kind == "cheeks":
        pin = along("y", cylinder(0.2 * s, -0.3 * s, 0.3 * s, 12), -0.2 * s, 0, 0.72 * s)
        pair = [moved(plate, at(0, y)) for y in (-0.2 * s, 0.2 * s)]
        return [Part(merge(pair), name, "tank", name), Part(pin, name, "trim", name)]
    if kind == "pad":
        sheet = bent(box((1.7 * s, 0.9 * s, 0.02 + dip), (0.15 * s, 0, -0.01 - dip / 2 + 0.008)), r)
        cheek = merge(
            [along("y", ring(0.2 * s, 0.32 * s, y, y + 0.01, 16), -0.2 * s, 0, 0.72 * s) for y in (half, -half - 0.01)]
        )
        return [Part(merge([plate, sheet, cheek]), name, "tank")]
    return [Part(plate, name, "tank")]
