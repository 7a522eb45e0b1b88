import json

import networkx
from hypothesis import given
from hypothesis import strategies as st

import graphs
from cadgraph.export.graphml import write_graphml
from cadgraph.model.graph import SceneGraph


def read(path):
    return networkx.read_graphml(path, force_multigraph=True)


def test_all_nodes_and_edges_read_back(tmp_path):
    graph = graphs.valve_line()
    found = read(write_graphml(graph, tmp_path / "graph.graphml"))
    assert list(found) == list(graph.nodes)
    assert [(u, v, d["kind"]) for u, v, d in found.edges(data=True)] != []
    assert sorted((u, v, d["kind"]) for u, v, d in found.edges(data=True)) == sorted(
        (e.source, e.target, e.kind) for e in graph.document.edges
    )


def test_nested_values_become_columns_or_json_text(tmp_path):
    graph = graphs.valve_line()
    node = read(write_graphml(graph, tmp_path / "graph.graphml")).nodes["part-1"]
    assert (node["label.group"], node["label.name"], node["label.confidence"]) == ("Valve assembly", "handwheel", 0.75)
    assert (node["x"], node["y"], node["z"]) == (1.0, 0.0, 0.0)
    assert json.loads(node["meshes"]) == ["/mesh_1"]
    assert json.loads(node["obb"])["extents"] == [0.5, 0.5, 0.5]
    assert node["ground"] is False
    assert node["n_triangles"] == 12


def test_nulls_are_left_out(tmp_path):
    found = read(write_graphml(graphs.valve_line(), tmp_path / "graph.graphml"))
    assert "volume" not in found.nodes["part-4"]
    assert not any(key.startswith("label") for key in found.nodes["part-4"])
    assert "label.name" not in found.nodes["part-2"]


def test_edge_ids_are_unique(tmp_path):
    found = read(write_graphml(graphs.valve_line(), tmp_path / "graph.graphml"))
    keys = [key for _, _, key in found.edges(keys=True)]
    assert len(set(keys)) == len(keys)


def test_characters_that_xml_cannot_hold_are_dropped(tmp_path):
    graph = graphs.graph([graphs.part(0, "/a\x00\x1b<&>\ud800b"), graphs.part(1), graphs.part(2)])
    data = graph.to_json()
    data["nodes"][2]["id"], data["nodes"][3]["id"] = "same", "sa\x07me"
    data["edges"] = [{"kind": "adjacent", "source": "sa\x07me", "target": "same", "distance": 0, "point": [0, 0, 0]}]
    found = read(write_graphml(SceneGraph.from_json(data), tmp_path / "graph.graphml"))
    assert json.loads(found.nodes["part-0"]["meshes"])[0].replace("\\u", "").startswith("/a")
    assert [(u, v) for u, v in found.edges()] == [("same_2", "same")]


def test_unknown_keys_called_like_parameters_are_kept(tmp_path):
    data = graphs.valve_line().to_json()
    names = ("node_for_adding", "u_for_edge", "v_for_edge", "key", "attr", "self")
    data["nodes"][1].update(dict.fromkeys(names, "x"))
    data["edges"][0].update(dict.fromkeys(names, "x"))
    found = read(write_graphml(SceneGraph.from_json(data), tmp_path / "graph.graphml"))
    assert {"node_for_adding_", "attr", "self_"} <= set(found.nodes["cluster-0"])
    assert {"u_for_edge_", "key_", "attr"} <= set(found.get_edge_data("site", "cluster-0").popitem()[1])


def test_bytes_repeat(tmp_path):
    one, two = (write_graphml(graphs.valve_line(), tmp_path / name).read_bytes() for name in ("1.graphml", "2.graphml"))
    assert one == two


def test_a_graph_of_the_site_alone_can_be_written(tmp_path):
    assert list(read(write_graphml(graphs.graph(), tmp_path / "graph.graphml"))) == ["site"]


@given(st.text(), st.text(min_size=1), st.none() | st.booleans() | st.integers() | st.floats() | st.text())
def test_any_text_reads_back(tmp_path_factory, mesh, key, value):
    data = graphs.graph([graphs.part(0, mesh)]).to_json()
    data["nodes"][1].setdefault(key, value)
    path = tmp_path_factory.mktemp("any") / "graph.graphml"
    assert set(read(write_graphml(SceneGraph.from_json(data), path))) == {"site", "part-0"}
