"""Pictures of a scene."""

from __future__ import annotations

import os
import threading
from collections import OrderedDict
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import numpy.typing as npt
from PIL import Image

from cadgraph.draw.render.camera import Camera
from cadgraph.draw.render.caster import Caster, TwoCasters
from cadgraph.draw.render.color import Colors, source_colors
from cadgraph.draw.render.crease import CornerNormals
from cadgraph.draw.render.fineness import Fineness
from cadgraph.draw.render.light import Lamps, Light, lamps, light, open_air
from cadgraph.draw.render.shading import Haze, Layer, background, compose, shade
from cadgraph.draw.render.surface import Surfaces, Viewport, meet
from cadgraph.geometry.visibility.rays import Hits
from cadgraph.model.scene import Floats, Scene

__all__ = ["Look", "Paint", "Renderer", "Sight"]

Bools = npt.NDArray[np.bool_]
Singles = npt.NDArray[np.float32]

_KEPT_CASTERS = 4
_MOST_THREADS = 16
_GHOST_SAMPLES = 2  # nobody looks closely at what is only hinted at: it is drawn in a quarter of the pixels, too
_LEAST_HALVED = 256  # [px] a smaller picture is not halved
_THICK_LINES = 0.5  # lines of two pixels instead of one are so much fainter
_SHARE, _GHOST_SHARE = 0.75, 4.0  # [px] of the nearest mesh: what is smaller needn't be told apart; among ghosts


@dataclass(frozen=True)
class Look:
    """How pictures are drawn.

    Args:
        samples: anti-aliasing, rays along each side of a pixel at edges.
        sky_rays: rays of each pixel to the sky, for ambient occlusion and shadows; 0 draws without either.
        lines: strength of the thin dark lines at outlines, seams and sharp edges, 0..1.
        floor: whether a floor below everything takes the shadows.
        top: background colour at the top.
        bottom: background colour at the bottom.
    """

    samples: int = 3
    sky_rays: int = 3
    lines: float = 0.6
    floor: bool = True
    top: str = "#fafbfd"
    bottom: str = "#e1e6ed"


@dataclass(frozen=True)
class Paint:
    """The colours of a picture.

    Args:
        colors: ``(n_meshes, 3)`` linear RGB.
        hatched: ``(n_meshes,)`` whether a mesh is striped; none by default.
        ghosted: ``(n_meshes,)`` whether a mesh is only hinted at, so that the others show through it.
    """

    colors: Colors
    hatched: Bools | None = field(default=None)
    ghosted: Bools | None = field(default=None)


@dataclass(frozen=True)
class Sight:
    """What a camera sees, before it is painted.

    Args:
        port: the camera's picture.
        look: how it is drawn.
        ghosted: ``(n_meshes,)`` the meshes that are only hinted at.
        lights: the lamps.
        surfaces: what the rays met.
        light: what each pixel sees of the sky and of the lamps.
    """

    port: Viewport
    look: Look
    ghosted: Bools
    lights: Lamps
    surfaces: Surfaces
    light: Light


