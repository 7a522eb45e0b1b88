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
from cadgraph.draw.render.pair import PairRenderer
from cadgraph.draw.render.target import Target, View, choose_views
from cadgraph.model.scene import Scene

__all__ = ["PICTURES", "Gallery", "Picture", "digest_of_scene"]

PICTURES = 2
"""Version of how pictures are drawn. It is part of what a question is known by in the cache: raise it when pictures
change so that an answer could, too."""

_QUALITY = 90  # of JPEG: 25 kB each, no artefacts beside lines that a model could see
_KEPT_VIEWS = 4096
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

    Args:
        scene: one mesh for each part.
        paper: plain pictures from three sides around, as in the paper, instead of marked ones from where it is seen.
        size: side of a picture [px].
    """

    def __init__(self, scene: Scene, *, paper: bool = False, size: int = 512) -> None:
        self._scene, self._paper, self._size = scene, paper, size
        self._digest = digest_of_scene(scene)
        self._lock = threading.Lock()
        self._renderer: PairRenderer | None = None
        self._views: OrderedDict[int, tuple[View, ...]] = OrderedDict()

    @property
    def n_pictures(self) -> int:
        """For each question."""
        return 6

    @property
    def size(self) -> int:
        """Side of a picture [px]."""
        return self._size

    def recipe(self, part: int) -> str:
        """What the pictures of a part follow from: equal recipes give equal pictures."""
        return f"pictures-{PICTURES} {'paper' if self._paper else 'seen'} {self._size} {self._digest} {part}"

    def views(self, part: int) -> tuple[View, ...]:
        """The three views of a part."""
        with self._lock:
            if part in self._views:
                return self._views[part]
        renderer = self._ready()
        size = (self._size, self._size)
        views: tuple[View, ...]
        if self._paper:
            vertices = Target.of(self._scene, part).vertices
            views = tuple(
                View(
                    frame(
                        vertices, direction_from_angles(math.radians(a), math.radians(_ELEVATION)), size, margin=0.25
                    ),
                    math.nan,
                )
                for a in _AROUND
            )
        else:
            views = choose_views(renderer.caster, renderer.mesh_of_face, Target.of(self._scene, part), size)
        with self._lock:
            self._views[part] = views
            while len(self._views) > _KEPT_VIEWS:
                self._views.popitem(last=False)
        return views

    def pictures(self, part: int) -> tuple[Picture, ...]:
        """Three pairs: with everything, and with the part alone."""
        pictures = []
        for i, view in enumerate(self.views(part)):
            drawn = _Pair(self._ready(), part, view)
            caption = f"View {i + 1} of 3, with everything around it:" if self._paper else _caption(i, view)
            pictures.append(Picture(f"view{i + 1}-all", caption, drawn.context))
            pictures.append(Picture(f"view{i + 1}-alone", f"View {i + 1}, the part alone:", drawn.alone))
        return tuple(pictures)

    def _ready(self) -> PairRenderer:
        with self._lock:
            if self._renderer is None:
                self._renderer = PairRenderer(self._scene, plain=self._paper)
            return self._renderer


class _Pair:
    """Two pictures that are drawn together when the first of them is asked for."""

    def __init__(self, renderer: PairRenderer, part: int, view: View) -> None:
        self._renderer, self._part, self._view = renderer, part, view
        self._drawn: tuple[bytes, bytes] | None = None

    def context(self) -> bytes:
        return self._both()[0]

    def alone(self) -> bytes:
        return self._both()[1]

    def _both(self) -> tuple[bytes, bytes]:
        if self._drawn is None:
            pair = self._renderer.pair(self._part, self._view.camera, self._view.hidden)
            self._drawn = _jpeg(pair.context), _jpeg(pair.alone)
        return self._drawn


def _jpeg(image: Image.Image) -> bytes:
    buffer = io.BytesIO()
    image.save(buffer, "JPEG", quality=_QUALITY, subsampling=0)
    return buffer.getvalue()


def _caption(index: int, view: View) -> str:
    span = f"{view.span:.2g} m" if view.span >= 1 else f"{view.span * 100:.2g} cm"
    words = [f"View {index + 1} of 3, with everything around it, about {span} wide at the part"]
    if view.wide:
        words.append("from further back, to show what it belongs to")
    if view.section:
        words.append("only a section of this long part is shown")
    if view.hidden:
        n = len(view.hidden)
        words.append(
            f"a cutaway: {n} other part{'s' * (n != 1)} that stand before it {'are' if n != 1 else 'is'} left out"
        )
    elif view.visible < 0.6:
        words.append("other parts hide some of it")
    return "; ".join(words) + ":"


def digest_of_scene(scene: Scene) -> str:
    """Sixteen hexadecimal digits that stand for the geometry and colours of a scene."""
    h = hashlib.sha256()
    for array in (scene.vertices, scene.faces, scene.vertex_offsets, scene.face_offsets, scene.colors):
        h.update(str((array.shape, array.dtype.str)).encode())
        h.update(np.ascontiguousarray(array).data)
    return h.hexdigest()[:16]
