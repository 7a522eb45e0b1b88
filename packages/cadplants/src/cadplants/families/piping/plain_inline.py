"""Strainers and expansion joints of plain solids, in one mesh or in a few."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import of_form
from cadplants.builder.melting import FACETS, FACETS_TEXT, sides_of
from cadplants.builder.params import among, between, chance, nested, whole
from cadplants.builder.table import Table, outline
from cadplants.families.piping.shape import Fitting
from cadplants.families.valves.kit_parts import FlangedBody, screwed_body
from cadplants.model.family import Model
from cadplants.model.standards import sizes_between
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, moved
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, dome, hexagon, ring, turned, waves
from cadplants.solids.transforms import at, spun

__all__ = ["PLAIN_INLINE"]

_STRAINER, _JOINT = "strainer", "expansion joint"


class _Plain(Fitting):
    """A fitting of plain solids that may be one mesh."""

    melted: bool = chance(0.65, "all of it is one mesh")
    facets: int = among(FACETS, FACETS_TEXT)

    def put(self, t: Table, name: str, first: list[Solid], second: list[Solid], second_name: str, of: str) -> None:
        """Puts solids down, melted into one mesh of a name or as two, of which the second may have another name."""
        if self.melted:
            t.add(name, *first, *second, of=of)
            return
        t.add(name, *first, of=of)
        t.add(second_name, *second)


class ScrewedLeg(_Plain, name="strainer/plain screwed", sizes=sizes_between(15, 65), bundle=_STRAINER, weight=1.5):
    """A screwed Y strainer: two wrench ends, a slanting leg, a cap with or without flats."""

    length: float = between(3.2, 6.0, "(length - 20 mm) / radius of the pipe")
    ends: float = between(1.2, 1.5, "radius of the ends / of the pipe")
    corners: int = among((6, 6, 8, 0), "sides of its ends; 0: round")
    bulge: float = between(1.15, 1.6, "radius of the middle / of the pipe")
    slant: float = among((0.65, 0.7, 0.75, 0.75, 0.8), "of the leg from upright / half a turn")
    leg: float = between(0.85, 1.3, "radius of the leg / of the pipe")
    far: float = between(2.2, 4.2, "(length of the leg - 10 mm) / radius of the pipe")
    cap: str = among(("hexagon", "hexagon", "disc", "knurl", "dome"), "form of the cap")
    plug: bool = chance(0.25, "a plug in the cap")

    def build(self, t: Table) -> Model:
        r, length = t.pipe.radius, round(self.length * t.pipe.radius + 0.02, 6)
        n, leg, far = sides_of(t, self.bulge * r, self.facets), self.leg * r, self.far * r + 0.01
        body = screwed_body(t, length, self.ends * r, self.bulge * r, self.corners, n)
        way = spun("y", self.slant * np.pi)
        body.append(moved(cylinder(leg, 0.0, far, n), way))
        end = far + 0.5 * r
        cap: list[Solid] = [hexagon(2.3 * leg, far - 0.2 * r, end)]
        if self.cap == "disc":
            cap = [cylinder(1.25 * leg, far - 0.15 * r, far + 0.2 * r, n)]
            end = far + 0.2 * r
        elif self.cap == "knurl":
            cap = [cylinder(1.2 * leg, far - 0.7 * r, end, min(n, 12))]
        elif self.cap == "dome":
            cap = [cylinder(1.15 * leg, far - 0.3 * r, far, n), dome(1.1 * leg, 0.5 * r, far - 0.01 * r, n)]
        if self.plug:
            cap.append(hexagon(0.8 * leg, end - 0.05 * r, end + 0.35 * r))
        t = t.at(length / 2)
        self.put(t, _STRAINER, body, [moved(one, way) for one in cap], _STRAINER, "valve")
        return t.model(length, "welded")


class PlainBasket(_Plain, name="strainer/plain basket", sizes=sizes_between(25, 300), bundle=_STRAINER, weight=1.5):
    """A basket or tee strainer of plain solids: a pot between flanges, a bolted, hinged or clamped lid, maybe feet."""

    body: FlangedBody = nested(FlangedBody, "body", fixed=lambda p: {"dn": p.dn, "form": "straight"})
    mated: bool = chance(0.7, "the line has flanges against its own")
    pot: float = between(1.35, 2.4, "(radius of the pot - 8 mm) / of the pipe")
    deep: float = between(1.2, 3.4, "depth below the axis / radius of the pot")
    over: float = between(0.9, 1.8, "height over the axis / radius of the pot")
    foot: str = among(("flat", "dome", "cone"), "bottom of the pot")
    lid: float = between(1.12, 1.45, "radius of the lid / of the pot")
    cover: str = among(("bolts", "bare", "dome", "knob", "bar"), "what is on the lid")
    turned_over: bool = chance(0.25, "it hangs with its lid down")
    drain: bool = chance(0.4, "a drain at the bottom")

    def build(self, t: Table) -> Model:
        r, length = t.pipe.radius, self.body.face_to_face(t)
        pot = min(self.pot * r + 0.008, 0.42 * length)
        n, low, high = sides_of(t, t.flange.outer / 2, self.facets), -self.deep * pot, self.over * pot
        shapes = {
            "flat": outline(pot, low, pot, high),
            "dome": outline(0.5 * pot, low, 0.87 * pot, low + 0.16 * pot, pot, low + 0.4 * pot, pot, high),
            "cone": outline(0.35 * pot, low, pot, low + 0.6 * pot, pot, high),
        }
        shell = [turned(shapes[self.foot], n)]
        plate, lid = 0.14 * pot + 0.004, self.lid * pot
        shell.append(cylinder(lid, high - plate, high, n))
        if self.drain:
            shell.append(cylinder(0.14 * pot + 0.003, low - 0.3 * pot, low + 0.2 * pot, min(n, 10)))
        top = high + plate
        cover: list[Solid] = [cylinder(lid, high, top, n)]
        if self.cover == "bolts":
            bolt = 0.08 * lid + 0.002
            cover.append(around(hexagon(2 * bolt, top - 0.001, top + 1.2 * bolt), 8, 0.9 * lid))
        elif self.cover == "dome":
            cover.append(dome(0.85 * lid, 0.45 * lid, top - 0.001, n))
        elif self.cover == "knob":
            cover += [
                cylinder(0.12 * lid, top - 0.001, top + 0.5 * lid, 10),
                cylinder(0.3 * lid, top + 0.4 * lid, top + 0.6 * lid, 12),
            ]
        elif self.cover == "bar":
            cover += [box((2.5 * lid, 0.3 * lid, 0.25 * lid), (0, 0, top + 0.15 * lid))]
        turn = spun("x", np.pi) if self.turned_over else spun("x", 0.0)
        t = t.at(length / 2)
        first = [*self.body.solids(t, n), *(moved(one, turn) for one in shell)]
        self.put(t, _STRAINER, first, [moved(one, turn) for one in cover], _STRAINER, "valve")
        return t.model(length, "flanged" if self.mated else "welded")


class PlainWaves(_Plain, name="expansion joint/plain waves", sizes=sizes_between(20, 400), bundle=_JOINT, weight=2):
    """A rubber or metal joint of plain solids: one bulge, some waves or a sleeve between flanges, collars or unions."""

    ends: str = among(("flanges", "flanges", "flanges", "collars", "unions"), "its ends")
    form: str = among(("bulge", "bulge", "two bulges", "waves", "sleeve", "steps"), "what is between them")
    length: float = between(1.6, 4.0, "(length - 60 mm) / radius of the pipe")
    depth: float = between(0.15, 0.55, "depth of a bulge / radius of the pipe")
    neck: float = between(1.04, 1.3, "radius of its necks / of the pipe")
    count: int = whole(3, 9, "waves", when=of_form("waves", "steps"))
    rim: float = between(0.9, 1.05, "radius of its flanges / of standard ones", when=lambda p: p.ends == "flanges")
    thick: float = between(0.5, 1.2, "thickness of its flanges / of standard ones", when=lambda p: p.ends == "flanges")
    collar: bool = chance(0.4, "beads behind the flanges", when=lambda p: p.ends == "flanges")
    rods: int = among((0, 0, 0, 2, 3, 4), "tie rods", when=lambda p: p.ends == "flanges", otherwise=0)

    def build(self, t: Table) -> Model:
        r, length, bore = t.pipe.radius, round(self.length * t.pipe.radius + 0.06, 6), bore_of(t.dn, t.style)
        half, neck = length / 2, self.neck * r
        n = sides_of(t, t.flange.outer / 2, self.facets)
        if self.ends == "flanges":
            rim, thick = self.rim * t.flange.outer / 2, min(self.thick * t.flange.thickness, 0.25 * half)
        else:
            rim, thick = (1.25 * neck + 0.004, 0.15 * half) if self.ends == "collars" else (1.5 * r + 0.004, 0.3 * half)
        back, bulge = half - thick, neck + self.depth * r + 0.003
        skin = [(neck, -half + 0.3 * thick), *self._middle(neck, bulge, back), (neck, half - 0.3 * thick)]
        sleeve: list[Solid] = [along("x", turned(skin, n, bore=bore))]
        if self.collar:
            bead = min(0.15 * back, 0.1 * r + 0.004)
            sleeve += [
                along("x", ring(0.9 * neck, neck + 0.8 * bead, s * back - bead, s * back + bead, n)) for s in BOTH
            ]
        corners = n if self.ends != "unions" else 8
        faces = [along("x", ring(bore, rim, z, z + thick, corners)) for z in (-half, back)]
        t = t.at(length / 2)
        if self.rods:
            rod_, far = cylinder(0.06 * r + 0.004, -half - 0.1 * r, half + 0.1 * r, 8), rim + 0.1 * r + 0.004
            ear = box((0.28 * r + 0.012, 0.26 * r + 0.012, 0.7 * thick))
            ears = [moved(ear, at(rim + 0.02 * r, 0, z)) for z in (-half + 0.5 * thick, half - 0.5 * thick)]
            faces += [along("x", around(one, self.rods)) for one in ears]
            faces.append(along("x", around(rod_, self.rods, far)))
        name = "flange" if self.ends == "flanges" else "union" if self.ends == "unions" else _JOINT
        if self.melted:
            t.add(_JOINT, *faces, *sleeve, of="rubber")
            return t.model(length, "flanged" if self.ends == "flanges" else "welded")
        t.add(name, faces[0])
        t.add(_JOINT, *sleeve, of="rubber")
        t.add(name, faces[1])
        t.add(_JOINT, *faces[2:], of="steel")
        return t.model(length, "flanged" if self.ends == "flanges" else "welded", split=True)

    def _middle(self, neck: float, bulge: float, back: float) -> list[tuple[float, float]]:
        """The outline between the ends, about the middle [m]."""
        if self.form in ("bulge", "two bulges"):
            a = np.linspace(0, np.pi, 7)
            arc = [(neck + (bulge - neck) * float(np.sin(s)), -0.85 * float(np.cos(s))) for s in a]
            if self.form == "bulge":
                return [(radius, z * back) for radius, z in arc]
            return [(radius, (z * 0.47 + s * 0.47) * back) for s in BOTH for radius, z in (arc if s < 0 else arc[1:])]
        if self.form == "waves":
            return waves(-0.85 * back, 0.85 * back, neck, bulge, self.count)
        if self.form == "steps":
            edges = np.linspace(-0.85, 0.85, 2 * self.count + 1) * back
            radii = [neck if k % 2 else bulge for k in range(2 * self.count)]
            return [
                point
                for k, radius in enumerate(radii)
                for point in ((radius, float(edges[k])), (radius, float(edges[k + 1])))
            ]
        return outline(neck, -0.7 * back, bulge, -0.7 * back, bulge, 0.7 * back, neck, 0.7 * back)


PLAIN_INLINE = families_of(ScrewedLeg, PlainBasket, PlainWaves)
