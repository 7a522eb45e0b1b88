"""Labels, units and clusters as a USD layer over the untouched source (``semantics.usda``).

Labels follow ``UsdSemantics.LabelsAPI`` as Isaac Sim, Replicator and Isaac Lab read them: taxonomy ``class`` with one
token on every mesh, ``cad_group`` for its group, ``cad_unit`` on the units' own prims, never time-sampled.

Everything is authored with Sdf, and the source is opened as a layer only for its metadata and the names of its root
prims: no stage is composed here, so that a damaged reference in the source can't stop the export.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Gf, Sdf, Tf, Vt

from cadgraph._io.atomic import replacing, write_atomically
from cadgraph.errors import LoadError, OutputError
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Cluster, Connected, Contains, Junction, Part, Related, System, Terminal, Unit
from cadgraph.model.scene import Faces, Floats, Scene

__all__ = ["CLASS", "GROUP", "UNIT", "check_source", "is_usd", "prim_paths", "write_geometry", "write_semantics"]

CLASS, GROUP, UNIT = "class", "cad_group", "cad_unit"
"""The taxonomies: what a mesh is, the group that it is in, the type of a functional unit."""

_USD_SUFFIXES = (".usd", ".usda", ".usdc", ".usdz")
_FORBIDDEN = re.compile(r"[:;,&|!]")
_CONTROL = re.compile(r"[\x00-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff]")
# A stage takes these from its root layer alone, so a layer over the source hides them unless it says them again.
_RESTATED = (
    "defaultPrim", "upAxis", "metersPerUnit", "kilogramsPerUnit", "timeCodesPerSecond", "framesPerSecond",
    "startTimeCode", "endTimeCode", "expressionVariables", "renderSettingsPrimPath", "colorConfiguration",
    "colorManagementSystem",
)  # fmt: skip
_WORLD = "World"
_SHAPE = "CadGraphShape"


def is_usd(source_path: str | Path) -> bool:
    """Whether a file is USD by its name, so that a layer can lie over it."""
    return Path(source_path).suffix.lower() in _USD_SUFFIXES


def check_source(source_path: str | Path, path: str | Path) -> None:
    """Makes sure that a layer can lie over a source, before any work is done for it.

    Args:
        source_path: the file that the scene comes from.
        path: the layer to write.

    Raises:
        OutputError: the layer would overwrite the source, or USD can't refer to the source by its name.
    """
    source, target = Path(source_path), Path(path)
    _refuse_overwriting(source, target)
    if is_usd(source) and _CONTROL.search(_relative(source, target)):
        raise OutputError(
            f"{source}: no USD layer can refer to it, as its path holds control characters or broken text; rename it"
        )


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
    if is_usd(source) and not _is_split(scene):
        below, anchors, targets = source, scene.anchors or scene.paths, scene.paths
    else:
        below = target.with_name("scene.usdc")
        _refuse_overwriting(source, below)
        anchors = targets = prim_paths(scene)
        write_geometry(scene, below)
    parts_of_mesh = _parts_of_meshes(scene, graph)
    authorable = tuple(_authorable(anchor) for anchor in anchors)
    layer = Sdf.Layer.CreateAnonymous(".usda")
    roots = _restate(layer, below, target, scene)
    roots.update(prefix.name for anchor in authorable if anchor for prefix in anchor.GetPrefixes()[:1])
    with Sdf.ChangeBlock():
        _label_anchors(layer, authorable, parts_of_mesh)
        _add_structure(layer, _unused("CadGraph", roots), graph, _targets_of_parts(scene, graph, targets, authorable))
    write_atomically(target, layer.ExportToString())
    return target


def _is_split(scene: Scene) -> bool:
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
    mesh_paths, groups = _tree(scene)
    layer = Sdf.Layer.CreateAnonymous(".usda")
    for key, value in (("defaultPrim", _WORLD), ("metersPerUnit", 1.0), ("upAxis", "Z")):
        layer.pseudoRoot.SetInfo(key, value)
    with Sdf.ChangeBlock():
        world = _define(layer, Sdf.Path.absoluteRootPath.AppendChild(_WORLD), "Xform")
        _translate(world, scene.origin)
        for prim_path, name in groups:
            _define(layer, prim_path, "Xform", name)
        shared = _define_shapes(layer, scene)
        for index, prim_path in enumerate(mesh_paths):
            _define_mesh(layer, prim_path, scene, index, shared)
    with replacing(path) as beside:
        try:
            exported = layer.Export(str(beside))
        except Tf.ErrorException as error:
            raise OutputError(f"{path}: can't be written ({_reason(error)}); choose another output folder") from None
        if not exported:
            raise OutputError(f"{path}: can't be written; choose another output folder")
    return Path(path)


# The source below


def _refuse_overwriting(source: Path, target: Path) -> None:
    if os.path.realpath(source) == os.path.realpath(target):
        raise OutputError(f"{target}: this is the source itself, which stays untouched; choose another output folder")


def _restate(layer: Any, below: Path, target: Path, scene: Scene) -> set[str]:
    """Puts the layer over the source and repeats its stage metadata; returns the names of the source's root prims."""
    source = _open(below)
    layer.subLayerPaths.append(_relative(below, target))
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
        layer = Sdf.Layer.FindOrOpen(os.path.abspath(source).replace(os.sep, "/"))
    except Tf.ErrorException as error:
        raise LoadError(f"{source}: can't be opened as USD ({_reason(error)})") from None
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


