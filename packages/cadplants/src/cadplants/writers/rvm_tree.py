"""The element tree that a plant-design system (PDMS, E3D) keeps: sites, zones, pipes, branches, equipment."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.model.plant import Plant
from cadplants.writers.inventory import Inventory, Item
from cadplants.writers.metadata import Claim, Claims
from cadplants.writers.pdms_types import BRANCH_TYPES, pdms_type

__all__ = ["Element", "grow"]

_SPEC = "/A150"


@dataclass
class Element:
    """A node of the tree.

    Args:
        name: with a leading slash where a person gave it, else ``"ELBOW 2 of BRANCH /L1/B1"``; unique.
        word: its type as in default names.
        attributes: in order, as they stand in the attribute file; without ``Type`` where nobody told.
        owner: the element above; None: the world.
        component: index of the mesh that it carries, if it does.
        below: its elements, and the bare indices of tubes that hang on it without an element of their own, in order.
        position: ``(3,)`` [m].
    """

    name: str
    word: str
    attributes: dict[str, str] = field(default_factory=dict)
    owner: Element | None = None
    component: int | None = None
    below: list[Element | int] = field(default_factory=list)
    position: Floats = field(default_factory=lambda: np.zeros(3))

    @property
    def elements(self) -> Iterator[Element]:
        """The elements below."""
        return (one for one in self.below if isinstance(one, Element))


def grow(plant: Plant, inventory: Inventory, claims: Claims, tubes: frozenset[int]) -> Element:
    """The tree of a plant, with every mesh in a leaf of its own.

    Args:
        plant: whose components it holds.
        inventory: of that plant.
        claims: what is said of its elements.
        tubes: components that may hang on a branch without an element, as they are one body each.

    Returns:
        The site.
    """
    return _Grower(plant, inventory, claims, tubes).site


class _Grower:
    def __init__(self, plant: Plant, inventory: Inventory, claims: Claims, tubes: frozenset[int]) -> None:
        self._plant, self._inventory, self._claims, self._tubes = plant, inventory, claims, tubes
        self._counts: Counter[tuple[str, str]] = Counter()
        self._names = {item.number: self._name(item) for item in inventory.items}
        self._branches = {tag: f"/{100 * (k + 1)}-{tag}" for k, tag in enumerate(inventory.lines)}
        self.site = Element(f"/{(plant.name or 'plant').upper()}", "SITE", {"Type": "SITE"})
        piping = self._under(self.site, "ZONE", "ZONE", f"{self.site.name}-PIPING")
        machines = self._under(self.site, "ZONE", "ZONE", f"{self.site.name}-EQUIPMENT")
        steel = self._under(self.site, "ZONE", "ZONE", f"{self.site.name}-STRUCTURE")
        for tag, items in inventory.lines.items():
            self._pipe(piping, tag, items)
        rest = [item for item in inventory.items if not item.line]
        for item in rest:
            if item.unit is not None:
                self._equipment(machines, item)
        self._steel(steel, [item for item in rest if item.unit is None])

    def _name(self, item: Item) -> str:
        """The name that a person gave to an item, or ""."""
        told = self._claims.items[item.number] is not None
        return f"/{item.unit.id}" if item.unit is not None and told else ""

    def _under(self, owner: Element, kind: str, word: str, name: str = "") -> Element:
        """A new element, called by its place among those of its kind where it has no name."""
        if not name:
            self._counts[owner.name, word] += 1
            of = owner.name if owner.name.startswith("/") else f"{owner.name}"
            above = "" if " of " in of else f"{owner.word} "
            name = f"{word} {self._counts[owner.name, word]} of {above}{of}"
        element = Element(name, word, {"Type": kind} if kind else {}, owner)
        owner.below.append(element)
        return element

    def _anonymous(self, owner: Element) -> Element:
        """An element that is only numbered, so that neither name nor type tells what it is."""
        self._counts["", ""] += 1
        return self._under(owner, "", "ELEMENT", f"/X{self._counts['', '']:05d}")

    def _pipe(self, zone: Element, tag: str, items: Sequence[Item]) -> None:
        bore = f"{self._inventory.bores.get(tag, 0.0) * 1000:.0f}"
        pipe = self._under(zone, "PIPE", "PIPE", self._branches[tag])
        pipe.attributes |= {"Bore": bore, "Pspec": _SPEC, "Desc": f"LINE {tag}"}
        branch = self._under(pipe, "BRAN", "BRANCH", f"{pipe.name}/B1")
        course = next((line.points for line in self._plant.lines if line.id == tag), None)
        if course is not None:
            branch.attributes |= {"Hposition": _position(course[0]), "Tposition": _position(course[-1])}
            branch.position = course[0]
        head, tail = self._inventory.ends.get(tag, (None, None))
        branch.attributes |= {
            "Href": self._reference(head),
            "Tref": self._reference(tail),
            "Hbore": bore,
            "Tbore": bore,
        }
        # A tube without element shows as one only where its branch has elements besides.
        bare = any(not self._is_tube(item) for item in items)
        for item in items:
            if bare and self._is_tube(item):
                branch.below.append(item.members[0])
            else:
                self._item(branch, item, bore)

    def _is_tube(self, item: Item) -> bool:
        said = self._claims.items[item.number]
        return (
            len(item.members) == 1
            and item.members[0] in self._tubes
            and said is not None
            and pdms_type(said.group, said.name)[0] == "TUBI"
        )

    def _reference(self, number: int | None) -> str:
        if number is None:
            return "Nulref"
        item = self._inventory.items[number]
        if item.line and item.line != "" and not self._names[number]:
            return f"{self._branches[item.line]}/B1"
        return self._names[number] or "Nulref"

    def _item(self, owner: Element, item: Item, bore: str = "") -> None:
        said = self._claims.items[item.number]
        element = self._told(owner, said, self._names[item.number], bore, on_branch=bool(item.line))
        if len(item.members) == 1:
            self._carry(element, item.members[0])
            return
        for index in item.members:
            part = self._told(element, self._claims.components[index], "", "", on_branch=bool(item.line))
            self._carry(part, index)

    def _told(self, owner: Element, said: Claim | None, name: str, bore: str, on_branch: bool) -> Element:
        """An element with what is said of it."""
        if said is None:
            return self._anonymous(owner)
        kind, word = pdms_type(said.group, said.name)
        if on_branch and kind not in BRANCH_TYPES and said.true:
            kind, word = "PCOM", "PCOMPONENT"
        element = self._under(owner, kind, word, name)
        words = said.words.upper()
        element.attributes["Desc"] = f"{words} DN{bore}" if bore else words
        if bore:
            element.attributes |= {"Spref": f"{_SPEC}/{words.replace(' ', '-')}-{bore}", "Bore": bore}
        return element

    def _carry(self, element: Element, index: int) -> None:
        element.component = index
        vertices = self._plant.components[index].vertices
        element.position = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
        element.attributes["Position"] = _position(element.position)

    def _equipment(self, zone: Element, item: Item) -> None:
        self._item(zone, item)

    def _steel(self, zone: Element, items: Sequence[Item]) -> None:
        frames: dict[str, Element] = {}
        for item in items:
            cluster = self._plant.components[item.members[0]].cluster or "GROUND"
            if cluster not in frames:
                structure = self._under(zone, "STRU", "STRUCTURE", f"/STRU-{cluster}")
                frames[cluster] = self._under(structure, "FRMW", "FRMWORK")
            self._item(frames[cluster], item)


def _position(point: Floats) -> str:
    """A place as PDMS writes it: ``E 100 N 200.5 D 30`` in millimetres."""
    words = []
    for value, (positive, negative) in zip(point * 1000, (("E", "W"), ("N", "S"), ("U", "D")), strict=True):
        number = f"{abs(float(value)):.3f}".rstrip("0").rstrip(".")
        words.append(f"{negative if value < 0 and number != '0' else positive} {number}")
    return " ".join(words)
