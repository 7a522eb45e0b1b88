"""One run from file to folder: read, analyse, label, interpret, write everything."""

from __future__ import annotations

import json
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from cadgraph._io.atomic import write_atomically
from cadgraph._io.progress import Progress, quiet
from cadgraph._io.run_folder import clear_results, refuse_to_overwrite, results_folder
from cadgraph.config import Config
from cadgraph.labelers.base import AskingLabeler, Labeler
from cadgraph.load import load
from cadgraph.model.corrections import CorrectionsFile
from cadgraph.model.given_labels import GivenLabel, read_labels
from cadgraph.model.graph import SceneGraph
from cadgraph.model.scene import Scene
from cadgraph.model.vocabulary import Vocabulary, default_vocabulary, read_vocabulary
from cadgraph.pipeline import STAGES
from cadgraph.session.session import Session

__all__ = ["RUN_STAGES", "Outcome", "begin", "run", "write_graph", "write_rest", "write_results"]

RUN_STAGES = ("read", *STAGES, "write graph", "write labels", "draw report")
"""The names that ``run`` gives to its progress, in order."""


@dataclass(frozen=True)
class Outcome:
    """What a run made.

    Args:
        graph: the scene graph.
        files: what was written, by purpose (``"graph"``, ``"labels"``, ``"report"``, ``"picture"``, ``"timings"``).
        seconds: wall time of each stage [s].
    """

    graph: SceneGraph
    files: dict[str, Path]
    seconds: dict[str, float] = field(default_factory=dict)


def run(
    source: str | Path,
    folder: str | Path,
    config: Config | None = None,
    *,
    labels: str | Path | Sequence[GivenLabel] | None = None,
    vocabulary: str | Path | Vocabulary | None = None,
    labeler: Labeler | None = None,
    report: bool = True,
    progress: Progress = quiet,
) -> Outcome:
    """Reads a scene, builds its graph, and writes ``graph.json``, ``semantics.usda``, ``report.html`` and pictures.

    Each file is written whole or not at all; the folder is tried before the work begins, and results of an earlier run
    in it are removed before the first new one is written. Corrections that lie in the folder are applied again. Where
    a model is only to be asked in this run and answers later (a dry run, requests for a batch), a graph that is there
    already stays as it is.

    Args:
        source: the scene's file.
        folder: where the results go; made if missing.
        config: all settings; the defaults if None.
        labels: labels from outside, or a file of them.
        vocabulary: another label tree, or a file with it.
        labeler: another labeler than the one that is set.
        report: whether to draw pictures and write the report.
        progress: called with the name of a stage and the share of it that is done.

    Raises:
        LoadError: the scene can't be read.
        LabelError: labels or vocabulary can't be used.
        OutputError: the folder can't be written, or a result would take the place of a file that isn't ours.
    """
    config = config or Config()
    clock = Clock(progress)
    with results_folder(folder) as target:
        tree = vocabulary if isinstance(vocabulary, Vocabulary) else _tree(vocabulary)
        given = read_labels(labels, tree) if isinstance(labels, str | Path) else labels or ()
        session = begin(source, target, config, given, tree, labeler, clock)
        if isinstance(labeler, AskingLabeler) and labeler.only_asks and (target / "graph.json").exists():
            clock("", 1)
            return Outcome(SceneGraph.load(target), {}, clock.seconds)
        return write_results(session, source, target, report, clock)


def begin(
    source: str | Path,
    target: Path,
    config: Config,
    given: Sequence[GivenLabel] = (),
    vocabulary: Vocabulary | None = None,
    labeler: Labeler | None = None,
    progress: Progress = quiet,
    *,
    keep: bool = False,
) -> Session:
    """A session on a scene that is read anew, with the corrections that lie in a folder; nothing is written yet.

    Args:
        source: the scene's file.
        target: the folder for its results; it exists.
        config: all settings.
        given: labels from outside.
        vocabulary: the label tree; the built-in one if None.
        labeler: another labeler than the one that is set.
        progress: called with the name of a stage and the share of it that is done.
        keep: whether each correction is written into the folder at once, before the session says that it is done.

    Raises:
        LoadError: the scene can't be read.
        LabelError: labels or corrections can't be used.
        OutputError: a result would take the place of a file of the scene.
    """
    check_target(source, target)
    tree = vocabulary or default_vocabulary()
    file = CorrectionsFile(target)
    history = file.read(tree)
    progress("read", 0)
    scene = load(source, config.load)
    check_layers(source, target, config.load.asset_roots)
    return Session.start(
        scene,
        config,
        labels=given,
        vocabulary=tree,
        labeler=labeler,
        history=history,
        file=file if keep else None,
        progress=progress,
    )


