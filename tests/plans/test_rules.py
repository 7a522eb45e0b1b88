import dataclasses

import pytest

from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import ReachedFrom
from cadgraph.plans import make_round, parse_goals
from cadgraph.plans.round import survey
from cadgraph.plans.rules import Move, check_moves, moves_of
from gallery import gallery

GRAPH = gallery()
GOALS = parse_goals("read G-001; close V-003, V-002; open V-002", GRAPH.find)
KNOWN = survey(GRAPH, GOALS, "unit-V-001")
MOVES = moves_of(make_round(KNOWN, GOALS, "unit-V-001"))


def faults(moves, goals=GOALS, length=None, known=KNOWN):
    return [fault.text for fault in check_moves(known, goals, moves, length)]


def at(do, target):
    return next(i for i, move in enumerate(MOVES) if (move.do, move.target) == (do, target))


def without(i):
    return MOVES[:i] + MOVES[i + 1 :]


def test_a_round_that_was_made_here_keeps_all_rules():
    assert faults(MOVES) == []


def test_a_round_of_bare_steps_keeps_them_too():
    bare = [Move(move.do, move.target) for move in MOVES]
    assert faults(bare) == []


@pytest.mark.parametrize(
    ("moves", "says"),
    [
        (without(at("read", "unit-G-001")), "close V-002 comes before read G-001, which is asked to come first"),
        (without(at("read", "unit-G-001")), "G-001 is not read"),
        (without(at("close", "unit-V-002")), "V-002 is open already"),
        (without(at("set up", "unit-V-003")), "V-003 takes a ladder or lift, which was not set up"),
        (without(at("walk", "unit-V-003")), "one does not stand at V-003: walk there before"),
        (without(at("climb", "place-003")), "V-002 is on the platform +3.00 m (south east), one stands on the ground"),
        (without(at("walk", "place-003")), "one is not at an end of place-003: walk there before climbing"),
        (MOVES[:-1], "it does not end where it begins"),
        ((*MOVES, Move("close", "unit-V-002")), "V-002: to close it again is not asked"),
        ((*MOVES, Move("close", "unit-V-001")), "V-001: to close it is not asked"),
        ((*MOVES, Move("walk", "unit-V-777")), "nothing to walk to is called 'unit-V-777' here"),
        ((*MOVES, Move("climb", "place-002")), "no way up is called 'place-002'"),
        ((*MOVES, Move("read", "nothing")), "no unit is called 'nothing'"),
        ((*MOVES, Move("walk", "unit-V-001", named="V-002")), "it names V-002, but is at V-001"),
        ((Move("walk", "unit-G-001", length=0.5), *MOVES[1:]), "it says 0.50 m to G-001, but that takes 2.00 m"),
    ],
)
def test_a_broken_rule_is_named(moves, says):
    assert any(says in text for text in faults(moves)), faults(moves)


def test_a_round_can_not_be_said_to_be_shorter_than_its_steps():
    length = sum(move.length for move in MOVES)
    assert faults(MOVES, length=length) == []
    assert any("less than its steps take" in text for text in faults(MOVES, length=0.9 * length))


def test_a_detour_is_nobodys_fault():
    longer = [dataclasses.replace(m, length=m.length + 1 if m.do == "walk" else m.length) for m in MOVES]
    assert faults(longer) == []


def test_a_round_without_a_start_must_come_down_again():
    goals = parse_goals("read G-002", GRAPH.find)
    known = survey(GRAPH, goals)
    moves = moves_of(make_round(known, goals))
    assert faults(moves, goals, known=known) == []
    assert faults(moves[:-2], goals, known=known) == ["it ends on the platform +3.00 m (south east), not on the ground"]


def test_a_climb_needs_a_level_where_a_way_has_several():
    document = GRAPH.document
    tower = ReachedFrom(source="place-004", target="place-003")
    graph = SceneGraph(document.model_copy(update={"edges": (*document.edges, tower)}))
    goals = parse_goals("close V-004", graph.find)
    known = survey(graph, goals)
    planned = make_round(known, goals)
    assert all(step.do != "set up" for step in planned.steps)
    assert faults(moves_of(planned), goals, known=known) == []
    bare = [Move(move.do, move.target) for move in moves_of(planned)]
    assert any("say to which level one climbs" in text for text in faults(bare, goals, known=known))
