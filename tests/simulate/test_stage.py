import json

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdPhysics, UsdSemantics, UsdUtils, UsdValidation

import movable
from cadgraph.config import Config
from cadgraph.load import load
from cadgraph.model.graph import SceneGraph
from cadgraph.pipeline import build
from cadgraph.simulate.stage.writing import write_stage
from cadplants import make
from cadplants.writers.usd import write_usd

WORKED = ("V-1", "V-2", "V-3", "G-1")


@pytest.fixture(autouse=True)
def _quiet():
    delegate = UsdUtils.CoalescingDiagnosticDelegate()
    yield
    delegate.TakeUncoalescedDiagnostics()


@pytest.fixture(scope="module", params=movable.STYLES)
def written(request, tmp_path_factory):
    """Source, graph, what was written, and the open stage."""
    folder = tmp_path_factory.mktemp(request.param)
    source = folder / "plant.usdc"
    graph = movable.write(source, movable.STYLES[request.param])
    done = write_stage(graph, source, folder / "out")
    return source, graph, done, Usd.Stage.Open(str(folder / "out/simulation.usda"))


def body(stage, tag):
    return stage.GetPrimAtPath(f"/Plant/Devices/{tag.replace('-', '_')}")


def joint(stage, tag):
    return stage.GetPrimAtPath(f"/Plant/Devices/joints/{tag.replace('-', '_')}")


def test_usd_finds_no_fault(written):
    registry = UsdValidation.ValidationRegistry()
    names = [each.name for each in registry.GetAllValidatorMetadata() if not each.isSuite]
    validators = registry.GetOrLoadValidatorsByName(names)
    faults = UsdValidation.ValidationContext(validators).Validate(written[3])
    assert [(fault.GetName(), fault.GetMessage()) for fault in faults] == []


def test_every_mesh_is_shown_once_where_it_stood_and_in_its_colour(written):
    source, _, done, _ = written
    before, colors = movable.shown(source)
    after, colors_after = movable.shown(done.files[0])
    assert before.shape == after.shape
    assert np.allclose(before, after, atol=2e-5)
    assert np.allclose(colors, colors_after, atol=1e-6)


def test_the_stage_is_metres_with_z_up_and_all_below_the_plant(written):
    stage = written[3]
    assert UsdGeom.GetStageMetersPerUnit(stage) == 1.0
    assert UsdGeom.GetStageUpAxis(stage) == "Z"
    assert stage.GetDefaultPrim().GetPath() == "/Plant"
    assert [prim.GetName() for prim in stage.GetPseudoRoot().GetChildren()] == ["Plant", "PhysicsScene"]


def test_no_body_lies_in_another_and_none_is_scaled(written):
    bodies = [prim for prim in written[3].Traverse() if prim.HasAPI(UsdPhysics.RigidBodyAPI)]
    assert len(bodies) == 1 + len(WORKED)
    for prim in bodies:
        assert [other for other in bodies if prim.GetPath().HasPrefix(other.GetPath())] == [prim]
        matrix = np.array(UsdGeom.XformCache().GetLocalToWorldTransform(prim))[:3, :3]
        assert np.allclose(matrix @ matrix.T, np.eye(3), atol=1e-12)


def test_each_body_turns_about_the_axis_of_its_mechanism(written):
    _, graph, _, stage = written
    for tag in WORKED:
        mechanism = next(unit for unit in graph.units() if unit.tag == tag).mechanism
        matrix = np.array(UsdGeom.XformCache().GetLocalToWorldTransform(body(stage, tag)))
        assert np.allclose(matrix[3, :3], mechanism.pivot, atol=1e-8)
        assert np.allclose(matrix[2, :3], mechanism.axis, atol=1e-8)
        hinge = UsdPhysics.RevoluteJoint(joint(stage, tag))
        assert (hinge.GetLowerLimitAttr().Get(), hinge.GetUpperLimitAttr().Get()) == mechanism.limits
        assert hinge.GetAxisAttr().Get() == "Z"
        assert np.allclose(hinge.GetLocalPos0Attr().Get(), mechanism.pivot, atol=1e-6)
        assert hinge.GetBody0Rel().GetTargets() == ["/Plant/Devices/base"]
        assert hinge.GetBody1Rel().GetTargets() == [body(stage, tag).GetPath()]


