"""What shows a direction, and what is too weak to show one: each side of each limit."""

from dataclasses import replace

import numpy as np
import pytest

import shapes
from cadgraph.stages.relate import flow_sources
from cadgraph.stages.relate.flow_sources import SOURCES, SURE, Sight
from cadgraph.stages.relate.flow_spread import around
from flows import name_of, network, opening, parts_of
from piping import merged, turned

ORIGIN = (0.0, 0.0, 0.0)
UP, DOWN, X, BACK, Y = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
MOTOR = turned(shapes.cylinder(0.1, 0.8), ORIGIN, X)


def told(source, found, parts, names):
    """What a source says, as ``"T1 V1"``, with how sure it is."""
    said = {}
    for one in source(Sight(found, parts, names, around(found))):
        link = found.links[one.link]
        ends = [name_of(found, link.source), name_of(found, link.target)]
        said[" ".join(ends if one.forward else ends[::-1])] = one.confidence
    return said


def pump(first, second, mesh=MOTOR, sizes=((), ())):
    found = network("P1 X1", "P1 X2", openings={"P1": [first, second]}, parts={"P1": (0,)})
    links = [replace(link, sizes=own) for link, own in zip(found.links, sizes, strict=True)]
    found = replace(found, links=tuple(links))
    return told(flow_sources.pumps, found, parts_of(mesh), ["pump"])


def test_every_kind_of_evidence_has_its_confidence_and_every_source_a_place():
    assert len(SOURCES) == 6
    assert all(0.65 <= sure <= 1.0 for sure in SURE.values())


# --- pumps ---


@pytest.mark.parametrize(
    ("suction", "discharge", "sure"),
    [
        (0.1, 0.1 / 1.13, SURE["pump, shaft and widths"]),
        (0.1, 0.1 / 1.11, SURE["pump, shaft"]),
        (0.1 / 1.11, 0.1, SURE["pump, shaft"]),
        (0.1 / 1.13, 0.1, None),
    ],
)
def test_a_pump_draws_along_its_shaft_unless_that_nozzle_is_narrower(suction, discharge, sure):
    said = pump(opening((0.4, 0, 0), X, suction), opening((0.2, 0, 0.2), UP, discharge))
    assert said == ({} if sure is None else {"X1 P1": sure, "P1 X2": sure})


@pytest.mark.parametrize(("reach", "shown"), [(0.39, True), (0.41, False)])
def test_the_nozzle_along_the_shaft_of_a_long_pump_is_not_its_suction(reach, shown):
    said = pump(opening((0.4, 0, 0), X, 0.1), opening((0.4 - reach, 0, 0.2), UP, 0.1))
    assert bool(said) is shown


@pytest.mark.parametrize(("tilt", "shown"), [(25, True), (27, False)])
def test_a_nozzle_lies_along_the_shaft_within_26_degrees(tilt, shown):
    way = (float(np.cos(np.radians(tilt))), float(np.sin(np.radians(tilt))), 0.0)
    assert bool(pump(opening((0.4, 0, 0), way, 0.1), opening((0.3, 0, 0.2), UP, 0.1))) is shown


@pytest.mark.parametrize(("length", "shown"), [(0.8, True), (0.2, False)])
def test_a_body_as_long_as_wide_has_no_shaft(length, shown):
    mesh = turned(shapes.cylinder(0.12, length), ORIGIN, X)
    assert bool(pump(opening((0.2, 0, 0), X, 0.1), opening((0.1, 0, 0.2), UP, 0.1), mesh)) is shown


def test_in_line_nozzles_say_nothing_but_by_their_widths():
    upright = turned(shapes.cylinder(0.1, 0.8), ORIGIN, UP)
    assert pump(opening((-0.2, 0, 0), BACK), opening((0.2, 0, 0), X), upright) == {}
    said = pump(opening((-0.2, 0, 0), BACK, 0.08), opening((0.2, 0, 0), X, 0.1), upright)
    assert said == {"P1 X1": SURE["pump, widths"], "X2 P1": SURE["pump, widths"]}


