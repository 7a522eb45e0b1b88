import shutil
import zipfile
from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdShade, UsdUtils, UsdValidation

import graphs
from cadgraph.config import LoadConfig
from cadgraph.errors import OutputError
from cadgraph.export import write_export
from cadgraph.export.baked_usd import write_baked
from cadgraph.export.usd import write_semantics
from cadgraph.load import load
from cadgraph.model.records import Mechanism
from label_readers import drawn_labels, get_labels, nearest

TEAPOTS = Path(__file__).parents[2] / "../shared/data/usd/teapot_scene/scenes/teapotScene.usd"
BOX = """
    int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
    int[] faceVertexIndices = [0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7]
    point3f[] points = [(0,0,0), (1,0,0), (1,1,0), (0,1,0), (0,0,1), (1,0,1), (1,1,1), (0,1,1)]
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    uniform token subdivisionScheme = "none"
"""
AT = 'double3 xformOp:translate = ({}, 0, 0)\n uniform token[] xformOpOrder = ["xformOp:translate"]'
STAGE = 'defaultPrim = "{}"\n metersPerUnit = 0.01\n upAxis = "Y"'


def write(folder, text, name):
    # The USD reader wants a line end around braces.
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("#usda 1.0\n" + text.replace("{", "{\n").replace("}", "\n}\n"), encoding="utf-8")
    return path


def read(path, **settings):
    return load(path, LoadConfig(isolate=False, **settings))


def plant(folder, n=4):
    """Valves behind payloads, each an instance with a body, a wheel, a nested instance of a bolt; bolts as points."""
    (folder / "parts/textures").mkdir(parents=True)
    (folder / "parts/textures/rust.png").write_bytes(b"png")
    write(folder, f'( {STAGE.format("Bolt")} )\ndef Xform "Bolt" {{ def Mesh "head" {{ {BOX} }} }}', "parts/bolt.usda")
    write(
        folder,
        f"""( {STAGE.format("Valve")} )
def Xform "Valve" {{
  def Mesh "body" ( prepend apiSchemas = ["MaterialBindingAPI"] ) {{ {BOX}
    rel material:binding = </Valve/paint> }}
  def Mesh "wheel" {{ {BOX} {AT.format(2)} }}
  def "bolt" ( instanceable = true
    prepend references = @./bolt.usda@ ) {{ {AT.format(4)} }}
  def Material "paint" {{ token outputs:surface.connect = </Valve/paint/shader.outputs:surface>
    def Shader "shader" {{ uniform token info:id = "UsdUVTexture"
      asset inputs:file = @./textures/rust.png@
      token outputs:surface }} }}
}}""",
        "parts/valve.usda",
    )
    valves = "\n".join(
        f'def "v{i}" ( instanceable = true\n prepend payload = @./parts/valve.usda@ ) {{ {AT.format(10 * i)} }}'
        for i in range(n)
    )
    return write(
        folder,
        f"""( {STAGE.format("World")} )
def Xform "World" {{ {valves}
  def "plain" ( prepend references = @./parts/bolt.usda@ ) {{ {AT.format(-10)} }}
  def PointInstancer "points" {{
    int[] protoIndices = [0, 1, 0, 0]
    point3f[] positions = [(0, 20, 0), (5, 20, 0), (10, 20, 0), (15, 20, 0)]
    rel prototypes = [</World/points/one>, </World/points/two>]
    float3[] extent = [(0, 20, 0), (20, 21, 1)]
    def Mesh "one" {{ {BOX} }}
    def Xform "two" {{ def Mesh "a" {{ {BOX} }}
      def Mesh "b" {{ {BOX} {AT.format(2)} }} }}
  }}
}}""",
        "plant.usda",
    )


def said(scene, names=None, group="Valve assembly", **more):
    """A graph with a part for each mesh, called as ``names`` says by the end of its path, else by its last step."""
    parts = []
    for number, path in enumerate(scene.paths):
        found = [name for end, name in (names or {}).items() if path.endswith(end)]
        name = found[0] if found else path.rsplit("/", 1)[-1].split("[")[0]
        parts.append(graphs.part(number, path, label=graphs.label(group, name) if name else None))
    return graphs.graph(parts, **more)


def wanted(graph):
    return {part.meshes[0]: (part.label.name,) if part.label else None for part in graph.parts()}


