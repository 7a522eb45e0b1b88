"""The schematic as SVG: symbols, lines, tags, a frame and a title block."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

from cadgraph._io.text import file_name, tag_key
from cadgraph.draw.schematic.layout import Placed, Way, lay_out, pack
from cadgraph.draw.schematic.plan import Cell, Edge, Row, plan_systems
from cadgraph.draw.schematic.symbol import TAG_SIZE, Symbol, clean, text_width
from cadgraph.draw.svg import Svg, element, joined, number
from cadgraph.query.network import Network

__all__ = ["STYLE", "draw_sheet"]

_MARGIN = 28.0  # px around the drawing
_GAP = 46.0  # px between systems
_CAPTION = 22.0  # px above a system
_BLOCK = (300.0, 62.0)  # px, the title block
_RULES = (
    "text{font-family:Arial,Helvetica,'Liberation Sans',sans-serif;fill:#111}"
    ".c{text-anchor:middle}.r{text-anchor:end}.l{fill:#33506e}.g{fill:#667}.h{font-weight:bold}"
    ".s{fill:#fff;stroke:#111;stroke-width:1.2;stroke-linejoin:round}"
    ".n{fill:none;stroke:#111;stroke-width:1.2}.t{fill:none;stroke:#111;stroke-width:.8}"
    ".d{fill:none;stroke:#111;stroke-width:.8;stroke-dasharray:3 2}.b{stroke:#111;stroke-width:2}"
    ".k{fill:#111}.w{fill:#fff}.p{fill:none;stroke:#111;stroke-width:1.6;stroke-linecap:round}.i{fill:none;stroke:#111;stroke-width:.8}"
    ".u{stroke-dasharray:6 3}.f{fill:none;stroke:#99a;stroke-width:1}"
)
STYLE = ".schematic " + "}.schematic ".join(_RULES.rstrip("}").split("}")) + "}"
"""Rules that hold for the schematic alone where it stands in a page."""

Box = tuple[float, float, float, float]


@dataclass
class _Paper:
    """What is drawn so far, and what of the paper is taken.

    Args:
        numbered: whether pieces of lines tell their connections, which are numbered as the file happens to have them.
    """

    numbered: bool = False
    pipes: list[Svg] = field(default_factory=list)
    marks: list[Svg] = field(default_factory=list)
    boxes: list[Box] = field(default_factory=list)
    segments: list[Box] = field(default_factory=list)

    def told(self, connections: Sequence[int]) -> str | None:
        """Connections as an attribute; None where there are none, or where they are not told."""
        return (" ".join(map(str, connections)) or None) if self.numbered else None


def draw_sheet(network: Network, system: str | None = None, styled: bool = True) -> str:
    """The sheet of :func:`cadgraph.draw.schematic.draw_diagram`."""
    placed = [lay_out(sketch) for sketch in plan_systems(network, system)]
    sizes = [(p.box[2] - p.box[0], p.box[3] - p.box[1] + _CAPTION) for p in placed]
    corners, wide, high = pack(sizes, _GAP)
    loose = _loose_units(network) if system is None else []
    width = max(wide, _BLOCK[0], 360.0) + 2 * _MARGIN
    notes = list(_wrapped(f"Not connected: {', '.join(loose)}", width - 2 * _MARGIN)) if loose else []
    foot = _BLOCK[1] + 12 + 12 * len(notes)
    height = max(high, 40.0) + foot + 2 * _MARGIN
    body = [
        _system(one, _MARGIN + x - one.box[0], _MARGIN + y + _CAPTION - one.box[1], not styled)
        for one, (x, y) in zip(placed, corners, strict=True)
    ]
    if not placed:
        empty = "No connections along pipes in this graph."
        body.append(element("text", empty, x=_MARGIN, y=_MARGIN + 20, font_size=12))
    for i, note in enumerate(notes):
        y = height - _MARGIN - _BLOCK[1] - 12 * (len(notes) - i)
        body.append(element("text", note, class_="g", x=_MARGIN, y=y, font_size=8))
    body.append(_title_block(network, width, height, len(placed), system))
    drawn = element(
        "svg",
        element("title", f"Schematic of {_sheet_name(network)}"),
        *([element("style", Svg(STYLE))] if styled else []),
        element("rect", class_="w", width="100%", height="100%"),
        element("rect", class_="f", x=8, y=8, width=width - 16, height=height - 16),
        *body,
        xmlns="http://www.w3.org/2000/svg",
        class_="schematic",
        width=width,
        height=height,
        viewBox=f"0 0 {number(width)} {number(height)}",
        role="img",
    )
    return f"{drawn}\n"


def _system(placed: Placed, dx: float, dy: float, numbered: bool) -> Svg:
    paper = _Paper(numbered)
    sketch = placed.sketch
    ways = [_ended(placed, edge, way) for edge, way in zip(sketch.edges, placed.ways, strict=True)]
    for i, (edge, way) in enumerate(zip(sketch.edges, ways, strict=True)):
        beside = [ways[k] for k, other in enumerate(sketch.edges) if other.anchor == edge.anchor and k != i]
        _draw_way(paper, sketch.rows[edge.row], edge, way, _apart(way, beside))
    for (x, y), row in zip(placed.rows, sketch.rows, strict=True):
        _draw_row(paper, row, x, y)
    for i, ((x, y), anchor) in enumerate(zip(placed.anchors, sketch.anchors, strict=True)):
        own = [
            (edge, _ended(placed, edge, way))
            for edge, way in zip(sketch.edges, placed.ways, strict=True)
            if edge.anchor == i
        ]
        if anchor.symbol.form == "junction":
            _draw_junction(paper, anchor.symbol, (x, y), [way for _, way in own])
        else:
            rows = [(sketch.rows[edge.row], edge) for edge, _ in own]
            ends = sorted({_nearest(row, edge) for row, edge in rows if row.line})
            _draw_anchor(paper, anchor.symbol, x, y, own, ends)
    for edge, way in zip(sketch.edges, placed.ways, strict=True):
        if edge.port and sketch.anchors[edge.anchor].symbol.form in ("tank", "pump", "equipment", "exchanger"):
            _name_port(paper, edge.port, way)
    caption = element("text", clean(sketch.title), class_="h", x=placed.box[0], y=placed.box[1] - 10, font_size=10)
    return element("g", caption, *paper.pipes, *paper.marks, transform=f"translate({number(dx)} {number(dy)})")


def _ended(placed: Placed, edge: Edge, way: Way) -> Way:
    """A way that begins at the very middle of a junction."""
    if placed.sketch.anchors[edge.anchor].symbol.form != "junction" or len(way) < 2:
        return way
    x, y = placed.anchors[edge.anchor]
    (ax, ay), (bx, by) = way[:2]
    second = (bx, y) if abs(ay - by) < abs(ax - bx) else (x, by)
    # A straight way ends at its row, whose level it has to keep.
    return ((x, y), second, *way[2:]) if len(way) > 2 or second == (bx, by) else ((x, y), (bx, by))


def _draw_junction(paper: _Paper, symbol: Symbol, centre: tuple[float, float], ways: list[Way]) -> None:
    """A dot wherever three ways part, which may be a little beside the middle; the name at the first."""
    parts: dict[tuple[float, float], set[tuple[int, int]]] = {}
    corners = list(dict.fromkeys((round(x, 1), round(y, 1)) for way in ways for x, y in way[:-1]))
    for corner in corners:
        parts[corner] = {d for way in ways for a, b in pairwise(way) for d in _directions(corner, a, b)}
    dots = [corner for corner in corners if len(parts[corner]) > 2] or [centre]
    for x, y in dots:
        paper.marks.append(symbol.draw(x, y))
        paper.boxes.append((x - 2.6, y - 2.6, x + 2.6, y + 2.6))
    _name_point(paper, symbol, *dots[0])


def _directions(
    point: tuple[float, float], a: tuple[float, float], b: tuple[float, float]
) -> Iterator[tuple[int, int]]:
    """The ways in which a piece of line leaves a point that lies on it."""
    x, y = point
    if abs(a[1] - b[1]) < 0.2 and abs(y - a[1]) < 0.2 and min(a[0], b[0]) - 0.2 < x < max(a[0], b[0]) + 0.2:
        if max(a[0], b[0]) > x + 0.2:
            yield 1, 0
        if min(a[0], b[0]) < x - 0.2:
            yield -1, 0
    if abs(a[0] - b[0]) < 0.2 and abs(x - a[0]) < 0.2 and min(a[1], b[1]) - 0.2 < y < max(a[1], b[1]) + 0.2:
        if max(a[1], b[1]) > y + 0.2:
            yield 0, 1
        if min(a[1], b[1]) < y - 0.2:
            yield 0, -1


def _apart(way: Way, others: Sequence[Way]) -> Way:
    """A way without the pieces at its beginning that it shares with others of its anchor."""
    while len(way) > 2 and any(any(_directions(way[1], a, b)) for other in others for a, b in pairwise(other)):
        way = way[1:]
    return way


def _draw_way(paper: _Paper, row: Row, edge: Edge, way: Way, own: Way) -> None:
    style = ("p" if row.line else "i") + ("" if edge.solid else " u")
    d = "M" + "L".join(f"{number(x)} {number(y)}" for x, y in way)
    along = paper.told([_nearest(row, edge)] if row.line else [])
    paper.pipes.append(element("path", class_=style, d=d, data_line=_tag(row), data_connection=along))
    for (ax, ay), (bx, by) in zip(way, way[1:], strict=False):
        paper.segments.append((min(ax, bx), min(ay, by), max(ax, bx), max(ay, by)))
    if edge.flow == "in":
        _draw_arrow(paper, own[::-1], 4.0, _tag(row), along)


def _tag(row: Row) -> str | None:
    """The tag of a row's line; None of a tap."""
    return row.line.tag if row.line else None


