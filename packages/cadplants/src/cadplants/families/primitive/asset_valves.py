"""Valves as asset packs have them: a body with its flanges, bonnet and wheel or lever in one low mesh or a few."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import Device, families_of
from cadplants.builder.draws import of_form
from cadplants.builder.melting import FACETS, FACETS_TEXT, Melting, Piece, put_pieces, sides_of
from cadplants.builder.params import among, between, chance, nested
from cadplants.builder.table import Table, outline
from cadplants.families.valves.asset_parts import Bonnet, FlangedBody, Grip, Rim, screwed_body
from cadplants.model.family import Family, Model
from cadplants.model.plant import Turning
from cadplants.model.standards import sizes_between
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, moved
from cadplants.solids.primitives import along, around, box, cylinder, dome, hexagon, ring, turned
from cadplants.solids.transforms import at, spun

__all__ = ["KIT_VALVES"]

_BODY = "valve body"
_SMALL, _MIDDLE = sizes_between(15, 50), sizes_between(15, 300)
_CALLED = "what it is taken for"


def _corners() -> int:
    return among((6, 6, 8, 0), "sides of its ends; 0: round")


class _Kit(Melting, place="inline", group="Valve assembly", label="valve", bundle=_BODY, sizes=_MIDDLE):
    """A valve of an asset pack."""

    melted: bool = chance(0.65, "all of it is one mesh")

    def put(self, t: Table, length: float, pieces: list[Piece]) -> None:
        """Puts pieces about the middle of a line's stretch down [m]."""
        put_pieces(t.at(length / 2), _joined(pieces), self.melted)


def _joined(pieces: list[Piece]) -> list[Piece]:
    """The pieces with those of a body as one, the first."""
    body = [solid for piece in pieces if piece.name == _BODY for solid in piece.solids]
    return [Piece(_BODY, body), *(piece for piece in pieces if piece.name != _BODY)]


class _Flanged(_Kit):
    """A valve with flanges of its own in its mesh."""

    mated: bool = chance(0.6, "the line has flanges against its own")
    body: FlangedBody = nested(FlangedBody, "body", fixed=lambda p: {"dn": p.dn})

    def done(self, t: Table, pieces: list[Piece], kind: str) -> Model:
        """What was put down, as a valve in a line."""
        length = self.body.face_to_face(t)
        shell = Piece(_BODY, self.body.solids(t, self.n(t, t.flange.outer / 2)))
        self.put(t, length, [shell, *pieces])
        return t.model(length, "flanged" if self.mated else "welded", kind)


class FlangedWheel(_Flanged, name="valve/flanged with wheel", weight=4):
    """A flanged body, a bonnet, a stem, a handwheel."""

    bonnet: Bonnet = nested(Bonnet, "bonnet")
    rim: Rim = nested(Rim, "handwheel")
    called: str = among(("gate valve", "globe valve", "valve"), _CALLED)

    def build(self, t: Table) -> Model:
        r, b = t.pipe.radius, self.body.radius(t)
        pieces, top = self.bonnet.pieces(t, b, self.n(t, b))
        wheel = self.rim.solids(r, top, self.n(t, 2 * r))
        return self.done(t, [*pieces, Piece("handwheel", wheel, Turning("handwheel"))], self.called)


class FlangedLever(_Flanged, name="valve/flanged with lever", weight=3):
    """A flanged body with a neck or a pad and a lever."""

    rise: float = between(0.2, 1.2, "height of the neck over the body / radius of the pipe")
    neck: float = between(0.35, 0.8, "radius of the neck / of the pipe")
    pad: str = among(("none", "square", "round", "box"), "what is on the neck")
    grip: Grip = nested(Grip, "lever")

    def build(self, t: Table) -> Model:
        r, b = t.pipe.radius, self.body.radius(t)
        neck, foot = self.neck * r + 0.002, 0.5 * b
        top = max(b + self.rise * r, 0.45 * t.flange.outer) + 0.006
        n, wide, thick = self.n(t, neck), 1.5 * neck, 0.12 * r + 0.003
        post: list[Solid] = [cylinder(neck, foot, top, n)]
        if self.pad == "round":
            post.append(cylinder(wide, top - thick, top, n))
        elif self.pad == "square":
            post.append(box((2 * wide, 2 * wide, thick), (0, 0, top - thick / 2)))
        elif self.pad == "box":
            post = [box((1.8 * neck, 2.2 * neck, top - foot), (0, 0, (top + foot) / 2))]
        over = top + 0.25 * r + 0.004
        pieces = [
            Piece(_BODY, post),
            Piece("valve stem", [cylinder(0.5 * neck, top - 0.002, over + 0.004, min(n, 10))]),
        ]
        lever = Piece("lever", self.grip.solids(r, over, self.n(t, r)), Turning("lever"))
        return self.done(t, [*pieces, lever], "ball valve")


