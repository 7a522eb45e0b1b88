"""The shapes of a model's products, as triangles."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import ifcopenshell.geom
import numpy as np

from cadgraph.load.ifc.entities import Entity, Model, entities, text
from cadgraph.load.ifc.tree import Tree, is_spatial
from cadgraph.load.packing import Notes, Piece
from cadgraph.load.triangles import linear, main_color
from cadgraph.model.scene import Faces, Floats

if TYPE_CHECKING:
    from cadgraph.config import LoadConfig

__all__ = ["shape_products"]

_THREADS = 2
# Representations by how well they show what is built (IFC4.3, 4.1.6.3 and 8.18.3.5); others come last.
_BEST = ("Body", "Facetation", "Tessellation", "Body-FallBack", "Surface")
_NO_BODY = frozenset(
    {"Annotation", "Axis", "Box", "CoG", "Clearance", "FootPrint", "Lighting", "Profile", "Reference", "SurveyPoints"}
)
_NO_SURFACE = frozenset(
    {
        *("Annotation2D", "BoundingBox", "Curve", "Curve2D", "Curve3D", "Fill", "FillArea", "FootPrint"),
        *("GeometricCurveSet", "LightSource", "Point", "PointCloud", "Segment", "Text"),
    }
)
_FACETED = frozenset({"IfcTriangulatedFaceSet", "IfcPolygonalFaceSet"})
_MAX_ITEMS = 10_000  # of a product that are looked at
_MAX_MAPS = 20  # representations that stand for one another; real files have one or two


@dataclass(frozen=True)
class _Shape:
    points: Floats
    faces: Faces
    color: Floats | None


def shape_products(model: Model, tree: Tree, config: LoadConfig, notes: Notes) -> list[Piece]:
    """The pieces of all built products; those of one shape share its arrays.

    Args:
        model: an open file.
        tree: of its nodes.
        config: ``max_gap`` and ``max_angle`` say how fine curved surfaces are cut.
        notes: gets what is left out, and why.

    Returns:
        The pieces, in metres, in the order of the paths.
    """
    products = _built(tree, notes)
    if not products:
        return []
    shapes: dict[str, _Shape] = {}
    found: dict[int, dict[str, list[tuple[str, Floats]]]] = {}
    for element in _shaped(model, products, config):
        matrix = np.array(element.transformation.matrix, np.float64).reshape(4, 4)
        geometry = element.geometry
        if geometry.id not in shapes:
            shapes[geometry.id] = _shape(geometry)
        contexts = found.setdefault(element.id, {})
        contexts.setdefault(element.context, []).append((geometry.id, matrix))
    pieces: list[Piece] = []
    for product in products:
        path = tree.paths[product.id()]
        pieces.extend(_pieces(product, path, found.get(product.id(), {}), shapes, notes))
    return pieces


def _built(tree: Tree, notes: Notes) -> list[Entity]:
    """The products that are built and have a shape."""
    built = []
    for node in tree.nodes:
        path = tree.paths[node.id()]
        if not node.is_a("IfcProduct"):
            continue
        if not entities(node, "Representation"):
            if node.is_a("IfcElement") and node.id() not in tree.parents:
                notes.add("no-geometry", "left out: the file gives it no shape", path)
        elif node.is_a("IfcElement") or node.is_a("IfcProxy") or node.is_a("IfcSite"):
            built.append(node)
        else:
            what = "the volume of a space or zone" if is_spatial(node) else "an annotation, a grid or an alignment"
            notes.add("not-built", f"left out: {what} is nothing that is built", path)
    return built


def _shaped(model: Model, products: list[Entity], config: LoadConfig) -> Iterator[Any]:
    settings = ifcopenshell.geom.settings()
    settings.set("mesher-linear-deflection", config.max_gap)
    settings.set("mesher-angular-deflection", config.max_angle)
    settings.set("weld-vertices", True)
    # Points about the product itself: equal shapes stay equal, and a far site doesn't cost digits.
    settings.set("use-world-coords", False)
    settings.set("apply-default-materials", False)
    # OpenCASCADE makes a face of every triangle that a file holds already: twenty times slower, and the same result.
    faceted = [product for product in products if _is_faceted(product)]
    known = {product.id() for product in faceted}
    rest = [product for product in products if product.id() not in known]
    for some, library in ((faceted, "hybrid-cgal-simple-opencascade"), (rest, "opencascade")):
        if not some:
            continue
        iterator = ifcopenshell.geom.iterator(settings, model, _THREADS, include=some, geometry_library=library)
        more = iterator.initialize()
        while more:
            yield iterator.get()
            more = iterator.next()


def _is_faceted(product: Entity) -> bool:
    """Whether all that a product consists of are triangles or polygons, and nothing is cut out of it."""
    if entities(product, "HasOpenings"):
        return False
    items = [item for each in _representations(product) for item in entities(each, "Items")]
    for _ in range(_MAX_MAPS):
        mapped = [item for item in items if item.is_a("IfcMappedItem")]
        if not mapped or len(items) > _MAX_ITEMS:
            break
        items = [item for item in items if not item.is_a("IfcMappedItem")]
        for item in mapped:
            for source in entities(item, "MappingSource"):
                for shape in entities(source, "MappedRepresentation"):
                    items += entities(shape, "Items")
    return bool(items) and all(item.is_a() in _FACETED for item in items)


def _shape(geometry: Any) -> _Shape:
    # Copies, as the buffers end with the element.
    points = np.frombuffer(geometry.verts_buffer, np.float64).reshape(-1, 3) + 0.0
    faces = np.frombuffer(geometry.faces_buffer, np.int32).reshape(-1, 3).copy()
    materials = np.frombuffer(geometry.material_ids_buffer, np.int32)
    a, b, c = faces.T
    whole = (a != b) & (b != c) & (c != a) & (faces.min(axis=1, initial=0) >= 0)
    whole &= faces.max(axis=1, initial=0) < len(points)
    finite = np.asarray(np.isfinite(points).all(axis=1))
    whole[whole] = finite[faces[whole]].all(axis=1)
    color = None
    if len(materials):
        palette = _palette(geometry.materials)
        unknown = (materials < 0) | (materials >= len(palette) - 1)
        number = np.where(unknown, len(palette) - 1, materials).astype(np.int64)[whole]
        color = main_color(points, faces[whole], palette, number)
    return _Shape(points, faces[whole], color)


def _palette(styles: Any) -> Floats:
    """``(n + 1, 3)`` linear colours of styles, in IFC files those of screens; the last is none."""
    colors = [(style.diffuse.r(), style.diffuse.g(), style.diffuse.b()) for style in styles]
    palette = np.array([*colors, (np.nan, np.nan, np.nan)], np.float64)
    palette[~np.isfinite(palette).all(axis=1)] = np.nan
    return linear(palette)


def _pieces(
    product: Entity,
    path: str,
    contexts: dict[str, list[tuple[str, Floats]]],
    shapes: dict[str, _Shape],
    notes: Notes,
) -> Iterator[Piece]:
    usable = sorted(set(contexts) - _NO_BODY, key=lambda name: (_BEST.index(name) if name in _BEST else 99, name))
    if not usable:
        if contexts or not any(_has_surface(each) for each in _representations(product)):
            notes.add("no-surface", "left out: its shape is of curves, points or a mere box or clearance", path)
        else:
            notes.add("unreadable", "left out: its shape can't be made; check it in the program that wrote it", path)
        return
    seen: set[tuple[str, bytes]] = set()
    placed = sorted(contexts[usable[0]], key=lambda each: (each[0], each[1].tobytes()))
    for shape, matrix in placed:
        if (shape, matrix.tobytes()) in seen:
            notes.add("listed-twice", "the file lists its shape more than once; one is kept", path)
            continue
        seen.add((shape, matrix.tobytes()))
        if not len(shapes[shape].faces):
            notes.add("empty-mesh", "left out: it has no triangle", path)
            continue
        yield Piece(path, shapes[shape].points, shapes[shape].faces, matrix, shapes[shape].color)


def _representations(product: Entity) -> Iterator[Entity]:
    for shape in entities(product, "Representation"):
        yield from entities(shape, "Representations")


def _has_surface(representation: Entity) -> bool:
    """Whether a representation should give triangles, by what it says of itself."""
    for _ in range(_MAX_MAPS):
        if text(representation, "RepresentationIdentifier") in _NO_BODY:
            return False
        kind = text(representation, "RepresentationType")
        if kind != "MappedRepresentation":
            return kind not in _NO_SURFACE
        mapped = [
            inner
            for item in entities(representation, "Items")
            for source in entities(item, "MappingSource")
            for inner in entities(source, "MappedRepresentation")
        ]
        if not mapped:
            return True
        representation = mapped[0]
    return True
