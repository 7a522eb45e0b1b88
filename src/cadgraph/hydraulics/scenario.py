"""The scenario of a graph where nobody says otherwise: a value for everything, each with its reason."""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from cadgraph.hydraulics.network import OUTSIDE, UNKNOWN_BORE, bore_at, ports_at
from cadgraph.hydraulics.settings import (
    Characteristic,
    EndRole,
    EndSetting,
    Fluid,
    GaugeSetting,
    Pipes,
    PumpSetting,
    Scenario,
    TankSetting,
    ValveDuty,
    ValveSetting,
)
from cadgraph.model.derived import kept_with
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Part, Terminal, Unit
from cadgraph.query.duty import duty_of, moves_by_itself, suspect_of
from cadgraph.query.network import Arc, Network

__all__ = ["SPANS", "guess_end", "guess_scenario", "guess_valve", "tanks_of_gauges", "with_pressures"]

SPANS = (1.0, 1.6, 2.5, 4.0, 6.0, 10.0, 16.0, 25.0, 40.0, 60.0, 100.0, 160.0, 250.0)
"""Ends of the scales of pressure gauges [bar]; EN 837-1."""
_FLOW_SPANS = tuple(mantissa * 10**power for power in range(-1, 5) for mantissa in (1.0, 1.6, 2.5, 4.0, 6.0))
_HEADROOM = 4 / 3  # a gauge is best read below three quarters of its scale
_RELIEF = 1.1  # a relief valve opens at so many times the pressure that stands before it
_VELOCITY = 2.0  # in the discharge of a pump, and in a sink at 3 bar [m/s]
_PUMP_HEAD = 30.0  # m
_SOURCE = 1.0  # bar(g)
_FILLED = 0.6
_UPRIGHT = 0.98  # least height of a unit vector that counts as vertical

# Loss coefficients when open: the first word that fits the kind counts.
_LOSSES: tuple[tuple[tuple[str, ...], float, str], ...] = (
    (("check", "non-return"), 2.0, "check valve"),
    (("relief", "safety"), 6.0, "relief valve"),
    (("gate",), 0.2, "gate valve"),
    (("ball", "plug"), 0.1, "ball or plug valve"),
    (("butterfly",), 0.7, "butterfly valve"),
    (("globe", "needle", "control", "diaphragm"), 6.0, "globe or control valve"),
)
_OTHER_LOSS = 1.0
_DEFAULT_FLUID = {
    "density": "assumed: water at 20 C",
    "viscosity": "assumed: water at 20 C",
    "vapour": "assumed: water at 20 C, at sea level",
}
_DEFAULT_PIPES = {
    "roughness": "assumed: steel pipe as delivered",
    "bend": "assumed: bends of one and a half diameters",
    "loop_pressure": "assumed: pressure of loops that nothing feeds",
}


def guess_scenario(graph: SceneGraph | Network) -> Scenario:
    """What is supposed of a graph, but for what hangs on the pressures: spans of gauges, set pressures.

    Args:
        graph: the finished graph, or its network.
    """
    network = graph if isinstance(graph, Network) else Network(graph)
    at_tank = tanks_of_gauges(network)
    units = [
        node
        for place, node in network.places.items()
        if isinstance(node, Unit) and (network.arcs(place) or (node.tag in at_tank and _shows_level(node)))
    ]
    of_type: dict[str, list[Unit]] = {}
    for unit in units:
        of_type.setdefault(unit.unit_type, []).append(unit)
    pumps = {unit.tag: _pump(network, unit) for unit in of_type.get("pump", ())}
    tanks = {unit.tag: _tank(network, unit) for unit in of_type.get("tank", ())}
    ends = _Ends(network, pumps).settings()
    named = {**{unit.tag: unit for unit in units}, **{end: network.places[end] for end in ends}}
    return Scenario(
        fluid=Fluid(why=_DEFAULT_FLUID),
        pipes=Pipes(why=_DEFAULT_PIPES),
        valves={unit.tag: guess_valve(network, unit) for unit in of_type.get("valve", ())},
        pumps=pumps,
        ends=ends,
        tanks=tanks,
        gauges={unit.tag: _gauge(unit, tanks.get(at_tank.get(unit.tag, ""))) for unit in of_type.get("gauge", ())},
        names={name: mesh for name, node in named.items() if (mesh := _largest_mesh(network, node)) is not None},
    )


def _largest_mesh(network: Network, node: Any) -> str | None:
    """The mesh that a unit or an end is known by: the first one of its largest part."""
    parts = [network.graph.part(part) for part in node.parts]
    largest = max(parts, key=lambda part: (part.area, part.id), default=None)
    return largest.meshes[0] if largest is not None and largest.meshes else None


