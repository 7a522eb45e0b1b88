"""Devices that labels missed: how lines meet a body, its size and what it is likely labelled decide."""

import numpy as np
import pytest

import shapes
from cadgraph.stages.relate.piping import Group
from cadgraph.stages.relate.recover import ARRANGEMENT, FITTING, LABELLED, SIZE, recover_units
from piping import GAUGE, PIPE, PUMP, STEEL, TANK, VALVE, R, pipe, turned
from sketch import SIDES, VOCABULARY, Sketch, X, around, block

EQUIPMENT = "Equipment"
WIDE = 2 * R  # diameter of the pipes [m]
NAMES = {
    "valve": (VALVE, "valve"), "gauge": (GAUGE, "gauge"), "pump": (PUMP, "pump"), "tank": (TANK, "tank"),
    "equipment": (EQUIPMENT, "boiler"), FITTING: (PIPE, "reducer"),
}  # fmt: skip


def found(sketch):
    """What the first mesh is taken for, None where it stays what it was."""
    before = sketch.piping()
    piping = recover_units(before)
    groups = [group.unit_type for group in piping.groups if 0 in group.parts]
    assert len(groups) <= 1
    if 0 in piping.recovered and not groups:
        assert 0 in piping.lineless
        return FITTING
    return groups[0] if groups else None


def recovered(kind, sides, pipes, sure, **more):
    """What a body is taken for that is likely of a kind and so many pipes long."""
    size = np.full(3, min(pipes * WIDE, 3.5 * WIDE))
    size[1] = pipes * WIDE
    return found(around(size, sides, **{"likely": {NAMES[kind]: sure}, **more}))


# For each type where lines meet it as they meet one, and where they don't; all else is the same.
MEETS = {
    "valve": ("aligned", "two", 4.0, 0.1),
    "gauge": ("one", "two", 5.0, 0.1),
    "pump": ("square", "aligned", 8.0, 0.1),
    "tank": ("many", "aligned", 12.0, 0.1),
    "equipment": ("two", "aligned", 12.0, 0.2),
    FITTING: ("aligned", "one", 2.0, 0.9),
}


@pytest.mark.parametrize("kind", MEETS)
def test_how_lines_meet_a_body_tells_its_type(kind):
    usual, odd, pipes, sure = MEETS[kind]
    assert recovered(kind, usual, pipes, sure) == kind
    assert recovered(kind, odd, pipes, sure) is None


# For each type a way of meeting with a size that it has, and one that it hasn't; all else is the same.
SIZES = {
    "valve": ("aligned", 4.0, 20.0, 0.1),
    "gauge": ("one", 4.0, 1.0, 0.02),
    "pump": ("square", 8.0, 2.5, 0.05),
    "tank": ("many", 12.0, 3.5, 0.3),
    "equipment": ("two", 12.0, 3.0, 0.3),
    FITTING: ("aligned", 2.0, 8.0, 0.9),
}


@pytest.mark.parametrize("kind", SIZES)
def test_the_size_of_a_body_tells_its_type(kind):
    sides, usual, odd, sure = SIZES[kind]
    assert recovered(kind, sides, usual, sure) == kind
    assert recovered(kind, sides, odd, sure) is None


# For each type a body that lines meet as they meet one: how likely its label must be.
LABELS = {
    "valve": ("aligned", 4.0, 0.02, 0.005),
    "gauge": ("one", 5.0, 0.05, 0.003),
    "pump": ("square", 8.0, 0.01, 0.001),
    "tank": ("many", 12.0, 0.01, 0.001),
    "equipment": ("many", 12.0, 0.05, 0.005),
    FITTING: ("aligned", 2.0, 0.5, 0.05),
}


@pytest.mark.parametrize("kind", LABELS)
def test_what_the_labeler_holds_for_possible_tells_a_type(kind):
    sides, pipes, likely, unlikely = LABELS[kind]
    assert recovered(kind, sides, pipes, likely) == kind
    assert recovered(kind, sides, pipes, unlikely) != kind


def test_every_type_has_its_place_in_each_table():
    types = {*VOCABULARY.unit_of_group.values(), FITTING}
    assert set(ARRANGEMENT) == set(SIDES)
    assert all(set(row) == types for row in ARRANGEMENT.values())
    assert set(SIZE) == types
    assert all(list(curve.at) == sorted(curve.at) for curve in (*SIZE.values(), LABELLED))


@pytest.mark.parametrize(("beam", "kind"), [(0.02, "valve"), (0.45, None)])
def test_what_may_be_steelwork_needs_more(beam, kind):
    assert recovered("valve", "aligned", 4.0, 0.05, likely={NAMES["valve"]: 0.05, (STEEL, "plate"): beam}) == kind


@pytest.mark.parametrize(("wide", "kind"), [(0.38, "gauge"), (0.42, None)])
def test_no_gauge_is_wider_than_an_arm(wide, kind):
    assert found(around((0.2, wide, 0.2), "one", radius=0.08, likely={NAMES["gauge"]: 0.4})) == kind


