"""OpenUSD to a scene.

What this reader notes in ``Scene.diagnostics``; meshes with a code of the first row are not in the scene:

- left out: ``hidden``, ``other-purpose``, ``unsupported-geometry``, ``empty-mesh`` (no points or no usable face),
  ``degenerate-mesh`` (no area), ``invalid-transform``, ``invalid-size`` (of a built-in shape), ``too-far``,
  ``unreadable``;
- not opened: ``outside-asset`` (beside or above the folder of the scene, and not named in ``load.asset_roots``);
- not found: ``missing-reference``, ``missing-payload``, ``missing-layer``, ``missing-prototype``;
- repaired: ``invalid-units``, ``invalid-up-axis``, ``invalid-points``, ``invalid-indices``, ``invalid-face-counts``,
  ``projective-transform``, ``invalid-instancer``, ``twisted-faces``, ``overlapping-subsets``;
- odd: ``mixed-units``, ``mixed-up-axis``;
- assumed: ``missing-units``, ``missing-up-axis``, ``control-cage``, ``unusual-size``;
- anything else that the USD library says: ``usd-warning``.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
from pxr import Tf, UsdGeom, UsdUtils

from cadgraph._io.digest import sha256_of
from cadgraph._io.text import printable
from cadgraph.errors import LoadError
from cadgraph.load.budget import Budget
from cadgraph.load.packing import Z_UP_FROM, Notes, Piece, metres_z_up, pack
from cadgraph.load.usd_assets import file_of, is_there, open_stage
from cadgraph.load.usd_color import Materials, mean_display_color
from cadgraph.load.usd_mesh import CutMesh, RawMesh, cut_meshes
from cadgraph.load.usd_units import note_mixed_units
from cadgraph.load.usd_walk import Placement, Walk, message_of
from cadgraph.model.scene import Faces, Floats, Ints, Scene, Source

if TYPE_CHECKING:
    from cadgraph.config import LoadConfig

__all__ = ["read"]

Color = npt.NDArray[np.float64]

# Of notes on meshes that were loaded all the same, some examples are enough.
_ABRIDGED = (
    "control-cage",
    "invalid-points",
    "invalid-indices",
    "invalid-face-counts",
    "twisted-faces",
    "missing-payload",
    "missing-reference",
)
_LEAST_UNIT, _GREATEST_UNIT = 1e-10, 1e6  # [m] ours: from an angstrom to a thousand kilometres
_MAX_WARNINGS = 20  # different messages of the USD library that are kept


def read(path: Path, config: LoadConfig) -> Scene:
    """Reads a USD file with all that it refers to.

    Args:
        path: of the root layer or package.
        config: how to read it.

    Returns:
        The scene; ``source`` has no path and no hash yet.

    Raises:
        LoadError: the USD library can't open it, or it holds no mesh to load.
    """
    notes = Notes()
    # While a delegate listens, the library prints nothing.
    delegate = UsdUtils.CoalescingDiagnosticDelegate()
    try:
        try:
            stage, budget = open_stage(path, config, notes)
        except Tf.ErrorException as error:
            reason = _reason(error, path)
            if "bad_alloc" in reason:
                # Too little for a sound file, or a damaged one that promises too much: nobody can tell.
                told = "opening it takes more memory than it may (load.memory)"
                raise LoadError(f"{path}: {told}; raise that, or export it again where it is damaged") from None
            raise LoadError(f"{path}: not readable as USD ({reason}); it is damaged; copy or export it again") from None
        scene = _scene(stage, config, notes, budget, lambda: _take_warnings(delegate, path, notes))
    finally:
        delegate.TakeUncoalescedDiagnostics()
    if not scene.n_meshes:
        raise LoadError(f"{path}: opens, but holds no mesh to load{_what_was_found(notes)}")
    return scene


def _scene(stage: Any, config: LoadConfig, notes: Notes, budget: Budget, take_warnings: Any) -> Scene:
    source, world_from_source = _units(stage, notes)
    note_mixed_units(stage, notes)
    walk = Walk(stage, config.purposes, config.invisible, config.time, config.sides, notes, budget)
    placements = []
    for placement in walk.placements():
        if placement.skipped:
            notes.add(*placement.skipped, placement.path)
        else:
            placements.append(placement)
    keys = list(walk.geometries)
    meshes = dict(
        zip(keys, zip(walk.geometries.values(), cut_meshes(list(walk.geometries.values())), strict=True), strict=True)
    )
    of_key = {key: len(cut.corners) for key, (_, cut) in meshes.items()}
    budget.check_placed(sum(of_key[str(placement.geometry)] for placement in placements))
    materials = Materials(stage, notes) if walk.has_bindings else None
    pieces = list(_pieces(placements, meshes, materials, config.split_subsets, notes))
    take_warnings()
    return pack(pieces, replace(source, referred=_referred(stage)), world_from_source, notes, _ABRIDGED)


def _referred(stage: Any) -> tuple[tuple[str, str], ...]:
    """The files that a stage is made of beside its root: path from the root's folder, SHA-256."""
    root = file_of(stage.GetRootLayer())
    files = {file for layer in stage.GetUsedLayers() if (file := file_of(layer)) and file != root}
    found = []
    for file in sorted(files):
        try:
            found.append((_seen_from(file, root), sha256_of(Path(file))))
        except OSError:
            continue  # what was read and is gone can't be told from what was changed
    return tuple(found)


