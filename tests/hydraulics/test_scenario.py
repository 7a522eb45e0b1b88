"""What is supposed of a plant, why, and how it is read back from a file."""

import numpy as np
import pytest

import graphs
from cadgraph.errors import ScenarioError
from cadgraph.hydraulics.balance import default_scenario
from cadgraph.hydraulics.process import Process
from cadgraph.hydraulics.scenario import SPANS
from cadgraph.hydraulics.scenario_file import read_scenario, scenario_text, write_scenario
from cadgraph.hydraulics.text import assumptions
from cadgraph.model.records import Mechanism, OrientedBox
from networks import chain, junction, network, pumping, terminal, unit
from waterworks import line


@pytest.fixture(scope="module")
def graph():
    return pumping()


def read(text, graph, tmp_path):
    file = tmp_path / "scenario.yaml"
    file.write_text(text, encoding="utf-8")
    return read_scenario(file, graph)


def test_every_value_says_why(graph):
    for section, tag, setting in default_scenario(graph).sections():
        silent = set(setting.values()) - set(setting.why) - {"unit"}
        assert silent == set(), (section, tag)


def test_what_is_written_is_read_back_with_its_reasons(graph, tmp_path):
    scenario = default_scenario(graph)
    file = write_scenario(scenario, tmp_path)
    assert file.name == "scenario.yaml"
    again = read_scenario(file, graph)
    assert again == scenario
    assert scenario_text(again) == file.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("before", "after", "words"),
    [
        ("gate valve", "check valve", "V-001 is a check valve by the graph, and is moved by hand in the scenario"),
        ("check valve", "gate valve", "V-001 is a gate valve by the graph, and checks in the scenario"),
        ("gate valve", "globe valve", None),
        ("gate valve", None, None),
    ],
)
def test_a_scenario_that_has_a_valve_do_what_its_kind_does_not_is_said(before, after, words, tmp_path):
    def one_of(kind):
        return network([unit("T-001"), unit("V-001", kind), terminal(1)], chain("T-001 V-001 X1"))

    file = write_scenario(default_scenario(one_of(before)), tmp_path)
    remarks = Process(one_of(after), file).state.remarks
    assert [text for text in remarks if "by the graph" in text][:1] == (
        [f"{words}: take it out of the scenario to follow the graph"] if words else []
    )


def test_a_scenario_in_which_a_check_valve_lets_out_against_the_flow_is_said(tmp_path):
    def flowing(direction):
        nodes = [unit("T-001"), unit("V-001", "check valve", ports=("N1", "N2")), terminal(1)]
        edges = [*chain("T-001 V-001.N1", direction=direction), *chain("V-001.N2 X1", direction=direction)]
        return network(nodes, edges)

    file = write_scenario(default_scenario(flowing("forward")), tmp_path)
    assert not any("lets out" in text for text in Process(flowing("forward"), file).state.remarks)
    [told] = [text for text in Process(flowing("backward"), file).state.remarks if "lets out" in text]
    assert told.startswith("V-001 lets out at N2 in the scenario, and by the graph it flows the other way")


def plant(*order):
    """A tank and three valves in a row, whose tags are given in an order that a correction may change."""
    parts = [graphs.part(k, f"/body {k}") for k in range(4)]
    units = [
        unit(tag, "gate valve" if k else None).model_copy(update={"parts": (parts[k].id,)})
        for k, tag in enumerate(("T-001", *order))
    ]
    return network([*parts, *units, terminal(1)], chain(" ".join(["T-001", *order, "X1"])))


def test_a_name_that_stands_for_another_unit_now_is_refused(tmp_path):
    before, now = plant("V-001", "V-002", "V-003"), plant("V-003", "V-001", "V-002")
    file = write_scenario(default_scenario(before), tmp_path)
    assert read_scenario(file, before).names == {"T-001": "/body 0"} | {f"V-00{k}": f"/body {k}" for k in (1, 2, 3)}
    with pytest.raises(ScenarioError) as told:
        read_scenario(file, now)
    words = "(V-001 is V-003 now, V-002 is V-001 now, V-003 is V-002 now); put the names of now"
    assert words in str(told.value)
    assert "\n" not in str(told.value)


