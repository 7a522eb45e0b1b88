"""Draws which room of the code imports which as ``docs/architecture.svg``, or with --check says if that is out of date.

python tools/draw_architecture.py [--check] [--tree DIR] [--output FILE] [--lines]

A room is a folder or module on the top level of a package; it stands on a floor above all rooms that it imports. A box
is as large as its room has lines of Python (tests and data are left out), rounded to two digits. Arrows lead from a
room to what it imports, in that one's colour: strong where no other way leads there, faint where one does, red where
they point upward, so that rooms import each other in a circle.
"""

from __future__ import annotations

import argparse
import ast
import sys
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from statistics import fmean

from cadgraph._io.atomic import write_atomically

ROOT = Path(__file__).resolve().parents[1]
PICTURE = ROOT / "docs" / "architecture.svg"

PRODUCT = "cadgraph"
SPLIT = ("draw", "simulate")  # folders whose folders are rooms of their own

_INK, _FAINT, _PAPER, _RED = "#1f2933", "#5d6873", "#ffffff", "#d11f2f"
_COLORS = ("#1f6fd1", "#0f8a74", "#8a45e6", "#b8790b", "#0b7c9e", "#7a5c3e", "#5b7a1f", "#b0408f", "#3d4f8f", "#c05a1a")
_FILLS = {"cadgraph": "#f0f5fb", "cadplants": "#ecf7ec", "cadlab": "#fdf3df"}

_AREA, _ASPECT = 4.2, 1.9  # of a box: for each line of code [px2], and width over height
_LETTER, _SMALL, _ROW, _PAD = 8.8, 6.4, 15, 9  # widths of letters, height of a row of text, room around it [px]
_GAP, _FLOOR, _TRUNK, _MARGIN = 26, 70, 13, 30  # between boxes, floors and bundles of arrows, and at the border [px]
_HEAD = 118  # height of title and legend [px]
_SWEEPS = 40  # of the ordering that keeps arrows from crossing


@dataclass(frozen=True)
class Room:
    """A room of the code.

    Args:
        name: package, then folder or module, joined by slashes.
        lines: lines of Python.
        inner: folders in it, with their lines.
    """

    name: str
    lines: int
    inner: tuple[tuple[str, int], ...] = ()

    @property
    def package(self) -> str:
        """The package that it is in."""
        return self.name.split("/")[0]

    @property
    def title(self) -> str:
        """What the picture calls it."""
        return self.name.removeprefix(f"{PRODUCT}/")

    @property
    def rows(self) -> tuple[str, ...]:
        """What the picture says below the title."""
        return f"{_short(self.lines)} lines", *(f"{name} {_short(n)}" for name, n in self.inner)

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of its box [px]."""
        area = _AREA * _rounded(self.lines)
        least = max(_LETTER * len(self.title), *(_SMALL * len(row) for row in self.rows)) + 2 * _PAD
        height = max((area / _ASPECT) ** 0.5, _ROW * (1 + len(self.rows)) + 2 * _PAD)
        return max(least, area / height), height


@dataclass(frozen=True)
class House:
    """All rooms of a tree.

    Args:
        rooms: by name.
        imports: how many modules of one room import from another.
    """

    rooms: Mapping[str, Room]
    imports: Mapping[tuple[str, str], int]


# Reading a tree


def read_house(tree: Path) -> House:
    """Reads which room of a checkout imports which, wherever in a file that stands.

    Args:
        tree: folder with ``src`` and perhaps ``packages``.
    """
    modules = {
        (folder.name, *path.relative_to(folder).with_suffix("").parts): path.read_text(encoding="utf-8")
        for source in (tree / "src", *sorted(tree.glob("packages/*/src")))
        for folder in sorted(source.iterdir())
        if (folder / "__init__.py").is_file()
        for path in sorted(folder.rglob("*.py"))
    }
    lines: Counter[str] = Counter()
    inner: dict[str, Counter[str]] = {}
    imports: Counter[tuple[str, str]] = Counter()
    for steps, text in modules.items():
        here = _room_of(steps)
        lines[here] += text.count("\n")
        within = steps[len(here.split("/")) :]
        if len(within) > 1:
            inner.setdefault(here, Counter())[within[0]] += text.count("\n")
        imports.update({(here, _room_of(target)) for target in _imported(steps, text, modules)} - {(here, here)})
    alone = set(lines) - {room for pair in imports for room in pair}
    rooms = {
        name: Room(name, n, tuple(sorted(inner.get(name, {}).items(), key=lambda item: (-item[1], item[0]))))
        for name, n in sorted(lines.items())
        if name not in alone
    }
    return House(rooms, dict(sorted(imports.items())))


def _room_of(steps: Sequence[str]) -> str:
    deep = len(steps) > 3 and steps[1] in SPLIT
    return "/".join(steps[: 3 if deep else 2])


def _imported(steps: tuple[str, ...], text: str, modules: Mapping[tuple[str, ...], str]) -> Iterator[tuple[str, ...]]:
    """The modules of the tree that one module imports, but for a package's version."""
    packages = {place[0] for place in modules}
    for node in ast.walk(ast.parse(text)):
        for name in _names(node, steps):
            # A package that imports itself as a whole wants to know where it lies.
            if name[0] in packages and name != steps[:1]:
                yield _module(name, modules)


