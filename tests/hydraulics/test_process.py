"""What a plant does when somebody turns its valves and starts or stops its pumps."""

import math
import random
import time

import numpy as np
import pytest

import cadgraph
from cadgraph.hydraulics.process import Process
from cadgraph.hydraulics.scenario_file import write_scenario
from cadgraph.hydraulics.text import standing, state_values
from cadgraph.model.records import Mechanism, Port
from networks import chain, junction, mounted, network, pumping, terminal, unit
from waterworks import head_gained, imbalance, line, random_commands


@pytest.fixture
def plant():
    return Process(pumping())


def edited(process, section, tag, **values):
    """The same plant under another scenario."""
    scenario = process.scenario
    settings = dict(getattr(scenario, section))
    settings[tag] = settings[tag].model_copy(update=values)
    return Process(process.network, scenario.model_copy(update={section: settings}))


def flow_of(process, tag):
    return process.balance.through(tag) * 3600


def test_it_is_a_name_of_the_package():
    assert cadgraph.Process is Process


# Flow and pressure


def test_a_line_flows_as_worked_out_by_hand():
    plant = Process(line("gate valve", length=10.0))
    velocity = plant.state.flow[0] / (math.pi / 4 * 0.08**2)
    scenario = plant.scenario
    sink = scenario.ends["terminal-002"].flow / 3600
    lost = 1e5 / (998.2 * 9.80665)  # 1 bar, as m
    friction = 0.25 / math.log10(4.5e-5 / 0.08 / 3.7 + 5.74 / (velocity * 0.08 / 1.004e-6) ** 0.9) ** 2
    pipes = (friction * 30 / 0.08 + 0.2 + 0.003) * velocity**2 / 2 / 9.80665
    outlet = 3 * lost * (plant.state.flow[0] / sink) ** 2
    assert pipes + outlet == pytest.approx(lost, rel=1e-4)


def test_shutting_a_valve_takes_the_flow_and_the_pressure_behind_it():
    plant = Process(line("gate valve", "gate valve"))
    before = plant.state
    after = plant.steady({"V-001": 0.0})
    assert before.flow[0] > 0
    assert before.pressure["unit-G-001"] > 0.3
    assert set(after.flow.values()) == {0.0}
    assert after.pressure["unit-G-001"] == pytest.approx(0, abs=1e-6)
    assert plant.steady({"V-001": 1.0}).flow == pytest.approx(before.flow, abs=1e-8)


def test_what_is_shut_in_keeps_its_pressure():
    plant = Process(line("gate valve", "gate valve"))
    pressed = plant.steady({"V-002": 0.0})
    held = plant.steady({"V-001": 0.0})
    assert held.pressure["unit-G-001"] == pytest.approx(pressed.pressure["unit-G-001"]) == pytest.approx(1.0)
    assert "unit-G-001" in held.shut_in
    assert "terminal-001" not in held.shut_in


def test_a_half_open_valve_lets_less_through_than_an_open_one():
    plant = Process(line("globe valve"))
    flows = [plant.steady({"V-001": opening}).flow[0] for opening in (0.0, 0.01, 0.1, 0.5, 1.0)]
    assert flows == sorted(flows)
    assert flows[0] == pytest.approx(0, abs=1e-12)
    assert flows[1] > 1e-6


def test_where_nothing_of_known_pressure_is_nobody_knows_what_a_gauge_shows():
    nodes = [terminal(1, "blind"), unit("V-001", "gate valve", ports=("N1", "N2")), unit("G-001", "pressure gauge")]
    state = Process(network([*nodes, terminal(2, "blind")], chain("X1 V-001 G-001 X2"))).state
    assert state.reading["G-001"] is None
    assert any("nobody knows what they show" in remark for remark in state.remarks)


# Pumps


