"""The network as it is put together: nodes by number, and the pieces of line between them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from cadgraph.model.scene import Floats

__all__ = ["Net", "Span", "join_spans", "length_of"]

_SAME_PLACE = 1e-6  # points nearer to each other are one [m]


class Span(NamedTuple):
    """A piece of line between two nodes; large scenes have millions, so it is made as cheaply as can be.

    Args:
        a: node that it begins at.
        b: node that it ends at.
        via: parts in order.
        points: ``(n, 3)`` from ``a`` to ``b`` [m].
        length: along the centreline [m]; where parts lie in each other, that stretch counts once.
        pieces: of its pipes, in order: length, outer diameter, bore diameter (NaN where unknown) [m].
        confidence: 0..1.
        port_a: number of the unit's port that it begins at, -1 for none.
        port_b: likewise at its end.
    """

    a: int
    b: int
    via: tuple[int, ...]
    points: Floats
    length: float
    pieces: tuple[tuple[float, float, float], ...] = ()
    confidence: float = 1.0
    port_a: int = -1
    port_b: int = -1

    def reversed(self) -> Span:
        """The same from its end."""
        return Span(
            self.b, self.a, self.via[::-1], self.points[::-1], self.length, self.pieces[::-1], self.confidence,
            self.port_b, self.port_a,
        )  # fmt: skip


def length_of(step: Floats) -> float:
    """Length of a vector ``(3,)``, as ``np.linalg.norm`` has it to the bit, several times as fast."""
    return math.sqrt(step.dot(step))


def join_spans(first: Span, second: Span) -> Span:
    """Two spans one after the other; the first ends where the second begins."""
    p, q = first.points[-1], second.points[0]
    step = q - p
    gap = length_of(step)
    if gap > 0:
        heading = _heading(first.points) if len(first.points) > 1 else _heading(second.points)
        # What lies in each other counts once, what is bridged counts too.
        gap = gap if heading is None or float(step @ heading) >= 0 else -gap
    points = np.concatenate([first.points, second.points[1:] if gap == 0 else second.points])
    return Span(
        a=first.a,
        b=second.b,
        via=first.via + _without(second.via, first.via[-1:]),
        points=points,
        length=max(0.0, first.length + second.length + gap),
        pieces=first.pieces + second.pieces,
        confidence=min(first.confidence, second.confidence),
        port_a=first.port_a,
        port_b=second.port_b,
    )


def _without(parts: tuple[int, ...], others: tuple[int, ...]) -> tuple[int, ...]:
    return tuple(part for part in parts if part not in others) if any(one in parts for one in others) else parts


def _heading(points: Floats) -> Floats | None:
    """Where a span heads at its end; None where all of it is in one place."""
    for k in range(len(points) - 2, -1, -1):
        step: Floats = points[-1] - points[k]
        length = length_of(step)
        # Between points that only rounding keeps apart any direction would come out.
        if length > _SAME_PLACE:
            return step / length
    return None


@dataclass
class Net:
    """Spans between nodes, as a network that can be changed.

    Args:
        spans: by number.
        at: the spans of each node; a span that begins and ends there is listed twice.
    """

    spans: dict[int, Span] = field(default_factory=dict)
    at: dict[int, list[int]] = field(default_factory=dict)
    _next: int = 0

    def copy(self) -> Net:
        """The same network, to be changed apart from this one."""
        return Net(dict(self.spans), {node: list(numbers) for node, numbers in self.at.items()}, self._next)

    def add(self, span: Span) -> int:
        """Adds a span and returns its number."""
        number = self._next
        self._next += 1
        self.spans[number] = span
        self.at.setdefault(span.a, []).append(number)
        self.at.setdefault(span.b, []).append(number)
        return number

    def remove(self, number: int) -> Span:
        """Takes a span out; its nodes stay."""
        span = self.spans.pop(number)
        self.at[span.a].remove(number)
        self.at[span.b].remove(number)
        return span

    def degree(self, node: int) -> int:
        """How many ends of spans meet at a node."""
        return len(self.at.get(node, ()))

    def leaving(self, node: int) -> Iterator[tuple[int, Span]]:
        """The spans at a node, each as it leaves from there; one that returns is given both ways."""
        seen: set[int] = set()
        for number in list(self.at.get(node, ())):
            span = self.spans[number]
            if span.a == span.b:
                yield number, (span.reversed() if number in seen else span)
                seen.add(number)
            else:
                yield number, (span if span.a == node else span.reversed())

    def move(self, number: int, old: int, new: int) -> None:
        """Lets the end of a span that is at one node be at another."""
        span = self.remove(number)
        moved = span._replace(a=new) if span.a == old else span._replace(b=new)
        self.spans[number] = moved
        self.at.setdefault(moved.a, []).append(number)
        self.at.setdefault(moved.b, []).append(number)

    def dissolve(self, keep: Sequence[int]) -> None:
        """Joins the two spans at each node of degree two, the nodes to keep apart."""
        kept = set(keep)
        for node in sorted(self.at):
            if node in kept or self.degree(node) != 2:
                continue
            first, second = self.at[node]
            if first == second:
                continue
            before, after = self.remove(first), self.remove(second)
            before = before if before.b == node else before.reversed()
            after = after if after.a == node else after.reversed()
            self.add(join_spans(before, after))
