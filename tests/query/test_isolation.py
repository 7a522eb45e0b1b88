import pytest

import graphs
import shapes
from cadgraph.errors import Unconnected
from cadgraph.model.records import Adjacent, Port
from cadgraph.query import Network, find_isolation
from cadgraph.query.text import gap_lines, isolation_lines
from networks import chain, joint, junction, mounted, network, pumping, terminal, unit
from piping import GAUGE, STEEL, TANK, Plant, gauge_mesh
from playing import LEVER


def closed(found):
    return sorted(valve.name for valve in found.valves)


GATE = "gate valve"


def pump(*edges, kinds=(), more=()):
    """P-001 with chains around it; kinds by tag, valves shut off by default."""
    named = dict(kinds)
    names = {name.split(".")[0] for text in edges for name in text.split()}
    nodes = []
    for name in sorted(names):
        if name[0] == "J":
            nodes.append(junction(int(name[1:])))
        elif name[0] == "X":
            nodes.append(terminal(int(name[1:]), named.get(name, "open")))
        else:
            nodes.append(unit(name, named.get(name, GATE if name[0] == "V" else None)))
    return network([*nodes, *more], [edge for text in edges for edge in chain(text)])


def test_the_nearest_valve_on_every_port_is_closed():
    graph = pump("T-001 V-001 V-002 P-001.N1", "P-001.N2 V-003 V-004 T-002")
    found = find_isolation(graph, "P-001")
    assert [(v.name, v.port, v.distance) for v in found.valves] == [("V-002", "N1", 1.0), ("V-003", "N2", 1.0)]
    assert found.openings == found.shut_off == ()


def test_behind_a_junction_every_branch_is_closed():
    found = find_isolation(pump("X1 V-001 J1 P-001", "J1 V-002 X2"), "P-001")
    assert closed(found) == ["V-001", "V-002"]


def test_units_in_the_section_are_shut_off_too():
    found = find_isolation(pump("T-001 V-001 E-001 G-001 P-001 V-002 X1"), "P-001")
    assert closed(found) == ["V-001", "V-002"]
    assert found.shut_off_names == ("G-001", "E-001")


def test_a_tank_without_a_valve_cannot_be_isolated():
    found = find_isolation(pump("T-001 P-001.N1", "P-001.N2 V-001 X1"), "P-001")
    assert [(opening.name, opening.port) for opening in found.openings] == [("T-001", "N1")]
    assert closed(found) == ["V-001"]
    assert isolation_lines(found)[0] == "P-001 can't be isolated wholly:"
    assert any(
        line.startswith("in one section with it, not shut off while ways stay open: ")
        for line in isolation_lines(found)
    )


@pytest.mark.parametrize(("kind", "openings"), [("open", 1), ("unknown", 1), ("blind", 0)])
def test_an_end_without_a_valve_is_an_opening_unless_it_is_blind(kind, openings):
    found = find_isolation(pump("X1 P-001 V-001 T-001", kinds={"X1": kind}.items()), "P-001")
    assert len(found.openings) == openings


def test_a_valve_before_a_blind_end_or_an_instrument_need_not_be_closed():
    graph = pump(
        "T-001 V-001 J1 P-001", "J1 V-002 X1", "P-001 J2 V-003 G-001", "J2 V-004 T-002", kinds=[("X1", "blind")]
    )
    found = find_isolation(graph, "P-001")
    assert closed(found) == ["V-001", "V-004"]
    assert found.remarks[0] == "V-002 need not be closed: nothing was found behind it that could flow"
    assert found.shut_off_names == ("V-002", "V-003", "G-001"), "these stay open, and hang together with the pump"
    assert len(found.connections) == 8, "all but the pipes behind the valves that are closed"


def test_a_valve_before_a_tank_is_closed_although_another_way_leads_there_too():
    graph = pump("T-001 J1 P-001 V-001 T-001", "P-001 V-002 T-002")
    found = find_isolation(graph, "P-001")
    assert [opening.name for opening in found.openings] == ["T-001"]
    assert closed(found) == ["V-001", "V-002"]
    assert not found.remarks


