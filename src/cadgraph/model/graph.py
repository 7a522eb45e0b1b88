"""The scene graph: typed access to its nodes and edges, and ``graph.json`` on disk.

Nodes and edges load as they are with ``networkx.node_link_graph(data, edges="edges", multigraph=True)``.
"""

from __future__ import annotations

import copy
import hashlib
import reprlib
from collections import Counter, deque
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast, get_args, overload

from cadgraph._io.atomic import write_atomically
from cadgraph._io.depth import MOST_LEVELS, is_too_deep
from cadgraph._io.garbage import collector_paused
from cadgraph._io.json_rows import read_json, write_json_rows
from cadgraph._io.limits import GRAPH, decoded, read_text_within
from cadgraph._io.manifest import GRAPH_FILE, behind, no_graph, read_checked
from cadgraph._io.results import settle_if_free
from cadgraph._io.run_folder import one_of_results
from cadgraph._io.shard_files import FOLDER, sweep_shards
from cadgraph._io.staging import result_path
from cadgraph.errors import FormatError, UnknownNode
from cadgraph.model.content import Content, ShardedContent, WholeContent, validated
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.pipework import Direction, Pipework, check_direction
from cadgraph.model.records import (
    ROWS_OF,
    AnyEdge,
    AnyNode,
    Cluster,
    Connected,
    Contains,
    Edge,
    GraphDocument,
    Joint,
    Junction,
    Node,
    Part,
    Related,
    Site,
    SourceRecord,
    System,
    Terminal,
    Unit,
)
from cadgraph.model.shards import ABOVE, Index, cut, is_cut
from cadgraph.model.source_file import changed_since

if TYPE_CHECKING:
    import networkx

__all__ = ["SceneGraph", "shards_in"]

FORMAT = "cadgraph"
VERSION = 1

Functional = Unit | Junction | Terminal


