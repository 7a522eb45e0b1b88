"""What prims are: labels by ``UsdSemantics.LabelsAPI``, and the units, clusters and lines that they make up.

The taxonomies:

- ``class``: one token, what a mesh is; its group where no name is known;
- ``category``: its group and its name;
- ``disposition``: ``turnable``, ``graspable``, ``readable``, where something can be done at it;
- ``cad_group``: its group alone;
- ``cad_unit``: the type of a functional unit, on the unit's own prim.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from pxr import Sdf, Vt

from cadgraph.export.usd_specs import (
    apply_schemas,
    claim,
    define_prim,
    identifier,
    relate,
    safe_text,
    set_attribute,
    set_string,
    token,
)
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Cluster, Connected, Contains, Junction, Part, Related, System, Terminal, Unit
from cadgraph.model.scene import Scene

__all__ = [
    "CATEGORY",
    "CLASS",
    "DISPOSITION",
    "GROUP",
    "UNIT",
    "Said",
    "Stamps",
    "add_structure",
    "dispositions_of",
    "label_prim",
    "parts_of_meshes",
    "said_of",
    "shared_parts",
    "size_of",
    "trace_of",
]

CLASS, CATEGORY, DISPOSITION, GROUP, UNIT = "class", "category", "disposition", "cad_group", "cad_unit"
"""The taxonomies."""

_TRACED = (CLASS, GROUP)  # taxonomies that say where they come from
_DONE = {"turn": ("turnable", "graspable"), "pull": ("turnable", "graspable"), "read": ("readable",)}
# What one reads of a gauge, the surest first; all of it where none of these is named.
_READ = (("gauge face", "gauge needle", "gauge glass"), ("gauge case",))


class Said(NamedTuple):
    """What a prim is said to be; equal where the same prim may stand for both.

    Args:
        name: token of ``class``.
        group: token of ``cad_group``.
        dispositions: tokens of ``disposition``.
    """

    name: str
    group: str
    dispositions: tuple[str, ...] = ()


def parts_of_meshes(scene: Scene, graph: SceneGraph) -> list[Part | None]:
    """The part of each mesh of a scene.

    Raises:
        ValueError: the graph names a mesh that the scene doesn't have.
    """
    index = {path: i for i, path in enumerate(scene.paths)}
    owners: list[Part | None] = [None] * scene.n_meshes
    for part in graph.of_layer(Part):
        for mesh in part.meshes:
            if mesh not in index:
                raise ValueError(
                    f"part {part.id!r} holds mesh {mesh!r}, which is not in the scene: pass the same scene"
                )
            owners[index[mesh]] = part
    return owners


def dispositions_of(graph: SceneGraph) -> dict[str, tuple[str, ...]]:
    """What can be done at meshes, by their source paths: at the wheel of a valve, at the face of a gauge."""
    parts = {part.id: part for part in graph.of_layer(Part)}
    found: dict[str, tuple[str, ...]] = {}
    for unit in graph.of_layer(Unit):
        if unit.mechanism is not None and unit.mechanism.kind != "needle":
            _add_to(found, unit.mechanism.meshes, _of_unit(unit, ("turn", "pull")))
        if "read" in unit.affordances:
            _add_to(found, _read_at([parts[part] for part in unit.parts]), _DONE["read"])
    return found


def _add_to(found: dict[str, tuple[str, ...]], meshes: Iterable[str], tokens: Sequence[str]) -> None:
    for mesh in meshes:
        found[mesh] = tuple(dict.fromkeys((*found.get(mesh, ()), *tokens)))


def _of_unit(unit: Unit, affordances: Sequence[str]) -> tuple[str, ...]:
    tokens = (token for name in unit.affordances if name in affordances for token in _DONE[name])
    return tuple(dict.fromkeys(tokens))


def _read_at(parts: Sequence[Part]) -> list[str]:
    for names in _READ:
        meshes = [mesh for part in parts if part.label and part.label.name in names for mesh in part.meshes]
        if meshes:
            return meshes
    return [mesh for part in parts for mesh in part.meshes]


def said_of(part: Part, dispositions: Iterable[str] = ()) -> Said | None:
    """What a part is said to be; None where it has no label."""
    label = part.label
    if label is None:
        return None
    return Said(token(label.name or label.group), token(label.group), tuple(dict.fromkeys(dispositions)))


def trace_of(part: Part) -> dict[str, Any]:
    """Where the label of a part comes from, for the custom data of its attributes."""
    label = part.label
    if label is None:
        return {}
    trace = {"confidence": float(label.confidence), "source": safe_text(label.source), "part": safe_text(part.id)}
    return {**trace, "likely": True} if label.likely else trace


def label_prim(prim: Any, said: Said, trace: Mapping[str, Any] | None = None) -> None:
    """Labels a prim in all taxonomies of meshes."""
    taxonomies: dict[str, Iterable[str]] = {
        CLASS: (said.name,),
        GROUP: (said.group,),
        CATEGORY: dict.fromkeys((said.group, said.name)),
    }
    if said.dispositions:
        taxonomies[DISPOSITION] = said.dispositions
    apply_schemas(prim, *(f"SemanticsLabelsAPI:{taxonomy}" for taxonomy in taxonomies))
    for taxonomy, tokens in taxonomies.items():
        _say(prim, taxonomy, tokens, trace if taxonomy in _TRACED else None)


class Stamps:
    """Labels prims of a layer; those that are said to be the same get copies of one prim, which is a third of the work.

    Args:
        layer: the layer.
    """

    def __init__(self, layer: Any) -> None:
        self._layer = layer
        self._models = Sdf.Layer.CreateAnonymous(".usda")
        self._path_of: dict[Said, Any] = {}
        self._above = {Sdf.Path.absoluteRootPath}  # what is there to hold prims

    def label(self, path: Any, said: Said, trace: Mapping[str, Any]) -> None:
        """Labels the prim at a path in all taxonomies of meshes; it is made, as an over, where it is not there."""
        if self._layer.GetObjectAtPath(path):
            # A copy would take the place of all that stands there and below.
            label_prim(self._layer.GetPrimAtPath(path), said, trace)
            return
        above = path.GetParentPath()
        if above not in self._above:
            Sdf.CreatePrimInLayer(self._layer, above)
            self._above.add(above)
        Sdf.CopySpec(self._models, self._model(said), self._layer, path)
        for taxonomy in _TRACED if trace else ():
            attribute = self._layer.GetAttributeAtPath(path.AppendProperty(f"semantics:labels:{taxonomy}"))
            attribute.SetInfo("customData", trace)

    def _model(self, said: Said) -> Any:
        found = self._path_of.get(said)
        if found is None:
            found = Sdf.Path.absoluteRootPath.AppendChild(f"Model_{len(self._path_of)}")
            label_prim(Sdf.CreatePrimInLayer(self._models, found), said)
            self._path_of[said] = found
        return found


def _label(prim: Any, taxonomy: str, tokens: Iterable[str], trace: Mapping[str, Any] | None = None) -> None:
    apply_schemas(prim, f"SemanticsLabelsAPI:{taxonomy}")
    _say(prim, taxonomy, tokens, trace)


def _say(prim: Any, taxonomy: str, tokens: Iterable[str], trace: Mapping[str, Any] | None = None) -> None:
    attribute = set_attribute(prim, f"semantics:labels:{taxonomy}", "TokenArray", Vt.TokenArray(list(tokens)))
    if trace:
        attribute.customData = dict(trace)


def shared_parts(parts: Sequence[Part]) -> dict[str, Any]:
    """What an instance root or instancer stands for: all its parts, the largest first, with their labels."""
    ordered = sorted(parts, key=size_of, reverse=True)
    names = [token(part.label.name or part.label.group) if part.label else "" for part in ordered]
    groups = [token(part.label.group) if part.label else "" for part in ordered]
    return {
        "parts": Vt.StringArray([safe_text(part.id) for part in ordered]),
        "classes": Vt.StringArray(names),
        "groups": Vt.StringArray(groups),
    }


def size_of(part: Part) -> tuple[float, float]:
    """What parts are compared by: of several at one prim, the largest names it."""
    # The box has a volume for open meshes too, so that all parts compare by the same measure.
    x, y, z = part.obb.extents
    return x * y * z, part.area


def add_structure(layer: Any, root_name: str, graph: SceneGraph, prims_of_part: Mapping[str, list[Any]]) -> None:
    """Adds units, clusters, ends and systems as prims of their own, with relationships to the prims of their parts."""
    root = Sdf.Path.absoluteRootPath.AppendChild(root_name)
    define_prim(layer, root, "Scope")
    paths: dict[str, Any] = {}
    for scope, layer_type, name_of in _SCOPES:
        nodes = graph.of_layer(layer_type)
        taken: set[str] = set()
        if nodes:
            define_prim(layer, root.AppendChild(scope), "Scope")
        for node in nodes:
            name = name_of(node)
            path = root.AppendChild(scope).AppendChild(claim(identifier(name), taken))
            prim = define_prim(layer, path, "Scope", name)
            set_string(prim, "cadgraph:id", node.id)
            paths[node.id] = path
    members: dict[str, list[str]] = {}
    for edge in graph.of_kind(Contains):
        members.setdefault(edge.source, []).append(edge.target)
    for unit in graph.of_layer(Unit):
        _describe_unit(layer.GetPrimAtPath(paths[unit.id]), unit, prims_of_part)
    for cluster in graph.of_layer(Cluster):
        prim = layer.GetPrimAtPath(paths[cluster.id])
        set_string(prim, "cadgraph:kind", cluster.kind)
        _hold_parts(prim, members.get(cluster.id, ()), prims_of_part)
    ends: list[Junction | Terminal] = [*graph.of_layer(Junction), *graph.of_layer(Terminal)]
    for end in ends:
        _hold_parts(layer.GetPrimAtPath(paths[end.id]), end.parts, prims_of_part)
    for system in graph.of_layer(System):
        relate(layer.GetPrimAtPath(paths[system.id]), "units", (paths[u] for u in system.units if u in paths))
    _add_relations(layer, graph, paths)


def _describe_unit(prim: Any, unit: Unit, prims_of_part: Mapping[str, list[Any]]) -> None:
    _label(prim, UNIT, (token(unit.unit_type),))
    dispositions = _of_unit(unit, unit.affordances)
    if dispositions:
        _label(prim, DISPOSITION, dispositions)
    set_string(prim, "cadgraph:tag", unit.tag)
    set_string(prim, "cadgraph:unitType", unit.unit_type)
    set_string(prim, "cadgraph:kind", unit.kind)
    _hold_parts(prim, unit.parts, prims_of_part)


def _hold_parts(prim: Any, parts: Iterable[str], prims_of_part: Mapping[str, list[Any]]) -> None:
    """Names the prims of these parts twice: as a relationship, and as a collection that tools can select and hide."""
    held = [path for part in parts for path in prims_of_part.get(part, ())]
    relate(prim, "parts", held)
    apply_schemas(prim, "CollectionAPI:parts")
    set_attribute(prim, "collection:parts:expansionRule", "Token", "expandPrims", uniform=True)
    includes = Sdf.RelationshipSpec(prim, "collection:parts:includes", custom=False)
    includes.targetPathList.explicitItems = list(dict.fromkeys(held))


def _add_relations(layer: Any, graph: SceneGraph, paths: Mapping[str, Any]) -> None:
    """``related`` and ``connected`` hold both ways; ``flowsTo`` points downstream where the direction is known."""
    found: dict[tuple[str, str], list[Any]] = {}

    def add(kind: str, source: str, target: str) -> None:
        if source in paths and target in paths:
            found.setdefault((source, kind), []).append(paths[target])

    edges: list[Related | Connected] = [*graph.of_kind(Related), *graph.of_kind(Connected)]
    for edge in edges:
        add(edge.kind, edge.source, edge.target)
        add(edge.kind, edge.target, edge.source)
        if isinstance(edge, Connected) and edge.direction == "forward":
            add("flowsTo", edge.source, edge.target)
        if isinstance(edge, Connected) and edge.direction == "backward":
            add("flowsTo", edge.target, edge.source)
    for (source, kind), targets in found.items():
        relate(layer.GetPrimAtPath(paths[source]), kind, targets)


_SCOPES: tuple[tuple[str, Any, Callable[[Any], str]], ...] = (
    ("Units", Unit, lambda node: node.tag),
    ("Clusters", Cluster, lambda node: node.id),
    ("Junctions", Junction, lambda node: node.id),
    ("Terminals", Terminal, lambda node: node.id),
    ("Systems", System, lambda node: node.id),
)
