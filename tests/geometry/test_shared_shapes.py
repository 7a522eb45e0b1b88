"""What is measured on shapes that meshes share is what is measured on each mesh in its place."""

from dataclasses import fields, replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import shapes
from cadgraph.geometry.kernels.tree import build_forest
from cadgraph.geometry.mesh.properties import measure
from cadgraph.geometry.occupancy import occupied
from cadgraph.geometry.shape.repeats import find_shapes
from cadgraph.model.grid import Grid
from cadgraph.model.scene import MeshArrays, Placement, Scene
from cadgraph.stages.preprocess import prepare_scene

SHAPES = [
    shapes.box((0.3, 0.2, 0.1)),
    shapes.tube(sides=8),
    (np.array([[0.0, 0, 0], [1, 0, 0], [0, 2, 0], [5, 5, 5]]), np.array([[0, 1, 2]])),  # open, with a stray vertex
    shapes.box((0.1, 0.2, 0.3)),  # the first once more, turned
]


def placed(n=24, seed=1):
    random = np.random.default_rng(seed)
    turn = Rotation.random(n, random_state=seed).as_matrix()
    placement = Placement(random.permutation(np.arange(n) % 4), turn, random.uniform(-3, 3, (n, 3)))
    return Scene(
        MeshArrays.of(SHAPES),
        tuple(f"/m{i}" for i in range(n)),
        np.full((n, 3), np.nan, np.float32),
        placement=placement,
    )


def flat(scene):
    return Scene.from_meshes([scene.mesh(i) for i in range(scene.n_meshes)], scene.paths)


def test_a_mesh_is_placed_on_demand():
    one, two = placed(), placed()
    assert one.vertices.shape == (one.vertex_offsets[-1], 3)
    for i in range(one.n_meshes):
        np.testing.assert_array_equal(one.mesh(i)[0], two.mesh(i)[0])
        np.testing.assert_array_equal(one.mesh(i)[1], two.mesh(i)[1])
    assert "vertices" not in two.__dict__


@pytest.mark.parametrize("boxes", [True, False])
def test_properties_are_those_of_each_mesh(boxes):
    scene = placed()
    got, expected = measure(scene, boxes=boxes), measure(flat(scene), boxes=boxes)
    for one in fields(got):
        a, b = getattr(got, one.name), getattr(expected, one.name)
        if one.name != "obb_axes":  # equal sides and symmetric shapes have boxes in several poses
            np.testing.assert_allclose(a, b, rtol=1e-7, atol=1e-9, err_msg=one.name)
    np.testing.assert_allclose(np.linalg.det(got.obb_axes), 1.0)


def test_shapes_are_found_as_among_separate_meshes():
    scene = placed()
    plain = flat(scene)
    got, expected = find_shapes(scene, measure(scene)), find_shapes(plain, measure(plain))
    assert got.shape.tolist() == expected.shape.tolist()
    assert got.n_shapes == 3
    assert got.first.tolist() == expected.first.tolist()
    assert got.mirrored.tolist() == expected.mirrored.tolist()
    for i in range(scene.n_meshes):
        head = plain.mesh(int(got.first[got.shape[i]]))[0]
        there = head @ got.turn[i].T + got.shift[i]
        apart = np.linalg.norm(there[:, None] - plain.mesh(i)[0][None], axis=2)
        assert apart.min(axis=1).max() < 1e-6


def test_selecting_and_merging_keep_places():
    scene = placed()
    plain = flat(scene)
    order = [5, 3, 20, 0]
    np.testing.assert_array_equal(scene.select(order).vertices, plain.select(order).vertices)
    part_of_mesh = np.array([0, 1, 2, 2, *range(3, 23)])
    heads = np.array([0, 1, 3, *range(4, 24)])
    one, two = scene.merge(part_of_mesh, heads), plain.merge(part_of_mesh, heads)
    assert one.paths == two.paths
    assert one.shapes.n == 5
    np.testing.assert_array_equal(one.vertices, two.vertices)
    np.testing.assert_array_equal(one.faces, two.faces)
    moved = scene.with_vertices(scene.vertices + 1.0)
    np.testing.assert_array_equal(moved.mesh(7)[0], plain.mesh(7)[0] + 1.0)


def test_what_needs_all_meshes_in_place_once_does_not_leave_them_with_the_scene():
    scene, plain = placed(), flat(placed())
    trees, others = build_forest(scene), build_forest(plain)
    np.testing.assert_array_equal(trees.vertices, others.vertices)
    np.testing.assert_array_equal(trees.faces, others.faces)
    grid, all_meshes = Grid((-4.0, -4.0), 0.1, (80, 80)), np.arange(scene.n_meshes)
    found = occupied(scene, all_meshes, -1.0, 1.0, grid)
    np.testing.assert_array_equal(found, occupied(plain, all_meshes, -1.0, 1.0, grid))
    assert found.any()
    prepared, told = prepare_scene(scene)
    assert told == ()
    assert prepared.placement is not None
    for each in (scene, prepared):
        assert not {"vertices", "faces"} & each.__dict__.keys()
    np.testing.assert_array_equal(scene.placed_vertices(), scene.vertices)
    assert scene.placed_vertices() is scene.vertices


def test_a_shape_that_is_spoilt_is_found_in_every_place():
    scene = placed(8)
    spoilt = scene.shapes.vertices.copy()
    spoilt[3] = np.nan
    arrays = replace(scene.shapes, vertices=spoilt)
    told = {one.code: one.meshes for one in prepare_scene(replace(scene, shapes=arrays))[1]}
    boxes = np.flatnonzero(scene.placement.shape == 0)
    assert told["nonfinite-vertices"] == tuple(scene.paths[i] for i in boxes)
    faces = scene.shapes.faces.copy()
    faces[0, 0] = 1000
    with pytest.raises(ValueError, match=f"{scene.paths[boxes[0]]}: a face refers to a vertex"):
        prepare_scene(replace(scene, shapes=replace(scene.shapes, faces=faces)))
