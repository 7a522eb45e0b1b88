import dataclasses
import hashlib
import json
import os
import zipfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pxr import Sdf, Usd, UsdGeom, UsdSemantics, UsdUtils, UsdValidation

import graphs
import shapes
from cadgraph.errors import LoadError, OutputError
from cadgraph.export.usd import prim_paths, write_geometry, write_semantics
from cadgraph.load import load
from cadgraph.model.scene import MeshArrays, Placement, Scene, Source
from cadgraph.pipeline import build

DATA = Path(__file__).parents[2] / "../shared/data/usd"
TEAPOTS = DATA / "teapot_scene/scenes/teapotScene.usd"

WATER_TANK = Path(__file__).parents[1] / "data/parts/water_tank.usdc"
more = pytest.mark.skipif(not TEAPOTS.exists(), reason="no further real files here")


@pytest.fixture(autouse=True)
def _quiet():
    """Some real scenes have hundreds of broken references, and USD prints each."""
    delegate = UsdUtils.CoalescingDiagnosticDelegate()
    yield
    delegate.TakeUncoalescedDiagnostics()


def write(folder, text, name="plant.usda"):
    # The USD reader wants a line end around braces.
    path = folder / name
    path.write_text("#usda 1.0\n" + text.replace("{", "{\n").replace("}", "\n}\n"), encoding="utf-8")
    return path


QUAD = """
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    float3[] extent = [(0, 0, 0), (1, 1, 0)]
    uniform token subdivisionScheme = "none"
"""


def line_of_meshes(folder, n=5, header='defaultPrim = "World"\nmetersPerUnit = 0.01\nupAxis = "Y"'):
    meshes = "\n".join(f'def Mesh "mesh_{i}" {{ {QUAD} }}' for i in range(n))
    return write(folder, f'(\n{header}\n)\ndef Xform "World" {{\n{meshes}\n}}')


def world_meshes(n=5):
    return [f"/World/mesh_{i}" for i in range(n)]


def opened(layer):
    stage = Usd.Stage.Open(str(layer))
    assert stage
    return stage


def labels(stage, path, taxonomy="class"):
    api = UsdSemantics.LabelsAPI(stage.GetPrimAtPath(path), taxonomy)
    return list(api.GetLabelsAttr().Get()) if api and api.GetLabelsAttr() else None


def meshes_of(stage):
    return [p for p in stage.Traverse(Usd.TraverseInstanceProxies()) if p.IsA(UsdGeom.Mesh)]


def anchor_of(prim):
    while prim.IsInstanceProxy():
        prim = prim.GetParent()
    return str(prim.GetPath())


def scene_of(path):
    """The paths and anchors of a source's meshes, with boxes for geometry."""
    stage = opened(path)
    prims = meshes_of(stage)
    scene = graphs.boxes([str(p.GetPath()) for p in prims], format="usd")
    return dataclasses.replace(scene, anchors=tuple(anchor_of(p) for p in prims))


def errors_of(path):
    stage = opened(path)
    context = UsdValidation.ValidationContext(UsdValidation.ValidationRegistry().GetOrLoadAllValidators())
    return {
        (e.GetIdentifier(), e.GetType(), *(str(s.GetPrim().GetPath()) if s.GetPrim() else "" for s in e.GetSites()))
        for e in context.Validate(stage)
    }


def test_every_labelled_mesh_has_one_class_token_and_its_group(tmp_path):
    source = line_of_meshes(tmp_path)
    scene = graphs.boxes(world_meshes())
    layer = write_semantics(scene, graphs.labelled(scene), source, tmp_path / "out/semantics.usda")
    stage = opened(layer)
    for path in scene.paths:
        assert labels(stage, path) == ["pipe"]
        assert labels(stage, path, "cad_group") == ["Pipe assembly"]
        assert UsdGeom.Mesh(stage.GetPrimAtPath(path)).GetPointsAttr().Get(), "the source's geometry shows"


