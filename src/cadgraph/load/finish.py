"""What every scene gets after its reader, whatever its format: unit and up axis settled, bags of triangles split.

Notes in ``Scene.diagnostics``: ``missing-units``, ``missing-up-axis``, ``unit-doubt``, ``split-mesh``, ``one-surface``.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from cadgraph.errors import LoadError
from cadgraph.load.naming import Names
from cadgraph.load.packing import TOO_FAR, TOO_FAR_TOLD, Z_UP_FROM, odd_size
from cadgraph.load.units import METRES, UnitEvidence, bounds_of, distinct, pipe_diameters, weigh_units
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.scene import Faces, Floats, Ints, MeshArrays, Scene

if TYPE_CHECKING:
    from cadgraph.config import LoadConfig

__all__ = ["finish"]

_UNSTATED_SHELLS = 2  # a format that keeps all in one mesh: from so many surfaces on these are its parts
_BAG_SHELLS = 20  # a mesh of a format that keeps parts apart is a bag of them where it has more surfaces than this ...
_BAG_SHARE = 0.3  # ... and this share of the scene's triangles
_FEW_MESHES = 50  # of a scene that may have one mesh for each material
_PLACES = 5  # such a mesh has surfaces in so many places apart from each other ...
_APART = 0.02  # ... by this share of its own diagonal
_BY_MATERIAL = 0.5  # and such meshes hold this share of the scene's triangles
_WORDS = {"in": "inches", "ft": "feet"}
_PLANT = 2.0  # least extent of a plant [m] ...
_PIPES, _DIAMETERS = 10, 3  # ... and how many long round surfaces it has at least, of how many diameters
_MOST_BOXES = 3000  # surfaces of a mesh that are compared
_ONE_BODY = 0.8  # a surface with this share of a mesh's triangles makes it one body with scraps: a scan
_SCAN = 5000  # triangles of one connected surface that are worth a note
_LEAST_TRIANGLES = 8  # of a surface on average; a box has twelve
_BAGS = ("stl", "ply", "obj")
_FLAT = 0.6  # a scene whose extent along Y is below this share of the two others stands on Y


def finish(scene: Scene, config: LoadConfig, path: Path) -> Scene:
    """Settles what the reader of a format could not know.

    Args:
        scene: what it returned: where the source states no unit, in units of the file; likewise of the up axis.
        config: how it is read.
        path: of the file, for messages.

    Returns:
        The scene in metres and Z up, with bags of triangles split into their surfaces.

    Raises:
        LoadError: the file states no unit, and its parts don't tell one clearly.
    """
    if not scene.n_meshes:
        return scene
    if config.split:
        scene = _split(scene, config.unit)
    stated = scene.source.unit_stated
    scene = _with_unit(scene, config, path)
    return _with_up(scene if stated else _of_usual_size(scene, path), config)


def _of_usual_size(scene: Scene, path: Path) -> Scene:
    """A scene whose metres are known only now, without what lies too far out; an odd size is told."""
    low, high = bounds_of(scene)
    if np.abs([low + scene.origin, high + scene.origin]).max() > TOO_FAR:
        far = [i for i in range(scene.n_meshes) if np.abs(scene.mesh(i)[0] + scene.origin).max() > TOO_FAR]
        if len(far) == scene.n_meshes:
            raise LoadError(
                f"{path}: all of it lies farther out than a million kilometres, one unit being "
                f"{scene.source.meters_per_unit:g} m; say the unit with --unit mm (or m, cm, in, ft; load.unit)"
            )
        note = Diagnostic("too-far", TOO_FAR_TOLD, tuple(scene.paths[i] for i in far))
        scene = _noted(scene.select(np.setdiff1d(np.arange(scene.n_meshes), far)), note)
        low, high = bounds_of(scene)
    told = odd_size(float((high - low).max()), scene.source)
    return _noted(scene, Diagnostic("unusual-size", told)) if told else scene


def _split(scene: Scene, unit: str | None) -> Scene:
    """The scene with every mesh that is a bag of separate surfaces as a mesh for each of them."""
    bags = {mesh: surfaces for mesh, surfaces in _candidates(scene).items() if len(surfaces) > 1}
    if scene.source.format in _BAGS and scene.n_meshes == 1 and not bags and scene.n_triangles >= _SCAN:
        message = "the file holds one connected surface (a scan?), which stays one mesh"
        return _noted(scene, Diagnostic("one-surface", message, scene.paths))
    if not bags:
        return scene
    meshes: list[tuple[Floats, Faces]] = []
    paths, anchors, rows = [], [], []
    names = Names()
    for path in scene.paths:
        names.take(path)
    for mesh in range(scene.n_meshes):
        vertices, faces = scene.mesh(mesh)
        own = scene.anchors[mesh] if scene.anchors else scene.paths[mesh]
        for number, triangles in enumerate(bags.get(mesh, ()), start=1):
            used, corners = np.unique(faces[triangles], return_inverse=True)
            meshes.append((vertices[used], corners.reshape(-1, 3).astype(np.int32)))
            paths.append(names.take(f"{scene.paths[mesh]}/solid_{number}"))
        if mesh not in bags:
            meshes.append((vertices, faces))
            paths.append(scene.paths[mesh])
        n = len(bags.get(mesh, (0,)))
        anchors += [own] * n
        rows += [mesh] * n
    notes = [
        Diagnostic(
            "split-mesh",
            f"one mesh held {len(surfaces):,} separate surfaces; each is a mesh of its own now (load.split = false "
            "keeps it whole)",
            (scene.paths[mesh],),
        )
        for mesh, surfaces in bags.items()
    ]
    parted = replace(
        scene, shapes=MeshArrays.of(meshes), placement=None, paths=tuple(paths), anchors=tuple(anchors),
        colors=scene.colors[np.array(rows)],
    )  # fmt: skip
    if scene.source.format not in _BAGS and not _is_plant(parted, unit):
        return scene
    return _noted(parted.in_path_order(), *notes)


def _is_plant(scene: Scene, unit: str | None) -> bool:
    """Whether a scene is large and has pipes of several sizes: a lamp or a pump in one mesh is one thing, whatever its
    surfaces.
    """
    scale = METRES[unit] / scene.source.meters_per_unit if unit else 1.0
    low, high = bounds_of(scene)
    size = float((high - low).max()) * scale
    diameters = pipe_diameters(scene)
    return size >= _PLANT and len(diameters) >= _PIPES and len(distinct(diameters)) >= _DIAMETERS


def _candidates(scene: Scene) -> dict[int, list[Ints]]:
    """The surfaces of each mesh that may be a bag."""
    counts = np.diff(scene.face_offsets)
    if counts.sum() < _BAG_SHELLS * 4:
        return {}
    if scene.source.format in _BAGS and scene.n_meshes == 1:
        found = {0: _surfaces(scene, 0)}
        return found if len(found[0]) >= _UNSTATED_SHELLS and not _is_whole(found[0], int(counts[0])) else {}
    large = np.flatnonzero(counts > _BAG_SHARE * counts.sum()).tolist()
    looked_at = range(scene.n_meshes) if scene.n_meshes <= _FEW_MESHES else large
    found = {int(mesh): _surfaces(scene, int(mesh)) for mesh in looked_at}
    found = {mesh: surfaces for mesh, surfaces in found.items() if not _is_whole(surfaces, int(counts[mesh]))}
    spread = [mesh for mesh, surfaces in found.items() if _places(scene, mesh, surfaces) >= _PLACES]
    if scene.n_meshes <= _FEW_MESHES and counts[spread].sum() > _BY_MATERIAL * counts.sum():
        return found
    return {mesh: surfaces for mesh, surfaces in found.items() if mesh in large and len(surfaces) > _BAG_SHELLS}


def _places(scene: Scene, mesh: int, surfaces: list[Ints]) -> int:
    """In how many places, apart from each other, the surfaces of a mesh lie: those of one thing are near each other."""
    if len(surfaces) < _PLACES:
        return 1
    from cadgraph.geometry.components import first_of_component

    vertices, faces = scene.mesh(mesh)
    apart = _APART * float(np.linalg.norm(vertices.max(axis=0) - vertices.min(axis=0)))
    corners = [vertices[faces[triangles]].reshape(-1, 3) for triangles in surfaces[:_MOST_BOXES]]
    low = np.array([points.min(axis=0) for points in corners]) - apart
    high = np.array([points.max(axis=0) for points in corners])
    near = (low[:, None] <= high[None]).all(axis=2)
    return len(np.unique(first_of_component(len(corners), np.argwhere(near & near.T))))


def _is_whole(surfaces: list[Ints], n_triangles: int) -> bool:
    """Whether a mesh is no bag of parts: nearly one surface, as of a scan with scraps, or loose triangles."""
    scraps = max(map(len, surfaces)) > _ONE_BODY * n_triangles and len(surfaces) > 2
    return scraps or n_triangles < _LEAST_TRIANGLES * len(surfaces)


def _surfaces(scene: Scene, mesh: int) -> list[Ints]:
    # Only here, because the graph library that it uses takes a third of the time that a small scene takes to read.
    from cadgraph.geometry.mesh.merge import weld_points
    from cadgraph.load.bodies import split_shells

    vertices, faces = scene.mesh(mesh)
    first, place = weld_points(vertices)
    return split_shells(vertices[first], place.astype(np.int32)[faces])


def _with_unit(scene: Scene, config: LoadConfig, path: Path) -> Scene:
    """In metres: by the setting, by what the file states, or by what its parts tell."""
    source = scene.source
    if config.unit is not None:
        metres = METRES[config.unit]
        moved = _moved(scene, metres / source.meters_per_unit, np.eye(3))
        return replace(moved, source=replace(source, meters_per_unit=metres, unit_stated=True))
    if config.scale is not None:
        # By hand: what the lengths tell is said of the lengths that come of it.
        scene = _moved(scene, config.scale, np.eye(3))
        source = replace(source, meters_per_unit=source.meters_per_unit * config.scale, unit_stated=True)
        scene = replace(scene, source=source)
    evidence = weigh_units(scene, source.meters_per_unit)
    if source.unit_stated:
        return _noted(scene, *_doubt(scene, evidence, source.meters_per_unit))
    unit = evidence.best
    if not evidence.clear:
        raise LoadError(
            f"{path}: the file names no unit of length and its parts don't tell one clearly; say it with --unit mm (or "
            f"m, cm, in, ft; load.unit): it is {evidence.largest:.4g} units across{_hint(scene)}"
        )
    told = (
        f"the file names no unit; taken as {unit}, in which {evidence.hits[unit]} of {evidence.n_diameters} diameters "
        "of pipes are standard ones (another one: --unit)"
    )
    moved = _moved(scene, METRES[unit] / source.meters_per_unit, np.eye(3))
    settled = replace(moved, source=replace(source, meters_per_unit=METRES[unit]))
    return _noted(settled, Diagnostic("missing-units", told))


def _hint(scene: Scene) -> str:
    """What the file's name or header says of its unit, in brackets; empty where nothing does."""
    said = [note.message for note in scene.diagnostics if note.code == "unit-hint"]
    return f" ({'; '.join(said)})" if said else ""


