import json

import pytest

from cadgraph.simulate.tasks.records import TaskList
from command_line import refused, run


@pytest.mark.slow
def test_tasks_of_a_built_plant_are_written_with_what_can_not_be_done(demo, tmp_path, capsys):
    file = tmp_path / "tasks.json"
    code, said, told = run(
        capsys, "tasks", demo / "demo", "--seed", 7, "-n", 12, "-o", file, "--source", demo / "demo/plant.usdc"
    )
    assert code == 0
    made = TaskList.read(file)
    assert said.splitlines()[0].startswith(f"{len(made.tasks)} tasks: ")
    assert all(one.text in " ".join(said.split()) for one in made.left_out[:20])
    assert "values assumed" in told
    assert {stop.does for task in made.tasks for stop in task.stops} >= {"read"}
    assert len({json.dumps(task.model_dump(), default=list) for task in made.tasks}) == len(made.tasks) == 12


@pytest.mark.slow
def test_a_plant_whose_scene_is_gone_is_refused_in_one_line(demo, tmp_path, capsys):
    line = refused(capsys, "tasks", demo / "demo", "-o", tmp_path / "tasks.json", "--source", tmp_path / "gone.usdc")
    assert "gone.usdc" in line