def _relative(below: Path, target: Path) -> str:
    source = os.path.abspath(below)
    try:
        relative = os.path.relpath(source, os.path.dirname(os.path.abspath(target))).replace(os.sep, "/")
    except ValueError:
        # Another drive on Windows has no relative path.
        return source.replace(os.sep, "/")
    return relative if relative.startswith("../") else f"./{relative}"


def _reason(error: Exception) -> str:
    # A line reads: Error in 'function' at line 1 in file x.cpp : 'what happened'
    line = (str(error).strip().splitlines() or ["no reason given"])[0]
    return line.split(" : '", 1)[-1].rstrip("'")


# Labels


def _parts_of_meshes(scene: Scene, graph: SceneGraph) -> list[Part | None]:
    index = {path: i for i, path in enumerate(scene.paths)}
    owners: list[Part | None] = [None] * scene.n_meshes
    for part in graph.of_layer(Part):
        for mesh in part.meshes:
            if mesh not in index:
                raise ValueError(
                    f"part {part.id!r} holds mesh {mesh!r}, which is not in the scene: pass the same scene"
                )
            owners[index[mesh]] = part
    return owners


def _authorable(anchor: str) -> Any:
    """The path as Sdf knows it, or None where USD can't hold an opinion there."""
    if not Sdf.Path.IsValidPathString(anchor):
        return None
    path = Sdf.Path(anchor)
    return path if path.IsAbsolutePath() and path.IsPrimPath() else None


def _label_anchors(layer: Any, anchors: Sequence[Any], parts_of_mesh: Sequence[Part | None]) -> None:
    at_anchor: dict[Any, list[Part]] = {}
    for anchor, part in zip(anchors, parts_of_mesh, strict=True):
        if anchor is None or part is None:
            continue
        here = at_anchor.setdefault(anchor, [])
        if not here or here[-1] is not part:
            here.append(part)
    for anchor, with_repeats in at_anchor.items():
        parts = list({part.id: part for part in with_repeats}.values())
        labelled = [part for part in parts if part.label is not None]
        if not labelled:
            continue
        winner = max(labelled, key=_size)
        prim = Sdf.CreatePrimInLayer(layer, anchor)
        _label_part(prim, winner)
        if len(parts) > 1:
            prim.customData = {"cadgraph": _shared(parts)}


def _label_part(prim: Any, part: Part) -> None:
    label = part.label
    if label is None:
        return
    trace = {"confidence": float(label.confidence), "source": _text(label.source), "part": _text(part.id)}
    if label.likely:
        trace["likely"] = True
    _apply(prim, f"SemanticsLabelsAPI:{CLASS}", f"SemanticsLabelsAPI:{GROUP}")
    _labels(prim, CLASS, _token(label.name or label.group), trace)
    _labels(prim, GROUP, _token(label.group), trace)


