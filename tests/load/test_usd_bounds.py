"""Where a USD scene may bring files from, and how much it may grow."""

from __future__ import annotations

import os
import sys

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom, Vt

from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load
from cadgraph.load.packing import Notes
from cadgraph.load.usd_assets import find_assets
from cadgraph.load.usd_census import Census

HEAD = '#usda 1.0\n(\n defaultPrim = "L0"\n metersPerUnit = 1\n upAxis = "Z"\n{}\n)\n'
CUBE = 'def Cube "{}" {{\n}}\n'
INSTANCE = "instanceable = true\n references = </L{}>"


def write(folder, text, name="scene.usda", more=""):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_text(HEAD.format(more) + text, encoding="utf-8")
    return folder / name


def read(path, **settings):
    return load(path, LoadConfig(isolate=False, **settings))


def held(name, arc, children=""):
    return f'def "{name}" (\n {arc}\n) {{\n{children}}}\n'


def tree(levels, wide, arc, over=""):
    """Each of some prims holds the next several times."""
    text = ""
    for i in range(levels):
        below = "".join(held(f"c{j}", arc.format(i + 1), over) for j in range(wide))
        text += f'def "L{i}" {{\n{below}}}\n'
    return text + CUBE.format(f"L{levels}")


def counted(path):
    assets = find_assets(path, (), Notes())
    return Census(assets.layers, assets.below).prims(assets.root.layer.identifier)


def composed(path):
    """Prims that the library composes, prototypes of instances once."""
    stage = Usd.Stage.Open(str(path))
    roots = [stage.GetPseudoRoot(), *stage.GetPrototypes()]
    return sum(1 for root in roots for _ in Usd.PrimRange.AllPrims(root))


def notes(scene, code="outside-asset"):
    return [note for note in scene.diagnostics if note.code == code]


def beside(folder):
    """A scene of one cube of its own and one from a folder beside its own."""
    write(folder / "assets", CUBE.format("L0"), "valve.usda")
    return write(folder / "scenes", held("a", "references = @../assets/valve.usda@") + CUBE.format("own"))


def test_what_lies_outside_is_told_with_its_prim_and_the_remedy_and_not_read(tmp_path):
    scene = read(beside(tmp_path))
    assert scene.paths == ("/own",)
    (note,) = notes(scene)
    assert note.meshes == ("/a",)
    assert note.message == (
        "'../assets/valve.usda' was not opened: it lies outside the folder of the scene; "
        "give --asset-root .. (load.asset_roots) to read it"
    )
    assert not notes(scene, "missing-reference")
    assert not notes(scene, "usd-warning")
    assert Sdf.Layer.Find(str(tmp_path / "assets/valve.usda")) is None
    assert not Sdf.Layer.GetMutedLayers()


@pytest.mark.parametrize("root", ["..", "../assets"])
def test_a_folder_that_is_named_may_be_read(tmp_path, root):
    scene = read(beside(tmp_path), asset_roots=(root,))
    assert (scene.paths, notes(scene)) == (("/a", "/own"), [])


def test_alone_it_is_an_error_that_says_so(tmp_path):
    path = beside(tmp_path)
    write(tmp_path / "scenes", held("a", "references = @../assets/valve.usda@"))
    with pytest.raises(LoadError, match=r"holds no mesh to load: '../assets/valve\.usda' .* --asset-root \.\. "):
        read(path)


def test_absolute_paths_payloads_sublayers_and_variants_are_no_way_out(tmp_path):
    write(tmp_path / "out", CUBE.format("L0"), "a.usda")
    absolute = (tmp_path / "out/a.usda").as_posix()
    variant = (
        'def "v" (\n variants = {\n string s = "x"\n }\n prepend variantSets = "s"\n) {\n variantSet "s" = {\n "x" (\n'
        f" references = @{absolute}@\n ) {{\n }}\n }}\n}}\n"
    )
    text = held("p", f"payload = @{absolute}@") + held("r", f"references = @{absolute}@") + variant + CUBE.format("own")
    scene = read(write(tmp_path / "in", text, more=" subLayers = [@../out/a.usda@]"))
    assert scene.paths == ("/own",)
    assert {path for note in notes(scene) for path in note.meshes} == {"/p", "/r", "/v{s=x}"}
    # The same file, written in two ways.
    assert len(notes(scene)) == 2


