"""How well a graph agrees with what is known for certain about its scene."""

from cadlab.evaluate.evaluation import Evaluation, StructureScores, evaluate
from cadlab.evaluate.figures import figures
from cadlab.evaluate.files import evaluate_files
from cadlab.evaluate.plain import to_json
from cadlab.evaluate.tables import to_markdown
from cadplants.writers.labelled_usd import truth_from_usd

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
