"""Families of devices: parts that a builder makes, and the components that a style makes of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from cadgraph.model.scene import Floats
from cadplants.model.plant import Assembly, Component, Device, Turning, Unit, turned_front
from cadplants.model.standards import SIZES
from cadplants.solids.mesh_ops import Solid, merge, moved
from cadplants.solids.transforms import IDENTITY
from cadplants.styles.modeling_style import Grain, ModelingStyle

__all__ = ["UNIT", "Build", "Family", "Model", "Part", "Port", "as_assembly", "as_device", "placed"]

_EXACT = 1e-9  # m; rounding
_UNITS = {
    "Valve assembly": "valve",
    "Gauge assembly": "gauge",
    "Pump unit": "pump",
    "Tank": "tank",
    "Equipment": "equipment",
}


@dataclass(frozen=True, eq=False)
class Part:
    """One piece of a device.

    Args:
        solid: in the device's coordinates [m].
        name: of the vocabulary.
        color: kind of material.
        bundle: name under which a style that models in a few meshes joins it with others of its group; "" leaves it on
            its own. One that models a device as one mesh takes in every part with a bundle.
        group: of the vocabulary; "" is the device's.
        fine: whether a style without fasteners leaves it out.
        front: ``(3,)`` unit vector out of what is read on it, in the device's coordinates; None where nothing is.
        turns: what of it turns, in the device's coordinates; None where nothing does, or where that is not said.
    """

    solid: Solid
    name: str
    color: str
    bundle: str = ""
    group: str = ""
    fine: bool = False
    front: tuple[float, float, float] | None = None
    turns: Turning | None = None


@dataclass(frozen=True, eq=False)
class Port:
    """Where a line can be joined to a device.

    Args:
        frame: ``(4, 4)`` of its face, x outward.
        dn: nominal size.
        part: index of the part with that face.
    """

    frame: Floats
    dn: int
    part: int = 0


@dataclass(frozen=True, eq=False)
class Model:
    """What a builder made: a device that sits in a line, on an outlet or on the floor.

    Args:
        parts: in the device's coordinates: in a line along x from 0, else on z = 0 about the origin.
        length: of a device in a line, face to face [m].
        joint: how it sits in a line: ``flanged``, ``wafer`` or ``welded`` (also screwed: the pipe reaches its ends).
        kind: of the functional unit, ``"relief valve"``.
        ports: faces that lines can be joined to.
        dn: nominal size behind a reducer; 0 as before.
        split: whether the outlet's face of a device in a line may be on another part than the inlet's.
        params: what it was built from, as plain JSON values; None where that is not recorded.
    """

    parts: Sequence[Part]
    length: float = 0.0
    joint: str = "flanged"
    kind: str = ""
    ports: tuple[Port, ...] = ()
    dn: int = 0
    split: bool = False
    params: Mapping[str, Any] | None = None


# Nominal size, style, generator (and what a carrier is asked for besides); a builder may also return finished
# components whose unit is called ``UNIT``.
Build = Callable[..., "Model | Device | Assembly"]
UNIT = "unit"


@dataclass(frozen=True)
class Family:
    """A kind of device or structure in one build.

    Args:
        name: ``"relief valve/spring bonnet"``; plants can leave whole families out by it.
        place: ``inline``, ``tap``, ``floor``, ``end`` (of a line) or ``carrier`` (holds a line).
        group: of the vocabulary.
        whole: the label of a device in one mesh.
        build: makes one of a nominal size for a style.
        sizes: nominal sizes that it is made in.
        grain: what the style is asked for its granularity.
        weight: how often it is drawn, against others.
        welded: whether a finished device is welded or screwed into its line (a ``Model`` says so itself).
    """

    name: str
    place: str
    group: str
    whole: str
    build: Build
    sizes: tuple[int, ...] = field(default=SIZES)
    grain: str = ""
    weight: float = 1.0
    welded: bool = False

    @property
    def unit(self) -> str:
        """Type of the functional unit, or ""."""
        return _UNITS.get(self.group, "")


def placed(parts: Sequence[Part], pose: Floats) -> list[Part]:
    """The parts moved together by a ``(4, 4)`` pose."""
    return [
        replace(
            part,
            solid=moved(part.solid, pose),
            front=turned_front(part.front, pose),
            turns=part.turns.placed(pose) if part.turns is not None else None,
        )
        for part in parts
    ]


def _grain_of(family: Family, style: ModelingStyle) -> Grain:
    return style.grain(family.grain or family.unit or "structure")


def as_assembly(family: Family, model: Model | Device | Assembly, style: ModelingStyle, unit: str = "") -> Assembly:
    """The components that a style makes of a device.

    Args:
        family: of the device.
        model: its parts, or what was built already.
        style: decides on the granularity.
        unit: id of the functional unit, where the family makes one.
    """
    grain = _grain_of(family, style)
    if isinstance(model, Device):
        model = model.assembly
    if isinstance(model, Assembly):
        return _stamped(_called(model, unit), family.name, grain, style)
    parts = [p for p in model.parts if not p.fine or style.fasteners != "none"]
    if grain == "one":
        parts = _in_one(family, parts)
    elif grain == "few":
        parts = _in_few(parts)
    components = tuple(_component(part, family, style, unit, grain) for part in parts)
    if model.params is not None:
        components = tuple(replace(one, params=model.params, made_in=style) for one in components)
    units = (Unit(unit, family.unit, model.kind or family.whole),) if unit and family.unit else ()
    return Assembly(components, tuple((0, k) for k in range(1, len(components))), units)


def _component(part: Part, family: Family, style: ModelingStyle, unit: str, grain: str) -> Component:
    group = part.group or family.group
    owner = unit if family.unit and group == family.group else ""
    color = style.color(part.color)
    return Component(
        part.solid,
        group,
        part.name,
        color,
        IDENTITY,
        owner,
        family=family.name,
        granularity=grain,
        front=part.front,
        turns=part.turns,
    )


def _called(assembly: Assembly, unit: str) -> Assembly:
    """Finished components with their unit's id in place of ``UNIT``."""
    return replace(
        assembly,
        components=tuple(replace(c, unit=unit) if c.unit == UNIT else c for c in assembly.components),
        units=tuple(replace(u, id=unit) if u.id == UNIT else u for u in assembly.units),
    )


