"""Flow meters that labels take for valves: what sits on a body and what is likely decide, each limit on both sides."""

import math

import pytest

from cadgraph.stages.relate.meter import CARRIES
from cadgraph.stages.relate.recover import recover_units
from piping import GAUGE, VALVE, R
from sketch import Sketch, block

SHUT = 0.8  # how likely the body is a valve's


def metered(meter=0.15, n_pipes=2, head=("transmitter", "geometry"), extra=None, source="geometry", tube=False):
    """A body in a line, the first part, that looks like a valve's, and something on it, the second one."""
    sketch = Sketch()
    likely = {(VALVE, "valve body"): SHUT, (GAUGE, "flow meter"): meter}
    sketch.add(block((0, 0, 0), (0.2, 0.16, 0.16)), VALVE, "valve body", SHUT, source, likely)
    sketch.add(block((0, 0, 0.14), (0.06, 0.06, 0.12)), GAUGE, head[0], source=head[1])
    if extra is not None:
        sketch.add(block((0, 0, -0.12), (0.04, 0.04, 0.08)), *extra)
    for sign in (-1, 1)[:n_pipes]:
        sketch.pipe((sign, 0, 0), (sign * 0.1, 0, 0))
    if tube:
        sketch.pipe((0, 0, 0.2), (0, 0, 1), radius=0.4 * R, bore=0.3 * R)
    return sketch


def units(sketch):
    return sorted((group.unit_type, group.parts) for group in recover_units(sketch.piping()).groups)


METER = [("gauge", (0, 1))]
VALVE_AND_GAUGE = [("gauge", (1,)), ("valve", (0,))]


def test_a_body_under_a_transmitter_is_a_flow_meter():
    assert units(metered()) == METER
    result = metered().connected()
    assert [(unit.unit_type, unit.kind, unit.parts) for unit in result.network.units] == [
        ("gauge", "flow meter", (0, 1))
    ]
    label = result.labels[0]
    assert (label.group, label.name, label.source) == (GAUGE, "flow meter", "network")
    assert "a transmitter sits on it" in label.evidence.why


@pytest.mark.parametrize(("factor", "found"), [(1.05, METER), (0.95, VALVE_AND_GAUGE)])
def test_the_labeler_must_have_thought_of_one(factor, found):
    least = SHUT * 1.5 * math.exp(-CARRIES)  # as likely as 0.6 to 0.4
    assert units(metered(factor * least)) == found


def test_what_has_an_operator_is_a_valve():
    assert units(metered(extra=(VALVE, "lever"))) == [("gauge", (1,)), ("valve", (0, 2))]


@pytest.mark.parametrize("name", ["gauge case", "thermowell"])
def test_another_gauge_on_it_tells_nothing(name):
    assert units(metered(head=(name, "geometry"))) == VALVE_AND_GAUGE


def test_a_transmitter_on_a_line_of_its_own_measures_that():
    assert units(metered(tube=True)) == VALVE_AND_GAUGE


def test_a_meter_lies_in_a_line():
    assert units(metered(n_pipes=1)) == VALVE_AND_GAUGE


def test_what_people_call_a_valve_stays_one():
    assert units(metered(source="author")) == VALVE_AND_GAUGE
    assert units(metered(head=("transmitter", "author"))) == METER
