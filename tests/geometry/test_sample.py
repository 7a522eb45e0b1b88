import numpy as np
import pytest

from cadgraph.geometry.mesh.sample import spread_points

SQUARE = np.array([[[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 0], [1, 1, 0], [0, 1, 0]]], float)


def test_points_spread_by_area_and_stay_on_their_set():
    both = np.concatenate([SQUARE, 3 * SQUARE + [0, 0, 5]])
    samples = spread_points(both, np.array([0, 2, 4]), 400)
    assert samples.points.shape == (2, 400, 3)
    assert (samples.points[0, :, 2] == 0).all()
    assert (samples.points[1, :, 2] == 5).all()
    assert np.histogram2d(*samples.points[0, :, :2].T, bins=2)[0] == pytest.approx(100, abs=6)
    assert samples.points[1, :, :2] == pytest.approx(3 * samples.points[0, :, :2])
    assert (samples.normals == [0, 0, 1]).all()


def test_a_set_does_not_depend_on_its_neighbours():
    alone = spread_points(SQUARE, np.array([0, 2]), 10)
    among = spread_points(np.concatenate([SQUARE, SQUARE]), np.array([0, 2, 4]), 10)
    assert among.points[0] == pytest.approx(alone.points[0], abs=1e-12)


def test_what_has_no_area_is_at_the_origin():
    flat = np.concatenate([np.full((1, 3, 3), 2.0), np.full((1, 3, 3), np.nan), SQUARE])
    samples = spread_points(flat, np.array([0, 0, 1, 4]), 5)
    assert not samples.points[:2].any()
    assert not samples.normals[:2].any()
    assert np.isfinite(samples.points).all()
    assert not spread_points(SQUARE[:0], np.array([0, 0]), 5).points.any()
    assert spread_points(flat, np.array([0]), 5).points.shape == (0, 5, 3)
    assert spread_points(SQUARE, np.array([0, 2]), 0).points.shape == (1, 0, 3)


def test_what_the_labeler_sees_starts_in_the_corner_without_the_corner_itself():
    samples = spread_points(SQUARE[:1], np.array([0, 1]), 1, seed=0.0)
    # The first multiple of the two steps, folded into the triangle.
    u, v = 1 - 0.7548776662466927, 1 - 0.5698402909980532
    assert samples.points[0, 0].tolist() == pytest.approx([u + v, v, 0], abs=1e-15)
