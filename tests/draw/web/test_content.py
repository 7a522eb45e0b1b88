"""What the page is told of a graph."""

import json

import numpy as np
import pytest

import graphs
import networks
from cadgraph.draw.web.content import as_bytes, content_of, diagnostics_of, network_of, parts_of, shown_meshes
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import Guess
from cadgraph.model.records import SourceFact

VOCABULARY = {
    "Pipe assembly": {"names": ["pipe"], "connector": True},
    "Valve assembly": {"names": ["valve"], "unit": "valve"},
}


@pytest.fixture
def graph():
    return graphs.valve_line(
        vocabulary=VOCABULARY, diagnostics=(Diagnostic("odd", "an odd one", ("/mesh_3", "/gone", "/mesh_3")),)
    )


@pytest.fixture
def scene():
    return graphs.boxes([f"/mesh_{i}" for i in range(5)] + ["/left_out"])


def test_every_column_has_a_row_for_each_part(graph, scene):
    content = content_of(graph, scene, 7)
    parts, n = content["parts"], len(graph.parts())
    triples = {"center", "size", "extents"}
    assert {name: len(column) for name, column in parts.items()} == {
        name: 3 * n if name in triples else n for name in parts
    }
    assert (content["version"], content["title"]) == (7, "plant.usd")
    assert content["meshes"] == {"path": list(scene.paths), "part": [0, 1, 2, 3, 4, -1]}
    assert shown_meshes(graph, scene).tolist() == [True] * 5 + [False]


def test_numbers_are_rows(graph):
    parts = parts_of(graph)
    assert parts["id"] == [f"part-{i}" for i in range(5)]
    assert parts["unit"] == [0, 0, -1, 1, 2]
    assert parts["cluster"] == [0, 0, 0, 0, 1]
    assert parts["group"] == [1, 1, 0, 1, -1]
    assert (parts["name"][2], parts["state"][4], parts["volume"][4]) == (None, "open", None)
    network = network_of(graph)
    assert [unit["parts"] for unit in network["units"]] == [[0, 1], [3], [4]]
    assert network["connections"][0]["via"] == [2]
    assert diagnostics_of(graph) == [{"code": "odd", "message": "an odd one", "parts": [3]}]


def test_some_parts_come_in_the_order_asked_for_with_the_numbers_of_all(graph):
    some, every = parts_of(graph, ["part-3", "part-0"]), parts_of(graph)
    assert some == {
        name: [x for i in (3, 0) for x in (column[3 * i : 3 * i + 3] if len(column) == 15 else [column[i]])]
        for name, column in every.items()
    }
    with pytest.raises(KeyError):
        parts_of(graph, ["part-9"])


def test_a_graph_from_disk_says_the_same(graph, scene, tmp_path):
    again = SceneGraph.load(graph.save(tmp_path))
    assert as_bytes(content_of(again, scene)) == as_bytes(content_of(graph, scene))


def test_points_are_relative_to_the_origin_of_the_scene(graph, scene):
    object.__setattr__(scene, "origin", np.array([100.0, 0, 2.0]))
    moved, plain = content_of(graph, scene), network_of(graph)
    assert moved["origin"] == [100, 0, 2]
    end, before = moved["network"]["ends"][0]["point"], plain["ends"][0]["point"]
    assert np.subtract(before, end).tolist() == [100, 0, 2]
    assert np.subtract(parts_of(graph)["center"], moved["parts"]["center"]).reshape(-1, 3).tolist() == [[100, 0, 2]] * 5


def test_the_network_says_what_leads_where_and_what_is_missing():
    network = network_of(networks.pumping())
    ids = {place["id"] for place in (*network["units"], *network["ends"])}
    for i, edge in enumerate(network["connections"]):
        assert {edge["source"], edge["target"]} <= ids
        if edge["line"] >= 0:
            assert i in network["lines"][edge["line"]]["connections"]
    assert sum(len(line["connections"]) for line in network["lines"]) == sum(
        edge["line"] >= 0 for edge in network["connections"]
    )
    assert all(line["start"] in ids and line["end"] in ids for line in network["lines"])
    alone = network_of(graphs.graph([graphs.part(0), graphs.unit("V-1", "part-0")]))
    assert alone["units"][0]["missing"] == 2


def test_groups_are_those_of_the_vocabulary_then_any_other_with_a_color_each(scene):
    graph = graphs.graph([graphs.part(0, label=graphs.label("Rotor", "blade"))], vocabulary=VOCABULARY)
    groups = content_of(graph, scene)["groups"]
    assert [(group["name"], group["unit"]) for group in groups] == [
        ("Pipe assembly", None), ("Valve assembly", "valve"), ("Rotor", None),
    ]  # fmt: skip
    assert len({group["color"] for group in groups}) == 3
    assert parts_of(graph)["group"] == [2]


def test_only_the_first_guesses_and_facts_are_told_and_long_ones_are_cut():
    guesses = tuple(Guess("Pipe assembly", "pipe", 0.1) for _ in range(8))
    facts = tuple(SourceFact(key="name", value="x\n" * 400, where="") for _ in range(20))
    part = graphs.part(0, guesses=guesses, facts=facts)
    parts = parts_of(graphs.graph([part], vocabulary=VOCABULARY))
    assert parts["guesses"][0] == [[0, "pipe", 0.1]] * 5
    assert len(parts["facts"][0]) == 12
    assert len(parts["facts"][0][0][1]) == 300
    assert "\n" not in parts["facts"][0][0][1]


def test_names_of_any_letters_become_json():
    graph = graphs.graph([graphs.part(0, "/\ud800", "/</script>")])
    content = content_of(graph, graphs.boxes(["/\ud800", "/</script>"]))
    assert json.loads(as_bytes(content))["meshes"]["path"] == ["/\ud800", "/</script>"]


def test_a_graph_of_nothing_has_empty_columns(scene):
    content = content_of(graphs.graph(), scene)
    assert all(column == [] for column in content["parts"].values())
    assert all(rows == [] for rows in content["network"].values())
