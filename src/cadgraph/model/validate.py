"""Whether a graph agrees with itself, beyond the types of its records."""

from __future__ import annotations

import reprlib
from collections.abc import Iterable, Mapping
from typing import Any

from pydantic import ValidationError

from cadgraph._io.text import natural_order
from cadgraph._io.validation_messages import expectation
from cadgraph.errors import FormatError
from cadgraph.model.records import (
    Adjacent,
    Cluster,
    Connected,
    Contains,
    Edge,
    GraphDocument,
    Joint,
    Junction,
    Node,
    Part,
    Place,
    Related,
    Site,
    Stated,
    System,
    Terminal,
    Unit,
)

__all__ = ["check_document", "check_names", "what_is_wrong"]

_MOST_SQUARES = 1 << 24  # of a floor; a short list of runs may claim any number

_MAY_JOIN = {
    (kind, above, below)
    for kind, sources, targets in (
        ("contains", (Site,), (Cluster, Part, Unit, Junction, Terminal, System)),
        ("contains", (Cluster, Unit), (Part,)),
        ("contains", (System,), (Unit, Junction, Terminal)),
        ("contains", (Place,), (Unit,)),
        ("adjacent", (Part,), (Part,)),
        ("connected", (Unit, Junction, Terminal), (Unit, Junction, Terminal)),
        ("related", (Unit,), (Unit,)),
        ("reached_from", (Place,), (Place,)),
    )
    for above in sources
    for below in targets
}
"""Kinds of edges with the layers that they may join, source and target."""


def check_names(document: GraphDocument) -> dict[str, Node]:
    """Makes sure that each node has an id of its own, each edge two ends, and that there is one site.

    Args:
        document: the content of a graph.

    Returns:
        The nodes by id.

    Raises:
        FormatError: it isn't so.
    """
    nodes: dict[str, Node] = {node.id: node for node in document.nodes}
    if len(nodes) != len(document.nodes):
        raise FormatError(f"node id {_first_repeat(node.id for node in document.nodes)!r} is used twice")
    sites = [node for node in document.nodes if isinstance(node, Site)]
    if len(sites) != 1:
        raise FormatError(f"a graph needs exactly one node of layer 'site', found {len(sites)}")
    for edge in document.edges:
        for end in (edge.source, edge.target):
            if end not in nodes:
                raise FormatError(f"a {edge.kind!r} edge names {end!r}, but no node has that id")
    return nodes


def check_document(document: GraphDocument) -> None:
    """Makes sure that nothing is there twice, that all that is named exists, and that edges join what they can join.

    Args:
        document: the content of a graph.

    Raises:
        FormatError: a node id, a mesh, a tag, a contact or a relation is there twice; an edge or node names what isn't
            there or is of the wrong layer; a contact has the wrong order; there isn't exactly
            one site.
    """
    nodes = check_names(document)
    _check_edges(document.edges, nodes)
    _check_nodes(document.nodes, nodes)
    _check_joints(document.joints, nodes)
    _check_stated(document.stated, nodes)


def _check_edges(edges: Iterable[Edge], nodes: Mapping[str, Node]) -> None:
    seen: set[tuple[str, str, str]] = set()
    home: dict[tuple[str, str], str] = {}
    names = list(nodes)
    place = {names[k]: place for place, k in enumerate(natural_order(names))}
    for edge in edges:
        source, target = edge.source, edge.target
        ends = nodes[source], nodes[target]
        if (edge.kind, type(ends[0]), type(ends[1])) not in _MAY_JOIN:
            raise FormatError(f"{_in_words(edge)} joins a {ends[0].layer} with a {ends[1].layer}, which it can't")
        if isinstance(edge, Connected):
            _check_known(edge.via, Part, nodes, _in_words(edge))
            continue
        if source == target:
            raise FormatError(f"{_in_words(edge)} ends where it starts")
        # A relation has no direction; two connections may join the same two units, by two pipes.
        first, last = sorted((source, target)) if isinstance(edge, Related) else (source, target)
        key = (edge.kind, first, last)
        if key in seen:
            raise FormatError(f"{_in_words(edge)} is there twice")
        seen.add(key)
        if isinstance(edge, Adjacent):
            if place[source] > place[target]:
                raise FormatError(f"{_in_words(edge)} is the wrong way round: its source must come before its target")
        elif isinstance(edge, Contains) and not isinstance(ends[0], Site):
            other = home.setdefault((ends[0].layer, target), source)
            if other != source:
                raise FormatError(f"{target!r} is in two nodes of layer {ends[0].layer!r}: {other!r} and {source!r}")


def _in_words(edge: Edge) -> str:
    return f"the {edge.kind!r} edge from {edge.source!r} to {edge.target!r}"


