import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import shapes
import tubes
from cadgraph.geometry.mesh.properties import measure
from cadgraph.geometry.shape.analysis import analyse_shapes, measure_shapes
from cadgraph.model.scene import Scene


def measured(mesh):
    scene = Scene.from_meshes([mesh])
    (facts,) = measure_shapes(scene, measure(scene))
    return facts


def analysed(*meshes):
    scene = Scene.from_meshes(meshes)
    return analyse_shapes(scene, measure(scene))


def joined(*meshes):
    starts = np.cumsum([0, *(len(v) for v, _ in meshes)])
    return (
        np.concatenate([v for v, _ in meshes]),
        np.concatenate([f + s for (_, f), s in zip(meshes, starts[:-1], strict=True)]),
    )


def drilled(holes):
    angles = np.arange(holes) * 2 * np.pi / holes
    bolts = [
        shapes.moved(shapes.cylinder(0.009, 0.021, 12), translation=(0.08 * np.cos(a), 0.08 * np.sin(a), 0))
        for a in angles
    ]
    return joined(shapes.tube(0.1, 0.05, 0.02, 48), *bolts)


TUBE = shapes.tube(0.05, 0.04, 0.3)
POT = shapes.lathe([(0, 0), (0.1, 0), (0.1, 0.3), (0.08, 0.3), (0.08, 0.1), (0, 0.1)])


@pytest.mark.parametrize("sides", [6, 8, 12, 24, 64])
def test_tube_has_its_dimensions_in_any_pose(sides):
    turn = Rotation.random(random_state=1).as_matrix()
    facts = measured(shapes.moved(shapes.tube(0.05, 0.04, 0.3, sides), turn, (1, 2, 3)))
    assert facts.radius == pytest.approx(0.05)
    assert facts.length == pytest.approx(0.3)
    assert facts.bore == pytest.approx(0.04)
    assert facts.tube == pytest.approx(0.3, rel=1e-3)
    assert facts.sides == sides
    assert abs(facts.axis @ turn[:, 2]) == pytest.approx(1.0)
    np.testing.assert_allclose(facts.outer, 0.05, rtol=1e-6)
    np.testing.assert_allclose(facts.inner, 0.04, rtol=1e-6)
    assert facts.section[0] == pytest.approx(0.3)


def test_tube_has_two_ports_that_face_outward():
    facts = measured(TUBE)
    assert len(facts.ports) == 2
    middle = np.mean([port.center for port in facts.ports], axis=0)
    for port in facts.ports:
        assert port.normal @ (port.center - middle) == pytest.approx(0.15)
        assert (port.outer, port.inner) == (pytest.approx(0.05), pytest.approx(0.04))


@pytest.mark.parametrize(("mesh", "bore"), [
    (TUBE, 0.04), ((TUBE[0], TUBE[1][:, ::-1]), 0.04), (shapes.cylinder(0.05, 0.3), 0.0), (POT, 0.0),
    (drilled(8), 0.05), (shapes.box((1, 2, 3)), 0.0),
], ids=["tube", "inside out", "rod", "pot", "flange", "box"])  # fmt: skip
def test_bore_is_open_along_the_whole_axis(mesh, bore):
    assert measured(mesh).bore == pytest.approx(bore)


def test_flange_with_bolts_is_still_round():
    facts = measured(drilled(8))
    assert facts.turned > 0.7
    assert facts.radius == pytest.approx(0.1)


def test_bend_has_the_length_of_its_middle():
    facts = measured(tubes.elbow(0.2, 0.03, np.pi / 2, 24, 24))
    assert facts.bent
    assert facts.tube == pytest.approx(0.2 * np.pi / 2, rel=0.02)


@pytest.mark.parametrize(("mesh", "side"), [
    (shapes.box((1, 2, 3)), 0), (shapes.tube(0.1, 0.09, 2, 4), 0), (shapes.cylinder(0.1, 0.005), 2),
    (shapes.sphere(), -1), (POT, -1),
], ids=["box", "square tube", "disc", "sphere", "pot"])  # fmt: skip
def test_constant_section_runs_along_a_side_of_the_box(mesh, side):
    assert measured(mesh).extruded == side


def test_repeats_share_what_was_measured_of_the_first():
    turn = Rotation.random(random_state=3).as_matrix()
    found = analysed(TUBE, shapes.box(), shapes.moved(TUBE, turn, (4, 5, 6)))
    assert found.shape.tolist() == [0, 1, 0]
    assert found.first.tolist() == [0, 1]
    assert len(found.facts) == 2
    moved = [found.turn[2] @ port.center + found.shift[2] for port in found.facts[0].ports]
    there = [port.center for port in measured(shapes.moved(TUBE, turn, (4, 5, 6))).ports]
    np.testing.assert_allclose(np.sort(moved, axis=0), np.sort(there, axis=0), atol=1e-6)


def test_what_cannot_be_measured_has_finite_facts():
    empty = (np.zeros((0, 3)), np.zeros((0, 3)))
    point = (np.zeros((3, 3)), [[0, 1, 2]])
    bad = (np.full((3, 3), np.nan), [[0, 1, 2]])
    for facts in analysed(empty, point, bad).facts:
        assert (facts.turned, facts.sides, facts.tube, facts.bore, facts.extruded) == (0.0, 0, 0.0, 0.0, -1)
        assert facts.ports == ()
    assert analysed().facts == ()


def test_faces_that_are_not_finite_are_left_out():
    vertices, faces = TUBE
    broken = np.concatenate([vertices, [[np.nan] * 3]]), np.concatenate([faces, [[0, 1, len(vertices)]]])
    assert measured(broken).radius == pytest.approx(0.05)


def test_input_is_not_modified():
    scene = Scene.from_meshes([TUBE, shapes.box()])
    properties = measure(scene)
    vertices, box = scene.vertices.copy(), properties.obb_center.copy()
    analyse_shapes(scene, properties)
    np.testing.assert_array_equal(scene.vertices, vertices)
    np.testing.assert_array_equal(properties.obb_center, box)