class FlangedDriven(_Flanged, name="valve/flanged with actuator", weight=2):
    """A flanged body, a bonnet or a bracket, and a drive: a diaphragm's pans, a box, a barrel, a lying cylinder."""

    bonnet: Bonnet = nested(Bonnet, "bonnet", fixed=lambda _: {"yoked": True})
    form: str = among(("pans", "pans", "dome", "box", "barrel", "lying"), "what drives it")
    wide: float = between(1.2, 2.4, "(radius of the drive - 25 mm) / of the pipe")
    tall: float = between(0.7, 1.8, "height of the drive / its radius")
    topped: float = among((0.0, 0.0, 0.25, 0.5), "radius of what stands on it / of the drive; 0: nothing")
    called: str = among(("control valve", "control valve", "ball valve", "valve"), _CALLED)

    def build(self, t: Table) -> Model:
        r, b = t.pipe.radius, self.body.radius(t)
        pieces, low = self.bonnet.pieces(t, b, self.n(t, b))
        wide = self.wide * r + 0.025
        high, n = low + self.tall * wide, self.n(t, wide)
        solids = self._drive(wide, low - 0.004, high, n)
        if self.topped:
            solids.append(cylinder(self.topped * wide, high - 0.01 * wide, high + 0.4 * wide, n))
        return self.done(t, [*pieces, Piece("actuator", solids)], self.called)

    def _drive(self, wide: float, low: float, high: float, n: int) -> list[Solid]:
        mid = (low + high) / 2
        if self.form == "pans":
            lip = 0.05 * wide + 0.002
            shape = outline(0.4 * wide, low, 0.85 * wide, mid - 2 * lip, wide, mid - lip, wide, mid + lip)
            return [turned([*shape, (0.85 * wide, mid + 2 * lip), (0.35 * wide, high)], n)]
        if self.form == "dome":
            return [cylinder(wide, low, mid, n), dome(wide, high - mid, mid, n)]
        if self.form == "box":
            return [box((1.7 * wide, 1.3 * wide, high - low), (0, 0, mid))]
        if self.form == "barrel":
            return [cylinder(0.7 * wide, low, high, n), cylinder(0.8 * wide, low, low + 0.1 * wide, n)]
        can = [cylinder(0.5 * (high - low), -1.6 * wide, 1.6 * wide, n)]
        return [along("x", can[0], 0, 0, mid), box((1.2 * wide, 0.9 * wide, high - low), (0, 0, mid))]


