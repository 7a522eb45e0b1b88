"""Dials and their needles: flat, slim, across the axis of the dial."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.model.mechanisms import FoundDial, FoundMechanism
from cadgraph.model.places import UnitAccess
from cadgraph.model.scene import Floats
from cadgraph.stages.mechanisms.body import Body, Frame, frame_of, unit_vector

__all__ = ["SPAN", "dial_of", "needle_of"]

SPAN = 135.0
"""Degrees from twelve to the ends of a scale, either way (EN 837-1): it begins at half past seven."""

# A plate is thin and round, across the dial, and as wide as the face within these shares.
_THIN, _ACROSS, _ROUND, _WIDE = 0.3, 0.97, 0.88, (0.4, 1.15)
# A needle is long against its width, lies in the dial (sine), is no higher than this share of its length, reaches out
# of its middle by shares of the face's radius, and is not longer than the face is wide.
_SLIM, _LIES, _FLAT, _REACHES, _LONGEST = 2.2, 0.2, 0.2, (0.3, 1.05), 1.9
_ONE_SIDED = 1.2  # its tip is farther from the axis than its tail by this factor
_BESIDE = 0.08  # of the face's radius; how far its line passes the axis at most
_LEVEL = 0.9  # a dial that looks up or down more than this has no up of its own (cosine)
_CALLED, _PLATE = "gauge needle", "gauge face"
_Point = tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class _Needle:
    body: Body
    tip: float
    way: Floats


def dial_of(access: UnitAccess, bodies: Sequence[Body]) -> FoundDial | None:
    """The dial of a gauge; None where it has no face.

    Args:
        access: with its face.
        bodies: its meshes, else the pieces of its one mesh.
    """
    if access.facing is None or access.face is None or access.face_radius is None:
        return None
    normal, center, radius = np.asarray(access.facing), np.asarray(access.face), access.face_radius
    plate = _plate(bodies, frame_of(center, normal), radius)
    if plate is not None:
        axis = plate.axes[0] * np.sign(plate.axes[0] @ normal)
        frame = frame_of(plate.center, axis)
        flat = frame.flat(plate.points)
        middle = 0.5 * (flat.min(axis=0) + flat.max(axis=0))
        normal = axis
        radius = float(frame.away(plate.points).max())
        # Its surface's middle is that of a plate with ticks or holes all around; its corners' are of one with some.
        center = plate.center + (middle @ frame.across if float(np.linalg.norm(middle)) < 0.02 * radius else 0.0)
        center = center + (float(frame.height(plate.points).max())) * axis
    return FoundDial(_triple(center), _triple(normal), radius, _triple(_up(normal, access)))


def needle_of(dial: FoundDial, bodies: Sequence[Body]) -> FoundMechanism | None:
    """The needle over a dial; None where none is a body of its own."""
    frame = frame_of(np.asarray(dial.center), np.asarray(dial.normal))
    near = [body for body in bodies if body.reach > _REACHES[0] * dial.radius]
    found = [one for body in near if (one := _needle(body, frame, dial.radius)) is not None]
    if not found:
        return None
    best = max(found, key=lambda one: (_CALLED in one.body.names, round(one.tip, 6), one.body.area))
    height = float(frame.height(best.body.center[None])[0])
    pivot = frame.origin + height * frame.axis
    up = np.asarray(dial.up)
    across = np.cross(frame.axis, up)
    # Anticlockwise from twelve as drawn.
    drawn = float(np.degrees(np.arctan2(best.way @ across, best.way @ up)))
    return FoundMechanism(
        kind="needle",
        meshes=best.body.meshes,
        pieces=best.body.pieces,
        axis=dial.normal,
        pivot=_triple(pivot),
        radius=best.tip,
        thickness=None,
        limits=(_degrees(-SPAN - drawn), _degrees(SPAN - drawn)),
        sources={
            "axis": "square to the dial, through its middle",
            "limits": "assumed: scale of 270 degrees, clockwise from half past seven (the greatest angle) to half past "
            "four (the least)",
        },
    )


def _plate(bodies: Sequence[Body], frame: Frame, radius: float) -> Body | None:
    """The plate of a dial: of several the one that is called so, else the widest behind the front."""
    found = []
    for body in bodies:
        # Marks of the scale are many, and none of them a plate.
        if body.reach < _WIDE[0] * radius or abs(float(body.axes[0] @ frame.axis)) < _ACROSS:
            continue
        own = frame_of(body.center, body.axes[0])
        points = body.points
        wide, high = float(own.away(points).max()), float(np.ptp(own.height(points)))
        aside = float(frame.away(body.center[None])[0])
        turns = 2 * np.pi * np.arange(16) / 16
        reach = (own.flat(points) @ np.array([np.cos(turns), np.sin(turns)])).max(axis=0)
        if (
            high <= _THIN * wide
            and _WIDE[0] * radius <= wide <= _WIDE[1] * radius
            and aside <= 0.3 * radius
            and float(reach.min()) >= _ROUND * wide
        ):
            found.append((_PLATE in body.names and len(bodies) > 1, -high / wide, wide, body))
    return max(found, key=lambda one: one[:3])[3] if found else None


def _needle(body: Body, frame: Frame, radius: float) -> _Needle | None:
    """A body as a needle of a dial of some radius."""
    high, wide, long = np.sort(body.extents).tolist()
    if long < _SLIM * wide or high > _FLAT * long or long > _LONGEST * radius:
        return None
    axis = body.axes[2]
    if abs(float(axis @ frame.axis)) > _LIES:
        return None
    flat = frame.flat(body.points)
    way = frame.flat((frame.origin + axis)[None])[0]
    way = way / np.linalg.norm(way)
    along, aside = flat @ way, flat @ np.array([-way[1], way[0]])
    beside = abs(0.5 * float(aside.min() + aside.max()))
    if beside > max(_BESIDE * radius, 0.25 * wide) or float(frame.away(body.points).max()) > _REACHES[1] * radius:
        return None
    tip, tail = float(along.max()), -float(along.min())
    if tail > tip:
        tip, tail, way = tail, tip, -way
    if tip < max(_REACHES[0] * radius, _ONE_SIDED * tail) or tail < -0.1 * tip:
        return None
    return _Needle(body, tip, way @ frame.across)


def _up(normal: Floats, access: UnitAccess) -> Floats:
    """Where twelve stands: upwards, on a dial that looks up away from the one who reads it."""
    if abs(float(normal[2])) < _LEVEL:
        up = np.array([0.0, 0.0, 1.0])
    elif access.viewpoint is not None and access.face is not None:
        up = np.asarray(access.face) - np.asarray(access.viewpoint)
    else:
        up = np.array([0.0, 1.0, 0.0])
    flat = up - (up @ normal) * normal
    if float(np.linalg.norm(flat)) < 1e-6:
        flat = np.array([0.0, 1.0, 0.0]) - normal[1] * normal
    return unit_vector(flat)


def _degrees(angle: float) -> float:
    return round(angle, 6)


def _triple(values: Floats) -> _Point:
    x, y, z = values.tolist()
    return x, y, z
