"""Pairs of pictures of one mesh: among all the others, and alone, from the same camera (paper, section III-B 4).

Drawn without shadows and with fewer rays at edges than pictures for people: some ten pairs a second on a processor.
"""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from PIL import Image

from cadgraph.draw.render.camera import Camera
from cadgraph.draw.render.caster import Caster, Hits
from cadgraph.draw.render.color import from_hex, source_colors, to_srgb
from cadgraph.draw.render.light import lamps, open_air
from cadgraph.draw.render.picture import Look, Renderer
from cadgraph.draw.render.scalebar import draw_scale_bar
from cadgraph.draw.render.shading import Haze, background, compose, shade
from cadgraph.draw.render.surface import Surfaces, Viewport, covered, meet
from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.model.scene import Scene

__all__ = ["MARK", "Pair", "PairRenderer"]

Bools = npt.NDArray[np.bool_]
Bytes = npt.NDArray[np.uint8]
Singles = npt.NDArray[np.float32]

MARK = "#ff00aa"
"""What marks the target: a magenta that no paint of a plant has (RAL's nearest, 4010, is duller)."""

_LOOK = Look(samples=2, sky_rays=0)
_TINT = 0.22  # share of the mark's colour in the target's, in the first picture
_OUTLINE = 2.5  # width of the line round the target [px]
_HAZE = 0.45  # share of the background that what lies far behind the target fades into
_HAZED = 5.0  # times the target's distance at which haze is full
_MOST_LAYERS = 12  # of meshes that a cutaway looks through, one behind the other
_SLACK = 2e-3  # share of the distance by which the target may lie behind what a cutaway came to


@dataclass(frozen=True)
class Pair:
    """Two pictures from one camera.

    Args:
        context: everything, but for what is cut away.
        alone: the target only.
        visible: share of the target's pixels that ``context`` shows, 0..1.
        pixels: that the target alone takes.
        bar: length that the scale bar stands for [m].
    """

    context: Image.Image
    alone: Image.Image
    visible: float
    pixels: int
    bar: float