def test_all_meshes_of_a_part_get_its_label_and_the_others_none(tmp_path):
    source = line_of_meshes(tmp_path, 3)
    scene = graphs.boxes(world_meshes(3))
    graph = graphs.graph([graphs.part(0, *world_meshes(2), label=graphs.label()), graphs.part(1, world_meshes(3)[2])])
    stage = opened(write_semantics(scene, graph, source, tmp_path / "semantics.usda"))
    assert [labels(stage, path) for path in scene.paths] == [["valve body"], ["valve body"], None]
    assert not stage.GetPrimAtPath("/World/mesh_2").HasAPI(UsdSemantics.LabelsAPI)


def test_class_is_the_group_where_the_name_is_unknown(tmp_path):
    source = line_of_meshes(tmp_path, 1)
    scene = graphs.boxes(world_meshes(1))
    layer = write_semantics(scene, graphs.labelled(scene, "Tank", None), source, tmp_path / "semantics.usda")
    assert labels(opened(layer), "/World/mesh_0") == ["Tank"]


def test_confidence_and_source_are_in_the_attributes_custom_data(tmp_path):
    source = line_of_meshes(tmp_path, 1)
    scene = graphs.boxes(world_meshes(1))
    stage = opened(write_semantics(scene, graphs.labelled(scene), source, tmp_path / "semantics.usda"))
    for taxonomy in ("class", "cad_group"):
        attribute = stage.GetPrimAtPath("/World/mesh_0").GetAttribute(f"semantics:labels:{taxonomy}")
        assert attribute.GetCustomData().items() >= {"confidence": 0.75, "source": "geometry", "part": "part-0"}.items()
        assert attribute.GetNumTimeSamples() == 0


def test_stage_metadata_is_said_again(tmp_path):
    source = line_of_meshes(
        tmp_path,
        1,
        'defaultPrim = "World"\nmetersPerUnit = 0.0254\nupAxis = "Z"\nkilogramsPerUnit = 0.001\n'
        "timeCodesPerSecond = 30\nframesPerSecond = 25\nstartTimeCode = 1\nendTimeCode = 9\n"
        'expressionVariables = { string A = "x" }',
    )
    scene = graphs.boxes(world_meshes(1))
    stage = opened(write_semantics(scene, graphs.labelled(scene), source, tmp_path / "semantics.usda"))
    assert UsdGeom.GetStageMetersPerUnit(stage) == 0.0254
    assert UsdGeom.GetStageUpAxis(stage) == "Z"
    assert stage.GetDefaultPrim().GetPath() == "/World"
    assert stage.GetMetadata("kilogramsPerUnit") == 0.001
    assert (stage.GetTimeCodesPerSecond(), stage.GetFramesPerSecond()) == (30, 25)
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (1, 9)
    assert stage.GetMetadata("expressionVariables") == {"A": "x"}


def test_units_and_up_axis_come_from_the_scene_where_the_source_gives_none(tmp_path):
    source = write(tmp_path, f'def Mesh "mesh" {{ {QUAD} }}')
    scene = graphs.boxes(["/mesh"], meters_per_unit=0.01, up_axis="Y")
    stage = opened(write_semantics(scene, graphs.labelled(scene), source, tmp_path / "semantics.usda"))
    assert (UsdGeom.GetStageMetersPerUnit(stage), UsdGeom.GetStageUpAxis(stage)) == (0.01, "Y")
    assert not stage.HasDefaultPrim()


@pytest.mark.parametrize("odd", ['upAxis = "X"', 'upAxis = "nowhere"', 'defaultPrim = "Missing"', "metersPerUnit = 0"])
def test_odd_stage_metadata_does_not_stop_it(tmp_path, odd):
    source = line_of_meshes(tmp_path, 1, odd)
    scene = graphs.boxes(world_meshes(1))
    layer = write_semantics(scene, graphs.labelled(scene), source, tmp_path / "semantics.usda")
    assert labels(opened(layer), "/World/mesh_0") == ["pipe"]
    key, value = odd.split(" = ")
    assert str(Sdf.Layer.FindOrOpen(str(layer)).pseudoRoot.GetInfo(key)).startswith(value.strip('"'))