def test_an_expression_is_no_way_out(tmp_path):
    write(tmp_path / "out", CUBE.format("L0"), "a.usda")
    variables = ' expressionVariables = {\n string X = "../out/a.usda"\n }'
    scene = read(write(tmp_path / "in", held("e", 'references = @`"${X}"`@') + CUBE.format("own"), more=variables))
    assert scene.paths == ("/own",)
    assert [note.meshes for note in notes(scene)] == [("/e",)]


@pytest.mark.skipif(sys.platform == "win32", reason="links need rights there")
def test_a_link_to_outside_is_no_way_out(tmp_path):
    write(tmp_path / "out", CUBE.format("L0"), "a.usda")
    path = write(tmp_path / "in", held("a", "references = @./link.usda@") + CUBE.format("own"))
    os.symlink(tmp_path / "out/a.usda", tmp_path / "in/link.usda")
    assert read(path).paths == ("/own",)
    assert read(path, asset_roots=("../out",)).paths == ("/a", "/own")


def test_an_address_is_never_opened(tmp_path):
    scene = read(write(tmp_path, held("a", "references = @https://example.org/a.usda@") + CUBE.format("own")))
    assert notes(scene)[0].message == (
        "'https://example.org/a.usda' was not opened: an address; put that file beside the scene"
    )


def test_clips_from_outside_are_refused(tmp_path):
    write(tmp_path / "out", CUBE.format("L0"), "a.usda")
    clips = (
        'clips = {\n dictionary default = {\n asset[] assetPaths = [@../out/a.usda@]\n string primPath = "/L0"\n }\n }'
    )
    with pytest.raises(LoadError, match=r"value clips of /a are in '\.\./out/a\.usda'.*--asset-root \.\. "):
        read(write(tmp_path / "in", held("a", clips) + CUBE.format("own")))


@pytest.mark.parametrize(
    "arc",
    ["references = </L{}>", "payload = </L{}>", "inherits = </L{}>", "specializes = </L{}>", INSTANCE],
)
def test_no_fewer_prims_are_counted_than_are_composed(tmp_path, arc):
    path = write(tmp_path, tree(4, 4, arc))
    assert composed(path) <= counted(path) <= 3 * composed(path)


def test_instances_that_are_opened_count_as_often_as_they_are(tmp_path):
    off = "".join(f'over "c{j}" (\n instanceable = false\n) {{\n}}\n' for j in range(4))
    path = write(tmp_path, tree(4, 4, INSTANCE, off))
    assert counted(path) >= composed(path)


def test_what_a_reference_of_a_prim_above_the_target_brings_is_counted(tmp_path):
    text = held("L0", "references = </N0/k>")
    for i in range(4):
        below = "".join(held(f"c{j}", f"references = </N{i + 1}/k>") for j in range(4))
        text += f'def "M{i}" {{\n def "k" {{\n{below}}}\n}}\n' + held(f"N{i}", f"references = </M{i}>")
    path = write(tmp_path, text + 'def "N4" {\n def Cube "k" {\n }\n}\n')
    assert counted(path) >= composed(path)


def test_of_variants_the_largest_counts(tmp_path):
    small = "".join(f'def "s{j}" {{\n}}\n' for j in range(3))
    large = "".join(f'def "l{j}" {{\n}}\n' for j in range(30))
    sets = f'variantSet "s" = {{\n "x" {{\n{small}}}\n "y" {{\n{large}}}\n }}\n'
    text = f'def "L0" (\n prepend variantSets = "s"\n) {{\n {sets}}}\n'
    assert 31 <= counted(write(tmp_path, text)) <= 34


