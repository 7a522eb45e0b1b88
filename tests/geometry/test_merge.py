import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from cadgraph.geometry.mesh.merge import merge_rows, weld_points


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_equal_points_are_one_in_order(dtype):
    points = np.array([[1, 0, 0], [0, 0, 0], [-0.0, 0, 0], [1, 0, 0], [5, 5, 5]], dtype)
    first, place = weld_points(points)
    assert first.tolist() == [0, 1, 4]
    assert place.tolist() == [0, 1, 1, 0, 2]


def test_points_within_a_cell_are_one():
    points = np.array([[0.0, 0, 0], [4e-10, 0, 0], [6e-10, 0, 0]])
    assert weld_points(points, 1e-9)[1].tolist() == [0, 0, 1]
    assert weld_points(points)[1].tolist() == [0, 1, 2]


@given(hnp.arrays(np.int64, st.tuples(st.integers(0, 30), st.integers(1, 4)), elements=st.integers(-2, 2)))
def test_rows_are_told_apart_as_numpy_does(rows):
    first, kind = merge_rows(rows)
    assert (rows[first][kind] == rows).all()
    assert len(first) == len(np.unique(rows, axis=0))
    assert (np.diff(first) > 0).all()
    assert [int(np.flatnonzero(kind == k)[0]) for k in range(len(first))] == first.tolist()


def test_different_rows_with_one_hash_stay_apart():
    def mixed(value):
        key = np.array([value], np.uint64) * np.uint64(0x9E3779B97F4A7C15)
        return key ^ (key >> np.uint64(29))

    twin = np.uint64(7) ^ mixed(1) ^ mixed(2)
    rows = np.array([[2, 0], [1, 7], [2, 0], [1, 7]], np.int64)
    rows[::2, 1] = twin.view(np.int64)
    assert merge_rows(rows)[1].tolist() == [0, 1, 0, 1]
