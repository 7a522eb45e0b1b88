"""The scene graph: typed access to its nodes and edges, and ``graph.json`` on disk.

Nodes and edges load as they are with ``networkx.node_link_graph(data, edges="edges", multigraph=True)``.
"""

from __future__ import annotations

import json
from collections import deque
from collections.abc import Iterable, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast, overload

from pydantic import ValidationError

from cadgraph.atomic import write_atomically
from cadgraph.errors import FormatError
from cadgraph.records import (
    AnyEdge,
    AnyNode,
    Cluster,
    Contains,
    Finding,
    GraphDocument,
    Node,
    Part,
    Site,
    SourceRecord,
    Unit,
)

if TYPE_CHECKING:
    import networkx

__all__ = ["SceneGraph"]

FORMAT = "cadgraph"
VERSION = 1


class SceneGraph:
    """A finished graph with typed access.

    Args:
        document: the content, as it stands on disk.

    Raises:
        FormatError: an id is used twice, an edge ends nowhere, or there isn't exactly one site.
    """

    def __init__(self, document: GraphDocument) -> None:
        self.document = document
        self.nodes: dict[str, Node] = {node.id: node for node in document.nodes}
        if len(self.nodes) != len(document.nodes):
            raise FormatError(f"node id {_first_repeat(node.id for node in document.nodes)!r} is used twice")
        if len(self.of_layer(Site)) != 1:
            raise FormatError(f"a graph needs exactly one node of layer 'site', found {len(self.of_layer(Site))}")
        for edge in document.edges:
            for end in (edge.source, edge.target):
                if end not in self.nodes:
                    raise FormatError(f"a {edge.kind!r} edge names {end!r}, but no node has that id")

    # What is in the graph

    @property
    def source(self) -> SourceRecord:
        """Where the scene came from."""
        return self.document.source

    @property
    def diagnostics(self) -> tuple[Finding, ...]:
        """Everything skipped, repaired, guessed or left unlabelled."""
        return self.document.diagnostics

    @property
    def site(self) -> Site:
        """The root."""
        return self.of_layer(Site)[0]

    def of_layer(self, layer: type[AnyNode]) -> list[AnyNode]:
        """All nodes of a class (``Part``, ``Unit``...), in the order of the file."""
        return [node for node in self.document.nodes if isinstance(node, layer)]

    def of_kind(self, kind: type[AnyEdge]) -> list[AnyEdge]:
        """All edges of a class (``Adjacent``, ``Related``...), in the order of the file."""
        return [edge for edge in self.document.edges if isinstance(edge, kind)]

    def clusters(self, kind: str | None = None) -> list[Cluster]:
        """All connected structures, or those of one kind (``"pipe system"``)."""
        return [node for node in self.of_layer(Cluster) if kind is None or node.kind == kind]

    def parts(self, group: str | None = None, name: str | None = None, cluster: str | None = None) -> list[Part]:
        """All parts, or those with this group label, this name label, in the cluster of this id."""
        members = self._members.get(cluster, ()) if cluster is not None else None
        return [
            part
            for part in self.of_layer(Part)
            if (group is None or (part.label is not None and part.label.group == group))
            and (name is None or (part.label is not None and part.label.name == name))
            and (members is None or part.id in members)
        ]

    def units(self, unit_type: str | None = None) -> list[Unit]:
        """All functional units, or those of one type (``"valve"``)."""
        return [unit for unit in self.of_layer(Unit) if unit_type is None or unit.unit_type == unit_type]

    def part(self, which: str) -> Part:
        """The part with this id, or that holds the mesh of this source path.

        Raises:
            KeyError: neither is in the graph.
        """
        node = self.nodes.get(which) or self.nodes.get(self._part_of_mesh.get(which, ""))
        if not isinstance(node, Part):
            raise KeyError(f"no part has the id or holds the mesh {which!r}")
        return node

    def unit(self, which: str) -> Unit:
        """The unit with this tag or id.

        Raises:
            KeyError: neither is in the graph.
        """
        for unit in self.of_layer(Unit):
            if which in (unit.tag, unit.id):
                return unit
        raise KeyError(f"no unit has the tag or id {which!r}")

    def unit_of(self, part: Part | str) -> Unit | None:
        """The unit that a part belongs to, if any."""
        node = self.nodes.get(self._unit_of_part.get(_id(part), ""))
        return node if isinstance(node, Unit) else None

    def cluster_of(self, part: Part | str) -> Cluster | None:
        """The cluster that a part belongs to; None for the ground and for noise."""
        node = self.nodes.get(self._cluster_of_part.get(_id(part), ""))
        return node if isinstance(node, Cluster) else None

    # How things hang together

    @overload
    def neighbors(self, node: Part) -> list[Part]: ...
    @overload
    def neighbors(self, node: Unit) -> list[Unit]: ...
    @overload
    def neighbors(self, node: str) -> list[Part] | list[Unit]: ...
    def neighbors(self, node: Part | Unit | str) -> list[Part] | list[Unit]:
        """The parts adjacent to a part, or the units related or connected to a unit, in the order of the file."""
        here = self._resolve(node)
        found = [self.nodes[i] for i in sorted(self._links[here.id], key=self._rank.__getitem__)]
        if isinstance(here, Unit):
            return [other for other in found if isinstance(other, Unit)]
        return [other for other in found if isinstance(other, Part)]

    def path(self, start: Part | Unit | str, end: Part | Unit | str) -> list[Node]:
        """A shortest way from one part to another over adjacent parts, or from one unit to another over relations.

        Returns:
            The nodes on the way, both ends included; empty if there is no way.

        Raises:
            KeyError: an end is not in the graph.
        """
        first, last = self._resolve(start), self._resolve(end)
        if isinstance(first, Unit) != isinstance(last, Unit):
            raise ValueError(f"a path joins two parts or two units, not {first.id!r} and {last.id!r}")
        came_from: dict[str, str] = {first.id: first.id}
        queue = deque([first.id])
        while queue and last.id not in came_from:
            here = queue.popleft()
            for there in sorted(self._links[here], key=self._rank.__getitem__):
                if there not in came_from:
                    came_from[there] = here
                    queue.append(there)
        if last.id not in came_from:
            return []
        way = [last.id]
        while way[-1] != first.id:
            way.append(came_from[way[-1]])
        return [self.nodes[step] for step in reversed(way)]

    def to_networkx(self) -> networkx.MultiDiGraph[str]:
        """The graph for networkx: node and edge attributes as in ``graph.json``, edge keys 0, 1... per pair."""
        import networkx

        data = self.to_json()
        return cast("networkx.MultiDiGraph[str]", networkx.node_link_graph(data, edges="edges", multigraph=True))

    # On disk

    def to_json(self) -> dict[str, Any]:
        """The content of ``graph.json`` as plain values."""
        return self.document.model_dump(mode="json")

    @classmethod
    def from_json(cls, data: Mapping[str, Any], where: str = "graph") -> SceneGraph:
        """Reads the content of ``graph.json``.

        Args:
            data: plain values.
            where: the file's name, for messages.

        Raises:
            FormatError: it does not follow the format.
        """
        if not isinstance(data, Mapping) or data.get("format") != FORMAT:
            raise FormatError(f"{where}: not a cadgraph graph (key 'format' must be {FORMAT!r})")
        if data.get("version") != VERSION:
            raise FormatError(
                f"{where}: format version {data.get('version')!r}, but this cadgraph reads version {VERSION}; update it"
            )
        try:
            return cls(GraphDocument.model_validate(data))
        except ValidationError as error:
            first = error.errors()[0]
            place = ".".join(str(step) for step in first["loc"])
            raise FormatError(f"{where}: {place}: {first['msg']}") from None
        except FormatError as error:
            raise FormatError(f"{where}: {error}") from None

    def save(self, path: str | Path) -> Path:
        """Writes ``graph.json``, whole or not at all; the same graph gives the same bytes.

        Args:
            path: the file, or a folder that gets ``graph.json``.

        Returns:
            The file.

        Raises:
            OutputError: it can't be written.
        """
        target = Path(path)
        target = target / "graph.json" if target.suffix != ".json" else target
        data = self.to_json()
        lines = []
        for key, value in data.items():
            if key in ("nodes", "edges", "diagnostics") and value:
                rows = ",\n".join("  " + _dumps(row) for row in value)
                lines.append(f" {_dumps(key)}: [\n{rows}\n ]")
            else:
                lines.append(f" {_dumps(key)}: {_dumps(value)}")
        text = "{\n" + ",\n".join(lines) + "\n}\n"
        # A lone surrogate has no UTF-8, but its backslash form is what JSON calls it.
        write_atomically(target, text.encode("utf-8", "backslashreplace"))
        return target

    @classmethod
    def load(cls, path: str | Path) -> SceneGraph:
        """Reads ``graph.json``, or the folder that holds it.

        Raises:
            FormatError: it is missing, no JSON, or does not follow the format.
        """
        target = Path(path)
        target = target / "graph.json" if target.is_dir() else target
        try:
            data = json.loads(target.read_text(encoding="utf-8"))
        except OSError as error:
            raise FormatError(f"{target}: can't be read ({error.strerror}); 'cadgraph build' makes it") from error
        except (ValueError, RecursionError) as error:
            raise FormatError(f"{target}: not JSON ({error})") from error
        return cls.from_json(data, str(target))

    # Look-ups, made when first needed

    @cached_property
    def _rank(self) -> dict[str, int]:
        return {node.id: i for i, node in enumerate(self.document.nodes)}

    @cached_property
    def _links(self) -> dict[str, set[str]]:
        links: dict[str, set[str]] = {node: set() for node in self.nodes}
        for edge in self.document.edges:
            if not isinstance(edge, Contains):
                links[edge.source].add(edge.target)
                links[edge.target].add(edge.source)
        return links

    @cached_property
    def _members(self) -> dict[str, set[str]]:
        members: dict[str, set[str]] = {}
        for edge in self.of_kind(Contains):
            members.setdefault(edge.source, set()).add(edge.target)
        return members

    @cached_property
    def _cluster_of_part(self) -> dict[str, str]:
        return {m: c.id for c in self.of_layer(Cluster) for m in self._members.get(c.id, ())}

    @cached_property
    def _unit_of_part(self) -> dict[str, str]:
        return {part: unit.id for unit in self.of_layer(Unit) for part in unit.parts}

    @cached_property
    def _part_of_mesh(self) -> dict[str, str]:
        return {mesh: part.id for part in self.of_layer(Part) for mesh in part.meshes}

    def _resolve(self, which: Part | Unit | str) -> Node:
        if not isinstance(which, str):
            return self.nodes[which.id]
        if which in self.nodes:
            return self.nodes[which]
        for unit in self.of_layer(Unit):
            if unit.tag == which:
                return unit
        return self.part(which)


def _id(node: Part | Unit | str) -> str:
    return node if isinstance(node, str) else node.id


def _dumps(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)


def _first_repeat(names: Iterable[str]) -> str:
    seen: set[str] = set()
    for name in names:
        if name in seen:
            return name
        seen.add(name)
    return ""
