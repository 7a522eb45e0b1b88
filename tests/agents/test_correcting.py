"""Corrections by an agent: tried out first, kept with who and why, refused where they can't be kept."""

import hashlib
from contextlib import closing

import pytest

from agents_asking import ask, text
from cadgraph._io.folder_lock import LOCK
from cadgraph.agents.answer import AskError
from cadgraph.agents.correcting import Desk
from cadgraph.agents.plants import Plants
from cadgraph.errors import OutputError
from cadgraph.model.corrections import CORRECTIONS, read_history
from cadgraph.session.run import run as build
from serving import NONE, make_folder


@pytest.fixture
def blocks(tmp_path):
    """A folder of blocks that a test may change."""
    return make_folder(tmp_path)


def digests(folder):
    return {
        str(path.relative_to(folder)): (hashlib.sha256(path.read_bytes()).hexdigest(), path.stat().st_mtime_ns)
        for path in folder.rglob("*")
        if path.is_file() and path.name != LOCK
    }


def test_a_dry_run_changes_no_file_and_a_correction_is_kept_with_who_and_why(blocks):
    before = digests(blocks)
    edit = {"target": "part-00001", "label": "Gauge assembly/gauge", "why": "it has a dial", "this_only": True}
    with closing(Plants(blocks, "robot")) as plants:
        tried, again = ask(plants, ("correct", edit), ("describe", {"id": "part-00001"}))
        assert digests(blocks) == before
        assert text(tried).startswith("dry run, nothing was changed")
        assert "part-00001: Gauge assembly/gauge: 1 label would change" in text(tried)
        assert "units new: G-001" in text(tried)
        assert "gauge" not in text(again)

        kept, found = ask(plants, ("correct", edit | {"dry_run": False}), ("describe", {"id": "G-001"}))
        assert text(kept).startswith("kept in corrections.json")
        assert not found.is_error
        (event,) = read_history(blocks).audit()
        assert (event["who"], event["why"]) == ("robot", "it has a dial")
    assert Plants(blocks).get("").find("G-001").parts == ("part-00001",)


def test_a_correction_is_taken_back_by_an_empty_label(blocks):
    edit = {"target": "part-00001", "label": "gauge", "why": "guessed", "this_only": True, "dry_run": False}
    with closing(Plants(blocks, "robot")) as plants:
        _, back, gone = ask(plants, ("correct", edit), ("correct", edit | {"label": ""}), ("describe", {"id": "G-001"}))
    assert not back.is_error
    assert gone.is_error


def test_what_cannot_be_corrected_is_refused_and_changes_nothing(blocks):
    before = digests(blocks)
    edit = {"target": "part-00001", "label": "gauge", "why": "a test", "dry_run": False}
    with closing(Plants(blocks, "robot")) as plants:
        wrong, without, unknown, site, again = ask(
            plants,
            ("correct", edit | {"label": "gage"}),
            ("correct", edit | {"why": " "}),
            ("correct", edit | {"target": "part-99999"}),
            ("correct", edit | {"target": "site"}),
            ("correct", edit | {"label": ""}),
        )
        assert "did you mean 'Gauge assembly/gauge'" in text(wrong)
        assert "say why" in text(without)
        assert all(result.is_error for result in (wrong, without, unknown, site, again))
        assert digests(blocks) == before


def test_no_other_process_changes_the_folder_meanwhile(blocks):
    with closing(Plants(blocks, "robot")):
        with pytest.raises(OutputError, match="at work in it"):
            Plants(blocks, "another")
        assert Plants(blocks).get("").graph.parts()
    with closing(Plants(blocks, "another")) as plants:
        assert plants.writable


def test_corrections_of_another_program_are_told_not_written_over(blocks):
    with closing(Plants(blocks, "robot")) as plants:
        desk = plants.desk("")
        desk.correct("part-00001", "gauge", "first", this_only=True, dry_run=False)
        file = blocks / CORRECTIONS
        file.write_text(file.read_text().replace("first", "changed by hand"))
        told, tried = ask(plants, *[("correct", {"target": "part-00002", "label": "gauge", "why": "second"})] * 2)
    assert "changed by another program" in text(told)
    assert not tried.is_error


def test_corrections_that_the_graph_lacks_are_told_before_ids_are_used(blocks):
    with closing(Plants(blocks, "robot")) as plants:
        plants.desk("").correct("part-00001", "gauge", "first", this_only=True, dry_run=False)
        lacking = {name: (blocks / name).read_bytes() for name in ("graph.json", "manifest.json")}
    for name, content in lacking.items():
        (blocks / name).write_bytes(content)
    with closing(Plants(blocks, "robot")) as plants:
        told, tried = ask(plants, *[("correct", {"target": "part-00002", "label": "gauge", "why": "second"})] * 2)
    assert "ids may mean other parts" in text(told)
    assert not tried.is_error


def test_a_plant_that_is_long_in_opening_is_answered_with_a_repeat(blocks, monkeypatch):
    monkeypatch.setattr("cadgraph.agents.correcting._PATIENCE", 0.0)
    monkeypatch.setattr(Desk, "_open", lambda desk, graph: None)
    with closing(Plants(blocks, "robot")) as plants:
        (result,) = ask(plants, ("correct", {"target": "part-00001", "label": "gauge", "why": "x"}))
    assert "still being opened" in text(result)
    assert "nothing was changed" in text(result)


def test_a_scene_that_is_gone_is_told(blocks):
    (blocks.parent / "plant.usda").unlink()
    with closing(Plants(blocks, "robot")) as plants:
        (result,) = ask(plants, ("correct", {"target": "part-00001", "label": "gauge", "why": "x"}))
    assert "nothing can be corrected here" in text(result)
    assert "plant.usda" in text(result)


def test_only_a_group_is_said_of_all_parts_of_a_unit(tmp_path):
    scene = tmp_path / "plant.usda"
    mesh = """def Mesh "%s" {
  int[] faceVertexCounts = [3, 3, 3, 3]
  int[] faceVertexIndices = [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2]
  point3f[] points = [(%f, 0, 0), (%f, 0, 0), (%f, 1, 0), (%f, 0, 1)]
}
"""
    meshes = "".join(mesh % (f"b{n}", 0.999 * n, 0.999 * n + 1, 0.999 * n, 0.999 * n) for n in range(2))
    scene.write_text(f'#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "Z"\n)\n{meshes}')
    build(scene, tmp_path / "out", NONE, report=False)
    with closing(Plants(tmp_path / "out", "robot")) as plants:
        desk = plants.desk("")
        for part in ("part-00000", "part-00001"):
            desk.correct(part, "Valve assembly", "a test", this_only=True, dry_run=False)
        with pytest.raises(AskError, match="has 2 parts, and only a group fits them all; name the part: part-00000"):
            desk.correct("V-001", "valve body", "a test")
        assert "all 2 parts of V-001: Gauge assembly" in desk.correct("V-001", "Gauge assembly", "a test").text
