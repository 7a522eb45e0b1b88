"""Flanges, blind flanges and gaskets of further makes: pairs in a line, and lids on a flanged end."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import made
from cadplants.builder.params import Params, among, between, chance, given, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.piping.shape import (
    BACK,
    UP,
    Fitting,
    Tail,
    barrel,
    bolting,
    drilled,
    flat_flange,
    lathe,
    parts_of,
    pipe_x,
    prism,
    sized,
)
from cadplants.model.family import Model
from cadplants.model.standards import FLANGES, PIPES, SIZES, sizes_between
from cadplants.parts.flange import flange, flange_length, plate_thickness
from cadplants.solids.mesh_ops import Solid, merge, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, box, cylinder, rod, rope, torus
from cadplants.solids.transforms import at, spun

__all__ = ["FLANGINGS"]

_LONG = "length, less 40 mm / radius of the pipe"

# One side of a joint: its solids with their names, from the pipe's end at 0 to its face; where the face is; how thick
# what its bolts clamp; number of bolts, radius of their circle, their thread, the angle of the first.
Made = tuple[list[tuple[Solid, str]], float, float, tuple[int, float, float, float]]


def _drilling(dn: int) -> tuple[int, float, float, float]:
    size = FLANGES[dn]
    return size.n_bolts, size.circle / 2, size.bolt, np.pi / size.n_bolts


class Side(Params):
    """A flange as the style makes them."""

    def made(self, t: Table) -> Made:
        """It, of the table's nominal size."""
        long = flange_length(t.dn, t.style)
        parts = parts_of(flange(t.dn, t.style), at(long) @ BACK)
        return [(p.solid, p.name) for p in parts], long, plate_thickness(t.dn), _drilling(t.dn)


class Lap(Side):
    """A lap joint: a loose flange behind the collar of a stub end (ASME B16.9)."""

    long: float = between(1.0, 2.5, _LONG)

    def made(self, t: Table) -> Made:
        r, size, plate = t.pipe.radius, t.flange, plate_thickness(t.dn)
        (_, _, bore), n, lap, face = sized(t.dn, t.style), t.n(size.outer / 2), 0.004 + 0.02 * r, size.raised / 2
        long = self.long * r + 0.04
        back = long - lap
        stub = lathe(outline(r, 0.0, r, back, face, back, face, long), n, bore)
        hub = outline(0.48 * size.hub, back - 1.5 * plate, 0.5 * size.hub, back - 0.9 * plate)
        disc = flat_flange(t.dn, t.style, back - plate, plate, 1.01 * r)
        loose = merge([disc, lathe(hub, n, 1.01 * r)])
        return [(stub, "flange"), (loose, "flange")], long, lap + plate, _drilling(t.dn)


class Screwed(Side):
    """A threaded flange (ASME B16.5): a short hub, round, with a band, or octagonal, on the bare pipe."""

    hub: str = among(("octagon", "cone", "band"), "form of its hub")

    def made(self, t: Table) -> Made:
        (r, _, bore), size, plate = sized(t.dn, t.style), t.flange, plate_thickness(t.dn)
        n, high = t.n(size.outer / 2), max(size.slip, plate + 0.008)
        back, a, b = high - plate, 1.35 * r, 1.2 * r
        hub = {
            "octagon": lambda: prism(2.5 * r + 0.008, 8, 0.0, back, bore, n),
            "cone": lambda: lathe(outline(0.45 * size.hub, 0.0, 0.5 * size.hub, back), n, bore),
            "band": lambda: lathe(outline(a, 0.0, a, 0.45 * back, b, 0.45 * back, b, back), n, bore),
        }[self.hub]()
        disc = flat_flange(t.dn, t.style, back, plate, bore)
        return [(merge([disc, hub]), "flange")], high, plate, _drilling(t.dn)


class LongNeck(Side):
    """A long welding neck, as on nozzles: a thick straight barrel to the flange."""

    long: float = between(0.15, 0.35, "length", "m")

    def made(self, t: Table) -> Made:
        (r, _, bore), plate, long = sized(t.dn, t.style), plate_thickness(t.dn), self.long
        n, wide = t.n(t.flange.outer / 2), 0.48 * t.flange.hub
        neck = lathe(outline(r, 0.0, r, 0.01, wide, 0.02 + 0.3 * r, wide, long - plate), n, bore)
        disc = flat_flange(t.dn, t.style, long - plate, plate, bore)
        return [(merge([disc, neck]), "flange")], long, plate, _drilling(t.dn)


