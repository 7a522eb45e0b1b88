"""Directions of flow as a user set them: which connection each is about, and what gives way to it."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.model.parts import Link, Network
from cadgraph.model.scene import Floats
from cadgraph.stages.relate.edits import FlowEdit, NetworkEdits, Unmet
from cadgraph.stages.relate.flow_spread import Evidence, Flows, spread

__all__ = ["SetFlow", "set_flow", "unmet_flow", "yield_to"]

_PLACE = 0.05  # ends of a connection this near to where they were are the same [m]
_MOST = 0.5  # share of the parts between that tells a connection that was changed at its ends
_MOST_ROUNDS = 20  # in which what contradicts a user is left out


@dataclass(frozen=True)
class SetFlow:
    """Directions that a user set.

    Args:
        evidence: of each link that was found again.
        wanted: the number of the edit for each of these links.
        unmet: edits that don't fit.
    """

    evidence: tuple[Evidence, ...] = ()
    wanted: tuple[tuple[int, Evidence], ...] = ()
    unmet: tuple[Unmet, ...] = ()


def set_flow(network: Network, edits: NetworkEdits) -> SetFlow:
    """Finds the links that a user's directions are about; of several about one link the last one counts.

    Args:
        network: units and links.
        edits: of a user.
    """
    held: dict[int, tuple[int, Evidence]] = {}
    unmet: list[Unmet] = []
    for edit in edits.flows:
        found = _find(network, edit)
        if found is None:
            unmet.append((edit.number, "no connection runs there any more"))
            continue
        link, forward = found
        if edit.flow == "unknown":
            if held.pop(link, None) is None:
                unmet.append((edit.number, "no direction was set there; take that back which it follows from"))
            continue
        onward = forward == (edit.flow == "forward")
        ends = [_name(network, node) for node in (network.links[link].source, network.links[link].target)]
        reason = f"set by a user: {' -> '.join(ends if onward else ends[::-1])}"
        held.pop(link, None)
        held[link] = edit.number, Evidence(link, onward, 1.0, reason)
    wanted = tuple(held.values())
    return SetFlow(tuple(one for _, one in wanted), wanted, tuple(unmet))


def _name(network: Network, node: int) -> str:
    if node < len(network.units):
        return network.units[node].tag
    return f"{network.places[node - len(network.units)].kind} {node - len(network.units)}"


def _find(network: Network, edit: FlowEdit) -> tuple[int, bool] | None:
    """The link that an edit is about, and whether it leads from the edit's source to its target."""
    best: tuple[tuple[float, ...], int, bool] | None = None
    for number, link in enumerate(network.links):
        likeness = _likeness(network, link, edit)
        if likeness is not None and (best is None or likeness[0] > best[0]):
            best = likeness[0], number, likeness[1]
    return None if best is None else best[1:]


def _likeness(network: Network, link: Link, edit: FlowEdit) -> tuple[tuple[float, ...], bool] | None:
    """How much a link is the one that an edit is about, and its sense; None where it is another one."""
    shared = len(set(link.via).intersection(edit.via))
    if edit.via and not shared:
        return None
    nodes = [_parts(network, node) for node in (link.source, link.target)]
    onward = sum(not own.isdisjoint(said) for own, said in zip(nodes, (edit.source, edit.target), strict=True))
    back = sum(not own.isdisjoint(said) for own, said in zip(nodes[::-1], (edit.source, edit.target), strict=True))
    far, far_back = _apart(link, edit.ends), _apart(link, edit.ends[::-1])
    here = min(far, far_back) <= 2 * _PLACE
    if not (here or max(onward, back) == 2 or (shared > 1 and shared >= _MOST * len(edit.via))):
        return None
    share = shared / max(len({*link.via, *edit.via}), 1)
    rank = (float(here), share, float(max(onward, back)), -min(far, far_back))
    return rank, _sense(link, edit, onward - back, far_back - far)


def _sense(link: Link, edit: FlowEdit, by_ends: int, by_place: float) -> bool:
    """Whether a link leads the way that an edit does: by the order of its parts, else its ends, else its place."""
    place = {part: k for k, part in enumerate(edit.via)}
    order = [place[part] for part in link.via if part in place]
    if len(order) > 1 and order[0] != order[-1]:
        return order[0] < order[-1]
    return by_ends > 0 if by_ends else by_place >= 0


def _parts(network: Network, node: int) -> set[int]:
    units = network.units
    return set(units[node].parts if node < len(units) else network.places[node - len(units)].parts)


def _apart(link: Link, ends: Floats) -> float:
    """How far the ends of a link are from two places, together [m]."""
    if not link.path:
        return float("inf")
    return float(np.linalg.norm(np.asarray([link.path[0], link.path[-1]]) - ends, axis=1).sum())


def yield_to(
    network: Network, said: Sequence[Evidence], others: Sequence[Evidence]
) -> tuple[frozenset[str], list[tuple[Evidence, Evidence]]]:
    """What gives way to a user's directions, as it contradicts them or what follows from them.

    Args:
        network: units and links.
        said: by a user.
        others: what geometry, the file and the settings say.

    Returns:
        The reasons that don't count, and the contradictions.
    """
    own = {one.reason for one in said}
    out: set[str] = set()
    doubts: list[tuple[Evidence, Evidence]] = []
    for _ in range(_MOST_ROUNDS if said else 0):
        left = [one for one in others if one.reason not in out]
        against = _against(spread(network, [*said, *left]), own)
        if not against:
            break
        doubts += against
        out.update(other.reason for _, other in against)
    return frozenset(out), doubts


def _against(flows: Flows, own: Collection[str]) -> list[tuple[Evidence, Evidence]]:
    """The contradictions of a user's reasons, which go first, with others."""
    mixed = [pair for pair in flows.against if (pair[0].reason in own) != (pair[1].reason in own)]
    return [(a, b) if a.reason in own else (b, a) for a, b in mixed]


def unmet_flow(network: Network, flow: SetFlow) -> list[Unmet]:
    """The directions that a user set and that did not hold, as others of theirs say the opposite."""
    return [
        (number, "another direction that was set contradicts it")
        for number, one in flow.wanted
        if network.links[one.link].direction != ("forward" if one.forward else "backward")
    ]
