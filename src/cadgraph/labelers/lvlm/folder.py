"""Questions as files that people or other systems can answer: a dry run's folder, and answers read back from it."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from cadgraph._io.atomic import write_atomically
from cadgraph._io.limits import ANSWER, CONFIG, INDEX, read_text_within
from cadgraph._io.text import printable
from cadgraph.errors import LabelError
from cadgraph.labelers.lvlm.reply import Question, Reply
from cadgraph.model.diagnostic import Diagnostic

__all__ = [
    "ANSWER_FILE",
    "INDEX_FILE",
    "OPEN_FILE",
    "SETTINGS_FILE",
    "SKILL_FILE",
    "DryRun",
    "FolderAnswers",
    "Strays",
    "find_strays",
    "read_answer",
    "read_index",
    "read_settings",
    "some",
    "write_index",
    "write_question",
    "write_settings",
]

ANSWER_FILE, INDEX_FILE, OPEN_FILE = "answer.json", "index.json", "open.txt"
SETTINGS_FILE, SKILL_FILE = "settings.json", "SKILL.md"

_MESSAGE = 400  # characters of a finding
_OURS = re.compile(r"[\w.-]+\.jpg|prompt\.md|schema\.json|answer\.json|reply\.json")
_QUESTION = re.compile(r"q-([0-9a-f]{16})")
_ANSWER = re.compile(r"([0-9a-f]{16})\.json")
_MOST = 200_000  # entries of a folder that are looked at


class DryRun:
    """Writes every question to a folder and answers none.

    Args:
        folder: where to; one folder for each question is made in it.
    """

    name = "dry-run"
    looks = True
    keeps = False
    again = False

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def ask(self, question: Question) -> Reply:
        """Writes it."""
        write_question(self.folder, question)
        return Reply(None, waiting=True)

    def close(self) -> None:
        """Nothing is open."""


class FolderAnswers:
    """Reads answers beside the questions that a dry run wrote: ``q-<id>/answer.json``, or ``<id>.json``.

    Args:
        folder: that the dry run wrote.

    Raises:
        LabelError: it is no folder.
    """

    name = "folder"
    looks = False
    keeps = False
    again = False

    def __init__(self, folder: Path) -> None:
        if not folder.is_dir():
            raise LabelError(
                f"{folder}: no such folder; give the one that --dry-run wrote, with an answer.json in each"
            )
        self.folder = folder
        self._asked: set[str] = set()
        self._unreadable: set[str] = set()

    def ask(self, question: Question) -> Reply:
        """Reads its answer, if there is one."""
        self._asked.add(question.id)
        try:
            text = read_answer(self.folder, question.id)
        except LabelError as error:
            self._unreadable.add(f"q-{question.id}")
            return Reply(None, error=str(error))
        return Reply(text, waiting=text is None)

    def close(self) -> None:
        """Nothing is open."""

    def findings(self) -> tuple[Diagnostic, ...]:
        """What lies in the folder and is no answer to a question of this run, and what can't be read."""
        strays = find_strays(self.folder, self._asked)
        rows = (
            ("lvlm-answers-unread", "can't be read", sorted(self._unreadable)),
            ("lvlm-answers-unasked", "to no question of this run: other settings, scene or vocabulary", strays.unasked),
            (
                "lvlm-answers-stray",
                "no answers, in the folder of answers; write answer.json into the folder of the question",
                strays.others,
            ),
        )
        return tuple(
            Diagnostic(code, f"{len(names)} {_nouns(code, len(names))} {words}: {some(names)}"[:_MESSAGE])
            for code, words, names in rows
            if names
        )


def _nouns(code: str, n: int) -> str:
    if code == "lvlm-answers-stray":
        return f"file{'s' * (n != 1)} or folder{'s' * (n != 1)} {'are' if n != 1 else 'is'}"
    return f"answer{'s' * (n != 1)}" + ("" if code == "lvlm-answers-unread" else f" {'are' if n != 1 else 'is'}")


@dataclass(frozen=True)
class Strays:
    """What lies in a folder of answers and answers nothing that was asked.

    Args:
        unasked: answers to other questions, by name of their folder or file.
        others: files and folders that are neither questions nor answers.
    """

    unasked: tuple[str, ...]
    others: tuple[str, ...]


def find_strays(folder: Path, asked: set[str]) -> Strays:
    """What lies in a folder of answers and answers none of these questions.

    Args:
        folder: that a dry run wrote.
        asked: ids of questions. Those of other runs that have no answer may lie there.
    """
    unasked: list[str] = []
    others: list[str] = []
    for _, path in zip(range(_MOST), sorted(folder.iterdir()), strict=False):
        question, answer = _QUESTION.fullmatch(path.name), _ANSWER.fullmatch(path.name)
        if question is not None and path.is_dir():
            if question.group(1) not in asked and os.path.lexists(path / ANSWER_FILE):
                unasked.append(path.name)
            others += [f"{path.name}/{inner}" for inner in _foreign(path)]
        elif answer is not None and path.is_file():
            unasked += [path.name] if answer.group(1) not in asked else []
        elif path.name not in (INDEX_FILE, OPEN_FILE, SETTINGS_FILE, SKILL_FILE):
            others.append(path.name + "/" * path.is_dir())
    return Strays(tuple(unasked), tuple(others))


