"""A session whose corrections lie in a file: each change is on disk before it counts."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from cadgraph._io.limits import CORRECTIONS as LIMIT
from cadgraph._io.limits import read_bytes_within
from cadgraph.errors import LabelError, OutputError
from cadgraph.model.corrections import CORRECTIONS, History, read_history, write_history
from cadgraph.model.graph import SceneGraph
from cadgraph.session.session import Change, Session

__all__ = ["Desk", "Overtaken"]


class Overtaken(Exception):
    """Another program changed the corrections; they are taken up, and what was asked for was not done."""


class Desk:
    """A session and the file of its corrections.

    Args:
        session: with the corrections of the file.
        folder: that the file lies in.
    """

    def __init__(self, session: Session, folder: Path) -> None:
        self.session = session
        self._file = folder / CORRECTIONS
        self._known = _digest(self._file)

    @property
    def graph(self) -> SceneGraph:
        """As it is now."""
        return self.session.graph

    @property
    def history(self) -> History:
        """All that was done and undone."""
        return self.session.history

    @property
    def overtaken(self) -> bool:
        """Whether another program has changed the file.

        Raises:
            LabelError: it can't be read.
        """
        return _digest(self._file) != self._known

    def take_up(self) -> None:
        """Takes the corrections up as another program left them.

        Raises:
            LabelError: they can't be read.
        """
        known = _digest(self._file)
        self._go_to(read_history(self._file, self.session.vocabulary))
        self._known = known

    def apply(self, edits: Sequence[Mapping[str, Any]], who: str, why: str) -> Change:
        """Applies edits and keeps them; all or none.

        Raises:
            LabelError: an edit can't be carried out; the corrections on disk can't be read.
            ValueError: likewise.
            OutputError: the corrections can't be kept.
            Overtaken: see there.
        """
        return self._kept(lambda: self.session.apply(edits, who=who, why=why))

    def undo(self, who: str) -> Change:
        """Takes the last action back, and keeps that; errors as those of ``apply``."""
        return self._kept(lambda: self.session.undo(who=who))

    def redo(self, who: str) -> Change:
        """Does again what was taken back last, and keeps that; errors as those of ``apply``."""
        return self._kept(lambda: self.session.redo(who=who))

    def _kept(self, act: Callable[[], Change]) -> Change:
        if self.overtaken:
            self.take_up()
            raise Overtaken
        before, graph = self.session.history, self.session.graph
        change = act()
        try:
            write_history(self.session.history, self._file)
        except OutputError:
            # What is not on disk must not be seen, nor written with what comes next.
            self._go_to(before, graph)
            raise
        self._known = _digest(self._file)
        return change

    def _go_to(self, history: History, graph: SceneGraph | None = None) -> None:
        old = self.session
        self.session = Session(
            old.analysis,
            old.labeling,
            old.config,
            vocabulary=old.vocabulary,
            given=old.given,
            corrections=history,
            graph=graph,
        )


def _digest(file: Path) -> str:
    if not file.exists():
        return ""
    content = read_bytes_within(file, LIMIT, LabelError, "take rows out, or remove it to go on without")
    return hashlib.sha256(content).hexdigest()