class Geared(_Kit, name="valve/disc with gearbox", sizes=sizes_between(40, 400), weight=2):
    """A butterfly valve: a ring, lugs or two flanges, a neck, a gearbox with a wheel aside, or a lever."""

    form: str = among(("ring", "lugs", "ring", "flanges"), "its body")
    length: float = between(0.18, 0.42, "(face to face - 20 mm) / outside of the pipe")
    wide: float = between(0.92, 1.0, "radius of the ring / of the raised face")
    neck: float = between(0.12, 0.3, "(radius of the neck - 8 mm) / of the pipe")
    rise: float = between(0.25, 0.8, "height of the neck over the flange / radius of the pipe")
    geared: bool = chance(0.75, "a gearbox")
    case: float = between(
        0.35, 0.75, "(half the width of the gearbox - 25 mm) / radius of the pipe", when=lambda p: p.geared
    )
    round_: bool = chance(0.4, "the gearbox is round", when=lambda p: p.geared)
    rim: Rim = nested(Rim, "handwheel", when=lambda p: p.geared)
    grip: Grip = nested(Grip, "lever", when=lambda p: not p.geared)
    opened: bool = chance(0.4, "its disc stands open")

    def build(self, t: Table) -> Model:
        r, size = t.pipe.radius, t.flange
        long = 0.02 + self.length * t.pipe.outer * (1.6 if self.form == "flanges" else 1.0)
        length, n = round(long, 6), self.n(t, size.outer / 2)
        wide, bore = self.wide * size.raised / 2, t.pipe.bore
        half, neck, foot = length / 2, min(self.neck * r + 0.008, 0.45 * long), 0.99 * bore
        if self.form == "lugs":
            wide = size.circle / 2
        shell = [ring(bore, wide, -half, half, n)]
        if self.form == "flanges":
            thick = 0.22 * length
            shell += [ring(bore, size.outer / 2, z, z + thick, n) for z in (-half, half - thick)]
        elif self.form == "lugs":
            lug = cylinder(0.9 * size.bolt, -0.8 * half, 0.8 * half, min(n, 10))
            shell.append(around(lug, size.n_bolts, size.circle / 2, np.pi / size.n_bolts))
        top = size.outer / 2 + self.rise * r + 0.01
        body = [*(along("x", one) for one in shell), cylinder(neck, 0.92 * wide, top, min(n, 16))]
        body.append(cylinder(1.7 * neck, top - 0.3 * neck, top, min(n, 16)))
        blade = moved(along("x", cylinder(foot, -0.04 * bore, 0.04 * bore, n)), spun("z", 1.2 * self.opened))
        pieces = [Piece(_BODY, body), Piece("valve disc", [blade])]
        pieces += self._gear(t, top, n) if self.geared else self._lever(t, top, neck, n)
        self.put(t, length, pieces)
        return t.model(length, "flanged" if self.form == "flanges" else "wafer", "butterfly valve")

    def _lever(self, t: Table, top: float, neck: float, n: int) -> list[Piece]:
        stem = cylinder(0.5 * neck, top - 0.003, top + 0.02, min(n, 10))
        lever = self.grip.solids(0.8 * t.pipe.radius, top + 0.012, n)
        return [Piece("valve stem", [stem]), Piece("lever", lever, Turning("lever"))]

    def _gear(self, t: Table, top: float, n: int) -> list[Piece]:
        r = t.pipe.radius
        half = self.case * r + 0.025
        tall, reach, size = 0.9 * half, 2.6 * half, 0.5 * r
        x, z = 0.5 * half, top + 0.5 * tall
        case = [box((2 * half, 1.6 * half, tall), (0, 0, z))]
        if self.round_:
            case = [cylinder(half, top - 0.001, top + tall, n), box((half, 1.9 * half, 0.7 * tall), (x, 0, z))]
        shaft = along("-y", cylinder(0.12 * half + 0.002, 0.6 * half, reach + 0.01, min(n, 10)), x, 0, z)
        wheel = [along("-y", one, x, -reach, z) for one in self.rim.solids(size, 0.0, n)]
        turning = Turning("gear operator", (0.0, -1.0, 0.0), (x, -reach, z))
        return [Piece("gearbox", case), Piece("valve stem", [shaft]), Piece("handwheel", wheel, turning)]


def _lids(form: str) -> tuple[str, ...]:
    """The lids that a body of a form may have: one that doesn't swell is a piece of pipe without."""
    lids = ("disc", "disc", "dome", "square", "cap")
    return lids if form in ("waist", "straight") else (*lids, "none")


