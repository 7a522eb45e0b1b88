"""Which parts are one unit: pieces that stand on a vessel, and whose they are."""

import pytest

from piping import PIPE, pipe
from sketch import Sketch, block


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
