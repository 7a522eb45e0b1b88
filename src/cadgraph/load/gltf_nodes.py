"""The nodes of a glTF file and their paths, for its reader and for what is written back into it.

A path is the names from the root down, ``/Skid/Valve_1/Body``: the node's name, else its mesh's, else ``node_7``, each
made unique among its siblings. Numbers in brackets are sections of the Khronos glTF 2.0 specification.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeVar

from cadgraph.load.gltf_file import BROKEN, Gltf
from cadgraph.load.naming import Names, path_step
from cadgraph.load.packing import Notes

__all__ = ["MOST_DEEP", "node_paths", "root_nodes", "walk_nodes"]

MOST_DEEP = 200
"""Levels of a tree that are walked; ours, far beyond any real assembly."""

_T = TypeVar("_T")


def walk_nodes(
    gltf: Gltf,
    top: _T,
    enter: Callable[[Mapping[str, Any], str, _T], _T | None],
    notes: Notes,
    seen: set[int] | None = None,
) -> Iterator[tuple[int, str, _T]]:
    """Every node of the scene with its path, parents first, siblings in the order of the file.

    Args:
        gltf: the opened file; its tree may hold anything.
        top: what ``enter`` gets as that of the parent for nodes at the top.
        enter: makes of a node, its path and what was made of its parent what the node is given out with; None leaves
            it out with all below it.
        notes: gets what is passed over (``broken-node``, ``repeated-node``, ``too-deep``).
        seen: is filled with the numbers of all nodes in the scene, those that are left out too.

    Yields:
        The number of the node, its path, and what ``enter`` made of it.
    """
    known = set() if seen is None else seen
    stack: list[tuple[int, str, _T, int]] = []

    def take(numbers: list[int], above: str, given: _T, depth: int) -> None:
        taken = Names()
        entered = []
        for number in numbers:
            try:
                node = gltf.item("nodes", number)
            except BROKEN as error:
                notes.add("broken-node", f"left out: it can't be read ({error!s:.120})", above or "/")
                continue
            # A name counts even where its node is passed over, so that those of its siblings stay the same.
            path = f"{above}/{taken.take(_step(gltf, node, number))}"
            if number in known:
                notes.add("repeated-node", "left out: a node belongs to one place only, and it was at another", path)
                continue
            known.add(number)
            made = enter(node, path, given)
            if made is None:
                _pass_over(gltf, _children(node), known)
            else:
                entered.append((number, path, made, depth))
        stack.extend(reversed(entered))

    take(root_nodes(gltf), "", top, 0)
    while stack:
        number, path, made, depth = stack.pop()
        yield number, path, made
        children = _children(gltf.item("nodes", number))
        if depth < MOST_DEEP:
            take(children, path, made, depth + 1)
        elif children:
            _pass_over(gltf, children, known)
            notes.add("too-deep", f"what lies deeper than {MOST_DEEP} nodes below it was left out", path)


def node_paths(gltf: Gltf) -> Iterator[tuple[str, int]]:
    """Every node of the scene that a path leads to, hidden ones too, with its number; parents first."""
    for number, path, _ in walk_nodes(gltf, True, lambda node, path, above: above, Notes()):
        yield path, number


def root_nodes(gltf: Gltf) -> list[int]:
    """The nodes at the top: those of the default scene, else of the first, else all that are nobody's child [3.5.1]."""
    scenes = gltf.rows("scenes")
    if scenes:
        try:
            return _numbers(gltf.item("scenes", gltf.tree.get("scene", 0)).get("nodes", []))
        except BROKEN:
            first = scenes[0]
            return _numbers(first.get("nodes", [])) if isinstance(first, dict) else []
    nodes = gltf.rows("nodes")
    below = {child for node in nodes if isinstance(node, dict) for child in _children(node)}
    return [number for number in range(len(nodes)) if number not in below]


def _children(node: Mapping[str, Any]) -> list[int]:
    return _numbers(node.get("children", []))


def _numbers(found: Any) -> list[int]:
    # A truth value is an int to Python, but no number of a node.
    return [number for number in found if type(number) is int] if isinstance(found, list) else []


def _pass_over(gltf: Gltf, numbers: list[int], known: set[int]) -> None:
    """Counts nodes and all below them as seen."""
    left = list(numbers)
    nodes = gltf.rows("nodes")
    while left:
        known.add(number := left.pop())
        if 0 <= number < len(nodes) and isinstance(nodes[number], dict):
            left += [child for child in _children(nodes[number]) if child not in known]


def _step(gltf: Gltf, node: Mapping[str, Any], number: int) -> str:
    name, mesh, meshes = node.get("name"), node.get("mesh"), gltf.rows("meshes")
    if not name and isinstance(mesh, int) and 0 <= mesh < len(meshes):
        name = meshes[mesh].get("name") if isinstance(meshes[mesh], dict) else None
    return path_step(name, f"node_{number}")
