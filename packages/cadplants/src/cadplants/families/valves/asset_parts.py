"""What valves of asset packs are put together from: flanged bodies, bonnets, wheels and levers of few plain solids."""

from __future__ import annotations

import numpy as np

from cadplants.builder.draws import of_form
from cadplants.builder.melting import Piece
from cadplants.builder.params import Params, among, between, chance, given, whole
from cadplants.builder.table import Table, outline
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, extrude, moved
from cadplants.solids.primitives import BOTH, along, around, ball, box, cylinder, hexagon, ring, rod, torus, turned
from cadplants.solids.transforms import at, spun

__all__ = ["Bonnet", "FlangedBody", "Grip", "Rim", "screwed_body"]


class Rim(Params):
    """A handwheel about z: a round or flat rim on spokes or crossed bars, a disc, a dished disc, a lobed knob."""

    form: str = among(("round", "round", "band", "disc", "dished", "lobed", "bars"), "how it is made")
    wide: float = between(1.1, 2.6, "(radius - 15 mm) / radius of the pipe")
    thick: float = between(0.05, 0.13, "half its thickness / radius")
    hub: float = between(0.12, 0.28, "radius of its hub / radius")
    spokes: int = whole(2, 6, "spokes", when=of_form("round", "band"))
    flat: bool = chance(0.4, "its spokes are flat bars", when=of_form("round", "band"))
    dish: float = among(
        (0.0, 0.0, 0.15, 0.3),
        "how far its hub is behind the rim / radius",
        when=of_form("round", "band"),
        otherwise=0.0,
    )
    lobes: int = whole(4, 8, "lobes of a knob", when=of_form("lobed"))
    turn: float = between(0, 6, "how far it is turned", "rad")

    def below(self, radius: float) -> float:
        """How far its rim's underside is below the rim's middle, for a pipe of a radius [m]."""
        return 1.5 * self.thick * (self.wide * radius + 0.015)

    def solids(self, radius: float, z: float, n: int) -> list[Solid]:
        """Its solids for a pipe of a radius, the rim's middle on a height, of so many sides [m]."""
        wide = self.wide * radius + 0.015
        thick, hub, low = self.thick * wide, self.hub * wide, z - self.dish * wide
        boss = cylinder(hub, low - 1.4 * thick, low + 1.2 * thick, min(n, 12))
        if self.form == "disc":
            return [cylinder(wide, z - thick, z + thick, n), boss]
        if self.form == "dished":
            edge = outline(0.75 * wide, z - thick, wide, z + thick, wide, z + 2 * thick, 0.7 * wide, z + 0.6 * thick)
            return [turned(edge, n), boss]
        if self.form == "lobed":
            angles = np.arange(6 * self.lobes) * np.pi / (3 * self.lobes) + self.turn
            reach = wide * (0.8 + 0.12 * np.cos(self.lobes * angles))
            corners = np.column_stack([reach * np.cos(angles), reach * np.sin(angles)])
            return [extrude(corners, z - thick, z + thick), boss]
        rim = moved(torus(wide - thick, thick, n, 6), at(0, 0, z))
        if self.form == "band":
            rim = ring(wide - 1.2 * thick, wide, z - 1.5 * thick, z + 1.5 * thick, n)
        # The rim's middle lies nearer between its corners.
        far = (wide - thick) * float(np.cos(np.pi / n))
        if self.form == "bars":
            bars = [
                moved(box((2 * far, thick, thick), (0, 0, z)), spun("z", self.turn + k * np.pi / 2)) for k in (0, 1)
            ]
            return [rim, boss, *bars]
        spoke = rod((0.5 * hub, 0, low), (far, 0, z), 0.6 * thick, 6)
        if self.flat:
            tilt = float(np.arctan2(z - low, far))
            spoke = moved(box((far / np.cos(tilt), 1.6 * thick, 0.7 * thick), (far / 2, 0, 0)), spun("y", -tilt))
            spoke = moved(spoke, at(0, 0, low))
        return [rim, boss, around(spoke, self.spokes, 0.0, self.turn)]