def test_pumps_in_parallel_share_a_loop():
    """A closed loop that nothing feeds."""
    nodes = [junction(1), junction(2), unit("E-001", ports=("N1", "N2"))]
    nodes += [unit(tag, ports=("N1", "N2")) for tag in ("P-001", "P-002")]
    edges = [e for tag in ("P-001", "P-002") for e in chain(f"J1 {tag}.N1") + chain(f"{tag}.N2 J2")]
    plant = Process(network(nodes, [*edges, *chain("J2 E-001.N1"), *chain("E-001.N2 J1")]))
    both = flow_of(plant, "P-001")
    assert both == pytest.approx(flow_of(plant, "P-002"))
    assert both > 5
    assert plant.state.pressure["unit-P-001:N1"] == pytest.approx(plant.scenario.pipes.loop_pressure)
    state = plant.steady({"P-002": 0.0})
    # Nothing holds back what comes round through the one that stands still.
    assert flow_of(plant, "P-001") > both > -flow_of(plant, "P-002") > 1
    assert any(remark.startswith("P-002 stands still, and ") for remark in state.remarks)
    assert imbalance(plant) < 1e-9


def test_a_pump_against_a_shut_valve_gives_its_greatest_head(plant):
    plant.steady({"V-008": 0.0, "V-009": 0.0})
    assert flow_of(plant, "P-001") == pytest.approx(0, abs=1e-6)
    assert -plant.balance.difference("P-001") == pytest.approx(plant.scenario.pressure(40.0), rel=1e-6)
    said = "P-001 runs, and nothing flows through it: valves are shut, or more stands against it than the 3.92 bar"
    assert any(remark.startswith(said) for remark in plant.state.remarks)


@pytest.mark.parametrize("value", ["a", None, True, float("nan"), [1.0]])
def test_a_command_that_is_no_number_is_refused(plant, value):
    with pytest.raises(ValueError, match="give a number from 0"):
        plant.step({"V-008": value}, dt=1.0)


def test_a_pump_too_weak_for_its_check_valve_gives_what_it_can_whatever_was_before(plant):
    found = []
    for before in ({}, {"P-002": 0.9}, {"V-008": 0.0, "V-009": 0.0}):
        plant.steady(before)
        plant.steady({"V-008": 1.0, "V-009": 1.0, "P-001": 1.0, "P-002": 0.4})
        assert flow_of(plant, "P-002") == pytest.approx(0, abs=1e-6)
        assert -plant.balance.difference("P-002") == pytest.approx(plant.scenario.pressure(40.0 * 0.4**2), rel=1e-6)
        assert "unit-P-002:N2" not in plant.state.shut_in
        found.append(plant.state.reading)
    for later in found[1:]:
        assert later == pytest.approx(found[0], rel=1e-4)


def test_a_pump_without_supply_cavitates_and_leaves_the_others_alone(plant):
    before = flow_of(plant, "P-002")
    state = plant.steady({"V-002": 0.0})
    assert flow_of(plant, "P-001") == pytest.approx(0, abs=1e-6)
    assert flow_of(plant, "P-002") >= before
    assert state.cavitating == ("P-001",)
    assert state.pressure["unit-G-001"] >= plant.scenario.fluid.vapour
    assert "P-001 cavitates: nothing flows to it" in state.remarks


def test_a_throttled_pump_draws_only_what_reaches_it_at_the_pressure_at_which_it_boils(plant):
    state = plant.steady({"V-002": 0.02})
    assert state.cavitating == ("P-001",)
    assert state.pressure["unit-P-001:N1"] == pytest.approx(plant.scenario.fluid.vapour)
    assert 0 < flow_of(plant, "P-001") < flow_of(plant, "P-002")
    assert imbalance(plant) < 1e-9
    assert plant.steady({"V-002": 1.0}).cavitating == ()


def test_a_pump_that_nothing_holds_back_says_so(plant):
    assert not any("nothing holds it back" in remark for remark in Process(relieved()).state.remarks)
    plant = edited(plant, "pumps", "P-001", flow=1.0)
    assert any(remark.startswith("P-001 moves") for remark in plant.state.remarks)


def test_speed_changes_the_head_by_its_square(plant):
    plant.steady({"V-008": 0.0, "V-009": 0.0, "P-001": 0.5, "P-002": 0.0})
    assert -plant.balance.difference("P-001") == pytest.approx(plant.scenario.pressure(10.0), rel=1e-6)


# Valves that move by themselves


