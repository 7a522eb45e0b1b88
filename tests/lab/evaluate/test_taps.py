"""Two gauges on one pipe: end - V1 - G1 - G2 - V2 - end, the gauges on outlets of the pipe p between the valves."""

import pytest

from cadgraph.model.records import Connected, Related
from cadgraph.model.truth import Truth
from cadlab.evaluate import evaluate, to_markdown
from lab.evaluate.plants import agreeing, changed, line, made_of

PIPE, VALVE, GAUGE = "Pipe assembly", "Valve assembly", "Gauge assembly"
ORDER = ("start", "V1", "G1", "G2", "V2", "end")


def two_on_one(**changes):
    rows = [("/v1", VALVE, "valve"), ("/v2", VALVE, "valve"), ("/g1", GAUGE, "gauge"), ("/g2", GAUGE, "gauge"),
            ("/p", PIPE, "pipe"), ("/o1", PIPE, "branch outlet"), ("/o2", PIPE, "branch outlet")]  # fmt: skip
    data = {
        "format": "cadgraph-truth",
        "version": 1,
        "meshes": [{"mesh": mesh, "group": group, "name": name} for mesh, group, name in rows],
        "units": [
            {"id": name, "type": "valve" if name[0] == "V" else "gauge", "meshes": [f"/{name.lower()}"]}
            for name in ("V1", "V2", "G1", "G2")
        ],
        "points": [{"id": "start", "kind": "terminal"}, {"id": "end", "kind": "terminal"}],
        "connections": [{"from": a, "to": b} for a, b in zip(ORDER[:-1], ORDER[1:], strict=True)],
        "clusters": [["/v1", "/v2", "/g1", "/g2", "/p", "/o1", "/o2"]],
        "contacts": [["/g1", "/o1"], ["/g2", "/o2"], ["/o1", "/p"], ["/o2", "/p"], ["/v1", "/p"], ["/p", "/v2"]],
    }
    return Truth.from_json({**data, **changes})


def ordered(truth, order, kind="connected"):
    """The agreeing graph, but with its units in this order."""
    graph = agreeing(truth)
    made = {"connected": Connected, "related": Related}[kind]
    kept = [edge for edge in graph.document.edges if edge.kind != kind]
    pairs = zip(order[:-1], order[1:], strict=True)
    return made_of(graph.document.nodes, [*kept, *(made(source=f"node-{a}", target=f"node-{b}") for a, b in pairs)])


def taps(graph, truth):
    scores = evaluate(graph, truth).total.connected_taps
    return scores.n_pairs, scores.n_right, scores.n_wrong


def test_the_same_order_is_right():
    truth = two_on_one()
    # On p lie V1-G1, G1-G2 and G2-V2.
    assert taps(agreeing(truth), truth) == (3, 3, 0)
    assert evaluate(agreeing(truth), truth).total.connected_taps.accuracy == 1.0


def test_two_gauges_the_other_way_round_are_wrong():
    truth = two_on_one()
    found = evaluate(ordered(truth, ("start", "V1", "G2", "G1", "V2", "end")), truth).total.connected_taps
    assert ("G1", "G2") in [verdict.units for verdict in found.reversed_pairs]
    assert found.n_right < found.n_pairs


def test_both_gauges_on_both_valves_is_no_order():
    truth = two_on_one()
    edges = [("V1", "G1"), ("V1", "G2"), ("G1", "V2"), ("G2", "V2"), ("G1", "G2")]
    graph = agreeing(truth)
    kept = [edge for edge in graph.document.edges if edge.kind != "connected"]
    graph = made_of(
        graph.document.nodes, [*kept, *(Connected(source=f"node-{a}", target=f"node-{b}") for a, b in edges)]
    )
    found = evaluate(graph, truth).total.connected_taps
    assert ("G1", "G2") in [verdict.units for verdict in found.reversed_pairs]


def test_a_graph_without_edges_decides_nothing():
    truth = two_on_one()
    graph = changed(agreeing(truth), edges=lambda edge: None if edge.kind == "connected" else edge)
    assert taps(graph, truth) == (3, 0, 0)


