"""Labels, units and systems in a copy of the IFC file that a graph was made from.

Every product of a labelled part gets the property set ``CadGraph_Label`` (Group, Name, Confidence, Source, State,
Part) and a reference to the classification ``cadgraph``. Every unit becomes an ``IfcGroup`` named by its tag with the
property set ``CadGraph_Unit``, every functional system an ``IfcDistributionSystem`` (``IfcSystem`` where the schema has
no such, or where members are no distribution elements).

What the file held before stays as it is, all GlobalIds included; what an earlier run added is replaced. GlobalIds of
what is new follow from the project's and from names, so that the same graph gives the same bytes.
"""

from __future__ import annotations

import importlib.util
import os
import re
import uuid
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from cadgraph._io.atomic import replacing
from cadgraph._io.digest import sha256_of
from cadgraph._io.spf import IFC_MARK, find_ifc_damage, unzipped
from cadgraph._io.text import printable
from cadgraph.errors import LoadError, MissingExtra, OutputError
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import Label
from cadgraph.model.records import Connected, Part, System, Unit

__all__ = ["LABEL_SET", "UNIT_SET", "write_ifc"]

LABEL_SET, UNIT_SET = "CadGraph_Label", "CadGraph_Unit"
"""The property sets that are added."""

_Model = Any  # IfcOpenShell has no types
_Entity = Any
_NAMESPACE = uuid.uuid5(uuid.NAMESPACE_URL, "cadgraph/ifc")
_LABEL_LENGTH = 255  # [characters] of an IfcLabel (ISO 16739-1)
_EDITION = "1"  # of the classification; IFC2X3 wants one
# Class and GlobalId, or class and number of the line: the last step of a path that the reader made.
_STEP = re.compile(r"(Ifc[0-9A-Za-z]+)_(?:id(\d{1,12})|([0-3][0-9A-Za-z_$]{21}))(?:_\d+)?")


def write_ifc(graph: SceneGraph, source: str | Path, path: str | Path) -> Path:
    """Writes a copy of an IFC file with what a graph says of its products.

    A product that holds several parts gets the label of the largest one.

    Args:
        graph: made from the source.
        source: the IFC file, ``.ifc`` or ``.ifczip``, as it was when the graph was made.
        path: the file to write, ending in ``.ifc``.

    Returns:
        The file written.

    Raises:
        LoadError: the source is no IFC file, has changed since, can't be read, or lacks a mesh of the graph.
        OutputError: the copy can't be written, or would overwrite the source.
        MissingExtra: IfcOpenShell isn't installed.
    """
    origin, target = Path(source), Path(path)
    if importlib.util.find_spec("ifcopenshell") is None:
        raise MissingExtra("writing IFC files", "ifc")
    _check(graph, origin, target)
    with unzipped(origin, str(origin)) as plain:
        model = _opened(plain, origin)
    products = _products_of_parts(model, graph, origin)
    _remove_own(model)
    writer = _Writer(model)
    writer.add_labels(graph, products)
    writer.add_units(graph, products)
    writer.add_systems(graph, products)
    with replacing(target) as beside:
        try:
            model.write(str(beside), format=".ifc")
            damage = find_ifc_damage(beside)
        except RuntimeError as error:
            damage = printable(str(error))
        if damage:
            raise OutputError(f"{target}: can't be written ({damage}); choose another output folder")
    return target


def _check(graph: SceneGraph, source: Path, target: Path) -> None:
    if source.suffix.lower() not in (".ifc", ".ifczip"):
        raise LoadError(f"{source}: no IFC file by its name; give the .ifc file that the graph was made from")
    if target.suffix.lower() != ".ifc":
        raise OutputError(f"{target}: labelled IFC is written as plain text; give a file that ends in .ifc")
    if os.path.realpath(source) == os.path.realpath(target):
        raise OutputError(f"{target}: this is the source itself, which stays untouched; choose another output file")
    try:
        digest = sha256_of(source)
        damage = find_ifc_damage(source)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise LoadError(f"{source}: can't be read ({reason}); give the file that the graph was made from") from None
    if graph.source.sha256 not in ("", digest):
        raise LoadError(f"{source}: it has changed since the graph was made, or is another file; build the graph anew")
    if damage:
        raise LoadError(f"{source}: {damage}")


def _opened(plain: Path, source: Path) -> _Model:
    import ifcopenshell

    try:
        return ifcopenshell.open(str(plain), format=".ifc")
    except ifcopenshell.SchemaError:
        # The reader takes the nearest schema for such a file; to write in it would make the file another one.
        remedy = "export it as IFC2X3, IFC4 or IFC4X3_ADD2 and build the graph anew"
        raise LoadError(f"{source}: its schema is none that can be written; {remedy}") from None
    except (ifcopenshell.Error, OSError, RuntimeError, ValueError) as error:
        raise LoadError(f"{source}: not readable as IFC ({printable(str(error))[:200]}); export it again") from None


