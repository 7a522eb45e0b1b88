"""The graph of a large plant in shards: the same by every way of asking, read only as far as it is asked."""

from __future__ import annotations

import gzip
import json
import shutil

import pytest

import graphs
from cadgraph._io.shard_files import FOLDER
from cadgraph.config import Config
from cadgraph.errors import FormatError, UnknownNode
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Adjacent, Cluster, Connected, Contains, Part, Site, Terminal, Unit
from cadgraph.model.shards import ABOVE, Shards, cut
from cadgraph.query import find_lines, trace
from cadgraph.query.network import Network
from cadgraph.query.summary import summarize


@pytest.fixture
def whole():
    return graphs.valve_line()


@pytest.fixture
def folder(whole, tmp_path):
    whole.save(tmp_path, shard_above=1)
    return tmp_path


def test_the_setting_and_the_default_agree():
    assert Config().graph.shard_above == ABOVE


def test_a_graph_in_shards_is_the_same_document(whole, folder, tmp_path):
    read = SceneGraph.load(folder)
    assert len(list((folder / FOLDER).iterdir())) > 3
    assert read.to_json() == whole.to_json()
    one, other = whole.save(tmp_path / "one.json"), read.save(tmp_path / "other.json")
    assert one.read_bytes() == other.read_bytes()


def test_the_index_holds_no_row_that_is_in_shards(folder):
    index = json.loads((folder / "graph.json").read_text())
    assert index["version"] == 2
    assert not [node for node in index["nodes"] if node["layer"] == "part"]
    assert not [edge for edge in index["edges"] if edge["kind"] in ("contains", "adjacent")]
    assert [node for node in index["nodes"] if node["layer"] == "unit"]


def test_the_same_graph_gives_the_same_files(whole, folder, tmp_path):
    other = tmp_path / "other"
    other.mkdir()
    whole.save(other, shard_above=1)
    names = sorted(path.name for path in (folder / FOLDER).iterdir())
    assert names == sorted(path.name for path in (other / FOLDER).iterdir())
    for name in names:
        assert (folder / FOLDER / name).read_bytes() == (other / FOLDER / name).read_bytes()
    assert (folder / "graph.json").read_bytes() == (other / "graph.json").read_bytes()


def test_every_question_has_the_same_answer(whole, folder):
    read = SceneGraph.load(folder)
    assert repr(read) == repr(whole)
    assert list(read.nodes) == list(whole.nodes)
    assert len(read.nodes) == len(whole.nodes)
    for layer in (Part, Unit, Cluster, Terminal, Site):
        assert read.of_layer(layer) == whole.of_layer(layer)
    for kind in (Adjacent, Connected, Contains):
        assert read.of_kind(kind) == whole.of_kind(kind)
    for node in whole.nodes:
        assert read.nodes[node] == whole.nodes[node]
        assert read.find(node) == whole.find(node)
    for part in whole.parts():
        assert read.part(part.id) == part
        assert read.part(part.meshes[0]) == part
        assert read.part_with(part.meshes[0]) == part
        assert read.neighbors(part) == whole.neighbors(part)
        assert read.cluster_of(part) == whole.cluster_of(part)
        assert read.unit_of(part) == whole.unit_of(part)
        assert read.path(part, whole.parts()[0]) == whole.path(part, whole.parts()[0])
    for unit in whole.units():
        assert read.neighbors(unit) == whole.neighbors(unit)
        assert read.unit(unit.parts[0]) == unit
    assert read.parts(cluster="cluster-0") == whole.parts(cluster="cluster-0")
    assert read.parts(group="Valve assembly") == whole.parts(group="Valve assembly")
    assert read.joints() == whole.joints()
    assert read.diagnostics == whole.diagnostics
    assert summarize(read) == summarize(whole)
    assert find_lines(Network(read)) == find_lines(Network(whole))
    assert trace(read, "V-001", "downstream") == trace(whole, "V-001", "downstream")


def test_unknown_names_are_unknown(folder):
    read = SceneGraph.load(folder)
    assert "nothing" not in read.nodes
    assert read.part_with("/nowhere") is None
    with pytest.raises(UnknownNode):
        read.part("part-99999")
    with pytest.raises(UnknownNode):
        read.find("nothing at all")


