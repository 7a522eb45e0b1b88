"""Which parts lie inside others: the ball in the valve body, the shaft in its housing."""

from __future__ import annotations

import dataclasses

import numpy as np
import numpy.typing as npt

from cadgraph.geometry.contact.broad import near_boxes
from cadgraph.geometry.visibility.inside import find_inside
from cadgraph.model.parts import Parts
from cadgraph.model.scene import Floats, Ints

__all__ = ["find_insides", "join_enclosed"]

# Ours: one of the 24 points on a part may lie free, where the ball shows in the bore; a stem that stands out of its
# body leaves two or more free.
_SHARE = 0.95

_SLACK = 1e-9  # a box that ends with the one around it lies within it [m]

# A structure of at most this many parts joins the one around it: what a valve or a pump holds. A plant in a closed room
# has more, and its pipe systems must stay apart.
_FEW = 8


def find_insides(parts: Parts, method: str = "exact") -> Parts:
    """Finds the parts that other parts enclose on all sides.

    A part that is inside several, one in another, is inside the innermost. The ground neither encloses nor is enclosed.

    Args:
        parts: of the scene.
        method: of the build; with ``"paper"`` nothing is looked for, as the paper knows no insides.

    Returns:
        The same parts with ``inside`` filled in.
    """
    if method == "paper":
        return parts
    boxes = parts.properties.aabb
    boxed = _boxed(boxes, ~parts.ground)
    used = np.unique(boxed)
    if not len(used):
        return parts
    found = used[find_inside(parts.scene.select(used), min_share=_SHARE).pairs]
    # Only what lies in a box that is larger than its own: of two shapes of one size neither holds the other.
    n = parts.n_parts
    found = found[np.isin(found[:, 0] * n + found[:, 1], boxed[:, 0] * n + boxed[:, 1])]
    size = np.prod(np.diff(boxes, axis=1)[:, 0], axis=1)
    order = np.lexsort((found[:, 1], size[found[:, 1]], found[:, 0]))
    inside: dict[int, int] = {}
    for inner, outer in found[order].tolist():
        inside.setdefault(inner, outer)
    return dataclasses.replace(parts, inside=inside)


def _boxed(boxes: Floats, wanted: npt.NDArray[np.bool_]) -> Ints:
    """Pairs ``(n, 2)`` of parts of which the first one's box lies within that of the second and is smaller."""
    near = near_boxes(boxes, 0.0)
    pairs = np.concatenate([near, near[:, ::-1]])
    inner, outer = boxes[pairs[:, 0]], boxes[pairs[:, 1]]
    within = ((inner[:, 0] >= outer[:, 0] - _SLACK) & (inner[:, 1] <= outer[:, 1] + _SLACK)).all(axis=1)
    smaller = np.prod(inner[:, 1] - inner[:, 0], axis=1) < np.prod(outer[:, 1] - outer[:, 0], axis=1)
    kept: Ints = pairs[within & smaller & wanted[pairs].all(axis=1)]
    return kept


def join_enclosed(cluster: Ints, parts: Parts) -> Ints:
    """Gives small structures that lie wholly inside one part to that part's structure.

    Args:
        cluster: ``(n_parts,)`` the cluster of each part, -1 for the ground and for noise.
        parts: of the scene, with their insides.

    Returns:
        ``(n_parts,)`` the clusters, numbered by their lowest part as before.
    """
    if not parts.inside:
        return cluster
    # The outer ones first, so that what is nested twice follows the one around it.
    size = np.prod(np.diff(parts.properties.aabb, axis=1)[:, 0], axis=1)
    around = [(_around(own, parts), own) for own in _small(cluster, parts)]
    joined = cluster.copy()
    for outer, own in sorted(around, key=lambda row: -size[row[0]]):
        if outer >= 0 and joined[outer] >= 0:
            joined[own] = joined[outer]
    kept = joined >= 0
    _, first, inverse = np.unique(joined[kept], return_index=True, return_inverse=True)
    joined[kept] = np.argsort(np.argsort(first))[inverse.reshape(-1)]
    return joined


def _small(cluster: Ints, parts: Parts) -> list[list[int]]:
    """The members of each structure of few parts that has one inside another part; noise is a structure of its own."""
    wanted = {int(cluster[part]) for part in parts.inside}
    members: dict[int, list[int]] = {own: [] for own in sorted(wanted - {-1})}
    for part, own in enumerate(cluster.tolist()):
        if own in members:
            members[own].append(part)
    loose = [[part] for part in parts.inside if cluster[part] < 0]
    return [*loose, *(own for own in members.values() if len(own) <= _FEW)]


def _around(own: list[int], parts: Parts) -> int:
    """The part outside of some parts that encloses each of them, directly or through others of them; -1 if none."""
    outers = {parts.inside.get(part, -1) for part in own} - set(own)
    return outers.pop() if len(outers) == 1 else -1
