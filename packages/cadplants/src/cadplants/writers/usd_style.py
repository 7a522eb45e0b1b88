"""How a plant is put down in USD: unit, up axis, instances, frames, polygons."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

__all__ = ["WAYS", "Instances", "UsdStyle", "draw_style"]

Instances = Literal["none", "native", "nested", "point", "mixed"]

WAYS: tuple[Instances, ...] = ("none", "native", "nested", "point")
_UNITS = (1.0, 0.01, 0.001, 0.0254, 0.3048, 0.1)  # m, cm, mm, inch, foot, dm


@dataclass(frozen=True)
class UsdStyle:
    """How a plant is put down in USD.

    Args:
        meters_per_unit: length of an authored unit [m]; 0.001 and 0.01 are common.
        up_axis: authored up axis.
        instances: what becomes of repeated shapes: ``none`` (each is a mesh), ``native`` instances of one prototype,
            ``nested`` ones (an instance in a prototype of another), items of ``point`` instancers, or ``mixed``.
        nested: how many levels of frames lie above a mesh, each level with a frame of its own.
        skewed: whether these frames are turned by any angle and scaled, rather than by quarters.
        colors: whether colours are written.
        shuffle: whether meshes come in random order.
        polygons: share of meshes with polygons (quads, concave outlines, whole caps) instead of triangles.
    """

    meters_per_unit: float = 0.001
    up_axis: Literal["Y", "Z"] = "Z"
    instances: Instances = "none"
    nested: int = 2
    skewed: bool = False
    colors: bool = True
    shuffle: bool = True
    polygons: float = 0.0


def draw_style(seed: int) -> UsdStyle:
    """A way to put a plant down at random: unit, up axis, instances, frames, polygons."""
    rng = np.random.default_rng([seed, 10])
    ways: tuple[Instances, ...] = (*WAYS, "mixed", "mixed")
    return UsdStyle(
        meters_per_unit=_UNITS[int(rng.integers(len(_UNITS)))],
        up_axis="Y" if rng.random() < 0.5 else "Z",
        instances=ways[int(rng.integers(len(ways)))],
        nested=int(rng.integers(0, 5)),
        skewed=bool(rng.random() < 0.5),
        colors=bool(rng.random() < 0.85),
        polygons=float(rng.choice([0.0, 0.5, 1.0])),
    )