def test_a_valve_between_a_tank_and_itself_lets_nothing_else_in():
    found = find_isolation(pump("T-001 V-001 T-001", "T-001 V-002 T-002"), "T-001")
    assert closed(found) == ["V-002"]


def test_a_section_that_nothing_feeds_may_hold_something():
    found = find_isolation(pump("X1 V-001 G-001 X2", kinds=[("X1", "blind"), ("X2", "blind")]), "G-001")
    assert (found.isolated, found.valves, found.shut_off_names) == (True, (), ("V-001",))
    told = isolation_lines(found)
    assert told[0] == "no valve has to be closed to isolate G-001: nothing that could flow to it was found"
    assert told[-1].endswith("what it holds, and under what pressure, nobody knows")
    fed = find_isolation(pump("X1 V-001 G-001 X2", kinds=[("X2", "blind")]), "G-001")
    assert not any("nobody knows" in line for line in isolation_lines(fed))


def test_a_check_valve_does_not_isolate_by_default():
    graph = pump("T-001 V-001 P-001 V-002 V-003 T-002", kinds=[("V-002", "check valve")])
    found = find_isolation(graph, "P-001")
    assert closed(found) == ["V-001", "V-003"]
    assert "V-002 is a check valve" in found.remarks[0]


def test_a_check_valve_counts_when_asked_only_where_it_holds_back():
    graph = pump("T-001 V-001 P-001 V-002 V-003 T-002", kinds=[("V-002", "check valve")])
    found = find_isolation(graph, "P-001", check_valves=True)
    assert [(v.name, v.automatic) for v in found.valves] == [("V-001", False), ("V-002", True)]
    # Upstream of the pump it lets through to the pump.
    inlet = pump("T-001 V-001 V-002 P-001 V-003 T-002", kinds=[("V-002", "check valve")])
    assert closed(find_isolation(inlet, "P-001", check_valves=True)) == ["V-001", "V-003"]


def test_a_check_valve_of_unknown_direction_never_counts():
    nodes = [unit("P-001"), unit("V-001", "check valve"), unit("V-002", GATE), terminal(1)]
    found = find_isolation(
        network(nodes, chain("P-001 V-001 V-002 X1", direction="unknown")), "P-001", check_valves=True
    )
    assert closed(found) == ["V-002"]
    assert found.remarks[0] == "V-001 is a check valve, but which way it lets through is not known"


def test_control_valves_do_not_isolate_and_relief_valves_are_left():
    graph = pump(
        "P-001 V-001 V-002 T-001", "P-001 V-003 X1", kinds=[("V-001", "control valve"), ("V-003", "relief valve")]
    )
    found = find_isolation(graph, "P-001")
    assert closed(found) == ["V-002"]
    assert [remark.split(":")[0] for remark in found.remarks] == [
        "V-001 is a control valve",
        "V-003 is a relief valve",
    ]


def guessed(tag, *guesses):
    return unit(tag).model_copy(update={"kind_guesses": guesses})


def test_a_valve_of_unknown_kind_is_passed_and_named_apart():
    graph = pump("T-001 V-001 P-001 V-002 V-003 T-002", kinds=[("V-002", None)])
    for fewest in (False, True):
        found = find_isolation(graph, "P-001", fewest=fewest)
        assert closed(found) == ["V-001", "V-003"]
        assert [(v.name, v.distance) for v in found.passed] == [("V-002", 1.0)]
        assert found.isolated
    told = isolation_lines(found)
    assert "not relied on, as nobody knows whether they shut off:" in told
    assert any("likely a check valve" in line for line in told)


def test_what_only_valves_of_unknown_kind_keep_off_is_an_opening_that_names_them():
    graph = pump("T-001 V-001 P-001 V-002 X1", kinds=[("V-001", None), ("V-002", None)])
    found = find_isolation(graph, "P-001")
    assert found.valves == ()
    assert found.isolated is False
    assert [o.why for o in found.openings] == [
        "no valve between that is known to shut off (the nearest way there: V-001); empty it, or isolate it as well",
        "open end with no valve before it that is known to shut off (the nearest way there: V-002)",
    ]