def test_instances_are_labelled_at_their_root_by_their_largest_part(tmp_path):
    asset = f'def Xform "Valve" {{ def Mesh "body" {{ {QUAD} }}\n def Mesh "wheel" {{ {QUAD} }} }}'
    write(tmp_path, f'( defaultPrim = "Valve" )\n{asset}', "asset.usda")
    instances = "\n".join(
        f'def "v{i}" ( instanceable = true\n prepend references = @./asset.usda@ ) {{}}' for i in range(2)
    )
    source = write(tmp_path, f'( defaultPrim = "World" )\ndef Xform "World" {{ {instances} }}')
    scene = scene_of(source)
    assert scene.paths == ("/World/v0/body", "/World/v0/wheel", "/World/v1/body", "/World/v1/wheel")
    parts = [
        graphs.part(i, path, label=graphs.label(name=name), size=size)
        for i, (path, name, size) in enumerate(
            zip(scene.paths, ("valve body", "handwheel", "handwheel", "valve body"), (2, 1, 1, 2), strict=True)
        )
    ]
    graph = graphs.graph([*parts, graphs.unit("V-001", "part-0", "part-1")])
    stage = opened(write_semantics(scene, graph, source, tmp_path / "semantics.usda"))
    assert [labels(stage, path) for path in ("/World/v0", "/World/v1")] == [["valve body"], ["valve body"]]
    assert stage.GetPrimAtPath("/World/v0").IsInstance(), "labels leave it an instance"
    shared = stage.GetPrimAtPath("/World/v1").GetCustomDataByKey("cadgraph")
    assert list(shared["parts"]) == ["part-3", "part-2"]
    assert list(shared["classes"]) == ["valve body", "handwheel"]
    unit = stage.GetPrimAtPath("/CadGraph/Units/V_001")
    assert unit.GetRelationship("cadgraph:parts").GetTargets() == ["/World/v0/body", "/World/v0/wheel"]


def test_a_small_labelled_part_names_an_instance_whose_large_one_has_no_label(tmp_path):
    source = line_of_meshes(tmp_path, 2)
    scene = dataclasses.replace(graphs.boxes(world_meshes(2)), anchors=("/World", "/World"))
    graph = graphs.graph(
        [
            graphs.part(0, "/World/mesh_0", size=9.0),
            graphs.part(1, "/World/mesh_1", label=graphs.label(name="valve stem")),
        ]
    )
    stage = opened(write_semantics(scene, graph, source, tmp_path / "semantics.usda"))
    assert labels(stage, "/World") == ["valve stem"]
    assert list(stage.GetPrimAtPath("/World").GetCustomDataByKey("cadgraph")["classes"]) == ["", "valve stem"]


def test_items_of_a_point_instancer_are_labelled_at_the_instancer(tmp_path):
    source = write(
        tmp_path,
        f"""( defaultPrim = "World"\n metersPerUnit = 1\n upAxis = "Z" )
def Xform "World" {{ def PointInstancer "bolts" {{
    int[] protoIndices = [0, 0]
    point3f[] positions = [(0, 0, 0), (3, 0, 0)]
    rel prototypes = </World/bolts/bolt>
    float3[] extent = [(0, 0, 0), (4, 1, 0)]
    def Mesh "bolt" {{ {QUAD} }}
}} }}""",
    )
    scene = dataclasses.replace(
        graphs.boxes(["/World/bolts[0]", "/World/bolts[1]"]), anchors=("/World/bolts", "/World/bolts")
    )
    nodes = [
        graphs.part(0, "/World/bolts[0]", label=graphs.label(name="bolt")),
        graphs.part(1, "/World/bolts[1]", label=graphs.label(name="nut")),
        graphs.unit("V-001", "part-0", "part-1"),
    ]
    layer = write_semantics(scene, graphs.graph(nodes), source, tmp_path / "semantics.usda")
    stage = opened(layer)
    assert labels(stage, "/World/bolts") == ["bolt"]
    assert list(stage.GetPrimAtPath("/World/bolts").GetCustomDataByKey("cadgraph")["parts"]) == ["part-0", "part-1"]
    targets = stage.GetPrimAtPath("/CadGraph/Units/V_001").GetRelationship("cadgraph:parts").GetTargets()
    assert targets == ["/World/bolts"]
    assert errors_of(layer) == errors_of(source)


