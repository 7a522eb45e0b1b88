from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import shapes
from cadgraph.geometry.contact.pairs import find_contacts
from cadgraph.geometry.contact.region import contact_regions
from cadgraph.model.scene import Scene

EPS = 0.01


def region_of(*meshes, eps=EPS):
    scene = Scene.from_meshes(meshes)
    contacts = find_contacts(scene, eps)
    assert len(contacts.pairs) == 1
    return contact_regions(scene, contacts, eps)


@pytest.mark.parametrize("gap", [0.0, 0.003, 0.0099])
def test_box_on_box_is_a_face_of_the_smaller_one(gap):
    region = region_of(shapes.box((2, 2, 1)), shapes.box((0.4, 0.2, 1), (0.3, 0.1, 1 + gap)))
    np.testing.assert_allclose(region.centroid[0], [0.3, 0.1, 0.5 + gap / 2], atol=1e-9)
    np.testing.assert_allclose(region.normal[0], [0, 0, 1], atol=1e-9)
    assert region.area[0] == pytest.approx(0.08)
    np.testing.assert_allclose(region.extents[0], [0.4, 0.2, 0], atol=1e-6)
    assert region.length[0] == pytest.approx(0.4)
    assert region.flatness[0] == pytest.approx(1)


def test_normal_points_from_first_to_second():
    low, high = shapes.box((1, 1, 1)), shapes.box((1, 1, 1), (0, 0, 1))
    np.testing.assert_allclose(region_of(high, low).normal[0], [0, 0, -1], atol=1e-9)


def test_boxes_that_overlap_a_little_still_meet_in_a_face():
    region = region_of(shapes.box((2, 2, 1)), shapes.box((0.4, 0.2, 1), (0, 0, 0.998)))
    np.testing.assert_allclose(region.centroid[0], [0, 0, 0.499], atol=1e-9)
    np.testing.assert_allclose(region.normal[0], [0, 0, 1], atol=1e-9)
    assert region.area[0] == pytest.approx(0.08)


@pytest.mark.parametrize("roll", [0.0, np.pi / 48, 0.03])
def test_cylinder_on_plane_is_a_line_without_area(roll):
    turn = Rotation.from_euler("yz", [np.pi / 2, 0]).as_matrix() @ Rotation.from_euler("z", roll).as_matrix()
    lying = shapes.moved(shapes.cylinder(0.1, 0.8, 48), turn)
    lowest = lying[0][:, 2].min()
    lying = shapes.moved(lying, translation=(0.2, 0.3, 0.5 - lowest))
    region = region_of(shapes.box((4, 4, 1)), lying)
    assert region.area[0] == 0
    np.testing.assert_allclose(region.centroid[0, :2], [0.2, 0.3], atol=2e-3)
    np.testing.assert_allclose(region.normal[0], [0, 0, 1], atol=0.05)
    assert region.length[0] == pytest.approx(0.8, rel=1e-2)
    assert abs(region.axes[0, 0, 0]) == pytest.approx(1, abs=1e-3)


def test_sphere_on_plane_is_a_point_without_area():
    region = region_of(shapes.box((4, 4, 1)), shapes.moved(shapes.sphere(0.2, 48, 24), translation=(0.5, -0.2, 0.7)))
    assert region.area[0] == 0
    np.testing.assert_allclose(region.centroid[0, :2], [0.5, -0.2], atol=1e-6)
    np.testing.assert_allclose(region.normal[0], [0, 0, 1], atol=1e-6)
    assert region.length[0] < 0.15


def test_flange_on_flange_is_a_ring_about_the_axis():
    turn = Rotation.from_rotvec([0.4, 0.7, 0.1]).as_matrix()
    low = shapes.moved(shapes.tube(0.1, 0.05, 0.02, 32), turn)
    twist = Rotation.from_euler("z", 0.05).as_matrix()
    high = shapes.moved(shapes.moved(shapes.tube(0.1, 0.05, 0.02, 32), twist), turn, turn @ [0, 0, 0.021])
    region = region_of(low, high)
    np.testing.assert_allclose(region.centroid[0], turn @ [0, 0, 0.0105], atol=1e-6)
    np.testing.assert_allclose(region.normal[0], turn @ [0, 0, 1], atol=1e-6)
    assert region.area[0] == pytest.approx(np.pi * (0.1**2 - 0.05**2), rel=0.02)


def test_butt_joint_of_pipes_lies_on_the_axis():
    first = shapes.moved(shapes.tube(0.05, 0.046, 1.0, 24), translation=(0, 0, 0.5))
    second = shapes.moved(shapes.tube(0.05, 0.046, 2.0, 24), translation=(0, 0, 2.0))
    region = region_of(first, second)
    np.testing.assert_allclose(region.centroid[0], [0, 0, 1], atol=1e-9)
    np.testing.assert_allclose(region.normal[0], [0, 0, 1], atol=1e-9)


