import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import shapes
from cadgraph.geometry.mesh.pierce import pierce
from cadgraph.geometry.mesh.properties import measure
from cadgraph.geometry.shape.analysis import measure_shapes
from cadgraph.labelers.embedded.descriptor import FORMS, SIZES, describe_shapes
from cadgraph.labelers.embedded.edges import edge_features
from cadgraph.model.parts import Parts
from cadgraph.model.scene import Scene
from cadplants.presets.authoring_systems import SYSTEMS, make_in_system
from fittings import MESHERS


def parts_of(*meshes):
    scene = Scene.from_meshes(list(meshes))
    n = scene.n_meshes
    return Parts(
        scene, tuple((i,) for i in range(n)), np.arange(n), measure(scene), np.arange(n), np.zeros(n, np.bool_)
    )


def described(*meshes):
    parts = parts_of(*meshes)
    return describe_shapes(parts.scene, parts.properties, measure_shapes(parts.scene, parts.properties))


def turned(mesh, seed=0):
    vertices, faces = mesh
    q, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    q *= np.sign(np.linalg.det(q))
    return np.asarray(vertices) @ q.T + [3.0, -2.0, 5.0], faces


def scaled(mesh, factor):
    return np.asarray(mesh[0]) * factor, mesh[1]


TUBE = shapes.tube(0.05, 0.04, 0.6, 32)
BOX = shapes.box(size=(0.3, 0.2, 0.1))


def test_names_and_numbers_agree():
    d = described(TUBE, BOX)
    assert d.forms.shape == (2, len(FORMS))
    assert d.sizes.shape == (2, len(SIZES))
    assert np.isfinite(d.forms).all()
    assert np.isfinite(d.sizes).all()


@pytest.mark.parametrize("mesh", [TUBE, BOX], ids=["tube", "box"])
def test_pose_changes_nothing(mesh):
    d = described(mesh, turned(mesh))
    np.testing.assert_allclose(d.sizes[0], d.sizes[1], atol=1e-6)
    np.testing.assert_allclose(d.forms[0], d.forms[1], atol=0.02)


def test_scale_shifts_all_sizes_alike_and_no_form():
    d = described(TUBE, scaled(TUBE, 3.0))
    there = d.sizes[0] > np.log(1.01e-4)  # sizes of nothing stay at their least
    np.testing.assert_allclose((d.sizes[1] - d.sizes[0])[there], np.log(3.0), atol=1e-4)
    np.testing.assert_allclose(d.forms[0], d.forms[1], atol=0.02)


def test_another_deflection_changes_little():
    d = described(shapes.tube(0.05, 0.04, 0.6, 32), shapes.tube(0.05, 0.04, 0.6, 64))
    assert np.abs(d.forms[0] - d.forms[1]).mean() < 0.03
    np.testing.assert_allclose(d.sizes[0], d.sizes[1], atol=0.02)


def test_a_mesh_inside_out_looks_the_same():
    vertices, faces = TUBE
    d = described(TUBE, (vertices, np.asarray(faces)[:, ::-1]))
    np.testing.assert_allclose(d.forms[0], d.forms[1], atol=1e-6)
    np.testing.assert_allclose(d.sizes[0], d.sizes[1], atol=1e-6)


def test_degenerate_and_empty_shapes_have_finite_numbers():
    flat = (np.zeros((3, 3)), np.array([[0, 1, 2]]))
    d = described(flat, BOX)
    assert np.isfinite(d.forms).all()
    assert np.isfinite(d.sizes).all()
    assert described().forms.shape == (0, len(FORMS))


def test_points_weigh_as_much_as_the_surface_in_any_pose():
    parts = parts_of(BOX, TUBE, turned(TUBE))
    points = pierce(parts.scene, parts.properties, 24)
    area = np.add.reduceat(points.weights, points.offsets[:-1])
    np.testing.assert_allclose(area, parts.properties.area, rtol=0.03)
    np.testing.assert_allclose(area[1], area[2], rtol=1e-6)


def test_ways_across_are_walls_and_bores():
    parts = parts_of(TUBE)
    points = pierce(parts.scene, parts.properties, 24)
    steep = points.slant > 0.99
    wall = steep & (np.abs(points.normals[:, 2]) < 0.1)
    assert np.median(points.gaps[wall, 0]) == pytest.approx(0.01, rel=0.05)
    # Inside the wall there is the bore; outside nothing follows.
    radius = np.linalg.norm(points.points[:, :2], axis=1)
    assert np.isfinite(points.gaps[wall & (radius < 0.041), 1]).all()
    assert np.isinf(points.gaps[wall & (radius > 0.049), 1]).all()


