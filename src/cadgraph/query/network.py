"""The functional network of a graph: its pipework, with systems and what hangs at each node."""

from __future__ import annotations

import math
import reprlib
from functools import cached_property

from cadgraph._io.text import natural_key
from cadgraph.errors import Unconnected
from cadgraph.model.graph import SceneGraph
from cadgraph.model.pipework import Arc, Flow, Pipework, Place
from cadgraph.model.records import Connected, Joint, Junction, System, Terminal, Unit

__all__ = ["DRAWN_FROM_DOUBT", "Arc", "Flow", "Network", "Place"]

DRAWN_FROM_DOUBT = "dexpi-doubtful"
"""Code of the diagnostic that lists the nodes of a drawing at which the graph that it was written from had doubts."""

_BETWEEN = 3  # pieces from a gauge to what it is mounted at: a cock, a flange, a nozzle


class Network(Pipework):
    """All ``connected`` edges of a graph with their nodes.

    Args:
        graph: the finished graph; it stays as it is.
    """

    def __init__(self, graph: SceneGraph) -> None:
        if not isinstance(graph, SceneGraph):
            raise TypeError(f"give a SceneGraph, as cadgraph.build makes it, not {reprlib.repr(graph)}")
        super().__init__(graph.nodes_but_parts, graph.of_kind(Connected))
        self.graph = graph

    def find(self, which: str) -> str:
        """The id of the unit, junction or terminal with this tag or id, or that a part with this id or mesh belongs to.

        Raises:
            UnknownNode: there is none, which is a ``ValueError``; the message names the nearest tags.
        """
        return self.graph.find(which, Unit, Junction, Terminal).id

    def unconnected(self, place: str, asked: str) -> Unconnected:
        """The error that says that no line was found at a unit, and what it is mounted at.

        Args:
            place: its id.
            asked: what can't be said.
        """
        return Unconnected(self.name(place), asked, [self.name(unit) for unit in self.mounted_at(place)])

    def mounted_at(self, place: str) -> tuple[str, ...]:
        """The units that a unit without a line touches; of a gauge those nearest over pieces of nothing else.

        Between a level gauge and its tank there are often cocks, flanges and guards that are no unit and lie on no
        line. They count where none of them is larger than the gauge: what is larger may bear more than that.

        Args:
            place: its id.

        Returns:
            Ids, in the order of their tags; several where it can't be told at which of them. Empty for a unit with
            lines, and for what is no unit.
        """
        unit = self.places[place]
        if not isinstance(unit, Unit) or self.arcs(place):
            return ()
        largest = math.dist(*unit.aabb) if unit.unit_type == "gauge" else 0.0
        edge = [self.graph.part(part) for part in unit.parts]
        seen = {part.id for part in edge}
        for _ in range(1 + _BETWEEN):
            near = {part.id: part for piece in edge for part in self.graph.neighbors(piece) if part.id not in seen}
            owners = {owner for part in near if (owner := self.owner_of_part(part)) is not None}
            units = [owner for owner in owners if isinstance(self.places[owner], Unit)]
            if units:
                return tuple(sorted(units, key=lambda owner: natural_key(self.name(owner))))
            seen.update(near)
            edge = [part for part in near.values() if part.id not in self.carried and math.dist(*part.aabb) <= largest]
        return ()

    @cached_property
    def doubted(self) -> frozenset[str]:
        """Ids of the nodes of a drawing at which the graph that it was written from had doubts."""
        notes = (note for note in self.graph.diagnostics if note.code == DRAWN_FROM_DOUBT)
        return frozenset(name for note in notes for name in note.meshes)

    @cached_property
    def open_joints(self) -> tuple[Joint, ...]:
        """The joints that were not made, in the order of the file."""
        return tuple(joint for joint in self.graph.joints() if not joint.made)

    @cached_property
    def _owner_of_part(self) -> dict[str, str]:
        ordered = sorted(self.places.items(), key=lambda item: not isinstance(item[1], Unit))
        owner: dict[str, str] = {}
        for place, node in ordered:
            for part in node.parts:
                owner.setdefault(part, place)
        return owner

    def owner_of_part(self, part: str) -> str | None:
        """The id of the unit, else of the junction or terminal that a part belongs to."""
        return self._owner_of_part.get(part)

    @cached_property
    def carried(self) -> frozenset[str]:
        """Ids of the parts that connections run over or that belong to a node."""
        along = {part for place in self.places for arc in self.arcs(place) for part in arc.via}
        return frozenset(along.union(*(node.parts for node in self.places.values())))

    @cached_property
    def _system_of(self) -> dict[str, str]:
        return {
            place: system.id
            for system in self.graph.of_layer(System)
            for place in (*system.units, *system.junctions, *system.terminals)
        }

    def system(self, place: str) -> str | None:
        """The id of the system that a node belongs to."""
        return self._system_of.get(place)

    def main_arcs(self, place: str) -> tuple[Arc, ...]:
        """The connections of a node without those that only lead to an instrument."""
        return tuple(arc for arc in self.arcs(place) if not self.is_tap(arc))

    def tap_chains(self, place: str) -> tuple[tuple[str, ...], ...]:
        """What hangs at a node on taps: for each tap, from the node outwards, its root valves and gauges."""
        chains: list[tuple[str, ...]] = []
        for arc in self.arcs(place):
            found: list[str] = []
            step: Arc | None = arc if self.is_tap(arc) else None
            while step is not None:
                found.append(step.end)
                onward = [o for o in self.arcs(step.end) if o.index != step.index and self.is_tap(o)]
                step = onward[0] if onward else None
            if found:
                chains.append(tuple(found))
        return tuple(chains)

    def instruments(self, place: str) -> tuple[str, ...]:
        """All that hangs at a node on taps."""
        return tuple(name for chain in self.tap_chains(place) for name in chain)
