from __future__ import annotations

import os

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade

from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load
from cadgraph.load.losses import refuse_losses
from shapes import box

IN_PROCESS = LoadConfig(isolate=False)
QUADS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])


@pytest.fixture
def stage(tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "scene.usda"))
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    UsdGeom.SetStageUpAxis(stage, "Z")
    return stage


def add_mesh(stage, path, points=None, faces=None, at=None, scheme="none"):
    mesh = UsdGeom.Mesh.Define(stage, path)
    points = box()[0] if points is None else np.asarray(points, float)
    faces = QUADS if faces is None else faces
    mesh.CreatePointsAttr([Gf.Vec3f(*map(float, p)) for p in points])
    mesh.CreateFaceVertexCountsAttr([len(f) for f in faces])
    mesh.CreateFaceVertexIndicesAttr([int(i) for f in faces for i in f])
    mesh.CreateSubdivisionSchemeAttr(scheme)
    if at is not None:
        UsdGeom.XformCommonAPI(mesh).SetTranslate(at)
    return mesh


def saved(stage, **changes):
    stage.Save()
    return load(stage.GetRootLayer().realPath, IN_PROCESS.model_copy(update=changes))


def volume(scene, index=0):
    vertices, faces = scene.mesh(index)
    return float(np.linalg.det(vertices[faces]).sum() / 6)


def codes(scene):
    return {note.code for note in scene.diagnostics}


def size(scene, index=0):
    return np.ptp(scene.mesh(index)[0], axis=0)


def center(scene, index=0):
    vertices = scene.mesh(index)[0]
    return (vertices.min(axis=0) + vertices.max(axis=0)) / 2


# --- units and axes


@pytest.mark.parametrize(("axis", "up"), [("X", [5, 6, 4]), ("Y", [4, -6, 5]), ("Z", [4, 5, 6])])
def test_up_axis_becomes_z(stage, axis, up):
    stage.SetMetadata("upAxis", axis)
    add_mesh(stage, "/a", at=(4, 5, 6))
    scene = saved(stage)
    np.testing.assert_allclose(center(scene), up)
    assert volume(scene) == pytest.approx(1)
    assert scene.source.up_axis == axis


def test_unknown_up_axis_is_taken_as_y_and_noted(stage):
    stage.SetMetadata("upAxis", "sideways")
    add_mesh(stage, "/a")
    scene = saved(stage)
    assert scene.source.up_axis == "Y"
    assert "invalid-up-axis" in codes(scene)


def test_units_scale_to_metres(stage):
    UsdGeom.SetStageMetersPerUnit(stage, 0.001)
    add_mesh(stage, "/a", at=(1000, 0, 0))
    scene = saved(stage)
    np.testing.assert_allclose(center(scene), [1, 0, 0])
    np.testing.assert_allclose(size(scene), 0.001)
    assert scene.source.meters_per_unit == 0.001


def test_file_without_units_or_axis_gets_those_of_usd(tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "bare.usda"))
    add_mesh(stage, "/a")
    scene = saved(stage)
    np.testing.assert_allclose(size(scene), 0.01)
    assert {"missing-units", "missing-up-axis"} <= codes(scene)


@pytest.mark.parametrize("meters", [0.0, -1.0, float("inf"), float("nan"), 0.9e-10, 1.1e6, 1e300, 1e-300])
def test_impossible_units_are_repaired(stage, meters):
    stage.SetMetadata("metersPerUnit", meters)
    add_mesh(stage, "/a")
    scene = saved(stage)
    np.testing.assert_allclose(size(scene), 0.01)
    assert "invalid-units" in codes(scene)


@settings(max_examples=15, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    meters=st.sampled_from([1e-6, 0.001, 0.01, 0.0254, 0.3048, 1, 1000]),
    axis=st.sampled_from("XYZ"),
    place=st.tuples(*[st.floats(-100, 100, width=32)] * 3),
    swap=st.booleans(),
)
def test_same_world_whatever_the_authored_units_and_axis(tmp_path, meters, axis, place, swap):
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageMetersPerUnit(stage, meters)
    UsdGeom.SetStageUpAxis(stage, "Z")
    stage.SetMetadata("upAxis", axis)
    to_authored = {"X": [2, 0, 1], "Y": [0, 2, 1], "Z": [0, 1, 2]}[axis]
    sign = {"X": [1, 1, 1], "Y": [1, 1, -1], "Z": [1, 1, 1]}[axis]
    points = (box((1, 2, 3))[0] + place)[:, to_authored] * sign / meters
    for name in ("b", "a") if swap else ("a", "b"):
        mesh = add_mesh(stage, f"/{name}", points)
        if name == "b":
            UsdGeom.XformCommonAPI(mesh).SetTranslate(tuple(np.array([0, 0, 10])[to_authored] / meters))
    path = tmp_path / "scene.usda"
    stage.GetRootLayer().Export(str(path))
    scene = load(path, IN_PROCESS)
    assert scene.paths == ("/a", "/b")
    tolerance = 1e-6 * (np.abs(place).max() + 10)
    np.testing.assert_allclose(scene.mesh(0)[0], box((1, 2, 3))[0] + place, atol=tolerance)
    np.testing.assert_allclose(scene.mesh(1)[0], box((1, 2, 3))[0] + place + [0, 0, 10], atol=tolerance)
    assert volume(scene) == pytest.approx(6, rel=1e-3)


