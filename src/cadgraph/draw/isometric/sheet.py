"""A sheet on which every text finds a place of its own."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from cadgraph._io.text import printable
from cadgraph.draw.svg import Svg, element

__all__ = ["COS", "LINE_HEIGHT", "SIN", "Box", "Isometric", "Spot", "back", "between", "meet", "off", "short"]

Spot = tuple[float, float]
Box = tuple[float, float, float, float]
"""Left, top, right, bottom."""
COS, SIN = math.cos(math.radians(30)), 0.5
_GAP = 4.0
_LETTER, LINE_HEIGHT = 6.2, 13.0  # width and height of the letters of a text of size 11, generous
_LONGEST = 48  # letters of a text on the sheet
_MOST_TURNS = 400  # tries to find a place for a text


@dataclass
class Isometric:
    """A drawing in the making.

    Args:
        shapes: pieces of SVG, in the order that they are drawn.
        texts: place of each text on the sheet, with its letters.
        solid: places of what no text may lie on.
        turned: whether north is to the upper left.
    """

    shapes: list[Svg] = field(default_factory=list)
    texts: list[tuple[Box, str]] = field(default_factory=list)
    solid: list[Box] = field(default_factory=list)
    turned: bool = False
    _waiting: list[tuple[Spot, Sequence[str], Spot, str]] = field(default_factory=list)

    def line(self, points: Sequence[Spot], style: str, *, solid: bool = True) -> None:
        """A line through points; short boxes along it keep texts away."""
        way = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
        self.shapes.append(element("path", d=way, class_=style))
        if solid:
            for a, b in pairwise(points):
                steps = max(1, math.ceil(math.dist(a, b) / 8))
                for i in range(steps + 1):
                    x, y = a[0] + (b[0] - a[0]) * i / steps, a[1] + (b[1] - a[1]) * i / steps
                    self.solid.append((x - 2, y - 2, x + 2, y + 2))

    def area(self, points: Sequence[Spot], style: str = "s") -> None:
        """A filled shape."""
        way = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points) + "Z"
        self.shapes.append(element("path", d=way, class_=style))
        xs, ys = zip(*points, strict=True)
        self.solid.append((min(xs), min(ys), max(xs), max(ys)))

    def dot(self, at: Spot, radius: float, style: str) -> None:
        """A circle."""
        self.shapes.append(element("circle", cx=at[0], cy=at[1], r=radius, class_=style))
        self.solid.append((at[0] - radius, at[1] - radius, at[0] + radius, at[1] + radius))

    def text(self, at: Spot, lines: Sequence[str], away: Spot, style: str = "t") -> None:
        """Some lines of text near a point, for :meth:`settle` to find room for, first in a direction."""
        self._waiting.append((at, lines, away, style))

    def settle(self) -> None:
        """Puts each text as near to its point as there is room, now that all else is drawn."""
        for at, lines, away, style in self._waiting:
            self._put(at, lines, away, style)
        self._waiting.clear()

    def _put(self, at: Spot, lines: Sequence[str], away: Spot, style: str) -> None:
        lines = [short(line) for line in lines if line]
        wide, high = max(map(len, lines)) * _LETTER + 2 * _GAP, len(lines) * LINE_HEIGHT + _GAP
        box = self._room(at, wide, high, math.atan2(away[1], away[0]))
        middle = ((box[0] + box[2]) / 2, (box[1] + box[3]) / 2)
        if math.dist(middle, at) > max(wide, high) / 2 + 26:
            nearest = (min(max(at[0], box[0]), box[2]), min(max(at[1], box[1]), box[3]))
            # Not from the very point: that would cross out the symbol there.
            self.line([between(at, nearest, min(0.5, 9 / math.dist(at, nearest))), nearest], "d", solid=False)
        for number, line in enumerate(lines):
            y = box[1] + (number + 1) * LINE_HEIGHT - 2
            self.shapes.append(element("text", line, x=middle[0], y=y, text_anchor="middle", class_=style))
        self.texts.append((box, " / ".join(lines)))

    def _room(self, at: Spot, wide: float, high: float, first: float) -> Box:
        box: Box = (0.0, 0.0, 0.0, 0.0)
        for turn in range(_MOST_TURNS):
            # Around the point in widening rings, at each to both sides of the wanted direction.
            ring, step = divmod(turn, 12)
            angle = first + (step + 1) // 2 * (1 if step % 2 else -1) * math.radians(30)
            reach = 8.0 + 12.0 * ring
            x = at[0] + math.cos(angle) * (reach + wide / 2)
            y = at[1] + math.sin(angle) * (reach + high / 2)
            box = (x - wide / 2, y - high / 2, x + wide / 2, y + high / 2)
            if not any(meet(box, other) for other in self.solid) and not any(meet(box, b) for b, _ in self.texts):
                break
        return box


def off(at: Spot, way: Spot, distance: float) -> Spot:
    """The spot so far from another in a direction."""
    return at[0] + way[0] * distance, at[1] + way[1] * distance


def between(a: Spot, b: Spot, share: float) -> Spot:
    """The spot at a share of the way from one to another."""
    return a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share


def back(at: Spot, inward: Spot) -> Spot:
    """The direction from one spot away from another."""
    return at[0] - inward[0], at[1] - inward[1]


def meet(one: Box, other: Box) -> bool:
    """Whether two boxes overlap."""
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


def short(text: str) -> str:
    """A text that fits on the sheet, without what can't be printed."""
    clean = printable(text)
    return clean if len(clean) <= _LONGEST else clean[: _LONGEST - 1] + "\u2026"
