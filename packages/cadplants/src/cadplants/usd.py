"""Writes a plant as USD the way unlabelled plants come: meaningless names, nested frames, any unit and up axis."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from cadgraph._io.atomic import replacing, write_atomically
from cadplants.plant import Plant
from cadplants.truth_writer import truth_of

__all__ = ["WAYS", "Instances", "UsdStyle", "draw_style", "truth_path", "write_usd"]

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


def truth_path(path: str | Path) -> Path:
    """Where the truth of a plant file lies: ``plant.usdc`` -> ``plant.truth.json``."""
    return Path(path).with_suffix(".truth.json")


def write_usd(plant: Plant, path: str | Path, style: UsdStyle | None = None) -> Path:
    """Writes a plant as USD with meaningless names, and its truth beside it.

    Both are written beside their targets first, then renamed over them.

    Args:
        plant: what to write.
        path: ends in ``.usd``, ``.usda`` or ``.usdc``.
        style: millimetres, Z up, no instances by default.

    Returns:
        The path of the truth file.

    Raises:
        ValueError: the suffix is none of these.
        OutputError: a file can't be written.
    """
    target = Path(path)
    if target.suffix not in (".usd", ".usda", ".usdc"):
        raise ValueError(
            f"{target}: a plant is written as .usd, .usda or .usdc, not {target.suffix or 'without suffix'!r}"
        )
    from cadplants.usd_layer import LayerWriter  # brings the USD library

    layout = style or UsdStyle()
    with replacing(target) as beside:
        writer = LayerWriter(plant, layout)
        writer.save(beside)
    truth = truth_of(plant, writer.paths)
    for index in sorted(writer.polygonal):
        truth["flaws"].setdefault(writer.paths[index], []).append("polygons")
    truth |= {
        "colors": plant.colors if layout.colors else "none",
        "instances": layout.instances,
        "nested": layout.nested,
        "meters_per_unit": layout.meters_per_unit,
        "up_axis": layout.up_axis,
    }
    write_atomically(truth_path(target), json.dumps(truth, indent=1, sort_keys=False) + "\n")
    return truth_path(target)
