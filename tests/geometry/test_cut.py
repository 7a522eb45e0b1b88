import numpy as np
import pytest

from cadgraph.geometry.mesh.cut import cut_short


def test_pieces_make_up_the_whole():
    corners = np.random.default_rng(0).normal(size=(50, 3, 3))
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(cross, axis=1)
    middles, vectors = cut_short(corners, 0.3)
    assert len(middles) > 1000
    pieces = np.linalg.norm(vectors, axis=1)
    assert pieces.sum() == pytest.approx(area.sum())
    np.testing.assert_allclose(vectors.sum(axis=0), cross.sum(axis=0), atol=1e-9)
    np.testing.assert_allclose(pieces @ middles, area @ corners.mean(axis=1), atol=1e-9)
    # No side is longer than 0.3, so that nothing is larger than an equilateral triangle of that side.
    assert pieces.max() <= np.sqrt(3) / 2 * 0.3**2 * (1 + 1e-9)


def test_short_triangles_stay_as_they_are():
    corners = np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 0]]], float)
    middles, vectors = cut_short(corners, 2.0)
    np.testing.assert_allclose(middles, [[1 / 3, 1 / 3, 0]])
    np.testing.assert_allclose(vectors, [[0, 0, 1]])


def test_nothing_of_a_very_long_triangle_is_lost():
    corners = np.array([[[0, 0, 0], [1e6, 0, 0], [0, 1e-3, 0]]], float)
    _, vectors = cut_short(corners, 0.1)
    assert vectors[:, 2].sum() == pytest.approx(1e3)


def test_nothing_is_cut_to_nothing():
    middles, vectors = cut_short(np.zeros((0, 3, 3)), 0.1)
    assert middles.shape == vectors.shape == (0, 3)