def test_subsets_are_labelled_on_the_subset(tmp_path):
    subsets = "\n".join(
        f'def GeomSubset "{name}" {{ uniform token elementType = "face"\n int[] indices = [{i}] }}'
        for i, name in enumerate(("steel", "glass"))
    )
    source = write(
        tmp_path,
        f"""( defaultPrim = "gauge"\n metersPerUnit = 1\n upAxis = "Z" )
def Mesh "gauge" {{
    int[] faceVertexCounts = [3, 3]
    int[] faceVertexIndices = [0, 1, 2, 0, 2, 3]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    {subsets}
}}""",
    )
    scene = graphs.boxes(["/gauge/steel", "/gauge/glass"])
    layer = write_semantics(scene, graphs.labelled(scene, "Gauge assembly", "gauge glass"), source, tmp_path / "l.usda")
    stage = opened(layer)
    assert labels(stage, "/gauge/glass") == ["gauge glass"]
    assert stage.GetPrimAtPath("/gauge/glass").GetTypeName() == "GeomSubset"
    assert errors_of(layer) <= errors_of(source)


def test_meshes_inside_variants_are_labelled_by_plain_overs(tmp_path):
    source = write(
        tmp_path,
        f"""( defaultPrim = "World" )
def Xform "World" ( variants = {{ string size = "big" }} prepend variantSets = "size" ) {{
    variantSet "size" = {{ "big" {{ def Mesh "tank" {{ {QUAD} }} }} "small" {{ }} }}
}}""",
    )
    scene = graphs.boxes(["/World/tank"])
    stage = opened(write_semantics(scene, graphs.labelled(scene), source, tmp_path / "semantics.usda"))
    assert labels(stage, "/World/tank") == ["pipe"]
    assert stage.GetPrimAtPath("/World/tank").IsA(UsdGeom.Mesh)


def test_units_clusters_and_relations_are_prims_of_their_own(tmp_path):
    source = line_of_meshes(tmp_path)
    scene = graphs.boxes(world_meshes())
    data = json.loads(json.dumps(graphs.valve_line().to_json()).replace("/mesh_", "/World/mesh_"))
    graph = type(graphs.valve_line()).from_json(data)
    layer = write_semantics(scene, graph, source, tmp_path / "semantics.usda")
    stage = opened(layer)
    valve = stage.GetPrimAtPath("/CadGraph/Units/V_001")
    assert labels(stage, valve.GetPath(), "cad_unit") == ["valve"]
    assert valve.GetDisplayName() == "V-001"
    assert valve.GetAttribute("cadgraph:tag").Get() == "V-001"
    assert valve.GetAttribute("cadgraph:kind").Get() == "ball valve"
    assert valve.GetAttribute("cadgraph:unitType").Get() == "valve"
    assert valve.GetRelationship("cadgraph:related").GetTargets() == ["/CadGraph/Units/V_002"]
    assert valve.GetRelationship("cadgraph:flowsTo").GetTargets() == ["/CadGraph/Units/V_002"]
    other = stage.GetPrimAtPath("/CadGraph/Units/V_002")
    assert other.GetRelationship("cadgraph:connected").GetTargets() == [
        "/CadGraph/Units/V_001",
        "/CadGraph/Terminals/end_0",
    ]
    assert not other.HasRelationship("cadgraph:flowsTo")
    pipes = stage.GetPrimAtPath("/CadGraph/Clusters/cluster_0")
    assert pipes.GetAttribute("cadgraph:kind").Get() == "pipe system"
    members = Usd.CollectionAPI(pipes, "parts").ComputeIncludedPaths(
        Usd.CollectionAPI(pipes, "parts").ComputeMembershipQuery(), stage
    )
    assert sorted(members) == world_meshes(4)
    assert stage.GetPrimAtPath("/CadGraph/Systems/system_0").GetRelationship("cadgraph:units").GetTargets() == [
        "/CadGraph/Units/V_001",
        "/CadGraph/Units/V_002",
    ]
    assert errors_of(layer) == errors_of(source)


