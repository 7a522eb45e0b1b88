"""Solids that are joined without a line between: flanged, run into each other, or a gauge screwed into a device."""

import pytest

import shapes
from cadgraph.stages.relate.attach import flat_contacts
from piping import FASTENER, GAUGE, PIPE, PUMP, STEEL, TANK, VALVE, Plant, gauge_mesh, links, merged, turned, valve_mesh
from sketch import UP, Sketch, X, block


def line_with_valve():
    """A valve in a run along x, its body a ball of 50 mm around (0.589, 0, 0)."""
    plant = Plant().pipe((0, 0, 0), (0.5, 0, 0)).pipe((0.678, 0, 0), (1.2, 0, 0))
    return plant.add(valve_mesh((0.589, 0, 0)), VALVE, "valve")


@pytest.mark.parametrize(("gap", "joined"), [(0.0, True), (0.001, True), (0.006, False)])
def test_a_gauge_screwed_into_a_valve_is_joined_to_it(gap, joined):
    plant = line_with_valve().add(gauge_mesh((0.589, -0.05 - gap, 0), up=(0, -1, 0), side=(0, 0, 1)), GAUGE, "gauge")
    graph = plant.graph()
    assert (("G-001", "V-001") in links(graph)) is joined
    if joined:
        [joint] = [joint for joint in graph.joints() if joint.kind == "flange"]
        assert joint.reasons == ("no line ends at it, and it touches this",)
        assert joint.gap == pytest.approx(gap, abs=5e-4)


def test_a_gauge_that_only_leans_on_a_lever_is_not_joined_to_its_valve():
    plant = line_with_valve()
    plant.add(block((0.75, 0, 0.1), (0.3, 0.02, 0.01)), VALVE, "lever")
    plant.add(gauge_mesh((0.85, 0, 0.105)), GAUGE, "gauge")
    assert not any("G-001" in pair for pair in links(plant.graph()))


def test_a_gauge_between_two_devices_is_screwed_into_the_nearer_one():
    plant = line_with_valve().add(gauge_mesh((0.589, -0.0505, 0), up=(0, -1, 0), side=(0, 0, 1)), GAUGE, "gauge")
    plant.add(block((0.589, -0.25, 0), (0.3, 0.222, 0.2)), PUMP, "pump casing")
    plant.pipe((0.589, -0.361, 0), (0.589, -1, 0))
    assert [pair for pair in links(plant.graph()) if "G-001" in pair] == [("G-001", "P-001")]


def with_gauge(group=TANK, name="tank"):
    """A gauge on the side of a block that a pipe leads to."""
    plant = Plant().add(block((0, 0, 0), 1.0), group, name)
    plant.add(gauge_mesh((0.5, 0, 0), up=X, side=(0, 0, 1)), GAUGE, "gauge")
    return plant.pipe((0, 0, 0.5), (0, 0, 1.5))


def test_a_gauge_that_touches_a_tank_and_nothing_else_hangs_on_it():
    graph = with_gauge().graph()
    assert ("G-001", "T-001") in links(graph)
    plant = with_gauge().add(block((0.53, 0.03, 0), (0.06, 0.02, 0.02)), FASTENER, "bolt")
    assert ("G-001", "T-001") in links(plant.graph())


def test_what_touches_the_gauge_alone_does_not_hold_it():
    plant = with_gauge().add(block((0.56, 0.0, -0.05), (0.02, 0.02, 0.1)), None)
    assert ("G-001", "T-001") in links(plant.graph())


@pytest.mark.parametrize(("group", "name"), [(STEEL, "post"), (PIPE, "coupling")])
def test_one_that_touches_more_may_but_lean_on_the_tank(group, name):
    plant = with_gauge().add(block((0.56, 0.0, -0.05), (0.02, 0.02, 0.1)), group, name)
    plant.add(block((0.56, 0.0, -0.2), (0.2, 0.2, 0.2)), STEEL, "beam")
    assert not any({"G-001", "T-001"} == set(pair) for pair in links(plant.graph()))


def test_a_wall_is_no_tank():
    assert not any("G-001" in pair for pair in links(with_gauge("Structural element", "wall").graph()))


@pytest.mark.parametrize(("name", "joined"), [("valve body", True), ("lever", False)])
def test_what_moves_a_valve_is_flanged_to_nothing(name, joined):
    plant = line_with_valve()
    plant.add(turned(shapes.cylinder(0.03, 0.1), (0.589, -0.099, 0), (0, 1, 0)), VALVE, name)
    plant.add(turned(shapes.cylinder(0.03, 0.3), (0.589, -0.299, 0), (0, 1, 0)), PUMP, "pump casing")
    assert (("P-001", "V-001") in links(plant.graph())) is joined


@pytest.mark.parametrize(("into", "joined"), [(0.0, True), (0.01, True), (0.06, False)])
def test_units_that_run_into_each_other_by_part_of_their_width_are_joined(into, joined):
    plant = Plant().add(block((0, 0, 0), 0.6), TANK, "tank")
    plant.add(turned(shapes.cylinder(0.0135, 0.1), (0.35, 0, 0), X), TANK, "nozzle")
    flange = turned(shapes.cylinder(0.035, 0.012), (0.406 - into, 0, 0), X)
    plant.add(merged(flange, turned(shapes.cylinder(0.009, 0.188), (0.506 - into, 0, 0), X)), VALVE, "valve")
    plant.pipe((0.6 - into, 0, 0), (1.5, 0, 0))
    assert (("T-001", "V-001") in links(plant.graph())) is joined


@pytest.mark.parametrize("stub", [0.006, 0.015, 0.04])
def test_small_stubs_are_flanged_to_each_other_as_wide_ones_are(stub):
    sketch = Sketch()
    sketch.add(merged(block((0, 0, 0), (0.1, 0.1, 0.06)), turned(shapes.cylinder(stub, 0.03), (0, 0, 0.045), UP)))
    sketch.add(merged(*(turned(shapes.cylinder(*size), (0, 0, z), UP) for size, z in (
        ((stub, 0.01), 0.065), ((2 * stub, 0.2), 0.17)))))  # fmt: skip
    given = sketch.given()
    assert list(flat_contacts(given.parts, given.contacts, [(0, 1)], given.config.cluster.eps)) == [(0, 1)]


@pytest.mark.parametrize(("others", "joined"), [((), True), ((0.07,), False)])
def test_a_valve_without_a_line_is_screwed_into_the_only_device_that_it_touches(others, joined):
    plant = line_with_valve()
    stub, body = (turned(shapes.cylinder(*size), (0.589, y, 0), (0, 1, 0)) for size, y in (
        ((0.008, 0.03), -0.064), ((0.04, 0.06), -0.108)))  # fmt: skip
    plant.add(merged(stub, body), VALVE, "valve")
    for aside in others:
        plant.add(block((0.589 + aside, -0.12, 0), 0.06), PUMP, "pump casing")
    assert (("V-001", "V-002") in links(plant.graph())) is joined