@pytest.mark.parametrize(("sizes", "told"), [(((50,), (50,)), 0), (((50,), (80, 50)), 2), (((50,), ()), 2)])
def test_a_gasket_at_one_nozzle_makes_it_no_wider_where_both_lines_are_of_one_size(sizes, told):
    upright = turned(shapes.cylinder(0.1, 0.8), ORIGIN, UP)
    said = pump(opening((-0.2, 0, 0), BACK, 0.06), opening((0.2, 0, 0), X, 0.11), upright, sizes)
    assert len(said) == told


@pytest.mark.parametrize("sizes", [((), ()), ((80,), (80,))])
def test_nozzles_far_apart_along_the_shaft_say_nothing_whatever_the_size_of_their_lines(sizes):
    near, far = (opening((x, 0, 0.2), UP, 0.08) for x in (0.3, -0.6))
    assert pump(opening((0.4, 0, 0), X, 0.08), near, sizes=sizes)
    assert pump(opening((0.4, 0, 0), X, 0.08), far, sizes=sizes) == {}


def test_a_wider_level_nozzle_draws_and_one_that_looks_up_delivers():
    ball = shapes.sphere(0.2)
    said = pump(opening((0.2, 0, 0), X, 0.1), opening((0, 0, 0.2), UP, 0.08), ball)
    assert set(said.values()) == {SURE["pump, up and widths"]}
    assert pump(opening((0.2, 0, 0), X, 0.08), opening((0, 0, 0.2), UP, 0.1), ball) == {}


def test_a_nozzle_that_looks_up_along_what_is_long_upright_is_no_suction():
    tall = turned(shapes.cylinder(0.1, 0.8), ORIGIN, UP)
    assert pump(opening((0, 0, 0.4), UP), opening((0.2, 0, 0.2), X), tall) == {}
    below = pump(opening((0, 0, -0.4), DOWN), opening((0.2, 0, -0.2), X), tall)
    assert below == {"X1 P1": SURE["pump, shaft"], "P1 X2": SURE["pump, shaft"]}


def test_a_pump_in_one_mesh_with_its_base_draws_along_its_shaft():
    mesh = merged(
        MOTOR, shapes.box((1.0, 0.3, 0.1), (0.1, 0, -0.2)), turned(shapes.cylinder(0.15, 0.1), (0.45, 0, 0), X)
    )
    said = pump(opening((0.55, 0, 0), X, 0.08), opening((0.45, 0, 0.25), UP, 0.065), mesh)
    assert said == {"X1 P1": SURE["pump, shaft and widths"], "P1 X2": SURE["pump, shaft and widths"]}


# --- check valves ---

BODY = merged(
    turned(shapes.cylinder(0.05, 0.3), ORIGIN, X),
    *(turned(shapes.cylinder(0.08, 0.02), (end, 0, 0), X) for end in (-0.14, 0.14)),
)


def check(meshes, names, kind="check valve"):
    ends = [opening((-0.15, 0, 0), BACK), opening((0.15, 0, 0), X)]
    found = network("X1 V1 X2", openings={"V1": ends}, kinds={"V1": kind}, parts={"V1": tuple(range(len(meshes)))})
    return told(flow_sources.check_valves, found, parts_of(*meshes), names)


def neck(degrees, reach=0.26):
    way = (float(np.sin(np.radians(degrees))), 0.0, float(np.cos(np.radians(degrees))))
    return turned(shapes.cylinder(0.045, reach), np.multiply(way, reach / 2), way)


@pytest.mark.parametrize(
    ("degrees", "says"),
    [(0, None), (9, None), (15, None), (25, "X1 V1"), (45, "X1 V1"), (-45, "V1 X1"), (-15, None), (70, None)],
)
def test_a_check_valve_s_neck_leans_downstream(degrees, says):
    said = check([merged(BODY, neck(degrees))], ["valve"])
    assert (says in said) if says else not said
    assert set(said.values()) <= {SURE["check valve, leaning neck"]}


def test_other_valves_with_leaning_necks_say_nothing():
    assert check([merged(BODY, neck(45))], ["valve"], "globe valve") == {}


def test_a_mirrored_neck_says_the_opposite_and_a_lever_nothing():
    lever = turned(shapes.cylinder(0.01, 0.4), (0.2, 0, 0.2), (1, 0, 0.2))
    assert check([BODY, lever], ["valve body", "lever"]) == {}


