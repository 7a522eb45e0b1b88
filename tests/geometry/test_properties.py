import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

import shapes
from cadgraph.geometry.mesh.properties import measure
from cadgraph.model.scene import Scene


def measured(*meshes, **options):
    return measure(Scene.from_meshes(meshes), **options)


def soup(mesh):
    vertices, faces = mesh
    return vertices[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3)


def l_profile(width=0.1, thickness=0.01, length=1.0):
    outline = np.array([(0, 0), (width, 0), (width, thickness), (thickness, thickness), (thickness, width), (0, width)])
    n = len(outline)
    vertices = np.concatenate([np.column_stack([outline, np.full(n, h)]) for h in (0, length)])
    sides = [f for i in range(n) for j in [(i + 1) % n] for f in ([i, j, n + j], [i, n + j, n + i])]
    cap = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]
    caps = [list(reversed(f)) for f in cap] + [[i + n for i in f] for f in cap]
    return vertices, np.array(sides + caps)


CLEAN = {
    "box": (shapes.box((3.0, 2.0, 1.0)), (3.0, 2.0, 1.0)),
    "cube": (shapes.box(), (1.0, 1.0, 1.0)),
    "plate": (shapes.box((2.0, 1.0, 0.001)), (2.0, 1.0, 0.001)),
    "sheet": (shapes.box((2.0, 1.0, 0.0)), (2.0, 1.0, 0.0)),
    "cylinder": (shapes.cylinder(0.5, 4.0, 24), (4.0, np.cos(np.pi / 24), np.cos(np.pi / 24))),
    "disc": (shapes.cylinder(0.5, 0.01, 32), (np.cos(np.pi / 32), np.cos(np.pi / 32), 0.01)),
    "tube as long as wide": (shapes.tube(0.5, 0.4, 1.0), (1.0, np.cos(np.pi / 24), np.cos(np.pi / 24))),
    "six-sided pipe": (shapes.tube(0.05, 0.04, 3.0, 6), (3.0, 0.1, 0.1 * np.cos(np.pi / 6))),
    "angle profile": (l_profile(), (1.0, 0.11 / np.sqrt(2) + 0.01 * 0, 0.0)),
}


@pytest.mark.parametrize("name", [k for k in CLEAN if k != "angle profile"])
@pytest.mark.parametrize("seed", range(4))
def test_box_of_turned_part_is_tight(name, seed):
    mesh, extents = CLEAN[name]
    turn = np.eye(3) if seed == 0 else Rotation.random(random_state=seed).as_matrix()
    found = measured(shapes.moved(mesh, turn, (seed * 3.0, -2.0, 7.0)))
    np.testing.assert_allclose(found.obb_extents[0], extents, rtol=1e-9, atol=1e-12)


def test_box_of_angle_profile_is_no_larger_than_that_flush_with_its_legs():
    found = measured(shapes.moved(l_profile(), Rotation.random(random_state=1).as_matrix()))
    assert found.obb_volume[0] <= 0.1 * 0.1 * 1.0 * (1 + 1e-9)
    assert found.obb_extents[0, 0] == pytest.approx(1.0)


@pytest.mark.parametrize("name", CLEAN)
def test_box_holds_all_vertices_and_touches_them(name):
    vertices, faces = shapes.moved(CLEAN[name][0], Rotation.random(random_state=5).as_matrix(), (1, 2, 3))
    found = measured((vertices, faces))
    local = (vertices - found.obb_center[0]) @ found.obb_axes[0].T
    np.testing.assert_allclose(local.max(0), found.obb_extents[0] / 2, atol=1e-12)
    np.testing.assert_allclose(local.min(0), -found.obb_extents[0] / 2, atol=1e-12)


def test_axes_are_right_handed_and_extents_descend():
    random = np.random.default_rng(0)
    meshes = [shapes.moved(mesh, Rotation.random(random_state=3).as_matrix()) for mesh, _ in CLEAN.values()]
    meshes += [(random.normal(size=(9, 3)), random.integers(0, 9, (7, 3))) for _ in range(20)]
    found = measured(*meshes)
    np.testing.assert_allclose(np.linalg.det(found.obb_axes), 1.0)
    np.testing.assert_allclose(
        found.obb_axes @ found.obb_axes.transpose(0, 2, 1), np.tile(np.eye(3), (len(meshes), 1, 1)), atol=1e-12
    )
    assert np.all(np.diff(found.obb_extents, axis=1) <= 0)


def test_axes_of_upright_box_are_those_of_the_world():
    found = measured(shapes.box((1.0, 2.0, 3.0)))
    np.testing.assert_array_equal(found.obb_axes[0], [[0, 0, 1], [0, 1, 0], [-1, 0, 0]])


def test_box_of_random_points_is_close_to_the_least_one():
    random = np.random.default_rng(0)
    for _ in range(10):
        hull = ConvexHull(random.normal(size=(30, 3)) * [3, 2, 1])
        vertices, faces = hull.points, hull.simplices
        found = measured((vertices, faces))
        best = np.inf
        for turn in Rotation.random(3000, random_state=1).as_matrix():
            best = min(best, np.prod(np.ptp(vertices @ turn.T, axis=0)))
        assert found.obb_volume[0] <= 1.1 * best