def _nearest(row: Row, edge: Edge) -> int:
    """The connection of a row that leads to an anchor: ways go from anchors at the left into rows."""
    return row.connections[0 if edge.into else -1]


def _draw_arrow(paper: _Paper, way: Way, short: float, line: str | None, along: str | None) -> None:
    """A filled arrow at the end of a way, a little short of it."""
    for (ax, ay), (bx, by) in zip(way[-2::-1], way[:0:-1], strict=False):
        length = math.hypot(bx - ax, by - ay)
        if length >= 9:
            ux, uy = (bx - ax) / length, (by - ay) / length
            x, y = bx - short * ux, by - short * uy
            left = (x - 8 * ux - 3 * uy, y - 8 * uy + 3 * ux)
            right = (x - 8 * ux + 3 * uy, y - 8 * uy - 3 * ux)
            corners = " ".join(f"{number(a)},{number(b)}" for a, b in ((x, y), left, right))
            paper.marks.append(element("polygon", class_="k", points=corners, data_line=line, data_connection=along))
            return


def _draw_row(paper: _Paper, row: Row, x: float, y: float) -> None:
    left = x - row.width / 2
    style = "p" if row.line else "i"
    end = left + row.width
    used = sum(cell.width for cell in row.cells)
    if row.line is None and row.cells:
        last = row.cells[-1]
        end = left + used - last.width / 2
    at = left + (row.width - used) / 2 if row.line else left
    for a, b, along in _stretches(row, left, end, at):
        d = f"M{number(a)} {number(y)}H{number(b)}"
        paper.pipes.append(element("path", class_=style, d=d, data_line=_tag(row), data_connection=paper.told(along)))
    paper.segments.append((left, y, left + row.width, y))
    for cell in row.cells:
        _draw_cell(paper, cell, at + cell.width / 2, y, style)
        at += cell.width
    if row.label:
        low = max((cell.symbol.bottom for cell in row.cells if cell.symbol), default=0.0)
        _text(paper, row.label, x, y + max(low, 2.0) + 8.5, 7.0, "c l", data_line=_tag(row))


