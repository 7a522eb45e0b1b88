"""The tree of a model: project, site, building, storey, assembly, element; and a path for each node."""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from dataclasses import dataclass

from cadgraph.load.ifc.entities import Entity, Model, attribute, entities, of_type, text
from cadgraph.load.naming import Names, step_text
from cadgraph.load.packing import Notes

__all__ = ["Tree", "is_spatial", "plant_tree"]

_MAX_DEPTH = 100  # of the tree; ours, real ones have about ten levels
_GUID = re.compile(r"[0-3][0-9A-Za-z_$]{21}")  # 128 bits in 22 digits of 6 bits: the first has 2 (ISO 16739-1, 5.4.2)
# Attribute of the whole, and of its members.
_RELATIONS = (
    ("IfcRelContainedInSpatialStructure", "RelatingStructure", "RelatedElements"),
    ("IfcRelNests", "RelatingObject", "RelatedObjects"),
    ("IfcRelAggregates", "RelatingObject", "RelatedObjects"),
)


@dataclass(frozen=True)
class Tree:
    """Where everything stands.

    Args:
        paths: of each node, by the number of its entity.
        nodes: the entities, in the order of their numbers.
        parents: numbers of those that hold others.
    """

    paths: dict[int, str]
    nodes: tuple[Entity, ...]
    parents: frozenset[int]


def plant_tree(model: Model, notes: Notes) -> Tree:
    """The tree of a model.

    What stands in no storey stands directly below the project. Where wholes and members form a circle, the relation
    that closes it is taken out of the model: the geometry library would follow it without end.

    Args:
        model: an open file.
        notes: gets ``bad-guid`` for elements that no GlobalId tells apart, ``bad-structure`` for circles.
    """
    _open_circles(model, notes)
    above: dict[int, Entity] = {}
    for relation, whole, members in _RELATIONS:
        for each in of_type(model, relation):
            for owner in entities(each, whole):
                for member in entities(each, members):
                    above[member.id()] = owner
    projects = of_type(model, "IfcProject")
    nodes = {each.id(): each for each in (*projects, *of_type(model, "IfcProduct"), *above.values())}
    nodes = {i: node for i, node in sorted(nodes.items()) if _stands(node)}
    names = _Names(list(nodes.values()))
    home = projects[0].id() if projects else 0
    paths, depths = {0: ""}, {0: 0}
    taken: dict[str, Names] = defaultdict(Names)
    for i in nodes:
        for below, node in _unnamed(i, nodes, above, home, paths):
            # A chain of any length must not make paths of any length.
            below = below if depths[below] < _MAX_DEPTH else home
            at = paths[below]
            paths[node.id()] = f"{at}/{taken[at].take(names.of(node))}"
            depths[node.id()] = depths[below] + 1
    del paths[0]
    wrong = [paths[node.id()] for node in nodes.values() if names.lacks_guid(node)]
    for path in wrong:
        notes.add("bad-guid", "its GlobalId is missing, none, or another element's; told by its line instead", path)
    parents = frozenset(owner.id() for member, owner in above.items() if member in nodes)
    return Tree(paths, tuple(nodes.values()), parents)


def _open_circles(model: Model, notes: Notes) -> None:
    owners: dict[int, list[tuple[int, int]]] = {}
    for relation, whole, members in _RELATIONS:
        for each in of_type(model, relation):
            for owner in entities(each, whole):
                for member in entities(each, members):
                    owners.setdefault(member.id(), []).append((owner.id(), each.id()))
    done: set[int] = set()
    closing: dict[int, None] = {}
    for start in sorted(owners):
        way, on_way = [(start, iter(owners[start]))], {start}
        while way:
            node, rest = way[-1]
            for owner_id, relation_id in rest:
                if owner_id in on_way:
                    closing[relation_id] = None
                elif owner_id not in done:
                    on_way.add(owner_id)
                    way.append((owner_id, iter(owners.get(owner_id, ()))))
                    break
            else:
                way.pop()
                on_way.discard(node)
                done.add(node)
    for relation_id in closing:
        model.remove(model.by_id(relation_id))
        notes.add(
            "bad-structure", f"wholes and members form a circle; line #{relation_id}, which closes it, is left out"
        )


def _unnamed(
    start: int, nodes: dict[int, Entity], above: dict[int, Entity], home: int, paths: dict[int, str]
) -> list[tuple[int, Entity]]:
    """The nodes from the first without a path down to this one, each with the number of the one above it."""
    way: list[tuple[int, Entity]] = []
    at = start
    while at not in paths:
        owner = above.get(at)
        higher = owner.id() if owner is not None and owner.id() in nodes else home
        higher = 0 if at == home else higher
        way.append((higher, nodes[at]))
        at = higher
    return way[::-1]


def _stands(node: Entity) -> bool:
    """Whether an entity is a node: ports and openings are features of others, analysis models stand apart."""
    apart = ("IfcPort", "IfcFeatureElementSubtraction", "IfcStructuralItem", "IfcStructuralActivity")
    return not any(node.is_a(name) for name in apart)


def is_spatial(node: Entity) -> bool:
    """Whether a node is a project, site, building, storey, space or zone."""
    return any(node.is_a(name) for name in ("IfcContext", "IfcProject", "IfcSpatialElement")) or node.is_a(
        "IfcSpatialStructureElement"
    )


class _Names:
    """The last step of each path."""

    def __init__(self, nodes: list[Entity]) -> None:
        self._uses = Counter(_guid(node) for node in nodes)

    def lacks_guid(self, node: Entity) -> bool:
        guid = _guid(node)
        return not is_spatial(node) and (not _GUID.fullmatch(guid) or self._uses[guid] > 1)

    def of(self, node: Entity) -> str:
        kind = str(node.is_a())
        if is_spatial(node):
            name = text(node, "Name") or text(node, "LongName")
            return step_text(name)[:100].strip("_.") or kind
        return f"{kind}_id{node.id()}" if self.lacks_guid(node) else f"{kind}_{_guid(node)}"


def _guid(node: Entity) -> str:
    value = attribute(node, "GlobalId")
    return value if isinstance(value, str) else ""
