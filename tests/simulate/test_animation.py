import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom, UsdPhysics, UsdValidation

import playing
from cadgraph.errors import LoadError
from cadgraph.hydraulics.settings import Move
from cadgraph.simulate.play.animation import write_animation
from cadgraph.simulate.play.film import play
from cadgraph.simulate.play.timetable import Timetable


@pytest.fixture(scope="module")
def film():
    return play(playing.Told(), Timetable((Move(at=1, over=2, set={"V-001": 0.0}),)), 4.0)


@pytest.fixture
def simulation(tmp_path):
    """A valve whose body stands in its own frame with the joint off its origin and askew, in a moved plant."""
    path = tmp_path / "simulation.usda"
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    plant = UsdGeom.Xform.Define(stage, "/Plant")
    stage.SetDefaultPrim(plant.GetPrim())
    devices = UsdGeom.Xform.Define(stage, "/Plant/Devices")
    UsdPhysics.ArticulationRootAPI.Apply(devices.GetPrim())
    base = UsdGeom.Xform.Define(stage, "/Plant/Devices/base")
    valve = UsdGeom.Xform.Define(stage, "/Plant/Devices/V_001")
    valve.AddTranslateOp().Set(Gf.Vec3d(0.1, 0.2, 0.3))
    valve.AddRotateXOp().Set(90.0)
    lever = UsdGeom.Cube.Define(stage, "/Plant/Devices/V_001/lever")
    lever.AddTranslateOp().Set(Gf.Vec3d(0.4, 0.0, 0.0))
    joint = UsdPhysics.RevoluteJoint.Define(stage, "/Plant/Devices/joints/V_001")
    joint.CreateBody0Rel().SetTargets([base.GetPath()])
    joint.CreateBody1Rel().SetTargets([valve.GetPath()])
    joint.CreateAxisAttr("X")
    # The body's y is the world's z: X of the joint is turned onto it.
    joint.CreateLocalPos0Attr(Gf.Vec3f(0.3, 0.2, 0.3))
    joint.CreateLocalRot0Attr(Gf.Quatf(Gf.Rotation(Gf.Vec3d(0, 1, 0), -90.0).GetQuat()))
    joint.CreateLocalPos1Attr(Gf.Vec3f(0.2, 0.0, 0.0))
    joint.CreateLocalRot1Attr(Gf.Quatf(Gf.Rotation(Gf.Vec3d(0, 0, 1), 90.0).GetQuat()))
    for body in (base, valve):
        UsdPhysics.RigidBodyAPI.Apply(body.GetPrim())
    stage.Save()
    return path


def world(stage, path, time):
    return np.array(UsdGeom.XformCache(time).GetLocalToWorldTransform(stage.GetPrimAtPath(path)))


def test_the_first_sample_is_the_pose_as_drawn_and_the_last_is_turned_about_the_joint(tmp_path, simulation, film):
    write_animation(film, simulation, tmp_path / "animation.usda")
    drawn, played = Usd.Stage.Open(str(simulation)), Usd.Stage.Open(str(tmp_path / "animation.usda"))
    lever = "/Plant/Devices/V_001/lever"
    assert np.allclose(world(played, lever, 0), world(drawn, lever, 0), atol=1e-7)
    assert np.allclose(world(drawn, lever, 0)[3, :3], (0.5, 0.2, 0.3), atol=1e-7)
    # 0.2 m from the pivot at (0.3, 0.2, 0.3), turned by -90 degrees about the world's z.
    assert np.allclose(world(played, lever, 96)[3, :3], (0.3, 0.0, 0.3), atol=1e-6)
    # Half a frame is half a frame's turn.
    middle = world(played, lever, 47.5)[3, :3] - (0.3, 0.2, 0.3)
    assert np.linalg.norm(middle) == pytest.approx(0.2)
    assert np.degrees(np.arctan2(middle[1], middle[0])) == pytest.approx(-45 * 23.5 / 24, abs=1e-3)


def test_a_viewer_is_told_how_long_and_how_fast(tmp_path, simulation, film):
    write_animation(film, simulation, tmp_path / "animation.usda")
    stage = Usd.Stage.Open(str(tmp_path / "animation.usda"))
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode(), stage.GetTimeCodesPerSecond()) == (0, 96, 24)
    assert stage.GetDefaultPrim().GetPath() == "/Plant"
    assert (UsdGeom.GetStageUpAxis(stage), UsdGeom.GetStageMetersPerUnit(stage)) == ("Z", 1.0)


def test_a_simulator_leaves_it_alone(tmp_path, simulation, film):
    write_animation(film, simulation, tmp_path / "animation.usda")
    stage = Usd.Stage.Open(str(tmp_path / "animation.usda"))
    for body in ("base", "V_001"):
        assert not UsdPhysics.RigidBodyAPI.Get(stage, f"/Plant/Devices/{body}").GetRigidBodyEnabledAttr().Get()
    assert not stage.GetPrimAtPath("/Plant/Devices/joints/V_001").IsActive()
    assert not stage.GetPrimAtPath("/Plant/Devices").HasAPI(UsdPhysics.ArticulationRootAPI)


def test_samples_that_say_nothing_new_are_left_out(tmp_path, simulation, film):
    write_animation(film, simulation, tmp_path / "animation.usda")
    stage = Usd.Stage.Open(str(tmp_path / "animation.usda"))
    turn = stage.GetAttributeAtPath("/Plant/Devices/V_001.xformOp:rotateX:played")
    assert turn.GetTimeSamples() == [0, *range(24, 73), 96]


def test_a_second_run_writes_the_same_bytes_and_leaves_the_stage_below(tmp_path, simulation, film):
    before = simulation.read_bytes()
    write_animation(film, simulation, tmp_path / "animation.usda")
    first = (tmp_path / "animation.usda").read_bytes()
    write_animation(film, simulation, tmp_path / "animation.usda")
    assert (tmp_path / "animation.usda").read_bytes() == first
    assert simulation.read_bytes() == before


def test_joints_that_the_stage_lacks_are_told(tmp_path, simulation, film):
    assert write_animation(film, simulation, tmp_path / "animation.usda") == ("G_001",)


def test_the_validators_of_usd_find_no_error(tmp_path, simulation, film):
    write_animation(film, simulation, tmp_path / "animation.usda")
    registry = UsdValidation.ValidationRegistry()
    names = [found.name for found in registry.GetAllValidatorMetadata() if not found.isSuite]
    context = UsdValidation.ValidationContext(registry.GetOrLoadValidatorsByName(names))
    errors = context.Validate(Usd.Stage.Open(str(tmp_path / "animation.usda")))
    assert [error.GetMessage() for error in errors if error.GetType() == UsdValidation.ValidationErrorType.Error] == []


def test_a_stage_that_is_not_there_is_named(tmp_path, film):
    with pytest.raises(LoadError, match="nowhere"):
        write_animation(film, tmp_path / "nowhere.usda", tmp_path / "animation.usda")
