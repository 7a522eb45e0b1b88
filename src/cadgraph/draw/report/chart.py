"""How many parts carry which label, as an inline drawing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from cadgraph._io.text import shortened
from cadgraph.draw.svg import Svg, element, joined

__all__ = ["Bar", "draw_bars"]

_WIDTH, _ROW, _LABEL, _COUNT = 960, 34, 190, 110  # [px] of the drawing, of which the page may show a smaller copy
_LETTER = 6.6  # [px] mean width of a letter at 12 px


@dataclass(frozen=True)
class Bar:
    """One group.

    Args:
        title: the group.
        color: ``"#rrggbb"``.
        segments: names in the group and how many parts carry each, the commonest first.
        hatched: whether it stands for parts without a label.
    """

    title: str
    color: str
    segments: tuple[tuple[str, int], ...]
    hatched: bool = False

    @property
    def count(self) -> int:
        """How many parts there are in the group."""
        return sum(count for _, count in self.segments)


def draw_bars(bars: Sequence[Bar]) -> Svg:
    """A horizontal bar for each group, divided by name; counts and shares at the right.

    Every text is escaped. Colours of text come from the page's style sheet, so that they follow its light or dark mode.

    Args:
        bars: in the order to draw.

    Returns:
        An ``svg`` element; empty without any part.
    """
    total = sum(bar.count for bar in bars)
    if not total:
        return Svg()
    longest = max(bar.count for bar in bars)
    room = _WIDTH - _LABEL - _COUNT
    height = _ROW * len(bars) + 4
    drawn = [_row(bar, i * _ROW + 4, room / longest, total) for i, bar in enumerate(bars)]
    summary = "; ".join(f"{bar.title}: {bar.count}" for bar in bars)
    stripes = element(
        "pattern",
        element("rect", width=6, height=6, fill="#d3d8de"),
        element("rect", width=2, height=6, fill="#a9b1bb"),
        id="stripes",
        width=6,
        height=6,
        patternUnits="userSpaceOnUse",
        patternTransform="rotate(45)",
    )
    return element(
        "svg",
        element("defs", stripes),
        *drawn,
        class_="chart",
        viewBox=f"0 0 {_WIDTH} {height}",
        role="img",
        aria_label=f"Parts by group. {summary}",
    )


def _row(bar: Bar, top: float, scale: float, total: int) -> Svg:
    middle = top + _ROW / 2 - 4
    title = _shortened(bar.title, _LABEL - 14)
    pieces = [element("text", title, class_="name", x=_LABEL - 10, y=middle + 4, text_anchor="end")]
    left = float(_LABEL)
    unnamed = []
    for i, (name, count) in enumerate(bar.segments):
        width = count * scale
        pieces.append(_segment(bar, name, count, (left, top, width), i))
        if not _fits(name, width):
            unnamed.append(name)
        left += width
    share = f"{100 * bar.count / total:.1f} %"
    room = _WIDTH - left - 24 - _LETTER * len(f"{bar.count:,} {share}")
    shares = element("tspan", share + _listed(unnamed, room), class_="share")
    pieces.append(element("text", f"{bar.count:,} ", shares, class_="count", x=left + 8, y=middle + 4))
    return joined(pieces)


def _segment(bar: Bar, name: str, count: int, place: tuple[float, float, float], number: int) -> Svg:
    left, top, width = place
    # Alternating tints keep neighbours apart without another colour.
    tint = 1.0 if bar.hatched else (1.0, 0.78, 0.89, 0.7)[number % 4]
    fill = "url(#stripes)" if bar.hatched else bar.color
    pieces = [
        element("title", f"{name}: {count}"),
        element("rect", x=left, y=top, width=max(width - 1, 0.6), height=_ROW - 9, rx=2, fill=fill, fill_opacity=tint),
    ]
    if _fits(name, width):
        kind = "dark" if bar.hatched else "light"
        pieces.append(element("text", name, class_=kind, x=left + 5, y=top + _ROW / 2))
    return element("g", *pieces)


def _fits(name: str, width: float) -> bool:
    return len(name) * _LETTER + 8 <= width


def _listed(names: Sequence[str], room: float) -> str:
    """As many of the names as there is room for, after a dash."""
    text = ""
    for i, name in enumerate(names):
        longer = f"{text}, {name}" if text else f"  –  {name}"
        rest = ", …" if i + 1 < len(names) else ""
        if (len(longer) + len(rest)) * _LETTER > room:
            return f"{text}, …" if text else ""
        text = longer
    return text


def _shortened(text: str, width: float) -> str:
    """The text, cut to a width; nothing where not even three letters fit."""
    most = int(width / _LETTER)
    return shortened(text, most) if most >= min(5, len(text)) else ""
