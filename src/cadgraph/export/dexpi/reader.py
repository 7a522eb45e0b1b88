"""Reads Proteus XML into a graph: equipment, valves, instruments and what joins them."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Literal
from xml.parsers import expat

from cadgraph._io.limits import DEXPI, read_bytes_within
from cadgraph.errors import FormatError
from cadgraph.export.dexpi.chain import Chain, Direction, Pipe, as_chain, join_through, with_sensors
from cadgraph.export.dexpi.terms import CUSTOM_SET, DEXPI_SET, INSTRUMENT, kind_of, unit_type_of
from cadgraph.model.diagnostic import Diagnostic
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
from cadgraph.query.network import DRAWN_FROM_DOUBT

__all__ = ["read_dexpi"]

# Pieces of pipe that are no unit in a plant's graph: a change of size, and what only joins pipe to pipe.
_THROUGH = frozenset(
    {
        "PipeReducer", "PropertyBreak", "Flange", "FlangedConnection", "ClampedFlangeCoupling", "PipeCoupling",
        "PipeFlangeSpacer", "PipeFlangeSpade", "Compensator", "Hose", "Penetration", "LineBlind", "RestrictionOrifice",
        "FlowNozzle", "PipeFitting", "DirectPipingConnection", "CustomPipingComponent",
    }
)  # fmt: skip
# What measures the flow in a line, as DEXPI's classes are called.
_METERS = ("FlowMeter", "FlowDetector", "FlowMeasuringElement", "VenturiTube", "OrificePlate")
_ITEMS = ("PipingComponent", "PipeOffPageConnector", "PropertyBreak")  # that stand in a segment
_MOST_TOLD = 5  # ids that a finding names

_SKIPPED = {
    "no-id": "items without an ID are left out",
    "tag-twice": "tags are used more than once; later ones get their ID behind them",
    "unknown-end": "connections end at something that the file doesn't hold; taken for ends of pipes",
    "no-ends": "segments join nothing",
    "somewhere": "instruments are located in a segment of several items, where in it the file does not say; what is "
    "beside them here, and their order, are not the drawing's",
    "doubtful": "places at which more may be joined than the file says: the graph that it was written from tells what",
}

_LETTERS = {"P": "pressure gauge", "L": "level gauge", "F": "flow meter", "T": "thermometer"}
_ORIGIN: Point = (0.0, 0.0, 0.0)
_FLOWS: dict[str, Direction] = {"along": "forward", "against": "backward"}


def read_dexpi(path: str | Path) -> SceneGraph:
    """Reads the functional graph of a DEXPI file in Proteus XML.

    What cadgraph wrote comes back as it was, without parts and geometry. In files of other tools a segment is taken to
    flow from its source to its target, as DEXPI has it; lengths are then unknown, flanges and other fittings that only
    join pipes are passed over. What can't be understood is skipped and reported in the graph's diagnostics. A document
    type is refused, so that no entity is ever expanded or fetched.

    Args:
        path: the file.

    Returns:
        Units, junctions, terminals, systems and connections.

    Raises:
        FormatError: the file can't be read, is too large, no XML or no PlantModel.
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
    # Some tools give all elements a namespace, each its own.
    for element in root.iter():
        element.tag = element.tag.rpartition("}")[2]
    if root.tag != "PlantModel":
        raise FormatError(
            f"{path}: not Proteus XML (the root is {root.tag!r:.60}, not 'PlantModel'); export the P&ID as Proteus XML "
            "4 or DEXPI 1.3"
        )
    return root


