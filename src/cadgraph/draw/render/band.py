"""One band of rows of a picture, from rays to linear colours.

A pixel gets one ray. Where neighbours differ (another mesh, a step in depth, a sharp edge) pixels get a grid of rays,
following edges as far as they lead: smooth surfaces cost little, edges and thin things are anti-aliased.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
import numpy.typing as npt

from cadgraph.draw.render.camera import Camera
from cadgraph.draw.render.caster import Caster
from cadgraph.draw.render.color import Colors
from cadgraph.draw.render.crease import CornerNormals
from cadgraph.draw.render.light import SOFTNESS, Lamps, shade, sky_seen, smooth, sun_seen
from cadgraph.draw.render.outline import is_edge, line_strength
from cadgraph.draw.render.vector import dot
from cadgraph.model.scene import Ints

__all__ = ["HALO", "Band", "Setting", "draw_band"]

Singles = npt.NDArray[np.float32]
Indices = npt.NDArray[np.int32]
Bools = npt.NDArray[np.bool_]

HALO = 6
"""Rows above and below a band that it also looks at, so that neither light nor lines show where bands meet."""

_ROUNDS = 3  # of following edges into pixels whose own ray missed them
_HATCH_PERIOD = 10.0  # [px]
_FLOOR_SPREAD = 0.5  # how far the floor reaches beyond what stands on it, as share of the diagonal


@dataclass(frozen=True)
class Setting:
    """All that a band needs to know.

    Args:
        caster: the meshes that are drawn.
        normals: of the scene.
        face_offsets: of the scene.
        camera: where from.
        lights: the lamps.
        albedo: ``(n_paints, n_meshes, 3)`` linear, for as many pictures that differ in colours only.
        hatched: ``(n_paints, n_meshes)``.
        samples: rays along each side of a pixel at edges.
        sky_rays: rays to the sky from each pixel; 0: no ambient occlusion and no shadows.
        lines: strength of the feature lines, 0..1.
        floor: height of the floor that takes the shadows [m], about the caster's centre; None: no floor.
        reach: of ambient occlusion [m].
        ghost: whether these meshes are only hinted at.
    """

    caster: Caster
    normals: CornerNormals
    face_offsets: Ints
    camera: Camera
    lights: Lamps
    albedo: Colors
    hatched: Bools
    samples: int
    sky_rays: int
    lines: float
    floor: float | None
    reach: float
    ghost: bool = False


@dataclass(frozen=True)
class Band:
    """Rows of a picture, before the background.

    Args:
        color: ``(n_paints, height, width, 3)`` linear, already multiplied by ``cover``.
        cover: ``(height, width)`` share of the pixel that surfaces and lines take.
        floor: ``(height, width)`` light on the floor, 1 where there is no shadow.
        depth: ``(height, width)`` distance of the nearest surface along the ray [m].
    """

    color: Singles
    cover: Singles
    floor: Singles
    depth: Singles


@dataclass(frozen=True)
class _Met:
    """What rays met: mesh (-1: nothing), distance, unit normals on the viewer's side, positions, views to the eye."""

    mesh: Indices
    distance: Singles
    flat: Singles
    normal: Singles
    point: Singles
    view: Singles


def draw_band(setting: Setting, top: int, bottom: int) -> Band:
    """Draws rows ``top`` up to ``bottom`` of the picture."""
    camera = setting.camera
    first, last = max(0, top - HALO), min(camera.height, bottom + HALO)
    height, width = last - first, camera.width
    rows, columns = np.divmod(np.arange(height * width), width)
    rows += first
    met = _cast(setting, columns + 0.5, rows + 0.5)
    shape = (height, width)
    pixel = _pixel_sizes(camera, met.distance)
    light, floor_light = _light(setting, met, columns, rows, pixel, shape)
    hit = np.flatnonzero(met.mesh >= 0)
    color = np.zeros((len(setting.albedo), height * width, 3), np.float32)
    color[:, hit] = _shade(setting, met, hit, light[hit], columns[hit] + 0.5, rows[hit] + 0.5)
    cover = (met.mesh >= 0).astype(np.float32)
    depth = met.distance.copy()
    fine = is_edge(
        met.mesh.reshape(shape), met.normal.reshape(*shape, 3), met.point.reshape(*shape, 3), pixel.reshape(shape)
    ).reshape(-1)
    if setting.samples > 1 or setting.lines > 0:
        _refine(setting, met, np.flatnonzero(fine), (columns, rows), light, shape, (color, cover, depth))
    keep = slice(top - first, bottom - first)
    return Band(
        color.reshape(-1, *shape, 3)[:, keep], cover.reshape(shape)[keep], floor_light[keep], depth.reshape(shape)[keep]
    )


