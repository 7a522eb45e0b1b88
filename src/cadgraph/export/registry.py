"""The formats that a graph can be exported to, by name."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from cadgraph.export.graphml import write_graphml
from cadgraph.export.nodelink import write_nodelink
from cadgraph.export.tables import write_tables
from cadgraph.model.graph import SceneGraph

__all__ = ["Format", "export_graph", "formats"]


@dataclass(frozen=True)
class Format:
    """One format.

    Args:
        name: as a user asks for it (``"graphml"``).
        meaning: what it is good for, one line.
        write: takes the graph and the place to write to, and returns the files that it wrote.
        file: the name of its file where a folder is given; None if it always takes a folder.
    """

    name: str
    meaning: str
    write: Callable[[SceneGraph, Path], list[Path]]
    file: str | None = None


_FORMATS = (
    Format("csv", "tables of parts, units, relations, clusters, contacts and meshes, for Excel", write_tables),
    Format(
        "dexpi",
        "tanks, pumps, lines, valves and instruments as Proteus XML in DEXPI 1.3 terms, for P&ID tools",
        lambda graph, path: [_write_dexpi(graph, path)],
        "dexpi.xml",
    ),
    Format(
        "graphml",
        "the whole graph, for yEd, Gephi, Cytoscape",
        lambda graph, path: [write_graphml(graph, path)],
        "graph.graphml",
    ),
    Format(
        "networkx-json",
        "nodes and edges alone, for networkx.node_link_graph and d3",
        lambda graph, path: [write_nodelink(graph, path)],
        "nodelink.json",
    ),
)


def formats() -> dict[str, str]:
    """The names of all formats with their meaning, in alphabetical order."""
    return {each.name: each.meaning for each in _FORMATS}


def export_graph(graph: SceneGraph, to: str, path: str | Path) -> list[Path]:
    """Writes a graph in another format.

    Args:
        graph: what to write.
        to: the format's name, one of :func:`formats`.
        path: the folder that gets the files, made if missing; or the file, if it ends as the format's files do
            (``plant.graphml``).

    Returns:
        The files written.

    Raises:
        ValueError: no format has that name, or a file is given for a format of several files.
        OutputError: a file can't be written.
    """
    target = Path(path)
    for each in _FORMATS:
        if each.name == to:
            return each.write(graph, _place(each, target))
    raise ValueError(f"no export format is called {to!r}; there are {', '.join(formats())}")


def _write_dexpi(graph: SceneGraph, path: Path) -> Path:
    # It places what it writes by the layout library, which the other formats do without.
    from cadgraph.export.dexpi import write_dexpi

    return write_dexpi(graph, path)


def _place(form: Format, path: Path) -> Path:
    if form.file is None:
        if path.suffix.lower() == f".{form.name}" and not path.is_dir():
            raise ValueError(f"{path}: {form.name} is written as several files; give a folder")
        return path
    names_file = path.suffix.lower() == Path(form.file).suffix and not path.is_dir()
    return path if names_file else path / form.file