class PairRenderer:
    """Draws pairs of pictures of the meshes of one scene. Safe for threads; the same arguments give the same bytes.

    Args:
        scene: the scene.
        plain: whether the target goes unmarked and the pictures without a scale bar, as in the paper.

    Raises:
        ValueError: the scene has no finite triangle.
    """

    def __init__(self, scene: Scene, *, plain: bool = False) -> None:
        self.scene = scene
        self.plain = plain
        self._renderer = Renderer(scene, threads=1)
        self.caster = self._renderer.caster()
        self.mesh_of_face = self._renderer.mesh_of_face
        self._colors = source_colors(scene).astype(np.float32)
        self._mark = from_hex(MARK)
        self._local = threading.local()

    def pair(self, target: int, camera: Camera, hidden: Sequence[int] = ()) -> Pair:
        """Draws one pair.

        Args:
            target: the mesh.
            camera: where from.
            hidden: meshes that are left out of the first picture.

        Raises:
            ValueError: the target has no finite triangle.
        """
        single, window = self._single(target), self._window(target, camera)
        near, far = self._distances(target, camera)
        whole = Viewport.whole(camera)
        everything = self._everything(whole, hidden, single)
        colors = self._colors
        if not self.plain:
            colors = colors.copy()
            colors[target] = colors[target] * (1 - _TINT) + self._mark * _TINT
        context = self._drawn(whole, everything, colors, Haze(near, far, _HAZE))
        sky = np.round(to_srgb(background(camera.height, _LOOK.top, _LOOK.bottom)) * 255).astype(np.uint8)
        alone = np.repeat(sky[:, None], camera.width, axis=1)
        seen = covered(whole, everything, _LOOK.samples, target)
        shape = np.zeros_like(seen)
        if window.height and window.width:
            surfaces = self._renderer.surfaces(window, single, _LOOK.samples)
            at = slice(window.top, window.top + window.height), slice(window.left, window.left + window.width)
            alone[at] = self._drawn(window, surfaces, self._colors, Haze())
            shape[at] = covered(window, surfaces, _LOOK.samples, -1)
        if not self.plain:
            color = np.round(to_srgb(self._mark) * 255).astype(np.float64)
            _outline(seen, shape, _room(window, int(_OUTLINE) + 2), _OUTLINE, color, context)
        images = [Image.fromarray(context), Image.fromarray(alone)]
        bar = 0.0
        if not self.plain:
            for image in images:
                bar = draw_scale_bar(image, camera.pixel_size * near)
        parts = int(shape.sum())
        visible = float(np.minimum(seen, shape).sum()) / max(parts, 1)
        return Pair(images[0], images[1], visible, parts // _LOOK.samples**2, bar)

    def _everything(self, port: Viewport, hidden: Sequence[int], single: Caster) -> Surfaces:
        """What the first picture shows."""
        if not len(hidden):
            return self._renderer.surfaces(port, self.caster, _LOOK.samples)
        left_out = np.zeros(self.scene.n_meshes, bool)
        left_out[list(hidden)] = True

        def cast(towards: Singles) -> Hits:
            return self._cut_away(port.camera, towards, left_out, single)

        return meet(port, cast, self.mesh_of_face, self._renderer.normals.ready, _LOOK.samples, False, 1)

    def _drawn(self, port: Viewport, surfaces: Surfaces, colors: Singles, haze: Haze) -> Bytes:
        none = np.zeros((1, self.scene.n_meshes), bool)
        camera = port.camera
        behind = background(camera.height, _LOOK.top, _LOOK.bottom)[port.top : port.top + port.height]
        layer = shade(
            port, surfaces, open_air(port.width * port.height), lamps(camera), colors[None], none, none[0],
            _LOOK.samples, _LOOK.lines, haze, behind, 1,
        )  # fmt: skip
        drawn: Bytes = compose(port, layer, None, behind, 1)[0]
        return drawn

    def _cut_away(self, camera: Camera, towards: Singles, left_out: Bools, single: Caster) -> Hits:
        """What rays meet when they pass through the meshes that are left out.

        Behind a mesh that is cut away rays start a little further on, and would miss a target that lies right on it:
        so they are cast at the target alone, too.
        """
        eye = self.caster.local(camera.eye[None])[0]
        found = self.caster.first(np.broadcast_to(eye, towards.shape), towards)
        step = np.float32(max(2e-6 * self.caster.diagonal, 1e-5))
        through = first = self._on(found.face, left_out, np.flatnonzero(found.face >= 0))
        reached = np.zeros(len(towards), np.float32)
        for _ in range(_MOST_LAYERS):
            if not len(through):
                break
            reached[through] = found.distance[through] + step
            behind = self.caster.first(eye + towards[through] * reached[through, None], towards[through])
            _replace(found, through, np.arange(len(through)), behind)
            found.distance[through] = np.where(behind.face >= 0, behind.distance + reached[through], np.inf)
            through = self._on(found.face, left_out, through)
        found.face[through] = -1
        if len(first):
            own = single.first(
                np.broadcast_to(single.local(camera.eye[None])[0], (len(first), 3)), towards[first]
            )  # fmt: skip
            nearer = (found.face[first] < 0) | (own.distance < found.distance[first] * (1 + _SLACK))
            wins = np.flatnonzero((own.face >= 0) & nearer)
            found.distance[first[wins]] = own.distance[wins]
            _replace(found, first[wins], wins, own)
        return found

    def _on(self, face: npt.NDArray[np.int32], left_out: Bools, rays: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """Those of some rays that met a mesh that is left out."""
        met = rays[face[rays] >= 0]
        there: npt.NDArray[Any] = met[left_out[self.mesh_of_face[face[met]]]]
        return there

    def _single(self, target: int) -> Caster:
        kept: dict[int, Caster] = self._local.__dict__.setdefault("single", {})
        if target not in kept:
            kept.clear()
            kept[target] = Caster(self.scene, [target])
        return kept[target]

    def _window(self, target: int, camera: Camera) -> Viewport:
        """Where the target's vertices project into; the whole picture where one lies behind the eye."""
        vertices = self.scene.mesh(target)[0]
        places, depth = camera.project(vertices[np.isfinite(vertices).all(axis=1)])
        if not len(places) or not (depth > 0).all():
            return Viewport.whole(camera)
        low = np.floor(places.min(axis=0)) - 1
        high = np.ceil(places.max(axis=0)) + 1
        left, top = (int(x) for x in np.clip(low, 0, (camera.width, camera.height)))
        right, bottom = (int(x) for x in np.clip(high, 0, (camera.width, camera.height)))
        return Viewport(camera, top, left, bottom - top, right - left)

    def _distances(self, target: int, camera: Camera) -> tuple[float, float]:
        """Depth of the middle of what the target has before the camera, and from where on haze is full [m]."""
        vertices = self.scene.mesh(target)[0]
        depth = (vertices[np.isfinite(vertices).all(axis=1)] - camera.eye) @ camera.forward
        ahead = depth[depth > 0]
        middle = float(ahead.min() + ahead.max()) / 2 if len(ahead) else 1.0
        return middle, _HAZED * middle


def _replace(found: Hits, rays: npt.NDArray[Any], rows: npt.NDArray[Any], by: Hits) -> None:
    """Lets some rays have met something else; their distances aside."""
    for values, others in ((found.face, by.face), (found.u, by.u), (found.v, by.v), (found.normal, by.normal)):
        values[rays] = others[rows]


def _room(window: Viewport, margin: int) -> npt.NDArray[np.int64]:
    """First and last row, first and last column of a window and a margin round it."""
    bottom, right = window.top + window.height + margin, window.left + window.width + margin
    return np.array([
        max(0, window.top - margin), min(window.camera.height, bottom),
        max(0, window.left - margin), min(window.camera.width, right),
    ])  # fmt: skip


@compiled
def _outline(seen: Any, whole: Any, room: Any, radius: float, color: Any, image: Any) -> None:
    """Draws a line round what is seen of the target, dotted where it goes on behind others.

    Args:
        seen: ``(height, width)`` quarters of each pixel that show the target.
        whole: ``(height, width)`` quarters that would show it if it were alone.
        room: ``(4,)`` first and last row, first and last column that may hold the target or its line.
        radius: width of the line [px].
        color: ``(3,)`` sRGB bytes.
        image: ``(height, width, 3)`` that is drawn on.
    """
    height, width = seen.shape
    reach = int(radius) + 1
    for row in range(room[0], room[1]):
        for column in range(room[2], room[3]):
            own = seen[row, column]
            if own == 4:
                continue
            # Thin where something stands before the target, in full along its own outline.
            before = whole[row, column] == 4
            share = (1.0 - 0.25 * own) * (0.5 if before else 1.0)
            if own == 0:
                near = 1e9
                for r in range(max(0, row - reach), min(height, row + reach + 1)):
                    for c in range(max(0, column - reach), min(width, column + reach + 1)):
                        if seen[r, c] > 0:
                            near = min(near, float((r - row) * (r - row) + (c - column) * (c - column)))
                share = min(1.0, max(0.0, (0.6 if before else radius + 0.5) - np.sqrt(near)))
            if share == 0.0 and whole[row, column] > 0 and (row + column) % 6 < 3:
                rim = False
                for r in range(max(0, row - 1), min(height, row + 2)):
                    for c in range(max(0, column - 1), min(width, column + 2)):
                        rim |= whole[r, c] < 4
                share = 0.85 if rim else 0.0
            for i in range(3):
                image[row, column, i] = int(image[row, column, i] * (1.0 - share) + color[i] * share + 0.5)