def with_pressures(
    scenario: Scenario, before_relief: Mapping[str, float | None], at_gauge: Mapping[str, float | None]
) -> Scenario:
    """A scenario with what hangs on the steady state.

    Args:
        scenario: to complete.
        before_relief: pressure over each relief valve while it is shut [bar], by tag.
        at_gauge: what each gauge measures, in its unit, by tag.
    """
    valves = dict(scenario.valves)
    for tag, pressure in before_relief.items():
        at = round(max(_RELIEF * (pressure or 0.0), 1.0), 2)
        why = {**valves[tag].why, "pressure": "assumed: 1.1 times the pressure before it, at least 1 bar"}
        valves[tag] = valves[tag].model_copy(update={"pressure": at, "why": why})
    gauges = dict(scenario.gauges)
    for tag, value in at_gauge.items():
        gauge = gauges[tag]
        spans = SPANS if gauge.measures == "pressure" else _FLOW_SPANS
        if gauge.measures == "nothing" or gauge.measures == "level":
            continue
        wanted = _HEADROOM * (value or 0.0)
        span = next((each for each in spans if each >= wanted), spans[-1])
        if value is None:
            span, reason = 10.0, "assumed: 10, as nothing is known of what stands there"
        else:
            reason = "assumed: the next usual one above 4/3 of what it shows"
        gauges[tag] = gauge.model_copy(update={"span": round(span, 6), "why": {**gauge.why, "span": reason}})
    return scenario.model_copy(update={"valves": valves, "gauges": gauges})


# Valves


def guess_valve(network: Network, unit: Unit, duty: ValveDuty | None = None) -> ValveSetting:
    """What is supposed of a valve.

    Args:
        network: of the graph.
        unit: the valve.
        duty: what it does, where somebody says so; None: by its kind.
    """
    kind = (unit.kind or "").casefold()
    ports = ports_at(network, unit.id)
    found = duty_of(network, unit.id)
    moved_by_itself = duty or moves_by_itself(network, unit.id, len(ports)) or "hand"
    loss, of = next(
        ((k, name) for words, k, name in _LOSSES if any(word in (kind or moved_by_itself) for word in words)),
        (_OTHER_LOSS, "valve of another or unknown kind"),
    )
    why = {"k": f"assumed: {of}"}
    if moved_by_itself != "hand":
        towards, why["towards"] = _towards(network, unit, ports)
        why["duty"] = f"its kind: {unit.kind}"
        return ValveSetting(duty="check" if moved_by_itself == "check" else "relief", k=loss, towards=towards, why=why)
    why["duty"] = "assumed: moved by hand or an actuator, nothing else moves it"
    if suspect_of(network, unit.id) is not None:
        why["duty"] = "assumed: no check valve, though it stands where one would; is it one? then say duty: check"
    elif found == "unknown":
        why["duty"] = "assumed: of unknown kind, moved by hand"
    elif found == "control":
        why["duty"] = "assumed: a control valve that nothing controls stays as it is set"
    opening, why["opening"] = _opening(unit, len(ports))
    turns, why["turns"] = _turns(network, unit, kind)
    travel, why["travel"] = (1.0, "assumed: a lever in a second") if turns <= 0.25 else (
        round(turns, 1),
        "assumed: a second for each turn",
    )  # fmt: skip
    characteristic, why["characteristic"] = _characteristic(kind)
    return ValveSetting(
        duty="hand", opening=opening, turns=turns, travel=travel, k=loss, characteristic=characteristic, why=why
    )


def _opening(unit: Unit, n_ports: int) -> tuple[float, str]:
    if n_ports < 2:
        return 0.0, "assumed: shut, as it leads into the open"
    moves = unit.mechanism
    if moves is not None and moves.kind == "lever" and moves.open is not None and moves.shut is not None:
        share = min(max(moves.shut / (moves.shut - moves.open), 0.0), 1.0) if moves.open != moves.shut else 1.0
        return round(share, 3), "as its lever is drawn"
    return 1.0, "assumed: open"


