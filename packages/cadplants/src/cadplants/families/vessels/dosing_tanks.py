"""Dosing tanks: drums of plastic with a lid, at times with a dosing pump, a stirrer or a tray."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, whole
from cadplants.builder.table import Table, outline
from cadplants.families.machines.plain_parts import Faceted, PlainPort, port_of
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, extrude, moved, revolve, weld
from cadplants.solids.polygon import rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, hexagon, rod, turned
from cadplants.solids.transforms import at

__all__ = ["DOSING_TANKS"]


class Dosing(
    Faceted,
    place="floor",
    group="Tank",
    label="tank",
    bundle="shell",
    name="tank/dosing",
    sizes=(15, 20, 25, 32),
    weight=1.5,
):
    """A dosing tank: a plastic drum, round or square, with a screwed lid, a mouth at its foot, a pump on it."""

    radius: float = between(0.18, 0.6, "radius", "m")
    slender: float = between(1.4, 3.2, "height / radius")
    form: str = among(("drum", "drum", "tapered", "barrel", "square"), "form of the drum")
    shoulder: float = among((0.0, 0.0, 0.15, 0.3), "height of its shoulder / radius")
    ribs: int = whole(0, 3, "ribs round it", when=lambda p: p.form in ("drum", "square"))
    lid: float = between(0.2, 0.5, "radius of the screw lid / of the drum")
    cover: bool = chance(0.4, "a flat cover all over it")
    aside: bool = chance(0.5, "the lid is off the middle")
    gripped: bool = chance(0.5, "grips round the lid")
    mouth: PlainPort = port_of(lambda p: p.dn, "mouth")
    level: float = between(0.06, 0.25, "height of the mouth / of the drum")
    on_top: str = among(("none", "pump", "pump", "stirrer"), "what stands on it")
    scale: bool = chance(0.3, "a gauge of its level along it")
    stand: str = among(("floor", "floor", "plinth", "legs", "tray"), "what it stands on")

    def build(self, t: Table) -> Model:
        r, tall = self.radius, self.radius * self.slender
        n, low = self.n(t, r), {"plinth": 0.12, "legs": 0.4, "tray": 0.02}.get(self.stand, 0.0)
        top = low + tall
        walls, head = self._walls(r, tall, n)
        z = low + max(self.level * tall, 0.55 * t.flange.outer + 0.01)
        wide = self._wide(z - low, r, tall)
        face = wide + 0.09
        mouth, port = self.mouth.build(t, (face, 0, z), (1, 0, 0), 0.09 + 0.15 * r, self.n(t, t.pipe.radius))
        t.add("shell", *(moved(one, at(0, 0, low)) for one in walls), mouth, of="dial")
        lift = top + self.shoulder * r * head
        if self.cover:
            lid = rounded_rectangle(2.1 * r, 2.1 * r, 0.1 * r, 2)
            square = self.form == "square"
            cover = extrude(lid, -0.01, 0.03) if square else cylinder(1.04 * self._wide(tall, r, tall), -0.01, 0.03, n)
            t.at(0, 0, lift).bundled("tank").add("tank", cover, own=True)
            lift += 0.028
        self._lid(
            t.at(0.42 * r if self.aside or self.on_top != "none" else 0.0, 0, lift),
            self.lid * r * (0.75 if head < 1 or self.on_top != "none" else 1),
        )
        self._on_top(t.at(-0.35 * r, 0, lift), r, tall)
        if self.scale:
            t.add(
                "level gauge",
                rod((0, -r - 0.03, low + 0.1 * tall), (0, -r - 0.03, low + 0.9 * tall), 0.01, 8),
                own=True,
            )
            arms = [rod((0, -0.8 * r, low + f * tall), (0, -r - 0.03, low + f * tall), 0.008, 6) for f in (0.12, 0.88)]
            t.add("level gauge", *arms, own=True)
        self._stand(t, r, low, n)
        return t.model(kind="dosing tank", ports=(port,))

    def _wide(self, z: float, r: float, tall: float) -> float:
        """Radius at a height over the foot [m]."""
        if self.form == "tapered":
            return r * (0.82 + 0.18 * z / tall)
        if self.form == "barrel":
            return r * (0.86 + 0.14 * min(1.0, 4 * min(z, tall - z) / tall))
        return r

    def _walls(self, r: float, tall: float, n: int) -> tuple[list[Solid], float]:
        """The drum on z = 0, and whether it has its shoulder."""
        levels = np.linspace(0.1, 0.9, self.ribs + 2)[1:-1] * tall
        if self.form == "square":
            sheet = rounded_rectangle(2 * r, 2 * r, 0.25 * r, 3)
            ribs = [extrude(1.03 * sheet, float(z) - 0.03, float(z) + 0.03) for z in levels]
            return [extrude(sheet, 0, tall), *ribs], 0.0
        heights = (0.0, 0.25 * tall, 0.75 * tall, tall)
        wall = [(self._wide(z, r, tall), z) for z in heights]
        if self.shoulder:
            high = self.shoulder * r
            wall += [(0.85 * wall[-1][0], tall + 0.7 * high), (0.6 * wall[-1][0], tall + high)]
        ribs = [cylinder(1.03 * r, float(z) - 0.02, float(z) + 0.02, n) for z in levels]
        return [turned(wall, n), *ribs], 1.0

    def _lid(self, t: Table, r: float) -> None:
        n = self.n(t, r)
        grips = [around(box((0.1 * r, 0.08 * r, 0.05), (r, 0, 0.03)), 8)] if self.gripped else []
        t.bundled("manway").add("manway", cylinder(r, -0.02, 0.055, n), *grips, of="rubber", own=True)

    def _on_top(self, t: Table, r: float, tall: float) -> None:
        """A dosing pump or a stirrer on the drum."""
        s = 0.22 * r + 0.03
        if self.on_top == "pump":
            case = box((1.2 * s, s, 1.1 * s), (0, 0, 0.55 * s - 0.005))
            head = along("y", cylinder(0.4 * s, 0.45 * s, 0.85 * s, self.n(t, s)), 0, 0, 0.5 * s)
            valves = [moved(hexagon(0.22 * s, *ends), at(0, 0.7 * s)) for ends in ((0.0, 0.2 * s), (0.8 * s, 1.1 * s))]
            t.add("pump", case, head, *valves, own=False)
            hose = [rod((0, 0.7 * s, -0.02), (0, 0.7 * s, 0.05 * s), 0.006, 6)]
            t.add("hose", *hose, own=False)
        elif self.on_top == "stirrer":
            n, m = self.n(t, 0.5 * s), 0.45 * s
            t.add("motor", cylinder(m, 0.3 * s, 1.9 * s, n), own=False)
            t.add("motor", cylinder(1.3 * m, -0.005, 0.32 * s, n), own=False)
            t.add("shaft", cylinder(0.15 * m, -0.7 * tall, 0.1 * s, 8), own=False)

    def _stand(self, t: Table, r: float, low: float, n: int) -> None:
        if self.stand == "plinth":
            t.add("foundation", box((2.4 * r, 2.4 * r, low), (0, 0, low / 2)))
        elif self.stand == "legs":
            sides = [
                box((0.05, 0.05, low - 0.03), (x * 0.75 * r, y * 0.75 * r, (low - 0.03) / 2))
                for x in BOTH
                for y in BOTH
            ]
            t.bundled("tank leg").add("tank leg", *sides, box((2 * r, 2 * r, 0.03), (0, 0, low - 0.015)), own=True)
        elif self.stand == "tray":
            inner, wide, high = 1.35 * r, 1.4 * r, 0.35 * r
            edge = outline(0, 0, wide, 0, wide, high, inner, high, inner, 0.02, 0, 0.02)
            t.bundled("tank").add("tank", weld([revolve(edge, n)]), own=True, of="dial")


DOSING_TANKS = families_of(Dosing)