class _Reading:
    def __init__(self, root: ET.Element, where: str) -> None:
        self.root = root
        self.where = where
        self.nodes: dict[str, Unit | Junction | Terminal] = {}
        self.owner: dict[str, tuple[str, str | None]] = {}  # id of an item or nozzle: the node, the port
        self.through: dict[str, None] = {}  # items that are no node, by id
        self.edges: list[tuple[str, str, str | None, str | None, Pipe]] = []
        self.systems: dict[str, set[str]] = {}
        self.skipped: dict[str, list[str]] = {}
        self.tags: set[str] = set()
        self.somewhere: set[str] = set()  # instruments of which the file says no place along their segment
        self.doubtful: dict[str, None] = {}  # ids of nodes at which the plant was doubtful

    def graph(self) -> SceneGraph:
        self._items()
        sensors = self._sensors()
        for system in self.root.iter("PipingNetworkSystem"):
            for segment in system.iter("PipingNetworkSegment"):
                self._segment(system, segment, sensors.get(segment.get("ID", ""), []))
        edges, others = join_through(self.edges, self.through)
        for name, count in others.items():
            kind = Junction if count > 1 else Terminal
            self.nodes[name] = kind(id=name, point=_ORIGIN, parts=())
        used = dict.fromkeys(end for edge in edges for end in (edge.source, edge.target))
        return SceneGraph(
            GraphDocument(
                source=SourceRecord.model_validate({"path": self.where}),
                nodes=(Site(id="site"), *self.nodes.values(), *self._systems(set(used), edges)),
                edges=(*edges, *self._contains(set(used))),
                diagnostics=tuple(
                    Diagnostic(f"dexpi-{code}", _told(code, names)) for code, names in self.skipped.items()
                )
                + self._doubts(),
            )
        )

    def _doubts(self) -> tuple[Diagnostic, ...]:
        """Where the plant that the file was written from may go on although the file says nothing of it."""
        doubtful = tuple(name for name in self.doubtful if name in self.nodes)
        if not doubtful:
            return ()
        names = [node.tag if isinstance(node := self.nodes[name], Unit) else name for name in doubtful]
        return (Diagnostic(DRAWN_FROM_DOUBT, _told("doubtful", names), doubtful),)

    def _items(self) -> None:
        """All that can be a node."""
        # Shapes look like the items that they are drawn for.
        for above in list(self.root.iter()):
            for shapes in above.findall("ShapeCatalogue"):
                above.remove(shapes)
        nested: set[int] = set()
        for item in self.root.iter("Equipment"):
            if id(item) not in nested:
                nested.update(id(inner) for inner in item.iter("Equipment"))
                if self._is_item(item):
                    self._equipment(item)
        for tag in _ITEMS:
            for item in filter(self._is_item, self.root.iter(tag)):
                self._component(item)
        for item in filter(self._is_item, self.root.iter("ProcessInstrumentationFunction")):
            self._instrument(item)

    def _is_item(self, item: ET.Element) -> bool:
        """Whether an element can be a node; what has no id can't be joined to anything."""
        if item.get("ID") or item.find("PersistentID[@Context='cadgraph']") is not None:
            return True
        self.skipped.setdefault("no-id", []).append(item.get("TagName") or item.get("ComponentClass") or item.tag)
        return False

    # Nodes

    def _equipment(self, item: ET.Element) -> None:
        values, custom = _values(item, DEXPI_SET), _values(item, CUSTOM_SET)
        ports = [
            (nozzle.get("ID", ""), _values(nozzle, DEXPI_SET).get("SubTagName") or nozzle.get("TagName"))
            for nozzle in item.iter("Nozzle")
        ]
        name = item.get("ComponentClass", "")
        node = self._unit(
            item,
            unit_type_of(name, "equipment"),
            values.get("TagName") or item.get("TagName"),
            kind_of(name, values.get("TypeName", "")),
            custom,
            tuple(Port(name=name, point=_point(custom)) for name in dict.fromkeys(port for _, port in ports) if name),
        )
        self._note(node, custom)
        # Chambers and bundles are equipment within equipment; pipes may end at them, too.
        for part in item.iter("Equipment"):
            self.owner[part.get("ID", "")] = node, None
        for nozzle_id, port in ports:
            self.owner[nozzle_id] = node, port

    def _component(self, item: ET.Element) -> None:
        name, key = item.get("ComponentClass", ""), self._id(item)
        values, custom = _values(item, DEXPI_SET), _values(item, CUSTOM_SET)
        self._note(key, custom)
        what, point = values.get("TypeName", ""), _point(custom)
        if name in _THROUGH or item.tag == "PropertyBreak":
            self.through[key] = None
        elif what == INSTRUMENT:
            self.owner[item.get("ID", "")] = key, None
            return
        elif name == "PipeTee" or what.startswith("junction"):
            self.nodes[key] = Junction(id=key, point=point, parts=())
        elif name == "BlindFlange" or what in ("open end", "end of pipe") or item.tag == "PipeOffPageConnector":
            ending: Literal["open", "blind", "unknown"] = "blind" if name == "BlindFlange" else "unknown"
            self.nodes[key] = Terminal(id=key, kind="open" if what == "open end" else ending, point=point, parts=())
        else:
            self._in_line(item, values, custom)
        self.owner[item.get("ID", "")] = key, None

    def _in_line(self, item: ET.Element, values: dict[str, str], custom: dict[str, str]) -> None:
        """A valve, a meter, or another device that stands in a line."""
        name, tag = item.get("ComponentClass", ""), values.get("PipingComponentName") or item.get("TagName")
        kind = kind_of(name, values.get("TypeName", ""))
        if "Valve" in name:
            self._unit(item, "valve", tag, kind, custom, ())
        elif any(word in name for word in _METERS):
            self._unit(item, "gauge", tag, kind or "flow meter", custom, ())
        else:
            self._unit(item, "equipment", tag, kind, custom, ())

    def _instrument(self, item: ET.Element) -> None:
        values, custom = _values(item, DEXPI_SET), _values(item, CUSTOM_SET)
        kind = custom.get("Kind") or _LETTERS.get(values.get("ProcessInstrumentationFunctionCategory", ""))
        tag = item.get("TagName") or values.get("ProcessInstrumentationFunctionNumber")
        # Ours says 'no kind' by leaving it out.
        own = item.find("PersistentID[@Context='cadgraph']") is not None
        self._note(self._unit(item, "gauge", tag, custom.get("Kind") if own else kind, custom, ()), custom)

    def _note(self, name: str, custom: dict[str, str]) -> None:
        if custom.get("Doubtful"):
            self.doubtful[name] = None

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
        tag = tag or key
        if tag in self.tags:
            self.skipped.setdefault("tag-twice", []).append(tag)
            tag = f"{tag} ({item.get('ID', key)})"
        self.tags.add(tag)
        self.nodes[key] = Unit(
            id=key,
            unit_type=unit_type,
            tag=tag,
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
                distance, name = _number(_values(sensor, CUSTOM_SET).get("DistanceAlongSegment")), self._id(item)
                if distance is None:
                    self.somewhere.add(name)
                for link in sensor.findall("Association[@Type='is located in']"):
                    found.setdefault(link.get("ItemID", ""), []).append((distance or 0.0, name))
        return {segment: sorted(rows) for segment, rows in found.items()}

    # Connections

    def _segment(self, system: ET.Element, segment: ET.Element, sensors: list[tuple[float, str]]) -> None:
        values, custom = _values(segment, DEXPI_SET), _values(segment, CUSTOM_SET)
        size = _number(values.get("NominalDiameterNumericalValueRepresentation"))
        flow = custom.get("Flow")
        direction: Direction = "unknown" if flow in ("none", "unknown", "contradictory") else "forward"
        reason = _values(system, CUSTOM_SET).get("Reason") if flow else "drawn so in the diagram"
        base = Pipe(None, int(size) if size else None, direction, reason, None)
        name = _values(system, CUSTOM_SET).get("System")
        for number, chain in enumerate(self._chains(segment, base)):
            # Which of several chains in one segment an instrument stands on, nobody says.
            nodes, ports, pipes = with_sensors(chain, sensors if number == 0 else [])
            if number == 0 and len(chain.pipes) > 1:
                for node in [self.nodes[name] for _, name in sensors if name in self.somewhere]:
                    self.skipped.setdefault("somewhere", []).append(node.tag if isinstance(node, Unit) else node.id)
            if not pipes:
                self.skipped.setdefault("no-ends", []).append(segment.get("ID", "?"))
            for i, pipe in enumerate(pipes):
                self.edges.append((nodes[i], nodes[i + 1], ports[i][1], ports[i + 1][0], pipe))
                if name:
                    self.systems.setdefault(name, set()).update((nodes[i], nodes[i + 1]))

    def _chains(self, segment: ET.Element, base: Pipe) -> list[Chain]:
        """What follows each other in a segment: as its connections have it where there are several, else in order."""
        links = [link for link in segment.findall("Connection") if link.get("FromID") and link.get("ToID")]
        if len(links) < 2:
            return [self._chain(segment, base)]
        # Other tools name each connection from one item to the next.
        chains: list[Chain] = []
        for link in links:
            start, end = self._owner(link.get("FromID", "")), self._owner(link.get("ToID", ""))
            if not chains or chains[-1].nodes[-1] != start[0]:
                chains.append(Chain([start[0]], [(start[1], start[1])]))
            chains[-1].nodes.append(end[0])
            chains[-1].ports.append((end[1], end[1]))
            chains[-1].pipes.append(Pipe(None, base.size, base.direction, base.reason, None))
        return chains

    def _chain(self, segment: ET.Element, base: Pipe) -> Chain:
        """What a segment names, in its order: source, items, target."""
        links: dict[str, str] = {}
        for link in segment.findall("Connection"):
            for end in ("FromID", "ToID"):
                links.setdefault(end, link.get(end, ""))
        rows: list[tuple[str, str | None] | Pipe] = []
        own = {item.get("ID") for item in segment if item.tag in _ITEMS and item.get("ID") in self.owner}
        if links.get("FromID") and links["FromID"] not in own:
            rows.append(self._owner(links["FromID"]))
        for item in segment:
            if item.tag in _ITEMS and item.get("ID") in own:
                rows.append(self._owner(item.get("ID", "")))
            elif item.tag == "CenterLine":
                more = _values(item, CUSTOM_SET)
                length, sure = _number(more.get("Length")), _number(more.get("Confidence"))
                rows.append(
                    Pipe(length, base.size, _FLOWS.get(more.get("Flow", ""), base.direction), base.reason, sure)
                )
        target = links.get("ToID")
        if target and (target not in own or (rows and rows[-1:] and isinstance(rows[-1], Pipe))):
            rows.append(self._owner(target))
        return as_chain(rows, base)

    def _owner(self, key: str) -> tuple[str, str | None]:
        """The node, and its port, that an id in a connection stands for; an end of pipe where the file holds none."""
        if key not in self.owner:
            # A connection may name a node of an item, or what the file left out.
            self.skipped.setdefault("unknown-end", []).append(key)
            self.nodes[f"end-{key}"] = Terminal(id=f"end-{key}", kind="unknown", point=_ORIGIN, parts=())
            self.owner[key] = f"end-{key}", None
        return self.owner[key]

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


def _told(code: str, names: list[str]) -> str:
    """A finding in words: how many, and the first of them."""
    shown = ", ".join(dict.fromkeys(names[:_MOST_TOLD])) + (" and others" if len(names) > _MOST_TOLD else "")
    return f"{len(names)} {_SKIPPED[code]}: {shown}"


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
        value = float(text) if text else None
    except ValueError:
        return None
    return value if value is not None and math.isfinite(value) else None


def _point(custom: dict[str, str]) -> Point:
    x, y, z = (_number(custom.get(name)) for name in "XYZ")
    return _ORIGIN if x is None or y is None or z is None else (x, y, z)
