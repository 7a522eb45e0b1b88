import itertools
import math
import random

import pytest

from cadgraph.plans import tour
from cadgraph.plans.tour import length_of, shortest_order


def plant(seed, n, stages, loose_start=False):
    """Distances between a start and stops on two levels that stairs join, and the stage of each stop."""
    chance = random.Random(seed)
    points = [(10 * chance.random(), 10 * chance.random(), chance.choice((0.0, 3.0))) for _ in range(n + 1)]
    stairs = (5.0, 5.0)

    def length(a, b):
        if a[2] == b[2]:
            return math.dist(a, b)
        return math.dist(a[:2], stairs) + 3.0 + math.dist(stairs, b[:2])

    table = [[length(a, b) for b in points] for a in points]
    if loose_start:
        for k in range(n + 1):
            table[0][k] = table[k][0] = 0.0 if points[k][2] == 0.0 else 3.0
    return table, [chance.randrange(stages) for _ in range(n)]


def keeps_stages(order, stages):
    told = [stages[stop - 1] for stop in order]
    return told == sorted(told) and sorted(order) == list(range(1, len(stages) + 1))


@pytest.mark.parametrize("stages", [1, 2, 4])
@pytest.mark.parametrize("loose", [False, True])
def test_no_order_of_few_stops_is_shorter(stages, loose):
    for seed in range(4):
        table, own = plant(seed, 6, stages, loose)
        orders = (list(order) for order in itertools.permutations(range(1, 7)))
        best = min(length_of(table, order) for order in orders if keeps_stages(order, own))
        found = shortest_order(table, own)
        assert keeps_stages(found, own)
        assert length_of(table, found) == pytest.approx(best)


def test_the_order_of_many_stops_is_within_five_percent_of_the_best():
    for seed in range(9):
        table, own = plant(seed, 10, 1 + seed % 3, loose_start=seed % 2 == 0)
        best = length_of(table, tour._exact(table, own))
        found = tour._mended(table, own)
        assert keeps_stages(found, own)
        assert length_of(table, found) <= 1.05 * best


def test_sixty_stops_are_put_in_order_the_same_each_time():
    table, own = plant(1, 60, 3)
    found = shortest_order(table, own)
    assert keeps_stages(found, own)
    assert found == shortest_order(table, own)
    assert length_of(table, found) < length_of(table, tour._inserted(table, own))


def test_one_stop_and_none_are_orders_too():
    assert shortest_order([[0.0]], []) == []
    assert shortest_order([[0.0, 2.0], [2.0, 0.0]], [5]) == [1]
