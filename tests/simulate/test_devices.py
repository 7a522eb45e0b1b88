import json

import numpy as np
import pytest

import movable
from cadgraph.cli.staging import say_stage, write_stage_beside
from cadgraph.errors import LoadError
from cadgraph.simulate.stage.writing import write_stage


@pytest.fixture(scope="module")
def table(tmp_path_factory):
    folder = tmp_path_factory.mktemp("devices")
    graph = movable.write(folder / "plant.usdc")
    done = write_stage(graph, folder / "plant.usdc", folder / "out")
    return json.loads(done.files[1].read_text())


def row(table, tag):
    return next(each for each in table["devices"] if each["tag"] == tag)


def test_the_table_says_where_each_joint_is_and_where_each_number_comes_from(table):
    wheel = row(table, "V-2")
    mechanism = movable.mechanism("V-2", ("x",))
    assert wheel["joint_path"] == "/Plant/Devices/joints/V_2"
    assert (wheel["pivot_m"], wheel["axis"]) == (list(mechanism.pivot), list(mechanism.axis))
    assert (wheel["limits_deg"], wheel["open_deg"], wheel["shut_deg"]) == ([-3600.0, 0.0], 0.0, -3600.0)
    assert wheel["friction_nm"] == pytest.approx(4.0)
    assert wheel["sources"]["axis"] == "by construction"
    assert wheel["sources"]["friction"] == "assumed: 40 N at the rim start it"
    assert {"mass", "inertia", "armature", "damping"} <= set(wheel["sources"])


def test_a_hand_grips_a_wheel_at_its_rim_and_a_lever_along_it_and_no_needle(table):
    ring = row(table, "V-1")["grasp"]
    assert (ring["shape"], ring["radius_m"], ring["thickness_m"]) == ("ring", movable.RADIUS, movable.THICK)
    assert ring["center_m"] == pytest.approx([0.3, 0.2, 1.2], abs=1e-6)
    bar = row(table, "V-3")["grasp"]
    pose = movable.POSES["V-3"]
    assert bar["end_m"] == pytest.approx(pose[:3, :3] @ (movable.LONG - movable.THICK, 0, 0.2) + pose[:3, 3], abs=1e-6)
    assert row(table, "G-1")["grasp"] is None


def test_what_nobody_can_turn_is_listed_with_the_reason(table):
    assert table["immovable"] == [
        {"tag": "G-2", "unit": "unit-G-2", "reason": "no needle in the source; 'cadgraph simulate --needles' draws one"}
    ]


def test_the_command_writes_the_stage_beside_the_graph(tmp_path, capsys):
    graph = movable.write(tmp_path / "plant.usdc")
    folder = tmp_path / "out"
    folder.mkdir()
    graph.save(folder / "graph.json")
    told = write_stage_beside(folder, None, False)
    assert told["joints"] == ["V_1", "V_2", "V_3", "G_1"]
    assert (folder / "simulation.usda").exists()
    say_stage(told)
    said = capsys.readouterr().out.replace("\n", "")
    assert "4 joints, 9 colliders" in said
    assert "G-2: no needle in the source" in said


def test_a_stage_without_its_source_is_not_written_and_said_so(tmp_path, capsys):
    graph = movable.write(tmp_path / "plant.usdc")
    graph.save(tmp_path / "graph.json")
    (tmp_path / "plant.usdc").unlink()
    told = write_stage_beside(tmp_path, None, False)
    assert told["stage"] is None
    assert not (tmp_path / "simulation.usda").exists()
    say_stage(told)
    assert "simulation.usda was not written" in capsys.readouterr().err
    np.savetxt(tmp_path / "other.usda", [1])
    with pytest.raises(LoadError, match="changed since the graph was built, or another file"):
        write_stage_beside(tmp_path, tmp_path / "other.usda", False)
