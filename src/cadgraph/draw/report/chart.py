"""How many parts carry which label, as an inline drawing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from markupsafe import Markup

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


def draw_bars(bars: Sequence[Bar]) -> Markup:
    """A horizontal bar for each group, divided by name; counts and shares at the right.

    Every text is escaped. Colours of text come from the page's style sheet, so that they follow its light or dark mode.

    Args:
        bars: in the order to draw.

    Returns:
        An ``svg`` element; empty without any part.
    """
    total = sum(bar.count for bar in bars)
    if not total:
        return Markup("")
    longest = max(bar.count for bar in bars)
    room = _WIDTH - _LABEL - _COUNT
    height = _ROW * len(bars) + 4
    drawn = [_row(bar, i * _ROW + 4, room / longest, total) for i, bar in enumerate(bars)]
    summary = "; ".join(f"{bar.title}: {bar.count}" for bar in bars)
    stripes = Markup(
        '<defs><pattern id="stripes" width="6" height="6" patternUnits="userSpaceOnUse" '
        'patternTransform="rotate(45)"><rect width="6" height="6" fill="#d3d8de"/>'
        '<rect width="2" height="6" fill="#a9b1bb"/></pattern></defs>'
    )
    return Markup(
        '<svg class="chart" viewBox="0 0 {w} {h}" role="img" aria-label="Parts by group. {label}">{defs}{rows}</svg>'
    ).format(w=_WIDTH, h=height, label=summary, defs=stripes, rows=Markup("").join(drawn))


def _row(bar: Bar, top: float, scale: float, total: int) -> Markup:
    middle = top + _ROW / 2 - 4
    pieces = [
        Markup('<text class="name" x="{x}" y="{y}" text-anchor="end">{text}</text>').format(
            x=_LABEL - 10, y=round(middle + 4, 1), text=_shortened(bar.title, _LABEL - 14)
        )
    ]
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
    pieces.append(
        Markup('<text class="count" x="{x}" y="{y}">{n} <tspan class="share">{share}{names}</tspan></text>').format(
            x=round(left + 8, 2),
            y=round(middle + 4, 1),
            n=f"{bar.count:,}",
            share=share,
            names=_listed(unnamed, room),
        )
    )
    return Markup("").join(pieces)


def _segment(bar: Bar, name: str, count: int, place: tuple[float, float, float], number: int) -> Markup:
    left, top, width = place
    label = name if _fits(name, width) else ""
    text = Markup('<text class="{kind}" x="{x}" y="{y}">{text}</text>').format(
        kind="dark" if bar.hatched else "light", x=round(left + 5, 2), y=round(top + _ROW / 2, 1), text=label
    )
    # Alternating tints keep neighbours apart without another colour.
    tint = 1.0 if bar.hatched else (1.0, 0.78, 0.89, 0.7)[number % 4]
    return Markup(
        '<g><title>{name}: {count}</title><rect x="{x}" y="{y}" width="{width}" height="{height}" rx="2" '
        'fill="{fill}" fill-opacity="{tint}"/>{text}</g>'
    ).format(
        name=name,
        count=count,
        x=round(left, 2),
        y=round(top, 2),
        width=round(max(width - 1, 0.6), 2),
        height=_ROW - 9,
        fill="url(#stripes)" if bar.hatched else bar.color,
        tint=tint,
        text=text if label else "",
    )


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
    if len(text) <= most:
        return text
    return str(text[: most - 1].rstrip() + "…") if most >= 5 else ""
