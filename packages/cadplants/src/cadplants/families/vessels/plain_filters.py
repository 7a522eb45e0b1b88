"""Filters, membrane vessels, hydrocyclones and plate packs as others model them: plain solids, in one mesh or few."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.melting import Melting
from cadplants.builder.params import among, between, chance, whole
from cadplants.builder.table import Table, outline
from cadplants.families.machines.plain_parts import BOLTED, PlainPort, built_ports, port_of
from cadplants.families.valves.valve import flanged_body
from cadplants.families.vessels.exchangers import Equipment, frame_of
from cadplants.model.family import Model, Port
from cadplants.model.standards import FLANGES, PIPES
from cadplants.parts.flange import nut_room, plate_thickness
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import (
    BOTH,
    along,
    around,
    box,
    cylinder,
    dome,
    hexagon,
    ring,
    rod,
    rope,
    torus,
    turned,
)
from cadplants.solids.transforms import at, spun

__all__ = ["PLAIN_FILTERS"]

_FILTER, _SEPARATOR, _HEX = "filter", "separator", "heat exchanger"
_SIZES = (15, 20, 25, 32, 40, 50, 65, 80, 100, 150)

Pieces = Sequence[tuple[str, Sequence[Solid]]]


class _Plain(Melting, Equipment):
    """A piece of equipment of plain solids, in one mesh or in pieces."""

    melted: bool = chance(0.6, "all of it is one mesh")

    def put(self, t: Table, pieces: Pieces) -> None:
        """Puts pieces down by their names, or all in one mesh of the device's label."""
        if self.melted:
            t.add(self.label, *(one for _, solids in pieces for one in solids))
            return
        for name, solids in pieces:
            t.add(name, *solids, own=True)


class _Mouth(PlainPort):
    """A mouth of a vessel of plain shapes."""

    form: str = among((*BOLTED, "stub", "thread", "clamp"), "what is at its end")


def _fitting(most: float) -> tuple[int, ...]:
    """Nominal sizes whose flanges are no wider than this [m]; the smallest always."""
    return tuple(dn for dn in _SIZES if FLANGES[dn].outer < most) or (15,)


# --- in a line ---


