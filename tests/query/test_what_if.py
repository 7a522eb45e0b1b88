import pytest

from cadgraph.errors import Unconnected
from cadgraph.model.graph import SceneGraph
from cadgraph.query import what_if
from cadgraph.query.what_if import WhatIf
from networks import chain, joint, junction, network, pumping, terminal, unit


def tags(those):
    return {one.name for one in those}


def series(*kinds, direction="forward", end="open"):
    """A tank, valves of these kinds with a gauge behind each, and an end."""
    nodes, names = [unit("T-001")], ["T-001"]
    for i, kind in enumerate(kinds, 1):
        nodes += [unit(f"V-{i:03d}", kind), unit(f"G-{i:03d}", "flow meter")]
        names += [f"V-{i:03d}", f"G-{i:03d}"]
    return network([*nodes, terminal(1, end)], chain(" ".join([*names, "X1"]), direction=direction))


def test_what_lies_behind_a_closed_valve_is_cut_off():
    found = what_if(series("gate valve", "ball valve"), "V-002")
    assert found.sources == ("T-001",)
    assert tags(found.cut_off) == {"G-002", "terminal-001"}
    assert found.known
    assert found.unknown == found.still_fed == found.dead_headed == ()


def test_a_blind_end_is_nothing_to_tell():
    assert tags(what_if(series("gate valve", end="blind"), "V-001").cut_off) == {"G-001"}


def test_closing_a_suction_valve_cuts_off_the_pump_which_only_passes_on():
    found = what_if(pumping(), "V-002")
    assert tags(found.cut_off) == {"G-001", "P-001", "G-003", "V-004", "V-005"}
    assert "P-001 would run dry" in found.remarks
    assert tags(found.run_dry) == {"P-001"}
    assert {"V-009", "G-005"} <= tags(found.still_fed)


def test_valves_that_only_together_cut_off():
    assert "V-009" not in tags(what_if(pumping(), "V-005").cut_off)
    assert "V-009" not in tags(what_if(pumping(), "V-007").cut_off)
    found = what_if(pumping(), ["V-005", "V-007"])
    assert {"V-008", "V-009", "G-005"} <= tags([*found.cut_off, *found.unknown])
    assert tags(found.dead_headed) == {"P-001", "P-002"}


def test_an_open_end_that_a_tank_may_run_back_to_is_unknown_and_not_cut_off():
    nodes = [unit("T-001"), unit("T-002"), unit("P-001"), junction(1), terminal(1)]
    nodes += [unit(tag, "gate valve") for tag in ("V-001", "V-002", "V-003")]
    edges = chain("T-001.N1 V-001 P-001.N1") + chain("P-001.N2 J1 V-002 T-002.N1") + chain("J1 V-003 X1")
    found = what_if(network(nodes, edges), "V-001")
    assert tags(found.cut_off) == tags(found.run_dry) == {"P-001"}
    assert {one.name: one.why for one in found.unknown} == dict.fromkeys(
        ("V-002", "V-003", "terminal-001"), "a tank that it fed may run back to it, and out at an open end"
    )
    both = what_if(network(nodes, edges), ["V-001", "V-002"])
    assert tags(both.cut_off) == {"P-001", "V-003", "terminal-001"}, "with V-002 shut nothing runs back"


def test_through_a_check_valve_no_tank_runs_back():
    nodes = [unit("T-001"), unit("T-002"), junction(1), terminal(1)]
    nodes += [unit("V-001", "gate valve"), unit("V-002", "check valve"), unit("V-003", "gate valve")]
    edges = chain("T-001.N1 V-001 J1 V-002 T-002.N1") + chain("J1 V-003 X1")
    assert tags(what_if(network(nodes, edges), "V-001").cut_off) == {"V-002", "V-003", "terminal-001"}


def test_what_pipes_of_unknown_direction_may_feed_is_unknown():
    edges = chain("T-001 V-001 J1 G-001 X1") + chain("J1 V-002 T-002", direction="unknown")
    nodes = [unit("T-001"), unit("T-002"), unit("V-001", "gate valve"), unit("V-002", "gate valve")]
    found = what_if(network([*nodes, junction(1), unit("G-001", "flow meter"), terminal(1)], edges), "V-001")
    assert found.cut_off == ()
    assert tags(found.unknown) == {"V-002", "G-001", "terminal-001"}
    assert "unknown direction" in found.unknown[0].why
    assert not found.known


