import json

import pytest

import graphs
from cadgraph.agents.ask import Limits
from cadgraph.agents.plant import Plant
from cadgraph.errors import AskError, FormatError
from cadgraph.labelers.lvlm.price import Price
from cadgraph.labelers.lvlm.talk import ToolCall, Turn
from cadlab.agentbench.question_file import QuestionSet, read_answers
from cadlab.agentbench.questions import Question
from cadlab.agentbench.runner import ModelAsked, prompt_of, run_questions


@pytest.fixture
def asked(tmp_path):
    """Six questions about two plants, and the folder that these lie in."""
    for name in ("a", "b"):
        graphs.valve_line().save(tmp_path / "plants" / name)
    made = [
        Question(f"{plant}/count-{k}", plant, "count", 1, "number", f"How many {k}?", {}, k)
        for plant in ("a", "b")
        for k in (1, 2, 3)
    ]
    return QuestionSet(0, 3, "0", (), tuple(made)), tmp_path


def test_each_question_is_asked_about_its_plant_and_answers_are_kept(asked):
    questions, folder = asked
    heard = []

    def ask(plant, text):
        heard.append((plant.name, text))
        return len(heard) if len(heard) != 2 else None

    answers = run_questions(questions, folder / "plants", ask, folder / "answers.jsonl")
    assert [name for name, _ in heard] == ["a"] * 3 + ["b"] * 3
    assert [text for _, text in heard] == [prompt_of(question) for question in questions.questions]
    assert list(answers.values()) == [1, None, 3, 4, 5, 6]
    assert read_answers(folder / "answers.jsonl", questions) == answers


def test_a_question_without_an_answer_is_left_out_and_three_in_a_row_end_the_run(asked):
    questions, folder = asked
    calls = []

    def ask(plant, text):
        calls.append(text)
        if len(calls) in (1, 3, 4, 5):
            raise AskError("the server is gone")
        return 7

    with pytest.raises(AskError, match="gone"):
        run_questions(questions, folder / "plants", ask, folder / "answers.jsonl")
    kept = read_answers(folder / "answers.jsonl", questions)
    assert kept == {"a/count-2": 7}
    answers = run_questions(questions, folder / "plants", ask, folder / "answers.jsonl", known=kept, most=2)
    assert len(calls) == 7
    assert answers == {"a/count-1": 7, "a/count-2": 7, "a/count-3": 7}


def test_a_set_without_its_plants_is_refused(asked):
    questions, folder = asked
    with pytest.raises(FormatError, match="no such file or folder"):
        run_questions(questions, folder / "elsewhere", lambda plant, text: 1, folder / "answers.jsonl")


def test_the_prompt_holds_no_answer_and_says_the_form_and_is_short_enough_to_be_asked():
    question = Question("p/x-1", "p", "x", 1, "set", "Which?", {"unit": "V-1"}, ["SECRET"], ["SECRET"])
    assert "SECRET" not in prompt_of(question)
    assert 'is a "set"): Which?' in prompt_of(question)
    assert len(prompt_of(question)) < 3500


class Counting:
    """A model that finds all valves and says how many it was shown."""

    name = "counting"

    def turn(self, system, messages, tools, most, last):
        if messages[-1]["role"] != "tool":
            return Turn("", (ToolCall("c1", "find", '{"type": "valve"}'),), 1000, 10)
        found = int(messages[-1]["content"].split("\n")[1].split()[0])
        return Turn(f"There are {found}.\nANSWER: {json.dumps({'value': found, 'tags': []})}", (), 2000, 20)


def test_a_model_answers_through_the_tools_and_what_it_takes_is_counted():
    plant = Plant(graphs.valve_line())
    asked = ModelAsked(Counting(), price=Price(input=1.0, output=10.0))
    question = Question("p/count-1", "p", "count", 1, "number", "How many units of type 'valve' are there?", {}, 1)
    assert asked(plant, prompt_of(question)) == len(plant.graph.units("valve"))
    assert (asked.asked, asked.calls, asked.prompt_tokens, asked.answer_tokens) == (1, 1, 3000, 30)
    assert asked.tally() == "1 answers, 1 calls, 3,000 + 30 tokens, $0.0033"


def test_the_limit_on_cost_is_of_all_questions_together():
    plant = Plant(graphs.valve_line())
    asked = ModelAsked(Counting(), Limits(cost=0.05), Price(input=1.0, output=10.0))
    asked(plant, "How many valves are there?")
    assert asked.left == pytest.approx(0.05 - 0.0033)
    asked.cost = 0.05
    with pytest.raises(AskError, match=r"limit of \$0.05"):
        asked(plant, "How many valves are there?")
