"""The pictures of a plant in a film: what is operated, where it flows, and where it stands still."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from PIL import Image

from cadgraph.draw.colors import BACKDROP
from cadgraph.draw.render.annotation import Tag, annotate
from cadgraph.draw.render.camera import Camera, frame
from cadgraph.draw.render.color import Colors, from_hex
from cadgraph.draw.render.picture import Look, Paint, Renderer
from cadgraph.draw.render.views import three_quarter_view
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Connected, Junction, Terminal, Unit
from cadgraph.model.scene import Floats, Ints, Scene
from cadgraph.simulate.play.film import Film
from cadgraph.simulate.play.posing import Posing

__all__ = ["FLOWING", "OPERATED", "STILL", "Scenery"]

FLOWING, STILL, OPERATED = "#2f80e0", "#8d97a3", "#f0701e"
"""Colours of what the fluid flows through, of pipework where it stands still, and of what somebody operates."""

_LEAST_FLOW = 0.1 / 3600  # m3/s; less looks like standing still
_GAUGE = "#20913e"
_AROUND = 0.35  # of the diagonal of what matters: how far round it the plant is shown
_LEAST_AROUND = 1.0  # m
_MARGIN = 0.13  # of the picture that is left free at each side, for tags and what stands around
_LEAST_SHIFT = 1.0  # [px] what moves less in the picture stays as it is drawn
_STEP = 0.4  # [px] movements are drawn in such steps
_LOOK = Look(samples=2, sky_rays=2, top="#ffffff", bottom="#e9edf2")


@dataclass(frozen=True)
class _Turning:
    """What is seen to turn: its joint, and by what angle it has to turn to be seen elsewhere [deg]."""

    joint: str
    step: float


class Scenery:
    """Draws the plant of a film from one place.

    Args:
        graph: the finished graph.
        scene: of it, as prepared for building.
        film: what the plant does.
        focus: tags of the units that have to be seen, the most important first.
        size: width and height of the pictures [px].
    """

    def __init__(
        self, graph: SceneGraph, scene: Scene, film: Film, focus: Sequence[str], size: tuple[int, int]
    ) -> None:
        self.graph, self.film = graph, film
        units = [graph.unit(tag) for tag in focus]
        chosen = _region(scene, units)
        self.scene = scene.select(chosen)
        self.posing = Posing(self.scene, graph)
        self._row = {path: number for number, path in enumerate(self.scene.paths)}
        self._renderer = Renderer(self.scene)
        self.camera = self._camera(units, size)
        self._units = units
        self._operated = set(film.tags)
        self._turning = self._find_turning()
        self._flowing_of = self._pipework()
        self._drawn: dict[tuple[tuple[int, ...], bytes], Image.Image] = {}

    def pictures(self, numbers: Iterable[int]) -> dict[int, Image.Image]:
        """The pictures with these numbers, by number; poses and colours that repeat are drawn once."""
        looks = {number: (self._pose(number), self._paint(number)) for number in numbers}
        keys = {number: (pose, paint.colors.tobytes()) for number, (pose, paint) in looks.items()}
        new: dict[tuple[int, ...], dict[bytes, Paint]] = {}
        for number, (pose, paint) in looks.items():
            if keys[number] not in self._drawn:
                new.setdefault(pose, {})[keys[number][1]] = paint
        for pose, paints in new.items():
            images = self._posed(pose).pictures(self.camera, list(paints.values()), _LOOK)
            for key, image in zip(paints, images, strict=True):
                self._drawn[pose, key] = self._tagged(image)
        return {number: self._drawn[key] for number, key in keys.items()}

    def _pose(self, number: int) -> tuple[int, ...]:
        joints = self.film.states[number].joints
        return tuple(round(joints[one.joint] / one.step) for one in self._turning)

    def _posed(self, pose: Sequence[int]) -> Renderer:
        angles = {one.joint: steps * one.step for one, steps in zip(self._turning, pose, strict=True)}
        meshes = [self.posing.movers[one.joint].meshes for one in self._turning]
        if not meshes:
            return self._renderer
        return self._renderer.moved(self.posing.turned(angles), np.concatenate(meshes))

    def _find_turning(self) -> list[_Turning]:
        """What is seen to move in the film; needles rarely are, from so far away."""
        found = []
        for joint, mover in self.posing.movers.items():
            if joint not in self.film.states[0].joints:
                continue
            _, depth = self.camera.project([np.asarray(mover.mechanism.pivot) - self.scene.origin])
            pixels = mover.mechanism.radius / (float(depth[0]) * self.camera.pixel_size) if depth[0] > 0 else 0.0
            angles = self.film.angles(joint)
            swept = np.radians(float(np.ptp(np.append(angles, 0.0))))
            if pixels * swept >= _LEAST_SHIFT:
                found.append(_Turning(joint, max(0.5, float(np.degrees(_STEP / pixels)))))
        return found

    def _camera(self, units: Sequence[Unit], size: tuple[int, int]) -> Camera:
        meshes = self._meshes([part for unit in units for part in unit.parts])
        direction = three_quarter_view(self._renderer, meshes if len(meshes) else None, aspect=size[0] / size[1])
        corners = np.concatenate([_corners(unit.aabb, self.scene.origin) for unit in units])
        points = self._renderer.points(meshes) if len(meshes) else corners
        return frame(points, direction, size, margin=_MARGIN)

    def _meshes(self, parts: Iterable[str]) -> Ints:
        rows = {self._row[path] for part in parts for path in self.graph.part(part).meshes if path in self._row}
        return np.array(sorted(rows), np.int64)

    def _pipework(self) -> list[tuple[Ints, frozenset[int]]]:
        """Meshes with the connections of which any flow makes them flow, too."""
        at: dict[str, set[int]] = {}
        found = []
        for index, edge in enumerate(self.graph.of_kind(Connected)):
            found.append((self._meshes(edge.via), frozenset([index])))
            for end in (edge.source, edge.target):
                at.setdefault(end, set()).add(index)
        for name, indices in at.items():
            node = self.graph.nodes[name]
            if isinstance(node, Junction | Terminal) or (isinstance(node, Unit) and node.unit_type in _PASSED):
                found.append((self._meshes(node.parts), frozenset(indices)))
        return found

    def _paint(self, number: int) -> Paint:
        """The colours of a picture: pipework by its flow, above it what is operated."""
        flow = self.film.states[number].flow
        colors: Colors = np.tile(from_hex(BACKDROP), (self.scene.n_meshes, 1))
        flowing = []
        for meshes, indices in self._flowing_of:
            moves = any(abs(flow.get(index, 0.0)) >= _LEAST_FLOW for index in indices)
            if moves:
                flowing.append(meshes)
            else:
                colors[meshes] = from_hex(STILL)
        # What both flows and stands still, as a branch that is shut, shows the flow.
        for meshes in flowing:
            colors[meshes] = from_hex(FLOWING)
        for tag in self._operated:
            unit = self.graph.unit(tag)
            mover = self.posing.movers.get(self.posing.joint_of.get(unit.id, ""))
            if mover is not None:
                colors[mover.meshes] = from_hex(OPERATED)
        return Paint(colors)

    def _tagged(self, image: Image.Image) -> Image.Image:
        """With the tags of what matters; always the same, so that they stand still in a film."""
        tags = [Tag(_position(unit, self.scene.origin), unit.tag, _color(unit, self._operated)) for unit in self._units]
        return annotate(image, self.camera, tags=tags, size=_LETTERS * 800 / image.height * image.width / 480).image


_PASSED = ("valve", "pump", "equipment")
_LETTERS = 0.8


def _color(unit: Unit, operated: set[str]) -> str:
    if unit.tag in operated:
        return OPERATED
    return _GAUGE if unit.unit_type == "gauge" else STILL


def _position(unit: Unit, origin: Floats) -> tuple[float, float, float]:
    point = unit.mechanism.pivot if unit.mechanism is not None else unit.centroid
    x, y, z = (np.asarray(point) - origin).tolist()
    return x, y, z


def _corners(box: npt.ArrayLike, origin: Floats) -> Floats:
    low, high = np.asarray(box, np.float64) - origin
    corners: Floats = np.array(np.meshgrid(*zip(low, high, strict=True))).reshape(3, -1).T
    return corners


def _region(scene: Scene, units: Sequence[Unit]) -> Ints:
    """The meshes that stand near some units."""
    corners = np.concatenate([_corners(unit.aabb, scene.origin) for unit in units])
    low, high = corners.min(axis=0), corners.max(axis=0)
    around = max(_LEAST_AROUND, _AROUND * float(np.linalg.norm(high - low)))
    drawn = np.flatnonzero(np.diff(scene.face_offsets) > 0)
    first = scene.vertex_offsets[drawn]
    # Meshes without faces own vertices, too: what they add to the box before them only draws a mesh too many.
    least, greatest = np.minimum.reduceat(scene.vertices, first), np.maximum.reduceat(scene.vertices, first)
    near: Ints = drawn[((greatest >= low - around) & (least <= high + around)).all(axis=1)]
    return near
