"""Generated industrial plants with their ground truth: an open benchmark for whoever reads CAD."""

from cadplants.defects import Sins, draw_sins, spoil
from cadplants.modeling_style import HANDS, Hand
from cadplants.plant import Component, Plant
from cadplants.preset import PRESETS, make
from cadplants.riser import make_riser
from cadplants.skid import make_skid
from cadplants.tank import make_tank
from cadplants.usd import UsdStyle, draw_style, truth_path, write_usd

__version__ = "0.1.0"

__all__ = [
    "HANDS",
    "PRESETS",
    "Component",
    "Hand",
    "Plant",
    "Sins",
    "UsdStyle",
    "draw_sins",
    "draw_style",
    "make",
    "make_riser",
    "make_skid",
    "make_tank",
    "spoil",
    "truth_path",
    "write_usd",
]
