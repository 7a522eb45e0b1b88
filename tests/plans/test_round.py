import pytest

from cadgraph.errors import AskError
from cadgraph.model.records import Unit
from cadgraph.plans import check_round, make_round, parse_goals
from cadgraph.plans.round import survey
from cadgraph.plans.text import doubt_lines, step_lines
from gallery import gallery, standing
from networks import network, pumping, unit

GRAPH = gallery()


def made(text, graph=GRAPH, start=None, walk=None):
    goals = parse_goals(text, graph.find)
    known = survey(graph, goals, start and graph.unit(start).id, walk)
    planned = make_round(known, goals, start and graph.unit(start).id)
    assert check_round(known, planned) == ()
    return known, planned


def doings(planned):
    return [f"{step.do} {step.target.removeprefix('unit-')}" for step in planned.steps]


def test_a_platform_is_climbed_to_and_down_from():
    known, planned = made("read G-001, G-002, close V-002", start="V-001")
    assert doings(planned) == [
        "walk G-001", "read G-001", "walk place-003", "climb place-003", "walk G-002", "read G-002", "walk V-002",
        "close V-002", "walk place-003", "climb place-003", "walk V-001",
    ]  # fmt: skip
    assert planned.climbed == 6.0
    assert any(
        "climb place-003 (stairs) up 3.0 m to the platform +3.00 m" in line for line in step_lines(known, planned)
    )
    assert planned.shortest


def test_lengths_are_straight_in_plan_with_the_height_of_climbs():
    # To the foot of the stairs and back for V-001, on the platform to V-002 and back.
    _, planned = made("close V-002", start="V-001")
    assert planned.length == pytest.approx(2 * (3.0 + 3.0 + 1.0))
    assert planned.estimated


def test_a_round_without_a_start_begins_and_ends_on_the_ground():
    _, planned = made("read G-002")
    assert doings(planned) == ["walk place-003", "climb place-003", "walk G-002", "read G-002", "walk place-003",
                               "climb place-003"]  # fmt: skip
    assert planned.steps[0].length == 0.0
    assert planned.length == pytest.approx(2 * (3.0 + 5.0))


def test_walks_are_as_long_as_they_are_said_to_be():
    _, planned = made("close V-001, read G-001", walk=lambda a, b: 10.0)
    assert planned.length == 10.0
    assert not planned.estimated


def test_a_walk_that_is_blocked_is_told():
    known, planned = made("close V-001, read G-001", walk=lambda a, b: None)
    assert planned.estimated
    assert any("no free way was found" in line for line in doubt_lines(known, planned))


def test_what_is_out_of_reach_takes_a_ladder_or_lift():
    known, planned = made("close V-003")
    assert doings(planned) == ["walk V-003", "set up V-003", "close V-003"]
    assert doubt_lines(known, planned)[0] == (
        "! V-003 takes a ladder, lift or other access: its middle is 3.5 m above the ground, out of reach"
    )


def test_what_is_low_and_yet_out_of_reach_is_said_to_have_no_place_to_stand():
    low = standing("V-005", (5.0, 5.0, 0.5), reach="out of reach", kind="gate valve", height=0.5)
    known, planned = made("close V-005", gallery([low]))
    assert doubt_lines(known, planned)[0].endswith("out of reach: no free place to stand near it was found")


@pytest.mark.parametrize(("viewpoint", "aided"), [(None, True), ((5.0, 4.0, 1.7), False)])
def test_a_gauge_up_high_takes_a_ladder_only_where_it_is_not_read_from_the_floor(viewpoint, aided):
    high = standing("G-005", (5.0, 5.0, 2.8), reach="out of reach", height=2.8)
    high = high.model_copy(update={"access": high.access.model_copy(update={"viewpoint": viewpoint})})
    _, planned = made("read G-005", gallery([high]))
    assert ("set up G-005" in doings(planned)) is aided


def test_opening_a_valve_does_not_repeat_what_closing_it_did():
    known, planned = made("close V-002; open V-002", pumping())
    close, opened = (step.change for step in planned.steps if step.goal)
    assert "P-001 would run dry" in close.notes
    assert (close.harm, opened.harm) == (("P-001 would run dry",), ())
    assert "! close V-002: P-001 would run dry" in doubt_lines(known, planned)
    assert "P-001 would run dry" not in opened.notes
    assert "P-001" in opened.fed_again


def test_opening_the_way_to_an_open_end_is_told_as_harm():
    known, planned = made("open V-010", pumping())
    (opened,) = (step.change for step in planned.steps if step.goal)
    assert opened.harm == ("it flows out at terminal-001, an open end",)
    assert "! open V-010: it flows out at terminal-001, an open end" in doubt_lines(known, planned)


def test_without_a_ground_heights_are_told_to_be_over_the_lowest_point():
    graph = gallery(ground=False)
    known, planned = made("close V-001", graph)
    assert "? V-001: no ground was found: heights are over the lowest point of the plant" in doubt_lines(known, planned)
    assert any("its middle is 1.2 m above the lowest point of the plant" in line for line in step_lines(known, planned))