class Renderer:
    """Draws pictures of one scene; keeps what several pictures have in common. Safe for threads.

    The same arguments give the same bytes on one machine, whatever the number of threads.

    Args:
        scene: the scene.
        threads: that share the work on a picture; as many as processors by default.

    Raises:
        ValueError: the scene has no finite triangle.
    """

    def __init__(self, scene: Scene, threads: int | None = None) -> None:
        if not scene.n_triangles:
            raise ValueError("no picture of an empty scene: it has no triangles")
        self.scene = scene
        self.threads = threads or min(_MOST_THREADS, os.cpu_count() or 1)
        self.mesh_of_face = np.repeat(np.arange(scene.n_meshes, dtype=np.int32), np.diff(scene.face_offsets))
        self.normals = CornerNormals(scene, self.threads)
        self._casters: OrderedDict[tuple[bytes, float], Caster] = OrderedDict()
        self._lock = threading.Lock()
        self._everything: dict[float, Caster] = {}
        self._fixed: Caster | None = None
        self._fineness = Fineness(scene)

    def moved(self, scene: Scene, meshes: npt.ArrayLike) -> Renderer:
        """Draws the same scene with some of its meshes elsewhere, quicker than a new one would.

        Args:
            scene: the same meshes in the same order.
            meshes: ``(n,)`` those that may lie elsewhere; a picture of the others alone must be possible.

        Raises:
            ValueError: the scene has other meshes, or nothing is left that stays.
        """
        if scene.paths != self.scene.paths or not np.array_equal(scene.face_offsets, self.scene.face_offsets):
            raise ValueError("not the same scene: it has other meshes")
        chosen = np.unique(np.asarray(meshes, np.int64))
        other = Renderer(scene, self.threads)
        other.normals = self.normals.moved(scene, chosen)
        still = self.caster(np.setdiff1d(np.arange(scene.n_meshes), chosen), 0.0)
        other._fixed = TwoCasters(still, Caster(scene, chosen)) if len(chosen) else still
        return other

    def caster(self, meshes: npt.ArrayLike | None = None, cell: float | None = None) -> Caster:
        """What casts rays at these meshes (all by default); the last few are kept.

        Args:
            meshes: ``(n,)``.
            cell: what may be left out of many meshes because it is smaller [m]; by default so much that pictures of
                them from afar don't show it.

        Raises:
            ValueError: they have no finite triangle.
        """
        chosen = None if meshes is None else np.unique(np.asarray(meshes, np.int64))
        if chosen is None or len(chosen) == self.scene.n_meshes:
            if self._fixed is not None:
                return self._fixed
            chosen = None
        cell, most = self._fineness.steps(chosen, cell)
        with self._lock:
            if chosen is None:
                if cell not in self._everything:
                    self._everything = {cell: Caster(self.scene, None, cell, most)}
                return self._everything[cell]
            key = chosen.tobytes(), cell
            found = self._casters.pop(key, None) or Caster(self.scene, chosen, cell, most)
            self._casters[key] = found
            while len(self._casters) > _KEPT_CASTERS:
                self._casters.popitem(last=False)
        return found

    def points(self, meshes: npt.ArrayLike | None = None) -> Floats:
        """``(n, 3)`` the finite vertices of these meshes (all by default) [m], for framing."""
        scene = self.scene if meshes is None else self.scene.select(np.unique(np.asarray(meshes, np.int64)))
        vertices = scene.placed_vertices()
        finite = np.isfinite(vertices).all(axis=1)
        return vertices if finite.all() else vertices[finite]

    def picture(self, camera: Camera, paint: Paint | None = None, look: Look | None = None) -> Image.Image:
        """Draws a picture.

        Args:
            camera: where from, and how large.
            paint: the colours; those of the source by default.
            look: how.

        Returns:
            An RGB image.
        """
        return self.pictures(camera, [paint or Paint(source_colors(self.scene))], look)[0]

    def pictures(self, camera: Camera, paints: Sequence[Paint], look: Look | None = None) -> list[Image.Image]:
        """Draws pictures that differ in colours only, in little more time than one.

        Args:
            camera: where from, and how large.
            paints: one for each picture; what is ghosted in the first is so in all.
            look: how.

        Returns:
            RGB images in the order of the paints.

        Raises:
            ValueError: the paints don't agree on what is ghosted.
        """
        return self.painted(self.look(camera, look or Look(), _ghosted(self.scene.n_meshes, paints)), paints)

    def look(self, camera: Camera, look: Look, ghosted: Bools | None = None) -> Sight:
        """Casts the rays of a picture, most of the work on it; its colours needn't be known yet.

        Args:
            camera: where from, and how large.
            look: how.
            ghosted: ``(n_meshes,)`` what will only be hinted at; none by default.
        """
        ghosted = np.zeros(self.scene.n_meshes, bool) if ghosted is None else ghosted
        port, lights = Viewport.whole(camera), lamps(camera)
        drawn = np.diff(self.scene.face_offsets) > 0
        solid_meshes = np.flatnonzero(~ghosted & drawn) if self._shows_through(ghosted) else None
        caster = self.caster(solid_meshes, self._fineness.wanted(camera, solid_meshes, _SHARE))
        surfaces = self.surfaces(port, caster, look.samples, lit=look.sky_rays > 0)
        seen = open_air(port.width * port.height)
        if look.sky_rays:
            seen = light(port, surfaces, caster, lights, look.sky_rays, look.floor, self.threads)
        return Sight(port, look, ghosted, lights, surfaces, seen)

    def painted(self, sight: Sight, paints: Sequence[Paint]) -> list[Image.Image]:
        """Paints what a camera sees.

        Args:
            sight: what :meth:`look` found.
            paints: one for each picture.

        Returns:
            RGB images in the order of the paints.

        Raises:
            ValueError: a paint has other meshes ghosted than those that were when the rays were cast.
        """
        if not np.array_equal(_ghosted(self.scene.n_meshes, paints), sight.ghosted):
            raise ValueError("these paints ghost other meshes than the sight does; look anew")
        port, look = sight.port, sight.look
        behind = background(port.height, look.top, look.bottom)
        colors = np.array([paint.colors for paint in paints], np.float32)
        none = np.zeros(self.scene.n_meshes, bool)
        hatched = np.array([none if paint.hatched is None else paint.hatched for paint in paints])
        solid = shade(
            port, sight.surfaces, sight.light, sight.lights, colors, hatched, none, look.samples, look.lines, Haze(),
            behind, self.threads,
        )  # fmt: skip
        over = None
        if self._shows_through(sight.ghosted):
            over = self._ghosts(port, sight.lights, colors, ~sight.ghosted, look, behind)
        return [Image.fromarray(image) for image in compose(port, solid, over, behind, self.threads)]

    def _shows_through(self, ghosted: Bools) -> bool:
        """Whether some of what is drawn is ghosted, and some is not."""
        drawn = np.diff(self.scene.face_offsets) > 0
        return bool((ghosted & drawn).any() and (~ghosted & drawn).any())

    def surfaces(self, port: Viewport, caster: Caster, samples: int, *, lit: bool = False) -> Surfaces:
        """What the rays of a picture meet among a caster's meshes."""
        eye = caster.local(port.camera.eye[None])[0]

        def cast(towards: Singles, _pixels: npt.NDArray[np.int64], _side: int) -> Hits:
            return caster.first(np.broadcast_to(eye, towards.shape), towards)

        return meet(port, cast, self.mesh_of_face, self.normals.ready, samples, lit, self.threads)

    def _around(self, camera: Camera) -> Caster:
        """What casts rays at all meshes, or only at those in sight where they have to be told apart better."""
        if self._fixed is not None or not self._fineness.many(None):
            return self.caster()
        cell = self._fineness.wanted(camera, None, _GHOST_SHARE)
        taken, _ = self._fineness.steps(None, cell)
        return self.caster(None if taken == self._fineness.usual(None) else self._fineness.in_sight(camera), cell)

    def _ghosts(
        self, port: Viewport, lights: Lamps, colors: Colors, left_out: Bools, look: Look, behind: Singles
    ) -> Layer:
        """The meshes that are only hinted at, as far as none of the others stands before them."""
        samples = min(look.samples, _GHOST_SAMPLES)
        coarse = _of_half_size(port)
        surfaces = self.surfaces(coarse, self._around(port.camera), samples)
        grey = colors.mean(axis=2, keepdims=True)
        # Half way to grey, then most of the way to white: still a hint of what it is.
        pale = (0.72 + 0.2 * (colors + grey) / 2).astype(np.float32)
        plain = np.zeros((len(colors), self.scene.n_meshes), bool)
        lines = look.lines if coarse is port else _THICK_LINES * look.lines
        layer = shade(
            coarse, surfaces, open_air(coarse.width * coarse.height), lights, pale, plain, left_out, samples, lines,
            Haze(), behind, self.threads,
        )  # fmt: skip
        return layer if coarse is port else _of_twice_the_size(layer, coarse)


