import pytest

import graphs
from cadgraph.cli.screen import summary_lines
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.graph import SceneGraph
from cadgraph.query.summary import connection_words, end_words, summarize
from networks import chain, junction, network, pumping, terminal, unit


def test_connections_are_counted_once_by_what_they_join():
    found = summarize(pumping())
    assert found.n_connected == sum(found.between.values()) == 40
    assert found.ends == {"blind": 1, "open": 5}
    assert found.n_systems == 1


@pytest.mark.parametrize(
    ("edges", "words"),
    [
        ("P-001 V-001", "1: 1 between units"),
        ("P-001 J1", "1: 1 at junctions"),
        ("P-001 X1", "1: 1 to ends"),
        ("J1 X1", "1: 1 to ends"),
        ("P-001 V-001 J1 X1", "3: 1 between units, 1 at junctions, 1 to ends"),
    ],
)
def test_what_a_connection_joins(edges, words):
    nodes = [unit("P-001"), unit("V-001"), junction(1), terminal(1)]
    assert connection_words(summarize(network(nodes, chain(edges)))) == words


@pytest.mark.parametrize("code", ["cut-short", "broken-primitive", "damaged-source", "unbalanced-tree"])
def test_what_a_damaged_file_lacks_is_said_aloud(code):
    lacking = pumping().document.model_copy(update={"diagnostics": (Diagnostic(code, "a half is missing", ()),)})
    assert "a half is missing" in "\n".join(summary_lines(summarize(SceneGraph(lacking))))


def test_notes_whose_paths_were_cut_short_count_all_of_them():
    note = Diagnostic(
        "control-cage", "subdivision surfaces are loaded as their control cage (1,548 in all)", ("/a", "/b")
    )
    found = summarize(graphs.graph([], diagnostics=(note, Diagnostic("hidden", "left out", ("/c",)))))
    assert found.diagnostics == {"control-cage": 1548, "hidden": 1}


def test_ends_are_told_by_kind():
    nodes = [unit("P-001"), terminal(1), terminal(2, "blind"), terminal(3)]
    assert end_words(summarize(network(nodes, chain("X1 P-001 X2") + chain("P-001 X3")))) == "3: 2 open, 1 blind"
    assert end_words(summarize(network([], []))) == "0"


def test_units_without_a_line_are_named_where_others_have_one():
    nodes = [unit("P-001"), unit("V-001"), unit("P-002")]
    assert summarize(network(nodes, chain("P-001 V-001"))).without_line == {"P-002": ()}
    told = "\n".join(summary_lines(summarize(network(nodes, chain("P-001 V-001")))))
    assert "no line at" in told
    assert "P-002" in told


def test_relations_of_the_paper_are_counted_apart():
    found = summarize(graphs.valve_line())
    assert (found.n_connected, found.n_related) == (2, 1)
    assert any("1 pair of units (Algorithm 1 of the paper)" in line for line in summary_lines(found))
    assert not any("Algorithm 1" in line for line in summary_lines(summarize(pumping())))


def test_a_system_is_a_connected_network_and_nothing_else():
    told = summary_lines(summarize(graphs.valve_line()))
    assert [line for line in told if "system" in line.casefold()] == [
        "[dim]systems        [/]1 connected network of pipes"
    ]