def test_far_scene_gets_a_round_origin_and_keeps_its_millimetres(stage):
    mesh = add_mesh(stage, "/a", box((0.01, 0.01, 0.01))[0])
    UsdGeom.Xformable(mesh).AddTranslateOp(UsdGeom.XformOp.PrecisionDouble).Set((24_000_012.3456, 5_000_000, 1))
    scene = saved(stage)
    np.testing.assert_array_equal(scene.origin, [24_000_000, 5_000_000, 0])
    np.testing.assert_allclose(center(scene), [12.3456, 0, 1], atol=1e-8)


@pytest.mark.parametrize(("x", "origin"), [(10_000.0, 0), (10_001.0, 10_000)])
def test_origin_is_zero_up_to_ten_kilometres(stage, x, origin):
    add_mesh(stage, "/a", [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], at=(x, 0, 0))
    assert saved(stage).origin.tolist() == [origin, 0, 0]


# --- transforms


def test_nested_transforms_multiply_and_reset_forgets_parents(stage):
    UsdGeom.XformCommonAPI(UsdGeom.Xform.Define(stage, "/g")).SetTranslate((10, 0, 0))
    inner = UsdGeom.Xform.Define(stage, "/g/inner")
    inner.AddTranslateOp().Set((0, 5, 0))
    inner.AddRotateZOp().Set(90)
    inner.AddScaleOp().Set((2, 2, 2))
    add_mesh(stage, "/g/inner/a", at=(1, 0, 0))
    free = add_mesh(stage, "/g/inner/b", at=(1, 0, 0))
    UsdGeom.Xformable(free).SetResetXformStack(True)
    scene = saved(stage)
    np.testing.assert_allclose(center(scene, 0), [10, 7, 0], atol=1e-12)
    np.testing.assert_allclose(center(scene, 1), [1, 0, 0], atol=1e-12)
    assert volume(scene, 0) == pytest.approx(8)


def test_inverse_ops_are_applied(stage):
    mesh = add_mesh(stage, "/a")
    pivot = mesh.AddTranslateOp(opSuffix="pivot")
    pivot.Set((1, 0, 0))
    mesh.AddRotateZOp().Set(180)
    mesh.AddTranslateOp(opSuffix="pivot", isInverseOp=True)
    np.testing.assert_allclose(center(saved(stage)), [2, 0, 0], atol=1e-12)


@pytest.mark.parametrize("left_handed", [False, True])
@pytest.mark.parametrize("scale", [(1, 1, 1), (-1, 1, 1), (-1, -1, 1), (-2, -1, -3)])
def test_faces_stay_outward_under_mirroring_and_left_handedness(stage, scale, left_handed):
    mesh = add_mesh(stage, "/a", faces=QUADS[:, ::-1] if left_handed else QUADS)
    UsdGeom.XformCommonAPI(mesh).SetScale(scale)
    if left_handed:
        mesh.CreateOrientationAttr("leftHanded")
    assert volume(saved(stage)) == pytest.approx(abs(np.prod(scale)))


def test_collapsed_mesh_is_left_out_and_flat_one_kept(stage):
    UsdGeom.XformCommonAPI(add_mesh(stage, "/line")).SetScale((1, 0, 0))
    UsdGeom.XformCommonAPI(add_mesh(stage, "/flat")).SetScale((1, 1, 0))
    scene = saved(stage)
    assert scene.paths == ("/flat",)
    assert [n.meshes for n in scene.diagnostics if n.code == "degenerate-mesh"] == [("/line",)]
    assert [n.meshes for n in scene.diagnostics if n.code == "flat-transform"] == [("/flat",)]


def test_a_sheet_without_depth_of_its_own_loses_none(stage):
    square = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    UsdGeom.XformCommonAPI(add_mesh(stage, "/sheet", square, [[0, 1, 2, 3]])).SetScale((1, 1, 0))
    assert "flat-transform" not in [n.code for n in saved(stage).diagnostics]


