"""Boilers: fire-tube, water-tube, vertical, on a wall."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import Device, families_of
from cadplants.builder.draws import made
from cadplants.builder.params import Params, among, between, chance, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.vessels.exchangers import equipment_mouth
from cadplants.families.vessels.radiators import wall_behind
from cadplants.families.vessels.vessel_fittings import head, sides
from cadplants.model.family import Model, Port
from cadplants.solids.mesh_ops import Solid, extrude, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, dome, hexagon, ring, rod, rope, turned
from cadplants.solids.transforms import at, spun

__all__ = ["BOILERS"]


class _Boiler(Device, place="floor", group="Equipment", label="boiler", bundle="boiler", sizes=(15,)):
    """A boiler that stands on the floor or hangs over it."""

    def mouths(self, t: Table, r: float, dip: float, *spots: tuple[Floats, int]) -> list[Port]:
        """Flanged mouths on a drum of radius ``r``, each with its frame and nominal size; their ports."""
        ports: list[Port] = []
        for pose, dn in spots:
            ports += equipment_mouth(t, dn, pose, r, dip)
        return ports


class FireTube(_Boiler, name="boiler/fire-tube"):
    """A shell boiler (EN 12953): a clad drum on a base frame, front door with peephole, smoke box, stack, walkway."""

    radius: float = between(0.5, 1.0, "of the drum", "m")
    slender: float = between(2.4, 3.6, "length of the drum / its radius")
    clear: float = between(0.2, 0.35, "from the floor to the drum", "m")
    stack: float = between(0.5, 1.6, "height of the stack over the drum", "m")
    walkway: bool = chance(0.6, "a walkway with a railing along the drum")
    panel: bool = chance(0.6, "a control panel on the drum's side")

    def build(self, t: Table) -> Model:
        r, length, n = self.radius, self.radius * self.slender, sides(t.style, self.radius)
        axis, end = r + self.clear, length / 2
        lying = t.at(0, 0, axis)
        bands = [ring(r - 0.01, 1.008 * r + 0.002, x - 0.03, x + 0.03, n) for x in np.linspace(-0.35, 0.35, 3) * length]
        lying.along("x").add("boiler", cylinder(r, -end, end, n), *bands)
        door = turned(outline(0.92 * r, end, 0.92 * r, end + 0.18, 0.86 * r, end + 0.22), n)
        hinges = [box((0.05, 0.12, 0.1), (-end - 0.1, 0.84 * r, s * 0.4 * r)) for s in BOTH]
        burner = along("-x", cylinder(0.3 * r, end + 0.2, end + 0.27, n), 0, 0, -0.25 * r)
        lying.add("boiler", along("-x", door), *hinges, burner, of="electrical")
        box_end = end + 0.2 * r
        hatch = along("x", ring(0.18 * r, 0.24 * r, box_end - 0.01, box_end + 0.03, 20), 0, 0, -0.4 * r)
        smoke = along("x", turned(outline(0.95 * r, end - 0.01, 0.95 * r, box_end), n))
        lying.add("boiler", smoke, hatch, of="electrical")
        stack = cylinder(0.2 * r, axis, axis + r + self.stack, t.n(0.2 * r))
        t.at(end + 0.02 - 0.1 * r).add("boiler", stack, of="clamp")
        base = [box((length + 0.1, 0.1, 0.16), (0, s * 0.6 * r, 0.08)) for s in BOTH]
        base += [box((0.1, 1.2 * r, 0.12), (s * 0.45 * length, 0, 0.06)) for s in BOTH]
        tall = axis - 0.8 * r
        props = [
            ((0.12, 0.02, tall), (f * length, s * 0.6 * r, tall / 2 + 0.05)) for f in (-0.35, 0, 0.35) for s in BOTH
        ]
        t.add("skid frame", *base, *(box(*prop) for prop in props))
        spots = [(at(f * length, 0, axis + r), dn) for f, dn in ((-0.3, 80), (-0.05, 50), (0.15, 40))]
        ports = self.mouths(t, r, r * (1 - np.cos(np.pi / n)), *spots)
        if self.walkway:
            self._walkway(t.at(0, 0, axis + 0.8 * r), length)
        if self.panel:
            t.add("control panel", box((0.5, 0.2, 0.7), (-0.25 * length, -r - 0.09, axis + 0.1)))
        return t.model(kind="fire-tube boiler", ports=ports)

    def _walkway(self, t: Table, length: float) -> None:
        """A walkway along the drum on arms, with a railing outside."""
        r, y, x = self.radius, 0.75 * self.radius + 0.58, 0.4 * length
        arms = [box((0.05, 0.3 * r + 0.55, 0.06), (s * 0.3 * length, 0.6 * r + 0.25, -0.045)) for s in BOTH]
        t.add("grating", box((2 * x, 0.6, 0.03), (0, 0.75 * r + 0.3, 0)), *arms)
        rails = [rod((-x, y, h), (x, y, h), 0.018, 6) for h in (0.5, 1.0)]
        t.add("railing", *rails, *(rod((p, y, 0), (p, y, 1.0), 0.018, 6) for p in (-x, 0.0, x)))


class Tail(Params):
    """A pipe that comes down from a wall-hung boiler."""

    radius: float = among((0.0075, 0.011), "of the pipe", "m")
    drop: float = between(0.2, 0.6, "how far it comes down", "m")
    cock: bool = chance(0.6, "a cock sits in it")


class WallHung(_Boiler, name="boiler/wall-hung"):
    """A wall-hung boiler: a cabinet with a display, a coaxial flue bent into the wall, pipes with cocks below."""

    width: float = between(0.38, 0.5, "of the cabinet", "m")
    height: float = between(0.65, 0.9, "of the cabinet", "m")
    depth: float = between(0.28, 0.45, "of the cabinet", "m")
    low: float = between(1.1, 1.3, "height of the cabinet's underside", "m")
    corner: float = between(0.005, 0.06, "radius of the cabinet's corners", "m")
    rise: float = between(0.1, 0.3, "of the flue over the cabinet", "m")
    count: int = whole(3, 5, "pipes below")
    tails: tuple[Tail, ...] = several(made(Tail), lambda p: p.count, "the pipes below")

    def build(self, t: Table) -> Model:
        w, d, z, flue_r = self.width, self.depth, self.low, 0.05
        top = z + self.height
        bend = top + self.rise
        t.add("boiler", extrude(rounded_rectangle(w, d, self.corner, 3), z, top), of="dial")
        knobs = [along("-y", cylinder(0.02, d / 2, d / 2 + 0.025, 16), x, 0, z + 0.12) for x in (-0.12, 0.12)]
        t.add("boiler", box((0.8 * w, 0.012, 0.14), (0, -d / 2 - 0.004, z + 0.12)), *knobs, of="electrical")
        flue = rope([(0, 0, top - 0.01), (0, 0, bend), (0, d / 2 + 0.1, bend)], flue_r, t.n(flue_r))
        rose = along("y", cylinder(1.8 * flue_r, d / 2 - 0.012, d / 2, 20), 0, 0, bend)
        t.add("boiler", flue, rose, of="dial")
        t.extend([wall_behind(w + 1.0, bend + 0.4, d / 2)])
        for k, tail in enumerate(self.tails):
            under = t.at((k - (self.count - 1) / 2) * 0.065, 0.25 * d, z)
            under.add("pipe", rod((0, 0, -tail.drop), (0, 0, 0.005), tail.radius, 8))
            if tail.cock:
                under.add("valve", hexagon(0.026, -0.12, -0.07), rod((0, 0, -0.095), (0, -0.05, -0.095), 0.005, 6))
        return t.model(kind="wall-hung boiler")


class Vertical(_Boiler, name="boiler/vertical"):
    """A vertical boiler or bath heater: an upright drum on feet, a fire door and ash door, a hood with the stack."""

    radius: float = between(0.25, 0.6, "of the drum", "m")
    slender: float = between(2.6, 4.0, "height of the drum / its radius")
    domed: bool = chance(0.6, "a domed rather than a conical hood")
    stack: float = between(0.5, 1.3, "height of the stack over the hood", "m")
    ringed: bool = chance(0.5, "a ring under it rather than four feet")

    def build(self, t: Table) -> Model:
        r, h, low, n = self.radius, self.radius * self.slender, 0.12, sides(t.style, self.radius)
        top = low + h
        bands = [ring(r - 0.01, 1.015 * r, z, z + 0.04, n) for z in (low, low + 0.45 * h, top - 0.04)]
        t.add("boiler", cylinder(r, low, top, n), *bands)
        cone = outline(r, top, 0.35 * r, top + 0.45 * r)
        hood = dome(r, 0.35 * r, top - 0.001, n) if self.domed else turned(cone, n)
        stack = cylinder(0.26 * r, top + 0.2 * r, top + 0.35 * r + self.stack, t.n(0.26 * r))
        t.add("boiler", hood, stack)
        doors: list[Solid] = []
        for z, w, tall in ((low + 0.35 * h, 0.7 * r, 0.5 * r), (low + 0.1 * h, 0.6 * r, 0.25 * r)):
            doors.append(box((0.35 * r, 1.1 * w, 1.1 * tall), (0.92 * r, 0, z)))
            doors.append(box((0.03, 1.25 * w, 1.25 * tall), (1.1 * r, 0, z)))
            doors.append(rod((1.1 * r, -0.5 * w, z), (1.1 * r + 0.06, -0.5 * w, z), 0.01, 6))
        t.spun("z", -1.2).add("boiler", *doors, of="electrical")
        feet = around(box((0.06, 0.06, low + 0.02), (0, 0, (low + 0.02) / 2)), 4, 0.9 * r)
        t.add("boiler", ring(0.8 * r, 1.06 * r, 0.0, low + 0.01, n) if self.ringed else feet, of="steel")
        dn = 40 if r > 0.35 else 25
        sides_ = [spun("z", a) @ at(r, 0, low + f * h) @ spun("y", np.pi / 2) for f, a in ((0.85, 1.0), (0.3, 2.6))]
        ports = self.mouths(t, r, r * (1 - np.cos(np.pi / n)), *((pose, dn) for pose in sides_))
        return t.model(kind="vertical boiler", ports=ports)


class WaterTube(_Boiler, name="boiler/water-tube"):
    """A water-tube boiler (D type, EN 12952): a steam drum over a mud drum, banks of tubes, a buckstayed casing."""

    width: float = between(1.6, 2.6, "of the banks of tubes", "m")
    height: float = between(1.4, 2.2, "of the steam drum's axis over the base", "m")
    depth: float = between(1.0, 1.6, "of the furnace", "m")
    count: int = whole(10, 17, "rows of tubes")
    cased: bool = chance(0.6, "a casing with buckstays")

    def build(self, t: Table) -> Model:
        w, h, d, low = self.width, self.height, self.depth, 0.25
        steam, mud, y = 0.2 * h, 0.13 * h, 0.22 * d
        n, zm, zs = sides(t.style, steam), low + mud, low + h
        for r, z, reach in ((steam, zs, w + 0.3), (mud, zm, w + 0.2)):
            body = along("x", cylinder(r, -reach / 2, reach / 2, n), 0, y, z)
            cap = head("2:1", r, t.style, n)
            caps = [moved(cap, at(s * reach / 2, y, z) @ spun("y", s * np.pi / 2)) for s in BOTH]
            t.add("boiler", body, *caps)
        tubes: list[Solid] = []
        wall = [(-d / 2, zs - 0.1 * h), (-d / 2, zm + 0.05 * h)]
        for x in np.linspace(-0.46, 0.46, self.count) * w:
            path = [(x, *point) for point in ((y - 0.8 * steam, zs), *wall, (y - 0.8 * mud, zm))]
            tubes.append(rope(path, 0.025, 6))
            tubes += [rod((x, y + s * 0.5 * mud, zm), (x, y + s * 0.5 * steam, zs), 0.022, 6) for s in (-1, 0, 1)]
        t.add("boiler", *tubes, of="pipe")
        if self.cased:
            case = [box((0.04, d, 0.8 * h), (s * 0.49 * w, 0.0, low + 0.45 * h)) for s in BOTH]
            stays = [box((w + 0.1, 0.08, 0.1), (0, d / 2 + 0.05, low + f * h)) for f in (0.2, 0.6)]
            t.add("boiler", *case, box((w, 0.04, 0.8 * h), (0, d / 2, low + 0.45 * h)), *stays, of="clamp")
        tall, post = low + 0.3 * mud, zs - 0.8 * steam
        t.add("boiler", *(box((0.15, 1.4 * mud, tall), (s * 0.4 * w, y, tall / 2)) for s in BOTH), of="steel")
        for s in BOTH:
            t.add("column", box((0.12, 0.12, post), (s * (0.5 * w + 0.09), y, post / 2)))
        spots = [(at(f * w, y, zs + steam), dn) for f, dn in ((-0.25, 80), (0.0, 50), (0.25, 50))]
        return t.model(kind="water-tube boiler", ports=self.mouths(t, steam, 0.02, *spots))


BOILERS = families_of(FireTube, WallHung, Vertical, WaterTube)
