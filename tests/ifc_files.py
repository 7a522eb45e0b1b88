"""Small plants as IFC files, made entity by entity; the same call gives the same bytes."""

from __future__ import annotations

import uuid

import ifcopenshell
from ifcopenshell import guid

OLD = "IFC2X3"
# What the classes are called before IFC4, where the type alone says which device it is.
_OLD_NAMES = {
    "IfcPipeSegment": "IfcFlowSegment",
    "IfcPipeFitting": "IfcFlowFitting",
    "IfcValve": "IfcFlowController",
    "IfcPump": "IfcFlowMovingDevice",
    "IfcDistributionSystem": "IfcSystem",
}


class IfcPlant:
    """A file in the making; ``write`` ends it."""

    def __init__(self, schema="IFC4", unit="MILLI"):
        self.old = schema == OLD
        self.file = ifcopenshell.file(schema=schema)
        self.count = 0
        self.add = self.file.create_entity
        # IFC2X3 wants to know of each root who made it.
        self.history = self._history() if self.old else None
        self.project = self.root("IfcProject", Name="Test plant")
        if unit is not None:
            prefix = {} if unit == "" else {"Prefix": unit}
            metre = self.add("IfcSIUnit", UnitType="LENGTHUNIT", Name="METRE", **prefix)
            self.project.UnitsInContext = self.add("IfcUnitAssignment", Units=[metre])
        origin = self.add("IfcAxis2Placement3D", Location=self.point(0, 0, 0))
        self.context = self.add(
            "IfcGeometricRepresentationContext",
            ContextType="Model",
            CoordinateSpaceDimension=3,
            Precision=1e-5,
            WorldCoordinateSystem=origin,
        )
        self.project.RepresentationContexts = [self.context]
        self.site = self.root("IfcSite", Name="Works", CompositionType="ELEMENT")
        self.storey = self.root("IfcBuildingStorey", Name="Pump hall 1", CompositionType="ELEMENT")
        self.root("IfcRelAggregates", RelatingObject=self.project, RelatedObjects=[self.site])
        self.root("IfcRelAggregates", RelatingObject=self.site, RelatedObjects=[self.storey])
        self.contained = []

    def _history(self):
        person = self.add("IfcPerson", FamilyName="Doe")
        firm = self.add("IfcOrganization", Name="Works")
        both = self.add("IfcPersonAndOrganization", ThePerson=person, TheOrganization=firm)
        program = self.add("IfcApplication", firm, "1.2", "Drawing program", "draw")
        return self.add("IfcOwnerHistory", both, program, None, "ADDED", None, None, None, 1)

    def root(self, kind, **attributes):
        self.count += 1
        made = guid.compress(uuid.uuid5(uuid.NAMESPACE_URL, str(self.count)).hex)
        return self.add(kind, GlobalId=made, OwnerHistory=self.history, **attributes)

    def point(self, *xyz):
        return self.add("IfcCartesianPoint", [float(x) for x in xyz])

    def axes(self, at=(0, 0, 0), along=(0, 0, 1), across=(1, 0, 0)):
        axis, ref = (self.add("IfcDirection", [float(x) for x in d]) for d in (along, across))
        return self.add("IfcAxis2Placement3D", self.point(*at), axis, ref)

    def cylinder(self, radius, length):
        """A solid about z, from the origin up, in the file's unit."""
        flat = self.add("IfcAxis2Placement2D", self.point(0, 0))
        profile = self.add("IfcCircleProfileDef", "AREA", None, flat, float(radius))
        up = self.add("IfcDirection", (0.0, 0.0, 1.0))
        return self.add("IfcExtrudedAreaSolid", profile, self.axes(), up, float(length))

    def body(self, *items, kind="SweptSolid", name="Body"):
        return self.add("IfcShapeRepresentation", self.context, name, kind, items)

    def line(self):
        """An axis, which has no surface."""
        way = self.add("IfcPolyline", [self.point(0, 0, 0), self.point(1, 0, 0)])
        return self.body(way, kind="Curve3D", name="Axis")

    def element(self, kind, *bodies, at=(0, 0, 0), along=(1, 0, 0), within=True, **attributes):
        """An element whose z axis points along x, in the storey."""
        across = (0, 1, 0) if along == (1, 0, 0) else (1, 0, 0)
        placement = self.add("IfcLocalPlacement", None, self.axes(at, along, across))
        shape = self.add("IfcProductDefinitionShape", None, None, bodies) if bodies else None
        kind = _OLD_NAMES.get(kind, kind) if self.old else kind
        made = self.root(kind, ObjectPlacement=placement, Representation=shape, **attributes)
        if within:
            self.contained.append(made)
        return made

    def pipe(self, x, length=1000, radius=50, **attributes):
        return self.element("IfcPipeSegment", self.body(self.cylinder(radius, length)), at=(x, 0, 0), **attributes)

    def typed(self, kind, elements, name, maps=None, **attributes):
        required = {"PredefinedType": "NOTDEFINED"} | attributes
        made = self.root(kind, Name=name, RepresentationMaps=maps, **required)
        self.root("IfcRelDefinesByType", RelatedObjects=elements, RelatingType=made)
        return made

    def shape_map(self, *items):
        return self.add("IfcRepresentationMap", self.axes(), self.body(*items))

    def mapped(self, source):
        move = self.add("IfcCartesianTransformationOperator3D", None, None, self.point(0, 0, 0), 1.0, None)
        return self.body(self.add("IfcMappedItem", source, move), kind="MappedRepresentation")

    def port(self, element, flow=None):
        port = self.root("IfcDistributionPort", FlowDirection=flow)
        if self.old:
            self.root("IfcRelConnectsPortToElement", RelatingPort=port, RelatedElement=element)
        else:
            self.root("IfcRelNests", RelatingObject=element, RelatedObjects=[port])
        return port

    def connect(self, first, second, flow=True):
        a = self.port(first, "SOURCE" if flow else "NOTDEFINED")
        b = self.port(second, "SINK" if flow else "NOTDEFINED")
        self.root("IfcRelConnectsPorts", RelatingPort=a, RelatedPort=b)

    def group(self, kind, members, **attributes):
        kind = _OLD_NAMES.get(kind, kind) if self.old else kind
        made = self.root(kind, **attributes)
        self.root("IfcRelAssignsToGroup", RelatedObjects=members, RelatingGroup=made)
        return made

    def properties(self, element, name, **values):
        """A property set; values are pairs of measure and value."""
        rows = [self.add("IfcPropertySingleValue", Name=key, NominalValue=self.add(*value)) for key, value in
                values.items()]  # fmt: skip
        own = self.root("IfcPropertySet", Name=name, HasProperties=rows)
        if element.is_a("IfcTypeObject"):
            element.HasPropertySets = [own]
        else:
            self.root("IfcRelDefinesByProperties", RelatedObjects=[element], RelatingPropertyDefinition=own)

    def paint(self, body, *rgb):
        color = self.add("IfcColourRgb", None, *(float(x) for x in rgb))
        style = self.add("IfcSurfaceStyleShading", color)
        surface = self.add("IfcSurfaceStyle", None, "BOTH", [style])
        styles = [self.add("IfcPresentationStyleAssignment", [surface])] if self.old else [surface]
        self.add("IfcStyledItem", body.Items[0], styles)

    def write(self, path):
        if self.contained:
            self.root(
                "IfcRelContainedInSpatialStructure", RelatingStructure=self.storey, RelatedElements=self.contained
            )
            self.contained = []
        self.file.header.file_name.time_stamp = "2020-01-01T00:00:00"
        self.file.write(str(path), format=".ifc")
        return path


