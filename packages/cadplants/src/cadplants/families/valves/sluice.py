"""Sluice and slide gates, and gate valves worked from a floor above."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.params import among, between, chance, nested, styled, weighted, whole
from cadplants.builder.table import Table, outline
from cadplants.families.valves.actuation import operator
from cadplants.families.valves.actuation_base import STEMS, put_stem
from cadplants.families.valves.actuation_hand import Handwheel, slab
from cadplants.families.valves.gate import Resilient
from cadplants.families.valves.valve import BIG, Valve
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, box, cylinder, hexagon, ring, turned
from cadplants.solids.transforms import spun

__all__ = ["SLUICES"]


class Slide(Valve, name="slide gate valve/frame", sizes=BIG):
    """A slide gate for bulk solids: a flat frame between round flanges, its blade drawn out to the side."""

    open: float = among((0.0, 0.5, 0.95), "how far it is open")
    stem: str = among(STEMS, "form of its stem")
    make: str = weighted("what draws its blade", wheel=0.4, cylinder=0.35, operator=0.25)
    wheel: Handwheel = nested(Handwheel, "handwheel", when=lambda p: p.make == "wheel")
    operator: Any = operator("bevel", "multi-turn", when=lambda p: p.make == "operator")

    def build(self, t: Table) -> Model:
        radius, half, bore, thick = self.radius, 0.5 * t.flange.outer, t.pipe.bore, 0.012
        length, n, reach = 0.06 + 0.1 * radius, t.style.round(half), 2.4 * half
        solids = [along("x", ring(bore, half, z, z + thick, n)) for z in (0.0, length - thick)]
        solids.append(along("x", ring(bore, radius * 1.06, 0.0, length, n)))
        x, wide, open_ = length / 2, length - 2 * thick, self.open * 1.9 * radius
        solids += [box((wide, 0.03, half + reach), (x, s * 0.96 * half, (reach - half) / 2)) for s in BOTH]
        solids += [box((wide, 2 * half, 0.02), (x, 0, z)) for z in (-half + 0.01, half + 0.02)]
        t.add("valve body", *solids)
        t = t.at(x)
        t.add("valve disc", box((0.008, 1.84 * half, 2 * radius + half), (0, 0, open_ + 0.5 * half)))
        t.add("yoke", box((wide + 0.01, 2 * half + 0.02, 0.03), (0, 0, reach)), of="steel")
        t.add("valve disc", box((0.03, 0.05, 0.06), (0, 0, open_ + half + radius)))
        slim, t = 0.008 + 0.05 * radius, t.at(0, 0, reach)
        put_stem(t, open_ + half + radius - reach, 0.12, slim, self.stem)
        if self.make == "wheel":
            self.wheel.build(t, 0.06 + 0.8 * radius, 0.03)
            t.add("gland", ring(slim, 2.5 * slim, 0.014, 0.032, 12))
        elif self.make == "cylinder":
            bore, long = 0.03 + 0.25 * radius, 2.2 * radius + 0.08
            head = rounded_rectangle(2.3 * bore, 2.3 * bore, 0.2 * bore, 2)
            can = [slab(head, z, z + 0.3 * bore) for z in (0.015, long)]
            can.append(around(cylinder(0.1 * bore, 0.0, long + 0.35 * bore, 8), 4, 1.35 * bore, np.pi / 4))
            can.append(cylinder(0.95 * bore, 0.02, long, t.style.round(bore)))
            port = hexagon(0.02, bore, 1.3 * bore)
            can += [along("y", port, 0, 0, z) for z in (0.12 * bore + 0.02, long + 0.1 * bore)]
            t.bundled("actuator").add("actuator", *can, of="clamp")
        else:
            self.operator.build(t.at(0, 0, 0.015))
        return t.model(round(length, 6), "wafer", "slide gate valve")


class Sluice(Valve, name="sluice gate/wall", sizes=(100,), place="floor"):
    """A sluice gate on a wall: a frame of channels round an opening, a ribbed door, a spindle up to a headstock."""

    wide: float = between(0.4, 0.9, "of the opening", "m")
    high: float = between(0.8, 1.4, "height of a rectangular opening / width")
    lift: float = between(0.2, 1.0, "how far its door is lifted / width")
    round: bool = chance(0.4, "its opening is round")
    ribs: int = whole(2, 5, "ribs across its door")
    slim: float = between(0.014, 0.022, "radius of its spindle", "m")
    stem: str = among(STEMS, "form of its spindle")
    wheeled: bool = chance(0.55, "a handwheel on a headstock")
    size: float = between(0.18, 0.32, "radius of the handwheel", "m", when=lambda p: p.wheeled)
    wheel: Handwheel = nested(Handwheel, "handwheel", when=lambda p: p.wheeled)
    operator: Any = operator("bevel", "bevel", "multi-turn", radius=lambda _: 0.12, when=lambda p: not p.wheeled)

    def build(self, t: Table) -> Model:
        wide, lift = self.wide, self.lift * self.wide
        bottom, head = (0.25 * wide, 1.25 * wide) if self.round else (0.2, 0.2 + wide * self.high)
        edge = np.array([(-wide / 2, bottom), (wide / 2, bottom), (wide / 2, head), (-wide / 2, head)])
        if self.round:
            edge = circle(0.5 * wide, 24, (0.0, 0.75 * wide))
        rim, tall, span = head + 0.3, 2 * head - bottom + 0.35, head - bottom
        rail, mid = (0.06, 0.06, tall - bottom + 0.1), (bottom + head) / 2 + lift
        frame = [box(rail, (0.03, s * 0.58 * wide, (tall + bottom - 0.1) / 2)) for s in BOTH]
        frame.append(box((0.05, 1.22 * wide, 0.06), (0.025, 0, bottom - 0.05)))
        t.add("valve body", *frame, box((0.08, 1.24 * wide, 0.08), (0.04, 0, tall)), of="steel")
        door = [box((0.012, 1.1 * wide, span + 0.06), (0.014, 0, mid))]
        levels = np.linspace(-0.4, 0.4, self.ribs) * span
        door += [box((0.04, 1.04 * wide, 0.012), (0.036, 0, float(mid + z))) for z in levels]
        door += [box((0.04, 0.012, 0.9 * span), (0.036, s * 0.3 * wide, mid)) for s in BOTH]
        t.add("valve disc", *door)
        wall = np.array([(-1.2 * wide, 0.0), (1.2 * wide, 0.0), (1.2 * wide, rim), (-1.2 * wide, rim)])
        # The outline's x is along y, its y up, the thickness along x.
        up = spun("z", np.pi / 2) @ spun("x", np.pi / 2)
        t.add("wall", moved(slab(wall, -0.25, 0.0, (edge,)), up))
        spindle = t.at(0.045)
        put_stem(spindle, mid + 0.4 * span, tall + 0.35 + lift, self.slim, self.stem)
        anchor, levels = hexagon(0.03, 0.06, 0.078), np.linspace(bottom, rim - 0.1, 5)
        t.add("bolt", *(along("x", anchor, 0, s * 0.58 * wide, float(z)) for s in BOTH for z in levels))
        if self.wheeled:
            stand, spindle = outline(0.13, 0, 0.13, 0.02, 0.06, 0.06, 0.05, 0.2), spindle.at(0, 0, tall + 0.04)
            spindle.add("yoke", turned([*stand, (0.08, 0.25), (0.08, 0.28)], 20))
            self.wheel.build(spindle, self.size, 0.28)
        else:
            # On a foot, so that the wheel on its side clears the frame's head.
            spindle.at(0, 0, tall + 0.04).add("yoke", cylinder(0.09, 0.0, 0.14, 20))
            self.operator.build(spindle.at(0, 0, tall + 0.18))
        return t.model(kind="sluice gate")


class Pedestal(Valve, name="gate valve/pedestal", sizes=BIG, weight=0.7):
    """A gate valve whose spindle goes up by an extension to a pedestal on the floor above (EN 1074 fittings)."""

    hollow: bool = styled(True, "whether insides are modelled")
    valve: Resilient = nested(
        Resilient,
        "valve below the floor",
        fixed=lambda p: {"dn": p.dn, "hollow": p.hollow, "spindle.make": "cap"},
    )
    reach: float = between(0.35, 0.8, "from the valve to the floor", "m")
    half: float = between(0.08, 0.13, "size of the pedestal's head", "m")
    tall: float = between(0.5, 0.8, "height of the pedestal", "m")
    straight: bool = chance(0.4, "the pedestal is straight, not waisted")
    wheeled: bool = chance(0.7, "a handwheel, not a gear or an actuator")
    wheel: Handwheel = nested(Handwheel, "handwheel", when=lambda p: p.wheeled)
    operator: Any = operator("bevel", "multi-turn", radius=lambda _: 0.08, when=lambda p: not p.wheeled)

    def build(self, t: Table) -> Model:
        below = self.valve.build(replace(t, parts=[]))
        t.extend(below.parts)
        heads = [p for p in below.parts if p.name in ("valve bonnet", "gland", "valve stem")]
        top = max(float(p.solid.vertices[:, 2].max()) for p in heads)
        reach, slim, half, tall = self.reach, 0.012, self.half, self.tall
        t = t.at(below.length / 2, 0, top)
        joint = cylinder(2.2 * slim, -0.03, 0.06, 12)
        t.add("valve stem", joint, cylinder(1.3 * slim, 0.05, reach + 0.05, 12))
        t.add("plate", box((6 * half, 6 * half, 0.012), (0, 0, reach - 0.006)))
        t = t.at(0, 0, reach)
        column = outline(1.5 * half, 0, 1.5 * half, 0.018, 0.8 * half, 0.05, 0.55 * half, 0.9 * tall)
        column += outline(0.8 * half, 0.95 * tall, 0.8 * half, tall)
        if self.straight:
            column = outline(1.4 * half, 0, 1.4 * half, 0.015, 0.7 * half, 0.015, 0.7 * half, tall)
        t.add("yoke", turned(column, t.style.round(half)))
        t.add("position indicator", box((0.006, 0.3 * half, 0.5 * tall), (0.72 * half, 0, 0.5 * tall)))
        t.add("bolt", around(hexagon(0.026, 0.013, 0.034), 4, 1.2 * half, np.pi / 4))
        if self.wheeled:
            put_stem(t, tall - 0.02, tall + 0.1, slim)
            self.wheel.build(t, 0.11 + 0.8 * self.radius, tall + 0.01)
        else:
            self.operator.build(t.at(0, 0, tall))
        return t.model(below.length, kind="gate valve")


SLUICES = families_of(Pedestal, Slide, Sluice)
