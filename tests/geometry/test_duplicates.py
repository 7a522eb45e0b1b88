import numpy as np
import pytest

import shapes
from cadgraph.geometry.mesh.duplicates import find_duplicates, findings
from cadgraph.geometry.mesh.properties import measure
from cadgraph.model.scene import Scene


def found(*meshes):
    scene = Scene.from_meshes(meshes)
    return find_duplicates(scene, measure(scene))


def scrambled(mesh, seed=0):
    vertices, faces = mesh
    order = np.random.default_rng(seed).permutation(len(vertices))
    return vertices[order], np.argsort(order)[faces][::-1]


def soup(mesh):
    vertices, faces = mesh
    return vertices[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3)


ROD = shapes.cylinder(0.1, 1.0, 48)


@pytest.mark.parametrize("change", [lambda m: m, scrambled, soup, lambda m: (m[0], m[1][:, ::-1])])
def test_same_geometry_in_place_is_an_exact_duplicate(change):
    result = found(ROD, shapes.box(), change(ROD), change(ROD))
    assert result.of.tolist() == [0, 1, 0, 0]
    assert result.exact.tolist() == [False, False, True, True]
    assert len(result.near) == 0


def test_same_part_elsewhere_is_no_duplicate():
    result = found(ROD, shapes.moved(ROD, translation=(0, 0, 0.3)))
    assert not result.exact.any()
    assert len(result.near) == 0


@pytest.mark.parametrize(("share", "exact"), [(0.5, True), (3.0, False)])
def test_exact_ends_at_the_tolerance(share, exact):
    # 1e-7 m, 1e-6 of the size and 4e-7 of the magnitude
    tolerance = 1e-7 + 1e-6 * 1.0 + 4e-7 * 0.5
    result = found(ROD, shapes.moved(ROD, translation=(0, 0, share * tolerance)))
    assert result.exact[1] == exact
    assert len(result.near) == (0 if exact else 1)


def test_other_triangles_in_place_are_a_near_duplicate():
    assert found(ROD, shapes.cylinder(0.1, 1.0, 16)).near.tolist() == [[0, 1]]


def test_near_duplicate_of_duplicates_is_named_once():
    result = found(ROD, ROD, shapes.cylinder(0.1, 1.0, 16))
    assert result.of.tolist() == [0, 0, 2]
    assert result.near.tolist() == [[0, 2]]


def test_thin_plates_on_each_other_are_no_duplicates():
    result = found(shapes.box((1, 1, 0.002)), shapes.box((1, 1, 0.002), (0, 0, 0.002)))
    assert not result.exact.any()
    assert len(result.near) == 0


def test_box_around_a_rod_is_no_duplicate():
    assert len(found(ROD, shapes.box((0.2, 0.2, 1.0))).near) == 0


def test_meshes_without_area_have_no_duplicates():
    empty, point = (np.zeros((0, 3)), np.zeros((0, 3))), (np.zeros((3, 3)), [[0, 1, 2]])
    assert not found(empty, empty, point, point).exact.any()
    assert len(found().of) == 0


def test_clean_scene_has_no_findings():
    scene = Scene.from_meshes([ROD, shapes.moved(shapes.box(), translation=(5, 0, 0))])
    properties = measure(scene)
    assert findings(scene, properties, find_duplicates(scene, properties), np.ones(2, bool)) == ()


def test_every_oddity_is_found_with_its_meshes():
    vertices, faces = shapes.box()
    far = np.array([9.0, 0, 0])
    meshes = [
        (np.zeros((0, 3)), np.zeros((0, 3))),
        (np.concatenate([vertices, [[np.nan] * 3]]), np.concatenate([faces, [[0, 1, 8]]])),
        (vertices + far, np.concatenate([faces, [[0, 0, 1]]])),
        (vertices + 2 * far, faces[:, ::-1]),
        (vertices + 3 * far, faces[1:]),
        (ROD[0] + 4 * far, ROD[1]),
        (ROD[0] + 4 * far, ROD[1]),
        shapes.moved(shapes.cylinder(0.1, 1.0, 16), translation=4 * far),
    ]
    scene = Scene.from_meshes(meshes)
    properties = measure(scene)
    visible = np.ones(len(meshes), bool)
    visible[6] = False
    result = {d.code: d for d in findings(scene, properties, find_duplicates(scene, properties), visible)}
    assert result["empty-mesh"].meshes == ("/mesh_0",)
    assert result["nonfinite-vertices"].meshes == ("/mesh_1",)
    assert set(result["degenerate-faces"].meshes) == {"/mesh_1", "/mesh_2"}
    assert result["inside-out-mesh"].meshes == ("/mesh_3",)
    assert result["open-mesh"].message.startswith("1 of 8")
    assert result["duplicate-mesh"].meshes == ("/mesh_6", "/mesh_5")
    assert result["near-duplicate-mesh"].meshes == ("/mesh_5", "/mesh_7")
    assert result["hidden-mesh"].meshes == ("/mesh_6",)


def test_input_is_not_modified():
    scene = Scene.from_meshes([ROD, ROD, shapes.cylinder(0.1, 1.0, 16)])
    vertices = scene.vertices.copy()
    find_duplicates(scene, measure(scene))
    np.testing.assert_array_equal(scene.vertices, vertices)
