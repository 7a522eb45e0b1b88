"""Pictures of a scene."""

from __future__ import annotations

import os
import threading
from collections import OrderedDict
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt
from PIL import Image

from cadgraph.draw.render.band import Band, Setting, draw_band
from cadgraph.draw.render.camera import Camera
from cadgraph.draw.render.caster import Caster
from cadgraph.draw.render.color import Colors, from_hex, source_colors, to_linear, to_srgb
from cadgraph.draw.render.crease import CREASE_ANGLE, CornerNormals
from cadgraph.draw.render.light import lamps
from cadgraph.model.scene import Floats, Scene, mesh_of_vertex

__all__ = ["Look", "Paint", "Renderer"]

Bools = npt.NDArray[np.bool_]
Singles = npt.NDArray[np.float32]

_SAMPLES_AT_ONCE = 600_000  # of one band, if every pixel lay at an edge: bounds the memory of a thread
_KEPT_CASTERS = 4
_MOST_THREADS = 16


@dataclass(frozen=True)
class Look:
    """How pictures are drawn.

    Args:
        samples: anti-aliasing, rays along each side of a pixel at edges.
        sky_rays: rays of each pixel to the sky, for ambient occlusion and shadows; 0 draws without either.
        lines: strength of the thin dark lines at outlines, seams and sharp edges, 0..1.
        floor: whether a floor below everything takes the shadows.
        reach: how far ambient occlusion reaches, as share of the scene's diagonal.
        top: background colour at the top.
        bottom: background colour at the bottom.
        ghost: share that ghosted meshes take over the background.
        ghost_over: share that they take over what they stand in front of.
    """

    samples: int = 3
    sky_rays: int = 4
    lines: float = 0.6
    floor: bool = True
    reach: float = 0.16
    top: str = "#fafbfd"
    bottom: str = "#e1e6ed"
    ghost: float = 0.5
    ghost_over: float = 0.13


@dataclass(frozen=True)
class Paint:
    """What is drawn, and in which colours.

    Args:
        colors: ``(n_meshes, 3)`` linear RGB.
        hatched: ``(n_meshes,)`` whether a mesh is striped; none by default.
        ghosted: ``(n_meshes,)`` whether a mesh is only hinted at, so that the others show through it.
        hidden: ``(n_meshes,)`` whether a mesh is left out.
    """

    colors: Colors
    hatched: Bools | None = field(default=None)
    ghosted: Bools | None = field(default=None)
    hidden: Bools | None = field(default=None)


class Renderer:
    """Draws pictures of one scene; keeps what several pictures have in common. Safe for threads.

    The same arguments give the same bytes on one machine, whatever the number of threads.

    Args:
        scene: the scene.
        threads: as many as processors by default.
        crease_angle: faces that meet at a lesser angle are shaded as one surface [rad].

    Raises:
        ValueError: the scene has no triangle.
    """

    def __init__(self, scene: Scene, threads: int | None = None, crease_angle: float = CREASE_ANGLE) -> None:
        if not scene.n_triangles:
            raise ValueError("no picture of an empty scene: it has no triangles")
        self.scene = scene
        self.threads = threads or min(_MOST_THREADS, os.cpu_count() or 1)
        self._normals = CornerNormals(scene, crease_angle)
        self._casters: OrderedDict[bytes, Caster] = OrderedDict()
        self._lock = threading.Lock()

    def caster(self, meshes: npt.ArrayLike | None = None) -> Caster:
        """What casts rays at these meshes (all by default); the last few are kept.

        Raises:
            ValueError: they have no finite triangle.
        """
        chosen = np.arange(self.scene.n_meshes) if meshes is None else np.unique(np.asarray(meshes, np.int64))
        key = chosen.tobytes()
        with self._lock:
            found = self._casters.pop(key, None) or Caster(self.scene, chosen)
            self._casters[key] = found
            while len(self._casters) > _KEPT_CASTERS:
                self._casters.popitem(last=False)
        return found

    def points(self, meshes: npt.ArrayLike | None = None) -> Floats:
        """``(n, 3)`` the finite vertices of these meshes (all by default) [m], for framing."""
        vertices = self.scene.vertices
        if meshes is not None:
            wanted = np.zeros(self.scene.n_meshes, bool)
            wanted[np.asarray(meshes, np.int64)] = True
            vertices = vertices[wanted[mesh_of_vertex(self.scene)]]
        finite = np.isfinite(vertices).all(axis=1)
        return vertices if finite.all() else vertices[finite]

    def picture(self, camera: Camera, paint: Paint | None = None, look: Look | None = None) -> Image.Image:
        """Draws a picture.

        Args:
            camera: where from, and how large.
            paint: what, in which colours; everything in the source's colours by default.
            look: how.

        Returns:
            An RGB image.

        Raises:
            ValueError: nothing is left to draw.
        """
        return self.pictures(camera, [paint or Paint(source_colors(self.scene))], look)[0]

    def pictures(self, camera: Camera, paints: Sequence[Paint], look: Look | None = None) -> list[Image.Image]:
        """Draws pictures that differ in colours only, in little more time than one.

        Args:
            camera: where from, and how large.
            paints: one for each picture; what is ghosted or hidden in the first is so in all.
            look: how.

        Returns:
            RGB images in the order of the paints.

        Raises:
            ValueError: nothing is left to draw, or the paints don't agree on what is drawn.
        """
        look = look or Look()
        hidden, ghosted = _left_out(self.scene.n_meshes, paints)
        layers = [
            self._setting(camera, paints, look, meshes, ghost=ghost)
            for meshes, ghost in ((~hidden & ~ghosted, False), (ghosted, True))
            if np.diff(self.scene.face_offsets)[meshes].any()
        ]
        if not layers:
            raise ValueError("no picture: every mesh with triangles is hidden")
        images = np.empty((len(paints), camera.height, camera.width, 3), np.uint8)

        def draw(rows: tuple[int, int]) -> None:
            bands = [(draw_band(layer, *rows), layer.ghost) for layer in layers]
            images[:, rows[0] : rows[1]] = _composed(bands, rows, camera.height, look)

        with ThreadPoolExecutor(self.threads) as pool:
            for _ in pool.map(draw, _bands(camera, look.samples)):
                pass
        return [Image.fromarray(image) for image in images]

    def _setting(self, camera: Camera, paints: Sequence[Paint], look: Look, meshes: Bools, *, ghost: bool) -> Setting:
        caster = self.caster(np.flatnonzero(meshes))
        none = np.zeros(self.scene.n_meshes, bool)
        hatched = np.array([none if paint.hatched is None or ghost else paint.hatched for paint in paints])
        colors = np.array([paint.colors for paint in paints], np.float32)
        if ghost:
            # Half way to grey, then most of the way to white: still a hint of what it is.
            grey = colors.mean(axis=2, keepdims=True)
            colors = (0.72 + 0.2 * (colors + grey) / 2).astype(np.float32)
        return Setting(
            caster=caster,
            normals=self._normals,
            face_offsets=self.scene.face_offsets,
            camera=camera,
            lights=lamps(camera.right, camera.up, camera.forward),
            albedo=colors,
            hatched=hatched,
            samples=look.samples,
            sky_rays=0 if ghost else look.sky_rays,
            lines=look.lines,
            floor=float(caster.low[2] - caster.center[2]) if look.floor and not ghost else None,
            reach=look.reach * caster.diagonal,
            ghost=ghost,
        )


