"""Bodies at the ends of lines: what may be a device that no label makes one."""

import numpy as np
import pytest

from cadgraph.stages.relate.belief import beliefs_of
from cadgraph.stages.relate.body import arrangement_of, find_bodies
from cadgraph.stages.relate.joint import gather_ends
from piping import FASTENER, PIPE, STEEL, VALVE, R, pipe
from runs import run
from sketch import SIDES, VOCABULARY, Sketch, around, block


def bodies(sketch):
    piping = sketch.piping()
    given = piping.given
    ends, found = find_bodies(piping, beliefs_of(given.labels, given.probabilities, VOCABULARY))
    return [(body.parts, arrangement_of(ends, [mount.row for mount in body.mounts])) for body in found]


def meeting(turn, aside=0.0):
    """Two ends that meet a body at the origin: the second is turned from straight on, and beside it."""
    turn = np.radians(turn)
    way = np.array([np.cos(turn), np.sin(turn), 0.0])
    beside = np.array([0.0, aside, 0.0])
    ends = gather_ends({0: run((-1, 0, 0), (-0.05, 0, 0)), 1: run(way + beside, way / 20 + beside)})
    return arrangement_of(ends, [1, 3])


@pytest.mark.parametrize(
    ("turn", "aside", "found"),
    [
        (0, 0.0, "aligned"),
        (0, 0.017, "aligned"),  # of a radius of 0.05
        (0, 0.018, "two"),
        (15, 0.0, "aligned"),
        (20, 0.0, "two"),
        (69, 0.0, "two"),
        (70, 0.0, "square"),
        (110, 0.0, "square"),
        (112, 0.0, "two"),
        (180, 0.2, "two"),
    ],
)
def test_two_ends_meet_a_body_in_line_square_or_otherwise(turn, aside, found):
    assert meeting(turn, aside) == found


def test_one_end_and_three_are_told_by_their_number():
    ends = gather_ends({k: run(k, k + 0.5) for k in range(3)})
    assert [arrangement_of(ends, rows) for rows in ([0], [0, 2, 4], [0, 1, 2, 3])] == ["one", "many", "many"]


@pytest.mark.parametrize("sides", SIDES)
def test_what_stands_at_the_ends_of_lines_is_a_body(sides):
    assert bodies(around(0.24, sides)) == [((0,), sides)]


@pytest.mark.parametrize(("sure", "found"), [(0.49, 1), (0.51, 0)])
def test_what_is_likely_steelwork_is_no_body(sure, found):
    assert len(bodies(around(0.24, "aligned", likely={(STEEL, "plate"): sure}))) == found


@pytest.mark.parametrize(("sure", "found"), [(0.49, 1), (0.51, 0)])
def test_what_is_likely_a_fastener_is_no_body(sure, found):
    assert len(bodies(around(0.24, "aligned", likely={(FASTENER, "bolt"): sure}))) == found


@pytest.mark.parametrize("source", ["author", "human"])
def test_what_people_named_is_no_body(source):
    assert bodies(around(0.24, "aligned", group=STEEL, name="plate", source=source)) == []


@pytest.mark.parametrize(("sure", "found"), [(0.89, 1), (0.91, 0)])
def test_a_small_unit_may_be_another_one_where_the_labeler_is_not_sure(sure, found):
    assert len(bodies(around(0.24, "aligned", group=VALVE, name="valve", sure=sure))) == found


@pytest.mark.parametrize(("pieces", "found"), [(3, 1), (4, 0)])
def test_a_unit_of_more_parts_is_one(pieces, found):
    sketch = around(0.24, "aligned", group=VALVE, name="valve", sure=0.6)
    for k in range(pieces - 1):
        sketch.add(block((0, 0.13 + 0.02 * k, 0), (0.1, 0.02, 0.1)), VALVE, "valve body", sure=0.6)
    assert len(bodies(sketch)) == found


@pytest.mark.parametrize(("radii", "found"), [(3.5, (0, 3)), (4.5, (0,))])
def test_a_short_cover_that_leads_nowhere_is_a_piece_of_its_body(radii, found):
    sketch = around(0.24, "aligned")
    sketch.pipe((0, 0, 0.12), (0, 0, 0.12 + radii * R))
    assert bodies(sketch) == [(found, "aligned" if 3 in found else "many")]


def test_a_cover_that_somebody_named_pipe_is_pipe():
    sketch = around(0.24, "aligned")
    sketch.pipe((0, 0, 0.12), (0, 0, 0.12 + 3.5 * R), source="author")
    assert bodies(sketch) == [((0,), "many")]


def test_what_touches_the_side_of_a_line_holds_it():
    sketch = Sketch()
    sketch.pipe((0, 0, 0), (2, 0, 0))
    sketch.add(block((1, 0, -R - 0.05), 0.1))
    assert bodies(sketch) == []


def test_what_no_line_ends_at_is_no_body():
    sketch = around(0.24, "aligned")
    sketch.add(block((0, 3, 0), 0.2))
    assert bodies(sketch) == [((0,), "aligned")]


@pytest.mark.parametrize(("pieces", "found"), [(40, 1), (41, 0)])
def test_a_building_is_no_device(pieces, found):
    sketch = around(0.24, "aligned")
    for k in range(pieces - 1):
        sketch.add(block((0, 0.13 + 0.02 * k, 0), (0.1, 0.02, 0.1)))
    assert len(bodies(sketch)) == found


def test_an_end_that_joins_another_pipe_is_at_no_body():
    sketch = around(0.24, "one")
    sketch.add(pipe((0.62, 0, 0), (1.2, 0, 0)), PIPE, "pipe")
    sketch.add(block((1.32, 0, 0), 0.24))
    assert bodies(sketch) == [((0,), "one"), ((3,), "one")]
