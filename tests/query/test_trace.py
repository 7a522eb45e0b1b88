import pytest

from cadgraph.errors import Unconnected
from cadgraph.query import find_way, trace
from cadgraph.query.text import trace_lines, trace_values, way_lines
from networks import chain, junction, network, pumping, terminal, unit


def told(found):
    return [(step.name, round(step.distance, 3)) for step in found.steps]


def series(direction="forward"):
    nodes = [unit("T-001"), unit("V-001"), unit("V-002"), terminal(1)]
    return network(nodes, chain("T-001 V-001 V-002 X1", length=1.5, direction=direction))


def test_a_valve_on_the_side_of_a_run_is_told_to_be_so():
    nodes = [unit("T-001"), unit("V-001", "relief valve"), unit("V-002", "gate valve"), terminal(1)]
    graph = network(nodes, [*chain("T-001 V-001.N1"), *chain("V-001.N1 V-002 X1")])
    found = find_way(graph, "T-001", "terminal-001")
    assert [step.name for step in found.steps if step.aside] == ["V-001"]
    assert any("relief valve, on the side" in line for line in way_lines(found, "T-001", "terminal-001"))


def test_downstream_goes_with_the_flow_in_order_of_distance():
    assert told(trace(series(), "V-001")) == [("V-001", 0), ("V-002", 1.5), ("terminal-001", 3.0)]


def test_upstream_goes_against_it():
    assert told(trace(series(), "V-001", "upstream")) == [("V-001", 0), ("T-001", 1.5)]


def test_a_backward_connection_flows_from_target_to_source():
    assert told(trace(series("backward"), "V-001")) == [("V-001", 0), ("T-001", 1.5)]


def test_unknown_direction_halts_and_says_so():
    found = trace(series("unknown"), "V-001")
    assert told(found) == [("V-001", 0)]
    assert [(halt.after, halt.towards) for halt in found.halts] == [("V-001", "T-001"), ("V-001", "V-002")]
    assert "not followed" in " ".join(trace_lines(found))
    assert not found.steps[0].ends


def test_unknown_direction_is_followed_both_ways_when_asked():
    found = trace(series("unknown"), "V-001", through_unknown=True)
    assert told(found) == [("V-001", 0), ("T-001", 1.5), ("V-002", 1.5), ("terminal-001", 3.0)]
    assert found.halts == found.returns == ()


def test_a_trace_passes_by_a_blind_end_without_a_word():
    nodes = [unit("P-001"), junction(1), terminal(1), terminal(2, "blind")]
    graph = network(nodes, chain("P-001 J1 X1") + chain("J1 X2", direction="unknown"))
    found = trace(graph, "P-001")
    assert told(found) == [("P-001", 0), ("junction-001", 1.0), ("terminal-001", 2.0)]
    assert found.halts == ()


def test_a_loop_ends_and_is_told():
    nodes = [unit("P-001"), unit("V-001"), unit("V-002")]
    found = trace(network(nodes, chain("P-001 V-001 V-002 P-001")), "P-001")
    assert told(found) == [("P-001", 0), ("V-001", 1.0), ("V-002", 2.0)]
    assert [(r.after, r.to, r.loop) for r in found.returns] == [("V-002", "P-001", True)]


def test_a_loop_of_unknown_direction_ends_too():
    nodes = [unit("P-001"), unit("V-001"), unit("V-002")]
    graph = network(nodes, chain("P-001 V-001 V-002 P-001", direction="unknown"))
    found = trace(graph, "P-001", through_unknown=True)
    assert told(found) == [("P-001", 0), ("V-001", 1.0), ("V-002", 1.0)]
    assert len(found.returns) == 1


def test_branches_that_meet_again_are_no_loop():
    nodes = [unit("P-001"), junction(1), junction(2), unit("V-001"), unit("V-002"), terminal(1)]
    edges = chain("P-001 J1 V-001 J2 X1") + chain("J1 V-002 J2", length=2.0)
    found = trace(network(nodes, edges), "P-001")
    assert [(r.after, r.to, r.loop) for r in found.returns] == [("V-002", "junction-002", False)]


def test_the_shorter_of_parallel_connections_counts():
    nodes = [unit("P-001"), unit("T-001")]
    found = trace(network(nodes, chain("P-001 T-001", length=3.0) + chain("P-001 T-001", length=1.0)), "P-001")
    assert told(found) == [("P-001", 0), ("T-001", 1.0)]
    assert [(r.after, r.to) for r in found.returns] == [("P-001", "T-001")]


def test_a_connection_to_itself_is_a_loop():
    found = trace(network([unit("P-001")], chain("P-001 P-001")), "P-001")
    assert [(r.after, r.to, r.loop) for r in found.returns] == [("P-001", "P-001", True)]


def test_instruments_on_taps_are_named_whatever_their_direction():
    nodes = [unit("P-001"), junction(1), unit("G-001"), terminal(1)]
    found = trace(network(nodes, chain("P-001 J1 X1") + chain("J1 G-001", 15, 0.1, "unknown")), "P-001")
    assert told(found) == [("P-001", 0), ("junction-001", 1.0), ("G-001", 1.1), ("terminal-001", 2.0)]
    assert [step.tap for step in found.steps] == [False, False, True, False]
    assert found.halts == ()


def test_a_trace_can_begin_at_an_instrument():
    nodes = [unit("P-001"), junction(1), unit("G-001"), terminal(1)]
    found = trace(network(nodes, chain("P-001 J1 X1") + chain("J1 G-001", 15, 0.5, "unknown")), "G-001")
    assert told(found) == [("G-001", 0), ("junction-001", 0.5), ("terminal-001", 1.5)]


