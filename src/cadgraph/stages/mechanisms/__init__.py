"""Mechanisms: what moves at the units of a plant, about which axis, and how far."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal

from cadgraph.model.derived import store_of
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.labels import Label
from cadgraph.model.mechanisms import NOT_MOVABLE, FoundMechanism, UnitMotion
from cadgraph.model.parts import Network, Parts, UnitParts
from cadgraph.model.places import UnitAccess
from cadgraph.model.scene import Floats, Scene
from cadgraph.stages.mechanisms.body import Body, bodies_of, split
from cadgraph.stages.mechanisms.lever import Lever, find_lever
from cadgraph.stages.mechanisms.needle import dial_of, needle_of
from cadgraph.stages.mechanisms.stroke import Stroke, stroke_of_lever, stroke_of_wheel
from cadgraph.stages.mechanisms.valve import Valve, line_of
from cadgraph.stages.mechanisms.wheel import Wheel, find_wheel, is_geared

__all__ = ["find_mechanisms", "report_not_movable"]

# Valves that nobody moves: the flow does, or air.
_BY_ITSELF = ("check", "relief", "safety", "reducing", "float", "foot", "flap", "breather", "air", "control")
_NO_OPERATOR = "no wheel or lever was found"
_ONE_SURFACE = "one surface with its body"
# What turns valves of a kind, where it can't be told apart from the body.
_TURNED_BY = {"gate": "wheel", "globe": "wheel", "diaphragm": "wheel", "ball": "lever", "plug": "lever"}


def find_mechanisms(
    scene: Scene,
    parts: Parts,
    labels: Sequence[Label | None],
    network: Network,
    access: Sequence[UnitAccess],
) -> tuple[UnitMotion, ...]:
    """Finds what moves at each unit, and what is read there.

    Args:
        scene: of source meshes.
        parts: made from them.
        labels: of each part.
        network: with the units.
        access: of each unit, with the faces of gauges.
    """
    sizes = _sizes(network)
    return tuple(
        _motion(scene, parts, labels, unit, sizes.get(number), access[number])
        for number, unit in enumerate(network.units)
    )


def report_not_movable(
    scene: Scene, parts: Parts, units: Sequence[UnitParts], found: Sequence[UnitMotion]
) -> list[Diagnostic]:
    """The valves that would be moved by hand, but of which nothing is known to move.

    Args:
        scene: of source meshes.
        parts: made from them.
        units: of the network.
        found: of each unit.
    """
    return [
        Diagnostic(
            NOT_MOVABLE,
            f"{unit.tag}: {motion.why_not}",
            tuple(scene.paths[mesh] for part in unit.parts for mesh in parts.meshes[part]),
        )
        for unit, motion in zip(units, found, strict=False)
        if motion.why_not
    ]


def _sizes(network: Network) -> Mapping[int, int]:
    """The least nominal size (DN) of the lines at each node."""
    found: dict[int, int] = {}
    for link in network.links:
        for node in (link.source, link.target):
            if link.size is not None:
                found[node] = min(found.get(node, link.size), link.size)
    return found


def _motion(
    scene: Scene, parts: Parts, labels: Sequence[Label | None], unit: UnitParts, size: int | None, access: UnitAccess
) -> UnitMotion:
    if unit.unit_type not in ("valve", "gauge"):
        return UnitMotion()
    names = tuple((label.name or "") if (label := labels[part]) is not None else "" for part in unit.parts)
    # All that it follows from, beside geometry: what a correction elsewhere leaves as it was is not looked at again.
    kept = store_of(parts, "mechanisms")
    key = unit, names, size, access.facing, access.face, access.viewpoint
    if key not in kept:
        pairs = [(mesh, name) for part, name in zip(unit.parts, names, strict=True) for mesh in parts.meshes[part]]
        bodies = bodies_of(scene, [mesh for mesh, _ in pairs], [name for _, name in pairs])
        kept[key] = (
            _of_gauge(scene, bodies, access) if unit.unit_type == "gauge" else _of_valve(scene, bodies, unit, size)
        )
    found: UnitMotion = kept[key]
    return found


def _of_gauge(scene: Scene, bodies: Sequence[Body], access: UnitAccess) -> UnitMotion:
    if access.facing is None:
        return UnitMotion()
    dial = dial_of(access, bodies)
    needle = needle_of(dial, bodies) if dial is not None else None
    if needle is None:
        # In few meshes, the needle is maybe a piece of one.
        pieces = [piece for body in bodies for piece in split(scene, body)]
        if pieces:
            dial = dial_of(access, [*bodies, *pieces])
            needle = needle_of(dial, pieces) if dial is not None else None
    return UnitMotion(needle, dial, readable=True)


def _of_valve(scene: Scene, bodies: Sequence[Body], unit: UnitParts, size: int | None) -> UnitMotion:
    if any(word in (unit.kind or "") for word in _BY_ITSELF) or not bodies:
        return UnitMotion()
    valve = Valve(unit, tuple(bodies), line_of(unit), size)
    pieces: list[Body] = []
    found = _operator(valve, bodies, pieces) if len(bodies) > 1 else None
    if found is None:
        pieces = [piece for body in bodies for piece in split(scene, body)]
        found = _operator(valve, bodies, pieces) if len(bodies) > 1 and pieces else None
    if found is None and "actuator" not in valve.names:
        found = _operator(valve, pieces, pieces)
    if found is not None:
        return UnitMotion(found)
    if "actuator" in valve.names:
        return UnitMotion()
    return UnitMotion(why_not=_NO_OPERATOR if len(bodies) > 1 or pieces else _welded(unit))


def _welded(unit: UnitParts) -> str:
    """Why a valve of one surface can't be moved."""
    of_kind = next((name for kind, name in _TURNED_BY.items() if kind in (unit.kind or "")), "")
    return f"{f'its {of_kind}' if of_kind else 'a wheel or lever, if it has one,'} is {_ONE_SURFACE}"