def _seen_from(file: str, root: str) -> str:
    try:
        return Path(os.path.relpath(file, os.path.dirname(root))).as_posix()
    except ValueError:  # another drive
        return Path(file).as_posix()


def _units(stage: Any, notes: Notes) -> tuple[Source, Floats]:
    """The source as far as it is known here, and the matrix to metres and Z up."""
    meters = UsdGeom.GetStageMetersPerUnit(stage)
    if not UsdGeom.StageHasAuthoredMetersPerUnit(stage):
        notes.add("missing-units", "the file names no metersPerUnit; USD then means centimetres (0.01)")
    elif not _LEAST_UNIT <= meters <= _GREATEST_UNIT:
        notes.add("invalid-units", f"metersPerUnit = {meters:g} is impossible; taken as centimetres (0.01)")
        meters = 0.01
    axis = str(UsdGeom.GetStageUpAxis(stage))
    if axis not in Z_UP_FROM:
        notes.add("invalid-up-axis", f"upAxis = {axis!r} is impossible; taken as USD's default 'Y'")
        axis = "Y"
    elif not stage.HasAuthoredMetadata("upAxis"):
        notes.add("missing-up-axis", f"the file names no upAxis; taken as USD's default {axis!r}")
    return Source(meters_per_unit=float(meters), up_axis=axis, format="usd"), metres_z_up(float(meters), axis)


def _pieces(
    placements: Sequence[Placement],
    meshes: dict[str, tuple[RawMesh, CutMesh]],
    materials: Materials | None,
    split: bool,
    notes: Notes,
) -> Iterator[Piece]:
    bound = _bound_colors(placements, meshes, materials)
    shared: dict[tuple[str, str | None], tuple[npt.NDArray[np.floating], Faces]] = {}
    for placement in placements:
        raw, cut = meshes[str(placement.geometry)]
        for code, message in cut.faults:
            notes.add(code, message, placement.path)
        if not len(cut.corners):
            notes.add("empty-mesh", "left out: it has no usable face", placement.path)
            continue
        if raw.subdivided:
            notes.add("control-cage", "subdivision surfaces are loaded as their control cage", placement.path)
        if raw.subsets and _overlap(raw):
            notes.add("overlapping-subsets", "faces in several material subsets go to the first one", placement.path)
        for name, triangles, color in _parts(placement, raw, cut, bound, split):
            key = (str(placement.geometry), name)
            if key not in shared:
                shared[key] = _compact(cut, triangles)
            points, faces = shared[key]
            path = placement.path if name is None else f"{placement.path}/{name}"
            yield Piece(path, points, faces, placement.matrix, color, placement.anchor)


