import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cadgraph.config import ClusterConfig
from cadgraph.model.parts import Contacts
from cadgraph.stages.bridge import cut_bridges, find_weak_bridges


def contacts(*rows):
    rows = sorted((min(a, b), max(a, b), gap) for a, b, gap in rows)
    pairs = np.array([r[:2] for r in rows], np.int64).reshape(-1, 2)
    return Contacts(pairs, np.array([r[2] for r in rows], float), np.zeros((len(rows), 2, 3)))


def ring(first, n):
    return [(first + i, first + (i + 1) % n, 0.0) for i in range(n)]


def weak(n, *rows, ground=(), **changes):
    found = contacts(*rows)
    config = ClusterConfig(**{"bridge_parts": 3, **changes})
    bridges = find_weak_bridges(n, found, np.isin(np.arange(n), ground), config)
    return [(*found.pairs[b.contact].tolist(), *b.sizes) for b in bridges]


def test_a_single_contact_over_a_gap_between_two_structures_is_weak():
    assert weak(7, *ring(0, 3), *ring(3, 4), (1, 5, 0.008)) == [(1, 5, 3, 4)]


def test_two_contacts_between_them_are_not():
    assert weak(7, *ring(0, 3), *ring(3, 4), (1, 5, 0.008), (2, 6, 0.008)) == []


@pytest.mark.parametrize(("gap", "is_weak"), [(0.0019, False), (0.002, True)])
def test_only_a_gap_makes_it_weak(gap, is_weak):
    assert bool(weak(6, *ring(0, 3), *ring(3, 3), (0, 3, gap))) is is_weak


@pytest.mark.parametrize(("least", "is_weak"), [(3, True), (4, False)])
def test_both_sides_must_be_substantial(least, is_weak):
    assert bool(weak(7, *ring(0, 3), *ring(3, 4), (0, 3, 0.01), bridge_parts=least)) is is_weak


def test_the_ground_holds_nothing_together():
    rows = (*ring(0, 3), *ring(3, 3), (0, 3, 0.01), (1, 6, 0.0), (4, 6, 0.0))
    assert weak(7, *rows) == []
    assert weak(7, *rows, ground=[6]) == [(0, 3, 3, 3)]


def test_cutting_takes_out_just_these_contacts():
    found = contacts(*ring(0, 3), *ring(3, 3), (0, 3, 0.01))
    bridges = find_weak_bridges(6, found, np.zeros(6, bool), ClusterConfig(bridge_parts=3))
    cut = cut_bridges(found, bridges)
    assert len(cut.pairs) == len(found.pairs) - 1
    assert [0, 3] not in cut.pairs.tolist()


def test_nothing_has_no_bridges():
    assert weak(0) == []


@settings(max_examples=100, deadline=None)
@given(st.integers(1, 20), st.data())
def test_bridges_and_sizes_agree_with_networkx(n, data):
    index = st.integers(0, n - 1)
    pairs = {tuple(sorted(p)) for p in data.draw(st.lists(st.tuples(index, index), max_size=40)) if p[0] != p[1]}
    graph = nx.Graph(sorted(pairs))
    expected = set()
    for a, b in nx.bridges(graph):
        without = graph.copy()
        without.remove_edge(a, b)
        a, b = sorted((a, b))
        expected.add((a, b, len(nx.node_connected_component(without, a)), len(nx.node_connected_component(without, b))))
    rows = [(a, b, 0.01) for a, b in pairs]
    assert set(weak(n, *rows, bridge_parts=1)) == expected