def test_cylinder_has_area_volume_and_inertia_of_its_polygon():
    sides, radius, height = 24, 0.5, 2.0
    found = measured(shapes.cylinder(radius, height, sides))
    base = 0.5 * sides * radius**2 * np.sin(2 * np.pi / sides)
    assert found.volume[0] == pytest.approx(base * height)
    assert found.area[0] == pytest.approx(2 * base + height * sides * 2 * radius * np.sin(np.pi / sides))
    assert found.closed[0]


def test_inertia_of_a_box_shell():
    x, y, z = 1.0, 2.0, 3.0
    xx = 2 * (y * z * x**2 / 4) + 2 * (x * y + x * z) * x**2 / 12
    yy = 2 * (x * z * y**2 / 4) + 2 * (x * y + y * z) * y**2 / 12
    zz = 2 * (x * y * z**2 / 4) + 2 * (x * z + y * z) * z**2 / 12
    found = measured(shapes.box((x, y, z), (5, 6, 7)))
    np.testing.assert_allclose(found.inertia[0], np.diag([yy + zz, xx + zz, xx + yy]), atol=1e-12)


def test_inward_faces_give_negative_volume():
    vertices, faces = shapes.box()
    assert measured((vertices, faces[:, ::-1])).volume[0] == pytest.approx(-1.0)


def test_volume_of_open_mesh_does_not_depend_on_place():
    vertices, faces = shapes.box()
    here, there = measured((vertices, faces[:-2]), (vertices + 1e3, faces[:-2])).volume
    assert here == pytest.approx(there, rel=1e-9)


@pytest.mark.parametrize("name", [k for k in CLEAN if k != "sheet"])
def test_soup_with_equal_positions_is_closed(name):
    assert measured(soup(CLEAN[name][0])).closed[0]


def test_signed_zeros_are_one_position():
    vertices, faces = soup(shapes.moved(shapes.box(), translation=(0.5, 0.5, 0.5)))
    vertices[::2][vertices[::2] == 0] = -0.0
    assert measured((vertices, faces)).closed[0]


@pytest.mark.parametrize("dropped", range(0, 12, 3))
def test_box_without_a_face_is_open(dropped):
    vertices, faces = shapes.box()
    assert not measured((vertices, np.delete(faces, dropped, 0))).closed[0]


def test_one_face_turned_over_is_open():
    vertices, faces = shapes.box()
    faces = faces.copy()
    faces[4] = faces[4, ::-1]
    assert not measured((vertices, faces)).closed[0]


def test_two_touching_boxes_in_one_mesh_are_closed():
    (v, f), (w, g) = shapes.box(), shapes.box(center=(1, 0, 0))
    found = measured((np.concatenate([v, w]), np.concatenate([f, g + 8])))
    assert found.closed[0]
    assert found.volume[0] == pytest.approx(2.0)


def test_empty_scene_has_no_rows():
    found = measured()
    assert len(found.area) == 0
    assert found.obb_axes.shape == (0, 3, 3)


def test_mesh_without_vertices_has_no_place():
    found = measured((np.zeros((0, 3)), np.zeros((0, 3))))
    assert found.area[0] == 0
    assert np.isnan(found.centroid).all()
    assert np.isnan(found.aabb).all()
    np.testing.assert_array_equal(found.obb_extents, [[0, 0, 0]])
    np.testing.assert_array_equal(found.obb_axes[0], np.eye(3))
    assert not found.closed[0]


def test_mesh_without_faces_has_the_place_of_its_vertices():
    found = measured((np.array([[1.0, 2, 3], [3, 2, 3]]), np.zeros((0, 3))))
    np.testing.assert_array_equal(found.centroid[0], [2, 2, 3])
    np.testing.assert_array_equal(found.aabb[0], [[1, 2, 3], [3, 2, 3]])
    np.testing.assert_allclose(found.obb_extents[0], [2, 0, 0])


def test_all_points_equal_is_a_point():
    found = measured((np.full((3, 3), 7.0), [[0, 1, 2]]))
    assert found.area[0] == 0
    assert found.n_degenerate[0] == 1
    np.testing.assert_array_equal(found.centroid[0], [7, 7, 7])
    np.testing.assert_array_equal(found.obb_extents[0], [0, 0, 0])


def test_single_triangle():
    found = measured((np.array([[0.0, 0, 0], [3, 0, 0], [0, 4, 0]]), [[0, 1, 2]]))
    assert found.area[0] == pytest.approx(6)
    assert found.volume[0] == 0
    assert not found.closed[0]
    np.testing.assert_allclose(found.centroid[0], [1, 4 / 3, 0])
    assert found.obb_extents[0, 2] == pytest.approx(0)


