from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cadgraph.geometry.contact.broad import near_boxes


def brute_force(boxes, reach):
    gap = np.maximum(boxes[:, None, 0] - boxes[None, :, 1], boxes[None, :, 0] - boxes[:, None, 1])
    with np.errstate(invalid="ignore"):
        near = (np.maximum(gap, 0) ** 2).sum(-1) <= reach**2
    i, j = np.nonzero(np.triu(near, 1))
    return np.column_stack([i, j])


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 1 << 30), st.integers(0, 120), st.floats(0, 0.3), st.floats(0, 4))
def test_pairs_are_those_of_brute_force(seed, n, reach, decades):
    random = np.random.default_rng(seed)
    low = random.uniform(-3, 3, (n, 3))
    size = 10 ** random.uniform(-decades, 0.5, (n, 1)) * random.uniform(0, 1, (n, 3))
    boxes = np.stack([low, low + size], 1)
    np.testing.assert_array_equal(near_boxes(boxes, reach), brute_force(boxes, reach))


def test_equal_boxes_and_points_are_found():
    boxes = np.zeros((50, 2, 3))
    assert len(near_boxes(boxes, 0.0)) == 50 * 49 // 2


@pytest.mark.parametrize(("reach", "expected"), [(1.0, 1), (0.999, 0)])
def test_distance_of_boxes_decides_on_both_sides_of_the_reach(reach, expected):
    boxes = np.array([[[0, 0, 0], [1, 1, 1]], [[2, 0, 0], [3, 1, 1]]], float)
    assert len(near_boxes(boxes, reach)) == expected


def test_boxes_with_nan_are_near_nothing():
    boxes = np.zeros((4, 2, 3))
    boxes[1] = np.nan
    boxes[2, 1, 2] = np.nan
    assert near_boxes(boxes, 1.0).tolist() == [[0, 3]]


@pytest.mark.parametrize("n", [0, 1])
def test_less_than_two_boxes_have_no_pairs(n):
    assert near_boxes(np.zeros((n, 2, 3)), 1.0).shape == (0, 2)


@pytest.mark.parametrize("workers", [1, 2, 7])
def test_workers_change_nothing(workers):
    random = np.random.default_rng(1)
    low = random.uniform(0, 5, (300, 3))
    boxes = np.stack([low, low + 0.4], 1)
    np.testing.assert_array_equal(near_boxes(boxes, 0.1, workers), near_boxes(boxes, 0.1))
