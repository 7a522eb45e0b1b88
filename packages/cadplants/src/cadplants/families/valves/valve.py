"""Flanged and wafer valves beyond those of the presets; along x from 0, stem towards +z."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadplants.families.valves.drive import BODY, diaphragm_head, drive, stem, wheel
from cadplants.family import Build, Family, Model, Part
from cadplants.flange import face_shell, nut_room, plate_thickness
from cadplants.mesh_ops import Solid, about_x, extrude, merge, moved, revolve, weld
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, around, ball, box, cylinder, dome, hexagon, ring, rod, turned
from cadplants.standards import FACE_TO_FACE, FLANGES, PIPES, SIZES
from cadplants.transforms import at, spun
from cadplants.valve_body import bore_of, flipped

__all__ = ["VALVE_FAMILIES", "bolt_circle", "disc_flange", "flanged_body", "valve_family"]

Middle = Sequence[tuple[float, float]]


def flanged_body(dn: int, style: ModelingStyle, length: float, middle: Middle, throat: Middle = ()) -> Solid:
    """A body of revolution along x with a flange at each end.

    Args:
        dn: nominal size.
        style: decides on bore and bolt holes.
        length: face to face [m].
        middle: radius and place of what lies between the flanges' backs [m]; ends get the flanges' thickness added.
        throat: radius and place of what the bore narrows to between the faces [m].
    """
    size, thick, bore = FLANGES[dn], plate_thickness(dn), bore_of(dn, style)
    sides, neck = style.round(size.outer / 2), 0.485 * size.hub
    head = face_shell(dn, sides, neck, bore, style.holes)
    outside = [(neck, thick), *middle, (neck, length - thick)]
    shells = [head, flipped(head, length), revolve(outside, sides)]
    if bore:
        shells.append(revolve([(bore, length), *reversed(throat), (bore, 0.0)], sides))
    return about_x(weld(shells))


def disc_flange(dn: int, style: ModelingStyle, reach: float, bore: float = 0.0) -> Solid:
    """A flange about z with its face at 0 looking down, on a neck up to ``reach``; bored through if asked for [m]."""
    size, thick = FLANGES[dn], plate_thickness(dn)
    sides, neck = style.round(size.outer / 2), 0.485 * size.hub
    head = face_shell(dn, sides, neck, bore, style.holes)
    inside = [(bore, reach), (bore, 0.0)] if bore else [(0.0, reach)]
    return weld([head, revolve([(neck, thick), (neck, reach), *inside], sides)])


def bolt_circle(count: int, radius: float, thread: float, low: float, high: float) -> Solid:
    """Hexagon bolts about z through what lies between two heights, as one mesh [m]."""
    head = 0.65 * thread
    one = merge(
        [
            cylinder(thread / 2, low, high, 8),
            hexagon(1.6 * thread, high, high + head),
            hexagon(1.6 * thread, low - head, low),
        ]
    )
    return around(one, count, radius, np.pi / count)


def _swelling(dn: int, length: float, bulge: float, kind: int) -> Middle:
    """A body between its flanges: round, barrel, tapered or with sharp shoulders."""
    low = plate_thickness(dn) + min(0.7 * nut_room(dn), 0.12 * length)
    reach, neck = length / 2 - low, 0.485 * FLANGES[dn].hub
    if kind == 0:
        shares = np.linspace(-1, 1, 11)
        return [(neck + (bulge - neck) * float(np.sqrt(max(0.0, 1 - s * s))), length / 2 + s * reach) for s in shares]
    if kind == 1:
        return [(neck, low), (bulge, low + 0.3 * reach), (bulge, length - low - 0.3 * reach), (neck, length - low)]
    if kind == 2:
        return [(neck, low), (bulge, length / 2 - 0.1 * reach), (bulge, length / 2 + 0.1 * reach), (neck, length - low)]
    return [(neck, low), (bulge, low), (bulge, length - low), (neck, length - low)]


def _body(
    dn: int, style: ModelingStyle, rng: np.random.Generator, length: float, swell: float = 1.4
) -> tuple[Part, float]:
    """A swollen flanged body and the radius of its swelling [m]."""
    bulge = float(rng.uniform(0.92, 1.1)) * (swell * PIPES[dn].radius + 0.007)
    bulge = max(bulge, 0.5 * FLANGES[dn].hub)
    middle = _swelling(dn, length, bulge, int(rng.integers(4)))
    return Part(flanged_body(dn, style, length, middle), BODY, "valve", BODY), bulge


def _bonnet(
    x: float, low: float, seat: float, throat: float, collar: float, plate: float, style: ModelingStyle
) -> list[Part]:
    """A neck out of the body with a flange, the bonnet's flange on it, and its bolts."""
    n = style.round(collar)
    neck = turned([(throat, low), (throat, seat - plate), (collar, seat - plate), (collar, seat)], n)
    lid = cylinder(collar, seat, seat + plate, n)
    bolts = bolt_circle(
        max(4, 2 * int(collar / 0.03)), 0.86 * collar, max(0.006, 0.12 * collar), seat - plate, seat + plate
    )
    pose = at(x)
    return [
        Part(moved(neck, pose), BODY, "valve", BODY),
        Part(moved(lid, pose), "valve bonnet", "valve", BODY),
        Part(moved(bolts, pose), "bolt", "fastener", BODY, "Connection assembly", True),
    ]