@pytest.mark.parametrize("used", ["valves: {v1: {opening: 0.5}}", 'play: [{at: 1, over: 1, set: {"V-001": 0}}]'])
def test_only_names_that_a_file_uses_must_be_those_of_now(used, tmp_path):
    names = 'names: {"V-001": "/body 1", "V-002": "/body 2"}'
    if "v1" not in used:
        assert read(f"{used}\n{names}", plant("V-001", "V-003", "V-002"), tmp_path)
    with pytest.raises(ScenarioError, match=r"V-001 is V-002 now\)"):
        read(f"{used}\n{names}", plant("V-002", "V-001", "V-003"), tmp_path)
    with pytest.raises(ScenarioError, match="V-001 is no unit now"):
        read(f"{used}\n{names.replace('/body 1', '/gone')}", plant("V-001", "V-002", "V-003"), tmp_path)
    assert read(used, plant("V-002", "V-001", "V-003"), tmp_path), "written by hand, without them"


def test_reasons_are_comments(graph):
    text = scenario_text(default_scenario(graph))
    assert "opening: 1.0  # assumed: open" in text
    assert '"V-004":\n    duty: "check"  # its kind: check valve' in text


def test_what_a_file_leaves_out_is_supposed_and_what_it_says_is_given(graph, tmp_path):
    scenario = read('valves: {v1: {opening: 0.5}}\npumps: {"P-001": {head: 20}}', graph, tmp_path)
    default = default_scenario(graph)
    assert scenario.valves["V-001"].opening == 0.5
    assert scenario.valves["V-001"].why["opening"] == "given in scenario.yaml"
    assert scenario.valves["V-001"].why["k"] == default.valves["V-001"].why["k"]
    assert scenario.pumps["P-001"].flow == default.pumps["P-001"].flow
    assert scenario.pumps["P-002"] == default.pumps["P-002"]


def test_an_empty_file_supposes_everything(graph, tmp_path):
    assert read("", graph, tmp_path) == default_scenario(graph)


def test_what_somebody_says_is_counted_no_longer_as_assumed(graph, tmp_path):
    said = read('pumps: {"P-001": {head: 25}}', graph, tmp_path)
    counts = [assumptions(Process(graph, scenario)) for scenario in (default_scenario(graph), said)]
    assert [each["pumps, head", "30 m"] for each in counts] == [2, 1]


def test_a_valve_that_is_said_to_be_a_check_valve_gets_its_way_from_the_flow(graph, tmp_path):
    scenario = read('valves: {"V-012": {duty: check}}', graph, tmp_path)
    valve = scenario.valves["V-012"]
    assert (valve.duty, valve.opening) == ("check", None)
    assert valve.towards is not None


def test_an_end_that_is_said_to_feed_gets_a_pressure(graph, tmp_path):
    scenario = read("ends: {terminal-001: {role: source, pressure: 2.5}}", graph, tmp_path)
    assert scenario.ends["terminal-001"].pressure == 2.5
    assert scenario.ends["terminal-001"].flow is None


