"""What stands below native instances is read once; the meshes are those of a walk through each of them."""

import numpy as np
import pytest
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade

from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load
from cadgraph.load.usd_walk import Walk


def tetrahedron(stage, path, rng):
    mesh = UsdGeom.Mesh.Define(stage, path)
    mesh.CreatePointsAttr([tuple(map(float, point)) for point in rng.uniform(0, 1, (4, 3))])
    mesh.CreateFaceVertexCountsAttr([3] * 4)
    mesh.CreateFaceVertexIndicesAttr([0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3])
    return mesh.GetPrim()


def decorate(stage, prim, rng, materials):
    """Some of what a prim hands down, or has for itself."""
    if rng.random() < 0.6:
        move = UsdGeom.Xformable(prim).AddTransformOp()
        turn = Gf.Rotation(Gf.Vec3d(*rng.normal(size=3)), float(rng.uniform(0, 360)))
        move.Set(Gf.Matrix4d(turn, Gf.Vec3d(*rng.uniform(-5, 5, 3))))
        if rng.random() < 0.15:
            UsdGeom.Xformable(prim).SetResetXformStack(True)
    if rng.random() < 0.15:
        UsdGeom.Imageable(prim).MakeInvisible()
    if rng.random() < 0.15:
        UsdGeom.Imageable(prim).CreatePurposeAttr(str(rng.choice(["render", "guide", "proxy"])))
    if rng.random() < 0.3:
        colors = rng.uniform(0, 1, (4 if prim.IsA(UsdGeom.Mesh) and rng.random() < 0.5 else 1, 3))
        color = UsdGeom.PrimvarsAPI(prim).CreatePrimvar("displayColor", Sdf.ValueTypeNames.Color3fArray)
        color.SetInterpolation("vertex" if len(colors) > 1 else "constant")
        color.Set([tuple(map(float, row)) for row in colors])
    if rng.random() < 0.2:
        UsdShade.MaterialBindingAPI.Apply(prim).Bind(materials[int(rng.integers(len(materials)))])


def furnish(stage, root, rng, materials, known, depth=0):
    """Transforms, meshes, instances of what is known and point instancers below a prim."""
    for number in range(int(rng.integers(1, 4))):
        path, what = root.AppendChild(f"p{number}"), rng.random()
        if what < 0.4:
            prim = tetrahedron(stage, path, rng)
        elif what < 0.65 and known:
            prim = UsdGeom.Xform.Define(stage, path).GetPrim()
            prim.GetReferences().AddInternalReference(known[int(rng.integers(len(known)))])
            prim.SetInstanceable(bool(rng.random() < 0.8))
        elif what < 0.7 and known:
            instancer = UsdGeom.PointInstancer.Define(stage, path)
            instancer.CreatePrototypesRel().AddTarget(known[0])
            instancer.CreateProtoIndicesAttr([0, 0])
            instancer.CreatePositionsAttr([(0, 0, 0), (3, 0, 0)])
            prim = instancer.GetPrim()
        else:
            prim = UsdGeom.Xform.Define(stage, path).GetPrim()
            if depth < 2:
                furnish(stage, path, rng, materials, known, depth + 1)
        decorate(stage, prim, rng, materials)


def write(file, seed):
    rng = np.random.default_rng(seed)
    stage = Usd.Stage.CreateNew(str(file))
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    UsdGeom.SetStageUpAxis(stage, "Z")
    materials = []
    for number in range(3):
        material = UsdShade.Material.Define(stage, f"/Looks/m{number}")
        shader = UsdShade.Shader.Define(stage, f"/Looks/m{number}/s")
        shader.CreateIdAttr("UsdPreviewSurface")
        color = shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f)
        color.Set(Gf.Vec3f(*map(float, rng.uniform(0, 1, 3))))
        material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
        materials.append(material)
    known = []
    for number in range(4):
        path = Sdf.Path(f"/Shapes/s{number}")
        UsdGeom.Xform.Define(stage, path)
        # Each may hold instances of those before it.
        furnish(stage, path, rng, materials, known)
        known.append(path)
    tetrahedron(stage, "/Plant/always", rng)
    for number in range(6):
        path = Sdf.Path(f"/Plant/p{number}")
        UsdGeom.Xform.Define(stage, path)
        furnish(stage, path, rng, materials, known)
    stage.GetRootLayer().Save()


def loaded(file, **settings):
    try:
        return load(file, LoadConfig(isolate=False, **settings))
    except LoadError as error:
        return str(error)


@pytest.mark.parametrize("seed", range(40))
def test_meshes_are_those_of_a_walk_through_every_instance(tmp_path, monkeypatch, seed):
    file = tmp_path / "plant.usda"
    write(file, seed)
    settings = [{}, {"invisible": True}, {"purposes": ("default", "render", "guide")}]
    once = [loaded(file, **each) for each in settings]
    monkeypatch.setattr(Walk, "_inner", lambda *_: None)
    for scene, each in zip(once, settings, strict=True):
        walked = loaded(file, **each)
        assert scene.paths == walked.paths
        assert scene.anchors == walked.anchors
        assert scene.diagnostics == walked.diagnostics
        np.testing.assert_array_equal(scene.vertices, walked.vertices)
        np.testing.assert_array_equal(scene.colors, walked.colors)


def test_what_is_below_an_instance_is_asked_once_for_all_that_share_it(tmp_path, monkeypatch):
    file = tmp_path / "plant.usda"
    stage = Usd.Stage.CreateNew(str(file))
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    UsdGeom.Xform.Define(stage, "/Shapes/s")
    tetrahedron(stage, "/Shapes/s/body", np.random.default_rng(0))
    for number in range(50):
        prim = UsdGeom.Xform.Define(stage, f"/Plant/p{number}").GetPrim()
        prim.GetReferences().AddInternalReference("/Shapes/s")
        prim.SetInstanceable(True)
    stage.GetRootLayer().Save()
    asked = []
    own = Walk._own
    monkeypatch.setattr(Walk, "_own", lambda walk, prim: asked.append(str(prim.GetPath())) or own(walk, prim))
    assert load(file, LoadConfig(isolate=False)).n_meshes == 51
    below = [path for path in asked if path.startswith("/Plant/") and path.endswith("/body")]
    assert len(below) == 1
