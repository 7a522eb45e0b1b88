"""Paths of the nodes of a glTF file, for its reader and for what is written back into it.

A path is the names from the root down, ``/Skid/Valve_1/Body``: the node's name, else its mesh's, else ``node_7``, each
made unique among its siblings.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from cadgraph.load.packing import unique_name

__all__ = ["MOST_DEEP", "node_paths"]

MOST_DEEP = 200
"""Levels of a tree that are walked; ours, far beyond any real assembly."""

_ODD = re.compile(r"[^\w.-]+")
_LONGEST = 200  # characters of a step; ours: names in plants have up to some 80


def node_paths(tree: Mapping[str, Any]) -> Iterator[tuple[str, int]]:
    """Every node of the scene with its path, parents first; what is broken or there twice is passed over.

    Args:
        tree: the JSON of the file; of any content.

    Yields:
        The path and the number of the node.
    """
    nodes = _rows(tree, "nodes")
    seen: set[int] = set()
    stack: list[tuple[str, int, int]] = []

    def enter(numbers: Any, path: str, depth: int) -> None:
        taken: set[str] = set()
        found = []
        for number in numbers if isinstance(numbers, list) else ():
            if type(number) is not int or not 0 <= number < len(nodes) or not isinstance(nodes[number], dict):
                continue
            # A name counts even where its node is passed over, so that those of its siblings stay the same.
            own = f"{path}/{unique_name(_step(tree, number), taken)}"
            if number not in seen:
                seen.add(number)
                found.append((own, number, depth))
        stack.extend(reversed(found))

    enter(_roots(tree), "", 0)
    while stack:
        path, number, depth = stack.pop()
        yield path, number
        if depth < MOST_DEEP:
            enter(nodes[number].get("children"), path, depth + 1)


def _rows(tree: Mapping[str, Any], name: str) -> list[Any]:
    found = tree.get(name)
    return found if isinstance(found, list) else []


def _roots(tree: Mapping[str, Any]) -> Any:
    scenes, number = _rows(tree, "scenes"), tree.get("scene", 0)
    if not scenes:
        # Without a scene the nodes that are nobody's child are the roots.
        nodes = _rows(tree, "nodes")
        below = {c for node in nodes if isinstance(node, dict) for c in _rows(node, "children") if type(c) is int}
        return [i for i in range(len(nodes)) if i not in below]
    scene = scenes[number if type(number) is int and 0 <= number < len(scenes) else 0]
    return scene.get("nodes") if isinstance(scene, dict) else None


def _step(tree: Mapping[str, Any], number: int) -> str:
    node, meshes = _rows(tree, "nodes")[number], _rows(tree, "meshes")
    name, mesh = node.get("name"), node.get("mesh")
    if not name and type(mesh) is int and 0 <= mesh < len(meshes) and isinstance(meshes[mesh], dict):
        name = meshes[mesh].get("name")
    text = name if isinstance(name, str) else ""
    return _ODD.sub("_", text[: 2 * _LONGEST]).strip("_.")[:_LONGEST] or f"node_{number}"
