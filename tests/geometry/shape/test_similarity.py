import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import shapes
import tubes
from cadgraph.geometry.mesh.properties import measure
from cadgraph.geometry.shape.repeats import find_shapes
from cadgraph.geometry.shape.similarity import deviation, find_near_shapes, sample_surface
from cadgraph.model.scene import Scene


def near(*meshes, **options):
    scene = Scene.from_meshes(
        [shapes.moved(m, Rotation.random(random_state=k).as_matrix(), (3 * k, 0, 0)) for k, m in enumerate(meshes)]
    )
    properties = measure(scene)
    return find_near_shapes(scene, properties, find_shapes(scene, properties), **options)


def flange(outer=0.1, inner=0.05, thick=0.02, sides=24):
    return shapes.tube(outer, inner, thick, sides)


@pytest.mark.parametrize(("first", "second"), [
    (flange(), flange(sides=48)), (flange(sides=12), flange(sides=64)),
    (tubes.elbow(0.2, 0.05, np.pi / 2, 12, 16), tubes.elbow(0.2, 0.05, np.pi / 2, 20, 32)),
    (shapes.sphere(), shapes.sphere(sides=40, rings=20)),
])  # fmt: skip
def test_other_tessellation_is_alike(first, second):
    found = near(first, second)
    assert found.pairs.tolist() == [[0, 1]]
    assert found.similarity[0] > 0.85
    assert found.scale[0] == pytest.approx(1.0, abs=0.05)
    assert not found.mirrored[0]


def test_scaled_part_is_alike_and_has_its_scale():
    vertices, faces = tubes.elbow(0.2, 0.05, np.pi / 2, 12, 16)
    found = near((vertices, faces), (2.5 * vertices, faces))
    assert found.similarity[0] == pytest.approx(1.0, abs=1e-3)
    assert found.scale[0] == pytest.approx(2.5)


def test_scaled_part_is_not_alike_unless_asked_for():
    vertices, faces = shapes.box((1, 2, 3))
    assert len(near((vertices, faces), (2 * vertices, faces), scaled=False).pairs) == 0


def test_other_proportions_are_less_alike():
    assert len(near(flange(), flange(inner=0.06)).pairs) == 0
    assert len(near(flange(), flange(thick=0.03)).pairs) == 0
    assert 0 < near(flange(), flange(inner=0.06), min_similarity=0.1).similarity[0] < 0.75


def test_mirror_image_is_alike_and_marked():
    arms = [shapes.box((1.0, 0.1, 0.1), (0.5, 0, 0)), shapes.box((0.1, 0.7, 0.1), (1.0, 0.35, 0)),
            shapes.box((0.1, 0.1, 0.4), (1.0, 0.7, 0.2))]  # fmt: skip
    hook = np.concatenate([v for v, _ in arms]), np.concatenate([f + 8 * i for i, (_, f) in enumerate(arms)])
    found = near(hook, (hook[0] * [1, 1, -1], hook[1][:, ::-1]))
    assert found.mirrored.tolist() == [True]
    assert found.similarity[0] > 0.99


def test_equal_shapes_are_no_pair():
    assert len(near(flange(), flange()).pairs) == 0


def test_nothing_to_compare():
    assert near().pairs.shape == (0, 2)
    assert near((np.zeros((3, 3)), [[0, 1, 2]]), flange()).pairs.shape == (0, 2)


def test_any_number_of_workers_gives_the_same_bytes():
    meshes = [flange(sides=s) for s in (8, 12, 16, 24, 32)]
    one, many = near(*meshes, workers=1), near(*meshes, workers=4)
    for name in vars(one):
        assert getattr(one, name).tobytes() == getattr(many, name).tobytes()


def test_deviation_is_the_distance_from_the_nearest_triangle():
    random = np.random.default_rng(0)
    corners = random.normal(size=(40, 9))
    points = random.normal(size=(30, 3)) * 2
    grid = [(i / 200, j / 200) for i in range(201) for j in range(201 - i)]
    s, t = np.array(grid).T
    a, b, c = corners[:, None, :3], corners[:, None, 3:6], corners[:, None, 6:]
    cloud = (a + s[None, :, None] * (b - a) + t[None, :, None] * (c - a)).reshape(-1, 3)
    for point in points:
        wanted = np.linalg.norm(cloud - point, axis=1).min()
        assert deviation(point[None], corners) == pytest.approx(wanted, abs=0.02)


def test_deviation_of_points_on_the_surface_is_zero():
    vertices, faces = shapes.cylinder()
    corners = np.ascontiguousarray(vertices[faces].reshape(-1, 9))
    assert deviation(sample_surface(corners, 100), corners) < 1e-12


def test_degenerate_triangles_do_no_harm():
    corners = np.array([[0.0, 0, 0, 1, 0, 0, 2, 0, 0], [0, 0, 0, 0, 0, 0, 0, 0, 0]])
    assert deviation(np.array([[1.5, 3.0, 4.0]]), corners) == pytest.approx(5.0)


def test_each_shape_is_named_once_with_the_earliest_it_looks_like():
    vertices, faces = flange()
    found = near((vertices, faces), flange(sides=48), (3 * vertices, faces), shapes.box((1, 2, 3)), flange(sides=64))
    assert found.pairs.tolist() == [[0, 1], [0, 2], [0, 4]]


def test_many_sizes_of_one_part_are_told_as_such():
    vertices, faces = tubes.elbow(0.2, 0.05, np.pi / 2, 12, 16)
    found = near(*((s * vertices, faces) for s in np.linspace(1, 3, 60)))
    assert found.pairs[:, 0].tolist() == [0] * 59
    np.testing.assert_allclose(found.scale, np.linspace(1, 3, 60)[1:])
    np.testing.assert_array_equal(found.similarity, 1.0)
