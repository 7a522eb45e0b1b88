"""Plants as STEP (AP214): an assembly of parts, each made of faceted solids with flat faces.

Written by hand after ISO 10303-42 (geometry), -43 (assemblies) and -46 (colours).
"""

from __future__ import annotations

import re

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.model.plant import RGB, Plant
from cadplants.solids.mesh_ops import Solid
from cadplants.solids.tessellate import facets
from cadplants.writers.placing import Frame, is_closed, place, shells
from cadplants.writers.plant_file import FileStyle, Written

__all__ = ["write"]

_PREFIXES = {1.0: "$", 0.1: ".DECI.", 0.01: ".CENTI.", 0.001: ".MILLI."}
_HEADER = """ISO-10303-21;
HEADER;
FILE_DESCRIPTION(('generated plant'),'2;1');
FILE_NAME('{name}','2026-01-01T00:00:00',(''),(''),'cadplants','cadplants','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 1 1 1 1 }}'));
ENDSEC;
DATA;
"""


def write(plant: Plant, style: FileStyle, stem: str) -> Written:
    """Writes a plant as STEP.

    A mesh of several closed shells becomes a part of as many solids, an open one a surface model.

    Args:
        plant: what to write.
        style: millimetres and Z up by default.
        stem: name of the file without its suffix.

    Raises:
        ValueError: a unit that is no metre, decimetre, centimetre or millimetre, or Y up.
    """
    unit = style.meters_per_unit or 0.001
    if unit not in _PREFIXES or style.up_axis not in (None, "Z"):
        raise ValueError("STEP files are written Z up in units of 1, 0.1, 0.01 or 0.001 m; change --unit or --up")
    file = _Step(Frame(unit, "Z"))
    numbers = np.random.default_rng([plant.seed, 7]).permutation(max(10 * plant.n_meshes, 10))[: plant.n_meshes]
    parts: dict[tuple[int, RGB], _Part] = {}
    occurrences, paths = [], []
    for one, component, number in zip(place(plant), plant.components, numbers.tolist(), strict=True):
        key = (one.shape, component.color)
        if key not in parts:
            parts[key] = file.part(f"Part_{len(parts):04d}", one.solid, component.color)
        name = f"Item_{number:05d}"
        occurrences.append((name, parts[key], one.pose))
        paths.append(f"/Assembly/{name}")
    file.assembly("Assembly", occurrences)
    header = _HEADER.format(name=re.sub(r"[^\w.-]", "_", stem, flags=re.ASCII) + ".step")
    data = header + "\n".join(file.lines) + "\nENDSEC;\nEND-ISO-10303-21;\n"
    return Written({".step": data.encode("ascii")}, tuple(paths), unit, "Z")


class _Part:
    """Where a part's entities are: definition, representation, and the axes that it is placed by."""

    def __init__(self, definition: int, shape: int, axes: int) -> None:
        self.definition, self.shape, self.axes = definition, shape, axes


