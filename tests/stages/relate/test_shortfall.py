"""What a network lacks, said out loud: each message made to appear, and to vanish when its cause goes."""

import pytest

import shapes
from piping import GAUGE, PIPE, STEEL, TANK, VALVE, R, gauge_mesh, pipe, valve_mesh
from sketch import Sketch, around, block


def told(sketch, code, **settings):
    """Message and meshes of each diagnostic with a code."""
    return [(one.message, one.meshes) for one in sketch.connected(**settings).diagnostics if one.code == code]


def valve(pipes, gap=0.0):
    """A valve that somebody named, with pipes on both of its sides or only before it."""
    sketch = Sketch()
    sketch.add(valve_mesh((0, 0, 0)), VALVE, "valve", source="author")
    sketch.pipe((-1, 0, 0), (-0.089, 0, 0), source="author")
    if pipes > 1:
        sketch.pipe((0.089 + gap, 0, 0), (1, 0, 0), source="author")
    return sketch


def test_a_valve_with_one_line_lacks_one():
    ((message, meshes),) = told(valve(1), "unit-short-of-lines")
    assert message.startswith("V-001 (")
    assert "has one line and needs two ports" in message
    assert meshes == ("/m0",)
    assert told(valve(2), "unit-short-of-lines") == []


def test_the_nearest_end_that_stops_short_of_it_is_named():
    ((message, meshes),) = told(valve(2, 0.02), "unit-short-of-lines", **{"cluster.eps": 0.03})
    assert "has one line and needs two ports; the nearest end stops 20.0 mm from it" in message
    assert meshes == ("/m0", "/m2")


def test_a_tank_needs_a_nozzle():
    alone = around((0.5, 0.5, 1.0), "one", group=TANK, name="tank", source="author")
    assert told(alone, "unit-short-of-lines") == []
    sketch = Sketch()
    sketch.add(block((0, 0, 0), 1.0), TANK, "tank", source="author")
    assert told(sketch, "unit-short-of-lines") == []  # all that is in its file
    sketch.pipe((5, 0, 0), (6, 0, 0), source="author")
    ((message, _),) = told(sketch, "unit-short-of-lines")
    assert "T-001 (tank) has no lines and needs one nozzle" in message


def gauge(at):
    """A tank with a pipe, and a gauge at a place."""
    sketch = around((0.5, 0.5, 1.0), "one", group=TANK, name="tank", source="author")
    sketch.add(gauge_mesh(at), GAUGE, "gauge", source="author")
    return sketch


def test_a_gauge_that_sits_on_a_tank_lacks_nothing():
    assert told(gauge((0, 0, 0.5)), "unit-short-of-lines") == []
    assert told(gauge((0, 0, 0.5)), "units-touch-unjoined") == []


def test_a_gauge_that_sits_on_nothing_lacks_a_line():
    ((message, _),) = told(gauge((0, 0, 0.6)), "unit-short-of-lines")
    assert "G-001" in message
    assert "has no lines and needs one port" in message


def beside(aside, **second):
    """A pipe that ends at another one, whose axis is off by so many radii."""
    sketch = Sketch()
    sketch.pipe((0, 0, 0), (1, 0, 0), source="author", bore=None)
    mesh = pipe((1.002, aside * R, 0), (2, aside * R, 0), bore=None)
    sketch.add(mesh, **{"group": PIPE, "name": "pipe", "source": "author", **second})
    return sketch


def test_a_free_end_before_another_pipe_is_told():
    found = told(beside(0.9), "end-before-part")
    assert found
    assert all("joins nothing" in message and "(pipe)" in message for message, _ in found)
    assert ("/m0", "/m1") in [meshes for _, meshes in found]
    assert any("ends 2.0 mm before /m1" in message for message, _ in found)


@pytest.mark.parametrize("sketch", [beside(0.0), beside(2.5)], ids=["joined", "elsewhere"])
def test_an_end_that_is_joined_or_has_nothing_before_it_is_not_told(sketch):
    assert told(sketch, "end-before-part") == []


