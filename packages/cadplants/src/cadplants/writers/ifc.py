"""Plants as IFC4: typed products, triangulated shapes that repeats share, ports along the lines, systems, colours."""

from __future__ import annotations

import uuid
from collections import Counter, defaultdict
from typing import Any

import ifcopenshell
import ifcopenshell.guid
import numpy as np

from cadgraph.model.scene import Floats
from cadplants.model.plant import RGB, Plant
from cadplants.writers.ifc_classes import PROXY, ifc_class
from cadplants.writers.inventory import Inventory, Item, take
from cadplants.writers.metadata import Claim, Claims, claim
from cadplants.writers.placing import Frame, Placed, is_closed, place
from cadplants.writers.plant_file import FileStyle, Written

__all__ = ["write"]

_NAMES = uuid.UUID("6f1b7d0e-5f0a-5c0e-9a57-3c1c8a2f4e10")  # of the name space that GlobalIds are made in
_TIME = "2026-01-01T00:00:00"  # fixed, so that the same plant gives the same bytes
_PREFIXES = {1.0: None, 0.1: "DECI", 0.01: "CENTI", 0.001: "MILLI"}
_NAMED_UNITS = {0.0254: "INCH", 0.3048: "FOOT"}


def write(plant: Plant, style: FileStyle, stem: str) -> Written:
    """Writes a plant as IFC4.

    Args:
        plant: what to write.
        style: millimetres by default; IFC is Z up always.
        stem: name of the file without its suffix.

    Raises:
        ValueError: another up axis is asked for.
    """
    if style.up_axis not in (None, "Z"):
        raise ValueError("IFC files are Z up; leave --up out")
    unit = style.meters_per_unit or 0.001
    inventory = take(plant)
    claims = claim(plant, inventory, style.metadata)
    writer = _Writer(plant, inventory, claims, Frame(unit, "Z"))
    data = writer.data(stem)  # fills the paths
    return Written({".ifc": data}, tuple(writer.paths), unit, "Z", {}, claims.spoilt(writer.paths))