def _cast(setting: Setting, columns: npt.ArrayLike, rows: npt.ArrayLike) -> _Met:
    origins, directions = setting.camera.rays(columns, rows)
    start, towards = setting.caster.local(origins), directions.astype(np.float32)
    hits = setting.caster.first(start, towards)
    mesh = (np.searchsorted(setting.face_offsets, hits.face, side="right") - 1).astype(np.int32)
    mesh[hits.face < 0] = -1
    hit = np.flatnonzero(hits.face >= 0)
    normal = np.zeros((len(mesh), 3), np.float32)
    flat = hits.normal
    flat *= np.where(dot(flat, towards) > 0, np.float32(-1), np.float32(1))[:, None]
    n = setting.normals.at(hits.face[hit], mesh[hit], hits.u[hit], hits.v[hit])
    n *= np.where(dot(n, flat[hit]) < 0, np.float32(-1), np.float32(1))[:, None]
    length = np.sqrt(dot(n, n))
    normal[hit] = np.where((length > 1e-6)[:, None], n / np.maximum(length, 1e-6)[:, None], flat[hit])
    distance = hits.distance
    point = start + towards * np.where(hits.face >= 0, distance, 0)[:, None]
    return _Met(mesh, distance, flat, normal, point, -towards)


def _pixel_sizes(camera: Camera, distance: Singles) -> Singles:
    """Size of a pixel at each distance [m]; zero where nothing was met."""
    found = np.isfinite(distance)
    scale = np.where(found, distance if camera.projection == "perspective" else 1, 0)
    return (scale * camera.pixel_size).astype(np.float32)


def _light(
    setting: Setting, met: _Met, columns: Ints, rows: Ints, pixel: Singles, shape: tuple[int, int]
) -> tuple[Singles, Singles]:
    """Sky and sun seen from each pixel's surface ``(n, 2)``, and the light on the floor ``shape``."""
    n = len(met.mesh)
    values = np.ones((n, 2), np.float32)
    if not setting.sky_rays:
        return values, np.ones(shape, np.float32)
    on_floor, ground, fade = _floor_points(setting, met)
    known = (met.mesh >= 0) | on_floor
    points = np.where(on_floor[:, None], ground, met.point)
    normals = met.normal.copy()
    normals[on_floor] = (0, 0, 1)
    flat = np.where(on_floor[:, None], normals, met.flat)
    # Nothing hides the sky from floor that is further away than ambient occlusion reaches.
    open_sky = on_floor & (1 - fade > setting.reach / (_FLOOR_SPREAD * setting.caster.diagonal))
    at = np.flatnonzero(known & ~open_sky)
    lift = setting.caster.diagonal * 2e-5 + pixel[at] * 0.05
    start = points[at] + flat[at] * lift[:, None]
    reach = setting.reach
    values[at, 0] = sky_seen(setting.caster, start, flat[at], columns[at], rows[at], reach, setting.sky_rays)
    faces_lamp = flat @ setting.lights.key > SOFTNESS
    lit = np.flatnonzero(known & faces_lamp)
    start = points[lit] + flat[lit] * (setting.caster.diagonal * 2e-4)
    # A flat face that turns from (a part of) the lamp while the curve it stands for is lit is not in shadow: its
    # outline would show.
    values[known, 1] = (normals[known] @ setting.lights.key > 0) & ~faces_lamp[known]
    values[lit, 1] = sun_seen(
        setting.caster, start, setting.lights.key, columns[lit], rows[lit], setting.caster.diagonal * 2
    )
    size = pixel.copy()
    size[on_floor] = setting.caster.diagonal * 1e-3
    soft = (
        smooth(
            np.ascontiguousarray(values.T).reshape(2, *shape),
            np.ascontiguousarray(points.T).reshape(3, *shape),
            np.ascontiguousarray(normals.T).reshape(3, *shape),
            known.reshape(shape),
            size.reshape(shape),
        )
        .reshape(2, -1)
        .T
    )
    values = np.where(known[:, None], soft, 1).astype(np.float32)
    floor = np.ones(n, np.float32)
    shadow = 1 - (1 - 0.6 * (1 - values[:, 0])) * (1 - 0.3 * (1 - values[:, 1]))
    floor[on_floor] -= (shadow * fade)[on_floor]
    return values, floor.reshape(shape)