class HeadAndBowl(
    _Plain,
    name="filter/plain head and bowl",
    place="inline",
    label=_FILTER,
    bundle=_FILTER,
    sizes=(15, 20, 25, 32, 40, 50, 65, 80, 100),
    weight=1.5,
):
    """A compressed-air, hydraulic or water filter in a line: a head with two ends, a bowl, maybe several in a row."""

    flanged: bool = chance(0.5, "its ends are flanged", when=lambda p: p.dn >= 25)
    form: str = among(("block", "block", "rounded", "drum", "drum", "rimmed", "octagon", "ball"), "its head")
    flush: bool = chance(0.5, "its head reaches to its ends", when=lambda p: p.form == "block" and not p.flanged)
    wide: float = between(1.4, 2.8, "half the width of the head / radius of the pipe")
    room: float = between(0.008, 0.03, "added to that", "m")
    tall: float = between(0.5, 1.2, "height of the head / width")
    sunk: float = between(0.0, 0.35, "how far the axis is above the middle of the head / its spare height")
    reach: float = between(0.15, 1.2, "how far an end stands out of the head / radius of the pipe")
    boss: str = among(("round", "round", "hexagon", "square"), "its ends", when=lambda p: not p.flanged, otherwise="")
    row: int = among((1, 1, 1, 1, 2, 3), "heads in a row", when=lambda p: p.dn <= 40, otherwise=1)
    bowl: str = among(("straight", "dome", "dome", "taper", "step", "bulge", "block"), "its bowl")
    slim: float = between(0.6, 1.0, "radius of the bowl / half the width of the head")
    deep: float = among((1.2, 2.0, 2.8, 3.6, 5.0, 7.0, 10.0), "depth of the bowl / its radius")
    later: float = between(0.4, 0.9, "depth of a further bowl / of the first", when=lambda p: p.row > 1)
    ribs: int = among((0, 0, 0, 6, 8, 12), "ribs of the bowl")
    collar: str = among(("none", "none", "ring", "hexagon", "lugs"), "what holds the bowl")
    foot: str = among(("none", "hexagon", "hexagon", "drain", "tap", "knob"), "what is below the bowl")
    over: str = among(("none", "none", "dial", "dial upright", "knob", "hexagon", "cap", "lugs", "stud"), "on its head")
    dialled: bool = chance(0.25, "a dial before its head")
    upturned: bool = chance(0.07, "its bowl is above")

    def build(self, t: Table) -> Model:
        p, w = t.pipe.radius, self.wide * t.pipe.radius + self.room
        high = max(self.tall * 2 * w, 2.7 * p)
        spare = self.sunk * (high / 2 - 1.25 * p)
        low, top = spare - high / 2, spare + high / 2
        low, top = (-top, -low) if self.sunk > 0.2 else (low, top)
        end = self.reach * p + 0.004
        if self.flanged:
            end = plate_thickness(self.dn) + nut_room(self.dn) + 0.01
        if self.collar != "none":
            end = max(end, (1.3 * self.slim - 1) * w)
        pitch = 2.06 * w
        length = round(2 * end + (self.row - 1) * pitch + 2 * w, 6)
        spots = [end + w + k * pitch for k in range(self.row)]
        n = self.n(t, w)
        first = [self._run(t, length, low, top, w, n)]
        if not self.flush:
            first += [moved(one, at(x)) for x in spots for one in self._head(w, low, top, n)]
        links = [box((0.1 * w, 1.5 * w, 0.8 * high), (x + pitch / 2, 0, spare)) for x in spots[:-1]]
        turn = spun("x", np.pi if self.upturned else 0.0)
        start = -top if self.upturned else low
        bowls = [
            moved(one, at(x) @ turn)
            for k, x in enumerate(spots)
            for one in self._bowl(self.slim * w, start, self.deep * (self.later if k else 1.0), n)
        ]
        more = [] if self.upturned else [moved(one, at(spots[-1])) for one in self._over(w, top, n)]
        dial = along("-y", cylinder(0.5 * min(w, high / 2) + 0.008, 0.5 * w, 1.25 * w + 0.01, n), spots[0], 0, spare)
        isdial = self.over.startswith("dial")
        pieces = [
            (_FILTER, [*first, *links, *([] if isdial else more)]),
            (_FILTER, bowls),
            ("gauge", [*(more if isdial else []), *([dial] if self.dialled else [])]),
        ]
        self.put(t, pieces)
        return t.model(length, "flanged" if self.flanged else "welded", "cartridge filter")

    def _run(self, t: Table, length: float, low: float, top: float, w: float, n: int) -> Solid:
        """What has the end faces."""
        p, bore = t.pipe.radius, bore_of(self.dn, t.style)
        hole = (circle(bore, n),) if bore else ()
        if self.flanged:
            neck = 0.485 * t.flange.hub
            return flanged_body(self.dn, t.style, length, [(neck, 0.3 * length), (neck, 0.7 * length)])
        if self.flush:
            sheet = rounded_rectangle(top - low, 2 * w, 0.0) - np.array([(top + low) / 2, 0.0])
            return along("x", extrude(sheet, 0.0, length, hole))
        if self.boss == "hexagon":
            return along("x", hexagon(2.7 * p, 0.0, length, bore, n))
        if self.boss == "square":
            return along("x", extrude(rounded_rectangle(2.5 * p, 2.5 * p, 0.0), 0.0, length, hole))
        return along("x", ring(bore, 1.25 * p, 0.0, length, n))

    def _head(self, w: float, low: float, top: float, n: int) -> list[Solid]:
        high, mid = top - low, (top + low) / 2
        if self.form == "block":
            return [box((2 * w, 2 * w, high), (0, 0, mid))]
        if self.form == "rounded":
            return [extrude(rounded_rectangle(2 * w, 2 * w, 0.4 * w, 3), low, top)]
        if self.form == "octagon":
            return [turned(outline(w, low, w, top), 8, np.pi / 8)]
        if self.form == "rimmed":
            return [cylinder(0.85 * w, low, top, n), cylinder(w, low, low + 0.2 * high, n)]
        if self.form == "ball":
            return [turned(outline(w, low, w, mid, 0.85 * w, mid + 0.3 * high, 0.4 * w, top), n)]
        return [cylinder(w, low, top, n)]

    def _bowl(self, r: float, start: float, deep: float, n: int) -> list[Solid]:
        d, up = deep * r, start + 0.02 * r
        end = start - d
        shapes = {
            "straight": outline(r, end, r, up),
            "dome": outline(0.3 * r, end, 0.7 * r, end + 0.12 * r, 0.93 * r, end + 0.4 * r, r, end + 0.75 * r, r, up),
            "taper": outline(0.72 * r, end, 0.8 * r, end + 0.08 * d, r, up),
            "step": outline(0.82 * r, end, 0.82 * r, start - 0.35 * d, r, start - 0.35 * d, r, up),
            "bulge": outline(0.5 * r, end, r, start - 0.7 * d, r, start - 0.3 * d, 0.8 * r, up),
            "block": [],
        }
        if self.bowl == "block":
            found = [extrude(rounded_rectangle(1.8 * r, 1.8 * r, 0.3 * r, 2), end, up)]
        else:
            found = [turned(shapes[self.bowl], n)]
        if self.ribs:
            found.append(around(box((0.16 * r, 0.08 * r, 0.6 * d), (0.96 * r, 0, start - 0.4 * d)), self.ribs))
        ends = (start - 0.35 * r, start + 0.01 * r)
        if self.collar == "ring":
            found.append(cylinder(1.15 * r, *ends, n))
        elif self.collar == "hexagon":
            found.append(hexagon(2.2 * r, *ends))
        elif self.collar == "lugs":
            lugs = around(box((0.25 * r, 0.3 * r, 0.35 * r), (1.05 * r, 0, start - 0.17 * r)), 4)
            found += [cylinder(1.08 * r, *ends, n), lugs]
        return [*found, *self._foot(r, end, n)]

    def _foot(self, r: float, end: float, n: int) -> list[Solid]:
        s, up = 0.25 * r + 0.003, end + 0.06 * r
        if self.foot == "hexagon":
            return [hexagon(2.2 * s, end - 0.9 * s, up)]
        if self.foot == "drain":
            return [cylinder(0.9 * s, end - 1.2 * s, up, n), cylinder(0.5 * s, end - 2.6 * s, end - s, min(n, 8))]
        if self.foot == "knob":
            return [turned(outline(0.6 * s, end - 1.6 * s, 1.3 * s, end - 1.3 * s, 1.3 * s, end - 0.6 * s, s, up), n)]
        if self.foot == "tap":
            arm = rod((0, 0, end - 1.5 * s), (0, -1.4 * r, end - 1.5 * s), 0.6 * s, 8)
            handle = box((0.5 * s, 1.6 * s, 0.5 * s), (0, -r, end - 0.8 * s))
            return [cylinder(0.6 * s, end - 2 * s, up, 8), arm, handle]
        return []

    def _over(self, w: float, top: float, n: int) -> list[Solid]:
        low = top - 0.05 * w
        if self.over == "dial":
            return [cylinder(0.25 * w, low, top + 0.2 * w, n), cylinder(0.7 * w, top + 0.18 * w, top + 0.6 * w, n)]
        if self.over == "dial upright":
            case = along("-y", cylinder(0.75 * w, -0.2 * w, 0.25 * w, n), 0, 0, top + 1.0 * w)
            return [cylinder(0.15 * w, low, top + 0.5 * w, min(n, 8)), case]
        if self.over == "knob":
            return [turned(outline(0.5 * w, low, 0.5 * w, top + 0.3 * w, 0.7 * w, top + 0.3 * w, 0.62 * w, top + w), n)]
        if self.over == "hexagon":
            return [hexagon(0.8 * w, low, top + 0.3 * w)]
        if self.over == "cap":
            return [cylinder(0.7 * w, low, top + 0.9 * w, n), dome(0.7 * w, 0.4 * w, top + 0.89 * w, n)]
        if self.over == "lugs":
            return [along("x", cylinder(0.15 * w, -0.3 * w, 0.3 * w, n), 0, s * 0.6 * w, top + 0.08 * w) for s in BOTH]
        if self.over == "stud":
            return [cylinder(0.14 * w, low, top + 0.5 * w, min(n, 8)), hexagon(0.45 * w, low, top + 0.15 * w)]
        return []


# --- on the floor ---


