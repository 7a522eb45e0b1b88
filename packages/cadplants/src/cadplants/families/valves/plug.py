"""Plug valves of further makes, and bib taps."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, nested, styled, weighted
from cadplants.builder.table import Table, outline
from cadplants.families.valves.actuation import operator
from cadplants.families.valves.actuation_base import put_stem
from cadplants.families.valves.actuation_hand import Handlever, Handwheel, levers, slab, wheels
from cadplants.families.valves.body import Packing, ended, lid_joint, neck_of, oval, packings, room
from cadplants.families.valves.valve import MID, Valve, disc_flange
from cadplants.model.family import Model
from cadplants.model.standards import FACE_TO_FACE, sizes_between
from cadplants.solids.mesh_ops import moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import along, box, cylinder, dome, hexagon, lofted, rod, turned
from cadplants.solids.transforms import at

__all__ = ["PLUGS"]


class Lubricated(Valve, name="plug valve/lubricated", sizes=MID):
    """A lubricated plug valve: a tapered chest, bolted gland plate, grease fitting in the square head (API 599)."""

    hollow: bool = styled(True, "whether insides are modelled")
    long: float = between(1.0, 1.3, "length / of ball valves")
    chest: str = among(("round", "square", "oval"), "plan of its chest")
    plate: str = among(("round", "oval", "square", "octagon"), "outline of its gland plate")
    gland: Packing = nested(packings("oval follower", "round follower"), "gland")
    make: str = weighted("what turns it", lever=0.55, operator=0.35, nothing=0.1)
    lever: Handlever = nested(levers("spanner", "bar", "cast"), "lever", when=lambda p: p.make == "lever")
    operator: Any = operator("worm", "worm", "scotch", "rack", when=lambda p: p.make == "operator")
    capped: bool = chance(0.4, "a cap below it")

    def build(self, t: Table) -> Model:
        radius, length = self.radius, FACE_TO_FACE["ball"][self.dn] * self.long
        neck, back = neck_of(self.dn)
        big, run, start = 1.3 * radius + 0.010, 1.05 * radius + 0.006, back + 0.15 * length
        n, low, high, x = t.n(big, 16), -1.35 * radius - 0.008, 1.45 * radius + 0.012, length / 2
        middle = outline(neck, back, run, start, run, length - start, neck, length - back)
        if self.chest == "square":
            chest = slab(rounded_rectangle(1.7 * big, 2.1 * big, 0.35 * big, 3), low, high)
        else:
            a, b = (1.0, 1.0) if self.chest == "round" else (0.8, 1.15)
            steps = outline(0.75, low, 0.8, 0, 1, high) if a == b else outline(0.8, low, 1, 0.3 * low, 1, high)
            chest = lofted([np.column_stack([oval(a * big * s, b * big * s, n), np.full(n, z)]) for s, z in steps])
        plate = 0.010 + 0.07 * radius
        collar, lid, bolts = lid_joint(self.plate, 1.1 * big, 1.3 * big, high, plate, t.style)
        body = ended(self.dn, t.style, length, middle, "flanged")
        t.add("valve body", body, moved(chest, at(x)), moved(collar, at(x)))
        t, half = t.at(x), 0.3 * radius + 0.006
        t.add("valve bonnet", lid)
        t.extend([bolts])
        top, end = t.at(0, 0, high + plate), 4.2 * half
        self.gland.build(top, 0.8 * half)
        head = [cylinder(half, -0.01, 2.2 * half, 12), box((1.7 * half, 1.7 * half, 2.2 * half), (0, 0, 3.2 * half))]
        head += [hexagon(0.02, end, end + 0.012), cylinder(0.005, end, end + 0.03, 8)]
        top.add("valve stem", *head, dome(0.005, 0.005, end + 0.03, 8))
        if self.make == "lever":
            self.lever.build(top, 0.14 + 2.8 * radius, 2.3 * half)
        elif self.make == "operator":
            self.operator.build(top.at(0, 0, 2.2 * half))
        if self.capped:
            cap = hexagon(0.5 * big, low - 0.025, low - 0.012)
            t.add("valve bonnet", cylinder(0.4 * big, low - 0.012, low + 0.004, 14), cap)
        if self.hollow:
            r, port = 0.95 * radius, 1.1 * radius
            side = outline(0.82 * r, -port, r, port, 0.5 * r, port + 0.02, 0.4 * r, port + 0.5 * radius)
            t.add("valve disc", turned(side, n))
        return t.model(round(length, 6), kind="plug valve")


class Eccentric(Valve, name="plug valve/eccentric", sizes=sizes_between(50)):
    """An eccentric plug valve for sewage: bulging half-round body, bolted cover with a bearing hub."""

    hollow: bool = styled(True, "whether insides are modelled")
    make: str = weighted("what turns it", nut=0.3, lever=0.2, operator=0.5)
    lever: Handlever = nested(levers("bar", "cast", "spanner"), "lever", when=lambda p: p.make == "lever")
    operator: Any = operator("worm", "worm", "bevel", "multi-turn", "scotch", when=lambda p: p.make == "operator")
    turn: float = among((0.0, -np.pi / 2), "of its plug", "rad", when=lambda p: p.hollow, otherwise=0.0)

    def build(self, t: Table) -> Model:
        radius, (neck, back) = self.radius, neck_of(self.dn)
        length, big = 0.12 + 2.4 * radius, 1.35 * radius + 0.012
        x, n, aside = length / 2, t.n(big, 16), 0.35 * radius
        wide = min(big, (x - back - 0.008) / 1.12)
        seat, plate, hub = 1.15 * radius + 0.016, 0.012 + 0.06 * radius, 0.22 * radius + 0.014
        collar, lid, bolts = lid_joint("round", wide * 1.12, wide * 1.12, seat + plate, plate, t.style)
        top = seat + 2 * plate
        high = max(top + 0.02, room(self.dn))
        middle = outline(neck, back, 1.1 * radius + 0.005, x, neck, length - back)
        hump = cylinder(wide, -1.1 * radius - 0.01, 1.15 * radius + 0.012, n)
        foot = cylinder(1.2 * hub, -1.1 * radius - 0.03, -1.0 * radius, 14)
        shifted = [moved(one, at(x, aside)) for one in (hump, collar)]
        body = ended(self.dn, t.style, length, middle, "flanged")
        t.add("valve body", body, *shifted, moved(foot, at(x, 0.2 * radius)))
        t = t.at(x)
        cover = turned(outline(1.6 * hub, top - 0.003, hub, high - 0.01, 1.7 * hub, high - 0.008, 1.7 * hub, high), n)
        t.at(0, aside).add("valve bonnet", lid, cover)
        t.at(0, aside).extend([bolts])
        above = t.at(0, 0.2 * radius, high)
        put_stem(above, -0.02, 0.04, 0.5 * hub)
        if self.make == "nut":
            above.add("valve stem", box((0.05, 0.05, 0.05), (0, 0, 0.06)))
        elif self.make == "lever":
            self.lever.build(above, 0.12 + 2.4 * radius, 0.01)
        else:
            self.operator.build(above.at(0, 0, 0.004))
        if self.hollow:
            a, b = np.linspace(0.25, 2.9, 12), np.linspace(2.9, 0.25, 6)
            near = np.column_stack([1.05 * np.cos(a), 1.05 * np.sin(a)])
            plug = np.vstack([near, np.column_stack([0.5 * np.cos(b), 0.6 * np.sin(b)])]) * radius
            t.spun("z", self.turn).add("valve disc", slab(plug, -0.8 * radius, 0.8 * radius))
        return t.model(round(length, 6), kind="plug valve")


class MultiPort(Valve, name="plug valve/multi-port", sizes=MID):
    """A sleeved multi-port plug valve: flanges at three or four sides of a round chest, a square top cover, wrench."""

    four: bool = chance(0.3, "it has four flanges, not three")
    plate: str = among(("square", "round"), "outline of its cover")
    levered: bool = chance(0.6, "a lever, not a gear or an actuator")
    lever: Handlever = nested(levers("spanner", "bar", "sheet", "cast"), "lever", when=lambda p: p.levered)
    operator: Any = operator("worm", "rack", "motor box", "scotch", when=lambda p: not p.levered)

    def build(self, t: Table) -> Model:
        radius, length = self.radius, FACE_TO_FACE["ball"][self.dn] * 1.25
        neck, back = neck_of(self.dn)
        x, big, run = length / 2, 1.35 * radius + 0.012, 1.05 * radius + 0.004
        n, low, high = t.n(big, 16), -1.3 * radius - 0.01, 1.4 * radius + 0.012
        middle = outline(neck, back, run, 0.4 * length, run, 0.6 * length, neck, length - back)
        chest = turned(outline(0.85 * big, low, 0.9 * big, 0.8 * low, big, high), n)
        solids = [ended(self.dn, t.style, length, middle, "flanged"), moved(chest, at(x))]
        side = moved(disc_flange(self.dn, t.style, x - 0.7 * radius), at(0, 0, -x))
        solids += [along(way, side, x) for way in (("-y", "y") if self.four else ("-y",))]
        plate = 0.012 + 0.06 * radius
        collar, lid, bolts = lid_joint(self.plate, 1.2 * big, 1.2 * big, high, plate, t.style)
        t.add("valve body", *solids, moved(collar, at(x)))
        t, top, slim = t.at(x), high + plate, 0.25 * radius + 0.006
        t.add("valve bonnet", lid)
        t.extend([bolts])
        screw, far = hexagon(0.014, top, top + 0.012), 0.6 * big
        t.add("bolt", *(moved(screw, at(far * np.cos(a), far * np.sin(a))) for a in (0.5, 2.6, 4.7)))
        put_stem(t, -0.2 * radius, top + 2.5 * slim, slim)
        stop = box((0.02, 3.2 * slim, 0.006), (1.6 * slim, 0, top + 0.007))
        t.add("position indicator", cylinder(1.9 * slim, top + 0.004, top + 0.01, 16), stop)
        if self.levered:
            self.lever.build(t, 0.12 + 2.2 * radius, top + 0.012)
        else:
            self.operator.build(t.at(0, 0, top + 0.012))
        return t.model(round(length, 6), kind="plug valve")


class BibTap(Valve, name="bib tap/spout", sizes=sizes_between(most=50), place="end"):
    """A bib cock on a pipe's end: a turned body, a downward spout with a hose thread, a lever, cross, tee or wing."""

    drop: float = between(1.6, 3.0, "of its spout / radius of the pipe")
    high: float = between(0.3, 1.4, "height of its head / radius of the pipe")
    levered: bool = chance(0.5, "a lever, not a handwheel")
    lever: Handlever = nested(levers("wing", "sheet", "tee", "loop", "bar"), "lever", when=lambda p: p.levered)
    wheel: Handwheel = nested(
        wheels("cross", "lobed", "star", "spoked", "disc"), "handwheel", when=lambda p: not p.levered
    )

    def build(self, t: Table) -> Model:
        r = self.radius
        reach, big, n = 0.05 + 2.2 * r, 1.2 * r + 0.003, t.n(r, 12)
        tube = outline(r, 0, 0.9 * r, 0.5 * reach, big, 0.55 * reach, big, 0.8 * reach, 0.7 * r, reach)
        drop, out, x = self.drop * r + 0.01, reach + 0.8 * r, 0.67 * reach
        path = [(0.7 * reach, 0, 0), (reach, 0, -0.1 * r), (reach + 0.7 * r, 0, -0.8 * r), (out, 0, -drop)]
        solids = [along("x", hexagon(2.5 * r + 0.004, 0.0, 0.014)), along("x", turned(tube, n))]
        solids += [rod(path[k], path[k + 1], 0.68 * r, n) for k in range(3)]
        lip = outline(0.85 * r, -drop - 0.012, 0.85 * r, -drop + 0.004, 0.68 * r, -drop + 0.008)
        high = big + self.high * r + 0.006
        t.add("valve body", *solids, moved(turned(lip, n), at(out)), along("z", cylinder(0.75 * r, 0.0, high, n), x))
        t, top, shoulder = t.at(x), high + 0.9 * r, high + 0.4 * r
        cap = turned(outline(0.7 * r, shoulder, 0.4 * r, top), n)
        t.add("valve bonnet", hexagon(1.8 * r, high - 0.004, shoulder), cap)
        t = t.at(0, 0, top)
        put_stem(t, -0.004, 0.012, 0.2 * r + 0.001)
        if self.levered:
            self.lever.build(t, 0.04 + 2.0 * r, 0.002)
        else:
            self.wheel.build(t, 0.016 + 0.9 * r, 0.003)
        return t.model(kind="tap")


PLUGS = families_of(Lubricated, Eccentric, MultiPort, BibTap)