def _stretches(row: Row, left: float, end: float, at: float) -> Iterator[tuple[float, float, tuple[int, ...]]]:
    """A row from left to right, cut where one connection goes over into the next: a page marks some of them alone.

    Where nothing is drawn between two connections both have one stretch.
    """
    begun = 0
    for cell in row.cells:
        middle = at + cell.width / 2
        if cell.begins:
            yield left, middle, row.connections[begun : cell.begins]
            left, begun = middle, cell.begins
        at += cell.width
    yield left, end, row.connections[begun:]


def _draw_cell(paper: _Paper, cell: Cell, x: float, y: float, style: str) -> None:
    if cell.sizes is not None:
        _draw_reducer(paper, x, y, cell.sizes)
        return
    if cell.symbol is not None:
        paper.marks.append(cell.symbol.draw(x, y))
        paper.boxes.append((x - cell.symbol.left, y - cell.symbol.top, x + cell.symbol.right, y + cell.symbol.bottom))
        if cell.symbol.label_width:
            _text(
                paper,
                cell.symbol.label,
                x,
                y - cell.symbol.top - (7 if cell.symbol.form == "check" else 3),
                TAG_SIZE,
                "c",
                data_id=cell.place,
            )
    foot = y
    for symbol in cell.hanging:
        middle = foot - 20.0 - symbol.bottom
        paper.pipes.append(element("path", class_="i", d=f"M{number(x)} {number(foot)}V{number(middle)}"))
        paper.marks.append(symbol.draw(x, middle))
        paper.boxes.append((x - symbol.left, middle - symbol.top, x + symbol.right, middle + symbol.bottom))
        if symbol.label_width:
            _text(paper, symbol.label, x + symbol.right + 2, middle + 3, 6.5, "", data_id=symbol.place)
        foot = middle - symbol.top
    if cell.symbol is None:
        paper.marks.append(element("circle", class_="k", cx=x, cy=y, r=1.8, data_id=cell.place or None))