def _names(node: ast.AST, steps: tuple[str, ...]) -> list[tuple[str, ...]]:
    """The dotted names that a statement imports."""
    if isinstance(node, ast.Import):
        return [tuple(alias.name.split(".")) for alias in node.names]
    if not isinstance(node, ast.ImportFrom):
        return []
    above = steps[: len(steps) - node.level] if node.level else ()
    base = (*above, *node.module.split(".")) if node.module else above
    return [(*base, alias.name) for alias in node.names if alias.name != "__version__"]


def _module(name: tuple[str, ...], modules: Mapping[tuple[str, ...], str]) -> tuple[str, ...]:
    """The module that a dotted name is, or is of."""
    while name not in modules and (*name, "__init__") not in modules:
        name = name[:-1]
    return name if name in modules else (*name, "__init__")


# Who stands where


def _upward(house: House) -> set[tuple[str, str]]:
    """The imports to leave out so that none goes in a circle: as few as a greedy search finds (Eades et al. 1993)."""
    left = dict.fromkeys(house.rooms)
    top: list[str] = []
    bottom: list[str] = []

    def weight(room: str, end: int) -> int:
        return sum(n for pair, n in house.imports.items() if pair[end] == room and pair[1 - end] in left)

    while left:
        for end, order in ((0, bottom), (1, top)):
            while free := [room for room in left if weight(room, end) == 0]:
                order.append(free[0])
                del left[free[0]]
        if left:
            chosen = max(left, key=lambda room: (weight(room, 0) - weight(room, 1), room))
            top.append(chosen)
            del left[chosen]
    place = {room: k for k, room in enumerate([*top, *reversed(bottom)])}
    return {(a, b) for a, b in house.imports if place[a] > place[b]}


def _floors(house: House, upward: set[tuple[str, str]]) -> dict[str, int]:
    """The floor of each room: one above the highest that it imports."""
    below: dict[str, list[str]] = {room: [] for room in house.rooms}
    for a, b in house.imports:
        if (a, b) not in upward:
            below[a].append(b)
    floors: dict[str, int] = {}

    def floor(room: str) -> int:
        if room not in floors:
            floors[room] = max((1 + floor(other) for other in below[room]), default=0)
        return floors[room]

    for room in house.rooms:
        floor(room)
    return floors


def _implied(house: House, upward: set[tuple[str, str]]) -> set[tuple[str, str]]:
    """The imports from which another way of downward ones leads to the same room."""
    below: dict[str, set[str]] = {room: set() for room in house.rooms}
    for a, b in house.imports:
        if (a, b) not in upward:
            below[a].add(b)

    def reached(room: str) -> set[str]:
        return set(below[room]).union(*(reached_from[other] for other in below[room]))

    floors = _floors(house, upward)
    reached_from: dict[str, set[str]] = {}
    for room in sorted(house.rooms, key=lambda room: floors[room]):
        reached_from[room] = reached(room)
    return {(a, b) for a, b in house.imports if any(b in reached_from[c] for c in below[a])}


_Node = tuple[str, int]
"""A room on its floor, or the bundle of arrows to it that passes a higher one."""


