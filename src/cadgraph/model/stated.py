"""What a source says is joined, as parts: its links name meshes, or nodes above several meshes."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

from cadgraph.model.facts import StatedLink
from cadgraph.model.scene import Ints

__all__ = ["MOST_MESHES", "StatedJoin", "resolve_links"]

MOST_MESHES = 2000
"""A node above more meshes than this is a plant or a building, and a link to it says nothing of what is joined."""


@dataclass(frozen=True)
class StatedJoin:
    """A link of the source with the parts at both of its ends.

    Args:
        first: parts that the link's first path names, ascending; none where it names none, or a node above more meshes
            than ``MOST_MESHES``.
        second: likewise.
        link: as the source has it.
    """

    first: tuple[int, ...]
    second: tuple[int, ...]
    link: StatedLink


def resolve_links(links: Iterable[StatedLink], paths: Sequence[str], part_of_mesh: Ints) -> tuple[StatedJoin, ...]:
    """Finds the parts that links are between.

    Args:
        links: of a scene; what is there twice counts once.
        paths: ``(n_meshes,)`` source paths.
        part_of_mesh: ``(n_meshes,)`` part of each.

    Returns:
        The links in their order.
    """
    places = _Places(paths, part_of_mesh.tolist())
    return tuple(StatedJoin(places.parts(link.first), places.parts(link.second), link) for link in dict.fromkeys(links))


class _Places:
    """The parts below each path of a source."""

    def __init__(self, paths: Sequence[str], parts: Sequence[int]) -> None:
        self._part_of = dict(zip(paths, parts, strict=True))
        self._known: dict[str, tuple[int, ...]] = {}

    @cached_property
    def _sorted(self) -> list[str]:
        return sorted(self._part_of)

    def parts(self, path: str) -> tuple[int, ...]:
        found = self._known.get(path)
        if found is None:
            found = self._known[path] = self._below(path)
        return found

    def _below(self, path: str) -> tuple[int, ...]:
        # "0" follows "/", so that all paths below a node stand between the two.
        node = path.rstrip("/")
        low, high = (bisect_left(self._sorted, node + mark) for mark in "/0")
        if high - low > MOST_MESHES:
            return ()
        named = [node] if node in self._part_of else []
        return tuple(sorted({self._part_of[each] for each in (*named, *self._sorted[low:high])}))
