"""Labels, units and clusters as a USD layer over the untouched source (``semantics.usda``).

Labels follow ``UsdSemantics.LabelsAPI`` as Isaac Sim, Replicator and Isaac Lab read them, see
:mod:`cadgraph.export.usd_labels`, never time-sampled.

Everything is authored with Sdf, and the source is opened as a layer only for its metadata and the names of its root
prims: no stage is composed here, so that a damaged reference in the source can't stop the export.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Gf, Sdf, Tf, Vt

from cadgraph._io.atomic import replacing
from cadgraph._io.garbage import collector_paused
from cadgraph._io.staging import result_path
from cadgraph.errors import LoadError, OutputError
from cadgraph.export.usd_labels import (
    Stamps,
    add_structure,
    dispositions_of,
    parts_of_meshes,
    said_of,
    shared_parts,
    size_of,
    trace_of,
)
from cadgraph.export.usd_paths import check_source, is_usd, refuse_overwriting, relative_path
from cadgraph.export.usd_specs import (
    claim,
    define_prim,
    identifier,
    safe_text,
    set_attribute,
    unused,
)
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Part
from cadgraph.model.scene import Faces, Floats, Scene

__all__ = [
    "authorable_path",
    "authorable_paths",
    "export_layer",
    "geometry_layer",
    "is_split",
    "prim_paths",
    "reason_of",
    "targets_of_parts",
    "write_geometry",
    "write_semantics",
]

# A stage takes these from its root layer alone, so a layer over the source hides them unless it says them again.
_RESTATED = (
    "defaultPrim", "upAxis", "metersPerUnit", "kilogramsPerUnit", "timeCodesPerSecond", "framesPerSecond",
    "startTimeCode", "endTimeCode", "expressionVariables", "renderSettingsPrimPath", "colorConfiguration",
    "colorManagementSystem",
)  # fmt: skip
_WORLD = "World"
_SHAPE = "CadGraphShape"


@collector_paused()
def write_semantics(scene: Scene, graph: SceneGraph, source_path: str | Path, path: str | Path) -> Path:
    """Writes the layer of labels, units and clusters over the source, which stays as it is.

    Opening the layer shows the source's geometry. Over a source that is not USD, or one whose meshes were split into
    their separate solids, the scene's geometry is first written as ``scene.usdc`` beside the layer, see
    :func:`write_geometry`.

    Args:
        scene: the loaded scene with all meshes of the source; its anchors say where opinions can be authored.
        graph: the finished graph of this scene.
        source_path: the file that the scene was loaded from.
        path: the layer to write (``semantics.usda``).

    Returns:
        The layer.

    Raises:
        ValueError: the graph names a mesh that the scene doesn't have.
        LoadError: the source can't be opened any more.
        OutputError: the layer can't be written, would overwrite the source, or can't refer to it.
    """
    target, source = Path(path), Path(source_path)
    check_source(source, target)
    if is_usd(source) and not is_split(scene):
        below, anchors, targets = source, scene.anchors or scene.paths, scene.paths
    else:
        below = target.with_name("scene.usdc")
        refuse_overwriting(source, below)
        anchors = targets = prim_paths(scene)
        write_geometry(scene, below)
    shown, authorable = authorable_paths(targets, anchors)
    layer = Sdf.Layer.CreateAnonymous(".usda")
    roots = _restate(layer, below, target, scene)
    roots.update({anchor.split("/", 2)[1] for anchor, path in zip(anchors, authorable, strict=True) if path})
    with Sdf.ChangeBlock():
        _label_anchors(layer, authorable, scene, graph)
        add_structure(layer, unused("CadGraph", roots), graph, targets_of_parts(scene, graph, shown, authorable))
    return export_layer(layer, target)


def is_split(scene: Scene) -> bool:
    """Whether a mesh of the source is several of the scene: then no prim of the source can carry their labels."""
    return any(note.code == "split-mesh" for note in scene.diagnostics)


def prim_paths(scene: Scene) -> tuple[str, ...]:
    """The prim path that :func:`write_geometry` gives to each mesh, in the order of the scene.

    Names become valid USD identifiers (letters, digits, underscores; no leading digit), unique among siblings.
    """
    return tuple(str(path) for path in _tree(scene)[0])


def write_geometry(scene: Scene, path: str | Path) -> Path:
    """Writes all meshes of a scene as USD, for sources that are not USD themselves.

    Z up, metres, one Mesh prim for each mesh under ``/World``, which stands at the scene's origin. Points are single
    precision in USD: each mesh is stored about its own centre and moved there in double precision, so that rounding
    stays below a ten-millionth of the mesh's own size wherever it stands. Meshes that share a shape refer to one class
    prim with its points. The original names and paths are kept as ``displayName`` and in ``customData``.

    Args:
        scene: what to write.
        path: the file (``scene.usdc``).

    Returns:
        The file.

    Raises:
        OutputError: it can't be written.
    """
    return export_layer(geometry_layer(scene), path)


def geometry_layer(scene: Scene) -> Any:
    """What :func:`write_geometry` writes, as a layer in memory."""
    mesh_paths, groups = _tree(scene)
    layer = Sdf.Layer.CreateAnonymous(".usda")
    for key, value in (("defaultPrim", _WORLD), ("metersPerUnit", 1.0), ("upAxis", "Z")):
        layer.pseudoRoot.SetInfo(key, value)
    with Sdf.ChangeBlock():
        world = define_prim(layer, Sdf.Path.absoluteRootPath.AppendChild(_WORLD), "Xform")
        _translate(world, scene.origin)
        for prim_path, name in groups:
            define_prim(layer, prim_path, "Xform", name)
        shared = _define_shapes(layer, scene)
        for index, prim_path in enumerate(mesh_paths):
            _define_mesh(layer, prim_path, scene, index, shared)
    return layer


def export_layer(layer: Any, path: str | Path) -> Path:
    """Writes a layer whole or not at all, as its suffix says.

    Raises:
        OutputError: it can't be written.
    """
    with replacing(path) as beside:
        try:
            exported = layer.Export(str(beside))
        except Tf.ErrorException as error:
            raise OutputError(f"{path}: can't be written ({reason_of(error)}); choose another output folder") from None
        if not exported:
            raise OutputError(f"{path}: can't be written; choose another output folder")
    return Path(path)


# The source below


def _restate(layer: Any, below: Path, target: Path, scene: Scene) -> set[str]:
    """Puts the layer over the source and repeats its stage metadata; returns the names of the source's root prims."""
    source = _open(below)
    layer.subLayerPaths.append(relative_path(below, target))
    root = layer.pseudoRoot
    for key in _RESTATED:
        if source.pseudoRoot.HasInfo(key):
            root.SetInfo(key, source.pseudoRoot.GetInfo(key))
    if not root.HasInfo("upAxis"):
        root.SetInfo("upAxis", scene.source.up_axis)
    if not root.HasInfo("metersPerUnit"):
        root.SetInfo("metersPerUnit", scene.source.meters_per_unit)
    layer.customLayerData = {"cadgraph": {"source_sha256": scene.source.sha256}}
    return _root_names(source)