def _draw_reducer(paper: _Paper, x: float, y: float, sizes: tuple[int, int]) -> None:
    """A reducer after ISO 10628-2, with the sizes before and after it."""
    big, small = (6, 3) if sizes[0] > sizes[1] else (3, 6)
    left, right = number(x - 5), number(x + 5)
    d = f"M{left} {number(y - big)}L{right} {number(y - small)}V{number(y + small)}L{left} {number(y + big)}Z"
    title = f"DN {sizes[0]} to DN {sizes[1]}"
    paper.marks.append(element("g", element("title", title), element("path", class_="s", d=d)))
    paper.boxes.append((x - 5, y - 6, x + 5, y + 6))


def _draw_anchor(
    paper: _Paper, symbol: Symbol, x: float, y: float, own: list[tuple[Edge, Way]], ends: Sequence[int]
) -> None:
    ways = [way for _, way in own]
    if symbol.form == "open" and ways:
        from_left = ways[0][0][0] < x
        symbol = replace(symbol, flow=1 if from_left == (own[0][0].flow != "out") else -1)
    if symbol.form in ("open", "end", "blind") and ways:
        # The box of an end is as wide as its name; the line goes on to the symbol in its middle.
        ax, ay = ways[0][0]
        reach = x - math.copysign(symbol.left, x - ax) if abs(ax - x) > abs(ay - y) else x
        d = f"M{number(ax)} {number(ay)}L{number(reach)} {number(y)}"
        paper.pipes.append(element("path", class_="p", d=d, data_connection=paper.told(ends)))
        _text(paper, symbol.label, x, y + symbol.bottom + 8, 6.5, "c g", data_id=symbol.place)
    paper.marks.append(symbol.draw(x, y))
    paper.boxes.append((x - symbol.left, y - symbol.top, x + symbol.right, y + symbol.bottom))
    if symbol.label_width and symbol.form not in ("junction", "blind"):
        style = "c h" if symbol.form == "pump" else "c"
        _text(paper, symbol.label, x, y - symbol.top - 4, TAG_SIZE, style, data_id=symbol.place)


