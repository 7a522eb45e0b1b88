"""One run from file to folder: read, analyse, label, interpret, write everything."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

from cadgraph._io.atomic import write_atomically
from cadgraph._io.garbage import collector_paused
from cadgraph._io.manifest import of_an_earlier_graph
from cadgraph._io.progress import Progress, quiet
from cadgraph._io.results import NewResults, new_results
from cadgraph._io.run_folder import refuse_to_overwrite, results_folder
from cadgraph.config import Config, ReportConfig
from cadgraph.distribute.site import crew_for
from cadgraph.export.usd_paths import check_source, is_usd
from cadgraph.labelers.base import AskingLabeler, Labeler
from cadgraph.load import load
from cadgraph.model.corrections import CorrectionsFile
from cadgraph.model.crew import Crew
from cadgraph.model.given_labels import GivenLabel, read_labels
from cadgraph.model.graph import SceneGraph, shards_in
from cadgraph.model.scene import Scene
from cadgraph.model.vocabulary import Vocabulary, default_vocabulary, read_vocabulary
from cadgraph.session.ahead import imported_meanwhile, worked_out_meanwhile
from cadgraph.session.replaced import labels_there, tell_lost_corrections, tell_replaced

if TYPE_CHECKING:
    from cadgraph.draw.report.overview import Overview
    from cadgraph.model.analysis import Analysis
    from cadgraph.session.session import Session

__all__ = [
    "Outcome",
    "begin",
    "run",
    "stage_graph",
    "write_graph",
    "write_report_anew",
    "write_rest",
    "write_results",
]

_OF_ITS_GRAPH = ("scene.usdc", "simulation.usda", "devices.json")
"""Results that are of no use beside another graph. A report stays readable."""

# Modules that all runs need, which take longer to import than a small file takes to read.
_NEEDED = ("cadgraph.session.session", "cadgraph.export.usd")

_MANY = 10_000  # meshes from which on memory is made free between the analysis and what is written


@dataclass(frozen=True)
class Outcome:
    """What a run made.

    Args:
        graph: the scene graph.
        files: what was written, by purpose (``"graph"``, ``"labels"``, ``"report"``, ``"picture"``, ``"timings"``).
        seconds: wall time of each stage [s].
        earlier: names of the files in the folder that still show an earlier graph, as a report that was not drawn anew.
        removed: names of the files that went with the earlier graph.
        remarks: which labels and corrections of the earlier graph this one has not, and how they come back; and that
            work was done again after a process was ended.
    """

    graph: SceneGraph
    files: dict[str, Path]
    seconds: dict[str, float] = field(default_factory=dict)
    earlier: tuple[str, ...] = ()
    removed: tuple[str, ...] = ()
    remarks: tuple[str, ...] = ()


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
    workers: int | None = None,
    tiles: int | None = None,
    ray: str | None = None,
) -> Outcome:
    """Reads a scene, builds its graph, and writes ``graph.json``, ``semantics.usda``, ``report.html`` and pictures.

    All files come into the folder together, when the last of them is complete: whatever ends the process, the folder
    holds the results of an earlier run or those of this one. It is tried before the work begins. Without a report, that
    of an earlier run stays, and says so. Corrections that lie in the folder are applied again. Where a model is only to
    be asked in this run and answers later (a dry run, requests for a batch), a graph that is there already stays as it
    is.

    Args:
        source: the scene's file.
        folder: where the results go; made if missing.
        config: all settings; the defaults if None.
        labels: labels from outside, or a file of them.
        vocabulary: another label tree, or a file with it.
        labeler: another labeler than the one that is set.
        report: whether to draw pictures and write the report.
        progress: called with the name of a stage and the share of it that is done.
        workers: processes that share the costly steps of the analysis, tile by tile; the graph is the same to the byte.
            What they have found lies in the folder until the run is over, so that one that was stopped goes on there.
            In a script that asks for more than one, keep your own work under ``if __name__ == "__main__":``.
            One if None; with ``ray`` all processors.
        tiles: that the site is cut into; by its size and the workers if None. Either more than one of them makes tiles.
        ray: address of a Ray cluster that does the same in place of processes: ``"local"``, ``"auto"`` or
            ``"host:port"``.

    Raises:
        ValueError: ``workers`` or ``tiles`` is below 1, or ``ray`` is no address.
        MissingExtra: Ray is asked for and not installed.
        CadGraphError: the cluster can't be used.
        LoadError: the scene can't be read.
        LabelError: labels or vocabulary can't be used.
        OutputError: the folder can't be written, or a result would take the place of a file that isn't ours.
    """
    config = config or Config()
    clock = Clock(progress)
    with results_folder(folder) as target, crew_for(target, workers, tiles, ray) as crew:
        tree = vocabulary if isinstance(vocabulary, Vocabulary) else _tree(vocabulary)
        given = read_labels(labels, tree) if isinstance(labels, str | Path) else labels or ()
        there = labels_there(target)
        session = begin(source, target, config, given, tree, labeler, clock, crew=crew)
        if isinstance(labeler, AskingLabeler) and labeler.only_asks and (target / "graph.json").exists():
            clock("", 1)
            return Outcome(SceneGraph.load(target), {}, clock.seconds)
        drawn = config.report if report else None
        with collector_paused(), _overview_meanwhile(session.analysis, drawn) as overview:
            scene, graph = session.analysis.scene, session.make_graph(clock)
            remarks = (*tell_replaced(there, graph), *tell_lost_corrections(session.lost, len(session.corrections)))
            del session
            if scene.n_meshes > _MANY:
                # What the stages kept with it, the lines of its parts above all, no file needs.
                scene = replace(scene)
            outcome = write_results(scene, graph, source, target, drawn, clock, overview)
        return replace(outcome, remarks=(*remarks, *(crew.remarks if crew is not None else ())))


def _overview_meanwhile(
    analysis: Analysis, report: ReportConfig | None
) -> AbstractContextManager[Callable[[], Overview | None]]:
    """Casts the rays of the report's overview beside a block in which the graph is made.

    Not where there is no report, nothing to draw, or so much that the memory of both together is too much.
    """
    if report is None or analysis.scene.n_meshes > _MANY:
        return nullcontext(lambda: None)
    scene, ground = analysis.scene, analysis.parts.ground[analysis.parts.part_of_mesh]

    def act(checkpoint: Callable[[], None]) -> Overview | None:
        from cadgraph.draw.report.overview import can_be_drawn, look_over

        return look_over(scene, ground, report, checkpoint) if can_be_drawn(scene) else None

    return worked_out_meanwhile(act)


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
    crew: Crew | None = None,
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
        crew: does the costly steps of the analysis in place of this process.

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
    with imported_meanwhile(*_NEEDED) if config.load.isolate else nullcontext():
        scene = load(source, config.load)
    from cadgraph.session.session import Session

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
        crew=crew,
    )


def write_results(
    scene: Scene, graph: SceneGraph, source: str | Path, target: Path, report: ReportConfig | None, clock: Clock,
    overview: Callable[[], Overview | None] = lambda: None,
) -> Outcome:  # fmt: skip
    """Writes a graph and what goes with it into a folder, over the results of an earlier run.

    Args:
        scene: all meshes that the graph is of.
        graph: finished.
        source: the scene's file.
        target: the folder; it exists.
        report: how to draw pictures and write the report; None: not at all.
        clock: takes the time of each stage.
        overview: gives what the report's overview shows, where that is worked out meanwhile.

    Raises:
        OutputError: a file can't be written.
    """
    there = [name for name in _OF_ITS_GRAPH if (target / name).exists()]
    with new_results(target, dropped=_OF_ITS_GRAPH) as new:
        clock("write graph", 0)
        stage_graph(scene, graph, source, target, clock)
        outcome = write_rest(scene, graph, target, new, report, clock, overview)
    return replace(outcome, removed=tuple(name for name in there if not (target / name).exists()))


def write_rest(
    scene: Scene, graph: SceneGraph, target: Path, new: NewResults, report: ReportConfig | None, clock: Clock,
    overview: Callable[[], Overview | None] = lambda: None,
) -> Outcome:  # fmt: skip
    """Writes what is made from a graph: the report, and how long everything took; then all of it comes to its place.

    Where the report fails, or somebody stops it, the graph comes all the same.

    Args:
        scene: all meshes that the graph is of.
        graph: finished.
        target: the folder.
        new: what is coming into it; with the graph.
        report: how to draw pictures and write the report; None: that of an earlier graph says that it is one.
        clock: takes the time of each stage.
        overview: gives what the report's overview shows, where that is worked out meanwhile.

    Raises:
        OutputError: a file can't be written.
    """
    files = {"graph": target / "graph.json", "labels": target / "semantics.usda"}
    if report is not None:
        from cadgraph.draw.report import write_report

        clock("draw report", 0)
        report_file = target / "report.html"
        try:
            files["report"] = write_report(scene, graph, report_file, report, clock, overview)
        except BaseException as stop:
            _keep_report(target, new)
            new.commit()
            left = "only the report is still the one before" if report_file.exists() else "only the report is missing"
            stop.add_note(f"the graph is written; {left}")
            raise
        files["picture"] = target / "picture.png"
    else:
        _keep_report(target, new)
    clock("", 1)
    files["timings"] = target / "timings.json"
    write_atomically(files["timings"], json.dumps(clock.seconds, indent=1) + "\n")
    new.commit()
    return Outcome(graph, files, clock.seconds, of_an_earlier_graph(target))


def write_graph(
    scene: Scene, graph: SceneGraph, source: str | Path, target: Path, corrections: str | None = None
) -> None:
    """Writes another graph of the same scene over the one in a folder, and the label layer with it.

    Whenever the process ends, the folder holds one of the two graphs, whole. A report of the graph before stays, and
    says that it is one.

    Args:
        scene: all meshes that the graph is of.
        graph: finished.
        source: the scene's file.
        target: the folder; it exists.
        corrections: digest of those that the graph shows; None: those in the folder.

    Raises:
        OutputError: a file can't be written.
        LoadError: the source can't be opened any more.
    """
    with new_results(target, corrections=corrections) as new:
        stage_graph(scene, graph, source, target, shard_above=shards_in(target))
        _keep_report(target, new)


def write_report_anew(session: Session, target: Path) -> None:
    """Draws the report of the graph in a folder, with its picture.

    Args:
        session: whose graph it is.
        target: the folder; it exists.

    Raises:
        OutputError: a file can't be written.
    """
    from cadgraph.draw.report import write_report

    with new_results(target):
        write_report(session.analysis.scene, session.graph, target / "report.html", session.config.report)


def stage_graph(
    scene: Scene,
    graph: SceneGraph,
    source: str | Path,
    target: Path,
    progress: Progress = quiet,
    *,
    shard_above: int | None = None,
) -> None:
    """Writes a graph and its label layer; within ``new_results``, with whatever else is coming into the folder.

    Args:
        scene: all meshes that the graph is of.
        graph: finished.
        source: the scene's file.
        target: the folder; it exists.
        progress: called with the name of a stage.
        shard_above: as of :meth:`SceneGraph.save`.

    Raises:
        OutputError: a file can't be written.
        LoadError: the source can't be opened any more.
    """
    from cadgraph.export.usd import write_semantics

    graph.save(target, shard_above)
    progress("write labels", 0)
    write_semantics(scene, graph, source, target / "semantics.usda")


def _keep_report(target: Path, new: NewResults) -> None:
    """Has a report that is there already say whether it shows an earlier graph than the one to come."""
    file = target / "report.html"
    if not file.is_file():
        return
    from cadgraph.draw.report import marked_as_earlier

    content = file.read_bytes()
    marked = marked_as_earlier(content, new.is_earlier(file.name))
    if marked != content:
        new.keep(file.name)
        write_atomically(file, marked)


def check_target(source: str | Path, target: Path) -> None:
    """Refuses a folder in which a result would take the place of the source.

    Args:
        source: the scene's file.
        target: the folder.

    Raises:
        OutputError: it would.
    """
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
