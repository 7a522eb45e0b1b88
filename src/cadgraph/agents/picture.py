"""A picture of one thing in a plant: itself in red, what it hangs together with tagged, all else grey."""

from __future__ import annotations

import io
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.agents.answer import Answer, AskError, cell, page_of
from cadgraph.agents.measuring import compass
from cadgraph.agents.plant import Plant
from cadgraph.draw.colors import BACKDROP, RELATION
from cadgraph.draw.render.annotation import Mark, Tag, annotate
from cadgraph.draw.render.camera import Camera, frame
from cadgraph.draw.render.color import from_hex
from cadgraph.draw.render.picture import Paint, Renderer
from cadgraph.draw.render.views import three_quarter_view
from cadgraph.model.records import Cluster, Contains, Junction, Node, Part, Place, Point, System, Terminal, Unit
from cadgraph.model.scene import Ints, Scene
from cadgraph.stages.preprocess import prepare_scene

__all__ = ["SIZE", "Picture", "Pictures", "picture"]

SIZE = (768, 576)
"""Width and height of a picture [px]: models look at no more than about that."""

_NEIGHBOR = "#7fb2e5"
_AROUND = 0.75  # of its diagonal: what is shown round the target
_LEAST_AROUND = 0.4  # m
_MOST_TAGS = 16
_LEAST_SEEN = 0.35  # of what the target alone would fill; below, what stands before it is only hinted at
_EVERY = 4  # pixels between rays that find out how much of the target is seen


@dataclass(frozen=True)
class Picture(Answer):
    """A drawn picture, and in words what it shows.

    Args:
        png: its bytes.
    """

    png: bytes = b""