def test_a_platform_without_a_way_up_takes_a_lift():
    known, planned = made("close V-004")
    assert doings(planned) == ["walk V-004", "set up V-004", "close V-004"]
    assert "no way up to platform +5.00 m (north west) was found" in doubt_lines(known, planned)[0]


def test_access_that_is_not_known_is_told_and_no_point_to_stand_at_is_made_up():
    known, planned = made("read G-003")
    assert doubt_lines(known, planned) == ["? G-003: where to stand and whether it is within reach is not known"]
    assert all(step.point is None for step in planned.steps)
    assert any("level is not known" in text for text in planned.assumptions)


def test_a_graph_without_places_is_said_to_have_none():
    _, planned = made("read G-001; close V-002", pumping())
    assert any("built without places" in text for text in planned.assumptions)


def test_stages_keep_their_order_whatever_it_costs():
    _, planned = made("read G-002; close V-001; open V-002")
    assert [step.target for step in planned.steps if step.goal] == ["unit-G-002", "unit-V-001", "unit-V-002"]


def test_closing_says_what_it_cuts_off_and_opening_what_it_feeds_again():
    _, planned = made("close V-001; read G-001; close V-002; open V-001")
    close, read, again, opened = (step.change for step in planned.steps if step.goal)
    assert close.cut_off == ("G-001", "G-002", "V-002")
    assert read.notes == ("cut off with V-001 closed: it shows what is shut in, not the running plant",)
    assert again.cut_off == ()
    assert opened.fed_again == ("G-001",)


def test_a_valve_that_is_opened_first_is_taken_for_shut_before():
    _, planned = made("open V-001")
    assert planned.assumptions[0] == "V-001 is shut before the round"
    assert "G-001" in next(step.change for step in planned.steps if step.goal).fed_again


def test_a_pump_that_was_stopped_before_comes_to_no_harm():
    _, harmed = made("close V-002", pumping())
    assert any("P-001 would run dry" in text for step in harmed.steps for text in step.change.harm)
    _, planned = made("stop P-001; close V-002", pumping())
    assert [(step.do, step.change.harm) for step in planned.steps if step.goal] == [("stop", ()), ("close", ())]
    assert not any("run dry" in note for step in planned.steps for note in step.change.notes)
    assert "all other valves are open and all other pumps run" in planned.assumptions
    assert "pumps are stopped and started where they stand; one that is switched elsewhere takes no walk" in (
        planned.assumptions
    )


def test_a_pump_of_unknown_kind_is_not_told_to_be_a_check_valve():
    known, planned = made("stop P-001", pumping())
    assert not any("check valve" in line for line in doubt_lines(known, planned))


def test_starting_a_pump_without_a_supply_is_told_as_harm():
    known, planned = made("close V-002; start P-001", pumping())
    assert "! start P-001: P-001 would run dry" in doubt_lines(known, planned)
    assert "P-001 is stopped before the round" in planned.assumptions


def test_starting_a_pump_against_a_closed_valve_is_told_as_harm():
    known, planned = made("close V-005; start P-001; open V-005", pumping())
    assert any(line.startswith("! start P-001: P-001 would pump against") for line in doubt_lines(known, planned))
    assert [step.do for step in planned.steps if step.goal] == ["close", "start", "open"]


def test_a_valve_without_a_line_changes_what_nobody_knows():
    known, planned = made("close V-004")
    assert planned.steps[-1].change.notes == ("no line was found at V-004: what turning it changes is not known",)
    assert not any("no unit or end is known to be cut off" in line for line in step_lines(known, planned))


def test_a_valve_of_unknown_kind_is_told_apart():
    known, planned = made("close V-012", pumping())
    assert any(line.startswith("? V-012: its kind is not known") for line in doubt_lines(known, planned))


def test_names_from_a_file_stay_on_one_line():
    bad = unit("G-009").model_copy(update={"tag": "G-9\n2. open V-001\u202e", "id": "unit-bad"})
    known, planned = made("read unit-bad", network([bad], []))
    assert not any("\n" in line or "\u202e" in line for line in step_lines(known, planned))


def test_a_round_needs_a_goal_and_begins_at_a_unit():
    with pytest.raises(AskError, match="needs a goal"):
        make_round(GRAPH, ())
    with pytest.raises(AskError, match="begins at a unit"):
        make_round(GRAPH, parse_goals("read G-001", GRAPH.find), "place-001")


def test_a_graph_stays_as_it_is_and_gives_the_same_round_each_time():
    before = GRAPH.to_json()
    tags = [u.tag for u in GRAPH.of_layer(Unit) if u.tag[0] == "G"]
    text = f"read {', '.join(tags)}; close V-003, V-004"
    assert made(text)[1] == made(text)[1]
    assert GRAPH.to_json() == before
