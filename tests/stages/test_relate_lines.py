"""What follows what along the pipes: every construct by a scene of a few parts."""

import numpy as np
import pytest

import shapes
import tubes
from piping import (
    BORE,
    FASTENER,
    GAUGE,
    PIPE,
    STEEL,
    TANK,
    VALVE,
    Plant,
    R,
    bend,
    connections,
    gauge_mesh,
    junctions,
    links,
    merged,
    pipe,
    plate,
    ring,
    systems,
    terminals,
    turned,
    valve_mesh,
)


def tapped(plant, x, y=0.0, outlet=True, radius=R):
    """A gauge on a pipe along x, on an outlet or bare."""
    foot = radius
    if outlet:
        plant.add(turned(shapes.cylinder(0.011, 0.03), (x, y, radius + 0.014), (0, 0, 1)), PIPE, "branch outlet")
        foot = radius + 0.029
    plant.add(gauge_mesh((x, y, foot)), GAUGE, "gauge")


@pytest.mark.parametrize("outlet", [True, False], ids=["outlet", "bare"])
@pytest.mark.parametrize("bore", [BORE, None], ids=["hollow", "solid"])
def test_gauges_tapped_into_one_pipe_follow_each_other_by_their_taps(bore, outlet):
    plant = Plant().pipe((0, 0, 0), (4, 0, 0), bore=bore)
    for x in (3.0, 1.0, 2.0):
        tapped(plant, x, outlet=outlet)
    graph = plant.graph()
    # Tags go by position, so that their order is that of the taps.
    assert links(graph) == [("G-001", "G-002"), ("G-001", "open"), ("G-002", "G-003"), ("G-003", "open")]
    assert sorted(round(c.length, 2) for c in connections(graph)) == [1.0, 1.0, 1.0, 1.0]


def test_a_gauge_behind_a_valve_hangs_on_a_junction():
    plant = Plant().pipe((0, 0, 0), (2, 0, 0))
    plant.add(pipe((1, 0, R - 0.004), (1, 0, 0.3), 0.011, 0.008), PIPE, "pipe")
    plant.add(turned(shapes.cylinder(0.02, 0.1), (1, 0, 0.35), (0, 0, 1)), VALVE, "valve")
    plant.add(gauge_mesh((1, 0, 0.4)), GAUGE, "gauge")
    assert links(plant.graph()) == [("G-001", "V-001"), ("J", "V-001"), ("J", "open"), ("J", "open")]


def line_with_valve(gap=0.0, **kind):
    """Pipe, flange, valve in one mesh, flange, pipe along x; the pipes end short of their flanges."""
    plant = Plant()
    plant.add(valve_mesh((1, 0, 0)), VALVE, "valve")
    for sign in (-1, 1):
        face = 1 + sign * 0.089
        plant.add(ring((face, 0, 0), (sign, 0, 0), 0.02), PIPE, "flange")
        start = face + sign * (0.02 + gap)
        plant.pipe((start, 0, 0), (1 + sign, 0, 0), **kind)
    return plant


@pytest.mark.parametrize("gap", [0.0, 0.003, 0.005, 0.008, 0.0115])
@pytest.mark.parametrize("bore", [BORE, None], ids=["hollow", "solid"])
def test_a_pipe_that_ends_short_of_its_flange_is_joined(gap, bore):
    graph = line_with_valve(gap, bore=bore).graph()
    assert links(graph) == [("V-001", "open"), ("V-001", "open")]
    assert sum(f.code == "bridged-gap" for f in graph.document.diagnostics) == (gap > 0.001)


def test_a_gap_wider_than_the_setting_is_an_end():
    graph = line_with_valve(0.008).graph(**{"relate.bridge": 0.006, "cluster.eps": 0.02})
    assert links(graph) == [("V-001", "open"), ("V-001", "open"), ("open", "open"), ("open", "open")]


@pytest.mark.parametrize("gap", [0.0, 0.004, 0.008])
def test_pipes_meet_a_valve_in_one_mesh_without_flanges_of_their_own(gap):
    plant = Plant().add(valve_mesh((1, 0, 0)), VALVE, "valve")
    plant.pipe((0, 0, 0), (0.911 - gap, 0, 0)).pipe((1.089 + gap, 0, 0), (2, 0, 0))
    assert links(plant.graph()) == [("V-001", "open"), ("V-001", "open")]


