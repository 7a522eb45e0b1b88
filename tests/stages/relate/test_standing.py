"""Gauges and small valves that stand on the side of a line without an end there."""

import pytest

import shapes
from piping import VALVE, Plant, R, links, turned
from sketch import UP, X, block


def sampled(gap=0.0, name="valve"):
    """A pipe between two valves with a small one upright on its side."""
    plant = Plant().pipe((0, 0, 0), (2, 0, 0))
    for x in (-0.1, 2.1):
        plant.add(turned(shapes.cylinder(0.08, 0.2), (x, 0, 0), X), VALVE, "valve")
    return plant.add(turned(shapes.cylinder(0.015, 0.1), (1, 0, R + 0.05 + gap), UP), VALVE, name)


@pytest.mark.parametrize(("gap", "joined"), [(-0.002, True), (0.0005, True), (0.004, False)])
def test_a_valve_in_one_mesh_that_is_set_on_a_pipe_is_joined_to_it(gap, joined):
    pairs = links(sampled(gap).graph())
    assert (("V-001", "V-002") in pairs and ("V-002", "V-003") in pairs) is joined


def test_a_handwheel_that_touches_a_pipe_stands_on_none():
    assert links(sampled(name="handwheel").graph()) == [("V-001", "V-002")]


def test_a_valve_that_touches_two_lines_stands_on_none():
    plant = sampled().pipe((1, -1, R + 0.1 + R), (1, 1, R + 0.1 + R))
    assert not any(pair == ("V-001", "V-002") for pair in links(plant.graph()))


@pytest.mark.parametrize(("way", "joined"), [((0, 0, 1), True), ((1, 0, 0), False)])
def test_a_valve_with_a_line_stands_on_another_where_its_own_heads_there(way, joined):
    plant = Plant().pipe((0, 0, 0), (2, 0, 0)).add(turned(shapes.cylinder(0.08, 0.2), (-0.1, 0, 0), X), VALVE, "valve")
    plant.add(block((1, 0, R + 0.03), 0.06), VALVE, "valve")
    start = [1 + 0.03 * way[0], 0, R + 0.03 + 0.03 * way[2]]
    plant.pipe(start, [a + 0.5 * b for a, b in zip(start, way, strict=True)], radius=0.01, bore=0.008)
    assert (("J", "V-002") in links(plant.graph())) is joined
