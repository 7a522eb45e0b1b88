"""Finding a node by what people call it: a tag, an id, or the source path of a mesh."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property

from cadgraph.errors import UnknownNode
from cadgraph.model.records import Junction, Node, Part, Place, Terminal, Unit

__all__ = ["Names", "loose_tag"]

_NEAR = 3  # names offered where one is not found
_ALIKE = 0.6  # least likeness of these, as difflib has it by default
_MOST_TOLD = 8  # tags that an error names
_FUNCTIONAL = (Unit, Junction, Terminal)
_LINE = re.compile(r"L-?\d{4}", re.IGNORECASE)  # the number of a line in the line list, which is no node


class Names:
    """What the nodes of a graph are called.

    Args:
        nodes: by id, in the order of the file.
    """

    def __init__(self, nodes: Mapping[str, Node]) -> None:
        self._nodes = nodes
        self._by_tag: dict[str, Node] = {node.tag: node for node in nodes.values() if isinstance(node, Unit)}
        self._by_name: dict[str, Node] = {node.name: node for node in nodes.values() if isinstance(node, Place)}
        self._part_of_mesh = {mesh: node for node in nodes.values() if isinstance(node, Part) for mesh in node.meshes}

    def part_with(self, mesh: str) -> Part | None:
        """The part that holds the mesh of exactly this source path, if any."""
        return self._part_of_mesh.get(mesh)

    def find(self, which: str, layers: tuple[type[Node], ...]) -> Node:
        """The node of one of these layers that is called so.

        An id, a tag, the source path of a mesh or the name of a level in full goes first. Else a tag or id may be spelt
        loosely (``v4`` for ``V-004``) where only one is meant. A part stands for what it is a part of, where that is of
        these layers.

        Args:
            which: what it is called.
            layers: classes of nodes.

        Raises:
            UnknownNode: there is none; the message names the nearest ones.
        """
        exact = (names.get(which) for names in (self._nodes, self._by_tag, self._part_of_mesh, self._by_name))
        called = [node for node in exact if node is not None]
        for node in self._meant(which, called, layers):
            if isinstance(node, layers):
                return node
        hint = self._hint(which, layers)
        if called:
            wanted = " or ".join(layer.__name__.lower() for layer in layers)
            raise UnknownNode(f"{which!r} is a {called[0].layer}, not a {wanted}; {hint}")
        raise UnknownNode(f"{'no part' if layers == (Part,) else 'nothing in the graph'} is called {which!r}; {hint}")

    def _meant(self, which: str, called: list[Node], layers: tuple[type[Node], ...]) -> Iterator[Node]:
        """What may be meant, the surest first, looked for only as far as it is asked for."""
        yield from called
        yield from self._owners(called)
        yield from self._loosely(which, layers)

    def _owners(self, parts: Iterable[Node]) -> Iterable[Node]:
        """What parts are a part of."""
        ids = {node.id for node in parts if isinstance(node, Part)}
        return (n for n in self._nodes.values() if isinstance(n, _FUNCTIONAL) and not ids.isdisjoint(n.parts))

    def _loosely(self, which: str, layers: tuple[type[Node], ...]) -> list[Node]:
        """The one node whose tag or id differs from this only in capitals, separators and leading zeros."""
        loose = loose_tag(which)
        found = {node.id: node for node in self._by_loose_name.get(loose, ()) if isinstance(node, layers)}
        return list(found.values()) if loose and len(found) == 1 else []

    @cached_property
    def _by_loose_name(self) -> Mapping[str, list[Node]]:
        named: dict[str, list[Node]] = {}
        for name, node in (*self._nodes.items(), *self._by_tag.items(), *self._by_name.items()):
            named.setdefault(loose_tag(name), []).append(node)
        return named

    def _hint(self, which: str, layers: tuple[type[Node], ...]) -> str:
        """What may have been meant, else what there is."""
        if _LINE.fullmatch(which.strip()) and layers != (Part,):
            return "lines are numbered so: 'cadgraph lines' says what each joins and runs through; name one of these"
        names = {loose_tag(name): name for name in self._suggested(layers)}
        near = [names[key] for key in difflib.get_close_matches(loose_tag(which), names, _NEAR, _ALIKE)]
        if near:
            return f"did you mean {', '.join(near)}?"
        if layers == (Part,):
            return "'cadgraph export --to csv' lists all parts"
        tags = list(self._by_tag)
        rest = len(tags) - _MOST_TOLD
        more = f" and {rest} more; 'cadgraph lines' prints all that are connected" if rest > 0 else ""
        return f"its units are {', '.join(tags[:_MOST_TOLD])}{more}" if tags else "it has no units"

    def _suggested(self, layers: tuple[type[Node], ...]) -> Iterable[str]:
        for node in self._nodes.values():
            if isinstance(node, layers) and not isinstance(node, Part):
                yield node.tag if isinstance(node, Unit) else node.id
        if Part in layers:
            yield from self._part_of_mesh


def loose_tag(name: str) -> str:
    """A tag as people type it: small letters, no separators, no leading zeros."""
    return re.sub(r"(?<![0-9])0+(?=[0-9])", "", re.sub(r"[\W_]+", "", name.casefold()))