def _open(source: Path) -> Any:
    try:
        layer = Sdf.Layer.FindOrOpen(os.path.abspath(result_path(source)).replace(os.sep, "/"))
    except Tf.ErrorException as error:
        raise LoadError(f"{source}: can't be opened as USD ({reason_of(error)})") from None
    if layer is None:
        raise LoadError(f"{source}: can't be opened as USD; the labels need the file that the graph was made from")
    return layer


def _root_names(source: Any) -> set[str]:
    names: set[str] = set()
    seen: set[str] = set()
    waiting = [source]
    while waiting:
        layer = waiting.pop()
        seen.add(layer.identifier)
        names.update(prim.name for prim in layer.rootPrims)
        for below in layer.subLayerPaths:
            identifier = Sdf.ComputeAssetPathRelativeToLayer(layer, below)
            if identifier in seen:
                continue
            try:
                found = Sdf.Layer.FindOrOpen(identifier)
            except Tf.ErrorException:
                # What is missing below can't take a name, and the loader has reported it already.
                found = None
            if found is not None:
                waiting.append(found)
    return names


def reason_of(error: Exception) -> str:
    """What the USD library objects to, out of its report of several lines."""
    # A line reads: Error in 'function' at line 1 in file x.cpp : 'what happened'
    line = (str(error).strip().splitlines() or ["no reason given"])[0]
    return line.split(" : '", 1)[-1].rstrip("'")


