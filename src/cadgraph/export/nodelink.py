"""The graph as networkx's node-link JSON: what ``graph.json`` holds, without all that is not nodes and edges."""

from __future__ import annotations

import json
from pathlib import Path

from cadgraph._io.atomic import write_atomically
from cadgraph.model.graph import SceneGraph

__all__ = ["write_nodelink"]


def write_nodelink(graph: SceneGraph, path: str | Path) -> Path:
    """Writes nodes and edges as ``networkx.node_link_graph(data, edges="edges")`` reads them.

    Each edge has a ``key``, so that parallel edges stay apart in readers that merge them.

    Args:
        graph: what to write.
        path: the file.

    Returns:
        The file.

    Raises:
        OutputError: it can't be written.
    """
    import networkx

    data = networkx.node_link_data(graph.to_networkx(), edges="edges")
    # ASCII with escapes: any reader takes it, whatever it thinks the encoding is.
    write_atomically(path, json.dumps(data, ensure_ascii=True, indent=1) + "\n")
    return Path(path)
