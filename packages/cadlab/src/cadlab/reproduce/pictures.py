"""The pictures of a reproduction, after the paper's figures."""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

from cadgraph._io.atomic import write_atomically
from cadgraph.config import ReportConfig
from cadgraph.draw.render.annotation import annotate
from cadgraph.draw.report.pictures import draw_pictures
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Connected
from cadlab.reproduce.experiment import Trial

__all__ = ["draw_trial", "save_picture", "side_by_side"]

_QUALITY = 86  # of JPEG; below, the thin red lines fray
_TITLE = 34  # px


def draw_trial(trial: Trial, config: ReportConfig, name: str, *, paper_only: bool = False) -> Image.Image:
    """Draws the graph of a trial with its legend.

    Args:
        trial: what to draw.
        config: size and anti-aliasing.
        name: ``"groups"`` (with the functional graph in red) or ``"clusters"``.
        paper_only: draw the relations of Algorithm 1 alone, as the paper does.
    """
    graph = _without_connected(trial.graph) if paper_only else trial.graph
    pictures = draw_pictures(trial.subject.scene, graph, config.model_copy(update={"max_systems": 0}))
    picture = next(picture for picture in pictures if picture.name == name)
    return annotate(picture.image, picture.camera, legend=picture.legend).image


def side_by_side(images: Sequence[tuple[str, Image.Image]]) -> Image.Image:
    """Pictures of one size beside each other, each under its title."""
    width, height = images[0][1].size
    result = Image.new("RGB", (width * len(images), height + _TITLE), "white")
    draw = ImageDraw.Draw(result)
    for number, (title, image) in enumerate(images):
        result.paste(image, (number * width, _TITLE))
        middle = (number + 0.5) * width
        draw.text((middle, _TITLE / 2), title, font=ImageFont.load_default(18), fill="#1f2933", anchor="mm")
    return result


def save_picture(image: Image.Image, path: Path) -> None:
    """Writes a picture whole or not at all: PNG for drawings, JPEG for renders, as the name says."""
    content = io.BytesIO()
    if path.suffix == ".png":
        image.quantize(128).save(content, "PNG", optimize=True)
    else:
        image.save(content, "JPEG", quality=_QUALITY, optimize=True)
    write_atomically(path, content.getvalue())


def _without_connected(graph: SceneGraph) -> SceneGraph:
    edges = tuple(edge for edge in graph.document.edges if not isinstance(edge, Connected))
    return SceneGraph(graph.document.model_copy(update={"edges": edges}))