def _shared(parts: Sequence[Part]) -> dict[str, Any]:
    """What an instance root or instancer stands for: all its parts, the largest first, with their labels."""
    ordered = sorted(parts, key=_size, reverse=True)
    names = [_token(part.label.name or part.label.group) if part.label else "" for part in ordered]
    groups = [_token(part.label.group) if part.label else "" for part in ordered]
    return {
        "parts": Vt.StringArray([_text(part.id) for part in ordered]),
        "classes": Vt.StringArray(names),
        "groups": Vt.StringArray(groups),
    }


def _size(part: Part) -> tuple[float, float]:
    # The box has a volume for open meshes too, so that all parts compare by the same measure.
    x, y, z = part.obb.extents
    return x * y * z, part.area


def _labels(prim: Any, taxonomy: str, label: str, trace: Mapping[str, Any] | None = None) -> None:
    attribute = _attribute(prim, f"semantics:labels:{taxonomy}", "TokenArray", Vt.TokenArray([label]))
    if trace:
        attribute.customData = dict(trace)


def _text(text: str) -> str:
    """Text that is safe in a layer: no control characters, no lone surrogates."""
    return " ".join(_CONTROL.sub(" ", text).split())


def _token(text: str) -> str:
    """A label without the characters that semantics readers split at."""
    return _text(_FORBIDDEN.sub(" ", text)) or "unnamed"


# Units, clusters and what joins them


def _targets_of_parts(
    scene: Scene, graph: SceneGraph, targets: Sequence[str], anchors: Sequence[Any]
) -> dict[str, list[Any]]:
    """The prims of each part: its meshes themselves (in an instance too), or what carries them where they are none."""
    index = {path: i for i, path in enumerate(scene.paths)}
    result: dict[str, list[Any]] = {}
    for part in graph.of_layer(Part):
        found = (_authorable(targets[i]) or anchors[i] for i in (index[mesh] for mesh in part.meshes))
        result[part.id] = [path for path in found if path is not None]
    return result


def _add_structure(layer: Any, root_name: str, graph: SceneGraph, prims_of_part: Mapping[str, list[Any]]) -> None:
    root = Sdf.Path.absoluteRootPath.AppendChild(root_name)
    _define(layer, root, "Scope")
    paths: dict[str, Any] = {}
    for scope, layer_type, name_of in _SCOPES:
        nodes = graph.of_layer(layer_type)
        taken: set[str] = set()
        if nodes:
            _define(layer, root.AppendChild(scope), "Scope")
        for node in nodes:
            name = name_of(node)
            path = root.AppendChild(scope).AppendChild(_claim(_identifier(name), taken))
            prim = _define(layer, path, "Scope", name)
            _string(prim, "cadgraph:id", node.id)
            paths[node.id] = path
    members: dict[str, list[str]] = {}
    for edge in graph.of_kind(Contains):
        members.setdefault(edge.source, []).append(edge.target)
    for unit in graph.of_layer(Unit):
        _describe_unit(layer.GetPrimAtPath(paths[unit.id]), unit, prims_of_part)
    for cluster in graph.of_layer(Cluster):
        prim = layer.GetPrimAtPath(paths[cluster.id])
        _string(prim, "cadgraph:kind", cluster.kind)
        _hold_parts(prim, members.get(cluster.id, ()), prims_of_part)
    ends: list[Junction | Terminal] = [*graph.of_layer(Junction), *graph.of_layer(Terminal)]
    for end in ends:
        _hold_parts(layer.GetPrimAtPath(paths[end.id]), end.parts, prims_of_part)
    for system in graph.of_layer(System):
        _relate(layer.GetPrimAtPath(paths[system.id]), "units", (paths[u] for u in system.units if u in paths))
    _add_relations(layer, graph, paths)


