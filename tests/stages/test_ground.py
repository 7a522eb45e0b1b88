import numpy as np
import pytest

import shapes
from cadgraph.config import GroundConfig
from cadgraph.geometry.mesh.properties import measure
from cadgraph.model.scene import Scene
from cadgraph.stages.ground import find_ground


def ground_of(*meshes, **settings):
    scene = Scene.from_meshes(meshes)
    return np.flatnonzero(find_ground(scene, measure(scene), GroundConfig(**settings))).tolist()


MACHINE = shapes.box((1.0, 1.0, 2.0), (0, 0, 1.0))
FLOOR = shapes.box((6.0, 5.0, 0.1), (0, 0, -0.05))


def test_a_large_flat_lowest_mesh_is_the_ground():
    assert ground_of(MACHINE, FLOOR) == [1]


def test_a_plane_without_thickness_is_the_ground_too():
    plane = ([[-3, -3, 0], [3, -3, 0], [3, 3, 0], [-3, 3, 0]], [[0, 1, 2], [0, 2, 3]])
    assert ground_of(MACHINE, plane) == [1]


def test_a_plate_on_feet_is_no_ground():
    plate = shapes.box((4.0, 3.0, 0.02), (0, 0, 0.2))
    foot = shapes.box((0.1, 0.1, 0.19), (1.5, 1, 0.095))
    assert ground_of(plate, foot, shapes.box((1, 1, 1), (0, 0, 0.71))) == []


def test_a_plate_that_ends_with_its_machine_is_no_ground():
    assert ground_of(shapes.box((4.0, 3.0, 0.02)), shapes.box((3.9, 2.9, 1), (0, 0, 0.51))) == []


def test_a_roof_is_no_ground():
    assert ground_of(MACHINE, shapes.box((6.0, 5.0, 0.1), (0, 0, 3.0))) == []


def test_a_small_plate_is_no_ground():
    assert ground_of(shapes.box((0.5, 0.5, 0.01)), shapes.box((0.1, 0.1, 0.1), (0, 0, 0.055))) == []


def test_a_single_mesh_and_nothing_have_no_ground():
    assert ground_of(FLOOR) == []
    assert ground_of() == []


def test_foundations_that_reach_below_leave_it_the_ground():
    assert ground_of(MACHINE, FLOOR, shapes.box((0.5, 0.5, 1.5), (0, 0, -0.5))) == [1]


def test_buried_pipes_are_allowed_by_a_setting():
    buried = shapes.box((3.0, 0.1, 0.1), (0, 0, -1.0))
    assert ground_of(MACHINE, FLOOR, buried) == []
    assert ground_of(MACHINE, FLOOR, buried, max_buried=0.5) == [1]


def test_it_can_be_named_or_switched_off():
    assert ground_of(MACHINE, FLOOR, find="named", meshes=("/mesh_0",)) == [0]
    assert ground_of(MACHINE, FLOOR, find="none") == []


def test_a_name_that_is_not_in_the_scene_is_an_error():
    with pytest.raises(ValueError, match="/nowhere"):
        ground_of(MACHINE, find="named", meshes=("/nowhere",))
