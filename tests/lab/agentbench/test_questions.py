"""Sets of questions about built plants: what the tools say is what follows from the graph, and files hold it all."""

import json
from collections import Counter

import pytest

from cadgraph.agents.plant import Plant
from cadgraph.errors import FormatError
from cadgraph.model.graph import SceneGraph
from cadlab.agentbench.commands import agentbench
from cadlab.agentbench.facts import facts_of_graph
from cadlab.agentbench.making import make_set
from cadlab.agentbench.oracle import Oracle
from cadlab.agentbench.question_file import read_answers, read_set, write_answers
from cadlab.agentbench.questions import TYPES, draw
from cadlab.agentbench.report import misses, scores_of, to_json, to_markdown
from cadlab.agentbench.score import is_right
from scripted_model import ScriptedModel

PRESET = "pumps"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    target = tmp_path_factory.mktemp("questions")
    make_set(target, 3, (PRESET,), ("true",), 2)
    return target


@pytest.mark.slow
def test_the_tools_say_what_other_solvers_find_in_the_same_graph(folder):
    graph = SceneGraph.load(folder / "plants" / f"{PRESET}-true")
    oracle = Oracle(Plant(graph))
    questions = draw(facts_of_graph(graph), PRESET, 0, 40)
    assert [q.id for q in questions if not is_right(q, oracle.answer(q), q.answer)] == []
    assert len(questions) > 100


@pytest.mark.slow
def test_a_set_is_read_as_it_was_made_and_asks_of_every_level(folder):
    made = read_set(folder)
    assert [plant.name for plant in made.plants] == ["pumps-true"]
    assert {question.level for question in made.questions} == {1, 2, 3}
    types = {question.type for question in made.questions}
    assert types == {type_.name for type_ in TYPES} - {"climb"}  # there is no platform
    assert any(question.answer is None for question in made.questions)
    assert made.command.startswith("cadgraph agentbench make FOLDER --seed 3 --each 2 --preset pumps")
    again = draw(facts_of_graph(SceneGraph.load(folder / "plants" / "pumps-true")), PRESET, 3, 2)
    assert again == draw(facts_of_graph(SceneGraph.load(folder / "plants" / "pumps-true")), PRESET, 3, 2)


@pytest.mark.slow
def test_what_an_agent_gets_holds_no_answers_and_its_answers_are_scored(folder, tmp_path):
    made = read_set(folder)
    rows = [json.loads(line) for line in (folder / "questions.jsonl").read_text(encoding="utf-8").splitlines()]
    assert set(rows[0]) == {"guide", "answer as"}
    assert [row["id"] for row in rows[1:]] == [question.id for question in made.questions]
    assert all(set(row) == {"id", "plant", "form", "text"} for row in rows[1:])
    write_answers(tmp_path / "a.jsonl", {question.id: question.graph for question in made.questions[:-1]})
    given = read_answers(tmp_path / "a.jsonl", made)
    total = scores_of(made, given)["all", "true"]
    assert (total.asked, total.answered, total.agent) == (len(given) + 1, len(given), len(given))
    assert total.both == total.graph - is_right(made.questions[-1], made.questions[-1].graph, made.questions[-1].answer)


@pytest.mark.slow
def test_the_table_counts_by_type_and_the_misses_are_listed(folder):
    made = read_set(folder)
    page = to_markdown(made)
    assert "| questions | graph, true labels |" in page
    total = scores_of(made)["all", "true"]
    assert f"| **all** | {total.graph}/{total.asked} |" in page
    plain = to_json(made)["scores"]
    assert sum(row["asked"] for row in plain if row["type"] != "all") == total.asked
    wrong = [each.splitlines()[0].split(":")[0] for each in misses(made)]
    unsafe = [each.id for each in made.questions if each.leaks]
    right = {each.id for each in made.questions if is_right(each, each.graph, each.answer)}
    assert set(wrong) == {each.id for each in made.questions} - right | set(unsafe)
    assert max(Counter(wrong).values(), default=1) == 1


