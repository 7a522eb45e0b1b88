"""The figures of an evaluation, as SVG that stands alone."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from cadgraph._io.atomic import ensure_writable, write_atomically
from cadgraph.draw.svg import Svg, element, joined
from cadlab.evaluate.evaluation import Evaluation
from cadlab.evaluate.labels import Calibration, Confusion
from cadlab.evaluate.scores import ClassScore

__all__ = ["figures"]

_INK, _FAINT, _LINE, _PAPER = "#1f2933", "#66707c", "#d7dce2", "#ffffff"
_BARS = (("precision", "#1f6fd1"), ("recall", "#0f8a74"), ("F1", "#8a45e6"))
_BLUE = (31, 95, 180)  # of a full cell, sRGB
_WRONG = (196, 60, 40)
_LETTER = 6.7  # [px] mean width of a letter at 12 px
_MOST_CLASSES = 60  # beyond that a matrix can't be read any more


def figures(evaluation: Evaluation, folder: str | Path) -> tuple[Path, ...]:
    """Draws reliability, confusion and the scores of each class, for everything, per part.

    Args:
        evaluation: what was measured.
        folder: made if missing.

    Returns:
        The files that were written; a figure without any content, or a matrix of more than 60 classes, is left out.

    Raises:
        OutputError: the folder can't be written.
    """
    target = ensure_writable(folder)
    parts, total = evaluation.total.parts, evaluation.total
    drawn = {
        "reliability.svg": _reliability((total.group_calibration, total.name_calibration)),
        "confusion-groups.svg": _confusion(parts.group.confusion, "Groups, per part"),
        "confusion-names.svg": _confusion(parts.name.confusion, "Names, per part"),
        "scores-groups.svg": _bars(parts.group.classes, "Scores by group, per part"),
        "scores-names.svg": _bars(parts.name.classes, "Scores by name, per part"),
    }
    written = []
    for name, picture in drawn.items():
        if picture:
            write_atomically(target / name, picture.encode("utf-8", "replace"))
            written.append(target / name)
    return tuple(written)


def _reliability(calibrations: Sequence[Calibration]) -> str:
    """Accuracy over confidence, a square each; the closer to the diagonal, the more confidence can be believed."""
    if not any(b.n for c in calibrations for b in c.bins):
        return ""
    side, gap, left, top = 300, 90, 60, 50
    pieces: list[Svg] = []
    for number, calibration in enumerate(calibrations):
        x, y = left + number * (side + gap), top
        dots: list[Svg] = []
        ece = "no labels" if calibration.ece is None else f"ECE {calibration.ece:.3f}"
        pieces.append(_text(x, y - 16, f"Confidence of {calibration.task}s: {ece}", size=14, weight=600))
        for step in range(6):
            at, share = side * step / 5, f"{step / 5:.1f}"
            pieces.append(_rule(x, y + side - at, x + side, y + side - at))
            pieces.append(_text(x - 8, y + side - at + 4, share, "end", _FAINT))
            pieces.append(_text(x + at, y + side + 18, share, "middle", _FAINT))
        for b in calibration.bins:
            if b.accuracy is None or b.confidence is None:
                continue
            width, height = (b.high - b.low) * side, b.accuracy * side
            title = f"{b.n} parts, mean confidence {b.confidence:.3f}, accuracy {b.accuracy:.3f}"
            pieces.append(_box(x + b.low * side + 1, y + side - height, width - 2, height, "#9ec2ee", title))
            dots.append(element("circle", cx=x + b.confidence * side, cy=y + side - height, r=4, fill=_BARS[0][1]))
            pieces.append(_text(x + (b.low + b.high) / 2 * side, y + side - 6, str(b.n), "middle", _INK, 11))
        pieces += dots
        pieces.append(element("line", x1=x, y1=y + side, x2=x + side, y2=y, stroke=_INK, stroke_dasharray="4 4"))
        pieces.append(_text(x + side / 2, y + side + 38, "confidence", "middle"))
    pieces.append(_upward(18, top + side / 2, "accuracy", "middle"))
    width = left + len(calibrations) * (side + gap) - gap + 24
    return _svg(width, top + side + 54, pieces, "Reliability of confidence")


def _confusion(confusion: Confusion, title: str) -> str:
    """True classes down, predicted ones across, shades by share of the row; right ones blue, wrong ones red."""
    if not confusion.labels or len(confusion.labels) > _MOST_CLASSES:
        return ""
    cell = 44 if len(confusion.labels) <= 12 else 24
    left = round(max(len(label) for label in confusion.columns) * _LETTER) + 24
    top = left + 30
    pieces = [_text(16, 24, f"{title}: true (rows) and predicted (columns)", size=14, weight=600)]
    for j, column in enumerate(confusion.columns):
        x = left + (j + 0.5) * cell + 4
        pieces.append(_upward(x, top - 8, column))
    for i, (label, counts) in enumerate(zip(confusion.labels, confusion.counts, strict=True)):
        y, whole = top + i * cell, sum(counts)
        pieces.append(_text(left - 8, y + cell / 2 + 4, label, "end"))
        for j, n in enumerate(counts):
            share = n / whole if whole else 0.0
            shade = _blend(_BLUE if i == j else _WRONG, share) if n else "#f6f7f9"
            note = f"{label} taken for {confusion.columns[j]}: {n} of {whole}"
            pieces.append(_box(left + j * cell + 1, y + 1, cell - 2, cell - 2, shade, note))
            if n:
                ink = _PAPER if share > 0.55 else _INK
                size = 12 if cell > 30 else 9
                pieces.append(_text(left + (j + 0.5) * cell, y + cell / 2 + size / 3, str(n), "middle", ink, size))
    width = max(left + len(confusion.columns) * cell + 20, 430)
    return _svg(width, top + len(confusion.labels) * cell + 20, pieces, title)


def _bars(classes: Sequence[ClassScore], title: str) -> str:
    """Precision, recall and F1 of each class, the most frequent first."""
    if not classes:
        return ""
    ordered = sorted(classes, key=lambda score: (-score.n_true, score.label))
    left = round(max(len(score.label) for score in ordered) * _LETTER) + 24
    room, row, bar, top = 360, 46, 11, 84
    pieces = [_text(16, 24, title, size=14, weight=600)]
    x = 16.0
    for name, color in _BARS:
        pieces += [_box(x, 38, 12, 12, color), _text(x + 17, 48, name)]
        x += 30 + len(name) * _LETTER
    for step in range(6):
        at = left + room * step / 5
        pieces += [_rule(at, top - 4, at, top + row * len(ordered)), _text(at, top - 8, f"{step / 5:.1f}", "middle")]
    for i, score in enumerate(ordered):
        y = top + i * row
        pieces.append(_text(left - 8, y + row / 2 - 2, score.label, "end"))
        pieces.append(_text(left + room + 12, y + row / 2 + 2, f"{score.n_true} true, {score.n_predicted} predicted"))
        values = (score.precision, score.recall, score.f1)
        for j, ((name, color), value) in enumerate(zip(_BARS, values, strict=True)):
            if value is None:
                continue
            note = f"{score.label}: {name} {value:.3f}"
            # A hairline still shows that there is a value, and that it is 0.
            pieces.append(_box(left, y + 4 + j * bar, max(value * room, 1), bar - 2, color, note))
    return _svg(left + room + 190, top + row * len(ordered) + 16, pieces, title)


def _svg(width: float, height: float, pieces: Iterable[Svg], title: str) -> str:
    drawn = element(
        "svg",
        element("title", title),
        element("rect", width="100%", height="100%", fill=_PAPER),
        joined(Svg(f"{piece}\n") for piece in pieces),
        xmlns="http://www.w3.org/2000/svg",
        viewBox=f"0 0 {width:.0f} {height:.0f}",
        width=round(width),
        height=round(height),
        font_family="system-ui, sans-serif",
        role="img",
    )
    return f"{drawn}\n"


def _text(
    x: float, y: float, text: str, anchor: str = "start", color: str = _INK, size: int = 12, weight: int = 400
) -> Svg:
    return element("text", text, x=x, y=y, text_anchor=anchor, fill=color, font_size=size, font_weight=weight)


def _upward(x: float, y: float, text: str, anchor: str = "start") -> Svg:
    return element("g", _text(x, y, text, anchor), transform=f"rotate(-90 {x:.1f} {y:.1f})")


def _box(x: float, y: float, width: float, height: float, fill: str, note: str = "") -> Svg:
    title = element("title", note) if note else ""
    return element("rect", title, x=x, y=y, width=width, height=height, rx=2, fill=fill)


def _rule(x1: float, y1: float, x2: float, y2: float) -> Svg:
    return element("line", x1=x1, y1=y1, x2=x2, y2=y2, stroke=_LINE)


def _blend(color: tuple[int, int, int], share: float) -> str:
    """From nearly white to the colour."""
    part = 0.15 + 0.85 * share
    return "#" + "".join(f"{round(255 + (c - 255) * part):02x}" for c in color)