def test_valves_of_unknown_kind_count_when_asked_but_are_doubts():
    graph = pump("T-001 V-001 P-001 V-002 V-003 T-002", kinds=[("V-002", None)])
    found = find_isolation(graph, "P-001", assume_shutoff=True)
    assert closed(found) == ["V-001", "V-002"]
    assert found.isolated is None
    assert [doubt.text for doubt in found.doubts] == [
        "kind not known; right behind P-001, with V-003 behind it: likely a check valve; taken for a shut-off valve as "
        "asked"
    ]


def test_only_the_first_of_two_valves_behind_a_pump_is_suspected_and_none_before_it():
    unknown = [("V-001", None), ("V-003", None), ("V-004", None)]
    graph = pump("T-001 V-002 V-001 P-001 G-001 V-003 V-004 T-002", kinds=unknown)
    found = find_isolation(graph, "P-001")
    assert {v.name for v in found.passed if "check valve" in v.why} == {"V-003"}
    assert len(found.passed) == 3


def test_the_valve_with_something_to_turn_is_no_check_valve_and_the_one_behind_it_is_suspected():
    nodes = [unit("T-001"), unit("V-001", GATE), unit("P-001"), unit("V-003"), unit("V-004"), unit("T-002")]
    nodes[3] = nodes[3].model_copy(update={"mechanism": LEVER})
    graph = network(nodes, chain("T-001 V-001 P-001 V-003 V-004 T-002"))
    assert {(v.name, v.why) for v in find_isolation(graph, "P-001").passed} == {
        ("V-003", "kind not known"),
        (
            "V-004",
            "kind not known; nothing to turn was found at it, as it was at V-003 between it and P-001: likely a check "
            "valve",
        ),
    }


@pytest.mark.parametrize(
    ("guesses", "counts"),
    [
        ([("gate valve", 0.55), ("globe valve", 0.42)], True),
        ([("gate valve", 0.55), ("globe valve", 0.29)], False),
        ([("ball valve", 0.8), ("relief valve", 0.12)], False),
        ([], False),
    ],
)
def test_a_valve_whose_kind_is_open_counts_where_all_that_it_may_be_shuts_off(guesses, counts):
    nodes = [unit("T-001"), guessed("V-001", *guesses), unit("P-001"), unit("V-002", GATE), terminal(1)]
    found = find_isolation(network(nodes, chain("T-001 V-001 P-001 V-002 X1")), "P-001")
    assert ("V-001" in closed(found)) is counts
    assert [v.name for v in found.passed] == ([] if counts else ["V-001"])
    if counts:
        assert found.valves[0].likely == "gate valve 55%, globe valve 42%"
        assert "V-001: kind only likely; all that it may be shuts off" in found.remarks
        assert any("valve (gate valve 55%, globe valve 42%)" in line for line in isolation_lines(found))


@pytest.mark.parametrize(
    ("kind", "counts"),
    [
        ("ball valve", True),
        ("Stopcock", True),
        ("ball check valve", False),
        ("globe control valve", False),
        ("pressure reducing valve", False),
        ("safety cutoff valve", False),
        ("foot valve", False),
        ("bleed valve", False),
        ("non-return valve", False),
        ("safety valve", False),
        ("three-way ball valve", False),
        ("3 way plug valve", False),
        ("diverter ball valve", False),
        ("shut_off valve", True),
        ("non-rising stem gate valve", True),
        ("Gate valve/OS&Y", True),
        ("2-piece ball valve DN 50 PN 16", True),
        ("3/2 way ball valve", False),
        ("Y-port ball valve", False),
        ("pressure regulator globe valve", False),
        ("thermostatic globe valve", False),
        ("ballcock", False),
        ("one-way ball valve", False),
        ("non-shut-off valve", False),
        ("tilting disc non\u2011return ball valve", False),
    ],
)
def test_only_kinds_that_are_known_to_shut_off_count(kind, counts):
    graph = pump("T-001 V-001 P-001 V-002 T-002", kinds=[("V-001", kind)])
    for assume in (False, True):
        assert ("V-001" in closed(find_isolation(graph, "P-001", assume_shutoff=assume))) is counts


