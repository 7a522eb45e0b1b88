"""STL: binary and text, told apart by size, and what damaged ones come to."""

from __future__ import annotations

import importlib
from pathlib import Path

import numpy as np
import pytest

import shapes
from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load

BOX = shapes.box((1, 2, 3))
COUNTER = Path(__file__).parents[2] / "../shared/data/formats/counter.unitsmm.stl"


def binary(path, header=b"", corners=None, promised=None):
    corners = BOX[0][BOX[1]] if corners is None else corners
    records = np.zeros(len(corners), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    records["corners"] = corners
    n = len(corners) if promised is None else promised
    path.write_bytes(header.ljust(80, b"\0") + n.to_bytes(4, "little") + records.tobytes())
    return path


def solid(name, corners, end=True):
    facets = "".join(
        " facet normal 0 0 0\n  outer loop\n"
        + "".join(f"   vertex {x:g} {y:g} {z:g}\n" for x, y, z in triangle)
        + "  endloop\n endfacet\n"
        for triangle in corners.tolist()
    )
    return f"solid {name}\n{facets}" + (f"endsolid {name}\n" if end else "")


@pytest.fixture(autouse=True)
def _as_read(monkeypatch):
    """Scenes as the reader leaves them: unit, up axis and bags are settled after it, see test_finish.py."""
    finishing = importlib.import_module("cadgraph.load.finish")
    monkeypatch.setattr(finishing, "finish", lambda scene, config, path: scene)


def loaded(path, text=None):
    if text is not None:
        path.write_text(text)
    return load(path, LoadConfig(isolate=False))


def codes(scene):
    return [note.code for note in scene.diagnostics]


@pytest.mark.parametrize("header", [b"", b"solid but binary facet", b"exported by X"])
def test_a_binary_file_is_one_mesh_whatever_its_header(tmp_path, header):
    scene = loaded(binary(tmp_path / "My part.stl", header))
    assert (scene.paths, scene.n_triangles, len(scene.vertices)) == (("/My_part",), 12, 8)
    np.testing.assert_allclose(np.ptp(scene.vertices, axis=0), [1, 2, 3])
    assert (scene.source.unit_stated, scene.source.up_stated, codes(scene)) == (False, False, [])


def test_a_text_gives_the_same_mesh(tmp_path):
    one = loaded(binary(tmp_path / "a.stl"))
    other = loaded(tmp_path / "b.stl", solid("a", BOX[0][BOX[1]]).upper())
    np.testing.assert_array_equal(one.triangles(), other.triangles())


def test_each_solid_of_a_text_is_a_mesh(tmp_path):
    corners = BOX[0][BOX[1]]
    text = solid("flange 1", corners) + solid("", corners + 5) + solid("flange 1", corners + 10)
    scene = loaded(tmp_path / "a.stl", text)
    assert scene.paths == ("/a", "/flange_1", "/flange_1_1")
    assert [scene.mesh(i)[0].min() for i in range(3)] == [3.5, -1.5, 8.5]
    assert [fact.value for fact in scene.facts] == ["flange 1", "flange 1"]


@pytest.mark.parametrize(("header", "unit"), [
    (b"x UNITS=mm", 0.001), (b"unit: inch;", 0.0254), (b"Units = metres", 1.0), (b"COLOR=abcd", None),
    (b"units=mmm", None), (b"unit m", None),
])  # fmt: skip
def test_a_unit_in_the_header_counts(tmp_path, header, unit):
    scene = loaded(binary(tmp_path / "a.stl", header))
    assert scene.source.unit_stated == (unit is not None)
    assert scene.source.meters_per_unit == (unit or 1.0)
    np.testing.assert_allclose(np.ptp(scene.vertices, axis=0), np.array([1, 2, 3]) * (unit or 1))


@pytest.mark.parametrize("name", ["part.unitsmm.stl", "part units mm.stl"])
def test_a_unit_in_the_name_is_only_told(tmp_path, name):
    scene = loaded(binary(tmp_path / name))
    assert (scene.source.unit_stated, codes(scene)) == (False, ["unit-hint"])
    assert "speaks of mm; set load.unit" in scene.diagnostics[0].message


@pytest.mark.parametrize("length", [0, 83, 84, 84 + 50, 84 + 50 * 12 - 1])
def test_cut_binary_files_are_told(tmp_path, length):
    path = binary(tmp_path / "a.stl", b"solid x")
    path.write_bytes(path.read_bytes()[:length])
    with pytest.raises(LoadError, match=r"cut short|only 83 bytes|empty"):
        loaded(path)


def test_more_than_all_triangles_is_told(tmp_path):
    path = binary(tmp_path / "a.stl")
    path.write_bytes(path.read_bytes() + b"more")
    assert codes(loaded(path)) == ["trailing-bytes"]


def test_a_huge_promise_costs_nothing(tmp_path):
    with pytest.raises(LoadError, match="4,294,967,295 triangles, and 12 are there"):
        loaded(binary(tmp_path / "a.stl", promised=2**32 - 1))


def test_a_cut_text_keeps_its_whole_facets(tmp_path):
    text = solid("a", BOX[0][BOX[1]], end=False)
    scene = loaded(tmp_path / "a.stl", text[: text.rindex("vertex")])
    assert (scene.n_triangles, codes(scene)) == (11, ["broken-facet", "cut-short"])


def test_broken_numbers_cost_their_facet(tmp_path):
    text = solid("a", BOX[0][BOX[1]]).replace("vertex -0.5 -1 -1.5", "vertex -0.5 oops", 1)
    scene = loaded(tmp_path / "a.stl", text)
    assert (scene.n_triangles, codes(scene)) == (11, ["invalid-points"])


def test_points_that_are_not_finite_cost_their_triangle(tmp_path):
    corners = BOX[0][BOX[1]].copy()
    corners[0, 0, 0] = np.inf
    scene = loaded(binary(tmp_path / "a.stl", corners=corners))
    assert (scene.n_triangles, codes(scene)) == (11, ["invalid-points"])


@pytest.mark.parametrize("text", ["solid a\nendsolid a\n", "solid a\nfacet\nvertex 0 0 0\n", "solid"])
def test_texts_without_a_triangle_are_an_error(tmp_path, text):
    with pytest.raises(LoadError, match="holds no triangle"):
        loaded(tmp_path / "a.stl", text)


def test_another_format_is_named(tmp_path):
    with pytest.raises(LoadError, match="its content looks like ply"):
        loaded(tmp_path / "a.stl", "ply\nformat ascii 1.0\n" + "comment more\n" * 20)


@pytest.mark.skipif(not COUNTER.is_file(), reason="no real files here")
def test_a_real_file_is_read_whole():
    scene = loaded(COUNTER)
    assert (scene.n_meshes, scene.n_triangles, codes(scene)) == (1, 83_750, ["unit-hint"])
    np.testing.assert_allclose(np.ptp(scene.vertices, axis=0), [304.8, 304.4088, 25.8384], atol=1e-3)


def test_a_stray_point_costs_its_triangles_and_not_the_file(tmp_path):
    corners = BOX[0][BOX[1]].copy()
    corners[4, 1, 2] = 3e30
    scene = loaded(binary(tmp_path / "x.stl", b"units=mm", corners))
    assert (scene.n_triangles, codes(scene)) == (11, ["invalid-points"])
    assert "1e+11 units away" in scene.diagnostics[0].message
    with pytest.raises(LoadError, match="none of its triangles"):
        loaded(binary(tmp_path / "x.stl", b"units=mm", corners + 1e12))
