"""One scene being worked on: what geometry says of it is kept, so that a correction costs little."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from functools import partial
from typing import Any

import numpy as np

from cadgraph._io.progress import Progress, quiet
from cadgraph.config import Config
from cadgraph.labelers.base import AskingLabeler, Labeler, Labeling, label_parts
from cadgraph.labelers.corrections import prepare_corrections
from cadgraph.labelers.former import settings_with
from cadgraph.labelers.precedence import SettledLabels, lay_corrections, lay_known
from cadgraph.labelers.registry import labeler_of
from cadgraph.model.analysis import Analysis
from cadgraph.model.catalog import read_catalog
from cadgraph.model.corrections import CorrectionsFile, History
from cadgraph.model.crew import Crew
from cadgraph.model.edits import LOST, Correction, Edit, Tag, tell_lost
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.graph import SceneGraph
from cadgraph.model.parts import Parts
from cadgraph.model.records import Part
from cadgraph.model.scene import Scene
from cadgraph.model.vocabulary import Vocabulary, default_vocabulary
from cadgraph.pipeline import analyse, as_read, check_asked, contradicted, ground_as_said, interpret, lay_ground
from cadgraph.session.requests import EditRequest, Requests, read_requests
from cadgraph.session.told import tell_flow, tell_followers, tell_lines, tell_renamed, tell_units

__all__ = ["Change", "Session"]

_MOST_GROUNDS = 4  # analyses with another ground that are kept, so that undoing costs nothing


@dataclass(frozen=True)
class Change:
    """What a correction, or taking one back, changed.

    Args:
        part: the corrected part as it is now; None where it is no single part that was corrected.
        changed: all parts with another label than before, as they are now.
        message: what was done, in words.
        regrouped: whether parts themselves, or what structure they are in, may be others than before.
    """

    part: Part | None
    changed: tuple[Part, ...]
    message: str = ""
    regrouped: bool = False


@dataclass(frozen=True, eq=False)
class _State:
    """All of a session that a correction changes."""

    history: History
    analysis: Analysis
    labeling: Labeling
    known: SettledLabels | None
    graph: SceneGraph | None


class Session:
    """A scene, its analysis, what a labeler said, a user's corrections, and the graph that follows from all of them.

    A correction makes the graph anew without reading, measuring or labelling anything again. Not for several threads
    at once.

    Args:
        analysis: of the scene.
        labeling: what a labeler said of its parts.
        config: all settings; the defaults if None.
        vocabulary: the tree that the labels are from; the built-in one if None.
        given: labels of source meshes from outside.
        corrections: made before, of which nothing else is known.
        history: of all corrections made before, in place of ``corrections``.
        file: that each correction is written to before it counts; None keeps them in memory alone.
        labeler: is asked again where the ground changes, and parts with it; None, or one that asks a model, is not:
            what it said of parts stays with them.

    Raises:
        LabelError: a label names a mesh that is not in the scene, or a catalogue can't be read.
    """

    def __init__(
        self,
        analysis: Analysis,
        labeling: Labeling,
        config: Config | None = None,
        *,
        vocabulary: Vocabulary | None = None,
        given: Sequence[GivenLabel] = (),
        corrections: Sequence[Edit] = (),
        history: History | None = None,
        file: CorrectionsFile | None = None,
        labeler: Labeler | None = None,
    ) -> None:
        self.analysis, self.labeling = analysis, labeling
        self.config, self.vocabulary = config or Config(), vocabulary or default_vocabulary()
        self.given = tuple(given)
        self._history = History.of(corrections) if history is None else history
        self._file, self._labeler = file, labeler
        self._known: SettledLabels | None = None
        self._graph: SceneGraph | None = None
        self._grounds: dict[bytes, tuple[Analysis, Labeling]] = {}
        self._follow_ground()

    @classmethod
    def start(
        cls,
        scene: Scene,
        config: Config | None = None,
        *,
        labels: Sequence[GivenLabel] = (),
        vocabulary: Vocabulary | None = None,
        labeler: Labeler | None = None,
        corrections: Sequence[Edit] = (),
        history: History | None = None,
        file: CorrectionsFile | None = None,
        progress: Progress = quiet,
        crew: Crew | None = None,
    ) -> Session:
        """Analyses a scene and asks a labeler about its parts; see ``cadgraph.build`` for arguments and errors."""
        config, tree = config or Config(), vocabulary or default_vocabulary()
        config = as_read(scene, config)
        check_asked(tree, labeler, labels, corrections)
        config = settings_with(config, labeler)
        history = History.of(corrections) if history is None else history
        analysis = lay_ground(analyse(scene, config, progress, crew), history.in_force, config)
        progress("label", 0)
        labeler = labeler or labeler_of(config.label)
        if isinstance(labeler, AskingLabeler):
            labeler.contradictions = partial(contradicted, analysis, tree, config)
        labeling = label_parts(labeler, analysis.parts, analysis.contacts, tree, config.label)
        return cls(
            analysis,
            labeling,
            config,
            vocabulary=tree,
            given=labels,
            history=history,
            file=file,
            labeler=labeler,
        )

    @property
    def history(self) -> History:
        """All that was corrected, undone and done again."""
        return self._history

    @property
    def corrections(self) -> tuple[Edit, ...]:
        """Those in force, in the order in which they were made."""
        return self._history.in_force

    @property
    def lost(self) -> tuple[str, ...]:
        """The corrections in force that no longer fit the scene, in words, each with the reason."""
        return tuple(one.message for one in self.graph.diagnostics if one.code == LOST)

    @property
    def graph(self) -> SceneGraph:
        """The graph as it is now."""
        return self.make_graph()

    def make_graph(self, progress: Progress = quiet) -> SceneGraph:
        """The graph as it is now, made if anything has changed since it was asked for.

        Args:
            progress: called with the name of a stage and the share of it that is done.

        Raises:
            LabelError: a given label names a mesh that is not in the scene, or a catalogue can't be read.
        """
        if self._graph is None:
            if self._known is None:
                catalogs = [read_catalog(file) for file in self.config.label.catalogs]
                self._known = lay_known(
                    self.labeling, self.analysis, self.vocabulary, self.config.label, catalogs, self.given
                )
            labels = lay_corrections(self._known, self.labeling, self.analysis, self.corrections)
            self._graph = interpret(
                self.analysis, labels, self.vocabulary, self.config, progress, edits=self.corrections
            )
        return self._graph

    def prepare(self) -> None:
        """Works out now what else the first correction does: the graph, and how parts are alike.

        What serves people calls it before it says that it is ready.
        """
        self.make_graph()
        prepare_corrections(self.analysis.parts, self.analysis.contacts)

    def apply(self, edits: Sequence[Mapping[str, Any] | EditRequest], *, who: str = "", why: str = "") -> Change:
        """Corrects one or several things at once; all of it or, where one can't be carried out, nothing.

        Args:
            edits: one object each with its ``kind`` and, by the ids of the graph, what it is about: ``label``
                (``part``, ``group``, ``name``, ``this_only``), ``forget`` (``part``), ``merge``, ``split`` (``parts``),
                ``join`` and ``cut`` (``first``, ``second``), ``direction`` (``source``, ``target``, ``via``,
                ``flow``), ``tag`` (``unit``, ``tag``), ``device`` (``unit``, ``device``), ``ground`` (``part``,
                ``ground``).
            who: name of the user.
            why: the reason.

        Returns:
            What changed. With a file, the correction is on the disk by then.

        Raises:
            KeyError: the graph has no such part, unit or place.
            ValueError: a correction can't be carried out; the message says why.
            LabelError: the vocabulary has no such label.
            OutputError: the file can't be written, or another program has written it.
        """
        requests = read_requests(edits)
        corrected = {edit.mesh for edit in self.corrections if isinstance(edit, Correction)}
        tags = {edit.tag for edit in self.corrections if isinstance(edit, Tag)}
        graph = self.graph
        anchored, what = Requests(graph, self.analysis, self.vocabulary, corrected, tags).anchor(requests)
        history = self._history.do(anchored, what, when=_now(), who=who, why=why)
        named = {getattr(request, "part", None) for request in requests}
        only = named.pop() if len(named) == 1 else None
        return self._become(history, what, anchored, None if only is None else graph.part(only).meshes[0])

    @contextmanager
    def trial(self) -> Iterator[None]:
        """Within the block corrections are tried out: none is written, and at its end all is as it was before."""
        self.make_graph()
        old, file = self._state, self._file
        self._file = None
        try:
            yield
        finally:
            self._take_back(old)
            self._file = file

    def correct(self, part: str, label: str, *, this_only: bool = False, who: str = "", why: str = "") -> Change:
        """Says what a part is; its repeats follow, and softly what is much like it.

        Args:
            part: id of the part, or source path of one of its meshes.
            label: ``group/name``, a group, or a name that only one group has.
            this_only: whether others keep their labels.
            who: name of the user.
            why: the reason.

        Raises:
            KeyError: the graph has no such part.
            LabelError: the vocabulary has no such label.
        """
        return self.apply([{"kind": "label", "part": part, "group": label, "this_only": this_only}], who=who, why=why)

    def forget(self, part: str, *, who: str = "", why: str = "") -> Change:
        """Takes the correction of a part back.

        Args:
            part: id of the part, or source path of one of its meshes.
            who: name of the user.
            why: the reason.

        Raises:
            KeyError: the graph has no such part.
            ValueError: nobody corrected this part itself.
        """
        return self.apply([{"kind": "forget", "part": part}], who=who, why=why)

    @property
    def can_undo(self) -> bool:
        """Whether any correction is done."""
        return self._history.can_undo

    @property
    def can_redo(self) -> bool:
        """Whether anything was undone since the last correction."""
        return self._history.can_redo

    def undo(self, *, who: str = "", why: str = "") -> Change:
        """Takes the last correction, or the last taking back of one, back.

        Raises:
            ValueError: there is none.
            OutputError: the file can't be written, or another program has written it.
        """
        history = self._history.undo(when=_now(), who=who, why=why)
        return self._become(history, history.events[-1].what)

    def redo(self, *, who: str = "", why: str = "") -> Change:
        """Does again what was undone last.

        Raises:
            ValueError: nothing was undone since the last correction.
            OutputError: the file can't be written, or another program has written it.
        """
        history = self._history.redo(when=_now(), who=who, why=why)
        return self._become(history, history.events[-1].what)

    @property
    def kept(self) -> str | None:
        """Digest of the file of the corrections as it was last read or written; None where they are in memory alone."""
        return None if self._file is None else self._file.known

    @property
    def overtaken(self) -> bool:
        """Whether another program has changed the file of the corrections.

        Raises:
            LabelError: it can't be read.
        """
        return self._file is not None and self._file.overtaken

    def take_up(self) -> Change:
        """Takes the corrections up as another program left them in the file.

        Raises:
            LabelError: they can't be read; nothing changes then.
            ValueError: the session keeps none in a file.
        """
        if self._file is None:
            raise ValueError("the corrections of this session are in no file")
        history = self._file.read(self.vocabulary)
        return self._become(history, "corrections of another program", write=False)

    def relabel(self, labeler: Labeler | None, given: Sequence[GivenLabel] | None = None) -> None:
        """Asks another labeler about all parts; corrections stay.

        Args:
            labeler: None asks nobody.
            given: labels from outside in place of those so far; None keeps them.

        Raises:
            LabelError: the labeler can't answer.
        """
        parts, contacts = self.analysis.parts, self.analysis.contacts
        self.labeling = label_parts(labeler, parts, contacts, self.vocabulary, self.config.label)
        self.given = self.given if given is None else tuple(given)
        self._labeler = labeler
        self._grounds.clear()
        self._known = self._graph = None

    def _become(
        self, history: History, what: str, new: Sequence[Edit] = (), mesh: str | None = None, *, write: bool = True
    ) -> Change:
        """Takes another history on, if its graph can be made and it can be written; else nothing changes."""
        before = self.graph
        old = self._state
        try:
            self._history, self._graph = history, None
            self._follow_ground()
            now = self.graph
            _refuse_unmet(now, new, what)
            changed = changed_parts(before, now)
            told = what if not write else _told(what, before, now, new, changed)
            if new:
                # What follows from a correction is part of what was done: nobody else tells later.
                last = replace(history.events[-1], what=told)
                self._history = history = replace(history, events=(*history.events[:-1], last))
            if self._file is not None and write:
                self._file.write(history)
        except BaseException:
            # A correction that no graph shows, or no file holds, must not wait for a later one.
            self._take_back(old)
            raise
        part = None if mesh is None else now.part(mesh)
        return Change(part, changed, told, self.analysis is not old.analysis)

    @property
    def _state(self) -> _State:
        return _State(self._history, self.analysis, self.labeling, self._known, self._graph)

    def _take_back(self, old: _State) -> None:
        self._history, self.analysis, self.labeling = old.history, old.analysis, old.labeling
        self._known, self._graph = old.known, old.graph

    def _follow_ground(self) -> None:
        """Lets parts and structures follow from the ground as it is now; what was made before is kept for a while."""
        former, wanted = self.analysis, ground_as_said(self.analysis, self.corrections)
        if wanted is None or former.ground is None:
            return
        self._grounds[former.ground.tobytes()] = former, self.labeling
        while len(self._grounds) > _MOST_GROUNDS:
            del self._grounds[next(iter(self._grounds))]
        known = self._grounds.pop(wanted.tobytes(), None)
        if known is None:
            analysis = lay_ground(former, self.corrections, self.config)
            known = analysis, self._labeled(analysis)
        self.analysis, self.labeling = known
        self._known = self._graph = None

    def _labeled(self, analysis: Analysis) -> Labeling:
        """What the labeler says of parts that others may have been before."""
        if self._labeler is None or isinstance(self._labeler, AskingLabeler):
            return _carried(self.labeling, self.analysis.parts, analysis.parts)
        return label_parts(self._labeler, analysis.parts, analysis.contacts, self.vocabulary, self.config.label)


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds").replace("+00:00", "Z")


def _told(what: str, before: SceneGraph, now: SceneGraph, new: Sequence[Edit], changed: Sequence[Part]) -> str:
    """What was done, and what came of it; of what is only undone or done again that was told when it was done."""
    if not new:
        return f"{what}; {len(changed):,} label{'s' * (len(changed) != 1)} changed" if changed else what
    named = [now.part_with(edit.mesh) for edit in new if isinstance(edit, Correction)]
    followers = tell_followers([part for part in named if part is not None], changed)
    renamed = tell_renamed(before, now, {edit.tag for edit in new if isinstance(edit, Tag)})
    came = tell_units(before, now), tell_flow(before, now), renamed, tell_lines(before, now)
    return "; ".join(filter(None, (what, followers, *came)))


def _refuse_unmet(graph: SceneGraph, new: Sequence[Edit], what: str) -> None:
    """Makes sure that new edits are carried out.

    Args:
        graph: with them.
        new: edits.
        what: they are, by tags and ids of the graph: who asks knows no paths of meshes.

    Raises:
        ValueError: one isn't.
    """
    lost = [one.message for one in graph.diagnostics if one.code == LOST] if new else []
    for edit in new:
        start = tell_lost(edit, "")
        unmet = next((message for message in lost if message.startswith(start)), None)
        if unmet is not None:
            raise ValueError(f"{what}: {unmet.removeprefix(start)}")


def _carried(labeling: Labeling, before: Parts, after: Parts) -> Labeling:
    """What was said of parts, for parts that others may have been made of since: each by its largest mesh."""
    number = {path: part for part, path in enumerate(before.scene.paths)}
    rows = [number.get(path) for path in after.scene.paths]
    known, sure = labeling.probabilities, labeling.sure
    if known is not None:
        values = np.zeros((len(rows), known.values.shape[1]))
        for part, row in enumerate(rows):
            if row is not None:
                values[part] = known.values[row]
        known = replace(known, values=values)
    return replace(
        labeling,
        labels=tuple(None if row is None else labeling.labels[row] for row in rows),
        guesses=tuple(() if row is None else labeling.guesses[row] for row in rows),
        answers=tuple(None if row is None else labeling.answers[row] for row in rows),
        thresholds=tuple(0.0 if row is None else labeling.thresholds[row] for row in rows),
        sure=tuple(0.0 if row is None else sure[row] for row in rows) if isinstance(sure, tuple) else sure,
        probabilities=known,
    )


def changed_parts(before: SceneGraph, now: SceneGraph) -> tuple[Part, ...]:
    """The parts of the second graph whose label is another one than in the first.

    Args:
        before: a graph.
        now: one of the same scene, maybe of other parts.
    """
    old = {mesh: _said(part) for part in before.parts() for mesh in part.meshes}
    return tuple(part for part in now.parts() if _said(part) != old.get(part.meshes[0]))


def _said(part: Part) -> tuple[str, str | None] | None:
    return part.label.said if part.label is not None else None
