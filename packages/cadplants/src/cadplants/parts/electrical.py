"""Cabinets, boxes, cable trays and lamps."""

from __future__ import annotations

import numpy as np

from cadplants.model.plant import Assembly, Component, gather
from cadplants.parts.detail import plate
from cadplants.solids.lettering import letters
from cadplants.solids.mesh_ops import Solid, box, extrude, moved, revolve, shared, tube, weld
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["cabinet", "cable_tray", "lamp", "sign"]

_GROUP = "Electrical and safety"


@shared
def _cabinet_solids(width: float, depth: float, height: float) -> tuple[Solid, Solid, Solid, Solid]:
    """Plinth, body, door and lock; the door looks to -y."""
    plinth = box((width - 0.02, depth - 0.04, 0.1), (0, 0.01, 0.05))
    body = box((width, depth, height - 0.1), (0, 0, 0.1 + (height - 0.1) / 2))
    door = box((width - 0.02, 0.02, height - 0.14), (0, -depth / 2 - 0.01, 0.1 + (height - 0.1) / 2))
    lock = box((0.025, 0.03, 0.12), (0.36 * width, -depth / 2 - 0.035, 0.55 * height))
    return plinth, body, door, lock


def cabinet(
    style: ModelingStyle,
    width: float = 0.8,
    depth: float = 0.4,
    height: float = 1.9,
    plates: tuple[tuple[str, ...], ...] = (),
) -> Assembly:
    """A control cabinet on z = 0: plinth, body, door, lock; and plates with text on its door, from above."""
    solids = _cabinet_solids(round(width, 6), round(depth, 6), round(height, 6))
    colors = ("steel", "electrical", "electrical", "rubber")
    pairs = zip(solids, colors, strict=True)
    components = tuple(Component(solid, _GROUP, "control panel", style.color(color)) for solid, color in pairs)
    parts = [Assembly(components, ((0, 1), (1, 2), (2, 3)))]
    joints, count = [], len(components)
    for k, lines in enumerate(plates):
        place = at(-0.12 * width, -depth / 2 - 0.02, (0.90 - 0.09 * k) * height) @ spun("x", np.pi / 2)
        text = plate(lines, style, 0.010)
        parts.append(text.placed(place))
        joints.append((2, count))
        count += len(text.components)
    return gather(parts, joints)


@shared
def _tray_solid(length: float, width: float) -> Solid:
    half, side, thin = width / 2, 0.06, 0.002
    outline = np.array(
        [
            [-half, 0], [half, 0], [half, side], [half - thin, side], [half - thin, thin],
            [-half + thin, thin], [-half + thin, side], [-half, side],
        ]
    )  # fmt: skip
    # The outline lies in (y, z) and runs along x.
    solid = extrude(outline, 0.0, length)
    return Solid(solid.vertices[:, [2, 0, 1]], solid.faces)


@shared
def _cable_solid(length: float, radius: float) -> Solid:
    return tube(np.array([[0.0, 0.0, 0.0], [length, 0.0, 0.0]]), radius, 0.0, 12)


def cable_tray(length: float, style: ModelingStyle, width: float = 0.3, n_cables: int = 3, pieces: int = 1) -> Assembly:
    """A tray along x from 0 on z = 0 in pieces that meet, with cables in it."""
    step = length / pieces
    tray = _tray_solid(round(step, 6), width)
    parts = [Component(tray, _GROUP, "cable tray", style.color("clamp"), at(k * step)) for k in range(pieces)]
    contacts = [(k, k + 1) for k in range(pieces - 1)]
    for k in range(n_cables):
        radius = (0.012, 0.009, 0.015)[k % 3]
        y = -width / 2 + (k + 1) * width / (n_cables + 1)
        pose = at(0.0, y, 0.002 + radius)
        parts.append(Component(_cable_solid(round(length, 6), radius), _GROUP, "cable", style.color("rubber"), pose))
        contacts += [(j, len(parts) - 1) for j in range(pieces)]
    return Assembly(tuple(parts), tuple(contacts))


@shared
def _lamp_solids(height: float) -> tuple[Solid, Solid]:
    shape = [(0, 0), (0.12, 0), (0.12, 0.012), (0.055, 0.012), (0.030, height), (0, height)]
    pole = weld([revolve(shape, 20)])
    head = extrude(rounded_rectangle(0.42, 0.16, 0.05, 4), 0.0, 0.05)
    return pole, moved(head, at(0.12, 0, height))


def lamp(style: ModelingStyle, height: float = 4.0) -> Assembly:
    """A lamp on a tapered pole on z = 0, its head towards +x."""
    pole, head = _lamp_solids(round(height, 6))
    components = (
        Component(pole, _GROUP, "lamp", style.color("clamp")),
        Component(head, _GROUP, "lamp", style.color("electrical")),
    )
    return Assembly(components, ((0, 1),))


@shared
def _sign_solids() -> tuple[Solid, Solid]:
    pole = extrude(circle(0.02, 12), 0.0, 1.5)
    plate = extrude(rounded_rectangle(0.4, 0.3, 0.02, 3), 0.0, 0.003)
    plate = moved(plate, at(0, -0.02 + 0.0005, 1.3) @ spun("x", np.pi / 2))
    return pole, plate


def sign(style: ModelingStyle, lines: tuple[str, ...] = ()) -> Assembly:
    """A warning sign on a pole on z = 0; it looks to -y, with raised letters where it says something."""
    pole, sheet = _sign_solids()
    components = (
        Component(pole, "Structural element", "post", style.color("clamp")),
        Component(sheet, _GROUP, "sign", style.color("safety")),
    )
    parts = list(components)
    contacts = [(0, 1)]
    for k, text in enumerate(lines):
        face = at(0, -0.0225, 1.3 + 0.045 * ((len(lines) - 1) / 2 - k)) @ spun("x", np.pi / 2)
        for solid, pose in letters(text, 0.028, 0.0008):
            contacts.append((1, len(parts)))
            parts.append(Component(solid, _GROUP, "sign", style.color("rubber"), face @ pose, family="sign"))
    return Assembly(tuple(parts), tuple(contacts))
