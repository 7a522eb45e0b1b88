"""What the page gets to draw, read as the page reads it."""

import struct

import numpy as np
import pytest
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

import shapes
from cadgraph.draw.web import packing
from cadgraph.draw.web.encode import decode, encode
from cadgraph.draw.web.instances import CLOSE, find_instances, quaternions
from cadgraph.draw.web.packing import pack_scene
from cadgraph.draw.web.simplify import simplify
from cadgraph.model.scene import MeshArrays, Placement, Scene

HIDDEN = 0xFFFFFFFF


def read(packed):
    """The forms by shape and level, and the meshes, from the bytes alone."""
    forms, manifest = {}, packed.manifest
    for chunk in manifest["chunks"]:
        data = packed.files[chunk["file"]]
        assert len(data) == chunk["bytes"]
        assert data[:4] == b"HCGC"
        (count,) = struct.unpack_from("<I", data, 4)
        assert count == chunk["n_shapes"]
        for i in range(count):
            shape, level, n, m, at, flags, *box = struct.unpack_from("<6I6f", data, 8 + 48 * i)
            assert level == chunk["level"]
            assert at % 4 == 0
            steps = np.frombuffer(data, "<u2", 3 * n, at).reshape(-1, 3)
            at += -(-6 * n // 4) * 4
            normals = np.frombuffer(data, "i1", 2 * n, at).reshape(-1, 2) / 127
            at += -(-2 * n // 4) * 4
            faces = np.frombuffer(data, "<u4" if flags & 1 else "<u2", m, at).reshape(-1, 3)
            assert (shape, level) not in forms
            forms[shape, level] = np.array(box[:3]) + steps * np.array(box[3:]), normals, faces.astype(int)
    rows = np.frombuffer(packed.files[manifest["instances"]], "<u4, 4u1, 4<f4, 3<f4")
    return forms, [(int(row[0]), row[1], row[2].astype(float), row[3].astype(float)) for row in rows]


def placed(packed, level=0):
    """Vertices and faces of every mesh that is shown, as the page draws it."""
    forms, meshes = read(packed)
    found = []
    for shape, _, turn, shift in meshes:
        if shape != HIDDEN:
            vertices, _, faces = forms.get((shape, level)) or forms[shape, 1]
            found.append((Rotation.from_quat(turn).apply(vertices) + shift, faces))
    return found


def apart(mesh, other):
    """The greatest distance from a vertex of the one to the nearest of the other."""
    return cKDTree(other[0]).query(np.asarray(mesh[0]))[0].max()


def poses(count, seed=0):
    rng = np.random.default_rng(seed)
    return zip(Rotation.random(count, random_state=seed).as_matrix(), rng.uniform(-20, 20, (count, 3)), strict=True)


def volume(vertices, faces):
    return np.linalg.det(np.asarray(vertices)[faces]).sum() / 6


def open_edges(faces):
    """Edges without exactly one partner the other way round."""
    edges = [(f[i], f[(i + 1) % 3]) for f in np.asarray(faces).tolist() for i in range(3)]
    return len([edge for edge in edges if edges.count(edge) != 1 or edge[::-1] not in set(edges)])


def welded(form):
    places, faces = np.unique(np.round(form[0], 9), axis=0, return_inverse=True)
    return places, faces.reshape(-1)[form[2]]


def test_every_mesh_lies_where_it_lay():
    meshes = [shapes.moved(shapes.tube(sides=48), turn, shift) for turn, shift in poses(6)]
    meshes += [shapes.moved(shapes.box((3, 1, 2)), turn, shift) for turn, shift in poses(4, seed=1)]
    packed = pack_scene(Scene.from_meshes(meshes))
    assert packed.manifest["n_shapes"] == 2
    assert packed.manifest["n_triangles"] == sum(len(faces) for _, faces in meshes)
    for mesh, drawn in zip(meshes, placed(packed), strict=True):
        assert max(apart(mesh, drawn), apart(drawn, mesh)) < CLOSE
        assert volume(*drawn) == pytest.approx(volume(*mesh), rel=1e-3)
    low = np.min([mesh[0].min(axis=0) for mesh in meshes], axis=0)
    assert packed.manifest["low"] == pytest.approx(low)


def test_a_mirror_image_is_a_shape_of_its_own():
    skew = (
        np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3.0]]),
        np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]),
    )
    mirrored = skew[0] * [-1, 1, 1], skew[1][:, ::-1]
    assert pack_scene(Scene.from_meshes([skew, mirrored])).manifest["n_shapes"] == 2


