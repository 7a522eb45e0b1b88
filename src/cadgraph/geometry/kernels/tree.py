"""Box trees over the faces of all meshes, in flat arrays.

The faces of a mesh are halved along their longest side again and again (``split``); eight make a leaf, and the leaves
an implicit binary tree in heap order: the children of node ``k`` are ``2 k + 1`` and ``2 k + 2``, the last half are
leaves. A box is a centre and half extents in float32, relative to the centre of the mesh and rounded so that it never
loses anything: 6 bytes a triangle for the boxes, 12 for the sorted faces.

Long things that lie askew would fill none of their upright boxes, so such a mesh gets boxes along its own axes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from cadgraph.geometry.kernels.borrow import borrow
from cadgraph.geometry.kernels.frame import across
from cadgraph.geometry.kernels.parallel import compiled, for_ranges
from cadgraph.geometry.kernels.split import INDEX, MAX_FACES, halve, record
from cadgraph.model.scene import Faces, Floats, Ints, Scene

__all__ = ["LEAF", "Forest", "build_forest", "first_face", "first_leaf"]

LEAF = 8
"""Faces in a leaf."""

_ASKEW = 0.6
# A mesh gets boxes along its own axes if that shrinks the surface of its box at least to this share.

_SAMPLES = 256  # vertices looked at to find a mesh's own axes

Nodes = npt.NDArray[np.float32]
Bools = npt.NDArray[np.bool_]


@dataclass(frozen=True)
class Forest:
    """A box tree for each mesh.

    Args:
        vertices: ``(n_vertices, 3)`` as in the scene [m].
        vertex_offsets: ``(n + 1,)`` as in the scene.
        faces: ``(n_faces, 3)`` int32 local to the mesh, in the order of the leaves; after the valid faces of a mesh
            unused rows may follow.
        face_offsets: ``(n + 1,)`` as in the scene.
        counts: ``(n,)`` valid faces: finite corners that exist.
        nodes: ``(n_nodes, 6)`` float32: centre and half extents in the mesh's own axes about its centre [m].
        node_offsets: ``(n + 1,)``; the root of mesh ``i`` is ``nodes[node_offsets[i]]``.
        centers: ``(n, 3)`` origin of the boxes [m].
        axes: ``(n, 3, 3)`` their unit axes as rows.
        upright: ``(n,)`` whether these are the world's axes.
        boxes: ``(n, 2, 3)`` exact least and greatest corner [m]; NaN for a mesh without valid faces.
    """

    vertices: Floats
    vertex_offsets: Ints
    faces: Faces
    face_offsets: Ints
    counts: Ints
    nodes: Nodes
    node_offsets: Ints
    centers: Floats
    axes: Floats
    upright: Bools
    boxes: Floats

    @property
    def n_trees(self) -> int:
        """How many trees there are, empty ones included."""
        return len(self.counts)


def build_forest(scene: Scene, workers: int | None = None) -> Forest:
    """Builds the trees of all meshes.

    Faces with a corner that is not finite or does not exist are left out. Faces without area stay, as the segment
    or point that they are.

    Args:
        scene: all meshes.
        workers: threads; all processors by default. The outcome does not depend on it.

    Raises:
        ValueError: ``workers`` is below 1, or a mesh has more than ``MAX_FACES`` faces.
    """
    n = scene.n_meshes
    n_faces = np.diff(scene.face_offsets)
    if n and n_faces.max() > MAX_FACES:
        raise ValueError(f"a mesh has {n_faces.max()} faces, {MAX_FACES} can be handled; split it")
    leaves = -(-n_faces // LEAF)
    node_offsets = np.zeros(n + 1, np.int64)
    np.cumsum(np.maximum(2 * leaves - 1, 0), out=node_offsets[1:])
    faces = np.ascontiguousarray(scene.placed_faces(), np.int32)
    forest = Forest(
        vertices=np.ascontiguousarray(scene.placed_vertices(), np.float64),
        vertex_offsets=np.ascontiguousarray(scene.vertex_offsets, np.int64),
        faces=np.empty((len(faces), 3), np.int32),
        face_offsets=np.ascontiguousarray(scene.face_offsets, np.int64),
        counts=np.zeros(n, np.int64),
        nodes=np.empty((int(node_offsets[-1]), 6), np.float32),
        node_offsets=node_offsets,
        centers=np.zeros((n, 3)),
        axes=np.tile(np.eye(3), (n, 1, 1)),
        upright=np.ones(n, np.bool_),
        boxes=np.full((n, 2, 3), np.nan),
    )

    def build(first: int, last: int) -> None:
        _build_trees(
            first,
            last,
            forest.vertices,
            forest.vertex_offsets,
            faces,
            forest.face_offsets,
            forest.faces,
            forest.counts,
            forest.nodes,
            forest.node_offsets,
            forest.centers,
            forest.axes,
            forest.upright,
            forest.boxes,
        )

    for_ranges(build, n_faces, workers)
    return forest


@compiled
def first_leaf(n_leaves: int) -> int:
    """The node of the leaf with the first faces: leaves fill the deepest level, then what is left of the one above."""
    deepest = 1
    while deepest < 2 * n_leaves:
        deepest *= 2
    return deepest // 2 - 1


@compiled
def first_face(node: int, n_leaves: int) -> int:
    """The position of a leaf's first face among those of its tree."""
    rank = node - first_leaf(n_leaves)
    return LEAF * (rank if rank >= 0 else rank + n_leaves)


