"""Going on with a finished graph: its scene, settings, vocabulary and labels taken up again from its folder."""

from __future__ import annotations

from pathlib import Path

from cadgraph._io.progress import Progress, quiet
from cadgraph._io.run_folder import results_folder
from cadgraph.config import Config, restore_config
from cadgraph.errors import FormatError
from cadgraph.labelers.base import AskingLabeler, Labeler, Labeling
from cadgraph.load import load
from cadgraph.load.source_file import find_source
from cadgraph.model.corrections import CorrectionsFile
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import CorrectedEvidence, FileEvidence, GeometryEvidence, GivenEvidence, Label
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.records import Part
from cadgraph.model.scene import Scene
from cadgraph.model.vocabulary import Vocabulary
from cadgraph.session.run import Clock, Outcome, check_layers, check_target, write_results
from cadgraph.session.session import Session

__all__ = ["FormerLabeler", "config_of", "relabel", "reopen", "vocabulary_of"]


def relabel(
    folder: str | Path,
    config: Config,
    labeler: Labeler | None,
    *,
    scene: str | Path | None = None,
    report: bool = True,
    progress: Progress = quiet,
) -> Outcome:
    """Builds the graph in a folder again with another labeler; labels that were given from outside are kept.

    Parts that a model was asked about without an answer keep the labels they had. Where no answer can come in this run
    (a dry run, requests for a batch) the folder's results stay as they are.

    Args:
        folder: what ``cadgraph build`` wrote; written over.
        config: all settings, :func:`config_of` the folder with changes.
        labeler: the new one; the embedded one if None.
        scene: the source, where it isn't where the graph says.
        report: whether to draw pictures and write the report.
        progress: called with the name of a stage and the share of it that is done.

    Raises:
        LoadError: the source isn't there, or has changed.
        FormatError: the folder holds no graph.
    """
    clock = Clock(progress)
    with results_folder(folder) as target:
        graph = SceneGraph.load(target)
        source = find_source(graph.source, target, scene, "--scene")
        if isinstance(labeler, AskingLabeler):
            labeler.former = FormerLabeler(graph)
        session = reopen(graph, target, source, config, labeler, clock)
        if isinstance(labeler, AskingLabeler) and labeler.only_asks:
            clock("", 1)
            return Outcome(graph, {}, clock.seconds)
        after = session.make_graph(clock)
        return write_results(session.analysis.scene, after, source, target, config.report if report else None, clock)


def reopen(
    graph: SceneGraph,
    target: Path,
    source: Path,
    config: Config,
    labeler: Labeler | None,
    progress: Progress = quiet,
    *,
    scene: Scene | None = None,
    keep: bool = False,
) -> Session:
    """A session on the scene of a finished graph, with its vocabulary, the labels given from outside, its corrections.

    Args:
        graph: finished.
        target: the folder that it lies in; with its corrections.
        source: the scene's file, see :func:`~cadgraph.load.source_file.find_source`.
        config: all settings.
        labeler: says what the parts are; the one that is set if None.
        progress: called with the name of a stage and the share of it that is done.
        scene: what ``load`` makes of the source, if it is at hand.
        keep: whether each correction is written into the folder at once, before the session says that it is done.

    Raises:
        LabelError: the corrections can't be read.
        LoadError: the scene can't be read.
        OutputError: a result would take the place of a file of the scene.
    """
    check_target(source, target)
    tree = Vocabulary.from_json(graph.vocabulary, f"{target}: vocabulary of the graph")
    file = CorrectionsFile(target)
    history = file.read(tree)
    if scene is None:
        progress("read", 0)
        scene = load(source, config.load)
    check_layers(source, target, config.load.asset_roots)
    return Session.start(
        scene,
        config,
        labels=_given(graph),
        vocabulary=tree,
        labeler=labeler,
        history=history,
        file=file if keep else None,
        progress=progress,
    )


def _given(graph: SceneGraph) -> list[GivenLabel]:
    """The labels that came from outside."""
    found = []
    for part in graph.parts():
        if part.label is not None and part.label.source == "author":
            evidence = part.label.evidence
            mesh = evidence.mesh if isinstance(evidence, GivenEvidence) else None
            found.append(GivenLabel(mesh or part.meshes[0], *part.label.said))
    return found


def config_of(folder: str | Path) -> Config:
    """The settings that the graph in a folder was built with.

    Raises:
        FormatError: the folder holds no graph, or one with settings that aren't known any more.
    """
    try:
        return restore_config(SceneGraph.load(folder).config)
    except ValueError as error:
        raise FormatError(f"{folder}: its settings can't be used any more ({error}); build the graph anew") from error


def vocabulary_of(folder: str | Path) -> Vocabulary:
    """The label tree that the graph in a folder was built with.

    Raises:
        FormatError: the folder holds no graph.
    """
    return Vocabulary.from_json(SceneGraph.load(folder).vocabulary, f"{folder}: vocabulary of the graph")


class FormerLabeler:
    """Gives the labels of a finished graph again, as they were before corrections: a model's answers cost money.

    Args:
        graph: finished.
    """

    def __init__(self, graph: SceneGraph) -> None:
        self._graph = graph

    def label(self, parts: Parts, contacts: Contacts, vocabulary: Vocabulary) -> Labeling:
        """Labels parts; see ``cadgraph.labelers.base.Labeler``."""
        former = [self._graph.part_with(parts.scene.paths[i]) for i in range(parts.n_parts)]
        labels = tuple(_former_label(part) for part in former)
        guesses = tuple(
            part.guesses if part is not None and label is None else ()
            for part, label in zip(former, labels, strict=True)
        )
        return Labeling(labels, guesses, labels, (0.0,) * len(labels))


def _former_label(part: Part | None) -> Label | None:
    """What a labeler said of a part, before anybody corrected it."""
    label = part.label if part is not None else None
    if label is None or label.source in ("author", "catalog"):
        return None
    evidence = label.evidence
    if isinstance(evidence, GeometryEvidence) and evidence.file is not None:
        # The file has its say anew.
        without = {"confidence": evidence.file.without, "evidence": evidence.model_copy(update={"file": None})}
        return label.model_copy(update=without)
    if not isinstance(evidence, CorrectedEvidence | FileEvidence):
        return label.model_copy(update={"guesses": part.guesses if part is not None else ()})
    old = evidence.before
    if old is None:
        return None
    kept = {} if old.why is None else {"why": old.why}
    return Label(old.group, old.name, 0.0 if old.confidence is None else old.confidence, old.source or "", kept)