def test_valves_have_friction_and_no_drive_and_needles_a_drive_and_no_collider(written):
    stage = written[3]
    for tag in ("V-1", "V-2", "V-3"):
        assert not joint(stage, tag).HasAPI(UsdPhysics.DriveAPI, "angular")
        assert joint(stage, tag).GetAttribute("newton:friction").Get() == pytest.approx(
            60 * movable.LONG if tag == "V-3" else 40 * movable.RADIUS
        )
        assert joint(stage, tag).GetAttribute("physxJoint:armature").Get() == pytest.approx(0.02)
    assert joint(stage, "G-1").HasAPI(UsdPhysics.DriveAPI, "angular")
    assert not [p for p in Usd.PrimRange(body(stage, "G-1")) if p.HasAPI(UsdPhysics.CollisionAPI)]
    rim = [p for p in body(stage, "V-1").GetChildren() if p.GetTypeName() == "Capsule"]
    assert len(rim) == 20
    assert all(p.HasAPI(UsdPhysics.CollisionAPI) and UsdGeom.Imageable(p).ComputePurpose() == "guide" for p in rim)


def test_everything_that_stands_still_has_a_collider_but_bolts_and_dials(written):
    _, _, done, stage = written
    still = [
        prim
        for prim in stage.Traverse(Usd.TraverseInstanceProxies())
        if prim.HasAPI(UsdPhysics.CollisionAPI) and not str(prim.GetPath()).startswith("/Plant/Devices")
    ]
    # Three valves with body and stem, two cases, the pipe.
    assert len(still) == done.n_colliders == 3 * 2 + 2 + 1
    assert {UsdPhysics.MeshCollisionAPI(prim).GetApproximationAttr().Get() for prim in still} == {"none"}


def test_a_wheel_passes_through_its_own_valve(written):
    stage = written[3]
    for tag in ("V-1", "V-2", "V-3"):
        targets = UsdPhysics.FilteredPairsAPI(body(stage, tag)).GetFilteredPairsRel().GetTargets()
        assert len(targets) == 2
        assert all(stage.GetPrimAtPath(target).HasAPI(UsdPhysics.CollisionAPI) for target in targets)


def test_what_moves_keeps_its_label_and_a_needle_is_called_one(written):
    stage = written[3]
    said = {}
    for tag in WORKED:
        (mesh,) = [p for p in body(stage, tag).GetChildren() if p.GetTypeName() == "Mesh"]
        said[tag] = [list(UsdSemantics.LabelsAPI(mesh, name).GetLabelsAttr().Get()) for name in ("class", "cad_group")]
    assert said == {
        "V-1": [["handwheel"], ["Valve assembly"]],
        "V-2": [["handwheel"], ["Valve assembly"]],
        "V-3": [["lever"], ["Valve assembly"]],
        "G-1": [["gauge needle"], ["Gauge assembly"]],
    }


def test_instances_stay_instances_where_nothing_moves(tmp_path):
    graph = movable.write(tmp_path / "plant.usdc", movable.STYLES["native"])
    write_stage(graph, tmp_path / "plant.usdc", tmp_path / "out")
    before = Usd.Stage.Open(str(tmp_path / "plant.usdc"))
    after = Usd.Stage.Open(str(tmp_path / "out/simulation.usda"))
    count = [sum(prim.IsInstance() for prim in stage.Traverse()) for stage in (before, after)]
    assert count == [14, 12]  # both wheels were instances


def test_the_same_plant_gives_the_same_bytes(tmp_path):
    graph = movable.write(tmp_path / "plant.usdc", movable.STYLES["mixed"])
    done = [write_stage(graph, tmp_path / "plant.usdc", tmp_path / "out").files for _ in range(2)]
    first = [file.read_bytes() for file in done[0]]
    write_stage(graph, tmp_path / "plant.usdc", tmp_path / "out")
    assert [file.read_bytes() for file in done[1]] == first


def test_needles_are_drawn_where_dials_have_none(tmp_path):
    graph = movable.write(tmp_path / "plant.usdc")
    done = write_stage(graph, tmp_path / "plant.usdc", tmp_path / "out", needles=True)
    stage = Usd.Stage.Open(str(done.files[0]))
    needle = stage.GetPrimAtPath("/Plant/Devices/G_2/needle")
    matrix = np.array(UsdGeom.XformCache().GetLocalToWorldTransform(needle))
    tip = np.array([0.036, 0, 0]) @ matrix[:3, :3] + matrix[3, :3]
    face = movable.dial(movable.POSES["G-2"])
    # Seen from the front with twelve up, half past seven is down on the left.
    across = np.cross(face.up, face.normal)
    way = (tip - face.center) / 0.036
    assert [way @ across, way @ np.array(face.up)] == pytest.approx([-np.sqrt(0.5), -np.sqrt(0.5)], abs=1e-6)
    assert (tip - face.center) @ np.array(face.normal) > 0
    assert list(UsdSemantics.LabelsAPI(needle, "class").GetLabelsAttr().Get()) == ["gauge needle"]
    table = json.loads(done.files[1].read_text())
    row = next(row for row in table["devices"] if row["tag"] == "G-2")
    assert row["drawn"]
    assert row["limits_deg"] == [-270.0, 0.0]
    assert [each["tag"] for each in table["immovable"]] == []