@pytest.mark.parametrize("name", ["cross", "tee", "elbow", "pipe cap", "blind flange"])
def test_names_of_what_is_bent_say_nothing_of_a_body(name):
    assert recovered(FITTING, "aligned", 2.0, 0.9, likely={(PIPE, name): 0.9}) is None


@pytest.mark.parametrize(
    ("name", "likely", "kind"), [("valve", {}, "gauge"), ("gauge", {NAMES["gauge"]: 0.7}, "gauge")]
)
def test_a_doubted_device_stays_one_but_may_be_another(name, likely, kind):
    # The labeler says so without being sure; one line leads to it.
    said = {"group": NAMES[name][0], "name": NAMES[name][1], "sure": 0.7, "likely": likely or {NAMES["gauge"]: 0.4}}
    assert found(around(0.24, "one", **said)) == kind


def test_a_doubted_valve_at_the_end_of_a_line_stays_one():
    likely = {NAMES["valve"]: 0.6, NAMES["gauge"]: 0.1}
    assert found(around(0.24, "one", group=VALVE, name="valve", sure=0.7, likely=likely)) == "valve"


@pytest.mark.parametrize(
    ("sides", "name", "kind"),
    [("aligned", "gauge face", "gauge"), ("aligned", "gauge stem", None), ("one", "gauge stem", "gauge")],
)
def test_what_a_gauge_is_screwed_into_with_a_stem_of_its_own_is_no_piece_of_it(sides, name, kind):
    sketch = around(0.24, sides, likely={NAMES["gauge"]: 0.02})
    sketch.add(block((0, 0.14, 0), (0.03, 0.04, 0.03)), GAUGE, name, likely={(GAUGE, name): 0.9})
    assert found(sketch) == kind


@pytest.mark.parametrize(("wheel", "kind"), [(True, "valve"), (False, None)])
def test_what_touches_a_unit_that_no_line_leads_to_is_its_body(wheel, kind):
    sketch = around(0.24, "square", likely={NAMES["valve"]: 0.1})
    if wheel:
        sketch.add(block((0, 0.14, 0), (0.2, 0.04, 0.2)), VALVE, "handwheel", likely={(VALVE, "handwheel"): 0.9})
    assert found(sketch) == kind
    if wheel:
        assert Group("valve", (0, 3)) in recover_units(sketch.piping()).groups


@pytest.mark.parametrize(("source", "kind"), [("geometry", "valve"), ("author", FITTING), ("human", FITTING)])
def test_where_people_named_nearly_everything_what_they_left_out_only_passes_a_line_on(source, kind):
    assert recovered("valve", "aligned", 4.0, 0.1, named_by=source) == kind


def test_where_people_named_nearly_everything_what_lines_only_end_at_is_nothing():
    assert recovered("gauge", "one", 5.0, 0.1) == "gauge"
    sketch = around(0.24, "one", named_by="author", likely={NAMES["gauge"]: 0.1})
    sketch.pipe((5, 0, 0), (6, 0, 0), source="author")
    assert found(sketch) is None


def test_where_people_named_nearly_everything_a_body_still_joins_the_unit_that_it_touches():
    sketch = around(0.24, "aligned", named_by="author", likely={NAMES["valve"]: 0.1})
    sketch.add(block((0, 0.14, 0), (0.2, 0.04, 0.2)), VALVE, "handwheel", source="author")
    assert recover_units(sketch.piping()).groups == (Group("valve", (0, 3)),)


@pytest.mark.parametrize("source", ["author", "human", "catalog", "repeat", "file"])
@pytest.mark.parametrize("sides", SIDES)
def test_what_anybody_named_stays_what_it_is(source, sides):
    sketch = around(0.24, sides, group=STEEL, name="plate", source=source, likely={NAMES["valve"]: 0.9})
    before = sketch.piping()
    after = recover_units(before)
    assert (after.groups, after.lineless, after.recovered) == ((), (), {})
    assert sketch.connected().labels[0] is sketch.labels[0]


def test_a_gauge_that_is_found_may_sit_on_a_line():
    piping = recover_units(around(0.24, "one", likely={NAMES["gauge"]: 0.3}).piping())
    assert piping.feet == {0}
    assert piping.members == {0}
    assert set(piping.recovered) == {0}


def test_how_sure_a_device_is_follows_from_what_speaks_for_it():
    def sure(likely):
        return recover_units(around(0.24, "aligned", likely={NAMES["valve"]: likely}).piping()).recovered[0].sure

    assert 0.6 < sure(0.03) < sure(0.1) < sure(0.5) < 1.0


def test_a_disc_on_the_end_of_a_line_closes_it():
    def taken(thick, wide):
        sketch = Sketch()
        sketch.pipe((-1, 0, 0), (0, 0, 0), source="author")
        disc = pipe((0, 0, 0), (thick, 0, 0), wide, None)
        sketch.add(disc, TANK, "nozzle", sure=0.6, likely={NAMES["tank"]: 0.3})
        return 1 in recover_units(sketch.piping()).lineless

    assert taken(0.4 * R, R)
    assert not taken(0.8 * R, R)
    assert not taken(0.4 * R, 1.4 * R)


