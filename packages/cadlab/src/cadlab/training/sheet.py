"""A sheet of pictures: the mistakes on real plants that the labeler is surest of."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from cadgraph._io.atomic import write_atomically
from cadgraph.draw.render.camera import frame
from cadgraph.draw.render.color import from_hex
from cadgraph.draw.render.picture import Look, Paint, Renderer
from cadgraph.model.scene import Floats
from cadlab.training.figure import Answers
from cadlab.training.real import RealPlant

__all__ = ["draw_mistakes"]

_CELL, _CAPTION, _COLUMNS, _ROWS = (300, 220), 50, 5, 4  # px
_MOST = 6  # of one plant
_WRONG, _REST = "#e2211c", "#c3cbd5"
_LARGE = 12  # of what is shown around a part: larger meshes are left out
_AROUND = 1.2  # of the part's size: what is shown on each side of it


def draw_mistakes(plants: Sequence[RealPlant], told: Mapping[str, Answers], path: Path) -> None:
    """Draws parts that were put into a wrong group, the surest first, one of each shape.

    Args:
        plants: real ones.
        told: what the labeler says of each, by its name.
        path: a JPEG file.
    """
    cells = []
    for plant in plants:
        answers = told[plant.name]
        rows = np.flatnonzero(~plant.example.ground & (plant.example.label != ""))
        wrong = np.flatnonzero(answers.group != answers.true_group)
        shapes: set[int] = set()
        for k in wrong[np.argsort(-answers.group_confidence[wrong], kind="stable")].tolist():
            shape = int(plant.example.shape[rows[k]])
            if shape not in shapes and len(shapes) < _MOST:
                shapes.add(shape)
                cells.append((float(answers.group_confidence[k]), plant, int(rows[k]), answers, k))
    cells = sorted(cells, key=lambda cell: -cell[0])[: _COLUMNS * _ROWS]
    wide, tall = _CELL[0], _CELL[1] + _CAPTION
    sheet = Image.new("RGB", (_COLUMNS * wide, max(1, -(-len(cells) // _COLUMNS)) * tall), "white")
    draw, font = ImageDraw.Draw(sheet), ImageFont.load_default(13)
    renderers = {plant.name: Renderer(plant.scene) for plant in plants}
    for at, (sure, plant, part, answers, k) in enumerate(cells):
        x, y = at % _COLUMNS * wide, at // _COLUMNS * tall
        sheet.paste(_picture(renderers[plant.name], part), (x, y))
        said, truth = str(answers.name[k]).split("/")[1], str(answers.truth[k]).split("/")[1]
        draw.text((x + 8, y + _CELL[1] + 4), f"{plant.name}: {truth}", "#14532d", font)
        draw.text((x + 8, y + _CELL[1] + 24), f"said {said} ({sure:.0%})", _WRONG, font)
    buffer = io.BytesIO()
    sheet.save(buffer, "JPEG", quality=82)
    write_atomically(path, buffer.getvalue())


def _picture(renderer: Renderer, part: int) -> Image.Image:
    scene = renderer.scene
    points = renderer.points([part])
    low, high = points.min(axis=0), points.max(axis=0)
    room = _AROUND * float(np.linalg.norm(high - low))
    colors = np.tile(from_hex(_REST), (scene.n_meshes, 1)).astype(np.float32)
    colors[part] = from_hex(_WRONG)
    kept = np.array([k == part or _is_near(renderer.points([k]), low, high, room) for k in range(scene.n_meshes)])
    kept = np.flatnonzero(kept)
    some = Renderer(scene.select(kept))
    ghosted = kept != part
    corners = np.array(np.meshgrid(*zip(low, high, strict=True))).reshape(3, -1).T
    middle = (low + high) / 2
    camera = frame(middle + (corners - middle) * 1.6, np.array([-0.6, -0.9, 0.55]), _CELL)
    return some.picture(camera, Paint(colors[kept], ghosted=ghosted), Look(samples=3, floor=False))


def _is_near(points: Floats, low: Floats, high: Floats, room: float) -> bool:
    """Whether a mesh comes close to a box, and is not so large that it hides it."""
    if not len(points):
        return False
    least, most = points.min(axis=0), points.max(axis=0)
    beside = (most > low - room).all() and (least < high + room).all()
    return bool(beside and np.linalg.norm(most - least) < _LARGE * room)
