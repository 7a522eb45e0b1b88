"""Instruments that labels miss or take for valves: where something stands and what is likely decide, on both sides."""

import math

import pytest

from cadgraph.stages.relate.instrument import ALONE
from cadgraph.stages.relate.recover import recover_units
from piping import FASTENER, GAUGE, PIPE, TANK, VALVE, R
from sketch import Sketch, block

SHUT = 0.7  # how likely it is a valve's


def on_tank(measures=0.24, shuts=SHUT, labelled=True, source="geometry", tank="tank"):
    """Something on a tank with a pipe, the first part."""
    sketch = Sketch()
    likely = {(VALVE, "valve"): shuts, (GAUGE, "transmitter"): measures}
    said = (VALVE, "valve", shuts, source) if labelled else (None, None, 0.0)
    sketch.add(block((0, 0, 0.56), (0.1, 0.1, 0.12)), *said, likely=likely)
    sketch.add(block((0, 0, 0), (0.9, 0.9, 1.0)), TANK, tank)
    sketch.pipe((0.45, 0, 0), (1.4, 0, 0))
    return sketch


def on_line(measures=0.5, shuts=0.25, at_end=False, named_by="geometry"):
    """Something without a label on the side of a pipe, or at its end, the first part."""
    sketch = Sketch()
    likely = {(VALVE, "valve"): shuts, (GAUGE, "transmitter"): measures}
    place = (1.04, 0, 0) if at_end else (0, 0, R + 0.04)
    sketch.add(block(place, (0.08, 0.05, 0.08)), likely=likely)
    sketch.pipe((-1, 0, 0), (1, 0, 0), source=named_by)
    sketch.add(block((-1.5, 0, 0), (1.0, 0.9, 0.9)), TANK, "tank", source=named_by)
    return sketch


def type_of(sketch, part=0):
    types = [group.unit_type for group in recover_units(sketch.piping()).groups if part in group.parts]
    return types[0] if types else None


def test_a_lone_valve_on_a_vessel_is_rather_an_instrument():
    assert type_of(on_tank()) == "gauge"
    result = on_tank().connected()
    assert {unit.unit_type for unit in result.network.units} == {"gauge", "tank"}
    label = result.labels[0]
    assert (label.group, label.source) == (GAUGE, "network")
    assert "it stands alone on a vessel" in label.evidence.why


@pytest.mark.parametrize(("factor", "kind"), [(1.05, "gauge"), (0.95, "valve")])
def test_the_labeler_must_have_thought_of_one(factor, kind):
    assert type_of(on_tank(factor * SHUT * math.exp(-ALONE["vessel"]))) == kind


def test_what_people_call_a_valve_stays_one():
    assert type_of(on_tank(source="author")) == "valve"


def test_what_moves_a_valve_speaks_against_an_instrument():
    sketch = on_tank()
    sketch.add(block((0, 0, 0.65), (0.2, 0.2, 0.04)), VALVE, "handwheel", 0.95)
    assert type_of(sketch) == "valve"


def test_a_valve_that_a_line_leads_on_from_stays_one():
    sketch = on_tank()
    sketch.pipe((0, 0, 0.62), (0, 0, 1.5))
    assert type_of(sketch) == "valve"


def test_a_valve_between_two_things_stays_one():
    sketch = on_tank()
    sketch.add(block((0, 0, 1.12), (0.9, 0.9, 1.0)), TANK, "tank")
    assert type_of(sketch) == "valve"


def test_what_holds_it_tells_nothing():
    sketch = on_tank()
    sketch.add(block((0.06, 0, 0.52), (0.02, 0.02, 0.04)), FASTENER, "bolt")
    assert type_of(sketch) == "gauge"


def test_an_unnamed_thing_on_a_vessel_is_an_instrument_where_that_is_likely():
    assert type_of(on_tank(0.43, 0.55, labelled=False)) == "gauge"
    assert type_of(on_tank(0.1, 0.2, labelled=False)) is None


def test_so_is_one_on_the_side_of_a_line():
    assert type_of(on_line()) == "gauge"


@pytest.mark.parametrize(("factor", "kind"), [(1.03, "gauge"), (0.97, None)])
def test_what_may_be_neither_is_none(factor, kind):
    shuts = 0.2
    # As likely as 0.6 to 0.4: what it is not is a valve, which seldom stands so, or neither.
    least = 1.5 * (1 - shuts * (1 - math.exp(-ALONE["line"]))) / 2.5
    assert type_of(on_line(factor * least, shuts)) == kind


def test_at_the_end_of_a_line_other_things_decide():
    assert type_of(on_line(0.05, 0.9, at_end=True)) != "gauge"


def test_what_people_left_without_a_name_is_no_instrument():
    assert type_of(on_line(named_by="author")) is None


def test_a_line_beside_it_is_another_thing_that_it_touches():
    sketch = on_line()
    sketch.add(block((0.05, 0, R + 0.04), (0.02, 0.2, 0.02)), PIPE, "coupling")
    assert type_of(sketch) is None