def baked(source, graph, path):
    file, notes = write_baked(read(source), graph, source, path)
    return Usd.Stage.Open(str(file)), {note.code: note for note in notes}


def test_every_mesh_has_its_own_label_in_the_one_layer_there_is(tmp_path):
    source = plant(tmp_path / "in")
    graph = said(read(source))
    stage, _ = baked(source, graph, tmp_path / "out/plant.usdc")
    assert drawn_labels(stage) == wanted(graph)
    assert {layer for layer in stage.GetUsedLayers() if not layer.anonymous} == {stage.GetRootLayer()}
    assert not any(stage.GetRootLayer().GetCompositionAssetDependencies())
    body = stage.GetPrimAtPath("/World/v0/body")
    assert body.IsInstanceProxy()
    assert {spec.layer for spec in body.GetAttribute("semantics:labels:class").GetPropertyStack()} == {
        stage.GetRootLayer()
    }


def test_the_layer_over_the_source_labels_whole_instances_alone(tmp_path):
    source = plant(tmp_path / "in")
    scene = read(source)
    graph = said(scene)
    layer = write_semantics(scene, graph, source, tmp_path / "semantics.usda")
    found, own = drawn_labels(Usd.Stage.Open(str(layer))), wanted(graph)
    assert found["/World/plain/head"] == own["/World/plain/head"]
    assert {found[f"/World/v0/{mesh}"] for mesh in ("body", "wheel", "bolt/head")} == {("body",)}


def test_instances_with_the_same_labels_share_a_prototype(tmp_path):
    source = plant(tmp_path / "in")
    stage, notes = baked(source, said(read(source)), tmp_path / "plant.usda")
    instances = [stage.GetPrimAtPath(f"/World/v{i}") for i in range(4)]
    assert all(prim.IsInstance() for prim in instances)
    assert len({prim.GetPrototype() for prim in instances}) == 1
    assert stage.GetPrimAtPath("/World/v0/bolt").IsInstanceProxy()
    assert notes["instances"].message.startswith("5 instances stay instances, 0 ")


def test_an_instance_of_its_own_labels_is_opened_and_two_of_the_same_share_another(tmp_path):
    source = plant(tmp_path / "in")
    graph = said(read(source), {"v3/wheel": "lever"})
    stage, _ = baked(source, graph, tmp_path / "alone.usda")
    assert drawn_labels(stage) == wanted(graph)
    assert [stage.GetPrimAtPath(f"/World/v{i}").IsInstance() for i in range(4)] == [True, True, True, False]
    assert UsdShade.MaterialBindingAPI(stage.GetPrimAtPath("/World/v3/body")).ComputeBoundMaterial()[0].GetPath() == (
        "/World/v3/paint"
    )
    graph = said(read(source), {"v3/wheel": "lever", "v2/wheel": "lever", "v1/bolt/head": "nut"})
    stage, _ = baked(source, graph, tmp_path / "two.usda")
    assert drawn_labels(stage) == wanted(graph)
    kept = [stage.GetPrimAtPath(f"/World/v{i}") for i in (2, 3)]
    assert kept[0].GetPrototype() == kept[1].GetPrototype()


def test_all_instances_are_opened_where_a_renderer_skips_them(tmp_path):
    source = plant(tmp_path / "in")
    graph = said(read(source))
    stage = Usd.Stage.Open(
        str(write_baked(read(source), graph, source, tmp_path / "plant.usdc", open_instances=True)[0])
    )
    assert drawn_labels(stage) == wanted(graph)
    assert not stage.GetPrototypes()
    assert [prim.GetName() for prim in stage.GetPseudoRoot().GetChildren()] == ["World", "CadGraph"]


def test_a_mesh_without_a_label_takes_none_from_what_shares_its_prototype(tmp_path):
    source = plant(tmp_path / "in")
    graph = said(read(source), {"v1/wheel": None, "points[3]": None})
    stage, _ = baked(source, graph, tmp_path / "plant.usda")
    assert drawn_labels(stage) == wanted(graph)


def test_items_of_a_point_instancer_are_split_by_label_and_stay_in_their_place(tmp_path):
    source = plant(tmp_path / "in")
    graph = said(read(source), {"points[2]": "nut"})
    stage, _ = baked(source, graph, tmp_path / "plant.usda")
    assert drawn_labels(stage) == wanted(graph)
    points = UsdGeom.PointInstancer(stage.GetPrimAtPath("/World/points"))
    assert len(points.GetPrototypesRel().GetTargets()) == 3
    assert read(tmp_path / "plant.usda").n_meshes == read(source).n_meshes