class High(Side):
    """A ring joint flange of a high class (ASME B16.5, 600 to 1500): thick, with a stout hub and more, larger bolts."""

    thick: float = between(0.35, 0.6, "thickness of its plate, less 20 mm / radius of the pipe")
    outer: float = between(2.2, 2.7, "radius of its plate, less 45 mm / of the pipe")

    def made(self, t: Table) -> Made:
        r, _, bore = sized(t.dn, t.style)
        thick, outer, bolt, hub = self.thick * r + 0.02, self.outer * r + 0.045, 0.011 + 0.09 * r, 0.9 * r + 0.02
        n, count, far = t.n(outer), 4 if t.dn <= 50 else 8 if t.dn <= 150 else 12, hub + thick
        ring = outer - 1.35 * bolt - 0.004
        turns = (2 * np.arange(count) + 1) * np.pi / count
        spots = ring * np.column_stack([np.cos(turns), np.sin(turns)])
        neck = lathe(outline(r, 0.0, r, 0.1 * hub, 1.5 * r + 0.004, hub), n, bore)
        plate = drilled(circle(outer, n), hub, far, bore, spots, 0.56 * bolt, t.style, n)
        face = barrel(1.75 * r + 0.01, far, far + 0.006, n, bore)
        drilling = (count, ring, bolt, np.pi / count)
        return [(merge([neck, plate, face]), "flange")], far + 0.006, thick + 0.006, drilling


class Square(Side):
    """A square hydraulic flange with four socket bolts (ISO 6164)."""

    corner: float = among((0.0, 0.2, 0.35), "radius of its corners / half its width")

    def made(self, t: Table) -> Made:
        r, n, bore = sized(t.dn, t.style, 1.3)
        thick, half, lead = 0.6 * r + 0.012, 1.55 * r + 0.014, 0.3 * r + 0.004
        spots, bolt = 0.72 * half * np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]], float), 0.16 * half + 0.003
        neck = lathe(outline(1.02 * r, 0.0, 1.2 * r, lead), n, bore)
        shape = rounded_rectangle(2 * half, 2 * half, self.corner * half, 3)
        plate = drilled(shape, lead, lead + thick, bore, spots, 0.55 * bolt, t.style, n)
        return [(merge([neck, plate]), "flange")], lead + thick, thick, (4, 0.72 * 1.4142 * half, bolt, np.pi / 4)


class Oval(Side):
    """An oval flange with two bolts, as on small pumps and meters (DIN 2560 practice)."""

    def made(self, t: Table) -> Made:
        r, n, bore = sized(t.dn, t.style, 1.4)
        thick, bolt, lead, wide = 0.35 * r + 0.009, 0.1 * r + 0.008, 0.7 * r + 0.008, 1.25 * r + 0.002
        ear = 1.35 * bolt
        reach, angles = 1.85 * r + 1.6 * bolt + 0.004, np.linspace(0, 2 * np.pi, 48, endpoint=False)
        shape = np.column_stack([(reach + ear) * np.cos(angles), (1.32 * r + 0.004) * np.sin(angles)])
        spots = np.array([[reach - 0.4 * ear, 0.0], [0.4 * ear - reach, 0.0]])
        plate = drilled(shape, lead, lead + thick, bore, spots, 0.5 * bolt, t.style, n)
        solid = merge([barrel(wide, 0.0, lead, n, bore), plate])
        return [(solid, "flange")], lead + thick, thick, (2, reach - 0.4 * ear, bolt, 0.0)