def test_a_slip_on_flange_lies_over_the_end_of_its_pipe():
    plant = Plant().add(valve_mesh((1, 0, 0)), VALVE, "valve")
    for sign in (-1, 1):
        face = 1 + sign * 0.089
        plant.add(ring((face, 0, 0), (sign, 0, 0), 0.03, inner=R + 0.0005), PIPE, "flange")
        plant.pipe((face + sign * 0.005, 0, 0), (1 + sign, 0, 0))
    graph = plant.graph()
    assert links(graph) == [("V-001", "open"), ("V-001", "open")]
    assert sum(c.length for c in connections(graph)) == pytest.approx(2.0, abs=0.012)


def test_a_tee_is_a_junction():
    tee = tubes.tee(R, R, 0.1, 0.1, 24)
    plant = Plant().add(tee, PIPE, "tee")
    plant.pipe((-1, 0, 0), (-0.1, 0, 0)).pipe((0.1, 0, 0), (1, 0, 0)).pipe((0, 0, 0.1), (0, 0, 1))
    graph = plant.graph()
    assert links(graph) == [("J", "open")] * 3
    assert junctions(graph)[0].point == pytest.approx((0, 0, 0), abs=0.005)


def test_a_cross_is_one_junction_of_four():
    plant = Plant().add(tubes.tee(R, R, 0.1, 0.1, 24, both=True), PIPE, "cross")
    for d in np.array([(1, 0, 0), (-1, 0, 0), (0, 0, 1), (0, 0, -1)]):
        plant.pipe(0.1 * d, 1.0 * d)
    assert links(plant.graph()) == [("J", "open")] * 4


@pytest.mark.parametrize("gap", [-0.01, 0.0, 0.004])
def test_a_header_with_stubs_is_a_chain_of_junctions(gap):
    plant = Plant().pipe((0, 0, 0), (5, 0, 0), radius=0.057, bore=0.051)
    for x in (1, 2, 3, 4):
        plant.pipe((x, 0, 0.057 + gap), (x, 0, 1))
    graph = plant.graph()
    assert links(graph) == [("J", "J")] * 3 + [("J", "open")] * 6
    assert [round(node.point[0], 2) for node in junctions(graph)] == [1, 2, 3, 4]


def loop(plant):
    corners = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)]
    for k in range(4):
        before, here, after = (np.array(corners[(k + j) % 4], float) for j in (-1, 0, 1))
        plant.add(bend(before, here, after), PIPE, "elbow")
        d = (after - here) / np.linalg.norm(after - here)
        start, end = here + 0.076 * d, after - 0.076 * d
        if k % 2 == 0:
            middle = (start + end) / 2
            plant.add(valve_mesh(middle, d), VALVE, "valve")
            plant.pipe(start, middle - 0.089 * d).pipe(middle + 0.089 * d, end)
        else:
            plant.pipe(start, end)
    return plant


def test_a_loop_stays_a_loop():
    graph = loop(Plant()).graph()
    assert links(graph) == [("V-001", "V-002"), ("V-001", "V-002")]
    (system,) = systems(graph)
    assert system.length == pytest.approx(6 - 8 * (0.076 - 0.076 * np.pi / 4), rel=0.01)


def test_runs_end_open_or_blind():
    plant = Plant().pipe((0, 0, 0), (1, 0, 0))
    plant.add(ring((1, 0, 0), (1, 0, 0)), PIPE, "flange").add(plate((1.02, 0, 0), (1, 0, 0)), PIPE, "blind flange")
    assert terminals(plant.graph()) == ["blind", "open"]


def against(shape, apart=0.0):
    """A pipe whose end at x = 1 lies against a body that begins there, and what its ends are taken for."""
    plant = Plant().pipe((0, 0, 0), (1, 0, 0))
    return terminals(plant.add(shapes.moved(shape, np.eye(3), (1.0 + apart, 0, 0)), STEEL, "plate").graph())