def test_a_scene_that_a_scale_of_zero_presses_flat_is_told_and_refused_where_nothing_may_be_lost(stage):
    root = UsdGeom.Xform.Define(stage, "/root")
    UsdGeom.XformCommonAPI(root).SetScale((1, 1, 0))
    for name in ("box", "sheet", "rod"):
        UsdGeom.Cube.Define(stage, f"/root/{name}")
    UsdGeom.XformCommonAPI(UsdGeom.Xformable(stage.GetPrimAtPath("/root/sheet"))).SetScale((1, 1, 1e-4))
    UsdGeom.Cube.Define(stage, "/wire")
    UsdGeom.XformCommonAPI(UsdGeom.Xformable(stage.GetPrimAtPath("/wire"))).SetScale((1e-4, 1e-4, 1))
    scene = saved(stage)
    assert [n.meshes for n in scene.diagnostics if n.code == "flat-transform"] == [
        ("/root/box", "/root/rod", "/root/sheet")
    ]
    with pytest.raises(LoadError, match="presses it flat"):
        refuse_losses(scene, "a.usda")


def test_a_placement_with_a_perspective_is_placed_without_and_told(stage):
    rows = Gf.Matrix4d(2, 0, 0, 0.5, 0, 2, 0, 0, 0, 0, 2, 0, 4, 0, 0, 2)
    add_mesh(stage, "/a").AddTransformOp().Set(rows)
    add_mesh(stage, "/b").AddTranslateOp().Set((2, 0, 0))
    scene = saved(stage)
    assert [n.meshes for n in scene.diagnostics if n.code == "projective-transform"] == [("/a",)]
    np.testing.assert_allclose(scene.mesh(0)[0], scene.mesh(1)[0])


def test_a_shape_of_negative_size_is_told(stage):
    add_mesh(stage, "/a")
    UsdGeom.Cylinder.Define(stage, "/b").CreateHeightAttr(-2.0)
    scene = saved(stage)
    assert scene.paths == ("/a",)
    [note] = [n for n in scene.diagnostics if n.code == "invalid-size"]
    assert note.meshes == ("/b",)
    assert "height -2.0" in note.message


def test_placement_that_is_not_finite_is_left_out(stage):
    add_mesh(stage, "/a")
    add_mesh(stage, "/b").AddTranslateOp().Set((float("nan"), 0, 0))
    scene = saved(stage)
    assert scene.paths == ("/a",)
    assert "invalid-transform" in codes(scene)


# --- faces


def test_polygons_of_any_size_become_triangles(stage):
    outline = [[0, 0, 0], [3, 0, 0], [3, 3, 0], [2, 3, 0], [2, 1, 0], [1, 1, 0], [1, 3, 0], [0, 3, 0]]
    add_mesh(stage, "/u", outline, [range(8)])
    vertices, faces = saved(stage).mesh(0)
    normals = np.cross(vertices[faces[:, 1]] - vertices[faces[:, 0]], vertices[faces[:, 2]] - vertices[faces[:, 0]])
    assert len(faces) == 6
    assert (normals[:, 2] > 0).all()
    assert normals[:, 2].sum() / 2 == pytest.approx(7)


def test_hole_faces_are_open(stage):
    add_mesh(stage, "/a").CreateHoleIndicesAttr([0, 5, 99])
    assert saved(stage).n_triangles == 8


def test_unused_points_are_dropped(stage):
    add_mesh(stage, "/a", [*box()[0], [99, 99, 99]])
    assert len(saved(stage).vertices) == 8


def test_subdivision_mesh_loads_its_cage_and_says_so_once(stage):
    add_mesh(stage, "/a", scheme="catmullClark")
    add_mesh(stage, "/b", scheme="loop", at=(3, 0, 0))
    notes = [n for n in saved(stage).diagnostics if n.code == "control-cage"]
    assert [n.meshes for n in notes] == [("/a", "/b")]


def test_nan_points_cost_only_their_faces(stage):
    points = box()[0].copy()
    points[7] = np.nan
    add_mesh(stage, "/a", points)
    add_mesh(stage, "/b", np.full((8, 3), np.inf))
    scene = saved(stage)
    assert scene.paths == ("/a",)
    assert scene.n_triangles == 6
    assert np.isfinite(scene.vertices).all()
    assert {"invalid-points", "empty-mesh"} <= codes(scene)


def test_indices_out_of_range_cost_only_their_faces(stage):
    add_mesh(stage, "/a", faces=[*QUADS, [0, 1, 8], [0, -1, 2]])
    scene = saved(stage)
    assert scene.n_triangles == 12
    assert "invalid-indices" in codes(scene)


@pytest.mark.parametrize("counts", [[4] * 7, [4] * 5, [4, 4, -1, 4], [4, 4, 4, 4, 4, 2, 2], [4] * 6 + [10**9]])
def test_bad_face_counts_are_noted_and_whole_faces_kept(stage, counts):
    add_mesh(stage, "/a").GetFaceVertexCountsAttr().Set(counts)
    scene = saved(stage)
    assert 4 <= scene.n_triangles <= 12
    assert "invalid-face-counts" in codes(scene)


