import numpy as np
from pxr import Usd, UsdGeom, UsdPhysics, UsdShade

import graphs
import movable
from cadgraph.load import load
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import GraphDocument, Mechanism, Site, SourceRecord
from cadgraph.simulate.stage.writing import write_stage

MATERIALS = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
)
def Scope "Looks" {
    def Material "Red" { token outputs:surface }
    def Material "Blue" { token outputs:surface }
}
def Xform "World" (
    prepend apiSchemas = ["MaterialBindingAPI"]
) {
    rel material:binding = </Looks/Red>
    color3f[] primvars:displayColor = [(0.1, 0.2, 0.3)] (
        interpolation = "constant"
    )
    def Mesh "Wheel" {
        int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
        int[] faceVertexIndices = [0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7]
        point3f[] points = [(-0.1, -0.1, 0), (0.1, -0.1, 0), (0.1, 0.1, 0), (-0.1, 0.1, 0),
            (-0.1, -0.1, 0.02), (0.1, -0.1, 0.02), (0.1, 0.1, 0.02), (-0.1, 0.1, 0.02)]
        uniform token subdivisionScheme = "none"
        def GeomSubset "Top" (
            prepend apiSchemas = ["MaterialBindingAPI"]
        ) {
            uniform token elementType = "face"
            uniform token familyName = "materialBind"
            int[] indices = [1]
            rel material:binding = </Looks/Blue>
        }
    }
    def Sphere "Body" (
        prepend apiSchemas = ["MaterialBindingAPI"]
    ) {
        double radius = 0.05
        double3 xformOp:translate = (0, 0, -0.1)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        rel material:binding = </Looks/Blue>
    }
}
"""


def test_materials_stay_whatever_root_they_are_below(tmp_path):
    source = tmp_path / "plant.usda"
    source.write_text(MATERIALS.replace("{ token", "{\n token").replace("surface }", "surface\n }"))
    done = write_stage(one_valve(source, "/World/Wheel"), source, tmp_path / "out")
    stage = Usd.Stage.Open(str(done.files[0]))

    def material(path):
        bound = UsdShade.MaterialBindingAPI(stage.GetPrimAtPath(path)).ComputeBoundMaterial()[0]
        return str(bound.GetPath()) if bound else None

    assert material("/Plant/Devices/V_1/mesh_0") == "/Plant/Scene/Looks/Red"
    assert material("/Plant/Devices/V_1/mesh_0/Top") == "/Plant/Scene/Looks/Blue"
    assert material("/Plant/Scene/World/Body") == "/Plant/Scene/Looks/Blue"
    shown = UsdGeom.PrimvarsAPI(stage.GetPrimAtPath("/Plant/Devices/V_1/mesh_0")).GetPrimvar("displayColor")
    assert np.allclose(shown.Get(), [(0.1, 0.2, 0.3)])
    sphere = stage.GetPrimAtPath("/Plant/Scene/World/Body")
    assert sphere.HasAPI(UsdPhysics.CollisionAPI)
    assert not sphere.HasAPI(UsdPhysics.MeshCollisionAPI)


def one_valve(source, mesh, **more):
    """A graph of a valve whose only moving mesh this is, about z."""
    scene = load(source, movable.QUICK)
    parts = [graphs.part(i, path, label=graphs.label(name="handwheel")) for i, path in enumerate(scene.paths)]
    mechanism = Mechanism(
        kind="handwheel", meshes=(mesh,), axis=(0, 0, 1), pivot=(0, 0, 0), radius=0.1, limits=(-360, 0), **more
    )
    unit = graphs.unit("V-1", *(part.id for part in parts)).model_copy(update={"mechanism": mechanism})
    record = SourceRecord(path=str(source), sha256=scene.source.sha256)
    return SceneGraph(
        GraphDocument(nodes=(Site(id="site"), *parts, unit), edges=(), source=record, config=movable.CONFIG)
    )


PIECES = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 0.01
    upAxis = "Y"
)
def Xform "World" {
    def Mesh "Valve" {
        int[] faceVertexCounts = [4, 4, 3, 4]
        int[] faceVertexIndices = [0, 1, 2, 3, 4, 5, 6, 7, 4, 7, 8, 9, 10, 11, 12]
        point3f[] points = [(-10, 0, -10), (-10, 0, 10), (10, 0, 10), (10, 0, -10), (-5, -10, 0), (5, -10, 0),
            (5, -20, 0), (-5, -20, 0), (-5, -25, 0), (-10, 0, 10), (-10, 1, 10), (10, 1, 10), (10, 0, 10)]
        normal3f[] normals = [(0, 1, 0), (0, 0, 1), (0, 0, 1), (0, 0, -1)] (
            interpolation = "uniform"
        )
        color3f[] primvars:displayColor = [(1, 0, 0), (0, 1, 0), (0, 0, 1)] (
            interpolation = "uniform"
        )
        int[] primvars:displayColor:indices = [0, 1, 2, 0]
        float[] primvars:corner = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14] (
            interpolation = "faceVarying"
        )
        uniform token subdivisionScheme = "none"
        def GeomSubset "Some" {
            uniform token elementType = "face"
            int[] indices = [0, 2]
        }
    }
}
"""


