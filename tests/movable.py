"""A plant of three valves and two gauges, of which it is known by construction what moves."""

from __future__ import annotations

import json

import numpy as np

import graphs
from cadgraph.config import LoadConfig
from cadgraph.load import load
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import Label
from cadgraph.model.records import Dial, GraphDocument, Mechanism, Site, SourceRecord, Unit, points
from cadplants import UsdStyle, truth_path
from cadplants.model.plant import Component, Plant
from cadplants.model.plant import Unit as PlantUnit
from cadplants.solids.mesh_ops import merge, moved
from cadplants.solids.primitives import along, box, cylinder, torus
from cadplants.solids.transforms import at, spun
from cadplants.writers import write_plant

RED, BLUE, GREY = (0.7, 0.1, 0.1), (0.1, 0.2, 0.6), (0.5, 0.5, 0.55)
RADIUS, THICK, LONG = 0.1, 0.008, 0.2
_VALVE, _GAUGE = "Valve assembly", "Gauge assembly"

CONFIG = {"load": {"isolate": False}}
QUICK = LoadConfig(isolate=False)
"""To read in this process, which takes a tenth of the time."""

POSES = {
    "V-1": at(0.3, 0.2, 1.0),
    "V-2": at(1.3, 0.2, 1.0) @ spun("y", 0.7),
    "V-3": at(2.3, 0.2, 1.0) @ spun("z", 0.3),
    "G-1": at(3.3, 0.2, 1.0) @ spun("x", 1.1),
    "G-2": at(4.3, 0.2, 1.0),
}
"""Where each unit stands; its axis is z there."""

MOVES = {"V-1": "handwheel", "V-2": "handwheel", "V-3": "lever", "G-1": "gauge needle"}
"""What is called so moves."""


def plant():
    """Fifteen meshes; shapes repeat, so that they may be instances."""
    body = along("x", cylinder(0.06, -0.1, 0.1, 16))
    stem = cylinder(0.012, 0.05, 0.2, 12)
    wheel = moved(
        merge([torus(RADIUS, THICK, 24), box((2 * RADIUS, 0.01, 0.01)), box((0.03, 0.03, 0.02))]), at(0, 0, 0.2)
    )
    lever = moved(box((LONG, 0.03, 0.01), (LONG / 2, 0, 0)), at(0, 0, 0.2))
    case = cylinder(0.05, 0.0, 0.03, 24)
    face = cylinder(0.045, 0.03, 0.032, 24)
    needle = moved(box((0.035, 0.003, 0.001), (0.0125, 0, 0)), at(0, 0, 0.034))
    bolt = cylinder(0.005, 0.0, 0.03, 8)
    turned = [(body, _VALVE, "valve body", BLUE), (stem, _VALVE, "valve stem", GREY)]
    read = [(case, _GAUGE, "gauge case", GREY), (face, _GAUGE, "gauge face", BLUE)]
    of_unit = {
        "V-1": [*turned, (wheel, _VALVE, "handwheel", RED)],
        "V-2": [*turned, (wheel, _VALVE, "handwheel", RED)],
        "V-3": [*turned, (lever, _VALVE, "lever", RED)],
        # As labels go, a needle is too small for a part of its own.
        "G-1": [*read, (needle, _GAUGE, "gauge face", RED)],
        "G-2": read,
    }
    components = [
        Component(solid, group, name, color, POSES[tag], unit=tag)
        for tag, solids in of_unit.items()
        for solid, group, name, color in solids
    ]
    components += [Component(bolt, "Connection assembly", "bolt", GREY, at(x, 0.5, 0.5)) for x in (0.0, 0.4)]
    components.append(
        Component(along("x", cylinder(0.06, 0.0, 4.0, 16)), "Pipe assembly", "pipe", BLUE, at(0.3, -2, 1))
    )
    units = [PlantUnit(tag, "gauge" if tag[0] == "G" else "valve", "") for tag in of_unit]
    return Plant(tuple(components), units=tuple(units), name="movable", seed=3, styles=("plant-design",))


def write(path, style=None):
    """The plant as a file, and its graph with its mechanisms; nothing is built, as all is known."""
    made = plant()
    write_plant(made, path, style)
    scene = load(path, QUICK)
    truth = json.loads(truth_path(path).read_text())["meshes"]
    paths = [each["mesh"] for each in truth]
    return graph_of(scene, made, paths)