def test_a_gauge_that_measures_something_else_has_its_unit_and_a_scale_anew(tmp_path):
    graph = pumping()
    (tmp_path / "scenario.yaml").write_text("gauges: {G-004: {measures: flow}}", encoding="utf-8")
    gauge = read_scenario(tmp_path / "scenario.yaml", graph).gauges["G-004"]
    assert (gauge.measures, gauge.unit) == ("flow", "m3/h")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("valves: {V-99: {opening: 1}}", "valves: nothing in the graph is called 'V-99'"),
        ("valves: {V-001: {opening: 2}}", "V-001: opening must be at most 1, not 2"),
        ("valves: {V-001: {opening: -0.1}}", "V-001: opening must be at least 0"),
        ("valves: {V-001: {openin: 1}}", "did you mean opening?"),
        ("valves: {V-001: {opening: yes}}", "opening must not be true"),
        ("valves: {V-001: {why: {k: x}}}", "nothing is called 'why'"),
        ("valves: {V-001: {k: '<b>'}}", "k must be a number"),
        ("valves: {V-001: {duty: gate}}", "duty must be hand, check, relief, not 'gate'"),
        ("valves: {V-004: {towards: N9}}", "towards must be"),
        ("valves: {V-004: {opening: 0}}", "a check valve moves by itself and has no opening"),
        ("valves: {V-001: {pressure: 3}}", "pressure is what a relief valve opens at"),
        ("gauges: {G-001: {unit: m}}", "what measures pressure has the unit bar, not m"),
        ("valves: {V-001: {opening: 1}, v1: {opening: 0}}", "V-001 is there twice"),
        ("valves: 3", "must be a table"),
        ("pumps: {V-001: {head: 3}}", "pumps: V-001 is a gate valve"),
        ("pumps: {P-001: {head: 0}}", "head must be above 0"),
        ("pumps: {P-001: {suction: [N7]}}", "no port 'N7'"),
        ("fluid: {density: .nan}", "density must be a finite number"),
        ("ends: {terminal-001: {role: sink, pressure: 1}}", "a source has a pressure, a sink none"),
        ("ends: {terminal-001: {role: drain}}", "role must be source, sink, blind"),
        ("tanks: {T-001: {level: 999}}", "level 999 is above its height"),
        ("gauges: {G-001: {span: 0}}", "span must be above 0"),
        ("play: {at: 1}", "play: must be a list"),
        ("play: [{at: -1, set: {V-001: 0}}]", "play: 1: at must be at least 0"),
        ("play: [{at: 1, set: {V-004: 0}}]", "V-004 can't be set"),
        ("play: [{at: 1, set: {V-001: 7}}]", "V-001 must be from 0 to 1"),
        ("colour: red", "nothing is called 'colour'"),
        ("- 1", "must be a table"),
        ("a: [", "not YAML"),
        ("valves: {}\nvalves: {}", "is there twice"),
        ("!!python/object/apply:os.system [ls]", "not YAML"),
    ],
)
def test_what_can_not_be_is_one_clear_line(graph, tmp_path, text, said):
    with pytest.raises(ScenarioError) as refused:
        read(text, graph, tmp_path)
    assert said in str(refused.value)
    assert "scenario.yaml: " in str(refused.value)
    assert "\n" not in str(refused.value)


def test_a_timetable_is_read_in_its_order(graph, tmp_path):
    scenario = read("play: [{at: 20, set: {P-001: 0}}, {at: 2, over: 10, set: {v1: 0}}]", graph, tmp_path)
    assert [(move.at, move.over, move.set) for move in scenario.play] == [(2, 10, {"V-001": 0}), (20, 0, {"P-001": 0})]
    file = write_scenario(scenario, tmp_path)
    assert read_scenario(file, graph).play == scenario.play


def test_names_from_a_plant_stay_text(tmp_path):
    """A tag with quotes, colons, line breaks and control characters is text of one line, and comes back as it was."""
    tag = 'V"1: [x]\n# y\x1b[31m{}'
    valve = unit("V-001", "ball valve", ports=("N1", "N2")).model_copy(
        update={"tag": tag, "kind": "ball valve\n- x: 1"}
    )
    graph = network([terminal(1), valve, terminal(2)], chain("X1 V-001 X2"))
    scenario = default_scenario(graph)
    file = write_scenario(scenario, tmp_path)
    assert "\x1b" not in file.read_text(encoding="utf-8")
    assert read_scenario(file, graph) == scenario


# What is supposed


def test_a_lever_says_how_far_its_valve_is_open():
    moves = Mechanism(
        kind="lever", meshes=("/m",), axis=(0, 0, 1), pivot=(0, 0, 0), radius=0.2, limits=(0, 90), open=90.0, shut=0.0
    )
    valve = unit("V-001", "ball valve", ports=("N1", "N2")).model_copy(update={"mechanism": moves})
    scenario = default_scenario(network([terminal(1), valve, terminal(2)], chain("X1 V-001 X2")))
    assert scenario.valves["V-001"].opening == 0
    assert scenario.valves["V-001"].why["opening"] == "as its lever is drawn"
    assert scenario.valves["V-001"].turns == 0.25


