"""How a hand gets at a wheel or a lever: where it grips, and from which direction it meets nothing on the way."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from cadgraph.geometry.visibility.clear import clear_between
from cadgraph.model.parts import Bools
from cadgraph.model.records import Mechanism, Point, points
from cadgraph.model.scene import Floats, Scene
from cadgraph.simulate.tasks.records import Hand, Ring

__all__ = ["Hands", "ring_of"]

_WAY = 0.4  # m of free way before the grasp
_HAND = 0.05  # m; half the width of a hand with a glove on
_SHORT = 0.02  # m; so far before the grasp the outer lines of a hand end, as it closes there
_GRIPS = 16  # places on a rim that are tried
_TILTS = (0.0, 20.0, 40.0, 60.0, 80.0)  # degrees off the axis
_TURNS = 8  # directions about the axis at each tilt
_SHOULDER = 1.4  # m above where one stands
_RIM = 0.8  # share of the radius from which on the rim of a wheel begins
_LEVER_GRIP = 0.85  # of a lever's length: the middle of a hand that ends where the lever does


class Hands:
    """Ways for a hand in a plant.

    Args:
        scene: all its meshes.
    """

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._index = {path: number for number, path in enumerate(scene.paths)}

    def find(self, mechanism: Mechanism, stand: Point | None) -> tuple[Ring, Hand | None, int]:
        """The ring that a hand grips and a free way to it: the straightest, of these the nearest to who stands there.

        Args:
            mechanism: a wheel or lever; what moves of it is in nobody's way.
            stand: on the floor [m].

        Returns:
            The ring, the way or None where every one meets something, and how many were tried.
        """
        moving = [self._index[mesh] for mesh in mechanism.meshes if mesh in self._index]
        ring = ring_of(mechanism, self._vertices(mechanism, moving))
        grips = self._grips(ring, mechanism, moving)
        shoulder = np.asarray(stand if stand is not None else ring.center) + np.array([0.0, 0.0, _SHOULDER])
        tried = 0
        for tilt in _TILTS:
            grasps, directions = _ways(ring, grips, tilt)
            clear = self._clear(grasps, directions, moving)
            tried += len(clear)
            away = np.round(np.linalg.norm(grasps - _WAY * directions - shoulder, axis=1), 6)
            free = np.flatnonzero(clear)
            if len(free):
                best = int(free[np.argmin(away[free])])
                grasp, direction = points([grasps[best], directions[best]])
                return ring, Hand(grasp=grasp, direction=direction, tilt=tilt, free=_WAY), tried
        return ring, None, tried

    @cached_property
    def _boxes(self) -> Floats:
        """``(n_meshes, 2, 3)`` boxes of all meshes."""
        scene = self._scene
        starts = scene.vertex_offsets[:-1]
        ends = [np.minimum.reduceat(scene.vertices, starts), np.maximum.reduceat(scene.vertices, starts)]
        boxes: Floats = np.stack(ends, axis=1)
        return boxes

    def _vertices(self, mechanism: Mechanism, moving: Sequence[int]) -> Floats:
        """The corners of what moves, in the world; none where it is only a piece of a mesh."""
        if mechanism.pieces or not moving:
            return np.zeros((0, 3))
        return np.concatenate([self._scene.mesh(number)[0] for number in moving]) + self._scene.origin

    def _grips(self, ring: Ring, mechanism: Mechanism, moving: Sequence[int]) -> Floats:
        """``(n, 3)`` where a hand may grip: all round a wheel, at the end of a lever."""
        axis = np.asarray(ring.axis)
        across, beside = _square_to(axis)
        if ring.kind == "lever":
            vertices = self._vertices(mechanism, moving) - np.asarray(ring.center)
            flat = vertices - np.outer(vertices @ axis, axis)
            if len(flat):
                far = flat[int(np.argmax(np.round(np.linalg.norm(flat, axis=1), 9)))]
                end: Floats = np.asarray(ring.center) + ring.radius * far / np.linalg.norm(far)
                return end[None]
        turns = np.radians(np.arange(_GRIPS) * 360.0 / _GRIPS)[:, None]
        rim: Floats = np.asarray(ring.center) + ring.radius * (np.cos(turns) * across + np.sin(turns) * beside)
        return rim

    def _clear(self, grasps: Floats, directions: Floats, moving: Sequence[int]) -> Bools:
        """``(n,)`` whether a hand that comes along a direction to a grasp meets nothing."""
        starts, ends = _lines(grasps - self._scene.origin, directions)
        low, high = np.minimum(starts, ends).min(axis=0), np.maximum(starts, ends).max(axis=0)
        near = ((self._boxes[:, 0] <= high) & (self._boxes[:, 1] >= low)).all(axis=1)
        near[list(moving)] = False
        clear = clear_between(self._scene, np.flatnonzero(near).astype(np.int64), starts, ends)
        free: Bools = np.asarray(clear.reshape(len(grasps), -1).all(axis=1))
        return free


def ring_of(mechanism: Mechanism, vertices: Floats) -> Ring:
    """The circle that a hand grips.

    Args:
        mechanism: a wheel or lever.
        vertices: ``(n, 3)`` of what moves, in the world [m]; none: the circle is about the pivot.

    Raises:
        ValueError: the mechanism is a needle, which nobody grips.
    """
    if mechanism.kind == "needle":
        raise ValueError("nobody grips a needle")
    axis, pivot = np.asarray(mechanism.axis), np.asarray(mechanism.pivot)
    radius = mechanism.radius * (_LEVER_GRIP if mechanism.kind == "lever" else 1.0)
    height = 0.0
    if len(vertices):
        along = (vertices - pivot) @ axis
        away = np.linalg.norm(vertices - pivot - np.outer(along, axis), axis=1)
        rim = along[away >= _RIM * mechanism.radius]
        height = float((rim.min() + rim.max()) / 2) if len(rim) else 0.0
    center, unit = points([pivot + height * axis, axis])
    return Ring(kind=mechanism.kind, center=center, axis=unit, radius=round(radius, 9), thickness=mechanism.thickness)


def _ways(ring: Ring, grips: Floats, tilt: float) -> tuple[Floats, Floats]:
    """The ways that are so far off the axis [deg]: grasps ``(n, 3)`` and directions ``(n, 3)``."""
    axis = np.asarray(ring.axis)
    across, beside = _square_to(axis)
    turns = np.radians(np.arange(_TURNS if tilt else 1) * 360.0 / _TURNS)[:, None]
    sides = np.cos(turns) * across + np.sin(turns) * beside
    directions = -(np.cos(np.radians(tilt)) * axis + np.sin(np.radians(tilt)) * sides)
    return np.repeat(grips, len(directions), axis=0), np.tile(directions, (len(grips), 1))


def _lines(grasps: Floats, directions: Floats) -> tuple[Floats, Floats]:
    """The lines that stand for a hand on its way, some 25 mm apart: one in the middle, two rings about it."""
    n = len(grasps)
    starts, ends = np.empty((n, 19, 3)), np.empty((n, 19, 3))
    rings = [(_HAND / 2, np.arange(6) * 60.0 + 15.0), (_HAND, np.arange(12) * 30.0)]
    flat = [(away * np.cos(turn), away * np.sin(turn)) for away, turns in rings for turn in np.radians(turns)]
    offsets = np.array([(0.0, 0.0), *flat])
    for way, (grasp, direction) in enumerate(zip(grasps, directions, strict=True)):
        across, beside = _square_to(direction)
        about = offsets @ np.array([across, beside])
        starts[way] = grasp - _WAY * direction + about
        ends[way] = grasp - _SHORT * direction + about
    return starts.reshape(-1, 3), ends.reshape(-1, 3)


def _square_to(axis: Floats) -> tuple[Floats, Floats]:
    """Two unit vectors square to one and to each other, the same for the same axis."""
    least = np.zeros(3)
    least[int(np.argmin(np.round(np.abs(axis), 6)))] = 1.0
    across = np.cross(axis, least)
    across /= np.linalg.norm(across)
    return across, np.cross(axis, across)
