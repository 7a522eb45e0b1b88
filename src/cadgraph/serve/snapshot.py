"""The plant as it was after one change: what requests are answered from, by any thread."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from cadgraph.draw.colors import group_colors
from cadgraph.draw.schematic import draw_diagram
from cadgraph.draw.web.content import as_bytes, content_of, diagnostics_of, network_of, parts_of
from cadgraph.model.graph import SceneGraph
from cadgraph.model.pipework import Direction
from cadgraph.model.records import Part
from cadgraph.model.scene import Scene
from cadgraph.query import Doubt, Isolation, Network, Trace, find_isolation, find_way, trace
from cadgraph.query.explain import explain_any
from cadgraph.query.text import isolation_lines, trace_lines, way_lines

__all__ = ["Snapshot", "difference"]


@dataclass(frozen=True, eq=False)
class Snapshot:
    """A graph that stays as it is, with its scene.

    Args:
        version: of the content.
        graph: finished.
        scene: what is drawn.
    """

    version: int
    graph: SceneGraph
    scene: Scene

    @cached_property
    def network(self) -> Network:
        """Of the graph, with its look-ups."""
        return Network(self.graph)

    @cached_property
    def content(self) -> bytes:
        """All that the page is told of the graph, as JSON."""
        return as_bytes(content_of(self.graph, self.scene, self.version))

    @cached_property
    def schematic(self) -> bytes:
        """The functional graph as SVG."""
        return draw_diagram(self.network, for_page=True).encode("utf-8", "replace")

    @cached_property
    def row_of(self) -> dict[str, int]:
        """Of the id of each part its row."""
        return {part.id: row for row, part in enumerate(self.graph.parts())}

    @cached_property
    def unit_row_of(self) -> dict[str, int]:
        """Of the id of each part in a unit the row of that."""
        return {part: row for row, unit in enumerate(self.graph.units()) for part in unit.parts}

    def explain(self, which: str) -> dict[str, Any]:
        """What is known of a part, a unit, a junction or an end, in words.

        Raises:
            UnknownNode: the graph has nothing of that name.
        """
        return {"lines": [f"{heading:<12}{text}" for heading, text in explain_any(self.graph, which).lines()]}

    def trace(self, at: str, direction: Direction | None, to: str | None) -> dict[str, Any]:
        """What lies downstream or upstream of a unit, or on the way to another.

        Raises:
            ValueError: nothing is called so, no line is known at it, or there is no such direction.
        """
        if to is None:
            found = trace(self.network, at, direction or "downstream")
            title = f"{found.direction} of {self.network.name(found.start)}"
            return {"title": title, "lines": trace_lines(found, hints=False), **self._way(found)}
        found = find_way(self.network, at, to, direction)
        title = f"from {self.network.name(found.start)} to {self.network.name(self.network.find(to))}"
        return {"title": title, "lines": way_lines(found, at, to), **self._way(found)}

    def _way(self, found: Trace) -> dict[str, Any]:
        return {
            "places": [step.place for step in found.steps],
            "connections": list(found.connections),
            "doubts": [*self._doubts(found.doubts), *self._halts(found)],
        }

    def isolate(self, at: str) -> dict[str, Any]:
        """What must be closed to cut a unit off, and what is cut off with it.

        Raises:
            ValueError: nothing is called so, or no line is known at it.
        """
        found = find_isolation(self.network, at)
        return {
            "title": f"isolate {found.name}",
            "lines": isolation_lines(found, hints=False),
            "sure": found.isolated is True,
            "close": [valve.place for valve in found.valves if not valve.automatic],
            "places": [found.target, *found.shut_off],
            "connections": list(found.connections),
            "doubts": [*self._openings(found), *self._doubts(found.doubts)],
        }

    def _openings(self, found: Isolation) -> list[dict[str, Any]]:
        """Ways in that no valve closes, to be gone to like a doubt."""
        return [
            {"text": f"not closed by any valve: {one.name} ({one.what}): {one.why}", "parts": [], "place": one.place}
            for one in found.openings
        ]

    def _halts(self, found: Trace) -> list[dict[str, Any]]:
        """Where a trace goes no further, as nobody knows which way it flows: to be gone to like a doubt."""
        told = []
        for halt in found.halts:
            parts = [self.row_of[part] for part in self.network.edges[halt.connection].via]
            line = f" ({halt.line})" if halt.line else ""
            text = f"the way halts at {halt.after}: the direction of flow towards {halt.towards} is unknown{line}"
            told.append({"text": text, "parts": parts, "place": None if parts else halt.place})
        return told

    def _doubts(self, doubts: Sequence[Doubt]) -> list[dict[str, Any]]:
        return [
            {
                "text": f"{doubt.name}: {doubt.text}",
                "parts": [self.row_of[part] for part in doubt.parts],
                "place": doubt.place,
            }
            for doubt in doubts
        ]


def difference(before: Snapshot, now: Snapshot, changed: Sequence[Part]) -> dict[str, Any]:
    """What of the content is another one after a change.

    Args:
        before: the plant as the page knows it.
        now: the plant as it is.
        changed: parts with another label.

    Returns:
        The keys of an update from ``changed`` to ``reload``; where the parts themselves are others, only that.
    """
    old, new = before.graph.parts(), now.graph.parts()
    same = [(part.id, part.meshes) for part in old] == [(part.id, part.meshes) for part in new]
    same = same and list(group_colors(before.graph)) == list(group_colors(now.graph))
    rows = [
        row
        for row, (was, part) in enumerate(zip(old, new, strict=True) if same else ())
        if before.unit_row_of.get(part.id) != now.unit_row_of.get(part.id) or (was is not part and was != part)
    ]
    x, y, z = now.scene.origin.tolist()
    return {
        "changed": sorted(now.row_of[part.id] for part in changed) if same else [],
        "rows": rows,
        "parts": parts_of(now.graph, [new[row].id for row in rows], (x, y, z)),
        "network": network_of(now.graph, now.row_of, (x, y, z)),
        "diagnostics": diagnostics_of(now.graph),
        "reload": not same,
    }
