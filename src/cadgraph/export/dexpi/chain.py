"""What follows each other along the segments of a Proteus file, and how segments are joined."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Literal

from cadgraph.model.records import Connected

__all__ = ["Chain", "Direction", "Pipe", "as_chain", "join_through", "with_sensors"]

Direction = Literal["forward", "backward", "unknown"]
_SAME = 1e-6  # lengths along a line that differ by less are the same [m]
_TURNED: dict[Direction, Direction] = {"forward": "backward", "backward": "forward", "unknown": "unknown"}


@dataclass
class Pipe:
    """A stretch between two nodes, as it stands in the file.

    Args:
        length: along the centreline [m], or None.
        size: nominal size (DN), or None.
        direction: of the flow, along the chain or against it.
        reason: why the flow has that direction, or None.
        confidence: of the connection, or None.
    """

    length: float | None
    size: int | None
    direction: Direction
    reason: str | None
    confidence: float | None


@dataclass
class Chain:
    """What follows each other along a segment: nodes, and the pipes between them.

    Args:
        nodes: ids; an empty one is an end that the file leaves open.
        ports: of each node: where the pipe before it ends, and where the one behind it begins.
        pipes: one fewer than nodes.
    """

    nodes: list[str] = field(default_factory=list)
    ports: list[tuple[str | None, str | None]] = field(default_factory=list)
    pipes: list[Pipe] = field(default_factory=list)


def as_chain(rows: list[tuple[str, str | None] | Pipe], base: Pipe) -> Chain:
    """Nodes and pipes in turn; an end that the file leaves open is an empty name."""
    chain = Chain()
    for row in rows:
        if isinstance(row, Pipe):
            if len(chain.pipes) == len(chain.nodes):
                chain.nodes.append("")
                chain.ports.append((None, None))
            chain.pipes.append(row)
        else:
            if len(chain.nodes) > len(chain.pipes):
                chain.pipes.append(Pipe(None, base.size, base.direction, base.reason, None))
            chain.nodes.append(row[0])
            chain.ports.append((row[1], row[1]))
    if chain.pipes and len(chain.pipes) == len(chain.nodes):
        chain.nodes.append("")
        chain.ports.append((None, None))
    return chain


def with_sensors(
    chain: Chain, sensors: list[tuple[float, str]]
) -> tuple[list[str], list[tuple[str | None, str | None]], list[Pipe]]:
    """The chain with its instruments at their distances; each splits the pipe that it stands on."""
    nodes, ports, pipes = chain.nodes[:1], chain.ports[:1], []
    waiting = list(sensors)
    gone = 0.0
    carried: float | None = 0.0  # length that is drawn, up to no node
    if waiting and nodes[:1] == [""]:
        nodes[0] = waiting.pop(0)[1]
    for i, pipe in enumerate(chain.pipes):
        last = i == len(chain.pipes) - 1
        end, length = chain.nodes[i + 1], _together(carried, pipe.length)
        carried = 0.0
        while waiting and (last or (length is not None and waiting[0][0] < gone + length - 1e-9)):
            if last and len(waiting) == 1 and end == "":
                break
            distance, name = waiting.pop(0)
            part = None if length is None else min(max(distance - gone, 0.0), length)
            pipes.append(Pipe(part, pipe.size, pipe.direction, pipe.reason, pipe.confidence))
            nodes.append(name)
            ports.append((None, None))
            if length is not None and part is not None:
                length, gone = length - part, gone + part
        if end == "" and waiting and (length is None or waiting[0][0] <= gone + length + _SAME):
            end = waiting.pop(0)[1]
        if end == "":
            # Drawn in two strokes.
            carried = length
            continue
        gone += length or 0.0
        pipes.append(Pipe(length, pipe.size, pipe.direction, pipe.reason, pipe.confidence))
        nodes.append(end)
        ports.append(chain.ports[i + 1])
    return nodes, ports, pipes


def _together(one: float | None, other: float | None) -> float | None:
    return None if one is None or other is None else one + other


def join_through(
    rows: Iterable[tuple[str, str, str | None, str | None, Pipe]], through: Iterable[str]
) -> tuple[list[Connected], dict[str, int]]:
    """Makes connections, those on either side of a reducer, flange or the like one.

    Args:
        rows: source, target, their ports, and the pipe between them; what begins nowhere is left out.
        through: ids of the items that are no nodes.

    Returns:
        The connections; and those of the items at which other than two of them meet, with how many do.
    """
    edges = {number: _connected(*row) for number, row in enumerate(rows) if row[0] != ""}
    at: dict[str, set[int]] = {item: set() for item in through}
    for number, edge in edges.items():
        for end in {edge.source, edge.target} & at.keys():
            at[end].add(number)
    for item, numbers in at.items():
        if len(numbers) == 2:
            first, second = sorted(numbers)
            edges[first] = _merged(edges[first], edges.pop(second), item)
            for end in {edges[first].source, edges[first].target} & at.keys():
                at[end] = (at[end] - {second}) | {first}
    return list(edges.values()), {item: len(numbers) for item, numbers in at.items() if len(numbers) not in (0, 2)}


def _connected(source: str, target: str, source_port: str | None, target_port: str | None, pipe: Pipe) -> Connected:
    return Connected(
        source=source,
        target=target,
        length=pipe.length,
        size=pipe.size,
        diameter=pipe.size / 1000 if pipe.size else None,
        source_port=source_port,
        target_port=target_port,
        direction=pipe.direction,
        reason=pipe.reason if pipe.direction != "unknown" else None,
        confidence=pipe.confidence,
    )


def _merged(one: Connected, other: Connected, item: str) -> Connected:
    """Two connections that meet at an item as one, from the first of them onwards."""
    if one.source == item and other.target == item:
        one, other = other, one
    before = one if one.target == item else _turned(one)
    after = other if other.source == item else _turned(other)
    kept = [size for edge in (before, after) for size in (edge.sizes or (edge.size,)) if size is not None]
    longer = before if (before.length or 0.0) >= (after.length or 0.0) else after
    known = before if before.direction != "unknown" else after
    unknown = before.length is None and after.length is None
    return before.model_copy(
        update={
            "target": after.target,
            "target_port": after.target_port,
            "length": None if unknown else (before.length or 0.0) + (after.length or 0.0),
            "size": longer.size,
            "diameter": longer.diameter,
            "sizes": tuple(size for i, size in enumerate(kept) if i == 0 or size != kept[i - 1]),
            "direction": known.direction,
            "reason": known.reason,
        }
    )


def _turned(edge: Connected) -> Connected:
    return edge.model_copy(
        update={
            "source": edge.target,
            "target": edge.source,
            "source_port": edge.target_port,
            "target_port": edge.source_port,
            "sizes": edge.sizes[::-1],
            "direction": _TURNED[edge.direction],
        }
    )