class Backing(Side):
    """A plastic stub with a collar and a loose backing ring (EN ISO 15494), flat, with a bead, or ribbed."""

    long: float = between(1.2, 2.2, _LONG)
    ring: str = among(("flat", "beaded", "ribbed"), "how its ring is made")

    def made(self, t: Table) -> Made:
        (r, _, bore), size, plate = sized(t.dn, t.style), t.flange, plate_thickness(t.dn)
        n, collar, long, neck = t.n(size.outer / 2), 0.2 * r + 0.006, self.long * r + 0.04, 1.12 * r
        wide, low = min(1.45 * r + 0.003, 0.98 * size.raised / 2), long - collar - plate
        stub = lathe(outline(neck, 0.0, neck, long - 2 * collar, wide, long - collar, wide, long), n, bore)
        pieces = [flat_flange(t.dn, t.style, low, plate, 1.14 * r)]
        if self.ring == "beaded":
            pieces.append(barrel(0.7 * size.hub, low - 0.006, low + 0.001, n, 1.2 * r))
        if self.ring == "ribbed":
            rib = box((0.012, 0.32 * (size.outer - 2.3 * r), 0.005), (low - 0.004, 0.29 * size.outer + 0.33 * r, 0))
            pieces += [moved(rib, spun("x", 2 * np.pi * k / size.n_bolts)) for k in range(size.n_bolts)]
        return [(stub, "pipe"), (merge(pieces), "flange")], long, collar + plate, _drilling(t.dn)


class Plate(Side):
    """A flat plate flange (EN 1092-1 type 01)."""

    def made(self, t: Table) -> Made:
        (_, _, bore), thick = sized(t.dn, t.style), plate_thickness(t.dn)
        return [(flat_flange(t.dn, t.style, 0.0, thick, bore), "flange")], thick, thick, _drilling(t.dn)


# Pieces of a gasket from x = 0 with their materials, and how thick it is.
Packed = tuple[list[tuple[Solid, str]], float]


class Seal(Params):
    """A plain ring out to the raised face, none where the style has none."""

    def packed(self, t: Table) -> Packed:
        """It, of the table's nominal size."""
        if not t.style.gaskets:
            return [], 0.0
        r = t.pipe.radius
        return [(barrel(1.4 * r + 0.002, 0.0, 0.002, t.n(1.4 * r), r), "gasket")], 0.002


class Wound(Seal):
    """A spiral wound gasket with a centring ring (ASME B16.20): a thin ring out to the bolts, a thicker winding."""

    joined: bool = chance(0.5, "ring and winding are one mesh")

    def packed(self, t: Table) -> Packed:
        r, size = t.pipe.radius, t.flange
        outer, n, low = (size.circle - size.bolt) / 2 - 0.0008, t.n(size.circle / 2), 1.05 * r
        high = min(low + 0.35 * (outer - r), 0.49 * size.raised)
        guide, winding = barrel(outer, 0.0009, 0.0036, n, high), barrel(high, 0.0, 0.0045, n, low)
        if self.joined:
            return [(merge([guide, winding]), "gasket")], 0.0045
        return [(guide, "safety"), (winding, "gasket")], 0.0045


class FullFace(Seal):
    """A full-face gasket (ASME B16.21): as wide as the flange, with its bolt holes."""

    thick: float = among((0.0016, 0.003, 0.005), "thickness", "m")

    def packed(self, t: Table) -> Packed:
        return [(flat_flange(t.dn, t.style, 0.0, self.thick, t.pipe.radius), "rubber")], self.thick


class Ring(Seal):
    """An octagonal or oval ring (ASME B16.20) that keeps two flanges apart."""

    def packed(self, t: Table) -> Packed:
        r, n, _ = sized(t.dn, t.style, 1.5)
        gap, wide, mid = 0.004, 0.008 + 0.03 * r, 1.4 * r + 0.005
        low, high, a, b = -0.35 * wide, gap + 0.35 * wide, mid + 0.25 * wide, mid + 0.5 * wide
        shape = outline(a, low, b, low + 0.25 * wide, b, high - 0.25 * wide, a, high)
        return [(lathe(shape, n, mid - 0.4 * wide), "trim")], gap


class Tabbed(Seal):
    """A cut ring with a tab to pull it out by, or a thick spacer ring."""

    thick: float = among((0.002, 0.003, 0.006, 0.012), "thickness", "m")
    turn: float = between(0, 6, "where its tab is, about the pipe", "rad")

    def packed(self, t: Table) -> Packed:
        r, size, thick = t.pipe.radius, t.flange, self.thick
        outer = (size.circle - size.bolt) / 2 - 0.0008
        tab = (thick, 0.55 * size.outer - 0.9 * outer, 0.02 + 0.2 * r)
        ear = moved(box(tab, (0.5 * thick, 0.275 * size.outer + 0.45 * outer, 0)), spun("x", self.turn))
        return [(merge([barrel(outer, 0.0, thick, t.n(size.raised / 2), r), ear]), "gasket")], thick


