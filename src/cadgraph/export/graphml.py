"""The graph as GraphML, for yEd, Gephi, Cytoscape and networkx."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from cadgraph._io.atomic import replacing
from cadgraph._io.text import xml_text
from cadgraph.model.graph import SceneGraph

__all__ = ["write_graphml"]

# networkx reads attributes as keyword arguments, so that these names of its own parameters would stop it.
_RESERVED = frozenset({"self", "node_for_adding", "u_for_edge", "v_for_edge", "key"})


def write_graphml(graph: SceneGraph, path: str | Path) -> Path:
    """Writes all nodes and edges as a directed GraphML graph.

    GraphML knows numbers, booleans and text only. A label becomes ``label.group``, ``label.name`` and so on, a
    centroid or point becomes ``x``, ``y``, ``z`` [m], any other nested value JSON text; nulls are left out. Edges have
    unique ids, as some readers merge edges that share one. Characters that XML can't hold are dropped.

    Args:
        graph: what to write.
        path: the file.

    Returns:
        The file.

    Raises:
        OutputError: it can't be written.
    """
    import networkx

    ids: dict[str, str] = {}
    taken: set[str] = set()
    flat: networkx.MultiDiGraph[str] = networkx.MultiDiGraph()
    data = graph.to_json()
    for node in data["nodes"]:
        ids[node["id"]] = _unique(xml_text(node["id"]), taken)
        flat.add_node(ids[node["id"]])
        flat.nodes[ids[node["id"]]].update(_flatten(node, without=("id",)))
    for number, edge in enumerate(data["edges"]):
        source, target = ids[edge["source"]], ids[edge["target"]]
        flat.add_edge(source, target, number)
        flat.edges[source, target, number].update(_flatten(edge, without=("source", "target")))
    with replacing(path) as beside:
        # Not write_graphml, whose bytes depend on whether lxml happens to be installed.
        networkx.write_graphml_xml(flat, str(beside), encoding="utf-8", prettyprint=True)
    return Path(path)


def _flatten(values: Mapping[str, Any], without: tuple[str, ...]) -> Iterator[tuple[str, Any]]:
    for key, value in values.items():
        if key in without or value is None:
            continue
        name = f"{key}_" if key in _RESERVED else xml_text(key)
        if key == "label" and isinstance(value, Mapping):
            yield from ((f"label.{xml_text(k)}", _scalar(v)) for k, v in value.items() if v is not None)
        elif key in ("centroid", "point") and isinstance(value, list) and len(value) == 3:
            yield from zip("xyz", (float(x) for x in value), strict=True)
        else:
            yield name, _scalar(value)


def _scalar(value: Any) -> str | int | float | bool:
    if isinstance(value, (bool, int, float)):
        return value
    return xml_text(value if isinstance(value, str) else json.dumps(value, ensure_ascii=False))


def _unique(name: str, taken: set[str]) -> str:
    free, number = name, 2
    while free in taken:
        free, number = f"{name}_{number}", number + 1
    taken.add(free)
    return free
