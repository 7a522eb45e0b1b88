import json
from dataclasses import replace

import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import cadgraph
import shapes
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.records import Adjacent, Contains, Related
from cadgraph.model.scene import Scene
from cadgraph.model.vocabulary import Vocabulary

METHODS = ["exact", "paper"]
PATHS = ["/p0", "/v1", "/p2", "/v3", "/bolt4", "/lone5", "/g6", "/floor7"]
LABELS = [
    GivenLabel("/p0", "Pipe assembly", "pipe"),
    GivenLabel("/v1", "Valve assembly", "valve"),
    GivenLabel("/p2", "Pipe assembly", "pipe"),
    GivenLabel("/v3", "Valve assembly", "valve"),
    GivenLabel("/g6", "Gauge assembly", "gauge"),
    GivenLabel("/floor7", "Structural element", "ground"),
]


def line(shift=(0.0, 0.0, 0.0)):
    """A pipe, a valve, a pipe with a gauge, a valve; a bolt on the first valve; a lone box; a floor."""
    along = [
        shapes.cylinder(0.05, 0.5),
        shapes.cylinder(0.08, 0.2),
        shapes.cylinder(0.05, 0.6),
        shapes.cylinder(0.08, 0.2),
    ]
    heights = [0.25, 0.6, 1.0, 1.4]
    meshes = [shapes.moved(m, translation=(0, 0, 1 + h)) for m, h in zip(along, heights, strict=True)]
    meshes.append(shapes.box((0.008, 0.008, 0.008), (0.082, 0, 1.6)))
    meshes.append(shapes.box((0.3, 0.3, 0.3), (2.0, 0, 1.0)))
    meshes.append(shapes.box((0.1, 0.03, 0.03), (0.1, 0, 2.0)))
    meshes.append(shapes.box((8.0, 8.0, 0.1), (0, 0, -0.05)))
    return [shapes.moved(m, translation=shift) for m in meshes]


def built(meshes, method, paths=PATHS, labels=LABELS):
    config = cadgraph.Config().replace({"method": method, "label.labeler": "none"})
    return cadgraph.build(Scene.from_meshes(meshes, paths), config, labels=labels)


def structure(graph):
    """What a graph says, free of ids, order and pose."""
    head = {part.id: part.meshes[0] for part in graph.parts()}
    unit = {u.id: frozenset(head[p] for p in u.parts) for u in graph.units()}
    return {
        "parts": {frozenset(p.meshes) for p in graph.parts()},
        "ground": {p.meshes[0] for p in graph.parts() if p.ground},
        "clusters": {(c.kind, frozenset(head[p.id] for p in graph.parts(cluster=c.id))) for c in graph.clusters()},
        "adjacent": {frozenset((head[e.source], head[e.target])) for e in graph.of_kind(Adjacent)},
        "distances": sorted(round(e.distance, 6) for e in graph.of_kind(Adjacent)),
        "units": set(unit.values()),
        "related": {frozenset((unit[e.source], unit[e.target])) for e in graph.of_kind(Related)},
        "sizes": sorted((round(p.area, 7), *(round(x, 7) for x in p.obb.extents)) for p in graph.parts()),
    }


def floor_of(graph):
    return graph.part(next(p.id for p in graph.parts() if "/floor7" in p.meshes))


def test_the_ground_carries_its_name_for_the_reason_it_is_the_ground():
    label = floor_of(built(line(), "exact", labels=())).label
    assert (label.said, label.source) == (("Structural element", "ground"), "geometry")
    assert "lowest" in label.evidence.why


def test_a_name_that_is_given_counts_more_than_that_of_the_ground():
    given = (GivenLabel("/floor7", "Structural element", "foundation"),)
    floor = floor_of(built(line(), "exact", labels=given))
    assert floor.ground
    assert floor.label.name == "foundation"


def test_a_vocabulary_without_the_ground_leaves_it_without_a_name():
    tree = Vocabulary.from_json({"Pipe": {"names": ["pipe"]}})
    config = cadgraph.Config().replace({"label.labeler": "none"})
    floor = floor_of(cadgraph.build(Scene.from_meshes(line(), PATHS), config, vocabulary=tree))
    assert floor.ground
    assert floor.label is None


