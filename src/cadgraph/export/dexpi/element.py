"""Pieces of Proteus XML: ids, attributes, positions, connection points."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Mapping

from cadgraph._io.text import xml_text
from cadgraph.export.dexpi.terms import CUSTOM_SET, DEXPI_SET, URIS, Term

__all__ = ["Ids", "add_item", "add_nodes", "add_position", "add_values", "diameter_values"]


class Ids:
    """Ids that are unique in a document: the class and a number, as DEXPI's own examples have them."""

    def __init__(self) -> None:
        self._used: Counter[str] = Counter()

    def new(self, name: str) -> str:
        """The next id of a class."""
        self._used[name] += 1
        return f"{name}-{self._used[name]}"


def add_item(
    above: ET.Element, tag: str, ids: Ids, term: Term, name: str | None = None, origin: str | None = None
) -> ET.Element:
    """A plant item of a class.

    Args:
        above: what it stands in.
        tag: the element's name (``Equipment``, ``PipingComponent``...).
        ids: of the document.
        term: its class.
        name: its tag.
        origin: its id in the graph, kept as a persistent id.
    """
    item = ET.SubElement(above, tag, ID=ids.new(term.name), ComponentClass=term.name)
    if term.name in URIS:
        item.set("ComponentClassURI", URIS[term.name])
    if name is not None:
        item.set("TagName", xml_text(name))
    if origin is not None:
        ET.SubElement(item, "PersistentID", Identifier=xml_text(origin), Context="cadgraph")
    if term.custom:
        add_values(item, {"TypeName": term.custom})
    return item


def add_values(item: ET.Element, values: Mapping[str, str | float | int | None], *, custom: bool = False) -> None:
    """Attributes of an item: DEXPI's own (``TagName`` for ``TagNameAssignmentClass``), or custom ones.

    Args:
        item: that has them.
        values: by name; None is left out. Custom numbers are metres.
        custom: whether they are cadgraph's own.
    """
    name = CUSTOM_SET if custom else DEXPI_SET
    found = next((group for group in item.findall("GenericAttributes") if group.get("Set") == name), None)
    known = {key: value for key, value in values.items() if value is not None}
    if not known:
        return
    if found is None:
        found = ET.SubElement(item, "GenericAttributes", Set=name)
    for key, value in known.items():
        number = isinstance(value, (int, float))
        row = ET.SubElement(found, "GenericAttribute", Name=key if custom else f"{key}AssignmentClass")
        row.set("Format", "double" if number else "string")
        row.set("Value", repr(round(float(value), 9) + 0.0) if number else xml_text(str(value)))
        if number and custom:
            row.set("Units", "Metre")
    found.set("Number", str(len(found)))


def add_position(item: ET.Element, spot: tuple[float, float] | None) -> None:
    """Where an item is on the sheet [mm]."""
    if spot is None:
        return
    position = ET.SubElement(item, "Position")
    ET.SubElement(position, "Location", X=f"{spot[0]:g}", Y=f"{spot[1]:g}", Z="0")
    ET.SubElement(position, "Axis", X="0", Y="0", Z="1")
    ET.SubElement(position, "Reference", X="1", Y="0", Z="0")


def add_nodes(item: ET.Element, sizes: list[int | None], flow_in: int | None, flow_out: int | None) -> None:
    """The connection points of an item: one for the symbol's own origin, by DEXPI's habit, and one for each pipe.

    Args:
        item: that has them.
        sizes: nominal size (DN) of the pipe at each.
        flow_in: number of the point that the flow enters by, from 1.
        flow_out: number of the point that it leaves by.
    """
    points = ET.SubElement(item, "ConnectionPoints", NumPoints=str(len(sizes) + 1))
    if flow_in is not None:
        points.set("FlowIn", str(flow_in))
    if flow_out is not None:
        points.set("FlowOut", str(flow_out))
    ET.SubElement(points, "Node", ID=f"{item.get('ID')}-node-0")
    for number, size in enumerate(sizes, 1):
        node = ET.SubElement(points, "Node", ID=f"{item.get('ID')}-node-{number}", Type="process")
        add_values(node, diameter_values(size))


def diameter_values(size: int | None) -> dict[str, str | float | int | None]:
    """A nominal size in DEXPI's three attributes."""
    if size is None:
        return {}
    return {
        "NominalDiameterRepresentation": f"DN {size}",
        "NominalDiameterNumericalValueRepresentation": str(size),
        "NominalDiameterTypeRepresentation": "DN",
    }
