"""The pictures that go with a question."""

from __future__ import annotations

import hashlib
import io
import math
import threading
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from PIL import Image

from cadgraph.draw.render.camera import direction_from_angles, frame
from cadgraph.draw.render.detail import Detail, find_detail
from cadgraph.draw.render.mark import Mark, choose_mark
from cadgraph.draw.render.pair import PairRenderer
from cadgraph.draw.render.surroundings import Surroundings, reach
from cadgraph.draw.render.target import Target, View, choose_views, steady
from cadgraph.model.scene import Scene

__all__ = ["PICTURES", "Gallery", "Picture", "digest_of_scene", "to_jpeg"]

PICTURES = 3
"""Version of how pictures are drawn. It is part of what a question is known by in the cache: raise it when pictures
change so that an answer could, too."""

_QUALITY = 90  # of JPEG: 25 kB each, no artefacts beside lines that a model could see
_KEPT = 8  # parts whose pictures may be asked for again before others
_AROUND = (-60.0, 60.0, 180.0)  # azimuths of the paper's three views; it doesn't say which, so: evenly around
_ELEVATION = 25.0


@dataclass(frozen=True)
class Picture:
    """One picture of a question.

    Args:
        name: a file name without its suffix.
        caption: what the model is told about it.
        draw: makes the JPEG.
    """

    name: str
    caption: str
    draw: Callable[[], bytes]


class Gallery:
    """Draws the pictures of the parts of one scene, only when somebody needs them. Safe for threads.

    Pictures of a part are drawn of what lies about it only, so that they follow from that alone.

    Args:
        scene: one mesh for each part.
        paper: plain pictures from three sides around, as in the paper, instead of marked ones from where it is seen.
        size: side of a picture [px].
    """

    def __init__(self, scene: Scene, *, paper: bool = False, size: int = 512) -> None:
        self._scene, self._paper, self._size = scene, paper, size
        self._mark = choose_mark(scene)
        self._lock = threading.Lock()
        self._surroundings: Surroundings | None = None
        self._kept: OrderedDict[int, _Drawing] = OrderedDict()

    @property
    def n_pictures(self) -> int:
        """For each question."""
        return 6

    @property
    def size(self) -> int:
        """Side of a picture [px]."""
        return self._size

    @property
    def mark(self) -> Mark:
        """What the part in question is marked with."""
        return self._mark

    def recipe(self, part: int) -> str:
        """What the pictures of a part follow from: equal recipes give equal pictures."""
        way = "paper" if self._paper else f"seen {self._mark.name} {self._mark.color}"
        return f"pictures-{PICTURES} {way} {self._size} {self._about().recipe(part)}"

    def views(self, part: int) -> tuple[View, ...]:
        """The three views of a part; positions are relative to the lowest corner of its box."""
        return self._drawing(part).views

    def pictures(self, part: int) -> tuple[Picture, ...]:
        """Three pairs: with what is round it, and with the part alone; the last of all is cut open where it helps."""
        drawing = self._drawing(part)
        pictures = []
        for i, view in enumerate(drawing.views):
            caption = f"View {i + 1} of 3, with everything around it:" if self._paper else _caption(i, view, drawing)
            pictures.append(Picture(f"view{i + 1}-all", caption, _Once(drawing, i, alone=False)))
            own = f"View {i + 1}, the part alone:"
            if i == 2 and drawing.detail is not None:
                own = _detail_caption(drawing.detail)
            pictures.append(Picture(f"view{i + 1}-alone", own, _Once(drawing, i, alone=True)))
        return tuple(pictures)

    def _about(self) -> Surroundings:
        with self._lock:
            if self._surroundings is None:
                self._surroundings = Surroundings(self._scene)
            return self._surroundings

    def _drawing(self, part: int) -> _Drawing:
        with self._lock:
            if part in self._kept:
                self._kept.move_to_end(part)
                return self._kept[part]
        drawing = _Drawing(self._about().cutout(part), self._paper, self._mark, self._size)
        with self._lock:
            self._kept[part] = drawing
            while len(self._kept) > _KEPT:
                self._kept.popitem(last=False)
        return drawing


