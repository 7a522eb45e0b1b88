"""Which way it flows, and nominal sizes."""

import numpy as np
import pytest

import shapes
from cadgraph.model.parts import Link, Network, UnitParts
from cadgraph.model.records import Contains, System
from cadgraph.stages.relate.flow import stated_flow
from cadgraph.stages.relate.size import nominal_size, sizes_along, table_of
from piping import PIPE, PUMP, TANK, VALVE, Plant, R, bend, connections, merged, tags, turned, valve_mesh


def pump_mesh(z=0.0):
    """A pump in one mesh: motor and casing along x, suction towards +x, a narrower discharge upward."""
    return merged(
        turned(shapes.cylinder(0.1, 0.4), (-0.35, 0, z), (1, 0, 0)),
        turned(shapes.cylinder(0.12, 0.1), (-0.05, 0, z), (1, 0, 0)),
        turned(shapes.cylinder(0.045, 0.1), (0.05, 0, z), (1, 0, 0)),
        turned(shapes.cylinder(0.03, 0.2), (-0.05, 0, z + 0.1), (0, 0, 1)),
    )


def pump_line(suction=0.0445, discharge=R):
    plant = Plant().add(pump_mesh(), PUMP, "pump")
    plant.pipe((0.1, 0, 0), (1, 0, 0), radius=suction, bore=None)
    plant.pipe((-0.05, 0, 0.2), (-0.05, 0, 1), radius=discharge, bore=None)
    plant.add(valve_mesh((-0.05, 0, 1.089), (0, 0, 1), up=(1, 0, 0)), VALVE, "valve")
    return plant.pipe((-0.05, 0, 1.178), (-0.05, 0, 2), bore=None)


def flows(graph):
    """For each directed connection where it comes from and goes to, with its confidence."""
    names = tags(graph)
    found = {}
    for one in connections(graph):
        ends = [names.get(one.source, "end"), names.get(one.target, "end")]
        if one.direction != "unknown":
            found[tuple(ends if one.direction == "forward" else ends[::-1])] = one.direction_confidence
    return found


def test_a_pump_draws_along_its_shaft_and_delivers_across():
    graph = pump_line().graph()
    found = flows(graph)
    assert set(found) == {("end", "P-001"), ("P-001", "V-001"), ("V-001", "end")}
    assert found["P-001", "V-001"] == 0.95
    assert graph.units()[0].kind == "centrifugal pump"
    assert all(one.reason for one in connections(graph))


def test_equal_nozzles_leave_the_axes_to_tell():
    assert flows(pump_line(R, R).graph())["P-001", "V-001"] == 0.85


def test_a_suction_narrower_than_the_discharge_is_left_open():
    assert flows(pump_line(R, 0.0445).graph()) == {}


def drained_tank():
    profile = [(0, -0.1), (0.3, -0.08), (0.5, 0), (0.5, 1.5), (0.3, 1.58), (0, 1.6)]
    plant = Plant().add(shapes.lathe(profile, 32), TANK, "tank")
    plant.pipe((0.495, 0, 0.1), (1, 0, 0.1)).add(valve_mesh((1.089, 0, 0.1)), VALVE, "valve")
    plant.pipe((1.178, 0, 0.1), (2, 0, 0.1))
    return plant.pipe((-0.495, 0, 1.3), (-1, 0, 1.3))


def test_what_is_low_at_a_tank_drains_it_by_weak_evidence():
    found = flows(drained_tank().graph())
    assert set(found) == {("T-001", "V-001"), ("V-001", "end")}
    assert max(found.values()) < 0.8


def test_a_statement_outweighs_weak_evidence_and_the_contradiction_is_told():
    graph = drained_tank().graph(**{"relate.flow": ["V-001 -> T-001"]})
    assert flows(graph)["V-001", "T-001"] == 1.0
    assert [f.code for f in graph.document.diagnostics if f.code.startswith("flow")] == ["flow-contradiction"]


@pytest.mark.parametrize("text", ["V-001", "V-001 -> ", "V-001 -> T-009", "V-001 => T-001"])
def test_a_statement_that_names_nothing_is_refused(text):
    with pytest.raises(ValueError, match=r"relate\.flow"):
        drained_tank().graph(**{"relate.flow": [text]})


def network(*pairs):
    """Units A.. in a network of links of 1 m."""
    names = sorted({name for pair in pairs for name in pair})
    units = tuple(UnitParts("valve", name, (k,)) for k, name in enumerate(names))
    links = tuple(Link(names.index(a), names.index(b), (), ((0.0, 0.0, 0.0),), 1.0) for a, b in pairs)
    return Network(units, (), links, (tuple(range(len(units))),))