@dataclass
class _Plan:
    """Where everything is, while it is laid out.

    Args:
        house: what is drawn.
        upward: imports that point upward.
        floors: floor of each room.
        order: nodes of each floor from the left.
        x: middle of each node [px].
    """

    house: House
    upward: set[tuple[str, str]]
    floors: dict[str, int]
    order: list[list[_Node]]
    x: dict[_Node, float]

    def width(self, node: _Node) -> float:
        """The width of a node [px]."""
        room, floor = node
        return self.house.rooms[room].size[0] + _GAP if self.floors[room] == floor else _TRUNK

    def way(self, a: str, b: str) -> list[_Node]:
        """The nodes from a room down to one that it imports."""
        return [(a, self.floors[a]), *((b, floor) for floor in range(self.floors[a] - 1, self.floors[b] - 1, -1))]


def _plan(house: House) -> _Plan:
    upward = _upward(house)
    floors = _floors(house, upward)
    plan = _Plan(house, upward, floors, [[] for _ in range(max(floors.values()) + 1)], {})
    near: dict[_Node, dict[_Node, None]] = {(room, floor): {} for room, floor in floors.items()}
    for a, b in sorted(house.imports.keys() - upward):
        way = plan.way(a, b)
        for high, low in zip(way, way[1:], strict=False):
            near.setdefault(high, {})[low] = near.setdefault(low, {})[high] = None
    for node in near:
        plan.order[node[1]].append(node)
    for row in plan.order:
        _place(plan, row, lambda node: 0.0)
    for sweep in range(_SWEEPS):
        for row in plan.order if sweep % 2 else reversed(plan.order):
            wanted = {node: fmean(plan.x[other] for other in near[node] or [node]) for node in row}
            if sweep < _SWEEPS - 6:
                row.sort(key=lambda node: (wanted[node], node))
            _place(plan, row, wanted.__getitem__)
    return plan


def _place(plan: _Plan, row: Sequence[_Node], wanted: Callable[[_Node], float]) -> None:
    """Puts the nodes of a floor as near as possible to where they are wanted, in order and side by side."""
    offsets, blocks = [0.0], list[list[float]]()  # of each block: mean, number of nodes
    for left, right in zip(row, row[1:], strict=False):
        offsets.append(offsets[-1] + (plan.width(left) + plan.width(right)) / 2)
    for node, offset in zip(row, offsets, strict=True):
        blocks.append([wanted(node) - offset, 1])
        while len(blocks) > 1 and blocks[-2][0] >= blocks[-1][0]:
            mean, n = blocks.pop()
            blocks[-1] = [(blocks[-1][0] * blocks[-1][1] + mean * n) / (blocks[-1][1] + n), blocks[-1][1] + n]
    shifts = [mean for mean, n in blocks for _ in range(int(n))]
    for node, offset, shift in zip(row, offsets, shifts, strict=True):
        plan.x[node] = round(offset + shift, 1)


# Drawing


def draw(house: House, title: str) -> str:
    """The picture as SVG; the same house gives the same bytes."""
    plan = _plan(house)
    left = min(plan.x[node] - plan.width(node) / 2 for row in plan.order for node in row) - _MARGIN
    right = max(plan.x[node] + plan.width(node) / 2 for row in plan.order for node in row) + _MARGIN
    right = max(right, left + 900)
    bands = _bands(plan)
    height = bands[0][1] + _MARGIN
    targets = sorted({b for _, b in house.imports}, key=lambda room: (plan.floors[room], room))
    color = {room: _COLORS[k % len(_COLORS)] for k, room in enumerate(targets)}
    boxes = [_box(plan, room, bands, color) for room in house.rooms]
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{left:.0f} 0 {right - left:.0f} {height:.0f}" '
            f'width="{right - left:.0f}" height="{height:.0f}" font-family="Helvetica, Arial, sans-serif">',
            f'<rect x="{left:.0f}" y="0" width="{right - left:.0f}" height="{height:.0f}" fill="{_PAPER}"/>',
            *_legend(house, title, left + _MARGIN, plan),
            *_arrows(plan, bands, color),
            *boxes,
            "</svg>",
            "",
        ]
    )


def _bands(plan: _Plan) -> list[tuple[float, float]]:
    """Upper and lower edge of each floor [px]."""
    bands, y = list[tuple[float, float]](), float(_HEAD)
    for floor in range(len(plan.order) - 1, -1, -1):
        tall = max(room.size[1] for name, room in plan.house.rooms.items() if plan.floors[name] == floor)
        bands.append((y, y + tall))
        y += tall + _FLOOR
    return bands[::-1]


