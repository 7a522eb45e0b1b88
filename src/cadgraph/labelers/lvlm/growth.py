"""Letting a model grow the vocabulary from overview pictures, one after the other (paper, section III-A)."""

from __future__ import annotations

import io
import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from PIL import Image

from cadgraph.draw.render.camera import direction_from_angles, frame
from cadgraph.draw.render.picture import Look, Renderer
from cadgraph.draw.render.views import three_quarter_view
from cadgraph.errors import LabelError
from cadgraph.labelers.lvlm.answer import GrowthAnswer, growth_schema
from cadgraph.labelers.lvlm.asking import Asking
from cadgraph.labelers.lvlm.gallery import PICTURES, Picture, digest_of_scene
from cadgraph.labelers.lvlm.merging import Merged, Wish, merge
from cadgraph.labelers.lvlm.prompt import grow_text, system_text, version
from cadgraph.labelers.lvlm.reply import Question
from cadgraph.model.scene import Floats, Scene
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["Growth", "Overview", "grow", "overviews"]

SIZE = (1024, 768)
"""Of an overview [px]: four tiles of 512, and a short side of 768, which is the most that gpt-4o looks at."""

_MOST_LABELS = 12  # that one picture may bring: more is a list of what could be there
_LOOK = Look(samples=2, sky_rays=3)
_OVERVIEWS = 3
_CELL = 5.0  # m: a region of a close-up; a valve station fits in it
_QUALITY = 90


@dataclass(frozen=True)
class Overview:
    """One overview picture.

    Args:
        name: ``overview-1``, ``region-1``...
        caption: what the model is told.
        draw: makes the picture.
    """

    name: str
    caption: str
    draw: Callable[[], Image.Image]


@dataclass(frozen=True)
class Growth:
    """What became of the vocabulary.

    Args:
        vocabulary: the tree now.
        merged: what became of each label that was proposed, with its source picture.
        failures: pictures without a usable answer, and why.
    """

    vocabulary: Vocabulary
    merged: tuple[Merged, ...]
    failures: tuple[tuple[str, str], ...]


def overviews(scene: Scene, count: int = 8) -> tuple[Overview, ...]:
    """Pictures that show a scene: a few of all of it, then of the regions that hold most.

    Args:
        scene: any with a triangle.
        count: how many, at least 1.
    """
    renderer = Renderer(scene)
    first = three_quarter_view(renderer, aspect=SIZE[0] / SIZE[1])
    ways = [first, three_quarter_view(renderer, aspect=SIZE[0] / SIZE[1], unlike=first)]
    ways.append(direction_from_angles(math.atan2(first[1], first[0]) + math.pi / 2, math.radians(50)))
    found = [
        Overview(f"overview-{i + 1}", f"Overview {i + 1} of the whole scene:", _Drawn(renderer, renderer.points(), way))
        for i, way in enumerate(ways[: min(count, _OVERVIEWS)])
    ]
    for i, meshes in enumerate(_regions(scene, count - len(found))):
        way = three_quarter_view(renderer, meshes, aspect=SIZE[0] / SIZE[1])
        caption = f"Region {i + 1}, one of those with the most parts:"
        found.append(Overview(f"region-{i + 1}", caption, _Drawn(renderer, renderer.points(meshes), way)))
    return tuple(found)


def grow(
    scene: Scene,
    start: Vocabulary,
    asking: Asking,
    *,
    count: int = 8,
    progress: Callable[[str, float], None] = lambda _stage, _share: None,
) -> Growth:
    """Shows a model overview pictures one after the other, and merges what it misses into the tree.

    Args:
        scene: whose things need labels.
        start: the tree so far; an empty one lets the model begin from nothing, as the paper does.
        asking: who is asked.
        count: pictures.
        progress: called with the name of a stage and the share of it that is done.

    Raises:
        LabelError: no picture got an answer.
    """
    tree = start
    merged: list[Merged] = []
    failures: list[tuple[str, str]] = []
    digest = digest_of_scene(scene)
    pictures = overviews(scene, count)
    for i, overview in enumerate(pictures):
        progress("look", i / len(pictures))
        shown = Picture(overview.name, overview.caption, _Jpeg(overview.draw))
        question = Question(
            system=system_text(),
            text=grow_text(tree, _MOST_LABELS),
            schema=growth_schema(),
            recipe=f"overview-{PICTURES} {SIZE} {digest} {overview.name} of {count}",
            pictures=_Shown((shown,)),
            prompt=version("grow"),
        )
        reworded = _Reworded(tree)
        if not asking.within_budget([question]):
            failures.append((overview.name, "the budget is used up"))
            continue
        try:
            outcome = asking.ask_all([question], GrowthAnswer, reworded)[0]
        finally:
            asking.answerer.close()
        if outcome.answer is None:
            failures.append((overview.name, outcome.reason or "no answer"))
            continue
        wishes = [
            Wish(label.group, label.name, label.reason, overview.name) for label in outcome.answer.labels[:_MOST_LABELS]
        ]
        tree, results = merge(tree, wishes)
        merged += results
    if len(failures) == len(pictures):
        count_of = "the picture" if len(pictures) == 1 else f"any of the {len(pictures)} pictures"
        raise LabelError(
            f"no answer to {count_of} ({failures[-1][1]}); nothing was written; see to the server and run it again"
        )
    progress("look", 1)
    return Growth(tree, tuple(merged), tuple(failures))


def _regions(scene: Scene, count: int) -> list[list[int]]:
    """Meshes of the cells of the ground plan that hold most of them, the fullest first."""
    cells: dict[tuple[int, int], list[int]] = {}
    for mesh in range(scene.n_meshes):
        vertices = scene.mesh(mesh)[0]
        sound = vertices[np.isfinite(vertices).all(axis=1)]
        if not len(sound) or np.ptp(sound[:, :2], axis=0).max() > _CELL:
            continue
        x, y = np.floor((sound[:, :2].min(axis=0) + sound[:, :2].max(axis=0)) / 2 / _CELL).astype(int).tolist()
        cells.setdefault((x, y), []).append(mesh)
    order = sorted(cells, key=lambda cell: (-len(cells[cell]), cell))
    return [cells[cell] for cell in order[: max(count, 0)]]


class _Drawn:
    def __init__(self, renderer: Renderer, points: Floats, direction: Floats) -> None:
        self._renderer, self._points, self._direction = renderer, points, direction

    def __call__(self) -> Image.Image:
        return self._renderer.picture(frame(self._points, self._direction, SIZE), None, _LOOK)


class _Jpeg:
    """Draws once."""

    def __init__(self, draw: Callable[[], Image.Image]) -> None:
        self._draw = draw
        self._made: bytes | None = None

    def __call__(self) -> bytes:
        if self._made is None:
            buffer = io.BytesIO()
            self._draw().save(buffer, "JPEG", quality=_QUALITY)
            self._made = buffer.getvalue()
        return self._made


class _Shown:
    def __init__(self, pictures: tuple[Picture, ...]) -> None:
        self._pictures = pictures

    def __call__(self) -> tuple[Picture, ...]:
        return self._pictures


class _Reworded:
    def __init__(self, tree: Vocabulary) -> None:
        self._tree = tree

    def __call__(self, question: Question, reason: str) -> Question:
        return replace(question, text=grow_text(self._tree, _MOST_LABELS, reason), attempt=1)
