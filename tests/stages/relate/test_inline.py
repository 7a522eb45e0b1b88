"""Valves that lines run through: what narrows, what is wider than its pipes, what carries a stem."""

from dataclasses import replace

import numpy as np
import pytest

import fittings
import shapes
import tubes
from cadgraph.geometry.line.centreline import Branch
from cadgraph.model.vocabulary import Vocabulary
from cadgraph.stages.relate.belief import beliefs_of
from cadgraph.stages.relate.inline import INLINE, THICKER, WAIST, recover_inline
from cadgraph.stages.relate.piping import Group
from cadgraph.stages.relate.recover import LABELLED
from piping import PIPE, VALVE, R, merged, ring, turned
from sketch import VOCABULARY, Sketch, X, block

SAID = {(PIPE, "pipe"): 0.6, (VALVE, "valve"): 0.1}


def narrow(reach, waist, **said):
    """The piping of a piece that narrows in its middle, the first one, between two pipes."""
    cones = tubes.pipe([(0, 0, 0), (reach / 2, 0, 0), (reach, 0, 0)], [R, waist * R, R], 24, caps=True)
    piping = between(cones, reach=reach, **said).piping()
    points = np.linspace((0, 0, 0), (reach, 0, 0), 3)
    branch = Branch(points, R * np.array([1, waist, 1]), np.full(3, np.nan))
    return replace(piping, lines={**piping.lines, 0: replace(piping.lines[0], branches=(branch,))})


def cone(start, end, first, last):
    return tubes.pipe([start, end], [first, last], 24, caps=True)


def between(*meshes, reach=0.2, likely=SAID, source="geometry"):
    """Meshes along x up to a reach, from the first number on, between two pipes, which are the last two."""
    sketch = Sketch()
    for mesh in meshes:
        sketch.add(mesh, PIPE, "pipe", sure=0.6, source=source, likely=likely)
    sketch.pipe((-1, 0, 0), (0, 0, 0))
    sketch.pipe((reach, 0, 0), (reach + 1, 0, 0))
    return sketch


def recovered(sketch):
    piping = sketch.piping() if isinstance(sketch, Sketch) else sketch
    given = piping.given
    return recover_inline(piping, beliefs_of(given.labels, given.probabilities, given.vocabulary), LABELLED)


def valves(sketch):
    return [group.parts for group in recovered(sketch).groups]


@pytest.mark.parametrize(("waist", "found"), [(0.5, [(0,)]), (0.75, [(0,)]), (0.97, [])])
def test_a_piece_that_narrows_is_a_valve(waist, found):
    assert valves(narrow(0.2, waist)) == found


def test_a_mesh_that_narrows_is_a_valve():
    stations = np.linspace((0, 0, 0), (0.2, 0, 0), 9)
    assert valves(between(tubes.pipe(stations, R * (0.5 + np.abs(stations[:, 0] - 0.1) / 0.2), 24, caps=True))) == [
        (0,)
    ]


def test_a_pipe_with_its_flanges_in_one_mesh_is_no_valve():
    thin, thick = R / 2, 0.02
    plates = [turned(shapes.cylinder(R, thick), (x, 0, 0), X) for x in (thick / 2, 0.2 - thick / 2)]
    spool = merged(turned(shapes.cylinder(thin, 0.2), (0.1, 0, 0), X), *plates)
    assert valves(between(spool)) == []


@pytest.mark.parametrize(("valve", "found"), [(0.1, [(0,)]), (0.005, [])])
def test_the_labeler_must_hold_it_for_possible(valve, found):
    assert valves(narrow(0.2, 0.75, likely={(PIPE, "pipe"): 0.6, (VALVE, "valve"): valve})) == found


@pytest.mark.parametrize(("radii", "found"), [(13.0, [(0,)]), (15.0, [])])
def test_a_valve_is_no_longer_than_valves_are(radii, found):
    assert valves(narrow(radii * R, 0.5)) == found


@pytest.mark.parametrize(("waist", "found"), [(0.5, [(0, 1)]), (0.68, [(0, 1)]), (0.75, [])])
def test_two_cones_that_meet_are_a_valve(waist, found):
    middle = (0.1, 0, 0)
    cones = [cone((0, 0, 0), middle, R, waist * R), cone(middle, (0.2, 0, 0), waist * R, R)]
    assert valves(between(*cones)) == found


