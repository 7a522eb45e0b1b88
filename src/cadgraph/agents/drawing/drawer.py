"""Draws one thing of a scene as an order of the graph says."""

from __future__ import annotations

import io
import math
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.agents.answer import AskError, page_of
from cadgraph.agents.drawing.order import SIZE, Order, Picture
from cadgraph.agents.measuring import compass
from cadgraph.config import restore_config
from cadgraph.draw.colors import BACKDROP, RELATION
from cadgraph.draw.render.annotation import Mark, Tag, annotate
from cadgraph.draw.render.camera import Camera, frame
from cadgraph.draw.render.color import from_hex
from cadgraph.draw.render.picture import Paint, Renderer
from cadgraph.draw.render.views import three_quarter_view
from cadgraph.errors import LoadError
from cadgraph.load import load
from cadgraph.model.records import Point, SourceRecord
from cadgraph.model.scene import Ints, Scene
from cadgraph.model.source_file import find_source
from cadgraph.stages.preprocess import prepare_scene

__all__ = ["Drawer", "read_scene"]

_NEIGHBOR = "#7fb2e5"
_AROUND = 0.75  # of its diagonal: what is shown round the target
_LEAST_AROUND = 0.4  # m
_MOST_TAGS = 16
_LEAST_SEEN = 0.35  # of what the target alone would fill; below, what stands before it is only hinted at
_ASLANT = (0.5, -1.0, 0.6)  # where the eye is from what has no meshes
_FROM_ABOVE = (0.5, -1.0, 1.6)  # likewise from a level, which lies flat
_SPOT = 2.5  # px, radius of a dot on a level
_EVERY = 4  # pixels between rays that find out how much of the target is seen


def read_scene(source: SourceRecord, config: Mapping[str, Any], folder: Path | None) -> Scene:
    """The scene of a graph, if its file still lies where it was built from or beside the graph.

    Args:
        source: of the graph.
        config: of the graph.
        folder: that it lies in; None where it was made in memory.

    Raises:
        AskError: the file isn't there, or has changed since.
        LoadError: it can't be read.
    """
    missing = AskError(
        "no picture: the file that this graph was built from isn't where it was, or has changed; "
        "put it beside graph.json, or build the graph again"
    )
    if folder is None or not source.path:
        raise missing
    try:
        file = find_source(source, folder)
    except LoadError:
        raise missing from None
    return prepare_scene(load(file, restore_config(config).load))[0]


class Drawer:
    """Draws pictures of one scene; the first takes longest, as it looks at all of it.

    Args:
        scene: as the graph was made from it.

    Raises:
        AskError: it has nothing to draw.
    """

    def __init__(self, scene: Scene) -> None:
        if not scene.n_triangles:
            raise AskError("the scene of this graph has no triangles, so there is no picture of it")
        self.scene = scene

    @cached_property
    def _renderer(self) -> Renderer:
        return Renderer(self.scene)

    @cached_property
    def _mesh_number(self) -> dict[str, int]:
        return {path: number for number, path in enumerate(self.scene.paths)}

    def draw(self, order: Order) -> Picture:
        """Draws one thing of the scene.

        Args:
            order: what is to be seen; meshes that the scene lacks are left out.

        Raises:
            AskError: there is nothing of it to be drawn.
        """
        meshes = self._meshes(order.meshes)
        points = self._points(order, meshes)
        near = np.setdiff1d(self._meshes(order.near), meshes)
        camera, hinted = self._camera(meshes, near, points)
        colors = np.tile(from_hex(BACKDROP), (self.scene.n_meshes, 1))
        colors[near], colors[meshes] = from_hex(_NEIGHBOR), from_hex(RELATION)
        image = self._renderer.picture(camera, Paint(colors, ghosted=hinted))
        middle = points.mean(axis=0)
        at = _tuple(points[np.linalg.norm(points - middle, axis=1).argmin()] if order.spots else middle)
        dots = [Mark(_tuple(point), RELATION, _SPOT) for point in points] if order.spots else [Mark(at, RELATION)]
        marks = [] if len(meshes) else dots
        tags = [Tag(at, order.name, RELATION)]
        places = [(other.name, self._local(other.point)) for other in order.around]
        shown = [(name, place) for name, place in places if _within(camera, place)]
        tags += [Tag(place, name, _NEIGHBOR) for name, place in shown[:_MOST_TAGS]]
        drawn = annotate(image, camera, marks=marks, tags=tags)
        file = io.BytesIO()
        drawn.image.save(file, "PNG", optimize=True)
        values = {
            "target": order.name,
            "size": list(SIZE),
            "seen_from": compass(-camera.forward[0], -camera.forward[1]),
            "degrees_from_above": math.degrees(math.asin(float(-camera.forward[2]))),
            "neighbors": [name for name, _ in shown],
            "outside": [name for name, place in places if not _within(camera, place)],
            "untagged": 1 + len(shown) - drawn.tagged,
            "others_faint": hinted is not None,
            "spots": 0 if len(meshes) else len(order.spots),
        }
        return Picture(page_of([], _told(values), [], 1), values, file.getvalue())

    def _meshes(self, paths: Iterable[str]) -> Ints:
        """The meshes of these paths that have triangles, ascending."""
        rows = {self._mesh_number[path] for path in paths if path in self._mesh_number}
        sizes = np.diff(self.scene.face_offsets)
        return np.array(sorted(row for row in rows if sizes[row]), np.int64)

    def _points(self, order: Order, meshes: Ints) -> npt.NDArray[np.float64]:
        """What has to be in the picture: the target's vertices, else the point where it is."""
        if len(meshes):
            return self._renderer.points(meshes)
        if order.spots:
            return np.array([self._local(point) for point in order.spots], np.float64)
        if order.point is None:
            raise AskError(f"{order.name} has no triangles in the scene, and no one place; ask for a unit or a part")
        return np.array([self._local(order.point)], np.float64)

    def _camera(
        self, meshes: Ints, near: Ints, points: npt.NDArray[np.float64]
    ) -> tuple[Camera, npt.NDArray[np.bool_] | None]:
        """A camera that shows the target with its surroundings; and what is only hinted at, if anything has to be."""
        low, high = points.min(axis=0), points.max(axis=0)
        grown = max(_LEAST_AROUND, (_AROUND if len(meshes) else 0.0) * float(np.linalg.norm(high - low)))
        corners = np.array(np.meshgrid(*zip(low - grown, high + grown, strict=True))).reshape(3, -1).T
        if not len(meshes):
            return frame(corners, _FROM_ABOVE if len(points) > 1 else _ASLANT, SIZE), None
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
    if values["spots"]:
        lines.append("Red dots: where one can stand, over all that stands before them.")
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