def test_items_that_are_instances_themselves_keep_their_own_labels(tmp_path):
    plant(tmp_path, 1)
    bolt = f'def "bolt" ( instanceable = true\n prepend references = @./parts/bolt.usda@ ) {{ {AT.format(0)} }}'
    places = ", ".join(f"({3 * i}, 0, 0)" for i in range(5))
    source = write(
        tmp_path,
        f"""( {STAGE.format("World")} )
def Xform "World" {{ def PointInstancer "bolts" {{
    int[] protoIndices = [0, 0, 0, 0, 0]
    point3f[] positions = [{places}]
    rel prototypes = </World/bolts/kinds/bolt>
    float3[] extent = [(0, 0, 0), (13, 1, 1)]
    def Scope "kinds" {{ {bolt} }} }}
}}""",
        "bolts.usda",
    )
    graph = said(read(source), {"[0]": "bolt", "[1]": "nut", "[2]": "nut", "[3]": "washer", "[4]": None})
    stage, _ = baked(source, graph, tmp_path / "out.usda")
    assert drawn_labels(stage) == wanted(graph)


def test_prototypes_that_two_instancers_share_are_labelled_for_each(tmp_path):
    instancers = "\n".join(
        f'def PointInstancer "{name}" {{ int[] protoIndices = [0]\n point3f[] positions = [(0, {y}, 0)]\n'
        f" rel prototypes = </World/library/bolt>\n float3[] extent = [(0, {y}, 0), (1, {y + 1}, 1)] }}"
        for name, y in (("a", 0), ("b", 5))
    )
    source = write(
        tmp_path,
        f'( {STAGE.format("World")} )\ndef Xform "World" {{ {instancers}\n'
        f'  over "library" {{ def Mesh "bolt" {{ {BOX} }} }} }}',
        "plant.usda",
    )
    graph = said(read(source), {"a[0]": "bolt", "b[0]": "nut"})
    stage, _ = baked(source, graph, tmp_path / "out.usda")
    assert drawn_labels(stage) == {"/World/a[0]": ("bolt",), "/World/b[0]": ("nut",)}


def test_items_whose_prototype_changes_over_time_keep_the_label_of_most(tmp_path):
    source = plant(tmp_path / "in", 1)
    source.write_text(
        source.read_text().replace("protoIndices = [0, 1, 0, 0]", "protoIndices.timeSamples = { 1: [0, 1, 0, 0] }")
    )
    graph = said(read(source), {"points[2]": "nut"})
    stage, notes = baked(source, graph, tmp_path / "plant.usda")
    assert notes["mixed-items"].meshes == ("/World/points",)
    assert nearest(stage.GetPrimAtPath("/World/points/one")) == ("points",)


def test_geometry_units_materials_and_textures_stay(tmp_path):
    source = plant(tmp_path / "in")
    before = read(source)
    graph = said(before, {"v3/wheel": "lever", "points[2]": "nut"})
    stage, notes = baked(source, graph, tmp_path / "deep/out/plant.usdc")
    after = read(tmp_path / "deep/out/plant.usdc")
    assert after.paths == before.paths
    assert np.array_equal(after.vertices, before.vertices)
    assert (UsdGeom.GetStageMetersPerUnit(stage), UsdGeom.GetStageUpAxis(stage)) == (0.01, "Y")
    assert stage.GetDefaultPrim().GetPath() == "/World"
    for valve in ("v0", "v3"):
        texture = stage.GetPrimAtPath(f"/World/{valve}/paint/shader").GetAttribute("inputs:file").Get()
        assert texture.path == "../../in/parts/textures/rust.png"
        assert texture.resolvedPath.endswith("in/parts/textures/rust.png")
    assert "1 files stay" in notes["outside-files"].message


def test_textures_of_a_package_are_written_beside(tmp_path):
    package = tmp_path / "plant.usdz"
    assert UsdUtils.CreateNewUsdzPackage(str(plant(tmp_path / "in")), str(package))
    shutil.rmtree(tmp_path / "in")
    stage, notes = baked(package, said(read(package)), tmp_path / "out/plant.usdc")
    package.unlink()
    texture = stage.GetPrimAtPath("/World/v0/paint/shader").GetAttribute("inputs:file").Get()
    assert texture.path.startswith("./plant_files/")
    assert (tmp_path / "out" / texture.path).read_bytes() == b"png"
    assert "missing-files" not in notes


