"""How many parts carry which label, as the paper draws it: a pie of names, tinted by group."""

from __future__ import annotations

import functools
import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from PIL import Image, ImageDraw, ImageFont

from cadgraph.draw.colors import UNLABELLED, group_colors
from cadgraph.model.graph import SceneGraph

__all__ = ["Slice", "distribution", "draw_pies"]

_LEAST = 25 / 2068
"""Rarer labels are drawn together (paper, caption of the pie: less than 25 of 2,068 parts)."""

_WHOLE_GROUPS = ("Valve assembly", "Gauge assembly")
_OTHERS = "others"
_SIZE = (860, 520)  # px of one pie with its labels
_RADIUS, _ZOOM, _LETTERS = 150, 3, 15
_INK, _FAINT = "#1f2933", "#8b95a1"
_TINTS = (0.0, 0.28, 0.14, 0.42, 0.07, 0.35, 0.21, 0.49)


@dataclass(frozen=True)
class Slice:
    """One sector.

    Args:
        title: a name, a whole group, ``"others"`` or ``"unlabelled"``.
        count: how many parts.
        color: ``"#rrggbb"``.
    """

    title: str
    count: int
    color: str


def distribution(graph: SceneGraph) -> tuple[Slice, ...]:
    """The sectors of a graph's labels: by group as the vocabulary has them, in a group the commonest first.

    Valves and gauges are one sector each, and labels rarer than 25 in 2,068 go together, as in the paper.
    """
    colors = group_colors(graph)
    counts = Counter(
        (
            part.label.group,
            part.label.group
            if part.label.group in _WHOLE_GROUPS
            else part.label.name or f"{part.label.group}, unnamed",
        )
        for part in graph.parts()
        if part.label is not None
    )
    total = len(graph.parts())
    slices, rare = [], 0
    for group, color in colors.items():
        names = sorted((n, name) for (of, name), n in counts.items() if of == group)
        frequent = [(name, n) for n, name in reversed(names) if n >= _LEAST * total]
        rare += sum(n for n, _ in names) - sum(n for _, n in frequent)
        slices += [
            Slice(name.lower(), n, _lighter(color, _TINTS[i % len(_TINTS)])) for i, (name, n) in enumerate(frequent)
        ]
    bare = total - sum(counts.values())
    slices += [Slice(_OTHERS, rare, "#b3bac3")] if rare else []
    slices += [Slice("unlabelled", bare, UNLABELLED)] if bare else []
    return tuple(slices)


def draw_pies(pies: Sequence[tuple[str, Sequence[Slice]]]) -> Image.Image:
    """Draws pies side by side, each under its title."""
    width, height = _SIZE
    image = Image.new("RGB", (width * len(pies) * _ZOOM, height * _ZOOM), "white")
    draw = ImageDraw.Draw(image)
    for number, (title, slices) in enumerate(pies):
        middle = ((number + 0.5) * width, height / 2 + 14)
        _text(draw, (middle[0], 22), title, "mm", 18)
        _draw_pie(draw, middle, slices)
    return image.reduce(_ZOOM)


def _draw_pie(draw: ImageDraw.ImageDraw, middle: tuple[float, float], slices: Sequence[Slice]) -> None:
    total = sum(one.count for one in slices)
    if not total:
        return
    turn = -90.0
    angles = []
    box = tuple((c + s * _RADIUS) * _ZOOM for s in (-1, 1) for c in middle)
    for one in slices:
        sweep = 360 * one.count / total
        draw.pieslice(box, turn, turn + sweep, fill=one.color, outline="white", width=_ZOOM)
        angles.append(math.radians(turn + sweep / 2))
        turn += sweep
    for side in (1, -1):
        chosen = [i for i, angle in enumerate(angles) if (math.cos(angle) >= 0) == (side > 0)]
        chosen.sort(key=lambda i: math.sin(angles[i]))
        heights = _spread([middle[1] + 1.15 * _RADIUS * math.sin(angles[i]) for i in chosen], middle[1])
        for i, y in zip(chosen, heights, strict=True):
            edge = (middle[0] + _RADIUS * math.cos(angles[i]), middle[1] + _RADIUS * math.sin(angles[i]))
            elbow = (middle[0] + side * 1.18 * _RADIUS, y)
            end = (elbow[0] + side * 10, y)
            draw.line([(x * _ZOOM, h * _ZOOM) for x, h in (edge, elbow, end)], fill=_FAINT, width=_ZOOM)
            words = f"{slices[i].title} {slices[i].count:,} ({100 * slices[i].count / total:.1f} %)"
            _text(draw, (end[0] + side * 5, y), words, "lm" if side > 0 else "rm", _LETTERS)


def _spread(wanted: Sequence[float], middle: float) -> list[float]:
    """Heights in ascending order, at least a line apart, as near to the wanted ones as a pass down and up gets them."""
    line = _LETTERS * 1.35
    heights: list[float] = []
    for y in wanted:
        heights.append(max(y, heights[-1] + line) if heights else y)
    low = middle + _SIZE[1] / 2 - 2 * line
    for i in reversed(range(len(heights))):
        heights[i] = min(heights[i], low)
        low = heights[i] - line
    return heights


def _text(
    draw: ImageDraw.ImageDraw, place: tuple[float, float], text: str, anchor: str, size: int, color: str = _INK
) -> None:
    draw.text((place[0] * _ZOOM, place[1] * _ZOOM), text, font=_font(size * _ZOOM), fill=color, anchor=anchor)


@functools.cache
def _font(size: int) -> ImageFont.FreeTypeFont:
    font = ImageFont.load_default(size)
    if not isinstance(font, ImageFont.FreeTypeFont):
        raise RuntimeError("this build of Pillow lacks FreeType, which labels in pictures need; install its wheel")
    return font


def _lighter(color: str, share: float) -> str:
    """The colour, mixed with white."""
    channels = (int(color[i : i + 2], 16) for i in (1, 3, 5))
    return "#" + "".join(f"{round(c + (255 - c) * share):02x}" for c in channels)
