"""Which meshes are the same part in another place: ids of equal shape, verified exactly."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadgraph.geometry.kernels.parallel import compiled, for_ranges, readable
from cadgraph.geometry.mesh.weld import weld_range
from cadgraph.geometry.shape.alignment import align_by_order, align_sets, count_cells, pick_anchors
from cadgraph.model.parts import Bools, Properties
from cadgraph.model.scene import Faces, Floats, Ints, Placement, Scene

__all__ = ["Shapes", "find_shapes", "position_tolerance"]

# Counterparts may be this far apart: an absolute share [m], one of the mesh's size, and one of its distance from the
# scene's origin. Ours: positions stored as float32 are off by 1e-7 of their magnitude, twice over for two meshes,
# and the vertices that fix the motion pass their error on.
_ABSOLUTE = 1e-7
_OF_SIZE = 1e-6
_OF_MAGNITUDE = 4e-7

# Invariants may differ by this share of the size, and by so many tolerances, before meshes are compared at all.
# Only speed depends on it: whatever is grouped is still verified.
_LOOSE = 1e-4
_LOOSE_TOLERANCES = 4.0


@dataclass(frozen=True)
class Shapes:
    """The distinct shapes of a scene and where each is repeated.

    Two meshes have the same shape where a rigid motion takes the vertices of one to those of the other, in any
    order, and their surfaces run alike through them. A mirror image that no rigid motion reaches is a shape of its
    own, which refers to the shape that it mirrors. Meshes without area or with non-finite vertices have a shape each.

    Args:
        shape: ``(n_meshes,)`` id, ``0..n_shapes - 1`` in order of first occurrence.
        mirrored: ``(n_meshes,)`` whether the shape is the mirror image of one that occurs earlier.
        first: ``(n_shapes,)`` the first mesh of each shape.
        mirror_of: ``(n_shapes,)`` the earlier shape that it is the mirror image of, or -1.
        turn: ``(n_meshes, 3, 3)`` rotation from the first mesh of its shape to the mesh.
        shift: ``(n_meshes, 3)`` translation [m]: a point ``x`` of the first mesh lies at ``turn @ x + shift``.
    """

    shape: Ints
    mirrored: Bools
    first: Ints
    mirror_of: Ints
    turn: Floats
    shift: Floats

    @property
    def n_shapes(self) -> int:
        """How many distinct shapes there are."""
        return len(self.first)


def position_tolerance(properties: Properties) -> Floats:
    """``(n,)`` how far apart positions of each mesh may be and still count as equal [m]."""
    with np.errstate(invalid="ignore"):
        magnitude = np.nan_to_num(np.abs(properties.aabb).max(axis=(1, 2), initial=0.0))
    tolerance: Floats = _ABSOLUTE + _OF_SIZE * properties.obb_extents[:, 0] + _OF_MAGNITUDE * magnitude
    return tolerance


def find_shapes(scene: Scene, properties: Properties, workers: int | None = None) -> Shapes:
    """Finds the meshes of equal shape.

    Meshes of like invariants (triangle count, area, volume, principal moments) are compared with the first of them:
    vertex by vertex in the order given, then as sets. Those that differ form the next round.

    Args:
        scene: any.
        properties: of its meshes.
        workers: threads; all processors by default. The outcome does not depend on it.

    Returns:
        The shapes. Of meshes that share one in the scene already, only the first is compared.
    """
    if scene.placement is not None:
        return _of_shared(scene, scene.placement, properties, workers)
    n = scene.n_meshes
    tolerance = position_tolerance(properties)
    looks, slack = _looks(properties, tolerance)
    bucket = _buckets(properties, looks, slack)
    first = np.full(n, -1, np.int64)
    mirrors = np.full(n, -1, np.int64)
    turn = np.tile(np.eye(3), (n, 1, 1))
    shift = np.zeros((n, 3))
    kernels = _Kernels(scene, properties, tolerance, _largest_of(bucket, tolerance), workers)
    open_meshes = np.arange(n)
    while len(open_meshes):
        _, at, group = np.unique(bucket[open_meshes], return_index=True, return_inverse=True)
        heads = open_meshes[at][group]
        first[open_meshes[at]] = open_meshes[at]
        rest = open_meshes != heads
        pairs = np.column_stack([heads[rest], open_meshes[rest]])
        alike = np.all(
            np.abs(looks[pairs[:, 0]] - looks[pairs[:, 1]])
            <= np.maximum(slack[pairs[:, 0]], slack[pairs[:, 1]])[:, None],
            axis=1,
        )
        sense = np.zeros(len(pairs), np.int64)
        sense[alike], turns, shifts = kernels.compare(pairs[alike])
        same = pairs[sense == 1]
        first[same[:, 1]] = same[:, 0]
        turn[same[:, 1]], shift[same[:, 1]] = turns[sense[alike] == 1], shifts[sense[alike] == 1]
        mirror = pairs[(sense == -1)]
        mirror = mirror[mirrors[mirror[:, 1]] < 0]
        mirrors[mirror[:, 1]] = mirror[:, 0]
        open_meshes = pairs[sense != 1, 1]
    return _number(first, mirrors, turn, shift)


def _of_shared(scene: Scene, placement: Placement, properties: Properties, workers: int | None) -> Shapes:
    heads, row = np.unique(placement.shape, return_index=True, return_inverse=True)[1:]
    order = np.argsort(heads)
    heads, row = heads[order], np.argsort(order)[row.reshape(-1)]
    alone = scene.select(heads)
    among = find_shapes(alone.with_vertices(alone.vertices), properties.select(heads), workers)
    # For column vectors: from the first mesh of a shape in the scene to the mesh, after what leads to that.
    head = heads[row]
    turn = placement.turn.transpose(0, 2, 1) @ placement.turn[head]
    shift = placement.shift - np.einsum("nij,nj->ni", turn, placement.shift[head])
    shift += np.einsum("nij,nj->ni", turn, among.shift[row])
    return Shapes(
        among.shape[row], among.mirrored[row], heads[among.first], among.mirror_of, turn @ among.turn[row], shift
    )


def _number(first: Ints, mirrors: Ints, turn: Floats, shift: Floats) -> Shapes:
    heads, shape = np.unique(first, return_inverse=True)
    shape = shape.reshape(-1).astype(np.int64)
    mirrored_head = mirrors[heads]
    mirror_of = np.where(mirrored_head >= 0, shape[mirrored_head] if len(shape) else -1, -1).astype(np.int64)
    return Shapes(shape, (mirror_of >= 0)[shape], heads, mirror_of, turn, shift)


def _looks(properties: Properties, tolerance: Floats) -> tuple[Floats, Floats]:
    """Lengths that no rigid motion changes ``(n, 5)`` [m], and how much they may differ ``(n,)`` [m]."""
    area = properties.area
    inside = np.where(area > 0, area, 1.0)
    moments = np.linalg.eigvalsh(properties.inertia)
    # Of the inertia's eigenvalues to second moments along the axes.
    spread = np.maximum(moments.sum(axis=1, keepdims=True) / 2 - moments, 0.0)
    looks = np.column_stack([np.sqrt(area), np.sqrt(spread / inside[:, None]), np.abs(properties.volume) / inside])
    return looks, _LOOSE * np.sqrt(area) + _LOOSE_TOLERANCES * tolerance


def _buckets(properties: Properties, looks: Floats, slack: Floats) -> Ints:
    """``(n,)`` group of meshes whose invariants chain together; those that can't repeat are alone."""
    n = len(looks)
    _, bucket = np.unique(properties.n_triangles, return_inverse=True)
    bucket = bucket.reshape(-1)
    single = (properties.area <= 0) | (properties.n_nonfinite > 0)
    bucket[single] = n + np.arange(n)[single]
    n_buckets = -1
    while len(np.unique(bucket)) != n_buckets:
        n_buckets = len(np.unique(bucket))
        for column in looks.T:
            order = np.lexsort((column, bucket))
            new = np.ones(n, np.bool_)
            near = np.diff(column[order]) <= np.maximum(slack[order[1:]], slack[order[:-1]])
            new[1:] = ~(near & (np.diff(bucket[order]) == 0))
            bucket[order] = np.cumsum(new)
    return bucket.astype(np.int64)


