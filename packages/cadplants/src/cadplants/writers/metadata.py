"""What an author says of each element, right, wrong or not at all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cadplants.model.plant import Plant
from cadplants.writers.inventory import Inventory, Item

__all__ = ["Claim", "Claims", "Metadata", "claim"]

_WHOLE = {
    "valve": ("Valve assembly", "valve"),
    "gauge": ("Gauge assembly", "gauge"),
    "pump": ("Pump unit", "pump"),
    "tank": ("Tank", "tank"),
}
_SPECIAL = (
    "sight glass",
    "level gauge",
    "flow meter",
    "transmitter",
    "thermowell",
)  # gauges that have a name of their own


@dataclass(frozen=True)
class Metadata:
    """How good the metadata of a file are.

    Args:
        wrong_classes: share of elements whose class is that of something else.
        missing_names: share of elements without class, name and description.
    """

    wrong_classes: float = 0.0
    missing_names: float = 0.0

    def __post_init__(self) -> None:
        for name in ("wrong_classes", "missing_names"):
            # Written so that NaN fails it too.
            if not 0.0 <= getattr(self, name) <= 1.0:
                raise ValueError(f"{name} {getattr(self, name)}: give a share from 0 to 1")


@dataclass(frozen=True)
class Claim:
    """What is said of an element.

    Args:
        group: of the vocabulary, that its class stands for.
        name: in that group, likewise.
        words: what its name and description say, which is right even where its class is not.
        true: whether the class is right.
    """

    group: str
    name: str
    words: str
    true: bool = True


@dataclass(frozen=True)
class Claims:
    """What is said of everything; None: nothing.

    Args:
        items: by number; what a unit as a whole is said to be.
        components: by index; that of its item where it is the only one.
    """

    items: tuple[Claim | None, ...]
    components: tuple[Claim | None, ...]

    def spoilt(self, paths: Sequence[str]) -> dict[str, object]:
        """The paths of components whose class is wrong and whose name is missing, where there are any."""
        told = list(zip(paths, self.components, strict=True))
        wrong = [path for path, said in told if said is not None and not said.true]
        missing = [path for path, said in told if said is None]
        return {key: some for key, some in (("wrong_classes", wrong), ("missing_names", missing)) if some}


def claim(plant: Plant, inventory: Inventory, metadata: Metadata) -> Claims:
    """Decides on what is said of each element.

    Args:
        plant: whose seed decides on which elements are spoilt.
        inventory: of that plant.
        metadata: how many are.
    """
    rng = np.random.default_rng([plant.seed, 13])
    right = [_of_item(item) for item in inventory.items]
    parts = [Claim(c.group, c.name, c.name) for c in plant.components]
    every = sorted({(one.group, one.name) for one in right if one.group})
    items: list[Claim | None] = [_spoilt(one, every, metadata, rng) for one in right]
    components: list[Claim | None] = [_spoilt(one, every, metadata, rng) for one in parts]
    for item in inventory.items:
        if len(item.members) == 1:
            components[item.members[0]] = items[item.number]
    return Claims(tuple(items), tuple(components))


def _of_item(item: Item) -> Claim:
    if item.unit is None:
        return Claim(item.group, item.name, item.name)
    kind = item.unit.kind
    if item.unit.type == "equipment":
        return Claim("Equipment", kind, kind)
    group, name = _WHOLE[item.unit.type]
    return Claim(group, kind if kind in _SPECIAL else name, kind)


def _spoilt(right: Claim, every: list[tuple[str, str]], metadata: Metadata, rng: np.random.Generator) -> Claim | None:
    # All numbers are drawn whatever the shares, so that a larger share spoils the same elements and some more.
    missing, wrong, which = (float(x) for x in rng.random(3))
    others = [one for one in every if one[0] != right.group]
    if missing < metadata.missing_names:
        return None
    if wrong < metadata.wrong_classes and others:
        return Claim(*others[int(which * len(others))], words=right.words, true=False)
    return right
