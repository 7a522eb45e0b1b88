"""Kinds of valves by what turns them, their length and their place: stated where sure, guessed where open."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

import shapes
from cadgraph.model.parts import Network, UnitParts
from cadgraph.model.standards import lengths_of
from cadgraph.stages.relate import valve_kind
from cadgraph.stages.relate.body_shape import line_through, surface_about
from cadgraph.stages.relate.kind import name_kinds
from cadgraph.stages.relate.operator_shape import standing_on
from cadgraph.stages.relate.valve_kind import SURE_FROM, valve_kinds
from cadplants.parts.valve import VALVES
from cadplants.styles.modeling_style import STYLES
from flows import network, opening, parts_of
from piping import merged, turned

X, UP = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)


def ends(length):
    return (opening((0.0, 0.0, 0.0), (-1.0, 0.0, 0.0)), opening((length, 0.0, 0.0), X))


def kinds(meshes, names, length, size):
    unit = UnitParts("valve", "V-001", tuple(range(len(meshes))), None, ends(length))
    return valve_kinds(unit, names, [size], parts_of(*meshes))


def body(length, outer=0.08):
    return merged(
        turned(shapes.cylinder(0.04, length), (length / 2, 0, 0), X),
        *(turned(shapes.cylinder(outer, 0.02), (end, 0, 0), X) for end in (0.01, length - 0.01)),
    )


def operator(name, length, wheel=0.1):
    if name == "handwheel":
        return turned(shapes.tube(wheel, 0.85 * wheel, 0.015), (length / 2, 0, 0.25), UP)
    return shapes.box((0.2, 0.02, 0.01), (length / 2 + 0.08, 0, 0.12))


@pytest.mark.parametrize(
    ("name", "length", "size", "kind"),
    [
        ("handwheel", 0.178, 50, "gate valve"),
        ("handwheel", 0.203, 50, "globe valve"),
        ("handwheel", 0.150, 50, "gate valve"),
        ("handwheel", 0.350, 100, "globe valve"),
        ("lever", 0.178, 50, "ball valve"),
        ("lever", 0.150, 50, "ball valve"),
        ("lever", 0.043, 50, "butterfly valve"),
    ],
)
def test_lengths_of_both_worlds_tell_kinds_with_the_same_operator_apart(name, length, size, kind):
    found = kinds([body(length), operator(name, length)], ["valve body", name], length, size)
    assert found[0][0] == kind
    assert found[0][1] >= SURE_FROM


def test_what_holds_a_disc_is_no_ball_valve_however_long():
    def found(*names):
        meshes = [body(0.292), operator("lever", 0.292), turned(shapes.cylinder(0.09, 0.02), (0.146, 0, 0), X)]
        return dict(kinds(meshes[: len(names)], list(names), 0.292, 200))

    assert found("valve body", "lever")["ball valve"] > SURE_FROM
    with_disc = found("valve body", "lever", "valve disc")
    assert with_disc["ball valve"] < 0.5 < with_disc["butterfly valve"] + with_disc["check valve"]


def test_gate_and_globe_valves_of_one_length_stay_open_with_both_as_guesses():
    found = kinds([body(0.165), operator("handwheel", 0.165)], ["valve body", "handwheel"], 0.165, 40)
    assert found[0][1] < SURE_FROM
    assert {kind for kind, _ in found[:2]} == {"gate valve", "globe valve"}


@pytest.mark.parametrize(("off", "stated"), [(0.009, True), (0.011, False)])
def test_a_length_is_one_of_a_table_within_10_mm(off, stated):
    meshes = [body(0.33 - off), operator("handwheel", 0.33, wheel=0.2)]
    found = kinds(meshes, ["valve body", "handwheel"], 0.33 - off, 250)
    assert (found[0][1] >= SURE_FROM) is stated


@pytest.mark.parametrize(("wheel", "stated"), [(0.06, True), (0.035, False)])
def test_a_small_wheel_may_set_a_spring(wheel, stated):
    found = kinds([body(0.203), operator("handwheel", 0.203, wheel)], ["valve body", "handwheel"], 0.203, 50)
    assert found[0][0] == "globe valve"
    assert (found[0][1] >= SURE_FROM) is stated


@pytest.mark.parametrize(("wheel", "stated"), [(0.16, True), (0.14, False)])
def test_wheels_of_large_valves_are_smaller_for_their_size(wheel, stated):
    found = kinds([body(0.33), operator("handwheel", 0.33, wheel)], ["valve body", "handwheel"], 0.33, 250)
    assert (found[0][1] >= SURE_FROM) is stated


def test_a_housing_on_a_housing_under_a_wheel_may_hold_a_spring():
    diaphragm = turned(shapes.cylinder(0.07, 0.02), (0.1, 0, 0.09), UP)
    housing = turned(shapes.cylinder(0.035, 0.1), (0.1, 0, 0.15), UP)
    names = ["valve body", "handwheel", "valve bonnet", "valve bonnet"]
    meshes = [body(0.203), operator("handwheel", 0.203, wheel=0.06), diaphragm, housing]
    assert kinds(meshes[:3], names[:3], 0.203, 50)[0][1] >= SURE_FROM
    assert kinds(meshes, names, 0.203, 50)[0][1] < SURE_FROM


def test_a_cover_that_nothing_turns_is_a_check_valve_but_not_beside_a_stem():
    cover = turned(shapes.cylinder(0.05, 0.02), (0.1, 0, 0.11), UP)
    stem = turned(shapes.cylinder(0.008, 0.1), (0.1, 0, 0.16), UP)
    assert kinds([body(0.203), cover], ["valve body", "valve bonnet"], 0.203, 50)[0][0] == "check valve"
    found = kinds([body(0.203), cover, stem], ["valve body", "valve bonnet", "valve stem"], 0.203, 50)
    assert not found or found[0][1] < SURE_FROM


def test_a_lever_over_a_yoke_is_no_ball_valve():
    yoke = turned(shapes.tube(0.04, 0.03, 0.1), (0.089, 0, 0.13), UP)
    found = kinds([body(0.178), yoke, operator("lever", 0.178)], ["valve body", "yoke", "lever"], 0.178, 50)
    assert not found or found[0][1] < SURE_FROM


def test_a_lever_with_a_weight_is_no_ball_valve():
    arm, weight = operator("lever", 0.178), turned(shapes.cylinder(0.04, 0.05), (0.25, 0, 0.12), X)
    assert kinds([body(0.178), arm], ["valve body", "lever"], 0.178, 50)[0][1] >= SURE_FROM
    found = kinds([body(0.178), arm, weight], ["valve body", "lever", "lever"], 0.178, 50)
    assert not found or found[0][1] < SURE_FROM


@pytest.mark.parametrize(("aside", "kind"), [(0.0, "ball valve"), (0.004, "ball valve"), (0.02, "check valve")])
def test_a_lever_on_a_shaft_above_the_bore_is_the_arm_of_a_check_valve(aside, kind):
    # The shaft lies level, out of the side of the body, and the lever beside it.
    shaft = turned(shapes.cylinder(0.01, 0.12), (0, 0.07, aside), (0, 1, 0))
    lever = shapes.box((0.02, 0.012, 0.24), (0, 0.125, 0.1 + aside))
    found = kinds([body(0.178), shaft, lever], ["valve body", "valve stem", "lever"], 0.178, 50)
    assert found[0][0] == kind
    assert (found[0][1] >= SURE_FROM) == (kind == "ball valve")


def test_a_lever_over_a_length_of_check_valves_alone_may_be_the_arm_of_a_weight():
    meshes = [body(0.356, 0.14), operator("lever", 0.356)]
    found = kinds(meshes, ["valve body", "lever"], 0.356, 150)
    assert found[0][1] < SURE_FROM
    assert found[1][0] == "check valve"


def test_a_bracket_under_an_actuator_says_nothing():
    actuator = turned(shapes.box((0.1, 0.06, 0.06)), (0.089, 0, 0.2), UP)
    bracket = turned(shapes.box((0.05, 0.05, 0.08)), (0.089, 0, 0.12), UP)
    asked = [
        kinds([body(0.178), bracket, actuator], ["valve body", name, "actuator"], 0.178, 50)
        for name in ("yoke", "position indicator")
    ]
    assert asked[0] == asked[1]


@pytest.mark.parametrize(("length", "stated"), [(0.178, True), (0.132, False)])
def test_a_driven_ball_as_long_as_no_ball_valve_may_be_a_control_valve(length, stated):
    ball = turned(shapes.sphere(0.03), (length / 2, 0, 0), X)
    actuator = turned(shapes.box((0.1, 0.06, 0.06)), (length / 2, 0, 0.2), UP)
    found = kinds([body(length), ball, actuator], ["valve body", "valve ball", "actuator"], length, 50)
    assert found[0][0] == "ball valve"
    assert (found[0][1] >= SURE_FROM) is stated
    assert stated or found[1][0] == "control valve"


def test_other_names_sizes_and_openings_of_the_same_parts_are_looked_at_anew():
    parts = parts_of(body(0.178), operator("lever", 0.178))
    unit = UnitParts("valve", "V-001", (0, 1), None, ends(0.178))
    asked = [
        (unit, ["valve body", "lever"], [50]),
        (unit, ["valve body", "handwheel"], [50]),
        (unit, ["valve body", "lever"], [200]),
        (replace(unit, openings=ends(0.178)[:1]), ["valve body", "lever"], [50]),
    ]
    found = [valve_kinds(*one, parts) for one in asked]
    assert len(set(found)) == len(asked)
    assert [valve_kinds(*one, parts) for one in asked] == found


def test_a_bare_barrel_says_nothing():
    assert kinds([body(0.178)], ["valve"], 0.178, 50) == ()


@pytest.mark.parametrize(("share", "wafer"), [(0.79, True), (0.81, False)])
def test_a_body_without_flanges_is_shorter_than_its_size(share, wafer):
    length = share * 0.4
    assert valve_kind._is_wafer(length, 400) is wafer


@pytest.mark.parametrize(("length", "wafer"), [(0.038, True), (0.046, True), (0.0499, False)])
def test_small_wafers_are_known_by_the_tables(length, wafer):
    assert valve_kind._is_wafer(length, 50) is wafer


def test_confidences_add_up_with_what_has_no_rule():
    found = kinds([body(0.178), operator("lever", 0.178)], ["valve body", "lever"], 0.178, 50)
    assert 0.9 < sum(sure for _, sure in found) < 1.0


@pytest.mark.parametrize("tables", [valve_kind._TURNED, valve_kind._LENGTH, valve_kind._PLACE, valve_kind._HOLDS_YOKE])
def test_every_kind_has_its_row_in_every_table(tables):
    assert set(tables) == set(valve_kind._PRIOR)
    assert sum(valve_kind._PRIOR.values()) == pytest.approx(1.0, abs=0.1)


def relief(tall, snout=0.08, wide=0.03):
    """A housing on z = 0 with a snout aside low on it, and a lever on top."""
    return merged(
        turned(shapes.cylinder(0.02, 0.04), (0, 0, 0.02), UP),
        turned(shapes.cylinder(wide, tall), (0, 0, 0.04 + tall / 2), UP),
        turned(shapes.cylinder(0.02, snout), (snout / 2, 0, 0.07), X),
    )


@pytest.mark.parametrize(
    ("tall", "snout", "sprung"), [(0.25, 0.08, True), (0.25, 0.03, False), (0.25, 0.12, False), (0.06, 0.08, False)]
)
def test_a_relief_valve_is_a_slender_housing_over_a_snout(tall, snout, sprung):
    lever = shapes.box((0.1, 0.01, 0.01), (0.03, 0, 0.32))
    unit = UnitParts("valve", "V-001", (0, 1), None, (opening((0.0, 0.0, 0.0), (0.0, 0.0, -1.0)),))
    found = valve_kinds(unit, ["valve body", "lever"], [15], parts_of(relief(tall, snout), lever))
    assert (found[0][0] == "relief valve" and found[0][1] >= SURE_FROM) is sprung


def made(kind, dn, style, **more):
    device = VALVES[kind]("V", dn, STYLES[style], **more)
    parts = parts_of(*((c.vertices, c.faces) for c in device.assembly.components))
    line = line_through(ends(device.length))
    return standing_on(surface_about(parts, range(parts.n_parts), *line))


@pytest.mark.parametrize(
    ("kind", "dn", "style"),
    list(product(("gate", "globe", "check", "butterfly"), (50, 150), ("plant-design", "bim", "scan"))),
)
def test_what_stands_on_a_valve_in_one_mesh_is_seen(kind, dn, style):
    wheel = {"gate": "wheel", "globe": "wheel", "check": "lid", "butterfly": "lever"}
    assert made(kind, dn, style) in (wheel[kind], None if kind == "butterfly" else wheel[kind])


@pytest.mark.parametrize("wheel", ["round", "plate", "solid"])
def test_wheels_of_every_form_are_wheels(wheel):
    assert made("gate", 80, "plant-design", wheel=wheel) == "wheel"


def standing(*meshes):
    parts = parts_of(merged(body(0.2), *meshes))
    return standing_on(surface_about(parts, [0], np.zeros(3), np.array([0.2, 0.0, 0.0])))


STEM = turned(shapes.cylinder(0.01, 0.25), (0.1, 0, 0.125), UP)


def disc(radius, height, thick=0.01):
    return turned(shapes.cylinder(radius, thick), (0.1, 0, height), UP)


@pytest.mark.parametrize(
    ("meshes", "seen"),
    [
        ((STEM, disc(0.1, 0.23)), "wheel"),
        ((STEM, disc(0.065, 0.23)), None),
        ((STEM, disc(0.1, 0.12)), None),
        ((STEM, disc(0.1, 0.23, 0.06)), None),
        ((STEM, disc(0.1, 0.2), disc(0.09, 0.25)), None),
        ((STEM, shapes.box((0.2, 0.03, 0.01), (0.18, 0, 0.24))), "lever"),
        # On the leg of a strainer, say, which goes on above it.
        ((STEM, shapes.box((0.2, 0.03, 0.01), (0.18, 0, 0.15))), None),
        ((STEM, shapes.box((0.2, 0.03, 0.01), (0.1, 0, 0.24))), None),
        ((STEM, shapes.box((0.2, 0.12, 0.01), (0.18, 0, 0.24))), None),
        ((disc(0.055, 0.1, 0.03),), "lid"),
        ((disc(0.02, 0.1, 0.03),), None),
        ((), None),
    ],
)
def test_wheels_levers_and_lids_are_told_from_what_is_none(meshes, seen):
    assert standing(*meshes) == seen


def test_open_kinds_are_told_with_two_guesses():
    length = 0.165
    found = network("X1 V1 X2", openings={"V1": ends(length)}, parts={"V1": (0, 1)})
    sized = tuple(type(link)(**{**link.__dict__, "size": 40}) for link in found.links)
    named = name_kinds(
        Network(found.units, found.places, sized),
        ["valve body", "handwheel"],
        parts_of(body(length), operator("handwheel", length)),
    )
    (unit,) = named.units
    assert unit.kind is None
    assert [kind for kind, _ in unit.kind_guesses] == ["gate valve", "globe valve"]
    assert all(0.05 <= sure < SURE_FROM for _, sure in unit.kind_guesses)


@pytest.mark.parametrize(
    ("kind", "size", "length"),
    [("gate", 50, 0.150), ("gate", 50, 0.178), ("gate", 50, 0.250), ("globe", 100, 0.350), ("globe", 100, 0.292),
     ("ball", 80, 0.180), ("butterfly", 100, 0.052), ("check", 100, 0.300), ("wafer check", 50, 0.040)],
)  # fmt: skip
def test_lengths_come_from_asme_and_en(kind, size, length):
    assert length in lengths_of(kind, size)
    assert list(lengths_of(kind, size)) == sorted(set(lengths_of(kind, size)))
    assert lengths_of(kind, 7) == ()


@pytest.mark.parametrize(
    ("girth", "top", "stated"), [(0.035, 0.0, True), (0.033, 0.0, False), (0.05, 0.053, True), (0.05, 0.057, False)]
)
def test_a_body_that_swells_and_carries_nothing_is_a_check_valve(girth, top, stated):
    length = 0.203
    parts = [
        turned(shapes.cylinder(0.03, length), (length / 2, 0, 0), X),
        turned(shapes.cylinder(girth, 0.1), (length / 2, 0, 0), X),
        *(turned(shapes.cylinder(0.08, 0.02), (end, 0, 0), X) for end in (0.01, length - 0.01)),
    ]
    if top:
        parts.append(turned(shapes.cylinder(0.01, top), (length / 2, 0, top / 2), UP))
    found = kinds([merged(*parts)], ["valve body"], length, 50)
    assert (bool(found) and found[0][0] == "check valve" and found[0][1] >= SURE_FROM) is stated
    assert kinds([merged(*parts)], ["valve"], length, 50) == ()


@pytest.mark.parametrize(
    ("names", "openings", "kind"),
    [
        (["gauge", None], 1, "pressure gauge"),
        ([None, None], 1, None),
        ([None, None], 2, "flow meter"),
        (["transmitter", None], 1, "transmitter"),
    ],
)
def test_a_gauge_of_which_only_the_group_is_known_is_of_no_known_kind(names, openings, kind):
    meshes = [shapes.box((0.1, 0.1, 0.1)), shapes.box((0.1, 0.1, 0.2))]
    gauge = UnitParts("gauge", "G-001", (0, 1), None, ends(0.2)[:openings])
    (named,) = name_kinds(Network((gauge,)), names, parts_of(*meshes)).units
    assert named.kind == kind
