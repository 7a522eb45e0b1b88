"""How parts stand to their neighbours, in numbers that don't depend on pose or size."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadgraph.geometry.mesh.sample import Samples, sample_surfaces
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.scene import Floats, Ints

__all__ = ["PLACE_FEATURES", "SIDE_FEATURES", "Surroundings", "find_surroundings"]

_POINTS = 48
_HULL = 1.03  # a little more than a part's own cylinder: touching surfaces are within
_TINY = 1e-9

SIDE_FEATURES = (
    "size", "area", "parallel", "offset", "offset back", "ahead", "ahead back", "spot along", "spot out",
    "spot along back", "spot out back", "holds", "is held", "same shape", "gap", "way", "way back", "far", "radius",
    "length", "round", "round back",
)  # fmt: skip
"""What is known of one neighbour as a part sees it. Lengths are relative to the part's, logarithmic if unbounded."""

PLACE_FEATURES = ("neighbors", "alike around one", "alike in all", "held most", "round", "alike touching")
"""What is known of a part's place among all."""


@dataclass(frozen=True)
class Surroundings:
    """The neighbours of all parts.

    Args:
        here: ``(n_sides,)`` part; each contact appears from both sides.
        there: ``(n_sides,)`` its neighbour.
        sides: ``(n_sides, len(SIDE_FEATURES))``.
        places: ``(n_parts, len(PLACE_FEATURES))``.
    """

    here: Ints
    there: Ints
    sides: Floats
    places: Floats


@dataclass(frozen=True)
class _Hulls:
    """A cylinder about each part: axis, centre, half length, radius, and how round the part is (0..1)."""

    axis: Floats
    center: Floats
    half: Floats
    radius: Floats
    round: Floats


def find_surroundings(parts: Parts, contacts: Contacts) -> Surroundings:
    """Describes each part's neighbours; the ground is nobody's neighbour.

    Args:
        parts: with their geometry.
        contacts: pairs of parts that are adjacent.
    """
    pairs = contacts.pairs
    kept = ~(parts.ground[pairs[:, 0]] | parts.ground[pairs[:, 1]]) if len(pairs) else np.zeros(0, np.bool_)
    pairs, gap, spots = pairs[kept], contacts.distance[kept], contacts.points[kept]
    here, there = np.concatenate([pairs[:, 0], pairs[:, 1]]), np.concatenate([pairs[:, 1], pairs[:, 0]])
    gap, spot = np.tile(gap, 2), np.tile(spots.mean(axis=1), (2, 1)) if len(pairs) else np.zeros((0, 3))
    samples = sample_surfaces(parts.scene, _POINTS)
    hulls = _hulls(parts, samples)
    order = np.lexsort((there, here))
    here, there, gap, spot = here[order], there[order], gap[order], spot[order]
    sides = _sides(parts, hulls, samples, here, there, gap, spot)
    return Surroundings(here, there, sides, _places(parts, hulls, here, there, sides))


def _hulls(parts: Parts, samples: Samples) -> _Hulls:
    properties = parts.properties
    spread, vectors = np.linalg.eigh(properties.inertia)
    low, high = spread[:, 1] - spread[:, 0], spread[:, 2] - spread[:, 1]
    rod = high <= low
    axis = np.where(rod[:, None], vectors[:, :, 0], vectors[:, :, 2])
    apart = samples.points - properties.centroid[:, None]
    along = np.einsum("mnk,mk->mn", apart, axis)
    out = np.linalg.norm(apart - along[..., None] * axis[:, None], axis=2)
    even = 1 - np.minimum(low, high) / np.maximum(spread[:, 2], 1e-30)
    return _Hulls(
        axis,
        properties.centroid,
        np.maximum(np.abs(along).max(axis=1, initial=0), 1e-5),
        np.maximum(out.max(axis=1, initial=0), 1e-5),
        even,
    )


