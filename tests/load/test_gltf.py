"""glTF: what every way of storing it comes to, what is left out, and what is refused."""

from __future__ import annotations

import importlib
import json
import sys
from pathlib import Path

import numpy as np
import pytest

import shapes
from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError, MissingExtra
from cadgraph.load import load
from cadgraph.load.packing import Z_UP_FROM
from cadgraph.model.facts import Fact
from load.gltf_files import GltfFile

IN_PROCESS = LoadConfig(isolate=False)
DATA = Path(__file__).parents[2] / "../shared/data/formats"
BOX = shapes.box((1, 2, 3))
# glTF is Y up: what is 2 along its y is 2 along z here.
SIZES = [1, 3, 2]


def plain(**node):
    file = GltfFile()
    file.node(mesh=file.mesh(BOX), **({"name": "box"} | node))
    return file


def loaded(path, **settings):
    return load(path, LoadConfig(isolate=False, **settings))


def codes(scene):
    return [note.code for note in scene.diagnostics]


def extent(scene):
    return np.ptp(scene.vertices, axis=0)


def volume(scene, i=0):
    points, faces = scene.mesh(i)
    return np.linalg.det(points[faces]).sum() / 6


def test_a_box_is_turned_to_z_up_and_faces_outward(tmp_path):
    scene = loaded(plain().glb(tmp_path / "a.glb"))
    assert scene.paths == ("/box",)
    np.testing.assert_allclose(extent(scene), SIZES)
    assert volume(scene) == pytest.approx(6)
    assert (scene.source.meters_per_unit, scene.source.up_axis, scene.source.format) == (1.0, "Y", "gltf")
    assert (scene.source.unit_stated, scene.source.up_stated, codes(scene)) == (True, True, [])


@pytest.mark.parametrize("isolate", [True, False])
def test_buffers_beside_the_file_and_within_it_are_the_same(tmp_path, isolate):
    file = plain()
    inside = load(file.gltf(tmp_path / "inside.gltf"), LoadConfig(isolate=isolate))
    (tmp_path / "my data").mkdir()
    (tmp_path / "my data/box.bin").write_bytes(file.data)
    beside = load(file.gltf(tmp_path / "beside.gltf", uri="my%20data/box.bin"), LoadConfig(isolate=isolate))
    np.testing.assert_array_equal(inside.vertices, beside.vertices)
    np.testing.assert_array_equal(inside.faces, beside.faces)


@pytest.mark.parametrize("uri", ["../box.bin", "/tmp/box.bin", "C:\\box.bin", "http://host/box.bin", "file:///box.bin"])
def test_buffers_elsewhere_are_not_opened(tmp_path, uri):
    (tmp_path / "in").mkdir()
    file = plain()
    (tmp_path / "box.bin").write_bytes(file.data)
    with pytest.raises(LoadError, match=r"a\.gltf: refers to .*put that file (beside it|there)"):
        loaded(file.gltf(tmp_path / "in/a.gltf", uri=uri))


def test_a_link_to_outside_is_not_followed(tmp_path):
    (tmp_path / "in").mkdir()
    file = plain()
    (tmp_path / "box.bin").write_bytes(file.data)
    (tmp_path / "in/box.bin").symlink_to(tmp_path / "box.bin")
    with pytest.raises(LoadError, match="a link to outside its folder"):
        loaded(file.gltf(tmp_path / "in/a.gltf", uri="box.bin"))


def test_missing_and_short_buffers_are_told(tmp_path):
    file = plain()
    with pytest.raises(LoadError, match=r"refers to 'box\.bin', which is not there"):
        loaded(file.gltf(tmp_path / "a.gltf", uri="box.bin"))
    (tmp_path / "box.bin").write_bytes(file.data[:-4])
    with pytest.raises(LoadError, match=r"buffer 0 has .* bytes, cut short"):
        loaded(tmp_path / "a.gltf")