def test_a_source_that_is_not_usd_goes_by_its_geometry(tmp_path):
    graph = movable.write(tmp_path / "plant.glb")
    done = write_stage(graph, tmp_path / "plant.glb", tmp_path / "out")
    assert (tmp_path / "out/scene.usdc").exists()
    before, _ = movable.shown(tmp_path / "plant.glb")
    after, _ = movable.shown(done.files[0])
    assert np.allclose(before, after, atol=2e-5)
    assert len(done.devices) == 4
    assert done.n_colliders == 9


def test_a_far_plant_stands_about_its_origin_and_the_table_says_where(tmp_path):
    near = tmp_path / "near.usdc"
    movable.write(near)
    stage = Usd.Stage.Open(str(near))
    UsdGeom.Xformable(stage.GetPrimAtPath("/World")).AddTranslateOp().Set((3.5e8, 0, 0))  # 350 km in millimetres
    stage.Export(str(tmp_path / "far.usdc"))
    scene = load(tmp_path / "far.usdc", movable.QUICK)
    made = movable.plant()
    paths = [each["mesh"] for each in json.loads((tmp_path / "near.truth.json").read_text())["meshes"]]
    graph = movable.graph_of(scene, made, paths)
    moved = [
        node.model_copy(update={"mechanism": _moved(node.mechanism, 3.5e5)})
        if getattr(node, "mechanism", None)
        else node
        for node in graph.document.nodes
    ]
    graph = SceneGraph(graph.document.model_copy(update={"nodes": tuple(moved)}))
    done = write_stage(graph, tmp_path / "far.usdc", tmp_path / "out")
    origin = json.loads(done.files[1].read_text())["origin_m"]
    assert origin == scene.origin.tolist() != [0, 0, 0]
    stage = Usd.Stage.Open(str(done.files[0]))
    matrix = np.array(UsdGeom.XformCache().GetLocalToWorldTransform(body(stage, "V-1")))
    assert np.allclose(matrix[3, :3] + origin, np.array([3.5e5, 0, 0]) + movable.mechanism("V-1", ("x",)).pivot)


def _moved(mechanism, far):
    x, y, z = mechanism.pivot
    return mechanism.model_copy(update={"pivot": (x + far, y, z)})


def test_a_mesh_that_the_source_does_not_have_is_named(tmp_path):
    graph = movable.write(tmp_path / "plant.usdc")
    nodes = [
        node.model_copy(update={"mechanism": movable.mechanism("V-1", ("/World/gone",))})
        if getattr(node, "tag", None) == "V-1"
        else node
        for node in graph.document.nodes
    ]
    graph = SceneGraph(graph.document.model_copy(update={"nodes": tuple(nodes)}))
    with pytest.raises(ValueError, match=r"V-1 turns mesh '/World/gone', which is not in the scene"):
        write_stage(graph, tmp_path / "plant.usdc", tmp_path / "out")


@pytest.mark.slow
def test_a_plant_built_from_nothing_but_its_shapes_can_be_simulated(tmp_path):
    source = tmp_path / "skid.usdc"
    write_usd(make("skid", 7), source, movable.STYLES["point"])
    graph = build(load(source, movable.QUICK), Config(load=movable.QUICK))
    done = write_stage(graph, source, tmp_path)
    kinds = sorted(device.mechanism.kind for device in done.devices)
    assert kinds == ["handwheel"] * 5 + ["lever"] * 7 + ["needle"] * 12
    before, colors = movable.shown(source)
    after, colors_after = movable.shown(done.files[0])
    assert np.allclose(before, after, atol=2e-5)
    assert np.allclose(colors, colors_after, atol=1e-6)
    test_usd_finds_no_fault((source, graph, done, Usd.Stage.Open(str(done.files[0]))))