class _Pair(Fitting):
    """Two flanges of a make with a gasket and bolts between two pieces of pipe."""

    side: Side = nested(Side, "how its flanges are made")
    seal: Seal = nested(Seal, "its gasket")
    lead: float = between(0.02, 0.15, "length of the pipe before and behind it", "m")

    def build(self, t: Table) -> Model:
        lead, (solids, long, plate, drilling), (seals, gap) = self.lead, self.side.made(t), self.seal.packed(t)
        face, total = lead + long, 2 * (lead + long) + gap
        t.add("pipe", pipe_x(t.dn, 0.0, lead, t.style))
        for way in (t, t.at(total).moved(np.diag([-1.0, 1.0, 1.0, 1.0]))):
            for solid, name in solids:
                way.at(lead).add(name, solid)
        count, radius, thread, start = drilling
        for solid, of in seals:
            t.at(face).bundled("gasket" if len(seals) > 1 else "").add("gasket", solid, of=of)
        t.extend(bolting(count, radius, thread, face - plate, face + gap + plate, t.style, "", at(), start))
        t.add("pipe", pipe_x(t.dn, total - lead, total, t.style))
        self.tapped(t, (face - 0.5 * plate, face + gap + 0.5 * plate))
        return t.model(round(total, 9), "welded")

    def tapped(self, t: Table, places: Sequence[float]) -> None:
        """Puts down what is in the rims of the flanges, each at its place [m]."""


class LapJoint(_Pair, name="flange/lap joint"):
    """Two loose flanges behind the collars of stub ends (ASME B16.9)."""

    side: Side = nested(Lap, "how its flanges are made")


class Threaded(_Pair, name="flange/threaded", sizes=sizes_between(most=100)):
    """Two threaded flanges (ASME B16.5)."""

    side: Side = nested(Screwed, "how its flanges are made")


class LongNecks(_Pair, name="flange/long neck"):
    """Two long welding necks, as on nozzles."""

    side: Side = nested(LongNeck, "how its flanges are made")


class Tapping(Params):
    """A tapping in the rim of an orifice flange: a plug, or a nipple with a coupling."""

    plugged: bool = chance(0.35, "a plug in it")
    long: float = between(0.05, 0.15, "length of the nipple in it", "m", when=lambda p: not p.plugged)

    def build(self, t: Table) -> None:
        """Puts it down along x."""
        if self.plugged:
            t.add("pipe cap", prism(0.022, 6, 0.0, 0.014), of="trim")
        else:
            t.add("nipple", barrel(0.0107, 0.0, self.long, 12))
            t.add("coupling", prism(0.027, 6, self.long, self.long + 0.03), of="trim")


class Orifice(_Pair, name="flange/orifice", sizes=SIZES[4:]):
    """Orifice flanges (ASME B16.36): two flanges with tappings in their rims."""

    turn: float = among((0.0, 0.5, 1.0), "where its tappings are, about the pipe / half a turn")
    tappings: tuple[Tapping, ...] = several(made(Tapping), 2, "tappings")

    def tapped(self, t: Table, places: Sequence[float]) -> None:
        # The two tappings stand aside of each other, or their nipples would touch.
        t = t.spun("x", self.turn * np.pi)
        for x, aside, tapping in zip(places, (0.35, -0.35), self.tappings, strict=True):
            tapping.build(t.at(x).spun("x", aside).at(0, 0, 0.985 * t.flange.outer / 2).moved(UP))


class HighPressure(_Pair, name="flange/high pressure"):
    """Two ring joint flanges of a high class (ASME B16.5, 600 to 1500)."""

    side: Side = nested(High, "how its flanges are made")
    seal: Seal = nested(Ring, "its gasket")


class Squares(_Pair, name="flange/square", sizes=sizes_between(most=100)):
    """Two square hydraulic flanges (ISO 6164)."""

    side: Side = nested(Square, "how its flanges are made")


class Ovals(_Pair, name="flange/oval", sizes=sizes_between(most=100)):
    """Two oval flanges with two bolts (DIN 2560 practice)."""

    side: Side = nested(Oval, "how its flanges are made")


