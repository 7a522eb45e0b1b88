"""COLLADA: units and axes from the file, nodes by name, polygons of any kind."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import shapes
from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load

pytest.importorskip("collada")
BOX = shapes.box((1, 2, 3))
DATA = Path(__file__).parents[2] / "../shared/data/mesh"
ASSET = '<unit name="inch" meter="0.0254"/><up_axis>Z_UP</up_axis>'
QUADS = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]


def triangles(faces=BOX[1], symbol="paint"):
    indices = " ".join(map(str, np.ravel(faces)))
    return (
        f'<triangles count="{len(faces)}" material="{symbol}"><input semantic="VERTEX" source="#v" offset="0"/>'
        f"<p>{indices}</p></triangles>"
    )


def polylist(faces):
    counts = " ".join(str(len(face)) for face in faces)
    indices = " ".join(str(i) for face in faces for i in face)
    return (
        f'<polylist count="{len(faces)}" material="paint"><input semantic="VERTEX" source="#v" offset="0"/>'
        f"<vcount>{counts}</vcount><p>{indices}</p></polylist>"
    )


def document(primitives, nodes='<node id="n" name="Valve 1">{}</node>', asset=ASSET, points=BOX[0], shown=None):
    numbers = " ".join(f"{x:g}" for x in np.ravel(points))
    instance = shown or (
        '<instance_geometry url="#g"><bind_material><technique_common><instance_material symbol="paint" target="#m"/>'
        "</technique_common></bind_material></instance_geometry>"
    )
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2020-01-01</created><modified>2020-01-01</modified>{asset}</asset>
<library_images><image id="i" name="i"><init_from>../../secret.png</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON><technique sid="t"><lambert><diffuse><color>1 0.5 0 1</color></diffuse>
</lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m" name="Paint"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g" name="body"><mesh><source id="p"><float_array id="pa" count="{np.size(points)}">
{numbers}</float_array><technique_common><accessor source="#pa" count="{len(points)}" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common>
</source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>{primitives}</mesh></geometry>
</library_geometries>
<library_visual_scenes><visual_scene id="s">{nodes.replace("{}", instance)}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>"""


def loaded(path, text, isolate=False, **settings):
    path = path / "a.dae"
    path.write_text(text)
    return load(path, LoadConfig(isolate=isolate, **settings))


def codes(scene):
    return [note.code for note in scene.diagnostics]


def volume(scene, i=0):
    points, faces = scene.mesh(i)
    return np.linalg.det(points[faces]).sum() / 6


@pytest.mark.parametrize("isolate", [True, False])
def test_unit_axis_name_and_colour_are_those_of_the_file(tmp_path, isolate):
    scene = loaded(tmp_path, document(triangles()), isolate)
    np.testing.assert_allclose(np.ptp(scene.vertices, axis=0), np.array([1, 2, 3]) * 0.0254)
    assert scene.paths == ("/Valve_1",)
    assert scene.colors.tolist() == [[1, 0.5, 0]]
    assert [(fact.key, fact.value) for fact in scene.facts] == [("name", "Valve 1"), ("layer", "Paint")]
    assert (scene.source.meters_per_unit, scene.source.up_axis, codes(scene)) == (0.0254, "Z", [])


@pytest.mark.parametrize(("axis", "size"), [("X_UP", [2, 3, 1]), ("Y_UP", [1, 3, 2]), ("Z_UP", [1, 2, 3])])
def test_every_up_axis_becomes_z(tmp_path, axis, size):
    scene = loaded(tmp_path, document(triangles(), asset=f'<unit meter="1"/><up_axis>{axis}</up_axis>'))
    np.testing.assert_allclose(np.ptp(scene.vertices, axis=0), size)
    assert volume(scene) == pytest.approx(6)


def test_what_is_not_stated_is_as_the_standard_says(tmp_path):
    scene = loaded(tmp_path, document(triangles(), asset=""))
    assert (scene.source.meters_per_unit, scene.source.up_axis) == (1.0, "Y")
    assert codes(scene) == ["missing-units", "missing-up-axis"]


def test_a_unit_of_nothing_is_told(tmp_path):
    assert "invalid-units" in codes(loaded(tmp_path, document(triangles(), asset='<unit meter="0"/>')))


