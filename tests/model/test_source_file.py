"""Where the file of a graph is looked for."""

import hashlib
import json
import os

import pytest

from cadgraph.config import Config, LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load
from cadgraph.model.records import SourceRecord
from cadgraph.model.source_file import changed_since, find_source, source_at_head
from cadgraph.pipeline import build
from cadgraph.session.session import Session

TEXT = "#usda 1.0\n"
RIGHT = hashlib.sha256(TEXT.encode()).hexdigest()


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "work" / "out").mkdir(parents=True)
    return tmp_path / "work" / "out"


@pytest.mark.parametrize("place", ["out/plant.usda", "cad/plant.usda", "plant.usda"])
def test_a_source_is_found_beside_the_folder_of_its_graph_too(folder, place, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    file = folder.parent / place
    file.parent.mkdir(exist_ok=True)
    file.write_text(TEXT)
    source = SourceRecord(path="cad/plant.usda", sha256=RIGHT)
    assert find_source(source, folder).resolve() == file
    with pytest.raises(LoadError, match="is not there; give it with --scene FILE"):
        find_source(source, None, option="--scene")


def test_another_file_of_that_name_is_passed_over_and_told_where_there_is_none_else(folder, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "plant.usda").write_text("another")
    source = SourceRecord(path="plant.usda", sha256=RIGHT)
    with pytest.raises(LoadError, match=r"plant\.usda: changed since the graph was built, or another file"):
        find_source(source, folder)
    (folder / "plant.usda").write_text(TEXT)
    assert find_source(source, folder) == folder / "plant.usda"
    with pytest.raises(LoadError, match="changed since"):
        find_source(source, folder, tmp_path / "plant.usda")


@pytest.fixture
def graph(folder):
    """A graph's file, ten seconds younger than the source beside it."""
    file = folder / "graph.json"
    file.write_text(json.dumps({"format": "cadgraph", "source": {"path": "plant.usda", "sha256": RIGHT}}))
    (folder / "plant.usda").write_text(TEXT)
    later = (folder / "plant.usda").stat().st_mtime + 10
    os.utime(file, (later, later))
    return file


def rewritten(file, text, graph):
    file.write_text(text)
    older = file.stat().st_mtime - 10
    os.utime(graph, (older, older))


def test_a_source_that_changed_after_its_graph_was_built_is_told(graph):
    source, file = source_at_head(graph), graph.parent / "plant.usda"
    assert (source.path, source.sha256) == ("plant.usda", RIGHT)
    assert changed_since(source, graph) == ""
    rewritten(file, TEXT, graph)  # younger, but the same
    assert changed_since(source, graph) == ""
    rewritten(file, "another plant", graph)
    assert changed_since(source, graph).startswith(f"{file}: changed since the graph was built, or another file")
    file.unlink()
    assert changed_since(source, graph) == ""


def test_a_file_that_a_source_refers_to_and_that_changed_or_went_is_told(graph):
    part = graph.parent / "part.usda"
    source = SourceRecord(path="plant.usda", sha256=RIGHT, referred=(("part.usda", RIGHT),))
    assert changed_since(source, graph) == f"{part}: is not there any more, and plant.usda refers to it"
    rewritten(part, "another part", graph)
    assert changed_since(source, graph) == f"{part}: changed since the graph was built, and plant.usda refers to it"
    rewritten(part, TEXT, graph)
    assert changed_since(source, graph) == ""


@pytest.mark.parametrize("path", ["//host/share/plant.usda", r"\\host\share\plant.usda"])
def test_no_other_machine_is_called_for_what_a_graph_says_of_its_source(graph, path, monkeypatch):
    asked = []
    monkeypatch.setattr("cadgraph.model.source_file._is_there", lambda *where: asked.append(where))
    assert changed_since(SourceRecord(path=path, sha256=RIGHT), graph) == ""
    assert changed_since(SourceRecord(path="plant.usda", sha256=RIGHT, referred=((path, RIGHT),)), graph) == ""
    assert asked == []


@pytest.mark.parametrize(
    "text",
    ["", "{", '{"nodes": []}', '{"source": 3}', '{"source": {"n_meshes": -1}}', '{"source": ' + "[" * 100_000],
)
def test_no_source_is_read_from_what_says_none(text, tmp_path):
    (tmp_path / "graph.json").write_text(text)
    assert source_at_head(tmp_path / "graph.json") is None
    assert source_at_head(tmp_path / "nothing.json") is None


BLOCK = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
    defaultPrim = "block"
)
def Mesh "block"
{
    int[] faceVertexCounts = [3, 3, 3, 3]
    int[] faceVertexIndices = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]
    point3f[] points = [(0, 0, 0), (SIZE, 0, 0), (0, SIZE, 0), (0, 0, SIZE)]
}
"""
ROOT = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def "a" (
    references = @parts/block.usda@
)
{
}
"""


@pytest.fixture
def plant(tmp_path):
    """A root layer and a block that it refers to."""
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "block.usda").write_text(BLOCK.replace("SIZE", "1"))
    (tmp_path / "plant.usda").write_text(ROOT)
    return tmp_path / "plant.usda"


@pytest.mark.parametrize("isolate", [True, False])
def test_a_file_that_the_source_refers_to_belongs_to_it(plant, isolate):
    block = plant.parent / "parts" / "block.usda"
    scene = load(plant, LoadConfig(isolate=isolate))
    assert scene.source.referred == (("parts/block.usda", hashlib.sha256(block.read_bytes()).hexdigest()),)
    record = build(scene).source
    assert find_source(record, None) == plant
    block.write_text(BLOCK.replace("SIZE", "2"))
    with pytest.raises(
        LoadError, match=r"block\.usda: changed since the graph was built, and plant\.usda refers to it"
    ):
        find_source(record, None)
    block.unlink()
    with pytest.raises(LoadError, match="is not there any more"):
        find_source(record, None)


def test_the_settings_that_a_scene_was_read_with_are_kept(plant):
    scene = load(plant, LoadConfig(scale=0.5, isolate=False))
    assert build(scene).config["load"]["scale"] == 0.5
    assert build(scene, Config().replace({"load.scale": 0.5})).config["load"]["scale"] == 0.5
    for start in (build, Session.start):
        with pytest.raises(ValueError, match=r"load\.scale is 5\.0 here, but the scene was read with 0\.5"):
            start(scene, Config().replace({"load.scale": 5.0}))
    limited = Config().replace({"load.timeout": 5.0})
    assert build(scene, limited).config["load"]["timeout"] == 5.0
