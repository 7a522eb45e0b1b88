"""cadgraph facts, and --use-metadata."""

import json
import sys
from dataclasses import replace

import pytest

import cadgraph
from cadgraph.cli import main
from cadgraph.model.facts import Fact

SCENE = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "plant"
{{
{meshes}
}}
"""
CUBE = """def Cube "{name}"
{{
    double size = 1
    double3 xformOp:translate = ({x}, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}"""
NAMES = ("Handrad_1", "Handrad_2", "xqzw", "mesh_3", "pump")


@pytest.fixture
def scene_file(tmp_path):
    cubes = [CUBE.format(name=name, x=3 * k) for k, name in enumerate(NAMES)]
    (tmp_path / "plant.usda").write_text(SCENE.format(meshes="\n".join(cubes)))
    return tmp_path / "plant.usda"


def run(capsys, *arguments):
    with pytest.raises(SystemExit) as end:
        main([str(argument) for argument in arguments])
    said = capsys.readouterr()
    return end.value.code or 0, said.out, said.err


def test_each_value_has_its_count_claim_and_rule(capsys, scene_file):
    code, out, _ = run(capsys, "facts", scene_file)
    assert code == 0
    matched, _, unmatched = out.partition("matched nothing")
    assert "Handrad_1 -> Valve assembly/handwheel 60% '*handrad*' (de) in its name" in matched
    assert "xqzw" in unmatched
    assert "mesh_3" in unmatched
    assert "3 facts speak for a label, 2 match nothing" in unmatched


def test_the_list_as_json_with_words_of_ones_own(capsys, scene_file, tmp_path):
    (tmp_path / "mine.yaml").write_text("labels:\n  Tank/shell: {firm: ['xq*']}\n")
    rows = json.loads(run(capsys, "facts", scene_file, "--json", "--words", tmp_path / "mine.yaml")[1])
    (row,) = [row for row in rows if row["value"] == "xqzw"]
    assert (row["label"], row["count"], row["trust"], row["matched"]) == ("Tank/shell", 1, 0.6, True)
    assert {row["value"] for row in rows if not row["matched"]} == {"mesh_3"}


def test_a_malformed_list_of_words_ends_in_one_line(capsys, scene_file, tmp_path):
    (tmp_path / "mine.yaml").write_text("labels: [a\n")
    for command in (
        ["facts", scene_file, "--words", tmp_path / "mine.yaml"],
        ["build", scene_file, "-o", tmp_path / "o", "--use-metadata", "--set", f"label.words={tmp_path / 'mine.yaml'}"],
    ):
        code, _, err = run(capsys, *command)
        assert code == 2
        assert "mine.yaml" in err
        assert len(err.strip().splitlines()) == 1


def test_values_are_shown_as_they_are_and_run_nothing(capsys, scene_file, monkeypatch):
    # 'cadgraph.load' is the function, too.
    loading = sys.modules["cadgraph.load"]
    real = loading.load
    hostile = "[bold red]x[/] \x1b[31m\u202e" + "y" * 500

    def load(path, config):
        scene = real(path, config)
        return replace(scene, facts=(Fact(scene.paths[0], "type", hostile, "x"),))

    monkeypatch.setattr(loading, "load", load)
    out = run(capsys, "facts", scene_file)[1]
    assert "[bold red]x[/]" in out
    assert "\x1b" not in out
    assert "\u202e" not in out
    assert "y" * 100 not in out


def test_names_count_where_they_are_asked_for(capsys, scene_file, tmp_path):
    run(capsys, "build", scene_file, "-o", tmp_path / "a", "--no-report", "--set", "label.labeler=none")
    run(
        capsys,
        "build",
        scene_file,
        "-o",
        tmp_path / "b",
        "--no-report",
        "--set",
        "label.labeler=none",
        "--use-metadata",
    )
    plain, asked = cadgraph.SceneGraph.load(tmp_path / "a"), cadgraph.SceneGraph.load(tmp_path / "b")
    assert all(part.label is None for part in plain.parts())
    assert asked.part("/plant/Handrad_1").label.source == "file"
    assert asked.document.config["label"]["use_metadata"]
    assert asked.document.config["relate"]["use_metadata"]
    # A graph is labelled anew without what the file said becoming a second witness.
    before = asked.part("/plant/Handrad_1").label
    code, _, err = run(capsys, "label", tmp_path / "b", "--no-report")
    assert code == 0, err
    assert cadgraph.SceneGraph.load(tmp_path / "b").part("/plant/Handrad_1").label.confidence == before.confidence


def test_an_old_setting_is_told_and_taken(capsys, scene_file, tmp_path):
    code, _, err = run(
        capsys, "build", scene_file, "-o", tmp_path / "a", "--no-report", "--set", "label.use_names=true"
    )  # fmt: skip
    assert code == 0
    assert "label.use_metadata" in err
    assert cadgraph.SceneGraph.load(tmp_path / "a").document.config["label"]["use_metadata"]