def _in_frame(hulls: _Hulls, rows: Ints, points: Floats) -> tuple[Floats, Floats]:
    """Distance along and from the axis of points ``(n, 3)``, over half length and radius."""
    apart = points - hulls.center[rows]
    along = np.einsum("nk,nk->n", apart, hulls.axis[rows])
    out = np.linalg.norm(apart - along[:, None] * hulls.axis[rows], axis=1)
    return np.abs(along) / hulls.half[rows], out / hulls.radius[rows]


def _held(hulls: _Hulls, holder: Ints, points: Floats) -> Floats:
    """Share of the points ``(n, m, 3)`` within the holder's cylinder."""
    apart = points - hulls.center[holder][:, None]
    axis = hulls.axis[holder]
    along = np.einsum("nmk,nk->nm", apart, axis)
    out = np.linalg.norm(apart - along[..., None] * axis[:, None], axis=2)
    inside = (np.abs(along) <= _HULL * hulls.half[holder][:, None]) & (out <= _HULL * hulls.radius[holder][:, None])
    share: Floats = inside.mean(axis=1)
    return share


def _sides(parts: Parts, hulls: _Hulls, samples: Samples, here: Ints, there: Ints, gap: Floats, spot: Floats) -> Floats:
    if not len(here):
        return np.zeros((0, len(SIDE_FEATURES)))
    properties = parts.properties
    size = np.maximum(np.linalg.norm(properties.obb_extents, axis=1), 1e-5)
    area = np.maximum(properties.area, 1e-10)
    between = hulls.center[there] - hulls.center[here]
    far = np.linalg.norm(between, axis=1)
    way = between / np.maximum(far, _TINY)[:, None]
    ahead, offset = _in_frame(hulls, here, hulls.center[there])
    ahead_back, offset_back = _in_frame(hulls, there, hulls.center[here])
    along, out = _in_frame(hulls, here, spot)
    along_back, out_back = _in_frame(hulls, there, spot)
    columns = (
        np.log(size[there] / size[here]),
        np.log(area[there] / area[here]) / 2,
        np.abs(np.einsum("nk,nk->n", hulls.axis[here], hulls.axis[there])),
        np.log1p(offset), np.log1p(offset_back), np.log1p(ahead), np.log1p(ahead_back),
        np.minimum(along, 2), np.minimum(out, 2), np.minimum(along_back, 2), np.minimum(out_back, 2),
        _held(hulls, here, samples.points[there]), _held(hulls, there, samples.points[here]),
        (parts.shape[here] == parts.shape[there]).astype(np.float64),
        np.minimum(gap / 0.005, 2),
        np.abs(np.einsum("nk,nk->n", way, hulls.axis[here])), np.abs(np.einsum("nk,nk->n", way, hulls.axis[there])),
        np.log1p(far / size[here]),
        np.log(hulls.radius[there] / hulls.radius[here]), np.log(hulls.half[there] / hulls.half[here]),
        hulls.round[here], hulls.round[there],
    )  # fmt: skip
    rows: Floats = np.clip(np.column_stack(columns), -8, 8)
    return rows


def _places(parts: Parts, hulls: _Hulls, here: Ints, there: Ints, sides: Floats) -> Floats:
    n = parts.n_parts
    degree = np.bincount(here, minlength=n)
    # How many of my shape does the same neighbour have? Eight bolts around one flange.
    key = there.astype(np.int64) * (int(parts.shape.max(initial=0)) + 1) + parts.shape[here]
    _, inverse, count = np.unique(key, return_inverse=True, return_counts=True)
    alike = np.zeros(n)
    np.maximum.at(alike, here, count[inverse.reshape(-1)] if len(here) else np.zeros(0))
    repeats = np.bincount(parts.shape)[parts.shape] if n else np.zeros(0)
    held, touching = np.zeros(n), np.zeros(n)
    np.maximum.at(held, here, sides[:, SIDE_FEATURES.index("is held")])
    np.add.at(touching, here, sides[:, SIDE_FEATURES.index("same shape")])
    return np.column_stack(
        [np.log1p(degree), np.log1p(alike), np.log1p(repeats) / 2, held, hulls.round, np.log1p(touching)]
    )
