"""Everything that is measured of a shape, once for all its repeats."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from cadgraph.geometry.kernels.gather import gather_chunks
from cadgraph.geometry.shape.repeats import Shapes, find_shapes
from cadgraph.geometry.shape.round_faces import find_discs, find_ports, same_line
from cadgraph.geometry.shape.surface import LEVELS, Surface, find_surfaces
from cadgraph.geometry.shape.turning import find_profile, find_wheel, look_along
from cadgraph.model.derived import kept_with, store_of
from cadgraph.model.parts import Parts, Properties
from cadgraph.model.scene import Floats, Ints, Scene
from cadgraph.model.shapes import Disc, Facts, ShapeAnalysis, is_round

__all__ = ["CHUNK", "analyse_shapes", "measure_shapes", "measure_shapes_by", "shapes_of"]

CHUNK = 32
"""Shapes that are measured at a time; the last digits of a measure depend on what else is in its chunk."""

_AHEAD = "shapes measured ahead"
_TUBE_ERROR = 0.12  # a tube's volume, area and end faces agree this well; mitred bends are a few per cent off
# Faces run along a side of the box, or across it, where their normals are off by less than this. Of a constant section
# nearly all of the area does one of the two, and what lies across is at either end, within this share of the length.
_STRAIGHT, _NEARLY_ALL, _AT_END = 0.02, 0.99, 0.01

Measure = Callable[[Scene, Properties], Sequence[Facts]]
"""What does the work of ``measure_shapes``."""


def analyse_shapes(
    scene: Scene, properties: Properties, shapes: Shapes | None = None, measure: Measure | None = None
) -> ShapeAnalysis:
    """Measures each distinct shape of a scene.

    Args:
        scene: any.
        properties: of its meshes.
        shapes: which of its meshes repeat each other; found here if None.
        measure: stands in for ``measure_shapes``.
    """
    shapes = shapes or find_shapes(scene, properties)
    facts = (measure or measure_shapes)(scene.select(shapes.first), properties.select(shapes.first))
    return ShapeAnalysis(tuple(facts), shapes.first, shapes.shape, shapes.turn, shapes.shift)


def shapes_of(parts: Parts) -> ShapeAnalysis:
    """What is known of the shapes of parts; measured once for the same parts, whichever of them are the ground."""
    return _shapes_of(parts.scene, parts.properties)


def measure_shapes_by(measure: Measure, parts: Parts) -> None:
    """Measures the shapes of parts ahead of the first question for them, for instance in several processes.

    Args:
        measure: does what ``measure_shapes`` does.
        parts: of which ``shapes_of`` will be asked.
    """
    analysis = analyse_shapes(parts.scene, parts.properties, measure=measure)
    store_of(parts.scene, _AHEAD)[id(parts.properties)] = (parts.properties, analysis)


@kept_with
def _shapes_of(scene: Scene, properties: Properties) -> ShapeAnalysis:
    ahead = store_of(scene, _AHEAD).pop(id(properties), None)
    return analyse_shapes(scene, properties) if ahead is None else ahead[1]


def measure_shapes(scene: Scene, properties: Properties) -> list[Facts]:
    """Measures every mesh of a scene.

    Args:
        scene: one mesh for each shape.
        properties: of its meshes.
    """

    def measure(rows: Ints) -> list[Facts]:
        return _measure_some(scene.select(rows), properties.select(rows))

    return [facts for some in gather_chunks(measure, np.diff(scene.face_offsets), CHUNK) for facts in some]


def _measure_some(scene: Scene, properties: Properties) -> list[Facts]:
    facts = []
    for mesh, surface in enumerate(find_surfaces(scene, properties)):
        volume = abs(float(properties.volume[mesh])) if properties.closed[mesh] else 0.0
        facts.append(_measure(surface, properties.obb_center[mesh], properties.obb_axes[mesh],
                              properties.obb_extents[mesh], volume))  # fmt: skip
    return facts


def _measure(surface: Surface, middle: Floats, box_axes: Floats, extents: Floats, volume: float) -> Facts:
    level = LEVELS[0]
    discs = find_discs(surface, surface.patches[0], middle, level)
    if not discs:
        level = LEVELS[1]
        discs = find_discs(surface, surface.patches[1], middle, level)
    ports, lines = find_ports(discs)
    tries = [(line[0].center, line[0].normal) for line in lines[:3]] or [(middle, axis) for axis in box_axes]
    measured = [look_along(surface, center, axis, level) for center, axis in tries]
    best = int(np.argmax([one.turned + (one.sides >= 5) - 0.02 * k for k, one in enumerate(measured)]))
    (center, axis), seen = tries[best], measured[best]
    low, high = (float(seen.along.min()), float(seen.along.max())) if seen.along.size else (0.0, 0.0)
    outer, inner, bore = find_profile(surface, seen, low, high)
    rim, spokes = find_wheel(surface, seen)
    box = float(np.prod(extents))
    return Facts(
        discs=tuple(discs), ports=tuple(ports), center=center, axis=axis, low=low, high=high, radius=seen.radius,
        turned=seen.turned, sides=seen.sides, outer=outer, inner=inner,
        bore=bore if is_round(seen.turned, seen.sides) else 0.0,
        tube=_tube_length(ports, float(surface.areas.sum()), volume, extents), rim=rim, spokes=spokes,
        section=extents, fill=volume / box if box > 0 else 0.0,
        extruded=_extruded_side(surface, middle, box_axes, extents),
    )  # fmt: skip


def _tube_length(ports: list[Disc], area: float, volume: float, extents: Floats) -> float:
    """Length of the centreline if area, volume and two equal ports fit one round section, else 0.

    Pappus: side area = perimeter x length and volume = section x length hold for bends as for straight pieces.
    """
    if len(ports) != 2:
        return 0.0
    first, second = ports
    if abs(first.outer - second.outer) > 0.1 * first.outer:
        return 0.0
    n, outer, inner = first.sides, first.outer, 0.0 if first.inner >= first.outer else first.inner
    perimeter = 2 * n * np.sin(np.pi / n) * (outer + inner)
    length = float((area - first.area - second.area) / perimeter)
    apart = float(np.linalg.norm(first.center - second.center))
    if length < 0.98 * apart - 1e-6:
        return 0.0
    if volume:
        section = n / 2 * np.sin(2 * np.pi / n) * (outer**2 - inner**2)
        fits = abs(volume - section * length) < _TUBE_ERROR * section * length
    else:  # an open mesh encloses nothing, but a plane bend is as thick as its section
        fits = float(extents[2]) < 2.2 * outer
    if same_line(first.center, first.normal, second.center, second.normal, 0.1 * outer):
        # Ports that face away from each other on one line: straight, or an expansion loop, which is far wider.
        fits = fits and (length < 1.05 * apart or (apart > 6 * outer and float(extents[1]) > 6 * outer))
    return length if fits else 0.0


def _extruded_side(surface: Surface, middle: Floats, box_axes: Floats, extents: Floats) -> int:
    """The side of the oriented box along which one cross-section runs from end to end, or -1."""
    whole = float(surface.areas.sum())
    if not whole > 0:
        return -1
    along = np.abs(surface.normals @ box_axes.T)
    height = np.abs((surface.triangles.mean(axis=1) - middle) @ box_axes.T)
    at_end = height >= (0.5 - _AT_END) * extents
    fits = (along <= _STRAIGHT) | ((along >= 1 - _STRAIGHT) & at_end)
    shares = (surface.areas[:, None] * fits).sum(axis=0) / whole
    sides = np.flatnonzero((shares >= _NEARLY_ALL) & (extents > 0))
    return int(sides[0]) if len(sides) else -1