@pytest.mark.parametrize(("dtype", "normalized", "scale"), [
    ("i1", True, 127), ("i2", True, 32767), ("u2", True, 65535), ("u1", True, 255), ("i1", False, 1), ("u2", False, 1),
])  # fmt: skip
def test_quantized_points_are_those_of_floats(tmp_path, dtype, normalized, scale):
    file = GltfFile()
    points = (BOX[0] + BOX[0].max(axis=0)) * 20  # 0, 20 ... 60
    stored = np.rint(points)
    row = {"normalized": True} if normalized else {}
    mesh = file.mesh(BOX)
    file.tree["meshes"][mesh]["primitives"][0]["attributes"]["POSITION"] = file.accessor(stored, dtype, **row)
    file.node(mesh=mesh, name="box", scale=[scale / 20] * 3)
    file.uses("KHR_mesh_quantization", required=True)
    scene = loaded(file.glb(tmp_path / "a.glb"))
    np.testing.assert_allclose(extent(scene), SIZES, rtol=1e-9)
    # One step is 5 cm.
    assert codes(scene) == ["coarse-points"]
    assert "50 mm" in scene.diagnostics[0].message


def test_a_fine_grid_is_no_note(tmp_path):
    file = GltfFile()
    mesh = file.mesh(BOX)
    points = file.accessor(np.rint(BOX[0] * 10_000), "i2", normalized=True)
    file.tree["meshes"][mesh]["primitives"][0]["attributes"]["POSITION"] = points
    file.node(mesh=mesh, scale=[3.2767] * 3)
    scene = loaded(file.glb(tmp_path / "a.glb"))
    np.testing.assert_allclose(extent(scene), SIZES, rtol=1e-9)
    assert codes(scene) == []


def test_sparse_accessors_replace_points(tmp_path):
    file = plain()
    position = file.tree["accessors"][0]
    position["sparse"] = {
        "count": 2,
        "indices": {"bufferView": file.view(np.array([0, 3], "<u2")), "componentType": 5123},
        "values": {"bufferView": file.view(np.array([[-9, -1, -1.5], [-0.5, 1, 9]], "<f4"))},
    }
    assert extent(loaded(file.glb(tmp_path / "a.glb"))) == pytest.approx([9.5, 10.5, 2])


def test_strips_and_fans_wind_like_triangles(tmp_path):
    file = GltfFile()
    corners = [[0, 0, 0], [1, 0, 0], [0, 0, -1], [1, 0, -1], [0, 0, -2], [1, 0, -2]]
    file.node(name="strip", mesh=file.mesh((corners, range(6)), mode=5))
    file.node(name="fan", mesh=file.mesh(([[0, 0, 0], [1, 0, 0], [1, 0, -1], [0, 0, -1]], range(4)), mode=6))
    scene = loaded(file.glb(tmp_path / "a.glb"))
    areas = []
    for i in range(2):
        points, faces = scene.mesh(i)
        a, b, c = (points[faces[:, k]] for k in range(3))
        areas.append(np.cross(b - a, c - a).sum(axis=0) / 2)
        assert (np.cross(b - a, c - a)[:, 2] > 0).all()
    np.testing.assert_allclose(areas, [[0, 0, 1], [0, 0, 2]], atol=1e-12)


def test_points_and_lines_are_left_out_with_a_note(tmp_path):
    file = plain()
    file.node(name="edges", mesh=file.mesh((BOX[0], [0, 1]), mode=1))
    scene = loaded(file.glb(tmp_path / "a.glb"))
    assert scene.paths == ("/box",)
    assert codes(scene) == ["empty-mesh", "no-surface"]


def test_primitives_of_a_mesh_are_one_mesh_of_the_main_colour(tmp_path):
    file = GltfFile()
    mesh = file.mesh(BOX, shapes.box((0.1, 0.1, 0.1)), BOX)
    red = {"baseColorFactor": [1, 0, 0, 1]}
    file.add("materials", name="Paint", pbrMetallicRoughness=red)
    glossy = {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0, 0, 1, 1]}}
    file.add("materials", name="Glass", extensions=glossy)
    for primitive, material in zip(file.tree["meshes"][mesh]["primitives"], (1, 0, 1), strict=True):
        primitive["material"] = material
    file.node(mesh=mesh)
    scene = loaded(file.glb(tmp_path / "a.glb"))
    # Nodes without a name take that of their mesh. Points in one place are one: two of the boxes are the same.
    assert (scene.paths, scene.n_triangles, len(scene.vertices)) == (("/shape",), 36, 16)
    np.testing.assert_array_equal(scene.colors, [[0, 0, 1]])
    assert scene.facts == (Fact("/shape", "layer", "Glass", "material"), Fact("/shape", "layer", "Paint", "material"))