def _length(dn: int, kind: str) -> float:
    return FACE_TO_FACE[kind][dn]


def _control(dn: int, style: ModelingStyle, rng: np.random.Generator, head: str) -> Model:
    length, radius = _length(dn, "globe"), PIPES[dn].radius
    body, bulge = _body(dn, style, rng, length, 1.5)
    collar, plate = 0.9 * bulge + 0.01, 0.010 + 0.08 * radius
    seat = max(bulge + 0.6 * radius, 0.5 * FLANGES[dn].outer + plate)
    parts = [body, *_bonnet(length / 2, 0.75 * bulge, seat, 0.7 * bulge, collar, plate, style)]
    top = seat + plate
    packing = turned([(0.45 * bulge, top), (0.35 * bulge, top + 0.5 * radius + 0.01)], style.round(bulge))
    parts.append(Part(moved(packing, at(length / 2)), "valve bonnet", "valve", BODY))
    z = top + 0.5 * radius + 0.01
    if head == "diaphragm":
        parts += diaphragm_head(length / 2, z, radius, style, rng)
    else:
        parts += [stem(z, z + 0.02, 0.005 + 0.1 * radius, style, length / 2)]
        parts += drive(length / 2, z + 0.02, radius, style, rng, (head,))
    return Model(parts, length, kind="control valve")