def test_units_and_one_part_are_found_without_reading_all(folder, monkeypatch):
    taken = []
    plain = Shards._lines
    monkeypatch.setattr(Shards, "_lines", lambda self, shard: taken.append(shard.file) or plain(self, shard))
    read = SceneGraph.load(folder)
    assert [unit.tag for unit in read.units()]
    assert read.label_counts
    assert read.count("part") == 5
    assert taken == []
    assert read.part("part-0").id == "part-0"
    assert len(taken) == 1


def test_small_graphs_stay_one_file(whole, tmp_path):
    whole.save(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["graph.json"]


def test_the_setting_of_the_graph_decides(whole, tmp_path):
    document = whole.document.model_copy(update={"config": {"graph": {"shard_above": 1}}})
    SceneGraph(document).save(tmp_path)
    assert (tmp_path / FOLDER).is_dir()


def test_shards_hold_rows_in_order_over_their_borders(whole):
    index, shards = cut(whole.document.content(), above=1, rows=2)
    packed = dict(shards)
    runs = {(run["key"], run["kind"]): run for run in index["shards"]["runs"]}
    listed = runs["nodes", "part"]["shards"]
    assert [(shard["first"], shard["last"]) for shard in listed] == [
        ("part-0", "part-1"), ("part-2", "part-3"), ("part-4", "part-4")
    ]  # fmt: skip
    rows = [json.loads(line) for s in listed for line in gzip.decompress(packed[s["file"]]).splitlines()]
    assert rows == [node for node in whole.to_json()["nodes"] if node["layer"] == "part"]


def test_parts_in_no_order_are_not_cut(whole):
    document = whole.document.content()
    parts = [node for node in document["nodes"] if node.layer == "part"]
    rest = [node for node in document["nodes"] if node.layer != "part"]
    assert cut({**document, "nodes": [*rest, *parts[::-1]]}, above=1) is None


def test_a_new_graph_leaves_what_the_old_one_is_read_from_and_the_next_one_clears_it(whole, folder):
    old = SceneGraph.load(folder)
    before = {path.name for path in (folder / FOLDER).iterdir()}
    other = graphs.graph([graphs.part(n) for n in range(9)])
    other.save(folder, shard_above=1)
    assert old.to_json() == whole.to_json()
    other.save(folder, shard_above=1)
    assert not before & {path.name for path in (folder / FOLDER).iterdir()}
    assert len(SceneGraph.load(folder).parts()) == 9


@pytest.mark.parametrize(
    ("spoil", "says"),
    [
        (lambda path: path.unlink(), "missing, though graph.json names it"),
        (lambda path: path.write_bytes(path.read_bytes()[:-9]), "damaged"),
        (lambda path: path.write_bytes(b"no gzip"), "damaged"),
        (lambda path: path.write_bytes(gzip.compress(b'{"id": "part-0"}\n')), "not what graph.json was written with"),
    ],
)
def test_a_spoilt_shard_is_one_clear_line(folder, spoil, says):
    [path] = (folder / FOLDER).glob("nodes-part-*")
    spoil(path)
    read = SceneGraph.load(folder)
    for ask in (lambda: read.part("part-0"), read.parts, read.to_json):
        with pytest.raises(FormatError, match=says) as caught:
            ask()
        assert path.name in str(caught.value)
        assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["../../etc/passwd", "nodes-part-00000-0123456789abcdef.jsonl.gz/x", "/dev/zero"])
def test_an_index_cannot_lead_out_of_its_folder(folder, name):
    path = folder / "graph.json"
    data = json.loads(path.read_text())
    data["shards"]["runs"][0]["shards"][0]["file"] = name
    path.write_text(json.dumps(data))
    with pytest.raises(FormatError, match="shards"):
        SceneGraph.load(path)


def test_a_contradiction_shows_when_all_is_read(folder):
    path = folder / "graph.json"
    data = json.loads(path.read_text())
    data["edges"] = [edge for edge in data["edges"] if edge["kind"] != "connected"]
    data["edges"].append({"kind": "related", "source": "ghost", "target": "unit-V-001"})
    path.write_text(json.dumps(data))
    with pytest.raises(FormatError, match="ghost"):
        _ = SceneGraph.load(path).document


def test_a_copied_folder_is_whole(folder, whole, tmp_path):
    shutil.copytree(folder, tmp_path / "elsewhere", ignore=shutil.ignore_patterns("elsewhere"))
    assert SceneGraph.load(tmp_path / "elsewhere").to_json() == whole.to_json()
