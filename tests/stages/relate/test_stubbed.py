"""Pipes that are set on the side of a line or on a vessel, and that the labeler took for something else."""

import numpy as np
import pytest

import shapes
import tubes
from piping import PIPE, PUMP, STEEL, TANK, R, pipe, turned
from sketch import Sketch

THIN, HOLE = 0.0169, 0.0142
RAIL = {"group": STEEL, "name": "railing", "sure": 0.6}


def run(*stubs, more=(), **said):
    """A pipe along x from 0 to 2 m, then tubes on it, each from one point to another; then further meshes."""
    sketch = Sketch()
    sketch.pipe((0, 0, 0), (2, 0, 0), source="author")
    for start, end, *hole in stubs:
        sketch.add(pipe(start, end, THIN, *(hole or [HOLE])), **(said or RAIL))
    for mesh, *label in more:
        sketch.add(mesh, *label)
    return sketch


def open_joints(sketch):
    joints = sketch.connected().network.joints
    return [(j.first, j.second, j.kind, round(j.score, 2)) for j in joints if not j.made and j.score >= 0.1]


def branches(sketch):
    """The parts that connections run over, without the run itself."""
    return sorted({part for link in sketch.connected().network.links for part in link.via} - {0})


UP, DOWN, SIDE = ((1, 0, R), (1, 0, 0.6)), ((1, 0, -R), (1, 0, -0.6)), ((1, R, 0), (1, 0.6, 0))


@pytest.mark.parametrize("stub", [UP, SIDE, ((1, 0, 0), (1, 0, 0.6)), ((1, 0, R + 0.006), (1, 0, 0.6))])
@pytest.mark.parametrize("said", [RAIL, {"group": None}], ids=["railing", "no label"])
def test_a_hollow_tube_on_the_side_of_a_line_is_a_branch_of_it(stub, said):
    sketch = run(stub, **said)
    assert branches(sketch) == [1]
    assert len(sketch.connected().network.links) == 3
    assert sketch.connected().labels[1].said == (PIPE, "pipe")


def test_a_tube_from_one_line_to_another_joins_them():
    sketch = run(((1, R, 0), (1, 1 - R, 0)))
    sketch.pipe((0, 1, 0), (2, 1, 0), source="author")
    assert branches(sketch) == [1, 2]
    assert len(sketch.connected().network.systems) == 1


@pytest.mark.parametrize("who", ["author", "human"])
def test_what_somebody_else_has_named_stays_what_it_is(who):
    assert branches(run(UP, group=STEEL, name="railing", source=who)) == []
    assert open_joints(run(UP, group=STEEL, name="railing", source=who)) == []


def test_a_solid_one_and_one_that_may_be_a_post_leave_the_joint_open():
    assert branches(run((*UP, None))) == branches(run(DOWN)) == []
    assert open_joints(run((*UP, None))) == [(1, 0, "tap", 0.2)]
    assert open_joints(run(DOWN)) == [(1, 0, "tap", 0.3)]


def test_a_post_on_a_plate_and_a_tube_beside_the_line_are_none():
    plate = shapes.box((0.3, 0.3, 0.01), (1, 0, -0.605))
    posted = run(DOWN, more=[(plate, STEEL, "plate")])
    assert branches(posted) == open_joints(posted) == []
    beside = run(((1, 0.04, -0.5), (1, 0.04, 0.5)))
    assert branches(beside) == open_joints(beside) == []


TANK_MESH = turned(shapes.cylinder(0.5, 2.0, 64), (0, 0, 1), (0, 0, 1))


def vessel(start, end, bore=HOLE):
    sketch = Sketch()
    sketch.add(TANK_MESH, TANK, "tank", source="author")
    sketch.add(pipe(start, end, THIN, bore), group=None)
    return sketch


@pytest.mark.parametrize(
    ("start", "end"), [((0.5, 0, 1), (0.9, 0, 1)), ((0, 0, 2), (0, 0, 2.4)), ((0, 0, 1.2), (0, 0, 2.4))],
    ids=["side", "top", "dip tube"],
)  # fmt: skip
def test_a_tube_on_a_vessel_leaves_the_joint_open(start, end):
    assert open_joints(vessel(start, end)) == [(1, 0, "mount", 0.3)]


def test_a_leg_of_a_vessel_is_no_pipe():
    assert open_joints(vessel((0.45, 0, 0), (0.45, 0, -0.6))) == []


def test_the_order_of_the_parts_changes_nothing():
    there, back = run(UP, SIDE), run(SIDE, UP)
    lengths = [sorted(np.round([link.length for link in one.connected().network.links], 6)) for one in (there, back)]
    assert lengths[0] == lengths[1]


CASING = shapes.box((0.5, 0.3, 0.4), (0, 0, 0))


def pumped(start, end, bore=HOLE, more=()):
    sketch = Sketch()
    sketch.add(CASING, PUMP, "pump casing", source="author")
    sketch.add(pipe(start, end, THIN, bore), group=None)
    for mesh, name in more:
        sketch.add(mesh, PUMP, name, source="author")
    return sketch


def test_a_hollow_tube_on_the_casing_of_a_pump_leaves_the_joint_open_and_a_shaft_does_not():
    assert open_joints(pumped((0, 0.15, 0), (0, 0.4, 0))) == [(1, 0, "mount", 0.3)]
    assert open_joints(pumped((0, 0.15, 0), (0, 0.4, 0), None)) == []


def test_the_guard_of_a_coupling_leads_nowhere():
    motor = shapes.box((0.4, 0.3, 0.3), (0.63, 0, 0))
    assert open_joints(pumped((0.25, 0, 0), (0.42, 0, 0), more=[(motor, "motor")])) == []


@pytest.mark.parametrize(("likely", "found"), [(0.45, [(1, 0, "tap", 0.2)]), (0.3, [])])
def test_a_conical_socket_that_nobody_is_sure_of_leaves_the_joint_open(likely, found):
    sketch = run()
    socket = tubes.pipe([(1, 0, R), (1, 0, R + 0.04)], [0.03, 0.02], 24, caps=True)
    sketch.add(socket, likely={(PIPE, "branch outlet"): likely})
    assert open_joints(sketch) == found