def beside(kind, port=".N1"):
    """T-001 - V-001 - J1 - V-009 - P-001 - V-002 - T-002, V-009 on the side of the run, by one port."""
    nodes = [unit("T-001"), unit("V-001", GATE), unit("V-009", kind), unit("P-001"), unit("V-002", GATE), unit("T-002")]
    return network([*nodes, junction(1)], chain(f"T-001 V-001 J1 V-009{port} P-001 V-002 T-002"))


@pytest.mark.parametrize("fewest", [False, True])
def test_a_valve_on_the_side_of_a_run_does_not_close_the_run(fewest):
    found = find_isolation(beside(GATE), "P-001", fewest=fewest)
    assert closed(found) == ["V-001", "V-002", "V-009"]  # V-009: nobody knows what it leads to
    assert "V-009 has a line on one side only: what lies behind it is not known" in found.remarks
    assert found.isolated
    assert found.shut_off == ()
    found = find_isolation(beside("relief valve"), "P-001", fewest=fewest)
    assert closed(found) == ["V-001", "V-002"]
    assert found.remarks == ("V-009 is a relief valve: taken for closed, not to be blocked",)
    assert closed(find_isolation(beside("check valve"), "P-001", fewest=fewest, check_valves=True)) == [
        "V-001",
        "V-002",
    ]


def test_a_relief_valve_in_the_line_ends_the_section():
    assert closed(find_isolation(beside("relief valve", port=""), "P-001")) == ["V-002"]


@pytest.mark.parametrize(
    ("flows", "doubt"),
    [
        (("forward", "forward"), None),
        (("unknown", "forward"), None),
        (("backward", "backward"), "lets into this section"),
        (("unknown", "backward"), "lets into this section"),
        (("unknown", "unknown"), "nobody knows which way"),
    ],
)
def test_a_relief_valve_that_may_let_into_the_section_is_a_doubt(flows, doubt):
    nodes = [unit("P-001"), unit("V-001", GATE), unit("V-002", "relief valve"), unit("T-001"), unit("T-002")]
    beyond = [*chain("P-001 V-002", direction=flows[0]), *chain("V-002 T-002", direction=flows[1])]
    found = find_isolation(network(nodes, [*chain("T-001 V-001 P-001"), *beyond]), "P-001")
    assert closed(found) == ["V-001"]
    assert [one.name for one in found.doubts] == (["V-002"] if doubt else [])
    assert found.isolated is (None if doubt else True)
    assert not doubt or doubt in found.doubts[0].text


@pytest.mark.parametrize("kind", ["ball valve", "gate valve"])
def test_a_valve_that_more_than_two_lines_end_at_is_not_relied_on(kind):
    nodes = [unit("T-001"), unit("T-002"), unit("P-001"), unit("V-001", kind), unit("V-002", GATE), terminal(1)]
    edges = [*chain("T-001.N1 V-001.N1"), *chain("V-001.N2 P-001.N1"), *chain("V-001.N3 T-002.N1")]
    found = find_isolation(network(nodes, [*edges, *chain("P-001.N2 V-002 X1")]), "P-001")
    assert found.isolated is False
    assert [(one.name, "more than two lines" in one.why) for one in found.passed] == [("V-001", True)]


def test_the_fewest_valves_keep_pumps_and_equipment_off_too():
    graph = pump("E-001.N2 V-001 P-001.N1", "P-001.N2 V-002 E-002.N1", "E-002.N2 V-003 V-004 E-001.N1")
    assert closed(find_isolation(graph, "E-002", fewest=True)) == ["V-002", "V-003"]


def test_a_pump_that_is_shut_in_with_a_unit_is_told():
    graph = pump("T-001 V-001 P-001 E-001 V-002 T-002")
    assert "P-001 shut in with it: stop what runs before a valve is closed" in find_isolation(graph, "E-001").remarks
    assert not any("shut in with it" in text for text in find_isolation(graph, "P-001").remarks)


def test_a_check_valve_whose_two_sides_contradict_each_other_holds_nothing_back():
    nodes = [unit("T-001"), unit("V-001", "check valve"), unit("P-001"), unit("V-002", GATE), unit("T-002")]
    edges = [*chain("T-001 V-001"), *chain("P-001 V-001"), *chain("P-001 V-002 T-002")]
    for target, others in (("T-001", ["V-002"]), ("P-001", ["V-002"])):
        found = find_isolation(network(nodes, edges), target, check_valves=True)
        assert closed(found) == others
        assert "V-001 is a check valve, but which way it lets through is not known" in found.remarks


