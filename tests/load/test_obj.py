"""OBJ: what makes a mesh, whatever way it is written, and what damaged text comes to."""

from __future__ import annotations

import importlib
import os

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import shapes
from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load
from cadgraph.load.text_lines import Lines, blocks_of
from cadgraph.model.facts import Fact

BOX = shapes.box((1, 2, 3))
TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"


@pytest.fixture(autouse=True)
def _as_read(monkeypatch):
    """Scenes as the reader leaves them: unit, up axis and bags are settled after it, see test_finish.py."""
    finishing = importlib.import_module("cadgraph.load.finish")
    monkeypatch.setattr(finishing, "finish", lambda scene, config, path: scene)


def loaded(path, text=None, **settings):
    if text is not None:
        path = path / "plant.obj"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return load(path, LoadConfig(isolate=False, **settings))


def codes(scene):
    return [note.code for note in scene.diagnostics]


def box_text(first=1, at=0.0, corner="{}"):
    points = "".join(f"v {x + at:g} {y:g} {z:g}\n" for x, y, z in BOX[0])
    faces = "".join("f " + " ".join(corner.format(i + first) for i in face) + "\n" for face in BOX[1].tolist())
    return points, faces


def test_objects_and_groups_are_meshes_whatever_their_material(tmp_path):
    points, faces = box_text()
    half = faces.splitlines(keepends=True)
    text = f"{points}o pump\nusemtl red\n{''.join(half[:6])}usemtl blue\n{''.join(half[6:])}"
    for i, name in enumerate(("flange", "valve"), start=1):
        points, faces = box_text(8 * i + 1, at=10 * i)
        text += f"{points}o skid\ng {name}\n{faces}"
    scene = loaded(tmp_path, text)
    assert scene.paths == ("/pump", "/skid/flange", "/skid/valve")
    assert np.diff(scene.face_offsets).tolist() == [12, 12, 12]
    np.testing.assert_allclose(np.ptp(scene.mesh(1)[0], axis=0), [1, 2, 3])
    assert scene.facts[:2] == (Fact("/pump", "layer", "red", "usemtl"), Fact("/pump", "layer", "blue", "usemtl"))
    assert codes(scene) == []


def test_neither_unit_nor_axis_is_stated(tmp_path):
    source = loaded(tmp_path, TRIANGLE + "f 1 2 3").source
    assert (source.unit_stated, source.up_stated, source.meters_per_unit, source.up_axis) == (False, False, 1.0, "Z")


def test_names_that_return_with_points_of_their_own_are_new_meshes(tmp_path):
    one, two = box_text(), box_text(9, at=5)
    again = f"g bolt\n{one[0]}{one[1]}g bolt\n{two[0]}{two[1]}"
    assert loaded(tmp_path, again).paths == ("/bolt", "/bolt_1")
    # All points first: one group, written in two pieces.
    pieces = f"{one[0]}{two[0]}g bolt\n{one[1]}g nut\n{one[1]}g bolt\n{two[1]}"
    scene = loaded(tmp_path, pieces)
    assert scene.paths == ("/bolt", "/nut")
    assert np.diff(scene.face_offsets).tolist() == [24, 12]


def test_without_names_each_material_is_a_mesh(tmp_path):
    points, faces = box_text()
    lines = faces.splitlines(keepends=True)
    text = f"{points}usemtl a\n{''.join(lines[:4])}usemtl b\n{''.join(lines[4:8])}usemtl a\n{''.join(lines[8:])}"
    scene = loaded(tmp_path, text)
    assert (scene.paths, codes(scene)) == (("/a", "/b"), ["split-by-material"])
    assert np.diff(scene.face_offsets).tolist() == [8, 4]


def test_without_names_and_with_one_material_the_file_names_it(tmp_path):
    assert loaded(tmp_path, TRIANGLE + "usemtl a\nf 1 2 3").paths == ("/plant",)


