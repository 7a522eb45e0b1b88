"""Generated test plants with their ground truth."""

from cadgraph.environment.hand import HANDS, Hand
from cadgraph.environment.imperfection import Sins, draw_sins, spoil
from cadgraph.environment.plant import Component, Plant
from cadgraph.environment.preset import PRESETS, make
from cadgraph.environment.riser import make_riser
from cadgraph.environment.skid import make_skid
from cadgraph.environment.tank import make_tank
from cadgraph.environment.usd import UsdStyle, draw_style, truth_path, write_usd

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
