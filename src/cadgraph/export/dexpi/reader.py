"""Reads Proteus XML into a graph: equipment, valves, instruments and what joins them."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal
from xml.parsers import expat

from cadgraph._io.limits import DEXPI, read_bytes_within
from cadgraph.errors import FormatError
from cadgraph.export.dexpi.terms import CUSTOM_SET, DEXPI_SET, INSTRUMENT, kind_of, unit_type_of
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import (
    Connected,
    Contains,
    GraphDocument,
    Junction,
    Point,
    Port,
    Site,
    SourceRecord,
    System,
    Terminal,
    Unit,
)

__all__ = ["read_dexpi"]

_LETTERS = {"P": "pressure gauge", "L": "level gauge", "F": "flow meter", "T": "thermometer"}
_THROUGH = frozenset({"PipeReducer"})  # no node of the graph: a change of size in a connection
_ORIGIN: Point = (0.0, 0.0, 0.0)
_Direction = Literal["forward", "backward", "unknown"]
_FLOWS: dict[str, _Direction] = {"along": "forward", "against": "backward"}


def read_dexpi(path: str | Path) -> SceneGraph:
    """Reads the functional graph of a DEXPI file in Proteus XML.

    What cadgraph wrote comes back as it was, without parts and geometry. In files of other tools a segment is taken to
    flow from its source to its target, as DEXPI has it; lengths are then unknown. A document type is refused, so that
    no entity is ever expanded or fetched.

    Args:
        path: the file.

    Returns:
        Units, junctions, terminals, systems and connections.

    Raises:
        FormatError: the file can't be read, is no XML or no PlantModel, or names what it doesn't hold.
    """
    root = _parsed(Path(path))
    return _Reading(root, str(path)).graph()


def _parsed(path: Path) -> ET.Element:
    data = read_bytes_within(path, DEXPI, FormatError, "give a P&ID as Proteus XML, sheet by sheet")

    def refuse(*_: object) -> None:
        raise FormatError(f"{path}: has a document type declaration, which DEXPI doesn't use; remove it")

    scan = expat.ParserCreate()
    scan.StartDoctypeDeclHandler = refuse
    try:
        scan.Parse(data, True)
        root = ET.fromstring(data)
    except (expat.ExpatError, ET.ParseError, ValueError, LookupError) as error:
        raise FormatError(f"{path}: not XML ({error})") from error
    if root.tag != "PlantModel":
        raise FormatError(f"{path}: not Proteus XML (the root is {root.tag!r}, not 'PlantModel')")
    return root


@dataclass
class _Pipe:
    """A stretch between two nodes, as it stands in the file."""

    length: float | None
    size: int | None
    direction: _Direction
    reason: str | None
    confidence: float | None


@dataclass
class _Chain:
    """What follows each other along a segment: nodes, and the pipes between them."""

    nodes: list[str] = field(default_factory=list)
    ports: list[tuple[str | None, str | None]] = field(default_factory=list)
    pipes: list[_Pipe] = field(default_factory=list)


class _Reading:
    def __init__(self, root: ET.Element, where: str) -> None:
        self.root = root
        self.where = where
        self.nodes: dict[str, Unit | Junction | Terminal] = {}
        self.owner: dict[str, tuple[str, str | None]] = {}  # id of an item or nozzle: the node, the port
        self.reducers: set[str] = set()
        self.edges: list[tuple[str, str, str | None, str | None, _Pipe]] = []
        self.systems: dict[str, set[str]] = {}

    def graph(self) -> SceneGraph:
        for item in self.root.iter("Equipment"):
            if item.get("ComponentClass") is not None and item.find("ConnectionPoints") is None:
                self._equipment(item)
        for item in (*self.root.iter("PipingComponent"), *self.root.iter("PipeOffPageConnector")):
            self._component(item)
        for item in self.root.iter("ProcessInstrumentationFunction"):
            self._instrument(item)
        sensors = self._sensors()
        for system in self.root.iter("PipingNetworkSystem"):
            for segment in system.iter("PipingNetworkSegment"):
                self._segment(system, segment, sensors.get(segment.get("ID", ""), []))
        edges = _joined(self.edges, self.reducers)
        used = dict.fromkeys(end for edge in edges for end in (edge.source, edge.target))
        return SceneGraph(
            GraphDocument(
                source=SourceRecord.model_validate({"path": self.where}),
                nodes=(Site(id="site"), *self.nodes.values(), *self._systems(set(used), edges)),
                edges=(*edges, *self._contains(set(used))),
            )
        )

    # Nodes

    def _equipment(self, item: ET.Element) -> None:
        values, custom = _values(item, DEXPI_SET), _values(item, CUSTOM_SET)
        ports = []
        for number, nozzle in enumerate(item.findall("Nozzle"), 1):
            name = _values(nozzle, DEXPI_SET).get("SubTagName")
            ports.append((nozzle.get("ID", ""), name, number))
        name = item.get("ComponentClass", "")
        node = self._unit(
            item,
            unit_type_of(name, "equipment"),
            values.get("TagName") or item.get("TagName"),
            kind_of(name, values.get("TypeName", "")),
            custom,
            tuple(Port(name=name, point=_point(custom)) for _, name, _ in ports if name),
        )
        for nozzle_id, port, _ in ports:
            self.owner[nozzle_id] = node, port

    def _component(self, item: ET.Element) -> None:
        name, key = item.get("ComponentClass", ""), self._id(item)
        values, custom = _values(item, DEXPI_SET), _values(item, CUSTOM_SET)
        what, point = values.get("TypeName", ""), _point(custom)
        if name in _THROUGH:
            self.reducers.add(key)
        elif what == INSTRUMENT:
            self.owner[item.get("ID", "")] = key, None
            return
        elif name == "PipeTee" or what.startswith("junction"):
            self.nodes[key] = Junction(id=key, point=point, parts=())
        elif name == "BlindFlange" or what in ("open end", "end of pipe") or item.tag == "PipeOffPageConnector":
            kind: Literal["open", "blind", "unknown"] = "blind" if name == "BlindFlange" else "unknown"
            self.nodes[key] = Terminal(id=key, kind="open" if what == "open end" else kind, point=point, parts=())
        else:
            tag = values.get("PipingComponentName") or item.get("TagName")
            is_valve = "Valve" in name or name == "CustomSafetyValveOrFitting"
            self._unit(item, "valve" if is_valve else "equipment", tag, kind_of(name, what), custom, ())
        self.owner[item.get("ID", "")] = key, None

    def _instrument(self, item: ET.Element) -> None:
        values, custom = _values(item, DEXPI_SET), _values(item, CUSTOM_SET)
        kind = custom.get("Kind") or _LETTERS.get(values.get("ProcessInstrumentationFunctionCategory", ""))
        tag = item.get("TagName") or values.get("ProcessInstrumentationFunctionNumber")
        # Ours says 'no kind' by leaving it out.
        own = item.find("PersistentID[@Context='cadgraph']") is not None
        self._unit(item, "gauge", tag, custom.get("Kind") if own else kind, custom, ())

    def _unit(
        self,
        item: ET.Element,
        unit_type: str,
        tag: str | None,
        kind: str | None,
        custom: dict[str, str],
        ports: tuple[Port, ...],
    ) -> str:
        key, point = self._id(item), _point(custom)
        self.nodes[key] = Unit(
            id=key,
            unit_type=unit_type,
            tag=tag or key,
            kind=kind,
            parts=(),
            ports=ports,
            centroid=point,
            aabb=(point, point),
        )
        return key

    def _id(self, item: ET.Element) -> str:
        """The graph's own id where the file keeps it, else that of the file."""
        persistent = item.find("PersistentID[@Context='cadgraph']")
        key = persistent.get("Identifier") if persistent is not None else None
        key = key or item.get("ID")
        if not key:
            raise FormatError(f"{self.where}: a {item.tag} of class {item.get('ComponentClass')!r} has no ID")
        return key

    def _sensors(self) -> dict[str, list[tuple[float, str]]]:
        """The instruments on each segment, with their distance along it where the file has it."""
        found: dict[str, list[tuple[float, str]]] = {}
        for item in self.root.iter("ProcessInstrumentationFunction"):
            for sensor in item.iter("ProcessSignalGeneratingFunction"):
                distance = _number(_values(sensor, CUSTOM_SET).get("DistanceAlongSegment"))
                for link in sensor.findall("Association[@Type='is located in']"):
                    found.setdefault(link.get("ItemID", ""), []).append((distance or 0.0, self._id(item)))
        return {segment: sorted(rows) for segment, rows in found.items()}

    # Connections

    def _segment(self, system: ET.Element, segment: ET.Element, sensors: list[tuple[float, str]]) -> None:
        values, custom = _values(segment, DEXPI_SET), _values(segment, CUSTOM_SET)
        size = _number(values.get("NominalDiameterNumericalValueRepresentation"))
        flow = custom.get("Flow")
        direction: _Direction = "unknown" if flow in ("none", "unknown", "contradictory") else "forward"
        reason = _values(system, CUSTOM_SET).get("Reason") if flow else "drawn so in the diagram"
        base = _Pipe(None, int(size) if size else None, direction, reason, None)
        chain = self._chain(segment, base)
        nodes, ports, pipes = _with_sensors(chain, sensors)
        name = _values(system, CUSTOM_SET).get("System")
        for i, pipe in enumerate(pipes):
            self.edges.append((nodes[i], nodes[i + 1], ports[i][1], ports[i + 1][0], pipe))
            if name:
                self.systems.setdefault(name, set()).update((nodes[i], nodes[i + 1]))

    def _chain(self, segment: ET.Element, base: _Pipe) -> _Chain:
        """What a segment names, in its order: source, items, target."""
        links: dict[str, str] = {}
        for link in segment.findall("Connection"):
            for end in ("FromID", "ToID"):
                links.setdefault(end, link.get(end, ""))
        rows: list[tuple[str, str | None] | _Pipe] = []
        own = {item.get("ID") for item in segment if item.tag in ("PipingComponent", "PipeOffPageConnector")}
        if links.get("FromID") and links["FromID"] not in own:
            rows.append(self._owner(links["FromID"]))
        for item in segment:
            if item.tag in ("PipingComponent", "PipeOffPageConnector"):
                rows.append(self._owner(item.get("ID", "")))
            elif item.tag == "CenterLine":
                more = _values(item, CUSTOM_SET)
                length, sure = _number(more.get("Length")), _number(more.get("Confidence"))
                rows.append(
                    _Pipe(length, base.size, _FLOWS.get(more.get("Flow", ""), base.direction), base.reason, sure)
                )
        target = links.get("ToID")
        if target and (target not in own or (rows and rows[-1:] and isinstance(rows[-1], _Pipe))):
            rows.append(self._owner(target))
        return _as_chain(rows, base)

    def _owner(self, key: str) -> tuple[str, str | None]:
        try:
            return self.owner[key]
        except KeyError:
            raise FormatError(f"{self.where}: a connection names {key!r}, but no item has that ID") from None

    # Systems

    def _systems(self, used: set[str], edges: list[Connected]) -> list[System]:
        made = []
        for name, members in sorted(self.systems.items()):
            own = [edge for edge in edges if edge.source in members and edge.target in members]
            lengths = [edge.length for edge in own if edge.length is not None]
            kinds = [
                tuple(key for key, node in self.nodes.items() if key in members & used and isinstance(node, kind))
                for kind in (Unit, Junction, Terminal)
            ]
            made.append(
                System(
                    id=name,
                    units=kinds[0],
                    junctions=kinds[1],
                    terminals=kinds[2],
                    length=sum(lengths) if lengths else None,
                    sizes=tuple(sorted({edge.size for edge in own if edge.size})),
                )
            )
        return made

    def _contains(self, used: set[str]) -> list[Contains]:
        return [
            Contains(source=name, target=key)
            for name, members in sorted(self.systems.items())
            for key, node in self.nodes.items()
            if key in members & used and isinstance(node, Unit)
        ]


