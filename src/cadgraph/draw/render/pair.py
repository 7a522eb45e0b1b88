"""Pairs of pictures of one mesh: among all the others, and alone (paper, section III-B 4).

Drawn without shadows and with fewer samples at edges than pictures for people. The mesh is tinted and outlined in a
colour of its own, the others are muted; what is cut away for a better look stays as a ghost.
"""

from __future__ import annotations

import functools
import threading
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from PIL import Image

from cadgraph.draw.render.camera import Camera
from cadgraph.draw.render.color import Colors, from_hex, source_colors, to_srgb
from cadgraph.draw.render.crease import CornerNormals
from cadgraph.draw.render.light import lamps, open_air
from cadgraph.draw.render.picture import Look
from cadgraph.draw.render.raster import Facets, Favour, favour, see, solidity
from cadgraph.draw.render.scalebar import draw_scale_bar
from cadgraph.draw.render.shading import Haze, background, compose, shade
from cadgraph.draw.render.surface import Surfaces, Viewport, covered, meet
from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.geometry.visibility.rays import Hits
from cadgraph.model.scene import Floats, Scene

__all__ = ["MARK", "Pair", "PairRenderer"]

Bools = npt.NDArray[np.bool_]
Bytes = npt.NDArray[np.uint8]
Singles = npt.NDArray[np.float32]

MARK = "#ff00aa"
"""What marks the target where nobody chose a colour (see ``mark``)."""

