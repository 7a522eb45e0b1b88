"""How parts stand to their neighbours, to what is up and to the whole scene.

Nothing here changes when a scene is moved, turned about the vertical or mirrored. Sizes are relative.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from cadgraph.geometry.kernels.parallel import compiled, for_ranges, readable
from cadgraph.geometry.mesh.pierce import Piercings
from cadgraph.labelers.embedded.descriptor import even_sides
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.scene import Floats, Ints
from cadgraph.model.shapes import ShapeAnalysis

__all__ = ["PLACE_FEATURES", "SCENE_FEATURES", "SIDE_FEATURES", "UP_FEATURES", "UP_SIDES", "Surroundings",
           "find_surroundings"]  # fmt: skip

_TINY = 1e-9
_SOFT = 0.03  # of a part's size: how far beyond its own cylinder something counts as held in part
_NEAR = 0.05  # of the smaller part's size, and 1 mm: how fast points count less away from the other's cylinder
_LOOSE = 3e-4  # m: a contact with such a gap is one of a plant whose joints are open

SIDE_FEATURES = (
    "size", "area", "parallel", "offset", "offset back", "ahead", "ahead back", "spot along", "spot out",
    "spot along back", "spot out back", "holds", "is held", "same shape", "gap", "way", "way back", "far", "radius",
    "length", "round", "round back", "above", "steep",
)  # fmt: skip
"""What is known of one neighbour as a part sees it. Lengths are relative to the part's, logarithmic if unbounded."""
UP_SIDES = ("above", "steep")
"""Of these, what depends on where up is."""

UP_FEATURES = ("upright", "box up 0", "box up 1", "box up 2", "tall", "height", "level", "top heavy", "borne")
"""What is known of how a part stands: cosines with the vertical of its axis and of the sides of its box, its height
over its size, over that of the scene, the height of its foot over that of the scene, where in its height its area lies,
and whether its neighbours are below or above."""
SCENE_FEATURES = ("joints open", "small repeats", "thin discs", "round shapes", "hollow", "detail", "neighbors of all")
"""What is known of the scene as a whole, the same for each of its parts: shares of contacts with a gap, of parts that
are small and repeat often (fasteners), of shapes that are thin discs (gaskets), of round ones, of these the hollow
ones; the mean logarithm of the number of corners around those; the mean number of neighbours."""
PLACE_FEATURES = (
    "neighbors", "alike around one", "alike in all", "held most", "round", "alike touching", "size among all",
    *UP_FEATURES, *SCENE_FEATURES,
)  # fmt: skip
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


def find_surroundings(parts: Parts, contacts: Contacts, known: ShapeAnalysis, points: Piercings) -> Surroundings:
    """Describes each part's neighbours; the ground is nobody's neighbour.

    Args:
        parts: with their geometry.
        contacts: pairs of parts that are adjacent.
        known: their distinct shapes, and where each occurs.
        points: on the surface of each distinct shape.
    """
    pairs = contacts.pairs
    kept = ~(parts.ground[pairs[:, 0]] | parts.ground[pairs[:, 1]]) if len(pairs) else np.zeros(0, np.bool_)
    pairs, gap = pairs[kept], contacts.distance[kept]
    here, there = np.concatenate([pairs[:, 0], pairs[:, 1]]), np.concatenate([pairs[:, 1], pairs[:, 0]])
    order = np.lexsort((there, here))
    back = np.empty(len(order), np.int64)
    back[order] = np.arange(len(order))
    # Both sides of a contact are half of all rows apart before sorting.
    reverse = back[(order + len(pairs)) % max(len(order), 1)]
    here, there, gap = here[order], there[order], np.tile(gap, 2)[order]
    hulls = _hulls(parts, known)
    sides = _sides(parts, known, hulls, points, here, there, gap, reverse)
    return Surroundings(here, there, sides, _places(parts, known, hulls, here, there, sides))


def _hulls(parts: Parts, known: ShapeAnalysis) -> _Hulls:
    properties = parts.properties.select(known.first)
    spread, vectors = np.linalg.eigh(properties.inertia)
    low, high = spread[:, 1] - spread[:, 0], spread[:, 2] - spread[:, 1]
    axis = np.where((high <= low)[:, None], vectors[:, :, 0], vectors[:, :, 2])
    # Bodies of revolution have an axis of their own, where moments that are alike have none.
    turned = np.array([f.round for f in known.facts], np.bool_)
    own = np.array([f.axis for f in known.facts]).reshape(-1, 3)
    axis = np.where(turned[:, None], own, axis)
    even = 1 - np.minimum(low, high) / np.maximum(spread[:, 2], 1e-30)
    n = len(known.first)
    half, radius = np.full(n, 1e-5), np.full(n, 1e-5)
    scene = parts.scene
    for k, mesh in enumerate(known.first.tolist()):
        apart = scene.mesh(mesh)[0] - properties.centroid[k]
        apart = apart[np.isfinite(apart).all(axis=1)]
        if len(apart):
            along = apart @ axis[k]
            half[k] = max(half[k], float(np.abs(along).max()))
            radius[k] = max(radius[k], float(np.sqrt(np.maximum((apart * apart).sum(axis=1) - along**2, 0)).max()))
    shape = known.shape
    return _Hulls(
        np.einsum("nij,nj->ni", known.turn, axis[shape]),
        np.einsum("nij,nj->ni", known.turn, properties.centroid[shape]) + known.shift,
        half[shape], radius[shape], even[shape],
    )  # fmt: skip


