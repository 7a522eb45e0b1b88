import pytest

import graphs
from cadgraph.model.records import Unit
from cadgraph.model.truth import Truth
from cadlab.evaluate import evaluate
from lab.evaluate.plants import PIPE, VALVE, agreeing, changed, line, made_of, relabelled


def verdicts(graph, truth=None):
    units = evaluate(graph, truth or line()).total.units
    return units, {unit.id: unit for unit in units.units}, {unit.tag: unit for unit in units.predicted}


def regrouped(graph, units):
    """The graph with these predicted units only: tag to (type, part names)."""
    kept = changed(
        graph,
        lambda node: None if isinstance(node, Unit) else node,
        lambda edge: None if edge.kind in ("connected", "related") else edge,
    )
    made = [graphs.unit(tag, *(f"part-{p}" for p in parts), unit_type=t) for tag, (t, parts) in units.items()]
    return made_of([*kept.document.nodes, *made], kept.document.edges)


def test_all_right():
    units, true, predicted = verdicts(agreeing(line()))
    total = units.total
    assert (total.n_true, total.n_predicted, total.fully, total.exact, total.matched) == (4, 4, 4, 4, 4)
    assert (total.partially, total.missed, total.split, total.merged, total.spurious) == (0, 0, 0, 0, 0)
    assert (total.kinds_decided, total.kinds_right, total.kind_accuracy) == (3, 3, 1.0)
    assert [row.type for row in units.types] == ["gauge", "valve"]
    assert true["V1"].match == "X-V1"
    assert true["V1"].overlap == 1.0
    assert predicted["X-V1"].holds == ("V1",)


def test_found_by_labels_alone_fully_partially_missed():
    pipe, lever = (PIPE, "pipe", 1), (VALVE, "lever", 1)
    wrong = relabelled(agreeing(line()), {"/v1w": pipe, "/v2": None, "/v2w": pipe, "/v3": lever})
    units, true, _ = verdicts(wrong)
    assert {name: unit.found for name, unit in true.items()} == {
        "V1": "partially", "V2": "missed", "V3": "fully", "G1": "fully",
    }  # fmt: skip
    assert (true["V1"].n_labelled, true["V1"].n_counted) == (1, 2)
    # The units themselves stand as they are: the strict reading looks at them, not at labels.
    assert units.total.exact == 4


def test_a_unit_split_in_two():
    graph = regrouped(
        agreeing(line()),
        {"A": ("valve", ["v1"]), "B": ("valve", ["v1w"]), "C": ("valve", ["v2", "v2w"]), "D": ("valve", ["v3"])},
    )
    units, true, predicted = verdicts(graph)
    valves = next(row for row in units.types if row.type == "valve")
    assert true["V1"].pieces == ("A", "B")
    assert (valves.n_predicted, valves.exact, valves.split, valves.merged, valves.spurious) == (4, 2, 1, 0, 0)
    assert true["V1"].overlap == 0.5
    assert {predicted["A"].match, predicted["B"].match} == {"V1", None}
    assert not true["G1"].exact
    assert true["G1"].match is None
    assert units.total.strict.recall == 0.5
    assert valves.detection.precision == 0.75


def test_two_units_merged():
    graph = regrouped(agreeing(line()), {"A": ("valve", ["v1", "v1w", "v2", "v2w"]), "D": ("valve", ["v3"])})
    units, true, predicted = verdicts(graph)
    assert units.total.merged == 1
    assert units.total.spurious == 0
    assert predicted["A"].holds == ("V1", "V2")
    assert [true[name].match for name in ("V1", "V2", "V3")] == ["A", None, "D"]


def test_spurious_units():
    graph = regrouped(
        agreeing(line()),
        {
            "pipes": ("valve", ["p0", "p1"]),
            "gauge taken for a valve": ("valve", ["g1"]),
            "half of it": ("valve", ["v1", "p2"]),
            "most of a unit": ("valve", ["v2", "v2w", "b", "floor", "v1w"]),
        },
    )
    _, true, predicted = verdicts(graph)
    assert {tag: unit.spurious for tag, unit in predicted.items()} == {
        "pipes": True, "gauge taken for a valve": True, "half of it": True, "most of a unit": False,
    }  # fmt: skip
    assert true["G1"].match is None
    assert predicted["pipes"].structure == "A"


def test_matching_takes_the_greatest_sum_of_overlaps():
    # V1 overlaps A by 2/3 and B by 1/3, V2 only A by 1/4: A stands for V1, and nothing is left for V2.
    graph = regrouped(agreeing(line()), {"A": ("valve", ["v1", "v1w", "v2"]), "B": ("valve", ["v2w", "b"])})
    _, true, _ = verdicts(graph)
    assert (true["V1"].match, true["V1"].overlap) == ("A", pytest.approx(2 / 3))
    assert (true["V2"].match, true["V2"].overlap) == ("B", pytest.approx(1 / 3))


def test_units_of_another_type_never_match():
    graph = regrouped(agreeing(line()), {"A": ("pump", ["v1", "v1w"])})
    units, true, _ = verdicts(graph)
    assert true["V1"].match is None
    assert not true["V1"].exact
    assert [(row.type, row.n_true, row.n_predicted) for row in units.types] == [
        ("gauge", 1, 0), ("pump", 0, 1), ("valve", 3, 0),
    ]  # fmt: skip


def test_parts_of_another_group_do_not_count_for_the_label_reading():
    data = line().to_json()
    data["units"][0]["meshes"].append("/p2")
    truth = Truth.from_json(data)
    _, true, _ = verdicts(agreeing(truth), truth)
    assert (true["V1"].found, true["V1"].n_parts, true["V1"].n_counted) == ("fully", 3, 2)
    _, true, _ = verdicts(agreeing(line()), truth)
    assert true["V1"].found == "fully"
    assert not true["V1"].exact


def test_a_unit_within_another_part_is_not_exact():
    truth = line()
    graph = changed(
        agreeing(truth),
        lambda node: (
            None
            if node.id in ("part-g1", "node-G1")
            else node.model_copy(update={"meshes": ("/p1", "/g1")})
            if node.id == "part-p1"
            else node
        ),
        lambda edge: None if {"part-g1", "node-G1"} & {edge.source, edge.target} else edge,
    )
    _, true, _ = verdicts(graph)
    assert (true["G1"].n_parts, true["G1"].found, true["G1"].exact) == (1, "missed", False)


def test_a_lost_unit_is_missed():
    truth = line()
    graph = changed(
        agreeing(truth),
        lambda node: None if node.id in ("part-g1", "node-G1") else node,
        lambda edge: None if {"part-g1", "node-G1"} & {edge.source, edge.target} else edge,
    )
    _, true, _ = verdicts(graph)
    assert (true["G1"].n_parts, true["G1"].found, true["G1"].exact) == (0, "missed", False)


def test_units_the_truth_knows_nothing_of_are_left_out():
    graph = agreeing(line())
    more = [graphs.part(99, "/stranger"), graphs.unit("S", "part-99")]
    found = evaluate(made_of([*graph.document.nodes, *more], graph.document.edges), line())
    assert found.n_unknown == 1
    assert found.total.units.total.n_predicted == 4
