"""Writes the functional graph as Proteus XML 4.1 in the terms of DEXPI 1.3."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from cadgraph._io.atomic import write_atomically
from cadgraph._io.text import file_name, tag_key, xml_text
from cadgraph.draw.schematic.symbol import instrument_letters
from cadgraph.export.dexpi.element import Ids, add_item, add_nodes, add_position, add_values, diameter_values
from cadgraph.export.dexpi.terms import INSTRUMENT, Term, term_of_terminal, term_of_unit
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Terminal, Unit
from cadgraph.query.doubt import few_ports, open_sides
from cadgraph.query.duty import duty_of, worked_by_hand
from cadgraph.query.lines import Line, divides, find_lines
from cadgraph.query.network import Arc, Network

if TYPE_CHECKING:
    from cadgraph.draw.schematic.place import Places, Spot

__all__ = ["write_dexpi"]

# The format wants a date; one that changed with every run would make the same plant different files.
_DATE, _TIME = "2000-01-01", "00:00:00"


def write_dexpi(graph: SceneGraph, path: str | Path) -> Path:
    """Writes tanks, pumps and other equipment with their nozzles, lines with their valves, and instruments.

    Each line becomes a PipingNetworkSystem, each part of it of one nominal size a PipingNetworkSegment. Positions are
    those of the schematic; the place in the plant, lengths and what DEXPI has no attribute for are custom attributes.
    The same graph gives the same bytes; the date in the header is therefore a fixed one.

    Args:
        graph: the finished graph.
        path: the file.

    Returns:
        The file.

    Raises:
        OutputError: it can't be written.
    """
    from cadgraph.draw.schematic.place import find_places

    network = Network(graph)
    root = _Document(network, find_places(network)).build()
    ET.indent(root, " ")
    text = ET.tostring(root, encoding="unicode")
    write_atomically(path, f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n')
    return Path(path)


@dataclass
class _End:
    """Where a pipe can be joined: an item and the number of its connection point."""

    item: str
    node: int


class _Document:
    """A document in the making."""

    def __init__(self, network: Network, places: Places) -> None:
        self.network = network
        self.places = places
        self.ids = Ids()
        self.root = ET.Element("PlantModel")
        self.nozzles: dict[tuple[int, bool], _End] = {}  # by connection and the end of it
        self.components: dict[str, ET.Element] = {}  # valves, junctions and ends by the id of the node
        self.rings: set[str] = set()  # where a line begins and ends at the same node
        self.tees: dict[str, ET.Element] = {}  # that a valve on the side of a run hangs at, by the valve's id
        self.sensed: dict[str, tuple[ET.Element, float]] = {}  # segment of each instrument, and how far along it

    def build(self) -> ET.Element:
        """The whole document."""
        self._head()
        for place in self._sorted(lambda unit: unit.unit_type not in ("valve", "gauge")):
            self._equipment(place)
        lines = find_lines(self.network)
        for line in lines:
            self._system(line)
        for place in sorted(self.network.places, key=lambda place: tag_key(self.network.name(place))):
            for arc in self.network.arcs(place):
                if self.network.is_tap(arc) and self._begins_tap(arc):
                    self._tap(arc)
        for place in self._sorted(lambda unit: unit.unit_type == "valve"):
            if place in self.tees:
                self._branch(place)
            elif place not in self.components:
                self._component(place, self._segment(self._piping_system(), None))
        for place in self._sorted(lambda unit: unit.unit_type == "gauge"):
            self._instrument(place)
        return self.root

    def _sorted(self, wanted: Callable[[Unit], bool]) -> list[str]:
        units = [node for node in self.network.places.values() if isinstance(node, Unit)]
        return [u.id for u in sorted(units, key=lambda u: tag_key(u.tag)) if wanted(u)]

    def _head(self) -> None:
        from cadgraph import __version__

        name = file_name(self.network.graph.source.path) or "plant"
        information = ET.SubElement(
            self.root,
            "PlantInformation",
            SchemaVersion="4.1.1",
            OriginatingSystem="cadgraph",
            OriginatingSystemVendor="cadgraph",
            OriginatingSystemVersion=__version__,
            ModelName=xml_text(name),
            Date=_DATE,
            Time=_TIME,
            Is3D="no",
            Units="mm",
            Discipline="PID",
            Application="Dexpi",
            ApplicationVersion="1.3",
        )
        ET.SubElement(information, "UnitsOfMeasure", Distance="mm")
        self._extent(self.root)
        drawing = ET.SubElement(self.root, "Drawing", Name=xml_text(name), Type="PID", Title=xml_text(name))
        ET.SubElement(drawing, "Presentation", LineType="0", LineWeight="0.35", R="0", G="0", B="0")
        self._extent(drawing)

    def _extent(self, above: ET.Element) -> None:
        extent = ET.SubElement(above, "Extent")
        ET.SubElement(extent, "Min", X="0", Y="0", Z="0")
        ET.SubElement(extent, "Max", X=f"{self.places.width:g}", Y=f"{self.places.height:g}", Z="0")

    # Equipment

    def _add_place(self, item: ET.Element, place: str, point: tuple[float, float, float]) -> None:
        """Where an item is in the plant, and whether more may be joined to it there than a drawing can show."""
        hand = duty_of(self.network, place) == "relief" and worked_by_hand(self.network, place)
        # That a unit has too few lines is to be seen in the drawing, too.
        hidden = few_ports(self.network, place) is None and open_sides(self.network, (place,))
        doubtful = "yes" if hand or hidden else None
        add_values(item, {"X": point[0], "Y": point[1], "Z": point[2], "Doubtful": doubtful}, custom=True)

    def _equipment(self, place: str) -> None:
        unit = self.network.places[place]
        if not isinstance(unit, Unit):
            return
        item = add_item(self.root, "Equipment", self.ids, term_of_unit(unit), unit.tag, unit.id)
        add_values(item, {"TagName": unit.tag})
        self._add_place(item, place, unit.centroid)
        add_position(item, self.places.spots.get(place))
        arcs = self.network.arcs(place)
        for port in unit.ports:
            self._nozzle(item, place, port.name, [arc for arc in arcs if arc.start_port == port.name])
        known = {port.name for port in unit.ports}
        for arc in arcs:
            if arc.start_port not in known:
                self._nozzle(item, place, arc.start_port, [arc])

    def _nozzle(self, item: ET.Element, place: str, name: str | None, arcs: Sequence[Arc]) -> None:
        nozzle = add_item(item, "Nozzle", self.ids, Term("Nozzle"))
        add_values(nozzle, {"SubTagName": name})
        add_position(nozzle, self.places.spots.get(place))
        flows_in, flows_out = _flows(arcs)
        add_nodes(nozzle, [_first_size(arc) for arc in arcs] or [None], flows_in, flows_out)
        for number, arc in enumerate(arcs, 1):
            self.nozzles[arc.index, arc.forward] = _End(str(nozzle.get("ID")), number)

    # Lines

    def _system(self, line: Line) -> None:
        system = self._piping_system(line)
        self._run(system, line.arcs, self.places.routes.get(line.tag), line.flow)

    def _piping_system(self, line: Line | None = None) -> ET.Element:
        term = Term("PipingNetworkSystem")
        system = add_item(self.root, "PipingNetworkSystem", self.ids, term, line.tag if line else None)
        if line is not None:
            add_values(system, {"LineNumber": line.tag, **diameter_values(line.sizes[0] if line.sizes else None)})
            add_values(system, {"System": line.system, "Reason": "; ".join(line.reasons) or None}, custom=True)
        return system

    def _segment(self, system: ET.Element, size: int | None, flow: str | None = None) -> ET.Element:
        segment = add_item(system, "PipingNetworkSegment", self.ids, Term("PipingNetworkSegment"))
        number = len(system.findall("PipingNetworkSegment"))
        add_values(segment, {"SegmentNumber": str(number), **diameter_values(size)})
        add_values(segment, {"Flow": flow}, custom=True)
        return segment

    def _begins_tap(self, arc: Arc) -> bool:
        """Whether an arc on a tap leaves what the tap hangs at."""
        return not self.network.is_gauge(arc.start) and not self.network.is_valve(arc.start)

    def _tap(self, arc: Arc) -> None:
        arcs = [arc]
        while True:
            onward = [a for a in self.network.arcs(arcs[-1].end) if a.index != arcs[-1].index]
            if not onward or not (self.network.is_gauge(arcs[-1].end) or self.network.is_valve(arcs[-1].end)):
                break
            arcs.append(onward[0])
        self._run(self._piping_system(), arcs, None, "unknown")

    def _run(
        self,
        system: ET.Element,
        arcs: Sequence[Arc],
        route: tuple[tuple[Spot, ...], tuple[Spot, ...]] | None,
        flow: str,
    ) -> None:
        """One run of connections as segments: a new one wherever the nominal size changes."""
        if arcs[0].start == arcs[-1].end:
            self.rings.add(arcs[0].start)
        size = next((s for arc in arcs for s in arc.sizes), None)
        segment = self._segment(system, size, flow)
        links: dict[str, str] = {}
        self._start(segment, arcs[0], links)
        gone = 0.0
        for number, arc in enumerate(arcs):
            sizes: Sequence[int | None] = arc.sizes or (size,)
            for i, own in enumerate(sizes):
                if own is not None and own != size:
                    links = self._change(segment, arc if i == 0 else None, (size, own), links)
                    segment, gone, size = self._segment(system, own, flow), 0.0, own
                last = i == len(sizes) - 1
                corners = _corners(arc, number, len(arcs), route, self.places)
                self._pipe(segment, arc, arc.length if i == 0 else 0.0, corners if last else (), flow)
                gone += (arc.length or 0.0) if i == 0 else 0.0
            self._stop(segment, arc, gone, links if number == len(arcs) - 1 else {})
        _connect(segment, links)

    def _start(self, segment: ET.Element, arc: Arc, links: dict[str, str]) -> None:
        if self._hangs(arc.start):
            self.sensed.setdefault(arc.start, (segment, 0.0))
        else:
            _set(links, "From", self._joined(segment, arc))

    def _stop(self, segment: ET.Element, arc: Arc, gone: float, links: dict[str, str]) -> None:
        if self._hangs(arc.end):
            self.sensed.setdefault(arc.end, (segment, gone))
        else:
            _set(links, "To", self._joined(segment, arc.back))

    def _hangs(self, place: str) -> bool:
        """Whether a node is an instrument that stands at one line; one where lines meet is written as a fitting."""
        alone = len(self.network.arcs(place)) < 2 or not divides(self.network, place)
        return self.network.is_gauge(place) and alone and place not in self.rings

    def _joined(self, segment: ET.Element, arc: Arc) -> _End:
        """The connection point of what an arc starts at; made in this segment if it is nowhere yet."""
        if (arc.index, arc.forward) in self.nozzles:
            return self.nozzles[arc.index, arc.forward]
        if arc.start not in self.components:
            self._component(arc.start, segment)
        return self._end(arc.start, arc)

    def _change(
        self, before: ET.Element, arc: Arc | None, sizes: tuple[int | None, int | None], links: dict[str, str]
    ) -> dict[str, str]:
        """Ends a segment where the size changes: at a valve or junction that is there, else at a reducer.

        Returns:
            What the next segment begins at.
        """
        following: dict[str, str] = {}
        if arc is not None and before[-1].tag == "PipingComponent" and arc.start in self.components:
            into = next(a for a in self._ordered(arc.start) if (a.index, a.forward) != (arc.index, arc.forward))
            _set(links, "To", self._end(arc.start, into))
            _set(following, "From", self._end(arc.start, arc))
        else:
            reducer = add_item(before, "PipingComponent", self.ids, Term("PipeReducer"))
            add_nodes(reducer, list(sizes), 1, 2)
            _set(links, "To", _End(str(reducer.get("ID")), 1))
            _set(following, "From", _End(str(reducer.get("ID")), 2))
        _connect(before, links)
        return following

    def _pipe(self, segment: ET.Element, arc: Arc, length: float | None, corners: Sequence[Spot], flow: str) -> None:
        pipe = ET.SubElement(segment, "CenterLine", NumPoints=str(len(corners)))
        for x, y in corners:
            ET.SubElement(pipe, "Coordinate", X=f"{x:g}", Y=f"{y:g}", Z="0")
        own = arc.flow if flow == "contradictory" else None
        add_values(pipe, {"Length": length, "Confidence": _word(arc.edge.confidence), "Flow": own}, custom=True)

    def _component(self, place: str, segment: ET.Element) -> None:
        """A valve, junction or end of a line, in the segment that comes to it first; of a valve aside its tee."""
        node = self.network.places[place]
        arcs = self._ordered(place)
        aside = self.network.is_valve(place) and self.network.stands_aside(place)
        if aside:
            term = Term("PipeTee") if len(arcs) == 2 else Term("CustomPipeFitting", f"junction of {len(arcs) + 1}")
        elif self.network.is_gauge(place):
            term = Term("CustomPipeFitting", INSTRUMENT)
        elif isinstance(node, Unit):
            term = term_of_unit(node)
        elif isinstance(node, Terminal):
            term = term_of_terminal(node)
        else:
            term = Term("PipeTee") if len(arcs) == 3 else Term("CustomPipeFitting", f"junction of {len(arcs)}")
        item = self._piece(place, segment, term, named=not aside)
        flow_in, flow_out = _flows(arcs)
        sizes = [_first_size(arc) for arc in arcs] or [None]
        add_nodes(item, [*sizes, None] if aside else sizes, flow_in, flow_out)
        self.components[place] = item
        if aside:
            self.tees[place] = item

    def _piece(self, place: str, segment: ET.Element, term: Term, named: bool = True) -> ET.Element:
        """An item of a segment where a node is; without its tag and id where it isn't the node itself."""
        node = self.network.places[place]
        tag = node.tag if named and isinstance(node, Unit) else None
        item = add_item(segment, "PipingComponent", self.ids, term, tag, node.id if named else None)
        add_values(item, {"PipingComponentName": tag})
        self._add_place(item, place, node.centroid if isinstance(node, Unit) else node.point)
        add_position(item, self.places.spots.get(place))
        return item

    def _branch(self, place: str) -> None:
        """A valve on the side of a run, in a segment of its own that leaves the run at a tee."""
        node, tee = self.network.places[place], self.tees[place]
        assert isinstance(node, Unit)
        segment = self._segment(self._piping_system(), None)
        item = self._piece(place, segment, term_of_unit(node))
        add_nodes(item, [None], 1, None)
        links: dict[str, str] = {}
        _set(links, "From", _End(str(tee.get("ID")), len(self.network.arcs(place)) + 1))
        _set(links, "To", _End(str(item.get("ID")), 1))
        _connect(segment, links)

    def _ordered(self, place: str) -> list[Arc]:
        """The connections of a node in the order of its connection points: what flows in first."""
        rank = {"against": 0, "along": 1, "unknown": 2}
        return sorted(self.network.arcs(place), key=lambda arc: (self.network.is_tap(arc), rank[arc.flow], arc.index))

    def _end(self, place: str, arc: Arc) -> _End:
        numbers = {(a.index, a.forward): i for i, a in enumerate(self._ordered(place), 1)}
        return _End(str(self.components[place].get("ID")), numbers[arc.index, arc.forward])

    # Instruments

    def _instrument(self, place: str) -> None:
        unit = self.network.places[place]
        if not isinstance(unit, Unit):
            return
        term = Term("ProcessInstrumentationFunction")
        item = add_item(self.root, term.name, self.ids, term, unit.tag, unit.id)
        letters = instrument_letters(unit.kind)
        add_values(
            item,
            {
                "ProcessInstrumentationFunctionCategory": letters[0],
                "ProcessInstrumentationFunctions": letters[1:],
                "ProcessInstrumentationFunctionNumber": unit.tag,
            },
        )
        add_values(item, {"Kind": unit.kind}, custom=True)
        self._add_place(item, place, unit.centroid)
        add_position(item, self.places.spots.get(place))
        if place not in self.sensed:
            return
        segment, distance = self.sensed[place]
        signal = Term("ProcessSignalGeneratingFunction")
        sensor = add_item(item, signal.name, self.ids, signal)
        add_values(sensor, {"ProcessSignalGeneratingFunctionNumber": unit.tag, "SensorType": letters[0]})
        add_values(sensor, {"DistanceAlongSegment": distance}, custom=True)
        ET.SubElement(sensor, "Association", Type="is located in", ItemID=str(segment.get("ID")))
        location = ET.Element("Association", Type="is the location of", ItemID=str(sensor.get("ID")))
        segment.insert(len(segment.findall("PersistentID")) + len(segment.findall("GenericAttributes")), location)