def _turns(network: Network, unit: Unit, kind: str) -> tuple[float, str]:
    moves = unit.mechanism
    if moves is not None and moves.open is not None and moves.shut is not None and moves.open != moves.shut:
        return round(abs(moves.open - moves.shut) / 360, 3), moves.sources.get("limits", "of its mechanism")
    bore = (bore_at(network, unit.id) or UNKNOWN_BORE) * 1000
    if any(word in kind for word in ("ball", "plug", "butterfly")):
        return 0.25, "assumed: a lever"
    if "gate" in kind:
        return max(round(bore / 6, 1), 1.0), "assumed: gate valve, 6 mm a turn over the bore"
    if "globe" in kind:
        return max(round(bore / 4 / 4, 1), 1.0), "assumed: globe valve, 4 mm a turn over a quarter of the bore"
    return 10.0, "assumed: 10 turns"


def _characteristic(kind: str) -> tuple[Characteristic, str]:
    if "butterfly" in kind:
        return "equal percentage", "assumed: butterfly valve"
    if "ball" in kind or "plug" in kind:
        return "ball", "assumed: ball or plug valve"
    return "linear", "assumed: linear"


def _towards(network: Network, unit: Unit, ports: Mapping[str, tuple[Arc, ...]]) -> tuple[str, str]:
    """The port that a check or relief valve lets out of."""
    names = list(ports)
    if len(names) == 1:
        return OUTSIDE, "nothing was found behind it"
    leaving = [name for name in names if any(arc.flow == "along" for arc in ports[name])]
    coming = [name for name in names if any(arc.flow == "against" for arc in ports[name])]
    if leaving and leaving[0] not in coming:
        return leaving[0], "the direction of flow"
    if coming and coming[0] not in leaving:
        return next(name for name in names if name != coming[0]), "the direction of flow"
    if not any(network.unit_type(place) == "pump" for place in network.places):
        return names[1], "assumed: towards the second port, as no direction is known"
    near = {name: _distance_to_pump(network, ports[name]) for name in names}
    if min(near.values()) < math.inf and near[names[0]] != near[names[1]]:
        return max(names, key=lambda name: near[name]), "assumed: away from the nearest pump"
    return names[1], "assumed: towards the second port, as no direction is known"


def _distance_to_pump(network: Network, arcs: Sequence[Arc]) -> float:
    """Along the pipes to the nearest pump on a side of a unit [m]."""
    distances = {arcs[0].start: 0.0}
    queue = [(arc.length or 0.0, arc.end) for arc in arcs]
    heapq.heapify(queue)
    while queue:
        distance, place = heapq.heappop(queue)
        if place in distances:
            continue
        if network.unit_type(place) == "pump":
            return distance
        distances[place] = distance
        for arc in network.arcs(place):
            if arc.end not in distances:
                heapq.heappush(queue, (distance + (arc.length or 0.0), arc.end))
    return math.inf


# Pumps and ends


def _pump(network: Network, unit: Unit) -> PumpSetting:
    ports = ports_at(network, unit.id)
    suction, reason = _suction(ports)
    out = [arc for name, arcs in ports.items() if name not in suction for arc in arcs]
    sizes = [min(arc.sizes) / 1000 if arc.sizes else arc.edge.diameter for arc in out]
    bore = min((size for size in sizes if size), default=None) or bore_at(network, unit.id) or UNKNOWN_BORE
    flow = round(_VELOCITY * math.pi / 4 * bore**2 * 3600, 2)
    why = {
        "head": "assumed: 30 m",
        "flow": f"assumed: {_VELOCITY:g} m/s in the discharge",
        "running": "assumed: it runs",
        "suction": reason,
    }
    return PumpSetting(head=_PUMP_HEAD, flow=flow, running=1.0, suction=suction, why=why)


def _suction(ports: Mapping[str, tuple[Arc, ...]]) -> tuple[tuple[str, ...], str]:
    coming = tuple(name for name, arcs in ports.items() if any(arc.flow == "against" for arc in arcs))
    leaving = tuple(name for name, arcs in ports.items() if any(arc.flow == "along" for arc in arcs))
    if coming and not set(coming) & set(leaving):
        return coming, "the direction of flow"
    if leaving and len(leaving) < len(ports) and not coming:
        return tuple(name for name in ports if name not in leaving), "the direction of flow"
    bores = {name: max((max(arc.sizes) for arc in arcs if arc.sizes), default=0) for name, arcs in ports.items()}
    widest = max(bores.values(), default=0)
    if list(bores.values()).count(widest) == 1 and len(ports) > 1:
        return (max(bores, key=lambda name: bores[name]),), "assumed: the widest port draws"
    return tuple(ports)[:1], "assumed: the first port draws"


