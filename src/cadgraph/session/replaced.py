"""What a build into a folder does not take over from what was there, which nobody may have meant."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from cadgraph._io.limits import GRAPH, read_bytes_within
from cadgraph._io.manifest import GRAPH_FILE
from cadgraph.errors import CadGraphError
from cadgraph.model.graph import SceneGraph

__all__ = ["labels_there", "tell_lost_corrections", "tell_replaced"]

# As our own writer spells it; a graph is not read as a whole for that.
_SOURCE = re.compile(rb'"source": ?"(lvlm|context|author)"')
_OWN = re.compile(rb'"labeler": ?"own"')
_KINDS = {"lvlm": "model", "context": "model", "author": "outside"}
_MOST_TOLD = 5  # corrections that no longer fit, of which each is told


def labels_there(folder: Path) -> Counter[str]:
    """How many labels the graph in a folder has that no build gives again by itself, by where they came from.

    Args:
        folder: of an earlier run, or without one.
    """
    file = folder / GRAPH_FILE
    if not file.is_file():
        return Counter()
    try:
        content = read_bytes_within(file, GRAPH, CadGraphError, "")
    except (CadGraphError, OSError):
        return Counter()
    found = Counter(_KINDS[kind.decode()] for kind in _SOURCE.findall(content))
    return found + Counter({"program": 1} if _OWN.search(content) else {})


def tell_replaced(there: Counter[str], graph: SceneGraph) -> tuple[str, ...]:
    """Which of the labels that were there the graph in their place lacks, and how they come back.

    Args:
        there: see ``labels_there``.
        graph: that takes the place of the earlier one.
    """
    if not there:
        return ()
    now = Counter(_KINDS.get(part.label.source, "") for part in graph.parts() if part.label is not None)
    told = []
    if there["model"] and not now["model"]:
        told.append(
            f"the graph that was here had {_labels(there['model'])} of a vision-language model, this one has none; "
            "'cadgraph label' gives them again, from the answers that lie in the folder"
        )
    if there["outside"] and not now["outside"]:
        told.append(
            f"the graph that was here had {_labels(there['outside'])} from outside, this one has none; "
            "build it again with --labels"
        )
    if there["program"] and graph.config["label"]["labeler"] != "own":
        told.append("the graph that was here had labels of a program's own labeler, this one has those of the settings")
    return tuple(told)


def _labels(count: int) -> str:
    return f"{count:,} label{'s' * (count != 1)}"


def tell_lost_corrections(lost: Sequence[str], in_force: int) -> tuple[str, ...]:
    """Which corrections no longer fit, each with the reason, and what becomes of them.

    Args:
        lost: of a session.
        in_force: how many there are in all.
    """
    if not lost:
        return ()
    more = len(lost) - _MOST_TOLD
    rest = (f"and {more:,} more; 'cadgraph corrections' lists them",) if more > 0 else ()
    count = f"{len(lost):,} of {in_force:,} correction{'s' * (in_force != 1)} no longer fit{'s' * (len(lost) == 1)}"
    return (f"{count}; kept for a scene that holds what they are about:", *lost[:_MOST_TOLD], *rest)