class _Writer:
    """Fills a file; ``paths`` has each component's then."""

    def __init__(self, plant: Plant, inventory: Inventory, claims: Claims, frame: Frame) -> None:
        self._plant, self._inventory, self._claims, self._frame = plant, inventory, claims, frame
        self._file: Any = ifcopenshell.file(schema="IFC4")
        self._placed = place(plant)
        self._repeats = Counter((one.shape, c.color) for one, c in zip(self._placed, plant.components, strict=True))
        self._maps: dict[tuple[int, RGB], Any] = {}
        self._styles: dict[RGB, Any] = {}
        self._types: dict[tuple[str, str, str], tuple[Any, list[Any]]] = {}
        self._above: dict[int, str] = {}
        self.paths = [""] * plant.n_meshes
        self._head()
        self._products = [self._product(item) for item in inventory.items]
        self._contain()
        self._ports()
        self._systems()
        for kind, members in self._types.values():
            self._rooted("IfcRelDefinesByType", f"of {kind.GlobalId}", RelatedObjects=members, RelatingType=kind)

    def data(self, stem: str) -> bytes:
        """The whole file."""
        name = self._file.header.file_name
        name.name, name.time_stamp = f"{stem}.ifc", _TIME
        name.preprocessor_version, name.originating_system = "cadplants", "cadplants"
        return str(self._file.to_string()).encode("utf-8")

    def _make(self, kind: str, *values: Any, **named: Any) -> Any:
        return self._file.create_entity(kind, *values, **named)

    def _rooted(self, kind: str, key: str, **named: Any) -> Any:
        """An entity with an id that follows from the plant, its seed and a key."""
        text = f"{self._plant.name}/{self._plant.seed}/{kind}/{key}"
        return self._make(kind, GlobalId=ifcopenshell.guid.compress(uuid.uuid5(_NAMES, text).hex), **named)

    def _head(self) -> None:
        """Units, the context, and the spatial structure."""
        metre = self._make("IfcSIUnit", UnitType="LENGTHUNIT", Name="METRE", Prefix=None)
        size = self._frame.meters_per_unit
        if size in _PREFIXES:
            length = metre
            metre.Prefix = _PREFIXES[size]
        else:
            factor = self._make("IfcMeasureWithUnit", self._make("IfcRatioMeasure", size), metre)
            powers = self._make("IfcDimensionalExponents", 1, 0, 0, 0, 0, 0, 0)
            name = _NAMED_UNITS.get(size, f"{size:g} METRE")
            length = self._make("IfcConversionBasedUnit", powers, "LENGTHUNIT", name, factor)
        angle = self._make("IfcSIUnit", UnitType="PLANEANGLEUNIT", Name="RADIAN")
        origin = self._axes(np.eye(4))
        context = self._make(
            "IfcGeometricRepresentationContext",
            ContextType="Model",
            CoordinateSpaceDimension=3,
            Precision=1e-6 / size,
            WorldCoordinateSystem=origin,
        )
        self._body = self._make(
            "IfcGeometricRepresentationSubContext",
            ContextIdentifier="Body",
            ContextType="Model",
            ParentContext=context,
            TargetView="MODEL_VIEW",
        )
        name = (self._plant.name or "plant").capitalize()
        project = self._rooted("IfcProject", "project", Name=name, RepresentationContexts=[context])
        project.UnitsInContext = self._make("IfcUnitAssignment", [length, angle])
        above, path, placement = project, f"/{name}", None
        for kind, called in (("IfcSite", "Site"), ("IfcBuilding", "Plant"), ("IfcBuildingStorey", "Ground")):
            placement = self._make("IfcLocalPlacement", placement, self._axes(np.eye(4)))
            made = self._rooted(kind, called, Name=called, ObjectPlacement=placement, CompositionType="ELEMENT")
            self._rooted("IfcRelAggregates", f"above {called}", RelatingObject=above, RelatedObjects=[made])
            above, path = made, f"{path}/{called}"
        self._storey, self._path, self._ground = above, path, placement

    def _axes(self, pose: Floats) -> Any:
        place = self._point(pose[:3, 3])
        if np.array_equal(pose[:3, :3], np.eye(3)):
            return self._make("IfcAxis2Placement3D", place)
        z, x = (self._make("IfcDirection", _plain(pose[:3, k])) for k in (2, 0))
        return self._make("IfcAxis2Placement3D", place, z, x)

    def _point(self, place: Floats) -> Any:
        return self._make("IfcCartesianPoint", _plain(place))

    def _product(self, item: Item) -> Any:
        """A product with its shape, or with products below it that have one each."""
        said = self._claims.items[item.number]
        bore = self._inventory.bores.get(item.line, 0.0) * 1000
        tag = item.unit.id if item.unit is not None else ""
        if len(item.members) == 1:
            return self._element(f"item {item.number}", said, tag, bore, item.members[0], self._path)
        whole = self._element(f"item {item.number}", said, tag, bore, None, self._path)
        below = [
            self._element(f"part {i}", self._claims.components[i], "", 0.0, i, self._above[whole.id()])
            for i in item.members
        ]
        self._rooted("IfcRelAggregates", f"item {item.number}", RelatingObject=whole, RelatedObjects=below)
        return whole

    def _element(self, key: str, said: Claim | None, tag: str, bore: float, component: int | None, above: str) -> Any:
        number = key.split()[-1]
        words = f"{said.words} DN{bore:.0f}" if said and bore else said.words if said else ""
        kind, predefined = ifc_class(said.group, said.name, said.words) if said else PROXY
        text = words[:1].upper() + words[1:]
        product = self._rooted(
            kind,
            key,
            Name=(tag or f"{text}:{number}") if said else f"Element_{number}",
            ObjectType=text or None,
            ObjectPlacement=self._make("IfcLocalPlacement", self._ground, self._axes(self._pose(component))),
            Representation=None if component is None else self._shape(component),
            Tag=number,
        )
        product.PredefinedType = predefined
        if said:
            self._typed(product, kind, predefined, text)
        path = f"{above}/{kind}_{product.GlobalId}"
        self._above[product.id()] = path
        if component is not None:
            self.paths[component] = path
        return product

    def _typed(self, product: Any, kind: str, predefined: str, name: str) -> None:
        """Adds a product to those of its type."""
        if (kind, predefined, name) not in self._types:
            made = self._rooted(f"{kind}Type", f"{predefined}/{name}", Name=name, PredefinedType=predefined)
            if predefined == "USERDEFINED":
                made.ElementType = name
            self._types[kind, predefined, name] = (made, [])
        self._types[kind, predefined, name][1].append(product)

    def _pose(self, component: int | None) -> Floats:
        return np.eye(4) if component is None else self._frame.pose(self._placed[component].pose)

    def _shape(self, component: int) -> Any:
        """The representation of a component; repeats of a shape map one."""
        placed, color = self._placed[component], self._plant.components[component].color
        key = (placed.shape, color)
        if self._repeats[key] == 1:
            return self._make("IfcProductDefinitionShape", Representations=[self._tessellation(placed, color)])
        if key not in self._maps:
            origin = self._axes(np.eye(4))
            self._maps[key] = self._make("IfcRepresentationMap", origin, self._tessellation(placed, color))
        target = self._make("IfcCartesianTransformationOperator3D", LocalOrigin=self._point(np.zeros(3)))
        item = self._make("IfcMappedItem", self._maps[key], target)
        body = self._make("IfcShapeRepresentation", self._body, "Body", "MappedRepresentation", [item])
        return self._make("IfcProductDefinitionShape", Representations=[body])

    def _tessellation(self, placed: Placed, color: RGB) -> Any:
        corners = self._make("IfcCartesianPointList3D", _rows(self._frame.points(placed.solid)))
        faces = self._make(
            "IfcTriangulatedFaceSet",
            Coordinates=corners,
            Closed=is_closed(placed.solid),
            CoordIndex=(placed.solid.faces.astype(np.int64) + 1).tolist(),
        )
        self._make("IfcStyledItem", Item=faces, Styles=[self._style(color)])
        return self._make("IfcShapeRepresentation", self._body, "Body", "Tessellation", [faces])

    def _style(self, color: RGB) -> Any:
        if color not in self._styles:
            rgb = self._make("IfcColourRgb", None, *(round(float(value), 6) for value in color))
            shading = self._make("IfcSurfaceStyleShading", SurfaceColour=rgb, Transparency=0.0)
            self._styles[color] = self._make("IfcSurfaceStyle", f"Colour {len(self._styles)}", "BOTH", [shading])
        return self._styles[color]

    def _contain(self) -> None:
        self._rooted(
            "IfcRelContainedInSpatialStructure", "all", RelatedElements=self._products, RelatingStructure=self._storey
        )

    def _ports(self) -> None:
        """Two ports where two products meet, one where a line ends."""
        nested: dict[int, list[Any]] = defaultdict(list)

        def port(owner: int, key: str, point: tuple[float, float, float], direction: str) -> Any:
            pose = np.eye(4)
            pose[:3, 3] = np.array(point) / self._frame.meters_per_unit
            made = self._rooted(
                "IfcDistributionPort",
                key,
                Name=f"Port {len(nested[owner]) + 1}",
                ObjectPlacement=self._make("IfcLocalPlacement", self._ground, self._axes(pose)),
                FlowDirection=direction,
                PredefinedType="PIPE",
            )
            nested[owner].append(made)
            return made

        ways = {"forward": ("SOURCE", "SINK"), "backward": ("SINK", "SOURCE"), "unknown": ("NOTDEFINED", "NOTDEFINED")}
        for k, joint in enumerate(self._inventory.joints):
            out, into = ways[joint.flow]
            first = port(joint.first, f"first of {k}", joint.point, out)
            second = port(joint.second, f"second of {k}", joint.point, into)
            self._rooted("IfcRelConnectsPorts", str(k), RelatingPort=first, RelatedPort=second)
        for k, (number, point) in enumerate(self._inventory.mouths):
            port(number, f"mouth {k}", point, "NOTDEFINED")
        for number, ports in nested.items():
            self._rooted(
                "IfcRelNests", f"ports of {number}", RelatingObject=self._products[number], RelatedObjects=ports
            )

    def _systems(self) -> None:
        for tag, items in self._inventory.lines.items():
            system = self._rooted("IfcDistributionSystem", tag, Name=tag, PredefinedType="NOTDEFINED")
            members = [self._products[item.number] for item in items]
            self._rooted("IfcRelAssignsToGroup", tag, RelatedObjects=members, RelatingGroup=system)


def _plain(values: Floats) -> list[float]:
    return [float(value) for value in np.round(values, 9) + 0.0]


def _rows(points: Floats) -> list[list[float]]:
    return [[float(x) for x in row] for row in (np.round(points, 9) + 0.0).tolist()]