def test_a_piece_that_nothing_is_known_to_feed_is_unknown_and_not_untouched():
    nodes = [unit("V-001", "gate valve"), unit("G-001", "flow meter"), terminal(1), terminal(2)]
    outwards = chain("V-001 X1") + chain("V-001 G-001 X2")
    found = what_if(network(nodes, outwards), "V-001")
    assert found.sources == found.cut_off == ()
    assert tags(found.unknown) == {"G-001", "terminal-001", "terminal-002"}
    assert any("name the sources" in text for text in found.assumptions)
    assert any("isn't known" in text for text in found.remarks)
    assert not found.known


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        (None, "of unknown kind: it may be a check valve"),
        ("check valve", "nobody shuts it by hand"),
        ("relief valve", "must not be blocked"),
        ("safety valve", "must not be blocked"),
        ("control valve", "moves by itself"),
    ],
)
def test_what_a_valve_cuts_off_that_may_not_shut_is_said_to_depend_on_it(kind, words):
    found = what_if(series(kind), "V-001")
    assert words in found.remarks[0]
    assert {one.name: one.why for one in found.cut_off} == dict.fromkeys(
        ("G-001", "terminal-001"), "only if V-001 really shuts"
    )
    assert not found.known


def test_behind_a_valve_that_surely_shuts_nothing_depends_on_another():
    found = what_if(series("gate valve", None), ["V-001", "V-002"])
    assert {one.name: bool(one.why) for one in found.cut_off} == {
        "G-001": False, "G-002": False, "terminal-001": False
    }  # fmt: skip


def test_nothing_counts_as_fed_through_a_relief_valve():
    edges = chain("T-001 V-001 J1 X1") + chain("T-001 V-002 J1")
    nodes = [unit("T-001"), unit("V-001", "gate valve"), unit("V-002", "relief valve"), junction(1), terminal(1)]
    found = what_if(network(nodes, edges), "V-001")
    assert tags(found.unknown) == {"terminal-001"}
    assert found.still_fed == ()


def test_a_tank_that_nothing_flows_to_any_more_is_told():
    nodes = [unit("T-001"), unit("T-002"), unit("V-001", "gate valve"), unit("P-001", ports=("N1", "N2"))]
    found = what_if(network(nodes, chain("T-001 P-001 V-001 T-002")), "V-001")
    assert found.cut_off == ()
    assert tags(found.not_refilled) == {"T-002"}
    assert tags(found.dead_headed) == {"P-001"}


def test_a_pump_that_is_shut_in_on_both_sides_runs_dry_and_pumps_against_shut_valves():
    nodes = [unit("T-001"), unit("T-002"), unit("P-001"), unit("V-001", "gate valve"), unit("V-002", "gate valve")]
    graph = network(nodes, chain("T-001 V-001 P-001.N1") + chain("P-001.N2 V-002 T-002"))
    both = what_if(graph, ["V-001", "V-002"])
    assert tags(both.run_dry) == tags(both.dead_headed) == {"P-001"}
    assert tags(what_if(graph, "V-001").dead_headed) == set()
    assert tags(what_if(graph, "V-002").dead_headed) == {"P-001"}


@pytest.mark.parametrize("relief", ["P-001.N2 J1 V-002 X2", "P-001.N2 J1 V-002.N1"])
def test_a_relief_valve_that_a_pump_against_shut_valves_opens_is_named(relief):
    nodes = [unit("T-001"), unit("T-002"), unit("V-001", "gate valve"), unit("V-002", "relief valve"), unit("P-001")]
    edges = [*chain("T-001 P-001.N1"), *chain("J1 V-001 T-002"), *chain(relief)]
    found = what_if(network([*nodes, junction(1), terminal(2)], edges), "V-001")
    (pump,) = found.dead_headed
    assert (pump.name, pump.why) == ("P-001", "until V-002 relieves it, if it is set to")


@pytest.mark.parametrize(("kind", "why"), [("gate valve", ""), (None, "only if V-001 really shuts")])
def test_what_pumps_and_tanks_meet_depends_on_whether_the_valve_shuts(kind, why):
    nodes = [unit("T-001"), unit("T-002"), unit("V-001", kind), unit("P-001", ports=("N1", "N2"))]
    found = what_if(network(nodes, chain("T-001 P-001 V-001 T-002")), "V-001")
    assert [one.why for one in (*found.dead_headed, *found.not_refilled)] == [why, why]
    assert found.known is (not why)


def test_no_tank_is_filled_through_a_valve_before_a_blind_end():
    nodes = [unit("T-001"), unit("V-001", "gate valve"), terminal(1, "blind"), terminal(2), terminal(3)]
    ways = [*chain("T-001 V-001 X1", direction="unknown"), *chain("X2 T-001"), *chain("T-001 X3")]
    found = what_if(network(nodes, ways), "V-001")
    assert found.unknown == found.not_refilled == ()


