"""Which parts carry lines: connectors, and what continues them by its shape whatever its label."""

from dataclasses import replace

import numpy as np
import pytest

import shapes
import tubes
from cadgraph.model.labels import Guess, Label
from cadgraph.stages.relate import trace
from piping import PIPE, PUMP, STEEL, VALVE, R, bend, merged, pipe, ring, turned
from runs import BRIDGE, run, touching
from sketch import Sketch, X, block


def lines(sketch):
    return sorted(sketch.piping().lines)


def between(mesh, group, name, n_pipes=2, **said):
    """A mesh from x = 0 to 0.5, the first one, with pipes at both of its ends or only before it."""
    sketch = Sketch()
    sketch.add(mesh, group, name, **said)
    sketch.pipe((-1, 0, 0), (0, 0, 0))
    if n_pipes > 1:
        sketch.pipe((0.5, 0, 0), (1, 0, 0))
    return sketch


TUBE = pipe((0, 0, 0), (0.5, 0, 0))


@pytest.mark.parametrize(("n_pipes", "found"), [(2, [0, 1, 2]), (1, [1])])
def test_what_the_labeler_takes_for_steelwork_is_a_pipe_between_two(n_pipes, found):
    assert lines(between(TUBE, STEEL, "post", n_pipes)) == found


def test_what_two_say_is_steelwork_is_none():
    said = {"source": "author", "opinion": Label(STEEL, "post", 0.9, "geometry")}
    assert lines(between(TUBE, STEEL, "post", **said)) == [1, 2]


def test_what_only_its_label_calls_steelwork_is_a_pipe_where_it_continues_one():
    assert lines(between(TUBE, STEEL, "post", source="author")) == [0, 1, 2]
    said = {"source": "author", "opinion": Label(PIPE, "pipe", 0.9, "geometry")}
    assert lines(between(TUBE, STEEL, "post", **said)) == [0, 1, 2]


def test_a_box_between_two_pipes_is_no_pipe():
    assert lines(between(block((0.25, 0, 0), (0.5, 0.06, 0.06)), STEEL, "beam")) == [1, 2]