@compiled
def _build_trees(
    first: int,
    last: int,
    vertices: Floats,
    vertex_offsets: Ints,
    faces: Faces,
    face_offsets: Ints,
    sorted_faces: Faces,
    counts: Ints,
    nodes: Nodes,
    node_offsets: Ints,
    centers: Floats,
    axes: Floats,
    upright: Bools,
    boxes: Floats,
) -> None:
    largest = 0
    for mesh in range(first, last):
        largest = max(largest, face_offsets[mesh + 1] - face_offsets[mesh])
    keys = np.empty(largest, np.uint64)
    for mesh in range(first, last):
        _build_tree(
            mesh, vertices, vertex_offsets, faces, face_offsets, sorted_faces, counts, nodes, node_offsets, centers,
            axes, upright, boxes, keys,
        )  # fmt: skip


@compiled
def _build_tree(
    mesh: int,
    vertices: Floats,
    vertex_offsets: Ints,
    faces: Faces,
    face_offsets: Ints,
    sorted_faces: Faces,
    counts: Ints,
    nodes: Nodes,
    node_offsets: Ints,
    centers: Floats,
    axes: Floats,
    upright: Bools,
    boxes: Floats,
    keys: npt.NDArray[np.uint64],
) -> None:
    vertices, faces, sorted_faces, nodes = borrow(vertices), borrow(faces), borrow(sorted_faces), borrow(nodes)
    keys = borrow(keys)
    v0, v1 = vertex_offsets[mesh], vertex_offsets[mesh + 1]
    f0, f1 = face_offsets[mesh], face_offsets[mesh + 1]
    box, center, own = borrow(boxes)[mesh], borrow(centers)[mesh], borrow(axes)[mesh]
    n = _collect(vertices, v0, v1, faces, f0, f1, keys, box)
    counts[mesh] = n
    if n == 0:
        return
    for k in range(3):
        center[k] = 0.5 * (box[0, k] + box[1, k])
    is_upright = not _own_axes(vertices, v0, faces, f0, keys, n, box, center, own)
    upright[mesh] = is_upright
    _sort_faces(vertices, v0, faces, f0, keys, n, box, center, own, is_upright, sorted_faces)
    _fill_nodes(vertices, v0, sorted_faces, f0, n, center, own, is_upright, nodes, node_offsets[mesh])