@pytest.mark.parametrize(("place", "says"), [(-0.02, "X1 V1"), (-0.017, None), (0.017, None), (0.02, "V1 X1")])
def test_a_flap_hangs_before_the_middle_of_its_cover(place, says):
    cover = turned(shapes.cylinder(0.06, 0.02), (0, 0, 0.1), UP)
    shaft = turned(shapes.cylinder(0.01, 0.15), (place, 0, 0.06), Y)
    said = check([BODY, cover, shaft], ["valve body", "valve bonnet", "valve stem"])
    assert (said == {}) if says is None else (says in said)


def test_a_stem_along_the_line_is_no_hinge():
    cover = turned(shapes.cylinder(0.06, 0.02), (0, 0, 0.1), UP)
    stem = turned(shapes.cylinder(0.01, 0.15), (-0.05, 0, 0), X)
    assert check([BODY, cover, stem], ["valve body", "valve bonnet", "valve stem"]) == {}


@pytest.mark.parametrize(("place", "says"), [(0.017, "X1 V1"), (0.013, None), (-0.017, "V1 X1")])
def test_a_spring_stands_behind_its_disc(place, says):
    disc = turned(shapes.cylinder(0.04, 0.01), ORIGIN, X)
    spring = turned(shapes.cylinder(0.015, 0.05), (place, 0, 0), X)
    said = check([BODY, disc, spring], ["valve body", "valve disc", "valve stem"])
    assert (said == {}) if says is None else (says in said)


# --- relief valves ---


def test_flow_comes_into_a_relief_valve_at_the_end_of_a_line():
    found = network("T1 V1", openings={"V1": [opening(ORIGIN, DOWN)]}, kinds={"V1": "relief valve"})
    assert told(flow_sources.relief_valves, found, parts_of(BODY), [None]) == {"T1 V1": SURE["relief valve, inlet"]}


def test_a_relief_valve_on_a_tap_says_nothing_of_the_run_that_it_stands_in():
    found = network("X1 V1 X2", openings={"V1": [opening(ORIGIN, DOWN)]}, kinds={"V1": "relief valve"})
    assert told(flow_sources.relief_valves, found, parts_of(BODY), [None]) == {}


@pytest.mark.parametrize(("tall", "shown"), [(0.23, False), (0.25, True), (0.6, True)])
def test_a_relief_valve_s_spring_stands_over_its_inlet(tall, shown):
    # Inlet at z = 0, outlet aside at z = 0.2, the spring up from there.
    mesh = merged(turned(shapes.cylinder(0.05, 0.2 + tall), (0, 0, 0.1 + tall / 2), UP),
                  turned(shapes.cylinder(0.05, 0.2), (0.1, 0, 0.2), X))  # fmt: skip
    ends = [opening((0.2, 0, 0.2), X), opening(ORIGIN, DOWN)]
    found = network("V1 X1", "V1 X2", openings={"V1": ends}, kinds={"V1": "relief valve"}, parts={"V1": (0,)})
    said = told(flow_sources.relief_valves, found, parts_of(mesh), [None])
    sure = SURE["relief valve, inlet and outlet"]
    assert said == ({"V1 X1": sure, "X2 V1": sure} if shown else {})


# --- strainers ---


@pytest.mark.parametrize(("degrees", "says"), [(0, None), (45, "T1 T2"), (-45, "T2 T1")])
def test_a_strainer_s_basket_leans_downstream(degrees, says):
    mesh = merged(BODY, neck(degrees))
    found = network("T1 T2", places={"T1": (-1.0, 0.0, 0.0), "T2": (1.0, 0.0, 0.0)})
    link = found.links[0]
    found = type(found)(found.units, found.places, (type(link)(**{**link.__dict__, "via": (0,)}),))
    said = told(flow_sources.strainers, found, parts_of(mesh), ["strainer"])
    assert said == ({says: SURE["strainer, leaning basket"]} if says else {})
    assert told(flow_sources.strainers, found, parts_of(mesh), ["tee"]) == {}


# --- tanks ---


