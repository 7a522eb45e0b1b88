"""Ways to walk: platforms with gratings, stairs and railings (EN ISO 14122 dimensions)."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.model.plant import Assembly, Component, gather
from cadplants.parts.structure import column
from cadplants.solids.mesh_ops import Solid, box, extrude, lattice, shared, tube
from cadplants.solids.polygon import section_channel
from cadplants.solids.transforms import at, looking, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["grating", "ladder", "platform", "platform_with_stairs", "railing", "stairs"]

_RAIL = 0.0212  # m, radius of a 42.4 mm tube
_KNEE = 0.0169  # m, radius of a 33.7 mm tube
_RAIL_HEIGHT = 1.10  # m, EN ISO 14122-3: top of the handrail
_BITE = 0.0005  # m; welded tubes run this deep into each other
_CHANNEL = 0.06  # m, flange width of the floor's channels (UPE 140)
_GROUP = "Structural element"


@shared
def _grating_solid(length: float, width: float, thick: float) -> Solid:
    """Bearing bars along x every 33.3 mm, cross bars every 100 mm, in a frame of flat bars."""

    def lines(span: float, pitch: float, bar: float) -> Floats:
        count = max(2, round(span / pitch) + 1)
        middles = np.linspace(bar / 2, span - bar / 2, count)
        return np.sort(np.concatenate([middles - bar / 2, middles + bar / 2])) - span / 2

    xs, ys = lines(length, 0.100, 0.005), lines(width, 0.0333, 0.003)
    filled = np.zeros((len(xs) - 1, len(ys) - 1), bool)
    filled[::2, :] = True
    filled[:, ::2] = True
    return lattice(xs, ys, filled, -thick, 0.0)


def grating(length: float, width: float, style: ModelingStyle, thick: float = 0.03, name: str = "grating") -> Assembly:
    """A grating panel about the origin, its top at z = 0."""
    if style.sides[1] <= 16:
        solid = box((length, width, thick), (0, 0, -thick / 2))
    else:
        solid = _grating_solid(round(length, 6), round(width, 6), thick)
    return Assembly((Component(solid, _GROUP, name, style.color("clamp")),))


@shared
def _bar_solid(length: float, radius: float, sides: int) -> Solid:
    return tube(np.array([[0.0, 0.0, 0.0], [length, 0.0, 0.0]]), radius, 0.0, sides)


def railing(start: Floats, end: Floats, style: ModelingStyle) -> Assembly:
    """Posts at most 1.2 m apart, handrail, knee rail and toe plate along a line on a floor.

    Args:
        start: ``(3,)`` on the floor [m].
        end: likewise; the line may rise, as along stairs (then without toe plate).
        style: that models it.

    Returns:
        The posts first, in order.
    """
    start, end = np.asarray(start, float), np.asarray(end, float)
    run = end - start
    length = float(np.linalg.norm(run))
    sloped = abs(run[2]) > 1e-6
    count = max(2, int(np.ceil(length / 1.2)) + 1)
    color = style.color("safety")
    sides = min(style.round(_RAIL), 16)
    slope = run / length
    across = float(np.hypot(slope[0], slope[1]))
    top = _RAIL_HEIGHT - _RAIL
    parts, contacts = [], []
    feet = [start + run * (0.04 / length + k * (1 - 0.08 / length) / (count - 1)) for k in range(count)]
    height = top - _RAIL / across + _BITE * 3
    upright = _bar_solid(round(height, 9), _RAIL, sides)
    for foot in feet:
        parts.append(Component(upright, _GROUP, "post", color, at(*foot) @ spun("y", -np.pi / 2)))
    rail = looking(start + np.array([0, 0, top]), run)
    parts.append(Component(_bar_solid(round(length, 9), _RAIL, sides), _GROUP, "railing", color, rail))
    contacts += [(k, count) for k in range(count)]
    for k in range(count - 1):
        inset = (_RAIL - 2 * _BITE) / across
        low, high = feet[k] + slope * inset, feet[k + 1] - slope * inset
        span = round(float(np.linalg.norm(high - low)), 9)
        pose = looking(low + np.array([0, 0, 0.5 * _RAIL_HEIGHT]), run)
        parts.append(Component(_bar_solid(span, _KNEE, sides), _GROUP, "railing", color, pose))
        contacts += [(k, len(parts) - 1), (k + 1, len(parts) - 1)]
    if not sloped:
        side = looking(start, run) @ at(length / 2, _RAIL + 0.002 - _BITE, 0.06)
        parts.append(Component(box((length, 0.004, 0.10)), _GROUP, "railing", color, side))
        contacts += [(k, len(parts) - 1) for k in range(count)]
    return Assembly(tuple(parts), tuple(contacts))


@shared
def _channel_solid(length: float) -> Solid:
    return extrude(section_channel(0.14, _CHANNEL, 0.007, 0.010), 0.0, length)


def _channel(start: Floats, end: Floats, style: ModelingStyle) -> Component:
    """A channel along a line; its web's back on the line, open to the left of it, its middle at the line's height."""
    frame = looking(start, end - start)
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2], pose[:3, 3] = frame[:3, 1], frame[:3, 2], frame[:3, 0], start
    length = round(float(np.linalg.norm(end - start)), 9)
    return Component(_channel_solid(length), _GROUP, "beam", style.color("steel"), pose)


def platform(length: float, width: float, height: float, style: ModelingStyle, gap_at: float | None = None) -> Assembly:
    """A platform about z on four columns: frame of channels, gratings of a metre, railing all round.

    Args:
        length: along x [m].
        width: along y [m].
        height: of the floor over z = 0 [m].
        style: that models it.
        gap_at: x of the middle of an opening of 0.9 m for stairs in the railing of the side y < 0, or None.

    Returns:
        Columns with their base plates first, then the frame.
    """
    panel = 0.03
    frame_top = height - panel
    size = "HEA 120"
    half = 0.06
    x, y = length / 2, width / 2
    parts: list[Assembly] = []
    joints: list[tuple[int, int]] = []
    for sx in (-1, 1):
        for sy in (-1, 1):
            parts.append(column(frame_top - 0.14, style, size).placed(at(sx * (x - 0.15), sy * (y - half), 0)))
    z = frame_top - 0.07
    # Two long channels on the columns, their webs outward; cross beams between their flanges under the panels' joints.
    sides = [
        _channel(np.array([-x, -y, z]), np.array([x, -y, z]), style),
        _channel(np.array([x, y, z]), np.array([-x, y, z]), style),
    ]
    parts.append(Assembly(tuple(sides)))
    frame = 8
    joints += [(1, frame), (5, frame), (3, frame + 1), (7, frame + 1)]
    count = max(1, round(length))
    step = length / count
    index = frame + 2
    crosses = []
    for k in range(count + 1):
        at_x = -x + k * step
        at_x += 0.06 if k == 0 else -0.06 if k == count else 0.0
        solid = box((0.06, 2 * (y - _CHANNEL), 0.14), (at_x, 0, z))
        parts.append(Assembly((Component(solid, _GROUP, "beam", style.color("steel")),)))
        crosses.append(index)
        joints += [(frame, index), (frame + 1, index)]
        index += 1
    for k in range(count):
        panel_part = grating(step, width, style, panel).placed(at(-x + (k + 0.5) * step, 0, height))
        parts.append(panel_part)
        joints += [(frame, index), (frame + 1, index), (crosses[k], index), (crosses[k + 1], index)]
        if k:
            joints.append((index - 1, index))
        index += 1
    first_panel = index - count
    for rail in _guard(x, y, height, style, gap_at):
        parts.append(rail)
        for k, piece in enumerate(rail.components):
            if piece.name == "post":
                place = float(piece.pose[0, 3]) + x
                joints += [
                    (first_panel + j, index + k)
                    for j in range(count)
                    if j * step - _RAIL <= place <= (j + 1) * step + _RAIL
                ]
        index += len(rail.components)
    return gather(parts, joints)


def _guard(x: float, y: float, height: float, style: ModelingStyle, gap_at: float | None) -> list[Assembly]:
    """Railings along the edges of a floor that reaches to +-x and +-y, with an opening in the side y < 0."""
    inset = 0.05
    far, side, near = x - inset, y - inset, x - inset - 0.06
    stretches = [((far, -side), (far, side)), ((-far, side), (-far, -side)), ((near, side), (-near, side))]
    front = [(-near, near)] if gap_at is None else [(-near, gap_at - 0.45), (gap_at + 0.45, near)]
    stretches += [((a, -side), (b, -side)) for a, b in front if b - a > 0.3]
    return [railing(np.array([*a, height]), np.array([*b, height]), style) for a, b in stretches]


def stairs(height: float, style: ModelingStyle, width: float = 0.80) -> Assembly:
    """Stairs that climb along +x from z = 0 to ``height`` at x = 0, 38 degrees steep.

    Returns:
        The two stringers first; their upper ends stand in the plane x = 0.
    """
    count = max(2, round(height / 0.19))
    rise = height / count
    going = rise / np.tan(np.radians(38))
    reach = going * (count - 1) + 0.16
    deep = 0.20
    outline = np.array(
        [[-reach, 0.0], [-reach + deep * 1.2, 0.0], [0.0, height - deep], [0.0, height], [-0.12, height]]
    )
    plate = extrude(outline, 0.0, 0.008)
    color = style.color("steel")
    stand = spun("x", np.pi / 2)
    parts = [
        Assembly(
            (
                Component(plate, _GROUP, "beam", color, at(0, width / 2 + 0.008, 0) @ stand),
                Component(plate, _GROUP, "beam", color, at(0, -width / 2, 0) @ stand),
            )
        )
    ]
    joints = []
    index = 2
    for k in range(1, count):
        # The nosing stands 2 cm out of the stringers' upper edge.
        x = -reach + (reach - 0.12) * k / count + 0.10
        tread = grating(0.24, width, style, 0.03, "stair tread").placed(at(x, 0, k * rise))
        parts.append(tread)
        joints += [(0, index), (1, index)]
        index += 1
    return gather(parts, joints)


def platform_with_stairs(length: float, width: float, height: float, style: ModelingStyle, gap: float) -> Assembly:
    """A platform about z with stairs up to an opening in the railing of its side y < 0.

    Args:
        length: along x [m].
        width: along y [m].
        height: of the floor over z = 0 [m].
        style: that models it.
        gap: x of the middle of the opening [m].
    """
    floor = platform(length, width, height, style, gap)
    steps = stairs(height, style)
    up = steps.placed(at(gap, -width / 2, 0) @ spun("z", np.pi / 2))
    front = next(i for i, c in enumerate(floor.components) if c.name == "beam")
    gratings = [i for i, c in enumerate(floor.components) if c.name == "grating"]
    n = len(floor.components)
    joints = []
    for stringer in (0, 1):
        low, high = _span(up.components[stringer].vertices)
        joints.append((front, n + stringer))
        for i in gratings:
            g_low, g_high = _span(floor.components[i].vertices)
            if high >= g_low - 1e-9 and low <= g_high + 1e-9:
                joints.append((i, n + stringer))
    return gather([floor, up], joints)


def _span(vertices: Floats) -> tuple[float, float]:
    return float(vertices[:, 0].min()), float(vertices[:, 0].max())


def ladder(height: float, style: ModelingStyle, width: float = 0.42) -> Assembly:
    """A fixed ladder in the plane y = 0 up from z = 0, its rungs along x (EN ISO 14122-4).

    Args:
        height: of the floor that it leads to; its stiles end 1.1 m above that [m].
        style: that models it.
        width: between the stiles [m].

    Returns:
        The two stiles first, then the rungs from below.
    """
    color = style.color("safety")
    sides = min(style.round(0.0125), 12)
    count = max(2, round(height / 0.28))
    rung = _bar_solid(round(width + 0.004, 9), 0.0125, sides)
    parts = [
        Component(
            box((0.012, 0.06, height + 1.1), (s * (width / 2 + 0.006), 0, (height + 1.1) / 2)), _GROUP, "ladder", color
        )
        for s in (-1, 1)
    ]
    parts += [
        Component(rung, _GROUP, "ladder", color, at(-width / 2 - 0.002, 0, height * k / count))
        for k in range(1, count + 1)
    ]
    return Assembly(tuple(parts), tuple((s, 2 + k) for k in range(count) for s in (0, 1)))
