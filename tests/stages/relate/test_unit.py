"""Which parts are one unit: pieces that stand on a vessel, and whose they are."""

import pytest

import shapes
from piping import GAUGE, PIPE, VALVE, pipe, ring, turned
from sketch import Sketch, X, block


def units(*bodies):
    """Type and parts of each unit where two vessels a metre apart have a nozzle with a pipe between them."""
    sketch = Sketch()
    for x, (group, name) in zip((-0.5, 2.5), bodies, strict=False):
        sketch.add(block((x, 0, 0), 1.0), group, name, source="author")
    for start, end in ((0.0, 0.15), (1.85, 2.0)):
        sketch.add(pipe((start, 0, 0), (end, 0, 0)), "Tank", "nozzle", source="author")
    sketch.add(pipe((0.15, 0, 0), (1.85, 0, 0)), PIPE, "pipe", source="author")
    return [(unit.unit_type, unit.parts) for unit in sketch.connected().network.units]


@pytest.mark.parametrize("body", [("Equipment", "boiler"), ("Pump unit", "pump casing")])
def test_a_nozzle_of_a_machine_is_no_tank(body):
    kind = "equipment" if body[0] == "Equipment" else "pump"
    assert units(body, body) == [(kind, (0, 2)), (kind, (1, 3))]


def test_a_nozzle_of_a_tank_is_a_piece_of_it():
    assert units(("Tank", "shell"), ("Equipment", "boiler")) == [("equipment", (1, 3)), ("tank", (0, 2))]


def test_a_nozzle_between_two_machines_is_of_none():
    sketch = Sketch()
    for x in (-0.5, 0.65):
        sketch.add(block((x, 0, 0), 1.0), "Equipment", "boiler", source="author")
    sketch.add(pipe((0.0, 0, 0), (0.15, 0, 0)), "Tank", "nozzle", source="author")
    assert all(2 not in unit.parts for unit in sketch.connected().network.units if unit.unit_type == "equipment")


def driven_by_a_motor(group, name):
    """Type and parts of each unit where a motor stands at a body on a pipe."""
    sketch = Sketch()
    sketch.add(block((-0.5, 0, 0), 1.0), group, name, source="author")
    sketch.add(block((-1.2, 0, 0), 0.4), "Pump unit", "motor", source="author")
    sketch.add(pipe((0.0, 0, 0), (1.0, 0, 0)), PIPE, "pipe", source="author")
    return [(unit.unit_type, unit.parts) for unit in sketch.connected().network.units]


def test_the_motor_of_a_compressor_is_no_pump():
    assert driven_by_a_motor("Equipment", "compressor") == [("equipment", (0, 1))]


def test_a_motor_at_what_needs_none_stays_that_of_a_pump():
    assert ("equipment", (0,)) in driven_by_a_motor("Equipment", "filter")


@pytest.mark.parametrize(("source", "beside", "taken"), [
    ("geometry", False, True), ("author", False, False), ("geometry", True, False),
])  # fmt: skip
def test_a_disc_that_touches_but_a_gauge_is_its_dial(source, beside, taken):
    sketch = Sketch()
    sketch.pipe((-1, 0, 0), (0, 0, 0))
    sketch.add(turned(shapes.cylinder(0.05, 0.06), (0.03, 0, 0), X), GAUGE, "gauge case")
    sketch.add(turned(shapes.cylinder(0.06, 0.01), (0.065, 0, 0), X), PIPE, "flange", source=source, sure=0.7)
    if beside:
        sketch.pipe((0.07, 0, 0), (1, 0, 0))
    [unit] = sketch.connected().network.units
    assert (unit.unit_type, 2 in unit.parts) == ("gauge", taken)


def sandwiched(*, disc, label=None):
    """Type and parts of each unit where a ring with a disc in it lies between two pipes, and a lever stands on it."""
    sketch = Sketch()
    sketch.add(ring((0, 0, 0), X, 0.05, outer=0.08, inner=0.028), *label or (), sure=0.6)
    if disc:
        sketch.add(turned(shapes.cylinder(0.028, 0.006), (0.025, 0, 0), X), VALVE, "valve disc")
    sketch.add(block((0.025, 0, 0.12), (0.02, 0.02, 0.08)), VALVE, "lever")
    sketch.pipe((-1, 0, 0), (0, 0, 0))
    sketch.pipe((0.05, 0, 0), (1, 0, 0))
    return [(unit.unit_type, unit.parts) for unit in sketch.connected().network.units]


