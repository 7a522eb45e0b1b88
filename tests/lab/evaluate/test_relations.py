import itertools

import networkx as nx
import pytest
from hypothesis import given
from hypothesis import strategies as st

import graphs
from cadgraph.model.records import Connected, Related, Terminal
from cadgraph.model.truth import Truth
from cadlab.evaluate import evaluate
from cadlab.evaluate.relations import contract
from lab.evaluate.plants import agreeing, changed, line, made_of


def pairs(edges):
    return [(edge.source or edge.found_source, edge.target or edge.found_target) for edge in edges]


def rewired(graph, kind, edges):
    """The graph with these edges of a kind only."""
    kept = [edge for edge in graph.document.edges if edge.kind != kind]
    made = {"connected": Connected, "related": Related}[kind]
    return made_of(
        graph.document.nodes,
        [*kept, *(made(source=f"node-{a}", target=f"node-{b}", **dict(m)) for a, b, *m in edges)],
    )


def test_junctions_are_contracted():
    star = contract([("a", "j", "unknown"), ("j", "k", "unknown"), ("k", "b", "unknown"), ("j", "c", "unknown")],
                    "abc", "jk", ())  # fmt: skip
    assert star.directions == {("a", "b"): "unknown", ("a", "c"): "unknown", ("b", "c"): "unknown"}


def test_no_way_leads_through_a_unit_or_a_terminal():
    found = contract([("a", "b", "unknown"), ("b", "c", "unknown"), ("c", "t", "unknown"), ("t", "d", "unknown")],
                     "abcd", (), "t")  # fmt: skip
    assert set(found.directions) == {("a", "b"), ("b", "c")}
    assert found.open_ends == {"c": 1, "d": 1}


def test_open_ends_behind_junctions_count_each():
    found = contract([("a", "j", "unknown"), ("j", "s", "unknown"), ("j", "t", "unknown")], "a", "j", "st")
    assert found.open_ends == {"a": 2}
    assert found.directions == {}


@pytest.mark.parametrize(
    ("first", "second", "expected"),
    [
        ("forward", "forward", "forward"),
        ("backward", "backward", "backward"),
        ("forward", "unknown", "unknown"),
        ("forward", "backward", "unknown"),
    ],
)
def test_a_direction_over_a_junction_needs_the_whole_way(first, second, expected):
    assert contract([("a", "j", first), ("j", "b", second)], "ab", "j", ()).directions == {("a", "b"): expected}


def test_two_ways_that_contradict_each_other_leave_the_direction_open():
    assert contract([("a", "b", "forward"), ("a", "b", "backward")], "ab", "", ()).directions["a", "b"] == "unknown"
    assert contract([("a", "b", "forward"), ("b", "a", "unknown")], "ab", "", ()).directions["a", "b"] == "forward"


NODES = "abcdjkltu"


@given(st.lists(st.tuples(st.sampled_from(NODES), st.sampled_from(NODES), st.just("unknown")), max_size=14))
def test_contraction_agrees_with_paths_in_the_subgraph(edges):
    network = nx.Graph([(a, b) for a, b, _ in edges])
    network.add_nodes_from(NODES)
    expected = {
        (a, b)
        for a, b in itertools.combinations("abcd", 2)
        if nx.has_path(network.subgraph({a, b, "j", "k", "l"}), a, b)
    }
    found = contract(edges, "abcd", "jkl", "tu")
    assert set(found.directions) == expected
    ends = {u: sum(nx.has_path(network.subgraph({u, t, "j", "k", "l"}), u, t) for t in "tu") for u in "abcd"}
    assert found.open_ends == {unit: n for unit, n in ends.items() if n}


def test_all_right():
    total = evaluate(agreeing(line()), line()).total
    for relations in (total.connected, total.related):
        assert (relations.edges.n_true, relations.edges.n_predicted, relations.edges.n_correct) == (3, 3, 3)
        assert (relations.edges.precision, relations.edges.recall, relations.edges.f1) == (1.0, 1.0, 1.0)
        assert relations.missing == relations.extra == ()
    assert total.connected.terminals.f1 == 1.0
    direction = total.connected.direction
    assert (direction.n_known, direction.n_decided, direction.n_right, direction.n_invented) == (1, 1, 1, 0)
    assert (direction.decided, direction.accuracy, direction.wrong) == (1.0, 1.0, 0.0)


def test_missing_and_extra_edges_worked_by_hand():
    # True: V1-G1, V1-V2, G1-V2. Of these one is found, and one more that isn't there.
    graph = rewired(agreeing(line()), "related", [("V1", "V2"), ("V2", "V3")])
    related = evaluate(graph, line()).total.related
    assert (related.edges.precision, related.edges.recall, related.edges.f1) == (0.5, 1 / 3, 0.4)
    assert pairs(related.missing) == [("G-1", "V-1"), ("G-1", "V-2")]
    assert pairs(related.extra) == [("V3", "V-2")]
    assert related.terminals is None
    assert related.direction is None


