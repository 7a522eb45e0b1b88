"""Pieces of pipe between units: what is joined without another unit in between, junctions and gauges contracted."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from typing import Literal

from cadgraph.query.network import Arc, Network

__all__ = ["Region", "find_regions"]


@dataclass(frozen=True)
class Region:
    """Connections that hang together without a dividing unit between them.

    Args:
        ends: ids of the dividing units that it is joined to.
        inside: ids of all other nodes in it: junctions, ends of pipes, gauges, and units that don't divide.
        flows: for each dividing unit at which it is known, whether the flow goes ``out`` of the unit into the region
            or from the region ``in``; a unit with both is left out.
    """

    ends: frozenset[str]
    inside: frozenset[str]
    flows: Mapping[str, Literal["in", "out"]]


def find_regions(network: Network, dividing: Collection[str]) -> list[Region]:
    """All regions of a network.

    Args:
        network: of a finished graph.
        dividing: ids of the units at which regions end.

    Returns:
        The regions in the order of their first connection.
    """
    found: list[Region] = []
    seen: set[int] = set()
    for place in network.places:
        for arc in network.arcs(place):
            if arc.index not in seen:
                found.append(_region(network, arc, dividing, seen))
    return found


def _region(network: Network, first: Arc, dividing: Collection[str], seen: set[int]) -> Region:
    """The region of one connection; its connections are added to those seen."""
    ends: set[str] = set()
    inside: set[str] = set()
    touching: list[Arc] = []  # leave a dividing unit
    waiting = [first, first.back]
    seen.add(first.index)
    while waiting:
        arc = waiting.pop()
        known = arc.start in ends or arc.start in inside
        if arc.start in dividing:
            ends.add(arc.start)
            touching.append(arc)
        else:
            inside.add(arc.start)
        # Past a valve that sits on the side of a run the run goes on.
        passed = arc.start not in dividing or (network.is_valve(arc.start) and network.stands_aside(arc.start))
        if passed and not known:
            onward = [other for other in network.arcs(arc.start) if other.index not in seen]
            seen.update(other.index for other in onward)
            waiting += [turned for other in onward for turned in (other, other.back)]
    return Region(frozenset(ends), frozenset(inside), _flows(touching))


def _flows(touching: Iterable[Arc]) -> dict[str, Literal["in", "out"]]:
    said: dict[str, set[str]] = {}
    for arc in touching:
        if arc.flow != "unknown":
            said.setdefault(arc.start, set()).add(arc.flow)
    return {unit: "out" if flows == {"along"} else "in" for unit, flows in sorted(said.items()) if len(flows) == 1}
