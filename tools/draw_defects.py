"""Draws one spot of a plant for each defect of drawing, with what is found of it: docs/defects.jpg."""

from __future__ import annotations

import argparse
import io
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from cadgraph._io.atomic import write_atomically
from cadgraph.draw.render.annotation import Mark, Segment, Tag, annotate
from cadgraph.draw.render.camera import Camera, frame
from cadgraph.draw.render.color import Colors, from_hex
from cadgraph.draw.render.picture import Look, Paint, Renderer
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Joint
from cadgraph.model.scene import Floats, Scene
from cadgraph.model.truth import Truth
from cadgraph.pipeline import build
from cadlab.evaluate.evaluation import evaluate
from cadplants import Defects, Plant, make
from cadplants.faults.defects import DEFECTS
from cadplants.model.plant import Component
from cadplants.truth.truth_writer import truth_of

PRESET, SEED, STYLE = "loop", 11, "plant-design"
CELL, CAPTION, COLUMNS = (350, 240), 64, 5  # px
LINE, MADE, FREE = "#e2211c", "#14532d", "#f59e0b"
PIPE, SECOND, PLATE, OTHER, JACKET = "#b6bfca", "#8f9cad", "#7d93ab", "#dfe3e8", "#e9cf8f"
UNITS = {"valve": "#1f86f0", "gauge": "#20b03e", "pump": "#f08c1e", "tank": "#e24ad0", "equipment": "#c9a227"}
PLATES = frozenset({"flange", "blind flange", "gasket", "bolt", "nut"})
ASIDE = frozenset({"Structural element", "Electrical and safety"})


@dataclass(frozen=True)
class Spot:
    """What a picture shows.

    Args:
        point: ``(3,)`` its middle [m].
        axis: ``(3,)`` unit vector along the pipe there.
        width: of what it shows [m].
        joint: that is told in numbers, if any.
    """

    point: Floats
    axis: Floats
    width: float
    joint: Joint | None = None


@dataclass(frozen=True)
class Case:
    """A defect in the gallery.

    Args:
        says: what is drawn differently, in few words.
        find: the spot where that shows.
        cut: whether what stands before the axis is cut away.
        edges: whether the edges of triangles are drawn.
        pieces: whether pipes are drawn in two tones, mesh by mesh.
    """

    says: str
    find: Callable[[Plant, SceneGraph], Spot]
    cut: bool = False
    edges: bool = False
    pieces: bool = False


def along(graph: SceneGraph, point: Floats) -> Floats:
    """The direction of the line that passes nearest to a point."""
    best, axis = np.inf, np.array([1.0, 0.0, 0.0])
    for edge in graph.connections():
        path = np.array(edge.path)
        for a, b in zip(path[:-1], path[1:], strict=True):
            way = b - a
            share = np.clip((point - a) @ way / max(float(way @ way), 1e-12), 0, 1)
            off = float(np.linalg.norm(a + share * way - point))
            if off < best - 1e-6 and np.linalg.norm(way) > 1e-3:
                best, axis = off, way / np.linalg.norm(way)
    return np.asarray(axis)


def at_joint(low: float, high: float, width: float, *kinds: str) -> Callable[[Plant, SceneGraph], Spot]:
    """The made joint of some kinds whose gap [m] lies highest between two bounds, at a valve where there is one."""

    def find(plant: Plant, graph: SceneGraph) -> Spot:
        fitting = [j for j in graph.joints(made=True) if j.kind in kinds and low <= j.gap <= high]
        ports = np.array([port.point for unit in graph.units("valve") for port in unit.ports])

        def order(joint: Joint) -> tuple[bool, float, str]:
            near = float(np.linalg.norm(ports - joint.point, axis=1).min())
            return near > 0.12, -abs(joint.gap), joint.first

        joint = min(fitting, key=order)
        point = np.array(joint.point)
        return Spot(point, along(graph, point), width, joint)

    return find


