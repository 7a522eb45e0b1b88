"""Generated test plants with their ground truth."""

from cadgraph.environment.hand import HANDS, Hand
from cadgraph.environment.plant import Component, Plant
from cadgraph.environment.skid import make_skid
from cadgraph.environment.usd import UsdStyle, truth_path, write_usd

__all__ = ["HANDS", "Component", "Hand", "Plant", "UsdStyle", "make_skid", "truth_path", "write_usd"]