@compiled
def _collect(
    vertices: Floats,
    v0: int,
    v1: int,
    faces: Faces,
    f0: int,
    f1: int,
    keys: npt.NDArray[np.uint64],
    box: Floats,
) -> int:
    """Writes the indices of the valid faces and their box; returns how many there are."""
    n = 0
    n_vertices = v1 - v0
    x0 = y0 = z0 = np.inf
    x1 = y1 = z1 = -np.inf
    for f in range(f0, f1):
        a, b, c = faces[f, 0], faces[f, 1], faces[f, 2]
        if min(a, b, c) < 0 or max(a, b, c) >= n_vertices:
            continue
        ax, ay, az = vertices[v0 + a, 0], vertices[v0 + a, 1], vertices[v0 + a, 2]
        bx, by, bz = vertices[v0 + b, 0], vertices[v0 + b, 1], vertices[v0 + b, 2]
        cx, cy, cz = vertices[v0 + c, 0], vertices[v0 + c, 1], vertices[v0 + c, 2]
        total = abs(ax) + abs(ay) + abs(az) + abs(bx) + abs(by) + abs(bz) + abs(cx) + abs(cy) + abs(cz)
        if not total < np.inf:
            continue
        x0, y0, z0 = min(x0, ax, bx, cx), min(y0, ay, by, cy), min(z0, az, bz, cz)
        x1, y1, z1 = max(x1, ax, bx, cx), max(y1, ay, by, cy), max(z1, az, bz, cz)
        keys[n] = np.uint64(f - f0)
        n += 1
    if n > 0:
        box[0, 0], box[0, 1], box[0, 2] = x0, y0, z0
        box[1, 0], box[1, 1], box[1, 2] = x1, y1, z1
    return n