@pytest.mark.parametrize("missing", ["points", "faceVertexCounts", "faceVertexIndices"])
def test_mesh_without_geometry_is_left_out_and_named(stage, missing):
    add_mesh(stage, "/a")
    add_mesh(stage, "/empty").GetPrim().RemoveProperty(missing)
    scene = saved(stage)
    assert scene.paths == ("/a",)
    assert [n.meshes for n in scene.diagnostics if n.code == "empty-mesh"] == [("/empty",)]


def test_other_geometry_is_left_out_and_named(stage):
    add_mesh(stage, "/a")
    UsdGeom.BasisCurves.Define(stage, "/curve")
    notes = [n for n in saved(stage).diagnostics if n.code == "unsupported-geometry"]
    assert notes[0].meshes == ("/curve",)


# --- order, names, what counts


def test_order_is_natural_and_does_not_depend_on_the_file(stage):
    for name in ("mesh_10", "mesh_2", "mesh_1", "Mesh_3"):
        add_mesh(stage, f"/w/{name}")
    assert saved(stage).paths == ("/w/Mesh_3", "/w/mesh_1", "/w/mesh_2", "/w/mesh_10")


def test_loading_twice_gives_the_same_bytes(stage):
    add_mesh(stage, "/a")
    UsdGeom.Sphere.Define(stage, "/s")
    first, second = saved(stage), saved(stage)
    assert first.vertices.tobytes() == second.vertices.tobytes()
    assert first.faces.tobytes() == second.faces.tobytes()
    assert first.diagnostics == second.diagnostics


def test_inactive_class_and_over_are_not_loaded(stage):
    add_mesh(stage, "/a")
    add_mesh(stage, "/off").GetPrim().SetActive(False)
    stage.CreateClassPrim("/_class")
    add_mesh(stage, "/_class/m")
    add_mesh(stage, "/over/m")
    stage.GetPrimAtPath("/over").SetSpecifier(Sdf.SpecifierOver)
    assert saved(stage).paths == ("/a",)


def test_purposes_are_as_asked_and_inherited(stage):
    for purpose in ("default", "render", "proxy", "guide"):
        UsdGeom.Xform.Define(stage, f"/{purpose}").CreatePurposeAttr(purpose)
        add_mesh(stage, f"/{purpose}/m")
    scene = saved(stage)
    assert scene.paths == ("/default/m", "/render/m")
    assert {n.meshes for n in scene.diagnostics if n.code == "other-purpose"} == {("/proxy/m",), ("/guide/m",)}
    assert saved(stage, purposes=("proxy",)).paths == ("/proxy/m",)


def test_hidden_is_left_out_unless_asked_for(stage):
    UsdGeom.Xform.Define(stage, "/g").MakeInvisible()
    add_mesh(stage, "/g/m")
    add_mesh(stage, "/a")
    scene = saved(stage)
    assert scene.paths == ("/a",)
    assert [n.meshes for n in scene.diagnostics if n.code == "hidden"] == [("/g/m",)]
    assert saved(stage, invisible=True).paths == ("/a", "/g/m")


def test_variant_is_as_selected(stage):
    prim = UsdGeom.Xform.Define(stage, "/v").GetPrim()
    variants = prim.GetVariantSets().AddVariantSet("size")
    for name, edge in (("small", 1), ("large", 5)):
        variants.AddVariant(name)
        variants.SetVariantSelection(name)
        with variants.GetVariantEditContext():
            UsdGeom.Cube.Define(stage, "/v/c").CreateSizeAttr(edge)
    variants.SetVariantSelection("small")
    np.testing.assert_allclose(size(saved(stage)), 1)


def test_time_is_as_asked_else_default_else_first_sample(stage):
    sampled = UsdGeom.Xformable(add_mesh(stage, "/a")).AddTranslateOp()
    sampled.Set((1, 0, 0), 5)
    sampled.Set((2, 0, 0), 9)
    both = UsdGeom.Xformable(add_mesh(stage, "/b")).AddTranslateOp()
    both.Set((7, 0, 0))
    both.Set((8, 0, 0), 5)
    points = add_mesh(stage, "/c").GetPointsAttr()
    values = points.Get()
    points.Clear()
    points.Set(values, 3)
    single = UsdGeom.Cube.Define(stage, "/d").GetSizeAttr()
    single.Set(6.0, 3)
    scene = saved(stage)
    assert [center(scene, i)[0] for i in range(3)] == [1, 7, 0]
    np.testing.assert_allclose(size(scene, 3), 6)
    assert [center(saved(stage, time=9.0), i)[0] for i in range(2)] == [2, 8]


