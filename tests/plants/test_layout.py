import numpy as np
import pytest

from cadplants import STYLES
from cadplants.families.preset_devices import Gauge
from cadplants.lines.instrument import reducer_at, tap_at, tee_at, valve_at
from cadplants.lines.layout import Inline, Run, lay
from cadplants.lines.route import Route
from cadplants.model.standards import ELBOW_LONG_RADIUS

HAND = STYLES["plant-design"]
GAUGE = Gauge(size=63, marks="none", stem=0.075, turn=0.0, reading=1.2)
STRAIGHT = Route(np.array([(0.0, 0.0, 0.0), (3.0, 0.0, 0.0)]))
ROUND_A_CORNER = Route(np.array([(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (2.0, 2.0, 0.0)]))


def names(laid):
    return [component.name for component in laid.assembly.components]


def test_a_bare_run_is_one_pipe_between_two_terminals():
    laid = lay(Run("L", 50, STRAIGHT), HAND)
    assert names(laid) == ["pipe"]
    assert [point.id for point in laid.assembly.points] == ["L/start", "L/end"]
    (only,) = laid.assembly.connections
    assert (only.source, only.target, only.length) == ("L/start", "L/end", 3.0)


def test_an_elbow_takes_a_corner_and_shortens_the_way():
    laid = lay(Run("L", 50, ROUND_A_CORNER), HAND)
    assert names(laid) == ["pipe", "elbow", "pipe"]
    radius = ELBOW_LONG_RADIUS[50]
    assert laid.assembly.connections[0].length == pytest.approx(4.0 - 2 * radius + radius * np.pi / 2)


def test_bent_pipe_is_one_mesh_round_a_corner():
    assert names(lay(Run("L", 50, ROUND_A_CORNER, bent=True), HAND)) == ["pipe"]


def test_nodes_follow_each_other_by_place_whatever_their_order_in_the_run():
    inline = (valve_at(2.4, "globe", "V-2", 50), valve_at(0.8, "ball", "V-1", 50))
    taps = (tap_at(1.6, GAUGE, "G-1"), tap_at(0.3, GAUGE, "G-2"))
    connections = lay(Run("L", 50, STRAIGHT, inline, taps), HAND).assembly.connections
    order = [connections[0].source, *(c.target for c in connections)]
    assert order == ["L/start", "G-2", "V-1", "G-1", "V-2", "L/end"]
    assert sum(c.length for c in connections) == pytest.approx(3.0)


def test_a_tee_is_a_junction_of_the_run():
    laid = lay(Run("L", 80, STRAIGHT, (tee_at(1.0, "J-1", 80, 50),)), HAND)
    assert names(laid) == ["pipe", "tee", "pipe"]
    assert [c.target for c in laid.assembly.connections] == ["J-1", "L/end"]
    assert laid.devices["J-1"] == 1


def test_behind_a_reducer_the_run_is_smaller():
    run = Run("L", 80, STRAIGHT, (reducer_at(1.0, 80, 50), valve_at(2.0, "ball", "V-1", 50)))
    connections = lay(run, HAND).assembly.connections
    assert [c.diameter for c in connections] == [0.08, 0.05]
    assert run.dn_at(0.9) == 80
    assert run.dn_at(1.1) == 50


def test_devices_that_overlap_are_an_error():
    with pytest.raises(ValueError, match="overlap"):
        lay(Run("L", 50, STRAIGHT, (Inline(1.0), Inline(1.05))), HAND)


def test_a_device_in_a_corner_is_an_error():
    with pytest.raises(ValueError, match="no room"):
        lay(Run("L", 50, ROUND_A_CORNER, (Inline(1.9),)), HAND)


def test_a_tap_on_a_valve_is_an_error():
    with pytest.raises(ValueError, match="no pipe"):
        lay(Run("L", 50, STRAIGHT, (valve_at(1.0, "ball", "V-1", 50),), (tap_at(1.0, GAUGE, "G-1"),)), HAND)


def test_a_joint_at_the_end_offers_what_touches_the_nozzle():
    laid = lay(Run("L", 50, STRAIGHT, ends=("joint", "joint"), nodes=("T-1", "T-2")), HAND)
    components = laid.assembly.components
    for end in (laid.first, laid.last):
        assert sorted(components[i].name for i in end) == ["bolt"] * 4 + ["gasket"]
    assert not laid.assembly.points
    assert laid.assembly.connections[0].source == "T-1"
