"""How people get at a unit: where they stand, how they get there, how high it is, and from where a gauge is read."""

from __future__ import annotations

import math
from typing import Annotated, Any

from cadgraph.agents.answer import Answer, AskError, cell, page_of
from cadgraph.agents.looking import NO_PLACES
from cadgraph.agents.measuring import compass
from cadgraph.agents.plant import Plant
from cadgraph.model.records import Access, Place, Point, Unit
from cadgraph.query.places import region, stand_at, way_to

__all__ = ["approach"]

_REACH = 2.0  # m; what access in graphs is found with
_SURE = 0.8  # a facing of less confidence is told as a doubt


def approach(
    plant: Plant,
    target: str,
    reach: Annotated[float, "of a hand above the floor [m]"] = _REACH,
) -> Answer:
    """How to get at a unit.

    Args:
        plant: that holds it.
        target: tag, id or mesh of the unit.
        reach: how high over the floor one gets [m].

    Returns:
        The level that it is reached from and the ways up to it, where to stand, the height of its operator or face
        over the floor, and for a gauge which way it looks and where an eye sees it.

    Raises:
        AskError: nothing is called so, or it is no unit; the reach is none.
    """
    if not 0 < reach <= 10:
        raise AskError(f"reach={reach:g}: give how high a hand gets above the floor, above 0 and up to 10 m")
    unit = plant.find(target, Unit)
    if not isinstance(unit, Unit):
        raise AskError(f"{cell(target)!r} is no unit; give the tag of a valve, gauge, pump, tank...")
    values: dict[str, Any] = {"unit": plant.called(unit.id), "type": unit.unit_type, "kind": unit.kind}
    access = unit.access
    place = plant.graph.nodes.get(access.place or "") if access is not None else None
    if access is None or not isinstance(place, Place):
        return Answer(page_of([f"{values['unit']}: {NO_PLACES}"], [], [], 1), {**values, "reach": None})
    values |= _stood(plant, unit, access, place, reach)
    values |= {
        "region": region(plant.graph, unit.centroid),
        "facing": None if access.facing is None else list(access.facing),
        "facing_confidence": access.facing_confidence,
        "viewpoint_m": None if access.viewpoint is None else list(access.viewpoint),
    }
    return Answer(page_of(_told(values, unit, access), [], [], 1), values)


def _stood(plant: Plant, unit: Unit, access: Access, place: Place, reach: float) -> dict[str, Any]:
    """The level, the ways to it, where to stand, and whether that is within reach."""
    said, stand, level = access.reach, access.stand, place
    if reach != _REACH:
        found = stand_at(plant.graph, unit, reach)
        said = "out of reach" if found is None else "floor" if found[0].kind == "ground" else "platform"
        level, stand = found if found is not None else (place, access.stand)
    steps = way_to(plant.graph, level)
    return {
        "reach": said,
        "reach_m": reach,
        "level": cell(level.name),
        "level_id": level.id,
        "way": [cell(step.name) for step in steps],
        "way_ids": [step.id for step in steps],
        "stand_m": None if stand is None else list(stand),
        "height_m": place.height + access.height - level.height,
    }


def _told(values: dict[str, Any], unit: Unit, access: Access) -> list[str]:
    name = " ".join([values["unit"], cell(unit.kind or unit.unit_type)])
    what = _worked_at(unit, access)
    if values["reach"] == "out of reach":
        told = [
            f"{name}: OUT OF REACH of a hand at {values['reach_m']:.1f} m: no level with a known way up brings one "
            "near enough; a ladder or lift is needed, or a way was not recognised"
        ]
    else:
        told = [f"{name}: reached from {values['level']} ({values['level_id']})"]
    told.append(f"{what}: {values['height_m']:.2f} m above {values['level']}, {values['region']} of the plant")
    if values["reach"] != "out of reach" and values["way"]:
        told.append(f"way: {' > '.join(values['way'])}")
    if values["stand_m"] is not None:
        to_look = "to look at it, " if values["reach"] == "out of reach" else ""
        told.append(f"{to_look}stand at {_at(values['stand_m'])}")
    if unit.unit_type == "gauge":
        told += _face(access)
    return told


def _worked_at(unit: Unit, access: Access) -> str:
    """What the height of a unit is that of: where no face or operator was found, of its middle."""
    if unit.unit_type == "gauge":
        return "its middle" if access.facing is None else "its face"
    if unit.unit_type == "valve":
        return "its operator" if unit.affordances else "its middle"
    return "where one works at it"


def _face(access: Access) -> list[str]:
    """Which way a gauge looks and from where it is read."""
    if access.facing is None:
        return ["its face: unknown; none was found on it"]
    sure = access.facing_confidence or 0.0
    doubt = "" if sure >= _SURE else f" - UNSURE ({sure:.0%}); look before you rely on it"
    told = [f"it looks {_heading(access.facing)}{doubt}"]
    if access.viewpoint is None:
        return [*told, "no free line of sight from where one can stand was found"]
    return [*told, f"seen from an eye at {_at(access.viewpoint)}, nothing in between"]


def _heading(way: Point) -> str:
    level = math.hypot(way[0], way[1])
    if level < 0.3:
        return "up" if way[2] > 0 else "down"
    tilt = math.degrees(math.atan2(way[2], level))
    return compass(way[0], way[1]) + (f" and {'up' if tilt > 0 else 'down'}" if abs(tilt) > 15 else "")


def _at(point: Point | list[float]) -> str:
    return ", ".join(f"{value:.2f}" for value in point)
