"""Stems of gauges and nozzles of tanks that look like pipe: each limit on both sides."""

import pytest

from cadgraph.stages.relate.foot import BESIDE
from cadgraph.stages.relate.recover import recover_units
from piping import GAUGE, PIPE, STEEL, TANK, VALVE, R, gauge_mesh, pipe
from sketch import Sketch, block

STEM = 0.1  # m
THIN = {"radius": 0.01, "bore": None}  # m


def stands(length=STEM, likely=None, group=None, name=None, source="geometry", gauge="author"):
    """Whether the piece between a pipe and a gauge becomes the gauge's."""
    sketch = Sketch()
    run = sketch.pipe((0, 0, -1), (0, 0, 0), source="author", **THIN)
    said = {(GAUGE, "gauge stem"): 0.2, (PIPE, "nipple"): 0.3} if likely is None else likely
    stem = sketch.add(pipe((0, 0, 0), (0, 0, length), **THIN), group, name, source=source, likely=said)
    sketch.add(gauge_mesh((0, 0, length)), GAUGE, "gauge", source=gauge)
    piping = recover_units(sketch.piping())
    assert run in piping.lines
    return stem not in piping.lines and any(stem in group.parts for group in piping.groups)


def test_a_piece_of_unknown_name_at_a_gauge_is_its_stem():
    assert stands()


@pytest.mark.parametrize(("stem", "found"), [(1.05, True), (0.95, False)])
def test_it_looks_enough_like_one(stem, found):
    assert stands(likely={(GAUGE, "gauge stem"): stem * 0.3 / BESIDE, (PIPE, "nipple"): 0.3}) is found


@pytest.mark.parametrize(("valve", "stem"), [(0.15, True), (0.25, False)])
def test_what_is_likelier_a_valve_is_no_stem(valve, stem):
    assert stands(likely={(GAUGE, "gauge stem"): 0.2, (PIPE, "nipple"): 0.3, (VALVE, "valve body"): valve}) is stem


def test_a_long_piece_is_pipe():
    assert not stands(length=0.5)


@pytest.mark.parametrize(("share", "found"), [(0.55, True), (0.45, False)])
def test_unless_it_is_surely_the_gauges(share, found):
    assert stands(length=0.5, likely={(GAUGE, "gauge stem"): share, (PIPE, "nipple"): 0.3}) is found


def test_what_a_label_calls_a_connector_stays_one():
    assert not stands(group=PIPE, name="nipple", likely={(GAUGE, "gauge stem"): 0.2, (PIPE, "nipple"): 0.6})
    assert not stands(group=PIPE, name="nipple", source="author")


def test_only_gauges_and_tanks_have_feet():
    sketch = Sketch()
    sketch.pipe((0, 0, -1), (0, 0, 0), source="author", **THIN)
    piece = sketch.add(pipe((0, 0, 0), (0, 0, STEM), **THIN), likely={(TANK, "nozzle"): 0.2, (PIPE, "nipple"): 0.3})
    sketch.add(gauge_mesh((0, 0, STEM)), "Valve assembly", "valve", source="author")
    assert piece in recover_units(sketch.piping()).lines


def nozzle(tank="author", label=None, beside=False, likely=None):
    """What the piece between a tank and a valve is of, a pipe along it where asked."""
    sketch = Sketch()
    sketch.add(block((0, 0, 0.5), (0.5, 0.5, 1.0)), TANK, "tank", source=tank)
    said = {(TANK, "nozzle"): 0.2, (PIPE, "nipple"): 0.3} if likely is None else likely
    piece = sketch.add(block((0, 0, -0.1), (0.06, 0.06, 0.2)), *(label or (None, None)), likely=said)
    sketch.add(block((0, 0, -0.25), 0.1), VALVE, "valve", source="author")
    if beside:
        sketch.pipe((0.03 + R, 0, -0.19), (0.03 + R, 0, -0.01), source="author")
    return [group.unit_type for group in recover_units(sketch.piping()).groups if piece in group.parts]


def test_a_piece_between_a_tank_and_a_valve_is_its_nozzle():
    assert nozzle() == ["tank"]
    assert nozzle(likely={(TANK, "nozzle"): 0.1, (PIPE, "nipple"): 0.5}) == []
    assert nozzle(likely={(TANK, "nozzle"): 0.2, (VALVE, "valve body"): 0.3}) == []
    assert nozzle(label=(STEEL, "post")) == [], "it is called something else"
    assert nozzle(beside=True) == [], "it touches a pipe, whose end would tell"


def test_a_piece_between_two_tanks_is_of_one_of_them():
    sketch = Sketch()
    sketch.add(block((0, 0, 0.5), (0.5, 0.5, 1.0)), TANK, "tank", source="author")
    piece = sketch.add(block((0, 0, -0.1), (0.06, 0.06, 0.2)), likely={(TANK, "nozzle"): 0.2, (PIPE, "nipple"): 0.3})
    sketch.add(block((0, 0, -0.7), (0.5, 0.5, 1.0)), TANK, "tank", source="author")
    assert sum(piece in group.parts for group in recover_units(sketch.piping()).groups) == 1
