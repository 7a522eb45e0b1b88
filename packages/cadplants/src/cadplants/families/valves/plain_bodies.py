"""Valves whose bodies are plain solids: barrels of ball valves, slabs of knife gates, sleeves, blocks, angles."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import of_form
from cadplants.builder.melting import Melting, Piece, put_pieces
from cadplants.builder.params import Params, among, between, chance, given, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.valves.kit_parts import Bonnet, Grip, Rim
from cadplants.model.family import Model
from cadplants.model.plant import Turning
from cadplants.model.standards import sizes_between
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, dome, hexagon, ring, rod, turned
from cadplants.solids.transforms import at, spun

__all__ = ["PLAIN_BODIES"]

_BODY = "valve body"


class _Plain(Melting, place="inline", group="Valve assembly", label="valve", bundle=_BODY):
    """A valve of plain solids."""

    melted: bool = chance(0.6, "all of it is one mesh")

    def put(self, t: Table, length: float, pieces: list[Piece]) -> None:
        """Puts pieces about the middle of a line's stretch down [m]."""
        put_pieces(t.at(length / 2), pieces, self.melted)


class _Drive(Params):
    """What turns a quarter-turn valve: a lever, a wheel on a box, a cylinder or a box of an actuator."""

    form: str = among(("lever", "lever", "lever", "lying", "box", "drum", "geared", "none"), "how it is made")
    wide: float = between(
        0.75, 1.6, "(half its width - 20 mm) / radius of the pipe", when=of_form("lying", "box", "drum")
    )
    long: float = between(1.4, 3.0, "length / width", when=of_form("lying", "box", "drum"))
    topped: bool = chance(0.5, "an indicator or a box on it", when=of_form("lying", "box", "drum"))
    across: bool = chance(0.4, "it lies across the run", when=of_form("lying", "box"))
    grip: Grip = nested(Grip, "lever", when=of_form("lever"))
    rim: Rim = nested(Rim, "handwheel", when=of_form("geared"))

    def pieces(self, r: float, top: float, n: int) -> list[Piece]:
        """Its pieces over a stem's end on a height, for a pipe of a radius [m]."""
        if self.form == "none":
            return []
        if self.form == "lever":
            return [Piece("lever", self.grip.solids(r, top, n), Turning("lever"))]
        if self.form == "geared":
            half, z = 0.6 * r + 0.012, top + 0.4 * r + 0.01
            reach = 2.2 * half
            case = box((2 * half, 1.7 * half, 2 * (z - top)), (0, 0, z))
            shaft = along("-y", cylinder(0.2 * half, 0.5 * half, reach + 0.01, min(n, 10)), 0, 0, z)
            wheel = [along("-y", one, 0, -reach, z) for one in self.rim.solids(0.7 * r, 0.0, n)]
            turning = Turning("gear operator", (0.0, -1.0, 0.0), (0.0, -reach, z))
            return [Piece("gearbox", [case]), Piece("valve stem", [shaft]), Piece("handwheel", wheel, turning)]
        half = self.wide * r + 0.02
        long, high = self.long * half, top + 2 * half
        mid = top + half
        if self.form == "drum":
            high = top + 1.6 * long
            found = [cylinder(half, top - 0.002, high, n)]
        elif self.form == "lying":
            found = [along("x", cylinder(0.95 * half, -long, long, n), 0, 0, mid)]
            found.append(box((1.2 * half, 1.5 * half, 1.98 * half), (0, 0, mid)))
            found += [
                along("x", cylinder(half, s * long - 0.08 * half, s * long + 0.08 * half, n), 0, 0, mid) for s in BOTH
            ]
        else:
            found = [box((2 * long, 1.7 * half, 2 * half), (0.15 * long, 0, mid))]
        if self.topped:
            found.append(cylinder(0.35 * half, high - 0.02 * half, high + 0.5 * half, min(n, 16)))
        if self.across:
            found = [moved(one, spun("z", np.pi / 2)) for one in found]
        return [Piece("actuator", found)]


