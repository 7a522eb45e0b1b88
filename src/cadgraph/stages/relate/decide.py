"""One decision for all joints: each end gets one partner, so that the evidence adds up to the most."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import networkx

from cadgraph.geometry.components import connected_sets
from cadgraph.stages.relate.evidence import OPEN_END
from cadgraph.stages.relate.offer import Offer

__all__ = ["Decision", "decide_joints", "settle_faces"]

# Two ends that touch, and of which each is the other's best by so much in log-odds, need no weighing.
_SURE, _LEAD, _TOUCHING = 3.0, 0.5, 0.001
_SCALE = 1_000_000  # weights are whole numbers, so that no rounding decides


@dataclass(frozen=True)
class Decision:
    """The joints that are made.

    Args:
        joined: made joints, by end; one between two ends is there twice.
        refused: of each end without a joint the best offer that was not taken.
    """

    joined: Mapping[int, Offer]
    refused: Mapping[int, Offer]


def settle_faces(faces: Sequence[Offer]) -> dict[int, Offer]:
    """The joints between ends that touch and that nothing else comes near, by end."""
    best = _best_first(faces)
    settled = {}
    for offer in faces:
        if offer.kind != "face" or abs(offer.gap) > _TOUCHING or offer.odds < _SURE:
            continue
        if all(_leads(offer, best[row]) for row in (offer.row, offer.other)):
            settled[offer.row] = settled[offer.other] = offer
    return settled


def _best_first(faces: Sequence[Offer]) -> dict[int, list[Offer]]:
    """The offers of each end, the likeliest first."""
    found: dict[int, list[Offer]] = {}
    for offer in faces:
        for row in (offer.row, offer.other):
            found.setdefault(row, []).append(offer)
    for offers in found.values():
        if len(offers) > 1:
            offers.sort(key=lambda offer: (-offer.odds, offer.row, offer.other))
    return found


def _leads(offer: Offer, offers: Sequence[Offer]) -> bool:
    return offers[0] is offer and (len(offers) == 1 or offers[1].odds <= offer.odds - _LEAD)


def decide_joints(
    faces: Sequence[Offer], singles: Mapping[int, Sequence[Offer]], settled: Mapping[int, Offer]
) -> Decision:
    """Chooses joints so that each end has at most one, and the sum of what speaks for them is greatest.

    An end that joins nothing costs ``OPEN_END``. It is a maximum-weight matching of ends, in which each end also has
    itself as a partner for the best joint that needs no other end.

    Args:
        faces: offers between two ends.
        singles: for each end its offers at solids and on the sides of lines.
        settled: joints that are made already.
    """
    open_faces = [
        offer for offer in faces if offer.row not in settled and offer.other not in settled and offer.odds > 0
    ]
    best = {row: _best(offers) for row, offers in singles.items() if row not in settled}
    single = {row: offer for row, offer in best.items() if offer is not None}
    joined = {**settled, **_decided(open_faces, single)}
    return Decision(joined, _refused(faces, singles, joined))


def _decided(faces: Sequence[Offer], single: Mapping[int, Offer]) -> dict[int, Offer]:
    """The joints of ends that are still open, each group that offers hang together decided by itself.

    Args:
        faces: offers between two ends.
        single: for each end the best of its others.
    """
    rows = sorted({row for offer in faces for row in (offer.row, offer.other)} | set(single))
    of_row: dict[int, list[Offer]] = {}
    for offer in faces:
        of_row.setdefault(offer.row, []).append(offer)
    joined: dict[int, Offer] = {}
    for group in connected_sets(rows, [(offer.row, offer.other) for offer in faces]):
        joined |= _match(group, [offer for row in group for offer in of_row.get(row, ())], single)
    return joined


def _best(offers: Sequence[Offer]) -> Offer | None:
    return min(
        (offer for offer in offers if offer.odds > 0),
        key=lambda offer: (-round(offer.odds, 6), offer.kind, round(offer.gap, 6), offer.other),
        default=None,
    )


def _match(group: Sequence[int], faces: Sequence[Offer], single: Mapping[int, Offer]) -> dict[int, Offer]:
    if not faces:
        return {row: single[row] for row in group if row in single}
    by_pair: dict[tuple[int, int], Offer] = {}
    for offer in sorted(faces, key=lambda offer: (-offer.odds, offer.row, offer.other)):
        by_pair.setdefault((offer.row, offer.other), offer)
    if len(by_pair) == 1 and single.keys().isdisjoint(group):
        # Two ends that nothing else is offered to.
        (offer,) = by_pair.values()
        return dict.fromkeys(group, offer)
    made: dict[int, Offer] = {}
    for (kind, a), (other_kind, b) in networkx.max_weight_matching(_graph_of(group, by_pair, single)):
        if kind == other_kind == "end":
            offer = by_pair[(a, b) if (a, b) in by_pair else (b, a)]
            made[a] = made[b] = offer
        else:
            made[a] = single[a]
    return made


def _graph_of(
    group: Sequence[int], by_pair: Mapping[tuple[int, int], Offer], single: Mapping[int, Offer]
) -> networkx.Graph[tuple[str, int]]:
    """What can be matched: pairs of ends, and each end with itself for its best other offer."""
    graph: networkx.Graph[tuple[str, int]] = networkx.Graph()
    for (row, other), offer in by_pair.items():
        graph.add_edge(("end", row), ("end", other), weight=round(_SCALE * (offer.odds + 2 * OPEN_END)))
    for row in group:
        if row in single:
            graph.add_edge(("end", row), ("self", row), weight=round(_SCALE * (single[row].odds + OPEN_END)))
    return graph


def _refused(
    faces: Sequence[Offer], singles: Mapping[int, Sequence[Offer]], joined: Mapping[int, Offer]
) -> dict[int, Offer]:
    """The best offer of each end that joins nothing."""
    offers: dict[int, list[Offer]] = {row: list(found) for row, found in singles.items() if row not in joined}
    for offer in faces:
        for row in (offer.row, offer.other):
            if row not in joined:
                offers.setdefault(row, []).append(offer)
    return {
        row: min(found, key=lambda offer: (-round(offer.odds, 6), offer.kind, offer.row, offer.other))
        for row, found in sorted(offers.items())
        if found
    }