def _legend(house: House, title: str, x: float, plan: _Plan) -> Iterator[str]:
    lines: Counter[str] = Counter()
    for room in house.rooms.values():
        lines[room.package] += room.lines
    circles = f"{len(plan.upward)} of them point upward (red)" if plan.upward else "none points upward"
    n_rooms, n_arrows = len(house.rooms), len(house.imports)
    words = (
        "A room stands above what it imports; its box is as large as its lines of code. "
        f"{n_rooms} rooms, {n_arrows} arrows; {circles}.",
        "An arrow has the colour of the room that it leads to; it is faint where another way leads there too, thick "
        "for many imports.",
    )
    yield _text(x, 38, title, 22, _INK, weight="bold", anchor="start")
    yield from (_text(x, 60 + 19 * k, line, 13, _FAINT, anchor="start") for k, line in enumerate(words))
    for package, n in sorted(lines.items()):
        said = f"{package}: {_short(n)} lines"
        fill = _FILLS.get(package, _PAPER)
        yield f'<rect x="{x:.1f}" y="91" width="14" height="14" fill="{fill}" stroke="{_FAINT}"/>'
        yield _text(x + 20, 103, said, 13, _INK, anchor="start")
        x += 40 + 7 * len(said)


def _box(plan: _Plan, name: str, bands: Sequence[tuple[float, float]], color: Mapping[str, str]) -> str:
    room, (top, bottom) = plan.house.rooms[name], bands[plan.floors[name]]
    (width, height), x, y = room.size, plan.x[name, plan.floors[name]], (top + bottom) / 2
    first = y - _ROW * len(room.rows) / 2 + 4
    texts = [_text(x, first, room.title, 14, _INK, weight="bold")]
    texts += [_text(x, first + _ROW * (k + 1), row, 11.5, _FAINT) for k, row in enumerate(room.rows)]
    edge = color.get(name, _FAINT)
    return (
        f'<rect x="{x - width / 2:.1f}" y="{y - height / 2:.1f}" width="{width:.1f}" height="{height:.1f}" rx="5" '
        f'fill="{_FILLS.get(room.package, _PAPER)}" stroke="{edge}" stroke-width="1.8"/>' + "".join(texts)
    )


def _text(
    x: float, y: float, words: str, size: float, color: str, weight: str = "normal", anchor: str = "middle"
) -> str:
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size:g}" fill="{color}" font-weight="{weight}" '
        f'text-anchor="{anchor}">{escape(words)}</text>'
    )


def _arrows(plan: _Plan, bands: Sequence[tuple[float, float]], color: Mapping[str, str]) -> Iterator[str]:
    """The arrows, the faint ones first."""
    implied = _implied(plan.house, plan.upward)
    ports = _ports(plan)
    pairs = sorted(plan.house.imports.items(), key=lambda item: (item[0] in plan.upward, item[0] not in implied, item))
    for (a, b), n in pairs:
        # In three steps, so that the picture stays as it is when one more module imports something.
        width, many = (1.1, "a few") if n < 4 else (1.9, "several") if n < 12 else (3.0, "many")
        if (a, b) in plan.upward:
            path, stroke, opacity = _rise(plan, bands, a, b), _RED, 0.95
        else:
            path, stroke, opacity = _fall(plan, bands, ports, a, b), color[b], 0.25 if (a, b) in implied else 0.95
        yield (
            f'<g stroke="{stroke}" fill="none" opacity="{opacity}" stroke-width="{width}">'
            f"<title>{escape(a)} imports {escape(b)}: {many} modules</title>{path}</g>"
        )


_Ports = Mapping[tuple[str, str, bool], float]
"""Where an arrow leaves its room (False) or arrives (True) [px], by both rooms."""


def _ports(plan: _Plan) -> _Ports:
    leaving: dict[str, list[tuple[float, str]]] = {}
    arriving: dict[str, list[tuple[float, str]]] = {}
    for a, b in plan.house.imports:
        if (a, b) not in plan.upward:
            way = plan.way(a, b)
            leaving.setdefault(a, []).append((plan.x[way[1]], b))
            arriving.setdefault(b, []).append((plan.x[way[-2]], a))
    ports: dict[tuple[str, str, bool], float] = {}
    for arrives, sides in ((False, leaving), (True, arriving)):
        for room, others in sides.items():
            middle, width = plan.x[room, plan.floors[room]], plan.house.rooms[room].size[0] - 2 * _PAD
            # What comes down one bundle arrives in one place.
            places = sorted({x for x, _ in others}) if arrives else [x for x, _ in sorted(others)]
            for k, (x, other) in enumerate(sorted(others)):
                at = places.index(x) if arrives else k
                pair = (other, room, True) if arrives else (room, other, False)
                step = min(width / max(len(places), 1), 26)
                ports[pair] = round(middle + step * (at - (len(places) - 1) / 2), 1)
    return ports