def test_past_a_relief_valve_on_the_side_of_a_run_what_lies_behind_is_fed_all_the_same():
    nodes = [unit("T-001"), unit("T-002"), junction(1), junction(2), terminal(1)]
    nodes += [unit(tag, "gate valve") for tag in ("V-001", "V-002")] + [unit("V-003", "relief valve", ports=("N1",))]
    ways = chain("T-001 V-001 J1") + chain("T-002 V-002 J1") + chain("J1 V-003.N1 J2 X1")
    found = what_if(network(nodes, ways), "V-001")
    assert found.unknown == ()
    assert tags(found.still_fed) == {"V-003", "terminal-001"}


def two_pumps_in_a_loop():
    """X1 feeds the suction header J1 at P-001, to which J2, at P-002, leads; both pumps feed J3, which comes back."""
    nodes = [terminal(1), *(junction(k) for k in (1, 2, 3, 4)), terminal(2, "blind")]
    nodes += [unit(tag, ports=("N1", "N2")) for tag in ("P-001", "P-002")]
    nodes += [unit(tag, "gate valve") for tag in ("V-001", "V-002", "V-003", "V-004")]
    ways = chain("X1 J1 V-001 P-001.N1") + chain("P-001.N2 J3") + chain("J2 J1") + chain("J2 V-002 P-002.N1")
    return network(nodes, [*ways, *chain("P-002.N2 J3 V-003 J4 J2"), *chain("J4 V-004 X2")])


def test_a_pump_that_a_header_may_feed_the_other_way_is_not_said_to_run_dry():
    found = what_if(two_pumps_in_a_loop(), "V-001")
    assert tags(found.cut_off) == {"P-001"}
    assert {"P-002", "V-002", "V-003"} <= tags(found.unknown)
    assert not any("P-002" in remark for remark in found.remarks)
    assert any("may turn" in one.why for one in found.unknown)


def test_both_pumps_before_a_shut_valve_are_told_alike():
    found = what_if(two_pumps_in_a_loop(), "V-003")
    assert not any("run dry" in remark for remark in found.remarks)
    assert tags(found.cut_off).isdisjoint({"P-001", "P-002"})


def test_what_only_a_blind_pocket_would_fill_stays_cut_off():
    nodes = [unit("T-001"), unit("T-002"), junction(1), junction(2), unit("P-001", ports=("N1", "N2"))]
    nodes += [unit("P-002", ports=("N1", "N2")), unit("V-002", "check valve")]
    nodes += [unit(tag, "gate valve") for tag in ("V-001", "V-003")]
    ways = chain("T-001 J1 V-001 P-001.N1") + chain("P-001.N2 V-002 V-003 J2 T-002")
    found = what_if(network(nodes, [*ways, *chain("J1 P-002.N1"), *chain("P-002.N2 J2")]), "V-001")
    assert tags(found.cut_off) == {"P-001", "V-002", "V-003"}
    assert found.unknown == ()


def test_a_valve_on_the_side_of_a_run_does_not_close_the_run():
    nodes = [
        unit("T-001"),
        unit("V-001", "ball valve", ports=("N1", "N2")),
        unit("P-001", ports=("N1", "N2")),
        terminal(1),
    ]
    found = what_if(network(nodes, chain("T-001 V-001.N1 P-001 X1")), "V-001")
    assert found.cut_off == ()
    assert found.unknown == ()
    assert any("stands on the side of a run" in remark for remark in found.remarks)


def test_a_tank_that_something_unknown_may_fill_is_unknown():
    nodes = [unit("T-001"), unit("T-002"), unit("V-001", "gate valve"), terminal(1)]
    edges = chain("T-001 V-001 T-002") + chain("X1 T-002", direction="unknown")
    found = what_if(network(nodes, edges), "V-001")
    assert found.not_refilled == ()
    assert tags(found.unknown) == {"T-002"}
    assert not found.known


def test_without_tanks_and_ends_pumps_feed():
    nodes = [unit("P-001"), unit("V-001", "gate valve"), unit("G-001", "flow meter"), terminal(1, "blind")]
    found = what_if(network(nodes, chain("P-001 V-001 G-001 X1")), "V-001")
    assert (found.sources, tags(found.cut_off)) == (("P-001",), {"G-001"})
    assert any("pumps count as sources" in text for text in found.assumptions)


def test_an_end_that_is_an_outlet_feeds_nothing_and_one_of_unknown_direction_may():
    nodes = [unit("V-001", "gate valve"), unit("G-001", "flow meter"), terminal(1), terminal(2)]
    inwards = network(nodes, chain("X1 V-001 G-001 X2"))
    assert what_if(inwards, "V-001").sources == ("terminal-001",)
    assert tags(what_if(inwards, "V-001").cut_off) == {"G-001", "terminal-002"}
    open_ones = what_if(network(nodes, chain("X1 V-001 G-001 X2", direction="unknown")), "V-001")
    assert open_ones.sources == ("terminal-001", "terminal-002")
    assert "whether they feed" in open_ones.unknown[0].why


