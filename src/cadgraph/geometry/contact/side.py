"""Meshes as the search kernels see them: a box tree, maybe turned into other axes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from cadgraph.geometry.kernels.parallel import compiled
from cadgraph.geometry.kernels.tree import LEAF, first_leaf
from cadgraph.geometry.kernels.triangle import prepare
from cadgraph.model.scene import Faces, Floats, Ints

__all__ = [
    "COUNT",
    "LEAVES",
    "NODE",
    "SIDE",
    "UPRIGHT",
    "WHOLE",
    "Nodes",
    "Placed",
    "lay_side",
    "load_leaf",
    "node_extent",
    "node_gap2",
    "node_girth",
    "node_middle2",
    "relate",
    "rows_gap2",
    "turn_side",
]

Nodes = npt.NDArray[np.float32]


class Placed(NamedTuple):
    """The box trees of all meshes where they are, as the kernels take them.

    Stored machine code of earlier versions names this class; by another name it could not even be read and discarded.

    Args:
        centers: ``(n, 3)`` origin of each tree's boxes [m].
        axes: ``(n, 3, 3)`` their axes, as rows.
        upright: ``(n,)`` whether these are the world's axes.
        vertices: as in ``Forest``, like all below.
        vertex_offsets: ditto.
        faces: ditto.
        face_offsets: ditto.
        counts: ditto.
        nodes: ditto.
        node_offsets: ditto.
    """

    centers: Floats
    axes: Floats
    upright: npt.NDArray[np.bool_]
    vertices: Floats
    vertex_offsets: Ints
    faces: Faces
    face_offsets: Ints
    counts: Ints
    nodes: Nodes
    node_offsets: Ints


# Kernels pass a mesh on as two small arrays. In numbers: rotation (3 rows), what to take off the vertices before it,
# what to add after (the centre of the boxes), box axes (3 rows). In whole numbers: first vertex, first face, faces,
# first node, leaves, turned, upright, first node of the deepest level.
SIDE = (8, 3)
V0, F0, COUNT, NODE, LEAVES, TURNED, UPRIGHT, DEEPEST = range(8)
WHOLE = 8


@compiled
def lay_side(meshes: Placed, mesh: int, origin: Floats, side: Floats, whole: Ints) -> None:
    """Writes what the kernels need of a mesh, relative to an origin."""
    for k in range(3):
        side[3, k] = origin[k]
        side[4, k] = meshes.centers[mesh, k] - origin[k]
        for m in range(3):
            side[5 + k, m] = meshes.axes[mesh, k, m]
    whole[V0], whole[F0] = meshes.vertex_offsets[mesh], meshes.face_offsets[mesh]
    whole[COUNT], whole[NODE] = meshes.counts[mesh], meshes.node_offsets[mesh]
    whole[LEAVES] = (meshes.counts[mesh] + LEAF - 1) // LEAF
    whole[TURNED], whole[UPRIGHT] = 0, meshes.upright[mesh]
    # the first node whose leaf holds face 0; leaves before it come last (see first_face)
    whole[DEEPEST] = first_leaf(whole[LEAVES])


@compiled
def turn_side(side: Floats, whole: Ints, turn: Floats, spare: Floats) -> None:
    """Takes a side into other axes (rows of ``turn``)."""
    for k in range(3):
        for m in range(3):
            if whole[TURNED]:
                at = turn[k, 0] * side[0, m] + turn[k, 1] * side[1, m] + turn[k, 2] * side[2, m]
            else:
                at = turn[k, m]
            spare[k, m] = at
            # the box axes as rows, so turned from the right
            spare[3 + k, m] = turn[m, 0] * side[5 + k, 0] + turn[m, 1] * side[5 + k, 1] + turn[m, 2] * side[5 + k, 2]
        spare[6, k] = turn[k, 0] * side[4, 0] + turn[k, 1] * side[4, 1] + turn[k, 2] * side[4, 2]
    if not whole[TURNED]:
        # the origin was taken off the vertices; now the centre is, and added again after the turn
        for k in range(3):
            side[3, k] += side[4, k]
    for k in range(3):
        side[4, k] = spare[6, k]
        for m in range(3):
            side[k, m], side[5 + k, m] = spare[k, m], spare[3 + k, m]
    whole[TURNED], whole[UPRIGHT] = 1, 0


@compiled
def relate(a: Floats, b: Floats, frame: Floats) -> None:
    """Writes the pose of the boxes of ``b`` in the axes of those of ``a``.

    Args:
        a: side.
        b: side.
        frame: ``(7, 3)`` takes the rotation (3 rows), its absolute values (3 rows) and the shift.
    """
    for k in range(3):
        frame[6, k] = 0.0
        for m in range(3):
            frame[6, k] += a[5 + k, m] * (b[4, m] - a[4, m])
            dot = a[5 + k, 0] * b[5 + m, 0] + a[5 + k, 1] * b[5 + m, 1] + a[5 + k, 2] * b[5 + m, 2]
            frame[k, m] = dot
            frame[3 + k, m] = abs(dot)


@compiled
def node_gap2(nodes: Nodes, a: int, b: int, frame: Floats, upright: bool) -> float:
    """A lower bound of the squared distance of two nodes; exact for upright boxes."""
    if upright:
        x = abs(frame[6, 0] + nodes[b, 0] - nodes[a, 0]) - nodes[a, 3] - nodes[b, 3]
        y = abs(frame[6, 1] + nodes[b, 1] - nodes[a, 1]) - nodes[a, 4] - nodes[b, 4]
        z = abs(frame[6, 2] + nodes[b, 2] - nodes[a, 2]) - nodes[a, 5] - nodes[b, 5]
        x, y, z = max(x, 0.0), max(y, 0.0), max(z, 0.0)
        return float(x * x + y * y + z * z)
    of_a, of_b = 0.0, 0.0
    bx, by, bz = np.float64(nodes[b, 0]), np.float64(nodes[b, 1]), np.float64(nodes[b, 2])
    dx = frame[6, 0] + frame[0, 0] * bx + frame[0, 1] * by + frame[0, 2] * bz - nodes[a, 0]
    dy = frame[6, 1] + frame[1, 0] * bx + frame[1, 1] * by + frame[1, 2] * bz - nodes[a, 1]
    dz = frame[6, 2] + frame[2, 0] * bx + frame[2, 1] * by + frame[2, 2] * bz - nodes[a, 2]
    d = (dx, dy, dz)
    for k in range(3):
        reach = nodes[a, 3 + k] + (
            frame[3 + k, 0] * nodes[b, 3] + frame[3 + k, 1] * nodes[b, 4] + frame[3 + k, 2] * nodes[b, 5]
        )
        gap = max(abs(d[k]) - reach, 0.0)
        of_a += gap * gap
        reach = nodes[b, 3 + k] + (frame[3, k] * nodes[a, 3] + frame[4, k] * nodes[a, 4] + frame[5, k] * nodes[a, 5])
        gap = max(abs(frame[0, k] * dx + frame[1, k] * dy + frame[2, k] * dz) - reach, 0.0)
        of_b += gap * gap
    if of_a > 0.0 or of_b > 0.0:
        return max(of_a, of_b)
    # a side of each: what tells two long bars apart that pass each other
    of_sides = 0.0
    for i in range(3):
        i1, i2 = (i + 1) % 3, (i + 2) % 3
        for j in range(3):
            sine2 = 1.0 - frame[i, j] * frame[i, j]
            if sine2 < 1e-6:
                continue
            j1, j2 = (j + 1) % 3, (j + 2) % 3
            gap = abs(d[i2] * frame[i1, j] - d[i1] * frame[i2, j]) - (
                nodes[a, 3 + i1] * frame[3 + i2, j]
                + nodes[a, 3 + i2] * frame[3 + i1, j]
                + nodes[b, 3 + j1] * frame[3 + i, j2]
                + nodes[b, 3 + j2] * frame[3 + i, j1]
            )
            if gap > 0.0:
                of_sides = max(of_sides, gap * gap / sine2)
    return of_sides


@compiled
def node_middle2(nodes: Nodes, a: int, b: int, frame: Floats, upright: bool) -> float:
    """Squared distance of the centres of two nodes."""
    bx, by, bz = np.float64(nodes[b, 0]), np.float64(nodes[b, 1]), np.float64(nodes[b, 2])
    if not upright:
        bx, by, bz = (
            frame[0, 0] * bx + frame[0, 1] * by + frame[0, 2] * bz,
            frame[1, 0] * bx + frame[1, 1] * by + frame[1, 2] * bz,
            frame[2, 0] * bx + frame[2, 1] * by + frame[2, 2] * bz,
        )
    x, y, z = frame[6, 0] + bx - nodes[a, 0], frame[6, 1] + by - nodes[a, 1], frame[6, 2] + bz - nodes[a, 2]
    return float(x * x + y * y + z * z)


@compiled
def load_leaf(vertices: Floats, faces: Faces, side: Floats, whole: Ints, node: int, rows: Floats) -> int:
    """Prepares the triangles of a leaf; returns how many there are."""
    start = LEAF * (node - whole[DEEPEST])
    if start < 0:
        start += LEAF * whole[LEAVES]
    count = min(LEAF, whole[COUNT] - start)
    f0, v0 = whole[F0] + start, whole[V0]
    for i in range(count):
        for corner in range(3):
            v = v0 + faces[f0 + i, corner]
            x, y, z = vertices[v, 0] - side[3, 0], vertices[v, 1] - side[3, 1], vertices[v, 2] - side[3, 2]
            if whole[TURNED]:
                x, y, z = (
                    side[0, 0] * x + side[0, 1] * y + side[0, 2] * z + side[4, 0],
                    side[1, 0] * x + side[1, 1] * y + side[1, 2] * z + side[4, 1],
                    side[2, 0] * x + side[2, 1] * y + side[2, 2] * z + side[4, 2],
                )
            rows[i, 3 * corner], rows[i, 3 * corner + 1], rows[i, 3 * corner + 2] = x, y, z
        prepare(rows, i)
    return int(count)


@compiled
def rows_gap2(p: Floats, i: int, q: Floats, j: int) -> float:
    """Squared distance of the boxes of two rows."""
    x = max(p[i, 13] - q[j, 16], q[j, 13] - p[i, 16], 0.0)
    y = max(p[i, 14] - q[j, 17], q[j, 14] - p[i, 17], 0.0)
    z = max(p[i, 15] - q[j, 18], q[j, 15] - p[i, 18], 0.0)
    return float(x * x + y * y + z * z)


@compiled
def node_girth(nodes: Nodes, node: int) -> float:
    """The middle one of the half extents of a node [m]: what a long box measures across."""
    x, y, z = nodes[node, 3], nodes[node, 4], nodes[node, 5]
    return float(max(min(x, y), min(max(x, y), z)))


@compiled
def node_extent(nodes: Nodes, node: int) -> float:
    """The greatest half extent of a node [m]."""
    return float(max(nodes[node, 3], nodes[node, 4], nodes[node, 5]))
