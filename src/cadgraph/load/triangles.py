"""Triangles as files hold them to triangles as a scene needs them."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from cadgraph.geometry.mesh.merge import weld_points
from cadgraph.load.packing import Notes
from cadgraph.model.scene import Faces, Floats, Ints

__all__ = ["MAX_TRIANGLES", "clean_triangles", "linear", "main_color"]

MAX_TRIANGLES = 200_000_000
"""So many are placed at most, from whatever few bytes: about 20 GB. Ours; large plants have a tenth of that."""

_STRAY = 1e11  # a few points farther out than this, in the file's unit, are damage: national grids reach 6e9 mm
_FEW = 0.05  # so many of a mesh at most; where more are, the file means it


def clean_triangles(
    points: npt.NDArray[np.floating], corners: npt.NDArray[np.integer], path: str, notes: Notes
) -> tuple[npt.NDArray[np.floating], Faces, Ints]:
    """Leaves out unusable triangles and unused points, and makes points in one place one.

    Files repeat points where normals or texture coordinates differ; bit by bit the same they belong together.

    Args:
        points: ``(n, 3)``.
        corners: ``(m, 3)`` point numbers, whatever they are.
        path: of the mesh, for the notes.
        notes: get ``invalid-indices`` and ``invalid-points``.

    Returns:
        ``(k, 3)`` points that are used, finite; ``(l, 3)`` triangles of three different points each; ``(l,)`` the
        number that each had in ``corners``.
    """
    kept = np.arange(len(corners))
    within = ((corners >= 0) & (corners < len(points))).all(axis=1)
    if not within.all():
        notes.add("invalid-indices", "faces that use points which don't exist were dropped", path)
        kept = kept[within]
    used, numbers = np.unique(corners[kept], return_inverse=True)
    own = np.asarray(points[used])
    faces = numbers.reshape(-1, 3)
    sound = np.asarray(np.isfinite(own).all(axis=1))
    if not sound.all():
        notes.add("invalid-points", "faces that use NaN or infinite points were dropped", path)
    stray = np.asarray((np.abs(own) > _STRAY).any(axis=1)) & sound
    if stray.any() and np.count_nonzero(stray) <= _FEW * len(own):
        # One of them would have the whole mesh left out for reaching too far.
        notes.add("invalid-points", f"faces that use points more than {_STRAY:.0e} units away were dropped", path)
        sound &= ~stray
    if not sound.all():
        whole = sound[faces].all(axis=1)
        kept, faces = kept[whole], faces[whole]
    first, place = weld_points(own)
    faces = place[faces]
    a, b, c = faces.T
    whole = (a != b) & (b != c) & (c != a)
    kept, faces = kept[whole], faces[whole]
    used, numbers = np.unique(faces, return_inverse=True)
    return own[first[used]] + own.dtype.type(0), numbers.reshape(-1, 3).astype(np.int32), kept


def main_color(points: npt.NDArray[np.floating], faces: Faces, palette: Floats, color_of_face: Ints) -> Floats | None:
    """The colour with the largest area.

    Args:
        points: ``(n, 3)``.
        faces: ``(m, 3)``.
        palette: ``(k, 3)`` colours, NaN for none.
        color_of_face: ``(m,)``.

    Returns:
        ``(3,)``, or None where no face has a colour.
    """
    known = ~np.isnan(palette).any(axis=1)
    if not known.any() or not len(faces):
        return None
    different, which = np.unique(palette[known], axis=0, return_inverse=True)
    number = np.full(len(palette), -1)
    number[known] = which.reshape(-1)
    of_face = number[color_of_face]
    colored = of_face >= 0
    if not colored.any():
        return None
    if len(different) == 1:
        only: Floats = different[0]
        return only
    a, b, c = (points[faces[colored, i]].astype(np.float64) for i in range(3))
    with np.errstate(over="ignore", invalid="ignore"):
        areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        main: Floats = different[np.argmax(np.bincount(of_face[colored], areas, len(different)))]
    return main


def linear(color: Floats) -> Floats:
    """Linear RGB of colours as screens take them (IEC 61966-2-1, sRGB), in 0..1."""
    found: Floats = np.where(color <= 0.04045, color / 12.92, ((np.maximum(color, 0) + 0.055) / 1.055) ** 2.4)
    return found
