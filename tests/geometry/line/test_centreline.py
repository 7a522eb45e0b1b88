"""Centrelines in another place."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from cadgraph.geometry.line.centreline import Branch, Centreline, End, Junction

NAN = float("nan")


@pytest.fixture
def tee():
    """A run with a narrower branch."""
    points = np.array([[-1.0, 0, 0], [0, 0, 0], [1, 0, 0], [0, 0.5, 0]])
    branches = tuple(
        Branch(points[rows], np.full(2, radius), np.full(2, radius - 0.01))
        for rows, radius in (([0, 1], 0.1), ([1, 2], 0.1), ([1, 3], 0.05))
    )
    ends = (
        End(points[0], np.array([-1.0, 0, 0]), 0.1, 0.09, 0),
        End(points[2], np.array([1.0, 0, 0]), 0.1, 0.09, 1),
        End(points[3], np.array([0, 1.0, 0]), 0.05, NAN, 2),
    )
    return Centreline(branches, ends, (Junction(points[1], (0, 1, 2)),), 0.97)


def one(lines):
    (line,) = lines
    return line


def test_a_placed_line_is_the_same_elsewhere(tee):
    turns, shifts = Rotation.random(2, random_state=1).as_matrix(), np.array([[0.0, 0, 0], [3, -2, 7]])
    turn, shift = turns[1], shifts[1]
    _, there = tee.placed(turns, shifts)
    for end, moved in zip(tee.ends, there.ends, strict=True):
        assert moved.point == pytest.approx(turn @ end.point + shift, abs=1e-15)
        assert moved.direction == pytest.approx(turn @ end.direction, abs=1e-15)
        assert (moved.radius, moved.branch) == (end.radius, end.branch)
        assert moved.bore == pytest.approx(end.bore, nan_ok=True)
    assert there.branches[2].points[1] == pytest.approx(there.ends[2].point)
    assert there.junctions[0].point == pytest.approx(shift)
    assert (there.length, there.narrowest, there.share) == (tee.length, tee.narrowest, 0.97)
    assert (there.n_ends, there.radii, there.branch_of_end) == (3, [0.1, 0.1, 0.05], (0, 1, 2))


def test_a_line_lies_to_the_last_bit_where_it_would_if_it_were_placed_by_itself(tee):
    turns, shifts = Rotation.random(50, random_state=3).as_matrix(), np.random.default_rng(3).normal(size=(50, 3))
    for k, there in enumerate(tee.placed(turns, shifts)):
        alone = one(tee.placed(turns[k : k + 1], shifts[k : k + 1]))
        assert np.array_equal(there.table_of_ends, alone.table_of_ends, equal_nan=True)
        for branch, other in zip(there.branches, alone.branches, strict=True):
            assert np.array_equal(branch.points, other.points)
        assert np.array_equal(there.junctions[0].point, alone.junctions[0].point)
    assert k == 49


def test_a_placed_line_can_be_placed_and_changed_again(tee):
    turn, shift = Rotation.random(random_state=2).as_matrix(), np.array([1.0, 2.0, 3.0])
    there = one(tee.placed(turn[None], shift[None]))
    back = one(there.placed(turn.T[None], -(turn.T @ shift)[None]))
    assert back.table_of_ends == pytest.approx(tee.table_of_ends, abs=1e-12, nan_ok=True)
    fewer = replace(there, ends=())
    assert (fewer.ends, fewer.n_ends, fewer.branch_of_end) == ((), 0, ())
