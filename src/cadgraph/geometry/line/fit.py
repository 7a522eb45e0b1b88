"""Lets a swept line end at the mouths of its part."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from cadgraph.geometry.line.centreline import Branch, Centreline, End
from cadgraph.geometry.line.mouths import Mouth
from cadgraph.model.scene import Floats

__all__ = ["fit_ends"]

# An end belongs to a mouth that looks its way (cosine), off its axis by at most this share of the mouth's radius, and
# at most so many radii before or behind it: where a sweep stops at a step of the wall.
_ALIKE, _OFF, _BEFORE = 0.9, 0.5, 4.0
# Where the surface goes on this many radii beyond an end, the part does not end there.
_GOES_ON = 0.5


def fit_ends(line: Centreline, mouths: Sequence[Mouth], triangles: Floats) -> Centreline | None:
    """Moves the ends of a swept line to the mouths that they belong to.

    Args:
        line: as swept.
        mouths: of its part.
        triangles: ``(n, 3, 3)`` of the part [m].

    Returns:
        The line; None where a mouth stays without an end, or fewer ends are left than there are mouths.
    """
    partner = _partners(line, mouths)
    if len(partner) < len(mouths):
        return None
    branches, ends = list(line.branches), []
    for k, end in enumerate(line.ends):
        if k in partner:
            mouth = mouths[partner[k]]
            branches[end.branch] = _moved(branches[end.branch], end, mouth)
            ends.append(End(mouth.point, mouth.direction, mouth.radius, mouth.bore, end.branch))
        elif not mouths or not _goes_on(end, triangles):
            ends.append(end)
    return replace(line, branches=tuple(branches), ends=tuple(ends)) if ends else None


def _partners(line: Centreline, mouths: Sequence[Mouth]) -> dict[int, int]:
    """The mouth of each end that has one, the nearest first."""
    offers = []
    for k, end in enumerate(line.ends):
        for m, mouth in enumerate(mouths):
            offset = end.point - mouth.point
            ahead = float(offset @ mouth.direction)
            off = float(np.linalg.norm(offset - ahead * mouth.direction))
            if (
                float(end.direction @ mouth.direction) >= _ALIKE
                and off <= _OFF * mouth.radius
                and -_BEFORE * mouth.radius <= ahead <= mouth.radius
            ):
                offers.append((round(abs(ahead) + off, 9), k, m))
    taken: dict[int, int] = {}
    for _, k, m in sorted(offers):
        if k not in taken and m not in taken.values():
            taken[k] = m
    return taken


def _moved(branch: Branch, end: End, mouth: Mouth) -> Branch:
    """The branch with its tip at a mouth."""
    at_start = np.linalg.norm(branch.points[0] - end.point) <= np.linalg.norm(branch.points[-1] - end.point)
    points, radius, bore = branch.points.copy(), branch.radius.copy(), branch.bore.copy()
    tip = 0 if at_start else -1
    points[tip], radius[tip], bore[tip] = mouth.point, mouth.radius, mouth.bore
    return replace(branch, points=points, radius=radius, bore=bore)


def _goes_on(end: End, triangles: Floats) -> bool:
    """Whether the surface runs on ahead of an end."""
    offset = triangles.reshape(-1, 3) - end.point
    ahead = offset @ end.direction
    off = np.linalg.norm(offset - ahead[:, None] * end.direction, axis=1)
    return bool(np.any((ahead > _GOES_ON * end.radius) & (off <= end.radius)))
