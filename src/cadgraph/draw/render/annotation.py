"""Lines, marks, tags and legends drawn over a picture."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from cadgraph.draw.render.camera import Camera
from cadgraph.draw.render.placement import place_boxes
from cadgraph.model.scene import Floats

__all__ = ["LegendEntry", "Mark", "Segment", "Tag", "annotate"]

Position = tuple[float, float, float]
_Rgb = tuple[int, int, int]

_DRAWN_FOR = 800  # [px] height of the picture that the sizes below are meant for
_MOST_PIXELS = 40_000_000  # of the enlarged layer that lines are drawn on
_FONT = 14
_INK: _Rgb = (28, 33, 40)


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


def annotate(
    image: Image.Image,
    camera: Camera,
    *,
    segments: Sequence[Segment] = (),
    marks: Sequence[Mark] = (),
    tags: Sequence[Tag] = (),
    legend: Sequence[LegendEntry] = (),
    size: float = 1.0,
) -> Image.Image:
    """Draws over a picture, in the order lines, balls, legend, tags; what lies behind the camera is left out.

    Tags never overlap; one that finds no room is left out.

    Args:
        image: the picture; not changed.
        camera: that it was taken with.
        segments: lines between points.
        marks: balls at points.
        tags: labels beside points.
        legend: in the lower left corner.
        size: of letters, lines and balls; more than 1 for a picture that will be shown small.

    Returns:
        A new RGB image of the same size.
    """
    width, height = image.size
    scale = max(0.5, height / _DRAWN_FOR) * size
    zoom = 3 if width * height * 9 <= _MOST_PIXELS else 2 if width * height * 4 <= _MOST_PIXELS else 1
    layer = Image.new("RGBA", (width * zoom, height * zoom), (255, 255, 255, 0))
    draw = ImageDraw.Draw(layer)
    lines = _drawn_lines(camera, segments)
    places, depths = camera.project([m.point for m in marks]) if marks else (np.zeros((0, 2)), np.zeros(0))
    for segment, line in sorted(zip(segments, lines, strict=True), key=lambda pair: pair[0].color):
        if np.isfinite(line).all():
            _draw_line(draw, line * zoom, segment.color, segment.width * scale * zoom)
    for i in np.argsort(-depths, kind="stable"):
        if np.isfinite(places[i]).all():
            _draw_ball(draw, places[i] * zoom, marks[i].color, marks[i].radius * scale * zoom)
    # Downscaling needs colours weighted by their cover, or white would creep into the edges.
    shrunk = layer.convert("RGBa").reduce(zoom).convert("RGBA")
    result = Image.alpha_composite(image.convert("RGBA"), shrunk)
    taken = _draw_legend(result, legend, scale) if legend else None
    if tags:
        result = _draw_tags(result, camera, tags, places, lines, taken, scale)
    return result.convert("RGB")


def _drawn_lines(camera: Camera, segments: Sequence[Segment]) -> Floats:
    if not segments:
        return np.zeros((0, 4))
    places, _ = camera.project([point for s in segments for point in (s.start, s.end)])
    return places.reshape(-1, 4)


def _draw_line(draw: ImageDraw.ImageDraw, line: Floats, color: str, width: float) -> None:
    x0, y0, x1, y1 = (float(c) for c in line)
    rgb = _rgb(color)
    for share, tone in ((1.0, _mixed(rgb, (0, 0, 0), 0.45)), (0.66, rgb), (0.2, _mixed(rgb, (255, 255, 255), 0.35))):
        thick = max(1.0, width * share)
        draw.line((x0, y0, x1, y1), fill=(*tone, 255), width=max(1, round(thick)))
        for x, y in ((x0, y0), (x1, y1)):
            draw.ellipse((x - thick / 2, y - thick / 2, x + thick / 2, y + thick / 2), fill=(*tone, 255))


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


def _draw_tags(
    image: Image.Image,
    camera: Camera,
    tags: Sequence[Tag],
    marks: Floats,
    lines: Floats,
    taken: tuple[float, float, float, float] | None,
    scale: float,
) -> Image.Image:
    font = _font(round(_FONT * scale))
    anchors, _ = camera.project([tag.point for tag in tags])
    inside = (anchors >= 0).all(axis=1) & (anchors <= image.size).all(axis=1)
    anchors[~inside] = np.nan
    padding = 5 * scale
    extents = [font.getbbox(tag.text) for tag in tags]
    sizes = [(b[2] - b[0] + 2.6 * padding, _line_height(font) + padding) for b in extents]
    area = (4.0, 4.0, image.width - 4.0, image.height - 4.0)
    seen = marks[np.isfinite(marks).all(axis=1)]
    drawn = lines[np.isfinite(lines).all(axis=1)]
    boxes = place_boxes(
        anchors, sizes, area, taken=() if taken is None else [taken], points=seen, segments=drawn, gap=3 * scale
    )
    zoom = 3 if image.width * image.height * 9 <= _MOST_PIXELS else 1
    layer = Image.new("RGBA", (image.width * zoom, image.height * zoom), (255, 255, 255, 0))
    draw = ImageDraw.Draw(layer)
    placed = [i for i in range(len(tags)) if np.isfinite(boxes[i]).all()]
    for i in placed:
        near = np.clip(anchors[i], boxes[i, :2], boxes[i, 2:])
        ends = tuple(float(c) * zoom for c in (*anchors[i], *near))
        draw.line(ends, fill=(255, 255, 255, 230), width=round(3.2 * scale * zoom))
        draw.line(ends, fill=(*_INK, 255), width=max(1, round(1.2 * scale * zoom)))
    for i in placed:
        left, top, right, bottom = (float(c) * zoom for c in boxes[i])
        edge = max(1, round(1.2 * scale * zoom))
        draw.rounded_rectangle(
            (left, top, right, bottom), 4 * scale * zoom, (255, 255, 255, 240), (*_rgb(tags[i].color), 255), edge
        )
        draw.rounded_rectangle(
            (left, top, left + 4.5 * scale * zoom, bottom), 2 * scale * zoom, (*_rgb(tags[i].color), 255)
        )
    shrunk = layer.convert("RGBa").reduce(zoom).convert("RGBA")
    result = Image.alpha_composite(image, shrunk)
    write = ImageDraw.Draw(result)
    for i in placed:
        x, y = boxes[i, 0] + 1.55 * padding - extents[i][0], boxes[i, 1] + padding / 2
        write.text((float(round(x)), float(round(y))), tags[i].text, font=font, fill=(*_INK, 255))
    return result


def _draw_legend(image: Image.Image, entries: Sequence[LegendEntry], scale: float) -> tuple[float, float, float, float]:
    """Draws into the image; returns the box that it takes."""
    font = _font(round(_FONT * scale))
    line, swatch, pad = _line_height(font) * 1.3, 15 * scale, 10 * scale
    wide = max(font.getlength(entry.text) for entry in entries) + swatch + 3.2 * pad
    tall = line * len(entries) + 1.4 * pad
    left, bottom = 12 * scale, image.height - 12 * scale
    box = (left, bottom - tall, left + wide, bottom)
    layer = Image.new("RGBA", image.size, (255, 255, 255, 0))
    draw = ImageDraw.Draw(layer)
    draw.rounded_rectangle(box, 6 * scale, (255, 255, 255, 222), (200, 206, 214, 255), 1)
    for i, entry in enumerate(entries):
        x, y = left + pad, box[1] + 0.7 * pad + i * line
        middle = y + line / 2
        place = (x, middle - swatch / 2, x + swatch, middle + swatch / 2)
        rgb = _rgb(entry.color)
        draw.rectangle(place, (*rgb, 255))
        if entry.hatched:
            _hatch(draw, place, _mixed(rgb, (0, 0, 0), 0.3), scale)
        draw.rectangle(place, None, (*_mixed(rgb, (0, 0, 0), 0.35), 255), 1)
        draw.text((x + swatch + 0.8 * pad, middle), entry.text, font=font, fill=(*_INK, 255), anchor="lm")
    image.alpha_composite(layer)
    return box


def _hatch(draw: ImageDraw.ImageDraw, box: tuple[float, float, float, float], color: _Rgb, scale: float) -> None:
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
