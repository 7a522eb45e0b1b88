"""What hangs together: connected components of pairs."""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from typing import TypeVar

import numpy as np
import numpy.typing as npt
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from cadgraph.model.scene import Ints

__all__ = ["connected_sets", "first_of_component"]

_Member = TypeVar("_Member", bound=Hashable)


def first_of_component(n: int, pairs: npt.ArrayLike) -> Ints:
    """The lowest number that each of ``n`` numbers is connected with, directly or through others.

    Args:
        n: how many there are.
        pairs: ``(n_pairs, 2)`` numbers 0 to ``n - 1`` that are connected, in any order.

    Returns:
        ``(n,)``; what is connected with nothing has its own number.
    """
    ends = np.asarray(pairs, np.int64).reshape(-1, 2)
    links = coo_array((np.ones(len(ends)), (ends[:, 0], ends[:, 1])), shape=(n, n))
    component = connected_components(links, directed=False)[1]
    _, first, of_member = np.unique(component, return_index=True, return_inverse=True)
    lowest: Ints = first[of_member].astype(np.int64)
    return lowest


def connected_sets(members: Iterable[_Member], pairs: Iterable[tuple[_Member, _Member]]) -> list[tuple[_Member, ...]]:
    """The sets of members that hang together, by their first members; each in the order of ``members``.

    Args:
        members: what there is.
        pairs: what is connected; a pair with something that is no member counts for nothing.
    """
    number = {member: k for k, member in enumerate(dict.fromkeys(members))}
    ends = [(number[a], number[b]) for a, b in pairs if a in number and b in number]
    sets: dict[int, list[_Member]] = {}
    for member, first in zip(number, first_of_component(len(number), ends).tolist(), strict=True):
        sets.setdefault(first, []).append(member)
    return [tuple(found) for found in sets.values()]
