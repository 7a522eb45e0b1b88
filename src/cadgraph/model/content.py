# What methods do is said once, where ``Content`` names them.
# ruff: noqa: D102
"""Where a graph has its nodes and edges from: a document in memory, or shards on disk that are read when asked for."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from functools import cached_property
from pathlib import Path
from typing import Any, TypeVar, cast

from pydantic import ValidationError

from cadgraph._io.garbage import collector_paused
from cadgraph.errors import FormatError
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.names import Names
from cadgraph.model.records import (
    ROWS_OF,
    Adjacent,
    AnyEdge,
    AnyNode,
    Cluster,
    Contains,
    GraphDocument,
    Joint,
    Node,
    Part,
    Unit,
)
from cadgraph.model.shards import Shards
from cadgraph.model.validate import check_document, check_names, what_is_wrong

__all__ = ["Content", "ShardedContent", "WholeContent", "validated"]

_MOST_TOLD = 600  # characters of what is wrong
Labels = Counter[tuple[str, str | None]]
_Row = TypeVar("_Row")


def validated(data: Mapping[str, Any], where: str) -> GraphDocument:
    """The document of plain values, sound in itself.

    Args:
        data: the content of a ``graph.json``.
        where: its path, for messages.

    Raises:
        FormatError: it isn't.
    """
    try:
        document = GraphDocument.model_validate(data)
        check_document(document)
    except ValidationError as error:
        raise FormatError(f"{where}: {what_is_wrong(error, data)}; build the graph anew") from None
    except FormatError as error:
        # It may name what the file holds, which may be of any length.
        raise FormatError(f"{where}: {error!s:.{_MOST_TOLD}}; build the graph anew") from None
    return document


class Content(ABC):
    """Nodes and edges of a graph, and what is looked up among them."""

    head: GraphDocument
    """Source, vocabulary and settings; it may lack rows."""
    nodes: Mapping[str, Node]
    """By id, in the order of the file."""

    @property
    @abstractmethod
    def document(self) -> GraphDocument:
        """All of it."""

    @abstractmethod
    def of_layer(self, layer: type[AnyNode]) -> list[AnyNode]:
        """All nodes of a class, in the order of the file."""

    @abstractmethod
    def of_kind(self, kind: type[AnyEdge]) -> list[AnyEdge]:
        """All edges of a class, in the order of the file."""

    @abstractmethod
    def count_layer(self, layer: str) -> int:
        """How many nodes a layer has."""

    @abstractmethod
    def count_kind(self, kind: str) -> int:
        """How many edges are of a kind."""

    @property
    @abstractmethod
    def joints(self) -> tuple[Joint, ...]:
        """All joints."""

    @property
    @abstractmethod
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """All diagnostics."""

    @property
    @abstractmethod
    def labels(self) -> Labels:
        """How many parts have which group and name."""

    @property
    @abstractmethod
    def nodes_but_parts(self) -> tuple[Node, ...]:
        """All nodes that are no part."""

    def spoilt(self) -> tuple[str, ...]:
        """Files beside ``graph.json`` that hold rows of it and are gone or spoilt; each is read whole."""
        return ()

    @abstractmethod
    def find(self, which: str, layers: tuple[type[Node], ...]) -> Node:
        """The node that is called so; see ``Names.find``."""

    @abstractmethod
    def part_with(self, mesh: str) -> Part | None:
        """The part that holds a mesh."""

    @abstractmethod
    def touching(self, part: str) -> Collection[str]:
        """Ids of the parts that touch a part, in the order of the file."""

    @abstractmethod
    def cluster_of(self, part: str) -> str | None:
        """Id of the cluster that a part belongs to."""

    @abstractmethod
    def unit_of(self, part: str) -> str | None:
        """Id of the unit that a part belongs to."""


class WholeContent(Content):
    """A document in memory.

    Args:
        document: the content, as it stands on disk.

    Raises:
        FormatError: an id is used twice, an edge ends nowhere, or there isn't exactly one site.
    """

    def __init__(self, document: GraphDocument) -> None:
        self.head = document
        self.nodes = check_names(document)

    @property
    def document(self) -> GraphDocument:
        return self.head

    def of_layer(self, layer: type[AnyNode]) -> list[AnyNode]:
        return _of_class(layer, self._nodes_by_class, self.head.nodes)

    def of_kind(self, kind: type[AnyEdge]) -> list[AnyEdge]:
        return _of_class(kind, self._edges_by_class, self.head.edges)

    @cached_property
    def _nodes_by_class(self) -> dict[type[Any], list[Any]]:
        return _by_class(self.head.nodes)

    @cached_property
    def _edges_by_class(self) -> dict[type[Any], list[Any]]:
        return _by_class(self.head.edges)

    def count_layer(self, layer: str) -> int:
        return self._layers[layer]

    def count_kind(self, kind: str) -> int:
        return self._kinds[kind]

    @cached_property
    def _layers(self) -> Counter[str]:
        return Counter(node.layer for node in self.head.nodes)

    @cached_property
    def _kinds(self) -> Counter[str]:
        return Counter(edge.kind for edge in self.head.edges)

    @property
    def joints(self) -> tuple[Joint, ...]:
        return self.head.joints

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        return self.head.diagnostics

    @cached_property
    def labels(self) -> Labels:
        return Counter(part.label.said for part in self.of_layer(Part) if part.label is not None)

    @property
    def nodes_but_parts(self) -> tuple[Node, ...]:
        return tuple(node for node in self.head.nodes if not isinstance(node, Part))

    def find(self, which: str, layers: tuple[type[Node], ...]) -> Node:
        return self._names.find(which, layers)

    def part_with(self, mesh: str) -> Part | None:
        return self._names.part_with(mesh)

    def touching(self, part: str) -> Collection[str]:
        return sorted(self._touching.get(part, ()), key=self._rank.__getitem__)

    def cluster_of(self, part: str) -> str | None:
        return self._cluster_of_part.get(part)

    def unit_of(self, part: str) -> str | None:
        return self._unit_of_part.get(part)

    # Look-ups, made when first needed

    @cached_property
    def _names(self) -> Names:
        return Names(self.nodes)

    @cached_property
    def _rank(self) -> dict[str, int]:
        return {node.id: i for i, node in enumerate(self.head.nodes)}

    @cached_property
    def _touching(self) -> dict[str, set[str]]:
        touching: dict[str, set[str]] = {}
        for edge in self.of_kind(Adjacent):
            touching.setdefault(edge.source, set()).add(edge.target)
            touching.setdefault(edge.target, set()).add(edge.source)
        return touching

    @cached_property
    def _cluster_of_part(self) -> dict[str, str]:
        clusters = {cluster.id for cluster in self.of_layer(Cluster)}
        return {edge.target: edge.source for edge in self.of_kind(Contains) if edge.source in clusters}

    @cached_property
    def _unit_of_part(self) -> dict[str, str]:
        return {part: unit.id for unit in self.of_layer(Unit) for part in unit.parts}


def _by_class(rows: Iterable[Any]) -> dict[type[Any], list[Any]]:
    """Rows by their class, in the order of the file: what asks for the few of one kind need not pass all others."""
    found: dict[type[Any], list[Any]] = {}
    for row in rows:
        found.setdefault(type(row), []).append(row)
    return found


def _of_class(kind: type[_Row], by_class: Mapping[type[Any], list[Any]], rows: Iterable[Any]) -> list[_Row]:
    """The rows of a class or of one made from it, in the order of the file, as a list of their own."""
    several = [one for one in by_class if issubclass(one, kind)]
    if len(several) > 1:
        return [row for row in rows if isinstance(row, kind)]
    return list(by_class[several[0]]) if several else []


class _Nodes(Mapping[str, Node]):
    """All nodes, of which the parts are read when they are asked for."""

    def __init__(self, few: Mapping[str, Node], shards: Shards, part: Callable[[Any], Part]) -> None:
        self._few, self._shards, self._part = few, shards, part

    def __getitem__(self, name: str) -> Node:
        if name in self._few:
            return self._few[name]
        row = self._shards.row("nodes", "part", name)
        if row is None:
            raise KeyError(name)
        return self._part(row)

    def __iter__(self) -> Iterator[str]:
        return iter(row["id"] for row in self._shards.joined("nodes", [{"id": name} for name in self._few]))

    def __len__(self) -> int:
        return len(self._few) + self._shards.count("nodes", "part")


class ShardedContent(Content):
    """An index, and shards that are read when they are asked for.

    What needs all parts or contacts reads all of them; one part, what is around it, units, lines and connections need
    a shard or two, or none.

    Args:
        folder: that holds the index.
        data: its content.
        where: its path, for messages.

    Raises:
        FormatError: the index is damaged; a shard is looked at when it is read.
    """

    def __init__(self, folder: Path, data: Mapping[str, Any], where: str) -> None:
        self._where = where
        self._data = data
        self._shards = Shards.of(folder, data, where)
        rest = {key: value for key, value in data.items() if key != "shards"} | {"version": 1}
        try:
            self.head = GraphDocument.model_validate(rest)
        except ValidationError as error:
            raise FormatError(f"{where}: {what_is_wrong(error, rest)}; build the graph anew") from None
        self._few: dict[str, Node] = {node.id: node for node in self.head.nodes}
        if sum(node.layer == "site" for node in self.head.nodes) != 1:
            raise FormatError(f"{where}: a graph needs exactly one node of layer 'site'; build the graph anew")
        self.nodes = _Nodes(self._few, self._shards, self._part)

    @cached_property
    def document(self) -> GraphDocument:
        rest = {key: value for key, value in self._data.items() if key != "shards"} | {"version": 1}
        with collector_paused():
            joined = {key: self._shards.joined(key, self._data.get(key, ())) for key in ROWS_OF}
            return validated({**rest, **joined}, self._where)

    def spoilt(self) -> tuple[str, ...]:
        return self._shards.spoilt()

    def of_layer(self, layer: type[AnyNode]) -> list[AnyNode]:
        if layer is Part and self._shards.holds("nodes", "part"):
            return cast("list[AnyNode]", [self._part(row) for row in self._shards.rows("nodes", "part")])
        return [node for node in self.head.nodes if isinstance(node, layer)]

    def of_kind(self, kind: type[AnyEdge]) -> list[AnyEdge]:
        name = str(kind.model_fields["kind"].default)
        if self._shards.holds("edges", name):
            return [cast("AnyEdge", self._record(kind, row)) for row in self._shards.rows("edges", name)]
        return [edge for edge in self.head.edges if isinstance(edge, kind)]

    def count_layer(self, layer: str) -> int:
        return sum(node.layer == layer for node in self.head.nodes) + self._shards.count("nodes", layer)

    def count_kind(self, kind: str) -> int:
        return sum(edge.kind == kind for edge in self.head.edges) + self._shards.count("edges", kind)

    @property
    def joints(self) -> tuple[Joint, ...]:
        return (*self.head.joints, *(self._record(Joint, row) for row in self._shards.rows("joints")))

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        return (*self.head.diagnostics, *(self._record(Diagnostic, row) for row in self._shards.rows("diagnostics")))

    @cached_property
    def labels(self) -> Labels:
        if not self._shards.holds("nodes", "part"):
            return Counter(part.label.said for part in self.of_layer(Part) if part.label is not None)
        return Counter({(group, name): n for group, name, n in self._shards.index.labels})

    @property
    def nodes_but_parts(self) -> tuple[Node, ...]:
        return tuple(node for node in self.head.nodes if not isinstance(node, Part))

    def find(self, which: str, layers: tuple[type[Node], ...]) -> Node:
        part = self.nodes.get(which) if which not in self._few else None
        part = part if part is not None else self.part_with(which)
        # A part stands for what it is a part of, which is looked for among the others.
        return (Names({**self._few, part.id: part}) if part is not None else self._names).find(which, layers)

    def part_with(self, mesh: str) -> Part | None:
        if not self._shards.holds("nodes", "part"):
            return self._names.part_with(mesh)
        row = self._shards.row("lookup", "mesh", mesh)
        part = self.nodes.get(str(row[1])) if isinstance(row, list) and len(row) == 2 else None
        return part if isinstance(part, Part) and mesh in part.meshes else None

    def touching(self, part: str) -> Collection[str]:
        if self._shards.holds("nodes", "part"):
            return [str(other) for other in self._around(part)[3] or ()]
        return self._whole.touching(part)

    def cluster_of(self, part: str) -> str | None:
        return self._around(part)[1] if self._shards.holds("nodes", "part") else self._whole.cluster_of(part)

    def unit_of(self, part: str) -> str | None:
        return self._around(part)[2] if self._shards.holds("nodes", "part") else self._whole.unit_of(part)

    @cached_property
    def _whole(self) -> WholeContent:
        """Where only edges are in shards, there is nothing to look parts up in."""
        return WholeContent(self.document)

    @cached_property
    def _names(self) -> Names:
        return Names(self._few)

    def _around(self, part: str) -> tuple[str, str | None, str | None, list[str] | None]:
        row = self._shards.row("lookup", "around", part)
        if row is None:
            return part, None, None, None
        if not (isinstance(row, list) and len(row) == 4 and isinstance(row[3], list)):
            raise FormatError(f"{self._where}: what lies around {part!r} is damaged; build the graph anew")
        return row[0], row[1], row[2], row[3]

    def _part(self, row: Any) -> Part:
        return cast("Part", self._record(Part, row))

    def _record(self, kind: type[Any], row: Any) -> Any:
        try:
            return kind.model_validate(row)
        except ValidationError as error:
            fault = error.errors()[0]
            steps = ".".join(str(step) for step in fault["loc"])
            raise FormatError(
                f"{self._where}: a row of its shards is damaged: {kind.__name__.lower()}.{steps}: {fault['msg']}; "
                "build the graph anew"
            ) from None