def test_a_relief_valve_with_nothing_behind_it_that_could_flow_is_no_doubt():
    graph = pump("T-001 V-001 P-001 V-002 X1", kinds=[("V-002", "relief valve"), ("X1", "blind")])
    assert find_isolation(graph, "P-001").isolated


def test_a_bypass_within_the_section_need_not_be_closed():
    graph = pump("T-001 V-001 J1 P-001 J2 V-002 T-002", "J1 V-003 J2")
    assert closed(find_isolation(graph, "P-001")) == ["V-001", "V-002"]


def test_fewest_takes_one_valve_where_the_nearest_are_many():
    graph = pump("T-001 V-009 J1 V-001 J2 P-001", "J1 V-002 J2", "J1 V-003 J2")
    assert closed(find_isolation(graph, "P-001")) == ["V-001", "V-002", "V-003"]
    found = find_isolation(graph, "P-001", fewest=True)
    assert closed(found) == ["V-009"]
    assert sorted(found.shut_off_names) == ["V-001", "V-002", "V-003"]


def test_fewest_takes_the_nearest_of_equally_small_sets():
    graph = pump("T-001 V-001 V-002 V-003 P-001")
    assert closed(find_isolation(graph, "P-001", fewest=True)) == ["V-003"]


def test_fewest_works_beside_a_tank_that_has_no_valve():
    graph = pump("T-002 T-001 P-001 V-001 X1")
    found = find_isolation(graph, "P-001", fewest=True)
    assert closed(found) == ["V-001"]
    assert [opening.name for opening in found.openings] == ["T-001"]


def test_a_dead_end_needs_nothing():
    found = find_isolation(pump("X1 P-001 X2", kinds=[("X1", "blind"), ("X2", "blind")]), "P-001")
    assert found.valves == found.openings == ()
    assert isolation_lines(found)[0].startswith("no valve has to be closed")


def test_a_unit_without_a_line_gets_no_answer():
    with pytest.raises(Unconnected, match=r"no line was found at P-001; can't say what isolates it: .*explain"):
        find_isolation(network([unit("P-001")], []), "P-001")


def test_a_gauge_without_a_line_is_told_with_what_it_sits_on():
    plant = Plant()
    plant.add(shapes.box((0.5, 0.5, 1.0), (0, 0, 0)), TANK, "tank")
    plant.pipe((0.25, 0, 0), (1, 0, 0))
    plant.add(gauge_mesh((0, 0, 0.5)), GAUGE, "gauge")
    # It may lean on more than the tank, which makes nothing sure.
    plant.add(shapes.box((0.02, 0.02, 0.1), (0, 0.03, 0.55)), STEEL, "bracket")
    with pytest.raises(Unconnected, match=r"at G-001, which is mounted at T-001; .*: ask about T-001; ") as refused:
        find_isolation(plant.graph(), "G-001")
    assert refused.value.mounted_at == ("T-001",)


@pytest.mark.parametrize(("count", "size", "at"), [
    (0, 0.1, ("unit-T-001",)),
    (3, 0.1, ("unit-T-001",)),
    (4, 0.1, ()),
    # What is larger than the gauge may bear the whole plant.
    (1, 3.0, ()),
])  # fmt: skip
def test_a_gauge_is_mounted_at_what_it_reaches_over_small_pieces_of_nothing_else(count, size, at):
    nodes, touch = mounted(count, size)
    plant = Network(network([*nodes, terminal(1)], [*touch, *chain("T-001.N1 X1")]))
    assert plant.mounted_at("unit-G-001") == at
    assert plant.mounted_at("unit-T-001") == ()
    assert plant.mounted_at("terminal-001") == ()


def test_a_valve_is_mounted_only_at_what_it_touches():
    nodes, touch = mounted(1)
    valve = nodes[0].model_copy(update={"unit_type": "valve", "kind": None})
    assert Network(network([valve, *nodes[1:]], touch)).mounted_at("unit-G-001") == ()


