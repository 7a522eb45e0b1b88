"""``cadgraph simulate``: the table, the scenario that it writes once, and what happens when valves are turned."""

import json

import pytest

from cadgraph.hydraulics.settings import SCENARIO
from command_line import refused, run
from networks import pumping


@pytest.fixture
def folder(tmp_path):
    pumping().save(tmp_path)
    return tmp_path


def test_the_first_run_writes_the_scenario_and_tells_the_state(folder, capsys):
    code, out, err = run(capsys, "simulate", folder)
    assert code == 0
    assert "P-001         pump" in out
    assert "values are assumed, as nobody has said otherwise" in out
    assert "pumps, head" in out
    assert SCENARIO in err
    assert (folder / SCENARIO).exists()


def test_an_edited_scenario_is_read_and_never_written_over(folder, capsys):
    run(capsys, "simulate", folder)
    before = json.loads(run(capsys, "simulate", folder, "--json")[1])
    file = folder / SCENARIO
    file.write_text('pumps: {"P-001": {running: 0}}  # mine\n', encoding="utf-8")
    values = json.loads(run(capsys, "simulate", folder, "--json")[1])
    assert file.read_text(encoding="utf-8").endswith("# mine\n")
    assert values["state"]["pumps"]["P-001"]["flow_m3h"] == pytest.approx(0, abs=1e-6)
    assert before["state"]["pumps"]["P-001"]["flow_m3h"] > 1
    assert len(values["assumed"]) == len(before["assumed"]) - 1


def test_setting_tells_every_gauge_before_and_after(folder, capsys):
    code, out, _ = run(capsys, "simulate", folder, "--set", "V-002=0", "--set", "P-002=0")
    assert code == 0
    rows = {line.split()[0]: line for line in out.splitlines() if line.strip()}
    assert "before" in out.splitlines()[0]
    assert {f"G-00{i}" for i in range(1, 8)} <= set(rows)
    assert "below its scale" in rows["G-001"]
    assert "cavitates" in rows["P-001"]
    assert "stands still" in rows["P-002"]
    assert "mind: P-001 cavitates: nothing flows to it" in out


def test_another_scenario_is_taken_and_none_is_written(folder, capsys, tmp_path):
    other = tmp_path / "night.yaml"
    other.write_text("pumps: {P-001: {running: 0}, P-002: {running: 0}}", encoding="utf-8")
    values = json.loads(run(capsys, "simulate", folder, "--scenario", other, "--json")[1])
    assert values["scenario"] == str(other)
    assert not (folder / SCENARIO).exists()


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ("V-002", "--set V-002: expected TAG=SHARE"),
        ("V-002=half", "--set V-002=half: expected TAG=SHARE"),
        ("=0", "--set =0: expected TAG=SHARE"),
        ("V-002=2", "V-002=2.0: give a number from 0"),
        ("V-004=0", "V-004 is a check valve"),
        ("V-777=0", "V-777"),
    ],
)
def test_what_can_not_be_set_is_one_line(folder, capsys, change, said):
    assert said in refused(capsys, "simulate", folder, "--set", change)


def test_a_scenario_that_can_not_be_used_is_one_line(folder, capsys):
    (folder / SCENARIO).write_text("valves: {V-777: {opening: 1}}", encoding="utf-8")
    assert "valves: nothing in the graph is called 'V-777'" in refused(capsys, "simulate", folder)


def test_the_same_command_writes_the_same_bytes(folder, capsys):
    run(capsys, "simulate", folder)
    first = (folder / SCENARIO).read_bytes()
    (folder / SCENARIO).unlink()
    run(capsys, "simulate", folder, "--json")
    assert (folder / SCENARIO).read_bytes() == first


def test_a_plant_is_written_for_epanet(folder, capsys):
    code, out, _ = run(capsys, "export", folder, "--to", "epanet")
    assert code == 0
    assert (folder / "plant.inp").read_text(encoding="utf-8").startswith("[TITLE]")
    assert "plant.inp" in out


def test_a_plant_is_written_for_epanet_elsewhere_as_the_folders_scenario_says(folder, capsys, tmp_path):
    run(capsys, "simulate", folder)
    _, out, _ = run(capsys, "export", folder, "--to", "epanet", "-o", tmp_path / "other")
    assert (tmp_path / "other/plant.inp").exists()
    assert f"as {folder / SCENARIO} says" in out
    assert "--scenario is for epanet" in refused(
        capsys, "export", folder, "--to", "graphml", "--scenario", folder / SCENARIO
    )


def test_how_long_to_play_goes_with_something_to_play(folder, capsys):
    assert "--seconds goes with --play" in refused(capsys, "simulate", folder, "--seconds", "5")
    assert not (folder / SCENARIO).exists()