class FlangedLid(_Flanged, name="check valve/flanged with lid", weight=3):
    """A swing or lift check valve: a flanged body that swells, a lid on it, nothing that turns it."""

    place_of: float = among((0.0, 0.0, -0.08, 0.08), "of the lid from the middle / face to face")
    rise: float = between(1.0, 1.6, "height of the lid's seat / radius of the body")
    wide: float = between(0.6, 0.95, "radius of the chest / of the body")
    lip: float = between(1.15, 1.55, "radius of the lid / of the chest")
    form: str = among(lambda p: _lids(p.body.form), "its lid")
    bolts: int = among((0, 0, 4, 6, 8), "heads of bolts on the lid", when=of_form("disc", "dome"), otherwise=0)
    lean: float = among((0.0, 0.0, 0.4), "of the lid towards an end", "rad")

    def build(self, t: Table) -> Model:
        r, b = t.pipe.radius, self.body.radius(t)
        chest, plate, n = self.wide * b, 0.1 * r + 0.004, self.n(t, b)
        seat, lip = self.rise * b + 0.25 * r, self.lip * self.wide * b
        low: list[Solid] = [cylinder(chest, 0.4 * b, seat, n)]
        lid: list[Solid] = [cylinder(lip, seat, seat + 1.2 * plate, n)]
        if self.form == "dome":
            lid.append(dome(0.85 * lip, 0.5 * lip, seat + 1.1 * plate, n))
        elif self.form == "cap":
            lid = [
                cylinder(0.95 * chest, seat, seat + 0.3 * r, n),
                hexagon(1.1 * chest, seat + 0.25 * r, seat + 0.7 * r),
            ]
        elif self.form == "square":
            lid = [box((1.8 * lip, 1.8 * lip, plate), (0, 0, seat + plate / 2))]
            low.append(box((1.8 * lip, 1.8 * lip, plate), (0, 0, seat - plate / 2)))
        if self.bolts:
            low.append(cylinder(lip, seat - plate, seat, n))
            bolt = 0.1 * lip + 0.002
            lid.append(around(hexagon(2 * bolt, seat + plate, seat + 1.2 * plate + bolt), self.bolts, 0.86 * lip))
        if self.form == "none":
            lid, low = [], []
        way = at(self.place_of * self.body.face_to_face(t)) @ spun("y", self.lean)
        leaning = [[moved(one, way) for one in some] for some in (low, lid)]
        pieces = [Piece(_BODY, leaning[0]), Piece("valve bonnet", leaning[1])]
        return self.done(t, pieces, "check valve")


class Sleeve(_Kit, name="check valve/sleeve", sizes=sizes_between(15, 100), weight=2.5):
    """A check valve without flanges: a sleeve a little wider than the pipe, at times with steps or two hexagons."""

    form: str = among(("plain", "stepped", "hexagons", "hexagons", "cones", "ball"), "how it is made")
    length: float = between(2.2, 5.5, "(length - 15 mm) / radius of the pipe")
    wide: float = between(1.15, 1.75, "radius of its middle / of the pipe")
    ends: float = between(1.15, 1.4, "radius of its ends / of the pipe")
    corners: int = _corners()
    share: float = between(0.14, 0.28, "length of an end / length")
    lidded: float = among((0.0, 0.0, 0.0, 0.6, 0.8), "radius of a plug on it / of the middle; 0: none")

    def build(self, t: Table) -> Model:
        r, style = t.pipe.radius, t.style
        length, wide, ends = round(self.length * r + 0.015, 6), self.wide * r, self.ends * r
        n, half, bore = self.n(t, wide), length / 2, bore_of(t.dn, style)
        shape = outline(1.12 * wide, -half, 1.12 * wide, half)
        if self.form == "stepped":
            a = (0.5 - self.share) * length
            shape = outline(ends, -half, ends, -a, wide * 1.1, -a, wide * 1.1, a, ends, a, ends, half)
        elif self.form == "cones":
            shape = outline(1.05 * r, -half, wide, -0.3 * half, wide, 0.3 * half, 1.05 * r, half)
        elif self.form == "ball":
            shares = np.linspace(-0.9, 0.9, 7)
            swell = [(max(ends, 1.25 * wide * float(np.sqrt(1 - s * s))), 0.6 * half * float(s)) for s in shares]
            shape = [(ends, -half), *swell, (ends, half)]
        body = [along("x", turned(shape, n, bore=bore))]
        if self.form == "hexagons":
            body = screwed_body(t, length, ends, wide, self.corners, n, self.share)
        if self.lidded:
            plug = self.lidded * wide
            body += [cylinder(plug, 0.4 * wide, 1.3 * wide, n), hexagon(1.3 * plug, 1.2 * wide, 1.6 * wide)]
        self.put(t, length, [Piece(_BODY, body)])
        return t.model(length, "welded", "check valve")


