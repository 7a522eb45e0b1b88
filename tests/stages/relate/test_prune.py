"""Lines that only look like some: rings that lead nowhere, and stubs of what is likely something else."""

import numpy as np
import pytest

import shapes
import tubes
from cadgraph.stages.relate.belief import beliefs_of
from cadgraph.stages.relate.prune import prune_lines
from piping import PIPE, STEEL, VALVE, R, bend, merged, plate, ring, turned
from sketch import VOCABULARY, Sketch, X, block


def left(sketch):
    """The parts that carry a line, before and after."""
    piping = sketch.piping()
    given = piping.given
    pruned = prune_lines(piping, beliefs_of(given.labels, given.probabilities, VOCABULARY))
    return sorted(piping.lines), sorted(pruned.lines)


def rounds(source="geometry", only=4):
    """Up to four bends that make a ring."""
    sketch, side = Sketch(), 0.2
    corners = np.array([(0, 0, 0), (side, 0, 0), (side, side, 0), (0, side, 0)], float)
    for k in range(only):
        before, here, after = corners[k - 1], corners[k], corners[(k + 1) % 4]
        sketch.add(bend((before + here) / 2, here, (here + after) / 2, reach=0.1), PIPE, "elbow", source=source)
    return sketch


def test_a_ring_of_bends_that_leads_nowhere_is_no_pipe():
    assert left(rounds()) == ([0, 1, 2, 3], [])


def test_bends_that_leave_a_ring_open_are_pipe():
    assert left(rounds(only=3)) == ([0, 1, 2], [0, 1, 2])


@pytest.mark.parametrize("source", ["author", "human", "file"])
def test_a_ring_that_somebody_named_is_pipe(source):
    assert left(rounds(source))[1] == [0, 1, 2, 3]


def test_a_ring_that_a_pipe_is_tapped_into_leads_somewhere():
    sketch = rounds()
    # From the middle of the first bend outward.
    way = np.array([-1.0, -1.0, 0.0]) / np.sqrt(2)
    middle = np.array([0.1, 0.1, 0.0]) + 0.1 * way
    sketch.pipe(middle + R * way, middle + 0.8 * way, radius=0.4 * R, bore=0.3 * R)
    assert left(sketch)[1] == [0, 1, 2, 3, 4]


def stub(sure, length=0.3, source="geometry"):
    """A pipe with a piece at its end that the labeler holds for a pipe only so far."""
    sketch = Sketch()
    sketch.pipe((0, 0, 0), (1, 0, 0))
    likely = {(PIPE, "pipe"): sure, (STEEL, "post"): 1 - sure}
    sketch.pipe((1, 0, 0), (1 + length, 0, 0), source=source)
    sketch.likely[1] = likely
    return sketch


@pytest.mark.parametrize(("sure", "found"), [(0.29, [0]), (0.31, [0, 1])])
def test_a_stub_that_is_likely_something_else_is_no_pipe(sure, found):
    assert left(stub(sure)) == ([0, 1], found)


@pytest.mark.parametrize("source", ["author", "human", "file"])
def test_a_stub_that_somebody_named_is_pipe(source):
    assert left(stub(0.1, source=source))[1] == [0, 1]


def test_what_leads_on_at_both_ends_is_pipe_however_unlikely():
    sketch = stub(0.1)
    sketch.pipe((1.3, 0, 0), (2, 0, 0))
    assert left(sketch)[1] == [0, 1, 2]


@pytest.mark.parametrize(("sure", "found"), [(0.9, [0, 1]), (0.5, [0])])
def test_a_stub_to_a_unit_stays_where_the_unit_is_likely(sure, found):
    sketch = stub(0.1)
    sketch.add(block((1.4, 0, 0), 0.2), VALVE, "valve", likely={(VALVE, "valve"): sure})
    assert left(sketch)[1] == found


def test_a_stub_to_a_unit_stays_where_somebody_named_the_unit():
    sketch = stub(0.1)
    sketch.add(block((1.4, 0, 0), 0.2), VALVE, "valve", source="author", likely={})
    assert left(sketch)[1] == [0, 1]


