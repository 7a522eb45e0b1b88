"""The line that each connector part carries: its centreline, or the axis of a disc (flange, gasket, coupling)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields, replace

import numpy as np

from cadgraph.geometry.line.centreline import Branch, Centreline, End, trace_centrelines
from cadgraph.model.derived import store_of
from cadgraph.model.parts import Properties
from cadgraph.model.scene import Floats, Scene

__all__ = ["find_lines", "is_disc", "is_plain_tube", "is_ring"]

# Two of the moments of inertia of a disc are alike within this share. Ours: a flange with four bolt holes keeps 0.1 %,
# one that a scan has moved by 2 mm keeps 3 %.
_ALIKE = 0.05
# Greatest over least half width across the axis: a hexagon has 1.15, an octagon 1.08, a square 1.41.
_ROUND = 1.2
# The two sides of a disc lie as far from its middle, within this share of its radius.
_CENTRED = 0.08
# A disc whose thickness is below this share of its breadth needs no tracing.
_FLAT = 0.9
# The corners of the bore lie within this factor of the least distance from the axis, or this share of the breadth: what
# stands out from the faces (bolts that are one mesh with their flange) does not.
_BORE, _CORE = 1.3, 0.3
# Corners this close to an end of the axis, as share of the length, belong to that end's face.
_FACE = 0.02
# A hole below this share of the face's radius, or above the other, is none that tells a bore.
_LEAST_BORE, _MOST_BORE = 0.15, 0.97
_TURNS = np.column_stack([np.cos(np.arange(24) * np.pi / 12), np.sin(np.arange(24) * np.pi / 12)])
# The radius of a plain tube changes by less than this share.
_STEADY = 0.06


def find_lines(
    scene: Scene, properties: Properties, chosen: Sequence[int], workers: int | None = None
) -> dict[int, Centreline]:
    """The lines of some meshes; each is traced once for the same scene.

    Args:
        scene: all meshes.
        properties: of them.
        chosen: indices of those that may be connectors.
        workers: threads; all processors by default. The outcome does not depend on it.

    Returns:
        For each mesh that has one its line: what ``trace_centrelines`` finds, or for what is flat and round the axis
        from face to face. Meshes that are neither have none.
    """
    flat, traced = store_of(scene, "axes"), store_of(scene, "lines")
    for part in (part for part in chosen if part not in flat):
        breadth = properties.obb_extents[part]
        flat[part] = _disc(scene, properties, part) if breadth[2] < _FLAT * breadth[1] else None
    rest = [part for part in chosen if flat[part] is None]
    new = [part for part in rest if part not in traced]
    if new:
        found = trace_centrelines(scene.select(new), _rows(properties, new), workers)
        for part, line in zip(new, found, strict=True):
            whole = isinstance(line, Centreline) and line.ends
            traced[part] = line if whole else _disc(scene, properties, part)
    lines = {part: flat[part] for part in chosen if flat[part] is not None}
    return lines | {part: traced[part] for part in rest if traced[part] is not None}


def _rows(properties: Properties, chosen: Sequence[int]) -> Properties:
    index = np.asarray(chosen, np.int64)
    return replace(properties, **{field.name: getattr(properties, field.name)[index] for field in fields(properties)})


def _disc(scene: Scene, properties: Properties, part: int) -> Centreline | None:
    """The axis of a part that looks alike all around it, from end to end."""
    moments, axes = np.linalg.eigh(properties.inertia[part])
    if not moments[2] > 0:
        return None
    # The odd one of the three moments belongs to the axis.
    odd = 2 if moments[1] - moments[0] <= moments[2] - moments[1] else 0
    pair = np.delete(moments, odd)
    if pair[1] - pair[0] > _ALIKE * moments[2] or abs(moments[odd] - pair.mean()) <= _ALIKE * moments[2]:
        return None
    axis, u, w = axes[:, odd], axes[:, (odd + 1) % 3], axes[:, (odd + 2) % 3]
    vertices, faces = scene.mesh(part)
    used = vertices[np.unique(faces)]
    middle = properties.centroid[part]
    offset = used[np.isfinite(used).all(axis=1)] - middle
    across = offset @ np.column_stack([u, w])
    widths = (across @ _TURNS.T).max(axis=0)
    if widths.max() > _ROUND * widths.min() or np.abs(widths[:12] - widths[12:]).max() > _CENTRED * widths.max():
        return None
    along, reach = offset @ axis, np.linalg.norm(across, axis=1)
    core = reach <= max(_BORE * float(reach.min()), _CORE * float(reach.max()))
    low, high = float(along[core].min()), float(along[core].max())
    if not high > low:
        return None
    ends = np.array([_face(along, reach, at, high - low) for at in (low, high)])
    points = middle + np.outer([low, high], axis)
    branch = Branch(points, ends[:, 0], ends[:, 1])
    return Centreline(
        (branch,),
        (
            End(points[0], -axis, float(ends[0, 0]), float(ends[0, 1]), 0),
            End(points[1], axis, float(ends[1, 0]), float(ends[1, 1]), 0),
        ),
        (),
        1.0,
    )


def _face(along: Floats, reach: Floats, at: float, length: float) -> tuple[float, float]:
    """The outer radius of the face at one end, and that of its hole (NaN where it has none)."""
    there = reach[np.abs(along - at) <= max(_FACE * length, 1e-4)]
    outer, inner = float(there.max()), float(there.min())
    return outer, inner if _LEAST_BORE * outer < inner < _MOST_BORE * outer else float("nan")


def is_disc(line: Centreline) -> bool:
    """Whether a line is that of something short: a flange, a gasket, a coupling, a cap."""
    radius = max(float(branch.radius.max()) for branch in line.branches)
    return len(line.branches) == 1 and line.length < 1.6 * radius


def is_ring(line: Centreline) -> bool:
    """Whether a line is that of a thin flat ring: a gasket."""
    radius = max(float(branch.radius.max()) for branch in line.branches)
    return len(line.branches) == 1 and line.length < 0.12 * radius


def is_plain_tube(line: Centreline) -> bool:
    """Whether a line is that of a pipe or bend: one run of steady radius, longer than it is wide, with two ends."""
    if len(line.branches) != 1 or len(line.ends) != 2:
        return False
    radius = line.branches[0].radius
    return bool(radius.max() <= (1 + _STEADY) * radius.min() and line.length >= 3.0 * radius.max() and line.share > 0.9)
