"""What shows a direction of flow: nozzles of pumps, check and relief valves, strainers, tanks, gravity, usual practice.

Each source is a function of what there is to see. How sure each is stands in ``SURE``; from 0.85 on it is construction
or physics that the flow can't turn round.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from cadgraph.model.parts import Network, Opening, Parts, UnitParts
from cadgraph.model.scene import Floats
from cadgraph.stages.relate.body_shape import box_around, lean_of, line_through
from cadgraph.stages.relate.flow_spread import Evidence

__all__ = ["SOURCES", "SURE", "Sight"]

SURE: Mapping[str, float] = MappingProxyType(
    {
        "pump, shaft and widths": 0.95,
        "pump, shaft": 0.85,
        "pump, up and widths": 0.85,
        "pump, widths": 0.7,
        "check valve, leaning neck": 0.85,
        "check valve, hinge": 0.85,
        "check valve, spring": 0.85,
        "relief valve, inlet and outlet": 0.95,
        "relief valve, inlet": 0.9,
        "strainer, leaning basket": 0.9,
        "tank, drain": 0.85,
        "tank, outlet": 0.7,
        "tank, overflow": 0.7,
        "check valve at a pump": 0.7,
    }
)
"""How sure each kind of evidence is, by its name."""

# A pump's suction is the nozzle along its shaft, its discharge the one across (centrifugal pumps after ISO 2858): so
# parallel at least and at most (cosines) ...
_AXIAL, _RADIAL = 0.9, 0.35
# ... which is true of a casing as short as this many widths of its nozzle from face to face along the shaft. In a
# progressing-cavity pump, which is longer, the nozzle along the shaft is the discharge.
_SHORT = 4.0
# The shaft is the long axis of the surface where that is so much longer: its least moment against the next.
_LONG = 0.85
# Suction nozzles are wider, by this factor at least where that is to tell them apart.
_WIDER = 1.12
# Up and level (cosines with the vertical).
_UP, _LEVEL = 0.9, 0.2
# A tank's nozzle is low below this share of its height, and high above the rest.
_LOW, _HIGH = 0.35, 0.65
# An open end below a nozzle by this much [m] lets run out what is in the tank; one lower than that may fill it.
_BELOW, _FAR_BELOW = 0.1, 0.5
# An open end looks down (cosine with the vertical).
_DOWN = -0.7
# A part stands aside of another's middle by at least this share of a body's length.
_HINGE, _SPRING = 0.06, 0.05
# A relief valve's inlet lies against the axis of its spring, its outlet across (cosines).
_AGAINST, _ACROSS = -0.8, 0.35
# Parts that a tank stands on are not where its contents are.
_SUPPORTS = frozenset({"tank leg", "skirt", "saddle", "lifting lug"})
_OPERATORS = frozenset({"lever", "handwheel", "actuator", "position indicator"})


@dataclass(frozen=True)
class Sight:
    """What sources look at.

    Args:
        network: units, with their kinds, and links.
        parts: of the scene.
        names: of each part, None where unknown.
        at: the links at each node, and whether they leave it forward.
    """

    network: Network
    parts: Parts
    names: Sequence[str | None]
    at: Mapping[int, Sequence[tuple[int, bool]]]

    def units(self, unit_type: str, kind: str | None = None) -> Iterator[tuple[int, UnitParts]]:
        """The units of a type, maybe of a kind, with their numbers."""
        for number, unit in enumerate(self.network.units):
            if unit.unit_type == unit_type and kind in (None, unit.kind):
                yield number, unit

    def at_port(self, unit: int, port: int) -> list[tuple[int, bool]]:
        """The links at a unit's opening, and whether they leave it forward."""
        found = []
        for number, forward in self.at.get(unit, ()):
            link = self.network.links[number]
            if (link.source_port if forward else link.target_port) == port:
                found.append((number, forward))
        return found

    def there(self, number: int, forward: bool) -> int:
        """The node that a link leads to."""
        return self.network.links[number].target if forward else self.network.links[number].source

    def line(self, start: int, number: int, forward: bool) -> Iterator[tuple[int, bool, int]]:
        """The links of a line without a branch from a node on, with their sense and the node that each leads to."""
        seen = {start}
        while True:
            node = self.there(number, forward)
            if node in seen:
                return
            seen.add(node)
            yield number, forward, node
            passes = node < len(self.network.units) and self.network.units[node].unit_type in ("valve", "gauge")
            ahead = [(k, f) for k, f in self.at[node] if k != number] if passes else []
            if len(ahead) != 1:
                return
            number, forward = ahead[0]

    def named(self, unit: UnitParts, names: Collection[str]) -> list[int]:
        """The parts of a unit that have one of some names."""
        return [part for part in unit.parts if self.names[part] in names]