class PlainHousing(_Plain, name="filter/plain housing", label=_FILTER, bundle=_FILTER, weight=1.5):
    """A cartridge or bag filter: an upright vessel with a lid, on legs, a skirt or a foot; slim hygienic ones too."""

    kind_of: str = among(("bag", "bag", "cartridge", "slim", "wide"), "its build")
    radius: float = between(
        lambda p: {"bag": 0.08, "cartridge": 0.09, "slim": 0.03, "wide": 0.2}[p.kind_of],
        lambda p: {"bag": 0.2, "cartridge": 0.25, "slim": 0.08, "wide": 0.55}[p.kind_of],
        "of the vessel",
        "m",
    )
    slender: float = between(
        lambda p: {"bag": 2.5, "cartridge": 3.0, "slim": 5.0, "wide": 1.4}[p.kind_of],
        lambda p: {"bag": 6.5, "cartridge": 9.0, "slim": 16.0, "wide": 4.0}[p.kind_of],
        "height of its shell / radius",
    )
    size: int = among(lambda p: _fitting(1.7 * p.radius), "nominal size of its mouths", "mm")
    clear: float = between(0.06, 0.55, "from the floor to its bottom, but for its outlet", "m")
    stand: str = among(("boxes", "rods", "rods", "spread", "angles", "skirt", "pedestal", "frame", "back"), "stands on")
    legs: int = among(
        (3, 3, 3, 4), "legs", when=lambda p: p.stand in ("boxes", "rods", "spread", "angles"), otherwise=3
    )
    shod: bool = chance(0.6, "feet below its legs")
    bottom: str = among(("dish", "dish", "flat", "cone", "round", "plate"), "its bottom")
    lid: str = among(("flat", "flat", "dish", "dish", "dome", "step", "cone"), "its lid")
    rim: float = between(1.12, 1.4, "radius of its rims / of the vessel")
    thick: float = between(0.05, 0.2, "thickness of a rim / radius")
    split: float = among((1.0, 1.0, 1.0, 0.0, 0.25), "where its rims are / height of the shell")
    closing: str = among(("swing", "swing", "bolts", "band", "clamp", "none", "knobs"), "what closes it")
    bolts: int = among(
        (3, 4, 6, 8, 12), "of them", when=lambda p: p.closing in ("swing", "bolts", "knobs"), otherwise=3
    )
    lifted: str = among(("none", "none", "davit", "hinge", "handle", "wheel"), "what its lid is lifted with")
    vented: str = among(("none", "none", "stub", "tap", "dial"), "on its lid")
    outlet: str = among(("below", "low", "low", "same side", "turned", "bend"), "where its outlet is")
    high: float = between(0.55, 0.88, "height of its inlet / of the shell")
    rise: float = between(0.35, 0.9, "length of its mouths / radius")
    drained: bool = chance(0.3, "a drain below", when=lambda p: p.outlet not in ("below", "bend"))
    turn: float = among((0.0, np.pi / 6, np.pi / 3), "of its legs", "rad")
    entry: PlainPort = port_of(lambda p: p.size, "inlet", kind=_Mouth)
    exit: PlainPort = port_of(lambda p: p.size, "outlet", kind=_Mouth)

    def build(self, t: Table) -> Model:
        r, n, p = self.radius, self.n(t, self.radius), PIPES[self.size].radius
        tall = min(self.slender * r, 2.4)
        deep = {"dish": 0.45, "flat": 0.0, "cone": 0.9, "round": 0.9, "plate": 0.0}[self.bottom] * r
        reach = self.rise * r + plate_thickness(self.size) + 0.03
        below = self.outlet in ("below", "bend")
        low = self.clear + deep + (reach + (2.6 * p if self.outlet == "bend" else 0.0) if below else 0.0)
        top = low + tall
        body, lid = self._vessel(r, low, top, deep, n)
        level = low + self.high * tall
        if self.split < 1:
            level = low + max(0.12, self.split + 0.15) * tall
        k = self.n(t, p)
        far = r + reach
        mouths, ports = built_ports(t, (self.entry,), [(-far, 0, level)], (-1, 0, 0), reach + 0.4 * r, k)
        other, more, out = self._outlet(t, r, low, tall, deep, reach, level, k)
        body += [*mouths, *other, *out]
        if self.drained:
            body.append(cylinder(0.012 + 0.04 * r, low - deep - 0.05, low - deep + 0.05, 8))
        stand = self._stand(r, low, tall, n)
        pieces = [(_FILTER, body), (_FILTER, lid), ("skirt" if self.stand == "skirt" else "tank leg", stand)]
        closing = self._closing(r, low + self.split * tall, n)
        if self.closing in ("swing", "bolts"):
            pieces.append(("bolt", closing))
        else:
            pieces.append(("clamp", closing))
        self.put(t, pieces)
        return t.model(kind="bag filter" if self.kind_of == "bag" else "cartridge filter", ports=[*ports, *more])

    def _vessel(self, r: float, low: float, top: float, deep: float, n: int) -> tuple[list[Solid], list[Solid]]:
        """Vessel and lid."""
        ends = {
            "dish": outline(0.4 * r, low - deep, 0.8 * r, low - 0.65 * deep),
            "cone": outline(0.25 * r, low - deep),
            "round": outline(0.25 * r, low - deep, 0.7 * r, low - 0.72 * deep, 0.95 * r, low - 0.3 * deep),
            "plate": outline(1.12 * r, low, 1.12 * r, low + 0.1 * r, r, low + 0.1 * r),
        }
        foot = ends.get(self.bottom, [])
        start = [] if self.bottom == "plate" else outline(r, low)
        thick, wide = self.thick * r + 0.004, self.rim * r
        seam = low + self.split * (top - low)
        body = [turned([*foot, *start, *outline(r, seam)], n)] if self.split > 0 else []
        if self.split == 0:
            body = [turned([*foot, *start, *outline(r, low + 0.3 * r)], n)]
            seam = low + 0.3 * r
        body.append(cylinder(wide, seam - thick, seam, n))
        lid = [cylinder(wide, seam, seam + thick, n)]
        if self.split < 1:
            lid.append(cylinder(r, seam + 0.5 * thick, top, n))
        end = top + (thick if self.split == 1 else 0.0)
        under = end - 0.3 * thick
        crowns = {
            "dish": outline(r, under, 0.85 * r, end + 0.18 * r, 0.45 * r, end + 0.32 * r),
            "dome": outline(r, under, 0.9 * r, end + 0.4 * r, 0.6 * r, end + 0.75 * r, 0.2 * r, end + 0.92 * r),
            "step": outline(0.7 * r, under, 0.7 * r, end + 0.15 * r),
            "cone": outline(r, under, 0.3 * r, end + 0.5 * r),
            "flat": outline(r, under, r, end + 0.02 * r),
        }
        lid.append(turned(crowns[self.lid], n))
        return body, [*lid, *self._over(r, crowns[self.lid][-1][1], end, seam, n)]

    def _over(self, r: float, crown: float, end: float, seam: float, n: int) -> list[Solid]:
        """What is on the lid."""
        found: list[Solid] = []
        wide = self.rim * r
        s = 0.05 * r + 0.006
        if self.vented == "stub":
            found.append(cylinder(1.4 * s, crown - 0.3 * r, crown + 0.04, 8))
        elif self.vented == "tap":
            found += [cylinder(s, crown - 0.3 * r, crown + 0.08, 8), box((0.08, 0.012, 0.014), (0.02, 0, crown + 0.07))]
        elif self.vented == "dial":
            face = along("-y", cylinder(0.04, -0.012, 0.016, n), 0, 0, crown + 0.12)
            found += [cylinder(s, crown - 0.3 * r, crown + 0.1, 8), face]
        if self.lifted == "handle":
            x, z = 0.35 * r, crown + 0.25 * r + 0.02
            found.append(rope([(-x, 0, end - 0.02 * r), (-x, 0, z), (x, 0, z), (x, 0, end - 0.02 * r)], s, 6))
        elif self.lifted == "wheel":
            found += [torus(0.45 * r, 1.2 * s, n, 6), box((0.9 * r, s, s)), box((s, 0.9 * r, s))]
            found[-3:] = [moved(one, at(0, 0, crown + 0.3 * r)) for one in found[-3:]]
            found.append(cylinder(s, crown - 0.3 * r, crown + 0.32 * r, 8))
        elif self.lifted == "hinge":
            found.append(box((0.3 * r, 0.7 * r, 0.3 * r), (0, wide - 0.05 * r, seam)))
        elif self.lifted == "davit":
            y, z = wide + 2 * s, crown + 0.5 * r + 0.05
            found.append(rope([(0, y, end - 0.5 * r), (0, y, z), (0, 0, z), (0, 0, crown - 0.05 * r)], 1.2 * s, 8))
            found.append(
                box((3 * s, wide - 0.9 * r + 3 * s, 0.2 * r), (0, (wide + 0.9 * r + 3 * s) / 2, end - 0.4 * r))
            )
        return found

    def _outlet(
        self, t: Table, r: float, low: float, tall: float, deep: float, reach: float, level: float, k: int
    ) -> tuple[list[Solid], list[Port], list[Solid]]:
        """Its solids, ports and further solids."""
        p, inside, far = PIPES[self.size].radius, 0.4 * r, r + reach
        if self.outlet == "below":
            end = low - deep - reach
            return *built_ports(t, (self.exit,), [(0, 0, end)], (0, 0, -1), reach + 0.3 * r, k), []
        if self.outlet == "bend":
            z = low - deep - reach - 0.6 * p
            bend = rope([(0, 0, low - deep + 0.2 * r), (0, 0, z), (0.8 * r, 0, z)], p, max(k, 6))
            return *built_ports(t, (self.exit,), [(far, 0, z)], (1, 0, 0), far - 0.7 * r, k), [bend]
        z = low + min(0.12 * tall + p, 0.3 * tall)
        if self.outlet == "same side" and level - z < 1.15 * FLANGES[self.size].outer:
            return *built_ports(t, (self.exit,), [(far, 0, z)], (1, 0, 0), reach + inside, k), []
        way = {"same side": (-1, 0, 0), "turned": (0, -1, 0)}.get(self.outlet, (1, 0, 0))
        spot = (way[0] * far, way[1] * far, z)
        return *built_ports(t, (self.exit,), [spot], way, reach + inside, k), []

    def _closing(self, r: float, seam: float, n: int) -> list[Solid]:
        seam = seam + 0.3 * r if self.split == 0 else seam
        thick, wide, s = self.thick * r + 0.004, self.rim * r, 0.05 * r + 0.005
        if self.closing in ("bolts", "knobs"):
            head = hexagon(3.2 * s, seam + thick - 0.001, seam + thick + 1.4 * s)
            if self.closing == "knobs":
                head = cylinder(2.2 * s, seam + thick - 0.001, seam + thick + 4 * s, min(n, 12))
            one = merge([cylinder(0.9 * s, seam - thick - 1.5 * s, seam + thick + 0.5 * s, 6), head])
            return [around(one, self.bolts, 0.5 * (wide + r))]
        if self.closing == "swing":
            eye = moved(torus(1.8 * s, 0.6 * s, 8, 6), at(0, 0, seam + thick + 4 * s) @ spun("x", np.pi / 2))
            lug = box((3 * s + 0.2 * wide, 3 * s, thick), (-0.5 * s - 0.1 * wide, 0, seam - 0.6 * thick))
            one = merge([cylinder(0.9 * s, seam - 2 * thick - s, seam + thick + 3 * s, 6), eye, lug])
            return [around(one, self.bolts, wide + 0.3 * s)]
        if self.closing in ("band", "clamp"):
            half = 1.15 * thick if self.closing == "band" else 1.6 * thick
            band = ring(0.98 * r, wide + 0.06 * r, seam - half, seam + half, n)
            lock = box((0.25 * r + 0.01, 0.6 * r + 0.01, 1.6 * half), (0, -wide + 0.03 * r, seam))
            return [band, lock, rod((0, -wide - 0.1 * r, seam), (0.5 * r, -wide - 0.1 * r, seam), s, 6)]
        return []

    def _stand(self, r: float, low: float, tall: float, n: int) -> list[Solid]:
        up, s = low + 0.2 * min(tall, 2 * r), 0.06 * r + 0.01
        if self.stand == "skirt":
            return [ring(0.9 * r, 1.02 * r, 0, low + 0.05 * r, n), ring(0.9 * r, 1.15 * r, 0, 0.01 + 0.03 * r, n)]
        if self.stand == "pedestal":
            return [cylinder(0.25 * r + 0.01, 0, low + 0.02 * r, n), cylinder(0.9 * r, 0, 0.02 + 0.05 * r, n)]
        if self.stand == "frame":
            w = 2.3 * r
            bars = [box((w, 2 * s, 2 * s), (0, y * 1.05 * r, low + 0.1 * r)) for y in BOTH]
            return [frame_of(w + 2 * s, w + 2 * s, up, 2 * s), *bars]
        if self.stand == "back":
            z, y = low + 0.7 * tall, 1.5 * r
            arms = [box((3 * s, 0.8 * r, 2 * s), (0, 1.2 * r, low + f * tall)) for f in (0.2, 0.6)]
            return [box((3 * s, 2 * s, z), (0, y, z / 2)), box((2 * r, 1.8 * r, 0.015), (0, 1.1 * r, 0.0075)), *arms]
        x = r + 0.3 * s
        foot = x + (0.4 * low + 0.1 * r if self.stand == "spread" else 0.0)
        tilt = np.arctan2(foot - 0.95 * r, up)
        leg = {
            "boxes": box((2 * s, 2 * s, up), (x, 0, up / 2)),
            "rods": rod((x, 0, 0), (x, 0, up), s, 8),
            "angles": merge([box((0.4 * s, 3 * s, up), (x, 0, up / 2)), box((2 * s, 0.4 * s, up), (x + s, 0, up / 2))]),
            "spread": rod((foot, 0, s * float(np.sin(tilt))), (0.95 * r, 0, up), s, 8),
        }[self.stand]
        leg = merge([leg, box((0.3 * r, 1.5 * s, 2 * s), (x - 0.13 * r, 0, up - 1.1 * s))])
        if self.shod:
            leg = merge([leg, moved(cylinder(2.2 * s, 0, 0.4 * s, min(n, 12)), at(foot))])
        return [around(leg, self.legs, 0.0, self.turn + np.pi / 12)]


