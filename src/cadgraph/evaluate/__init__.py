"""How well a graph agrees with what is known for certain about its scene."""

from cadgraph.evaluate.evaluation import Evaluation, StructureScores, evaluate, evaluate_files
from cadgraph.evaluate.figures import figures
from cadgraph.evaluate.plain import to_json
from cadgraph.evaluate.tables import to_markdown
from cadgraph.evaluate.usd import truth_from_usd

__all__ = [
    "Evaluation",
    "StructureScores",
    "evaluate",
    "evaluate_files",
    "figures",
    "to_json",
    "to_markdown",
    "truth_from_usd",
]