def _bands(camera: Camera, samples: int) -> Iterator[tuple[int, int]]:
    """Rows of each band; they depend on the picture only, so that every machine divides it alike."""
    height = max(8, min(128, _SAMPLES_AT_ONCE // (camera.width * samples * samples)))
    for top in range(0, camera.height, height):
        yield top, min(top + height, camera.height)


def _left_out(n_meshes: int, paints: Sequence[Paint]) -> tuple[Bools, Bools]:
    """Which meshes are hidden and which are ghosted, the same for all paints."""
    none = np.zeros(n_meshes, bool)
    masks = []
    for paint in paints:
        if len(paint.colors) != n_meshes:
            raise ValueError(f"a scene of {n_meshes} meshes needs as many colours, got {len(paint.colors)}")
        hidden = none if paint.hidden is None else np.asarray(paint.hidden, bool)
        ghosted = none if paint.ghosted is None else np.asarray(paint.ghosted, bool) & ~hidden
        masks.append((hidden, ghosted))
    if not masks:
        raise ValueError("no picture: give at least one paint")
    if any((mask[0] != masks[0][0]).any() or (mask[1] != masks[0][1]).any() for mask in masks):
        raise ValueError("pictures drawn together must hide and ghost the same meshes; draw them one by one")
    return masks[0]


def _composed(bands: list[tuple[Band, bool]], rows: tuple[int, int], height: int, look: Look) -> npt.NDArray[np.uint8]:
    """The layers, each with whether it is ghosted, over the background: sRGB ``(n_paints, n_rows, width, 3)``."""
    share = ((np.arange(*rows) + 0.5) / height)[:, None, None]
    # Blended as the eye sees it, not as light adds up.
    background = to_linear(to_srgb(from_hex(look.top)) * (1 - share) + to_srgb(from_hex(look.bottom)) * share)
    color = np.broadcast_to(background, bands[0][0].color.shape).astype(np.float32)
    depth = np.full(bands[0][0].cover.shape, np.inf, np.float32)
    solid = np.zeros(depth.shape, np.float32)
    for band, ghost in bands:
        if not ghost:
            color = color * (band.floor * (1 - band.cover))[..., None] + band.color
            depth, solid = band.depth, band.cover
            continue
        over = np.where(band.depth < depth, look.ghost_over, 0) * solid
        taken = (look.ghost * (1 - solid) + over).astype(np.float32)
        color = color * (1 - taken * band.cover)[..., None] + band.color * taken[..., None]
    return (to_srgb(color) * 255 + 0.5).astype(np.uint8)
