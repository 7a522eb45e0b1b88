import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import shapes
from cadgraph.geometry.kernels.distinct import in_groups, number_rows
from cadgraph.geometry.mesh.edges import edges_of
from cadgraph.geometry.mesh.merge import merge_rows

ROWS = hnp.arrays(np.int64, st.tuples(st.integers(0, 30), st.integers(1, 4)), elements=st.integers(-2, 2))


@given(ROWS)
def test_rows_are_numbered_as_without_a_compiler(rows):
    for found, wanted in zip(number_rows(rows), merge_rows(rows), strict=True):
        assert found.tolist() == wanted.tolist()


def test_columns_that_make_up_for_each_other_are_told_apart():
    # A mesh and a coordinate must not be mixed up: 0 and 5 is something else than 5 and 0.
    rows = np.array([[a, b, 7] for a in range(40) for b in range(40)])
    assert number_rows(rows)[1].tolist() == list(range(len(rows)))


@given(hnp.arrays(np.int64, st.integers(0, 40), elements=st.integers(0, 5)))
def test_what_is_of_one_kind_stands_side_by_side(kind):
    starts, rows = in_groups(kind, 6)
    assert rows.tolist() == np.argsort(kind, kind="stable").tolist()
    assert np.diff(starts).tolist() == np.bincount(kind, minlength=6).tolist()


def test_edges_of_a_box_have_two_sides_each():
    _, faces = shapes.box((0, 0, 0), (1, 2, 3))
    edges = edges_of(np.asarray(faces))
    assert edges.sizes.tolist() == [2] * 18
    assert sorted(edges.sides.tolist()) == list(range(36))
    for start in edges.starts[:-1].tolist():
        one, other = edges.sides[start : start + 2].tolist()
        ends = [{faces[side // 3][side % 3], faces[side // 3][(side + 1) % 3]} for side in (one, other)]
        assert ends[0] == ends[1]


def test_sides_without_a_partner_are_edges_of_their_own():
    assert edges_of(np.array([[0, 1, 2], [2, 1, 3]])).sizes.tolist() == [1, 2, 1, 1, 1]