def at_device(unit_type: str, chosen: int, reach: float = 1.5) -> Callable[[Plant, SceneGraph], Spot]:
    """One of the true units of a type, with some of the pipe at both sides."""

    def find(plant: Plant, graph: SceneGraph) -> Spot:
        units = [unit for unit in plant.units if unit.type == unit_type]
        return around(plant, graph, units[chosen % len(units)].id, reach)

    return find


def around(plant: Plant, graph: SceneGraph, unit: str, reach: float = 1.5) -> Spot:
    """The meshes of a true unit."""
    points = np.concatenate([c.vertices for c in plant.components if c.unit == unit])
    low, high = points.min(axis=0), points.max(axis=0)
    point = (low + high) / 2
    return Spot(point, along(graph, point), reach * float((high - low).max()))


def at_gauge_foot(plant: Plant, graph: SceneGraph) -> Spot:
    """The foot of a gauge, with the joint there."""
    gauge = next(unit for unit in graph.units("gauge") if unit.ports)
    point = np.array(gauge.ports[0].point)
    joints = [j for j in graph.joints(gauge.tag, made=True) if j.kind in ("mount", "face", "side")]
    joint = min(joints, key=lambda j: float(np.linalg.norm(np.array(j.point) - point)), default=None)
    return Spot(point, along(graph, point - np.array([0, 0, 0.1])), 0.16, joint)


def at_mesh(
    width: float, chosen: Callable[[Component], bool], share: float = 0.5
) -> Callable[[Plant, SceneGraph], Spot]:
    """The first mesh of some, at a share of the way along it."""

    def find(plant: Plant, graph: SceneGraph) -> Spot:
        found = max((c for c in plant.components if chosen(c)), key=lambda c: float(np.ptp(c.vertices, axis=0).max()))
        low, high = found.vertices.min(axis=0), found.vertices.max(axis=0)
        way = np.where(np.arange(3) == np.argmax(high - low), share, 0.5)
        point = low + way * (high - low)
        return Spot(point, along(graph, point), width)

    return find


def at_cut_pipe(plant: Plant, graph: SceneGraph) -> Spot:
    """Where one piece of a pipe ends and the next begins."""
    named = {part.id: part.label.name if part.label else None for part in graph.parts()}
    joints = [j for j in graph.joints(made=True) if named[j.first] == named[j.second] == "pipe" and j.kind == "face"]
    joint = min(joints, key=lambda j: j.point)
    point = np.array(joint.point)
    return Spot(point, along(graph, point), 1.0, joint)


def lacking_pieces(plant: Plant, spot: Spot) -> list[Component]:
    """The pieces near a spot that the plant had before it lost some."""
    held = {_middle(component) for component in plant.components}
    whole = make(PRESET, SEED, STYLE).components
    return [c for c in whole if c.unit and near(c, spot) and _middle(c) not in held]


def _middle(component: Component) -> tuple[float, ...]:
    return tuple(component.vertices.mean(axis=0).round(5).tolist())


def at_lack(plant: Plant, graph: SceneGraph) -> Spot:
    """A valve that lacks a piece which the plant had before."""
    valves = {unit.id for unit in plant.units if unit.type == "valve"}
    kept = {_middle(component) for component in plant.components}
    whole = make(PRESET, SEED, STYLE).components
    gone = [component for component in whole if component.unit in valves and _middle(component) not in kept]
    return around(plant, graph, max(gone, key=lambda c: float(np.ptp(c.vertices, axis=0).max())).unit)