def _flowing(sight: Sight, unit: int, port: int, out: bool, sure: str, reason: str) -> Iterator[Evidence]:
    """Evidence that it flows out of a unit at an opening, or in."""
    for number, forward in sight.at_port(unit, port):
        yield Evidence(number, forward == out, SURE[sure], reason)


def _passing(sight: Sight, unit: int, inlet: int, sure: str, reason: str) -> Iterator[Evidence]:
    """Evidence that it flows through a unit of two openings, in at one and out at the other."""
    yield from _flowing(sight, unit, inlet, False, sure, reason)
    yield from _flowing(sight, unit, 1 - inlet, True, sure, reason)


# --- pumps ---


def pumps(sight: Sight) -> Iterator[Evidence]:
    """The nozzle along the shaft draws, the one across delivers; the one that draws is wider."""
    for number, unit in sight.units("pump"):
        if len(unit.openings) < 2:
            continue
        found = _suction(_as_wide_as_lines(sight, number, unit), _shaft(unit, sight.parts))
        if found is None:
            continue
        suction, discharge, sure, why = found
        yield from _flowing(sight, number, suction, False, sure, f"suction of {unit.tag} ({why})")
        yield from _flowing(sight, number, discharge, True, sure, f"discharge of {unit.tag} (its suction is {why})")


def _as_wide_as_lines(sight: Sight, number: int, unit: UnitParts) -> UnitParts:
    """A pump whose openings are alike where the lines at them are of one nominal size.

    What joins first may be a gasket on one side and a bare pipe on the other, whose diameters tell nothing of nozzles.
    """
    sizes = {_size_at(sight, number, port) for port in range(len(unit.openings))}
    size = sizes.pop()
    if size is None or sizes:
        return unit
    return replace(unit, openings=tuple(replace(opening, diameter=size / 1000) for opening in unit.openings))


def _size_at(sight: Sight, number: int, port: int) -> int | None:
    """The nominal size with which the line at an opening begins, None where it is unknown."""
    found = {
        link.sizes[0 if forward else -1]
        for k, forward in sight.at_port(number, port)
        if (link := sight.network.links[k]).sizes
    }
    return found.pop() if len(found) == 1 else None


def _shaft(unit: UnitParts, parts: Parts) -> Floats | None:
    """The long axis of a unit's surface, that of pump and motor; None where it is about as long as wide."""
    index = np.asarray(unit.parts)
    area, centroid = parts.properties.area[index], parts.properties.centroid[index]
    total = float(area.sum())
    middle = (area[:, None] * centroid).sum(axis=0) / total if total > 0 else centroid.mean(axis=0)
    offset = centroid - middle
    apart = (offset**2).sum(axis=1)[:, None, None] * np.eye(3) - offset[:, :, None] * offset[:, None, :]
    inertia = (parts.properties.inertia[index] + area[:, None, None] * apart).sum(axis=0)
    if not np.isfinite(inertia).all():
        return None
    moments, axes = np.linalg.eigh(inertia)
    axis: Floats = axes[:, 0]
    return axis if moments[0] <= _LONG * moments[1] else None


def _suction(unit: UnitParts, shaft: Floats | None) -> tuple[int, int, str, str] | None:
    """The openings of suction and discharge, how sure that is, and why."""
    wide = sorted(range(len(unit.openings)), key=lambda k: (-(unit.openings[k].diameter or 0.0), k))[:2]
    ports = sorted(wide)
    a, b = (unit.openings[port] for port in ports)
    eye = _axial(a, b, shaft)
    found = _by_shaft(eye, _wider(a, b)) if eye is not None else _by_width(a, b, shaft)
    return None if found is None else (ports[found[0]], ports[1 - found[0]], *found[1:])


