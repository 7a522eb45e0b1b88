"""Questions as files that people or other systems can answer: a dry run's folder, and answers read back from it."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from cadgraph._io.atomic import write_atomically
from cadgraph._io.limits import ANSWER, read_text_within
from cadgraph.errors import LabelError
from cadgraph.labelers.lvlm.reply import Question, Reply

__all__ = ["DryRun", "FolderAnswers", "write_question"]


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

    def ask(self, question: Question) -> Reply:
        """Reads its answer, if there is one."""
        for path in (self.folder / f"q-{question.id}" / "answer.json", self.folder / f"{question.id}.json"):
            if not path.is_file():
                continue
            try:
                return Reply(read_text_within(path, ANSWER, LabelError, "write the answer alone"))
            except LabelError as error:
                return Reply(None, error=f"of q-{question.id}: {error}")
        return Reply(None, waiting=True)

    def close(self) -> None:
        """Nothing is open."""


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
    """Says which parts each question stands for: ``index.json``, question by source paths."""
    write_atomically(
        folder / "index.json",
        json.dumps({f"q-{q}": list(paths) for q, paths in rows}, ensure_ascii=False, indent=1) + "\n",
    )
