"""3MF: units, the tree of components, colours, and what a package may cost."""

from __future__ import annotations

import importlib
import itertools
import zipfile
from pathlib import Path

import numpy as np
import pytest

import shapes
from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load
from cadgraph.model.facts import Fact

BOX = shapes.box((1, 2, 3))
COUNTER = Path(__file__).parents[2] / "../shared/data/formats/counterXP.3mf"
CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
PRODUCTION = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06"


def mesh(first="", points=BOX[0], faces=BOX[1]):
    vertices = "".join(f'<vertex x="{x:g}" y="{y:g}" z="{z:g}"/>' for x, y, z in points)
    triangles = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}" {first}/>' for a, b, c in faces)
    return f"<mesh><vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh>"


def model(resources, items, unit=' unit="millimeter"'):
    return (
        f'<?xml version="1.0"?><model{unit} xmlns="{CORE}" xmlns:p="{PRODUCTION}"><resources>{resources}</resources>'
        f"<build>{items}</build></model>"
    )


def write(path, content, **parts):
    path = path / "a.3mf"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as package:
        package.writestr("3D/3dmodel.model", content)
        for name, part in parts.items():
            package.writestr(f"3D/Objects/{name}.model", part)
    return path


def loaded(path, *content, **parts):
    return load(write(path, *content, **parts), LoadConfig(isolate=False))


def codes(scene):
    return [note.code for note in scene.diagnostics]


ONE = f'<object id="1" name="Bolt M8" type="model">{mesh()}</object>'
ITEM = '<item objectid="1"/>'


@pytest.mark.parametrize(("unit", "metres"), [
    ("", 0.001), (' unit="millimeter"', 0.001), (' unit="inch"', 0.0254), (' unit="micron"', 1e-6),
    (' unit="meter"', 1.0), (' unit="foot"', 0.3048), (' unit="centimeter"', 0.01),
])  # fmt: skip
def test_the_unit_is_applied(tmp_path, unit, metres):
    scene = loaded(tmp_path, model(ONE, ITEM, unit))
    np.testing.assert_allclose(np.ptp(scene.vertices, axis=0), np.array([1, 2, 3]) * metres)
    assert (scene.source.meters_per_unit, scene.source.unit_stated) == (metres, True)


def test_an_unknown_unit_is_told(tmp_path):
    assert "invalid-units" in codes(loaded(tmp_path, model(ONE, ITEM, ' unit="furlong"')))


def test_items_and_components_are_placed_one_below_the_other(tmp_path):
    group = '<object id="2" name="Skid"><components>' + "".join(
        f'<component objectid="1" transform="1 0 0 0 1 0 0 0 1 {x} 0 0"/>' for x in (0, 10)
    )
    items = '<item objectid="2" transform="0 1 0 -1 0 0 0 0 1 0 0 100"/><item objectid="1"/>'
    scene = loaded(tmp_path, model(f"{ONE}{group}</components></object>", items, ' unit="meter"'))
    assert scene.paths == ("/Bolt_M8", "/Skid/Bolt_M8", "/Skid/Bolt_M8_1")
    middles = [scene.mesh(i)[0].mean(axis=0) for i in range(3)]
    np.testing.assert_allclose(middles, [[0, 0, 0], [0, 0, 100], [0, 10, 100]], atol=1e-12)
    assert Fact("/Skid/Bolt_M8", "name", "Bolt M8", "object name") in scene.facts


def test_every_instance_of_nested_components_counts(tmp_path):
    # Of these 1,000 some readers place a hundred.
    levels = "".join(
        f'<object id="{i + 1}" name="level{i}"><components>'
        + "".join(f'<component objectid="{i}" transform="1 0 0 0 1 0 0 0 1 {5 * 10**i * k} 0 0"/>' for k in range(10))
        + "</components></object>"
        for i in (1, 2, 3)
    )
    scene = loaded(tmp_path, model(ONE + levels, '<item objectid="4"/>'))
    assert scene.n_meshes == 1000


def test_objects_of_other_parts_are_found(tmp_path):
    resources = '<object id="1" name="Top"><components><component objectid="1" p:path="/3D/Objects/other.model"/>'
    other = model(f'<object id="1" name="Inner">{mesh()}</object>', "")
    scene = loaded(tmp_path, model(f"{resources}</components></object>", ITEM), other=other)
    assert scene.paths == ("/Top/Inner",)