class Pictures:
    """Draws pictures of one plant; the first takes longest, as it looks at the whole scene.

    Args:
        plant: what is drawn.
        scene: that its graph was made from.

    Raises:
        AskError: it has nothing to draw.
    """

    def __init__(self, plant: Plant, scene: Scene) -> None:
        if not scene.n_triangles:
            raise AskError("the scene of this graph has no triangles, so there is no picture of it")
        self.plant, self.scene = plant, scene

    def now(self, plant: Plant) -> Pictures:
        """Those of another graph of the same scene; what was worked out of the scene is kept."""
        other = Pictures(plant, self.scene)
        other.__dict__ |= {name: self.__dict__[name] for name in ("_renderer", "_mesh_number") if name in self.__dict__}
        return other

    @classmethod
    def of(cls, plant: Plant) -> Pictures:
        """Those of a plant whose scene still lies where it was built from.

        Raises:
            AskError: it doesn't, or has changed since.
            LoadError: it can't be read.
        """
        scene = plant.scene
        if scene is None:
            raise AskError(
                "no picture: the file that this graph was built from isn't where it was, or has changed; "
                "put it beside graph.json, or build the graph again"
            )
        return cls(plant, prepare_scene(scene)[0])

    @cached_property
    def _renderer(self) -> Renderer:
        return Renderer(self.scene)

    @cached_property
    def _mesh_number(self) -> dict[str, int]:
        return {path: number for number, path in enumerate(self.scene.paths)}

    def draw(self, target: str) -> Picture:
        """Draws one thing of the plant.

        Args:
            target: tag or id of a unit, part, junction, end, structure, system or level, or the source path of a mesh.

        Raises:
            AskError: nothing is called so, or there is nothing of it to be drawn.
        """
        plant = self.plant
        node = plant.find(target)
        meshes = self._meshes(plant, _parts_of(plant, node))
        around = _neighbors(plant, node)
        points = self._points(node, meshes)
        near = self._meshes(plant, [part for other in around for part in _parts_of(plant, other)])
        near = np.setdiff1d(near, meshes)
        camera, hinted = self._camera(meshes, near, points)
        colors = np.tile(from_hex(BACKDROP), (self.scene.n_meshes, 1))
        colors[near], colors[meshes] = from_hex(_NEIGHBOR), from_hex(RELATION)
        image = self._renderer.picture(camera, Paint(colors, ghosted=hinted))
        marks = [] if len(meshes) else [Mark(_tuple(points.mean(axis=0)), RELATION)]
        tags = [Tag(_tuple(points.mean(axis=0)), plant.called(node.id), RELATION)]
        shown = [other for other in around if _within(camera, self._local(_point_of(other)))]
        tags += [Tag(self._local(_point_of(other)), plant.called(other.id), _NEIGHBOR) for other in shown[:_MOST_TAGS]]
        drawn = annotate(image, camera, marks=marks, tags=tags)
        file = io.BytesIO()
        drawn.image.save(file, "PNG", optimize=True)
        outside = [other for other in around if other not in shown]
        values = {
            "target": plant.called(node.id),
            "size": list(SIZE),
            "seen_from": compass(-camera.forward[0], -camera.forward[1]),
            "degrees_from_above": math.degrees(math.asin(float(-camera.forward[2]))),
            "neighbors": [plant.called(other.id) for other in shown],
            "outside": [plant.called(other.id) for other in outside],
            "untagged": 1 + len(shown) - drawn.tagged,
            "others_faint": hinted is not None,
        }
        return Picture(page_of([], _told(values), [], 1), values, file.getvalue())

    def _meshes(self, plant: Plant, parts: Iterable[Part]) -> Ints:
        """The meshes of parts that have triangles, ascending."""
        rows = {self._mesh_number[path] for part in parts for path in part.meshes if path in self._mesh_number}
        sizes = np.diff(self.scene.face_offsets)
        return np.array(sorted(row for row in rows if sizes[row]), np.int64)

    def _points(self, node: Node, meshes: Ints) -> npt.NDArray[np.float64]:
        """What has to be in the picture: the target's vertices, else the point where it is."""
        if len(meshes):
            return self._renderer.points(meshes)
        return np.array([self._local(_point_of(node))], np.float64)

    def _camera(
        self, meshes: Ints, near: Ints, points: npt.NDArray[np.float64]
    ) -> tuple[Camera, npt.NDArray[np.bool_] | None]:
        """A camera that shows the target with its surroundings; and what is only hinted at, if anything has to be."""
        low, high = points.min(axis=0), points.max(axis=0)
        grown = max(_LEAST_AROUND, _AROUND * float(np.linalg.norm(high - low)))
        corners = np.array(np.meshgrid(*zip(low - grown, high + grown, strict=True))).reshape(3, -1).T
        if not len(meshes):
            return frame(corners, (0.5, -1.0, 0.6), SIZE), None
        aspect = SIZE[0] / SIZE[1]
        camera = frame(corners, three_quarter_view(self._renderer, meshes, aspect=aspect), SIZE)
        if self._share_seen(camera, meshes) >= _LEAST_SEEN:
            return camera, None
        hinted = np.ones(self.scene.n_meshes, bool)
        hinted[meshes] = hinted[near] = False
        kept = np.concatenate([meshes, near])
        seen = frame(corners, three_quarter_view(self._renderer, kept, alone=True, aspect=aspect), SIZE)
        return seen, hinted

    def _share_seen(self, camera: Camera, meshes: Ints) -> float:
        """How much of a target is seen among all meshes, of what would be if it stood alone."""
        rows, columns = (each.ravel() for each in np.mgrid[0 : camera.height : _EVERY, 0 : camera.width : _EVERY])
        origins, directions = camera.rays(columns + 0.5, rows + 0.5)
        towards = directions.astype(np.float32)
        alone, everything = self._renderer.caster(meshes), self._renderer.caster()
        by_itself = alone.first(alone.local(origins), towards).face >= 0
        if not by_itself.any():
            return 1.0
        face = everything.first(everything.local(origins[by_itself]), towards[by_itself]).face
        return float(np.isin(self._renderer.mesh_of_face[face[face >= 0]], meshes).sum() / by_itself.sum())

    def _local(self, point: Point) -> Point:
        return _tuple(np.asarray(point) - self.scene.origin)