def test_polygons_are_cut_and_primitives_of_a_geometry_are_one_mesh(tmp_path):
    scene = loaded(tmp_path, document(polylist(QUADS[:3]) + polylist(QUADS[3:]), asset='<unit meter="1"/>'))
    assert (scene.n_meshes, scene.n_triangles, len(scene.vertices)) == (1, 12, 8)
    assert volume(scene) == pytest.approx(6)


def test_transforms_of_nodes_add_up_and_library_nodes_are_placed(tmp_path):
    nodes = '<node id="line" name="Line"><translate>10 0 0</translate><node id="n"><rotate>0 0 1 90</rotate>{}</node>'
    nodes += '<node id="mirror" name="Mirror"><scale>-1 1 1</scale>{}</node></node><node name="Copy">'
    nodes += '<translate>0 0 50</translate><instance_node url="#line"/></node>'
    asset = '<unit meter="1"/><up_axis>Z_UP</up_axis>'
    scene = loaded(tmp_path, document(triangles(), nodes, asset))
    assert scene.paths == ("/Copy/Line/Mirror", "/Copy/Line/n", "/Line/Mirror", "/Line/n")
    middles = [scene.mesh(i)[0].mean(axis=0) for i in range(4)]
    np.testing.assert_allclose(middles, [[10, 0, 50], [10, 0, 50], [10, 0, 0], [10, 0, 0]], atol=1e-5)
    np.testing.assert_allclose(np.ptp(scene.mesh(3)[0], axis=0), [2, 1, 3], atol=1e-5)
    assert [volume(scene, i) > 0 for i in range(4)] == [True] * 4


def test_lines_and_broken_parts_are_told(tmp_path):
    lines = '<lines count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1</p></lines>'
    scene = loaded(tmp_path, document(triangles() + lines))
    assert codes(scene) == ["no-surface"]
    broken = triangles().replace("#v", "#gone")
    with pytest.raises(LoadError, match=r"holds no triangle .*something that can't be read"):
        loaded(tmp_path, document(broken))


def test_pictures_are_not_opened_and_nothing_is_printed(tmp_path, capfd):
    (tmp_path / "in").mkdir()
    (tmp_path / "secret.png").write_text("no picture")
    assert loaded(tmp_path / "in", document(triangles())).n_triangles == 12
    assert capfd.readouterr() == ("", "")


def test_nodes_that_multiply_are_refused(tmp_path):
    nodes = '<node id="n0" name="n">{}</node>' + "".join(
        f'<node id="n{i}">' + f'<instance_node url="#n{i - 1}"/>' * 10 + "</node>" for i in range(1, 6)
    )
    with pytest.raises(LoadError, match=r"more than 1,000 meshes .*; split the scene, or raise load.max_meshes"):
        loaded(tmp_path, document(triangles(), nodes), max_meshes=1000)


@pytest.mark.parametrize(("change", "reason"), [
    (("</COLLADA>", ""), "cut short"), (("<COLLADA", "<KOLLADA"), "no COLLADA file|not readable"),
    (("</mesh>", "</meesh>"), "not readable as COLLADA"), (("#s", "#none"), "holds no triangle|not readable"),
    (("0 1 3", "0 1 99"), "holds no triangle|not readable"), (("-0.5 -1", "-0.5 oops"), "no triangle|not readable"),
])  # fmt: skip
def test_damaged_files_end_in_one_line(tmp_path, change, reason):
    with pytest.raises(LoadError, match=reason) as caught:
        loaded(tmp_path, document(triangles()).replace(*change))
    assert "\n" not in str(caught.value)


@pytest.mark.skipif(not DATA.is_dir(), reason="no real files here")
def test_real_files_have_the_size_that_trimesh_finds_times_their_unit():
    trimesh = pytest.importorskip("trimesh")
    found = sorted(DATA.rglob("*.dae"))
    assert found
    for path in found:
        scene = load(path, LoadConfig(isolate=False))
        other = trimesh.load_scene(path, process=False)
        assert scene.source.up_axis == "Z"
        expected = other.extents * scene.source.meters_per_unit
        np.testing.assert_allclose(np.ptp(scene.vertices, axis=0), expected, rtol=1e-5)
        assert 0.05 < expected.max() < 30
