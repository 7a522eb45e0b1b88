"""A set of questions as a file, which others can publish on, and the files that go to and come from an agent.

JSON lines. The first row of a set says what it is and how to make it again; a row for each plant follows, then one for
each question with both its answers. It holds nothing of the plants' geometry.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from cadgraph._io.atomic import write_atomically
from cadgraph._io.limits import QUESTIONS, read_text_within
from cadgraph.errors import FormatError
from cadlab.agentbench.questions import GUIDE, Question

__all__ = ["PlantRow", "QuestionSet", "read_answers", "read_set", "write_answers", "write_questions", "write_set"]

FORMAT = "cadgraph-agentbench"
VERSION = 1


@dataclass(frozen=True)
class PlantRow:
    """A plant that questions are about.

    Args:
        name: of its folder.
        preset: of the generator.
        seed: of the plant.
        labels: ``true`` or ``embedded``.
        tags: true id of each unit of the graph that stands for one, by tag.
        lost: true ids of the units that the graph lacks.
        never: tags of the valves that are in truth check, control or relief valves.
        isolations: how many units of the graph the tools say what isolates: all are asked about, not only some.
        safe: of which the valves hold in truth: none is a check, control or relief valve, and nothing is left open.
        digest: SHA-256 of the graph.
    """

    name: str
    preset: str
    seed: int
    labels: str
    tags: Mapping[str, str]
    lost: tuple[str, ...]
    never: tuple[str, ...]
    isolations: int
    safe: int
    digest: str


@dataclass(frozen=True)
class QuestionSet:
    """Plants, and questions about them.

    Args:
        seed: that both were made from.
        each: most questions of a type about a plant.
        made_with: version of cadgraph, whose tools gave the graph's answers.
        plants: in order.
        questions: in order.
    """

    seed: int
    each: int
    made_with: str
    plants: tuple[PlantRow, ...]
    questions: tuple[Question, ...]

    @property
    def command(self) -> str:
        """What makes the set and its plants again."""
        presets = " ".join(f"--preset {name}" for name in dict.fromkeys(plant.preset for plant in self.plants))
        labels = " ".join(f"--labels {name}" for name in dict.fromkeys(plant.labels for plant in self.plants))
        return f"cadgraph agentbench make FOLDER --seed {self.seed} --each {self.each} {presets} {labels}"


def write_set(path: Path, questions: QuestionSet) -> None:
    """Writes a set; the same set gives the same bytes.

    Raises:
        OutputError: it can't be written.
    """
    head = {
        "format": FORMAT,
        "version": VERSION,
        "seed": questions.seed,
        "each": questions.each,
        "made_with": f"cadgraph {questions.made_with}",
        "make": questions.command,
        "guide": GUIDE,
    }
    plants = ({"plant": asdict(plant)} for plant in questions.plants)
    rows = ({"question": _question_row(question)} for question in questions.questions)
    _write(path, [head, *plants, *rows])


def write_questions(path: Path, questions: QuestionSet) -> None:
    """Writes what an agent gets: the guide and the questions, without the answers.

    Raises:
        OutputError: it can't be written.
    """
    rows = [{"id": each.id, "plant": each.plant, "form": each.form, "text": each.text} for each in questions.questions]
    _write(path, [{"guide": GUIDE, "answer as": '{"id": "...", "answer": ...}, one a line'}, *rows])


def write_answers(path: Path, answers: Mapping[str, Any]) -> None:
    """Writes answers by id of the question.

    Raises:
        OutputError: it can't be written.
    """
    _write(path, [{"id": name, "answer": answer} for name, answer in answers.items()])


def read_set(path: Path) -> QuestionSet:
    """Reads a set.

    Args:
        path: ``set.jsonl``, or the folder that it lies in.

    Raises:
        FormatError: it is missing or no set; the text names the line.
    """
    path = path / "set.jsonl" if path.is_dir() else path
    rows = list(_read(path))
    if not rows or rows[0].get("format") != FORMAT or rows[0].get("version") != VERSION:
        raise FormatError(f"{path}: not a set of questions; 'cadgraph agentbench make' writes one (set.jsonl)")
    head = rows[0]
    try:
        plants = [PlantRow(**_frozen(row["plant"], "lost", "never")) for row in rows if "plant" in row]
        questions = [Question(**row["question"]) for row in rows if "question" in row]
        made_with = str(head["made_with"]).removeprefix("cadgraph ")
        return QuestionSet(int(head["seed"]), int(head["each"]), made_with, tuple(plants), tuple(questions))
    except (KeyError, TypeError, ValueError) as error:
        raise FormatError(f"{path}: a row lacks or has what it shouldn't ({error}); make the set again") from None


def read_answers(path: Path, questions: QuestionSet) -> dict[str, Any]:
    """Reads an agent's answers by id of the question.

    Raises:
        FormatError: it is missing, a line is no answer, or one answers no question of this set or one twice.
    """
    known = {question.id for question in questions.questions}
    answers: dict[str, Any] = {}
    for row in _read(path):
        if "id" not in row or "answer" not in row:
            raise FormatError(f'{path}: a line is no answer; each reads {{"id": "...", "answer": ...}}')
        name = str(row["id"])
        if name not in known:
            raise FormatError(f"{path}: {name!r} is no question of this set; give the answers to its own questions")
        if name in answers:
            raise FormatError(f"{path}: {name!r} is answered twice; keep one answer")
        answers[name] = row["answer"]
    return answers


def _question_row(question: Question) -> dict[str, Any]:
    row = asdict(question)
    return {key: value for key, value in row.items() if value is not None or key in ("answer", "graph")}


def _frozen(row: Mapping[str, Any], *keys: str) -> dict[str, Any]:
    return {key: tuple(value) if key in keys else value for key, value in row.items()}


def _write(path: Path, rows: Iterable[Mapping[str, Any]]) -> None:
    lines = (json.dumps(row, ensure_ascii=False, allow_nan=False) for row in rows)
    write_atomically(path, "".join(f"{line}\n" for line in lines).encode("utf-8", "backslashreplace"))


def _read(path: Path) -> Iterator[dict[str, Any]]:
    text = read_text_within(path, QUESTIONS, FormatError, "give a file of 'cadgraph agentbench'")
    for number, line in enumerate(text.split("\n"), 1):
        if not line.strip():
            continue
        try:
            row = json.loads(line)
        except (ValueError, RecursionError) as error:
            raise FormatError(f"{path}: line {number} is not JSON ({error})") from None
        if not isinstance(row, dict):
            raise FormatError(f"{path}: line {number} is no object")
        yield row
