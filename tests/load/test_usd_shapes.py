from __future__ import annotations

import numpy as np
import pytest

from cadgraph.load.usd_shapes import SHAPES

SIDES = 64
CASES = {
    "Cube": ({"size": 2.0}, 8, (2, 2, 2)),
    "Sphere": ({"radius": 1.5}, 4 / 3 * np.pi * 1.5**3, (3, 3, 3)),
    "Cylinder": ({"radius": 1.0, "height": 3.0}, np.pi * 3, (2, 2, 3)),
    "Cylinder_1": ({"radiusBottom": 2.0, "radiusTop": 1.0, "height": 3.0}, np.pi * 7, (4, 4, 3)),
    "Cone": ({"radius": 1.0, "height": 3.0}, np.pi, (2, 2, 3)),
    "Capsule": ({"radius": 1.0, "height": 3.0}, np.pi * (3 + 4 / 3), (2, 2, 5)),
    "Capsule_1": ({"radiusBottom": 1.0, "radiusTop": 1.0, "height": 3.0}, np.pi * (3 + 4 / 3), (2, 2, 5)),
}


def make(name, sizes, axis="Z", sides=SIDES):
    return SHAPES[name][1](sizes | {"axis": axis}, sides)


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("axis", ["X", "Y", "Z"])
def test_solids_are_closed_outward_and_of_the_right_size(name, axis):
    sizes, volume, extent = CASES[name]
    points, faces = make(name, sizes, axis)
    assert np.linalg.det(points[faces]).sum() / 6 == pytest.approx(volume, rel=0.01)
    order = {"X": [2, 0, 1], "Y": [1, 2, 0], "Z": [0, 1, 2]}[axis]
    expected = extent if name in ("Cube", "Sphere") else np.array(extent)[order]
    np.testing.assert_allclose(np.ptp(points, axis=0), expected, rtol=1e-9)
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    assert {tuple(e) for e in edges.tolist()} == {tuple(e[::-1]) for e in edges.tolist()}
    assert len(np.unique(faces)) == len(points)


def test_cone_points_along_its_axis():
    points, _ = make("Cone", {"radius": 1.0, "height": 2.0}, "X")
    np.testing.assert_allclose(points[np.argmax(points[:, 0])], [1, 0, 0], atol=1e-12)
    assert (np.isclose(points[:, 0], -1)).sum() == SIDES + 1


@pytest.mark.parametrize(("axis", "normal", "extent"), [("X", 0, (0, 3, 2)), ("Y", 1, (2, 0, 3)), ("Z", 2, (2, 3, 0))])
def test_plane_faces_along_its_axis(axis, normal, extent):
    points, faces = make("Plane", {"width": 2.0, "length": 3.0}, axis)
    np.testing.assert_allclose(np.ptp(points, axis=0), extent)
    facing = np.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]])
    assert (facing[:, normal] > 0).all()


def test_sides_set_the_number_of_triangles():
    assert len(make("Cylinder", CASES["Cylinder"][0], sides=6)[1]) == 24
