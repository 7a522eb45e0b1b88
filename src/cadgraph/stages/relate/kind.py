"""Kinds of units: ball valve, check valve, pressure gauge..., from the parts and the way they lie in the line."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np

from cadgraph.model.parts import Network, Parts, UnitParts
from cadgraph.stages.relate.valve_kind import SURE_FROM, valve_kinds

__all__ = ["name_kinds"]

# A tank lies where it is longer than high and than deep by this factor.
_LYING = 1.15
_STEEP = 0.7  # a tank whose shell is longest along a steeper axis stands
_GAUGES = ("level gauge", "flow meter", "transmitter", "sight glass", "thermowell")
_GUESSES = 2  # that are told where a kind stays open ...
_LEAST = 0.05  # ... if they are as likely as this


def name_kinds(network: Network, names: Sequence[str | None], parts: Parts) -> Network:
    """Says of each unit what it is, as far as its parts and shape tell, and what it may be where they leave it open.

    Args:
        network: with openings and sizes.
        names: of each part.
        parts: of the scene.
    """
    sizes: dict[int, list[int]] = {}
    for link in network.links:
        for node in (link.source, link.target):
            if node < len(network.units) and link.size is not None:
                sizes.setdefault(node, []).append(link.size)
    units = tuple(_named(unit, names, sizes.get(k, []), parts) for k, unit in enumerate(network.units))
    return replace(network, units=units)


def _named(unit: UnitParts, names: Sequence[str | None], sizes: Sequence[int], parts: Parts) -> UnitParts:
    if unit.unit_type != "valve":
        return replace(unit, kind=_kind(unit, {name for part in unit.parts if (name := names[part])}, parts))
    found = valve_kinds(unit, names, sizes, parts)
    if found and found[0][1] >= SURE_FROM:
        return replace(unit, kind=found[0][0])
    return replace(
        unit, kind_guesses=tuple((kind, round(sure, 3)) for kind, sure in found[:_GUESSES] if sure >= _LEAST)
    )


def _kind(unit: UnitParts, names: Collection[str], parts: Parts) -> str | None:
    if unit.unit_type == "gauge":
        return _gauge(unit, names)
    if unit.unit_type == "pump":
        return "centrifugal pump" if _has_crossed_nozzles(unit) else None
    if unit.unit_type == "tank":
        return _tank(unit, parts)
    return next((name for name in sorted(names) if unit.unit_type == "equipment"), None)


def _gauge(unit: UnitParts, names: Collection[str]) -> str | None:
    for name in _GAUGES:
        if name in names:
            return name if name != "transmitter" or len(unit.openings) < 2 else "flow meter"
    if len(unit.openings) > 1 and "gauge face" not in names:
        return "flow meter"
    # Of what nothing but its group is known, nobody knows what it shows.
    return "pressure gauge" if names else None


def _tank(unit: UnitParts, parts: Parts) -> str:
    members, properties = list(unit.parts), parts.properties
    shell = members[int(np.argmax(properties.obb_volume[members]))]
    axis = properties.obb_axes[shell, 0]
    if abs(axis[2]) > _STEEP:
        return "tank"
    # Along its shell and across it, whichever way it is turned about the vertical.
    along = axis[:2] / np.linalg.norm(axis[:2])
    frame = np.array([[along[0], along[1], 0.0], [-along[1], along[0], 0.0], [0.0, 0.0, 1.0]])
    corners = np.concatenate([parts.scene.mesh(part)[0] @ frame.T for part in members])
    long, wide, high = corners.max(axis=0) - corners.min(axis=0)
    return "horizontal tank" if long > _LYING * high and long > _LYING * wide else "tank"


def _has_crossed_nozzles(unit: UnitParts) -> bool:
    directions = [opening.direction for opening in unit.openings if opening.direction is not None]
    return len(directions) == 2 and abs(float(np.dot(directions[0], directions[1]))) < 0.35
