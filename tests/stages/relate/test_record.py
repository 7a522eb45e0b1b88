"""The joints that the graph keeps: those that were made, and the best that were not, each with what speaks for it."""

import numpy as np
import pytest

import shapes
from piping import GAUGE, PIPE, STEEL, VALVE, R, gauge_mesh, merged, pipe, ring, turned, valve_mesh
from sketch import Sketch, X, around, block


def joints(sketch, **settings):
    """Kind, parts and whether it was made of each joint."""
    return [(j.kind, j.first, j.second, j.made) for j in sketch.connected(**settings).network.joints]


def pair(gap=0.0, aside=0.0):
    sketch = Sketch()
    sketch.pipe((0, 0, 0), (1, 0, 0))
    sketch.pipe((1 + gap, aside, 0), (2, aside, 0))
    return sketch


def test_a_joint_that_is_made_is_there_once_with_its_place_gap_and_reasons():
    (joint,) = pair(0.003).connected().network.joints
    assert (joint.kind, joint.first, joint.second, joint.made) == ("face", 0, 1, True)
    assert joint.gap == pytest.approx(0.003)
    assert joint.score > 0.9
    assert np.allclose(joint.point, (1, 0, 0), atol=0.004)
    assert any("a gap of 3.0 mm" in reason for reason in joint.reasons)


def test_a_joint_that_is_refused_is_there_with_what_speaks_against_it():
    sketch = around(0.24, "one", group=VALVE, name="valve", source="author")
    sketch.pipe((-0.14, 0, 0), (-1, 0, 0))
    (joint,) = [joint for joint in sketch.connected(**{"cluster.eps": 0.03}).network.joints if not joint.made]
    assert (joint.kind, joint.first, joint.second) == ("mount", 2, 0)
    assert joint.gap == pytest.approx(0.02)
    assert joint.score < 0.5
    assert joint.reasons[0] == "a gap of 20.0 mm (-2.8)", "the weightiest first"


def test_ends_that_have_nothing_near_have_no_joint():
    assert joints(pair(0.5)) == []


def test_pipes_that_meet_in_a_corner():
    sketch = Sketch()
    sketch.pipe((0, 0, 0), (1, 0, 0))
    sketch.pipe((1, 0, 0), (1, 1, 0))
    assert joints(sketch) == [("corner", 0, 1, True)]


def test_a_branch_on_the_side_of_a_pipe():
    sketch = Sketch()
    sketch.pipe((0, 0, 0), (2, 0, 0))
    sketch.pipe((1, 0, R), (1, 0, 1), radius=0.4 * R, bore=0.3 * R)
    assert joints(sketch) == [("tap", 1, 0, True)]


def test_a_pipe_in_a_slip_on_flange_ends_in_one_place_with_it():
    sketch = Sketch()
    sketch.add(valve_mesh((0, 0, 0)), VALVE, "valve", source="author")
    sketch.add(ring((0.089, 0, 0), X, 0.03, inner=R + 0.0005), PIPE, "flange")
    sketch.pipe((0.089, 0, 0), (1, 0, 0))
    found = sketch.connected().network.joints
    twins = [joint for joint in found if joint.reasons == ("both end in one place and look the same way",)]
    assert [(joint.kind, {joint.first, joint.second}, joint.made) for joint in twins] == [("face", {1, 2}, True)]
    assert twins[0].score == 0.99
    assert abs(twins[0].gap) < 1e-6


def test_an_end_at_a_solid():
    assert joints(around(0.24, "aligned", group=VALVE, name="valve", source="author")) == [
        ("mount", 1, 0, True),
        ("mount", 2, 0, True),
    ]


def test_a_gauge_that_no_line_ends_at_is_on_the_side_that_it_touches():
    sketch = Sketch()
    sketch.pipe((0, 0, 0), (2, 0, 0))
    sketch.add(gauge_mesh((1, 0, R)), GAUGE, "gauge")
    (joint,) = sketch.connected().network.joints
    assert (joint.kind, joint.first, joint.second, joint.made) == ("side", 1, 0, True)
    assert joint.reasons == ("no line ends at it, and it touches this one",)
    assert np.allclose(joint.point, (1, 0, 0), atol=0.01)


def test_a_gauge_near_the_ends_of_a_short_spool_is_on_its_side_once_these_join_others():
    sketch = Sketch()
    flange = shapes.cylinder(0.1, 0.02)
    spool = merged(pipe((1, 0, 0), (1.4, 0, 0)), *(turned(flange, (x, 0, 0), X) for x in (1.01, 1.39)))
    sketch.add(spool, PIPE, "pipe")
    sketch.pipe((0, 0, 0), (1, 0, 0))
    sketch.pipe((1.4, 0, 0), (2.4, 0, 0))
    sketch.add(gauge_mesh((1.2, 0, R - 0.01)), GAUGE, "gauge")
    assert ("side", 3, 0, True) in joints(sketch)


def test_what_is_no_gauge_is_joined_to_no_side():
    sketch = Sketch()
    sketch.pipe((0, 0, 0), (2, 0, 0))
    sketch.add(block((1, 0, -R - 0.05), 0.1), STEEL, "beam")
    assert joints(sketch) == []


def test_two_valves_flange_to_flange():
    sketch = Sketch()
    sketch.add(valve_mesh((0, 0, 0)), VALVE, "valve", source="author")
    sketch.add(valve_mesh((0.178, 0, 0)), VALVE, "valve", source="author")
    sketch.add(pipe((-1, 0, 0), (-0.089, 0, 0)), PIPE, "pipe", source="author")
    sketch.add(pipe((0.267, 0, 0), (1, 0, 0)), PIPE, "pipe", source="author")
    (joint,) = [joint for joint in sketch.connected().network.joints if joint.kind == "flange"]
    assert (joint.first, joint.second, joint.made) == (0, 1, True)
    assert joint.reasons == ("they meet in a flat round area",)
    assert np.allclose(joint.point, (0.089, 0, 0), atol=0.01)


def test_every_joint_has_its_reasons_a_score_and_its_place_in_the_order():
    sketch = Sketch()
    sketch.pipe((0, 0, 0), (1, 0, 0))
    sketch.add(ring((1, 0, 0), X), PIPE, "flange")
    sketch.add(valve_mesh((1.109, 0, 0)), VALVE, "valve", source="author")
    sketch.pipe((1.198, 0, 0), (2, 0, 0))
    sketch.add(block((2.12, 0, 0), 0.2), VALVE, "valve", source="author")
    sketch.pipe((2.22, 0, 0), (3, 0, 0))
    sketch.add(gauge_mesh((1.6, 0, R)), GAUGE, "gauge")
    sketch.add(turned(shapes.cylinder(0.011, 0.3), (2.5, 0, R + 0.149), (0, 0, 1)), PIPE, "pipe")
    found = sketch.connected(**{"cluster.eps": 0.02}).network.joints
    assert {joint.kind for joint in found} == {"face", "mount", "side", "tap"}
    assert {joint.made for joint in found} == {True, False}
    assert all(joint.reasons and 0 <= joint.score <= 1 for joint in found)
    assert list(found) == sorted(found, key=lambda joint: (joint.first, joint.second, joint.point, joint.kind))
    assert all((joint.score > 0.5) == joint.made for joint in found)