def _doubt(scene: Scene, evidence: UnitEvidence, metres: float) -> tuple[Diagnostic, ...]:
    """What is to be said where a file's parts speak for another unit than it states."""
    stated = next((name for name, length in METRES.items() if abs(length / metres - 1) < 1e-3), f"{metres:g} m")
    unit = evidence.best
    if evidence.certain:
        scale = METRES[unit] / metres
        if abs(scale - 1) < 1e-3:
            return ()
        # "In in" reads as a slip.
        message = (
            f"the file's unit is {stated}, yet {evidence.hits[unit]} of {evidence.n_diameters} diameters of its pipes "
            f"are standard ones in {_WORDS.get(unit, unit)}, {evidence.hits.get(stated, 0)} in {stated}; if so, read "
            f"it with --scale {scale:.9g}; as it stands, nothing was rescaled"
        )
        return (Diagnostic("unit-doubt", message),)
    if not evidence.odd(metres, scene.n_meshes):
        return ()
    sizes = ", ".join(
        f"in {_WORDS.get(one, one)} {evidence.largest * METRES[one]:.3g} m and {evidence.median * METRES[one]:.2g} m"
        for one in evidence.fitting
    )
    message = (
        f"the file's unit is {stated}, in which the scene is {evidence.largest * metres:.3g} m across and half of its "
        f"meshes are below {evidence.median * metres:.2g} m, which is odd for a plant. They would be {sizes}; sizes "
        f"don't tell units apart more exactly: read it with {_either(evidence.fitting)} if that is right; as it "
        "stands, nothing was rescaled"
    )
    return (Diagnostic("unit-doubt", message),)


