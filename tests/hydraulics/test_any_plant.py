"""Whatever the network, however odd: it is solved, nothing is lost, and nothing runs back through a check valve."""

import random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cadgraph.hydraulics.process import Process
from cadgraph.hydraulics.scenario_file import read_scenario, write_scenario
from networks import chain, junction, network, terminal, unit
from waterworks import PRESETS, WITHOUT_FIELD, head_gained, imbalance, random_commands

NAMES = [*(f"T-00{i}" for i in (1, 2)), *(f"P-00{i}" for i in (1, 2, 3)), "E-001", *(f"J{i}" for i in (1, 2, 3, 4))]
NAMES += [*(f"X{i}" for i in (1, 2, 3)), *(f"V-00{i}" for i in range(1, 7)), "G-001", "G-002"]
KINDS = {"V-001": "check valve", "V-002": "relief valve", "V-003": "control valve", "V-004": "ball valve"}
KINDS |= {"V-005": "check valve", "V-006": "butterfly valve", "X2": "blind"}
ENDS = st.sampled_from([name + port for name in NAMES for port in (("", ".N1", ".N2") if name[0] in "TPEV" else ("",))])
EDGE = st.tuples(
    ENDS,
    ENDS,
    st.sampled_from(["forward", "backward", "unknown"]),
    st.sampled_from([25, 50, 80, 150, None]),
    st.sampled_from([1.0, 0.25, 30.0, 0.0, None]),
)


def node(name, height):
    at = (float(NAMES.index(name)), 1.0, height)
    if name[0] == "J":
        return junction(int(name[1:]), at)
    if name[0] == "X":
        return terminal(int(name[1:]), KINDS.get(name, "open"), at)
    return unit(name, KINDS.get(name), at, ("N1", "N2"))


def made(rows, seed):
    heights = random.Random(seed)
    used = dict.fromkeys(name.split(".")[0] for row in rows for name in row[:2])
    edges = [e for a, b, flow, size, long in rows for e in chain(f"{a} {b}", size, long, flow)]
    return network([node(name, heights.uniform(0, 6)) for name in used], edges)


networks = st.builds(made, st.lists(EDGE, min_size=1, max_size=24), st.integers(0, 9))


@settings(max_examples=40)
@given(networks, st.integers(0, 1000))
def test_every_state_of_any_network_is_found(graph, seed):
    plant, rng = Process(graph), random.Random(seed)
    for number in range(6):
        commands = random_commands(plant, rng)
        state = plant.step(commands, dt=rng.choice([1 / 60, 30])) if number % 3 == 2 else plant.steady(commands)
        assert plant.solution.settled
        assert imbalance(plant) < 1e-8
        assert head_gained(plant) < 1e-6
        assert plant.solution.flow[plant.balance.condition().one_way].min(initial=0.0) > -1e-8
        vapour = plant.scenario.fluid.vapour
        assert all(value is None or vapour <= value < 1e4 for value in state.pressure.values())


@settings(max_examples=10)
@given(networks)
def test_the_scenario_of_any_network_is_read_back(tmp_path_factory, graph):
    scenario = Process(graph).scenario
    file = write_scenario(scenario, tmp_path_factory.mktemp("any") / "scenario.yaml")
    assert read_scenario(file, graph) == scenario


# Generated plants


@pytest.mark.slow
@pytest.mark.parametrize("preset", WITHOUT_FIELD)
def test_two_hundred_states_of_a_plant(plants, preset):
    plant, rng = plants(preset), random.Random(1)
    for _ in range(200):
        plant.steady(random_commands(plant, rng))
        assert plant.solution.settled
        assert plant.solution.last_step < 1e-8 or plant.solution.steps > 1
        assert imbalance(plant) < 1e-9
        assert head_gained(plant) < 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("preset", PRESETS)
def test_each_valve_of_a_plant_shuts_and_opens_again(plants, preset):
    plant = plants(preset)
    before = plant.solution.flow.copy()
    for tag, opening in list(plant.balance.opening.items()):
        plant.steady({tag: 0.0})
        assert abs(plant.balance.through(tag)) < 1e-9
        plant.steady({tag: opening})
        assert plant.solution.flow * 3600 == pytest.approx(before * 3600, abs=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("preset", PRESETS)
def test_a_plant_flows_as_its_graph_says(plants, preset):
    plant = plants(preset)
    ways = {"forward": 1, "backward": -1, "unknown": 0}
    way = np.array([ways[edge.direction] for edge in plant.network.edges])
    flow = np.array([plant.state.flow[i] for i in range(len(way))])
    assert (flow * way > -1e-7).all()


@pytest.mark.slow
def test_shutting_one_suction_of_three_starves_that_pump_alone(plants):
    plant = plants("pumps")
    before = {tag: plant.balance.through(tag) for tag in ("P-001", "P-002", "P-003")}
    state = plant.steady({"V-003": 0.0})
    assert abs(plant.balance.through("P-002")) < 1e-6
    assert state.cavitating == ("P-002",)
    gauge = plant.network.find("G-003")
    assert -1.0 <= state.pressure[gauge] < -0.9
    # The outlet resists, so that the others take over a part: they run nearer to the end of their curves.
    for tag in ("P-001", "P-003"):
        assert 1.0 < plant.balance.through(tag) / before[tag] < 1.5