def test_two_reducers_with_a_pipe_between_are_none():
    thin = [cone((0, 0, 0), (0.1, 0, 0), R, R / 2), cone((0.6, 0, 0), (0.7, 0, 0), R / 2, R)]
    sketch = between(*thin, reach=0.7)
    sketch.pipe((0.1, 0, 0), (0.6, 0, 0), radius=R / 2, bore=0.4 * R)
    assert valves(sketch) == []


def test_a_cone_that_nothing_joins_is_no_half_of_a_valve():
    sketch = Sketch()
    sketch.add(cone((0, 0, 0), (0.1, 0, 0), R, R / 2), PIPE, "reducer", likely=SAID)
    sketch.add(cone((0.1, 0, 0), (0.2, 0, 0), R / 2, R), PIPE, "reducer", likely=SAID)
    sketch.pipe((-1, 0, 0), (0, 0, 0))
    assert valves(sketch) == []


def flanged(thicker, plates=1, flanges=2):
    """A cylinder between flanges of two pipes, by a factor thicker than these."""
    thick, step = thicker * R, 0.02
    reach = 0.3
    sketch = Sketch()
    ends = (plates * step, reach - plates * step * (flanges > 1))
    sketch.add(cone((ends[0], 0, 0), (ends[1], 0, 0), thick, thick), PIPE, "pipe", likely=SAID)
    for k in range(plates):
        sketch.add(ring((k * step, 0, 0), X, step), PIPE, "flange", likely={(PIPE, "flange"): 0.95})
        if flanges > 1:
            sketch.add(ring((reach - k * step, 0, 0), (-1, 0, 0), step), PIPE, "flange")
    sketch.pipe((-1, 0, 0), (0, 0, 0))
    sketch.pipe((reach, 0, 0), (reach + 1, 0, 0))
    return sketch


@pytest.mark.parametrize(("thicker", "found"), [(1.0, []), (1.08, []), (1.25, [(0,)]), (1.6, [(0,)])])
def test_what_is_wider_than_the_pipes_beyond_its_flanges_is_a_valve(thicker, found):
    assert valves(flanged(thicker)) == found


def test_what_is_wider_without_flanges_at_both_ends_is_none():
    assert valves(flanged(1.25, plates=2)) == [(0,)]
    assert valves(flanged(1.25, flanges=1)) == []


def stemmed(thin=0.3, source="geometry", leads=False, stem_by="geometry"):
    """A short cylinder between two pipes, with a thinner one that stands on it."""
    sketch = between(cone((0, 0, 0), (0.2, 0, 0), R, R), source=source)
    stem = turned(shapes.cylinder(thin * R, 0.2), (0.1, 0, R + 0.1), (0, 0, 1))
    sketch.add(stem, PIPE, "pipe", source=stem_by, likely={(PIPE, "pipe"): 0.8})
    if leads:
        sketch.pipe((0.1, 0, R + 0.2), (0.1, 0, R + 1.0), radius=thin * R, bore=None)
    return sketch


def test_a_stem_that_leads_nowhere_makes_a_piece_of_line_a_valve():
    assert valves(stemmed()) == [(0, 3)]
    assert valves(between(cone((0, 0, 0), (0.2, 0, 0), R, R))) == []


def levered(reaches=0.0, source="geometry", name="lever"):
    """A short cylinder between two flanged pipes, with a lever on it, the fourth part, that may rest on a pipe."""
    sketch = between(cone((0, 0, 0), (0.2, 0, 0), R, R), source=source)
    sketch.add(block((0.1 + reaches / 2, 0, R + 0.02), (0.04 + reaches, 0.02, 0.04)), VALVE, name, 0.9)
    return sketch


def test_pieces_of_a_valve_on_a_piece_of_line_make_it_one():
    assert valves(levered()) == [(0, 3)]
    assert valves(levered(source="author")) == [(3,)], "somebody says that it is a pipe"


