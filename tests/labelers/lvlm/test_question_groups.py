import numpy as np

import plates
import shapes
from cadgraph.labelers.lvlm.question_groups import QuestionGroup, find_question_groups
from cadgraph.model.scene import Scene

UP = np.eye(3)
LYING = np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]], float)


def kinds_of(*meshes, colors=None):
    return find_question_groups(plates.parts_of(Scene.from_meshes(meshes, colors=colors)))


def test_equal_shapes_are_one_kind():
    assert kinds_of(shapes.box(), shapes.box(center=(3, 0, 0)), shapes.sphere()) == (
        QuestionGroup((0, 1)),
        QuestionGroup((2,)),
    )


def test_a_bar_that_stands_is_another_kind_than_one_that_lies():
    bar = shapes.box((0.1, 0.15, 2))
    found = kinds_of(bar, shapes.moved(bar, LYING, (3, 0, 0)), shapes.moved(bar, UP, (6, 0, 0)))
    assert [kind.parts for kind in found] == [(0, 2), (1,)]


def test_attitude_does_not_count_for_what_has_no_long_axis():
    plate = shapes.box((1, 0.9, 0.1))
    assert len(kinds_of(plate, shapes.moved(plate, LYING, (3, 0, 0)))) == 1


def test_another_paint_is_another_kind():
    colors = [[0.5, 0.1, 0.1], [0.5, 0.1, 0.1], [0.1, 0.1, 0.5]]
    meshes = [shapes.box(center=(3 * i, 0, 0)) for i in range(3)]
    assert [kind.parts for kind in kinds_of(*meshes, colors=colors)] == [(0, 1), (2,)]


def test_every_part_is_in_one_kind_but_those_without_triangles():
    scene = Scene.from_meshes([shapes.box(), ([[0, 0, 0]], np.zeros((0, 3), int)), shapes.box()])
    parts = plates.parts_of(scene)
    assert sorted(part for kind in find_question_groups(parts) for part in kind.parts) == [0, 2]
    assert [kind.parts for kind in find_question_groups(parts, "part")] == [(0,), (2,)]


def test_members_are_spread_over_all():
    kind = QuestionGroup(tuple(range(10, 20)))
    assert kind.members(1) == (10,)
    assert kind.members(3) == (10, 14, 19)
    assert kind.members(99) == kind.parts
