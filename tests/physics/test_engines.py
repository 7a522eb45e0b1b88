"""The stage in the engines that simulators use: ``make test-physics`` installs them; skipped where they are missing."""

import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom, UsdPhysics

import movable
from cadgraph.simulate.stage.writing import write_stage

PYTHON = os.environ.get("CADGRAPH_PHYSICS_PYTHON", "")
HERE = Path(__file__).parent

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not PYTHON, reason="no engines: CADGRAPH_PHYSICS_PYTHON names no interpreter that has them"),
]


def run(script, *arguments):
    """What a script in the engines' own interpreter found."""
    done = subprocess.run(
        [PYTHON, HERE / f"engine_{script}.py", *map(str, arguments)], capture_output=True, text=True, timeout=600
    )
    assert done.returncode == 0, done.stderr[-3000:]
    return json.loads(done.stdout.strip().splitlines()[-1])


@pytest.fixture(scope="module", params=movable.STYLES)
def folder(request, tmp_path_factory):
    made = tmp_path_factory.mktemp(request.param)
    graph = movable.write(made / "plant.usdc", movable.STYLES[request.param])
    write_stage(graph, made / "plant.usdc", made / "out", needles=True)
    return made / "out"


@pytest.fixture(scope="module")
def turned(folder):
    return run("physx", "turn", folder)


def test_physx_finds_a_joint_for_each_tag(turned):
    assert sorted(turned["names"]) == ["G_1", "G_2", "V_1", "V_2", "V_3"]


def test_physx_leaves_valves_alone_at_rest_and_under_half_of_what_starts_them(turned):
    assert max(map(abs, turned["rest"].values())) < 1e-3
    assert max(map(abs, turned["half"].values())) < 1e-3


def test_physx_turns_wheels_and_stops_levers_under_three_times_that(turned):
    assert turned["triple"]["V_1"] < -500
    assert turned["triple"]["V_2"] < -500
    assert turned["triple"]["V_3"] == pytest.approx(-90, abs=0.1)


def test_bodies_stay_on_their_axes_while_they_turn(turned):
    poses = np.array(turned["poses"])
    for tag in ("V-1", "V-2", "V-3"):
        mechanism = movable.mechanism(tag, ("x",))
        distance = np.linalg.norm(poses[:, :3] - mechanism.pivot, axis=1)
        assert distance.min() < 1e-4
        x, y, z, w = poses[distance.argmin(), 3:]
        axis = [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)]
        assert np.rad2deg(np.arccos(min(np.dot(axis, mechanism.axis), 1.0))) < 0.1


def test_needles_go_where_they_are_told(turned):
    assert sorted(turned["needles"]) == ["G_1", "G_2"]
    assert max(map(abs, turned["needles"].values())) < 0.05


def test_three_plants_by_reference_stand_where_they_were_put(folder):
    stage = Usd.Stage.CreateNew(str(folder / "three.usda"))
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdPhysics.Scene.Define(stage, "/PhysicsScene")
    for number in range(3):
        plant = UsdGeom.Xform.Define(stage, f"/World/env_{number}/Plant")
        plant.GetPrim().GetReferences().AddReference("./simulation.usda")
        plant.AddTranslateOp().Set(Gf.Vec3d(10.0 * number, 0, 0))
    stage.Save()
    assert np.allclose(run("physx", "three", folder)["bases"], [[0, 0, 0], [10, 0, 0], [20, 0, 0]], atol=1e-4)


def test_what_stands_still_holds_a_ball_and_a_thrown_one_turns_a_lever(folder):
    stage = Usd.Stage.CreateNew(str(folder / "balls.usda"))
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdPhysics.Scene.Define(stage, "/PhysicsScene")
    stage.DefinePrim("/Plant").GetReferences().AddReference("./simulation.usda")
    # On the middles of the bodies of the valves, which may be meshes, instances or items.
    for number, tag in enumerate(("V-1", "V-3")):
        pose = movable.POSES[tag]
        top = pose[:3, :3] @ (0.06, 0, 0.0) + pose[:3, 3] + (0, 0, 0.06)
        ball(stage, f"/Rest_{number}", np.add(top, (0, 0, 0.0105)), 0.01, 0.1)
    pose = movable.POSES["V-3"]
    thrown = ball(stage, "/Thrown", pose[:3, :3] @ (0.15, 0.2, 0.205) + pose[:3, 3], 0.03, 2.0)
    thrown.CreateVelocityAttr(Gf.Vec3f(*(pose[:3, :3] @ (0, -4.0, 0)).tolist()))
    stage.Save()
    found = run("physx", "thrown", folder)
    assert max(found["fallen"]) < 0.002  # free they would have fallen 0.05
    assert -89 < found["angles"].pop("V_3") < -1
    assert max(map(abs, found["angles"].values())) < 0.1


def ball(stage, path, at, radius, mass):
    """A ball that falls; its body."""
    sphere = UsdGeom.Sphere.Define(stage, path)
    sphere.CreateRadiusAttr(radius)
    sphere.AddTranslateOp().Set(Gf.Vec3d(*np.asarray(at, float).tolist()))
    UsdPhysics.CollisionAPI.Apply(sphere.GetPrim())
    UsdPhysics.MassAPI.Apply(sphere.GetPrim()).CreateMassAttr(mass)
    return UsdPhysics.RigidBodyAPI.Apply(sphere.GetPrim())


def test_newton_turns_the_same_joints(folder):
    found = run("newton", folder)
    assert sorted(found["names"]) == ["G_1", "G_2", "V_1", "V_2", "V_3"]
    assert max(map(abs, found["rest"].values())) < 0.1
    assert max(abs(found["half"][name]) for name in ("V_1", "V_2", "V_3")) < 20  # its dry friction creeps
    assert found["triple"]["V_1"] < -300
    assert found["triple"]["V_2"] < -300
    assert found["triple"]["V_3"] == pytest.approx(-90, abs=20)
