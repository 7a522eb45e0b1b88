"""Which meshes of a scene are one shape in several places: each is sent once, with a place for every mesh."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.geometry.kernels.parallel import compiled, for_ranges, readable
from cadgraph.geometry.mesh.properties import measure
from cadgraph.geometry.shape.repeats import find_shapes, position_tolerance
from cadgraph.model.scene import Floats, Ints, MeshArrays, Scene, turned_boxes

__all__ = ["CLOSE", "Instances", "find_instances", "quaternions"]

CLOSE = 1e-4
"""How far a mesh may lie from the shape that is shown for it [m]: a tenth of a millimetre."""


@dataclass(frozen=True, eq=False)
class Instances:
    """The distinct shapes of a scene and where each mesh lies: ``turn @ x + shift`` of a point ``x`` of its shape.

    Args:
        shapes: some of which are distinct, each in a frame of its own.
        first: ``(n,)`` the distinct ones, as rows of ``shapes``.
        center: ``(n, 3)`` middle of each one's box in its frame [m]; taken from its points, they lie round zero.
        low: ``(n_meshes, 3)`` least corner of a box round each mesh [m]; NaN without a finite vertex.
        high: ``(n_meshes, 3)`` greatest corner [m].
        shape: ``(n_meshes,)`` which of the distinct shapes each mesh is.
        turn: ``(n_meshes, 3, 3)`` rotation, for points of the shape that lie round zero.
        shift: ``(n_meshes, 3)`` [m].
    """

    shapes: MeshArrays
    first: Ints
    center: Floats
    low: Floats
    high: Floats
    shape: Ints
    turn: Floats
    shift: Floats

    @property
    def n(self) -> int:
        """How many distinct shapes there are."""
        return len(self.first)


def find_instances(scene: Scene) -> Instances:
    """Finds the distinct shapes of a scene: those that its meshes share, and exact copies that they don't.

    A copy lies within :data:`CLOSE` of what is shown for it, or it is a shape of its own. A mirror image is one, too.

    Args:
        scene: any; it is not placed as a whole where its meshes share shapes.
    """
    n = scene.shapes.n
    alone = Scene(scene.shapes, tuple(map(str, range(n))), np.zeros((n, 3), np.float32))
    measured = measure(alone, boxes=False)
    found = find_shapes(alone, measured)
    shape, first = found.shape.copy(), found.first
    turn, shift = found.turn.copy(), found.shift.copy()
    loose = position_tolerance(measured) > CLOSE
    loose[loose] = _residuals(scene.shapes, found.first[found.shape], found.turn, found.shift, loose)[loose] > CLOSE
    own = np.flatnonzero(loose)
    # Where rounding alone is as large as that, a copy is only what lies close after all.
    shape[own], turn[own], shift[own] = found.n_shapes + np.arange(len(own)), np.eye(3), 0.0
    first = np.concatenate([first, own])
    center = np.nan_to_num(measured.aabb[first].mean(axis=1))
    shift = shift + np.einsum("nij,nj->ni", turn, center[shape])
    low, high = measured.aabb[:, 0], measured.aabb[:, 1]
    if scene.placement is not None:
        rows, placed = scene.placement.shape, scene.placement
        low, high = turned_boxes(low[rows], high[rows], placed.turn, placed.shift)
        turn = placed.turn.transpose(0, 2, 1) @ turn[rows]
        shift = np.einsum("nji,nj->ni", placed.turn, shift[rows]) + placed.shift
        shape = shape[rows]
    return Instances(scene.shapes, first, center, low, high, shape, turn, shift)


def _residuals(shapes: MeshArrays, heads: Ints, turn: Floats, shift: Floats, asked: npt.NDArray[np.bool_]) -> Floats:
    """How far vertices are at most from those of the head of their shape, moved; infinite if they are not as many."""
    found = np.zeros(shapes.n)
    vertices, offsets = readable(shapes.vertices, np.float64), readable(shapes.vertex_offsets, np.int64)

    def kernel(low: int, high: int) -> None:
        _residual_range(vertices, offsets, heads, turn, shift, asked, low, high, found)

    for_ranges(kernel, np.diff(offsets))
    return found


@compiled
def _residual_range(
    vertices: Any, offsets: Any, heads: Any, turn: Any, shift: Any, asked: Any, low: int, high: int, found: Any
) -> None:
    for k in range(low, high):
        a, b = offsets[heads[k]], offsets[k]
        n = offsets[k + 1] - b
        if not asked[k]:
            continue
        if n != offsets[heads[k] + 1] - a:
            found[k] = np.inf
            continue
        most = 0.0
        for v in range(n):
            apart = 0.0
            for i in range(3):
                x = shift[k, i] - vertices[b + v, i]
                for j in range(3):
                    x += turn[k, i, j] * vertices[a + v, j]
                apart += x * x
            # What is not finite lies nowhere, and so not apart either.
            most = max(most, apart) if apart >= 0.0 else most
        found[k] = np.sqrt(most)


def quaternions(turn: Floats) -> Floats:
    """``(n, 4)`` unit quaternions ``x, y, z, w`` with ``w >= 0`` of rotations ``(n, 3, 3)`` (Shepperd 1978)."""
    m = np.asarray(turn, np.float64)
    xx, yy, zz = m[:, 0, 0], m[:, 1, 1], m[:, 2, 2]
    four = 1.0 + np.stack([xx - yy - zz, yy - xx - zz, zz - xx - yy, xx + yy + zz], axis=1)
    # Products of each two, from which the one that is surely not small is divided out.
    sums = {(0, 1): m[:, 1, 0] + m[:, 0, 1], (0, 2): m[:, 0, 2] + m[:, 2, 0], (1, 2): m[:, 2, 1] + m[:, 1, 2]}
    differences = {(0, 3): m[:, 2, 1] - m[:, 1, 2], (1, 3): m[:, 0, 2] - m[:, 2, 0], (2, 3): m[:, 1, 0] - m[:, 0, 1]}
    products = np.zeros((len(m), 4, 4))
    for i in range(4):
        products[:, i, i] = four[:, i]
    for (i, j), values in (sums | differences).items():
        products[:, i, j] = products[:, j, i] = values
    found = products[np.arange(len(m)), four.argmax(axis=1)]
    found /= np.linalg.norm(found, axis=1, keepdims=True)
    signed: Floats = found * np.where(found[:, 3:] < 0, -1.0, 1.0)
    return signed
