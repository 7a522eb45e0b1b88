"""Small pictures of what one looks at closely in a film: dials from the front, wheels and levers, pumps."""

from __future__ import annotations

import math

import numpy as np
from PIL import Image

from cadgraph.draw.render.camera import Camera, frame
from cadgraph.draw.render.color import from_hex, source_colors
from cadgraph.draw.render.picture import Look, Paint, Renderer
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Unit
from cadgraph.model.scene import Floats, Scene
from cadgraph.simulate.play.film import Film
from cadgraph.simulate.play.posing import Posing
from cadgraph.simulate.play.scenery import FLOWING, OPERATED, STILL

__all__ = ["Closeup"]

_LOOK = Look(samples=3, sky_rays=2, floor=False, top="#ffffff", bottom="#e9edf2")
_STEP = 1.0  # deg: a needle on a dial of a hundred pixels moves by less than one
_DIAL = 1.5  # needle lengths: how much round the middle of a dial is shown
_NEEDLE = "#d62a1e"
_ASKEW = math.radians(40.0)  # between the axis of a wheel or lever and the look at it
_WAY_ROUND = 24
_LEAST_FLOW = 0.1 / 3600  # m3/s


class Closeup:
    """Draws one unit of a film.

    Args:
        graph: the finished graph.
        scene: of it, as prepared for building.
        film: what the plant does.
        unit: what is shown.
        size: width and height of a picture [px].

    Raises:
        ValueError: nothing of it can be drawn.
    """

    def __init__(self, graph: SceneGraph, scene: Scene, film: Film, unit: Unit, size: int) -> None:
        self.unit, self.film = unit, film
        row = {path: number for number, path in enumerate(scene.paths)}
        paths = [path for part in unit.parts for path in graph.part(part).meshes]
        self._scene = scene.select(sorted(row[path] for path in paths if path in row))
        self._posing = Posing(self._scene, graph)
        self._joint = self._posing.joint_of.get(unit.id)
        if self._joint not in film.states[0].joints:
            self._joint = None
        self._renderer = Renderer(self._scene)
        self._camera = self._look_at(size)
        self._drawn: dict[tuple[int, bool], Image.Image] = {}

    def picture(self, number: int, runs: bool = False) -> Image.Image:
        """The picture with this number of the film.

        Args:
            number: of it.
            runs: whether it is a pump that moves something.
        """
        steps = 0 if self._joint is None else round(self.film.states[number].joints[self._joint] / _STEP)
        if (steps, runs) not in self._drawn:
            self._drawn[steps, runs] = self._draw(steps * _STEP, runs)
        return self._drawn[steps, runs]

    def _draw(self, angle: float, runs: bool) -> Image.Image:
        renderer, colors = self._renderer, source_colors(self._scene)
        if self.unit.unit_type == "pump":
            colors[:] = from_hex(FLOWING if runs else STILL)
        if self._joint is not None:
            mover = self._posing.movers[self._joint]
            renderer = Renderer(self._posing.turned({self._joint: angle}))
            colors[mover.meshes] = from_hex(_NEEDLE if mover.mechanism.kind == "needle" else OPERATED)
        return renderer.picture(self._camera, Paint(colors), _LOOK)

    def _look_at(self, size: int) -> Camera:
        unit, origin = self.unit, self._scene.origin
        if unit.unit_type == "gauge":
            seen = self._dial()
            if seen is not None:
                center, normal, radius = seen
                return frame(_disc(center - origin, normal, radius), normal, (size, size), margin=0.02)
        if unit.mechanism is not None:
            axis = np.asarray(unit.mechanism.axis)
            across = np.cross(axis, (0.0, 0.0, 1.0) if abs(axis[2]) < 0.9 else (0.35, -0.94, 0.0))
            across /= np.linalg.norm(across)
            lifted = across if abs(axis[2]) >= 0.9 else 0.7 * across + np.array([0.0, 0.0, 0.7])
            direction = math.cos(_ASKEW) * axis + math.sin(_ASKEW) * lifted / np.linalg.norm(lifted)
            points = np.concatenate([self._renderer.points(), self._swept()])
            return frame(points, direction, (size, size), margin=0.04)
        return frame(self._renderer.points(), (0.6, -1.0, 0.7), (size, size), margin=0.04)

    def _swept(self) -> Floats:
        """Where what turns comes to stand in the film, so that it stays within the picture."""
        if self._joint is None:
            return np.zeros((0, 3))
        mover, angles = self._posing.movers[self._joint], self.film.angles(self._joint)
        points = self._scene.vertices[mover.vertices]
        turns = np.linspace(float(angles.min()), float(angles.max()), 5)
        return np.concatenate([mover.turned(points, angle, self._scene.origin) for angle in turns])

    def _dial(self) -> tuple[Floats, Floats, float] | None:
        """The middle of the dial, the way it looks, and the radius to show."""
        unit = self.unit
        if unit.dial is not None:
            return np.asarray(unit.dial.center), np.asarray(unit.dial.normal), 1.12 * unit.dial.radius
        if unit.mechanism is not None:
            found = unit.mechanism
            return np.asarray(found.pivot), np.asarray(found.axis), _DIAL * found.radius
        if unit.access is not None and unit.access.facing is not None:
            facing = np.asarray(unit.access.facing)
            points = self._renderer.points() + self._scene.origin
            reach = points @ facing
            front = points[reach >= np.quantile(reach, 0.8)]
            low, high = front.min(axis=0), front.max(axis=0)
            return (low + high) / 2, facing, float(np.linalg.norm(high - low)) / 2
        return None


def _disc(center: Floats, normal: Floats, radius: float) -> Floats:
    """Points round a disc."""
    side = np.cross(normal, (0.0, 0.0, 1.0) if abs(normal[2]) < 0.9 else (0.0, 1.0, 0.0))
    side /= np.linalg.norm(side)
    angles = np.linspace(0, 2 * math.pi, _WAY_ROUND, endpoint=False)
    ring: Floats = center + radius * (np.cos(angles)[:, None] * side + np.sin(angles)[:, None] * np.cross(normal, side))
    return ring