class MembraneVessels(_Plain, name="filter/membrane vessels", label=_FILTER, bundle=_FILTER, weight=1.5):
    """Pressure tubes with membranes: one or a stack, lying or upright, with end caps, in a rack or on saddles."""

    radius: float = among((0.035, 0.055, 0.055, 0.08, 0.11, 0.11, 0.13, 0.16), "of a tube", "m")
    elements: float = between(0.9, 6.2, "length of a tube", "m")
    upright: bool = chance(0.3, "its tubes stand")
    columns: int = among((1, 1, 2, 2, 3, 4), "tubes side by side")
    tiers: int = among(
        lambda p: (1, 2, 2) if p.columns > 2 or p.upright else (1, 1, 2, 3, 4, 5), "tubes one over the other"
    )
    pitch: float = between(2.5, 3.6, "from tube to tube / radius")
    cap: str = among(("disc", "disc", "dish", "coupling", "step", "plug", "flange"), "its ends")
    wide: float = between(1.08, 1.35, "radius of an end / of a tube")
    thick: float = between(0.2, 1.0, "length of an end / radius")
    permeate: float = among((0.0, 0.2, 0.25, 0.35), "radius of the ports in its ends / of a tube")
    bent: bool = chance(0.4, "elbows on them", when=lambda p: p.permeate > 0)
    feeds: str = among(("none", "side", "side", "top"), "ports in its shells")
    headers: bool = chance(0.5, "pipes that join those", when=lambda p: p.feeds == "side")
    bands: int = among((0, 0, 2, 3), "bands round a tube")
    held: str = among(("rack", "rack", "ends", "saddles", "posts", "blocks", "plate"), "what holds it")
    low: float = between(0.15, 0.9, "from the floor to its tubes", "m")
    beam: float = between(0.03, 0.09, "width of the rack's beams", "m")

    def build(self, t: Table) -> Model:
        r, n = self.radius, self.n(t, self.radius)
        long = min(self.elements, 2.2 if self.upright else 60 * r)
        step, half = self.pitch * r, long / 2
        tube = self._tube(r, half, n)
        ys = (np.arange(self.columns) - (self.columns - 1) / 2) * step
        zs = np.arange(self.tiers) * step
        k, s = max(6, self.n(t, 0.3 * r)), 0.3 * r
        far = 2.1 * r
        pipes: list[Solid] = []
        tubes = [moved(one, at(0, y, z)) for y in ys for z in zs for one in tube]
        if self.headers:
            for f in BOTH:
                y = ys[-1] + far
                x = f * (half - 1.5 * r)
                pipes.append(rod((x, y, -0.9 * r), (x, y, zs[-1] + 1.6 * r), 1.2 * s, k))
                pipes += [rod((x, ys[0], z), (x, y, z), s, k) for z in zs]
                pipes.append(rod((x, y, 0), (x, y + 2 * r, 0), 1.1 * s, k))
        if self.upright:
            self._standing(t, tubes, pipes, half, ys, zs)
            return t.model(kind="membrane filter")
        low = self.low + 1.4 * r
        lift = at(0, 0, low)
        frame = self._frame(r, half, ys, zs, low)
        name = {"saddles": "saddle", "blocks": "saddle"}.get(self.held, "skid frame")
        self.put(
            t,
            [
                (_FILTER, [moved(one, lift) for one in tubes]),
                ("pipe", [moved(one, lift) for one in pipes]),
                (name, frame),
            ],
        )
        return t.model(kind="membrane filter")

    def _standing(
        self, t: Table, tubes: list[Solid], pipes: list[Solid], half: float, ys: np.ndarray, zs: np.ndarray
    ) -> None:
        """Its tubes upright: what was along x is along z, what was along z is along -x."""
        r, end = self.radius, self.thick * self.radius
        low = self.low + half + end + 2.4 * r
        lift = at(float(zs[-1]) / 2, 0, low) @ spun("y", -np.pi / 2)
        wide, deep = float(zs[-1]) + 2.4 * r + 2 * self.beam, float(ys[-1] - ys[0]) + 2.4 * r + 2 * self.beam
        frame = [frame_of(wide, deep, low + 0.6 * half, self.beam)]
        spots = [(x, y) for x in (zs - zs[-1] / 2) for y in ys]
        for z in (low - 0.6 * half, low + 0.45 * half):
            frame += [box((wide, 0.6 * self.beam, self.beam), (0, y, z)) for y in ys]
            frame += [box((self.beam, deep, self.beam), (s * (wide - self.beam) / 2, 0, z)) for s in BOTH]
        feet = [box((0.8 * r, 0.8 * r, low - half), (x, y, (low - half) / 2)) for x, y in spots]
        feet.append(box((wide, deep, 0.02), (0, 0, 0.01)))
        held = feet if self.held in ("blocks", "saddles") else frame
        self.put(
            t,
            [
                (_FILTER, [moved(one, lift) for one in tubes]),
                ("pipe", [moved(one, lift) for one in pipes]),
                ("skid frame", held),
            ],
        )

    def _tube(self, r: float, half: float, n: int) -> list[Solid]:
        """A tube along x about the origin."""
        wide, end = self.wide * r, self.thick * r
        caps = {
            "disc": outline(wide, 0, wide, end),
            "dish": outline(r, 0, 0.9 * r, 0.3 * end, 0.5 * r, 0.7 * end, 0.3 * r, 0.8 * end),
            "coupling": outline(wide, -1.2 * end, wide, 0.3 * end, 0.8 * r, 0.3 * end, 0.8 * r, end),
            "step": outline(wide, -0.3 * end, wide, 0.4 * end, 0.7 * r, 0.4 * end, 0.7 * r, end),
            "plug": outline(0.85 * r, -0.1 * r, 0.85 * r, 0.35 * end),
            "flange": outline(1.1 * wide, -0.3 * end, 1.1 * wide, 0.1 * end, 1.1 * wide, 0.4 * end),
        }
        cap = [turned(caps[self.cap], n)]
        out = caps[self.cap][-1][1]
        if self.permeate:
            s = self.permeate * r
            path = [(0, 0, out - 0.05 * r), (0, 0, out + 0.9 * r)]
            cap.append(rope([*path, (-1.1 * r, 0, out + 0.9 * r)] if self.bent else path, s, min(n, 10)))
        found = [along("x", cylinder(r, -half, half, n))]
        for s in BOTH:
            found += [
                moved(one, at(s * half) @ spun("z", 0.0 if s > 0 else np.pi) @ spun("y", np.pi / 2)) for one in cap
            ]
            if self.feeds != "none":
                port = [
                    cylinder(0.3 * r, 0.8 * r, 1.35 * r, min(n, 10)),
                    cylinder(0.42 * r, 1.2 * r, 1.35 * r, min(n, 12)),
                ]
                axis = "y" if self.feeds == "side" else "z"
                found += [along(axis, one, s * (half - 1.5 * r)) for one in port]
        spots = np.linspace(-0.8 * half, 0.8 * half, self.bands)
        found += [along("x", cylinder(1.07 * r, x - 0.12 * r, x + 0.12 * r, n)) for x in spots]
        return found

    def _frame(self, r: float, half: float, ys: np.ndarray, zs: np.ndarray, low: float) -> list[Solid]:
        """What holds tubes that lie."""
        b, wide, top = self.beam, float(ys[-1] - ys[0]) + 2 * r, low + float(zs[-1])
        stations = [f * half for f in ((-0.7, 0.7) if half < 1.6 else (-0.75, 0.0, 0.75))]
        if self.held in ("saddles", "blocks"):
            thick = 0.5 * r if self.held == "blocks" else 0.2 * r
            tall = top - 0.2 * r
            return [box((thick, wide, tall), (x, 0, tall / 2)) for x in stations]
        if self.held == "plate":
            plates = [box((0.015, wide + 1.6 * r, top + 1.4 * r), (x, 0, (top + 1.4 * r) / 2)) for x in stations]
            return [*plates, box((2 * half, 0.3 * r + b, b), (0, 0, b / 2))]
        return self._rack(r, stations, wide, zs, low)

    def _rack(self, r: float, stations: list[float], wide: float, zs: np.ndarray, low: float) -> list[Solid]:
        """Rails under each layer of tubes and the posts that they are on."""
        b, top = self.beam, low + float(zs[-1])
        levels = [low + float(z) - 0.82 * r - b / 2 for z in zs]
        y = wide / 2 + b / 2
        rails = [box((b, wide + 2 * b, b), (x, 0, z)) for x in stations for z in levels]
        if self.held == "posts":
            tall = low + float(zs[-1]) - r
            posts = [box((b, b, tall), (x, y, tall / 2)) for x in stations]
            feet = [box((3 * b, wide + 2 * b, 0.2 * b), (x, 0, 0.1 * b)) for x in stations]
            return [*rails, *posts, *feet]
        tall = top + (0.9 * r if self.held == "rack" else -0.9 * r)
        posts = [box((b, b, tall), (x, s * y, tall / 2)) for x in stations for s in BOTH]
        span = stations[-1] - stations[0] + b
        ends = [
            box((span, b, b), (0, s * y, z)) for s in BOTH for z in ((b, tall - b / 2) if self.held == "rack" else (b,))
        ]
        cross = [box((b, 2 * y, b), (x, 0, b)) for x in stations]
        return [*rails, *posts, *ends, *cross]


