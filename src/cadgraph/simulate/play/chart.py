"""Letters and line charts of a picture strip."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PIL import ImageDraw, ImageFont

from cadgraph.model.scene import Floats

__all__ = ["Line", "draw_chart", "fitted", "font"]

_COLORS = ("#20913e", "#8a45e6", "#d62a1e", "#b9770e", "#0f7f7c")  # not those of what flows and what is operated
_INK, _PALE, _GRID = "#1c2128", "#6a7480", "#e3e7ec"
_LEAST_RANGE = 0.1
_LETTERS = 15
_INWARD = (46, 24, -58, -26)  # [px] from the left, top, right and bottom to the lines: room for what is written there
_TICKS = 5


@dataclass(frozen=True)
class Line:
    """A line of a chart.

    Args:
        name: what is written at its end.
        values: ``(n,)`` one for each time, NaN where it is unknown; not all are.
    """

    name: str
    values: Floats


def draw_chart(
    draw: ImageDraw.ImageDraw, box: tuple[float, float, float, float], times: Floats, lines: Sequence[Line],
    marks: Sequence[float], unit: str,
) -> None:  # fmt: skip
    """Draws values over time.

    Args:
        draw: what is drawn on.
        box: left, top, right and bottom [px].
        times: ``(n,)`` [s].
        lines: one colour each; at most five.
        marks: times that have a vertical line.
        unit: of the values, written above them.
    """
    left, top, right, bottom = (side + room for side, room in zip(box, _INWARD, strict=True))
    every = np.concatenate([line.values for line in lines])
    ticks = _ticks(float(np.nanmin(every)), float(np.nanmax(every)))
    low, high = ticks[0], ticks[-1]

    def x(time: float) -> float:
        return left + (right - left) * time / float(times[-1])

    def y(value: float) -> float:
        return bottom - (bottom - top) * (value - low) / (high - low)

    digits = max(0, -math.floor(math.log10(ticks[1] - ticks[0]) + 1e-9))
    for tick in ticks:
        draw.line((left, y(tick), right, y(tick)), _GRID, 1)
        draw.text((left - 6, y(tick)), f"{round(tick, digits) + 0.0:.{digits}f}", _PALE, font(_LETTERS), "rm")
    draw.text((box[0], box[1] - 4), unit, _PALE, font(_LETTERS))
    for mark in marks:
        draw.line((x(mark), top, x(mark), bottom), _GRID, 1)
        draw.text((x(mark), bottom + 5), f"{mark:.0f} s", _PALE, font(_LETTERS), "ma")
    for line, color in zip(lines, _COLORS, strict=False):
        known = np.isfinite(line.values)
        points = [(x(time), y(value)) for time, value in zip(times[known], line.values[known], strict=True)]
        draw.line(points, color, 3, "curve")
    ends = _spread([y(float(line.values[np.isfinite(line.values)][-1])) for line in lines], _LETTERS + 3.0, top, bottom)
    for line, color, end in zip(lines, _COLORS, ends, strict=False):
        draw.text((right + 6, end), line.name, color, fitted(line.name, -_INWARD[2] - 6, _LETTERS), "lm")


def _ticks(low: float, high: float) -> list[float]:
    """Round numbers from below the least value to above the greatest."""
    spread = max(high - low, _LEAST_RANGE)
    size = 10.0 ** math.floor(math.log10(spread / _TICKS))
    step = next(size * k for k in (1, 2, 2.5, 5, 10) if spread / (size * k) <= _TICKS)
    first = math.floor(low / step + 1e-9)
    last = max(math.ceil(high / step - 1e-9), first + 1)
    return [k * step for k in range(first, last + 1)]


def _spread(places: Sequence[float], apart: float, top: float, bottom: float) -> list[float]:
    """Places moved so far that none is nearer than this to another, in the same order, as near as can be."""
    order = sorted(range(len(places)), key=lambda k: places[k])
    found = list(places)
    for k, following in zip(order, order[1:], strict=False):
        found[following] = max(found[following], found[k] + apart)
    below = bottom
    for k in reversed(order):
        found[k] = min(found[k], below)
        below = found[k] - apart
    return [max(place, top - apart) for place in found]


@functools.cache
def font(size: int) -> ImageFont.FreeTypeFont:
    """Letters of a size [px]."""
    found = ImageFont.load_default(size)
    if not isinstance(found, ImageFont.FreeTypeFont):
        raise RuntimeError("this build of Pillow lacks FreeType, which letters in pictures need; install its wheel")
    return found


def fitted(text: str, width: float, most: int = 20) -> ImageFont.FreeTypeFont:
    """The largest letters, up to a size, in which a text fits into a width; 9 where it doesn't even in those."""
    return next((font(size) for size in range(most, 9, -1) if font(size).getlength(text) <= width), font(9))