def slab(thick, side=0.6, aside=0.0):
    return shapes.box((thick, side, side), (thick / 2, aside, 0))


@pytest.mark.parametrize(
    ("shape", "end"),
    [
        (slab(0.006), "blind"),
        (slab(0.029), "blind"),
        (slab(0.031), "unknown"),  # a wall: the pipe may go on behind it
        (slab(0.006, side=0.12), "unknown"),  # no wider than a flange of a device
        (slab(0.006, side=3.0), "unknown"),  # cladding, or the side of a cabinet
        (slab(0.006, aside=0.3), "open"),  # covers half of the mouth
        (turned(shapes.tube(0.3, 0.02, 0.006), (0.003, 0, 0), (1, 0, 0)), "open"),  # has a hole
    ],
)
def test_a_plate_before_the_whole_mouth_of_a_pipe_closes_it(shape, end):
    assert against(shape) == sorted([end, "open"])


def test_a_plate_a_little_before_a_mouth_does_not_close_it():
    assert against(slab(0.006), apart=0.005) == ["open", "open"]


def test_a_plate_between_two_pipes_closes_neither_for_sure():
    plant = Plant().pipe((0, 0, 0), (1, 0, 0)).pipe((1.006, 0, 0), (2, 0, 0))
    graph = plant.add(shapes.moved(slab(0.006), np.eye(3), (1, 0, 0)), STEEL, "plate").graph(**{"relate.bridge": 0.0})
    assert terminals(graph) == ["open", "open", "unknown", "unknown"]


def test_a_lid_is_blind_without_its_name():
    plant = Plant().pipe((0, 0, 0), (1, 0, 0))
    plant.add(ring((1, 0, 0), (1, 0, 0)), PIPE, "flange").add(plate((1.02, 0, 0), (1, 0, 0)), PIPE, "flange")
    assert terminals(plant.graph()) == ["blind", "open"]


def test_supports_are_no_connections():
    plant = Plant().pipe((0, 0, 0), (2, 0, 0)).pipe((0, 0, -0.5), (2, 0, -0.5))
    plant.add(shapes.box((0.1, 0.1, 0.44), (1, 0, -0.25)), STEEL, "post")
    plant.add(turned(shapes.tube(R + 0.01, R, 0.03), (0.5, 0, 0), (1, 0, 0)), FASTENER, "clamp")
    plant.add(turned(shapes.tube(0.02, 0.017, 0.44), (1.5, 0, -0.25), (0, 0, 1)), STEEL, "column")
    graph = plant.graph()
    assert links(graph) == [("open", "open")] * 2
    assert len(systems(graph)) == 2


def test_pipes_that_cross_or_touch_side_to_side_are_not_connected():
    plant = Plant().pipe((0, 0, 0), (2, 0, 0)).pipe((1, -1, 2 * R), (1, 1, 2 * R)).pipe((0, 2 * R, 0), (2, 2 * R, 0))
    assert links(plant.graph()) == [("open", "open")] * 3


def test_a_pipe_that_pierces_another_is_not_connected():
    plant = Plant().pipe((0, 0, 0), (2, 0, 0)).pipe((1, -1, 0.01), (1, 1, 0.01))
    assert links(plant.graph()) == [("open", "open")] * 2


def tank(plant, radius=0.5, height=1.5):
    profile = [(0, -0.1), (0.3, -0.08), (radius, 0), (radius, height), (0.3, height + 0.08), (0, height + 0.1)]
    return plant.add(shapes.lathe(profile, 32), TANK, "tank")


@pytest.mark.parametrize("sink", [0.0, 0.02])
def test_a_tank_with_eight_nozzles_is_one_unit_with_eight_ports(sink):
    plant = tank(Plant())
    for k in range(8):
        d = np.array([np.cos(k * np.pi / 4), np.sin(k * np.pi / 4), 0.0])
        start = (0.498 - sink) * d + (0, 0, 0.2 + 0.15 * k)
        plant.pipe(start, start + 0.8 * d)
    graph = plant.graph()
    (unit,) = graph.units()
    assert links(graph) == [("T-001", "open")] * 8
    assert len(unit.ports) == 8
    assert {c.source_port for c in connections(graph)} == {f"N{k}" for k in range(1, 9)}


