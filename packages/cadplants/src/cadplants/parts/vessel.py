"""Upright tanks with dished heads, nozzles, manway and legs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.model.plant import Assembly, Component, Unit, gather
from cadplants.model.standards import PIPES
from cadplants.parts.fastener import clamping
from cadplants.parts.flange import GASKET, bolts, flange, flange_length, gasket, plate_thickness
from cadplants.parts.piping import stub
from cadplants.solids.mesh_ops import Solid, extrude, revolve, shared, weld
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.transforms import at, looking, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["STRAIGHT", "WALL", "Nozzle", "Tank", "head_solid", "skin", "tank", "with_flange"]

_FEW = 16  # sides of a shell where round things have so many at most
WALL = 0.006  # m
STRAIGHT = 0.04  # m, straight flange of a 2:1 head (ASME BPVC VIII-1, UG-32)


@dataclass(frozen=True)
class Nozzle:
    """A nozzle of a tank.

    Args:
        dn: nominal size.
        kind: ``top`` (on the upper head, upright) or ``side`` (radial on the shell).
        place: x and y on the head, or angle [rad] and height over the shell's lower edge [m].
        length: from the head or shell to the flange's face [m].
        manway: whether it is closed by a bolted lid.
    """

    dn: int
    kind: str
    place: tuple[float, float]
    length: float = 0.15
    manway: bool = False


@dataclass(frozen=True)
class Tank:
    """A finished tank.

    Args:
        assembly: shell first.
        faces: for each nozzle the frame of its face, x outward.
        flanges: for each nozzle the component with that face.
        top: height of the highest point of the upper head [m].
    """

    assembly: Assembly
    faces: tuple[Floats, ...]
    flanges: tuple[int, ...]
    top: float


@shared
def _shell_solids(radius: float, height: float, sides: int) -> tuple[Solid, Solid]:
    """Shell from z = 0, and a head whose open end is at z = 0."""
    inner = radius - WALL
    shell = weld([revolve([(inner, 0), (radius, 0), (radius, height), (inner, height)], sides, closed=True)])
    return shell, head_solid(radius, sides)


@shared
def head_solid(radius: float, sides: int) -> Solid:
    """A 2:1 head of sheet about z, its open end at z = 0."""
    inner, angles = radius - WALL, np.linspace(0, np.pi / 2, 15)
    outside = [(radius, 0.0)] + [(radius * np.cos(a), STRAIGHT + radius / 2 * np.sin(a)) for a in angles[:-1]]
    outside.append((0.0, STRAIGHT + radius / 2))
    inside = [(0.0, STRAIGHT + radius / 2 - WALL)]
    inside += [(inner * np.cos(a), STRAIGHT + (radius / 2 - WALL) * np.sin(a)) for a in angles[:-1][::-1]]
    inside += [(inner, 0.0), (radius, 0.0)]
    return weld([revolve([*outside, *inside], sides)])


@shared
def _leg_solids(height: float, side: float) -> tuple[Solid, Solid]:
    outer, hollow = rounded_rectangle(side, side, 0.008, 3), rounded_rectangle(side - 0.01, side - 0.01, 0.004, 3)
    holes = tuple(circle(0.009, 12, (x, y)) for x in (-0.07, 0.07) for y in (-0.07, 0.07))
    return (
        extrude(outer, 0.012, height, (hollow,)),
        extrude(rounded_rectangle(0.19, 0.19, 0.012, 3), 0.0, 0.012, holes),
    )


def tank(
    unit: str,
    style: ModelingStyle,
    radius: float,
    height: float,
    clearance: float,
    nozzles: Sequence[Nozzle],
    n_legs: int = 4,
) -> Tank:
    """An upright tank about z on the ground.

    Args:
        unit: its id.
        style: that models it.
        radius: outside [m].
        height: of the cylindrical shell [m].
        clearance: from the ground to the lowest point of the lower head [m].
        nozzles: in the order of the result.
        n_legs: legs evenly round the shell.
    """
    sides = _FEW if _is_coarse(style) else 72
    shell, head = _shell_solids(radius, height, sides)
    low = clearance + radius / 2 + STRAIGHT
    color, group = style.color("tank"), "Tank"
    parts = [
        Assembly(
            (
                Component(shell, group, "shell", color, at(0, 0, low)),
                Component(head, group, "dished head", color, at(0, 0, low + height)),
                Component(head, group, "dished head", color, at(0, 0, low) @ spun("x", np.pi)),
            ),
            ((0, 1), (0, 2)),
            (Unit(unit, "tank", "tank"),),
        )
    ]
    sag = radius * (1 - np.cos(np.pi / sides))
    parts.append(_legs(round(low + 0.25, 6), radius - sag, n_legs, style))
    joints = [(part, 3 + 2 * k) for k in range(n_legs) for part in (0, 2)]
    count = 3 + 2 * n_legs
    faces, flanges = [], []
    for nozzle in nozzles:
        part, face = _nozzle(nozzle, style, radius, low, height, sag)
        parts.append(part)
        joints.append((1 if nozzle.kind == "top" else 0, count))
        faces.append(face)
        flanges.append(count + 1)
        count += len(part.components)
    whole = gather(parts, joints)
    named = tuple(
        Component(c.solid, c.group, c.name, c.color, c.pose, unit if c.group == group else "") for c in whole.components
    )
    whole = Assembly(named, whole.contacts, whole.units)
    return Tank(whole, tuple(faces), tuple(flanges), low + height + STRAIGHT + radius / 2)


def _is_coarse(style: ModelingStyle) -> bool:
    return style.sides[1] <= _FEW


def skin(radius: float, angle: float, style: ModelingStyle) -> float:
    """How far from its axis the shell of a tank is, for what stands on it [m].

    Args:
        radius: of the shell [m].
        angle: about the axis [rad].
        style: that models it; a shell of few sides lies well inside its radius between its corners.
    """
    if not _is_coarse(style):
        return radius
    half = np.pi / _FEW
    return float(radius * np.cos(half) / np.cos(angle % (2 * half) - half))


def _legs(height: float, radius: float, count: int, style: ModelingStyle) -> Assembly:
    """Legs round a shell of this radius, each with its base plate behind it."""
    leg, foot = _leg_solids(height, 0.08)
    color = style.color("steel")
    components = []
    for k in range(count):
        pose = spun("z", 2 * np.pi * (k + 0.5) / count) @ at(radius + 0.04 - 0.0005)
        components.append(Component(leg, "Tank", "tank leg", color, pose))
        components.append(Component(foot, "Structural element", "base plate", color, pose))
    return Assembly(tuple(components), tuple((2 * k, 2 * k + 1) for k in range(count)))


def _nozzle(
    nozzle: Nozzle, style: ModelingStyle, radius: float, low: float, height: float, sag: float
) -> tuple[Assembly, Floats]:
    """Stub and flange, with a lid on a manway; and the frame of the face."""
    dn, name = nozzle.dn, "manway" if nozzle.manway else "nozzle"
    neck = flange_length(dn, style)
    if nozzle.kind == "side":
        angle, z = nozzle.place
        turn = spun("z", angle)
        # The stub's cylinder lies along x; a turn about y and one about z bring it upright and outward.
        stand = turn @ at(0, 0, low + z) @ spun("y", np.pi / 2)
        pipe = stub(dn, radius, nozzle.length - neck, sag + 0.001, style, "Tank", name, "tank").placed(
            stand @ spun("z", np.pi / 2) @ np.eye(4)
        )
        out = turn[:3, 0]
        face = looking(out * (radius + nozzle.length) + (0.0, 0.0, low + z), out)
    else:
        x, y = nozzle.place
        share = np.hypot(x, y) / radius
        inner = max(0.0, share - PIPES[dn].radius / radius)
        outer = min(0.999, share + PIPES[dn].radius / radius)
        base = low + height + STRAIGHT
        lowest = base + radius / 2 * np.sqrt(1 - outer**2) - 0.003
        top = base + radius / 2 * np.sqrt(1 - inner**2) + nozzle.length
        pipe = stub(dn, 0.0, top - neck - lowest, 0.0, style, "Tank", name, "tank").placed(at(x, y, lowest))
        face = looking((x, y, top), (0.0, 0.0, 1.0))
    return with_flange(nozzle, pipe, face, style), face


def with_flange(nozzle: Nozzle, pipe: Assembly, face: Floats, style: ModelingStyle) -> Assembly:
    """A nozzle's pipe with the flange at its face; on a manway a lid behind a gasket, bolted to it."""
    dn, name = nozzle.dn, "manway" if nozzle.manway else "nozzle"
    parts = [pipe, _of_tank(flange(dn, style), name, style).placed(face @ spun("z", np.pi))]
    if not nozzle.manway:
        return gather(parts, [(0, 1)])
    pad, plate = GASKET if style.gaskets else 0.0, plate_thickness(dn)
    parts.append(gasket(dn, style).placed(face))
    lid = 2 + len(parts[-1].components)
    parts.append(_of_tank(flange(dn, style, blind=True), name, style).placed(face @ at(pad)))
    studs = bolts(dn, 2 * plate + pad, style).placed(face @ at(-plate))
    parts.append(studs)
    joints = [(0, 1), *((k, k + 1) for k in range(1, lid))]
    for near, far in clamping(range(lid + 1, lid + 1 + len(studs.components)), style):
        joints += [(1, near), (lid, far)]
    return gather(parts, joints)


def _of_tank(made: Assembly, name: str, style: ModelingStyle) -> Assembly:
    """A flange as a piece of the tank."""
    return Assembly((Component(made.components[0].solid, "Tank", name, style.color("tank")),))
