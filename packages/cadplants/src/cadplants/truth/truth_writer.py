"""The truth of a generated plant, put down: everything that its builders and its spoilers know about it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from cadplants.model.plant import Component, Connection, Line, Plant, Point, turned_front
from cadplants.truth.part_oracle import find_parts

__all__ = ["truth_of"]


def truth_of(plant: Plant, paths: Sequence[str] | None = None) -> dict[str, Any]:
    """Everything known about a plant, as plain JSON values in the order of ``docs/truth.md``.

    Args:
        plant: finished plant.
        paths: path of each component in a file; those of ``plant.scene()`` by default.
    """
    names = tuple(paths) if paths is not None else plant.paths()
    of_cluster = _paths_by(lambda component: component.cluster, plant, names)
    return {
        "format": "cadgraph-truth",
        "version": 1,
        "preset": plant.name,
        "seed": plant.seed,
        "hands": list(plant.styles),
        "meshes": [_mesh(path, c) for path, c in zip(names, plant.components, strict=True)],
        "units": _units(plant, names),
        **_devices(plant, names),
        "points": [_point(p) for p in plant.points],
        "connections": [_connection(c) for c in plant.connections],
        "lines": [_line(line) for line in plant.lines],
        "clusters": [{"id": name, "meshes": meshes} for name, meshes in of_cluster.items()],
        "parts": [[names[i] for i in part] for part in find_parts(plant)],
        "looseness": round(plant.looseness, 9),
        "contacts": _named_pairs(plant.contacts, names),
        "duplicates": _named_pairs(plant.duplicates, names),
        "hidden": [names[i] for i in plant.hidden],
        "flaws": {path: list(c.flaws) for path, c in zip(names, plant.components, strict=True) if c.flaws},
        "gaps": {path: round(c.gap, 6) for path, c in zip(names, plant.components, strict=True) if c.gap},
        "colors": plant.colors,
    }


def _paths_by(key: Callable[[Component], str], plant: Plant, names: Sequence[str]) -> dict[str, list[str]]:
    """The paths of the components that have a key, by that key."""
    found: dict[str, list[str]] = {}
    for path, component in zip(names, plant.components, strict=True):
        if key(component):
            found.setdefault(key(component), []).append(path)
    return found


def _units(plant: Plant, names: Sequence[str]) -> list[dict[str, Any]]:
    meshes = _paths_by(lambda component: component.unit, plant, names)
    clamped = _paths_by(lambda component: component.holds, plant, names)
    fronts: dict[str, list[float]] = {}
    for component in plant.components:
        front = turned_front(component.front, component.pose) if component.unit else None
        if front is not None and component.unit not in fronts:
            fronts[component.unit] = _rounded(front)
    turning = _turning(plant, names)
    return [
        {
            "id": unit.id,
            "type": unit.type,
            "kind": unit.kind,
            "tag": unit.id,
            "meshes": meshes.get(unit.id, []),
            **({"fasteners": clamped[unit.id]} if unit.id in clamped else {}),
            **({"faces": fronts[unit.id]} if unit.id in fronts else {}),
            **({"turns": turning[unit.id]} if unit.id in turning else {}),
        }
        for unit in plant.units
    ]


def _devices(plant: Plant, names: Sequence[str]) -> dict[str, Any]:
    """The devices whose parameters are known, each with its style and its meshes; nothing where none are."""
    meshes: dict[int, list[int]] = {}
    for index, component in enumerate(plant.components):
        if component.params is not None:
            # All meshes of a device share one mapping, and two devices never do.
            meshes.setdefault(id(component.params), []).append(index)
    rows, styles = [], plant.device_styles()
    for members in meshes.values():
        first = plant.components[members[0]]
        family, _, build = first.family.partition("/")
        row = {"family": family, "build": build, "params": first.params, "meshes": [names[i] for i in members]}
        if first.made_in is not None:
            row["style"] = styles[first.made_in]
        rows.append(row)
    drawn = {name: style.to_json() for style, name in styles.items() if not style.published}
    return {"devices": rows, **({"styles": drawn} if drawn else {})} if rows else {}


def _turning(plant: Plant, names: Sequence[str]) -> dict[str, dict[str, Any]]:
    """What turns at each unit; of several the first."""
    found: dict[str, dict[str, Any]] = {}
    for path, component in zip(names, plant.components, strict=True):
        if component.turns is not None and component.unit and component.unit not in found:
            placed = component.turns.placed(component.pose)
            found[component.unit] = {
                "kind": placed.kind,
                "mesh": path,
                "axis": _rounded(placed.axis),
                "point": _rounded(placed.point),
            }
    return found


def _point(point: Point) -> dict[str, Any]:
    said = {"id": point.id, "kind": point.kind, "point": _rounded(point.point)}
    return {**said, "end": point.end} if point.end else said


def _line(line: Line) -> dict[str, Any]:
    return {
        "id": line.id,
        "points": [_rounded(point) for point in line.points.tolist()],
        "outer": round(line.outer, 6),
    }


def _named_pairs(pairs: Sequence[tuple[int, int]], names: Sequence[str]) -> list[list[str]]:
    return [[names[a], names[b]] for a, b in pairs]


def _mesh(path: str, component: Component) -> dict[str, str | None]:
    family, _, build = (component.family or component.name).partition("/")
    said = {
        "line": component.line,
        "family": family,
        "build": build,
        "granularity": component.granularity,
        "hand": component.style,
    }
    known = {key: value for key, value in said.items() if value}
    return {"mesh": path, "group": component.group or None, "name": component.name or None, **known}


def _connection(connection: Connection) -> dict[str, Any]:
    return {
        "from": connection.source,
        "to": connection.target,
        "line": connection.line or None,
        "length": round(connection.length, 6),
        "diameter": connection.diameter,
        "direction": connection.direction,
        "reason": connection.reason or None,
    }


def _rounded(point: Sequence[float]) -> list[float]:
    return [round(float(x), 6) for x in point]