class BackingRings(_Pair, name="flange/backing ring"):
    """Two plastic stubs in loose backing rings (EN ISO 15494)."""

    side: Side = nested(Backing, "how its flanges are made")


class SpiralWound(_Pair, name="gasket/spiral wound"):
    """Two flanges with a spiral wound gasket (ASME B16.20)."""

    seal: Seal = nested(Wound, "its gasket")


class FullFaced(_Pair, name="gasket/full face"):
    """Two flat flanges with a full-face gasket (ASME B16.21)."""

    side: Side = nested(Plate, "how its flanges are made")
    seal: Seal = nested(FullFace, "its gasket")


class RingJoint(_Pair, name="gasket/ring joint"):
    """Two long welding necks with a ring between them (ASME B16.20)."""

    side: Side = nested(LongNeck, "how its flanges are made")
    seal: Seal = nested(Ring, "its gasket")


class TabbedGasket(_Pair, name="gasket/tabbed"):
    """Two flanges with a gasket that has a tab."""

    seal: Seal = nested(Tabbed, "its gasket")


class Anchor(Fitting, name="flange/anchor"):
    """An anchor or puddle flange: a plain disc round the pipe in or at a wall or block of concrete, with gussets."""

    outer: float = between(1.5, 2.0, "radius of its disc, less 30 mm / of the pipe")
    deep: float = between(0.15, 0.35, "thickness of the concrete", "m")
    lead: float = between(0.08, 0.3, "length of the pipe before and behind it", "m")
    ribbed: bool = chance(0.6, "gussets on its disc")
    room: float = between(0.05, 0.3, "how far the concrete stands out from the disc", "m")

    def build(self, t: Table) -> Model:
        r, n, _ = sized(t.dn, t.style, 1.6)
        thick, outer, deep, lead = 0.006 + 0.08 * r, self.outer * r + 0.03, self.deep, self.lead
        length, half, back = 2 * lead + deep, outer + self.room, lead - thick
        t.add("pipe", pipe_x(t.dn, 0.0, length, t.style))
        disc, size = [barrel(outer, back, lead, n, r)], min(0.8 * r, 0.8 * back)
        if self.ribbed:
            rib = box((size, 0.8 * (outer - r), 0.006), (back - 0.5 * size, r + 0.39 * (outer - r), 0))
            disc += [moved(rib, spun("x", k * np.pi / 2)) for k in range(4)]
        t.add("flange", *disc)
        square = rounded_rectangle(2 * half, 2 * half, 0.0)
        wall = drilled(square, lead, lead + deep, r, np.zeros((0, 2)), 0.0, t.style, n)
        t.add("foundation" if half < 0.3 else "wall", wall)
        return t.model(round(length, 9), "welded")


class Paddle(Fitting, name="blind flange/paddle", weight=0.4):
    """A paddle blank or spacer (ASME B16.48) between two flanges: a disc with a long bar, drilled or with a ring."""

    spacer: bool = chance(0.4, "a spacer, bored as the pipe")
    reach: float = between(0.03, 0.12, "how far its bar stands out from the flanges", "m")
    end: str = among(("plain", "ring", "cross"), "end of its bar")
    turn: float = among((0.5, 0.25, 0.0), "where its bar is, about the pipe / half a turn")

    def build(self, t: Table) -> Model:
        size, pipe = t.flange, t.pipe
        outer, thick, n = 0.49 * (size.circle - size.bolt), 0.005 + 0.1 * pipe.radius, t.n(size.circle / 2)
        reach, wide = size.outer / 2 + self.reach, 0.02 + 0.25 * pipe.radius
        solids = [barrel(outer, 0.0, thick, n, pipe.bore if self.spacer else 0.0)]
        solids.append(box((thick, reach - 0.93 * outer, wide), (0.5 * thick, 0.5 * (reach + 0.93 * outer), 0)))
        if self.end == "ring":
            solids.append(moved(barrel(0.9 * wide, 0.0, thick, 16, 0.4 * wide), at(0, reach + 0.7 * wide)))
        if self.end == "cross":
            solids.append(box((thick, 0.04, 1.8 * wide), (0.5 * thick, reach, 0)))
        t.spun("x", self.turn * np.pi).add("blind flange", *solids)
        return t.model(round(thick, 9), "wafer")


