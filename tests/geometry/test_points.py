import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.distance import cdist

import shapes
from cadgraph.geometry.contact.points import find_point_contacts, sample_surface
from cadgraph.model.scene import Scene


def contacts_of(scene, limit=0.01):
    return find_point_contacts(sample_surface(scene, 0.01, 0.01), limit)


def test_vertices_move_to_voxel_centres_and_duplicates_drop():
    scene = Scene.from_meshes([([[0.001, 0.001, 0.001], [0.004, 0.002, 0.003], [0.012, 0.001, 0.001]], [[0, 1, 2]])])
    points = sample_surface(scene, 0.01, 0.01).of(0)
    assert np.allclose(points, [[0.005, 0.005, 0.005], [0.015, 0.005, 0.005]])


def test_a_vertex_on_a_voxel_border_goes_to_the_upper_voxel_whatever_its_rounding():
    below, above = 0.03 - 1e-12, 0.1 * 0.3
    for x in (below, above, 0.03):
        points = sample_surface(Scene.from_meshes([([[x, 0.0, 0.0]] * 3, [[0, 1, 2]])]), 0.01, 0.01).of(0)
        assert np.allclose(points, [[0.035, 0.005, 0.005]])


def test_sides_of_faces_get_a_point_every_centimetre_once():
    scene = Scene.from_meshes(
        [([[0.005, 0.005, 0.005], [0.055, 0.005, 0.005], [0.005, 0.045, 0.005]], [[0, 1, 2], [1, 0, 2]])]
    )
    points = sample_surface(scene, 0.01, 0.01).of(0)
    on_x = points[(np.abs(points[:, 1] - 0.005) < 1e-9)]
    assert np.allclose(np.sort(on_x[:, 0]), [0.005, 0.015, 0.025, 0.035, 0.045, 0.055])
    assert len(points) == 6 + 4 + 6


@pytest.mark.parametrize(("gap", "near"), [(0.0, True), (0.010, True), (0.0201, False)])
def test_boxes_are_near_up_to_one_voxel(gap, near):
    a = shapes.box((0.1, 0.1, 0.1), (0.005, 0.005, 0.005))
    b = shapes.box((0.1, 0.1, 0.1), (0.105 + gap, 0.005, 0.005))
    assert (len(contacts_of(Scene.from_meshes([a, b])).pairs) == 1) is near


def test_touching_meshes_have_distance_zero():
    scene = Scene.from_meshes([shapes.box(), shapes.box(center=(1.0, 0, 0))])
    found = contacts_of(scene)
    assert found.pairs.tolist() == [[0, 1]]
    assert found.distance.tolist() == [0.0]
    assert np.allclose(found.points[0, 0], found.points[0, 1])


def test_empty_scene_and_empty_meshes_touch_nothing():
    assert len(contacts_of(Scene.from_meshes([])).pairs) == 0
    nothing = (np.zeros((0, 3)), np.zeros((0, 3), int))
    found = contacts_of(Scene.from_meshes([nothing, shapes.box(), nothing, shapes.box(center=(1, 0, 0))]))
    assert found.pairs.tolist() == [[1, 3]]


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_trees_give_what_the_papers_full_matrix_gives(seed):
    random = np.random.default_rng(seed)
    meshes = [
        shapes.box(random.uniform(0.01, 0.1, 3), random.uniform(0, 0.2, 3)) for _ in range(int(random.integers(2, 12)))
    ]
    surface = sample_surface(Scene.from_meshes(meshes), 0.01, 0.01)
    found = find_point_contacts(surface, 0.01)
    expected = {}
    for i in range(len(meshes)):
        for j in range(i + 1, len(meshes)):
            distance = cdist(surface.of(i), surface.of(j)).min()
            if distance <= 0.01 + 1e-9:
                expected[i, j] = distance
    assert [tuple(p) for p in found.pairs.tolist()] == sorted(expected)
    assert np.allclose(found.distance, [expected[p] for p in sorted(expected)], atol=2e-9)
    assert np.allclose(np.linalg.norm(found.points[:, 0] - found.points[:, 1], axis=1), found.distance, atol=2e-9)
