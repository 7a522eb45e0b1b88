"""Real files: the few that travel with the tests, and more where a collection of them is present.

Counts are checked against the USD library; known sizes are as first loaded.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom

from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load

HERE = Path(__file__).parents[1] / "data"
DATA = Path(__file__).parents[2] / "../shared/data/usd"
# Collections keep their assets in folders beside those of their scenes.
IN_PROCESS = LoadConfig(isolate=False, asset_roots=("..", "../../../.."))
more = pytest.mark.skipif(not DATA.is_dir(), reason="no further real files here")

CONFORMANCE = [
    *sorted(path for path in (HERE / "usd").rglob("*.usd*")),
    *sorted(path for part in ("foundation", "schemaTests") for path in (DATA / part).rglob("*.usd*")),
]
# Reasons that are right: the collection lacks the layers that hold all geometry of some files.
NO_MESH = ("animated_cube_translation.usda", "axis.usda", "without a usable face", "framesPerSecond")


def volumes(scene):
    return [np.linalg.det(v[f]).sum() / 6 for v, f in (scene.mesh(i) for i in range(scene.n_meshes))]


def loaded(path):
    """The scene, or the text of the error."""
    try:
        return load(path, IN_PROCESS)
    except LoadError as error:
        return str(error)


@pytest.mark.parametrize("path", CONFORMANCE, ids=lambda path: path.name)
def test_every_conformance_file_loads_or_says_why_not(path):
    scene = loaded(path)
    if isinstance(scene, str):
        assert any(reason in scene for reason in NO_MESH)
        assert "\n" not in scene
        return
    assert np.isfinite(scene.vertices).all()
    assert scene.n_meshes == counted_by_the_library(path, scene)


def test_primitives_face_outward():
    assert min(volumes(loaded(HERE / "usd/all_primitives.usda"))) > 0


@pytest.mark.parametrize(
    ("name", "n", "extent"),
    [
        ("bolt", 1, (0.02771, 0.024, 0.08)),
        ("flange_slip_on", 1, (0.1499, 0.1499, 0.026)),
        ("lever_valve", 2, (0.02499, 0.05095, 0.1044)),
        ("water_tank", 21, (1.375, 1.022, 0.5235)),
    ],
)
def test_known_parts(name, n, extent):
    scene = load(HERE / f"parts/{name}.usdc", IN_PROCESS)
    assert scene.n_meshes == n
    np.testing.assert_allclose(np.ptp(scene.vertices, axis=0), extent, rtol=1e-3)


def counted_by_the_library(path, scene):
    stage = Usd.Stage.Open(str(path))
    left_out = {
        mesh for note in scene.diagnostics for mesh in note.meshes if note.code in ("empty-mesh", "other-purpose")
    }
    shown = Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies())
    return sum(bool(UsdGeom.Gprim(p)) and str(p.GetPath()) not in left_out for p in shown)


@more
@pytest.mark.parametrize(
    ("name", "n", "extent"),
    [
        ("McUsd/McUsd.usda", 23, (13, 13, 3)),
        ("McUsd/McUsd_10cm.usda", 23, (1.3, 1.3, 0.3)),
        ("teapot_scene/scenes/teapotScene.usd", 1000, (36.56, 36.45, 0.2983)),
        ("foundation/stage_configuration/metersPerUnit/metersPerUnit_10.usda", 1, (20, 20, 20)),
    ],
)
def test_known_scenes(name, n, extent):
    scene = load(DATA / name, IN_PROCESS)
    assert scene.n_meshes == n
    np.testing.assert_allclose(np.ptp(scene.vertices, axis=0), extent, rtol=1e-3)


@more
def test_teapots_are_instances_and_point_instances():
    scene = load(DATA / "teapot_scene/scenes/teapotScene.usd", IN_PROCESS)
    stage = Usd.Stage.Open(str(DATA / "teapot_scene/scenes/teapotScene.usd"))
    items = [UsdGeom.PointInstancer(prim).GetProtoIndicesAttr().Get() for prim in stage.Traverse()
             if prim.IsA(UsdGeom.PointInstancer)]  # fmt: skip
    assert sum("[" in path for path in scene.paths) == sum(map(len, items)) == 529
    assert scene.n_meshes - 529 == 471
    assert "/Scene/ring000/teapot000/geo/default/Body" in scene.paths
    assert scene.anchors[scene.paths.index("/Scene/ring000/teapot000/geo/default/Body")] == "/Scene/ring000/teapot000"
    assert {"missing-reference", "control-cage"} <= {note.code for note in scene.diagnostics}


@pytest.mark.parametrize(
    "name", sorted(p.relative_to(DATA).as_posix() for p in DATA.glob("USD_Mini*/assets/**/*.usd*"))
)
def test_car_kit_agrees_with_the_box_that_the_library_computes(name):
    scene = loaded(DATA / name)
    if isinstance(scene, str):
        assert "holds no mesh" in scene
        return
    stage = Usd.Stage.Open(str(DATA / name))
    box = Gf.Range3d()
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        mesh = UsdGeom.Mesh(prim)
        if mesh:
            matrix = mesh.ComputeLocalToWorldTransform(Usd.TimeCode.Default())
            for point in mesh.GetPointsAttr().Get() or []:
                box.UnionWith(matrix.Transform(Gf.Vec3d(point)))
    extent = np.array(box.GetSize()) * UsdGeom.GetStageMetersPerUnit(stage)
    if UsdGeom.GetStageUpAxis(stage) == "Y":
        extent = extent[[0, 2, 1]]
    np.testing.assert_allclose(np.ptp(scene.vertices, axis=0), extent, rtol=1e-5, atol=1e-9)
