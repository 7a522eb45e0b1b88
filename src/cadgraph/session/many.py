"""Many scenes, each built into a folder of its own by a process or a node of its own."""

from __future__ import annotations

import hashlib
import json
import shutil
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack, chdir, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

import cadgraph
from cadgraph._io.atomic import write_atomically
from cadgraph._io.digest import sha256_of
from cadgraph._io.manifest import behind, changed_by_others, manifest_in
from cadgraph._io.run_folder import at_work_in
from cadgraph.config import Config
from cadgraph.distribute.hands import Call, Failure
from cadgraph.distribute.site import hands_for
from cadgraph.errors import CadGraphError, FormatError
from cadgraph.model.graph import SceneGraph
from cadgraph.session.run import run

__all__ = ["FOLDER", "BuiltScene", "build_many", "folders_of"]

FOLDER = ".cadgraph-scenes"
"""The name of the run folder, within that of the results: it says which scenes are built, until all of them are."""


@dataclass(frozen=True)
class BuiltScene:
    """What became of one of many scenes.

    Args:
        name: of its folder.
        scene: its file, as it was given.
        state: ``"built"``; ``"kept"``: this run was stopped before, and had built it by then; ``"failed"``.
        reason: that it failed, in one line.
        seconds: that it took where it was built now [s].
        parts: in its graph.
        units: in its graph.
        connections: in its graph.
    """

    name: str
    scene: Path
    state: Literal["built", "kept", "failed"]
    reason: str = ""
    seconds: float = 0.0
    parts: int = 0
    units: int = 0
    connections: int = 0


@dataclass(frozen=True)
class _Settings:
    """What is the same for all scenes of a run."""

    config: Config
    labels: Path | None
    vocabulary: Path | None
    report: bool

    @property
    def digest(self) -> str:
        """Of all that a result depends on beside its scene."""
        files = [self.labels, self.vocabulary, *map(Path, self.config.label.catalogs)]
        digests = [_digest_if_there(file) for file in files]
        said = [cadgraph.__version__, self.config.model_dump(mode="json"), digests, self.report]
        return hashlib.sha256(json.dumps(said, sort_keys=True).encode()).hexdigest()


def folders_of(scenes: Sequence[Path]) -> list[str]:
    """The names of the folders that scenes are built into: those of the files without their suffix.

    Raises:
        ValueError: two have the same.
    """
    names: dict[str, Path] = {}
    for scene in scenes:
        # Some systems don't tell Tank from tank.
        other = names.setdefault(scene.stem.casefold(), scene)
        if other is not scene:
            both = f"{scene} is given twice" if other == scene else f"{other} and {scene} have the same name"
            raise ValueError(f"{both}: both would be built into a folder {scene.stem}; build them one by one")
    return [scene.stem for scene in scenes]


def build_many(
    scenes: Sequence[str | Path],
    folder: str | Path,
    config: Config | None = None,
    *,
    labels: str | Path | None = None,
    vocabulary: str | Path | None = None,
    report: bool = True,
    workers: int | None = None,
    ray: str | None = None,
    told: Callable[[BuiltScene], None] | None = None,
) -> list[BuiltScene]:
    """Builds many scenes, each into a folder of its own; one that fails doesn't stop the others.

    Where the run is stopped, or a scene fails, the next one with the same settings takes those that are built as they
    are, and says so. Where all are built it leaves nothing of this behind: the next one builds all of them anew.

    Args:
        scenes: files, of which no two have the same name.
        folder: where the folders of the scenes go; made if missing.
        config: all settings; the defaults if None.
        labels: a file of labels for all of them.
        vocabulary: a file with another label tree.
        report: whether to draw pictures and write the reports.
        workers: scenes at a time, each in a process of its own; one if None, with ``ray`` as many as processors.
        ray: address of a Ray cluster that does it: ``"local"``, ``"auto"`` or ``"host:port"``.
        told: called with each scene as soon as it is done.

    Returns:
        What became of each, in the order given.

    Raises:
        ValueError: two scenes have the same name, ``workers`` is below 1, or ``ray`` is no address.
        MissingExtra: Ray is asked for and not installed.
        CadGraphError: the cluster can't be used.
        OutputError: the folder can't be written.
    """
    files = [Path(scene) for scene in scenes]
    names, here = folders_of(files), str(Path.cwd())
    asked = _Settings(config or Config(), _absolute(labels), _absolute(vocabulary), report)
    found: dict[int, BuiltScene] = {}

    def each(number: int, result: Any) -> None:
        one = result
        if isinstance(result, Failure):
            one = BuiltScene(names[number], files[number], "failed", _told(result))
        found[number] = one
        if told is not None:
            told(one)

    with at_work_in(folder) as target:
        records = target.absolute() / FOLDER
        calls: list[Call] = [
            (here, str(file), str(target.absolute() / name), str(records / f"{name}.json"), asked)
            for file, name in zip(files, names, strict=True)
        ]
        try:
            with hands_for(target, workers, ray) as hands:
                hands.run(_build_one, calls, each=each)
        except BaseException as stop:
            n_built = sum(one.state != "failed" for one in found.values())
            stop.add_note(f"{n_built} of {len(files)} scenes are built, the same command goes on with the others")
            raise
        if all(one.state != "failed" for one in found.values()):
            shutil.rmtree(records, ignore_errors=True)
    return [found[number] for number in range(len(files))]


