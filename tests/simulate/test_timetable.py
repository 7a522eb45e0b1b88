import pytest

import playing
from cadgraph.errors import ScenarioError
from cadgraph.hydraulics.settings import Move
from cadgraph.query.network import Network
from cadgraph.simulate.play.timetable import Timetable, read_timetable, says_more

NETWORK = Network(playing.graph())


def read(tmp_path, text):
    path = tmp_path / "close.yaml"
    path.write_text(text, encoding="utf-8")
    return read_timetable(path, NETWORK)


def test_moves_are_read_in_the_order_of_time_and_tags_may_be_spelt_loosely(tmp_path):
    read_back = read(tmp_path, "play:\n  - {at: 20, set: {p1: 0}}\n  - {at: 2, over: 10, set: {V-001: 0.25}}\n")
    assert read_back == Timetable((Move(at=2, over=10, set={"V-001": 0.25}), Move(at=20, over=0, set={"P-001": 0.0})))


@pytest.mark.parametrize(("text", "more"), [("play: []", False), ("fluid: {density: 900}\nplay: []", True)])
def test_a_scenario_beside_the_moves_is_noticed(tmp_path, text, more):
    path = tmp_path / "close.yaml"
    path.write_text(text, encoding="utf-8")
    assert says_more(path) is more


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("valves: {}", "no list 'play'"),
        ("play: []", "no list 'play'"),
        ("play: [3]", "play: 1"),
        ("play: [{at: 1, set: {}}]", "play: 1: 'set' names nothing"),
        ("play: [{at: 1}]", "play: 1: set is missing"),
        ("play: [{at: -1, set: {V-001: 0}}]", "play: 1: at must be at least 0, not -1"),
        ("play: [{at: .nan, set: {V-001: 0}}]", "play: 1: at must be"),
        ("play: [{at: 1, set: {V-001: 2}}]", "play: 1: V-001 must be from 0 to 1, not 2"),
        ("play: [{at: 1, set: {V-001: ajar}}]", r"play: 1: set.V-001 must be a number"),
        ("play: [{at: 1, until: 2, set: {V-001: 0}}]", "play: 1: nothing is called 'until'"),
        ("play: [{at: 1, set: {V-002: 0}}]", "play: 1: .*V-002"),
        ("play: [{at: 1, set: {G-001: 0}}]", "play: 1: G-001 can't be set"),
        ("play: [", "not YAML"),
        (f"play: [{', '.join(['{at: 1, set: {V-001: 0}}'] * 1001)}]", "1,001 moves"),
    ],
)
def test_what_is_no_timetable_ends_in_one_clear_line(tmp_path, text, said):
    with pytest.raises(ScenarioError, match=said) as caught:
        read(tmp_path, text)
    assert "\n" not in str(caught.value)


def test_a_move_goes_evenly_from_where_a_thing_is_and_stays_at_its_end():
    timetable = Timetable((Move(at=2, over=10, set={"V-001": 0.0}), Move(at=20, over=0, set={"P-001": 0.0})))
    start = {"V-001": 0.8, "P-001": 1.0}
    assert timetable.commands(1.9, start) == {}
    assert timetable.commands(2, start) == {"V-001": 0.8}
    assert timetable.commands(7, start)["V-001"] == pytest.approx(0.4)
    assert timetable.commands(12, start) == {"V-001": 0.0}
    assert timetable.commands(20, start) == {"V-001": 0.0, "P-001": 0.0}


def test_a_move_that_begins_amid_another_goes_on_from_there():
    timetable = Timetable((Move(at=0, over=10, set={"V-001": 0.0}), Move(at=5, over=5, set={"V-001": 1.0})))
    assert timetable.commands(5, {"V-001": 1.0})["V-001"] == pytest.approx(0.5)
    assert timetable.commands(7.5, {"V-001": 1.0})["V-001"] == pytest.approx(0.75)
    assert timetable.commands(60, {"V-001": 1.0})["V-001"] == 1.0