def _describe_unit(prim: Any, unit: Unit, prims_of_part: Mapping[str, list[Any]]) -> None:
    _apply(prim, f"SemanticsLabelsAPI:{UNIT}")
    _labels(prim, UNIT, _token(unit.unit_type))
    _string(prim, "cadgraph:tag", unit.tag)
    _string(prim, "cadgraph:unitType", unit.unit_type)
    _string(prim, "cadgraph:kind", unit.kind)
    _hold_parts(prim, unit.parts, prims_of_part)


def _hold_parts(prim: Any, parts: Iterable[str], prims_of_part: Mapping[str, list[Any]]) -> None:
    """Names the prims of these parts twice: as a relationship, and as a collection that tools can select and hide."""
    held = [path for part in parts for path in prims_of_part.get(part, ())]
    _relate(prim, "parts", held)
    _apply(prim, "CollectionAPI:parts")
    _attribute(prim, "collection:parts:expansionRule", "Token", "expandPrims", uniform=True)
    includes = Sdf.RelationshipSpec(prim, "collection:parts:includes", custom=False)
    includes.targetPathList.explicitItems = list(dict.fromkeys(held))


def _add_relations(layer: Any, graph: SceneGraph, paths: Mapping[str, Any]) -> None:
    """``related`` and ``connected`` hold both ways; ``flowsTo`` points downstream where the direction is known."""
    found: dict[tuple[str, str], list[Any]] = {}

    def add(kind: str, source: str, target: str) -> None:
        if source in paths and target in paths:
            found.setdefault((source, kind), []).append(paths[target])

    edges: list[Related | Connected] = [*graph.of_kind(Related), *graph.of_kind(Connected)]
    for edge in edges:
        add(edge.kind, edge.source, edge.target)
        add(edge.kind, edge.target, edge.source)
        if isinstance(edge, Connected) and edge.direction == "forward":
            add("flowsTo", edge.source, edge.target)
        if isinstance(edge, Connected) and edge.direction == "backward":
            add("flowsTo", edge.target, edge.source)
    for (source, kind), targets in found.items():
        _relate(layer.GetPrimAtPath(paths[source]), kind, targets)


_SCOPES: tuple[tuple[str, Any, Callable[[Any], str]], ...] = (
    ("Units", Unit, lambda node: node.tag),
    ("Clusters", Cluster, lambda node: node.id),
    ("Junctions", Junction, lambda node: node.id),
    ("Terminals", Terminal, lambda node: node.id),
    ("Systems", System, lambda node: node.id),
)


# Names and geometry of a source that is not USD


def _identifier(name: str) -> str:
    cleaned = re.sub(r"[^A-Za-z0-9_]", "_", name)
    return f"_{cleaned}" if not cleaned or cleaned[0].isdigit() else cleaned


def _unused(name: str, taken: set[str]) -> str:
    if name not in taken:
        return name
    number = 2
    while f"{name}_{number}" in taken:
        number += 1
    return f"{name}_{number}"


def _claim(name: str, taken: set[str]) -> str:
    free = _unused(name, taken)
    taken.add(free)
    return free


def _tree(scene: Scene) -> tuple[list[Any], list[tuple[Any, str]]]:
    """A prim path for each mesh, and the prims above them with their original names, parents first."""
    steps_of_mesh = [tuple(step for step in path.split("/") if step) for path in scene.paths]
    inner = {steps[:depth] for steps in steps_of_mesh for depth in range(1, len(steps))}
    world = Sdf.Path.absoluteRootPath.AppendChild(_WORLD)
    groups: dict[tuple[str, ...], Any] = {(): world}
    taken: dict[Any, set[str]] = {}
    named: list[tuple[Any, str]] = []

    def child(parent: Any, name: str) -> Any:
        return parent.AppendChild(_claim(_identifier(name), taken.setdefault(parent, set())))

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
        prim = _define(layer, path, "Mesh")
        prim.specifier = Sdf.SpecifierClass
        found[row] = path, _fill_mesh(prim, *scene.shapes.mesh(row))
    return found