def _by_shaft(eye: int, wider: int | None) -> tuple[int, str, str] | None:
    if wider is None:
        return eye, "pump, shaft", "along the shaft"
    return (eye, "pump, shaft and widths", "along the shaft, the wider one") if wider == eye else None


def _by_width(a: Opening, b: Opening, shaft: Floats | None) -> tuple[int, str, str] | None:
    wider = _wider(a, b)
    if wider is None or _share(a, shaft) >= _AXIAL or _share(b, shaft) >= _AXIAL:
        return None
    level = _level_and_up(a, b)
    if level is None:
        return wider, "pump, widths", "the wider nozzle"
    return (wider, "pump, up and widths", "level and wider") if level == wider else None


def _wider(a: Opening, b: Opening) -> int | None:
    """Which of two nozzles is wider, None where they are about alike."""
    ratio = (a.diameter or 0.0) / b.diameter if a.diameter and b.diameter else 1.0
    return 0 if ratio >= _WIDER else 1 if ratio <= 1 / _WIDER else None


def _axial(a: Opening, b: Opening, shaft: Floats | None) -> int | None:
    """Which of two nozzles lies along the shaft while the other lies across, near it."""
    if shaft is None:
        return None
    along = [_share(a, shaft), _share(b, shaft)]
    eye = int(np.argmax(along))
    # Which way a nozzle without a direction looks is not known: it neither lies along the shaft nor across.
    if along[eye] < _AXIAL or not 0.0 <= along[1 - eye] <= _RADIAL:
        return None
    # Above an upright shaft stands the motor: what is long there is a tall base, and the shaft lies level.
    if _level_and_up(a, b) == 1 - eye:
        return None
    reach = abs(float(np.dot(np.subtract(a.point, b.point), shaft)))
    width = max(a.diameter or 0.0, b.diameter or 0.0)
    return eye if not width or reach <= _SHORT * width else None


def _share(opening: Opening, shaft: Floats | None) -> float:
    """How far a nozzle lies along the shaft (cosine); -1 where that is not known."""
    if shaft is None or opening.direction is None:
        return -1.0
    return abs(float(np.dot(opening.direction, shaft)))


def _level_and_up(a: Opening, b: Opening) -> int | None:
    """Which of two nozzles looks sideways while the other looks up."""
    for k, (level, up) in enumerate(((a.direction, b.direction), (b.direction, a.direction))):
        if level is not None and up is not None and abs(level[2]) <= _LEVEL and up[2] >= _UP:
            return k
    return None


# --- valves that let flow pass one way only ---


def check_valves(sight: Sight) -> Iterator[Evidence]:
    """What is built into a check valve lies on one side: a neck leans, a hinge stands before, a spring behind."""
    for number, unit in sight.units("valve", "check valve"):
        line = line_through(unit.openings)
        if line is None:
            continue
        for sure, inlet in (
            ("check valve, leaning neck", _by_lean(sight, unit, line)),
            ("check valve, hinge", _by_hinge(sight, unit, line)),
            ("check valve, spring", _by_spring(sight, unit, line)),
        ):
            if inlet is not None:
                yield from _passing(sight, number, inlet, sure, f"{unit.tag}: {sure}")


def _by_lean(sight: Sight, unit: UnitParts, line: tuple[Floats, Floats]) -> int | None:
    """A neck that holds a ball, disc or piston leans downstream: flow lifts it off its seat along the neck."""
    body = [part for part in unit.parts if sight.names[part] not in _OPERATORS]
    slope = lean_of(sight.parts, body, line) if body else None
    return None if not slope else 0 if slope > 0 else 1


def _by_hinge(sight: Sight, unit: UnitParts, line: tuple[Floats, Floats]) -> int | None:
    """A flap hangs upstream of the middle of the cover under which it swings open."""
    shafts = sight.named(unit, ("valve stem", "shaft"))
    covers = sight.named(unit, ("valve bonnet",))
    if not shafts or not covers or any(not _lies_across(sight, part, line) for part in shafts):
        return None
    return _aside(sight, line, shafts, covers, _HINGE)


