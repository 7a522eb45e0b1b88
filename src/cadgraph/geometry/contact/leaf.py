"""Two leaves of box trees compared: the closest points of their triangles."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.contact.side import rows_gap2
from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.geometry.kernels.triangle import distance2, lay_normal
from cadgraph.model.scene import Floats

__all__ = ["compare_leaves", "keep_closer"]

# Once a pair of points is found, others must be closer by this [m] to be of interest: faces that run parallel would
# otherwise be searched for the last bit.
_TIE = 1e-10


@compiled
def _apart(p: Floats, n_p: int, q: Floats, n_q: int, best: float) -> bool:
    """Whether the normal of the first triangle of ``p`` shows two leaves to be ``best`` (squared) or more apart."""
    n2 = lay_normal(p, 0)
    x, y, z = p[0, 9], p[0, 10], p[0, 11]
    p_low = q_low = np.inf
    p_high = q_high = -np.inf
    for i in range(n_p):
        for k in range(0, 9, 3):
            at = x * p[i, k] + y * p[i, k + 1] + z * p[i, k + 2]
            p_low, p_high = min(p_low, at), max(p_high, at)
    for i in range(n_q):
        for k in range(0, 9, 3):
            at = x * q[i, k] + y * q[i, k + 1] + z * q[i, k + 2]
            q_low, q_high = min(q_low, at), max(q_high, at)
    gap = max(q_low - p_high, p_low - q_high)
    return gap > 0.0 and gap * gap >= best * n2 and n2 > 0.0


@compiled
def keep_closer(d2: float, stop: float, found: Floats, spare: Floats) -> float:
    """Notes a closer pair of points; returns the bound for the next, or 0 where this one is close enough."""
    for k in range(6):
        found[k] = spare[k]
    found[6] = d2
    if d2 <= stop:
        return 0.0
    size = np.sqrt(d2)
    for k in range(3):
        found[7 + k] = (spare[3 + k] - spare[k]) / size
    less = size - _TIE
    return less * less if less > 0.0 else 0.0


@compiled
def _behind(p: Floats, n_p: int, q: Floats, n_q: int, bound: float, found: Floats) -> bool:
    """Whether two leaves lie ``bound`` (squared) or more apart along the line of the closest points so far.

    Parts that bulge towards each other are told apart by this at once. Leaves the furthest point of each row of ``p``,
    and the nearest of each row of ``q``, along that line in the free column.
    """
    x, y, z = found[7], found[8], found[9]
    high, low = -np.inf, np.inf
    for i in range(n_p):
        a = x * p[i, 0] + y * p[i, 1] + z * p[i, 2]
        b = x * p[i, 3] + y * p[i, 4] + z * p[i, 5]
        c = x * p[i, 6] + y * p[i, 7] + z * p[i, 8]
        p[i, 19] = max(a, b, c)
        high = max(high, p[i, 19])
    for i in range(n_q):
        a = x * q[i, 0] + y * q[i, 1] + z * q[i, 2]
        b = x * q[i, 3] + y * q[i, 4] + z * q[i, 5]
        c = x * q[i, 6] + y * q[i, 7] + z * q[i, 8]
        q[i, 19] = min(a, b, c)
        low = min(low, q[i, 19])
    return low > high and (low - high) * (low - high) >= bound


@compiled
def compare_leaves(
    p: Floats, n_p: int, q: Floats, n_q: int, bound: float, stop: float, found: Floats, spare: Floats
) -> float:
    """Looks for triangles of two leaves below a squared distance; returns the new bound."""
    known = found[6] < np.inf
    if known and _behind(p, n_p, q, n_q, bound, found):
        return bound
    if _apart(p, n_p, q, n_q, bound) or _apart(q, n_q, p, n_p, bound):
        return bound
    x0 = y0 = z0 = np.inf
    x1 = y1 = z1 = -np.inf
    for j in range(n_q):
        x0, y0, z0 = min(x0, q[j, 13]), min(y0, q[j, 14]), min(z0, q[j, 15])
        x1, y1, z1 = max(x1, q[j, 16]), max(y1, q[j, 17]), max(z1, q[j, 18])
    for i in range(n_p):
        x, y, z = (
            max(p[i, 13] - x1, x0 - p[i, 16]),
            max(p[i, 14] - y1, y0 - p[i, 17]),
            max(p[i, 15] - z1, z0 - p[i, 18]),
        )
        x, y, z = max(x, 0.0), max(y, 0.0), max(z, 0.0)
        if x * x + y * y + z * z >= bound:
            continue
        for j in range(n_q):
            if rows_gap2(p, i, q, j) >= bound:
                continue
            if known:
                gap = q[j, 19] - p[i, 19]
                if gap > 0.0 and gap * gap >= bound:
                    continue
            d2 = distance2(p, i, q, j, bound, spare)
            if d2 < bound:
                bound = keep_closer(d2, stop, found, spare)
                if bound <= 0.0:
                    return bound
    return bound