def test_gauges_on_two_pipes_are_no_pair():
    truth = two_on_one()
    data = truth.to_json()
    data["meshes"].append({"mesh": "/q", "group": PIPE, "name": "pipe"})
    data["contacts"] = [["/g1", "/o1"], ["/g2", "/o2"], ["/o1", "/p"], ["/o2", "/q"], ["/p", "/q"]]
    other = Truth.from_json(data)
    assert taps(agreeing(other), other) == (0, 0, 0)


def test_related_is_asked_the_same():
    truth = two_on_one()
    good = evaluate(agreeing(truth), truth).total.related_taps
    bad = evaluate(ordered(truth, ("V1", "G2", "G1", "V2"), "related"), truth).total.related_taps
    assert (good.n_pairs, good.n_right) == (3, 3)
    assert bad.n_wrong >= 1


def test_a_truth_without_contacts_has_no_taps():
    truth = two_on_one(contacts=None)
    assert evaluate(agreeing(truth), truth).total.connected_taps is None


def test_what_is_not_in_the_graph_is_said_so():
    truth = two_on_one()
    whole = to_markdown(evaluate(agreeing(truth), truth))
    assert "not in this graph" not in whole
    assert "Order of two taps on one mesh" in whole
    least = changed(agreeing(truth), edges=lambda edge: None if edge.kind in ("connected", "related") else edge)
    evaluation = evaluate(least, truth)
    assert not evaluation.total.connected.present
    page = to_markdown(evaluation)
    assert page.count("not in this graph") >= 4
    assert "0.000" not in page.split("## Order and relations")[1].split("##")[0]


def test_a_graph_without_units_says_so():
    truth = two_on_one()
    graph = changed(
        agreeing(truth),
        nodes=lambda node: None if node.layer == "unit" else node,
        edges=lambda edge: None if edge.kind in ("connected", "related") else edge,
    )
    evaluation = evaluate(graph, truth)
    assert not evaluation.total.units.present
    assert evaluation.total.units.total.n_predicted == 0


@pytest.mark.parametrize(("turned", "decided", "right"), [("forward", 1, 1), ("backward", 1, 0), ("unknown", 0, 0)])
def test_directions_are_counted_by_what_fixes_them(turned, decided, right):
    pairs = zip(ORDER[:-1], ORDER[1:], strict=True)
    connections = [{"from": a, "to": b} for a, b in pairs]
    connections[1] |= {"direction": "forward", "reason": "check valve"}
    truth = two_on_one(connections=connections)

    def turn(edge):
        if edge.kind == "connected" and (edge.source, edge.target) == ("node-V1", "node-G1"):
            return edge.model_copy(update={"direction": turned})
        return edge

    (scores,) = evaluate(changed(agreeing(truth), edges=turn), truth).total.connected.reasons
    assert scores.reason == "check valve"
    assert (scores.n_known, scores.n_decided, scores.n_right) == (1, decided, right)


def test_a_reason_holds_over_a_junction():
    truth = line()
    reasons = evaluate(agreeing(truth), truth).total.connected.reasons
    assert [r.reason for r in reasons] == []


def test_small_meshes_that_join_are_counted():
    truth = two_on_one(parts=[["/p", "/o1"], ["/g1", "/g2"]])
    found = evaluate(agreeing(truth), truth).total.joins
    assert (found.n_true, found.n_predicted, found.n_correct) == (2, 0, 0)


def test_a_mesh_that_joined_another_is_not_right():
    truth = two_on_one(parts=[["/p", "/o1", "/o2"]])
    graph = agreeing(truth)

    def regroup(node):
        if getattr(node, "meshes", None) == ("/p",):
            return node.model_copy(update={"meshes": ("/p", "/o1")})
        if getattr(node, "meshes", None) == ("/v1",):
            return node.model_copy(update={"meshes": ("/v1", "/o2")})
        return None if getattr(node, "meshes", None) in (("/o1",), ("/o2",)) else node

    gone = {part.id for part in graph.parts() if part.meshes in (("/o1",), ("/o2",))}
    changed_graph = changed(
        graph, nodes=regroup, edges=lambda edge: None if {edge.source, edge.target} & gone else edge
    )
    found = evaluate(changed_graph, truth).total.joins
    assert (found.n_true, found.n_predicted, found.n_correct) == (2, 2, 1)