@pytest.mark.parametrize(("levels", "told"), [(8, "up to 246,913,570 prims"), (5, "grow to more than [0-9,]+ prims")])
def test_references_that_multiply_are_refused_before_they_are_composed(tmp_path, levels, told):
    path = write(tmp_path, tree(levels, 10, "references = </L{}>"))
    with pytest.raises(LoadError, match=told + ".*; split the scene, or raise load.max_(prims|growth)"):
        read(path)


def test_lists_of_references_on_one_prim_multiply_too(tmp_path):
    text = held("L0", "references = [</A0_0>]")
    for i in range(8):
        listed = ", ".join(f"</A{i + 1}_{k}>" for k in range(10))
        text += "".join(held(f"A{i}_{j}", f"references = [{listed}]") for j in range(10))
    with pytest.raises(LoadError, match=r"load\.max_prims"):
        read(write(tmp_path, text))


def test_sublayers_that_multiply_are_refused(tmp_path):
    for i in range(30):
        for side in "ab":
            below = f" subLayers = [@./s{i + 1}a.usda@, @./s{i + 1}b.usda@]"
            write(tmp_path, "", f"s{i}{side}.usda", below)
    for side in "ab":
        write(tmp_path, CUBE.format("L0"), f"s30{side}.usda")
    with pytest.raises(LoadError, match=r"load\.max_prims"):
        read(tmp_path / "s0a.usda")


def test_many_circles_are_refused_and_a_single_one_is_not(tmp_path):
    n = 16
    text = "".join(
        f'def "L{i}" {{\n' + "".join(held(f"c{j}", f"references = </L{j}>") for j in range(n) if j != i) + "}\n"
        for i in range(n)
    )
    with pytest.raises(LoadError, match="lead in circles, too many to follow"):
        read(write(tmp_path, text))
    alone = 'def "L0" {\n' + held("c", "references = </L0>") + CUBE.format("own") + "}\n"
    assert "/L0/own" in read(write(tmp_path, alone)).paths


def test_instances_that_multiply_are_refused_as_they_are_gone_through(tmp_path):
    path = write(tmp_path, tree(8, 10, INSTANCE))
    with pytest.raises(LoadError, match=r"load\.max_growth"):
        read(path)
    with pytest.raises(LoadError, match=r"more than 1,000 meshes with all instances; .*load\.max_meshes"):
        read(path, max_meshes=1000)


def test_point_instancers_that_multiply_are_refused(tmp_path):
    items, places = ", ".join("0" * 10), ", ".join(f"({i}, 0, 0)" for i in range(10))
    text = "".join(
        f'def PointInstancer "L{i}" {{\n rel prototypes = </L{i + 1}>\n int[] protoIndices = [{items}]\n'
        f" point3f[] positions = [{places}]\n}}\n"
        for i in range(8)
    )
    path = write(tmp_path, text + CUBE.format("L8"))
    with pytest.raises(LoadError, match=r"kB grow to more than [\d,]+ meshes .*load\.max_growth"):
        read(path)


def test_arrays_that_unpack_to_too_much_are_refused(tmp_path):
    path = tmp_path / "faces.usdc"
    stage = Usd.Stage.CreateNew(str(path))
    mesh = UsdGeom.Mesh.Define(stage, "/m")
    mesh.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
    n = 1_500_000
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(np.full(n, 3, np.int32)))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(np.tile(np.arange(3, dtype=np.int32), n)))
    stage.Save()
    with pytest.raises(LoadError, match=r"kB unpack to more than [\d,]+ triangles.*load\.max_growth"):
        read(path)


def test_triangles_have_limits(tmp_path):
    path = write(tmp_path, tree(1, 10, INSTANCE))
    assert read(path).n_meshes == 11
    with pytest.raises(LoadError, match=r"more than 100 triangles with all instances; .*load\.max_placed_triangles"):
        read(path, max_placed_triangles=100)