def test_meshes_that_share_all_points_keep_their_own(tmp_path):
    file = GltfFile()
    points = file.accessor(np.concatenate([BOX[0], BOX[0] + 100]))
    for i in range(2):
        primitive = {"attributes": {"POSITION": points}, "indices": file.accessor(np.ravel(BOX[1]) + 8 * i, "u4")}
        file.node(name=f"box{i}", mesh=file.add("meshes", primitives=[primitive]))
    scene = loaded(file.glb(tmp_path / "a.glb"))
    assert [np.ptp(scene.mesh(i)[0], axis=0).tolist() for i in range(2)] == [SIZES, SIZES]


def test_primitives_that_share_all_points_take_them_once(tmp_path):
    file = GltfFile()
    points = file.accessor(np.concatenate([BOX[0], BOX[0] + 100]))
    primitives = [
        {"attributes": {"POSITION": points}, "indices": file.accessor(np.ravel(BOX[1]) + 8 * i, "u4")} for i in (0, 1)
    ]
    file.node(name="boxes", mesh=file.add("meshes", primitives=primitives))
    scene = loaded(file.glb(tmp_path / "a.glb"))
    assert (len(scene.vertices), scene.n_triangles, volume(scene)) == (16, 24, pytest.approx(12, rel=1e-4))


def test_primitives_without_bound_are_left_out(tmp_path, monkeypatch):
    monkeypatch.setattr(importlib.import_module("cadgraph.load.gltf_mesh"), "MAX_TRIANGLES", 100)
    file = plain()
    file.node(name="many", mesh=file.add("meshes", primitives=file.tree["meshes"][0]["primitives"] * 9))
    scene = loaded(file.glb(tmp_path / "a.glb"))
    assert (scene.paths, codes(scene)) == (("/box",), ["broken-mesh", "empty-mesh"])


def test_gpu_instances_are_meshes_of_their_own(tmp_path):
    file = plain(name="bolt", translation=[0, 0, 100])
    attributes = {
        "TRANSLATION": file.accessor([[0, 0, 0], [10, 0, 0], [0, 20, 0]]),
        "ROTATION": file.accessor([[0, 0, 0, 32767], [0, 0, 0, 32767], [0, 0, 23170, 23170]], "i2", normalized=True),
        "SCALE": file.accessor([[1, 1, 1], [2, 2, 2], [1, 1, 1]]),
    }
    file.tree["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": attributes}}
    file.uses("EXT_mesh_gpu_instancing", required=True)
    scene = loaded(file.glb(tmp_path / "a.glb"))
    assert scene.paths == ("/bolt/instance_1", "/bolt/instance_2", "/bolt/instance_3")
    middles = [scene.mesh(i)[0].mean(axis=0) for i in range(3)]
    np.testing.assert_allclose(middles, [[0, -100, 0], [10, -100, 0], [0, -100, 20]], atol=1e-3)
    sizes = [np.ptp(scene.mesh(i)[0], axis=0) for i in range(3)]
    np.testing.assert_allclose(sizes, [[1, 3, 2], [2, 6, 4], [2, 3, 1]], atol=1e-3)


def test_draco_gives_the_same_box(tmp_path):
    draco = pytest.importorskip("DracoPy")
    file = plain()
    primitive = file.tree["meshes"][0]["primitives"][0]
    packed = draco.encode(BOX[0].astype(np.float32), BOX[1].astype(np.uint32), quantization_bits=16)
    extension = {"bufferView": file.view(packed), "attributes": {"POSITION": 0}}
    primitive["extensions"] = {"KHR_draco_mesh_compression": extension}
    for key in ("bufferView",):
        del file.tree["accessors"][0][key]
    file.uses("KHR_draco_mesh_compression", required=True)
    scene = loaded(file.glb(tmp_path / "a.glb"))
    np.testing.assert_allclose(extent(scene), SIZES, atol=1e-3)
    assert volume(scene) == pytest.approx(6, rel=1e-3)