def _in_frame(hulls: _Hulls, rows: Ints, points: Floats) -> tuple[Floats, Floats]:
    """Distance along and from the axis of points ``(n, 3)``, over half length and radius."""
    apart = points - hulls.center[rows]
    along = np.einsum("nk,nk->n", apart, hulls.axis[rows])
    out = np.sqrt(np.maximum((apart * apart).sum(axis=1) - along**2, 0))
    return np.abs(along) / hulls.half[rows], out / hulls.radius[rows]


def _meet(known: ShapeAnalysis, hulls: _Hulls, points: Piercings, here: Ints, there: Ints, size: Floats) -> Floats:
    """What share of the neighbour lies within a part's cylinder; and where along and from its axis the neighbour is
    nearest, over its half length and radius: ``(n_sides, 3)``.
    """
    found = np.zeros((len(here), 3))
    turn, shift = known.turn[there], known.shift[there]
    # The part's axis and centre as the neighbour's shape has them.
    axis = readable(np.einsum("nij,ni->nj", turn, hulls.axis[here]), np.float64)
    center = readable(np.einsum("nij,ni->nj", turn, hulls.center[here] - shift), np.float64)
    given: Any = tuple(readable(values, np.float64) for values in (
        points.points, points.weights, hulls.half[here], hulls.radius[here], _SOFT * size[here],
        _NEAR * np.minimum(size[here], size[there]) + 1e-3,
    ))  # fmt: skip
    shape, offsets = readable(known.shape[there], np.int64), readable(points.offsets, np.int64)
    meet: Any = _meet_sides

    def kernel(first: int, last: int) -> None:
        meet(first, last, shape, offsets, axis, center, *given, found)

    for_ranges(kernel, np.diff(points.offsets)[known.shape[there]])
    return found


@compiled
def _meet_sides(
    first: int,
    last: int,
    shape: Ints,
    offsets: Ints,
    axis: Floats,
    center: Floats,
    points: Floats,
    weights: Floats,
    half: Floats,
    radius: Floats,
    soft: Floats,
    near: Floats,
    found: Floats,
) -> None:
    for s in range(first, last):
        whole, held, close, ahead, aside = 0.0, 0.0, 0.0, 0.0, 0.0
        for p in range(offsets[shape[s]], offsets[shape[s] + 1]):
            x, y, z = points[p, 0] - center[s, 0], points[p, 1] - center[s, 1], points[p, 2] - center[s, 2]
            along = abs(x * axis[s, 0] + y * axis[s, 1] + z * axis[s, 2])
            out = np.sqrt(max(x * x + y * y + z * z - along * along, 0.0))
            e, f = max(along - half[s], 0.0), max(out - radius[s], 0.0)
            excess = np.sqrt(e * e + f * f)
            w = weights[p]
            whole += w
            held += w * max(0.0, 1 - excess / soft[s])
            w *= np.exp(-min(excess / near[s], 500.0))
            close += w
            ahead += w * along
            aside += w * out
        if whole > 0:
            found[s, 0] = held / whole
        if close > 0:
            found[s, 1] = ahead / close / half[s]
            found[s, 2] = aside / close / radius[s]


def _sides(
    parts: Parts,
    known: ShapeAnalysis,
    hulls: _Hulls,
    points: Piercings,
    here: Ints,
    there: Ints,
    gap: Floats,
    reverse: Ints,
) -> Floats:
    if not len(here):
        return np.zeros((0, len(SIDE_FEATURES)))
    properties = parts.properties
    size = np.maximum(np.linalg.norm(properties.obb_extents, axis=1), 1e-5)
    area = np.maximum(properties.area, 1e-10)
    between = hulls.center[there] - hulls.center[here]
    far = np.linalg.norm(between, axis=1)
    way = between / np.maximum(far, _TINY)[:, None]
    ahead, offset = _in_frame(hulls, here, hulls.center[there])
    met = _meet(known, hulls, points, here, there, size)
    met[:, 1:] = np.minimum(met[:, 1:], 2)
    # A direction between centres that nearly coincide says nothing.
    sure = np.minimum(far / (0.02 * np.minimum(size[here], size[there])), 1.0)
    columns = (
        np.log(size[there] / size[here]),
        np.log(area[there] / area[here]) / 2,
        np.abs(np.einsum("nk,nk->n", hulls.axis[here], hulls.axis[there])),
        np.log1p(offset), np.log1p(offset)[reverse], np.log1p(ahead), np.log1p(ahead)[reverse],
        met[:, 1], met[:, 2], met[reverse, 1], met[reverse, 2],
        met[:, 0], met[reverse, 0],
        (parts.shape[here] == parts.shape[there]).astype(np.float64),
        np.minimum(gap / 0.005, 2),
        sure * np.abs(np.einsum("nk,nk->n", way, hulls.axis[here])),
        sure * np.abs(np.einsum("nk,nk->n", way, hulls.axis[there])),
        np.log1p(far / size[here]),
        np.log(hulls.radius[there] / hulls.radius[here]), np.log(hulls.half[there] / hulls.half[here]),
        hulls.round[here], hulls.round[there],
        sure * way[:, 2], np.abs(hulls.axis[there][:, 2]),
    )  # fmt: skip
    rows: Floats = np.clip(np.column_stack(columns), -8, 8)
    return rows


