"""The document round a drawing: north, bill of components, title."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator

from cadgraph.draw.isometric.sheet import COS, LINE_HEIGHT, SIN, Isometric, short
from cadgraph.draw.svg import Svg, element, joined
from cadgraph.query.piped_line import Component, PipedLine

__all__ = ["document_of"]

_MARGIN = 40.0
_BILL = 300.0  # width of the bill of components
_STYLE = (
    "text{font:11px sans-serif;fill:#111}.p{stroke:#111;stroke-width:2.6;fill:none;stroke-linecap:round}"
    ".s{stroke:#111;stroke-width:1.4;fill:#fff}.f{stroke:#111;stroke-width:1.8;fill:none}"
    ".k{stroke:#567;stroke-width:.8;fill:none;stroke-dasharray:4 3}"
    ".d{stroke:#567;stroke-width:.8;fill:none}.w{fill:#111}"
    ".t{fill:#345}.b{font-weight:bold}"
)


def document_of(sheet: Isometric, line: PipedLine) -> str:
    """The SVG document of a finished sheet, with bill and title."""
    boxes = [*sheet.solid, *(box for box, _ in sheet.texts)]
    left, top = min(box[0] for box in boxes), min(box[1] for box in boxes)
    right, bottom = max(box[2] for box in boxes), max(box[3] for box in boxes)
    bill = list(_bill(line))
    wide = max(right - left, 320.0) + 3 * _MARGIN + _BILL
    high = max(bottom - top + 2 * _MARGIN + 90, 60 + LINE_HEIGHT * (len(bill) + 12))
    shift = f"translate({_MARGIN - left:.1f} {_MARGIN + 50 - top:.1f})"
    edge = wide - _MARGIN - _BILL
    content = joined(
        (
            element("style", Svg(_STYLE)),
            element("rect", width=wide, height=high, fill="#fff"),
            element("rect", x=10, y=10, width=wide - 20, height=high - 20, class_="d"),
            _north(sheet.turned),
            element("g", *sheet.shapes, transform=shift),
            *_table(bill, edge, 40.0),
            *_title(line, edge, high),
        )
    )
    document = element(
        "svg",
        content,
        xmlns="http://www.w3.org/2000/svg",
        viewBox=f"0 0 {wide:.0f} {high:.0f}",
        width=wide,
        height=high,
    )
    return f"{document}\n"


def _north(turned: bool) -> Svg:
    """An arrow to the north, +y."""
    x, y, side = (64.0, 62.0, -1.0) if turned else (34.0, 62.0, 1.0)
    tip = (x + side * 30 * COS, y - 30 * SIN)
    head = [tip, (tip[0] - side * 10, tip[1] + 1), (tip[0] - side * 5, tip[1] + 8)]
    arrow = element("path", d=f"M{x:.1f} {y:.1f}L{tip[0]:.1f} {tip[1]:.1f}", class_="p")
    filled = "M" + "L".join(f"{a:.1f} {b:.1f}" for a, b in head) + "Z"
    letter = element("text", "N", x=tip[0] + (6 if side > 0 else -14), y=tip[1], class_="b")
    return joined((arrow, element("path", d=filled, class_="w"), letter))


def _bill(line: PipedLine) -> Iterator[tuple[str, str, str]]:
    """What, nominal size and how much of it."""
    counted: Counter[tuple[str, str]] = Counter()
    pipes: dict[str, float] = {}
    for each in line.components:
        sizes = list(dict.fromkeys(str(size) for size in each.sizes if size is not None))
        size = "x".join(sizes) or "?"
        if each.kind in ("pipe", "bend"):
            pipes[size] = pipes.get(size, 0.0) + each.length
        else:
            counted[_named(each), size] += 1
    for outlet in line.outlets:
        size = next((str(size) for size in outlet.sizes if size is not None), "?")
        counted[f"{_named(outlet)} on the pipe", size] += 1
    for _, kind, _ in line.instruments:
        counted[kind or "instrument", ""] += 1
    for size, length in sorted(pipes.items()):
        yield "pipe, bends included", size, f"{length:.2f} m"
    for (what, size), number in sorted(counted.items()):
        yield what, size, str(number)


def _named(component: Component) -> str:
    """What the bill calls a component; one that does another's work by that, and by its label."""
    if component.kind in ("tee", "cross", "tap") and component.what not in (None, component.kind):
        return f"{component.kind} ({component.what})"
    return component.what or component.kind


def _table(rows: Iterable[tuple[str, str, str]], left: float, top: float) -> Iterator[Svg]:
    for number, (what, size, amount) in enumerate([("COMPONENT", "DN", "QUANTITY"), *rows]):
        y, style = top + number * LINE_HEIGHT, "b" if number == 0 else None
        yield element("text", short(what), x=left, y=y, class_=style)
        yield element("text", size, x=left + 190, y=y, class_=style)
        yield element("text", amount, x=left + _BILL, y=y, text_anchor="end", class_=style)


def _title(line: PipedLine, left: float, high: float) -> Iterator[Svg]:
    length = f"{line.line.length:.3f} m" if line.line.length is not None else "unknown"
    rows = [
        (f"LINE {line.line.tag}", "b"),
        (f"from {line.line.start_name} to {line.line.end_name}", None),
        (f"DN {line.line.size or 'unknown'}, length {length}", None),
        ("not to scale, dimensions in mm", None),
    ]
    top = high - 24 - len(rows) * LINE_HEIGHT
    yield element("path", d=f"M{left:.1f} {top - 10:.1f}h{_BILL:.1f}", class_="d")
    for number, (words, style) in enumerate(rows):
        yield element("text", short(words), x=left, y=top + (number + 0.7) * LINE_HEIGHT, class_=style)