class _Barrel(Params):
    """The body of a ball valve along x about the middle: a cylinder, in steps, square or between plates with rods."""

    dn: int = given(0, "nominal size", "mm")
    form: str = among(("plain", "stepped", "end piece", "plates", "square", "hexagon"), "how it is made")
    ends: str = among(("flanges", "flanges", "wrench", "stubs", "collars"), "its ends")
    length: float = between(3.2, 7.0, "(length - 40 mm) / radius of the pipe")
    wide: float = between(1.35, 2.2, "(radius of the middle - 4 mm) / of the pipe")
    share: float = between(0.4, 0.75, "length of the middle / length")
    rim: float = between(0.85, 1.05, "radius of its flanges / of standard ones", when=lambda p: p.ends == "flanges")
    thick: float = between(0.06, 0.13, "length of an end / length")
    rods: int = among((4, 4, 6), "rods through its plates", when=of_form("plates"), otherwise=0)

    @property
    def joint(self) -> str:
        """How it sits in a line."""
        return "flanged" if self.ends == "flanges" else "welded"

    def face_to_face(self, t: Table) -> float:
        """Its length [m]."""
        long = self.length * t.pipe.radius + 0.04
        return round(long, 6)

    def radius(self, t: Table) -> float:
        """Of its middle [m]."""
        return self.wide * t.pipe.radius + 0.004

    def solids(self, t: Table, n: int) -> list[Solid]:
        """Its solids, of so many sides."""
        r, half, b, bore = t.pipe.radius, self.face_to_face(t) / 2, self.radius(t), bore_of(t.dn, t.style)
        out, neck, mid = self.thick * 2 * half, 1.12 * r + 0.002, self.share * half
        rims = {"flanges": self.rim * t.flange.outer / 2, "wrench": 1.35 * r + 0.003, "collars": 1.5 * r + 0.004}
        rim, deep = rims.get(self.ends, 1.05 * r), out if self.ends != "wrench" else max(out, 0.16 * half)
        corners = 6 if self.ends == "wrench" else n
        faces = [ring(bore, rim, z, z + deep, corners) for z in (-half, half - deep)]
        shape = outline(neck, -half + 0.5 * deep, neck, -mid, b, -mid, b, mid, neck, mid, neck, half - 0.5 * deep)
        if self.form == "stepped":
            shape = [(neck, -half + 0.5 * deep), (neck, -mid), (0.8 * b, -mid), (0.8 * b, -0.5 * mid), (b, -0.5 * mid)]
            shape += [(b, 0.5 * mid), (0.8 * b, 0.5 * mid), (0.8 * b, mid), (neck, mid), (neck, half - 0.5 * deep)]
        elif self.form == "end piece":
            shape = [(neck, -half + 0.5 * deep), (neck, -mid), (b, -0.8 * mid), (b, 0.45 * mid), (1.18 * b, 0.45 * mid)]
            shape += [(1.18 * b, 0.7 * mid), (0.9 * b, 0.7 * mid), (neck, mid), (neck, half - 0.5 * deep)]
        middle: list[Solid] = [turned(shape, n, bore=bore)]
        if self.form in ("square", "hexagon"):
            run = ring(bore, neck, -half + 0.5 * deep, half - 0.5 * deep, n)
            across = rounded_rectangle(1.8 * b, 1.8 * b, 0.2 * b, 2)
            middle = [run, extrude(across, -mid, mid) if self.form == "square" else hexagon(1.8 * b, -mid, mid)]
        elif self.form == "plates":
            plate = extrude(rounded_rectangle(2 * b, 2 * b, 0.3 * b, 2), 0.0, 0.35 * mid)
            middle = [turned(outline(neck, -half + 0.5 * deep, neck, half - 0.5 * deep), n, bore=bore)]
            middle += [cylinder(0.85 * b, -0.7 * mid, 0.7 * mid, n)]
            middle += [moved(plate, at(0, 0, z)) for z in (-mid, 0.65 * mid)]
            bolt = cylinder(0.09 * b + 0.001, -1.1 * mid, 1.1 * mid, 6)
            middle.append(around(bolt, self.rods, 1.08 * b if self.rods == 4 else 0.93 * b, np.pi / 4))
        # The first solid has no face; both faces are of one part all the same.
        return [along("x", one) for one in (*faces, *middle)]


