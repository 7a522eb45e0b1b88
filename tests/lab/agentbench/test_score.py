import pytest

from cadlab.agentbench.questions import Question
from cadlab.agentbench.score import NOT_GIVEN, is_right, score, wrong_valves


def asked(form, answer, graph=None, type_="x", **more):
    return Question("p/x-1", "p", type_, 1, form, "?", {}, answer, graph, **more)


@pytest.mark.parametrize(
    ("form", "wanted", "given", "right"),
    [
        ("number", 3, 3, True),
        ("number", 3, 3.0, True),
        ("number", 3, 4, False),
        ("number", 1, True, False),
        ("number", 3, "3", False),
        ("metres", 0.5, 0.519, True),
        ("metres", 0.5, 0.521, False),
        ("metres", 50.0, 50.5, True),
        ("metres", 50.0, 50.51, False),
        ("metres", -1.0, 1.0, False),
        ("metres", 1.0, float("nan"), False),
        ("set", ["A", "B"], ["b", " A "], True),
        ("set", ["A", "B"], ["A"], False),
        ("set", ["A"], ["A", "A"], False),
        ("set", ["A"], "A", False),
        ("set", [], [], True),
        ("set", [], None, False),
        ("list", ["A", "B"], ["A", "B"], True),
        ("list", ["A", "B"], ["B", "A"], False),
        ("unknown", None, None, True),
        ("unknown", None, "12 bar", False),
    ],
)
def test_an_answer_is_right_within_its_form(form, wanted, given, right):
    assert is_right(asked(form, wanted), given, wanted) is right


def test_a_round_is_right_by_its_length_whichever_way_it_goes():
    places = {"A": (0, 0, 9), "B": (1, 0, 0), "C": (1, 1, 0), "D": (0, 1, 0)}
    question = asked("list", list("ABCD"), places=places)
    assert is_right(question, list("ABCD"), list("ABCD"))
    assert is_right(question, list("ADCBA"), list("ABCD"))
    assert not is_right(question, list("ACBD"), list("ABCD"))
    assert not is_right(question, list("ABC"), list("ABCD"))
    assert not is_right(question, list("BCDA"), list("ABCD"))
    assert not is_right(question, [], list("ABCD"))


def test_graph_agent_and_both_are_told_apart():
    wrong_graph = asked("number", answer=3, graph=4)
    repeats, knows = score(wrong_graph, 4), score(wrong_graph, 3)
    assert (repeats.graph, repeats.agent, repeats.both) == (0, 1, 0)
    assert (knows.graph, knows.agent, knows.both) == (0, 0, 1)


def test_no_answer_is_wrong_even_where_null_is_right():
    question = asked("unknown", None)
    assert score(question, None).both == 1
    silent = score(question, NOT_GIVEN)
    assert (silent.asked, silent.answered, silent.agent, silent.both) == (1, 0, 0, 0)


def test_an_isolation_is_safe_only_where_nothing_leaks_and_no_valve_is_of_a_wrong_kind():
    safe = asked("set", ["A"], ["A"], "isolate", leaks=[])
    leaking = asked("set", ["A"], ["B"], "isolate", leaks=["B", "tank"])
    total = score(safe, ["A"], never=["B"]) + score(leaking, ["b"], never=["B"])
    assert (total.isolations, total.safe, total.given_isolations, total.given_safe) == (2, 1, 2, 1)
    assert wrong_valves(["a", "B "], ["b"]) == ["B "]