class Grip(Params):
    """A lever on a stem about z: a flat or cranked bar, a round one with a knob, a cross bar, wings."""

    form: str = among(("flat", "cranked", "cranked", "round", "tee", "wing"), "how it is made")
    long: float = between(2.8, 6.0, "(length - 40 mm) / radius of the pipe")
    wide: float = between(0.2, 0.5, "(width - 6 mm) / radius of the pipe")
    rise: float = between(0.1, 0.35, "of its grip / length", when=of_form("cranked", "round"))
    turn: float = among((0.0, 0.0, np.pi / 2, np.pi), "where it points, from along the run", "rad")

    def solids(self, radius: float, z: float, n: int) -> list[Solid]:
        """Its solids for a pipe of a radius, on a height, of so many sides [m]."""
        wide, thick = self.wide * radius + 0.006, 0.1 * radius + 0.003
        long = min(self.long * radius + 0.04, 0.7) * (0.45 if self.form in ("tee", "wing") else 1.0)
        hub = cylinder(0.8 * wide, z - 0.002, z + 1.6 * thick, min(n, 10))
        if self.form == "flat":
            solids = [box((long, wide, thick), (0.42 * long, 0, z + thick / 2))]
        elif self.form == "cranked":
            high, near, far = self.rise * long, 0.18 * long, 0.38 * long
            slope = float(np.arctan2(high, far - near))
            middle = at((near + far) / 2, 0, z + thick / 2 + high / 2) @ spun("y", -slope)
            step = moved(box(((far - near) / np.cos(slope) + thick, wide, thick)), middle)
            foot = box((near + 0.8 * wide, wide, thick), (near / 2 - 0.4 * wide, 0, z + thick / 2))
            solids = [foot, step, box((long - far, wide, 1.3 * thick), ((long + far) / 2, 0, z + thick / 2 + high))]
        elif self.form == "round":
            end = (long, 0.0, z + self.rise * long)
            solids = [rod((0, 0, z), end, 0.35 * wide, min(n, 8)), moved(ball(0.6 * wide, min(n, 10)), at(*end))]
        elif self.form == "tee":
            solids = [rod((-long, 0, z + thick), (long, 0, z + thick), 0.35 * wide, min(n, 8))]
        else:
            solids = [box((2 * long, thick, wide), (0, 0, z + 0.5 * wide))]
        return [moved(one, spun("z", self.turn)) for one in (hub, *solids)]


def _swelling(form: str, neck: float, bulge: float, reach: float) -> list[tuple[float, float]]:
    """The outline between the backs of two flanges, about the middle [m]."""
    if form == "round":
        shares = np.linspace(-0.95, 0.95, 7)
        return [(max(neck, bulge * float(np.sqrt(1 - s * s))), float(s) * 0.8 * reach) for s in shares]
    if form == "barrel":
        return outline(neck, -0.7 * reach, bulge, -0.5 * reach, bulge, 0.5 * reach, neck, 0.7 * reach)
    if form == "cones":
        return outline(bulge, -0.12 * reach, bulge, 0.12 * reach)
    if form == "waist":
        return outline(0.5 * (neck + bulge), -0.9 * reach, neck, 0.0, 0.5 * (neck + bulge), 0.9 * reach)
    return outline(neck, 0.0)


class FlangedBody(Params):
    """A body of revolution along x about the middle, with flanges of its own; between them it swells or not."""

    dn: int = given(0, "nominal size", "mm")
    form: str = among(("round", "round", "barrel", "cones", "waist", "straight"), "what is between its flanges")
    length: float = between(0.75, 1.5, "(face to face - the next) / outside of the flange")
    more: float = between(0.0, 0.06, "what that is longer by", "m")
    rim: float = between(0.82, 1.08, "radius of its flanges / of standard ones")
    thick: float = between(0.5, 1.5, "thickness of its flanges / of standard ones")
    neck: float = between(1.06, 1.4, "(radius of its necks - 3 mm) / of the pipe")
    bulge: float = between(1.35, 2.1, "(radius of its swelling - 6 mm) / of the pipe")
    bolted: bool = chance(0.2, "bolts stand in its flanges")

    def face_to_face(self, t: Table) -> float:
        """Its length [m]."""
        return round(t.flange.outer * self.length + self.more, 6)

    def radius(self, t: Table) -> float:
        """Radius of what stands in its middle [m]."""
        if self.form in ("waist", "straight"):
            return self.neck * t.pipe.radius + 0.003
        return min(self.bulge * t.pipe.radius + 0.006, 0.44 * self.face_to_face(t))

    def solids(self, t: Table, n: int) -> list[Solid]:
        """Its solids, of so many sides."""
        half, rim = self.face_to_face(t) / 2, self.rim * t.flange.outer / 2
        thick, neck = min(self.thick * t.flange.thickness, 0.3 * half), self.neck * t.pipe.radius + 0.003
        back = half - thick
        middle = _swelling(self.form, neck, self.radius(t), back)
        ends = outline(rim, -half, rim, -back, neck, -back), outline(neck, back, rim, back, rim, half)
        solids = [turned([*ends[0], *middle, *ends[1]], n, bore=bore_of(t.dn, t.style))]
        if self.bolted:
            bolt, far = 0.9 * t.flange.bolt, (rim + max(neck, t.pipe.radius)) / 2
            heads = hexagon(1.5 * bolt, back - 0.7 * bolt, back + 0.2 * thick)
            one = around(heads, t.flange.n_bolts, far, np.pi / t.flange.n_bolts)
            solids += [one, moved(one, spun("x", np.pi))]
        return [along("x", one) for one in solids]