def test_a_wheel_that_is_a_piece_of_its_valve_is_taken_out_of_it(tmp_path):
    source = tmp_path / "plant.usda"
    source.write_text(PIECES)
    # The first polygon and the last one share places, if not points: together they are piece 0.
    done = write_stage(one_valve(source, "/World/Valve", pieces=(0,)), source, tmp_path / "out")
    stage = Usd.Stage.Open(str(done.files[0]))
    wheel = UsdGeom.Mesh(stage.GetPrimAtPath("/Plant/Devices/V_1/mesh_0"))
    rest = UsdGeom.Mesh(stage.GetPrimAtPath("/Plant/Scene/World/Valve"))
    assert list(wheel.GetFaceVertexCountsAttr().Get()) == [4, 4]
    assert list(rest.GetFaceVertexCountsAttr().Get()) == [4, 3]
    assert [list(map(tuple, mesh.GetNormalsAttr().Get())) for mesh in (wheel, rest)] == [
        [(0, 1, 0), (0, 0, -1)],
        [(0, 0, 1), (0, 0, 1)],
    ]
    primvar = [UsdGeom.PrimvarsAPI(mesh).GetPrimvar("displayColor").ComputeFlattened() for mesh in (wheel, rest)]
    assert [list(map(tuple, values)) for values in primvar] == [[(1, 0, 0), (1, 0, 0)], [(0, 1, 0), (0, 0, 1)]]
    corner = [list(UsdGeom.PrimvarsAPI(mesh).GetPrimvar("corner").Get()) for mesh in (wheel, rest)]
    assert corner == [[0, 1, 2, 3, 11, 12, 13, 14], [4, 5, 6, 7, 8, 9, 10]]
    subsets = [list(UsdGeom.Subset(mesh.GetPrim().GetChild("Some")).GetIndicesAttr().Get()) for mesh in (wheel, rest)]
    assert subsets == [[0], [1]]
    assert len(rest.GetPointsAttr().Get()) == 5
    # The stage lies over its source, in a folder beside it.
    above = movable.QUICK.model_copy(update={"asset_roots": ("..",)})
    before, after = load(source, movable.QUICK), load(done.files[0], above)
    assert before.n_triangles == after.n_triangles
    assert np.allclose(before.vertices.min(0), after.vertices.min(0), atol=1e-6)
    assert np.allclose(before.vertices.max(0), after.vertices.max(0), atol=1e-6)
    assert rest.GetPrim().HasAPI(UsdPhysics.CollisionAPI)


