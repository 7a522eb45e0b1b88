import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from cadgraph.geometry.components import connected_sets, first_of_component


def test_nothing_connected_keeps_its_own_number():
    assert first_of_component(3, []).tolist() == [0, 1, 2]
    assert first_of_component(0, np.zeros((0, 2), np.int64)).tolist() == []


def test_a_chain_in_any_order_has_its_lowest_number():
    assert first_of_component(6, [(4, 3), (5, 4), (1, 3), (2, 2)]).tolist() == [0, 1, 2, 1, 1, 1]


def test_a_pair_counts_however_often_it_is_there():
    assert first_of_component(2, [(0, 1)] * 256).tolist() == [0, 0]


def test_sets_come_in_the_order_of_their_first_members():
    sets = connected_sets(["d", "a", "c", "b"], [("b", "a"), ("c", "stranger"), ("stranger", "d")])
    assert sets == [("d",), ("a", "b"), ("c",)]


@given(st.integers(1, 12).flatmap(lambda n: st.tuples(st.just(n), st.lists(st.tuples(*[st.integers(0, n - 1)] * 2)))))
def test_components_are_what_walking_finds(case):
    n, pairs = case
    reached = list(range(n))
    for _ in range(n):
        for a, b in pairs:
            reached[a] = reached[b] = min(reached[a], reached[b])
    assert first_of_component(n, pairs).tolist() == reached
