"""What stands left of what: an order of the nodes of a network with the flow, as far as loops allow."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

from cadgraph._io.text import tag_key
from cadgraph.model.records import Terminal
from cadgraph.query.lines import Line
from cadgraph.query.network import Network

__all__ = ["order_anchors"]

Links = dict[str, list[str]]


def order_anchors(network: Network, anchors: Sequence[str], lines: Sequence[Line]) -> dict[str, int]:
    """A rank of each anchor, from left to right.

    Lines of unknown direction are taken to lead away from the sources: tanks, ends that the flow comes from, open ends
    on the suction side of pumps. What comes back to where the flow has been is drawn from right to left, so that a
    recirculation is a row of its own beside the main run.

    Args:
        network: of the graph.
        anchors: ids of the nodes that lines end at, of one connected network.
        lines: between them.
    """
    known: Links = {place: [] for place in anchors}
    back: Links = {place: [] for place in anchors}
    unknown: Links = {place: [] for place in anchors}
    width: dict[str, int] = {}
    for line in lines:
        start, end = (line.end, line.start) if line.flow == "backward" else (line.start, line.end)
        for place in (start, end):
            width[place] = max(width.get(place, 0), *line.sizes, 0)
        if line.flow in ("forward", "backward"):
            known[start].append(end)
            back[end].append(start)
        else:
            unknown[start].append(end)
            unknown[end].append(start)
    suction = _suction_side(network, known, back, unknown)

    def rank(place: str) -> tuple[object, ...]:
        node = network.places[place]
        is_end = isinstance(node, Terminal)
        feeds = bool(known[place]) and not back[place] and not unknown[place]
        open_suction = place in suction and isinstance(node, Terminal) and node.kind != "blind"
        is_pump = network.unit_type(place) == "pump"
        tank_first = network.unit_type(place) == "tank" and (known[place] or unknown[place])
        return (
            not tank_first, not feeds, not open_suction, place not in suction, not is_end, is_pump,
            -width.get(place, 0), tag_key(network.name(place)),
        )  # fmt: skip

    roots = sorted(anchors, key=rank)
    ahead = _oriented(roots, known, unknown)
    finished: list[str] = []
    seen: set[str] = set()
    for root in roots:
        if root not in seen:
            _visit(root, ahead, seen, finished)
    return {place: i for i, place in enumerate(reversed(finished))}


def _suction_side(network: Network, known: Links, back: Links, unknown: Links) -> set[str]:
    """What could feed a pump: all that lies before one against known flow or over unknown, but not behind another."""
    pumps = {place for place in known if network.unit_type(place) == "pump"}
    found = {place for pump in pumps for place in back[pump]}
    waiting = deque(found)
    while waiting:
        place = waiting.popleft()
        if place in pumps:
            continue
        for other in (*back[place], *unknown[place]):
            if other not in found:
                found.add(other)
                waiting.append(other)
    return found - pumps


def _oriented(roots: Sequence[str], known: Links, unknown: Links) -> Links:
    """All lines with a direction: the known one, else away from the root that reaches them first."""
    ahead: Links = {place: list(after) for place, after in known.items()}
    seen: set[str] = set()
    rank: dict[str, int] = {}
    for root in roots:
        if root in seen:
            continue
        seen.add(root)
        waiting = deque([root])
        while waiting:
            place = waiting.popleft()
            rank[place] = len(rank)
            for other in sorted((*known[place], *unknown[place]), key=tag_key):
                if other not in seen:
                    seen.add(other)
                    waiting.append(other)
    for place, others in unknown.items():
        ahead[place] += [other for other in others if rank[place] < rank[other]]
    return ahead


def _visit(root: str, ahead: Links, seen: set[str], finished: list[str]) -> None:
    """Depth first without recursion, for plants of any size; a node is finished after all that it leads to."""
    stack = [(root, iter(sorted(ahead[root], key=tag_key)))]
    seen.add(root)
    while stack:
        place, onward = stack[-1]
        step = next((one for one in onward if one not in seen), None)
        if step is None:
            finished.append(place)
            stack.pop()
        else:
            seen.add(step)
            stack.append((step, iter(sorted(ahead[step], key=tag_key))))
