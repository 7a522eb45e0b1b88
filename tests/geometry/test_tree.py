from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import shapes
from cadgraph.geometry.kernels.tree import LEAF, build_forest, first_face
from cadgraph.model.scene import Scene


def forest_of(*meshes, workers=None):
    return build_forest(Scene.from_meshes(meshes), workers)


@pytest.mark.parametrize("n_leaves", [1, 2, 3, 4, 5, 7, 8, 9, 31, 33])
def test_every_leaf_starts_at_its_own_faces(n_leaves):
    starts = [first_face(node, n_leaves) for node in range(n_leaves - 1, 2 * n_leaves - 1)]
    assert sorted(starts) == [LEAF * k for k in range(n_leaves)]


@pytest.mark.parametrize("mesh", [shapes.box(), shapes.sphere(1.0, 30, 20), shapes.tube(1, 0.9, 3, 37)])
def test_faces_are_those_of_the_mesh_in_another_order(mesh):
    forest = forest_of(mesh)
    assert sorted(map(tuple, forest.faces)) == sorted(map(tuple, mesh[1]))


@pytest.mark.parametrize("turned", [False, True])
def test_boxes_hold_all_that_is_below_them(turned):
    mesh = shapes.tube(0.05, 0.04, 5.0, 40)
    if turned:
        mesh = shapes.moved(mesh, Rotation.from_rotvec([0.5, 0.6, 0.2]).as_matrix(), (100, 200, -50))
    forest = forest_of(mesh)
    assert forest.upright[0] != turned
    corners = (mesh[0][forest.faces] - forest.centers[0]) @ forest.axes[0].T
    n = -(-len(mesh[1]) // LEAF)
    nodes = forest.nodes.astype(float)
    low, high = nodes[:, :3] - nodes[:, 3:], nodes[:, :3] + nodes[:, 3:]
    for node in range(n - 1, 2 * n - 1):
        start = first_face(node, n)
        inside = corners[start : start + LEAF].reshape(-1, 3)
        up = node
        while True:
            assert (inside >= low[up] - 1e-12).all()  # rounding of the turn
            assert (inside <= high[up] + 1e-12).all()
            if up == 0:
                break
            up = (up - 1) // 2


def test_long_mesh_askew_gets_its_own_axes():
    forest = forest_of(shapes.moved(shapes.box((16, 0.4, 0.1)), Rotation.from_rotvec([0.5, 0.6, 0.2]).as_matrix()))
    assert not forest.upright[0]
    np.testing.assert_allclose(forest.nodes[0, 3:], [8, 0.2, 0.05], atol=0.1)
    np.testing.assert_allclose(forest.axes[0] @ forest.axes[0].T, np.eye(3), atol=1e-12)


def test_tree_takes_at_most_sixty_bytes_a_triangle():
    forest = forest_of(*[shapes.sphere(1.0, 40, 20)] * 20)
    fixed = forest.centers.nbytes + forest.axes.nbytes + forest.boxes.nbytes
    assert (forest.nodes.nbytes + forest.faces.nbytes + fixed) / len(forest.faces) <= 60


def test_any_number_of_workers_builds_the_same_bytes():
    meshes = [shapes.sphere(r, 20, 12) for r in np.linspace(0.1, 1, 40)]
    one, many = forest_of(*meshes, workers=1), forest_of(*meshes, workers=5)
    for name in ("faces", "nodes", "centers", "axes", "boxes", "counts"):
        assert getattr(one, name).tobytes() == getattr(many, name).tobytes()


def test_input_is_unmodified():
    scene = Scene.from_meshes([shapes.sphere(1.0)])
    copies = scene.vertices.copy(), scene.faces.copy()
    build_forest(scene)
    np.testing.assert_array_equal(scene.vertices, copies[0])
    np.testing.assert_array_equal(scene.faces, copies[1])


def test_mesh_without_valid_faces_has_no_box():
    forest = forest_of((np.full((3, 3), np.inf), np.array([[0, 1, 2]])), shapes.box())
    assert forest.counts.tolist() == [0, 12]
    assert np.isnan(forest.boxes[0]).all()
    np.testing.assert_array_equal(forest.boxes[1], [[-0.5] * 3, [0.5] * 3])
