from __future__ import annotations

import numpy as np

from cadgraph._io.text import natural_key
from cadgraph.load.naming import Names
from cadgraph.load.packing import Notes, Piece, pack
from cadgraph.model.scene import Source
from shapes import box


def piece(path, matrix=np.eye(4)):
    points, faces = box()
    return Piece(path, points, faces.astype(np.int32), matrix)


def test_natural_order_puts_two_before_ten_and_parents_first():
    paths = ["/a-b", "/a/m10", "/a/m2", "/a", "/i[10]", "/i[9]/x", "/m02", "/m2"]
    ordered = sorted(paths, key=natural_key)
    assert ordered == ["/a", "/a/m2", "/a/m10", "/a-b", "/i[9]/x", "/i[10]", "/m02", "/m2"]


def test_a_taken_name_counts_up():
    taken = Names()
    assert [taken.take("a") for _ in range(3)] == ["a", "a_1", "a_2"]


def test_equal_paths_become_unique():
    scene = pack([piece("/a"), piece("/a"), piece("/a_1")], Source(), np.eye(4), Notes())
    assert len(set(scene.paths)) == 3


def test_no_pieces_make_an_empty_scene():
    scene = pack([], Source(), np.eye(4), Notes())
    assert scene.n_meshes == 0
    assert scene.vertices.shape == (0, 3)


def test_inputs_are_not_modified():
    one = piece("/a", np.diag([-1.0, 1, 1, 1]))
    points, faces = one.points.copy(), one.faces.copy()
    pack([one], Source(), np.eye(4), Notes())
    np.testing.assert_array_equal(one.points, points)
    np.testing.assert_array_equal(one.faces, faces)


def test_one_stray_mesh_does_not_move_the_origin():
    far = np.eye(4)
    far[3, 0] = 1e7
    assert not pack([piece("/a"), piece("/b"), piece("/c", far)], Source(), np.eye(4), Notes()).origin.any()


def test_equal_notes_join_and_long_ones_are_abridged():
    notes = Notes()
    for i in range(30):
        notes.add("long", "said", f"/m{i}")
        notes.add("full", "said", f"/m{i}")
    full, long = notes.diagnostics(abridged=["long"])
    assert (len(full.meshes), len(long.meshes)) == (30, 20)
    assert full.meshes[:3] == ("/m0", "/m1", "/m2")
    assert "30" in long.message
