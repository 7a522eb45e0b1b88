"""What moves in a plant, as a simulator needs it: pose, mass, friction, limits, and what a hand can grip."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from cadgraph.geometry.mesh.pieces import pieces_of
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Dial, Mechanism, Unit, points
from cadgraph.model.scene import Faces, Floats, Scene
from cadgraph.query.mechanisms import Immovable, immovable, joint_names

__all__ = ["DRAWN_BY", "Capsule", "Device", "Moving", "find_devices", "grip", "needle_over", "without_joint"]

Bools = npt.NDArray[np.bool_]

DENSITY = 7850.0
"""Of what moves [kg/m3]: steel."""
SHEET = 0.003
"""Thickness of a surface that is not closed [m]; ours."""
ARMATURE = 0.02
"""Added to the inertia about each joint [kg m2]; ours: below it, light levers stick in one engine, shake in another."""
RIM_FORCE, LEVER_FORCE = 40.0, 60.0
"""What starts a wheel at its rim, a lever at its end [N]; ours."""
BRISK = 5.0
"""Speed at which a valve brakes twice as hard as at rest [rad/s]; ours: most people turn a wheel slower than that."""
DRAWN_BY = "'cadgraph simulate --needles'"
"""What draws a needle that the source lacks, for whoever uses the command line."""
SWEEP = 270.0
"""How far a needle goes over its dial [deg], clockwise from half past seven (EN 837-1)."""
_LEAST_MASS, _LEAST_INERTIA = 0.005, 1e-6
_RIM_CAPSULES, _SPOKES = 16, 4
_LIFT = 0.02  # of a dial's radius: a needle of ours above the face, so that neither hides the other


@dataclass(frozen=True)
class Moving:
    """A mesh of the scene that moves, whole or in part.

    Args:
        mesh: its number in the scene.
        faces: ``(n_faces,)`` which of its triangles move; None where all do.
    """

    mesh: int
    faces: Bools | None = None


@dataclass(frozen=True)
class Capsule:
    """A cylinder with round ends, in the frame of the body that it belongs to.

    Args:
        start: middle of one end [m].
        end: middle of the other [m].
        radius: [m].
    """

    start: tuple[float, float, float]
    end: tuple[float, float, float]
    radius: float


@dataclass(frozen=True, eq=False)
class Device:
    """One joint of a plant: what turns about it, and how hard.

    The frame of its body stands at the pivot, with z along the axis, and is turned as drawn at angle 0.

    Args:
        unit: that it works.
        joint: name of the joint and of the body: the tag, as names in USD and MJCF may be.
        mechanism: what moves, about which axis, how far.
        turn: ``(3, 3)`` the axes of the body's frame as rows, in the scene.
        pivot: ``(3,)`` in the scene, relative to its origin [m].
        moving: the meshes that move; none where the needle is drawn by us.
        mass: [kg].
        inertia: ``(3,)`` about the axes of the body's frame at the pivot [kg m2].
        friction: torque that starts it, and that brakes it [N m].
        damping: torque that brakes it more the faster it turns [N m s/rad].
        armature: what is added to the inertia about the axis [kg m2].
        low: least height of the rim or lever along the axis, from the pivot [m].
        high: greatest height [m].
        why: the reasons of mass and friction, by their names.
    """

    unit: Unit
    joint: str
    mechanism: Mechanism
    turn: Floats
    pivot: Floats
    moving: tuple[Moving, ...]
    mass: float
    inertia: Floats
    friction: float
    damping: float
    armature: float
    low: float
    high: float
    why: dict[str, str] = field(default_factory=dict)

    @property
    def is_needle(self) -> bool:
        """Whether it shows something, rather than being turned by hand."""
        return self.mechanism.kind == "needle"

    def local(self, scene: Scene, moving: Moving) -> tuple[Floats, Faces]:
        """What moves of a mesh, in the frame of the body: vertices ``(n, 3)`` [m] and faces ``(m, 3)``."""
        vertices, faces = scene.mesh(moving.mesh)
        if moving.faces is not None:
            used, corners = np.unique(faces[moving.faces], return_inverse=True)
            vertices, faces = vertices[used], corners.reshape(-1, 3).astype(np.int32)
        placed: Floats = (vertices - self.pivot) @ self.turn.T
        return placed, faces


def find_devices(graph: SceneGraph, scene: Scene, needles: bool = False) -> tuple[Device, ...]:
    """The joints of a plant, in the order of its units.

    Args:
        graph: whose units say what moves.
        scene: that it was made from.
        needles: whether gauges without a needle get one, where their dial is known.

    Raises:
        ValueError: the graph names a mesh that the scene doesn't have.
    """
    row = {path: i for i, path in enumerate(scene.paths)}
    names = joint_names(graph)
    found = []
    for unit in graph.of_layer(Unit):
        mechanism = unit.mechanism
        if mechanism is None and needles and unit.dial is not None:
            mechanism = needle_over(unit.dial)
        if mechanism is not None:
            found.append(_device(unit, names[unit.id], mechanism, scene, row))
    return tuple(found)


def without_joint(graph: SceneGraph, devices: Sequence[Device], drawn_by: str = DRAWN_BY) -> tuple[Immovable, ...]:
    """The valves that nobody can turn and the gauges whose needle doesn't move, each with the reason.

    Args:
        graph: of a plant.
        devices: the joints that were found in it.
        drawn_by: what draws a needle where its dial is known.
    """
    joined = {device.unit.id for device in devices}
    remedy = f"; {drawn_by} draws one"
    gauges = tuple(
        Immovable(unit.id, unit.tag, "no needle in the source" + ("" if unit.dial is None else remedy))
        for unit in graph.of_layer(Unit)
        if unit.id not in joined and "read" in unit.affordances
    )
    return (*immovable(graph), *gauges)


def needle_over(dial: Dial) -> Mechanism:
    """A needle that is not in the source, at the start of a dial's scale; its ``meshes`` hold an empty path."""
    normal = np.asarray(dial.normal)
    pivot, axis = points([np.asarray(dial.center) + _LIFT * dial.radius * normal, normal])
    return Mechanism(
        kind="needle",
        meshes=("",),
        axis=axis,
        pivot=pivot,
        radius=0.8 * dial.radius,
        thickness=None,
        limits=(-SWEEP, 0.0),
        sources={
            "axis": "normal of the dial",
            "limits": "assumed: 270 degrees, clockwise from half past seven",
            "meshes": "drawn: the source has no needle",
        },
    )