@dataclass(frozen=True)
class _Ends:
    """What the ends of pipes are, where one knows what flows there, and where one doesn't."""

    network: Network
    pumps: Mapping[str, PumpSetting]

    def settings(self) -> dict[str, EndSetting]:
        found: dict[str, EndSetting] = {}
        for piece in self._pieces():
            found |= self._of_piece(piece)
        return {place: found[place] for place in self.network.places if place in found}

    def _pieces(self) -> Iterable[tuple[str, ...]]:
        """Nodes that hang together along pipes, in the order of the file."""
        seen: set[str] = set()
        for place in self.network.places:
            if place in seen or not self.network.arcs(place):
                continue
            piece, waiting = {place}, [place]
            while waiting:
                for arc in self.network.arcs(waiting.pop()):
                    if arc.end not in piece:
                        piece.add(arc.end)
                        waiting.append(arc.end)
            seen |= piece
            yield tuple(each for each in self.network.places if each in piece)

    def _of_piece(self, piece: Sequence[str]) -> dict[str, EndSetting]:
        nodes = {place: node for place in piece if isinstance(node := self.network.places[place], Terminal)}
        known = self._known(nodes)
        with_tank = any(self.network.unit_type(place) == "tank" for place in piece)
        return self._sized(piece, known | self._supposed(nodes, known, with_tank))

    def _known(self, nodes: Mapping[str, Terminal]) -> dict[str, tuple[EndRole, str]]:
        """Roles of the ends that are closed, or where one knows which way it flows."""
        roles: dict[str, tuple[EndRole, str]] = {}
        for place, node in nodes.items():
            flows = {arc.flow for arc in self.network.arcs(place)}
            if node.kind == "blind":
                roles[place] = "blind", "it is closed"
            elif "along" in flows:
                roles[place] = "source", "the direction of flow"
            elif "against" in flows:
                roles[place] = "sink", "the direction of flow"
        return roles

    def _supposed(
        self, nodes: Mapping[str, Terminal], known: Mapping[str, tuple[EndRole, str]], with_tank: bool
    ) -> dict[str, tuple[EndRole, str]]:
        """Roles of the other ends: something must feed the piece, a tank or a source."""
        left = {place: node for place, node in nodes.items() if place not in known}
        roles: dict[str, tuple[EndRole, str]] = {}
        fed = with_tank or any(role == "source" for role, _ in known.values())
        if not fed:
            drawn = [place for place in left if self._feeds_a_pump(place)]
            roles = dict.fromkeys(drawn, ("source", "assumed: a pump draws from it"))
            fed = bool(drawn)
        for place, node in left.items():
            if place in roles:
                continue
            if not fed:
                roles[place] = "source", "assumed: the first end of a system that nothing else feeds"
                fed = True
            elif node.kind == "open":
                roles[place] = "sink", "assumed: an open end of unknown direction"
            else:
                roles[place] = "blind", "assumed: nobody knows whether this end is open"
        return roles

    def _feeds_a_pump(self, place: str) -> bool:
        """Whether a way leads from an end to the suction of a pump, not through one."""
        seen, waiting = {place}, [place]
        while waiting:
            for arc in self.network.arcs(waiting.pop()):
                node = self.network.places[arc.end]
                if isinstance(node, Unit) and node.unit_type == "pump":
                    if node.tag in self.pumps and arc.end_port in self.pumps[node.tag].suction:
                        return True
                elif arc.end not in seen:
                    seen.add(arc.end)
                    waiting.append(arc.end)
        return False

    def _sized(self, piece: Sequence[str], roles: Mapping[str, tuple[EndRole, str]]) -> dict[str, EndSetting]:
        found = {place: guess_end(self.network, place, role, reason) for place, (role, reason) in roles.items()}
        flows = {place: end.flow for place, end in found.items() if end.flow is not None}
        tags = [node.tag for place in piece if isinstance(node := self.network.places[place], Unit)]
        pumped = sum(self.pumps[tag].flow for tag in tags if tag in self.pumps)
        share = pumped / sum(flows.values()) if flows else 1.0
        for place, flow in flows.items():
            if 0 < share < 1:
                why = {**found[place].why, "flow": "assumed: what the pumps are for at 3 bar, shared by bore"}
                values = {"flow": max(round(flow * share, 2), 0.01), "why": why}
                found[place] = found[place].model_copy(update=values)
        return found


def guess_end(network: Network, place: str, role: EndRole, reason: str = "given") -> EndSetting:
    """What is supposed of an end of a pipe whose role is known.

    Args:
        network: of the graph.
        place: its id.
        role: what it is.
        reason: how that is known.
    """
    if role == "source":
        return EndSetting(role=role, pressure=_SOURCE, why={"role": reason, "pressure": "assumed: 1 bar(g)"})
    if role == "blind":
        return EndSetting(role=role, why={"role": reason})
    bore = bore_at(network, place) or UNKNOWN_BORE
    flow = round(_VELOCITY * math.pi / 4 * bore**2 * 3600, 2)
    return EndSetting(role=role, flow=max(flow, 0.01), why={"role": reason, "flow": "assumed: 2 m/s at 3 bar"})