def _fall(plan: _Plan, bands: Sequence[tuple[float, float]], ports: _Ports, a: str, b: str) -> str:
    """The path of an arrow down to a room, with its head."""
    way = plan.way(a, b)
    x, tall = ports[a, b, False], plan.house.rooms[a].size[1]
    top, y = bands[way[0][1]]
    path = [f"M{x:.1f} {(top + y) / 2 + tall / 2:.1f}V{y:.1f}"]
    for node in way[1:]:
        last = node == way[-1]
        goal, (top, bottom) = ports[a, b, True] if last else plan.x[node], bands[node[1]]
        path.append(f"C{x:.1f} {y + 0.5 * _FLOOR:.1f} {goal:.1f} {top - 0.5 * _FLOOR:.1f} {goal:.1f} {top:.1f}")
        x, y = goal, bottom
        path.append("" if last else f"V{bottom:.1f}")
    top, bottom = bands[plan.floors[b]]
    tip = (top + bottom) / 2 - plan.house.rooms[b].size[1] / 2
    return f'<path d="{"".join(path)}V{tip:.1f}"/>{_tip(x, tip, 1)}'


def _rise(plan: _Plan, bands: Sequence[tuple[float, float]], a: str, b: str) -> str:
    """The path of an arrow up to a room, with its head."""
    x, goal = plan.x[a, plan.floors[a]], plan.x[b, plan.floors[b]]
    start = sum(bands[plan.floors[a]]) / 2 - plan.house.rooms[a].size[1] / 2
    end = sum(bands[plan.floors[b]]) / 2 + plan.house.rooms[b].size[1] / 2
    bend = (start - end) / 2
    return (
        f'<path d="M{x:.1f} {start:.1f}C{x:.1f} {start - bend:.1f} {goal:.1f} {end + bend:.1f} {goal:.1f} {end:.1f}"/>'
        f"{_tip(goal, end, -1)}"
    )


def _tip(x: float, y: float, sense: int) -> str:
    return (
        f'<path d="M{x - 3.5:.1f} {y - 6 * sense:.1f}L{x:.1f} {y:.1f}L{x + 3.5:.1f} {y - 6 * sense:.1f}" fill="none"/>'
    )


def _rounded(n: int) -> int:
    """Two digits, so that the picture stays as it is when a few lines change."""
    step: int = 10 ** max(1, len(str(n)) - 2)
    return max(10, step * round(n / step))


def _short(n: int) -> str:
    value = _rounded(n)
    return f"{value / 1000:g}k" if value >= 1000 else str(value)


def table(house: House) -> str:
    """The lines of each package and of its rooms, as text."""
    rows = []
    for package in sorted({room.package for room in house.rooms.values()}):
        rooms = [room for room in house.rooms.values() if room.package == package]
        rows.append(f"{package:24}{sum(room.lines for room in rooms):7,}")
        rows += [f"  {room.title:22}{room.lines:7,}" for room in sorted(rooms, key=lambda r: -r.lines)]
    return "\n".join(rows) + "\n"


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command; the exit code is 1 where ``--check`` finds the picture out of date."""
    parser = argparse.ArgumentParser(description="Draws which room of the code imports which.")
    parser.add_argument("--check", action="store_true", help="write nothing, fail where the picture is out of date")
    parser.add_argument("--tree", type=Path, default=ROOT, help="checkout to read, this one by default")
    parser.add_argument("--output", "-o", type=Path, default=PICTURE, help="SVG file to write")
    parser.add_argument("--title", default="What imports what", help="title of the picture")
    parser.add_argument("--lines", action="store_true", help="write nothing, list the lines of each room")
    options = parser.parse_args(arguments)
    house = read_house(options.tree)
    if options.lines:
        sys.stdout.write(table(house))
        return 0
    picture = draw(house, options.title)
    if options.check:
        stale = not options.output.is_file() or options.output.read_text(encoding="utf-8") != picture
        sys.stdout.write(f"{options.output.name} is out of date: run make docs\n" if stale else "")
        return 1 if stale else 0
    write_atomically(options.output, picture.encode())
    return 0


if __name__ == "__main__":
    sys.exit(main())
