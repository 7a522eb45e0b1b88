import numpy as np

from cadgraph.model.parts import Contacts
from cadgraph.stages.adjacency import join_contacts


def near(*rows):
    pairs = np.array([r[:2] for r in rows], np.int64).reshape(-1, 2)
    points = np.array([[[r[0], 0, 0], [r[1], 0, 0]] for r in rows], float).reshape(-1, 2, 3)
    return Contacts(pairs, np.array([r[2] for r in rows], float), points)


def test_parts_touch_where_their_closest_meshes_do():
    joined = join_contacts(near((0, 2, 0.005), (0, 3, 0.002), (1, 2, 0.009)), np.array([0, 0, 1, 1]), 0.01)
    assert joined.pairs.tolist() == [[0, 1]]
    assert joined.distance.tolist() == [0.002]
    assert joined.points[:, :, 0].tolist() == [[0, 3]]


def test_points_follow_their_parts_when_the_order_of_parts_is_the_other_way():
    joined = join_contacts(near((0, 1, 0.0)), np.array([1, 0]), 0.01)
    assert joined.pairs.tolist() == [[0, 1]]
    assert joined.points[:, :, 0].tolist() == [[1, 0]]


def test_meshes_of_one_part_do_not_touch_each_other():
    assert len(join_contacts(near((0, 1, 0.0)), np.array([0, 0]), 0.01).pairs) == 0


def test_eps_itself_counts_and_more_does_not():
    rows = near((0, 1, 0.01), (0, 2, 0.0101))
    assert join_contacts(rows, np.arange(3), 0.01).pairs.tolist() == [[0, 1]]


def test_a_tie_goes_to_the_first_pair():
    joined = join_contacts(near((0, 2, 0.0), (1, 2, 0.0)), np.array([0, 0, 1]), 0.01)
    assert joined.points[0, 0, 0] == 0


def test_nothing_gives_nothing():
    assert join_contacts(near(), np.zeros(0, np.int64), 0.01).pairs.shape == (0, 2)
