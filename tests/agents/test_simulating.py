"""what_if where a scenario lies beside the graph: simulated, marked as such, and set against the graph's answer."""

import pytest

from cadgraph.agents.plant import Plant
from cadgraph.agents.tools import tool_named
from cadgraph.hydraulics.balance import default_scenario
from cadgraph.hydraulics.scenario_file import write_scenario
from cadgraph.hydraulics.settings import SCENARIO
from networks import chain, junction, network, pumping, terminal, unit


def what_if(graph, folder, close, **more):
    graph.save(folder)
    return tool_named("what_if").ask(Plant.open(folder), {"close": close, **more})


@pytest.fixture
def folder(tmp_path):
    write_scenario(default_scenario(pumping()), tmp_path)
    return tmp_path


def test_without_a_scenario_the_graph_answers_alone(tmp_path):
    answer = what_if(pumping(), tmp_path, "V-002")
    assert "imulated" not in answer.text
    assert "simulated" not in answer.values


def test_with_a_scenario_figures_follow_the_answer_of_the_graph(folder):
    answer = what_if(pumping(), folder, "V-002")
    lines = answer.text.split("\n")
    assert lines[0].startswith("closing V-002: 5 cut off")
    marks = [i for i, line in enumerate(lines) if line.startswith("SIMULATED under scenario.yaml")]
    assert len(marks) == 1
    assert "values are assumed, so figures are no measurements" in lines[marks[0]]
    assert all(not line.startswith("cut off") for line in lines[marks[0] :])
    assert "simulated, mind\tP-001 cavitates: nothing flows to it" in lines
    changed = {one["tag"]: one for one in answer.values["simulated"]["changed"]}
    assert changed["P-001"]["after"] == pytest.approx(0, abs=1e-6)
    assert changed["G-003"]["after"] < changed["G-003"]["before"]


def test_where_both_disagree_it_is_said(tmp_path):
    """Behind the valve stands a tank that the graph knows no way from; the scenario has it filled."""
    nodes = [terminal(1), unit("V-001", "gate valve"), unit("G-001", "flow meter"), terminal(2), terminal(3)]
    graph = network([*nodes, unit("V-002", "gate valve")], chain("X1 V-001 G-001 V-002 X2"))
    file = write_scenario(default_scenario(graph), tmp_path)
    file.write_text("ends: {terminal-002: {role: source, pressure: 2}, terminal-001: {role: sink}}", encoding="utf-8")
    answer = what_if(graph, tmp_path, "V-001")
    assert answer.values["simulated"]["disagreements"] == []
    fed = network([*nodes, unit("V-002", "gate valve")], chain("X1 V-001 G-001 X2") + chain("G-001 V-002 X3"))
    text = "ends: {terminal-002: {role: sink}, terminal-003: {role: source, pressure: 2}}"
    file.write_text(text, encoding="utf-8")
    answer = what_if(fed, tmp_path, "V-001")
    assert any(
        line.startswith("DISAGREE\tthe graph says that G-001 is cut off, but") for line in answer.text.split("\n")
    )


def test_a_pump_against_shut_valves_whose_relief_valve_opens_is_no_disagreement(tmp_path):
    nodes = [terminal(1), unit("P-001", ports=("N1", "N2")), junction(1), unit("V-001", "relief valve", ports=("N1",))]
    ways = chain("X1 P-001.N1", length=1) + chain("P-001.N2 J1 V-002 X2", length=1) + chain("J1 V-001.N1", length=1)
    graph = network([*nodes, unit("V-002", "gate valve"), terminal(2)], ways)
    write_scenario(default_scenario(graph), tmp_path)
    answer = what_if(graph, tmp_path, "V-002")
    (pump,) = answer.values["dead_headed"]
    assert (pump["tag"], pump["why"]) == ("P-001", "until V-001 relieves it, if it is set to")
    assert answer.values["simulated"]["disagreements"] == []


def test_a_scenario_that_can_not_be_used_leaves_the_answer_of_the_graph(folder):
    (folder / SCENARIO).write_text("valves: {V-777: {}}", encoding="utf-8")
    answer = what_if(pumping(), folder, "V-002")
    assert "closing V-002: 5 cut off" in answer.text
    assert "not simulated\t" in answer.text
    assert "V-777" in answer.values["simulated"]["failed"]


def test_what_nobody_can_shut_is_not_simulated(folder):
    assert "not simulated\tV-004 is a check valve" in what_if(pumping(), folder, "V-004").text


def test_other_sources_than_those_of_the_scenario_are_not_simulated(folder):
    answer = what_if(pumping(), folder, "V-002", sources="T-001")
    assert "not simulated\tthe scenario says what feeds" in answer.text
    (folder / SCENARIO).unlink()
    assert "not simulated" not in what_if(pumping(), folder, "V-002", sources="T-001").text