CASES: dict[str, Case] = {
    "none": Case("as it was made", at_device("valve", 0)),
    "gaps": Case("all joints 0.5-5 mm apart", at_joint(0.002, 0.006, 0.16, "face", "mount"), cut=True),
    "overlaps": Case("0.5-3 mm into each other", at_joint(-0.004, -0.001, 0.16, "face", "mount"), cut=True),
    "setback": Case("pipe ends behind its flange's face", at_joint(-0.0105, -0.003, 0.16, "face"), cut=True),
    "clearance": Case("air in screwed joints", at_gauge_foot),
    "gauges": Case("gauges stand off their outlet", at_gauge_foot),
    "gaskets": Case("no gaskets, faces apart", at_joint(0.001, 0.006, 0.16, "face", "mount"), cut=True),
    "doubled": Case("a third of the meshes has its triangles twice", at_device("valve", 1), edges=True),
    "insulation": Case(
        "a larger hollow body around the pipe", at_mesh(0.5, lambda c: c.family == "insulation", 0.03), cut=True
    ),
    "cut": Case("pipes in up to six pieces", at_cut_pipe, pieces=True),
    "incomplete": Case("a piece of the device is missing (pale)", at_lack),
    "solid": Case("pipes and bodies have no bore", at_device("valve", 0), cut=True),
    "long": Case("fittings of few long triangles", at_mesh(0.35, lambda c: c.name == "reducer"), edges=True),
    "one": Case("each valve, pump and gauge is one mesh", at_device("pump", 0)),
    "primitives": Case("cones and cylinders, as in plant-design systems", at_device("valve", 0)),
    "split": Case("every triangle cut into four", at_device("valve", 1), edges=True),
    "shuffled": Case("triangles and corners in another order", at_device("valve", 1), edges=True),
    "mirrored": Case("the plant is its mirror image", at_device("valve", 0)),
    "all": Case("gaps, setback, insulation, cuts, pieces missing...", at_device("valve", 3)),
}


def graph_of(plant: Plant, true: bool) -> tuple[SceneGraph, float]:
    """The graph with true or embedded labels, and F1 of its connections."""
    named = zip(plant.paths(), plant.components, strict=True)
    labels = [GivenLabel(path, part.group, part.name) for path, part in named if part.group] if true else []
    graph = build(plant.scene(), labels=labels)
    found = evaluate(graph, Truth.from_json(truth_of(plant))).total.connected
    assert found is not None
    counts = found.edges
    return graph, 2 * counts.n_correct / max(1, counts.n_true + counts.n_predicted)


def halved(vertices: Floats, faces: np.ndarray, point: Floats, normal: Floats) -> tuple[Floats, np.ndarray]:
    """What of a mesh lies behind a plane, triangles on both sides cut at it."""
    above = (vertices - point) @ normal
    kept = [list(vertices)]
    triangles: list[tuple[int, int, int]] = []
    for face in faces.tolist():
        if all(above[i] <= 0 for i in face):
            triangles.append((face[0], face[1], face[2]))
            continue
        ring = []
        for i, j in zip(face, face[1:] + face[:1], strict=True):
            if above[i] <= 0:
                ring.append(i)
            if (above[i] <= 0) != (above[j] <= 0):
                share = above[i] / (above[i] - above[j])
                kept[0].append(vertices[i] + share * (vertices[j] - vertices[i]))
                ring.append(len(kept[0]) - 1)
        triangles += [(ring[0], ring[k], ring[k + 1]) for k in range(1, len(ring) - 1)]
    return np.array(kept[0]), np.array(triangles, np.int32).reshape(-1, 3)


def color_of(component: Component, unit_type: str | None) -> str:
    """By the unit that a mesh was found in, else by what it is."""
    if unit_type is not None:
        return UNITS.get(unit_type, OTHER)
    if component.family == "insulation":
        return JACKET
    return PLATE if component.name in PLATES else PIPE


def near(component: Component, spot: Spot) -> bool:
    """Whether a mesh is in the picture, and not steelwork or ground."""
    if component.group in ASIDE or not component.cluster:
        return False
    low, high = component.vertices.min(axis=0), component.vertices.max(axis=0)
    return bool(np.all(low <= spot.point + 0.7 * spot.width) and np.all(high >= spot.point - 0.7 * spot.width))


