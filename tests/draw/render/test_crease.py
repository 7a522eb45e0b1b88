from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import shapes
from cadgraph.draw.render.crease import CornerNormals, corner_normals
from cadgraph.model.scene import Placement, Scene


def radial_error(normals, vertices, faces):
    """Greatest deviation of the side normals of a cylinder about z from the radial direction."""
    corners = vertices[faces]
    side = np.abs(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2]) < 1e-9
    radial = corners[side] * (1, 1, 0)
    radial /= np.linalg.norm(radial, axis=-1, keepdims=True)
    return np.abs(normals[side] - radial).max()


@pytest.mark.parametrize("sides", [9, 12, 24])
def test_coarse_cylinder_is_round(sides):
    vertices, faces = shapes.cylinder(sides=sides)
    assert radial_error(corner_normals(vertices, faces), vertices, faces) < 1e-5


def test_edges_of_a_box_stay_sharp():
    vertices, faces = shapes.box((1, 2, 3))
    normals = corner_normals(vertices, faces)
    assert np.allclose(np.sort(np.abs(normals), axis=-1), (0, 0, 1), atol=1e-6)


def test_caps_of_a_cylinder_stay_flat():
    vertices, faces = shapes.cylinder()
    normals = corner_normals(vertices, faces)
    flat = np.ptp(vertices[faces][..., 2], axis=1) < 1e-9
    np.testing.assert_allclose(np.abs(normals[flat][..., 2]), 1, atol=1e-6)


def test_corners_at_one_place_belong_together_without_sharing_a_vertex():
    vertices, faces = shapes.cylinder(sides=16)
    loose = vertices[faces].reshape(-1, 3)
    normals = corner_normals(loose, np.arange(len(loose)).reshape(-1, 3))
    np.testing.assert_allclose(normals, corner_normals(vertices, faces), atol=1e-6)


def test_neighbour_with_its_sides_swapped_still_shades_smoothly():
    vertices, faces = shapes.cylinder(sides=16)
    swapped = faces.copy()
    swapped[::3] = swapped[::3, ::-1]
    normals = corner_normals(vertices, swapped)
    whole = corner_normals(vertices, faces)
    whole[::3] = -whole[::3, ::-1]
    np.testing.assert_allclose(normals, whole, atol=1e-5)


def test_degenerate_face_has_no_normal_and_harms_no_other():
    vertices, faces = shapes.box()
    normals = corner_normals(vertices, np.concatenate([faces, [[0, 0, 1]]]))
    assert np.isfinite(normals).all()
    np.testing.assert_allclose(normals[:-1], corner_normals(vertices, faces), atol=1e-6)


def test_no_faces():
    assert corner_normals(np.zeros((0, 3)), np.zeros((0, 3), int)).shape == (0, 3, 3)


@given(scale=st.floats(1e-3, 1e3), shift=st.floats(-100, 100))
def test_normals_do_not_depend_on_size_and_place(scale, shift):
    vertices, faces = shapes.sphere(sides=10, rings=6)
    moved = corner_normals(vertices * scale + shift, faces)
    np.testing.assert_allclose(moved, corner_normals(vertices, faces), atol=0.05)


def test_lazy_normals_agree_with_those_of_each_mesh():
    meshes = [shapes.box(), shapes.cylinder(), shapes.sphere()]
    scene = Scene.from_meshes(meshes)
    lazy = CornerNormals(scene)
    for index in (1, 2, 0, 1):
        first, last = scene.face_offsets[index : index + 2]
        found = lazy.ready(np.array([index])).corners[first:last]
        np.testing.assert_array_equal(found, corner_normals(*meshes[index]))


def turned(normals, mesh, scene):
    """The normals of a mesh as they lie in the scene."""
    first, last = scene.face_offsets[mesh : mesh + 2] + normals.shift[mesh]
    return normals.corners[first:last] @ (normals.turn[mesh] if len(normals.turn) else np.eye(3))


def test_meshes_that_share_a_shape_share_its_normals():
    vertices, faces = shapes.cylinder()
    turn, _ = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))
    turn *= np.sign(np.linalg.det(turn))
    once = Scene.from_meshes([shapes.box(), (vertices, faces)])
    placement = Placement(np.array([1, 0, 1]), np.array([np.eye(3), turn, turn]), np.arange(9.0).reshape(3, 3))
    scene = replace(once, paths=("/a", "/b", "/c"), colors=np.zeros((3, 3), np.float32), placement=placement)
    lazy = CornerNormals(scene)
    normals = lazy.ready(np.array([2, 1]))
    assert len(normals.corners) == len(once.faces)
    for mesh in range(3):
        np.testing.assert_allclose(turned(normals, mesh, scene), corner_normals(*scene.mesh(mesh)), atol=1e-6)
    elsewhere = scene.with_vertices(scene.vertices[:, [1, 2, 0]])
    kept = np.concatenate([scene.mesh(0)[0], elsewhere.mesh(1)[0], scene.mesh(2)[0]])
    moved = scene.with_vertices(kept)
    normals = lazy.moved(moved, np.array([1])).ready(np.arange(3))
    for mesh in range(3):
        np.testing.assert_allclose(turned(normals, mesh, moved), corner_normals(*moved.mesh(mesh)), atol=1e-6)


def test_a_plane_of_its_own_has_its_normal():
    scene = Scene.from_meshes([shapes.box()])
    with_cut = CornerNormals(scene).ready(np.zeros(1, int)).with_plane((0, 0, 1), scene.n_triangles)
    np.testing.assert_array_equal(with_cut.corners[scene.n_triangles + with_cut.shift[1]], np.tile([0, 0, 1], (3, 1)))