@pytest.mark.parametrize(("sides", "steps"), [(6, 3), (8, 4), (24, 8)])
def test_coarse_elbows_carry_the_line(sides, steps):
    plant = Plant().pipe((0, 0, 0), (0.924, 0, 0), bore=None, sides=sides)
    plant.add(bend((0, 0, 0), (1, 0, 0), (1, 1, 0), bore=None, steps=steps, sides=sides), PIPE, "elbow")
    plant.pipe((1, 0.076, 0), (1, 1, 0), bore=None, sides=sides)
    graph = plant.graph()
    assert links(graph) == [("open", "open")]
    assert connections(graph)[0].length == pytest.approx(2 * 0.924 + 0.076 * np.pi / 2, abs=0.01)


def test_pipes_that_meet_in_a_corner_without_elbow_are_joined():
    plant = Plant().pipe((0, 0, 0), (1, 0, 0), bore=None).pipe((1, 0, 0), (1, 1, 0), bore=None)
    assert links(plant.graph()) == [("open", "open")]


def test_a_spool_with_its_flanges_in_one_mesh():
    spool = merged(pipe((0, 0, 0), (1, 0, 0)), ring((0, 0, 0), (1, 0, 0)), ring((0.98, 0, 0), (1, 0, 0)))
    plant = Plant().add(spool, PIPE, "pipe")
    plant.add(valve_mesh((1.091, 0, 0)), VALVE, "valve").add(valve_mesh((-0.091, 0, 0)), VALVE, "valve")
    graph = plant.graph()
    assert links(graph) == [("V-001", "V-002")]
    assert connections(graph)[0].size == 50


def test_soup_is_as_good_as_a_mesh():
    plant = line_with_valve()
    plant.meshes = [tubes.soup(mesh) for mesh in plant.meshes]
    assert links(plant.graph()) == [("V-001", "open"), ("V-001", "open")]


def test_two_valves_flange_to_flange_stay_two():
    plant = Plant().add(valve_mesh((1, 0, 0)), VALVE, "valve").add(valve_mesh((1.178, 0, 0)), VALVE, "valve")
    plant.pipe((0, 0, 0), (0.911, 0, 0)).pipe((1.267, 0, 0), (2, 0, 0))
    assert links(plant.graph()) == [("V-001", "V-002"), ("V-001", "open"), ("V-002", "open")]


def valve_pieces(plant, middle, bonnet=(VALVE, "valve bonnet")):
    middle = np.asarray(middle, float)
    body = merged(
        turned(shapes.tube(0.05, R, 0.178), middle, (1, 0, 0)),
        *(turned(shapes.tube(0.075, R, 0.016), middle + s * 0.081 * np.eye(3)[0], (1, 0, 0)) for s in (-1, 1)),
    )
    plant.add(body, VALVE, "valve body")
    plant.add(turned(shapes.cylinder(0.04, 0.05), middle + 0.073 * np.eye(3)[2], (0, 0, 1)), *bonnet)
    plant.add(turned(shapes.cylinder(0.012, 0.1), middle + 0.148 * np.eye(3)[2], (0, 0, 1)), VALVE, "valve stem")
    plant.add(turned(shapes.tube(0.09, 0.012, 0.012), middle + 0.19 * np.eye(3)[2], (0, 0, 1)), VALVE, "handwheel")


def test_valves_of_several_parts_flange_to_flange_stay_two():
    plant = Plant()
    valve_pieces(plant, (1, 0, 0))
    valve_pieces(plant, (1.178, 0, 0))
    plant.pipe((0, 0, 0), (0.911, 0, 0)).pipe((1.267, 0, 0), (2, 0, 0))
    graph = plant.graph()
    assert links(graph) == [("V-001", "V-002"), ("V-001", "open"), ("V-002", "open")]
    assert [len(unit.parts) for unit in graph.units()] == [4, 4]


