"""Colours of USD prims: linear RGB from materials and ``displayColor``."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
import numpy.typing as npt
from pxr import Sdf, Tf, Usd, UsdShade

from cadgraph.load.packing import Notes
from cadgraph.load.polygons import Indices
from cadgraph.model.scene import Floats

__all__ = ["Materials", "mean_display_color", "usable_color"]

Color = npt.NDArray[np.float64]

# What shaders call their base colour: UsdPreviewSurface; MaterialX standard_surface and glTF PBR; OpenPBR; OmniPBR
# and other MDL; OmniGlass and OmniSurface.
_BASE_COLOR = (
    "diffuseColor",
    "base_color",
    "baseColor",
    "diffuse_color_constant",
    "diffuse_color",
    "diffuse_reflection_color",
    "glass_color",
    "color",
)
_CONTEXTS = ("", "mdl", "mtlx")
_MAX_CHAIN = 16  # connections followed from one input to the next; a longer chain is a cycle


class Materials:
    """The base colours of the materials of one stage, each looked up once.

    Args:
        stage: the open stage.
        notes: gets what of a damaged file can't be read.
    """

    def __init__(self, stage: Any, notes: Notes) -> None:
        self._stage = stage
        self._notes = notes
        self._colors: dict[str, Color | None] = {}

    def bound_colors(self, paths: Sequence[str], binding: Sequence[Sequence[str]]) -> list[Color | None]:
        """The base colour bound to each prim, or None.

        Args:
            paths: of meshes and subsets.
            binding: for each the paths of the prims that bind a material plainly, itself or the nearest above it
                first. They count where USD itself finds no binding: older exporters don't apply
                ``MaterialBindingAPI``.
        """
        if not paths:
            return []
        prims = [self._stage.GetPrimAtPath(path) for path in paths]
        compute = UsdShade.MaterialBindingAPI.ComputeBoundMaterials
        try:
            found: list[Any] = compute(prims, UsdShade.Tokens.full)[0]
        except Tf.ErrorException:
            # One that is damaged takes all others with it.
            found = [
                self._read(path, partial(compute, [prim], UsdShade.Tokens.full))
                for path, prim in zip(paths, prims, strict=True)
            ]
            found = [None if one is None else one[0][0] for one in found]
        return [
            self._read(path, partial(self._color_of, material, plain))
            for path, material, plain in zip(paths, found, binding, strict=True)
        ]

    def _read(self, path: str, read: Callable[[], Any]) -> Any:
        try:
            return read()
        except Tf.ErrorException:
            self._notes.add("usd-warning", "its material is damaged and can't be read: it has no colour", path)
            return None

    def _color_of(self, material: Any, plain: Sequence[str]) -> Color | None:
        path = str(material.GetPath()) if material else self._plain_target(plain)
        return self._color(path) if path else None

    def _plain_target(self, binding: Sequence[str]) -> str | None:
        for path in binding:
            prim = self._stage.GetPrimAtPath(path)
            for name in ("material:binding:full", "material:binding"):
                relationship = prim.GetRelationship(name)
                targets = relationship.GetForwardedTargets() if relationship else []
                if targets:
                    return str(targets[0])
        return None

    def _color(self, path: str) -> Color | None:
        if path not in self._colors:
            prim = self._stage.GetPrimAtPath(path) if Sdf.Path.IsValidPathString(path) else None
            material = UsdShade.Material(prim) if prim else None
            self._colors[path] = _base_color(material) if material else None
        return self._colors[path]


def _base_color(material: Any) -> Color | None:
    for context in _CONTEXTS:
        shader = material.ComputeSurfaceSource(context)[0]
        if not shader:
            continue
        for name in _BASE_COLOR:
            shader_input = shader.GetInput(name)
            if shader_input:
                color = _plain_value(shader_input)
                if color is not None:
                    return color
    return None


def _plain_value(shader_input: Any) -> Color | None:
    """The constant that feeds an input, through the inputs of its material; None where a texture feeds it."""
    for _ in range(_MAX_CHAIN):
        sources = shader_input.GetConnectedSources()[0]
        if not sources:
            return usable_color(_get(shader_input.GetAttr()))
        if sources[0].sourceType != UsdShade.AttributeType.Input:
            return None
        shader_input = sources[0].source.GetInput(sources[0].sourceName)
        if not shader_input:
            return None
    return None


def _get(attribute: Any) -> Any:
    value = attribute.Get()
    return attribute.Get(Usd.TimeCode.EarliestTime()) if value is None else value


def usable_color(value: Any) -> Color | None:
    """Three finite numbers as a colour (a fourth, opacity, is dropped), or None."""
    try:
        color = np.asarray(value, np.float64).reshape(-1)
    except (TypeError, ValueError):
        return None
    return color[:3] if len(color) in (3, 4) and np.isfinite(color[:3]).all() else None


def mean_display_color(
    values: Floats, interpolation: str, counts: Indices, corners: Indices, polygon: Indices, areas: Floats
) -> Color | None:
    """The area-weighted mean of a ``displayColor`` that varies over a mesh.

    Args:
        values: ``(n, 3)``, one for each polygon (``uniform``), point (``vertex``, ``varying``) or polygon corner
            (``faceVarying``).
        interpolation: which of these.
        counts: ``(n_polygons,)`` corners of each polygon.
        corners: ``(n_triangles, 3)`` points of each triangle.
        polygon: ``(n_triangles,)`` the polygon of each triangle.
        areas: ``(n_triangles,)``.

    Returns:
        The mean, or None where the number of values doesn't fit.
    """
    if interpolation == "uniform" and len(values) == len(counts):
        of_triangle = values[polygon]
    elif interpolation in ("vertex", "varying") and len(corners) and corners.max() < len(values):
        of_triangle = values[corners].mean(axis=1)
    elif interpolation == "faceVarying" and len(values) == counts.sum():
        sums = np.zeros((len(counts), 3))
        np.add.at(sums, np.repeat(np.arange(len(counts)), counts), values)
        of_triangle = sums[polygon] / counts[polygon, None]
    else:
        return None
    weights = areas if areas.sum() > 0 else np.ones(len(areas))
    return usable_color(weights @ of_triangle / weights.sum())