def test_what_every_way_runs_through_is_sure_and_the_rest_of_the_shortest_way_less():
    found = stated_flow(network(("A", "B"), ("B", "C"), ("B", "D"), ("D", "C"), ("C", "E")), ["A -> E"])
    assert [(one.link, one.forward, one.confidence) for one in found] == [
        (0, True, 1.0),
        (1, True, 0.9),
        (4, True, 1.0),
    ]


def test_units_that_nothing_joins_can_have_no_flow_between_them():
    with pytest.raises(ValueError, match="no line joins"):
        stated_flow(network(("A", "B"), ("C", "D")), ["A -> D"])


@pytest.mark.parametrize(
    ("diameter", "size"),
    [(0.0603, 50), (0.1143, 100), (0.0730, 65), (0.0761, 65), (0.3238, 300), (0.0603 * 1.04, 50), (0.0537, None)],
)
def test_nominal_sizes_follow_the_outer_diameter(diameter, size):
    assert nominal_size(diameter) == size


def test_sizes_are_listed_where_they_change():
    pieces = [(1.0, 0.0603), (0.5, 0.0603), (0.01, 0.15), (0.3, 0.054), (2.0, 0.0483), (1.0, 0.0603)]
    assert sizes_along(pieces) == (50, 40, 50)
    assert sizes_along([]) == ()


@pytest.mark.parametrize(
    ("diameters", "size"),
    [
        ((0.041, 0.053, 0.070), 40),
        ((0.041, 0.053, 0.0424), 32),  # a third of it is pipe
        ((0.0405, 0.053, 0.0603), 32),  # a polygon that is as wide as neither
        ((0.0424, 0.0603), 32),
        ((), 32),
    ],
)
def test_sizes_are_those_of_hygienic_tubes_where_most_of_a_plant_is_made_of_them(diameters, size):
    table = table_of([(1.0, diameter) for diameter in diameters])
    assert nominal_size(0.041, table) == size
    assert sizes_along([(1.0, 0.041)], table) == (size,)


@pytest.mark.parametrize(
    ("diameters", "size"),
    [
        ((0.0508, 0.0381, 0.0508), 50),
        ((0.0508, 0.0508, 0.1016), 50),  # as wide as a pipe, too, says nothing
        ((0.0761, 0.0761, 0.0761, 0.0127), None),  # pipes of DN 65, and a tube of an instrument
        ((0.0508, 0.0603, 0.0483), None),
    ],
)
def test_tubes_in_inches_have_sizes_of_their_own(diameters, size):
    assert nominal_size(0.0508, table_of([(1.0, diameter) for diameter in diameters])) == size


def test_lines_of_hygienic_tubes_have_their_sizes():
    plant = Plant().pipe((0, 0, 0), (1, 0, 0), radius=0.0205, bore=0.019)
    plant.pipe((0, 1, 0), (1, 1, 0), radius=0.0265, bore=0.025)
    assert sorted(c.size for c in connections(plant.graph())) == [40, 50]


def test_systems_hold_their_units_lengths_and_sizes_in_the_graph():
    plant = drained_tank()
    plant.pipe((0, 5, 0), (1, 5, 0), radius=0.0241, bore=0.0204)
    plant.add(bend((0, 5, 0), (1.076, 5, 0), (1.076, 6, 0), radius=0.0241, bore=0.0204), PIPE, "elbow")
    graph = plant.graph()
    first, second = sorted(graph.of_layer(System), key=lambda system: -len(system.units))
    assert (len(first.units), first.sizes, second.units, second.sizes) == (2, (50,), (), (40,))
    # The faces of a bend in flat pieces look along its first and last piece, not along the arc.
    assert second.length == pytest.approx(1 + 0.076 * np.pi / 2, abs=0.005)
    held = {edge.target for edge in graph.of_kind(Contains) if edge.source == first.id}
    assert held == {*first.units, *first.junctions, *first.terminals}


def test_ports_look_outward_and_lie_at_the_ends_of_the_pipes():
    graph = drained_tank().graph()
    valve = next(unit for unit in graph.units() if unit.unit_type == "valve")
    assert [port.name for port in valve.ports] == ["N1", "N2"]
    assert [port.direction for port in valve.ports] == [pytest.approx((-1, 0, 0)), pytest.approx((1, 0, 0))]
    assert [port.point for port in valve.ports] == [
        pytest.approx((1, 0, 0.1), abs=1e-6), pytest.approx((1.178, 0, 0.1), abs=1e-6)
    ]  # fmt: skip
