"""Traps: small plants on which points on a voxel grid go wrong, as the paper reports of its own (section IV-A).

The paper moves every vertex to the centre of its 1 cm voxel and puts points along the sides of faces only (section
III-B). Two plants show, each with dimensions found by search, what follows: a gap of a hair can grow beyond 1 cm, and
a gap of nearly 2 cm can shrink to 1 cm. Exact distances tell both apart.
"""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.preset_devices import ManwayTank, Opening, Platform
from cadplants.model.plant import Assembly, Component, Plant, gather
from cadplants.model.standards import ELBOW_LONG_RADIUS, PIPES
from cadplants.parts.fastener import clamping
from cadplants.parts.flange import bolts, flange, flange_length, plate_thickness
from cadplants.parts.piping import pipe
from cadplants.parts.vessel import Nozzle, Tank
from cadplants.solids.mesh_ops import box, tube
from cadplants.solids.transforms import arc, at, looking, spun
from cadplants.styles.modeling_style import STYLES, ModelingStyle

__all__ = ["make_bent_pipe", "make_platform_and_tanks"]

VOXEL = 0.01  # m, paper, section III-B, step 1

_DN, _SIDES = 200, 8
_TWIST = 1.5 * np.pi / _SIDES  # of the leg's corners against the elbow's: three quarters of a step
_ROOT_GAP = 0.002  # m, open root of a butt weld, usually 2 to 3 mm


def make_bent_pipe(shift: float = 0.0) -> Plant:
    """A bent DN200 pipe of 8 sides, coarse as simulators like it, on two plain supports.

    Its five segments (leg, elbow, cross run, elbow, side run) follow each other with the 2 mm gap of a butt weld, so
    it is one structure. The joint at the top of the leg lies on a border between voxels: the two ends move into
    voxels 1 cm apart, and since their corners don't face each other, neither do any two points. Snapped, the ends are
    more than 1 cm apart, and the paper's method splits the pipe there.

    Args:
        shift: moves everything up [m]; half a voxel brings both ends into one voxel, and the split goes away.

    Returns:
        The plant with its truth: one cluster.
    """
    style = STYLES["game"]
    radius, half = ELBOW_LONG_RADIUS[_DN], _ROOT_GAP / 2
    x, y, z, low = 0.006, 0.006, 1.50, 0.012
    axis = z + half + radius
    # These joints lie within a voxel each: 0.312 m and 1.412 m from where the border at 0 is, give or take the gap.
    turn_x, far_x = x + half + radius, x + half + radius + 1.10
    side_x, first_y = far_x + half + radius, y + half + radius
    end_y = first_y + 0.90
    segments = (
        (_straight((x, y, low), (x, y, z - half), style, _TWIST), "pipe"),
        (_bend((x, y, z + half), (x, y, axis), (x + radius, y, axis), style), "elbow"),
        (_straight((turn_x + half, y, axis), (far_x - half, y, axis), style), "pipe"),
        (_bend((far_x + half, y, axis), (side_x, y, axis), (side_x, y + radius, axis), style), "elbow"),
        (_straight((side_x, first_y + half, axis), (side_x, end_y, axis), style), "pipe"),
    )
    pipes = [Component(c.solid, "Pipe assembly", name, style.color("pipe"), c.pose) for c, name in segments]
    under = axis - PIPES[_DN].radius
    steel = style.color("steel")
    frame = (
        Component(box((0.50, 0.50, low), (x, y, low / 2)), "Structural element", "base plate", steel),
        Component(
            box((0.12, 0.12, under + 0.002), (side_x, end_y - 0.20, under / 2 + 0.001)),
            "Structural element",
            "column",
            steel,
        ),
    )
    contacts = ((0, 1), (1, 2), (2, 3), (3, 4), (0, 5), (4, 6))
    whole = Assembly((*pipes, *frame), contacts).marked(cluster="bent pipe").placed(at(0, 0, shift))
    return Plant(whole.components, whole.contacts, name="bent pipe", styles=(style.name,), looseness=_ROOT_GAP)


def _straight(start: tuple[float, ...], end: tuple[float, ...], style: ModelingStyle, twist: float = 0.0) -> Component:
    """A straight segment whose corners are turned about its axis [rad]."""
    size, way = PIPES[_DN], np.subtract(end, start)
    length = float(np.linalg.norm(way))
    solid = tube(np.array([[0.0, 0.0, 0.0], [length, 0.0, 0.0]]), size.radius, size.bore, _SIDES)
    return Component(solid, "Pipe assembly", "pipe", style.color("pipe"), looking(start, way) @ spun("x", twist))


