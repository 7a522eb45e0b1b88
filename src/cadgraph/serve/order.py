"""What a person wants to see: a folder of results, or a scene that is built into one first."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from cadgraph._io.atomic import ensure_writable
from cadgraph._io.digest import sha256_of
from cadgraph._io.manifest import GRAPH_FILE, no_graph
from cadgraph._io.run_folder import refuse_foreign
from cadgraph._io.staging import result_path
from cadgraph.config import Config
from cadgraph.errors import FormatError, LoadError
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import SourceRecord

__all__ = ["Order", "order_of"]


@dataclass(frozen=True)
class Order:
    """What is to be shown.

    Args:
        folder: of the results.
        source: the scene to build; None opens what is in the folder.
        scene: where the source is now, if somebody knows better than the graph.
        config: all settings to build with; the defaults if None.
    """

    folder: Path
    source: Path | None = None
    scene: Path | None = None
    config: Config | None = None

    def prepare(self) -> None:
        """Makes sure that it can be done, before a page is opened.

        Raises:
            LoadError: there is no such scene.
            FormatError: the folder holds no graph.
            OutputError: the folder can't be written although results go there.
        """
        if self.source is None:
            file = self.folder / GRAPH_FILE
            if not result_path(file).is_file():
                raise FormatError(no_graph(file))
            return
        if not self.source.is_file():
            raise LoadError(f"{self.source}: no such file; give a scene, or a folder that 'cadgraph build' wrote")
        ensure_writable(self.folder)
        refuse_foreign(self.folder)


def order_of(what: Path, output: Path | None, scene: Path | None, config: Config | None) -> Order:
    """What a person means by a folder or a file.

    Args:
        what: a folder of results, its ``graph.json``, or a scene.
        output: of a scene: the folder of its results; beside where the command is run by default.
        scene: of a folder: where the source is now.
        config: of a scene: settings to build with.

    Raises:
        ValueError: an option doesn't go with it.
    """
    if what.is_dir() or what.name == "graph.json":
        if output is not None or config is not None:
            raise ValueError(f"{what}: results are opened as they are; -o, --config and --set go with a scene to build")
        return Order(what if what.is_dir() else what.parent, scene=scene)
    if scene is not None:
        raise ValueError(f"{what}: --scene goes with a folder of results; a scene is where it is")
    folder = output or Path(what.stem)
    former = _former_source(folder)
    if former is not None and output is None and Path(former.path).resolve() != what.resolve():
        raise ValueError(f"{folder}: holds the results of another scene ({former.path}); give a folder with -o")
    if former is not None and config is None and former.sha256 and what.is_file() and sha256_of(what) == former.sha256:
        return Order(folder, scene=what)
    return Order(folder, what, None, config)


def _former_source(folder: Path) -> SourceRecord | None:
    """What the graph in a folder is of; None where it holds none that can be read."""
    try:
        return SceneGraph.load(folder).source
    except FormatError:
        return None
