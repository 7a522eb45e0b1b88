"""The order of stops that makes a round short."""

from __future__ import annotations

import random
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import numpy.typing as npt

__all__ = ["EXACT", "length_of", "shortest_order"]

EXACT = 12
"""Up to so many stops the shortest order of all is found (Held and Karp 1962), above it nearly."""

_SHUFFLES = 1200  # divided by the number of stops: how often a part of a good order is shuffled and mended again
_MOST_SHUFFLED = 8  # stops of such a part
_LEAST_GAIN = 1e-9  # m; what is no more than rounding is no gain

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]


def shortest_order(distances: Sequence[Sequence[float]], stages: Sequence[int]) -> list[int]:
    """The order in which stops are visited from the start and back to it.

    Exact for up to :data:`EXACT` stops. Above, each stop is inserted where it lengthens the round least, then the order
    is mended by turning pieces round (2-opt) and moving them (Or-opt) until nothing shortens it, several times over.

    Args:
        distances: between the start, which is number 0, and the stops, whose numbers are 1, 2...; symmetric [m].
        stages: of each stop, the start left out; those of a lower stage are visited before those of a higher one.

    Returns:
        The numbers of the stops; of orders of the same length always the same one.
    """
    n = len(stages)
    if n <= 1:
        return list(range(1, n + 1))
    order = _exact(distances, stages) if n <= EXACT else _mended(distances, stages)
    # As long the other way round, where no stages forbid that: rather what was asked first.
    return order[::-1] if len(set(stages)) == 1 and order[-1] < order[0] else order


def length_of(distances: Sequence[Sequence[float]] | Floats, order: Sequence[int] | Ints) -> float:
    """The length of a round in this order, the start before and after it included [m]."""
    stops = [0, *map(int, order), 0]
    return float(sum(distances[a][b] for a, b in pairwise(stops)))


def _exact(distances: Sequence[Sequence[float]], stages: Sequence[int]) -> list[int]:
    """Dynamic programming over sets of stops that were visited and the last of them."""
    n = len(stages)
    # What must have been visited before a stop, as bits.
    before = [sum(1 << k for k in range(n) if stages[k] < stages[i]) for i in range(n)]
    best: dict[tuple[int, int], tuple[float, int]] = {
        (1 << i, i): (distances[0][i + 1], -1) for i in range(n) if before[i] == 0
    }
    layer = list(best)
    for _ in range(n - 1):
        following: dict[tuple[int, int], tuple[float, int]] = {}
        for visited, last in layer:
            so_far = best[visited, last][0]
            for i in range(n):
                if visited >> i & 1 or before[i] & ~visited:
                    continue
                state, length = (visited | 1 << i, i), so_far + distances[last + 1][i + 1]
                known = following.get(state)
                if known is None or (length, last) < known:
                    following[state] = length, last
        best |= following
        layer = list(following)
    _, last = min((best[state][0] + distances[state[1] + 1][0], state[1]) for state in layer)
    order: list[int] = []
    visited = (1 << n) - 1
    while last >= 0:
        order.append(last + 1)
        previous = best[visited, last][1]
        visited, last = visited & ~(1 << last), previous
    return order[::-1]