def _build_one(here: str, scene: str, folder: str, record: str, settings: _Settings) -> BuiltScene:
    """Builds a scene, or finds that this run had built it before it was stopped.

    Args:
        here: the folder that the caller stands in. This process, which may be on another machine, does its work there,
            so that paths mean the same, and the graph names its source as it was given.
        scene: its file.
        folder: for its results.
        record: the note on it.
        settings: of all scenes.

    Raises:
        CadGraphError: it can't be built.
    """
    start, target, note = time.monotonic(), Path(folder), Path(record)
    with ExitStack() as standing:
        file = Path(scene)
        try:
            standing.enter_context(chdir(here))
        except OSError:  # not on this machine
            file = Path(here, scene)
        key = f"{settings.digest} {_digest_if_there(file)}"
        kept = _kept(note, key, target)
        if kept is not None:
            return _with_counts(BuiltScene(target.name, file, "kept"), kept)
        outcome = run(
            file,
            target,
            settings.config,
            labels=settings.labels,
            vocabulary=settings.vocabulary,
            report=settings.report,
        )
    counts = _counts_of(outcome.graph)
    manifest = manifest_in(target)
    said = {"key": key, "graph": manifest.graph if manifest is not None else "", "counts": counts}
    write_atomically(note, json.dumps(said, indent=1) + "\n")
    return _with_counts(BuiltScene(target.name, file, "built", seconds=time.monotonic() - start), counts)


def _counts_of(graph: SceneGraph) -> dict[str, int]:
    return {"parts": graph.count("part"), "units": len(graph.units()), "connections": len(graph.connections())}


def _with_counts(one: BuiltScene, counts: Mapping[str, int]) -> BuiltScene:
    return replace(one, parts=counts["parts"], units=counts["units"], connections=counts["connections"])


def _kept(note: Path, key: str, target: Path) -> dict[str, int] | None:
    """What a note says of a scene that is built as it is to be, and of which nothing was changed since; else None."""
    try:
        said = json.loads(note.read_text(encoding="utf-8"))
        counts = {name: int(said["counts"][name]) for name in ("parts", "units", "connections")}
        manifest = manifest_in(target)
        whole = manifest is not None and manifest.graph == said["graph"] and said["key"] == key
        if whole and not (changed_by_others(target) or behind(target) or SceneGraph.load(target).spoilt_shards()):
            return counts
    except (OSError, ValueError, KeyError, TypeError, FormatError):
        pass
    return None


def _told(failure: Failure) -> str:
    """Why a scene failed, as the command line says it of a single one."""
    error = failure.error
    if isinstance(error, MemoryError):
        return "there is not enough memory for this scene; give fewer --workers"
    if isinstance(error, OSError):
        return f"{error.filename or 'the system'}: {error.strerror or error}"
    if error is not None and not isinstance(error, CadGraphError | ValueError):
        return f"{type(error).__name__}: {failure.reason}"
    return failure.reason


def _absolute(file: str | Path | None) -> Path | None:
    return None if file is None else Path(file).absolute()


def _digest_if_there(file: Path | None) -> str:
    if file is not None:
        with suppress(OSError):
            return sha256_of(file)
    return ""