def test_samples_of_a_value_clip_count(tmp_path, stage):
    clip = Usd.Stage.CreateNew(str(tmp_path / "clip.usda"))
    UsdGeom.Xformable(clip.DefinePrim("/m", "Mesh")).AddTranslateOp().Set((3, 0, 0), 0)
    clip.Save()
    manifest = Usd.Stage.CreateNew(str(tmp_path / "manifest.usda"))
    UsdGeom.Xformable(manifest.DefinePrim("/m", "Mesh")).AddTranslateOp()
    manifest.Save()
    add_mesh(stage, "/group/m").AddTranslateOp()
    clips = Usd.ClipsAPI(stage.GetPrimAtPath("/group/m"))
    clips.SetClipAssetPaths([Sdf.AssetPath("./clip.usda")])
    clips.SetClipPrimPath("/m")
    clips.SetClipActive([(0, 0)])
    clips.SetClipManifestAssetPath(Sdf.AssetPath("./manifest.usda"))
    assert center(saved(stage))[0] == 3


# --- composition


def asset(tmp_path, name="part.usda"):
    stage = Usd.Stage.CreateNew(str(tmp_path / name))
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/part").GetPrim())
    add_mesh(stage, "/part/body")
    add_mesh(stage, "/part/lid", at=(0, 0, 1))
    stage.Save()
    return f"./{name}"


def test_instances_have_their_proxy_paths_and_their_root_as_anchor(stage, tmp_path):
    part = asset(tmp_path)
    middle = Usd.Stage.CreateNew(str(tmp_path / "middle.usda"))
    middle.SetDefaultPrim(UsdGeom.Xform.Define(middle, "/middle").GetPrim())
    for i in range(2):
        inner = UsdGeom.Xform.Define(middle, f"/middle/p{i}")
        UsdGeom.XformCommonAPI(inner).SetTranslate((0, 10 * i, 0))
        inner.GetPrim().GetReferences().AddReference(part)
        inner.GetPrim().SetInstanceable(True)
    middle.Save()
    for i in range(2):
        outer = UsdGeom.Xform.Define(stage, f"/w/m{i}")
        UsdGeom.XformCommonAPI(outer).SetTranslate((100 * i, 0, 0))
        outer.GetPrim().GetReferences().AddReference("./middle.usda")
        outer.GetPrim().SetInstanceable(True)
    scene = saved(stage)
    assert scene.paths == tuple(f"/w/m{i}/p{j}/{name}" for i in "01" for j in "01" for name in ("body", "lid"))
    assert scene.anchors == ("/w/m0",) * 4 + ("/w/m1",) * 4
    np.testing.assert_allclose(center(scene, 7), [100, 10, 1])


def test_payloads_are_loaded_and_missing_files_are_named(stage, tmp_path):
    stage.DefinePrim("/here").GetPayloads().AddPayload(asset(tmp_path))
    stage.DefinePrim("/gone").GetPayloads().AddPayload("./gone.usda")
    stage.DefinePrim("/lost").GetReferences().AddReference("./lost.usda")
    stage.DefinePrim("/astray").GetReferences().AddReference("./part.usda", "/nowhere")
    stage.GetRootLayer().subLayerPaths.append("./absent.usda")
    scene = saved(stage)
    assert scene.paths == ("/here/body", "/here/lid")
    found = {(n.code, n.meshes) for n in scene.diagnostics}
    assert {
        ("missing-payload", ("/gone",)),
        ("missing-reference", ("/lost",)),
        ("missing-reference", ("/astray",)),
        ("missing-layer", ()),
    } <= found
    assert not any(str(tmp_path) in n.message or "0x" in n.message for n in scene.diagnostics)


@pytest.mark.parametrize("meters", [1e-10, 1e6])
def test_units_at_their_limits_are_taken_and_an_unusual_size_is_told(stage, meters):
    UsdGeom.SetStageMetersPerUnit(stage, meters)
    add_mesh(stage, "/a")
    scene = saved(stage)
    assert scene.source.meters_per_unit == meters
    assert codes(scene) == {"unusual-size"}


def test_meshes_beyond_all_measure_are_left_out_and_named(stage):
    add_mesh(stage, "/a")
    add_mesh(stage, "/near", at=(0.99e9, 0, 0))
    add_mesh(stage, "/far", points=box()[0] * 1e30)
    add_mesh(stage, "/shifted", at=(-1e300, 0, 0))
    scene = saved(stage)
    assert scene.paths == ("/a", "/near")
    assert ("too-far", ("/far", "/shifted")) in {(n.code, n.meshes) for n in scene.diagnostics}


def test_a_scene_beyond_all_measure_is_one_line(stage):
    add_mesh(stage, "/a", points=box()[0] * 1e30)
    with pytest.raises(LoadError, match=r"no mesh to load: 1 farther than .* \(check metersPerUnit\)"):
        saved(stage)


