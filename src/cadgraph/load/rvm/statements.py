"""What an RVM file and its attribute file say of the parts: facts, and the order along branches."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from cadgraph.load.rvm.attributes import Attributes
from cadgraph.load.rvm.tree import Tree
from cadgraph.model.facts import Fact, FactKey, StatedLink
from cadgraph.model.scene import Ints

__all__ = ["Owner", "find_facts", "find_links"]

_BRANCHES = ("BRAN", "BRANCH")
_SYSTEMS = ("PIPE", "ZONE")  # the nearest one above counts, a pipe before the zone that holds it
_TAGGED = frozenset(
    ("EQUI", "EQUIPMENT", "INST", "INSTRUMENT", "VALV", "VALVE", "VTWA", "VFWA", "VENT", "PCOM", "FILT", "FILTER",
     "TRAP", "DAMP", "DAMPER")
)  # fmt: skip
_NO_MEMBER = frozenset(("ATTA", "ATTACHMENT", "WELD"))  # of a pipe: symbols and seams, through which nothing goes
_TUBE = "TUBI"  # what PDMS calls the straight pipe that it draws on a branch between its members
_ATTRIBUTES: tuple[tuple[FactKey, tuple[str, ...]], ...] = (
    ("spec", ("SPREF",)),
    ("description", ("DESC", "DESCRIPTION")),
    ("description", ("DTXR",)),
    ("description", ("FUNC", "FUNCTION")),
    ("predefined", ("GTYP", "GTYPE")),
    ("type", ("STYP", "STYPE")),
    ("size", ("BORE",)),
    ("size", ("HBOR", "HBORE")),
    ("size", ("ABOR", "ABORE")),
    ("size", ("LBOR", "LBORE")),
)
_NOTHING: dict[str, str] = {}
_NO_SIZE = frozenset(("0", "0mm", "0in", "0.0"))


@dataclass(frozen=True)
class Owner:
    """The meshes of a scene and the nodes that they come from.

    Args:
        tree: of the file.
        paths: ``(n_meshes,)`` of the meshes.
        node: ``(n_meshes,)`` of each, -1: none.
        chunk: ``(n_meshes,)`` where each stands in the file.
        whole: ``(n_meshes,)`` whether it is its node, not one of the primitives of it.
        attributes: of the elements, by name.
    """

    tree: Tree
    paths: Sequence[str]
    node: Ints
    chunk: Ints
    whole: Sequence[bool]
    attributes: Attributes
    _types: list[str] = field(init=False)

    def __post_init__(self) -> None:
        tree = self.tree
        types = [
            self.attributes.get(name, _NOTHING).get("TYPE") or word
            for name, word in zip(tree.names, tree.words, strict=True)
        ]
        object.__setattr__(self, "_types", types if self.attributes else tree.words)

    def told(self, node: int) -> dict[str, str]:
        """The attributes of a node."""
        return self.attributes.get(self.tree.names[node], _NOTHING)

    def type_of(self, node: int) -> str:
        """The type of a node, empty where nothing tells it."""
        return self._types[node]

    def used(self) -> list[int]:
        """All nodes with a mesh in or below them, ascending."""
        found = np.zeros(len(self.tree.names), bool)
        found[self.node[self.node >= 0]] = True
        # Parents come before what is below them.
        for node in np.flatnonzero(self.tree.parent >= 0)[::-1].tolist():
            if found[node]:
                found[self.tree.parent[node]] = True
        return np.flatnonzero(found).tolist()


def find_facts(owner: Owner) -> Iterator[Fact]:
    """Facts of every node with a mesh in or below it, and of the tubes of branches, in the order of the file."""
    tree = owner.tree
    meshes: dict[int, list[int]] = {}
    for mesh, node in enumerate(owner.node.tolist()):
        meshes.setdefault(node, []).append(mesh)
    system: dict[int, tuple[str, str]] = {}
    parent = tree.parent.tolist()
    for node in owner.used():
        above = parent[node]
        kind = owner.type_of(node)
        if above in system:
            system[node] = system[above]
        if kind in _SYSTEMS:
            system[node] = tree.names[node], kind
        own = meshes.get(node, ())
        yield from _facts_of(owner, node, kind)
        for mesh in own:
            path = owner.paths[mesh]
            if kind in _BRANCHES and not owner.whole[mesh]:
                yield Fact(path, "class", _TUBE, "primitive of a branch")
            if node in system and kind not in _SYSTEMS:
                name, by = system[node]
                yield Fact(path, "system", name.removeprefix("/"), f"{by} above")


def _facts_of(owner: Owner, node: int, kind: str) -> Iterator[Fact]:
    tree, told = owner.tree, owner.told(node)
    path, name = tree.paths[node], tree.names[node]
    if "TYPE" in told:
        yield Fact(path, "class", told["TYPE"], "att TYPE")
    elif kind:
        yield Fact(path, "class", kind, "default name below it" if tree.told_below[node] else "default name")
    named = name.startswith("/")
    if named and kind in _TAGGED:
        yield Fact(path, "tag", name[1:], "name")
    if named and path.rpartition("/")[2] != name[1:]:
        yield Fact(path, "name", name, "name")
    for key, attributes in _ATTRIBUTES if told else ():
        for attribute in attributes:
            value = told.get(attribute, "")
            if value and not (key == "size" and value in _NO_SIZE):
                yield Fact(path, key, value, f"att {attribute}")
                break


def find_links(owner: Owner) -> tuple[StatedLink, ...]:
    """The order along branches from head to tail, and what their ends and their tees refer to."""
    used = set(owner.used())
    members = _members(owner, used)
    names = {name: node for node, name in reversed(list(enumerate(owner.tree.names))) if node in used}
    for node in sorted(used, reverse=True):
        told = owner.told(node)
        for key in ("NAME", "REF", "REFNO"):
            if key in told:
                names.setdefault(told[key], node)
    links: list[StatedLink] = []
    for node in sorted(used):
        if node in members:
            links += _order(members[node])
            links += _ends(owner, node, members[node], names)
        elif "CREF" in owner.told(node):
            links += _junction(owner, node, members, names)
    return tuple(dict.fromkeys(links))


def _members(owner: Owner, used: Iterable[int]) -> dict[int, list[str]]:
    """Of each branch the paths of what is along it, from head to tail.

    Primitives of the branch itself that follow each other, with nothing between, are one straight piece of several
    plates (a cable tray); the first one stands for it.
    """
    tree = owner.tree
    branches = {node for node in used if owner.type_of(node) in _BRANCHES}
    along: dict[int, list[tuple[int, str, bool]]] = {node: [] for node in branches}
    parent, chunk = tree.parent.tolist(), tree.chunk.tolist()
    for node, above in enumerate(parent):
        if above in branches:
            along[above].append((chunk[node], "", False))
    for node in used:
        if parent[node] in branches and owner.type_of(node) not in _NO_MEMBER:
            along[parent[node]].append((chunk[node], tree.paths[node], False))
    merged = set()
    for node, at, path, whole in zip(owner.node.tolist(), owner.chunk.tolist(), owner.paths, owner.whole, strict=True):
        if node in branches:
            along[node].append((at, path, True))
            if whole:
                merged.add(node)
    # Where all tubes of a branch are one mesh, nothing comes after anything.
    members = {node: _leading(sorted(rows)) for node, rows in along.items() if node not in merged}
    return {node: paths for node, paths in members.items() if paths}


def _leading(rows: list[tuple[int, str, bool]]) -> list[str]:
    """The paths of those that are no primitives directly behind another one; without a path: only in between."""
    paths, behind = [], False
    for _, path, primitive in rows:
        if path and not (primitive and behind):
            paths.append(path)
        behind = primitive
    return paths


def _order(paths: list[str]) -> Iterator[StatedLink]:
    for first, second in zip(paths[:-1], paths[1:], strict=True):
        yield StatedLink(first, second, "forward", "order in branch")


def _ends(owner: Owner, node: int, paths: list[str], names: dict[str, int]) -> Iterator[StatedLink]:
    told = owner.told(node)
    ends: tuple[tuple[str, str, Literal["forward", "backward"]], ...] = (
        ("HREF", paths[0], "backward"),
        ("TREF", paths[-1], "forward"),
    )
    for key, path, flow in ends:
        other = names.get(told.get(key, ""), -1)
        if other >= 0 and other != node:
            yield StatedLink(path, owner.tree.paths[other], flow, f"att {key}")


def _junction(owner: Owner, node: int, members: dict[int, list[str]], names: dict[str, int]) -> Iterator[StatedLink]:
    """From a tee, an outlet or a nozzle to the end of the branch that it names."""
    branch = names.get(owner.told(node)["CREF"], -1)
    if branch not in members or branch == owner.tree.parent[node]:
        return
    told, paths, here = owner.told(branch), members[branch], owner.tree.paths[node]
    if names.get(told.get("TREF", ""), -1) == node:
        yield StatedLink(here, paths[-1], "backward", "att CREF")
    elif names.get(told.get("HREF", ""), -1) == node:
        yield StatedLink(here, paths[0], "forward", "att CREF")
    else:
        yield StatedLink(here, paths[0], "unknown", "att CREF")
