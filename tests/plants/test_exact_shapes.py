import numpy as np
import pytest
from scipy.spatial import ConvexHull

from cadplants.solids.mesh_ops import Solid, merge, moved, tube, volume
from cadplants.solids.primitives import along, ball, bar, box, cylinder, dome, hexagon, ring, rod, torus, turned
from cadplants.solids.transforms import arc, at, spun
from cadplants.writers.exact_shapes import fit, surface

TURNED = at(3, -2, 1) @ spun("x", 0.4) @ spun("z", 1.1)
BEND = tube(arc((0, 0, 0), (0.2, 0, 0), (0.2, 0.2, 0), 6), 0.05, 0.0, 16)
SHAPES = {
    "box": (box((0.1, 0.2, 0.3), (1, 2, 3)), (0.1, 0.2, 0.3)),
    "cylinder": (cylinder(0.2, 0.1, 1.3, 16), (0.2, 1.2)),
    "ring": (ring(0.1, 0.15, 0.0, 0.4, 24), (0.1, 0.15, 0.4)),
    "torus": (BEND, (0.2, 0.05, np.pi / 2)),
    "dish": (dome(0.5, 0.2, 1.0, 24), (0.5, 0.2)),
    "sphere": (ball(0.25, 16), (0.25,)),
    "snout": (turned([(0.3, 0.0), (0.1, 0.4)], 16), (0.3, 0.1, 0.4, 0.0, 0.0)),
}


@pytest.mark.parametrize("kind", SHAPES)
@pytest.mark.parametrize("pose", [np.eye(4), TURNED], ids=["straight", "turned"])
def test_a_tessellated_primitive_is_found_with_its_sizes(kind, pose):
    solid, sizes = SHAPES[kind]
    found = fit(moved(solid, pose))
    if kind == "sphere" and pose is TURNED:
        assert found is None or found.kind == "sphere"
        return
    assert found is not None
    assert found.kind == kind
    # Which edge of a box, and which end of a cone, comes first is nobody's business.
    alike = sorted if kind in ("box", "snout") else tuple
    assert alike(found.sizes) == pytest.approx(alike(sizes), abs=1e-6)
    assert found.pose[:3, :3].T @ found.pose[:3, :3] == pytest.approx(np.eye(3), abs=1e-9)
    assert np.linalg.det(found.pose[:3, :3]) == pytest.approx(1)


@pytest.mark.parametrize("kind", SHAPES)
def test_the_corners_of_the_mesh_lie_on_the_hull_of_the_primitive(kind):
    solid = moved(SHAPES[kind][0], TURNED)
    found = fit(solid)
    if found is None:
        assert kind == "sphere"
        return
    points = surface(found, 96)
    low, high = points.min(axis=0), points.max(axis=0)
    slack = 0.02 * (high - low).max()
    assert (solid.vertices.min(axis=0) >= low - slack).all()
    assert (solid.vertices.max(axis=0) <= high + slack).all()
    middle = (low + high) / 2
    assert (solid.vertices.min(axis=0) + solid.vertices.max(axis=0)) / 2 == pytest.approx(middle, abs=slack)


def test_a_pyramid_keeps_its_ends_and_its_offset():
    low = np.array([[0, 0, 0], [0.4, 0, 0], [0.4, 0.2, 0], [0, 0.2, 0.0]])
    high = np.array([[0.1, 0, 0.5], [0.2, 0, 0.5], [0.2, 0.1, 0.5], [0.1, 0.1, 0.5]])
    points = np.vstack([low, high])
    hull = ConvexHull(points)
    faces = np.array(
        [f if np.linalg.det(points[f] - points.mean(axis=0)) > 0 else f[::-1] for f in hull.simplices],
        np.int32,
    )
    found = fit(Solid(points, faces))
    assert found is not None
    assert found.kind == "pyramid"
    ends = surface(found)
    assert np.array(sorted(ends.tolist())) == pytest.approx(np.array(sorted(points.tolist())), abs=1e-9)


def test_an_eccentric_cone_keeps_its_offset():
    cone = turned([(0.3, 0.0), (0.1, 0.4)], 16)
    shifted = cone.vertices + np.where(cone.vertices[:, 2:] > 0.2, [[0.2, 0, 0]], 0.0)
    found = fit(Solid(shifted, cone.faces))
    assert found is not None
    assert found.kind == "snout"
    assert np.hypot(*found.sizes[3:]) == pytest.approx(0.2)
    assert surface(found, 64).max(axis=0) == pytest.approx([0.3, 0.3, 0.4], abs=1e-9)


def test_a_whole_ring_and_a_rod_anywhere_are_found():
    assert fit(torus(0.3, 0.05, 24)).kind == "torus"
    found = fit(rod((0, 0, 0), (1, 2, 3), 0.05, 12))
    assert found.kind == "cylinder"
    assert found.sizes == pytest.approx((0.05, np.sqrt(14)))


@pytest.mark.parametrize(
    "solid",
    [
        hexagon(0.02, 0, 0.01),
        bar((0, 0, 0), (0, 0, 1), np.array([[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2.0]])),
        merge([cylinder(0.1, 0, 1, 16), cylinder(0.1, 0, 1, 16)]),
        Solid(cylinder(0.1, 0, 1, 16).vertices, cylinder(0.1, 0, 1, 16).faces[:, ::-1]),
        Solid(cylinder(0.1, 0, 1, 16).vertices, cylinder(0.1, 0, 1, 16).faces[1:]),
        tube(arc((0, 0, 0), (0.2, 0, 0), (0.2, 0.2, 0), 6), 0.05, 0.04, 16),
        turned([(0.1, 0), (0.1, 0.2), (0.2, 0.2), (0.2, 0.4)], 16),
    ],
    ids=["hexagon", "angle", "doubled", "inside out", "open", "hollow bend", "stepped"],
)
def test_what_only_resembles_a_primitive_is_none(solid):
    assert fit(solid) is None


def test_a_corner_ten_micrometres_off_is_too_much():
    solid = cylinder(0.2, 0, 1, 16)
    moved_corner = solid.vertices.copy()
    moved_corner[3] *= 1 + 5e-5
    assert fit(Solid(moved_corner, solid.faces)) is None
    assert fit(along("x", solid)).kind == "cylinder"
    assert volume(solid) > 0
