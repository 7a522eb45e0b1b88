import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import plates
import shapes
import tubes
from cadgraph.geometry.line import part_lines
from cadgraph.geometry.line.part_lines import lines_of_parts
from cadgraph.geometry.mesh.properties import measure
from cadgraph.model.scene import Scene
from cadgraph.stages.parts import make_parts

ELBOW = tubes.elbow(0.2, 0.03, np.pi / 2, 24, 24)
FLANGE = shapes.tube(0.1, 0.05, 0.02, 48)
STEPPED = shapes.lathe([(0, 0), (0.1, 0), (0.1, 0.02), (0.06, 0.02), (0.06, 0.03), (0, 0.03)], 48)


def lines_of(*meshes):
    parts = plates.parts_of(Scene.from_meshes(meshes))
    return lines_of_parts(parts.scene, parts.properties, parts, range(len(meshes)))


def spread(line):
    return np.sort(np.array([end.point for end in line.ends]), axis=0)


def test_disc_has_its_axis_from_face_to_face():
    turn = Rotation.random(random_state=4).as_matrix()
    (line,) = lines_of(shapes.moved(FLANGE, turn, (1, 2, 3))).values()
    assert line.length == pytest.approx(0.02)
    for end in line.ends:
        assert (end.radius, end.bore) == (pytest.approx(0.1), pytest.approx(0.05))
        assert abs(end.direction @ turn[:, 2]) == pytest.approx(1.0)
        assert end.direction @ (end.point - [1, 2, 3]) == pytest.approx(0.01)


def test_each_end_of_a_disc_has_the_radius_of_its_face():
    (line,) = lines_of(STEPPED).values()
    assert sorted(end.radius for end in line.ends) == [pytest.approx(0.06), pytest.approx(0.1)]
    assert all(np.isnan(end.bore) for end in line.ends)


def test_a_hollow_pipe_is_as_wide_all_along_whichever_way_its_faces_look():
    vertices, faces = shapes.tube(0.0167, 0.0133, 0.3, 20)
    for wound in (faces, faces[:, ::-1]):
        (line,) = lines_of((vertices, wound)).values()
        assert line.branches[0].radius == pytest.approx(0.0167)


def test_a_low_raised_face_is_one_with_its_flange():
    outline = [(0.026, -0.02), (0.046, -0.02), (0.046, -0.0195), (0.075, -0.0195), (0.075, 0.0195), (0.046, 0.0195),
               (0.046, 0.02), (0.026, 0.02)]  # fmt: skip
    (line,) = lines_of(shapes.lathe(outline, 48, closed=True)).values()
    assert line.length == pytest.approx(0.04)
    assert [(end.radius, end.bore) for end in line.ends] == [(pytest.approx(0.075), pytest.approx(0.026))] * 2


def test_bolts_that_stand_out_do_not_move_the_faces():
    bolts = [
        shapes.moved(shapes.cylinder(0.008, 0.06, 12), translation=(0.08 * np.cos(a), 0.08 * np.sin(a), 0))
        for a in np.arange(4) * np.pi / 2
    ]
    pieces = [shapes.lathe([(0.05, -0.01), (0.1, -0.01), (0.1, 0.01), (0.05, 0.01)], 48, closed=True), *bolts]
    starts = np.cumsum([0, *(len(v) for v, _ in pieces)])
    faces = np.concatenate([f + s for (_, f), s in zip(pieces, starts[:-1], strict=True)])
    (line,) = lines_of((np.concatenate([v for v, _ in pieces]), faces)).values()
    assert line.length == pytest.approx(0.02)
    assert [(end.radius, end.bore) for end in line.ends] == [(pytest.approx(0.1), pytest.approx(0.05))] * 2


def test_a_nose_before_a_face_belongs_to_the_axis():
    nosed = shapes.lathe([(0, 0), (0.1, 0), (0.1, 0.02), (0.05, 0.02), (0.04, 0.05), (0.02, 0.07), (0, 0.075)], 48)
    (line,) = lines_of(nosed).values()
    assert line.length == pytest.approx(0.075)


def test_boxes_and_balls_have_no_line():
    assert lines_of(shapes.box(), shapes.box((1, 1, 0.1))) == {}


def test_repeats_have_the_line_of_the_first_moved_to_their_place(monkeypatch):
    turn = Rotation.random(random_state=5).as_matrix()
    joined = []
    join = part_lines.join_mouths
    monkeypatch.setattr(part_lines, "join_mouths", lambda *given: joined.append(given) or join(*given))
    lines = lines_of(ELBOW, FLANGE, shapes.moved(ELBOW, turn, (4, 5, 6)))
    assert len(joined) == 1
    assert lines[2].length == pytest.approx(lines[0].length)
    np.testing.assert_allclose(
        [turn @ end.point + [4, 5, 6] for end in lines[0].ends], [end.point for end in lines[2].ends], atol=1e-6
    )
    (alone,) = lines_of(shapes.moved(ELBOW, turn, (4, 5, 6))).values()
    np.testing.assert_allclose(spread(lines[2]), spread(alone), atol=1e-6)


def test_what_was_traced_before_is_not_traced_again(monkeypatch):
    parts = plates.parts_of(Scene.from_meshes([ELBOW, FLANGE]))
    first = lines_of_parts(parts.scene, parts.properties, parts, [1, 0])
    assert list(first) == [1, 0]
    monkeypatch.setattr(part_lines, "join_mouths", lambda *_: pytest.fail("traced again"))
    assert lines_of_parts(parts.scene, parts.properties, parts, [0, 1])[0] is first[0]


def test_a_part_of_several_meshes_has_the_line_of_the_first():
    nut = shapes.box((0.02, 0.02, 0.02), (0.08, 0, 0.02))
    scene = Scene.from_meshes([nut, FLANGE, shapes.moved(FLANGE, translation=(1, 0, 0))])
    properties = measure(scene)
    parts = make_parts(scene, properties, np.array([1, 1, 2]), np.zeros(3, np.bool_))
    lines = lines_of_parts(scene, properties, parts, [0, 1])
    assert lines[0].length == pytest.approx(0.02)
    assert lines[0].ends[0].radius == pytest.approx(0.1)
    assert lines[1].ends[0].point[0] == pytest.approx(1.0)


def test_nothing_asked_gives_nothing():
    assert lines_of() == {}
