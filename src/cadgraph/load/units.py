"""Whether a scene's unit of length is right: by the diameters of its pipes, which standards fix, and by its sizes.

Ours; measured in docs/formats.md. A unit that the file states is never changed by it, only doubted; where a file states
none, it decides if the evidence is clear.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadgraph.model.scene import Floats, Scene, turned_boxes
from cadgraph.model.standards import outer_diameters

__all__ = ["METRES", "UnitEvidence", "bounds_of", "distinct", "pipe_diameters", "weigh_units"]

METRES = {"m": 1.0, "dm": 0.1, "cm": 0.01, "mm": 0.001, "in": 0.0254, "ft": 0.3048, "km": 1000.0}
"""Length of each unit [m]."""

_LEAD = 4.0  # least natural logarithm of the odds of the likeliest unit against the next that counts as evidence

_ROUND = 0.012  # greatest spread of the outermost corners of a round section about its radius, as share of that
_SLENDER = 2.0  # least length of a pipe over its diameter
_NEAR = 0.004  # a diameter is a standard one within this share
_HIT, _CHANCE = 0.72, 0.085  # of a true pipe's diameter to be standard; of any other length (41 windows of 0.8 %)
_SAME = 0.002  # diameters this close are one
_MOST_CORNERS = 20_000  # of a shape that is looked at; no pipe has more
_MOST_SHAPES = 3000  # so many shapes, evenly chosen, tell
_FEW_FOR_SIZES = 20  # meshes
_ODD, _USUAL = 16.0, 4.0  # sums of two squared standard deviations: one plant in 3,000 is odder, six in seven are not
_LEAST_SHARE = 1e-3  # of the scene's extent; smaller shapes are not counted
_SCENE = (np.log(12.0), 1.7)  # natural logarithm of the extent of a scene [m]: middle and spread
_MESH = (np.log(0.25), 1.2)  # likewise of the median extent of its meshes


@dataclass(frozen=True)
class UnitEvidence:
    """How likely each unit is for a scene.

    Args:
        scores: natural logarithm of the odds of each unit of ``METRES``, up to a constant.
        hits: how many distinct diameters of long round meshes are standard ones in each unit.
        n_diameters: how many there are.
        largest: the greatest extent of the scene, in the file's unit.
        median: of the greatest extents of its meshes, likewise.
    """

    scores: dict[str, float]
    hits: dict[str, int]
    n_diameters: int
    largest: float
    median: float

    def odd(self, metres: float, n_meshes: int) -> bool:
        """Whether the sizes of scene and meshes are odd for a plant, and usual or far less odd in the likeliest unit.

        Args:
            metres: length of the file's unit [m].
            n_meshes: in the scene; of a few, sizes tell nothing.
        """
        if n_meshes < _FEW_FOR_SIZES:
            return False
        odd, least = self._oddness(metres), self._oddness(METRES[self.best])
        # Where every bolt and thread is drawn, half of the meshes are smaller than those of a plant in any unit.
        return odd > _ODD and (least < _USUAL or odd - least > 2 * _ODD)

    @property
    def fitting(self) -> tuple[str, ...]:
        """The likeliest unit, then the others in which the sizes are usual for a plant, the most usual first."""
        ranked = sorted(METRES, key=lambda unit: (unit != self.best, self._oddness(METRES[unit])))
        return tuple(unit for unit in ranked if unit == self.best or self._oddness(METRES[unit]) < _USUAL)

    def _oddness(self, metres: float) -> float:
        return float(
            sum(
                ((np.log(max(size * metres, 1e-300)) - middle) / spread) ** 2
                for size, (middle, spread) in ((self.largest, _SCENE), (self.median, _MESH))
            )
        )

    @property
    def best(self) -> str:
        """The likeliest unit."""
        return max(self.scores, key=lambda unit: self.scores[unit])

    @property
    def lead(self) -> float:
        """By how much it is likelier than the next one."""
        ranked = sorted(self.scores.values(), reverse=True)
        return ranked[0] - ranked[1]

    @property
    def clear(self) -> bool:
        """Whether the likeliest unit may be taken where the file states none."""
        # Two of many are chance: of a dozen lengths two are standard ones in some unit or other.
        hits = self.hits[self.best]
        return self.lead >= _LEAD and (hits >= 3 or hits == self.n_diameters == 2)

    @property
    def certain(self) -> bool:
        """Whether the likeliest unit is enough to doubt one that the file states."""
        hits = self.hits[self.best]
        return self.lead >= _LEAD and (hits >= 3 or (hits == self.n_diameters == 2 and self.lead >= 2 * _LEAD))


def pipe_diameters(scene: Scene) -> Floats:
    """The diameters of the shapes that are long and round [m]; of a large scene those of some thousands of them."""
    return _sizes(scene)[1]


def distinct(diameters: Floats) -> Floats:
    """Diameters in order, each once within 0.2 %."""
    ordered = np.sort(diameters[diameters > 0])
    new = np.concatenate([[True], ordered[1:] > ordered[:-1] * (1 + _SAME)]) if len(ordered) else np.zeros(0, bool)
    found: Floats = ordered[new]
    return found


def weigh_units(scene: Scene, meters_per_unit: float) -> UnitEvidence:
    """Weighs all units for a scene.

    Args:
        scene: with lengths as they were read.
        meters_per_unit: what one unit of the file was taken as [m].
    """
    extents, diameters = _sizes(scene)
    low, high = bounds_of(scene)
    largest = float((high - low).max()) / meters_per_unit
    # Strokes of a dial by the hundred are no parts of a plant that their number could tell the unit of.
    extents = extents[extents >= _LEAST_SHARE * largest * meters_per_unit]
    median = float(np.median(extents)) / meters_per_unit if len(extents) else 0.0
    different = distinct(diameters / meters_per_unit)
    standard = np.log(sorted({outer for _, outer in outer_diameters()}))
    scores, hits = {}, {}
    for unit, metres in METRES.items():
        near = np.abs(np.log(np.maximum(different * metres, 1e-300))[:, None] - standard[None]).min(
            axis=1, initial=np.inf
        )
        hit = int(np.count_nonzero(near <= _NEAR))
        miss = len(different) - hit
        score = hit * np.log(_HIT / _CHANCE) + miss * np.log((1 - _HIT) / (1 - _CHANCE))
        for size, (middle, spread) in ((largest, _SCENE), (median, _MESH)):
            score += -0.5 * ((np.log(max(size * metres, 1e-300)) - middle) / spread) ** 2
        scores[unit], hits[unit] = float(score), hit
    return UnitEvidence(scores, hits, len(different), largest, median)


def bounds_of(scene: Scene) -> tuple[Floats, Floats]:
    """The least and the greatest corner of a scene ``(3,)``, in its own lengths, without placing all of it."""
    placement = scene.placement
    if placement is None:
        return scene.vertices.min(axis=0), scene.vertices.max(axis=0)
    first = scene.shapes.vertex_offsets[:-1]
    lowest = np.minimum.reduceat(scene.shapes.vertices, first)[placement.shape]
    highest = np.maximum.reduceat(scene.shapes.vertices, first)[placement.shape]
    least, greatest = turned_boxes(lowest, highest, placement.turn, placement.shift)
    # The box of a turned shape reaches too far rather than not far enough: once no other box reaches as far as the
    # vertices that were looked at, nor does any other mesh.
    ends = np.full((2, 3), np.inf)
    for end, axis in np.ndindex(2, 3):
        sign = 1 - 2 * end
        bounds = -greatest[:, axis] if end else least[:, axis]
        for mesh in np.argsort(bounds, kind="stable").tolist():
            if bounds[mesh] >= ends[end, axis]:
                break
            ends[end, axis] = min(ends[end, axis], (sign * scene.mesh(mesh)[0][:, axis]).min())
    return ends[0], -ends[1]


def _sizes(scene: Scene) -> tuple[Floats, Floats]:
    """The greatest extent of each of some shapes [m], and the diameters of those that are long and round [m]."""
    shapes = scene.shapes
    chosen = np.unique(np.linspace(0, shapes.n - 1, min(shapes.n, _MOST_SHAPES)).astype(np.int64))
    counts = np.diff(shapes.vertex_offsets)[chosen]
    some = shapes.select(chosen[(counts >= 6) & (counts <= _MOST_CORNERS)])
    if not some.n:
        return np.zeros(0), np.zeros(0)
    counts = np.diff(some.vertex_offsets)
    owner = np.repeat(np.arange(some.n), counts)
    points = some.vertices
    first = np.concatenate([[0], np.cumsum(counts)[:-1]])
    points = points - (np.add.reduceat(points, first) / counts[:, None])[owner]
    outer = np.einsum("ni,nj->nij", points, points)
    moments = np.add.reduceat(outer.reshape(-1, 9), first).reshape(-1, 3, 3) / counts[:, None, None]
    # The axis of a straight pipe: the corners of a regular section vary alike in all directions across it.
    axis = np.linalg.eigh(moments)[1][:, :, 2]
    along = np.einsum("ni,ni->n", points, axis[owner])
    across = points - along[:, None] * axis[owner]
    radius = np.linalg.norm(across, axis=1)
    length = np.maximum.reduceat(along, first) - np.minimum.reduceat(along, first)
    greatest = np.maximum.reduceat(radius, first)
    rim = radius >= (1 - _ROUND) * greatest[owner]
    n_rim = np.add.reduceat(rim.astype(np.float64), first)
    # All around: the corners of a rim cancel out.
    lean = np.linalg.norm(np.add.reduceat(across * rim[:, None], first), axis=1)
    even = lean <= 0.1 * greatest * np.maximum(n_rim, 1)
    pipes = (length >= _SLENDER * 2 * greatest) & (n_rim >= 0.3 * counts) & even & (n_rim >= 12)
    extents = np.maximum.reduceat(np.abs(points).max(axis=1), first) * 2
    return extents, 2 * greatest[pipes]