def test_a_gauge_between_two_units_may_be_mounted_at_either():
    nodes, touch = mounted(0)
    other = unit("T-002").model_copy(update={"parts": ("part-9",)})
    more = Adjacent(source="part-0", target="part-9", distance=0.0, point=(0.0, 0.0, 0.0))
    graph = network([*nodes, other, graphs.part(9), terminal(1)], [*touch, more, *chain("T-001.N1 X1")])
    with pytest.raises(Unconnected, match="mounted at T-001 or T-002; can't say what isolates it: 'cadgraph explain"):
        find_isolation(graph, "G-001")
    assert "no line was found at G-001 (at T-001 or T-002), T-002 (at G-001)" in gap_lines(Network(graph))[0]


def test_a_pump_with_one_line_gets_an_answer_that_says_it_may_be_incomplete():
    found = find_isolation(pump("T-001 V-001 P-001.N1"), "P-001")
    assert closed(found) == ["V-001"]
    assert found.isolated is None
    assert [doubt.name for doubt in found.doubts] == ["P-001"]
    assert isolation_lines(found)[:2] == [
        "these valves may not isolate P-001 wholly:",
        "  P-001: only one of its two nozzles has a line: what feeds the other can't be told",
    ]


def test_a_dead_end_at_one_nozzle_is_no_reason_to_close_nothing():
    told = isolation_lines(find_isolation(pump("X1 P-001", kinds=[("X1", "blind")]), "P-001"))
    assert told[0] == "nobody can tell what isolates P-001 wholly:"
    assert not any("has to be closed" in line for line in told)


def test_another_unit_of_the_section_with_too_few_lines_is_a_doubt():
    found = find_isolation(pump("T-001 V-001 P-001 V-002", kinds=[("V-002", "check valve")]), "P-001")
    assert [doubt.name for doubt in found.doubts] == ["V-002"]


def test_a_valve_of_which_one_side_is_known_is_closed():
    graph = pump("T-001 V-001 J1 P-001 V-003 T-002", "J1 V-002")
    for fewest in (False, True):
        found = find_isolation(graph, "P-001", fewest=fewest)
        assert closed(found) == ["V-001", "V-002", "V-003"]
        assert found.isolated
    assert "V-002 has a line on one side only: what lies behind it is not known" in found.remarks


def test_what_lies_behind_a_valve_is_fed_where_a_unit_there_has_too_few_lines():
    graph = pump("T-001 V-001 J1 P-001 V-003 T-002", "J1 V-002 V-004")
    assert closed(find_isolation(graph, "P-001")) == ["V-001", "V-002", "V-003"]


def with_nozzles(*ports, closed=False, touching=()):
    """A tank with a nozzle at x = 0 and one at x = 1, and lines by the ports at these places."""
    names = [("nozzle", 0.0), ("flange", 0.1), ("nozzle", 1.0), ("shell", 0.5)]
    names += [("blind flange", 1.1)] if closed else []
    parts = [graphs.part(k, label=graphs.label("Tank", name), size=0.1) for k, (name, _) in enumerate(names)]
    parts = [
        part.model_copy(update={"aabb": ((x, 0.0, 0.0), (x + 0.1, 0.1, 0.1))})
        for part, (_, x) in zip(parts, names, strict=True)
    ]
    tank = unit("T-001").model_copy(
        update={
            "parts": ("part-0", "part-2", "part-3"),
            "ports": tuple(Port(name=f"N{k}", point=(x, 0.05, 0.05), diameter=0.1) for k, x in enumerate(ports, 1)),
        }
    )
    pairs = [("part-0", "part-1"), ("part-0", "part-3"), ("part-2", "part-3")]
    pairs += [("part-2", "part-4")] if closed else []
    touch = [Adjacent(source=a, target=b, distance=0.0, point=(0.0, 0.0, 0.0)) for a, b in pairs]
    edges = [edge for k, _ in enumerate(ports, 1) for edge in chain(f"T-001.N{k} V-00{k} X{k}")]
    ends = [node for k, _ in enumerate(ports, 1) for node in (unit(f"V-00{k}", GATE), terminal(k))]
    return network([*parts, tank, *ends], [*touch, *edges])


