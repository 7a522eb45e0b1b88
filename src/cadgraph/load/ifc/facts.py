"""What a model says of its elements, and of itself as a whole."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Collection, Iterator

import ifcopenshell.util.element
import ifcopenshell.util.unit

from cadgraph._io.spf import IFC_MARK
from cadgraph._io.text import natural_key
from cadgraph.load.ifc.entities import Entity, Model, attribute, clean, entities, of_type, text
from cadgraph.load.ifc.tree import Tree, is_spatial
from cadgraph.model.facts import FACT_KEYS, Fact, FactKey

__all__ = ["element_facts", "file_metadata", "length_unit"]

_MOST = 20  # values of one key at one element; ours, far more than a person would read
_UNSAID = ("NOTDEFINED", "USERDEFINED", "NOTKNOWN", "UNSET")
# What IFC2X3 files call all devices of a kind; their type says which one it is.
_GENERIC = re.compile(
    r"Ifc(Flow(Controller|Fitting|MovingDevice|Segment|StorageDevice|Terminal|TreatmentDevice)"
    r"|Distribution(Control|Flow)?Element|EnergyConversionDevice|BuildingElementProxy|BuiltElement|BuildingElement)"
)
# P-101, 10-P-101A, V-12.3: letters, a dash, digits; with an area before and a letter or number behind.
_TAG = re.compile(r"(?:\d{1,4}[-.])?(?P<letters>[A-Z]{1,5})-?\d{1,6}(?:[-.]?[A-Z]{1,2}|[-.]\d{1,3})?")
_NO_TAG = ("DN", "PN", "NPS", "RAL", "M", "HEA", "HEB", "HEM", "IPE", "IPN", "UPE", "UPN", "SCH")
_SPEC = ("skey", "isogenskey")
_SIZE = ("nominaldiameter", "nominalsize", "nominalbore", "dn", "nenndurchmesser", "nennweite")
_LENGTHS = ("IfcLengthMeasure", "IfcPositiveLengthMeasure", "IfcNonNegativeLengthMeasure")
_NUMBERS = ("IfcReal", "IfcInteger", "IfcCountMeasure", "IfcNumericMeasure")
_BORES = (3.0, 4000.0)  # [mm] nominal bores that there are (DN 3 to DN 4000, EN ISO 6708)
_Row = tuple[FactKey, str, str]


def element_facts(model: Model, tree: Tree, shown: Collection[str]) -> list[Fact]:
    """The facts of all elements that have a mesh, or stand above one.

    Args:
        model: an open file.
        tree: of its nodes.
        shown: paths of the meshes and of the nodes above them.

    Returns:
        Them, sorted by path, then by key.
    """
    elements = [node for node in tree.nodes if tree.paths[node.id()] in shown and not is_spatial(node)]
    properties = _Properties(model)
    grouped = _by_relation(model)
    layers = _layers(model)
    found: list[Fact] = []
    for element in elements:
        rows = [*_own(element), *properties.of(element), *grouped.get(element.id(), ()), *_layers_of(element, layers)]
        path = tree.paths[element.id()]
        counts: dict[str, int] = defaultdict(int)
        for key, value, where in sorted(dict.fromkeys(rows), key=lambda row: FACT_KEYS.index(row[0])):
            counts[key] += 1
            if value and counts[key] <= _MOST:
                found.append(Fact(path, key, value, where))
    return sorted(found, key=lambda fact: natural_key(fact.path))


def _own(element: Entity) -> Iterator[_Row]:
    """What stands in the element itself and in its type."""
    kind = str(element.is_a())
    type_object = ifcopenshell.util.element.get_type(element)
    type_kind = str(type_object.is_a()) if type_object is not None else ""
    refined = type_kind.removesuffix("Type")
    if _GENERIC.fullmatch(kind) and refined != type_kind and not _GENERIC.fullmatch(refined):
        yield "class", refined, type_kind
    else:
        yield "class", kind, kind
    # A type, where it says something, counts before its occurrences (IFC4, 5.1.3.8).
    for owner, its_kind in ((type_object, type_kind), (element, kind)):
        value = attribute(owner, "PredefinedType") if owner is not None else None
        if isinstance(value, str) and value not in _UNSAID:
            yield "predefined", clean(value), f"{its_kind}.PredefinedType"
            break
    if type_object is not None:
        for name in ("Name", "ElementType", "ProcessType"):
            yield "type", text(type_object, name), f"{type_kind}.{name}"
    yield "type", text(element, "ObjectType"), f"{kind}.ObjectType"
    name, tag = text(element, "Name"), text(element, "Tag")
    yield "name", name, f"{kind}.Name"
    if _is_tag(tag):
        yield "tag", tag, f"{kind}.Tag"
    # "HEA-200" is a beam's profile: names of steel are none of devices.
    if "-" in name and _is_tag(name) and any(element.is_a(each) for each in _TAGGED):
        yield "tag", name, f"{kind}.Name"
    yield "description", text(element, "Description"), f"{kind}.Description"


_TAGGED = ("IfcDistributionElement", "IfcBuildingElementProxy", "IfcElementAssembly", "IfcProxy", "IfcSystem")


def _is_tag(value: str) -> bool:
    """Whether a text is what a plant calls an item; ``Tag`` is often a mere number of some program."""
    found = _TAG.fullmatch(value)
    return found is not None and found["letters"] not in _NO_TAG


class _Properties:
    """Codes and nominal sizes from property sets, of elements and of their types."""

    def __init__(self, model: Model) -> None:
        self._unit = length_unit(model)[0]
        self._of_set = {each.id(): rows for each in of_type(model, "IfcPropertySet") if (rows := self._rows(each))}
        self._of_element: dict[int, list[_Row]] = defaultdict(list)
        if not self._of_set:
            return
        for each in of_type(model, "IfcRelDefinesByProperties"):
            rows = self._of_sets(entities(each, "RelatingPropertyDefinition"))
            for element in entities(each, "RelatedObjects") if rows else ():
                self._of_element[element.id()] += rows[:_MOST]

    def of(self, element: Entity) -> list[_Row]:
        own = self._of_element.get(element.id(), [])
        type_object = ifcopenshell.util.element.get_type(element) if self._of_set else None
        inherited = self._of_sets(entities(type_object, "HasPropertySets")) if type_object is not None else []
        said = {key for key, _, _ in own}
        return [*own, *(row for row in inherited if row[0] not in said)]

    def _of_sets(self, sets: list[Entity]) -> list[_Row]:
        return [row for each in sets for row in self._of_set.get(each.id(), ())]

    def _rows(self, of: Entity) -> list[_Row]:
        rows: list[_Row] = []
        for each in entities(of, "HasProperties"):
            name = re.sub(r"[^a-z]", "", text(each, "Name").casefold())
            where = f"{text(of, 'Name')}.{text(each, 'Name')}"
            if name in _SPEC:
                rows += [("spec", clean(value), where) for value, _ in _values(each) if isinstance(value, str)]
            elif name in _SIZE:
                sizes = [self._millimetres(value, measure, each) for value, measure in _values(each)]
                rows += [("size", f"{size:.6g}", where) for size in sizes if size is not None]
        return rows

    def _millimetres(self, value: object, measure: str, of: Entity) -> float | None:
        if isinstance(value, str):
            found = re.fullmatch(r"(?:DN|NW)?\s*(\d{1,4})", value.strip(), re.IGNORECASE)
            value, measure = (float(found[1]), "IfcReal") if found else (None, "")
        if not isinstance(value, int | float) or isinstance(value, bool):
            return None
        if measure in _LENGTHS:
            own = entities(of, "Unit")
            size = value * (ifcopenshell.util.unit.get_unit_scale(own[0]) if own else self._unit) * 1000
        else:
            size = float(value) if measure in _NUMBERS else 0.0
        return size if _BORES[0] <= size <= _BORES[1] else None


def _values(of: Entity) -> Iterator[tuple[object, str]]:
    """The values of a property, each with the measure that it is."""
    for name in ("NominalValue", "EnumerationValues", "ListValues", "SetPointValue"):
        for each in entities(of, name)[:_MOST]:
            yield attribute(each, "wrappedValue"), str(each.is_a())


def _by_relation(model: Model) -> dict[int, list[_Row]]:
    """Systems, classification codes and materials, by the number of the element."""
    rows: dict[int, list[_Row]] = defaultdict(list)
    for each in of_type(model, "IfcRelAssignsToGroup"):
        for group in entities(each, "RelatingGroup"):
            if group.is_a("IfcSystem") and not group.is_a("IfcStructuralAnalysisModel") and not _is_ours(group):
                name = text(group, "Name") or text(group, "LongName")
                _give(rows, each, ("system", name, f"{group.is_a()}.Name"))
    for each in of_type(model, "IfcRelAssociatesClassification"):
        for code in entities(each, "RelatingClassification"):
            number = text(code, "Identification") or text(code, "ItemReference")
            if (number or text(code, "Name")) and not _is_in_our_classification(code):
                said = " ".join(filter(None, (number, text(code, "Name"))))
                _give(rows, each, ("spec", said, str(code.is_a())))
    for each in of_type(model, "IfcRelAssociatesMaterial"):
        for material in entities(each, "RelatingMaterial"):
            _give(rows, each, ("layer", text(material, "Name"), str(material.is_a())))
    return rows


def _give(rows: dict[int, list[_Row]], relation: Entity, row: _Row) -> None:
    for element in entities(relation, "RelatedObjects"):
        if len(rows[element.id()]) < 3 * _MOST:
            rows[element.id()].append(row)


def _is_ours(group: Entity) -> bool:
    return text(group, "ObjectType") == IFC_MARK


def _is_in_our_classification(code: Entity) -> bool:
    for _ in range(_MOST):
        above = entities(code, "ReferencedSource")
        if not above:
            break
        code = above[0]
    return bool(text(code, "Name") == IFC_MARK)


def _layers(model: Model) -> dict[int, list[str]]:
    """Names of presentation layers by the number of the representation or item that is on them."""
    layers: dict[int, list[str]] = defaultdict(list)
    for each in of_type(model, "IfcPresentationLayerAssignment"):
        for item in entities(each, "AssignedItems"):
            layers[item.id()].append(text(each, "Name"))
    return layers


def _layers_of(element: Entity, layers: dict[int, list[str]]) -> Iterator[_Row]:
    if not layers:
        return
    for shape in entities(element, "Representation"):
        for representation in entities(shape, "Representations"):
            for item in (representation, *entities(representation, "Items")[:_MOST]):
                for name in layers.get(item.id(), ()):
                    yield "layer", name, "IfcPresentationLayerAssignment"


def length_unit(model: Model) -> tuple[float, bool]:
    """Length of one unit of the file [m], and whether the file names it."""
    stated = any(
        attribute(unit, "UnitType") == "LENGTHUNIT"
        for project in of_type(model, "IfcProject")[:1]
        for assigned in entities(project, "UnitsInContext")
        for unit in entities(assigned, "Units")
    )
    scale = float(ifcopenshell.util.unit.calculate_unit_scale(model)) if stated else 1.0
    return (scale, stated) if scale > 0 else (1.0, False)


def file_metadata(model: Model) -> tuple[tuple[str, str], ...]:
    """What the file says of itself: schema, project, application, and where on Earth its origin lies."""
    said = [("schema", str(model.schema_identifier))]
    for project in of_type(model, "IfcProject")[:1]:
        said += [("project", text(project, "Name") or text(project, "LongName"))]
        said += [("description", text(project, "Description"))]
    for program in of_type(model, "IfcApplication")[:1]:
        said += [("application", f"{text(program, 'ApplicationFullName')} {text(program, 'Version')}".strip())]
    for crs in of_type(model, "IfcCoordinateReferenceSystem")[:1]:
        said += [("crs", text(crs, "Name")), ("vertical_datum", text(crs, "VerticalDatum"))]
    # Attributes of IfcMapConversion and of the site, which IFC2X3 has alone; lengths in units of the file.
    for entity, names in (("IfcMapConversion", _CONVERSION), ("IfcSite", _SITE)):
        for each in of_type(model, entity)[:1]:
            said += [(name, _number(attribute(each, theirs))) for theirs, name in names]
    return tuple((name, value) for name, value in said if value)


_CONVERSION = (
    ("Eastings", "eastings"),
    ("Northings", "northings"),
    ("OrthogonalHeight", "height"),
    ("XAxisAbscissa", "x_axis_east"),
    ("XAxisOrdinate", "x_axis_north"),
    ("Scale", "map_scale"),
)
_SITE = (("RefLatitude", "latitude"), ("RefLongitude", "longitude"), ("RefElevation", "elevation"))


def _number(value: object) -> str:
    """A number, or degrees, minutes, seconds and millionths of these (IfcCompoundPlaneAngleMeasure) in degrees."""
    if isinstance(value, tuple | list) and 3 <= len(value) <= 4:
        scales = (1, 60, 3600, 3.6e9)
        value = round(sum(float(part) / scale for part, scale in zip(value, scales, strict=False)), 9)
    # + 0.0: minus zero becomes zero.
    return f"{value + 0.0:.12g}" if isinstance(value, int | float) else ""