def picture(plant: Plant, graph: SceneGraph, case: Case, spot: Spot) -> Image.Image:
    """One spot with the units in colour, the lines, and the joints as balls."""
    level = beside(spot.axis)
    meshes, colors = shown(plant, graph, case, spot, level)
    gone = lacking_pieces(plant, spot) if case.find is at_lack else []
    meshes += [(component.vertices, component.faces) for component in gone]
    colors += [from_hex(LINE)] * len(gone)
    ghosted = np.arange(len(meshes)) >= len(meshes) - len(gone)
    scene = Scene.from_meshes(meshes)
    corners = np.array(list(product((-1, 1), repeat=3)))
    box = spot.point - scene.origin + 0.31 * spot.width * corners
    camera = frame(box, level + [0, 0, 0.42] + 0.35 * np.abs(spot.axis), CELL, margin=0.0)
    paint = Paint(np.array(colors, np.float32), ghosted=ghosted)
    image = Renderer(scene).picture(camera, paint, Look(samples=4, floor=False))
    if case.edges:
        image = with_edges(image, camera, meshes, scene.origin)
    segments, marks = found_lines(graph, spot, scene.origin), found_joints(graph, spot, scene.origin)
    inside = [u for u in graph.units() if within(u.centroid, spot, 0.5)]
    tags = [Tag(place(u.centroid, scene.origin), u.tag, UNITS.get(u.unit_type, OTHER)) for u in inside]
    return annotate(image, camera, segments=segments, marks=marks, tags=tags, size=2.6).image


def beside(axis: Floats) -> Floats:
    """The level direction from which a pipe along an axis is looked at, from the front."""
    level = np.array([-axis[1], axis[0], 0.0])
    long = float(np.linalg.norm(level))
    if long <= 0.2:
        return np.array([0.0, -1.0, 0.0])
    return np.asarray(-level / long if level[1] > 0 else level / long)


def shown(
    plant: Plant, graph: SceneGraph, case: Case, spot: Spot, level: Floats
) -> tuple[list[tuple[Floats, np.ndarray]], list[Colors]]:
    """The meshes of a picture with their colours; what would stand before its matter is left out."""
    types = unit_types(graph)
    meshes: list[tuple[Floats, np.ndarray]] = []
    colors = []
    for path, component in zip(plant.paths(), plant.components, strict=True):
        vertices, faces = component.vertices, component.faces
        if not near(component, spot) or ((vertices - spot.point) @ level).min() > 0.3 * spot.width:
            continue
        if case.cut:
            vertices, faces = halved(vertices, faces, spot.point, level)
        if len(faces):
            meshes.append((vertices, faces))
            color = color_of(component, types.get(path))
            colors.append(from_hex(SECOND if case.pieces and color == PIPE and len(meshes) % 2 else color))
    return meshes, colors


def unit_types(graph: SceneGraph) -> dict[str, str]:
    """The type of the unit that each mesh was found in, by path."""
    return {mesh: unit.unit_type for unit in graph.units() for part in unit.parts for mesh in graph.part(part).meshes}


def within(point: Sequence[float], spot: Spot, share: float) -> bool:
    """Whether a point lies in the cube about a spot, of this share of its width to each side."""
    return bool(np.all(np.abs(np.array(point) - spot.point) < share * spot.width))


def place(point: Sequence[float] | Floats, origin: Floats) -> tuple[float, float, float]:
    """A point relative to the origin of a scene."""
    x, y, z = (float(value) for value in np.asarray(point) - origin)
    return x, y, z


def found_lines(graph: SceneGraph, spot: Spot, origin: Floats) -> list[Segment]:
    """The lines between units, as far as the picture reaches along its pipe."""
    segments = []
    for edge in graph.connections():
        path = np.array(edge.path)
        for a, b in zip(path[:-1], path[1:], strict=True):
            steps = np.linspace(0, 1, 2 + int(20 * np.linalg.norm(b - a) / spot.width))[:, None]
            points = a + steps * (b - a)
            ahead = (points - spot.point) @ spot.axis
            aside = np.linalg.norm(points - spot.point - ahead[:, None] * spot.axis, axis=1)
            held = (np.abs(ahead) < 1.3 * spot.width) & (aside < 0.6 * spot.width)
            for k in np.flatnonzero(held[:-1] & held[1:]).tolist():
                segments.append(Segment(place(points[k], origin), place(points[k + 1], origin), LINE, 3.0))
    return segments


def found_joints(graph: SceneGraph, spot: Spot, origin: Floats) -> list[Mark]:
    """The joints near a spot that were made, and those that were not though not unlikely."""
    joints = [j for j in graph.joints() if within(j.point, spot, 0.6) and (j.made or j.score > 0.1)]
    return [Mark(place(j.point, origin), MADE if j.made else FREE, 3.5) for j in joints]