def _largest_of(bucket: Ints, values: Floats) -> Floats:
    """``(n,)`` the largest of the values in the bucket of each."""
    largest = np.zeros(int(bucket.max(initial=-1)) + 1)
    np.maximum.at(largest, bucket, values)
    return largest[bucket]


class _Kernels:
    """Compares pairs of meshes of one scene; welds each mesh at most once.

    Args:
        scene: any.
        properties: of its meshes.
        tolerance: ``(n,)`` how far apart positions of each mesh may be and still count as equal [m].
        weld: ``(n,)`` the same where corners of one mesh are joined; of meshes that are compared with each other, even
            if one of them lies farther from the origin, so that details finer than its digits vanish from both.
        workers: threads.
    """

    def __init__(
        self, scene: Scene, properties: Properties, tolerance: Floats, weld: Floats, workers: int | None
    ) -> None:
        self.vertices, self.faces = readable(scene.vertices, np.float64), readable(scene.faces, np.int32)
        self.v_offsets, self.f_offsets = (
            readable(scene.vertex_offsets, np.int64),
            readable(scene.face_offsets, np.int64),
        )
        self.centroid, self.tolerance = readable(properties.centroid, np.float64), readable(tolerance, np.float64)
        self.weld = readable(weld, np.float64)
        self.workers = workers
        self.n_spots = np.full(scene.n_meshes, -1, np.int64)
        self.spots = np.empty((0, 3))
        self.normals = np.empty((0, 3))
        self.reach = np.empty((0, 2))

    def compare(self, pairs: Ints) -> tuple[Ints, Floats, Floats]:
        """Sense (1, -1 mirrored, 0 different), rotation and translation of each pair."""
        sense = np.zeros(len(pairs), np.int64)
        turn, shift = np.zeros((len(pairs), 3, 3)), np.zeros((len(pairs), 3))
        if not len(pairs):
            return sense, turn, shift
        heads, head_of_pair = np.unique(pairs[:, 0], return_inverse=True)
        head_of_pair = head_of_pair.reshape(-1)
        weights = np.diff(self.v_offsets)[pairs[:, 1]]
        anchors = np.zeros((len(heads), 3), np.int64)

        def anchor(low: int, high: int) -> None:
            _anchor_range(self.vertices, self.v_offsets, heads, low, high, anchors)

        def by_order(low: int, high: int) -> None:
            _order_range(
                self.vertices, self.faces, self.v_offsets, self.f_offsets, self.tolerance,
                pairs, head_of_pair, anchors, low, high, sense, turn, shift,
            )  # fmt: skip

        for_ranges(anchor, np.diff(self.v_offsets)[heads], self.workers)
        for_ranges(by_order, weights, self.workers)
        left = np.flatnonzero(sense != 1)
        if len(left):
            self._weld(np.unique(pairs[left]))

            def by_set(low: int, high: int) -> None:
                _set_range(
                    self.spots, self.normals, self.reach, self.v_offsets, self.n_spots, self.tolerance, self.centroid,
                    pairs, left, low, high, sense, turn, shift,
                )  # fmt: skip

            for_ranges(by_set, weights[left], self.workers)
        return sense, turn, shift

    def _weld(self, meshes: Ints) -> None:
        meshes = meshes[self.n_spots[meshes] < 0]
        if not len(self.spots):
            self.spots, self.normals = np.empty_like(self.vertices), np.empty_like(self.vertices)
            self.reach = np.empty((len(self.vertices), 2))

        def weld_these(low: int, high: int) -> None:
            weld_range(
                self.vertices, self.faces, self.v_offsets, self.f_offsets, self.centroid, self.weld,
                meshes, low, high, self.spots, self.normals, self.reach, self.n_spots,
            )  # fmt: skip

        for_ranges(weld_these, np.diff(self.f_offsets)[meshes], self.workers)