def test_an_unknown_length_makes_the_distance_a_lower_bound():
    nodes = [unit("P-001"), unit("V-001"), terminal(1)]
    found = trace(network(nodes, chain("P-001 V-001", length=None) + chain("V-001 X1")), "P-001")
    assert [(step.distance, step.at_least) for step in found.steps] == [(0, False), (0, True), (1.0, True)]
    assert ">= 1.00 m" in "\n".join(trace_lines(found))


def test_nothing_downstream_is_said():
    assert "nothing: no known flow leaves" in " ".join(trace_lines(trace(series("unknown"), "V-001")))


def test_the_way_to_another_unit_is_the_shortest_in_order():
    found = find_way(pumping(), "V-003", "G-007")
    assert [step.name for step in found.steps][:4] == ["V-003", "G-002", "P-002", "G-004"]
    assert found.steps[-1].distance == pytest.approx(7.118, abs=1e-3)
    assert found.steps[1].flow == "along"


def test_the_way_against_the_flow_is_told_as_such():
    assert [step.flow for step in find_way(series(), "V-002", "T-001").steps] == ["unknown", "against", "against"]


def test_a_way_only_downstream_may_not_exist():
    found = find_way(series(), "V-002", "T-001", "downstream")
    assert found.steps == ()
    assert way_lines(found, "V-002", "T-001") == ["no way downstream along the pipes from V-002 to T-001 was found"]


def test_a_unit_without_a_line_gets_no_answer():
    graph = network([*(unit(tag) for tag in ("P-001", "T-001", "V-001"))], chain("T-001 V-001"))
    with pytest.raises(Unconnected, match="no line was found at P-001; can't say what lies upstream of it"):
        trace(graph, "P-001", "upstream")
    for way in (("P-001", "T-001"), ("T-001", "P-001")):
        with pytest.raises(Unconnected, match=r"no line was found at P-001; can't say how .* are connected"):
            find_way(graph, *way)


def test_a_pump_with_one_line_may_have_more_downstream():
    graph = network([unit("T-001"), unit("V-001"), unit("P-001")], chain("T-001 V-001 P-001"))
    found = trace(graph, "T-001")
    assert [(doubt.place, doubt.text) for doubt in found.doubts] == [
        ("unit-P-001", "only one of its two nozzles has a line: where the other leads can't be told")
    ]
    assert "this may not be all:" in trace_lines(found)
    assert trace_values(found)["doubts"][0]["at"] == "P-001"


def test_a_flow_meter_on_a_tap_of_its_run_has_enough_lines_and_one_at_the_end_of_a_line_too_few():
    nodes = [unit("T-001"), unit("G-001", "flow meter", ports=("N1",)), unit("T-002")]
    through = trace(network(nodes, chain("T-001 G-001.N1 T-002")), "T-001")
    assert through.doubts == ()
    doubted = trace(network(nodes, chain("T-001 G-001.N1")), "T-001").doubts
    assert [doubt.name for doubt in doubted] == ["T-001", "G-001"], "the tank has no line but to an instrument"


def test_where_no_way_is_found_what_may_be_missing_on_both_sides_is_told():
    nodes = [*(unit(tag) for tag in ("T-001", "P-001", "V-001", "V-002", "T-002"))]
    graph = network(nodes, chain("T-001 V-001 P-001") + chain("V-002 T-002"))
    found = find_way(graph, "T-001", "T-002")
    assert [doubt.name for doubt in found.doubts] == ["P-001", "V-002"]
    assert way_lines(found, "T-001", "T-002")[1] == "there may be one all the same:"


def test_a_direction_that_is_none_is_refused():
    with pytest.raises(ValueError, match="give 'downstream', 'upstream'"):
        trace(series(), "V-001", "sideways")


def test_the_way_to_itself_has_one_step():
    assert told(find_way(series(), "V-001", "V-001")) == [("V-001", 0)]


@pytest.mark.parametrize("typed", ["V-003", "unit-V-003", "v-3", "V003", "v3"])
def test_tags_are_found_as_people_type_them(typed):
    assert trace(pumping(), typed).start == "unit-V-003"


def test_an_unknown_tag_is_refused_with_near_ones():
    with pytest.raises(ValueError, match=r"nothing in the graph is called 'V-0044'; did you mean V-004"):
        trace(pumping(), "V-0044")
    with pytest.raises(ValueError, match="'cadgraph lines' prints"):
        trace(pumping(), "&&&")


def test_a_way_with_the_flow_that_nobody_knows_is_no_flat_no():
    found = find_way(series("unknown"), "T-001", "V-002", "downstream")
    assert (found.steps, [(h.after, h.towards, h.distance) for h in found.halts]) == (
        (), [("T-001", "V-001", 0.0), ("V-001", "V-002", 1.5)],
    )  # fmt: skip
    no, _, but, *rows = way_lines(found, "T-001", "V-002")
    assert no == "no way downstream along the pipes from T-001 to V-002 that is known to flow so was found"
    assert but == "there is one if it flows so here, where the direction is unknown:"
    assert ["T-001 - V-001" in rows[0], "V-001 - V-002" in rows[1], len(rows)] == [True, True, 2]
    assert len(trace_values(found)["halts"]) == 2
    assert find_way(series(), "V-002", "T-001", "downstream").halts == ()
