"""Primitives to meshes: each different shape once, and where it is placed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from cadgraph.geometry.mesh.merge import merge_rows
from cadgraph.load.packing import Notes
from cadgraph.load.rvm.chunks import Words
from cadgraph.load.rvm.facets import triangles_of
from cadgraph.load.rvm.primitives import FACETS, Primitives
from cadgraph.load.rvm.shapes import Fineness, Layout, coarser, cut, lay_out, layouts
from cadgraph.model.scene import Faces, Floats, Ints, ranges

__all__ = ["Meshes", "Shape", "cut_shapes", "place"]

Shape = tuple[Floats, Faces]

_METRE = 0.001  # [m] a millimetre
_THIN = 1e-3  # [mm] what is thinner has no thickness; float32 tells no less at the size of a plant
_EQUAL = 1e-6  # [m], and of directions: so near to each other the primitives of two nodes lie alike


@dataclass(frozen=True)
class Meshes:
    """What becomes the meshes of a scene, in the order of the file.

    Args:
        shapes: points ``(n, 3)`` [m] and triangles of each different shape.
        shape: ``(n_meshes,)`` number of the shape of each.
        matrix: ``(n_meshes, 4, 4)`` for row vectors, from the shape to the world [m]; rotations and shifts only.
        first: ``(n_meshes,)`` number of its first primitive.
        whole: ``(n_meshes,)`` whether it is all primitives of its node.
    """

    shapes: list[Shape]
    shape: Ints
    matrix: Floats
    first: Ints
    whole: npt.NDArray[np.bool_]


def cut_shapes(
    words: Words,
    primitives: Primitives,
    fineness: Fineness,
    max_triangles: int,
    name_of: Callable[[int], str],
    notes: Notes,
) -> tuple[list[Shape | None], Ints]:
    """Triangles of each different primitive.

    Args:
        words: of the file.
        primitives: of the file.
        fineness: of curves.
        max_triangles: cut coarser where all primitives together have more (``coarsened``).
        name_of: the path of a node, for notes.
        notes: gets what was left out.

    Returns:
        Points ``(n, 3)`` [m] and triangles of each shape, None where it has no thickness or is broken; and
        ``(n_primitives,)`` the shape of each.
    """
    rows = [primitives.kind[:, None], primitives.stretch[:, None], primitives.content[:, None]]
    # A facet group has no sizes: what follows its head in the file is its counts.
    sizes = np.where(primitives.kind[:, None] == FACETS, np.float32(0), primitives.sizes)
    first, shape = merge_rows(np.concatenate([*rows, sizes.view(np.int32)], axis=1))
    users = np.bincount(shape, minlength=len(first))
    shapes: list[Shape | None] = [None] * len(first)
    facets = np.flatnonzero(primitives.kind[first] == FACETS)
    n_facets = 0
    for number in facets.tolist():
        one = int(first[number])
        try:
            found = _facet_shape(words, primitives, one)
        except ValueError as error:
            for user in np.flatnonzero(shape == number).tolist():
                notes.add("broken-primitive", f"left out: {error}", name_of(int(primitives.node[user])))
            continue
        if found is None:
            notes.add("empty-mesh", "left out: a facet group without a triangle", name_of(int(primitives.node[one])))
            continue
        shapes[number] = found
        n_facets += len(found[1]) * int(users[number])
    solid = np.flatnonzero(primitives.kind[first] != FACETS)
    plan = _plan(primitives, first[solid], users[solid], fineness, max_triangles - n_facets, notes)
    flat = 0
    for layout, own in plan:
        points, faces = cut(layout, primitives.sizes[first[solid[own]]].astype(np.float64))
        if not len(faces):
            flat += int(users[solid[own]].sum())
            continue
        stretch = primitives.stretches[primitives.stretch[first[solid[own]]]]
        points = np.einsum("kni,kij->knj", points, stretch)
        fit = np.abs(points).max(axis=(1, 2)) < 1e12
        thick = np.ptp(points, axis=1).min(axis=1) > _THIN
        inward = _volumes(points, faces) < 0
        turned = np.ascontiguousarray(faces[:, ::-1])
        points = points * _METRE
        for i, number in enumerate(solid[own].tolist()):
            if not fit[i]:
                for user in np.flatnonzero(shape == number).tolist():
                    notes.add("broken-primitive", "left out: it has no end", name_of(int(primitives.node[user])))
            elif not thick[i]:
                flat += int(users[number])
            else:
                shapes[number] = points[i], turned if inward[i] else faces
    if flat:
        notes.add("flat-primitive", f"left out: {flat} primitives without thickness")
    return shapes, shape


def place(primitives: Primitives, shapes: list[Shape | None], shape: Ints, joined: npt.NDArray[np.bool_]) -> Meshes:
    """Joins the primitives of nodes, and tells which nodes are alike.

    Args:
        primitives: of the file.
        shapes: of them, as ``cut_shapes`` gives them.
        shape: ``(n_primitives,)`` of each.
        joined: ``(n_primitives,)`` whether it becomes one mesh with the others of its node.
    """
    there = np.array([one is not None for one in shapes], bool)
    kept = np.flatnonzero(there[shape])
    # Primitives of one node need not follow each other: those of its children may stand between.
    of_node = np.where(joined[kept], primitives.node[kept], -2 - kept)
    _, mesh = merge_rows(of_node[:, None])
    order = np.argsort(mesh, kind="stable")
    kept, mesh = kept[order], mesh[order]
    starts = np.flatnonzero(np.diff(mesh, prepend=-1))
    ends = np.append(starts[1:], len(kept))
    first = kept[starts]
    own_shape = shape[first].copy()
    all_shapes = list(shapes)
    several = np.flatnonzero(ends - starts > 1)
    known: dict[bytes, int] = {}
    for block in range(0, len(several), 1 << 14):
        groups = several[block : block + (1 << 14)]
        rows, turns, shifts = _relative(primitives, shape, kept, starts[groups], ends[groups])
        cuts = np.cumsum([0, *(ends[groups] - starts[groups]).tolist()]).tolist()
        for i, group in enumerate(groups.tolist()):
            key = rows[cuts[i] : cuts[i + 1]].tobytes()
            number = known.setdefault(key, len(all_shapes))
            if number == len(all_shapes):
                members = range(cuts[i], cuts[i + 1])
                placed = [(all_shapes[int(rows[j, 0])], turns[j], shifts[j]) for j in members]
                all_shapes.append(_merged(placed))
            own_shape[group] = number
    used, own_shape = np.unique(own_shape, return_inverse=True)
    matrix = np.zeros((len(first), 4, 4))
    matrix[:, :3, :3], matrix[:, 3, :3], matrix[:, 3, 3] = primitives.turn[first], primitives.shift[first], 1
    final = [one for one in (all_shapes[number] for number in used.tolist()) if one is not None]
    return Meshes(final, own_shape.reshape(-1), matrix, first, joined[first])


def _relative(primitives: Primitives, shape: Ints, kept: Ints, starts: Ints, ends: Ints) -> tuple[Ints, Floats, Floats]:
    """Shape and rounded placement of primitives, seen from the first one of each group; and both unrounded."""
    counts = ends - starts
    inside = ranges(starts, counts)
    own, base = kept[inside], kept[np.repeat(starts, counts)]
    back = primitives.turn[base].transpose(0, 2, 1)
    turn = primitives.turn[own] @ back
    shift = ((primitives.shift[own] - primitives.shift[base])[:, None, :] @ back)[:, 0]
    # Clipped, so that what lies out of all bounds still has a whole number.
    steps = np.round(np.clip(np.concatenate([turn.reshape(-1, 9), shift], 1), -1e12, 1e12) / _EQUAL)
    return np.concatenate([shape[own][:, None], steps.astype(np.int64)], 1), turn, shift


def _merged(placed: list[tuple[Shape | None, Floats, Floats]]) -> Shape:
    points, faces, n = [], [], 0
    for one, turn, shift in placed:
        if one is not None:
            points.append(one[0] @ turn + shift)
            faces.append(one[1] + np.int32(n))
            n += len(one[0])
    return np.concatenate(points), np.concatenate(faces)


def _facet_shape(words: Words, primitives: Primitives, one: int) -> Shape | None:
    start, end = primitives.groups[primitives.content[one]].tolist()
    points, faces = triangles_of(words[start:end])
    stretch = primitives.stretches[primitives.stretch[one]]
    if np.linalg.det(stretch) < 0:
        faces = np.ascontiguousarray(faces[:, ::-1])
    return (points @ stretch * _METRE, faces) if len(faces) else None


def _plan(
    primitives: Primitives, first: Ints, users: Ints, fineness: Fineness, room: int, notes: Notes
) -> list[tuple[Layout, Ints]]:
    """The layouts of all shapes, as fine as there is room for."""
    scale = np.linalg.norm(primitives.stretches, 2, axis=(1, 2))[primitives.stretch[first]]
    sizes = primitives.sizes[first].astype(np.float64)
    used: Fineness | None = fineness
    while used is not None:
        rows = lay_out(primitives.kind[first], sizes, scale, used)
        plan = list(layouts(rows))
        total = sum(len(cut(layout, sizes[own[:1]])[1]) * int(users[own].sum()) for layout, own in plan)
        last, used = used, coarser(used) if total > room else None
    if last != fineness:
        enough = "" if total <= room else "; still more than load.max_triangles"
        notes.add(
            "coarsened",
            f"curves are cut with gaps up to {last.gap:g} mm and {last.angle:.3g} rad, to {total:,} triangles{enough}; "
            "raise load.max_triangles for finer ones",
        )
    return plan


def _volumes(points: Floats, faces: Faces) -> Floats:
    """Signed, of each of ``(k, n, 3)``; about the first point, for the sake of small ones far out."""
    about = points - points[:, :1]
    a, b, c = (about[:, faces[:, i]] for i in range(3))
    volumes: Floats = np.einsum("kni,kni->k", np.cross(a, b), c) / 6
    return volumes