def test_gauges_get_the_next_usual_span(graph):
    process = Process(graph)
    for tag, gauge in process.scenario.gauges.items():
        if gauge.measures != "pressure":
            continue
        shown = process.state.reading[tag]
        assert gauge.span in SPANS
        assert shown <= gauge.span * 0.75 + 1e-9
        below = [span for span in SPANS if span < gauge.span]
        assert not below or shown * 4 / 3 > below[-1]


def test_sinks_together_take_no_more_than_the_pumps_are_for(graph):
    scenario = default_scenario(graph)
    sinks = sum(end.flow for end in scenario.ends.values() if end.flow)
    assert sinks <= sum(pump.flow for pump in scenario.pumps.values()) + 0.1


def test_an_end_of_a_system_that_nothing_feeds_is_supposed_to_feed():
    edges = chain("X1 V-001 X2", direction="unknown")
    scenario = default_scenario(network([terminal(1), unit("V-001", "ball valve"), terminal(2)], edges))
    assert [end.role for end in scenario.ends.values()] == ["source", "sink"]
    assert "nothing else feeds" in scenario.ends["terminal-001"].why["role"]


def test_a_pump_of_unknown_direction_draws_from_its_widest_port_and_from_the_end_there():
    nodes = [terminal(1), unit("P-001", ports=("N1", "N2")), terminal(2)]
    edges = chain("X1 P-001.N2", size=100, direction="unknown") + chain("P-001.N1 X2", size=50, direction="unknown")
    scenario = default_scenario(network(nodes, edges))
    assert scenario.pumps["P-001"].suction == ("N2",)
    assert [end.role for end in scenario.ends.values()] == ["source", "sink"]


def test_a_valve_that_may_be_a_check_valve_is_asked_for():
    """Between a pump and the valve before the header stands a valve of unknown kind."""
    nodes = [terminal(1), unit("P-001", ports=("N1", "N2")), unit("V-001", ports=("N1", "N2"))]
    nodes += [unit("V-002", "gate valve", ports=("N1", "N2")), junction(1), terminal(2), terminal(3)]
    graph = network(nodes, chain("X1 P-001.N1") + chain("P-001.N2 V-001 V-002 J1 X2") + chain("J1 X3"))
    scenario = default_scenario(graph)
    assert "is it one? then say duty: check" in scenario.valves["V-001"].why["duty"]
    assert any("is it one?" in why for _, why in assumptions(Process(graph, scenario)))


def test_unknown_lengths_and_bores_are_counted():
    graph = network([terminal(1), terminal(2)], chain("X1 X2", size=None, length=None))
    assert sum(n for (what, _), n in assumptions(Process(graph)).items() if what == "network") == 2


def test_a_second_run_gives_the_same_bytes(graph):
    assert scenario_text(default_scenario(graph)) == scenario_text(default_scenario(pumping()))


def test_a_system_of_valves_in_a_row_is_simulated_as_supposed():
    process = Process(line("ball valve", "butterfly valve", None))
    assert [valve.characteristic for valve in process.scenario.valves.values()] == [
        "ball",
        "equal percentage",
        "linear",
    ]


@pytest.mark.parametrize("roll", [0.0, 30.0])
@pytest.mark.parametrize("turn", [0.0, 45.0])
def test_a_lying_tank_has_one_surface_however_it_is_turned(turn, roll):
    way = np.radians(turn)
    along = np.array([np.cos(way), np.sin(way), 0.0])
    side = np.array([-np.sin(way), np.cos(way), 0.0])
    tilt = np.radians(roll)
    across = [np.cos(tilt) * side + np.sin(tilt) * np.eye(3)[2], np.cos(tilt) * np.eye(3)[2] - np.sin(tilt) * side]
    half = 1.5 * np.abs(along) + 0.5 * np.abs(side) + [0.0, 0.0, 0.5]
    shell = graphs.part(
        1,
        aabb=(tuple(-half), tuple(half)),
        obb=OrientedBox(center=(0.0, 0.0, 0.0), axes=(tuple(along), *map(tuple, across)), extents=(3.0, 1.0, 1.0)),
    )
    tank = unit("T-001").model_copy(update={"parts": ("part-1",)})
    graph = network([shell, tank, terminal(1)], chain("T-001 X1"))
    assert default_scenario(graph).tanks["T-001"].area == pytest.approx(np.pi / 4 * 3.0, abs=1e-3)