@pytest.mark.parametrize("isolate", [True, False])
def test_without_the_library_draco_names_its_extra(tmp_path, monkeypatch, isolate):
    file = plain()
    extension = {"bufferView": file.view(b"DRACO"), "attributes": {"POSITION": 0}}
    file.tree["meshes"][0]["primitives"][0]["extensions"] = {"KHR_draco_mesh_compression": extension}
    path = file.glb(tmp_path / "a.glb")
    if isolate:
        (tmp_path / "hidden").mkdir()
        (tmp_path / "hidden/DracoPy.py").write_text("raise ImportError('not here')")
        monkeypatch.syspath_prepend(str(tmp_path / "hidden"))
    else:
        monkeypatch.setitem(sys.modules, "DracoPy", None)
    with pytest.raises(MissingExtra, match=r"compressed with Draco.*'\.\[draco\]'"):
        load(path, LoadConfig(isolate=isolate))


def test_broken_draco_is_left_out(tmp_path):
    pytest.importorskip("DracoPy")
    file = plain()
    file.node(name="other", mesh=file.mesh(BOX))
    extension = {"bufferView": file.view(b"DRACO no more"), "attributes": {"POSITION": 0}}
    file.tree["meshes"][0]["primitives"][0]["extensions"] = {"KHR_draco_mesh_compression": extension}
    scene = loaded(file.glb(tmp_path / "a.glb"))
    assert (scene.paths, codes(scene)) == (("/other",), ["broken-mesh", "empty-mesh"])


@pytest.mark.parametrize("name", ["EXT_meshopt_compression", "KHR_meshopt_compression"])
def test_meshopt_is_refused_with_a_remedy(tmp_path, name):
    file = plain()
    file.uses(name, required=True)
    with pytest.raises(LoadError, match=r"meshopt, which is not read; write it without: 'gltf-transform copy'"):
        loaded(file.glb(tmp_path / "a.glb"))


def test_meshopt_with_a_plain_copy_is_read_and_without_is_not(tmp_path):
    file = plain()
    file.uses("EXT_meshopt_compression")
    assert codes(loaded(file.glb(tmp_path / "a.glb"))) == []
    file.tree["buffers"] = [{}, {"byteLength": 8, "extensions": {"EXT_meshopt_compression": {"fallback": True}}}]
    with pytest.raises(LoadError, match="meshopt"):
        loaded(file.glb(tmp_path / "b.glb"))


def test_unknown_extensions_are_an_error_or_a_note(tmp_path):
    file = plain()
    file.uses("KHR_materials_clearcoat", "VENDOR_solids")
    scene = loaded(file.glb(tmp_path / "a.glb"))
    assert [(note.code, "VENDOR_solids" in note.message) for note in scene.diagnostics] == [("unknown-extension", True)]
    file.uses("VENDOR_solids", "KHR_texture_transform", required=True)
    with pytest.raises(LoadError, match="needs VENDOR_solids, which is not read"):
        loaded(file.glb(tmp_path / "a.glb"))


def test_only_the_default_scene_counts(tmp_path):
    file = plain()
    file.node(at_top=False, name="spare", mesh=0)
    scene = loaded(file.glb(tmp_path / "a.glb"))
    assert (scene.paths, codes(scene)) == (("/box",), ["outside-scene"])
    assert scene.diagnostics[0].meshes == ("/spare",)


def test_without_scenes_the_nodes_at_the_top_count(tmp_path):
    file = plain()
    file.node(name="parent", children=[0])
    del file.tree["scenes"], file.tree["scene"]
    assert loaded(file.glb(tmp_path / "a.glb")).paths == ("/parent/box",)