# Labels


def authorable_path(anchor: str) -> Any:
    """The path as Sdf knows it, or None where USD can't hold an opinion there."""
    if not Sdf.Path.IsValidPathString(anchor):
        return None
    path = Sdf.Path(anchor)
    return path if path.IsAbsolutePath() and path.IsPrimPath() else None


def authorable_paths(targets: Sequence[str], anchors: Sequence[str]) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
    """Likewise the paths of meshes, and of what carries them; as a rule these are the same."""
    carried = tuple(authorable_path(anchor) for anchor in anchors)
    return carried if anchors is targets else tuple(authorable_path(target) for target in targets), carried


def _label_anchors(layer: Any, anchors: Sequence[Any], scene: Scene, graph: SceneGraph) -> None:
    dispositions = dispositions_of(graph)
    at_anchor: dict[Any, dict[str, Part]] = {}
    done_at: dict[Any, list[str]] = {}
    stamps = Stamps(layer)
    for anchor, mesh, part in zip(anchors, scene.paths, parts_of_meshes(scene, graph), strict=True):
        if anchor is not None and part is not None:
            at_anchor.setdefault(anchor, {})[part.id] = part
            done_at.setdefault(anchor, []).extend(dispositions.get(mesh, ()))
    for anchor, held in at_anchor.items():
        parts = list(held.values())
        winner = max((part for part in parts if part.label is not None), key=size_of, default=None)
        said = said_of(winner, done_at[anchor]) if winner is not None else None
        if winner is None or said is None:
            continue
        stamps.label(anchor, said, trace_of(winner))
        if len(parts) > 1:
            layer.GetPrimAtPath(anchor).customData = {"cadgraph": shared_parts(parts)}


# Units, clusters and what joins them


def targets_of_parts(
    scene: Scene, graph: SceneGraph, targets: Sequence[Any], anchors: Sequence[Any]
) -> dict[str, list[Any]]:
    """The prims of each part: its meshes themselves (in an instance too), or what carries them where they are none.

    Args:
        scene: that the graph is of.
        graph: whose parts they are.
        targets: the path of each mesh, None where USD can't hold it.
        anchors: likewise of what carries it.
    """
    index = {path: i for i, path in enumerate(scene.paths)}
    result: dict[str, list[Any]] = {}
    for part in graph.of_layer(Part):
        found = (targets[i] or anchors[i] for i in (index[mesh] for mesh in part.meshes))
        result[part.id] = [path for path in found if path is not None]
    return result


# Names and geometry of a source that is not USD


def _tree(scene: Scene) -> tuple[list[Any], list[tuple[Any, str]]]:
    """A prim path for each mesh, and the prims above them with their original names, parents first."""
    steps_of_mesh = [tuple(step for step in path.split("/") if step) for path in scene.paths]
    inner = {steps[:depth] for steps in steps_of_mesh for depth in range(1, len(steps))}
    world = Sdf.Path.absoluteRootPath.AppendChild(_WORLD)
    groups: dict[tuple[str, ...], Any] = {(): world}
    taken: dict[Any, set[str]] = {}
    named: list[tuple[Any, str]] = []

    def child(parent: Any, name: str) -> Any:
        return parent.AppendChild(claim(identifier(name), taken.setdefault(parent, set())))

    result = []
    for steps in steps_of_mesh:
        # USD wants no mesh below a mesh: one that also holds others becomes a child of its own place.
        above, name = (steps, "mesh") if not steps or steps in inner else (steps[:-1], steps[-1])
        for depth in range(1, len(above) + 1):
            if above[:depth] not in groups:
                groups[above[:depth]] = child(groups[above[: depth - 1]], above[depth - 1])
                named.append((groups[above[:depth]], above[depth - 1]))
        result.append(child(groups[above], name))
    return result, named


