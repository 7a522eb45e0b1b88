"""Families as classes: what is drawn of a device, and how it is built from that alone."""

from __future__ import annotations

from dataclasses import Field, dataclass, replace
from typing import Any, ClassVar

import numpy as np

from cadplants.builder.params import Apart, OneStream, Params, Source, given
from cadplants.builder.table import Table
from cadplants.model.family import Family, Model, as_assembly, as_device
from cadplants.model.plant import Assembly
from cadplants.model.plant import Device as InLine
from cadplants.model.standards import SIZES
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["Device", "Maker", "families_of"]

# What a class says once for all that are built of it.
_SAID = ("name", "place", "group", "label", "bundle", "sizes", "weight", "grain", "welded")


class Device(Params):
    """A family of devices or structures.

    A subclass has the parameters as fields and ``build``. What the plant asks of the family stands in the class's head:

        class Siphon(Instrument, name="siphon/coil", sizes=(15, 20), weight=0.5):

    name: kind and construction, ``"ball valve/trunnion"``; "" for what only others derive from.
    place: ``inline``, ``tap``, ``floor``, ``end`` (of a line), ``head`` or ``carrier`` (holds a line).
    group: of the vocabulary.
    label: of the device in one mesh.
    bundle: name of the part that takes in the others where a style models in a few meshes.
    sizes: nominal sizes [mm] that it is made in.
    weight: how often it is drawn, against others.
    grain: what the style is asked for its granularity; its unit's if "".
    welded: whether a finished device is welded or screwed into its line.
    """

    name: ClassVar[str] = ""
    place: ClassVar[str] = "floor"
    group: ClassVar[str] = ""
    label: ClassVar[str] = ""
    bundle: ClassVar[str] = ""
    sizes: ClassVar[tuple[int, ...]] = SIZES
    weight: ClassVar[float] = 1.0
    grain: ClassVar[str] = ""
    welded: ClassVar[bool] = False

    dn: int = given(default=0, about="nominal size", unit="mm")

    def __init_subclass__(cls, **said: Any) -> None:
        taken = [key for key, value in vars(cls).items() if isinstance(value, Field) and hasattr(Device, key)]
        if set(taken) - {"dn"}:
            raise TypeError(f"{cls.__name__}.{taken[0]}: a device has that already; call the parameter something else")
        cls.name = said.pop("name", "")
        for key in _SAID[1:]:
            if key in said:
                setattr(cls, key, said.pop(key))
        super().__init_subclass__(**said)

    def rows(self, within: str = "", here: bool = False) -> list[tuple[str, str, str, str]]:
        """What people read of all parameters; the nominal size is one of those that the family is made in."""
        sizes = ", ".join(map(str, self.sizes))
        return [
            (name, value, sizes if name == f"{within}dn" else limits, about)
            for name, value, limits, about in super().rows(within, here)
        ]

    def build(self, t: Table) -> Model:
        """Puts the device down: along x from 0 in a line, else on z = 0 about the origin.

        Args:
            t: with nothing on it.
        """
        raise NotImplementedError(type(self).__name__)

    def model(self, style: ModelingStyle) -> Model:
        """The device as a style models it; the same parameters and style give the same bytes."""
        made = self.build(Table(style, self.group, self.bundle, self.dn))
        return replace(made, params=self.to_json())

    @classmethod
    def as_family(cls) -> Family:
        """The family as assortments take it."""
        return Family(
            cls.name, cls.place, cls.group, cls.label, Maker(cls), cls.sizes, cls.grain, cls.weight, cls.welded
        )

    def as_assembly(self, style: ModelingStyle, unit: str = "") -> Assembly:
        """The components that a style makes of it, with what they were built from; ``unit`` is its id as one."""
        return as_assembly(self.as_family(), self.model(style), style, unit)

    def as_device(self, style: ModelingStyle, unit: str = "") -> InLine:
        """Likewise, for a line.

        Raises:
            ValueError: it is no device for a line.
        """
        return as_device(self.as_family(), self.model(style), style, unit)


@dataclass(frozen=True)
class Maker:
    """Draws devices of a family and builds them: what a ``Family`` calls.

    Args:
        device: the family's class.
    """

    device: type[Device]

    def __call__(self, dn: int, style: ModelingStyle, source: Source | np.random.Generator, *height: float) -> Model:
        """One at random.

        Args:
            dn: nominal size [mm].
            style: that models it.
            source: of random numbers.
            height: of the line's axis over the floor, of carriers [m].
        """
        return self.draw(dn, style, source, *height).model(style)

    def draw(
        self, dn: int, style: ModelingStyle, source: Source | np.random.Generator | int, *height: float, **told: Any
    ) -> Device:
        """The parameters of one at random, but for those that are given.

        Args:
            dn: nominal size [mm].
            style: that will model it; what a style leaves out has no parameters.
            source: of random numbers, or a seed, of which each parameter gets a stream of its own.
            height: of carriers [m].
            told: parameters that are given, by name.
        """
        if isinstance(source, int):
            source = Apart(source)
        elif isinstance(source, np.random.Generator):
            source = OneStream(source)
        said = {name: getattr(style, name) for name, field in self.device.fields().items() if field.of_style}
        return self.device.draw(source, {**said, "dn": dn, **({"height": height[0]} if height else {})}, **told)


def families_of(*devices: type[Device]) -> tuple[Family, ...]:
    """Families as the assortment takes them, from their classes."""
    return tuple(one.as_family() for one in devices)