def _device(unit: Unit, joint: str, mechanism: Mechanism, scene: Scene, row: dict[str, int]) -> Device:
    axis = np.asarray(mechanism.axis, np.float64)
    pivot = np.asarray(mechanism.pivot, np.float64) - scene.origin
    moving = () if mechanism.meshes == ("",) else tuple(_moving(unit, mechanism, scene, row))
    placed = [_selected(scene, each) for each in moving]
    turn = _frame(axis / np.linalg.norm(axis), _towards(unit, mechanism, placed, pivot))
    local = [((vertices - pivot) @ turn.T, faces) for vertices, faces in placed]
    mass, inertia, why = _moments(local)
    low, high = _heights(local, mechanism.radius)
    lever, needle = mechanism.kind == "lever", mechanism.kind == "needle"
    force = 0.0 if needle else LEVER_FORCE if lever else RIM_FORCE
    if not needle:
        why["friction"] = f"assumed: {force:g} N at the {'end of the lever' if lever else 'rim'} start it"
        why["damping"] = f"assumed: at {BRISK:g} rad/s as much as the friction"
        why["armature"] = f"assumed: {ARMATURE:g} kg m2, of stem and gear"
    return Device(
        unit=unit,
        joint=joint,
        mechanism=mechanism,
        turn=turn,
        pivot=pivot,
        moving=moving,
        mass=mass,
        inertia=inertia,
        friction=force * mechanism.radius,
        damping=force * mechanism.radius / BRISK,
        armature=0.001 if needle else ARMATURE,
        low=low,
        high=high,
        why=why,
    )


def _moving(unit: Unit, mechanism: Mechanism, scene: Scene, row: dict[str, int]) -> list[Moving]:
    missing = [mesh for mesh in mechanism.meshes if mesh not in row]
    if missing:
        raise ValueError(f"{unit.tag} turns mesh {missing[0]!r}, which is not in the scene: pass the same scene")
    found = []
    for mesh in mechanism.meshes:
        faces = None
        if mechanism.pieces:
            faces = np.isin(pieces_of(*scene.mesh(row[mesh])), mechanism.pieces)
            if not faces.any():
                raise ValueError(f"{unit.tag} turns pieces of mesh {mesh!r} that it doesn't have: build the graph anew")
            faces = None if faces.all() else faces
        found.append(Moving(row[mesh], faces))
    return found


def _selected(scene: Scene, moving: Moving) -> tuple[Floats, Faces]:
    vertices, faces = scene.mesh(moving.mesh)
    return vertices, faces if moving.faces is None else faces[moving.faces]