def _parts(
    placement: Placement, raw: RawMesh, cut: CutMesh, bound: dict[tuple[str, str | None], Color | None], split: bool
) -> Iterator[tuple[str | None, Ints | None, Color | None]]:
    """The subset (None: no subset), the triangles (None: all) and the colour of each mesh that a placement becomes."""
    own = bound.get((placement.own_path, None))
    if not raw.subsets:
        yield None, None, own if own is not None else _display_color(placement, raw, cut, None)
        return
    of_triangle = _subset_of_triangle(raw, cut)
    of_subset = [bound.get((placement.own_path, name)) for name, _ in raw.subsets]
    if not split:
        color = own if own is not None else _display_color(placement, raw, cut, None)
        yield None, None, _mixed(color, of_subset, of_triangle, cut)
        return
    for i, name in enumerate([None, *(name for name, _ in raw.subsets)], start=-1):
        triangles = np.flatnonzero(of_triangle == i)
        if not len(triangles):
            continue
        color = own if i < 0 else of_subset[i]
        if color is None:
            color = own if own is not None else _display_color(placement, raw, cut, triangles)
        yield name, triangles, color


def _bound_colors(
    placements: Sequence[Placement], meshes: dict[str, tuple[RawMesh, CutMesh]], materials: Materials | None
) -> dict[tuple[str, str | None], Color | None]:
    """The material colour of each mesh and of each of its subsets."""
    if materials is None:
        return {}
    bindings: dict[tuple[str, str | None], Sequence[str]] = {}
    paths: list[str] = []
    for placement in placements:
        own = placement.own_path
        if (own, None) in bindings:
            continue
        bindings[own, None] = placement.binding
        paths.append(own)
        for name, _ in meshes[str(placement.geometry)][0].subsets:
            paths.append(f"{own}/{name}")
            bindings[own, name] = (paths[-1], *placement.binding)
    return dict(zip(bindings, materials.bound_colors(paths, list(bindings.values())), strict=True))


def _subset_of_triangle(raw: RawMesh, cut: CutMesh) -> Ints:
    """The first subset that claims each triangle, or -1."""
    of_polygon = np.full(len(raw.counts), -1, np.int64)
    for i in reversed(range(len(raw.subsets))):
        polygons = raw.subsets[i][1]
        of_polygon[polygons[(polygons >= 0) & (polygons < len(of_polygon))]] = i
    owners: Ints = of_polygon[cut.polygon]
    return owners


def _overlap(raw: RawMesh) -> bool:
    claimed: list[int] = [face for _, polygons in raw.subsets for face in np.unique(polygons).tolist()]
    return len(set(claimed)) < len(claimed)


def _display_color(placement: Placement, raw: RawMesh, cut: CutMesh, triangles: Ints | None) -> Color | None:
    if not isinstance(placement.color, tuple):
        return placement.color
    if len(raw.counts) and raw.counts.min() < 0:
        return None
    values, interpolation = placement.color
    which = slice(None) if triangles is None else triangles
    areas = _areas(cut)[which]
    return mean_display_color(values, interpolation, raw.counts, cut.corners[which], cut.polygon[which], areas)


def _mixed(own: Color | None, of_subset: Sequence[Color | None], of_triangle: Ints, cut: CutMesh) -> Color | None:
    """The area-weighted mean over the subsets of a mesh that isn't split."""
    areas = _areas(cut)
    weight, total = 0.0, np.zeros(3)
    for i, color in enumerate([own, *of_subset], start=-1):
        color = own if color is None else color
        share = float(areas[of_triangle == i].sum())
        if color is not None and share > 0:
            weight += share
            total += share * color
    return total / weight if weight > 0 else own


def _areas(cut: CutMesh) -> Floats:
    a, b, c = (cut.points[cut.corners[:, i]].astype(np.float64) for i in range(3))
    areas: Floats = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return areas


def _compact(cut: CutMesh, triangles: Ints | None) -> tuple[npt.NDArray[np.floating], Faces]:
    """These triangles (None: all) with only the points that they use, in their order."""
    if triangles is None and cut.dense:
        return cut.points, cut.corners.astype(np.int32, copy=False)
    corners = cut.corners if triangles is None else cut.corners[triangles]
    used = np.zeros(len(cut.points), bool)
    used[corners] = True
    return cut.points[used], (np.cumsum(used, dtype=np.int32) - 1)[corners]


