"""Groups of parts that hold several devices, cut where these meet."""

import pytest

import shapes
from piping import GAUGE, PIPE, VALVE, Plant, R, gauge_mesh, links, merged, ring, tags, turned, valve_mesh
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


def test_a_needle_valve_that_a_lever_reaches_to_is_one_of_its_own():
    plant = Plant().pipe((-1, 0, 0), (0, 0, 0)).pipe((0.18, 0, 0), (1.2, 0, 0))
    for middle in (0.045, 0.135):
        plant.add(turned(shapes.cylinder(0.06, 0.09), (middle, 0, 0), X), VALVE, "valve body")
    plant.add(turned(shapes.cylinder(0.01, 0.08), (0.09, 0, 0.1), UP), VALVE, "valve stem")
    plant.add(block((0.2575, 0, 0.135), (0.335, 0.02, 0.01)), VALVE, "lever")
    plant.pipe((0.45, 0, 0), (0.45, 0, 0.1), radius=0.008, bore=0.005)
    plant.add(block((0.45, 0, 0.135), (0.05, 0.05, 0.07)), VALVE, "valve body")
    plant.add(turned(shapes.cylinder(0.006, 0.06), (0.45, 0.055, 0.135), (0, 1, 0)), VALVE, "valve stem")
    plant.add(gauge_mesh((0.45, 0, 0.17)), GAUGE, "gauge")
    graph = plant.graph()
    assert len(graph.units()) == 3
    assert ("G-001", "V-002") in links(graph)


def test_a_gearbox_and_its_wheel_turn_one_valve_though_each_is_next_to_another_half_of_its_body():
    plant = Plant().pipe((-1, 0, 0), (0, 0, 0)).pipe((0.2, 0, 0), (1, 0, 0))
    for x in (0.05, 0.15):
        plant.add(turned(shapes.tube(0.08, R, 0.1), (x, 0, 0), X), VALVE, "valve body")
    plant.add(block((0.03, 0, 0.11), (0.06, 0.06, 0.06)), VALVE, "gearbox")
    rod, foot = block((0.11, 0, 0.12), (0.1, 0.02, 0.02)), block((0.15, 0, 0.1), (0.02, 0.02, 0.044))
    plant.add(merged(rod, foot), VALVE, "handwheel")
    assert valves(plant) == 1


@pytest.mark.parametrize(("apart", "n"), [(0.066, 2), (0.0, 1)])
def test_gauges_whose_cases_touch_are_as_many_as_have_a_stem_and_a_case(apart, n):
    plant = Plant().pipe((-1, 0, 0), (0, 0, 0)).add(valve_mesh((0.089, 0, 0)), VALVE, "valve").pipe((0.178, 0, 0), X)
    for x in (0.089 - apart / 2, 0.089 + apart / 2) if apart else (0.074, 0.104):
        plant.add(turned(shapes.cylinder(0.008, 0.06), (x, -0.07, 0), (0, 1, 0)), GAUGE, "gauge stem")
        if apart:
            plant.add(turned(shapes.cylinder(0.03, 0.03), (x, -0.13, 0), UP), GAUGE, "gauge case")
    if not apart:
        plant.add(block((0.089, -0.13, 0), (0.1, 0.06, 0.03)), GAUGE, "gauge case")
    assert sum(unit.unit_type == "gauge" for unit in plant.graph().units()) == n


@pytest.mark.parametrize(("names", "n"), [(("valve", "valve"), 2), (("valve", "valve body"), 1)])
def test_two_that_are_called_by_the_name_of_the_whole_are_two_however_short(names, n):
    plant = Plant().pipe((-1, 0, 0), (0, 0, 0)).pipe((0.15, 0, 0), (1, 0, 0))
    for name, (low, high), radius in zip(names, ((0.0, 0.1), (0.1, 0.15)), (0.08, 0.06), strict=True):
        plant.add(turned(shapes.tube(radius, R, high - low), ((low + high) / 2, 0, 0), X), VALVE, name)
    plant.add(block((0.155, 0, 0.1), (0.12, 0.02, 0.1)), VALVE, "lever")
    assert valves(plant) == n


@pytest.mark.parametrize(("check", "cover", "n"), [("valve", 0, 2), ("valve body", 1, 2), ("valve body", 0, 1)])
def test_a_check_valve_on_a_ball_valve_in_halves_is_one_of_its_own_by_its_name_or_bonnet(check, cover, n):
    plant = Plant().pipe((-1, 0, 0), (0, 0, 0)).pipe((0.2, 0, 0), (1, 0, 0))
    flanges = [turned(shapes.tube(0.08, R, 0.02), (x, 0, 0), X) for x in (0.01, 0.09)]
    plant.add(merged(turned(shapes.tube(0.05, R, 0.1), (0.05, 0, 0), X), *flanges), VALVE, check)
    if cover:
        plant.add(turned(shapes.cylinder(0.02, 0.02), (0.05, 0, 0.055), UP), VALVE, "valve bonnet")
    for x, length in ((0.14, 0.08), (0.19, 0.02)):
        plant.add(turned(shapes.tube(0.08, R, length), (x, 0, 0), X), VALVE, "valve body")
    plant.add(block((0.14, 0, 0.1), (0.02, 0.04, 0.05)), VALVE, "actuator")
    assert valves(plant) == n


@pytest.mark.parametrize(("name", "n"), [("valve", 2), ("valve body", 1)])
def test_a_wafer_check_valve_on_a_gate_valve_in_pieces_is_one_of_its_own_by_its_name(name, n):
    plant = Plant().pipe((-1, 0, 0), (0, 0, 0)).pipe((0.2, 0, 0), (1, 0, 0))
    plant.add(turned(shapes.tube(0.07, R, 0.05), (0.025, 0, 0), X), VALVE, name)
    plant.add(turned(shapes.tube(0.08, R, 0.15), (0.125, 0, 0), X), VALVE, "valve body")
    plant.add(turned(shapes.cylinder(0.03, 0.1), (0.125, 0, 0.12), UP), VALVE, "valve bonnet")
    plant.add(turned(shapes.cylinder(0.09, 0.02), (0.125, 0, 0.18), UP), VALVE, "handwheel")
    assert valves(plant) == n


@pytest.mark.parametrize(("turned_by", "n"), [("both", 2), ("one", 1)])
def test_a_valve_on_the_inlet_of_an_angle_valve_is_one_of_its_own_where_each_body_is_turned(turned_by, n):
    plant = Plant().add(block((0, 0, 0), (0.2, 0.2, 0.2)), PIPE, "cross").pipe((0, 0, -0.1), (0, 0, -1))
    for x in (0.2, 0.4):
        plant.add(block((x, 0, 0), (0.2, 0.15, 0.15)), VALVE, "valve body")
        if turned_by == "both" or x < 0.3:
            plant.add(turned(shapes.cylinder(0.03, 0.1), (x, 0, 0.125), UP), VALVE, "valve bonnet")
            plant.add(turned(shapes.cylinder(0.09, 0.02), (x, 0, 0.185), UP), VALVE, "handwheel")
    plant.pipe((0.4, 0, -0.075), (0.4, 0, -1))
    assert valves(plant) == n