def test_the_root_of_the_layer_takes_a_name_that_the_source_does_not_use(tmp_path):
    write(tmp_path, 'def Xform "CadGraph_2" {}', "below.usda")
    source = write(
        tmp_path,
        f'( subLayers = [@./below.usda@, @./missing.usda@] )\ndef Xform "CadGraph" {{ def Mesh "mesh" {{ {QUAD} }} }}',
    )
    scene = graphs.boxes(["/CadGraph/mesh"])
    layer = write_semantics(scene, graphs.labelled(scene), source, tmp_path / "semantics.usda")
    content = Sdf.Layer.FindOrOpen(str(layer))
    assert [prim.name for prim in content.rootPrims] == ["CadGraph", "CadGraph_3"]


def test_a_layer_over_a_layer_keeps_both_apart(tmp_path):
    source = line_of_meshes(tmp_path, 1)
    scene = graphs.boxes(world_meshes(1))
    first = write_semantics(scene, graphs.labelled(scene), source, tmp_path / "one/semantics.usda")
    graph = graphs.graph(
        [graphs.part(0, *scene.paths, label=graphs.label("Tank", "shell")), graphs.unit("T-001", "part-0")]
    )
    second = opened(write_semantics(scene, graph, first, tmp_path / "two/semantics.usda"))
    assert labels(second, scene.paths[0]) == ["shell"]
    assert second.GetPrimAtPath("/CadGraph_2/Units/T_001")


@pytest.mark.parametrize(
    "hostile", ["a:b;c,d&e|f!g", '"""\n#usda', "=cmd()", "]) { over }", "\x00\x1b[31m", "阀 é", ""]
)
def test_hostile_labels_and_tags_do_no_harm(tmp_path, hostile):
    source = line_of_meshes(tmp_path, 2)
    scene = graphs.boxes(world_meshes(2))
    label = graphs.label(hostile, hostile, source=hostile)
    nodes = [
        graphs.part(0, scene.paths[0], label=label),
        graphs.part(1, scene.paths[1], label=label),
        graphs.unit(hostile, "part-0", unit_type=hostile, kind=hostile),
        graphs.unit(hostile + " ", "part-1", unit_type=hostile),
    ]
    layer = write_semantics(scene, graphs.graph(nodes), source, tmp_path / "semantics.usda")
    stage = opened(layer)
    [token] = labels(stage, scene.paths[0])
    assert token
    assert not set(token) & set(":;,&|!\n\x00\x1b")
    units = stage.GetPrimAtPath("/CadGraph/Units").GetChildren()
    assert len(units) == 2
    assert [labels(stage, u.GetPath(), "cad_unit") for u in units] == [[token], [token]]
    assert errors_of(layer) == errors_of(source)


def test_paths_that_usd_does_not_know_are_passed_over(tmp_path):
    source = line_of_meshes(tmp_path, 1)
    scene = graphs.boxes(["/World/mesh_0", "not a path", "relative", "/World.attribute"])
    stage = opened(write_semantics(scene, graphs.labelled(scene), source, tmp_path / "semantics.usda"))
    assert labels(stage, "/World/mesh_0") == ["pipe"]


def test_a_mesh_that_the_scene_lacks_is_an_error(tmp_path):
    source = line_of_meshes(tmp_path, 1)
    with pytest.raises(ValueError, match="'/World/other'"):
        write_semantics(
            graphs.boxes(world_meshes(1)), graphs.labelled(["/World/other"]), source, tmp_path / "semantics.usda"
        )


def test_an_empty_scene_gives_a_layer_that_opens(tmp_path):
    source = line_of_meshes(tmp_path, 1)
    layer = write_semantics(Scene.from_meshes([]), graphs.graph(), source, tmp_path / "semantics.usda")
    assert opened(layer).GetPrimAtPath("/World/mesh_0")


def test_the_source_stays_as_it_is_and_the_bytes_repeat(tmp_path):
    source = line_of_meshes(tmp_path)
    before = source.read_bytes(), source.stat().st_mtime_ns
    scene = graphs.boxes(world_meshes())
    vertices = scene.vertices.copy()
    contents = {
        write_semantics(scene, graphs.labelled(scene), source, tmp_path / name / "semantics.usda").read_bytes()
        for name in ("a", "b")
    }
    assert len(contents) == 1
    assert (source.read_bytes(), source.stat().st_mtime_ns) == before
    assert np.array_equal(scene.vertices, vertices)


