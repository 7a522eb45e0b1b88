"""Pairs of pictures of one mesh: among all the others, and alone, from the same camera (paper, section III-B 4).

Drawn with one ray for each pixel and four where that shows an edge, without shadow rays: some ten pairs a second on a
processor, where :class:`~cadgraph.draw.render.picture.Renderer` takes its time for a good-looking picture.
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
from cadgraph.draw.render.caster import Caster
from cadgraph.draw.render.color import from_hex, source_colors, to_linear, to_srgb
from cadgraph.draw.render.crease import CornerNormals
from cadgraph.draw.render.light import lamps
from cadgraph.draw.render.raster import (
    aim,
    aim_quarters,
    cover,
    crowding,
    find_edges,
    follow_edges,
    outline,
    prefer,
    resolve,
    shade_pixels,
)
from cadgraph.draw.render.scalebar import draw_scale_bar
from cadgraph.geometry.kernels.parallel import readable
from cadgraph.model.scene import Ints, Scene, mesh_of_face

__all__ = ["MARK", "Pair", "PairLook", "PairRenderer"]

Bools = npt.NDArray[np.bool_]
Singles = npt.NDArray[np.float32]

MARK = "#ff00aa"
"""What marks the target: a magenta that no paint of a plant has (RAL's nearest, 4010, is duller)."""

_MOST_LAYERS = 12  # of meshes that a cutaway looks through, one behind the other
_SLACK = 2e-3  # share of the distance by which the target may lie behind what a cutaway came to
_HAZED = 5.0  # times the target's distance at which haze is full
_LEVELS = 4096  # of linear light in the table of sRGB bytes


@dataclass(frozen=True)
class PairLook:
    """How pairs are drawn.

    Args:
        mark: whether the target is outlined and tinted in the first picture; off as in the paper.
        scale_bar: whether both pictures carry a scale bar at the target's distance; off as in the paper.
        lines: strength of the thin dark lines at outlines, seams and sharp edges, 0..1.
        tint: share of the mark's colour in the target's, in the first picture.
        outline: width of the line round the target [px].
        haze: share of the background that what lies far behind the target fades into.
        top: background colour at the top.
        bottom: background colour at the bottom.
    """

    mark: bool = True
    scale_bar: bool = True
    lines: float = 0.6
    tint: float = 0.22
    outline: float = 2.5
    haze: float = 0.45
    top: str = "#ffffff"
    bottom: str = "#edf0f4"


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
        look: how pairs are drawn.

    Raises:
        ValueError: the scene has no finite triangle.
    """

    def __init__(self, scene: Scene, look: PairLook | None = None) -> None:
        self.scene = scene
        self.look = look or PairLook()
        self.caster = Caster(scene)
        self.mesh_of_face = mesh_of_face(scene).astype(np.int32)
        self._faces = self.caster.faces.astype(np.int32)
        self._mesh_of_primitive = self.mesh_of_face[self._faces]
        self._normals = CornerNormals(scene)
        self._colors = source_colors(scene).astype(np.float32)
        self._mark = from_hex(MARK)
        self._mark_bytes = np.round(to_srgb(self._mark) * 255).astype(np.float64)
        self._table = np.round(to_srgb(np.linspace(0, 1, _LEVELS)) * 255).astype(np.uint8)
        self._local = threading.local()

    def pair(self, target: int, camera: Camera, hidden: Sequence[int] = ()) -> Pair:
        """Draws one pair.

        Args:
            target: the mesh.
            camera: where from; perspective.
            hidden: meshes that are left out of the first picture.

        Raises:
            ValueError: the target has no finite triangle, or the camera is orthographic.
        """
        if camera.projection != "perspective":
            raise ValueError("pairs are drawn in perspective; frame the camera so")
        whole = np.array([0, camera.height, 0, camera.width], np.int64)
        everything, single = self._grids(camera)
        left_out = None
        if len(hidden):
            left_out = np.zeros(self.scene.n_meshes, bool)
            left_out[list(hidden)] = True
        single_caster = self._single(target)
        window = self._window(target, camera)
        first_face = int(self.scene.face_offsets[target])
        near, far = self._distances(target, camera)
        albedo = self._colors
        own = np.full(len(single_caster.faces), target, np.int32)
        alone = self._draw(
            single, camera, window, single_caster, own, (single_caster.faces + first_face).astype(np.int32), None,
            albedo, near, np.inf, None,
        )  # fmt: skip
        context = self._draw(
            everything, camera, whole, self.caster, self._mesh_of_primitive, self._faces, left_out,
            self._tinted(target) if self.look.mark else albedo, near, far, (single, window),
        )  # fmt: skip
        seen, shape = everything.cover, single.cover
        room = _grown(window, int(self.look.outline) + 2, camera)
        for share, grid, mesh, at in ((seen, everything, target, room), (shape, single, -1, window)):
            _zero(share, room)
            cover(grid.mesh, mesh, at, share)
        if self.look.mark:
            outline(seen, shape, room, self.look.outline, self._mark_bytes, context)
        quarters = int(_cut(shape, window).sum())
        both = np.minimum(_cut(seen, window), _cut(shape, window)).sum()
        images = [Image.fromarray(context), Image.fromarray(alone)]
        bar = 0.0
        if self.look.scale_bar:
            for image in images:
                bar = draw_scale_bar(image, camera.pixel_size * near)
        return Pair(images[0], images[1], float(both) / max(quarters, 1), quarters // 4, bar)

    def _draw(
        self, grid: _Grid, camera: Camera, window: Ints, caster: Caster, meshes: Any, faces: Any,
        left_out: Bools | None, albedo: Singles, near: float, far: float, favoured: tuple[_Grid, Ints] | None,
    ) -> npt.NDArray[np.uint8]:  # fmt: skip
        axes = np.stack([camera.right, camera.up, camera.forward])
        pixel, width, height = camera.pixel_size, camera.width, camera.height
        image = np.empty((height, width, 3), np.uint8)
        share = ((np.arange(height) + 0.5) / height)[:, None]
        srgb = to_srgb(from_hex(self.look.top)) * (1 - share) + to_srgb(from_hex(self.look.bottom)) * share
        background = to_linear(srgb).astype(np.float64)
        image[:] = np.round(srgb * 255).astype(np.uint8)[:, None]
        if window[1] <= window[0] or window[3] <= window[2]:
            return image
        eye = caster.local(camera.eye[None])[0]
        towards = np.empty(((window[1] - window[0]) * (window[3] - window[2]), 3), np.float32)
        aim(axes, pixel, width, height, window, towards)
        self._meet(grid, caster, eye, towards, meshes, faces, left_out, _NO_PIXELS, window, width, favoured)
        surfaces = grid.mesh, grid.normal, grid.depth
        find_edges(axes, pixel, width, height, window, *surfaces, grid.edge)
        pixels = np.flatnonzero(_cut(grid.edge, window) == 1)
        for mark in (2, 0):
            if len(pixels):
                across = window[3] - window[2]
                where = (pixels // across + window[0]) * width + pixels % across + window[2]
                towards = np.empty((4 * len(where), 3), np.float32)
                aim_quarters(axes, pixel, width, height, where, towards)
                self._meet(grid, caster, eye, towards, meshes, faces, left_out, where, window, width, favoured)
            if not mark or not follow_edges(window, grid.mesh, grid.edge):
                break
            pixels = np.flatnonzero(_cut(grid.edge, window) == mark)
        crowding(window, grid.edge, grid.share)
        lights = lamps(camera.right, camera.up, camera.forward)
        haze = self.look.haze if np.isfinite(far) else 0.0
        shade_pixels(
            axes, pixel, width, height, window, *surfaces, grid.edge, albedo, lights.key, lights.fill,
            float(self.look.lines), float(near), float(far if haze else near + 1.0), float(haze), background,
            self._table, image,
        )  # fmt: skip
        return image

    def _meet(
        self, grid: _Grid, caster: Caster, eye: Singles, towards: Singles, meshes: Any, faces: Any,
        left_out: Bools | None, pixels: Ints, window: Ints, width: int, favoured: tuple[_Grid, Ints] | None,
    ) -> None:  # fmt: skip
        found = caster.trace(np.broadcast_to(eye, towards.shape), towards)
        primitive, distance = found["primID"], found["tfar"]
        if left_out is not None:
            _look_through(caster, eye, towards, found, meshes, left_out)
        shown = np.unique(meshes[primitive[primitive >= 0]])
        corners = self._normals.ready(shown)
        resolve(
            towards, primitive, found["u"], found["v"], found["Ng"], distance, readable(meshes, np.int32),
            readable(faces, np.int32), corners, pixels, window, width, grid.mesh, grid.normal, grid.depth,
        )  # fmt: skip
        if favoured is not None and left_out is not None:
            own, place = favoured
            prefer(place, _SLACK, grid.mesh, grid.normal, grid.depth, own.mesh, own.normal, own.depth)

    def _single(self, target: int) -> Caster:
        kept: dict[int, Caster] = self._local.__dict__.setdefault("single", {})
        if target not in kept:
            kept.clear()
            kept[target] = Caster(self.scene.select([target]))
        return kept[target]

    def _window(self, target: int, camera: Camera) -> Ints:
        """Rows and columns that the target's vertices project into; the whole picture where one lies behind the eye."""
        vertices = self.scene.mesh(target)[0]
        places, depth = camera.project(vertices[np.isfinite(vertices).all(axis=1)])
        if not len(places) or not (depth > 0).all():
            return np.array([0, camera.height, 0, camera.width], np.int64)
        low = np.floor(places.min(axis=0)) - 1
        high = np.ceil(places.max(axis=0)) + 1
        left, top = np.clip(low, 0, (camera.width, camera.height))
        right, bottom = np.clip(high, 0, (camera.width, camera.height))
        return np.array([top, bottom, left, right], np.int64)

    def _distances(self, target: int, camera: Camera) -> tuple[float, float]:
        """Distance of the middle of what the target has before the camera, and from where on haze is full [m]."""
        vertices = self.scene.mesh(target)[0]
        depth = (vertices[np.isfinite(vertices).all(axis=1)] - camera.eye) @ camera.forward
        ahead = depth[depth > 0]
        middle = float(ahead.min() + ahead.max()) / 2 if len(ahead) else 1.0
        return middle, _HAZED * middle

    def _tinted(self, target: int) -> Singles:
        colors = self._colors.copy()
        colors[target] = colors[target] * (1 - self.look.tint) + self._mark * self.look.tint
        return colors

    def _grids(self, camera: Camera) -> tuple[_Grid, _Grid]:
        """Room to draw in, kept for each thread."""
        size = camera.height, camera.width
        kept: tuple[_Grid, _Grid] | None = getattr(self._local, "grids", None)
        if kept is None or kept[0].edge.shape != size:
            kept = _Grid(*size), _Grid(*size)
            self._local.grids = kept
        return kept


class _Grid:
    """Arrays of one picture at work, see raster.py."""

    def __init__(self, height: int, width: int) -> None:
        self.mesh = np.full((2 * height, 2 * width), -1, np.int32)
        self.normal = np.zeros((2 * height, 2 * width, 3), np.float32)
        self.depth = np.zeros((2 * height, 2 * width), np.float32)
        self.edge = np.zeros((height, width), np.uint8)
        self.share = np.zeros((height, width), np.float32)
        self.cover = np.zeros((height, width), np.uint8)


_NO_PIXELS = np.zeros(0, np.int64)


def _look_through(
    caster: Caster, eye: Singles, towards: Singles, found: dict[str, Any], meshes: Any, left_out: Bools
) -> None:
    """Sends rays that met a mesh that is left out on behind it, until they meet another; changes ``found``."""
    step = np.float32(max(2e-6 * caster.diagonal, 1e-5))
    through = np.flatnonzero(found["primID"] >= 0)
    reached = np.zeros(len(towards), np.float32)
    for _ in range(_MOST_LAYERS):
        through = through[left_out[meshes[found["primID"][through]]]]
        if not len(through):
            return
        reached[through] += found["tfar"][through] + step if _ == 0 else 0
        start = eye + towards[through] * reached[through, None]
        behind = caster.trace(start, towards[through])
        for name in ("primID", "u", "v", "Ng"):
            found[name][through] = behind[name]
        met = behind["primID"] >= 0
        found["tfar"][through] = np.where(met, reached[through] + behind["tfar"], np.inf)
        through = through[met]
        reached[through] = found["tfar"][through] + step
    found["primID"][through] = -1


def _cut(values: npt.NDArray[np.uint8], window: Ints) -> npt.NDArray[np.uint8]:
    return values[window[0] : window[1], window[2] : window[3]]


def _zero(values: npt.NDArray[np.uint8], window: Ints) -> None:
    values[window[0] : window[1], window[2] : window[3]] = 0


def _grown(window: Ints, by: int, camera: Camera) -> Ints:
    top, bottom, left, right = (int(x) for x in window)
    return np.array(
        [max(0, top - by), min(camera.height, bottom + by), max(0, left - by), min(camera.width, right + by)], np.int64
    )
