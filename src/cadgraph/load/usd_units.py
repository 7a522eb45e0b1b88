"""Layers of one USD scene that measure in different units, or hold different axes for up.

USD takes lengths as they stand: only the root layer's ``metersPerUnit`` and ``upAxis`` count, so that what another
layer brings is too large or too small unless the prim that refers to it scales it. Notes: ``mixed-units``,
``mixed-up-axis``.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePosixPath
from typing import Any

import numpy as np
from pxr import Usd, UsdGeom

from cadgraph.load.packing import Notes

__all__ = ["note_mixed_units"]

_SAME = 1e-3  # units, and scales that make up for them, agree within this share
_AXES = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}


def note_mixed_units(stage: Any, notes: Notes) -> None:
    """Notes the layers whose own unit or up axis is not that of the layer that refers to them, and is not made up for.

    Args:
        stage: a ``Usd.Stage``, composed.
        notes: gets the paths of the prims that refer to such a layer.
    """
    units = {layer.identifier: _unit_of(layer) for layer in stage.GetUsedLayers()}
    axes = {layer.identifier: _axis_of(layer) for layer in stage.GetUsedLayers()}
    if len({round(np.log(unit), 3) for unit in units.values() if unit}) < 2 and len({*axes.values()} - {None}) < 2:
        return
    root = stage.GetRootLayer()
    for layer in stage.GetLayerStack(includeSessionLayers=False)[1:]:
        _note_layer(layer, root, "sublayer", None, notes)
    for prim, arc in _arcs(stage):
        target, by = arc.GetTargetLayer(), arc.GetIntroducingLayer()
        if not target or not by:
            continue
        if not _stated(by):
            by = root
        _note_layer(target, by, "reference", prim, notes)


def _note_layer(layer: Any, by: Any, way: str, prim: Any, notes: Notes) -> None:
    """Notes one layer that a prim, or the layer stack where there is none, brings in from another one."""
    own, others = _unit_of(layer), _unit_of(by)
    path = str(prim.GetPath()) if prim is not None else None
    scale, up = _made_up_for(prim) if prim is not None else (1.0, None)
    # Of two that agree a scale or a turn is the scene's own.
    if own and others and abs(own / others - 1) > _SAME and abs(own / others / scale - 1) > _SAME:
        notes.add(
            "mixed-units",
            f"{_name(layer)} is in units of {own:g} m, {_name(by)}, of which it is a {way}, in units of {others:g} m, "
            f"and nothing makes up for that; its lengths stay as they are. Scale it by {own / others:.6g} there",
            path,
        )
    own_axis, others_axis = _axis_of(layer), _axis_of(by)
    if own_axis in _AXES and others_axis in _AXES and own_axis != others_axis:
        turned = np.array(_AXES[own_axis]) if up is None else np.array(_AXES[own_axis]) @ up
        if turned @ np.array(_AXES[others_axis]) < 1 - _SAME:
            notes.add(
                "mixed-up-axis",
                f"up is {own_axis} in {_name(layer)}, {others_axis} in {_name(by)}, of which it is a {way}, and "
                "nothing makes up for that; it was taken as it lies. Turn it there",
                path,
            )


def _arcs(stage: Any) -> Iterator[tuple[Any, Any]]:
    """The prims that refer to other layers, with each such arc; those of prototypes too."""
    query = Usd.PrimCompositionQuery
    for start in (stage.GetPseudoRoot(), *stage.GetPrototypes()):
        for prim in Usd.PrimRange(start):
            if prim.HasAuthoredReferences() or prim.HasAuthoredPayloads():
                wanted = query(prim)
                filters = query.Filter()
                filters.dependencyTypeFilter = query.DependencyTypeFilter.Direct
                filters.arcTypeFilter = query.ArcTypeFilter.ReferenceOrPayload
                wanted.filter = filters
                for arc in wanted.GetCompositionArcs():
                    yield prim, arc


def _made_up_for(prim: Any) -> tuple[float, Any]:
    """By how much a prim scales what is below it, and the ``(3, 3)`` matrix by which it turns that, for row vectors."""
    if not prim.IsA(UsdGeom.Xformable):
        return 1.0, None
    matrix = np.array(UsdGeom.Xformable(prim).GetLocalTransformation())[:3, :3]
    volume = abs(float(np.linalg.det(matrix)))
    if not np.isfinite(volume) or volume <= 0:
        return 1.0, None
    scale = float(np.cbrt(volume))
    return scale, matrix / scale


def _stated(layer: Any) -> bool:
    return bool(layer.pseudoRoot.HasInfo("metersPerUnit"))


def _unit_of(layer: Any) -> float | None:
    unit = layer.pseudoRoot.GetInfo("metersPerUnit") if _stated(layer) else None
    return float(unit) if unit and np.isfinite(unit) and unit > 0 else None


def _axis_of(layer: Any) -> str | None:
    return str(layer.pseudoRoot.GetInfo("upAxis")) if layer.pseudoRoot.HasInfo("upAxis") else None


def _name(layer: Any) -> str:
    return PurePosixPath(layer.GetDisplayName() or layer.identifier).name
