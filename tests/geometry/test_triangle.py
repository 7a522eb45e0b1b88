from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from cadgraph.geometry.kernels.triangle import triangle_distances
from geometry import oracle

N = 1500  # pairs of each class


def proper(random, n):
    return random.normal(size=(n, 3, 3))


def segments(random, n):
    ends = random.normal(size=(n, 2, 3))
    share = random.uniform(-0.5, 1.5, (n, 1))
    between = ends[:, 0] + share * (ends[:, 1] - ends[:, 0])
    corners = np.stack([ends[:, 0], ends[:, 1], between], 1)
    # a third of them with two equal corners, the rest with the odd corner within or beyond the others
    corners[::3, 2] = corners[::3, 0]
    return random.permuted(corners, axis=1) if n == 0 else corners[:, random.permutation(3)]


def points(random, n):
    return np.repeat(random.normal(size=(n, 1, 3)), 3, axis=1)


def slivers(random, n):
    along = random.normal(size=(n, 3))
    along *= 8 / np.linalg.norm(along, axis=1, keepdims=True)
    width = 10 ** random.uniform(-7, -2, (n, 1))
    start = random.normal(size=(n, 3)) - 0.5 * along
    third = random.uniform(0, 1, (n, 1)) * along + width * random.normal(size=(n, 3))
    return np.stack([start, start + along, start + third], 1)


def parallel(random, n):
    first = proper(random, n)
    u, v = first[:, 1] - first[:, 0], first[:, 2] - first[:, 0]
    normal = np.cross(u, v)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    shares = random.uniform(-1, 1.5, (n, 3, 2))
    height = np.where(random.uniform(size=n) < 0.3, 0.0, random.uniform(0, 0.5, n))
    second = first[:, :1] + shares[..., :1] * u[:, None] + shares[..., 1:] * v[:, None]
    return first, second + (height[:, None] * normal)[:, None]


def lattice(random, n):
    return random.integers(-1, 3, (n, 2, 3, 3)).astype(float)


def near_parallel_sides(random, n):
    first, second = slivers(random, n), slivers(random, n)
    # the long sides cross close to their middles at a tiny angle
    middle = (first[:, 0] + first[:, 1]) / 2
    along = first[:, 1] - first[:, 0]
    tilt = 10 ** random.uniform(-9, -2, (n, 1)) * random.normal(size=(n, 3))
    gap = np.where(random.uniform(size=(n, 1)) < 0.5, 0.0, 10 ** random.uniform(-6, -1, (n, 1)))
    second[:, 0] = middle - along * random.uniform(0.2, 0.8, (n, 1)) + tilt + gap
    second[:, 1] = middle + along * random.uniform(0.2, 0.8, (n, 1)) - tilt + gap
    return first, second


