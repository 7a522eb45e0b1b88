import csv
import io

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cadgraph.export.tables import table_bytes
from cadgraph.query import find_lines
from cadgraph.query.text import line_rows, line_table, line_values
from networks import chain, junction, network, pumping, terminal, unit


def runs(graph):
    return [(line.start_name, line.end_name, line.through_names) for line in find_lines(graph)]


def test_a_line_runs_on_through_valves_and_gauges_in_order():
    nodes = [unit("T-001"), unit("V-002"), unit("G-001"), unit("V-001"), unit("P-001")]
    (line,) = find_lines(network(nodes, chain("T-001.N1 V-002 G-001 V-001 P-001.N2", length=1.5)))
    assert (line.start_name, line.start_port, line.end_name, line.end_port) == ("T-001", "N1", "P-001", "N2")
    assert line.through_names == ("V-002", "G-001", "V-001")
    assert line.length == pytest.approx(6.0)
    assert (line.size, line.flow, line.system) == ("80", "forward", "system-001")


@pytest.mark.parametrize("name", ["P-001", "T-001", "E-001"])
def test_a_line_ends_at_pumps_tanks_and_equipment(name):
    nodes = [terminal(1), unit(name), terminal(2)]
    assert len(find_lines(network(nodes, chain(f"X1 {name} X2")))) == 2


def test_a_line_ends_at_a_junction():
    nodes = [terminal(1), terminal(2), terminal(3), junction(1)]
    assert len(find_lines(network(nodes, chain("X1 J1 X2") + chain("J1 X3")))) == 3


def test_a_valve_of_three_ways_ends_lines():
    nodes = [terminal(1), terminal(2), terminal(3), unit("V-001")]
    assert len(find_lines(network(nodes, chain("X1 V-001 X2") + chain("V-001 X3")))) == 3


def test_the_tap_of_a_gauge_does_not_divide_a_line_and_is_named_at_its_place():
    nodes = [terminal(1), terminal(2), junction(1), unit("V-001"), unit("V-002"), unit("V-003"), unit("G-001")]
    edges = chain("X1 V-001 J1 V-003 X2") + chain("J1 V-002 G-001", 15, 0.2, "unknown")
    (line,) = find_lines(network(nodes, edges))
    assert line.through_names == ("V-001", "V-002", "G-001", "V-003")
    # What flows passes the root valve of the gauge by.
    assert line.through_words == ("V-001", "(V-002)", "G-001", "V-003")
    assert line_values(line)["beside"] == ["V-002"]
    assert "in brackets: valves beside the line, on a tap" in line_table([line])[-1]
    assert line.length == pytest.approx(4.0)
    assert line.sizes == (80,)


def test_two_gauges_in_a_row_at_the_end_of_a_run_are_a_line():
    nodes = [unit("G-001"), unit("G-002")]
    assert runs(network(nodes, chain("G-001 G-002"))) == [("G-001", "G-002", ())]


def test_parallel_lines_between_the_same_units_are_two():
    nodes = [unit("T-001"), unit("P-001")]
    edges = chain("T-001.N1 P-001.N1") + chain("P-001.N2 T-001.N2")
    lines = find_lines(network(nodes, edges))
    assert [(line.start_port, line.end_port) for line in lines] == [("N2", "N2"), ("N1", "N1")]
    assert lines[0].tag != lines[1].tag


def test_a_ring_without_an_end_is_one_line():
    nodes = [unit("V-001"), unit("V-002"), unit("V-003")]
    (line,) = find_lines(network(nodes, chain("V-001 V-002 V-003 V-001")))
    assert (line.start_name, line.end_name, line.through_names) == ("V-001", "V-001", ("V-002", "V-003"))


def test_a_connection_from_a_unit_to_itself_is_a_line():
    (line,) = find_lines(network([unit("P-001")], chain("P-001.N2 P-001.N1")))
    assert (line.start_port, line.end_port) == ("N2", "N1")


def test_a_line_is_turned_so_that_it_goes_with_the_flow():
    nodes = [unit("T-001"), unit("V-001"), unit("P-001")]
    (line,) = find_lines(network(nodes, chain("P-001 V-001 T-001", direction="backward")))
    assert (line.start_name, line.end_name, line.flow) == ("T-001", "P-001", "forward")