class SceneGraph:
    """A finished graph with typed access.

    Args:
        document: the content, as it stands on disk.

    Attributes:
        digest: SHA-256 of the file that it was read from; None where it was made in memory.

    Raises:
        FormatError: an id is used twice, an edge ends nowhere, or there isn't exactly one site.
    """

    def __init__(self, document: GraphDocument | Content) -> None:
        self._content = document if isinstance(document, Content) else WholeContent(document)
        self.digest: str | None = None
        self._folder: Path | None = None  # that it was read from
        self.nodes: Mapping[str, Node] = self._content.nodes

    def __repr__(self) -> str:
        layer, kind = self._content.count_layer, self._content.count_kind
        always = {"part": layer("part"), "cluster": layer("cluster"), "unit": layer("unit")}
        others = {"mesh": self.source.n_meshes, "contact": kind("adjacent"), "connection": kind("connected")}
        others |= {"junction": layer("junction"), "end": layer("terminal"), "system": layer("system")}
        words = [_count(n, noun) for noun, n in (always | {name: n for name, n in others.items() if n}).items()]
        return f"<SceneGraph of {self.source.path!r}: {', '.join(words)}>"

    # What is in the graph

    @property
    def document(self) -> GraphDocument:
        """The content as one document; of a graph in shards all of them are read for it."""
        return self._content.document

    @property
    def source(self) -> SourceRecord:
        """Where the scene came from."""
        return self._content.head.source

    @property
    def vocabulary(self) -> dict[str, Any]:
        """The tree of labels that it was made with."""
        return self._content.head.vocabulary

    @property
    def config(self) -> dict[str, Any]:
        """The settings that it was made with; a copy."""
        return copy.deepcopy(self._content.head.config)

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """Everything skipped, repaired, guessed or left unlabelled."""
        return self._content.diagnostics

    @property
    def lacks_corrections(self) -> bool:
        """Whether the folder that it was read from holds corrections that it doesn't show; looked up anew each time.

        A viewer writes each at once, and the graph when it has time to.
        """
        if self._folder is None:
            return False
        try:
            return behind(self._folder)
        except FormatError:
            return True

    @property
    def changed_source(self) -> str:
        """How the file that it was made from has changed since, in words; empty where it hasn't, or isn't found, or the
        graph was not read from a file. Looked up anew each time.
        """
        return "" if self._folder is None else changed_since(self.source, result_path(self._folder / GRAPH_FILE))

    @property
    def site(self) -> Site:
        """The root."""
        return self.of_layer(Site)[0]

    def of_layer(self, layer: type[AnyNode]) -> list[AnyNode]:
        """All nodes of a class (``Part``, ``Unit``...), in the order of the file.

        Raises:
            TypeError: it is no class.
        """
        _check_class(layer, "Part")
        return self._content.of_layer(layer)

    def of_kind(self, kind: type[AnyEdge]) -> list[AnyEdge]:
        """All edges of a class (``Adjacent``, ``Related``...), in the order of the file.

        Raises:
            TypeError: it is no class.
        """
        _check_class(kind, "Adjacent")
        return self._content.of_kind(kind)

    def count(self, what: str) -> int:
        """How many nodes of a layer (``"part"``), or edges of a kind (``"adjacent"``), there are; none is read.

        Raises:
            ValueError: no layer and no kind is called so.
        """
        if what not in _COUNTED:
            raise ValueError(f"nothing is counted as {what!r:.60}; there are {', '.join(sorted(_COUNTED))}")
        return self._content.count_layer(what) + self._content.count_kind(what)

    @property
    def label_counts(self) -> Mapping[tuple[str, str | None], int]:
        """How many parts have which group and name; a copy."""
        return Counter(self._content.labels)

    @property
    def nodes_but_parts(self) -> tuple[Node, ...]:
        """All nodes that are no part, in the order of the file; of a graph in shards none else is read for it."""
        return self._content.nodes_but_parts

    def clusters(self, kind: str | None = None) -> list[Cluster]:
        """All connected structures, or those of one kind (``"pipe system"``)."""
        return [node for node in self.of_layer(Cluster) if kind is None or node.kind == kind]

    def parts(self, group: str | None = None, name: str | None = None, cluster: str | None = None) -> list[Part]:
        """All parts, or those with this group label, this name label, in the cluster of this id.

        Raises:
            ValueError: the graph's vocabulary has no such group, or no such name.
            KeyError: no cluster has that id.
        """
        self._check_label(group, name)
        if cluster is not None and not isinstance(self.nodes.get(cluster), Cluster):
            raise UnknownNode(f"no cluster has the id {cluster!r}")
        members = self._members.get(cluster, ()) if cluster is not None else None
        return [
            part
            for part in self.of_layer(Part)
            if (group is None or (part.label is not None and part.label.group == group))
            and (name is None or (part.label is not None and part.label.name == name))
            and (members is None or part.id in members)
        ]

    def units(self, unit_type: str | None = None) -> list[Unit]:
        """All functional units, or those of one type (``"valve"``).

        Raises:
            ValueError: no unit is of that type and the graph's vocabulary has none such.
        """
        if unit_type is not None and self.vocabulary and unit_type not in self._unit_types():
            known = ", ".join(sorted(self._unit_types()))
            raise ValueError(f"no type of units is called {unit_type!r}; there are {known or 'none'}")
        return [unit for unit in self.of_layer(Unit) if unit_type is None or unit.unit_type == unit_type]

    def junctions(self) -> list[Junction]:
        """All points where three or more branches of connectors meet."""
        return self.of_layer(Junction)

    def terminals(self, kind: str | None = None) -> list[Terminal]:
        """All ends of runs without a unit, or those of one kind (``"open"``)."""
        return [end for end in self.of_layer(Terminal) if kind is None or end.kind == kind]

    def systems(self) -> list[System]:
        """All connected functional networks."""
        return self.of_layer(System)

    def connections(self, node: Functional | str | None = None) -> list[Connected]:
        """All connections along pipes, or those that end at this unit (by tag, id or itself), junction or terminal.

        Raises:
            KeyError: that node is not in the graph.
        """
        if node is None:
            return self.of_kind(Connected)
        here = self._resolve(node).id
        return [edge for edge in self.of_kind(Connected) if here in (edge.source, edge.target)]

    def part(self, which: str) -> Part:
        """The part with this id, or that holds the mesh of this source path.

        Raises:
            KeyError: neither is in the graph.
        """
        return cast("Part", self.find(which, Part))

    def part_with(self, mesh: str) -> Part | None:
        """The part that holds the mesh of exactly this source path; None where no part does."""
        return self._content.part_with(mesh)

    def unit(self, which: str) -> Unit:
        """The unit with this tag or id.

        Raises:
            KeyError: neither is in the graph.
        """
        return cast("Unit", self.find(which, Unit))

    def find(self, which: str, *layers: type[Node]) -> Node:
        """The node with this tag or id, or whose part holds the mesh of this source path.

        A tag or id may be spelt loosely (``v4`` for ``V-004``) where only one is meant; a part stands for the unit,
        junction or terminal that it belongs to, where no parts are asked for.

        Args:
            which: the tag, id or path.
            layers: what it may be (``Part``, ``Unit``...); anything if none is given.

        Raises:
            UnknownNode: there is none, which is a ``KeyError``; the message names the nearest ones.
            TypeError: it is no name.
        """
        # A node stands for itself; whatever else is no text is told as such.
        name = which if isinstance(which, str) else self._resolve(which).id
        return self._content.find(name, layers or get_args(Node))

    def unit_of(self, part: Part | str) -> Unit | None:
        """The unit that a part belongs to, if any; a unit belongs to itself.

        Raises:
            KeyError: the part is not in the graph.
        """
        here = self._resolve(part)
        node = here if isinstance(here, Unit) else self.nodes.get(self._content.unit_of(here.id) or "")
        return node if isinstance(node, Unit) else None

    def cluster_of(self, node: Part | Unit | str) -> Cluster | None:
        """The cluster that a part, or the parts of a unit, belong to; None for the ground and for noise.

        Raises:
            KeyError: the part or unit is not in the graph.
        """
        here = self._resolve(node)
        members = here.parts if isinstance(here, Unit | Junction | Terminal) else (here.id,)
        found = (self._content.cluster_of(part) for part in members)
        cluster = self.nodes.get(next((name for name in found if name is not None), ""))
        return cluster if isinstance(cluster, Cluster) else None

    # How things hang together

    @overload
    def neighbors(self, node: Part, direction: None = None) -> list[Part]: ...
    @overload
    def neighbors(self, node: Unit | Junction | Terminal, direction: Direction | None = None) -> list[Unit]: ...
    @overload
    def neighbors(self, node: str, direction: Direction | None = None) -> list[Part] | list[Unit]: ...
    def neighbors(self, node: Part | Functional | str, direction: Direction | None = None) -> list[Part] | list[Unit]:
        """The parts that touch a part, or the units next to a unit along the pipes, in the order of the file.

        Along the pipes means over connections with no other unit between; junctions are walked through. Of a junction
        or terminal: the units next to it. What Algorithm 1 of the paper relates is :meth:`related`.

        Args:
            node: a part or unit by itself, its id, tag or path of a mesh; or a junction or terminal.
            direction: only what is known to lie ``downstream`` or ``upstream``, and the instruments on the way.

        Raises:
            KeyError: it is not in the graph.
            ValueError: it has no neighbours by its nature, as a cluster; no such direction, or one of a part.
        """
        here = self._resolve(node)
        _check_way(here, direction)
        if isinstance(here, Part):
            found = [self.nodes[i] for i in self._content.touching(here.id)]
            return [other for other in found if isinstance(other, Part)]
        if not isinstance(here, Unit | Junction | Terminal):
            raise ValueError(f"parts and units have neighbours, but {here.id!r} is a {here.layer}")
        around = self._pipework.units_around(here.id, self._pipework.follower(direction))
        return [unit for unit in self.of_layer(Unit) if unit.id in around]

    def path(
        self, start: Part | Functional | str, end: Part | Functional | str, direction: Direction | None = None
    ) -> list[Node]:
        """A shortest way from one part to another over parts that touch, or from one unit to another along the pipes.

        Of parts the way with the fewest of them, of units the shortest along the centrelines, as ``cadgraph trace``
        finds it, with the junctions that it runs through.

        Args:
            start: where it begins.
            end: where it leads.
            direction: go only with the flow (``downstream``) or only against it (``upstream``); None goes both ways.

        Returns:
            The nodes on the way, both ends included; empty if no way is known.

        Raises:
            KeyError: an end is not in the graph.
            ValueError: the ends are not two parts, nor two units; no such direction, or one of parts.
        """
        first, last = self._resolve(start), self._resolve(end)
        kinds = {"part" if isinstance(node, Part) else node.layer for node in (first, last)}
        if kinds != {"part"} and not kinds <= {"unit", "junction", "terminal"}:
            raise ValueError(
                f"a path joins two parts or two units, not {first.id!r} ({first.layer}) and {last.id!r} ({last.layer})"
            )
        _check_way(first, direction)
        if kinds == {"part"}:
            return [self.nodes[step] for step in self._over_parts(first.id, last.id)]
        _, ways = self._pipework.shortest(first.id, self._pipework.follower(direction))
        if last.id not in ways:
            return []
        return [first, *(self.nodes[arc.end] for arc in ways[last.id])]

    @overload
    def related(self, node: None = None) -> list[Related]: ...
    @overload
    def related(self, node: Unit | str) -> list[Unit]: ...
    def related(self, node: Unit | str | None = None) -> list[Unit] | list[Related]:
        """The units that Algorithm 1 of the paper relates to a unit, or without one all of its relations.

        The paper's relation says that two units are near each other along connector parts that touch. What follows
        what along the pipes is :meth:`neighbors` and :meth:`connections`.

        Args:
            node: a unit by itself, its tag or id; None for all relations.

        Raises:
            KeyError: it is not in the graph.
            ValueError: it is no unit.
        """
        if node is None:
            return self.of_kind(Related)
        here = self._resolve(node)
        here = (self.unit_of(here) or here) if isinstance(here, Part) else here
        if not isinstance(here, Unit):
            raise ValueError(f"Algorithm 1 relates units, but {here.id!r} is a {here.layer}")
        others = {(e.target if e.source == here.id else e.source) for e in self._related_at(here.id)}
        return [unit for unit in self.of_layer(Unit) if unit.id in others]

    def joints(self, node: Part | Functional | str | None = None, made: bool | None = None) -> list[Joint]:
        """The joints that connections are made of, and the likeliest ones that were not made, in the order of the file.

        Args:
            node: only those at this part, or at a part of this unit, junction or terminal.
            made: only those that were made, or only those that were not.

        Raises:
            KeyError: it is not in the graph.
        """
        found = [joint for joint in self._content.joints if made is None or joint.made == made]
        if node is None:
            return found
        here = self._resolve(node)
        parts = set(here.parts) if isinstance(here, Unit | Junction | Terminal) else {here.id}
        return [joint for joint in found if joint.first in parts or joint.second in parts]

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
            FormatError: it does not follow the format or contradicts itself, see ``consistency.check_document``.
        """
        if not isinstance(data, Mapping) or data.get("format") != FORMAT:
            raise FormatError(f"{where}: not a cadgraph graph (key 'format' must be {FORMAT!r})")
        if data.get("version") != VERSION:
            raise FormatError(
                f"{where}: format version {data.get('version')!r}, but this cadgraph reads version {VERSION}; update it"
            )
        if is_too_deep(data):
            raise FormatError(f"{where}: holds values in more than {MOST_LEVELS} levels; build the graph anew")
        return cls(validated(data, where))

    @collector_paused()
    def save(self, path: str | Path, shard_above: int | None = None) -> Path:
        """Writes ``graph.json``, whole or not at all; the same graph gives the same bytes.

        Args:
            path: the file, or a folder that gets ``graph.json``. Into a folder of results it goes with their
                manifest, so that readers take it for what belongs there.
            shard_above: into a folder, kinds of nodes and edges of more rows than that go into shards beside it; by
                default the setting ``graph.shard_above`` that it was made with. A file is always whole.

        Returns:
            The file.

        Raises:
            OutputError: it can't be written, or another process is at work in the folder of results.
        """
        target = Path(path)
        whole = target.suffix == ".json" and not target.is_dir()
        target = target if whole else target / GRAPH_FILE
        above = _shard_above(self.config) if shard_above is None else shard_above
        content = self.document.content()
        parted = None if whole or not self._may_be_cut(above) else cut(content, above)
        with one_of_results(target, self.digest):
            if not whole:
                sweep_shards(target)
            if parted is not None:
                content, shards = parted
                for name, packed in shards:
                    write_atomically(target.parent / FOLDER / name, packed)
            write_json_rows(target, content, rows=ROWS_OF)
        if target.name == GRAPH_FILE:
            sweep_shards(target, of_whole=True)
        return target

    def spoilt_shards(self) -> tuple[str, ...]:
        """The shards that are gone, or not what ``graph.json`` was written with, by their paths beside it.

        Each is read whole. Of a graph in one file there are none.
        """
        return self._content.spoilt()

    def _may_be_cut(self, above: int) -> bool:
        """Whether so many rows of any kind are there that they go into shards."""
        document = self.document
        kinds = Counter(node.layer for node in document.nodes) + Counter(edge.kind for edge in document.edges)
        others = (len(getattr(document, key)) for key in ROWS_OF if key not in ("nodes", "edges"))
        return max((*kinds.values(), *others), default=0) > above

    @classmethod
    @collector_paused()
    def load(cls, path: str | Path) -> SceneGraph:
        """Reads ``graph.json``, or the folder that holds it.

        Raises:
            FormatError: it is missing, no JSON, or does not follow the format; or it is another one than the manifest
                of its folder names.
        """
        target = Path(path)
        target = target / GRAPH_FILE if target.is_dir() else target
        settle_if_free(target.parent)
        is_graph = target.suffix.lower() == ".json"
        remedy = "'cadgraph build' makes it" if is_graph else "give the folder that 'cadgraph build' wrote"
        try:
            content = read_checked(target, GRAPH, FormatError, remedy)
        except FormatError as error:
            if isinstance(error.__cause__, FileNotFoundError):
                raise FormatError(no_graph(target)) from error
            raise
        text = decoded(content, target, FormatError, remedy)
        try:
            data = read_json(text)
        except (ValueError, RecursionError) as error:
            raise FormatError(f"{target}: not JSON ({error}); give a folder that 'cadgraph build' wrote") from error
        if is_cut(data):
            if is_too_deep(data):
                raise FormatError(f"{target}: holds values in more than {MOST_LEVELS} levels; build the graph anew")
            graph = cls(ShardedContent(target.parent, data, str(target)))
        else:
            graph = cls.from_json(data, str(target))
        graph.digest = hashlib.sha256(content).hexdigest()
        graph._folder = target.parent if target.name == GRAPH_FILE else None
        return graph

    # Look-ups, made when first needed

    @cached_property
    def _pipework(self) -> Pipework:
        return Pipework(self._content.nodes_but_parts, self.of_kind(Connected))

    def _related_at(self, unit: str) -> list[Related]:
        return [edge for edge in self.of_kind(Related) if unit in (edge.source, edge.target)]

    def _over_parts(self, first: str, last: str) -> list[str]:
        """Ids of the fewest parts from one to another over parts that touch."""
        came_from: dict[str, str] = {first: first}
        queue = deque([first])
        while queue and last not in came_from:
            here = queue.popleft()
            for there in self._content.touching(here):
                if there not in came_from:
                    came_from[there] = here
                    queue.append(there)
        if last not in came_from:
            return []
        way = [last]
        while way[-1] != first:
            way.append(came_from[way[-1]])
        return way[::-1]

    @cached_property
    def _members(self) -> dict[str, set[str]]:
        members: dict[str, set[str]] = {}
        for edge in self.of_kind(Contains):
            members.setdefault(edge.source, set()).add(edge.target)
        return members

    def _resolve(self, which: Part | Functional | str) -> Node:
        if not isinstance(which, str):
            if not isinstance(getattr(which, "id", None), str):
                raise TypeError(f"give a part, a unit, or the id of one, not {reprlib.repr(which)}")
            if which.id not in self.nodes:
                raise UnknownNode(f"{which.id!r} is not in this graph")
            return self.nodes[which.id]
        return self._content.find(which, get_args(Node))

    def _unit_types(self) -> set[str]:
        """Those in the graph, and those of the vocabulary's groups."""
        trees = [tree for tree in self.vocabulary.values() if isinstance(tree, Mapping)]
        types = {str(tree["unit"]) for tree in trees if tree.get("unit")}
        return types | {unit.unit_type for unit in self.of_layer(Unit)}

    def _check_label(self, group: str | None, name: str | None) -> None:
        """A group or name that can't be in the graph is a mistake, not an empty answer."""
        known = self.vocabulary
        if not known or (group is None and name is None):
            return
        in_use = set(self.label_counts)
        if group is not None and group not in known and not any(group == used for used, _ in in_use):
            raise ValueError(f"no group is called {group!r}; the graph's vocabulary has {', '.join(map(str, known))}")
        if name is None or any(name == used for _, used in in_use):
            return
        trees = known.values() if group is None else [known.get(group)]
        names = [each for tree in trees if isinstance(tree, Mapping) for each in tree.get("names", ())]
        if name not in names:
            where = "the graph's vocabulary" if group is None else f"group {group!r}"
            raise ValueError(f"{where} has no name {name!r}; it has {', '.join(map(str, names))}")