def _define_shapes(layer: Any, scene: Scene) -> dict[int, tuple[Any, Floats]]:
    """A class prim for each shape that several meshes share, and the point of the shape that it is stored about."""
    if scene.placement is None:
        return {}
    rows, counts = np.unique(scene.placement.shape, return_counts=True)
    found: dict[int, tuple[Any, Floats]] = {}
    for row in rows[counts > 1].tolist():
        path = Sdf.Path.absoluteRootPath.AppendChild(f"{_SHAPE}_{len(found)}")
        prim = define_prim(layer, path, "Mesh")
        prim.specifier = Sdf.SpecifierClass
        found[row] = path, _fill_mesh(prim, *scene.shapes.mesh(row))
    return found


def _define_mesh(layer: Any, path: Any, scene: Scene, index: int, shared: Mapping[int, tuple[Any, Floats]]) -> None:
    source_path = scene.paths[index]
    prim = define_prim(layer, path, "Mesh", source_path.rsplit("/", 1)[-1])
    prim.customData = {"cadgraph": {"path": safe_text(source_path)}}
    placement = scene.placement
    if placement is not None and (shape := int(placement.shape[index])) in shared:
        at, center = shared[shape]
        prim.referenceList.prependedItems = [Sdf.Reference("", at)]
        matrix = np.eye(4)
        matrix[:3, :3] = placement.turn[index]
        matrix[3, :3] = center @ placement.turn[index] + placement.shift[index]
        set_attribute(prim, "xformOp:transform", "Matrix4d", Gf.Matrix4d(*matrix.reshape(-1).tolist()))
        set_attribute(prim, "xformOpOrder", "TokenArray", Vt.TokenArray(["xformOp:transform"]), uniform=True)
    else:
        _translate(prim, _fill_mesh(prim, *scene.mesh(index)))
    color = scene.colors[index]
    if np.isfinite(color).all():
        shown = set_attribute(
            prim, "primvars:displayColor", "Color3fArray", Vt.Vec3fArray.FromNumpy(np.float32(color[None]))
        )
        shown.SetInfo("interpolation", "constant")


def _fill_mesh(prim: Any, vertices: Floats, faces: Faces) -> Floats:
    """Gives a prim points about the middle of the mesh, which is returned, and faces."""
    center: Floats = (vertices.min(axis=0) + vertices.max(axis=0)) / 2 if len(vertices) else np.zeros(3)
    points = np.ascontiguousarray(vertices - center, np.float32)
    set_attribute(prim, "points", "Point3fArray", Vt.Vec3fArray.FromNumpy(points))
    set_attribute(prim, "faceVertexCounts", "IntArray", Vt.IntArray(len(faces), 3))
    corners = np.ascontiguousarray(faces, np.int32).reshape(-1)
    set_attribute(prim, "faceVertexIndices", "IntArray", Vt.IntArray.FromNumpy(corners))
    set_attribute(prim, "subdivisionScheme", "Token", "none", uniform=True)
    # CAD surfaces are often open, and their back faces matter.
    set_attribute(prim, "doubleSided", "Bool", True, uniform=True)
    if len(points):
        extent = np.stack([points.min(axis=0), points.max(axis=0)])
        set_attribute(prim, "extent", "Float3Array", Vt.Vec3fArray.FromNumpy(extent))
    return center


def _translate(prim: Any, offset: Any) -> None:
    if np.any(offset):
        set_attribute(prim, "xformOp:translate", "Double3", tuple(float(x) for x in offset))
        set_attribute(prim, "xformOpOrder", "TokenArray", Vt.TokenArray(["xformOp:translate"]), uniform=True)


# Small pieces of Sdf