def _towards(unit: Unit, mechanism: Mechanism, placed: Sequence[tuple[Floats, Faces]], pivot: Floats) -> Floats:
    """Where x of the body's frame is to point: along a lever or needle; of a wheel, wherever."""
    axis = np.asarray(mechanism.axis)
    if mechanism.kind in ("lever", "needle") and placed:
        used = np.concatenate([vertices[np.unique(faces)] for vertices, faces in placed]) - pivot
        across = used - np.outer(used @ axis, axis)
        reach = np.linalg.norm(across, axis=1)
        # Its very end is a face or an edge, whose middle says where it points.
        way: Floats = across[reach >= 0.98 * reach.max()].mean(axis=0)
        return way
    if not placed and unit.dial is not None:
        # Half past seven, seen from the front: 135 degrees anticlockwise of twelve.
        up, start = np.asarray(unit.dial.up), np.deg2rad(0.5 * SWEEP)
        way = np.cos(start) * up - np.sin(start) * np.cross(up, axis)
        return way
    way = np.zeros(3)
    way[int(np.argmin(np.round(np.abs(axis), 6)))] = 1.0
    return way


def _frame(axis: Floats, towards: Floats) -> Floats:
    x = towards - (towards @ axis) * axis
    length = np.linalg.norm(x)
    if length < 1e-9:
        other = np.zeros(3)
        other[int(np.argmin(np.round(np.abs(axis), 6)))] = 1.0
        x = other - (other @ axis) * axis
        length = np.linalg.norm(x)
    x = x / length
    return np.array([x, np.cross(axis, x), axis])


def _moments(local: Sequence[tuple[Floats, Faces]]) -> tuple[float, Floats, dict[str, str]]:
    """Mass and the moments of inertia about the axes of the body's frame, of closed surfaces by volume."""
    mass, inertia = 0.0, np.zeros(3)
    closed = True
    for vertices, faces in local:
        corners = vertices[faces]
        solid = _is_closed(vertices, faces)
        closed &= solid
        share = _volumes(corners) if solid else _areas(corners) * SHEET
        # With the fourth corner of each tetrahedron at the pivot, or none of a triangle.
        n = 20.0 if solid else 12.0
        total = corners.sum(axis=1)
        squares = ((corners**2).sum(axis=1) + total**2) / n
        second = np.abs((share[:, None] * squares).sum(axis=0)) * DENSITY
        mass += abs(float(share.sum())) * DENSITY
        inertia += second.sum() - second
    how = "volume" if closed else f"volume, of open surfaces area at {1000 * SHEET:g} mm"
    why = {"mass": f"{how}, at {DENSITY:g} kg/m3 (assumed: steel)", "inertia": "as the mass; its middle on the axis"}
    return max(mass, _LEAST_MASS), np.maximum(inertia, _LEAST_INERTIA), why


def _volumes(corners: Floats) -> Floats:
    volumes: Floats = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    return volumes


def _areas(corners: Floats) -> Floats:
    areas: Floats = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    return areas


def _is_closed(vertices: Floats, faces: Faces) -> bool:
    """Whether each edge is met as often one way as the other, by positions."""
    _, spot = np.unique(vertices, axis=0, return_inverse=True)
    corners = spot.reshape(-1)[faces]
    corners = corners[(corners != np.roll(corners, 1, axis=1)).all(axis=1)]
    edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    forward = edges[:, 0] < edges[:, 1]
    _, number = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True)
    return len(edges) > 0 and not np.bincount(number.reshape(-1), np.where(forward, 1.0, -1.0)).any()


def _heights(local: Sequence[tuple[Floats, Faces]], radius: float) -> tuple[float, float]:
    """From where to where along the axis lies what a hand grips: what is far from the axis."""
    used = [vertices[np.unique(faces)] for vertices, faces in local]
    if not used:
        return 0.0, 0.0
    corners = np.concatenate(used)
    reach = np.hypot(corners[:, 0], corners[:, 1])
    far = corners[reach >= min(0.9 * radius, float(reach.max())), 2]
    return float(far.min()), float(far.max())


def grip(device: Device) -> tuple[Capsule, ...]:
    """Capsules that stand for what a hand can grip: rim and spokes of a wheel, the arm of a lever; none of a needle.

    A ring of capsules costs an engine nothing and leaves the wheel open between its spokes, which hulls would not.
    """
    mechanism, height = device.mechanism, 0.5 * (device.low + device.high)
    thick = mechanism.thickness or min(0.5 * (device.high - device.low), 0.15 * mechanism.radius) or 0.01
    if mechanism.kind == "needle":
        return ()
    if mechanism.kind == "lever":
        return (Capsule((0.0, 0.0, height), (mechanism.radius - thick, 0.0, height), thick),)
    angles = 2 * np.pi * np.arange(_RIM_CAPSULES) / _RIM_CAPSULES
    rim = [
        (float(x), float(y), height)
        for x, y in mechanism.radius * np.round(np.column_stack([np.cos(angles), np.sin(angles)]), 12)
    ]
    ring = [Capsule(a, b, thick) for a, b in zip(rim, [*rim[1:], rim[0]], strict=True)]
    step = _RIM_CAPSULES // _SPOKES
    return (*ring, *(Capsule((0.0, 0.0, height), end, 0.6 * thick) for end in rim[::step]))
