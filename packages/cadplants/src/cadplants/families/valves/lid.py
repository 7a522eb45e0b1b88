"""Check valves on short barrels with a lid, also with a weighted lever, and spring ones of brass with two hexagons."""

from __future__ import annotations

from cadplants.builder.device import families_of
from cadplants.builder.draws import of_form
from cadplants.builder.params import Params, among, between, chance, nested
from cadplants.builder.table import Table, outline
from cadplants.families.valves.parts import BIG, SMALL, cover, hub_radius
from cadplants.families.valves.threaded import hex_end
from cadplants.families.valves.valve import Valve, flanged_body
from cadplants.model.family import Model
from cadplants.model.plant import Turning
from cadplants.parts.flange import plate_thickness
from cadplants.parts.valve_body import bore_of
from cadplants.solids.mesh_ops import moved
from cadplants.solids.primitives import along, box, cylinder, dome, hexagon, rod, turned
from cadplants.solids.transforms import at

__all__ = ["LIDDED"]


class _Weighted(Params):
    """A lever on a shaft's end with a weight: a disc, an upright cylinder, a block, a ball of steps, two discs."""

    form: str = among(("disc", "disc", "can", "block", "two discs"), "its weight")
    long: float = between(2.2, 4.2, "(length - 60 mm) / radius of the pipe")
    wide: float = between(0.2, 0.45, "(width of the bar - 8 mm) / radius of the pipe")
    slope: float = between(-0.5, 0.9, "from level down to its end", "rad")
    weight: float = between(0.55, 1.1, "(radius of the weight - 12 mm) / of the pipe")
    deep: float = between(0.5, 1.3, "depth of the weight / its radius")
    place_at: float = between(0.72, 0.95, "where the weight is / length")
    round_: bool = chance(0.35, "a round bar, not a flat one")

    def build(self, t: Table, n: int) -> None:
        """Puts it down: its shaft about y, the near side of its bar in y = 0, its end towards +x."""
        r, t = t.pipe.radius, t.spun("y", self.slope)
        long, wide, thick = self.long * r + 0.06, self.wide * r + 0.008, 0.08 * r + 0.005
        heavy, deep = self.weight * r + 0.012, self.deep * (self.weight * r + 0.012)
        x, y = self.place_at * long, 0.5 * thick
        hub = along("y", cylinder(0.9 * wide, -0.3 * thick, 1.3 * thick, min(n, 16)))
        bar = box((long, thick, wide), (0.46 * long, y, 0))
        if self.round_:
            bar = rod((0, y, 0), (long, y, 0), 0.5 * wide, 8)
        if self.form == "block":
            weight = [box((1.5 * heavy, deep, 1.7 * heavy), (x, y, 0))]
        elif self.form == "can":
            weight = [cylinder(0.8 * heavy, -heavy, heavy, n), hexagon(0.5 * wide, heavy, 1.15 * heavy)]
            weight = [moved(one, at(x, y)) for one in weight]
        else:
            spots = (-0.5 * deep, 0.25 * deep) if self.form == "two discs" else (-0.5 * deep,)
            long_one = deep if self.form == "disc" else 0.3 * deep
            weight = [along("y", cylinder(heavy, low, low + long_one, n), x, y) for low in spots]
            weight.append(along("y", hexagon(0.6 * wide, -0.62 * deep, 0.66 * deep), x, y))
        t.add("lever", hub, bar, turns=Turning("lever", (0.0, 1.0, 0.0)))
        t.add("lever", *weight)


