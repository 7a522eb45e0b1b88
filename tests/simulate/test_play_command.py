import contextlib
import io
import json

import numpy as np
import pytest
from PIL import Image
from pxr import Usd, UsdGeom, UsdValidation

import cadgraph
from cadgraph.cli import main
from cadgraph.model.graph import SceneGraph
from cadgraph.simulate.play.animation import write_animation
from cadgraph.simulate.play.film import play
from cadgraph.simulate.play.timetable import read_timetable
from cadplants import make, write_usd
from command_line import refused

pytestmark = pytest.mark.slow
CLOSE = "play:\n  - {at: 2, over: 10, set: {V-003: 0}}\n  - {at: 20, set: {P-001: 0}}\n"


@pytest.fixture(scope="module")
def played(tmp_path_factory):
    """The pumps, V-003 closed over ten seconds and P-001 stopped: the folder, and what was said."""
    folder = tmp_path_factory.mktemp("pumps")
    write_usd(make("pumps", 7), folder / "pumps.usdc")
    cadgraph.build(cadgraph.load(folder / "pumps.usdc")).save(folder / "out")
    (folder / "close.yaml").write_text(CLOSE, encoding="utf-8")
    return folder / "out", run(folder / "out", folder / "close.yaml")


def run(out, timetable):
    said = io.StringIO()
    with contextlib.redirect_stdout(said), pytest.raises(SystemExit) as end:
        main(["simulate", str(out), "--play", str(timetable), "--json"])
    assert not end.value.code
    return json.loads(said.getvalue())


def world(stage, path, time):
    return np.array(UsdGeom.XformCache(time).GetLocalToWorldTransform(stage.GetPrimAtPath(path)))


def test_the_lever_is_as_drawn_first_and_a_quarter_turned_last(played):
    out, _ = played
    stage = Usd.Stage.Open(str(out / "animation.usda"))
    drawn = Usd.Stage.Open(str(out / "simulation.usda"))
    graph = SceneGraph.load(out)
    levers = [unit.tag.replace("-", "_") for unit in graph.units("valve") if unit.mechanism is not None]
    assert "V_003" in levers
    for joint in levers:
        path = f"/Plant/Devices/{joint}"
        assert np.allclose(world(stage, path, 0), world(drawn, path, 0), atol=1e-6), joint
    last = np.linalg.inv(world(drawn, "/Plant/Devices/V_003", 0)) @ world(stage, "/Plant/Devices/V_003", 720)
    angle = np.degrees(np.arctan2(last[0, 1] - last[1, 0], last[0, 0] + last[1, 1]))
    assert angle == pytest.approx(-90.0, abs=1e-3)
    turn = stage.GetAttributeAtPath("/Plant/Devices/V_003.xformOp:rotateZ:played")
    assert [turn.Get(time) for time in (0, 48, 720)] == [0.0, 0.0, -90.0]
    assert turn.Get(168) == pytest.approx(-45.0, abs=0.5)


def test_needles_begin_at_the_steady_reading(played):
    out, _ = played
    stage = Usd.Stage.Open(str(out / "animation.usda"))
    steady = cadgraph.Process(out).state.joints
    for tag in ("G_003", "G_006"):
        turn = stage.GetAttributeAtPath(f"/Plant/Devices/{tag}.xformOp:rotateZ:played")
        assert turn.Get(0) == pytest.approx(steady[tag], abs=1e-3)


def test_the_animation_has_no_fault_and_the_readings_are_told(played):
    out, said = played
    registry = UsdValidation.ValidationRegistry()
    names = [found.name for found in registry.GetAllValidatorMetadata() if not found.isSuite]
    errors = UsdValidation.ValidationContext(registry.GetOrLoadValidatorsByName(names)).Validate(
        Usd.Stage.Open(str(out / "animation.usda"))
    )
    assert [error.GetMessage() for error in errors if error.GetType() == UsdValidation.ValidationErrorType.Error] == []
    assert said["played"]["seconds"] == 30
    assert said["pictures"] == [0, 7, 14, 22, 30]
    assert (said["late"], said["still"]) == (0, [])
    assert [path.rsplit("/", 1)[-1] for path in said["written"]] == ["animation.usda", "animation.png", "animation.gif"]


def test_a_second_run_writes_the_same_bytes(played):
    out, _ = played
    first = (out / "animation.usda").read_bytes()
    process = cadgraph.Process(out)
    film = play(process, read_timetable(out.parent / "close.yaml", process.network), 30.0)
    write_animation(film, out / "simulation.usda", out / "animation.usda")
    assert (out / "animation.usda").read_bytes() == first


def test_the_pictures_are_small_enough_to_be_sent(played):
    out, _ = played
    assert (out / "animation.png").stat().st_size < 1_000_000
    assert (out / "animation.gif").stat().st_size < 2_000_000
    with Image.open(out / "animation.png") as strip:
        assert strip.size[0] < 1600


def test_a_timetable_that_is_wrong_ends_in_one_line_and_leaves_everything(played, tmp_path, capsys):
    out, _ = played
    wrong = tmp_path / "wrong.yaml"
    wrong.write_text("play:\n  - {at: 2, set: {V-999: 0}}\n", encoding="utf-8")
    before = (out / "animation.usda").stat().st_mtime_ns
    assert "V-999" in refused(capsys, "simulate", out, "--play", wrong)
    assert "--set" in refused(capsys, "simulate", out, "--play", out.parent / "close.yaml", "--set", "V-003=0")
    assert (out / "animation.usda").stat().st_mtime_ns == before
