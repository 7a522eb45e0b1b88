"""What turns a valve: handwheels, levers and yokes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.parts.valve_body import Piece
from cadplants.solids.mesh_ops import Solid, about_x, extrude, loft, merge, moved, revolve, shared, stack, sweep, weld
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = [
    "Topworks",
    "actuator_solids",
    "handwheel",
    "lever_solid",
    "plate_wheel",
    "solid_wheel",
    "topworks",
    "yoke_solid",
]


@shared
def handwheel(radius: float, rim: float, spokes: int, hub: float, thick: float, bore: float, sides: int) -> Solid:
    """A handwheel about z with a round rim and straight spokes, its hub from 0 to ``thick`` [m]."""
    angles = np.arange(12) * 2 * np.pi / 12
    middle = thick / 2
    profile = np.column_stack([radius - rim + rim * np.cos(angles), middle + rim * np.sin(angles)])
    solids = [weld([revolve(profile, sides, closed=True)])]
    solids.append(weld([revolve([(bore, 0), (hub, 0), (hub, thick), (bore, thick)], 24, closed=True)]))
    for k in range(spokes):
        angle = 2 * np.pi * k / spokes
        way = np.array([np.cos(angle), np.sin(angle), 0.0])
        lift = np.array([0.0, 0.0, middle])
        path = np.array([way * (hub - 0.002) + lift, way * (radius - 2 * rim + 0.15 * rim) + lift])
        solids.append(sweep(path, 0.62 * rim * circle(1.0, 8)))
    return merge(solids)


@shared
def plate_wheel(radius: float, spokes: int, hub: float, thick: float, bore: float, sides: int) -> Solid:
    """A pressed wheel about z: a flat disc with windows between its spokes, its hub from 0 to ``thick`` [m]."""
    rim, boss = 0.84 * radius, 1.5 * hub
    windows = []
    for k in range(spokes):
        low, high = 2 * np.pi * k / spokes, 2 * np.pi * (k + 1) / spokes
        outer, inner = np.arcsin(0.07 * radius / rim), np.arcsin(min(0.9, 0.07 * radius / boss))
        far = np.linspace(low + outer, high - outer, 9)
        near = np.linspace(high - inner, low + inner, 5)
        arc_far = rim * np.column_stack([np.cos(far), np.sin(far)])
        arc_near = boss * np.column_stack([np.cos(near), np.sin(near)])
        windows.append(np.concatenate([arc_far, arc_near]))
    sheet = 0.006
    low, high = 0.5 * thick - sheet / 2, 0.5 * thick + sheet / 2
    ring = circle(hub, 24)
    disc = extrude(circle(radius, sides), low, high, (ring, *windows))
    sleeve = extrude(ring, 0.0, thick, (circle(bore, 16),))
    return merge([disc, sleeve])


@shared
def solid_wheel(radius: float, hub: float, thick: float, bore: float, sides: int) -> Solid:
    """A dished disc with a rolled edge about z, its hub from 0 to ``thick`` [m]."""
    sheet, lift = 0.005, 0.10 * radius
    top = [(bore, thick), (hub, thick), (1.25 * hub, 0.5 * thick + sheet), (0.55 * radius, 0.5 * thick + sheet)]
    top += [(0.86 * radius, lift + thick), (0.95 * radius, lift + thick + sheet), (radius, lift + thick)]
    low = [
        (radius, lift + thick - 2 * sheet),
        (0.95 * radius, lift + thick - 2.4 * sheet),
        (0.88 * radius, lift + thick - sheet),
    ]
    low += [(0.55 * radius, 0.5 * thick), (1.2 * hub, 0.5 * thick), (hub, 0.0), (bore, 0.0)]
    return weld([revolve([*low[::-1], *top[::-1]], sides, closed=True)])


def lever_solid(length: float, half: float, thick: float, straight: bool = False) -> Solid:
    """A flat lever along x with a round eye about the origin and a round tip; its underside at 0.

    Args:
        length: from the eye's middle [m].
        half: half its width [m].
        thick: of the bar [m].
        straight: whether it stays level instead of stepping up.
    """
    rise = 0.0 if straight else 0.16 * length
    stations = [(-half * np.cos(a), half * max(np.sin(a), 0.15), 0.0) for a in np.linspace(0, np.pi / 2, 5)]
    stations += [
        (0.12 * length, half * 0.9, 0.0),
        (0.30 * length, half * 0.72, rise),
        (0.45 * length, half * 0.72, rise),
    ]
    stations += [(length - half * 0.8, half * 0.8, rise)]
    stations += [
        (length - half * 0.8 * (1 - np.sin(a)), half * 0.8 * max(np.cos(a), 0.15), rise)
        for a in np.linspace(0.4, np.pi / 2, 4)
    ]
    loops = [np.array([[x, w, z], [x, w, z + thick], [x, -w, z + thick], [x, -w, z]]) for x, w, z in stations]
    ends = [loop.mean(axis=0, keepdims=True) for loop in (loops[0], loops[-1])]
    return weld([loft([ends[0], *loops, ends[1]])])


def yoke_solid(spread: float, foot: float, top: float, crown: float, bush: float, bore: float, sides: int) -> Solid:
    """Two arms from a bonnet at ``foot`` up to a bush about the stem."""
    sleeve = extrude(circle(bush, 24), top - crown, top, (circle(bore, sides),))
    solids = [sleeve]
    wide, thin = 0.42 * bush + 0.004, 0.22 * bush + 0.002
    section = np.array([[wide, -thin], [wide, thin], [-wide, thin], [-wide, -thin]])
    for sign in (1, -1):
        shoulder = top - crown / 2
        path = np.array(
            [
                [0, sign * (spread - thin), foot],
                [0, sign * (spread - thin), foot + 0.45 * (shoulder - foot)],
                [0, sign * (0.45 * spread + 0.55 * bush), shoulder - 0.10 * (shoulder - foot)],
                [0, sign * (bush * 0.85), shoulder],
            ]
        )
        solids.append(sweep(path, section, up=(1.0, 0.0, 0.0)))
    return merge(solids)


@dataclass(frozen=True)
class Topworks:
    """What stands on the flange of a valve body, about the stem's axis.

    Args:
        bonnet: with its packing box.
        gland: the hexagon that holds the packing.
        yoke: arms and bush.
        stem: through bush and wheel.
        wheel: about its hub's underside.
        wheel_low: height of that underside [m].
    """

    bonnet: Solid
    gland: Solid
    yoke: Solid
    stem: Solid
    wheel: Solid
    wheel_low: float

    contacts = ((0, 1), (1, 2), (1, 3), (1, 4), (2, 4), (3, 4), (4, 5))  # with the body as the first piece

    def pieces(self, stand: Floats, turn: float) -> list[Piece]:
        """Bonnet, gland, yoke, stem and wheel, the wheel turned [rad]."""
        return [
            (self.bonnet, stand, "valve bonnet", "valve"),
            (self.gland, stand, "gland", "trim"),
            (self.yoke, stand, "yoke", "valve"),
            (self.stem, stand, "valve stem", "trim"),
            (self.wheel, stand @ at(0, 0, self.wheel_low) @ spun("z", turn), "handwheel", "handle"),
        ]


def topworks(
    seat: float,
    collar: float,
    plate: float,
    radius: float,
    style: ModelingStyle,
    spokes: int,
    wheel: float,
    rise: float = 0.008,
    tall: float = 1.0,
    design: str = "round",
) -> Topworks:
    """A bolted bonnet with outside screw and yoke.

    Args:
        seat: height of the body's flange [m].
        collar: its radius [m].
        plate: thickness of the bonnet's flange [m].
        radius: of the pipe, which everything is scaled by [m].
        style: that models it.
        spokes: of the handwheel.
        wheel: its radius [m].
        rise: how far the stem stands out of the wheel [m].
        tall: stretches the yoke.
        design: of the wheel: ``round``, ``plate`` or ``solid``.
    """
    stem_radius = 0.005 + 0.10 * radius
    box_radius, box_top = 2.1 * stem_radius, seat + plate + 0.55 * radius + 0.016
    shape = [(0, seat), (collar, seat), (collar, seat + plate), (0.62 * collar, seat + plate)]
    shape += [(box_radius, seat + plate + 0.3 * radius), (box_radius, box_top), (stem_radius, box_top), (0, box_top)]
    bonnet = weld([revolve(shape, style.round(collar))])
    sides = max(12, min(style.round(stem_radius), 16))
    gland_top = box_top + 0.010
    bush, crown = 1.9 * stem_radius, 0.016 + 0.05 * radius
    between = 0.80 * collar - 2 * (0.22 * bush + 0.002) - 0.001
    gland = extrude(
        circle(min(stem_radius * 2.5, between / np.cos(np.pi / 6)), 6),
        box_top,
        gland_top,
        (circle(stem_radius, sides),),
    )
    yoke_top = gland_top + (0.035 + 0.55 * radius) * tall
    yoke = yoke_solid(0.80 * collar, seat + plate, yoke_top, crown, bush, stem_radius, sides)
    low, thick = yoke_top + 0.012, 0.014 + 0.08 * radius
    stem = extrude(circle(stem_radius, sides), box_top, low + thick + rise)
    hub, rim_sides = 2.2 * stem_radius, style.round(wheel)
    if design == "plate":
        disc = plate_wheel(wheel, spokes, hub, thick, stem_radius, rim_sides)
    elif design == "solid":
        disc = solid_wheel(wheel, hub, thick, stem_radius, rim_sides)
    else:
        disc = handwheel(wheel, 0.006 + 0.03 * wheel, spokes, hub, thick, stem_radius, rim_sides)
    return Topworks(bonnet, gland, yoke, stem, disc, low)


@shared
def actuator_solids(radius: float) -> tuple[Solid, Solid]:
    """A rack-and-pinion actuator (ISO 5211 mounting) sized by the pipe's radius: body along x on z = 0, indicator."""
    half, reach = 0.028 + 0.45 * radius, 0.085 + 1.5 * radius
    body = extrude(rounded_rectangle(1.7 * half, 2 * half, 0.35 * half, 4), -reach, reach)
    caps = [
        extrude(rounded_rectangle(1.6 * half, 1.9 * half, 0.4 * half, 4), a, b)
        for a, b in ((-reach - 0.018, -reach), (reach, reach + 0.018))
    ]
    # The section's x becomes z: the block lies along x with its underside at the foot.
    block = moved(about_x(merge([body, *caps])), at(0, 0, half))
    knob = stack([(0.0, 0.008, circle(0.016, 16)), (0.008, 0.022, circle(0.011, 16))])
    return block, moved(knob, at(0, 0, 2 * half))