def _lies_across(sight: Sight, part: int, line: tuple[Floats, Floats]) -> bool:
    """Whether a rod lies across the line, and level with what it is led through."""
    axis = (line[1] - line[0]) / np.linalg.norm(line[1] - line[0])
    extents = sight.parts.properties.obb_extents[part]
    long = sight.parts.properties.obb_axes[part, 0]
    return bool(extents[0] >= 2 * extents[1] and abs(float(long @ axis)) <= _ACROSS)


def _by_spring(sight: Sight, unit: UnitParts, line: tuple[Floats, Floats]) -> int | None:
    """A spring and its guide stand behind the disc that they press against its seat."""
    discs, springs = sight.named(unit, ("valve disc",)), sight.named(unit, ("valve stem", "spring"))
    if not discs or not springs or any(_lies_across(sight, part, line) for part in springs):
        return None
    return _aside(sight, line, discs, springs, _SPRING)


def _aside(
    sight: Sight, line: tuple[Floats, Floats], before: Sequence[int], behind: Sequence[int], least: float
) -> int | None:
    """The opening that some parts are nearer to than some others, by a share of the line between both."""
    axis = line[1] - line[0]
    length = float(np.linalg.norm(axis))
    middle = sight.parts.properties.centroid
    ahead = float((middle[list(behind)].mean(axis=0) - middle[list(before)].mean(axis=0)) @ axis) / length**2
    return None if abs(ahead) < least else 0 if ahead > 0 else 1


def relief_valves(sight: Sight) -> Iterator[Evidence]:
    """A relief valve's inlet is against the axis of its spring, its outlet across; nothing comes out of its inlet."""
    for number, unit in sight.units("valve", "relief valve"):
        links = sight.at.get(number, ())
        if len(unit.openings) == 1 and len(links) == 1:
            # On a tap of a run it stands in the run with two links, neither of which runs through it.
            yield from _flowing(sight, number, 0, False, "relief valve, inlet", f"inlet of {unit.tag}")
        if len(unit.openings) == 2:
            inlet = _spring_inlet(sight, unit)
            if inlet is not None:
                reason = f"{unit.tag}: inlet below its spring, outlet aside"
                yield from _passing(sight, number, inlet, "relief valve, inlet and outlet", reason)


def _spring_inlet(sight: Sight, unit: UnitParts) -> int | None:
    """Which of two openings lies against the way the body stands out over both."""
    low, high = box_around(sight.parts, unit.parts)
    directions = [opening.direction for opening in unit.openings]
    for k, (inlet, outlet) in enumerate(zip(directions, directions[::-1], strict=True)):
        if inlet is None or outlet is None or abs(float(np.dot(inlet, outlet))) > _ACROSS:
            continue
        # How far the body reaches away from each opening, seen from the other one's height.
        away = -np.asarray(inlet)
        beyond = float(np.where(away > 0, high, low) @ away - np.dot(unit.openings[1 - k].point, away))
        before = float(np.dot(unit.openings[1 - k].point, away) - np.dot(unit.openings[k].point, away))
        if before > 0 and beyond >= 1.2 * before:
            return k
    return None


def strainers(sight: Sight) -> Iterator[Evidence]:
    """The basket of a Y strainer leans downstream, so that flow runs into it and dirt stays there."""
    for number, link in enumerate(sight.network.links):
        for part in link.via:
            if sight.names[part] != "strainer":
                continue
            line = _along_path(sight, number, part)
            slope = lean_of(sight.parts, [part], line) if line is not None else None
            if slope:
                sure = "strainer, leaning basket"
                yield Evidence(number, slope > 0, SURE[sure], "a strainer's basket leans downstream")


def _along_path(sight: Sight, number: int, part: int) -> tuple[Floats, Floats] | None:
    """Where a link's path enters and leaves the box of a part."""
    path = np.asarray(sight.network.links[number].path)
    low, high = sight.parts.properties.aabb[part]
    if len(path) < 2:
        return None
    middle = (low + high) / 2
    steps = np.diff(path, axis=0)
    length = np.linalg.norm(steps, axis=1)
    units = steps / np.maximum(length, 1e-12)[:, None]
    share = np.clip(((middle - path[:-1]) * units).sum(axis=1), 0, length)
    near = path[:-1] + share[:, None] * units
    k = int(np.linalg.norm(near - middle, axis=1).argmin())
    half = 0.5 * float(np.abs(units[k]) @ (high - low))
    return (near[k] - half * units[k], near[k] + half * units[k]) if half > 1e-6 else None