def _define_mesh(layer: Any, path: Any, scene: Scene, index: int, shared: Mapping[int, tuple[Any, Floats]]) -> None:
    source_path = scene.paths[index]
    prim = _define(layer, path, "Mesh", source_path.rsplit("/", 1)[-1])
    prim.customData = {"cadgraph": {"path": _text(source_path)}}
    placement = scene.placement
    if placement is not None and (shape := int(placement.shape[index])) in shared:
        at, center = shared[shape]
        prim.referenceList.prependedItems = [Sdf.Reference("", at)]
        matrix = np.eye(4)
        matrix[:3, :3] = placement.turn[index]
        matrix[3, :3] = center @ placement.turn[index] + placement.shift[index]
        _attribute(prim, "xformOp:transform", "Matrix4d", Gf.Matrix4d(*matrix.reshape(-1).tolist()))
        _attribute(prim, "xformOpOrder", "TokenArray", Vt.TokenArray(["xformOp:transform"]), uniform=True)
    else:
        _translate(prim, _fill_mesh(prim, *scene.mesh(index)))
    color = scene.colors[index]
    if np.isfinite(color).all():
        shown = _attribute(
            prim, "primvars:displayColor", "Color3fArray", Vt.Vec3fArray.FromNumpy(np.float32(color[None]))
        )
        shown.SetInfo("interpolation", "constant")


def _fill_mesh(prim: Any, vertices: Floats, faces: Faces) -> Floats:
    """Gives a prim points about the middle of the mesh, which is returned, and faces."""
    center: Floats = (vertices.min(axis=0) + vertices.max(axis=0)) / 2 if len(vertices) else np.zeros(3)
    points = np.ascontiguousarray(vertices - center, np.float32)
    _attribute(prim, "points", "Point3fArray", Vt.Vec3fArray.FromNumpy(points))
    _attribute(prim, "faceVertexCounts", "IntArray", Vt.IntArray(len(faces), 3))
    corners = np.ascontiguousarray(faces, np.int32).reshape(-1)
    _attribute(prim, "faceVertexIndices", "IntArray", Vt.IntArray.FromNumpy(corners))
    _attribute(prim, "subdivisionScheme", "Token", "none", uniform=True)
    # CAD surfaces are often open, and their back faces matter.
    _attribute(prim, "doubleSided", "Bool", True, uniform=True)
    if len(points):
        extent = np.stack([points.min(axis=0), points.max(axis=0)])
        _attribute(prim, "extent", "Float3Array", Vt.Vec3fArray.FromNumpy(extent))
    return center


def _translate(prim: Any, offset: Any) -> None:
    if np.any(offset):
        _attribute(prim, "xformOp:translate", "Double3", tuple(float(x) for x in offset))
        _attribute(prim, "xformOpOrder", "TokenArray", Vt.TokenArray(["xformOp:translate"]), uniform=True)


# Small pieces of Sdf


def _define(layer: Any, path: Any, type_name: str, display_name: str | None = None) -> Any:
    prim = Sdf.CreatePrimInLayer(layer, path)
    prim.specifier = Sdf.SpecifierDef
    prim.typeName = type_name
    if display_name is not None and _text(display_name) != path.name:
        prim.SetInfo("displayName", _text(display_name))
    return prim


def _apply(prim: Any, *schemas: str) -> None:
    listed = prim.GetInfo("apiSchemas").prependedItems if prim.HasInfo("apiSchemas") else []
    operation = Sdf.TokenListOp()
    operation.prependedItems = [*listed, *schemas]
    prim.SetInfo("apiSchemas", operation)


def _attribute(prim: Any, name: str, type_name: str, value: Any, uniform: bool = False, custom: bool = False) -> Any:
    variability = Sdf.VariabilityUniform if uniform else Sdf.VariabilityVarying
    attribute = Sdf.AttributeSpec(prim, name, getattr(Sdf.ValueTypeNames, type_name), variability, custom)
    attribute.default = value
    return attribute


def _string(prim: Any, name: str, value: str | None) -> None:
    if value is not None:
        _attribute(prim, name, "String", _text(value), custom=True)


def _relate(prim: Any, kind: str, targets: Iterable[Any]) -> None:
    relationship = Sdf.RelationshipSpec(prim, f"cadgraph:{kind}", custom=True)
    relationship.targetPathList.explicitItems = list(dict.fromkeys(targets))