# --- lids on a flanged end: face at 0, towards +x ---


class _Lid(Fitting, place="head", bundle="blind flange", weight=1.0):
    """A lid on a flanged end."""

    def disc(self, t: Table) -> tuple[Solid, float, float]:
        """Its disc, and the radius and the thickness of that [m]."""
        plate = plate_thickness(t.dn)
        return flat_flange(t.dn, t.style, 0.0, plate, 0.0), t.flange.outer / 2, plate


class Handled(_Lid, name="blind flange/handle", sizes=SIZES[4:]):
    """A blind flange with one or two bent handles, or a hand hole cover's bar."""

    paired: bool = chance(0.5, "two handles")

    def build(self, t: Table) -> Model:
        (disc, _, plate), size = self.disc(t), t.flange
        reach, low, high = 0.2 * size.circle, plate - 0.001, plate + 0.04 + 0.06 * size.outer
        t.add("blind flange", disc)
        handles = []
        for y in (-0.5 * reach, 0.5 * reach) if self.paired else (0.0,):
            path = [[low, y, -reach], [high, y, -reach], [high, y, reach], [low, y, reach]]
            handles.append(rope(path, 0.005 + 0.01 * size.outer, 8))
        t.add("blind flange", *handles, of="handle")
        return t.model()


class Davit(_Lid, name="blind flange/davit", sizes=SIZES[7:]):
    """A blind flange on a davit: a bent arm in a sleeve at the fixed flange, a screw eye on the lid."""

    rise: float = between(0.0, 0.3, "height of its arm over the flange, less 80 mm / radius of the flange")

    def build(self, t: Table) -> Model:
        disc, rim, plate = self.disc(t)
        bar, out, top = 0.008 + 0.06 * rim, 1.4 * plate + 0.02, rim + 0.08 + self.rise * rim
        x, y = -0.5 * plate, rim + 1.4 * bar
        lug = (out - plate + 0.012, 0.1 * rim + 0.01, 0.2 * rim)
        t.add("blind flange", disc, box(lug, (0.5 * (out + plate), 0, 0.35 * rim)))
        t.at(x, y).add("bracket", cylinder(1.6 * bar, -0.3 * rim, 0.3 * rim, 12))
        path = [[x, y, -0.4 * rim], [x, y, 0.85 * top], [0.5 * (x + out), 0.5 * y, top], [out, 0.0, top]]
        t.add("bracket", rope(path, bar, 10))
        eye = rod((out, 0, 0.4 * rim), (out, 0, top + 1.5 * bar), 0.4 * bar, 8)
        t.add("bolt", eye, prism(0.12 * rim + 0.012, 6, plate, out + 0.005), own=False)
        return t.model()


class HingedLid(_Lid, name="blind flange/hinged", sizes=SIZES[5:]):
    """A blind flange on a hinge: two ears at the fixed flange, a strap over the lid and a pin."""

    def build(self, t: Table) -> Model:
        disc, rim, plate = self.disc(t)
        wide, thick, y = 0.35 * rim, 0.006 + 0.02 * rim, rim + 0.015 + 0.06 * rim
        strap = box((thick, y + 0.5 * rim, wide), (plate + 0.5 * thick, 0.5 * y - 0.25 * rim, 0))
        t.add("blind flange", disc, strap)
        ear = (2.6 * plate + 0.02, 0.03 + 0.12 * rim, thick)
        ears = [box(ear, (-0.1 * plate, y, s * (0.5 * wide + 0.6 * thick))) for s in BOTH]
        leg = (0.9 * plate, y - rim + 0.001, wide + 2.2 * thick)
        t.add("bracket", *ears, box(leg, (-0.55 * plate - 0.002, 0.5 * (rim + y), 0)))
        pin = cylinder(0.006 + 0.02 * rim, -0.75 * wide, 0.75 * wide, 10)
        t.at(0.8 * plate + 0.004, y).add("bolt", pin, own=False, fine=False)
        return t.model()


def _tappings(dn: int, many: bool) -> Sequence[int]:
    """Nominal sizes [mm] that a lid can be tapped for, smaller ones where there are many tappings."""
    return ([s for s in SIZES if PIPES[s].outer < 0.3 * FLANGES[dn].circle] or [15])[: 3 if many else 6]