def _floor_points(setting: Setting, met: _Met) -> tuple[Bools, Singles, Singles]:
    """Where rays that met nothing meet the floor: which do, the points, and how strongly shadows show there."""
    down = met.view[:, 2] > 1e-3
    on_floor = (met.mesh < 0) & down
    if setting.floor is None:
        on_floor[:] = False
    if not on_floor.any():
        return on_floor, met.point, np.zeros(len(on_floor), np.float32)
    step = np.where(on_floor, (met.point[:, 2] - np.float32(setting.floor or 0)) / np.where(down, met.view[:, 2], 1), 0)
    on_floor &= step > 0
    point = met.point - met.view * step[:, None]
    half = ((setting.caster.high - setting.caster.low)[:2] / 2).astype(np.float32)
    spread = _FLOOR_SPREAD * setting.caster.diagonal
    beyond = np.sqrt((np.maximum(np.abs(point[:, :2]) - half, 0) ** 2).sum(axis=1)) / spread
    on_floor &= beyond < 1
    fade = np.clip(1 - beyond, 0, 1).astype(np.float32)
    return on_floor, point, fade


def _shade(
    setting: Setting, met: _Met, at: Ints, light: Singles, columns: npt.ArrayLike, rows: npt.ArrayLike
) -> Singles:
    """Colours ``(n_paints, n, 3)`` of the samples ``at``."""
    diffuse, gloss = shade(met.normal[at], met.view[at], light[:, 0], light[:, 1], setting.lights)
    mesh = met.mesh[at]
    colors = np.empty((len(setting.albedo), len(at), 3), np.float32)
    for color, albedo, hatched in zip(colors, setting.albedo, setting.hatched, strict=True):
        lit = diffuse
        striped = hatched[mesh]
        if striped.any():
            phase = ((np.asarray(columns) + np.asarray(rows)) / _HATCH_PERIOD) % 1.0
            stripe = np.clip((np.abs(phase - 0.5) - 0.32) * _HATCH_PERIOD, 0, 1)
            lit = diffuse * (1 - np.where(striped, 0.3 * stripe, 0)).astype(np.float32)
        np.multiply(albedo[mesh], lit[:, None], out=color)
        color += gloss[:, None]
    return colors


