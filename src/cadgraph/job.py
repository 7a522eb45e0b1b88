"""One run from file to folder: load, build, write everything."""

from __future__ import annotations

import json
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from cadgraph.atomic import ensure_writable, write_atomically
from cadgraph.config import Config
from cadgraph.errors import OutputError
from cadgraph.graph import SceneGraph
from cadgraph.labels import GivenLabel, read_labels
from cadgraph.load import load
from cadgraph.pipeline import STAGES, build
from cadgraph.progress import Progress, quiet
from cadgraph.vocabulary import default_vocabulary, read_vocabulary

__all__ = ["RUN_STAGES", "Outcome", "run"]

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
    labels: str | Path | None = None,
    vocabulary: str | Path | None = None,
    report: bool = True,
    progress: Progress = quiet,
) -> Outcome:
    """Reads a scene, builds its graph, and writes ``graph.json``, ``semantics.usda``, ``report.html`` and pictures.

    Each file is written whole or not at all; the folder is tried before the work begins.

    Args:
        source: the scene's file.
        folder: where the results go; made if missing.
        config: all settings; the defaults if None.
        labels: a file of labels from outside.
        vocabulary: a file with another label tree.
        report: whether to draw pictures and write the report.
        progress: told how far it is.

    Raises:
        LoadError: the scene can't be read.
        LabelError: labels or vocabulary can't be used.
        OutputError: the folder can't be written.
    """
    from cadgraph.export.usd import write_semantics

    config = config or Config()
    target = ensure_writable(folder)
    _refuse_foreign(target)
    clock = _Clock(progress)
    tree = read_vocabulary(vocabulary) if vocabulary else default_vocabulary()
    given: Sequence[GivenLabel] = read_labels(labels, tree) if labels else ()

    clock("read", 0)
    scene = load(source, config.load)
    graph = build(scene, config, labels=given, vocabulary=tree, progress=clock)
    clock("write graph", 0)
    files = {"graph": graph.save(target / "graph.json")}
    clock("write labels", 0)
    files["labels"] = write_semantics(scene, graph, source, target / "semantics.usda")
    if report:
        from cadgraph.report import write_report

        clock("draw report", 0)
        files["report"] = write_report(scene, graph, target / "report.html", config.report, clock)
        files["picture"] = target / "picture.png"
    clock("", 1)
    files["timings"] = target / "timings.json"
    write_atomically(files["timings"], json.dumps(clock.seconds, indent=1) + "\n")
    return Outcome(graph, files, clock.seconds)


def _refuse_foreign(folder: Path) -> None:
    """Makes sure that what will be written over is ours: the user's own files may have these names too."""
    ours = (folder / "graph.json").is_file() and b'"cadgraph"' in (folder / "graph.json").read_bytes()[:200]
    marks = {"graph.json": b'"cadgraph"', "semantics.usda": b"cadgraph", "scene.usdc": b"" if ours else None}
    for name, mark in marks.items():
        path = folder / name
        if path.is_file() and (mark is None or mark not in path.read_bytes()[:2000]):
            raise OutputError(f"{path}: not written by cadgraph, so it is left alone; choose another output folder")


class _Clock:
    """Passes progress on and notes how long each stage takes."""

    def __init__(self, progress: Progress) -> None:
        self.seconds: dict[str, float] = {}
        self._progress = progress
        self._stage = ""
        self._since = time.perf_counter()

    def __call__(self, stage: str, share: float) -> None:
        now = time.perf_counter()
        if stage != self._stage:
            if self._stage:
                self.seconds[self._stage] = round(now - self._since, 3)
                self._progress(self._stage, 1.0)
            self._stage, self._since = stage, now
        if stage:
            self._progress(stage, share)