def test_the_source_is_never_overwritten(tmp_path):
    source = line_of_meshes(tmp_path, 1)
    scene = graphs.boxes(world_meshes(1))
    before = source.read_bytes()
    with pytest.raises(OutputError, match="source itself"):
        write_semantics(scene, graphs.labelled(scene), source, tmp_path / "." / "plant.usda")
    assert source.read_bytes() == before


def test_a_source_that_is_gone_or_damaged_is_a_load_error(tmp_path):
    scene = graphs.boxes(["/mesh"])
    damaged = tmp_path / "damaged.usdc"
    damaged.write_bytes(b"PXR-USDC" + bytes(80))
    for source in (tmp_path / "gone.usda", damaged):
        with pytest.raises(LoadError, match="can't be opened"):
            write_semantics(scene, graphs.labelled(scene), source, tmp_path / "semantics.usda")
    assert not (tmp_path / "semantics.usda").exists()


@pytest.mark.parametrize("name", ["plant.usda", "a b@c.usda", "anlage-ü.usda", "it's (1)#2.usda"])
def test_the_source_is_found_by_a_relative_path(tmp_path, name, monkeypatch):
    source = line_of_meshes(tmp_path, 1).rename(tmp_path / name)
    monkeypatch.chdir(tmp_path)
    scene = graphs.boxes(world_meshes(1))
    layer = write_semantics(scene, graphs.labelled(scene), source.name, "out/deep/semantics.usda")
    assert list(Sdf.Layer.FindOrOpen(str(layer)).subLayerPaths) == [f"../../{name}"]
    moved = tmp_path.rename(tmp_path.with_name(tmp_path.name + "-moved"))
    assert opened(moved / layer).GetPrimAtPath("/World/mesh_0").IsA(UsdGeom.Mesh)


def test_a_source_on_another_drive_is_named_in_full(tmp_path, monkeypatch):
    source = line_of_meshes(tmp_path, 1)
    scene = graphs.boxes(world_meshes(1))

    def other_drive(path, start):
        raise ValueError("path is on mount 'C:', start on mount 'D:'")

    monkeypatch.setattr(os.path, "relpath", other_drive)
    layer = write_semantics(scene, graphs.labelled(scene), source, tmp_path / "out/semantics.usda")
    assert list(Sdf.Layer.FindOrOpen(str(layer)).subLayerPaths) == [source.as_posix()]


def test_a_usdz_package_can_be_the_source(tmp_path):
    inside = line_of_meshes(tmp_path, 2)
    package = tmp_path / "plant.usdz"
    assert UsdUtils.CreateNewUsdzPackage(str(inside), str(package))
    assert zipfile.is_zipfile(package)
    scene = graphs.boxes(world_meshes(2))
    stage = opened(write_semantics(scene, graphs.labelled(scene), package, tmp_path / "out/semantics.usda"))
    assert UsdGeom.GetStageMetersPerUnit(stage) == 0.01
    assert labels(stage, "/World/mesh_1") == ["pipe"]
    assert UsdGeom.Mesh(stage.GetPrimAtPath("/World/mesh_1")).GetPointsAttr().Get()


@pytest.mark.slow
def test_eight_thousand_meshes_are_all_labelled(tmp_path):
    source = line_of_meshes(tmp_path, 8000)
    scene = graphs.boxes(world_meshes(8000))
    stage = opened(write_semantics(scene, graphs.labelled(scene), source, tmp_path / "semantics.usda"))
    assert all(labels(stage, path) == ["pipe"] for path in scene.paths)


@pytest.mark.parametrize(("source", "least"), [(WATER_TANK, 21), pytest.param(TEAPOTS, 494, marks=more)])
def test_every_mesh_of_a_real_scene_lies_under_a_label(source, least, tmp_path):
    before = hashlib.sha256(source.read_bytes()).hexdigest()
    scene = scene_of(source)
    assert scene.n_meshes >= least
    layer = write_semantics(scene, graphs.labelled(scene), source, tmp_path / "semantics.usda")
    stage = opened(layer)
    assert len(meshes_of(stage)) == scene.n_meshes
    assert all(labels(stage, anchor) == ["pipe"] for anchor in scene.anchors)
    assert errors_of(layer) <= errors_of(source)
    assert hashlib.sha256(source.read_bytes()).hexdigest() == before


