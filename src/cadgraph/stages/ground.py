"""Finds the ground, which the paper excludes from clustering (section III-B, step 5), and says why it is or isn't."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from cadgraph.config import GroundConfig
from cadgraph.geometry.components import connected_sets
from cadgraph.geometry.contact.broad import near_boxes
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.parts import Bools, Properties
from cadgraph.model.scene import Floats, Ints, Scene

__all__ = ["find_ground", "report_ground"]


_TOLERANCE = 1e-6  # what ends this little above the underside of a plate still lies below it [m]
_SAME_PLACE = 0.05  # floors laid twice have their tops no further apart than this and the thickness of one [m]
_JOINT = 0.05  # slabs of one floor lie side by side, with joints no wider than this, and their tops as level [m]
_FILLED = 0.9  # least share of the rectangle round them that slabs of one floor fill
_MOST_TOLD = 3  # likely meshes that were not taken, of which that is told


@dataclass(frozen=True, eq=False)
class _Candidate:
    """What may be the ground: one flat and large mesh, or several side by side.

    Args:
        meshes: ascending.
        size: ``(3,)`` of the box round them [m].
        cover: share of everything else's footprint that is above or below them, 0..1.
        margin: their footprint over that of everything else.
        buried: share of all other meshes that lie wholly below them, 0..1.
        against: what speaks against it, in words; empty where it is the ground.
    """

    meshes: tuple[int, ...]
    size: Floats
    cover: float
    margin: float
    buried: float
    against: str


def find_ground(scene: Scene, properties: Properties, config: GroundConfig) -> Bools:
    """Which meshes are the ground.

    Found by itself, the ground is large, flat and lowest: it spreads under nearly all of everything else, is thin
    for its size, and nothing else lies wholly below it. It may be several slabs side by side. A base plate is no
    ground, since its feet or casters stand below it or it ends where its machine ends.

    Args:
        scene: all meshes, Z up.
        properties: of each mesh.
        config: thresholds, or the paths named by the user.

    Returns:
        ``(n_meshes,)`` bool.

    Raises:
        ValueError: a named path is not in the scene.
    """
    ground = np.zeros(scene.n_meshes, np.bool_)
    if config.find == "none" or scene.n_meshes == 0:
        return ground
    if config.find == "named":
        rank = {path: i for i, path in enumerate(scene.paths)}
        for path in config.meshes:
            if path not in rank:
                raise ValueError(
                    f"{scene.source.path}: ground {path!r} is not a mesh of the scene; {_remedy(path, scene)}"
                )
            ground[rank[path]] = True
    else:
        for one in _candidates(properties, config):
            ground[list(one.meshes)] |= not one.against
    return ground


def report_ground(
    scene: Scene, properties: Properties, config: GroundConfig, ground: Bools, found: Bools
) -> tuple[Diagnostic, ...]:
    """What is told of the ground: which meshes were taken and why, and which likely ones were not and why not.

    Args:
        scene: all meshes.
        properties: of each mesh.
        config: by which it was found.
        ground: ``(n_meshes,)`` what it is.
        found: ``(n_meshes,)`` what it would be if no user had said otherwise.
    """
    notes = list(_reasons(scene, _candidates(properties, config), ground)) if config.find == "auto" else []
    for code, meshes, words in (
        ("ground", ground & found & (config.find == "named"), " named as the ground and left out of clusters"),
        ("ground-corrected", ground & ~found, ": the ground, as a user said so"),
        ("ground-corrected", found & ~ground, ": no ground, as a user said so"),
    ):
        paths = tuple(scene.paths[i] for i in np.flatnonzero(meshes))
        notes += [Diagnostic(code, f"{_count(paths)}{words}", paths)] if paths else []
    if config.find == "auto" and scene.n_meshes > 1 and not (ground | found).any():
        notes.append(
            Diagnostic("no-ground", "no mesh was taken for the ground; where one is, name it with --ground PATH")
        )
    return tuple(notes)


def _reasons(scene: Scene, candidates: list[_Candidate], ground: Bools) -> Iterator[Diagnostic]:
    for one in candidates:
        if not one.against and ground[list(one.meshes)].any():
            paths = tuple(scene.paths[i] for i in one.meshes)
            why = (
                f"{_form(one)}, {one.size[2]:.2g} m thick, under {one.cover:.0%} of the footprint of all else, with "
                f"{f'{one.buried:.1%} of the other meshes' if one.buried else 'nothing'} below"
            )
            yield Diagnostic("ground", f"{_count(paths)} taken for the ground and left out of clusters: {why}", paths)
    # The widest first: what people would take for the floor.
    passed = sorted((one for one in candidates if one.against), key=lambda one: (-one.margin, one.meshes))
    told = [one for one in passed if not ground[list(one.meshes)].any()][:_MOST_TOLD]
    for one in told:
        paths = tuple(scene.paths[i] for i in one.meshes)
        yield Diagnostic("not-ground", f"flat, {_form(one)}, but not taken for the ground: {one.against}", paths)


def _form(one: _Candidate) -> str:
    return f"{one.size[0]:.3g} m x {one.size[1]:.3g} m"


def _count(paths: tuple[str, ...]) -> str:
    return f"{len(paths)} mesh{'es' if len(paths) > 1 else ''}"


def _candidates(properties: Properties, config: GroundConfig) -> list[_Candidate]:
    """Single meshes that are flat and large, then floors of several that are no ground by themselves."""
    low, high = properties.aabb[:, 0], properties.aabb[:, 1]
    size = high - low
    width = size[:, :2].min(axis=1)
    slabs = np.flatnonzero((size[:, 2] <= config.max_thickness_ratio * width) & (width >= config.min_size))
    if len(low) < 2 or not len(slabs):
        return []
    rest = _Rest(low, high, slabs)
    single = [_judged((i,), low[i], high[i], rest, config) for i in slabs.tolist()]
    left = [one.meshes[0] for one in single if one.against]
    return [
        *single,
        *(
            _judged(meshes, low[list(meshes)].min(axis=0), high[list(meshes)].max(axis=0), rest, config)
            for meshes in _floors(left, low, high)
        ),
    ]


def _floors(slabs: list[int], low: Floats, high: Floats) -> Iterator[tuple[int, ...]]:
    """Two or more slabs side by side with level tops that fill the rectangle round them."""
    boxes = np.stack([low[slabs], high[slabs]], axis=1).reshape(-1, 2, 3)
    boxes[:, 0, 2] = boxes[:, 1, 2]
    pairs = near_boxes(boxes, _JOINT)
    for members in connected_sets(range(len(slabs)), ((int(a), int(b)) for a, b in pairs)):
        if len(members) > 1:
            corners = boxes[list(members)]
            area = np.prod(corners[:, 1, :2] - corners[:, 0, :2], axis=1).sum()
            round_them = corners[:, 1, :2].max(axis=0) - corners[:, 0, :2].min(axis=0)
            if area >= _FILLED * np.prod(round_them):
                yield tuple(sorted(slabs[k] for k in members))


class _Rest:
    """All meshes but slabs whose tops are about as high as one's: a floor laid twice does not count against itself.

    Args:
        low: ``(n, 3)`` least corners of all meshes [m].
        high: ``(n, 3)`` their greatest corners.
        slabs: ``(n_slabs,)`` numbers of those that are flat and large.
    """

    def __init__(self, low: Floats, high: Floats, slabs: Ints) -> None:
        other = np.ones(len(low), np.bool_)
        other[slabs] = False
        self._order = slabs[np.argsort(high[slabs, 2], kind="stable")]
        self._tops = high[self._order, 2]
        self._others_top = np.sort(high[other, 2])
        # Extremes of the others and of the lowest k slabs, and of the others and of all from the kth on.
        lows, highs = low[self._order, :2], high[self._order, :2]
        least = low[other, :2].min(axis=0, initial=np.inf)[None]
        most = high[other, :2].max(axis=0, initial=-np.inf)[None]
        self._low_below = np.minimum.accumulate(np.concatenate([least, lows]))
        self._high_below = np.maximum.accumulate(np.concatenate([most, highs]))
        self._low_above = np.minimum.accumulate(np.concatenate([least, lows[::-1]]))[::-1]
        self._high_above = np.maximum.accumulate(np.concatenate([most, highs[::-1]]))[::-1]

    def of(self, low: Floats, high: Floats) -> tuple[int, Floats, Floats, int]:
        """Of a slab's box: how many others there are, the corners of their footprint, how many are wholly below it."""
        reach = high[2] - low[2] + _SAME_PLACE
        first, last = (
            int(np.searchsorted(self._tops, high[2] - reach, "left")),
            int(np.searchsorted(self._tops, high[2] + reach, "right")),
        )
        underside = low[2] + _TOLERANCE
        below = int(np.searchsorted(self._others_top, underside, "left")) + min(
            first, int(np.searchsorted(self._tops, underside, "left"))
        )
        n = len(self._others_top) + first + len(self._tops) - last
        lowest = np.minimum(self._low_below[first], self._low_above[last])
        highest = np.maximum(self._high_below[first], self._high_above[last])
        return n, lowest, highest, below