def _mended(distances: Sequence[Sequence[float]], stages: Sequence[int]) -> list[int]:
    table = np.array(distances, np.float64)
    blocks = _blocks(_inserted(distances, stages), stages)
    best = np.array(_inserted(distances, stages), np.int64)
    _improve(table, best, blocks)
    length = length_of(table, best)
    chance = random.Random(0)  # the same round each time
    for _ in range(_SHUFFLES // len(stages)):
        order = best.copy()
        _shuffle(chance, order, blocks)
        _improve(table, order, blocks)
        found = length_of(table, order)
        if found < length - _LEAST_GAIN:
            best, length = order, found
    return [int(stop) for stop in best]


def _inserted(distances: Sequence[Sequence[float]], stages: Sequence[int]) -> list[int]:
    """Stage by stage, the stop nearest to the round so far where it lengthens it least."""
    order: list[int] = []
    for stage in sorted(set(stages)):
        waiting = {i + 1 for i, own in enumerate(stages) if own == stage}
        low = len(order)
        near = {i: min(distances[i][k] for k in (0, *order)) for i in waiting}
        while waiting:
            stop = min(waiting, key=lambda i: (near[i], i))
            waiting.remove(stop)
            row = distances[stop]

            def longer(at: int, row: Sequence[float] = row) -> float:
                a, b = (order[at - 1] if at else 0), (order[at] if at < len(order) else 0)
                return row[a] + row[b] - distances[a][b]

            order.insert(min(range(low, len(order) + 1), key=longer), stop)
            near = {i: min(near[i], row[i]) for i in waiting}
    return order


def _blocks(order: Sequence[int], stages: Sequence[int]) -> list[tuple[int, int]]:
    """Where each stage begins and ends in an order."""
    cuts = [k for k in range(1, len(order)) if stages[order[k] - 1] != stages[order[k - 1] - 1]]
    return list(zip((0, *cuts), (*cuts, len(order)), strict=True))


def _shuffle(chance: random.Random, order: Ints, blocks: Sequence[tuple[int, int]]) -> None:
    """Shuffles some neighbouring stops in each of some stages, and lets two pieces of it change places."""
    for low, high in blocks:
        size = min(_MOST_SHUFFLED, high - low)
        if size < 2 or (len(blocks) > 1 and chance.random() < 0.5):
            continue
        if high - low > _MOST_SHUFFLED and chance.random() < 0.5:
            # Neither turning nor moving short pieces can do this in one go (Martin, Otto and Felten 1991).
            a, b, c = sorted(chance.sample(range(low, high + 1), 3))
            order[a:c] = np.concatenate([order[b:c], order[a:b]])
            continue
        first = chance.randint(low, high - size)
        piece = [int(stop) for stop in order[first : first + size]]
        chance.shuffle(piece)
        order[first : first + size] = piece


def _improve(table: Floats, order: Ints, blocks: Sequence[tuple[int, int]]) -> None:
    """Turns and moves pieces within their stages until nothing shortens the round."""
    before, length = np.inf, length_of(table, order)
    while length < before - _LEAST_GAIN:
        for low, high in blocks:
            _turn(table, order, low, high)
            for size in (1, 2, 3):
                _move(table, order, low, high, size)
        before, length = length, length_of(table, order)


def _turn(table: Floats, order: Ints, low: int, high: int) -> None:
    """2-opt: turns round each piece that is shorter so."""
    for i in range(low, high - 1):
        before, first = (order[i - 1] if i else 0), order[i]
        lasts = order[i + 1 : high]
        afters = np.append(order[i + 2 : high + 1], 0)[: len(lasts)]
        gains = table[before, first] + table[lasts, afters] - table[before, lasts] - table[first, afters]
        best = int(np.argmax(gains))
        if gains[best] > _LEAST_GAIN:
            order[i : i + best + 2] = order[i : i + best + 2][::-1].copy()


def _move(table: Floats, order: Ints, low: int, high: int, size: int) -> None:
    """Or-opt: moves each piece of some stops to where it lengthens the round least, either way round."""
    for i in range(low, high - size + 1):
        piece = order[i : i + size].copy()
        ends = np.concatenate([[0], order[:i], order[i + size :], [0]])  # what is left of the order is ends[1:-1]
        saved = table[ends[i], piece[0]] + table[piece[-1], ends[i + 1]] - table[ends[i], ends[i + 1]]
        a, b = ends[low : high - size + 1], ends[low + 1 : high - size + 2]
        added = np.stack([table[a, piece[0]] + table[piece[-1], b], table[a, piece[-1]] + table[piece[0], b]])
        added -= table[a, b]
        turned, where = divmod(int(np.argmin(added)), len(a))
        if added[turned, where] < saved - _LEAST_GAIN:
            at = low + where + 1
            order[:] = np.concatenate([ends[1:at], piece[::-1] if turned else piece, ends[at:-1]])