@pytest.mark.parametrize(("group", "name", "count"), [(STEEL, "plate", 0), (None, None, 1)])
def test_an_end_before_steelwork_is_meant(group, name, count):
    # Beside the end's axis, so that it joins nothing.
    sketch = Sketch()
    sketch.pipe((0, 0, 0), (1, 0, 0), source="author", bore=None)
    sketch.pipe((0, 5, 0), (1, 5, 0), source="author")
    sketch.add(shapes.box((0.02, 0.02, 0.2), (1.016, 1.05 * R + 0.01 - 0.005, 0)), group, name, source="author")
    assert len(told(sketch, "end-before-part")) == count


def abreast(pipes, apart=0.16):
    """Two valves side by side whose flanges nearly touch, each with so many pipes."""
    sketch = Sketch()
    for y in (0.0, apart):
        sketch.add(valve_mesh((0, y, 0)), VALVE, "valve", source="author")
        sketch.pipe((-1, y, 0), (-0.089, y, 0), source="author")
        if pipes > 1:
            sketch.pipe((0.089, y, 0), (1, y, 0), source="author")
    return sketch


def test_units_that_touch_without_being_joined_are_told_where_one_lacks_a_line():
    one = Sketch()
    one.add(valve_mesh((0, 0, 0)), VALVE, "valve", source="author")
    # Beside the valve's wheel, which is 0.08 m wide to either side.
    one.add(block((0.0, 0.585, 0.35), (1.0, 1.0, 0.35)), TANK, "tank", source="author")
    one.pipe((-1, 0, 0), (-0.089, 0, 0), source="author")
    ((message, meshes),) = told(one, "units-touch-unjoined")
    assert message.startswith("T-001 and V-001 are 5.0 mm apart and not joined")
    assert meshes == ("/m0", "/m1")
    one.pipe((0.089, 0, 0), (2, 0, 0), source="author")
    one.pipe((0, 1.085, 0.35), (0, 2, 0.35), source="author")
    assert told(one, "units-touch-unjoined") == []


def test_units_that_lack_lines_but_stand_apart_are_not_told():
    assert told(abreast(1, 0.5), "units-touch-unjoined") == []
    assert len(told(abreast(1, 0.5), "unit-short-of-lines")) == 2


def test_a_structure_whose_lines_fall_into_pieces_is_told():
    held = abreast(2, 0.5)
    assert told(held, "network-in-pieces") == [], "two structures of one network each"
    held.add(shapes.box((0.05, 0.5, 0.05), (-0.5, 0.25, -R - 0.025)), STEEL, "beam", source="author")
    ((message, meshes),) = told(held, "network-in-pieces")
    assert "holds 2 networks that nothing joins (V-001; V-002)" in message
    assert meshes == ("/m0", "/m3")
    held.add(pipe((-0.7, R, 0), (-0.7, 0.5 - R, 0), 0.4 * R, 0.3 * R), PIPE, "pipe", source="author")
    assert told(held, "network-in-pieces") == []


def test_a_connector_that_no_line_can_be_traced_through_is_told():
    sketch = Sketch()
    sketch.pipe((0, 0, 0), (1, 0, 0), source="author")
    sketch.add(block((3, 0, 0), (0.1, 0.2, 0.3)), PIPE, "strainer", source="author")
    ((message, meshes),) = told(sketch, "line-untraced")
    assert message.startswith("1 connectors have a shape that no line could be traced through")
    assert meshes == ("/m1",)
    # Where lines end at it, it is part of the run.
    sketch.pipe((1, 0, 0), (2.95, 0, 0), source="author")
    assert told(sketch, "line-untraced") == []


def test_a_plant_that_is_whole_lacks_nothing():
    codes = {one.code for one in valve(2).connected().diagnostics}
    assert codes == set()