@pytest.mark.parametrize("method", METHODS)
def test_the_method_from_meshes_to_relations(method):
    graph = built(line(), method)
    assert structure(graph) | {"sizes": [], "distances": []} == {
        "parts": {
            frozenset(p) for p in (["/p0"], ["/v1", "/bolt4"], ["/p2"], ["/v3"], ["/lone5"], ["/g6"], ["/floor7"])
        },
        "ground": {"/floor7"},
        "clusters": {("pipe system", frozenset({"/p0", "/v1", "/p2", "/v3", "/g6"})), (None, frozenset({"/lone5"}))},
        "adjacent": {frozenset(p) for p in (("/p0", "/v1"), ("/v1", "/p2"), ("/p2", "/v3"), ("/p2", "/g6"))},
        "units": {frozenset({"/v1"}), frozenset({"/v3"}), frozenset({"/g6"})},
        # The gauge comes first by tag and claims the pipe, so each valve relates to it: the paper's own ambiguity.
        "related": {
            frozenset({frozenset({"/g6"}), frozenset({"/v1"})}),
            frozenset({frozenset({"/g6"}), frozenset({"/v3"})}),
        },
        "sizes": [],
        "distances": [],
    }


@pytest.mark.parametrize("method", METHODS)
def test_every_mesh_is_in_exactly_one_part(method):
    graph = built(line(), method)
    assert sorted(m for p in graph.parts() for m in p.meshes) == sorted(PATHS)
    contained = [e.target for e in graph.of_kind(Contains) if e.target.startswith("part-") and "unit" not in e.source]
    assert sorted(contained) == sorted(p.id for p in graph.parts())


@pytest.mark.parametrize("method", METHODS)
@settings(max_examples=10, deadline=None)
@given(order=st.permutations(range(len(PATHS))))
def test_the_order_of_meshes_does_not_matter(method, order):
    meshes = line()
    shuffled = built([meshes[i] for i in order], method, [PATHS[i] for i in order])
    straight = built(meshes, method)
    assert shuffled.to_json() == straight.to_json()


@settings(max_examples=15, deadline=None)
@given(
    st.tuples(*[st.floats(-3, 3)] * 3),
    st.tuples(*[st.floats(-500, 500)] * 3).map(lambda t: tuple(round(x, 3) for x in t)),
)
def test_exact_graphs_do_not_depend_on_the_pose(angles, shift):
    from scipy.spatial.transform import Rotation

    # Without the floor, which needs 'down' to be down.
    turn = Rotation.from_euler("xyz", angles).as_matrix()
    moved = [shapes.moved(mesh, turn, shift) for mesh in line()[:-1]]
    assert structure(built(moved, "exact", PATHS[:-1], LABELS[:-1])) == structure(
        built(line()[:-1], "exact", PATHS[:-1], LABELS[:-1])
    )


@settings(max_examples=10, deadline=None)
@given(st.tuples(*[st.integers(-5000, 5000)] * 3), st.integers(0, 3))
def test_paper_graphs_do_not_depend_on_moves_that_keep_the_grid(cells, quarter):
    # The paper's voxel grid is fixed in space: only whole cells and quarter turns keep it. Off the borders of
    # voxels, where a turn would change which side a vertex rounds to.
    turn = np.round(
        [
            [np.cos(quarter * np.pi / 2), -np.sin(quarter * np.pi / 2), 0],
            [np.sin(quarter * np.pi / 2), np.cos(quarter * np.pi / 2), 0],
            [0, 0, 1],
        ]
    )
    off = (0.0031, 0.0023, 0.0017)
    moved = [shapes.moved(shapes.moved(mesh, turn), translation=np.array(cells) * 0.01) for mesh in line(off)]
    assert structure(built(moved, "paper")) == structure(built(line(off), "paper"))


@pytest.mark.parametrize("method", METHODS)
def test_the_same_scene_gives_the_same_bytes(method, tmp_path):
    for name in ("a", "b"):
        built(line(), method).save(tmp_path / name)
    assert (tmp_path / "a/graph.json").read_bytes() == (tmp_path / "b/graph.json").read_bytes()


def test_the_scene_is_not_changed():
    scene = Scene.from_meshes(line(), PATHS)
    before = scene.vertices.copy(), scene.faces.copy(), scene.paths
    cadgraph.build(scene)
    assert np.array_equal(scene.vertices, before[0])
    assert np.array_equal(scene.faces, before[1])
    assert scene.paths == before[2]


@pytest.mark.parametrize("method", METHODS)
def test_an_empty_scene_gives_a_site_alone(method):
    graph = built([], method, [], [])
    assert [n.id for n in graph.document.nodes] == ["site"]


@pytest.mark.parametrize("method", METHODS)
def test_a_mesh_without_area_is_a_part_of_its_own(method):
    flat = (np.zeros((3, 3)), np.array([[0, 1, 2]]))
    graph = built([flat, shapes.box(center=(2, 0, 0))], method, ["/flat", "/box"], [])
    assert sorted(m for p in graph.parts() for m in p.meshes) == ["/box", "/flat"]
    json.dumps(graph.to_json(), allow_nan=False)