@pytest.mark.parametrize(
    "order", [({"V-001": 0}, {"P-001": 0}), ({"P-001": 0}, {"V-001": 0}), ({"V-001": 0, "P-001": 0},)]
)
def test_what_a_starved_pump_draws_empty_is_not_filled_through_a_check_valve(plant, order):
    for commands in order:
        state = plant.steady(commands)
    assert state.cavitating == ("P-002",)
    assert {"unit-G-001", "unit-G-002"} <= state.shut_in
    assert state.reading["G-001"] == state.reading["G-002"] == 0.0
    assert state.opening["V-004"] == 0.0


def test_a_check_valve_holds_back_what_comes_from_the_other_pump(plant):
    assert plant.steady({"P-001": 0.0}).opening["V-004"] == 0
    assert flow_of(plant, "V-004") == 0
    assert flow_of(plant, "V-006") > 1


def test_without_the_check_valve_it_flows_back_through_a_bypass():
    """A valve of unknown kind holds back once somebody says that it is a check valve."""
    nodes = [unit("T-001", at=(0, 0, 8.0), ports=("N1",)), unit("V-001", ports=("N1", "N2")), terminal(1)]
    nodes += [unit("T-002", ports=("N1",))]
    graph = network(nodes, chain("T-002.N1 V-001.N1 ", direction="unknown") + chain("V-001.N2 T-001.N1"))
    plant = Process(graph)
    assert flow_of(plant, "V-001") < -1
    checked = edited(plant, "valves", "V-001", duty="check", towards="N2", opening=None, travel=None)
    assert flow_of(checked, "V-001") == 0


def relieved():
    """A pump against a valve, with a relief valve on the side that leads into the open."""
    nodes = [terminal(1), unit("P-001", ports=("N1", "N2")), junction(1), unit("V-001", "relief valve", ports=("N1",))]
    nodes += [unit("V-002", "ball valve", ports=("N1", "N2")), terminal(2)]
    return network(nodes, chain("X1 P-001.N1") + chain("P-001.N2 J1 V-002 X2") + chain("J1 V-001.N1"))


@pytest.mark.parametrize("speed", [0.0, 1e-3])
def test_through_a_pump_that_stands_still_it_flows_as_it_is_driven(speed):
    nodes = [terminal(1), unit("P-001", ports=("N1", "N2")), unit("V-001", "ball valve"), terminal(2)]
    plant = Process(network(nodes, chain("X1 P-001.N1") + chain("P-001.N2 V-001 X2")))
    plant = edited(plant, "ends", "terminal-001", role="source", pressure=2.0)
    plant = edited(plant, "ends", "terminal-002", role="source", pressure=1.0)
    state = plant.steady({"P-001": speed})
    assert flow_of(plant, "P-001") > 1
    assert any(remark.startswith("P-001 stands still, and ") for remark in state.remarks)
    back = edited(plant, "ends", "terminal-002", role="source", pressure=3.0)
    state = back.steady({"P-001": speed})
    assert flow_of(back, "P-001") < -1
    assert any("flow back through it" in remark for remark in state.remarks)
    [said] = [remark for remark in state.remarks if "flow into it" in remark]
    into = -flow_of(back, "P-001")
    assert said == f"terminal-001 is a source, and {into:.2f} m3/h flow into it: more stands against it"


def test_a_scenario_that_says_the_opposite_of_the_graph_is_told(plant):
    assert not any("the other way" in remark for remark in plant.state.remarks)
    turned = edited(plant, "pumps", "P-001", suction=("N2",))
    assert (
        "P-001 draws at N2 in the scenario, and by the graph it flows the other way at N2, N1: take its suction out of "
        "the scenario to follow the graph"
    ) in turned.state.remarks
    turned = edited(plant, "ends", "terminal-001", role="source", pressure=1.0, flow=None)
    assert any(
        remark.startswith("terminal-001 is a source in the scenario, and by the graph it flows the other way there")
        for remark in turned.state.remarks
    )