def picture(plant: Plant, target: str) -> Picture:
    """Draws one thing of a plant; :class:`Pictures` is quicker for several.

    Args:
        plant: that holds it; its scene is read.
        target: tag or id, or the source path of a mesh.

    Raises:
        AskError: nothing is called so, or there is no scene to draw it from.
        LoadError: the scene can't be read.
    """
    plant.find(target)
    return Pictures.of(plant).draw(target)


def _parts_of(plant: Plant, node: Node) -> list[Part]:
    """The parts that make up a node."""
    if isinstance(node, Part):
        return [node]
    if isinstance(node, Cluster):
        return plant.graph.parts(cluster=node.id)
    if isinstance(node, System):
        inner = (plant.graph.nodes[one] for one in (*node.units, *node.junctions, *node.terminals))
        return [part for one in inner for part in _parts_of(plant, one)]
    if isinstance(node, Unit | Junction | Terminal | Place):
        return [plant.graph.part(part) for part in node.parts]
    raise AskError(f"{cell(node.id)} is a {node.layer}, which is no one thing to be drawn; give a unit or a part")


def _neighbors(plant: Plant, node: Node) -> list[Node]:
    """What a target hangs together with: along the pipes, or, of a part, its unit and what touches it; the next first.

    Of a structure or a system these are the units in it, of a level those that are reached from there.
    """
    if isinstance(node, Part):
        owner = plant.graph.unit_of(node)
        return [*([owner] if owner is not None else []), *plant.graph.neighbors(node)]
    if isinstance(node, System):
        return [plant.graph.nodes[one] for one in node.units]
    if isinstance(node, Cluster):
        inside = {part.id for part in plant.graph.parts(cluster=node.id)}
        return [unit for unit in plant.graph.units() if inside.intersection(unit.parts)]
    if isinstance(node, Place):
        served = (edge.target for edge in plant.graph.of_kind(Contains) if edge.source == node.id)
        return [plant.graph.nodes[one] for one in served]
    if node.id not in plant.network.places:
        return []
    ends = dict.fromkeys(arc.end for arc in plant.network.arcs(node.id) if arc.end != node.id)
    return [plant.graph.nodes[end] for end in ends]


def _point_of(node: Node) -> Point:
    if isinstance(node, Junction | Terminal):
        return node.point
    if isinstance(node, Unit | Part | Cluster):
        return node.centroid
    if isinstance(node, Place):
        return _tuple(np.mean(node.aabb, axis=0))
    raise AskError(f"{cell(node.id)} is a {node.layer}, which has no one place")


def _told(values: Mapping[str, Any]) -> list[str]:
    """What a picture shows, in words."""
    lines = [
        f"{values['target']} in red, seen from the {values['seen_from']}, "
        f"{values['degrees_from_above']:.0f} degrees from above; up is up (+z)."
    ]
    if values["neighbors"]:
        lines.append(f"In blue, with tags: {_listed(values['neighbors'])}.")
    if values["untagged"] > 0:
        lines.append(f"{values['untagged']} tag{'s' * (values['untagged'] != 1)} found no room.")
    if values["outside"]:
        lines.append(f"Outside the picture: {_listed(values['outside'])}.")
    if values["others_faint"]:
        lines.append("Others stand before it, so that all but it and its neighbours is drawn faint.")
    return lines


def _listed(names: Sequence[str]) -> str:
    return ", ".join(names[:_MOST_TAGS]) + (f" and {len(names) - _MOST_TAGS} more" if len(names) > _MOST_TAGS else "")


def _within(camera: Camera, point: Point) -> bool:
    place, depth = camera.project([point])
    return bool(depth[0] > 0 and (place[0] >= 0).all() and (place[0] <= (camera.width, camera.height)).all())


def _tuple(point: npt.ArrayLike) -> Point:
    x, y, z = (float(c) for c in np.asarray(point))
    return x, y, z