def _as_chain(rows: list[tuple[str, str | None] | _Pipe], base: _Pipe) -> _Chain:
    """Nodes and pipes in turn; an end that the file leaves open is an empty name."""
    chain = _Chain()
    for row in rows:
        if isinstance(row, _Pipe):
            if len(chain.pipes) == len(chain.nodes):
                chain.nodes.append("")
                chain.ports.append((None, None))
            chain.pipes.append(row)
        else:
            if len(chain.nodes) > len(chain.pipes):
                chain.pipes.append(_Pipe(None, base.size, base.direction, base.reason, None))
            chain.nodes.append(row[0])
            chain.ports.append((row[1], row[1]))
    if chain.pipes and len(chain.pipes) == len(chain.nodes):
        chain.nodes.append("")
        chain.ports.append((None, None))
    return chain


def _with_sensors(
    chain: _Chain, sensors: list[tuple[float, str]]
) -> tuple[list[str], list[tuple[str | None, str | None]], list[_Pipe]]:
    """The chain with its instruments at their distances; each splits the pipe that it stands on."""
    nodes, ports, pipes = chain.nodes[:1], chain.ports[:1], []
    waiting = list(sensors)
    gone = 0.0
    return_nodes = nodes
    if waiting and nodes[:1] == [""]:
        nodes[0] = waiting.pop(0)[1]
    for i, pipe in enumerate(chain.pipes):
        last = i == len(chain.pipes) - 1
        end, length = chain.nodes[i + 1], pipe.length
        while waiting and (last or (length is not None and waiting[0][0] < gone + length - 1e-9)):
            if last and len(waiting) == 1 and end == "":
                break
            distance, name = waiting.pop(0)
            part = None if length is None else min(max(distance - gone, 0.0), length)
            pipes.append(_Pipe(part, pipe.size, pipe.direction, pipe.reason, pipe.confidence))
            nodes.append(name)
            ports.append((None, None))
            if length is not None and part is not None:
                length, gone = length - part, gone + part
        if end == "" and waiting:
            end = waiting.pop(0)[1]
        gone += length or 0.0
        if end == "":
            continue
        pipes.append(_Pipe(length, pipe.size, pipe.direction, pipe.reason, pipe.confidence))
        nodes.append(end)
        ports.append(chain.ports[i + 1])
    return return_nodes, ports, pipes