def test_a_valve_between_two_others_is_one_of_three():
    plant = Plant()
    for k in range(3):
        valve_pieces(plant, (1 + 0.178 * k, 0, 0))
    plant.pipe((0, 0, 0), (0.911, 0, 0)).pipe((1.445, 0, 0), (2, 0, 0))
    graph = plant.graph()
    assert links(graph) == [("V-001", "V-002"), ("V-001", "open"), ("V-002", "V-003"), ("V-003", "open")]
    assert [len(unit.parts) for unit in graph.units()] == [4, 4, 4]


def bare_valve(plant, middle, length, name):
    """A valve without an operator, in one mesh with its flanges."""
    ends = [turned(shapes.tube(0.075, R, 0.016), (middle + s * (length / 2 - 0.008), 0, 0), (1, 0, 0)) for s in (-1, 1)]
    body = merged(turned(shapes.tube(0.06, R, length), (middle, 0, 0), (1, 0, 0)), *ends)
    return plant.add(body, VALVE, name)


@pytest.mark.parametrize(("name", "units"), [("valve", 2), (None, 2), ("valve disc", 1)])
def test_a_whole_valve_without_an_operator_at_another_one_is_a_valve(name, units):
    plant = bare_valve(Plant(), 1.0, 0.24, name).add(valve_mesh((1.209, 0, 0)), VALVE, "valve")
    plant.pipe((0, 0, 0), (0.88, 0, 0)).pipe((1.298, 0, 0), (2, 0, 0))
    assert len(plant.graph().units()) == units


@pytest.mark.parametrize("name", ["valve body", "valve"])
def test_a_three_piece_valve_is_one(name):
    plant = Plant()
    for x, length, called in ((0.935, 0.048, name), (1.0, 0.082, "valve body"), (1.065, 0.048, name)):
        plant.add(turned(shapes.tube(0.06, R, length), (x, 0, 0), (1, 0, 0)), VALVE, called)
    plant.add(turned(shapes.cylinder(0.012, 0.08), (1.0, 0, 0.1), (0, 0, 1)), VALVE, "valve stem")
    plant.add(shapes.box((0.2, 0.03, 0.01), (1.06, 0, 0.145)), VALVE, "lever")
    plant.pipe((0, 0, 0), (0.911, 0, 0)).pipe((1.089, 0, 0), (2, 0, 0))
    graph = plant.graph()
    assert links(graph) == [("V-001", "open"), ("V-001", "open")]
    assert [len(unit.parts) for unit in graph.units()] == [5]


@pytest.mark.parametrize("label", [(FASTENER, "clamp"), (PIPE, "coupling"), (STEEL, "post"), (None, None)])
def test_a_mislabelled_bonnet_does_not_break_a_valve_in_two(label):
    plant = Plant()
    valve_pieces(plant, (1, 0, 0), label)
    plant.pipe((0, 0, 0), (0.911, 0, 0)).pipe((1.089, 0, 0), (2, 0, 0))
    graph = plant.graph()
    assert links(graph) == [("V-001", "open"), ("V-001", "open")]
    assert [len(unit.parts) for unit in graph.units()] == [4]


def test_a_two_piece_valve_is_one():
    plant = Plant()
    for x, length in ((0.97, 0.118), (1.059, 0.06)):
        plant.add(turned(shapes.tube(0.06, R, length), (x, 0, 0), (1, 0, 0)), VALVE, "valve body")
    plant.add(turned(shapes.cylinder(0.012, 0.08), (0.97, 0, 0.1), (0, 0, 1)), VALVE, "valve stem")
    plant.add(shapes.box((0.2, 0.03, 0.01), (1.03, 0, 0.145)), VALVE, "lever")
    plant.pipe((0, 0, 0), (0.911, 0, 0)).pipe((1.089, 0, 0), (2, 0, 0))
    graph = plant.graph()
    assert links(graph) == [("V-001", "open"), ("V-001", "open")]
    assert graph.units()[0].kind == "ball valve"


