"""A line as its pieces: what piping engineers exchange and draw."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.records import Point
from cadgraph.query.lines import Line

__all__ = ["Branch", "Component", "EndKind", "LineEnd", "PipedLine"]

EndKind = Literal["equipment", "pipeline", "open", "closed", "unknown"]


@dataclass(frozen=True)
class Branch:
    """Where something branches off a component.

    Args:
        point: end of the branch, where the next piece begins.
        size: nominal size of it (DN), or None.
        diameter: bore [m], or None.
        line: tag of the line that goes on there, or of the instrument; empty where nothing does.
        goes_on: whether it is a line.
    """

    point: Point
    size: int | None
    diameter: float | None
    line: str
    goes_on: bool = False


@dataclass(frozen=True)
class Component:
    """One piece of a line.

    Args:
        kind: ``pipe``, ``bend``, a name of the vocabulary (``elbow``, ``tee``...), ``valve``, ``instrument``,
            ``tap`` (a branch set on a pipe; it has no length), or ``other``.
        what: name or kind in words, or None.
        start: its end towards the start of the line.
        end: its other end.
        centre: where its axes meet, for what turns or branches.
        branches: what branches off, beside the line itself.
        sizes: nominal sizes (DN) at start and end, None where unknown.
        diameters: bores at start and end [m], None where unknown.
        length: along the centreline [m].
        angle: that it turns by [rad].
        parts: ids, the one that it is made from, or all of a unit.
        tag: of the unit, or None.
        flanged: whether flanges, gaskets or faces stand at its start and its end.
        split: whether it is one of several pieces of one part.
        offset: from the axis of its larger end to that of its smaller one [m], of an eccentric reducer; None of others.
    """

    kind: str
    what: str | None
    start: Point
    end: Point
    centre: Point | None = None
    branches: tuple[Branch, ...] = ()
    sizes: tuple[int | None, int | None] = (None, None)
    diameters: tuple[float | None, float | None] = (None, None)
    length: float = 0.0
    angle: float = 0.0
    parts: tuple[str, ...] = ()
    tag: str | None = None
    flanged: tuple[bool, bool] = (False, False)
    split: bool = False
    offset: Point | None = None


@dataclass(frozen=True)
class LineEnd:
    """How a line ends.

    Args:
        kind: what is there.
        point: where the last component ends.
        name: tag of the equipment, or of the line that goes on.
        port: its nozzle.
    """

    kind: EndKind
    point: Point
    name: str | None = None
    port: str | None = None


@dataclass(frozen=True)
class PipedLine:
    """A line with all that stands in it.

    Args:
        line: as in the line list.
        components: in order from its start.
        start: how it begins.
        end: how it ends.
        outlets: branch outlets that instruments sit on, each at its place.
        instruments: what sits on taps of it: tag, kind and place on the line.
        notes: what was missing or guessed.
    """

    line: Line
    components: tuple[Component, ...]
    start: LineEnd
    end: LineEnd
    outlets: tuple[Component, ...] = ()
    instruments: tuple[tuple[str, str | None, Point], ...] = ()
    notes: tuple[Diagnostic, ...] = ()
