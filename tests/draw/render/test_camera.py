import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cadgraph.draw.render.camera import direction_from_angles, frame

CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
angles = st.tuples(st.floats(-3.1, 3.1), st.floats(-1.5, 1.5))


@given(points=st.lists(st.tuples(*[st.floats(-100, 100)] * 3), min_size=2, max_size=12), angle=angles)
def test_all_points_lie_within_the_margins(points, angle):
    camera = frame(points, direction_from_angles(*angle), (300, 200), margin=0.1)
    places, depth = camera.project(points)
    assert (depth > 0).all()
    assert (places >= np.array([30, 20]) - 1e-6).all()
    assert (places <= np.array([270, 180]) + 1e-6).all()


def test_points_reach_the_margins_and_are_centred():
    camera = frame(CUBE, direction_from_angles(-1, 0.5), (300, 200), margin=0.1)
    places, _ = camera.project(CUBE)
    low, high = places.min(axis=0), places.max(axis=0)
    np.testing.assert_allclose(low + high, (300, 200), atol=1e-6)
    assert np.isclose(low[1], 20) or np.isclose(low[0], 30)


def test_ray_through_a_projected_point_meets_it():
    camera = frame(CUBE, (1, -2, 1), (640, 400))
    places, _ = camera.project(CUBE)
    origins, directions = camera.rays(places[:, 0], places[:, 1])
    away = CUBE - origins
    np.testing.assert_allclose(np.cross(away, directions), 0, atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(directions, axis=1), 1)


def test_up_in_the_picture_is_up_in_the_scene():
    camera = frame(CUBE, (0, -1, 0.3), (100, 100))
    places, _ = camera.project([[0.5, 0.5, 0], [0.5, 0.5, 1], [1, 0.5, 0.5]])
    assert places[1, 1] < places[0, 1]
    assert places[2, 0] > 50


def test_straight_from_above_the_top_is_plus_y():
    camera = frame(CUBE, (0, 0, 1), (100, 100))
    places, _ = camera.project([[0.5, 1, 1], [0.5, 0, 1]])
    assert places[0, 1] < places[1, 1]


def test_point_behind_the_camera_has_no_place():
    camera = frame(CUBE, (0, -1, 0), (100, 100))
    places, depth = camera.project([camera.eye - camera.forward])
    assert np.isnan(places).all()
    assert depth[0] < 0


def test_a_single_point_can_be_framed():
    camera = frame([[3.0, 4.0, 5.0]], (1, 1, 1), (100, 100))
    np.testing.assert_allclose(camera.project([[3, 4, 5]])[0], [[50, 50]], atol=1e-6)


def test_nothing_to_frame_is_an_error():
    with pytest.raises(ValueError, match="no points"):
        frame(np.zeros((0, 3)), (1, 0, 0), (100, 100))


def test_points_that_are_not_finite_are_an_error():
    with pytest.raises(ValueError, match="not finite"):
        frame([[0, 0, math.nan]], (1, 0, 0), (100, 100))


def test_null_direction_is_an_error():
    with pytest.raises(ValueError, match="not a direction"):
        frame(CUBE, (0, 0, 0), (100, 100))
