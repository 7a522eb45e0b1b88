import numpy as np
import pytest

import shapes
from cadgraph.geometry.mesh.properties import measure
from cadgraph.geometry.mesh.sample import sample_surfaces
from cadgraph.geometry.shape.analysis import measure_shapes
from cadgraph.labelers.embedded.descriptor import FORMS, SIZES, describe_shapes
from cadgraph.labelers.embedded.edges import edge_features
from cadgraph.labelers.embedded.sample import ray_gaps
from cadgraph.model.parts import Parts
from cadgraph.model.scene import Scene


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


def test_finer_triangles_change_little_but_the_edges():
    d = described(shapes.tube(0.05, 0.04, 0.6, 32), shapes.tube(0.05, 0.04, 0.6, 64))
    rest = [i for i, name in enumerate(FORMS) if not name.startswith(("edge", "facts", "normal around"))]
    assert np.abs(d.forms[0] - d.forms[1])[rest].mean() < 0.1


def test_a_flipped_mesh_looks_the_same_but_for_where_its_points_fall():
    vertices, faces = TUBE
    d = described(TUBE, (vertices, np.asarray(faces)[:, ::-1]))
    assert np.abs(d.forms[0] - d.forms[1]).mean() < 0.02
    np.testing.assert_allclose(d.sizes[0], d.sizes[1], atol=0.01)


def test_degenerate_and_empty_shapes_have_finite_numbers():
    flat = (np.zeros((3, 3)), np.array([[0, 1, 2]]))
    d = described(flat, BOX)
    assert np.isfinite(d.forms).all()
    assert np.isfinite(d.sizes).all()
    assert described().forms.shape == (0, len(FORMS))


def test_samples_lie_on_the_surface_evenly():
    parts = parts_of(BOX, TUBE)
    samples = sample_surfaces(parts.scene, 600)
    low, high = samples.points[0].min(axis=0), samples.points[0].max(axis=0)
    np.testing.assert_allclose(high - low, [0.3, 0.2, 0.1], atol=0.02)
    # The two largest of the six faces hold 6/11 of the area.
    assert (np.abs(samples.normals[0, :, 2]) > 0.99).mean() == pytest.approx(12 / 22, abs=0.01)
    again = sample_surfaces(parts.scene, 600)
    assert np.array_equal(samples.points, again.points)


def test_rays_measure_walls_on_either_side():
    parts = parts_of(TUBE)
    gaps = ray_gaps(parts.scene, sample_surfaces(parts.scene, 400), 400)[0]
    assert np.median(gaps[:, 0]) == pytest.approx(0.01, rel=0.05)


def test_edges_tell_boxes_from_hexagons_and_count_holes():
    hexagon = shapes.cylinder(0.05, 0.1, 6)
    features = edge_features(Scene.from_meshes([BOX, hexagon, TUBE]))
    right, sixty = 7, 5  # classes of 82 to 98 and of 52 to 68 degrees
    assert features[0, right] == pytest.approx(1.0)
    assert features[1, sixty] > 0.2
    handles = features[:, 12]
    np.testing.assert_allclose(handles, [0, 0, np.log(2)], atol=1e-9)
    assert np.all(features[:, 9:11] == 0)


def test_free_edges_are_seen_and_soup_is_welded():
    vertices, faces = BOX
    vertices, faces = np.asarray(vertices), np.asarray(faces)
    soup = vertices[faces.reshape(-1)], np.arange(3 * len(faces)).reshape(-1, 3)
    features = edge_features(Scene.from_meshes([(vertices, faces[:-2]), soup, (vertices, faces)]))
    assert features[0, 9] > 0.1
    np.testing.assert_allclose(features[1], features[2])