class PlainHydrocyclone(_Plain, name="separator/plain hydrocyclone", label=_SEPARATOR, bundle=_SEPARATOR, weight=1.5):
    """A hydrocyclone: a short cylinder over a long cone, or a cluster of them round a distributor."""

    cluster: bool = chance(0.4, "several round a distributor")
    count: int = whole(2, 10, "cyclones", when=lambda p: p.cluster, otherwise=1)
    radius: float = between(0.04, lambda p: 0.16 if p.cluster else 0.4, "of a cyclone", "m")
    barrel: float = between(0.6, 2.4, "height of its cylinder / radius")
    cone: float = between(2.2, 9.0, "height of its cone / radius")
    stages: int = among((1, 1, 2), "cones of different slope")
    apex: float = between(0.14, 0.34, "radius of its apex / radius")
    spigot: str = among(("none", "flange", "sleeve", "bell", "pipe"), "what is at its apex")
    seams: int = whole(0, 2, "pairs of flanges")
    feed: str = among(("box", "taper", "taper", "pipe", "volute"), "its inlet")
    inlet: float = between(0.28, 0.5, "width of its inlet / radius")
    long: float = between(1.0, 2.4, "length of its inlet / radius")
    over: str = among(("bend", "bend", "straight", "long bend", "cap", "disc"), "its overflow")
    vortex: float = between(0.28, 0.5, "radius of its overflow / radius")
    cover: str = among(("disc", "disc", "dome", "none"), "its cover")
    stand: str = among(("legs", "legs", "frame", "plate", "post", "tub"), "what a single one stands on")
    low: float = between(0.1, 0.9, "from the floor to its apex", "m")
    decked: bool = chance(0.5, "a full deck round the distributor", when=lambda p: p.cluster)
    ring_: float = between(1.0, 1.8, "room between cyclones of a cluster / what they need", when=lambda p: p.cluster)
    can: float = between(0.25, 0.5, "radius of the distributor / of their circle", when=lambda p: p.cluster)
    launders: str = among(
        ("tubs", "tubs", "cones", "under", "none"), "what takes the flows", when=lambda p: p.cluster, otherwise="none"
    )

    def build(self, t: Table) -> Model:
        r, n = self.radius, self.n(t, self.radius)
        barrel, cone = self.barrel * r, min(self.cone * r, 2.2)
        if self.cluster:
            self._battery(t, r, barrel, cone, n)
            return t.model(kind="hydrocyclone")
        tail = self._tail(r)
        low = self.low + tail
        body = [moved(one, at(0, 0, low)) for one in self._cyclone(r, barrel, cone, n, self.long * r)]
        self.put(t, [(_SEPARATOR, body), ("tank leg", self._stand(r, low, low + cone, n))])
        return t.model(kind="hydrocyclone")

    def _tail(self, r: float) -> float:
        """How far the spigot goes below the cone [m]."""
        return {"none": 0.0, "flange": 0.15, "sleeve": 0.5, "bell": 0.6, "pipe": 1.2}[self.spigot] * r

    def _cyclone(self, r: float, barrel: float, cone: float, n: int, long: float) -> list[Solid]:
        """One on z = 0 with its apex, its inlet from -x at its side towards -y."""
        apex, top, tail = self.apex * r, cone + barrel, self._tail(r)
        middle = outline(0.4 * r + 0.6 * apex, 0.45 * cone) if self.stages == 2 else []
        found = [turned([*outline(apex, 0.0), *middle, *outline(r, cone, r, top)], n)]
        seams = ((cone, 1.18 * r), (0.45 * cone, 1.15 * (0.45 * r + 0.55 * apex) + 0.12 * r))[: self.seams]
        found += [cylinder(wide, z - 0.07 * r, z + 0.07 * r, n) for z, wide in seams]
        spigots = {
            "flange": outline(1.9 * apex, -tail, 1.9 * apex, 0.02 * r),
            "sleeve": outline(1.3 * apex, -tail, 1.3 * apex, 0.15 * r),
            "bell": outline(2.6 * apex, -tail, 1.1 * apex, -0.1 * tail, 1.1 * apex, 0.05 * r),
            "pipe": outline(0.9 * apex, -tail, 0.9 * apex, 0.1 * r),
        }
        if self.spigot != "none":
            found.append(turned(spigots[self.spigot], n))
        if self.cover == "disc":
            found.append(cylinder(1.16 * r, top - 0.05 * r, top + 0.12 * r, n))
        elif self.cover == "dome":
            found.append(dome(r, 0.35 * r, top - 0.01 * r, n))
        return [*found, *self._feed(r, top, barrel, n, long), *self._overflow(r, top, n)]

    def _feed(self, r: float, top: float, barrel: float, n: int, long: float) -> list[Solid]:
        w = self.inlet * r
        h = min(0.85 * barrel, 2.4 * w)
        z, y, far = top - 0.1 * r - h / 2, -(r - w / 2), -r - long
        if self.feed == "pipe":
            s = min(w / 2 + 0.1 * r, h / 2)
            flange = along("x", cylinder(1.7 * s, 0, 0.1 * r, n), far, -(r - s), z)
            return [rod((far, -(r - s), z), (0, -(r - s), z), s, n), flange]
        rim = box((0.1 * r, 1.5 * w + 0.1 * r, h + 0.5 * w), (far, y, z))
        if self.feed == "box":
            return [box((-far, w, h), (far / 2, y, z)), rim]
        if self.feed == "volute":
            shape = [(1.25 * r * (1 - 0.2 * k / 12), np.pi * 1.5 * (1 - k / 12) - np.pi / 2) for k in range(13)]
            loop = np.array([(s * np.cos(a), s * np.sin(a)) for s, a in reversed(shape)])
            return [extrude(loop, z - h / 2, z + h / 2), box((-far, w + 0.2 * r, h), (far / 2, y - 0.1 * r, z)), rim]
        square = np.array([(0.0, y - w / 2), (0.0, y + w / 2), (far, y + 0.8 * w), (far, y - 0.8 * w)])
        return [extrude(square, z - h / 2, z + h / 2), rim]

    def _overflow(self, r: float, top: float, n: int) -> list[Solid]:
        s, low, k = self.vortex * r, top - 0.05 * r, max(n, 6)
        rise = top + 0.3 * r + 2 * s
        if self.over == "straight":
            return [cylinder(s, low, top + 1.2 * r, n), cylinder(1.6 * s, top + 1.1 * r, top + 1.2 * r, n)]
        if self.over == "disc":
            return [cylinder(1.5 * s, low, top + 0.25 * r, n)]
        if self.over == "cap":
            return [
                cylinder(0.8 * r, low, top + 0.7 * r, n),
                rod((0, 0, top + 0.35 * r), (1.6 * r, 0, top + 0.35 * r), 0.3 * r, k),
            ]
        far = 1.3 * r if self.over == "bend" else 2.2 * r
        a = np.linspace(0, np.pi / 2, 4)
        arc = [(1.6 * s * (1 - np.cos(v)), 0.0, rise - 1.6 * s + 1.6 * s * np.sin(v)) for v in a]
        end = [(far, 0.0, rise)] if self.over == "bend" else [(far, 0.0, rise), (far + s, 0.0, rise - 2.5 * r)]
        pipe = rope([(0.0, 0.0, low), *arc, *end], s, k)
        return [pipe, along("x", cylinder(1.5 * s, -0.1 * r, 0.0, n), far, 0, rise)] if self.over == "bend" else [pipe]

    def _stand(self, r: float, low: float, seat: float, n: int) -> list[Solid]:
        s = 0.05 * r + 0.012
        out = 1.3 * r + s
        if self.stand == "tub":
            wide = 1.3 * r + 0.05
            return [
                box((2 * wide, 2 * wide, 0.9 * low), (0, 0, 0.45 * low)),
                cylinder(0.4 * r, 0, low + 0.35 * (seat - low), n),
            ]
        plate = ring(0.9 * r, (out + 1.5 * s) / np.cos(np.pi / n), seat - 0.08 * r, seat + 0.02 * r, n)
        if self.stand == "legs":
            legs = [rod((out * np.cos(a), out * np.sin(a), 0), (out * np.cos(a), out * np.sin(a), seat), s, 8)
                    for a in (0.5, 2.6, 4.7)]  # fmt: skip
            return [plate, *legs]
        w = 2 * out + 2 * s
        if self.stand == "post":
            z = seat + 0.2 * r
            arm = box((3 * s, 1.4 * r, 3 * s), (0, 1.4 * r, seat))
            return [box((4 * s, 4 * s, z), (0, 2.1 * r, z / 2)), arm, box((2.5 * r, 2.5 * r, 0.02), (0, 1.5 * r, 0.01))]
        sheet = box((w, w, 0.12 * r), (0, 0, seat - 0.02 * r))
        frame = frame_of(w, w, seat, 2 * s, rails=self.stand == "frame")
        return [sheet, frame]

    def _battery(self, t: Table, r: float, barrel: float, cone: float, n: int) -> None:
        """Several round a distributor."""
        top = cone + barrel
        circle_r = max(3.0 * r * self.count * self.ring_ / (2 * np.pi), 2.6 * r * self.ring_ + 0.1)
        low = self.low + self._tail(r) + 0.25
        can, long = self.can * circle_r, 1.1 * r
        one = merge(self._cyclone(r, barrel, cone, n, long))
        big = self.n(t, circle_r)
        ways = [around(one, self.count, circle_r)]
        feed = top - 0.4 * barrel
        core = [cylinder(can, feed - 1.1 * r - can * 0.4, feed + 0.9 * r, big)]
        core.append(cylinder(0.45 * can, -low + 0.02, feed, min(big, 24)))
        spoke = rod((0, -0.7 * r, feed), (circle_r, -0.7 * r, feed), 0.35 * r, 8)
        core.append(around(spoke, self.count))
        pieces = [moved(x, at(0, 0, low)) for x in (*ways, *core)]
        tubs = [moved(x, at(0, 0, low)) for x in self._launders(r, circle_r, top, can, big)]
        out = circle_r + 1.9 * r
        s = 0.08 * r + 0.02
        legs = [rod((out * np.cos(a), out * np.sin(a), 0), (out * np.cos(a), out * np.sin(a), low + cone), s, 8)
                for a in np.arange(4) * np.pi / 2 + 0.4]  # fmt: skip
        seat = low + cone
        deck = ring(
            0.4 * can if self.decked else circle_r + 0.5 * r,
            (out + 1.5 * s) / np.cos(np.pi / big),
            seat - 0.1 * r - 0.01,
            seat + 0.02,
            big,
        )
        self.put(t, [(_SEPARATOR, [*pieces, *tubs]), ("skid frame", [*legs, deck])])

    def _launders(self, r: float, far: float, top: float, can: float, n: int) -> list[Solid]:
        """Troughs over and under a cluster, its apexes at 0."""
        wide, tall = far + 1.3 * r, 1.2 * r + 0.1
        tail = self._tail(r)
        if self.launders == "none":
            return []
        deep = min(tall, self.low + 0.2)
        tub = turned(outline(wide, -tail - 0.2 * r - deep, wide, 0.2 * r), n, bore=0.35 * can)
        if self.launders == "under":
            return [tub]
        z = top + 0.25 * r
        upper = ring(0.8 * can, wide, z, z + tall, n)
        if self.launders == "cones":
            end = -tail - 0.2 * r - deep
            tub = turned(outline(0.4 * wide, end, wide, end + 0.7 * deep, wide, 0.2 * r), n)
        return [tub, upper]