class Screwed(_Kit, name="valve/screwed with handle", sizes=_SMALL, weight=3):
    """A small screwed valve: two wrench ends, a middle, a neck with a nut, a wheel or a lever."""

    length: float = between(2.6, 5.0, "(length - 20 mm) / radius of the pipe")
    wide: float = between(1.3, 1.8, "radius of its middle / of the pipe")
    ends: float = between(1.2, 1.5, "radius of its ends / of the pipe")
    corners: int = _corners()
    neck: float = between(0.45, 0.95, "radius of the neck / of the pipe")
    rise: float = between(0.3, 2.0, "height of the neck over the middle / radius of the pipe")
    nut: bool = chance(0.6, "a nut on the neck")
    over: float = between(0.3, 1.8, "height of the stem over that / radius of the pipe")
    wheeled: bool = chance(0.5, "a wheel, not a lever")
    rim: Rim = nested(Rim, "handwheel", when=lambda p: p.wheeled)
    grip: Grip = nested(Grip, "lever", when=lambda p: not p.wheeled)

    def build(self, t: Table) -> Model:
        r, length = t.pipe.radius, round(self.length * t.pipe.radius + 0.02, 6)
        wide, neck = self.wide * r, self.neck * r
        n, top = self.n(t, wide), wide + self.rise * r
        body = screwed_body(t, length, self.ends * r, wide, self.corners, n)
        body.append(cylinder(neck, 0.5 * wide, top, n))
        pieces = [Piece(_BODY, body)]
        if self.nut:
            pieces.append(Piece("valve bonnet", [hexagon(2.1 * neck, top - 0.3 * r, top + 0.35 * r)]))
            top += 0.35 * r
        high = top + self.over * r * (1.0 if self.wheeled else 0.3)
        pieces.append(Piece("valve stem", [cylinder(0.2 * r + 0.0015, top - 0.1 * r, high + 0.3 * r, min(n, 8))]))
        if self.wheeled:
            pieces.append(Piece("handwheel", self.rim.solids(0.8 * r, high, n), Turning("handwheel")))
        else:
            pieces.append(Piece("lever", self.grip.solids(r, high, n), Turning("lever")))
        self.put(t, length, pieces)
        return t.model(length, "welded", "ball valve" if not self.wheeled else "globe valve")


class FlangedLeg(
    Device, name="strainer/flanged leg", place="inline", group="Pipe assembly", label="strainer", bundle="strainer",
    sizes=_MIDDLE, weight=3,
):  # fmt: skip
    """A Y strainer in one mesh: a flanged body, a slanting or upright leg, a lid, maybe a plug."""

    facets: int = among(FACETS, FACETS_TEXT)
    mated: bool = chance(0.6, "the line has flanges against its own")
    body: FlangedBody = nested(FlangedBody, "body", fixed=lambda p: {"dn": p.dn})
    slant: float = among((0.65, 0.7, 0.75, 0.75, 0.8, 1.0), "of the leg from upright / half a turn")
    foot: float = between(-0.12, 0.1, "where the leg begins, from the middle / face to face")
    wide: float = between(0.85, 1.4, "radius of the leg / of the pipe")
    far: float = between(2.6, 4.4, "(length of the leg - 15 mm) / radius of the pipe")
    lid: float = between(1.05, 1.6, "radius of the lid / of the leg")
    cut: str = among(("disc", "disc", "hexagon", "square", "dome"), "form of the lid")
    plug: str = among(("none", "none", "hexagon", "stub", "heads"), "what is in the lid")
    apart: bool = chance(0.25, "the lid is a piece of its own")

    def build(self, t: Table) -> Model:
        r, length = t.pipe.radius, self.body.face_to_face(t)
        leg, far, thick = self.wide * r, self.far * r + 0.015, 0.12 * r + 0.005
        n, lid, end = sides_of(t, t.flange.outer / 2, self.facets), self.lid * self.wide * r, far + thick
        cover: list[Solid] = [cylinder(lid, far, end, 6 if self.cut == "hexagon" else n)]
        if self.cut == "square":
            cover = [box((1.7 * lid, 1.7 * lid, thick), (0, 0, far + thick / 2))]
        elif self.cut == "dome":
            cover.append(dome(0.8 * lid, 0.5 * lid, far + 0.9 * thick, n))
            end += 0.45 * lid
        if self.plug == "hexagon":
            cover.append(hexagon(0.7 * leg, end - 0.1 * thick, end + 0.25 * leg))
        elif self.plug == "stub":
            cover.append(cylinder(0.25 * leg, end - 0.1 * thick, end + 0.9 * leg, min(n, 10)))
        elif self.plug == "heads":
            cover.append(around(hexagon(0.22 * lid, far + 0.5 * thick, far + thick + 0.12 * lid), 6, 0.84 * lid))
        way = at(self.foot * length) @ spun("y", self.slant * np.pi)
        arm = moved(cylinder(leg, 0.0, far, n), way)
        t, lids = t.at(length / 2), [moved(one, way) for one in cover]
        shell = [*self.body.solids(t, n), arm]
        t.add("strainer", *shell, *([] if self.apart else lids), of="valve")
        t.add("strainer", *(lids if self.apart else []), of="valve")
        return t.model(length, "flanged" if self.mated else "welded")


