import numpy as np
import pytest

import shapes
from cadgraph.config import GroundConfig
from cadgraph.geometry.mesh.properties import measure
from cadgraph.model.scene import Scene
from cadgraph.stages.ground import find_ground, report_ground


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


def test_a_thick_slab_is_the_ground():
    assert ground_of(MACHINE, shapes.box((4.0, 4.0, 0.3), (0, 0, -0.15))) == [1]


def test_slabs_side_by_side_are_the_ground_together():
    halves = [shapes.box((3.0, 5.0, 0.1), (x, 0, -0.05)) for x in (-1.51, 1.51)]
    assert ground_of(shapes.box((4.0, 3.0, 2.0), (0, 0, 1.0)), *halves) == [1, 2]
    apart = [shapes.box((3.0, 5.0, 0.1), (x, 0, -0.05)) for x in (-2.5, 2.5)]
    assert ground_of(shapes.box((7.0, 3.0, 2.0), (0, 0, 1.0)), *apart) == []


def test_a_wide_slab_needs_to_reach_a_step_beyond_what_stands_on_it():
    plant = shapes.box((30.0, 28.0, 3.0), (0, 0, 1.5))
    assert ground_of(plant, shapes.box((31.0, 29.0, 0.1), (0, 0, -0.05))) == [1]
    assert ground_of(plant, shapes.box((30.2, 28.2, 0.1), (0, 0, -0.05))) == []


def told(*meshes, corrected=None, **settings):
    scene = Scene.from_meshes(meshes)
    properties, config = measure(scene), GroundConfig(**settings)
    found = find_ground(scene, properties, config)
    ground = found if corrected is None else np.array(corrected)
    return [(d.code, d.meshes, d.message) for d in report_ground(scene, properties, config, ground, found)]


def test_which_mesh_was_taken_and_why_is_told():
    [(code, meshes, message)] = told(MACHINE, FLOOR)
    assert (code, meshes) == ("ground", ("/mesh_1",))
    assert "6 m x 5 m, 0.1 m thick, under 100% of the footprint of all else, with nothing below" in message


@pytest.mark.parametrize(
    ("others", "floor", "reason"),
    [
        ([MACHINE, shapes.box((1, 1, 1), (0, 0, -2))], FLOOR, "1 of the other meshes lies wholly below it"),
        ([MACHINE, shapes.box((1, 1, 1), (20, 0, 0.5))], FLOOR, "only, less than 95%"),
        ([shapes.box((4.0, 3.0, 2.0), (0, 0, 1.0))], shapes.box((4.1, 3.1, 0.1), (0, 0, -0.05)), "it ends where"),
    ],
)
def test_why_a_likely_mesh_was_not_taken_is_told(others, floor, reason):
    found = told(floor, *others)
    assert [(code, meshes) for code, meshes, _ in found] == [("not-ground", ("/mesh_0",)), ("no-ground", ())]
    assert reason in found[0][2]
    assert "--ground" in found[1][2]


def test_of_many_likely_meshes_the_widest_are_told():
    storeys = [shapes.box((6.0 + k, 5.0, 0.1), (0, 0, 3.0 * k)) for k in range(9)]
    found = told(shapes.box((1, 1, 1), (0, 0, -5)), *storeys)
    assert [meshes for code, meshes, _ in found if code == "not-ground"] == [("/mesh_9",), ("/mesh_8",), ("/mesh_7",)]


def test_nothing_is_told_of_a_scene_whose_ground_is_switched_off_and_what_is_named_is_told():
    assert told(MACHINE, FLOOR, find="none") == []
    assert [code for code, *_ in told(MACHINE, FLOOR, find="named", meshes=("/mesh_0",))] == ["ground"]


def test_what_a_user_took_back_is_not_told_as_taken():
    assert [code for code, *_ in told(MACHINE, FLOOR, corrected=[False, False])] == ["ground-corrected"]
    assert [code for code, *_ in told(MACHINE, FLOOR, corrected=[True, True])] == ["ground", "ground-corrected"]