def test_tap_on_the_side_of_a_pipe_lies_where_the_axes_meet_its_wall():
    pipe = shapes.moved(shapes.tube(0.1, 0.09, 2.0, 48), Rotation.from_euler("y", np.pi / 2).as_matrix())
    tap = shapes.moved(shapes.tube(0.02, 0.016, 0.3, 24), translation=(0.4, 0, 0.15 + 0.095))
    region = region_of(pipe, tap)
    np.testing.assert_allclose(region.centroid[0, :2], [0.4, 0], atol=2e-3)
    assert region.centroid[0, 2] == pytest.approx(0.097, abs=0.006)
    assert region.length[0] < 0.08


def test_sleeve_on_a_pipe_has_no_mean_normal():
    pipe = shapes.tube(0.05, 0.04, 2.0, 32)
    sleeve = shapes.tube(0.06, 0.051, 0.3, 32)
    region = region_of(pipe, shapes.moved(sleeve, translation=(0, 0, 0.2)))
    np.testing.assert_allclose(region.centroid[0], [0, 0, 0.2], atol=1e-9)
    assert region.flatness[0] < 1e-6
    np.testing.assert_allclose(region.normal[0], [0, 0, 1])
    assert region.area[0] == pytest.approx(2 * np.pi * 0.0505 * 0.3, rel=0.02)


def test_edge_on_plane_is_a_line_without_area():
    turned = shapes.moved(shapes.box((0.1, 0.6, 0.1)), Rotation.from_euler("y", np.pi / 4).as_matrix())
    region = region_of(shapes.box((4, 4, 1)), shapes.moved(turned, translation=(0, 0.2, 0.5 + 0.05 * np.sqrt(2))))
    assert region.area[0] == 0
    np.testing.assert_allclose(region.centroid[0, :2], [0, 0.2], atol=1e-6)
    assert region.length[0] == pytest.approx(0.6, rel=0.05)


def test_crossing_sheets_meet_in_a_line():
    sheet = np.array([[-0.5, -0.5, 0], [0.5, -0.5, 0], [0.5, 0.5, 0], [-0.5, 0.5, 0]]), np.array([[0, 1, 2], [0, 2, 3]])
    upright = shapes.moved(sheet, Rotation.from_euler("x", np.pi / 2).as_matrix(), (0, 0.1, 0.5))
    region = region_of(sheet, upright)
    assert region.area[0] == 0
    np.testing.assert_allclose(region.centroid[0, 1:], [0.1, 0], atol=5e-3)


def test_corner_at_corner_is_a_point():
    region = region_of(shapes.box(), shapes.box((1, 1, 1), (1.001, 1.001, 1.001)))
    assert region.area[0] == 0
    np.testing.assert_allclose(region.centroid[0], [0.5005] * 3, atol=1e-9)
    np.testing.assert_allclose(region.normal[0], np.ones(3) / np.sqrt(3), atol=1e-9)


def test_thin_sheet_counts_once():
    region = region_of(shapes.box((2, 2, 1)), shapes.box((0.4, 0.4, 0.002), (0, 0, 0.5 + 0.001)))
    assert region.area[0] == pytest.approx(0.16)
    np.testing.assert_allclose(region.centroid[0], [0, 0, 0.5], atol=1e-9)


def test_regions_follow_rigid_motion_and_workers_change_nothing():
    meshes = [shapes.box((2, 2, 1)), shapes.box((0.4, 0.2, 1), (0.3, 0.1, 1)), shapes.sphere(0.2, 16, 8)]
    meshes[2] = shapes.moved(meshes[2], translation=(-0.5, -0.5, 0.703))
    turn, shift = Rotation.from_rotvec([1, 2, 3]).as_matrix(), np.array([10.0, -4, 3])
    scene, after = Scene.from_meshes(meshes), Scene.from_meshes([shapes.moved(m, turn, shift) for m in meshes])
    contacts, contacts_after = find_contacts(scene), find_contacts(after)
    found, moved = contact_regions(scene, contacts), contact_regions(after, contacts_after)
    np.testing.assert_allclose(moved.centroid, found.centroid @ turn.T + shift, atol=1e-6)
    np.testing.assert_allclose(moved.normal, found.normal @ turn.T, atol=1e-6)
    np.testing.assert_allclose(moved.area, found.area, atol=1e-9)
    one, many = contact_regions(scene, contacts, workers=1), contact_regions(scene, contacts, workers=4)
    for name in ("centroid", "normal", "flatness", "area", "extents", "axes"):
        assert getattr(one, name).tobytes() == getattr(many, name).tobytes() == getattr(found, name).tobytes()


def test_no_contacts_have_no_regions():
    scene = Scene.from_meshes([shapes.box()])
    region = contact_regions(scene, find_contacts(scene))
    assert region.centroid.shape == (0, 3)
    assert region.axes.shape == (0, 3, 3)


def test_impossible_limit_is_refused():
    scene = Scene.from_meshes([shapes.box()])
    with pytest.raises(ValueError, match="eps"):
        contact_regions(scene, find_contacts(scene), -1)
