import math

import numpy as np
import pytest

from cadgraph.hydraulics.batch import ProcessBatch
from cadgraph.hydraulics.process import Process
from cadgraph.query.network import Network
from networks import chain, junction, mounted, network, pumping, terminal, unit


def tanked():
    """A tank that a valve fills from above and another empties into the open, with a gauge at each."""
    tank = unit("T-001", ports=("N1", "N2"), at=(0.0, 0.0, 2.0))
    nodes = [
        terminal(1, at=(0.0, 0.0, 8.0)), unit("V-001", "gate valve", at=(0.0, 0.0, 6.0)), tank,
        unit("G-001", "pressure gauge"), unit("V-002", "ball valve"), terminal(2),
    ]  # fmt: skip
    return network(nodes, chain("X1 V-001 T-001.N1") + chain("T-001.N2 G-001 V-002 X2"))


def shown_on_the_shell():
    """A tank that a valve empties, with a level gauge that has no line."""
    nodes, touch = mounted()
    return network([*nodes, unit("V-001", "ball valve"), terminal(1)], [*touch, *chain("T-001.N1 V-001 X1")])


def looped():
    """Two pumps in parallel with check valves behind them, and a line between."""
    nodes = [terminal(1), junction(1), junction(2), junction(3), terminal(2), unit("G-009", "pressure gauge")]
    edges = chain("X1 J1") + chain("J2 J3") + chain("J3 G-009 X2")
    for number in (1, 2):
        tags = f"V-00{number}", f"P-00{number}", f"V-01{number}", f"G-00{number}"
        nodes += [
            unit(tags[0], "ball valve"),
            unit(tags[1], "centrifugal pump", ports=("N1", "N2")),
            unit(tags[2], "check valve"),
            unit(tags[3], "pressure gauge"),
        ]
        edges += chain(f"J1 {tags[0]} {tags[1]}.N1") + chain(f"{tags[1]}.N2 {tags[3]} {tags[2]} J{number + 1}")
    return network(nodes, edges)


def told(lot, n, columns):
    """What is commanded: some are told nothing, some to shut or stop, some to open, some anything between."""
    values = lot.random((n, columns))
    values = np.where(lot.random((n, columns)) < 0.4, lot.integers(0, 2, (n, columns)), values)
    return np.where(lot.random((n, columns)) < 0.5, np.nan, values)


@pytest.mark.parametrize(
    "graph", [pumping(), tanked(), looped(), shown_on_the_shell()], ids=["pumping", "tanked", "looped", "shell"]
)
def test_each_plant_goes_the_way_that_it_would_go_alone(graph):
    shared = Network(graph)
    plants = ProcessBatch(shared, count=12)
    alone = [Process(shared, plants.process.scenario) for _ in range(12)]
    lot = np.random.default_rng(7)
    for _ in range(12):
        opening, speed = told(lot, 12, len(plants.valves)), told(lot, 12, len(plants.pumps))
        plants.step(opening, speed, 0.7)
        reading, flow, level = plants.reading, plants.flow, plants.level
        for k, process in enumerate(alone):
            wanted = dict(zip(plants.valves, opening[k], strict=True)) | dict(zip(plants.pumps, speed[k], strict=True))
            state = process.step({tag: value for tag, value in wanted.items() if not math.isnan(value)}, 0.7)
            shown = [math.nan if value is None else value for value in state.reading.values()]
            assert reading[k] == pytest.approx(shown, abs=1e-6, nan_ok=True)
            assert flow[k, list(state.flow)] == pytest.approx(list(state.flow.values()), abs=1e-6)
            assert level[k] == pytest.approx(list(state.level.values()), abs=1e-6)
            assert plants.opening[k] == pytest.approx([state.opening[tag] for tag in plants.valves])
            assert tuple(np.array(plants.pumps)[plants.cavitating[k]]) == state.cavitating
    assert plants.time == pytest.approx(np.full(12, 8.4))


def test_plants_that_are_taken_back_are_as_in_the_beginning_and_the_others_go_on():
    plants = ProcessBatch(pumping(), count=3)
    first = plants.reading
    plants.step(np.zeros((3, len(plants.valves))), np.zeros((3, len(plants.pumps))), 30.0)
    changed = plants.reading
    assert not np.allclose(first, changed)
    plants.reset([1])
    assert np.array_equal(plants.reading[1], first[1])
    assert np.array_equal(plants.reading[[0, 2]], changed[[0, 2]])
    assert plants.time.tolist() == [30.0, 0.0, 30.0]


def test_plants_come_to_rest_at_once_where_that_is_asked_for():
    plants, process = ProcessBatch(pumping(), count=2), Process(pumping())
    opening = np.ones((2, len(plants.valves)))
    opening[1, 0] = 0.0
    plants.steady(opening, plants=[1])
    state = process.steady({plants.valves[0]: 0.0})
    assert plants.reading[1] == pytest.approx(list(state.reading.values()), abs=1e-6)
    assert plants.reading[0] == pytest.approx(list(Process(pumping()).state.reading.values()), abs=1e-6)


@pytest.mark.parametrize(
    ("opening", "dt", "said"),
    [([[2.0]], 1.0, "shape"), (np.full((2, 3), 1.5), 1.0, "from 0"), (None, 0.0, "dt"), (None, math.nan, "dt")],
)
def test_what_can_not_be_is_refused(opening, dt, said):
    plants = ProcessBatch(looped(), count=2)
    if opening is not None and np.shape(opening) == (2, 3):
        opening = np.full((2, len(plants.valves)), 1.5)
    with pytest.raises(ValueError, match=said):
        plants.step(opening, dt=dt)


def test_no_plant_is_refused():
    with pytest.raises(ValueError, match="0 plants"):
        ProcessBatch(pumping(), count=0)
