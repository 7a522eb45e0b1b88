from __future__ import annotations

import importlib
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cadgraph.load.usd_mesh import RawMesh, cut_meshes
from shapes import box

# 'cadgraph.load' as an attribute is the function.
MODULE = importlib.import_module("cadgraph.load.usd_mesh")
QUADS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])


def of_triangles(points=None, faces=None, dtype=np.int32, **changes):
    points = box()[0].astype(np.float32) if points is None else np.asarray(points, np.float32)
    faces = np.asarray(box()[1] if faces is None else faces, dtype).reshape(-1, 3)
    return replace(RawMesh(points, np.full(len(faces), 3, dtype), faces.reshape(-1)), **changes)


def of_quads():
    return RawMesh(box()[0], np.full(6, 4), QUADS.reshape(-1))


def assert_same(one, other):
    np.testing.assert_array_equal(one.points, other.points)
    np.testing.assert_array_equal(one.corners, other.corners)
    np.testing.assert_array_equal(one.polygon, other.polygon)
    assert one.faults == other.faults


def corner(value):
    faces = box()[1].copy()
    faces[4, 1] = value
    return of_triangles(faces=faces)


KINDS = {
    "plain": of_triangles(),
    "wide": of_triangles(dtype=np.int64),
    "left-handed": of_triangles(left_handed=True),
    "loose point": of_triangles(points=[*box()[0], (9, 9, 9)]),
    "hole": of_triangles(holes=np.array([2])),
    "twice the same corner": corner(box()[1][4, 0]),
    "index too large": corner(8),
    "index far too large": corner(2**31 - 1),
    "index negative": corner(-1),
    "NaN": of_triangles(points=[*box()[0][:7], (np.nan, 0, 0)]),
    "infinite both ways": of_triangles(points=[(np.inf, -np.inf, 0), *box()[0][1:]]),
    "quads": of_quads(),
    "count too many": of_triangles(counts=np.full(13, 3, np.int32)),
    "count negative": of_triangles(counts=np.array([3, 3, -1, 3], np.int32)),
    "two counts that even out": of_triangles(counts=np.array([2, 4] + [3] * 10, np.int32)),
    "no points": of_triangles(points=np.zeros((0, 3))),
    "nothing": RawMesh(np.zeros((0, 3)), np.zeros(0, np.int64), np.zeros(0, np.int64)),
}


@given(st.lists(st.sampled_from(sorted(KINDS)), max_size=8), st.sampled_from([1, 40, 500_000]))
def test_neighbours_and_batches_change_nothing(names, batch):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(MODULE, "_BATCH_CORNERS", batch)
        together = cut_meshes([KINDS[name] for name in names])
    assert len(together) == len(names)
    for name, cut in zip(names, together, strict=True):
        assert_same(cut, cut_meshes([KINDS[name]])[0])


@pytest.mark.parametrize("name", KINDS)
def test_short_cut_for_plain_triangles_changes_nothing(name, monkeypatch):
    quick = cut_meshes([KINDS[name]])[0]
    monkeypatch.setattr(MODULE, "_plain_triangles", lambda meshes: {})
    slow = cut_meshes([KINDS[name]])[0]
    assert_same(quick, slow)
    assert quick.dense == slow.dense


@pytest.mark.parametrize(
    ("name", "n"), [("plain", 12), ("hole", 11), ("twice the same corner", 11), ("index negative", 11), ("quads", 12)]
)
def test_only_unusable_polygons_are_dropped(name, n):
    assert len(cut_meshes([KINDS[name]])[0].corners) == n


def test_dense_says_whether_every_point_is_used():
    cut = cut_meshes([KINDS["plain"], KINDS["loose point"], KINDS["quads"]])
    assert [mesh.dense for mesh in cut] == [True, False, True]


def test_many_quads_are_cut_like_few():
    grid = np.arange(20_000 * 2).reshape(-1, 2)
    rings = np.column_stack([grid[:-1], grid[1:, ::-1]])
    rng = np.random.default_rng(0)
    points = np.column_stack([np.repeat(np.arange(20_000.0), 2), np.tile([0.0, 1], 20_000), rng.normal(size=40_000)])
    whole = cut_meshes([RawMesh(points, np.full(len(rings), 4), rings.reshape(-1))])[0]
    for start in (0, 16_380, 19_990):
        few = rings[start : start + 9]
        cut = cut_meshes([RawMesh(points, np.full(len(few), 4), few.reshape(-1))])[0]
        np.testing.assert_array_equal(whole.corners[2 * start : 2 * start + 18], cut.corners)


def test_input_is_unmodified():
    mesh = corner(-1)
    before = mesh.indices.copy(), mesh.counts.copy(), mesh.points.copy()
    cut_meshes([mesh, of_quads()])
    for array, copy in zip((mesh.indices, mesh.counts, mesh.points), before, strict=True):
        np.testing.assert_array_equal(array, copy)