def test_of_two_unlikely_pieces_one_behind_the_other_both_go():
    sketch = stub(0.1)
    sketch.pipe((1.3, 0, 0), (1.6, 0, 0))
    sketch.likely[2] = {(STEEL, "post"): 0.9}
    assert left(sketch) == ([0, 1, 2], [0])


@pytest.mark.parametrize(("sure", "found"), [(0.51, [0, 1]), (0.49, [0])])
def test_a_disc_at_the_end_of_a_run_stays_if_it_is_possible(sure, found):
    sketch = Sketch()
    sketch.pipe((0, 0, 0), (1, 0, 0))
    sketch.add(plate((1, 0, 0), X), PIPE, "blind flange", likely={(PIPE, "blind flange"): sure})
    assert left(sketch) == ([0, 1], found)


@pytest.mark.parametrize(("sure", "found"), [(0.71, [0, 1]), (0.69, [0])])
def test_a_disc_amid_other_things_stays_if_it_is_likely(sure, found):
    sketch = Sketch()
    sketch.pipe((0, 0, 0), (1, 0, 0))
    sketch.add(ring((1, 0, 0), X), PIPE, "flange", likely={(PIPE, "flange"): sure})
    sketch.add(block((1.0, 0, -0.125), 0.1), STEEL, "plate")
    assert left(sketch) == ([0, 1], found)


def test_a_disc_between_two_pipes_stays_however_unlikely():
    sketch = Sketch()
    sketch.pipe((0, 0, 0), (1, 0, 0))
    sketch.add(ring((1, 0, 0), X), PIPE, "flange", likely={(PIPE, "flange"): 0.1})
    sketch.pipe((1.02, 0, 0), (2, 0, 0))
    assert left(sketch)[1] == [0, 1, 2]


def test_pipes_that_the_labeler_is_sure_of_stay_even_alone():
    sketch = Sketch()
    sketch.pipe((0, 0, 0), (1, 0, 0))
    sketch.add(turned(shapes.sphere(0.1), (5, 5, 5), X))
    assert left(sketch) == ([0], [0])


@pytest.mark.parametrize(("pipe", "found"), [(0.05, []), (0.3, [0])])
def test_a_bent_body_that_is_likely_a_device_carries_no_line(pipe, found):
    sketch = Sketch()
    said = {(PIPE, "elbow"): pipe, ("Equipment", "separator"): 0.6}
    sketch.add(bend((-0.2, 0, 0), (0, 0, 0), (0, 0.2, 0), reach=0.2), PIPE, "elbow", likely=said)
    sketch.pipe((-1, 0, 0), (-0.2, 0, 0))
    sketch.pipe((0, 0.2, 0), (0, 1, 0))
    assert left(sketch) == ([0, 1, 2], [*found, 1, 2])


def vessel(arms, strainer, pipe):
    """A drum in one mesh with so many arms, each with a pipe at its end, that may be a strainer, a pipe or a filter."""
    sketch, turns = Sketch(), 2 * np.pi * np.arange(arms) / arms
    ways = np.stack([np.cos(turns), np.sin(turns), np.zeros(arms)], axis=1)
    said = {(PIPE, "strainer"): strainer, (PIPE, "pipe"): pipe, ("Equipment", "filter"): 0.5}
    sketch.add(merged(*(tubes.pipe([(0, 0, 0), 0.3 * way], R, 24, caps=True) for way in ways)), likely=said)
    for way in ways:
        sketch.pipe(0.3 * way, way)
    return sketch


@pytest.mark.parametrize(
    ("arms", "strainer", "pipe", "carries"), [(6, 0.4, 0.1, False), (6, 0.0, 0.51, True), (4, 0.4, 0.1, True)]
)
def test_what_has_more_ends_than_a_cross_is_likelier_a_device_than_a_fitting(arms, strainer, pipe, carries):
    before, after = left(vessel(arms, strainer, pipe))
    assert 0 in before
    assert (0 in after) == carries
