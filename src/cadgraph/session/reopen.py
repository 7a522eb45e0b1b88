"""Going on with a finished graph: its scene, settings, vocabulary and labels taken up again from its folder."""

from __future__ import annotations

from pathlib import Path

from cadgraph._io.progress import Progress, quiet
from cadgraph._io.run_folder import results_folder
from cadgraph.config import Config, restore_config
from cadgraph.errors import FormatError
from cadgraph.labelers.base import AskingLabeler, Labeler
from cadgraph.labelers.former import FormerLabeler, former_labeler
from cadgraph.load import load
from cadgraph.model.corrections import CorrectionsFile
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import GivenEvidence
from cadgraph.model.scene import Scene
from cadgraph.model.source_file import find_source
from cadgraph.model.vocabulary import Vocabulary
from cadgraph.session.run import Clock, Outcome, check_layers, check_target, write_results
from cadgraph.session.session import Session

__all__ = ["config_of", "relabel", "reopen", "vocabulary_of"]


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
        session = _taken_up(graph, target, source, config, labeler, clock)
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
    progress: Progress = quiet,
    *,
    scene: Scene | None = None,
    keep: bool = False,
) -> Session:
    """A session on the scene of a finished graph, with its vocabulary, its labels and its corrections.

    Args:
        graph: finished.
        target: the folder that it lies in; with its corrections.
        source: the scene's file, see :func:`~cadgraph.model.source_file.find_source`.
        config: its settings.
        progress: called with the name of a stage and the share of it that is done.
        scene: what ``load`` makes of the source, if it is at hand.
        keep: whether each correction is written into the folder at once, before the session says that it is done.

    Raises:
        LabelError: the corrections can't be read.
        LoadError: the scene can't be read.
        OutputError: a result would take the place of a file of the scene.
    """
    labeler = former_labeler(graph, config)
    return _taken_up(graph, target, source, config, labeler, progress, scene=scene, keep=keep)


def _taken_up(
    graph: SceneGraph,
    target: Path,
    source: Path,
    config: Config,
    labeler: Labeler | None,
    progress: Progress,
    *,
    scene: Scene | None = None,
    keep: bool = False,
) -> Session:
    """Likewise, with another labeler or the one that is set; labels from outside are kept."""
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