def _refine(
    setting: Setting,
    base: _Met,
    fine: Ints,
    pixels: tuple[Ints, Ints],
    light: Singles,
    shape: tuple[int, int],
    result: tuple[Singles, Singles, Singles],
) -> None:
    """Draws the pixels at edges again with a grid of rays each, and the lines along these edges."""
    n = setting.samples
    slot = np.full(len(base.mesh), -1, np.int64)
    grids: list[_Met] = []
    known = 0
    todo = fine
    for _ in range(_ROUNDS):
        if not len(todo):
            break
        slot[todo] = known + np.arange(len(todo))
        grids.append(_cast_grid(setting, pixels[0][todo], pixels[1][todo], n))
        known += len(todo)
        todo = _followed(base.mesh, grids[-1].mesh.reshape(-1, n, n), todo, slot, shape) if n > 1 else todo[:0]
    if not grids:
        return
    grid = _joined(grids)
    order = np.argsort(slot, kind="stable")[-known:]
    strength = np.zeros((known, n, n), np.float32)
    if setting.lines > 0:
        size = _pixel_sizes(setting.camera, grid.distance.reshape(known, -1).min(axis=1))
        behind = (base.mesh, base.normal, base.point)
        strength = setting.lines * line_strength(
            grid.mesh, grid.normal, grid.point, behind, order, slot, shape, size, n
        )
    parent = np.repeat(order, n * n)
    hit = np.flatnonzero(grid.mesh >= 0)
    near = _nearby_light(base, grid.mesh[hit], grid.normal[hit], parent[hit], light, shape)
    columns, rows = _grid_places(pixels[0][order], pixels[1][order], n)
    drawn = strength.reshape(-1)
    colors = np.zeros((len(setting.albedo), known * n * n, 3), np.float32)
    colors[:, hit] = _shade(setting, grid, hit, near, columns[hit], rows[hit]) * (1 - drawn[hit])[:, None]
    cover = np.where(grid.mesh >= 0, 1, drawn).astype(np.float32)
    color_out, cover_out, depth_out = result
    color_out[:, order] = colors.reshape(-1, known, n * n, 3).mean(axis=2)
    cover_out[order] = cover.reshape(known, n * n).mean(axis=1)
    depth_out[order] = grid.distance.reshape(known, n * n).min(axis=1)


def _grid_places(columns: Ints, rows: Ints, n: int) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Column and row of each sample, pixel by pixel, row by row within a pixel."""
    step = (np.arange(n) + 0.5) / n
    across = np.tile(step, n)
    down = np.repeat(step, n)
    return (columns[:, None] + across).reshape(-1), (rows[:, None] + down).reshape(-1)


def _cast_grid(setting: Setting, columns: Ints, rows: Ints, n: int) -> _Met:
    return _cast(setting, *_grid_places(columns, rows, n))


def _joined(grids: list[_Met]) -> _Met:
    if len(grids) == 1:
        return grids[0]
    return _Met(*(np.concatenate([getattr(grid, field.name) for grid in grids]) for field in fields(_Met)))


def _followed(base_mesh: Indices, grid_mesh: Indices, pixels: Ints, slot: Ints, shape: tuple[int, int]) -> Ints:
    """Pixels without a grid yet whose own ray met something else than the nearest samples of a neighbour's grid."""
    height, width = shape
    row, column = np.divmod(pixels, width)
    found = []
    for down, across, side in ((0, 1, grid_mesh[:, :, -1]), (0, -1, grid_mesh[:, :, 0]),
                               (1, 0, grid_mesh[:, -1, :]), (-1, 0, grid_mesh[:, 0, :])):  # fmt: skip
        inside = (row + down >= 0) & (row + down < height) & (column + across >= 0) & (column + across < width)
        neighbor = pixels[inside] + down * width + across
        differs = (side[inside] != base_mesh[neighbor][:, None]).any(axis=1)
        found.append(neighbor[differs & (slot[neighbor] < 0)])
    return np.unique(np.concatenate(found))


def _nearby_light(
    base: _Met, mesh: Indices, normal: Singles, parent: Ints, light: Singles, shape: tuple[int, int]
) -> Singles:
    """Sky and sun for samples: from the pixel near by that shows the same mesh from the most similar side."""
    height, width = shape
    row, column = np.divmod(parent, width)
    best = np.full(len(parent), -2.0, np.float32)
    chosen = parent.copy()
    for down in (0, -1, 1):
        for across in (0, -1, 1):
            neighbor = np.clip(row + down, 0, height - 1) * width + np.clip(column + across, 0, width - 1)
            match = dot(base.normal[neighbor], normal)
            match[base.mesh[neighbor] != mesh] = -1.5
            better = match > best + 0.02
            best[better] = match[better]
            chosen[better] = neighbor[better]
    values = light[chosen]
    values[best < -1] = (0.75, 0.8)
    return values
