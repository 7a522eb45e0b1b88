"""What an assortment is drawn from: which families, how often each, in which sizes, how much in other styles."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from cadgraph.model.scene import Floats
from cadgraph.model.vocabulary import default_vocabulary
from cadplants.builder.device import Device, families_of
from cadplants.families import FAMILIES
from cadplants.families.lookalikes.lookalike import LOOKALIKES
from cadplants.families.preset_devices import LAID_DEVICES
from cadplants.families.primitive.primitive import KITS, PRIMITIVES
from cadplants.model.family import Family

__all__ = ["ALL_FAMILIES", "FEW_KITS", "LAID", "OF_PRIMITIVES", "Taste", "register"]

LAID: dict[str, Family] = {family.name: family for family in LAID_DEVICES}
"""Families that presets lay and no assortment draws, by name."""

ALL_FAMILIES: dict[str, Family] = {**FAMILIES, **PRIMITIVES, **LOOKALIKES, **LAID}
"""The usual families, those of primitives, those of look-alikes and those that presets lay, by name."""

_PLACES = ("inline", "tap", "floor", "end", "head", "carrier")
_POOLS: tuple[dict[str, Family], ...] = (FAMILIES, PRIMITIVES, LOOKALIKES)


def register(*devices: type[Device]) -> tuple[Family, ...]:
    """Makes devices of one's own families as all others, in this process: assortments draw them, commands know them.

    Args:
        devices: classes with a name.

    Raises:
        ValueError: one has no name or that of another family, or its place or group is none.
    """
    made = families_of(*devices)
    for family in made:
        if "/" not in family.name or family.name in ALL_FAMILIES:
            raise ValueError(f"family {family.name!r}: give kind and construction, as no other has them")
        if family.place not in _PLACES:
            raise ValueError(f"{family.name}: place {family.place!r} is none of {', '.join(_PLACES)}")
        if family.group not in default_vocabulary().groups:
            raise ValueError(f"{family.name}: group {family.group!r} is not in the vocabulary")
        FAMILIES[family.name] = ALL_FAMILIES[family.name] = family
    return made


@dataclass(frozen=True)
class Taste:
    """What an assortment is drawn from.

    Args:
        pools: shares of the usual families, of those of primitives and of look-alikes, wherever each has any.
        factors: how much oftener than usual families are drawn, by name, by kind (what comes before the slash) or by
            group, the first that is given.
        sizes: least and greatest nominal size of lines.
        foreign: share of the devices that come from another style, as parts of catalogues do.
        mixed: share of the devices with a granularity of their own.
        meshes: least and greatest number of meshes without fasteners at which a plant is full.
    """

    pools: tuple[float, float, float] = (1.0, 0.0, 0.0)
    factors: Mapping[str, float] = field(default_factory=dict)
    sizes: tuple[int, int] = (15, 300)
    foreign: float = 0.0
    mixed: float = 0.0
    meshes: tuple[int, int] = (90, 280)

    def weights(self, families: list[Family]) -> Floats:
        """``(n,)`` how likely each of some families is, in all 1; none is where the shares of all their pools are 0."""
        weights = np.array([family.weight * self._factor(family) for family in families])
        result = np.zeros(len(families))
        for pool, share in zip(_POOLS, self.pools, strict=True):
            own = np.array([family.name in pool for family in families])
            total = weights[own].sum()
            if total > 0:
                result[own] = share * weights[own] / total
        return result / result.sum() if result.sum() > 0 else result

    def _factor(self, family: Family) -> float:
        keys = (family.name, family.name.split("/")[0], family.group)
        return next((self.factors[key] for key in keys if key in self.factors), 1.0)


FEW_KITS: Mapping[str, float] = {family.name: 0.2 for family in KITS}
"""How often pieces of asset packs are drawn where a plant is not made of them."""

OF_PRIMITIVES = Taste((0.15, 0.85, 0.0), FEW_KITS)
"""Of styles whose devices are of primitives."""