def test_doubled_faces_count_once():
    vertices, faces = TUBE
    doubled = (vertices, np.concatenate([faces, faces]))
    parts = parts_of(TUBE, doubled)
    points = pierce(parts.scene, parts.properties, 16)
    assert points.offsets[1] == points.offsets[2] - points.offsets[1]


def test_turning_tells_boxes_from_hexagons_and_tubes():
    parts = parts_of(BOX, shapes.cylinder(0.05, 0.1, 6), TUBE)
    features = edge_features(parts.scene, parts.properties)
    sixty, right, hollow = 2, 4, slice(7, 9)
    assert features[0, right] == pytest.approx(1.0)
    assert features[1, sixty] > 0.2
    # The wall of the bore turns inward, and its edges outward.
    assert features[2, hollow][0] > 0.2
    np.testing.assert_allclose(features[:2, hollow], 0, atol=1e-9)


def test_walls_turn_by_as_much_in_any_number_of_sides():
    parts = parts_of(*(shapes.tube(0.05, 0.04, 0.6, sides) for sides in (24, 48)))
    features = edge_features(parts.scene, parts.properties)
    np.testing.assert_allclose(features[0], features[1], atol=0.02)


def test_a_shape_looks_the_same_beside_others():
    # Rounded to the hundred-thousandth of its size, one box begins where the other does not yet.
    vertices, faces = BOX
    other = np.array(vertices, float)
    low = other[:, 0] == other[:, 0].min()
    size = np.linalg.norm(np.ptp(other, axis=0))
    other[low & (other[:, 2] > other[:, 2].min()), 0] += 1e-5 * size
    parts = parts_of((other, faces), BOX)
    together = edge_features(parts.scene, parts.properties)
    for row, mesh in zip(together, ((other, faces), BOX), strict=True):
        alone = parts_of(mesh)
        np.testing.assert_allclose(row, edge_features(alone.scene, alone.properties)[0], atol=1e-9)


def test_soup_is_welded():
    vertices, faces = BOX
    vertices, faces = np.asarray(vertices), np.asarray(faces)
    soup = vertices[faces.reshape(-1)], np.arange(3 * len(faces)).reshape(-1, 3)
    parts = parts_of(soup, (vertices, faces))
    features = edge_features(parts.scene, parts.properties)
    np.testing.assert_allclose(features[0], features[1])


SAME = ("quartered", "shuffled", "soup", pytest.param("flipped", marks=pytest.mark.long))
"""Ways to cut the same surface into other triangles."""


def devices():
    """A body of each family in a few plants, drawn by different systems, by its family and name."""
    found = {}
    for k, system in enumerate(SYSTEMS):
        for component in make_in_system(200 + k, system).components:
            found.setdefault((component.family, component.name), (component.vertices, component.faces))
    return list(found.values())


@pytest.fixture(scope="module")
def bodies():
    return [mesh for mesh in devices() if len(mesh[1]) < 4000][::2]


def share_that_moved(before, after):
    """Of the shapes some number of which is another; few have two axes or boxes that are as good as each other."""
    forms, sizes = np.abs(after.forms - before.forms).max(axis=1), np.abs(after.sizes - before.sizes).max(axis=1)
    return ((forms > 0.05) | (sizes > 0.02)).mean()


@pytest.fixture(scope="module")
def before(bodies):
    return described(*bodies)


@pytest.mark.parametrize("mesher", SAME)
def test_other_triangles_change_nothing(bodies, before, mesher):
    random = np.random.default_rng(3)
    after = described(*(MESHERS[mesher](mesh, random) for mesh in bodies))
    assert share_that_moved(before, after) < 0.05


def test_mirror_images_and_turns_change_nothing(bodies, before):
    mirrored = [(np.asarray(vertices) * [-1, 1, 1], np.asarray(faces)[:, ::-1]) for vertices, faces in bodies]
    assert share_that_moved(before, described(*mirrored)) < 0.07
    turn = Rotation.from_euler("z", 37, degrees=True).as_matrix()
    assert share_that_moved(before, described(*(shapes.moved(mesh, turn, (1, 2, 3)) for mesh in bodies))) < 0.07