class PlainBarrel(_Plain, name="ball valve/plain barrel", sizes=sizes_between(15, 200), weight=2):
    """A ball valve whose body is a cylinder, a block or plates with rods; a neck, a lever or a drive."""

    body: _Barrel = nested(_Barrel, "body", fixed=lambda p: {"dn": p.dn})
    neck: float = between(0.35, 0.8, "radius of the neck / of the pipe")
    rise: float = between(0.1, 1.2, "height of the neck over the body / radius of the pipe")
    padded: bool = chance(0.4, "a pad on the neck")
    bracketed: bool = chance(0.3, "a bracket between neck and drive")
    drive: _Drive = nested(_Drive, "drive")

    def build(self, t: Table) -> Model:
        r, length, b = t.pipe.radius, self.body.face_to_face(t), self.body.radius(t)
        n, neck = self.n(t, b), self.neck * r + 0.002
        top = b + self.rise * r + 0.004
        if self.drive.form not in ("lever", "none"):
            top = max(top, 0.52 * t.flange.outer if self.body.ends == "flanges" else top)
        shell = [*self.body.solids(t, n), cylinder(neck, 0.5 * b, top, min(n, 16))]
        if self.padded:
            shell.append(box((2.6 * neck, 2.6 * neck, 0.1 * r + 0.003), (0, 0, top - 0.05 * r)))
        pieces = [Piece(_BODY, shell)]
        over = top + 0.2 * r + 0.003
        if self.bracketed and self.drive.form in ("lying", "box", "drum"):
            tall, wide = 0.9 * r + 0.02, 1.6 * neck + 0.004
            sides = [box((1.6 * wide, 0.003 + 0.04 * r, tall), (0, s * wide, top + tall / 2)) for s in BOTH]
            caps = [box((1.6 * wide, 2 * wide, 0.004), (0, 0, z)) for z in (top + 0.001, top + tall)]
            pieces.append(Piece("bracket", [*sides, *caps]))
            over = top + tall
        stem = cylinder(0.45 * neck, top - 0.003, over + 0.004, min(n, 10))
        pieces += [Piece("valve stem", [stem]), *self.drive.pieces(r, over, n)]
        self.put(t, length, pieces)
        return t.model(length, self.body.joint, "ball valve")


class PlainKnife(_Plain, name="knife gate valve/plain slab", sizes=sizes_between(50, 300), weight=1.5):
    """A knife gate valve of plates: a thin slab on the line, a tall frame, a stem with a wheel or a cylinder."""

    thick: float = between(0.35, 0.75, "(thickness - 20 mm) / radius of the pipe")
    form: str = among(("round", "round", "square", "flanges"), "outline of its body")
    chest: float = between(0.85, 1.1, "half the width of its chest / radius of the raised face")
    tall: float = between(0.2, 1.1, "height of the chest over the body / radius of the pipe")
    frame: str = among(("plates", "bars", "plates", "box"), "what carries the drive")
    reach: float = between(1.6, 3.0, "height of the frame / radius of the pipe")
    blade: bool = chance(0.5, "the knife is seen in the frame")
    driven: str = among(("wheel", "wheel", "cylinder", "cylinder", "motor"), "its drive")
    stroke: float = between(
        1.6, 3.0, "length of the cylinder / radius of the pipe", when=lambda p: p.driven == "cylinder"
    )
    rim: Rim = nested(Rim, "handwheel", when=lambda p: p.driven == "wheel")

    def build(self, t: Table) -> Model:
        r, size = t.pipe.radius, t.flange
        length = round(self.thick * r + 0.02, 6)
        face, half, bore = size.raised / 2, length / 2, max(bore_of(t.dn, t.style), 0.9 * t.pipe.bore)
        n = self.n(t, face)
        body = [along("x", ring(bore, face, -half, half, n))]
        if self.form == "flanges":
            body += [
                along("x", ring(bore, size.outer / 2, z, z + 0.3 * length, n)) for z in (-half, 0.7 * half - 0.3 * half)
            ]
        wide, low, top = self.chest * face, 0.86 * face, size.outer / 2 + self.tall * r
        deep = 0.7 * length
        if self.form == "square":
            slab = box((deep, 2 * wide, face), (0, 0, -0.5 * face))
            body.append(self._holed(slab, bore, face, deep))
        chest = box((deep, 2 * wide, top - low), (0, 0, (top + low) / 2))
        lip = box((1.5 * deep, 2.2 * wide, 0.1 * r + 0.004), (0, 0, top - 0.05 * r))
        body += [chest, lip]
        high, plate, stem = top + self.reach * r, 0.07 * r + 0.003, 0.09 * r + 0.003
        if self.frame == "bars":
            yoke = [cylinder(1.2 * plate, top - 0.01, high, 8)]
            yoke = [moved(yoke[0], at(0, s * 0.85 * wide)) for s in BOTH]
        elif self.frame == "plates":
            yoke = [box((0.9 * deep, plate, high - top), (0, s * 0.9 * wide, (high + top) / 2)) for s in BOTH]
        else:
            yoke = [box((plate, 1.8 * wide, high - top), (s * 0.45 * deep, 0, (high + top) / 2)) for s in BOTH]
        yoke.append(box((1.1 * deep, 2 * wide, 1.5 * plate), (0, 0, high)))
        pieces = [Piece(_BODY, body), Piece("yoke", yoke)]
        rod_ = [cylinder(stem, top - 0.002, high + 0.3 * r, 10)]
        if self.blade:
            pieces.append(
                Piece(
                    "valve disc", [box((0.25 * deep, 1.5 * wide, 0.5 * (high - top)), (0, 0, top + 0.2 * (high - top)))]
                )
            )
        pieces.append(Piece("valve stem", rod_))
        if self.driven == "wheel":
            pieces.append(Piece("handwheel", self.rim.solids(r, high + 0.3 * r, n), Turning("handwheel")))
        elif self.driven == "cylinder":
            long, can = self.stroke * r, 0.55 * r + 0.01
            drum = [
                cylinder(can, high - 0.002, high + long, n),
                box((2.2 * can, 2.2 * can, 0.15 * r), (0, 0, high + 0.07 * r)),
            ]
            drum.append(box((2.2 * can, 2.2 * can, 0.15 * r), (0, 0, high + long)))
            pieces.append(Piece("actuator", drum))
        else:
            drum = [cylinder(0.5 * r + 0.02, high, high + 0.8 * r + 0.08, n)]
            drum.append(along("x", cylinder(0.4 * r + 0.02, 0.0, 1.2 * r + 0.12, n), 0, 0, high + 0.4 * r + 0.04))
            pieces.append(Piece("actuator", drum))
        self.put(t, length, pieces)
        return t.model(length, "wafer", "knife gate valve")

    def _holed(self, slab: Solid, bore: float, face: float, deep: float) -> Solid:
        """A slab below the bore, which it leaves free."""
        sides = [box((deep, 0.3 * face, 1.2 * face), (0, s * 0.95 * face, -0.25 * face)) for s in BOTH]
        foot = box((deep, 2.2 * face, 0.2 * face), (0, 0, -0.92 * face))
        return merge([*sides, foot]) if bore else slab