def test_edges_are_counted_in_every_structure_they_touch():
    graph = rewired(agreeing(line()), "related", [("V1", "V2"), ("V2", "V3")])
    first, second = evaluate(graph, line()).structures
    assert (first.related.edges.n_true, first.related.edges.n_predicted) == (3, 2)
    assert (second.related.edges.n_true, second.related.edges.n_predicted) == (0, 1)
    assert second.related.edges.recall is None


def test_an_edge_given_twice_or_the_other_way_round_counts_once():
    graph = rewired(agreeing(line()), "related", [("V2", "V1"), ("V1", "V2")])
    assert evaluate(graph, line()).total.related.edges.n_predicted == 1


def test_a_missed_unit_lowers_recall_but_not_among_the_units_found():
    graph = changed(
        agreeing(line()),
        lambda node: None if node.id == "node-G1" else node,
        lambda edge: None if "node-G1" in (edge.source, edge.target) else edge,
    )
    connected = evaluate(graph, line()).total.connected
    assert (connected.edges.n_true, connected.edges.n_correct) == (3, 1)
    assert (connected.between_matched.n_true, connected.between_matched.f1) == (1, 1.0)
    assert [(e.source, e.found_source) for e in connected.missing] == [("G-1", None), ("G-1", None)]


def test_a_spurious_unit_makes_extra_edges():
    graph = agreeing(line())
    nodes = [*graph.document.nodes, graphs.unit("S", "part-b")]
    edges = [*graph.document.edges, Connected(source="unit-S", target="node-V2")]
    connected = evaluate(made_of(nodes, edges), line()).total.connected
    assert (connected.edges.precision, connected.between_matched.precision) == (0.75, 1.0)
    assert [(e.target, e.found_target, e.structures) for e in connected.extra] == [(None, "S", ("A", "structure-2"))]


@pytest.mark.parametrize(
    ("told", "expected"),
    [("forward", (1, 1, 1, 0)), ("backward", (1, 1, 0, 0)), ("unknown", (1, 0, 0, 0))],
)
def test_directions_right_wrong_and_open(told, expected):
    # In the truth the flow goes from V1 over the branch to V2.
    graph = rewired(agreeing(line()), "connected", [("V1", "V2", ("direction", told))])
    d = evaluate(graph, line()).total.connected.direction
    assert (d.n_known, d.n_decided, d.n_right, d.n_invented) == expected


def test_a_direction_the_truth_does_not_know_is_invented():
    graph = rewired(agreeing(line()), "connected", [("V1", "G1", ("direction", "forward"))])
    d = evaluate(graph, line()).total.connected.direction
    assert (d.n_known, d.n_decided, d.n_invented, d.decided) == (0, 0, 1, None)


def test_open_ends_are_counted_by_their_unit():
    graph = rewired(agreeing(line()), "connected", [("V2", "end")])
    ends = evaluate(graph, line()).total.connected.terminals
    assert (ends.n_true, ends.n_predicted, ends.n_correct) == (1, 1, 0)


@pytest.mark.parametrize(
    ("true", "found", "correct"), [("open", "open", 1), ("blind", "blind", 1), ("blind", "open", 0)]
)
def test_an_end_is_right_where_it_is_as_open_as_the_truth_says(true, found, correct):
    data = line().to_json()
    data["points"] = [point | ({"end": true} if point["kind"] == "terminal" else {}) for point in data["points"]]
    graph = agreeing(line())
    nodes = [n.model_copy(update={"kind": found}) if isinstance(n, Terminal) else n for n in graph.document.nodes]
    told = made_of(nodes, graph.document.edges)
    ends = evaluate(told, Truth.from_json(data)).total.connected.terminals
    assert (ends.n_true, ends.n_predicted, ends.n_correct) == (1, 1, correct)


def test_a_graph_without_connections_has_no_precision():
    connected = evaluate(rewired(agreeing(line()), "connected", []), line()).total.connected
    assert (connected.edges.precision, connected.edges.recall, connected.edges.f1) == (None, 0.0, 0.0)


def test_without_annotated_connections_there_is_nothing_to_score():
    data = line().to_json()
    data["connections"] = None
    total = evaluate(agreeing(line()), Truth.from_json(data)).total
    assert (total.connected, total.related) == (None, None)
    data["connections"] = []
    total = evaluate(agreeing(line()), Truth.from_json(data)).total
    assert (total.connected.edges.n_true, total.connected.edges.precision) == (0, 0.0)
