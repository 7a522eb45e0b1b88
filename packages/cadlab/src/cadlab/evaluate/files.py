"""An evaluation of files, written down as a page, as JSON and as figures."""

from __future__ import annotations

import json
from pathlib import Path

from cadgraph._io.atomic import ensure_writable, write_atomically
from cadgraph.model.graph import SceneGraph
from cadgraph.model.truth import Truth
from cadlab.evaluate.evaluation import Evaluation, evaluate
from cadlab.evaluate.figures import figures
from cadlab.evaluate.plain import to_json
from cadlab.evaluate.tables import to_markdown

__all__ = ["evaluate_files"]


def evaluate_files(graph_path: str | Path, truth_path: str | Path, folder: str | Path | None = None) -> Evaluation:
    """Compares a graph file with a truth file.

    Args:
        graph_path: ``graph.json``, or the folder that holds it.
        truth_path: a ``.truth.json`` file.
        folder: gets ``evaluation.md``, ``evaluation.json`` and the figures; nothing is written if None.

    Returns:
        All measures.

    Raises:
        FormatError: a file is missing or malformed, or the truth is of another scene.
        LabelError: the vocabulary in the graph is malformed.
        OutputError: the folder can't be written.
    """
    target = ensure_writable(folder) if folder is not None else None
    evaluation = evaluate(SceneGraph.load(graph_path), Truth.load(truth_path))
    if target is not None:
        drawn = figures(evaluation, target)
        write_atomically(target / "evaluation.md", to_markdown(evaluation, [path.name for path in drawn]))
        text = json.dumps(to_json(evaluation), ensure_ascii=False, allow_nan=False, indent=1)
        write_atomically(target / "evaluation.json", text.encode("utf-8", "backslashreplace") + b"\n")
    return evaluation