def shards_in(folder: Path) -> int | None:
    """Above how many rows a kind must go into shards so that a graph is laid out as the one in a folder.

    Args:
        folder: of results.

    Returns:
        For :meth:`SceneGraph.save`; None: as the settings say, and so where no graph can be read.
    """
    if not (folder / FOLDER).is_dir():
        return None
    try:
        data = read_json(read_text_within(result_path(folder / GRAPH_FILE), GRAPH, FormatError, ""))
        index = Index.model_validate(data["shards"]) if is_cut(data) else Index(runs=())
        fewest = min((run.rows for run in index.runs if run.key != "lookup"), default=0)
        return 0 if 0 < fewest <= _shard_above(data.get("config", {})) else None
    except (FormatError, ValueError, RecursionError):
        return None


def _shard_above(config: Mapping[str, Any]) -> int:
    written = config.get("graph")
    above = written.get("shard_above") if isinstance(written, Mapping) else None
    return above if isinstance(above, int) and above > 0 else ABOVE


_COUNTED = frozenset(
    {str(one.model_fields["layer"].default) for one in get_args(Node)}
    | {str(one.model_fields["kind"].default) for one in get_args(Edge)}
)


def _check_class(given: object, such_as: str) -> None:
    if not isinstance(given, type):
        raise TypeError(f"give a class, as cadgraph.{such_as}, not {reprlib.repr(given)}")


def _check_way(node: Node, direction: str | None) -> None:
    check_direction(direction)
    if direction is not None and isinstance(node, Part):
        raise ValueError(f"parts that touch have no direction of flow, but {node.id!r} is a part; ask its unit")


def _count(n: int, noun: str) -> str:
    plural = {"mesh": "meshes"}.get(noun, f"{noun}s")
    return f"{n:,} {noun if n == 1 else plural}"
