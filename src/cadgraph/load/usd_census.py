"""How many prims a USD scene is composed of, counted before the USD library composes them.

A few lines of references to references make millions of prims, and the library keeps all of them. What is counted here
is never less than that (each layer's opinions on a prim count by themselves), takes time by the size of the files
alone, and counts what native instances share once.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

from cadgraph.load.usd_arcs import Arc, LayerArcs, Site

__all__ = ["Census"]

_STEPS = 300_000  # places that are looked at in a scene that refers to itself; ours
_VARIANT = re.compile(r"\{[^}]*\}")


class _Place(NamedTuple):
    """A prim in a stack of layers; with all that is below it, or by itself."""

    stack: str
    path: str
    below: bool


class _Group(NamedTuple):
    """Places of which one is composed: the variants of a set, or the one target of an arc."""

    places: tuple[_Place, ...]


class _Stack:
    """A layer with its sublayers, as one.

    Args:
        layers: each once.
        n: how many these are, each as often as it is named.
    """

    def __init__(self, layers: list[LayerArcs], n: int) -> None:
        self.layers = layers
        self.n = n
        self.sites: dict[str, list[tuple[LayerArcs, Site]]] = {}
        for layer in layers:
            for path, site in layer.sites.items():
                self.sites.setdefault(path, []).append((layer, site))
        scopes: dict[str, list[str]] = {}
        for path in self.sites:
            scopes.setdefault(_scope(path), []).append(path)
        self._of_scope = {scope: sorted(paths) for scope, paths in scopes.items()}

    def size(self, path: str) -> int:
        return sum(layer.size(path) for layer in self.layers)

    def sites_below(self, path: str) -> Iterator[str]:
        """Paths of the sites below a prim, without those in variants."""
        paths = self._of_scope.get(_scope(path), [])
        start = path if path.endswith(("}", "/")) else f"{path}/"
        first = bisect_left(paths, start)
        for i in range(first, len(paths)):
            if not paths[i].startswith(start):
                return
            if paths[i] != path:
                yield paths[i]


class Census:
    """The count over a set of layers.

    Args:
        layers: by identifier; what is not here is not composed.
        below: identifier of the layer that an asset path in a layer names, by both.
    """

    def __init__(self, layers: Mapping[str, LayerArcs], below: Mapping[tuple[str, str], str]) -> None:
        self._layers = layers
        self._below = below
        self._root = ""
        self._stacks: dict[str, _Stack] = {}
        self._known: dict[_Place, int] = {}
        self._shared: dict[_Place, None] = {}
        self._groups_of: dict[tuple[str, str, Site, bool], tuple[list[_Group], bool]] = {}
        self._circles: dict[_Place, None] = {}
        off = (path for layer in layers.values() for path, site in layer.sites.items() if site.instanceable is False)
        self._opened = {_name(path) for path in off}

    def prims(self, root: str) -> int | None:
        """Prims of the scene of a root layer: at least so many as are composed.

        Args:
            root: identifier of the layer.

        Returns:
            Their number, or None where the scene refers to itself in so many circles that nobody can count them.
        """
        self._root = root
        total = self._count(_Place(root, "/", True))
        counted = 0
        while counted < len(self._shared):
            # What is counted may bring more that is shared.
            total += self._count(list(self._shared)[counted])
            counted += 1
        for place in self._circles:
            steps = self._steps(place)
            if steps is None:
                return None
            total += steps
        return total

    def _stack(self, root: str) -> _Stack:
        if root not in self._stacks:
            order = [root, *_all_below(root, self._sublayers)]
            self._stacks[root] = _Stack([self._layers[each] for each in order], self._named(root))
        return self._stacks[root]

    def _sublayers(self, identifier: str) -> list[str]:
        found = (self._below.get((identifier, asset), "") for asset in self._layers[identifier].sublayers)
        return [each for each in found if each in self._layers]

    def _named(self, root: str) -> int:
        """How many layers a stack has, each as often as it is named; those that name themselves once."""
        known: dict[str, int] = {}
        open_ones: dict[str, None] = {}
        waiting = [root]
        while waiting:
            at = waiting[-1]
            below = self._sublayers(at)
            if at in known:
                waiting.pop()
                continue
            if at not in open_ones:
                open_ones[at] = None
                waiting.extend(each for each in below if each not in known and each not in open_ones)
                continue
            known[at] = 1 + sum(known.get(each, 0) for each in below)
            waiting.pop()
        return known[root]

    def _count(self, start: _Place) -> int:
        """The prims of a place, by those of all places that it is composed of."""
        groups: dict[_Place, Counter[_Group]] = {}
        waiting = [start]
        while waiting:
            place = waiting[-1]
            if place in self._known:
                waiting.pop()
                continue
            if place not in groups:
                groups[place] = self._groups(place)
                inner = {each for group in groups[place] for each in group.places if each not in self._known}
                self._circles |= dict.fromkeys(sorted(each for each in inner if each in groups))
                waiting.extend(sorted(each for each in inner if each not in groups))
                continue
            total = self._own(place)
            for group, n in groups.pop(place).items():
                total += n * max((self._known.get(each, 0) for each in group.places), default=0)
            self._known[place] = total
            waiting.pop()
        return self._known[start]

    def _own(self, place: _Place) -> int:
        stack = self._stack(place.stack)
        own = stack.size(place.path) if place.below else 1
        return own + (stack.n - len(stack.layers))

    def _groups(self, place: _Place) -> Counter[_Group]:
        """What a place is composed of besides its own prims."""
        stack = self._stack(place.stack)
        found: Counter[_Group] = Counter(self._targets(place.stack, place.path, place.below))
        for above in _above(place.path):
            # What an arc above brings lies below its target.
            within = place.path[len(above)] == "{"
            rest = _VARIANT.sub("/", place.path[len(above) :]).strip("/").replace("//", "/")
            for group in self._targets(place.stack, above, place.below, not within) if rest else ():
                found[_Group(tuple(each._replace(path=_joined(each.path, rest)) for each in group.places))] += 1
        if place.below:
            for path in stack.sites_below(place.path):
                groups, shared = self._at(place.stack, path)
                found.update(groups)
                if shared:
                    self._shared |= {each._replace(below=True): None for group in groups for each in group.places}
        return found

    def _at(self, identifier: str, path: str) -> tuple[list[_Group], bool]:
        """What one prim below a place is composed of, and whether it is an instance."""
        sites = self._stack(identifier).sites[path]
        alike = len(sites) == 1 and not sites[0][1].variants
        opened = _name(path) in self._opened
        key = (identifier, sites[0][0].layer.identifier, sites[0][1], opened)
        if alike and key in self._groups_of:
            return self._groups_of[key]
        groups = list(self._targets(identifier, path, True))
        shared = not opened and self._is_instance(sites, groups)
        if shared:
            # The instance is composed by itself, what is below it once for all.
            groups = [_Group(tuple(each._replace(below=False) for each in group.places)) for group in groups]
        if alike:
            self._groups_of[key] = groups, shared
        return groups, shared

    def _is_instance(self, sites: list[tuple[LayerArcs, Site]], groups: list[_Group]) -> bool:
        said = [site.instanceable for _, site in sites if site.instanceable is not None]
        if said:
            return said[0]
        return any(
            site.instanceable
            for group in groups
            for place in group.places
            for _, site in self._stack(place.stack).sites.get(place.path, ())
        )

    def _targets(self, identifier: str, path: str, below: bool, variants: bool = True) -> Iterator[_Group]:
        """What the arcs and the variants of one prim bring."""
        for layer, site in self._stack(identifier).sites.get(path, ()):
            for each in site.variants if variants else ():
                yield _Group(tuple(_Place(identifier, one, below) for one in each))
            for arc in site.arcs:
                yield from self._targets_of(arc, identifier, layer, below)

    def _targets_of(self, arc: Arc, identifier: str, layer: LayerArcs, below: bool) -> Iterator[_Group]:
        if not arc.asset:
            target = arc.prim or self._layers[identifier].default
            if target:
                yield _Group((_Place(identifier, target, below),))
                if arc.kind in ("inherit", "specialize") and identifier != self._root:
                    # What the root says of a class counts wherever the class is used.
                    yield _Group((_Place(self._root, target, below),))
            return
        found = self._below.get((layer.layer.identifier, arc.asset), "")
        if found in self._layers:
            target = arc.prim or self._layers[found].default
            if target:
                yield _Group((_Place(found, target, below),))

    def _steps(self, start: _Place) -> int | None:
        """How many places are composed where some refer to themselves; the library breaks each circle where it closes.

        They are gone through one by one; None where they are too many for that.
        """
        groups: dict[_Place, Counter[_Group]] = {}
        n = 0
        path: dict[_Place, None] = {}
        waiting: list[tuple[_Place, bool]] = [(start, True)]
        while waiting:
            place, enter = waiting.pop()
            if not enter:
                del path[place]
                continue
            if place in path:
                continue
            path[place] = None
            waiting.append((place, False))
            if place not in groups:
                groups[place] = self._groups(place)
            n += 1 + sum(groups[place].values())
            if n > _STEPS:
                return None
            for group, times in groups[place].items():
                waiting.extend((each, True) for each in group.places for _ in range(times))
        return n


def _all_below(root: str, below: Callable[[str], list[str]]) -> Iterator[str]:
    """All layers below one, each once."""
    seen = {root}
    waiting = [root]
    while waiting:
        for each in below(waiting.pop()):
            if each not in seen:
                seen.add(each)
                yield each
                waiting.append(each)


def _scope(path: str) -> str:
    """The variant that a path lies in, or empty."""
    return path[: path.rfind("}") + 1]


def _name(path: str) -> str:
    return path.rpartition("/")[2].rpartition("}")[2]


def _joined(path: str, rest: str) -> str:
    return f"{path}{rest}" if path.endswith(("}", "/")) else f"{path}/{rest}"


def _above(path: str) -> Iterator[str]:
    """The prims above one, and those that its variants belong to."""
    for i, letter in enumerate(path):
        if i and letter in "/{":
            yield path[:i]
        if letter == "}" and i + 1 < len(path):
            yield path[: i + 1]