class PlainSleeve(_Plain, name="pinch valve/plain sleeve", sizes=sizes_between(25, 300), weight=1.2):
    """A pinch valve of plain solids: a cylinder or a box between flanges, a port or a wheel with a bar."""

    form: str = among(("cylinder", "cylinder", "box", "barrel", "split"), "its body")
    length: float = between(3.4, 6.5, "(length - 60 mm) / radius of the pipe")
    wide: float = between(1.3, 1.9, "(radius of the body - 5 mm) / of the pipe")
    rim: float = between(0.9, 1.05, "radius of its flanges / of standard ones")
    turned_by: str = among(("air", "air", "wheel", "nothing", "drum"), "what closes it")
    handle: Rim = nested(Rim, "handwheel", when=lambda p: p.turned_by == "wheel")

    def build(self, t: Table) -> Model:
        r, length = t.pipe.radius, round(self.length * t.pipe.radius + 0.06, 6)
        half, rim, b, bore = length / 2, self.rim * t.flange.outer / 2, self.wide * r + 0.005, bore_of(t.dn, t.style)
        thick, n = min(t.flange.thickness, 0.2 * half), self.n(t, t.flange.outer / 2)
        back = half - thick
        shape = outline(rim, -half, rim, -back, b, -back, b, back, rim, back, rim, half)
        if self.form == "barrel":
            shape = outline(
                rim,
                -half,
                rim,
                -back,
                1.1 * r,
                -back,
                b,
                -0.5 * back,
                b,
                0.5 * back,
                1.1 * r,
                back,
                rim,
                back,
                rim,
                half,
            )
        elif self.form in ("box", "split"):
            shape = outline(rim, -half, rim, -back, 1.08 * r, -back, 1.08 * r, back, rim, back, rim, half)
        body = [along("x", turned(shape, n, bore=bore))]
        if self.form == "box":
            body.append(box((1.7 * back, 1.9 * b, 2.1 * b), (0, 0, 0)))
        elif self.form == "split":
            body.append(along("x", extrude(rounded_rectangle(2 * b, 1.8 * b, 0.4 * b, 3), -0.85 * back, 0.85 * back)))
            body.append(box((1.7 * back, 2.6 * b, 0.25 * b)))
        top = 1.05 * b if self.form in ("box", "split") else b
        pieces = [Piece(_BODY, body)]
        if self.turned_by == "air":
            body.append(cylinder(0.16 * r + 0.005, 0.8 * b, top + 0.3 * r + 0.01, min(n, 10)))
            body.append(hexagon(0.5 * r + 0.014, top, top + 0.1 * r + 0.006))
        elif self.turned_by == "drum":
            pieces.append(
                Piece(
                    "actuator",
                    [cylinder(0.8 * b, 0.8 * b, top + 1.4 * b, n), dome(0.8 * b, 0.3 * b, top + 1.39 * b, n)],
                )
            )
        elif self.turned_by == "wheel":
            high = max(top + 1.2 * r, 0.55 * t.flange.outer)
            pieces.append(Piece("valve stem", [cylinder(0.15 * r + 0.003, 0.8 * b, high + 0.2 * r, 10)]))
            body.append(box((0.5 * back, 1.2 * b, 0.3 * r), (0, 0, top + 0.1 * r)))
            pieces.append(Piece("handwheel", self.handle.solids(r, high, n), Turning("handwheel")))
        self.put(t, length, pieces)
        return t.model(length, "flanged", "pinch valve")