def _of_half_size(port: Viewport) -> Viewport:
    """The same in a quarter of the pixels, where both sides can be halved."""
    camera = port.camera
    if camera.width % 2 or camera.height % 2 or min(camera.width, camera.height) < _LEAST_HALVED:
        return port
    return Viewport.whole(replace(camera, width=camera.width // 2, height=camera.height // 2))


def _of_twice_the_size(layer: Layer, port: Viewport) -> Layer:
    """Each pixel as four."""

    def spread(values: Singles) -> Singles:
        grid = values.reshape(port.height, port.width, -1)
        return np.ascontiguousarray(grid.repeat(2, axis=0).repeat(2, axis=1).reshape(-1, *values.shape[1:]))

    color = np.stack([spread(one) for one in layer.color])
    return Layer(color, spread(layer.cover), spread(layer.depth), spread(layer.floor))


def _ghosted(n_meshes: int, paints: Sequence[Paint]) -> Bools:
    """Which meshes are ghosted, the same for all paints."""
    none = np.zeros(n_meshes, bool)
    if not paints:
        raise ValueError("no picture: give at least one paint")
    for paint in paints:
        if len(paint.colors) != n_meshes:
            raise ValueError(f"a scene of {n_meshes} meshes needs as many colours, got {len(paint.colors)}")
    masks = [none if paint.ghosted is None else np.asarray(paint.ghosted, bool) for paint in paints]
    if any((mask != masks[0]).any() for mask in masks):
        raise ValueError("pictures drawn together must ghost the same meshes; draw them one by one")
    return masks[0]