def test_nonfinite_vertex_takes_its_faces_out():
    vertices, faces = shapes.box()
    bad = np.concatenate([vertices, [[np.nan, 0, 0], [np.inf, 0, 0]]])
    found = measured((bad, np.concatenate([faces, [[0, 1, 8], [2, 9, 3]]])), (vertices, faces))
    assert found.n_nonfinite.tolist() == [2, 0]
    assert found.n_degenerate.tolist() == [2, 0]
    assert found.area[0] == found.area[1]
    np.testing.assert_array_equal(found.aabb[0], found.aabb[1])


def test_all_vertices_nonfinite_gives_a_row_without_place():
    found = measured((np.full((3, 3), np.nan), [[0, 1, 2]]))
    assert found.n_nonfinite[0] == 3
    assert np.isnan(found.centroid).all()
    assert found.volume[0] == 0


def test_face_of_a_vertex_that_is_not_there_counts_as_degenerate():
    vertices, faces = shapes.box()
    found = measured((vertices, np.concatenate([faces, [[0, 1, 8], [-1, 0, 1]]])), (vertices, faces))
    assert found.n_degenerate[0] == 2
    assert found.area[0] == pytest.approx(6)


@pytest.mark.parametrize(("height", "n"), [(0.5e-8, 1), (2e-8, 0)])
def test_degenerate_is_lower_than_a_share_of_the_longest_side(height, n):
    found = measured((np.array([[0.0, 0, 0], [1, 0, 0], [0.5, height, 0]]), [[0, 1, 2]]))
    assert found.n_degenerate[0] == n


def test_unused_vertices_do_not_count():
    vertices, faces = shapes.box()
    found = measured((np.concatenate([vertices, [[9.0, 9, 9]]]), faces))
    np.testing.assert_allclose(found.aabb[0], [[-0.5] * 3, [0.5] * 3])
    np.testing.assert_allclose(found.obb_extents[0], [1, 1, 1])


def test_far_out_part_keeps_its_digits():
    near, far = measured(
        shapes.cylinder(0.01, 0.1), shapes.moved(shapes.cylinder(0.01, 0.1), translation=(1e5, 1e5, 0))
    ).volume
    assert far == pytest.approx(near, rel=1e-6)


def test_any_number_of_workers_gives_the_same_bytes():
    random = np.random.default_rng(0)
    meshes = [
        shapes.moved(mesh, Rotation.random(random_state=k).as_matrix(), random.normal(size=3))
        for k in range(8)
        for mesh, _ in CLEAN.values()
    ]
    one, many = measured(*meshes, workers=1), measured(*meshes, workers=7)
    for name in vars(one):
        assert getattr(one, name).tobytes() == getattr(many, name).tobytes()


def test_no_workers_is_an_error():
    with pytest.raises(ValueError, match="workers is 0"):
        measured(shapes.box(), workers=0)


def test_input_is_not_modified():
    scene = Scene.from_meshes([shapes.cylinder(), shapes.box()])
    vertices, faces = scene.vertices.copy(), scene.faces.copy()
    scene.vertices.setflags(write=False)
    scene.faces.setflags(write=False)
    measure(scene)
    np.testing.assert_array_equal(scene.vertices, vertices)
    np.testing.assert_array_equal(scene.faces, faces)


@settings(max_examples=30, deadline=None)
@given(
    name=st.sampled_from(sorted(CLEAN)),
    seed=st.integers(0, 2**31),
    shift=st.tuples(*[st.floats(-100, 100)] * 3),
    order=st.randoms(use_true_random=False),
)
def test_rigid_motion_and_face_order_change_no_invariant(name, seed, shift, order):
    vertices, faces = CLEAN[name][0]
    shuffled = list(faces)
    order.shuffle(shuffled)
    turn = Rotation.random(random_state=seed).as_matrix()
    found = measured((vertices, faces), shapes.moved((vertices, np.array(shuffled)), turn, shift))
    np.testing.assert_allclose(found.area[1], found.area[0], rtol=1e-9)
    np.testing.assert_allclose(found.volume[1], found.volume[0], rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(found.obb_extents[1], found.obb_extents[0], rtol=1e-6, atol=1e-10)
    np.testing.assert_allclose(found.centroid[1], turn @ found.centroid[0] + shift, atol=1e-9)
    np.testing.assert_allclose(found.inertia[1], turn @ found.inertia[0] @ turn.T, atol=1e-9)


@pytest.mark.parametrize("size", [(1, 2, 3), (3, 2, 1), (2, 1, 3), (2, 3, 1), (1, 3, 2), (3, 1, 2)])
def test_without_boxes_the_oriented_box_is_the_upright_one(size):
    turn = Rotation.random(random_state=1).as_matrix()
    found = measured(shapes.moved(shapes.box(size), turn, (1, 2, 3)), boxes=False)
    np.testing.assert_allclose(found.obb_extents[0], np.sort(np.ptp(found.aabb[0], axis=0))[::-1])
    np.testing.assert_allclose(found.obb_center[0], found.aabb[0].mean(axis=0))
    assert np.linalg.det(found.obb_axes[0]) == pytest.approx(1.0)
    np.testing.assert_allclose(np.abs(found.obb_axes[0].T @ found.obb_extents[0]), np.ptp(found.aabb[0], axis=0))
