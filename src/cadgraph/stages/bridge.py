"""Weak bridges: single contacts over a gap that alone hold two structures together.

The paper reports one as a clustering error: a platform and a pair of tanks, joined by one unexpected edge.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.config import ClusterConfig
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.parts import Bools, Contacts, Parts

__all__ = ["Bridge", "cut_bridges", "find_weak_bridges", "report_bridges"]


@dataclass(frozen=True)
class Bridge:
    """One contact whose removal separates two structures.

    Args:
        contact: index of the contact.
        sizes: number of parts that hang together on the side of its first and of its second part.
    """

    contact: int
    sizes: tuple[int, int]


def find_weak_bridges(n_parts: int, contacts: Contacts, ground: Bools, config: ClusterConfig) -> tuple[Bridge, ...]:
    """The contacts that alone join two substantial structures, over a gap.

    Joints of a pipe are single contacts too, but without a gap; so a bridge is weak from ``config.bridge_gap`` on.

    Args:
        n_parts: number of parts.
        contacts: pairs of parts within eps.
        ground: ``(n_parts,)`` parts that join nothing.
        config: settings: least gap, and least number of parts on either side.

    Returns:
        The weak bridges in the order of their contacts.
    """
    inside = np.flatnonzero(~ground[contacts.pairs].any(axis=1))
    links: list[list[tuple[int, int]]] = [[] for _ in range(n_parts)]
    for contact, (a, b) in zip(inside.tolist(), contacts.pairs[inside].tolist(), strict=True):
        links[a].append((b, contact))
        links[b].append((a, contact))
    seen = np.zeros(n_parts, np.bool_)
    found = []
    for root in range(n_parts):
        if seen[root]:
            continue
        visited, bridge_above, size = _bridges_from(root, links)
        seen[visited] = True
        for part, contact in bridge_above.items():
            inner, outer = size[part], len(visited) - size[part]
            if contacts.distance[contact] >= config.bridge_gap and min(inner, outer) >= config.bridge_parts:
                first = int(contacts.pairs[contact, 0]) == part
                found.append(Bridge(contact, (inner, outer) if first else (outer, inner)))
    return tuple(sorted(found, key=lambda bridge: bridge.contact))


def _bridges_from(
    root: int, links: Sequence[Sequence[tuple[int, int]]]
) -> tuple[list[int], dict[int, int], dict[int, int]]:
    """Tarjan's search for bridges from one part.

    Returns:
        The parts reached; the bridges, as the contact above the part on their far side; and how many parts hang
        below each part in the search tree, itself included.
    """
    rank, low, above, size = {root: 0}, {root: 0}, {root: -1}, {root: 1}
    visited, stack = [root], [(root, iter(links[root]))]
    bridges: dict[int, int] = {}
    while stack:
        here, rest = stack[-1]
        for there, contact in rest:
            if there not in rank:
                rank[there] = low[there] = len(visited)
                above[there], size[there] = contact, 1
                visited.append(there)
                stack.append((there, iter(links[there])))
                break
            if contact != above[here]:
                low[here] = min(low[here], rank[there])
        else:
            stack.pop()
            if stack:
                parent = stack[-1][0]
                low[parent] = min(low[parent], low[here])
                size[parent] += size[here]
                if low[here] > rank[parent]:
                    bridges[here] = above[here]
    return visited, bridges, size


def cut_bridges(contacts: Contacts, bridges: Sequence[Bridge]) -> Contacts:
    """The contacts without these bridges."""
    keep = np.ones(len(contacts.pairs), np.bool_)
    keep[[bridge.contact for bridge in bridges]] = False
    return Contacts(contacts.pairs[keep], contacts.distance[keep], contacts.points[keep])


def report_bridges(bridges: Sequence[Bridge], contacts: Contacts, parts: Parts, cut: bool) -> tuple[Diagnostic, ...]:
    """One diagnostic for each bridge: the gap, the number of parts on either side, and the two parts."""
    diagnostics = []
    for bridge in bridges:
        heads = tuple(parts.scene.paths[part] for part in contacts.pairs[bridge.contact])
        gap = 1000 * contacts.distance[bridge.contact]
        message = (
            f"a single contact over a gap of {gap:.1f} mm {'joined' if cut else 'joins'} "
            f"{bridge.sizes[0]} parts and {bridge.sizes[1]} parts{', and was cut' if cut else ''}"
        )
        diagnostics.append(Diagnostic("weak-bridge", message, heads))
    return tuple(diagnostics)