class Bonnet(Params):
    """What stands on a body: a chest, a bonnet with or without a collar, a gland, a stem, maybe a yoke."""

    form: str = among(("collar", "collar", "taper", "dome", "wedge", "plain"), "how it is made")
    rise: float = between(1.0, 1.7, "height of its seat / radius of the body")
    wide: float = between(0.62, 1.0, "radius of the chest / of the body")
    lip: float = between(1.15, 1.6, "radius of its collar / of the chest")
    tall: float = between(0.4, 1.5, "height over the seat / radius of the body")
    stem: float = between(0.12, 0.3, "(radius of the stem - 2 mm) / of the pipe")
    over: float = between(0.4, 2.2, "height of the stem over all that / radius of the pipe")
    yoked: bool = chance(0.25, "a yoke of two bars")

    def pieces(self, t: Table, b: float, n: int) -> tuple[list[Piece], float]:
        """Its pieces on a body of a radius, of so many sides, and how high its stem reaches [m]."""
        r = t.pipe.radius
        seat, chest, plate = self.rise * b, self.wide * b, 0.08 * b + 0.003
        top, lip = seat + self.tall * b + plate, self.lip * chest
        high = max(top + self.over * r, 0.55 * t.flange.outer) + 0.012
        stem, foot = self.stem * r + 0.002, 0.3 * b
        low: list[Solid] = [cylinder(chest, foot, seat, n)]
        hood = outline(0.9 * chest, seat, 0.45 * chest + stem, top)
        if self.form == "collar":
            low.append(cylinder(lip, seat - plate, seat, n))
            hood = outline(lip, seat, lip, seat + plate, 0.75 * chest, seat + plate, 0.4 * chest + stem, top)
        elif self.form == "dome":
            angles = np.linspace(0, 0.45 * np.pi, 4)
            shape = [(float(np.cos(a)) * chest, seat + float(np.sin(a)) * (top - seat)) for a in angles]
            hood = [(lip, seat), (lip, seat + 0.15 * (top - seat)), *shape[1:]]
        elif self.form == "plain":
            hood = outline(0.8 * chest, seat, 0.8 * chest, top)
        bonnet = [turned(hood, n)]
        if self.form == "wedge":  # a flat chest across the line with an oblong cover
            deep, size = 1.5 * b, (1.3 * chest, 2.0 * lip)
            low = [
                box((chest, deep, seat - foot), (0, 0, (seat + foot) / 2)),
                box((*size, plate), (0, 0, seat - plate / 2)),
            ]
            bonnet = [
                box((*size, plate), (0, 0, seat + plate / 2)),
                turned(outline(0.6 * chest, seat, 0.4 * chest, top), n),
            ]
        pieces = [Piece("valve body", low), Piece("valve bonnet", bonnet)]
        if self.yoked:
            bar, spread = max(0.12 * r, 0.003), 0.42 * chest + stem
            bars = [box((2.4 * bar, bar, high - top + plate), (0, s * spread, (high + top - plate) / 2)) for s in BOTH]
            crown = box((3 * bar, 2 * spread + bar, 2 * bar), (0, 0, high - bar))
            pieces.append(Piece("yoke", [*bars, crown]))
        pieces.append(Piece("valve stem", [cylinder(stem, seat, high + 0.4 * r + 0.004, min(n, 10))]))
        return pieces, high + 0.3 * r + 0.002


def screwed_body(
    t: Table, length: float, ends: float, bulge: float, corners: int, n: int, share: float = 0.22
) -> list[Solid]:
    """A body along x about the middle, to be screwed in: two wrench ends, round where they have no corners.

    Args:
        t: with the style.
        length: end to end [m].
        ends: radius of the ends [m].
        bulge: radius of the middle [m].
        corners: of the ends; 0: round.
        n: sides of what is round.
        share: length of an end / length.
    """
    half, bore, end = length / 2, bore_of(t.dn, t.style), share * length
    across = [turned(outline(ends, z, ends, z + end), corners or n, bore=bore) for z in (-half, half - end)]
    low = half - 0.8 * end
    middle = outline(0.85 * ends, -low, bulge, -0.45 * low, bulge, 0.45 * low, 0.85 * ends, low)
    return [along("x", one) for one in (across[0], turned(middle, n, bore=bore), across[1])]
