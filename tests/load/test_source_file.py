"""Where the file of a graph is looked for."""

import hashlib

import pytest

from cadgraph.errors import LoadError
from cadgraph.load.source_file import find_source
from cadgraph.model.records import SourceRecord

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
