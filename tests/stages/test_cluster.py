import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cadgraph.model.parts import Contacts
from cadgraph.stages.cluster import cluster_parts


def contacts(*pairs):
    rows = np.array(sorted(pairs), np.int64).reshape(-1, 2)
    return Contacts(rows, np.zeros(len(rows)), np.zeros((len(rows), 2, 3)))


def clusters(n, *pairs, ground=(), min_samples=1):
    mask = np.isin(np.arange(n), ground)
    return cluster_parts(n, contacts(*pairs), mask, min_samples).tolist()


def test_connected_parts_share_a_cluster_numbered_by_their_lowest_part():
    assert clusters(5, (0, 3), (1, 2)) == [0, 1, 1, 0, 2]


def test_the_ground_belongs_to_no_cluster_and_joins_nothing():
    assert clusters(3, (0, 1), (1, 2), ground=[1]) == [0, -1, 1]


def test_a_lone_part_is_a_cluster_with_one_sample_and_noise_with_two():
    assert clusters(1) == [0]
    assert clusters(1, min_samples=2) == [-1]


def test_a_border_part_joins_its_core_neighbour_without_linking_clusters():
    # 0-1-2 and 4-5-6 are chains with cores 1 and 5; part 3 touches both ends but is no core itself.
    assert clusters(7, (0, 1), (1, 2), (4, 5), (5, 6), min_samples=3) == [0, 0, 0, -1, 1, 1, 1]


def test_nothing_gives_nothing():
    assert clusters(0) == []


@settings(max_examples=100, deadline=None)
@given(st.integers(1, 4), st.integers(0, 2**32 - 1))
def test_it_agrees_with_dbscan_by_definition(min_samples, seed):
    random = np.random.default_rng(seed)
    points = random.random((int(random.integers(1, 25)), 2))
    eps = 0.2
    near = np.linalg.norm(points[:, None] - points[None], axis=2) <= eps
    pairs = np.argwhere(np.triu(near, 1))
    ours = cluster_parts(
        len(points),
        Contacts(pairs, np.zeros(len(pairs)), np.zeros((len(pairs), 2, 3))),
        np.zeros(len(points), bool),
        min_samples,
    )
    core = near.sum(axis=1) >= min_samples
    for i in range(len(points)):
        assert (ours[i] >= 0) == (core & near[i]).any()
        for j in np.flatnonzero(near[i]):
            if core[i] and core[j]:
                assert ours[i] == ours[j]
            elif core[j] and not core[i]:
                assert ours[i] <= ours[j] or ours[i] in ours[near[i] & core]
    # Core parts of one cluster are linked through core parts.
    for c in range(ours.max(initial=-1) + 1):
        members = np.flatnonzero((ours == c) & core)
        reached, front = {members[0]}, [members[0]]
        while front:
            here = front.pop()
            for there in np.flatnonzero(near[here] & core):
                if there not in reached:
                    reached.add(there)
                    front.append(there)
        assert set(members) == reached


@pytest.mark.parametrize("min_samples", [1, 2])
def test_input_stays_as_it_was(min_samples):
    touching = contacts((0, 1))
    before = touching.pairs.copy()
    cluster_parts(2, touching, np.zeros(2, bool), min_samples)
    assert np.array_equal(touching.pairs, before)