class PlainPack(_Plain, name="heat exchanger/plain pack", label=_HEX, bundle=_HEX, weight=1.5):
    """A plate exchanger: a frame plate, a pack, a pressure plate, bars and bolts; or a brazed or jacketed brick."""

    form: str = among(("framed", "framed", "framed", "brazed", "brazed", "jacket", "bolted"), "its build")
    wide: float = between(
        lambda p: 0.07 if p.form == "brazed" else 0.18, lambda p: 0.3 if p.form == "brazed" else 0.9, "of a plate", "m"
    )
    tall: float = between(1.5, 3.6, "height of a plate / width")
    deep: float = between(0.25, 2.6, "depth of the pack / width")
    size: int = among(lambda p: _fitting(0.5 * p.wide), "nominal size of its mouths", "mm")
    corner: float = among((0.0, 0.0, 0.1, 0.25, 0.48), "radius of its corners / width")
    ribs: int = among((0, 0, 0, 8, 14, 24), "plates that show")
    inset: float = between(0.7, 0.97, "width of the pack / of its frame plate")
    thick: float = between(0.04, 0.14, "thickness of a frame plate / width")
    low: float = between(0.02, 0.35, "from the floor to its plates / height")
    bars: str = among(
        ("rods", "rods", "beams", "none"), "carrying bars", when=lambda p: p.form == "framed", otherwise=""
    )
    tail: float = between(0.3, 1.3, "from the pack to the end post / width", when=lambda p: p.form == "framed")
    post: str = among(("box", "wide", "none"), "end post", when=lambda p: p.form == "framed", otherwise="none")
    ties: int = among(
        (0, 2, 3, 4, 5, 6), "tie bolts on each side", when=lambda p: p.form in ("framed", "bolted"), otherwise=0
    )
    feet: str = among(("plate", "blocks", "pads", "rails", "bracket"), "what it stands on")
    mouths: int = among((4, 4, 4, 2), "mouths in the frame plate")
    far: int = among((0, 0, 0, 2), "mouths in the pressure plate")
    reach: float = between(0.12, 0.45, "length of its mouths / width")
    apart: float = between(0.24, 0.32, "from the middle to a mouth / width")
    laid: bool = chance(0.12, "it lies on its back", when=lambda p: p.form == "brazed")
    mouth: PlainPort = port_of(lambda p: p.size, "mouths", kind=_Mouth)

    def build(self, t: Table) -> Model:
        w, h, d, f = self.wide, self.tall * self.wide, self.deep * self.wide, self.thick * self.wide
        low = self.low * h + 0.02
        mid, k = low + h / 2, self.n(t, PIPES[self.size].radius)
        x1 = f + d
        back = x1 + {"framed": 1.0, "brazed": 0.2}.get(self.form, 0.5) * f
        first, last = self._plates(w, h, d, f, mid)
        reach = self.reach * w + 0.03
        ends = [(s, u) for u in (0.38, -0.38) for s in BOTH][: self.mouths]
        if self.mouths == 2:
            ends = [(-1, 0.38), (-1, -0.38)]
        spots = [(-reach, s * self.apart * w, mid + u * h) for s, u in ends]
        made, ports = built_ports(t, [self.mouth] * len(spots), spots, (-1, 0, 0), reach + 0.5 * f, k)
        first += made
        if self.far and self.form != "jacket" and not self.laid:
            x = back + reach
            spots = [(x, self.apart * w, mid + u * h) for u in (0.38, -0.38)]
            made, more = built_ports(t, [self.mouth] * 2, spots, (1, 0, 0), reach + 0.5 * f, k)
            last, ports = last + made, ports + more
        pack = self._pack(w, h, d, f, mid)
        n = self.n(t, 0.04 * w)
        frame = [*self._bars(w, h, back, mid, n), *self._feet(w, back, low, f)]
        if self.laid:
            pose = at(0, 0, back) @ spun("y", np.pi / 2) @ at(0, 0, -mid)
            first, pack, last = ([moved(one, pose) for one in some] for some in (first, pack, last))
            self.put(t, [(_HEX, [*first, *pack, *last])])
            ports = [Port(pose @ port.frame, port.dn) for port in ports]
            return t.model(kind="plate heat exchanger", ports=ports)
        self.put(
            t,
            [(_HEX, first), (_HEX, pack), (_HEX, last), ("bracket", frame), ("stud", self._ties(w, h, back, f, mid))],
        )
        return t.model(kind="plate heat exchanger", ports=ports)

    def _sheet(self, w: float, h: float, x0: float, x1: float, mid: float, corner: float) -> Solid:
        """A plate across x."""
        if not corner:
            return box((x1 - x0, w, h), ((x0 + x1) / 2, 0, mid))
        return along("x", extrude(rounded_rectangle(h, w, corner * w, 4), x0, x1), 0, 0, mid)

    @property
    def _corner(self) -> float:
        """Radius of the corners of its outer plates / width."""
        return self.corner if self.form != "framed" else min(self.corner, 0.1)

    def _plates(self, w: float, h: float, d: float, f: float, mid: float) -> tuple[list[Solid], list[Solid]]:
        corner = self._corner
        if self.form == "brazed":
            f *= 0.4
        back = 2 * f if self.form == "framed" else f
        low = mid - h / 2
        first = self._sheet(w, h, 0.0, f, mid, corner)
        if self.form == "framed" and not corner:
            first = box((f, w, h + low + 0.04 * h), (f / 2, 0, (h + low + 0.04 * h) / 2))
        start = self.thick * self.wide + d
        return [first], [self._sheet(w, h, start - 0.001, start + back / 2, mid, corner)]

    def _pack(self, w: float, h: float, d: float, f: float, mid: float) -> list[Solid]:
        inset = 1.06 if self.form == "jacket" else self.inset
        wide, high = inset * w, h * (1.03 if self.form == "jacket" else 0.4 + 0.6 * self.inset)
        corner = self.corner if self.form in ("brazed", "bolted") else 0.0
        start, end = (0.3 * f, f + d) if self.form in ("brazed", "jacket") else (f - 0.001, f + d)
        if not self.ribs or self.form == "jacket":
            return [self._sheet(wide, high, start, end, mid, corner)]
        step = (end - start) / self.ribs
        shares = (1.0, 0.93)
        return [
            self._sheet(
                shares[k % 2] * wide,
                high - (1 - shares[k % 2]) * wide,
                start + k * step,
                start + (k + 1) * step + 0.0005,
                mid,
                corner,
            )
            for k in range(self.ribs)
        ]

    def _bars(self, w: float, h: float, back: float, mid: float, n: int) -> list[Solid]:
        if self.form != "framed":
            return []
        end, s, found = back + self.tail * w, 0.035 * w + 0.008, []
        top, low = mid + h / 2 + 0.6 * s, mid - h / 2 - 0.2 * s
        if self.bars == "rods":
            found += [rod((0, 0, z), (end, 0, z), s, n) for z in (top, low)]
        elif self.bars == "beams":
            found += [box((end, 1.6 * s, 2.4 * s), (end / 2, 0, z)) for z in (top, low)]
        if self.bars != "none" and self.post != "none":
            wide = 0.9 * w if self.post == "wide" else 4 * s
            found.append(box((2.5 * s, wide, top + 1.5 * s), (end, 0, (top + 1.5 * s) / 2)))
        return found

    def _feet(self, w: float, back: float, low: float, f: float) -> list[Solid]:
        up = low + (0.02 + 0.5 * self._corner) * w
        if self.feet == "plate":
            return [
                box((back, 0.5 * w, up), (back / 2, 0, up / 2)),
                box((1.1 * back, 1.2 * w, 0.012), (back / 2, 0, 0.006)),
            ]
        if self.feet == "pads":
            return [
                box((1.2 * f + 0.02, 0.25 * w, up), (x, s * 0.35 * w, up / 2))
                for s in BOTH
                for x in (f / 2, back - f / 2)
            ]
        if self.feet == "rails":
            return [box((1.15 * back, 0.14 * w, up), (back / 2, s * 0.3 * w, up / 2)) for s in BOTH]
        if self.feet == "bracket":
            tall = up + 0.5 * self.tall * w
            return [
                box((0.03 * w + 0.004, 0.9 * w, tall), (back, 0, tall / 2)),
                box((0.9 * w, 0.9 * w, 0.01), (back, 0, 0.005)),
            ]
        return [box((0.12 * w + f, 1.05 * w, up), (x, 0, up / 2)) for x in (f / 2, back - f / 2)]

    def _ties(self, w: float, h: float, back: float, f: float, mid: float) -> list[Solid]:
        if not self.ties:
            return []
        s = 0.018 * w + 0.003
        over = 0.2 * f + 2 * s
        end = back + over + 0.12 * self.deep * w
        one = along("x", merge([cylinder(s, -over, end, 6), hexagon(3.4 * s, -over, 0.001)]))
        nut = along("x", hexagon(3.4 * s, back - 0.5 * f, back + over))
        most = min(0.42, 0.49 - self._corner * w / h)
        levels = np.linspace(-most, most, self.ties)
        spots = [(a * (0.5 * w + 0.4 * s), mid + u * h) for a in BOTH for u in levels]
        return [moved(x, at(0, y, z)) for y, z in spots for x in (one, nut)]


PLAIN_FILTERS = families_of(HeadAndBowl, PlainHousing, MembraneVessels, PlainHydrocyclone, PlainPack)