CLASSES = {
    "proper": lambda r, n: (proper(r, n), proper(r, n)),
    "proper and far": lambda r, n: (proper(r, n), proper(r, n) + 3 * r.normal(size=(n, 1, 3))),
    "proper and segment": lambda r, n: (proper(r, n), segments(r, n)),
    "segment and proper": lambda r, n: (segments(r, n), proper(r, n)),
    "segments": lambda r, n: (segments(r, n), segments(r, n)),
    "proper and point": lambda r, n: (proper(r, n), points(r, n)),
    "point and segment": lambda r, n: (points(r, n), segments(r, n)),
    "points": lambda r, n: (points(r, n), points(r, n)),
    "slivers": lambda r, n: (slivers(r, n), slivers(r, n)),
    "sliver and proper": lambda r, n: (slivers(r, n), proper(r, n)),
    "parallel and coplanar": parallel,
    "whole numbers": lambda r, n: tuple(np.moveaxis(lattice(r, n), 1, 0)),
    "near parallel sides": near_parallel_sides,
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", CLASSES)
def test_distance_agrees_with_oracle(kind):
    first, second = CLASSES[kind](np.random.default_rng(len(kind)), N)
    found, at = triangle_distances(first, second)
    assert np.abs(found - oracle.distances(first, second)).max() <= 1e-9
    np.testing.assert_allclose(np.linalg.norm(at[:, 1] - at[:, 0], axis=1), found, atol=1e-9)


@pytest.mark.parametrize("kind", CLASSES)
def test_closest_points_lie_on_the_triangles(kind):
    first, second = CLASSES[kind](np.random.default_rng(7), 300)
    _, at = triangle_distances(first, second)
    for side, triangles in enumerate((first, second)):
        spots = np.repeat(at[:, side : side + 1], 3, axis=1)
        assert oracle.distances(spots, triangles).max() <= 1e-9


@pytest.mark.parametrize("kind", CLASSES)
def test_distance_agrees_with_rational_numbers(kind):
    first, second = CLASSES[kind](np.random.default_rng(3), 12)
    found, _ = triangle_distances(first, second)
    for n in range(len(found)):
        assert abs(found[n] - float(oracle.exact_squared(first[n], second[n])) ** 0.5) <= 1e-9


@pytest.mark.parametrize("kind", CLASSES)
def test_distance_is_symmetric_and_ignores_order_of_corners(kind):
    random = np.random.default_rng(5)
    first, second = CLASSES[kind](random, 300)
    found, _ = triangle_distances(first, second)
    swapped, _ = triangle_distances(second[:, [2, 0, 1]], first[:, [1, 0, 2]])
    np.testing.assert_allclose(swapped, found, atol=1e-9)


@pytest.mark.parametrize("kind", CLASSES)
def test_distance_survives_rigid_motion(kind):
    random = np.random.default_rng(6)
    first, second = CLASSES[kind](random, 300)
    turn, shift = Rotation.random(random_state=1).as_matrix(), np.array([30.0, -20.0, 10.0])
    found, _ = triangle_distances(first, second)
    moved, _ = triangle_distances(first @ turn.T + shift, second @ turn.T + shift)
    # rounding of the moved corners alone is 1e-14, which a sliver's normal multiplies
    np.testing.assert_allclose(moved, found, atol=1e-9 if "sliver" not in kind else 1e-7)


def test_segment_through_face_is_at_distance_zero():
    face = np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]])
    through = np.array([[[0.2, 0.2, -1], [0.2, 0.2, 1], [0.2, 0.2, 1]]])
    beside = through + np.array([1.0, 1.0, 0.0])
    assert triangle_distances(face, through)[0] == 0
    assert triangle_distances(through, face)[0] == 0
    assert triangle_distances(face, beside)[0] == pytest.approx(np.sqrt(2) * 0.7, abs=1e-12)


def test_point_on_face_is_at_distance_zero():
    face = np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]])
    assert triangle_distances(face, np.full((1, 3, 3), 0.25) * [1, 1, 0])[0] == 0


def test_triangle_within_a_coplanar_one_is_at_distance_zero():
    outer = np.array([[[0.0, 0, 0], [4, 0, 0], [0, 4, 0]]])
    inner = outer * 0.1 + [0.5, 0.5, 0]
    distance, points = triangle_distances(outer, inner)
    assert distance == 0
    np.testing.assert_allclose(points[0, 0], points[0, 1])


def test_far_coordinates_keep_the_precision_of_their_own_size():
    first = np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]]) + 2.0**24
    second = first + np.array([0, 0, 0.0078125])  # 2**-7: exact at this size
    assert triangle_distances(first, second)[0] == 0.0078125


def test_empty_input_gives_empty_output():
    distance, points = triangle_distances(np.zeros((0, 3, 3)), np.zeros((0, 3, 3)))
    assert distance.shape == (0,)
    assert points.shape == (0, 2, 3)


def test_shapes_that_differ_are_refused():
    with pytest.raises(ValueError, match="shape"):
        triangle_distances(np.zeros((2, 3, 3)), np.zeros((1, 3, 3)))


def test_input_is_unmodified():
    first, second = np.random.default_rng(0).normal(size=(2, 5, 3, 3))
    copies = first.copy(), second.copy()
    triangle_distances(first, second)
    np.testing.assert_array_equal(first, copies[0])
    np.testing.assert_array_equal(second, copies[1])