def _check_nodes(listed: Iterable[Node], nodes: Mapping[str, Node]) -> None:
    part_of_mesh: dict[str, str] = {}
    unit_of_tag: dict[str, str] = {}
    unit_of_part: dict[str, str] = {}
    for node in listed:
        here = f"{node.layer} {node.id!r}"
        if isinstance(node, Part):
            for mesh in node.meshes:
                if part_of_mesh.setdefault(mesh, node.id) != node.id:
                    raise FormatError(f"mesh {mesh!r} is in two parts: {part_of_mesh[mesh]!r} and {node.id!r}")
            _check_known((node.inside,) if node.inside is not None else (), Part, nodes, here)
        elif isinstance(node, Unit):
            if unit_of_tag.setdefault(node.tag, node.id) != node.id:
                raise FormatError(f"tag {node.tag!r} is used by two units: {unit_of_tag[node.tag]!r} and {node.id!r}")
            _check_known(node.parts, Part, nodes, here)
            for part in node.parts:
                if unit_of_part.setdefault(part, node.id) != node.id:
                    raise FormatError(f"part {part!r} is in two units: {unit_of_part[part]!r} and {node.id!r}")
            place = node.access.place if node.access is not None else None
            _check_known(() if place is None else (place,), Place, nodes, here)
        elif isinstance(node, Junction | Terminal):
            _check_known(node.parts, Part, nodes, here)
        elif isinstance(node, Place):
            _check_known(node.parts, Part, nodes, here)
            _check_floor(node, here)
        elif isinstance(node, System):
            _check_known(node.units, Unit, nodes, here)
            _check_known(node.junctions, Junction, nodes, here)
            _check_known(node.terminals, Terminal, nodes, here)


def _check_floor(place: Place, here: str) -> None:
    floor = place.floor
    if floor is None:
        return
    columns, rows = floor.size
    if columns * rows > _MOST_SQUARES:
        raise FormatError(f"{here} has a floor of {columns:,} x {rows:,} squares; at most {_MOST_SQUARES:,} are read")
    if min(floor.size) < 0 or floor.step <= 0 or min(floor.runs, default=0) < 0 or sum(floor.runs) != columns * rows:
        raise FormatError(f"{here} has a floor whose runs don't make up its {columns} x {rows} squares")


def _check_joints(joints: Iterable[Joint], nodes: Mapping[str, Node]) -> None:
    for joint in joints:
        here = f"the {joint.kind!r} joint of {joint.first!r} and {joint.second!r}"
        # A part may join itself: what a mesh holds may be several pieces of pipe.
        _check_known((joint.first, joint.second), Part, nodes, here)


def _check_stated(links: Iterable[Stated], nodes: Mapping[str, Node]) -> None:
    for link in links:
        here = f"the stated link from {link.first_path!r} to {link.second_path!r}"
        _check_known((*link.first, *link.second), Part, nodes, here)


def _check_known(names: Iterable[str], layer: type[Any], nodes: Mapping[str, Node], here: str) -> None:
    for name in names:
        if not isinstance(nodes.get(name), layer):
            raise FormatError(f"{here} names {name!r}, but no {layer.__name__.lower()} has that id")


def _first_repeat(names: Iterable[str]) -> str:
    seen: set[str] = set()
    for name in names:
        if name in seen:
            return name
        seen.add(name)
    return ""


def what_is_wrong(error: ValidationError, data: Mapping[str, Any]) -> str:
    """The first fault of a document, with the id of its node, the ends of its edge or link, or the parts of its joint.

    Args:
        error: of reading the document.
        data: the document as it was read.
    """
    fault = error.errors()[0]
    steps = list(fault["loc"])
    place = ".".join(str(step) for step in steps)
    if len(steps) < 2 or steps[0] not in ("nodes", "edges", "joints", "stated") or not isinstance(steps[1], int):
        return f"{place} {expectation(fault)}"
    called = _called(str(steps[0]), data[str(steps[0])][steps[1]])
    return f"{f'{called} ({place})' if called else place} {expectation(fault)}"


def _called(key: str, row: object) -> str:
    """What a row of a document is called by, as far as it says."""
    if not isinstance(row, Mapping):
        return ""
    told = {name: reprlib.repr(value) for name, value in row.items()}
    if key == "nodes":
        return f"node {told['id']}" if row.get("id") is not None else ""
    if key == "stated":
        return f"link {told['first_path']} - {told.get('second_path', 'None')}" if "first_path" in told else ""
    ends = ("source", "target") if key == "edges" else ("first", "second")
    if row.get(ends[0]) is None:
        return ""
    names = [told.get(name, "None") for name in ("kind", *ends)]
    if key == "edges":
        return f"edge {names[0]} from {names[1]} to {names[2]}"
    return f"joint {names[0]} of {names[1]} and {names[2]}"