def _control_diaphragm(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    return _control(dn, style, rng, "diaphragm")


def _control_electric(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    return _control(dn, style, rng, "electric")


def _ball_driven(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A flanged ball valve of any body with any drive."""
    length, radius = _length(dn, "ball"), PIPES[dn].radius
    body, bulge = _body(dn, style, rng, length, 1.5)
    x = length * float(rng.choice([0.5, 0.5, 0.42]))
    boss, top = 0.45 * radius + 0.008, bulge + 0.2 * radius + 0.008
    neck = cylinder(boss, 0.7 * bulge, top, style.round(boss))
    pad = box((2.2 * boss, 2.2 * boss, 0.006), (0, 0, top))
    parts = [body, Part(moved(merge([neck, pad]), at(x)), BODY, "valve", BODY)]
    if rng.random() < 0.5:
        split = along(
            "x", cylinder(bulge * 1.12, 0.60 * length, 0.60 * length + 0.02 + 0.1 * radius, style.round(bulge))
        )
        parts.append(Part(split, BODY, "valve", BODY))
    if style.hollow:
        parts.append(_valve_ball(dn, x, style))
    parts.append(stem(top, top + 0.012 + 0.2 * radius, 0.004 + 0.14 * radius, style, x))
    parts += drive(x, top + 0.012 + 0.2 * radius, radius, style, rng)
    return Model(parts, length, kind="ball valve")


def _valve_ball(dn: int, x: float, style: ModelingStyle) -> Part:
    """The bored ball of a ball valve, open: a belt of a sphere along the run."""
    bore = 0.85 * PIPES[dn].bore
    angles = np.linspace(-0.9, 0.9, 9)
    reach = bore / np.cos(0.9) * 0.97
    belt = [(max(reach * float(np.cos(a)), bore * 1.01), reach * float(np.sin(a))) for a in angles]
    low, high = belt[0][1], belt[-1][1]
    solid = weld([revolve([*belt, (bore, high), (bore, low)], style.round(reach), closed=True)])
    return Part(moved(about_x(solid), at(x)), "valve ball", "trim", BODY)


def _ball_compact(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A compact flanged ball valve: a square block with four lobes for its bolts, its lever up one side."""
    size, radius = FLANGES[dn], PIPES[dn].radius
    length = max(0.055, 1.9 * radius)
    half = 0.36 * size.circle
    lobe = along("x", around(ring(0.5 * size.bolt, 0.95 * size.bolt, 0.0, length, 12), 4, size.circle / 2, np.pi / 4))
    block = extrude(
        rounded_rectangle(2 * half, 2 * half, 0.35 * half, 4), 0.0, length, (circle(radius * 0.9, style.round(radius)),)
    )
    boss = along("z", cylinder(0.4 * radius + 0.006, 0.9 * half, half + 0.01, 12), length / 2)
    parts = [
        Part(merge([along("x", block), lobe, boss]), BODY, "valve", BODY),
        stem(half + 0.01, half + 0.022, 0.006 + 0.1 * radius, style, length / 2),
        *drive(length / 2, half + 0.022, radius, style, rng, ("lever", "lever", "pneumatic", "electric")),
    ]
    return Model(parts, length, "wafer", "ball valve")


def _plug(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A lubricated or lined plug valve: a tapered chest through the body, a wrench square on top."""
    length, radius = _length(dn, "gate"), PIPES[dn].radius
    body, bulge = _body(dn, style, rng, length, 1.2)
    n, x = style.round(bulge), length / 2
    chest = turned(
        [
            (0.8 * bulge, -1.25 * bulge),
            (1.0 * bulge, -1.2 * bulge),
            (1.12 * bulge, 1.2 * bulge),
            (1.12 * bulge, 1.3 * bulge),
        ],
        n,
    )
    cover = turned([(1.15 * bulge, 1.3 * bulge), (1.15 * bulge, 1.45 * bulge), (0.5 * bulge, 1.6 * bulge)], n)
    square = box((0.5 * bulge, 0.5 * bulge, 0.4 * bulge), (0, 0, 1.75 * bulge))
    bolts = bolt_circle(6, 1.0 * bulge, 0.1 * bulge + 0.004, 1.2 * bulge, 1.45 * bulge)
    parts = [
        body,
        Part(moved(chest, at(x)), BODY, "valve", BODY),
        Part(moved(cover, at(x)), "valve bonnet", "valve", BODY),
        Part(moved(square, at(x)), "valve stem", "trim", BODY),
        Part(moved(bolts, at(x)), "bolt", "fastener", BODY, "Connection assembly", True),
    ]
    if rng.random() < 0.8:
        parts += drive(x, 1.95 * bulge, radius, style, rng, ("lever", "gear", "pneumatic", "bar"))
    return Model(parts, length, kind="plug valve")


def _weir(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A weir diaphragm valve: a waisted body with a wide square or round collar, a domed bonnet, a wheel (EN 13397)."""
    length, radius = _length(dn, "gate") * 1.1, PIPES[dn].radius
    neck = 0.485 * FLANGES[dn].hub
    low = plate_thickness(dn) + 0.1 * length
    middle: Middle = [
        (0.95 * neck, low),
        (1.05 * neck, length / 2 - 0.15 * length),
        (1.05 * neck, length / 2 + 0.15 * length),
        (0.95 * neck, length - low),
    ]
    x, z = length / 2, max(1.0 * neck, 0.42 * FLANGES[dn].outer)
    half = min(0.42 * (length - 2 * low) + 0.01, 2.2 * radius + 0.01)
    if rng.random() < 0.5:
        collar = extrude(rounded_rectangle(2 * half, 2.2 * half, 0.3 * half, 4), 0.55 * neck, z)
        lid = extrude(rounded_rectangle(2 * half, 2.2 * half, 0.3 * half, 4), z + 0.003, z + 0.014)
    else:
        collar = turned([(0.6 * half, 0.55 * neck), (half, 0.8 * z), (half, z)], style.round(half))
        lid = cylinder(half, z + 0.003, z + 0.014, style.round(half))
    hood = dome(0.85 * half, 0.8 * half, z + 0.014, style.round(half))
    seal = cylinder(0.95 * half, z, z + 0.003, style.round(half))
    top = z + 0.014 + 0.75 * half
    bolts = bolt_circle(4, 1.15 * half if half else 0.02, 0.008 + 0.06 * radius, z - 0.01, z + 0.014)
    parts = [
        Part(flanged_body(dn, style, length, middle), BODY, "valve", BODY),
        Part(moved(collar, at(x)), BODY, "valve", BODY),
        Part(moved(seal, at(x)), "gasket", "rubber", BODY, "Pipe assembly"),
        Part(moved(merge([lid, hood]), at(x)), "valve bonnet", "valve", BODY),
        Part(moved(bolts, at(x)), "bolt", "fastener", BODY, "Connection assembly", True),
        stem(top, top + 0.03 + 0.5 * radius, 0.004 + 0.1 * radius, style, x),
        wheel(0.03 + 1.2 * radius, x, top + 0.015 + 0.3 * radius, style, rng),
    ]
    return Model(parts, length, kind="diaphragm valve")


def _butterfly(dn: int, style: ModelingStyle, rng: np.random.Generator, lugs: str) -> Model:
    """A butterfly valve body: wafer ring, ring with lugs, or double flanged; disc; long neck with a mounting pad."""
    size, pipe = FLANGES[dn], PIPES[dn]
    length = FACE_TO_FACE["butterfly"][dn] * (2.2 if lugs == "flanged" else 1.0)
    outer = 0.49 * (size.circle - size.bolt)
    n = style.round(outer)
    bore = pipe.bore
    shell = ring(bore, outer, 0.0, length, n)
    if lugs == "lug":
        shell = merge(
            [
                shell,
                around(
                    ring(0.5 * size.bolt, size.bolt, 0.0, length, 10),
                    size.n_bolts,
                    size.circle / 2,
                    np.pi / size.n_bolts,
                ),
            ]
        )
    elif lugs == "flanged":
        thick = plate_thickness(dn)
        shell = merge(
            [
                ring(bore, 0.55 * (size.hub), 0.0, length, n),
                *(ring(bore, size.outer / 2, z, z + thick, n) for z in (0.0, length - thick)),
            ]
        )
    body = about_x(shell)
    neck, top = min(0.38 * length, 0.3 * outer) + 0.004, 0.5 * size.outer + 0.02 + 0.3 * pipe.radius
    post = cylinder(neck, 0.95 * bore + 0.03 * outer, top - 0.008, max(8, style.round(neck)))
    pad = extrude(rounded_rectangle(3.2 * neck, 3.2 * neck, 0.4 * neck, 3), top - 0.01, top)
    boss = along("-z", cylinder(0.8 * neck, 0.99 * bore, outer + 0.3 * neck, max(8, style.round(neck))))
    x = length / 2
    blade = turned(
        [(0.3 * bore, -0.1 * bore), (0.985 * bore, -0.004), (0.985 * bore, 0.004), (0.3 * bore, 0.1 * bore)], n
    )
    angle = float(rng.choice([0.0, 0.5, 0.25])) * np.pi
    blade = moved(blade, at(x) @ spun("z", angle) @ spun("y", np.pi / 2))
    parts = [
        Part(merge([body, moved(merge([post, pad, boss]), at(x))]), BODY, "valve", BODY),
        Part(blade, "valve disc", "trim", BODY),
        stem(top, top + 0.02, 0.35 * neck + 0.003, style, x),
        *drive(x, top + 0.02, pipe.radius, style, rng, ("lever", "lever", "gear", "pneumatic", "electric", "chain")),
    ]
    joint = "flanged" if lugs == "flanged" else "wafer"
    return Model(parts, length, joint, "butterfly valve")


def _butterfly_wafer(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    return _butterfly(dn, style, rng, "wafer")


def _butterfly_lug(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    return _butterfly(dn, style, rng, "lug")


def _butterfly_flanged(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    return _butterfly(dn, style, rng, "flanged")


def _knife(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A knife gate valve: a thin body with lugs, a flat chest, a blade, a tall frame (MSS SP-81)."""
    size, radius = FLANGES[dn], PIPES[dn].radius
    length = FACE_TO_FACE["butterfly"][dn] * 1.05
    n, bore, outer = style.round(size.outer / 2), PIPES[dn].bore, 0.49 * size.outer
    shell = about_x(ring(bore, outer, 0.0, length, n))
    x, chest = length / 2, 1.25 * radius + 0.01
    rise = outer + 1.6 * radius + 0.03
    box_ = box((0.8 * length, 2 * chest, rise - 0.9 * bore), (x, 0, (rise + 0.9 * bore) / 2))
    collar = box((1.3 * length, 2.3 * chest, 0.02), (x, 0, rise - 0.01))
    tall = rise + 2.3 * radius + 0.06
    frame = [box((0.5 * length, 0.012, tall - rise), (x, s * 1.05 * chest, (tall + rise) / 2)) for s in (-1, 1)]
    cross = box((0.7 * length, 2.2 * chest, 0.014), (x, 0, tall))
    blade = box((0.006, 1.8 * chest, 1.5 * radius + 0.05), (x, 0, rise + 0.7 * radius))
    parts = [
        Part(merge([shell, box_]), BODY, "valve", BODY),
        Part(collar, "gland", "trim", BODY),
        Part(blade, "valve disc", "trim", BODY),
        Part(merge([*frame, cross]), "yoke", "steel", BODY),
        stem(rise + 1.4 * radius, tall + 0.05, 0.008 + 0.06 * radius, style, x),
    ]
    if rng.random() < 0.75:
        parts.append(wheel(0.05 + 1.1 * radius, x, tall + 0.015, style, rng))
    else:
        tank_ = turned(
            [
                (0.9 * radius, tall),
                (0.9 * radius, tall + 0.02),
                (0.75 * radius, tall + 0.02),
                (0.75 * radius, tall + 3 * radius),
                (0.9 * radius, tall + 3 * radius),
                (0.9 * radius, tall + 3 * radius + 0.02),
            ],
            n,
        )
        parts.append(Part(moved(tank_, at(x)), "actuator", "trim"))
    return Model(parts, length, "wafer", "knife gate valve")


def _wafer_check(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A wafer check valve: a short ring with a shoulder, a disc or two plates inside (API 594)."""
    size, bore = FLANGES[dn], PIPES[dn].bore
    outer = 0.49 * (size.circle - size.bolt)
    n, length = style.round(outer), max(0.02, float(rng.choice([0.25, 0.4, 0.8])) * PIPES[dn].outer)
    if rng.random() < 0.5:
        inner, waist = 1.02 * bore, float(rng.uniform(0.75, 0.98)) * outer
        lip = 0.18 * length
        profile = [
            (inner * 0.8, 0.0),
            (outer, 0.0),
            (outer, lip),
            (max(waist, 1.08 * inner), 1.2 * lip),
            (max(waist, 1.08 * inner), length),
            (inner, length),
        ]
        shell = about_x(weld([revolve(profile, n, closed=True)]))
        lid = about_x(
            turned(
                [
                    (0.78 * bore, 0.3 * length),
                    (0.95 * bore, 0.35 * length),
                    (0.95 * bore, 0.5 * length),
                    (0.3 * bore, 0.7 * length),
                ],
                n,
            )
        )
        inside = [Part(lid, "valve disc", "trim", BODY)]
    else:
        shell = about_x(ring(bore, outer, 0.0, length, n))
        half = np.vstack([0.97 * bore * np.column_stack([np.cos(t := np.linspace(0.05, np.pi - 0.05, 12)), np.sin(t)])])
        plates = [
            along("x", moved(extrude(half, 0.35 * length, 0.35 * length + 0.006), spun("z", a))) for a in (0.0, np.pi)
        ]
        pin = along("y", cylinder(0.05 * bore + 0.002, -bore, bore, 8), 0.45 * length)
        inside = [Part(solid, "valve disc", "trim", BODY) for solid in plates] + [Part(pin, "valve stem", "trim", BODY)]
    return Model([Part(shell, BODY, "valve", BODY), *inside], round(length, 6), "wafer", "check valve")


def _ball_check(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A ball check valve: a body with a slanting chamber and a bolted cap."""
    length = _length(dn, "check")
    body, bulge = _body(dn, style, rng, length, 1.3)
    tilt, x = float(rng.uniform(0.5, 0.9)), 0.55 * length
    n = style.round(bulge)
    reach = max(2.4 * bulge, 0.6 * FLANGES[dn].outer)
    way = at(x, 0, 0.2 * bulge) @ spun("y", tilt)
    arm = turned([(0.95 * bulge, 0.0), (0.95 * bulge, reach), (1.2 * bulge, reach), (1.2 * bulge, reach + 0.012)], n)
    lid = turned([(1.2 * bulge, reach + 0.012), (1.2 * bulge, reach + 0.026), (0.6 * bulge, reach + 0.036)], n)
    parts = [
        body,
        Part(moved(arm, way), BODY, "valve", BODY),
        Part(moved(lid, way), "valve bonnet", "valve", BODY),
        Part(
            moved(bolt_circle(4, 1.08 * bulge, 0.01, reach, reach + 0.026), way),
            "bolt",
            "fastener",
            BODY,
            "Connection assembly",
            True,
        ),
    ]
    return Model(parts, length, kind="check valve")


def _nozzle_check(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An axial check valve: nothing but a swollen body; or a lift check with a screwed cap."""
    length = _length(dn, "check")
    body, bulge = _body(dn, style, rng, length, 1.6)
    parts = [body]
    if rng.random() < 0.5:
        cap_ = merge(
            [
                cylinder(0.7 * bulge, 0.6 * bulge, 1.35 * bulge, style.round(bulge)),
                hexagon(0.9 * bulge, 1.35 * bulge, 1.6 * bulge),
            ]
        )
        parts.append(Part(moved(cap_, at(length / 2)), "valve bonnet", "valve", BODY))
    return Model(parts, length, kind="check valve")


def _three_way(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A three-way valve: a third flange downward or to the side, closed by a blind flange or open."""
    length, radius = _length(dn, "globe"), PIPES[dn].radius
    body, bulge = _body(dn, style, rng, length, 1.5)
    x, reach = length / 2, length / 2
    side = str(rng.choice(["-z", "y", "-y"]))
    branch = moved(disc_flange(dn, style, reach - 0.6 * bulge), at(0, 0, -reach))
    branch = moved(along({"-z": "z", "y": "-y", "-y": "y"}[side], branch), at(x))
    parts = [body, Part(branch, BODY, "valve", BODY)]
    top = bulge + 0.3 * radius + 0.01
    parts.append(
        Part(
            moved(turned([(0.6 * bulge, 0.7 * bulge), (0.6 * bulge, top)], style.round(bulge)), at(x)),
            "valve bonnet",
            "valve",
            BODY,
        )
    )
    parts.append(stem(top, top + 0.03, 0.005 + 0.1 * radius, style, x))
    if rng.random() < 0.35:
        parts += diaphragm_head(x, top + 0.01, radius, style, rng)
    else:
        parts += drive(x, top + 0.03, radius, style, rng, ("lever", "pneumatic", "electric"))
    return Model(parts, length, kind="three-way valve")


def _y_globe(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A Y-pattern globe valve, its bonnet slanting; a wheel on its stem."""
    length, radius = _length(dn, "globe"), PIPES[dn].radius
    body, bulge = _body(dn, style, rng, length, 1.2)
    tilt, n = float(rng.uniform(0.6, 0.85)), style.round(bulge)
    way = at(0.48 * length, 0, 0.1 * bulge) @ spun("y", tilt)
    reach = max(2.2 * bulge, 0.65 * FLANGES[dn].outer)
    neck = turned([(0.85 * bulge, 0.0), (0.85 * bulge, reach), (1.15 * bulge, reach), (1.15 * bulge, reach + 0.012)], n)
    cap_ = turned(
        [
            (1.15 * bulge, reach + 0.012),
            (1.15 * bulge, reach + 0.026),
            (0.5 * bulge, reach + 0.04),
            (0.4 * bulge, reach + 0.06 + radius),
        ],
        n,
    )
    high = reach + 0.06 + radius
    rest = [
        stem(high, high + 0.04 + 0.8 * radius, 0.005 + 0.1 * radius, style),
        wheel(0.04 + 1.3 * radius, 0, high + 0.02 + 0.6 * radius, style, rng),
    ]
    parts = [
        body,
        Part(moved(neck, way), BODY, "valve", BODY),
        Part(moved(cap_, way), "valve bonnet", "valve", BODY),
        *(Part(moved(p.solid, way), p.name, p.color, p.bundle) for p in rest),
    ]
    return Model(parts, length, kind="globe valve")


def _reducing(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A pressure reducing valve: a globe body with a spring or pilot housing above and maybe a closed can below."""
    length = _length(dn, "globe")
    body, bulge = _body(dn, style, rng, length, 1.4)
    x, n = length / 2, style.round(2 * bulge)
    z = max(1.2 * bulge, 0.5 * FLANGES[dn].outer)
    pan = turned(
        [(0.7 * bulge, 0.6 * bulge), (0.7 * bulge, z), (1.7 * bulge, z + 0.2 * bulge), (1.7 * bulge, z + 0.35 * bulge)],
        n,
    )
    hood = turned(
        [
            (1.7 * bulge, z + 0.35 * bulge),
            (1.7 * bulge, z + 0.5 * bulge),
            (0.75 * bulge, z + 0.9 * bulge),
            (0.7 * bulge, z + 2.6 * bulge),
            (0.4 * bulge, z + 2.8 * bulge),
        ],
        n,
    )
    screw = merge(
        [
            cylinder(0.1 * bulge + 0.003, z + 2.75 * bulge, z + 3.3 * bulge, 8),
            hexagon(0.4 * bulge, z + 2.8 * bulge, z + 3.0 * bulge),
        ]
    )
    parts = [
        body,
        Part(moved(pan, at(x)), BODY, "valve", BODY),
        Part(moved(hood, at(x)), "valve bonnet", "valve", BODY),
        Part(moved(screw, at(x)), "valve stem", "trim", BODY),
    ]
    parts.append(
        Part(
            moved(bolt_circle(8, 1.55 * bulge, 0.01, z + 0.2 * bulge, z + 0.5 * bulge), at(x)),
            "bolt",
            "fastener",
            BODY,
            "Connection assembly",
            True,
        )
    )
    if rng.random() < 0.4:
        can = turned([(0.9 * bulge, 0.0), (0.9 * bulge, 0.5 * bulge)], n)
        parts.append(Part(moved(can, at(x, 0, -1.35 * bulge)), BODY, "valve", BODY))
    return Model(parts, length, kind="pressure reducing valve")


def _relief(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A spring relief valve: inlet below (x = 0), outlet to the side, a tall bonnet with a cap or a lifting lever."""
    radius, size = PIPES[dn].radius, FLANGES[dn]
    out = SIZES[min(SIZES.index(dn) + 1, len(SIZES) - 1)]
    centre = 0.6 * size.outer + 0.03  # API 526 proportions: centre to inlet face about the flange's radius and more
    bulge, n = 1.6 * radius + 0.010, style.round(size.outer / 2)
    inlet = about_x(disc_flange(dn, style, centre))
    ball_ = about_x(
        turned(
            [
                (0.8 * bulge, centre - bulge),
                (bulge, centre - 0.5 * bulge),
                (bulge, centre + 0.7 * bulge),
                (1.15 * bulge, centre + 0.8 * bulge),
                (1.15 * bulge, centre + 0.95 * bulge),
            ],
            n,
        )
    )
    reach = 0.6 * FLANGES[out].outer + 0.03
    outlet = moved(along("y", moved(disc_flange(out, style, reach), at(0, 0, -reach))), at(centre))
    tall = float(rng.uniform(3.5, 5.0)) * bulge
    low = centre + 0.95 * bulge
    bonnet = about_x(
        turned(
            [
                (1.15 * bulge, low),
                (1.15 * bulge, low + 0.15 * bulge),
                (0.75 * bulge, low + 0.35 * bulge),
                (0.7 * bulge, low + 0.8 * tall),
                (0.5 * bulge, low + tall),
            ],
            n,
        )
    )
    cap_ = about_x(
        merge(
            [
                cylinder(0.38 * bulge, low + 0.95 * tall, low + 1.3 * tall, n),
                hexagon(0.9 * bulge, low + tall, low + 1.1 * tall),
            ]
        )
    )
    parts = [
        Part(merge([inlet, ball_, outlet]), BODY, "valve", BODY),
        Part(bonnet, "valve bonnet", "valve", BODY),
        Part(cap_, "valve bonnet", "trim", BODY),
        Part(
            about_x(bolt_circle(4, 1.0 * bulge, 0.01 + 0.05 * radius, low - 0.15 * bulge, low + 0.15 * bulge)),
            "bolt",
            "fastener",
            BODY,
            "Connection assembly",
            True,
        ),
    ]
    if rng.random() < 0.5:
        arm = rod((low + 1.2 * tall, 0.0, 0.3 * bulge), (low + 0.75 * tall, 0.0, 1.6 * bulge), 0.1 * bulge, 8)
        parts.append(Part(arm, "lever", "handle"))
    return Model(parts, kind="relief valve")


def _angle(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """An angle globe valve: inlet from below, outlet to the side, wheel on top."""
    radius, size = PIPES[dn].radius, FLANGES[dn]
    centre, bulge = 0.6 * size.outer + 0.04, 1.5 * radius + 0.01
    n = style.round(size.outer / 2)
    outlet = moved(along("y", moved(disc_flange(dn, style, centre), at(0, 0, -centre))), at(centre))
    middle = moved(ball(bulge, n), at(centre))
    high = centre + max(bulge, 0.52 * size.outer)
    neck = about_x(
        turned(
            [
                (0.85 * bulge, centre),
                (0.85 * bulge, high),
                (1.1 * bulge, high),
                (1.1 * bulge, high + 0.03),
                (0.5 * bulge, high + 0.05),
                (0.4 * bulge, high + 0.05 + 1.2 * radius),
            ],
            n,
        )
    )
    top = high + 0.05 + 1.2 * radius
    rest = [
        stem(top, top + 0.05 + radius, 0.005 + 0.1 * radius, style),
        wheel(0.04 + 1.3 * radius, 0, top + 0.03 + 0.7 * radius, style, rng),
    ]
    parts = [
        Part(merge([about_x(disc_flange(dn, style, centre)), middle, outlet]), BODY, "valve", BODY),
        Part(neck, "valve bonnet", "valve", BODY),
        *(Part(about_x(p.solid), p.name, p.color, p.bundle) for p in rest),
    ]
    return Model(parts, kind="globe valve")


_BIG = tuple(dn for dn in SIZES if dn >= 40)
_MID = tuple(dn for dn in SIZES if dn <= 200)


def valve_family(
    name: str, build: Build, sizes: tuple[int, ...] = SIZES, place: str = "inline", weight: float = 1.0
) -> Family:
    """A family of valves."""
    return Family(name, place, "Valve assembly", "valve", build, sizes, weight=weight)


VALVE_FAMILIES: tuple[Family, ...] = (
    valve_family("control valve/diaphragm", _control_diaphragm, weight=1.5),
    valve_family("control valve/electric", _control_electric),
    valve_family("ball valve/driven", _ball_driven, weight=2),
    valve_family("ball valve/compact", _ball_compact, tuple(dn for dn in SIZES if FLANGES[dn].n_bolts == 4)),
    valve_family("plug valve/tapered", _plug, _MID),
    valve_family("diaphragm valve/weir", _weir, _MID),
    valve_family("butterfly valve/wafer", _butterfly_wafer, _BIG, weight=1.5),
    valve_family("butterfly valve/lug", _butterfly_lug, _BIG),
    valve_family("butterfly valve/flanged", _butterfly_flanged, _BIG),
    valve_family("knife gate valve/wafer", _knife, _BIG),
    valve_family("check valve/wafer", _wafer_check, _BIG, weight=1.5),
    valve_family("check valve/ball", _ball_check, _MID),
    valve_family("check valve/axial", _nozzle_check),
    valve_family("three-way valve/flanged", _three_way, _MID),
    valve_family("globe valve/Y pattern", _y_globe, _MID),
    valve_family("pressure reducing valve/spring", _reducing, _MID),
    valve_family("relief valve/spring", _relief, _MID, "head", 2),
    valve_family("globe valve/angle", _angle, _MID, "head"),
)