def _joined(edges: list[tuple[str, str, str | None, str | None, _Pipe]], reducers: set[str]) -> list[Connected]:
    """Connections with those on either side of a reducer made one."""
    found: list[Connected] = []
    open_at: dict[str, int] = {}
    for source, target, source_port, target_port, pipe in edges:
        if source == "":
            continue
        size = pipe.size
        edge = Connected(
            source=source,
            target=target,
            length=pipe.length,
            size=size,
            diameter=size / 1000 if size else None,
            source_port=source_port,
            target_port=target_port,
            direction=pipe.direction,
            reason=pipe.reason if pipe.direction != "unknown" else None,
            confidence=pipe.confidence,
        )
        if source in open_at:
            before = found[open_at.pop(source)]
            edge = _merged(before, edge)
            found[found.index(before)] = edge
        else:
            found.append(edge)
        if target in reducers:
            open_at[target] = found.index(edge)
    return [edge for edge in found if edge.target not in reducers and edge.source not in reducers]


def _merged(before: Connected, after: Connected) -> Connected:
    lengths = [length for length in (before.length, after.length) if length is not None]
    sizes = [*(before.sizes or (before.size,)), after.size]
    kept = [size for size in sizes if size is not None]
    longer = before if (before.length or 0.0) >= (after.length or 0.0) else after
    return before.model_copy(
        update={
            "target": after.target,
            "target_port": after.target_port,
            "length": sum(lengths) if lengths else None,
            "size": longer.size,
            "diameter": longer.diameter,
            "sizes": tuple(kept),
        }
    )


def _values(item: ET.Element, name: str) -> dict[str, str]:
    """The attributes of a set, without the ending of DEXPI's names."""
    return {
        row.get("Name", "").removesuffix("AssignmentClass"): row.get("Value", "")
        for group in item.findall("GenericAttributes")
        if group.get("Set") == name
        for row in group.findall("GenericAttribute")
    }


def _number(text: str | None) -> float | None:
    try:
        return float(text) if text else None
    except ValueError:
        return None


def _point(custom: dict[str, str]) -> Point:
    x, y, z = (_number(custom.get(name)) for name in "XYZ")
    return _ORIGIN if x is None or y is None or z is None else (x, y, z)
