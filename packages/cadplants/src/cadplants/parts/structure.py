"""Frames, posts and casters."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.model.plant import Assembly, Component, gather
from cadplants.model.standards import SECTIONS
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved, revolve, shared, weld
from cadplants.solids.polygon import circle, rounded_rectangle, section_channel, section_i
from cadplants.solids.transforms import at, looking, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["CASTER_HEIGHT", "CHANNEL_WIDTH", "DECK_HEIGHT", "DECK_INSET", "beam", "caster", "column", "deck", "post"]

CASTER_HEIGHT = 0.135  # m, of a swivel caster with a 100 mm wheel (EN 12532)
CHANNEL_WIDTH = 0.042  # m, flange width of the frame's channels
DECK_INSET = 0.045  # m
DECK_HEIGHT = 0.086  # m, plate and channels
_WHEEL = 0.05
_TREAD = 0.032


@shared
def _caster_solids() -> tuple[Solid, Solid, Solid]:
    """Fork with its plate, wheel and axle; the plate's top at z = 0, the swivel's axis on z."""
    trail, gap = 0.028, 0.036
    axle = -(CASTER_HEIGHT - _WHEEL)
    holes = tuple(circle(0.0055, 12, (x, y)) for x in (-0.04, 0.04) for y in (-0.03, 0.03))
    plate = extrude(rounded_rectangle(0.105, 0.085, 0.010, 3), -0.004, 0.0, holes)
    race = weld([revolve([(0, -0.018), (0.026, -0.018), (0.033, -0.010), (0.033, -0.004), (0, -0.004)], 24)])
    crown = extrude(rounded_rectangle(0.070, gap + 0.006, 0.008, 3), -0.022, -0.018)
    cheek = np.array(
        [
            [0.030, -0.020], [-0.030, -0.020], [trail - 0.014, axle + 0.004], [trail - 0.012, axle - 0.010],
            [trail, axle - 0.015], [trail + 0.012, axle - 0.010], [trail + 0.014, axle + 0.004],
        ]
    )  # fmt: skip
    side = extrude(cheek, 0.0, 0.003, (circle(0.006, 12, (trail, axle)),))
    stand = spun("x", np.pi / 2)
    cheeks = [moved(side, at(0, y, 0) @ stand) for y in (gap / 2 + 0.003, -gap / 2)]
    fork = merge([plate, race, crown, *cheeks])
    w, r = _TREAD / 2, _WHEEL
    shape = [
        (0.006, -gap / 2),
        (0.013, -gap / 2),
        (0.013, -w),
        (0.030, -w * 0.6),
        (0.036, -w),
        (r - 0.004, -w),
        (r, -w * 0.6),
    ]
    profile = shape + [(radius, -z) for radius, z in reversed(shape)]
    turned = at(trail, 0, axle) @ stand
    wheel = moved(weld([revolve(profile, 32, closed=True)]), turned)
    half = gap / 2 + 0.003
    axle_profile = [(0, -half - 0.006), (0.011, -half - 0.006), (0.011, -half), (0.006, -half)]
    axle_profile += [(radius, -z) for radius, z in reversed(axle_profile)]
    pin = moved(weld([revolve(axle_profile, 12)]), turned)
    return fork, wheel, pin


def caster(style: ModelingStyle, turn: float = 0.0) -> Assembly:
    """A swivel caster under z = 0, turned about z [rad]: fork, wheel and axle."""
    fork, wheel, pin = _caster_solids()
    group = "Structural element"
    components = (
        Component(fork, group, "caster", style.color("clamp")),
        Component(wheel, group, "caster", style.color("rubber")),
        Component(pin, "Connection assembly", "bolt", style.color("fastener")),
    )
    return Assembly(components, ((0, 1), (0, 2), (1, 2))).placed(spun("z", turn))


@shared
def _channel_solid(length: float, height: float) -> Solid:
    """A channel along z about its middle, web on x = 0, open to +x; flanges 42 mm wide."""
    return extrude(section_channel(height, CHANNEL_WIDTH, 0.006, 0.007), -length / 2, length / 2)


def _beam_pose(x: Floats, origin: tuple[float, float, float]) -> Floats:
    """Lays a section with its x axis along the unit vector ``x`` and its y axis upright."""
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1] = x, (0.0, 0.0, 1.0)
    pose[:3, 2], pose[:3, 3] = np.cross(x, (0.0, 0.0, 1.0)), origin
    return pose


def deck(length: float, width: float, style: ModelingStyle, thick: float = 0.006, height: float = 0.08) -> Assembly:
    """A plate with round corners, its top at z = 0, on two channels with three cross members between them.

    Returns:
        Plate, the two long channels, then the cross members. Casters go under the long channels, whose underside is
        at z = -(thick + height) and whose webs stand ``DECK_INSET`` inside the plate's long edges.
    """
    group, color = "Structural element", style.color("steel")
    plate = extrude(rounded_rectangle(length, width, 0.09, 8), -thick, 0.0)
    level = -thick - height / 2
    rail = width / 2 - DECK_INSET
    long_beam = _channel_solid(length - 0.20, height)
    cross_beam = _channel_solid(2 * (rail - CHANNEL_WIDTH), height)
    components = [Component(plate, group, "skid frame", color)]
    contacts = []
    for sign in (-1.0, 1.0):
        components.append(
            Component(
                long_beam,
                group,
                "skid frame",
                color,
                _beam_pose(np.array([0.0, -sign, 0.0]), (0.0, sign * rail, level)),
            )
        )
        contacts.append((0, len(components) - 1))
    for x in (-0.26 * length, 0.0, 0.26 * length):
        pose = _beam_pose(np.array([1.0, 0.0, 0.0]), (x, 0.0, level))
        components.append(Component(cross_beam, group, "skid frame", color, pose))
        contacts += [(0, len(components) - 1), (1, len(components) - 1), (2, len(components) - 1)]
    return Assembly(tuple(components), tuple(contacts))


@shared
def _post_solid(height: float, side: float, wall: float) -> Solid:
    outer = rounded_rectangle(side, side, 2 * wall, 4)
    inner = rounded_rectangle(side - 2 * wall, side - 2 * wall, wall, 4)
    return extrude(outer, 0.0, height, (inner,))


def post(
    height: float, style: ModelingStyle, side: float = 0.05, wall: float = 0.003, capped: bool = False
) -> Assembly:
    """A square hollow post (EN 10219-2) on a base plate at z = 0, its top at ``height``: base plate, post, head plate.

    Args:
        height: of the whole [m].
        style: that models it.
        side: of the section [m].
        wall: of the section [m].
        capped: whether a head plate closes it, to carry something.
    """
    group, color = "Structural element", style.color("steel")
    thick = 0.008
    lid = thick if capped else 0.0
    components = [
        Component(_base_solid(round(side + 0.07, 6), thick, 0.0065), group, "base plate", color),
        Component(_post_solid(round(height - thick - lid, 6), side, wall), group, "post", color, at(0, 0, thick)),
    ]
    if capped:
        head = _base_solid(round(side + 0.03, 6), thick, 0.0)
        components.append(Component(head, group, "plate", color, at(0, 0, height - thick)))
    return Assembly(tuple(components), tuple((i, i + 1) for i in range(len(components) - 1)))


@shared
def _base_solid(width: float, thick: float, hole: float) -> Solid:
    reach = width / 2 - 0.015
    holes = tuple(circle(hole, 12, (x, y)) for x in (-reach, reach) for y in (-reach, reach)) if hole else ()
    return extrude(rounded_rectangle(width, width, 0.01, 3), 0.0, thick, holes)


@shared
def _section_solid(height: float, width: float, web: float, flange: float, length: float) -> Solid:
    return extrude(section_i(height, width, web, flange), 0.0, length)


def beam(start: Floats, end: Floats, style: ModelingStyle, size: str = "HEA 100", name: str = "beam") -> Assembly:
    """A rolled H or I section between two points of its axis, its web upright.

    Args:
        start: ``(3,)`` [m].
        end: likewise.
        style: that models it.
        size: a key of ``SECTIONS``.
        name: ``beam``, ``column`` or ``brace``.
    """
    start, end = np.asarray(start, float), np.asarray(end, float)
    frame = looking(start, end - start)
    # The section lies in x (flange width) and y (height) and runs along z.
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2], pose[:3, 3] = frame[:3, 1], frame[:3, 2], frame[:3, 0], start
    solid = _section_solid(*SECTIONS[size], round(float(np.linalg.norm(end - start)), 9))
    return Assembly((Component(solid, "Structural element", name, style.color("steel"), pose),))


def column(height: float, style: ModelingStyle, size: str = "HEA 120") -> Assembly:
    """A column on a base plate at z = 0, its top at ``height``: base plate, column."""
    thick = 0.015
    width = round(max(SECTIONS[size][:2]) + 0.10, 6)
    base = Component(_base_solid(width, thick, 0.009), "Structural element", "base plate", style.color("steel"))
    shaft = beam(np.array([0, 0, thick]), np.array([0, 0, height]), style, size, "column")
    return gather([Assembly((base,)), shaft], [(0, 1)])