class _Drawing:
    """The pictures of one part, of a scene that holds it first and what lies about it."""

    def __init__(self, scene: Scene, paper: bool, mark: Mark, size: int) -> None:
        self._renderer = PairRenderer(scene, plain=paper, mark=mark.color)
        self._side = size, size
        target = Target.of(scene, 0)
        extents = np.ptp(target.vertices, axis=0)
        self.reach = reach(float(extents.max()))
        self.detail: Detail | None = None
        self.views: tuple[View, ...]
        if paper:
            self.views = tuple(self._around(target, azimuth) for azimuth in _AROUND)
        else:
            self.views = choose_views(scene, target, self._side)
            self.detail = find_detail(self._renderer, target, self.views[2].direction, self._side)

    def _around(self, target: Target, azimuth: float) -> View:
        direction = direction_from_angles(math.radians(azimuth), math.radians(_ELEVATION))
        return View(steady(frame(target.vertices, direction, self._side, margin=0.25)), math.nan)

    def draw(self, view: int, *, alone: bool) -> bytes:
        """One of the pictures as JPEG."""
        shown = self.views[view]
        if not alone:
            return to_jpeg(self._renderer.context(0, shown.camera, shown.hidden, depth=shown.depth or None))
        if view == 2 and self.detail is not None:
            detail = self.detail
            return to_jpeg(self._renderer.alone(0, detail.camera, detail.cut, depth=detail.depth))
        return to_jpeg(self._renderer.alone(0, shown.camera, depth=shown.depth or None))


class _Once:
    """Draws a picture when it is first asked for."""

    def __init__(self, drawing: _Drawing, view: int, *, alone: bool) -> None:
        self._drawing, self._view, self._alone = drawing, view, alone
        self._made: bytes | None = None

    def __call__(self) -> bytes:
        if self._made is None:
            self._made = self._drawing.draw(self._view, alone=self._alone)
        return self._made


def to_jpeg(image: Image.Image) -> bytes:
    """A picture as it is sent."""
    buffer = io.BytesIO()
    image.save(buffer, "JPEG", quality=_QUALITY, subsampling=0)
    return buffer.getvalue()


def _length(length: float) -> str:
    return f"{length:.2g} m" if length >= 1 else f"{length * 100:.2g} cm"


def _caption(index: int, view: View, drawing: _Drawing) -> str:
    words = [f"View {index + 1} of 3, about {_length(view.span)} wide at the part"]
    if view.wide:
        words.append(
            f"from further back, with all that comes within {_length(drawing.reach)} of it, to show what it belongs to"
        )
    if view.section:
        words.append(f"only {'one end' if view.end else 'a section'} of this long part is shown")
    if view.hidden:
        n = len(view.hidden)
        words.append(f"a cutaway: {n} other part{'s' * (n != 1)} before it {'are' if n != 1 else 'is'} left as a ghost")
    elif view.visible < 0.6:
        words.append("other parts hide some of it")
    return "; ".join(words) + ":"


def _detail_caption(detail: Detail) -> str:
    if detail.kind == "cut":
        closed = "; hatched is its material where it is cut" if detail.closed else ", to look inside"
        return f"The part alone, cut open through the middle{closed}:"
    if detail.kind == "end":
        return "The part alone, looking at its end:"
    return "The part alone, looking at its broad side:"


def digest_of_scene(scene: Scene) -> str:
    """Sixteen hexadecimal digits that stand for the geometry and colours of a scene."""
    h = hashlib.sha256()
    for array in (scene.vertices, scene.faces, scene.vertex_offsets, scene.face_offsets, scene.colors):
        h.update(str((array.shape, array.dtype.str)).encode())
        h.update(np.ascontiguousarray(array).data)
    return h.hexdigest()[:16]
