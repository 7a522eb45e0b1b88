"""Lines, marks, tags and legends drawn over a picture."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from cadgraph.draw.render.camera import Camera
from cadgraph.draw.render.placement import place_boxes
from cadgraph.model.scene import Floats

__all__ = ["Annotated", "LegendEntry", "Mark", "Segment", "Tag", "annotate"]

Position = tuple[float, float, float]
_Rgb = tuple[int, int, int]

_DRAWN_FOR = 800  # [px] height of the picture that the sizes below are meant for
_MOST_PIXELS = 40_000_000  # of the enlarged layer that lines are drawn on
_FAR = 1e12  # [dots]
_FONT = 14
_INK: _Rgb = (28, 33, 40)
_Box = tuple[float, float, float, float]


@dataclass(frozen=True)
class Segment:
    """A straight line between two points of the scene, over everything.

    Args:
        start: [m], relative to the scene's origin.
        end: [m].
        color: ``"#rrggbb"``.
        width: [px] in a picture 800 high.
    """

    start: Position
    end: Position
    color: str = "#e2211c"
    width: float = 5.0


@dataclass(frozen=True)
class Mark:
    """A ball at a point of the scene, over everything; arguments as for a segment, the radius in [px]."""

    point: Position
    color: str = "#e2211c"
    radius: float = 7.0


@dataclass(frozen=True)
class Tag:
    """A label beside a point of the scene, joined to it by a leader line.

    Args:
        point: [m], relative to the scene's origin.
        text: a short word.
        color: of the edge of the label.
    """

    point: Position
    text: str
    color: str = "#e2211c"


@dataclass(frozen=True)
class LegendEntry:
    """One line of the legend: a colour, maybe striped, and its meaning."""

    color: str
    text: str
    hatched: bool = False


class Annotated(NamedTuple):
    """A picture with what was drawn over it.

    Args:
        image: RGB.
        tagged: how many of the tags found room.
    """

    image: Image.Image
    tagged: int


def annotate(
    image: Image.Image,
    camera: Camera,
    *,
    segments: Sequence[Segment] = (),
    marks: Sequence[Mark] = (),
    tags: Sequence[Tag] = (),
    legend: Sequence[LegendEntry] = (),
    size: float = 1.0,
    clutter: float = math.inf,
) -> Annotated:
    """Draws lines, balls, tags and a legend over a picture; what lies behind the camera is left out.

    Tags never overlap; one that finds no room is left out.

    Args:
        image: the picture; not changed.
        camera: that it was taken with.
        segments: lines between points.
        marks: balls at points.
        tags: labels beside points, the most important first.
        legend: in the lower left corner.
        size: of letters, lines and balls; more than 1 for a picture that will be shown small.
        clutter: how much a tag may stand away from its point and in the way of others, in its height, see
            :func:`~cadgraph.draw.render.placement.place_boxes`; what would be worse is left out.

    Returns:
        A new image of the same size, and the number of tags in it.
    """
    if not (segments or marks or tags or legend):
        return Annotated(image.convert("RGB"), 0)
    width, height = image.size
    scale = max(0.5, height / _DRAWN_FOR) * size
    zoom = 3 if width * height * 9 <= _MOST_PIXELS else 2 if width * height * 4 <= _MOST_PIXELS else 1
    lines = _drawn_lines(camera, segments)
    places, depths = camera.project([m.point for m in marks]) if marks else (np.zeros((0, 2)), np.zeros(0))
    taken = _legend_box(legend, height, scale) if legend else None
    placed = _placed_tags(image.size, camera, tags, places, lines, taken, scale, clutter)
    layer = Image.new("RGBA", (width * zoom, height * zoom), (255, 255, 255, 0))
    draw = ImageDraw.Draw(layer)
    order = sorted(range(len(segments)), key=lambda i: segments[i].color)
    for i in _on_top(lines * zoom, [(segments[i].color, segments[i].width) for i in order], order):
        _draw_line(draw, lines[i] * zoom, segments[i].color, segments[i].width * scale * zoom)
    order = np.argsort(-depths, kind="stable").tolist()
    for i in _on_top(places * zoom, [(marks[i].color, marks[i].radius) for i in order], order):
        _draw_ball(draw, places[i] * zoom, marks[i].color, marks[i].radius * scale * zoom)
    _draw_tags(draw, placed, scale * zoom, zoom)
    # Downscaling needs colours weighted by their cover, or white would creep into the edges.
    shrunk = layer.convert("RGBa").reduce(zoom).convert("RGBA")
    result = Image.alpha_composite(image.convert("RGBA"), shrunk)
    _write_tags(result, placed, scale)
    if taken is not None:
        _draw_legend(result, legend, taken, scale)
    return Annotated(result.convert("RGB"), len(placed))


@dataclass(frozen=True)
class _Placed:
    """A tag that found room: its point and its box [px]."""

    tag: Tag
    anchor: Floats
    box: Floats


def _drawn_lines(camera: Camera, segments: Sequence[Segment]) -> Floats:
    if not segments:
        return np.zeros((0, 4))
    places, _ = camera.project([point for s in segments for point in (s.start, s.end)])
    return places.reshape(-1, 4)


def _on_top(places: Floats, kinds: Sequence[tuple[str, float]], order: Sequence[int]) -> list[int]:
    """What is drawn: of those alike that lie within the same dots, only the last, which hides the others.

    A line of a plant seen from afar is of thousands of pieces, each shorter than a pixel.

    Args:
        places: ``(n, k)`` coordinates [dots]; what isn't finite is left out.
        kinds: ``(n,)`` colours and sizes, in the order of drawing.
        order: ``(n,)`` of drawing.
    """
    if not order:
        return []
    sound = np.asarray(np.isfinite(places).all(axis=1))
    dots = np.where(sound[:, None], np.clip(places, -_FAR, _FAR), 0.0).round().astype(np.int64)[np.asarray(order)]
    last = {(kind, dot): i for kind, dot, i in zip(kinds, map(tuple, dots.tolist()), order, strict=True) if sound[i]}
    chosen = set(last.values())
    return [i for i in order if i in chosen]


def _draw_line(draw: ImageDraw.ImageDraw, line: Floats, color: str, width: float) -> None:
    x0, y0, x1, y1 = line.tolist()
    for share, fill in _line_tones(color):
        thick = max(1.0, width * share)
        draw.line((x0, y0, x1, y1), fill=fill, width=max(1, round(thick)))
        half = thick / 2
        draw.ellipse((x0 - half, y0 - half, x0 + half, y0 + half), fill=fill)
        draw.ellipse((x1 - half, y1 - half, x1 + half, y1 + half), fill=fill)


@functools.lru_cache(maxsize=64)
def _line_tones(color: str) -> tuple[tuple[float, tuple[int, int, int, int]], ...]:
    """Share of the width and colour of what a line is drawn of, the lowest first."""
    rgb = _rgb(color)
    tones = (1.0, _mixed(rgb, (0, 0, 0), 0.45)), (0.66, rgb), (0.2, _mixed(rgb, (255, 255, 255), 0.35))
    return tuple((share, (*tone, 255)) for share, tone in tones)


def _draw_ball(draw: ImageDraw.ImageDraw, place: Floats, color: str, radius: float) -> None:
    x, y = (float(c) for c in place)
    rgb = _rgb(color)
    steps = 7
    draw.ellipse((x - radius, y - radius, x + radius, y + radius), fill=(*_mixed(rgb, (0, 0, 0), 0.5), 255))
    for i in range(steps):
        share = i / (steps - 1)
        r = radius * (0.88 - 0.7 * share)
        shift = radius * 0.3 * share
        tone = _mixed(rgb, (0, 0, 0), 0.22 - 0.44 * share)
        if share > 0.5:
            tone = _mixed(rgb, (255, 255, 255), 0.9 * (share - 0.5))
        draw.ellipse((x - shift - r, y - shift - r, x - shift + r, y - shift + r), fill=(*tone, 255))


def _placed_tags(
    size: tuple[int, int], camera: Camera, tags: Sequence[Tag], marks: Floats, lines: Floats, taken: _Box | None,
    scale: float, clutter: float,
) -> list[_Placed]:  # fmt: skip
    if not tags:
        return []
    font = _font(round(_FONT * scale))
    anchors, _ = camera.project([tag.point for tag in tags])
    anchors[~((anchors >= 0).all(axis=1) & (anchors <= size).all(axis=1))] = np.nan
    padding = 5 * scale
    extents = [font.getbbox(tag.text) for tag in tags]
    sizes = [(b[2] - b[0] + 2.6 * padding, _line_height(font) + padding) for b in extents]
    boxes = place_boxes(
        anchors, sizes, (4.0, 4.0, size[0] - 4.0, size[1] - 4.0), taken=() if taken is None else [taken],
        points=marks[np.isfinite(marks).all(axis=1)], segments=lines[np.isfinite(lines).all(axis=1)], gap=3 * scale,
        most=clutter,
    )  # fmt: skip
    found = np.flatnonzero(np.isfinite(boxes).all(axis=1))
    return [_Placed(tags[i], anchors[i], boxes[i]) for i in found.tolist()]


def _draw_tags(draw: ImageDraw.ImageDraw, placed: Sequence[_Placed], unit: float, zoom: int) -> None:
    """Leader lines, then the labels without their text."""
    for one in placed:
        near = np.clip(one.anchor, one.box[:2], one.box[2:])
        ends = tuple(float(c) * zoom for c in (*one.anchor, *near))
        draw.line(ends, fill=(255, 255, 255, 230), width=round(3.2 * unit))
        draw.line(ends, fill=(*_INK, 255), width=max(1, round(1.2 * unit)))
    for one in placed:
        left, top, right, bottom = (float(c) * zoom for c in one.box)
        color = (*_rgb(one.tag.color), 255)
        draw.rounded_rectangle(
            (left, top, right, bottom), 4 * unit, (255, 255, 255, 240), color, max(1, round(1.2 * unit))
        )
        draw.rounded_rectangle((left, top, left + 4.5 * unit, bottom), 2 * unit, color)


def _write_tags(image: Image.Image, placed: Sequence[_Placed], scale: float) -> None:
    font, padding = _font(round(_FONT * scale)), 5 * scale
    write = ImageDraw.Draw(image)
    for one in placed:
        x, y = one.box[0] + 1.55 * padding - font.getbbox(one.tag.text)[0], one.box[1] + padding / 2
        write.text((float(round(x)), float(round(y))), one.tag.text, font=font, fill=(*_INK, 255))


def _legend_box(entries: Sequence[LegendEntry], height: int, scale: float) -> _Box:
    """The box that a legend takes in the lower left corner."""
    font = _font(round(_FONT * scale))
    wide = max(font.getlength(entry.text) for entry in entries) + (15 + 3.2 * 10) * scale
    tall = _line_height(font) * 1.3 * len(entries) + 14 * scale
    left, bottom = 12 * scale, height - 12 * scale
    return left, bottom - tall, left + wide, bottom


def _draw_legend(image: Image.Image, entries: Sequence[LegendEntry], box: _Box, scale: float) -> None:
    font = _font(round(_FONT * scale))
    line, swatch, pad = _line_height(font) * 1.3, 15 * scale, 10 * scale
    layer = Image.new("RGBA", image.size, (255, 255, 255, 0))
    draw = ImageDraw.Draw(layer)
    draw.rounded_rectangle(box, 6 * scale, (255, 255, 255, 222), (200, 206, 214, 255), 1)
    for i, entry in enumerate(entries):
        x, y = box[0] + pad, box[1] + 0.7 * pad + i * line
        middle = y + line / 2
        place = (x, middle - swatch / 2, x + swatch, middle + swatch / 2)
        rgb = _rgb(entry.color)
        draw.rectangle(place, (*rgb, 255))
        if entry.hatched:
            _hatch(draw, place, _mixed(rgb, (0, 0, 0), 0.3), scale)
        draw.rectangle(place, None, (*_mixed(rgb, (0, 0, 0), 0.35), 255), 1)
        draw.text((x + swatch + 0.8 * pad, middle), entry.text, font=font, fill=(*_INK, 255), anchor="lm")
    image.alpha_composite(layer)


def _hatch(draw: ImageDraw.ImageDraw, box: _Box, color: _Rgb, scale: float) -> None:
    left, top, right, _ = box
    side, step = right - left, 4 * scale
    for k in range(1, int(2 * side / step) + 1):
        # The part of the line x + y = reach that lies within the square.
        reach = k * step
        first, last = max(0.0, reach - side), min(side, reach)
        draw.line((left + first, top + reach - first, left + last, top + reach - last), fill=(*color, 255), width=1)


@functools.cache
def _font(size: int) -> ImageFont.FreeTypeFont:
    font = ImageFont.load_default(max(8, size))
    if not isinstance(font, ImageFont.FreeTypeFont):
        raise RuntimeError("this build of Pillow lacks FreeType, which labels in pictures need; install its wheel")
    return font


def _line_height(font: ImageFont.FreeTypeFont) -> float:
    ascent, descent = font.getmetrics()
    return float(ascent + descent)


def _rgb(color: str) -> _Rgb:
    return int(color[1:3], 16), int(color[3:5], 16), int(color[5:7], 16)


def _mixed(color: _Rgb, other: _Rgb, share: float) -> _Rgb:
    if share < 0:
        return color
    red, green, blue = (round(a * (1 - share) + b * share) for a, b in zip(color, other, strict=True))
    return red, green, blue
