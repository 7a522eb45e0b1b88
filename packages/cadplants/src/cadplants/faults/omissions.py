"""What somebody leaves out of a plant: whole classes of parts."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection
from dataclasses import replace

from cadgraph.geometry.components import connected_sets
from cadplants.model.plant import Plant
from cadplants.parts.flange import GASKET

__all__ = ["OMISSIONS", "omitted"]

_HELD, _FRAME = "Connection assembly", "Structural element"


def _of(group: str, *names: str) -> frozenset[tuple[str, str]]:
    return frozenset((group, name) for name in names)


OMISSIONS: dict[str, frozenset[tuple[str, str]]] = {
    "fasteners": _of(_HELD, "bolt", "nut", "washer", "stud", "screw"),
    "nuts and washers": _of(_HELD, "nut", "washer"),
    "gaskets": _of("Pipe assembly", "gasket"),
    "supports": _of(_HELD, "bracket", "clamp", "u-bolt", "pipe hanger"),
    "structure": _of(
        _FRAME, "beam", "column", "brace", "plate", "base plate", "post", "foundation", "skid frame", "wall"
    )
    | _of(_HELD, "gusset plate"),
    "access": _of(_FRAME, "railing", "ladder", "stair tread", "grating", "platform", "fence", "gate"),
    "base plates": _of(_FRAME, "base plate", "plate", "foundation"),
    "electrical": frozenset({("Electrical and safety", "")}),
    "gauge glasses": _of("Gauge assembly", "gauge glass"),
    "gauge needles": _of("Gauge assembly", "gauge needle"),
    "gauge faces": _of("Gauge assembly", "gauge face", "gauge needle", "gauge glass"),
    "glands": _of("Valve assembly", "gland", "valve disc", "valve ball", "position indicator"),
    "handwheels": _of("Valve assembly", "handwheel", "lever"),
    "motor parts": _of("Pump unit", "motor fan cover", "terminal box", "coupling guard", "shaft"),
    "tank supports": _of("Tank", "saddle", "skirt", "tank leg", "lifting lug"),
}
"""Classes of parts that may be missing from a plant, each as groups and names of the vocabulary; "" is every name."""


def omitted(plant: Plant, classes: Collection[str]) -> Plant:
    """The plant without some classes of parts; its units and its network stay.

    A piece of a device stays where the rest of it would fall apart, and so does all that is left of a unit. Where a
    gasket is left out, the faces that it kept apart count as touching.

    Args:
        plant: as it was.
        classes: keys of ``OMISSIONS``.

    Raises:
        ValueError: an unknown class.
    """
    unknown = sorted(set(classes) - set(OMISSIONS))
    if unknown:
        raise ValueError(f"nothing is called {unknown[0]!r} that can be left out; there are {', '.join(OMISSIONS)}")
    wanted = frozenset[tuple[str, str]]().union(*(OMISSIONS[name] for name in classes))
    chosen = {
        i for i, one in enumerate(plant.components) if (one.group, one.name) in wanted or (one.group, "") in wanted
    }
    gone = chosen - _needed(plant, chosen)
    pads = {i for i in gone if plant.components[i].name == "gasket"}
    without = plant.without(gone - pads, bridged=False)
    left = [i for i, one in enumerate(without.components) if one.name == "gasket"] if pads else []
    return replace(without.without(left), looseness=without.looseness + GASKET) if left else without


def _pieces_of_units(plant: Plant) -> tuple[dict[str, list[int]], dict[str, list[tuple[int, int]]]]:
    """The components of each unit, and which of them touch."""
    own: dict[str, list[int]] = defaultdict(list)
    within: dict[str, list[tuple[int, int]]] = defaultdict(list)
    for i, component in enumerate(plant.components):
        if component.unit:
            own[component.unit].append(i)
    for a, b in plant.contacts:
        unit = plant.components[a].unit
        if unit and unit == plant.components[b].unit:
            within[unit].append((a, b))
    return own, within


def _needed(plant: Plant, chosen: set[int]) -> set[int]:
    """Which chosen pieces of units have to stay: without them the rest would fall apart, or nothing would be left."""
    own, within = _pieces_of_units(plant)
    needed: set[int] = set()
    for unit, pieces in own.items():
        rest = list(pieces)
        for piece in [i for i in pieces if i in chosen]:
            fewer = [i for i in rest if i != piece]
            before, after = (len(connected_sets(some, within[unit])) for some in (rest, fewer))
            if fewer and after <= before:
                rest = fewer
            else:
                needed.add(piece)
    return needed