def test_a_lever_that_rests_on_the_other_half_of_a_body_makes_no_second_valve():
    plant = Plant()
    for x in (0.9555, 1.0445):
        plant.add(turned(shapes.tube(0.06, R, 0.089), (x, 0, 0), (1, 0, 0)), VALVE, "valve body")
    plant.add(shapes.box((0.03, 0.03, 0.12), (1.03, 0, 0.1)), VALVE, "valve stem")
    lever = merged(shapes.box((0.2, 0.03, 0.01), (0.96, 0, 0.165)), shapes.box((0.03, 0.03, 0.1), (0.92, 0, 0.11)))
    plant.add(lever, VALVE, "lever")
    plant.pipe((0, 0, 0), (0.911, 0, 0)).pipe((1.089, 0, 0), (2, 0, 0))
    assert links(plant.graph()) == [("V-001", "open"), ("V-001", "open")]


def test_valves_whose_wheels_touch_stay_two():
    plant = Plant()
    for y in (0.0, 0.175):
        plant.add(valve_mesh((1, y, 0)), VALVE, "valve")
        plant.pipe((0, y, 0), (0.911, y, 0)).pipe((1.089, y, 0), (2, y, 0))
    plant.add(turned(shapes.cylinder(0.02, 0.02), (1, 0.0875, 0.19), (0, 1, 0)), VALVE, "valve")
    graph = plant.graph()
    assert links(graph) == [("V-001", "open")] * 2 + [("V-002", "open")] * 2


@pytest.mark.parametrize("label", [(STEEL, "beam"), (None, None), (FASTENER, "clamp")])
def test_a_pipe_with_another_label_that_continues_the_line_is_pipe(label):
    plant = Plant().pipe((0, 0, 0), (1, 0, 0)).add(pipe((1, 0, 0), (2, 0, 0)), *label).pipe((2, 0, 0), (3, 0, 0))
    tapped(plant, 0.5)
    tapped(plant, 2.5)
    graph = plant.graph()
    assert links(graph) == [("G-001", "G-002"), ("G-001", "open"), ("G-002", "open")]
    assert min(c.confidence for c in connections(graph)) < 0.9


def test_an_elbow_that_is_called_a_valve_is_no_unit():
    plant = Plant().pipe((0, 0, 0), (0.924, 0, 0)).pipe((1, 0.076, 0), (1, 1, 0))
    plant.add(bend((0, 0, 0), (1, 0, 0), (1, 1, 0)), VALVE, "valve")
    graph = plant.graph()
    assert links(graph) == [("open", "open")]
    assert graph.units() == []


def test_sizes_change_at_a_reducer():
    plant = Plant().pipe((0, 0, 0), (1, 0, 0)).pipe((1.1, 0, 0), (3, 0, 0), radius=0.0241, bore=0.0204)
    plant.add(
        tubes.pipe([(1, 0, 0), (1.02, 0, 0), (1.08, 0, 0), (1.1, 0, 0)], [R, R, 0.0241, 0.0241], 24), PIPE, "reducer"
    )
    (link,) = connections(plant.graph())
    assert link.sizes in ((50, 40), (40, 50))
    assert link.size == 40
    assert link.length == pytest.approx(3, abs=0.001)


def test_a_gauge_with_a_bare_stem_between_two_pipes_hangs_on_the_nearer():
    plant = Plant().pipe((0, 0, 0), (2, 0, 0)).pipe((0, 0.16, 0.13), (2, 0.16, 0.13))
    tapped(plant, 1.0, outlet=False)
    assert ("G-001", "open") in links(plant.graph())


def test_a_branched_line_in_one_mesh():
    plant = Plant().add(tubes.tee(R, R, 1.0, 1.0, 24), PIPE, "pipe")
    tapped(plant, 0.5)
    assert links(plant.graph()) == [("G-001", "J"), ("G-001", "open"), ("J", "open"), ("J", "open")]


def test_the_order_of_meshes_and_rigid_motion_do_not_matter():
    plant = line_with_valve()
    tapped(plant, 0.3)
    tapped(plant, 1.7)
    wanted = links(plant.graph())
    turn = tubes._turn(np.array([1.0, 0, 0]), np.array([0.36, 0.48, 0.8]))
    order = np.random.default_rng(1).permutation(len(plant.meshes)).tolist()
    graph = plant.graph(order, lambda mesh: shapes.moved(mesh, turn, (10, -3, 2)))
    assert len(links(graph)) == len(wanted)
    assert sorted(round(c.length, 5) for c in connections(graph)) == sorted(
        round(c.length, 5) for c in connections(plant.graph())
    )