def _bend(
    start: tuple[float, ...], corner: tuple[float, ...], end: tuple[float, ...], style: ModelingStyle
) -> Component:
    size = PIPES[_DN]
    solid = tube(arc(start, corner, end, 4), size.radius, size.bore, _SIDES)
    return Component(solid, "Pipe assembly", "elbow", style.color("pipe"))


_SHELL, _CLEARANCE = 1.20, 0.40  # m, of both tanks
_RADII = (0.60, 0.57)  # m
_APART = 1.90  # m, of the tanks' axes
_LINE_DN, _MANWAY_DN = 50, 300


def make_platform_and_tanks(gap: float = 0.016) -> Plant:
    """Two tanks joined by a pipe, and a platform that stands apart from them.

    The platform's outer face and the first tank's shell lie on either side of a border between voxels, both as far
    from it. With a gap of 1 to 2 cm the snapped points are exactly 1 cm apart, which is the paper's limit: one edge
    joins two structures that nothing connects.

    Args:
        gap: between the platform and the first tank [m]; the second one stands 3 cm further away.

    Returns:
        The plant with its truth: two clusters, ``tanks`` and ``platform``, if the gap is more than 1 cm.
    """
    style = STYLES["plant-design"]
    # The shell ends between the lower and the upper edge of the floor's frame, so only one edge comes near it.
    height, length, width = 2.05, 3.60, 1.20
    # The border runs through y = 0: the shell begins above it, the platform ends below it. In x the tank's corner
    # next to the platform and the points along the platform's edge lie in the middle of their voxels.
    y = gap / 2 + _RADII[0]
    poses = (at(VOXEL / 2, y, 0), at(VOXEL / 2 + _APART, y, 0))
    vessels = [
        _vessel(f"T-{k + 1}", style, radius, angle)
        for k, (radius, angle) in enumerate(zip(_RADII, (0.0, np.pi), strict=True))
    ]
    n_first = len(vessels[0].assembly.components)
    n_both = n_first + len(vessels[1].assembly.components)
    line = _line(poses[0] @ vessels[0].faces[0], poses[1] @ vessels[1].faces[0], style)
    per_end = (len(line.components) - 3) // 2
    joints = []
    for tail, (flange_of_tank, flange_of_line) in enumerate(
        ((vessels[0].flanges[0], 0), (n_first + vessels[1].flanges[0], 1))
    ):
        studs = range(n_both + 3 + tail * per_end, n_both + 3 + (tail + 1) * per_end)
        joints.append((flange_of_tank, n_both + flange_of_line))
        for near, far in clamping(studs, style):
            joints += [(flange_of_tank, near), (n_both + flange_of_line, far)]
    placed = [vessel.assembly.placed(pose) for vessel, pose in zip(vessels, poses, strict=True)]
    tanks = gather([*placed, line], joints).marked(cluster="tanks")
    deck = Platform(length=length, width=width, floor=height, opened=False, opening=0.0).as_assembly(style)
    floor = deck.placed(at(_APART / 2, -gap / 2 - width / 2, 0))
    whole = gather([tanks, floor.marked(cluster="platform")])
    return Plant(whole.components, whole.contacts, whole.units, name="platform and tanks", styles=(style.name,))


def _vessel(name: str, style: ModelingStyle, radius: float, angle: float) -> Tank:
    nozzles = (
        Nozzle(_LINE_DN, "side", (angle, 0.90), 0.15),
        Nozzle(_MANWAY_DN, "side", (np.pi / 2, 0.55), 0.15, manway=True),
        Nozzle(_LINE_DN, "top", (0.0, 0.0), 0.12),
    )
    openings = tuple(map(Opening.of, nozzles))
    upright = ManwayTank(radius=radius, height=_SHELL, clearance=_CLEARANCE, legs=4, nozzles=openings)
    return upright.tank(name, style)


def _line(start: Floats, end: Floats, style: ModelingStyle) -> Assembly:
    """Flange, flange, pipe between two faces that look at each other, then the bolts of both joints."""
    neck, plate = flange_length(_LINE_DN, style), plate_thickness(_LINE_DN)
    length = float(np.linalg.norm(end[:3, 3] - start[:3, 3])) - 2 * neck
    pieces = [flange(_LINE_DN, style).placed(face) for face in (start, end)]
    pieces.append(pipe(_LINE_DN, length, style).placed(start @ at(neck)))
    pieces += [bolts(_LINE_DN, 2 * plate, style).placed(face @ at(-plate)) for face in (start, end)]
    return gather(pieces, [(0, 2), (1, 2)])
