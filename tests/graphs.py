"""Small scene graphs for tests."""

from __future__ import annotations

import numpy as np

import shapes
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import Label
from cadgraph.model.records import (
    Adjacent,
    Cluster,
    Connected,
    Contains,
    GraphDocument,
    Joint,
    OrientedBox,
    Part,
    Related,
    Site,
    SourceRecord,
    System,
    Terminal,
    Unit,
)
from cadgraph.model.scene import Scene, Source

ORIGIN = (0.0, 0.0, 0.0)


def box(size=1.0):
    half = size / 2
    return (-half, -half, -half), (half, half, half)


def label(group="Valve assembly", name="valve body", confidence=0.75, source="geometry", **evidence):
    return Label(group=group, name=name, confidence=confidence, source=source, evidence=evidence)


def part(number, *meshes, label=None, size=1.0, **more):
    values = {
        "id": f"part-{number}",
        "meshes": meshes or (f"/mesh_{number}",),
        "label": label,
        "centroid": (float(number), 0.0, 0.0),
        "aabb": box(size),
        "obb": OrientedBox(
            center=ORIGIN, axes=((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)), extents=(size, size, size)
        ),
        "area": 6 * size**2,
        "volume": size**3,
        "n_triangles": 12,
        "shape": "shape-0",
    }
    return Part(**{**values, **more})


def unit(tag, *parts, unit_type="valve", kind=None):
    return Unit(id=f"unit-{tag}", unit_type=unit_type, tag=tag, kind=kind, parts=parts, centroid=ORIGIN, aabb=box())


def cluster(number, n_parts, kind=None):
    return Cluster(id=f"cluster-{number}", kind=kind, n_parts=n_parts, centroid=ORIGIN, aabb=box())


def graph(nodes=(), edges=(), **more):
    return SceneGraph(
        GraphDocument(
            nodes=(Site(id="site"), *nodes), edges=tuple(edges), source=SourceRecord(path="plant.usd"), **more
        )
    )


def labelled(scene_or_paths, group="Pipe assembly", name="pipe"):
    """One labelled part for each mesh."""
    paths = getattr(scene_or_paths, "paths", scene_or_paths)
    return graph(part(i, path, label=label(group, name)) for i, path in enumerate(paths))


def joint(first="part-0", second="part-2", **more):
    values = {"kind": "face", "point": ORIGIN, "gap": 0.004, "score": 0.875, "made": True, "reasons": ("axes aligned",)}
    return Joint(first=first, second=second, **{**values, **more})


def valve_line(**more):
    """valve V-001 - pipe - valve V-002, with a gauge apart; meshes /mesh_0 to /mesh_4."""
    nodes = [
        cluster(0, 4, "pipe system"),
        cluster(1, 1, "Gauge assembly"),
        part(0, label=label(name="valve body", fit="box")),
        part(1, label=label(name="handwheel"), size=0.5),
        part(2, label=label("Pipe assembly", None, 0.9), size=2.0),
        part(3, label=label(name="valve")),
        part(4, volume=None),
        unit("V-001", "part-0", "part-1", kind="ball valve"),
        unit("V-002", "part-3"),
        unit("G-001", "part-4", unit_type="gauge"),
        Terminal(id="end-0", point=(1.0, 2.0, 3.0), parts=("part-2",)),
        System(id="system-0", units=("unit-V-001", "unit-V-002"), length=1.5),
    ]
    edges = [
        *(Contains(source="site", target=f"cluster-{i}") for i in range(2)),
        *(Contains(source="cluster-0", target=f"part-{i}") for i in range(4)),
        Contains(source="cluster-1", target="part-4"),
        *(Contains(source="unit-V-001", target=f"part-{i}") for i in range(2)),
        Contains(source="unit-V-002", target="part-3"),
        Contains(source="unit-G-001", target="part-4"),
        *(Contains(source="system-0", target=f"unit-V-00{i}") for i in (1, 2)),
        Adjacent(source="part-0", target="part-1", distance=0.0, point=ORIGIN),
        Adjacent(source="part-0", target="part-2", distance=0.004, point=(0.5, 0.0, 0.0)),
        Adjacent(source="part-2", target="part-3", distance=0.0, point=(1.0, 0.0, 0.0)),
        Related(source="unit-V-001", target="unit-V-002"),
        Connected(
            source="unit-V-002", target="unit-V-001", via=("part-2",), length=1.5, direction="backward", reason="check"
        ),
        Connected(source="unit-V-002", target="end-0", direction="unknown"),
    ]
    return graph(nodes, edges, **more)


def boxes(paths, spacing=2.0, **source):
    """A scene of unit boxes in a row."""
    meshes = [shapes.box(center=(spacing * i, 0.0, 0.0)) for i in range(len(paths))]
    colors = np.tile(np.float32([0.2, 0.4, 0.6]), (len(paths), 1))
    return Scene.from_meshes(meshes, paths, colors, Source(**source))
