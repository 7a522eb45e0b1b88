import json

import networkx

import graphs
from cadgraph.export.nodelink import write_nodelink


def test_networkx_reads_the_graph_back(tmp_path):
    graph = graphs.valve_line()
    data = json.loads(write_nodelink(graph, tmp_path / "nodelink.json").read_text(encoding="utf-8"))
    found = networkx.node_link_graph(data, edges="edges")
    assert networkx.utils.graphs_equal(found, graph.to_networkx())
    assert found.is_multigraph()
    assert found.is_directed()


def test_nothing_but_nodes_and_edges_is_in_it(tmp_path):
    data = json.loads(write_nodelink(graphs.valve_line(), tmp_path / "nodelink.json").read_text(encoding="utf-8"))
    assert set(data) == {"directed", "multigraph", "graph", "nodes", "edges"}
    assert all("key" in edge for edge in data["edges"])


def test_bytes_repeat_and_are_ascii(tmp_path):
    graph = graphs.graph([graphs.part(0, "/Körper\ud800")])
    one, two = (write_nodelink(graph, tmp_path / name).read_bytes() for name in ("1.json", "2.json"))
    assert one == two
    assert one.isascii()