def _places(parts: Parts, known: ShapeAnalysis, hulls: _Hulls, here: Ints, there: Ints, sides: Floats) -> Floats:
    n = parts.n_parts
    degree = np.bincount(here, minlength=n)
    # How many of my shape does the same neighbour have? Eight bolts around one flange.
    key = there.astype(np.int64) * (int(parts.shape.max(initial=0)) + 1) + parts.shape[here]
    _, inverse, count = np.unique(key, return_inverse=True, return_counts=True)
    alike = np.zeros(n)
    np.maximum.at(alike, here, count[inverse.reshape(-1)] if len(here) else np.zeros(0))
    repeats = (np.bincount(parts.shape)[parts.shape] if n else np.zeros(0)).astype(np.float64)
    held, touching, above = np.zeros(n), np.zeros(n), np.zeros(n)
    np.maximum.at(held, here, sides[:, SIDE_FEATURES.index("is held")])
    np.add.at(touching, here, sides[:, SIDE_FEATURES.index("same shape")])
    np.add.at(above, here, sides[:, SIDE_FEATURES.index("above")])
    size = np.log(np.maximum(np.linalg.norm(parts.properties.obb_extents, axis=1), 1e-5))
    among = np.clip(size - np.median(size[~parts.ground]), -5, 5) if (~parts.ground).any() else np.zeros(n)
    return np.column_stack([
        np.log1p(degree), np.log1p(alike), np.log1p(repeats) / 2, held, hulls.round, np.log1p(touching), among,
        _stand(parts, hulls, above / np.maximum(degree, 1)),
        np.tile(_whole(parts, known, repeats, among, degree, sides), (n, 1)),
    ])  # fmt: skip


def _stand(parts: Parts, hulls: _Hulls, above: Floats) -> Floats:
    """How each part stands, ``(n_parts, len(UP_FEATURES))``."""
    p = parts.properties
    low, high = p.aabb[:, 0, 2], p.aabb[:, 1, 2]
    height = np.maximum(high - low, 1e-6)
    others = ~parts.ground
    floor = float(low[others].min()) if others.any() else 0.0
    whole = max(float(high[others].max()) - floor, 1e-6) if others.any() else 1.0
    return np.column_stack([
        np.abs(hulls.axis[:, 2]), even_sides(p.obb_axes[:, :, 2] ** 2, p.obb_extents),
        height / np.maximum(np.linalg.norm(p.obb_extents, axis=1), 1e-6),
        np.minimum(height / whole, 1.0), np.clip((low - floor) / whole, 0, 1),
        np.clip((p.centroid[:, 2] - (low + high) / 2) / height, -0.5, 0.5) * 4, above,
    ])  # fmt: skip


def _whole(parts: Parts, known: ShapeAnalysis, repeats: Floats, among: Floats, degree: Ints, sides: Floats) -> Floats:
    """What the scene as a whole is like, ``(len(SCENE_FEATURES),)``."""
    facts = known.facts
    turned = np.array([f.round for f in facts], np.bool_)
    thin = np.array([f.round and f.length < 0.2 * f.radius for f in facts], np.bool_)
    hollow = np.array([f.bore > 0 for f in facts], np.bool_)
    sides_around = np.array([np.log(max(f.sides, 4)) for f in facts])
    gaps = sides[:, SIDE_FEATURES.index("gap")]
    one = np.maximum(1, turned.sum())
    return np.array([
        float((gaps > _LOOSE / 0.005).mean()) if len(gaps) else 0.0,
        float(((repeats >= 8) & (among < -0.5)).mean()) if len(repeats) else 0.0,
        float(thin.mean()) if len(thin) else 0.0, float(turned.mean()) if len(turned) else 0.0,
        float((hollow & turned).sum() / one), float(sides_around[turned].sum() / one) - 2.0 if turned.any() else 0.0,
        float(np.log1p(degree.mean())) if len(degree) else 0.0,
    ])  # fmt: skip
