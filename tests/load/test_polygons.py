from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cadgraph.load.polygons import triangulate


def cut(outline, plane=np.eye(3)):
    points = np.column_stack([np.asarray(outline, float), np.zeros(len(outline))]) @ plane.T
    n = len(points)
    return points, triangulate(points, np.array([n]), np.array([0]), np.arange(n), np.array([0]))


def areas(points, triangles, normal=(0, 0, 1)):
    a, b, c = (points[triangles.corners[:, i]] for i in range(3))
    return np.cross(b - a, c - a) @ np.asarray(normal) / 2


def shoelace(outline):
    x, y = np.asarray(outline, float).T
    return float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2)


ARROW = [(0, 0), (2, -1), (0, 3), (-2, -1)]
COMB = [
    *[(0, 0), (7, 0), (7, 3), (6, 3), (6, 1), (5, 1), (5, 3), (4, 3)],
    *[(4, 1), (3, 1), (3, 3), (2, 3), (2, 1), (1, 1), (1, 3), (0, 3)],
]
RING = [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0), (1, 1), (1, 3), (3, 3), (3, 1), (1, 1)]
SPLIT_EDGES = [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
SPIRAL = [(0, 0), (10, 0), (10, 10), (2, 10), (2, 4), (6, 4), (6, 6), (4, 6), (4, 8), (8, 8), (8, 2), (0, 2)]


@pytest.mark.parametrize("outline", [ARROW, ARROW[1:] + ARROW[:1], COMB, RING, SPLIT_EDGES, SPIRAL])
@pytest.mark.parametrize("start", [0, 1, 3])
def test_triangles_tile_the_polygon(outline, start):
    outline = outline[start:] + outline[:start]
    points, triangles = cut(outline)
    found = areas(points, triangles)
    assert (found > -1e-12).all()
    assert found.sum() == pytest.approx(abs(shoelace(outline)))
    assert len(triangles.twisted) == 0


@pytest.mark.parametrize("outline", [ARROW, COMB, SPIRAL])
def test_winding_is_kept(outline):
    points, triangles = cut(outline[::-1])
    assert areas(points, triangles).sum() == pytest.approx(-shoelace(outline))


def test_corners_on_a_straight_edge_make_no_flat_triangles():
    points, triangles = cut([(0, 0), (1, 0), (2, 0), (2, 2), (0, 2)])
    assert areas(points, triangles).min() > 0.1


def test_result_is_sorted_by_polygon_and_mixes_sizes():
    points = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [2, 1, 0], [1, 1, 0], [0, 1, 0]], float)
    indices = np.array([0, 1, 4, 5, 0, 1, 2, 0, 1, 2, 3, 4, 5])
    found = triangulate(points, np.array([4, 3, 6]), np.array([0, 4, 7]), indices, np.array([10, 20, 30]))
    assert found.polygon.tolist() == [10] * 2 + [20] + [30] * 4


def test_repeated_corners_leave_no_triangle_with_one_point_twice():
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
    found = triangulate(points, np.array([5, 3]), np.array([0, 5]), np.array([0, 1, 1, 2, 3, 0, 1, 1]), np.arange(2))
    assert areas(points, found).sum() == pytest.approx(1)
    assert all(len(set(corners)) == 3 for corners in found.corners.tolist())


def test_polygon_that_crosses_itself_is_reported_and_cut_all_the_same():
    _, found = cut([(0, 0), (4, 4), (4, 0), (0, 3), (2, -1)])
    assert found.twisted.tolist() == [0]
    assert len(found.corners) == 3


def test_polygon_without_area_is_cut_without_error():
    _, found = cut([(0, 0), (1, 0), (2, 0), (1, 0), (0.5, 0)])
    assert len(found.corners) <= 3


def test_no_polygons():
    none = np.zeros(0, np.int64)
    assert len(triangulate(np.zeros((0, 3)), none, none, none, none).corners) == 0


@settings(max_examples=60, deadline=None)
@given(
    radii=st.lists(st.floats(0.2, 5), min_size=4, max_size=40),
    turn=st.tuples(*[st.floats(-1, 1)] * 3),
    seed=st.integers(0, 99),
)
def test_star_polygons_in_any_plane_are_tiled(radii, turn, seed):
    angles = np.arange(len(radii)) * 2 * np.pi / len(radii)
    outline = np.column_stack([np.cos(angles), np.sin(angles)]) * np.array(radii)[:, None]
    plane, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    points, found = cut(outline, plane)
    normal = np.cross(plane[:, 0], plane[:, 1])
    got = areas(points, found, normal)
    assert (got >= -1e-6 * abs(shoelace(outline))).all()
    assert got.sum() == pytest.approx(abs(shoelace(outline)), rel=1e-6)