def run(capsys, *arguments):
    with pytest.raises(SystemExit) as end:
        agentbench(arguments, standalone_mode=True)
    return end.value.code, capsys.readouterr().out


@pytest.mark.slow
def test_the_command_scores_a_set(folder, tmp_path, capsys):
    write_answers(tmp_path / "a.jsonl", {"pumps-true/count-1": 99})
    code, text = run(capsys, "score", str(folder), "--answers", str(tmp_path / "a.jsonl"), "--misses")
    assert code == 0
    assert "agent, true labels" in text
    assert "pumps-true/count-1" in text
    assert "given  99" in text
    code, text = run(capsys, "score", str(folder / "set.jsonl"), "--json")
    assert json.loads(text)["seed"] == 3


def read_and_answer(body):
    """Finds all valves, and answers every question by their number."""
    last = body["messages"][-1]
    if last["role"] != "tool":
        return [("find", {"type": "valve"})]
    found = next(line for line in last["content"].splitlines() if line.endswith(" found"))
    return f'ANSWER: {{"value": {found.split()[0]}, "tags": []}}'


@pytest.mark.slow
def test_the_command_puts_questions_to_a_model_and_goes_on_where_it_stopped(folder, tmp_path, capsys, monkeypatch):
    monkeypatch.delenv("OPENAI_API_KEY", raising=False)
    server = ScriptedModel(read_and_answer)
    with server.running() as address:
        to = ("--model", "reader", "--base-url", address, "-o", str(tmp_path / "a.jsonl"))
        code, text = run(capsys, "run", str(folder), *to, "--max-questions", "2")
        assert code == 0
        assert "2 answers, 2 calls" in text
        assert "agent, true labels" in text
        assert run(capsys, "run", str(folder), *to, "--max-questions", "1")[0] == 0
    made = read_set(folder)
    n_valves = len(SceneGraph.load(folder / "plants" / "pumps-true").units("valve"))
    assert read_answers(tmp_path / "a.jsonl", made) == {each.id: n_valves for each in made.questions[:3]}
    assert made.questions[0].text in server.bodies[0]["messages"][-1]["content"]


def test_a_file_that_is_no_set_or_no_answer_is_refused(tmp_path):
    (tmp_path / "set.jsonl").write_text("{}\n")
    with pytest.raises(FormatError, match="not a set of questions"):
        read_set(tmp_path)
    (tmp_path / "set.jsonl").write_text("[\n")
    with pytest.raises(FormatError, match="line 1 is not JSON"):
        read_set(tmp_path)
    (tmp_path / "set.jsonl").write_text('{"format": "cadgraph-agentbench", "version": 1}\n')
    with pytest.raises(FormatError, match="made_with"):
        read_set(tmp_path)
    with pytest.raises(FormatError, match="no such file"):
        read_set(tmp_path / "gone.jsonl")


@pytest.mark.parametrize(
    ("line", "why"),
    [
        ('{"id": "a", "answer": 1}', "'a' is no question of this set"),
        ('{"id": "pumps-true/count-1"}', "a line is no answer"),
        ("[]", "line 1 is no object"),
        ('{"id": "pumps-true/count-1", "answer": 1}\n' * 2, "answered twice"),
    ],
)
@pytest.mark.slow
def test_answers_of_other_questions_are_refused(folder, tmp_path, line, why):
    (tmp_path / "a.jsonl").write_text(line + "\n")
    with pytest.raises(FormatError, match=why):
        read_answers(tmp_path / "a.jsonl", read_set(folder))


def test_unknown_presets_and_labels_are_refused_with_those_there_are(tmp_path):
    with pytest.raises(ValueError, match="unknown preset 'mill'; there are assortment, field"):
        make_set(tmp_path, presets=["mill"])
    with pytest.raises(ValueError, match="labels of true, embedded"):
        make_set(tmp_path, presets=["tank"], labels=[])