def _judged(meshes: tuple[int, ...], low: Floats, high: Floats, rest: _Rest, config: GroundConfig) -> _Candidate:
    n, lowest, highest, below = rest.of(low, high)
    size = high - low
    if not n:
        return _Candidate(meshes, size, 0.0, 0.0, 0.0, "nothing stands on it")
    spread = highest - lowest
    over = np.clip(np.minimum(high[:2], highest) - np.maximum(low[:2], lowest), 0, None)
    cover = float(np.prod(over / np.maximum(spread, 1e-9)))
    margin = float(np.prod(size[:2])) / max(float(np.prod(spread)), 1e-9)
    overhang = float(min((high[:2] - highest).min(), (lowest - low[:2]).min()))
    buried = below / n
    against = ""
    if buried > config.max_buried:
        against = f"{below:,} of the other meshes lie{'s' if below == 1 else ''} wholly below it"
    elif cover < config.min_cover:
        against = f"it is under {cover:.0%} of the footprint of all else only, less than {config.min_cover:.0%}"
    elif margin < config.min_margin and overhang < config.min_overhang:
        against = (
            f"it ends where all else does: its area is {margin:.3g} times the footprint of that, less than "
            f"{config.min_margin:.3g}, and it reaches {overhang:.2g} m beyond, less than {config.min_overhang:.2g} m"
        )
    return _Candidate(meshes, size, cover, margin, buried, against)


def _remedy(path: str, scene: Scene) -> str:
    below = [mesh for mesh in scene.paths if mesh.startswith(f"{path.rstrip('/')}/")]
    return f"give a mesh, as {below[0]!r} below it" if below else "give a path as in graph.json, or none at all"
