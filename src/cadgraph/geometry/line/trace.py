"""Finds the centrelines of tubes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cadgraph.geometry.kernels.parallel import for_ranges
from cadgraph.geometry.line.centreline import Centreline, NotTube
from cadgraph.geometry.line.piece import Piece
from cadgraph.geometry.line.stitch import stitch
from cadgraph.geometry.line.sweep import trace_pieces
from cadgraph.geometry.mesh.properties import DEGENERATE_RATIO
from cadgraph.model.parts import Properties
from cadgraph.model.scene import Scene

__all__ = ["trace_centrelines"]

# Least share of the surface that must run along tubes. Ours: an equal tee with a thick collar keeps 0.8.
MIN_SHARE = 0.7
# Least share of the length along which the radius changes by less than so much for each unit of length: a reducer
# tapers by up to 0.6, a sphere by more over half of its length.
MIN_STEADY_SHARE = 0.6
MAX_TAPER = 0.6


def trace_centrelines(
    scene: Scene, properties: Properties, workers: int | None = None
) -> tuple[Centreline | NotTube, ...]:
    """Finds the centreline of each mesh that is a tube.

    Planes are swept along the tube, each perpendicular to its wall and centred on it, so neither open ends, caps,
    soup nor triangles that span the whole length matter. A wall may turn by 35 degrees from one section to the next;
    where it turns more sharply (mitres), or other tubes join, the pieces are put together by where their axes meet.

    Args:
        scene: any.
        properties: of its meshes.
        workers: threads; all processors by default. The outcome does not depend on it.

    Returns:
        One result for each mesh.
    """
    results: list[Centreline | NotTube] = [NotTube("it has no area")] * scene.n_meshes

    def trace(first: int, last: int) -> None:
        for i in range(first, last):
            if properties.area[i] > 0:
                results[i] = _trace_mesh(scene, i, float(properties.obb_extents[i, 0]), bool(properties.volume[i] < 0))

    for_ranges(trace, np.diff(scene.face_offsets), workers)
    return tuple(results)


def _trace_mesh(scene: Scene, index: int, size: float, inward: bool) -> Centreline | NotTube:
    vertices, faces = scene.mesh(index)
    inside = np.all((faces >= 0) & (faces < len(vertices)), axis=1)
    corners = vertices[faces[inside]]
    corners = corners[np.isfinite(corners).all(axis=(1, 2))]
    sides = corners[:, [1, 2, 0]] - corners
    double = np.cross(sides[:, 0], -sides[:, 2])
    if inward:
        double = -double
    area = np.linalg.norm(double, axis=1)
    real = area > DEGENERATE_RATIO * np.square(sides).sum(axis=2).max(axis=1, initial=0.0)
    # Near the origin, so that far-out parts lose no digits.
    origin = corners[0, 0].copy()
    nodes, starts, ends, share = trace_pieces(
        np.ascontiguousarray((corners[real] - origin).reshape(-1, 9)),
        np.ascontiguousarray(double[real] / area[real, None]),
        np.ascontiguousarray(area[real] / 2),
        size,
    )
    if len(starts) == 1:
        return NotTube("no section of it is round")
    nodes[:, :3] += origin
    pieces = [Piece.of(nodes[a:b], end) for a, b, end in zip(starts[:-1], starts[1:], ends, strict=True)]
    if share < MIN_SHARE:
        return NotTube(f"only {share:.0%} of its surface runs along tubes", share)
    if _steady_share(pieces) < MIN_STEADY_SHARE:
        return NotTube("its radius changes along most of its length", share)
    return stitch(pieces, share)


def _steady_share(pieces: Sequence[Piece]) -> float:
    steady = total = 0.0
    for piece in pieces:
        steps = np.linalg.norm(np.diff(piece.nodes[:, :3], axis=0), axis=1)
        # The followed radius may jump where a solid pipe meets its flange; that is a point, not a taper.
        taper = np.abs(np.diff(piece.nodes[:, 5]))
        steady += float(steps[taper <= MAX_TAPER * steps].sum())
        total += float(steps.sum())
    return steady / total if total > 0 else 0.0