def guarded(tag, kind, *labels):
    """A pump between valves, with a unit of these labels on a tap beside it."""
    parts = [graphs.part(k, f"/m{k}", label=one) for k, one in enumerate(labels)]
    nodes = [
        unit("V-001", GATE), unit("V-002", GATE), unit("P-001"), terminal(1), terminal(2), junction(1),
        unit(tag, kind).model_copy(update={"parts": tuple(part.id for part in parts)}), *parts,
    ]  # fmt: skip
    return network(nodes, [*chain("X1 V-001 P-001 J1 V-002 X2"), *chain(f"J1 {tag}")])


VALVE_BEFORE = {"group": "Valve assembly", "name": "valve"}


@pytest.mark.parametrize(
    ("source", "before", "doubted"),
    [
        ("network", VALVE_BEFORE, True),
        ("network", {"group": "Gauge assembly"}, False),
        ("network", None, True),
        ("geometry", None, False),
    ],
)
def test_a_gauge_that_by_its_shape_was_something_else_is_a_doubt(source, before, doubted):
    more = {} if before is None else {"before": before}
    said = graphs.label("Gauge assembly", None, source=source, **more)
    texts = [doubt.text for doubt in find_isolation(guarded("G-001", "pressure gauge", said), "P-001").doubts]
    assert [text.startswith("taken for a pressure gauge because one line ends at it") for text in texts] == (
        [True] if doubted else []
    )


@pytest.mark.parametrize(
    ("operator", "source", "doubted"),
    [("lever", "geometry", True), ("valve bonnet", "geometry", False), ("lever", "author", False)],
)
def test_a_relief_valve_with_a_lever_and_no_outlet_is_a_doubt(operator, source, doubted):
    parts = [graphs.label(name=name, source=source) for name in ("valve body", operator)]
    found = find_isolation(guarded("V-009", "relief valve", *parts), "P-001")
    assert closed(found) == ["V-001", "V-002"]
    assert [doubt.name for doubt in found.doubts] == (["V-009"] if doubted else [])


def test_a_nozzle_without_a_line_is_a_doubt():
    (doubt,) = find_isolation(with_nozzles(0.2), "T-001").doubts
    assert doubt.text == "its nozzle part-2 has no line: what feeds it there can't be told"
    assert find_isolation(with_nozzles(0.2), "T-001").isolated is None
    assert "note: a nozzle without a line has T-001" in [
        f"note: {line}" for line in gap_lines(Network(with_nozzles(0.2)))
    ]


@pytest.mark.parametrize(("ports", "closed"), [((0.2, 1.0), False), ((0.2,), True)])
def test_a_nozzle_with_a_line_or_a_blind_flange_is_none(ports, closed):
    assert find_isolation(with_nozzles(*ports, closed=closed), "T-001").doubts == ()


@pytest.mark.parametrize(("size", "isolated"), [(80, True), (100, None), (None, True)])
def test_a_gauge_at_the_end_of_a_line_too_wide_for_a_tap_is_a_doubt(size, isolated):
    nodes = [unit("E-001"), unit("V-001", GATE), unit("G-001", "pressure gauge"), junction(1), terminal(1)]
    graph = network(nodes, [*chain("E-001.N1 J1 V-001 X1"), *chain("J1 E-001.N2"), *chain("J1 G-001", size=size)])
    found = find_isolation(graph, "E-001")
    assert found.isolated is isolated
    assert [doubt.name for doubt in found.doubts] == ([] if isolated else ["G-001"])
    (gauge,) = [arc for arc in Network(graph).arcs("junction-001") if arc.end == "unit-G-001"]
    assert Network(graph).is_tap(gauge) is bool(isolated)


def test_an_opening_names_all_ports_that_lead_there():
    found = find_isolation(pump("X1 J1 P-001.N1", "J1 P-001.N2"), "P-001")
    assert [(opening.port, opening.other_ports) for opening in found.openings] == [("N1", ("N2",))]
    assert "by N1, N2" in isolation_lines(found)[1]


def test_a_valve_that_is_closed_as_asked_is_not_among_those_not_relied_on():
    graph = pump("X1 V-001 J1 P-001.N1", "J1 V-002.N1 X2", "V-002.N1 P-001.N2", kinds={"V-002": None}.items())
    found = find_isolation(graph, "P-001", assume_shutoff=True)
    assert closed(found) == ["V-001", "V-002"]
    assert found.passed == ()


