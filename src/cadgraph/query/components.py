"""What stands in a line, piece by piece in order: pipes, bends, fittings, valves, each with its ends on the centreline.

Ends are where the graph's joints are: what it says is joined shares one point, so that nothing lies between.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace

from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Joint, Junction, Part, Point, Terminal, Unit
from cadgraph.query.bends import TURN, arc_tangents, bend_radius, fitted, tangent
from cadgraph.query.lines import Line, find_lines
from cadgraph.query.network import Arc, Network
from cadgraph.query.piped_line import Branch, Component, EndKind, LineEnd, PipedLine
from cadgraph.query.polyline import Polyline, angle, apex, dot, minus, times, unit

__all__ = ["find_components"]

_OUTLET = "branch outlet"
_FITTINGS = ("tee", "cross", _OUTLET)
_NEAR = 5e-3  # m; ours: a tap and what sits on it have one axis
_PIPE = 0.05  # m; ours: a diameter where none is known, to tell bends from straights
_LEAST = 1e-4  # m; ours: a shorter piece is none, a gasket is some millimetres
_MOST_TURN = math.radians(100)  # ours: elbows turn by 90 degrees at most, and are built a little askew
_OFFSET = 0.02  # ours: of the larger size; a concentric reducer's ends lie on one axis


@dataclass
class _Item:
    """A part or unit in a line, before it has ends."""

    parts: tuple[str, ...]
    place: str | None  # id of the node, where it is a unit
    low: float  # stations of the arcs that it belongs to: its ends lie between
    high: float
    ports: tuple[Point | None, Point | None] = (None, None)  # of a unit: where the line enters and leaves it
    sizes: tuple[int | None, int | None] = (None, None)
    diameters: tuple[float | None, float | None] = (None, None)


@dataclass
class _Run:
    """A line in the making."""

    line: Line
    centreline: Polyline
    items: list[_Item] = field(default_factory=list)
    taps: list[tuple[float, str]] = field(default_factory=list)  # stations of what hangs on a part, and its node
    bounds: list[float] = field(default_factory=list)  # stations between the items, with both ends
    missing: list[str] = field(default_factory=list)  # meshes at joints that the graph lacks
    hosted: tuple[bool, bool] = (False, False)  # whether the run is set on the first, the last of its items


def find_components(graph: SceneGraph | Network) -> tuple[PipedLine, ...]:
    """All lines of a graph with what stands in them.

    A tee belongs to the largest of the lines that meet there, of equal ones to the first in the order of tags; the
    others begin where it ends. A branch that is set on a pipe is a ``tap`` of that line. A part that is a pipe with
    bends in one piece is several components, and so is a pipe with a tap on it.

    Args:
        graph: the finished graph, or its network.

    Returns:
        The lines in the order of the line list; those without a centreline have no component, and a note says so.
    """
    network = graph if isinstance(graph, Network) else Network(graph)
    return _Plant(network).lines()


class _Plant:
    """All lines together: what one of them needs to know of the others."""

    def __init__(self, network: Network) -> None:
        self.network = network
        self.graph = network.graph
        self.joints: dict[str, list[Joint]] = {}
        for joint in self.graph.joints():
            if joint.made:
                self.joints.setdefault(joint.first, []).append(joint)
                self.joints.setdefault(joint.second, []).append(joint)
        self.runs = [self._run(line) for line in find_lines(network)]
        # Which lines end at a node, and with which of their ends.
        self.meets: dict[str, list[tuple[_Run, bool]]] = {}
        for run in self.runs:
            for place, last in ((run.line.start, False), (run.line.end, True)):
                self.meets.setdefault(place, []).append((run, last))

    def lines(self) -> tuple[PipedLine, ...]:
        return tuple(self._line(run) for run in self.runs)

    # From arcs to items with ends

    def _run(self, line: Line) -> _Run:
        points: list[Point] = []
        stations = [0.0]
        for arc in line.arcs:
            points.extend(arc.path)
            stations.append(Polyline.through(points).length if points else 0.0)
        run = _Run(line, Polyline.through(points))
        if len(run.centreline.points) < 2:
            return run
        self._collect(run, stations)
        self._size(run)
        self._bound(run)
        return run

    def _collect(self, run: _Run, stations: Sequence[float]) -> None:
        arcs = run.line.arcs
        self._add_unit(run, run.line.start, 0.0, 0.0, (None, arcs[0]))
        for i, arc in enumerate(arcs):
            for number, part in enumerate(arc.via):
                last = run.items[-1] if run.items else None
                if number == 0 and last is not None and last.place is None and part in last.parts:
                    last.high = stations[i + 1]
                    continue
                run.items.append(_Item((part,), None, stations[i], stations[i + 1]))
            if not arc.via and stations[i + 1] - stations[i] > _LEAST and not self._touch(arc):
                run.items.append(_Item((), None, stations[i], stations[i + 1]))
            if i + 1 == len(arcs):
                break
            onward = arcs[i + 1]
            if arc.via and onward.via and arc.via[-1] == onward.via[0]:
                run.taps.append((stations[i + 1], arc.end))
            else:
                self._add_unit(run, arc.end, stations[i], stations[i + 2], (arc, onward))
        self._add_unit(run, run.line.end, run.centreline.length, run.centreline.length, (arcs[-1], None))

    def _touch(self, arc: Arc) -> bool:
        """Whether the units at both ends of a connection join each other, without a pipe between."""
        nodes = [self.network.places[place] for place in (arc.start, arc.end)]
        one, other = (_Item(node.parts, None, 0.0, 0.0) for node in nodes)
        return bool(self._between(one, other))

    def _add_unit(self, run: _Run, place: str, low: float, high: float, arcs: tuple[Arc | None, Arc | None]) -> None:
        node = self.network.places[place]
        if not isinstance(node, Unit):
            return
        points = {port.name: port.point for port in node.ports}
        enters, leaves = (arcs[0].end_port if arcs[0] else None, arcs[1].start_port if arcs[1] else None)
        run.items.append(_Item(node.parts, place, low, high, (points.get(enters or ""), points.get(leaves or ""))))

    def _size(self, run: _Run) -> None:
        """The sizes at both ends of each item; they change at reducers, else where connections meet."""
        queue = [(size, arc.edge.diameter) for arc in run.line.arcs for size in (arc.sizes or (None,))]
        steps = [queue[0]]
        for size, diameter in queue[1:]:
            if size is not None and size != steps[-1][0]:
                steps = [(size, diameter)] if steps == [(None, None)] else [*steps, (size, diameter)]
        reducers = [i for i, item in enumerate(run.items) if self._name(item) == "reducer"]
        now = 0
        for i, item in enumerate(run.items):
            before = steps[now]
            # Without reducers to change at, the size changes as late as there are sizes left.
            if now + 1 < len(steps) and (i in reducers or (not reducers and item.place is not None and i > 0)):
                now += 1
            item.sizes = before[0], steps[now][0]
            item.diameters = before[1], steps[now][1]

    def _bound(self, run: _Run) -> None:
        line = run.centreline
        bounds = [0.0]
        for before, after in zip(run.items, run.items[1:], strict=False):
            station = self._joint_station(run, before, after, bounds[-1])
            if station is None:
                run.missing.extend(self._meshes((before, after)))
                station = self._guess(run, before, after, bounds[-1])
            bounds.append(max(station, bounds[-1]))
        run.bounds = [*bounds, line.length]
        run.hosted = (self._is_host(run, False), self._is_host(run, True))

    def _joint_station(self, run: _Run, before: _Item, after: _Item, start: float) -> float | None:
        low, high = max(start, min(before.low, after.low)), max(before.high, after.high)
        found = [run.centreline.nearest(joint.point, low, high) for joint in self._between(before, after)]
        for point in (before.ports[1], after.ports[0]):
            if not found and point is not None:
                found = [run.centreline.nearest(point, low, high)]
        return min((distance, station) for station, distance in found)[1] if found else None

    def _between(self, one: _Item, other: _Item) -> list[Joint]:
        there = set(other.parts)
        return [j for part in one.parts for j in self.joints.get(part, ()) if {j.first, j.second} - {part} <= there]

    def _guess(self, run: _Run, before: _Item, after: _Item, start: float) -> float:
        """Halfway between the middles of two parts, where the graph has no joint of them."""
        return max(start, sum(self._middle(run, item) for item in (before, after)) / 2)

    def _middle(self, run: _Run, item: _Item) -> float:
        """Station of the middle of an item [m]."""
        node = self.graph.nodes[item.place or item.parts[0]] if item.place or item.parts else None
        if isinstance(node, Unit):
            return run.centreline.nearest(node.centroid, item.low, item.high)[0]
        if isinstance(node, Part):
            return run.centreline.nearest(node.obb.center, item.low, item.high)[0]
        return (item.low + item.high) / 2

    def _is_host(self, run: _Run, last: bool) -> bool:
        """Whether a line is set on what it begins at, as a branch on the side of a pipe."""
        place = run.line.end if last else run.line.start
        if not isinstance(self.network.places[place], Junction) or len(run.items) < 2:
            return False
        own, inner = (run.items[-1], run.items[-2]) if last else (run.items[0], run.items[1])
        return self._name(own) not in _FITTINGS and any(
            joint.kind == "tap" and joint.second in own.parts for joint in self._between(own, inner)
        )

    # From items to components

    def _line(self, run: _Run) -> PipedLine:
        notes = self._notes(run)
        if not run.bounds:
            nowhere = (0.0, 0.0, 0.0)
            none = LineEnd("unknown", nowhere)
            return PipedLine(run.line, (), none, none, notes=notes)
        low, high = 0, len(run.items)
        if self._leaves_out(run, False):
            low = 1
        if self._leaves_out(run, True):
            high = max(low, high - 1)
        components: list[Component] = []
        for i in range(low, high):
            components.extend(self._pieces(run, i))
        start = components[0].start if components else run.centreline.at(run.bounds[low])
        end = components[-1].end if components else run.centreline.at(run.bounds[high])
        components = [*self._set_on(run, False), *components, *self._set_on(run, True)]
        return PipedLine(
            run.line,
            tuple(_with_flanges(components)),
            self._end(run, False, start),
            self._end(run, True, end),
            tuple(self._outlets(run)),
            tuple(self._instruments(run)),
            notes,
        )

    def _leaves_out(self, run: _Run, last: bool) -> bool:
        """Whether the item at an end of a line is written elsewhere: equipment, or a fitting of another line."""
        if not run.items:
            return False
        place = run.line.end if last else run.line.start
        item = run.items[-1 if last else 0]
        if item.place is not None:
            return item.place == place and (not self.network.is_valve(place) or self._owner(place) is not run)
        if self._is_set_on(run, last):
            return True
        return self._stands_at(run, last) and self._is_fitting(place) and self._owner(place) is not run

    def _stands_at(self, run: _Run, last: bool) -> bool:
        """Whether the first or last item of a line is what the junction there is made of."""
        node = self.network.places[run.line.end if last else run.line.start]
        return isinstance(node, Junction) and bool(set(run.items[-1 if last else 0].parts) & set(node.parts))

    def _is_fitting(self, place: str) -> bool:
        """Whether the lines at a junction meet in a fitting, not on the side of a pipe."""
        return not any(self._is_set_on(run, last) for run, last in self.meets[place] if run.bounds)

    def _is_set_on(self, run: _Run, last: bool) -> bool:
        """Whether a line begins on the side of the pipes of others, with an outlet of its own or without."""
        return run.hosted[last] or self._is_outlet(run, last)

    def _is_outlet(self, run: _Run, last: bool) -> bool:
        """Whether a line begins with a branch outlet that is set on the pipes of the others at a junction."""
        place = run.line.end if last else run.line.start
        if not run.items or not self._stands_at(run, last) or self._name(run.items[-1 if last else 0]) != _OUTLET:
            return False
        others = [
            (other, end) for other, end in self.meets[place] if other.items and not (other is run and end == last)
        ]
        return bool(others) and all(
            self._stands_at(other, end) and self._name(other.items[-1 if end else 0]) not in _FITTINGS
            for other, end in others
        )

    def _owner(self, place: str) -> _Run | None:
        """The line that a fitting or a valve of several lines belongs to."""
        runs = [run for run, last in self.meets[place] if run.bounds and not self._is_set_on(run, last)]
        return min(runs, key=lambda run: (-max(run.line.sizes, default=0), run.line.tag), default=None)

    def _pieces(self, run: _Run, i: int) -> Iterator[Component]:
        item, (start, end) = run.items[i], run.bounds[i : i + 2]
        if end - start < _LEAST and not self._reaches_end(run, i):
            return
        base = Component(
            kind="other",
            what=None,
            start=run.centreline.at(start),
            end=run.centreline.at(end),
            sizes=item.sizes,
            diameters=item.diameters,
            length=end - start,
            parts=item.parts,
        )
        if item.place is not None:
            yield self._unit(run, i, base)
            return
        name = self._name(item)
        junction = self._junction_of(run, i)
        if junction is not None and (name in _FITTINGS or self._is_fitting(junction)):
            yield self._fitting(run, i, junction, base)
        elif name == "elbow":
            yield from self._elbow(run, i, base)
        elif name in (None, "pipe", "nipple") or self._group(item) != "Pipe assembly":
            yield from self._pipes(run, i, base, name)
        elif name == "reducer":
            yield replace(base, kind=name, what=name, offset=self._offset(run, start, end, base))
        else:
            yield replace(base, kind=name, what=name)

    def _reaches_end(self, run: _Run, i: int) -> bool:
        """Whether an item is all that there is at the end of its line, as a valve that nothing leaves from."""
        return run.items[i].place is not None

    def _unit(self, run: _Run, i: int, base: Component) -> Component:
        place = run.items[i].place
        node = self.network.places[place] if place is not None else None
        assert isinstance(node, Unit)
        kind = "valve" if node.unit_type == "valve" else "instrument" if node.unit_type == "gauge" else "other"
        found = replace(base, kind=kind, what=node.kind or node.unit_type, tag=node.tag)
        ends_here = node.id in (run.line.start, run.line.end)
        if ends_here:
            return self._end_valve(run, node, found)
        ways = (
            run.centreline.direction(run.bounds[i] - 0.05, run.bounds[i]),
            run.centreline.direction(run.bounds[i + 1], run.bounds[i + 1] + 0.05),
        )
        turned = angle(*ways)
        if turned > 10 * TURN:
            return replace(found, centre=apex(found.start, ways[0], found.end, ways[1]), angle=turned)
        return found

    def _end_valve(self, run: _Run, node: Unit, found: Component) -> Component:
        """A valve that its line ends at: its other ends are where other lines begin, or another of its ports."""
        others = [
            Branch(*self._meeting(other, last), line=other.line.tag, goes_on=True)
            for other, last in self.meets[node.id]
            if other is not run and other.bounds
        ]
        here = found.end if node.id == run.line.start else found.start
        if not others:
            free = [port.point for port in node.ports if minus(port.point, here) != (0, 0, 0)]
            far = max(free, key=lambda point: dot(minus(point, here), minus(point, here)), default=None)
            others = [] if far is None else [Branch(far, *_first(found), line="")]
        if not others:
            return replace(found, centre=node.centroid)
        way = unit(minus(node.centroid, here))
        others.sort(key=lambda branch: -dot(unit(minus(branch.point, here)), way))
        through = others[0].point
        found = replace(found, centre=node.centroid, branches=tuple(others[1:]))
        return replace(found, start=through) if node.id == run.line.start else replace(found, end=through)

    def _meeting(self, run: _Run, last: bool) -> tuple[Point, int | None, float | None]:
        """Where the first item of a line that belongs to another one ends, with its size."""
        item, station = (run.items[-1], run.bounds[-2]) if last else (run.items[0], run.bounds[1])
        side = 0 if last else 1
        place = run.line.end if last else run.line.start
        if (
            item.place is None
            and not self._is_set_on(run, last)
            and not (self._stands_at(run, last) and self._is_fitting(place))
        ):
            # The graph has nothing of the junction, or only what is set on there: the lines meet in its point.
            station, side = (run.centreline.length, 1) if last else (0.0, 0)
        return run.centreline.at(station), item.sizes[side], item.diameters[side]

    def _junction_of(self, run: _Run, i: int) -> str | None:
        """The junction that an item is the fitting of, if any: at an end of its line, or in it with taps."""
        for edge, place in ((0, run.line.start), (len(run.items) - 1, run.line.end)):
            node = self.network.places[place]
            if i == edge and isinstance(node, Junction) and set(run.items[i].parts) & set(node.parts):
                return place
        for station, place in run.taps:
            node = self.network.places[place]
            inside = run.bounds[i] - _LEAST <= station <= run.bounds[i + 1] + _LEAST
            if inside and isinstance(node, Junction) and self._name(run.items[i]) in _FITTINGS:
                return place
        return None

    def _fitting(self, run: _Run, i: int, place: str, base: Component) -> Component:
        node = self.network.places[place]
        assert isinstance(node, Junction)
        kind = self._name(run.items[i]) or "tee"
        found = replace(
            base, kind=kind if kind in _FITTINGS else "tee", what=self._name(run.items[i]), centre=node.point
        )
        at_end = (place == run.line.start and i == 0, place == run.line.end and i == len(run.items) - 1)
        if not any(at_end):
            tapped = [self._tap_branch(arc) for arc in self.network.arcs(place) if self.network.is_tap(arc)]
            return replace(found, branches=tuple(branch for branch in tapped if branch is not None))
        here = found.end if at_end[0] else found.start
        others = [
            (self._meeting(other, last), other.line.tag)
            for other, last in self.meets[place]
            if not (other is run and last == at_end[1]) and other.bounds
        ]
        way = unit(minus(node.point, here))
        others.sort(key=lambda other: -dot(unit(minus(other[0][0], node.point)), way))
        if not others:
            return found
        (through, size, diameter), _ = others[0]
        branches = tuple(Branch(*meeting, line=tag, goes_on=True) for meeting, tag in others[1:])
        if at_end[0]:
            return replace(
                found,
                start=through,
                branches=branches,
                sizes=(size, found.sizes[1]),
                diameters=(diameter, found.diameters[1]),
            )
        return replace(
            found,
            end=through,
            branches=branches,
            sizes=(found.sizes[0], size),
            diameters=(found.diameters[0], diameter),
        )

    def _tap_branch(self, arc: Arc) -> Branch | None:
        """Where a tap leaves its fitting."""
        if not arc.path:
            return None
        size = arc.sizes[0] if arc.sizes else None
        name = self.network.name(arc.end)
        line = Polyline.through(arc.path)
        if len(arc.via) > 1:
            found = self._between(_Item(arc.via[:1], None, 0, 0), _Item(arc.via[1:2], None, 0, 0))
            if found:
                return Branch(line.at(line.nearest(found[0].point)[0]), size, arc.edge.diameter, name)
        return Branch(line.at(line.length), size, arc.edge.diameter, name)

    def _set_on(self, run: _Run, last: bool) -> list[Component]:
        """The branches that are set on the pipe at the end of a line, where it is the line that says so."""
        place = run.line.end if last else run.line.start
        if not isinstance(self.network.places[place], Junction) or self._is_fitting(place):
            return []
        if self._owner(place) is not run:
            return []
        item = run.items[-1 if last else 0]
        point = run.centreline.at(run.centreline.length if last else 0.0)
        side = 1 if last else 0
        return [
            Component(
                kind=_OUTLET if self._is_outlet(other, end) else "tap",
                what=_OUTLET if self._is_outlet(other, end) else None,
                start=point,
                end=point,
                centre=point,
                branches=(Branch(*self._meeting(other, end), line=other.line.tag, goes_on=True),),
                sizes=(item.sizes[side], item.sizes[side]),
                diameters=(item.diameters[side], item.diameters[side]),
                parts=other.items[-1 if end else 0].parts if self._is_outlet(other, end) else item.parts,
            )
            for other, end in self.meets[place]
            if other.bounds and self._is_set_on(other, end)
        ]

    def _pipes(self, run: _Run, i: int, base: Component, name: str | None) -> Iterator[Component]:
        """A pipe as straights and bends, cut where something is set on it."""
        start, end = run.bounds[i], run.bounds[i + 1]
        cuts = [station for station, place in run.taps if start + _LEAST < station < end - _LEAST]
        stretches = run.centreline.stretches(start, end, self._outer(run.items[i]))
        found: list[Component] = []
        radii: list[float | None] = []
        for stretch in stretches:
            if stretch.turns:
                found.append(self._bend(run, stretch.start, stretch.end, base))
                radii.append(bend_radius(run.centreline, stretch.start, stretch.end, found[-1]))
                continue
            ends = [stretch.start, *(cut for cut in cuts if stretch.start < cut < stretch.end), stretch.end]
            found.extend(self._piece(run, a, b, base) for a, b in zip(ends, ends[1:], strict=False))
            radii.extend(None for _ in ends[1:])
        found = list(fitted(found, radii))
        known = self._group(run.items[i]) in ("Pipe assembly", None)
        for piece in found:
            kind = piece.kind if known else "other"
            yield replace(piece, kind=kind, what=name, split=len(found) > 1)

    def _elbow(self, run: _Run, i: int, base: Component) -> Iterator[Component]:
        """An elbow; one that turns by more than elbows do, as a return bend, in pieces."""
        turned = self._bend(run, run.bounds[i], run.bounds[i + 1], base)
        if turned.centre is not None and turned.angle < _MOST_TURN:
            yield replace(turned, kind="elbow", what="elbow")
            return
        pieces = list(self._pipes(run, i, base, "elbow"))
        bends = any(piece.kind == "bend" for piece in pieces)
        yield from pieces if bends else [replace(base, what="elbow")]

    def _piece(self, run: _Run, start: float, end: float, base: Component) -> Component:
        at = run.centreline.at
        return replace(base, kind="pipe", start=at(start), end=at(end), length=end - start)

    def _bend(self, run: _Run, start: float, end: float, base: Component) -> Component:
        """A piece that turns, with the point where its tangents meet; a straight one where there is no such point."""
        piece = self._piece(run, start, end, base)
        line = run.centreline
        before, after = tangent(line, start, -1), tangent(line, end, 1)
        tangents = [
            (before, after) if before is not None and after is not None else None,
            arc_tangents(piece.start, line.at(self._vertex(line, start, end)), piece.end),
        ]
        for ways in tangents:
            if ways is None:
                continue
            centre = apex(piece.start, ways[0], piece.end, ways[1])
            if centre is not None and angle(*ways) > TURN:
                return replace(piece, kind="bend", centre=centre, angle=angle(*ways))
        return piece

    def _vertex(self, line: Polyline, start: float, end: float) -> float:
        """The point of the centreline that is nearest to the middle of a piece: on the arc, not on a chord of it."""
        middle = (start + end) / 2
        inner = [station for station in line.stations if start < station < end]
        return min(inner, key=lambda station: abs(station - middle), default=middle)

    def _offset(self, run: _Run, start: float, end: float, base: Component) -> Point | None:
        line = run.centreline
        way = line.direction(start - 0.05, start) if start > 0.05 else line.direction(end, end + 0.05)
        across = minus(base.end, base.start)
        off = minus(across, times(way, dot(across, way)))
        first, last = (size or 0 for size in base.sizes)
        if math.hypot(*off) <= max(_OFFSET * max(first, last) / 1000, 1e-3):
            return None
        return off if first >= last else times(off, -1)

    # What they are

    def _name(self, item: _Item) -> str | None:
        node = self.graph.nodes[item.parts[0]] if item.parts else None
        label = node.label if isinstance(node, Part) else None
        return label.name if label else None

    def _group(self, item: _Item) -> str | None:
        node = self.graph.nodes[item.parts[0]] if item.parts else None
        label = node.label if isinstance(node, Part) else None
        return label.group if label else None

    def _outer(self, item: _Item) -> float:
        known = [diameter for diameter in item.diameters if diameter]
        node = self.graph.nodes[item.parts[0]] if item.parts else None
        return known[0] if known else sorted(node.obb.extents)[0] if isinstance(node, Part) else _PIPE

    def _meshes(self, items: Iterable[_Item]) -> list[str]:
        found = []
        for item in items:
            node = self.graph.nodes[item.parts[0]] if item.parts else None
            if isinstance(node, Part):
                found.append(node.meshes[0])
        return found

    def _end(self, run: _Run, last: bool, point: Point) -> LineEnd:
        place = run.line.end if last else run.line.start
        node = self.network.places[place]
        if isinstance(node, Unit):
            port = run.line.end_port if last else run.line.start_port
            if self.network.is_valve(place):
                others = [other.line.tag for other, _ in self.meets[place] if other is not run]
                if not others:
                    return LineEnd("unknown", point, node.tag)
                return LineEnd("pipeline", point, min(others))
            return LineEnd("equipment", point, node.tag, port)
        if isinstance(node, Terminal):
            kinds: dict[str, EndKind] = {"open": "open", "blind": "closed"}
            return LineEnd(kinds.get(node.kind, "unknown"), point)
        owner = self._owner(place)
        if owner is not None and owner is not run:
            return LineEnd("pipeline", point, owner.line.tag)
        onward = [
            (math.dist(self._meeting(other, end)[0], point), other.line.tag)
            for other, end in self.meets[place]
            if not (other is run and end == last) and other.bounds
        ]
        return LineEnd("pipeline", point, min(onward)[1]) if onward else LineEnd("unknown", point)

    def _outlets(self, run: _Run) -> Iterator[Component]:
        for station, place in run.taps:
            node = self.network.places[place]
            host = next((i for i, end in enumerate(run.bounds[1:]) if station <= end + _LEAST), None)
            if host is None or not isinstance(node, Unit):
                continue
            item = run.items[host]
            for joint in self.joints.get(item.parts[0] if item.parts else "", ()):
                if joint.kind != "tap" or joint.second != item.parts[0]:
                    continue
                outlet = _Item((joint.first,), None, 0.0, 0.0)
                away = [j for j in self._between(outlet, _Item(node.parts, None, 0.0, 0.0)) if j is not joint]
                at = run.centreline.nearest(joint.point, run.bounds[host], run.bounds[host + 1])[0]
                if self._name(outlet) != "branch outlet" or not away or abs(at - station) > _NEAR:
                    continue
                yield Component(
                    kind="branch outlet",
                    what="branch outlet",
                    start=run.centreline.at(station),
                    end=run.centreline.at(station),
                    centre=run.centreline.at(station),
                    branches=(Branch(away[0].point, None, node.ports[0].diameter if node.ports else None, node.tag),),
                    sizes=item.sizes,
                    diameters=item.diameters,
                    parts=outlet.parts,
                )

    def _instruments(self, run: _Run) -> Iterator[tuple[str, str | None, Point]]:
        for station, place in run.taps:
            names = (place, *self.network.instruments(place))
            for each in dict.fromkeys(names):
                node = self.network.places[each]
                if isinstance(node, Unit):
                    yield node.tag, node.kind or node.unit_type, run.centreline.at(station)

    def _notes(self, run: _Run) -> tuple[Diagnostic, ...]:
        tag = run.line.tag
        if not run.bounds:
            return (Diagnostic("no-centreline", f"{tag}: the graph has no centreline of it; nothing is written"),)
        found = []
        if any(not item.parts and item.place is None for item in run.items):
            found.append(Diagnostic("no-part", f"{tag}: connections without a part between are taken for pipes"))
        if run.missing:
            message = f"{tag}: no joint between parts that follow each other; they are made to meet halfway"
            found.append(Diagnostic("missing-joint", message, tuple(dict.fromkeys(run.missing))))
        return tuple(found)


def _with_flanges(components: Sequence[Component]) -> Iterator[Component]:
    """The components, each with whether flanges or gaskets stand next to it."""
    faces = ("flange", "gasket", "blind flange")
    for i, each in enumerate(components):
        before = i > 0 and components[i - 1].kind in faces
        after = i + 1 < len(components) and components[i + 1].kind in faces
        yield replace(each, flanged=(before, after))


def _first(component: Component) -> tuple[int | None, float | None]:
    return component.sizes[0] or component.sizes[1], component.diameters[0] or component.diameters[1]