def pump_line(schema="IFC4"):
    """Pump, pipe, valve, gasket without a shape, valve, pipe; 1.9 m along x. The valves share one shape."""
    plant = IfcPlant(schema)
    new = not plant.old
    pump = plant.element(
        "IfcPump", plant.body(plant.cylinder(150, 300)), at=(-300, 0, 0), Name="P-101", Tag="4711", Description="Feed"
    )
    first = plant.pipe(0, 500, Name="Pipe")
    shape = plant.shape_map(plant.cylinder(80, 200))
    valves = [
        plant.element("IfcValve", plant.mapped(shape), at=(x, 0, 0), Name=f"Valve {x}", Tag=tag)
        for x, tag in ((500, "V-12"), (700, "815"))
    ]
    gasket = plant.element("IfcPipeFitting", at=(700, 0, 0), Name="Gasket")
    last = plant.pipe(900, 1000)
    plant.paint(last.Representation.Representations[0], 1.0, 0.5, 0.0)
    for a, b in ((pump, first), (first, valves[0]), (valves[0], gasket), (gasket, valves[1])):
        plant.connect(a, b)
    plant.connect(valves[1], last, flow=False)
    valve_type = plant.typed("IfcValveType", valves, "Gate valve DN100", [shape], PredefinedType="CHECK")
    plant.typed("IfcPipeSegmentType", [first, last], "Steel tube", PredefinedType="RIGIDSEGMENT")
    plant.typed("IfcPumpType", [pump], "Pump 7", PredefinedType="USERDEFINED", ElementType="Feed pump")
    plant.properties(valve_type, "Isogen", SKEY=("IfcLabel", "VGFL"))
    plant.properties(first, "Pset_PipeSegmentTypeCommon", NominalDiameter=("IfcPositiveLengthMeasure", 100.0))
    plant.group("IfcDistributionSystem", [pump, first, *valves, last], Name="Feed water")
    if new:
        crs = plant.add("IfcProjectedCRS", Name="EPSG:25832")
        plant.add("IfcMapConversion", plant.context, crs, 500000.0, 5400000.0, 100.0)
    return plant


def storehouse():
    """What is left out, and an assembly: a space, an opening in a wall, an axis, an element without a shape."""
    plant = IfcPlant()
    wall = plant.element("IfcWall", plant.body(plant.cylinder(1000, 200)))
    hole = plant.element("IfcOpeningElement", plant.body(plant.cylinder(500, 400)), within=False)
    plant.root("IfcRelVoidsElement", RelatingBuildingElement=wall, RelatedOpeningElement=hole)
    room = plant.element("IfcSpace", plant.body(plant.cylinder(3000, 3000)), within=False, Name="Room 1")
    plant.root("IfcRelAggregates", RelatingObject=plant.storey, RelatedObjects=[room])
    plant.element("IfcPipeSegment", plant.line(), Name="Axis only")
    plant.element("IfcPipeFitting", Name="Bare")
    frame = plant.element("IfcElementAssembly", Name="FR-12", Description="Pipe rack")
    beams = [plant.element("IfcBeam", plant.body(plant.cylinder(60, 900)), at=(0, y, 0), within=False, Name="HEA-200")
             for y in (3000, 4000)]  # fmt: skip
    plant.root("IfcRelAggregates", RelatingObject=frame, RelatedObjects=beams)
    plant.root("IfcRelConnectsElements", RelatingElement=beams[0], RelatedElement=beams[1])
    tank = plant.element("IfcTank", plant.body(plant.cylinder(300, 900)), at=(0, 6000, 0), PredefinedType="VESSEL")
    skid = plant.element("IfcBuildingElementProxy", plant.body(plant.cylinder(300, 90)), at=(0, 6000, -90))
    plant.root("IfcRelConnectsElements", RelatingElement=tank, RelatedElement=skid)
    return plant
