"""Radiators, duct coils and cooling towers."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import one_of
from cadplants.builder.params import among, between, chance, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.vessels.exchangers import Equipment, equipment_mouth
from cadplants.families.vessels.vessel_fittings import sides
from cadplants.model.family import Model, Part, Port
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, hexagon, lofted, ring, rod, rope, turned
from cadplants.solids.transforms import at, spun

__all__ = ["RADIATORS", "wall_behind"]

_HEX, _RAD = "heat exchanger", "radiator"


class _Radiator(Equipment, label=_RAD, bundle=_RAD, weight=0.9):
    """A radiator."""


class _Exchanger(Equipment, label=_HEX, bundle=_HEX):
    """A heat exchanger of air."""


def wall_behind(w: float, h: float, y: float) -> Part:
    """A piece of wall whose face is at ``y``, looking to -y."""
    return Part(box((w, 0.12, h), (0, y + 0.06, h / 2)), "wall", "concrete", "", "Structural element")


def _valve(t: Table, x: float, y: float, z: float, s: int) -> None:
    """A thermostatic or lockshield radiator valve with its pipe from the floor."""
    t = t.at(x, y)
    body = [rod((-s * 0.045, 0, z), (0, 0, z), 0.011, 10), rod((0, 0, z - 0.03), (0, 0, z + 0.012), 0.013, 10)]
    knob = turned(outline(0.02, 0.01, 0.023, 0.06, 0.015, 0.07), 16)
    t.add("valve", *body, along("x" if s > 0 else "-x", knob, 0, 0, z))
    t.add("pipe", rod((0, 0, 0), (0, 0, z - 0.03), 0.0075, 8))


class TowelRail(_Radiator, name="radiator/towel rail"):
    """A towel rail (EN 442): round, D or flat bars in groups between two rails, on wall brackets, valves below."""

    width: float = among((0.4, 0.5, 0.6), "between the rails", "m")
    height: float = among((0.8, 1.2, 1.5, 1.8), "of the rails", "m")
    groups: int = whole(2, 4, "groups of bars")
    bars: str = among(("between", "in front", "flat"), "where round bars are, or flat ones")
    square: bool = chance(0.4, "its rails are square")
    bow: float = among((0.0, 0.05, 0.08), "how far round bars bow", "m", when=lambda p: p.bars != "flat", otherwise=0.0)

    def build(self, t: Table) -> Model:
        w, h, low, stand, n = self.width, self.height, 0.25, 0.09, t.n(0.015, 6, 12)
        top, bars = low + h, []
        for x in (-w / 2, w / 2):
            rail = box((0.04, 0.03, h), (x, 0, low + h / 2)) if self.square else rod((x, 0, low), (x, 0, top), 0.019, n)
            t.add(_RAD, rail, of="dial")
        edges = np.linspace(low + 0.03, top - 0.03, self.groups + 1)
        for a, b in zip(edges[:-1], edges[1:], strict=True):
            for z in np.linspace(a, b - 0.09, max(2, int((b - a - 0.09) / 0.042))):
                if self.bars == "flat":
                    bars.append(box((w, 0.012, 0.03), (0, -0.016, z)))
                    continue
                s = np.linspace(-1, 1, 7 if self.bow else 2)
                y = -self.bow * (1 - s * s) - (0.012 if self.bars == "in front" else 0.0)
                bars.append(rope(np.column_stack([s * w / 2, y, np.full(len(s), z)]), 0.011, n))
        t.add(_RAD, *bars, of="dial")
        levels = [bars[k].vertices[:, 2].mean() for k in (0, -1)]
        holders = [rod((s * w / 2, 0, z), (s * w / 2, stand, z), 0.009, 8) for s in BOTH for z in levels]
        t.add("bracket", *holders, of="trim")
        t.extend([wall_behind(w + 0.8, top + 0.4, stand)])
        body = [cylinder(0.012, low - 0.09, low + 0.002, 10), hexagon(0.026, low - 0.04, low - 0.015)]
        for x in (-w / 2, w / 2):
            t.at(x).add("valve", *body)
            t.at(x).add("pipe", rod((0, 0, 0), (0, 0, low - 0.09), 0.0075, 8))
        return t.model(kind="towel radiator")


class Convector(_Radiator, name="radiator/convector"):
    """A convector: a sheet case with a louvred outlet above, a finned tube inside, on feet or a wall."""

    width: float = between(0.6, 1.8, "of the case", "m")
    height: float = between(0.2, 0.7, "of the case", "m")
    depth: float = between(0.08, 0.2, "of the case", "m")
    low: float = between(0.06, 0.12, "from the floor to the case", "m")
    footed: bool = chance(0.6, "on feet rather than on a wall")
    lift: float = between(0.0, 0.2, "how much higher it hangs on a wall", "m", when=lambda p: not p.footed)

    def build(self, t: Table) -> Model:
        w, h, d, low, sheet = self.width, self.height, self.depth, self.low, 0.003
        up, top = t.at(0, 0, self.lift), low + h
        case = [box((w, sheet, h), (0, s * (d - sheet) / 2, low + h / 2)) for s in BOTH]
        case += [box((sheet, d, h), (s * (w - sheet) / 2, 0, low + h / 2)) for s in BOTH]
        up.add(_RAD, *case, of="dial")
        ys = np.linspace(-d / 2 + 0.012, d / 2 - 0.012, max(4, int(d / 0.014)))
        bars = [box((w - 2 * sheet, 0.003, 0.02), (0, y, top - 0.01)) for y in ys]
        bars += [box((0.004, d - 0.004, 0.018), (x, 0, top - 0.011)) for x in np.linspace(-0.4, 0.4, 5) * w]
        up.add(_RAD, *bars, of="clamp")
        z, out = low + 0.08, w / 2 - 0.02
        fins = [box((0.001, 0.85 * d, 0.1), (x, 0, z)) for x in np.linspace(-0.44, 0.44, 40) * w]
        y, x = 0.2 * d, -w / 2 - 0.06
        up.add(_RAD, *fins, rope([(x, -y, z), (out, -y, z), (out, y, z), (x, y, z)], 0.0107, 10), of="trim")
        z += self.lift
        _valve(t, x, -y, z, -1)
        t.add("pipe", rope([(x + 0.02, y, z), (x, y, z), (x, y, 0)], 0.0075, 8))
        if self.footed:
            t.add("bracket", *(box((0.04, d - sheet, low + 0.01), (s * 0.35 * w, 0, (low + 0.01) / 2)) for s in BOTH))
        else:
            t.extend([wall_behind(w + 0.6, 1.2, d / 2)])
        return t.model(kind="convector")


class FinnedTube(_Radiator, name="radiator/finned tube"):
    """Finned tubes as heaters of halls: one to four rows with round or square fins, return bends, on wall brackets."""

    length: float = between(1.0, 3.0, "of the tubes", "m")
    tube_rows: int = whole(1, 4, "tubes above each other")
    tube: float = among((0.017, 0.024, 0.03), "radius of the tubes", "m")
    fin: float = between(0.045, 0.075, "radius of the fins", "m")
    low: float = between(0.25, 0.5, "height of the lowest tube", "m")
    square: bool = chance(0.5, "its fins are square, not round")

    def build(self, t: Table) -> Model:
        r, fin, half, n = self.tube, self.fin, self.length / 2, t.n(self.tube)
        pitch, end, wall = 2.5 * fin, half + 0.02, fin + 0.05
        zs = self.low + pitch * np.arange(self.tube_rows)
        disc = along("x", cylinder(fin, -0.001, 0.001, t.n(fin, 0, 16)))
        one = box((0.0015, 1.9 * fin, 1.9 * fin)) if self.square else disc
        xs = np.linspace(-0.92, 0.92, int(np.clip(self.length / 0.02, 30, 90))) * half
        row = [*(moved(one, at(x)) for x in xs), rod((-end, 0, 0), (end, 0, 0), r, n)]
        for z in zs:
            t.at(0, 0, z).add(_RAD, *row, of="steel")
        a = np.linspace(-np.pi / 2, np.pi / 2, 9)
        bend = np.column_stack([end + pitch / 2 * np.cos(a), np.zeros(9), pitch / 2 * (1 + np.sin(a))])
        for k, z in enumerate(zs[:-1]):
            t.at(0, 0, z).add("elbow", rope(bend * ((1, -1)[k % 2], 1, 1), r, n))
        rail = box((0.03, 0.006, zs[-1] - zs[0] + 0.16), (0, wall - 0.003, (zs[0] + zs[-1]) / 2))
        holder = [rail, *(box((0.03, wall, 0.006), (0, wall / 2, z - r - 0.002)) for z in zs)]
        t.add("bracket", *(moved(one, at(x)) for x in (-0.97 * half, 0.97 * half) for one in holder))
        t.extend([wall_behind(self.length + 0.6, zs[-1] + 0.5, wall)])
        return t.model(kind="finned tube heater")


class Cast(_Radiator, name="radiator/cast", weight=1.0):
    """A cast-iron radiator: rounded sections of two to six columns with waists, cast feet on the end ones, plugs."""

    count: int = whole(4, 13, "sections")
    columns: int = among((2, 3, 4, 6), "columns of a section")
    height: float = among((0.36, 0.5, 0.7, 0.9), "of a section", "m")
    pitch: float = between(0.05, 0.07, "from section to section", "m")
    gap: float = between(0.036, 0.05, "from column to column", "m")
    side: int = among((-1, 1), "the end with its valve")

    def build(self, t: Table) -> Model:
        h, pitch, gap, low, n = self.height, self.pitch, self.gap, 0.09, t.n(0.02, 8, 12)
        deep, wide, last = (self.columns - 1) * gap, 0.42 * pitch, (self.count - 1) * pitch
        narrow, end, hubs = 0.8 * wide, 0.55 * wide, (low + 0.05, low + h - 0.05)
        waist = outline(end, 0, wide, 0.05, narrow, 0.12 * h, narrow, 0.88 * h, wide, h - 0.05, end, h)
        squeeze = np.diag([1.0, 0.48 * gap / wide, 1.0, 1.0])
        section = [moved(turned(waist, n), at(0, c * gap, low) @ squeeze) for c in range(self.columns)]
        hub = extrude(rounded_rectangle(pitch, deep + gap, 0.4 * gap, 3), -0.022, 0.022)
        section += [moved(hub, at(0, deep / 2, z)) for z in hubs]
        if self.columns > 2:
            section.append(box((0.5 * wide, deep, 0.02), (0, deep / 2, low + h / 2)))
        for k in range(self.count):
            t.at(k * pitch).add(_RAD, *section, of="dial")
        square, steps = np.array(outline(-0.5, -0.5, 0.5, -0.5, 0.5, 0.5, -0.5, 0.5)), ((0.05, 0.0), (0.035, 0.03))
        foot = lofted([np.column_stack([square * s, np.full(4, z)]) for s, z in (*steps, (0.03, low + 0.04))])
        t.add(_RAD, *(moved(foot, at(x, y)) for x in (0.0, last) for y in (0.0, deep)), of="dial")
        out = pitch / 2
        plug = merge([cylinder(0.024, 0.0, out + 0.012, 12), hexagon(0.036, out + 0.01, out + 0.03)])
        ways = (("-x", 0.0), ("x", last))
        t.add(_RAD, *(along(way, plug, x, deep / 2, z) for way, x in ways for z in hubs), of="trim")
        x = 0.0 if self.side < 0 else last
        _valve(t, x + self.side * (out + 0.075), deep / 2, low + 0.05, self.side)
        return t.model(kind="cast radiator")


class Plinth(_Radiator, name="radiator/plinth", weight=0.8):
    """A skirting or bench radiator: long flat or round tubes on edge, on consoles, maybe a grille."""

    width: float = between(0.8, 2.4, "of the tubes", "m")
    tube_rows: int = among((1, 2, 3), "tubes above each other")
    columns: int = whole(2, 4, "tubes behind each other")
    flat: bool = chance(0.6, "its tubes are flat, not round")
    joined: bool = chance(0.6, "the tubes are one mesh")
    finned: bool = chance(0.6, "fins between the tubes")
    grilled: bool = chance(0.4, "a grille on top")

    def build(self, t: Table) -> Model:
        w, gap, low, z0 = self.width, 0.035, 0.1, 0.14
        tall, deep = self.tube_rows * 0.075, (self.columns - 1) * gap
        middle = deep / 2
        tube = box((w, 0.011, 0.07)) if self.flat else rod((-w / 2, 0, 0), (w / 2, 0, 0), 0.0125, 10)
        places = np.ndindex(self.tube_rows, self.columns)
        tubes = [moved(tube, at(0, j * gap, z0 + i * 0.075)) for i, j in places]
        for solid in [merge(tubes)] if self.joined else tubes:
            t.add(_RAD, solid, of="dial")
        ends = [box((0.035, deep + 0.03, tall), (s * (w / 2 + 0.012), middle, low + tall / 2)) for s in BOTH]
        t.add(_RAD, *ends, of="dial")
        if self.finned:
            ys = (np.arange(self.columns - 1) + 0.5) * gap
            fins = [box((0.001, 0.7 * gap, 0.06), (x, y, z0)) for x in np.linspace(-0.45, 0.45, 30) * w for y in ys]
            t.add(_RAD, *fins, of="dial")
        if self.grilled:
            top, xs = low + tall + 0.003, np.arange(-w / 2 + 0.02, w / 2, 0.03)
            slats = [box((0.018, deep + 0.03, 0.006), (x, middle, top)) for x in xs]
            t.add(_RAD, *slats, *(box((w, 0.012, 0.006), (0, y, top)) for y in (0.0, deep)), of="clamp")
        rest = z0 - (0.034 if self.flat else 0.0115)
        foot = [box((0.03, deep + 0.02, rest), (0, middle, rest / 2))]
        foot.append(box((0.08, deep + 0.08, 0.005), (0, middle, 0.0025)))
        t.add("bracket", *(moved(merge(foot), at(s * 0.36 * w)) for s in BOTH))
        _valve(t, w / 2 + 0.074, middle, z0, 1)
        return t.model(kind="plinth radiator")


# --- air and water ---


class DuctCoil(_Exchanger, name="heat exchanger/duct coil"):
    """A finned coil for a duct: a flanged sheet frame, fins across many rows, return bends at one end, two headers."""

    width: float = between(0.5, 1.4, "of the frame", "m")
    height: float = between(0.4, 1.0, "of the frame", "m")
    tube_rows: int = among((2, 3, 4, 6), "rows of tubes")
    low: float = between(0.08, 0.4, "from the floor to the frame", "m")

    def build(self, t: Table) -> Model:
        w, h, rows, low = self.width, self.height, self.tube_rows, self.low
        deep, r, x = 0.05 + 0.033 * rows, 0.017 + 0.01 * h, -w / 2 - 0.05
        frame = [box((w, deep, 0.003), (0, 0, low + z)) for z in (0.0, h)]
        frame += [box((0.003, deep, h), (s * w / 2, 0, low + h / 2)) for s in BOTH]
        hem, side = (w + 0.06, 0.003, 0.03), (0.03, 0.003, h)
        frame += [box(hem, (0, s * deep / 2, low + z)) for s in BOTH for z in (-0.013, h + 0.013)]
        frame += [box(side, (e * (w / 2 + 0.015), s * deep / 2, low + h / 2)) for s in BOTH for e in BOTH]
        t.add(_HEX, *frame, of="clamp")
        fin = (0.001, 0.8 * deep, h - 0.004)
        t.add(_HEX, *(box(fin, (x_, 0, low + h / 2)) for x_ in np.linspace(-0.48, 0.48, 60) * w), of="trim")
        a = np.linspace(-np.pi / 2, np.pi / 2, 5)
        bend = rope(np.column_stack([w / 2 + 0.02 * np.cos(a), np.zeros(5), 0.019 * np.sin(a)]), 0.0065, 6)
        ys, zs = (np.arange(rows) - (rows - 1) / 2) * 0.033, np.arange(low + 0.05, low + h - 0.04, 0.075)
        t.add(_HEX, *(moved(bend, at(0, y, z)) for y in ys for z in zs), of="pipe")
        heads, stubs, n = [], [], t.n(r)
        for s in BOTH:
            y, z = s * (deep / 2 + r + 0.005), low + (0.1 if s > 0 else h - 0.1)
            heads.append(rod((x, y, low + 0.04), (x, y, low + h - 0.04), r, n))
            stubs.append(rod((x, y, z), (-w / 2 - 0.2, y, z), 0.8 * r, n))
            levels = np.arange(low + 0.06, low + h - 0.05, 0.08)
            stubs += [rod((-w / 2 + 0.002, s * 0.3 * deep, z), (x, y, z), 0.006, 6) for z in levels]
        t.add(_HEX, *heads, *stubs, of="pipe")
        tall = low - 0.0015
        t.add("bracket", *(box((0.05, deep, tall), (s * 0.4 * w, 0, tall / 2)) for s in BOTH))
        return t.model(kind="duct coil")


class CoolingTower(_Exchanger, name="heat exchanger/cooling tower"):
    """A cooling tower: round (bottle) or square, a basin, louvres, a casing, a fan ring on top, an inlet."""

    radius: float = between(0.6, 1.3, "of the casing, or half its side", "m")
    slender: float = between(1.4, 2.2, "height of the casing / its radius")
    low: float = between(0.2, 0.5, "from the floor to the basin", "m")
    bottle: bool = chance(0.5, "it is round, not square")
    blades: int = among((4, 6), "blades of the fan")
    mouths: tuple[int, ...] = several(one_of(50, 65, 80), 2, "nominal sizes of the mouths, the upper first", "mm")

    def build(self, t: Table) -> Model:
        r, low, h, fan = self.radius, self.low, self.radius * self.slender, 0.5 * self.radius
        n, top = sides(t.style, r), low + (1.0 if self.bottle else 0.99) * h
        basin, casing, louvres, feet = self._bottle(h, n) if self.bottle else self._box(h)
        t.add(_HEX, *casing, ring(fan, fan + 0.03, top - 0.02, top + 0.25, n), of="dial")
        t.add(_HEX, basin, of="dial")
        t.add(_HEX, *louvres, of="dial")
        t.add("tank leg", *feet, own=True)
        blades = around(moved(box((0.85 * fan, 0.2 * fan, 0.01), (0.45 * fan, 0, 0)), spun("x", 0.4)), self.blades)
        hub, beam = cylinder(0.15 * fan, -0.01, 0.17, 16), box((2.05 * fan, 0.05, 0.04))
        crown = t.at(0, 0, top)
        crown.add("blower", hub, moved(blades, at(0, 0, 0.12)), beam, of="clamp")
        crown.add("motor", cylinder(0.13 * fan + 0.05, 0.16, 0.42, 16), own=True)
        ports: list[Port] = []
        reaches, curve = ((0.93 * r, 1.04 * r), r) if self.bottle else ((r, 1.05 * r), 0.0)
        spots = ((low + 0.7 * h, 0.0), (low + 0.2, np.pi / 2))
        for k, (z, a) in enumerate(spots):
            pose = spun("z", a) @ at(reaches[0 if z > low + 0.5 else 1], 0, z) @ spun("y", np.pi / 2)
            ports += equipment_mouth(t, self.mouths[k], pose, curve, 0.05 * r)
        return t.model(kind="cooling tower", ports=ports)

    def _bottle(self, h: float, n: int) -> tuple[Solid, list[Solid], list[Solid], list[Solid]]:
        """Basin, casing, louvres and feet of a round one."""
        r, low, wide = self.radius, self.low, 1.05 * self.radius
        basin = turned(outline(0.8 * r, low, wide, low + 0.15, wide, low + 0.35), n)
        wall = outline(r, low + 0.6, 1.02 * r, low + 0.65, 0.95 * r, low + 0.75 * h, 0.5 * r + 0.02, low + h)
        louvres = around(box((0.02, 0.05, 0.3), (0, 0, low + 0.475)), 24, 0.97 * r)
        feet = around(box((0.1, 0.1, low + 0.12), (0, 0, (low + 0.12) / 2)), 6, 0.85 * r)
        return basin, [turned(wall, n)], [louvres], [feet]

    def _box(self, h: float) -> tuple[Solid, list[Solid], list[Solid], list[Solid]]:
        """Basin, casing, louvres and feet of a square one."""
        r, low, corners = self.radius, self.low, [(x, y) for x in BOTH for y in BOTH]
        post, x = (0.06, 0.06, h - 0.34), r - 0.03
        casing = [box((2 * r, 2 * r, 0.45 * h), (0, 0, low + 0.765 * h))]
        casing += [box(post, (sx * x, sy * x, low + 0.34 + (h - 0.35) / 2)) for sx, sy in corners]
        slat, zs = moved(box((2 * r - 0.1, 0.12, 0.01)), spun("x", 0.8)), np.linspace(low + 0.42, low + 0.52 * h, 6)
        louvres = [moved(slat, spun("z", q * np.pi / 2) @ at(0, -r + 0.06, float(z))) for q in range(4) for z in zs]
        feet = [box((0.15, 0.15, low + 0.001), (sx * 0.95 * r, sy * 0.95 * r, low / 2)) for sx, sy in corners]
        return box((2.1 * r, 2.1 * r, 0.35), (0, 0, low + 0.175)), casing, louvres, feet


RADIATORS = families_of(DuctCoil, CoolingTower, TowelRail, Convector, FinnedTube, Cast, Plinth)