ITEMS = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
)
class Xform "Skid" {
    def PointInstancer "Valves" {
        rel prototypes = [<Proto>]
        int[] protoIndices = [0, 0]
        point3f[] positions = [(0, 0, 0), (3, 0, 0)]
        quath[] orientations = [(1, 0, 0, 0), (0, 0, 0, 1)]
        int64[] ids = [7, 9]
        color3f[] primvars:displayColor = [(1, 0, 0), (0, 1, 0)] (
            interpolation = "vertex"
        )
        def Xform "Proto" {
            def Cube "Body" {
                double size = 0.2
                double3 xformOp:translate = (0, 0, -0.2)
                uniform token[] xformOpOrder = ["xformOp:translate"]
            }
            def Mesh "Wheel" {
                int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
                int[] faceVertexIndices = [0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7]
                point3f[] points = [(-0.1, -0.1, 0), (0.1, -0.1, 0), (0.1, 0.1, 0), (-0.1, 0.1, 0),
                    (-0.1, -0.1, 0.02), (0.1, -0.1, 0.02), (0.1, 0.1, 0.02), (-0.1, 0.1, 0.02)]
                uniform token subdivisionScheme = "none"
            }
        }
    }
}
def Xform "World" {
    def Xform "First" (
        instanceable = true
        references = </Skid>
    ) {
    }
    def Xform "Second" (
        instanceable = true
        references = </Skid>
    ) {
        double3 xformOp:translate = (0, 5, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
}
"""


def test_an_item_of_several_meshes_in_an_instance_is_opened_and_its_rest_stays(tmp_path):
    source = tmp_path / "plant.usda"
    source.write_text(ITEMS)
    wheel = "/World/First/Valves[0]/Wheel"
    done = write_stage(one_valve(source, wheel), source, tmp_path / "out")
    stage = Usd.Stage.Open(str(done.files[0]))
    before, colors = movable.shown(source)
    after, colors_after = movable.shown(done.files[0])
    assert len(before) == 8
    assert np.allclose(before, after, atol=1e-6)
    assert np.allclose(colors, colors_after)
    opened = UsdGeom.PointInstancer(stage.GetPrimAtPath("/Plant/Scene/World/First/Valves"))
    assert list(opened.GetPrim().GetMetadata("inactiveIds").GetAddedOrExplicitItems()) == [7]
    assert stage.GetPrimAtPath("/Plant/Scene/World/Second").IsInstance()
    touched = [p for p in stage.GetPrimAtPath("/Plant/Colliders").GetChildren() if p.HasAPI(UsdPhysics.CollisionAPI)]
    assert len(touched) == done.n_colliders == 7
    assert sorted(p.GetTypeName() for p in touched) == ["Cube"] * 4 + ["Mesh"] * 3
    assert {p.GetTypeName() for p in touched if p.HasAPI(UsdPhysics.MeshCollisionAPI)} == {"Mesh"}


BELOW = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "World" {
    def Mesh "Wheel" {
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(-0.1, -0.1, 0), (0.1, -0.1, 0), (0.1, 0.1, 0), (-0.1, 0.1, 0)]
        uniform token subdivisionScheme = "none"
        double3 xformOp:translate = (0, 0, 1)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        def Mesh "Stem" {
            int[] faceVertexCounts = [3]
            int[] faceVertexIndices = [0, 1, 2]
            point3f[] points = [(0, 0, 0), (0.01, 0, 0), (0, 0, -0.2)]
            uniform token subdivisionScheme = "none"
        }
    }
}
"""


def test_a_mesh_below_a_mesh_that_moves_stays_where_it_is(tmp_path):
    source = tmp_path / "plant.usda"
    source.write_text(BELOW)
    done = write_stage(one_valve(source, "/World/Wheel"), source, tmp_path / "out")
    assert np.allclose(movable.shown(source)[0], movable.shown(done.files[0])[0], atol=1e-6)
    stage = Usd.Stage.Open(str(done.files[0]))
    assert stage.GetPrimAtPath("/Plant/Scene/World/Wheel").GetTypeName() == "Xform"
    assert stage.GetPrimAtPath("/Plant/Scene/World/Wheel/Stem").HasAPI(UsdPhysics.CollisionAPI)
