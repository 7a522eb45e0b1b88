"""Writes a plant as USD the way unlabelled plants come: meaningless names, nested frames, any unit and up axis."""

from __future__ import annotations

import json
from pathlib import Path

from cadplants.model.plant import Plant
from cadplants.truth.truth_writer import truth_of
from cadplants.writers.together import together
from cadplants.writers.usd_style import UsdStyle

__all__ = ["truth_path", "write_usd"]


def truth_path(path: str | Path) -> Path:
    """Where the truth of a plant file lies: ``plant.usdc`` -> ``plant.truth.json``."""
    return Path(path).with_suffix(".truth.json")


def write_usd(plant: Plant, path: str | Path, style: UsdStyle | None = None) -> Path:
    """Writes a plant as USD with meaningless names, and its truth beside it.

    Both are written beside their targets first, then renamed over them, the truth before the scene.

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
    from cadplants.writers.usd_layer import LayerWriter  # brings the USD library

    layout = style or UsdStyle()
    with together(target, truth_path(target)) as (scene, beside):
        writer = LayerWriter(plant, layout)
        writer.save(scene)
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
        beside.write_bytes((json.dumps(truth, indent=1, sort_keys=False) + "\n").encode())
    return truth_path(target)