class BarrelLid(Valve, name="check valve/barrel with lid", sizes=BIG, weight=1.5):
    """A swing check valve: a short flanged barrel, a chest with a domed or bolted lid, maybe a weighted lever aside."""

    length: float = between(1.0, 1.7, "face to face / outside of the flange")
    swell: float = between(1.05, 1.45, "(radius of the barrel - 5 mm) / of its necks")
    form: str = among(("bolted", "bolted", "domed", "square", "dome alone", "cap"), "its lid")
    chest: float = between(0.7, 1.0, "radius of the chest / of the barrel")
    lip: float = between(1.25, 1.5, "radius of the lid / of the chest")
    hood: float = between(0.15, 0.6, "rise of a dome / radius of the chest", when=of_form("domed", "dome alone"))
    bolts: int = among((6, 8, 10), "of the lid", when=of_form("bolted", "domed"), otherwise=8)
    shift: float = among((0.0, 0.06, -0.06), "of the lid from the middle / face to face")
    levered: bool = chance(0.45, "a weighted lever on the shaft's end")
    side: float = among((1.0, -1.0), "which side that is on", when=lambda p: p.levered, otherwise=1.0)
    lever: _Weighted = nested(_Weighted, "weighted lever", when=lambda p: p.levered)

    def build(self, t: Table) -> Model:
        r, length, neck = t.pipe.radius, round(self.length * t.flange.outer, 6), hub_radius(self.dn)
        b, low = max(self.swell * neck + 0.005, 1.1 * r), plate_thickness(self.dn)
        n, reach = t.n(b), length / 2 - low
        x, edge = length / 2, low + 0.25 * reach
        middle = outline(neck, edge, b, edge + 0.2 * reach, b, length - edge - 0.2 * reach, neck, length - edge)
        t.add("valve body", flanged_body(self.dn, t.style, length, middle))
        chest, plate = min(self.chest * b, 0.8 * reach), 0.012 + 0.08 * r
        lip = min(self.lip * chest, reach)
        # A lid wider than the room between the flanges lies over them.
        seat = max(b + 0.35 * r, 0.5 * t.flange.outer + plate + 0.01 if lip > 0.7 * reach else 0.0)
        up = t.at(x + self.shift * length)
        up.add("valve body", cylinder(chest, 0.6 * b, seat - 0.5 * plate, n))
        self._lid(up, chest, lip, seat, plate, n)
        if self.levered:
            self._shaft(t.at(x - 0.15 * length), b, n)
        return t.model(length, kind="check valve")

    def _lid(self, t: Table, chest: float, lip: float, seat: float, plate: float, n: int) -> None:
        if self.form in ("bolted", "domed", "square"):
            square = self.form == "square"
            t.extend(cover(lip, seat, plate, self.bolts, t.style, square, self.hood * chest))
            return
        low = seat - 0.51 * plate
        if self.form == "cap":
            nut = hexagon(1.1 * chest, seat + plate, seat + plate + 0.5 * chest)
            t.add(
                "valve bonnet",
                turned(outline(1.1 * chest, low, 1.1 * chest, seat + plate, 0.9 * chest, seat + 1.2 * plate), n),
                nut,
            )
            return
        t.add(
            "valve bonnet",
            cylinder(1.12 * chest, low, seat, n),
            dome(1.05 * chest, max(self.hood, 0.3) * chest, seat, n),
        )

    def _shaft(self, t: Table, b: float, n: int) -> None:
        """The shaft through the side of the barrel and the lever on its end."""
        r, z = t.pipe.radius, 0.55 * b
        boss, pin, out = 0.2 * r + 0.006, 0.1 * r + 0.004, max(b, 0.5 * t.flange.outer) + 0.015
        t = t.at(0, 0, z)
        axis = "y" if self.side > 0 else "-y"
        t.add("valve body", along(axis, cylinder(boss, 0.5 * b, out - 0.01, min(n, 16))))
        t.add("valve stem", along(axis, cylinder(pin, out - 0.012, out + 0.03 + 0.1 * r, 10)))
        near = out + 0.003
        # Its bar is as thick on the other side of y = 0.
        self.lever.build(t.at(0, near if self.side > 0 else -near - 0.08 * r - 0.005), n)


class TwoHexagons(Valve, name="check valve/two hexagons", sizes=SMALL, weight=1.25):
    """A spring check valve of brass: two screwed parts, each with its hexagon, a round or waisted middle between."""

    long: float = between(2.4, 5.0, "(length - 24 mm) / radius of the pipe")
    share: float = between(0.14, 0.32, "length of the inlet's hexagon / length")
    other: float = between(0.14, 0.42, "length of the outlet's hexagon / length")
    corners: int = among((6, 6, 6, 8), "of both")
    swell: float = between(1.15, 1.75, "radius of the middle / of the pipe")
    form: str = among(("round", "cone", "steps", "waist"), "form of the middle")
    lock: bool = chance(0.4, "a lock nut between the two parts")
    one: bool = chance(0.5, "both parts are one mesh")

    def build(self, t: Table) -> Model:
        r = t.pipe.radius
        length = round(self.long * r + 0.024, 6)
        first, last, b = self.share * length, (1 - self.other) * length, self.swell * r + 0.002
        low, high, n, bore = 0.9 * first, last + 0.1 * self.other * length, t.n(b), bore_of(self.dn, t.style)
        span = high - low
        shapes = {
            "round": outline(1.05 * r, low, b, low + 0.3 * span, b, high - 0.3 * span, 1.05 * r, high),
            "cone": outline(b, low, b, low + 0.35 * span, 1.05 * r, high),
            "steps": outline(b, low, b, low + 0.55 * span, 1.1 * r, low + 0.55 * span, 1.1 * r, high),
            "waist": outline(b, low, 1.08 * r, low + 0.3 * span, 1.08 * r, high - 0.3 * span, b, high),
        }
        inlet = [
            hex_end(self.dn, 0.0, first, t.style, self.corners),
            along("x", turned(shapes[self.form], n, bore=bore)),
        ]
        outlet = [hex_end(self.dn, last, length, t.style, self.corners)]
        if self.lock:
            outlet.append(along("x", hexagon(2.2 * b, low + 0.4 * span, low + 0.6 * span, bore)))
        if self.one:
            t.add("valve body", *inlet, *outlet)
            return t.model(length, "welded", "check valve")
        t.add("valve body", *inlet)
        t.add("valve body", *outlet)
        return t.model(length, "welded", "check valve", split=True)


LIDDED = families_of(BarrelLid, TwoHexagons)
