"""A little plant and its graph, written by hand: a pipe with a valve and a gauge, a tank, a mystery, the ground."""

from dataclasses import replace

import numpy as np
import pytest

import shapes
from cadgraph.config import Config
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import Label
from cadgraph.model.records import (
    Adjacent,
    Cluster,
    Contains,
    GraphDocument,
    OrientedBox,
    Part,
    Related,
    Site,
    SourceRecord,
    Unit,
)
from cadgraph.model.scene import Scene, Source
from cadgraph.model.vocabulary import default_vocabulary

ALONG_X = np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]], float)
MESHES = {
    "/World/pipe": (shapes.moved(shapes.cylinder(0.05, 2.0), ALONG_X), ("Pipe assembly", "pipe"), 0),
    "/World/<script>alert(1)</script>": (shapes.sphere(0.12), ("Valve assembly", "valve body"), 0),
    "/World/wheel": (shapes.moved(shapes.tube(0.1, 0.08, 0.02), translation=(0, 0, 0.2)), ("Valve assembly", None), 0),
    "/World/case": (
        shapes.moved(shapes.cylinder(0.06, 0.04), translation=(0.6, 0, 0.2)),
        ("Gauge assembly", "gauge"),
        0,
    ),
    "/World/shell": (shapes.moved(shapes.cylinder(0.3, 1.0), translation=(-1, 1.5, 0)), ("Tank", "shell"), 1),
    "/World/mystery": (shapes.box((0.3, 0.3, 0.3), (1, 1.5, -0.3)), None, 2),
    "/World/floor": (shapes.box((8, 8, 0.02), (0, 0, -0.6)), None, None),
}
KINDS = ("pipe system", "Tank", None)


def _triple(row):
    x, y, z = (float(c) for c in row)
    return x, y, z


def _box(points):
    return _triple(points.min(axis=0)), _triple(points.max(axis=0))


def make_scene(origin=(0.0, 0.0, 0.0), meshes=MESHES):
    scene = Scene.from_meshes(
        [mesh for mesh, _, _ in meshes.values()],
        list(meshes),
        source=Source(path="plant/<b>demo</b>.usd", format="usd"),
    )
    return replace(scene, origin=np.array(origin))


def make_graph(origin=(0.0, 0.0, 0.0), meshes=MESHES, **changes):
    nodes, edges = [], []
    by_cluster = {}
    parts = {}
    for i, (path, ((vertices, faces), label, cluster)) in enumerate(meshes.items()):
        world = vertices + np.array(origin)
        low, high = _box(world)
        part = Part(
            id=f"part-{i:05d}", meshes=(path,), centroid=_triple(world.mean(axis=0)), aabb=(low, high),
            label=label and Label(group=label[0], name=label[1], confidence=0.8, source="geometry"),
            obb=OrientedBox(center=low, axes=((1, 0, 0), (0, 1, 0), (0, 0, 1)), extents=_triple(np.abs(high))),
            area=1.0, volume=None, n_triangles=len(faces), shape=f"shape-{i}", ground=cluster is None,
        )  # fmt: skip
        parts[path] = part
        nodes.append(part)
        by_cluster.setdefault(cluster, []).append(part)
    clusters = []
    for number, members in sorted((n, m) for n, m in by_cluster.items() if n is not None):
        corners = np.array([corner for part in members for corner in part.aabb])
        clusters.append(
            Cluster(
                id=f"cluster-{number:03d}", kind=KINDS[number], n_parts=len(members), aabb=_box(corners),
                centroid=_triple(corners.mean(axis=0)),
            )
        )  # fmt: skip
        edges.append(Contains(source="site", target=clusters[-1].id))
        edges += [Contains(source=clusters[-1].id, target=part.id) for part in members]
    units = []
    if len(meshes) > 3:
        for tag, unit_type, paths in (
            ("V-001", "valve", ["/World/<script>alert(1)</script>", "/World/wheel"]),
            ("G-001", "gauge", ["/World/case"]),
        ):
            members = [parts[path] for path in paths]
            corners = np.array([corner for part in members for corner in part.aabb])
            units.append(
                Unit(
                    id=f"unit-{tag}", unit_type=unit_type, tag=tag, parts=tuple(part.id for part in members),
                    centroid=_triple(corners.mean(axis=0)), aabb=_box(corners),
                )
            )  # fmt: skip
        edges.append(Adjacent(source="part-00000", target="part-00001", distance=0.0, point=(0, 0, 0)))
        edges.append(Related(source="unit-V-001", target="unit-G-001"))
    n_triangles = sum(len(faces) for (_, faces), _, _ in meshes.values())
    document = GraphDocument(
        source=SourceRecord(path="plant/<b>demo</b>.usd", n_meshes=len(meshes), n_triangles=n_triangles),
        vocabulary=default_vocabulary().to_json(),
        config=Config().model_dump(mode="json"),
        nodes=(Site(id="site"), *clusters, *nodes, *units),
        edges=tuple(edges),
        diagnostics=(
            Diagnostic(code="unlabelled", message="1 part <i>unsure</i>", meshes=("/World/mystery",)),
            *(Diagnostic(code="many", message=f"finding {i}", meshes=(f"/World/m{i}",)) for i in range(100)),
        ),
    )
    return SceneGraph(document.model_copy(update=changes))


@pytest.fixture(scope="session")
def scene():
    return make_scene()


@pytest.fixture(scope="session")
def graph():
    return make_graph()


@pytest.fixture(scope="session")
def build_scene():
    return make_scene


@pytest.fixture(scope="session")
def build_graph():
    return make_graph


@pytest.fixture(scope="session")
def one_mesh():
    path = next(iter(MESHES))
    return {path: MESHES[path]}
