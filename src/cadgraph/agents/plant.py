"""A finished graph, opened for questions."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from cadgraph._io.text import file_name
from cadgraph.agents.answer import AskError, cell
from cadgraph.errors import LabelError, UnknownNode
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Node, Part, Unit
from cadgraph.query.lines import Line, find_lines
from cadgraph.query.network import Network

if TYPE_CHECKING:
    from cadgraph.model.scene import Scene

__all__ = ["Plant"]


class Plant:
    """A finished graph, opened for questions; nothing in it changes, and any thread may ask.

    Args:
        graph: the finished graph.
        folder: that it lies in; None where it was made in memory.
    """

    def __init__(self, graph: SceneGraph, folder: Path | None = None) -> None:
        self.graph = graph
        self.folder = folder
        self.network = Network(graph)
        self.name = cell((folder.resolve().name if folder else "") or file_name(graph.source.path) or "plant")

    @classmethod
    def open(cls, path: Path) -> Plant:
        """Reads a graph.

        Args:
            path: a folder that ``cadgraph build`` wrote, or a ``graph.json``.

        Raises:
            FormatError: there is none, or it does not follow the format.
        """
        return cls(SceneGraph.load(path), path if path.is_dir() else path.parent)

    @cached_property
    def scene(self) -> Scene | None:
        """The triangles of the file that the graph was built from; None where that isn't there any more.

        Raises:
            LoadError: it is there, but can't be read.
        """
        from cadgraph.config import restore_config
        from cadgraph.load import load
        from cadgraph.session.reopen import find_source

        if self.folder is None or not self.graph.source.path:
            return None
        try:
            source = find_source(self.graph, self.folder, None)
        except LabelError:
            return None
        return load(source, restore_config(self.graph.document.config).load)

    @cached_property
    def lines(self) -> tuple[Line, ...]:
        """All lines, in the order of the line list."""
        return tuple(find_lines(self.network))

    def find(self, which: str) -> Node:
        """The node that is called so.

        Args:
            which: a tag, an id or the source path of a mesh; a tag may be spelt loosely (``v4``), or as an answer
                showed it.

        Raises:
            AskError: there is none, or several; the message names the nearest ones.
        """
        try:
            return self.graph.find(which)
        except UnknownNode as error:
            shown = self._shown.get(cell(which), ())
            if len(shown) == 1:
                return self.graph.nodes[shown[0]]
            if shown:
                raise AskError(f"{cell(which)!r} may be any of {', '.join(shown)}; give one of these ids") from None
            raise AskError(cell(error, 500)) from None

    def place(self, which: str) -> str:
        """The id of the unit, junction or end that is called so, or that a part or mesh of that name belongs to.

        Raises:
            AskError: there is none; the message names the nearest ones.
        """
        node = self.find(which)
        if node.id in self.network.places:
            return node.id
        owner = self.network.owner_of_part(node.id) if isinstance(node, Part) else None
        if owner is None:
            raise AskError(
                f"{cell(which)!r} is a {node.layer}, which stands in no line; give a unit, a junction or an end"
            )
        return owner

    def called(self, node: str) -> str:
        """What a node is called in answers: the tag of a unit, else the id; on one line, cut to a length."""
        found = self.graph.nodes[node]
        return cell(found.tag if isinstance(found, Unit) else found.id)

    @cached_property
    def _shown(self) -> Mapping[str, tuple[str, ...]]:
        """Ids by what answers show, where that isn't the tag or id itself."""
        found: dict[str, tuple[str, ...]] = {}
        for node in self.graph.nodes.values():
            name = node.tag if isinstance(node, Unit) else node.id
            if cell(name) != name:
                found[cell(name)] = (*found.get(cell(name), ()), node.id)
        return found