class LidTapping(Params):
    """A tapping in a lid: a boss with a plug or a small line."""

    dn: int = given(0, "nominal size of the lid", "mm")
    many: bool = given(False, "whether it is one of many")
    size: int = among(lambda p: _tappings(p.dn, p.many), "nominal size", "mm")
    plugged: bool = chance(0.4, "a plug in it")
    line: Tail = nested(
        Tail,
        "small line on it",
        fixed=lambda p: {"ends": ("open", "cap", *(() if p.many else ("flange",)))},
        when=lambda p: not p.plugged,
    )

    def build(self, t: Table) -> None:
        """Puts it down along x."""
        q = PIPES[self.size].radius
        boss = 1.1 * q + 0.012
        t.add("branch outlet", barrel(1.3 * q + 0.002, 0.0, boss, 16))
        if self.plugged:
            t.add("pipe cap", prism(1.9 * q + 0.002, 6, boss, boss + 0.5 * q + 0.006), of="trim")
        else:
            self.line.build(t.at(boss), self.size)


class Tapped(_Lid, name="blind flange/tapped", bundle="", sizes=SIZES[2:]):
    """A blind flange with one to three tappings: bosses or half couplings with nipples, plugs or small lines."""

    count: int = whole(1, 3, "tappings", when=lambda p: p.dn >= 100, otherwise=1)
    tappings: tuple[LidTapping, ...] = several(
        made(LidTapping, lambda p: {"dn": p.dn, "many": p.count > 1}), lambda p: p.count, "tappings"
    )

    def build(self, t: Table) -> Model:
        disc, _, plate = self.disc(t)
        t.add("blind flange", disc)
        for k, tapping in enumerate(self.tappings):
            aside = 0.0 if self.count == 1 else 0.22 * t.flange.circle
            tapping.build(t.at(plate).spun("x", 2 * np.pi * k / self.count).at(0, aside))
        return t.model()


class Ribbed(_Lid, name="blind flange/ribbed", sizes=SIZES[2:]):
    """A cast blind flange with ribs, a dished middle, or a boss with jack screws."""

    form: str = among(("ribs", "dish", "boss"), "what is on its middle")
    ribs: int = among((2, 3, 4), "ribs across it", when=lambda p: p.form == "ribs", otherwise=0)
    eyed: bool = chance(0.4, "a lifting eye on it")

    def build(self, t: Table) -> Model:
        disc, radius, plate = self.disc(t)
        rim, n, pieces = 0.4 * t.flange.circle, t.n(radius), [disc]
        if self.form == "ribs":
            rib = box((0.12 * rim + 0.01, 1.7 * rim, 0.006 + 0.04 * rim), (plate + 0.06 * rim, 0, 0))
            pieces += [moved(rib, spun("x", np.pi * k / self.ribs)) for k in range(self.ribs)]
        elif self.form == "dish":
            a, deep = np.linspace(0.1, 0.5 * np.pi - 0.15, 5), 0.05 * rim
            dish = [(float(0.8 * rim * np.cos(s)), float(plate + 0.4 * rim * np.sin(s)) - deep) for s in a]
            pieces.append(lathe(dish, n))
        else:
            pieces.append(lathe(outline(0.6 * rim, plate, 0.55 * rim, 1.5 * plate), n))
            screw = prism(0.1 * rim + 0.008, 6, 1.4 * plate, 2.0 * plate)
            pieces += [moved(screw, at(0, s * 0.35 * rim)) for s in BOTH]
        if self.eyed:
            eye = torus(0.14 * rim + 0.012, 0.03 * rim + 0.003, 14, 8)
            pieces.append(moved(eye, at(1.9 * plate + 0.14 * rim) @ spun("x", np.pi / 2)))
            pieces.append(barrel(0.08 * rim, plate, 1.9 * plate + 0.02, 10))
        t.add("blind flange", *pieces)
        return t.model()


FLANGINGS = families_of(
    LapJoint, Threaded, LongNecks, Orifice, HighPressure, Squares, Ovals, BackingRings, Anchor, SpiralWound, FullFaced,
    RingJoint, TabbedGasket, Paddle, Handled, Davit, HingedLid, Tapped, Ribbed,
)  # fmt: skip
