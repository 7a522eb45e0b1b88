from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import shapes
from cadgraph.model.scene import Scene, Source, mesh_of_face, mesh_of_vertex

MESHES = [shapes.box(), shapes.cylinder(sides=5), shapes.tube(sides=4), shapes.sphere(sides=6, rings=3)]


def packed(order=range(4), **more):
    return Scene.from_meshes([MESHES[i] for i in order], [f"/m{i}" for i in order], **more)


def assert_same(one, two):
    for name in ("vertices", "faces", "vertex_offsets", "face_offsets", "colors", "origin"):
        np.testing.assert_array_equal(getattr(one, name), getattr(two, name), err_msg=name)
    for name in ("paths", "anchors", "source", "diagnostics"):
        assert getattr(one, name) == getattr(two, name)


def test_packing_keeps_every_mesh():
    scene = packed()
    assert scene.n_meshes == 4
    assert scene.n_triangles == sum(len(f) for _, f in MESHES)
    for i, (vertices, faces) in enumerate(MESHES):
        np.testing.assert_array_equal(scene.mesh(i)[0], vertices)
        np.testing.assert_array_equal(scene.mesh(i)[1], faces)


def test_packing_copies():
    vertices, faces = shapes.box()
    scene = Scene.from_meshes([(vertices, faces)])
    vertices[:] = 7
    assert scene.vertices.max() == 0.5


def test_types_are_those_of_the_format():
    scene = packed()
    assert scene.vertices.dtype == np.float64
    assert scene.faces.dtype == np.int32
    assert scene.vertex_offsets.dtype == scene.face_offsets.dtype == np.int64
    assert scene.colors.dtype == np.float32


def test_names_and_colors_have_defaults():
    scene = Scene.from_meshes(MESHES[:2])
    assert scene.paths == ("/mesh_0", "/mesh_1")
    assert np.isnan(scene.colors).all()
    assert scene.source == Source()


def test_an_empty_scene_has_all_its_arrays():
    scene = Scene.from_meshes([])
    assert (scene.n_meshes, scene.n_triangles) == (0, 0)
    assert scene.triangles().shape == (0, 3, 3)
    assert_same(scene.select([]), scene)
    assert_same(scene.merge([], []), scene)
    assert mesh_of_face(scene).shape == mesh_of_vertex(scene).shape == (0,)


def test_an_empty_mesh_keeps_its_place():
    scene = Scene.from_meshes([MESHES[0], (np.zeros((0, 3)), np.zeros((0, 3))), MESHES[1]])
    assert [len(scene.mesh(i)[0]) for i in range(3)] == [8, 0, len(MESHES[1][0])]
    np.testing.assert_array_equal(scene.select([2, 1]).mesh(0)[0], MESHES[1][0])


def test_triangles_are_the_corners_of_the_faces():
    scene = packed()
    expected = np.concatenate([vertices[faces] for vertices, faces in MESHES])
    np.testing.assert_array_equal(scene.triangles(), expected)


def test_every_vertex_and_face_knows_its_mesh():
    scene = packed()
    assert np.bincount(mesh_of_vertex(scene)).tolist() == [len(v) for v, _ in MESHES]
    assert np.bincount(mesh_of_face(scene)).tolist() == [len(f) for _, f in MESHES]


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"paths": ("/a",)}, "a scene of 1 paths needs 1 meshes"),
        ({"paths": ("/a",) * 4}, "unique"),
        ({"anchors": ("/a",)}, "needs 4 anchors, got 1"),
        ({"colors": np.zeros((3, 3), np.float32)}, "got .* 3 colors"),
        ({"shapes": replace(packed().shapes, face_offsets=np.zeros(4, np.int64))}, "3 of faces"),
    ],
)
def test_lengths_that_do_not_fit_are_an_error(change, says):
    scene = packed()
    with pytest.raises(ValueError, match=says):
        replace(scene, **change)


@given(st.lists(st.integers(0, 3), unique=True))
def test_selecting_is_packing_in_that_order(order):
    assert_same(packed().select(order), packed(order))


def test_selecting_keeps_what_belongs_to_each_mesh():
    colors = np.arange(12).reshape(4, 3)
    scene = packed(colors=colors, source=Source("a.usd"))
    scene = replace(scene, anchors=("/a", "/b", "/c", "/d"), origin=np.array([1.0, 2, 3]))
    chosen = scene.select([2, 0])
    assert chosen.paths == ("/m2", "/m0")
    assert chosen.anchors == ("/c", "/a")
    assert chosen.colors.tolist() == colors[[2, 0]].tolist()
    assert chosen.source.path == "a.usd"
    assert chosen.origin.tolist() == [1, 2, 3]


def test_merging_joins_the_meshes_of_a_part():
    merged = packed().merge([1, 0, 1, 0], [3, 0])
    assert merged.paths == ("/m3", "/m0")
    expected = [np.concatenate([MESHES[i][0][MESHES[i][1]] for i in members]) for members in ((1, 3), (0, 2))]
    for part in range(2):
        vertices, faces = merged.mesh(part)
        np.testing.assert_array_equal(vertices[faces], expected[part])


@given(st.permutations(range(4)))
def test_merging_each_mesh_alone_is_selecting(order):
    part_of_mesh = np.argsort(order)
    assert_same(packed().merge(part_of_mesh, order), packed(order))


def test_merging_leaves_the_scene_as_it_is():
    scene = packed()
    before = packed()
    scene.merge([0, 0, 0, 0], [2])
    scene.select([3, 1])
    assert_same(scene, before)


def test_a_scene_shows_what_it_holds_in_one_line():
    assert repr(Scene.from_meshes([shapes.box()])) == "<Scene of '': 1 mesh, 12 triangles>"
    assert repr(Scene.from_meshes([shapes.box()] * 2)) == "<Scene of '': 2 meshes, 24 triangles>"