def _name_port(paper: _Paper, port: str, way: Way) -> None:
    (ax, ay), (bx, by) = way[0], way[1] if len(way) > 1 else way[0]
    sx, sy = (bx > ax) - (bx < ax), (by > ay) - (by < ay)
    width = text_width(port, 6.0)
    if sx:
        spots = [(ax + sx * 2 - (width if sx < 0 else 0), ay - 2.5), (ax + sx * 2 - (width if sx < 0 else 0), ay + 7)]
    else:
        spots = [(ax + 2.5, ay + (8 if sy > 0 else -3)), (ax - 2.5 - width, ay + (8 if sy > 0 else -3))]
    _free_text(paper, clean(port), spots, 6.0, "g")


def _name_point(paper: _Paper, symbol: Symbol, x: float, y: float) -> None:
    short = symbol.label.replace("junction-", "J-")
    width = text_width(short, 6.0)
    spots = [(x + 4, y + 9), (x - 4 - width, y + 9), (x + 4, y - 4), (x - 4 - width, y - 4)]
    _free_text(paper, short, spots, 6.0, "g", symbol.place)


def _free_text(
    paper: _Paper, text: str, spots: list[tuple[float, float]], size: float, style: str, place: str | None = None
) -> None:
    """A small text at the first spot that is free; none where all are taken, as the symbol's title has it too."""
    width = text_width(text, size)
    for x, y in spots:
        box = (x - 0.5, y - size, x + width + 0.5, y + 1)
        if not any(_overlap(box, other) for other in (*paper.boxes, *paper.segments)):
            _text(paper, text, x, y, size, style, data_id=place)
            return


def _overlap(a: Box, b: Box) -> bool:
    return a[0] <= b[2] and b[0] <= a[2] and a[1] <= b[3] and b[1] <= a[3]


def _text(paper: _Paper, text: str, x: float, y: float, size: float, style: str, **data: str | None) -> None:
    width = text_width(text, size)
    left = x - width / 2 if "c" in style.split() else x
    paper.boxes.append((left, y - size, left + width, y + 1))
    paper.marks.append(element("text", text, class_=style or None, x=x, y=y, font_size=size, **data))


def _title_block(network: Network, width: float, height: float, count: int, system: str | None) -> Svg:
    from cadgraph import __version__

    w, h = _BLOCK
    x, y = width - _MARGIN - w, height - _MARGIN - h
    rows = (
        ("h", 10.0, _sheet_name(network)),
        ("", 8.0, f"Schematic of {system or f'{count} system' + 's' * (count != 1)}, not to scale"),
        ("g", 7.0, "Derived from geometry, to be checked on site. Arrow: known flow. Dashed: unsure."),
        ("g", 7.0, f"cadgraph {__version__} · symbols after ISO 10628-2 and ISA 5.1"),
    )
    drawn = [element("rect", class_="f", x=x, y=y, width=w, height=h)]
    for i, (style, size, text) in enumerate(rows):
        drawn.append(element("text", text, class_=style, x=x + 8, y=y + 15 + 13 * i, font_size=size))
    return joined(drawn)


def _sheet_name(network: Network) -> str:
    return clean(file_name(network.graph.source.path)) or "untitled"


def _loose_units(network: Network) -> list[str]:
    tags = (clean(network.name(place)) for place in network.places if not network.arcs(place))
    return sorted(tags, key=tag_key)


def _wrapped(text: str, width: float) -> Iterator[str]:
    line = ""
    for word in text.split():
        if line and text_width(f"{line} {word}", 8.0) > width:
            yield line
            line = word
        else:
            line = f"{line} {word}".strip()
    yield line