class PlainNeedle(_Plain, name="needle valve/plain block", sizes=(15, 20, 25), weight=2):
    """A needle valve of plain solids: a bar or a hexagon on the line, a bonnet, a bar or knob; plugs aside."""

    form: str = among(("bar", "bar", "hexagon", "round", "flat"), "its body")
    length: float = between(3.0, 6.5, "(length - 20 mm) / radius of the pipe")
    wide: float = between(1.1, 1.7, "half the width of the body / radius of the pipe")
    bonnets: int = whole(1, 2, "bonnets")
    rise: float = between(0.6, 2.2, "height of a bonnet / radius of the pipe")
    knob: str = among(("bar", "bar", "disc", "knurl", "none"), "its handle")
    reach: float = between(1.3, 2.8, "half the length of the bar / radius of the pipe")
    plug: bool = chance(0.35, "a plug aside")

    def build(self, t: Table) -> Model:
        r, length = t.pipe.radius, round(self.length * t.pipe.radius + 0.02, 6)
        half, b, bore = length / 2, self.wide * r + 0.002, bore_of(t.dn, t.style)
        n = self.n(t, b)
        run = ring(bore, 1.06 * r, -half, half, n)
        block = {
            "bar": lambda: extrude(rounded_rectangle(2 * b, 2 * b, 0.15 * b, 1), -0.85 * half, 0.85 * half),
            "hexagon": lambda: hexagon(2 * b, -0.85 * half, 0.85 * half),
            "round": lambda: cylinder(1.1 * b, -0.85 * half, 0.85 * half, n),
            "flat": lambda: extrude(rounded_rectangle(2.4 * b, 1.5 * b, 0.1 * b, 1), -0.9 * half, 0.9 * half),
        }[self.form]()
        body, turning, handles = [along("x", run), along("x", block)], None, []
        bonnet, stem = [], []
        for k in range(self.bonnets):
            x = 0.0 if self.bonnets == 1 else (k - 0.5) * 0.85 * length
            top = b + self.rise * r
            one = [hexagon(1.5 * r, 0.7 * b, b + 0.5 * self.rise * r), cylinder(0.5 * r, 0.7 * b, top, min(n, 12))]
            rod_ = [cylinder(0.25 * r, top - 0.002, top + 0.9 * r, 8)]
            grip: list[Solid] = []
            if self.knob == "bar":
                grip = [rod((0, -self.reach * r, top + 0.8 * r), (0, self.reach * r, top + 0.8 * r), 0.17 * r, 8)]
            elif self.knob == "disc":
                grip = [cylinder(self.reach * 0.7 * r, top + 0.5 * r, top + 0.9 * r, n)]
            elif self.knob == "knurl":
                grip = [cylinder(0.8 * r, top + 0.3 * r, top + 1.6 * r, min(n, 12))]
            bonnet += [moved(s, at(x)) for s in one]
            stem += [moved(s, at(x)) for s in rod_]
            handles += [moved(s, at(x)) for s in grip]
        if self.plug:
            body.append(
                along("y", merge([cylinder(0.5 * r, 0.6 * b, 1.3 * b, n), hexagon(1.3 * r, 1.15 * b, 1.6 * b)]))
            )
        pieces = [Piece(_BODY, body), Piece("valve bonnet", bonnet), Piece("valve stem", stem)]
        if handles:
            turning = Turning("handwheel") if self.bonnets == 1 else None
            pieces.append(Piece("handwheel", handles, turning))
        self.put(t, length, pieces)
        return t.model(length, "welded", "needle valve")


