import pytest

from cadgraph.errors import CadGraphError
from cadgraph.plans.goals import MOST_GOALS, goals_text, parse_goals
from gallery import gallery
from networks import network, pumping, unit

GRAPH = gallery()


def parsed(text, graph=GRAPH):
    return [(goal.action, goal.name, goal.stage) for goal in parse_goals(text, graph.find)]


def test_semicolons_keep_the_order_and_commas_leave_it_free():
    assert parsed("read G-001, G-002; close V-002; open V-001") == [
        ("read", "G-001", 0), ("read", "G-002", 0), ("close", "V-002", 1), ("open", "V-001", 2),
    ]  # fmt: skip


def test_a_verb_holds_until_the_next_and_tags_may_be_spelt_loosely():
    assert parsed("Read g1 and G-2, close: v 2; V-001;; ") == [
        ("read", "G-001", 0), ("read", "G-002", 0), ("close", "V-002", 0), ("close", "V-001", 1),
    ]  # fmt: skip


def test_what_is_said_twice_is_done_once():
    assert parsed("read G-001, G-001, G1; read G-001") == [("read", "G-001", 0), ("read", "G-001", 1)]


def test_goals_can_be_written_down_and_read_again():
    text = "read G-001, G-002; close V-002; open V-002"
    goals = parse_goals(text, GRAPH.find)
    assert parse_goals(goals_text(goals), GRAPH.find) == goals


def test_a_tag_that_would_spoil_the_words_is_written_as_its_id():
    odd = unit("V-009", "ball valve").model_copy(update={"tag": "V-9; open V-1", "id": "unit-odd"})
    goals = parse_goals("close unit-odd", network([odd], []).find)
    assert goals_text(goals) == "close unit-odd"


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "no goals"),
        ("shut V-001", "'shut' is no verb; begin with read, close, open, stop or start"),
        ("close", "close what"),
        ("close V-021", "did you mean V-002, V-001"),
        ("close G-001", "G-001 is a pressure gauge, and only a valve can be closed"),
        ("read V-001", "V-001 is a gate valve, and only a gauge can be read"),
        ("close place-001", "place-001 is a place, and only a valve can be closed"),
        ("close V-001, open V-001", "put a semicolon between"),
        ("close V-001; close V-001", "closed twice without being opened between"),
        ("stop V-001", "V-001 is a gate valve, and only a pump can be stopped"),
    ],
)
def test_goals_that_make_no_sense_are_refused_with_the_remedy(text, says):
    with pytest.raises(CadGraphError, match=says):
        parsed(text)


@pytest.mark.parametrize(("tag", "says"), [("V-004", "is a check valve"), ("V-015", "is a relief valve, which must")])
def test_what_nobody_turns_by_hand_is_refused(tag, says):
    with pytest.raises(CadGraphError, match=says):
        parsed(f"close {tag}", pumping())


def test_more_goals_than_a_round_takes_are_refused():
    many = network([unit(f"G-{n:03d}") for n in range(MOST_GOALS + 1)], [])
    with pytest.raises(CadGraphError, match="at most 200"):
        parsed("read " + ", ".join(f"G-{n:03d}" for n in range(MOST_GOALS + 1)), many)
