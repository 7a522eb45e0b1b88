import pytest

import graphs
from cadgraph.errors import OutputError
from cadgraph.export import export_graph, formats
from cadgraph.model.graph import SceneGraph

ALL = [
    "att",
    "csv",
    "dexpi",
    "epanet",
    "gltf",
    "graphml",
    "html",
    "ifc",
    "isometric",
    "json",
    "labels-csv",
    "mjcf",
    "networkx-json",
    "pcf",
    "shards",
    "usd",
]
ALONE = [name for name in ALL if name not in ("gltf", "html", "ifc", "mjcf", "usd")]  # those that need no source
FILLED = [name for name in ALONE if name not in ("isometric", "pcf", "shards")]  # those that fill one graph's folder


def test_formats_are_named_in_order_with_their_meaning():
    assert list(formats()) == ALL
    assert all(formats().values())


def test_shards_and_one_file_are_each_made_of_the_other(tmp_path):
    graph = graphs.valve_line()
    [index] = export_graph(graph, "shards", tmp_path / "shards")
    assert list((tmp_path / "shards/graph-shards").iterdir())
    [whole] = export_graph(SceneGraph.load(index), "json", tmp_path / "whole")
    assert whole.read_bytes() == graph.save(tmp_path / "plain.json").read_bytes()


@pytest.mark.parametrize("to", FILLED)
def test_every_format_writes_into_a_folder_that_it_makes(tmp_path, to):
    files = export_graph(graphs.valve_line(), to, tmp_path / "new")
    assert files
    assert sorted(files) == sorted((tmp_path / "new").iterdir())


@pytest.mark.parametrize("to", ALONE)
def test_inputs_stay_as_they_are(tmp_path, to):
    graph = graphs.valve_line()
    before = graph.to_json()
    export_graph(graph, to, tmp_path)
    assert graph.to_json() == before


@pytest.mark.parametrize(
    ("to", "name"),
    [("graphml", "plant.graphml"), ("networkx-json", "plant.JSON"), ("labels-csv", "plant.csv"), ("att", "plant.att")],
)
def test_a_path_with_the_formats_suffix_is_the_file(tmp_path, to, name):
    assert export_graph(graphs.graph(), to, tmp_path / name) == [tmp_path / name]


def test_a_folder_with_the_formats_suffix_is_a_folder(tmp_path):
    (tmp_path / "my.json").mkdir()
    assert export_graph(graphs.graph(), "networkx-json", tmp_path / "my.json") == [
        tmp_path / "my.json" / "nodelink.json"
    ]


@pytest.mark.parametrize(("to", "name"), [("graphml", "plant.json"), ("labels-csv", "a.usdz"), ("dexpi", "plant.svg")])
def test_a_file_of_another_format_is_refused(tmp_path, to, name):
    with pytest.raises(ValueError, match="give such a file, or a folder"):
        export_graph(graphs.graph(), to, tmp_path / name)
    assert not (tmp_path / name).exists()


def test_several_tables_do_not_fit_one_file(tmp_path):
    with pytest.raises(ValueError, match="give a folder"):
        export_graph(graphs.graph(), "csv", tmp_path / "plant.csv")


def test_an_unknown_format_names_the_known_ones(tmp_path):
    with pytest.raises(ValueError, match="'pdf'; there are att, csv, dexpi, epanet, gltf, graphml, html, ifc"):
        export_graph(graphs.graph(), "pdf", tmp_path)


@pytest.mark.parametrize("to", FILLED)
def test_a_file_in_the_way_is_an_output_error(tmp_path, to):
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(OutputError, match="choose another output folder"):
        export_graph(graphs.graph(), to, tmp_path / "file" / "out")