_LOOK = Look(samples=2, sky_rays=0)
_TINT = 0.75  # share of the mark's colour in the target's, in the first picture
_COLOR_LEFT = 0.35  # share of their colour that the others keep beside grey
_PALE, _DEEP = 0.62, 0.24  # linear light of what was white and of what was black
_LUMINANCE = np.array([0.2126, 0.7152, 0.0722], np.float32)  # of linear sRGB (IEC 61966-2-1)
_OUTLINE = 2.5  # width of the line round the target [px]
_HAZE = 0.45  # share of the background that what lies far behind the target fades into
_HAZED = 5.0  # times the target's distance at which haze is full
_VEIL, _GHOST_LINE, _GHOST_CREASE = 0.16, 0.5, 0.25  # shares that a ghost, its outline and its edges take
_VEIL_LEVEL, _GHOST_LEVEL = 235.0, 70.0  # sRGB bytes of both
_GHOST_SHARP = 0.8  # cosine between neighbouring pixels' normals: a ghost's sharp edges
_CUT = 0.55  # grey of the hatched face where the target is cut


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
        mark: colour of the target, ``"#rrggbb"``.

    Raises:
        ValueError: the scene has no finite triangle.
    """

    def __init__(self, scene: Scene, *, plain: bool = False, mark: str = MARK) -> None:
        if not np.isfinite(scene.vertices[scene.global_faces()]).all(axis=(1, 2)).any():
            raise ValueError("no picture of an empty scene: none of its meshes has a triangle with finite corners")
        self.scene = scene
        self.plain = plain
        self._facets = Facets.of(scene)
        self._normals = CornerNormals(scene)
        own = source_colors(scene)
        self._own = np.concatenate([own, np.full((1, 3), _CUT, np.float32)])
        self._others = self._own if plain else np.concatenate([_muted(own), self._own[-1:]])
        self._mark = from_hex(mark)
        self._lock = threading.Lock()
        self._kept: tuple[int, _Alone] | None = None

    def pair(self, target: int, camera: Camera, hidden: Sequence[int] = ()) -> Pair:
        """Draws one pair.

        Args:
            target: the mesh.
            camera: where from.
            hidden: meshes that are cut away in the first picture; ghosts of them stay.

        Raises:
            ValueError: the target has no finite triangle.
        """
        single = self._alone(target)
        near = self._depth(target, camera)
        alone = single.surfaces(camera)
        context, visible, pixels = self._context(target, camera, hidden, alone, near)
        images = [Image.fromarray(context), Image.fromarray(self._drawn(camera, alone, single.colors))]
        bar = self._bars(images, camera, near)
        return Pair(images[0], images[1], visible, pixels, bar)

    def context(
        self, target: int, camera: Camera, hidden: Sequence[int] = (), *, depth: float | None = None
    ) -> Image.Image:
        """The first picture of a pair only.

        Args:
            target: the mesh.
            camera: where from.
            hidden: meshes that are cut away; ghosts of them stay.
            depth: along the viewing direction at which the scale bar counts [m]; the middle of the target by default.

        Raises:
            ValueError: the target has no finite triangle.
        """
        near = self._depth(target, camera) if depth is None else depth
        context, _, _ = self._context(target, camera, hidden, self._alone(target).surfaces(camera), near)
        image = Image.fromarray(context)
        self._bars([image], camera, near)
        return image

    def alone(
        self, target: int, camera: Camera, cut: Floats | None = None, *, depth: float | None = None
    ) -> Image.Image:
        """The second picture of a pair only, cut open if wanted.

        Args:
            target: the mesh.
            camera: where from.
            cut: ``(4,)`` a plane: what lies at ``normal . x > offset`` is taken away, and solids show a hatched face.
            depth: as of :meth:`context`.

        Raises:
            ValueError: the target has no finite triangle.
        """
        single = self._alone(target)
        image = Image.fromarray(self._drawn(camera, single.surfaces(camera, cut), single.colors, hatched=1))
        self._bars([image], camera, self._depth(target, camera) if depth is None else depth)
        return image

    def share_of_cut(self, target: int, camera: Camera, cut: Floats) -> tuple[float, bool]:
        """How much of what is left of a target shows as cut material, 0..1, and whether it is a solid that has any.

        Args:
            target: the mesh.
            camera: where from.
            cut: see :meth:`alone`.
        """
        single = self._alone(target)
        port = Viewport.whole(camera)
        seen, _ = see(port, single.facets, 1, np.zeros(1, bool), Favour(), cut)
        shown = int((seen.face >= 0).sum())
        closed = int((seen.face == len(single.facets.faces)).sum())
        return closed / max(shown, 1), bool(solidity(single.facets, np.zeros(1, bool))[0])

    def _context(
        self, target: int, camera: Camera, hidden: Sequence[int], alone: Surfaces, near: float
    ) -> tuple[Bytes, float, int]:
        port = Viewport.whole(camera)
        nearer = Favour(target, favour(self._vertices(target)))
        left_out = np.zeros(self.scene.n_meshes, bool)
        left_out[list(hidden)] = True
        surfaces = self._surfaces(port, left_out, nearer)
        colors = self._others.copy()
        own = self._own[target]
        # Grey is mixed in, not the target's own colour: the hue has to be that which the prompt names.
        grey = float((own * _LUMINANCE).sum())
        colors[target] = own if self.plain else grey * (1 - _TINT) + self._mark * _TINT
        context = self._drawn(camera, surfaces, colors, Haze(near, _HAZED * near, _HAZE))
        if left_out.any():
            everything = self._surfaces(port, np.zeros(self.scene.n_meshes, bool), nearer)
            _ghost(everything, left_out, port.width, port.height, context)
        seen = covered(port, surfaces, _LOOK.samples, target)
        shape = covered(port, alone, _LOOK.samples, -1)
        if not self.plain:
            color = np.round(to_srgb(self._mark) * 255).astype(np.float64)
            _outline(seen, shape, _room(shape, int(_OUTLINE) + 2), _OUTLINE, color, context)
        parts = int(shape.sum())
        visible = float(np.minimum(seen, shape).sum()) / max(parts, 1)
        return context, visible, parts // _LOOK.samples**2

    def _surfaces(self, port: Viewport, left_out: Bools, nearer: Favour) -> Surfaces:
        return _surfaces(port, self._facets, self._normals.ready, left_out, nearer, None)

    def _drawn(
        self, camera: Camera, surfaces: Surfaces, colors: Colors, haze: Haze | None = None, *, hatched: int = -1
    ) -> Bytes:
        port, n = Viewport.whole(camera), len(colors)
        striped = np.zeros((1, n), bool)
        striped[0, n if hatched < 0 else hatched :] = True
        behind = background(camera.height, _LOOK.top, _LOOK.bottom)
        layer = shade(
            port, surfaces, open_air(port.width * port.height), lamps(camera), colors[None], striped,
            np.zeros(n, bool), _LOOK.samples, _LOOK.lines, haze or Haze(), behind, 1,
        )  # fmt: skip
        drawn: Bytes = compose(port, layer, None, behind, 1)[0]
        return drawn

    def _bars(self, images: Sequence[Image.Image], camera: Camera, near: float) -> float:
        bar = 0.0
        if not self.plain:
            for image in images:
                bar = draw_scale_bar(image, camera.pixel_size * near)
        return bar

    def _alone(self, target: int) -> _Alone:
        with self._lock:
            if self._kept is None or self._kept[0] != target:
                self._kept = target, _Alone(self.scene.select([target]), self._own[[target, -1]])
            return self._kept[1]

    def _vertices(self, target: int) -> Floats:
        vertices = self.scene.mesh(target)[0]
        return vertices[np.isfinite(vertices).all(axis=1)]

    def _depth(self, target: int, camera: Camera) -> float:
        """Of the middle of what the target has before the camera [m]."""
        depth = (self._vertices(target) - camera.eye) @ camera.forward
        ahead = depth[depth > 0]
        return float(ahead.min() + ahead.max()) / 2 if len(ahead) else 1.0


class _Alone:
    """A target without the others; its second colour is that of the cut."""

    def __init__(self, scene: Scene, colors: Colors) -> None:
        if not np.isfinite(scene.vertices[scene.global_faces()]).all(axis=(1, 2)).any():
            raise ValueError(f"no picture of {scene.paths[0]}: none of its triangles has finite corners")
        self.facets = Facets.of(scene)
        self.colors = colors
        self._normals = CornerNormals(scene)

    def surfaces(self, camera: Camera, cut: Floats | None = None) -> Surfaces:
        normals = self._normals.ready(np.zeros(1, np.int64))
        if cut is not None:
            normals = normals.with_plane(cut[:3], len(self.facets.faces))
        return _surfaces(Viewport.whole(camera), self.facets, lambda _: normals, np.zeros(1, bool), Favour(), cut)


def _surfaces(
    port: Viewport, facets: Facets, normals: Any, left_out: Bools, nearer: Favour, cut: Floats | None
) -> Surfaces:
    mesh_of_face = facets.mesh_of_face
    if cut is not None:
        mesh_of_face = np.append(mesh_of_face, np.int32(facets.n_meshes))

    @functools.cache
    def drawn(side: int) -> Any:
        return see(port, facets, side, left_out, nearer, cut)

    def cast(towards: Singles, pixels: npt.NDArray[np.int64], side: int) -> Hits:
        seen, normal = drawn(side)
        found: Hits = seen.hits(facets, towards, pixels, normal)
        return found

    return meet(port, cast, mesh_of_face, normals, _LOOK.samples, False, 1)


def _muted(colors: Colors) -> Colors:
    """Nearly grey, and neither light nor dark: a hint of what they were, beside which a strong colour stands out."""
    grey = (colors * _LUMINANCE).sum(axis=1, keepdims=True)
    mixed = colors * _COLOR_LEFT + grey * (1 - _COLOR_LEFT)
    muted: Colors = (_DEEP + (_PALE - _DEEP) * np.sqrt(np.clip(mixed, 0, 1))).astype(np.float32)
    return muted


def _room(shape: npt.NDArray[np.uint8], margin: int) -> npt.NDArray[np.int64]:
    """First and last row, first and last column that hold a shape and a margin round it."""
    rows, columns = np.flatnonzero(shape.any(axis=1)), np.flatnonzero(shape.any(axis=0))
    if not len(rows):
        return np.zeros(4, np.int64)
    height, width = shape.shape
    return np.array([
        max(0, rows[0] - margin), min(height, rows[-1] + 1 + margin),
        max(0, columns[0] - margin), min(width, columns[-1] + 1 + margin),
    ], np.int64)  # fmt: skip


@compiled
def _ghost(everything: Any, hidden: Any, width: int, height: int, image: Any) -> None:
    """Hints at meshes that were left out: a thin veil with their outlines and sharp edges.

    Args:
        everything: what the picture would show with them, see Surfaces.
        hidden: ``(n_meshes,)`` which they are.
        width: [px].
        height: [px].
        image: ``(height, width, 3)`` that is drawn on.
    """
    mesh, normal = everything.mesh, everything.normal
    for row in range(height):
        for column in range(width):
            p = row * width + column
            own = mesh[p] >= 0 and hidden[mesh[p]]
            line = 0.0
            for side in range(2):
                q = p + (1 if side == 0 else width)
                if (column + 1 == width) if side == 0 else (row + 1 == height):
                    continue
                if mesh[p] != mesh[q]:
                    if own or (mesh[q] >= 0 and hidden[mesh[q]]):
                        line = _GHOST_LINE
                elif own:
                    turn = 0.0
                    for i in range(3):
                        turn += normal[p, i] * normal[q, i]
                    if turn < _GHOST_SHARP:
                        line = max(line, _GHOST_CREASE)
            veil = _VEIL if own else 0.0
            for i in range(3):
                level = image[row, column, i] * (1.0 - veil) + _VEIL_LEVEL * veil
                image[row, column, i] = int(level * (1.0 - line) + _GHOST_LEVEL * line + 0.5)


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