# Geometry for sources that are not USD


def step_scene(**more):
    paths = ["/1 Ventil/Körper", "/1 Ventil/Körper/Rad", "/1 Ventil/K rper", "/阀/=cmd", "//阀/=cmd", "/x[3]"]
    return dataclasses.replace(graphs.boxes(paths, format="step"), **more)


def test_a_source_that_is_not_usd_gets_its_geometry_written(tmp_path):
    scene = step_scene()
    layer = write_semantics(scene, graphs.labelled(scene), tmp_path / "valve.step", tmp_path / "out/semantics.usda")
    assert list(Sdf.Layer.FindOrOpen(str(layer)).subLayerPaths) == ["./scene.usdc"]
    stage = opened(layer)
    assert (UsdGeom.GetStageMetersPerUnit(stage), UsdGeom.GetStageUpAxis(stage)) == (1.0, "Z")
    assert stage.GetDefaultPrim().GetPath() == "/World"
    assert len(meshes_of(stage)) == scene.n_meshes
    assert all(labels(stage, path) == ["pipe"] for path in prim_paths(scene))
    assert errors_of(layer) == set()


def test_names_become_valid_unique_and_are_kept_beside(tmp_path):
    scene = step_scene()
    assert prim_paths(scene) == (
        "/World/_1_Ventil/K_rper/mesh",
        "/World/_1_Ventil/K_rper/Rad",
        "/World/_1_Ventil/K_rper_2",
        "/World/_/_cmd",
        "/World/_/_cmd_2",
        "/World/x_3_",
    )
    stage = opened(write_geometry(scene, tmp_path / "scene.usdc"))
    assert stage.GetPrimAtPath("/World/_1_Ventil").GetDisplayName() == "1 Ventil"
    mesh = stage.GetPrimAtPath("/World/_1_Ventil/K_rper/mesh")
    assert mesh.GetDisplayName() == "Körper"
    assert mesh.GetCustomDataByKey("cadgraph:path") == "/1 Ventil/Körper"


def test_geometry_keeps_its_place_far_from_the_origin(tmp_path):
    far = np.array([2.4e7, -3.1e6, 120.0])
    bolts = [shapes.box((0.01, 0.02, 0.03), (500.0 + 0.1 * i, 0.001 * i, 0.0)) for i in range(3)]
    scene = dataclasses.replace(Scene.from_meshes(bolts, source=Source(format="step")), origin=far)
    stage = opened(write_geometry(scene, tmp_path / "scene.usdc"))
    for index, path in enumerate(prim_paths(scene)):
        mesh = UsdGeom.Mesh(stage.GetPrimAtPath(path))
        local = np.array(mesh.GetPointsAttr().Get(), np.float64)
        offset = np.array(mesh.GetPrim().GetAttribute("xformOp:translate").Get())
        assert np.abs(local + offset - scene.mesh(index)[0]).max() < 1e-9
        world = np.array(mesh.ComputeLocalToWorldTransform(0).ExtractTranslation())
        assert np.abs(world - offset - far).max() < 1e-8


def test_faces_and_colors_are_written_as_they_are(tmp_path):
    colors = np.array([[0.1, 0.2, 0.3], [np.nan] * 3], np.float32)
    scene = Scene.from_meshes([shapes.box(), shapes.cylinder()], ["/a", "/b"], colors)
    stage = opened(write_geometry(scene, tmp_path / "scene.usdc"))
    for index, path in enumerate(prim_paths(scene)):
        mesh = UsdGeom.Mesh(stage.GetPrimAtPath(path))
        assert np.array_equal(np.array(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3), scene.mesh(index)[1])
        assert mesh.GetSubdivisionSchemeAttr().Get() == "none"
        extent = np.array(mesh.GetExtentAttr().Get())
        assert np.array_equal(extent, UsdGeom.PointBased.ComputeExtent(mesh.GetPointsAttr().Get()))
    first, second = (UsdGeom.Mesh(stage.GetPrimAtPath(path)) for path in prim_paths(scene))
    assert np.allclose(first.GetDisplayColorAttr().Get(), [colors[0]])
    assert not second.GetDisplayColorAttr().HasAuthoredValue()