def shown(path):
    """What a file shows, whatever it is called: corners of boxes, numbers of triangles, colours; in order."""
    # What is written of a plant lies over it, in a folder beside it.
    scene = load(path, QUICK.model_copy(update={"asset_roots": ("..",)}))
    rows = [
        (*np.round(scene.mesh(i)[0].min(0), 5), *np.round(scene.mesh(i)[0].max(0), 5), len(scene.mesh(i)[1]))
        for i in range(scene.n_meshes)
    ]
    order = sorted(range(len(rows)), key=rows.__getitem__)
    colors = np.nan_to_num(scene.colors[order], nan=-1.0)
    return np.array([rows[i] for i in order]), colors


def graph_of(scene, made, paths):
    """The graph of the plant whose meshes are at these paths."""
    row = {path: i for i, path in enumerate(scene.paths)}
    parts, held = [], {}
    for number, (component, path) in enumerate(zip(made.components, paths, strict=True)):
        low, high = (tuple(f(scene.mesh(row[path])[0], axis=0).tolist()) for f in (np.min, np.max))
        label = Label(group=component.group, name=component.name, confidence=1.0, source="file")
        parts.append(graphs.part(number, path, label=label, aabb=(low, high)))
        held.setdefault(component.unit, []).append((component, parts[-1], path))
    units = [_unit(unit, held[unit.id]) for unit in made.units]
    record = SourceRecord(path=scene.source.path, sha256=scene.source.sha256)
    return SceneGraph(GraphDocument(nodes=(Site(id="site"), *parts, *units), edges=(), source=record, config=CONFIG))


def _unit(unit, held):
    pose, kind = POSES[unit.id], MOVES.get(unit.id)
    turns = [path for component, _, path in held if component.name == kind]
    if unit.id == "G-1":
        turns = [held[-1][2]]
    return Unit(
        id=f"unit-{unit.id}",
        unit_type=unit.type,
        tag=unit.id,
        parts=tuple(part.id for _, part, _ in held),
        centroid=held[0][1].centroid,
        aabb=held[0][1].aabb,
        mechanism=mechanism(unit.id, tuple(turns)) if kind else None,
        dial=dial(pose) if unit.type == "gauge" else None,
        affordances=("read",) if unit.type == "gauge" else ("pull",) if kind == "lever" else ("turn",),
    )


def mechanism(tag, meshes, pieces=()):
    """What moves at a unit of the plant."""
    pose = POSES[tag]
    height = 0.034 if tag == "G-1" else 0.2
    pivot, axis = points([pose[:3, :3] @ (0, 0, height) + pose[:3, 3], pose[:3, 2]])
    wheel = {"kind": "handwheel", "radius": RADIUS, "limits": (-3600.0, 0.0), "open": 0.0, "shut": -3600.0}
    lever = {"kind": "lever", "radius": LONG, "limits": (-90.0, 0.0), "open": 0.0, "shut": -90.0}
    needle = {"kind": "needle", "radius": 0.03, "limits": (-270.0, 0.0)}
    more = lever if tag == "V-3" else needle if tag == "G-1" else wheel
    sources = {"axis": "by construction"}
    thickness = None if tag == "G-1" else THICK
    return Mechanism(meshes=meshes, pieces=pieces, axis=axis, pivot=pivot, thickness=thickness, sources=sources, **more)


def dial(pose):
    """The face of a gauge of the plant."""
    center, normal, up = points([pose[:3, :3] @ (0, 0, 0.032) + pose[:3, 3], pose[:3, 2], pose[:3, 1]])
    return Dial(center=center, normal=normal, radius=0.045, up=up)


STYLES = {
    "plain": UsdStyle(),
    "native": UsdStyle(instances="native", up_axis="Y", meters_per_unit=0.01),
    "nested": UsdStyle(instances="nested", meters_per_unit=1.0, skewed=True),
    "point": UsdStyle(instances="point", up_axis="Y", meters_per_unit=0.0254, skewed=True),
    "mixed": UsdStyle(instances="mixed", polygons=1.0, colors=False),
}
"""Ways to put it down: instances, unit, up axis."""
