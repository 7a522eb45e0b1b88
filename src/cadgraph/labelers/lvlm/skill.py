"""Questions that a person or a coding agent with eyes answers in place: how to, and a check of what was answered."""

from __future__ import annotations

import json
import shlex
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

from cadgraph._io.atomic import write_atomically
from cadgraph.errors import LabelError
from cadgraph.labelers.lvlm.answer import Answer, Malformed, read, settle
from cadgraph.labelers.lvlm.folder import (
    ANSWER_FILE,
    OPEN_FILE,
    SKILL_FILE,
    find_strays,
    read_answer,
    read_index,
    some,
)
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["Checked", "check_answers", "write_skill"]

_SHOWN = 20


@dataclass(frozen=True)
class Checked:
    """What became of the questions in a folder.

    Args:
        answered: names of the folders of questions with an answer that counts.
        open: of those without one.
        malformed: of those whose answer can't be used, with the reason.
        remarks: on answers that count otherwise than they say, with what becomes of them.
        unasked: answers to no question of the index.
        others: files and folders that are neither questions nor answers.
    """

    answered: tuple[str, ...]
    open: tuple[str, ...]
    malformed: tuple[tuple[str, str], ...]
    remarks: tuple[tuple[str, str], ...]
    unasked: tuple[str, ...]
    others: tuple[str, ...]

    @property
    def sound(self) -> bool:
        """Whether nothing needs mending; open questions are fine."""
        return not (self.malformed or self.unasked or self.others)

    @property
    def counts(self) -> str:
        """How many are what."""
        return f"{len(self.answered):,} answered, {len(self.open):,} open, {len(self.malformed):,} malformed"

    def lines(self) -> list[str]:
        """For people and programs that read a terminal."""
        lines = [self.counts]
        for heading, rows in (("malformed", self.malformed), ("remark", self.remarks)):
            lines += [f"{heading:<10}{name}: {why}" for name, why in rows[:_SHOWN]]
            lines += [f"{heading:<10}and {len(rows) - _SHOWN} more"] if len(rows) > _SHOWN else []
        lines += [f"{'unasked':<10}{some(self.unasked, _SHOWN)}: no question of the index"] if self.unasked else []
        lines += [f"{'astray':<10}{some(self.others, _SHOWN)}: no {ANSWER_FILE} of a question"] if self.others else []
        lines += [f"{'open':<10}{some(self.open, _SHOWN)}"] if self.open else []
        return lines


def check_answers(folder: Path, vocabulary: Vocabulary) -> Checked:
    """Reads every answer in a folder of questions as labelling reads it, and notes in ``open.txt`` what is open.

    Args:
        folder: of the questions, with an index.
        vocabulary: whose labels count.

    Raises:
        LabelError: the folder has no index.
        OutputError: it can't be written.
    """
    index = read_index(folder)
    answered: list[str] = []
    waiting: list[str] = []
    malformed: list[tuple[str, str]] = []
    remarks: list[tuple[str, str]] = []
    for question in index:
        name = f"q-{question}"
        try:
            text = read_answer(folder, question)
            if text is None:
                waiting.append(name)
                continue
            answer = read(text, Answer)
        except (LabelError, Malformed) as error:
            malformed.append((name, str(error)))
            continue
        answered.append(name)
        remarks += [(name, remark) for remark in _remarks(text, answer, vocabulary)]
    strays = find_strays(folder, set(index))
    write_atomically(folder / OPEN_FILE, "".join(f"{name}\n" for name in waiting))
    return Checked(
        tuple(answered), tuple(waiting), tuple(malformed), tuple(remarks), strays.unasked, strays.others
    )  # fmt: skip


def write_skill(folder: Path, output: Path) -> None:
    """Says to whoever answers, a person or a program, how: ``SKILL.md``.

    Args:
        folder: of the questions.
        output: folder of the results that they are about.
    """
    text = resources.files("cadgraph.labelers.lvlm").joinpath("skill.md").read_text(encoding="utf-8")
    for name, path in (("OUTPUT", output), ("FOLDER", folder)):
        text = text.replace(f"<{name}>", shlex.quote(str(path)))
    write_atomically(folder / SKILL_FILE, text)


def _remarks(text: str, answer: Answer, vocabulary: Vocabulary) -> list[str]:
    """What becomes of an answer that counts, where that isn't what it says."""
    content = json.loads(text[text.find("{") : text.rfind("}") + 1])
    unknown = sorted(set(content) - set(Answer.model_fields))
    missing = [name for name in Answer.model_fields if name not in content]
    told = [f"keys that nobody reads: {some(unknown)}"] if unknown else []
    told += [f"keys that are missing, taken as their defaults: {some(missing)}"] if missing else []
    verdict = settle(answer, vocabulary)
    if verdict.group is None:
        told.append("its group and name are not in the list: the part gets no label")
    elif verdict.name is None:
        told.append(f"its name is not in the list of {verdict.group!r}: only the group counts")
    if verdict.proposal is not None:
        told.append(f"proposes {verdict.proposal.group}: {verdict.proposal.name or '-'}")
    return told