def _either(units: tuple[str, ...]) -> str:
    """The settings that take these units, as a choice."""
    given = [f"--unit {unit}" for unit in units]
    return " or ".join([", ".join(given[:-1]), given[-1]] if len(given) > 1 else given)


def _with_up(scene: Scene, config: LoadConfig) -> Scene:
    """Z up: by the setting, by what the file states, or by how the scene lies."""
    source = scene.source
    axis = config.up
    told: tuple[Diagnostic, ...] = ()
    if axis is None and not source.up_stated:
        low, high = bounds_of(scene)
        x, y, z = high - low
        axis = "Y" if y < _FLAT * min(x, z) else "Z"
        told = (Diagnostic("missing-up-axis", f"the file names no up axis; taken as {axis} (another one: --up)"),)
    if axis is None or axis == source.up_axis:
        return _noted(scene, *told)
    turn = Z_UP_FROM[source.up_axis].T @ Z_UP_FROM[axis]
    return _noted(replace(_moved(scene, 1.0, turn), source=replace(source, up_axis=axis, up_stated=True)), *told)


def _moved(scene: Scene, scale: float, turn: Floats) -> Scene:
    """The scene enlarged and turned (for row vectors) about the source's origin."""
    if scale == 1.0 and (turn == np.eye(3)).all():
        return scene
    origin = scale * scene.origin @ turn
    if scene.placement is None:
        return replace(scene.with_vertices(scale * scene.vertices @ turn), origin=origin)
    shapes = replace(scene.shapes, vertices=scale * scene.shapes.vertices)
    placement = replace(scene.placement, turn=scene.placement.turn @ turn, shift=scale * scene.placement.shift @ turn)
    return replace(scene, shapes=shapes, placement=placement, origin=origin)


def _noted(scene: Scene, *notes: Diagnostic) -> Scene:
    if not notes:
        return scene
    found = sorted((*scene.diagnostics, *notes), key=lambda note: (note.code, note.message))
    return replace(scene, diagnostics=tuple(found))