def test_a_relief_valve_opens_at_its_pressure_and_shuts_again():
    plant = Process(relieved())
    setting = plant.scenario.valves["V-001"].pressure
    assert flow_of(plant, "V-001") == 0
    state = plant.steady({"V-002": 0.0})
    assert flow_of(plant, "V-001") > 0.1
    assert state.pressure["junction-001"] > setting
    assert any("V-001 blows off" in remark for remark in state.remarks)
    plant.steady({"V-002": 1.0})
    assert flow_of(plant, "V-001") == 0


def test_nobody_turns_a_check_or_relief_valve():
    with pytest.raises(ValueError, match="V-001 is a relief valve: it moves by itself"):
        Process(relieved()).steady({"V-001": 1.0})


def test_a_valve_with_one_port_is_shut_and_lets_out_when_it_is_opened():
    nodes = [terminal(1), junction(1), unit("V-001", "ball valve", ports=("N1",)), terminal(2)]
    plant = Process(network(nodes, chain("X1 J1 X2") + chain("J1 V-001.N1", size=15)))
    assert plant.state.opening["V-001"] == 0
    plant.steady({"V-001": 1.0})
    assert flow_of(plant, "V-001") > 0.5
    assert imbalance(plant) < 1e-9


# Tanks


def draining():
    nodes = [unit("T-001", at=(0, 0, 2.0), ports=("N1",)), unit("V-001", "ball valve", ports=("N1", "N2")), terminal(1)]
    plant = Process(network(nodes, chain("T-001.N1 V-001 X1", size=50)))
    return edited(plant, "tanks", "T-001", bottom=2.0, height=2.0, level=1.0, area=0.05)


def test_a_tank_runs_dry_and_no_further():
    plant = draining()
    levels = [plant.step(dt=1.0).level["T-001"] for _ in range(120)]
    assert levels == sorted(levels, reverse=True)
    assert levels[-1] == 0
    assert flow_of(plant, "V-001") == 0
    assert "T-001 is empty" in plant.state.remarks


def test_a_tank_runs_down_to_its_lowest_nozzle():
    plant = edited(draining(), "tanks", "T-001", bottom=1.5)
    for _ in range(120):
        state = plant.step(dt=1.0)
    assert state.level["T-001"] == pytest.approx(0.5, abs=0.03)
    assert "T-001 is down to its lowest nozzle: nothing leaves it" in state.remarks


def test_a_tank_that_is_down_to_an_outlet_above_its_lowest_nozzle_says_so():
    tank = unit("T-001", ports=("N1", "N2")).model_copy(
        update={"ports": (Port(name="N1", point=(0.0, 0.0, 1.5)), Port(name="N2", point=(0.0, 0.0, 0.2)))}
    )
    nodes = [tank, unit("V-001", "ball valve"), terminal(1), unit("V-002", "ball valve"), terminal(2)]
    plant = Process(network(nodes, chain("T-001.N1 V-001 X1") + chain("T-001.N2 V-002 X2", direction="unknown")))
    plant = edited(plant, "tanks", "T-001", bottom=0.0, level=1.0, height=3.0)
    assert "T-001 is down to its outlet N1: nothing leaves it there" in plant.steady({}).remarks
    full = edited(plant, "tanks", "T-001", bottom=0.0, level=2.0, height=3.0)
    assert not any("outlet" in remark for remark in full.steady({}).remarks)


def test_what_leaves_a_tank_is_what_its_level_falls_by():
    plant = draining()
    before, flow = plant.state.level["T-001"], plant.balance.through("V-001")
    after = plant.step(dt=0.5).level["T-001"]
    assert before - after == pytest.approx(flow * 0.5 / 0.05, rel=1e-9)


def test_a_tank_overflows_at_its_height():
    nodes = [terminal(1, at=(0, 0, 9.0)), unit("T-001", ports=("N1",))]
    plant = edited(Process(network(nodes, chain("X1 T-001.N1"))), "tanks", "T-001", height=2.0, level=1.9, area=0.1)
    plant = edited(plant, "ends", "terminal-001", role="source", pressure=1.0, flow=None)
    for _ in range(60):
        state = plant.step(dt=1.0)
    assert state.level["T-001"] == 2.0
    assert any("T-001 overflows" in remark for remark in state.remarks)


