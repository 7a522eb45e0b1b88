"""One plant: the folder that it lies in, the session that it is corrected in, and what is seen of it."""

from __future__ import annotations

import gc
import threading
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from cadgraph._io.atomic import ensure_writable
from cadgraph._io.folder_lock import folder_identity
from cadgraph._io.run_folder import refuse_foreign
from cadgraph._io.text import file_name
from cadgraph.config import Config
from cadgraph.draw.web.content import shown_meshes
from cadgraph.draw.web.packing import PackedScene, pack_scene
from cadgraph.errors import CadGraphError, FormatError, LabelError, LoadError, MissingExtra, OutputError
from cadgraph.load import load
from cadgraph.model.corrections import CORRECTIONS
from cadgraph.model.graph import SceneGraph
from cadgraph.model.scene import Scene
from cadgraph.model.source_file import find_source
from cadgraph.serve.boxes import boxes_of
from cadgraph.serve.order import Order
from cadgraph.serve.saving import Saver
from cadgraph.serve.snapshot import Snapshot, difference
from cadgraph.serve.state import Feed, Refusal, State
from cadgraph.session.reopen import config_of, reopen
from cadgraph.session.review.question import Question
from cadgraph.session.review.queue import review_queue
from cadgraph.session.run import Clock, begin, write_graph, write_report_anew, write_results
from cadgraph.session.session import Change, Session
from cadgraph.stages.preprocess import prepare_scene

__all__ = ["Plant"]

_MOST_ANSWERABLE = 1000  # questions among which one is looked for that nobody has asked for before


_Saved = tuple[SceneGraph, str | None]  # a graph, and the digest of the corrections that it shows


class _Stopping(Exception):
    """The work is ended, as the server is."""