class PlainAngle(
    Melting, name="globe valve/plain corner", place="head", group="Valve assembly", label="valve", bundle=_BODY,
    sizes=sizes_between(15, 150), weight=1.5,
):  # fmt: skip
    """An angle or choke valve of plain solids: inlet and outlet at right angles, a bonnet, what turns it."""

    melted: bool = chance(0.6, "all of it is one mesh")
    flanged: bool = chance(0.7, "its outlet has a flange")
    form: str = among(("cylinder", "ball", "block", "cone"), "its body")
    reach: float = between(0.75, 1.2, "from the face to the axis / outside of the flange")
    swell: float = between(1.25, 1.9, "radius of the body / of the pipe")
    bonnet: Bonnet = nested(Bonnet, "bonnet")
    driven: str = among(("wheel", "wheel", "drive", "drum", "none"), "what turns it")
    rim: Rim = nested(Rim, "handwheel", when=lambda p: p.driven == "wheel")
    side: float = among((1.0, -1.0), "which side the outlet is on")

    def build(self, t: Table) -> Model:
        r, size = t.pipe.radius, t.flange
        reach, b, rim, thick = self.reach * size.outer, self.swell * r + 0.003, size.outer / 2, size.thickness
        n = self.n(t, rim)
        inlet = turned(outline(rim, 0.0, rim, thick, 1.15 * r, thick, 1.15 * r, reach), n)
        end = outline(1.12 * r, 0, 1.12 * r, reach - thick, rim, reach - thick, rim, reach)
        if not self.flanged:
            end = outline(1.12 * r, 0, 1.12 * r, reach - 1.2 * r, 1.35 * r, reach - 1.2 * r, 1.35 * r, reach)
        body = {
            "cylinder": lambda: cylinder(b, reach - 1.2 * b, reach + b, n),
            "ball": lambda: moved(
                turned([(b * float(np.cos(a)), b * float(np.sin(a))) for a in np.linspace(-1.4, 1.4, 9)], n),
                at(0, 0, reach),
            ),
            "block": lambda: box((1.9 * b, 1.9 * b, 2.2 * b), (0, 0, reach)),
            "cone": lambda: turned(outline(0.8 * b, reach - 1.3 * b, 1.1 * b, reach + 0.8 * b), n),
        }[self.form]()
        outlet = along("y" if self.side > 0 else "-y", turned(end, n), 0, 0, reach)
        over, high = self.bonnet.pieces(t, b, n)
        lifted = [Piece(one.name, [moved(s, at(0, 0, reach)) for s in one.solids]) for one in over]
        shell = [one for piece in lifted if piece.name == _BODY for one in piece.solids]
        pieces = [Piece(_BODY, [inlet, outlet, body, *shell]), *(piece for piece in lifted if piece.name != _BODY)]
        top = reach + high
        if self.driven == "wheel":
            pieces.append(Piece("handwheel", [moved(s, at(0, 0, reach)) for s in self.rim.solids(r, high, n)]))
        elif self.driven == "drive":
            wide = 1.6 * r + 0.03
            pans = turned(
                outline(0.4 * wide, top, wide, top + 0.5 * wide, wide, top + 0.6 * wide, 0.5 * wide, top + wide), n
            )
            pieces.append(Piece("actuator", [pans]))
        elif self.driven == "drum":
            pieces.append(Piece("actuator", [cylinder(1.2 * r + 0.02, top - 0.004, top + 3 * r + 0.05, n)]))
        put_pieces(t.along("x").spun("z", np.pi), pieces, self.melted)
        return t.model(kind="globe valve")


PLAIN_BODIES = families_of(PlainBarrel, PlainKnife, PlainSleeve, PlainNeedle, PlainAngle)