@compiled
def _own_axes(
    vertices: Floats,
    v0: int,
    faces: Faces,
    f0: int,
    keys: npt.NDArray[np.uint64],
    n: int,
    box: Floats,
    center: Floats,
    axes: Floats,
) -> bool:
    """Finds axes that suit a mesh much better than the world's, if there are any; the identity stays otherwise."""
    h0, h1, h2 = box[1, 0] - box[0, 0], box[1, 1] - box[0, 1], box[1, 2] - box[0, 2]
    if not h0 * h1 + h1 * h2 + h2 * h0 > 0.0:
        return False
    spread = np.zeros((3, 3))
    step = max(1, n // _SAMPLES)
    _covariance(vertices, v0, faces, f0, keys, n, step, center, spread)
    found, low, high = np.empty((3, 3)), np.empty(3), np.empty(3)
    if not _principal_axes(spread, found):
        return False
    # a look at the sample first; all faces only where it promises something
    for stride in (step, 1):
        for k in range(3):
            low[k], high[k] = np.inf, -np.inf
        for i in range(0, n, stride):
            f = f0 + np.int64(keys[i])
            for corner in range(3):
                v = v0 + faces[f, corner]
                x, y, z = vertices[v, 0] - center[0], vertices[v, 1] - center[1], vertices[v, 2] - center[2]
                for k in range(3):
                    at = found[k, 0] * x + found[k, 1] * y + found[k, 2] * z
                    low[k] = min(low[k], at)
                    high[k] = max(high[k], at)
        g0, g1, g2 = high[0] - low[0], high[1] - low[1], high[2] - low[2]
        if g0 * g1 + g1 * g2 + g2 * g0 > _ASKEW * (h0 * h1 + h1 * h2 + h2 * h0):
            return False
        if step == 1:
            break
    for k in range(3):
        for m in range(3):
            axes[k, m] = found[k, m]
    return True


@compiled
def _covariance(
    vertices: Floats,
    v0: int,
    faces: Faces,
    f0: int,
    keys: npt.NDArray[np.uint64],
    n: int,
    step: int,
    center: Floats,
    spread: Floats,
) -> None:
    """The covariance of sampled corners, scaled so that its trace is 1."""
    sx = sy = sz = xx = xy = xz = yy = yz = zz = 0.0
    count = 0
    for i in range(0, n, step):
        f = f0 + np.int64(keys[i])
        for corner in range(3):
            v = v0 + faces[f, corner]
            x, y, z = vertices[v, 0] - center[0], vertices[v, 1] - center[1], vertices[v, 2] - center[2]
            sx, sy, sz = sx + x, sy + y, sz + z
            xx, xy, xz, yy, yz, zz = xx + x * x, xy + x * y, xz + x * z, yy + y * y, yz + y * z, zz + z * z
            count += 1
    xx, yy, zz = xx - sx * sx / count, yy - sy * sy / count, zz - sz * sz / count
    xy, xz, yz = xy - sx * sy / count, xz - sx * sz / count, yz - sy * sz / count
    trace = xx + yy + zz
    if trace <= 0.0:
        return
    spread[0, 0], spread[1, 1], spread[2, 2] = xx / trace, yy / trace, zz / trace
    spread[0, 1] = spread[1, 0] = xy / trace
    spread[0, 2] = spread[2, 0] = xz / trace
    spread[1, 2] = spread[2, 1] = yz / trace


@compiled
def _principal_axes(spread: Floats, axes: Floats) -> bool:
    """The axis of greatest spread, and the two of most and least spread across it, as rows; False if there is none."""
    power, square = np.empty((3, 3)), np.empty((3, 3))
    for i in range(3):
        for j in range(3):
            power[i, j] = spread[i, j]
    for _ in range(5):  # the 32nd power leaves the greatest alone
        trace = 0.0
        for i in range(3):
            for j in range(3):
                square[i, j] = power[i, 0] * power[0, j] + power[i, 1] * power[1, j] + power[i, 2] * power[2, j]
            trace += square[i, i]
        if not trace > 0.0:
            return False
        for i in range(3):
            for j in range(3):
                power[i, j] = square[i, j] / trace
    k = 0
    for i in range(1, 3):
        if power[i, i] > power[k, k]:
            k = i
    ux, uy, uz = power[0, k], power[1, k], power[2, k]
    length = np.sqrt(ux * ux + uy * uy + uz * uz)
    if not length > 0.0:
        return False
    ux, uy, uz = ux / length, uy / length, uz / length
    # any direction across, then turned to the greatest spread
    v, w = across(ux, uy, uz)
    vv = vw = ww = 0.0
    for i in range(3):
        for j in range(3):
            vv += v[i] * spread[i, j] * v[j]
            vw += v[i] * spread[i, j] * w[j]
            ww += w[i] * spread[i, j] * w[j]
    angle = 0.5 * np.arctan2(2 * vw, vv - ww)
    c, s = np.cos(angle), np.sin(angle)
    axes[0, 0], axes[0, 1], axes[0, 2] = ux, uy, uz
    for i in range(3):
        axes[1, i] = c * v[i] + s * w[i]
        axes[2, i] = c * w[i] - s * v[i]
    return True


@compiled
def _middle(
    vertices: Floats, v0: int, faces: Faces, f: int, center: Floats, axes: Floats, is_upright: bool
) -> tuple[float, float, float]:
    """The middle of a face's box from the mesh's centre, in its own axes: the same for both halves of a rectangle."""
    a, b, c = v0 + faces[f, 0], v0 + faces[f, 1], v0 + faces[f, 2]
    p, q, r = vertices[a, 0], vertices[b, 0], vertices[c, 0]
    x = 0.5 * (min(p, q, r) + max(p, q, r)) - center[0]
    p, q, r = vertices[a, 1], vertices[b, 1], vertices[c, 1]
    y = 0.5 * (min(p, q, r) + max(p, q, r)) - center[1]
    p, q, r = vertices[a, 2], vertices[b, 2], vertices[c, 2]
    z = 0.5 * (min(p, q, r) + max(p, q, r)) - center[2]
    if is_upright:
        return x, y, z
    return (
        axes[0, 0] * x + axes[0, 1] * y + axes[0, 2] * z,
        axes[1, 0] * x + axes[1, 1] * y + axes[1, 2] * z,
        axes[2, 0] * x + axes[2, 1] * y + axes[2, 2] * z,
    )


@compiled
def _sort_faces(
    vertices: Floats,
    v0: int,
    faces: Faces,
    f0: int,
    keys: npt.NDArray[np.uint64],
    n: int,
    box: Floats,
    center: Floats,
    axes: Floats,
    is_upright: bool,
    sorted_faces: Faces,
) -> None:
    """Writes the faces in the order of the leaves."""
    if n > LEAF:
        low, extents = np.empty(3), np.empty(3)
        half = 0.0
        for k in range(3):
            low[k], extents[k] = box[0, k] - center[k], box[1, k] - box[0, k]
            half += extents[k] * extents[k]
        if not is_upright:
            # the diagonal covers any turn; a finer grid is not worth a pass
            half = 0.5 * np.sqrt(half)
            for k in range(3):
                low[k], extents[k] = -half, 2.0 * half
        for i in range(n):
            f = int(keys[i])
            x, y, z = _middle(vertices, v0, faces, f0 + f, center, axes, is_upright)
            keys[i] = record(f, x, y, z, low, extents)
        halve(keys, n, extents, LEAF)
    for i in range(n):
        f = f0 + int(keys[i] & INDEX)
        for k in range(3):
            sorted_faces[f0 + i, k] = faces[f, k]


@compiled
def _put_box(nodes: Nodes, at: int, x0: float, x1: float, y0: float, y1: float, z0: float, z1: float) -> None:
    """Stores a box as centre and half extents, rounded outwards."""
    for k in range(3):
        low = x0 if k == 0 else (y0 if k == 1 else z0)
        high = x1 if k == 0 else (y1 if k == 1 else z1)
        middle = np.float32(0.5 * (low + high))
        nodes[at, k] = middle
        # float32 rounds by up to 6e-8 of the value
        half = max(high - middle, middle - low)
        nodes[at, 3 + k] = np.float32(half * (1.0 + 2.5e-7) + 1e-37)


@compiled
def _fill_nodes(
    vertices: Floats,
    v0: int,
    faces: Faces,
    f0: int,
    n: int,
    center: Floats,
    axes: Floats,
    is_upright: bool,
    nodes: Nodes,
    base: int,
) -> None:
    """Boxes of the leaves from their faces, then of the rest from their children."""
    n_leaves = (n + LEAF - 1) // LEAF
    cx, cy, cz = center[0], center[1], center[2]
    for leaf in range(n_leaves - 1, 2 * n_leaves - 1):
        start = first_face(leaf, n_leaves)
        x0 = y0 = z0 = np.inf
        x1 = y1 = z1 = -np.inf
        for f in range(f0 + start, f0 + min(start + LEAF, n)):
            for corner in range(3):
                v = v0 + faces[f, corner]
                x, y, z = vertices[v, 0] - cx, vertices[v, 1] - cy, vertices[v, 2] - cz
                if not is_upright:
                    x, y, z = (
                        axes[0, 0] * x + axes[0, 1] * y + axes[0, 2] * z,
                        axes[1, 0] * x + axes[1, 1] * y + axes[1, 2] * z,
                        axes[2, 0] * x + axes[2, 1] * y + axes[2, 2] * z,
                    )
                x0, y0, z0 = min(x0, x), min(y0, y), min(z0, z)
                x1, y1, z1 = max(x1, x), max(y1, y), max(z1, z)
        _put_box(nodes, base + leaf, x0, x1, y0, y1, z0, z1)
    for node in range(n_leaves - 2, -1, -1):
        a, b = base + 2 * node + 1, base + 2 * node + 2
        _put_box(
            nodes,
            base + node,
            min(np.float64(nodes[a, 0]) - nodes[a, 3], np.float64(nodes[b, 0]) - nodes[b, 3]),
            max(np.float64(nodes[a, 0]) + nodes[a, 3], np.float64(nodes[b, 0]) + nodes[b, 3]),
            min(np.float64(nodes[a, 1]) - nodes[a, 4], np.float64(nodes[b, 1]) - nodes[b, 4]),
            max(np.float64(nodes[a, 1]) + nodes[a, 4], np.float64(nodes[b, 1]) + nodes[b, 4]),
            min(np.float64(nodes[a, 2]) - nodes[a, 5], np.float64(nodes[b, 2]) - nodes[b, 5]),
            max(np.float64(nodes[a, 2]) + nodes[a, 5], np.float64(nodes[b, 2]) + nodes[b, 5]),
        )
