"""Questions that an agent answers in place, and the check of what it answered."""

import json
import re
import shlex

import pytest

import plates
from cadgraph.errors import LabelError
from cadgraph.labelers.lvlm.answer import Answer, answer_schema
from cadgraph.labelers.lvlm.skill import check_answers, write_skill

IDS = [f"{i:016x}" for i in range(5)]
GOOD = {
    "seen": "a disc", "group": "Pipe assembly", "name": "flange", "propose_group": None, "propose_name": None,
    "reason": None, "confidence": 0.9,
}  # fmt: skip


@pytest.fixture
def folder(tmp_path):
    for each in IDS:
        (tmp_path / f"q-{each}").mkdir()
    (tmp_path / "index.json").write_text(json.dumps({f"q-{each}": ["/a"] for each in IDS}))
    return tmp_path


def answer(folder, i, content):
    text = content if isinstance(content, str) else json.dumps(content)
    (folder / f"q-{IDS[i]}" / "answer.json").write_text(text)


def check(folder):
    return check_answers(folder, plates.VOCABULARY)


def test_what_is_open_is_listed_and_noted_in_the_order_of_the_index(folder):
    answer(folder, 1, GOOD)
    found = check(folder)
    assert found.answered == (f"q-{IDS[1]}",)
    assert found.open == tuple(f"q-{IDS[i]}" for i in (0, 2, 3, 4))
    assert (folder / "open.txt").read_text().split() == list(found.open)
    assert found.sound
    assert found.lines()[0] == "1 answered, 4 open, 0 malformed"


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("a flange, I think", "no JSON object"),
        ("", "empty"),
        ('{"group": "Pipe assembly"', "no JSON object"),
        ('{"group": }', "not valid JSON"),
        ({"seen": "x", "name": "flange", "confidence": 0.5}, "group"),
        (GOOD | {"confidence": "sure"}, "confidence"),
        (GOOD | {"confidence": 1e9}, "confidence"),
        (GOOD | {"name": ["flange"]}, "name"),
        (GOOD | {"seen": "x" * 30_000}, "longer than"),
    ],
)
def test_an_answer_that_cannot_be_used_is_listed_with_the_reason(folder, content, words):
    answer(folder, 0, content)
    found = check(folder)
    ((name, why),) = found.malformed
    assert name == f"q-{IDS[0]}"
    assert words in why
    assert not found.sound
    assert name not in found.open


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"mood": "fine"}, "keys that nobody reads: mood"),
        ({"name": "warp core"}, "only the group counts"),
        ({"group": "Spaceship", "name": "warp core"}, "no label"),
        ({"propose_group": "Tank", "propose_name": "agitator", "reason": "r"}, "proposes Tank: agitator"),
    ],
)
def test_an_answer_that_counts_otherwise_than_it_says_has_a_remark(folder, changes, words):
    answer(folder, 0, GOOD | changes)
    found = check(folder)
    assert any(words in why for _, why in found.remarks)
    assert found.answered == (f"q-{IDS[0]}",)


def test_an_answer_with_fewer_keys_counts_and_has_a_remark(folder):
    answer(folder, 0, {"group": "Pipe assembly", "name": "flange"})
    ((_, why),) = check(folder).remarks
    assert "missing" in why
    assert "confidence" in why


def test_strays_are_listed_and_make_the_check_fail(folder):
    (folder / "q-ffffffffffffffff").mkdir()
    (folder / "q-ffffffffffffffff" / "answer.json").write_text(json.dumps(GOOD))
    (folder / "todo.md").write_text("x")
    found = check(folder)
    assert (found.unasked, found.others) == (("q-ffffffffffffffff",), ("todo.md",))
    assert not found.sound


def test_long_lists_are_cut(folder):
    for i in range(5):
        answer(folder, i, "no")
    assert len(check(folder).lines()) == 6


def test_a_folder_without_an_index_is_no_folder_of_questions(tmp_path):
    with pytest.raises(LabelError, match="ask-folder"):
        check(tmp_path)


def test_the_skill_names_this_folder_and_shows_an_answer_as_the_schema_asks(tmp_path):
    folder = tmp_path / "a plant"
    write_skill(folder / "questions", folder)
    text = (folder / "questions" / "SKILL.md").read_text()
    assert text.startswith("---\nname: cadgraph-questions\ndescription: ")
    commands = [shlex.split(line) for line in re.findall(r"^cadgraph .*$", text, re.MULTILINE)]
    assert commands == [
        ["cadgraph", "ask-folder", str(folder), "--to", str(folder / "questions"), "--check"],
        ["cadgraph", "label", str(folder), "--from-folder", str(folder / "questions")],
    ]
    (shown,) = re.findall(r"```json\n(.*?)```", text, re.DOTALL)
    example = json.loads(shown)
    assert list(example) == list(answer_schema(plates.VOCABULARY)["properties"])
    Answer.model_validate(example)
