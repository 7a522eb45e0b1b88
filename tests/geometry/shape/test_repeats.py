import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import shapes
from cadgraph.geometry.mesh.properties import measure
from cadgraph.geometry.shape.repeats import find_shapes, position_tolerance
from cadgraph.model.scene import Scene


def found(*meshes, **options):
    scene = Scene.from_meshes(meshes)
    return find_shapes(scene, measure(scene), **options)


def hook():
    """A chiral part: three arms of different length, in three directions."""
    arms = [shapes.box((1.0, 0.1, 0.1), (0.5, 0, 0)), shapes.box((0.1, 0.7, 0.1), (1.0, 0.35, 0)),
            shapes.box((0.1, 0.1, 0.4), (1.0, 0.7, 0.2))]  # fmt: skip
    return np.concatenate([v for v, _ in arms]), np.concatenate([f + 8 * i for i, (_, f) in enumerate(arms)])


def scrambled(mesh, seed):
    """The same mesh with vertices, faces and corners in another order."""
    vertices, faces = mesh
    random = np.random.default_rng(seed)
    order = random.permutation(len(vertices))
    faces = np.argsort(order)[faces][random.permutation(len(faces))]
    return vertices[order], np.array([np.roll(f, random.integers(3)) for f in faces])


def mirrored(mesh):
    vertices, faces = mesh
    return vertices * [1, 1, -1], faces[:, ::-1]


def soup(mesh):
    vertices, faces = mesh
    return vertices[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3)


PARTS = {
    "box": shapes.box((1.0, 2.0, 3.0)),
    "cube": shapes.box(),
    "cylinder": shapes.cylinder(),
    "tube": shapes.tube(),
    "sphere": shapes.sphere(),
    "hook": hook(),
    "sheet": shapes.box((1.0, 2.0, 0.0)),
    "triangle": (np.array([[0.0, 0, 0], [1, 0, 0], [0, 2, 0]]), np.array([[0, 1, 2]])),
}


def pose(seed):
    return Rotation.random(random_state=seed).as_matrix(), np.random.default_rng(seed).uniform(-5, 5, 3)


@pytest.mark.parametrize("name", PARTS)
def test_same_part_in_another_pose_has_the_same_shape(name):
    result = found(PARTS[name], *(shapes.moved(PARTS[name], *pose(k)) for k in range(4)))
    assert result.shape.tolist() == [0] * 5
    assert not result.mirrored.any()


@pytest.mark.parametrize("name", PARTS)
def test_same_part_in_another_vertex_order_has_the_same_shape(name):
    result = found(PARTS[name], *(shapes.moved(scrambled(PARTS[name], k), *pose(k)) for k in range(4)))
    assert result.shape.tolist() == [0] * 5


def cut(diagonals):
    """A box whose faces are cut along one diagonal or the other."""
    vertices, _ = shapes.box((1.0, 2.0, 0.3))
    random, faces = np.random.default_rng(diagonals), []
    for axis in range(3):
        for side in (-1, 1):
            quad = np.flatnonzero(np.sign(vertices[:, axis]) == side)
            out = vertices[quad] - vertices[quad].mean(axis=0)
            order = quad[np.argsort(np.arctan2(out[:, (axis + 2) % 3], out[:, (axis + 1) % 3]))][::side]
            a, b, c, d = np.roll(order, random.integers(2))
            faces += [(a, b, c), (a, c, d)]
    return vertices, np.array(faces)


def test_diagonals_of_flat_faces_are_no_part_of_the_shape():
    parts = [scrambled(shapes.moved(cut(k), *pose(k)), k) for k in range(12)]
    assert found(*parts).n_shapes == 1


def test_positions_that_rounding_keeps_apart_are_one():
    """Copies of a soup far from the origin in float32: corners in one place are off by a rounding each."""
    random = np.random.default_rng(3)
    parts = []
    for k in range(12):
        vertices, faces = soup(
            shapes.moved(shapes.cylinder(), Rotation.random(random_state=k).as_matrix(), (40, 40, 2))
        )
        noise = random.uniform(-1, 1, vertices.shape) * np.spacing(np.float32(40.0)) / 2
        parts.append(scrambled((vertices + noise, faces), k))
    assert found(*parts).n_shapes == 1


@pytest.mark.parametrize("name", PARTS)
def test_soup_has_the_shape_of_the_indexed_mesh(name):
    assert found(PARTS[name], shapes.moved(soup(PARTS[name]), *pose(1))).n_shapes == 1


@pytest.mark.parametrize("name", PARTS)
def test_motion_takes_the_first_mesh_to_each_repeat(name):
    meshes = [PARTS[name], *(shapes.moved(scrambled(PARTS[name], k), *pose(k)) for k in range(3))]
    result = found(*meshes)
    for k, (vertices, _) in enumerate(meshes):
        moved = meshes[0][0] @ result.turn[k].T + result.shift[k]
        gaps = np.linalg.norm(moved[:, None] - vertices[None], axis=2)
        assert gaps.min(axis=0).max() < 1e-6
        assert gaps.min(axis=1).max() < 1e-6
        assert np.linalg.det(result.turn[k]) == pytest.approx(1.0)


@pytest.mark.parametrize("change", [lambda m: m, lambda m: scrambled(m, 3), soup])
def test_mirror_image_is_a_shape_of_its_own(change):
    result = found(hook(), change(shapes.moved(mirrored(hook()), *pose(1))), shapes.moved(hook(), *pose(2)))
    assert result.shape.tolist() == [0, 1, 0]
    assert result.mirrored.tolist() == [False, True, False]
    assert result.mirror_of.tolist() == [-1, 0]
    assert result.first.tolist() == [0, 1]