def test_a_scene_that_shares_shapes_looks_like_the_one_that_does_not():
    ring, box = shapes.tube(sides=40), shapes.box()
    turns, shifts = (np.array(each) for each in zip(*poses(5), strict=True))
    shape = np.array([0, 1, 0, 0, 1])
    shared = Scene(
        MeshArrays.of([ring, box]),
        tuple("abcde"),
        np.full((5, 3), np.nan, np.float32),
        placement=Placement(shape, turns.transpose(0, 2, 1), shifts),
    )
    packed = pack_scene(shared)
    assert "vertices" not in vars(shared)
    for i, drawn in enumerate(placed(packed)):
        assert apart(shared.mesh(i), drawn) < CLOSE


def test_what_is_only_nearly_a_copy_far_out_is_not_shown_as_one():
    body = shapes.tube(sides=40)
    noise = np.random.default_rng(0).uniform(-4e-4, 4e-4, body[0].shape)
    far = np.array([8000.0, 0, 0])
    meshes = [
        (body[0] + far, body[1]),
        (body[0] + noise + far + [2, 0, 0], body[1]),
        (body[0] + far + [4, 0, 0], body[1]),
    ]
    found = find_instances(Scene.from_meshes(meshes))
    assert found.shape.tolist() == [0, 1, 0]


def test_the_same_scene_gives_the_same_bytes():
    scene = Scene.from_meshes([shapes.moved(shapes.sphere(radius=r), *pose) for r, pose in enumerate(poses(3), 1)])
    first, second = pack_scene(scene), pack_scene(scene)
    assert (first.manifest, first.files) == (second.manifest, second.files)


@pytest.mark.parametrize(
    "mesh",
    [
        (np.array([[0, 0, 0], [1, 0, 0], [np.nan, 1, 0]]), [[0, 1, 2]]),
        (np.zeros((3, 3)), [[0, 1, 2]]),
        (np.eye(3), [[0, 1, 7]]),
        (np.zeros((0, 3)), np.zeros((0, 3))),
    ],
    ids=["not finite", "one point", "no such vertex", "empty"],
)
def test_a_mesh_without_a_sound_triangle_is_not_shown(mesh):
    packed = pack_scene(Scene.from_meshes([mesh, shapes.box()]))
    assert [shape for shape, *_ in read(packed)[1]] == [HIDDEN, 0]
    assert packed.manifest["n_triangles"] == 12
    assert packed.manifest["low"] == [-0.5, -0.5, -0.5]


def test_an_unsound_triangle_is_left_out_of_a_mesh():
    vertices, faces = shapes.box()
    mesh = np.vstack([vertices, [[np.inf, 0, 0]]]), np.vstack([faces, [[0, 1, 8], [0, 1, 99], [0, 0, 1]]])
    assert len(placed(pack_scene(Scene.from_meshes([mesh])))[0][1]) == 12


def test_a_scene_of_nothing_to_show_has_no_chunks():
    packed = pack_scene(Scene.from_meshes([shapes.box()]), shown=[False])
    assert (packed.manifest["chunks"], packed.manifest["n_shapes"]) == ([], 0)
    assert read(packed)[1][0][0] == HIDDEN
    assert pack_scene(Scene.from_meshes([])).manifest["n_meshes"] == 0


def test_colours_are_those_of_a_screen_and_transparent_where_there_are_none():
    colors = [[0, 0.5, 1], [np.nan, np.nan, np.nan]]
    rows = read(pack_scene(Scene.from_meshes([shapes.box(), shapes.box()], colors=colors)))[1]
    assert [row[1].tolist() for row in rows] == [[0, 188, 255, 255], [0, 0, 0, 0]]


