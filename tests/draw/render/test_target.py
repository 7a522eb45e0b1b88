import numpy as np
import pytest

import shapes
from cadgraph.draw.render.target import APART, Target, choose_views
from cadgraph.model.scene import Scene


def scene_of(*meshes):
    return Scene.from_meshes(meshes)


def views_of(scene, mesh=0):
    return choose_views(scene, Target.of(scene, mesh))


def angles(views):
    d = np.array([view.direction for view in views])
    return [np.arccos(np.clip(d[i] @ d[j], -1, 1)) for i, j in ((0, 1), (0, 2), (1, 2))]


FREE = scene_of(shapes.box((0.3, 0.2, 0.1)), shapes.box((5, 5, 0.1), (0, 0, -1)))


def test_three_views_at_least_fifty_degrees_apart():
    views = views_of(FREE)
    assert min(angles(views)) >= APART - 1e-9
    assert [view.wide for view in views] == [False, False, True]


def test_a_free_mesh_is_seen_whole_from_everywhere_without_a_cutaway():
    for view in views_of(FREE):
        assert view.visible > 0.95
        assert view.hidden == ()


def test_the_wide_view_frames_more():
    close, _, wide = views_of(FREE)
    assert wide.span > 1.5 * close.span


def test_views_avoid_the_side_that_is_hidden():
    scene = scene_of(shapes.box((0.2, 0.2, 0.2)), shapes.box((0.05, 3, 3), (0.15, 0, 0)))
    for view in views_of(scene)[:2]:
        assert view.direction[0] < 0.2
        assert view.visible > 0.5


def test_a_mesh_inside_a_closed_box_gets_cutaways():
    scene = scene_of(shapes.sphere(0.1), shapes.box((0.3, 0.3, 0.3)), shapes.box((0.4, 0.4, 0.4)))
    views = views_of(scene)
    assert min(angles(views)) >= APART - 1e-9
    for view in views:
        assert 1 in view.hidden
        assert 0 not in view.hidden
        assert view.visible > 0.95


def test_a_ring_between_two_discs_is_seen_from_its_rim_and_once_cut_free():
    scene = scene_of(
        shapes.tube(0.1, 0.05, 0.004), shapes.moved(shapes.cylinder(0.15, 0.05), translation=(0, 0, 0.03)),
        shapes.moved(shapes.cylinder(0.15, 0.05), translation=(0, 0, -0.03)),
    )  # fmt: skip
    views = views_of(scene)
    assert any(view.hidden and abs(view.direction[2]) > 0.7 for view in views)


def test_close_views_of_a_slender_mesh_show_an_end_of_it():
    scene = scene_of(shapes.box((12, 0.05, 0.05)))
    close, other, wide = views_of(scene)
    assert [view.section for view in (close, other, wide)] == [view.end for view in (close, other, wide)]
    assert [view.section for view in (close, other, wide)] == [True, True, False]
    assert close.span < 2
    assert wide.span > 12
    for view in (close, other):
        corners = view.camera.project(scene.vertices[np.abs(scene.vertices[:, 0]) > 5.9])[0]
        assert ((corners > 0) & (corners < 512)).all(axis=1).sum() == 4
    # The face of the end itself shows in one of them at least.
    assert max(abs(view.direction[0]) for view in (close, other)) > 0.25


def test_a_slender_mesh_whose_ends_are_hidden_shows_a_section():
    ends = [shapes.box((2, 0.4, 0.4), (x, 0, 0)) for x in (-5.5, 5.5)]
    close, other, _ = views_of(scene_of(shapes.box((12, 0.05, 0.05)), *ends))
    assert close.section
    assert other.section
    assert not close.end


def test_the_target_fills_three_quarters_of_the_close_pictures():
    for view in views_of(FREE)[:2]:
        places = view.camera.project(FREE.mesh(0)[0])[0]
        assert np.ptp(places, axis=0).max() == pytest.approx(0.75 * 512, rel=0.02)


def test_a_face_that_coincides_with_another_counts_as_seen():
    board = shapes.box((0.2, 0.2, 0.02))
    for view in views_of(scene_of(board, shapes.box((0.2, 0.2, 0.02)))):
        assert view.visible > 0.95
        assert view.hidden == ()


def test_views_do_not_change_from_run_to_run():
    first, second = views_of(FREE), views_of(FREE)
    for a, b in zip(first, second, strict=True):
        np.testing.assert_array_equal(a.camera.eye, b.camera.eye)


def test_one_triangle_can_be_looked_at():
    views = views_of(scene_of(([[0, 0, 0], [1, 0, 0], [0, 0, 1]], [[0, 1, 2]])))
    assert min(angles(views)) >= APART - 1e-9


def test_a_mesh_without_area_is_refused_by_name():
    scene = scene_of(shapes.box(), ([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]]))
    with pytest.raises(ValueError, match="/mesh_1"):
        Target.of(scene, 1)


def test_sample_points_are_spread_by_area():
    scene = scene_of(shapes.box((1, 1, 0.001)))
    points = Target.of(scene, 0).points
    assert (np.abs(np.abs(points[:, 2]) - 0.0005) < 1e-9).mean() > 0.95
    assert abs(points[:, 0].mean()) < 0.05


def test_what_is_round_is_not_shown_from_the_same_height_twice():
    close, other, _ = views_of(scene_of(shapes.tube(0.1, 0.05, 0.07)))
    assert abs(close.direction[2] - other.direction[2]) > 0.3