# Products


def _products_of_parts(model: _Model, graph: SceneGraph, source: Path) -> dict[str, list[_Entity]]:
    """The products of each part, by its id, in the order of its meshes."""
    products: dict[str, list[_Entity]] = {}
    for part in graph.of_layer(Part):
        found: dict[int, _Entity] = {}
        for mesh in part.meshes:
            product = _product(model, mesh)
            if product is None:
                raise LoadError(f"{source}: it has no product for the graph's mesh {mesh!r}; build the graph anew")
            found[product.id()] = product
        products[part.id] = list(found.values())
    return products


def _product(model: _Model, mesh: str) -> _Entity | None:
    """The product of the lowest step of a path that names one; what splits a mesh adds steps below it."""
    for step in reversed(mesh.split("/")):
        found = _STEP.fullmatch(step)
        if found is None:
            continue
        try:
            entity = model.by_id(int(found[2])) if found[2] else model.by_guid(found[3])
        except RuntimeError:
            continue
        if entity.is_a() == found[1]:
            return entity
    return None


# What is there from an earlier run


def _remove_own(model: _Model) -> None:
    sets = [each for each in model.by_type("IfcPropertySet") if each.Name in (LABEL_SET, UNIT_SET)]
    groups = [each for each in model.by_type("IfcGroup") if each.ObjectType == IFC_MARK]
    systems = [each for each in model.by_type("IfcClassification") if each.Name == IFC_MARK]
    codes = _referring(model, "IfcClassificationReference", "ReferencedSource", systems)
    relations = [
        *_referring(model, "IfcRelDefinesByProperties", "RelatingPropertyDefinition", sets),
        *_referring(model, "IfcRelAssignsToGroup", "RelatingGroup", groups),
        *_referring(model, "IfcRelAssociatesClassification", "RelatingClassification", [*codes, *systems]),
    ]
    properties = {each.id(): each for one in sets for each in one.HasProperties or () if _uses(model, each) == 1}
    for each in (*relations, *groups, *sets, *properties.values(), *codes, *systems):
        model.remove(each)


def _referring(model: _Model, kind: str, attribute: str, to: list[_Entity]) -> list[_Entity]:
    """The entities of a class whose attribute is one of these."""
    numbers = {each.id() for each in to}
    values = ((each, getattr(each, attribute)) for each in (model.by_type(kind) if numbers else ()))
    return [each for each, value in values if value is not None and value.id() in numbers]


def _uses(model: _Model, entity: _Entity) -> int:
    return len(model.get_inverse(entity))


# What is added