def test_a_package_writes_nothing_outside_its_folder(tmp_path):
    source = plant(tmp_path / "in", 1)
    valve = tmp_path / "in/parts/valve.usda"
    with zipfile.ZipFile(tmp_path / "in/parts/bag.usdz", "w") as archive:
        archive.writestr("../../../evil.png", b"x")
    valve.write_text(valve.read_text().replace("@./textures/rust.png@", "@./bag.usdz[../../../evil.png]@"))
    baked(source, said(read(source)), tmp_path / "out/plant.usda")
    assert not list(tmp_path.rglob("evil.png")) or list(tmp_path.rglob("evil.png")) == [
        tmp_path / "out/plant_files/evil.png"
    ]


def test_a_reference_to_the_baked_stage_brings_the_labels_along(tmp_path):
    source = plant(tmp_path / "in")
    graph = said(read(source), {"v3/wheel": "lever"})
    baked(source, graph, tmp_path / "plant.usdc")
    stage = Usd.Stage.CreateInMemory()
    for number in range(2):
        stage.DefinePrim(f"/envs/env_{number}/Plant").GetReferences().AddReference(str(tmp_path / "plant.usdc"))
    found = drawn_labels(stage)
    for path, label in wanted(graph).items():
        assert found[path.replace("/World", "/envs/env_1/Plant", 1)] == label


def test_the_bytes_repeat_and_the_source_stays(tmp_path):
    source = plant(tmp_path / "in")
    before = source.read_bytes()
    graph = said(read(source), {"v3/wheel": "lever", "points[2]": "nut"})
    for suffix in ("usda", "usdc"):
        contents = {
            write_baked(read(source), graph, source, tmp_path / f"out/plant.{suffix}")[0].read_bytes() for _ in "12"
        }
        assert len(contents) == 1
    assert b"/tmp" not in (tmp_path / "out/plant.usda").read_bytes()
    assert source.read_bytes() == before
    with pytest.raises(OutputError, match="source itself"):
        write_baked(read(source), graph, source, source)


def test_a_source_that_is_not_usd_is_baked_with_its_geometry(tmp_path):
    scene = graphs.boxes(["/tank/shell", "/tank"], format="step")
    graph = said(scene, {"/tank": "tank"})
    file, _ = write_baked(scene, graph, tmp_path / "tank.step", tmp_path / "tank.usdc")
    stage = Usd.Stage.Open(str(file))
    assert drawn_labels(stage) == {"/World/tank/mesh": ("tank",), "/World/tank/shell": ("shell",)}


def test_a_stage_without_a_default_prim_gets_its_only_root(tmp_path):
    source = write(tmp_path, f'def Xform "Only" {{ def Mesh "box" {{ {BOX} }} }}', "plant.usda")
    stage, _ = baked(source, said(read(source)), tmp_path / "out.usda")
    assert stage.GetDefaultPrim().GetPath() == "/Only"
    source = write(
        tmp_path,
        "".join(f'def Mesh "{name}" {{ {BOX} {AT.format(x)} }}' for name, x in (("a", 0), ("b", 3))),
        "two.usda",
    )
    _, notes = baked(source, said(read(source)), tmp_path / "out.usda")
    assert "2 roots" in notes["no-default-prim"].message


def test_validators_find_nothing_that_the_source_has_not(tmp_path):
    source = plant(tmp_path / "in")
    baked(source, said(read(source), {"v3/wheel": "lever", "points[2]": "nut"}), tmp_path / "plant.usdc")
    registry = UsdValidation.ValidationRegistry()
    found = {}
    for file in (source, tmp_path / "plant.usdc"):
        context = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators())
        errors = context.Validate(Usd.Stage.Open(str(file)))
        found[file.suffix] = {(str(e.GetIdentifier()), e.GetMessage().split("/World")[0]) for e in errors}
    assert found[".usdc"] <= found[".usda"]


# Taxonomies


