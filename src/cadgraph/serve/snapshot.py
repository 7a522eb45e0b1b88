"""The plant as it was after one change: what requests are answered from, by any thread."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from cadgraph.draw.schematic import draw_diagram
from cadgraph.draw.web.content import content_of, network_of, parts_of
from cadgraph.model.graph import SceneGraph
from cadgraph.model.pipework import Direction
from cadgraph.model.records import Part
from cadgraph.model.scene import Scene
from cadgraph.query import Doubt, Network, Trace, find_isolation, find_way, trace
from cadgraph.query.explain import explain_any
from cadgraph.query.text import isolation_lines, trace_lines, way_lines

__all__ = ["Snapshot", "difference", "json_bytes"]


def json_bytes(values: Any) -> bytes:
    """Plain values as JSON in ASCII: a name from a file may hold half a character, which has no UTF-8.

    Raises:
        ValueError: a number is infinite or NaN.
    """
    return json.dumps(values, allow_nan=False, separators=(",", ":")).encode("ascii")


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
        return json_bytes(content_of(self.graph, self.scene, self.version))

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
            return {"title": title, "lines": trace_lines(found), **self._way(found)}
        found = find_way(self.network, at, to, direction)
        title = f"from {self.network.name(found.start)} to {self.network.name(self.network.find(to))}"
        return {"title": title, "lines": way_lines(found, at, to), **self._way(found)}

    def _way(self, found: Trace) -> dict[str, Any]:
        return {
            "places": [step.place for step in found.steps],
            "connections": list(found.connections),
            "doubts": self._doubts(found.doubts),
        }

    def isolate(self, at: str) -> dict[str, Any]:
        """What must be closed to cut a unit off, and what is cut off with it.

        Raises:
            ValueError: nothing is called so, or no line is known at it.
        """
        found = find_isolation(self.network, at)
        return {
            "title": f"isolate {found.name}",
            "lines": isolation_lines(found),
            "sure": found.isolated is True,
            "close": [valve.place for valve in found.valves if not valve.automatic],
            "places": [found.target, *found.shut_off],
            "connections": list(found.connections),
            "doubts": self._doubts(found.doubts),
        }

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
    if [(part.id, part.meshes) for part in old] != [(part.id, part.meshes) for part in new]:
        nothing = {"changed": [], "rows": [], "parts": parts_of(now.graph, ()), "reload": True}
        return {**nothing, "network": network_of(now.graph, now.row_of), "diagnostics": _diagnostics(now)}
    rows = [
        row
        for row, (was, part) in enumerate(zip(old, new, strict=True))
        if before.unit_row_of.get(part.id) != now.unit_row_of.get(part.id) or (was is not part and was != part)
    ]
    return {
        "changed": sorted(now.row_of[part.id] for part in changed),
        "rows": rows,
        "parts": parts_of(now.graph, [new[row].id for row in rows]),
        "network": network_of(now.graph, now.row_of),
        "diagnostics": _diagnostics(now),
        "reload": False,
    }


def _diagnostics(now: Snapshot) -> list[dict[str, Any]]:
    found = []
    for one in now.graph.diagnostics:
        parts = {part.id: None for mesh in one.meshes if (part := now.graph.part_with(mesh)) is not None}
        found.append({"code": one.code, "message": one.message, "parts": [now.row_of[part] for part in parts]})
    return found
