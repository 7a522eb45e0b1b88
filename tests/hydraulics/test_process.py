import math

import pytest

import cadgraph
from networks import chain, network, pumping, terminal, unit


def line(*kinds):
    """An end that feeds, valves of these kinds with a gauge behind each, and an end that lets out."""
    nodes, names = [terminal(1)], ["X1"]
    for i, kind in enumerate(kinds, 1):
        nodes += [unit(f"V-{i:03d}", kind, ports=("N1", "N2")), unit(f"G-{i:03d}", "pressure gauge")]
        names += [f"V-{i:03d}", f"G-{i:03d}"]
    return network([*nodes, terminal(2)], chain(" ".join([*names, "X2"])))


@pytest.fixture
def plant():
    return cadgraph.Process(pumping())


def test_shutting_a_valve_takes_the_flow_and_the_pressure_behind_it():
    plant = cadgraph.Process(line("gate valve", "gate valve"))
    before = plant.state
    assert before.flow[0] > 0
    after = plant.steady({"V-001": 0.0})
    assert after.flow[0] == pytest.approx(0, abs=1e-9)
    assert after.pressure["unit-G-001"] == pytest.approx(0, abs=1e-3)
    assert before.pressure["unit-G-001"] > 0.3


def test_a_valve_takes_its_time(plant):
    travel = plant.scenario.valves["V-010"].travel
    half = plant.step({"V-010": 0.0}, dt=travel / 2)
    assert half.opening["V-010"] == pytest.approx(0.5)
    assert plant.step(dt=travel).opening["V-010"] == 0


def test_a_needle_lags_behind(plant):
    rest = plant.state.reading["G-003"]
    plant.scenario.gauges["G-003"]
    first = plant.step({"P-001": 0.0, "P-002": 0.0}, dt=1 / 60).reading["G-003"]
    last = plant.step(dt=10.0).reading["G-003"]
    assert last < first < rest
    assert first == pytest.approx(last + (rest - last) * math.exp(-1 / 60 / 0.3), rel=0.05)


@pytest.mark.parametrize(
    ("commands", "said"),
    [
        ({"V-999": 0.0}, "V-999"),
        ({"V-004": 0.0}, "V-004 is a check valve"),
        ({"V-001": 1.5}, "V-001=1.5"),
        ({"V-001": math.nan}, "V-001=nan"),
        ({"G-001": 0.0}, "G-001 can't be set"),
    ],
)
def test_what_can_not_be_commanded_is_said(plant, commands, said):
    with pytest.raises(ValueError, match=said):
        plant.step(commands)
