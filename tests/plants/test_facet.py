import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cadplants.solids.mesh_ops import Solid, box, extrude, merge, revolve, tube, weld
from cadplants.solids.polygon import circle, section_i
from cadplants.solids.tessellate import facets

pytestmark = pytest.mark.slow


def polygons(solid):
    counts, indices = facets(solid)
    return [piece.tolist() for piece in np.split(indices, np.cumsum(counts)[:-1])]


def area(solid, ring):
    points = solid.vertices[ring]
    return np.linalg.norm(sum(np.cross(points[k], points[(k + 1) % len(ring)]) for k in range(len(ring)))) / 2


def total(solid):
    a, b, c = np.moveaxis(solid.vertices[solid.faces], 1, 0)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


def test_a_box_has_six_quads():
    rings = polygons(box((1, 2, 3)))
    assert sorted(map(len, rings)) == [4] * 6


def test_a_section_has_concave_ends_of_twelve_corners():
    rings = polygons(extrude(section_i(0.1, 0.1, 0.005, 0.008), 0.0, 1.0))
    assert sorted(map(len, rings)) == [4] * 12 + [12, 12]


def test_a_fanned_cap_is_one_polygon_without_its_middle():
    solid = weld([revolve([(0, 0), (1, 0), (1, 1), (0, 1)], 8)])
    rings = polygons(solid)
    assert sorted(map(len, rings)) == [4] * 8 + [8, 8]
    assert len({corner for ring in rings for corner in ring}) == len(solid.vertices) - 2


def test_a_ring_with_a_hole_stays_in_triangles():
    solid = extrude(circle(1.0, 6), 0.0, 1.0, (circle(0.5, 6),))
    assert sorted(set(map(len, polygons(solid)))) == [3, 4]


def test_triangles_that_share_no_corners_stay_triangles():
    one = box((1, 1, 1))
    soup = Solid(one.vertices[one.faces.reshape(-1)], np.arange(36, dtype=np.int32).reshape(-1, 3))
    assert [len(ring) for ring in polygons(soup)] == [3] * 12


def test_triangles_without_area_do_no_harm():
    one = box((1, 1, 1))
    solid = Solid(one.vertices, np.concatenate([one.faces, [[0, 1, 1]]]).astype(np.int32))
    assert len(polygons(solid)) >= 6


@given(st.integers(3, 16), st.floats(0.0, 0.04), st.integers(1, 3))
def test_polygons_cover_the_same_area(sides, bore, count):
    path = np.array([[0.0, 0, 0], [0.3, 0, 0], [0.5, 0.2, 0]])
    solid = merge([tube(path, 0.05, bore if bore > 0.001 else 0.0, sides)] * count)
    assert np.isclose(sum(area(solid, ring) for ring in polygons(solid)), total(solid))