@pytest.mark.parametrize(("likely", "found"), [({(VALVE, "valve"): 0.46}, ["valve"]), ({(PUMP, "pump"): 0.46}, [])])
def test_a_body_between_a_line_and_the_flange_of_a_pump_is_a_valve(likely, found):
    sketch = Sketch()
    sketch.add(block((0.089, 0, 0), (0.178, 0.15, 0.15)), likely=likely)
    sketch.pipe((-1, 0, 0), (0, 0, 0))
    sketch.add(turned(shapes.cylinder(0.08, 0.4), (0.378, 0, 0), X), PUMP, "pump", source="author")
    groups = recover_units(sketch.piping()).groups
    assert [group.unit_type for group in groups if 0 in group.parts] == found


@pytest.mark.parametrize("radius", [0.025, 0.006])
@pytest.mark.parametrize(("gauge", "found"), [(0.15, ["valve"]), (0.4, ["gauge"])])
def test_a_cock_between_a_line_and_a_gauge_is_a_valve_where_it_is_far_likelier_one(gauge, radius, found):
    sketch = Sketch()
    sketch.add(block((0.05, 0, 0), (0.1, 0.06, 0.06)), likely={(VALVE, "valve"): 0.47, (GAUGE, "gauge stem"): gauge})
    sketch.pipe((-1, 0, 0), (0, 0, 0))
    sketch.add(turned(shapes.cylinder(radius, 0.1), (0.15, 0, 0), X), GAUGE, "gauge", source="author")
    groups = recover_units(sketch.piping()).groups
    assert [group.unit_type for group in groups if 0 in group.parts] == found


@pytest.mark.parametrize(("name", "kind"), [("motor", "pump"), ("pump base", None)])
def test_what_a_motor_without_a_pump_stands_at_is_one(name, kind):
    said = {NAMES["pump"]: 0.3, NAMES["valve"]: 0.08, NAMES["equipment"]: 0.05}
    sketch = around((0.24, 0.3, 0.24), "aligned", likely=said)
    sketch.add(block((0, 0.3, 0), 0.3), PUMP, name, likely={(PUMP, name): 0.9})
    assert found(sketch) == kind


@pytest.mark.parametrize(
    ("said", "kind"),
    [((0.45, 0.5, 0.0), "tank"), ((0.38, 0.6, 0.0), "equipment"), ((0.03, 0.03, 0.9), None)],
)
def test_what_is_surely_some_device_is_the_likeliest(said, kind):
    likely = dict(zip((NAMES["tank"], NAMES["equipment"], NAMES[FITTING]), said, strict=True))
    assert recovered("tank", "many", 8.0, said[0], likely=likely) == kind


def test_what_is_surely_some_device_but_not_surely_a_valve_is_none():
    likely = {NAMES["valve"]: 0.3, NAMES["gauge"]: 0.69}
    assert recovered("valve", "aligned", 4.0, 0.3, likely=likely) is None


@pytest.mark.parametrize(("valve", "fitting", "kind"), [(0.06, 0.87, None), (0.3, 0.5, "valve")])
def test_what_is_surely_a_fitting_is_no_valve_by_its_length(valve, fitting, kind):
    likely = {NAMES["valve"]: valve, (PIPE, "strainer"): fitting}
    assert recovered("valve", "aligned", 3.3, valve, likely=likely) == kind


@pytest.mark.parametrize(("said", "apart"), [
    ({(GAUGE, "transmitter"): 0.8, (TANK, "nozzle"): 0.01}, True),
    ({(GAUGE, "transmitter"): 0.5, (TANK, "nozzle"): 0.4}, False),
])  # fmt: skip
def test_a_gauge_on_a_body_without_a_name_stays_one_where_it_is_far_likelier_that(said, apart):
    sketch = around((0.6, 0.8, 0.6), "many", likely={(TANK, "tank"): 0.5, (EQUIPMENT, "boiler"): 0.2})
    gauge = sketch.add(
        turned(shapes.cylinder(0.03, 0.1), (0, 0.45, 0), (0, 1, 0)), GAUGE, "transmitter", sure=0.6, likely=said
    )
    groups = {part: group.unit_type for group in recover_units(sketch.piping()).groups for part in group.parts}
    assert groups[0] == "tank"
    assert groups[gauge] == ("gauge" if apart else "tank")


@pytest.mark.parametrize(("sides", "kind"), [("aligned", "gauge"), ("one", None)])
def test_a_meter_in_a_line_may_be_longer_than_a_gauge_at_its_end(sides, kind):
    sketch = around((0.5, 0.2, 0.2), sides, radius=1.4 * R, likely={(GAUGE, "flow meter"): 0.6, (VALVE, "valve"): 0.12})
    assert found(sketch) == kind