def write_results(session: Session, source: str | Path, target: Path, report: bool, clock: Clock) -> Outcome:
    """Writes the graph of a session and what goes with it into a folder, over the results of an earlier run.

    Args:
        session: whose graph it is.
        source: the scene's file.
        target: the folder; it exists.
        report: whether to draw pictures and write the report.
        clock: takes the time of each stage.

    Raises:
        OutputError: a file can't be written.
    """
    from cadgraph.export.usd import write_semantics

    graph, scene = session.make_graph(clock), session.analysis.scene
    clock("write graph", 0)
    clear_results(target)
    graph.save(target / "graph.json")
    clock("write labels", 0)
    write_semantics(scene, graph, source, target / "semantics.usda")
    return write_rest(session, target, report, clock)


def write_rest(session: Session, target: Path, report: bool, clock: Clock) -> Outcome:
    """Writes what is made from a graph that stands in its folder: the report, and how long everything took.

    Args:
        session: whose graph it is.
        target: the folder with the graph.
        report: whether to draw pictures and write the report.
        clock: takes the time of each stage.

    Raises:
        OutputError: a file can't be written.
    """
    graph = session.graph
    files = {"graph": target / "graph.json", "labels": target / "semantics.usda"}
    if report:
        from cadgraph.draw.report import write_report

        clock("draw report", 0)
        report_file = target / "report.html"
        files["report"] = write_report(session.analysis.scene, graph, report_file, session.config.report, clock)
        files["picture"] = target / "picture.png"
    clock("", 1)
    files["timings"] = target / "timings.json"
    write_atomically(files["timings"], json.dumps(clock.seconds, indent=1) + "\n")
    return Outcome(graph, files, clock.seconds)


def write_graph(scene: Scene, graph: SceneGraph, source: str | Path, target: Path) -> None:
    """Writes another graph of the same scene over the one in a folder, and the label layer with it.

    Whenever the process ends, the folder holds one of the two graphs, whole. The report and its picture, which would
    show the graph as it was, are removed.

    Args:
        scene: all meshes that the graph is of.
        graph: finished.
        source: the scene's file.
        target: the folder; it exists.

    Raises:
        OutputError: a file can't be written.
        LoadError: the source can't be opened any more.
    """
    from cadgraph.export.usd import write_semantics

    clear_results(target, ("report.html", "picture.png"))
    write_semantics(scene, graph, source, target / "semantics.usda")
    # Last, as the folder is taken for finished where it holds this graph.
    graph.save(target / "graph.json")


def check_target(source: str | Path, target: Path) -> None:
    """Refuses a folder in which a result would take the place of the source.

    Args:
        source: the scene's file.
        target: the folder.

    Raises:
        OutputError: it would.
    """
    from cadgraph.export.usd import check_source

    refuse_to_overwrite(target, [source], "the source itself")
    check_source(source, target / "semantics.usda")


def check_layers(source: str | Path, target: Path, asset_roots: Sequence[str] = ()) -> None:
    """Refuses a folder in which a result of an earlier run has become a layer of the scene.

    Args:
        source: the scene's file, which can be read.
        target: the folder.
        asset_roots: as in ``LoadConfig``; other files are not looked at.

    Raises:
        OutputError: one has.
    """
    from cadgraph.export.usd import is_usd
    from cadgraph.load.usd_assets import open_layers

    if is_usd(source) and ((target / "semantics.usda").exists() or (target / "scene.usdc").exists()):
        layers = [layer.realPath for layer in open_layers(Path(source), asset_roots) if layer.realPath]
        refuse_to_overwrite(target, layers, "a file that the source refers to")


def _tree(file: str | Path | None) -> Vocabulary:
    return read_vocabulary(file) if file else default_vocabulary()


class Clock:
    """Passes progress on and notes how long each stage takes.

    Args:
        progress: called with the name of a stage and the share of it that is done.

    Attributes:
        seconds: wall time of each stage that is over [s].
    """

    def __init__(self, progress: Progress) -> None:
        self.seconds: dict[str, float] = {}
        self._progress = progress
        self._stage = ""
        self._since = time.perf_counter()

    def __call__(self, stage: str, share: float) -> None:
        """Moves on to a stage, or within it."""
        now = time.perf_counter()
        if stage != self._stage:
            if self._stage:
                self.seconds[self._stage] = round(now - self._since, 3)
                self._progress(self._stage, 1.0)
            self._stage, self._since = stage, now
        if stage:
            self._progress(stage, share)
