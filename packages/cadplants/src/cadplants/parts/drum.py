"""Lying tanks on saddles, with dished heads, nozzles and manway."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.model.plant import Assembly, Component, Unit, gather
from cadplants.model.standards import PIPES
from cadplants.parts.flange import flange_length
from cadplants.parts.piping import stub
from cadplants.parts.vessel import STRAIGHT, WALL, Nozzle, Tank, head_solid, with_flange
from cadplants.solids.mesh_ops import Solid, box, extrude, revolve, shared, weld
from cadplants.solids.transforms import at, looking, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["drum", "drum_reach"]

_SADDLE = 0.16  # m, along the axis
_WRAP = np.radians(60)  # half the angle that a saddle holds: 120 degrees in all (Zick)
_BITE = 0.0005  # m; welded parts run this deep into each other
_DEEP = 0.003  # m; a stub reaches this far below the shell where that is lowest
_OUT = {"top": (0.0, 0.0, 1.0), "right": (1.0, 0.0, 0.0), "left": (-1.0, 0.0, 0.0)}


@shared
def _shell_solids(radius: float, length: float, sides: int) -> tuple[Solid, Solid]:
    """Shell along z about its middle, and a head whose open end is at z = 0."""
    inner, half = radius - WALL, length / 2
    shell = weld([revolve([(inner, -half), (radius, -half), (radius, half), (inner, half)], sides, closed=True)])
    return shell, head_solid(radius, sides)


@shared
def _saddle_solid(radius: float, axis: float, sides: int) -> Solid:
    """A saddle about y, its foot on z = 0, the tank's axis at this height."""
    hold = radius * np.cos(np.pi / sides) - _BITE
    angles = np.linspace(_WRAP, -_WRAP, 13)
    arc = np.column_stack([hold * np.sin(angles), axis - hold * np.cos(angles)])
    wide = hold * np.sin(_WRAP) + 0.03
    foot = np.array([[-wide, 0.012], [wide, 0.012], [wide, arc[0, 1]]])
    outline = np.concatenate([foot, arc, [[-wide, arc[-1, 1]]]])
    solid = extrude(outline, -_SADDLE / 2, _SADDLE / 2)
    # The outline lies in (x, z) and runs along y.
    return Solid(solid.vertices[:, [0, 2, 1]], solid.faces[:, ::-1])


def drum(
    unit: str, style: ModelingStyle, radius: float, length: float, clearance: float, nozzles: Sequence[Nozzle]
) -> Tank:
    """A lying tank along y about z, on two saddles on the ground.

    Args:
        unit: its id.
        style: that models it.
        radius: outside [m].
        length: of the cylindrical shell [m].
        clearance: from the ground to the lowest point of the shell [m].
        nozzles: in the order of the result; ``top`` ones at x and y, ``right`` (+x) and ``left`` (-x) ones at y and
            height over the axis [m].
    """
    sides = 16 if style.sides[1] <= 16 else 72
    axis = clearance + radius
    shell, head = _shell_solids(round(radius, 6), round(length, 6), sides)
    color, group = style.color("tank"), "Tank"
    # Corners of the shell's polygon look straight up and down.
    lie = at(0, 0, axis) @ spun("x", -np.pi / 2)
    parts = [
        Assembly(
            (
                Component(shell, group, "shell", color, lie),
                Component(head, group, "dished head", color, lie @ at(0, 0, length / 2)),
                Component(head, group, "dished head", color, lie @ at(0, 0, -length / 2) @ spun("x", np.pi)),
            ),
            ((0, 1), (0, 2)),
            (Unit(unit, "tank", "horizontal tank"),),
        )
    ]
    joints: list[tuple[int, int]] = []
    for k, y in enumerate((-0.34 * length, 0.34 * length)):
        parts.append(_saddle(style, round(radius, 6), round(axis, 6), sides).placed(at(0, y, 0)))
        joints.append((0, 3 + 2 * k))
    count, faces, flanges = 7, [], []
    for nozzle in nozzles:
        part, face = _nozzle(nozzle, style, radius, axis)
        parts.append(part)
        joints.append((0, count))
        faces.append(face)
        flanges.append(count + 1)
        count += len(part.components)
    whole = gather(parts, joints)
    named = tuple(replace(c, unit=unit if c.group == group else "", granularity="pieces") for c in whole.components)
    return Tank(replace(whole, components=named), tuple(faces), tuple(flanges), axis + radius)


def drum_reach(radius: float, length: float) -> float:
    """Half the length of a lying tank over its heads [m]; ``length`` of its shell [m]."""
    return length / 2 + STRAIGHT + radius / 2


def _saddle(style: ModelingStyle, radius: float, axis: float, sides: int) -> Assembly:
    wide = 2 * (radius * np.sin(_WRAP) + 0.06)
    foot = box((wide, _SADDLE + 0.06, 0.012), (0, 0, 0.006))
    return Assembly(
        (
            Component(_saddle_solid(radius, axis, sides), "Tank", "saddle", style.color("tank")),
            Component(foot, "Structural element", "base plate", style.color("steel")),
        ),
        ((0, 1),),
    )


def _nozzle(nozzle: Nozzle, style: ModelingStyle, radius: float, axis: float) -> tuple[Assembly, Floats]:
    """Stub and flange, with a lid on a manway; and the frame of the face."""
    dn, name = nozzle.dn, "manway" if nozzle.manway else "nozzle"
    out = np.array(_OUT[nozzle.kind])
    first, second = nozzle.place
    foot = np.array((first, second, axis)) if nozzle.kind == "top" else np.array((0.0, first, axis + second))
    aside = abs(first if nozzle.kind == "top" else second)
    low = np.sqrt(radius**2 - (aside + PIPES[dn].radius) ** 2) - _DEEP
    high = np.sqrt(radius**2 - max(0.0, aside - PIPES[dn].radius) ** 2) + nozzle.length
    neck = flange_length(dn, style)
    across = (0.0, 1.0, 0.0)
    stand = np.eye(4)
    stand[:3, 0], stand[:3, 1], stand[:3, 2], stand[:3, 3] = across, np.cross(out, across), out, foot + low * out
    pipe = stub(dn, 0.0, high - neck - low, 0.0, style, "Tank", name, "tank").placed(stand)
    face = looking(foot + high * out, out)
    return with_flange(nozzle, pipe, face, style), face
