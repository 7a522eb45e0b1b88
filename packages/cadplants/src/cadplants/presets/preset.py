"""The plants that can be asked for by name."""

from __future__ import annotations

from collections.abc import Callable

from cadplants.faults.defects import Defects, degrade
from cadplants.model.plant import Plant
from cadplants.presets.assortment import make_assortment
from cadplants.presets.field import make_field
from cadplants.presets.gallery import make_gallery
from cadplants.presets.loop import make_loop
from cadplants.presets.manifold import make_manifold
from cadplants.presets.pumps import make_pumps
from cadplants.presets.rack import make_rack
from cadplants.presets.riser import make_riser
from cadplants.presets.skid import make_skid
from cadplants.presets.station import make_station
from cadplants.presets.tank import make_tank
from cadplants.styles.modeling_style import STYLES, ModelingStyle

__all__ = ["PRESETS", "make"]

PRESETS: dict[str, Callable[[int, ModelingStyle | None], Plant]] = {
    "assortment": make_assortment,
    "field": make_field,
    "gallery": make_gallery,
    "loop": make_loop,
    "manifold": make_manifold,
    "pumps": make_pumps,
    "rack": make_rack,
    "riser": make_riser,
    "skid": make_skid,
    "station": make_station,
    "tank": make_tank,
}


def make(preset: str, seed: int = 0, style: str | None = None, defects: Defects | None = None) -> Plant:
    """Builds a plant.

    Args:
        preset: a key of ``PRESETS``.
        seed: of everything that varies.
        style: a key of ``STYLES``; the preset's own choice by default, but plant-design CAD where defects are a
            matter of style.
        defects: what is spoilt; nothing by default.

    Raises:
        ValueError: an unknown preset or style.
    """
    if preset not in PRESETS:
        raise ValueError(f"unknown preset {preset!r}; there are {', '.join(PRESETS)}")
    if style is not None and style not in STYLES:
        raise ValueError(f"unknown style {style!r}; there are {', '.join(STYLES)}")
    chosen = STYLES[style] if style is not None else None
    if defects is not None and defects.of_style(STYLES["plant-design"]) != STYLES["plant-design"]:
        chosen = defects.of_style(chosen or STYLES["plant-design"])
    plant = PRESETS[preset](seed, chosen)
    return degrade(plant, defects, seed) if defects is not None else plant