def test_a_file_that_is_there_but_no_usd_is_not_called_missing(stage, tmp_path):
    add_mesh(stage, "/a")
    (tmp_path / "words.usd").write_text("just words\n")
    (tmp_path / "bare.usda").write_text('#usda 1.0\ndef Cube "x" {}\n')
    stage.DefinePrim("/words").GetReferences().AddReference("./words.usd")
    stage.DefinePrim("/bare").GetReferences().AddReference("./bare.usda")
    told = {n.meshes: n.message for n in saved(stage).diagnostics}
    assert told["/words",] == "'words.usd' is there, but can't be read as USD; export it again"
    assert told["/bare",] == "'bare.usda' names no defaultPrim; set it there, or name a prim in the reference"


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
@pytest.mark.parametrize(
    "text",
    [
        "( subLayers = [@./pipe.usda@] )",
        'def "b" ( references = @./pipe.usda@ ) {}',
        'def "b" ( payload = @./pipe.usda@</x> ) {}',
        'def "b" ( references = @./part.usda@</x> ) {}',
        'def "b" ( variants = {string v = "one"}\nprepend variantSets = "v" )\n'
        '{\nvariantSet "v" = { "one" ( references = @./pipe.usda@ ) {} }\n}',
    ],
)
def test_a_named_pipe_below_the_scene_is_refused_at_once(tmp_path, text):
    os.mkfifo(tmp_path / "pipe.usda")
    (tmp_path / "part.usda").write_text('#usda 1.0\ndef "x" ( references = @./pipe.usda@ ) {}\n')
    (tmp_path / "scene.usda").write_text(f"#usda 1.0\n{text}\n")
    with pytest.raises(LoadError, match=r"scene\.usda: refers to '\./pipe\.usda', which is .* a named pipe; put"):
        load(tmp_path / "scene.usda", IN_PROCESS.model_copy(update={"timeout": 20, "isolate": True}))


def test_library_warnings_stay_off_the_terminal(stage, tmp_path, capfd):
    add_mesh(stage, "/a")
    stage.DefinePrim("/lost").GetReferences().AddReference("./lost.usda")
    stage.Save()
    capfd.readouterr()
    path = stage.GetRootLayer().realPath
    del stage
    load(path, IN_PROCESS)
    assert capfd.readouterr() == ("", "")


def test_usdz_package(stage, tmp_path):
    from pxr import UsdUtils

    add_mesh(stage, "/a")
    stage.Save()
    package = tmp_path / "scene.usdz"
    assert UsdUtils.CreateNewUsdzPackage(stage.GetRootLayer().realPath, str(package))
    assert load(package, IN_PROCESS).paths == ("/a",)


# --- point instancers


def add_instancer(stage, path, indices, prototypes, positions=None):
    instancer = UsdGeom.PointInstancer.Define(stage, path)
    instancer.CreateProtoIndicesAttr(indices)
    instancer.CreatePositionsAttr(positions or [(10 * i, 0, 0) for i in range(len(indices))])
    instancer.CreatePrototypesRel().SetTargets([Sdf.Path(p) for p in prototypes])
    return instancer


def test_point_instancer_items_have_indexed_paths(stage):
    instancer = add_instancer(stage, "/i", [0, 1, 0], ["/i/protos/one", "/i/protos/two"])
    UsdGeom.XformCommonAPI(add_mesh(stage, "/i/protos/one")).SetTranslate((0, 0, 5))
    UsdGeom.Xform.Define(stage, "/i/protos/two")
    add_mesh(stage, "/i/protos/two/a")
    add_mesh(stage, "/i/protos/two/b/c", at=(0, 3, 0))
    instancer.CreateOrientationsAttr(
        [Gf.Quath(1, 0, 0, 0), Gf.Quath(0.70710678, 0, 0, 0.70710678), Gf.Quath(1, 0, 0, 0)]
    )
    instancer.CreateScalesAttr([(1, 1, 1), (1, 1, 1), (-2, 1, 1)])
    UsdGeom.XformCommonAPI(instancer).SetTranslate((0, 0, 100))
    scene = saved(stage)
    assert scene.paths == ("/i[0]", "/i[1]/a", "/i[1]/b/c", "/i[2]")
    assert set(scene.anchors) == {"/i"}
    np.testing.assert_allclose(center(scene, 0), [0, 0, 105])
    np.testing.assert_allclose(center(scene, 2), [7, 0, 100], atol=1e-2)
    np.testing.assert_allclose(size(scene, 3), [2, 1, 1], atol=1e-2)
    assert volume(scene, 3) == pytest.approx(2)


