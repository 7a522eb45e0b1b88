"""A finished graph, opened for questions."""

from __future__ import annotations

import difflib
import itertools
from collections.abc import Callable, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, get_args

from cadgraph._io.text import file_name
from cadgraph.agents.answer import AskError, cell
from cadgraph.errors import UnknownNode
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Box, Junction, Node, Terminal, Unit
from cadgraph.query.lines import Line, find_lines
from cadgraph.query.network import Network
from cadgraph.query.summary import Summary, summarize

if TYPE_CHECKING:
    from cadgraph.agents.sql.guard import Database

__all__ = ["Plant"]

_MOST_HINTED = 6  # tags that an error names


class Plant:
    """A finished graph, opened for questions; nothing in it changes, and any thread may ask.

    Args:
        graph: the finished graph.
        folder: that it lies in; None where it was made in memory.
    """

    def __init__(self, graph: SceneGraph, folder: Path | None = None) -> None:
        self.graph = graph
        self.folder = folder
        self.network: Network = _ShownNetwork(graph, self.called)
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
    def lines(self) -> tuple[Line, ...]:
        """All lines, in the order of the line list."""
        return tuple(find_lines(self.network))

    def line(self, which: str) -> Line | None:
        """The line of the line list with this number, however its letter is written; None where there is none."""
        return next((line for line in self.lines if line.tag.casefold() == which.strip().casefold()), None)

    @property
    def has_places(self) -> bool:
        """Whether the graph says where one can stand; graphs of earlier versions don't."""
        return any(str(node.layer) == "place" for node in self.graph.nodes.values())

    @cached_property
    def tables(self) -> Database:
        """The graph as tables that SQL can ask."""
        from cadgraph.agents.sql.guard import Database
        from cadgraph.agents.sql.tables import make_tables

        return Database(make_tables(self.network, self.lines, self.extent))

    @cached_property
    def extent(self) -> Box:
        """The box around all parts that aren't ground, along the axes [m]; around all units where there are none."""
        boxes = [part.aabb for part in self.graph.parts() if not part.ground]
        boxes = boxes or [unit.aabb for unit in self.graph.units()] or [((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))]
        low = tuple(min(box[0][k] for box in boxes) for k in range(3))
        high = tuple(max(box[1][k] for box in boxes) for k in range(3))
        return (low[0], low[1], low[2]), (high[0], high[1], high[2])

    @cached_property
    def summary(self) -> Summary:
        """Counts of what the graph holds."""
        return summarize(self.graph)

    @cached_property
    def line_of(self) -> Mapping[int, str]:
        """The tag of the line of each connection, by the connection's number; taps have none."""
        return {arc.index: line.tag for line in self.lines for arc in line.arcs}

    def find(self, which: str, *layers: type[Node]) -> Node:
        """The node that is called so.

        Args:
            which: a tag, an id or the source path of a mesh; a tag may be spelt loosely (``v4``), or as an answer
                showed it.
            layers: what it may be; anything if none is given.

        Raises:
            AskError: there is none; the message names the nearest ones.
        """
        try:
            return self.graph.find(which, *layers)
        except UnknownNode as error:
            node = self.graph.nodes.get(self._named.get(which, self._named.get(cell(which), "")))
            if node is not None and isinstance(node, layers or get_args(Node)):
                return node
            told = str(error).replace(repr(which), repr(cell(which)))
            raise AskError(self._hint(which) or cell(told, 500)) from None

    def _hint(self, which: str) -> str:
        """The ends of a line of that number; units whose tags begin so, where none has a tag much like this one."""
        line = self.line(which)
        if line is not None:
            on_it = ", ".join((line.start_name, *line.through_names[:_MOST_HINTED], line.end_name))
            return f"{line.tag} is a line; name what stands on it or at its ends: {on_it}"
        letters = "".join(itertools.takewhile(str.isalpha, cell(which))).casefold()
        tags = [tag for unit in self.graph.units() if (tag := self.called(unit.id)).casefold().startswith(letters)]
        near = difflib.get_close_matches(cell(which), [*self._named, *(unit.tag for unit in self.graph.units())], 1)
        if near or not letters or not tags:
            return ""
        more = f" and {len(tags) - _MOST_HINTED} more" if len(tags) > _MOST_HINTED else ""
        listed = ", ".join(tags[:_MOST_HINTED])
        return f"nothing in the graph is called {cell(which)!r}; did you mean {listed}{more}?"

    def place(self, which: str) -> str:
        """The id of the unit, junction or end that is called so, or that a part or mesh of that name belongs to.

        Raises:
            AskError: there is none; the message names the nearest ones.
        """
        return self.find(which, Unit, Junction, Terminal).id

    def called(self, node: str) -> str:
        """What a node is called in answers, by its id: the tag of a unit, else the id.

        It is one line, cut to a length, and no other node's name; :meth:`find` knows it.
        """
        return self._shown[node]

    @cached_property
    def names(self) -> frozenset[str]:
        """All that answers call something: nodes, and lines of the line list."""
        return frozenset(self._shown.values()) | {line.tag for line in self.lines}

    @cached_property
    def _shown(self) -> Mapping[str, str]:
        names = {node.id: node.tag if isinstance(node, Unit) else node.id for node in self.graph.nodes.values()}
        # Tags that are plain are called as they are, whatever others come to by being cleaned.
        taken = {name for name in names.values() if cell(name) == name}
        shown: dict[str, str] = {}
        for number, (node, name) in enumerate(names.items()):
            clean = cell(name)
            if clean != name:
                tries = (clean, cell(node), f"node {number}")
                clean = next((each for each in tries if each and each not in taken), f"node {number}")
                taken.add(clean)
            shown[node] = clean
        return shown

    @cached_property
    def _named(self) -> Mapping[str, str]:
        return {shown: node for node, shown in self._shown.items()}


class _ShownNetwork(Network):
    """The network with names as answers show them, whatever stands in the graph.

    Args:
        graph: the finished graph.
        called: says what a node is called, by its id.
    """

    def __init__(self, graph: SceneGraph, called: Callable[[str], str]) -> None:
        super().__init__(graph)
        self._called = called

    def name(self, place: str) -> str:
        """What a node is called in answers."""
        return self._called(place)

    def what(self, place: str) -> str:
        """What a node is, in words, on one line."""
        return cell(super().what(place))