class _Step:
    """The data section in the making."""

    def __init__(self, frame: Frame) -> None:
        self.lines: list[str] = []
        self._frame = frame
        self._styles: dict[RGB, int] = {}
        self._styled: list[int] = []
        application = self._add("APPLICATION_CONTEXT('core data for automotive mechanical design processes')")
        self._add(f"APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,#{application})")
        self._product = self._add(f"PRODUCT_CONTEXT('',#{application},'mechanical')")
        self._design = self._add(f"PRODUCT_DEFINITION_CONTEXT('part definition',#{application},'design')")
        prefix = _PREFIXES[frame.meters_per_unit]
        length = self._add(f"(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT({prefix},.METRE.))")
        angle = self._add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))")
        solid = self._add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())")
        finest = _real(1e-7 / frame.meters_per_unit)
        gap = self._add(
            f"UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE({finest}),#{length},'distance_accuracy_value','')"
        )
        self._context = self._add(
            f"(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#{gap}))"
            f"GLOBAL_UNIT_ASSIGNED_CONTEXT((#{length},#{angle},#{solid}))REPRESENTATION_CONTEXT('',''))"
        )

    def _add(self, text: str) -> int:
        self.lines.append(f"#{len(self.lines) + 1}={text};")
        return len(self.lines)

    def part(self, name: str, solid: Solid, color: RGB) -> _Part:
        """A part of as many bodies as the mesh has shells."""
        pieces = shells(solid)
        closed = all(is_closed(piece) for piece in pieces)
        axes = self._axes(np.eye(4))
        bodies = [self._body(piece, closed) for piece in pieces]
        self._styled += [self._add(f"STYLED_ITEM('color',(#{self._style(color)}),#{body})") for body in bodies]
        kind = "FACETED_BREP_SHAPE_REPRESENTATION" if closed else "MANIFOLD_SURFACE_SHAPE_REPRESENTATION"
        shape = self._add(f"{kind}('',({_references([axes, *bodies])}),#{self._context})")
        return _Part(self._define(name, shape), shape, axes)

    def assembly(self, name: str, occurrences: list[tuple[str, _Part, Floats]]) -> None:
        """The product that holds all others, and the colours of everything."""
        axes = [self._axes(self._frame.pose(pose)) for _, _, pose in occurrences]
        shape = self._add(f"SHAPE_REPRESENTATION('',({_references([self._axes(np.eye(4)), *axes])}),#{self._context})")
        definition = self._define(name, shape)
        for k, ((called, part, _), target) in enumerate(zip(occurrences, axes, strict=True)):
            use = self._add(
                f"NEXT_ASSEMBLY_USAGE_OCCURRENCE('{k + 1}','{called}','',#{definition},#{part.definition},$)"
            )
            used = self._add(f"PRODUCT_DEFINITION_SHAPE('','',#{use})")
            move = self._add(f"ITEM_DEFINED_TRANSFORMATION('','',#{part.axes},#{target})")
            relation = self._add(
                f"(REPRESENTATION_RELATIONSHIP('','',#{part.shape},#{shape})"
                f"REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#{move})SHAPE_REPRESENTATION_RELATIONSHIP())"
            )
            self._add(f"CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#{relation},#{used})")
        if self._styled:
            items = _references(self._styled)
            self._add(f"MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',({items}),#{self._context})")

    def _define(self, name: str, shape: int) -> int:
        product = self._add(f"PRODUCT('{name}','{name}','',(#{self._product}))")
        self._add(f"PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,(#{product}))")
        version = self._add(f"PRODUCT_DEFINITION_FORMATION('','',#{product})")
        definition = self._add(f"PRODUCT_DEFINITION('design','',#{version},#{self._design})")
        shaped = self._add(f"PRODUCT_DEFINITION_SHAPE('','',#{definition})")
        self._add(f"SHAPE_DEFINITION_REPRESENTATION(#{shaped},#{shape})")
        return definition

    def _body(self, solid: Solid, closed: bool) -> int:
        points = self._frame.points(solid)
        counts, corners = facets(solid)
        places: dict[int, int] = {}
        faces = []
        for ring in np.split(corners, np.cumsum(counts)[:-1]):
            at = points[ring] - points[ring[0]]
            normal = np.cross(at, np.roll(at, -1, axis=0)).sum(axis=0)  # Newell
            length = float(np.linalg.norm(normal))
            along = next((leg for leg in np.diff(at, axis=0) if np.linalg.norm(leg) > 0), None)
            if length == 0 or along is None:
                continue  # a triangle without area has no plane
            for corner in ring.tolist():
                if corner not in places:
                    places[corner] = self._point(points[corner])
            loop = self._add(f"POLY_LOOP('',({_references([places[corner] for corner in ring.tolist()])}))")
            bound = self._add(f"FACE_OUTER_BOUND('',#{loop},.T.)")
            axes = self._placed(places[int(ring[0])], normal / length, along / np.linalg.norm(along))
            plane = self._add(f"PLANE('',#{axes})")
            faces.append(self._add(f"FACE_SURFACE('',(#{bound}),#{plane},.T.)"))
        shell = self._add(f"{'CLOSED' if closed else 'OPEN'}_SHELL('',({_references(faces)}))")
        return self._add(f"FACETED_BREP('',#{shell})" if closed else f"SHELL_BASED_SURFACE_MODEL('',(#{shell}))")

    def _point(self, place: Floats) -> int:
        return self._add(f"CARTESIAN_POINT('',({_reals(place)}))")

    def _axes(self, pose: Floats) -> int:
        return self._placed(self._point(pose[:3, 3]), pose[:3, 2], pose[:3, 0])

    def _placed(self, point: int, z: Floats, x: Floats) -> int:
        axis, direction = (self._add(f"DIRECTION('',({_reals(one)}))") for one in (z, x))
        return self._add(f"AXIS2_PLACEMENT_3D('',#{point},#{axis},#{direction})")

    def _style(self, color: RGB) -> int:
        if color not in self._styles:
            rgb = self._add(f"COLOUR_RGB('',{_reals(np.array(color))})")
            filled = self._add(f"FILL_AREA_STYLE_COLOUR('',#{rgb})")
            area = self._add(f"FILL_AREA_STYLE('',(#{filled}))")
            fill = self._add(f"SURFACE_STYLE_FILL_AREA(#{area})")
            side = self._add(f"SURFACE_SIDE_STYLE('',(#{fill}))")
            usage = self._add(f"SURFACE_STYLE_USAGE(.BOTH.,#{side})")
            self._styles[color] = self._add(f"PRESENTATION_STYLE_ASSIGNMENT((#{usage}))")
        return self._styles[color]


def _references(numbers: list[int]) -> str:
    return ",".join(f"#{number}" for number in numbers)


def _reals(values: Floats) -> str:
    return ",".join(_real(value) for value in values.tolist())


def _real(value: float) -> str:
    """A number as STEP wants it: with a point, and a capital E."""
    text = f"{value + 0.0:.12g}".upper()
    whole, e, power = text.partition("E")
    return f"{whole}{'' if '.' in whole else '.'}{e}{power}"