@pytest.mark.parametrize("method", METHODS)
def test_meshes_without_a_finite_vertex_are_named_in_diagnostics(method):
    nothing = (np.zeros((0, 3)), np.zeros((0, 3), int))
    infinite = (np.full((3, 3), np.inf), np.array([[0, 1, 2]]))
    vertices, faces = shapes.box()
    vertices = np.concatenate([vertices, [[np.nan, 0, 0]]])
    faces = np.concatenate([faces, [[0, 1, 8]]])
    graph = built([nothing, infinite, (vertices, faces)], method, ["/nothing", "/infinite", "/box"], [])
    assert [m for p in graph.parts() for m in p.meshes] == ["/box"]
    assert graph.parts()[0].volume == pytest.approx(1.0)
    found = {f.code: set(f.meshes) for f in graph.diagnostics}
    assert found["empty-mesh"] == {"/nothing", "/infinite"}
    assert found["nonfinite-vertices"] == {"/infinite", "/box"}


def test_a_face_that_refers_to_no_vertex_is_an_error():
    with pytest.raises(ValueError, match="/bad"):
        built([(np.zeros((3, 3)), [[0, 1, 3]])], "exact", ["/bad"], [])


def test_networkx_reads_the_file_as_it_is(tmp_path):
    path = built(line(), "exact").save(tmp_path)
    graph = nx.node_link_graph(json.loads(path.read_text()), edges="edges", multigraph=True)
    assert graph.number_of_nodes() == len(built(line(), "exact").nodes)
    assert graph.is_directed()
    assert graph.is_multigraph()


def test_a_label_for_a_mesh_that_is_not_there_is_an_error():
    with pytest.raises(cadgraph.LabelError, match="/nowhere"):
        built(line(), "exact", labels=[GivenLabel("/nowhere", "Tank", None)])


def test_the_origin_only_moves_coordinates():
    near = built(line(), "exact")
    scene = Scene.from_meshes(line(), PATHS)
    far = cadgraph.build(
        replace(scene, origin=np.array([2.4e7, -1e6, 0.0])),
        cadgraph.Config().replace({"label.labeler": "none"}),
        labels=LABELS,
    )
    assert structure(far) == structure(near)
    assert far.parts()[0].centroid[0] == pytest.approx(near.parts()[0].centroid[0] + 2.4e7, abs=1e-6)


@pytest.mark.parametrize("method", METHODS)
@settings(max_examples=8, deadline=None)
@given(unit=st.sampled_from([1.0, 0.01, 0.001, 0.0254, 0.3048, 12.5]), up=st.sampled_from("XYZ"))
def test_authored_units_and_up_axis_do_not_matter(tmp_path_factory, method, unit, up):
    from pxr import Gf, Sdf, Usd, UsdGeom, Vt

    # Z up to the axis that the file has up; off the borders of voxels, which float32 coordinates would blur.
    turn = {"X": [[0, 0, 1], [1, 0, 0], [0, 1, 0]], "Y": [[0, 1, 0], [0, 0, 1], [1, 0, 0]], "Z": np.eye(3)}[up]
    off = (0.0031, 0.0023, 0.0017)
    path = str(tmp_path_factory.mktemp("units") / "scene.usda")
    layer = Sdf.Layer.CreateNew(path)
    stage = Usd.Stage.Open(layer)
    UsdGeom.SetStageMetersPerUnit(stage, unit)
    if up == "X":
        stage.SetMetadata("upAxis", "X")
    else:
        UsdGeom.SetStageUpAxis(stage, up)
    for name, (vertices, faces) in zip(PATHS, line(off), strict=True):
        mesh = UsdGeom.Mesh.Define(stage, name)
        mesh.CreatePointsAttr(Vt.Vec3fArray([Gf.Vec3f(*p) for p in (vertices @ np.transpose(turn) / unit).tolist()]))
        mesh.CreateFaceVertexCountsAttr([3] * len(faces))
        mesh.CreateFaceVertexIndicesAttr(faces.reshape(-1).tolist())
    stage.Save()
    scene = cadgraph.load(path, cadgraph.Config().load.model_copy(update={"isolate": False}))
    config = cadgraph.Config().replace({"method": method, "label.labeler": "none"})
    found, expected = structure(cadgraph.build(scene, config, labels=LABELS)), structure(built(line(off), method))
    for key in ("distances", "sizes"):  # float32 in the file
        assert np.allclose(found.pop(key), expected.pop(key), atol=2e-5)
    assert found == expected


@pytest.mark.parametrize("what", [None, "plant.usd", 3])
def test_what_is_no_scene_is_a_type_error(what):
    with pytest.raises(TypeError, match=r"build takes a Scene, as cadgraph.load returns it"):
        cadgraph.build(what)


def test_settings_as_a_dictionary_are_a_type_error():
    with pytest.raises(TypeError, match="build takes a Config, not dict"):
        cadgraph.build(Scene.from_meshes([shapes.box()]), {"cluster.eps": 1})