@pytest.mark.parametrize("corner", ["{}", "{}/{}", "{}//{}", "{}/{}/{}"])
def test_texture_and_normal_numbers_are_passed_over(tmp_path, corner):
    points, faces = box_text(corner=corner.replace("{}", "{0}"))
    scene = loaded(tmp_path, points + faces)
    assert (scene.n_triangles, len(scene.vertices)) == (12, 8)


def test_negative_numbers_count_back_from_where_they_stand(tmp_path):
    scene = loaded(tmp_path, TRIANGLE + "f -3 -2 -1\nv 5 5 5\nf -1 1 2\n")
    np.testing.assert_array_equal(scene.triangles()[0], [[0, 0, 0], [1, 0, 0], [0, 1, 0]])
    np.testing.assert_array_equal(sorted(scene.triangles()[1].tolist()), [[0, 0, 0], [1, 0, 0], [5, 5, 5]])


def test_polygons_are_cut_without_leaving_their_outline(tmp_path):
    # An L of area 3: a fan from its first corner would cover more.
    outline = [(2, 0), (2, 1), (1, 1), (1, 2), (0, 2), (0, 0)]
    text = "".join(f"v {x} {y} 0\n" for x, y in outline) + "f 1 2 3 4 5 6\n"
    scene = loaded(tmp_path, text)
    a, b, c = scene.triangles().transpose(1, 0, 2)
    areas = np.cross(b - a, c - a)[:, 2] / 2
    assert (len(areas), areas.sum(), areas.min() > 0) == (4, pytest.approx(3), True)


@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
def test_line_ends_of_all_systems(tmp_path, newline):
    text = (TRIANGLE + "o a\nf 1 2 3\n").replace("\n", newline)
    assert loaded(tmp_path, text).paths == ("/a",)


def test_lines_continue_behind_a_backslash(tmp_path):
    assert loaded(tmp_path, "v 0 0 0\nv 1 0 \\\n0\nv 0 1 0\nf 1 \\\r\n2 3\n").n_triangles == 1


def test_colours_come_from_the_library_beside(tmp_path):
    (tmp_path / "my colours.mtl").write_text("newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nKd x\n")
    points, faces = box_text()
    lines = faces.splitlines(keepends=True)
    text = f"mtllib my colours.mtl\no a\n{points}usemtl blue\n{''.join(lines[:2])}usemtl red\n{''.join(lines[2:])}"
    scene = loaded(tmp_path, text)
    assert scene.colors.tolist() == [[1, 0, 0]]
    assert codes(scene) == []


@pytest.mark.parametrize("name", ["../c.mtl", "/etc/passwd", "http://host/c.mtl", "gone.mtl"])
def test_libraries_elsewhere_are_not_opened(tmp_path, name):
    (tmp_path / "c.mtl").write_text("newmtl a\nKd 1 0 0\n")
    folder = tmp_path / "in"
    folder.mkdir()
    scene = loaded(folder, f"mtllib {name}\n{TRIANGLE}usemtl a\nf 1 2 3\n")
    assert codes(scene) == ["material-library"]
    assert np.isnan(scene.colors).all()


def test_metadata_can_be_left(tmp_path):
    text = TRIANGLE + "o a b\nusemtl m\nf 1 2 3\n"
    assert loaded(tmp_path, text).facts == (
        Fact("/a_b", "name", "a b", "o or g"),
        Fact("/a_b", "layer", "m", "usemtl"),
    )
    assert loaded(tmp_path, text, metadata="off").facts == ()


@pytest.mark.parametrize(("line", "code"), [
    ("f 1 2", "invalid-face-counts"), ("f 1 2 nine", "invalid-face-counts"), ("f 1 2 9", "invalid-indices"),
    ("f 0 1 2", "invalid-indices"), ("f -9 1 2", "invalid-indices"), ("f 1 2 99999999999999999999", "invalid-"),
    ("v 1 x 3\nf 1 2 4", "invalid-points"), ("v nan 0 0\nf 1 2 4", "invalid-points"),
    ("v 1\nf 1 2 4", "invalid-points"),
    ("l 1 2", "no-surface"), ("p 1", "no-surface"), ("surf 0 1 0 1 1 2 3", "unsupported-geometry"),
])  # fmt: skip
def test_what_cannot_be_used_is_told(tmp_path, line, code):
    scene = loaded(tmp_path, f"{TRIANGLE}{line}\nf 1 2 3 # sound\n")
    assert scene.n_triangles == 1
    assert [found.startswith(code) for found in codes(scene)] == [True]