@pytest.mark.parametrize("label", [None, (PIPE, None)])
def test_what_holds_the_disc_of_a_valve_is_its_body(label):
    assert sandwiched(disc=True, label=label) == [("valve", (0, 1, 2))]


def test_a_named_piece_of_piping_that_holds_a_disc_stays_one():
    assert all(0 not in parts for _, parts in sandwiched(disc=True, label=(PIPE, "flange")))


@pytest.mark.parametrize(("name", "count"), [("lifting lug", 0), ("tank leg", 0), ("shell", 1)])
def test_lugs_and_legs_without_a_vessel_are_no_tank(name, count):
    sketch = Sketch()
    sketch.add(block((0, 0, 0), 0.1), "Tank", name, source="author")
    sketch.pipe((3, 0, 0), (4, 0, 0), source="author")
    connected = sketch.connected()
    assert len(connected.network.units) == count
    told = [one.meshes for one in connected.diagnostics if one.code == "loose-fitting"]
    assert told == ([] if count else [("/m0",)])


@pytest.mark.parametrize(("source", "n"), [("author", 2), (None, 1)])
def test_two_vessels_in_a_bracket_are_two_where_somebody_says_that_it_is_one(source, n):
    sketch = Sketch()
    for x in (0.0, 1.4):
        sketch.add(turned(shapes.cylinder(0.4, 2.0), (x, 0, 0), (0, 0, 1)), "Tank", "shell", source="author")
    said = {"group": "Connection assembly", "name": "bracket", "source": source} if source else {}
    sketch.add(block((0.7, 0, 0), (0.62, 0.1, 0.1)), **said)
    assert sum(unit.unit_type == "tank" for unit in sketch.connected().network.units) == n


@pytest.mark.parametrize(("size", "found"), [((0.08, 0.002, 0.08), True), ((0.08, 0.002, 0.04), False)])
def test_a_dial_by_itself_is_a_gauge_where_it_is_as_wide_as_long_and_else_a_nameplate(size, found):
    sketch = Sketch()
    sketch.add(block((0, 0, 0), 0.3), "Pump unit", "pump", source="author")
    sketch.pipe((0.15, 0, 0), (1, 0, 0), source="author")
    sketch.add(block((0, 0.151, 0), size), GAUGE, "gauge face", sure=0.64)
    connected = sketch.connected()
    assert any(unit.unit_type == "gauge" for unit in connected.network.units) is found
    assert [one.meshes for one in connected.diagnostics if one.code == "loose-dial"] == ([] if found else [("/m2",)])


@pytest.mark.parametrize(("name", "above", "n"), [
    ("dished head", 0.012, 1), ("dished head", 0.03, 2), ("shell", 0.012, 2),
])  # fmt: skip
def test_a_lid_a_little_over_a_shell_is_a_piece_of_its_tank(name, above, n):
    sketch = Sketch()
    sketch.add(turned(shapes.cylinder(0.45, 1.2), (0, 0, 0.6), (0, 0, 1)), "Tank", "shell", source="author")
    sketch.add(turned(shapes.cylinder(0.46, 0.1), (0, 0, 1.25 + above), (0, 0, 1)), "Tank", name, source="author")
    sketch.pipe((0.45, 0, 0.5), (1.5, 0, 0.5), source="author")
    sketch.pipe((0.2, 0, 1.3 + above), (0.2, 0, 2.5), source="author")
    assert sum(unit.unit_type == "tank" for unit in sketch.connected().network.units) == n


def test_a_nozzle_that_ends_within_the_corners_of_a_shell_is_a_piece_of_its_tank():
    sketch = Sketch()
    sketch.add(block((0, 0, 0), 1.0), "Tank", "shell", source="author")
    sketch.add(pipe((0.3, 0, 0), (0.45, 0, 0)), "Tank", "nozzle", source="author")
    sketch.pipe((0.45, 0, 0), (2, 0, 0), source="author")
    [tank] = [unit for unit in sketch.connected().network.units if unit.unit_type == "tank"]
    assert tank.parts == (0, 1)
