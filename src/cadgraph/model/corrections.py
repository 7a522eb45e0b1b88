"""A user's corrections beside a graph (``corrections.json``): all that was ever done and undone, and what is in force.

A correction is kept under source paths of meshes together with numbers that no motion changes, so that it finds its
parts again when the source is exported anew, and is not laid on others by mistake. Nothing is ever taken out of the
file: what is undone is noted behind what was done.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, Literal, TypedDict

from cadgraph._io import limits
from cadgraph._io.atomic import write_atomically
from cadgraph._io.folder_lock import folder_identity
from cadgraph._io.json_rows import json_rows
from cadgraph._io.limits import read_bytes_within, size_text
from cadgraph._io.results import settle_if_free
from cadgraph._io.staging import result_path
from cadgraph._io.text import printable
from cadgraph.errors import LabelError, OutputError
from cadgraph.model.anchors import Fingerprint
from cadgraph.model.corrections_json import FORMAT, MOST, VERSION, check_row, event_row, read_document
from cadgraph.model.edits import Correction, Edit, describe, fold, with_correction
from cadgraph.model.vocabulary import Vocabulary, spell_label

__all__ = [
    "CORRECTIONS",
    "Action",
    "AuditRow",
    "Correction",
    "CorrectionsFile",
    "Fingerprint",
    "History",
    "read_corrections",
    "read_history",
    "with_correction",
    "write_corrections",
    "write_history",
]

CORRECTIONS = "corrections.json"
"""Name of the file beside the graph."""

_LONGEST_WHO, _LONGEST_WHY = 200, 2000  # characters; what is longer is cut


@dataclass(frozen=True)
class Action:
    """One thing that a user did: a correction of one or several things at once, or taking one back.

    Args:
        id: its number in the history, from 1.
        when: ISO 8601, UTC; empty where unknown.
        who: name of the user; may be empty.
        why: the reason that was given; may be empty.
        what: in words, as it was when it was done.
        edits: what was corrected; none for what undoes or redoes.
        kind: ``do``, ``undo`` or ``redo``.
        of: id of the action that is undone or redone; None for one that does something.
    """

    id: int
    when: str
    who: str
    why: str
    what: str
    edits: tuple[Edit, ...] = ()
    kind: Literal["do", "undo", "redo"] = "do"
    of: int | None = None


class AuditRow(TypedDict):
    """A row of the list of all that was done: id, when, who, what, why, and whether it is undone now."""

    id: int
    when: str
    who: str
    what: str
    why: str
    undone: bool


@dataclass(frozen=True)
class History:
    """All that a user did, in order; it only ever grows. Each change gives a new history.

    Args:
        events: in the order in which they happened.
    """

    events: tuple[Action, ...] = ()

    @classmethod
    def of(cls, edits: Iterable[Edit]) -> History:
        """A history of edits of which nothing else is known, each an action."""
        return cls(tuple(Action(k, "", "", "", describe(edit), (edit,)) for k, edit in enumerate(edits, 1)))

    @cached_property
    def _stacks(self) -> tuple[tuple[Action, ...], tuple[Action, ...]]:
        """The actions that are done, and those that are undone, the latest last in both."""
        done: list[Action] = []
        undone: list[Action] = []
        for event in self.events:
            if event.kind == "do":
                done.append(event)
                undone.clear()
                continue
            source, target = (done, undone) if event.kind == "undo" else (undone, done)
            if not source or source[-1].id != event.of:
                raise LabelError(
                    f"event {event.id}: {event.kind} of action {event.of}, which isn't the one to {event.kind}"
                )
            target.append(source.pop())
        return tuple(done), tuple(undone)

    def check(self) -> None:
        """Makes sure that what is undone and redone was there to be.

        Raises:
            LabelError: it wasn't.
        """
        _ = self._stacks

    @cached_property
    def in_force(self) -> tuple[Edit, ...]:
        """What counts now, in the order in which it was done; of two about the same the later one."""
        return fold(edit for action in self._stacks[0] for edit in action.edits)

    @property
    def n_done(self) -> int:
        """How many actions are in force: as often as one can undo."""
        return len(self._stacks[0])

    @property
    def to_undo(self) -> Action | None:
        """The action that ``undo`` takes back; None where there is none."""
        return self._stacks[0][-1] if self._stacks[0] else None

    @property
    def to_redo(self) -> Action | None:
        """The action that ``redo`` does again; None where there is none."""
        return self._stacks[1][-1] if self._stacks[1] else None

    @property
    def can_undo(self) -> bool:
        """Whether anything is done."""
        return self.to_undo is not None

    @property
    def can_redo(self) -> bool:
        """Whether anything was undone since something was done last."""
        return self.to_redo is not None

    def do(self, edits: Sequence[Edit], what: str, *, when: str = "", who: str = "", why: str = "") -> History:
        """The history with another action.

        Args:
            edits: what is corrected.
            what: in words.
            when: ISO 8601, UTC.
            who: name of the user.
            why: the reason.
        """
        return self._with(
            Action(self._next, when, _line(who, _LONGEST_WHO), _line(why, _LONGEST_WHY), what, tuple(edits))
        )

    def undo(self, *, when: str = "", who: str = "", why: str = "") -> History:
        """The history in which the last action is taken back.

        Raises:
            ValueError: there is none.
        """
        return self._step("undo", self.to_undo, when, who, why)

    def redo(self, *, when: str = "", who: str = "", why: str = "") -> History:
        """The history in which what was undone last is done again.

        Raises:
            ValueError: nothing was undone since the last action.
        """
        return self._step("redo", self.to_redo, when, who, why)

    def audit(self) -> list[AuditRow]:
        """All that was done, undone and done again, the latest first."""
        in_force = {action.id for action in self._stacks[0]}
        return [
            AuditRow(
                id=event.id,
                when=event.when,
                who=event.who,
                what=event.what,
                why=event.why,
                undone=event.kind == "do" and event.id not in in_force,
            )
            for event in reversed(self.events)
        ]

    @property
    def may_come(self) -> tuple[Action, ...]:
        """The actions that are in force, or can be done again."""
        return self._stacks[0] + self._stacks[1]

    @property
    def _next(self) -> int:
        return self.events[-1].id + 1 if self.events else 1

    def _step(self, kind: Literal["undo", "redo"], action: Action | None, when: str, who: str, why: str) -> History:
        if action is None:
            raise ValueError(f"nothing to {kind}")
        what = f"{'undone' if kind == 'undo' else 'done again'}: {action.what}"
        who, why = _line(who, _LONGEST_WHO), _line(why, _LONGEST_WHY)
        return self._with(Action(self._next, when, who, why, what, (), kind, action.id))

    def _with(self, event: Action) -> History:
        if len(self.events) >= MOST:
            raise ValueError(f"{MOST:,} corrections were made, and no more are kept; build into another folder")
        return History((*self.events, event))


def _line(text: str, most: int) -> str:
    """A text on one line, cut where it is too long."""
    return printable(text).strip()[:most]


def write_history(history: History, path: str | Path) -> Path:
    """Writes all that was done, whole or not at all; it is on the disk when this returns.

    Args:
        history: the same one gives the same bytes.
        path: the file.

    Raises:
        OutputError: it can't be written, or would be larger than what is read.
    """
    CorrectionsFile(path, None).write(history)
    return Path(path)


def write_corrections(corrections: Sequence[Edit], path: str | Path) -> Path:
    """Writes corrections of which nothing else is known; see ``write_history``."""
    return write_history(History.of(corrections), path)


def read_history(path: str | Path, vocabulary: Vocabulary | None = None) -> History:
    """Reads all that was done; an empty history if the file isn't there.

    Args:
        path: the file, or the folder that holds it; of this version, or of the first one, which held labels alone.
        vocabulary: must hold the labels that are in force or may be done again; None asks nothing.

    Raises:
        LabelError: the file can't be read, is damaged, or names labels that the vocabulary lacks.
    """
    return CorrectionsFile(path).read(vocabulary)


def read_corrections(path: str | Path, vocabulary: Vocabulary | None = None) -> tuple[Edit, ...]:
    """Reads the corrections that are in force; see ``read_history`` for arguments and errors."""
    return read_history(path, vocabulary).in_force


@dataclass
class CorrectionsFile:
    """A file of corrections that is written again and again, and that nobody else may change meanwhile.

    Args:
        path: the file, or the folder that holds it; it need not be there.
        known: digest of its content as it was last read or written; None overwrites whatever is there.
    """

    path: str | Path
    known: str | None = field(default="")
    _home: tuple[int, int] | None = field(default=None, init=False, repr=False)
    _readable: int = field(default=0, init=False, repr=False)  # rows at the start of which it is known that they are

    @cached_property
    def file(self) -> Path:
        """The file itself."""
        path = Path(self.path)
        return path / CORRECTIONS if path.is_dir() else path

    def read(self, vocabulary: Vocabulary | None = None) -> History:
        """Reads it; see ``read_history``."""
        settle_if_free(self.file.parent)
        content = self._content()
        history = History() if content is None else self._parsed(content, vocabulary)
        # Only now: what can't be read must not be written over.
        self.known, self._readable = _digest(content), len(history.events)
        return history

    def _parsed(self, content: bytes, vocabulary: Vocabulary | None) -> History:
        history = History(tuple(Action(**row) for row in read_document(content, self.file)))
        try:
            history.check()
        except LabelError as error:
            raise LabelError(
                f"{self.file}: {error}; take the file from a copy, or remove it to build without"
            ) from None
        for action in history.may_come if vocabulary is not None else ():
            _check_labels(action, vocabulary, self.file)
        return history

    @property
    def overtaken(self) -> bool:
        """Whether somebody else has written it since it was read or written here.

        Raises:
            LabelError: it can't be read, or its folder is gone.
        """
        return self.known is not None and _digest(self._content()) != self.known

    def write(self, history: History) -> None:
        """Writes it whole or not at all; it is on the disk when this returns.

        Raises:
            OutputError: it can't be written, or somebody else has written it since it was read here.
        """
        if self.overtaken:
            raise OutputError(
                f"{self.file}: another program has corrected something here meanwhile; open the folder again and "
                "repeat this correction"
            )
        rows = [event_row(vars(event)) for event in history.events]
        self._check(rows)
        document = {"format": FORMAT, "version": VERSION, "events": rows}
        content = json_rows(document, rows=("events",))
        if len(content) > limits.CORRECTIONS.most:
            most = size_text(limits.CORRECTIONS.most)
            raise OutputError(f"{self.file}: would be larger than the {most} that are read; build into another folder")
        write_atomically(self.file, content, durable=True)
        if self.known is not None:
            self.known = _digest(content)

    def _check(self, rows: Sequence[Mapping[str, Any]]) -> None:
        """Refuses what could not be read again; of rows that were there before that is known."""
        first = min(self._readable, len(rows))
        try:
            for k, row in enumerate(rows[first:], first + 1):
                check_row(row, f"{self.file}: correction {k}")
        except LabelError as error:
            raise OutputError(f"{error}, so it can't be kept") from None
        self._readable = len(rows)

    def _content(self) -> bytes | None:
        place = folder_identity(self.file.parent)
        if self._home is None:
            self._home = place
        if place != self._home:
            raise LabelError(f"{self.file.parent}: the folder is gone, or another one is in its place; bring it back")
        remedy = "take rows out, or remove it to build without"
        if self.file.is_fifo():
            # Reading would wait for somebody who writes to it.
            raise LabelError(f"{self.file}: a pipe; {remedy}")
        # Twice, as somebody may move the file to its place at this moment.
        for _ in range(2):
            try:
                return read_bytes_within(result_path(self.file), limits.CORRECTIONS, LabelError, remedy)
            except LabelError as error:
                if not isinstance(error.__cause__, FileNotFoundError):
                    raise
        return None


def _digest(content: bytes | None) -> str:
    return "" if content is None else hashlib.sha256(content).hexdigest()


def _check_labels(action: Action, vocabulary: Vocabulary | None, file: Path) -> None:
    for edit in action.edits:
        if isinstance(edit, Correction) and vocabulary is not None and not vocabulary.holds(edit.group, edit.name):
            label = spell_label(edit.group, edit.name)
            raise LabelError(
                f"{file}: correction {action.id}: {label!r} is not in the vocabulary; build with the --vocabulary "
                "that has it, or take the row out"
            )