@compiled
def _anchor_range(vertices: Floats, v_offsets: Ints, heads: Ints, low: int, high: int, anchors: Ints) -> None:
    for k in range(low, high):
        i = heads[k]
        pick_anchors(vertices, v_offsets[i], v_offsets[i + 1], k, anchors)


@compiled
def _order_range(
    vertices: Floats, faces: Faces, v_offsets: Ints, f_offsets: Ints, tolerance: Floats,
    pairs: Ints, head_of_pair: Ints, anchors: Ints, low: int, high: int, sense: Ints, turn: Floats, shift: Floats,
) -> None:  # fmt: skip
    frame_a, frame_b = np.empty((3, 3)), np.empty((3, 3))
    for k in range(low, high):
        i, j = pairs[k, 0], pairs[k, 1]
        a, b, fa, fb = v_offsets[i], v_offsets[j], f_offsets[i], f_offsets[j]
        n, m = v_offsets[i + 1] - a, f_offsets[i + 1] - fa
        sense[k] = 0
        if n == v_offsets[j + 1] - b and m == f_offsets[j + 1] - fb:
            sense[k] = align_by_order(
                vertices, a, b, n, faces, fa, fb, m, anchors, head_of_pair[k], max(tolerance[i], tolerance[j]),
                frame_a, frame_b, turn[k], shift[k],
            )  # fmt: skip


@compiled
def _set_range(
    spots: Floats, normals: Floats, reach: Floats, v_offsets: Ints, n_spots: Ints, tolerance: Floats,
    centroid: Floats, pairs: Ints, left: Ints, low: int, high: int, sense: Ints, turn: Floats, shift: Floats,
) -> None:  # fmt: skip
    n_most = 1
    for at in range(low, high):
        n_most = max(n_most, n_spots[pairs[left[at], 0]])
    rows, spare, work = np.empty((n_most, 2)), np.empty((n_most, 2)), np.empty((4, n_most), np.int64)
    starts = np.empty(count_cells(n_most) + 1, np.int64)
    frame_a, frame_b, grid = np.empty((3, 3)), np.empty((3, 3)), np.empty((3, 3))
    for at in range(low, high):
        k = left[at]
        i, j = pairs[k, 0], pairs[k, 1]
        n = n_spots[i]
        # As it is, then its mirror image; each by vertices with faces of like areas around them, which is fast, then by
        # all that are as far from the middle: diagonals of flat faces are no part of the shape.
        found = sense[k]
        if n > 0 and n == n_spots[j]:
            for attempt in range(4):
                if attempt == 2 and found == -1:
                    break
                if align_sets(
                    spots, normals, reach, v_offsets[i], v_offsets[j], n, max(tolerance[i], tolerance[j]),
                    1 if attempt < 2 else -1, attempt % 2 == 0,
                    rows, spare, work, starts, frame_a, frame_b, grid, turn[k],
                ):  # fmt: skip
                    found = 1 if attempt < 2 else -1
                    break
        sense[k] = found
        for r in range(3):
            shift[k, r] = centroid[j, r]
            for c in range(3):
                shift[k, r] -= turn[k, r, c] * centroid[i, c]