def test_given_sources_are_the_only_ones():
    found = what_if(pumping(), "V-009", "P-001")
    assert found.sources == ("P-001",)
    assert {"G-005", "V-010", "V-011", "V-012"} <= tags(found.cut_off)
    assert "only the sources that were given feed" in found.assumptions


def test_an_instrument_on_a_tap_goes_with_its_line():
    nodes = [unit("T-001"), unit("V-001", "gate valve"), junction(1), unit("V-002", "gate valve"), unit("G-001")]
    graph = network([*nodes, terminal(1)], chain("T-001 V-001 J1 X1") + chain("J1 V-002 G-001"))
    assert {"G-001", "V-002"} <= tags(what_if(graph, "V-001").cut_off)
    assert tags(what_if(pumping(), "V-014").cut_off) == {"G-007"}


def test_a_joint_that_may_be_there_makes_it_doubtful():
    nodes = [
        unit("T-001"), unit("V-001", "gate valve"),
        unit("G-001", "flow meter").model_copy(update={"parts": ("part-1",)}),
        terminal(1), unit("P-001").model_copy(update={"parts": ("part-2",)}),
    ]  # fmt: skip
    graph = network(nodes, chain("T-001 V-001 G-001 X1"))
    doubtful = graph.document.model_copy(update={"joints": (joint("part-1", "part-2", score=0.4, made=False),)})
    found = what_if(SceneGraph(doubtful), "V-001")
    assert "is not joined to it (40% sure that it is)" in found.doubts[0].text
    assert not found.known


def test_a_valve_with_a_line_on_one_side_makes_it_doubtful():
    found = what_if(network([unit("T-001"), unit("V-001", "gate valve")], chain("T-001 V-001")), "V-001")
    assert found.cut_off == ()
    assert "only one of its two ports has a line" in found.doubts[0].text
    assert not found.known


def test_what_can_feed_nothing_is_no_source():
    nodes = [unit("T-001"), unit("V-001", "gate valve"), unit("G-001", "pressure gauge"), terminal(1, kind="blind")]
    graph = network(nodes, chain("T-001 V-001 G-001 X1"))
    for name, what in (("X1", "a blind end"), ("G-001", "a gauge")):
        with pytest.raises(ValueError, match=f"is {what}, which feeds nothing"):
            what_if(graph, "V-001", ["terminal-001" if name == "X1" else name])


def test_wrong_questions_are_refused():
    graph = network([unit("T-001"), unit("V-001", "gate valve"), unit("V-002"), terminal(1)], chain("T-001 V-001 X1"))
    with pytest.raises(ValueError, match="T-001 is no valve but a tank"):
        what_if(graph, "T-001")
    with pytest.raises(ValueError, match="at least one valve"):
        what_if(graph, [])
    with pytest.raises(ValueError, match="V-001 is closed and can't be a source"):
        what_if(graph, "V-001", ["V-001"])
    with pytest.raises(Unconnected, match="what closing it cuts off"):
        what_if(graph, "V-002")
    with pytest.raises(Unconnected, match="what it feeds"):
        what_if(graph, "V-001", "V-002")
    assert isinstance(what_if(graph, ["V-001", "V-001"]), WhatIf)


def test_what_blocks_a_relief_valve_is_said():
    found = what_if(series("gate valve", "relief valve"), "V-001")
    assert "V-001 blocks the relief valve V-002, which then protects nothing" in found.remarks
    nodes = [unit("T-001"), unit("V-001", "gate valve"), unit("V-002", "relief valve"), junction(1)]
    passed = network([*nodes, terminal(1), terminal(2)], [*chain("T-001 V-001 J1 X1"), *chain("J1 V-002 X2")])
    assert not any("blocks" in text for text in what_if(passed, "V-001").remarks)


def test_a_loop_that_a_pump_drives_by_itself_is_not_said_to_be_cut_off():
    nodes = [terminal(1), unit("V-001", "gate valve"), junction(1), unit("P-001", ports=("N1", "N2"))]
    nodes += [unit("V-002", "gate valve"), unit("G-001", "pressure gauge"), junction(2), unit("V-003", "gate valve")]
    ways = chain("X1 V-001 J1 P-001.N1") + chain("P-001.N2 V-002 G-001 J2 J1") + chain("J2 V-003 X2")
    found = what_if(network([*nodes, terminal(2)], ways), "V-001")
    driven = {one.name for one in found.unknown if "round a loop" in one.why}
    assert driven == {"P-001", "V-002", "G-001"}
    assert found.dead_headed == ()
    shut = what_if(network([*nodes, terminal(2)], ways), "V-002")
    assert [one.name for one in shut.dead_headed] == ["P-001"]
    assert not any("run dry" in remark for remark in found.remarks)