def test_circles_and_nodes_in_two_places_are_told(tmp_path):
    file = plain(children=[1])
    file.node(name="below", children=[0, 2], at_top=False)
    file.node(name="twice", mesh=0, at_top=False)
    file.tree["scenes"][0]["nodes"] = [0, 2]
    scene = loaded(file.glb(tmp_path / "a.glb"))
    assert scene.paths == ("/box", "/twice")
    assert {note.code for note in scene.diagnostics} == {"repeated-node"}


def test_depth_is_bounded(tmp_path):
    file = plain()
    below = 0
    for i in range(300):
        below = file.node(at_top=False, name=f"n{i}", children=[below])
    file.tree["scenes"][0]["nodes"] = [below]
    with pytest.raises(LoadError, match=r"holds no triangle that can be used \(too-deep\)"):
        loaded(file.glb(tmp_path / "a.glb"))


@pytest.mark.parametrize(
    ("limits", "told"),
    [
        ({"max_placed_triangles": 100}, "more than 100 triangles with all instances.*raise load.max_placed_triangles"),
        ({"max_meshes": 10}, "more than 10 meshes with all instances; split the scene, or raise load.max_meshes"),
        ({"max_shape_triangles": 11}, "more than 11 triangles, each shape counted once; .*load.max_shape_triangles"),
    ],
)
def test_instances_without_bound_are_refused(tmp_path, limits, told):
    file = plain()
    for i in range(12):
        file.node(name=f"n{i}", mesh=0)
    with pytest.raises(LoadError, match=told):
        loaded(file.glb(tmp_path / "a.glb"), **limits)


def test_instances_that_no_bytes_stand_for_are_refused(tmp_path):
    file = plain()
    nothing = file.add("accessors", componentType=5126, type="VEC3", count=9_000_000)
    extension = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": nothing}}}
    file.tree["nodes"][0]["extensions"] = extension
    with pytest.raises(LoadError, match="more than 5,000,000 meshes"):
        loaded(file.glb(tmp_path / "a.glb"))
    with pytest.raises(LoadError, match=r"bytes grow to more than [\d,]+ meshes .*raise load.max_growth"):
        loaded(file.glb(tmp_path / "a.glb"), max_meshes=100_000_000)


def test_one_list_of_triangles_in_many_meshes_is_refused(tmp_path):
    file = plain()
    primitive = {**file.tree["meshes"][0]["primitives"][0]}
    # Twelve triangles each: more than a million in all, of some ten bytes each.
    whole = file.add("meshes", primitives=[primitive] * 100_000)
    file.node(name="whole", mesh=whole)
    with pytest.raises(LoadError, match=r"unpack to more than .* triangles"):
        loaded(file.glb(tmp_path / "a.glb"), max_growth=0.001)


def test_hidden_nodes_are_left_out_unless_asked_for(tmp_path):
    file = plain()
    hidden = {"KHR_node_visibility": {"visible": False}}
    file.node(name="hidden", children=[file.node(at_top=False, name="lid", mesh=0)], extensions=hidden)
    path = file.glb(tmp_path / "a.glb")
    assert (loaded(path).paths, codes(loaded(path))) == (("/box",), ["hidden"])
    assert loaded(path, invisible=True).paths == ("/box", "/hidden/lid")


def test_skins_and_morphs_keep_the_shape_at_rest(tmp_path):
    file = plain(skin=0)
    file.tree["meshes"][0]["primitives"][0]["targets"] = [{"POSITION": 0}]
    scene = loaded(file.glb(tmp_path / "a.glb"))
    assert codes(scene) == ["morphed-mesh", "skinned-mesh"]
    np.testing.assert_allclose(extent(scene), SIZES)


def test_extras_that_tell_something_become_facts(tmp_path):
    file = plain(name="Pump 1/A", extras={"Tag_Number": "P-101", "DN": 50, "colour": "red", "ok": True, "Type": {}})
    path = file.glb(tmp_path / "a.glb")
    assert loaded(path).facts == (
        Fact("/Pump_1_A", "name", "Pump 1/A", "node.name"),
        Fact("/Pump_1_A", "tag", "P-101", "extras.Tag_Number"),
        Fact("/Pump_1_A", "size", "50", "extras.DN"),
    )
    assert loaded(path, metadata="off").facts == ()


