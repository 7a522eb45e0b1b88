import json

import numpy as np
import pytest

from cadgraph.load import load
from cadgraph.session.demo import DEMO_SCENE
from cadlab.evaluate import evaluate_files
from cadplants import make, truth_path, write_usd
from command_line import refused, run

REMEDY = "cadgraph environment make --preset station -o src/cadgraph/session/demo_plant.usdc, and delete its truth"


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The scene as the generator makes it now, with its truth beside it."""
    path = tmp_path_factory.mktemp("made") / "plant.usdc"
    write_usd(make("station"), path)
    return path


def test_the_packaged_scene_is_what_the_generator_makes(made):
    packaged, generated = load(DEMO_SCENE), load(made)
    assert packaged.paths == generated.paths, REMEDY
    np.testing.assert_array_equal(packaged.faces, generated.faces, REMEDY)
    for array in ("vertex_offsets", "face_offsets", "colors"):
        np.testing.assert_array_equal(getattr(packaged, array), getattr(generated, array), REMEDY)
    # Sines differ by a bit from one processor to another.
    np.testing.assert_allclose(packaged.vertices, generated.vertices, atol=1e-6, err_msg=REMEDY)


def test_the_packaged_scene_is_small():
    assert DEMO_SCENE.stat().st_size < 1_000_000


def test_names_in_the_scene_say_nothing():
    words = {word for path in load(DEMO_SCENE).paths for step in path.split("/")[1:] for word in step.split("_")}
    assert {word for word in words if not word.isdigit()} == {"World", "Node", "Geo"}


def test_every_unit_is_found_named_and_connected(demo, made):
    total = evaluate_files(demo / "demo", truth_path(made)).total
    units, connected = total.units.total, total.connected
    assert (units.n_true, units.n_predicted, units.matched, units.spurious) == (24, 24, 24, 0)
    assert (units.split, units.merged) == (0, 0)
    assert (units.kinds_decided, units.kinds_right) == (24, 24)
    assert connected.missing == connected.extra == ()
    assert connected.direction.n_known == connected.direction.n_right == 22
    assert connected.direction.n_invented == 0


def test_the_demo_says_what_to_open_and_what_to_try(demo):
    said = (demo / "said.txt").read_text()
    for name in ("report.html", "picture.png", "graph.json", "semantics.usda"):
        assert (demo / "demo" / name).is_file()
        assert f"demo/{name}" in said
    assert (demo / "demo" / "plant.usdc").read_bytes() == DEMO_SCENE.read_bytes()
    assert json.loads((demo / "demo" / "graph.json").read_text())["source"]["path"] == "demo/plant.usdc"
    assert "cadgraph isolate demo P-001" in said


def test_the_commands_that_the_demo_names_work(demo, capsys, monkeypatch):
    monkeypatch.chdir(demo)
    said = (demo / "said.txt").read_text().partition("try next")[2]
    commands = [line.split() for line in said.splitlines()]
    # It runs until it is stopped; tests of its own try it.
    assert commands.pop(0) == ["cadgraph", "view", "demo"]
    assert len(commands) == 5
    assert commands[-1] == ["cadgraph", "simulate", "demo"]
    for command in commands:
        assert command[0] == "cadgraph"
        code, out, _ = run(capsys, *command[1:])
        assert code == 0
        assert len(out.splitlines()) > 2


def test_the_demo_leaves_a_plant_of_the_user_alone(capsys, tmp_path):
    (tmp_path / "plant.usdc").write_text("mine")
    assert "not the demo scene" in refused(capsys, "demo", "-o", tmp_path)
    assert (tmp_path / "plant.usdc").read_text() == "mine"
