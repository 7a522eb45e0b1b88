import numpy as np
import pytest

import graphs
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import GraphDocument, Mechanism, Site
from cadgraph.model.scene import Scene
from cadgraph.simulate.dynamics import ARMATURE, DENSITY, SHEET, find_devices, grip
from cadplants.solids.mesh_ops import merge, moved
from cadplants.solids.primitives import box, cylinder, torus
from cadplants.solids.transforms import at, spun

POSE = at(1.0, 2.0, 3.0) @ spun("x", 0.4) @ spun("z", 0.3)


def device(*solids, kind="handwheel", pose=POSE, **more):
    """The joint of a valve whose meshes are these, about their z, which a pose moved."""
    placed = [moved(solid, pose) for solid in solids]
    scene = Scene.from_meshes([(solid.vertices, solid.faces) for solid in placed])
    values = {
        "kind": kind,
        "meshes": scene.paths,
        "axis": tuple(pose[:3, 2].tolist()),
        "pivot": tuple(pose[:3, 3].tolist()),
        "radius": 0.2,
        "thickness": 0.01,
        "limits": (-90.0, 0.0),
    }
    unit = graphs.unit("V-1").model_copy(update={"mechanism": Mechanism(**{**values, **more})})
    graph = SceneGraph(GraphDocument(nodes=(Site(id="site"), unit), edges=()))
    (found,) = find_devices(graph, scene)
    return found


def test_a_solid_wheel_weighs_and_resists_as_a_cylinder_of_steel_does():
    found = device(cylinder(0.2, -0.01, 0.01, 256))
    mass = DENSITY * np.pi * 0.2**2 * 0.02
    assert found.mass == pytest.approx(mass, rel=1e-3)
    flat = mass * (3 * 0.2**2 + 0.02**2) / 12
    assert found.inertia == pytest.approx([flat, flat, mass * 0.2**2 / 2], rel=2e-3)
    assert found.why["mass"] == "volume, at 7850 kg/m3 (assumed: steel)"


def test_a_wheel_that_is_inside_out_weighs_the_same():
    solid = cylinder(0.2, -0.01, 0.01, 64)
    inside_out = type(solid)(solid.vertices, solid.faces[:, ::-1])
    assert device(inside_out).mass == pytest.approx(device(solid).mass)


def test_an_open_surface_weighs_as_sheet_and_says_so():
    solid = cylinder(0.2, -0.01, 0.01, 64)
    sheet = type(solid)(solid.vertices, solid.faces[:-1])
    found = device(sheet)
    area = 2 * np.pi * 0.2**2 + 2 * np.pi * 0.2 * 0.02
    assert found.mass == pytest.approx(area * SHEET * DENSITY, rel=0.02)
    assert "of open surfaces area at 3 mm" in found.why["mass"]


def test_friction_grows_with_the_radius_and_the_force_of_its_kind():
    assert device(cylinder(0.2, 0, 0.01, 16)).friction == pytest.approx(40 * 0.2)
    lever = device(box((0.2, 0.02, 0.01), (0.1, 0, 0)), kind="lever")
    assert lever.friction == pytest.approx(60 * 0.2)
    assert lever.armature == ARMATURE
    needle = device(box((0.02, 0.002, 0.001), (0.01, 0, 0)), kind="needle", radius=0.02, thickness=None)
    assert needle.friction == needle.damping == 0
    assert grip(needle) == ()


def test_the_frame_of_a_body_is_right_handed_and_x_lies_along_its_lever():
    found = device(box((0.2, 0.02, 0.01), (0.1, 0, 0)), kind="lever")
    assert np.allclose(found.turn @ found.turn.T, np.eye(3))
    assert np.linalg.det(found.turn) == pytest.approx(1)
    assert np.allclose(found.turn, POSE[:3, :3].T, atol=1e-9)
    (bar,) = grip(found)
    assert bar.end == pytest.approx((0.19, 0, 0))


def test_the_ring_of_a_dished_wheel_lies_in_its_rim():
    rim = moved(torus(0.2, 0.01, 32), at(0, 0, 0.05))
    found = device(merge([rim, cylinder(0.02, -0.02, 0.02, 16)]))
    shapes = grip(found)
    assert len(shapes) == 20
    assert [each.start[2] for each in shapes[:16]] == pytest.approx([0.05] * 16, abs=1e-3)
    reach = [np.hypot(*each.start[:2]) for each in shapes[:16]]
    assert reach == pytest.approx([0.2] * 16)
    assert {each.radius for each in shapes[:16]} == {0.01}


def test_only_the_pieces_that_turn_count():
    both = merge([cylinder(0.2, -0.01, 0.01, 32), cylinder(0.05, -1.0, -0.5, 32)])
    found = device(both, pieces=(0,))
    assert found.mass == pytest.approx(device(cylinder(0.2, -0.01, 0.01, 32)).mass, rel=1e-6)
    assert found.moving[0].faces.sum() == len(cylinder(0.2, -0.01, 0.01, 32).faces)


def test_pieces_that_a_mesh_does_not_have_are_refused():
    with pytest.raises(ValueError, match="V-1 turns pieces of mesh '/mesh_0' that it doesn't have"):
        device(cylinder(0.2, 0, 0.01, 16), pieces=(7,))