def test_white_is_what_a_material_without_colour_is_unless_it_has_a_picture(tmp_path):
    file = GltfFile()
    file.add("materials")
    file.add("materials", pbrMetallicRoughness={"baseColorTexture": {"index": 0}})
    for material in (0, 1):
        file.node(name=f"m{material}", mesh=file.mesh(BOX, material=material))
    colors = loaded(file.glb(tmp_path / "a.glb")).colors
    assert colors[0].tolist() == [1, 1, 1]
    assert np.isnan(colors[1]).all()


def test_colours_of_points_count(tmp_path):
    file = plain()
    color = file.accessor(np.tile([255, 0, 0, 255], (8, 1)), "u1", normalized=True)
    file.tree["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = color
    np.testing.assert_allclose(loaded(file.glb(tmp_path / "a.glb")).colors, [[1, 0, 0]])


def test_what_cannot_be_read_of_a_mesh_is_left_out(tmp_path):
    file = plain()
    for i in range(5):
        file.node(name=f"bad{i}", mesh=file.mesh(BOX))
    primitives = [mesh["primitives"][0] for mesh in file.tree["meshes"]]
    file.tree["accessors"][primitives[1]["attributes"]["POSITION"]]["count"] = 1_000_000
    file.tree["bufferViews"][file.tree["accessors"][primitives[2]["indices"]]["bufferView"]]["byteStride"] = 0
    primitives[3]["indices"] = 99
    primitives[4]["mode"] = 7
    primitives[5]["attributes"] = "none"
    scene = loaded(file.glb(tmp_path / "a.glb"))
    assert scene.paths == ("/box",)
    assert codes(scene).count("broken-mesh") == 5


def test_single_bad_triangles_are_dropped(tmp_path):
    file = GltfFile()
    points = np.concatenate([BOX[0], [[np.nan, 0, 0]]])
    file.node(name="box", mesh=file.mesh((points, [*BOX[1].tolist(), [0, 1, 8], [0, 1, 99], [0, 0, 1]])))
    scene = loaded(file.glb(tmp_path / "a.glb"))
    assert (scene.n_triangles, codes(scene)) == (12, ["invalid-indices", "invalid-points"])


@pytest.mark.parametrize(("data", "reason"), [
    (b"glTF" + bytes(16), "container version 0"),
    (b"glTF\2\0\0\0\x14\0\0\0\xff\0\0\0JSON", "255 bytes at byte 12 is cut short"),
    (b"glTF\2\0\0\0\xff\0\0\0", "cut short .20 of 255 bytes|cut short .12 of 255 bytes"),
    (b"{" + b'"a":[' * 100_000, "nested too deep|not readable as glTF"),
    (b"{}", "holds no triangle"),
    (b"[]", "no glTF file"),
    (b'{"asset":{"version":"1.0"}}', "glTF version '1.0' is not read"),
    (b'{"nodes":[{"mesh":0}],"meshes":[3],"scenes":[{"nodes":[0,7,"x"]}]}', "holds no triangle .*broken-node"),
])  # fmt: skip
def test_damaged_files_end_in_one_line(tmp_path, data, reason):
    path = tmp_path / "a.glb"
    path.write_bytes(data)
    with pytest.raises(LoadError, match=reason) as caught:
        load(path, IN_PROCESS)
    assert "\n" not in str(caught.value)


def test_cut_files_are_told_before_reading(tmp_path):
    path = plain().glb(tmp_path / "a.glb")
    path.write_bytes(path.read_bytes()[:-100])
    with pytest.raises(LoadError, match="cut short"):
        load(path)


@pytest.mark.skipif(not DATA.is_dir(), reason="no real files here")
@pytest.mark.parametrize(("name", "n"), [("CookieFactoryMixer", 4), ("CookieFactoryWaterTank", 21), ("engine", 67)])
def test_real_files_have_the_boxes_that_trimesh_finds(name, n):
    trimesh = pytest.importorskip("trimesh")
    path = DATA / f"{name}.glb"
    scene = load(path, IN_PROCESS)
    other = trimesh.load_scene(path, process=False)
    (x0, y0, z0), (x1, y1, z1) = other.bounds
    assert scene.n_meshes == n
    np.testing.assert_allclose(scene.vertices.min(axis=0), [x0, -z1, y0], rtol=1e-6, atol=1e-6)
    np.testing.assert_allclose(scene.vertices.max(axis=0), [x1, -z0, y1], rtol=1e-6, atol=1e-6)


def twin(scene, how):
    """The meshes of a scene anew, a node each, or one node with all its instances for those of one shape."""
    file = GltfFile()
    alike = {}
    for i, path in enumerate(scene.paths):
        points, faces = scene.mesh(i)
        # Back to Y up, about the first point, so that instances are the same to the micrometre.
        points = points @ Z_UP_FROM["Y"].T
        start = points[0].copy()
        key = (np.round(points - start, 5).tobytes(), faces.tobytes()) if how == "instanced" else i
        alike.setdefault(key, (path, points - start, faces, []))[3].append(start)
    for path, points, faces, starts in alike.values():
        mesh = file.add("meshes", primitives=[{"indices": file.accessor(np.ravel(faces), "u4")}])
        primitive = file.tree["meshes"][mesh]["primitives"][0]
        scale = 1.0
        if how == "quantized":
            scale = float(np.abs(points).max())
            primitive["attributes"] = {
                "POSITION": file.accessor(np.rint(points / scale * 32767), "i2", normalized=True)
            }
        else:
            primitive["attributes"] = {"POSITION": file.accessor(points)}
        if how == "draco":
            import DracoPy

            packed = DracoPy.encode(points.astype(np.float32), faces.astype(np.uint32), quantization_bits=20)
            extension = {"bufferView": file.view(packed), "attributes": {"POSITION": 0}}
            primitive["extensions"] = {"KHR_draco_mesh_compression": extension}
        if how == "instanced":
            attributes = {"TRANSLATION": file.accessor(starts)}
            extensions = {"EXT_mesh_gpu_instancing": {"attributes": attributes}}
            file.node(name=path, mesh=mesh, extensions=extensions)
        else:
            file.node(name=path, mesh=mesh, translation=starts[0].tolist(), scale=[scale] * 3)
    return file


@pytest.mark.slow
@pytest.mark.skipif(not DATA.is_dir(), reason="no real files here")
@pytest.mark.parametrize("how", ["plain", "quantized", "draco", "instanced"])
def test_twins_of_a_real_file_have_the_same_boxes(tmp_path, how):
    if how == "draco":
        pytest.importorskip("DracoPy")
    scene = load(DATA / "engine.glb", IN_PROCESS)
    file = twin(scene, how)
    assert (len(file.tree["nodes"]) < 67) == (how == "instanced")
    other = load(file.gltf(tmp_path / "a.gltf"), IN_PROCESS)
    assert other.n_meshes == scene.n_meshes == 67

    def boxes(of):
        found = [np.concatenate([p.min(axis=0), p.max(axis=0)]) for p, _ in (of.mesh(i) for i in range(of.n_meshes))]
        # Sorted, as instances have other names; rounded, so that noise does not change the order.
        return np.array(sorted(found, key=lambda box: np.round(box, 1).tolist()))

    size = np.ptp(scene.vertices, axis=0).max()
    np.testing.assert_allclose(boxes(other), boxes(scene), atol=size * 2e-5)


def test_the_json_of_a_written_file_is_what_it_says(tmp_path):
    # The writer of these tests must write what the format says, or they show nothing.
    data = plain().glb(tmp_path / "a.glb").read_bytes()
    length = int.from_bytes(data[12:16], "little")
    assert json.loads(data[20 : 20 + length])["nodes"] == [{"mesh": 0, "name": "box"}]
    trimesh = pytest.importorskip("trimesh")
    np.testing.assert_allclose(trimesh.load_scene(tmp_path / "a.glb", process=False).extents, [1, 2, 3])