# --- tanks ---


def tanks(sight: Sight) -> Iterator[Evidence]:
    """What is in a tank runs out of a low nozzle to a lower open end, and over from a high one."""
    for number, unit in sight.units("tank"):
        low, high = _filled(sight, unit)
        for port, opening in enumerate(unit.openings):
            for link, forward in sight.at_port(number, port):
                end = _free_end(sight, number, link, forward)
                sure = None if end is None else _runs_out(opening, low, high, end)
                if sure is not None:
                    yield Evidence(link, forward, SURE[sure], f"{sure.split(', ')[1]} of {unit.tag}")


def _filled(sight: Sight, unit: UnitParts) -> tuple[float, float]:
    """Lowest and highest point of what holds a tank's contents."""
    body = [part for part in unit.parts if sight.names[part] not in _SUPPORTS] or list(unit.parts)
    box = sight.parts.properties.aabb[body]
    return float(box[:, 0, 2].min()), float(box[:, 1, 2].max())


@dataclass(frozen=True)
class _End:
    """The open end of a line: its height [m], the vertical part of the way it looks, and how many valves are before."""

    height: float
    looks: float
    valves: int


def _runs_out(opening: Opening, low: float, high: float, end: _End) -> str | None:
    """What the line from a nozzle of a tank, between its lowest and highest point [m], to an open end is."""
    height = opening.point[2]
    share = (height - low) / max(high - low, 1e-9)
    upward = opening.direction is not None and opening.direction[2] > 0.5
    if share <= _LOW and not upward:
        return _drains(height, end)
    far = max(_FAR_BELOW, 0.5 * (high - low))
    over = share >= _HIGH and end.height <= height - far
    return "tank, overflow" if over and end.looks <= _DOWN and not end.valves else None


def _drains(height: float, end: _End) -> str | None:
    if end.height <= height - _BELOW and end.looks <= _DOWN:
        return "tank, drain"
    return "tank, outlet" if end.height <= height + _BELOW else None


def _free_end(sight: Sight, start: int, number: int, forward: bool) -> _End | None:
    """The open end that a line leads to without a branch."""
    count, valves = len(sight.network.units), 0
    for last, onward, node in sight.line(start, number, forward):
        if node >= count and sight.network.places[node - count].kind in ("open", "unknown"):
            path = np.asarray(sight.network.links[last].path)[:: 1 if onward else -1]
            way = path[-1] - path[-2] if len(path) > 1 else np.zeros(3)
            return _End(float(path[-1, 2]), float(way[2] / max(float(np.linalg.norm(way)), 1e-12)), valves)
        valves += node < count and sight.network.units[node].unit_type == "valve"
    return None


# --- usual practice ---


def checks_at_pumps(sight: Sight) -> Iterator[Evidence]:
    """A check valve stands behind a pump, not before it; of weight where the pump itself shows nothing."""
    for number, unit in sight.units("pump"):
        if len(unit.openings) != 2 or _suction(unit, _shaft(unit, sight.parts)) is not None:
            continue
        guarded = [port for port in (0, 1) if _leads_to_check(sight, number, port)]
        if len(guarded) == 1:
            reason = f"discharge of {unit.tag} (a check valve follows)"
            yield from _passing(sight, number, 1 - guarded[0], "check valve at a pump", reason)


def _leads_to_check(sight: Sight, pump: int, port: int) -> bool:
    """Whether the next valve but one at most, without a branch, is a check valve."""
    links = sight.at_port(pump, port)
    if len(links) != 1:
        return False
    passed = 0
    for _, _, node in sight.line(pump, *links[0]):
        unit = sight.network.units[node] if node < len(sight.network.units) else None
        if unit is None or passed == 2:
            return False
        if unit.kind == "check valve":
            return True
        passed += unit.unit_type == "valve"
    return False


SOURCES: tuple[Callable[[Sight], Iterator[Evidence]], ...] = (
    pumps,
    check_valves,
    relief_valves,
    strainers,
    tanks,
    checks_at_pumps,
)
"""All sources, in the order in which their evidence is weighed where it is equally sure."""
