import pytest

from cadgraph.query import find_isolation
from cadgraph.query.text import isolation_lines
from networks import chain, junction, network, pumping, terminal, unit


def closed(found):
    return sorted(valve.name for valve in found.valves)


def pump(*edges, kinds=(), more=()):
    """P-001 with chains around it; kinds by tag."""
    named = dict(kinds)
    names = {name.split(".")[0] for text in edges for name in text.split()}
    nodes = []
    for name in sorted(names):
        if name[0] == "J":
            nodes.append(junction(int(name[1:])))
        elif name[0] == "X":
            nodes.append(terminal(int(name[1:]), named.get(name, "open")))
        else:
            nodes.append(unit(name, named.get(name)))
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
    assert found.remarks[0] == "V-002 need not be closed: nothing can flow from behind it"


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
    nodes = [unit("P-001"), unit("V-001", "check valve"), unit("V-002"), terminal(1)]
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
        "V-002",
    ]


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
    found = find_isolation(pump("X1 P-001", kinds=[("X1", "blind")]), "P-001")
    assert found.valves == found.openings == ()
    assert isolation_lines(found)[0].startswith("no valve has to be closed")


def test_a_unit_without_connections_is_told():
    assert find_isolation(network([unit("P-001")], []), "P-001").remarks == ("P-001 is connected to nothing",)


def test_a_valve_itself_can_be_isolated():
    assert closed(find_isolation(pump("T-001 V-001 V-002 V-003 X1"), "V-002")) == ["V-001", "V-003"]


def test_two_connections_between_the_same_nodes_are_both_closed():
    nodes = [unit("P-001"), unit("V-001"), unit("V-002"), unit("T-001")]
    edges = chain("P-001.N1 V-001 T-001.N1") + chain("P-001.N2 V-002 T-001.N2") + chain("P-001.N1 V-001")
    assert closed(find_isolation(network(nodes, edges), "P-001")) == ["V-001", "V-002"]


def test_a_pumping_station_by_hand():
    found = find_isolation(pumping(), "P-001")
    assert closed(found) == ["V-002", "V-005"]
    assert sorted(found.shut_off_names) == ["G-001", "G-003", "V-004"]
    assert closed(find_isolation(pumping(), "P-001", check_valves=True)) == ["V-002", "V-004"]
    assert closed(find_isolation(pumping(), "T-001")) == ["V-001", "V-008", "V-016"]