def test_mirror_image_without_turned_faces_is_a_shape_of_its_own():
    vertices, faces = hook()
    assert found((vertices, faces), (vertices * [1, 1, -1], faces)).mirror_of.tolist() == [-1, 0]


@pytest.mark.parametrize("name", [k for k in PARTS if k != "hook"])
def test_mirror_image_of_a_symmetric_part_is_that_part(name):
    result = found(PARTS[name], shapes.moved(mirrored(PARTS[name]), *pose(1)), mirrored(scrambled(PARTS[name], 2)))
    assert result.shape.tolist() == [0, 0, 0]


def test_ids_follow_first_occurrence():
    meshes = [PARTS["tube"], PARTS["box"], PARTS["tube"], PARTS["cylinder"], PARTS["box"]]
    result = found(*(shapes.moved(m, *pose(k)) for k, m in enumerate(meshes)))
    assert result.shape.tolist() == [0, 1, 0, 2, 1]
    assert result.first.tolist() == [0, 1, 3]


def test_rotated_seam_has_the_same_shape():
    vertices, faces = shapes.tube(sides=12)
    turn = Rotation.from_euler("z", 30, degrees=True).as_matrix()
    assert found((vertices, faces), (vertices @ turn.T, faces)).n_shapes == 1
    seam = np.roll(vertices.reshape(4, 12, 3), 5, axis=1).reshape(-1, 3)
    assert found((vertices, faces), (seam, faces)).n_shapes == 1


def test_float32_coordinates_far_from_the_origin_stay_one_shape():
    place = np.array([80.0, -60.0, 12.0])
    meshes = [shapes.moved(hook(), pose(k)[0], place + k) for k in range(20)]
    rounded = [(v.astype(np.float32).astype(np.float64), f) for v, f in meshes]
    assert found(*rounded).n_shapes == 1


def test_details_finer_than_the_digits_of_a_far_mesh_vanish_from_the_near_one():
    profile = [(0.0, 0.0), (0.3, 0.0), (0.3, 0.5), (0.29997, 0.50002), (0.0, 0.50002)]  # a chamfer of 30 micrometres
    vertices, faces = shapes.lathe(profile)
    far = vertices + np.array([170.0, 150.0, 100.0])
    assert position_tolerance(measure(Scene.from_meshes([(far, faces)])))[0] > 6e-5
    assert found(scrambled((vertices, faces), 1), scrambled((far, faces), 2)).n_shapes == 1


def test_deviation_beyond_the_tolerance_is_another_shape():
    vertices, faces = hook()
    scene = Scene.from_meshes([(vertices, faces)])
    tolerance = position_tolerance(measure(scene))[0]
    for share, n_shapes in ((0.5, 1), (2.0, 2)):
        other = vertices.copy()
        other[3, 0] += share * tolerance
        assert found((vertices, faces), (other, faces)).n_shapes == n_shapes


def test_boxes_of_nearly_equal_size_are_different_shapes():
    result = found(*(shapes.box((1.0, 2.0, 3.0 + 1e-4 * k)) for k in range(50)))
    assert result.n_shapes == 50


def test_same_vertices_with_other_faces_are_different_shapes():
    """Two open cubes without two faces: opposite ones, adjacent ones."""
    vertices, faces = shapes.box()
    assert found((vertices, faces[4:]), (vertices, np.concatenate([faces[2:4], faces[6:]]))).n_shapes == 2


def test_other_tessellation_is_another_shape():
    assert found(shapes.cylinder(sides=24), shapes.cylinder(sides=25)).n_shapes == 2


def test_empty_scene_has_no_shapes():
    assert found().n_shapes == 0


def test_meshes_without_area_or_with_bad_vertices_have_a_shape_each():
    empty = (np.zeros((0, 3)), np.zeros((0, 3)))
    point = (np.zeros((3, 3)), [[0, 1, 2]])
    vertices, faces = shapes.box()
    bad = (np.concatenate([vertices, [[np.nan] * 3]]), np.concatenate([faces, [[0, 1, 8]]]))
    assert found(empty, empty, point, point, bad, bad).shape.tolist() == [0, 1, 2, 3, 4, 5]


def test_faces_of_vertices_that_are_not_there_do_not_matter():
    vertices, faces = shapes.box((1, 2, 3))
    bad = np.concatenate([faces, [[0, 1, 99]]])
    assert found((vertices, bad), scrambled((vertices, bad[:-1]), 1)).n_shapes == 2
    assert found((vertices, bad), (vertices[::-1], np.where(bad < 8, 7 - bad, bad))).n_shapes == 1


def test_any_number_of_workers_gives_the_same_bytes():
    meshes = [shapes.moved(scrambled(m, k), *pose(k)) for k in range(5) for m in PARTS.values()]
    one, many = found(*meshes, workers=1), found(*meshes, workers=5)
    for name in vars(one):
        assert getattr(one, name).tobytes() == getattr(many, name).tobytes()


def test_input_is_not_modified():
    scene = Scene.from_meshes([hook(), scrambled(hook(), 1)])
    properties = measure(scene)
    for array in (scene.vertices, scene.faces, *vars(properties).values()):
        array.setflags(write=False)
    assert find_shapes(scene, properties).n_shapes == 1


@settings(max_examples=40, deadline=None)
@given(st.lists(st.tuples(st.sampled_from(sorted(PARTS)), st.integers(0, 10**6)), min_size=1, max_size=8))
def test_parts_in_random_poses_and_orders_are_told_apart(draws):
    result = found(*(shapes.moved(scrambled(PARTS[name], seed), *pose(seed)) for name, seed in draws))
    names = [name for name, _ in draws]
    assert len(set(names)) == result.n_shapes
    for i in range(len(names)):
        for j in range(i):
            assert (result.shape[i] == result.shape[j]) == (names[i] == names[j])
