"""Boilers of plain shapes: cabinets and lying drums with a burner, doors and a flue."""

from __future__ import annotations

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, whole
from cadplants.builder.table import Table, outline
from cadplants.families.machines.plain_parts import Faceted, PlainPort, built_ports, port_of
from cadplants.model.family import Model, Port
from cadplants.solids.mesh_ops import Solid, extrude, moved
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, box, cylinder, dome, rod, turned
from cadplants.solids.transforms import at

__all__ = ["PLAIN_BOILERS"]

_NAME = "boiler"


class _Boiler(Faceted, place="floor", group="Equipment", label=_NAME, bundle=_NAME, sizes=(20, 25, 32, 40, 50, 65, 80)):
    """A boiler of plain shapes, its front towards -x."""

    flow: PlainPort = port_of(lambda p: p.dn, "flow")
    back: PlainPort = port_of(lambda p: p.dn, "return")
    burner: str = among(("box", "drum", "box and drum", "gun", "none"), "form of the burner")
    fire: float = between(0.12, 0.28, "half the size of the burner / height")
    flue: float = between(0.05, 0.14, "radius of the flue / height")
    stack: float = between(0.15, 1.2, "height of the flue over it", "m")
    turned_: bool = chance(0.3, "the flue leaves behind and turns up")

    def put_burner(self, t: Table, s: float) -> None:
        """Puts the burner down before the origin, towards -x; ``s``: half its size [m]."""
        n, t = self.n(t, s), t.bundled("burner")
        boxed = box((1.3 * s, 1.6 * s, 1.6 * s), (-0.65 * s - 0.02, 0, 0))
        scroll = along("y", cylinder(s, -0.5 * s, 0.5 * s, n), -1.0 * s, 0, 0)
        forms: dict[str, list[Solid]] = {
            "none": [],
            "box": [boxed],
            "drum": [along("-x", cylinder(0.9 * s, 0, 1.4 * s, n))],
            "box and drum": [boxed, scroll],
            "gun": [
                along("-x", cylinder(0.45 * s, 0, 1.2 * s, n)),
                along("-x", cylinder(0.9 * s, 0.8 * s, 1.8 * s, n)),
            ],
        }
        solids = forms[self.burner]
        plate = [along("-x", cylinder(1.15 * s, -0.01, 0.025, n))] if solids else []
        t.add("burner", *plate, *solids, own=True)
        if self.burner == "box and drum":
            motor = along("y", cylinder(0.4 * s, 0.45 * s, 1.3 * s, n), -1.0 * s, 0, 0)
            t.add("motor", motor, own=True)

    def put_flue(self, t: Table, x: float, top: float, high: float) -> None:
        """Puts the flue down: on top at a place along x, or behind at the end ``x`` and up [m]."""
        r = self.flue * high
        n = self.n(t, r)
        if self.turned_:
            z, out = 0.75 * top, x + 2.2 * r
            solids = [rod((x - 0.02, 0, z), (out + 0.7 * r, 0, z), r, n)]
            solids.append(moved(cylinder(r, z, top + self.stack, n), at(out)))
        else:
            solids = [moved(cylinder(r, top - 0.2 * high, top + self.stack, n), at(x - 3.0 * r))]
        t.add(_NAME, *solids, of="clamp")

    def put_body(
        self, t: Table, body: list[Solid], spots: tuple[tuple[float, float, float], ...], dip: float
    ) -> list[Port]:
        """Puts the body down with two mouths up at places; their ports."""
        mouths, ports = built_ports(t, (self.flow, self.back), spots, (0, 0, 1), dip, self.n(t, t.pipe.radius))
        t.add(_NAME, *body, *mouths, of="tank")
        return ports


class _Cabinet(_Boiler):
    """A floor-standing boiler in a cabinet."""

    wide: float = between(0.4, 1.1, "width", "m")
    deep: float = between(0.5, 1.6, "depth", "m")
    tall: float = between(0.7, 1.9, "height", "m")
    corner: float = among((0.0, 0.0, 0.03, 0.08), "radius of its corners", "m")
    plinth: float = among((0.0, 0.05, 0.1), "height of its plinth", "m")
    doors: int = whole(0, 2, "doors in front, one above the other")
    panel: str = among(("strip", "hood", "none"), "where its controls are")

    def build(self, t: Table) -> Model:
        w, d, h, low = self.wide, self.deep, self.tall, self.plinth
        top, dip = low + h, 0.12
        case = extrude(rounded_rectangle(d, w, self.corner, 3), low, top)
        y = max(0.25 * w, 0.52 * t.flange.outer)
        ports = self.put_body(t, [case], ((0.1 * d, -y, top + dip), (0.1 * d, y, top + dip)), 1.3 * dip)
        if low:
            t.add(_NAME, box((0.94 * d, 0.94 * w, low), (0, 0, low / 2)), of="rubber")
        front = t.at(-d / 2, 0, low)
        for k in range(self.doors):
            z, tall = (0.3 + 0.4 * k) * h, 0.34 * h
            front.add(_NAME, box((0.025, 0.86 * w, tall), (-0.008, 0, z)), of="electrical")
            front.add(_NAME, box((0.03, 0.02, 0.1), (-0.03, 0.36 * w, z)), of="rubber")
        if self.panel == "strip":
            front.add("control panel", box((0.03, 0.8 * w, 0.1 * h), (-0.01, 0, 0.94 * h)), own=True)
        elif self.panel == "hood":
            t.add("control panel", box((0.25 * d, 0.7 * w, 0.12), (-0.35 * d, 0, top + 0.058)), own=True)
        self.put_burner(front.at(-0.015, 0, 0.35 * h), min(self.fire * h, 0.4 * w))
        self.put_flue(t, d / 2, top, h)
        return t.model(kind="boiler", ports=ports)