def _in_one(family: Family, parts: list[Part]) -> list[Part]:
    own = [p for p in parts if p.bundle or p.group in ("", family.group)]
    rest = [p for p in parts if not p.bundle and p.group not in ("", family.group)]
    whole = merge([p.solid for p in own])
    return [Part(whole, family.whole, own[0].color, front=_front_of(own), turns=_turning_of(own)), *rest]


def _in_few(parts: list[Part]) -> list[Part]:
    bundles: dict[tuple[str, str], list[Part]] = {}
    for k, part in enumerate(parts):
        bundles.setdefault((part.group, part.bundle or f"#{k}"), []).append(part)
    return [
        replace(
            some[0],
            solid=merge([p.solid for p in some]),
            name=some[0].name if some[0].group or not some[0].bundle else some[0].bundle,
            front=_front_of(some),
            turns=_turning_of(some),
        )
        for some in bundles.values()
    ]


def _front_of(parts: Sequence[Part]) -> tuple[float, float, float] | None:
    return next((part.front for part in parts if part.front is not None), None)


def _turning_of(parts: Sequence[Part]) -> Turning | None:
    return next((part.turns for part in parts if part.turns is not None), None)


def as_device(family: Family, model: Model | Device | Assembly, style: ModelingStyle, unit: str = "") -> Device:
    """The device for a line; the first component of a model has both faces, or its inlet's where it is split."""
    assembly = as_assembly(family, model, style, unit)
    if isinstance(model, Device):
        return replace(model, assembly=assembly)
    if isinstance(model, Assembly):
        raise ValueError(f"{family.name} is no device for a line")
    outlet = _at_end(assembly, model.length) if model.split else 0
    return Device(assembly, model.length, 0, outlet, model.joint == "wafer")


def _at_end(assembly: Assembly, length: float) -> int:
    """Index of the first component that reaches the end of a device; the first where none does."""
    ends = [float(component.solid.vertices[:, 0].max()) for component in assembly.components]
    return next((k for k, end in enumerate(ends) if abs(end - length) < _EXACT), 0)


def _stamped(assembly: Assembly, family: str, grain: str, style: ModelingStyle) -> Assembly:
    return replace(
        assembly,
        components=tuple(
            replace(
                c,
                family=family,
                granularity=c.granularity or grain,
                made_in=style if c.params is not None else None,
            )
            for c in assembly.components
        ),
    )