def level_gauge(count=1, **more):
    """A tank that drains, with a level gauge on its shell that has no line."""
    nodes, touch = mounted(count, **more)
    nodes += [unit("V-001", "ball valve", ports=("N1", "N2")), terminal(1)]
    return network(nodes, [*touch, *chain("T-001.N1 V-001 X1", size=50)])


def test_a_level_gauge_on_the_shell_of_a_tank_shows_its_level():
    plant = edited(Process(level_gauge()), "tanks", "T-001", bottom=2.0, height=2.0, level=1.0, area=0.05)
    assert plant.state.reading["G-001"] == pytest.approx(1.0)
    state = plant.step(dt=5.0)
    assert state.level["T-001"] < 0.95
    assert state.reading["G-001"] == pytest.approx(state.level["T-001"], abs=0.05)
    assert plant.scenario.gauges["G-001"].why["span"] == "assumed: the height of its tank"
    assert "G-001" in [line.tag for line in standing(plant)]
    assert state_values(plant)["gauges"]["G-001"]["pressure_bar"] is None


def test_a_level_gauge_that_reaches_no_tank_is_not_simulated():
    assert "G-001" not in Process(level_gauge(size=9.0)).scenario.gauges


def test_what_enters_above_the_level_falls_in_and_does_not_run_back():
    nodes = [terminal(1), unit("V-001", "ball valve", ports=("N1", "N2")), unit("T-001", at=(0, 0, 5.0), ports=("N1",))]
    plant = Process(network(nodes, chain("X1 V-001 T-001.N1")))
    plant = edited(plant, "tanks", "T-001", bottom=0.0, level=1.0, height=6.0)
    assert flow_of(plant, "V-001") > 0
    dry = edited(plant, "ends", "terminal-001", pressure=0.0)
    assert flow_of(dry, "V-001") == 0


def test_air_stands_in_what_lies_above_the_level():
    nodes = [unit("T-001", ports=("N1",)), unit("G-001", "pressure gauge", (0, 0, 3.0)), terminal(1, at=(0, 0, 4.0))]
    plant = Process(network(nodes, chain("T-001.N1 G-001 X1")))
    plant = edited(plant, "tanks", "T-001", bottom=0.0, level=1.0, height=2.0)
    assert plant.state.pressure["unit-G-001"] == 0.0
    assert plant.state.pressure["unit-T-001:N1"] == pytest.approx(plant.scenario.pressure(1.0))


# Odd units


def test_a_valve_of_three_ports_shuts_all_of_them():
    nodes = [terminal(1), unit("V-001", "ball valve", ports=("N1", "N2", "N3")), terminal(2), terminal(3)]
    plant = Process(network(nodes, chain("X1 V-001.N1") + chain("V-001.N2 X2") + chain("V-001.N3 X3")))
    assert all(flow > 1e-4 for flow in plant.state.flow.values())
    assert flow_of(plant, "V-001") / 3600 == pytest.approx(plant.state.flow[0])
    assert set(plant.steady({"V-001": 0.0}).flow.values()) == {0.0}


def test_a_pump_with_a_line_on_one_side_moves_nothing_and_says_so():
    plant = Process(network([terminal(1), unit("P-001", ports=("N1",))], chain("X1 P-001.N1")))
    assert "P-001 has a line on one side only: it moves nothing" in plant.state.remarks
    assert set(plant.steady({"P-001": 0.0}).flow.values()) == {0.0}


def test_a_check_valve_with_nothing_behind_it_is_left_out_and_said():
    nodes = [terminal(1), junction(1), unit("V-001", "check valve", ports=("N1",)), terminal(2)]
    plant = Process(network(nodes, chain("X1 J1 X2") + chain("J1 V-001.N1")))
    assert "V-001 is a check valve with nothing behind it: left out" in plant.state.remarks


# Time


def test_a_valve_takes_its_time(plant):
    travel = plant.scenario.valves["V-010"].travel
    assert plant.step({"V-010": 0.0}, dt=travel / 2).opening["V-010"] == pytest.approx(0.5)
    assert plant.step(dt=travel).opening["V-010"] == 0