class _Writer:
    """Adds entities with GlobalIds that follow from what they are."""

    def __init__(self, model: _Model) -> None:
        projects = model.by_type("IfcProject")
        self._model = model
        self._project: _Entity = projects[0] if projects else None
        # IFC2X3 wants an owner history of each root; that of the project names who made the file.
        self._history = projects[0].OwnerHistory if projects else None
        self._taken = {each.GlobalId for each in model.by_type("IfcRoot")}

    def add_labels(self, graph: SceneGraph, products: Mapping[str, list[_Entity]]) -> None:
        """Property sets and classification of all products that hold a labelled part."""
        largest: dict[int, tuple[_Entity, Part]] = {}
        for part in graph.of_layer(Part):
            for product in products[part.id] if part.label is not None else ():
                known = largest.get(product.id())
                if known is None or _size(known[1]) < _size(part):
                    largest[product.id()] = product, part
        by_part: dict[str, list[_Entity]] = {}
        by_label: dict[tuple[str, str | None], list[_Entity]] = {}
        for _, (product, part) in sorted(largest.items()):
            by_part.setdefault(part.id, []).append(product)
            if part.label is not None:
                by_label.setdefault(part.label.said, []).append(product)
        for part in graph.of_layer(Part):
            if part.label is not None and part.id in by_part:
                self._set(LABEL_SET, f"label {part.id}", _label_rows(part, part.label), by_part[part.id])
        if by_label:
            self._classify(by_label)

    def add_units(self, graph: SceneGraph, products: Mapping[str, list[_Entity]]) -> None:
        """A group for each unit."""
        for unit in graph.of_layer(Unit):
            members = _members(unit.parts, products)
            if not members:
                continue
            words = [unit.unit_type, *([unit.kind] if unit.kind else [])]
            group = self._root(
                "IfcGroup", f"unit {unit.tag}", Name=_label(unit.tag), Description=", ".join(words), ObjectType=IFC_MARK
            )
            self._assign(group, f"unit {unit.tag}", members)
            rows = {"Type": ("IfcLabel", _label(unit.unit_type)), "Tag": ("IfcLabel", _label(unit.tag))}
            if unit.kind:
                rows["Kind"] = ("IfcLabel", _label(unit.kind))
            self._set(UNIT_SET, f"unit {unit.tag}", rows, [group])

    def add_systems(self, graph: SceneGraph, products: Mapping[str, list[_Entity]]) -> None:
        """A system for each connected functional network, with the parts of the lines between its units."""
        lines: dict[str, list[str]] = {}
        for edge in graph.of_kind(Connected):
            lines.setdefault(edge.source, []).extend(edge.via)
        for number, system in enumerate(graph.of_layer(System), start=1):
            nodes = (*system.units, *system.junctions, *system.terminals)
            own = [part for node in nodes for part in getattr(graph.nodes[node], "parts", ())]
            members = _members([*own, *(part for node in nodes for part in lines.get(node, ()))], products)
            if not members:
                continue
            distribution = self._model.schema != "IFC2X3" and all(
                each.is_a("IfcDistributionElement") for each in members
            )
            key = f"system {number}"
            group = self._root(
                "IfcDistributionSystem" if distribution else "IfcSystem",
                key,
                Name=f"CadGraph {key}",
                Description=_measures(system) or None,
                ObjectType=IFC_MARK,
            )
            self._assign(group, key, members)

    def _classify(self, products: Mapping[tuple[str, str | None], list[_Entity]]) -> None:
        old = self._model.schema == "IFC2X3"
        classification = self._model.create_entity(
            "IfcClassification", Source=IFC_MARK, Edition=_EDITION, Name=IFC_MARK
        )
        # Before IFC4 only notations and references can be associated.
        if self._project is not None and not old:
            self._associate("classification", [self._project], classification)
        for group, name in sorted(products, key=lambda said: (said[0], said[1] or "")):
            code = f"{group}/{name}" if name else group
            number = {"ItemReference" if old else "Identification": _label(code)}
            reference = self._model.create_entity(
                "IfcClassificationReference", Name=_label(name or group), ReferencedSource=classification, **number
            )
            self._associate(f"class {code}", products[group, name], reference)

    def _associate(self, key: str, objects: list[_Entity], classification: _Entity) -> None:
        self._root(
            "IfcRelAssociatesClassification",
            f"associates {key}",
            Name=IFC_MARK,
            RelatedObjects=objects,
            RelatingClassification=classification,
        )

    def _assign(self, group: _Entity, key: str, members: list[_Entity]) -> None:
        self._root("IfcRelAssignsToGroup", f"assigns {key}", RelatedObjects=members, RelatingGroup=group)

    def _set(self, name: str, key: str, rows: Mapping[str, tuple[str, object]], objects: list[_Entity]) -> None:
        properties = [self._property(each, *value) for each, value in rows.items()]
        own = self._root("IfcPropertySet", f"{name} {key}", Name=name, HasProperties=properties)
        self._root(
            "IfcRelDefinesByProperties",
            f"defines {name} {key}",
            RelatedObjects=objects,
            RelatingPropertyDefinition=own,
        )

    def _property(self, name: str, measure: str, value: object) -> _Entity:
        typed = self._model.create_entity(measure, value)
        return self._model.create_entity("IfcPropertySingleValue", Name=name, NominalValue=typed)

    def _root(self, kind: str, key: str, **attributes: object) -> _Entity:
        return self._model.create_entity(kind, GlobalId=self._global_id(key), OwnerHistory=self._history, **attributes)

    def _global_id(self, key: str) -> str:
        from ifcopenshell import guid

        project = self._project.GlobalId if self._project is not None else ""
        for again in range(len(self._taken) + 1):
            made = str(guid.compress(uuid.uuid5(_NAMESPACE, f"{project} {again} {key}").hex))
            if made not in self._taken:
                break
        self._taken.add(made)
        return made


def _label_rows(part: Part, label: Label) -> dict[str, tuple[str, object]]:
    rows: dict[str, tuple[str, object]] = {"Group": ("IfcLabel", _label(label.group))}
    if label.name is not None:
        rows["Name"] = ("IfcLabel", _label(label.name))
    rows["Confidence"] = ("IfcReal", round(float(label.confidence), 6))
    rows["Source"] = ("IfcLabel", _label(label.source))
    rows["State"] = ("IfcLabel", label.state)
    rows["Part"] = ("IfcLabel", _label(part.id))
    return rows


def _label(text: str) -> str:
    return printable(text)[:_LABEL_LENGTH]


def _size(part: Part) -> float:
    x, y, z = part.obb.extents
    return float(x * y * z)


def _members(parts: Iterable[str], products: Mapping[str, list[_Entity]]) -> list[_Entity]:
    """The products of these parts, each once, in the order of the file."""
    found = {each.id(): each for part in parts for each in products.get(part, ())}
    return [each for _, each in sorted(found.items())]


def _measures(system: System) -> str:
    words = [f"length {system.length:.2f} m"] if system.length is not None else []
    return ", ".join([*words, *([f"DN {', '.join(map(str, system.sizes))}"] if system.sizes else [])])