# Tanks and gauges


@kept_with
def tanks_of_gauges(network: Network) -> dict[str, str]:
    """The tank that each gauge hangs at, by tags: with nothing but valves and gauges between.

    A gauge without a line hangs at the tank that it is mounted at; where that may be several units, at none.

    Args:
        network: of the graph.
    """
    found: dict[str, str] = {}
    for place, node in network.places.items():
        if not isinstance(node, Unit) or node.unit_type != "gauge":
            continue
        mounted = network.mounted_at(place)
        if len(mounted) == 1 and network.unit_type(mounted[0]) == "tank" and network.arcs(mounted[0]):
            found[node.tag] = network.name(mounted[0])
        seen, waiting = {place}, [place]
        while waiting:
            for arc in network.arcs(waiting.pop()):
                other = network.places[arc.end]
                if arc.end in seen or not isinstance(other, Unit):
                    continue
                if other.unit_type == "tank":
                    found.setdefault(node.tag, other.tag)
                elif other.unit_type in ("valve", "gauge"):
                    seen.add(arc.end)
                    waiting.append(arc.end)
    return found


def _tank(network: Network, unit: Unit) -> TankSetting:
    parts = [node for part in unit.parts if isinstance(node := network.graph.nodes.get(part), Part)]
    shell = max(parts, key=lambda part: _size(part.aabb), default=None)
    low, high = shell.aabb if shell is not None else unit.aabb
    height = max(high[2] - low[2], 0.1)
    across = _in_plan(shell) if shell is not None else (high[0] - low[0]) * (high[1] - low[1])
    of = "its largest part" if shell is not None else "its box"
    why = {
        "level": "assumed: filled to 60 %",
        "height": f"the height of {of}",
        "area": f"assumed: a cylinder, upright or lying, of the size of {of}",
        "bottom": f"the lowest point of {of}",
        "pressure": "assumed: open to the air",
    }
    area = max(math.pi / 4 * across, 0.01)
    return TankSetting(
        level=round(_FILLED * height, 3), height=round(height, 3), area=round(area, 3), bottom=round(low[2], 3), why=why
    )


def _in_plan(shell: Part) -> float:
    """Length by width of a shell in plan [m2], whichever way it is turned about the vertical.

    The mean surface of what fills it is pi / 4 of that, for a round tank that stands and for one that lies.
    """
    axes, extents = shell.obb.axes, shell.obb.extents
    up = max(range(3), key=lambda k: abs(axes[k][2]))
    if abs(axes[up][2]) > _UPRIGHT:
        return math.prod(extents) / max(extents[up], 1e-9)
    low, high = shell.aabb
    along = max(range(3), key=lambda k: extents[k])
    # A box around something round may be rolled about its length by any angle; its height is its width, then.
    if abs(axes[along][2]) < 1 - _UPRIGHT:
        return extents[along] * (high[2] - low[2])
    return (high[0] - low[0]) * (high[1] - low[1])


def _size(box: tuple[tuple[float, float, float], tuple[float, float, float]]) -> float:
    return math.prod(high - low for low, high in zip(*box, strict=True))


def _shows_level(unit: Unit) -> bool:
    return "level" in (unit.kind or "").casefold()


def _gauge(unit: Unit, tank: TankSetting | None) -> GaugeSetting:
    kind = (unit.kind or "").casefold()
    lag = "assumed: 0.3 s"
    if any(word in kind for word in ("flow", "rotameter", "water meter")):
        return GaugeSetting(measures="flow", unit="m3/h", why={"measures": f"its kind: {unit.kind}", "lag": lag})
    if _shows_level(unit):
        span = "assumed: 10 m" if tank is None else "assumed: the height of its tank"
        why = {"measures": f"its kind: {unit.kind}", "lag": lag, "span": span}
        return GaugeSetting(measures="level", unit="m", span=10.0 if tank is None else tank.height, why=why)
    if "temperature" in kind or "thermometer" in kind:
        return GaugeSetting(measures="nothing", why={"measures": "temperatures are not simulated", "lag": lag})
    said = f"its kind: {unit.kind}" if "pressure" in kind else "assumed: a gauge of unknown kind shows the pressure"
    return GaugeSetting(measures="pressure", unit="bar", why={"measures": said, "lag": lag})