def test_point_instancer_agrees_with_the_library(stage):
    instancer = add_instancer(stage, "/i", [0] * 5, ["/i/p"], [(i, 2 * i, -i) for i in range(5)])
    UsdGeom.XformCommonAPI(add_mesh(stage, "/i/p")).SetRotate((10, 20, 30))
    turns = [Gf.Quatf(*q) for q in np.random.default_rng(0).normal(size=(5, 4)).tolist()]
    instancer.CreateOrientationsfAttr([q.GetNormalized() for q in turns])
    instancer.CreateScalesAttr([(1, 2, 3)] * 5)
    scene = saved(stage)
    expected = instancer.ComputeInstanceTransformsAtTime(Usd.TimeCode.EarliestTime(), Usd.TimeCode.EarliestTime())
    for i, matrix in enumerate(expected):
        points = np.array([matrix.Transform(Gf.Vec3d(*p)) for p in box()[0].tolist()])
        np.testing.assert_allclose(scene.mesh(i)[0], points, atol=1e-5)


def test_point_instancer_hides_items_by_id(stage):
    instancer = add_instancer(stage, "/i", [0, 0, 0], ["/i/p"])
    add_mesh(stage, "/i/p")
    instancer.CreateIdsAttr([7, 8, 9])
    instancer.CreateInvisibleIdsAttr([8])
    instancer.DeactivateId(9)
    assert saved(stage).paths == ("/i[0]",)
    assert saved(stage, invisible=True).paths == ("/i[0]", "/i[1]")


def test_nested_point_instancers(stage):
    inner = add_instancer(stage, "/i/p/inner", [0, 0], ["/i/p/inner/q"])
    add_mesh(stage, "/i/p/inner/q")
    UsdGeom.Xform.Define(stage, "/i/p")
    add_instancer(stage, "/i", [0, 0], ["/i/p"], [(0, 0, 0), (0, 50, 0)])
    assert inner
    scene = saved(stage)
    assert scene.paths == ("/i[0]/inner[0]", "/i[0]/inner[1]", "/i[1]/inner[0]", "/i[1]/inner[1]")
    np.testing.assert_allclose(center(scene, 3), [10, 50, 0])


def test_prototypes_under_an_over_are_found(stage):
    add_instancer(stage, "/i", [0], ["/i/protos/p"])
    stage.OverridePrim("/i/protos")
    add_mesh(stage, "/i/protos/p")
    stage.GetPrimAtPath("/i/protos").SetSpecifier(Sdf.SpecifierOver)
    assert saved(stage).paths == ("/i[0]",)


def test_point_instancer_inside_an_instance(stage, tmp_path):
    part = Usd.Stage.CreateNew(str(tmp_path / "part.usda"))
    part.SetDefaultPrim(UsdGeom.Xform.Define(part, "/part").GetPrim())
    add_instancer(part, "/part/i", [0, 0], ["/part/i/p"])
    add_mesh(part, "/part/i/p")
    part.Save()
    for i in range(2):
        prim = stage.DefinePrim(f"/w{i}", "Xform")
        prim.GetReferences().AddReference("./part.usda")
        prim.SetInstanceable(True)
    scene = saved(stage)
    assert scene.paths == ("/w0/i[0]", "/w0/i[1]", "/w1/i[0]", "/w1/i[1]")
    assert scene.anchors == ("/w0", "/w0", "/w1", "/w1")


def test_broken_point_instancers_are_noted(stage):
    add_mesh(stage, "/a")
    add_instancer(stage, "/self", [0], ["/self/p"])
    UsdGeom.Xform.Define(stage, "/self/p")
    add_instancer(stage, "/self/p/again", [0], ["/self"])
    add_instancer(stage, "/wrong", [0, 5, 0], ["/wrong/p"], [(0, 0, 0), (3, 0, 0)])
    add_mesh(stage, "/wrong/p")
    add_instancer(stage, "/lost", [0], ["/nowhere"])
    scene = saved(stage)
    assert scene.paths == ("/a", "/wrong[0]")
    assert {"invalid-instancer", "missing-prototype"} <= codes(scene)


# --- subsets and colours


def material(stage, path, color, name="diffuseColor", kind="UsdPreviewSurface"):
    bound = UsdShade.Material.Define(stage, path)
    shader = UsdShade.Shader.Define(stage, f"{path}/shader")
    shader.CreateIdAttr(kind)
    shader.CreateInput(name, Sdf.ValueTypeNames.Color3f).Set(color)
    context = "mdl" if name == "diffuse_color_constant" else ""
    output = bound.CreateSurfaceOutput(context) if context else bound.CreateSurfaceOutput()
    output.ConnectToSource(shader.ConnectableAPI(), "surface")
    return bound


def with_subsets(stage):
    mesh = add_mesh(stage, "/m", box((1, 1, 2))[0])
    red, blue = material(stage, "/red", (1, 0, 0)), material(stage, "/blue", (0, 0, 1))
    for name, faces, bound in (("ends", [0, 1], red), ("side", [2], blue)):
        subset = UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).CreateMaterialBindSubset(name, faces)
        UsdShade.MaterialBindingAPI.Apply(subset.GetPrim()).Bind(bound)
    return mesh