_MISSING_LAYER = re.compile(r"Could not load sublayer @(?P<asset>[^@]*)@")
_MISSING_ASSET = re.compile(r"In <(?P<path>[^>]*)>: Could not open asset @(?P<asset>[^@]*)@ for (?P<arc>\w+)")
_MISSING_TARGET = re.compile(
    r"In <(?P<path>[^>]*)>: Unresolved (?P<arc>\w+) prim path @(?P<asset>[^@]*)@<(?P<prim>[^>]*)>"
)

# Addresses, and what the library numbers anew in each run.
_PASSING = re.compile(
    r"\s*\((?:instantiating|recomposing|getting)[^()]*\)|0x[0-9a-f]+|anon:[0-9a-fx]+:|(?<=/__Prototype)_\d+"
)


def _take_warnings(delegate: Any, path: Path, notes: Notes) -> None:
    """Turns what the USD library said so far into notes, without what differs from run to run."""
    folder = path.absolute().parent
    others: list[str] = []
    for said in delegate.TakeUncoalescedDiagnostics():
        said_text = message_of(partial(getattr, said, "commentary"))
        if " was muted for " in said_text:
            # What was left out on purpose is noted already.
            continue
        text = re.sub(r"@([^@]*)@", lambda asset: f"@{_relative(asset[1], folder)}@", said_text)
        missing = _MISSING_ASSET.search(text) or _MISSING_TARGET.search(text)
        layer = _MISSING_LAYER.search(text)
        if missing:
            code = "missing-payload" if missing["arc"] == "payload" else "missing-reference"
            notes.add(code, _what_is_missing(missing, folder), missing["path"])
        elif layer:
            notes.add("missing-layer", f"sublayer: {_what_is_missing(layer, folder)}")
        else:
            others.append(_PASSING.sub("", text)[:300])
    for text in sorted(set(others))[:_MAX_WARNINGS]:
        notes.add("usd-warning", text)


def _what_is_missing(said: re.Match[str], folder: Path) -> str:
    asset, prim = said["asset"], said.groupdict().get("prim")
    if prim == "defaultPrim":
        return f"{asset!r} names no defaultPrim; set it there, or name a prim in the reference"
    if prim is not None:
        return f"{asset!r} has no prim <{prim}>; correct the reference" if asset else f"there is no prim <{prim}>"
    if is_there(folder / asset):
        return f"{asset!r} is there, but can't be read as USD; export it again"
    return f"can't find {asset!r}; put it there"


def _relative(asset: str, folder: Path) -> str:
    """The way to a file from the folder of the scene: absolute paths differ from machine to machine."""
    if not os.path.isabs(asset):
        return asset
    try:
        return Path(os.path.relpath(asset, folder)).as_posix()
    except ValueError:  # another drive
        return asset


def _reason(error: Exception, path: Path) -> str:
    """What the USD library objects to, from its report of several lines."""
    report = message_of(lambda: str(error))
    quoted = re.findall(r" : '(.*?)'(?=\s*(?:Error in|$))", report)
    text = quoted[0] if quoted else report
    text = text.replace(str(path.absolute().parent) + os.sep, "").replace(str(path), path.name)
    text = printable(text, "?")
    return re.sub(r"0x[0-9a-f]+|pxrInternal_\w*?pxrReserved__(::)?", "", text)[:300]


_FINDINGS = {
    "hidden": "{} hidden (set load.invisible = true)",
    "other-purpose": "{} of another purpose (add it to load.purposes)",
    "unsupported-geometry": "{} curves, patches or points (convert them to meshes)",
    "empty-mesh": "{} without a usable face",
    "degenerate-mesh": "{} without area",
    "invalid-transform": "{} with an impossible placement",
    "too-far": "{} farther than a million kilometres from the origin (check metersPerUnit)",
    "unreadable": "{} unreadable",
    "missing-prototype": "{} missing prototypes",
}


def _what_was_found(notes: Notes) -> str:
    found = [text.format(notes.count(code)) for code, text in _FINDINGS.items() if notes.count(code)]
    for code in ("outside-asset", "missing-layer", "missing-reference", "missing-payload"):
        found += notes.messages(code)[:2]
    return ": " + "; ".join(found) if found else "; export it again with its geometry"
