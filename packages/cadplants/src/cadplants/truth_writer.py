"""The truth of a generated plant, put down: everything that its builders and its spoilers know about it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from cadplants.part_oracle import find_parts

if TYPE_CHECKING:
    from cadplants.plant import Component, Connection, Plant

__all__ = ["account"]


def account(plant: Plant, names: Sequence[str]) -> dict[str, Any]:
    """Everything known about a plant, as plain JSON values in the order of ``docs/truth.md``.

    Args:
        plant: finished.
        names: path of each component.
    """
    of_unit: dict[str, list[str]] = {unit.id: [] for unit in plant.units}
    clamped: dict[str, list[str]] = {unit.id: [] for unit in plant.units}
    of_cluster: dict[str, list[str]] = {}
    for path, component in zip(names, plant.components, strict=True):
        if component.unit:
            of_unit[component.unit].append(path)
        if component.holds:
            clamped[component.holds].append(path)
        if component.cluster:
            of_cluster.setdefault(component.cluster, []).append(path)
    return {
        "format": "cadgraph-truth",
        "version": 1,
        "preset": plant.name,
        "seed": plant.seed,
        "hands": list(plant.hands),
        "meshes": [_mesh(path, c) for path, c in zip(names, plant.components, strict=True)],
        "units": [
            {
                "id": u.id,
                "type": u.type,
                "kind": u.kind,
                "tag": u.id,
                "meshes": of_unit[u.id],
                **({"fasteners": clamped[u.id]} if clamped[u.id] else {}),
            }
            for u in plant.units
        ],
        "points": [
            {"id": p.id, "kind": p.kind, "point": _rounded(p.point), **({"end": p.end} if p.end else {})}
            for p in plant.points
        ],
        "connections": [_connection(c) for c in plant.connections],
        "lines": [
            {"id": one.id, "points": [_rounded(point) for point in one.points.tolist()], "outer": round(one.outer, 6)}
            for one in plant.lines
        ],
        "clusters": [{"id": name, "meshes": meshes} for name, meshes in of_cluster.items()],
        "parts": [[names[i] for i in part] for part in find_parts(plant)],
        "looseness": round(plant.looseness, 9),
        "contacts": [[names[a], names[b]] for a, b in plant.contacts],
        "duplicates": [[names[a], names[b]] for a, b in plant.duplicates],
        "hidden": [names[i] for i in plant.hidden],
        "flaws": {path: list(c.flaws) for path, c in zip(names, plant.components, strict=True) if c.flaws},
        "gaps": {path: round(c.gap, 6) for path, c in zip(names, plant.components, strict=True) if c.gap},
        "colors": plant.colors,
    }


def _mesh(path: str, component: Component) -> dict[str, str]:
    family, _, build = (component.family or component.name).partition("/")
    told = {
        "line": component.line,
        "family": family,
        "build": build,
        "granularity": component.granularity,
        "hand": component.hand,
    }
    known = {key: value for key, value in told.items() if value}
    return {"mesh": path, "group": component.group, "name": component.name, **known}


def _connection(connection: Connection) -> dict[str, Any]:
    return {
        "from": connection.source,
        "to": connection.target,
        "line": connection.line,
        "length": round(connection.length, 6),
        "diameter": connection.diameter,
        "direction": connection.direction,
        "reason": connection.reason or None,
    }


def _rounded(point: Sequence[float]) -> list[float]:
    return [round(float(x), 6) for x in point]