def test_colours_and_names_of_materials(tmp_path):
    group = '<basematerials id="5"><base name="Steel" displaycolor="#FF0000"/><base name="Rubber" displaycolor="#00F"/>'
    group += '<base name="Brass" displaycolor="#0000FFFF"/></basematerials>'
    own = f'<object id="1" name="a" pid="5" pindex="0">{mesh()}</object>'
    each = '<object id="2" name="b">' + mesh('pid="5" p1="2"') + "</object>"
    scene = loaded(tmp_path, model(group + own + each, ITEM + '<item objectid="2"/>'))
    assert scene.colors.tolist() == [[1, 0, 0], [0, 0, 1]]
    assert [(fact.path, fact.value) for fact in scene.facts] == [("/a", "Steel"), ("/b", "Brass")]


def test_what_is_left_out_is_told(tmp_path):
    resources = ONE + f'<object id="2" name="support" type="support">{mesh()}</object>'
    resources += '<object id="3" name="bad"><mesh><vertices><vertex x="1" y="a" z="2"/></vertices></mesh></object>'
    resources += f'<object id="4" name="odd">{mesh(faces=[[0, 1, 2], [0, 1, 99]])}</object>'
    items = ITEM + "".join(f'<item objectid="{i}"/>' for i in (2, 3, 4, 77)) + '<item objectid="1" transform="1 2"/>'
    scene = loaded(tmp_path, model(resources, items))
    assert scene.paths == ("/Bolt_M8", "/odd")
    expected = ["broken-object", "invalid-indices", "invalid-transform", "missing-object", "other-purpose"]
    assert sorted(set(codes(scene))) == expected


def test_components_in_a_circle_end(tmp_path):
    circle = '<object id="1" name="a"><components><component objectid="1"/></components></object>'
    with pytest.raises(LoadError, match=r"builds no triangle \(too-deep\)"):
        loaded(tmp_path, model(circle, ITEM))


def test_components_that_multiply_are_refused(tmp_path):
    levels = "".join(
        f'<object id="{i + 1}"><components>' + f'<component objectid="{i}"/>' * 10 + "</components></object>"
        for i in range(1, 20)
    )
    few = LoadConfig(isolate=False, max_meshes=1000)
    with pytest.raises(LoadError, match=r"more than 1,000 meshes .*; split the scene, or raise load\.max_meshes"):
        load(write(tmp_path, model(ONE + levels, '<item objectid="20"/>')), few)
    with pytest.raises(LoadError, match=r"kB grow to more than [\d,]+ meshes .*raise load\.max_growth"):
        loaded(tmp_path, model(ONE + levels, '<item objectid="20"/>'))


def test_packages_that_unpack_without_end_are_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(importlib.import_module("cadgraph.load.threemf"), "_MOST_BYTES", 1000)
    with pytest.raises(LoadError, match="unpacks to more than"):
        loaded(tmp_path, model(ONE, ITEM))


def test_entities_that_multiply_are_refused(tmp_path):
    letters = "abcdef"
    bomb = f'<!DOCTYPE m [<!ENTITY a "{"x" * 1000}">'
    for one, more in itertools.pairwise(letters):
        bomb += f'<!ENTITY {more} "{f"&{one};" * 100}">'
    with pytest.raises(LoadError, match="not readable as 3MF"):
        loaded(tmp_path, bomb + "]>" + model(ONE, ITEM).partition("?>")[2].replace("Bolt M8", "&f;"))


@pytest.mark.parametrize("content", ["", "<model", model("", ""), model(ONE, ""), "<x/>"])
def test_packages_without_a_build_are_an_error(tmp_path, content):
    with pytest.raises(LoadError, match=r"not readable as 3MF|builds no triangle"):
        loaded(tmp_path, content)


def test_cut_packages_are_told(tmp_path):
    path = write(tmp_path, model(ONE, ITEM))
    path.write_bytes(path.read_bytes()[:-30])
    with pytest.raises(LoadError, match="not a zip archive, or cut short"):
        load(path)


@pytest.mark.skipif(not COUNTER.is_file(), reason="no real files here")
def test_a_real_package_keeps_its_tree_and_its_size():
    scene = load(COUNTER, LoadConfig(isolate=False))
    assert (scene.n_meshes, scene.n_triangles, codes(scene)) == (6, 83_750, [])
    assert scene.paths[-1].startswith("/counterXP/counterX_Default_Display_State_1/")
    np.testing.assert_allclose(np.ptp(scene.vertices, axis=0), [0.3048, 0.3044088, 0.0258384], atol=1e-6)
