import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cadgraph.hydraulics.elimination import Elimination


def systems(n, pairs, count, seed=0):
    """Laplacians with one unknown held, as cells and as dense matrices, and right sides."""
    lot = np.random.default_rng(seed)
    elimination = Elimination(n, pairs)
    cells, dense = np.zeros((elimination.size, count)), np.zeros((count, n, n))
    cells[0] += 1.0
    dense[:, 0, 0] += 1.0
    for a, b in pairs:
        value = lot.uniform(0.1, 10, count)
        cells[elimination.cell(a, b)] -= value
        dense[:, a, b] -= value
        dense[:, b, a] -= value
        for each in (a, b):
            cells[each] += value
            dense[:, each, each] += value
    return elimination, cells, dense, lot.normal(size=(n, count))


@settings(max_examples=40, deadline=None)
@given(st.integers(1, 14), st.data())
def test_all_systems_are_solved_as_one_by_one(n, data):
    tree = [(k, data.draw(st.integers(0, k - 1))) for k in range(1, n)]
    more = data.draw(st.lists(st.tuples(st.integers(0, n - 1), st.integers(0, n - 1)), max_size=6))
    elimination, cells, dense, right = systems(n, tree + [(a, b) for a, b in more if a != b], 3)
    expected = np.linalg.solve(dense, right.T[..., None])[..., 0].T
    assert elimination.factors(cells).solve(right) == pytest.approx(expected, rel=1e-9, abs=1e-9)


def test_hardly_anything_fills_in_where_a_line_has_branches():
    ring = [(k, k + 1) for k in range(99)] + [(0, 99)]
    assert Elimination(100, ring).size <= 100 + 100 + 100


def test_nothing_to_solve_is_solved():
    assert Elimination(0, []).factors(np.zeros((0, 2))).solve(np.zeros((0, 2))).shape == (0, 2)
