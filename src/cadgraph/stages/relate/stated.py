"""What the file itself says of joints, as a witness beside geometry: which parts it joins, and which it doesn't."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.scene import Floats
from cadgraph.model.stated import StatedJoin

__all__ = ["REACH", "Stated", "mouth_gap", "report_unplaced"]

REACH = 0.15
"""A link of the file is looked at across a gap of at most this much [m]; what is farther apart is not joined by it."""

# An element is known in full where the file joins it to as many others as it has ends, and to this many at least.
_LEAST_LINKS = 2
# Rays along the wall of a pipe look for the solid before its mouth, at this share of the radius; so many must meet it.
_RAYS, _SHARE, _LEAST_HITS = 8, 0.9, 5


@dataclass(frozen=True, eq=False)
class Stated:
    """What the file says of joints.

    Args:
        joins: with the parts at both ends.
    """

    joins: tuple[StatedJoin, ...] = ()

    @cached_property
    def usable(self) -> tuple[StatedJoin, ...]:
        """The joins between two different places that both are in the scene."""
        return tuple(
            join for join in self.joins if join.first and join.second and set(join.first).isdisjoint(join.second)
        )

    @cached_property
    def _ends_at(self) -> Mapping[int, Mapping[int, bool]]:
        """Of each part the joins at it, and whether it is at the first end."""
        found: dict[int, dict[int, bool]] = {}
        for number, join in enumerate(self.usable):
            for part in join.first:
                found.setdefault(part, {})[number] = True
            for part in join.second:
                found.setdefault(part, {})[number] = False
        return found

    def __bool__(self) -> bool:
        return bool(self.usable)

    def by(self, first: int, second: int) -> str | None:
        """By what the file says that two parts are joined; None where it doesn't."""
        here, there = self._ends_at.get(first, {}), self._ends_at.get(second, {})
        here, there = (here, there) if len(here) <= len(there) else (there, here)
        shared = [number for number, side in here.items() if there.get(number, side) != side]
        return self.usable[min(shared)].link.where or "a link" if shared else None

    def partners(self, part: int) -> tuple[int, ...]:
        """The parts that the file joins to one, ascending."""
        joins = ((self.usable[number], side) for number, side in self._ends_at.get(part, {}).items())
        return tuple(sorted({other for join, side in joins for other in (join.second if side else join.first)}))

    def is_complete(self, part: int, n_ends: int) -> bool:
        """Whether the file joins a part to at least as many others as it has ends."""
        return self._degree.get(part, 0) >= max(_LEAST_LINKS, n_ends)

    @cached_property
    def _degree(self) -> Mapping[int, int]:
        """To how many others the file joins each part that is an element by itself."""
        others: dict[int, set[str]] = {}
        for join in self.usable:
            for own, path in ((join.first, join.link.second), (join.second, join.link.first)):
                if len(own) == 1:
                    others.setdefault(own[0], set()).add(path)
        return {part: len(paths) for part, paths in others.items()}


def mouth_gap(triangles: Floats, point: Floats, direction: Floats, radius: float) -> tuple[float, float] | None:
    """How far a solid lies before the mouth of a pipe, seen along the pipe's wall.

    Args:
        triangles: ``(n, 3, 3)`` of the solid [m].
        point: ``(3,)`` middle of the mouth [m].
        direction: ``(3,)`` unit vector outward.
        radius: of the pipe [m].

    Returns:
        The gap, and how far the middle of what is met lies off the axis [m]; None where the solid does not lie before
        most of the wall within ``REACH``.
    """
    side = np.cross(direction, np.eye(3)[int(np.argmin(np.abs(direction)))])
    side /= np.linalg.norm(side)
    angles = 2 * np.pi * np.arange(_RAYS) / _RAYS
    ring = _SHARE * radius * (np.cos(angles)[:, None] * side + np.sin(angles)[:, None] * np.cross(direction, side))
    local = triangles - point
    along = local @ direction
    near = (along.max(axis=1) >= 0) & (along.min(axis=1) <= REACH)
    reached = np.array([_first_hit(local[near], start, direction) for start in ring])
    hit = reached <= REACH
    if hit.sum() < _LEAST_HITS:
        return None
    return float(np.median(reached[hit])), float(np.linalg.norm(ring[hit].mean(axis=0)))


def _first_hit(triangles: Floats, start: Floats, direction: Floats) -> float:
    """Distance to the first triangle that a ray meets [m], infinite where there is none (Moeller and Trumbore 1997)."""
    a, u, v = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    p = np.cross(direction, v)
    det = np.einsum("ij,ij->i", u, p)
    flat = np.abs(det) < 1e-30
    scale = 1 / np.where(flat, 1.0, det)
    offset = start - a
    q = np.cross(offset, u)
    s, t = np.einsum("ij,ij->i", offset, p) * scale, (q @ direction) * scale
    far = np.einsum("ij,ij->i", v, q) * scale
    met = ~flat & (s >= 0) & (t >= 0) & (s + t <= 1) & (far >= 0)
    return float(far[met].min()) if met.any() else float("inf")


def report_unplaced(stated: Stated) -> tuple[Diagnostic, ...]:
    """A diagnostic of the links that say nothing, because an end of theirs is not in the scene or in the other one."""
    usable = {id(join) for join in stated.usable}
    lost = [join for join in stated.joins if id(join) not in usable]
    if not lost:
        return ()
    first = lost[0].link
    message = (
        f"{len(lost)} of {len(stated.joins)} links of the source are no evidence: an end is no mesh of the scene, a "
        f"node above too many, or in the other end; the first joins {first.first!r} and {first.second!r}"
    )
    return (Diagnostic("stated-unplaced", message),)