def test_subsets_split_a_mesh_when_asked_for(stage):
    with_subsets(stage)
    scene = saved(stage, split_subsets=True)
    assert scene.paths == ("/m", "/m/ends", "/m/side")
    assert np.diff(scene.face_offsets).tolist() == [6, 4, 2]
    np.testing.assert_allclose(scene.colors[1:], [[1, 0, 0], [0, 0, 1]])
    assert np.isnan(scene.colors[0]).all()


def test_subset_colours_are_averaged_by_area_when_not_split(stage):
    with_subsets(stage)
    scene = saved(stage)
    assert scene.paths == ("/m",)
    np.testing.assert_allclose(scene.colors[0], [2 / 3, 0, 1 / 3], atol=1e-6)


def test_overlapping_subsets_give_each_face_once(stage):
    mesh = with_subsets(stage)
    UsdGeom.Subset(stage.GetPrimAtPath("/m/side")).GetIndicesAttr().Set([1, 2])
    scene = saved(stage, split_subsets=True)
    assert mesh
    assert np.diff(scene.face_offsets).tolist() == [6, 4, 2]
    assert "overlapping-subsets" in codes(scene)


def test_constant_display_colour_is_inherited(stage):
    group = UsdGeom.Xform.Define(stage, "/g")
    UsdGeom.PrimvarsAPI(group).CreatePrimvar("displayColor", Sdf.ValueTypeNames.Color3fArray).Set([(0.1, 0.2, 0.3)])
    add_mesh(stage, "/g/a")
    add_mesh(stage, "/g/b").CreateDisplayColorAttr([(0.9, 0.8, 0.7)])
    scene = saved(stage)
    np.testing.assert_allclose(scene.colors, [[0.1, 0.2, 0.3], [0.9, 0.8, 0.7]])


@pytest.mark.parametrize(("interpolation", "n"), [("uniform", 6), ("vertex", 8), ("varying", 8), ("faceVarying", 24)])
def test_varying_display_colour_is_averaged(stage, interpolation, n):
    mesh = add_mesh(stage, "/m")
    mesh.CreateDisplayColorPrimvar(interpolation).Set([(i % 2, 0.5, 1) for i in range(n)])
    np.testing.assert_allclose(saved(stage).colors[0], [0.5, 0.5, 1], atol=1e-6)


def test_indexed_display_colour(stage):
    primvar = add_mesh(stage, "/m").CreateDisplayColorPrimvar("uniform")
    primvar.Set([(1, 0, 0), (0, 1, 0)])
    primvar.SetIndices([0, 0, 0, 0, 0, 1])
    np.testing.assert_allclose(saved(stage).colors[0], [5 / 6, 1 / 6, 0], atol=1e-6)


@pytest.mark.parametrize("name", ["diffuseColor", "base_color", "diffuse_color_constant"])
@pytest.mark.parametrize("applied", [True, False])
def test_material_gives_the_colour_and_outranks_display_colour(stage, name, applied):
    bound = material(stage, "/mat", (0.25, 0.5, 0.75), name)
    mesh = add_mesh(stage, "/m")
    mesh.CreateDisplayColorAttr([(1, 1, 1)])
    if applied:
        UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(bound)
    else:
        mesh.GetPrim().CreateRelationship("material:binding").SetTargets([bound.GetPath()])
    np.testing.assert_allclose(saved(stage).colors[0], [0.25, 0.5, 0.75])


def test_textured_material_leaves_display_colour(stage):
    bound = material(stage, "/mat", (0.25, 0.5, 0.75))
    texture = UsdShade.Shader.Define(stage, "/mat/texture")
    UsdShade.Shader(stage.GetPrimAtPath("/mat/shader")).GetInput("diffuseColor").ConnectToSource(
        texture.ConnectableAPI(), "rgb"
    )
    mesh = add_mesh(stage, "/m")
    mesh.CreateDisplayColorAttr([(1, 0, 0)])
    UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(bound)
    np.testing.assert_allclose(saved(stage).colors[0], [1, 0, 0])


# --- nothing to load


def test_stage_without_meshes_is_an_error_that_says_what_was_found(stage):
    add_mesh(stage, "/a").MakeInvisible()
    add_mesh(stage, "/b").CreatePurposeAttr("proxy")
    stage.DefinePrim("/lost").GetReferences().AddReference("./lost.usda")
    with pytest.raises(LoadError) as caught:
        saved(stage)
    text = str(caught.value)
    assert "1 hidden" in text
    assert "load.purposes" in text
    assert "lost.usda" in text
    assert "\n" not in text


def test_empty_stage_is_an_error(stage):
    with pytest.raises(LoadError, match="holds no mesh"):
        saved(stage)