def test_a_relief_valve_that_blows_into_the_open_is_no_doubt():
    graph = pump("T-001 V-001 J1 P-001 V-003 T-002", "J1 V-002", kinds=[("V-002", "relief valve")])
    assert find_isolation(graph, "P-001").doubts == ()


def jointed(*joints):
    """T-001 - V-001 - P-001 - V-002 - T-002, of parts t1, v1, p1, v2, t2 and a pipe; E-001 apart, of part e1."""
    names = {"T-001": "t1", "V-001": "v1", "P-001": "p1", "V-002": "v2", "T-002": "t2", "E-001": "e1"}
    nodes = [graphs.part(k, f"/{name}", id=name) for k, name in enumerate([*names.values(), "pipe", "far"])]
    nodes += [
        unit(tag, GATE if tag[0] == "V" else None).model_copy(update={"parts": (part,)}) for tag, part in names.items()
    ]
    edges = chain("T-001 V-001 P-001") + chain("P-001 V-002", via=("pipe",)) + chain("V-002 T-002")
    return network(nodes, edges, joints=[joint(*row) for row in joints])


def test_a_likely_joint_at_the_section_that_was_not_made_is_a_doubt():
    found = find_isolation(jointed(("pipe", "e1", 0.003, 0.4, False)), "P-001")
    assert [(d.name, d.parts, d.gap, d.score) for d in found.doubts] == [("P-001", ("pipe", "e1"), 0.003, 0.4)]
    assert found.doubts[0].text == (
        "pipe lies 3.0 mm from E-001 (e1) and is not joined to it (40% sure that it is): what feeds it there can't be "
        "told"
    )
    assert found.isolated is None


@pytest.mark.parametrize(
    "joint",
    [
        ("pipe", "e1", 0.003, 0.09, False),  # unlikely
        ("pipe", "v2", 0.0, 0.9, True),  # made
        ("t2", "e1", 0.003, 0.4, False),  # behind the valves
        ("pipe", "p1", 0.0, 0.4, False),  # within the section
    ],
)
def test_other_joints_are_no_doubts(joint):
    assert find_isolation(jointed(joint), "P-001").isolated


def test_the_likeliest_joint_comes_first():
    graph = jointed(("pipe", "e1", 0.003, 0.2, False), ("far", "p1", 0.009, 0.3, False))
    assert [doubt.score for doubt in find_isolation(graph, "P-001").doubts] == [0.3, 0.2]


def test_a_valve_itself_can_be_isolated():
    assert closed(find_isolation(pump("T-001 V-001 V-002 V-003 X1"), "V-002")) == ["V-001", "V-003"]


def test_two_connections_between_the_same_nodes_are_both_closed():
    nodes = [unit("P-001"), unit("V-001", GATE), unit("V-002", GATE), unit("T-001")]
    edges = chain("P-001.N1 V-001 T-001.N1") + chain("P-001.N2 V-002 T-001.N2") + chain("P-001.N1 V-001")
    assert closed(find_isolation(network(nodes, edges), "P-001")) == ["V-001", "V-002"]


def test_a_pumping_station_by_hand():
    found = find_isolation(pumping(), "P-001")
    assert closed(found) == ["V-002", "V-005"]
    assert sorted(found.shut_off_names) == ["G-001", "G-003", "V-004"]
    assert closed(find_isolation(pumping(), "P-001", check_valves=True)) == ["V-002", "V-004"]
    assert closed(find_isolation(pumping(), "T-001")) == ["V-001", "V-008", "V-016"]


def test_closing_what_a_relief_valve_blows_through_is_said():
    graph = pump("P-001 V-001 V-002 T-001", "P-001 V-003 G-001 V-004 T-002", kinds=[("V-003", "relief valve")])
    found = find_isolation(graph, "T-002")
    assert closed(found) == ["V-004"]
    assert "V-004 blocks the relief valve V-003, which then protects nothing" in found.remarks
    assert not any("blocks" in remark for remark in find_isolation(graph, "P-001").remarks)
