"""Triangles cut in pieces until none is long."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadgraph.geometry.kernels.parallel import compiled, readable
from cadgraph.model.scene import Floats

__all__ = ["cut_short"]

_MOST_TIMES, _MOST_PIECES = 12, 200_000  # that something is halved; from which on nothing is


def cut_short(corners: Floats, longest: float) -> tuple[Floats, Floats]:
    """Cuts triangles in halves across their longest side until that is short, and looks at the pieces.

    Args:
        corners: ``(n, 3, 3)`` of triangles [m].
        longest: side of a piece [m].

    Returns:
        The middles of the pieces ``(m, 3)`` [m], and their normals, as long as twice their area ``(m, 3)`` [m2].
    """
    left = readable(corners, np.float64)
    middles, vectors = [], []
    for times in range(_MOST_TIMES + 1):
        n = len(left)
        middle, vector, halves = np.empty((n, 3)), np.empty((n, 3)), np.empty((2 * n, 3, 3))
        enough = times == _MOST_TIMES or n >= _MOST_PIECES
        done, cut = _halve(left, np.inf if enough else longest, middle, vector, halves)
        middles.append(middle[:done])
        vectors.append(vector[:done])
        if not cut:
            break
        left = readable(halves[:cut], np.float64)
    return np.concatenate(middles), np.concatenate(vectors)


@compiled
def _halve(corners: Any, longest: float, middles: Any, vectors: Any, halves: Any) -> tuple[int, int]:
    """Writes down short triangles and halves long ones; returns how many of either there are."""
    done, cut = 0, 0
    for f in range(len(corners)):
        side, most = 0, -1.0
        for k in range(3):
            square = 0.0
            for i in range(3):
                square += (corners[f, k, i] - corners[f, (k + 1) % 3, i]) ** 2
            if square > most:
                side, most = k, square
        if np.sqrt(most) > longest:
            for i in range(3):
                a, b, c = corners[f, side, i], corners[f, (side + 1) % 3, i], corners[f, (side + 2) % 3, i]
                half = (a + b) / 2
                halves[cut, 0, i], halves[cut, 1, i], halves[cut, 2, i] = a, half, c
                halves[cut + 1, 0, i], halves[cut + 1, 1, i], halves[cut + 1, 2, i] = half, b, c
            cut += 2
            continue
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            middles[done, i] = (corners[f, 0, i] + corners[f, 1, i] + corners[f, 2, i]) / 3
            vectors[done, i] = (corners[f, 1, j] - corners[f, 0, j]) * (corners[f, 2, k] - corners[f, 0, k]) - (
                corners[f, 1, k] - corners[f, 0, k]
            ) * (corners[f, 2, j] - corners[f, 0, j])
        done += 1
    return done, cut