def valve_with_wheel(affordances=("turn",)):
    """The graph of a valve whose wheel turns and of a gauge with a face, over boxes."""
    scene = graphs.boxes(["/World/body", "/World/wheel", "/World/case", "/World/face"], format="step")
    named = [("Valve assembly", "valve body"), ("Valve assembly", "handwheel"), ("Gauge assembly", "gauge case")]
    parts = [
        graphs.part(i, path, label=graphs.label(*name))
        for i, (path, name) in enumerate(zip(scene.paths, [*named, ("Gauge assembly", "gauge face")], strict=True))
    ]
    wheel = Mechanism(
        kind="handwheel", meshes=("/World/wheel",), axis=(0, 0, 1), pivot=(0, 0, 0), radius=0.1, limits=(-3600, 0)
    )
    valve = graphs.unit("V-001", "part-0", "part-1").model_copy(
        update={"affordances": affordances, "mechanism": wheel if affordances else None}
    )
    gauge = graphs.unit("G-001", "part-2", "part-3", unit_type="gauge").model_copy(
        update={"affordances": ("read",) if affordances else ()}
    )
    return scene, graphs.graph([*parts, valve, gauge])


@pytest.mark.parametrize("bake", [False, True])
def test_category_and_disposition_stand_beside_class(tmp_path, bake):
    scene, graph = valve_with_wheel()
    write = (lambda *these: write_baked(*these)[0]) if bake else write_semantics
    stage = Usd.Stage.Open(str(write(scene, graph, tmp_path / "plant.step", tmp_path / "out.usda")))
    of = {prim.GetDisplayName() or prim.GetName(): get_labels(prim) for prim in stage.Traverse()}
    assert of["wheel"] == {
        "class": ["handwheel"],
        "cad_group": ["Valve assembly"],
        "category": ["Valve assembly", "handwheel"],
        "disposition": ["turnable", "graspable"],
    }
    assert of["face"]["disposition"] == ["readable"]
    assert "disposition" not in of["body"] | of["case"]
    units = {prim.GetName(): get_labels(prim) for prim in stage.GetPrimAtPath("/CadGraph/Units").GetChildren()}
    assert units["V_001"]["disposition"] == ["turnable", "graspable"]
    assert units["G_001"]["disposition"] == ["readable"]


def test_who_reads_class_alone_reads_the_same_with_and_without_the_others(tmp_path):
    found = []
    for affordances in ((), ("turn",)):
        scene, graph = valve_with_wheel(affordances)
        folder = tmp_path / f"out{len(found)}"
        layer = write_semantics(scene, graph, tmp_path / "plant.step", folder / "semantics.usda")
        stage = Usd.Stage.Open(str(layer))
        # One token each, so that readers that join several see none changed.
        found.append(drawn_labels(stage))
    assert found[0] == found[1]
    assert all(len(labels) == 1 for labels in found[0].values())


# The format


def test_the_layer_and_the_stage_are_formats_of_their_own(tmp_path):
    source = plant(tmp_path / "in")
    graph = said(read(source))
    over = write_export(graph, "usd", tmp_path / "a", source)
    whole = write_export(graph, "usd", tmp_path / "a", source, bake=True)
    assert [file.name for file in over.files] == ["semantics.usda"]
    assert [file.name for file in whole.files] == ["baked.usdc"]
    assert write_export(graph, "usd", tmp_path / "b/x.usda", source, bake=True).files[0].name == "x.usda"
    with pytest.raises(ValueError, match="goes with --bake"):
        write_export(graph, "usd", tmp_path / "c", source, open_instances=True)
    with pytest.raises(ValueError, match="--bake"):
        write_export(graph, "csv", tmp_path / "c", bake=True)


# A real scene with payloads, instances and point instancers


@pytest.mark.slow
@pytest.mark.skipif(not TEAPOTS.exists(), reason="no further real files here")
def test_every_mesh_of_a_real_scene_has_its_own_label(tmp_path):
    delegate = UsdUtils.CoalescingDiagnosticDelegate()
    # Its assets are in a folder beside that of the scene, which the graph keeps.
    scene = read(TEAPOTS, asset_roots=("..",))
    names = {path: f"name {number % 5}" for number, path in enumerate(scene.paths)}
    graph = said(scene, names, config={"load": {"asset_roots": [".."]}})
    file, _ = write_baked(scene, graph, TEAPOTS, tmp_path / "teapots.usdc")
    stage = Usd.Stage.Open(str(file))
    assert drawn_labels(stage) == wanted(graph)
    delegate.TakeUncoalescedDiagnostics()