@pytest.mark.parametrize("name", ["valve", "valve body"])
def test_a_valve_on_a_piece_of_line_is_one_of_its_own(name):
    assert valves(levered(name=name)) == [(3,)]


def test_pieces_of_a_valve_that_sit_on_a_pipe_as_well_say_nothing():
    assert valves(levered(reaches=0.3)) == [(3,)]


@pytest.mark.parametrize(("thin", "found"), [(0.65, [(0, 3)]), (0.75, [])])
def test_a_stem_is_thinner_than_its_valve(thin, found):
    assert valves(stemmed(thin)) == found


def test_what_leads_on_is_a_branch_and_no_stem():
    assert valves(stemmed(leads=True)) == []


@pytest.mark.parametrize("source", ["author", "human", "catalog", "file"])
def test_what_anybody_named_pipe_is_pipe(source):
    assert valves(narrow(0.2, 0.5, source=source)) == []
    assert valves(stemmed(source=source)) == []
    assert valves(stemmed(stem_by=source)) == []


def test_a_valve_carries_no_line_any_more():
    piping = recovered(narrow(0.2, 0.5))
    assert sorted(piping.lines) == [1, 2]
    assert piping.members == {0}
    assert piping.groups == (Group("valve", (0,)),)
    assert 0.6 < piping.recovered[0].sure < 1.0
    assert piping.recovered[0].reasons[0].startswith("it narrows to 50% in its middle")


def test_a_vocabulary_without_valves_has_none():
    piping = narrow(0.2, 0.5)
    groups = {name: replace(held, unit=None) if name == VALVE else held for name, held in VOCABULARY.groups.items()}
    given = replace(piping.given, vocabulary=Vocabulary(groups))
    piping = replace(piping, given=given)
    assert recover_inline(piping, beliefs_of(given.labels, given.probabilities, given.vocabulary), LABELLED) is piping


def test_the_curves_are_in_order():
    assert all(list(curve.at) == sorted(curve.at) for curve in (WAIST, THICKER))
    assert list(WAIST.gives) == sorted(WAIST.gives, reverse=True)
    assert list(THICKER.gives) == sorted(THICKER.gives)
    assert INLINE["base"] < 0 < INLINE["base"] + INLINE["stem"]


@pytest.mark.parametrize(("over", "found"), [(0.009, [(0, 3)]), (-0.002, [(3,)])])
def test_a_lever_sits_on_the_piece_that_it_touches_not_on_the_pipe_that_it_passes_over(over, found):
    likely = {(PIPE, "expansion joint"): 0.47, (VALVE, "valve body"): 0.26}
    sketch = between(turned(shapes.cylinder(R, 0.2), (0.1, 0, 0), X), likely=likely)
    foot, lever = block((0.1, 0, R + 0.01), (0.02, 0.02, 0.024)), block((0.2, 0, R + over + 0.005), (0.22, 0.02, 0.01))
    sketch.add(merged(foot, lever), VALVE, "lever", likely={(VALVE, "lever"): 0.9})
    assert valves(sketch) == found


@pytest.mark.parametrize("group", [VALVE, PIPE])
def test_a_piece_whose_neck_ends_at_what_turns_it_is_a_valve(group):
    neck = fittings.Outlet(0.1, 0.02, 0.1, turn=np.pi / 2)
    sketch = between(fittings.branched(R, 0.2, [neck], 24).mesh)
    sketch.add(block((0.1, 0, 0.16), 0.12), group, "actuator" if group == VALVE else "tee", 0.9)
    assert valves(sketch) == ([(0, 3)] if group == VALVE else [])


@pytest.mark.parametrize(("likely", "found"), [
    ({(VALVE, "valve"): 0.2, ("Pump unit", "pump casing"): 0.15, ("Gauge assembly", "flow meter"): 0.18}, [(0,)]),
    ({(VALVE, "valve"): 0.2, (PIPE, "coupling"): 0.3, ("Gauge assembly", "flow meter"): 0.18}, []),
])  # fmt: skip
def test_a_likely_device_of_doubtful_type_is_a_valve(likely, found):
    assert valves(between(cone((0, 0, 0), (0.2, 0, 0), R, R), likely=likely)) == found