class Cabinet(_Cabinet, name="boiler/plain cabinet", weight=1.2):
    """A boiler in a cabinet of plain shapes, as finely as the style has equipment."""


class CabinetInPieces(_Cabinet, name="boiler/cabinet in pieces", weight=1.2, grain="fitting"):
    """A boiler in a cabinet of plain shapes, each a piece of its own."""


class _Drum(_Boiler):
    """A lying shell boiler."""

    radius: float = between(0.3, 1.0, "of the drum", "m")
    slender: float = between(2.0, 4.2, "length of the drum / its radius")
    low: float = between(0.1, 0.4, "from the floor to the drum", "m")
    front: str = among(("door", "flat", "dish", "box"), "its front end")
    rear: str = among(("box", "dish", "flat"), "its rear end")
    bands: int = whole(0, 3, "bands round it")
    doors: int = whole(0, 2, "hatches in its front")
    stands: str = among(("saddles", "beams", "block", "legs"), "what it stands on")
    panel: bool = chance(0.5, "a panel at its side")

    def build(self, t: Table) -> Model:
        r, n = self.radius, self.n(t, self.radius)
        half, axis = r * self.slender / 2, r + self.low
        top, dip = axis + r, 0.12
        body = [cylinder(r, -half, half, n)]
        for k in range(self.bands):
            x = (k + 1) / (self.bands + 1) * 2 * half - half
            body.append(cylinder(1.015 * r + 0.004, x - 0.03, x + 0.03, n))
        solids = [along("x", one, 0, 0, axis) for one in body]
        spots = ((-0.3 * half, 0.0, top + dip), (0.3 * half, 0.0, top + dip))
        ports = self.put_body(t, solids, spots, dip + 0.15 * r)
        out = self._end(t.at(-half, 0, axis).along("-x"), self.front, r, n)
        self._end(t.at(half, 0, axis).along("x"), self.rear, r, n)
        face = t.at(-half - out, 0, axis)
        for k in range(self.doors):
            y = 0.5 * r * (2 * k - 1)
            face.add(_NAME, along("-x", cylinder(0.22 * r, -0.01, 0.03, n), 0, y, 0.45 * r), of="electrical")
        self.put_burner(face.at(0, 0, -0.25 * r), min(2.0 * self.fire * r, 0.55 * r))
        self.put_flue(t, half + (0.25 * r if self.rear != "flat" else 0.0), top, 1.5 * r)
        self._stand(t, r, half, axis)
        if self.panel:
            t.add("control panel", box((0.4, 0.16, 0.5), (-0.4 * half, -r - 0.07, axis)), own=True)
        return t.model(kind="boiler", ports=ports)

    def _end(self, t: Table, form: str, r: float, n: int) -> float:
        """An end on z = 0; how far it stands out [m]."""
        if form == "dish":
            t.add(_NAME, dome(r, 0.3 * r, -0.001, n), of="tank")
            return 0.27 * r
        if form == "flat":
            t.add(_NAME, cylinder(1.05 * r, -0.02, 0.03, n), of="electrical")
            return 0.03
        if form == "door":
            t.add(_NAME, turned(outline(0.95 * r, -0.002, 0.95 * r, 0.2 * r, 0.85 * r, 0.25 * r), n), of="electrical")
            return 0.25 * r
        t.add(_NAME, box((1.6 * r, 1.6 * r, 0.35 * r), (0, 0, 0.174 * r)), of="electrical")
        return 0.35 * r

    def _stand(self, t: Table, r: float, half: float, axis: float) -> None:
        tall = axis - 0.75 * r
        if self.stands == "block":
            t.add("foundation", box((1.8 * half, 1.3 * r, tall), (0, 0, tall / 2)))
            return
        if self.stands == "beams":
            tall = axis - 0.83 * r
            beams = [box((2 * half, 0.12 * r, tall), (0, s * 0.5 * r, tall / 2)) for s in BOTH]
            t.add("skid frame", *beams, *(box((0.1, r, 0.06), (s * 0.8 * half, 0, 0.03)) for s in BOTH))
        elif self.stands == "saddles":
            saddles = [box((0.1 + 0.1 * r, 1.4 * r, tall), (s * 0.6 * half, 0, tall / 2)) for s in BOTH]
            t.bundled("saddle").add("saddle", *saddles, own=True)
        else:
            spots = [(x * 0.75 * half, y * 0.6 * r) for x in BOTH for y in BOTH]
            legs = [box((0.08, 0.08, tall), (x, y, tall / 2)) for x, y in spots]
            t.bundled("tank leg").add("tank leg", *legs, own=True)


class Drum(_Drum, name="boiler/plain drum", weight=1.0):
    """A lying shell boiler of plain shapes, as finely as the style has equipment."""


class DrumInPieces(_Drum, name="boiler/drum in pieces", weight=1.2, grain="fitting"):
    """A lying shell boiler of plain shapes, each a piece of its own."""


PLAIN_BOILERS = families_of(Cabinet, CabinetInPieces, Drum, DrumInPieces)