@pytest.mark.parametrize(("end", "told"), [
    ("f 1 2", True), ("f 1", True), ("v 0.5", True),
    ("f 1 2 3", False), ("f 1 2\n", False), ("# 1", False), ("", False),
])  # fmt: skip
def test_a_file_that_ends_within_a_line_is_told(tmp_path, end, told):
    assert ("cut-short" in codes(loaded(tmp_path, f"{TRIANGLE}f 1 2 3\n{end}"))) == told


def test_a_broken_point_keeps_the_numbers_of_those_behind_it(tmp_path):
    scene = loaded(tmp_path, "v 9 x\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\nf 2 3 4\n")
    np.testing.assert_array_equal(scene.triangles()[0], [[0, 0, 0], [1, 0, 0], [0, 1, 0]])


@pytest.mark.parametrize(("text", "reason"), [
    ("# nothing", "no face"), (TRIANGLE, "point cloud"), ("v 0 0 0\nf 1 1 1", "can be used"),
    (b"glTF\2\0\0\0", "its content looks like gltf"), (b"\0\1\2", "no OBJ file"),
])  # fmt: skip
def test_files_without_a_surface_end_in_one_line(tmp_path, text, reason):
    with pytest.raises(LoadError, match=reason):
        loaded(tmp_path, text)


def test_blocks_of_any_size_read_the_same(tmp_path, monkeypatch):
    points, faces = box_text()
    text = f"o a\n{points}{faces}o b\n{faces}"
    whole = loaded(tmp_path, text)
    for size in (16, 77, 200):
        monkeypatch.setattr(importlib.import_module("cadgraph.load.text_lines"), "_BLOCK", size)
        parts = loaded(tmp_path, text)
        assert parts.paths == whole.paths == ("/a", "/b")
        np.testing.assert_array_equal(parts.vertices, whole.vertices)
        np.testing.assert_array_equal(parts.faces, whole.faces)


def test_a_line_without_end_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(importlib.import_module("cadgraph.load.text_lines"), "_LONGEST_LINE", 1000)
    with pytest.raises(LoadError, match="holds a line of more than"):
        loaded(tmp_path, TRIANGLE + "f " + "1 2 3 " * 1000)


@given(st.lists(st.lists(st.integers(-99, 99), max_size=5), max_size=12), st.sampled_from(["\n", "\r\n", " \n\n"]))
@settings(max_examples=60)
def test_integers_are_those_that_python_reads(rows, newline):
    text = newline.join("f " + " ".join(f"{n}/{n}" for n in row) for row in rows)
    lines = Lines(text.encode())
    counts, values = lines.integers(lines.beginning("f"))
    assert counts.tolist() == [len(row) for row in rows]
    assert values.tolist() == [n for row in rows for n in row]


@given(st.lists(st.lists(st.floats(-1e6, 1e6) | st.just("x"), max_size=5), max_size=12))
@settings(max_examples=60)
def test_rows_are_those_that_python_reads(rows):
    lines = Lines("\n".join("v " + " ".join(map(str, row)) for row in rows).encode())
    found = lines.rows(lines.beginning("v"), 3)
    for row, own in zip(rows, found.tolist(), strict=True):
        if len(row) >= 3 and "x" not in row[:3]:
            assert own == row[:3]
        else:
            assert np.isnan(own).all()


def test_a_file_that_is_gone_meanwhile_is_an_error(tmp_path):
    with pytest.raises(LoadError, match="can't be read"):
        list(blocks_of(tmp_path / "gone.obj"))


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
def test_a_pipe_as_library_does_not_wait(tmp_path):
    os.mkfifo(tmp_path / "c.mtl")
    assert codes(loaded(tmp_path, f"mtllib c.mtl\n{TRIANGLE}f 1 2 3\n")) == ["material-library"]
