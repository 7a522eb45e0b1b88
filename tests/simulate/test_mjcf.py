import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

import movable
from cadgraph.export import export_graph
from cadgraph.load import load
from cadgraph.simulate.mjcf import write_mjcf

VALVES = ("V_1", "V_2", "V_3")


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    folder = tmp_path_factory.mktemp("mjcf")
    source = folder / "plant.usdc"
    graph = movable.write(source)
    return graph, source, *write_mjcf(graph, load(source, movable.QUICK), folder / "out/plant.xml", needles=True)


def test_the_model_names_each_joint_by_its_tag_and_keeps_its_meshes(written):
    _, _, files, notes = written
    root = ElementTree.parse(files[0]).getroot()
    assert [joint.get("name") for joint in root.iter("joint")] == ["V_1", "V_2", "V_3", "G_1", "G_2"]
    named = {mesh.get("file") for mesh in root.iter("mesh")}
    assert named == {file.name for file in files[1:]} == {f"{name}_0.obj" for name in (*VALVES, "G_1")}
    assert notes == ()


def test_it_is_an_export_format_and_tells_what_has_no_joint(written, tmp_path):
    graph, source, files, _ = written
    again = export_graph(graph, "mjcf", tmp_path / "out", source)
    assert [file.name for file in again] == [file.name for file in files]
    assert again[0] == tmp_path / "out/mjcf/plant.xml"
    assert export_graph(graph, "mjcf", tmp_path / "mjcf", source)[0] == tmp_path / "mjcf/plant.xml"
    _, notes = write_mjcf(graph, load(source, movable.QUICK), tmp_path / "bare.xml")
    assert [note.code for note in notes] == ["immovable"]
    assert notes[0].message.startswith("G-2 has no joint")


def test_the_same_plant_gives_the_same_bytes(written, tmp_path):
    graph, source, files, _ = written
    again, _ = write_mjcf(graph, load(source, movable.QUICK), tmp_path / "plant.xml", needles=True)
    assert [file.read_bytes() for file in again] == [file.read_bytes() for file in files]


@pytest.fixture
def simulated(written):
    mujoco = pytest.importorskip("mujoco")
    model = mujoco.MjModel.from_xml_path(str(written[2][0]))
    return mujoco, model, mujoco.MjData(model)


def turned(simulated, share, seconds=1.0):
    """Angles [deg] by joint after so long under so much of what starts each valve, towards its limit."""
    mujoco, model, data = simulated
    way = np.sign(model.jnt_range.sum(axis=1))
    data.qfrc_applied[:] = share * model.dof_frictionloss * way
    for _ in range(round(seconds / model.opt.timestep)):
        mujoco.mj_step(model, data)
    assert np.isfinite(data.qpos).all()
    return {model.joint(i).name: float(np.rad2deg(data.qpos[i])) for i in range(model.njnt)}


def test_nothing_moves_by_itself(simulated):
    assert max(map(abs, turned(simulated, 0.0).values())) < 1e-6


def test_half_of_what_starts_a_valve_does_not_turn_it(simulated):
    assert max(map(abs, turned(simulated, 0.5).values())) < 1.0


def test_three_times_that_turns_wheels_on_and_levers_to_their_stops(simulated):
    angles = turned(simulated, 3.0)
    assert angles["V_1"] < -300
    assert angles["V_2"] < -300
    assert angles["V_3"] == pytest.approx(-90, abs=5)


def test_needles_go_where_they_are_told(simulated):
    mujoco, model, data = simulated
    data.ctrl[:] = np.deg2rad([-100, -200])
    for _ in range(500):
        mujoco.mj_step(model, data)
    shown = [np.rad2deg(data.joint(name).qpos[0]) for name in ("G_1", "G_2")]
    assert shown == pytest.approx([-100, -200], abs=0.5)


def test_a_ball_rolls_into_a_lever_and_turns_it(written, tmp_path):
    mujoco = pytest.importorskip("mujoco")
    spec = mujoco.MjSpec.from_file(str(written[2][0]))
    pose = movable.POSES["V-3"]
    at = pose[:3, :3] @ (0.15, 0.2, 0.2) + pose[:3, 3]
    ball = spec.worldbody.add_body(name="ball", pos=at, gravcomp=1.0)
    ball.add_freejoint()
    ball.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.03, 0, 0], mass=2.0)
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qvel[model.joint(model.njnt - 1).dofadr[0] :][:3] = pose[:3, :3] @ (0, -4.0, 0)
    for _ in range(250):
        mujoco.mj_step(model, data)
    angle = np.rad2deg(data.joint("V_3").qpos[0])
    assert -90 < angle < -1
    assert all(abs(np.rad2deg(data.joint(name).qpos[0])) < 0.1 for name in ("V_1", "V_2"))