class SafetyAngle(
    Melting, name="relief valve/angle in one", place="head", group="Valve assembly", label="valve", bundle=_BODY,
    sizes=sizes_between(15, 150), weight=1.5,
):  # fmt: skip
    """A flanged safety valve in one mesh: inlet, outlet aside, a tall bonnet, a cap, maybe a lever."""

    melted: bool = chance(0.7, "all of it is one mesh")
    reach: float = between(0.65, 1.0, "from the face to the axis / outside of the flange")
    swell: float = between(1.2, 1.7, "radius of the body / of the pipe")
    outlet: float = between(1.0, 1.3, "size of the outlet / of the inlet")
    tower: float = between(1.6, 3.6, "height of the bonnet / radius of the body")
    slim: float = between(0.55, 0.9, "radius of the bonnet's top / of the body")
    cap: float = between(0.5, 0.8, "radius of the cap / of the body")
    side: float = among((1.0, -1.0), "which side the outlet is on")
    levered: bool = chance(0.5, "a lever")

    def build(self, t: Table) -> Model:
        r, size = t.pipe.radius, t.flange
        reach, b, rim, thick = self.reach * size.outer, self.swell * r + 0.003, size.outer / 2, size.thickness
        n, out = self.n(t, rim), self.outlet
        inlet = turned(outline(rim, 0.0, rim, thick, 1.15 * r, thick, 1.15 * r, reach), n)
        branch = turned(
            outline(1.1 * r * out, 0, 1.1 * r * out, reach - thick, rim * out, reach - thick, rim * out, reach), n
        )
        low, high = reach + 0.9 * b, reach + 0.9 * b + self.tower * b
        chest = turned(outline(0.8 * b, reach - b, b, reach - 0.5 * b, b, low), n)
        collar = outline(1.25 * b, low, 1.25 * b, low + 0.3 * b, 0.9 * b, low + 0.3 * b, self.slim * b, high)
        top = high + 0.9 * b
        lifted = along("y" if self.side > 0 else "-y", branch, 0, 0, reach)
        pieces = [Piece(_BODY, [inlet, lifted, chest]), Piece("valve bonnet", [turned(collar, n)])]
        cap: list[Solid] = [cylinder(self.cap * b, high - 0.05 * b, top, n)]
        if self.levered:
            bar = box((0.2 * b, 2.8 * b, 0.2 * b), (0, -self.side * 1.1 * b, top))
            pieces.append(Piece("lever", [bar]))
        pieces[1] = Piece("valve bonnet", [*pieces[1].solids, *cap])
        put_pieces(t.along("x").spun("z", np.pi), pieces, self.melted)
        return t.model(kind="relief valve")


KIT_VALVES: tuple[Family, ...] = families_of(
    FlangedWheel, FlangedLever, FlangedDriven, Geared, FlangedLid, Sleeve, Screwed, FlangedLeg, SafetyAngle,
)  # fmt: skip