def test_flow_known_in_a_part_is_that_of_the_line():
    nodes = [unit("T-001"), unit("V-001"), unit("P-001")]
    (line,) = find_lines(network(nodes, chain("T-001 V-001", direction="unknown") + chain("V-001 P-001")))
    assert line.flow == "forward"


def test_flows_against_each_other_are_told():
    nodes = [unit("T-001"), unit("V-001"), unit("P-001")]
    graph = network(nodes, chain("T-001 V-001") + chain("V-001 P-001", direction="backward"))
    assert [line.flow for line in find_lines(graph)] == ["contradictory"]
    assert "contradictory (><) in 1" in line_table(find_lines(graph))[-1]


def test_nothing_flows_to_a_blind_end():
    nodes = [unit("T-001"), unit("V-001"), terminal(1, "blind")]
    graph = network(nodes, chain("T-001 V-001 X1", direction="unknown"))
    assert [line.flow for line in find_lines(graph)] == ["none"]
    assert "unknown" not in line_table(find_lines(graph))[-1]
    open_end = network([*nodes[:2], terminal(1)], chain("T-001 V-001 X1", direction="unknown"))
    assert [line.flow for line in find_lines(open_end)] == ["unknown"]


def test_a_reducer_gives_both_sizes_and_an_unknown_length_is_told():
    nodes = [unit("T-001"), unit("V-001"), unit("P-001")]
    (line,) = find_lines(network(nodes, chain("T-001 V-001", 80) + chain("V-001 P-001", 50, None)))
    assert (line.size, line.length, line.whole) == ("80/50", 1.0, False)
    assert ">= 1.00 m" in line_table([line])[1]


def test_a_path_gives_the_length_where_none_is_stated():
    edges = chain("T-001 P-001", length=None, path=((0.0, 0.0, 0.0), (3.0, 0.0, 0.0), (3.0, 4.0, 0.0)))
    (line,) = find_lines(network([unit("T-001"), unit("P-001")], edges))
    assert line.length == pytest.approx(7.0)


def test_a_graph_without_connections_has_no_lines():
    graph = network([unit("V-001")], [])
    assert find_lines(graph) == []
    assert line_table([]) == ["no lines: the graph has no connections along pipes"]


def test_every_connection_is_in_one_line_or_a_tap():
    graph = pumping()
    lines = find_lines(graph)
    used = [arc.index for line in lines for arc in line.arcs]
    assert len(used) == len(set(used))
    assert len({line.tag for line in lines}) == len(lines) == 16


def test_a_line_added_elsewhere_renumbers_nothing():
    nodes = [unit("T-001"), unit("V-001"), unit("P-001")]
    edges = chain("T-001 V-001 P-001")
    (before,) = find_lines(network(nodes, edges))
    more = [unit("A-001", unit_type="equipment"), terminal(1)]
    after = find_lines(network([*more, *nodes], chain("A-001 X1") + edges))
    assert before.tag in {line.tag for line in after}


@settings(max_examples=15, deadline=None)
@given(st.randoms(use_true_random=False))
def test_the_order_of_edges_and_nodes_does_not_matter(random):
    graph = pumping()
    document = graph.document
    nodes, edges = list(document.nodes), list(document.edges)
    random.shuffle(nodes)
    random.shuffle(edges)
    mixed = type(graph)(document.model_copy(update={"nodes": tuple(nodes), "edges": tuple(edges)}))
    assert line_table(find_lines(mixed)) == line_table(find_lines(graph))


def test_the_csv_holds_no_formula():
    nodes = [unit("T-001"), unit("=cmd()", unit_type="valve"), unit("P-001")]
    edges = chain("T-001 V-001 P-001")
    renamed = [{"target": "unit-=cmd()"}, {"source": "unit-=cmd()"}]
    edges = [edge.model_copy(update=change) for edge, change in zip(edges, renamed, strict=True)]
    rows = list(csv.reader(io.StringIO(table_bytes(line_rows(find_lines(network(nodes, edges)))).decode("utf-8-sig"))))
    assert rows[0][:2] == ["line", "from"]
    assert rows[1][5] == "'=cmd()"
