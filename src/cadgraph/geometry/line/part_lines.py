"""The line that a part would carry: its centreline, or the axis of a disc (flange, gasket, coupling)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from cadgraph.geometry.kernels.parallel import for_ranges
from cadgraph.geometry.line.centreline import Branch, Centreline, End, NotTube
from cadgraph.geometry.line.fit import fit_ends
from cadgraph.geometry.line.mouths import are_on_one_axis, join_mouths, mouths_of, run_inward, turned_outward
from cadgraph.geometry.line.trace import trace_centrelines
from cadgraph.geometry.shape.analysis import analyse_shapes, shapes_of
from cadgraph.geometry.shape.round_faces import find_ports, same_line
from cadgraph.model.derived import store_of
from cadgraph.model.parts import Parts, Properties
from cadgraph.model.scene import Floats, Scene
from cadgraph.model.shapes import Disc, Facts, ShapeAnalysis

__all__ = ["axis_line", "lines_of_parts"]

# A round part whose thickness is below this share of its breadth needs no tracing.
_FLAT = 0.9
# Faces of an axis have their middle within this share of the radius from it.
_CENTRED = 0.1
# What lies before a face belongs to the axis where it comes within this factor of the face's hole, or this share of the
# greatest radius; bolts do not.
_AT_BORE, _CORE = 1.3, 0.3
# Faces this near to the last one, as share of the length or [m], are one with it: a raised face and its flange.
_FACE, _NEAR = 0.02, 1e-4
# A hole below this share of the face's radius, or above the other, is none that tells a bore.
_LEAST_BORE, _MOST_BORE = 0.15, 0.97
_FACING = 0.99  # cosine
# Share of the area that turns, and corners around: flanges that hold their bolts, or have ribs, keep as much; bodies
# with branches have wide gaps around.
_TURNED, _SIDES = 0.7, 5


def lines_of_parts(
    scene: Scene, properties: Properties, parts: Parts, chosen: Sequence[int], workers: int | None = None
) -> dict[int, Centreline]:
    """The lines of some parts; each distinct shape is traced once for the same parts, when first asked for.

    They follow from geometry alone, so they outlive any change of labels.

    Args:
        scene: the source meshes.
        properties: of the source meshes.
        parts: made from them.
        chosen: part indices.
        workers: threads; all processors by default. The outcome does not depend on it.

    Returns:
        For each part that has one its line, in the order asked for: the centreline of a tube, or for what is flat and
        round the axis from face to face. A part of several meshes has the line of the first of them: what is too small
        for a part of its own (a flange's nuts) would blur its shape.
    """
    found: dict[int, Centreline | None] = store_of(parts.scene, "lines")
    new = [part for part in dict.fromkeys(chosen) if part not in found]
    found |= _find_lines(scene, properties, parts, new, workers)
    return {part: line for part in chosen if (line := found[part]) is not None}


def _find_lines(
    scene: Scene, properties: Properties, parts: Parts, chosen: Sequence[int], workers: int | None
) -> dict[int, Centreline | None]:
    """The lines of parts that none is known of yet, None for those that have none."""
    single = [part for part in chosen if len(parts.meshes[part]) == 1]
    several = [part for part in chosen if len(parts.meshes[part]) > 1]
    found = _lines_of_shapes(parts, single, workers) if single else {}
    return {**found, **(_lines_of_heads(scene, properties, parts, several, workers) if several else {})}


def _lines_of_shapes(parts: Parts, chosen: Sequence[int], workers: int | None) -> dict[int, Centreline | None]:
    """Of parts of one mesh each: the shapes of parts are those of their meshes."""
    known, traced = shapes_of(parts), store_of(parts.scene, "lines of shapes")
    shapes = [shape for shape in dict.fromkeys(known.shape[list(chosen)].tolist()) if shape not in traced]
    traced |= _trace(parts.scene, parts.properties, known, shapes, workers)
    return dict(zip(chosen, _placed(traced, known, chosen), strict=True))


def _lines_of_heads(
    scene: Scene, properties: Properties, parts: Parts, chosen: Sequence[int], workers: int | None
) -> dict[int, Centreline | None]:
    """Of the first mesh of each part."""
    heads = [parts.meshes[part][0] for part in chosen]
    scene, properties = scene.select(heads), properties.select(heads)
    known = analyse_shapes(scene, properties)
    traced = _trace(scene, properties, known, range(len(known.facts)), workers)
    return dict(zip(chosen, _placed(traced, known, range(len(chosen))), strict=True))


def _placed(
    lines: Mapping[int, Centreline | None], known: ShapeAnalysis, meshes: Sequence[int]
) -> list[Centreline | None]:
    """The line of each mesh: that of its shape where the mesh is."""
    found: list[Centreline | None] = [None] * len(meshes)
    row_of_shape: dict[int, list[int]] = {}
    for row, shape in enumerate(known.shape[list(meshes)].tolist()):
        row_of_shape.setdefault(shape, []).append(row)
    for shape, rows in row_of_shape.items():
        line = lines[shape]
        if line is not None:
            those = [meshes[row] for row in rows]
            for row, there in zip(rows, line.placed(known.turn[those], known.shift[those]), strict=True):
                found[row] = there
    return found


def _trace(
    scene: Scene, properties: Properties, known: ShapeAnalysis, shapes: Sequence[int], workers: int | None
) -> dict[int, Centreline | None]:
    """The lines of distinct shapes, where each occurs first."""
    first = known.first[list(shapes)]
    breadth = properties.obb_extents[first]
    flat = (breadth[:, 2] < _FLAT * breadth[:, 1]).tolist()
    lines: dict[int, Centreline | None] = dict.fromkeys(shapes)

    def explain(start: int, end: int) -> None:
        for number in range(start, end):
            triangles = _triangles(scene, properties, int(first[number]))
            lines[shapes[number]] = _explained(_outward(known, shapes[number], triangles), flat[number], triangles)

    for_ranges(explain, properties.n_triangles[first], workers)
    rest = [shape for shape, line in lines.items() if line is None]
    if rest:
        meshes = known.first[rest]
        found = trace_centrelines(scene.select(meshes), properties.select(meshes), workers)
        for shape, mesh, traced in zip(rest, meshes.tolist(), found, strict=True):
            triangles = _triangles(scene, properties, mesh)
            lines[shape] = _fitted(_outward(known, shape, triangles), traced, triangles)
    return lines


def _outward(known: ShapeAnalysis, shape: int, triangles: Floats) -> Facts:
    """What is known of a shape, with every face looking outward."""
    facts = known.facts[shape]
    discs = turned_outward(facts.discs, triangles)
    if all(new is old for new, old in zip(discs, facts.discs, strict=True)):
        return facts
    return replace(facts, discs=discs, ports=tuple(find_ports(list(discs))[0]))


def _explained(facts: Facts, flat: bool, triangles: Floats) -> Centreline | None:
    """The line of what is flat and round, and of what its mouths explain."""
    mouths = mouths_of(facts.ports, triangles)
    line = None
    if flat and (len(mouths) < 2 or are_on_one_axis(mouths)):
        line = axis_line(facts)
    return line or join_mouths(mouths, triangles)


def _triangles(scene: Scene, properties: Properties, mesh: int) -> Floats:
    """``(n, 3, 3)`` of a mesh, those that are finite [m], wound so that its surface as a whole looks outward."""
    vertices, faces = scene.mesh(mesh)
    corners: Floats = vertices[faces[np.all((faces >= 0) & (faces < len(vertices)), axis=1)]]
    corners = corners[np.isfinite(corners).all(axis=(1, 2))]
    return corners[:, ::-1] if properties.volume[mesh] < 0 else corners


def _fitted(facts: Facts, traced: Centreline | NotTube, triangles: Floats) -> Centreline | None:
    """A swept line that ends at the mouths; of what can't be swept the axis from face to face."""
    mouths = mouths_of(facts.ports, triangles)
    if isinstance(traced, Centreline) and traced.ends:
        fitted = fit_ends(traced, mouths, triangles)
        if fitted is not None:
            return fitted
    return axis_line(facts) or (run_inward(mouths[0], triangles) if len(mouths) == 1 else None)


def axis_line(facts: Facts) -> Centreline | None:
    """The axis of what is round from face to face; None where a shape isn't, or has no length."""
    if facts.turned < _TURNED or facts.sides < _SIDES:
        return None
    (low, low_radius, low_bore), (high, high_radius, high_bore) = _face(facts, -1.0), _face(facts, 1.0)
    if not high > low:
        return None
    points = facts.center + np.outer([low, high], facts.axis)
    return Centreline(
        (Branch(points, np.array([low_radius, high_radius]), np.array([low_bore, high_bore])),),
        (End(points[0], -facts.axis, low_radius, low_bore, 0), End(points[1], facts.axis, high_radius, high_bore, 0)),
        (),
        1.0,
    )


def _face(facts: Facts, sense: float) -> tuple[float, float, float]:
    """Where the axis ends in one sense, the outer radius of the face there, and that of its hole (NaN without one)."""
    faces = _axis_faces(facts, sense)
    for end, disc in faces:
        if _is_last(facts, sense, end, max(_AT_BORE * disc.inner, _CORE * facts.radius)):
            slack = max(_FACE * facts.length, _NEAR)
            there = [disc for at, disc in faces if abs(at - end) <= slack]
            outer, inner = max(disc.outer for disc in there), min(disc.inner for disc in there)
            return end, outer, inner if _LEAST_BORE * outer < inner < _MOST_BORE * outer else float("nan")
    end, radius = (facts.high, facts.outer[-1]) if sense > 0 else (facts.low, facts.outer[0])
    return end, float(radius), float("nan")


def _axis_faces(facts: Facts, sense: float) -> list[tuple[float, Disc]]:
    """The round faces about the axis that look in one sense, with their place along it, the outermost first."""
    faces = [
        (float((disc.center - facts.center) @ facts.axis), disc)
        for disc in facts.discs
        if sense * float(disc.normal @ facts.axis) > _FACING
        and same_line(facts.center, facts.axis, disc.center, disc.normal, _CENTRED * facts.radius)
    ]
    return sorted(faces, key=lambda row: -sense * row[0])


def _is_last(facts: Facts, sense: float, at: float, core: float) -> bool:
    """Whether nothing comes within a radius of the axis beyond a height: bolts stand around."""
    n = len(facts.inner)
    height = facts.low + (np.arange(n) + 0.5) * facts.length / n
    ahead = facts.inner[(sense * (height - at) > 0) & (facts.outer > 0)]
    return bool(np.all(ahead > core))
