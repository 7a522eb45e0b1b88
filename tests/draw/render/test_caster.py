import numpy as np
import pytest

import shapes
from cadgraph.draw.render.caster import Caster
from cadgraph.model.scene import Scene


def scene_of(*meshes):
    return Scene.from_meshes(meshes)


TWO = scene_of(shapes.box(), shapes.box(center=(0, 0, 5)))
DOWN = np.array([[0, 0, -1]], np.float32)


def test_first_hit_gives_face_distance_and_normal():
    caster = Caster(TWO)
    hits = caster.first(caster.local([[0.1, 0.2, 10]]), DOWN)
    assert 12 <= hits.face[0] < 24
    assert hits.distance[0] == pytest.approx(4.5)
    normal = np.abs(hits.normal[0])
    np.testing.assert_allclose(normal / np.linalg.norm(normal), (0, 0, 1))


def test_miss_has_no_face():
    caster = Caster(TWO)
    hits = caster.first(caster.local([[3, 3, 10]]), DOWN)
    assert hits.face[0] == -1


def test_only_chosen_meshes_are_met_and_faces_count_in_the_scene():
    caster = Caster(TWO, [0])
    hits = caster.first(caster.local([[0.1, 0.2, 10]]), DOWN)
    assert 0 <= hits.face[0] < 12
    caster = Caster(TWO, [1])
    assert 12 <= caster.first(caster.local([[0.1, 0.2, 10]]), DOWN).face[0] < 24


def test_faces_are_met_from_behind_too():
    vertices, faces = shapes.box()
    caster = Caster(scene_of((vertices, faces[:, ::-1])))
    assert caster.first(caster.local([[0.1, 0.2, 10]]), DOWN).face[0] >= 0


@pytest.mark.parametrize(("length", "blocked"), [(4.4, False), (4.6, True)])
def test_blocked_up_to_a_length(length, blocked):
    caster = Caster(TWO)
    assert caster.blocked(caster.local([[0.1, 0.2, 10]]), DOWN, np.float32([length]))[0] == blocked


def test_detail_far_from_the_origin_is_kept():
    offset = np.array([2.0e6, -3.0e6, 100.0])
    vertices, faces = shapes.box((0.01, 0.01, 0.01))
    caster = Caster(scene_of((vertices + offset, faces)))
    hits = caster.first(caster.local([offset + np.array([0.001, 0.002, 1])]), DOWN)
    assert hits.distance[0] == pytest.approx(0.995, abs=1e-6)


def test_triangles_with_corners_that_are_not_finite_are_left_out():
    vertices, faces = shapes.box()
    vertices = np.concatenate([vertices, [[np.nan, 0, 0]]])
    caster = Caster(scene_of((vertices, np.concatenate([faces, [[0, 1, 8]]]))))
    assert caster.first(caster.local([[0.1, 0.2, 10]]), DOWN).face[0] >= 0
    assert np.isfinite(caster.diagonal)


def test_nothing_finite_is_an_error():
    with pytest.raises(ValueError, match="empty scene"):
        Caster(scene_of(([[np.nan] * 3] * 3, [[0, 1, 2]])))
    with pytest.raises(ValueError, match="empty scene"):
        Caster(TWO, [])
