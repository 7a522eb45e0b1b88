"""Which elements a model says are joined, through their ports or directly."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterator
from typing import Literal, NamedTuple

from cadgraph._io.text import natural_key
from cadgraph.load.ifc.entities import Entity, Model, entities, of_type, text
from cadgraph.load.ifc.tree import Tree
from cadgraph.load.packing import Notes
from cadgraph.model.facts import StatedLink

__all__ = ["stated_links"]

_Flow = Literal["forward", "backward", "unknown"]
_TURNED: dict[_Flow, _Flow] = {"forward": "backward", "backward": "forward", "unknown": "unknown"}
_PORTS, _DIRECT = "IfcRelConnectsPorts", "IfcRelConnectsElements"
# Walls and beams are joined too, but nothing flows there.
_PLANT = ("IfcDistributionElement", "IfcBuildingElementProxy", "IfcElementAssembly", "IfcProxy")


class _Joined(NamedTuple):
    """Two elements by their numbers."""

    first: int
    second: int
    flow: _Flow
    where: str


def stated_links(model: Model, tree: Tree, shown: Collection[str], notes: Notes) -> list[StatedLink]:
    """The links between elements that have a mesh, or stand above one.

    An element without any mesh that joins just two others (a gasket that is only listed) is passed over: these two
    are linked. Other links of such elements are left out (``open-link``).

    Args:
        model: an open file.
        tree: of its nodes.
        shown: paths of the meshes and of the nodes above them.
        notes: gets what is left out.

    Returns:
        One link for two elements and one kind of relation, sorted by path; both directions at once are unknown.
    """
    joined = _merged([*_by_ports(model), *_direct(model)])
    kept = _without_bare(joined, {i for i, path in tree.paths.items() if path in shown}, tree, notes)
    links = []
    for first, second, flow, where in kept:
        a, b = tree.paths[first], tree.paths[second]
        turned = natural_key(b) < natural_key(a)
        links.append(StatedLink(b, a, _TURNED[flow], where) if turned else StatedLink(a, b, flow, where))
    return sorted(links, key=lambda link: (natural_key(link.first), natural_key(link.second), link.where))


def _by_ports(model: Model) -> Iterator[_Joined]:
    owner: dict[int, int] = {}
    # Ports are nested in their element since IFC4, before they were connected to it.
    for relation, whole, members in (
        ("IfcRelConnectsPortToElement", "RelatedElement", "RelatingPort"),
        ("IfcRelNests", "RelatingObject", "RelatedObjects"),
    ):
        for each in of_type(model, relation):
            for element in entities(each, whole):
                owner.update((port.id(), element.id()) for port in entities(each, members) if port.is_a("IfcPort"))
    for each in of_type(model, _PORTS):
        for first in entities(each, "RelatingPort"):
            for second in entities(each, "RelatedPort"):
                if first.id() in owner and second.id() in owner:
                    yield _Joined(owner[first.id()], owner[second.id()], _flow(first, second), _PORTS)


def _flow(first: Entity, second: Entity) -> _Flow:
    """The flow between two ports: out of a source, into a sink (IFC4, IfcFlowDirectionEnum)."""
    out = {"SOURCE": 1, "SINK": -1}
    ways = out.get(text(first, "FlowDirection"), 0) - out.get(text(second, "FlowDirection"), 0)
    return "forward" if ways > 0 else "backward" if ways < 0 else "unknown"


def _direct(model: Model) -> Iterator[_Joined]:
    for each in of_type(model, _DIRECT):
        if each.is_a("IfcRelConnectsPathElements"):
            continue
        for first in entities(each, "RelatingElement"):
            for second in entities(each, "RelatedElement"):
                if all(any(end.is_a(name) for name in _PLANT) for end in (first, second)):
                    yield _Joined(first.id(), second.id(), "unknown", _DIRECT)


def _merged(joined: list[_Joined]) -> list[_Joined]:
    """Each pair once, with the flow that is known; unknown where both ways are stated."""
    flows: dict[tuple[int, int, str], set[_Flow]] = defaultdict(set)
    for first, second, flow, where in joined:
        if first != second:
            low, high = sorted((first, second))
            flows[low, high, where].add(flow if low == first else _TURNED[flow])
    merged = []
    for (low, high, where), ways in sorted(flows.items()):
        known = ways - {"unknown"}
        merged.append(_Joined(low, high, known.pop() if len(known) == 1 else "unknown", where))
    return merged


def _without_bare(joined: list[_Joined], shown: set[int], tree: Tree, notes: Notes) -> list[_Joined]:
    """The links between shown elements, those through one bare element between two others made direct."""
    at: dict[int, list[_Joined]] = defaultdict(list)
    for each in joined:
        for end in (each.first, each.second):
            if end not in shown:
                at[end].append(each)
    kept = [each for each in joined if each.first in shown and each.second in shown]
    for bare, links in sorted(at.items()):
        ends = [(each.second, each.flow) if each.first == bare else (each.first, _TURNED[each.flow]) for each in links]
        if len(ends) == 2 and all(end in shown for end, _ in ends):
            (first, from_first), (second, to_second) = ends[0], ends[1]
            flow: _Flow = to_second if _TURNED[from_first] == to_second else "unknown"
            kept.append(_Joined(first, second, flow, links[0].where))
        else:
            message = "its links are left out: it has no mesh, and does not stand between just two elements that have"
            notes.add("open-link", message, tree.paths.get(bare))
    return _merged(kept)