@pytest.mark.parametrize(("n_lines", "found"), [(6, True), (7, False)])
def test_what_touches_many_lines_is_no_pipe_among_them(n_lines, found):
    sketch = between(TUBE, STEEL, "post")
    for k in range(n_lines - 2):
        y = (-1) ** k * (R + 0.02)
        sketch.pipe((0.1 + 0.2 * (k // 2), y, -1), (0.1 + 0.2 * (k // 2), y, 1), radius=0.02, bore=0.015)
    assert (0 in lines(sketch)) is found


def test_a_post_that_a_branch_and_a_pipe_join_is_a_pipe():
    sketch = between(TUBE, STEEL, "post", 1)
    sketch.pipe((0.25, 0, R), (0.25, 0, 1), radius=0.4 * R, bore=0.3 * R)
    assert lines(sketch) == [0, 1, 2]


def test_two_posts_in_a_row_are_none():
    sketch = Sketch()
    sketch.add(TUBE, STEEL, "post")
    sketch.add(pipe((0.5, 0, 0), (0.9, 0, 0)), STEEL, "post")
    sketch.pipe((-1, 0, 0), (0, 0, 0))
    sketch.pipe((0.9, 0, 0), (2, 0, 0))
    assert lines(sketch) == [2, 3]


def pieces(*radii, bore=0.85, source="geometry"):
    """Pieces without a label one behind the other, from a pipe on, which is the first part."""
    sketch = Sketch()
    sketch.pipe((-1, 0, 0), (0, 0, 0), source=source)
    for k, radius in enumerate(radii):
        sketch.add(pipe((0.5 * k, 0, 0), (0.5 * k + 0.5, 0, 0), radius * R, bore * radius * R))
    return sketch


def test_a_pipe_cut_into_pieces_is_followed_to_its_end():
    assert lines(pieces(1, 1, 1, 1)) == [0, 1, 2, 3, 4]


@pytest.mark.parametrize(("narrow", "found"), [(0.92, [0, 1, 2, 3]), (0.85, [0, 1])])
def test_pieces_of_another_width_are_not_followed(narrow, found):
    assert lines(pieces(1, narrow, narrow)) == found


def test_pieces_that_the_labeler_takes_for_something_else_are_not_followed():
    sketch = pieces(1, 1, 1)
    sketch.labels[2] = sketch.opinions[2] = Label(STEEL, "post", 0.9, "geometry")
    assert lines(sketch) == [0, 1]


def unsure(sure=0.85, radius=1.0, flanges=(), source="geometry", n_pipes=2, **said):
    """A short cylinder that the labeler takes for a valve, the first part, at one pipe or between two with flanges."""
    sketch = Sketch()
    sketch.add(turned(shapes.cylinder(radius * R, 0.05), (0.025, 0, 0), X), VALVE, "valve", sure, source, **said)
    for sign in flanges:
        sketch.add(ring((0.05 * (sign > 0), 0, 0), (sign, 0, 0)), PIPE, "flange")
    sketch.pipe((-1, 0, 0), (-0.02 * (-1 in flanges), 0, 0))
    if n_pipes > 1:
        sketch.pipe((0.05 + 0.02 * (1 in flanges), 0, 0), (1, 0, 0))
    return sketch


@pytest.mark.parametrize(("sure", "found"), [(0.89, True), (0.91, False)])
def test_a_short_cylinder_is_a_valve_only_where_the_labeler_is_sure(sure, found):
    assert (0 in lines(unsure(sure))) is found


@pytest.mark.parametrize(("radius", "found"), [(1.0, True), (0.98, True), (0.95, False), (1.05, False)])
def test_a_short_cylinder_at_the_end_of_a_pipe_is_a_piece_of_it_if_it_is_as_wide(radius, found):
    assert (0 in lines(unsure(radius=radius, n_pipes=1))) is found


@pytest.mark.parametrize(("radius", "found"), [(1.3, True), (1.5, False), (0.35, True), (0.25, False)])
def test_between_two_pipes_a_short_cylinder_is_as_narrow_as_a_reducing_flange_or_as_wide_as_a_sleeve(radius, found):
    assert (0 in lines(unsure(radius=radius))) is found


@pytest.mark.parametrize(("sure", "found"), [(0.56, True), (0.58, False)])
def test_what_the_labeler_holds_for_likelier_no_valve_is_what_the_line_makes_of_it(sure, found):
    wider = unsure(sure, radius=1.4, n_pipes=1)
    assert (0 in lines(wider)) is found
    guesses = [Guess(VALVE, "valve bonnet", 0.36), Guess(PIPE, "flange", 0.2)]
    split = unsure(sure, radius=1.4, n_pipes=1, guesses=[*guesses, Guess(VALVE, "valve disc", 0.22)])
    assert 0 not in lines(split), "its group is likely"
    other = unsure(sure, radius=1.4, n_pipes=1, source="lvlm", opinion=Label(VALVE, None, 0.3, "geometry"))
    assert 0 not in lines(other), "somebody else says so"


def test_what_somebody_named_valve_is_none_of_these():
    assert 0 not in lines(unsure(source="author"))


@pytest.mark.parametrize("name", ["flange", "gasket"])
def test_between_flanges_a_short_cylinder_is_a_valve(name):
    sketch = unsure(flanges=(-1, 1))
    sketch.labels[1:3] = sketch.opinions[1:3] = [Label(PIPE, name, 0.9, "geometry") for _ in range(2)]
    given = sketch.given()
    assert trace._unsure_pieces(given) == [0]
    assert trace._is_flanged(given, 0)
    assert 0 not in lines(sketch)


def test_with_a_flange_on_one_side_it_is_a_piece_of_pipe():
    sketch = unsure(flanges=(1,))
    assert not trace._is_flanged(sketch.given(), 0)


def nozzle(sure=0.85, widths=(0.075, 0.06, R), gasket=False, beside=None, source="geometry"):
    """A flange with its neck that the labeler takes for a valve, the first part, between a pipe's flange and a pump."""
    wide, shoulder, narrow = widths
    profile = [(0, 0), (wide, 0), (wide, 0.02), (shoulder, 0.03), (narrow, 0.08), (0, 0.08)]
    sketch = Sketch()
    sketch.add(turned(shapes.lathe(profile), (0, 0, 0), X), VALVE, "valve", sure, source)
    sketch.add(block((0.28, 0, 0), (0.4, 0.4, 0.4)), PUMP, "pump casing")
    if beside is not None:
        sketch.add(block((0.04, 0, 0.1), (0.03, 0.03, 0.11)), VALVE, beside)
    gap = 0.004 * gasket
    if gasket:
        sketch.add(ring((-gap, 0, 0), X, gap, 0.06, R), PIPE, "gasket")
    sketch.add(ring((-gap, 0, 0), (-1, 0, 0)), PIPE, "flange")
    sketch.pipe((-1, 0, 0), (-gap - 0.02, 0, 0))
    return sketch


@pytest.mark.parametrize("gasket", [False, True])
def test_a_lone_flange_with_its_neck_is_a_valve_only_where_the_labeler_is_sure(gasket):
    assert 0 in lines(nozzle(gasket=gasket))
    assert 0 not in lines(nozzle(sure=0.91, gasket=gasket))
    assert 0 not in lines(nozzle(source="author", gasket=gasket))


def test_what_looks_like_one_and_belongs_to_a_valve_is_a_piece_of_that():
    assert 0 not in lines(nozzle(beside="valve stem"))


def test_what_is_about_as_wide_at_both_ends_is_no_flange_with_its_neck():
    assert 0 not in lines(nozzle(widths=(0.075, 0.075, 0.065)))


def continued(sure, ratios, traced, contacts):
    found = trace._continued({k: traced[k] for k in sure}, ratios, traced, touching(*contacts), BRIDGE)
    return sorted(found)


def chain(n):
    """Lines one behind the other along x, by number, and their contacts."""
    return {k: run(k, k + 1.0) for k in range(n)}, [(k, k + 1) for k in range(n - 1)]


BOTH = trace._BOTH_ENDS


@pytest.mark.parametrize(
    ("ratios", "found"),
    [
        ({1: 0.3, 2: 0.3}, [0, 1, 2, 3]),
        ({1: BOTH, 2: 0.3}, [0, 1, 2, 3]),  # the second continues the last one, so that the first lies between two
        ({1: BOTH, 2: BOTH}, [0, 3]),
        ({1: 0.3, 2: 2.0}, [0, 1, 2, 3]),
    ],
)
def test_pieces_between_lines_wait_for_those_that_come_late(ratios, found):
    traced, contacts = chain(4)
    assert continued([0, 3], ratios, traced, contacts) == found


def test_what_a_piece_between_leads_to_comes_after_it():
    straight, branch = run(1, 2), run((1.5, 0, 0), (1.5, 1, 0), 0.02, only=1)
    tee = replace(
        straight,
        branches=(*straight.branches, *branch.branches),
        ends=(*straight.ends, replace(branch.ends[0], branch=1)),
    )
    traced = {0: run(0, 1), 1: tee, 2: run(2, 3), 3: run((1.5, 1, 0), (1.5, 2, 0), 0.02)}
    contacts = [(0, 1), (1, 2), (1, 3)]
    assert continued([0, 2], {1: BOTH}, traced, contacts) == [0, 1, 2]
    # What would have to lie in line already can't lead there by itself.
    assert continued([0, 2], {1: BOTH, 3: 0.3}, traced, contacts) == [0, 2]
    assert continued([0, 2, 3], {1: BOTH}, traced, contacts) == [0, 1, 2, 3]


def test_a_branch_at_its_side_is_one_of_the_two_that_a_piece_lies_between():
    traced = {0: run(0, 1), 1: run(1, 2), 2: run((1.5, 0.05, 0), (1.5, 1, 0), 0.02)}
    assert continued([0, 2], {1: BOTH}, traced, [(0, 1), (1, 2)]) == [0, 1, 2]
    assert continued([0], {1: BOTH}, traced, [(0, 1)]) == [0]


@pytest.mark.parametrize(("radius", "found"), [(0.0152, [0, 1]), (0.0148, [0])])
def test_a_piece_continues_what_is_about_its_size(radius, found):
    traced = {0: run(0, 1), 1: run(1, 2, radius)}
    assert continued([0], {1: 0.3}, traced, [(0, 1)]) == found


def test_pipes_that_meet_in_a_corner_do_not_continue_each_other():
    traced = {0: run((0, 0, 0), (1, 0, 0)), 1: run((1, 0, 0), (1, 1, 0))}
    assert continued([0], {1: 0.3}, traced, [(0, 1)]) == [0]


def test_a_bend_between_two_pipes_is_followed_whatever_its_label():
    sketch = Sketch()
    sketch.add(bend((0.9, 0, 0), (1.076, 0, 0), (1.076, 0.2, 0)), STEEL, "post")
    sketch.pipe((0, 0, 0), (1, 0, 0))
    sketch.pipe((1.076, 0.076, 0), (1.076, 1, 0))
    assert lines(sketch) == [0, 1, 2]
    assert np.isclose(sketch.piping().lines[0].length, 0.076 * np.pi / 2, rtol=0.05)


@pytest.mark.parametrize(("name", "sure", "found"), [(None, 0.55, True), (None, 0.75, False), ("valve", 0.6, False)])
def test_a_bend_with_its_flanges_is_one_where_the_labeler_has_no_name_for_it(name, sure, found):
    angles = np.linspace(0, np.pi / 2, 7)
    arc = [(0.06 * np.sin(a), 0.06 * (1 - np.cos(a)), 0) for a in angles]
    way = [(-0.02, 0, 0), *arc, (0.06, 0.08, 0)]
    flanges = [
        turned(shapes.cylinder(R, 0.01), at, axis) for at, axis in (((-0.015, 0, 0), X), ((0.06, 0.075, 0), (0, 1, 0)))
    ]
    sketch = Sketch()
    sketch.add(merged(tubes.pipe(way, R / 2, 16, caps=True), *flanges), VALVE, name, sure)
    sketch.pipe((-1, 0, 0), (-0.02, 0, 0))
    sketch.pipe((0.06, 0.08, 0), (0.06, 1, 0))
    assert (0 in lines(sketch)) is found
