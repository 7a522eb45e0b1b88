"""Groups of parts that hold several devices, cut where these meet."""

import pytest

import shapes
from piping import PIPE, VALVE, Plant, links, ring, tags, turned, valve_mesh
from sketch import UP, X, block


def valves(plant):
    return len(tags(plant.graph()))


@pytest.mark.parametrize("whole", [True, False])
def test_devices_on_both_sides_of_a_nipple_are_two_though_a_lever_reaches_across(whole):
    plant = Plant().pipe((-1, 0, 0), (0, 0, 0)).add(valve_mesh((0.089, 0, 0)), VALVE, "valve")
    plant.pipe((0.178, 0, 0), (0.278, 0, 0))
    end = valve_mesh((0.367, 0, 0), up=(0, 1, 0)) if whole else turned(shapes.cylinder(0.05, 0.178), (0.367, 0, 0), X)
    plant.add(end, VALVE, "valve" if whole else "actuator")
    plant.add(block((0.25, 0, 0.11), (0.25, 0.02, 0.12)), VALVE, "lever")
    graph = plant.graph()
    assert len(graph.units()) == (2 if whole else 1)
    if whole:
        assert ("V-001", "V-002") in links(graph)


def test_a_bent_piece_of_line_at_both_ends_of_a_valve_bypasses_it():
    plant = Plant().pipe((-1, 0, 0), (0, 0, 0)).add(valve_mesh((0.089, 0, 0)), VALVE, "valve").pipe((0.178, 0, 0), X)
    assert valves(plant) == 1


def test_valves_flanged_to_each_other_at_a_fitting_without_a_line_are_two():
    plant = Plant().add(block((0, 0, 0), (0.2, 0.2, 0.2)), PIPE, "cross")
    for start in (0.1, 0.3):
        plant.add(turned(shapes.cylinder(0.075, 0.199), (start + 0.1, 0, 0), X), VALVE, "valve body")
        plant.add(turned(shapes.cylinder(0.04, 0.15), (start + 0.1, 0, 0.14), UP), VALVE, "valve bonnet")
    plant.pipe((0.5, 0, 0), (1.5, 0, 0)).pipe((0, 0.1, 0), (0, 1, 0))
    assert valves(plant) == 2


@pytest.mark.parametrize(("length", "n"), [(0.2, 2), (0.1, 1)])
def test_what_is_called_a_body_is_a_valve_by_itself_where_it_is_longer_than_wide(length, n):
    plant = Plant().pipe((-1, 0, 0), (0, 0, 0)).add(ring((0, 0, 0), X, 0.003, 0.05), PIPE, "gasket")
    plant.add(turned(shapes.cylinder(0.075, 0.2), (0.103, 0, 0), X), VALVE, "valve body")
    plant.add(turned(shapes.cylinder(0.02, 0.3), (0.103, 0, 0.15), UP), VALVE, "valve stem")
    plant.add(turned(shapes.cylinder(0.075, length), (0.203 + length / 2, 0, 0), X), VALVE, "valve body")
    plant.pipe((0.203 + length, 0, 0), (2, 0, 0))
    assert valves(plant) == n