def test_meshes_that_share_a_shape_refer_to_its_points(tmp_path):
    turn = np.array([[0.0, 1, 0], [-1, 0, 0], [0, 0, 1]])
    placement = Placement(
        np.array([0, 0, 1]), np.array([np.eye(3), turn, np.eye(3)]), np.array([[500.0, 0, 0], [0, 3, 1], [9, 9, 9]])
    )
    arrays = MeshArrays.of([shapes.box((0.3, 0.2, 0.1), (0.05, 0, 7)), shapes.cylinder()])
    colors = np.array([[0.1, 0.2, 0.3], [0.9, 0.2, 0.3], [np.nan] * 3], np.float32)
    scene = Scene(arrays, ("/a", "/b", "/c"), colors, placement=placement)
    stage = opened(write_geometry(scene, tmp_path / "scene.usdc"))
    drawn = [prim for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh)]
    assert [str(prim.GetPath()) for prim in drawn] == list(prim_paths(scene))
    for index, prim in enumerate(drawn):
        mesh = UsdGeom.Mesh(prim)
        local = np.array(mesh.GetPointsAttr().Get(), np.float64)
        matrix = np.array(UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(0))
        assert np.abs(local @ matrix[:3, :3] + matrix[3, :3] - scene.mesh(index)[0]).max() < 1e-7
    assert np.allclose(UsdGeom.Mesh(drawn[1]).GetDisplayColorAttr().Get(), [colors[1]])
    assert not drawn[0].GetPrimStack()[0].attributes.get("points")


def test_a_source_whose_meshes_were_split_gets_its_solids_written(tmp_path):
    whole = tmp_path / "bag.usda"
    stage = Usd.Stage.CreateNew(str(whole))
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    boxes = [
        (v + np.array([0.5 * k, 0, 0]), f) for k in range(30) for v, f in [shapes.tube(0.1 + 0.05 * (k % 3), 0.09, 2.0)]
    ]
    mesh = UsdGeom.Mesh.Define(stage, "/World/all")
    mesh.GetPointsAttr().Set(np.concatenate([v for v, _ in boxes]).tolist())
    faces = np.concatenate([f + len(boxes[0][0]) * k for k, (_, f) in enumerate(boxes)])
    mesh.GetFaceVertexCountsAttr().Set([3] * len(faces))
    mesh.GetFaceVertexIndicesAttr().Set(faces.reshape(-1).tolist())
    stage.Save()
    scene = load(whole)
    assert scene.n_meshes == 30
    layer = opened(write_semantics(scene, build(scene), whole, tmp_path / "out" / "semantics.usda"))
    assert (tmp_path / "out" / "scene.usdc").exists()
    assert len([prim for prim in layer.Traverse() if prim.IsA(UsdGeom.Mesh)]) == 30


def test_geometry_has_the_same_bytes_each_time(tmp_path):
    scene = graphs.boxes([f"/a{i % 7}/b{i}" for i in range(200)])
    assert len({write_geometry(scene, tmp_path / f"{i}.usdc").read_bytes() for i in range(3)}) == 1


def test_an_empty_scene_has_an_empty_world(tmp_path):
    stage = opened(write_geometry(Scene.from_meshes([]), tmp_path / "scene.usdc"))
    assert [str(prim.GetPath()) for prim in stage.Traverse()] == ["/World"]


@given(st.lists(st.text(max_size=8), min_size=1, max_size=12, unique=True))
def test_any_names_give_valid_unique_paths(names):
    paths = prim_paths(graphs.boxes(names))
    assert len(set(paths)) == len(names)
    assert all(Sdf.Path.IsValidPathString(path) for path in paths)
    assert not any(a != b and Sdf.Path(b).HasPrefix(a) for a in paths for b in paths)