def tank(nozzle, way, *ends, valves="V1"):
    """A tank from 0 to 1 m with one nozzle, and a line from there past corners."""
    where = {"T1": nozzle, "V1": nozzle, "X1": ends[-1]}
    found = network(f"T1 {valves} X1", openings={"T1": [opening(nozzle, way)]}, parts={"T1": (0,)}, places=where)
    last = found.links[-1]
    path = (ends[-2], ends[-1]) if len(ends) > 1 else (nozzle, ends[-1])
    path = path if name_of(found, last.target) == "X1" else path[::-1]
    found = type(found)(found.units, found.places, (*found.links[:-1], type(last)(**{**last.__dict__, "path": path})))
    return told(flow_sources.tanks, found, parts_of(shapes.box((1, 1, 1), (0, 0, 0.5))), ["tank"])


@pytest.mark.parametrize(
    ("height", "end", "sure"),
    [
        (0.34, 0.0, "tank, drain"),
        (0.36, 0.0, None),
        (0.2, 0.09, "tank, drain"),
        (0.2, 0.11, "tank, outlet"),
        (0.2, 0.29, "tank, outlet"),
        (0.2, 0.31, None),
    ],
)
def test_a_low_nozzle_with_a_lower_open_end_drains_a_tank(height, end, sure):
    said = tank((0.5, 0.0, height), X, (1.0, 0.0, end + 0.5), (1.0, 0.0, end))
    assert said == ({} if sure is None else {"T1 V1": SURE[sure]})


def test_an_end_that_looks_sideways_is_weaker_and_a_nozzle_that_looks_up_none():
    assert tank((0.5, 0.0, 0.2), X, (1.0, 0.0, 0.0)) == {"T1 V1": SURE["tank, outlet"]}
    assert tank((0.5, 0.0, 0.2), UP, (1.0, 0.0, 0.5), (1.0, 0.0, 0.0)) == {}


@pytest.mark.parametrize(
    ("height", "end", "valves", "shown"),
    [
        (0.66, 0.1, "", True),
        (0.64, 0.1, "", False),
        (0.9, 0.41, "", False),
        (0.9, 0.39, "", True),
        (0.9, 0.1, "V1", False),
    ],
)
def test_a_high_nozzle_without_a_valve_overflows_far_below(height, end, valves, shown):
    said = tank((0.5, 0.0, height), X, (1.0, 0.0, height), (1.0, 0.0, end), valves=valves)
    assert list(said.values()) == ([SURE["tank, overflow"]] if shown else [])


def test_a_branch_on_the_way_leaves_a_tank_s_outlet_open():
    found = network("T1 J1 X1", "J1 X2", openings={"T1": [opening((0.5, 0, 0.1), X)]}, parts={"T1": (0,)})
    assert told(flow_sources.tanks, found, parts_of(shapes.box((1, 1, 1), (0, 0, 0.5))), ["tank"]) == {}


# --- practice ---


@pytest.mark.parametrize(
    ("line", "kinds", "shown"),
    [
        ("P1 V1 X2", {"V1": "check valve"}, True),
        ("P1 V2 V1 X2", {"V1": "check valve"}, True),
        ("P1 V2 V3 V1 X2", {"V1": "check valve"}, False),
        ("P1 V1 X2", {}, False),
        ("P1 J1 V1 X2", {"V1": "check valve"}, False),
    ],
)
def test_a_check_valve_follows_a_pump(line, kinds, shown):
    upright = turned(shapes.cylinder(0.1, 0.8), ORIGIN, UP)
    ends = [opening((-0.2, 0, 0), BACK), opening((0.2, 0, 0), X)]
    more = ("J1 B1",) if "J1" in line else ()
    found = network("X1 P1", line, *more, openings={"P1": ends}, kinds=kinds, parts={"P1": (0,)})
    said = told(flow_sources.checks_at_pumps, found, parts_of(upright), ["pump"])
    assert ("X1 P1" in said) is shown
    assert set(said.values()) <= {SURE["check valve at a pump"]}


def test_check_valves_on_both_sides_of_a_pump_say_nothing():
    upright = turned(shapes.cylinder(0.1, 0.8), ORIGIN, UP)
    ends = [opening((-0.2, 0, 0), BACK), opening((0.2, 0, 0), X)]
    kinds = {"V1": "check valve", "V2": "check valve"}
    found = network("X1 V1 P1", "P1 V2 X2", openings={"P1": ends}, kinds=kinds, parts={"P1": (0,)})
    assert told(flow_sources.checks_at_pumps, found, parts_of(upright), ["pump"]) == {}
