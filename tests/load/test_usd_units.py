import pytest
from pxr import Gf, Usd, UsdGeom

from cadgraph.config import LoadConfig
from cadgraph.load import load
from shapes import box

IN_PROCESS = LoadConfig(isolate=False)


def layer(path, unit=None, up="Z"):
    stage = Usd.Stage.CreateNew(str(path))
    if unit is not None:
        UsdGeom.SetStageMetersPerUnit(stage, unit)
    if up is not None:
        UsdGeom.SetStageUpAxis(stage, up)
    return stage


def add_box(stage, path):
    points, faces = box()
    mesh = UsdGeom.Mesh.Define(stage, path)
    mesh.CreatePointsAttr([Gf.Vec3f(*map(float, point)) for point in points])
    mesh.CreateFaceVertexCountsAttr([3] * len(faces))
    mesh.CreateFaceVertexIndicesAttr([int(corner) for face in faces for corner in face])


def site(tmp_path, unit, asset_unit, *, up="Z", asset_up="Z", scale=None, turn=None, instanceable=False, payload=False):
    asset = layer(tmp_path / "valve.usda", asset_unit, asset_up)
    add_box(asset, "/Valve/body")
    asset.SetDefaultPrim(asset.GetPrimAtPath("/Valve"))
    asset.Save()
    stage = layer(tmp_path / "site.usda", unit, up)
    add_box(stage, "/own")
    prim = UsdGeom.Xform.Define(stage, "/valve")
    (prim.GetPrim().GetPayloads().AddPayload if payload else prim.GetPrim().GetReferences().AddReference)(
        "./valve.usda"
    )
    prim.GetPrim().SetInstanceable(instanceable)
    if scale is not None:
        prim.AddScaleOp().Set((scale, scale, scale))
    if turn is not None:
        prim.AddRotateXOp().Set(turn)
    stage.Save()
    return load(tmp_path / "site.usda", IN_PROCESS)


def noted(scene, code):
    return [note for note in scene.diagnostics if note.code == code]


@pytest.mark.parametrize("more", [{}, {"instanceable": True}, {"payload": True}])
def test_a_layer_in_other_units_is_told_with_both(tmp_path, more):
    [note] = noted(site(tmp_path, 0.001, 0.01, **more), "mixed-units")
    assert note.meshes == ("/valve",)
    for words in ("valve.usda is in units of 0.01 m", "site.usda", "0.001 m", "Scale it by 10 there"):
        assert words in note.message


@pytest.mark.parametrize(
    ("unit", "asset_unit", "scale"),
    [(0.001, 0.001, None), (0.001, 0.01, 10.0), (0.001, None, None), (None, 0.01, None)],
)
def test_layers_of_one_unit_or_scaled_to_it_are_fine(tmp_path, unit, asset_unit, scale):
    assert not noted(site(tmp_path, unit, asset_unit, scale=scale), "mixed-units")


def test_the_lengths_stay_as_they_stand(tmp_path):
    scene = site(tmp_path, 0.001, 0.01)
    sizes = [float((scene.mesh(i)[0].max(axis=0) - scene.mesh(i)[0].min(axis=0)).max()) for i in range(2)]
    assert sizes[0] == pytest.approx(sizes[1]) == pytest.approx(0.001)


def test_a_sublayer_in_other_units_is_told(tmp_path):
    below = layer(tmp_path / "below.usda", 1.0)
    add_box(below, "/a")
    below.Save()
    stage = layer(tmp_path / "site.usda", 0.01)
    stage.GetRootLayer().subLayerPaths.append("./below.usda")
    stage.Save()
    [note] = noted(load(tmp_path / "site.usda", IN_PROCESS), "mixed-units")
    assert "below.usda is in units of 1 m" in note.message
    assert "a sublayer" in note.message


def test_another_up_axis_is_told_unless_it_is_turned(tmp_path):
    [note] = noted(site(tmp_path, 1.0, 1.0, asset_up="Y"), "mixed-up-axis")
    assert note.meshes == ("/valve",)
    assert "up is Y in valve.usda, Z in site.usda" in note.message
    (tmp_path / "turned").mkdir()
    assert not noted(site(tmp_path / "turned", 1.0, 1.0, asset_up="Y", turn=90.0), "mixed-up-axis")


@pytest.mark.parametrize("more", [{"turn": -90.0}, {"scale": 2.0}])
def test_a_turn_or_a_scale_between_layers_that_agree_is_the_scenes_own(tmp_path, more):
    scene = site(tmp_path, 0.01, 0.01, up="Y", asset_up="Y", **more)
    assert noted(scene, "mixed-up-axis") == noted(scene, "mixed-units") == []