def test_flat_faces_keep_their_edges_and_round_ones_are_smooth():
    for mesh, limit in ((shapes.box(), 0.999), (shapes.sphere(sides=64, rings=32), 0.995)):
        form, _ = encode(mesh[0], np.asarray(mesh[1], np.int32))
        places, normals = decode(form)
        corners = places[form.indices]
        flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        flat /= np.linalg.norm(flat, axis=1, keepdims=True)
        assert (np.einsum("ni,nci->nc", flat, normals[form.indices]) > limit - 0.01).all()
    outward = places / np.linalg.norm(places, axis=1, keepdims=True)
    assert (np.einsum("ni,ni->n", outward, normals) > limit).all()


def test_few_triangles_come_at_once_and_many_in_two_levels():
    packed = pack_scene(Scene.from_meshes([shapes.box(), shapes.sphere(2, 64, 32)]))
    forms, meshes = read(packed)
    assert [chunk["level"] for chunk in packed.manifest["chunks"]] == [1, 0]
    ball, box = meshes[1][0], meshes[0][0]
    assert set(forms) == {(ball, 1), (box, 1), (ball, 0)}
    assert (ball, box) == (0, 1)  # the large one first
    assert len(forms[ball, 1][2]) <= len(forms[ball, 0][2]) / 4


def test_shapes_fill_chunks_up_to_a_size_and_every_shape_is_in_one_of_each_level(monkeypatch):
    monkeypatch.setattr(packing, "_CHUNK", {1: 7_000, 0: 25_000})
    packed = pack_scene(Scene.from_meshes([shapes.sphere(r, 48, 24) for r in (1.0, 1.1, 1.2, 1.3)]))
    levels = [chunk["level"] for chunk in packed.manifest["chunks"]]
    assert levels == sorted(levels, reverse=True)
    assert levels.count(0) == levels.count(1) == 2
    assert sorted(read(packed)[0]) == [(i, level) for i in range(4) for level in (0, 1)]


def test_more_vertices_than_two_bytes_can_count_have_wide_indices():
    forms, _ = read(pack_scene(Scene.from_meshes([shapes.sphere(1.0, 340, 200)])))
    assert {level: len(vertices) > 0xFFFF for (_, level), (vertices, _, _) in forms.items()} == {0: True, 1: False}
    for vertices, _, faces in forms.values():
        assert np.unique(faces).tolist() == list(range(len(vertices)))


@pytest.mark.parametrize(
    "mesh",
    [shapes.tube(height=3, sides=96), shapes.sphere(sides=48, rings=24), shapes.cylinder(0.1, 5.0, 64)],
    ids=["tube", "sphere", "rod"],
)
def test_the_coarse_form_is_closed_and_much_like_the_full_one(mesh):
    packed = pack_scene(Scene.from_meshes([mesh]))
    full, coarse = placed(packed), placed(packed, level=1)
    places, faces = welded((*coarse[0][:1], None, coarse[0][1]))
    assert len(faces) <= max(64, len(full[0][1]) / 4)
    assert open_edges(faces) == 0
    assert volume(places, faces) == pytest.approx(volume(*full[0]), rel=0.2)
    # A tube keeps its bore: as many vertices, edges and faces make a ring or a ball.
    used = len(np.unique(faces))
    assert used - len(faces) / 2 == (0 if len(mesh[1]) == 8 * 96 else 2)


def test_simplifying_stops_where_it_would_spoil_the_shape():
    vertices, faces = shapes.box()
    assert len(simplify(vertices, faces, 4, error=1e-3)) == 12
    flat = np.array([[x, y, 0.0] for x in range(9) for y in range(9)])
    grid = np.array([[9 * x + y, 9 * x + y + 9, 9 * x + y + 10] for x in range(8) for y in range(8)])
    grid = np.vstack([grid, grid[:, [0, 2, 2]] + [0, 0, -9]])
    coarse = simplify(flat, grid, 2, error=1e-3)
    assert len(coarse) < 12
    corners = flat[coarse]
    assert np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2].sum() / 2 == pytest.approx(64)


def test_rotations_of_any_angle_become_quaternions():
    given = Rotation.random(200, random_state=3)
    half_turns = Rotation.from_rotvec(np.pi * np.eye(3))
    for each in (given, half_turns, Rotation.identity(1)):
        found = quaternions(each.as_matrix())
        assert (found[:, 3] >= 0).all()
        assert Rotation.from_quat(found).as_matrix() == pytest.approx(each.as_matrix(), abs=1e-12)
