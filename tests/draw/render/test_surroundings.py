import numpy as np
import pytest

import shapes
from cadgraph.draw.render.surroundings import Surroundings, reach
from cadgraph.model.scene import Scene

GREY = [0.4, 0.4, 0.4]


def boxes(*places, size=(0.2, 0.1, 0.05), colors=None):
    meshes = [shapes.box(size, place) for place in places]
    return Scene.from_meshes(meshes, colors=colors or [GREY] * len(meshes))


def recipes(scene):
    about = Surroundings(scene)
    return [about.recipe(mesh) for mesh in range(scene.n_meshes)]


ROW = [(x, 0.0, 0.0) for x in (0.0, 0.3, 0.6, 20.0)]


def test_moving_what_is_far_away_changes_nothing_here():
    before, after = recipes(boxes(*ROW)), recipes(boxes(*ROW[:3], (20.0, 0.1, 0.0)))
    assert before == after
    far = [*ROW[:3], (20.0, 0.1, 0.0), (20.3, 0, 0)]
    assert recipes(boxes(*far))[:3] == before[:3]
    assert recipes(boxes(*far))[3] != before[3]


def test_moving_a_neighbour_changes_it():
    before, after = recipes(boxes(*ROW)), recipes(boxes((0, 0, 0), (0.301, 0, 0), *ROW[2:]))
    assert all(a != b for a, b in zip(before[:3], after[:3], strict=True))


def test_the_colour_of_a_neighbour_and_its_own_count():
    before = recipes(boxes(*ROW))
    assert recipes(boxes(*ROW, colors=[GREY, [0.9, 0, 0], GREY, GREY]))[0] != before[0]
    assert recipes(boxes(*ROW, colors=[[0.9, 0, 0], GREY, GREY, GREY]))[0] != before[0]
    assert recipes(boxes(*ROW, colors=[GREY, GREY, GREY, [0.9, 0, 0]]))[:3] == before[:3]


@pytest.mark.parametrize("by", [(10.0, 0, 0), (-3.7, 1234.5, 0.3)])
def test_moving_everything_leaves_it(by):
    scene = boxes(*ROW)
    moved = Scene.from_meshes([(v + by, f) for v, f in map(scene.mesh, range(4))], colors=scene.colors)
    assert recipes(moved) == recipes(scene)


def test_turning_everything_changes_it():
    scene = boxes(*ROW)
    turned = [(v[:, [1, 0, 2]] * [-1, 1, 1], f) for v, f in map(scene.mesh, range(4))]
    assert recipes(Scene.from_meshes(turned, colors=scene.colors))[0] != recipes(scene)[0]


def test_the_order_of_the_meshes_does_not_matter():
    scene = boxes(*ROW)
    order = [2, 0, 3, 1]
    assert recipes(scene.select(order)) == [recipes(scene)[i] for i in order]


def test_noise_in_the_last_digits_does_not_matter():
    scene = boxes(*ROW)
    noise = np.random.default_rng(0).normal(size=scene.vertices.shape) * 1e-12
    noisy = Scene.from_meshes(
        [(v + n, f) for (v, f), n in zip(map(scene.mesh, range(4)), np.split(noise, 4), strict=True)],
        colors=scene.colors,
    )
    assert recipes(noisy) == recipes(scene)


def test_the_cutout_holds_the_mesh_first_and_whole_neighbours():
    scene = boxes(*ROW)
    cutout = Surroundings(scene).cutout(1)
    assert cutout.n_meshes == 3
    np.testing.assert_allclose(cutout.mesh(0)[0], scene.mesh(1)[0] - scene.mesh(1)[0].min(axis=0), atol=1e-4)
    np.testing.assert_allclose(cutout.colors, scene.colors[:3], atol=0.01)
    lows = sorted(cutout.mesh(i)[0].min(axis=0)[0] for i in (1, 2))
    np.testing.assert_allclose(lows, [-0.3, 0.3], atol=1e-4)


def test_equal_recipes_give_equal_cutouts():
    one, two = Surroundings(boxes(*ROW)), Surroundings(boxes((5, 5, 5), *[(x + 10, 0, 3) for x, _, _ in ROW]))
    assert one.recipe(1) == two.recipe(2)
    a, b = one.cutout(1), two.cutout(2)
    for name in ("vertices", "faces", "vertex_offsets", "face_offsets", "colors"):
        np.testing.assert_array_equal(getattr(a, name), getattr(b, name))


def test_a_mesh_without_a_colour_differs_from_a_black_one():
    none = boxes(*ROW, colors=[[np.nan] * 3, GREY, GREY, GREY])
    black = boxes(*ROW, colors=[[0, 0, 0], GREY, GREY, GREY])
    assert recipes(none)[0] != recipes(black)[0]
    assert np.isnan(Surroundings(none).cutout(0).colors[0]).all()


def test_corners_that_are_not_finite_are_left_out():
    vertices, faces = shapes.box((0.2, 0.1, 0.05))
    broken = np.append(vertices, [[np.nan, 0, 0]], axis=0)
    holed = (broken, np.append(faces, [[0, 1, 8]], axis=0))
    scene = Scene.from_meshes([holed, shapes.box(), (np.full((3, 3), np.inf), [[0, 1, 2]])])
    cutout = Surroundings(scene).cutout(0)
    assert np.isfinite(cutout.vertices).all()
    assert cutout.n_meshes == 2
    assert len({Surroundings(scene).recipe(i) for i in range(3)}) == 3
    with pytest.raises(ValueError, match="/mesh_2"):
        Surroundings(scene).cutout(2)


def test_reach_grows_with_the_size_up_to_a_limit():
    assert [round(reach(e), 3) for e in (0.05, 0.3, 1.0, 12.0)] == [0.2, 0.72, 1.0, 2.0]
