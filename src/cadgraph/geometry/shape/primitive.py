"""Which simple solid each mesh is, how well, and what it looks like along its axis."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadgraph.geometry.kernels.parallel import compiled, for_ranges
from cadgraph.geometry.mesh.box import principal_axes
from cadgraph.geometry.mesh.properties import DEGENERATE_RATIO
from cadgraph.geometry.shape.residual import box_residual, extrusion_residual, fit_sphere, fit_torus, turned_residual
from cadgraph.geometry.shape.revolution import N_SLICES, classify_faces, count_sides, profile, skew, symmetry
from cadgraph.model.parts import Bools, Properties
from cadgraph.model.scene import Faces, Floats, Ints, Scene

__all__ = ["KINDS", "MAX_RESIDUAL", "SURFACES", "Primitives", "fit_primitives"]

# The simplest first: the first that fits about as well as any names the part.
KINDS = ("plane", "box", "sphere", "cylinder", "cone", "torus", "extrusion", "revolved")
SURFACES = ("planar", "cylindrical", "conical", "toroidal", "spherical", "other")
# A fit is good below this residual. Ours: float32 and chamfers of a few percent pass, a chamfered nut's corners don't.
MAX_RESIDUAL = 0.02
# A plane must be thinner: a gasket of 1 mm is no sheet.
MAX_SHEET = 1e-3
# A simpler solid must fit this much as well as the best one: a ring is nearly a short tube, and a disc a plate.
_AS_GOOD = 0.005
# Normals may miss the axis of a turned part by this much on average: triangles of a 6-sided tube by 0.17.
MAX_SKEW = 0.2
# A wall is round where its flat sides come no nearer to the axis than this share of the radius: five sides do.
MIN_ROUND = 0.84
# Of the slices, the share that must have a bore for a part to count as hollow.
_BORED = 0.9
# Fewer sides are a polygon, not a coarse circle.
_MIN_SIDES = 5
# Principal moments that differ by less than this share of them have no axes. Ours: float32 sources leave 1e-6.
_ISOTROPIC = 1e-5
# How far the normals of a coarse turned part without walls may miss its axis on average, and how much more they may
# with bolt holes or the like in it.
_COARSE = 0.06
_ROUGH = 0.08


@dataclass(frozen=True)
class Primitives:
    """Fits of simple solids to all meshes, one row each.

    Lengths are in metres; residuals are root mean squares over the area, divided by the middle extent of the oriented
    box, inf where a solid is out of the question. ``plane`` means a sheet without thickness, ``extrusion`` any constant
    section along an axis. ``revolved`` means any surface of revolution; its residual is the mean sine by which normals
    miss the axis, less what the flat sides of a polygon explain, and inf where spokes or holes break the round.

    Args:
        kind: ``(n,)`` index into ``KINDS`` of the simplest solid that fits, -1 for none.
        residual: ``(n, len(KINDS))``.
        axis: ``(n, 3)`` unit axis of the best turned or extruded fit; else the longest axis of the oriented box.
        center: ``(n, 3)`` middle of the part on that axis.
        height: ``(n,)`` extent along the axis.
        radius: ``(n,)`` greatest distance of the surface from the axis.
        bore: ``(n,)`` least radius of the opening along the whole axis, 0 where it is not open.
        taper: ``(n, 2)`` outer radius at the lower and the upper end.
        major: ``(n,)`` major radius of the torus fit, 0 if there is none.
        minor: ``(n,)`` minor radius of the torus fit, or radius of the sphere fit if that is the kind.
        skew: ``(n,)`` mean share of the normals that points around the axis: 0 for a finely turned part.
        order: ``(n,)`` rotational symmetry about the axis: 0 where nothing tells directions apart, 1 for none, else
            the number of spokes, bolt holes or sides.
        sides: ``(n, 2)`` flat sides of the outer wall and of the bore, 0 where there is no such wall.
        outer: ``(n, N_SLICES)`` outer radius at even heights from low to high.
        inner: ``(n, N_SLICES)`` bore at even heights, 0 where the axis is inside the material.
        shares: ``(n, len(SURFACES))`` share of the area by kind of surface about the axis.
        hollow: ``(n,)`` whether it is open along the axis.
        wall: ``(n,)`` least thickness between outer radius and bore, NaN where not hollow.
    """

    kind: Ints
    residual: Floats
    axis: Floats
    center: Floats
    height: Floats
    radius: Floats
    bore: Floats
    taper: Floats
    major: Floats
    minor: Floats
    skew: Floats
    order: Ints
    sides: Ints
    outer: Floats
    inner: Floats
    shares: Floats
    hollow: Bools
    wall: Floats

    def name(self, index: int) -> str | None:
        """The kind of one mesh, ``None`` if no simple solid fits."""
        return KINDS[self.kind[index]] if self.kind[index] >= 0 else None


def fit_primitives(scene: Scene, properties: Properties, workers: int | None = None) -> Primitives:
    """Fits simple solids to all meshes.

    Args:
        scene: any.
        properties: of its meshes.
        workers: threads; all processors by default. The outcome does not depend on it.

    Returns:
        One row for each mesh; those without area have kind -1 and infinite residuals.
    """
    n = scene.n_meshes
    vertices = np.ascontiguousarray(scene.vertices, np.float64)
    faces = np.ascontiguousarray(scene.faces, np.int32)
    residual = np.full((n, len(KINDS)), np.inf)
    axis = properties.obb_axes[:, 0].copy()
    center = properties.obb_center.copy()
    values = np.zeros((n, 9))
    counts = np.zeros((n, 3), np.int64)
    outer, inner = np.zeros((n, N_SLICES)), np.zeros((n, N_SLICES))
    shares = np.zeros((n, len(SURFACES)))

    def kernel(first: int, last: int) -> None:
        _fit_range(
            vertices, faces, scene.vertex_offsets, scene.face_offsets, first, last, properties.area,
            properties.volume, properties.centroid, properties.inertia, properties.obb_center, properties.obb_axes,
            properties.obb_extents, residual, axis, center, values, counts, outer, inner, shares,
        )  # fmt: skip

    for_ranges(kernel, np.diff(scene.face_offsets), workers)
    fits = residual <= np.where(np.arange(len(KINDS)) == 0, MAX_SHEET, MAX_RESIDUAL)
    fits &= residual <= residual.min(axis=1, initial=np.inf, keepdims=True) + _AS_GOOD
    hollow = values[:, 2] > 0
    return Primitives(
        kind=np.where(fits.any(axis=1), fits.argmax(axis=1), -1).astype(np.int64),
        residual=residual,
        axis=axis,
        center=center,
        height=values[:, 0].copy(),
        radius=values[:, 1].copy(),
        bore=values[:, 2].copy(),
        taper=values[:, 3:5].copy(),
        major=values[:, 5].copy(),
        minor=values[:, 6].copy(),
        skew=values[:, 7].copy(),
        order=counts[:, 0].copy(),
        sides=counts[:, 1:].copy(),
        outer=outer,
        inner=inner,
        shares=shares,
        hollow=hollow,
        wall=np.where(hollow, values[:, 8], np.nan),
    )


@compiled
def _fit_range(
    vertices: Floats, faces: Faces, v_offsets: Ints, f_offsets: Ints, first: int, last: int, area: Floats,
    volume: Floats, centroid: Floats, inertia: Floats, obb_center: Floats, obb_axes: Floats, obb_extents: Floats,
    residual: Floats, axis: Floats, center: Floats, values: Floats, counts: Ints, outer: Floats, inner: Floats,
    shares: Floats,
) -> None:  # fmt: skip
    for i in range(first, last):
        if not area[i] > 0.0:
            continue
        v0, v1, f0, f1 = v_offsets[i], v_offsets[i + 1], f_offsets[i], f_offsets[i + 1]
        corners, normals, areas = np.empty((f1 - f0, 9)), np.empty((f1 - f0, 3)), np.empty(f1 - f0)
        sense = -1.0 if volume[i] < 0.0 else 1.0
        m = _gather(vertices[v0:v1], faces[f0:f1], centroid[i], sense, corners, normals, areas)
        if m == 0:
            continue
        corners, normals, areas = corners[:m], normals[:m], areas[:m]
        _fit_mesh(
            corners, normals, areas, inertia[i], obb_center[i] - centroid[i], obb_axes[i], obb_extents[i],
            residual[i], axis[i], center[i], values[i], counts[i], outer[i], inner[i], shares[i],
        )  # fmt: skip
        for c in range(3):
            center[i, c] += centroid[i, c]


@compiled
def _gather(
    points: Floats, faces: Faces, origin: Floats, sense: float, corners: Floats, normals: Floats, areas: Floats
) -> int:
    """Triangles with area relative to an origin; returns how many."""
    m = 0
    for f in range(len(faces)):
        if faces[f].min() < 0 or faces[f].max() >= len(points):
            continue
        for c in range(3):
            corners[m, c] = points[faces[f, 0], c] - origin[c]
            corners[m, 3 + c] = points[faces[f, 1], c] - origin[c]
            corners[m, 6 + c] = points[faces[f, 2], c] - origin[c]
        ux, uy, uz = corners[m, 3:6] - corners[m, :3]
        wx, wy, wz = corners[m, 6:] - corners[m, :3]
        x, y, z = uy * wz - uz * wy, uz * wx - ux * wz, ux * wy - uy * wx
        double = np.sqrt(x * x + y * y + z * z)
        longest = max(ux * ux + uy * uy + uz * uz, wx * wx + wy * wy + wz * wz)
        if not double > DEGENERATE_RATIO * longest:
            continue
        normals[m, 0], normals[m, 1], normals[m, 2] = sense * x / double, sense * y / double, sense * z / double
        areas[m] = 0.5 * double
        m += 1
    return m


@compiled
def _fit_mesh(
    corners: Floats, normals: Floats, areas: Floats, inertia: Floats, box_center: Floats, box_axes: Floats,
    extents: Floats, residual: Floats, axis: Floats, center: Floats, values: Floats, counts: Ints, outer: Floats,
    inner: Floats, shares: Floats,
) -> None:  # fmt: skip
    m = len(areas)
    scale = extents[1] if extents[1] > 0.0 else extents[0]
    middles = np.empty((m, 3))
    for f in range(m):
        for c in range(3):
            middles[f, c] = (corners[f, c] + corners[f, 3 + c] + corners[f, 6 + c]) / 3.0
    candidates = np.empty((9, 3))
    spare = np.empty(3)
    moments = np.zeros((3, 3))
    for f in range(m):
        for r in range(3):
            for c in range(3):
                moments[r, c] += areas[f] * normals[f, r] * normals[f, c]
    candidates[3:6] = box_axes
    for k, tensor in ((0, inertia), (6, moments)):
        principal_axes(tensor, candidates[k : k + 3], spare)
        # A cube looks alike from everywhere: its principal axes are rounding noise.
        if spare.max() - spare.min() <= _ISOTROPIC * spare.max():
            candidates[k : k + 3] = box_axes

    best, least = 0, np.inf
    for k in range(9):
        missed = skew(middles, normals, areas, candidates[k])
        # Later axes must be better by more than rounding; a sphere has no axis.
        if missed < least - 1e-9:
            best, least = k, missed
    values[7] = least
    turned = least <= MAX_SKEW
    along, shortest = 0, np.inf
    for k in range(9):
        low, high = _span(corners, candidates[k])
        drift = extrusion_residual(corners, normals, areas, candidates[k], low, high)
        if drift < shortest - 1e-9 * scale:
            along, shortest = k, drift
    residual[6] = shortest / scale

    axis[:] = candidates[best] if turned else (candidates[along] if residual[6] <= MAX_RESIDUAL else box_axes[0])
    # A definite sense: the greatest component is positive.
    lead = 0
    for c in range(1, 3):
        if abs(axis[c]) > abs(axis[lead]) + 1e-6:
            lead = c
    if axis[lead] < 0.0:
        for c in range(3):
            axis[c] = -axis[c]
    low, high = _span(corners, axis)
    segments, owners = np.empty((m, 4)), np.empty(m, np.int64)
    # Sections need an axis in the middle: that of the box where the part is not turned about its centroid.
    shift = np.zeros(3)
    if not turned:
        for c in range(3):
            shift[c] = box_center[c]
        for f in range(m):
            for c in range(9):
                corners[f, c] -= shift[c % 3]
        low, high = _span(corners, axis)
    profile(corners, normals, axis, low, high, segments, owners, outer, inner)
    radius, nearest = _reach(corners, areas, normals, axis)
    for c in range(3):
        center[c] = shift[c] + 0.5 * (low + high) * axis[c]
    values[0], values[1] = high - low, radius
    _bore(outer, inner, values)
    counts[0] = symmetry(corners, areas, axis, low, high, radius)
    counts[1] = count_sides(corners, normals, axis, radius, 1.0)
    counts[2] = count_sides(corners, normals, axis, values[2], -1.0) if values[2] > 0.0 else 0
    # Triangles of a polygon's sides miss the axis by this much; without a wall to count them, of a coarse torus.
    residual[7] = max(0.0, least - (1.15 / counts[1] if counts[1] >= _MIN_SIDES else _COARSE))
    is_round = turned and residual[7] <= _ROUGH and nearest >= MIN_ROUND * radius
    # The sides of the polygon itself break nothing.
    broken = counts[0] != 0 and counts[0] != counts[1]
    if broken or not is_round:
        residual[7] = np.inf
    if not is_round and counts[0] in (1, 2):
        # Walls to two sides make no bore.
        values[2] = 0.0
    classify_faces(corners, normals, areas, axis, is_round, shares)
    for f in range(m):
        for c in range(9):
            corners[f, c] += shift[c % 3]
    _fit_solids(
        corners, normals, areas, axis, low, high, scale, extents, box_center, box_axes, is_round, residual, values
    )


@compiled
def _span(corners: Floats, axis: Floats) -> tuple[float, float]:
    low, high = np.inf, -np.inf
    for f in range(len(corners)):
        for v in range(0, 9, 3):
            h = corners[f, v] * axis[0] + corners[f, v + 1] * axis[1] + corners[f, v + 2] * axis[2]
            low, high = min(low, h), max(high, h)
    return low, high


@compiled
def _reach(corners: Floats, areas: Floats, normals: Floats, axis: Floats) -> tuple[float, float]:
    """The greatest distance from the axis, and how near the faces that reach it come at their middles."""
    radius = 0.0
    for f in range(len(corners)):
        for v in range(0, 9, 3):
            radius = max(radius, _distance(corners[f, v], corners[f, v + 1], corners[f, v + 2], axis))
    nearest = radius
    for f in range(len(corners)):
        along = abs(normals[f, 0] * axis[0] + normals[f, 1] * axis[1] + normals[f, 2] * axis[2])
        if along > 0.5:
            continue
        on_wall = True
        for v in range(0, 9, 3):
            d = _distance(corners[f, v], corners[f, v + 1], corners[f, v + 2], axis)
            on_wall = on_wall and d > 0.99 * radius
        if not on_wall:
            continue
        for e in range(3):
            a, b = 3 * e, 3 * ((e + 1) % 3)
            d = _distance(
                0.5 * (corners[f, a] + corners[f, b]),
                0.5 * (corners[f, a + 1] + corners[f, b + 1]),
                0.5 * (corners[f, a + 2] + corners[f, b + 2]),
                axis,
            )
            nearest = min(nearest, d)
    return radius, nearest


@compiled
def _distance(x: float, y: float, z: float, axis: Floats) -> float:
    h = x * axis[0] + y * axis[1] + z * axis[2]
    return float(np.sqrt(max(x * x + y * y + z * z - h * h, 0.0)))


@compiled
def _bore(outer: Floats, inner: Floats, values: Floats) -> None:
    """Radius of the opening along the whole axis, and the least wall around it."""
    n_bored, n_filled = 0, 0
    least, wall = np.inf, np.inf
    for k in range(len(outer)):
        n_filled += outer[k] > 0.0
        if inner[k] > 0.0:
            n_bored += 1
            least, wall = min(least, inner[k]), min(wall, outer[k] - inner[k])
    if n_bored > 0 and n_bored >= _BORED * n_filled:
        values[2], values[8] = least, max(wall, 0.0)


@compiled
def _fit_solids(
    corners: Floats, normals: Floats, areas: Floats, axis: Floats, low: float, high: float, scale: float,
    extents: Floats, box_center: Floats, box_axes: Floats, is_round: bool, residual: Floats, values: Floats,
) -> None:  # fmt: skip
    residual[0] = extents[2] / scale
    residual[1] = box_residual(corners, normals, areas, box_center, box_axes, extents) / scale
    sphere, torus = np.empty(4), np.zeros(3)
    residual[2] = fit_sphere(corners, normals, areas, sphere) / scale
    if residual[2] <= MAX_RESIDUAL:
        values[6] = sphere[3]
    if not is_round:
        return
    radius, bore = values[1], values[2]
    inside = (bore, bore) if bore > 0.0 else (-1.0, -1.0)
    residual[3] = turned_residual(corners, normals, areas, axis, low, high, (radius, radius), inside) / scale
    tips = _end_radii(corners, axis, low, high)
    values[3], values[4] = tips[0], tips[1]
    holes = (tips[2], tips[3]) if bore > 0.0 else (-1.0, -1.0)
    residual[4] = turned_residual(corners, normals, areas, axis, low, high, (tips[0], tips[1]), holes) / scale
    residual[5] = fit_torus(corners, normals, areas, axis, torus) / scale
    if residual[5] <= MAX_RESIDUAL:
        values[5], values[6] = torus[1], torus[2]


@compiled
def _end_radii(corners: Floats, axis: Floats, low: float, high: float) -> tuple[float, float, float, float]:
    """Greatest radius at the lower and upper end, and least radius there."""
    slack = 1e-3 * (high - low)
    most_low = most_high = 0.0
    least_low = least_high = np.inf
    for f in range(len(corners)):
        for v in range(0, 9, 3):
            x, y, z = corners[f, v], corners[f, v + 1], corners[f, v + 2]
            h = x * axis[0] + y * axis[1] + z * axis[2]
            d = _distance(x, y, z, axis)
            if h <= low + slack:
                most_low, least_low = max(most_low, d), min(least_low, d)
            if h >= high - slack:
                most_high, least_high = max(most_high, d), min(least_high, d)
    return most_low, most_high, least_low, least_high
