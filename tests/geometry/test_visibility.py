import numpy as np
import pytest

import shapes
from cadgraph.geometry.visibility.outside import find_visible, visible_share
from cadgraph.model.scene import Scene


def seen(*meshes, **options):
    scene = Scene.from_meshes(meshes)
    return find_visible(scene, **options).tolist()


def test_lone_mesh_is_visible():
    assert seen(shapes.box()) == [True]


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("place", [(0, 0, 0), (1e4, -1e4, 50)])
def test_mesh_inside_a_closed_one_is_hidden(scale, place):
    def put(mesh):
        return mesh[0] * scale + place, mesh[1]

    assert seen(put(shapes.box((2, 2, 2))), put(shapes.sphere(0.5)), put(shapes.box((0.1,) * 3))) == [
        True,
        False,
        False,
    ]


def test_mesh_in_a_tube_is_seen_through_its_ends():
    assert seen(shapes.tube(0.5, 0.4, 3.0), shapes.cylinder(0.1, 0.5)) == [True, True]


def test_mesh_in_a_capped_tube_is_hidden():
    caps = [shapes.cylinder(0.5, 0.1), shapes.moved(shapes.cylinder(0.5, 0.1), translation=(0, 0, 3.0))]
    tube = shapes.moved(shapes.tube(0.5, 0.4, 3.0), translation=(0, 0, 1.5))
    inner = shapes.moved(shapes.cylinder(0.1, 0.5), translation=(0, 0, 1.5))
    assert seen(tube, inner, *caps) == [True, False, True, True]


def test_faces_turned_inward_change_nothing():
    (v, f), (w, g) = shapes.box((2, 2, 2)), shapes.sphere(0.5)
    assert seen((v, f[:, ::-1]), (w, g[:, ::-1])) == [True, False]


def test_exact_duplicates_are_both_visible():
    assert seen(shapes.sphere(), shapes.sphere()) == [True, True]


def test_flush_contact_hides_only_what_it_covers():
    assert seen(shapes.box(), shapes.box(center=(1, 0, 0)), shapes.box(center=(2, 0, 0))) == [True, True, True]


def test_share_grows_with_the_exposed_area():
    scene = Scene.from_meshes([shapes.box((2, 2, 2)), shapes.cylinder(0.2, 4.0), shapes.cylinder(0.1, 1.0)])
    share = visible_share(scene, n_points=256)
    assert share[0] > 0.95
    assert share[1] == pytest.approx(0.5, abs=0.05)
    assert share[2] == 0


def test_meshes_without_area_are_not_visible():
    empty, point = (np.zeros((0, 3)), np.zeros((0, 3))), (np.zeros((3, 3)), [[0, 1, 2]])
    bad = (np.full((3, 3), np.nan), [[0, 1, 2]])
    assert seen(empty, point, bad, shapes.box()) == [False, False, False, True]
    assert seen(empty) == [False]
    assert seen() == []


def test_the_same_every_time():
    scene = Scene.from_meshes([shapes.box((2, 2, 2)), shapes.cylinder(0.2, 4.0)])
    first, second = (visible_share(scene) for _ in range(2))
    assert first.tobytes() == second.tobytes()


@pytest.mark.parametrize("first_only", [True, False])
def test_any_number_of_threads_gives_the_same(first_only):
    meshes = [shapes.box(center=(0.9 * i, 0, 0)) for i in range(7)] + [shapes.box((0.1,) * 3), shapes.box((20, 3, 3))]
    empty = (np.zeros((0, 3)), np.zeros((0, 3)))
    scene = Scene.from_meshes([empty, *meshes, empty, empty])
    whole = visible_share(scene, first_only=first_only, workers=1)
    np.testing.assert_array_equal(visible_share(scene, first_only=first_only, workers=3), whole)


def test_no_rays_are_an_error():
    with pytest.raises(ValueError, match="n_directions 0"):
        seen(shapes.box(), n_directions=0)


def test_input_is_not_modified():
    scene = Scene.from_meshes([shapes.box(), shapes.sphere()])
    vertices = scene.vertices.copy()
    find_visible(scene)
    np.testing.assert_array_equal(scene.vertices, vertices)
