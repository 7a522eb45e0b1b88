"""The source and its labels as one USD stage of its own, with every label in the layer that defines its prim.

Some renderers look for labels where a prim is defined, and miss those of a layer above a payload, a reference or an
instance. Here everything that the source is composed of is resolved into one layer: sublayers, references, payloads
and variants. Instances stay instances where their labels agree, see :mod:`cadgraph.export.baked_labels`.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from pxr import Sdf, Tf, UsdUtils

from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError, OutputError
from cadgraph.export.baked_files import Files
from cadgraph.export.baked_labels import LayerLabels
from cadgraph.export.source import settings_of
from cadgraph.export.usd import (
    authorable_paths,
    export_layer,
    geometry_layer,
    is_split,
    prim_paths,
    reason_of,
    targets_of_parts,
)
from cadgraph.export.usd_labels import add_structure, dispositions_of, parts_of_meshes
from cadgraph.export.usd_paths import check_source, is_usd
from cadgraph.export.usd_specs import unused
from cadgraph.load.packing import Notes
from cadgraph.load.usd_assets import open_stage
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.graph import SceneGraph
from cadgraph.model.scene import Scene

__all__ = ["write_baked"]

_SUFFIXES = (".usdc", ".usda", ".usd")


def write_baked(
    scene: Scene, graph: SceneGraph, source_path: str | Path, path: str | Path, *, open_instances: bool = False
) -> tuple[Path, tuple[Diagnostic, ...]]:
    """Writes the source with its labels, units and clusters as one stage.

    Materials, units, up axis and everything else of the source stay. Files that it shows without being composed of
    them, as textures, are referred to from the new place; those within a package (``.usdz``) are written beside.

    Args:
        scene: the loaded scene with all meshes of the source.
        graph: the finished graph of this scene.
        source_path: the file that the scene was loaded from.
        path: the file to write: ``.usdc`` or ``.usd`` (binary), ``.usda`` (text).
        open_instances: whether to open all native instances, for renderers that skip them.

    Returns:
        The file, and notes: ``instances`` counts what was kept and opened, ``mixed-items`` names point instancers with
        items whose label couldn't be kept, ``outside-files`` counts files to copy with the stage, ``missing-files``
        those that weren't found, ``no-default-prim`` says where none could be chosen.

    Raises:
        ValueError: the graph names a mesh that the scene doesn't have, or the file doesn't end as one of USD.
        LoadError: the source can't be opened any more.
        FormatError: the graph was made with settings that aren't known any more.
        OutputError: the file can't be written, or would overwrite the source.
    """
    source, target = Path(source_path), Path(path)
    if target.suffix.lower() not in _SUFFIXES:
        raise ValueError(f"{target}: a stage ends in {' or '.join(_SUFFIXES)}")
    check_source(source, target)
    files = Files(target)
    if is_usd(source) and not is_split(scene):
        layer, paths, anchors = _flattened(source, settings_of(graph)), scene.paths, scene.anchors or scene.paths
        files.move(layer)
    else:
        layer, paths = geometry_layer(scene), prim_paths(scene)
        anchors = paths
    notes = _complete(layer, scene)
    dispositions, parts = dispositions_of(graph), parts_of_meshes(scene, graph)
    baked = LayerLabels(
        layer,
        dict(zip(paths, parts, strict=True)),
        {path: dispositions.get(mesh, ()) for path, mesh in zip(paths, scene.paths, strict=True)},
        open_instances,
    )
    baked.write()
    roots = {prim.name for prim in layer.rootPrims}
    held = targets_of_parts(scene, graph, *authorable_paths(paths, anchors))
    add_structure(layer, unused("CadGraph", roots), graph, held)
    written = export_layer(layer, target)
    return written, (*notes, *_told(baked), *files.notes())


def _flattened(source: Path, settings: LoadConfig) -> Any:
    """All that a source is composed of, in one layer."""
    with _quiet():
        try:
            # What lies outside the folder of the scene was told when it was loaded.
            stage, _ = open_stage(Path(os.path.abspath(source).replace(os.sep, "/")), settings, Notes())
            layer = stage.Flatten(addSourceFileComment=False)
        except Tf.ErrorException as error:
            raise LoadError(f"{source}: can't be opened as USD ({reason_of(error)})") from None
    if layer is None:
        raise OutputError(f"{source}: can't be written as one layer; leave --bake out")
    return layer


@contextmanager
def _quiet() -> Iterator[None]:
    # What the library says of the source has been said when it was loaded.
    delegate = UsdUtils.CoalescingDiagnosticDelegate()
    try:
        yield
    finally:
        delegate.TakeUncoalescedDiagnostics()


def _complete(layer: Any, scene: Scene) -> list[Diagnostic]:
    """Says what readers need of a stage where the source left it out."""
    root = layer.pseudoRoot
    if not root.HasInfo("upAxis"):
        root.SetInfo("upAxis", scene.source.up_axis)
    if not root.HasInfo("metersPerUnit"):
        root.SetInfo("metersPerUnit", scene.source.meters_per_unit)
    layer.customLayerData = {**dict(layer.customLayerData), "cadgraph": {"source_sha256": scene.source.sha256}}
    if layer.defaultPrim and layer.GetPrimAtPath(f"/{layer.defaultPrim}"):
        return []
    shown = [prim.name for prim in layer.rootPrims if prim.specifier == Sdf.SpecifierDef]
    if len(shown) == 1:
        layer.defaultPrim = shown[0]
        return []
    message = f"the source names no default prim and has {len(shown)} roots; whoever refers to the stage must name one"
    return [Diagnostic("no-default-prim", message)]


def _told(baked: LayerLabels) -> list[Diagnostic]:
    notes = []
    if baked.n_kept or baked.n_opened or baked.n_split:
        message = (
            f"{baked.n_kept:,} instances stay instances, {baked.n_opened:,} were opened; "
            f"{baked.n_split:,} prototypes were added to point instancers"
        )
        notes.append(Diagnostic("instances", message))
    if baked.mixed:
        message = "point instancers whose prototypes change over time: items keep the label of most"
        notes.append(Diagnostic("mixed-items", message, tuple(dict.fromkeys(baked.mixed))))
    return notes