def _foreign(folder: Path) -> list[str]:
    """What no question brings, and no answer is called."""
    try:
        names = [path.name for _, path in zip(range(_MOST), sorted(folder.iterdir()), strict=False)]
    except OSError:
        return ["(can't be listed)"]
    return [name for name in names if not _OURS.fullmatch(name)]


def read_answer(folder: Path, question: str) -> str | None:
    """The text of the answer to a question; None where there is none.

    Args:
        folder: that a dry run wrote.
        question: its id.

    Raises:
        LabelError: it can't be read.
    """
    for path in (folder / f"q-{question}" / ANSWER_FILE, folder / f"{question}.json"):
        try:
            if path.is_dir():
                raise LabelError(f"{path}: a folder; write the answer as a file of this name")
            if path.is_file() or path.is_symlink():
                return read_text_within(path, ANSWER, LabelError, "write the answer alone")
        except OSError as error:
            raise LabelError(f"{path}: can't be read ({error.strerror}); change its permissions") from error
    return None


def some(names: Sequence[str], most: int = 5) -> str:
    """The first few of some names, which may be anybody's, for a message."""
    shown = ", ".join(printable(name, "?") for name in names[:most])
    return f"{shown} and {len(names) - most} more" if len(names) > most else shown


def write_question(folder: Path, question: Question, *, reply: Reply | None = None) -> Path:
    """Writes a question, its pictures and maybe the reply into a folder of its own, each file whole or not at all.

    Returns:
        That folder.

    Raises:
        OutputError: it can't be written.
    """
    own = folder / f"q-{question.id}"
    pictures = question.pictures()
    for picture in pictures:
        write_atomically(own / f"{picture.name}.jpg", picture.draw())
    shown = "\n".join(f"{picture.caption}\n\n![{picture.name}]({picture.name}.jpg)\n" for picture in pictures)
    write_atomically(own / "prompt.md", f"{question.system}\n\n{question.text}\n\n{shown}")
    write_atomically(own / "schema.json", json.dumps(question.schema, indent=1) + "\n")
    if reply is not None:
        content = {"text": reply.text, "refusal": reply.refusal, "error": reply.error}
        write_atomically(own / "reply.json", json.dumps(content, ensure_ascii=False, indent=1) + "\n")
    return own


def write_index(folder: Path, rows: Sequence[tuple[str, Sequence[str]]]) -> None:
    """Says which parts each question stands for: ``index.json``, question by source paths.

    Parts that look alike among neighbours that do may have one question though they are of several kinds.
    """
    index: dict[str, list[str]] = {}
    for question, paths in rows:
        index.setdefault(f"q-{question}", []).extend(paths)
    write_atomically(folder / INDEX_FILE, json.dumps(index, ensure_ascii=False, indent=1) + "\n")


def read_index(folder: Path) -> dict[str, list[str]]:
    """What :func:`write_index` wrote: ids of questions, and the source paths that each stands for.

    Raises:
        LabelError: it can't be read or is none.
    """
    path = folder / INDEX_FILE
    remedy = "write the questions with 'cadgraph ask-folder'"
    content = _json(path, read_text_within(path, INDEX, LabelError, remedy, remedy))
    found: dict[str, list[str]] = {}
    for name, paths in content.items():
        question = _QUESTION.fullmatch(name)
        if question is None or not isinstance(paths, list):
            raise LabelError(f"{path}: {name[:40]!r} is no question; write the questions anew")
        found[question.group(1)] = [str(one) for one in paths]
    return found


def write_settings(folder: Path, settings: dict[str, Any]) -> None:
    """Keeps the settings that questions follow from beside them, so that their answers are found again."""
    write_atomically(folder / SETTINGS_FILE, json.dumps(settings, ensure_ascii=False, indent=1) + "\n")


def read_settings(folder: Path) -> dict[str, Any]:
    """What :func:`write_settings` wrote; nothing where it wrote nothing.

    Raises:
        LabelError: it can't be read or is no object.
    """
    path = folder / SETTINGS_FILE
    if not path.is_file():
        return {}
    return _json(path, read_text_within(path, CONFIG, LabelError, "write the questions anew"))


def _json(path: Path, text: str) -> dict[str, Any]:
    try:
        content = json.loads(text)
    except (ValueError, RecursionError):
        content = None
    if not isinstance(content, dict):
        raise LabelError(f"{path}: no JSON object; write the questions anew")
    return content
