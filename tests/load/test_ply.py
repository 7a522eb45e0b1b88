"""PLY through trimesh: one mesh, without unit and axis, and point clouds refused."""

from __future__ import annotations

import importlib
import logging

import numpy as np
import pytest

import shapes
from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load

pytest.importorskip("trimesh")
BOX = shapes.box((1, 2, 3))


def text(points=BOX[0], faces=BOX[1], extra="", color=""):
    head = f"ply\nformat ascii 1.0\n{extra}element vertex {len(points)}\n"
    head += "property float x\nproperty float y\nproperty float z\n"
    if color:
        head += "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    if len(faces):
        head += f"element face {len(faces)}\nproperty list uchar int vertex_indices\n"
    rows = [" ".join(f"{x:g}" for x in point) + color for point in points]
    rows += [" ".join(map(str, (len(face), *face))) for face in faces]
    return head + "end_header\n" + "\n".join(rows) + "\n"


@pytest.fixture(autouse=True)
def _as_read(monkeypatch):
    """Scenes as the reader leaves them: unit, up axis and bags are settled after it, see test_finish.py."""
    finishing = importlib.import_module("cadgraph.load.finish")
    monkeypatch.setattr(finishing, "finish", lambda scene, config, path: scene)


def loaded(path, content, isolate=False):
    path = path / "my part.ply"
    path.write_text(content)
    # The other process settles the unit, so it must be told.
    return load(path, LoadConfig(isolate=True, unit="m", up="Z") if isolate else LoadConfig(isolate=False))


@pytest.mark.parametrize("isolate", [True, False])
def test_a_box_is_one_mesh_in_its_own_unit(tmp_path, isolate):
    scene = loaded(tmp_path, text(), isolate)
    assert (scene.paths, scene.n_triangles, len(scene.vertices)) == (("/my_part",), 12, 8)
    np.testing.assert_allclose(np.ptp(scene.vertices, axis=0), [1, 2, 3])
    assert (scene.source.unit_stated, scene.source.format) == (isolate, "ply")


def test_colours_are_those_of_a_screen(tmp_path):
    scene = loaded(tmp_path, text(color=" 188 0 255"))
    np.testing.assert_allclose(scene.colors, [[0.503, 0, 1]], atol=1e-3)


def test_point_clouds_are_refused(tmp_path):
    with pytest.raises(LoadError, match=r"my part\.ply: a point cloud, without any face"):
        loaded(tmp_path, text(faces=[]))


def test_pictures_are_not_opened_and_nothing_is_printed(tmp_path, capfd):
    (tmp_path / "secret.png").write_text("no picture")
    scene = loaded(tmp_path, text(extra="comment TextureFile ../secret.png\n"))
    assert scene.n_triangles == 12
    assert capfd.readouterr() == ("", "")
    assert not logging.getLogger("trimesh").disabled


@pytest.mark.parametrize(("change", "reason"), [
    (("ply", "plx"), "no PLY file"), (("element vertex 8", "element vertex 9999"), "none of its 12 faces"),
    (("format ascii", "format binary_little_endian"), "not readable as PLY"), (("end_header", "end"), "not readable"),
    (("0.5", "oops"), "not readable as PLY"),
])  # fmt: skip
def test_damaged_files_end_in_one_line(tmp_path, change, reason):
    with pytest.raises(LoadError, match=reason) as caught:
        loaded(tmp_path, text().replace(*change, 1))
    assert "\n" not in str(caught.value)


def test_a_cut_text_is_told(tmp_path):
    scene = loaded(tmp_path, text().rsplit("\n", 3)[0])
    assert (scene.n_triangles, [note.code for note in scene.diagnostics]) == (10, ["cut-short"])


def test_wrong_numbers_cost_their_faces(tmp_path):
    scene = loaded(tmp_path, text(faces=[*BOX[1].tolist(), [0, 1, 99]]))
    assert (scene.n_triangles, [note.code for note in scene.diagnostics]) == (12, ["invalid-indices"])