def with_edges(
    image: Image.Image, camera: Camera, meshes: Sequence[tuple[Floats, np.ndarray]], origin: Floats
) -> Image.Image:
    """The picture with the edges of those triangles that look at the camera."""
    zoom = 3
    layer = Image.new("RGBA", (zoom * image.width, zoom * image.height), (20, 30, 45, 0))
    draw = ImageDraw.Draw(layer)
    for vertices, faces in meshes:
        local = vertices - origin
        corners = local[faces]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        seen = np.einsum("ij,ij->i", normal, corners[:, 0] - camera.eye) < 0
        places, _ = camera.project(local)
        for face in faces[seen]:
            draw.polygon([tuple(zoom * places[i]) for i in face], outline=(20, 30, 45, 130))
    return Image.alpha_composite(image.convert("RGBA"), layer.reduce(zoom)).convert("RGB")


def cell(name: str, case: Case) -> Image.Image:
    """A picture above its caption."""
    plant = make(PRESET, SEED, STYLE, DEFECTS.get(name, Defects()))
    graph, true = graph_of(plant, True)
    _, embedded = graph_of(plant, False)
    sys.stdout.write(f"{name}: F1 {true:.3f} with true labels, {embedded:.3f} embedded\n")
    result = Image.new("RGB", (CELL[0], CELL[1] + CAPTION), "white")
    spot = case.find(plant, graph)
    result.paste(picture(plant, graph, case, spot), (0, 0))
    draw = ImageDraw.Draw(result)
    here = "" if spot.joint is None else f"; here {abs(1000 * spot.joint.gap):.1f} mm, {spot.joint.score:.0%} sure"
    lines = ((name, 17, "#111827"), (case.says + here, 12.5, "#374151"))
    for k, (text, size, color) in enumerate(lines):
        draw.text((8, CELL[1] + 4 + 21 * k), text, color, ImageFont.load_default(size))
    figures = f"F1 {true:.2f} true labels, {embedded:.2f} embedded"
    draw.text((8, CELL[1] + 43), figures, "#14532d", ImageFont.load_default(13))
    return result


def legend() -> Image.Image:
    """What the colours mean."""
    result = Image.new("RGB", (CELL[0], CELL[1] + CAPTION), "white")
    draw = ImageDraw.Draw(result)
    rows = [(UNITS["valve"], "valve that was found"), (UNITS["gauge"], "gauge"), (UNITS["pump"], "pump")]
    rows += [(PIPE, "pipe and fittings"), (PLATE, "flanges, gaskets, bolts"), (JACKET, "insulation")]
    rows += [(LINE, "line between units"), (MADE, "joint that was made"), (FREE, "joint that was not made")]
    for k, (color, text) in enumerate(rows):
        draw.rectangle((16, 16 + 30 * k, 44, 34 + 30 * k), fill=color)
        draw.text((56, 16 + 30 * k), text, "#111827", ImageFont.load_default(15))
    return result


def sheet(cells: Sequence[Image.Image]) -> Image.Image:
    """Pictures in rows."""
    width, height = CELL[0], CELL[1] + CAPTION
    rows = -(-len(cells) // COLUMNS)
    result = Image.new("RGB", (COLUMNS * (width + 6), rows * (height + 6)), "white")
    for k, image in enumerate(cells):
        result.paste(image, (k % COLUMNS * (width + 6), k // COLUMNS * (height + 6)))
    return result


def main() -> None:
    """Draws all, or those that are asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("path", type=Path, nargs="?", default=Path("docs") / "defects.jpg")
    parser.add_argument("--only", nargs="+", default=list(CASES), choices=list(CASES))
    options = parser.parse_args()
    cells = [*(cell(name, CASES[name]) for name in options.only), legend()]
    content = io.BytesIO()
    sheet(cells).save(content, "JPEG", quality=86, optimize=True)
    write_atomically(options.path, content.getvalue())


if __name__ == "__main__":
    main()
