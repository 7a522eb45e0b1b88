"""What the author of a plant knows of it: devices along each line in order, what joins what, which way it flows."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.model.plant import Plant, Unit

__all__ = ["Inventory", "Item", "Joint", "take"]

_APART = ("Connection assembly", "Structural element")  # groups whose members hold a line but let nothing through
_NEAR = 0.02  # m; farther than this from an item's box a junction is not in it


@dataclass(frozen=True, eq=False)
class Item:
    """A functional unit, or a component that belongs to none.

    Args:
        number: from 0, in the order of the plant's components.
        members: indices of its components.
        unit: that it is, if any.
        line: tag of the run that it belongs to, or "".
        group: of its first component, or that which makes its unit.
        name: label of its first component; of a unit in one mesh that of the whole.
        span: chainages between which the line's axis runs through it [m]; None where it does not.
        at: chainage that it is ordered by [m].
    """

    number: int
    members: tuple[int, ...]
    unit: Unit | None
    line: str
    group: str
    name: str
    span: tuple[float, float] | None = None
    at: float = 0.0


@dataclass(frozen=True)
class Joint:
    """Two items that are joined along a pipe.

    Args:
        first: number of an item.
        second: likewise.
        point: where they meet [m].
        flow: ``forward`` from the first to the second, ``backward`` or ``unknown``.
        line: tag of the run that it is found on.
    """

    first: int
    second: int
    point: tuple[float, float, float]
    flow: str
    line: str


@dataclass(frozen=True)
class Inventory:
    """All items of a plant.

    Args:
        items: by number.
        lines: items of each run by its tag, in order along it.
        joints: in order along the runs.
        ends: ids of the items that a run begins and ends at, or None, by its tag.
        bores: nominal bore of each run [m].
        mouths: numbers of items whose far side joins nothing, with the place of that end [m].
    """

    items: tuple[Item, ...]
    lines: dict[str, tuple[Item, ...]] = field(default_factory=dict)
    joints: tuple[Joint, ...] = ()
    ends: dict[str, tuple[int | None, int | None]] = field(default_factory=dict)
    bores: dict[str, float] = field(default_factory=dict)
    mouths: tuple[tuple[int, tuple[float, float, float]], ...] = ()


def take(plant: Plant) -> Inventory:
    """Takes stock of a plant."""
    boxes = [(c.vertices.min(axis=0), c.vertices.max(axis=0)) for c in plant.components]
    courses = {line.id: line.points for line in plant.lines}
    items = [_on_line(item, boxes, courses) for item in _items(plant)]
    by_line: dict[str, list[Item]] = defaultdict(list)
    for item in items:
        if item.line:
            by_line[item.line].append(item)
    lines = {tag: tuple(sorted(some, key=lambda item: (item.at, item.number))) for tag, some in by_line.items()}
    bores: dict[str, float] = {}
    for connection in plant.connections:
        bores.setdefault(connection.line, connection.diameter)
    ends = {tag: _ends(plant, tag, items, boxes) for tag in lines}
    joints = [
        joint for tag in lines if tag in courses for joint in _joints(plant, tag, lines[tag], courses[tag], ends[tag])
    ]
    mouths = [mouth for tag in lines if tag in courses for mouth in _mouths(lines[tag], courses[tag], ends[tag])]
    return Inventory(tuple(items), lines, tuple(joints), ends, bores, tuple(mouths))


def _mouths(
    items: Sequence[Item], points: Floats, ends: tuple[int | None, int | None]
) -> list[tuple[int, tuple[float, float, float]]]:
    """The open ends of a run: its first and last item, where nothing is beyond."""
    chain = [item for item in items if item.span]
    length = float(_chainages(points)[-1])
    outer = ((0, 0.0), (-1, length))
    return [
        (chain[k].number, _point_at(points, s))
        for (k, s), end in zip(outer, ends, strict=True)
        if chain and end is None
    ]


def _items(plant: Plant) -> list[Item]:
    units = {unit.id: unit for unit in plant.units}
    members: dict[str, list[int]] = {}
    for index, component in enumerate(plant.components):
        members.setdefault(component.unit or f"\0{index}", []).append(index)
    items: list[Item] = []
    for key, some in members.items():
        first = plant.components[some[0]]
        line = next((plant.components[i].line for i in some if plant.components[i].line), "")
        items.append(Item(len(items), tuple(some), units.get(key), line, first.group, first.name))
    return items


_Box = tuple[Floats, Floats]


def _on_line(item: Item, boxes: Sequence[_Box], courses: dict[str, Floats]) -> Item:
    """The item with its place along its line."""
    if item.line not in courses:
        return item
    low, high = _around(item, boxes)
    points = courses[item.line]
    span = None if item.group in _APART else _span(points, low, high)
    at = sum(span) / 2 if span else _nearest(points, (low + high) / 2)
    return Item(item.number, item.members, item.unit, item.line, item.group, item.name, span, at)


def _around(item: Item, boxes: Sequence[_Box]) -> _Box:
    low = np.min([boxes[i][0] for i in item.members], axis=0)
    high = np.max([boxes[i][1] for i in item.members], axis=0)
    return low, high


def _chainages(points: Floats) -> Floats:
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])


def _span(points: Floats, low: Floats, high: Floats) -> tuple[float, float] | None:
    """The longest stretch of a polyline within a box, as chainages [m]."""
    marks = _chainages(points)
    stretches: list[list[float]] = []
    for k, (p, q) in enumerate(pairwise(points)):
        leg = q - p
        with np.errstate(divide="ignore", invalid="ignore"):
            enter, leave = (low - p) / leg, (high - p) / leg
        level = np.abs(leg) < 1e-12
        if (level & ((p < low) | (p > high))).any():
            continue
        near, far = np.where(level, 0.0, np.minimum(enter, leave)), np.where(level, 1.0, np.maximum(enter, leave))
        start, end = max(0.0, float(near.max())), min(1.0, float(far.min()))
        if end <= start:
            continue
        length = marks[k + 1] - marks[k]
        a, b = float(marks[k] + start * length), float(marks[k] + end * length)
        if stretches and a - stretches[-1][1] < 1e-9:
            stretches[-1][1] = b
        else:
            stretches.append([a, b])
    if not stretches:
        return None
    start, end = max(stretches, key=lambda one: one[1] - one[0])
    return start, end


def _nearest(points: Floats, place: Floats) -> float:
    """The chainage of the point of a polyline that is nearest to a place [m]."""
    legs = np.diff(points, axis=0)
    squares = np.maximum((legs**2).sum(axis=1), 1e-30)
    share = np.clip(((place - points[:-1]) * legs).sum(axis=1) / squares, 0, 1)
    gaps = np.linalg.norm(points[:-1] + share[:, None] * legs - place, axis=1)
    k = int(np.argmin(gaps))
    marks = _chainages(points)
    return float(marks[k] + share[k] * (marks[k + 1] - marks[k]))


def _point_at(points: Floats, chainage: float) -> tuple[float, float, float]:
    marks = _chainages(points)
    x, y, z = (float(np.interp(chainage, marks, points[:, axis])) for axis in range(3))
    return x, y, z


def _ends(plant: Plant, tag: str, items: Sequence[Item], boxes: Sequence[_Box]) -> tuple[int | None, int | None]:
    """The items of other lines or none that a run begins and ends at."""
    own = [c for c in plant.connections if c.line == tag]
    if not own:
        return None, None
    units = {item.unit.id: item for item in items if item.unit}
    points = {point.id: point.point for point in plant.points if point.kind == "junction"}
    found: list[int | None] = []
    for node in (own[0].source, own[-1].target):
        if node in units and units[node].line != tag:
            found.append(units[node].number)
        elif node in points:
            others = [item for item in items if item.line not in ("", tag) and item.span]
            found.append(_holding(others, np.array(points[node]), boxes))
        else:
            found.append(None)
    return found[0], found[1]


def _holding(items: Sequence[Item], place: Floats, boxes: Sequence[_Box]) -> int | None:
    """The item whose box holds a place, the one with its middle nearest to it."""
    best, number = np.inf, None
    for item in items:
        low, high = _around(item, boxes)
        out = np.linalg.norm(np.maximum(0, np.maximum(low - place, place - high)))
        distance = float(np.linalg.norm((low + high) / 2 - place))
        if out <= _NEAR and distance < best:
            best, number = distance, item.number
    return number


def _joints(
    plant: Plant, tag: str, items: Sequence[Item], points: Floats, ends: tuple[int | None, int | None]
) -> list[Joint]:
    """What follows what along a run, with the items at its ends."""
    chain = [item for item in items if item.span]
    if not chain:
        return []
    marks = _chainages(points)
    meets: list[tuple[int, int, float]] = []
    if ends[0] is not None:
        meets.append((ends[0], chain[0].number, 0.0))
    for a, b in pairwise(chain):
        if a.span and b.span:
            meets.append((a.number, b.number, (a.span[1] + b.span[0]) / 2))
    if ends[1] is not None:
        meets.append((chain[-1].number, ends[1], float(marks[-1])))
    own = [c for c in plant.connections if c.line == tag]
    borders = np.cumsum([c.length for c in own])
    joints = []
    for first, second, chainage in meets:
        k = min(int(np.searchsorted(borders, chainage)), len(own) - 1)
        flow = own[k].direction if own else "unknown"
        joints.append(Joint(first, second, _point_at(points, chainage), flow, tag))
    return joints