def _operator(valve: Valve, bodies: Sequence[Body], pieces: Sequence[Body]) -> FoundMechanism | None:
    """The wheel, else the lever, among some bodies."""
    wheel = find_wheel(valve, bodies, pieces)
    if wheel is not None:
        return _of_wheel(wheel, valve)
    if "actuator" in valve.names:
        return None
    lever = find_lever(valve, bodies, pieces)
    return _of_lever(lever, valve) if lever is not None else None


def _of_wheel(wheel: Wheel, valve: Valve) -> FoundMechanism:
    geared = is_geared(wheel, valve)
    return _moved_by_hand(
        "gear operator" if geared else "handwheel",
        wheel,
        wheel.rim,
        stroke_of_wheel(valve, geared),
        {"axis": wheel.source, "pivot": "middle of the rim"},
    )


def _of_lever(lever: Lever, valve: Valve) -> FoundMechanism:
    return _moved_by_hand("lever", lever, lever.length, stroke_of_lever(lever, valve), lever.sources)


def _moved_by_hand(
    kind: Literal["handwheel", "gear operator", "lever"],
    operator: Wheel | Lever,
    radius: float,
    stroke: Stroke,
    sources: Mapping[str, str],
) -> FoundMechanism:
    return FoundMechanism(
        kind=kind,
        meshes=operator.body.meshes,
        pieces=operator.body.pieces,
        axis=_triple(operator.frame.axis),
        pivot=_triple(operator.frame.origin),
        radius=radius,
        thickness=operator.thickness,
        limits=stroke.limits,
        open=stroke.open,
        shut=stroke.shut,
        sources={**sources, **stroke.sources},
    )


def _triple(values: Floats) -> tuple[float, float, float]:
    x, y, z = values.tolist()
    return x, y, z