def test_a_needle_lags_behind(plant):
    rest = plant.state.reading["G-003"]
    first = plant.step({"P-001": 0.0, "P-002": 0.0}, dt=1 / 60).reading["G-003"]
    last = plant.step(dt=10.0).reading["G-003"]
    assert last < first < rest
    assert first == pytest.approx(last + (rest - last) * math.exp(-1 / 60 / 0.3), rel=0.05)


def test_a_step_that_changes_nothing_takes_no_time():
    plant = Process(line("gate valve", "ball valve", "globe valve"))
    plant.step(dt=1.0)
    taken = []
    for _ in range(300):
        start = time.process_time_ns()
        plant.step()
        taken.append(time.process_time_ns() - start)
    assert np.median(taken) < 1e5  # 0.1 ms
    assert plant.state.time == pytest.approx(1.0 + 300 / 60)


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


def test_a_command_that_is_refused_changes_nothing(plant):
    before = plant.state
    with pytest.raises(ValueError, match="V-999"):
        plant.steady({"V-001": 0.0, "V-999": 0.0})
    assert plant.steady().flow == pytest.approx(before.flow, abs=1e-9)


@pytest.mark.parametrize("dt", [0, -1, math.nan, math.inf])
def test_time_goes_forwards_and_comes_to_an_end(plant, dt):
    with pytest.raises(ValueError, match=f"dt {dt}"):
        plant.step(dt=dt)


# Joints


def lever(tag):
    moves = Mechanism(
        kind="lever", meshes=("/lever",), axis=(0, 0, 1), pivot=(0, 0, 0), radius=0.2, limits=(-90, 0), open=0, shut=-90
    )
    return unit(tag, "ball valve", ports=("N1", "N2")).model_copy(update={"mechanism": moves})


def needle(tag):
    moves = Mechanism(kind="needle", meshes=("/n",), axis=(0, 1, 0), pivot=(0, 0, 0), radius=0.04, limits=(-270, 0))
    return unit(tag, "pressure gauge").model_copy(update={"mechanism": moves})


def turning():
    return Process(network([terminal(1), lever("V/001"), needle("G-001"), terminal(2)], chain("X1 V/001 G-001 X2")))


def test_joints_follow_valves_and_gauges():
    plant = turning()
    reading, span = plant.state.reading["G-001"], plant.scenario.gauges["G-001"].span
    assert plant.joints() == pytest.approx({"V_001": 0.0, "G_001": -270 * reading / span})
    plant.steady({"V/001": 0.0})
    assert plant.joints() == pytest.approx({"V_001": -90.0, "G_001": 0.0})


def test_valves_follow_joints():
    plant = turning()
    plant.from_joints({"V_001": -45.0, "G_001": 12.0})
    assert plant.step().opening["V/001"] == pytest.approx(0.5)
    with pytest.raises(ValueError, match="V_7"):
        plant.from_joints({"V_7": 0.0})
    with pytest.raises(ValueError, match="no angle"):
        plant.from_joints({"V_001": math.inf})


# Any state


def test_every_state_is_balanced_and_heads_fall_along_the_flow(plant):
    rng = random.Random(1)
    for _ in range(60):
        plant.steady(random_commands(plant, rng))
        assert plant.solution.settled
        assert plant.solution.last_step < 1e-8 or plant.solution.steps > 1
        assert imbalance(plant) < 1e-9
        assert head_gained(plant) < 1e-9


def test_the_same_commands_give_the_same_state():
    commands = [random_commands(Process(pumping()), random.Random(seed)) for seed in range(5)]
    first, second = Process(pumping()), Process(pumping())
    for each in commands:
        assert first.steady(each) == second.steady(each)


def test_a_folder_is_opened_with_its_scenario(plant, tmp_path):
    plant.network.graph.save(tmp_path)
    other = edited(plant, "pumps", "P-001", running=0.0)
    write_scenario(other.scenario, tmp_path)
    assert flow_of(Process(tmp_path), "P-001") == pytest.approx(0, abs=1e-6)
    assert Process(tmp_path).state == other.state
