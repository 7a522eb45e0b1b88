"""One scene being worked on: what geometry says of it is kept, so that a change of labels costs little."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

from cadgraph._io.progress import Progress, quiet
from cadgraph.config import Config
from cadgraph.labelers.base import AskingLabeler, Labeler, Labeling, label_parts
from cadgraph.labelers.corrections import prepare_corrections
from cadgraph.labelers.precedence import SettledLabels, lay_corrections, lay_known
from cadgraph.labelers.registry import labeler_of
from cadgraph.model.analysis import Analysis
from cadgraph.model.catalog import read_catalog
from cadgraph.model.corrections import Correction, Fingerprint, with_correction
from cadgraph.model.given_labels import GivenLabel, split_label
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Part
from cadgraph.model.scene import Scene
from cadgraph.model.vocabulary import Vocabulary, default_vocabulary
from cadgraph.pipeline import analyse, contradicted, interpret

__all__ = ["Change", "Session"]


@dataclass(frozen=True)
class Change:
    """What a correction, or taking one back, changed.

    Args:
        part: the corrected part as it is now; None where several corrections changed at once.
        changed: all parts with another label than before, as they are now.
    """

    part: Part | None
    changed: tuple[Part, ...]


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
        corrections: made before.
        graph: that follows from all this, where it is at hand.

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
        corrections: Sequence[Correction] = (),
        graph: SceneGraph | None = None,
    ) -> None:
        self.analysis, self.labeling = analysis, labeling
        self.config, self.vocabulary = config or Config(), vocabulary or default_vocabulary()
        self.given = tuple(given)
        self._corrections = tuple(corrections)
        self._done: list[tuple[Correction, ...]] = []
        self._undone: list[tuple[Correction, ...]] = []
        self._known: SettledLabels | None = None
        self._graph = graph

    @classmethod
    def start(
        cls,
        scene: Scene,
        config: Config | None = None,
        *,
        labels: Sequence[GivenLabel] = (),
        vocabulary: Vocabulary | None = None,
        labeler: Labeler | None = None,
        corrections: Sequence[Correction] = (),
        graph: SceneGraph | None = None,
        progress: Progress = quiet,
    ) -> Session:
        """Analyses a scene and asks a labeler about its parts; see ``cadgraph.build`` for arguments and errors."""
        config, tree = config or Config(), vocabulary or default_vocabulary()
        analysis = analyse(scene, config, progress)
        progress("label", 0)
        labeler = labeler or labeler_of(config.label)
        if isinstance(labeler, AskingLabeler):
            labeler.contradictions = partial(contradicted, analysis, tree, config)
        labeling = label_parts(labeler, analysis.parts, analysis.contacts, tree, config.label)
        return cls(analysis, labeling, config, vocabulary=tree, given=labels, corrections=corrections, graph=graph)

    @property
    def corrections(self) -> tuple[Correction, ...]:
        """Those in force, in the order in which they were made."""
        return self._corrections

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
            labels = lay_corrections(self._known, self.labeling, self.analysis, self._corrections)
            self._graph = interpret(self.analysis, labels, self.vocabulary, self.config, progress)
        return self._graph

    def prepare(self) -> None:
        """Works out now what else the first correction does: the graph, and how parts are alike.

        What serves people calls it before it says that it is ready.
        """
        self.make_graph()
        prepare_corrections(self.analysis.parts, self.analysis.contacts)

    def correct(self, part: str, label: str, *, this_only: bool = False) -> Change:
        """Says what a part is; its repeats follow, and softly what is much like it.

        Args:
            part: id of the part, or source path of one of its meshes.
            label: ``group/name``, a group, or a name that only one group has.
            this_only: whether others keep their labels.

        Raises:
            KeyError: the graph has no such part.
            LabelError: the vocabulary has no such label.
        """
        node = self.graph.part(part)
        new = _correction(node, split_label(label, self.vocabulary), this_only)
        return self._change(with_correction(self._corrections, new), node)

    def forget(self, part: str) -> Change:
        """Takes the correction of a part back.

        Args:
            part: id of the part, or source path of one of its meshes.

        Raises:
            KeyError: the graph has no such part.
            ValueError: nobody corrected this part itself.
        """
        node = self.graph.part(part)
        kept = tuple(one for one in self._corrections if one.mesh not in node.meshes)
        if len(kept) == len(self._corrections):
            raise ValueError(f"{part}: nobody corrected this part itself; 'cadgraph explain' names the one that was")
        return self._change(kept, node)

    @property
    def can_undo(self) -> bool:
        """Whether anything was corrected or taken back in this session."""
        return bool(self._done)

    @property
    def can_redo(self) -> bool:
        """Whether anything was undone since the last correction."""
        return bool(self._undone)

    def undo(self) -> Change:
        """Takes the last correction, or the last taking back of one, back.

        Raises:
            ValueError: there is none.
        """
        if not self._done:
            raise ValueError("nothing to undo")
        return self._step(self._done, self._undone)

    def redo(self) -> Change:
        """Does again what was undone last.

        Raises:
            ValueError: nothing was undone since the last correction.
        """
        if not self._undone:
            raise ValueError("nothing to redo")
        return self._step(self._undone, self._done)

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
        self._known = self._graph = None

    def _change(self, corrections: tuple[Correction, ...], node: Part) -> Change:
        before, old = self.graph, self._corrections
        self._corrections, self._graph = corrections, None
        try:
            now = self.graph
        except BaseException:
            # A correction that no graph shows must not wait for a later one.
            self._corrections, self._graph = old, before
            raise
        self._done.append(old)
        self._undone.clear()
        return Change(now.part(node.meshes[0]), changed_parts(before, now))

    def _step(self, source: list[tuple[Correction, ...]], target: list[tuple[Correction, ...]]) -> Change:
        before = self.graph
        target.append(self._corrections)
        self._corrections, self._graph = source.pop(), None
        return Change(None, changed_parts(before, self.graph))


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


def _correction(part: Part, label: tuple[str, str | None], this_only: bool) -> Correction:
    extents = part.obb.extents
    fingerprint = Fingerprint(part.n_triangles, (math.sqrt(part.area), extents[0], extents[1], extents[2]))
    return Correction(part.meshes[0], *label, fingerprint, part.centroid, this_only)