def test_small_moves_and_new_brackets_do_not_renumber_the_plant():
    plant = Plant()
    for y in (0, 1, 2):
        plant.add(valve_mesh((1, y, 0)), VALVE, "valve")
        plant.pipe((0, y, 0), (0.911, y, 0)).pipe((1.089, y, 0), (2, y, 0))
    before = {unit.tag: unit.centroid for unit in plant.graph().units()}
    plant.add(shapes.box((0.1, 0.1, 0.1), (1, 0, -0.3)), STEEL, "plate")
    shaken = plant.graph(
        moved=lambda mesh: shapes.moved(mesh, translation=np.random.default_rng(3).uniform(-2e-3, 2e-3, 3))
    )
    after = {unit.tag: unit.centroid for unit in shaken.units()}
    assert before.keys() == after.keys()
    assert all(np.allclose(before[tag], after[tag], atol=0.01) for tag in before)


def test_the_method_of_the_paper_has_its_units_and_no_lines():
    graph = line_with_valve().graph(method="paper")
    assert [unit.tag for unit in graph.units()] == ["V-001"]
    assert connections(graph) == []


def test_a_relief_valve_on_a_branch_outlet_stands_in_the_run():
    plant = Plant().pipe((0, 0, 0), (3, 0, 0))
    tapped(plant, 1.0)
    plant.add(turned(shapes.cylinder(0.011, 0.03), (2, 0, R + 0.014), (0, 0, 1)), PIPE, "branch outlet")
    plant.add(turned(shapes.cylinder(0.02, 0.1), (2, 0, R + 0.079), (0, 0, 1)), VALVE, "valve")
    assert links(plant.graph()) == [("G-001", "V-001"), ("G-001", "open"), ("V-001", "open")]


def test_copies_in_one_place_are_there_once():
    plant = line_with_valve()
    plant.add(plant.meshes[2], PIPE, "pipe").add(plant.meshes[1], PIPE, "flange")
    assert links(plant.graph()) == [("V-001", "open"), ("V-001", "open")]


def test_meshes_turned_inside_out_are_joined_too():
    plant = line_with_valve()
    plant.meshes = [(vertices, faces[:, ::-1]) for vertices, faces in plant.meshes]
    assert links(plant.graph()) == [("V-001", "open"), ("V-001", "open")]


def test_bolts_in_one_mesh_with_their_flange_do_not_hide_its_faces():
    plant = line_with_valve()
    for k in (1, 3):
        (x, y, z), sign = plant.meshes[k][0].mean(axis=0), (-1 if k == 1 else 1)
        bolts = [
            turned(shapes.cylinder(0.008, 0.06), (x, y + 0.06 * np.cos(a), z + 0.06 * np.sin(a)), (sign, 0, 0))
            for a in np.arange(4) * np.pi / 2 + 0.3
        ]
        plant.meshes[k] = merged(plant.meshes[k], *bolts)
    assert links(plant.graph()) == [("V-001", "open"), ("V-001", "open")]


def test_a_wheel_that_sits_on_no_valve_is_no_unit_and_is_told():
    plant = Plant().pipe((0, 0, 0), (2, 0, 0))
    plant.add(turned(shapes.tube(0.1, 0.08, 0.02), (1, 0, R + 0.012), (0, 0, 1)), VALVE, "handwheel")
    graph = plant.graph()
    assert not graph.units()
    assert [d.code for d in graph.diagnostics if d.code == "loose-operator"] == ["loose-operator"]


def test_a_wheel_on_a_valve_belongs_to_it():
    plant = Plant().pipe((0, 0, 0), (1, 0, 0))
    plant.add(valve_mesh((1.089, 0, 0)), VALVE, "valve body")
    plant.pipe((1.178, 0, 0), (2, 0, 0))
    top = plant.graph().units("valve")[0].aabb[1][2]
    plant.add(turned(shapes.tube(0.1, 0.08, 0.02), (1.089, 0, top + 0.01), (0, 0, 1)), VALVE, "handwheel")
    [valve] = plant.graph().units("valve")
    assert len(valve.parts) == 2
