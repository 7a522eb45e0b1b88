"""What lies in a folder of answers and answers nothing is told."""

import json
import os
from pathlib import Path

import pytest

import plates
from cadgraph.errors import LabelError
from cadgraph.labelers.lvlm.asking import Asking
from cadgraph.labelers.lvlm.cache import Cache
from cadgraph.labelers.lvlm.folder import DryRun, FolderAnswers, find_strays, read_index, read_settings, write_settings
from cadgraph.labelers.lvlm.labeler import LvlmLabeler, Way
from cadgraph.labelers.lvlm.setup import settings_of_questions
from cadgraph.labelers.lvlm.skill import check_answers, write_skill

PARTS = plates.parts_of(plates.scene_of(4, 1))
ANSWER = {"seen": "x", "group": "Pipe assembly", "name": "flange", "confidence": 0.9}


def labelled(answerer, folder):
    asking = Asking(answerer, Cache(":memory:"), size=64)
    only = isinstance(answerer, DryRun)
    labeler = LvlmLabeler(asking, Way(again_below=0), folder=folder, only_asks=only)
    return labeler.label(PARTS, plates.NO_CONTACTS, plates.VOCABULARY)


@pytest.fixture
def questions(tmp_path):
    labelled(DryRun(tmp_path / "questions"), tmp_path)
    return tmp_path / "questions"


def codes(labeling):
    return {each.code: each.message for each in labeling.diagnostics}


def answer_all(questions):
    for name in read_index(questions):
        (questions / f"q-{name}" / "answer.json").write_text(json.dumps(ANSWER))


def test_a_folder_of_answers_to_its_questions_has_no_strays(questions, tmp_path):
    answer_all(questions)
    write_settings(questions, {"lvlm.ask": "all"})
    write_skill(questions, tmp_path)
    check_answers(questions, plates.VOCABULARY)
    told = codes(labelled(FolderAnswers(questions), None))
    assert not any(code.startswith("lvlm-answers") for code in told)


def test_answers_to_other_questions_are_told_with_a_count_and_the_first_names(questions):
    answer_all(questions)
    for i in range(7):
        (questions / f"q-{i:016x}").mkdir()
        (questions / f"q-{i:016x}" / "answer.json").write_text("{}")
    (questions / "00000000000000aa.json").write_text("{}")
    (questions / f"q-{99:016x}").mkdir()  # an old question that nobody answered
    told = codes(labelled(FolderAnswers(questions), None))["lvlm-answers-unasked"]
    assert told.startswith("8 answers are to no question of this run")
    assert told.endswith("q-0000000000000002, q-0000000000000003 and 3 more")


def test_files_and_folders_that_are_no_answers_are_told(questions):
    first, second, third, _ = (questions / f"q-{name}" for name in read_index(questions))
    (questions / "notes.txt").write_text("hi")
    (questions / "q-12").mkdir()
    (first / "Answer.JSON.txt").write_text("{}")
    (second / "answers").mkdir()
    (third / "thoughts.md").write_text("hm")
    strays = find_strays(questions, set(read_index(questions)))
    assert strays.unasked == ()
    assert sorted(strays.others) == sorted(
        ["notes.txt", "q-12/", f"{first.name}/Answer.JSON.txt", f"{second.name}/answers", f"{third.name}/thoughts.md"]
    )
    with pytest.raises(LabelError, match="5 files or folders are no answers"):
        labelled(FolderAnswers(questions), None)
    (questions / f"{next(iter(read_index(questions)))}.json").write_text(json.dumps(ANSWER))
    told = codes(labelled(FolderAnswers(questions), None))["lvlm-answers-stray"]
    assert told.startswith("5 files or folders are no answers")


def test_names_of_strays_do_nothing_on_a_terminal(questions):
    (questions / "\x1b[31mred\n.txt").write_text("x")
    answer_all(questions)
    told = codes(labelled(FolderAnswers(questions), None))["lvlm-answers-stray"]
    assert "\x1b" not in told
    assert "\n" not in told


@pytest.mark.parametrize("way", ["folder", "binary", "large", "dangling"])
def test_answers_that_cannot_be_read_are_told(questions, way):
    answer_all(questions)
    path = questions / f"q-{next(iter(read_index(questions)))}" / "answer.json"
    path.unlink()
    if way == "folder":
        path.mkdir()
    elif way == "binary":
        path.write_bytes(b"\xff\xfe{}")
    elif way == "large":
        path.write_text(" " * 300_000)
    else:
        os.symlink(questions / "nowhere.json", path)
    told = codes(labelled(FolderAnswers(questions), None))
    assert told["lvlm-answers-unread"] == f"1 answer can't be read: {path.parent.name}"
    assert path.parent.name in told["lvlm-failed"]
    checked = check_answers(questions, plates.VOCABULARY)
    assert [name for name, _ in checked.malformed] == [path.parent.name]


def test_a_folder_that_nobody_may_read_is_told_and_ends_nothing(questions, monkeypatch):
    answer_all(questions)
    closed = questions / f"q-{next(iter(read_index(questions)))}"
    is_dir, iterdir = Path.is_dir, Path.iterdir

    def refuse(path, inner):
        if path == inner:
            raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "is_dir", lambda path: refuse(path, closed / "answer.json") or is_dir(path))
    monkeypatch.setattr(Path, "iterdir", lambda path: refuse(path, closed) or iterdir(path))
    told = codes(labelled(FolderAnswers(questions), None))
    assert told["lvlm-answers-unread"] == f"1 answer can't be read: {closed.name}"
    assert "Permission denied" in told["lvlm-failed"]
    assert f"{closed.name}/(can't be listed)" in told["lvlm-answers-stray"]


def test_settings_beside_questions_are_read_back(tmp_path):
    write_settings(tmp_path, {"lvlm.ask": "all", "lvlm.votes": 3})
    assert settings_of_questions(tmp_path) == {"lvlm.ask": "all", "lvlm.votes": 3}
    assert read_settings(tmp_path / "elsewhere") == {}
    write_settings(tmp_path, {"lvlm.base_url": "http://evil/v1"})
    with pytest.raises(LabelError, match=r"lvlm\.base_url"):
        settings_of_questions(tmp_path)


@pytest.mark.parametrize("content", ["[]", "nonsense", '{"q-1": []}', '{"q-00000000000000aa": 3}'])
def test_an_index_that_is_none_is_refused(tmp_path, content):
    (tmp_path / "index.json").write_text(content)
    with pytest.raises(LabelError, match=r"index\.json"):
        read_index(tmp_path)