def _set(links: dict[str, str], which: str, end: _End) -> None:
    links[f"{which}ID"], links[f"{which}Node"] = end.item, str(end.node)


def _connect(segment: ET.Element, links: dict[str, str]) -> None:
    """What a segment begins and ends at, be it an item of its own or of another."""
    if links:
        ET.SubElement(segment, "Connection", links)


def _flows(arcs: Sequence[Arc]) -> tuple[int | None, int | None]:
    """Numbers of the connection points by which the flow enters and leaves, where that is known."""
    into = next((i for i, arc in enumerate(arcs, 1) if arc.flow == "against"), None)
    out = next((i for i, arc in enumerate(arcs, 1) if arc.flow == "along"), None)
    return into, out


def _first_size(arc: Arc) -> int | None:
    return arc.sizes[0] if arc.sizes else None


def _word(value: float | None) -> str | None:
    return None if value is None else repr(round(value, 6))


def _corners(
    arc: Arc,
    number: int,
    count: int,
    route: tuple[tuple[Spot, ...], tuple[Spot, ...]] | None,
    places: Places,
) -> tuple[Spot, ...]:
    """The corners of one connection on the sheet; none where it is not drawn on its own."""
    spots = places.spots
    start = route[0] if route and number == 0 else tuple(s for s in (spots.get(arc.start),) if s)
    end = route[1] if route and number == count - 1 else tuple(s for s in (spots.get(arc.end),) if s)
    return tuple(dict.fromkeys((*start, *end)))
