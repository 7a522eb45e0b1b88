"""Kinds of units: ball valve, check valve, pressure gauge..., from the parts and the way they lie in the line."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from cadgraph.model.parts import Network, Parts, UnitParts
from cadgraph.model.standards import by_size

__all__ = ["name_kinds"]

_QUARTER = frozenset({"lever", "valve ball"})
_DRIVEN = frozenset({"lever", "handwheel", "actuator", "gearbox", "valve stem", "yoke"})
# A wafer body is shorter than this share of its pipe's outer diameter; flanged bodies are longer than it is wide.
_WAFER = 1.0
_FACE_TOLERANCE = 0.01  # m, gaskets included
# A tank lies where it is longer than high and than deep by this factor.
_LYING = 1.15
_GAUGES = ("level gauge", "flow meter", "transmitter", "sight glass", "thermowell")


def name_kinds(network: Network, names: Sequence[str | None], parts: Parts) -> Network:
    """Says of each unit what it is, as far as its parts and shape tell.

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
    units = tuple(
        replace(unit, kind=_kind(unit, {name for part in unit.parts if (name := names[part])}, sizes.get(k, []), parts))
        for k, unit in enumerate(network.units)
    )
    return replace(network, units=units)


def _kind(unit: UnitParts, names: set[str], sizes: Sequence[int], parts: Parts) -> str | None:
    if unit.unit_type == "valve":
        return _valve(unit, names, sizes)
    if unit.unit_type == "gauge":
        for name in _GAUGES:
            if name in names:
                return name if name != "transmitter" or len(unit.openings) < 2 else "flow meter"
        if len(unit.openings) > 1 and "gauge face" not in names:
            return "flow meter"
        return "pressure gauge"
    if unit.unit_type == "pump":
        return "centrifugal pump" if _has_crossed_nozzles(unit) else None
    if unit.unit_type == "tank":
        low = parts.properties.aabb[list(unit.parts), 0].min(axis=0)
        wide, deep, high = parts.properties.aabb[list(unit.parts), 1].max(axis=0) - low
        return (
            "horizontal tank"
            if max(wide, deep) > _LYING * high and max(wide, deep) > _LYING * min(wide, deep)
            else "tank"
        )
    return next((name for name in sorted(names) if unit.unit_type == "equipment"), None)


def _valve(unit: UnitParts, names: set[str], sizes: Sequence[int]) -> str | None:
    """The kind of a valve: the first rule that holds says it, None where it leaves it open."""
    length = _through(unit)
    driven = bool(names & _DRIVEN)
    if not names - {"valve"}:
        return None
    if len(unit.openings) == 1 and not driven:
        return "relief valve"
    if length is not None and sizes and length < _WAFER * min(sizes) / 1000:
        return "butterfly valve" if driven else "check valve"
    if "gearbox" in names:
        return None
    if names & _QUARTER or ("actuator" in names and not names & {"yoke", "handwheel"}):
        return "ball valve"
    if names & {"handwheel", "yoke"}:
        return None if length is None or not sizes else _by_length(length, min(sizes))
    return "check valve" if not driven else None


def _by_length(length: float, size: int) -> str | None:
    """Gate or globe valve, by the length from face to face [m] of a nominal size, where the two differ in that."""
    lengths = {kind: by_size("face_to_face", "valve", kind).get(size, 0.0) for kind in ("gate", "globe")}
    if lengths["globe"] - lengths["gate"] <= 2 * _FACE_TOLERANCE:
        return None
    return next((f"{kind} valve" for kind, face in lengths.items() if abs(length - face) <= _FACE_TOLERANCE), None)


def _through(unit: UnitParts) -> float | None:
    """From one opening to the other of two that lie in one line [m]."""
    if len(unit.openings) != 2:
        return None
    a, b = unit.openings
    if a.direction is not None and b.direction is not None and float(np.dot(a.direction, b.direction)) > -0.9:
        return None
    return float(np.linalg.norm(np.subtract(a.point, b.point)))


def _has_crossed_nozzles(unit: UnitParts) -> bool:
    directions = [opening.direction for opening in unit.openings if opening.direction is not None]
    return len(directions) == 2 and abs(float(np.dot(directions[0], directions[1]))) < 0.35