class Plant:
    """What the server shows and changes.

    Methods are called by one thread, the worker, which alone has to do with the session, but for :meth:`shown`,
    :meth:`check_ready`, :meth:`stop` and what is said to be for any thread.

    Args:
        order: what it is.
        who: name under which actions are kept.
        delay: how long after a change the graph is written [s].

    Attributes:
        feed: the state; for any thread.
    """

    def __init__(self, order: Order, who: str = "", delay: float = 2.0) -> None:
        title = order.source or order.scene
        self.feed = Feed(State(who=who, folder=order.folder.resolve().name, title=title.name if title else ""))
        self._order, self._who = order, who
        self._stopping = threading.Event()
        self._at_rest = threading.Event()
        self._at_rest.set()
        self._snapshot: Snapshot | None = None
        self._packed: PackedScene | None = None
        self._session: Session | None = None
        self._source: Path | None = None
        self._place: tuple[int, int] | None = None  # of the folder
        self._opened_with: tuple[int, int] | None = None  # which corrections
        self._not_kept = False  # whether corrections could not be kept when that was tried last
        self._behind = False  # whether the graph in the folder is another one, and writing it was put off or failed
        self._saver = Saver(self._save, self._saved, delay)
        self._failure: str | None = None
        self._questions: dict[str, Question] = {}
        self._later: set[str] = set()
        self._unsure: set[str] = set()

    # For any thread

    def shown(self) -> Snapshot:
        """The plant as it is now.

        Raises:
            Refusal: there is nothing to be seen yet.
        """
        if self._snapshot is None:
            self.check_ready()
            raise Refusal(423, "the plant is still being read")
        return self._snapshot

    @property
    def packed(self) -> PackedScene:
        """The geometry for the page.

        Raises:
            Refusal: it is not there yet.
        """
        if self._packed is None:
            raise Refusal(423, "the plant is still being read")
        return self._packed

    def check_ready(self) -> None:
        """Makes sure that the plant can be worked on.

        Raises:
            Refusal: it is still built, or could not be.
        """
        state = self.feed.state
        if state.status == "building":
            raise Refusal(423, f"the plant is still being built ({state.stage or 'it has just begun'})")
        if state.status == "failed":
            raise Refusal(503, state.message)

    def stop(self) -> None:
        """Ends what is at work at its next step, and what follows the state."""
        self._stopping.set()
        self.feed.close()

    def idle(self, patience: float) -> bool:
        """Whether the worker is at rest, now or within some seconds."""
        return self._at_rest.wait(patience)

    @property
    def unsaved(self) -> bool:
        """Whether a graph is still to be written."""
        return self._saver.pending

    def close(self) -> str | None:
        """Writes what is left to be written; why that failed, if it did."""
        self._saver.close()
        return self._failure

    # Opening

    def open(self) -> None:
        """Builds the plant or opens it again; how far it is goes into the state, and so does why it can't be."""
        self._at_rest.clear()
        self._opened_with = self._stamp()
        self.feed.publish(status="building", message="")
        try:
            if self._order.source is not None:
                self._build(self._order.source)
            else:
                self._reopen()
        except _Stopping:
            return
        except (CadGraphError, ValueError, OSError) as error:
            self.feed.publish(status="failed", stage="", message=str(error))
        except MemoryError:
            message = "there is not enough memory for this scene; close other programs, or split it"
            self.feed.publish(status="failed", stage="", message=message)
        finally:
            self._at_rest.set()

    def _stamp(self) -> tuple[int, int] | None:
        """Tells one state of the file of the corrections from another; None where there is none."""
        try:
            status = (self._order.folder / CORRECTIONS).stat()
        except OSError:
            return None
        return status.st_mtime_ns, status.st_size

    def _progress(self, stage: str, share: float) -> None:
        if self._stopping.is_set():
            raise _Stopping
        if stage:
            self.feed.publish(stage=stage, share=round(share, 3))

    def _build(self, source: Path) -> None:
        folder, config = self._order.folder, self._order.config or Config()
        clock = Clock(self._progress)
        session = begin(source, folder, config, progress=clock, keep=True)
        write_results(session.analysis.scene, session.make_graph(clock), source, folder, None, clock)
        self._see(session.graph, session.analysis.scene)
        self._source = source
        self._begin(session)

    def _reopen(self) -> None:
        folder = self._order.folder
        graph = SceneGraph.load(folder)
        self.feed.publish(title=file_name(graph.source.path))
        try:
            source, config = find_source(graph.source, folder, self._order.scene, "--scene"), config_of(folder)
            self._progress("read", 0)
            scene = load(source, config.load)
        except (LabelError, LoadError, FormatError, MissingExtra) as error:
            self._see(graph, boxes_of(graph))
            self._view_only(f"{error}. Until then parts are shown as boxes, and nothing can be corrected")
            return
        # The plant can be looked at while the rest is made ready.
        self._see(graph, prepare_scene(scene)[0])
        session = reopen(graph, folder, source, config, self._progress, scene=scene, keep=True)
        self._source = source
        now = session.make_graph(self._progress)
        shown = self.shown()
        # A server that was killed left corrections that the graph doesn't show, or another version made it. Where the
        # source lies now is no such difference.
        behind = now.document.model_copy(update={"source": graph.source}) != graph.document
        self._behind = behind
        if behind:
            self._snapshot = Snapshot(shown.version + 1, now, shown.scene)
        self._begin(session)

    def _see(self, graph: SceneGraph, scene: Scene) -> None:
        """Makes the geometry ready for the page."""
        self._progress("draw", 0)
        self._packed = pack_scene(scene, shown_meshes(graph, scene))
        self._snapshot = Snapshot(1, graph, scene)
        self.feed.publish(version=1, title=file_name(graph.source.path))

    def _begin(self, session: Session) -> None:
        # Neither the first correction nor the first question must take longer than the others.
        session.prepare()
        review_queue(session, 1)
        # What is there now stays: nobody has to look for rubbish in it at each correction.
        gc.freeze()
        self._session = session
        self._place = folder_identity(self._order.folder)
        self._look_at_disk()
        self._publish(session, status="ready", stage="", share=1.0)

    def _view_only(self, why: str) -> None:
        self.feed.publish(status="ready", stage="", share=1.0, read_only=why)

    def _look_at_disk(self) -> None:
        """Tries whether corrections could be kept, and says so."""
        try:
            self._check_place()
            ensure_writable(self._order.folder)
            refuse_foreign(self._order.folder)
        except OutputError as error:
            self._not_kept = True
            self.feed.publish(read_only=str(error))
            return
        self._not_kept = False
        self.feed.publish(read_only=None)
        if self._behind and self._session is not None and not self._saver.pending:
            self._saver.give((self._session.graph, self._session.kept))

    def _check_place(self) -> None:
        """Makes sure that nothing is written where a folder was, or where another one is now."""
        if folder_identity(self._order.folder) != self._place:
            folder = self._order.folder
            raise OutputError(f"{folder}: the folder is gone, or another one stands in its place; bring it back")

    def look(self) -> None:
        """Looks whether others changed the corrections, or whether a disk that was full has room again."""
        if self._session is None:
            # What could not be opened for damaged corrections can be, once these are others.
            if self.feed.state.status == "failed" and self._stamp() != self._opened_with:
                self.open()
            return
        try:
            if self._session.overtaken:
                self._take_up(
                    self._session, "the corrections were changed by another program; this is how they are now"
                )
            elif self._not_kept or self._behind:
                self._look_at_disk()
        except (CadGraphError, ValueError, OSError) as error:
            self._not_kept = True
            self.feed.publish(read_only=str(error))

    # What the person does

    def edit(self, version: int, edits: Sequence[Mapping[str, Any]], why: str) -> dict[str, Any]:
        """Applies edits: an update for the page.

        Args:
            version: of the content that the page shows.
            edits: as the page names them, all or none.
            why: the person's reason.

        Raises:
            Refusal: the page is behind, nothing can be changed, or the disk can't take it.
            LabelError: an edit can't be carried out.
            ValueError: likewise.
        """
        return self._act(version, lambda session: session.apply(edits, who=self._who, why=why))

    def undo(self, version: int) -> dict[str, Any]:
        """Takes the last action back; see ``edit``."""
        return self._act(version, lambda session: session.undo(who=self._who))

    def redo(self, version: int) -> dict[str, Any]:
        """Does again what was taken back last; see ``edit``."""
        return self._act(version, lambda session: session.redo(who=self._who))

    def review(self, limit: int) -> list[dict[str, Any]]:
        """What is most worth a look, without what was put aside.

        What was skipped comes again when nothing else is left; what nobody was sure of does not while the server runs.

        Args:
            limit: questions at most.
        """
        if self._session is None:
            return []
        found = review_queue(self._session, limit, self._later | self._unsure)
        if not found and self._later:
            self._later.clear()
            found = review_queue(self._session, limit, self._unsure)
        self._questions.update((question.id, question) for question in found)
        return [self._told(question) for question in found]

    def _told(self, question: Question) -> dict[str, Any]:
        """A question as the page knows it, with the rows of parts."""
        row_of = self.shown().row_of
        rows = {key: [row_of[part] for part in getattr(question, key)] for key in ("parts", "alike")}
        return {**question.to_json(), **rows}

    def answer(self, version: int, question: str, option: int | str, why: str) -> dict[str, Any]:
        """Answers a question of the review, or puts it aside; see ``edit``.

        Args:
            version: of the content that the page shows.
            question: its id.
            option: number of the option; ``skip`` or ``unsure`` put it aside, which changes nothing of the plant and so
                is no action: the audit and undo know only what changed something.
            why: the person's reason.
        """
        if isinstance(option, str):
            self._check_version(version)
            (self._later if option == "skip" else self._unsure).add(question)
            shown = self.shown()
            aside = "skipped: it comes again at the end" if option == "skip" else "put aside for this session"
            return self._update(shown, shown, (), aside)
        self._check(version)
        if question not in self._questions:
            self.review(_MOST_ANSWERABLE)
        asked = self._questions.get(question)
        if asked is None or not 0 <= option < len(asked.options):
            raise Refusal(404, "this question is no longer open, or has no such option; see the list anew")
        return self.edit(version, asked.options[option].edits, why or asked.title)

    def audit(self) -> list[Any]:
        """All that was done, the newest first."""
        return [] if self._session is None else list(self._session.history.audit())

    def draw_report(self) -> None:
        """Draws the report of the plant as it is now.

        Raises:
            OutputError: it can't be written.
        """
        session = self._session
        if session is not None and self.feed.state.read_only is None:
            self._check_place()
            write_report_anew(session, self._order.folder)

    def _act(self, version: int, act: Callable[[Session], Change]) -> dict[str, Any]:
        session = self._check(version)
        before = self.shown()
        self._at_rest.clear()
        try:
            if session.overtaken:
                reason = "the corrections were changed by another program meanwhile; look at them, then repeat yours"
                self._take_up(session, reason)
                raise Refusal(409, reason, self.feed.state)
            change = act(session)
            self._changed(session, change.message)
            return self._update(before, self.shown(), change.changed, change.message)
        except OutputError as error:
            self._not_kept = True
            self.feed.publish(read_only=str(error))
            raise Refusal(507, f"not kept, and taken back: {error}") from None
        finally:
            self._at_rest.set()

    def _check(self, version: int) -> Session:
        """The session, if it can be changed from what the page shows."""
        if self._not_kept:
            self._look_at_disk()
        why = self.feed.state.read_only
        if self._session is None or why is not None:
            raise Refusal(507, why or "nothing can be corrected here")
        self._check_version(version)
        return self._session

    def _check_version(self, version: int) -> None:
        if version != self.feed.state.version:
            reason = "another window has changed the plant meanwhile; look at it, then repeat this correction"
            raise Refusal(409, reason, self.feed.state)

    def _take_up(self, session: Session, message: str) -> None:
        """Shows the corrections that another program left."""
        session.take_up()
        self._changed(session, message)

    def _changed(self, session: Session, message: str) -> None:
        """Shows the session's graph as the next version."""
        before = self.shown()
        self._snapshot = Snapshot(before.version + 1, session.graph, before.scene)
        self._questions.clear()
        self._saver.give((session.graph, session.kept))
        self._publish(session, message=message)

    def _publish(self, session: Session, **changes: Any) -> None:
        """Tells how things are after a change."""
        history, shown = session.history, self.shown()
        undo, redo = history.to_undo, history.to_redo
        self.feed.publish(
            version=shown.version,
            can_undo=history.can_undo,
            can_redo=history.can_redo,
            undo=None if undo is None else undo.what,
            redo=None if redo is None else redo.what,
            n_edits=history.n_done,
            lost=session.lost,
            **changes,
        )

    def _update(self, before: Snapshot, now: Snapshot, changed: Sequence[Any], message: str) -> dict[str, Any]:
        told = {"version": now.version, "state": self.feed.state.to_json(), "message": message}
        return {**told, **difference(before, now, changed)}

    # Beside the work, by the saver's thread

    def _save(self, content: _Saved) -> None:
        if self._source is not None:
            self._check_place()
            graph, corrections = content
            write_graph(self.shown().scene, graph, self._source, self._order.folder, corrections)

    def _saved(self, failed: str | None) -> None:
        if failed is not None:
            self.feed.publish(message=f"corrections are kept, but the graph can't be written now: {failed}")
        elif self._failure is not None:
            self.feed.publish(message="the graph is written again")
        self._failure, self._behind = failed, failed is not None
