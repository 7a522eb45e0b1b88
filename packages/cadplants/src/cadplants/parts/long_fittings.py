"""Fittings of few long triangles, as boundary representations are meshed: cones that span the whole of a reducer."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from cadgraph.model.scene import Floats
from cadplants.model.standards import PIPES, REDUCER_LENGTH
from cadplants.solids.mesh_ops import Shell, Solid, shared, weld
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["long_reducer", "ring", "strip"]

_SPIGOT = 0.09  # share of the length that is cylindrical at each end
_OTHER = 4  # corners that the narrow end has less than the wide one


def ring(x: float, radius: float, sides: int, rise: float = 0.0) -> Floats:
    """``(sides, 3)`` a circle across the x axis, its centre ``rise`` over it [m]."""
    angles = np.arange(sides) * 2 * np.pi / sides
    return np.column_stack([np.full(sides, x), radius * np.cos(angles), radius * np.sin(angles) + rise])


def strip(first: Floats, second: Floats) -> Shell:
    """The skin between two rings of any numbers of corners, each triangle as long as they are apart.

    Args:
        first: ``(n, 3)`` counter-clockwise seen against the way to the second.
        second: ``(m, 3)`` likewise.
    """
    n, m = len(first), len(second)
    faces, i, j = [], 0, 0
    while i < n or j < m:
        if j >= m or (i < n and (i + 0.5) * m <= (j + 0.5) * n):
            faces.append((i % n, (i + 1) % n, n + j % m))
            i += 1
        else:
            faces.append((i % n, n + (j + 1) % m, n + j % m))
            j += 1
    return Solid(np.concatenate([first, second]), np.array(faces, np.int32))


def _disc(loop: Floats, out: bool) -> Shell:
    """Fills a ring from one of its corners, looking towards +x or -x."""
    count = len(loop)
    faces: npt.NDArray[np.int32] = np.array([(0, k, k + 1) for k in range(1, count - 1)], np.int32)
    return Solid(loop, faces if out else faces[:, ::-1])


@shared
def long_reducer(dn: int, other: int, style: ModelingStyle, eccentric: bool = False) -> Solid:
    """A reducer along x: a short spigot, a cone of a few triangles from end to end, a second spigot.

    Args:
        dn: nominal size at x = 0.
        other: at its other end.
        style: that models it; decides on the bore and the sides.
        eccentric: whether its top is flat, so that the axis of the narrow end lies higher.
    """
    wide = style.round_fitting(PIPES[max(dn, other)].radius)
    narrow = max(8, wide - _OTHER)
    length = REDUCER_LENGTH[max(dn, other)]
    rise = PIPES[dn].radius - PIPES[other].radius if eccentric else 0.0
    sides = (wide, narrow) if dn >= other else (narrow, wide)
    skins = [_skin(length, (PIPES[dn].radius, PIPES[other].radius), sides, rise)]
    if not style.hollow:
        outer = skins[0]
        return weld([*_skin_shells(outer), _disc(outer[0], False), _disc(outer[-1], True)])
    skins.append(_skin(length, (PIPES[dn].bore, PIPES[other].bore), sides, rise))
    outside, inside = skins
    return weld(
        [
            *_skin_shells(outside),
            *(Solid(shell.vertices, shell.faces[:, ::-1]) for shell in _skin_shells(inside)),
            strip(inside[0], outside[0]),
            strip(outside[-1], inside[-1]),
        ]
    )


def _skin(length: float, radii: tuple[float, float], sides: tuple[int, int], rise: float) -> list[Floats]:
    spigot = _SPIGOT * length
    places = ((0.0, 0, 0.0), (spigot, 0, 0.0), (length - spigot, 1, rise), (length, 1, rise))
    return [ring(x, radii[end], sides[end], over) for x, end, over in places]


def _skin_shells(loops: list[Floats]) -> list[Shell]:
    return [strip(a, b) for a, b in zip(loops[:-1], loops[1:], strict=True)]
